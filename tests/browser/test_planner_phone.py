"""The story of a phone: a file from a chat is opened, a dance planned on a square, sent, printed."""

from pathlib import Path

from playwright.sync_api import expect

from benchdragon.plans.schema import read_plan
from benchdragon.rosters.roster import Roster
from tests.browser.pages import Pages
from tests.browser.planners import change, settled
from tests.browser.players import until
from tests.browser.test_planner import shown_plan
from tests.browser.test_planner_share import ADDRESS, SENDING, shared
from tests.browser.test_planner_sheets import NAMES, assert_says, printed, sheets, told
from tests.browser.village import PLAN, village

SQUARE = """
[venue]
rectangle = [16, 14]
[[obstacle]]
kind = "circle"
name = "水井"
centre = [6.5, 5]
radius = 0.6
"""


def test_a_phone_plans_a_dance_on_a_square_sends_it_and_prints_a_sheet(
    pages: Pages, file: Path, tmp_path: Path
) -> None:
    plan = village(tmp_path, PLAN + SQUARE)
    page = settled(pages.open(f"{file.as_uri()}#lang=zh", "phone", "zh"))
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="打开方案文件").click()
    chooser.value.set_files(plan)
    expect(page.locator(".verdict")).to_have_class("verdict safe")
    change(page, "螺距", "1.25")
    until(page, "benchdragon.plan.route.pitch === 1.25")
    until(page, f"benchdragon.verdict.found.plan_sha256 === '{shown_plan(page).sha256}'")
    expect(page.locator(".verdict")).to_have_class("verdict safe")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")

    page.evaluate(SENDING)
    dialog = shared(page, "zh")
    link = dialog.locator("code").text_content() or ""
    dialog.get_by_role("button", name="关闭").click()
    # Whoever gets the link opens it where the file lies on the web.
    other = settled(pages.open(f"{ADDRESS}{link}&lang=zh", "phone", "zh", served=file))
    assert shown_plan(other).sha256 == shown_plan(page).sha256

    other.get_by_role("button", name=NAMES["zh"], exact=True).click()
    sheets(other).get_by_role("combobox", name="哪些板凳").select_option("3")
    (text,) = printed(other)
    plan.write_text(plan.read_text("utf-8").replace("pitch = 1.2", "pitch = 1.25"), "utf-8")
    assert read_plan(str(plan)).sha256 == shown_plan(other).sha256
    assert_says(text, told(plan, "zh", Roster())[2])
