"""Who serves, what is said where that cannot be, and that all who serve answer the same."""

import ctypes
import json
import os
import subprocess
import sys
from importlib.metadata import version
from typing import Any, NamedTuple

import numpy as np
import pytest

from benchdragon.hosts import compiled, native, serving, wasm
from benchdragon.hosts.serving import VARIABLE, Serving, chosen
from benchdragon.hosts.trouble import EngineError, Trouble
from tests.hosts import modules


class Lists(NamedTuple):
    """Arrays that belong together."""

    first: Any
    second: Any


class Several(NamedTuple):
    """Arrays, also in another group."""

    numbers: Any
    inner: Lists


def test_arrays_are_made_where_the_engine_works(monkeypatch: pytest.MonkeyPatch) -> None:
    group = Several(np.arange(3.0), Lists(np.array([1]), np.arange(4)))
    host = modules.host()
    served = Serving("wasm", host.bound, lambda shape, code: host.instance().array(shape, code))
    monkeypatch.setattr(serving, "serving", lambda: served)
    made = serving.placed(group)
    assert isinstance(made, Several)
    assert isinstance(made.inner, Lists)
    assert [array.tolist() for array in (made.numbers, *made.inner)] == [[0, 1, 2], [1], [0, 1, 2, 3]]
    arrays = [made.numbers, *made.inner, serving.empty(2, 3), serving.empty_whole(5)]
    assert [(array.shape, array.dtype.name) for array in arrays[-2:]] == [
        ((2, 3), "float64"), ((5,), "int64"),
    ]  # fmt: skip
    base = host.instance()._base
    assert all(base <= array.ctypes.data < base + wasm.REACH for array in arrays)
    monkeypatch.setattr(serving, "serving", lambda: Serving("native", host.bound))
    assert serving.placed(group) is group
    assert serving.empty(2).flags.owndata


@pytest.mark.parametrize("there", [False, True])
def test_the_library_serves_where_there_is_one_unless_something_else_is_said(
    there: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = ctypes.CDLL(None)
    monkeypatch.setattr(native, "load_library", lambda: library if there else None)
    monkeypatch.delenv(VARIABLE, raising=False)
    assert chosen().name == ("native" if there else "wasm")
    for name in ("wasm", "plain"):
        monkeypatch.setenv(VARIABLE, name)
        assert chosen().name == name
    monkeypatch.setenv(VARIABLE, "native")
    if there:
        assert chosen().name == "native"
    else:
        with pytest.raises(EngineError) as told:
            chosen()
        assert told.value.trouble is Trouble.NO_LIBRARY
    monkeypatch.setenv(VARIABLE, "never")
    with pytest.raises(EngineError, match="never") as told:
        chosen()
    assert told.value.trouble is Trouble.UNKNOWN


def python(script: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """A fresh process."""
    return subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True, text=True, check=False, env={**os.environ, **environment},
    )  # fmt: skip


NO_LIBRARY = "from benchdragon.hosts import built, native; native.load_library = lambda: None\n"
CHANGED = NO_LIBRARY + "built.source_hash = lambda: 'changed'\n"
NO_WASMTIME = NO_LIBRARY + "import sys; sys.modules['wasmtime'] = None\n"


@pytest.mark.parametrize(
    ("before", "engine", "text"),
    [
        (NO_LIBRARY, "native", "build it by `python -m benchdragon.engine`"),
        (NO_LIBRARY, "fast", "BENCHDRAGON_ENGINE must be native, wasm or plain, not 'fast'"),
        (
            CHANGED,
            "",
            "were changed after engine.wasm was built from them: rebuild it by `make wasm`",
        ),
        (NO_WASMTIME, "", "install the package wasmtime again"),
    ],
)
def test_an_engine_that_cannot_serve_is_an_error_with_advice(
    before: str, engine: str, text: str
) -> None:
    command = "from benchdragon.cli.main import run; raise SystemExit(run(['check', 'spiral-in']))"
    done = python(before + command, BENCHDRAGON_ENGINE=engine, BENCHDRAGON_LANG="en")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("Error: ")
    assert text in done.stderr
    public = python(before + "import benchdragon; benchdragon.Walk([])", BENCHDRAGON_ENGINE=engine)
    assert "Error: " in public.stderr.splitlines()[-1]


BROKEN = """
from benchdragon.hosts import wasm
def broken(*arguments): raise wasm.EngineError(wasm.Trouble.BROKEN_OFF, "march: wasm trap")
wasm.Instance.call = broken
from benchdragon.cli.main import run; raise SystemExit(run(['check', 'spiral-in']))
"""


def test_an_engine_that_breaks_off_ends_with_a_sentence() -> None:
    done = python(BROKEN, BENCHDRAGON_ENGINE="wasm", BENCHDRAGON_LANG="en")
    assert (done.returncode, done.stdout) == (6, "")
    assert done.stderr == ("Error: the engine failed, which is a bug: march: wasm trap\n")


ANSWERS = """
import json, sys
from concurrent.futures import ThreadPoolExecutor
import benchdragon as bd
from benchdragon.hosts.serving import serving
from benchdragon.cli.main import run
few, coiled = bd.read_plan("spiral-in", [FEW]), bd.read_plan("spiral-in", [FEW, "disc.radius=4.5"])
walk = few.build()
span = few.span(walk)
def ask(_thread):
    return bd.first_contact(walk, *span).value
pool = ThreadPoolExecutor(2)
found = [ask(0), *pool.map(ask, range(2)), bd.smallest_pitch(coiled).value]
near = bd.check(bd.read_plan("spiral-in", [FEW, "walk.start=410", "walk.end=420"])).clearance.value
assert near > 0.01
found.append(near)
times = [0.1 * n for n in range(4000)]
longer = bd.read_plan("spiral-in", ["dragon.benches=12"]).build()  # threads work at once
one, other = longer.motion(times), longer.motion(times, workers=4)
assert (one.x == other.x).all() and (one.speed == other.speed).all() and not other.status.any()
found.append(float(one.x[-1, -1]))
served = serving().name
print(json.dumps([served, found, sorted({"numba", "llvmlite", "wasmtime"} & set(sys.modules))]))
"""
BLOCKED = "import sys; sys.modules['numba'] = sys.modules['llvmlite'] = None\n"
# Of a length or a time, m and s: hosts round differently.
APART = 1e-9


def test_all_who_serve_give_the_same_in_any_thread_and_need_no_compiler() -> None:
    script = BLOCKED + ANSWERS.replace("FEW", repr("dragon.benches=6"))
    names = ["wasm", "plain", *(["native"] if native.find_library() else [])]
    told = {name: python(script, BENCHDRAGON_ENGINE=name) for name in names}
    assert {name: done.stderr for name, done in told.items()} == dict.fromkeys(names, "")
    found = {name: json.loads(done.stdout) for name, done in told.items()}
    assert {name: served for name, (served, _numbers, _imported) in found.items()} == {
        name: name for name in names
    }
    for name, (_served, numbers, imported) in found.items():
        assert numbers == pytest.approx(found["plain"][1], abs=APART)
        assert numbers[0] == numbers[1] == numbers[2]
        assert ("wasmtime" in imported) == (name == "wasm")


def test_the_command_line_answers_without_numba() -> None:
    command = "from benchdragon.cli.main import run; sys.exit(run(['check', 'spiral-in', '--quiet']))"
    done = python(BLOCKED + command, BENCHDRAGON_ENGINE="wasm", BENCHDRAGON_LANG="en")
    assert (done.returncode, done.stderr) == (1, "")
    assert "touch at t = 412.47 s" in done.stdout


def test_the_module_serves_in_a_fresh_process_with_an_empty_home(
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    home = tmp_path_factory.mktemp("home")
    command = (
        "from benchdragon.cli.main import run; run(['motion', 'spiral-in', '--at', '1', '--json'])"
    )
    said = [
        python(command, BENCHDRAGON_ENGINE="wasm", XDG_CACHE_HOME=str(home)).stdout for _start in (0, 1)
    ]
    assert json.loads(said[0])["speed"]
    assert said[0] == said[1]
    assert [path.name for path in (home / "benchdragon").iterdir()] == [
        compiled.name_of(wasm.code_of_these_kernels(), version("wasmtime"))
    ]
