"""An older version of this project beside this one: two processes answer questions in turns."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from questions import QUESTIONS
from timing import Options, digits, lines_of, repeats_of

HERE = Path(__file__).parent
SOURCE = HERE.parent / "src"


def source_of(folder: str) -> Path:
    """Where the package lies in a checkout.

    Raises:
        SystemExit: if it does not.
    """
    source = Path(folder).resolve() / "src"
    if not (source / "benchdragon" / "__init__.py").is_file():
        sys.exit(f"--before wants a checkout of this project, with src/benchdragon in it: {folder}")
    return source


class Version:
    """A process that answers questions by the package of one checkout.

    Args:
        source: the folder in which the package lies.

    Raises:
        RuntimeError: if the process takes the package from elsewhere.
    """

    def __init__(self, source: Path) -> None:
        self.source, self.numba = source, False
        self.process = subprocess.Popen(
            [sys.executable, str(HERE / "questions.py")],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment(source),
        )  # fmt: skip
        served = Path(self._line()["file"])
        if not served.is_relative_to(source):
            self.close()
            raise RuntimeError(f"asked for the version in {source}, but {served} was imported")

    def ask(self, name: str) -> dict[str, Any]:
        """What a question took, s by the clock and of processor time, and the numbers that came out."""
        assert self.process.stdin is not None
        self.process.stdin.write(name + "\n")
        self.process.stdin.flush()
        found = self._line()
        self.numba = found["numba"]
        return found

    def close(self) -> None:
        """End it."""
        self.process.communicate()

    def _line(self) -> dict[str, Any]:
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"the version in {self.source} died, see above")
        found: dict[str, Any] = json.loads(line)
        return found


def environment(source: Path) -> dict[str, str]:
    """That of a process which takes the package from there."""
    return {**os.environ, "PYTHONPATH": str(source)}


def before_and_after(options: Options) -> list[str]:
    """Rows of all questions, asked of the older version and of this one."""
    if options.before is None:
        return ["No older version was timed (`--before FOLDER`)."]
    old = Version(source_of(options.before))
    try:
        new = Version(SOURCE)
        try:
            rows = [compared(name, old, new, options) for name in QUESTIONS]
        finally:
            new.close()
    finally:
        old.close()
    columns = (
        "question", "before, ms", "after, ms", "before / after", "by processor time",
        "answers differ by at most",
    )  # fmt: skip
    return [
        f"Before: {described(Path(options.before))}, {engine(old)}. After: {described(HERE.parent)}, "
        f"{engine(new)}. Both warm, each in a process of its own, taking turns; the least of each.",
        "",
        *lines_of(columns, rows),
    ]


def compared(name: str, old: Version, new: Version, options: Options) -> list[str]:
    """A row: one question, the two taking turns."""
    first = [version.ask(name) for version in (old, new)]
    best = [{clock: found[clock] for clock in ("wall", "cpu")} for found in first]
    for _repeat in range(repeats_of(sum(found["wall"] for found in first), options) - 1):
        for version, least in zip((old, new), best, strict=True):
            found = version.ask(name)
            least.update({clock: min(seconds, found[clock]) for clock, seconds in least.items()})
    was, is_now = best
    apart = max(map(difference, first[0]["answers"], first[1]["answers"]))
    return [
        name, digits(1e3 * was["wall"]), digits(1e3 * is_now["wall"]),
        digits(was["wall"] / is_now["wall"]), digits(was["cpu"] / is_now["cpu"]), f"{apart:.0e}",
    ]  # fmt: skip


def difference(one: float, other: float) -> float:
    """How far two answers lie apart: not at all where neither is a number, as where nothing touches."""
    if math.isnan(one) or math.isnan(other):
        return 0.0 if math.isnan(one) and math.isnan(other) else math.inf
    return abs(one - other)


def engine(version: Version) -> str:
    """What served its kernels."""
    return "compiled by numba" if version.numba else "a library built ahead of time"


def described(folder: Path) -> str:
    """The commit of a checkout; of a copy without history that it is one."""
    done = subprocess.run(
        ["git", "-C", str(folder), "log", "-1", "--format=%h of %cs"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return f"commit {done.stdout.strip()}" if done.returncode == 0 else "a copy without its history"
