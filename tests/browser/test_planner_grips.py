"""Direct manipulation in the planner: grips on the picture, marked tracks, fingers, the time span."""

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from benchdragon.analysis.check import check
from benchdragon.planner.page import planner_page
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.solve.size import limit
from tests.browser.pages import Device, Pages
from tests.browser.planners import settled, verdict
from tests.browser.players import until

Opened = Callable[..., Page]
COIL = ["dragon.benches=30", "disc.radius=4", "route.start_turn=10"]
SQUARE = {
    "venue": {"rectangle": [24, 20], "centre": [1, 0]},
    "obstacle": [
        {"kind": "circle", "name": "well", "centre": [-9, 8], "radius": 1},
        {"kind": "polygon", "points": [[9, 6], [12, 6], [12, 9]]},
    ],
}
# How far a touch reaches, CSS pixels.
TARGET = 44


@pytest.fixture
def opened(pages: Pages, tmp_path: Path) -> Opened:
    """Opens a planner of a plan, and waits for its dance."""

    def open_page(device: Device = "desktop", more: dict[str, Any] | None = None) -> Page:
        plan = checked(read_plan("spiral-in", COIL).data() | (more or {}), "plan")
        path = tmp_path / "planner.html"
        path.write_text(planner_page(plan, "en"), "utf-8")
        return settled(pages.open(path.as_uri(), device))

    return open_page


def grip(page: Page, name: str) -> Locator:
    return page.locator(f'[data-grip="{name}"]')


def shown_plan(page: Page) -> Plan:
    return checked(json.loads(page.evaluate("JSON.stringify(benchdragon.plan)")), "plan")


def steps(page: Page) -> int:
    """How many steps can be undone."""
    count = page.evaluate("benchdragon.past.length")
    assert isinstance(count, int)
    return count


def middle(target: Locator) -> tuple[float, float]:
    box = target.bounding_box()
    assert box is not None
    assert box["width"] >= TARGET
    assert box["height"] >= TARGET
    return box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]


def taken(page: Page, name: str) -> tuple[float, float]:
    """Press the mouse on a grip; where that was."""
    canvas = page.locator("canvas")
    canvas.hover(position={"x": 40, "y": 200})
    expect(page.locator(".grips.seen")).to_have_count(1)
    x, y = middle(grip(page, name))
    page.mouse.move(x, y)
    page.mouse.down()
    return x, y


def pixels(page: Page) -> float:
    """CSS pixels of a metre."""
    return float(page.evaluate("benchdragon.player.camera.scale"))


def test_the_disc_is_dragged_in_one_step_and_judged_anew(opened: Opened) -> None:
    page = opened()
    expect(verdict(page)).to_have_class("verdict safe")
    x, y = taken(page, "disc")
    inward = 2.52 * pixels(page) * math.sqrt(0.5)
    for share in (0.2, 0.6, 1.0):
        page.mouse.move(x - share * inward, y - share * inward)
    expect(grip(page, "disc").locator(".value")).to_have_text("1.50 m")
    expect(grip(page, "disc").locator(".value")).to_be_visible()
    expect(verdict(page)).to_have_class("verdict unsafe")
    assert steps(page) == 0
    page.mouse.up()
    settled(page)
    plan = shown_plan(page)
    assert plan.disc.radius == 1.5
    assert not check(plan).safe
    assert page.evaluate("benchdragon.verdict.found.plan_sha256") == plan.sha256
    assert page.evaluate("benchdragon.player.scene.sent.plan_sha256") == plan.sha256
    assert steps(page) == 1
    page.keyboard.press("Control+z")
    assert shown_plan(page).disc.radius == 4
    assert steps(page) == 0


def test_a_drag_with_alt_is_not_rounded_and_escape_takes_it_back(opened: Opened) -> None:
    page = opened()
    x, y = taken(page, "disc")
    page.keyboard.down("Alt")
    page.mouse.move(x + 0.52 * pixels(page) * math.sqrt(0.5), y + 0.52 * pixels(page) * math.sqrt(0.5))
    page.keyboard.up("Alt")
    radius = shown_plan(page).disc.radius
    assert radius is not None
    assert radius == pytest.approx(4.52, abs=2 / pixels(page))
    assert abs(radius / 0.05 - round(radius / 0.05)) > 1e-6
    page.keyboard.press("Escape")
    assert shown_plan(page).disc.radius == 4
    page.mouse.move(x, y + 90)
    page.mouse.up()
    assert shown_plan(page).disc.radius == 4
    assert steps(page) == 0


def test_pitch_and_start_are_dragged_along_their_own_ways(opened: Opened) -> None:
    page = opened()
    x, y = taken(page, "pitch")
    # It lies 9.5 turns from the centre, to the left of it.
    page.mouse.move(x - 9.5 * 0.05 * pixels(page), y)
    page.mouse.up()
    assert shown_plan(page).value("route.pitch") == 0.6
    settled(page)
    x, y = taken(page, "start")
    # A quarter of a turn further out: up, from the right.
    centre = x - 10 * 0.6 * pixels(page)
    page.mouse.move(centre, y - 10.25 * 0.6 * pixels(page))
    page.mouse.up()
    assert shown_plan(page).value("route.start_turn") == 10.25
    assert steps(page) == 2


def test_keys_move_a_grip_and_it_keeps_the_focus(opened: Opened) -> None:
    page = opened()
    disc = grip(page, "disc")
    disc.focus()
    expect(disc).to_have_attribute("aria-label", "edge of the disc")
    expect(disc).to_have_attribute("aria-valuetext", "4.00 m")
    page.keyboard.down("ArrowRight")
    page.keyboard.down("ArrowRight")
    page.keyboard.up("ArrowRight")
    assert shown_plan(page).disc.radius == pytest.approx(4.1)
    assert steps(page) == 1
    page.keyboard.press("Shift+ArrowDown")
    assert shown_plan(page).disc.radius == pytest.approx(3.6)
    settled(page)
    expect(disc).to_be_focused()
    expect(disc).to_have_attribute("aria-valuetext", "3.60 m")
    assert page.evaluate("benchdragon.player.time") == 0
    assert steps(page) == 2


@pytest.mark.parametrize(
    ("name", "key", "wanted"),
    [
        ("venue.0", "ArrowRight", {"venue.rectangle": [25, 20], "venue.centre": [1.5, 0]}),
        ("venue.6", "ArrowDown", {"venue.rectangle": [24, 21], "venue.centre": [1, -0.5]}),
        ("obstacle.0", "ArrowUp", {"obstacle.0.centre": [-9, 9]}),
        ("obstacle.0.radius", "ArrowRight", {"obstacle.0.radius": 2}),
        ("obstacle.1", "ArrowLeft", {"obstacle.1.points": [[8, 6], [11, 6], [11, 9]]}),
        ("obstacle.1.2", "ArrowUp", {"obstacle.1.points": [[9, 6], [12, 6], [12, 10]]}),
        ("at", "ArrowLeft", {"route.at": [-1, 0]}),
        ("turned", "ArrowUp", {"route.turned": 50}),
    ],
)
def test_the_square_and_the_place_of_the_dance_are_moved(
    opened: Opened, name: str, key: str, wanted: dict[str, Any]
) -> None:
    page = opened(more=SQUARE)
    page.evaluate("benchdragon.player.camera.scale = 40")
    page.locator("canvas").hover(position={"x": 20, "y": 20})
    grip(page, name).evaluate("(element) => { element.hidden = false; element.focus(); }")
    page.keyboard.press(f"Shift+{key}")
    plan = json.loads(page.evaluate("JSON.stringify(benchdragon.plan)"))
    for path, value in wanted.items():
        at = plan
        for part in path.split("."):
            at = at[int(part)] if part.isdigit() else at[part]
        assert at == pytest.approx(value) if isinstance(value, float) else at == value
    assert steps(page) == 1
    settled(page)
    assert page.evaluate("benchdragon.verdict.found.plan_sha256") == shown_plan(page).sha256


def touch(page: Page, *points: list[tuple[float, float]]) -> None:
    """Touch with fingers, at one place after another, and let go."""
    session = page.context.new_cdp_session(page)

    def tell(kind: str, places: list[tuple[float, float]]) -> None:
        fingers = [{"x": x, "y": y, "id": n} for n, (x, y) in enumerate(places)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

    for n, places in enumerate(points):
        tell("touchMove" if n else "touchStart", places)
    tell("touchEnd", [])


def test_fingers_drag_undo_and_redo(opened: Opened) -> None:
    page = opened("phone")
    page.evaluate("scrollTo(0, 500)")
    page.locator("canvas").tap(position={"x": 20, "y": 20})
    x, y = middle(grip(page, "disc"))
    touch(page, [(x, y)], [(x - 5, y - 5)], [(x - 12, y - 12)])
    settled(page)
    radius = shown_plan(page).disc.radius
    assert radius is not None
    assert radius < 3.8
    left, top = middle(page.locator("canvas"))
    touch(page, [(left, top), (left + 60, top)])
    assert shown_plan(page).disc.radius == 4
    touch(page, [(left, top), (left + 60, top), (left, top + 60)])
    assert shown_plan(page).disc.radius == radius


def test_a_phones_picture_stays_in_sight_while_controls_go_by(opened: Opened) -> None:
    page = opened("phone")
    slider = page.get_by_role("slider", name="spiral pitch")
    slider.evaluate("(element) => element.scrollIntoView({ block: 'end' })")
    boxes = [one.bounding_box() for one in (verdict(page), page.locator("canvas"), slider)]
    tops = [box["y"] for box in boxes if box]
    ends = [box["y"] + box["height"] for box in boxes if box]
    assert (
        0 <= tops[0] < ends[0] <= tops[1] < ends[1] <= tops[2] < ends[2] < 845
    )  # scrolled to whole pixels
    assert ends[1] - tops[1] >= 220


def test_a_tracks_border_is_the_limit(opened: Opened) -> None:
    route = {"kind": "spiral-in", "pitch": 0.55, "start_turn": 14}
    page = opened(more={"route": route, "disc": {"radius": 4.1}})
    told = page.locator('[id="walkable-route.pitch"]')
    expect(told).to_be_empty()
    page.get_by_role("slider", name="spiral pitch").focus()
    expect(told).to_have_text(re.compile(r"can be walked from [\d.]+ m"))
    found = re.search(r"from ([\d.]+) m", told.inner_text())
    assert found is not None
    border = float(found[1])
    answer = limit(shown_plan(page), "pitch")
    assert border == pytest.approx(math.ceil(1000 * answer.upper - 1e-9) / 1000, abs=1e-9)
    field = page.locator(".field", has=told)
    bar = field.locator(".track")
    width = bar.evaluate("(element) => element.clientWidth")
    unsafe, safe = (bar.locator(f".{state}").bounding_box() for state in ("unsafe", "safe"))
    assert unsafe is not None
    assert safe is not None
    assert unsafe["x"] + unsafe["width"] == pytest.approx(safe["x"], abs=0.5)
    assert unsafe["width"] == pytest.approx((border - 0.3) / 2.7 * width, abs=0.5)
    # It holds for other values of its own size, for those of another no more.
    page.get_by_role("slider", name="spiral pitch").fill("0.6")
    expect(told).not_to_be_empty()
    assert check(shown_plan(page).with_values({"route.pitch": border})).safe
    page.get_by_role("slider", name="turns at the start").fill("11")
    expect(told).to_be_empty()


def test_tracks_wait_for_the_page_and_are_given_up_at_once(opened: Opened) -> None:
    page = opened()
    page.get_by_role("slider", name="spiral pitch").hover()
    until(page, "benchdragon.tracks.aside !== null")
    given = page.evaluate("""() => {
        const { aside } = benchdragon.tracks;
        const plan = structuredClone(benchdragon.plan);
        plan.route.pitch = 0.5;
        const ended = aside.ask({ question: "verdict", plan }).catch((error) => error.name);
        benchdragon.change(plan, true);
        return Promise.all([ended, benchdragon.tracks.aside]);
    }""")
    assert given == ["AbortError", None]
    settled(page)


def test_the_time_span_is_a_control(opened: Opened) -> None:
    page = opened()
    end = page.evaluate("benchdragon.player.scene.end")
    page.get_by_role("checkbox", name="set the walk ends at").check()
    settled(page)
    assert shown_plan(page).walk.end == math.floor(end)
    page.get_by_role("slider", name="the walk ends at").fill("60")
    settled(page)
    assert shown_plan(page).walk.end == 60
    assert page.evaluate("benchdragon.player.scene.end") == pytest.approx(60)
    slider = page.get_by_role("slider", name="the walk ends at")
    assert float(slider.get_attribute("max") or 0) >= math.floor(end)


def test_the_help_says_what_keys_and_fingers_do(opened: Opened) -> None:
    page = opened()
    page.get_by_role("button", name="keys").click()
    expect(page.get_by_role("dialog")).to_contain_text("two fingers tap")
    expect(page.get_by_role("dialog")).to_contain_text("drag a grip in the picture")
