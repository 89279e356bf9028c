"""What the permit annex rests on: computed once, said in both languages."""

from dataclasses import dataclass

from benchdragon.analysis.crowd import Crowd, body_nearest, crowd_of, event_findings, within_line
from benchdragon.analysis.findings import Finding
from benchdragon.analysis.posts import Post, marshal_posts
from benchdragon.analysis.swept import SweptArea, swept_area
from benchdragon.errors import BenchDragonError
from benchdragon.i18n import _
from benchdragon.model.answer import Answer
from benchdragon.model.outline import shape_of
from benchdragon.progress import Progress, silent, stages
from benchdragon.sheets.briefing import Briefing
from benchdragon.solve.tolerance import CASES, Deviations, Draw, chance, touches

# The spectators' line where the plan says none, and the error of the ground covered, m.
DISTANCE, ERROR = 2.0, 0.05
# Random dances, and the seed of their numbers; the risk that the upper end of their chance must be
# below, or no number is given: 110 dances of which one hits give 0.0496, two give 0.064.
DRAWS, SEED, RISK = 110, 1, 0.05


@dataclass(frozen=True)
class Chance:
    """Random dances in which benches come nearer than the margin.

    Attributes:
        deviations: how far from exact the dances are.
        draws: dances; 0 where they could not be walked.
        hits: those with contact; none is drawn any more once they are too many to show RISK.
    """

    deviations: Deviations
    draws: int
    hits: int

    @property
    def share(self) -> tuple[float, float, float]:
        """Share with contact, and the bounds of its probability."""
        return chance(self.hits, self.draws)

    @property
    def shown(self) -> bool:
        """Whether so few of so many hit that the chance is shown to be below RISK."""
        return self.draws > 0 and self.share[2] < RISK


@dataclass(frozen=True)
class AnnexFacts:
    """The facts of the annex beside the plan and its check.

    Attributes:
        briefing: of the dance.
        swept: the ground that benches cover, with the spectators' line.
        posts: for marshals.
        chance: of contact of imprecise dances.
        crowd: what spectators have.
        nearest: how near the benches come to each entrance, m.
        findings: what the event asks of spectators that it should not.
    """

    briefing: Briefing
    swept: SweptArea
    posts: tuple[Post, ...]
    chance: Chance
    crowd: Crowd
    nearest: tuple[Answer, ...]
    findings: tuple[Finding, ...]

    @property
    def within_line(self) -> float:
        """The area that spectators' lines go round, holes included, m²."""
        return float(within_line(self.swept).area)

    @property
    def leaves_venue(self) -> bool:
        """Whether the spectators' line lies outside the venue's edge anywhere."""
        edges = [one for one in self.briefing.plan.obstacles() if one.kind == "venue"]
        return any(not shape_of(edge).covers(self.swept.spectators) for edge in edges)


def annex_facts(briefing: Briefing, progress: Progress = silent) -> AnnexFacts:
    """What the annex tells of a dance that was checked.

    Raises:
        InputError, UnsureError: as `swept_area`.
    """
    report, event = briefing.report, briefing.plan.event
    stage = stages(progress, 2)
    distance = DISTANCE if event.distance is None else event.distance
    told = stage(_("ground covered"))
    swept = swept_area(
        report.walk, report.start, report.end, margin=distance, error=ERROR, progress=told
    )
    posts = marshal_posts(report, swept, event.entrances)
    crowd, found = crowd_of(report.plan, swept), _chance(briefing, stage(_("random dances")))
    return AnnexFacts(
        briefing, swept, posts, found, crowd, tuple(body_nearest(report.plan, swept)),
        event_findings(report.plan, swept, crowd),
    )  # fmt: skip


def deviations_of(briefing: Briefing) -> Deviations:
    """How far from exact the random dances are: the plan's imprecision, else what the program takes."""
    usual, said = CASES["all"].deviations, briefing.plan.people.imprecision
    aside = min(said, 1.0) or usual.aside
    return Deviations(aside, usual.stray, usual.play, usual.height, usual.length, usual.width)


def _chance(briefing: Briefing, progress: Progress) -> Chance:
    plan, deviations, hits = briefing.plan.without_square(), deviations_of(briefing), 0
    for number in range(DRAWS):
        try:
            hits += touches(plan, Draw(deviations, SEED, number))
        except BenchDragonError:  # too long a dance, or benches that cannot be: the annex says so
            return Chance(deviations, 0, 0)
        progress((number + 1) / DRAWS, "")
        if chance(hits, DRAWS)[2] >= RISK:
            return Chance(deviations, number + 1, hits)
    return Chance(deviations, DRAWS, hits)
