"""The verdict in a fixed place: a word and a colour, what is behind it, and what mends a finding."""

import json
import math
import re
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from benchdragon.analysis.check import check
from benchdragon.analysis.findings import KINDS
from benchdragon.plans.schema import Plan
from benchdragon.solve.head_speed import greatest_head_speed
from tests.browser.pages import Device, Language
from tests.browser.planners import PITCH, Opened, change, details, number, settle, settled, verdict
from tests.browser.players import until

# A verdict that comes of the plan on the page: that found of it, but for what is given.
TELL = """(given) => {
  const { verdict: { found, plan }, verdicts } = benchdragon;
  verdicts.answered({ ...found, ...given }, plan);
}"""
# Show it as if another plan were on the page.
OLD = "benchdragon.lines.verdict.show({})"
LONG = {"en": "a long sentence " * 30, "zh": "很长的一句话" * 60}


def finding(kind: str, *, decided: bool = True) -> dict[str, Any]:
    """A finding of a kind, as verdicts tell it."""
    return {
        "code": KINDS[kind].code, "kind": kind, "decided": decided, "text": LONG, "time": 12.345,
        "benches": [123, 145], "value": 1.234567, "limit": 0.3, "obstacle": None,
    }  # fmt: skip


def tell(page: Page, *findings: dict[str, Any], named: dict[str, str] | None = None) -> None:
    """Have a verdict come with so many findings, and with a well of a name."""
    decided = not findings or any(one["decided"] for one in findings)
    given = {"safe": not findings, "decided": decided, "findings": findings, "sentence": LONG}
    given |= {"obstacles": [{"name": "well", "shown": named}]} if named else {}
    page.evaluate(TELL, given)


def shown_plan(page: Page) -> Plan:
    return Plan.model_validate(json.loads(page.evaluate("JSON.stringify(benchdragon.plan)")))


def set_up(page: Page, tables: dict[str, Any]) -> None:
    """Give values of the plan's tables others."""
    page.evaluate(
        """(tables) => {
          const plan = structuredClone(benchdragon.plan);
          for (const [name, table] of Object.entries(tables))
            plan[name] = Array.isArray(table) ? table : { ...plan[name], ...table };
          benchdragon.change(plan, true);
        }""",
        tables,
    )
    settled(page)


def remedy(dialog: Locator) -> Locator:
    """What is offered, once all has been looked for."""
    expect(dialog.get_by_text("looking for what mends it")).to_have_count(0)
    return dialog.locator(".remedy")


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("device", ["desktop", "phone"])
def test_the_line_is_in_one_place_whatever_it_says(
    opened: Opened, device: Device, language: Language
) -> None:
    page = opened(device, f"#lang={language}")
    if device == "phone":
        page.set_viewport_size({"width": 320, "height": 640})
        until(page, "innerWidth === 320 && benchdragon.player.camera.width <= 320")
    page.evaluate("scrollTo(0, 0)")
    parts = [page.locator(name) for name in (".verdicts", ".verdict", "canvas", ".panel")]
    told: dict[str, Callable[[], object]] = {
        "safe": lambda: tell(page),
        "unsafe": lambda: tell(page, {**finding("obstacle"), "obstacle": "well"}, named=LONG),
        "tight": lambda: tell(page, finding("people")),
        "old": lambda: page.evaluate(OLD),
        "open": lambda: tell(page, finding("margin", decided=False)),
        "none": lambda: page.evaluate(
            "benchdragon.verdicts.failed(new Error('so long '.repeat(90)), benchdragon.plan)"
        ),
        "": lambda: page.evaluate(
            "() => { const { lines, plan } = benchdragon; lines.verdict.forget();"
            " lines.sentence.forget(); benchdragon.tellFile(plan, ''); }"
        ),
    }
    places, words = [[part.bounding_box() for part in parts]], []
    for state, say in told.items():
        say()
        expect(verdict(page)).to_have_class(f"verdict {state.replace('old', '')}".strip())
        places.append([part.bounding_box() for part in parts])
        words.append(verdict(page).text_content())
        whole = "({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth"
        assert verdict(page).evaluate(whole), words[-1]
    assert all(place == places[0] for place in places)
    assert len(set(words)) == len(told)


@pytest.mark.parametrize(("language", "word"), [("en", "fits"), ("zh", "够")])
def test_nothing_says_fits_where_there_is_a_finding_and_what_was_not_looked_at_is_marked(
    opened: Opened, language: Language, word: str
) -> None:
    page = opened("phone", f"#lang={language}")
    line = verdict(page)
    expect(line).to_contain_text(word)
    expect(line.locator(".unchecked")).to_contain_text("3")
    for kind in KINDS:
        for decided in (True, False):
            tell(page, finding(kind, decided=decided))
            expect(line).not_to_contain_text(word)
            assert not line.evaluate("(one) => one.classList.contains('safe')")
    page.evaluate(TELL, {"safe": True, "decided": True, "findings": [], "not_looked_at": []})
    expect(line).to_contain_text(word)
    expect(line.locator(".unchecked")).to_have_count(0)


def test_benches_that_touch_are_parted_by_the_least_pitch_and_one_step_undoes_it(
    opened: Opened,
) -> None:
    page = opened()
    change(page, PITCH, "0.44")
    settled(page)
    dialog = details(page)
    expect(dialog.locator("h2")).to_have_text("✖ touches")
    expect(dialog.locator(".findings")).to_contain_text("benches 1 and 19 touch at 181.2 s")
    expect(remedy(dialog)).to_have_text("spiral pitch 0.44 → 0.46 mthen: ✓ fits, 3 not checked")
    remedy(dialog).click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(number(page, PITCH)).to_have_value("0.46")
    expect(verdict(page)).to_have_class("verdict safe")
    page.get_by_role("button", name="undo").click()
    expect(number(page, PITCH)).to_have_value("0.44")
    settle(page, "Not safe")


def test_of_findings_about_one_thing_the_gravest_is_told_once(opened: Opened) -> None:
    page = opened()
    kinds = ("obstacle_margin", "obstacle", "sway", "people")
    tell(page, finding("margin", decided=False), *map(finding, kinds))
    texts = details(page).locator(".findings li p")
    expect(texts).to_have_text(
        [
            re.compile("a long"),  # what is undecided stays as it is told
            "bench 123 touches  at 12.3 s",
            "benches 123 and 145 have no room to sway at 12.3 s",
        ]
    )


def test_people_get_room_by_the_least_pitch(opened: Opened) -> None:
    page = opened()
    set_up(page, {"dragon": {"benches": 25}, "people": {"beside": 0.3, "ahead": 0.5}})
    expect(verdict(page)).to_contain_text("too tight")
    dialog = details(page)
    offered = remedy(dialog)
    expect(offered.first).to_contain_text("then: ✓ fits")
    offered.first.click()
    settled(page)
    plan = shown_plan(page)
    pitch = plan.value("route.pitch")
    assert isinstance(pitch, float)
    assert check(plan).safe
    assert not check(plan.with_value("route.pitch", round(pitch - 0.01, 2))).safe


def test_who_is_too_fast_walks_the_same_way_more_slowly(opened: Opened) -> None:
    page = opened()
    page.get_by_label("begin with").select_option("turn")
    set_up(page, {"dragon": {"benches": 20}, "limits": {"speed": 1.5}, "walk": {"speed": 1.4}})
    expect(verdict(page)).to_contain_text("too fast")
    before = shown_plan(page)
    dialog = details(page)
    offered = remedy(dialog)
    expect(offered).to_contain_text("head speed 1.40 → ")
    offered.click()
    settled(page)
    expect(verdict(page)).to_have_class("verdict safe")
    after = shown_plan(page)
    greatest = greatest_head_speed(before).lower
    assert after.walk.speed == pytest.approx(math.floor(20 * greatest) / 20)
    ways = [plan.span(plan.build()) for plan in (before, after)]
    speeds = (before.walk.speed, after.walk.speed)
    stretches = [[speed * time for time in way] for speed, way in zip(speeds, ways, strict=True)]
    assert stretches[0] == pytest.approx(stretches[1])
    page.get_by_role("button", name="undo").click()
    settle(page, "Not safe")
    assert shown_plan(page) == before


def test_what_mends_one_thing_and_breaks_another_is_not_offered(opened: Opened) -> None:
    """Drawn wider, the coil leaves a square that it just fits."""
    page = opened()
    set_up(page, {"limits": {"margin": 0.2}, "dragon": {"benches": 25}})
    dialog = details(page)
    expect(remedy(dialog)).to_have_count(1)
    page.keyboard.press("Escape")
    far = "(({ boxes: { x, y } }) => Math.max(...[...x, ...y].map(Math.abs)))(benchdragon.player)"
    side = 2 * (page.evaluate(far) + 1)
    set_up(page, {"venue": {"rectangle": [side, side]}})
    expect(verdict(page)).to_contain_text("too tight")
    dialog = details(page)
    expect(dialog.locator(".findings li")).to_have_count(1)
    expect(remedy(dialog)).to_have_count(0)
    expect(dialog).to_contain_text("no single change was found that mends it")


def test_a_dance_is_moved_away_from_what_it_touches(opened: Opened) -> None:
    page = opened()
    set_up(page, {"dragon": {"benches": 25}, "venue": {"rectangle": [40, 40]}})
    well = {"kind": "circle", "name": "well", "centre": [-9.2, 0], "radius": 0.5, "margin": 0.3}
    set_up(page, {"obstacle": [well]})
    expect(verdict(page)).to_contain_text("touches")
    before = shown_plan(page)
    offered = remedy(details(page))
    expect(offered).to_contain_text("move the dragon")
    expect(offered).to_contain_text("then: ✓ fits")
    offered.click()
    settled(page)
    after = shown_plan(page)
    assert check(after).safe
    assert after.obstacles() == before.obstacles()
    # No farther than it takes: the place with the most room lies farther away.
    best = page.evaluate(
        """async (plan) => {
          const aside = benchdragon.answers.aside();
          const found = await aside.ask({ question: "place", plan });
          aside.close();
          return found.plan.route.at;
        }""",
        before.data(),
    )
    way, whole = (math.hypot(*at) for at in (page.evaluate("benchdragon.plan.route.at"), best))
    assert 0.0 < way < 0.9 * whole
    page.get_by_role("button", name="undo").click()
    settle(page, "Not safe")
    assert shown_plan(page) == before
