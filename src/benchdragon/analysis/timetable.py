"""When the head and the tail pass each place of a dance."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely
from scipy.optimize import minimize_scalar
from shapely.geometry.base import BaseGeometry

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.bends import Bends, Turning
from benchdragon.analysis.findings import named
from benchdragon.errors import in_order, of_kind
from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.outline import shape_of
from benchdragon.model.walk import Walk
from benchdragon.plans.cues import Moment, cue_name
from benchdragon.plans.schema import Plan

# Joints are listed if there are no more.
MOST_JOINTS = 60
# Step of samples of the way for obstacles and the venue's edge, m, and their greatest number; places
# found are then refined to this, m.
FINE, MOST_LOOKS, NEAR = 0.1, 50_000, 1e-6

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
    first, last = walk.head_position([start, end]).tolist()
    rows = [_passing(walk, (start, end), "start", _("the head sets out"), first)]
    joints = [s for s in walk.route.joints[1:-1].tolist() if s < last]
    if len(joints) <= MOST_JOINTS:
        names = _joint_names(plan, walk)
        for name, s in zip(names, joints, strict=False):
            rows.append(_passing(walk, (start, end), "joint", name, s))
    rows += [_cue(walk, (start, end), one, first) for one in plan.moments()]
    rows += _beside(plan, walk, (start, end))
    rows.append(_passing(walk, (start, end), "end", _("the head at the end"), last))
    rows.sort(key=lambda row: (row.s, row.kind == "end", row.head or 0.0))
    return tuple(row for row in rows if row.head is not None or row.tail is not None)


def _joint_names(plan: Plan, walk: Walk) -> list[str]:
    """Names of joints between parts of the route: by what happens there, else by number."""
    bends, joints = Bends.of(walk.route), walk.route.joints[1:-1].tolist()
    names = []
    for n, s in enumerate(joints, start=1):
        before, behind = (bends.turning(s + aside) for aside in (-NEAR, NEAR))
        name = _("joint {n}").format(n=n)
        if plan.route.kind == "turn" and n in (1, len(joints)):
            name = _("the turn begins") if n == 1 else _("the turn ends")
        elif before != behind:
            name = _(BENDS[before, behind])
        names.append(name)
    return names


def _passing(walk: Walk, span: tuple[float, float], kind: Kind, name: str, s: float) -> Passing:
    """A place by its route position, m."""
    first = float(walk.head_position([span[0]])[0])
    head = _within(walk.time_at(s), span) if s > first else span[0] if s == first else None
    head = span[1] if kind == "end" else head
    (x, y) = walk.route.point([min(s, walk.route.length)])[0].tolist()  # rounding
    return Passing(kind, name, s, s - first, (x, y), head, head, _tail_time(walk, s, span))


def _within(time: float, span: tuple[float, float]) -> float | None:
    return time if span[0] <= time <= span[1] else None


def _tail_time(walk: Walk, s: float, span: tuple[float, float]) -> float | None:
    """When the last handle comes to a route position, m; None if that is not in the dance."""
    begins, ends = walk.motion(span).s[:, -1].tolist()
    if not begins <= s <= ends + NEAR:
        return None
    head = walk.head_where_tail(s)
    if float(walk.placement([head]).s[0, -1]) < s - NEAR:
        return None  # the route ends first
    return _within(walk.time_at(head), span)


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
    first, last = np.minimum(walk.head_position(span), walk.route.length).tolist()
    count = max(2, min(MOST_LOOKS, math.ceil((last - first) / FINE) + 1))
    looks = np.linspace(first, last, count)
    points = walk.route.point(looks)
    for obstacle in plan.obstacles():
        if obstacle.kind == "venue":
            out = obstacle.forbids(points)
            for n in np.flatnonzero(out[:-1] & ~out[1:]).tolist():
                s = _entered(walk, obstacle, float(looks[n]), float(looks[n + 1]))
                name = _("entrance of {name}").format(name=named(obstacle))
                yield _passing(walk, span, "entrance", name, s)
        else:
            name = _("the head nearest to {name}").format(name=named(obstacle))
            yield _passing(walk, span, "obstacle", name, _nearest(walk, shape_of(obstacle), looks))
    tail = float(walk.motion([span[0]]).s[0, -1])
    ways = np.concatenate([np.arange(tail, first, max(FINE, (first - tail) / MOST_LOOKS)), looks])
    for n, (x, y) in enumerate(plan.event.entrances, start=1):
        name = _("the dragon's way nearest to entrance {n}").format(n=n)
        yield _passing(walk, span, "entrance", name, _nearest(walk, shapely.Point(x, y), ways))


def _entered(walk: Walk, venue: Obstacle, out: float, within: float) -> float:
    """Where the head comes into the venue, between a place outside and one within, m."""
    while within - out > NEAR:
        middle = 0.5 * (out + within)
        if venue.forbids(walk.route.point([middle]))[0]:
            out = middle
        else:
            within = middle
    return within


def _nearest(walk: Walk, shape: BaseGeometry, looks: FloatArray) -> float:
    """Where the route comes nearest to a shape, m, about the best of sampled route positions, m."""

    def away(s: float) -> float:
        return float(shapely.distance(shape, shapely.Point(walk.route.point([s])[0])))

    n = int(np.argmin(shapely.distance(shape, shapely.points(walk.route.point(looks)))))
    about = float(looks[max(n - 1, 0)]), float(looks[min(n + 1, len(looks) - 1)])
    return float(minimize_scalar(away, bounds=about, method="bounded", options={"xatol": NEAR}).x)
