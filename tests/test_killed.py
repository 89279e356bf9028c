"""Files appear whole or not at all, however a run ends: real runs, killed at a chosen moment."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.files import whole_file

pytestmark = pytest.mark.skipif(os.name == "nt", reason="no such signals here")

# The command line, which waits to be killed when a file is written and about to take its name: the
# first, or another.
HELD = """
import pathlib, select, sys
replace, left = pathlib.Path.replace, [int(sys.argv.pop(1))]
def held(self, target):
    left[0] -= 1
    if left[0] == 0:
        print("written", flush=True)
        # Not one long read: a signal that comes just before it would be heard after it alone.
        while not select.select([sys.stdin], [], [], 0.05)[0]:
            pass
    return replace(self, target)
pathlib.Path.replace = held
from benchdragon.__main__ import main
main()
"""
WALK = ["motion", "spiral-in", "--set", "dragon.benches=5", "--at", "0..3", "--quiet"]
WALK += ["--format", "csv,npz,parquet", "-o"]


def hidden(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir() if path.name.startswith("."))


@contextmanager
def held_at(count: int, folder: Path) -> Iterator["subprocess.Popen[str]"]:
    """A run that has written `count` files, the last of which has not its name yet."""
    command = [sys.executable, "-c", HELD, str(count), *WALK, str(folder)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "written\n"
        yield child
        child.kill()


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, int]:
    """The files of a run that was left alone, and their sizes."""
    folder = tmp_path_factory.mktemp("whole")
    assert run([*WALK, str(folder)]) == 0
    return {path.name: path.stat().st_size for path in folder.iterdir()}


def sizes(folder: Path) -> dict[str, int]:
    return {path.name: path.stat().st_size for path in folder.iterdir() if path.name[0] != "."}


@pytest.mark.parametrize("count", [1, 3])
def test_what_kill_9_leaves_is_whole_or_hidden_and_cleared_by_the_next_run(
    tmp_path: Path, whole: dict[str, int], count: int
) -> None:
    with held_at(count, tmp_path) as child:
        child.send_signal(signal.SIGKILL)
        assert child.wait() == -signal.SIGKILL
    found = sizes(tmp_path)
    assert len(found) == count - 1
    assert found.items() <= whole.items()
    assert len(hidden(tmp_path)) == 1
    assert run([*WALK, str(tmp_path), "--force"]) == 0
    assert hidden(tmp_path) == []
    assert sizes(tmp_path) == whole


def test_a_request_to_end_leaves_nothing_half_written(tmp_path: Path, whole: dict[str, int]) -> None:
    with held_at(2, tmp_path) as child:
        child.send_signal(signal.SIGTERM)
        assert child.wait() == 128 + signal.SIGTERM
    found = sizes(tmp_path)
    assert len(found) == 1
    assert found.items() <= whole.items()
    assert hidden(tmp_path) == []


def test_two_runs_into_one_folder_do_not_mix(
    tmp_path: Path, whole: dict[str, int], capsys: pytest.CaptureFixture[str]
) -> None:
    with held_at(1, tmp_path):
        assert run([*WALK, str(tmp_path), "--force"]) == 2
        assert capsys.readouterr().err == f"Error: another run is writing into {tmp_path}\n"
        assert sizes(tmp_path) == {}
        one = tmp_path / "a.dragon.toml"  # a file by itself cannot mix with others
        assert run(["plan", "turn", "-o", str(one), "--quiet"]) == 0
        one.unlink()
    assert run([*WALK, str(tmp_path)]) == 0
    assert sizes(tmp_path) == whole


def test_what_another_run_is_writing_now_is_not_taken_for_a_leftover(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    with whole_file(path) as first:
        first.write_text("first", encoding="utf-8")
        with whole_file(path) as second:
            second.write_text("second", encoding="utf-8")
        assert path.read_text(encoding="utf-8") == "second"
    assert path.read_text(encoding="utf-8") == "first"


def test_only_leftovers_of_the_same_file_are_cleared(tmp_path: Path) -> None:
    others = [
        ".a.txt",
        ".a.txt.0123abcd",
        ".b.txt.0123abcd.txt",
        ".a.txt.0123abcX.txt",
        "a.txt.0123abcd.txt",
    ]
    for name in (*others, ".a.txt.0123abcd.txt"):
        (tmp_path / name).touch()
    with whole_file(tmp_path / "a.txt") as temporary:
        temporary.touch()
    assert {path.name for path in tmp_path.iterdir()} == {*others, "a.txt"}
