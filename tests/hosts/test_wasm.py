"""The module in Python: its memory, what breaks off, threads, and what it says of itself."""

import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier
from typing import Any

import numpy as np
import pytest

from benchdragon.hosts import built, wasm
from benchdragon.hosts.trouble import EngineError, Trouble
from tests.hosts.modules import Choice, follow, half, host, scale, wreck


@pytest.fixture(scope="module")
def shared() -> wasm.Host:
    """The host of the module by hand."""
    return host()


def live(instance: Any) -> int:
    """Rooms in the memory of the module by hand that were not given back."""
    instance._free()
    return int(instance._exports["live"].value(instance._store))


def test_what_a_call_was_given_room_for_is_given_back_however_it_ends(shared: wasm.Host) -> None:
    call, out = shared.bound(scale), np.empty(1)
    table = np.ones((wasm.KEPT // 8, 1))  # its copy is too large to be kept
    call(table, 1.0, Choice(1, np.array([0])), out)
    before = live(shared.instance())
    for limit in (1, -1):
        for _call in range(3):
            try:
                call(table, 1.0, Choice(limit, np.array([0])), out)
            except MemoryError:
                assert limit == -1
    assert live(shared.instance()) == before


def test_arrays_in_the_memory_are_used_where_they_are_and_given_back(shared: wasm.Host) -> None:
    instance, call = shared.instance(), shared.bound(follow)
    call(np.empty(0), np.empty(0))
    before = live(instance)
    numbers = instance.array((6,), "d")
    numbers[...] = 0.0
    call(numbers[1:], numbers[:-1])
    assert numbers.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
    view = numbers[2:]
    del numbers
    assert live(instance) == before + 1
    assert view.tolist() == [2.0, 3.0, 4.0, 5.0]
    del view
    assert live(instance) == before
    whole = instance.array((2, 3), "q")
    assert (whole.shape, whole.dtype.name) == ((2, 3), "int64")


def test_arrays_stay_where_they_are_while_memory_grows(shared: wasm.Host) -> None:
    instance = shared.instance()
    first = instance.array((3,), "d")
    first[...] = 1.0
    more = [instance.array((1 << 17,), "d") for _room in range(50)]  # 50 MB
    shared.bound(follow)(first, first)
    assert first.tolist() == [2.0, 2.0, 2.0]
    assert len(more) == 50


@pytest.mark.parametrize("count", [1 << 26, 1 << 28])
def test_more_than_the_memory_holds_is_a_memory_error(shared: wasm.Host, count: int) -> None:
    rooms = (shared.instance().array((count,), "d") for _room in range(9))
    with pytest.raises(MemoryError, match="no room for"):
        list(rooms)
    assert shared.bound(half)(3.0) == 1.5


CLOSED = """
import mmap
import numpy as np
from tests.hosts.modules import Choice, host, scale
table = np.frombuffer(mmap.mmap(-1, 4096, prot=mmap.PROT_READ), dtype=np.float64).reshape(-1, 1)
print(host().bound(scale)(table, 1.0, Choice(1, np.array([5])), np.empty(1))[0])
"""


def test_what_may_not_be_written_is_only_read() -> None:
    """The system would end a process that writes there."""
    done = subprocess.run([sys.executable, "-c", CLOSED], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "0.0\n"), done.stderr


def test_a_call_that_breaks_off_is_told_and_the_next_finds_a_fresh_memory(shared: wasm.Host) -> None:
    before = shared.instance()
    kept = before.array((2,), "d")
    kept[...] = 1.0
    with pytest.raises(EngineError, match=r"bd_modules_wreck: wasm trap: .*unreachable") as told:
        shared.bound(wreck)(1.0)
    assert told.value.trouble is Trouble.BROKEN_OFF
    assert told.value.__cause__ is None
    out = np.zeros(2)
    shared.bound(follow)(out, kept)  # what lies in the old one is as any other array now
    assert out.tolist() == [2.0, 2.0]
    assert shared.instance() is not before


def test_each_thread_has_an_instance_and_may_take_arrays_of_another(shared: wasm.Host) -> None:
    barrier, call = Barrier(4), shared.bound(follow)
    ours = shared.instance().array((1000,), "d")
    ours[...] = np.arange(1000.0)

    def work(thread: int) -> tuple[int, list[float]]:
        barrier.wait()
        out = np.empty(1000)
        for _call in range(200):
            call(out, ours if thread % 2 else ours.copy())
        return id(shared.instance()), out.tolist()

    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(work, range(4)))
    assert len({instance for instance, _numbers in found}) == 4
    assert {tuple(numbers) for _instance, numbers in found} == {tuple(np.arange(1.0, 1001.0))}


INTERRUPTED = """
import os, signal, threading, time
from tests.hosts.modules import host, spin
signal.signal(signal.SIGINT, signal.default_int_handler)
call = host().bound(spin)
call(1)
threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT)).start()
for _call in range(10_000):
    call(20_000_000)
"""


def test_ctrl_c_ends_a_program_within_a_call_or_two() -> None:
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, check=False, timeout=60
    )
    assert done.stderr.splitlines()[-1] == "KeyboardInterrupt"
    assert done.returncode != 0


LEFT = """
import gc
import benchdragon as bd
bd.read_plan("spiral-in").build().motion([0.0])
gc.freeze()  # what is left is cleared after Wasmtime's own modules
"""


def test_nothing_is_said_when_a_program_ends() -> None:
    environment = {**os.environ, "BENCHDRAGON_ENGINE": "wasm"}
    done = subprocess.run(
        [sys.executable, "-c", LEFT], capture_output=True, text=True, check=False, env=environment
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_a_module_of_other_kernels_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    assert wasm.told(wasm.code_of_these_kernels())["stamp"]["sources"] == built.source_hash()
    monkeypatch.setattr(built, "source_hash", lambda: "others")
    with pytest.raises(EngineError) as told:
        wasm.code_of_these_kernels()
    assert told.value.trouble is Trouble.OTHER_SOURCES


@pytest.mark.parametrize(
    ("spans", "whole"),
    [
        ([(0, 8, True), (8, 16, True)], [(0, 8, True), (8, 16, True)]),
        ([(4, 9, False), (0, 8, True), (8, 9, False)], [(0, 9, True)]),
        ([(0, 9, False), (2, 3, False), (20, 21, False)], [(0, 9, False), (20, 21, False)]),
    ],
)
def test_spans_that_overlap_become_one(
    spans: list[tuple[int, int, bool]], whole: list[tuple[int, int, bool]]
) -> None:
    given: Iterator[wasm.Span] = (wasm.Span(*span) for span in spans)
    assert list(wasm.joined(given)) == whole
