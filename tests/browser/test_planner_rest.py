"""The planner's picture stays where it is whatever is told above it; a page at rest does nothing."""

from itertools import pairwise
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from benchdragon.planner.page import planner_page
from benchdragon.plans.schema import read_plan
from tests.browser.pages import Device, Pages
from tests.browser.planners import Opened, number, settle, settled, verdict
from tests.browser.players import EXAMPLES, Scene, until
from tests.browser.players import opened as player_of

VILLAGE = str(EXAMPLES / "12_village.dragon.toml")


@pytest.fixture
def village(pages: Pages, tmp_path_factory: pytest.TempPathFactory) -> Opened:
    """Opens the planner of a village, and waits for its dance."""

    def open_page(device: Device = "desktop", where: str = "") -> Page:
        file = tmp_path_factory.mktemp("village") / "planner.html"
        file.write_text(planner_page(read_plan(VILLAGE), "en"), "utf-8")
        return settled(pages.open(file.as_uri() + where, device))

    return open_page


def off(page: Page, name: str, x: float, y: float) -> float:
    """How far a grip lies from a place of the page, CSS pixels."""
    box = page.locator(f'[data-grip="{name}"]').bounding_box()
    assert box is not None
    return max(abs(box["x"] + 0.5 * box["width"] - x), abs(box["y"] + 0.5 * box["height"] - y))


@pytest.mark.parametrize("device", ["desktop", "phone"])
def test_what_is_dragged_stays_under_the_finger_when_the_verdict_changes(
    village: Opened, device: Device
) -> None:
    page = village(device)
    page.locator("canvas").scroll_into_view_if_needed()
    page.evaluate("benchdragon.grips.element.classList.add('seen'); benchdragon.grips.follow()")
    box = page.locator('[data-grip="obstacle.0"]').bounding_box()
    assert box is not None
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
    top = page.locator("canvas").bounding_box()
    page.mouse.move(x, y)
    page.mouse.down()
    words = set()
    place = "benchdragon.plan.obstacle[0].centre"
    snap = float(page.evaluate("0.1 * benchdragon.player.camera.scale")) + 2
    # Sideways into the coil and out again, and still: the verdict is short there, and long here.
    for step in (-10, -60, -110, -110, -150, -60, 0, 0):
        page.mouse.move(x + step, y)
        settled_verdict(page)
        words.add(verdict(page).text_content())
        assert off(page, "obstacle.0", x + step, y) <= snap
        before = page.evaluate(place)
        page.mouse.move(x + step, y + 0.1)
        assert page.evaluate(place) == before
        assert page.locator("canvas").bounding_box() == top
    assert len(words) > 1
    page.mouse.up()


def settled_verdict(page: Page) -> None:
    """Wait until the verdict is about the plan on the page."""
    expect(page.locator(".verdict:not([data-stale])")).to_have_count(1)
    page.wait_for_timeout(50)
    expect(page.locator(".verdict:not([data-stale])")).to_have_count(1)


DRAWS = """new Promise((done) => {
  const ask = globalThis.requestAnimationFrame;
  let count = 0;
  globalThis.requestAnimationFrame = (turn) => (count++, ask(turn));
  setTimeout(() => { globalThis.requestAnimationFrame = ask; done(count); }, 1000);
})"""


def test_a_planner_at_rest_sleeps_and_wakes(opened: Opened) -> None:
    page = opened()
    page.locator("canvas").hover(position={"x": 60, "y": 200})
    expect(page.locator(".grips.seen")).to_have_count(1)
    page.wait_for_timeout(1500)
    assert page.evaluate(DRAWS) == 0
    assert page.evaluate("benchdragon.tracks.aside") is None
    before = page.evaluate("benchdragon.player.frameTimes.length")
    page.get_by_role("button", name="one second on").click()
    until(page, f"benchdragon.player.frameTimes.length > {before}")
    assert page.evaluate("benchdragon.player.root.dataset.time") == "1.000"
    number(page, "spiral pitch").fill("0.4")
    number(page, "spiral pitch").press("Enter")
    settle(page, "Not safe")


def test_a_player_at_rest_sleeps_and_plays_on_without_a_leap(pages: Pages, turn: Scene) -> None:
    page = player_of(pages, turn)
    page.wait_for_timeout(500)
    assert page.evaluate(DRAWS) == 0
    start = page.evaluate("benchdragon.time")
    first = page.evaluate(
        "new Promise((done) => { benchdragon.onDrawn = () => done(benchdragon.time);"
        " benchdragon.play(true); })"
    )
    assert first == pytest.approx(start, abs=0.05)
    until(page, f"benchdragon.time > {start} + 0.3")
    page.evaluate("benchdragon.play(false)")
    page.wait_for_timeout(300)
    assert page.evaluate(DRAWS) == 0
    page.evaluate("benchdragon.face.tell()")
    until(page, "benchdragon.face.story.elapsed > 0.2")


@pytest.mark.parametrize("device", ["desktop", "phone"])
def test_play_is_reached_in_ten_stops(opened: Opened, device: Device) -> None:
    page = opened(device)
    for _stop in range(10):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.classList.contains('play')"):
            return
    raise AssertionError(page.evaluate("document.activeElement.outerHTML"))


WRITTEN = """new Promise((done) => {
  const { player } = benchdragon;
  const ctx = player.face.painter.ctx;
  const found = [];
  const write = ctx.fillText;
  ctx.fillText = (text, x, y) => {
    const { width } = ctx.measureText(text);
    const left = { center: x - width / 2, right: x - width }[ctx.textAlign] ?? x;
    const size = parseFloat(ctx.font.match(/([0-9.]+)px/)[1]);
    const top = { middle: y - size / 2, top: y }[ctx.textBaseline] ?? y - size;
    found.push({ text, left, top, right: left + width, bottom: top + size });
    write.call(ctx, text, x, y);
  };
  player.onDrawn = () => { ctx.fillText = write; done(found); };
  player.jump(TIME);
})"""


def written(page: Page, time: float) -> list[dict[str, Any]]:
    """What is written on the picture at a time, and where."""
    found = page.evaluate(WRITTEN.replace("TIME", str(time)))
    assert isinstance(found, list)
    return found


@pytest.mark.parametrize("device", ["desktop", "phone"])
def test_names_on_the_square_are_hidden_by_no_label_and_no_number(
    village: Opened, device: Device
) -> None:
    page = village(device)
    edge = "benchdragon.player.scene.sent.occasions.find(({ kind }) => kind === 'venue').time"
    found = written(page, page.evaluate(edge))
    names = [one for one in found if any(name in one["text"] for name in ("post", "well", "village"))]
    label = [one for one in names if "(" in one["text"]]
    assert len(label) == 1
    for name in names:
        for other in found:
            if other is name or (name in label and str(other["text"]).isdigit()):
                continue
            apart = (
                name["right"] <= other["left"]
                or other["right"] <= name["left"]
                or name["bottom"] <= other["top"] + 1
                or other["bottom"] <= name["top"] + 1
            )
            assert apart, (name["text"], other["text"])


@pytest.mark.parametrize("device", ["desktop", "phone"])
def test_marks_of_one_time_stand_beside_one_another(village: Opened, device: Device) -> None:
    page = village(device)
    places = page.locator(".axis .mark:not(.joint, .cue)").evaluate_all(
        "(marks) => marks.map((one) => one.getBoundingClientRect().x).sort((a, b) => a - b)"
    )
    assert len(places) >= 2
    assert all(b - a >= 16 for a, b in pairwise(places))


def test_the_ring_is_about_what_touches_on_the_square(village: Opened) -> None:
    page = village()
    page.evaluate(
        "() => { const plan = structuredClone(benchdragon.plan);"
        " plan.obstacle[2].centre = [2.2, -2]; benchdragon.change(plan, true); }"
    )
    settled(page)
    texts = [str(one["text"]) for one in written(page, 3.217)]
    assert any("(" in text and "south post" in text for text in texts), texts


def test_a_box_that_is_typed_into_is_not_covered_when_the_keyboard_is_up(opened: Opened) -> None:
    page = opened("phone")
    box = number(page, "spiral pitch")
    box.tap()
    page.set_viewport_size({"width": 390, "height": 400})
    box.evaluate("(one) => one.scrollIntoView({ block: 'start' })")
    on_top = "(one) => { const { x, y, width, height } = one.getBoundingClientRect();"
    on_top += " return document.elementFromPoint(x + width / 2, y + height / 2) === one; }"
    assert box.evaluate(on_top)
