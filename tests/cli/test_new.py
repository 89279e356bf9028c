"""What `benchdragon new` asks in a terminal."""

import os
import pty
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from benchdragon.plans.schema import read_plan

END_OF_INPUT = "\x04"
# In the order of the questions: benches, length, width, head, holes, square, bearers, beside, speeds.
ANSWERS = ["4", "a lot", "1.5m", "15cm", "", "", "25x20", "", "2", "", ""]


def asked(folder: Path, typed: str) -> tuple[int, str]:
    """The exit code and all that a terminal shows, in which that is typed."""
    ours, theirs = pty.openpty()
    line = [
        sys.executable,
        "-m",
        "benchdragon",
        "new",
        "-o",
        "v.dragon.toml",
        "--quiet",
        "--lang",
        "en",
    ]
    with subprocess.Popen(line, stdin=theirs, stdout=theirs, stderr=theirs, cwd=folder) as process:
        os.close(theirs)
        os.write(ours, typed.encode())
        shown = b""
        with suppress(OSError):  # so a terminal of Linux says that nobody writes there any more
            while piece := os.read(ours, 65_536):
                shown += piece
    os.close(ours)
    return process.returncode, shown.decode()


def test_questions_are_asked_until_they_are_answered_and_the_plan_is_written(tmp_path: Path) -> None:
    code, shown = asked(tmp_path, "".join(f"{answer}\n" for answer in ANSWERS))
    assert code == 0, shown
    assert "not 'a lot'" in shown
    assert shown.count("How long is a bench") == 2
    plan = read_plan(str(tmp_path / "v.dragon.toml"))
    assert plan.value("dragon.benches") == 4
    assert plan.value("dragon.body_length") == 1.5
    assert plan.venue.rectangle == (25.0, 20.0)
    assert "SAFE" in shown


@pytest.mark.parametrize("typed", [END_OF_INPUT, "4\n" + END_OF_INPUT])
def test_where_input_ends_nothing_is_written(tmp_path: Path, typed: str) -> None:
    code, shown = asked(tmp_path, typed)
    assert code != 0
    assert "Traceback" not in shown
    assert list(tmp_path.iterdir()) == []
