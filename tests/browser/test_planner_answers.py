"""The planner shows no answer as if it were about another plan than the one on its page.

Questions are held up on their way, so that older answers come in while newer questions wait.
"""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import (
    PITCH,
    Held,
    Opened,
    Refused,
    address,
    change,
    details,
    number,
    sentence,
    settle,
    settled,
    text_of,
    verdict,
)
from tests.browser.players import until

OLD_PICTURE = "the picture is of an earlier plan"


def in_late(page: Page, name: str) -> Held:
    """Ask about 0.46 m, then about 0.44 m, and let only the first question go."""
    held = Held(page, name)
    change(page, PITCH, "0.46")
    held.wait(1)
    change(page, PITCH, "0.44")
    held.let_go(0)
    held.wait(2)  # the second is asked once the first was shown, or was given up
    return held


def test_a_rough_picture_comes_before_the_dance(opened: Opened) -> None:
    page = opened()
    held = Held(page, "dance")
    change(page, PITCH, "0.44")
    held.wait(1)
    planner = page.locator("#planner")
    expect(planner).to_have_attribute("data-picture", "this")
    expect(planner).to_have_attribute("aria-busy", "true")
    rough = page.evaluate("benchdragon.player.scene.sent")
    assert rough["plan_sha256"] == page.evaluate("benchdragon.verdict.found.plan_sha256")
    footer = page.locator("footer", has_text="mm")
    assert "between a few frames" in (footer.text_content() or "")
    held.let_go(0)
    settled(page)
    assert "Checked between frames: no position" in (footer.text_content() or "")
    fine = page.evaluate("benchdragon.player.scene.sent")
    assert fine["plan_sha256"] == rough["plan_sha256"]
    assert max(one["frames"]["largest_error"] for one in (fine, rough)) < 2e-3
    assert len(rough["tightness"]["distance"]) < len(fine["tightness"]["distance"])
    assert "contact" in [one["kind"] for one in fine["occasions"]]


def test_a_rough_picture_that_is_late_takes_no_dances_place(opened: Opened) -> None:
    page = opened()
    held = Held(page, "sketch")
    change(page, PITCH, "0.44")
    settled(page)
    fine = page.evaluate("benchdragon.player.scene.sent.frames")
    held.let_go(0)
    until(page, "benchdragon.sketches.flying === null")
    assert page.evaluate("benchdragon.player.scene.sent.frames") == fine


def test_a_verdict_that_comes_in_late_is_marked_as_an_earlier_plans(opened: Opened) -> None:
    page = opened()
    held = in_late(page, "verdict")
    line = verdict(page)
    expect(line).to_have_text("\u2026 earlier plan: fits")
    expect(sentence(page)).to_have_text(re.compile("^\u2026 earlier plan: Safe: tightest"))
    expect(line).to_have_class("verdict")
    expect(line).to_have_attribute("data-stale", "")
    expect(line).to_have_attribute("aria-busy", "true")
    line.click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    held.let_go(1)
    expect(line).to_have_text("\u2716 touchesbenches 1 and 19")
    expect(line).to_have_class("verdict unsafe")
    expect(line).not_to_have_attribute("data-stale", "")
    line.click()
    expect(page.get_by_role("dialog")).to_contain_text("Not safe")


def test_a_picture_is_marked_as_an_earlier_plans_until_the_next_comes(opened: Opened) -> None:
    page = opened()
    place = page.locator(".player").bounding_box()
    Held(page, "sketch")
    held = in_late(page, "dance")
    assert page.locator(".player").bounding_box() == place
    root, note = page.locator("#planner"), page.get_by_text(OLD_PICTURE)
    expect(note).to_be_visible()
    expect(root).to_have_attribute("data-picture", "old")
    expect(root).to_have_attribute("aria-busy", "true")
    settle(page, "Not safe")
    dialog = details(page)
    dialog.locator("summary").click()
    expect(dialog.get_by_role("row", name="first contact")).to_contain_text("benches 1 and 19")
    into = re.compile("moment|t =")  # no way into another plan's picture
    expect(dialog.get_by_role("button", name=into)).to_have_count(0)
    page.keyboard.press("Escape")
    held.let_go(1)
    expect(note).to_be_hidden()
    expect(root).to_have_attribute("data-picture", "this")
    expect(root).to_have_attribute("aria-busy", "false")


def test_the_dance_of_an_earlier_plan_is_given_up_and_takes_no_newer_pictures_place(
    opened: Opened,
) -> None:
    page = opened()
    known = page.evaluate("benchdragon.dances.times.length")
    held = in_late(page, "dance")
    until(page, "benchdragon.pictured.route.pitch === 0.44")  # the rough picture
    assert page.evaluate("benchdragon.dances.times.length") == known
    expect(page.get_by_text(OLD_PICTURE)).to_be_hidden()
    held.let_go(1)
    settled(page)


def test_a_rough_picture_comes_of_a_plan_that_was_left_and_is_taken_up_again(opened: Opened) -> None:
    page = opened()
    change(page, PITCH, "0.44")
    settled(page)
    Held(page, "dance")
    change(page, PITCH, "0.46")
    until(page, "benchdragon.pictured.route.pitch === 0.46")
    page.get_by_role("button", name="undo").click()
    until(page, "benchdragon.pictured.route.pitch === 0.44")
    expect(page.locator("#planner")).to_have_attribute("aria-busy", "true")


def test_no_smallest_pitch_is_sought_of_a_plan_that_has_none(opened: Opened) -> None:
    page = opened()
    smallest = page.get_by_text("smallest pitch with which")
    expect(details(page).filter(has=smallest)).to_be_visible()
    page.keyboard.press("Escape")
    page.get_by_label("begin with").select_option("spiral-in")
    settle(page, "^\u2716 Not safe")
    dialog = details(page)
    expect(dialog.get_by_text("looking for what mends it")).to_have_count(0)
    expect(smallest).to_be_hidden()


def test_a_question_that_takes_too_long_is_given_up_for_a_newer_one(opened: Opened) -> None:
    page = opened()
    held = Held(page, "verdict")
    page.evaluate("benchdragon.verdicts.patience = -1")
    change(page, PITCH, "0.46")
    held.wait(1)
    change(page, PITCH, "0.44")
    held.wait(2)  # the first was never let go
    held.let_go(1)
    settle(page, "^\u2716 Not safe")


def test_evidence_goes_with_its_plan(opened: Opened) -> None:
    page = opened()
    change(page, PITCH, "0.44")
    settled(page)
    verdict(page).click()
    expect(page.get_by_role("dialog")).to_contain_text("Not safe")
    page.keyboard.press("Control+z")
    expect(page.get_by_role("dialog")).to_have_count(0)
    settle(page, "^\u2713 Safe")


def test_a_file_that_comes_in_late_is_marked_as_an_earlier_plans(opened: Opened) -> None:
    page = opened()
    held = Held(page, "toml")
    page.get_by_role("button", name="save the plan file").click()
    held.wait(1)
    change(page, PITCH, "0.46")
    told = page.locator("fieldset > output.told")
    expect(told).to_have_text("earlier plan: working ...")
    with page.expect_download():
        held.let_go(0)
    expect(told).to_have_text("earlier plan: Coiling-in-to-the-disc-223.dragon.toml")


def test_a_plan_file_that_is_read_late_does_not_take_a_newer_plans_place(
    opened: Opened, tmp_path: Path
) -> None:
    page = opened()
    path = tmp_path / "a.toml"
    path.write_text("schema = 1\n[route]\nkind = 'turn'\n", "utf-8")
    held = Held(page, "open")
    page.locator(".panel .plan-file").set_input_files(path)
    held.wait(1)
    change(page, PITCH, "0.46")
    held.let_go(0)
    told = page.locator("fieldset > output.told")
    expect(told).to_contain_text("The plan was changed meanwhile")
    expect(number(page, PITCH)).to_have_value("0.46")


# --- neither safe nor unsafe


@pytest.mark.parametrize(
    ("device", "language", "said"),
    [("desktop", "en", "No verdict: memory"), ("phone", "zh", "没有结论：memory")],
)
def test_no_answer_is_neither_safe_nor_unsafe(
    opened: Opened, device: Device, language: Language, said: str
) -> None:
    page = opened(device, f"#lang={language}")
    pitch = {"en": PITCH, "zh": "螺距"}[language]
    colours = {verdict(page).evaluate("one => getComputedStyle(one).color")}
    refused = Refused(page, "verdict")
    change(page, pitch, "0.44")
    settle(page, f"^! {said}$")
    expect(verdict(page)).to_have_text({"en": "! no verdict", "zh": "! 没有结论"}[language])
    expect(verdict(page)).to_have_class("verdict none")
    colours.add(verdict(page).evaluate("one => getComputedStyle(one).color"))
    refused.end()
    change(page, pitch, "0.445")
    expect(verdict(page)).to_have_class("verdict unsafe")
    colours.add(verdict(page).evaluate("one => getComputedStyle(one).color"))
    assert len(colours) == 3


def test_of_plans_that_nobody_answered_about_none_is_another(opened: Opened) -> None:
    """Answers tell the hashes of their plans; without any, no two plans are one."""
    page = opened()
    refused = [Refused(page, name) for name in ("verdict", "dance")]
    change(page, PITCH, "0.46")
    settle(page, "^! No verdict: memory$")
    refused[0].end()
    held = Held(page, "verdict")
    change(page, PITCH, "0.47")
    held.wait(1)
    expect(verdict(page)).to_have_text("\u2026 earlier plan: no verdict")


def test_where_there_is_no_verdict_there_is_no_evidence_but_a_reason(opened: Opened) -> None:
    page = opened()
    Refused(page, "verdict")
    page.get_by_role("button", name="中文").click()  # the same plan is asked about again
    settle(page, "^! 没有结论：memory$")
    dialog = details(page)
    expect(dialog).to_contain_text("没有结论：memory")
    expect(dialog.locator(".evidence")).to_have_count(0)


def test_a_dance_that_cannot_be_shown_is_said_beside_its_verdict(opened: Opened) -> None:
    page = opened()
    refused = Refused(page, "dance")
    change(page, "width of a bench", "0.31")
    expect(page.locator(".old")).to_contain_text("This plan cannot be shown: memory")
    settle(page, "Safe")
    refused.end()
    page.get_by_role("button", name="undo").click()
    expect(page.locator(".old")).not_to_contain_text("cannot be shown")


def test_a_long_questions_answer_says_when_it_is_about_another_plan(opened: Opened) -> None:
    page = opened()
    page.get_by_label("begin with").select_option("turn")
    change(page, "number of benches", "20")
    settled(page)
    page.get_by_role("button", name="greatest head speed").click()
    job = page.locator(".jobs li")
    expect(job.locator("progress")).to_have_count(0)
    expect(job).to_have_attribute("data-plan", "this")
    change(page, "number of benches", "21")
    settled(page)
    expect(job).to_have_attribute("data-plan", "other")
    change(page, "number of benches", "20")  # another object of the same hash
    settled(page)
    expect(job).to_have_attribute("data-plan", "this")


# --- links

# What a page asks its Workers, from the first on.
ASKED = """
  globalThis.asked = [];
  const post = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (said) {
    if (said.question) asked.push(said.question);
    post.call(this, said);
  };
"""


@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_a_link_that_cannot_be_read_gets_no_verdict(
    opened: Opened, pages: Pages, device: Device, language: Language
) -> None:
    whole = opened(device, f"#lang={language}")
    # As a letter may have cut it.
    link = re.sub(r"plan=[^&]*", lambda found: found[0][:-4], address(whole))
    page = pages.open("about:blank", device, language)
    page.add_init_script(ASKED)
    page.clock.install()
    page.goto(link)
    notice = page.get_by_role("alert")
    words = {"en": "The plan in this link cannot be read.", "zh": "链接中的方案无法读取。"}
    expect(notice).to_contain_text(words[language])
    expect(notice.locator("code")).to_contain_text('["question')
    expect(verdict(page)).to_have_class("verdict none")
    expect(verdict(page)).to_contain_text({"en": "no verdict", "zh": "没有结论"}[language])
    expect(page.locator("canvas")).to_have_count(0)
    assert page.url == link
    # Whatever waits for the page to be left alone has its time.
    page.clock.run_for(10_000)
    assert page.evaluate("asked") == []
    notice.get_by_role("button").click()
    settled(page)
    expect(verdict(page)).to_have_class("verdict safe")
    expect(notice).to_have_count(0)
    page.wait_for_url(lambda url: url != link)
    assert page.evaluate("asked.includes('verdict')")


def test_a_link_that_cannot_be_read_takes_the_verdict_off_the_page(opened: Opened) -> None:
    page = opened()
    before = address(page)
    broken = before.split("#")[0] + "#plan=nothing!"
    page.goto(broken)
    expect(page.get_by_role("alert").locator("code")).to_have_text("nothing!")
    expect(verdict(page)).to_have_class("verdict none")
    expect(page.locator("#planner")).to_have_attribute("data-picture", "old")
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


def test_sliders_tracks_are_given_up_beside_a_link_that_cannot_be_read(opened: Opened) -> None:
    page = opened()
    # Whoever answers for the tracks never does, until given up.
    page.evaluate(
        """() => {
          const { answers, tracks } = benchdragon;
          const never = () => new Promise(() => {});
          answers.aside = () => ({ ask: never, close: () => { globalThis.over = true; } });
          tracks.near = "route.pitch";
          tracks.show(tracks.plan);
        }"""
    )
    until(page, "benchdragon.tracks.aside !== null && !globalThis.over")
    page.goto(page.url.split("#")[0] + "#plan=nothing!")
    expect(page.get_by_role("alert").locator("code")).to_have_text("nothing!")
    assert page.evaluate("globalThis.over")


@pytest.mark.parametrize("questions", [("verdict", "sketch"), ("dance",)])
def test_nothing_comes_in_late_beside_a_link_that_cannot_be_read(
    opened: Opened, questions: tuple[str, ...]
) -> None:
    page = opened()
    held = [Held(page, name) for name in questions]
    change(page, PITCH, "0.46")
    for one in held:
        one.wait(1)
    page.goto(page.url.split("#")[0] + "#plan=nothing!")
    for standing in ("verdicts", "sketches", "dances"):
        until(page, f"benchdragon.{standing}.flying === null")
    settle(page, "^! No verdict: the plan in this link cannot be read.$")


def test_a_link_of_other_data_is_no_plan(opened: Opened) -> None:
    page = opened()
    text = text_of(b'["", {"schema": 1}]')
    page.goto(page.url.split("#")[0] + f"#plan={text}")
    expect(page.get_by_role("alert").locator("code")).to_have_text('["", {"schema": 1}]')


# Of the dance, so much is over at the time that is shown.
SHARE = "({ time, scene }) => (time - scene.start) / (scene.end - scene.start)"


def test_a_dance_waits_until_a_hand_has_let_go_of_the_time_axis(opened: Opened) -> None:
    page = opened()
    held = Held(page, "dance")
    change(page, PITCH, "0.46")
    held.wait(1)
    expect(page.locator("#planner")).to_have_attribute("data-picture", "this")
    rough = page.evaluate("benchdragon.player.scene.sent.tightness.distance.length")
    box = page.locator(".axis input").bounding_box()
    assert box is not None
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.2 * box["width"], middle)
    page.mouse.down()
    held.let_go(0)
    expect(page.locator("#planner")).to_have_attribute("aria-busy", "false")
    shown = "benchdragon.player.scene.sent.tightness.distance.length"
    for share in (0.5, 0.8):
        page.mouse.move(box["x"] + share * box["width"], middle)
        until(page, f"Math.abs({share} - ({SHARE})(benchdragon.player)) < 0.05")
        assert page.evaluate(shown) == rough
    time = page.evaluate("benchdragon.player.time")
    page.mouse.up()
    until(page, f"{shown} > {rough}")
    assert page.evaluate("benchdragon.player.time") == time


def test_a_story_of_the_page_waits_for_the_dance_that_waits_for_a_hand(opened: Opened) -> None:
    page = opened()
    page.locator("canvas").hover(position={"x": 40, "y": 200})
    page.mouse.down()
    page.evaluate(
        "() => { const other = structuredClone(benchdragon.plan); other.route.pitch = 0.46;"
        " benchdragon.change(other, true);"
        " benchdragon.whenDanced(other).then(() => (globalThis.danced = true)); }"
    )
    expect(page.locator("#planner")).to_have_attribute("aria-busy", "false")
    expect(page.locator("#planner")).to_have_attribute("data-picture", "old")
    assert page.evaluate("globalThis.danced === undefined")
    page.mouse.up()
    until(page, "globalThis.danced === true")
    expect(page.locator("#planner")).to_have_attribute("data-picture", "this")


def test_a_picture_that_waited_for_a_hand_is_marked_as_an_earlier_plans(opened: Opened) -> None:
    page = opened()
    page.locator("canvas").hover(position={"x": 40, "y": 200})
    page.mouse.down()
    other = "{ ...benchdragon.plan, route: { ...benchdragon.plan.route, pitch: %s } }"
    page.evaluate(f"benchdragon.change({other % 0.46}, true)")
    expect(page.locator("#planner")).to_have_attribute("aria-busy", "false")
    Held(page, "sketch")
    Held(page, "dance")
    page.evaluate(f"benchdragon.change({other % 0.44}, true)")
    page.mouse.up()
    until(page, "benchdragon.pictured.route.pitch === 0.46")
    expect(page.locator("#planner")).to_have_attribute("data-picture", "old")


def test_a_dance_that_waited_for_a_hand_does_not_replace_the_right_picture(opened: Opened) -> None:
    page = opened()
    page.locator("canvas").hover(position={"x": 40, "y": 200})
    page.mouse.down()
    first = page.evaluate("benchdragon.plan.route.pitch")
    other = "{ ...benchdragon.plan, route: { ...benchdragon.plan.route, pitch: 0.46 } }"
    page.evaluate(f"benchdragon.change({other}, true)")
    expect(page.locator("#planner")).to_have_attribute("aria-busy", "false")
    Held(page, "sketch")
    Held(page, "dance")
    page.evaluate("benchdragon.undo()")
    page.mouse.up()
    until(page, "!benchdragon.player.hold.on")
    page.evaluate("new Promise((done) => setTimeout(done))")  # who let go has been heard
    assert page.evaluate("benchdragon.pictured.route.pitch") == first
    expect(page.locator("#planner")).to_have_attribute("data-picture", "this")


def test_a_dance_is_asked_for_though_a_grip_was_held_when_the_plan_came_to_rest(opened: Opened) -> None:
    page = opened()
    other = "{ ...benchdragon.plan, route: { ...benchdragon.plan.route, pitch: 0.46 } }"
    page.evaluate(
        f"() => {{ benchdragon.grips.drag = {{}}; benchdragon.change({other}, true);"
        " benchdragon.rest.drop(); benchdragon.rest.act(); benchdragon.grips.drag = null; }"
    )
    settled(page)
    expect(page.locator("#planner")).to_have_attribute("data-picture", "this")


@pytest.mark.parametrize("name", ["time", "nearer"])
def test_the_focus_stays_where_it_is_when_another_dance_comes(opened: Opened, name: str) -> None:
    page = opened()
    page.locator("summary").filter(has_text="View").click()
    control = page.get_by_label(name, exact=True)
    control.focus()
    change_by = "{ ...benchdragon.plan, route: { ...benchdragon.plan.route, pitch: 0.46 } }"
    page.evaluate(f"globalThis.face = benchdragon.player.face; benchdragon.change({change_by}, true)")
    settled(page)
    assert not page.evaluate("face.canvas.isConnected")
    expect(control).to_be_focused()
