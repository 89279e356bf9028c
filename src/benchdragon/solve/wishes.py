"""What a village asks for: its benches, its people, its square; and the plan of a dance for it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from benchdragon.errors import InputError, as_number
from benchdragon.i18n import N_, _, both
from benchdragon.model.base_curve import Point
from benchdragon.plans.answers import MOST_BEARERS, MOST_BENCHES
from benchdragon.plans.schema import Plan, checked
from benchdragon.plans.tables import MOST_ROUNDS

Carry = Literal["beside", "under"]
Kind = Literal["turn", "spiral-in"]
NAME = "benchdragon new"

# Assumed of people, m: shoulders' breadth, which is the room beside a bench or under it; and, unless
# measured, how far benches sway and bearers stray.
SHOULDERS, SWAY, IMPRECISION = 0.5, 0.05, 0.1
# Asked for beyond that, m: between benches, and from the edge of the square.
MARGIN, VENUE_MARGIN = 0.05, 0.5
# The length of a bench that a bearer needs, m.
ELBOWS = 0.5
# Rounds after which a dance covers no more ground.
AGAIN = 2
# Corners of a round square.
CORNERS = 90
TITLE = N_("A bench dragon on our square")


@dataclass(frozen=True)
class Wishes:
    """The data that a village gives of its dragon and its square: m, m/s.

    Attributes:
        benches: how many, head and tail included.
        length: of a bench.
        width: of a bench.
        head_length: of the head's bench.
        inset: from a bench's ends to its holes.
        rectangle: length and width of the square; or
        radius: of a round one; or
        boundary: the corners of its edge, in order.
        rounds: how many times the dance coils in and out, where that fits; else it coils once.
        bearers: people who carry one bench.
        carry: whether they walk beside it or under it.
        speed: of the head, at most.
        most_speed: the greatest at which a bench can be carried.
        kind: of the dance; None: coiling in and out again, where it fits, else coiling in.
        roster: a list of names beside the plan.
        sway: how far benches sway to a side.
        imprecision: how far bearers stray from their line.
        measured: which of these two were measured; the others are assumed.
        obstacles: on the square, tables as in a plan.
        street: that leads to the dance, a table as in a plan, where a dance fits to which it leads.

    Examples:
        >>> bd.Wishes(30, 2.0, 0.3, rectangle=(20.0, 20.0)).benches
        30
    """

    benches: int
    length: float
    width: float
    head_length: float = 2.0
    inset: float = 0.15
    rectangle: tuple[float, float] | None = None
    radius: float | None = None
    bearers: int = 2
    carry: Carry = "beside"
    speed: float = 0.8
    most_speed: float = 1.5
    kind: Kind | None = None
    roster: str = ""
    sway: float = SWAY
    imprecision: float = IMPRECISION
    measured: frozenset[str] = frozenset()
    obstacles: tuple[Mapping[str, Any], ...] = ()
    boundary: tuple[Point, ...] | None = None
    rounds: int = 1
    street: Mapping[str, Any] | None = None

    def __post_init__(self) -> None:
        """Refuse what is no number."""
        names = ("benches", "length", "width", "head_length", "inset", "bearers", "speed", "rounds")
        for name in (*names, "sway", "imprecision"):
            as_number(name, getattr(self, name))

    @property
    def stray(self) -> float:
        """How far a bench with its bearers may be from where it should, m."""
        return self.sway + self.imprecision

    @property
    def between(self) -> float:
        """What two benches with their bearers keep from one another, m: each sways and strays."""
        return MARGIN + 2.0 * self.stray

    @property
    def beside(self) -> float:
        """Room for bearers on each side of a bench, m, rounded up to a centimetre."""
        if self.carry == "beside":
            return SHOULDERS
        return max(0.0, rounded_up(0.5 * (SHOULDERS - self.width), 0.01))

    @property
    def venue(self) -> dict[str, Any]:
        """The edge of the square, as a plan has it."""
        if self.rectangle is not None:
            return {"rectangle": list(self.rectangle)}
        return {"boundary": [list(corner) for corner in self.corners]}

    @property
    def corners(self) -> Sequence[Point]:
        """The corners of the square's edge, in order, m."""
        if self.rectangle is not None:
            length, width = self.rectangle
            return [(0.0, 0.0), (length, 0.0), (length, width), (0.0, width)]
        return _round(self.radius or 0.0) if self.boundary is None else self.boundary

    def plan(self, kind: Kind, pitch: float, disc: float, ahead: float) -> Plan:
        """The plan of a dance about the middle of its square, with so much room before the head, m.

        It coils in and out AGAIN times at most.
        """
        rounds = min(self.rounds, AGAIN) if kind == "turn" else 1
        title = both(lambda: _(TITLE))
        people: dict[str, Any] = {
            "beside": self.beside, "ahead": ahead, "sway": self.sway,
            "imprecision": self.imprecision, "most_speed": self.most_speed,
        }  # fmt: skip
        sources = {name: _("measured by the troupe") for name in sorted(self.measured)}
        people |= {"source": sources} if sources else {}
        data = {
            "schema": 1,
            "meta": {"title": title.en, "title_zh": title.zh},
            "dragon": {
                "benches": self.benches, "width": self.width, "head_length": self.head_length,
                "body_length": self.length, "tail_length": self.length,
                "front_inset": self.inset, "rear_inset": self.inset,
            },
            "route": {"kind": kind, "pitch": pitch} | ({"rounds": rounds} if rounds > 1 else {}),
            "disc": {"radius": disc},
            "walk": {"speed": self.speed},
            "limits": {"speed": self.most_speed, "margin": MARGIN, "venue_margin": VENUE_MARGIN},
            "venue": self.venue,
            "people": people | ({"roster": self.roster} if self.roster else {}),
        }  # fmt: skip
        said = data | ({"obstacle": [dict(one) for one in self.obstacles]} if self.obstacles else {})
        return checked(said, NAME)


def _round(radius: float) -> list[Point]:
    """The corners of a round square, to a millimetre, m."""
    angles = [2.0 * math.pi * n / CORNERS for n in range(CORNERS)]
    # + 0.0 makes -0.0 a 0.0
    return [
        (round(radius * math.cos(angle), 3) + 0.0, round(radius * math.sin(angle), 3) + 0.0)
        for angle in angles
    ]


def rounded_up(value: float, step: float) -> float:
    """The next multiple of a step, upwards, as a short decimal."""
    return round(math.ceil(value / step - 1e-9) * step, 6)


def rounded_down(value: float, step: float) -> float:
    """The next multiple of a step, downwards, as a short decimal."""
    return round(math.floor(value / step + 1e-9) * step, 6)


def refuse(wishes: Wishes) -> None:
    """Refuse impossible wishes before anything is computed."""
    if [wishes.rectangle, wishes.radius, wishes.boundary].count(None) != 2:
        raise InputError(_("say how large the square is: its rectangle, its radius or its corners"))
    if not 2 <= wishes.benches <= MOST_BENCHES:
        text = _("a dance is proposed for 2 to {most} benches, not {count}")
        raise InputError(text.format(most=MOST_BENCHES, count=wishes.benches))
    if not 1 <= wishes.bearers <= MOST_BEARERS:
        text = _("a bench is carried by 1 to {most} people, not {count}")
        raise InputError(text.format(most=MOST_BEARERS, count=wishes.bearers))
    if wishes.rounds > 1 and wishes.kind == "spiral-in":
        raise InputError(_("a dance that coils in alone has no rounds: ask for either"))
    if not 1 <= wishes.rounds <= MOST_ROUNDS:
        text = _("a dance coils in and out 1 to {most} times, not {count}")
        raise InputError(text.format(most=MOST_ROUNDS, count=wishes.rounds))
    behind = math.ceil(wishes.bearers / 2) if wishes.carry == "beside" else wishes.bearers
    if behind * ELBOWS > wishes.length:
        text = _("a bench of {length} m has no room for {count} bearers behind one another")
        raise InputError(text.format(length=f"{wishes.length:g}", count=behind))
