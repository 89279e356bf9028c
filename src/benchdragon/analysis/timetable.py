"""When the head and the tail pass each place of a dance."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.bends import Bends, Turning
from benchdragon.analysis.findings import named
from benchdragon.analysis.nearby import must_stand
from benchdragon.analysis.not_looked_at import places
from benchdragon.analysis.obstacle_distance import nearest_boxes
from benchdragon.errors import in_order, of_kind
from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import evaluate
from benchdragon.model.arrays import as_table
from benchdragon.model.curves import AnyCurve, Route, Spiral
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.cues import Moment, cue_name
from benchdragon.plans.schema import Plan

# Joints are listed if there are no more.
MOST_JOINTS = 60
# Step of samples of the way for obstacles and the venue's edge, m, and their greatest number; places
# found are then refined to this, m, with so many samples at a time.
FINE, MOST_LOOKS, NEAR, FINER = 0.1, 50_000, 1e-6, 21

# Names of places where the route changes the side to which it bends.
BENDS: dict[tuple[Turning, Turning], str] = {
    ("left", "right"): N_("left bend becomes right bend"),
    ("right", "left"): N_("right bend becomes left bend"),
    ("straight", "left"): N_("straight becomes left bend"),
    ("straight", "right"): N_("straight becomes right bend"),
    ("left", "straight"): N_("left bend becomes straight"),
    ("right", "straight"): N_("right bend becomes straight"),
}

Kind = Literal["start", "joint", "cue", "entrance", "obstacle", "end"]


@dataclass(frozen=True)
class Passing:
    """A place of the route, and when head and tail are there.

    Attributes:
        kind: of the place.
        name: in the language in use.
        s: its route position, m.
        way: that of the head from the start of the dance, m.
        point: x and y, m.
        head: when the head passes, s; None if not in the dance.
        until: when it goes on, s, where a cue holds it there; else `head`.
        tail: when the tail passes, s; None if not in the dance.

    Examples:
        >>> passings = bd.read_plan("turn", {"walk.end": 60.0}).timetable()
        >>> passings[0].kind, round(passings[1].head, 3)
        ('start', 0.0)
    """

    kind: Kind
    name: str
    s: float
    way: float
    point: tuple[float, float]
    head: float | None
    until: float | None
    tail: float | None


@budget.question()
def timetable(
    plan: Plan, walk: Walk | None = None, start: float | None = None, end: float | None = None
) -> tuple[Passing, ...]:
    """All places of a plan's walk over a span, s, in the order in which the head comes to them.

    The walk, if it is not built yet, and the whole span are the plan's unless given. Names are in the
    language in use.

    Raises:
        InputError: if `plan` is not a Plan, or the end comes before the start.
        WalkError: if the dragon cannot stand at some time.

    Examples:
        >>> [passing.kind for passing in bd.timetable(bd.read_plan("turn", {"walk.end": 60.0}))][:2]
        ['start', 'joint']
    """
    of_kind("plan", plan, Plan)
    walk, start, end = asked_of(plan, start, end, walk)
    in_order(start, end)
    for time in (start, end):
        must_stand(walk, time)
    span, (first, last) = (start, end), walk.head_position([start, end]).tolist()
    rows = [_passing(walk, span, "start", _("the head sets out"), first)]
    joints = _joints(plan, walk, last)
    if len(joints) <= MOST_JOINTS:
        rows += [_passing(walk, span, "joint", name, s) for name, s in joints]
    rows += [_cue(walk, span, one, first) for one in plan.moments()]
    rows += _beside(plan, walk, span)
    rows.append(_passing(walk, span, "end", _("the head at the end"), last))
    rows = sorted(rows, key=lambda row: (row.s, row.kind == "end", row.head or 0.0))
    return tuple(row for row in rows if row.head is not None or row.tail is not None)


def _joints(plan: Plan, walk: Walk, last: float) -> list[tuple[str, float]]:
    """Where the route bends otherwise than before, until the head's last place, m: names and places.

    What happens several times is numbered.
    """
    bends, joints = Bends.of(walk.route), walk.route.joints[1:-1].tolist()
    found: list[tuple[str, int, float]] = []
    often: dict[str, int] = {}
    rounds = 1
    for n, s in enumerate(joints, start=1):
        before, behind = bends.turning(s - NEAR), bends.turning(s + NEAR)
        name = _(BENDS[before, behind]) if before != behind else ""
        if plan.route.kind == "turn":
            ended, begun = walk.route.curves[n - 1], walk.route.curves[n]
            name = _in_rounds(ended, begun, rounds) or name
            rounds += 1 if isinstance(ended, Spiral) and not ended.inward else 0
        if name and s < last:
            often[name] = often.get(name, 0) + 1
            found.append((name, often[name], s))
    numbered = _("{name} ({n})")
    return [(numbered.format(name=name, n=n) if often[name] > 1 else name, s) for name, n, s in found]


def _in_rounds(ended: AnyCurve, begun: AnyCurve, rounds: int) -> str:
    """What happens between two curves in one of the rounds of a coil, from 1; "" for nothing."""
    if isinstance(ended, Spiral):
        return _("the turn begins") if ended.inward else _("the head goes back")
    if isinstance(begun, Spiral):
        return _("round {n} begins").format(n=rounds) if begun.inward else _("the turn ends")
    return ""


def _passing(walk: Walk, span: tuple[float, float], kind: Kind, name: str, s: float) -> Passing:
    """A place by its route position, m."""
    first = float(walk.head_position([span[0]])[0])
    head = _within(walk.time_at(s), span) if s > first else span[0] if s == first else None
    head = span[1] if kind == "end" else head
    ((x, y, *_flat),) = _spots(walk.route, [min(s, walk.route.length)]).tolist()  # rounding
    return Passing(kind, name, s, s - first, (x, y), head, head, _tail_time(walk, s, span))


def _within(time: float, span: tuple[float, float]) -> float | None:
    return time if span[0] <= time <= span[1] else None


def _tail_time(walk: Walk, s: float, span: tuple[float, float]) -> float | None:
    """When the last handle comes to a route position, m; None if that is not in the dance."""
    begins, ends = [handles[-1] for handles in places(walk, *span)]
    if not begins <= s <= ends + NEAR:
        return None
    return min(max(walk.time_at(walk.head_where_tail(min(s, ends))), span[0]), span[1])


def _cue(walk: Walk, span: tuple[float, float], one: Moment, first: float) -> Passing:
    """The place of the head at a cue, at the cue's own time."""
    place = _passing(walk, span, "cue", cue_name(one.cue), first + one.way)
    until = min(one.until, span[1])
    return Passing("cue", place.name, place.s, one.way, place.point, one.time, until, place.tail)


def _beside(plan: Plan, walk: Walk, span: tuple[float, float]) -> Iterator[Passing]:
    """Where the head crosses the venue's edge inward, and is nearest to obstacles; entrances.

    A place that is passed several times is listed once: where the dance is nearest. At an entrance the
    dragon's body counts, so that the ways of all handles are searched.
    """
    first, last = [min(s, walk.route.length) for s in walk.head_position(span).tolist()]
    looks = _even(first, last, FINE)
    for obstacle in plan.obstacles():
        if obstacle.kind == "venue":
            for s in _entered(walk.route, obstacle, looks):
                name = _("entrance of {name}").format(name=named(obstacle))
                yield _passing(walk, span, "entrance", name, s)
        else:
            name = _("the head nearest to {name}").format(name=named(obstacle))
            yield _passing(walk, span, "obstacle", name, _nearest(_apart(walk.route, obstacle), looks))
    tail = places(walk, span[0])[0][-1]
    ways = [*_even(tail, first, FINE)[:-1], *looks]
    for n, place in enumerate(plan.event.places, start=1):
        name = _("the dragon's way nearest to entrance {n}").format(n=n)
        entrance = Obstacle("", "circle", as_table([place]))
        yield _passing(walk, span, "entrance", name, _nearest(_apart(walk.route, entrance), ways))


def _even(first: float, last: float, step: float) -> list[float]:
    """Route positions at even distances, m, about as far apart as asked for; both ends among them."""
    count = max(2, min(MOST_LOOKS, math.ceil((last - first) / step) + 1))
    return [float(s) for s in np.linspace(first, last, count)]


def _spots(route: Route, looks: Sequence[float]) -> FloatArray:
    """Places of the route as boxes without length and width: (looks, BOX_COLUMNS) of kernels/box.py."""
    found = np.empty((len(looks), 4))
    evaluate(route.rows, np.array(looks), found)
    return np.array([[x, y, 1.0, 0.0, 0.0, 0.0] for x, y, *_turned in found.tolist()])


def _entered(route: Route, venue: Obstacle, looks: Sequence[float]) -> list[float]:
    """Where the head comes into the venue, m: behind each look outside of it that is the last there."""

    def out(some: Sequence[float]) -> list[bool]:
        return [bool(one) for one in venue.forbids(_spots(route, some))]

    found, seen = [], out(looks)
    for n, (left, right) in enumerate(pairwise(seen)):
        if left and not right:
            outside, within = looks[n], looks[n + 1]
            while within - outside > NEAR:
                middle = 0.5 * (outside + within)
                if out([middle])[0]:
                    outside = middle
                else:
                    within = middle
            found.append(within)
    return found


def _apart(route: Route, obstacle: Obstacle) -> Callable[[Sequence[float]], list[float]]:
    """What tells how far route positions, m, are from an obstacle's sides or its centre, m."""

    def apart(looks: Sequence[float]) -> list[float]:
        far, _which = nearest_boxes(_spots(route, looks), obstacle)
        found: list[float] = far.tolist()
        return found

    return apart


def _nearest(apart: Callable[[Sequence[float]], list[float]], looks: list[float]) -> float:
    """Which route position is the nearest, m: about the best of those given, sampled ever finer."""
    while True:
        away = apart(looks)
        n = away.index(min(away))
        low, high = looks[max(n - 1, 0)], looks[min(n + 1, len(looks) - 1)]
        if high - low <= NEAR:
            return looks[n]
        looks = [float(s) for s in np.linspace(low, high, FINER)]
