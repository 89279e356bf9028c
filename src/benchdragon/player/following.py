"""A long dance as its head's frames, and how the handle behind follows a handle: two small tables.

Handle i + 1 stands one link behind handle i, so that its place depends on that of handle i alone, not
on the time. The size of frames of every handle grows with benches times seconds; that of these tables
does not grow with the benches, and little with the route. A page follows from handle to handle; errors
of 3,000 steps add up, so that the tables are exact to a few nanometres (design/frames.py).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from benchdragon import budget
from benchdragon.kernels import following as kernel
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.frames import QUANTUM, SLOTS
from benchdragon.model.walk import Walk
from benchdragon.player.frames import STEPS, Frames, Shares, check_farthest, even_times, shot

# What all tables together may add to the error of the last handle, m.
SHARE = 1e-4
# The most nodes of all tables; different links.
MOST_ALL, MOST_KINDS = 100_000, 8
# Seconds between samples for the greatest speeds; handles times samples at most (5 s).
LOOK, MOST_LOOKS = 0.25, 60_000_000
# Handles times times at which all is compared with the exact places (3 s).
MOST_COMPARED = 1_500_000


@dataclass(frozen=True)
class Following:
    """How all handles follow the head, and figures computed on the way.

    Attributes:
        head: frames of the head's handle alone; their error is that of all handles.
        tables: as in kernels/following.py.
        fastest: greatest speed of each bench's front handle, m/s, at any of `times`, (benches,).
        when: and when, s, (benches,).
        speeds: least and greatest speed of all handles, m/s.
        change: greatest change of any handle's speed, m/s^2.
        times: of the samples, s.
        ends: route positions of the first and the last handle at these, m, (2, times).
    """

    head: Frames
    tables: kernel.Tables
    fastest: FloatArray
    when: FloatArray
    speeds: tuple[float, float]
    change: float
    times: FloatArray
    ends: FloatArray


def following(
    walk: Walk,
    start: float,
    end: float,
    most_error: float,
    shares: Shares,
    compared: int = MOST_COMPARED,
) -> Following | None:
    """How the handles follow the head from start to end, s, nowhere farther off than `most_error`, m.

    So many handles times times are compared with their exact places.

    None where tables cannot tell: a bench leaps or finds no place, links are of too many lengths, or
    the head changes its speed too often.

    Raises:
        InputError: for a walk that goes too far.
        WalkError: if the dragon does not stand at the start.
    """
    low = check_farthest(walk, start, end) - QUANTUM
    high = float(walk.head_position([end])[0]) + QUANTUM
    tables, error = _tables(walk, max(low, -walk.route.extension), min(high, walk.route.length))
    head = None if tables is None else _head(walk, start, end, 0.5 * most_error, shares)
    if tables is None or head is None:
        return None
    error = max(_compared(walk, head, tables, compared), head.error + error)
    return _looked(walk, head, tables, error) if error <= most_error else None


def _tables(walk: Walk, low: float, high: float) -> tuple[kernel.Tables | None, float]:
    """The tables of all links, from route position low to high, m; their errors together, m."""
    links, kinds = np.unique(walk.dragon.links, return_inverse=True)
    count, joints = len(links), walk.route.joints
    if count > MOST_KINDS:
        return None, math.inf
    room = math.ceil((high - low) / kernel.LONGEST) + 2 * len(joints) + 2
    tables = kernel.Tables(
        links, np.zeros(count, dtype=np.int64), np.zeros((count * room, kernel.STRETCH_COLUMNS)),
        np.zeros((2, MOST_ALL), dtype=np.int64), kinds.astype(np.int64),
    )  # fmt: skip
    most, scratch = SHARE / len(walk.dragon), (np.empty(1), empty_placements(2, 1), np.empty(room))
    errors = 0.0
    for kind in range(count):
        errors += kernel.tabulate(walk.route.rows, joints, kind, low, high, most, *scratch, tables)
        if errors == math.inf:
            return None, errors
    return tables, errors


def _head(walk: Walk, start: float, end: float, most_error: float, shares: Shares) -> Frames | None:
    """The fewest frames of the head's handle that are nowhere farther off than `most_error`, m."""
    for step in STEPS:
        found, _errors = shot(walk, np.empty(0), even_times(start, end, step), shares, most_error)
        if found.error <= most_error:
            return found
    return None


def _compared(walk: Walk, head: Frames, tables: kernel.Tables, most: int) -> float:
    """The largest distance of any handle from its place at times of all the dance, m."""
    handles, last = len(walk.dragon) + 1, head.count - 1
    count = max(most // handles, 16)
    # Shares of the dance that come near no frames' pattern.
    along = np.sort(last * ((np.arange(count) * 0.618034 + 0.5) % 1.0))
    budget.spend(handles * count)
    framed = head.places[0].astype(float), head.speeds[0].astype(float)
    return kernel.compare_followed(
        walk.route.rows, walk.dragon.links, tables, *framed, head.step, along,
        walk.head_position(head.start + head.step * along), 0, count, np.empty(SLOTS),
        empty_placements(handles, SLOTS),
    )  # fmt: skip


def _looked(walk: Walk, head: Frames, tables: kernel.Tables, error: float) -> Following:
    """Figures from samples of all handles, evenly spread over the dance."""
    benches = len(walk.dragon)
    count = min((head.end - head.start) / LOOK, MOST_LOOKS / (benches + 1))
    times = np.linspace(head.start, head.end, max(math.ceil(count), 2) + 1)
    at, pace = walk.head_position(times), walk.profile.speed(times)
    fastest, ends = np.empty((2, benches)), np.stack([at, at])
    *speeds, change = kernel.look_at_followed(
        tables, at, pace, 0, len(at), fastest, ends[1], np.empty(benches + 1)
    )
    return Following(
        replace(head, error=error), tables, fastest[0], times[fastest[1].astype(int)],
        (speeds[0], speeds[1]), change / float(times[1] - times[0]), times, ends,
    )  # fmt: skip
