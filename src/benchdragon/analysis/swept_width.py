"""Where the band that a dance covers along its route is widest, across the route.

At a place of the route, the band is what is covered of the line square to the route there, as far out
as a bench can be from its own route, by benches that stand there: the place lies between their ends.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely

from benchdragon.analysis.swept_steps import SLACK, Steps, placed_steps
from benchdragon.kernels.band import turnings
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.model.answer import Answer
from benchdragon.model.base_curve import Point
from benchdragon.model.walk import Walk

# Cells of the route in which the band is bounded: their length at first, m; how many there may be.
CELL, MOST_CELLS = 0.25, 20_000
# How often those that may hold the widest place are halved; unless pairs of cell and hull were more.
HALVINGS, MOST_PAIRS = 8, 1_500_000
# Pairs that are looked at together.
PAIRS = 20_000
# Cells in which the band is measured in full, and places of each kind of bench there.
TRIED, PLACES = 4, 512
# The numbers of two corners of eight.
FIRST, SECOND = np.triu_indices(8, 1)


@dataclass(frozen=True)
class Widest:
    """The widest place of a band.

    Attributes:
        width: m, with a bracket; its value was seen at `s`.
        s: route position, m.
        point: of the route there, m.
        left: how far the band reaches to the left of the route there, m.
        right: to the right.
    """

    width: Answer
    s: float
    point: Point
    left: float
    right: float


@dataclass(frozen=True)
class _Cells:
    """Stretches of the route that are apart, ascending, and what is known of each."""

    ends: FloatArray  # route positions, m, (n, 2)
    start: FloatArray  # point, m, (n, 2)
    along: FloatArray  # direction of the chord, (n, 2)
    chord: FloatArray  # its length, m, (n,)
    sag: FloatArray  # at most how far the route leaves it, m, (n,)
    turning: FloatArray  # at least what the route turns by in all, rad, (n,)

    def halves(self, chosen: IntArray) -> FloatArray:
        """The ends of the halves of some, (2 n, 2)."""
        low, high = self.ends[chosen].T
        middle = 0.5 * (low + high)
        return np.column_stack([low, middle, middle, high]).reshape(-1, 2)


def widest_place(walk: Walk, steps: Steps) -> Widest:
    """Where the band is widest: cells that cannot hold that place are left out, the others halved.

    The bracket closes with the error of the steps, unless the band is as wide almost everywhere.
    """
    out, stretches = _reach(steps), _stretches(steps)
    low, high = float(steps.rear.min()), float(steps.front.max())
    count = int(min(max(np.ceil((high - low) / CELL), 1), MOST_CELLS))
    borders = np.linspace(low, high, count + 1)
    ends, best = np.column_stack([borders[:-1], borders[1:]]), (0.0, 0.0, low)
    most = np.inf
    for halving in range(HALVINGS):
        cells = _cells(walk, ends)
        bounds = _bounds(steps, cells, stretches, out, cut=halving > 0)
        most = min(most, float(bounds.max()))
        tried = np.argsort(-bounds)[:TRIED]
        found = [_measured(walk, steps, float(s), out) for s in cells.ends[tried].mean(axis=1)]
        best = max([best, *found], key=lambda one: one[0] + one[1])
        still: IntArray = np.flatnonzero(bounds > best[0] + best[1])
        ends = cells.halves(still) if halving else cells.ends[still]
        if not len(ends) or _pair_count(stretches, ends) > MOST_PAIRS:
            break
    wide, s = best[0] + best[1], best[2]
    x, y = walk.route.point(s).tolist()
    return Widest(Answer(wide, wide, max(wide, most), "m", "found"), s, (x, y), best[0], best[1])


def _reach(steps: Steps) -> float:
    """How far any point of a bench can be from one of its handles, which are on the route, m."""
    length, width, front, rear = steps.sizes
    ahead = np.maximum(0.5 * (length - front - rear), np.maximum(front, rear))
    return float(np.hypot(ahead, 0.5 * width).max()) + SLACK


def _stretches(steps: Steps) -> FloatArray:
    """From where to where along the route the bench of each step may stand, m, (n, 2)."""
    _length, width, front, rear = (size[steps.kind] for size in steps.sizes)
    return np.column_stack([steps.rear[:, 0] - rear - width, steps.front[:, 1] + front + width])


def _cells(walk: Walk, ends: FloatArray) -> _Cells:
    """Cells of the route: an arc between two foci lies within an ellipse about its chord."""
    ends = np.minimum(ends, walk.route.length)
    points = walk.route.point(ends)
    ways, lengths = points[:, 1] - points[:, 0], ends[:, 1] - ends[:, 0]
    chord = np.hypot(*ways.T)
    sag = 0.5 * np.sqrt(np.maximum(lengths**2 - chord**2, 0.0)) + SLACK
    turning = np.empty(ends.size - 1)
    turnings(walk.route.rows, np.ascontiguousarray(ends).ravel(), turning)
    along = np.where(chord[:, np.newaxis] > 0.0, ways, [1.0, 0.0])
    along = along / np.hypot(*along.T)[:, np.newaxis]
    return _Cells(ends, points[:, 0], along, chord, sag, turning[::2])


def _bounds(steps: Steps, cells: _Cells, stretches: FloatArray, out: float, *, cut: bool) -> FloatArray:
    """At most how wide the band is in each cell, m, (n,).

    What lies square to the route in a cell lies in a slab about its chord, which is longer by what the
    route leaves the chord by and by what its squares swing. Hulls count as cut by the slab, or whole.
    """
    near = cells.sag + steps.widest_stray
    swing = np.minimum(cells.turning, 0.5 * np.pi)
    pad = near + (out + near) * np.sin(swing)
    sides = np.zeros((2, len(pad)))
    for number, cell in _pairs(stretches, cells.ends):
        off = steps.corners[number].reshape(-1, 8, 2) - cells.start[cell][:, np.newaxis]
        along = cells.along[cell][:, np.newaxis]
        x = (off * along).sum(axis=2)
        y = off[..., 1] * along[..., 0] - off[..., 0] * along[..., 1]
        if cut:
            y = _within(x, y, -pad[cell], cells.chord[cell] + pad[cell])
        np.maximum.at(sides[0], cell, y.max(axis=1))
        np.maximum.at(sides[1], cell, -y.min(axis=1))
    straight = np.hypot(sides, pad) + near
    with np.errstate(divide="ignore"):
        square = (sides + near) / np.maximum(np.cos(swing), 0.0)
    bounds: FloatArray = np.minimum(np.minimum(straight, square), out + near).sum(axis=0)
    return bounds


def _within(x: FloatArray, y: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """y of the corners, (n, 8), with x from low to high, (n,), and where hulls cross these; else 0."""
    low, high = low[:, np.newaxis], high[:, np.newaxis]
    found = [np.where((low <= x) & (x <= high), y, 0.0)]
    ax, ay, bx, by = x[:, FIRST], y[:, FIRST], x[:, SECOND], y[:, SECOND]
    for border in (low, high):
        crosses = (ax < border) != (bx < border)
        share = (border - ax) / np.where(crosses, bx - ax, 1.0)
        found.append(np.where(crosses, ay + share * (by - ay), 0.0))
    return np.concatenate(found, axis=1)


def _reached(stretches: FloatArray, ends: FloatArray) -> tuple[IntArray, IntArray]:
    """The first cell that each stretch reaches, and the one behind the last."""
    first = np.searchsorted(ends[:, 1], stretches[:, 0])
    return first, np.maximum(first, np.searchsorted(ends[:, 0], stretches[:, 1], side="right"))


def _pair_count(stretches: FloatArray, ends: FloatArray) -> int:
    first, stop = _reached(stretches, ends)
    return int((stop - first).sum())


def _pairs(stretches: FloatArray, ends: FloatArray) -> Iterator[tuple[IntArray, IntArray]]:
    """Numbers of steps and of cells that their stretches reach, some at a time."""
    first, stop = _reached(stretches, ends)
    starts = np.append(0, np.cumsum(stop - first))
    for low in range(0, int(starts[-1]), PAIRS):
        pair = np.arange(low, min(low + PAIRS, int(starts[-1])))
        number: IntArray = np.searchsorted(starts, pair, side="right") - 1
        yield number, first[number] + pair - starts[number]


def _measured(walk: Walk, steps: Steps, s: float, out: float) -> tuple[float, float, float]:
    """How far benches that really stand at route position s, m, reach to the left and right; and s."""
    middle = walk.route.point(s)
    heading = float(walk.route.heading(s))
    square = np.array([-np.sin(heading), np.cos(heading)])
    line = shapely.LineString([middle - out * square, middle + out * square])
    left, right = 0.0, 0.0
    for k, spans in enumerate(steps.spans):
        length, width, front, rear = steps.sizes[:, k]
        low, high = s - front - width, s + rear + width + 2.0 * length
        held = spans[(spans[:, 1] >= low) & (spans[:, 0] <= high)]
        if not len(held):
            continue
        clipped = np.clip(held, low, high)
        at = np.unique(np.concatenate([np.linspace(a, b, PLACES) for a, b in clipped[:TRIED].tolist()]))
        _k, ends, back, corners, _stray, _fill = placed_steps(
            walk, steps.sizes, k, np.column_stack([at, at])
        )
        stands = (back[:, 0] - rear - width <= s) & (ends[:, 0] + front + width >= s)
        benches = shapely.polygons(corners[stands, 0])
        points = shapely.get_coordinates(shapely.intersection(benches, line))
        if len(points):
            aside = (points - middle) @ square
            left, right = max(left, float(aside.max())), max(right, float(-aside.min()))
    return left, right, s
