"""The walk of each bench: its start, its turns, its speeds, and the bench that comes nearest."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from benchdragon import budget
from benchdragon.analysis.bends import Bends, Turning, turning_of
from benchdragon.errors import InputError, brief, in_order, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import bench_nearness as nearness
from benchdragon.kernels import bench_walks as kernel
from benchdragon.kernels.bench_nearness import REACH
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.spiral import LANES
from benchdragon.model.dragon import Dragon
from benchdragon.model.placement import Placement
from benchdragon.model.walk import SLICE_PLACES, Motion, Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, part, silent

Pace = Literal["wait", "walk", "hurry", "run"]
PACES: tuple[Pace, ...] = ("wait", "walk", "hurry", "run")
Side = Literal["left", "right", "front", "rear"]
# In the order of kernels/bench_nearness.py.
SIDES: tuple[Side, ...] = ("left", "right", "front", "rear")

# A handle slower than this, m/s, waits.
STILL = 0.05
# Time step at which all benches are sampled, s; larger where benches x samples would exceed the limit.
STEP = 0.125
MOST_LOOKED = 20_000_000

__all__ = ["BenchWalk", "Pace", "Side", "Stretch", "Tightest", "Turning", "bench_walks"]


@dataclass(frozen=True)
class Stretch:
    """A time in which a bench keeps turning one way at one pace.

    Attributes:
        start: s.
        end: s.
        turning: to which side its front handle's route bends.
        pace: of its front handle.
        way: how far that handle goes, m.
        angle: by how much the route turns under that handle, rad, left positive.
        speeds: the least and the greatest of that handle seen, m/s.
    """

    start: float
    end: float
    turning: Turning
    pace: Pace
    way: float
    angle: float
    speeds: tuple[float, float]


@dataclass(frozen=True)
class Tightest:
    """When a bench of another coil comes nearest: one that is farther away than STRAIGHT in a line.

    Attributes:
        time: s.
        bench: number of the other.
        side: on which side of this bench it then is.
        lower: no such bench comes nearer than this at any time, m.
        upper: so near that one is then, m.
        place: where this bench's front handle then is, m.
    """

    time: float
    bench: int
    side: Side
    lower: float
    upper: float
    place: tuple[float, float]


@dataclass(frozen=True)
class BenchWalk:
    """The walk of one bench.

    Attributes:
        bench: its number, from 1, the head's.
        place: where its front handle is when the dance starts, m.
        heading: of the bench then, rad.
        box: its rectangle then, a row of kernels/box.py.
        stretches: one after another, from the start of the dance to its end.
        tightest: None where no bench of another coil comes within the distance searched.
        before: number of the bench before it; None for the head.
        behind: number of the bench behind it; None for the tail.
        left: number of the bench on its left at the end; None where none is near.
        right: the same on its right.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 5, "walk.end": 10.0})
        >>> first, *others = plan.bench_walks()
        >>> first.bench, first.behind
        (1, 2)
    """

    bench: int
    place: tuple[float, float]
    heading: float
    box: tuple[float, ...]
    stretches: tuple[Stretch, ...]
    tightest: Tightest | None
    before: int | None
    behind: int | None
    left: int | None = None
    right: int | None = None


@budget.question()
def bench_walks(
    plan: Plan, walk: Walk | None = None, span: tuple[float, float] | None = None, *,
    apart: float = 0.0, progress: Progress = silent,
) -> tuple[BenchWalk, ...]:  # fmt: skip
    """What each bench of a plan's walk does over a span, s, the head's first.

    The walk, if it is not built yet, and the whole span are the plan's unless given. Turnings change
    where the front handle passes a place at which the route changes its side, paces where its speed
    passes STILL, `people.hurry_from` and `people.run_from` between times STEP apart: both to
    `kernels.bench_walks.TIME_TOLERANCE` seconds. A threshold that is crossed and crossed back between
    two samples is missed. Stretches shorter than SHORTEST are joined to a neighbour. `apart`, m, is
    what no two benches that are not neighbours come nearer than, if that is known: see `Tightest` for
    what is established without.

    Raises:
        InputError: if `plan` is not a Plan, or the end comes before the start.
        WalkError: if the dragon cannot stand at some time.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 5, "walk.end": 10.0})
        >>> len(bd.bench_walks(plan))
        5
    """
    of_kind("plan", plan, Plan)
    walk = plan.build() if walk is None else walk
    of_kind("walk", walk, Walk)
    start, end = _span(plan.span(walk) if span is None else span)
    times, bends = _times(walk, start, end), Bends.of(walk.route)
    rows, dragon = walk.route.rows, walk.dragon
    line = kernel.Line(rows, dragon.links, dragon.sizes, bends.at, bends.sides, _gates(plan))
    known = _seen(walk, line, times, part(progress, 0.0, 0.8))
    stretches = _stretches(bends, line, end, known)
    nearest = _nearest(walk, line, times, apart, known, part(progress, 0.8, 1.0))
    tightest = [_tightest(walk, times, row) for row in nearest]
    (at, boxes, _sides), (_at, _boxes, sides) = (
        _stood(dragon, *_handles(walk, time)) for time in (start, end)
    )
    count = len(dragon)
    return tuple(
        BenchWalk(
            k + 1, at[k], math.atan2(at[k][1] - at[k + 1][1], at[k][0] - at[k + 1][0]),
            tuple(boxes[k]), tuple(stretches[k]), tightest[k], k or None,
            k + 2 if k + 1 < count else None, *sides[k],
        )
        for k in range(count)
    )  # fmt: skip


def _span(span: tuple[float, float]) -> tuple[float, float]:
    """Start and end, s, if they are two times in order."""
    try:
        start, end = span
    except (TypeError, ValueError):
        text = _("span must be a pair of times, not {value}")
        raise InputError(text.format(value=brief(span))) from None
    in_order(start, end)
    return start, end


def _gates(plan: Plan) -> FloatArray:
    """Speeds from which the next pace begins, m/s, (3,), ascending."""
    run = max(plan.people.run_from, STILL)
    return np.array([STILL, min(max(plan.people.hurry_from, STILL), run), run])


def _times(walk: Walk, start: float, end: float) -> FloatArray:
    """Times from start to end, s, STEP apart or more, and those at which the head's speed bends."""
    count = min(math.ceil((end - start) / STEP), max(MOST_LOOKED // len(walk.dragon), 2))
    knots = [time for time in walk.profile.times if start < time < end]
    even = np.linspace(start, end, count + 1).tolist() if end > start else [start]
    return np.array(sorted({*even, *knots}))


def _slices(walk: Walk, times: FloatArray) -> Iterator[tuple[int, Motion]]:
    """The motion in slices that need bounded memory, each from the last time of the one before it."""
    per = max(SLICE_PLACES // (len(walk.dragon) + 1), 2)
    for first in range(0, max(len(times) - 1, 1), per):
        yield first, walk.motion(times[first : first + per + 1])


def _seen(walk: Walk, line: kernel.Line, times: FloatArray, progress: Progress) -> kernel.Known:
    """The walk sampled at these times, s."""
    count = len(walk.dragon)
    known = kernel.Known(
        np.empty((count, kernel.PACE_PIECE_COLUMNS)),
        np.zeros((count, kernel.BENCH_ROW_COLUMNS)),
        np.zeros(1, dtype=np.int64),
        np.empty(LANES),
        empty_placements(count + 1, LANES),
    )
    for first, motion in _slices(walk, times):
        tables = (motion.s, motion.speed_ratio, motion.x, motion.y)
        rows = (np.ascontiguousarray(table.T) for table in tables)
        seen = kernel.Seen(motion.times, motion.head_s, walk.profile.speed(motion.times), *rows)
        passed, work = kernel.count_passed(line, seen)
        budget.spend(work)
        room = max(int(known.tally[0]), count) + passed
        if room > len(known.pieces):
            budget.hold(8 * room * kernel.PACE_PIECE_COLUMNS)
            more = np.empty((room - len(known.pieces), kernel.PACE_PIECE_COLUMNS))
            known = known._replace(pieces=np.concatenate([known.pieces, more]))
        if not kernel.look_at_benches(
            line, seen, first, REACH, nearness.OTHER_COIL, walk.dragon.lever, known
        ):
            walk.placement(known.at[:1])  # raises
        progress(first / len(times), "")
    return known


def _stretches(bends: Bends, line: kernel.Line, end: float, known: kernel.Known) -> list[list[Stretch]]:
    """The stretches of each bench, from 0, of a walk up to its end, s."""
    out = np.empty((len(known.pieces), kernel.PACE_STRETCH_COLUMNS))
    found: list[list[Stretch]] = [[] for _bench in range(len(line.links))]
    for row in out[: kernel.tell_stretches(line.rows, bends.turned, end, known, out)].tolist():
        bench, start, until, turning, pace, way, angle, *speeds = row
        stretch = Stretch(
            start, until, turning_of(turning), PACES[int(pace)], way, angle, (speeds[0], speeds[1])
        )
        found[int(bench)].append(stretch)
    return found


def _nearest(
    walk: Walk, line: kernel.Line, times: FloatArray, apart: float, known: kernel.Known,
    progress: Progress,
) -> list[list[float]]:  # fmt: skip
    """The nearest approach to each bench, as rows of kernels/bench_nearness.py."""
    count, heads = len(walk.dragon), walk.head_position(times)
    out = np.empty((count, nearness.TIGHTEST_COLUMNS))
    nearness.find_tightest(line, heads, 0, count, apart, known, np.empty((2, BOX_COLUMNS)), out)
    progress(1.0, "")
    return list(out.tolist())


def _tightest(walk: Walk, times: FloatArray, row: list[float]) -> Tightest | None:
    """The tightest moment of a bench; None where nothing comes within REACH."""
    other, side, lower, upper, head, early, late, x, y = row
    if not other:
        return None
    # Where the head stops for good, rounding may put its place beyond all that it comes to.
    time = min(max(walk.time_at(head), times[int(early)]), times[int(late)])
    return Tightest(float(time), int(other), SIDES[int(side)], lower, upper, (x, y))


def beside(placed: Placement) -> list[tuple[int | None, int | None]]:
    """The numbers of the benches next to each on its left and on its right, at the first position.

    Of each line of benches that passes, no neighbours and no more than BESIDE metres away, that is the
    one most abreast, and of these the one of the nearest line; None where there is none.
    """
    return _stood(placed.dragon, *placed.tables[2:])[2]


def _handles(walk: Walk, time: float) -> tuple[FloatArray, FloatArray]:
    """x and y of all handles at a time, s, m, each (N + 1, 1)."""
    return walk.motion([time]).tables[2:]


def _stood(
    dragon: Dragon, x: FloatArray, y: FloatArray
) -> tuple[list[tuple[float, float]], list[list[float]], list[tuple[int | None, int | None]]]:
    """Where handles stand, m, the benches' rectangles, and who is beside each: see `beside`."""
    count = len(dragon)
    table, found = np.empty((count, BOX_COLUMNS)), np.empty((count, 2), dtype=np.int64)
    nearness.find_beside(dragon.sizes, x, y, table, found)
    at = [(ax[0], ay[0]) for ax, ay in zip(x.tolist(), y.tolist(), strict=True)]
    return at, table.tolist(), [(left or None, right or None) for left, right in found.tolist()]
