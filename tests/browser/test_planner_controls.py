"""The planner's controls: evidence, steps back, sizes, kinds of turns, keys, long questions' words."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import expect

from tests.browser.pages import Device
from tests.browser.planners import (
    PITCH,
    Opened,
    address,
    change,
    details,
    number,
    settle,
    settled,
    text_of,
    verdict,
)
from tests.browser.players import until


def test_the_evidence_is_one_click_away_and_leads_to_the_moment(opened: Opened) -> None:
    page = opened()
    change(page, PITCH, "0.44")
    settled(page)
    verdict(page).click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("181.196253")
    expect(dialog).to_contain_text("found")
    dialog.locator("summary").click()
    dialog.get_by_role("button", name=re.compile("benches 1 and 19")).first.click()
    expect(dialog).to_have_count(0)
    expect(page.locator(".clock")).to_have_text("t = 181.20 s")


def test_steps_go_back_and_forth_and_all_stands_in_the_address(opened: Opened) -> None:
    page = opened()
    first = address(page)
    benches = number(page, "number of benches")
    undo, redo = (page.get_by_role("button", name=name) for name in ("undo", "redo"))
    expect(undo).to_be_disabled()
    change(page, "number of benches", "60")
    expect(undo).to_be_enabled()
    undo.click()
    expect(benches).to_have_value("223")
    redo.click()
    expect(benches).to_have_value("60")
    before = address(page, first)
    page.reload()
    expect(number(page, "number of benches")).to_have_value("60")
    settled(page)
    change(page, "number of benches", "50")
    address(page, before)
    page.goto(before)  # in the same window
    expect(benches).to_have_value("60")
    change(page, "number of benches", "50")
    page.get_by_role("button", name="reset").click()
    expect(benches).to_have_value("60")  # which the page was loaded with


def test_a_wrong_plan_is_told_in_one_sentence_and_loses_nothing(opened: Opened) -> None:
    page = opened()
    change(page, "width of a bench", "-1")
    settle(page, r"No verdict: plan: dragon\.width: expected more than 0")
    expect(verdict(page)).to_have_class("verdict none")
    expect(page.locator("canvas")).to_be_visible()
    expect(page.get_by_text("the picture is of an earlier plan")).to_be_visible()
    assert page.get_by_text("expected more than").filter(visible=True).count() == 1
    page.locator(".player h1").click()
    page.keyboard.press("Control+z")
    settle(page, "Safe")


def test_another_kind_of_turn_takes_along_what_belonged_to_the_former(opened: Opened) -> None:
    page = opened()
    page.get_by_label("begin with").select_option("turn")
    settle(page, "Safe: tightest 0.279 m")
    page.get_by_label("kind of turn").select_option("arc-line-arc")
    settle(page, "Safe: tightest (?!0.279)")
    page.get_by_label("kind of turn").select_option("arc-arc-arc")
    expect(number(page, "curvature of the middle arc")).to_have_value("0")
    page.get_by_label("kind of turn").select_option("arc-arc")
    settle(page, "Safe: tightest 0.279 m")
    expect(number(page, "ratio of the radii")).to_have_value("2")
    expect(number(page, "ratio of the radii")).to_be_enabled()


def test_every_control_has_a_name(opened: Opened) -> None:
    page = opened()
    nameless = page.evaluate(
        """() => [...document.querySelectorAll("button, select, input:not([hidden])")]
          .filter((one) => one.checkVisibility() && !one.ariaLabel && !one.textContent.trim())
          .filter((one) => !one.labels?.[0]?.textContent.trim())
          .map((one) => one.outerHTML)"""
    )
    assert nameless == []


def test_keys_move_a_slider_of_the_plan_and_not_the_time_and_an_emptied_box_is_filled(
    opened: Opened,
) -> None:
    page = opened(where="#t=soon&bench=x")  # an odd address does no harm
    slider = page.get_by_role("slider", name=PITCH)
    for _n in range(3):
        slider.press("ArrowRight")
    expect(number(page, PITCH)).to_have_value("0.556")
    expect(page.locator(".clock")).to_have_text("t = 0.00 s")
    change(page, "width of a bench", "")
    expect(number(page, "width of a bench")).to_have_value("0.3")


def test_another_dance_is_in_sight(opened: Opened) -> None:
    """The dragon of Nanchang is twice as wide as the contest's."""
    page = opened()
    page.get_by_label("begin with").select_option("nanchang")
    expect(page.locator(".player h1")).to_have_text("Nanchang")
    far = page.evaluate(
        """() => { const { boxes, camera } = benchdragon.player;
          return Array.from(boxes.x, (x, n) => camera.toScreen(x, boxes.y[n]))
            .filter(([px, py]) => Math.min(px, py) < 0 || px > camera.width || py > camera.height)
            .length; }"""
    )
    assert far == 0


def test_a_long_question_and_the_evidence_change_their_language_with_the_page(opened: Opened) -> None:
    page = opened()
    change(page, "number of benches", "20")
    settled(page)
    page.get_by_role("button", name="greatest head speed").click()
    job = page.locator(".jobs li")
    expect(job).to_contain_text("about this plan")
    page.get_by_role("button", name="中文").click()
    expect(job).to_contain_text("龙头最大速度")
    expect(job).to_contain_text("针对当前方案")
    settle(page, "安全")
    details(page).locator("summary").click()
    expect(page.get_by_role("row", name="首次碰撞")).to_contain_text("不会发生")


def test_the_evidence_of_a_dance_on_a_square(opened: Opened) -> None:
    """Its rows tell the edge and the well."""
    page = opened()
    page.evaluate(
        """() => {
          const plan = structuredClone(benchdragon.plan);
          plan.venue = { rectangle: [40, 30] };
          plan.obstacle = [{ kind: "circle", name: "well", centre: [9, 0], radius: 0.5 }];
          benchdragon.change(plan, true);
        }"""
    )
    settle(page, "bench 1 touches well at 0 s")
    details(page).locator("summary").click()
    rows = page.get_by_role("row")
    expect(rows.filter(has_text="well").first).to_be_visible()
    expect(rows.filter(has_text="the edge of the venue").first).to_be_visible()


@pytest.mark.parametrize(
    ("device", "language"), [("desktop", "en"), ("desktop", "zh"), ("phone", "en")]
)
def test_with_all_limits_set_the_controls_and_the_evidence_stay_in_sight(
    opened: Opened, device: Device, language: str
) -> None:
    page = opened(device, f"#lang={language}")
    page.evaluate(
        """() => {
          const plan = structuredClone(benchdragon.plan);
          Object.assign(plan.limits, {
            speed: 2, acceleration: 1, lateral_acceleration: 1, total_acceleration: 1, turning_rate: 60,
          });
          benchdragon.change(plan, true);
        }"""
    )
    settle(page, "rad/s")
    details(page).locator("summary").click()
    if device == "desktop":
        assert page.evaluate(
            "(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)"
            "(document.querySelector('.evidence .scroll'))"
        )
    else:
        expect(page.get_by_role("dialog")).to_contain_text("rad/s")


def test_an_address_that_is_being_read_is_not_written_over(opened: Opened) -> None:
    """The page comes to rest while it unfolds what an address holds that was put into its window."""
    page = opened()
    address(page)
    other = "plan=" + text_of(b'["nosuch", {}]')
    page.evaluate(
        """(other) => {
          const slowly = (readable) => readable.pipeThrough(new TransformStream({
            async transform(piece, out) {
              benchdragon.player.onSettled();
              for (let turn = 0; turn < 5; turn++) await new Promise((done) => setTimeout(done));
              out.enqueue(piece);
            },
          }));
          const made = globalThis.DecompressionStream;
          globalThis.DecompressionStream = class extends made {
            get readable() { return slowly(super.readable); }
          };
          location.hash = other;
        }""",
        other,
    )
    expect(page.get_by_role("alert").locator("code")).to_have_text('["nosuch", {}]')
    assert page.url.endswith(other)


@pytest.mark.parametrize("size", [(390, 844), (844, 390), (320, 640), (1366, 768)])
def test_nothing_lies_over_the_picture_but_what_changes_it(
    opened: Opened, size: tuple[int, int]
) -> None:
    page = opened()
    page.set_viewport_size({"width": size[0], "height": size[1]})
    stage = "document.querySelector('.stage').getBoundingClientRect()"
    until(page, f"innerWidth === {size[0]} && benchdragon.player.camera.width === {stage}.width")
    expect(page.get_by_role("button", name="The tightest moment")).to_be_visible()
    over = page.evaluate(
        """() => {
          const seen = document.querySelector(".stage").getBoundingClientRect();
          const apart = (box) => box.right <= seen.left + 0.5 || box.left >= seen.right - 0.5
            || box.bottom <= seen.top + 0.5 || box.top >= seen.bottom - 0.5;
          return [...document.querySelectorAll(".player :is(button, summary, input, select, h1, p)")]
            .filter((one) => one.checkVisibility() && !one.closest(".views, .spoken"))
            .filter((one) => !apart(one.getBoundingClientRect()))
            .map((one) => one.outerHTML);
        }"""
    )
    assert over == []
    sides = page.evaluate("(({ width, height }) => [width, height])(benchdragon.player.camera)")
    assert min(sides) >= 200


@pytest.mark.parametrize(
    ("typed", "length"), [("150cm", 1.5), ("1\u7c735", 1.5), ("\u4e00\u7c73\u516b", 1.8), ("1.7", 1.7)]
)
def test_a_length_is_typed_as_it_is_spoken(opened: Opened, typed: str, length: float) -> None:
    page = opened()
    change(page, "length of a bench", typed)
    assert page.evaluate("benchdragon.plan.dragon.body_length") == pytest.approx(length)
    expect(number(page, "length of a bench")).to_have_value(f"{length:g}")


@pytest.mark.parametrize("typed", ["1,5", "abc", "150", "5 ft", "1 5"])
def test_a_length_that_may_be_another_is_asked_back(opened: Opened, typed: str) -> None:
    page = opened()
    before = page.evaluate("JSON.stringify(benchdragon.plan)")
    change(page, "length of a bench", typed)
    box = number(page, "length of a bench")
    asked = page.locator(".field", has=box).get_by_role("alert")
    expect(asked).to_contain_text("2.2 m" if typed != "150" else "150 cm")
    expect(box).to_have_value(typed)
    assert page.evaluate("JSON.stringify(benchdragon.plan)") == before
    change(page, "length of a bench", "2 m")
    expect(asked).to_have_count(0)
    assert page.evaluate("benchdragon.plan.dragon.body_length") == 2


def test_the_moment_of_the_smallest_pitch_is_no_moment_of_this_plan(opened: Opened) -> None:
    page = opened()
    details(page).locator("summary").click()
    row = page.get_by_role("row", name="smallest pitch")
    expect(row).to_contain_text("0.45034 m")
    expect(row).to_contain_text("in the dance of that size: benches")
    expect(row.get_by_role("button")).to_have_count(0)


@pytest.mark.parametrize("device", ["desktop", "phone"])
def test_a_wrong_file_says_so_in_sight(opened: Opened, tmp_path: Path, device: Device) -> None:
    page = opened(device)
    wrong = tmp_path / "list.toml"
    wrong.write_text("a,b\n1,2\n", "utf-8")
    page.locator(".panel .plan-file").set_input_files(wrong)
    told = page.locator(".told.none")
    expect(told).to_be_in_viewport(ratio=1)
    expect(told).to_contain_text("line 1")
    page.keyboard.press("Escape")
    expect(told).to_have_count(0)
