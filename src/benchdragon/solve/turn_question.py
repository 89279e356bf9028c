"""The engine's question about the best turn: kernels/turn_question.py, asked by Python."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from benchdragon import budget
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.speed import QUANTITIES, given_limits
from benchdragon.kernels import turn_question as kernel
from benchdragon.kernels import turn_trial as told_of
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.question import MORE
from benchdragon.model.obstacle import Obstacle
from benchdragon.progress import Progress
from benchdragon.solve.turn_goal import EXCEEDED, PRUDENCE, TurnFamily

FAMILIES = {
    "arc-arc": told_of.TWO_ARCS, "arc-line-arc": told_of.LINE_BETWEEN,
    "arc-arc-arc": told_of.ARC_BETWEEN,
}  # fmt: skip
# The figure that is to be small.
SOUGHT = {
    "way": told_of.WAY, "length": told_of.LONG, "disc": told_of.REACH,
    "speed": QUANTITIES["speed"].kind, "acceleration": QUANTITIES["total_acceleration"].kind,
}  # fmt: skip
# Limits by the figures that they limit, in the order in which they are told.
LIMITS = {
    told_of.BEND: "radius", told_of.REACH: "disc", told_of.LONG: "length", told_of.WAY: "way",
    **{quantity.kind: quantity.name for quantity in QUANTITIES.values()},
    told_of.APART: "clearance", told_of.BESIDE: "obstacles",
}  # fmt: skip


class Seen(NamedTuple):
    """A turn that was found: its unknowns, and what was seen of each of turn_trial.KINDS; else NaN."""

    x: list[float]
    figures: FloatArray
    exceeds: float  # by what share a limit at most

    @property
    def keeps(self) -> bool:
        """Whether limits seem kept."""
        return self.exceeds <= EXCEEDED


def told_of_limits(family: TurnFamily) -> FloatArray:
    """What the engine is told of a family, as kernels/turn_trial.py says."""
    plan, goal, told = family.plan, family.goal, np.full(told_of.TOLD, math.inf)
    told[told_of.FAMILY] = FAMILIES[plan.turn.family]
    told[told_of.EASE] = math.nan if goal.objective == "acceleration" else plan.turn.ease
    told[told_of.PITCH], told[told_of.DISC] = family.pitch, family.disc
    told[told_of.NARROWEST], told[told_of.HEAD] = family.narrowest, plan.walk.speed
    told[told_of.LONGEST], told[told_of.LONGEST_WAY] = goal.longest, goal.longest_way
    told[told_of.MARGIN], told[told_of.SOUGHT] = plan.limits.margin, SOUGHT[goal.objective]
    for name, limit in given_limits(plan).items():
        told[told_of.LIMIT + QUANTITIES[name].kind] = limit
    if SOUGHT[goal.objective] < told_of.RATES:
        told[told_of.LIMIT + SOUGHT[goal.objective]] = math.inf
    return told


def _side(obstacle: Obstacle) -> float:
    """Where no bench may be: 1 inside, -1 outside, 0: nowhere but at the boxes."""
    return {"venue": -1.0, "line": 0.0, "circle": 0.0}.get(obstacle.kind, 1.0)


class TurnQuestion(EngineQuestion):
    """A question about the best turn of a family, open until it is closed, as by `with`.

    Attributes:
        factors: what is seen is corrected by: rates are so many times that, distances so many m less.
    """

    def __init__(self, family: TurnFamily) -> None:
        low, high = np.array(family.bounds).T.copy()
        boxes = [np.zeros((0, BOX_COLUMNS)), *(obstacle.boxes for obstacle in family.obstacles)]
        keep = [(obstacle.radius + obstacle.margin, _side(obstacle)) for obstacle in family.obstacles]
        budget.hold(8 * sum(map(np.size, boxes)))
        handle = kernel.open_turn(
            told_of_limits(family), low, high, family.more.sizes, family.more.links,
            np.concatenate(boxes), np.cumsum([len(some) for some in boxes]),
            np.array(keep).reshape(-1, 2),
        )  # fmt: skip
        told = np.zeros(kernel.FIGURES), low.copy(), np.empty(told_of.KINDS)
        super().__init__(handle, kernel.step_turn, kernel.read_turn, *told)
        self.factors = np.ones(told_of.KINDS)
        self.factors[: told_of.RATES] += PRUDENCE
        self.factors[[told_of.APART, told_of.BESIDE]] = 0.0

    @property
    def tried(self) -> int:
        """How many turns were tried."""
        return int(self.figures[kernel.TRIED])

    def best(self, progress: Progress, text: str) -> Seen:
        """The best turn that is found all over the family."""
        return self._sought(kernel.ALL, self._told[1], progress, text)

    def near(self, x: Sequence[float], progress: Progress, text: str) -> Seen:
        """The best turn downhill from these unknowns."""
        return self._sought(kernel.NEAR, np.array(x), progress, text)

    def _sought(self, what: int, x: FloatArray, progress: Progress, text: str) -> Seen:
        kernel.seek_turn(self._handle, what, x, self.factors)
        while self.step() == MORE:
            progress(float(self.figures[kernel.SHARE]), text)
        _figures, found, seen = self._told
        return Seen(found.tolist(), seen.copy(), float(self.figures[kernel.EXCEEDS]))

    def correct(self, seen: FloatArray, exact: FloatArray, prudence: float) -> None:
        """Tell the engine by how much what is seen flatters a turn like this, and somewhat more."""
        for kind in np.flatnonzero(np.isfinite(seen) & np.isfinite(exact)):
            if kind < told_of.RATES:
                self.factors[kind] = exact[kind] / seen[kind] * (1.0 + prudence)
            elif kind in (told_of.APART, told_of.BESIDE):
                self.factors[kind] = max(exact[kind] - seen[kind] + prudence, 0.0)

    def exceeded(self, exact: FloatArray) -> dict[str, float]:
        """By what share exact figures exceed their limits, by the names of those that there are."""
        exceeds = np.empty(told_of.KINDS)
        kernel.judge_turn(self._handle, exact, exceeds)
        return {name: float(exceeds[kind]) for kind, name in LIMITS.items() if exceeds[kind] > -1.0}
