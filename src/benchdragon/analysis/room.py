"""Room for people: whether a walk stays clear with sway, imprecision and bearers beside the benches.

Level upon level, each by the search that finds contacts of benches, with its own margin and sizes. The
plan's benches stay as they are.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from benchdragon.analysis.contact import first_sure_contact
from benchdragon.analysis.obstacles import ObstacleAnswers, obstacle_answers
from benchdragon.analysis.proof import prove_contact, prove_obstacle
from benchdragon.analysis.shortage import Shortage, shortage
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.model.dragon import Dragon
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.people import PeopleTable
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress

LevelName = Literal["benches", "sway", "imprecision", "people"]
# Requirements that each level adds to the one before it: keys of the plan's table of people.
ASKED: dict[LevelName, tuple[str, ...]] = {
    "benches": (), "sway": ("sway",), "imprecision": ("imprecision",), "people": ("beside", "ahead"),
}  # fmt: skip
TEXTS: dict[LevelName, str] = {
    "benches": N_("benches alone"),
    "sway": N_("with sway"),
    "imprecision": N_("with imprecision"),
    "people": N_("with people"),
}
# Widths of brackets of distances from obstacles, m: contacts are as exact as ever.
TOLERANCES = (1e-3,)


@dataclass(frozen=True)
class Asked:
    """A requirement of a level: a key of the plan's people, its value, m, and its source.

    Attributes:
        key: sway, imprecision, beside or ahead.
        value: m.
        source: "" for an assumption.
    """

    key: str
    value: float
    source: str


@dataclass(frozen=True)
class RoomLevel:
    """Whether a walk keeps the room that one level, and all before it, ask for.

    Attributes:
        name: which.
        asked: the requirements that it adds to the level before it.
        margin: that two benches that are not neighbours must keep, m.
        contact: when two of them first come nearer than that; None if none do.
        obstacles: the answers about each obstacle and the venue's edge.
        short: the room that the pair breaking it first lacks, where known.
    """

    name: LevelName
    asked: tuple[Asked, ...]
    margin: float
    contact: Answer | None
    obstacles: tuple[ObstacleAnswers, ...]
    short: Shortage | None = None

    @property
    def between(self) -> float:
        """Required distance between the sides of two benches, m: the people of both walk within."""
        beside = sum(one.value for one in self.asked if one.key == "beside")
        return round(self.margin + 2.0 * beside, 9)

    @property
    def first(self) -> tuple[Answer, Obstacle | None] | None:
        """The first contact that breaks it, a sure one if any, and its obstacle; None if it is kept."""
        known: list[tuple[Answer, Obstacle | None]] = []
        known += [] if self.contact is None else [(self.contact, None)]
        known += [(one.contact, one.obstacle) for one in self.obstacles if one.contact is not None]
        return min(known, key=lambda one: (one[0].status == "undecided", one[0].value), default=None)

    @property
    def kept(self) -> bool | None:
        """Whether it is kept; None where rounding leaves that undecided."""
        contacts = [self.contact, *(one.contact for one in self.obstacles)]
        broken = {one.status != "undecided" for one in contacts if one is not None}
        return False if True in broken else None if broken else True


def levels_asked(people: PeopleTable) -> list[LevelName]:
    """The levels with requirements."""
    return [name for name, keys in ASKED.items() if any(getattr(people, key) for key in keys)]


def room_levels(
    plan: Plan, walk: Walk, span: tuple[float, float],
    bare: tuple[Answer | None, tuple[ObstacleAnswers, ...]], levels: list[RoomLevel], *, prove: bool,
    progress: Progress,
) -> None:  # fmt: skip
    """Add the levels of room that a plan asks for, if it does, to `levels`, benches alone first.

    Two benches that each sway, or stray, come nearer by twice that; a bench and an obstacle by once.
    Each level is searched from the start of the span, s, until the one before it is broken. `bare` has
    the answers for benches alone: their first contact, and obstacles. With `prove` contacts are proved
    by the same calls.

    Raises:
        InputError: for benches that would be too long or too wide with their people.
        WalkError, UnsureError, MissingExtraError: as `first_contact`, `obstacle_answers` and their
            proofs.
    """
    names = levels_asked(plan.people)
    level = RoomLevel("benches", (), plan.limits.margin, *bare)
    if names:
        levels.append(level)
    each, line, end = 0.0, walk, _until(level, span)[1]
    for n, name in enumerate(names):
        progress(n / len(names), _(TEXTS[name]))
        asked = _asked(plan.people, name)
        if name == "people":
            line = replace(walk, dragon=with_people(walk.dragon, plan.people))
        else:
            each += asked[0].value
        until = _until(level, span)
        margin = plan.limits.margin + 2.0 * each
        search = _proved if prove else None
        found = first_sure_contact(line, until[0], until[1], margin=margin, search=search)
        stands = [replace(one, margin=one.margin + each) for one in plan.obstacles()]
        level = RoomLevel(name, asked, margin, found, _obstacles(line, stands, until, prove=prove))
        level = _measured(level, walk, end)
        levels.append(level)


def _proved(walk: Walk, start: float, end: float, margin: float, progress: Progress) -> Answer | None:
    return prove_contact(walk, start, end, margin=margin, progress=progress)


def shown_name(level: RoomLevel) -> str:
    """The name of a level, in the language in use."""
    return _(TEXTS[level.name])


def asked_text(level: RoomLevel) -> str:
    """The requirements of a level and their sources, in the language in use."""
    said = []
    for one in level.asked:
        text = _("{key} {value} m (assumption)")
        if one.source:
            text = _("{key} {value} m ({source})")
        said.append(text.format(key=f"people.{one.key}", value=f"{one.value:g}", source=one.source))
    return _(", ").join(said)


def with_people(dragon: Dragon, people: PeopleTable) -> Dragon:
    """The dragon with room for bearers on both sides of all benches, and before the head's bench."""
    length, width, front_inset, rear_inset = dragon.sizes.copy()
    length[0] += people.ahead
    front_inset[0] += people.ahead
    return Dragon.of_sizes(length, width + 2.0 * people.beside, front_inset, rear_inset)


def with_all_room(plan: Plan) -> tuple[Walk, tuple[Obstacle, ...]]:
    """The plan's walk and obstacles with all that its people ask for: the hardest of the levels.

    Benches have room for bearers, and margins to obstacles are wider by sway and imprecision.

    Raises:
        InputError: for benches that would be too long or too wide with their people.
    """
    walk, people = plan.build(), plan.people
    if people.beside or people.ahead:
        walk = replace(walk, dragon=with_people(walk.dragon, people))
    more = people.sway + people.imprecision
    return walk, tuple(replace(one, margin=one.margin + more) for one in plan.obstacles())


def _asked(people: PeopleTable, name: LevelName) -> tuple[Asked, ...]:
    said = [(key, getattr(people, key), getattr(people.source, key)) for key in ASKED[name]]
    return tuple(Asked(*one) for one in said if one[1])


def _measured(level: RoomLevel, walk: Walk, end: float) -> RoomLevel:
    """The level with its shortage where it is surely broken, measured until the end, s."""
    if level.first is None or level.kept is None:
        return level
    asked = {one.key: one.value for one in level.asked}
    return replace(level, short=shortage(walk, level.first, level.margin, asked, end))


def _until(level: RoomLevel, span: tuple[float, float]) -> tuple[float, float]:
    """From the start of a span, s, until a level is surely broken, or to its end."""
    contacts = [level.contact, *(one.contact for one in level.obstacles)]
    ends = [one.upper for one in contacts if one is not None and one.status != "undecided"]
    return span[0], min([span[1], *ends])


def _obstacles(
    walk: Walk, stands: Sequence[Obstacle], span: tuple[float, float], *, prove: bool
) -> tuple[ObstacleAnswers, ...]:
    found = []
    for one in stands:
        answers = obstacle_answers(walk, one, span[0], span[1], tolerances=TOLERANCES)
        found.append(prove_obstacle(walk, answers, *span) if prove else answers)
    return tuple(found)
