"""Offsets of a bench's points from its route: textbook formulas, Fresnel's integrals, distances."""

import math
from cmath import exp

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import fresnel

import benchdragon as bd
from benchdragon.analysis import offsets
from benchdragon.model.curves import AnyCurve

VEHICLE = bd.Dragon([bd.Bench(26.0, 3.1, 4.0, 4.0)])
# Length, m, and curvatures at both ends, 1/m.
Piece = tuple[float, float, float]


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("radius", [150.0, 300.0, 1200.0, 4000.0])
def test_throws_on_a_circle_are_those_of_the_textbooks(radius: float, side: float) -> None:
    length, width, front, rear = 25.0, 2.9, 3.5, 4.5
    placed = bd.Placement(
        bd.Dragon([bd.Bench(length, width, front, rear)]), bd.Route((bd.Arc(radius, side),)), [100.0]
    )
    link = length - front - rear
    h = math.sqrt(radius**2 - (link / 2.0) ** 2)
    along = np.linspace(-link / 2.0 - rear, link / 2.0 + front, 41)
    on_line = bd.bench_offsets(placed, points=[(x, 0.0) for x in along])
    np.testing.assert_allclose(
        on_line.offset[0], side * (radius - np.hypot(h, along)), rtol=0.0, atol=1e-11
    )
    corners = bd.bench_offsets(placed).offset[0]
    ends = np.array([link / 2.0 + front, -link / 2.0 - rear, -link / 2.0 - rear, link / 2.0 + front])
    inwards = side * np.array([1.0, 1.0, -1.0, -1.0]) * width / 2.0
    wanted = side * (radius - np.hypot(h - inwards, ends))
    np.testing.assert_allclose(corners, wanted, rtol=0.0, atol=1e-11)


def chord(u: float, start: float, change: float) -> complex:
    """From the start of a clothoid, where its heading is 0, to arc length u, m."""
    if change == 0.0:
        return u + 0j if start == 0.0 else (exp(1j * start * u) - 1.0) / (1j * start)
    scale = math.sqrt(abs(change) / math.pi)
    (s1, c1), (s0, c0) = (fresnel(scale * (v + start / change)) for v in (u, 0.0))
    across = 1j * math.copysign(1.0, change) * (s1 - s0)
    return complex(exp(-0.5j * start**2 / change) * (c1 - c0 + across) / scale)


def pose(s: float, pieces: list[Piece]) -> tuple[complex, complex]:
    """Point and unit tangent of a track at s, m."""
    point, turned = 0j, 0.0
    for size, start, end in pieces:
        u, change = min(s, size), (end - start) / size
        point += exp(1j * turned) * chord(u, start, change)
        turned += u * start + 0.5 * u**2 * change
        s -= u
    return point, exp(1j * turned)


def by_fresnel(lead: float, pieces: list[Piece], points: list[tuple[float, float]]) -> list[complex]:
    """Place on the track and offset of points of VEHICLE, m, as complex numbers."""
    a = float(VEHICLE.links[0])
    first = pose(lead, pieces)[0]
    trail = brentq(
        lambda v: abs(first - pose(v, pieces)[0]) - a, lead - 1.1 * a, lead - 0.9 * a, xtol=1e-13
    )
    last = pose(trail, pieces)[0]
    found = []
    for ahead, left in points:
        body = (first + last) / 2.0 + (ahead + 1j * left) * (first - last) / a

        def seen(v: float, body: complex = body) -> complex:
            point, tangent = pose(v, pieces)
            return (body - point) / tangent

        guess = (lead + trail) / 2.0 + ahead
        foot = brentq(lambda v: seen(v).real, guess - 3.0, guess + 3.0, xtol=1e-13)
        found.append(complex(foot, seen(foot).imag))
    return found


def curve(piece: Piece) -> AnyCurve:
    length, start, end = piece
    if start == end == 0.0:
        return bd.Line(length)
    return bd.Arc(1.0 / abs(start), start * length) if start == end else bd.Clothoid(length, start, end)


def random_track(random: np.random.Generator) -> list[Piece]:
    """A straight, then clothoids and arcs of 150 m and more both ways, some shorter than VEHICLE."""
    bends = random.uniform(-1.0, 1.0, 4) / 150.0
    pieces: list[Piece] = [(60.0, 0.0, 0.0)]
    before = 0.0
    for bend in bends.tolist():
        pieces.append((float(random.uniform(5.0, 60.0)), before, bend))
        if random.random() < 0.7:
            pieces.append((float(random.uniform(2.0, 60.0)), bend, bend))
        before = bend if random.random() < 0.8 else -bend
    return pieces


@pytest.mark.parametrize("seed", range(12))
def test_throws_on_transitions_are_those_of_fresnels_integrals(seed: int) -> None:
    random = np.random.default_rng(seed)
    pieces = random_track(random)
    route = bd.Route.joined([curve(piece) for piece in pieces])
    points = [(0.0, 0.0), (13.0, 0.0), (-13.0, 0.0), (13.0, 1.55), (-13.0, -1.55), (4.0, 1.55)]
    lead = np.sort(random.uniform(30.0, route.length - 8.0, 25))
    found = bd.bench_offsets(bd.Placement(VEHICLE, route, lead), points=points)
    wanted = np.array([by_fresnel(s, pieces, points) for s in lead.tolist()])
    assert np.abs(wanted.imag).max() > 0.1
    np.testing.assert_allclose(found.offset, wanted.imag, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(found.s, wanted.real, rtol=0.0, atol=1e-9)


def test_the_offset_is_the_least_distance_to_the_route_beside_the_bench() -> None:
    walk = bd.read_plan("turn").build()
    motion = walk.motion(np.linspace(-20.0, 60.0, 9))
    for bench in (1, 2, 30, 223):
        found = bd.bench_offsets(motion, bench)
        for t, (front, rear) in enumerate(motion.s[:, [bench - 1, bench]]):
            beside = walk.route.point(np.linspace(rear - 0.6, front + 0.6, 40001))
            for x, y, offset in zip(found.x[t], found.y[t], found.offset[t], strict=True):
                least = np.hypot(*(beside - (x, y)).T).min()
                assert abs(offset) <= least + 1e-12
                assert least - abs(offset) < 1e-6


def test_corners_are_those_of_the_bench_front_left_first() -> None:
    dragon = bd.Dragon([bd.Bench(2.0, 0.4, 0.1, 0.3)])
    placed = bd.Placement(dragon, bd.Route((bd.Line(9.0, (1.0, 2.0), math.pi / 2.0),)), [5.0])
    found = bd.bench_offsets(placed)
    np.testing.assert_allclose(found.x, [[0.8, 0.8, 1.2, 1.2]], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found.y, [[7.1, 5.1, 5.1, 7.1]], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found.s, [[5.1, 3.1, 3.1, 5.1]], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found.offset, [[0.2, 0.2, -0.2, -0.2]], rtol=0.0, atol=1e-12)


def test_another_turn_of_the_route_that_comes_nearer_does_not_count() -> None:
    motion = bd.read_plan("spiral-in").build().motion(0.0)
    offset = bd.bench_offsets(motion, 20, [(0.0, 0.5)]).offset[0, 0]
    assert 0.4 < offset < 0.6  # the next turn outwards is 0.05 m away


def test_at_a_kink_the_nearest_point_is_the_kink() -> None:
    kinked = bd.Route((bd.Line(10.0), bd.Line(10.0, (10.0, 0.0), 0.3)), kinks=True)
    placed = bd.Placement(bd.Dragon([bd.Bench(2.0, 0.2, 0.0, 0.0)]), kinked, [10.0 + 1e-12])
    found = bd.bench_offsets(placed, points=[(1.2, -0.8)])
    assert found.s[0, 0] == pytest.approx(10.0, abs=1e-9)
    assert found.offset[0, 0] == pytest.approx(-math.hypot(0.2, 0.8), abs=1e-9)


def test_a_straight_route_runs_on_behind_its_start() -> None:
    placed = bd.Placement(VEHICLE, bd.Route((bd.Line(100.0),)), [1.0])
    found = bd.bench_offsets(placed, points=[(-13.0, 0.5)])
    assert (found.s[0, 0], found.offset[0, 0]) == (pytest.approx(-21.0), pytest.approx(0.5))


def test_what_lies_beyond_the_route_is_refused_with_the_place() -> None:
    placed = bd.Placement(VEHICLE, bd.Route((bd.Line(100.0),)), [90.0, 98.0])
    with pytest.raises(
        bd.InputError, match=r"head at s = 98 m .* bench 1 that is 13 m ahead .* 1.55 m to"
    ):
        bd.bench_offsets(placed)
    np.testing.assert_array_equal(bd.bench_offsets(placed, points=[(11.0, 1.0)]).offset, [[1.0], [1.0]])
    with pytest.raises(bd.InputError, match="-13 m ahead"):
        bd.bench_offsets(
            bd.Placement(VEHICLE, bd.Route((bd.Arc(100.0, 2.0),)), [19.0]), points=[(-13, 0)]
        )


def test_bad_points_benches_and_numbers_of_them_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    placed = bd.Placement(VEHICLE, bd.Route((bd.Line(100.0),)), [50.0, 60.0])
    for points in ([1.0, 2.0], [(1.0, 2.0, 3.0)], [(1.0, math.nan)], [(1.0, math.inf)], [(1.1e4, 0.0)]):
        with pytest.raises(bd.InputError, match=r"points must be a list of pairs \(ahead, left\)"):
            bd.bench_offsets(placed, points=points)
    for bench in (0, 2):
        with pytest.raises(bd.InputError, match="bench must be"):
            bd.bench_offsets(placed, bench)
    assert bd.bench_offsets(placed, points=np.empty((0, 2))).offset.shape == (2, 0)
    monkeypatch.setattr(offsets, "MOST_POINTS", 7)
    with pytest.raises(bd.InputError, match=r"8 points .* more than 7"):
        bd.bench_offsets(placed)
    assert bd.bench_offsets(placed, points=[(0.0, 0.0)] * 3).offset.shape == (2, 3)


def test_a_dragon_that_cannot_stand_is_told_of() -> None:
    placed = bd.Placement(VEHICLE, bd.Route((bd.Arc(100.0, 2.0),)), [50.0, 5.0])
    with pytest.raises(bd.WalkError, match="bench 1 has no place"):
        bd.bench_offsets(placed)
