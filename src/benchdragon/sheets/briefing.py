"""What all papers are made from: the plan as it was checked, its people, what each bench does."""

from dataclasses import dataclass
from datetime import date
from functools import cached_property

from benchdragon.analysis.bench_walks import BenchWalk, bench_walks
from benchdragon.analysis.chalk_line import Trail
from benchdragon.analysis.check import Report
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.i18n import _
from benchdragon.plans.people import called
from benchdragon.plans.schema import Plan
from benchdragon.rosters.roster import Roster


@dataclass(frozen=True)
class Briefing:
    """What the papers of a dance are made from.

    Attributes:
        report: the check of the plan, which found nothing.
        roster: who carries which bench.
        benches: what each bench does, the head's first.
        checked_on: the day of the check, YYYY-MM-DD.
        sha256: of the plan.
    """

    report: Report
    roster: Roster
    benches: tuple[BenchWalk, ...]
    checked_on: str
    sha256: str

    @property
    def plan(self) -> Plan:
        """The plan."""
        return self.report.plan

    @cached_property
    def foot(self) -> str:
        """The foot of every page: the plan, and when it was checked."""
        return f"{self.sha256[:12]} · {self.checked_on}"

    @property
    def clock(self) -> Clock:
        """How papers tell times."""
        return Clock(self.plan.cues.clock, self.report.start)

    @cached_property
    def ground(self) -> Ground:
        """The peg and the base line from which all papers measure."""
        return Ground.of(self.plan, self.report.walk.route)

    @cached_property
    def trail(self) -> Trail:
        """What the dragon covers of its route."""
        return Trail.of(self.report.walk, self.report.start, self.report.end)

    def called(self, bench: int) -> str:
        """What the village calls a bench (number, from 1), in the language in use."""
        return called(self.plan.people, bench, len(self.report.walk.dragon))


def dated(checked_on: str) -> str:
    """When a plan was checked, as it stands below titles."""
    return _("Checked on {date}").format(date=checked_on)


def briefing_of(report: Report, roster: Roster) -> Briefing:
    """What papers are made from: a check that found nothing, and the people."""
    benches = bench_walks(report.plan, report.walk, (report.start, report.end))
    return Briefing(report, roster, benches, date.today().isoformat(), report.plan.sha256)
