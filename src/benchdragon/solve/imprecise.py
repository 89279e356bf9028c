"""How likely imprecise people come nearer than they may: random dances of a plan, as papers tell it."""

from dataclasses import dataclass

from benchdragon.errors import BenchDragonError
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.solve.tolerance import ALL, Deviations, Draw, chance, touches

# Random dances, and the seed of their numbers; the risk that the upper end of their chance must be
# below, or no number is given: 110 dances of which one hits give 0.0496, two give 0.064.
DRAWS, SEED, RISK = 110, 1, 0.05
# The greatest deviation that dances are drawn with, m.
MOST_ASIDE = 1.0


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
    def most(self) -> float:
        """The upper end of the chance of it, with the confidence of `tolerance.chance`."""
        return chance(self.hits, self.draws)[2]

    @property
    def shown(self) -> bool:
        """Whether so few of so many hit that the chance is shown to be below RISK."""
        return self.draws > 0 and self.most < RISK


def deviations_of(plan: Plan) -> Deviations:
    """How far from exact the random dances are: the plan's imprecision, else what the program takes."""
    usual, said = Deviations(*ALL), min(plan.people.imprecision, MOST_ASIDE)
    others = usual.stray, usual.play, usual.height, usual.length, usual.width
    return Deviations(said or usual.aside, *others)


def chance_of(plan: Plan, progress: Progress = silent) -> Chance:
    """The chance that benches come nearer than the plan's margin; the square does not count."""
    bare, deviations, hits = plan.without_square(), deviations_of(plan), 0
    for number in range(DRAWS):
        try:
            hits += touches(bare, Draw(deviations, SEED, number))
        except BenchDragonError:  # too long a dance, or benches that cannot be: papers say so
            return Chance(deviations, 0, 0)
        progress((number + 1) / DRAWS, "")
        if chance(hits, DRAWS)[2] >= RISK:
            return Chance(deviations, number + 1, hits)
    return Chance(deviations, DRAWS, hits)
