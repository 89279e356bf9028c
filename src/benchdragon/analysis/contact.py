"""Contact over time: the first, all of them, and the least clearance of a walk.

How none is missed, see `contact_search`.
"""

import collections
import math
import time as clock
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from benchdragon import budget
from benchdragon.analysis.contact_search import ContactSearch, contact_search
from benchdragon.analysis.distance import low_pair, tightest_pairs
from benchdragon.budget import OverBudgetError
from benchdragon.errors import InputError, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import search as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.low_points import MOST_SAMPLED
from benchdragon.kernels.route import IntArray
from benchdragon.model.answer import Answer, Status
from benchdragon.model.walk import Motion, Walk
from benchdragon.progress import Progress, silent

# Grazes nearer than this to the end of a window, s, belong to it.
FRAYED = 1e-5
# The least distance of dragons that are not looked over is first guessed to be this, m, and the guess
# multiplied by so much until some pair comes nearer.
FIRST_REACH, WIDER = 0.003, 6.0
# Least clearances are bracketed to the first of these, m, that benches which keep one distance for a
# while allow.
TOLERANCES = (1e-12, 1e-8, 1e-5, 1e-3)
# What the first of these may take beside a question, as a share of its work, and each of the others:
# those are for benches that keep one distance, and a bracket is refined while that is cheap.
REFINING, REFINING_ON = 0.25, 0.05
# The least clearance of a dragon of one or two benches.
NONE = Answer(math.inf, math.inf, math.inf, "m", "found")
# Grazes that are looked past for a sure contact.
MOST_GRAZES = 100
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


@budget.question()
def contact_windows(
    walk: Walk,
    start: float,
    end: float,
    *,
    margin: float = 0.0,
    most: int = 1000,
    progress: Progress = silent,
) -> list[Window]:
    """All spans of time in start..end (s) in which two non-adjacent benches are nearer than margin.

    Never late and none left out, whatever the speed: what lies outside of all windows is clear by
    bounds. A window whose opening is "undecided" is a graze: there a pair comes within rounding of the
    margin. Stops after `most` windows.

    Raises:
        InputError: for a negative margin or an end before the start.
        WalkError: if the dragon cannot stand at some time, and no windows fill `most` before.
        UnsureError: if it could not be shown that it can.
    """
    return _windows(contact_search(walk, start, end, margin, progress, whole=True), most)


def _windows(search: ContactSearch, most: int, *, sure: bool = False) -> list[Window]:
    """The first windows that a search comes to, so many at most; if `sure`, none after one that is."""
    opened = _touching_at_start(search)
    windows = [] if opened is None else [Window(opened, None)]
    while len(windows) < most and not (sure and windows and windows[-1].opens.status == "found"):
        touching = bool(windows) and windows[-1].closes is None
        note = np.zeros(kernel.NOTES)
        ending = search.search(kernel.TOUCH_END if touching else kernel.FIRST_TOUCH, note)
        if ending == kernel.CLEAR:
            break
        status: Status = "found" if ending == kernel.FOUND else "undecided"
        lower, at = float(note[kernel.LOWER]), float(note[kernel.UPPER])
        found = search.answer_at(lower, at, status, *search.pair(note))
        _take_down(windows, found, touching=touching)
    return windows


def _take_down(windows: list[Window], found: Answer, *, touching: bool) -> None:
    """Add to `windows` what opens, closes or grazes."""
    if touching and found.status == "found":
        windows[-1] = Window(windows[-1].opens, found)
    elif not touching and found.status == "found":
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
    tightest = tightest_pairs(search.placement(search.start))
    if not tightest:
        return None
    i, j = (number - 1 for number in tightest[0].benches)
    off = search.off_at(search.start, i, j)
    if tightest[0].distance > search.margin - off:
        return None
    search.note_off(off)
    return search.answer_at(search.start, search.start, "found", i, j)


@budget.question()
def first_contact(
    walk: Walk,
    start: float,
    end: float,
    *,
    margin: float = 0.0,
    progress: Progress = silent,
) -> Answer | None:
    """The first time in start..end, s, at which two non-adjacent benches touch; None if never.

    With a margin (m), the first time at which two are nearer than that. The answer's bracket: all is
    clear up to `lower`, and at `upper` a pair surely touches.
    Status "undecided" means a graze within rounding in the bracket (and clear up to it).

    Raises:
        InputError: for a negative margin or an end before the start.
        WalkError: if no contact comes before a time at which the dragon cannot stand.
        UnsureError: if that could not be decided.
    """
    windows = _windows(contact_search(walk, start, end, margin, progress), 1)
    return windows[0].opens if windows else None


@budget.question()
def first_sure_contact(
    walk: Walk,
    start: float,
    end: float,
    *,
    margin: float,
    search: Callable[..., Answer | None] | None = None,
    progress: Progress = silent,
) -> Answer | None:
    """`first_contact`, or if that is a graze the first that is none, if there is one.

    `search` is asked in its place, such as its proof.

    Raises:
        InputError, WalkError, UnsureError: as `first_contact`, or as `search`.
    """
    first = (search or first_contact)(walk, start, end, margin=margin, progress=progress)
    if first is None or first.status != "undecided":
        return first
    windows = _windows(contact_search(walk, start, end, margin, silent), MOST_GRAZES, sure=True)
    return next((window.opens for window in windows if window.opens.status == "found"), first)


@budget.question()
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

    0 where benches overlap; infinite for a dragon of one or two benches. The bracket is as wide as the
    first of `tolerances`, m, or where benches keep one distance for a while as one of the others, or
    wider yet where that takes too much work. Nothing beyond `within` metres is looked for: if none is
    nearer the upper end is infinite, and the lower one that less the tolerance.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at some time.
        UnsureError: if that could not be decided.
    """
    search = contact_search(walk, start, end, 0.0, progress)
    if len(walk.dragon) < 3:
        return NONE
    return _least(search, _guess(search), within, tolerances)


@budget.question()
def seen_clearance(walk: Walk, start: float, end: float, floor: float) -> Answer:
    """The least clearance, m, as it is seen here and there from start to end (s): no search is made.

    No benches come nearer than `floor`, m, as far as is known: the lower end of the bracket.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at the start.
    """
    search = contact_search(walk, start, end, 0.0, silent)
    if len(walk.dragon) < 3:
        return NONE
    best = _guess(search)
    return _clearance_answer(search, replace(best, floor=min(floor, best.distance)))


def _least(search: ContactSearch, best: Best, within: float, tolerances: Sequence[float]) -> Answer:
    """The least clearance, some distance being known: see `least_clearance`."""
    if search.start == search.end:
        return _clearance_answer(search, best)
    reach = best.distance if len(search.walk.dragon) <= MOST_SAMPLED else FIRST_REACH
    if not best.distance:
        search.begin(0.0)
        collections.deque(search.steps(), maxlen=0)  # whether the dragon can walk all the way
    while best.distance > 0.0:
        reach = min(reach, best.distance, within)
        search.begin(reach)
        if len(search.walk.dragon) > MOST_SAMPLED:  # seen at the start alone
            best, _closed = _lowered(search, best, reach, math.inf)
        best = _bracketed(search, best, reach, tolerances)
        if best.distance <= reach:
            break
        if reach >= within:
            return Answer(
                math.inf, best.floor, math.inf, "m", "found", None, search.assumed(), search.evaluations
            )
        reach *= WIDER
    return _clearance_answer(search, best)


def _guess(search: ContactSearch) -> Best:
    """A low distance, looked for here and there, so that what is farther need not be searched."""
    dragon = search.walk.dragon
    still = search.start == search.end
    if still or len(dragon) > MOST_SAMPLED:
        nearest = tightest_pairs(search.placement(search.start))[0]
        i, j = (number - 1 for number in nearest.benches)
        apart = max(nearest.distance, 0.0)
        return Best(apart, search.start, (i, j), apart if still else 0.0)
    distance, where, i, j = min(low_pair(search.walk, *span) for span in search.spans)
    return Best(max(distance, 0.0), where, (i, j))


@contextmanager
def refined(n: int) -> Iterator[None]:
    """Refine a bracket to the tolerance of number n: given up, without a word, where it is too dear."""
    with suppress(OverBudgetError), budget.aside(REFINING_ON if n else REFINING):
        yield


def _bracketed(search: ContactSearch, best: Best, reach: float, tolerances: Sequence[float]) -> Best:
    """`best`, or what is lower within `reach`, bracketed as the first tolerance that can be says.

    What is too dear is given up. A last pass, of whatever width, sees the rest of the walk.
    """
    for n, tolerance in enumerate(tolerances):
        search.again()
        with refined(n):
            best, closed = _lowered(search, best, min(reach, best.distance), tolerance)
            if closed:
                return best
    search.again()
    return _lowered(search, best, min(reach, best.distance), math.inf)[0]


def _lowered(search: ContactSearch, best: Best, reach: float, tolerance: float) -> tuple[Best, bool]:
    """`best`, or what is lower within `reach` from here on, and whether its floor was found."""
    note = np.zeros(kernel.NOTES)
    note[kernel.NEAREST], note[kernel.FLOOR] = reach, math.inf
    closed = search.search(kernel.LEAST, note, tolerance) == kernel.CLEAR
    if note[kernel.NEAREST] < reach:
        nearest = max(float(note[kernel.NEAREST]), 0.0)
        best = Best(nearest, float(note[kernel.UPPER]), search.pair(note))
    floor = max(min(float(note[kernel.FLOOR]), float(note[kernel.NEAREST]) - tolerance), 0.0)
    return replace(best, floor=floor if closed else 0.0), closed or best.distance == 0.0


def _clearance_answer(search: ContactSearch, best: Best) -> Answer:
    seconds = clock.perf_counter() - search.began
    search.note_off(search.off_at(best.where, *best.pair))
    off = search.off
    lower = max(best.floor - off, 0.0)
    witness = search.witness(best.where, *best.pair)
    upper = upper_end(best.distance or witness.gap, off)
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


def upper_end(gap: float, off: float) -> float:
    """The most that bodies are apart whose distance, or minus their depth, may be off by `off`; all m.

    A gap by the separating axis theorem, as a depth is, may be less than their distance: by sqrt(2).
    """
    return gap + off if gap > 0.0 else max(gap + math.sqrt(2.0) * off, 0.0)


@budget.question()
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
    search = contact_search(walk, float(at[0]), float(at[-1]), 0.0, silent, whole=True)
    inner = inner[clearance[inner] > 0.0]
    search.begin(float(clearance[inner].max(initial=0.0)))
    minima = [_local_minimum(search, motion, int(i), float(clearance[i])) for i in inner]
    return ClearanceCurve(at, clearance, np.array([near.benches for near in tightest]), minima)


def _local_minimum(search: ContactSearch, motion: Motion, i: int, clearance: float) -> Answer:
    """The least clearance between the times beside number i, where it is `clearance`, m."""
    near = tightest_pairs(motion, i)[0].benches
    best = Best(clearance, float(motion.head_s[i]), (near[0] - 1, near[1] - 1))
    search.tables.go(float(motion.head_s[i - 1]), float(motion.head_s[i + 1]))
    return _clearance_answer(search, _bracketed(search, best, best.distance, TOLERANCES))
