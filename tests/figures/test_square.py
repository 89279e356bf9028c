"""The square in pictures: edge, obstacles, margins and names, in sight and where they are."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from benchdragon.analysis.check import check, moment
from benchdragon.figures.contact import moment_picture
from benchdragon.figures.square import MOST_NAMES, square_corners
from benchdragon.figures.walk import dragon_picture, walk_pictures
from benchdragon.i18n import spoken_in
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.schema import read_plan

SAID = [
    "dragon.benches=20",
    "walk.end=60",
    "venue.rectangle=[60, 30]",
    "limits.venue_margin=0.5",
    'obstacle=[{kind="circle", name="well", centre=[9, -6], radius=0.6, margin=0.3},'
    ' {kind="line", points=[[-20, 12], [20, 12]]}]',
]
PLAN = read_plan("turn", SAID)
# The same on its way out: bench 1 comes into the well's margin, and touches the well later.
NEAR = read_plan("turn", [*SAID, "obstacle.0.centre=[6.2, 2]"])


def pictured() -> Figure:
    motion = PLAN.build().motion([0.0])
    return dragon_picture(motion, "", (0,), PLAN.route.disc(PLAN), PLAN.obstacles())  # type: ignore[union-attr]


def named(figure: Figure) -> dict[str, PolyCollection | LineCollection]:
    found = figure.axes[0].collections
    return {
        str(one.get_label()): one for one in found if isinstance(one, PolyCollection | LineCollection)
    }


def test_edge_obstacles_and_margins_are_drawn_where_they_are() -> None:
    drawn = named(pictured())
    (edge,) = drawn["edge of the venue"].get_paths()
    assert np.abs(edge.vertices).max(axis=0).tolist() == [30.0, 15.0]
    (well,) = drawn["obstacle"].get_paths()
    apart = np.hypot(*(np.asarray(well.vertices) - [9.0, -6.0]).T)
    assert apart == pytest.approx(0.6, abs=1e-12)
    assert drawn["obstacle"].get_hatch()
    (rope,) = drawn["obstacle line"].get_paths()
    assert np.asarray(rope.vertices).tolist() == [[-20.0, 12.0], [20.0, 12.0]]
    inner, about = drawn["margin"].get_paths()
    assert np.abs(inner.vertices).max(axis=0) == pytest.approx([29.5, 14.5])
    assert np.hypot(*(np.asarray(about.vertices) - [9.0, -6.0]).T) == pytest.approx(0.9, abs=1e-3)


def test_all_of_the_square_is_in_sight_and_named() -> None:
    panel = pictured().axes[0]
    corners = np.array(square_corners(PLAN.obstacles()))
    for (low, high), along in zip((panel.get_xlim(), panel.get_ylim()), corners.T, strict=True):
        assert low < along.min() < along.max() < high
    with spoken_in("zh"):
        said = {text.get_text() for text in pictured().axes[0].texts}
    assert {text.get_text() for text in panel.texts} == {"the venue", "well", "obstacle 2"}
    assert said == {"场地", "well", "障碍物 2"}


def test_names_are_left_out_where_there_are_too_many() -> None:
    many = [Obstacle.circle(f"post {n}", (n, 9.0), 0.1) for n in range(MOST_NAMES + 1)]
    motion = PLAN.build().motion([0.0])
    assert not dragon_picture(motion, obstacles=many).axes[0].texts
    assert len(dragon_picture(motion, obstacles=many[:-1]).axes[0].texts) == MOST_NAMES


def test_an_obstacle_that_is_come_near_is_shown_close_by() -> None:
    report = check(NEAR)
    motion, answer = moment(report)
    assert answer is report.obstacles[1].contact
    whole, close = moment_picture(motion, answer, "", None, NEAR.obstacles()).axes[:2]
    assert close.get_title() == "bench 1 and well: 300 mm apart"
    (line,) = (one for one in close.lines if one.get_linestyle() == "-")
    (ax, ay), (bx, by) = np.column_stack([line.get_xdata(), line.get_ydata()])
    assert np.hypot(bx - ax, by - ay) == pytest.approx(0.3, abs=1e-9)
    assert np.hypot(bx - 6.2, by - 2.0) == pytest.approx(0.6, abs=1e-9)
    assert {text.get_text() for text in whole.texts} == {"the venue", "well", "obstacle 2"}


def test_the_ground_that_a_dance_covers_is_drawn_below_its_benches() -> None:
    walk = PLAN.build()
    pictures = walk_pictures(walk, np.linspace(0.0, 60.0, 5), "", None, obstacles=PLAN.obstacles())
    for panel in pictures["dragon"].axes[:4]:
        (ground,) = (patch for patch in panel.patches if patch.get_label() == "ground covered")
        path = ground.get_path()
        x, y = walk.motion([30.0]).x[0], walk.motion([30.0]).y[0]
        middles = np.column_stack([0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])])
        assert path.contains_points(middles).all()
        assert not path.contains_points([(29.0, 14.0), (9.0, -6.0)]).any()
        assert ground.get_zorder() < min(one.get_zorder() for one in panel.collections)
    plain = walk_pictures(walk, np.linspace(0.0, 60.0, 5), "", None)
    assert "ground covered" not in {patch.get_label() for patch in plain["dragon"].axes[0].patches}
