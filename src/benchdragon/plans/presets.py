"""Dances to begin with: the contest's, and real villages' dragons, and where each figure comes from.

Counts and lengths are what newspapers and village pages report; metres a bench are derived from the
two. No board was measured, no walking speed found: those are assumed, and said to be.
"""

from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

from benchdragon.i18n import N_, Words, _, both
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.plans.toml import built_in_names

Status = Literal["measured", "reported", "derived", "assumed"]

# Assumed of every village's boards, m: where the holes are, and how wide they are, as narrow boards
# of Zhejiang and Fujian are reported (0.15 to 0.20 m).
INSET, WIDTH = 0.15, 0.20
# Assumed of every village's walk: m/s of a procession, and m that people keep between benches.
SPEED, MARGIN = 0.6, 0.10
# Assumed of the heads, m beyond a board's length: they carry the dragon's head and neck.
HEAD = 1.0

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
DISC_TITLE = N_("Coiling in to the disc")
DISC_SOURCE = N_(
    "the contest's question 3: the plan spiral-in, with a turning disc of 4.5 m added, at whose edge "
    "the head stops"
)


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
        title: what people call it.
        source: where its figures come from.
        figures: each of them.
        plan: the dance.
    """

    name: str
    title: Words
    source: Words
    figures: list[Figure]
    plan: Plan


@dataclass(frozen=True)
class Village:
    """A village's dragon.

    Attributes:
        name: of the preset.
        title: what people call it.
        source: who reported it.
        benches: how many.
        length: of the whole dragon, m; None where only boards are spoken of, 2 m or so.
        route: in along a spiral of this pitch (m) to this disc (m), or through a turn.
    """

    name: str
    title: str
    source: str
    benches: int
    length: float | None
    route: dict[str, Any]


def _coil(pitch: float, turns: float, disc: float) -> dict[str, Any]:
    route = {"kind": "spiral-in", "pitch": pitch, "start_turn": turns}
    return {"route": route, "disc": {"radius": disc}}


def _turn(pitch: float, disc: float) -> dict[str, Any]:
    return {"route": {"kind": "turn", "pitch": pitch}, "disc": {"radius": disc}}


VILLAGES = (
    Village("xianju", N_("Xianju"), N_("China News 2024"), 224, 365.0, _coil(1.0, 14, 5.0)),
    Village("tonglu", N_("Tonglu"), N_("Hangzhou's news site 2024"), 108, 200.0, _coil(0.8, 12, 4.0)),
    Village("gaochun", N_("Gaochun"), N_("a blog 2026"), 108, 210.0, _turn(1.7, 4.5)),
    Village("yaokou", N_("Yaokou"), N_("China Daily 2021"), 58, 130.0, _coil(0.9, 9, 4.0)),
    Village("shangping", N_("Shangping"), N_("yawin.cn"), 160, 300.0, _coil(0.9, 14, 4.5)),
    Village("pujiang", N_("Pujiang"), N_("press: 50 or more"), 50, 100.0, _turn(1.8, 5.0)),
    Village("yongkang", N_("Yongkang"), N_("press 2023: 400 or more"), 400, None, _coil(1.0, 18, 5.0)),
    Village("nanchang", N_("Nanchang"), N_("press 2019: 400 or more"), 400, 800.0, _turn(2.0, 6.0)),
)  # fmt: skip


def _village(village: Village) -> Preset:
    link = 2.0 - 2.0 * INSET if village.length is None else village.length / village.benches
    board = round(link + 2.0 * INSET, 2)
    title = both(lambda: _(village.title))
    data = {
        "schema": 1,
        "meta": {"title": title.en, "title_zh": title.zh},
        "dragon": {
            "benches": village.benches, "width": WIDTH, "front_inset": INSET, "rear_inset": INSET,
            "head_length": round(board + HEAD, 2), "body_length": board, "tail_length": board,
        },
        "walk": {"speed": SPEED},
        "limits": {"margin": MARGIN},
        **village.route,
    }  # fmt: skip
    sizes: Status = "reported" if village.length is None else "derived"
    known: dict[str, Status] = {
        "dragon.benches": "reported",
        "dragon.body_length": sizes,
        "dragon.tail_length": sizes,
    }
    keys = [
        f"{table}.{key}"
        for table in ("dragon", "route", "disc", "walk", "limits")
        for key in data[table]
    ]
    figures = [Figure(key=key, status=known.get(key, "assumed")) for key in keys if key != "route.kind"]
    text = BOARDS if village.length is None else COUNTED
    return Preset(
        name=village.name,
        title=title,
        source=both(lambda: _(text).format(source=_(village.source))),
        figures=figures,
        plan=Plan.model_validate(data),
    )


def _disc_plan() -> Plan:
    """The contest's coil to its disc, under a title of its own."""
    title = both(lambda: _(DISC_TITLE))
    plan = read_plan("spiral-in", ["disc.radius=4.5"])
    meta = plan.meta.model_copy(update={"title": title.en, "title_zh": title.zh})
    return plan.model_copy(update={"meta": meta})


def _contest(name: str, plan: Plan, source: str = CONTEST) -> Preset:
    keys = [f"dragon.{key}" for key in plan.dragon.model_fields_set]
    keys += [f"route.{key}" for key in plan.route.model_fields_set - {"kind"}]
    keys += ["disc.radius"] if plan.disc.radius is not None else []
    keys += ["walk.speed"]
    return Preset(
        name=name,
        title=Words(en=plan.title("en"), zh=plan.title("zh")),
        source=both(lambda: _(source)),
        figures=[Figure(key=key, status="reported") for key in sorted(keys)],
        plan=plan,
    )


@cache
def presets() -> list[Preset]:
    """All of them, the contest's first; those with the name of a built-in plan are that plan."""
    paper = [_contest(name, read_plan(name)) for name in built_in_names()]
    paper.insert(0, _contest(DISC_PLAN, _disc_plan(), DISC_SOURCE))
    return paper + [_village(village) for village in VILLAGES]
