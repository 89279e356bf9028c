"""Why the kernels' library is built for x86-64-v3, and not for the processor of the machine at hand.

The library is named by what it was built for, and one for another processor is never loaded. Built
for the very processor it would serve on that kind alone. Level v3 (AVX2 and fused multiply-add) is in
nearly all machines since 2015, so that a wheel, a container or a home folder may move between them;
and all of them then give the same bits. This page builds the march, the loop that gains most from wide
vectors, for levels and for this processor, and compares times and bits with those of v3: level v4, with
wider vectors, gains nothing, and code for the processor itself up to a fifth. Without fused
multiply-add the march takes about twice as long, and roundings differ.

What engine.wasm takes, which serves where no library was built, see engine_wasm.py.

Whether a machine has v3 is read from /proc/cpuinfo. Where there is none (not Linux), the plain level is
taken: slower, and never wrong.
"""

import ctypes
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchdragon.engine.__main__ import PLAIN_CODE

MARCH = "benchdragon.kernels.chain.march"
RUNS = 60


def build(folder: str) -> None:
    """Write a library of the march for each processor; in a process of its own, see PLAIN_CODE."""
    import llvmlite.binding as llvm

    from benchdragon.engine import optimise, shims
    from benchdragon.engine.build import link, machine_code

    optimise.prepare()
    march = shims.compiled_entries()[MARCH]
    host = llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()
    levels = ((name, "") for name in ("x86-64", "x86-64-v3", "x86-64-v4"))
    for cpu, features in (*levels, host):
        machine = llvm.Target.from_default_triple().create_target_machine(
            cpu=cpu, features=features, opt=3, reloc="pic", codemodel="default"
        )
        link(machine_code([march], machine), Path(folder, f"{cpu}.so"))


def task() -> tuple[tuple[Any, ...], Any]:
    """The contest's standard table: arguments of the march, and what it fills."""
    from benchdragon.kernels.chain import empty_placements
    from benchdragon.model.curves import Route, Spiral
    from benchdragon.model.dragon import Dragon
    from benchdragon.model.walk import Walk

    walk = Walk(Dragon.uniform(), Route((Spiral(0.55, 32.0 * math.pi, 0.0),)))
    s = np.ascontiguousarray(walk.head_position(np.arange(301.0)))
    out = empty_placements(len(walk.dragon.links) + 1, len(s))
    return (walk.route.rows, walk.dragon.links, s, 0, len(s)), out


def seconds(job: Callable[[], object]) -> float:
    """CPU time of one run, s."""
    start = time.process_time()
    job()
    return time.process_time() - start


def show(folder: str) -> None:
    """Time and bits of each library, against those of v3."""
    from benchdragon.hosts import native
    from benchdragon.kernels import entries

    arguments, out = task()
    wanted = type(out)(*(table.copy() for table in out))
    march = native.bound(entries.ENTRIES[MARCH], ctypes.CDLL(str(Path(folder, "x86-64-v3.so"))))
    print("march of 224 handles x 301 times   time / v3's      numbers that differ   by at most, m")
    for path in sorted(Path(folder).glob("*.so"), key=lambda path: path.stat().st_mtime):
        call = native.bound(entries.ENTRIES[MARCH], ctypes.CDLL(str(path)))
        job, rival = partial(call, *arguments, out), partial(march, *[*arguments, wanted])
        ratios = [seconds(job) / seconds(rival) for _run in range(RUNS)]
        apart = np.abs(np.array(out[2:4]) - np.array(wanted[2:4]))
        count, ratio = np.count_nonzero(apart), statistics.median(ratios)
        print(f"{path.stem:34s} {ratio:14.2f} {count:21d} {apart.max():20.1e}")


if __name__ == "__main__":
    if sys.argv[1:]:
        build(sys.argv[1])
    else:
        with tempfile.TemporaryDirectory() as made:
            environment = {**os.environ, **PLAIN_CODE}
            subprocess.run([sys.executable, __file__, made], check=True, env=environment)
            show(made)
