"""Routes in ball arithmetic: every kind of curve is enclosed, and rows join without a gap."""

from itertools import pairwise

import mpmath
import numpy as np
import pytest

from benchdragon.kernels.curve import CurveKind, RouteRow

pytest.importorskip("flint")
from flint import arb

from benchdragon import Arc, Clothoid, InputError, Line, LogSpiral, Route, Spiral
from benchdragon.kernels import curve as kernel
from benchdragon.proofs.ball_route import BallRoute, Row
from tests.kernels.reference import points

ROUTES = [
    Route.joined([Line(30.0), Arc(3.0, 3.0), Line(12.0)]),
    Route.joined([Line(30.0), Clothoid(6.0, 0.0, 0.4), Arc(2.5, 2.2), Line(9.0)]),
    Route.joined([Line(5.0), LogSpiral(6.0, 0.1, 0.4), LogSpiral(4.0, 0.4, 0.2)]),
    Route((Spiral(0.55, 100.0, 20.0),)),
    Route((Spiral(0.55, 20.0, 100.0, (3.0, -2.0), 0.7, mirrored=True),)),
    Route.joined([Line(3.0), Clothoid(9.0, 0.9, -0.9), Line(2.0)]),
]
SHARES = (0.0, 0.13, 0.5, 0.9, 1.0)


def between(row: Row, share: float) -> arb:
    """A parameter of a row."""
    return row.start + (row.end - row.start) * share


@pytest.mark.parametrize("route", ROUTES)
def test_points_tangents_and_bends_are_those_of_the_formulas(route: Route) -> None:
    balls = BallRoute.stored(route.rows)
    assert float(balls.length) == pytest.approx(route.length, abs=1e-11)
    for j, row in enumerate(balls.rows):
        for share in SHARES:
            u = between(row, share)
            s, pose = float(row.position(u)), row.pose(u)
            assert max(float(value.rad()) for value in pose) < 1e-25
            x, y, tx, ty = (float(value) for value in pose)
            here = complex(points(route, min(s, route.length))[0])
            assert abs(complex(x, y) - here) < 2e-11
            assert np.hypot(tx, ty) == pytest.approx(1.0, abs=1e-14)
            s = min(max(s, 1e-5), route.length - 1e-5)
            chord = points(route, [s - 1e-5, s + 1e-5])
            way = complex(chord[1] - chord[0])
            assert abs(complex(tx, ty) - way / abs(way)) < 1e-4
            bend = kernel.curvature(route.rows, j, float(u))
            assert float(row.bend(u)) == pytest.approx(bend, abs=1e-9)


def test_a_spiral_is_known_with_thirty_digits() -> None:
    (row,) = BallRoute.stored(ROUTES[3].rows).rows
    u = between(row, 0.37)
    with mpmath.workdps(60):
        theta = mpmath.mpf(u.mid().str(50, radius=False))
        p = mpmath.mpf(float(row.p))
        root = mpmath.sqrt(1 + theta**2)
        length = p * (theta * root + mpmath.asinh(theta)) / 2
        wanted = p * theta * mpmath.cos(theta), p * theta * mpmath.sin(theta), length
        for value, ball in zip(wanted, (*row.pose(u)[:2], row.length(u)), strict=True):
            off = abs(value - mpmath.mpf(ball.mid().str(50, radius=False)))
            assert off < mpmath.mpf(10) ** -30 + mpmath.mpf(float(ball.rad()))


@pytest.mark.parametrize(("bend", "change"), [(0.9, -0.2), (-0.4, 0.5), (0.0, 3.0), (7.0, -9.0)])
def test_a_clothoid_is_known_with_thirty_digits(bend: float, change: float) -> None:
    zero, length = arb(0), arb(2.5)
    row = Row(
        CurveKind.CLOTHOID,
        zero,
        zero,
        arb(0.3),
        arb(bend),
        arb(change),
        zero,
        length,
        1,
        0.0,
        zero,
        0.0,
    )
    with mpmath.workdps(45):
        for u in (0.0, 0.625, 2.5, 2.75):  # the last lies beyond the end
            parts = [u * n / 8.0 for n in range(9)]
            phase = [mpmath.mpf(v) for v in (0.3, bend, change)]
            exact = mpmath.quad(
                lambda t, p=phase: mpmath.expj(p[0] + p[1] * t + p[2] * t * t / 2), parts
            )
            for ball, wanted in zip(row.pose(arb(u)), (exact.real, exact.imag), strict=False):
                off = abs(ball - arb(mpmath.nstr(wanted, 42)))
                assert off < 1e-33
                assert not off > ball.rad() + arb(1e-38)


@pytest.mark.parametrize("route", ROUTES)
def test_what_a_heading_turns_through_is_the_integral_of_the_bend(route: Route) -> None:
    turned = 0.0
    for row in BallRoute.stored(route.rows).rows:
        assert row.turned == pytest.approx(turned, abs=1e-9)
        u = np.linspace(float(row.start), float(row.end), 4001)
        bend = np.abs([float(row.bend(arb(v))) for v in u.tolist()])
        metres = np.abs([float(row.position(arb(v))) for v in u.tolist()])
        turned += float(np.trapezoid(bend, metres))
        assert row.turning(float(row.end)) == pytest.approx(turned - row.turned, abs=1e-5)
        turned = row.turned + row.turning(float(row.end))


def test_rows_begin_where_the_one_before_ends() -> None:
    rows = ROUTES[1].rows.copy()
    rows[2:, RouteRow.X] += 3e-10
    rows[2, RouteRow.ANGLE] += 4e-10
    balls = BallRoute.stored(rows).rows
    for before, row in pairwise(balls):
        for one, other in zip(before.pose(before.end), row.pose(row.start), strict=True):
            assert abs(one - other) < 1e-25
        assert abs(before.position(before.end) - row.s) < 1e-25


def test_a_kink_stays_and_counts() -> None:
    corner = Route((Line(5.0), Line(5.0, (5.0, 0.0), 0.4)), kinks=True)
    _line, row = BallRoute.stored(corner.rows).rows
    assert float(row.pose(row.start)[2]) == pytest.approx(np.cos(0.4))
    assert 0.4 <= row.turned < 0.4 + 1e-8


def test_the_radius_of_a_parameter_is_part_of_its_pose() -> None:
    for route in ROUTES:
        for row in BallRoute.stored(route.rows).rows:
            wide = between(row, 0.5) + arb(0, 1e-3)
            for share in (-1.0, 0.3, 1.0):
                exact = row.pose(between(row, 0.5) + 1e-3 * share)
                assert all(a.overlaps(b) for a, b in zip(row.pose(wide), exact, strict=True))
            assert row.bend(wide).overlaps(row.bend(between(row, 0.5) + 1e-3))


def test_a_kind_that_is_not_enclosed_is_refused() -> None:
    rows = ROUTES[0].rows.copy()
    rows[1, RouteRow.KIND] = 9.0
    with pytest.raises(InputError, match=r"curve of kind 9\.0 cannot be proved"):
        BallRoute.stored(rows)
