"""The library is code for any process, and keeps to the arithmetic of kernels."""

import ctypes
import subprocess
import sys
from pathlib import Path

import llvmlite.binding as llvm
import pytest

from benchdragon.engine import optimise
from benchdragon.hosts import native

BUILT = """
import sys
from pathlib import Path
from benchdragon.engine import build, optimise, pieces, shims
from benchdragon.hosts import built
from tests.engine.test_library import inverse
pieces.keep_pieces()
optimise.prepare()
machine = optimise.target_machine(built.processor())
build.link(build.machine_code([shims.compiled(inverse)], machine), Path(sys.argv[1]))
"""


def inverse(x: float) -> float:
    return 1.0 / x


def test_division_by_zero_in_a_kernel_gives_infinity_and_no_error(tmp_path: Path) -> None:
    path = tmp_path / "one.so"
    done = subprocess.run(
        [sys.executable, "-c", BUILT, str(path)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    call = native.bound(inverse, ctypes.CDLL(str(path)))
    assert [call(0.0), call(-4.0)] == [float("inf"), -0.25]


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
