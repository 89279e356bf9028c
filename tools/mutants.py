"""Break the package on purpose, one place at a time, and see that the tests named for it fail.

A test that cannot fail holds nothing. Every table of tests/mutants/*.toml names a place of the package
(`file` and `old`, which stands there once), what is put there (`new`), and the tests one of which must
fail then. All of these are run on the unbroken package first. Kernels,
and what builds them, are broken uncompiled.

Run it as `make mutants`, or for some of them as `python tools/mutants.py WORD...`: those in whose area
(the name of the file of tables) or description one of the words stands.
"""

import itertools
import json
import multiprocessing
import os
import resource
import shutil
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "benchdragon"
TABLES = ROOT / "tests" / "mutants"
# What is broken there is not in what was built.
BUILT = ("kernels/", "engine/")
# A mutant may make a loop endless: it is killed then, s; or ask for endless memory, bytes.
PATIENCE = 900.0
MEMORY = 8 << 30
# How a child ends: so much more than pytest, for an exception ends with 1, too.
OURS = 10
PASSED, FAILED = OURS + 0, OURS + 1
# Children begin with what takes long to import, and nothing of the package.
SERVER = multiprocessing.get_context("forkserver")
SLOW = [
    "hypothesis",
    "matplotlib.pyplot",
    "pydantic",
    "pytest",
    "scipy.optimize",
    "scipy.spatial",
    "wasmtime",
]
# Each file that is written gets a time of its own, s.
TIMES = itertools.count(1)
# What tests ran of a file, beside the copy of the package.
SEEN = "seen.json"


@dataclass(frozen=True)
class Mutant:
    """One broken place of the package.

    Attributes:
        area: what it belongs to: the name of the file of tables that it stands in.
        what: what is wrong with it, in a few words.
        file: of the package.
        old: the text there.
        new: what is put in its place.
        tests: one of these must fail, as pytest takes them, from the folder `tests`.
    """

    area: str
    what: str
    file: str
    old: str
    new: str
    tests: tuple[str, ...]

    @property
    def plain(self) -> bool:
        """Whether it is tried with kernels that are not compiled."""
        return self.file.startswith(BUILT)

    def broken(self, text: str) -> str:
        """The file's text with the place broken.

        Raises:
            ValueError: if the place does not stand there once.
        """
        if (count := text.count(self.old)) != 1:
            raise ValueError(f"{self.what}: stands {count} times, not once, in {self.file}: {self.old}")
        return text.replace(self.old, self.new)


def mutants() -> list[Mutant]:
    """All that are known, area by area."""
    return [
        Mutant(path.stem, **{**table, "tests": tuple(table["tests"])})
        for path in sorted(TABLES.glob("*.toml"))
        for table in tomllib.loads(path.read_text("utf-8"))["mutant"]
    ]


def copied(folder: Path) -> Path:
    """A copy of the package to be broken."""
    package = folder / "broken" / "benchdragon"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    return package


def run(
    tests: Iterable[str], package: Path, plain: bool, patience: float = PATIENCE, seen: str = ""
) -> tuple[int | None, str]:
    """How pytest ends on these tests with that package, and what it says.

    Which lines of file `seen` each test runs is written beside the package: see `Seen`.
    """
    said = package.with_name("said")
    told = (list(tests), str(package.parent), plain, str(said), seen)
    child = SERVER.Process(target=run_here, args=told)
    child.start()
    child.join(patience)
    if child.is_alive():
        child.kill()
        return FAILED, f"no end within {patience:g} s"
    return child.exitcode, said.read_text("utf-8")


class Seen:
    """Notes which lines of one file each test runs, and how long it takes, s, as a plugin of pytest.

    It is written in the end, test by test: the test, its time, the lines.
    """

    def __init__(self, path: str, notes: Path) -> None:
        self.path, self.notes = path, notes
        self.lines, self.found = set[int](), list[tuple[str, float, list[int]]]()

    def called(self, frame: FrameType, *_event: object) -> Any:
        """Watch the lines of what is called, if it stands in the file."""
        return self.ran if frame.f_code.co_filename == self.path else None

    def ran(self, frame: FrameType, *_event: object) -> Any:
        """Note a line."""
        self.lines.add(frame.f_lineno)
        return self.ran

    def pytest_runtest_logstart(self) -> None:
        """A test begins, before anything is set up for it."""
        self.lines, self.began = set[int](), time.process_time()
        sys.settrace(self.called)

    def pytest_runtest_logfinish(self, nodeid: str) -> None:
        """A test has ended."""
        sys.settrace(None)
        took = time.process_time() - self.began
        self.found.append((nodeid.removeprefix("tests/"), took, sorted(self.lines)))

    def pytest_sessionfinish(self) -> None:
        """All have: what was noted is written."""
        self.notes.write_text(json.dumps(self.found), "utf-8")


def run_here(tests: list[str], source: str, plain: bool, said: str, seen: str) -> None:
    """Run tests in this process, with the package that stands in folder `source`."""
    import pytest

    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    os.chdir(ROOT)
    os.environ["BENCHDRAGON_ENGINE"] = "plain" if plain else ""
    sys.path[:0] = [source, str(ROOT)]
    os.environ["PYTHONPATH"] = source  # for the processes that tests start
    options = ["-q", "-x", "--no-header", "--tb=line", "-p", "no:cacheprovider"]
    options += ["-W", "ignore:Module already imported"]  # by the server
    with Path(said).open("w", encoding="utf-8") as file:
        for stream in (sys.stdout, sys.stderr):
            os.dup2(file.fileno(), stream.fileno())
        notes = Path(said).with_name(SEEN)
        plugins = [Seen(str(Path(source) / "benchdragon" / seen), notes)] if seen else []
        sys.exit(OURS + pytest.main([*options, *(f"tests/{test}" for test in tests)], plugins))


def put(path: Path, text: str) -> None:
    """Write a file of the package; bytecode is told from it by a time, in seconds, and its size."""
    path.write_text(text, "utf-8")
    os.utime(path, (next(TIMES),) * 2)


def survives(mutant: Mutant, package: Path) -> bool:
    """Whether all tests named for a mutant pass with it.

    Raises:
        ValueError: if the place is not found, or the tests cannot be run with it.
    """
    path = package / mutant.file
    sound = path.read_text("utf-8")
    put(path, mutant.broken(sound))
    try:
        ending, said = run(mutant.tests, package, mutant.plain)
    finally:
        put(path, sound)
    if ending not in (PASSED, FAILED):
        raise ValueError(f"{mutant.what}: the tests cannot be run with it\n{said}")
    return ending == PASSED


def tried(chosen: Sequence[Mutant]) -> list[Mutant]:
    """Those of the chosen mutants that survive; each is told of as soon as it has been tried.

    Raises:
        ValueError: if a table is wrong, or a test fails without any mutant.
    """
    survivors = []
    SERVER.set_forkserver_preload(SLOW)
    with tempfile.TemporaryDirectory() as folder:
        package = copied(Path(folder))
        for plain in sorted({mutant.plain for mutant in chosen}):
            some = [mutant for mutant in chosen if mutant.plain == plain]
            tests = dict.fromkeys(test for mutant in some for test in mutant.tests)
            ending, said = run(tests, package, plain)
            if ending != PASSED:
                raise ValueError(f"the tests do not pass without mutants\n{said}")
            for mutant in some:
                alive = survives(mutant, package)
                survivors += [mutant] if alive else []
                print(f"{'SURVIVED' if alive else 'killed  '} {mutant.area}: {mutant.what}", flush=True)
    return survivors


def main(words: Sequence[str]) -> int:
    """Try those mutants in whose area or description one of the words stands; all without words."""
    chosen = [
        mutant
        for mutant in mutants()
        if not words or any(word in f"{mutant.area}: {mutant.what}" for word in words)
    ]
    try:
        survivors = tried(chosen)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    print(f"{len(chosen) - len(survivors)} of {len(chosen)} killed")
    return 1 if survivors or not chosen else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
