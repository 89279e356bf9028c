"""What is installed: one wheel for all machines, with engine.wasm, and no library for any of them.

A wheel with a native library for each system and processor was weighed against it. Six were cross-built
on one machine (Linux with both C libraries and both kinds of processor, macOS, Windows), in seven to
eleven seconds of CPU each; but each wants a wheel of its own, and a run on its system before somebody
else trusts it: all but one would be handed out untried. What they gain is on engine_wasm.py: two to
four times the speed of a kernel, in questions most of which take less than a second either way. So none
is carried. Whoever computes for hours builds the library on the machine at hand, by
`python -m benchdragon.engine`.

This page builds the wheel, as `pip install .` does, and weighs what comes with it: what runs the
module, and what would have to be there if kernels were compiled where they are called. What the first
answers take is on cold_start.py, and the module beside the library on engine_wasm.py.
"""

import sys
import tempfile
import time
import zipfile
from importlib import metadata
from pathlib import Path

from hatchling.builders.wheel import WheelBuilder

ROOT = Path(__file__).parents[1]
# What runs engine.wasm; what compiles kernels.
HOSTS = {"engine.wasm by Wasmtime": ("wasmtime",), "numba, at each call": ("numba", "llvmlite")}


def show_wheel() -> None:
    """How long the wheel takes, how large it is, and what of it is large."""
    with tempfile.TemporaryDirectory() as folder:
        start = time.process_time()
        (made,) = WheelBuilder(str(ROOT)).build(directory=folder)
        seconds, path = time.process_time() - start, Path(made)
        print(f"{path.name}: {path.stat().st_size / 1e6:.1f} MB, built in {seconds:.1f} s of CPU")
        with zipfile.ZipFile(path) as opened:
            held = sorted(opened.infolist(), key=lambda file: file.compress_size, reverse=True)
        for file in held[:5]:
            print(f"  {file.filename}: {file.compress_size / 1e3:.0f} kB")
        print(f"  {len(held) - 5} others: {sum(file.compress_size for file in held[5:]) / 1e3:.0f} kB")


def show_hosts() -> None:
    """What each way to run the kernels brings with it, installed."""
    for what, names in HOSTS.items():
        print(f"{what}: {sum(map(installed, names)):.0f} MB")
    for path in sorted((ROOT / "src/benchdragon/engine").glob("kernels-*")):
        print(f"{path.name}, built here: {path.stat().st_size / 1e3:.0f} kB")


def installed(name: str) -> float:
    """How large the files of a package are, MB; 0 where it is not installed."""
    try:
        files = metadata.files(name) or []
    except metadata.PackageNotFoundError:
        print(f"{name} is not installed: it is counted as nothing", file=sys.stderr)
        return 0.0
    return sum(file.size or 0 for file in files) / 1e6


if __name__ == "__main__":
    show_wheel()
    show_hosts()
