"""The studio in a browser: a plan is changed, judged, watched, asked about at length, saved, opened."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import expect

from benchdragon.plans.schema import read_plan
from tests.browser.pages import Device, Language, Pages
from tests.browser.studios import Opened, change, number, settle, settled, verdict

SENTENCES = {
    "en": ("Safe: tightest", "Not safe: benches"),
    "zh": ("安全：最紧处", "不安全：第"),
}
PITCH = {"en": "spiral pitch", "zh": "螺距"}


@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_the_verdict_turns_between_a_pitch_of_46_and_of_44_cm(
    opened: Opened, device: Device, language: Language
) -> None:
    """The disc has a radius of 4.5 m; the smallest pitch lies between."""
    page = opened(device, language)
    good, bad = SENTENCES[language]
    slider = page.get_by_role("slider", name=PITCH[language])
    slider.fill("0.46")
    settle(page, f"{good} (9.6|0.96)")
    slider.fill("0.44")
    settle(page, f"{bad}.*181.2 s")
    expect(verdict(page)).to_have_class("verdict unsafe")
    expect(page.locator(".limit")).to_have_text(re.compile(r"0\.4503"))
    slider.fill("0.46")
    settle(page, good)
    wide = page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert wide


def test_the_evidence_is_one_click_away_and_leads_to_the_moment(opened: Opened) -> None:
    page = opened()
    number(page, "spiral pitch").fill("0.44")
    number(page, "spiral pitch").press("Enter")
    settle(page, "Not safe")
    expect(page.locator("#studio")).to_have_attribute("aria-busy", "false")
    verdict(page).click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("181.196253")
    expect(dialog).to_contain_text("found")
    dialog.get_by_role("button", name=re.compile("benches 1 and 19")).first.click()
    expect(dialog).to_have_count(0)
    expect(page.locator(".clock")).to_have_text("t = 181.20 s")


def test_steps_go_back_and_forth_and_all_stands_in_the_address(opened: Opened) -> None:
    page = opened()
    benches = number(page, "number of benches")
    undo, redo = (page.get_by_role("button", name=name) for name in ("undo", "redo"))
    expect(undo).to_be_disabled()
    benches.fill("60")
    benches.press("Enter")
    expect(undo).to_be_enabled()
    undo.click()
    expect(benches).to_have_value("223")
    redo.click()
    expect(benches).to_have_value("60")
    settle(page, "Safe")
    expect(page.locator("#studio")).to_have_attribute("aria-busy", "false")
    page.reload()
    expect(number(page, "number of benches")).to_have_value("60")
    page.get_by_role("button", name="中文").click()
    expect(page.get_by_role("button", name="撤销")).to_be_visible()
    settle(page, "安全")
    expect(page).to_have_url(re.compile("&lang=zh"))


def test_a_wrong_plan_is_told_in_one_sentence_and_loses_nothing(opened: Opened, pages: Pages) -> None:
    page = opened()
    width = number(page, "width of a bench")
    width.fill("-1")
    width.press("Enter")
    settle(page, r"No verdict: plan: dragon\.width: wanted more than 0")
    expect(verdict(page)).to_have_class("verdict none")
    expect(page.locator("canvas")).to_be_visible()
    page.get_by_role("button", name="undo").click()
    settle(page, "Safe")
    assert pages.faults
    assert all("422" in fault for fault in pages.faults)
    pages.faults.clear()


def test_a_dance_that_cannot_be_shown_is_said_beside_its_verdict(opened: Opened, pages: Pages) -> None:
    page = opened()
    settle(page, "Safe")
    page.route("**/api/dance*", lambda route: route.fulfill(status=422, json={"error": "too long"}))
    width = number(page, "width of a bench")
    width.fill("0.31")
    width.press("Enter")
    expect(page.locator(".verdicts")).to_contain_text("This plan cannot be shown: too long")
    settle(page, "Safe")
    page.unroute("**/api/dance*")
    page.get_by_role("button", name="undo").click()
    expect(page.locator(".verdicts")).not_to_contain_text("cannot be shown")
    pages.forgive_refusals()


def test_a_long_question_is_followed_and_cancelled(opened: Opened) -> None:
    page = opened()
    page.get_by_label("begin with").select_option("turn")
    settle(page, "Safe: tightest 27.9 cm, bench 1 with bench 17")
    page.get_by_role("button", name="best turn").click()
    job = page.locator(".jobs li").first
    expect(job.get_by_role("progressbar")).to_be_visible()
    expect(job).to_have_attribute("data-state", "running")
    job.get_by_role("button", name="cancel").click()
    expect(job).to_contain_text("cancelled")
    page.get_by_role("button", name="greatest head speed").click()
    expect(page.locator(".jobs li").first).to_contain_text("1.246266358 m/s (found)")


def test_another_kind_of_turn_takes_along_what_belonged_to_the_former(opened: Opened) -> None:
    page = opened()
    page.get_by_label("begin with").select_option("turn")
    settle(page, "Safe: tightest 27.9 cm")
    page.get_by_label("kind of turn").select_option("arc-line-arc")
    settle(page, "Safe: tightest (?!27.9)")
    page.get_by_label("kind of turn").select_option("arc-arc-arc")
    expect(number(page, "curvature of the middle arc")).to_have_value("0")
    page.get_by_label("kind of turn").select_option("arc-arc")
    settle(page, "Safe: tightest 27.9 cm")
    expect(number(page, "ratio of the radii")).to_have_value("2")
    expect(number(page, "ratio of the radii")).to_be_enabled()


def test_a_plan_is_saved_and_opened_again(opened: Opened, tmp_path: Path, pages: Pages) -> None:
    page = opened()
    number(page, "spiral pitch").fill("0.61")
    number(page, "spiral pitch").press("Enter")
    with page.expect_download() as saved:
        page.get_by_role("button", name="save the plan file").click()
    path = tmp_path / saved.value.suggested_filename
    saved.value.save_as(path)
    assert path.name == "dance.dragon.toml"
    assert read_plan(str(path)).value("route.pitch") == 0.61
    page.get_by_role("button", name="reset").click()
    expect(number(page, "spiral pitch")).to_have_value("0.55")
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="open a plan file").click()
    chooser.value.set_files(path)
    expect(number(page, "spiral pitch")).to_have_value("0.61")
    path.write_text("schema = 1\n[route]\nkind = 'spiral-in'\npich = 1\n", "utf-8")
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="open a plan file").click()
    chooser.value.set_files(path)
    expect(page.locator("output.told").last).to_contain_text("did you mean route.pitch")
    expect(number(page, "spiral pitch")).to_have_value("0.61")
    pages.forgive_refusals()


def test_the_player_is_exported_as_a_page_of_its_own(
    opened: Opened, tmp_path: Path, pages: Pages
) -> None:
    page = opened()
    page.get_by_label("file to export").select_option("player.html")
    with page.expect_download() as saved:
        page.get_by_role("button", name="export", exact=True).click()
    path = tmp_path / saved.value.suggested_filename
    saved.value.save_as(path)
    alone = pages.open(path.as_uri())
    expect(alone.locator("canvas")).to_be_visible()
    expect(alone.locator(".summary")).to_contain_text("Safe: tightest 9.94 cm")


def test_every_control_has_a_name(opened: Opened) -> None:
    page = opened()
    nameless = page.evaluate(
        """() => [...document.querySelectorAll("button, select, input:not([hidden])")]
          .filter((one) => one.checkVisibility() && !one.ariaLabel && !one.textContent.trim())
          .filter((one) => !one.labels?.[0]?.textContent.trim())
          .map((one) => one.outerHTML)"""
    )
    assert nameless == []


def test_an_odd_address_does_no_harm(opened: Opened) -> None:
    page = opened(where="#t=soon&bench=x")
    expect(page.locator(".clock")).to_have_text("t = 0.00 s")


def test_keys_move_a_slider_of_the_plan_and_not_the_time(opened: Opened) -> None:
    page = opened()
    slider = page.get_by_role("slider", name="spiral pitch")
    for _n in range(3):
        slider.press("ArrowRight")
    expect(number(page, "spiral pitch")).to_have_value("0.556")
    expect(page.locator(".clock")).to_have_text("t = 0.00 s")


def test_an_emptied_box_shows_the_plan_again(opened: Opened) -> None:
    page = opened()
    width = number(page, "width of a bench")
    width.fill("")
    width.press("Enter")
    expect(width).to_have_value("0.3")


def test_another_dance_is_in_sight(opened: Opened) -> None:
    """The dragon of Nanchang is twice as wide as the contest's."""
    page = opened()
    page.get_by_label("begin with").select_option("nanchang")
    expect(page.locator("h1")).to_have_text("Nanchang")
    far = page.evaluate(
        """() => { const { boxes, camera } = benchdragon.player;
          return Array.from(boxes.x, (x, n) => camera.toScreen(x, boxes.y[n]))
            .filter(([px, py]) => Math.min(px, py) < 0 || px > camera.width || py > camera.height)
            .length; }"""
    )
    assert far == 0


def test_what_is_refused_is_said_once_and_its_old_picture_too(opened: Opened, pages: Pages) -> None:
    page = opened()
    number(page, "number of benches").fill("1e9")
    number(page, "number of benches").press("Enter")
    settle(page, "wanted at most 1000000")
    expect(page.get_by_text("the picture is of an earlier plan")).to_be_visible()
    assert page.get_by_text("wanted at most").filter(visible=True).count() == 1
    page.locator("h1").click()
    page.keyboard.press("Control+z")
    settle(page, "Safe")
    expect(page.locator(".limit")).to_have_text("smallest pitch: 0.450337 m (found)")
    pages.forgive_refusals()


def test_an_address_put_into_the_same_window_is_gone_to(opened: Opened) -> None:
    page = opened()
    page.wait_for_url(re.compile("plan="))
    before = page.url
    number(page, "number of benches").fill("60")
    number(page, "number of benches").press("Enter")
    page.wait_for_url(lambda url: url != before)
    page.goto(before)
    expect(number(page, "number of benches")).to_have_value("223")


def test_a_long_question_changes_its_language_with_the_page(opened: Opened) -> None:
    page = opened()
    page.get_by_role("button", name="prove the verdict").click()
    job = page.locator(".jobs li")
    expect(job).to_contain_text("Proved")
    page.get_by_role("button", name="中文").click()
    expect(job).to_contain_text("证明结论")
    expect(job).to_contain_text("已证明")


def test_the_evidence_of_a_dance_without_contact(opened: Opened) -> None:
    page = opened("desktop", "zh")
    settle(page, "安全")
    verdict(page).click()
    expect(page.get_by_role("row", name="首次碰撞")).to_contain_text("不会发生")


def test_the_evidence_of_a_dance_on_a_square(opened: Opened) -> None:
    """Its rows tell the edge and the well, and what bars the way whatever the pitch is told soon."""
    page = settled(opened())
    page.evaluate(
        """() => {
          const plan = structuredClone(benchdragon.plan);
          plan.venue = { rectangle: [40, 30] };
          plan.obstacle = [{ kind: "circle", name: "well", centre: [9, 0], radius: 0.5 }];
          benchdragon.change(plan, true);
        }"""
    )
    settle(page, "bench 1 touches well at 0.0 s")
    expect(page.locator(".limit")).to_have_text(re.compile("no solution"))
    verdict(page).click()
    rows = page.get_by_role("row")
    expect(rows.filter(has_text="well").first).to_be_visible()
    expect(rows.filter(has_text="the edge of the venue").first).to_be_visible()


@pytest.mark.parametrize(
    ("device", "language"), [("desktop", "en"), ("desktop", "zh"), ("phone", "en")]
)
def test_with_all_limits_set_the_controls_and_the_evidence_stay_in_sight(
    opened: Opened, device: Device, language: Language
) -> None:
    page = opened(device, language)
    page.evaluate(
        """() => {
          const plan = structuredClone(benchdragon.plan);
          Object.assign(plan.limits, {
            speed: 2, acceleration: 1, lateral_acceleration: 1, total_acceleration: 1, turning_rate: 60,
          });
          benchdragon.change(plan, true);
        }"""
    )
    expect(verdict(page)).to_have_text(re.compile("rad/s"))
    assert page.evaluate("document.querySelector('.verdicts').offsetHeight < 0.25 * innerHeight")
    verdict(page).click()
    if device == "desktop":
        assert page.evaluate(
            "(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)"
            "(document.querySelector('.evidence .scroll'))"
        )
    else:
        expect(page.get_by_role("dialog")).to_contain_text("rad/s")


def test_people_who_are_not_exact_need_more_than_a_millimetre(opened: Opened) -> None:
    """With 0.7 mm between benches random dances touch."""
    page = opened()
    change(page, "number of benches", "30")  # two coils before the disc, and little to compute
    change(page, "spiral pitch", "0.451")
    page.get_by_role("button", name="tolerance for people who are not exact").click()
    job = page.locator(".jobs li")
    expect(job).to_contain_text(re.compile(r"[1-9].* % of 100 random dances touch; at most"))
