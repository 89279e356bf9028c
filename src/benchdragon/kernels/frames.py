"""Frames of a dance as the player keeps them, and the error of its cubics between them."""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import IntTable, Table, Vector
from benchdragon.kernels.chain import Placements, march
from benchdragon.kernels.curve import FloatArray, RouteRow, length_at
from benchdragon.kernels.drawn_route import cubic
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.route import IntArray
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
    return float(rows[j, RouteRow.S_START] + length_at(rows, j, places.u[i, t]))


@kernel
def keep(i: int, k: int, s: float, speed: float, step: float, leap: float, shot: Shot) -> None:
    """Keep where handle i is in frame k, m, and its speed, m/s; a leap to there counts before it."""
    frames, errors = shot.frames, shot.errors
    frames[i, k] = (quanta(s) << HALF) + quanta(speed)
    a, b = frames[i, max(k - 1, 0)], frames[i, k]
    walked = 0.5 * (QUANTUM * step) * ((a & LOW) + (b & LOW))
    off = abs(((b >> HALF) - (a >> HALF)) * QUANTUM - walked)
    if k > 0 and off > leap:
        errors[k - 1] = max(errors[k - 1], off)


@kernel
def between(i: int, k: int, share: float, step: float, frames: IntArray) -> float:
    """The position that frames give handle i, m, a share of a step, s, behind frame k."""
    a, b, rise = frames[i, k], frames[i, k + 1], QUANTUM * step
    s, t = (a >> HALF) * QUANTUM, (b >> HALF) * QUANTUM
    return cubic(s, t, (a & LOW) * rise, (b & LOW) * rise, share)


@entry
def look_at_frames(
    rows: Table, links: Vector, heads: Vector, speeds: Vector, first: int, last: int, share: float,
    step: float, leap: float, shot: Shot,
) -> None:  # fmt: skip
    """Keep frames first <= k < last if `share` is 0; else record the error of the cubics behind them.

    The head is at heads[k], m, with speeds[k], m/s, a share of a step, s, behind frame k. In a kept
    frame, a handle farther than `leap`, m, from where its speeds lead it counts as an error.
    """
    places, errors = shot.places, shot.errors
    for start in range(first, last, SLOTS):
        count = min(SLOTS, last - start)
        for t in range(count):
            shot.at[t] = heads[start + t]
        march(rows, links, shot.at, 0, count, places)
        for i in range(links.shape[0] + 1):
            for t in range(count):
                k = start + t
                if places.failed[0, t] != Status.OK:
                    errors[k] = math.inf
                    if share == 0.0:
                        errors[max(k - 1, 0)] = math.inf
                    continue
                s = position(rows, places, i, t)
                if share == 0.0:
                    keep(i, k, s, places.ratio[i, t] * speeds[k], step, leap, shot)
                else:
                    errors[k] = max(errors[k], abs(between(i, k, share, step, shot.frames) - s))
