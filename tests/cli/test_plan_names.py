"""Every plan that `plan` lists can be named to every verb that takes one, and as a base."""

import itertools
from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.plans.schema import read_plan
from benchdragon.plans.toml import PlanError, built_in_names
from tests.cli.verbs import VERBS, options

TAKING = [
    name for name, verb in VERBS.items() if any(parameter.name == "plan" for parameter in verb.params)
]
# What a verb asks for beside a plan, before it reads that.
BESIDE = {
    "view": ["-o", "a.html"],
    "planner": ["-o", "a.html"],
    "sweep": ["--vary", "route.pitch=1,2", "-o", "a"],
    "area": ["-o", "a.svg"],
}


def listed(capsys: pytest.CaptureFixture[str]) -> list[str]:
    assert run(["plan"]) == 0
    return [line.split()[0] for line in capsys.readouterr().out.splitlines()]


def test_every_verb_takes_every_plan_that_is_listed(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each finds what is wrong in the plan of that name: it has read it."""
    monkeypatch.chdir(tmp_path)
    names = listed(capsys)
    assert names == built_in_names()
    assert len(TAKING) > 15
    assert [verb for verb in TAKING if "--set" not in options(VERBS[verb])] == []
    for verb, name in itertools.product(TAKING, names):
        wrong = ["--set", "dragon.widht=1", *BESIDE.get(verb, [])]
        assert run([*verb.split(), name, *wrong]) == PlanError.exit_code, (verb, name)
        assert "--set: dragon.widht is not a known key" in capsys.readouterr().err, (verb, name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", built_in_names())
def test_a_plan_that_is_listed_walks_and_is_a_base(
    name: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert run(["motion", name, "--at", "0", "--only", "0", "--quiet"]) == 0
    assert capsys.readouterr().out.splitlines()[2].startswith("0\t0\t")
    path = tmp_path / "own.dragon.toml"
    path.write_text(f'schema = 1\nbase = "{name}"\n[dragon]\nbenches = 9\n', encoding="utf-8")
    assert read_plan(str(path)).sha256 == read_plan(name, ["dragon.benches=9"]).sha256


def test_a_name_that_is_not_listed_is_refused_with_those_that_are(
    capsys: pytest.CaptureFixture[str],
) -> None:
    names = ", ".join(listed(capsys))
    assert run(["check", "question-4"]) == PlanError.exit_code
    said = capsys.readouterr().err
    assert f"one of {names}; did you mean question-3?" in " ".join(said.split())
