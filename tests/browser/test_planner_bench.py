"""My bench: a bearer picks his bench once, and a phone tells his way while the dance walks."""

import math
from itertools import pairwise
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from benchdragon.analysis.bench_walks import BenchWalk, bench_walks
from benchdragon.explain.bench_text import doing, people_lines
from benchdragon.i18n import _, spoken_in
from benchdragon.plans.people import called
from benchdragon.plans.schema import Plan, read_plan
from tests.browser.axe import needs_axe, violations
from tests.browser.links import letters
from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import settled
from tests.browser.players import until
from tests.browser.test_player_looks import BLOCKED

ADDRESS = "https://dance.example/planner.html"
# A dance with bends to both sides, whose head waits, of a village whose head has no number.
SETTINGS = [
    *("dragon.benches=12", "walk.start=-20", "walk.end=40", "people.count_head=false"),
    *('people.unit="qiao"', 'cues.cue=[{kind="hold", at=2, hold=4}]'),
]
MINE = 5
WORDS = {
    "en": {"carry": "I carry a bench", "which": "the bench that I carry", "close": "close"},
    "zh": {"carry": "我抬板凳", "which": "我抬的板凳", "close": "关闭"},
}


@pytest.fixture(scope="module")
def plan() -> Plan:
    return read_plan("turn", SETTINGS)


@pytest.fixture(scope="module")
def walk(plan: Plan) -> BenchWalk:
    """What the bench does, as papers tell it."""
    built = plan.build()
    return bench_walks(plan, built, plan.span(built))[MINE - 1]


def carry(page: Page, language: Language) -> Locator:
    page.get_by_role("button", name=WORDS[language]["carry"], exact=True).click()
    return page.locator(".mine")


def pick(mine: Locator, language: Language) -> None:
    mine.get_by_role("combobox", name=WORDS[language]["which"]).select_option(str(MINE))


def at(page: Page, mine: Locator, walk: BenchWalk, language: Language) -> None:
    """The phone tells at many times what papers tell."""
    for one, after in pairwise(walk.stretches):
        for time in (one.start + 0.618 * (one.end - one.start), one.end - 0.4):
            page.evaluate("(time) => benchdragon.player.put(time)", time)
            with spoken_in(language):
                seconds = math.ceil(one.end - time)
                then = _("in {seconds} s: {doing}").format(seconds=seconds, doing=doing(after))
                expect(mine.locator(".next")).to_have_text(then)
                expect(mine.locator(".now strong")).to_have_text(doing(one))


@needs_axe
@pytest.mark.parametrize(("device", "language"), [("phone", "zh"), ("desktop", "en")])
def test_a_bearer_opens_a_link_picks_a_bench_and_follows_it(
    pages: Pages, bare_file: Path, plan: Plan, walk: BenchWalk, device: Device, language: Language
) -> None:
    link = f"{ADDRESS}#plan={letters(plan)}&lang={language}"
    page = settled(pages.open(link, device, language, served=bare_file))
    mine = carry(page, language)
    pick(mine, language)
    at(page, mine, walk, language)
    with spoken_in(language):
        around = people_lines(walk, lambda bench: called(plan.people, bench, 12))
    expect(mine.locator(".around")).to_have_text("".join(around))
    assert violations(page) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert page.evaluate("document.documentElement.scrollHeight <= innerHeight")
    page.evaluate("benchdragon.player.put(benchdragon.player.scene.start)")
    page.locator(".controls .play").click()
    until(page, "benchdragon.player.time > benchdragon.player.scene.start + 0.2")
    # In one, as it goes on walking: the camera is where the bench is.
    bench = f"[boxes.x[{MINE - 1}], boxes.y[{MINE - 1}]]"
    seen = page.evaluate(
        f"(({{ camera, boxes }}) => [{bench}, [camera.x, camera.y]])(benchdragon.player)"
    )
    assert seen[0] == pytest.approx(seen[1], abs=0.1)
    expect(page.locator(".controls [aria-pressed]")).to_be_visible()
    mine.get_by_role("button", name=WORDS[language]["close"]).click()
    expect(mine).to_be_hidden()
    expect(page.locator(".panel")).to_be_visible()


def test_what_a_browser_does_not_keep_stands_in_the_address(
    pages: Pages, bare_file: Path, plan: Plan
) -> None:
    page = pages.open(ADDRESS, served=bare_file)
    page.add_init_script(BLOCKED)
    page.goto("about:blank")
    page.goto(f"{ADDRESS}#plan={letters(plan)}")
    settled(page)
    pick(carry(page, "en"), "en")
    until(page, f"location.hash.includes('mine={MINE}')")
    page.reload()
    settled(page)
    chosen = carry(page, "en").get_by_role("combobox", name=WORDS["en"]["which"])
    expect(chosen).to_have_value(str(MINE))


def test_a_dance_that_cannot_be_told_says_why(pages: Pages, bare_file: Path, plan: Plan) -> None:
    page = settled(pages.open(f"{bare_file.as_uri()}#plan={letters(plan)}", "phone"))
    page.evaluate(
        """() => {
          const aside = benchdragon.answers.aside;
          benchdragon.answers.aside = () => {
            const lane = aside.call(benchdragon.answers);
            const ask = lane.ask.bind(lane);
            lane.ask = (asked) => ask({ ...asked, plan: { ...asked.plan, dragon: { benches: 0 } } });
            return lane;
          };
        }"""
    )
    mine = carry(page, "en")
    pick(mine, "en")
    expect(mine.locator(".now strong")).to_contain_text("dragon.benches: expected at least 1")
    expect(mine.locator(".next")).to_be_empty()
