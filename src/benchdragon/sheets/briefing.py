"""What all papers are made from: the plan as it was checked, its people, what each bench does."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from datetime import date
from functools import cached_property

from benchdragon.analysis.bench_walks import BenchWalk, bench_walks
from benchdragon.analysis.check import Report
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.marks import Marks, Trail, check_marks, placed_marks
from benchdragon.figures.glyphs import glyph_warnings, printed_warnings
from benchdragon.i18n import _
from benchdragon.plans.chalk import ChalkTable
from benchdragon.plans.people import called
from benchdragon.plans.schema import Plan
from benchdragon.rosters.reading import first_notes
from benchdragon.rosters.roster import Roster

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

    @cached_property
    def odd_signs(self) -> tuple[str, ...]:
        """Whose names papers cannot print as they are written, a sentence each."""
        return self._of_names(glyph_warnings)

    @property
    def missing_signs(self) -> tuple[str, ...]:
        """The same as papers say it."""
        return self._of_names(printed_warnings)

    def _of_names(self, told: Callable[[Iterable[str]], Sequence[str]]) -> tuple[str, ...]:
        """The notes on the names at each bench."""
        odd = (
            _("{bench}: {what}").format(bench=self.called(bench), what=warning)
            for bench, people in sorted(self.roster.benches.items())
            for warning in told(person.name for person in people)
        )
        return tuple(first_notes(odd))

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

    @property
    def every(self) -> float:
        """How far apart the chalk plan's marks are along the route, m."""
        return self.trail.every(self.plan.chalk.every)

    @cached_property
    def marks(self) -> Marks:
        """The chalk plan's marks, as all papers number them.

        Raises:
            InputError: for marks that are too many.
        """
        return placed_marks(self.trail, self.every, self.ground, obstacles=self.plan.obstacles())

    def called(self, bench: int) -> str:
        """What the village calls a bench (number, from 1), in the language in use."""
        return called(self.plan.people, bench, len(self.report.walk.dragon))

    def titled(self, bench: int) -> str:
        """The same, with a word for the first bench and the last where the village only counts them."""
        ends = {1: _("{bench}, the head"), len(self.report.walk.dragon): _("{bench}, the tail")}
        if bench not in ends or not self.plan.people.count_head:
            return self.called(bench)
        return ends[bench].format(bench=self.called(bench))

    def kin(self, bench: int) -> str:
        """Which other benches people of a bench's households carry, in words; "" if there are none."""
        own = {one.household for one in self.roster.people(bench)} - {""}
        others = [
            self.called(other)
            for other, people in sorted(self.roster.benches.items())
            if other != bench and own & {one.household for one in people}
        ]
        if not others:
            return ""
        return _("Of your household too: {benches}.").format(benches=listed(others, MOST_NAMED))

    def named(self, bench: int) -> str:
        """What the village calls a bench, and who carries it, as papers print it."""
        people = [person.name for person in self.roster.people(bench)]
        if not people:
            return self.called(bench)
        text = _("{bench} ({people})")
        return text.format(bench=self.called(bench), people=listed(people, MOST_NAMED))


def dated(checked_on: str) -> str:
    """When a plan was checked, as it stands below titles."""
    return _("Checked on {date}").format(date=checked_on)


def listed(names: Sequence[str], most: int) -> str:
    """So many names at most one after another, and how many more there are."""
    text = _(", ").join(names[:most])
    if len(names) <= most:
        return text
    return _("{names} and {count} more").format(names=text, count=len(names) - most)


def briefing_of(report: Report, roster: Roster) -> Briefing:
    """What papers are made from: a check that found nothing, and the people.

    Raises:
        InputError: for a plan with too many marks, and for a peg that no tape reaches.
    """
    benches = bench_walks(report.plan, report.walk, (report.start, report.end))
    today = date.today().isoformat()
    briefing = Briefing(report, roster, benches, today, report.plan.sha256)
    if report.plan.chalk != ChalkTable():
        check_marks(briefing.trail, briefing.every, briefing.ground.peg)
    return briefing
