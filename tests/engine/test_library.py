"""The library built from the kernels gives what numba's code gives, and serves without numba."""

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path

import llvmlite.binding as llvm
import pytest

from benchdragon.engine import optimise
from benchdragon.kernels import jit, native

# Of what stands there, or of 1: both contract products and sums, where each processor's code allows.
APART = 1e-12


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The library for these kernels, built if need be."""
    found = native.find_library()
    if found is not None:
        return found
    folder = tmp_path_factory.mktemp("library")
    command = [sys.executable, "-m", "benchdragon.engine", str(folder)]
    subprocess.run(command, check=True, env={**os.environ, "BENCHDRAGON_ENGINE": "jit"})
    return folder / native.library_name()


@pytest.mark.numba
@pytest.mark.timeout(2400)  # it compiles each kernel, on a busy machine too
def test_every_entry_gives_what_numba_gives(library: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tests.engine.both", str(library)],
        capture_output=True, text=True, check=False, env={**os.environ, "BENCHDRAGON_ENGINE": "jit"},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    for path in native.KERNELS.glob("*.py"):
        importlib.import_module(f"benchdragon.kernels.{path.stem}")
    assert set(found) == set(jit.ENTRIES)
    assert {name: worst for name, (_calls, worst) in found.items() if not worst <= APART} == {}


def test_a_check_under_the_library_never_imports_numba(library: Path, tmp_path: Path) -> None:
    mine = tmp_path / "benchdragon" / library.name
    mine.parent.mkdir()
    mine.symlink_to(library)
    script = (
        "import sys; from benchdragon.cli.main import run\n"
        "code = run(['check', 'spiral-in', '--set', 'dragon.benches=12', '--quiet'])\n"
        "sys.exit(str({'numba', 'llvmlite'} & set(sys.modules) or code))"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False,
        env={**os.environ, "BENCHDRAGON_ENGINE": "native", "XDG_CACHE_HOME": str(tmp_path)},
    )  # fmt: skip
    assert done.stderr == "1\n", done.stdout  # not safe


CODE = """
target triple = "{triple}"
define i64 @inner(ptr %found, ptr %trouble, i64 %block) {{
  {body}
  ret i64 0
}}
declare double @{called}(double)
"""
CALL = "%a = call double @{}(double 1.0)"


@pytest.mark.parametrize(
    ("body", "called", "text"),
    [
        (CALL.format("PyFloat_AsDouble"), "PyFloat_AsDouble", "no C library has: PyFloat_AsDouble"),
        ("store i64 1, ptr inttoptr (i64 140245 to ptr)", "sin", "holds an address"),
        (CALL.format("sin"), "sin", ""),
    ],
)
def test_code_that_works_in_one_process_alone_is_refused(body: str, called: str, text: str) -> None:
    optimise.prepare()
    triple = llvm.get_default_triple()
    module = llvm.parse_assembly(CODE.format(triple=triple, body=body, called=called))
    if text:
        with pytest.raises(optimise.BuildError, match=text):
            optimise.check(module)
    else:
        optimise.check(module)
