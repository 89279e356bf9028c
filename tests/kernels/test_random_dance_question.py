"""Which pitch a question about a dance tries next, and how sure it must be of one."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from benchdragon.kernels import random_dance_memory as told
from benchdragon.kernels.random_dance_look import PITCH_TOLERANCE, is_sure
from benchdragon.kernels.random_dance_memory import DanceGiven, DanceSought, DanceTold
from benchdragon.kernels.random_dance_question import next_pitch


def after(room: float, touching: float = 0.0, clear: float = math.inf, slope: float = 1.0) -> float:
    """The pitch that is tried after 0.5 m left so much room, m."""
    figures = np.zeros(told.DANCE_FIGURES)
    figures[DanceTold.PITCH], figures[DanceTold.ROOM] = 0.5, room
    figures[DanceTold.TOUCHING], figures[DanceTold.CLEAR] = touching, clear
    dance: Any = SimpleNamespace(figures=figures)
    return float(next_pitch(dance, slope))


def test_the_next_pitch_is_near_the_last_one_and_within_what_is_known() -> None:
    assert after(0.01) == pytest.approx(0.49 + 5e-6)
    assert after(0.01, slope=2.0) == pytest.approx(0.495 + 2.5e-6)
    assert after(math.nan, touching=0.5) == pytest.approx(0.505)
    assert after(5.0) == pytest.approx(0.45)  # distances far from the least say little
    assert after(-5.0, touching=0.5) == pytest.approx(0.55)
    assert after(4e-6, clear=0.5) == pytest.approx(0.5 - 9e-6)  # just not clear any more
    assert after(0.02, touching=0.495) == pytest.approx(0.4975)  # between what is known
    assert after(-1e-3, touching=0.5, clear=0.50001) == pytest.approx(0.500001)


def sure(what: int, touching: float, clear: float) -> bool:
    """Whether a pitch of 0.5 m must be searched however far benches seem to keep apart."""
    figures, limits = np.zeros(told.DANCE_FIGURES), np.zeros(told.DANCE_LIMITS)
    figures[DanceTold.PITCH], figures[DanceTold.TOUCHING], figures[DanceTold.CLEAR] = (
        0.5,
        touching,
        clear,
    )
    limits[DanceGiven.WHAT] = what
    dance: Any = SimpleNamespace(figures=figures, limits=limits)
    return is_sure(dance)


def test_a_pitch_is_searched_where_what_is_seen_of_it_cannot_decide() -> None:
    """Where it would end the search; and under one that is clear, or the same would be tried again."""
    assert sure(DanceSought.TOUCHES, 0.0, math.inf)
    assert not sure(DanceSought.NEEDED, 0.0, math.inf)
    assert not sure(DanceSought.NEEDED, 0.5 - 1.1 * PITCH_TOLERANCE, math.inf)
    assert sure(DanceSought.NEEDED, 0.5 - 0.9 * PITCH_TOLERANCE, math.inf)
    assert sure(DanceSought.NEEDED, 0.0, 0.6)
    assert not sure(DanceSought.NEEDED, 0.0, 0.4)
