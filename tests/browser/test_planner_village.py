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
        "sheets": "benches' sheets",
    },
    "zh": {
        "benches": "板凳", "each": "板凳的长度", "length": "长", "width": "宽",
        "under": "下面", "find": "给我们排一场", "ours": "我的板凳", "sheets": "板凳单",
    },
}  # fmt: skip
ANSWERS = {"benches": "60", "each": "1.5", "length": "30", "width": "20"}
WELL = 4.0, -3.0


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
    for name, text in ANSWERS.items():
        box = page.get_by_role("textbox", name=leader.words[name], exact=True)
        leader.tap(box)
        box.fill(text)
    leader.tap(page.get_by_role("radio", name=leader.words["under"]))
    leader.find()
    leader.tap(page.locator('[data-add="well"]'))
    leader.taps += 1
    tap_ground(page, *WELL, device)
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
