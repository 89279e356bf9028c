"""The goal of a search for a turn, and the unknowns of the turns searched."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from benchdragon.errors import InputError, finite, positive
from benchdragon.i18n import N_, _
from benchdragon.model.turns import Turn
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan

# A limit may be exceeded by this share; rates are kept below theirs by the other, if seen truly.
EXCEEDED, PRUDENCE = 1e-7, 1e-8
# Joints lie no deeper than this share of the disc's radius, arcs are no wider than the other;
# clothoids are no longer, m.
DEEPEST, WIDEST, LONGEST_EASE = 0.3, 0.75, 4.0
# A bend is wider than half a link by this share: at that the last bench would stand square to it.
WIDER = 1.001

OBJECTIVES = {
    "length": N_("shortest turn"),
    "way": N_("shortest path inside the disc"),
    "speed": N_("greatest head speed"),
    "disc": N_("smallest disc"),
    "acceleration": N_("least peak total acceleration"),
}


@dataclass(frozen=True)
class TurnGoal:
    """The goal of a search for a turn, and its constraints besides the plan's limits.

    Attributes:
        objective: one of OBJECTIVES.
        least_radius: of any bend, m.
        longest: length of the turn itself, m.
        longest_way: whole way inside the disc, m.

    Examples:
        >>> bd.TurnGoal().objective
        'way'
    """

    objective: str = "way"
    least_radius: float = 0.0
    longest: float = math.inf
    longest_way: float = math.inf

    def __post_init__(self) -> None:
        if self.objective not in OBJECTIVES:
            text = _("expected one of {known}, not {name}")
            raise InputError(text.format(known=", ".join(OBJECTIVES), name=self.objective))
        finite("least_radius", self.least_radius, "m")
        for name in ("longest", "longest_way"):
            if math.isfinite(getattr(self, name)):
                positive(name, getattr(self, name), "m")


class TurnFamily:
    """The turns of a plan's family, by their unknowns.

    Attributes:
        dragon: that of the plan.
        narrowest: the least radius of a bend, m.
    """

    def __init__(self, plan: Plan, goal: TurnGoal) -> None:
        route = plan.route
        if not isinstance(route, TurnRoute):
            raise InputError(_("a best turn is sought for plans whose route is a turn"))
        if not route.once:
            text = _("a best turn is sought for a coil that is walked once: take out {keys}")
            raise InputError(text.format(keys="route.rounds, route.street"))
        self.plan, self.goal = plan, goal
        self.pitch, self.disc = route.pitch, TurnRoute.disc(plan)
        self.obstacles = [route.unplaced(obstacle) for obstacle in plan.obstacles()]
        self.dragon = plan.dragon.build()
        self.narrowest = max(WIDER * 0.5 * self.dragon.longest_link, goal.least_radius)

    @property
    def bounds(self) -> list[tuple[float, float]]:
        """Ranges of the unknowns: joints, what the family has, and the clothoids' length if free."""
        table, disc = self.plan.turn, self.disc
        joints = [
            (DEEPEST * disc, disc) if radius is None else (radius, radius)
            for radius in (table.entry_radius, table.exit_radius)
        ]
        radius = (self.narrowest, max(WIDEST * disc, 1.01 * self.narrowest))
        inner = {
            "arc-arc": [(math.log(0.2), math.log(5.0))],
            "arc-line-arc": [radius, radius],
            "arc-arc-arc": [radius, (-1.0 / self.narrowest, 1.0 / self.narrowest), radius],
        }[table.family]
        ease = [(0.0, LONGEST_EASE)] if self.goal.objective == "acceleration" else []
        return [*joints, *inner, *ease]

    def table(self, x: Sequence[float]) -> dict[str, object]:
        """The [turn] of a plan with these unknowns."""
        family = self.plan.turn.family
        entry, exit_, *inner = x
        said: dict[str, object] = {"entry_radius": entry, "exit_radius": exit_}
        if self.goal.objective == "acceleration":
            said["ease"] = inner.pop()
        if family == "arc-arc":
            return {**said, "ratio": math.exp(inner[0])}
        if family == "arc-arc-arc":
            said["curvature"] = inner.pop(1)
        return {**said, "radii": (inner[0], inner[1])}

    def turn(self, x: Sequence[float]) -> Turn:
        """The turn of these unknowns.

        Raises:
            InputError: if there is none.
        """
        table = self.plan.turn.model_copy(update=self.table(x))
        return table.build(self.pitch, self.disc)

    def with_turn(self, x: Sequence[float]) -> Plan:
        """The plan with the turn of these unknowns."""
        return self.plan.with_values({f"turn.{name}": value for name, value in self.table(x).items()})
