"""Frames of a dance as the player keeps them, and how far its cubics between them are off."""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import IntTable, Table, Vector
from benchdragon.kernels.chain import Placements, march
from benchdragon.kernels.curve import S_START, FloatArray, length_at
from benchdragon.kernels.drawn_route import cubic
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.status import Status

# Route positions are kept to this, m, and speeds, m/s.
QUANTUM = 1e-4
# A frame of a handle is one number: its position, and in the lower half of the bits its speed.
HALF, LOW = 32, 2**32 - 1
# Chains placed together.
SLOTS = 32


class Shot(NamedTuple):
    """Evenly spaced frames."""

    frames: IntTable  # in QUANTUM, (handles, frames)
    errors: Vector  # the greatest seen behind each frame, m; infinite where the dragon does not stand
    at: Vector  # scratch, SLOTS of each
    places: Placements


@kernel
def quanta(value: float) -> int:
    """The multiple of QUANTUM nearest to a value."""
    return math.floor(value / QUANTUM + 0.5)


@kernel
def position(rows: FloatArray, places: Placements, i: int, t: int) -> float:
    """Where handle i is in slot t, m along the route."""
    j = places.row[i, t]
    return float(rows[j, S_START] + length_at(rows, j, places.u[i, t]))


@entry
def look_at_frames(
    rows: Table,
    links: Vector,
    heads: Vector,
    speeds: Vector,
    first: int,
    last: int,
    share: float,
    step: float,
    leap: float,
    shot: Shot,
) -> None:
    """Keep frames first <= k < last, whose share is 0; or see how far off what is behind them is.

    The head is at heads[k], m, and that fast, m/s, a share of a step, s, behind frame k. Frames that
    are kept count as off where a handle is farther than `leap`, m, from where speeds lead it.
    """
    places, frames, errors, rise = shot.places, shot.frames, shot.errors, QUANTUM * step
    for k in range(first, last):
        t = (k - first) % SLOTS
        if t == 0:
            count = min(SLOTS, last - k)
            for n in range(count):
                shot.at[n] = heads[k + n]
            march(rows, links, shot.at, 0, count, places)
        if places.failed[0, t] != Status.OK:
            errors[k] = math.inf
            if share == 0.0:
                errors[max(k - 1, 0)] = math.inf
            continue
        for i in range(frames.shape[0]):
            s = position(rows, places, i, t)
            if share == 0.0:
                frames[i, k] = (quanta(s) << HALF) + quanta(places.ratio[i, t] * speeds[k])
                a, b = frames[i, max(k - 1, 0)], frames[i, k]
                walked = 0.5 * rise * ((a & LOW) + (b & LOW))
                off = abs(((b >> HALF) - (a >> HALF)) * QUANTUM - walked)
                if k > 0 and off > leap:
                    errors[k - 1] = max(errors[k - 1], off)
            else:
                a, b = frames[i, k], frames[i, k + 1]
                near = cubic(
                    (a >> HALF) * QUANTUM, (b >> HALF) * QUANTUM, (a & LOW) * rise, (b & LOW) * rise,
                    share,
                )  # fmt: skip
                errors[k] = max(errors[k], abs(near - s))
