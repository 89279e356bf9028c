"""The square by hand: things are put onto it by a tap, named, given sizes, deleted, in the page."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from benchdragon.analysis.check import check
from benchdragon.planner.page import planner_page
from benchdragon.plans.schema import checked, read_plan
from benchdragon.solve.wishes import CORNERS
from tests.browser.axe import needs_axe, violations
from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import address, change, settled, verdict
from tests.browser.players import drawn
from tests.browser.test_planner import shown_plan
from tests.browser.test_planner_grips import grip, middle, steps

Opened = Callable[..., Page]
COIL = ["dragon.benches=30", "disc.radius=4", "route.start_turn=10", "limits.margin=0"]
SQUARE = {"venue": {"rectangle": [30, 24], "name": "yard"}}
SIZE = "length x width; r12 if it is round"
# Names that things get, and that they have in the plan.
WORDS = {"en": ("well", "stage", "tree"), "zh": ("水井", "戏台", "树")}


@pytest.fixture
def opened(pages: Pages, tmp_path: Path) -> Opened:
    """Opens a planner of a plan, and waits for its dance."""

    def open_page(
        device: Device = "desktop", more: dict[str, Any] | None = None, language: Language = "en"
    ) -> Page:
        plan = checked(read_plan("spiral-in", COIL).data() | (more or {}), "plan")
        path = tmp_path / "planner.html"
        path.write_text(planner_page(plan, language), "utf-8")
        return settled(pages.open(path.as_uri(), device, language))

    return open_page


def shown(page: Page) -> dict[str, Any]:
    """The plan on the page as it stands there."""
    return json.loads(page.evaluate("JSON.stringify(benchdragon.plan)"))  # type: ignore[no-any-return]


def same(found: Any, wanted: Any) -> bool:
    """Whether data are the same, but for what a pointer that goes in whole pixels cannot hit, m."""
    if isinstance(wanted, dict):
        return found.keys() == wanted.keys() and all(same(found[key], wanted[key]) for key in wanted)
    if isinstance(wanted, list):
        return len(found) == len(wanted) and all(map(same, found, wanted))
    return bool(found == wanted if isinstance(wanted, str) else abs(found - wanted) < 0.101)


def add(page: Page, sort: str) -> None:
    page.locator(f'[data-add="{sort}"]').click()


def bar(page: Page) -> Locator:
    """What is said while something is placed."""
    return page.locator(".placing")


def row(page: Page, thing: str) -> Locator:
    return page.locator(f'[data-thing="{thing}"]')


def tap(page: Page, x: float, y: float, device: Device = "desktop") -> None:
    """Tap the picture at a place of the ground, m."""
    left, top = page.evaluate("(at) => benchdragon.player.camera.toScreen(...at)", [x, y])
    if device == "phone":
        page.locator("canvas").tap(position={"x": left, "y": top})
    else:
        page.locator("canvas").click(position={"x": left, "y": top})


def judged(page: Page) -> None:
    """The page judges the plan that it shows, as Python does."""
    settled(page)
    plan = shown_plan(page)
    assert page.evaluate("benchdragon.verdict.found.plan_sha256") == plan.sha256
    expect(verdict(page)).to_have_class(
        re.compile("verdict safe" if check(plan).safe else "verdict (tight|unsafe)")
    )


def test_a_plan_gets_a_square_about_its_dance_by_numbers_and_loses_it(opened: Opened) -> None:
    page = opened()
    before = shown_plan(page).sha256
    page.get_by_role("button", name="+ square").click()
    judged(page)
    plan = shown_plan(page)
    (edge,) = plan.obstacles()
    assert edge.name == "square"
    (room,) = [one.distance for one in check(plan).obstacles]
    assert 0.3 < room.value < 2.5
    expect(page.get_by_role("button", name="+ square")).to_be_hidden()
    centre = shown(page)["venue"]["centre"]
    change(page, SIZE, "30")
    expect(row(page, "venue").get_by_role("alert")).to_contain_text("with an x between (30x20)")
    change(page, SIZE, "30米5乘2600cm")
    expect(row(page, "venue").locator("summary")).to_contain_text("30.5 m by 26 m")
    assert shown(page)["venue"]["rectangle"] == [30.5, 26]
    assert shown(page)["venue"]["centre"] == centre
    page.get_by_role("checkbox", name="set how far to stay from its edge").check()
    change(page, "how far to stay from its edge", "50cm")
    change(page, "name", "temple  yard ")
    assert shown(page)["limits"]["venue_margin"] == 0.5
    assert shown(page)["venue"]["name"] == "temple yard"
    judged(page)
    assert steps(page) == 5
    page.get_by_role("button", name="delete: temple yard").click()
    assert shown_plan(page).sha256 == before
    page.keyboard.press("Control+z")
    assert shown(page)["venue"]["name"] == "temple yard"
    for _step in range(5):
        page.keyboard.press("Control+z")
    assert shown_plan(page).sha256 == before


def test_a_square_is_round_or_has_the_corners_that_are_tapped(opened: Opened) -> None:
    page = opened(more=SQUARE | {"venue": {"rectangle": [30, 24], "centre": [1, -1], "angle": 10}})
    row(page, "venue").locator("summary").click()
    change(page, SIZE, "r14.5")
    expect(row(page, "venue").locator("summary")).to_contain_text("radius 14.5 m")
    expect(page.get_by_role("textbox", name=SIZE)).to_have_value("r14.5")
    (edge,) = shown_plan(page).obstacles()
    far = np.hypot(*(edge.outline - [1, -1]).T)
    assert len(far) == CORNERS
    assert far == pytest.approx(14.5, abs=0.001)
    judged(page)
    grip(page, "venue").focus()
    page.keyboard.press("ArrowUp")
    (moved,) = shown_plan(page).obstacles()
    assert moved.outline == pytest.approx(edge.outline + np.array([0, 0.1]), abs=0.001)
    page.get_by_role("button", name="draw its edge").click()
    corners = [(-13, -9), (13, -10), (12, 10), (-12, 9)]
    for x, y in corners:
        tap(page, x, y)
    bar(page).get_by_role("button", name="done").click()
    assert same(shown(page)["venue"], {"name": "", "boundary": [list(one) for one in corners]})
    expect(row(page, "venue").locator("summary")).to_contain_text("4 corners")
    judged(page)
    change(page, SIZE, "20x18")
    assert same(shown(page)["venue"], {"name": "", "rectangle": [20, 18], "centre": [0, 0]})
    assert steps(page) == 4


@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_things_are_put_where_the_picture_is_tapped(
    opened: Opened, device: Device, language: Language
) -> None:
    page = opened(device, SQUARE, language)
    before = shown_plan(page).sha256
    well, stage, tree = WORDS[language]
    add(page, "well")
    expect(bar(page)).to_be_visible()
    tap(page, -9.02, 8.01, device)
    expect(bar(page)).to_be_hidden()
    expect(grip(page, "obstacle.0")).to_be_focused()
    middle(grip(page, "obstacle.0"))
    judged(page)
    wanted = [{"kind": "circle", "name": well, "centre": [-9, 8], "radius": 0.6}]
    assert same(shown(page)["obstacle"], wanted)
    for sort, x, y in (("well", 9, 8), ("stage", 0, -9), ("tree", -9, -8), ("entrance", 15, 0)):
        add(page, sort)
        tap(page, x, y, device)
        expect(bar(page)).to_be_hidden()  # a finger's click comes after its tap
    wanted += [
        {"kind": "circle", "name": f"{well} 2", "centre": [9, 8], "radius": 0.6},
        {"kind": "rectangle", "name": stage, "centre": [0, -9], "size": [8, 4]},
        {"kind": "circle", "name": tree, "centre": [-9, -8], "radius": 0.4},
    ]
    assert same(shown(page)["obstacle"], wanted)
    (door,) = shown(page)["event"]["entrances"]
    assert same(door, [15, 0])
    judged(page)
    assert page.evaluate("benchdragon.player.scene.sent.entrances") == [door]
    assert [one.name for one in shown_plan(page).obstacles()] == [
        "yard",
        well,
        f"{well} 2",
        stage,
        tree,
    ]
    assert steps(page) == 5
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    page.keyboard.press("ArrowLeft")
    assert shown(page)["event"]["entrances"] == [[pytest.approx(door[0] - 0.1), door[1]]]
    for _step in range(6):
        page.keyboard.press("Control+z")
    assert shown_plan(page).sha256 == before


def test_what_is_placed_is_dragged_at_once(opened: Opened) -> None:
    page = opened(more=SQUARE)
    add(page, "well")
    tap(page, -9, 8)
    x, y = middle(grip(page, "obstacle.0"))
    scale = page.evaluate("benchdragon.player.camera.scale")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + scale, y)
    page.mouse.up()
    assert same(shown(page)["obstacle"][0]["centre"], [-8, 8])
    assert steps(page) == 2


def test_an_own_shape_is_tapped_corner_by_corner(opened: Opened) -> None:
    page = opened(more=SQUARE)
    add(page, "shape")
    done = bar(page).get_by_role("button", name="done")
    for x, y in ((-12, 6), (-8, 6), (-8, 10)):
        expect(done).to_be_hidden()
        tap(page, x, y)
    expect(done).to_be_visible()
    tap(page, -10, 4)  # from corner three across the first side
    expect(bar(page)).to_contain_text("would cross")
    tap(page, -12, 10)
    tap(page, -12, 6.1)  # as good as the first corner
    expect(bar(page)).to_be_hidden()
    corners = [[-12, 6], [-8, 6], [-8, 10], [-12, 10]]
    assert same(shown(page)["obstacle"], [{"kind": "polygon", "name": "obstacle", "points": corners}])
    add(page, "shape")
    for x, y in ((8, 6), (11, 6), (8, 9), (11, 9)):
        tap(page, x, y)
    done.click()  # its last side would cross the second
    expect(bar(page)).to_contain_text("would cross")
    for x, y in ((8, 6), (11, 6), (11, 9)):
        tap(page, x, y)
    done.click()
    assert shown(page)["obstacle"][1]["name"] == "obstacle 2"
    assert same(shown(page)["obstacle"][1]["points"], [[8, 6], [11, 6], [11, 9]])
    judged(page)
    assert steps(page) == 2


def test_placing_is_given_up(opened: Opened) -> None:
    page = opened(more=SQUARE)
    before = shown_plan(page).sha256
    for how in ("key", "button"):
        add(page, "well")
        if how == "key":
            page.keyboard.press("Escape")
        else:
            bar(page).get_by_role("button", name="give up").click()
        expect(bar(page)).to_be_hidden()
        expect(page.locator('[data-add="well"]')).to_be_focused()
        tap(page, -9, 8)
    assert shown_plan(page).sha256 == before
    assert steps(page) == 0
    tap(page, *page.evaluate("(({ x, y }) => [x[12], y[12]])(benchdragon.player.boxes)"))
    assert page.evaluate("benchdragon.player.chosen") == 12


@pytest.mark.parametrize("sort", ["stage", "shape"])
def test_keys_alone_place_in_the_middle_of_the_picture(opened: Opened, sort: str) -> None:
    page = opened(more=SQUARE)
    x, y, scale = page.evaluate("(({ x, y, scale }) => [x, y, scale])(benchdragon.player.camera)")
    page.locator(f'[data-add="{sort}"]').press("Enter")
    page.keyboard.press("Enter")
    (one,) = shown(page)["obstacle"]
    points = one.get("points") or [one["centre"]]
    assert sum(u for u, _v in points) / len(points) == pytest.approx(x, abs=0.06)
    assert sum(v for _u, v in points) / len(points) == pytest.approx(y, abs=0.06)
    expect(grip(page, "obstacle.0")).to_be_focused()
    page.keyboard.press("ArrowUp")
    if sort == "shape":
        assert points[1][0] - points[0][0] == pytest.approx(100 / scale, abs=1)
        grip(page, "obstacle.0.2").focus()
        page.keyboard.press("ArrowRight")
        moved = shown(page)["obstacle"][0]["points"]
        assert moved[2] == pytest.approx([points[2][0] + 0.1, points[2][1] + 0.1])
    judged(page)


def test_the_list_names_sizes_shows_and_deletes(opened: Opened, tmp_path: Path) -> None:
    things: list[dict[str, Any]] = [
        {"kind": "circle", "name": "well", "centre": [-9, 8], "radius": 0.6},
        {"kind": "rectangle", "name": "", "centre": [0, 10], "size": [8, 2]},
    ]
    page = opened(more=SQUARE | {"obstacle": things, "event": {"entrances": [[15, 0]]}})
    url = page.url
    summaries = page.locator(".things summary")
    expect(summaries).to_have_text(
        ["yard30 m by 24 m", "wellradius 0.6 m", "obstacle 28 m by 2 m", "entrance 1"]
    )
    sketch = page.locator(".sketch")
    expect(sketch).to_have_attribute("d", "")
    row(page, "obstacle.0").locator("summary").click()
    expect(sketch).not_to_have_attribute("d", "")
    expect(page.locator(".grips.seen")).to_have_count(1)
    change(page, "radius", "1米2")
    change(page, "radius", "120")
    expect(row(page, "obstacle.0").get_by_role("alert")).to_contain_text("Write 120 cm")
    page.get_by_role("checkbox", name="set how far to stay from it").check()
    change(page, "name", "yard")
    expect(row(page, "obstacle.0").get_by_role("alert").first).to_contain_text("called yard already")
    change(page, "name", "old well")
    change(page, "to the right (x)", "-850cm")
    change(page, "ahead (y)", "7.5")
    one = {"kind": "circle", "name": "old well", "centre": [-8.5, 7.5], "radius": 1.2, "margin": 0.3}
    assert shown(page)["obstacle"][0] == one
    row(page, "obstacle.1").locator("summary").click()
    expect(row(page, "obstacle.0")).not_to_have_attribute("open", "")
    change(page, "length", "5")
    change(page, "direction", "30")
    assert shown(page)["obstacle"][1] == things[1] | {"size": [5, 2], "angle": 30}
    row(page, "entrance.0").locator("summary").click()
    expect(row(page, "obstacle.1")).not_to_have_attribute("open", "")
    change(page, "to the right (x)", "14.5")
    assert shown(page)["event"]["entrances"] == [[14.5, 0]]
    wide = row(page, "entrance.0").get_by_role("checkbox", name="set how wide it is")
    wide.check()
    change(page, "how wide it is", "一米五")
    assert shown(page)["event"]["entrances"] == [[14.5, 0, 1.5]]
    expect(summaries.last).to_have_text("entrance 11.5 m wide")
    change(page, "how wide it is", "300")
    expect(row(page, "entrance.0").get_by_role("alert").first).to_contain_text("Write 300 cm")
    grip(page, "entrance.0").focus()
    page.keyboard.press("ArrowRight")
    assert shown(page)["event"]["entrances"] == [[14.6, 0, 1.5]]
    judged(page)
    yard, *_others = page.evaluate("benchdragon.player.scene.sent.obstacles")
    assert same(yard["left"][0][0], [15, 0.75])
    assert same(yard["left"][0][-1], [15, -0.75])
    page.keyboard.press("Control+z")
    wide.uncheck()
    assert shown(page)["event"]["entrances"] == [[14.5, 0]]
    page.keyboard.press("Control+z")
    assert shown(page)["event"]["entrances"] == [[14.5, 0, 1.5]]
    judged(page)
    address(page, url)
    page.reload()
    again = settled(page)
    assert shown(again)["obstacle"][0] == one
    row(again, "obstacle.0").locator("summary").click()
    again.get_by_role("button", name="delete: old well").click()
    row(again, "entrance.0").locator("summary").click()
    again.get_by_role("button", name="delete: entrance 1").click()
    assert [one["kind"] for one in shown(again)["obstacle"]] == ["rectangle"]
    assert "event" not in shown(again)
    judged(again)
    with again.expect_download() as saved:
        again.get_by_role("button", name="save the plan file").click()
    saved.value.save_as(tmp_path / "saved.dragon.toml")
    assert read_plan(str(tmp_path / "saved.dragon.toml")).sha256 == shown_plan(again).sha256


def test_odd_things_in_an_address_are_told_and_do_no_harm(opened: Opened) -> None:
    page = opened()
    for odd in (
        {"obstacle": "well"},
        {"obstacle": [None, {"kind": "circle", "centre": 3}]},
        {"venue": {"boundary": [[0, 0], None] * 8}},
        {"venue": {"rectangle": "30x20"}, "event": {"entrances": [[1, 2, 3]]}},
    ):
        page.evaluate("(odd) => benchdragon.change({ ...benchdragon.first, ...odd }, true)", odd)
        expect(verdict(page)).to_have_class("verdict none")
    page.get_by_role("button", name="undo").click()
    page.evaluate("benchdragon.change(benchdragon.first, true)")
    judged(page)


@needs_axe
@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_axe_finds_nothing_wrong(opened: Opened, device: Device, language: Language) -> None:
    thing = {"kind": "rectangle", "name": "戏台", "centre": [0, 10], "size": [8, 2]}
    page = opened(device, SQUARE | {"obstacle": [thing]}, language)
    row(page, "obstacle.0").locator("summary").click()
    for part in ("list", "placing"):
        for colours in ("light", "dark"):
            page.emulate_media(color_scheme=colours)
            drawn(page)
            assert violations(page) == [], (part, colours)
        add(page, "shape")
