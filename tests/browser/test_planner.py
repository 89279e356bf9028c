"""The planner opened from disk: it judges and shows the plan on its page, and opens and saves plans."""

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, ViewportSize, expect

from benchdragon.analysis.check import check
from benchdragon.analysis.records import verdict_of
from benchdragon.number_format import figures
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.player.messages import Dance
from benchdragon.player.scene import judged_dance
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.tolerance import CASES, tolerance
from tests.browser.pages import Device, Language
from tests.browser.planners import Opened, address, change, number, sentence, settle, settled, verdict
from tests.browser.players import until

PITCH = {"en": "spiral pitch", "zh": "螺距"}


def shown_plan(page: Page) -> Plan:
    """The plan on the page."""
    return Plan.model_validate(json.loads(page.evaluate("JSON.stringify(benchdragon.plan)")))


@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_a_slider_is_moved_and_the_verdict_is_that_of_the_plan_shown(
    opened: Opened, device: Device, language: Language
) -> None:
    page = opened(device, f"#lang={language}")
    slider = page.get_by_role("slider", name=PITCH[language])
    for value, safe in (("0.46", True), ("0.44", False), ("0.46", True)):
        slider.fill(value)
        expect(verdict(page)).to_have_class("verdict safe" if safe else "verdict unsafe")
        settled(page)
        plan = shown_plan(page)
        assert plan.value("route.pitch") == float(value)
        wanted = verdict_of(check(plan))
        assert page.evaluate("benchdragon.verdict.found.plan_sha256") == plan.sha256
        assert page.evaluate("benchdragon.player.scene.sent.plan_sha256") == plan.sha256
        said = getattr(wanted.sentence, language)
        settle(page, re.escape(said))
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize("device", [(1366, 768), (320, 640)], ids=["desktop", "phone"])
def test_without_scripts_a_dance_and_its_verdict_are_in_sight(
    browser: Browser, file: Path, device: tuple[int, int]
) -> None:
    width, height = device
    size: ViewportSize = {"width": width, "height": height}
    page = browser.new_context(java_script_enabled=False, viewport=size).new_page()
    page.goto(file.as_uri())
    for name in ("svg", "strong"):
        box = page.locator(f".look {name}").first.bounding_box()
        assert box is not None
        assert box["y"] + box["height"] < height
        assert box["x"] + box["width"] <= width
    letters = page.locator(".look text").bounding_box()
    assert letters is not None
    assert letters["height"] >= 10
    expect(page.locator(".look strong")).to_have_count(2)
    page.context.close()


def test_what_is_told_of_an_earlier_plan_says_so(opened: Opened) -> None:
    """The Worker is held up, so that the old verdict stands while the new one is on its way."""
    page = opened()
    page.evaluate("void (benchdragon.answers.quick.ask = () => new Promise(() => {}))")
    change(page, PITCH["en"], "0.44")
    expect(verdict(page)).to_have_text("\u2026 earlier plan: fits")
    expect(verdict(page)).to_have_class("verdict")
    verdict(page).click()
    expect(page.get_by_role("dialog")).to_have_count(0)


def test_newer_plans_are_answered_and_older_ones_given_up(opened: Opened) -> None:
    page = opened()
    page.evaluate("""async () => {
        for (const pitch of [0.52, 0.5, 0.48, 0.47, 0.46, 0.44]) {
            const plan = structuredClone(benchdragon.plan);
            plan.route.pitch = pitch;
            benchdragon.change(plan, false);
            await new Promise((done) => setTimeout(done, 30));
        }
    }""")
    settled(page)
    assert shown_plan(page).value("route.pitch") == 0.44
    expect(verdict(page)).to_have_class("verdict unsafe")


def test_a_plan_file_is_opened_and_saved(opened: Opened, tmp_path: Path) -> None:
    page = opened()
    path = tmp_path / "mine.dragon.toml"
    dragon, route = 'benches = 9\nwidth = "25 cm"', 'kind = "turn"\npitch = 1.8'
    path.write_text(f"# mine\nschema = 1\n[dragon]\n{dragon}\n[route]\n{route}\n", "utf-8")
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="open a plan file").click()
    chooser.value.set_files(path)
    expect(number(page, "number of benches")).to_have_value("9")
    expect(number(page, "width of a bench")).to_have_value("0.25")
    settled(page)
    assert shown_plan(page).sha256 == read_plan(str(path)).sha256
    change(page, PITCH["en"], "1.75")
    with page.expect_download() as saved:
        page.get_by_role("button", name="save the plan file").click()
    assert saved.value.suggested_filename == "dance-9.dragon.toml"
    again = tmp_path / "again.dragon.toml"
    saved.value.save_as(again)
    assert read_plan(str(again)).sha256 == read_plan(str(path), ["route.pitch=1.75"]).sha256


@pytest.mark.parametrize(
    ("title", "language", "name"),
    [
        ("On the village square", "en", "On-the-village-square-7"),
        ('CON: a/b\\c "d" <e>|f? * $(g) ..', "en", "CON-a-b-c-d-e-f-g-7"),
        ("村里的广场", "zh", "村里的广场-7"),
        ("...", "en", "dance-7"),
        ("x" * 200, "en", "x" * 60 + "-7"),
    ],
)
def test_a_saved_file_is_called_as_the_dance_is(
    opened: Opened, title: str, language: Language, name: str
) -> None:
    page = opened(where=f"#lang={language}")
    key = "title_zh" if language == "zh" else "title"
    plan = read_plan("spiral-in", ["dragon.benches=7"]).data()
    plan["meta"][key] = title
    page.evaluate("(plan) => benchdragon.change(plan, true)", plan)
    settled(page)
    with page.expect_download() as saved:
        page.get_by_role("button", name=re.compile("save the plan file|保存")).click()
    assert saved.value.suggested_filename == f"{name}.dragon.toml"
    page.locator(".commands summary").click()
    commands = page.locator(".commands code").all_text_contents()
    assert [command.split(" ", 3)[2] for command in commands if "solve" not in command] == [
        f"{name}.dragon.toml"
    ] * 6
    for made in (".html", "-motion", "-check", "-papers", ".mp4"):
        assert f"-o {name}{made}" in " ".join(commands)


def test_a_file_of_a_dragon_of_own_benches_is_called_by_how_many_dance(opened: Opened) -> None:
    page = opened()
    own = [{"length": 3.41}, {"length": 2.2, "count": 5}]
    page.evaluate(
        "(bench) => benchdragon.change({ ...benchdragon.plan, dragon: { bench } }, true)", own
    )
    settled(page)
    with page.expect_download() as saved:
        page.get_by_role("button", name="save the plan file").click()
    assert saved.value.suggested_filename == "Coiling-in-to-the-disc-6.dragon.toml"


def test_a_plan_file_is_dropped_on_the_page(opened: Opened) -> None:
    page = opened()
    data = page.evaluate_handle(
        """() => {
            const data = new DataTransfer();
            const text = "schema = 1\\n[dragon]\\nbenches = 7\\n[route]\\nkind = 'turn'\\n";
            data.items.add(new File([text], "dropped.dragon.toml"));
            return data;
        }"""
    )
    page.dispatch_event(".panel", "drop", {"dataTransfer": data})
    expect(number(page, "number of benches")).to_have_value("7")
    expect(page.locator("fieldset > output.told")).to_have_text("dropped.dragon.toml")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("schema = 1\n[route\n", "plan is not TOML: line 2, column"),
        ("schema = 1\n[route]\nkind = 'turn'\npich = 1\n", "route.pich"),
        (
            "schema = 1\n[route]\nkind = 'turn'\n[dragon]\nbenches = 0\n",
            "dragon.benches: expected at least 1",
        ),
    ],
)
def test_a_file_that_is_no_plan_is_refused_in_the_programs_words(
    opened: Opened, tmp_path: Path, text: str, said: str
) -> None:
    page = opened()
    path = tmp_path / "wrong.dragon.toml"
    path.write_text(text, "utf-8")
    before = shown_plan(page).sha256
    page.locator(".panel .plan-file").set_input_files(path)
    expect(page.locator("fieldset > output.told")).to_contain_text(said)
    assert shown_plan(page).sha256 == before


def test_a_plan_that_cannot_be_walked_has_no_verdict_but_a_reason(opened: Opened) -> None:
    page = opened()
    change(page, "number of benches", "3500")
    change(page, "turns at the start", "4")
    expect(verdict(page)).to_have_class("verdict none")
    expect(sentence(page)).to_contain_text("No verdict: ")


def test_the_language_is_switched_and_remembered(opened: Opened) -> None:
    page = opened()
    page.get_by_role("button", name="中文").click()
    settle(page, "安全：最紧处")
    page.reload()
    settle(page, "安全：最紧处")
    expect(page.locator("html")).to_have_attribute("lang", "zh-CN")


def test_the_plan_stands_in_the_address_and_in_the_browser_if_asked(
    opened: Opened, bare_file: Path
) -> None:
    page = opened()
    first = address(page)
    page.get_by_label("keep the plan in this browser").check()
    change(page, PITCH["en"], "0.46")
    link = address(page, first)
    settled(page)
    other = page.context.new_page()
    other.goto(link)
    expect(number(other, PITCH["en"])).to_have_value("0.46")
    other.goto("about:blank")
    other.goto(bare_file.as_uri())
    expect(number(other, PITCH["en"])).to_have_value("0.46")
    kept = other.get_by_label("keep the plan in this browser")
    kept.uncheck()
    other.goto("about:blank")
    other.goto(bare_file.as_uri())
    expect(other.locator(".wishes")).to_be_visible()
    expect(kept).not_to_be_checked()
    assert other.evaluate("localStorage.getItem('benchdragon.plan')") is None


def test_what_the_page_cannot_do_has_its_command_and_no_button(opened: Opened) -> None:
    page = opened()
    expect(page.get_by_role("button", name="prove the verdict")).to_have_count(0)
    page.get_by_text("On the command line").click()
    proof = page.locator(".commands li", has_text="prove the verdict")
    expect(proof.locator("code")).to_have_text(
        "benchdragon check Coiling-in-to-the-disc-223.dragon.toml --prove"
    )
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    proof.get_by_role("button").click()
    expect(proof.locator("output")).to_have_text("copied")
    copied = page.evaluate("navigator.clipboard.readText()")
    assert copied == "benchdragon check Coiling-in-to-the-disc-223.dragon.toml --prove"


SQUARE = Path(__file__).parents[2] / "examples" / "10_village_square.dragon.toml"


@pytest.mark.parametrize(
    ("source", "settings"),
    [
        ("spiral-in", ["dragon.benches=40", "route.start_turn=8"]),
        ("spiral-in", ["dragon.benches=40", "disc.radius=4.5", "limits.margin=0.3"]),
        (str(SQUARE), []),
        (str(SQUARE), ["limits.margin=1.5"]),
    ],
)
def test_the_player_marks_what_the_check_found(
    opened: Opened, source: str, settings: list[str]
) -> None:
    page, plan = opened(), read_plan(source, settings)
    page.evaluate("(plan) => benchdragon.change(plan, true)", plan.data())
    settled(page)
    wanted = judged_dance(plan, check)
    found = Dance.model_validate(page.evaluate("benchdragon.player.scene.sent"))
    assert found.plan_sha256 == plan.sha256
    marks, others = found.occasions, wanted.occasions
    assert [one.kind for one in marks] == [one.kind for one in others]
    for one, other in zip(marks, others, strict=True):
        assert one.time == pytest.approx(other.time, abs=1e-3)
        assert (one.text, one.benches, one.obstacle) == (other.text, other.benches, other.obstacle)
    least = [
        min((gap, other) for gap, other in zip(near.distance, near.other, strict=True) if other)
        for near in (found.nearest, wanted.nearest)
    ]
    assert least[0] == pytest.approx(least[1], abs=1e-5)


def test_long_questions_are_answered_with_the_plan_that_they_are_about(opened: Opened) -> None:
    page = opened()
    page.get_by_label("begin with").select_option("turn")
    change(page, "number of benches", "20")
    settled(page)
    asked = shown_plan(page)
    page.get_by_role("button", name="greatest head speed").click()
    job = page.locator(".jobs li")
    wanted = greatest_head_speed(asked)
    expect(job).to_contain_text(f"{figures(wanted.value, up=False)} m/s")
    expect(job).to_have_attribute("data-plan", "this")
    change(page, "number of benches", "19")
    change(page, "number of benches", "20")  # another object, of the same hash
    settled(page)
    expect(job).to_have_attribute("data-plan", "this")
    change(page, "number of benches", "21")
    settled(page)
    expect(job).to_have_attribute("data-plan", "other")
    job.get_by_role("button", name="show that plan").click()
    assert shown_plan(page).sha256 == asked.sha256
    job.get_by_role("button", name="clear away").click()
    expect(job).to_have_count(0)


def test_random_dances_are_those_of_python(opened: Opened) -> None:
    coil = ["dragon.benches=9", "route.start_turn=8", "route.pitch=0.59", "disc.radius=2"]
    page, plan = opened(), read_plan("spiral-in", coil)
    page.evaluate("(plan) => benchdragon.change(plan, true)", plan.data())
    settled(page)
    page.get_by_role("button", name="tolerance for people who are not exact").click()
    found = tolerance(plan, CASES["all"].deviations, 100, seed=1, own=True)
    chance, pitch = 100.0 * found.touching()[0], found.pitch_for(0.1)
    assert 0.0 < chance < 100.0
    job = page.locator(".jobs li")
    expect(job).to_contain_text(f"{chance:.1f} % of 100 random dances touch")
    expect(job).to_contain_text(f"at most 10 % with a pitch of {pitch:.3f} m")


def test_a_long_question_is_cancelled_at_once(opened: Opened) -> None:
    page = opened()
    page.get_by_label("begin with").select_option("turn")
    settled(page)
    page.get_by_role("button", name="best turn").click()
    job = page.locator(".jobs li")
    expect(job.locator("progress")).to_have_count(1)
    until(page, "document.querySelector('.jobs progress').value > 0")
    job.get_by_role("button", name="cancel").click()
    expect(job).to_contain_text("cancelled")


def test_a_fault_of_the_worker_is_told_and_the_next_question_has_a_new_one(opened: Opened) -> None:
    page = opened()
    page.evaluate(
        "benchdragon.answers.ask('nosuch', benchdragon.plan).catch((e) => { globalThis.told = e; })"
    )
    until(page, "globalThis.told !== undefined")
    assert "something is wrong with this page" in page.evaluate("told.message")
    change(page, PITCH["en"], "0.44")
    settled(page)
    expect(verdict(page)).to_have_class("verdict unsafe")
