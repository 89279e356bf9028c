"""Fits of drawn lines, line by line: what they keep within is a bound, and what cannot be is told."""

import numpy as np
import pytest

from benchdragon.kernels.fitting import fit_points, g1_clothoids
from benchdragon.kernels.route_parts import PART_COLUMNS
from benchdragon.kernels.status import FitStatus, Smoothing
from benchdragon.model.curves import Route, curves_of
from tests.surveys.test_fitting import FloatArray, sampled_points, scribble

DEVIATION = 1.0


def fit(
    points: FloatArray, closed: bool, smooth: Smoothing, deviation: float = DEVIATION
) -> tuple[FitStatus, int, float, FloatArray]:
    parts = np.empty((4 * len(points), PART_COLUMNS))
    return *fit_points(points, closed, smooth, deviation, 0.0, parts), parts


def test_drawn_lines_keep_within_their_bound() -> None:
    rng = np.random.default_rng(9)
    fitted = 0
    for n in range(45):
        line = scribble(rng, 20)
        status, count, bound, parts = fit(line.corners[:, :2].copy(), line.closed, Smoothing(n % 3))
        if status != FitStatus.OK:
            continue
        fitted += 1
        found = sampled_points(Route(curves_of(parts[:count])), line)
        assert found <= bound + 1e-9
        assert found >= 0.2 * bound - 1e-9
        assert bound <= DEVIATION or n % 3 == Smoothing.NONE
    assert fitted > 30


def test_what_a_side_strays_from_the_points_it_replaces_counts() -> None:
    n = np.arange(12)
    status, count, bound, _parts = fit(np.column_stack([n, 0.3 * (n % 2)]), False, Smoothing.G1)
    assert (status, count) == (FitStatus.OK, 1)
    assert 0.25 < bound < 0.3


def test_what_cannot_be_fitted_says_where() -> None:
    back = np.array([[0.0, 0.0], [5.0, 0.0], [9.0, 3.0], [5.0, 0.0]])
    for smooth in (Smoothing.G1, Smoothing.G2):
        assert fit(back, False, smooth)[:2] == (FitStatus.HAIRPIN, 2)
    assert fit(back, False, Smoothing.G1, 0.0)[0] == FitStatus.NO_ROOM
    parts = np.empty((2, PART_COLUMNS))
    twice = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    assert g1_clothoids(twice, parts) == (FitStatus.ONE_PLACE, 1)
    about = np.array([[0.0, 0.0, -np.pi], [1.0, 0.0, np.pi]])
    assert g1_clothoids(about, parts) == (FitStatus.DOUBLES_BACK, 0)
    assert fit(back[[0, 1, 1]], False, Smoothing.NONE)[:2] == (FitStatus.ONE_PLACE, 1)


def test_two_points_make_a_line_however_it_is_smoothed() -> None:
    for smooth in Smoothing:
        status, count, bound, parts = fit(np.array([[1.0, 2.0], [4.0, 6.0]]), False, smooth)
        assert (status, count) == (FitStatus.OK, 1)
        assert parts[0] == pytest.approx([0.0, 1.0, 2.0, np.arctan2(4.0, 3.0), 5.0, 0.0, 0.0, 0.0])
        assert bound < 1e-11
