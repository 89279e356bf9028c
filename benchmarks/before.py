"""An older version, or another engine, beside this one: two processes answer questions in turns."""

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
# What served, by what it had to import.
SERVED = {
    "numba": "compiled by numba",
    "wasmtime": "engine.wasm by Wasmtime",
    "": "a library built ahead of time",
}
TURNS = "Both warm, each in a process of its own, taking turns; the least of each."


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
        engine: that is to serve; if nothing is said, the one that serves by itself.

    Raises:
        RuntimeError: if the process takes the package from elsewhere.
    """

    def __init__(self, source: Path, engine: str = "") -> None:
        self.source, self.engine = source, ""
        self.process = subprocess.Popen(
            [sys.executable, str(HERE / "questions.py")],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
            env={**environment(source), "BENCHDRAGON_ENGINE": engine},
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
        self.engine = found["engine"]
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
    old, new, rows = paired(Version(source_of(options.before)), Version(SOURCE), options)
    return [
        f"Before: {described(Path(options.before))}, {SERVED[old.engine]}. After: "
        f"{described(HERE.parent)}, {SERVED[new.engine]}. {TURNS}",
        "",
        *lines_of(columns("before", "after"), rows),
    ]


def engines(options: Options) -> list[str]:
    """Rows of all questions, asked of engine.wasm and of the library."""
    _one, _other, rows = paired(Version(SOURCE, "wasm"), Version(SOURCE, "native"), options)
    return [TURNS, "", *lines_of(columns("engine.wasm", "library"), rows)]


def paired(one: Version, other: Version, options: Options) -> tuple[Version, Version, list[list[str]]]:
    """Both, ended, and the rows of all questions."""
    try:
        return one, other, [compared(name, one, other, options) for name in QUESTIONS]
    finally:
        one.close()
        other.close()


def columns(one: str, other: str) -> tuple[str, ...]:
    """The heads of columns."""
    return (
        "question", f"{one}, ms", f"{other}, ms", f"{one} / {other}", "by processor time",
        "answers differ by at most",
    )  # fmt: skip


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


def described(folder: Path) -> str:
    """The commit of a checkout; of a copy without history that it is one."""
    done = subprocess.run(
        ["git", "-C", str(folder), "log", "-1", "--format=%h of %cs"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return f"commit {done.stdout.strip()}" if done.returncode == 0 else "a copy without its history"
