"""Why groups of arrays pass through kernels as pointers to their slots, and not as numba passes them.

numba passes a NamedTuple by value: all that it knows of each array becomes arguments of each function,
seven numbers for a list and nine for a table, and is put together anew inside. A pointer is one
argument, and what is not read costs nothing. This page builds twelve functions, each of which reads
one array of a group and calls the next, either way: by value code grows with what is passed, by
pointer it does not, and the machine code is the same.

The whole module took 90 s of processor time, 0.6 GB and 350 kB by value, and 65 s, 0.36 GB and 244 kB
by pointer and with one piece of code for each kernel, whatever whole numbers its calls name
(engine/pieces.py).
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchdragon.engine.__main__ import PLAIN_CODE

DEPTH, SIZES = 12, (4, 12, 36)
WAYS = {"by value": "value", "by pointer": "pointer"}
HEAD = """
from typing import NamedTuple
from benchdragon.kernels.arrays import Table
from benchdragon.kernels.entries import kernel

class Group(NamedTuple):
"""
STEP = """
@kernel
def step_{n}(group: Group, i: int) -> float:
    return {rest} + group.a{first}[i, {n}]
"""


def source(arrays: int) -> str:
    """A module of so many arrays in a group, and of functions that pass it down."""
    text = HEAD + "".join(f"    a{n}: Table\n" for n in range(arrays))
    for n in range(DEPTH):
        rest = f"step_{n - 1}(group, i)" if n else "0.0"
        text += STEP.format(n=n, rest=rest, first=n % arrays)
    return text


def measure(way: str, folder: str) -> None:
    """Build the module of that folder, and print what that took; in a process of its own."""
    from benchdragon.engine import blocks, build, optimise, pieces, shims
    from benchdragon.hosts import built
    from benchdragon.kernels import entries

    pieces.keep_pieces()
    entries.compiler = shims.compiled
    if way == "value":
        for module in (blocks, shims):
            vars(module)["block_of"] = lambda _group: None
    sys.path.insert(0, folder)
    function = getattr(__import__("passed"), f"step_{DEPTH - 1}")
    optimise.prepare()
    machine = optimise.target_machine(built.processor())
    start = time.process_time()
    _shape, piece, _name = shims.compiled_shim(function)
    numba, text = time.process_time() - start, sum(map(len, pieces.texts([piece])))
    code = build.machine_code([function], machine)
    whole = time.process_time() - start
    print(f"{numba:10.2f} {whole - numba:16.2f} {text / 1e6:10.2f} {len(code) / 1e3:9.0f}")


if __name__ == "__main__":
    if sys.argv[1:]:
        measure(*sys.argv[1:])
    else:
        print("tables in the group   passed      numba, s   LLVM and shim, s   text, MB   code, kB")
        for arrays in SIZES:
            for name, way in WAYS.items():
                with tempfile.TemporaryDirectory() as made:
                    Path(made, "passed.py").write_text(source(arrays), encoding="utf-8")
                    done = subprocess.run(
                        [sys.executable, __file__, way, made],
                        check=True, capture_output=True, text=True, env={**os.environ, **PLAIN_CODE},
                    )  # fmt: skip
                print(f"{arrays:19d}   {name:10s}{done.stdout.rstrip()}", flush=True)
