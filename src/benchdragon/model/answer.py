"""Answers: a number with its bracket, how that was established, and a witness."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from benchdragon.methods import Method
from benchdragon.number_format import at_most, finite_or_none, known

if TYPE_CHECKING:
    from benchdragon.figures import plots

# What exceeds a limit by less than this share keeps to it: bounds leave a tenth of it for rounding.
ROUNDING = 1e-11

Status = Literal["proved", "found", "infeasible", "undecided", "unlimited"]


@dataclass(frozen=True)
class Witness:
    """Where and when the value of an answer occurs.

    Attributes:
        time: s; None where time has no part in it.
        s: route position of the head's handle then, m.
        benches: the two benches, or the one, 1..N.
        point: where they meet or are nearest (the corner's side), m.
        gap: how far they then are apart, m; minus a depth where they overlap; NaN for one bench.
        features: what meets: the corner of one bench, and the side or corner of the other.
        handle: of an answer about a handle its number, 0..N: the first of those that come to the same;
            the bench is the one that it leads, the last bench for handle N.
        obstacle: of an answer about an obstacle its name; the gap is then the distance from it, m.

    Examples:
        >>> near = bd.read_plan("spiral-in").first_contact().witness
        >>> near.benches, near.features, round(near.time, 3)
        ((1, 9), ((1, 'front left'), (9, 'right')), 412.474)
    """

    time: float | None
    s: float
    benches: tuple[int, ...]
    point: tuple[float, float]
    gap: float
    features: tuple[tuple[int, str], ...] = ()
    handle: int | None = None
    obstacle: str | None = None


@dataclass(frozen=True)
class Answer:
    """A solved number.

    Attributes:
        value: the best estimate.
        lower: with upper, the bracket that was established: lower <= value <= upper.
        upper: see lower.
        unit: of the three.
        status: "found" with bounds that hold up to rounding (which they allow for), "proved" if all
            places behind it were enclosed in ball arithmetic besides, "infeasible", "undecided", or
            "unlimited" (none met up to the value).
        witness: where and when it occurs.
        assumptions: of the bracket.
        evaluations: how many times the dragon was placed to find it.
        seconds: how long that took.

    Examples:
        >>> bd.read_plan("spiral-in").first_contact()
        <Answer 412.473837682 s, found, bracket 8e-12 s wide>
        >>> answer = bd.read_plan("turn").greatest_head_speed()
        >>> answer.lower <= answer.value <= answer.upper
        True
    """

    value: float
    lower: float
    upper: float
    unit: str
    status: Status
    witness: Witness | None = None
    assumptions: tuple[str, ...] = ()
    evaluations: int = 0
    seconds: float = 0.0

    plot = plots.plot_answer if TYPE_CHECKING else Method("plot_answer")
    _repr_html_ = Method("as_html")

    def __repr__(self) -> str:
        wide = f"{self.upper - self.lower:.1g} {self.unit}"
        return f"<Answer {self.value:.12g} {self.unit}, {self.status}, bracket {wide} wide>"

    @property
    def vanishing(self) -> bool:
        """Whether rounding hides a distance that may be more than 0: then its upper end is shown."""
        return self.lower <= 0.0 <= self.value <= self.upper - self.value and self.upper > 0.0

    def sure(self, *, up: bool) -> float:
        """The upper or lower end of the bracket; the value where rounding alone lies between them."""
        end = self.upper if up else self.lower
        near = abs(end - self.value) <= ROUNDING * abs(self.value)
        return self.value if near or not math.isfinite(end) else end

    def shown(self, *, up: bool, limit: float | None = None) -> str:
        """What is surely true of it, in the digits that are known: see `number_format.known`.

        Of a distance that is `vanishing` it is what it is less than.
        """
        if not up and self.unit == "m" and self.vanishing:
            return at_most(self.upper)
        return known(self.sure(up=False), self.sure(up=True), self.unit, up=up, limit=limit)

    def keeps(self, limit: float) -> bool | None:
        """Whether the number is at most a limit, up to rounding; None where that is undecided."""
        most = limit * (1.0 + ROUNDING)
        if self.lower > most:
            return False
        return True if self.upper <= most else None

    def as_json(self, **more: Any) -> dict[str, Any]:
        """The answer as plain data, with `more` beside it; numbers that are not finite become None."""
        data = {name: getattr(self, name) for name in ("value", "lower", "upper", "unit", "status")}
        for name in ("value", "lower", "upper"):
            data[name] = finite_or_none(data[name])
        witness = self.witness
        data["witness"] = None if witness is None else dict(vars(witness))
        if witness is not None:
            data["witness"]["gap"] = finite_or_none(witness.gap)
        data["assumptions"] = list(self.assumptions)
        return {**data, "evaluations": self.evaluations, "seconds": self.seconds, **more}
