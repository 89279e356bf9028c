"""Whose pool of processes runs many questions: the standard library's with a way to end it, or loky's.

`parallel.py` divides questions into blocks by what they cost, finds the one that kills its worker, and
runs on any executor, of loky or Dask as well: only where none is given does it start a pool of its own,
of `ProcessPoolExecutor` and some 80 lines (`_Recording` to the end). This page runs both pools:

1. Seconds, by the clock and of CPU, until two workers have answered.
2. What the other questions under way come to when one kills its worker: with both pools they are lost,
   so that somebody has to find the one to blame either way.
3. Ctrl-C, as a terminal sends it, to the whole group: seconds until all processes are gone, and how
   many lines of tracebacks they leave.
4. The parent is killed outright: how many workers are left after PATIENCE seconds.

loky 3.7.0 starts as fast, and ends as soon at Ctrl-C. Where one question kills its worker, both lose
all that are under way. Where the parent is killed, as by a system short of memory, loky's workers go
on computing for nobody, with two processes of its own beside them; those of `parallel.py` watch their
parent and are gone in a fifth of a second. So loky would be one more dependency, and the dozen lines
that hold to the parent would stay.
"""

import importlib.util
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import AbstractContextManager, contextmanager

from benchdragon.parallel import processes

WORKERS, PATIENCE = 2, 5.0
NAMES = ("parallel.py", "loky")


@contextmanager
def by_loky() -> Iterator[Executor]:
    """loky's pool."""
    from loky import get_reusable_executor

    with get_reusable_executor(WORKERS) as executor:
        yield executor


def opened(name: str) -> AbstractContextManager[Executor]:
    """A pool of that name."""
    return by_loky() if name == "loky" else processes(WORKERS).opened()


def beside(item: float) -> int:
    """Take so many seconds; none: kill the worker."""
    if item == 0.0:
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(item)
    return os.getpid()


def start(name: str) -> str:
    """How long two workers take to answer, and CPU seconds of all processes."""
    began, before = time.perf_counter(), os.times()
    with opened(name) as executor:
        answers = set(executor.map(beside, [0.2] * (2 * WORKERS)))
        took = time.perf_counter() - began
    used = sum(b - a for a, b in zip(before[:4], os.times()[:4], strict=True))
    return f"{len(answers)} workers answered after {took:.2f} s, {used:.2f} s of CPU"


def loss(name: str) -> str:
    """What questions under way come to when one kills its worker."""
    with opened(name) as executor:
        list(executor.map(beside, [0.1] * WORKERS))
        futures = [executor.submit(beside, item) for item in (2.0, 0.0, 2.0)]
        told = [type(future.exception()).__name__ for future in futures]
    return f"of three questions, of which the second kills its worker: {', '.join(told)}"


def group(process: subprocess.Popen[str]) -> int:
    """How many processes of a group are alive."""
    found = subprocess.run(
        ["ps", "-o", "pid=,stat=", "-g", str(process.pid)], capture_output=True, text=True, check=False
    )
    return sum("Z" not in line for line in found.stdout.splitlines())


def ended(name: str, number: signal.Signals) -> str:
    """What a pool at work leaves behind: its parent is killed, or Ctrl-C goes to the whole group."""
    process = subprocess.Popen(
        [sys.executable, __file__, name], start_new_session=True, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    process.stdout.readline()
    if number == signal.SIGINT:
        os.killpg(process.pid, number)
    else:
        process.send_signal(number)
    began = time.perf_counter()
    while group(process) and time.perf_counter() < began + PATIENCE:
        time.sleep(0.05)
    took, left = time.perf_counter() - began, group(process)
    if left:
        os.killpg(process.pid, signal.SIGKILL)
    lines = len(process.communicate()[1].splitlines())
    return f"{number.name}: {left} processes left after {took:.1f} s, {lines} lines on stderr"


def at_work(name: str) -> None:
    """Keep a pool at work until it is ended."""
    with opened(name) as executor:
        futures = [executor.submit(beside, 0.1) for _worker in range(WORKERS)]
        for future in futures:
            future.result()
        futures = [executor.submit(beside, 60.0) for _worker in range(2 * WORKERS)]
        print("at work", flush=True)
        for future in futures:
            future.result()


def main() -> None:
    """Print what each pool does."""
    for name in NAMES:
        if name == "loky" and importlib.util.find_spec("loky") is None:
            print("loky: not here")
            continue
        print(f"{name}: {start(name)}", flush=True)
        print(f"{name}: {loss(name)}", flush=True)
        for number in (signal.SIGINT, signal.SIGKILL):
            print(f"{name}: {ended(name, number)}", flush=True)


if __name__ == "__main__":
    if sys.argv[1:]:
        at_work(sys.argv[1])
    else:
        main()
