"""Pictures of long approaches: what bends fills the frame, and an inset shows all."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from benchdragon import Arc, Dragon, Line, Motion, Route, Spiral, Walk
from benchdragon.analysis.check import check as verdict
from benchdragon.analysis.check import moment
from benchdragon.export.film_scene import Look, MovingScene, Place, Scene, sheet
from benchdragon.figures.contact import CLOSE, moment_picture
from benchdragon.figures.framing import Area, Framing, framing, inset
from benchdragon.figures.walk import dragon_picture
from benchdragon.plans.schema import read_plan

RADIUS = 9.0
COIL = Spiral.between(0.55, RADIUS, 2.0)
DRAGON = Dragon.uniform(benches=100)
# From this share of a frame's side on a coil can be read.
READABLE = 0.4


def walk_up(line: float) -> Walk:
    """A dragon that coils up behind a line of so many metres; its head begins to at time 0."""
    return Walk(DRAGON, Route.joined([Line(line), COIL]), start=line)


def shown(panel: Axes) -> Area:
    (x0, x1), (y0, y1) = panel.get_xlim(), panel.get_ylim()
    return Area((0.5 * (x0 + x1), 0.5 * (y0 + y1)), x1 - x0, y1 - y0)


def inside(area: Area, motion: Motion, index: int) -> int:
    """How many of the dragon's handles a picture shows."""
    handles = np.stack([motion.x[index], motion.y[index]], axis=-1)
    return int((area.beyond(handles) == 0.0).all(axis=1).sum())


def holds_the_coil(area: Area, walk: Walk) -> bool:
    ring = walk.route.centre + RADIUS * np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])
    return bool((area.beyond(ring) == 0.0).all())


@pytest.mark.parametrize("line", [60.0, 400.0, 20_000.0])
def test_a_coil_behind_a_run_up_fills_its_picture_and_an_inset_shows_all(line: float) -> None:
    walk = walk_up(line)
    motion = walk.motion([40.0, 120.0])
    figure = dragon_picture(motion, "", (0, 1))
    for index, panel in enumerate(figure.axes):
        frame = shown(panel)
        assert holds_the_coil(frame, walk)
        assert 2.0 * RADIUS / frame.width > READABLE
        assert frame.width == pytest.approx(frame.height)
        assert inside(frame, motion, index) < len(DRAGON)
        (small,) = (axes for axes in panel.child_axes if isinstance(axes, Axes))
        assert inside(shown(small), motion, index) == len(DRAGON) + 1
        (mark,) = (patch for patch in small.patches if isinstance(patch, Rectangle))
        assert (mark.get_x(), mark.get_x() + mark.get_width()) == pytest.approx(panel.get_xlim())
        assert (mark.get_y(), mark.get_y() + mark.get_height()) == pytest.approx(panel.get_ylim())
        assert len(small.texts) == 1


def test_an_inset_lies_where_least_of_the_route_is_and_not_under_the_legend() -> None:
    framed = Framing(Area((0.0, 0.0), 10.0, 10.0), Area((0.0, 0.0), 100.0, 50.0))
    frame = framed.frame(1.0, np.zeros((1, 2)))
    assert frame == Area((0.0, 0.0), 16.0, 16.0)
    corners = ((0, 0), (1, 0), (0, 1))
    busy = np.array([(-7.0, -7.0), (-7.0, 7.0), (-6.0, 7.0)])
    ground, (left, bottom, wide, high) = inset(framed, frame, busy, corners)
    assert (ground.width, ground.height) == (100.0, 50.0)
    assert left > 0.5 > bottom
    assert wide == pytest.approx(2.0 * high)
    assert left + wide < 1.0
    left, bottom, wide, high = inset(framed, frame, np.array([(-7.0, -7.0), (7.0, -7.0)]), corners)[1]
    assert left < 0.5 < bottom
    assert bottom + high < 1.0


def test_an_inset_shows_the_ground_of_the_picture_too() -> None:
    framed = Framing(Area((45.0, 0.0), 10.0, 10.0), Area((0.0, 0.0), 100.0, 12.0))
    frame = framed.frame(1.0, np.array([(45.0, 0.0)]))
    ground = inset(framed, frame, np.zeros((1, 2)), ((0, 0),))[0]
    assert ground.limits[0] == pytest.approx((-50.0, 53.0))
    assert ground.width == pytest.approx(3.0 * ground.height)


@pytest.mark.parametrize("name", ["spiral-in", "turn"])
@pytest.mark.parametrize("benches", [10, 223, 800])
def test_a_coiled_dragon_is_shown_whole_and_without_an_inset(name: str, benches: int) -> None:
    walk = read_plan(name, [f"dragon.benches={benches}"]).build()
    motion = walk.motion([-100.0, 0.0, 300.0])
    for index, panel in enumerate(dragon_picture(motion, "", (0, 1, 2)).axes[:3]):
        assert panel.child_axes == []
        assert inside(shown(panel), motion, index) == benches + 1


def test_a_dragon_that_has_not_come_yet_or_has_gone_is_in_sight_too() -> None:
    route = Route.joined([Line(300.0), Arc(9.0, 2.0 * math.pi), Line(300.0)])
    walk = Walk(Dragon.uniform(benches=40), route, start=300.0)
    motion = walk.motion([-100.0, 40.0, 200.0])
    panels = dragon_picture(motion, "", (0, 1, 2)).axes[:3]
    seen = [inside(shown(panel), motion, index) for index, panel in enumerate(panels)]
    assert min(seen) >= 2
    assert len({panel.get_xlim()[1] - panel.get_xlim()[0] for panel in panels}) <= 2  # rounding
    assert shown(panels[1]).width == pytest.approx(shown(panels[0]).width)


def test_a_slight_bend_on_the_way_does_not_count_and_equal_ones_all_do() -> None:
    bend, far = Arc(10.0, 0.3), Line(300.0)
    coil = framing(Route.joined([bend, far, COIL]), np.array([[0.0, 500.0]]), 1.0)
    assert coil.core.width < 2.0 * RADIUS + 3.0
    slalom = framing(Route.joined([bend, far, Arc(10.0, -0.3), far, bend]), np.array([[0, 609.0]]), 1.0)
    assert slalom.core.width > 590.0
    assert not slalom.cut(1.0)


def test_a_kink_is_a_bend_and_a_circle_wider_than_the_dragon_is_none() -> None:
    kinked = Route((Line(200.0), Line(200.0, (200.0, 0.0), 3.0 * math.pi / 2.0)), kinks=True)
    found = framing(kinked, np.array([[50.0, 350.0]]), 1.0)
    assert found.core.middle == pytest.approx((200.0, 0.0), abs=0.2)
    assert found.core.width < 1.0
    lake = framing(Route((Arc(1000.0, 6.0),)), np.array([[0.0, 370.0]]), 1.0)
    assert lake.core == lake.whole
    straight = framing(Route((Line(500.0),)), np.array([[0.0, 370.0]]), 1.0)
    assert straight.core == straight.whole
    assert straight.whole.width == pytest.approx(372.0)


def test_headings_that_jump_by_a_full_turn_between_curves_are_no_bends() -> None:
    route = Route((Line(300.0), Line(300.0, (300.0, 0.0), 2.0 * math.pi), *_coil_at(600.0)))
    found = framing(route, np.array([[0.0, 700.0]]), 0.0)
    assert found.core.limits[0][0] > 580.0


def _coil_at(x: float) -> tuple[Spiral, ...]:
    return (COIL.moved((x, 0.0), 2.0 * math.pi),)


def test_only_what_the_dragon_covers_at_its_instants_is_framed() -> None:
    route = Route.joined([Line(100.0), COIL])
    first = framing(route, np.array([[0.0, 90.0]]), 1.0)
    assert first.whole.width == pytest.approx(92.0, abs=0.2)
    looped = Route.joined([Line(100.0), Arc(20.0, 2.0 * math.pi), Line(1.0), COIL])
    apart = framing(looped, np.array([[0.0, 60.0], [260.0, 300.0]]), 1.0)
    assert apart.whole.limits[1] == pytest.approx((-18.0, 1.0), abs=1.5)
    assert apart.core.limits[1] == pytest.approx((-17.0, 0.0), abs=1.5)
    both = framing(route, np.array([[0.0, 90.0], [150.0, 200.0]]), 1.0)
    assert both.core.width == pytest.approx(2.0 * RADIUS, abs=2.0)


def test_a_dragon_that_stands_nowhere_has_a_picture() -> None:
    walk = read_plan("turn").build()
    motion = Walk(walk.dragon, Route(walk.route.curves[1:])).motion([1e6], throw=False)
    assert np.isnan(motion.x).all()
    panel = dragon_picture(motion).axes[0]
    assert np.isfinite([*panel.get_xlim(), *panel.get_ylim()]).all()


def test_points_that_matter_stay_in_sight_beside_the_bends() -> None:
    """As where the benches that come nearest stand on a line."""
    route = Route.joined([Line(400.0), Arc(2.0, math.pi), Line(100.0)])
    found = framing(route, np.array([[100.0, 450.0]]), 1.0, [(370.0, 0.0)], 1.0)
    assert found.core.limits[0] == pytest.approx((369.0, 403.0), abs=0.1)
    assert found.cut(1.0)
    straight = framing(Route((Line(500.0),)), np.array([[0.0, 370.0]]), 1.0, [(300.0, 0.0)], 3.0)
    assert straight.core == Area((300.0, 0.0), 6.0, 6.0)


RUN_UP = """
schema = 1
dragon.benches = 150
route.part = [
  {kind = "line", length = 300},
  {kind = "spiral", pitch = 0.55, start_radius = 9, end_radius = 2},
]
walk.start = 440
walk.end = 450
"""


def test_the_moment_of_a_contact_shows_the_coil_and_both_benches(tmp_path: Path) -> None:
    path = tmp_path / "run-up.dragon.toml"
    path.write_text(RUN_UP, encoding="utf-8")
    motion, answer = moment(verdict(read_plan(str(path))))
    assert answer.witness is not None
    whole, close = moment_picture(motion, answer).axes[:2]
    assert 2.0 * RADIUS / shown(whole).width > READABLE
    assert len(whole.child_axes) == 1
    ends = np.array(close.lines[0].get_xydata())
    for panel in (whole, close):
        assert not shown(panel).beyond(ends).any()


def test_a_close_up_holds_benches_that_are_metres_apart() -> None:
    walk = Walk(Dragon.uniform(benches=30), Route.joined([Line(90.0), Arc(2.0, math.pi), Line(90.0)]))
    plan = read_plan("spiral-in")
    answer = moment(verdict(plan))[1]
    assert answer.witness is not None
    apart = replace(answer, witness=replace(answer.witness, benches=(1, 20)))
    close = moment_picture(walk.motion([100.0]), apart).axes[1]
    ends = np.array(close.lines[0].get_xydata())
    assert math.dist(*ends) > 2.0
    assert not shown(close).beyond(ends).any()
    assert shown(close).width == pytest.approx(math.dist(*ends) + 2.0 * CLOSE)


def film_of(times: list[float]) -> tuple[Walk, Motion, Place]:
    walk = walk_up(300.0)
    motion = walk.motion(times)
    return walk, motion, Place.of(walk, motion, None)


@pytest.mark.parametrize("size", [(1280, 720), (720, 1280), (600, 600)])
def test_films_and_stills_frame_the_coil_and_keep_all_in_an_inset(size: tuple[int, int]) -> None:
    walk, motion, place = film_of([-100.0, 40.0, 120.0])
    scene = Scene(Look(size), place, "x")
    for index in (1, 2):
        scene.show(motion, index)
        frame = shown(scene.panel.axes)
        assert holds_the_coil(frame, walk)
        assert 2.0 * RADIUS / min(frame.width, frame.height) > READABLE
        assert scene.panel.overview is not None
        head = scene.panel.overview.head.get_xydata()
        assert np.array(head) == pytest.approx(np.array([[motion.x[index, 0], motion.y[index, 0]]]))
        assert scene.panel.overview.mark.get_width() == pytest.approx(frame.width)
        assert inside(shown(scene.panel.overview.axes), motion, index) == len(DRAGON) + 1
    scene.show(motion, 0)
    assert inside(shown(scene.panel.axes), motion, 0) >= 2
    assert not holds_the_coil(shown(scene.panel.axes), walk)
    assert shown(scene.panel.axes).width == pytest.approx(frame.width)


def test_frames_of_a_view_that_moves_are_drawn_as_whole_pictures_are() -> None:
    _walk, motion, place = film_of([-100.0, -60.0, 40.0, 120.0])
    frames = MovingScene(Look((320, 180)), place, "x")
    for index in range(4):
        laid = np.array(frames.frame(motion, index), dtype=np.float64)
        fresh = Scene(Look((320, 180)), place, "x")
        fresh.show(motion, index)
        fresh.canvas.draw()
        assert np.abs(laid - np.array(fresh.canvas.buffer_rgba(), dtype=np.float64)).max() == 0.0


def test_each_picture_of_a_sheet_has_its_inset_and_a_followed_bench_has_none() -> None:
    walk, motion, place = film_of([-100.0, 40.0])
    figure = sheet(Look(), place, "x", motion, 2, 1)
    assert len(figure.axes) == 4
    assert Scene(Look(follow=1), Place.of(walk, motion, None), "x").panel.overview is None
