"""What the leader's overview says above its table, sentence by sentence."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from benchdragon.analysis.bench_walks import BenchWalk
from benchdragon.analysis.check import Report, kept
from benchdragon.analysis.clock import Clock, lasting
from benchdragon.analysis.ground import Ground
from benchdragon.explain.bench_text import tightest_line
from benchdragon.explain.coming import coming_lines
from benchdragon.explain.room import level_line, plain_asked
from benchdragon.explain.whereabouts import whereabouts
from benchdragon.i18n import _
from benchdragon.kernels.bench_nearness import REACH
from benchdragon.model.base_curve import Point
from benchdragon.plans.people import called

# Tightest moments that are listed, of different benches, and how far apart they are at least, m.
MOST_TIGHT, TIGHT_APART = 3, 3.0


@dataclass(frozen=True)
class OverviewText:
    """The overview's sentences in the language in which they were asked for.

    Attributes:
        verdict: how long the dance is safe, what it keeps, what times are.
        tightest: moments between coils, one bench each, and where on the ground to watch them.
        coming: how to line up.
        leaving: how to leave.
        room: the levels of room for people; empty where the plan asks for none.
        starts: where the front handle of each bench starts.
    """

    verdict: tuple[str, ...]
    tightest: tuple[str, ...]
    coming: tuple[str, ...]
    leaving: tuple[str, ...]
    room: tuple[str, ...]
    starts: tuple[str, ...]


def overview_text(report: Report, benches: Sequence[BenchWalk], ground: Ground) -> OverviewText:
    """The overview of a dance that was found safe, with what each bench does, the head's first."""
    clock, span = Clock(report.plan.cues.clock, report.start), (report.start, report.end)
    text = _("{all}.").format(all=kept(report, clock))
    coming, leaving = coming_lines(report.plan, report.walk, span, ground)
    return OverviewText(
        (
            _("Safe for the whole dance: {long}.").format(long=lasting(report.end - report.start)),
            text[:1].upper() + text[1:],
            clock.legend,
        ),
        tuple(_tightest(report, benches, ground, clock)),
        tuple(coming),
        tuple(leaving),
        tuple(level_line(level, plain_asked) for level in report.room),
        tuple(whereabouts(report.plan, ground, one.place) for one in benches),
    )


def _tightest(
    report: Report, benches: Sequence[BenchWalk], ground: Ground, clock: Clock
) -> Iterator[str]:
    """The tightest moments, one bench each, and where on the ground to watch it."""

    def name(bench: int) -> str:
        return called(report.plan.people, bench, len(benches))

    near = [(one.tightest.upper, one.bench, one.tightest) for one in benches if one.tightest]
    told: set[int] = set()
    seen: list[Point] = []
    for _gap, bench, tightest in sorted(near, key=lambda one: one[:2]):
        elsewhere = all(math.dist(tightest.place, place) >= TIGHT_APART for place in seen)
        if len(seen) < MOST_TIGHT and elsewhere and bench not in told and tightest.bench not in told:
            told |= {bench, tightest.bench}
            seen.append(tightest.place)
            yield _("{bench} ({place}): {tightest}").format(
                bench=name(bench),
                place=whereabouts(report.plan, ground, tightest.place),
                tightest=tightest_line(tightest, clock, name, its=True),
            )
    if not seen:
        text = _(
            "No bench of another coil comes within about {reach} m of any: for that nobody need watch."
        )
        yield text.format(reach=f"{REACH:g}")
