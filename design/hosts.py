"""How engine.wasm is run where no library was built: by Wasmtime, compiled once, arrays where they lie.

Wasmtime has wheels for Linux, Windows and macOS (30 MB) and compiles the module in less than half a
second of processor time whatever it is told about optimising, so that the level with the fastest code
is taken, on one thread: with all cores there is a tenth of a second to gain, once. What it compiled is
kept and loaded in a millisecond. No other way to run it was found that needs no compiler, no service:
Node is not where Python is.

A search works on many arrays. If each were copied into the module's memory and back at each call, a
first contact would move 27 MB both ways, most of it room that is never used. So what searches work on
is the engine's own (kernels/search_room.py); the little that is passed is copied, or made in the
module's memory (`hosts.serving.placed`): whoever passes an array need not know who serves.
"""

import os
import subprocess
import sys
import time

import wasmtime

from benchdragon.hosts import built, compiled

# First contacts by one engine, in a process of its own.
CONTACT = """
import time
import benchdragon as bd
plan = bd.read_plan("spiral-in")
best = 1e9
for _round in range(12):
    start = time.process_time()
    walk = plan.build()
    answer = bd.first_contact(walk, *plan.span(walk))
    best = min(best, time.process_time() - start)
print(best, answer.value)
"""


def show_compiling() -> None:
    """What compiling takes, and the size of what comes out."""
    code = (built.ENGINE / built.MODULE).read_bytes()
    print("optimised for    threads    s by the clock    of processor    kB")
    for level in ("none", "speed", "speed_and_size"):
        for several in (False, True):
            config = compiled.settings(wasmtime.Config())
            config.cranelift_opt_level, config.parallel_compilation = level, several
            engine = wasmtime.Engine(config)
            wall, cpu = time.perf_counter(), time.process_time()
            made = wasmtime.Module(engine, code)
            wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
            size = len(made.serialize()) / 1e3
            print(f"{level:16s} {'all' if several else 'one':7s} {wall:17.2f} {cpu:15.2f} {size:5.0f}")


def show_contacts() -> None:
    """First contacts by the module and by the library."""
    print("first contact of spiral-in   ms of processor    answer, s")
    for engine in ("wasm", "native"):
        command = [sys.executable, "-c", CONTACT]
        told = {**os.environ, "BENCHDRAGON_ENGINE": engine}
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True, env=told)
        seconds, answer = done.stdout.split()
        print(f"{engine:25s} {1e3 * float(seconds):18.1f}    {answer}")


if __name__ == "__main__":
    show_compiling()
    show_contacts()
