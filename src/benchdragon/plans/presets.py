"""Dances to begin with: the built-in plans, and where each of their figures comes from.

Counts and lengths are what newspapers and village pages report; metres a bench are derived from the
two. No board was measured, no walking speed found: those are assumed, and said to be.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Literal

from benchdragon.i18n import N_, Words, _, both
from benchdragon.plans.schema import Plan, checked
from benchdragon.plans.toml import built_in_names, read_toml

Status = Literal["measured", "reported", "derived", "assumed"]

COUNTED = N_(
    "{source}: benches and length as reported, metres a bench derived from them; width, holes, head, "
    "spiral and speed are assumed"
)
BOARDS = N_(
    "{source}: benches as reported; boards of 2 m as reported nearby; width, holes, head, spiral and "
    "speed are assumed"
)
CONTEST = N_("the contest's problem: CUMCM 2024, problem A; all figures as given there")
# A built-in coil goes on until its benches touch: the one that stops at a disc is another plan.
DISC_PLAN = "question-3"
DISC_SOURCE = N_(
    "the contest's question 3: the plan spiral-in, with a turning disc of 4.5 m added, at whose edge "
    "the head stops"
)
# It walks on the page beside the questions, where there is no plan yet.
WALKING = "pujiang"
# Who reported each village's dragon.
REPORTERS = {
    "xianju": N_("China News 2024"),
    "tonglu": N_("Hangzhou's news site 2024"),
    "gaochun": N_("a blog 2026"),
    "yaokou": N_("China Daily 2021"),
    "shangping": N_("yawin.cn"),
    "pujiang": N_("press: 50 or more"),
    "yongkang": N_("press 2023: 400 or more"),
    "nanchang": N_("press 2019: 400 or more"),
}
# Those of which only boards are spoken of, 2 m or so.
UNMEASURED = {"yongkang"}
# What a file says beside figures that have a source.
WAYS = {"schema", "meta", "turn", "route.kind", "walk.start", "limits.speed"}


@dataclass(frozen=True)
class Figure:
    """One figure of a preset: its key in the plan, and where it comes from."""

    key: str
    status: Status


@dataclass(frozen=True)
class Preset:
    """A dance to begin with.

    Attributes:
        name: as the command line takes it.
        title: for readers.
        source: where its figures come from.
        figures: each of them.
        plan: the dance.
    """

    name: str
    title: Words
    source: Words
    figures: list[Figure]
    plan: Plan


def _preset(name: str) -> Preset:
    data, where = read_toml(name)
    plan = checked(data, where)
    keys = [f"{table}.{key}" for table, values in data.items() if table not in WAYS for key in values]
    known = _statuses(name)
    other: Status = "assumed" if name in REPORTERS else "reported"
    return Preset(
        name=name,
        title=Words(en=plan.title("en"), zh=plan.title("zh")),
        source=both(lambda: _source(name)),
        figures=[Figure(key=key, status=known.get(key, other)) for key in keys if key not in WAYS],
        plan=plan,
    )


def _source(name: str) -> str:
    """Where a plan's figures come from, in the language in use."""
    if name in REPORTERS:
        return _(BOARDS if name in UNMEASURED else COUNTED).format(source=_(REPORTERS[name]))
    return _(DISC_SOURCE if name == DISC_PLAN else CONTEST)


def _statuses(name: str) -> Mapping[str, Status]:
    """How the figures of a village's plan are known that are not assumed."""
    sizes: Status = "reported" if name in UNMEASURED else "derived"
    return {} if name not in REPORTERS else {
        "dragon.benches": "reported", "dragon.body_length": sizes, "dragon.tail_length": sizes,
    }  # fmt: skip


@cache
def presets() -> list[Preset]:
    """All of them: first the one that walks beside the questions, then the contest's coil to a disc."""
    first = (WALKING, DISC_PLAN)
    return [_preset(name) for name in (*first, *(n for n in built_in_names() if n not in first))]
