"""The ways of benches cut into steps: in each, a convex outline of what a bench covers, and bounds.

Where a bench stands depends on its own link and on the route position of its own front handle, and on
nothing else. Benches of one size thus sweep one band along the route: from where the last one's front
handle starts to where the first one's ends, less the gaps that a short walk leaves between them.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from benchdragon.errors import BenchDragonError, InputError, UnsureError
from benchdragon.i18n import _
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.ground_covered import strays
from benchdragon.kernels.links import link_of
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.route import IntArray, positions
from benchdragon.model.walk import Walk

# First steps of a front handle, as a share of the link: bounds hold for short ones alone.
FIRST_STEP = 0.25
# A step that is no longer than this, m, and still unsure holds a leap.
LEAST_STEP = 1e-7
# Steps in all: the outlines of so many take some 0.5 GB and a minute or two.
MOST_STEPS = 200_000
# Steps that are placed at a time, and how far from sure route positions are, m.
BATCH, SLACK = 4_096, 1e-7
# Of the error that is asked for, what a step may stray, and what its outline may cover needlessly.
STRAY_SHARE, FILL_SHARE = 0.1, 0.6


@dataclass(frozen=True)
class Steps:
    """Steps of front handles, in the order of kinds and along the route.

    Attributes:
        sizes: of each kind of bench, m, (4, kinds): see kernels/box.py.
        spans: for each kind, where its front handles walk, m, (spans, 2), apart from one another.
        kind: of each step, (n,).
        front: route positions of the front handle at its ends, m, (n, 2).
        rear: the same of the rear handle.
        corners: of the bench at the two ends, m, (n, 2, 4, 2).
        stray: at most how far from the hull of these the bench comes in between, m, (n,).
        fill: at most how far from what is covered, stray aside, a point of the hull is, m, (n,).
    """

    sizes: FloatArray
    spans: tuple[FloatArray, ...]
    kind: IntArray
    front: FloatArray
    rear: FloatArray
    corners: FloatArray
    stray: FloatArray
    fill: FloatArray

    @property
    def widest_stray(self) -> float:
        """The greatest of `stray`, and SLACK, m."""
        return float(self.stray.max()) + SLACK

    @property
    def needless(self) -> float:
        """At most how far from what is covered any point of any hull is, m."""
        return float((self.stray + self.fill).max()) + SLACK


def walked_steps(walk: Walk, start: float, end: float, error: float) -> Steps:
    """All steps of a walk from start to end, s, each fine enough for an error, m.

    Raises:
        InputError: if they are more than MOST_STEPS.
        WalkError: where the dragon cannot stand.
        UnsureError: where it is not sure that a bench follows without a leap.
    """
    fronts = walk.motion([start, end]).s[:, :-1]
    sizes, kinds = np.unique(walk.dragon.sizes, axis=1, return_inverse=True)
    spans = tuple(merged(fronts[:, kinds == k].T) for k in range(sizes.shape[1]))
    cutter = _Cutter(walk, error)
    found = [step for k, some in enumerate(spans) for step in cutter.cut(k, sizes, some, (start, end))]
    joined = [np.concatenate(column) for column in zip(*found, strict=True)]
    order = np.lexsort((joined[1][:, 0], joined[0]))
    return Steps(np.ascontiguousarray(sizes), spans, *(column[order] for column in joined))


def merged(spans: FloatArray) -> FloatArray:
    """The union of spans (from, to), (n, 2), as spans that are apart, ascending."""
    ordered = spans[np.argsort(spans[:, 0], kind="stable")]
    reached = np.maximum.accumulate(ordered[:, 1])
    first = np.flatnonzero(np.append(True, ordered[1:, 0] > reached[:-1]))
    last = np.append(first[1:], len(ordered)) - 1
    return np.column_stack([ordered[first, 0], reached[last]])


Columns = tuple[IntArray, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]


class _Cutter:
    """Cuts spans into steps, halving each until it is fine enough."""

    def __init__(self, walk: Walk, error: float) -> None:
        self._walk, self._error, self._done = walk, error, 0

    def cut(
        self, k: int, sizes: FloatArray, spans: FloatArray, times: tuple[float, float]
    ) -> Iterator[Columns]:
        """The steps of benches of kind k, in batches, as columns of `Steps`."""
        link = link_of(sizes, k)
        counts = np.ceil((spans[:, 1] - spans[:, 0]) / (FIRST_STEP * link)).astype(np.int64)
        self._allow(int(np.maximum(counts, 1).sum()))
        waiting = np.concatenate(
            [_steps(low, high, max(count, 1)) for (low, high), count in zip(spans, counts, strict=True)]
        )
        while len(waiting):
            halves = []
            for first in range(0, len(waiting), BATCH):
                ends = waiting[first : first + BATCH]
                placed = placed_steps(self._walk, sizes, k, ends)
                fine = (placed[4] <= STRAY_SHARE * self._error) & (
                    placed[4] + placed[5] <= FILL_SHARE * self._error
                )
                self._done += int(fine.sum())
                yield tuple(column[fine] for column in placed)  # type: ignore[misc]
                rough = ends[~fine]
                fallen = ends[np.isnan(placed[2]).any(axis=1)]
                short = rough[rough[:, 1] - rough[:, 0] <= LEAST_STEP]
                if len(fallen) or len(short):
                    raise self._leap((fallen if len(fallen) else short)[0, 0], link, times)
                middle = 0.5 * rough.sum(axis=1)
                halves += [np.column_stack([rough[:, 0], middle])]
                halves += [np.column_stack([middle, rough[:, 1]])]
            waiting = np.concatenate(halves)
            self._allow(len(waiting))

    def _allow(self, more: int) -> None:
        if self._done + more > MOST_STEPS:
            text = _(
                "the area within {error} m takes more than {most} steps: allow a larger error, or "
                "ask for a shorter time or fewer sizes of benches"
            )
            raise InputError(text.format(error=f"{self._error:g}", most=MOST_STEPS))

    def _leap(self, s: float, link: float, times: tuple[float, float]) -> BenchDragonError:
        """What to say of a bench that cannot stand, or may leap, with its front handle at s, m."""
        ends = self._walk.head_position(np.array(times))
        failed = self._walk.first_failure(np.linspace(ends[0], ends[1], BATCH))
        return failed or UnsureError(
            _(
                "a bench with {link} m between its handles leaps, or may leap, with its front handle "
                "at s = {s} m of the route: use gentler bends or shorter benches"
            ).format(link=f"{link:g}", s=f"{s:.6g}")
        )


def _steps(low: float, high: float, count: int) -> FloatArray:
    borders = np.linspace(low, high, count + 1)
    return np.column_stack([borders[:-1], borders[1:]])


def placed_steps(walk: Walk, sizes: FloatArray, k: int, ends: FloatArray) -> Columns:
    """Benches of kind k at both ends, (n, 2), of steps: all columns of `Steps`, fine enough or not.

    The hull of a rectangle K at two poses, turned by d from one to the other, is nowhere farther than
    |d| diameter(K) / 4 from what K covers going straight from one to the other: a point of the hull
    is (1 - t) a + t b of points a, b of the two, and (1 - t)^2 a + t (1 - t) (a' + b') + t^2 b,
    where a' and b' are what a and b are at the other end, is covered.
    """
    link = np.array([link_of(sizes, k)])
    places, stray = empty_placements(2, ends.size), np.empty(len(ends))
    place_chain(walk.route.rows, link, np.ascontiguousarray(ends).ravel(), 0, ends.size, places)
    strays(walk.route.rows, link, np.ascontiguousarray(sizes), k, places, stray)
    sound = places.failed[0] == 0
    rear = np.full(ends.size, np.nan)
    rears = np.empty(int(sound.sum()))
    positions(walk.route.rows, places.row[1, sound], places.u[1, sound], rears)
    rear[sound] = rears
    corners = bench_corners(places, sizes[:, k])
    ahead = corners[:, 0] - corners[:, 1]
    ahead = (ahead / np.hypot(*ahead.T)[:, np.newaxis]).reshape(-1, 2, 2)
    turned = np.hypot(*(ahead[:, 1] - ahead[:, 0]).T)  # 2 sin(d / 2)
    fill = 0.25 * turned * np.hypot(sizes[0, k], sizes[1, k])
    kind = np.full(len(ends), k, dtype=np.int64)
    return kind, ends, rear.reshape(-1, 2), corners.reshape(-1, 2, 4, 2), stray, fill


def bench_corners(places: Placements, size: FloatArray) -> FloatArray:
    """Corners of one bench in all slots, m, (slots, 4, 2): front left first, going round."""
    front = np.column_stack([places.x[0], places.y[0]])
    along = front - np.column_stack([places.x[1], places.y[1]])
    along /= size[0] - size[2] - size[3]
    nose = front + size[2] * along
    end = nose - size[0] * along
    side = 0.5 * size[1] * np.column_stack([-along[:, 1], along[:, 0]])
    return np.stack([nose + side, end + side, end - side, nose - side], axis=1)
