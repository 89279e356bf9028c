"""Stories of a village: a well is dragged too near and mended; all is there again the next day."""

import math
from pathlib import Path

import pytest
from playwright.sync_api import expect

from benchdragon.analysis.check import check
from benchdragon.planner.page import planner_page
from benchdragon.plans.schema import Plan, read_plan
from tests.browser.links import letters
from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import details, settled, verdict
from tests.browser.players import until
from tests.browser.test_planner import shown_plan
from tests.browser.test_planner_bench import MINE, SETTINGS, WORDS, carry, pick
from tests.browser.test_planner_send import PASTE
from tests.browser.test_planner_sheets import NAMES, given, sheets
from tests.browser.test_planner_verdict import remedy

DRAGGED = [
    *("dragon.benches=25", "venue.rectangle=[40, 40]"),
    'obstacle=[{kind="circle", name="well", centre=[-13, 6], radius=0.5, margin=0.3}]',
]
TO = -9.2, 0.0
KEEP = {
    "en": {"plan": "keep the plan in this browser", "names": "keep the names in this browser"},
    "zh": {"plan": "在此浏览器中记住方案", "names": "在此浏览器中记住名单"},
}
FITS = {"en": "fits", "zh": "够"}
LIST = "桥号\t姓名\n4\t张三\n5\t李四\n"


@pytest.mark.parametrize(("device", "language"), [("phone", "zh"), ("desktop", "en")])
def test_a_well_is_dragged_until_it_is_too_near_and_a_button_makes_it_fit_again(
    pages: Pages, tmp_path: Path, device: Device, language: Language
) -> None:
    path = tmp_path / "planner.html"
    path.write_text(planner_page(read_plan("question-3", DRAGGED), language), "utf-8")
    page = settled(pages.open(path.as_uri(), device, language))
    expect(verdict(page)).to_contain_text(FITS[language])
    page.evaluate("benchdragon.grips.element.classList.add('seen'); benchdragon.grips.follow()")
    box = page.locator('[data-grip="obstacle.0"]').bounding_box()
    assert box is not None
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
    scale = page.evaluate("benchdragon.player.camera.scale")
    (_edge, well) = shown_plan(page).obstacles()
    across, up = (scale * (to - at) for to, at in zip(TO, well.outline[0], strict=True))
    page.mouse.move(x, y)
    page.mouse.down()
    for share in (0.3, 0.7, 1.0):
        page.mouse.move(x + share * across, y - share * up)
    page.mouse.up()
    settled(page)
    expect(verdict(page)).not_to_contain_text(FITS[language])
    dragged = shown_plan(page)
    assert not check(dragged).safe
    offered = remedy(details(page)).first
    expect(offered).to_contain_text(FITS[language])
    offered.click()
    settled(page)
    expect(verdict(page)).to_have_class("verdict safe")
    mended = shown_plan(page)
    assert check(mended).safe
    (_edge, well) = mended.obstacles()
    assert well.outline.tolist() == dragged.obstacles()[1].outline.tolist()
    assert math.dist(well.outline[0], TO) < 0.2


@pytest.fixture(scope="module")
def plan() -> Plan:
    return read_plan("turn", SETTINGS)


@pytest.mark.parametrize(("device", "language"), [("phone", "zh"), ("desktop", "en")])
def test_without_a_network_plan_names_and_bench_are_there_again_the_next_day(
    pages: Pages, bare_file: Path, plan: Plan, device: Device, language: Language
) -> None:
    where = f"{bare_file.as_uri()}#lang={language}"
    page = pages.open(where, device, language)
    page.context.set_offline(True)
    until(page, "!!globalThis.benchdragon?.player")
    page.evaluate(PASTE, letters(plan))
    expect(page.locator(".wishes")).to_be_hidden()
    settled(page)
    page.get_by_role("checkbox", name=KEEP[language]["plan"]).check()
    page.get_by_role("button", name=NAMES[language], exact=True).click()
    given(page, LIST)
    sheets(page).get_by_role("checkbox", name=KEEP[language]["names"]).check()
    page.keyboard.press("Escape")
    pick(carry(page, language), language)
    page.close()

    page = page.context.new_page()
    page.goto(where)
    settled(page)
    assert shown_plan(page).sha256 == plan.sha256
    mine = carry(page, language)
    chosen = mine.get_by_role("combobox", name=WORDS[language]["which"])
    expect(chosen).to_have_value(str(MINE))
    expect(chosen.locator(":checked")).to_contain_text("张三")
    expect(mine.locator(".around")).to_contain_text("李四")
    expect(mine.locator(".now strong")).not_to_be_empty()
