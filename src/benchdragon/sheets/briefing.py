"""What all papers are made from: the plan as it was checked, its people, what each bench does."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from benchdragon.analysis.bench_walks import BenchWalk, bench_walks
from benchdragon.analysis.check import Report
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.marks import Marks, Trail, check_peg, placed_marks
from benchdragon.i18n import _
from benchdragon.model.base_curve import Point
from benchdragon.plans.people import called
from benchdragon.plans.schema import Plan
from benchdragon.rosters.roster import Roster
from benchdragon.sheets.checked import Record

# People of another bench who are named on a sheet.
MOST_NAMED = 4


@dataclass(frozen=True)
class Briefing:
    """What the papers of a dance are made from.

    Attributes:
        report: the check of the plan, which found nothing.
        roster: who carries which bench.
        benches: what each bench does, the head's first.
        checked_on: the day of the check, YYYY-MM-DD.
        sha256: of all that the papers rest on: plan, people, cues and roster.
        told_peg: where the peg stands, m; None for the plan's own.
    """

    report: Report
    roster: Roster
    benches: tuple[BenchWalk, ...]
    checked_on: str
    sha256: str
    told_peg: Point | None = None

    @property
    def plan(self) -> Plan:
        """The plan."""
        return self.report.plan

    @cached_property
    def foot(self) -> str:
        """What stands at the foot of every page: that it is this plan, and when it was checked."""
        return f"{self.sha256[:12]} · {self.checked_on}"

    @property
    def clock(self) -> Clock:
        """How papers tell times."""
        return Clock(self.plan.cues.clock, self.report.start)

    @cached_property
    def ground(self) -> Ground:
        """The peg and the base line from which all papers measure."""
        return Ground.of(self.plan, self.report.walk.route, self.told_peg)

    @cached_property
    def trail(self) -> Trail:
        """What the dragon covers of its route."""
        return Trail.of(self.report.walk, self.report.start, self.report.end)

    def marks(self, every: float | None) -> Marks:
        """The chalk plan's marks, so many m apart; None for its usual distance.

        Raises:
            InputError: for marks that are too near or too many.
        """
        apart = self.trail.usual_every if every is None else every
        return placed_marks(self.trail, apart, self.ground, obstacles=self.plan.obstacles())

    def called(self, bench: int) -> str:
        """What the village calls a bench (number, from 1), in the language in use."""
        return called(self.plan.people, bench, len(self.report.walk.dragon))

    def named(self, bench: int) -> str:
        """What the village calls a bench, and who carries it, as papers print it."""
        people = [person.name for person in self.roster.people(bench)]
        if not people:
            return self.called(bench)
        text = _("{bench} ({people})")
        return text.format(bench=self.called(bench), people=listed(people, MOST_NAMED))


def listed(names: Sequence[str], most: int) -> str:
    """So many names at most one after another, and how many more there are."""
    text = _(", ").join(names[:most])
    if len(names) <= most:
        return text
    return _("{names} and {count} more").format(names=text, count=len(names) - most)


def briefing_of(report: Report, roster: Roster, record: Record, peg: Point | None = None) -> Briefing:
    """What papers are made from: a check that found nothing, the people, the check's record, a peg.

    Raises:
        InputError: for a peg that no tape reaches.
    """
    if peg is not None:
        check_peg(Trail.of(report.walk, report.start, report.end), peg)
    benches = bench_walks(report.plan, report.walk, (report.start, report.end))
    return Briefing(report, roster, benches, record.date.isoformat(), record.sha256, peg)
