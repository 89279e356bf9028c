"""Benches that keep apart while the head goes from one place to another.

A bench is known by its two handles, each of which goes along the route from one place to the next: no
point of it moves more than its handles let it. So two benches keep at least the mean of their distances
at both ends less half of what both move. Where that is not enough, as near a contact, a line between
them is followed here: the distance of their corners along it lies above its chord by no more than its
second derivative allows.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb

from benchdragon.proofs.ball_route import BallRoute, Pair
from benchdragon.proofs.boxes import CORNERS, LINES, Boxes, gaps
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.motion import Drive, drives
from benchdragon.proofs.sizes import Sizes


@dataclass(frozen=True)
class Bench:
    """A bench in balls: its middle line's unit vector, and its corners; with their derivatives."""

    ahead: Pair
    corners: list[Pair]


def _bench(front: Pair, rear: Pair, sizes: Sizes, i: int) -> Bench:
    """Bench number i of a place, a speed or an acceleration of its handles: all are linear in them."""
    link = sizes.links[i]
    ahead = (front[0] - rear[0]) / link, (front[1] - rear[1]) / link
    found = []
    for end, side in CORNERS:
        at, long = (front, sizes.front[i]) if end == 0 else (rear, -sizes.rear[i])
        half = side * sizes.width[i] / 2
        found.append(
            (at[0] + long * ahead[0] - half * ahead[1], at[1] + long * ahead[1] + half * ahead[0])
        )
    return Bench(ahead, found)


def _turned(vector: Pair, axis: int) -> Pair:
    """The vector along a bench, or the one across it."""
    return vector if axis == 0 else (-vector[1], vector[0])


def _dot(a: Pair, b: Pair) -> arb:
    return a[0] * b[0] + a[1] * b[1]


@dataclass(frozen=True)
class Line:
    """A separating axis of two benches: a bench's own normal, with a sign, or a fixed vector."""

    normal: int
    axis: int
    sign: int
    fixed: Pair

    def of(self, benches: Sequence[Bench]) -> Pair:
        """The vector for two benches, or for their derivatives."""
        if self.normal == 2:
            return self.fixed
        x, y = _turned(benches[self.normal].ahead, self.axis)
        return self.sign * x, self.sign * y

    def change(self, benches: Sequence[Bench]) -> Pair:
        """Its derivative, from those of the benches."""
        return (arb(0), arb(0)) if self.normal == 2 else self.of(benches)


def along(line: Line, benches: Sequence[Bench]) -> list[arb]:
    """For each corner of both, how far the second's lies beyond the first's along a line, m, (16,).

    All are positive only if the benches are apart, and then their distance is at least the least.
    """
    vector = line.of(benches)
    first = [_dot(vector, corner) for corner in benches[0].corners]
    second = [_dot(vector, corner) for corner in benches[1].corners]
    return [b - a for a in first for b in second]


def _pairs(benches: Sequence[Bench]) -> Iterator[Pair]:
    for a in benches[0].corners:
        for b in benches[1].corners:
            yield b[0] - a[0], b[1] - a[1]


def bends(
    line: Line, places: Sequence[Bench], speeds: Sequence[Bench], rates: Sequence[Bench]
) -> list[arb]:
    """The second derivatives of `along`, enclosed, from those of places."""
    vector, change, rate = line.of(places), line.change(speeds), line.change(rates)
    return [
        _dot(rate, apart) + 2 * _dot(change, speed) + _dot(vector, acceleration)
        for apart, speed, acceleration in zip(
            _pairs(places), _pairs(speeds), _pairs(rates), strict=True
        )
    ]


@dataclass(frozen=True)
class Moving:
    """Bench number i of the dragon."""

    i: int

    def place(self, chain: Chain, sizes: Sizes) -> Bench:
        """Where it is, enclosed."""
        handles = chain.handles[self.i : self.i + 2]
        front, rear = ([value + arb(0, one.error) for value in one.pose[:2]] for one in handles)
        return _bench((front[0], front[1]), (rear[0], rear[1]), sizes, self.i)

    def drive(self, moving: Sequence[Drive], sizes: Sizes) -> list[Bench]:
        """All its places, speeds and accelerations between two chains, enclosed."""
        front, rear = moving[self.i], moving[self.i + 1]
        return [
            _bench(getattr(front, name), getattr(rear, name), sizes, self.i)
            for name in ("place", "speed", "acceleration")
        ]


@dataclass(frozen=True)
class Side:
    """A side of an obstacle, from one point to another, m."""

    start: Pair
    end: Pair

    def place(self, _chain: Chain, _sizes: Sizes) -> Bench:
        """Where it is: as a bench without width."""
        return self._bench()

    def _bench(self) -> Bench:
        dx, dy = self.start[0] - self.end[0], self.start[1] - self.end[1]
        size = (dx * dx + dy * dy).sqrt()
        ahead = (dx / size, dy / size) if size > 0 else (arb(1), arb(0))
        return Bench(ahead, [self.start, self.start, self.end, self.end])

    def drive(self, _moving: Sequence[Drive], _sizes: Sizes) -> list[Bench]:
        """It stands."""
        nothing = arb(0), arb(0)
        rest = Bench(nothing, [nothing] * len(CORNERS))
        return [self._bench(), rest, rest]


Body = Moving | Side


def _least(values: Sequence[arb]) -> arb:
    least = values[0]
    for value in values[1:]:
        least = least.min(value)
    return least


def _box(bench: Bench, about: Pair) -> Boxes:
    """A bench as one rectangle in doubles, about a point: accurate at any distance."""
    x, y = (np.array([float(one[n] - about[n]) for one in bench.corners]) for n in (0, 1))
    ahead_x, ahead_y = (np.array([float(value)]) for value in bench.ahead)
    long, wide = (0.5 * np.hypot(x[:1] - x[n], y[:1] - y[n]) for n in (3, 1))
    return Boxes(x.mean(keepdims=True), y.mean(keepdims=True), ahead_x, ahead_y, long, wide)


def line_of(benches: Sequence[Bench]) -> Line:
    """The line along which two bodies are farthest apart, as doubles show it."""
    one, other = (_box(bench, benches[0].corners[0]) for bench in benches)
    found = gaps(one, other)
    best = int(found.size[:, 0].argmax())
    (normal, axis), line = LINES[best], (arb(float(found.x[best, 0])), arb(float(found.y[best, 0])))
    if normal == 2:
        size = _dot(line, line).sqrt()
        return Line(2, 0, 1, (line[0] / size, line[1] / size))
    return Line(normal, axis, 1 if _dot(_turned(benches[normal].ahead, axis), line) > 0 else -1, line)


def curved_apart(
    a: Chain, b: Chain, route: BallRoute, sizes: Sizes, bodies: Sequence[Body], margin: arb
) -> bool:
    """Whether two bodies keep `margin` between two chains, by their distance's second derivative."""
    ends = [[body.place(chain, sizes) for body in bodies] for chain in (a, b)]
    line = line_of(ends[0])
    count = max(body.i for body in bodies if isinstance(body, Moving)) + 2
    moving = drives(a, b, route, sizes.links, count)
    places, speeds, rates = zip(*(body.drive(moving, sizes) for body in bodies), strict=True)
    way = b.handles[0].s - a.handles[0].s
    apart = (along(line, benches) for benches in ends)
    for first, last, bend in zip(*apart, bends(line, places, speeds, rates), strict=True):
        if not first.min(last) - bend.abs_upper() * way * way / 8 > margin:
            return False
    return True
