"""Contact over time: the first, all of them, and the least clearance of a walk.

Time enters through the head's route position alone, so that all searches run over that and hold for
any speed. No bench is assumed clear because it was looked at: what is passed over is clear by a bound
that holds in between (kernels/pair_bounds.py, design/first_contact.py).
"""

import collections
import math
import time as clock
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from benchdragon.analysis.distance import boxes, low_pair, nearness, pairs_within, tightest_pairs
from benchdragon.analysis.regions import PARTS, PLACES, BroadPhase, Ledger, Step
from benchdragon.errors import InputError, UnsureError, in_order, not_negative, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import search as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import END_SLACK, IntArray
from benchdragon.model.answer import Answer, Status, Witness
from benchdragon.model.placement import Placement
from benchdragon.model.walk import Motion, Walk
from benchdragon.progress import Progress, silent

# What computed distances may be off by, m: a few dozen roundings of coordinates of 50 m; farther out
# it grows with them. A smaller one could call a graze clear, a larger one widens brackets.
SLACK = 1e-13
SLACK_REACH = 50.0
# Parts of a step narrower than this, m, or than this many roundings of the head's position, are not
# halved: contact times get no sharper.
WIDTH, WIDTH_ROUNDINGS = 1e-13, 4.0
# Grazes nearer than this to the end of a window, s, belong to it.
FRAYED = 1e-5
# Chains marched in one step of a search; a graze takes some hundred.
MOST_EVALUATIONS = 200_000
# Chains that a proof may log in one step: 30 MB for 223 benches.
LOG = 4096
# In dragons of at most so many benches low distances are looked for before bounds are sought; of longer
# ones the first guess, m, is multiplied by so much until some pair comes nearer.
MOST_SAMPLED, FIRST_REACH, WIDER = 5_000, 0.003, 6.0
# Least clearances are bracketed to the last of these, m. The ones before only bring the least value
# seen near enough for most steps to be passed over at once: 25,000 -> 2,000 evaluations.
TOLERANCES = (math.inf, 1e-5, 1e-8, 1e-12)
# Chains marched in one step for one of these; where benches keep the same distance for a while no
# number would do for the last.
MOST_LEAST_EVALUATIONS = 2000
# Places looked at for why a walk could not be followed.
SAMPLES_AHEAD = 65
# The head's way between what was searched and a failure, m: more, and it is not known what comes first.
UNKNOWN = 1e-6
# Samples of a clearance curve: each takes a millisecond for 223 benches.
MOST_SAMPLES = 1_000_000


@dataclass(frozen=True)
class Window:
    """A span of time through which some pair of benches touches (or is nearer than the margin).

    Attributes:
        opens: when it begins; status "undecided" for a graze that rounding leaves open.
        closes: when it ends; None if it lasts to the end of what was searched.
    """

    opens: Answer
    closes: Answer | None


@dataclass(frozen=True)
class ClearanceCurve:
    """Clearance over time, with its local minima.

    Attributes:
        times: s, (T,).
        clearance: of all pairs of non-adjacent benches, the least, m, (T,); negative: overlap.
        benches: the pair, (T, 2).
        minima: for each sample that is lower than those beside it, the least clearance between these.
    """

    times: FloatArray
    clearance: FloatArray
    benches: IntArray
    minima: list[Answer]


@dataclass(frozen=True)
class Best:
    """The least distance seen, m, at which head position, of which benches (rows, from 0).

    No pair is nearer than `floor`.
    """

    distance: float
    where: float
    pair: tuple[int, int]
    floor: float = 0.0


@dataclass
class ContactSearch:
    """A search along a walk from one head position to another."""

    walk: Walk
    start: float  # head positions, m
    end: float
    margin: float
    progress: Progress
    slack: float = 0.0
    ledger: Ledger | None = None
    since: float = -math.inf  # the time at which it begins, s
    evaluations: int = 0
    began: float = field(default_factory=clock.perf_counter)

    def __post_init__(self) -> None:
        placed = self.placement(self.start)
        extent = float(np.abs([placed.x, placed.y]).max())
        self.slack = self.slack or SLACK * max(1.0, extent / SLACK_REACH)
        self._room: kernel.Search | None = None
        self._shape = (0, 0, 0)

    def steps(self, reach: float) -> Iterator[Step]:
        """The steps in which pairs may come within `reach`, in order; what lies between is clear.

        Raises:
            WalkError: after the last of them, if the dragon cannot walk on to the end.
            UnsureError: likewise, if it could not be shown that it can.
        """
        walk = self.walk
        broad_phase = BroadPhase(walk.dragon, walk.route, reach + self.slack, self.start, self.ledger)
        end = min(self.end, walk.route.length)
        for done, upto in broad_phase.strides(self.start, end):
            known, sound = broad_phase.sound_until(done, upto)
            yield from broad_phase.steps(done, known)
            yield from self._small_steps(known, sound, broad_phase.reach, broad_phase.cell / PARTS)
            if sound < upto:
                raise self.stopped(sound, sound + 2.0 * broad_phase.cell)
            self.progress((upto - self.start) / (self.end - self.start), "")
        if self.end > end + END_SLACK:
            raise self.stopped(end, self.end)

    def _small_steps(self, start: float, end: float, reach: float, size: float) -> Iterator[Step]:
        """Steps of at most `size`, m, with all pairs that may come within reach by their travel."""
        grid = np.linspace(start, end, math.ceil((end - start) / size) + 1)
        per = max(1, PLACES // (len(self.walk.dragon) + 1))
        for n in range(0, len(grid) - 1, per):
            at = grid[n : n + per + 1]
            placed = self.placement(at)
            if placed.status.any():
                raise self.stopped(start, end)
            if self.ledger is not None:
                self.ledger.add_grid(placed)
            travel = self.walk.dragon.lever * np.diff(placed.s, axis=0).max(axis=1)
            for t in range(len(at) - 1):
                first, second = pairs_within(boxes(placed, t), reach + 2.0 * float(travel[t]))
                if len(first):
                    yield Step(float(at[t]), float(at[t + 1]), first, second)

    def stopped(self, sound: float, until: float) -> Exception:
        """Why the walk could not be followed past head position `sound`, looked for up to `until`."""
        # A bench may stand square to the route for a tenth of a millimetre only, and then leap.
        ahead = np.geomspace(UNKNOWN, max(min(until, self.end) - sound, UNKNOWN), SAMPLES_AHEAD)
        error = self.walk.first_failure(np.concatenate([[sound], sound + ahead]))
        if error is not None and error.head <= sound + 2.0 * UNKNOWN:
            return error
        return UnsureError(
            _("past t = {t} s it could not be shown that every bench follows without a leap").format(
                t=f"{self.time_at(sound):.6g}"
            )
        )

    def search_step(
        self, goal: int, step: Step, start: float, end: float, note: FloatArray, tolerance: float = 0.0
    ) -> int:
        """Run the kernel's search on part of a step; PAIR in `note` then counts pairs of the step.

        `tolerance` is that of LEAST, m.
        """
        members, inverse = np.unique(np.concatenate([step.first, step.second]), return_inverse=True)
        count = len(step.first)
        handles = int(members[-1]) + 2
        shape = (handles, len(members), count)
        if self._room is None or any(a > b for a, b in zip(shape, self._shape, strict=True)):
            wide, many, most = np.maximum(shape, self._shape).tolist()
            self._shape = (wide, many, most)
            self._room = kernel.room(*self._shape, 0 if self.ledger is None else LOG)
        dragon = self.walk.dragon
        width = max(WIDTH, WIDTH_ROUNDINGS * math.ulp(end))
        before = note[kernel.EVALUATIONS]
        chain = kernel.Chain(
            self.walk.route.rows, dragon.links[: handles - 1], np.empty(0), dragon.sizes, members
        )
        pairs = kernel.Pairs(inverse[:count], inverse[count:])
        most = MOST_LEAST_EVALUATIONS if tolerance else MOST_EVALUATIONS
        limits = kernel.Limits(self.margin, tolerance or self.slack, width, most)
        ending = kernel.search_step(self._room, goal, chain, pairs, start, end, limits, note)
        self.evaluations += int(note[kernel.EVALUATIONS] - before)
        if self.ledger is not None:
            count = int(self._room.logged[0])
            if count > LOG:
                raise UnsureError(_("a proof would need too many evaluations in one step"))
            self.ledger.add_log(self._room.log[:count], handles)
            self._room.logged[0] = 0
        return ending

    def placement(self, s: npt.ArrayLike) -> Placement:
        """The dragon with its head at s, whether it can stand there or not."""
        return self.walk.placement(s, throw=False)

    def witness(self, s: float, i: int, j: int) -> Witness:
        """How benches i and j (rows, from 0) stand with the head at s."""
        near = nearness(boxes(self.placement(s), 0), i, j)
        owner = near.features[0][0]
        point = near.points[near.benches.index(owner)]
        return Witness(self.time_at(s), s, near.benches, point, near.gap, near.features)

    def answer_at(self, lower: float, upper: float, status: Status, i: int, j: int) -> Answer:
        """A time between those at which the head is at lower and at upper, benches i and j meeting."""
        middle = 0.5 * (lower + upper)
        early, late = self._not_after(lower), self._not_before(upper)
        value = min(max(self.time_at(middle), early), late)
        seconds = clock.perf_counter() - self.began
        witness = self.witness(upper, i, j)
        return Answer(
            value, early, late, "s", status, witness, self.assumed(), self.evaluations, seconds
        )

    def assumed(self) -> tuple[str, ...]:
        """What answers rest on."""
        text = _("computed distances are within {slack} m of the exact ones")
        return (text.format(slack=f"{self.slack:.1e}"),)

    def time_at(self, s: float) -> float:
        """The first time of the search, s, at which the head stands at s."""
        return self.since if s <= self.start else max(self.walk.time_at(s), self.since)

    def _not_after(self, s: float) -> float:
        """A time at which the head has come no farther than s; not before the search begins."""
        t = self.time_at(s)
        step = math.ulp(t) if math.isfinite(t) else 0.0
        while t > self.since and self._lead(t, s) > 0:
            t, step = t - step, 2.0 * step
        return max(t, self.since)

    def _not_before(self, s: float) -> float:
        """A time at which the head has come at least as far as s."""
        t = self.time_at(s)
        step = math.ulp(t) if math.isfinite(t) else 0.0
        while s > self.start and t < math.inf and self._lead(t, s) < 0:
            t, step = t + step, 2.0 * step
        return t

    def _lead(self, t: float, s: float) -> float | Fraction:
        """How far past s the head stands at time t, m; not rounded, so that brackets are sure."""
        if math.isinf(t):
            return self.walk.start + float(self.walk.profile.distance(t)) - s
        return self.walk.exact_head_position(t) - Fraction(s)


def _contact_search(
    walk: Walk,
    start: float,
    end: float,
    margin: float,
    progress: Progress,
    slack: float = 0.0,
    ledger: Ledger | None = None,
) -> ContactSearch:
    of_kind("walk", walk, Walk)
    not_negative("margin", margin, "m")
    in_order(start, end)
    walk.motion([start])  # raises where the dragon cannot stand at the start
    a, b = walk.head_position([start, end]).tolist()
    return ContactSearch(walk, a, b, margin, progress, slack, ledger, start)


def contact_windows(
    walk: Walk,
    start: float,
    end: float,
    *,
    margin: float = 0.0,
    most: int = 1000,
    slack: float = 0.0,
    ledger: Ledger | None = None,
    progress: Progress = silent,
) -> list[Window]:
    """All spans of time in start..end (s) in which two non-adjacent benches are nearer than margin.

    Never late and none left out, whatever the speed: what lies outside of all windows is clear by
    bounds. A window whose opening is "undecided" is a graze: there a pair comes within rounding of the
    margin. Stops after `most` windows. `slack` is what computed distances may be off by, m (0: 1e-13,
    more far out), and `ledger` takes down all places that the answer rests on: see `proof`.

    Raises:
        InputError: for a negative margin or an end before the start.
        WalkError: if the dragon cannot stand at some time, and no windows fill `most` before.
        UnsureError: if it could not be shown that it can.
    """
    search = _contact_search(walk, start, end, margin, progress, slack, ledger)
    opened = _touching_at_start(search)
    windows = [] if opened is None else [Window(opened, None)]
    if len(windows) >= most:
        return windows
    for step in search.steps(margin):
        _search_step(search, step, windows, most)
        if len(windows) >= most:
            break
    return windows


def _search_step(search: ContactSearch, step: Step, windows: list[Window], most: int) -> None:
    """Add to `windows` what opens and closes in a step, until there are `most`."""
    at = step.start
    while at < step.end and len(windows) < most:
        touching = bool(windows) and windows[-1].closes is None
        note = np.zeros(kernel.NOTES)
        goal = kernel.TOUCH_END if touching else kernel.FIRST_TOUCH
        ending = search.search_step(goal, step, at, step.end, note)
        if ending == kernel.CLEAR:
            return
        if ending == kernel.FALLEN:
            raise search.stopped(float(note[kernel.LOWER]), step.end)
        lower, at, p = float(note[kernel.LOWER]), float(note[kernel.UPPER]), int(note[kernel.PAIR])
        status: Status = "found" if ending == kernel.FOUND else "undecided"
        found = search.answer_at(lower, at, status, int(step.first[p]), int(step.second[p]))
        if touching and status == "found":
            windows[-1] = Window(windows[-1].opens, found)
        elif not touching and status == "found":
            windows.append(Window(found, None))
        elif not touching and windows and _belongs(windows[-1], found):
            windows[-1] = _widened(windows[-1], found)
        elif not touching:
            windows.append(Window(found, found))


def _belongs(window: Window, graze: Answer) -> bool:
    """Whether a graze is but the frayed end of a window just closed."""
    return window.closes is not None and graze.lower - window.closes.upper <= FRAYED


def _widened(window: Window, graze: Answer) -> Window:
    """A window with a graze joined to its end; a graze itself if it was one."""
    if window.opens.status == "undecided":
        opens = replace(window.opens, upper=graze.upper)
        return Window(opens, opens)
    return Window(
        window.opens, None if window.closes is None else replace(window.closes, upper=graze.upper)
    )


def _touching_at_start(search: ContactSearch) -> Answer | None:
    """The contact in which a walk starts, if it does."""
    placed = search.placement(search.start)
    tightest = tightest_pairs(placed)
    if not tightest or tightest[0].distance > search.margin - search.slack:
        return None
    if search.ledger is not None:
        search.ledger.add_placement(placed)
    i, j = tightest[0].benches
    return search.answer_at(search.start, search.start, "found", i - 1, j - 1)


def first_contact(
    walk: Walk,
    start: float,
    end: float,
    *,
    margin: float = 0.0,
    slack: float = 0.0,
    progress: Progress = silent,
) -> Answer | None:
    """The first time in start..end, s, at which two non-adjacent benches touch; None if never.

    With a margin (m), the first time at which two are nearer than that. The answer's bracket: all is
    clear up to `lower`, and at `upper` a pair surely touches. `slack`, m, is what computed distances
    may be off by (0: 1e-13, more far out); it decides how narrow the bracket gets.
    Status "undecided" means a graze within rounding in the bracket (and clear up to it).

    Raises:
        InputError: for a negative margin or an end before the start.
        WalkError: if no contact comes before a time at which the dragon cannot stand.
        UnsureError: if that could not be decided.
    """
    windows = contact_windows(walk, start, end, margin=margin, most=1, slack=slack, progress=progress)
    return windows[0].opens if windows else None


def least_clearance(
    walk: Walk,
    start: float,
    end: float,
    *,
    within: float = math.inf,
    tolerances: Sequence[float] = TOLERANCES,
    progress: Progress = silent,
) -> Answer:
    """The least clearance, m, of any two non-adjacent benches from start to end (s).

    0 where benches overlap; infinite for a dragon of one or two benches. The bracket is 1e-12 m wide;
    wider, 1e-8 or 1e-5 m, where benches keep one distance for a while, or `tolerances` ends earlier.
    Nothing beyond `within` metres is looked for: then that is the lower end, the upper is infinite.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at some time.
        UnsureError: if that could not be decided.
    """
    search = _contact_search(walk, start, end, 0.0, progress)
    if len(walk.dragon) < 3:
        return Answer(math.inf, math.inf, math.inf, "m", "found")
    return _least(search, _guess(search), within, tolerances)


def clearance_above(
    walk: Walk,
    start: float,
    end: float,
    margin: float,
    *,
    tolerances: Sequence[float] = TOLERANCES,
) -> Answer | None:
    """The least clearance, m, if it surely exceeds the margin, m; None, soon, if it may not.

    Raises:
        InputError: for a negative margin or an end before the start.
        WalkError: if the dragon cannot stand at some time, and no low distance was met before.
        UnsureError: if that could not be decided.
    """
    search = _contact_search(walk, start, end, margin, silent)
    if len(walk.dragon) < 3:
        return Answer(math.inf, math.inf, math.inf, "m", "found")
    best = _guess(search)
    if best.distance <= margin:
        return None
    found = _least(search, best, math.inf, tolerances)
    return found if found.lower > margin else None


def _least(search: ContactSearch, best: Best, within: float, tolerances: Sequence[float]) -> Answer:
    """The least clearance, some distance being known: see `least_clearance`."""
    reach = best.distance if len(search.walk.dragon) <= MOST_SAMPLED else FIRST_REACH
    if not best.distance:
        collections.deque(search.steps(0.0), maxlen=0)  # whether the dragon can walk all the way
    while best.distance > 0.0:
        reach = min(reach, best.distance, within)
        steps = list(search.steps(reach))
        for tolerance in tolerances:
            best = _lowered(search, steps, best, min(reach, best.distance), tolerance)
        if best.distance <= reach:
            break
        if reach >= within:
            return Answer(
                math.inf, within, math.inf, "m", "found", None, search.assumed(), search.evaluations
            )
        reach *= WIDER
    return _clearance_answer(search, best)


def _guess(search: ContactSearch) -> Best:
    """A low distance, looked for here and there, so that what is farther need not be searched."""
    dragon = search.walk.dragon
    if len(dragon) > MOST_SAMPLED:
        nearest = tightest_pairs(search.placement(search.start))[0]
        return Best(
            max(nearest.distance, 0.0), search.start, (nearest.benches[0] - 1, nearest.benches[1] - 1)
        )
    distance, where, i, j = low_pair(search.walk, search.start, search.end)
    return Best(max(distance, 0.0), where, (i, j))


def _lowered(
    search: ContactSearch, steps: Sequence[Step], best: Best, reach: float, tolerance: float
) -> Best:
    """`best`, or what is lower in the steps, which hold all pairs within `reach`."""
    known, note = best, np.zeros(kernel.NOTES)
    note[kernel.NEAREST], note[kernel.FLOOR] = reach, math.inf
    for step in steps:
        before = note[kernel.NEAREST]
        ending = search.search_step(kernel.LEAST, step, step.start, step.end, note, tolerance)
        if ending == kernel.FALLEN:
            raise search.stopped(float(note[kernel.LOWER]), step.end)
        if note[kernel.NEAREST] < before:
            p = int(note[kernel.PAIR])
            best = Best(
                max(float(note[kernel.NEAREST]), 0.0),
                float(note[kernel.UPPER]),
                (int(step.first[p]), int(step.second[p])),
                known.floor,
            )
        if ending == kernel.FOUND:
            return best
        if ending == kernel.GRAZE:
            return replace(best, floor=known.floor)
    return replace(best, floor=min(float(note[kernel.FLOOR]), float(note[kernel.NEAREST]) - tolerance))


def _clearance_answer(search: ContactSearch, best: Best) -> Answer:
    seconds = clock.perf_counter() - search.began
    lower = max(best.floor - search.slack, 0.0)
    upper = best.distance + search.slack if best.distance else 0.0
    witness = search.witness(best.where, *best.pair)
    return Answer(
        best.distance,
        lower,
        upper,
        "m",
        "found",
        witness,
        search.assumed(),
        search.evaluations,
        seconds,
    )


def clearance_curve(walk: Walk, times: npt.ArrayLike) -> ClearanceCurve:
    """Clearance at increasing `times` (s, T of them, at least 3), and its local minima between them.

    A minimum narrower than the distance of two times can be missed; `least_clearance` misses none.

    Raises:
        InputError: for fewer than 3 times, too many, or times that do not increase.
        WalkError: if the dragon cannot stand at some time.
    """
    of_kind("walk", walk, Walk)
    motion = walk.motion(times)
    at = motion.times
    if not 3 <= len(at) <= MOST_SAMPLES or not (np.diff(at) > 0.0).all():
        raise InputError(
            _("a clearance curve needs 3 to {most} times that increase").format(most=MOST_SAMPLES)
        )
    if len(walk.dragon) < 3:
        raise InputError(_("a dragon of one or two benches has no pair whose clearance counts"))
    tightest = [tightest_pairs(motion, i)[0] for i in range(len(at))]
    clearance = np.array([near.distance for near in tightest])
    inner = np.flatnonzero((clearance[1:-1] <= clearance[:-2]) & (clearance[1:-1] < clearance[2:])) + 1
    search = _contact_search(walk, float(at[0]), float(at[-1]), 0.0, silent)
    minima = [_local_minimum(search, motion, int(i), clearance) for i in inner if clearance[i] > 0.0]
    return ClearanceCurve(at, clearance, np.array([near.benches for near in tightest]), minima)


def _local_minimum(search: ContactSearch, motion: Motion, i: int, clearance: FloatArray) -> Answer:
    """The least clearance between the times beside number i."""
    start, end = float(motion.head_s[i - 1]), float(motion.head_s[i + 1])
    moved = motion.walk.dragon.lever * float(np.abs(np.diff(motion.s[i - 1 : i + 2], axis=0)).max())
    first, second = pairs_within(boxes(motion, i), float(clearance[i]) + 2.0 * moved)
    near = tightest_pairs(motion, i)[0].benches
    best = Best(float(clearance[i]), float(motion.head_s[i]), (near[0] - 1, near[1] - 1))
    steps = [Step(start, end, first, second)]
    for tolerance in TOLERANCES:
        best = _lowered(search, steps, best, best.distance, tolerance)
    return _clearance_answer(search, best)
