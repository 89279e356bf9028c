"""A long dance as its head's frames, and how the handle behind follows a handle: two small tables.

Handle i + 1 stands one link behind handle i, hence where it stands depends on where handle i stands
alone, and not on the time. Frames of every handle grow with benches times seconds; this does not grow
with the benches at all, and with the route hardly. A page follows from handle to handle; errors of
3,000 steps add up, so that the tables are exact to a few nanometres (design/frames.py).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.model.dragon import Dragon
from benchdragon.model.placement import Placement
from benchdragon.model.walk import Walk
from benchdragon.player.frames import QUANTUM, STEPS, Frames, between, check_farthest, spread

# Ways behind are kept to this, m, and their changes, m a metre; in four bytes up to LARGEST.
FINE = 1e-9
LARGEST = 2.1
# What all tables together may add to the error of the last handle, m.
SHARE = 1e-4
# The longest stretch of evenly spaced nodes, m; the most nodes of one, and of all; different links.
STRETCH, MOST_NODES, MOST_ALL, MOST_KINDS = 20.0, 4096, 100_000, 8
# Joints nearer to one another than this, m, count as one.
NARROW = 1e-6
# Seconds between looks for the greatest speeds; handles times looks at most (5 s).
LOOK, MOST_LOOKS = 0.25, 60_000_000
# Handles times times at which all is compared with the exact places (3 s).
MOST_COMPARED = 1_500_000


@dataclass(frozen=True)
class Table:
    """How much longer than the link the way back to the next handle is, by the place of a handle.

    Cubics between the nodes of stretches, each of which begins where the one before ends.

    Attributes:
        link: m.
        starts: route position of each stretch's first node, m, (stretches,).
        steps: distance of its nodes, m, (stretches,).
        counts: how many nodes it has, (stretches,).
        ways: at all nodes, in FINE, (nodes,).
        rates: their change along the route, in FINE, (nodes,).
        error: the largest seen between nodes, m.
    """

    link: float
    starts: FloatArray
    steps: FloatArray
    counts: IntArray
    ways: IntArray
    rates: IntArray
    error: float

    @cached_property
    def firsts(self) -> IntArray:
        """Number of each stretch's first node."""
        return np.concatenate([[0], np.cumsum(self.counts)[:-1]])

    def behind(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Where the next handle stands, m, and how far it goes a metre of this, with this one at s."""
        stretch = np.clip(np.searchsorted(self.starts, s, side="right") - 1, 0, None)
        step = self.steps[stretch]
        along = (s - self.starts[stretch]) / step
        node = np.clip(along.astype(np.int64), 0, self.counts[stretch] - 2)
        f, first = along - node, self.firsts[stretch] + node
        w0, w1 = self.ways[first] * FINE, self.ways[first + 1] * FINE
        r0, r1 = self.rates[first] * FINE, self.rates[first + 1] * FINE
        rest, rise = 1.0 - f, w1 - w0
        way = w0 + f * f * (3.0 - 2.0 * f) * rise + step * f * rest * (rest * r0 - f * r1)
        rate = 6.0 * f * rest * rise / step + rest * (1.0 - 3.0 * f) * r0 + f * (3.0 * f - 2.0) * r1
        return s - self.link - way, 1.0 - rate


@dataclass(frozen=True)
class Following:
    """How all handles follow the head, and what came out on the way.

    Attributes:
        head: frames of the head's handle alone; their error is that of all handles.
        tables: one for each length of link.
        kinds: number of each bench's table, (benches,).
        fastest: greatest speed of each bench's front handle, m/s, at any of `times`, (benches,).
        when: and when, s, (benches,).
        speeds: least and greatest speed of all handles, m/s.
        change: greatest change of any handle's speed, m/s^2.
        times: looked at for that, s.
        ends: route positions of the first and the last handle at these, m, (2, times).
    """

    head: Frames
    tables: tuple[Table, ...]
    kinds: IntArray
    fastest: FloatArray
    when: FloatArray
    speeds: tuple[float, float]
    change: float
    times: FloatArray
    ends: FloatArray


def following(
    walk: Walk, start: float, end: float, most_error: float, shares: tuple[float, ...]
) -> Following | None:
    """How the handles follow the head from start to end, s, nowhere farther off than `most_error`, m.

    None where tables cannot tell: a bench leaps or finds no place, links are of too many lengths, or
    the head changes its speed too often.

    Raises:
        InputError: for a walk that goes too far.
        WalkError: if the dragon does not stand at the start.
    """
    check_farthest(walk, start, end)
    links, first, kinds = np.unique(walk.dragon.links, return_index=True, return_inverse=True)
    if len(links) > MOST_KINDS:
        return None
    low = float(walk.motion([start]).s[0, -2])
    high = float(walk.head_position([end])[0])
    tables = [_table(walk, int(i), low - QUANTUM, high + QUANTUM) for i in first]
    sound = [table for table in tables if table is not None]
    if len(sound) < len(tables):
        return None
    head = _head(walk, start, end, 0.5 * most_error, shares)
    if head is None:
        return None
    error = max(_compared(walk, head, sound, kinds), head.error + sum(t.error for t in sound))
    if not error <= most_error:
        return None
    return _looked(walk, replace(head, error=error), tuple(sound), kinds.astype(np.int64))


def _head(
    walk: Walk, start: float, end: float, most_error: float, shares: tuple[float, ...]
) -> Frames | None:
    """The fewest frames of the head's handle that are nowhere farther off than `most_error`, m."""
    for step in STEPS:
        count = max(math.ceil((end - start) / step - 1e-9), 1) + 1
        times = np.linspace(start, end, count)
        even = float(times[1] - times[0])
        tables = walk.head_position(times), walk.profile.speed(times)
        places, speeds = (np.rint(table / QUANTUM).astype(np.int64)[np.newaxis] for table in tables)
        shot = Frames(start, even, places, speeds, 0.0, False)
        error = max(
            float(
                np.abs(shot.positions(share)[0] - walk.head_position(times[:-1] + share * even)).max()
            )
            for share in shares
        )
        if error <= most_error:
            return Frames(start, even, places, speeds, error, False)
    return None


def _table(walk: Walk, bench: int, low: float, high: float) -> Table | None:
    """The table of the link of a bench (row, from 0), from route position low to high, m, or None."""
    one = walk.dragon.of_sizes(*walk.dragon.sizes[:, bench : bench + 1])
    low, high = max(low, -walk.route.extension), min(high, walk.route.length)
    edges = _edges(walk, one, low, high)
    most = SHARE / len(walk.dragon)
    found = []
    nodes = 0
    for a, b in pairwise(edges):
        piece = _stretch(walk, one, (a, b), most)
        if piece is None or nodes > MOST_ALL:
            return None
        nodes += len(piece.ways)
        found.append(piece)
    return Table(
        float(one.links[0]),
        np.concatenate([piece.starts for piece in found]),
        np.concatenate([piece.steps for piece in found]),
        np.concatenate([piece.counts for piece in found]),
        np.concatenate([piece.ways for piece in found]),
        np.concatenate([piece.rates for piece in found]),
        max(piece.error for piece in found),
    )


def _edges(walk: Walk, one: Dragon, low: float, high: float) -> list[float]:
    """Where stretches end: at joints, where the next handle is at a joint, and in between."""
    joints = walk.route.joints
    left, right = joints.copy(), joints + 2.0 * LARGEST + float(one.links[0])
    for _halving in range(60):
        middle = 0.5 * (left + right)
        s = Placement(one, walk.route, np.clip(middle, low, high)).s[:, 1]
        behind = (s < joints) & (middle < high)
        left, right = np.where(behind, middle, left), np.where(behind, right, middle)
    borders = np.sort(np.concatenate([[low], joints, 0.5 * (left + right)]))
    borders = borders[1:][(np.diff(borders) > NARROW) & (borders[1:] > low + NARROW)]
    return spread([low, *borders[borders < high - NARROW].tolist(), high], STRETCH)


def _stretch(walk: Walk, one: Dragon, span: tuple[float, float], most: float) -> Table | None:
    """One stretch of a table, with as many nodes as it needs to be off by less than `most`, m."""
    low, high = span
    link, inside = float(one.links[0]), (high - low) * 1e-10  # rates at a border are those of this side
    count = 3
    while count <= MOST_NODES:
        s = np.linspace(low, high, count)
        at = np.linspace(low + inside, high - inside, 4 * count - 3)
        placed = Placement(one, walk.route, at)
        ways, rates = at - placed.s[:, 1] - link, 1.0 - placed.speed_ratio[:, 1]
        if placed.status.any() or max(np.abs(ways).max(), np.abs(rates).max()) > LARGEST:
            return None
        fine, change = (np.rint(table[::4] / FINE).astype(np.int64) for table in (ways, rates))
        piece = Table(link, s[:1], np.diff(s[:2]), np.array([count]), fine, change, 0.0)
        error = float(np.abs(piece.behind(at)[0] - placed.s[:, 1]).max())
        if error <= most:
            return replace(piece, error=error)
        count = 2 * count - 1
    return None


def head_at(head: Frames, times: FloatArray) -> FloatArray:
    """Where a page has the head's handle at these times, m."""
    along = np.clip((times - head.start) / head.step, 0.0, head.count - 1)
    k = np.minimum(along.astype(np.int64), head.count - 2)
    s = np.stack([head.places[0, k], head.places[0, k + 1]], axis=1) * QUANTUM
    rise = np.stack([head.speeds[0, k], head.speeds[0, k + 1]], axis=1) * (QUANTUM * head.step)
    share = (along - k)[:, np.newaxis]
    return between(s, rise, share).ravel()


def followed(
    tables: tuple[Table, ...] | list[Table], kinds: IntArray, s: FloatArray
) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Route positions of handle after handle, m, the head's at s, and speeds over that of the head."""
    ratio = np.ones(len(s))
    yield s, ratio
    for kind in kinds.tolist():
        s, rate = tables[kind].behind(s)
        ratio = ratio * rate
        yield s, ratio


def _compared(walk: Walk, head: Frames, tables: list[Table], kinds: IntArray) -> float:
    """The largest distance of any handle from its place at times of all the dance, m."""
    count = max(MOST_COMPARED // (len(walk.dragon) + 1), 16)
    # Shares of the dance that come near no frames' pattern.
    times = np.sort(head.start + (head.end - head.start) * ((np.arange(count) * 0.618034 + 0.5) % 1.0))
    worst = 0.0
    for motion in walk.motions(times, throw=False):
        here = followed(tables, kinds, head_at(head, motion.times))
        for (s, _ratio), exact in zip(here, motion.s.T, strict=True):
            worst = max(worst, float(np.abs(s - exact).max()))
    return worst


def _looked(walk: Walk, head: Frames, tables: tuple[Table, ...], kinds: IntArray) -> Following:
    """What comes out of a look at all handles, evenly spread over the dance."""
    benches = len(walk.dragon)
    count = min((head.end - head.start) / LOOK, MOST_LOOKS / (benches + 1))
    times = np.linspace(head.start, head.end, max(math.ceil(count), 2) + 1)
    pace, at = walk.profile.speed(times), walk.head_position(times)
    fastest, when, ends = np.empty(benches), np.empty(benches), np.stack([at, at])
    low, high, change = math.inf, -math.inf, 0.0
    for i, (s, ratio) in enumerate(followed(tables, kinds, at)):
        ends[1], speed = s, ratio * pace
        best = int(speed.argmax())
        low, high = min(low, float(speed.min())), max(high, float(speed[best]))
        change = max(change, float(np.abs(np.diff(speed)).max()))
        if i < benches:
            fastest[i], when[i] = speed[best], times[best]
    return Following(
        head, tables, kinds, fastest, when, (low, high), change / float(times[1] - times[0]), times,
        ends,
    )  # fmt: skip
