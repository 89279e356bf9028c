"""What goes over the wire between the studio's pages and programs: bodies, answers, problems.

Metres, seconds, metres a second. Numbers that are not finite come as null: JSON knows none.
`tools/make_types.py` turns the models into `web/messages.d.ts`.
"""

import json
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PlainSerializer

from benchdragon.analysis.records import Answer, Number, Record, Verdict
from benchdragon.i18n import Words, _
from benchdragon.plans.presets import Figure
from benchdragon.plans.schema import Plan, checked
from benchdragon.plans.toml import PlanError

Finite = Annotated[float, Field(allow_inf_nan=False)]
Spread = Annotated[Finite, Field(ge=0.0, le=1.0)]
LimitName = Literal["pitch", "disc", "width", "length"]
Question = Literal["turn", "prove", "speed", "pace", "margins"]
ExportName = Literal[
    "player.html", "motion.xlsx", "motion.csv", "motion.npz", "motion.parquet", "motion.nc",
    "check.xlsx", "png", "svg", "pdf",
]  # fmt: skip


def _as_plan(data: object) -> Plan:
    """The plan in a body; what is wrong is said in the command line's words."""
    if not isinstance(data, dict):
        came = json.dumps(data)[:60]
        text = _("{where}: wanted {wanted}, not {came}")
        raise PlanError(text.format(where="plan", wanted=_("a table"), came=came))
    return checked(data, "plan")


AskedPlan = Annotated[Plan, BeforeValidator(_as_plan)]
SentPlan = Annotated[Plan, PlainSerializer(Plan.data, return_type=dict[str, Any])]


class Body(BaseModel):
    """What a page sends: unknown keys are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class PlanBody(Body):
    """A plan, to be asked about."""

    plan: AskedPlan


class TextBody(Body):
    """The text of a plan file."""

    toml: str


class ExportBody(PlanBody):
    """A plan, and the language of the file; without one that of the request."""

    lang: Literal["en", "zh"] | None = None


class JobOptions(Body):
    """What a long question may be told.

    Attributes:
        objective: of "turn": see `solve turn`.
        least_radius: of "turn": no bend is tighter, m.
        longest: of "turn": the turn itself is no longer, m.
        longest_way: of "turn": the whole way inside the disc is no longer, m.
        draws: of "margins": random dances.
        seed: of "margins".
        aside: of "margins", like the following: standard deviations, m; see `Deviations`. Where all are
            0, those that `tolerance.CASES` takes together.
    """

    objective: Literal["way", "length", "speed", "disc", "acceleration"] = "way"
    least_radius: Annotated[Finite, Field(ge=0.0, le=1e6)] = 0.0
    longest: Annotated[Finite, Field(gt=0.0, le=1e6)] | None = None
    longest_way: Annotated[Finite, Field(gt=0.0, le=1e6)] | None = None
    draws: Annotated[int, Field(ge=1, le=100_000)] = 100
    seed: Annotated[int, Field(ge=0, le=2**31)] = 1
    aside: Spread = 0.0
    stray: Spread = 0.0
    play: Spread = 0.0
    height: Spread = 0.0
    length: Spread = 0.0
    width: Spread = 0.0


class JobBody(PlanBody):
    """A long question about a plan."""

    question: Question
    options: JobOptions = JobOptions()


class Problem(Record):
    """What went wrong, as one sentence in the language asked for."""

    error: str


class OpenedPlan(Record):
    """A plan file, read: every key, those left out as by default."""

    plan: SentPlan


class TurnFound(Record):
    """The best turn found, and the plan with it: see `turn.BestTurn`.

    `way_before` is the way inside the disc of the turn that the plan had, m.
    """

    plan: SentPlan
    objective: Answer
    length: Number
    way: Number
    way_before: Number
    least_radius: Number
    head_speed: Answer | None
    clearance: Answer
    active: list[str]


class PaceFound(Record):
    """The plan walked at its own head speed, slowed down only where a limit wants it."""

    plan: SentPlan
    steady: Answer
    seconds: Number
    saved: Number


class PitchFor(Record):
    """The pitch, m, at which benches touch with at most that chance, with 95 % confidence."""

    risk: float
    pitch: Number


class MarginsFound(Record):
    """What imprecise dances need: see `tolerance.Tolerance`; chance at the plan's own pitch."""

    draws: int
    exact: Number
    pitch: float
    chance: float
    chance_lower: float
    chance_upper: float
    pitch_for: list[PitchFor]


Result = Verdict | TurnFound | PaceFound | MarginsFound | Answer


class JobStarted(Record):
    """A long question that was taken on."""

    id: str


class JobTaken(Record):
    """A long question of a client, and the plan that it asks about."""

    id: str
    question: Question
    plan: SentPlan
    plan_sha256: str


class JobState(Record):
    """How a long question stands.

    Attributes:
        plan_sha256: of the plan that it asks about.
        share: of the work, 0 to 1, as far as can be told.
        text: what is being done.
        result: once it is done.
        error: why there is none, if it failed.
    """

    id: str
    question: Question
    plan_sha256: str
    state: Literal["waiting", "running", "done", "failed", "cancelled"]
    share: float
    text: str
    result: Result | None = None
    error: str | None = None


class Preset(Record):
    """A dance to begin with: see `presets.Preset`."""

    model_config = ConfigDict(frozen=True, from_attributes=True)

    name: str
    title: Words
    source: Words
    figures: list[Figure]
    plan: SentPlan


class QueueState(Record):
    """Workers of one kind of question."""

    workers: int
    ready: int
    busy: int
    waiting: int


class Health(Record):
    """How the studio stands."""

    status: Literal["ok"]
    version: str
    workers: dict[str, QueueState]
