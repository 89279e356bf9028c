"""`python -m benchdragon.engine [FOLDER]`: build the library, in this folder if nothing is said.

With `--wasm` it builds engine.wasm, for browsers.
"""

import argparse
import gc
import os
import sys
import time
from pathlib import Path

# Read by numba when it is imported: code for any processor, which is optimised once it is one module.
PLAIN_CODE = {"NUMBA_OPT": "0", "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
# New objects after which Python looks for garbage: numba makes millions, which stay.
RARELY = (50_000, 50, 1_000)


def main(arguments: list[str]) -> int:
    """Build, and report the result; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchdragon.engine", description=__doc__)
    parser.add_argument("--wasm", action="store_true", help="build engine.wasm, for browsers")
    parser.add_argument("folder", type=Path, nargs="?", help="where to put it")
    wanted = parser.parse_args(arguments)
    os.environ.update(PLAIN_CODE)
    gc.set_threshold(*RARELY)
    from benchdragon.hosts import built
    from benchdragon.own_folder import made_own

    own = os.access(built.ENGINE, os.W_OK)
    folder = wanted.folder or (built.ENGINE if own else made_own(built.user_folder()))
    if folder is None:
        print(f"{built.user_folder()} is not this user's alone: name a FOLDER", file=sys.stderr)
        return 1
    from benchdragon.engine.build import build
    from benchdragon.engine.optimise import BuildError
    from benchdragon.engine.wasm import build_module

    start = time.perf_counter()
    try:
        path = build_module(folder) if wanted.wasm else build(folder)
    except BuildError as error:
        print(f"The kernels were not built: {error}", file=sys.stderr)
        return 1
    seconds, size = time.perf_counter() - start, path.stat().st_size
    print(f"{path}: {size / 1e3:.0f} kB, built in {seconds:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
