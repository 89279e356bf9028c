"""Calls of entries, recorded while real questions are asked, and done again by each engine.

calls.json says of each call the entry, where its arrays lie in before.bin, and where its results are to
be put there. Doing a call again leaves the arrays and results in such a memory as they come out: by
plain Python, by the library, by engine.wasm in Python, in Node and in browsers.
"""

import json
import math
import os
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from benchdragon.engine import wasm
from benchdragon.hosts import built
from benchdragon.hosts.arguments import DTYPES
from benchdragon.hosts.serving import PLAIN, VARIABLE
from benchdragon.hosts.signature import Parameter, signature
from benchdragon.kernels import bench_nearness, entries
from benchdragon.kernels.bench_nearness import TightMoment
from benchdragon.kernels.time_of_impact import Note
from tests.engine.questions import questions, wrap

PACKAGE = Path(wasm.__file__).parents[1]
MODULE = PACKAGE / "engine" / built.MODULE
LOADER = PACKAGE / "web" / "engine.js"
HERE = Path(__file__).parent
CODES = {dtype: code for code, dtype in DTYPES.items()}
# Questions under way are known to their engine alone, by handles: what they answer is compared whole
# (tests/solve/test_size_question.py and others), not call by call.
WHOLE = tuple(
    f"benchdragon.kernels.{name}."
    for name in (
        "memory",
        "question",
        "random_dance_question",
        "size_question",
        "contact_question",
        "speed_question",
        "obstacle_question",
        "turn_question",
    )
)
# Of each entry so many calls are kept, of which none takes more bytes than this.
CALLS, BYTES = 12, 4_000_000

# Of searches only what they answer is compared, by parameter: the rest of their arrays is scratch that
# depends on the last digits, and of equals any may be seen first.
ANSWERS: dict[str, dict[str, Any]] = {
    "bd_walk_search_search_walk": {"note": [Note.LOWER, Note.NEAREST]},
    "bd_bench_nearness_find_tightest": {
        "out": slice(TightMoment.UPPER, None, bench_nearness.TIGHTEST_COLUMNS)
    },
    "bd_local_minima_local_minimum": {},
}
# Where a distance is least is known to half its digits only: of these only the other results count.
RESULTS = {"bd_local_minima_local_minimum": [0]}


@dataclass
class Recording:
    """Calls so far, and what went in."""

    calls: list[dict[str, Any]] = field(default_factory=list)
    before: bytearray = field(default_factory=bytearray)

    def call(self, symbol: str, function: Callable[..., Any], *values: Any) -> Any:
        """Call an entry, and keep what with."""
        self.calls.append({"entry": symbol, "values": [self._told(value) for value in values]})
        result = function(*values)
        self.calls[-1]["results"] = len(self.before)
        self.before += bytes(8 * (len(result) if isinstance(result, tuple) else 1))
        return result

    def _told(self, value: Any) -> Any:
        """An argument as JSON; arrays are put into `before`."""
        if isinstance(value, tuple):
            names: tuple[str, ...] = value._fields  # type: ignore[attr-defined]
            return {"fields": dict(zip(names, map(self._told, value), strict=True))}
        if not isinstance(value, np.ndarray):
            return str(value).replace("inf", "Infinity") if isinstance(value, float) else int(value)
        offset = len(self.before)
        self.before += value.tobytes()
        return {"code": CODES[value.dtype], "shape": list(value.shape), "offset": offset}

    def write(self, folder: Path) -> None:
        """Write both files."""
        (folder / "calls.json").write_text(json.dumps(self.calls), encoding="utf-8")
        (folder / "before.bin").write_bytes(self.before)


def arrays(value: Any) -> Iterator[npt.NDArray[Any]]:
    """All arrays in an argument."""
    if isinstance(value, tuple):
        for part in value:
            yield from arrays(part)
    elif isinstance(value, np.ndarray):
        yield value


def spans(value: Any) -> Iterator[tuple[str, int, int]]:
    """Of all arrays in an argument as JSON: code, offset, and how many numbers."""
    if isinstance(value, dict) and "fields" in value:
        for part in value["fields"].values():
            yield from spans(part)
    elif isinstance(value, dict):
        yield value["code"], value["offset"], math.prod(value["shape"])


def apart(one: npt.NDArray[Any], other: npt.NDArray[Any]) -> float:
    """The greatest difference of two arrays, in sizes of what stands there or 1; infinite in kind."""
    if one.dtype.kind != "f":
        return 0.0 if (one == other).all() else math.inf
    with np.errstate(all="ignore"):
        differ = ~((one == other) | (np.isnan(one) & np.isnan(other)))
        if not differ.any():
            return 0.0
        a, b = one[differ], other[differ]
        far = np.abs(a - b) / np.maximum(1.0, np.abs(a))
    return float(np.where(np.isfinite(far), far, math.inf).max())


@dataclass
class Difference:
    """How far two replays of an entry came apart: numbers compared, those that differ, and by how much.

    `worst` is as a share of the number's size or 1; infinite where whole numbers differ.
    """

    calls: int = 0
    numbers: int = 0
    differ: int = 0
    worst: float = 0.0

    def add(self, one: npt.NDArray[Any], other: npt.NDArray[Any]) -> None:
        """Count what stands in two arrays."""
        self.numbers += one.size
        self.differ += int(np.count_nonzero(one.view(np.int64) != other.view(np.int64)))
        self.worst = max(self.worst, apart(one, other))


def compared(calls: list[dict[str, Any]], one: bytes, other: bytes) -> dict[str, Difference]:
    """How far two replays of calls came apart, by entry."""
    shapes = {shape.symbol: shape for shape in map(signature, entries.ENTRIES.values())}
    found: dict[str, Difference] = {}
    for call in calls:
        entry, results = call["entry"], call["results"]
        difference = found.setdefault(entry, Difference())
        difference.calls += 1
        names = [parameter.name for parameter in shapes[entry].parameters]
        answers = ANSWERS.get(entry, dict.fromkeys(names, slice(None)))
        for name, value in zip(names, call["values"], strict=True):
            for code, offset, size in spans(value) if name in answers else ():
                dtype = DTYPES[code]
                both = (np.frombuffer(memory, dtype, size, offset) for memory in (one, other))
                difference.add(*(numbers[answers[name]] for numbers in both))
        count = len(shapes[entry].results)
        numbers = [np.frombuffer(memory, np.float64, count, results) for memory in (one, other)]
        for n in RESULTS.get(entry, range(count)):
            code = shapes[entry].results[n]
            difference.add(*(part[n : n + 1].astype(DTYPES[code]) for part in numbers))
    return found


def all_replayed() -> set[str]:
    """The symbols of all entries whose calls can be done again one by one."""
    return {
        signature(entry).symbol for name, entry in entries.ENTRIES.items() if not name.startswith(WHOLE)
    }


def run(*arguments: str, **environment: str) -> None:
    """Run this module as a script."""
    command = [sys.executable, "-m", "tests.engine.recording", *arguments]
    environment = {**os.environ, **environment}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, done.stderr


def recorded(folder: Path) -> Path:
    """The folder, with calls of every entry in it, and as after.bin what plain Python made of them."""
    run("record", str(folder))
    run("again", str(folder), **{VARIABLE: PLAIN})
    return folder


def again(folder: Path, bound: Callable[[Any], Any]) -> bytes:
    """The memory after the calls of a folder were done again by functions that `bound` makes."""
    memory = bytearray((folder / "before.bin").read_bytes())
    functions = {signature(function).symbol: function for function in entries.ENTRIES.values()}
    calls = {symbol: bound(function) for symbol, function in functions.items()}
    for call in json.loads((folder / "calls.json").read_text(encoding="utf-8")):
        symbol, results = call["entry"], call["results"]
        parameters = signature(functions[symbol]).parameters
        given = [value_of(*each, memory) for each in zip(parameters, call["values"], strict=True)]
        found = calls[symbol](*given)
        numbers = np.array(found if isinstance(found, tuple) else [found or 0.0], dtype=np.float64)
        memory[results : results + numbers.nbytes] = numbers.tobytes()
    return bytes(memory)


def value_of(parameter: Parameter, value: Any, memory: bytearray) -> Any:
    """An argument that stands as JSON; arrays lie in `memory`."""
    if parameter.group is not None:
        fields = zip(parameter.fields, value["fields"].values(), strict=True)
        return parameter.group(*(value_of(field, each, memory) for field, each in fields))
    if isinstance(value, dict):
        shape = value["shape"]
        dtype, size = DTYPES[value["code"]], math.prod(shape)
        return np.frombuffer(memory, dtype, size, value["offset"]).reshape(shape)
    return value if isinstance(value, int) else float(value)


def node() -> str | None:
    """Where Node is on this machine, if it is."""
    return shutil.which("node")


def replayed(folder: Path, module: Path = MODULE, rounds: int = 1) -> tuple[bytes, dict[str, float]]:
    """The memory after Node did the calls of a folder, and the least seconds they took by entry."""
    program = node()
    assert program is not None
    command = [
        program,
        str(HERE / "replay_node.mjs"),
        str(LOADER),
        str(module),
        str(folder),
        str(rounds),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return (folder / "replayed.bin").read_bytes(), json.loads(done.stdout)


def record(folder: Path) -> None:
    """Record calls of every entry."""
    recording, kept = Recording(), Counter[str]()

    def kept_too(name: str, served: Any) -> Callable[..., Any]:
        symbol = signature(entries.ENTRIES[name]).symbol
        if symbol not in all_replayed():
            return cast("Callable[..., Any]", served)

        def call(*values: Any) -> Any:
            size = sum(array.nbytes for value in values for array in arrays(value))
            if kept[symbol] >= CALLS or size > BYTES:
                return served(*values)
            kept[symbol] += 1
            return recording.call(symbol, served, *values)

        return call

    wrap(kept_too)
    questions()
    recording.write(folder)


if __name__ == "__main__":
    task, where = sys.argv[1], Path(sys.argv[2])
    if task == "record":
        record(where)
    else:
        (where / "after.bin").write_bytes(again(where, lambda function: function))
