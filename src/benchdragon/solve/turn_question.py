"""The engine's question about the best turn: kernels/turn_question.py, asked by Python."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from benchdragon import budget
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.speed import QUANTITIES, given_limits
from benchdragon.kernels import turn_peaks as judged
from benchdragon.kernels import turn_question as kernel
from benchdragon.kernels import turn_trial as told_of
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.question import QuestionEnding
from benchdragon.kernels.turn_peaks import ArcFamily, TurnGiven, TurnMeasure
from benchdragon.kernels.turn_question import TurnSought, TurnTold
from benchdragon.model.obstacle import Obstacle
from benchdragon.progress import Progress
from benchdragon.solve.turn_goal import EXCEEDED, PRUDENCE, TurnFamily

FAMILIES = {
    "arc-arc": ArcFamily.TWO_ARCS, "arc-line-arc": ArcFamily.LINE_BETWEEN,
    "arc-arc-arc": ArcFamily.ARC_BETWEEN,
}  # fmt: skip
# The figure that is to be small.
SOUGHT = {
    "way": TurnMeasure.WAY, "length": TurnMeasure.LONG, "disc": TurnMeasure.REACH,
    "speed": QUANTITIES["speed"].kind, "acceleration": QUANTITIES["total_acceleration"].kind,
}  # fmt: skip
# Limits by the figures that they limit, in the engine's order.
LIMITS = {
    TurnMeasure.BEND: "radius", TurnMeasure.REACH: "disc", TurnMeasure.LONG: "length",
    TurnMeasure.WAY: "way",
    **{quantity.kind: quantity.name for quantity in QUANTITIES.values()},
    TurnMeasure.APART: "clearance", TurnMeasure.BESIDE: "obstacles",
}  # fmt: skip


class Seen(NamedTuple):
    """A turn that was found: its unknowns, and what was seen by each TurnMeasure; else NaN."""

    x: list[float]
    figures: list[float]
    exceeds: float  # by what share a limit at most

    @property
    def allowed(self) -> bool:
        """Whether limits seem kept."""
        return self.exceeds <= EXCEEDED


def told_of_limits(family: TurnFamily) -> FloatArray:
    """A family's numbers as the engine takes them: see kernels/turn_peaks.py."""
    plan, goal = family.plan, family.goal
    known = {
        TurnGiven.FAMILY: FAMILIES[plan.turn.family],
        TurnGiven.EASE: math.nan if goal.objective == "acceleration" else plan.turn.ease,
        TurnGiven.PITCH: family.pitch,
        TurnGiven.DISC: family.disc,
        TurnGiven.NARROWEST: family.narrowest,
        TurnGiven.HEAD: plan.walk.speed,
        TurnGiven.LONGEST: goal.longest,
        TurnGiven.LONGEST_WAY: goal.longest_way,
        TurnGiven.MARGIN: plan.limits.margin,
        TurnGiven.SOUGHT: SOUGHT[goal.objective],
    }
    for name, limit in given_limits(plan).items():
        if QUANTITIES[name].kind != SOUGHT[goal.objective]:
            known[TurnGiven.LIMIT + QUANTITIES[name].kind] = limit
    return np.array([known.get(column, math.inf) for column in range(judged.TURN_GIVEN)])


def _side(obstacle: Obstacle) -> float:
    """Where no bench may be: 1 inside, -1 outside, 0: nowhere but at the boxes."""
    return {"venue": -1.0, "line": 0.0, "circle": 0.0}.get(obstacle.kind, 1.0)


class TurnQuestion(EngineQuestion):
    """A question about the best turn of a family, open until it is closed, as by `with`.

    Attributes:
        factors: corrections of the sampled figures: factors of rates, and m subtracted from distances.
    """

    def __init__(self, family: TurnFamily) -> None:
        low, high = (np.array([pair[n] for pair in family.bounds]) for n in (0, 1))
        standing: list[list[float]] = []
        border = [0]
        for obstacle in family.obstacles:
            standing += obstacle.boxes.tolist()
            border.append(len(standing))
        keep = [(one.radius + one.margin, _side(one)) for one in family.obstacles]
        budget.hold(8 * BOX_COLUMNS * len(standing))
        sizes = np.array([row[: told_of.MORE] for row in family.dragon.sizes.tolist()])
        handle = kernel.open_turn(
            told_of_limits(family), low, high, sizes, family.dragon.links[: told_of.MORE],
            np.array(standing).reshape(-1, BOX_COLUMNS), np.array(border, dtype=np.int64),
            np.array(keep).reshape(-1, 2),
        )  # fmt: skip
        found, seen = np.zeros(len(low)), np.zeros(judged.TURN_MEASURES)
        super().__init__(
            handle, kernel.step_turn, kernel.read_turn, np.zeros(kernel.TURN_FIGURES), found, seen
        )
        self._found_at, self._seen = found, seen
        self.factors = [1.0 + PRUDENCE] * judged.RATES + [1.0] * (judged.TURN_MEASURES - judged.RATES)
        for kind in (TurnMeasure.APART, TurnMeasure.BESIDE):
            self.factors[kind] = 0.0

    @property
    def tried(self) -> int:
        """How many turns were tried."""
        return int(self.figures[TurnTold.TRIED])

    def best(self, progress: Progress, text: str) -> Seen:
        """The best turn that is found all over the family."""
        return self._sought(TurnSought.ALL, self._found_at.tolist(), progress, text)

    def near(self, x: Sequence[float], progress: Progress, text: str) -> Seen:
        """The best turn downhill from these unknowns."""
        return self._sought(TurnSought.NEAR, x, progress, text)

    def _sought(self, what: int, x: Sequence[float], progress: Progress, text: str) -> Seen:
        kernel.seek_turn(self._handle, what, np.array(x), np.array(self.factors))
        while self.step() == QuestionEnding.MORE:
            progress(float(self.figures[TurnTold.SHARE]), text)
        exceeds = float(self.figures[TurnTold.EXCEEDS])
        return Seen(self._found_at.tolist(), self._seen.tolist(), exceeds)

    def correct(self, seen: Sequence[float], exact: Sequence[float], prudence: float) -> None:
        """Set the engine's corrections of sampled figures near a turn, and somewhat more."""
        for kind, (one, other) in enumerate(zip(seen, exact, strict=True)):
            if not math.isfinite(one) or not math.isfinite(other):
                continue
            if kind < judged.RATES:
                self.factors[kind] = other / one * (1.0 + prudence)
            elif kind in (TurnMeasure.APART, TurnMeasure.BESIDE):
                self.factors[kind] = max(other - one + prudence, 0.0)

    def exceeded(self, exact: Sequence[float]) -> dict[str, float]:
        """By what share exact figures exceed their limits, by the names of those that there are."""
        exceeds = np.zeros(judged.TURN_MEASURES)
        kernel.judge_turn(self._handle, np.array(exact), exceeds)
        shares = exceeds.tolist()
        return {name: shares[kind] for kind, name in LIMITS.items() if shares[kind] > -1.0}
