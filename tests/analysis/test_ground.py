"""How places are measured on the ground: from the peg, along the venue's edges or by the compass."""

import math

import numpy as np
import pytest

from benchdragon.analysis.ground import Ground, base_angle, edge_lengths, own_peg, peg_line, way_out
from benchdragon.i18n import spoken_in
from benchdragon.model.obstacle import rectangle_outline
from benchdragon.plans.schema import Plan, checked, read_plan

BENCHES = ["dragon.benches=10", "walk.start=-5", "walk.end=20"]


def planned(*settings: str) -> tuple[Plan, Ground]:
    plan = read_plan("turn", [*BENCHES, *settings])
    return plan, Ground.of(plan, plan.build().route)


@pytest.mark.parametrize(("angle", "turned"), [(0, 0), (30, 30), (-20, -20), (80, -10), (120, 30)])
def test_the_base_line_runs_along_the_venues_longest_edge(angle: float, turned: float) -> None:
    outline = rectangle_outline("venue", (3.0, 1.0), (30.0, 20.0), math.radians(angle))
    assert base_angle(outline.tolist()) == pytest.approx(math.radians(turned), abs=1e-9)


def test_a_bent_edge_and_no_venue_leave_the_axes_of_the_plan() -> None:
    angles = np.linspace(0.1, 0.1 + math.tau, 25)[:-1]
    assert base_angle(np.column_stack([np.cos(angles), np.sin(angles)]).tolist()) == 0.0
    plan, ground = planned()
    assert (ground.turned, ground.venue, ground.y_word) == (0.0, False, "y")
    assert ground.peg == plan.build().route.centre


def test_x_and_y_are_lengths_along_the_edges_from_the_peg() -> None:
    _plan, ground = planned("venue.rectangle=[40, 30]", "venue.angle=30", "route.at=[1, 2]")
    ahead, aside = np.array([math.cos(0.5236), math.sin(0.5236)]), math.sqrt(0.75)
    along = np.array([ground.peg]) + 3.0 * ahead
    assert ground.seen(along)[0] == pytest.approx([3.0, 0.0], abs=1e-4)
    assert ground.seen([(ground.peg[0], ground.peg[1] + 2.0)])[0] == pytest.approx([1.0, 2.0 * aside])
    with spoken_in("zh"):
        assert ground.way_names == ("往右", "往前", "往左", "往后")
        assert "顺着场地的边线" in ground.legend
        assert ground.y_word == "往前"


def test_north_comes_before_the_venues_edges() -> None:
    _plan, ground = planned("survey.crs=EPSG:4549", "venue.rectangle=[40, 30]", "venue.angle=30")
    assert (ground.turned, ground.north, ground.venue) == (0.0, True, False)
    assert ground.way_names == ("due east", "due north", "due west", "due south")
    assert "y north" in ground.legend


def test_the_peg_is_told_by_lengths_to_the_venues_edge_each_way() -> None:
    plan, ground = planned("venue.rectangle=[40, 30]", "venue.angle=30", "venue.centre=[1, 2]")
    edges = next(one.outline for one in plan.obstacles() if one.kind == "venue")
    far = [way_out(edges, ground.peg, np.array(way)) for way in ground.ways]
    wanted = [one[0] for one in far if one is not None]
    edge = [(float(x), float(y)) for x, y in edges]
    assert edge_lengths(ground, edge) == pytest.approx(wanted)
    assert edge_lengths(ground, edge[::-1]) == pytest.approx(wanted)
    told = peg_line(ground, edge)
    assert f"it is {wanted[0]:.2f} m to the right, {wanted[1]:.2f} m forward, {wanted[2]:.2f} m" in told
    outside = Ground((40.0, 0.0), ground.turned, False, True)
    assert edge_lengths(outside, edge) is None
    assert peg_line(outside, edge) == ""


def test_the_peg_is_the_centre_of_the_route_where_it_is_danced_unless_the_plan_says_otherwise() -> None:
    for settings, peg in [
        (["route.at=[3, 4]"], (3.0, 4.0)),
        (["chalk.peg=[1, 2]", "route.at=[3, 4]"], (1.0, 2.0)),
    ]:
        plan, ground = planned(*settings)
        assert ground.peg == own_peg(plan, plan.build().route) == pytest.approx(peg)
    part = {"kind": "line", "length": 20}
    read = checked(
        {
            "schema": 1,
            "dragon": {"benches": 4},
            "route": {"kind": "parts", "at": [5, 6], "part": [part]},
            "walk": {"end": 5},
        },
        "plan",
    )
    assert own_peg(read, read.build().route) == (5.0, 6.0)


OCTAGON = [
    (-9.0, -3.0),
    (-3.0, -9.0),
    (3.0, -9.0),
    (9.0, -3.0),
    (9.0, 3.0),
    (3.0, 9.0),
    (-3.0, 9.0),
    (-9.0, 3.0),
]
L_SHAPE = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (10.0, 10.0), (10.0, 20.0), (0.0, 20.0)]


@pytest.mark.parametrize(
    ("outline", "place", "way", "far", "out"),
    [
        (L_SHAPE, (5.0, 5.0), (1.0, 0.0), 15.0, (1.0, 0.0)),
        (L_SHAPE, (5.0, 15.0), (1.0, 0.0), 5.0, (1.0, 0.0)),
        (L_SHAPE, (5.0, 10.0), (1.0, 0.0), 5.0, (1.0, 0.0)),  # along an edge from its corner on
        (L_SHAPE, (4.0, 4.0), (0.6, -0.8), 5.0, (0.0, -1.0)),
        (L_SHAPE, (12.0, 6.0), (2.0 / 5.0**0.5, 1.0 / 5.0**0.5), 80.0**0.5, (1.0, 0.0)),  # at a corner
        (L_SHAPE, (9.0, 4.0), None, 4.0, (0.0, -1.0)),
        (OCTAGON, (5.0, 5.0), None, 2.0**0.5, (0.5**0.5, 0.5**0.5)),
        (OCTAGON, (5.0, 5.0), (1.0, 0.0), 2.0, (0.5**0.5, 0.5**0.5)),
    ],
)
@pytest.mark.parametrize("turned_round", [False, True])
def test_the_way_out_of_a_venue_is_over_the_side_that_is_met(
    outline: list[tuple[float, float]],
    place: tuple[float, float],
    way: tuple[float, float] | None,
    far: float,
    out: tuple[float, float],
    turned_round: bool,
) -> None:
    corners = np.array(outline[::-1] if turned_round else outline)
    found = way_out(corners, place, None if way is None else np.array(way))
    assert found is not None
    assert found[0] == pytest.approx(far)
    assert found[1] == pytest.approx(out)
    assert way_out(corners, (40.0, 0.0)) is None
