"""What is said of errors: orders, accumulation along the benches, stepped searches."""

import math

import mpmath as mp
import numpy as np
import pytest

from benchdragon.errors import InputError
from benchdragon.model.curves import Line, Route
from benchdragon.model.dragon import Dragon
from benchdragon.model.walk import Walk
from benchdragon.paper.convergence import (
    Convergence,
    accumulated,
    bisected,
    chord_residuals,
    difference_convergence,
    runge_kutta_convergence,
)
from benchdragon.paper.traversal import first_overlap
from benchdragon.plans.schema import read_plan
from tests.truth.reference import place_behind, spiral_walk


@pytest.fixture(scope="module")
def walk() -> Walk:
    return read_plan("spiral-in").build()


def test_orders_are_those_of_theory(walk: Walk) -> None:
    assert runge_kutta_convergence(walk).order == pytest.approx(4.0, abs=0.05)
    speeds = difference_convergence(walk, [50.0, 150.0, 250.0])
    for scheme, order in (("forward", 1.0), ("central", 2.0), ("backward", 1.0)):
        assert speeds[scheme].order == pytest.approx(order, abs=0.01)


def test_errors_at_rounding_are_left_out_of_the_fit() -> None:
    steps, errors = (8.0, 4.0, 2.0, 1.0), (8e-8, 1e-8, 1.25e-9, 3e-13)
    found = Convergence.of(steps, errors)
    assert found.fitted.tolist() == [True, True, True, False]
    assert found.order == pytest.approx(3.0)


def test_handles_are_as_near_their_exact_places_as_is_said(walk: Walk) -> None:
    """The error that is told is how far places are from 40-digit ones, sizes as they are stored."""
    motion = walk.motion([300.0])
    told = accumulated(motion)
    assert 0.0 < told.max() < 1e-12
    head, body = (mp.mpf(float(link)) for link in walk.dragon.links[:2])
    with mp.workdps(40):
        point = spiral_walk(mp.mpf(0.55), mp.mpf(32.0 * math.pi))
        s = mp.mpf(300)
        for i in range(40):
            exact = point(s)
            off = mp.mpc(float(motion.x[0, i]), float(motion.y[0, i])) - exact
            assert float(abs(off)) == pytest.approx(told[i], abs=6e-15)
            s = place_behind(point, s, body if i else head)


def test_a_handle_that_is_misplaced_shows_in_the_error_that_is_told(walk: Walk) -> None:
    motion = walk.motion([300.0])
    before = accumulated(motion)
    motion._x[120:] += 1e-9  # handles 120 and on stand aside: their links are right, but that before
    after = accumulated(motion)
    assert after[:120] == pytest.approx(before[:120], abs=1e-18)
    assert after[120:].max() > 1e-10


def test_bisected_handles_drift_by_their_tolerance(walk: Walk) -> None:
    motion = walk.motion([300.0])
    coarse, fine = bisected(motion, 1e-6), bisected(motion, 1e-8)
    assert 20.0 < coarse.max() / fine.max() < 500.0
    assert 1e-8 < fine.max() < 1e-6
    with pytest.raises(InputError):
        bisected(motion, 0.0)


def test_chords_keep_their_links_to_rounding(walk: Walk) -> None:
    residuals = chord_residuals(walk.motion(np.arange(0.0, 301.0, 10.0)))
    assert residuals.shape == (223,)
    assert residuals.max() < 1e-14


def test_only_one_spiral_is_analysed() -> None:
    line = Walk(Dragon.uniform(5), Route((Line(50.0),)))
    with pytest.raises(InputError, match="one spiral alone"):
        accumulated(line.motion([1.0]))


@pytest.mark.parametrize(("step", "seen"), [(1.0, 413.0), (0.5, 412.5), (10.0, 420.0)])
def test_a_stepped_search_sees_the_contact_at_its_next_look(
    walk: Walk, step: float, seen: float
) -> None:
    times = np.arange(400.0, 425.0, step)
    assert first_overlap(walk, times) == seen
    assert first_overlap(walk, times[times < seen]) is None
