"""Shells complete verbs, options, plans and keys."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.cli.shell import SHELLS, VARIABLE
from benchdragon.plans.faults import single_keys
from benchdragon.plans.schema import Plan, read_plan

VILLAGE = "village.dragon.toml"


def completed(
    line: str, shell: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> list[str]:
    """What a shell is offered for the last word of a line, by the program itself."""
    words = line.split(" ")
    begun = words[-1] if shell == "fish" else str(len(words) - 1)
    for name, value in ((VARIABLE, f"{shell}_complete"), ("COMP_WORDS", line), ("COMP_CWORD", begun)):
        monkeypatch.setenv(name, value)
    assert run([]) == 0
    return capsys.readouterr().out.replace(",", "\n").replace("\t", "\n").split("\n")


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize(
    ("line", "offered", "not_offered"),
    [
        ("benchdragon che", {"check"}, "motion"),
        ("benchdragon solve pi", {"pitch"}, "check"),
        ("benchdragon check sp", {"spiral-in"}, "turn"),
        ("benchdragon check vi", {VILLAGE}, "turn"),
        ("benchdragon check turn --pro", {"--prove", "--prove-all"}, "--set"),
        ("benchdragon check turn --set route.p", {"route.pitch="}, "route.kind="),
        ("benchdragon sweep turn --vary disc", {"disc.radius="}, "route.pitch="),
    ],
)
def test_what_is_begun_is_offered_whole(
    shell: str, line: str, offered: set[str], not_offered: str, tmp_path: Path,
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    Path(VILLAGE).touch()
    found = completed(line, shell, capsys, monkeypatch)
    assert offered <= set(found)
    assert not_offered not in found


@pytest.mark.parametrize("shell", SHELLS)
def test_the_script_of_each_shell_asks_the_program(
    shell: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["completion", shell]) == 0
    script = capsys.readouterr().out
    assert f"{VARIABLE}={shell}_complete" in script
    assert len(script.splitlines()) < 60


@pytest.mark.skipif(shutil.which("bash") is None, reason="no bash here")
def test_bash_completes_a_key_and_waits_for_its_value(tmp_path: Path) -> None:
    program = tmp_path / "benchdragon"
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m benchdragon "$@"\n', "utf-8")
    program.chmod(0o755)
    asked = """
        eval "$(benchdragon completion bash)"
        compopt() { echo compopt "$@"; }
        COMP_WORDS=(benchdragon check turn --set route.pit); COMP_CWORD=4
        _benchdragon_completion benchdragon; echo "${COMPREPLY[*]}"
        COMP_WORDS=(benchdragon che); COMP_CWORD=1; COMPREPLY=()
        _benchdragon_completion benchdragon; echo "${COMPREPLY[*]}"
    """
    path = f"{tmp_path}:{os.environ['PATH']}"
    found = subprocess.run(
        ["bash", "-c", asked], capture_output=True, text=True, check=True,
        env={**os.environ, "PATH": path},
    )  # fmt: skip
    assert found.stdout.splitlines() == ["compopt -o nospace", "route.pitch=", "check"]


def test_every_key_that_a_plan_says_is_among_those_that_are_completed() -> None:
    keys = single_keys(Plan)
    assert len(keys) == len(set(keys)) > 60
    said = read_plan("turn").said()
    assert {f"{name}.{key}" for name, table in said.items() if name != "schema" for key in table} <= {
        *keys
    }
    assert "obstacle.radius" not in keys
