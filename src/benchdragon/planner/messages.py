"""What the planner's page, its Workers and this package send one another: presets, long questions.

Metres, seconds, metres a second. Numbers that are not finite are null, as JSON has none.
`tools/make_types.py` turns the models into `web/messages.d.ts`.
"""

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, PlainSerializer

from benchdragon.analysis.records import Answer, Number, Record
from benchdragon.i18n import Words
from benchdragon.plans.presets import Figure
from benchdragon.plans.schema import Plan

SentPlan = Annotated[Plan, PlainSerializer(Plan.data, return_type=dict[str, Any])]


class Preset(Record):
    """A dance to begin with: see `presets.Preset`."""

    model_config = ConfigDict(frozen=True, from_attributes=True)

    name: str
    title: Words
    source: Words
    figures: list[Figure]
    plan: SentPlan


class Bearer(Record):
    """Someone who carries a bench: see `roster.Person`."""

    model_config = ConfigDict(frozen=True, from_attributes=True)

    name: str
    household: str
    phone: str
    remarks: str
    home_phone: str


class NamesHeld(Record):
    """A list of names that was read: the people of benches, by number, and what is odd about it."""

    people: list[tuple[int, list[Bearer]]]
    notes: list[str]


class WantedPapers(Record):
    """The papers on which a page opens.

    Attributes:
        only: their names; none: all.
        paper: the size of benches' sheets.
        households: whether benches of a household share a sheet.
        night: whether the type is large.
        phones: whether phone numbers are printed.
        names: who carries; null: without names.
    """

    only: list[str]
    paper: Literal["a4", "quarter", "lanyard"]
    households: bool
    night: bool
    phones: bool
    names: NamesHeld | None


class FormationSize(Record):
    """A size of a formation: see `formations.Size`; `usual` where nothing is said."""

    name: str
    text: Words
    least: float
    most: float
    unit: str
    usual: float


class NamedFormation(Record):
    """A formation that plans can name."""

    name: str
    title: Words
    sizes: list[FormationSize]


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


class TurnShape(Record):
    """The turn of a plan: its own length and the radius of its tightest bend, m."""

    length: Number
    least_radius: Number


class PaceFound(Record):
    """The plan walked at its own head speed, slowed down only where a limit requires it."""

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


class JobState(Record):
    """The state of a long question.

    Attributes:
        share: of the work done, 0 to 1, estimated.
        text: what is being done.
        result: once it is done.
        error: why there is none, if it failed.
    """

    question: Literal["turn", "speed", "pace", "margins"]
    state: Literal["running", "done", "failed", "cancelled"]
    share: float
    text: str
    result: TurnFound | PaceFound | MarginsFound | Answer | None = None
    error: str | None = None
