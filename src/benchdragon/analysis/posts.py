"""Posts for marshals along the spectators' line, and the reason for each.

The rule is this program's own and no regulation's: a post where the ground that benches cover comes
nearest to the venue's edge, at each entrance, where benches come nearest to one another, where the
fastest handle is, unless all are about as fast, and where else handles run; and others between them, so
that no two that follow one another are farther apart along the line than EVERY.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely
from shapely.geometry import LinearRing, Point

from benchdragon import budget
from benchdragon.analysis.check import Report
from benchdragon.analysis.running import APART, Running, running_stretches
from benchdragon.analysis.swept import SweptArea
from benchdragon.model import base_curve
from benchdragon.model.answer import Answer
from benchdragon.model.outline import shape_of

# The farthest that two posts that follow one another are apart along the line, m; posts nearer to one
# another along it than JOINED, m, are one.
EVERY, JOINED = 25.0, 3.0
# A dance in which no handle is faster than this many times the head's least speed has no fastest place;
# stops of the head, and braking for them, are ignored: they slow all handles.
FASTER = 1.02
# Stretches where handles run that have a post: the fastest ones.
MOST_RUNS = 5

Why = Literal["venue", "entrance", "tightest", "fastest", "run", "line"]


@dataclass(frozen=True)
class Reason:
    """The reason for a post.

    Attributes:
        why: "venue": the benches come nearest to the venue's edge; "entrance"; "tightest": two
            benches come nearest to one another; "fastest": the fastest handle; "run": the fastest of
            a stretch where handles run elsewhere; "line": no other post is near.
        value: the distance, m, or the speed, m/s; NaN where there is none.
        time: s; NaN where there is none.
    """

    why: Why
    value: float = math.nan
    time: float = math.nan


@dataclass(frozen=True)
class Post:
    """A place on the spectators' line.

    Attributes:
        point: m.
        reasons: at least one.
    """

    point: base_curve.Point
    reasons: tuple[Reason, ...]


@budget.question()
def marshal_posts(
    report: Report, swept: SweptArea, entrances: Sequence[base_curve.Point] = ()
) -> tuple[Post, ...]:
    """Posts on the outer spectators' lines of a dance, in going round each.

    Posts are moved to the nearest point of the lines.

    Args:
        report: the check of the plan.
        swept: the ground that its benches cover, with the spectators' line.
        entrances: where people come in, m.
    """
    lines = [LinearRing(ring) for ring in swept.lines.outer]
    wanted: list[list[tuple[float, Reason]]] = [[] for _line in lines]
    for place, reason in _places(report, swept, entrances):
        at = Point(place)
        n = int(np.argmin([line.distance(at) for line in lines]))
        wanted[n].append((float(lines[n].project(at)), reason))
    return tuple(
        Post((float(point.x), float(point.y)), reasons)
        for line, some in zip(lines, wanted, strict=True)
        for along, reasons in _spaced(some, float(line.length))
        for point in [line.interpolate(along)]
    )


def _places(
    report: Report, swept: SweptArea, entrances: Sequence[base_curve.Point]
) -> Iterable[tuple[base_curve.Point, Reason]]:
    """Where posts are needed, before they are moved to the line."""
    for one in report.obstacles:
        if one.obstacle.kind == "venue":
            edge = shape_of(one.obstacle).boundary
            (x, y), _foot = shapely.get_coordinates(shapely.shortest_line(swept.polygon, edge))
            # The check's answer about the benches: the polygon is a little larger than what they cover.
            yield (float(x), float(y)), Reason("venue", one.distance.sure(up=False))
    for place in entrances:
        yield place, Reason("entrance")
    answers: dict[Why, Answer] = {"tightest": report.clearance}
    if _fastest_stands_out(report):
        answers["fastest"] = report.greatest_speed
    for why, found in answers.items():
        near = found.witness
        if near is not None and near.time is not None:
            yield near.point, Reason(why, found.sure(up=why == "fastest"), near.time)
    for run in _runs(report):
        yield run.point, Reason("run", run.speed, run.time)


def _fastest_stands_out(report: Report) -> bool:
    """Whether the fastest handle is faster than the head ever is at its slowest, stops left out."""
    speeds = report.walk.profile.stretches(report.start, report.end).speeds
    slowest = float(speeds.min(initial=math.inf, where=speeds > 0.0))
    return report.greatest_speed.value > FASTER * slowest


def _runs(report: Report) -> list[Running]:
    """The fastest places of stretches where handles run, if not at the fastest of all."""
    fastest, run_from = report.greatest_speed, report.plan.people.run_from
    if fastest.upper < run_from:
        return []
    found = running_stretches(report.walk, report.start, report.end, run_from)
    near = fastest.witness
    others = [one for one in found if near is None or math.dist(one.point, near.point) > APART]
    return others[:MOST_RUNS]


def _spaced(
    wanted: list[tuple[float, Reason]], length: float
) -> list[tuple[float, tuple[Reason, ...]]]:
    """Places along a ring, m, with their reasons: the needed ones, merged, and some between."""
    joined: list[tuple[float, list[Reason]]] = []
    for along, reason in sorted(wanted, key=lambda one: one[0]):
        if joined and along - joined[-1][0] <= JOINED:
            joined[-1][1].append(reason)
        else:
            joined.append((along, [reason]))
    if len(joined) > 1 and joined[0][0] + length - joined[-1][0] <= JOINED:  # over the ring's seam
        joined[0][1].extend(joined.pop()[1])
    if not joined:
        joined = [(0.0, [Reason("line")])]
    found = []
    ends = [*(along for along, _reasons in joined[1:]), joined[0][0] + length]
    for (along, reasons), end in zip(joined, ends, strict=True):
        found.append((along, tuple(reasons)))
        parts = math.ceil((end - along) / EVERY)
        found += [
            ((along + k * (end - along) / parts) % length, (Reason("line"),)) for k in range(1, parts)
        ]
    return found
