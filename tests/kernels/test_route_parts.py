"""The rows of a route from its parts: where they lie, and where they do not meet."""

import math

import numpy as np
import pytest

from benchdragon.kernels import curve as kernel
from benchdragon.kernels import route_parts
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow
from benchdragon.kernels.route import evaluate
from benchdragon.kernels.route_parts import PART_COLUMNS, Pose, RoutePart, lay_rows, row_count
from benchdragon.model.curves import Arc, Clothoid, Line, LogSpiral, Route, Spiral, curves_of
from tests.kernels.reference import points

ORIGIN = Pose(0.0, 0.0, 0.0)
PARTS: list[tuple[float, ...]] = [
    (CurveKind.LINE, 1.0, -2.0, 0.7, 7.0, 0.0, 0.0, 0.0),
    (CurveKind.ARC, 4.0, 1.0, -2.0, 3.0, -2.5, 0.0, 0.0),
    (CurveKind.CLOTHOID, -3.0, 5.0, 2.0, 20.0, -1.5, 2.0, 0.0),
    (CurveKind.SPIRAL, 1.0, 2.0, 0.3, 1.7, 30.0, 9.0, 1.0),
    (CurveKind.LOG_SPIRAL, -3.0, 5.0, 2.0, 9.0, -0.7, -0.2, 0.0),
    (CurveKind.SPIRAL, 1.0, 2.0, 0.3, 1.7, 9.0, 30.0, -1.0),
]


def laid(parts: FloatArray, start: Pose, first: int, stop: int) -> FloatArray:
    rows = np.full((row_count(parts), kernel.COLUMNS), np.nan)
    lay_rows(parts, start, first, stop, rows)
    return rows


def places(rows: FloatArray, s: FloatArray) -> FloatArray:
    out = np.empty((len(s), 4))
    evaluate(rows, s, out)
    return out


def length(rows: FloatArray) -> float:
    return float(rows[-1, RouteRow.S_START] + rows[-1, RouteRow.LENGTH])


@pytest.mark.parametrize("numbers", PARTS)
def test_rows_lie_where_formulas_of_another_kind_put_the_part(numbers: tuple[float, ...]) -> None:
    parts = np.array([numbers])
    rows = laid(parts, Pose(9.0, 9.0, 9.0), 0, 0)
    assert (parts == [numbers]).all()  # it stays where it is
    (curve,) = curves_of(np.array([numbers]))
    s = np.linspace(0.0, length(rows), 15)
    found = places(rows, s)
    wanted = points(Route((curve,)), s)
    np.testing.assert_allclose(found[:, 0] + 1j * found[:, 1], wanted, rtol=0.0, atol=2e-13)


def test_the_numbers_of_a_part_are_those_of_its_curve() -> None:
    kinds = Line, Arc, Clothoid, Spiral, LogSpiral, Spiral
    for numbers, kind in zip(PARTS, kinds, strict=True):
        (curve,) = curves_of(np.array([numbers]))
        assert type(curve) is kind
        assert curve.parts.tolist() == [list(numbers)]


def test_a_clothoid_is_cut_where_it_turns_too_far_for_one_row() -> None:
    for turn, count in ((1.9, 1), (2.0, 1), (2.1, 2), (40.0, 20)):
        parts = np.array([(CurveKind.CLOTHOID, 0.0, 0.0, 0.0, 10.0, 0.1 * turn, 0.0, 0.0)])
        assert row_count(parts) == count
        rows = laid(parts, ORIGIN, 0, 0)
        np.testing.assert_allclose(np.diff(rows[:, RouteRow.S_START]), 10.0 / count, rtol=1e-14)
        ends = rows[:, RouteRow.P] + rows[:, RouteRow.Q] * rows[:, RouteRow.LENGTH]
        np.testing.assert_allclose(ends, [*rows[1:, RouteRow.P], 0.0], rtol=0.0, atol=1e-15)


def test_parts_that_are_moved_begin_where_the_one_before_ends() -> None:
    parts = np.array(PARTS)
    rows = laid(parts, Pose(3.0, 4.0, 5.0), 0, len(parts))
    gaps = np.full((len(parts) - 1, 2), np.nan)
    route_parts.misfits(rows, gaps)
    assert gaps.max() < 1e-13
    assert route_parts.start_pose(rows, 0) == pytest.approx((3.0, 4.0, 5.0), abs=1e-14)
    assert rows[:, RouteRow.PART].tolist() == sorted(rows[:, RouteRow.PART].tolist())
    np.testing.assert_array_equal(np.unique(rows[:, RouteRow.PART]), np.arange(len(parts)))
    # Moved as a whole, each is as before: `parts` says where it is now.
    again = parts.copy()
    np.testing.assert_allclose(laid(again, ORIGIN, 0, 0), rows, rtol=0.0, atol=1e-12)
    np.testing.assert_array_equal(parts[:, [0, 4, 5, 6, 7]], np.array(PARTS)[:, [0, 4, 5, 6, 7]])


@pytest.mark.parametrize("numbers", PARTS)
def test_a_moved_part_is_the_same_turned(numbers: tuple[float, ...]) -> None:
    before = laid(np.array([numbers]), ORIGIN, 0, 0)
    after = laid(np.array([numbers]), Pose(-5.0, 11.0, 1.234), 0, 1)
    s = np.linspace(0.0, length(before), 9)
    a, b = places(before, s), places(after, s)
    turned = (a[:, 0] + 1j * a[:, 1] - complex(*a[0, :2])) * np.exp(1j * (1.234 - a[0, 2]))
    np.testing.assert_allclose(
        b[:, 0] + 1j * b[:, 1], turned + complex(-5.0, 11.0), rtol=0.0, atol=1e-12
    )
    np.testing.assert_allclose(b[:, 3], a[:, 3], rtol=1e-14)


def test_only_the_first_row_of_a_route_runs_on() -> None:
    ends = {
        CurveKind.LINE: -math.inf,
        CurveKind.ARC: 0.0,
        CurveKind.CLOTHOID: 0.0,
        CurveKind.LOG_SPIRAL: 0.0,
    }
    for numbers in PARTS:
        rows = laid(np.array([numbers, *PARTS]), ORIGIN, 0, 0)
        inward = numbers[0] == CurveKind.SPIRAL and numbers[6] < numbers[5]
        wanted = ends.get(numbers[0], math.inf if inward else numbers[5])
        assert rows[0, RouteRow.U_BACK] == wanted
        np.testing.assert_array_equal(rows[1:, RouteRow.U_BACK], rows[1:, RouteRow.U_START])


def test_misfits_are_the_gaps_and_kinks_that_were_made() -> None:
    parts = np.zeros((4, PART_COLUMNS))
    parts[:, RoutePart.SIZE] = 1.0
    parts[1:, RoutePart.X] = 1.3, 2.3, 3.3
    parts[2, RoutePart.ANGLE] = 0.5
    parts[3, RoutePart.ANGLE] = -4.0 * math.pi
    parts[3, RoutePart.X : RoutePart.Y + 1] = 2.3 + math.cos(0.5), math.sin(0.5) - 0.2
    out = np.full((3, 2), np.nan)
    route_parts.misfits(laid(parts, ORIGIN, 0, 0), out)
    np.testing.assert_allclose(out, [[0.3, 0.0], [0.0, 0.5], [0.2, 0.5]], rtol=0.0, atol=1e-14)


def test_the_farthest_place_is_that_of_a_dense_scan() -> None:
    rows = Route.joined([Line(5.0, (1.0, 1.0)), Arc(2.0, 2.5), Line(3.0)]).rows
    s = np.linspace(2.0, 11.0, 20_001)
    far = float(np.hypot(*places(rows, s)[:, :2].T).max())
    assert route_parts.farthest(rows, 2.0, 11.0, 0.02) == pytest.approx(far, abs=1e-4)
    assert route_parts.farthest(rows, 2.0, 2.5, 0.1) == pytest.approx(math.hypot(3.5, 1.0), rel=1e-15)


def test_a_route_that_is_moved_is_the_same_turned_and_then_moved() -> None:
    parts = np.array(PARTS)
    rows = laid(parts, ORIGIN, 0, len(parts))
    s = np.linspace(0.0, length(rows), 40)
    before = places(rows, s)
    route_parts.move_parts(parts, 0.7, 30.0, -4.0)
    after = places(laid(parts, ORIGIN, 0, 0), s)
    there = (before[:, 0] + 1j * before[:, 1]) * np.exp(0.7j) + 30.0 - 4.0j
    np.testing.assert_allclose(after[:, 0] + 1j * after[:, 1], there, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(after[:, 2], before[:, 2] + 0.7, rtol=0.0, atol=1e-12)


def test_the_tightest_bend_is_the_first_place_of_the_greatest_curvature() -> None:
    parts = np.array(PARTS)
    rows = laid(parts, ORIGIN, 0, len(parts))
    bend, where = route_parts.tightest_bend(rows)
    s = np.linspace(0.0, length(rows), 20_001)
    bends = np.abs(places(rows, s)[:, 3])
    assert bends.max() <= bend * (1.0 + 1e-12)
    near = places(rows, np.array([where - 1e-9, where + 1e-9]).clip(0.0, length(rows)))
    assert np.abs(near[:, 3]).max() == pytest.approx(bend, rel=1e-6)
