"""The proved statement about the best turn, in sentences and as data, with all its assumptions."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from benchdragon.i18n import N_, _
from benchdragon.number_format import figures, finite_or_none
from benchdragon.plans.schema import Plan
from benchdragon.solve.turn_goal import TurnFamily, TurnGoal

Ends = tuple[float, ...]

# The meaning of the numbers of each family, for readers.
NAMES = {
    "arc-arc": (N_("entry radius"), N_("exit radius"), N_("ratio r1 : r2")),
    "arc-line-arc": (N_("entry radius"), N_("exit radius"), N_("first radius"), N_("last radius")),
}


def ranges_of(family: str, low: Ends, high: Ends) -> dict[str, Ends]:
    """The ranges of a family's numbers by their names, m; the ratio by its own value."""
    found = {name: ends for name, *ends in zip(NAMES[family], low, high, strict=True)}
    if family == "arc-arc":
        name = NAMES["arc-arc"][2]
        found[name] = [math.exp(end) for end in found[name]]
    return {name: tuple(ends) for name, ends in found.items()}


@dataclass(frozen=True)
class TurnStatement:
    """The proved statement about the turns of a family, and all its assumptions except the dragon.

    Attributes:
        plan: of which it is proved.
        goal: of the search, with its constraints besides the plan's limits.
        low: the least of each number of the family.
        high: the greatest of each.
        bound: no turn is shorter, m, or lets the head walk faster, m/s; None if no turn is there.
    """

    plan: Plan
    goal: TurnGoal
    low: Ends
    high: Ends
    bound: float | None

    def sentence(self) -> str:
        """It in words, in the language in use, rounded to the side that stays true."""
        turns, objective = TurnFamily(self.plan, self.goal), self.goal.objective
        bound = 0.0 if self.bound is None else self.bound
        return _(NONE_KEEPS if self.bound is None else NONE_BETTER[objective]).format(
            family=self.plan.turn.family, ranges=self._ranges(), limits=_(", ").join(self._limits()),
            pitch=repr(turns.pitch), disc=repr(turns.disc),
            benches=len(self.plan.dragon.build().links), bound=_rounded(objective, bound),
        )  # fmt: skip

    def _ranges(self) -> str:
        said = []
        for name, (least, most) in ranges_of(self.plan.turn.family, self.low, self.high).items():
            text, ends = _("{name} {low}"), (repr(least), repr(most))
            if least != most:  # inside the ranges searched, not beside them
                text, ends = (
                    _("{name} {low} to {high}"),
                    (figures(least, up=True), figures(most, up=False)),
                )
            said.append(text.format(name=_(name), low=ends[0], high=ends[1]))
        return ", ".join(said)

    def _limits(self) -> Iterator[str]:
        """The constraints of the turns, in words."""
        kept = self.kept()
        if self.goal.objective == "speed":
            yield _("handles at most {speed} m/s").format(speed=kept["speed_limit"])
        elif kept["speed_limit"] is not None:
            text = _("handles at most {speed} m/s with the head at {head} m/s")
            yield text.format(speed=kept["speed_limit"], head=kept["head_speed"])
        yield _("arcs of radius {radius} m or more").format(radius=kept["least_radius"])
        if kept["longest"] is not None:
            yield _("a turn of at most {length} m").format(length=kept["longest"])
        if kept["longest_way"] is not None:
            yield _("a path inside the disc of at most {length} m").format(length=kept["longest_way"])

    def kept(self) -> dict[str, float | None]:
        """The limits that the turns keep, m and m/s; None where there is none."""
        goal, fastest = self.goal, self.goal.objective == "speed"
        return {
            "speed_limit": self.plan.limits.speed,
            "head_speed": None if fastest else self.plan.walk.speed,
            "least_radius": TurnFamily(self.plan, goal).narrowest,
            "longest": finite_or_none(goal.longest),
            "longest_way": finite_or_none(goal.longest_way),
        }

    def as_json(self) -> dict[str, Any]:
        """It as plain data, in SI units."""
        turns, family = TurnFamily(self.plan, self.goal), self.plan.turn.family
        ranges = ranges_of(family, self.low, self.high)
        return {
            "about": "turns", "objective": self.goal.objective, "family": family,
            "ranges": {name: list(ends) for name, ends in ranges.items()},
            "pitch": turns.pitch, "disc": turns.disc, "benches": len(self.plan.dragon.build().links),
            "limits": self.kept(), "bound": self.bound,
        }  # fmt: skip


# The statement by the objective; and the one where no turn satisfies its constraints.
NONE_BETTER = {
    "speed": N_(
        "proved: for {benches} benches, spirals of pitch {pitch} m and a disc of radius {disc} m, no "
        "turn of the family {family} ({ranges}) that keeps {limits} lets the head walk faster than "
        "{bound} m/s, whether benches touch or not"
    ),
    "length": N_(
        "proved: for {benches} benches, spirals of pitch {pitch} m and a disc of radius {disc} m, no "
        "turn of the family {family} ({ranges}) that keeps {limits} is shorter than {bound} m, "
        "whether benches touch or not"
    ),
    "way": N_(
        "proved: for {benches} benches, spirals of pitch {pitch} m and a disc of radius {disc} m, no "
        "turn of the family {family} ({ranges}) that keeps {limits} has a path inside the disc "
        "shorter than {bound} m, whether benches touch or not"
    ),
}
NONE_KEEPS = N_(
    "proved: for {benches} benches, spirals of pitch {pitch} m and a disc of radius {disc} m, no turn "
    "of the family {family} ({ranges}) keeps the limits: {limits}"
)


def _rounded(objective: str, bound: float) -> str:
    """A bound with six decimals, up if it is of speeds, else down."""
    whole = math.ceil(bound * 1e6) if objective == "speed" else math.floor(bound * 1e6)
    return f"{whole / 1e6:.6f}"
