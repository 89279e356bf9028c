"""Connections are the shortest of their kinds, and programmes join formations by them."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import optimize

from benchdragon.errors import InputError
from benchdragon.kernels.connections import crossings
from benchdragon.model.connections import Connection, Pose, Step, connections, programme
from benchdragon.model.curves import Arc, Line, Route
from benchdragon.model.formations import (
    CoilIn,
    CoilOut,
    FigureEight,
    StraightDragon,
    TailSwing,
    least_radius,
)

FULL = 2.0 * math.pi
poses = st.tuples(st.tuples(st.floats(-30, 30), st.floats(-30, 30)), st.floats(-9.0, 9.0))
radii = st.floats(0.5, 8.0)
LETTERS = {"L": 1.0, "S": 0.0, "R": -1.0}


def missed(pose: Pose, end: Pose) -> float:
    (point, heading), (goal, wanted) = pose, end
    return math.dist(point, goal) + abs(math.remainder(heading - wanted, FULL))


@given(poses, poses, radii)
def test_each_connection_leads_from_the_one_pose_to_the_other_in_bends_of_the_radius(
    start: Pose, end: Pose, radius: float
) -> None:
    found = connections(start, end, radius)
    assert {"LSL", "RSR"} <= {one.word for one in found}
    assert all(a.length <= b.length * (1.0 + 1e-9) for a, b in pairwise(found))
    for one in (one for one in found if one.curves):
        route = Route(one.curves)  # which refuses gaps and kinks
        assert missed(route.start_pose, start) < 1e-11
        assert missed(route.end_pose, end) < 1e-11
        assert least_radius(route) >= radius * (1.0 - 1e-12)
        assert one.length == pytest.approx(route.length, rel=1e-12)


@given(poses, radii)
def test_nothing_lies_between_poses_that_are_the_same(pose: Pose, radius: float) -> None:
    assert connections(pose, pose, radius)[0] == Connection("LSL", ())


@given(poses, st.floats(1.0, 50.0), radii, st.sampled_from([1.0, -1.0]))
def test_ahead_a_line_leads_and_round_a_circle_an_arc(
    pose: Pose, length: float, radius: float, side: float
) -> None:
    line = Line(length, *pose)
    shortest = connections(pose, line.end_pose, radius)[0]
    assert shortest.length == pytest.approx(length, rel=1e-9)
    arc = Arc(radius, side * min(3.0, length / radius), *pose)
    shortest = connections(pose, arc.end_pose, radius)[0]
    assert shortest.length == pytest.approx(arc.length, rel=1e-7)


def end_of(start: Pose, word: str, sizes: Any, radius: float) -> Any:
    """Where a word of such sweeps (rad) and lines (m) leads, complex, and the heading there."""
    (x, y), heading = start
    point = complex(x, y)
    for letter, size in zip(word, sizes, strict=True):
        side = LETTERS[letter]
        if side:
            turned = heading + side * size
            point += -1j * side * radius * (np.exp(1j * turned) - np.exp(1j * heading))
            heading = turned
        else:
            point += size * np.exp(1j * heading)
    return point, heading


def searched(start: Pose, end: Pose, radius: float, rng: np.random.Generator) -> float:
    """The shortest way of the six kinds that scipy finds from random beginnings, m."""
    goal, wanted = complex(*end[0]), np.exp(1j * end[1])

    def off(sizes: Any, word: str) -> list[float]:
        point, heading = end_of(start, word, sizes, radius)
        turned = np.exp(1j * heading) - wanted
        return [(point - goal).real, (point - goal).imag, turned.real, turned.imag]

    shortest = math.inf
    reach = abs(goal - complex(*start[0])) + 4.0 * radius
    for word in ("LSL", "RSR", "LSR", "RSL", "LRL", "RLR"):
        most = np.array([reach if letter == "S" else FULL for letter in word])
        for _trial in range(12):
            found = optimize.least_squares(
                off, rng.uniform(0.0, 1.0, 3) * most, bounds=(0.0, most + 1e-9),
                args=(word,), xtol=1e-15, ftol=1e-15, gtol=1e-15,
            )  # fmt: skip
            if np.abs(found.fun).max() < 1e-10:
                lengths = [
                    size if letter == "S" else radius * size
                    for letter, size in zip(word, found.x, strict=True)
                ]
                shortest = min(shortest, sum(lengths))
    return shortest


@pytest.mark.parametrize("seed", range(12))
def test_the_shortest_is_no_longer_than_what_scipy_finds(seed: int) -> None:
    rng = np.random.default_rng(seed)
    apart = 5.0 if seed % 2 else 20.0  # near poses need three arcs
    start, end = (
        ((float(x), float(y)), float(heading))
        for x, y, heading in rng.uniform(-1.0, 1.0, (2, 3)) * [apart, apart, math.pi]
    )
    radius = float(rng.uniform(1.0, 4.0))
    other = searched(start, end, radius, rng)
    assert math.isfinite(other)
    assert connections(start, end, radius)[0].length <= other + 1e-9


@given(poses, poses, radii, st.floats(1.01, 3.0))
def test_wider_bends_make_no_shorter_way(start: Pose, end: Pose, radius: float, wider: float) -> None:
    short, long = (connections(start, end, r)[0].length for r in (radius, radius * wider))
    assert short <= long + 1e-9


@given(poses, poses, radii, st.floats(-9.0, 9.0), poses)
def test_moved_poses_are_joined_by_the_same_way_moved(
    start: Pose, end: Pose, radius: float, turned: float, by: Pose
) -> None:
    cos, sin = math.cos(turned), math.sin(turned)

    def moved(pose: Pose) -> Pose:
        (x, y), heading = pose
        return (x * cos - y * sin + by[0][0], x * sin + y * cos + by[0][1]), heading + turned

    lengths = [
        connections(*ends, radius)[0].length for ends in ((start, end), (moved(start), moved(end)))
    ]
    # Where a full turn becomes none by rounding, lengths leap: both are ways that lead there.
    assert (
        abs(lengths[0] - lengths[1]) < 1e-8 or abs(abs(lengths[0] - lengths[1]) - FULL * radius) < 1e-8
    )


def test_a_programme_is_its_formations_and_the_connections_between_them() -> None:
    steps = [
        Step(CoilOut(0.8, 3.0, 7.0), (-9.0, 2.0), 0.3),
        Step(FigureEight(6.0), (30.0, 4.0), -1.0),
        Step(CoilIn(0.9, 6.0, 2.0), (0.0, -20.0)),
    ]
    route = programme(steps, 2.0)
    alone = [step.formation.build().moved(step.turned, step.at or (0.0, 0.0)) for step in steps]
    first, second = (
        min(one.length for one in connections(a.end_pose, b.start_pose, 2.0))
        for a, b in pairwise(alone)
    )
    assert route.length >= sum(one.length for one in alone) + first + second - 1e-9
    assert route.length == pytest.approx(sum(curve.length for curve in route))
    assert least_radius(route) >= min(2.0, *(step.formation.least_radius for step in steps)) - 1e-9
    assert missed(route.start_pose, alone[0].start_pose) < 1e-9
    assert missed(route.end_pose, alone[-1].end_pose) < 1e-9
    s = np.linspace(0.0, alone[0].length, 100)
    assert np.abs(route.point(s) - alone[0].point(s)).max() < 1e-9
    back = np.linspace(0.0, alone[2].length, 100)
    assert (
        np.abs(route.point(route.length - back) - alone[2].point(alone[2].length - back)).max() < 1e-9
    )


def test_a_formation_without_a_place_begins_where_the_one_before_it_ends() -> None:
    steps = [Step(StraightDragon(50.0), (3.0, 4.0), 1.0), Step(TailSwing(run=0.0)), Step(CoilIn())]
    route = programme(steps, 2.0)
    assert len(route) == 1 + len(TailSwing(run=0.0).build()) + 1
    there = Step(CoilIn(), (200.0, 9.0))
    after = programme([*steps, there], 2.0)
    assert after.end_pose[0] == pytest.approx(programme([there], 2.0).end_pose[0])
    assert route.length == pytest.approx(sum(step.formation.build().length for step in steps))
    assert route.start_pose[0] == pytest.approx(
        (3.0 - 25.0 * math.cos(1.0), 4.0 - 25.0 * math.sin(1.0))
    )


def test_the_connection_inside_a_coil_is_the_one_that_crosses_no_turn() -> None:
    into = CoilIn(1.7, 9.0, 4.0)
    out = CoilOut(1.7, 4.0, 9.0, clockwise=False)
    route = programme([Step(into, (0.0, 0.0)), Step(out, (0.0, 0.0), math.pi)], 1.5)
    there = route.point(np.linspace(0.0, route.length, 3000))
    assert crossings(there, there) == 0
    between = route.length - into.build().length - out.build().length
    assert 8.0 < between < 14.0


def test_a_longer_connection_is_taken_where_the_shortest_would_cross() -> None:
    coil = CoilOut(0.8, 2.0, 6.0)
    beside = Step(StraightDragon(4.0), (6.0, 12.0))
    ways = connections(coil.build().end_pose, ((4.0, 12.0), 0.0), 2.0)
    crossed = [crossings_of(Route(way.curves), coil.build()) for way in ways]
    assert (ways[0].word, ways[1].word) == ("RSR", "LSR")
    assert crossed[0] > crossed[1] == min(crossed) == 0
    route = programme([Step(coil), beside], 2.0)
    assert route.length == pytest.approx(coil.build().length + ways[1].length + 4.0)


def crossings_of(one: Route, other: Route) -> int:
    a, b = (route.point(np.linspace(0.0, route.length, 2001)) for route in (one, other))
    return crossings(a[1:-1], b)


def test_chords_that_cross_are_counted() -> None:
    cross = np.array([[0.0, 0.0], [2.0, 2.0], [4.0, 0.0]])
    flat = np.array([[0.0, 1.0], [5.0, 1.0]])
    assert crossings(cross, flat) == crossings(flat, cross) == 2
    assert crossings(cross, flat + 5.0) == 0
    assert crossings(cross, cross) == 0
    beside = np.array([[3.5, 1.0], [15.0, 1.0]])  # whose line, carried on, would be crossed
    assert crossings(cross, beside) == crossings(beside, cross) == 0


def test_what_cannot_be_joined_is_refused() -> None:
    pose = (0.0, 0.0), 0.0
    with pytest.raises(InputError, match="radius"):
        connections(pose, pose, 0.0)
    with pytest.raises(InputError, match="heading"):
        connections(pose, ((1.0, 0.0), math.nan), 1.0)
    with pytest.raises(InputError, match="at least one formation"):
        programme([], 1.0)
    with pytest.raises(InputError, match="turned has no effect without at"):
        Step(CoilIn(), None, 1.0)
    wrong: Any = "coil-in"
    with pytest.raises(InputError, match="formation"):
        Step(wrong)
