"""What the kernels take in a browser, and why engine.wasm has vectors (simd128).

The module is numba's code for the target wasm32, optimised by the same LLVM as the library; Zig links
it, with its libraries of C. This page builds it with vectors and without, from the entries that take
most of the time of a table of places and of a random dance, and has Node do the very calls that the
library was seen to do. Vectors make the march faster by nearly half and the search of all pairs no
slower, for less than a tenth more size. The library takes less than half of the time of the march, and
about a quarter of that of all pairs: its vectors have four numbers, and it multiplies and adds in one
step, which Zig's hypot has to do by hand here. What whole questions take beside it is in
benchmarks/RESULTS.md.

WebAssembly rounds each product, and its libm is another: answers differ in the last bits, so searches
may take another way to the same bracket. `python -m tests.laws.wasm_dances 10000` counts how often.

Run it from the project's folder, with BENCHDRAGON_ENGINE=native, as `python -m design.engine_wasm`.
"""

import copy
import gzip
import math
import os
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from benchdragon.engine.__main__ import PLAIN_CODE

ENTRIES = ("chain.march", "every_pair.search_all_pairs")
FEATURES = {"vectors": "+simd128", "none": ""}
ROUNDS = 40


def build(folder: str) -> None:
    """Write both modules; in a process of its own, see PLAIN_CODE."""
    from benchdragon.engine import optimise, shims, wasm

    optimise.prepare()
    known = shims.compiled_entries()
    entries = [known[f"benchdragon.kernels.{name}"] for name in ENTRIES]
    for name, features in FEATURES.items():
        module = wasm.module(entries, wasm.target_machine(features))
        Path(folder, f"{name}.wasm").write_bytes(module)


def questions() -> None:
    """The contest's standard table, and all pairs of a random dance."""
    from tests.engine.questions import every_pair
    from tests.solve.dances import laid

    from benchdragon.model.curves import Route, Spiral
    from benchdragon.model.dragon import Dragon
    from benchdragon.model.walk import Walk
    from benchdragon.plans.schema import read_plan
    from benchdragon.solve.tolerance import CASES, Draw

    walk = Walk(Dragon.uniform(), Route((Spiral(0.55, 32.0 * math.pi, 0.0),)))
    walk.motion(np.arange(301.0))
    coiled = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=20", "walk.start=225"])
    every_pair(laid(coiled, Draw(CASES["all"].deviations, 7, 1)))


class Watch:
    """Records calls of the entries, and the CPU time that the library takes for them, s."""

    def __init__(self) -> None:
        from tests.engine.recording import Recording

        self.recording = Recording()
        self.rounds = [defaultdict[str, float](float) for _round in range(ROUNDS)]

    def wrapper(self, name: str, served: Any) -> Callable[..., Any]:
        """What is called in place of an entry."""
        from benchdragon.hosts.signature import signature
        from benchdragon.kernels import entries

        if name.removeprefix("benchdragon.kernels.") not in ENTRIES:
            return served  # type: ignore[no-any-return]
        symbol = signature(entries.ENTRIES[name]).symbol

        def call(*values: Any) -> Any:
            for seconds in self.rounds:
                seconds[symbol] += seconds_of(served, values)
            return self.recording.call(symbol, served, *values)

        return call


def seconds_of(served: Any, values: tuple[Any, ...]) -> float:
    """CPU time of a call on copies, s: the second one, for which all has been passed before."""
    from tests.engine.recording import arrays

    again = copy.deepcopy(values)
    served(*again)
    for used, given in zip(arrays(again), arrays(values), strict=True):
        used[...] = given
    start = time.process_time()
    served(*again)
    return time.process_time() - start


def show(folder: Path) -> None:
    """Sizes, times and bits."""
    from tests.engine.questions import wrap
    from tests.engine.recording import MODULE, again, compared, replayed

    from benchdragon.hosts.serving import serving

    whole = MODULE.read_bytes()
    print(
        f"engine.wasm: {len(whole) / 1e3:.0f} kB, {len(gzip.compress(whole)) / 1e3:.0f} kB compressed"
    )
    watch = Watch()
    wrap(watch.wrapper)
    questions()
    watch.recording.write(folder)
    native = {symbol: min(each[symbol] for each in watch.rounds) for symbol in watch.rounds[0]}
    print("vectors     kB   entry                            calls   time / library's   other bits, by")
    for name in FEATURES:
        module = folder / f"{name}.wasm"
        memory, seconds = replayed(folder, module, ROUNDS)
        found = compared(watch.recording.calls, again(folder, serving().bound), memory)
        for symbol, each in found.items():
            size, share = module.stat().st_size / 1e3, each.differ / each.numbers
            row = f"{name:8s} {size:5.0f}   {symbol:32s} {each.calls:5d}"
            print(f"{row} {seconds[symbol] / native[symbol]:18.2f} {share:12.1%}, {each.worst:.0e}")


if __name__ == "__main__":
    if sys.argv[1:]:
        build(sys.argv[1])
    else:
        with tempfile.TemporaryDirectory() as made:
            environment = {**os.environ, **PLAIN_CODE}
            subprocess.run([sys.executable, "-m", __spec__.name, made], check=True, env=environment)
            show(Path(made))
