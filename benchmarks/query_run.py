"""This package and its rivals asked the same queries: times, and answers beside the truth."""

import bisect
import collections
import itertools
import json
import math
import operator
import os
import statistics
import subprocess
import sys
import tempfile
import time
from argparse import Namespace
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from query_draw import LENGTHS, Asking, boxes
from query_set import Dance, Query, by_dance, dance_of, read_dances, read_queries
from timing import digits, lines_of

from benchdragon.kernels.pair_queries import PairAnswer
from benchdragon.kernels.time_of_impact import Ending, Goal

HERE = Path(__file__).parent
# How much later or earlier a contact may be told, m.
ALLOWED = 1e-6
# Steps between sampled poses of rivals, m.
STEPS = (0.05, 0.01)
# Chains of ours are also told apart by how many handles they have, at most.
HANDLES = (10, 30, 100, 302)

# What is asked of a query.
VALUES = tuple(
    operator.attrgetter(*names) for names in (("first",), ("second",), ("width",), ("start", "end"))
)

# Of each query the seconds of processor time taken, and where contact was told, m, if it was.
Told = list[tuple[float, float | None]]


@dataclass(frozen=True)
class Rival:
    """One that is asked about sampled poses, by a worker in a process of its own.

    Attributes:
        name: what it is called in the table.
        command: of the worker, which query_rival.py describes.
        check: a command that fails where it is not installed.
        install: how it is installed.
        folder: in which both run.
        step: between poses, m.
    """

    name: str
    command: tuple[str, ...]
    check: tuple[str, ...]
    install: str
    folder: Path
    step: float

    def missing(self) -> bool:
        """Whether it is not installed."""
        try:
            done = subprocess.run(self.check, cwd=self.folder, capture_output=True, check=False)
        except FileNotFoundError:
            return True
        return done.returncode != 0


def rivals(options: Namespace) -> Iterator[Rival]:
    """All of them, at either step."""
    python, node = str(Path(options.python).absolute()), Path(options.node_folder).absolute()
    worker, script = str(HERE / "query_rival.py"), str(HERE / "query_planck.mjs")
    told = {"fcl": "FCL (python-fcl), conservative advancement",
            "coal": "Coal, conservative advancement by its distance"}  # fmt: skip
    packages = {"fcl": "python-fcl", "coal": "coal"}
    has = ("node", "-e", "require('planck')")
    for step in STEPS:
        for name, text in told.items():
            install = f"pip install {packages[name]} numpy, and run with --python naming its Python"
            check = (python, "-c", f"import numpy, {name}")
            yield Rival(text, (python, worker, name), check, install, HERE, step)
        install = "npm install planck, and run with --node-folder naming the folder of node_modules"
        for slop in ("", "1e-6"):
            name = f"planck, time of impact, linearSlop {slop or '5e-3 (its own)'} m"
            yield Rival(name, ("node", script, *slop.split()), has, install, node, step)


def poses(dance: Dance, asked: Sequence[Query], step: float) -> np.ndarray:
    """What a worker's file holds of queries about one dance."""
    asking, parts = Asking(dance), []
    for query in asked:
        s = samples(query, step)
        places, t = asking.place(s, query.second + 1), np.arange(len(s))
        seen, half = [], []
        for i in (query.first, query.second):
            box = boxes(dance, places, np.full(len(s), i), t, np.full(len(s), query.width))
            seen += [box[:, 0], box[:, 1], np.unwrap(np.arctan2(box[:, 3], box[:, 2]))]
            half.append(float(box[0, 4]))
        parts += [np.array([len(s), *half, 0.5 * query.width]), np.stack(seen, 1).ravel()]
    return np.concatenate(parts)


def samples(query: Query, step: float) -> np.ndarray:
    """Places of the head at which poses are told, m, at most a step apart."""
    count = math.ceil((query.end - query.start) / step - 1e-6)
    return np.linspace(query.start, query.end, count + 1)


def ask(rival: Rival, dances: Sequence[Dance], queries: Sequence[Query]) -> Told:
    """What a rival says of all queries."""
    told: Told = []
    with tempfile.TemporaryDirectory() as folder, subprocess.Popen(
        rival.command, cwd=rival.folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL, text=True,
    ) as worker:  # fmt: skip
        assert worker.stdin is not None
        assert worker.stdout is not None
        path = Path(folder) / "poses"
        for number, asked in by_dance(queries, dance_of):
            poses(dances[number], asked, rival.step).tofile(path)
            print(path, file=worker.stdin, flush=True)
            for query, (seconds, at) in zip(asked, json.loads(worker.stdout.readline()), strict=True):
                s = samples(query, rival.step)
                told.append((seconds, None if at is None else float(np.interp(at, range(len(s)), s))))
        worker.stdin.close()
    return told


def ours(dances: Sequence[Dance], queries: Sequence[Query]) -> Told:
    """What the engine of this process says: the search is told nothing but the dance."""
    told = dict[int, tuple[float, float | None]]()

    def batch(each: tuple[int, Query]) -> tuple[float, int]:
        return length(each[1]), group_of(each[1])

    for number, group in by_dance(enumerate(queries), lambda each: each[1].dance):
        asking = Asking(dances[number])
        for _key, part in itertools.groupby(sorted(group, key=batch), batch):
            asked = list(part)
            first, second, width, spans = (
                np.array([values(q) for _n, q in asked]) for values in VALUES
            )
            asking.ask(Goal.FIRST_TOUCH, first[:1], second[:1], width[:1], spans[:1])
            began = time.process_time()
            found = asking.ask(Goal.FIRST_TOUCH, first, second, width, spans)
            each = (time.process_time() - began) / len(asked)
            for (n, _query), one in zip(asked, found.tolist(), strict=True):
                told[n] = (
                    each,
                    None if one[PairAnswer.ENDING] == Ending.CLEAR else one[PairAnswer.SOUGHT_LOW],
                )
    return [told[n] for n in range(len(queries))]


def by_engine(engine: str, every: int) -> Told:
    """The same by an engine of its own process."""
    command = [sys.executable, str(HERE / "queries.py"), "ours", "--every", str(every)]
    environment = {**os.environ, "BENCHDRAGON_ENGINE": engine}
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, check=True)
    return [(seconds, s) for seconds, s in json.loads(done.stdout)]


@dataclass(frozen=True)
class Score:
    """Answers beside the truth.

    Attributes:
        missed: contacts of which nothing was told.
        late: told later than ALLOWED.
        early: told earlier than that.
        false: contacts told of benches that keep apart.
        errors: of all contacts told, how far off, m.
    """

    missed: int
    late: int
    early: int
    false: int
    errors: list[float]


def score(queries: Sequence[Query], told: Told) -> Score:
    """How answers compare with the truth; queries whose truth is open count for nothing."""
    found = Score(0, 0, 0, 0, [])
    for query, (_seconds, s) in zip(queries, told, strict=True):
        if query.answer == "apart":
            found = replace(found, false=found.false + (s is not None))
        elif query.answer == "touch" and s is None:
            found = replace(found, missed=found.missed + 1)
        elif query.answer == "touch" and s is not None:
            late, early = s > query.high + ALLOWED, s < query.low - ALLOWED
            found = replace(found, late=found.late + late, early=found.early + early)
            found.errors.append(abs(s - 0.5 * (query.low + query.high)))
    return found


def length(query: Query) -> float:
    """Of a query's span, m."""
    return round(query.end - query.start, 3)


def group_of(query: Query) -> int:
    """The number of the group of HANDLES that a query's chain belongs to."""
    return bisect.bisect_left(HANDLES, query.second + 2)


def means(told: Told, groups: Iterable[object], wanted: Iterable[object]) -> list[str]:
    """The mean time of each group's queries, microseconds."""
    taken = [(group, 1e6 * seconds) for group, (seconds, _s) in zip(groups, told, strict=True)]
    each = ([time for group, time in taken if group == one] for one in wanted)
    return [digits(statistics.fmean(times)) if times else "" for times in each]


def row(name: str, step: str, queries: Sequence[Query], told: Told) -> list[str]:
    """A line of the table."""
    found = score(queries, told)
    return [
        name, step, digits(1e6 * statistics.fmean(seconds for seconds, _s in told)),
        *means(told, map(length, queries), LENGTHS),
        f"{found.missed + found.late:,}", f"{found.missed:,}", f"{found.false:,}", f"{found.early:,}",
        f"{statistics.median(found.errors):.0e}", f"{max(found.errors):.0e}",
    ]  # fmt: skip


COLUMNS = (
    "who", "step, m", "us a query", *(f"of {length:g} m" for length in LENGTHS), "false negatives",
    "of which missed", "false positives", "told early", "median error, m", "greatest, m",
)  # fmt: skip


def taken(every: int) -> tuple[list[Dance], list[Query]]:
    """The dances, and the queries that are proved of every so manieth of them."""
    proved = (query for query in read_queries() if query.answer in ("touch", "apart"))
    return read_dances(), [query for query in proved if query.dance % every == 0]


def table(options: Namespace) -> list[str]:
    """The lines of the table; what is not installed is said beside it."""
    dances, queries = taken(options.every)
    engines = {"native": "this package, native", "wasm": "this package, engine.wasm"}
    rows, depths, left_out = [], [], []
    for engine, name in engines.items():
        told = by_engine(engine, options.every)
        rows.append(row(name, "none", queries, told))
        depths.append([name, *means(told, map(group_of, queries), range(len(HANDLES)))])
        print(f"({name})", file=sys.stderr)
    for rival in rivals(options):
        if rival.missing():
            left_out.append(f"{rival.name} is not installed: {rival.install}.")
            continue
        rows.append(row(rival.name, f"{rival.step:g}", queries, ask(rival, dances, queries)))
        print(f"({rival.name}, {rival.step} m)", file=sys.stderr)
    told_of = collections.Counter(query.answer for query in read_queries())
    touch = sum(query.answer == "touch" for query in queries)
    return [
        f"The set: {told_of['touch']:,} queries touch, {told_of['apart']:,} keep apart, "
        f"{told_of['open']:,} are open, {told_of['']:,} were not tried yet. "
        f"Asked here: {len(queries):,}, of which {touch:,} touch.",
        "", *lines_of(COLUMNS, rows), "",
        *lines_of(("us a query, of chains of up to", *(f"{most} handles" for most in HANDLES)), depths),
        *(["", *dict.fromkeys(left_out)] if left_out else []),
    ]  # fmt: skip
