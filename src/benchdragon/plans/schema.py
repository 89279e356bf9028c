"""Plan files: a dragon, a route and a walk as TOML."""

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy.typing as npt
from pydantic import Field, PrivateAttr, ValidationError

from benchdragon.errors import InputError, brief
from benchdragon.i18n import _
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.profile import SpeedProfile
from benchdragon.model.walk import Motion, Walk
from benchdragon.plans.asked import AskedPlan
from benchdragon.plans.chalk import ChalkTable
from benchdragon.plans.cue_places import heads_of
from benchdragon.plans.cues import CuesTable, Moment, Paced, outside, paced
from benchdragon.plans.drawn import SurveyTable, with_drawings
from benchdragon.plans.event import EventTable
from benchdragon.plans.faults import fault_of
from benchdragon.plans.idle import drop, drop_replaced, idle_keys
from benchdragon.plans.people import DECIDING, PeopleTable
from benchdragon.plans.routes import AnyRoute
from benchdragon.plans.source import MOST_FAULTS, Fault, Faults, Source
from benchdragon.plans.square import MOST_OBSTACLES, AnObstacle, VenueTable, built_obstacles
from benchdragon.plans.tables import (
    DiscTable,
    DragonTable,
    LimitsTable,
    MetaTable,
    Table,
    TurnTable,
    WalkTable,
)
from benchdragon.plans.toml import PlanError, Setting, read_toml, set_value, with_base

# Tables of a plan that its hash ignores, or counts only if given; those about the square.
ASIDE = ("meta", "venue", "obstacle", "survey", "people", "cues", "chalk", "event")
SQUARE = ("venue", "obstacle")
# Keys of routes that came later, and their defaults: plans without them keep their hashes.
LATER = (("street", None), ("rounds", 1), ("outer_radius", None), ("back_radius", None))


class Plan(Table, AskedPlan):
    """A whole plan."""

    schema_: Annotated[Literal[1], Field(alias="schema")]
    meta: MetaTable = MetaTable()
    dragon: DragonTable = DragonTable()
    route: AnyRoute
    disc: DiscTable = DiscTable()
    turn: TurnTable = TurnTable()
    walk: WalkTable = WalkTable()
    limits: LimitsTable = LimitsTable()
    venue: VenueTable = VenueTable()
    obstacle: Annotated[list[AnObstacle], Field(max_length=MOST_OBSTACLES)] = Field(
        default_factory=list
    )
    survey: SurveyTable = SurveyTable()
    people: PeopleTable = PeopleTable()
    cues: CuesTable = CuesTable()
    chalk: ChalkTable = ChalkTable()
    event: EventTable = EventTable()
    base: Annotated[str, Field(exclude=True)] = ""
    _source: Source = PrivateAttr(default=Source())

    def __init__(self, **tables: Any) -> None:
        """A plan of tables, as a file says them: Plan(dragon={"benches": 40}, route={...}).

        Raises:
            PlanError: for all that is wrong, a line each.

        Examples:
            >>> bd.Plan(dragon={"benches": 40}, route={"kind": "spiral-in", "pitch": 0.6})
            <Plan 'plan': spiral-in, 40 benches>
            >>> plan = bd.read_plan("spiral-in")
            >>> plan.with_value("route.pitch", 0.6).motion(100.0)
            <Motion of 224 handles at 1 times>
        """
        _fill(self, {"schema": 1, **tables}, Source())

    def __repr__(self) -> str:
        name = self.meta.title or self.source.name
        return f"<Plan {name!r}: {self.route.kind}, {len(self.chain or ())} benches>"

    __str__ = __repr__

    @property
    def source(self) -> Source:
        """Where it was read."""
        return self._source

    def said(self) -> dict[str, Any]:
        """What the plan says, and no default, table by table; None counts as not said."""
        return self.model_dump(by_alias=True, exclude_unset=True, exclude_none=True)

    def own(self) -> dict[str, Any]:
        """What is not as by default, table by table, as plain data."""
        return self.model_dump(mode="json", by_alias=True, exclude_defaults=True)

    def whole(self, with_none: bool = True) -> dict[str, Any]:
        """Every key, those left out as by default, table by table, as plain data."""
        return self.model_dump(mode="json", by_alias=True, exclude_none=not with_none)

    def _changed(self, data: dict[str, Any]) -> "Plan":
        """A plan with other content and the same source."""
        return checked(data, self._source)

    @cached_property
    def sha256(self) -> str:
        """Name of everything that the plan says, titles and notes left out.

        The square, the people's needs and cues count where given: plans without them keep their hashes.
        The location does not count, nor who dances, nor marks on the ground, nor the event.
        """
        data, own = self.whole(), self.own()
        for name in ASIDE:
            if name not in SQUARE or name not in own:
                del data[name]
        limits, route = data["limits"], data["route"]
        if limits["venue_margin"] is None:
            del limits["venue_margin"]
        if route["at"] in (None, [0.0, 0.0]):
            del route["at"]
        for name, usual in (("turned", 0.0), *LATER):
            if name in route and route[name] == usual:
                del route[name]
        needs = {name: of for name, of in own.get("people", {}).items() if name in DECIDING}
        if needs:
            data["people"] = needs
        if "cues" in own:
            data["cues"] = own["cues"]
        return _hashed(data)

    @cached_property
    def _dragon(self) -> Dragon:
        return self.dragon.build()

    @property
    def chain(self) -> Dragon | None:
        """The dragon; None where its benches cannot be, of which `build` tells."""
        try:
            return self._dragon
        except InputError:
            return None

    def title(self, language: str) -> str:
        """What to call it in a language, "en" or "zh"."""
        english, chinese = self.meta.title, self.meta.title_zh
        return (chinese or english) if language == "zh" else (english or chinese)

    def value(self, key: str) -> float:
        """The number under a dotted key.

        Raises:
            PlanError: if the plan does not say it.
        """
        table, _dot, name = key.partition(".")
        at = getattr(getattr(self, table, None), name, None)
        tables = self.said()
        tables[table] = {**tables.get(table, {}), name: at or 0.0}
        idle = [one.because for one in idle_keys(tables) if one.key == key]
        if table == "route" and name not in vars(self.route):
            idle = [f'route.kind = "{self.route.kind}"']
        if idle:
            text = _("this needs {key}, which means nothing beside {because}: choose another plan")
            raise PlanError(text.format(key=key, because=idle[0]))
        if not isinstance(at, int | float):
            raise PlanError(_("the plan does not say {key}: set it").format(key=key))
        return float(at)

    def toml(self) -> str:
        """The plan as a plan file; what is as by default is left out."""
        import tomlkit  # needed by what writes plans alone

        return tomlkit.dumps(self.own())

    def data(self) -> dict[str, Any]:
        """Every key that has an effect, those left out as by default, as plain data: the same plan.

        Of the people, the cues, the marks and the event only the keys that are given.
        """
        data, own = self.whole(False), self.own()
        for name in ("people", "cues", "chalk", "event"):
            data[name] = own.get(name)
            if name not in own:
                del data[name]
        drop(data, idle_keys(data))
        return data

    def with_value(self, key: str, value: object) -> "Plan":
        """The same plan with another value under a key such as route.pitch.

        Raises:
            PlanError: for a value that cannot be, and a key that is not known or has no effect.
        """
        return self.with_values({key: value})

    def with_table(self, table: str, /, **values: object) -> "Plan":
        """The same plan with other values in one of its tables.

        What the plan says for a choice that these values replace (a family, a speed) goes with it.

        Raises:
            PlanError: for a value that cannot be, and a key that is not known or has no effect.
        """
        return self.with_values({f"{table}.{name}": value for name, value in values.items()})

    def with_values(self, values: Mapping[str, object]) -> "Plan":
        """The same plan with other values under keys such as route.pitch or route.part.0.length.

        What the plan says for choices that they replace goes with it, as in `with_table`.

        Raises:
            PlanError: as `with_table`.
        """
        data = self.said()
        for key, value in values.items():
            set_value(data, key, value)
        drop_replaced(data, list(values))
        return self._changed(data)

    def without_square(self) -> "Plan":
        """The same plan without its venue and its obstacles."""
        data = self.said()
        for name in SQUARE:
            data.pop(name, None)
        data.get("limits", {}).pop("venue_margin", None)
        return self._changed(data)

    def without_street(self) -> "Plan":
        """The same dance without the street that leads to it, and without cues; itself without one."""
        if not self.route.after_street:
            return self
        data = self.said()
        for table, name in (("route", "street"), ("walk", "start"), ("walk", "end")):
            data.get(table, {}).pop(name, None)
        data.get("walk", {}).pop("position", None)
        data.pop("cues", None)
        return self._changed(data)

    def span(self, walk: Walk | None = None) -> tuple[float, float]:
        """Start and end of the whole walk, s: as the plan says, else as its route's kind says.

        `walk` is that of the plan, if it is built already. Where a cue stops the head for good, and the
        plan says no end, that is the end.

        Raises:
            PlanError: if the head never comes to the end, or cues lie outside the dance.
        """
        end, pace = self.walk.end, self.pace()
        if end is None:
            walk = self.build() if walk is None else walk
            end = walk.time_at(self.route.last_position(walk))
            end = min(end, pace.end) if self.cues.cue else end
        if not math.isfinite(end):
            text = _("the head never comes to the end of its walk: set walk.end")
            raise self._wrong([Fault("walk", text)])
        if wrong := outside(self.moments(), self.start, end, pace.way(end)):
            raise self._wrong(wrong)
        return self.start, end

    @property
    def start(self) -> float:
        """When the dance starts, s."""
        return 0.0 if self.walk.start is None else self.walk.start

    def moments(self) -> tuple[Moment, ...]:
        """All cues in their times and places, one after another.

        Raises:
            PlanError: for a cue that cannot be.
        """
        return self.pace().moments(self.cues) if self.cues.cue else ()

    def profile(self) -> SpeedProfile:
        """The head's speed over time.

        Raises:
            PlanError: if there is none such.
        """
        return self.pace().profile

    def pace(self) -> Paced:
        """The head's speed with all that holds it.

        Raises:
            PlanError: if there is none such.
        """
        faults = Faults()
        pace = faults.tried("walk", lambda: self._pace)
        if pace is None:
            raise self._wrong(faults.found)
        return pace

    @cached_property
    def _pace(self) -> Paced:
        profile = self.walk.build()
        if not self.cues.cue and self.cues.acceleration is None:
            return Paced(profile, self.start, ())
        return paced(self.cues, self._heads(profile), profile, self.start, self.limits)

    @property
    def _goes_by_route(self) -> bool:
        """Whether cues go by places or rounds, which the route alone tells."""
        return any(cue.place is not None or cue.round is not None for cue in self.cues.cue)

    def _heads(self, profile: SpeedProfile) -> list[float | None]:
        """Where on its way the head comes to each cue, m; None where a time says when."""
        if not self._goes_by_route:
            return [cue.head for cue in self.cues.cue]
        route, begun = self._placed
        walk = Walk(self._dragon, route, profile, self._at_zero(begun))
        first, end = float(walk.head_position([self.start])[0]), self.walk.end
        last = self.route.last_position(walk) if end is None else float(walk.head_position([end])[0])
        return heads_of(self.cues.cue, route, first, min(last, route.length))

    def _at_zero(self, begun: float) -> float:
        """The head's route position at time 0, m, which is `begun` where nothing is said."""
        return begun if self.walk.position is None else self.walk.position

    def ways(self) -> tuple[float, float, float]:
        """How far the head walks from time 0, as without cues, to the start; to the end; at most; m.

        To the start and, if the plan says one, the end of its walk; else the second is not a number.

        Raises:
            PlanError: for a walk that cannot be.
        """
        pace, end = self.pace(), self.walk.end
        begin = float(self.walk.build().distance(self.start))
        most = begin + pace.way(math.inf)
        if end is None:
            return begin, most if pace.end < math.inf else math.nan, most
        return begin, begin + pace.way(end), most

    def build(self) -> Walk:
        """The walk that the plan describes.

        Raises:
            PlanError: for all sizes that cannot be and parts that do not join, a line each.
        """
        faults = Faults()
        dragon = faults.tried("dragon", lambda: self._dragon)
        placed = faults.tried("route", lambda: self._placed)
        told = self._goes_by_route and (dragon is None or placed is None)
        pace = None if told else faults.tried("walk", lambda: self._pace)
        faults.tried("obstacle", lambda: self._obstacles)
        if dragon is None or placed is None or pace is None or faults.found:
            raise self._wrong(faults.found)
        route, begun = placed
        position = self._at_zero(begun)
        if self.cues.cue:  # the dance starts where it does without cues
            position += self.ways()[0] - float(pace.profile.distance(self.start))
        walk = faults.tried("walk.position", lambda: Walk(dragon, route, pace.profile, position))
        if walk is None:
            raise self._wrong(faults.found)
        return walk

    def motion(self, times: npt.ArrayLike, *, throw: bool = True, workers: int = 1) -> Motion:
        """Where every handle is at `times`, s, on the walk, built for it: see `Walk.motion`."""
        return self.build().motion(times, throw=throw, workers=workers)

    def obstacles(self) -> tuple[Obstacle, ...]:
        """The venue's edge, if the plan says one, then the obstacles in it.

        Raises:
            PlanError: for all outlines that cannot be, a line each.
        """
        faults = Faults()
        found = faults.tried("obstacle", lambda: self._obstacles)
        if found is None:
            raise self._wrong(faults.found)
        return found

    @cached_property
    def _obstacles(self) -> tuple[Obstacle, ...]:
        found = built_obstacles(self.venue, self.obstacle, self.limits)
        if not self.route.after_street or not found or found[0].kind != "venue":
            return found
        try:
            route, _start = self._placed
        except InputError:  # of which `build` tells
            return found
        return self.route.gated(found[0], route, self), *found[1:]

    @property
    def _placed(self) -> tuple[Route, float]:
        """The route on the square, and where on it the head stands at time 0."""
        return self.route.whole(self)

    def _wrong(self, faults: Sequence[Fault]) -> PlanError:
        return PlanError(self._source.sentences(faults))


def _hashed(data: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()


def read_plan(
    source: str | Path, settings: str | Sequence[str] | Mapping[str, object] = (), **tables: object
) -> Plan:
    """The plan of a file or of a built-in name, with settings laid over it.

    Args:
        source: path of the file, or the name.
        settings: {"disc.radius": 4.5}, or "disc.radius=4.5", or a list of such texts.
        tables: of further settings: disc={"radius": 4.5}.

    Raises:
        PlanError: naming the place, what was expected and what was given.

    Examples:
        >>> bd.read_plan("spiral-in", {"disc.radius": 4.5, "dragon.benches": 40})
        <Plan 'Coiling in': spiral-in, 40 benches>
        >>> bd.read_plan("turn", dragon={"benches": 40}).dragon.benches
        40
    """
    if isinstance(settings, str):
        settings = [settings]
    if not isinstance(settings, Mapping | Sequence):
        text = _("settings must be like {example}, not {value}")
        raise PlanError(text.format(example='{"disc.radius": 4.5}', value=brief(settings)))
    said = list[Setting](settings.items() if isinstance(settings, Mapping) else settings)
    for name, table in tables.items():
        inner = table if isinstance(table, Mapping) else {"": table}
        said += [(f"{name}.{key}".rstrip("."), value) for key, value in inner.items()]
    return checked(*read_toml(str(source), said))


def checked(data: dict[str, Any], source: Source | str) -> Plan:
    """The plan in parsed TOML; `source` is named in errors.

    Raises:
        PlanError: for all that is wrong, a line each.
    """
    plan = Plan.__new__(Plan)
    _fill(plan, data, Source(source) if isinstance(source, str) else source)
    return plan


def _fill(plan: Plan, data: dict[str, Any], where: Source) -> None:
    """Make a plan that is nothing yet that of parsed TOML: see `checked`."""
    if "base" in data:
        data = with_base(data, None, where.name)
    route = data.get("route")
    if isinstance(route, dict) and "part" in route:
        route.setdefault("kind", "parts")
    data, passed = with_drawings(data, where)
    where = replace(where, passed=(*where.passed, *passed))
    faults, others = [Fault(idle.key, idle.text) for idle in idle_keys(data)], 0
    try:
        plan.__pydantic_validator__.validate_python(data, self_instance=plan)
    except ValidationError as error:
        wrong = error.errors()
        told = [fault_of(each, data, Plan, where.settings) for each in wrong[:MOST_FAULTS]]
        faults = told + faults
        others = len(wrong[MOST_FAULTS:])
    if faults:
        raise PlanError(where.sentences(faults, others))
    plan._source = where
