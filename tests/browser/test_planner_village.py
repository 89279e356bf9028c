"""A village's leader, from the empty page to papers: every tap is counted."""

import io
import json
from pathlib import Path

import pypdfium2
import pytest
from playwright.sync_api import Locator, Page, expect

from benchdragon.analysis.check import check
from benchdragon.plans.schema import checked
from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import settled, verdict
from tests.browser.players import until
from tests.browser.test_planner_square import tap as tap_ground

MOST_TAPS = 15
WORDS = {
    "en": {
        "benches": "Benches", "each": "Length of a bench", "length": "length", "width": "width",
        "under": "under it", "find": "Find our dance", "ours": "my benches",
        "sheets": "benches' sheets", "rounds": "rounds in and out", "done": "done",
        "between": "+ rest between the rounds",
    },
    "zh": {
        "benches": "板凳", "each": "板凳的长度", "length": "长", "width": "宽",
        "under": "下面", "find": "给我们排一场", "ours": "我的板凳", "sheets": "板凳单",
        "rounds": "盘进盘出几轮", "done": "完成", "between": "+ 每两轮之间歇一歇",
    },
}  # fmt: skip
ANSWERS = {"benches": "60", "each": "1.5", "length": "30", "width": "20"}
WELL = 4.0, -3.0
STREET = (-21.0, -16.0), (-8.0, -16.0), (2.0, -15.0)
TABLE = -10.0, -15.5


class Leader:
    """Who taps, and counts it."""

    def __init__(self, page: Page, language: Language, device: Device) -> None:
        self.page, self.device, self.taps = page, device, 0
        self.words = WORDS[language]

    def tap(self, one: Locator) -> None:
        self.taps += 1
        if self.device == "phone":
            one.tap()
        else:
            one.click()

    def button(self, name: str) -> None:
        self.tap(self.page.get_by_role("button", name=self.words[name], exact=True))

    def answer(self, answers: dict[str, str]) -> None:
        """Type into the boxes of the questions; bearers walk under their benches."""
        for name, text in answers.items():
            box = self.page.get_by_role("textbox", name=self.words[name], exact=True)
            self.tap(box)
            box.fill(text)
        self.tap(self.page.get_by_role("radio", name=self.words["under"]))

    def tap_ground(self, *places: tuple[float, float]) -> None:
        """Tap places of the ground in the picture, m."""
        for x, y in places:
            self.taps += 1
            tap_ground(self.page, x, y, self.device)

    def find(self) -> None:
        """Have a dance found, and wait until it walks."""
        before = self.page.evaluate("JSON.stringify(benchdragon.plan)")
        self.button("find")
        until(self.page, f"JSON.stringify(benchdragon.plan) !== {json.dumps(before)}")
        settled(self.page)


@pytest.mark.parametrize(("device", "language"), [("phone", "zh"), ("desktop", "en")])
def test_from_the_empty_page_to_sixty_benches_beside_a_well_and_their_papers(
    pages: Pages, bare_file: Path, device: Device, language: Language
) -> None:
    page = pages.open(f"{bare_file.as_uri()}#lang={language}", device, language)
    until(page, "!!globalThis.benchdragon?.player")
    leader = Leader(page, language, device)
    leader.answer(ANSWERS)
    leader.find()
    leader.tap(page.locator('[data-add="well"]'))
    leader.tap_ground(WELL)
    until(page, "benchdragon.plan.obstacle?.length === 1")
    leader.button("ours")
    leader.find()
    plan = checked(page.evaluate("benchdragon.plan"), "page")
    assert plan.value("dragon.benches") == 60
    (_edge, well) = plan.obstacles()
    assert well.outline[0] == pytest.approx(WELL, abs=0.11)
    assert check(plan).safe
    expect(verdict(page)).to_have_class("verdict safe")
    leader.button("sheets")
    expect(page.locator("#sheets .paper")).to_have_count(60, timeout=60_000)
    assert leader.taps <= MOST_TAPS
    made = pypdfium2.PdfDocument(io.BytesIO(page.pdf(prefer_css_page_size=True)))
    assert len(made) == 60


@pytest.mark.parametrize(("device", "language"), [("phone", "zh"), ("desktop", "en")])
def test_a_street_and_then_three_rounds_with_rests_are_made_in_the_page_and_walked(
    pages: Pages, bare_file: Path, device: Device, language: Language
) -> None:
    page = pages.open(f"{bare_file.as_uri()}#lang={language}", device, language)
    page.emulate_media(reduced_motion="reduce")
    until(page, "!!globalThis.benchdragon?.player")
    leader = Leader(page, language, device)
    leader.answer({**ANSWERS, "length": "46", "width": "36"})
    leader.find()
    box = page.get_by_role("textbox", name=leader.words["rounds"], exact=True)
    leader.tap(box)
    box.fill("3")
    box.press("Enter")
    until(page, "benchdragon.plan.route.rounds === 3")
    settled(page)
    leader.tap(page.locator('[data-add="street"]'))
    leader.tap_ground(*STREET)
    leader.button("done")
    until(page, "benchdragon.plan.route.street?.points.length === 3")
    settled(page)
    leader.tap(page.locator('[data-add="rest"]'))
    leader.tap_ground(TABLE)
    leader.button("between")
    until(page, "benchdragon.plan.cues?.cue.length === 3")
    settled(page)
    expect(verdict(page)).to_have_class("verdict safe")
    plan = checked(page.evaluate("benchdragon.plan"), "page")
    assert page.evaluate("benchdragon.verdict.found.plan_sha256") == plan.sha256
    report = check(plan)
    assert report.safe
    assert len([one for one in report.stops or () if one.end - one.start > 59.0]) == 3
    walk = report.walk
    assert walk.route.point(walk.start) == pytest.approx(STREET[0], abs=0.2)
    assert page.evaluate("benchdragon.player.scene.end") == pytest.approx(report.end, abs=0.1)
    page.evaluate("(time) => benchdragon.player.jump(time)", report.end - 60.0)
    head = page.evaluate("benchdragon.player.scene.end - benchdragon.player.time")
    assert head == pytest.approx(60.0, abs=0.5)
