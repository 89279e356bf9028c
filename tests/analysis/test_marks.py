"""Marks on the ground: where the route is, and where two lengths of a tape say they are."""

import math
import re
from itertools import pairwise

import numpy as np
import pytest

from benchdragon.analysis import marks as marks_module
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.marks import (
    LENGTH_STEP,
    MOST_MARKS,
    Marks,
    Trail,
    angles_of,
    placed_marks,
    rounded,
)
from benchdragon.errors import InputError
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.marks import CLOSE_MARKS
from benchdragon.model.curves import Arc, Line, Route
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.schema import checked, read_plan

PEG = (3.0, 4.0)


@pytest.fixture(scope="module")
def trail() -> Trail:
    """Ten benches that turn round in a spiral and out."""
    plan = read_plan("turn", ["dragon.benches=10", "walk.start=-5", "walk.end=20"])
    return Trail.of(plan.build(), -5.0, 20.0)


@pytest.fixture(scope="module")
def marks(trail: Trail) -> Marks:
    return placed_marks(trail, 0.7, PEG)


def test_marks_are_points_of_the_route_each_step_each_joint_and_at_both_ends(
    trail: Trail, marks: Marks
) -> None:
    assert np.abs(marks.points - trail.route.point(marks.s)).max() < 1e-9
    assert (marks.s[0], marks.s[-1]) == (trail.low, trail.high)
    assert marks.way[-1] == pytest.approx(trail.high - trail.low, abs=1e-9)
    tail = trail.route.point(trail.low)
    motion = read_plan("turn", ["dragon.benches=10"]).build().motion([-5.0])
    assert tail == pytest.approx([motion.x[0, -1], motion.y[0, -1]], abs=1e-9)
    inner = [s for s in trail.route.joints if trail.low < s < trail.high]
    assert inner
    kinds = dict(zip(marks.s.tolist(), marks.kinds, strict=True))
    assert [s for s, kind in kinds.items() if kind == "joint"] == inner
    assert [s for s, kind in kinds.items() if kind == "start"] == [trail.start]
    steps = np.array([s for s, kind in kinds.items() if kind == "step"])
    counts = (steps - trail.start) / 0.7
    assert np.abs(counts - np.round(counts)).max() < 1e-9
    assert max(b - a for a, b in pairwise(marks.s)) <= 0.7 + CLOSE_MARKS


def test_lengths_and_angles_are_from_the_peg_wherever_it_stands(marks: Marks) -> None:
    x, y = marks.points.T
    assert marks.radius == pytest.approx(np.hypot(x - 3.0, y - 4.0), abs=1e-9)
    turned = np.radians(marks.angle)
    assert 3.0 + marks.radius * np.cos(turned) == pytest.approx(x, abs=1e-9)
    assert 4.0 + marks.radius * np.sin(turned) == pytest.approx(y, abs=1e-9)
    apart = np.diff(marks.points, axis=0)
    assert marks.before[1:] == pytest.approx(np.sqrt((apart**2).sum(axis=1)), abs=1e-9)
    assert marks.before[0] == 0.0


def test_bearings_run_clockwise_from_y_and_other_angles_the_other_way_from_x(trail: Trail) -> None:
    ways = np.array([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, -1.0)])
    assert angles_of(ways, north=False).tolist() == [0.0, 90.0, 180.0, 270.0, 315.0]
    assert angles_of(ways, north=True).tolist() == [90.0, 0.0, 270.0, 180.0, 135.0]
    towards_north = placed_marks(trail, 1.0, Ground(PEG, north=True))
    assert ((towards_north.bases - PEG) / towards_north.reach).tolist() == [[0.0, 1.0], [-1.0, 0.0]]


def _crossing(
    peg: FloatArray, base: FloatArray, lengths: tuple[float, float], left: bool
) -> FloatArray:
    """Where two circles cross, to the left or right of the line from the first centre to the other."""
    way = base - peg
    far = math.hypot(*way)
    along = (lengths[0] ** 2 - lengths[1] ** 2 + far**2) / (2.0 * far)
    aside = math.sqrt(max(lengths[0] ** 2 - along**2, 0.0)) * (1.0 if left else -1.0)
    unit = way / far
    return np.asarray(peg + along * unit + aside * np.array([-unit[1], unit[0]]))


@pytest.mark.parametrize("peg", [(0.0, 0.0), PEG, (40.0, -7.0)])
def test_two_rounded_lengths_find_each_mark_as_exactly_as_is_said(
    peg: tuple[float, float], trail: Trail
) -> None:
    marks = placed_marks(trail, 0.5, peg)
    off = []
    for n in range(len(marks)):
        lengths = rounded(marks.radius[n], LENGTH_STEP), rounded(marks.cross[n], LENGTH_STEP)
        base = marks.bases[marks.base[n]]
        off.append(
            math.dist(_crossing(np.array(peg), base, lengths, marks.on_left[n]), marks.points[n])
        )
    assert max(off) <= 1.01 * marks.tape_error
    assert 0.1 * marks.tape_error < max(off)
    assert marks.tape_error < 0.03


def test_rounding_is_to_the_nearest_step_and_its_errors_are_reached(marks: Marks) -> None:
    assert rounded(1.2374, LENGTH_STEP) == pytest.approx(1.235, abs=1e-12)
    assert rounded(1.2376, LENGTH_STEP) == pytest.approx(1.24, abs=1e-12)
    assert marks.grid_error == pytest.approx(math.hypot(0.0025, 0.0025))
    farthest = float(marks.radius.max())
    assert marks.angle_error == pytest.approx(math.hypot(0.0025, math.radians(0.005) * farthest))


def test_ground_that_is_walked_again_is_marked_once() -> None:
    side, bend = Line(4.0), Arc(2.0, math.pi)
    lap = Route.joined((side, bend, side, bend)).curves
    once = Trail(Route(lap), 0.0, 0.0, Route(lap).length)
    thrice = Trail(Route(lap * 3), 0.0, 0.0, 3.0 * Route(lap).length)
    first, again = placed_marks(once, 1.0, (0.0, 0.0)), placed_marks(thrice, 1.0, (0.0, 0.0))
    assert again.s[:-1] == pytest.approx(first.s[:-1])
    assert again.points == pytest.approx(first.points, abs=1e-9)
    later = Trail(Route(lap * 3), 1.0, 0.0, 2.0 * Route(lap).length)
    assert placed_marks(later, 1.0, (0.0, 0.0)).s[-1] > Route(lap).length
    stopped = placed_marks(Trail(Route(lap * 3), 0.0, 3.0, 2.3 * first.s[-1]), 1.0, (0.0, 0.0))
    assert stopped.s[-1] == 2.3 * first.s[-1]
    assert (stopped.kinds.count("end"), stopped.kinds.count("start")) == (2, 1)
    assert first.s[-1] - 1.0 < stopped.s[-2] <= first.s[-1]
    circle = Trail(Route((Arc(2.0, 3.0 * math.tau),)), 0.0, 0.0, 12.0 * math.pi)
    assert placed_marks(circle, 1.0, (0.0, 0.0)).s[-2] < 4.0 * math.pi


def test_marks_a_hand_apart_are_one_but_start_and_ends_stay() -> None:
    route = Route.joined((Line(3.15), Line(6.85)))
    marks = placed_marks(Trail(route, 0.0, 0.0, 7.02), 1.0, (0.0, 0.0))
    assert marks.s.tolist() == [0.0, 1.0, 2.0, 3.15, 4.0, 5.0, 6.0, 7.02], "joint and end, no step"
    assert (marks.kinds[3], marks.kinds[-1]) == ("joint", "end")
    short = placed_marks(Trail(route, 0.0, 0.1, 0.25), 1.0, (0.0, 0.0))
    assert short.s.tolist() == [0.0, 0.1, 0.25]
    fine = placed_marks(Trail(route, 0.0, 0.0, 1.0), 0.1, (0.0, 0.0))
    assert len(fine) == 11, "marks that are expected so near stay"


def test_rounds_of_a_formation_are_marked_once_though_their_ends_differ_by_rounding() -> None:
    trails = []
    for rounds in (1, 2):
        route = {"kind": "formation", "name": "figure-eight", "rounds": rounds}
        plan = checked({"schema": 1, "dragon": {"benches": 15}, "route": route}, "eight")
        walk = plan.build()
        trails.append(Trail.of(walk, *plan.span(walk)))
    once, twice = (placed_marks(one, 1.0, (0.0, 0.0)) for one in trails)
    assert trails[1].high - trails[1].low > 1.7 * (trails[0].high - trails[0].low)
    assert len(twice) <= len(once) + 2


def test_base_points_stand_within_the_venue_and_on_no_obstacle(trail: Trail) -> None:
    free = placed_marks(trail, 1.0, (0.0, 0.0))
    assert free.bases.tolist() == [[free.reach, 0.0], [0.0, free.reach]]
    assert free.reach == math.ceil(free.radius.max())
    edge = Obstacle.venue("edge", [(-60, -60), (5.5, -60), (5.5, 60), (-60, 60)])
    assert placed_marks(trail, 1.0, (0.0, 0.0), obstacles=(edge,)).bases.tolist() == [
        [0.0, free.reach],
        [-free.reach, 0.0],
    ]
    corner = Obstacle.venue("corner", [(-5.5, -5.5), (5.5, -5.5), (5.5, 5.5), (-5.5, 5.5)])
    well = Obstacle.rectangle("well", (5.0, 0.0), (0.5, 0.5))
    small = placed_marks(trail, 1.0, (0.0, 0.0), obstacles=(corner, well))
    assert small.bases.tolist() == [[0.0, 5.0], [-5.0, 0.0]]


def test_marks_that_nobody_spaced_are_a_metre_apart_or_as_much_more_as_is_needed(
    trail: Trail, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert trail.usual_every == 1.0
    monkeypatch.setattr(marks_module, "MOST_MARKS", 10)
    every = trail.usual_every
    assert every > 1.0
    assert len(placed_marks(trail, every, PEG)) > 8
    with pytest.raises(InputError, match=re.escape(f"ask for at least {every:g} m between them")):
        placed_marks(trail, every - 0.1, PEG)


def test_a_peg_that_no_tape_reaches_is_refused(trail: Trail) -> None:
    x, y = trail.route.point(trail.low)
    assert placed_marks(trail, 1.0, (x, y - 150.0)).reach > 150.0
    with pytest.raises(InputError, match=r"the peg is \d+ m from the nearest mark, farther than 200 m"):
        placed_marks(trail, 1.0, (1e12, 0.0))


def test_marks_too_near_or_too_many_are_refused(trail: Trail) -> None:
    with pytest.raises(InputError, match=re.escape("marks must be at least 0.1 m apart, not 0.05 m")):
        placed_marks(trail, 0.05, PEG)
    with pytest.raises(InputError, match=r"at least 0\.1 m apart, not nan m"):
        placed_marks(trail, math.nan, PEG)
    long = Trail(Route((Line(9000.0),)), 0.0, 0.0, 9000.0)
    with pytest.raises(InputError, match=rf"more than {MOST_MARKS}: ask for at least 1\.8 m"):
        placed_marks(long, 1.0, PEG)
    assert len(placed_marks(long, 1.8, PEG)) <= MOST_MARKS + 2
