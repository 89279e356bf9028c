"""Contact over time: the first, all of them, and the least clearance of a walk.

`contact_search` explains why no contact is missed.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.contact_search import (
    REFINING,
    REFINING_ON,
    TOLERANCES,
    ContactSearch,
    contact_search,
)
from benchdragon.analysis.distance import tightest_pairs
from benchdragon.budget import OverBudgetError
from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.contact_memory import ContactEnding, ContactGoal, ContactTold
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.time_of_impact import Ending, Goal
from benchdragon.methods import Method
from benchdragon.model.answer import Answer
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent

if TYPE_CHECKING:
    from benchdragon.figures import plots

# Grazes nearer than this to the end of a window, s, belong to it.
FRAYED = 1e-5
# The least clearance of a dragon of one or two benches.
NONE = Answer(math.inf, math.inf, math.inf, "m", "found")
# Number of grazes that are skipped to reach a sure contact.
MOST_GRAZES = 100
# Samples of a clearance curve: each takes a millisecond for 223 benches.
MOST_SAMPLES, USUAL_SAMPLES = 1_000_000, 301

# Seeks a first contact, as `first_contact` does: of a walk, from start to end, s, within a margin, m.
Search = Callable[[Walk, float, float, float, Progress], Answer | None]


@dataclass(frozen=True)
class Window:
    """A span of time through which some pair of benches touches (or is nearer than the margin).

    Attributes:
        opens: when it begins; status "undecided" for a graze within rounding.
        closes: when it ends; None if it lasts to the end of what was searched.

    Examples:
        >>> (window,) = bd.read_plan("spiral-in").contact_windows(405.0, 408.0, margin=0.003)
        >>> round(window.opens.value, 3), round(window.closes.value, 3)
        (406.773, 406.92)
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

    Examples:
        >>> curve = bd.read_plan("spiral-in").clearance_curve(np.arange(0.0, 301.0, 100.0))
        >>> curve.clearance.round(4)
        array([0.1693, 0.1579, 0.165 , 0.1207])
    """

    times: FloatArray
    clearance: FloatArray
    benches: IntArray
    minima: list[Answer]

    plot = plots.plot_clearance if TYPE_CHECKING else Method("plot_clearance")


@budget.question()
def contact_windows(
    walk: Walk | Plan, start: float | None = None, end: float | None = None, *,
    margin: float = 0.0, most: int = 1000, progress: Progress = silent,
) -> list[Window]:  # fmt: skip
    """All spans of time in start..end (s) in which two non-adjacent benches are nearer than margin.

    Of a plan or a walk: over the whole of it unless start and end are given.

    Never late and none left out, whatever the speed: what lies outside of all windows is clear by
    bounds. A window whose opening is "undecided" is a graze: there a pair comes within rounding of the
    margin. Stops after `most` windows.

    Raises:
        InputError: for a negative margin or an end before the start.
        WalkError: if the dragon cannot stand at some time, and no windows fill `most` before.
        UnsureError: if it could not be shown that it can.

    Examples:
        >>> windows = bd.contact_windows(bd.read_plan("spiral-in"), 400.0, 413.0)
        >>> round(windows[0].opens.value, 6), windows[0].closes
        (412.473838, None)
    """
    walk, start, end = asked_of(walk, start, end)
    with contact_search(walk, start, end, margin, progress, whole=True) as search:
        return _windows(search, most)


def _windows(search: ContactSearch, most: int, *, sure: bool = False) -> list[Window]:
    """The first windows that a search comes to, so many at most; if `sure`, none after one that is."""
    windows: list[Window] = []
    while len(windows) < most and not (sure and windows and windows[-1].opens.status == "found"):
        touching = bool(windows) and windows[-1].closes is None
        ending = search.find(Goal.TOUCH_END if touching else Goal.FIRST_TOUCH)
        if ending == Ending.CLEAR:
            break
        found = search.moment("found" if ending == Ending.FOUND else "undecided")
        _take_down(windows, found, touching=touching)
    return windows


def _take_down(windows: list[Window], found: Answer, *, touching: bool) -> None:
    """Add an opening, a closing or a graze to `windows`."""
    if touching and found.status == "found":
        windows[-1] = Window(windows[-1].opens, found)
    elif not touching and found.status == "found":
        windows.append(Window(found, None))
    elif not touching and windows and _belongs(windows[-1], found):
        windows[-1] = _widened(windows[-1], found)
    elif not touching:
        windows.append(Window(found, found))


def _belongs(window: Window, graze: Answer) -> bool:
    """Whether a graze belongs to the end of a window just closed."""
    return window.closes is not None and graze.lower - window.closes.upper <= FRAYED


def _widened(window: Window, graze: Answer) -> Window:
    """A window with a graze joined to its end; still a graze if it was one."""
    if window.opens.status == "undecided":
        opens = replace(window.opens, upper=graze.upper)
        return Window(opens, opens)
    return Window(
        window.opens, None if window.closes is None else replace(window.closes, upper=graze.upper)
    )


@budget.question()
def first_contact(
    walk: Walk | Plan, start: float | None = None, end: float | None = None, *,
    margin: float = 0.0, progress: Progress = silent,
) -> Answer | None:  # fmt: skip
    """The first time in start..end, s, at which two non-adjacent benches touch; None if never.

    Of a plan or a walk: over the whole of it unless start and end are given. With a margin (m), the
    first time at which two are nearer than that. The answer's bracket: all is clear up to `lower`, and
    at `upper` a pair surely touches. Status "undecided" means a graze within rounding in the bracket
    (and clear up to it).

    Raises:
        InputError: for a negative margin or an end before the start.
        WalkError: if no contact comes before a time at which the dragon cannot stand.
        UnsureError: if that could not be decided.

    Examples:
        >>> contact = bd.first_contact(bd.read_plan("spiral-in"))
        >>> round(contact.value, 9), contact.witness.benches
        (412.473837682, (1, 9))
    """
    walk, start, end = asked_of(walk, start, end)
    with contact_search(walk, start, end, margin, progress) as search:
        windows = _windows(search, 1)
    return windows[0].opens if windows else None


@budget.question()
def first_sure_contact(
    walk: Walk, start: float, end: float, *, margin: float, search: Search | None = None,
    progress: Progress = silent,
) -> Answer | None:  # fmt: skip
    """`first_contact`, or if that is a graze the first that is none, if there is one.

    `search` is asked in its place, such as its proof.

    Raises:
        InputError, WalkError, UnsureError: as `first_contact`, or as `search`.
    """
    if search is None:
        first = first_contact(walk, start, end, margin=margin, progress=progress)
    else:
        first = search(walk, start, end, margin, progress)
    if first is None or first.status != "undecided":
        return first
    with contact_search(walk, start, end, margin, silent) as again:
        windows = _windows(again, MOST_GRAZES, sure=True)
    return next((window.opens for window in windows if window.opens.status == "found"), first)


@budget.question()
def least_clearance(
    walk: Walk | Plan, start: float | None = None, end: float | None = None, *,
    within: float = math.inf, tolerances: Sequence[float] = TOLERANCES, progress: Progress = silent,
) -> Answer:  # fmt: skip
    """The least clearance, m, of any two non-adjacent benches from start to end (s).

    Of a plan or a walk: over the whole of it unless start and end are given. 0 where benches overlap;
    infinite for a dragon of one or two benches. The bracket is as wide as the first of `tolerances`, m,
    or where benches keep one distance for a while as one of the others, or wider yet where that takes
    too much work. Nothing beyond `within` metres is searched: if no pair is nearer, the upper end is
    infinite, and the lower one `within` less the tolerance.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at some time.
        UnsureError: if that could not be decided.

    Examples:
        >>> near = bd.least_clearance(bd.read_plan("spiral-in"), 405.0, 408.0)
        >>> round(1000.0 * near.value, 4), near.witness.benches
        (2.9573, (1, 10))
    """
    walk, start, end = asked_of(walk, start, end)
    with contact_search(walk, start, end, 0.0, progress, tolerances=tolerances) as search:
        if len(walk.dragon) < 3:
            return NONE
        if search.find(Goal.LEAST, (within,)) == ContactEnding.FARTHER:
            bracket = math.inf, float(search.figures[ContactTold.FLOOR_AT]), math.inf
            return search.answer(bracket, "m", "found", False)
        return _clearance(search)


@budget.question()
def seen_clearance(walk: Walk, start: float, end: float, floor: float) -> Answer:
    """The least clearance, m, at samples from start to end, s, without a search.

    No benches come nearer than `floor`, m, as far as is known: the lower end of the bracket.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at the start.
    """
    with contact_search(walk, start, end, 0.0, silent) as search:
        if len(walk.dragon) < 3:
            return NONE
        search.find(ContactGoal.SEEN)
        return _clearance(search, floor)


@contextmanager
def refined(n: int) -> Iterator[None]:
    """Refine a bracket to tolerance number n; keep it as it is where that would cost too much."""
    with suppress(OverBudgetError), budget.aside(REFINING_ON if n else REFINING):
        yield


def _clearance(search: ContactSearch, floor: float | None = None) -> Answer:
    """The least clearance as it was found, or above what is known from elsewhere, m."""
    best = float(search.figures[ContactTold.BEST])
    least = float(search.figures[ContactTold.FLOOR_AT]) if floor is None else min(floor, best)
    upper = upper_end(best or search.witness().gap, search.off)
    return search.answer((best, max(least - search.off, 0.0), upper), "m", "found")


def upper_end(gap: float, off: float) -> float:
    """Upper bound of the distance of two bodies, m, whose computed distance or depth is off by `off`.

    A gap by the separating axis theorem, as a depth is, may be less than their distance: by sqrt(2).
    """
    return gap + off if gap > 0.0 else max(gap + math.sqrt(2.0) * off, 0.0)


@budget.question()
def clearance_curve(walk: Walk | Plan, times: npt.ArrayLike | None = None) -> ClearanceCurve:
    """Clearance at increasing `times` (s, T of them, at least 3), and its local minima between them.

    Of a plan or a walk: at 301 times over the whole of it unless `times` are given. A minimum narrower
    than the distance of two times can be missed; `least_clearance` misses none.

    Raises:
        InputError: for fewer than 3 times, too many, or times that do not increase.
        WalkError: if the dragon cannot stand at some time.

    Examples:
        >>> plan = bd.read_plan("turn", {"dragon.benches": 20, "walk.end": 20.0})
        >>> curve = bd.clearance_curve(plan)
        >>> curve.times.shape, curve.benches.shape
        ((301,), (301, 2))
    """
    known = None if times is None else 0.0
    walk, start, end = asked_of(walk, known, known)
    motion = walk.motion(np.linspace(start, end, USUAL_SAMPLES) if times is None else times)
    at = motion.times
    if not 3 <= len(at) <= MOST_SAMPLES or not (np.diff(at) > 0.0).all():
        text = _("a clearance curve needs 3 to {most} times that increase")
        raise InputError(text.format(most=MOST_SAMPLES))
    if len(walk.dragon) < 3:
        raise InputError(_("a dragon of one or two benches has no pair whose clearance counts"))
    tightest = [tightest_pairs(motion, i)[0] for i in range(len(at))]
    clearance = np.array([near.distance for near in tightest])
    inner = np.flatnonzero((clearance[1:-1] <= clearance[:-2]) & (clearance[1:-1] < clearance[2:])) + 1
    inner = inner[clearance[inner] > 0.0]
    within = float(clearance[inner].max(initial=0.0))
    minima = list[Answer]()
    with contact_search(walk, float(at[0]), float(at[-1]), 0.0, silent, whole=True) as search:
        for i in inner.tolist():
            about = motion.head_s[[i - 1, i + 1]].tolist(), float(clearance[i]), float(motion.head_s[i])
            first, second = (number - 1 for number in tightest[i].benches)
            search.find(ContactGoal.BETWEEN, (within, *about[0], *about[1:], first, second))
            minima.append(_clearance(search))
    return ClearanceCurve(at, clearance, np.array([near.benches for near in tightest]), minima)
