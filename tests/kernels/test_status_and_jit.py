"""How a solve can end, and the one decorator of all kernels."""

import ast
import os
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import pytest
from numba.core import event

from benchdragon.kernels import jit, native
from benchdragon.kernels.status import Status


def test_only_ok_is_false_and_every_status_has_its_own_number() -> None:
    assert [status for status in Status if not status] == [Status.OK]
    assert [int(status) for status in Status] == list(range(len(Status)))


def double(x: float) -> float:
    return 2.0 * x


def test_kernels_stay_plain_functions_when_compiling_is_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jit, "COMPILED", False)
    assert jit.kernel(double) is double


@pytest.fixture
def compiling(monkeypatch: pytest.MonkeyPatch) -> None:
    """The compiled branch, also where the kernels of this run are plain."""
    monkeypatch.setattr(jit, "COMPILED", True)
    monkeypatch.setattr(jit, "numba", numba, raising=False)


@pytest.mark.usefixtures("compiling")
@pytest.mark.parametrize("cached", [True, False])
def test_a_kernel_compiles_and_leaves_numba_as_it_was(
    cached: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(jit, "CACHE_FOLDER", tmp_path if cached else None)
    settings: Any = numba.config
    before = settings.CACHE_DIR
    compiled: Any = jit.kernel(double)
    assert settings.CACHE_DIR == before
    assert compiled(1.5) == 3.0
    assert len(compiled.signatures) == 1
    assert any(tmp_path.rglob("*.nbi")) == cached


@pytest.mark.usefixtures("compiling")
def test_division_by_zero_in_a_kernel_gives_infinity_and_no_error(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def inverse(x: float) -> float:
        return 1.0 / x

    monkeypatch.setattr(jit, "CACHE_FOLDER", None)
    assert jit.kernel(inverse)(0.0) == float("inf")


def test_the_cache_folder_changes_with_any_line_of_any_kernel(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    sources = tmp_path / "kernels"
    sources.mkdir()
    (sources / "one.py").write_text("a = 1\n", encoding="utf-8")
    (sources / "two.py").write_text("b = 2\n", encoding="utf-8")
    monkeypatch.setattr(jit, "__file__", str(sources / "jit.py"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    first = jit.cache_folder()
    assert first is not None
    assert first.is_dir()
    assert first.parent == tmp_path / "cache" / "benchdragon"
    assert jit.cache_folder() == first
    (sources / "two.py").write_text("b = 3\n", encoding="utf-8")
    assert jit.cache_folder() not in (None, first)


def test_the_cache_goes_to_the_temporary_folder_where_home_cannot_hold_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    folder = jit.cache_folder()
    assert folder is not None
    assert folder.is_relative_to(tmp_path / "temporary")


def test_there_is_no_cache_where_nothing_can_be_written(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def never(_path: object, _mode: int) -> bool:
        return False

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(os, "access", never)
    assert jit.cache_folder() is None


class FakeTimer:
    """Stands for threading.Timer: tells whether it was started and cancelled, and never waits."""

    made: list["FakeTimer"]

    def __init__(self, after: float, slow: Callable[[], None]) -> None:
        self.after, self.slow, self.calls = after, slow, list[str]()
        FakeTimer.made.append(self)

    def start(self) -> None:
        self.calls.append("start")

    def cancel(self) -> None:
        self.calls.append("cancel")


@pytest.fixture
def listeners(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, Any]]:
    """What `watch_compiling` registers with numba, with a timer that never waits."""
    found: list[tuple[str, Any]] = []
    FakeTimer.made = []
    monkeypatch.setattr(threading, "Timer", FakeTimer)
    monkeypatch.setattr(event, "register", lambda kind, listener: found.append((kind, listener)))
    monkeypatch.setattr(event, "unregister", lambda kind, listener: found.remove((kind, listener)))
    monkeypatch.setattr(jit, "_watching", [])
    return found


@pytest.mark.usefixtures("compiling")
def test_slow_compiling_is_timed_once_from_the_outermost_kernel(
    listeners: list[tuple[str, Any]],
) -> None:
    def slow() -> None: ...

    jit.watch_compiling(slow, 2.5)
    [(kind, listener)] = listeners
    assert kind == "numba:compile"
    listener.on_start(None)
    listener.on_start(None)  # a kernel that the first one calls
    listener.on_end(None)
    started = [timer for timer in FakeTimer.made if timer.calls]
    assert [(timer.calls, timer.after, timer.slow) for timer in started] == [(["start"], 2.5, slow)]
    listener.on_end(None)
    assert started[0].calls == ["start", "cancel"]
    listener.on_start(None)
    assert sum("start" in timer.calls for timer in FakeTimer.made) == 2


@pytest.mark.usefixtures("compiling")
def test_who_watches_last_watches_alone(listeners: list[tuple[str, Any]]) -> None:
    jit.watch_compiling(lambda: None, 1.0)
    first = listeners[0]
    jit.watch_compiling(lambda: None, 1.0)
    assert len(listeners) == 1
    assert listeners[0] != first


def test_plain_kernels_have_no_compiling_to_watch(
    monkeypatch: pytest.MonkeyPatch, listeners: list[tuple[str, Any]]
) -> None:
    monkeypatch.setattr(jit, "COMPILED", False)
    jit.watch_compiling(lambda: None, 0.0)
    assert listeners == []


def test_who_is_given_new_arrays_counts_references_to_them() -> None:
    """Else they would never be freed."""
    kernels = {
        node.name: node
        for path in native.KERNELS.glob("*.py")
        for node in ast.parse(path.read_text("utf-8")).body
        if isinstance(node, ast.FunctionDef)
        and {"kernel", "entry"} & {ast.unparse(mark) for mark in node.decorator_list}
    }
    counting = {
        name
        for name, node in kernels.items()
        if "allocates" in {ast.unparse(mark) for mark in node.decorator_list}
    }
    returned = {
        name: node.returns.id for name, node in kernels.items() if isinstance(node.returns, ast.Name)
    }
    makers = {name for name in counting if returned.get(name, "int") not in ("int", "float", "bool")}
    assert makers
    for name, node in kernels.items():
        called = {ast.unparse(call.func) for call in ast.walk(node) if isinstance(call, ast.Call)}
        if called & (makers | {"np.empty", "np.zeros"}):
            assert name in counting
