"""When the head and the tail pass each place of a dance."""

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

from benchdragon.analysis.findings import named
from benchdragon.i18n import _, language
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.cues import TIME_OF_DAY, Moment
from benchdragon.plans.schema import Plan

# Joints are told if there are no more.
MOST_JOINTS = 60
# The way is looked at so finely for obstacles and the venue's edge, m, but at no more places; what it
# finds is then drawn near to this, m.
FINE, MOST_LOOKS, NEAR = 0.1, 50_000, 1e-6
# A day, s.
DAY = 86_400.0

Kind = Literal["start", "joint", "cue", "entrance", "obstacle", "end"]


@dataclass(frozen=True)
class Passing:
    """A place of the route, and when head and tail are there.

    Attributes:
        kind: of the place.
        name: what it is called, in the language in use.
        s: its route position, m.
        way: that of the head from the start of the dance, m.
        point: x and y, m.
        head: when the head passes, s; None if not in the dance.
        until: when it goes on, s, where a cue holds it there; else `head`.
        tail: when the tail passes, s; None if not in the dance.
    """

    kind: Kind
    name: str
    s: float
    way: float
    point: tuple[float, float]
    head: float | None
    until: float | None
    tail: float | None


def timetable(plan: Plan, walk: Walk, start: float, end: float) -> tuple[Passing, ...]:
    """All places of a dance over a span, s, in the order in which the head comes to them."""
    first, last = walk.head_position([start, end]).tolist()
    rows = [_passing(walk, (start, end), "start", _("the dance starts"), first)]
    joints = [s for s in walk.route.joints[1:-1].tolist() if s < last]
    if len(joints) <= MOST_JOINTS:
        for n, s in enumerate(joints, start=1):
            rows.append(_passing(walk, (start, end), "joint", _("joint {n}").format(n=n), s))
    rows += [_cue(walk, (start, end), one, first) for one in plan.moments()]
    rows += _beside(plan, walk, (start, end))
    rows.append(_passing(walk, (start, end), "end", _("the dance ends"), last))
    rows.sort(key=lambda row: (row.s, row.kind == "end", row.head or 0.0))
    return tuple(row for row in rows if row.head is not None or row.tail is not None)


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
    begins = float(walk.motion([span[0]]).s[0, -1])
    if s < begins:
        return None
    head = walk.head_where_tail(s)
    if float(walk.placement([head]).s[0, -1]) < s - NEAR:
        return None  # the route ends first
    return _within(walk.time_at(head), span)


def _cue(walk: Walk, span: tuple[float, float], one: Moment, first: float) -> Passing:
    """The place at which the head is at a cue; a cue is told at its own time."""
    place = _passing(walk, span, "cue", one.cue.called(language()), first + one.way)
    until = min(one.until, span[1])
    return Passing("cue", place.name, place.s, one.way, place.point, one.time, until, place.tail)


def _beside(plan: Plan, walk: Walk, span: tuple[float, float]) -> Iterator[Passing]:
    """Where the head crosses the venue's edge inward, and comes nearest to each named obstacle."""
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
            away = _distance(obstacle, points)
            n = int(np.argmin(away))
            low, high = looks[max(n - 1, 0)], looks[min(n + 1, count - 1)]
            s = _lowest(partial(_away, walk, obstacle), float(low), float(high))
            name = _("nearest to {name}").format(name=named(obstacle))
            yield _passing(walk, span, "obstacle", name, s)


def _entered(walk: Walk, venue: Obstacle, out: float, within: float) -> float:
    """Where the head comes into the venue, between a place outside and one within, m."""
    while within - out > NEAR:
        middle = 0.5 * (out + within)
        if venue.forbids(walk.route.point([middle]))[0]:
            out = middle
        else:
            within = middle
    return within


def _away(walk: Walk, obstacle: Obstacle, s: float) -> float:
    return float(_distance(obstacle, walk.route.point([s]))[0])


def _distance(obstacle: Obstacle, points: FloatArray) -> FloatArray:
    """How far points, (P, 2), lie from an obstacle's outline, or of a circle from its centre, m."""
    corners = obstacle.outline
    if obstacle.kind == "circle":
        return np.asarray(np.hypot(*(points - corners[0]).T))
    ends = corners if obstacle.kind == "line" else np.vstack([corners, corners[:1]])
    least = np.full(len(points), np.inf)
    for a, b in itertools.pairwise(ends):
        share = np.clip((points - a) @ (b - a) / max(float((b - a) @ (b - a)), 1e-18), 0.0, 1.0)
        least = np.minimum(least, np.hypot(*(points - a - share[:, np.newaxis] * (b - a)).T))
    return least


def _lowest(value: Callable[[float], float], low: float, high: float) -> float:
    """Where a function with one low point between two places has it, to NEAR."""
    golden = 0.5 * (math.sqrt(5.0) - 1.0)
    while high - low > NEAR:
        a, b = high - golden * (high - low), low + golden * (high - low)
        if value(a) <= value(b):
            high = b
        else:
            low = a
    return 0.5 * (low + high)


def clock_text(clock: str, start: float, time: float) -> str:
    """A time of the dance, s, as a time of day, to a second, where the plan says one; else m:ss.

    Args:
        clock: that at which the dance starts, "18:30"; "" if the plan says none.
        start: of the dance, s.
        time: what to write, s.
    """
    found = TIME_OF_DAY.fullmatch(clock)
    if not found:
        seconds = math.floor(abs(time) + 0.5)
        sign = "-" if time < 0.0 and seconds else ""
        return f"{sign}{seconds // 60}:{seconds % 60:02d}"
    hours, minutes, more = (int(part or 0) for part in found.groups())
    seconds = math.floor(3600 * hours + 60 * minutes + more + time - start + 0.5) % int(DAY)
    return f"{seconds // 3600}:{seconds // 60 % 60:02d}:{seconds % 60:02d}"
