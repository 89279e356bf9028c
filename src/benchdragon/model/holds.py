"""A head that stands still at places or times: the speed profile of a walk with holds in it.

The head has at each place the speed that it had there without holds, but near a hold no more than
braking and starting at one rate allow. Squared speeds are linear along the way, so all of it is exact.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from benchdragon.errors import InputError
from benchdragon.kernels.holds import (
    HOLD_COLUMNS,
    HOLD_COUNTS,
    KNOT_COLUMNS,
    STOOD_COLUMNS,
    Held,
    HoldCount,
    HoldTrouble,
    hold_head,
)
from benchdragon.model.profile import SpeedProfile

Trouble = Literal["overlap", "room", "unreachable", "outside", "over"]
# What the kernel says of a hold that cannot be, from 1 on.
TROUBLES: tuple[Trouble, ...] = ("overlap", "room", "unreachable", "outside", "over")
# Knots that there is room for at first, for each piece of the way and each hold.
KNOTS = 6


@dataclass(frozen=True)
class Hold:
    """That the head stands still, at a place or from a time on.

    Attributes:
        way: where, m from where the walk begins; None where a time says it.
        at: from when on, s; None where a place says it.
        seconds: for how long; infinite: until the next start.
    """

    way: float | None = None
    at: float | None = None
    seconds: float = math.inf


class HoldError(InputError):
    """A hold that cannot be: the number of it, from 0, and what kind of trouble it is."""

    def __init__(self, number: int, trouble: Trouble) -> None:
        super().__init__(trouble)
        self.number, self.trouble = number, trouble


@dataclass(frozen=True)
class Standing:
    """Where, m from where the walk begins, and when, s, the head stands for a hold (number, from 0)."""

    number: int
    way: float
    start: float
    end: float


def with_holds(
    profile: SpeedProfile, start: float, holds: Sequence[Hold], starts: Sequence[float], rate: float
) -> tuple[SpeedProfile, list[Standing]]:
    """A profile with holds in it, and where and when each is, one after another.

    Args:
        profile: of the walk without holds, whose speeds stay those at its places.
        start: when the walk begins, s.
        holds: in any order.
        starts: times, s, at which a head starts that stands until then.
        rate: at which the head brakes and starts, m/s^2.

    Raises:
        HoldError: for the first hold that cannot be.
    """
    pieces, count = _pieces(profile, start), len(holds)
    asked = [[_or_inf(hold.way), _or_inf(hold.at), hold.seconds] for hold in holds]
    room, counts = KNOTS * (len(pieces) + count + 1), np.zeros(HOLD_COUNTS, dtype=np.int64)
    counts[HoldCount.SHORT] = 1
    while counts[HoldCount.SHORT]:
        held = Held(
            np.array(pieces), np.array(sorted(starts), dtype=np.float64),
            np.array(asked, dtype=np.float64).reshape(-1, HOLD_COLUMNS),
            np.empty((room, KNOT_COLUMNS)), np.empty((count, STOOD_COLUMNS)),
            np.empty(count, dtype=np.int64), counts,
        )  # fmt: skip
        trouble = hold_head(held, start, rate)
        room *= 2
    if trouble != HoldTrouble.FINE:
        raise HoldError(int(counts[HoldCount.TOLD]), TROUBLES[trouble - 1])
    knots = held.knots[: counts[HoldCount.KNOTS]].tolist()
    stood = [
        Standing(int(number), way, since, until) for number, way, since, until in held.stood.tolist()
    ]
    times, speeds = [time for time, _way, _speed in knots], [speed for _time, _way, speed in knots]
    return SpeedProfile(tuple(times), tuple(speeds)), stood


def _pieces(profile: SpeedProfile, start: float) -> list[list[float]]:
    """A profile from a time on as squared speeds along the way: see kernels/holds.py."""
    end = max(profile.times[-1], start)
    times, ways, speeds, _rates = profile.stretches(start, end)
    first, found = ways[0, 0], []
    for (since, until), (a, b), (v, w) in zip(
        times.tolist(), ways.tolist(), speeds.tolist(), strict=True
    ):
        found.append([a - first, b - first, v * v, w * w, 0.0 if b > a else until - since])
    square = float(profile.speed(end)) ** 2
    return [*found, [found[-1][1], math.inf, square, square, 0.0]]


def _or_inf(value: float | None) -> float:
    return math.inf if value is None else value
