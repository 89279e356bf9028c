"""Where on a route the benches of a dragon can meet, and which pairs of them, step by step.

The route is cut into cells, and what benches of each size sweep over in a cell is boxed once. Only
cells whose boxes come within reach of one another are ever looked at again (kernels/regions.py). Cells
of a spiral that lie outside the radius of `spiral_bound` are boxed only where another part comes near.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchdragon.analysis.ledger import Ledger
from benchdragon.errors import InputError, UnsureError
from benchdragon.i18n import _
from benchdragon.kernels import regions as kernel
from benchdragon.kernels.box import BOX_COLUMNS, CX, CY, HALF_LENGTH, HALF_WIDTH
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.grid import filled_grid, has_near, pairs_near
from benchdragon.kernels.regions import EDGE
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.spiral_bound import clear_spans, shape_of
from benchdragon.kernels.step_bounds import empty_placements, place_chain
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon
from benchdragon.model.placement import Placement

# Cells are this share of the shortest link: shorter ones cost more boxes, longer ones looser boxes.
CELL = 0.45
# A cell whose boxes come near another's is cut into so many; steps of the head are as long. Fewer
# leave more pairs to the search, more cost more boxes.
PARTS = 4
# Where at most so many pairs of parts a cell are left, they are cut once more: it may be none.
SPARSE = 40
# Cells in which it is unsure whether a bench can walk through are looked at in so many parts at first,
# then in finer ones, down to this, m: far coarser, and overlaps just before a fold would stay unknown.
CAREFUL_PARTS, FINEST = 16, 1e-9
# Benches are boxed in at most so many groups of sizes; more would mean more pairs of boxes.
GROUPS = 3
# Different sizes of benches whose contacts can be searched: each is boxed in each cell.
MOST_SIZES = 2_000
# Cells of a route: 1e6 cells need 100 MB.
MOST_CELLS = 2_000_000
# Head's walk, m, that is prepared at a time: the least at first and when benches first can meet, for
# there a search may end; then doubled, up to this or this share of the route that is known already.
LEAST_STRIDE, STRIDE, SHARE = 8.0, 128.0, 0.1
# Places marched at a time: 100 MB.
PLACES = 1_000_000


@dataclass(frozen=True)
class Step:
    """A step of the head, m, and the pairs of benches (rows from 0) that may come within reach."""

    start: float
    end: float
    first: IntArray
    second: IntArray


class BroadPhase:
    """The cells of a route that a dragon walks, from where its tail stands at first.

    Args:
        dragon: the benches.
        route: what they walk on.
        reach: distance of benches, m, within which pairs are wanted.
        start: the head's first route position, m; the dragon must be able to stand there.
        ledger: takes down what is computed, for a proof.
    """

    def __init__(
        self, dragon: Dragon, route: Route, reach: float, start: float, ledger: Ledger | None = None
    ) -> None:
        self.dragon, self.route, self.reach, self.ledger = dragon, route, reach + EDGE, ledger
        classes, kinds = np.unique(dragon.sizes, axis=1, return_inverse=True)
        self._class = kinds.ravel()
        if classes.shape[1] > MOST_SIZES:
            raise InputError(
                _("contacts can be searched for at most {most} different sizes, not {count}").format(
                    most=MOST_SIZES, count=classes.shape[1]
                )
            )
        self._classes = np.ascontiguousarray(classes)
        order = np.argsort(classes[0], kind="stable")
        self._group_of = np.empty(classes.shape[1], dtype=np.int64)
        for g, members in enumerate(np.array_split(order, min(GROUPS, len(order)))):
            self._group_of[members] = g
        self.group = self._group_of[self._class]
        self.groups = int(self._group_of.max()) + 1
        self._between = self._least_ways()
        self.cell = CELL * float(dragon.links.min())
        self._clear_spans = self._find_clear_spans()
        self._span_of = np.empty((self.groups, self.groups, 0), dtype=np.int64)  # see _spans_of
        s = self._positions(np.array([start]))[:, 0]
        self.low = math.floor(s[-2] / self.cell) if len(dragon) > 1 else math.floor(s[0] / self.cell)
        # Where each group's rearmost bench stands at first: it never comes behind that.
        self._rear = np.array([s[:-1][self.group == g].min() for g in range(self.groups)])
        self.hulls = np.empty((self.groups, 0, BOX_COLUMNS))
        # Classes of sizes and cells of which it is not known yet whether the benches can walk through.
        self.doubts: set[tuple[int, int]] = set()
        self._fine: dict[tuple[int, int], FloatArray] = {}  # by parts of a cell, and group
        self._pairs: list[IntArray] = []
        self.extend(start)

    def _least_ways(self) -> FloatArray:
        """At most the route, m, from a bench of group a back to one of group b, not neighbours."""
        ahead = np.concatenate([[0.0], np.cumsum(self.dragon.links)[:-1]])
        ways = np.full((self.groups, self.groups), np.inf)
        for b in range(self.groups):
            members = np.flatnonzero(self.group == b)
            for a in range(self.groups):
                fronts = np.flatnonzero(self.group == a)
                nearest = np.searchsorted(members, fronts + 2)
                fronts = fronts[nearest < len(members)]
                nearest = nearest[nearest < len(members)]
                ways[a, b] = (ahead[members[nearest]] - ahead[fronts]).min(initial=np.inf)
        return ways

    def _find_clear_spans(self) -> dict[tuple[int, int], FloatArray]:
        """Spans of the route where benches of groups a and, behind them, b, keep apart."""
        sizes = (self._classes[:, self._group_of == g] for g in range(self.groups))
        shapes = [shape_of(np.ascontiguousarray(some), 0.5 * self.reach) for some in sizes]
        between = float(self.dragon.links.min())
        pairs = list(zip(*np.nonzero(np.isfinite(self._between)), strict=True))
        found, spans = {}, np.empty((len(self.route.rows), 2))
        for a, b in pairs:
            count = clear_spans(self.route.rows, shapes[a], shapes[b], between, spans)
            found[int(a), int(b)] = spans[:count].copy()
        # Benches that can meet no other must follow too: no span spares their cells.
        alone = set(range(self.groups)).difference(*pairs)
        return {**found, **{(g, g): np.empty((0, 2)) for g in alone}}

    @property
    def count(self) -> int:
        """Number of cells so far."""
        return self.hulls.shape[1]

    def strides(self, start: float, end: float) -> Iterator[tuple[float, float]]:
        """Parts of start..end, m, to be extended by one after another: short where a search may end."""
        done, stride, met = start, LEAST_STRIDE, False
        while done < end:
            upto = min(end, max(done + stride, self._clear_end(done)))
            self.extend(upto)
            yield done, upto
            first = bool(self._pairs) and not met
            met = met or first
            most = max(STRIDE, SHARE * (upto - self.low * self.cell))
            stride = LEAST_STRIDE if first else min(2.0 * stride, most)
            done = upto

    def _clear_end(self, s: float) -> float:
        """Up to where the head surely meets no other, standing at s, m; not more than s if nowhere."""
        head = int(self.group[0])
        ends = [
            max((end for start, end in parts if start <= s), default=s)
            for (a, _b), parts in self._clear_spans.items()
            if a == head
        ]
        return min(ends, default=s)

    def sound_until(self, start: float, end: float) -> tuple[float, float]:
        """Up to which head position, m, `steps` knows all benches, and up to which all surely follow.

        Both are `end`, if that is so all the way; the second is not before the first.
        """
        known = sound = end
        s = self._positions(np.array([start]))[:-1, 0] if self.doubts else np.empty(0)
        for i, k, c in self._first_to_come(s):
            back, ahead = (max(s[i], (c + self.low + n) * self.cell) for n in range(2))
            arrival = self._arrival(i, back, start, sound)
            if arrival >= sound:
                continue
            place = self._follows_until(k, back, ahead)
            if place < ahead:
                known, sound = min(known, arrival), self._arrival(i, place, start, sound)
            elif back > s[i]:
                self.doubts.discard((k, c))
        return min(known, sound), sound

    def _first_to_come(self, s: FloatArray) -> list[tuple[int, int, int]]:
        """The first bench, from positions s (m) of the front handles on, in each doubtful cell.

        And the next, where the first stands inside: it comes through what lies behind that one.
        """
        found = []
        for k, c in self.doubts:
            back, ahead = ((c + self.low + n) * self.cell for n in range(2))
            coming = np.flatnonzero((self._class == k) & (s < ahead))
            inside = int((s[coming[:1]] > back).sum())
            found += [(int(i), k, c) for i in coming[: 1 + inside]]
        return sorted(found, key=lambda meeting: meeting[2])

    def _follows_until(self, k: int, start: float, end: float) -> float:
        """The place up to which benches of class k surely follow, their front handle from start, m.

        The way is halved where it is unsure, down to FINEST; `end`, if all the way.
        """
        at, step = start, (end - start) / CAREFUL_PARTS
        while at < end:
            ahead = min(end, at + step)
            if self._swept(k, np.array([at, ahead]), np.full((1, BOX_COLUMNS), np.nan)).all():
                at, step = ahead, 2.0 * step
            elif step > _finest(at):
                step *= 0.5
            else:
                return at
        return end

    def _arrival(self, i: int, back: float, start: float, end: float) -> float:
        """At most the head's position in start..end at which handle i comes to `back`, m."""
        if i == 0:
            return min(max(back, start), end)
        low, high, middle = start, end, end  # it may not come so far
        while low < middle:
            stands, s = self._tried(np.array([middle]), i)
            if stands and s[i, 0] < back:
                low = middle
            else:
                high = middle
            middle = 0.5 * (low + high) if high - low > _finest(high) else low
        return low

    def extend(self, end: float) -> None:
        """Know the route up to position `end`, m."""
        wanted = math.floor(end / self.cell) + 1 - self.low
        if wanted > MOST_CELLS:
            raise InputError(
                _("the route is too long to be searched: {count} cells, at most {most}").format(
                    count=wanted, most=MOST_CELLS
                )
            )
        if wanted <= self.count:
            return
        old = self.count
        fresh = np.full((self.groups, wanted - old, BOX_COLUMNS), np.nan)
        self.hulls = np.concatenate([self.hulls, fresh], axis=1)
        span = self._spans_of(np.arange(old, wanted))
        self._span_of = np.concatenate([self._span_of, span], axis=2)
        exposed = self._exposed()
        for g in range(self.groups):
            rear = math.floor(self._rear[g] / self.cell) - self.low
            numbers = np.flatnonzero(exposed[g] & np.isnan(self.hulls[g, :, CX]))
            numbers = numbers[numbers >= rear]
            self.doubts.update(self._box(g, numbers, (1, 1), self.hulls[g], numbers))
        for a, b, k, m in self._near(old):
            first, second = self._refined(a, b, k, m, PARTS)
            if 0 < len(first) <= SPARSE * (wanted - old):
                first, second = self._undecided(a, b, first, second)
            if len(first):
                groups = np.full((2, len(first)), [[a], [b]])
                self._pairs.append(np.array([groups[0], first, groups[1], second]))

    def _spans_of(self, cells: IntArray) -> IntArray:
        """In which clear span of each pair of groups these cells lie, borders included; -1: in none."""
        found = np.full((self.groups, self.groups, len(cells)), -1)
        back, ahead = ((cells + self.low + n) * self.cell for n in (0, 1))
        for (a, b), parts in self._clear_spans.items():
            for n, (start, end) in enumerate(parts):
                found[a, b, (back - EDGE >= start) & (ahead + EDGE <= end)] = n
        return found

    def _exposed(self) -> npt.NDArray[np.bool_]:
        """Which cells to box, (groups, count): where a bench may come near one of another span."""
        exposed = np.zeros((self.groups, self.count), dtype=bool)
        arms = np.array([self._arm(g) for g in range(self.groups)])
        middle = (np.arange(self.count) + self.low + 0.5) * self.cell
        places = self.route.point(np.clip(middle, self._rear.min(), self.route.length))
        for (a, b), parts in self._clear_spans.items():
            reach = arms[a] + arms[b] + self.reach
            for n in range(-1, len(parts)):
                inside = self._span_of[a, b] == n
                near = inside if n < 0 else _near_others(places, inside, reach)
                exposed[a, near] = exposed[b, near] = True
        return exposed

    def _arm(self, g: int) -> float:
        """How far benches of group g reach from the middle of a cell with their front handle, m."""
        length, width, front, _rear = self._classes[:, self._group_of == g]
        return float(np.hypot(np.maximum(front, length - front), 0.5 * width).max()) + self.cell

    def _box(
        self,
        g: int,
        numbers: IntArray,
        cut: tuple[int, int],
        hulls: FloatArray,
        targets: IntArray,
    ) -> list[tuple[int, int]]:
        """Box group g in parts of these cells, into rows `targets` of hulls.

        `cut`: how many of what is numbered a cell has, and into how many each of these is cut.

        Returns:
            Classes of sizes, and targets in which it is not sure that such benches can walk through.
        """
        if not len(numbers):
            return []
        whole, parts = cut
        numbers = numbers + self.low * whole
        borders = (numbers[:, np.newaxis] + np.arange(parts + 1) / parts) * (self.cell / whole)
        at = np.clip(borders, self._rear[g], self.route.length)
        unsure = []
        for k in np.flatnonzero(self._group_of == g).tolist():
            sound = self._swept(k, at, hulls, targets)
            unsure += [(k, c) for c in targets[sound == 0.0].tolist()]
        return unsure

    def _swept(
        self, k: int, borders: FloatArray, hulls: FloatArray, targets: IntArray | None = None
    ) -> FloatArray:
        """Widen rows of hulls by benches of class k between neighbours in each row of borders, m.

        1 for each where they surely can walk through, else 0.
        """
        at = borders.ravel()
        many = borders.shape[-1]
        slots = (np.arange(0, at.size, many)[:, np.newaxis] + np.arange(many - 1)).ravel()
        places = empty_placements(2, len(at))
        bench = np.ascontiguousarray(self._classes[:, k : k + 1])
        links = bench[0] - bench[2] - bench[3]
        links.flags.writeable = False  # one kind of array, so that kernels are compiled once
        place_chain(self.route.rows, links, at, 0, len(at), places)
        if self.ledger is not None:
            self.ledger.add_cells(float(links[0]), at, places)
        sound = np.empty(len(slots))
        rows = np.arange(len(slots)) if targets is None else targets
        kernel.sweep_cells(self.route.rows, links, bench, 0, places, slots, rows, hulls, sound)
        return sound

    def _near(self, old: int) -> Iterator[tuple[int, int, IntArray, IntArray]]:
        """Groups a, b and cells k >= old, m <= k whose boxes are within reach, benches between them."""
        radius = np.hypot(self.hulls[..., HALF_LENGTH], self.hulls[..., HALF_WIDTH])
        for b in range(self.groups):
            others = np.ascontiguousarray(self.hulls[b, :, [CX, CY]].T)
            if np.isnan(others).all() or np.isinf(self._between[:, b]).all():
                continue
            widest = float(np.nanmax(radius[b]))
            grid = filled_grid(others, widest + self.reach)  # few squares, however far the reach
            for a in np.flatnonzero(np.isfinite(self._between[:, b])).tolist():
                fresh = radius[a, old:]
                if np.isnan(fresh).all():
                    continue
                places = np.ascontiguousarray(self.hulls[a, :, [CX, CY]].T)
                k, m = pairs_near(
                    grid, others, places, old, float(np.nanmax(fresh)) + widest + self.reach
                )
                keep = (k + 1 - m) * self.cell >= self._between[a, b]
                span = self._span_of[a, b]
                keep &= (span[k] < 0) | (span[k] != span[m])
                k, m = k[keep], m[keep]
                flags = np.empty(len(k), dtype=np.int64)
                kernel.near_pairs(self.hulls[a], self.hulls[b], k, m, self.reach, flags)
                yield a, b, k[flags > 0], m[flags > 0]

    def _refined(
        self, a: int, b: int, k: IntArray, m: IntArray, parts: int
    ) -> tuple[IntArray, IntArray]:
        """The pairs within reach when cells k and m are cut into PARTS: `parts` of a whole cell."""
        if not len(k):
            return k, m
        for g, numbers in ((a, k), (b, m)):
            self._refine(g, numbers, parts)
        part = np.arange(PARTS)
        first = np.repeat((k[:, np.newaxis] * PARTS + part), PARTS, axis=1).ravel()
        second = np.tile((m[:, np.newaxis] * PARTS + part), PARTS).ravel()
        keep = (first + 1 - second) * self.cell / parts >= self._between[a, b]
        first, second = first[keep], second[keep]
        flags = np.empty(len(first), dtype=np.int64)
        kernel.near_pairs(self._fine[parts, a], self._fine[parts, b], first, second, self.reach, flags)
        return first[flags > 0], second[flags > 0]

    def _undecided(self, a: int, b: int, k: IntArray, m: IntArray) -> tuple[IntArray, IntArray]:
        """The pairs of parts of which a part of each is within reach."""
        first, second = (cells // PARTS for cells in self._refined(a, b, k, m, PARTS * PARTS))
        cells = self.count * PARTS
        keys = np.unique(first * cells + second)
        return keys // cells, keys % cells

    def _refine(self, g: int, numbers: IntArray, parts: int) -> None:
        """Box the parts of these cells or parts of group g, if that was not done before."""
        fine = self._fine.get((parts, g), np.empty((0, BOX_COLUMNS)))
        if len(fine) < self.count * parts:
            more = np.full((self.count * parts - len(fine), BOX_COLUMNS), np.nan)
            self._fine[parts, g] = fine = np.concatenate([fine, more])
        numbers = np.unique(numbers[np.isnan(fine[numbers * PARTS, CX])])
        targets = (numbers[:, np.newaxis] * PARTS + np.arange(PARTS)).ravel()
        self._box(g, numbers, (parts // PARTS, PARTS), fine, targets)

    def steps(self, start: float, end: float) -> Iterator[Step]:
        """Steps of the head within start..end, m, in order, in which pairs may come within reach.

        What lies between them is clear.
        """
        pairs = np.concatenate([np.empty((4, 0), dtype=np.int64), *self._pairs], axis=1)
        if not pairs.size:
            return
        cells, size = self.count * PARTS, self.cell / PARTS
        keys = pairs[0] * cells + pairs[1]
        order = np.argsort(keys, kind="stable")
        partners = pairs[2, order] * cells + pairs[3, order]
        offsets = np.searchsorted(keys[order], np.arange(self.groups * cells + 1)).astype(np.int64)
        begin = max(start, (float(pairs[1].min()) + self.low * PARTS) * size - size)
        if (self.group == self.group[0]).sum() == 1 and (pairs[0] == self.group[0]).all():
            # Only the head is like itself, and only it meets any: until it has passed the last place.
            end = min(end, (float(pairs[1].max()) + self.low * PARTS + 2.0) * size)
        if begin >= end:
            return
        grid = np.append(np.arange(begin, end, size), end)
        # Benches that have not come so far by the end cannot meet any other.
        back = (float(pairs[3].min()) + self.low * PARTS) * size - EDGE
        benches = int((self._positions(grid[-1:])[:-1, 0] >= back).sum())
        span = max(1, PLACES // (benches + 1))
        most = 64 * len(self.dragon)
        for n in range(0, len(grid) - 1, span):
            at = grid[n : n + span + 1]
            s = self._positions(at, benches)
            for t in range(len(at) - 1):
                while True:
                    first, second = np.empty(most, dtype=np.int64), np.empty(most, dtype=np.int64)
                    found = kernel.meeting_pairs(
                        s, t, self.group[:benches], size, self.low * PARTS, offsets, partners, cells,
                        first, second,
                    )  # fmt: skip
                    if found <= most:
                        break
                    most = 2 * found
                if found:
                    # Copies: views would keep all the room alive as long as the step.
                    kept = first[:found].copy(), second[:found].copy()
                    yield Step(float(at[t]), float(at[t + 1]), *kept)

    def _positions(self, at: FloatArray, benches: int | None = None) -> FloatArray:
        """Route positions of the handles of all, or the first, benches with the head at `at`, m."""
        stands, s = self._tried(at, benches)
        if not stands:
            raise UnsureError(_("it could not be shown that the dragon stands all along"))
        return s

    def _tried(self, at: FloatArray, benches: int | None = None) -> tuple[bool, FloatArray]:
        """Whether they stand with the head at all of `at`, and where, m, (handles, len(at))."""
        dragon = self.dragon if benches is None else self.dragon.first(benches)
        placed = Placement(dragon, self.route, at)
        stands = not placed.status.any()
        if self.ledger is not None and stands:
            self.ledger.add_grid(placed)
        return stands, placed.s.T


def _finest(s: float) -> float:
    """The finest step at route position s, m, that rounding allows."""
    return max(FINEST, 4.0 * math.ulp(s))


def _near_others(
    places: FloatArray, inside: npt.NDArray[np.bool_], reach: float
) -> npt.NDArray[np.bool_]:
    """Which of the places inside are within reach of one that is not."""
    near = np.zeros(len(places), dtype=bool)
    if inside.any() and not inside.all():
        others, found = places[~inside], np.empty(len(places), dtype=np.int64)
        flags = np.empty(int(inside.sum()), dtype=np.int64)
        has_near(filled_grid(others, reach), others, places[inside], reach, found, flags)
        near[inside] = flags > 0
    return near
