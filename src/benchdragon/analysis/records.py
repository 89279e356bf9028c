"""The result of a check as plain data: the one schema of `--json`, planner, player and files.

SI units. Numbers that are not finite are null, as JSON has none. Texts are in both languages, except
the assumptions of an answer: they are in the language in use when it was computed.
"""

import math
from typing import Annotated, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict

from benchdragon.analysis import findings, left_open, not_looked_at
from benchdragon.analysis.check import Report, peak_text, sentence
from benchdragon.analysis.findings import KINDS, shown_name
from benchdragon.analysis.obstacles import ObstacleAnswers
from benchdragon.analysis.room import RoomLevel
from benchdragon.analysis.room import shown_name as level_name
from benchdragon.errors import WalkError
from benchdragon.i18n import Words, _, both
from benchdragon.model.answer import Answer as Solved
from benchdragon.model.answer import Witness as Near
from benchdragon.number_format import finite_or_none
from benchdragon.plans.schema import Plan
from benchdragon.version import __version__


def _finite_or_none(value: object) -> object:
    return finite_or_none(value) if isinstance(value, float) else value


Number = Annotated[float | None, BeforeValidator(_finite_or_none)]


class Record(BaseModel):
    """Plain data for programs and pages."""

    model_config = ConfigDict(frozen=True)


class Witness(Record):
    """Where and when the value of an answer occurs: see `answer.Witness`."""

    time: Number
    s: Number
    benches: list[int]
    point: tuple[Number, Number]
    gap: Number
    features: list[tuple[int, str]]
    handle: int | None
    obstacle: str | None


class Answer(Record):
    """A solved number and the bracket that was established: see `answer.Answer`."""

    value: Number
    lower: Number
    upper: Number
    unit: str
    status: Literal["proved", "found", "infeasible", "undecided", "unlimited"]
    witness: Witness | None
    assumptions: list[str]
    evaluations: int
    seconds: Number
    plan_sha256: str
    version: str


class Finding(Record):
    """A violation of the plan, or an undecided question: see `findings.Finding`.

    Attributes:
        code: BD101 and so on: those never change.
        obstacle: the name of the obstacle, null without one.
    """

    code: str
    kind: str
    decided: bool
    text: Words
    time: Number
    benches: list[int]
    value: Number
    limit: Number
    obstacle: str | None = None


class ObstacleRecord(Record):
    """The answers about an obstacle, or the venue's edge: see `obstacles.ObstacleAnswers`.

    Attributes:
        name: what the plan calls it.
        shown: the name for readers; without a name, the number.
        kind: of the obstacle.
        margin: m.
        contact: when a bench first comes nearer than the margin; null if none does.
        distance: the least that benches keep from it, m.
    """

    name: str
    shown: Words
    kind: Literal["circle", "rectangle", "polygon", "line", "venue"]
    margin: Number
    contact: Answer | None
    touch: Answer | None
    distance: Answer


class RoomAsked(Record):
    """A requirement that a level of room adds to the one before it: see `room.Asked`.

    Attributes:
        source: null for an assumption.
    """

    key: str
    value: Number
    source: str | None


class RoomRecord(Record):
    """Whether a walk keeps a level of room: see `room.RoomLevel`.

    Attributes:
        kept: null where rounding leaves that undecided.
        first: when it is first broken, and by which benches; null where it is kept.
        obstacle: the name of the obstacle then, null without one.
    """

    name: Literal["benches", "sway", "imprecision", "people"]
    text: Words
    asked: list[RoomAsked]
    margin: Number
    kept: bool | None
    first: Answer | None
    obstacle: str | None


class LimitedPeak(Record):
    """The greatest value of a quantity that the plan limits, and its name in words."""

    name: str
    text: Words
    peak: Answer


class NotLookedAt(Record):
    """A subject that the check did not consider: see `not_looked_at.NotLookedAt`."""

    kind: str
    text: Words


class Unproved(Record):
    """An answer whose proof failed: see `left_open.Unproved`."""

    kind: str
    text: Words


class HeadStop(Record):
    """A time in which the head, and with it every handle, stands: see `stops.Stop`."""

    start: Number
    end: Number
    s: Number


class Verdict(Record):
    """Whether a walk is safe, in one sentence and in full.

    Attributes:
        safe: whether nothing was found.
        decided: whether no undecided question could change `safe`.
        proved: whether the answers about contact were proved.
        unproved: the answers whose proof failed, and why; they stay as found.
        sentence: the verdict for readers.
        start: of the walk, s.
        end: of the walk, s.
        clearance: null where the dragon cannot walk, like the following.
        not_looked_at: what the check did not consider because the plan does not give it.
        room: level upon level, benches alone first; empty where the plan asks for no room for people.
        stops: of the head; null for a plan without cues.
        seconds: how long it took; null in files, which are the same each time.
    """

    safe: bool
    decided: bool
    proved: bool
    unproved: list[Unproved]
    sentence: Words
    start: Number
    end: Number
    first_contact: Answer | None
    clearance: Answer | None
    greatest_speed: Answer | None
    peaks: list[LimitedPeak]
    obstacles: list[ObstacleRecord]
    room: list[RoomRecord]
    findings: list[Finding]
    not_looked_at: list[NotLookedAt]
    stops: list[HeadStop] | None = None
    seconds: Number
    plan_sha256: str
    version: str


def answer_of(found: Solved, plan: Plan) -> Answer:
    """The record of an answer about a plan."""
    return Answer(
        value=found.value, lower=found.lower, upper=found.upper, unit=found.unit, status=found.status,
        witness=None if found.witness is None else _witness(found.witness),
        assumptions=list(found.assumptions), evaluations=found.evaluations, seconds=found.seconds,
        plan_sha256=plan.sha256, version=__version__,
    )  # fmt: skip


def _witness(near: Near) -> Witness:
    return Witness(
        time=near.time, s=near.s, benches=list(near.benches), point=near.point, gap=near.gap,
        features=list(near.features), handle=near.handle, obstacle=near.obstacle,
    )  # fmt: skip


def answer_or_none(found: Solved | None, plan: Plan) -> Answer | None:
    """The record of an answer that may be missing."""
    return None if found is None else answer_of(found, plan)


def bracketed(found: Answer) -> Solved:
    """The bracket of a record, which holds none for what is not finite, as that of an answer."""
    value, lower, upper = found.value, found.lower, found.upper
    return Solved(
        math.inf if value is None else value,
        -math.inf if lower is None else lower,
        math.inf if upper is None else upper,
        found.unit,
        found.status,
    )


def verdict_of(report: Report) -> Verdict:
    """The record of a check."""
    plan = report.plan
    return Verdict(
        safe=report.safe, decided=report.decided, proved=report.proved,
        unproved=[Unproved(kind=one.kind, text=_in_both(one)) for one in report.unproved],
        sentence=both(lambda: sentence(report)), start=report.start, end=report.end,
        first_contact=answer_or_none(report.first_contact, plan),
        clearance=answer_of(report.clearance, plan),
        greatest_speed=answer_of(report.greatest_speed, plan),
        peaks=[_limited_peak(name, peak, plan) for name, peak in report.peaks.items()],
        obstacles=[_obstacle(found, plan) for found in report.obstacles],
        room=[_room(level, plan) for level in report.room],
        findings=[_finding(found) for found in report.findings],
        not_looked_at=[NotLookedAt(kind=one.kind, text=_in_both(one)) for one in report.not_looked_at],
        stops=_stops(report), seconds=report.seconds, plan_sha256=plan.sha256, version=__version__,
    )  # fmt: skip


def _in_both(one: not_looked_at.NotLookedAt | left_open.Unproved) -> Words:
    return both(lambda: one.text)


def _stops(report: Report) -> list[HeadStop] | None:
    stops = report.stops
    return None if stops is None else [HeadStop(start=one.start, end=one.end, s=one.s) for one in stops]


def _finding(found: findings.Finding) -> Finding:
    return Finding(
        code=found.code, kind=found.kind, decided=found.decided, text=both(lambda: found.text),
        time=found.time, benches=list(found.benches), value=found.value, limit=found.limit,
        obstacle=found.obstacle or None,
    )  # fmt: skip


def _obstacle(found: ObstacleAnswers, plan: Plan) -> ObstacleRecord:
    obstacle = found.obstacle
    return ObstacleRecord(
        name=obstacle.name, shown=both(lambda: shown_name(obstacle)), kind=obstacle.kind,
        margin=obstacle.margin, contact=answer_or_none(found.contact, plan),
        touch=answer_or_none(found.touch, plan), distance=answer_of(found.distance, plan),
    )  # fmt: skip


def _room(level: RoomLevel, plan: Plan) -> RoomRecord:
    first, obstacle = level.first or (None, None)
    return RoomRecord(
        name=level.name,
        text=both(lambda: level_name(level)),
        asked=[
            RoomAsked(key=one.key, value=one.value, source=one.source or None) for one in level.asked
        ],
        margin=level.margin,
        kept=level.kept,
        first=answer_or_none(first, plan),
        obstacle=None if obstacle is None else obstacle.name,
    )


def _limited_peak(name: str, peak: Solved, plan: Plan) -> LimitedPeak:
    return LimitedPeak(name=name, text=both(lambda: peak_text(name)), peak=answer_of(peak, plan))


def verdict_of_fall(plan: Plan, span: tuple[float, float], error: WalkError) -> Verdict:
    """The record of a walk over a span, s, along which the benches cannot follow."""
    text = both(lambda: str(error))
    fall = Finding(
        code=KINDS["walk"].code, kind="walk", decided=True, text=text, time=error.t,
        benches=[error.bench], value=None, limit=None,
    )  # fmt: skip
    return Verdict(
        safe=False, decided=True, proved=False, unproved=[],
        sentence=both(lambda: _("Not safe: {finding}").format(finding=error)), start=span[0],
        end=span[1], first_contact=None, clearance=None, greatest_speed=None, peaks=[], obstacles=[],
        room=[], findings=[fall], not_looked_at=[], seconds=None, plan_sha256=plan.sha256,
        version=__version__,
    )  # fmt: skip


def untimed(verdict: Verdict) -> Verdict:
    """The record without computing times."""

    def without(answer: Answer | None) -> Answer | None:
        return answer and answer.model_copy(update={"seconds": None})

    peaks = [peak.model_copy(update={"peak": without(peak.peak)}) for peak in verdict.peaks]
    names = ("first_contact", "clearance", "greatest_speed")
    answers = {name: without(getattr(verdict, name)) for name in names}
    obstacles = [
        one.model_copy(
            update={
                "contact": without(one.contact),
                "touch": without(one.touch),
                "distance": without(one.distance),
            }
        )
        for one in verdict.obstacles
    ]
    room = [level.model_copy(update={"first": without(level.first)}) for level in verdict.room]
    lists = {"peaks": peaks, "obstacles": obstacles, "room": room}
    return verdict.model_copy(update={**answers, **lists, "seconds": None})
