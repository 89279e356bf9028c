"""Where a process spends its start, and from how many places on compiled kernels pay.

Importing numba and loading cached kernels costs more than a few hundred handles do in plain Python, and
the first compile on a machine takes a minute. The kernels are plain Python, so where their library was
not built (design/engine.py) the command line leaves them so for small jobs: cli.FEW_PLACES, with a good
distance to the break-even printed here.
"""

import os
import subprocess
import sys
import time

from benchdragon.cli.main import FEW_PLACES


def seconds(*arguments: str, **environment: str) -> float:
    """Least of five whole runs of Python with these arguments, s."""
    best = float("inf")
    for _run in range(5):
        start = time.perf_counter()
        subprocess.run(
            [sys.executable, *arguments],
            check=True,
            capture_output=True,
            env={**os.environ, **environment},
        )
        best = min(best, time.perf_counter() - start)
    return best


def show_imports() -> None:
    """Start of a process that imports one thing."""
    bare = seconds("-c", "pass")
    print(f"bare interpreter: {bare * 1e3:.0f} ms; more for importing")
    for name in ("click", "numpy", "numba", "pydantic", "scipy.integrate", "matplotlib.figure"):
        print(f"  {name}: {(seconds('-c', f'import {name}') - bare) * 1e3:.0f} ms")


def show_break_even() -> None:
    """Whole runs of `motion` plain and compiled (cached), for more and more places."""
    print("handles x times    plain, s    compiled, s")
    even = 0.0
    for times in (1, 10, 50, 100, 200, 400):
        run = ("-m", "benchdragon", "motion", "turn", f"--at=-3:{times - 4}:1", "--json", "--quiet")
        plain = seconds(*run, BENCHDRAGON_ENGINE="plain")
        compiled = seconds(*run, BENCHDRAGON_ENGINE="jit")
        print(f"{224 * times:15d}    {plain:8.2f}    {compiled:8.2f}")
        if plain < compiled:
            even = 224.0 * times
    print(f"plain is faster up to about {even:.0f} places; the command line uses it up to {FEW_PLACES}")


if __name__ == "__main__":
    show_imports()
    show_break_even()
