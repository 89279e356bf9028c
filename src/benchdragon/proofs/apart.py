"""Benches that keep apart while the head goes from one place to another.

A bench is known by its two handles, each of which goes along the route from one place to the next: no
point of it moves more than its handles let it. So two benches keep at least the mean of their distances
at both ends less half of what both move. Where that is not enough, as near a contact, a line between
them is followed: the distance of their corners along it lies above its chord by no more than its second
derivative allows.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from flint import arb
from scipy.spatial import KDTree

from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.ball_route import BallRoute, Pair
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.motion import SLACK, Drive, drives

IntArray = npt.NDArray[np.int64]
# Corners: in front or behind (of the front and rear handle), and left or right.
CORNERS = ((0, 1), (0, -1), (1, -1), (1, 1))


@dataclass(frozen=True)
class Sizes:
    """Of N benches: from handle to handle, handle to end, and width, m, as balls and as doubles.

    Attributes:
        links: N balls, as the next three.
        front: from a front handle to the bench's front end.
        rear: from a rear handle to its rear end.
        width: of each.
        numbers: the same as doubles, (4, N).
    """

    links: Sequence[arb]
    front: Sequence[arb]
    rear: Sequence[arb]
    width: Sequence[arb]
    numbers: FloatArray

    @classmethod
    def of(
        cls, length: Sequence[arb], width: Sequence[arb], front: Sequence[arb], rear: Sequence[arb]
    ) -> "Sizes":
        """Benches of such lengths, widths, and distances from their ends to their holes, m."""
        links = [a - b - c for a, b, c in zip(length, front, rear, strict=True)]
        columns = (links, front, rear, width)
        numbers = np.array([[float(value) for value in column] for column in columns])
        return cls(links, front, rear, width, numbers)

    def first(self, benches: int) -> "Sizes":
        """Those of so many benches from the head on."""
        links, front = self.links[:benches], self.front[:benches]
        rear, width = self.rear[:benches], self.width[:benches]
        return Sizes(links, front, rear, width, self.numbers[:, :benches])


def corners(chain: Chain, sizes: Sizes) -> FloatArray:
    """The corners of all benches, m, (N, 4, 2), to SLACK."""
    links, front, rear, width = sizes.numbers
    ahead = np.stack([chain.x[:-1] - chain.x[1:], chain.y[:-1] - chain.y[1:]], 1) / links[:, None]
    left = np.stack([-ahead[:, 1], ahead[:, 0]], 1)
    handles = np.stack([chain.x, chain.y], 1)
    ends = (handles[:-1] + front[:, None] * ahead, handles[1:] - rear[:, None] * ahead)
    half = 0.5 * width[:, None] * left
    return np.stack([ends[end] + side * half for end, side in CORNERS], 1)


def reach(way: FloatArray, sizes: Sizes) -> FloatArray:
    """How far any point of each bench moves while its handles go so far, m, (N,), at most."""
    links, front, rear, width = sizes.numbers
    ahead, behind = way[:-1], way[1:]
    over = np.maximum(front * ahead + front * behind + links * ahead, rear * (ahead + behind))
    over = np.maximum(over, rear * (ahead + behind) + links * behind)
    result: FloatArray = (over + 0.5 * width * (ahead + behind)) / links * (1.0 + 1e-12)
    return result


def near_pairs(boxes: FloatArray, sizes: Sizes, room: FloatArray, margin: float) -> IntArray:
    """Pairs of non-adjacent benches that could come within `margin`, (n, 2), i < j.

    `room` is how far each moves. All others are farther apart than that by their circles alone.
    """
    middle, radius = boxes.mean(axis=1), _radius(sizes, room)
    pairs = KDTree(middle).query_pairs(2.0 * radius.max() + margin, output_type="ndarray")
    i, j = np.sort(pairs, axis=1).T
    apart = np.hypot(*(middle[i] - middle[j]).T)
    keep = (j > i + 1) & (apart <= radius[i] + radius[j] + margin)
    return np.stack([i[keep], j[keep]], 1)


def near_sides(
    boxes: FloatArray, sides: FloatArray, sizes: Sizes, room: FloatArray, margin: float
) -> IntArray:
    """The same of benches and sides, (n, 2): the number of the bench, and of the side."""
    middle, radius = boxes.mean(axis=1)[:, None, :], _radius(sizes, room)[:, None]
    start, end = sides[None, :, 0], sides[None, :, 3]
    long = end - start
    square = np.maximum((long**2).sum(-1), 1e-300)
    share = np.clip(((middle - start) * long).sum(-1) / square, 0.0, 1.0)[..., None]
    off = middle - start - share * long
    return np.argwhere(np.hypot(off[..., 0], off[..., 1]) <= radius + margin)


def _radius(sizes: Sizes, room: FloatArray) -> FloatArray:
    """Of circles about benches' middles that hold each while it moves so far, m."""
    links, front, rear, width = sizes.numbers
    result: FloatArray = 0.5 * np.hypot(links + front + rear, width) + room + SLACK
    return result


@dataclass(frozen=True)
class Gaps:
    """How pairs of benches are apart along lines, as seen in doubles.

    Attributes:
        size: m, (n,): a lower bound of the distance.
        line: the unit vector from one towards the other, (n, 2).
    """

    size: FloatArray
    line: FloatArray


# Axes along which two benches may be separated: whose normal (0 the first, 1 the second; 2: from a
# corner to the nearest of the other), and which (0 along the bench, 1 across). Coils lie side by side:
# across comes first.
LINES = ((0, 1), (1, 1), (0, 0), (1, 0), (2, 0))


def gaps(one: FloatArray, other: FloatArray, normal: int, axis: int) -> Gaps:
    """How rectangles, (n, 4, 2) each, are apart along one of LINES."""
    line = _to_corner(one, other) if normal == 2 else _normal((one, other)[normal], axis)
    a, b = (np.einsum("nvc,nc->nv", boxes, line) for boxes in (one, other))
    ahead, behind = b.min(1) - a.max(1), a.min(1) - b.max(1)
    sign = np.where(ahead >= behind, 1.0, -1.0)
    return Gaps(np.maximum(ahead, behind), line * sign[:, None])


def _normal(boxes: FloatArray, axis: int) -> FloatArray:
    """Unit vectors along rectangles, or across them, (n, 2)."""
    long = boxes[:, 0] - boxes[:, 3]
    size = np.hypot(long[:, 0], long[:, 1])[:, None]
    unit = np.where(size > 0.0, long / np.where(size > 0.0, size, 1.0), (1.0, 0.0))
    return unit if axis == 0 else np.stack([-unit[:, 1], unit[:, 0]], 1)


def _to_corner(one: FloatArray, other: FloatArray) -> FloatArray:
    """Unit vectors from a corner to the nearest of the other rectangle, (n, 2)."""
    between = (other[:, None, :, :] - one[:, :, None, :]).reshape(len(one), 16, 2)
    apart = np.hypot(between[..., 0], between[..., 1])
    nearest = between[np.arange(len(one)), apart.argmin(1)]
    unit: FloatArray = nearest / np.maximum(apart.min(1), 1e-300)[:, None]
    return unit


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


def line_between(one: FloatArray, other: FloatArray, ahead: FloatArray) -> Line:
    """The line of two rectangles, (4, 2) each, whose benches point along `ahead`, (2, 2)."""
    tried = [(gaps(one[None], other[None], *which), *which) for which in LINES]
    found, normal, axis = max(tried, key=lambda each: float(each[0].size[0]))
    line = found.line[0]
    x, y = (arb(float(v)) for v in line)
    size = (x * x + y * y).sqrt()
    if normal == 2:
        return Line(2, 0, 1, (x / size, y / size))
    own = ahead[normal] if axis == 0 else np.array([-ahead[normal, 1], ahead[normal, 0]])
    return Line(normal, axis, 1 if float(own @ line) > 0.0 else -1, (x, y))


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


def line_of(benches: Sequence[Bench]) -> Line:
    """The line along which two bodies are farthest apart, as doubles show it."""
    x, y = benches[0].corners[0]  # about which doubles are accurate at any distance
    boxes = [np.array([[float(a - x), float(b - y)] for a, b in bench.corners]) for bench in benches]
    ahead = np.array([[float(v) for v in bench.ahead] for bench in benches])
    return line_between(boxes[0], boxes[1], ahead)


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
