"""The paper's five questions as stories in the planner: what they tell is what Python answers."""

import re

import pytest
from playwright.sync_api import Page, expect

from benchdragon.analysis.check import check
from benchdragon.model.turns import Turn
from benchdragon.plans.presets import presets
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import limit
from tests.browser.pages import Device, Language
from tests.browser.planners import Opened, change
from tests.browser.players import drawn, seconds, until

# Enough for all that the stories tell.
BENCHES = 60
STORY = "benchdragon.player.face.story"
TELLS = f"{STORY}.open && benchdragon.stories.told.textContent === ''"


def preset(name: str) -> Plan:
    """A preset with fewer benches."""
    (plan,) = [one.plan for one in presets() if one.name == name]
    data = plan.data()
    data["dragon"]["benches"] = BENCHES
    return Plan.model_validate(data)


def small(page: Page) -> Page:
    """The page with fewer benches in the presets."""
    page.evaluate(
        "(count) => benchdragon.presets.forEach(({ plan }) => (plan.dragon.benches = count))", BENCHES
    )
    return page


def buttons(page: Page) -> list[str]:
    return page.locator(".stories > button").all_inner_texts()


def told(page: Page, question: int) -> list[str]:
    """Open a story; what its first chapter tells."""
    page.locator(".stories > button").nth(question - 1).click()
    until(page, TELLS)
    return steps(page)


def steps(page: Page) -> list[str]:
    """What a chapter tells, told step by step."""
    texts: list[str] = page.evaluate(f"{STORY}.steps.map(({{ text }}) => text)")
    for n, text in enumerate(texts):
        page.evaluate(f"(n) => {{ {STORY}.go(n); {STORY}.pause(true); }}", n)
        drawn(page)
        shown = page.locator(".captions .now")
        expect(shown).to_have_text(text)
        expect(page.locator("#player .spoken")).to_have_text(text)
    return texts


def onwards(page: Page) -> list[str]:
    """Go on to the next chapter by the key for the next step; what it tells."""
    before = page.evaluate("JSON.stringify(benchdragon.plan)")
    page.keyboard.press("ArrowRight")
    until(page, f"{TELLS} && {STORY}.next === null")
    assert page.evaluate("JSON.stringify(benchdragon.plan)") != before
    return steps(page)


def numbers(text: str) -> list[float]:
    """All numbers of a sentence."""
    return [float(one.replace("\u2212", "-")) for one in re.findall(r"[-\u2212]?\d+\.?\d*", text)]


def shown_plan(page: Page) -> Plan:
    return Plan.model_validate(page.evaluate("structuredClone(benchdragon.plan)"))


def turn_of(plan: Plan) -> Turn:
    """Its turn."""
    assert isinstance(plan.route, TurnRoute)
    return plan.route.turn(plan)


def test_question_1_tells_positions_and_speeds(opened: Opened) -> None:
    page = small(opened())
    texts = told(page, 1)
    plan = shown_plan(page)
    assert (plan.walk.start, plan.walk.end, plan.dragon.benches) == (0, 300, BENCHES)
    motion = plan.build().motion([300.0])
    for text, handle in ((texts[2], 0), (texts[3], BENCHES)):
        *_others, x, y, speed = numbers(text)
        assert (x, y) == pytest.approx((motion.x[0, handle], motion.y[0, handle]), abs=1e-3)
        assert speed == pytest.approx(motion.speed[0, handle], abs=1e-4)
    assert numbers(texts[4]) == pytest.approx([1, 51, *motion.speed[0, [0, 50]]], abs=1e-4)
    assert page.evaluate(f"{STORY}.player.time") == 300


def test_question_2_tells_the_first_contact(opened: Opened) -> None:
    page = small(opened())
    texts = told(page, 2)
    contact = check(shown_plan(page)).first_contact
    assert contact is not None
    assert contact.witness is not None
    a, b = contact.witness.benches
    assert f"t = {seconds(contact.value)}: bench {a} meets bench {b}." in texts[3]
    assert page.evaluate(f"{STORY}.pair") == [a - 1, b - 1]


def test_question_3_tells_the_smallest_pitch(opened: Opened) -> None:
    page = small(opened())
    texts = told(page, 3)
    less = check(shown_plan(page)).first_contact
    assert less is not None
    assert seconds(less.value) in texts[0]
    texts = onwards(page)
    plan = shown_plan(page)
    found = limit(preset("question-3"), "pitch", tolerance=1e-5)
    assert numbers(texts[0])[:2] == pytest.approx([found.lower, found.upper], abs=1e-6)
    pitch = plan.value("route.pitch")
    assert found.upper < pitch < found.upper + 1e-3
    assert f"{pitch:.3f} m" in texts[0]
    near = check(plan).clearance
    assert near.witness is not None
    x, y = near.witness.point
    assert numbers(texts[1])[:2] == list(near.witness.benches)
    assert numbers(texts[1])[2] == pytest.approx((x**2 + y**2) ** 0.5, abs=0.02)
    assert numbers(texts[3])[1] == pytest.approx(100 * near.value, abs=0.06)


def test_question_4_tells_a_shorter_turn(opened: Opened) -> None:
    page = small(opened())
    texts = told(page, 4)
    paper = shown_plan(page)
    first = turn_of(paper)
    assert numbers(texts[1]) == pytest.approx(
        [2 * first.least_radius, first.least_radius, first.length], abs=6e-4
    )
    even = Plan.model_validate(paper.data() | {"turn": paper.data()["turn"] | {"ratio": 1.0}})
    assert numbers(texts[2]) == pytest.approx([turn_of(even).length], abs=6e-4)
    texts = onwards(page)
    line = shown_plan(page)
    second = turn_of(line)
    told_of = [second.length, first.length - second.length]
    assert numbers(texts[0])[1:] == pytest.approx(told_of, abs=6e-4)
    report = check(line)
    assert report.first_contact is None
    assert numbers(texts[1])[-1] == pytest.approx(100 * report.clearance.value, abs=0.06)


def test_question_5_tells_the_greatest_head_speed_and_where(opened: Opened) -> None:
    page = small(opened())
    texts = told(page, 5)
    value = greatest_head_speed(preset("turn")).value
    assert numbers(texts[4])[0] == pytest.approx(value, abs=1e-6)
    plan = shown_plan(page)
    assert value - 1e-6 <= plan.value("walk.speed") <= value
    fastest = check(plan).greatest_speed
    assert fastest.witness is not None
    assert fastest.witness.time is not None
    assert numbers(texts[2]) == [fastest.witness.handle, fastest.witness.benches[0]]
    time, most = numbers(texts[3])
    assert (time, most) == pytest.approx((fastest.witness.time, fastest.value), abs=0.01)
    page.evaluate(f"{STORY}.go(3)")
    drawn(page)
    here = page.evaluate(f"{STORY}.met.from")
    motion = plan.build().motion([fastest.witness.time])
    handle = fastest.witness.handle
    assert here == pytest.approx([motion.x[0, handle], motion.y[0, handle]], abs=5e-3)


@pytest.mark.parametrize(("device", "language"), [("phone", "zh")])
def test_a_story_of_a_question_is_told_in_the_other_language_and_ends_with_its_plan(
    opened: Opened, device: Device, language: Language
) -> None:
    page = small(opened(device, f"#lang={language}"))
    assert all(re.search("[\u4e00-\u9fff]", name) for name in buttons(page))
    chinese = told(page, 2)
    caption = page.locator(".captions .now").bounding_box()
    picture = page.locator("canvas").bounding_box()
    assert caption is not None
    assert picture is not None
    assert caption["y"] >= picture["y"] + picture["height"]  # not below what stays in sight
    assert caption["y"] + caption["height"] <= 844
    page.evaluate("benchdragon.player.translate()")
    until(page, "benchdragon.root.ariaBusy === 'false'")
    assert steps(page) != chinese
    page.keyboard.press("Escape")
    expect(page.locator(".story")).to_be_hidden()


def test_a_story_that_is_being_computed_is_given_up(opened: Opened) -> None:
    page = small(opened())
    plan = page.evaluate("JSON.stringify(benchdragon.plan)")
    page.evaluate(
        "void (benchdragon.answers.aside = () => {"
        " let fail; const close = () => fail(new DOMException('', 'AbortError'));"
        " return { ask: () => new Promise((_done, failed) => (fail = failed)), close }; })"
    )
    told_of = page.locator(".stories .told")
    page.locator(".stories > button").nth(2).click()
    expect(told_of).to_have_text("computing ...")
    page.locator(".stories .row button").click()
    expect(told_of).to_have_text("")
    assert page.evaluate("JSON.stringify(benchdragon.plan)") == plan
    page.locator(".stories > button").nth(2).click()
    change(page, "spiral pitch", "0.46")
    expect(told_of).to_have_text("")
    assert page.evaluate(f"{STORY}.open") is False
