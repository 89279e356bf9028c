"""Plan files: a dragon, a route and a walk as TOML, checked once, at the door.

Metres, seconds and degrees, or a string with a unit ("55 cm", "3 min 12 s"). Keys are English.
"""

import difflib
import hashlib
import json
import math
from collections.abc import Sequence
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator
from pydantic_core import ErrorDetails

from benchdragon.curves import AnyCurve, Arc, Clothoid, Line, Route, Spiral
from benchdragon.dragon import MOST_BENCHES, Bench, Dragon
from benchdragon.errors import InputError
from benchdragon.leader import SpeedProfile
from benchdragon.messages import _
from benchdragon.motion import Walk
from benchdragon.plan_text import PlanError, quantity, read_toml
from benchdragon.turns import Turn, three_pieces, two_arcs

# A spiral or a profile of more than this many parts is a mistake, not a dance.
MOST_PARTS = 10_000

# Radii of arcs that a plan does not say are this share of what two equal arcs alone would have.
ROOMY = 0.9
# A turn may reach so far out of its disc, m: rounding, and what lies between samples.
FITS = 1e-3

METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0, "米": 1.0, "厘米": 0.01}
SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0, "ms": 0.001, "秒": 1.0, "分": 60.0}
DEGREES = {"deg": 1.0, "°": 1.0, "rad": 180.0 / math.pi, "turn": 360.0, "turns": 360.0, "圈": 360.0}
SPEEDS = {"m/s": 1.0, "km/h": 1.0 / 3.6, "cm/s": 0.01, "米/秒": 1.0}


def _unit(units: dict[str, float]) -> BeforeValidator:
    return BeforeValidator(lambda value: quantity(value, units), json_schema_input_type=float | str)


Number = Annotated[float, _unit({}), Field(allow_inf_nan=False)]
Metres = Annotated[float, _unit(METRES), Field(allow_inf_nan=False)]
Seconds = Annotated[float, _unit(SECONDS), Field(allow_inf_nan=False)]
Degrees = Annotated[float, _unit(DEGREES), Field(allow_inf_nan=False)]
Speed = Annotated[float, _unit(SPEEDS), Field(allow_inf_nan=False, ge=0.0)]
Length = Annotated[Metres, Field(gt=0.0)]


class Table(BaseModel):
    """A table of a plan: unknown keys are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, hide_input_in_errors=False)


class MetaTable(Table):
    """What people call the plan."""

    title: str = ""
    title_zh: str = ""
    author: str = ""
    notes: str = ""


class BenchTable(Table):
    """One bench of its own size; `count` repeats it."""

    length: Length
    width: Length = 0.30
    front_inset: Annotated[Metres, Field(ge=0.0)] = 0.275
    rear_inset: Annotated[Metres, Field(ge=0.0)] = 0.275
    count: Annotated[int, Field(ge=1, le=MOST_BENCHES, strict=True)] = 1


class DragonTable(Table):
    """The dragon: one set of sizes, or `[[dragon.bench]]` for each bench its own."""

    benches: Annotated[int, Field(ge=1, le=MOST_BENCHES, strict=True)] = 223
    width: Length = 0.30
    head_length: Length = 3.41
    body_length: Length = 2.20
    tail_length: Length = 2.20
    front_inset: Annotated[Metres, Field(ge=0.0)] = 0.275
    rear_inset: Annotated[Metres, Field(ge=0.0)] = 0.275
    bench: list[BenchTable] = Field(default_factory=list)

    @model_validator(mode="after")
    def _one_way_of_sizes(self) -> Self:
        others = self.model_fields_set - {"bench"}
        if self.bench and others:
            raise ValueError(
                _("dragon.bench lists every bench: take {names} out").format(
                    names=", ".join(f"dragon.{name}" for name in sorted(others))
                )
            )
        return self

    def build(self) -> Dragon:
        """The dragon."""
        if not self.bench:
            return Dragon.uniform(**self.model_dump(exclude={"bench"}))
        if sum(bench.count for bench in self.bench) > MOST_BENCHES:
            raise InputError(
                _("a dragon has 1 to {most} benches, not {count}").format(
                    most=MOST_BENCHES, count=sum(bench.count for bench in self.bench)
                )
            )
        return Dragon(
            [
                Bench(bench.length, bench.width, bench.front_inset, bench.rear_inset)
                for bench in self.bench
                for _copy in range(bench.count)
            ]
        )


class LinePart(Table):
    """A straight line."""

    kind: Literal["line"]
    length: Length

    def build(self) -> AnyCurve:
        """The curve, at the origin."""
        return Line(self.length)


class ArcPart(Table):
    """A circular arc; a positive angle turns left."""

    kind: Literal["arc"]
    radius: Length
    angle: Degrees

    def build(self) -> AnyCurve:
        """The curve, at the origin."""
        return Arc(self.radius, math.radians(self.angle))


class ClothoidPart(Table):
    """A curve whose curvature changes evenly; positive curvature, 1/m, turns left."""

    kind: Literal["clothoid"]
    length: Length
    start_curvature: Number = 0.0
    end_curvature: Number = 0.0

    def build(self) -> AnyCurve:
        """The curve, at the origin."""
        return Clothoid(self.length, self.start_curvature, self.end_curvature)


class SpiralPart(Table):
    """An Archimedean spiral from one radius to another; as first part its centre is the origin."""

    kind: Literal["spiral"]
    pitch: Length
    start_radius: Annotated[Metres, Field(ge=0.0)]
    end_radius: Annotated[Metres, Field(ge=0.0)]
    clockwise: bool = True

    def build(self) -> AnyCurve:
        """The curve, its centre at the origin."""
        inward = self.end_radius < self.start_radius
        return Spiral.between(
            self.pitch, self.start_radius, self.end_radius, mirrored=inward != self.clockwise
        )


Part = Annotated[LinePart | ArcPart | ClothoidPart | SpiralPart, Field(discriminator="kind")]


class SpiralInRoute(Table):
    """In along one spiral, from a turn number at theta = 0 of the last turn, to disc or centre."""

    kind: Literal["spiral-in"]
    pitch: Length = 0.55
    start_turn: Annotated[Number, Field(gt=0.0, le=1e6)] = 16.0
    clockwise: bool = True

    def build(self, plan: "Plan") -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0."""
        k = self.pitch / (2.0 * math.pi)
        end = plan.disc.radius / k if plan.disc.radius is not None else 0.0
        start = 2.0 * math.pi * self.start_turn
        if end >= start:
            raise InputError(
                _(
                    "disc.radius ({disc} m) must be smaller than the radius of start_turn ({start} m)"
                ).format(disc=f"{plan.disc.radius:g}", start=f"{start * k:g}")
            )
        return Route((Spiral(self.pitch, start, end, mirrored=not self.clockwise),)), 0.0

    def last_position(self, walk: Walk) -> float:
        """The head's route position at the end of the walk, m."""
        return walk.route.length


class TurnRoute(Table):
    """In along a spiral, the turn of `[turn]` inside the disc, out along the spiral's twin."""

    kind: Literal["turn"]
    pitch: Length = 1.7

    def build(self, plan: "Plan") -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0: where the turn begins."""
        turn = self.turn(plan)
        route = turn.route(trail=plan.dragon_length + 1000.0)
        return route, float(route.joints[1])

    def turn(self, plan: "Plan") -> Turn:
        """The turn itself.

        Raises:
            InputError: if there is no such turn, it does not fit the disc, or no bench could follow.
        """
        disc = self.disc(plan)
        turn = plan.turn.build(self.pitch, disc)
        for name in ("entry_radius", "exit_radius"):
            if getattr(turn, name) > disc:
                raise InputError(
                    _("turn.{name} ({radius} m) must not exceed disc.radius ({disc} m)").format(
                        name=name, radius=f"{getattr(turn, name):g}", disc=f"{disc:g}"
                    )
                )
        if turn.extent > disc + FITS:
            raise InputError(
                _("the turn reaches {reach} m from the centre, out of a disc of {disc} m").format(
                    reach=f"{turn.extent:.4g}", disc=f"{disc:g}"
                )
            )
        link = float(plan.dragon.build().links.max())
        if 2.0 * turn.least_radius <= link:
            raise InputError(
                _(
                    "a bench with {link} m between its handles cannot follow a bend of {radius} m "
                    "radius: it must be wider than {least} m"
                ).format(link=f"{link:g}", radius=f"{turn.least_radius:.4g}", least=f"{0.5 * link:g}")
            )
        return turn

    @staticmethod
    def disc(plan: "Plan") -> float:
        """Radius of the turning space, m: the paper's, if the plan does not say."""
        return 4.5 if plan.disc.radius is None else plan.disc.radius

    def last_position(self, walk: Walk) -> float:
        """The head's route position when the tail has left the turn, m."""
        return walk.head_where_tail(float(walk.route.joints[-2]))


class PartsRoute(Table):
    """Any parts, each moved to where the one before it ends."""

    kind: Literal["parts"]
    part: Annotated[list[Part], Field(min_length=1, max_length=MOST_PARTS)]
    start: tuple[Metres, Metres] | None = None
    heading: Degrees | None = None

    def build(self, _plan: "Plan") -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0: at its start."""
        curves = [part.build() for part in self.part]
        if self.start is not None or self.heading is not None:
            point, heading = curves[0].start_pose
            if self.heading is not None:
                heading = math.radians(self.heading)
            curves[0] = curves[0].moved(self.start or point, heading)
        return Route.joined(curves), 0.0

    def last_position(self, walk: Walk) -> float:
        """The head's route position at the end of the walk, m."""
        return walk.route.length


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
    ratio: Annotated[Number, Field(gt=0.0)] = 2.0
    radii: tuple[Length, Length] | None = None
    curvature: Number = 0.0
    entry_radius: Length | None = None
    exit_radius: Length | None = None
    ease: Annotated[Metres, Field(ge=0.0)] = 0.0

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
        if not self.profile:
            return SpeedProfile.constant(self.speed)
        times, speeds = zip(*self.profile, strict=True)
        return SpeedProfile(times, speeds)


class LimitsTable(Table):
    """What a walk must keep.

    Greatest speed and acceleration (m/s^2) of any handle, turning rate (degrees a second) of any bench,
    change of the head's own speed (m/s^2), and distance of benches but neighbours.
    """

    speed: Annotated[Speed, Field(gt=0.0)] | None = None
    acceleration: Annotated[Number, Field(gt=0.0)] | None = None
    turning_rate: Annotated[Degrees, Field(gt=0.0)] | None = None
    head_acceleration: Annotated[Number, Field(gt=0.0)] = 0.5
    margin: Annotated[Metres, Field(ge=0.0)] = 0.0


class Plan(Table):
    """A whole plan."""

    schema_: Annotated[Literal[1], Field(alias="schema")]
    meta: MetaTable = MetaTable()
    dragon: DragonTable = DragonTable()
    route: Annotated[SpiralInRoute | TurnRoute | PartsRoute, Field(discriminator="kind")]
    disc: DiscTable = DiscTable()
    turn: TurnTable = TurnTable()
    walk: WalkTable = WalkTable()
    limits: LimitsTable = LimitsTable()

    @property
    def sha256(self) -> str:
        """Name of everything that the plan says, titles and notes left out."""
        data = self.model_dump(mode="json", by_alias=True, exclude={"meta"})
        return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()

    @property
    def dragon_length(self) -> float:
        """From the first handle to the last, m, along the benches."""
        return float(self.dragon.build().links.sum())

    def title(self, language: str) -> str:
        """What to call it in a language, "en" or "zh"."""
        english, chinese = self.meta.title, self.meta.title_zh
        return (chinese or english) if language == "zh" else (english or chinese)

    def value(self, key: str) -> float:
        """The number under a dotted key.

        Raises:
            PlanError: if the plan does not say it.
        """
        at: Any = self
        for name in key.split("."):
            at = getattr(at, name, None)
        if not isinstance(at, int | float):
            raise PlanError(_("the plan does not say {key}: set it").format(key=key))
        return float(at)

    def toml(self) -> str:
        """The plan as a plan file; what is as by default is left out."""
        import tomlkit  # needed by what writes plans alone

        return tomlkit.dumps(self.model_dump(mode="json", by_alias=True, exclude_defaults=True))

    def with_value(self, key: str, value: float) -> Self:
        """The same plan with another number under a dotted key.

        Raises:
            PlanError: for a size of the dragon where the plan lists every bench.
        """
        table, name = key.split(".")
        if table == "dragon" and self.dragon.bench:
            raise PlanError(_("the plan lists every bench: {key} says nothing there").format(key=key))
        changed = getattr(self, table).model_copy(update={name: value})
        return self.model_copy(update={table: changed})

    def span(self, walk: Walk) -> tuple[float, float]:
        """Start and end of the whole walk, s: as the plan says, else as its route's kind says.

        Raises:
            PlanError: if the head never comes to the end.
        """
        start = 0.0 if self.walk.start is None else self.walk.start
        if self.walk.end is not None:
            return start, self.walk.end
        end = walk.profile.time(self.route.last_position(walk) - walk.start)
        if not math.isfinite(end):
            raise PlanError(_("the head never comes to the end of its walk: set walk.end"))
        return start, end

    def build(self) -> Walk:
        """The walk that the plan describes.

        Raises:
            PlanError: for sizes that cannot be, or parts that do not join.
        """
        try:
            route, start = self.route.build(self)
            position = start if self.walk.position is None else self.walk.position
            return Walk(self.dragon.build(), route, self.walk.build(), position)
        except InputError as error:
            raise PlanError(str(error)) from None


def read_plan(source: str, settings: Sequence[str] = ()) -> Plan:
    """The plan of a file or of a built-in name, with "KEY=VALUE" settings laid over it.

    Raises:
        PlanError: saying where, what was wanted and what came.
    """
    return checked(read_toml(source, settings), source)


def checked(data: dict[str, Any], source: str) -> Plan:
    """The plan in parsed TOML; `source` is named in errors.

    Raises:
        PlanError: for the first thing that is wrong.
    """
    route = data.get("route")
    if isinstance(route, dict) and "part" in route:
        route.setdefault("kind", "parts")
    try:
        return Plan.model_validate(data)
    except ValidationError as error:
        raise PlanError(f"{source}: {error_sentence(error.errors()[0], data)}") from None


def error_sentence(error: ErrorDetails, data: dict[str, Any]) -> str:
    """One validation error of `data` in the language in use."""
    path = [str(step) for step in error["loc"]]
    where = ".".join(step for i, step in enumerate(path) if not _is_tag(path, i, data))
    kind, context = error["type"], error.get("ctx", {})
    if kind == "extra_forbidden":
        known = _known_keys(path[:-1])
        near = difflib.get_close_matches(path[-1], known, 1)
        hint = _("; did you mean {name}?").format(name=near[0]) if near else ""
        return _("{where} is not a known key").format(where=where) + hint
    if kind == "missing":
        return _("{where} is missing").format(where=where)
    wanted = {
        "greater_than": _("more than {gt}"),
        "greater_than_equal": _("at least {ge}"),
        "less_than_equal": _("at most {le}"),
        "finite_number": _("a finite number"),
        "float_type": _("a number"),
        "float_parsing": _("a number"),
        "int_type": _("a whole number"),
        "int_parsing": _("a whole number"),
        "int_from_float": _("a whole number"),
        "bool_type": _("true or false"),
        "bool_parsing": _("true or false"),
        "string_type": _("text"),
        "string_pattern_mismatch": _("text like {pattern}"),
        "list_type": _("a list"),
        "tuple_type": _("a list"),
        "literal_error": "{expected}",
        "union_tag_invalid": "{expected_tags}",
        "model_type": _("a table"),
        "model_attributes_type": _("a table"),
        "dict_type": _("a table"),
        "union_tag_not_found": _("a table with the key kind"),
        "too_short": _("at least {min_length} entries"),
        "too_long": _("at most {max_length} entries"),
    }.get(kind)
    if wanted is None:
        return f"{where}: {context.get('error', error['msg'])}"
    came = json.dumps(error["input"], ensure_ascii=False, default=str)
    if kind == "union_tag_invalid":
        came, where = json.dumps(context.get("tag"), ensure_ascii=False), f"{where}.kind"
    came = came if len(came) <= 60 else came[:57] + "..."
    return _("{where}: wanted {wanted}, not {came}").format(
        where=where, wanted=wanted.format(**context).replace(" or ", ", "), came=came
    )


def _is_tag(path: list[str], i: int, data: Any) -> bool:
    """Whether step i names the kind of a union and not a key of the plan."""
    for step in path[:i]:
        if isinstance(data, list) and step.isdigit() and int(step) < len(data):
            data = data[int(step)]
        elif isinstance(data, dict) and step in data:
            data = data[step]
    return isinstance(data, dict) and data.get("kind") == path[i] and path[i] not in data


def _known_keys(path: list[str]) -> list[str]:
    """Keys allowed in the table at `path` of a plan."""
    tables: dict[str, type[Table]] = {
        "": Plan, "meta": MetaTable, "dragon": DragonTable, "disc": DiscTable, "turn": TurnTable,
        "walk": WalkTable, "limits": LimitsTable, "spiral-in": SpiralInRoute, "parts": PartsRoute,
        "bench": BenchTable,
        "line": LinePart, "arc": ArcPart, "clothoid": ClothoidPart, "spiral": SpiralPart,
    }  # fmt: skip
    names = [step for step in path if not step.isdigit()]
    table = tables.get(names[-1] if names else "", Plan)
    if names == ["route", "turn"]:
        table = TurnRoute
    return [field.alias or name for name, field in table.model_fields.items()]
