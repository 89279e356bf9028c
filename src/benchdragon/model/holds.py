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
from benchdragon.kernels import holds as kernel
from benchdragon.kernels.curve import FloatArray
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
    asked = [(_or_inf(hold.way), _or_inf(hold.at), hold.seconds) for hold in holds]
    room, counts = KNOTS * (len(pieces) + count + 1), np.empty(kernel.COUNTS, dtype=np.int64)
    while True:
        held = kernel.Held(
            pieces, np.array(sorted(starts), dtype=np.float64),
            np.array(asked, dtype=np.float64).reshape(-1, kernel.HOLD_COLUMNS),
            np.empty((room, kernel.KNOT_COLUMNS)), np.empty((count, kernel.STOOD_COLUMNS)),
            np.empty(count, dtype=np.int64), counts,
        )  # fmt: skip
        trouble = kernel.hold_head(held, start, rate)
        if not counts[kernel.SHORT]:
            break
        room *= 2
    if trouble != kernel.FINE:
        raise HoldError(int(counts[kernel.TOLD]), TROUBLES[trouble - 1])
    times, _ways, speeds = held.knots[: counts[kernel.KNOTS]].T.tolist()
    stood = [Standing(int(number), *rest) for number, *rest in held.stood.tolist()]
    return SpeedProfile(tuple(times), tuple(speeds)), stood


def _pieces(profile: SpeedProfile, start: float) -> FloatArray:
    """A profile from a time on as squared speeds along the way: see kernels/holds.py."""
    end = max(profile.times[-1], start)
    cut = profile.stretches(start, end) if end > start else profile.stretches(start, start)
    ways, squares = cut.ways - cut.ways[0, 0], np.square(cut.speeds)
    rests = np.where(ways[:, 1] > ways[:, 0], 0.0, cut.times[:, 1] - cut.times[:, 0])
    whole = np.column_stack([ways, squares, rests])
    square = float(profile.speed(end)) ** 2
    return np.vstack([whole, [ways[-1, 1], math.inf, square, square, 0.0]])


def _or_inf(value: float | None) -> float:
    return math.inf if value is None else value
