"""One dance whose people are not exact: where its benches come nearest, and whether they touch.

Its line is the route, or strays from it; its handles keep to the line, or walk so far beside it. The
searches for contact are those of exact dances (kernels/search.py), with all pairs in place of cells.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from benchdragon import budget
from benchdragon.analysis.contact_search import most_evaluations
from benchdragon.errors import BenchDragonError, InputError
from benchdragon.i18n import _
from benchdragon.kernels import curve as kernel
from benchdragon.kernels import search
from benchdragon.kernels.box import nearest_pair
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.every_pair import CROWDED, search_all_pairs
from benchdragon.kernels.perturbed import place_along
from benchdragon.kernels.route import END_SLACK, evaluate
from benchdragon.kernels.walk_search import SEARCHED
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon
from benchdragon.solve.dance_bound import Offset, Part

# Head positions evaluated for a hint, as a share of the shortest link; how often the range about the
# least distance is then evaluated in so many parts.
HINT_STEP, SHRINKS, PARTS = 0.3, 4, 8
# How far around a place known from another pitch, as a share of the longest link; how many benches
# beyond those that met there.
AROUND, BEYOND = 1.5, 12
# The end of the walk that tells about how near benches come where none can touch, m.
LAST = 20.0
# Steps of the head that are searched at once, as a share of the shortest link: longer ones leave looser
# bounds (design/imprecision.py).
STEP = 0.125
# How far least distances may lie below those told, m; what is nearer to touching than this, m, touches.
TOLERANCE, GRAZE = 1e-4, 1e-7
# Parts of a step as short as this, m, are not halved; chains that one step may take.
WIDTH, MOST_EVALUATIONS = 1e-8, 20_000
# Pairs a bench may have near it at first; more, if they are found, take another search.
PARTNERS = 24
# Steps of the head that are searched in one call: of 224 handles some hundredths of a second.
STEPS = 1_000
# What two benches of a dragon placed cost, in handles placed; bytes of a handle placed, and of a point
# of a line that strays; what such a point costs.
PAIR, PLACED, NODE, NODE_WORK = 0.02, 64, 100, 10
# Limits of one dance: handles times evaluations (60 bytes each), and pairs times evaluations.
MOST_PLACES, MOST_PAIRS = 5_000_000, 1e10
# A line that strays is made of arcs between points so far apart, m, or nearer where the curvature
# changes: by so much in a metre, 1/m, an arc keeps within 1e-5 m of the line meant. Points nearer than
# LEAST_PART to one another are not told apart; behind its start the line runs on straight.
ARC_LENGTH, CHANGE, LEAST_PART, BEHIND = 2.0, 3e-3, 1e-3, 1.0


class CannotFollowError(BenchDragonError):
    """A dance in which some bench cannot follow the one before it."""

    exit_code = 4


@dataclass(frozen=True)
class Hint:
    """A place of the head by its distance from the walk's start, m, or from its end.

    The first `count` benches are those to be looked at.
    """

    after: float
    left: float
    count: int


@dataclass(frozen=True, order=True)
class Meeting:
    """Benches i < j (rows, from 0) so far apart, m (minus a depth), with the head at s, m."""

    distance: float
    s: float
    i: int
    j: int


@dataclass(frozen=True)
class RandomDance:
    """A dance to be searched.

    Attributes:
        dragon: the benches.
        rows: the line, as the kernels see it.
        aside: how far to the left of the line each handle walks, m; empty: on it.
        start: the head's first place along the line, m.
        end: its last.
        open: parts of the way, along the line, outside which no benches come as near as so many metres
            (see `open_parts`); None: the whole way whatever the distance.
    """

    dragon: Dragon
    rows: FloatArray
    aside: FloatArray
    start: float
    end: float
    open: Callable[[float], tuple[Part, ...]] | None = None

    def __post_init__(self) -> None:
        steps = self._count(self._whole, HINT_STEP)
        handles = len(self.dragon) + 1
        if handles * steps > MOST_PLACES or 0.5 * handles**2 * steps > MOST_PAIRS:
            raise InputError(_("the walk is too long, or the dragon, for random dances"))

    @property
    def _whole(self) -> Part:
        return Part(self.start, self.end, len(self.dragon))

    def _open(self, margin: float) -> tuple[Part, ...]:
        """Parts of the way outside which no benches come within a margin, m, or what counts as that."""
        return (self._whole,) if self.open is None else self.open(margin + 2.0 * GRAZE)

    def _count(self, part: Part, share: float) -> int:
        """How many head positions no farther apart than that share of the shortest link."""
        return 2 + int((part.end - part.start) / (share * float(self.dragon.links.min())))

    def _grid(self, part: Part, share: float) -> FloatArray:
        """These positions, m."""
        return np.linspace(part.start, part.end, self._count(part, share))

    def _leading(self, count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Links, offsets of handles, and sizes of the first benches."""
        sizes = np.ascontiguousarray(self.dragon.sizes[:, :count])
        return self.dragon.links[:count], self.aside[: count + 1], sizes

    def low_meeting(self, margin: float | None = None) -> Meeting:
        """Where benches come about nearest: evaluated here and there, then around the least.

        With a margin, m, only where some may come so near; where none can, near the end of the walk.

        Raises:
            CannotFollowError: where the dragon cannot stand.
        """
        last = Part(max(self.start, self.end - LAST), self.end, len(self.dragon))
        parts = (self._whole,) if margin is None else self._open(margin) or (last,)
        grids = [(self._grid(part, HINT_STEP), part.count) for part in parts]
        (_meeting, t), n = min((self.nearest(*grid), n) for n, grid in enumerate(grids))
        return self._lowest(grids[n][0][max(t - 1, 0) : t + 2], grids[n][1])

    def hint(self, meeting: Meeting) -> Hint:
        """The head's place, as told to a dance with another pitch."""
        return Hint(meeting.s - self.start, self.end - meeting.s, meeting.j + 1 + BEYOND)

    def meeting_near(self, hint: Hint) -> Meeting:
        """Where benches come about nearest around a place known from another pitch.

        Counted from the start and from the end: whichever is nearer to touching.

        Raises:
            CannotFollowError: where the dragon cannot stand.
        """
        around = AROUND * float(self.dragon.links.max())
        centres = np.clip([self.start + hint.after, self.end - hint.left], self.start, self.end)
        if abs(centres[1] - centres[0]) < 0.1 * around:
            centres = centres[:1]
        ends = [np.clip([s - around, s + around], self.start, self.end) for s in centres]
        return min(self._lowest(np.linspace(low, high, PARTS + 1), hint.count) for low, high in ends)

    def _lowest(self, at: FloatArray, count: int) -> Meeting:
        """The lowest meeting of the first benches with the head at these places, or about it."""
        best, t = self.nearest(at, count)
        for _shrink in range(SHRINKS):
            low, high = at[max(t - 1, 0)], at[min(t + 1, at.size - 1)]
            at = np.linspace(low, high, PARTS + 1)
            found, t = self.nearest(at, min(count, best.j + 1 + BEYOND))
            best = min(best, found)
        return best

    def nearest(self, at: FloatArray, count: int | None = None) -> tuple[Meeting, int]:
        """The nearest pair with the head at any of these places, m, in order, and at which.

        Of the first `count` benches, or of all.

        Raises:
            CannotFollowError: where the dragon cannot stand.
        """
        links, aside, sizes = self._leading(count or len(self.dragon))
        budget.hold(PLACED * (links.size + 1) * at.size)
        budget.spend((links.size + 1 + 0.5 * PAIR * links.size**2) * at.size)
        places = empty_placements(links.size + 1, at.size)
        stood = place_along(self.rows, links, aside, at, places)
        if stood < at.size:
            raise _stopped(float(at[stood]))
        distance, t, i, j = nearest_pair(sizes, places.x, places.y)
        return Meeting(float(distance), float(at[t]), i, j), t

    def touch(self, margin: float = 0.0) -> Meeting | None:
        """The first place at which benches come nearer than a margin, m, or all but; None if nowhere.

        None is missed, see kernels/search.py; a pair that comes within GRAZE of the margin may count.

        Raises:
            CannotFollowError: where the dragon cannot stand.
        """
        for part in self._open(margin):
            note = np.zeros(search.NOTES)
            if self._search(part, search.FIRST_TOUCH, margin, GRAZE, note) != search.CLEAR:
                i, j = divmod(int(note[search.PAIR]), part.count)
                return Meeting(margin, float(note[search.UPPER]), i, j)
        return None

    def least(self) -> float:
        """The least distance of non-adjacent benches, m; minus the depth of an overlap that was seen.

        No bench comes nearer by more than TOLERANCE, unless they overlap.

        Raises:
            CannotFollowError: where the dragon cannot stand.
        """
        hint = self.low_meeting().distance
        if hint <= 0.0:
            return hint
        note = np.zeros(search.NOTES)
        note[search.NEAREST], note[search.FLOOR] = hint, math.inf
        self._search(self._whole, search.LEAST, 0.0, TOLERANCE, note)
        return float(note[search.NEAREST])

    def _search(self, part: Part, goal: int, margin: float, slack: float, note: FloatArray) -> int:
        """Search a part of the walk: see `every_pair.search_all_pairs`."""
        at, partners, worst = self._grid(part, STEP), PARTNERS, search.CLEAR
        for n in range(0, at.size - 1, STEPS):
            some = at[n : n + STEPS + 1]
            while True:
                ending = self._search_steps(part.count, partners, some, (goal, margin, slack), note)
                if ending != CROWDED:
                    break
                partners *= 4
            if ending == search.FALLEN:
                raise _stopped(float(note[search.UPPER]))
            if ending != search.CLEAR and (ending != search.GRAZE or goal != search.LEAST):
                return ending
            worst = max(worst, ending)
        return worst

    def _search_steps(
        self,
        benches: int,
        partners: int,
        at: FloatArray,
        aim: tuple[int, float, float],
        note: FloatArray,
    ) -> int:
        """Search some steps of the head with room for so many pairs of a bench; how that ended.

        `aim` is what is sought, the margin and the slack, m. After CROWDED nothing is noted.
        """
        links, aside, sizes = self._leading(benches)
        pairs = min(partners * benches, benches * (benches - 1) // 2)
        budget.hold(8 * search.DEPTH * pairs)
        first, second = np.empty(pairs, dtype=np.int64), np.empty(pairs, dtype=np.int64)
        goal, margin, slack = aim
        most, found = min(MOST_EVALUATIONS, most_evaluations(benches + 1)), note.copy()
        ending = search_all_pairs(
            search.room(benches + 1, benches, pairs), goal, self.rows, links, aside, sizes, at,
            first, second, margin, slack, WIDTH, most, found,
        )  # fmt: skip
        chains = at.size + float(found[search.EVALUATIONS] - note[search.EVALUATIONS])
        budget.spend(SEARCHED * (benches + 1) * chains + 0.5 * PAIR * benches**2 * at.size)
        if ending != CROWDED:
            note[:] = found
        return ending


def _stopped(s: float) -> CannotFollowError:
    return CannotFollowError(
        _("with the head at {s} m or after a bench cannot follow").format(s=f"{s:.4g}")
    )


def strayed(
    route: Route, off: Offset, low: float, end: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A line that runs aside of a route, as rows of arcs: see kernels/curve.py.

    Args:
        route: the line that is drawn.
        off: how far to its left the line runs at route positions s, m, and its slope there.
        low: the first route position that is of interest, m.
        end: the last.

    Returns:
        The rows; and, in pairs, positions along the route and along the line, m.

    Raises:
        CannotFollowError: where the route does not go so far.
    """
    if end > route.length + END_SLACK:
        raise _stopped(route.length)
    at = _nodes(route, low, end)
    places = np.empty((at.size, 4))
    evaluate(route.rows, at, places)
    x, y, heading, bend = places.T
    aside, slope = off(at)
    p = x + 1j * y + aside * 1j * np.exp(1j * heading)
    turned = heading + np.arctan2(slope, 1.0 - aside * bend)
    rows = _biarcs(p, turned)
    along = np.append(rows[1::2, kernel.S_START], rows[-1, kernel.S_START] + rows[-1, kernel.LENGTH])
    return rows, at, along


def _nodes(route: Route, low: float, end: float) -> FloatArray:
    """Positions along a route between which arcs are fitted, joints among them, m."""
    low = low if route.extension else max(low, 0.0)
    budget.hold(NODE * (end - low) / (0.1 * ARC_LENGTH))
    budget.spend(NODE_WORK * (end - low) / (0.1 * ARC_LENGTH))
    joints = route.joints[1:-1]
    ends = np.concatenate([[low], joints[(joints > low + LEAST_PART) & (joints < end)], [end]])
    ends = np.delete(ends, 1 + np.flatnonzero(np.diff(ends[:-1]) < LEAST_PART))
    if ends[-1] - ends[-2] < LEAST_PART and ends.size > 2:
        ends = np.delete(ends, -2)
    parts = [np.array([low])]
    for a, b in pairwise(ends.tolist()):
        fine = np.linspace(a, b, 3 + int((b - a) / (0.1 * ARC_LENGTH)))
        places = np.empty((fine.size - 2, 4))
        evaluate(route.rows, fine[1:-1], places)
        change = np.abs(np.gradient(places[:, 3], fine[1:-1])) if fine.size > 4 else np.zeros(1)
        dense = np.maximum(1.0 / ARC_LENGTH, (change / CHANGE) ** (1.0 / 3.0)).mean()
        parts.append(np.linspace(a, b, 2 + int((b - a) * dense))[1:])
    return np.concatenate(parts)


def _biarcs(p: FloatArray, heading: FloatArray) -> FloatArray:
    """Rows of two arcs between each two points (complex, m), with these headings there, rad."""
    v, t = np.diff(p), np.exp(1j * heading)
    both, apart = t[:-1] + t[1:], t[:-1] - t[1:]
    along, size = (v * both.conj()).real, np.abs(v) ** 2
    d = size / (along + np.sqrt(along**2 + np.abs(apart) ** 2 * size))
    middle = 0.5 * (p[:-1] + p[1:] + d * apart)
    starts = np.column_stack([p[:-1], middle]).ravel()
    chords = np.column_stack([middle - p[:-1], p[1:] - middle]).ravel()
    first = np.angle(chords[::2] / t[:-1])
    second = np.angle(chords[1::2] / (t[:-1] * np.exp(2j * first)))
    half = np.column_stack([first, second]).ravel()
    rows = np.zeros((starts.size + 1, kernel.COLUMNS))
    rows[0, kernel.KIND], rows[1:, kernel.KIND] = kernel.LINE, kernel.ARC
    begin = starts[0] - BEHIND * t[0]
    rows[:, kernel.X] = np.append(begin.real, starts.real)
    rows[:, kernel.Y] = np.append(begin.imag, starts.imag)
    rows[0, kernel.ANGLE] = heading[0]
    rows[1::2, kernel.ANGLE], rows[2::2, kernel.ANGLE] = heading[:-1], heading[:-1] + 2.0 * first
    rows[1:, kernel.P] = 2.0 * np.sin(half) / np.abs(chords)
    rows[1:, kernel.LENGTH] = np.abs(chords) / np.sinc(half / np.pi)
    rows[0, kernel.LENGTH] = BEHIND
    rows[1:, kernel.S_START] = np.cumsum(rows[:-1, kernel.LENGTH])
    rows[:, kernel.U_END] = rows[:, kernel.LENGTH]
    rows[0, kernel.U_BACK] = -np.inf
    rows[:, kernel.AXIS_X] = np.cos(rows[:, kernel.ANGLE])
    rows[:, kernel.AXIS_Y] = np.sin(rows[:, kernel.ANGLE])
    rows.flags.writeable = False
    return rows
