"""The tables of a plan file: benches, curves, turn, walk and limits, checked once on input.

Metres, seconds and degrees, or a string with a unit ("55 cm", "3 min 12 s"). Keys are English.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal, get_args

import numpy as np
from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field

from benchdragon.errors import InputError, brief
from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import MOST_METRES
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line, LogSpiral, Spiral
from benchdragon.model.dragon import MOST_BENCHES, Dragon, SizeError
from benchdragon.model.profile import SpeedProfile
from benchdragon.model.turns import Turn, three_pieces, two_arcs
from benchdragon.plans.source import Fault, KeyedError
from benchdragon.plans.units import (
    ACCELERATIONS,
    ANGULAR_SPEEDS,
    DEGREES,
    METRES,
    SECONDS,
    SPEEDS,
    quantity,
)

# A spiral or a profile of more than this many parts is a mistake, not a dance.
MOST_PARTS = 10_000

# Times that a dance may go in and out.
MOST_ROUNDS = 20

# Radii of arcs that a plan does not say are this share of what two equal arcs alone would have.
ROOMY = 0.9


# The least size, speed, acceleration or turning rate that is not 0, in m, s and degrees: a micrometre.
# Smaller values are input errors, and their inverses spoil sums.
LEAST = 1e-6
# m; in narrower spirals rounding opens gaps.
LEAST_PITCH = 1e-3
# 30 years; 2,700 full turns; a bend of the least radius, 1/m.
MOST_SECONDS = 1e9
MOST_DEGREES = 1e6
MOST_CURVATURE = 1e6
# The longest clothoid of a turn, m.
MOST_EASE = 1e3


def _unit(units: dict[str, float]) -> BeforeValidator:
    return BeforeValidator(lambda value: quantity(value, units), json_schema_input_type=float | str)


def at_least(least: float) -> AfterValidator:
    """Refuses what is too near 0 to be meant."""

    def checked(value: float) -> float:
        if 0.0 < value < least:
            text = _("expected at least {least}, not {value}")
            raise ValueError(text.format(least=least, value=value))
        return value

    return AfterValidator(checked)


def _within(most: float) -> Any:
    return Field(ge=-most, le=most)


Finite = Annotated[float, Field(allow_inf_nan=False)]
Metres = Annotated[Finite, _within(MOST_METRES), _unit(METRES)]
Seconds = Annotated[Finite, _within(MOST_SECONDS), _unit(SECONDS)]
Degrees = Annotated[Finite, _within(MOST_DEGREES), _unit(DEGREES)]
Curvature = Annotated[Finite, _within(MOST_CURVATURE), _unit({})]
Speed = Annotated[Finite, Field(ge=0.0), _unit(SPEEDS), at_least(LEAST)]
Acceleration = Annotated[Finite, Field(gt=0.0), _unit(ACCELERATIONS), at_least(LEAST)]
AngularSpeed = Annotated[Finite, Field(gt=0.0), _unit(ANGULAR_SPEEDS), at_least(LEAST)]
Number = Annotated[float, _unit({}), Field(allow_inf_nan=False)]
Positive = Annotated[Finite, Field(gt=0.0, le=MOST_METRES), _unit(METRES)]
Length = Annotated[Positive, at_least(LEAST)]
Pitch = Annotated[Positive, at_least(LEAST_PITCH)]
LengthOrZero = Annotated[Finite, Field(ge=0.0, le=MOST_METRES), _unit(METRES), at_least(LEAST)]


def one_line(text: str) -> str:
    """Refuses what would break a line of a sentence or a paper, or would not be seen there."""
    if text and (text.isspace() or not text.isprintable()):
        said = _("expected text that can be printed on one line, not {text}")
        raise ValueError(said.format(text=brief(text)))
    return text


OneLine = Annotated[str, Field(max_length=255), AfterValidator(one_line)]


class Table(BaseModel):
    """A table of a plan: unknown keys are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, hide_input_in_errors=False)


class MetaTable(Table):
    """Titles of the plan."""

    title: str = ""
    title_zh: str = ""
    author: str = ""
    notes: str = ""


class BenchTable(Table):
    """One bench of its own size; `count` repeats it."""

    length: Length
    width: Length = 0.30
    front_inset: LengthOrZero = 0.275
    rear_inset: LengthOrZero = 0.275
    count: Annotated[int, Field(ge=1, le=MOST_BENCHES, strict=True)] = 1


class DragonTable(Table):
    """The dragon: one set of sizes, or `[[dragon.bench]]` for each bench its own."""

    benches: Annotated[int, Field(ge=1, le=MOST_BENCHES, strict=True)] = 223
    width: Length = 0.30
    head_length: Length = 3.41
    body_length: Length = 2.20
    tail_length: Length = 2.20
    front_inset: LengthOrZero = 0.275
    rear_inset: LengthOrZero = 0.275
    bench: list[BenchTable] = Field(default_factory=list)

    def build(self) -> Dragon:
        """The dragon."""
        try:
            return _built(self)
        except SizeError as error:
            keys: dict[str, str] = {}
            for bench, size, text in error.faults:
                keys.setdefault(self._key(bench, size), text)
            raise KeyedError([Fault(*each) for each in keys.items()]) from None

    def _key(self, bench: int, size: str) -> str:
        """The key that says a size of a bench (a row, from 0)."""
        for entry, one in enumerate(self.bench):
            if bench < one.count:
                return f"dragon.bench.{entry}.{size}"
            bench -= one.count
        last = self.benches - 1
        place = "head_" if bench == 0 else "tail_" if bench == last else "body_"
        return f"dragon.{place if size == 'length' else ''}{size}"


def _built(table: DragonTable) -> Dragon:
    if not table.bench:
        return Dragon.uniform(**table.model_dump(exclude={"bench"}))
    counts = [one.count for one in table.bench]
    if sum(counts) > MOST_BENCHES:
        text = _("a dragon has 1 to {most} benches, not {count}")
        raise InputError(text.format(most=MOST_BENCHES, count=sum(counts)))
    sizes = [[one.length, one.width, one.front_inset, one.rear_inset] for one in table.bench]
    return Dragon.of_sizes(*np.repeat(sizes, counts, axis=0).T)


@dataclass(frozen=True)
class Key:
    """What a key means.

    Args:
        text: in a few words.
        example: as it may stand in a file.
        unit: of a bare number; "" for what has none.
    """

    text: str
    example: Any
    unit: str = ""


class CurvePart(Table):
    """A part of a route: a curve that a plan may name.

    Attributes:
        about: what it is, in words.
        keys: what each key means, except `kind`, which means the same in all.
    """

    about: ClassVar[str]
    keys: ClassVar[Mapping[str, Key]]

    def build(self) -> AnyCurve:
        """The curve, at the origin."""
        raise NotImplementedError


class LinePart(CurvePart):
    """A straight line."""

    about: ClassVar[str] = N_("A straight line.")
    keys: ClassVar[Mapping[str, Key]] = {"length": Key(N_("length of the part"), "30 m", "m")}

    kind: Literal["line"]
    length: Length

    def build(self) -> AnyCurve:
        """The curve, at the origin."""
        return Line(self.length)


class ArcPart(CurvePart):
    """A circular arc; a positive angle turns left."""

    about: ClassVar[str] = N_("An arc of a circle.")
    keys: ClassVar[Mapping[str, Key]] = {
        "radius": Key(N_("radius of the circle"), 8, "m"),
        "angle": Key(N_("angle swept; positive to the left"), 90, "deg"),
    }

    kind: Literal["arc"]
    radius: Length
    angle: Degrees

    def build(self) -> AnyCurve:
        """The curve, at the origin."""
        return Arc(self.radius, math.radians(self.angle), many=True)


class ClothoidPart(CurvePart):
    """A curve whose curvature changes evenly; positive curvature, 1/m, turns left."""

    about: ClassVar[str] = N_("A clothoid: curvature changes evenly.")
    keys: ClassVar[Mapping[str, Key]] = {
        "length": Key(N_("length of the part"), 6, "m"),
        "start_curvature": Key(N_("curvature at its start; positive to the left"), 0, "1/m"),
        "end_curvature": Key(N_("curvature at its end; positive to the left"), 0.125, "1/m"),
    }

    kind: Literal["clothoid"]
    length: Length
    start_curvature: Curvature = 0.0
    end_curvature: Curvature = 0.0

    def build(self) -> AnyCurve:
        """The curve, at the origin."""
        return Clothoid(self.length, self.start_curvature, self.end_curvature)


class SpiralPart(CurvePart):
    """An Archimedean spiral from one radius to another; as first part its centre is the origin."""

    about: ClassVar[str] = N_("A spiral from one radius to another.")
    keys: ClassVar[Mapping[str, Key]] = {
        "pitch": Key(N_("distance between neighbouring turns of the spiral"), "80 cm", "m"),
        "start_radius": Key(N_("radius where the part starts"), 12, "m"),
        "end_radius": Key(N_("radius where the part ends"), 5, "m"),
        "clockwise": Key(N_("whether the dragon walks it clockwise"), True),
    }

    kind: Literal["spiral"]
    pitch: Pitch
    start_radius: LengthOrZero
    end_radius: LengthOrZero
    clockwise: bool = True

    def build(self) -> AnyCurve:
        """The curve, its centre at the origin."""
        inward = self.end_radius < self.start_radius
        ends, mirrored = (self.start_radius, self.end_radius), inward != self.clockwise
        return Spiral.between(self.pitch, *ends, (0.0, 0.0), 0.0, mirrored)


class LogSpiralPart(CurvePart):
    """A logarithmic spiral: both its curvatures, 1/m, have the same sign; positive ones turn left."""

    about: ClassVar[str] = N_("A logarithmic spiral: the radius of curvature changes evenly.")
    keys: ClassVar[Mapping[str, Key]] = {
        "length": Key(N_("length of the part"), 12, "m"),
        "start_curvature": Key(N_("curvature at its start; positive to the left"), 0.1, "1/m"),
        "end_curvature": Key(N_("curvature at its end, of the same sign"), 0.25, "1/m"),
    }

    kind: Literal["log-spiral"]
    length: Length
    start_curvature: Curvature
    end_curvature: Curvature

    def build(self) -> AnyCurve:
        """The curve, at the origin."""
        return LogSpiral(self.length, self.start_curvature, self.end_curvature)


AnyPart = LinePart | ArcPart | ClothoidPart | SpiralPart | LogSpiralPart
PARTS: tuple[type[CurvePart], ...] = get_args(AnyPart)
Part = Annotated[AnyPart, Field(discriminator="kind")]


class DiscTable(Table):
    """The turning space: a circle about the spiral's centre."""

    radius: Length | None = None


class TurnTable(Table):
    """The turn inside the disc: what lies between the joints with the spirals.

    `ratio` belongs to arc-arc, `radii` (of the first and the last arc) to the other families, and
    `curvature` (of the middle arc, 1/m, left positive) to arc-arc-arc. Clothoids of `ease` metres make
    the curvature continuous.
    """

    family: Literal["arc-arc", "arc-line-arc", "arc-arc-arc"] = "arc-arc"
    ratio: Annotated[Number, Field(gt=0.0, le=1e3), at_least(1e-3)] = 2.0
    radii: tuple[Length, Length] | None = None
    curvature: Curvature = 0.0
    entry_radius: Length | None = None
    exit_radius: Length | None = None
    ease: Annotated[LengthOrZero, Field(le=MOST_EASE)] = 0.0

    def build(self, pitch: float, disc: float) -> Turn:
        """The turn between spirals of this pitch, m, in a disc of this radius, m."""
        entry = disc if self.entry_radius is None else self.entry_radius
        exit_ = entry if self.exit_radius is None else self.exit_radius
        if self.family == "arc-arc":
            return two_arcs(pitch, entry, exit_, self.ratio, self.ease)
        radii = self.radii
        if radii is None:
            radius = ROOMY * min(two_arcs(pitch, entry, exit_, 1.0).least_radius, 0.5 * disc)
            radii = radius, radius
        bend = self.curvature if self.family == "arc-arc-arc" else 0.0
        return three_pieces(pitch, entry, exit_, radii, bend, self.ease)


class WalkTable(Table):
    """The head's walk: a constant speed, or `profile`, [time, speed] pairs joined by straight lines.

    `start` and `end` are times; `position` is the head's route position at time 0, where it is not
    to stand where the route's kind says.
    """

    speed: Speed = 1.0
    profile: Annotated[list[tuple[Seconds, Speed]], Field(max_length=MOST_PARTS)] = Field(
        default_factory=list
    )
    start: Seconds | None = None
    end: Seconds | None = None
    position: Metres | None = None

    def build(self) -> SpeedProfile:
        """The head's speed over time."""
        knots = self.profile or [(0.0, self.speed)]
        try:
            return SpeedProfile(tuple(time for time, _v in knots), tuple(speed for _t, speed in knots))
        except InputError as error:
            key = "walk.profile" if self.profile else "walk.speed"
            raise KeyedError([Fault(key, str(error))]) from None


class LimitsTable(Table):
    """The limits of a walk.

    Greatest speed and accelerations (m/s^2) of any handle: along the route, across it and in total;
    turning rate (degrees a second) of any bench, change of the head's own speed (m/s^2), and distance
    of non-adjacent benches.
    """

    speed: Annotated[Speed, Field(gt=0.0)] | None = None
    acceleration: Acceleration | None = None
    lateral_acceleration: Acceleration | None = None
    total_acceleration: Acceleration | None = None
    turning_rate: AngularSpeed | None = None
    head_acceleration: Acceleration = 0.5
    margin: LengthOrZero = 0.0
    venue_margin: LengthOrZero | None = None
