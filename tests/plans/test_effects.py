"""Whatever a plan or a command line says has an effect, or is refused: each key is varied."""

import copy
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from pydantic import BaseModel

from benchdragon.analysis.check import check
from benchdragon.plans.faults import kinds_of, tables_in
from benchdragon.plans.people import DECIDING, PeopleTable, SourcesTable
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.toml import PlanError
from benchdragon.solve.head_speed import slowed

PARTS: list[dict[str, Any]] = [
    {"kind": "line", "length": 30.0},
    {"kind": "arc", "radius": 8.0, "angle": 60.0},
    {"kind": "clothoid", "length": 6.0, "end_curvature": 0.1},
    {"kind": "spiral", "pitch": 1.5, "start_radius": 9.0, "end_radius": 6.0},
    {"kind": "log-spiral", "length": 5.0, "start_curvature": -0.1, "end_curvature": -0.2},
]
# Two arcs that make a ring with a kink of 5 degrees at both joints.
PIECES: list[dict[str, Any]] = [
    {
        "start": [10, 0],
        "heading": 90,
        "length": 31.41593,
        "start_curvature": 0.1,
        "end_curvature": 0.1,
    },
    {
        "start": [-10, 0],
        "heading": -85,
        "length": 29.78394,
        "start_curvature": 0.0996195,
        "end_curvature": 0.0996195,
    },
]
DRAGON = {"benches": 4, "head_length": 2.2}
SPIRAL = {"kind": "spiral-in", "pitch": 1.0, "start_turn": 4}


def turning(family: str) -> dict[str, Any]:
    return {"dragon": DRAGON, "route": {"kind": "turn"}, "turn": {"family": family}, "walk": {"end": 5}}


# Each has its place, so that connections lie between them.
STEPS: list[dict[str, Any]] = [
    {"name": name, "at": [100.0 * n, 0.0]}
    for n, name in enumerate(
        ("coil-out", "double-door", "three-plum-blossoms", "straight-dragon", "tail-swing")
    )
]
# A plan of each kind of route, of each family of turns, and of each other choice.
BASES: dict[str, dict[str, Any]] = {
    "spiral-in": {"dragon": DRAGON, "route": SPIRAL, "walk": {"end": 20}},
    "profile": {
        "dragon": DRAGON,
        "route": SPIRAL,
        "walk": {"profile": [[0, 0], [3, 1], [9, 0.5]], "end": 20},
    },
    "list of benches": {
        "dragon": {"bench": [{"length": 3}, {"length": 2, "count": 3}]},
        "route": SPIRAL,
        "walk": {"end": 20},
    },
    "arc-arc": turning("arc-arc"),
    "arc-line-arc": turning("arc-line-arc"),
    "arc-arc-arc": turning("arc-arc-arc"),
    "parts": {
        "dragon": DRAGON,
        "route": {"kind": "parts", "part": PARTS},
        "walk": {"start": 12, "end": 45},
    },
    "square": {
        "dragon": DRAGON,
        "route": SPIRAL,
        "walk": {"end": 20},
        "venue": {"rectangle": [30.0, 20.0]},
        "obstacle": [
            {"kind": "circle", "centre": [1.0, 1.0], "radius": 0.5},
            {"kind": "rectangle", "centre": [1.0, 1.0], "size": [2.0, 1.0]},
            {"kind": "polygon", "points": [[5, 0], [7, 0], [6, 2]]},
            {"kind": "line", "points": [[-9, 4], [9, 4]]},
        ],
    },
    "outline": {
        "dragon": DRAGON,
        "route": SPIRAL,
        "walk": {"end": 20},
        "venue": {"boundary": [[-9, -9], [9, -9], [0, 9]]},
    },
    "formation": {"dragon": DRAGON, "route": {"kind": "formation", "name": "coil-in", "pitch": 1.0}},
    **{
        name: {"dragon": DRAGON, "route": {"kind": "formation", "name": name}}
        for name in (
            "coil-out", "figure-eight", "three-plum-blossoms", "double-door", "straight-dragon",
            "tail-swing",
        )
    },
    "programme": {"dragon": DRAGON, "route": {"kind": "programme", "formation": STEPS}},
}  # fmt: skip
BASES["drawn"] = {
    "dragon": DRAGON,
    "route": {"kind": "drawn", "points": [[0, 0], [30, 0], [40, 30], [20, 60]], "deviation": 2.0},
    "walk": {"start": 2, "end": 25},
}
BASES["surveyed"] = {
    "dragon": DRAGON,
    "route": {"kind": "drawn", "deviation": 0.2, "piece": PIECES},
    "walk": {"start": 2, "end": 5},
}
BASES["street"] = {
    "dragon": DRAGON,
    "route": {
        "kind": "turn", "rounds": 3, "street": {"points": [[-40, 0], [-25, 0], [-20, 8]]},
    },
    "walk": {"start": 2, "end": 60},
    "venue": {"rectangle": [44, 30]},
}  # fmt: skip
BASES["cues"] = {
    "dragon": DRAGON,
    "route": SPIRAL,
    "walk": {"end": 20},
    "cues": {
        "cue": [{"kind": "hold", "head": 5.0, "hold": 2.0}, {"kind": "tempo", "at": 13.5, "tempo": 99}]
    },
}
# Another value for each key; the number of a part is that of its kind in PARTS.
VARIED: dict[str, Any] = {
    "meta.title": "Other",
    "meta.title_zh": "别的",
    "meta.author": "Somebody",
    "meta.notes": "Something",
    "dragon.benches": 5,
    "dragon.width": 0.31,
    "dragon.head_length": 3.5,
    "dragon.body_length": 2.3,
    "dragon.tail_length": 2.3,
    "dragon.front_inset": 0.2,
    "dragon.rear_inset": 0.2,
    "dragon.bench": [{"length": 3}],
    "dragon.bench.0.length": 3.5,
    "dragon.bench.0.width": 0.31,
    "dragon.bench.0.front_inset": 0.2,
    "dragon.bench.0.rear_inset": 0.2,
    "dragon.bench.0.count": 2,
    "route.pitch": 1.2,
    "route.start_turn": 5,
    "route.clockwise": False,
    "route.part": PARTS[:2],
    "route.part.0.length": 31.0,
    "route.part.1.radius": 9.0,
    "route.part.1.angle": 70.0,
    "route.part.2.length": 7.0,
    "route.part.2.start_curvature": 0.05,
    "route.part.2.end_curvature": 0.05,
    "route.part.3.pitch": 1.6,
    "route.part.3.start_radius": 10.0,
    "route.part.3.end_radius": 7.0,
    "route.part.3.clockwise": False,
    "route.part.4.length": 6.0,
    "route.part.4.start_curvature": -0.15,
    "route.part.4.end_curvature": -0.15,
    "route.start": [1.0, 2.0],
    "route.heading": 30.0,
    "route.at": [3.0, 1.0],
    "route.turned": 20.0,
    "route.name": None,  # its other names are bases of their own
    "route.outer_radius": 13.0,
    "route.inner_radius": 2.9,
    "route.between": 3.0,
    "route.radius": 12.0,
    "route.waist": 5.0,
    "route.length": 60.0,
    "route.swing": 4.0,
    "route.swings": 4,
    "route.run": 50.0,
    "route.rounds": 2,
    "route.back_radius": 2.5,
    "route.street.points": [[-40, 0], [-25, 0], [-20, 6]],
    **{  # as those of drawn routes
        f"route.street.{name}": None
        for name in (
            "piece",
            "piece.0.start",
            "piece.0.heading",
            "piece.0.length",
            "piece.0.start_curvature",
            "piece.0.end_curvature",
            "file",
            "layer",
            "least_radius",
            "joint_gap",
            "joint_kink",
        )
    },
    "route.street.deviation": 0.9,
    "route.street.smooth": "G2",
    "route.street.drawn_within": 0.15,
    "route.street.radius": 4.0,
    "route.street.width": 5.0,
    "route.formation": STEPS[:2],
    "route.formation.0.name": "figure-eight",
    "route.formation.0.pitch": 1.2,
    "route.formation.0.outer_radius": 11.0,
    "route.formation.0.inner_radius": 2.9,
    "route.formation.1.between": 3.0,
    "route.formation.2.radius": 12.0,
    "route.formation.2.waist": 5.0,
    "route.formation.2.rounds": 2,
    "route.formation.3.length": 60.0,
    "route.formation.4.swing": 4.0,
    "route.formation.4.swings": 4,
    "route.formation.4.run": 50.0,
    "route.formation.0.clockwise": False,
    "route.formation.0.at": [-40.0, 0.0],
    "route.formation.0.turned": 20.0,
    "route.points": [[0, 0], [20, 0], [30, 12], [60, 12]],
    "route.piece": [{"start": [0, 0], "heading": 20, "length": 40}],
    "route.piece.0.start": [10.001, 0.0],
    "route.piece.0.heading": 90.005,
    "route.piece.0.length": 31.418,
    "route.piece.0.start_curvature": 0.100001,
    "route.piece.0.end_curvature": 0.100001,
    "route.file": None,  # becomes points before a plan is checked: tests/plans/test_drawn.py
    "route.layer": None,
    "route.deviation": 0.9,
    "route.smooth": "G2",
    "route.least_radius": None,  # what is too tight is refused: tests/surveys
    "route.closed": True,
    "route.joint_gap": None,
    "route.joint_kink": None,
    "route.drawn_within": 0.15,
    "survey.crs": None,  # speaks of files
    "survey.unit": None,
    "survey.origin": None,
    "venue.file": None,
    "venue.layer": None,
    "disc.radius": 2.9,
    "turn.family": None,  # its other families are bases of their own
    "turn.ratio": 1.8,
    "turn.radii": [2.0, 1.9],
    "turn.curvature": 0.05,
    "turn.entry_radius": 4.2,
    "turn.exit_radius": 4.2,
    "turn.ease": 0.2,
    "walk.speed": 0.9,
    "walk.profile": [[0, 1], [5, 0.8]],
    "walk.start": 13.0,
    "walk.end": 14.0,
    "walk.position": 0.5,
    "limits.speed": 0.1,
    "limits.acceleration": 1e-6,
    "limits.lateral_acceleration": 1e-6,
    "limits.total_acceleration": 1e-6,
    "limits.turning_rate": 1e-6,
    "limits.head_acceleration": 1e-4,
    "limits.margin": 5.0,
    "limits.venue_margin": 9.0,
    "venue.boundary": [[-8, -9], [9, -9], [0, 9]],
    "venue.rectangle": [31.0, 20.0],
    "venue.centre": [1.0, 0.0],
    "venue.angle": 10.0,
    "venue.name": "temple square",
    "obstacle": [{"kind": "line", "points": [[20, 0], [20, 9]]}],
    "obstacle.0.name": "well",
    "obstacle.0.margin": 0.2,
    "obstacle.0.centre": [1.0, 2.0],
    "obstacle.0.radius": 0.6,
    "obstacle.1.centre": [1.0, 2.0],
    "obstacle.1.size": [2.0, 1.5],
    "obstacle.1.angle": 10.0,
    "obstacle.2.points": [[5, 0], [7, 0], [6, 3]],
    "obstacle.3.points": [[-9, 4], [9, 5]],
    "cues.tempo": 80,
    "cues.bar": 3,
    "cues.acceleration": 0.3,
    "cues.clock": "18:30",
    "cues.cue": [{"kind": "hold", "head": 6.0, "hold": 2.0}],
    "cues.cue.0.hold": 3.0,
    "cues.cue.0.at": None,  # stands in place of the other: tests/plans/test_cues.py
    "cues.cue.0.head": 6.0,
    "cues.cue.0.place": None,  # stand in place of the others: tests/plans/test_rounds.py
    "cues.cue.0.round": None,
    "cues.cue.1.tempo": 100,
    "cues.cue.0.text": "bow",
    "cues.cue.0.text_zh": "拜庙",
    "chalk.stray": 0.3,
    "chalk.peg": [1.0, 2.0],
    "event.place": "Temple square",
    "event.place_zh": "祠堂广场",
    "event.date": "2027-02-20",
    "event.organiser": "Village",
    "event.contact": "Li",
    "event.spectators": 800,
    "event.marshals": 24,
    "event.distance": 3.0,
    "event.entrances": [[20.0, 0.0], [-20.0, 3.0, 4.0]],
    # What the people need is judged by `check`; the rest of it changes papers alone.
    **{f"people.{name}": 5.0 for name in ("beside", "ahead", "sway", "imprecision")},
    "people.most_speed": 0.1,
    **{
        f"people.{name}": None for name in PeopleTable.model_fields if name not in (*DECIDING, "source")
    },
    **{f"people.source.{name}": None for name in SourcesTable.model_fields},
    "base": None,  # it is a plan of its own: tests/plans/test_base.py
}


def keys(model: type[BaseModel], before: str = "") -> Iterator[str]:
    """Every key of a plan; lists of tables once, without a number."""
    for name, field in model.model_fields.items():
        key = before + (field.alias or name)
        tables = tables_in(field.annotation)
        if not tables or "list" in str(field.annotation):
            yield key
        for table in tables:
            yield from keys(table, f"{key}.")


def with_key(data: dict[str, Any], key: str, value: Any) -> dict[str, Any]:
    """Tables of a plan with another value under a key, the way pages and files say it."""
    changed: Any = copy.deepcopy(data)
    at, steps = changed, key.split(".")
    for step in steps[:-1]:
        at = at[int(step)] if isinstance(at, list) else at.setdefault(step, {})
    at[steps[-1]] = value
    return {"schema": 1, **changed}


def built(plan: Plan) -> list[Any]:
    """What comes of a plan: the walk and its times, and what it is called."""
    walk = plan.build()
    about = [plan.meta, walk.dragon.sizes, walk.route.rows, walk.profile, walk.start, plan.span(walk)]
    return [*about, plan.obstacles(), plan.cues, plan.chalk, plan.event]


def judged(plan: Plan) -> list[Any]:
    """What is found of a plan's limits, and the pace that keeps them."""
    found: list[Any] = [[finding.text for finding in check(plan).findings]]
    if not plan.walk.profile:
        found.append(slowed(plan.with_value("limits.turning_rate", 5.0)).profile)
    return found


def same(one: list[Any], other: list[Any]) -> bool:
    return all(
        np.array_equal(a, b) if isinstance(a, np.ndarray) else a == b
        for a, b in zip(one, other, strict=True)
    )


def test_every_key_of_plans_is_varied() -> None:
    known = {key for key in keys(Plan) if key.split(".")[-1] not in ("kind", "schema")}
    assert known == {".".join(step for step in key.split(".") if not step.isdigit()) for key in VARIED}
    kinds = [
        kind for table in tables_in(Plan.model_fields["route"].annotation) for kind in kinds_of(table)
    ]
    families = Plan.model_fields["turn"].annotation.model_fields["family"].annotation.__args__  # type: ignore[union-attr]
    assert {*kinds, *families} - {"turn"} < set(BASES)


def asked(base: str, key: str, value: Any) -> Plan | None:
    """The plan with another value under a key; None where the key is refused."""
    try:
        return checked(with_key(BASES[base], key, value), "varied")
    except PlanError as error:
        if "has no effect" in str(error) or "is not a known key" in str(error):
            return None
        raise


@pytest.mark.parametrize("base", BASES)
def test_whatever_a_plan_says_has_an_effect_or_is_refused(base: str) -> None:
    data = BASES[base]
    before = built(checked({"schema": 1, **data}, "base"))
    for key, value in VARIED.items():
        steps = key.split(".")
        listed = len(steps) > 2 and steps[1] not in data.get(steps[0], {})
        elsewhere = steps[0] == "cues" and base != "cues"
        if key.startswith(("limits.", "people.")) or value is None or listed or elsewhere:
            continue
        plan = asked(base, key, value)
        assert plan is None or not same(before, built(plan)), key


@pytest.mark.parametrize("base", ["profile", "arc-arc", "parts", "square"])
def test_every_limit_has_an_effect_or_is_refused(base: str) -> None:
    before = judged(checked({"schema": 1, **BASES[base]}, "base"))
    for key, value in VARIED.items():
        if key.startswith("limits."):
            plan = asked(base, key, value)
            assert plan is not None or key == "limits.venue_margin"
            assert plan is None or judged(plan) != before, key
    assert asked("square", "limits.venue_margin", 9.0) is not None


@pytest.mark.parametrize("name", DECIDING)
def test_what_people_need_has_an_effect(name: str) -> None:
    """A walk on a straight line, along one wall and towards another."""
    walls = [[[26, -9], [26, 9]], [[0, 3], [30, 3]]]
    data = {
        "dragon": DRAGON,
        "route": {"kind": "parts", "part": PARTS[:1]},
        "walk": {"position": 12, "start": 0, "end": 10},
        "obstacle": [{"kind": "line", "points": points} for points in walls],
    }
    plan = checked({"schema": 1, **data}, "walls")
    other = checked(with_key(data, f"people.{name}", VARIED[f"people.{name}"]), "walls")
    assert check(plan).safe
    assert not check(other).safe
    assert other.sha256 != plan.sha256


@pytest.mark.parametrize(
    ("base", "key", "sentence"),
    [
        ("parts", "disc.radius", 'disc.radius has no effect beside route.kind = "parts": take it out'),
        ("parts", "turn.ease", 'turn.ease has no effect beside route.kind = "parts": take it out'),
        ("spiral-in", "turn.family", 'turn.family has no effect beside route.kind = "spiral-in"'),
        ("arc-arc", "turn.radii", 'turn.radii has no effect beside turn.family = "arc-arc"'),
        ("arc-arc", "turn.curvature", 'turn.curvature has no effect beside turn.family = "arc-arc"'),
        ("arc-line-arc", "turn.curvature", 'no effect beside turn.family = "arc-line-arc"'),
        ("arc-line-arc", "turn.ratio", 'turn.ratio has no effect beside turn.family = "arc-line-arc"'),
        ("arc-arc-arc", "turn.ratio", 'turn.ratio has no effect beside turn.family = "arc-arc-arc"'),
        ("formation", "route.radius", 'route.radius has no effect beside route.name = "coil-in"'),
        ("formation", "disc.radius", 'disc.radius has no effect beside route.kind = "formation"'),
        (
            "programme",
            "route.formation.3.clockwise",
            'has no effect beside route.formation.3.name = "straight-dragon"',
        ),
        ("profile", "walk.speed", "walk.speed has no effect beside walk.profile: take it out"),
        ("list of benches", "dragon.width", "dragon.width has no effect beside [[dragon.bench]]"),
        ("outline", "venue.rectangle", "venue.rectangle has no effect beside venue.boundary"),
        ("parts", "venue.angle", "venue.angle has no effect without one of venue.rectangle, venue.b"),
        (
            "parts",
            "limits.venue_margin",
            "limits.venue_margin has no effect without one of venue.rectangle",
        ),
    ],
)
def test_what_has_no_effect_is_refused_in_one_sentence(base: str, key: str, sentence: str) -> None:
    value = "arc-arc" if key == "turn.family" else VARIED.get(key, False)
    with pytest.raises(PlanError) as caught:
        checked(with_key(BASES[base], key, value), "plan")
    assert sentence in str(caught.value)
    # In Python the same, by the same words.
    if isinstance(value, float):
        with pytest.raises(PlanError) as caught:
            checked({"schema": 1, **BASES[base]}, "plan").with_value(key, value)
        assert sentence in str(caught.value)


def test_a_default_that_is_written_down_is_said_too() -> None:
    with pytest.raises(PlanError, match=r"turn\.ratio has no effect"):
        checked(with_key(BASES["arc-line-arc"], "turn.ratio", 2.0), "plan")


def test_all_that_has_no_effect_is_named_at_once() -> None:
    data = with_key(with_key(BASES["parts"], "disc.radius", 3.0), "walk.profile", [[0, 1]])
    data["walk"]["speed"] = 1.0
    with pytest.raises(PlanError) as caught:
        checked(data, "plan")
    assert [line.split()[1] for line in str(caught.value).splitlines()] == ["disc.radius", "walk.speed"]


def test_a_setting_takes_along_what_the_file_says_for_the_former_choice() -> None:
    spiral = read_plan("spiral-in", ["walk.profile=[[0, 1], [9, 2]]"])
    assert "speed" not in spiral.data()["walk"]
    turn = read_plan("turn", ["turn.family=arc-line-arc"])
    assert "ratio" not in turn.data()["turn"]
    assert read_plan("turn", ["route.kind=spiral-in"]).data()["turn"] == {}
    assert "benches" not in read_plan("turn", ["dragon.bench=[{length=3}]"]).data()["dragon"]
    with pytest.raises(PlanError, match=r"walk\.speed has no effect beside walk\.profile"):
        read_plan("spiral-in", ["walk.profile=[[0, 1]]", "walk.speed=2"])


@pytest.mark.parametrize("key", ["route.pich", "pitch", "schema", "route.part.0.length", "turn", ""])
def test_a_key_that_is_none_cannot_be_given_a_value(key: str) -> None:
    with pytest.raises(PlanError, match=r"is not a known key|expected"):
        read_plan("turn").with_value(key, 1.5)


@pytest.mark.parametrize("base", BASES)
def test_all_keys_of_a_plan_written_down_are_the_same_plan(base: str) -> None:
    plan = checked({"schema": 1, **BASES[base]}, "base")
    again = checked(plan.data(), "again")
    assert (again.sha256, again.data()) == (plan.sha256, plan.data())


@pytest.mark.parametrize(
    ("base", "key", "advice"),
    [
        ("parts", "route.pitch", 'means nothing beside route.kind = "parts": choose another plan'),
        ("parts", "disc.radius", 'means nothing beside route.kind = "parts"'),
        ("spiral-in", "turn.ratio", 'means nothing beside route.kind = "spiral-in"'),
        ("list of benches", "dragon.width", "means nothing beside [[dragon.bench]]"),
        ("profile", "walk.speed", "means nothing beside walk.profile"),
        ("spiral-in", "disc.radius", "the plan does not say disc.radius: set it"),
        ("figure-eight", "route.radius", "the plan does not say route.radius: set it"),
        ("programme", "route.pitch", 'means nothing beside route.kind = "programme"'),
    ],
)
def test_advice_leads_into_no_second_refusal(base: str, key: str, advice: str) -> None:
    plan = checked({"schema": 1, **BASES[base]}, "base")
    with pytest.raises(PlanError) as caught:
        plan.value(key)
    assert advice in str(caught.value)
    if "set it" in advice:
        assert plan.with_value(key, 2.0).value(key) == 2.0
    else:
        with pytest.raises(PlanError, match=r"has no effect beside|is not a known key"):
            plan.with_value(key, 2.0)
