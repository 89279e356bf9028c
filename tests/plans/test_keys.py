"""Every key of a plan file is described, and plans are printed as files that read back the same."""

import json
import tomllib
from pathlib import Path
from typing import Annotated, Any

import jsonschema
import pytest
from pydantic import TypeAdapter, ValidationError
from tools.make_keys import page

from benchdragon.cli.main import run
from benchdragon.i18n import LANGUAGES, spoken_in
from benchdragon.plans.keys import commented, schema, written
from benchdragon.plans.presets import REPORTERS, presets
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.sections import SECTIONS, Section
from benchdragon.plans.toml import PlanError, built_in_names
from tests.plans.test_effects import BASES

# Of a drawn route, whether it has points or surveyed pieces.
DRAWN_KEYS = ("kind", "deviation", "smooth", "least_radius", "closed", "drawn_within", "at", "turned")
EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.dragon.toml"))


@pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.header or "schema")
def test_every_key_of_every_table_is_described(section: Section) -> None:
    names = {field.alias or name for name, field in section.table.model_fields.items()}
    tables = {"meta", "dragon", "route", "disc", "turn", "walk", "limits", "venue", "obstacle"}
    tables |= {"survey", "people", "cues", "chalk", "event"}
    assert set(section.keys) == names - (tables if section.table is Plan else set())


@pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.header or "schema")
def test_a_bare_number_is_in_the_unit_that_is_said(section: Section) -> None:
    fields = {field.alias or name: field for name, field in section.table.model_fields.items()}
    for name, key in section.keys.items():
        if isinstance(key.example, list | bool) or not (
            key.unit or isinstance(key.example, int | float)
        ):
            continue  # of several numbers, or none
        kind: Any = Annotated[fields[name].annotation, *(fields[name].metadata or [None])]
        number = TypeAdapter(kind)
        if key.unit in ("", "1/m"):
            with pytest.raises(ValidationError):
                number.validate_python("1 m")
        else:
            assert number.validate_python(f"1 {key.unit}") == 1.0, name


def test_each_example_is_taken_with_its_unit() -> None:
    parts = [
        {name: key.example for name, key in section.keys.items()}
        for section in SECTIONS
        if section.header.startswith("[[route.part]]")
    ]
    said = {
        section.header: {name: key.example for name, key in section.keys.items()}
        for section in SECTIONS
    }
    turn = {**said["[turn]"], "family": "arc-line-arc"}
    del turn["ratio"], turn["curvature"]
    walk = {name: value for name, value in said["[walk]"].items() if name != "profile"}
    dragon = {name: value for name, value in said["[dragon]"].items() if name != "bench"}
    edge = {name: said["[venue]"][name] for name in ("rectangle", "centre", "angle", "name")}
    standing = [keys for header, keys in said.items() if header.startswith("[[obstacle]]")]
    for n, keys in enumerate(standing):
        keys["name"] += f" {n}"
    common = {"schema": 1, "meta": said["[meta]"], "limits": said["[limits]"], "venue": edge}
    common["obstacle"] = standing
    spiral = {**common, "route": said['[route] kind = "spiral-in"'], "dragon": dragon, "walk": walk}
    checked(spiral, "spiral-in")
    listed = {"bench": [said["[[dragon.bench]]"]]}
    profiled = {"profile": said["[walk]"]["profile"]}
    route = said['[route] kind = "turn"']
    checked({**common, "dragon": listed, "route": route, "turn": turn, "disc": said["[disc]"]}, "turn")
    whole = {**said['[route] kind = "parts"'], "part": parts}
    outline = {"boundary": said["[venue]"]["boundary"]}
    plan = checked({**common, "route": whole, "walk": profiled, "venue": outline}, "parts")
    assert len(plan.obstacles()) == 1 + len(standing)
    drawn = said['[route] kind = "drawn"']
    survey = {**common, "survey": said["[survey]"]}
    pointed = {name: drawn[name] for name in DRAWN_KEYS if name in drawn} | {"points": drawn["points"]}
    checked({**survey, "route": pointed}, "drawn")
    joints = {name: drawn[name] for name in ("joint_gap", "joint_kink")}
    checked(
        {**survey, "route": pointed | joints | {"points": None, "piece": [said["[[route.piece]]"]]}},
        "surveyed",
    )


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_schema_says_what_each_key_means(language: str) -> None:
    with spoken_in(language):
        said = schema()
    pitch = said["$defs"]["SpiralInRoute"]["properties"]["pitch"]
    assert pitch["description"] == {
        "en": "distance between neighbouring turns of the spiral", "zh": "螺线的螺距",
    }[language]  # fmt: skip
    assert (pitch["unit"], pitch["default"], pitch["examples"]) == ("m", 0.55, ["55 cm"])
    for name, table in [*said["$defs"].items(), ("plan", said)]:
        assert table["description"], name
        for key, about in table["properties"].items():
            assert "description" in about or name == "plan", (name, key)
    for path in EXAMPLES:
        jsonschema.validate(tomllib.loads(path.read_text("utf-8")), said)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_manual_lists_every_key(language: str) -> None:
    text = page(language)[1]
    for section in SECTIONS:
        assert all(f"| `{name}` |" in text for name in section.keys)


def test_the_table_for_readers_shows_headers_as_they_stand_in_files(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["schema", "--table"]) == 0
    out = capsys.readouterr().out
    for section in SECTIONS:
        assert section.header in out
        assert all(f"\n{name}\t" in out for name in section.keys)


def test_no_word_of_the_table_is_cut_off(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "100")
    for language in LANGUAGES:
        with spoken_in(language):
            assert run(["schema", "--table"]) == 0
        shown = capsys.readouterr().out
        assert "│" in shown
        assert "…" not in shown


@pytest.mark.parametrize(
    "value", [1, 0.5, True, 'a "b" # c', "盘", [1.5, 2.0], [[0, 1], [2, 3]], [{"a": 1}]]
)
def test_a_value_is_written_as_toml(value: object) -> None:
    assert tomllib.loads(f"x = {written(value)}") == {"x": value}


@pytest.mark.parametrize("base", BASES)
def test_a_printed_plan_reads_as_the_same_plan(base: str) -> None:
    plan = checked({"schema": 1, "meta": {"notes": 'two\nlines "#"'}, **BASES[base]}, "base")
    again = checked(tomllib.loads(commented(plan.data(), {})), "again")
    assert (again.sha256, again.data()) == (plan.sha256, plan.data())


@pytest.mark.parametrize("name", [*built_in_names(), *(str(path) for path in EXAMPLES)])
def test_built_in_plans_and_files_are_printed_and_read_back(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, name: str
) -> None:
    for settings in ([], ["--set", "dragon.front_inset=0.2"]):
        if settings and "own_benches" in name:
            continue
        path = tmp_path / f"{len(settings)}.dragon.toml"
        assert run(["plan", name, *settings]) == 0
        text = capsys.readouterr().out
        assert run(["plan", name, *settings, "-o", str(path)]) == 0
        capsys.readouterr()
        assert path.read_text("utf-8") == text
        assert "#" in text
        assert read_plan(str(path)).sha256 == read_plan(name, settings[1:]).sha256


@pytest.mark.parametrize("name", REPORTERS)
def test_a_villages_dragon_is_printed_with_where_its_figures_come_from(
    capsys: pytest.CaptureFixture[str], name: str
) -> None:
    preset = {preset.name: preset for preset in presets()}[name]
    assert run(["plan", name]) == 0
    text = capsys.readouterr().out
    assert text.startswith(f"# {preset.source.en}\n")
    assert checked(tomllib.loads(text), name).sha256 == preset.plan.sha256
    for figure in preset.figures:
        key = figure.key.rpartition(".")[2]
        assert any(
            line.startswith(f"{key} = ") and f"({figure.status})" in line for line in text.splitlines()
        )
    assert run(["plan", name, "--set", "walk.speed=0.5"]) == 0
    changed = checked(tomllib.loads(capsys.readouterr().out), name)
    assert changed.sha256 == preset.plan.with_value("walk.speed", 0.5).sha256
    assert run(["plan", name, "--set", "walk.spead=0.5"]) == PlanError.exit_code
    assert "--set: walk.spead is not a known key" in capsys.readouterr().err


def test_all_plans_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["plan"]) == 0
    names = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert names == built_in_names()


def test_the_plan_in_effect_is_shown_beside_the_verdict(capsys: pytest.CaptureFixture[str]) -> None:
    line = ["check", "spiral-in", "--set", "dragon.benches=4", "--set", "walk.end=3", "--show-plan"]
    assert run(line) == 0
    out = capsys.readouterr().out
    plan = read_plan("spiral-in", ["dragon.benches=4", "walk.end=3"])
    assert checked(tomllib.loads(out[out.index("\nschema = 1") :]), "shown").sha256 == plan.sha256
    assert run([*line, "--json"]) == 0
    assert checked(json.loads(capsys.readouterr().out)["plan"], "shown").sha256 == plan.sha256
