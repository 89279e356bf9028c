"""The studio shows no answer as if it were about another plan than the one on its page.

Answers are held up on their way, so that older ones come in while newer questions wait.
"""

import re
from base64 import urlsafe_b64encode
from pathlib import Path

import pytest
from playwright.sync_api import Page, Route, expect

from tests.browser.pages import Device, Language, Pages
from tests.browser.players import until
from tests.browser.studios import Opened, change, number, settle, settled, verdict

PITCH = "spiral pitch"
OLD_PICTURE = "the picture is of an earlier plan"


class Held:
    """Answers from an address that are held up until they are let go."""

    def __init__(self, page: Page, path: str) -> None:
        self.page = page
        self.routes: list[Route] = []
        # Else a question that is long on its way is given up for a newer one.
        page.evaluate(
            "for (const one of ['verdicts', 'pitches', 'dances']) benchdragon[one].patience = 1e9"
        )
        page.route(f"**/api/{path}?*", self._hold)

    def _hold(self, route: Route) -> None:
        self.routes.append(route)

    def wait(self, count: int) -> None:
        """Wait until so many have been asked for."""
        for _look in range(3000):
            if len(self.routes) >= count:
                return
            self.page.wait_for_timeout(10)
        raise AssertionError(f"{len(self.routes)} were asked for")

    def let_go(self, number: int) -> None:
        self.routes[number].continue_()


def in_late(page: Page, path: str) -> Held:
    """Ask about 0.46 m, then about 0.44 m, and let only the first answer in."""
    held = Held(page, path)
    change(page, PITCH, "0.46")
    held.wait(1)
    change(page, PITCH, "0.44")
    if path == "dance":  # which is asked for once a change has come to rest
        until(page, "benchdragon.dances.wanted?.route.pitch === 0.44")
    held.let_go(0)
    held.wait(2)  # the second is asked for once the first was shown
    return held


def test_a_verdict_that_comes_in_late_is_marked_as_an_earlier_plans(opened: Opened) -> None:
    page = settled(opened())
    held = in_late(page, "verdict")
    line = verdict(page)
    expect(line).to_have_text(re.compile("^\u2026 earlier plan: Safe: tightest"))
    expect(line).to_have_class("verdict")
    expect(line).to_have_attribute("data-stale", "")
    expect(line).to_have_attribute("aria-busy", "true")
    line.click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    held.let_go(1)
    expect(line).to_have_text(re.compile("^\u2716 Not safe"))
    expect(line).to_have_class("verdict unsafe")
    expect(line).not_to_have_attribute("data-stale", "")
    line.click()
    expect(page.get_by_role("dialog")).to_contain_text("Not safe")


def test_a_limit_that_comes_in_late_is_marked_as_an_earlier_plans(opened: Opened) -> None:
    page = settled(opened())
    held = in_late(page, "limit/pitch")
    line = page.locator(".limit")
    expect(line).to_have_text(re.compile("^earlier plan: smallest pitch: 0.4503"))
    expect(line).to_have_attribute("data-stale", "")
    expect(line).to_be_visible()
    settle(page, "Not safe")
    verdict(page).click()
    expect(page.get_by_role("dialog").get_by_role("row", name="smallest pitch")).to_have_count(0)
    page.keyboard.press("Escape")
    held.let_go(1)
    expect(line).to_have_text(re.compile("^smallest pitch: 0.4503"))
    expect(line).not_to_have_attribute("data-stale", "")


def test_a_dance_that_comes_in_late_is_marked_as_an_earlier_plans(opened: Opened) -> None:
    page = settled(opened())
    place = page.locator(".player").bounding_box()
    held = in_late(page, "dance")
    assert page.locator(".player").bounding_box() == place
    root, note = page.locator("#studio"), page.get_by_text(OLD_PICTURE)
    expect(note).to_be_visible()
    expect(root).to_have_attribute("data-picture", "old")
    expect(root).to_have_attribute("aria-busy", "true")
    settle(page, "Not safe")
    verdict(page).click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("benches 1 and 19")
    expect(dialog.get_by_role("button")).to_have_text(["close"])  # no way into another plan's picture
    page.keyboard.press("Escape")
    held.let_go(1)
    expect(note).to_be_hidden()
    expect(root).to_have_attribute("data-picture", "this")
    expect(root).to_have_attribute("aria-busy", "false")


def test_no_limit_is_shown_of_a_plan_that_has_none(opened: Opened) -> None:
    page = settled(opened())
    held = Held(page, "limit/pitch")
    change(page, PITCH, "0.46")
    held.wait(1)
    page.get_by_label("begin with").select_option("spiral-in")
    settle(page, "^\u2716 Not safe")
    expect(page.locator(".limit")).to_be_hidden()
    page.unroute_all()
    page.get_by_role("button", name="undo").click()
    expect(page.locator(".limit")).to_have_text(re.compile("^smallest pitch"))
    expect(page.locator(".limit")).to_be_visible()


def test_evidence_goes_with_its_plan(opened: Opened) -> None:
    page = settled(opened())
    change(page, PITCH, "0.44")
    settled(page)
    verdict(page).click()
    expect(page.get_by_role("dialog")).to_contain_text("Not safe")
    page.keyboard.press("Control+z")
    expect(page.get_by_role("dialog")).to_have_count(0)
    settle(page, "^\u2713 Safe")


def test_a_file_that_was_made_of_an_earlier_plan_is_marked(opened: Opened) -> None:
    page = settled(opened())
    with page.expect_download():
        page.get_by_role("button", name="save the plan file").click()
    told = page.locator("fieldset > output.told")
    expect(told).to_have_text("dance.dragon.toml")
    change(page, PITCH, "0.46")
    expect(told).to_have_text("earlier plan: dance.dragon.toml")


def test_a_file_that_comes_in_late_is_marked_as_an_earlier_plans(opened: Opened) -> None:
    page = settled(opened())
    held = Held(page, "toml")
    page.get_by_role("button", name="save the plan file").click()
    held.wait(1)
    change(page, PITCH, "0.46")
    told = page.locator("fieldset > output.told")
    expect(told).to_have_text("earlier plan: working ...")
    with page.expect_download():
        held.let_go(0)
    expect(told).to_have_text("earlier plan: dance.dragon.toml")


def test_a_plan_file_that_is_read_late_does_not_take_a_newer_plans_place(
    opened: Opened, tmp_path: Path
) -> None:
    page = settled(opened())
    path = tmp_path / "a.toml"
    path.write_text("schema = 1\n[route]\nkind = 'turn'\n", "utf-8")
    held = Held(page, "plan")
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="open a plan file").click()
    chooser.value.set_files(path)
    held.wait(1)
    change(page, PITCH, "0.46")
    held.let_go(0)
    told = page.locator("fieldset > output.told")
    expect(told).to_contain_text("The plan was changed meanwhile")
    expect(number(page, PITCH)).to_have_value("0.46")


# --- neither safe nor unsafe


@pytest.mark.parametrize(
    ("status", "device", "language", "said"),
    [
        (507, "desktop", "en", "! No verdict: memory"),
        (504, "phone", "zh", "! 没有结论：memory"),
        (500, "desktop", "en", "! No verdict: memory"),
        (422, "desktop", "en", "! No verdict: memory"),
        (503, "desktop", "en", "! No verdict yet, asking again: memory"),
    ],
)
def test_no_answer_is_neither_safe_nor_unsafe(
    opened: Opened, pages: Pages, status: int, device: Device, language: Language, said: str
) -> None:
    page = settled(opened(device, language))
    colours = {verdict(page).evaluate("one => getComputedStyle(one).color")}
    page.route("**/api/verdict*", lambda route: route.fulfill(status=status, json={"error": "memory"}))
    change(page, {"en": PITCH, "zh": "螺距"}[language], "0.44")
    expect(verdict(page)).to_have_text(said)
    expect(verdict(page)).to_have_class("verdict none")
    colours.add(verdict(page).evaluate("one => getComputedStyle(one).color"))
    page.unroute_all()
    change(page, {"en": PITCH, "zh": "螺距"}[language], "0.445")
    expect(verdict(page)).to_have_class("verdict unsafe")
    colours.add(verdict(page).evaluate("one => getComputedStyle(one).color"))
    assert len(colours) == 3
    pages.forgive_refusals()


def test_of_plans_that_nobody_answered_about_none_is_another(opened: Opened, pages: Pages) -> None:
    """Answers tell the hashes of their plans; without any, no two plans are one."""
    page = settled(opened())
    for path in ("verdict", "limit/pitch", "dance"):
        page.route(
            f"**/api/{path}?*", lambda route: route.fulfill(status=500, json={"error": "memory"})
        )
    change(page, PITCH, "0.46")
    expect(verdict(page)).to_have_text("! No verdict: memory")
    held = Held(page, "verdict")
    change(page, PITCH, "0.47")
    held.wait(1)
    expect(verdict(page)).to_have_text("\u2026 earlier plan: No verdict: memory")
    pages.forgive_refusals()


def test_where_there_is_no_verdict_there_is_no_evidence(opened: Opened, pages: Pages) -> None:
    page = settled(opened())
    page.route("**/api/verdict*", lambda route: route.fulfill(status=507, json={"error": "memory"}))
    page.get_by_role("button", name="中文").click()  # the same plan is asked about again
    expect(verdict(page)).to_have_text("! 没有结论：memory")
    verdict(page).click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    pages.forgive_refusals()


@pytest.mark.parametrize("status", [409, 429, 503])
def test_what_could_not_be_answered_is_asked_again_by_itself(
    opened: Opened, pages: Pages, status: int
) -> None:
    page = settled(opened())
    for path in ("verdict", "limit/pitch", "dance"):
        page.route(
            f"**/api/{path}?*",
            lambda route: route.fulfill(status=status, json={"error": "too many questions"}),
            times=2,
        )
    change(page, PITCH, "0.44")
    settled(page)
    expect(verdict(page)).to_have_class("verdict unsafe")
    expect(page.locator(".limit")).to_have_text(re.compile("^smallest pitch: 0.4503"))
    expect(page.get_by_text(OLD_PICTURE)).to_be_hidden()
    pages.forgive_refusals()


# --- long questions


def test_a_long_questions_result_says_when_it_is_about_another_plan(opened: Opened) -> None:
    page = settled(opened())
    page.get_by_role("button", name="prove the verdict").click()
    job = page.locator(".jobs li")
    expect(job).to_contain_text("Proved. Safe")
    expect(job).to_have_attribute("data-plan", "this")
    expect(job).to_contain_text("about this plan")
    change(page, PITCH, "0.44")
    expect(job).to_have_attribute("data-plan", "other")
    expect(job).to_contain_text("about another plan")
    job.get_by_role("button", name="show that plan").click()
    expect(number(page, PITCH)).to_have_value("0.55")
    expect(job).to_have_attribute("data-plan", "this")


def test_a_long_question_is_followed_on_after_looks_that_nobody_answered(
    opened: Opened, pages: Pages
) -> None:
    page = settled(opened())
    evaluations = "**/api/jobs/*"
    page.route(evaluations, lambda route: route.abort(), times=1)
    page.route(
        evaluations,
        lambda route: route.fulfill(status=429, json={"error": "too many questions"}),
        times=1,
    )
    page.get_by_role("button", name="prove the verdict").click()
    job = page.locator(".jobs li")
    expect(job).to_contain_text("too many questions")
    expect(job).to_contain_text("The studio does not answer")
    expect(job).to_contain_text("Proved. Safe")
    pages.forgive_refusals()


def test_long_questions_are_found_again_after_the_page_is_loaded_again(opened: Opened) -> None:
    page = settled(opened())
    change(page, PITCH, "0.6")
    page.get_by_role("button", name="prove the verdict").click()
    jobs = page.locator(".jobs li")
    expect(jobs).to_contain_text("Proved. Safe")
    page.get_by_label("begin with").select_option("turn")
    settled(page)
    page.get_by_role("button", name="tolerance for people who are not exact").click()  # minutes of work
    expect(jobs.first).to_have_attribute("data-state", "running")
    page.wait_for_url(re.compile("plan="))
    page.reload()
    expect(jobs).to_have_count(2)
    expect(jobs.first).to_have_attribute("data-state", "running")
    # Loaded again it is another object of the same hash.
    expect(jobs.first).to_have_attribute("data-plan", "this")
    expect(jobs.last).to_contain_text("Proved. Safe")
    expect(jobs.last).to_have_attribute("data-plan", "other")
    jobs.last.get_by_role("button", name="show that plan").click()
    expect(number(page, PITCH)).to_have_value("0.6")
    jobs.first.get_by_role("button", name="cancel").click()
    expect(jobs.first).to_contain_text("cancelled")
    with page.expect_response(lambda response: response.request.method == "DELETE"):
        jobs.first.get_by_role("button", name="clear away").click()
    expect(jobs).to_have_count(1)
    page.reload()
    expect(jobs).to_have_count(1)
    expect(jobs).to_contain_text("Proved. Safe")


# --- links


def cut_link(page: Page) -> str:
    """The address of a plan as a letter may have cut it."""
    page.wait_for_url(re.compile("plan="))
    return re.sub(r"plan=[^&]*", lambda found: found[0][:200], page.url)


@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_a_link_that_cannot_be_read_gets_no_verdict(
    opened: Opened, pages: Pages, studio: str, device: Device, language: Language
) -> None:
    link = cut_link(settled(opened(device, language)))
    page = pages.open("about:blank", device, language)
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(link)
    notice = page.get_by_role("alert")
    words = {"en": "The plan in this link cannot be read.", "zh": "链接中的方案无法读取。"}
    expect(notice).to_contain_text(words[language])
    expect(notice.locator("code")).to_contain_text('"schema":1')
    expect(verdict(page)).to_have_class("verdict none")
    expect(verdict(page)).to_contain_text({"en": "No verdict", "zh": "没有结论"}[language])
    expect(page.locator(".limit")).to_be_hidden()
    expect(page.locator("canvas")).to_have_count(0)
    assert page.url == link
    page.wait_for_load_state("networkidle")
    assert not [url for url in asked if re.search("verdict|dance|limit", url)]
    notice.get_by_role("button").click()
    settled(page)
    expect(verdict(page)).to_have_class("verdict safe")
    expect(notice).to_have_count(0)
    page.wait_for_url(lambda url: url != link)
    pages.faults = [fault for fault in pages.faults if not fault.startswith(f"request: {studio}")]


def test_a_link_that_cannot_be_read_takes_the_verdict_off_the_page(opened: Opened) -> None:
    page = settled(opened())
    page.wait_for_url(re.compile("plan="))
    before, broken = page.url, page.url.split("#")[0] + "#plan=nothing!"
    page.goto(broken)
    expect(page.get_by_role("alert").locator("code")).to_have_text("nothing!")
    expect(verdict(page)).to_have_class("verdict none")
    expect(page.locator("#studio")).to_have_attribute("data-picture", "old")
    expect(number(page, PITCH)).to_have_value("0.55")
    page.locator(".clock").click()
    page.keyboard.press("ArrowRight")
    expect(page.locator(".clock")).to_have_text("t = 1.00 s")
    page.evaluate("benchdragon.player.onSettled()")  # which comes once the player has come to rest
    assert page.url == broken
    page.goto(before)
    settled(page)
    expect(page.get_by_role("alert")).to_have_count(0)
    expect(verdict(page)).to_have_class("verdict safe")
    page.goto(broken)
    change(page, PITCH, "0.44")
    settled(page)
    expect(page.get_by_role("alert")).to_have_count(0)
    expect(verdict(page)).to_have_class("verdict unsafe")


def test_nothing_comes_in_late_beside_a_link_that_cannot_be_read(opened: Opened) -> None:
    page = settled(opened())
    questions = {"verdict": "verdicts", "limit/pitch": "pitches", "dance": "dances"}
    held = [Held(page, path) for path in questions]
    change(page, PITCH, "0.46")
    for one in held:
        one.wait(1)
    page.goto(page.url.split("#")[0] + "#plan=nothing!")
    for standing in questions.values():
        until(page, f"benchdragon.{standing}.flying === null")
    expect(verdict(page)).to_have_text("! No verdict: the plan in this link cannot be read.")


def test_the_page_works_where_browsers_give_no_random_uuid(opened: Opened) -> None:
    """They give it to pages of https and of this machine alone; a studio may listen at others."""
    page = settled(opened())
    page.add_init_script("delete Crypto.prototype.randomUUID")
    page.reload()
    settled(page)


def test_a_link_of_other_data_is_no_plan(opened: Opened) -> None:
    page = settled(opened())
    text = urlsafe_b64encode(b'{"schema": 1}').decode().rstrip("=")
    page.goto(page.url.split("#")[0] + f"#plan={text}")
    expect(page.get_by_role("alert").locator("code")).to_have_text('{"schema": 1}')
