"""Whole processes from their start: time with caches and without, memory, and what is installed."""

import gzip
import re
import tempfile
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import metadata
from pathlib import Path
from subprocess import run
from sys import executable

from before import HERE, SOURCE, environment, source_of
from packaging.requirements import Requirement
from timing import Options, Spent, digits, least, lines_of, spent

from benchdragon.hosts.built import ENGINE
from benchdragon.hosts.native import find_library

DOOR = ("-m", "benchdragon")
FIRST_TABLE = (
    "import numpy as np, benchdragon as bd\nbd.read_plan('spiral-in').build().motion(np.arange(301.0))"
)
# A check of so long a dragon may take so much memory, MB.
LONG, SHORT, MEMORY = 3000, 223, 300.0
WASM = {"BENCHDRAGON_ENGINE": "wasm"}
WARM, QUICK_WARM = 5, 2


@dataclass(frozen=True)
class Process:
    """A whole process of Python.

    Attributes:
        arguments: of the interpreter.
        code: with which it ends.
        empty: whether it is timed without caches too.
        engine: what chooses who serves in this version; the older one is then not timed.
    """

    arguments: Sequence[str]
    code: int = 0
    empty: bool = False
    engine: Mapping[str, str] | None = None


PROCESSES = {
    "`benchdragon --help`": Process([*DOOR, "--help"]),
    "`benchdragon motion spiral-in --at 60`": Process(
        [*DOOR, "motion", "spiral-in", "--at", "60", "--json", "--quiet"]
    ),
    "first table, 224 handles x 301 times": Process(["-c", FIRST_TABLE], empty=True),
    "first table by engine.wasm": Process(["-c", FIRST_TABLE], empty=True, engine=WASM),
    "`benchdragon check spiral-in`": Process(
        [*DOOR, "check", "spiral-in", "--quiet"], code=1, empty=True
    ),
    "`benchdragon check spiral-in` by engine.wasm": Process(
        [*DOOR, "check", "spiral-in", "--quiet"], code=1, empty=True, engine=WASM
    ),
    "the contest's five questions": Process(
        [str(HERE / "questions.py"), "the contest's five questions"]
    ),
}


def whole_processes(options: Options) -> list[str]:
    """Rows of processes in turns of the older version, if there is one, and this one."""
    old = None if options.before is None else source_of(options.before)
    for source in filter(None, (old, SOURCE)):  # as pip does when it installs
        run([executable, "-m", "compileall", "-q", str(source / "benchdragon")], check=True)
    columns = (
        "whole process", "caches", "before, s", "of processor", "after, s", "of processor",
        "before / after", "of processor",
    )  # fmt: skip
    rows: list[list[str]] = []
    for name, process in PROCESSES.items():
        rows += rows_of(name, process, old, options)
    return [
        "The least of several; with empty caches, those of what numba or Wasmtime compiled, once.",
        "",
        *(lines_of(columns, rows) if old else lines_of([*columns[:2], *columns[4:6]], rows)),
    ]


def rows_of(name: str, process: Process, old: Path | None, options: Options) -> list[list[str]]:
    """The rows of one process: caches empty, and warm."""
    sources = [SOURCE] if old is None or process.engine else [old, SOURCE]
    with tempfile.TemporaryDirectory() as folder:
        runs = [partial(started, process, source, Path(folder)) for source in sources]
        found = {"empty": [job() for job in runs]}
        if not process.empty:
            del found["empty"]
        turns = [[job() for job in runs] for _turn in range(QUICK_WARM if options.quick else WARM)]
        found["warm"] = [least(every) for every in zip(*turns, strict=True)]
    return [[name, caches, *cells(each, old is not None)] for caches, each in found.items()]


def started(process: Process, source: Path, folder: Path) -> Spent:
    """What the process takes by the package in `source`, which has caches of its own in `folder`."""
    home = folder / source.as_posix().replace("/", "_")
    home.mkdir(exist_ok=True)
    caches = {"HOME": str(home), "XDG_CACHE_HOME": str(home)}
    return spent(
        process.arguments, process.code, {**environment(source), **caches, **(process.engine or {})}
    )


def cells(found: Sequence[Spent], compared: bool) -> list[str]:
    """Seconds of the older version, if there is one, of this one, and their ratios."""
    times = [digits(seconds) for each in found for seconds in (each.wall, each.cpu)]
    if not compared:
        return times
    if len(found) == 1:
        return ["", "", *times, "", ""]
    old, new = found
    return [*times, digits(old.wall / new.wall), digits(old.cpu / new.cpu)]


def memory(options: Options) -> list[str]:
    """Rows of the memory of a check of a long dragon on the turn."""
    benches = SHORT if options.quick else LONG
    short, long = (
        Process([*DOOR, "check", "turn", "--set", f"dragon.benches={count}", "--quiet"])
        for count in (SHORT, benches)
    )
    sources = {"before": None if options.before is None else source_of(options.before), "after": SOURCE}
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name, source in sources.items():
            if source is not None:
                started(short, source, Path(folder))  # fills what caches there are
                found = started(long, source, Path(folder))
                met = "yes" if found.peak <= MEMORY else "NO"
                rows.append([name, digits(found.peak), digits(MEMORY), met, digits(found.wall)])
    task = f"`benchdragon check turn --set dragon.benches={benches}`"
    return lines_of((task, "peak memory, MB", "target, MB", "met", "s"), rows)


def sizes(_options: Options) -> list[str]:
    """Rows of the files of the engine, and of what an installation brings."""
    library = find_library()
    rows = []
    for name, path in (("library", library), ("engine.wasm", ENGINE / "engine.wasm")):
        if path is None:
            rows.append([name, "none was built", ""])
            continue
        data = path.read_bytes()
        rows.append([name, digits(len(data) / 1e3), digits(len(gzip.compress(data)) / 1e3)])
    project = tomllib.loads((HERE.parent / "pyproject.toml").read_text("utf-8"))["project"]
    wanted, built = project["dependencies"], project["optional-dependencies"]["build"]
    installed = []
    for name, texts in (("all of them", wanted), ("with the extra `build`", [*wanted, *built])):
        found = brought(texts)
        bulk = sum(map(bytes_of, found))
        installed.append([name, str(len(found)), digits(bulk / 1e6), ", ".join(found)])
    return [
        *lines_of(("engine", "kB", "gzip, kB"), rows), "",
        *lines_of(("run-time dependencies", "packages", "MB installed", "which"), installed),
    ]  # fmt: skip


def brought(requirements: Sequence[str]) -> list[str]:
    """All packages that these need here, themselves included, in order."""
    found: set[str] = set()
    waiting = [Requirement(text) for text in requirements]
    while waiting:
        requirement = waiting.pop()
        name = re.sub(r"[-_.]+", "-", requirement.name).lower()
        if name in found or (requirement.marker and not requirement.marker.evaluate({"extra": ""})):
            continue
        found.add(name)
        waiting += [Requirement(text) for text in metadata.requires(name) or ()]
    return sorted(found)


def bytes_of(name: str) -> int:
    """How much a package takes on disk, without what Python compiles of it."""
    files = [Path(str(file.locate())) for file in metadata.files(name) or ()]
    return sum(path.stat().st_size for path in files if path.suffix != ".pyc" and path.is_file())
