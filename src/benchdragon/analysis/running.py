"""Where on the ground handles run: places of a walk that lie close together are one stretch."""

import math
from typing import NamedTuple

import numpy as np

from benchdragon import budget
from benchdragon.model.base_curve import Point
from benchdragon.model.walk import Walk

# Time step of samples, s; larger where handles x samples would exceed the limit.
STEP, MOST_LOOKS = 0.25, 5_000_000
# Places where handles run are kept once a square of so many m; those no farther apart than the second
# are one stretch.
SQUARE, APART = 1.0, 5.0


class Running(NamedTuple):
    """The fastest handle seen on a stretch where handles run: where, m, how fast, m/s, and when, s."""

    point: Point
    speed: float
    time: float


@budget.question()
def running_stretches(walk: Walk, start: float, end: float, run_from: float) -> tuple[Running, ...]:
    """Stretches of the ground on which handles go at a speed, m/s, or faster; the fastest first.

    Speeds are those at times STEP apart, so that a shorter run of a single handle may be overlooked.

    Raises:
        WalkError: if the dragon cannot stand at some time.
    """
    left = _seen(walk, start, end, run_from)
    found = []
    for one in sorted(left.values(), key=lambda seen: -seen.speed):
        square = _square(*one.point)
        if square in left:
            found.append(one)
            _leave_out(left, square)
    return tuple(found)


def _square(x: float, y: float) -> str:
    return f"{math.floor(x / SQUARE)} {math.floor(y / SQUARE)}"


def _leave_out(left: dict[str, Running], first: str) -> None:
    """Take all of a stretch out of what is left, by one of its squares."""
    reach = math.ceil(APART / SQUARE)
    waiting = [left.pop(first)]
    while waiting:
        x, y = waiting.pop().point
        for i in range(-reach, reach + 1):
            for j in range(-reach, reach + 1):
                square = _square(x + i * SQUARE, y + j * SQUARE)
                other = left.get(square)
                if other is not None and math.dist((x, y), other.point) <= APART:
                    waiting.append(left.pop(square))


def _seen(walk: Walk, start: float, end: float, run_from: float) -> dict[str, Running]:
    """The fastest handle that runs in each square."""
    most = max(MOST_LOOKS // (len(walk.dragon) + 1), 2)
    count = min(math.ceil((end - start) / STEP) + 1, most)
    found: dict[str, Running] = {}
    for time in np.linspace(start, end, count).tolist():
        for x, y, speed in runners(walk, time, run_from):
            square = _square(x, y)
            known = found.get(square)
            if known is None or speed > known.speed:
                found[square] = Running((x, y), speed, time)
    return found


def runners(walk: Walk, time: float, run_from: float) -> list[tuple[float, float, float]]:
    """Where handles are at a time, s, that go at a speed, m/s, or faster: x, y, m, and the speed."""
    motion = walk.motion([time])
    fast = motion.speed[0] >= run_from
    columns = (motion.x[0, fast], motion.y[0, fast], motion.speed[0, fast])
    return [(x, y, speed) for x, y, speed in np.column_stack(columns).tolist()]
