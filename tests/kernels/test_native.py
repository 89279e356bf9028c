"""Entries of a library, called without numba: what they take and refuse, and which library serves."""

import ctypes
import json
import os
import platform
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from benchdragon.engine.build import c_compiler
from benchdragon.kernels import jit, native
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.signature import signature
from benchdragon.kernels.status import EngineError, Status
from benchdragon.own_folder import made_own

# The slots: table 0..2, factor 3, limit 4, which 5..6, out 7..8, and the three results.
SOURCE = """
#include <stdint.h>
int32_t bd_test_native_scale(int64_t *b) {
    double *table = (double *)b[0], factor = *(double *)(b + 3), *out = (double *)b[7], sum = 0.0;
    int64_t count = b[4], *which = (int64_t *)b[5];
    if (count < 0) return 3;
    for (int64_t n = 0; n < b[6]; n++) {
        out[n] = factor * table[which[n] * b[2]];
        sum += out[n];
    }
    *(double *)(b + 9) = sum;
    b[10] = count;
    b[11] = b[6] == b[8];
    return 0;
}
int32_t bd_test_native_clear(int64_t *b) {
    for (int64_t n = 0; n < b[1]; n++) ((double *)b[0])[n] = 0.0;
    return 0;
}
int32_t bd_test_native_half(int64_t *b) {
    *(double *)(b + 1) = 0.5 * *(double *)b;
    return 0;
}
int32_t bd_test_native_named(int64_t *b) {
    return bd_test_native_half(b);
}
"""


class Choice(NamedTuple):
    """Arguments that belong together."""

    limit: int
    which: IntVector


def scale(table: Table, factor: float, choice: Choice, out: Vector) -> tuple[float, Status, bool]:
    raise AssertionError("the library serves")


def clear(out: Vector) -> None:
    raise AssertionError("the library serves")


def half(x: float) -> float:
    raise AssertionError("the library serves")


class Halves(NamedTuple):
    """A result that has a name for each of its numbers."""

    half: float


def named(x: float) -> Halves:
    raise AssertionError("the library serves")


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    """A library with the three entries above."""
    folder = tmp_path_factory.mktemp("library")
    (folder / "test.c").write_text(SOURCE, encoding="utf-8")
    made = str(folder / "test.so")
    subprocess.run([c_compiler(), "-shared", "-fPIC", "-o", made, str(folder / "test.c")], check=True)
    return ctypes.CDLL(made)


TABLE = np.arange(6.0).reshape(3, 2)
WHICH = np.array([2, 0])


def test_a_block_holds_arguments_in_order_and_then_results() -> None:
    shape = signature(scale)
    assert shape.symbol == "bd_test_native_scale"
    assert [leaf.name for leaf in shape.leaves()] == [
        "table", "factor", "choice.limit", "choice.which", "out",
    ]  # fmt: skip
    assert shape.slots() == "qqqdqqqqqdqq"


@pytest.mark.parametrize("frozen", [False, True])
def test_an_entry_reads_arrays_numbers_and_groups_and_gives_back_a_tuple(
    library: ctypes.CDLL, frozen: bool
) -> None:
    call, out, table = native.bound(scale, library), np.empty(2), TABLE.copy()
    table.flags.writeable = not frozen
    choice = Choice(2, WHICH)
    for factor in (0.5, -3.0):  # the second time with the same group
        found = call(table, factor, choice, out)
        assert out.tolist() == [4.0 * factor, 0.0]
        assert found == (4.0 * factor, Status.AFTER_ROUTE, True)
        assert [type(value) for value in found] == [float, Status, bool]
    assert call(table, 1.0, Choice(2, np.empty(0, dtype=np.int64)), out) == (0.0, 2, False)


def test_a_group_that_was_made_anew_is_read_anew(library: ctypes.CDLL) -> None:
    call, out = native.bound(scale, library), np.empty(2)
    for first in (1, 2, 1):
        assert call(TABLE, 1.0, Choice(0, np.array([first, 0])), out)[0] == 2.0 * first


def test_an_entry_may_return_nothing_or_one_number(library: ctypes.CDLL) -> None:
    out = np.ones(3)
    assert native.bound(clear, library)(out) is None
    assert out.tolist() == [0.0, 0.0, 0.0]
    assert native.bound(half, library)(3.0) == 1.5
    assert native.bound(named, library)(3.0) == Halves(1.5)


@pytest.mark.parametrize(
    ("changed", "text"),
    [
        ({0: TABLE[0]}, "table must be a contiguous 2-dimensional array of float64, not a 1-"),
        ({0: TABLE.T}, "table .* float64, not contiguous"),
        ({0: TABLE.astype(np.float32)}, "table .* not a 2-dimensional array of float32"),
        ({0: TABLE.tolist()}, "table must be .*, not <class 'list'>"),
        ({2: Choice(1, WHICH.astype(np.int32))}, "choice.which must .* of int64, not .* int32"),
        ({2: (1, WHICH)}, "choice must be a .*Choice"),
        ({3: np.empty(4)[::2]}, "out .* not contiguous"),
    ],
)  # fmt: skip
def test_what_the_library_cannot_read_is_refused(
    library: ctypes.CDLL, changed: dict[int, Any], text: str
) -> None:
    call: Any = native.bound(scale, library)
    arguments = {0: TABLE, 1: 1.0, 2: Choice(1, WHICH), 3: np.empty(2), **changed}
    with pytest.raises(TypeError, match=text):
        call(*arguments.values())


def test_too_few_arguments_and_words_for_numbers_are_refused(library: ctypes.CDLL) -> None:
    call: Any = native.bound(half, library)
    with pytest.raises(TypeError, match="takes 1 arguments, not 0"):
        call()
    with pytest.raises(Exception, match="float"):
        call("x")


def test_an_entry_that_fails_raises(library: ctypes.CDLL) -> None:
    with pytest.raises(MemoryError, match="bd_test_native_scale ended with code 3"):
        native.bound(scale, library)(TABLE, 1.0, Choice(-1, WHICH), np.empty(2))


def test_an_annotation_that_says_too_little_is_refused() -> None:
    def loose(values: Any) -> None: ...

    def worded(values: float) -> str:
        return str(values)

    for function, name in ((loose, "values"), (worded, "the result")):
        with pytest.raises(TypeError, match=f"{name} of an entry must be"):
            signature(function)


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package of one kernel, with a builder."""
    for name in ("kernels", "engine"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "one.py").write_text("a = 1\n", encoding="utf-8")
    monkeypatch.setattr(native, "KERNELS", tmp_path / "kernels")
    monkeypatch.setattr(native, "ENGINE", tmp_path / "engine")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path


@pytest.mark.parametrize("changed", ["kernels/one.py", "engine/one.py", "engine/runtime.c"])
def test_a_library_of_other_sources_is_not_found(package: Path, changed: str) -> None:
    assert native.find_library() is None
    path = package / "engine" / native.library_name()
    path.touch()
    assert native.find_library() == path
    (package / changed).write_text("a = 2\n", encoding="utf-8")
    assert native.find_library() is None
    mine = native.user_folder() / native.library_name()
    assert mine.is_relative_to(package / "cache")
    assert made_own(mine.parent) == mine.parent
    mine.touch()
    assert native.find_library() == mine


def test_a_library_for_another_processor_is_not_found(
    package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(platform, "machine", lambda: "x86_64")
    monkeypatch.setattr(native, "PROCESSORS", package / "cpuinfo")
    assert native.processor() == "x86-64"
    flags = "flags : fpu " + " ".join(sorted(native.V3))
    native.PROCESSORS.write_text(f"model : one\n{flags}\n{flags}\n", encoding="utf-8")
    assert native.processor() == "x86-64-v3"
    path = package / "engine" / native.library_name()
    path.touch()
    assert native.find_library() == path
    native.PROCESSORS.write_text(flags.replace("avx2", "avx"), encoding="utf-8")
    assert native.processor() == "x86-64"
    assert native.find_library() is None
    monkeypatch.setattr(platform, "machine", lambda: "arm64")
    assert native.processor() == "arm64"


def test_a_library_that_cannot_be_loaded_is_as_none(package: Path) -> None:
    assert native.load_library() is None
    (package / "engine" / native.library_name()).write_bytes(b"no library")
    assert native.load_library() is None


@pytest.mark.parametrize("there", [False, True])
def test_the_library_serves_where_there_is_one_unless_something_else_is_said(
    there: bool, library: ctypes.CDLL, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(native, "load_library", lambda: library if there else None)
    monkeypatch.delenv(jit.VARIABLE, raising=False)
    assert jit.chosen_engine() == (("native", library) if there else ("jit", None))
    for name in ("jit", "plain"):
        monkeypatch.setenv(jit.VARIABLE, name)
        assert jit.chosen_engine() == (name, None)
    monkeypatch.setenv(jit.VARIABLE, "native")
    if there:
        assert jit.chosen_engine() == ("native", library)
    else:
        with pytest.raises(EngineError, match="native"):
            jit.chosen_engine()
    monkeypatch.setenv(jit.VARIABLE, "never")
    with pytest.raises(EngineError, match="never"):
        jit.chosen_engine()


def python(script: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """A fresh process."""
    return subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True, text=True, check=False, env={**os.environ, **environment},
    )  # fmt: skip


WITHOUT = "import benchdragon.kernels.native as native; native.load_library = lambda: None\n"


@pytest.mark.parametrize(
    ("engine", "text"),
    [("native", "build it by `python -m benchdragon.engine`"), ("fast", "jit or plain, not 'fast'")],
)
def test_an_engine_that_cannot_serve_is_an_error_with_advice(engine: str, text: str) -> None:
    command = "from benchdragon.cli.main import run; raise SystemExit(run(['check', 'spiral-in']))"
    done = python(WITHOUT + command, BENCHDRAGON_ENGINE=engine, BENCHDRAGON_LANG="en")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("Error: BENCHDRAGON_ENGINE ")
    assert text in done.stderr
    public = python(WITHOUT + "import benchdragon; benchdragon.Walk", BENCHDRAGON_ENGINE=engine)
    assert "benchdragon.errors.InputError: " in public.stderr


@pytest.mark.parametrize("engine", ["jit", "plain"])
def test_the_other_engines_still_place_a_dragon(engine: str) -> None:
    script = (
        "import json, benchdragon as bd; from benchdragon.kernels import jit\n"
        "walk = bd.read_plan('spiral-in', ['dragon.benches=3']).build()\n"
        "print(json.dumps([jit.ENGINE, walk.motion([0.0]).x[0].tolist()]))"
    )
    done = python(script, BENCHDRAGON_ENGINE=engine)
    found, x = json.loads(done.stdout)
    assert found == engine
    assert x[:2] == pytest.approx([8.8, 8.363824], abs=1e-6)
