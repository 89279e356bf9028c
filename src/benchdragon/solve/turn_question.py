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
# Limits by the figures that they limit, in the engine's order.
LIMITS = {
    told_of.BEND: "radius", told_of.REACH: "disc", told_of.LONG: "length", told_of.WAY: "way",
    **{quantity.kind: quantity.name for quantity in QUANTITIES.values()},
    told_of.APART: "clearance", told_of.BESIDE: "obstacles",
}  # fmt: skip


class Seen(NamedTuple):
    """A turn that was found: its unknowns, and what was seen of each of turn_trial.KINDS; else NaN."""

    x: list[float]
    figures: list[float]
    exceeds: float  # by what share a limit at most

    @property
    def allowed(self) -> bool:
        """Whether limits seem kept."""
        return self.exceeds <= EXCEEDED


def told_of_limits(family: TurnFamily) -> FloatArray:
    """A family's numbers as the engine takes them: see kernels/turn_trial.py."""
    plan, goal = family.plan, family.goal
    known = {
        told_of.FAMILY: FAMILIES[plan.turn.family],
        told_of.EASE: math.nan if goal.objective == "acceleration" else plan.turn.ease,
        told_of.PITCH: family.pitch,
        told_of.DISC: family.disc,
        told_of.NARROWEST: family.narrowest,
        told_of.HEAD: plan.walk.speed,
        told_of.LONGEST: goal.longest,
        told_of.LONGEST_WAY: goal.longest_way,
        told_of.MARGIN: plan.limits.margin,
        told_of.SOUGHT: SOUGHT[goal.objective],
    }
    for name, limit in given_limits(plan).items():
        if QUANTITIES[name].kind != SOUGHT[goal.objective]:
            known[told_of.LIMIT + QUANTITIES[name].kind] = limit
    return np.array([known.get(column, math.inf) for column in range(told_of.TOLD)])


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
        found, seen = np.zeros(len(low)), np.zeros(told_of.KINDS)
        super().__init__(
            handle, kernel.step_turn, kernel.read_turn, np.zeros(kernel.FIGURES), found, seen
        )
        self._found_at, self._seen = found, seen
        self.factors = [1.0 + PRUDENCE] * told_of.RATES + [1.0] * (told_of.KINDS - told_of.RATES)
        for kind in (told_of.APART, told_of.BESIDE):
            self.factors[kind] = 0.0

    @property
    def tried(self) -> int:
        """How many turns were tried."""
        return int(self.figures[kernel.TRIED])

    def best(self, progress: Progress, text: str) -> Seen:
        """The best turn that is found all over the family."""
        return self._sought(kernel.ALL, self._found_at.tolist(), progress, text)

    def near(self, x: Sequence[float], progress: Progress, text: str) -> Seen:
        """The best turn downhill from these unknowns."""
        return self._sought(kernel.NEAR, x, progress, text)

    def _sought(self, what: int, x: Sequence[float], progress: Progress, text: str) -> Seen:
        kernel.seek_turn(self._handle, what, np.array(x), np.array(self.factors))
        while self.step() == MORE:
            progress(float(self.figures[kernel.SHARE]), text)
        exceeds = float(self.figures[kernel.EXCEEDS])
        return Seen(self._found_at.tolist(), self._seen.tolist(), exceeds)

    def correct(self, seen: Sequence[float], exact: Sequence[float], prudence: float) -> None:
        """Set the engine's corrections of sampled figures near a turn, and somewhat more."""
        for kind, (one, other) in enumerate(zip(seen, exact, strict=True)):
            if not math.isfinite(one) or not math.isfinite(other):
                continue
            if kind < told_of.RATES:
                self.factors[kind] = other / one * (1.0 + prudence)
            elif kind in (told_of.APART, told_of.BESIDE):
                self.factors[kind] = max(other - one + prudence, 0.0)

    def exceeded(self, exact: Sequence[float]) -> dict[str, float]:
        """By what share exact figures exceed their limits, by the names of those that there are."""
        exceeds = np.zeros(told_of.KINDS)
        kernel.judge_turn(self._handle, np.array(exact), exceeds)
        shares = exceeds.tolist()
        return {name: shares[kind] for kind, name in LIMITS.items() if shares[kind] > -1.0}
