"""Where a process spends its start, and why plain Python serves nothing unless it is asked to.

engine.wasm is compiled once on a machine, which takes half a second, and is loaded in milliseconds from
then on; with NumPy imported, Wasmtime is a twentieth of a second more. Kernels as plain Python are as
quick only for some thousands of places, and gain that twentieth at most: a question evaluates millions,
so that no way of its own for small ones is worth its code. The first answers, with empty caches, stand
beside later ones.
"""

import os
import subprocess
import sys
import tempfile
import time


def seconds(*arguments: str, **environment: str) -> float:
    """Least of five whole runs of Python with these arguments, s."""
    return min(once(*arguments, **environment) for _run in range(5))


def once(*arguments: str, **environment: str) -> float:
    """A whole run, s; a check may say no, by code 1."""
    start = time.perf_counter()
    command, told = [sys.executable, *arguments], {**os.environ, **environment}
    ended = subprocess.run(command, check=False, capture_output=True, env=told, text=True)
    if ended.returncode not in (0, 1):
        raise RuntimeError(f"{command} ended with {ended.returncode}: {ended.stderr}")
    return time.perf_counter() - start


def show_imports() -> None:
    """Start of a process that imports one thing."""
    bare = seconds("-c", "pass")
    print(f"bare interpreter: {bare * 1e3:.0f} ms; more for importing")
    for name in ("click", "numpy", "wasmtime", "pydantic", "scipy.integrate", "matplotlib.figure"):
        print(f"  {name}: {(seconds('-c', f'import {name}') - bare) * 1e3:.0f} ms")


def show_first() -> None:
    """Whole runs with empty caches and with full ones."""
    print("benchdragon check spiral-in        first, s    later, s")
    run = ("-m", "benchdragon", "check", "spiral-in", "--quiet")
    for engine in ("wasm", "native"):
        with tempfile.TemporaryDirectory() as home:
            told = {"BENCHDRAGON_ENGINE": engine, "XDG_CACHE_HOME": home}
            print(f"{engine:30s} {once(*run, **told):12.2f} {seconds(*run, **told):11.2f}")


def show_plain() -> None:
    """Whole runs of `motion` as plain Python and by engine.wasm, for more and more places."""
    print("handles x times    plain, s    engine.wasm, s")
    for times in (1, 10, 50, 100):
        run = ("-m", "benchdragon", "motion", "turn", f"--at=-3..{times - 4}..1", "--json", "--quiet")
        plain, wasm = (seconds(*run, BENCHDRAGON_ENGINE=engine) for engine in ("plain", "wasm"))
        print(f"{224 * times:15d}    {plain:8.2f}    {wasm:8.2f}")


if __name__ == "__main__":
    show_imports()
    show_first()
    show_plain()
