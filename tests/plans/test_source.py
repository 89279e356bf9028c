"""What is wrong with a plan is said with its key and its line, all at once."""

from pathlib import Path

import pytest

from benchdragon.plans.schema import checked, read_plan
from benchdragon.plans.source import MOST_FAULTS, Source, lines_of
from benchdragon.plans.toml import PlanError, read_toml

TEXT = '''# A plan that holds every form of TOML.
schema = 1
meta.title = "a # no comment, [no list"
"meta"."author" = 'x'

[meta.more]
notes = """
[not.a.table]
key = "in a text"
"""
lines = \'\'\'
[neither]\'\'\'

[[dragon.bench]]  # the head
length = 3
[[dragon.bench]]
count = 2
length = 2

[[ route . part ]]
kind = "line"
[[route.part]]
kind = "arc"
radius = 5

[walk]
profile = [
  [0, 1], # a comment ] with a bracket
  [9, "1 m/s"],
]
end = 12
limits = { speed = 2, deeper = { margin = 1 } }
'''


def test_every_key_of_a_file_has_its_line() -> None:
    assert lines_of(TEXT) == {
        "schema": 2,
        "meta": 4,
        "meta.title": 3,
        "meta.author": 4,
        "meta.more": 6,
        "meta.more.notes": 7,
        "meta.more.lines": 11,
        "dragon.bench": 14,
        "dragon.bench.0": 14,
        "dragon.bench.0.length": 15,
        "dragon.bench.1": 16,
        "dragon.bench.1.count": 17,
        "dragon.bench.1.length": 18,
        "route.part": 20,
        "route.part.0": 20,
        "route.part.0.kind": 21,
        "route.part.1": 22,
        "route.part.1.kind": 23,
        "route.part.1.radius": 24,
        "walk": 26,
        "walk.profile": 27,
        "walk.end": 31,
        "walk.limits": 32,
        "walk.limits.speed": 32,
        "walk.limits.deeper": 32,
        "walk.limits.deeper.margin": 32,
    }


def test_keys_of_all_examples_and_built_in_plans_have_lines() -> None:
    examples = sorted(str(path) for path in Path("examples").glob("*.toml"))
    assert examples
    for name in [*examples, "turn", "spiral-in"]:
        data, source = read_toml(name)
        lines, text = lines_of(source.text), source.text.splitlines()
        for table, said in data.items():
            for key in said if isinstance(said, dict) else []:
                assert key in text[lines[f"{table}.{key}"] - 1], (name, table, key)


def refused(path: Path, text: str, *settings: str) -> list[str]:
    """What is said of a plan file, line by line, without its folder."""
    path.write_text(text, "utf-8")
    with pytest.raises(PlanError) as caught:
        read_plan(str(path), settings).build()
    return str(caught.value).replace(f"{path.parent}/", "").splitlines()


def test_all_that_the_schema_refuses_is_said_with_its_line(tmp_path: Path) -> None:
    text = """schema = 1

[dragon]
benchs = 3
width = "x"

[[route.part]]
kind = "arc"
radius = -1

[disc]
radius = 3
"""
    units = "m, cm, mm, km, 米, 公尺, 厘米, 公分, 毫米"
    assert refused(tmp_path / "x.toml", text) == [
        f"x.toml:5: dragon.width: expected a number, or text with a unit of {units}, not 'x'",
        "x.toml:4: dragon.benchs is not a known key; did you mean dragon.benches?",
        "x.toml:9: route.part.0.radius: expected more than 0.0, not -1",
        "x.toml:7: route.part.0.angle is missing",
        'x.toml:12: disc.radius has no effect beside route.kind = "parts": take it out',
    ]


def test_all_that_cannot_be_built_is_said_with_its_line(tmp_path: Path) -> None:
    text = """schema = 1
[dragon]
benches = 9
body_length = 0.5
tail_length = "20 km"
[[route.part]]
kind = "line"
length = 5
[[route.part]]
kind = "arc"
radius = 5
angle = 0
[[route.part]]
kind = "clothoid"
length = 50
end_curvature = 1e6
[walk]
profile = [
  [0, 1], [0, 2],
]
"""
    insets = "its insets (0.275 m and 0.275 m) leave no link in a length of 0.5 m"
    assert refused(tmp_path / "x.toml", text) == [
        f"x.toml:4: dragon.body_length: bench 2: {insets}",
        "x.toml:5: dragon.tail_length: bench 9: length must be at most 10000 m, not 20000 m",
        "x.toml:9: route.part.1: the angle of an arc must not be 0",
        "x.toml:13: route.part.2: a clothoid may sweep at most 10000 rad, not 5e+07 rad",
        "x.toml:18: walk.profile: the times of a speed profile must increase",
    ]


def test_a_turn_and_its_benches_are_refused_together(tmp_path: Path) -> None:
    text = """schema = 1
[route]
kind = "turn"
[turn]
exit_radius = 5
[[dragon.bench]]
length = 3
[[dragon.bench]]
length = 2
count = 3
[[dragon.bench]]
length = 0.4
"""
    insets = "its insets (0.275 m and 0.275 m) leave no link in a length of 0.4 m"
    assert refused(tmp_path / "x.toml", text) == [
        f"x.toml:12: dragon.bench.2.length: bench 5: {insets}",
        "x.toml:5: turn.exit_radius (5 m) must not exceed disc.radius (4.5 m)",
    ]


@pytest.mark.parametrize(
    ("setting", "line"),
    [
        ("route.pitch=-1", "--set: route.pitch: expected more than 0.0, not -1"),
        ("route.pich=1", "--set: route.pich is not a known key; did you mean route.pitch?"),
        (
            "disc.radius=90",
            "--set: disc.radius (90 m) must be smaller than the radius of start_turn (8.8 m)",
        ),
        ("walk.speed=200", "--set: walk.speed: speed must be at most 100 m/s, not 200 m/s"),
        ("walk.position=1e9", "--set: walk.position: expected at most 100000000.0, not 1000000000.0"),
        ("dragon.body_length=0.1", "--set: dragon.body_length: bench 2: its insets"),
        ("dragon.width=20000", "--set: dragon.width: bench 1: width must be at most 10000 m"),
    ],
)
def test_a_setting_is_named_as_the_place(setting: str, line: str) -> None:
    with pytest.raises(PlanError) as caught:
        read_plan("spiral-in", [setting]).build()
    assert str(caught.value).startswith(line)


def test_a_plan_made_from_a_file_still_knows_where_it_was_read() -> None:
    plan = read_plan("turn")
    with pytest.raises(PlanError, match=r"^turn:22: disc\.radius: expected more than 0\.0, not -1"):
        plan.with_value("disc.radius", -1.0)
    assert plan == checked(read_toml("turn")[0], "elsewhere")


def test_of_very_many_faults_only_some_are_said() -> None:
    data = {"schema": 1, "route": {"kind": "spiral-in"}, "walk": {"profile": [[0, -1]] * 50}}
    with pytest.raises(PlanError) as caught:
        checked(data, Source("x"))
    said = str(caught.value).splitlines()
    assert len(said) == MOST_FAULTS + 1
    assert said[-1] == f"and {50 - MOST_FAULTS} more"
