"""How things are timed here, and how rows of tables are written."""

import json
import math
import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

Job = Callable[[], object]
# A job is timed at least so often and at most so often, and in between as long as this lasts, s.
LEAST, MOST, LASTING, QUICK_LASTING = 3, 60, 3.0, 0.2
# Runs a process as the only child of a small one: what the system counts of it is not its parent's.
WATCH = """
import json, os, sys, time
unread = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)]
began = time.perf_counter()
child = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ, file_actions=unread)
_child, status, used = os.wait4(child, 0)
wall = time.perf_counter() - began
print(json.dumps({
    "code": os.waitstatus_to_exitcode(status), "wall": wall,
    "cpu": used.ru_utime + used.ru_stime, "peak": used.ru_maxrss / 1024,
}))
"""


@dataclass(frozen=True)
class Options:
    """What was asked for.

    Attributes:
        quick: smaller sizes and fewer repeats.
        before: the checkout of an older version that is timed beside this one.
    """

    quick: bool = False
    before: str | None = None


@dataclass(frozen=True)
class Spent:
    """What a whole process took: s by the clock, s of processor time, MB of memory at its peak."""

    wall: float
    cpu: float
    peak: float


def fastest(jobs: Sequence[Job], repeats: int) -> list[float]:
    """The least time of each job, s, the jobs taking turns."""
    best = [math.inf] * len(jobs)
    for _repeat in range(repeats):
        for i, job in enumerate(jobs):
            start = time.perf_counter()
            job()
            best[i] = min(best[i], time.perf_counter() - start)
    return best


def repeats_of(seconds: float, options: Options) -> int:
    """How often something that takes so long is timed."""
    if options.quick:
        return min(LEAST, math.ceil(QUICK_LASTING / seconds))
    return max(LEAST, min(MOST, math.ceil(LASTING / seconds)))


def lines_of(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """The lines of a table in Markdown."""
    body = [columns, ["---"] * len(columns), *rows]
    return [f"| {' | '.join(row)} |" for row in body]


def digits(value: float | None) -> str:
    """A figure with three digits that count; nothing for None."""
    if value is None:
        return ""
    return f"{value:.0f}" if abs(value) >= 1000.0 else f"{value:.3g}"


def in_process(script: str, **environment: str) -> list[str]:
    """What a fresh Python prints for `script`, word by word."""
    done = subprocess.run(
        [sys.executable, "-c", script],
        stdout=subprocess.PIPE, text=True, check=True, env={**os.environ, **environment},
    )  # fmt: skip
    return done.stdout.split()


def spent(arguments: Sequence[str], code: int, environment: Mapping[str, str]) -> Spent:
    """What a fresh Python with these arguments takes, as a whole process.

    Raises:
        RuntimeError: if it does not end with `code`.
    """
    command = [sys.executable, "-S", "-c", WATCH, sys.executable, *arguments]
    done = subprocess.run(
        command, stdout=subprocess.PIPE, text=True, check=True, env={**os.environ, **environment}
    )
    found = json.loads(done.stdout)
    if found["code"] != code:
        raise RuntimeError(f"{' '.join(arguments)} ended with {found['code']}, not {code}")
    return Spent(found["wall"], found["cpu"], found["peak"])


def least(runs: Sequence[Spent]) -> Spent:
    """The least of each."""
    return Spent(min(r.wall for r in runs), min(r.cpu for r in runs), min(r.peak for r in runs))
