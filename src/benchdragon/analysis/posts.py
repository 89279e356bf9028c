"""Posts for marshals along the spectators' line, and the reason for each.

The rule is this program's own and no regulation's: a post where benches come nearest to the venue's
edge, at each entrance, where benches come nearest to one another, where the fastest handle is, unless
all are about as fast, and where else handles run; and others between them, so that no two that follow
one another are farther apart along the line than EVERY.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from benchdragon import budget
from benchdragon.analysis.check import Report
from benchdragon.analysis.running import APART, Running, running_stretches
from benchdragon.model.base_curve import Point
from benchdragon.model.rings import Ring, length_of, nearest_on, place_on

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

    point: Point
    reasons: tuple[Reason, ...]


@budget.question()
def marshal_posts(
    report: Report, lines: Sequence[Ring], entrances: Sequence[Point] = ()
) -> tuple[Post, ...]:
    """Posts on spectators' lines of a dance, in going round each.

    Posts are moved to the nearest point of the lines.

    Args:
        report: the check of the plan.
        lines: the spectators' lines, those around the outside.
        entrances: where people come in, m.
    """
    wanted: list[list[tuple[float, Reason]]] = [[] for _line in lines]
    for place, reason in _places(report, entrances):
        near = [nearest_on(line, place) for line in lines]
        n = near.index(min(near))
        wanted[n].append((near[n][1], reason))
    return tuple(
        Post(place_on(line, along), reasons)
        for line, some in zip(lines, wanted, strict=True)
        for along, reasons in _spaced(some, length_of(line))
    )


def _places(report: Report, entrances: Sequence[Point]) -> Iterator[tuple[Point, Reason]]:
    """Where posts are needed, before they are moved to the line."""
    for one in report.obstacles:
        nearest = one.distance.witness
        if one.obstacle.kind == "venue" and nearest is not None:
            yield nearest.point, Reason("venue", one.distance.sure(up=False))
    for place in entrances:
        yield place, Reason("entrance")
    near, fastest = report.clearance.witness, report.greatest_speed.witness
    if near is not None and near.time is not None:
        yield near.point, Reason("tightest", report.clearance.sure(up=False), near.time)
    if fastest is not None and fastest.time is not None and _fastest_stands_out(report):
        yield fastest.point, Reason("fastest", report.greatest_speed.sure(up=True), fastest.time)
    for run in _runs(report):
        yield run.point, Reason("run", run.speed, run.time)


def _fastest_stands_out(report: Report) -> bool:
    """Whether the fastest handle is faster than the head ever is at its slowest, stops left out."""
    cut = report.walk.profile.stretches(report.start, report.end)
    speeds = [speed for ends in cut.speeds.tolist() for speed in ends if speed > 0.0]
    return report.greatest_speed.value > FASTER * min(speeds, default=math.inf)


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
