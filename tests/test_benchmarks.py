"""What `make bench` asks, without asking it: tests never look at a clock."""

import ast
import importlib
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest

import benchdragon as bd

ROOT = Path(__file__).parent.parent
FOLDER = ROOT / "benchmarks"


@pytest.fixture
def load(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module


def test_every_table_has_a_heading_of_its_own_and_a_function(load: Any) -> None:
    tables = load("run").TABLES
    assert len({table.heading for table in tables.values()}) == len(tables) > 10
    assert all(Path(table.job.__code__.co_filename).parent == FOLDER for table in tables.values())


def test_every_target_is_that_of_a_question(load: Any) -> None:
    questions = load("questions").QUESTIONS
    assert set(load("targets").TARGETS) <= set(questions)
    named = [
        p.arguments[1] for p in load("startup").PROCESSES.values() if "questions.py" in p.arguments[0]
    ]
    assert named
    assert set(named) <= set(questions)


def test_questions_go_through_the_front_door_alone() -> None:
    tree = ast.parse((FOLDER / "questions.py").read_text("utf-8"))
    imported = [node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    assert not [name for name in imported if name and name.startswith("benchdragon")]
    named = {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id == "bd"
    }
    assert {"first_contact", "smallest_pitch"} < named <= {*bd.__all__, "__file__"}


def test_a_target_is_met_up_to_its_very_value(load: Any) -> None:
    row = load("targets").row
    assert [row("", ours, 5.0)[3] for ours in (4.9, 5.0, 5.1)] == ["yes", "yes", "NO"]
    assert row("", 2.0, 5.0, "rival", 8.0)[-1] == "4"


def test_a_process_that_ends_otherwise_than_it_should_is_no_measurement(load: Any) -> None:
    spent = load("timing").spent
    assert spent(["-c", "import sys; sys.exit(3)"], 3, {}).peak > 1.0
    with pytest.raises(RuntimeError, match="ended with 3, not 0"):
        spent(["-c", "import sys; sys.exit(3)"], 0, {})


def test_what_is_no_checkout_is_refused(load: Any, tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match="wants a checkout"):
        load("before").source_of(str(tmp_path))


def test_a_version_answers_by_the_checkout_that_was_named_or_not_at_all(
    load: Any, tmp_path: Path
) -> None:
    before = load("before")
    old = tmp_path / "src" / "benchdragon"
    old.mkdir(parents=True)
    source = before.source_of(str(ROOT))
    version = before.Version(source)
    try:
        found = version.ask("standard table, 224 handles x 301 times")
    finally:
        version.close()
    assert len(found["answers"]) == 224
    (old / "__init__.py").write_text(
        f"__file__ = {str(tmp_path.parent / 'elsewhere.py')!r}\nclass Answer: pass\n", "utf-8"
    )
    with pytest.raises(RuntimeError, match="was imported"):
        before.Version(before.source_of(str(tmp_path)))


def test_answers_differ_by_nothing_where_neither_is_a_number(load: Any) -> None:
    difference, nan = load("before").difference, float("nan")
    assert (difference(nan, nan), difference(1.0, 3.0)) == (0.0, 2.0)
    assert difference(nan, 1.0) == difference(1.0, nan) == float("inf")


def test_what_an_installation_brings_is_all_that_it_needs(load: Any) -> None:
    brought = load("startup").brought
    wanted = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["dependencies"]
    assert "llvmlite" in brought(["numba>=0.61"])
    assert "llvmlite" not in brought(wanted)
    assert "wasmtime" in brought(wanted)
    assert "numpy" in brought(["scipy"])
    assert "llvmlite" not in brought(["scipy"])
    assert sys.modules["startup"].bytes_of("numpy") > 1e6
