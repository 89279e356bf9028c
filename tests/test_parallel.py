"""Blocks of questions: each item is answered once, whoever dies over it."""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import closing, contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from benchdragon import parallel
from benchdragon.errors import InputError, MachineError, MissingExtraError, WalkError
from benchdragon.i18n import spoken_in
from benchdragon.kernels.status import Status
from benchdragon.parallel import (
    AHEAD,
    BLOCK_SECONDS,
    MOST_BLOCK,
    Lost,
    Place,
    WorkerError,
    cores,
    dask,
    given,
    in_blocks,
    interrupts_held,
    kept,
    place,
    place_of,
    processes,
    threads,
)
from benchdragon.plans.toml import PlanError
from tests import work

# Only what hangs takes so long, s.
HANGS = 120.0


class Here(Executor):
    """Runs what it is given at once, in this thread; its futures may be broken beforehand."""

    def __init__(self, failing: "Sequence[BaseException | None]" = ()) -> None:
        self.failing = list(failing)

    def submit(self, fn: Callable[..., Any], /, *args: Any, **named: Any) -> "Future[Any]":
        future: Future[Any] = Future()
        error = self.failing.pop(0) if self.failing else None
        if error is None:
            future.set_result(fn(*args, **named))
        else:
            future.set_exception(error)
        return future


@dataclass
class Clock:
    """Stands still, but for what an item costs."""

    cost: Callable[[int], float]
    now: float = 0.0
    blocks: list[list[int]] = field(default_factory=list)

    def perf_counter(self) -> float:
        return self.now

    def __call__(self, items: Sequence[int]) -> list[int]:
        self.blocks.append(list(items))
        self.now += sum(map(self.cost, items))
        return list(items)


def timed(
    monkeypatch: pytest.MonkeyPatch, cost: Callable[[int], float], count: int, slots: int = 1
) -> list[int]:
    """How many items each block takes, where they cost that much, s."""
    clock = Clock(cost)
    monkeypatch.setattr(parallel, "time", SimpleNamespace(perf_counter=clock.perf_counter))
    found = [
        item
        for items, _answer in in_blocks(clock, range(count), given(Here(), slots))
        for item in items
    ]
    assert sorted(found) == list(range(count))
    assert [item for block in clock.blocks for item in block] == list(range(count))
    return [len(block) for block in clock.blocks]


def alive(number: int) -> bool:
    """Whether a process runs; one that ended and was not fetched yet does not."""
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def wait_until(reached: Callable[[], bool]) -> None:
    """Wait for something that comes unless it hangs."""
    end = time.monotonic() + HANGS
    while not reached():
        assert time.monotonic() < end, "it hangs"
        time.sleep(0.01)


@pytest.mark.parametrize("count", [0, 1, 7, 500])
@pytest.mark.parametrize("where", [processes(2), threads(3), given(Here(), 2)])
def test_each_item_is_answered_once(count: int, where: Place) -> None:
    found = list(in_blocks(work.double, range(count), where))
    assert sorted(item for items, _doubled in found for item in items) == list(range(count))
    assert all(doubled == [2 * item for item in items] for items, doubled in found)
    assert len(found) < 100 or count < 500


def test_blocks_of_cheap_items_grow_to_a_second(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes = timed(monkeypatch, lambda _item: 1e-3, 20_000)
    assert sizes[:AHEAD] == [1] * AHEAD
    assert all(later <= parallel.LONGER * max(sizes[:n]) for n, later in enumerate(sizes) if n)
    assert sum(abs(size - BLOCK_SECONDS / 1e-3) <= 1 for size in sizes) >= 10
    assert max(sizes) <= BLOCK_SECONDS / 1e-3 + 1


def test_no_block_is_longer_than_what_is_sent_easily(monkeypatch: pytest.MonkeyPatch) -> None:
    assert max(timed(monkeypatch, lambda _item: 1e-7, 100_000)) == MOST_BLOCK


@pytest.mark.parametrize("cost", [0.6, 1.0, 1000.0])
def test_dear_items_run_one_by_one(monkeypatch: pytest.MonkeyPatch, cost: float) -> None:
    assert timed(monkeypatch, lambda _item: cost, 60) == [1] * 60


def test_blocks_shrink_where_items_become_dear(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes = timed(monkeypatch, lambda item: 1e-3 if item < 1000 else 0.9, 2000)
    assert max(sizes) > 100
    assert sizes[-500:] == [1] * 500


def test_what_a_worker_loads_first_makes_no_item_dear(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes = timed(monkeypatch, lambda item: 1e-3 if item else 5.0, 5000)
    assert sizes[:5] == [1, 1, 8, 8, 64]
    assert max(sizes) >= 900


def test_the_last_items_are_shared_by_all_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes = timed(monkeypatch, lambda _item: 1e-4, 4000, slots=5)
    assert sizes[-1] == 1
    left = 4000
    for size in sizes:
        assert size <= max(1, -(-left // (AHEAD * 5)))
        left -= size


def test_no_more_blocks_are_sent_than_keep_the_workers_busy() -> None:
    class Waiting(Executor):
        """Runs blocks once the first of them is waited for."""

        def __init__(self) -> None:
            self.sent: list[Future[Any]] = []

        def submit(self, _fn: Callable[..., Any], /, *args: Any, **_named: Any) -> "Future[Any]":
            self.sent.append(Future())
            self.sent[-1].set_result((list(args[0]), None, 10.0)) if len(self.sent) == 1 else None
            return self.sent[-1]

    executor = Waiting()
    with closing(in_blocks(work.double, range(100), given(executor, 3))) as blocks:
        assert next(blocks) == (range(1), [0])
        assert len(executor.sent) == AHEAD * 3
        assert not any(future.cancelled() for future in executor.sent)
    assert [future.cancelled() for future in executor.sent] == [False] + [True] * (AHEAD * 3 - 1)


@pytest.mark.parametrize("where", [processes(1), threads(1)])
def test_an_error_of_ours_comes_as_itself(where: Place) -> None:
    with pytest.raises(InputError, match=r"^not 5$"):
        list(in_blocks(work.refuse, [5], where))
    with pytest.raises(PlanError) as told:
        list(in_blocks(work.refuse_plan, [5], where))
    with pytest.raises(PlanError) as here:
        work.refuse_plan([5])
    assert type(told.value) is type(here.value)
    assert str(told.value) == str(here.value)


def test_errors_are_the_same_in_another_process() -> None:
    walk = WalkError(Status.FOLDED, 3, 1.5, 2.5, "2.86 m").at(4.0)
    for error in (MissingExtraError("data"), walk, InputError("a", 2)):
        again = pickle.loads(pickle.dumps(error))
        assert type(again) is type(error)
        assert str(again) == str(error)
        assert again.args == error.args
        assert vars(again) == vars(error)


@pytest.mark.parametrize("where", [processes(1), threads(1)])
def test_any_other_error_comes_with_its_traceback(where: Place) -> None:
    with pytest.raises(WorkerError, match=r"(?s)in divide.*ZeroDivisionError"):
        list(in_blocks(work.divide, [0], where))


@pytest.mark.parametrize("where", [processes(1), threads(1)])
def test_workers_speak_the_language_in_use(where: Place) -> None:
    with spoken_in("zh"):
        ((_items, said),) = in_blocks(work.spoken, [5], where)
        assert said == [f"zh: {work.spoken([0])[0][4:]}"]
    assert said[0] != work.spoken([0])[0]
    ((_items, said),) = in_blocks(work.spoken, [5], where)
    assert said == work.spoken([5])


def answers(blocks: Iterator[tuple[Sequence[int], Any]]) -> dict[int, Any]:
    """The answer of each item, which has one."""
    found: dict[int, Any] = {}
    for items, answer in blocks:
        each = [answer] * len(items) if isinstance(answer, Lost) else answer
        assert not found.keys() & set(items)
        found.update(zip(items, each, strict=True))
    return found


@pytest.mark.parametrize("poison", [0, 17, 39])
def test_an_item_that_kills_its_worker_is_lost_alone(poison: int) -> None:
    found = answers(in_blocks(work.Poison(poison), range(40), processes(2)))
    lost = found.pop(poison)
    assert isinstance(lost, Lost)
    assert lost.reason.startswith("BrokenProcessPool: ")
    assert found == {item: 2 * item for item in range(40) if item != poison}


def test_a_worker_that_is_killed_once_loses_nothing(tmp_path: Path) -> None:
    flag = tmp_path / "flag"
    found = answers(in_blocks(work.Poison(11, flag), range(40), processes(2)))
    assert flag.exists()
    assert found == {item: 2 * item for item in range(40)}


def test_a_block_that_loses_its_worker_is_halved_until_one_item_is_left() -> None:
    seen: list[list[int]] = []

    class Fragile(Here):
        """Loses whatever has item 6 in it, as Dask does: the others go on."""

        def submit(self, fn: Callable[..., Any], /, *args: Any, **named: Any) -> "Future[Any]":
            seen.append(list(args[0]))
            self.failing = [OSError("gone") if 6 in args[0] else None]
            return super().submit(fn, *args, **named)

    class Cheap:
        def __call__(self, items: Sequence[int]) -> list[int]:
            return list(items)

    found = answers(in_blocks(Cheap(), range(30), given(Fragile(), 1)))
    assert found.pop(6) == Lost("OSError: gone")
    assert found == {item: item for item in range(30) if item != 6}
    assert sum(block == [6] for block in seen) == parallel.MOST_LOSSES
    sizes = [len(block) for block in seen if 6 in block]
    assert sizes[0] > 1
    assert sizes == sorted(sizes, reverse=True)


def test_a_place_that_is_kept_opens_its_executor_once_and_anew_where_it_broke(tmp_path: Path) -> None:
    before, opened, ended = set(multiprocessing.active_children()), 0, 0
    where = processes(2)

    @contextmanager
    def counted() -> Iterator[Executor]:
        nonlocal opened, ended
        opened += 1
        try:
            with where.opened() as executor:
                yield executor
        finally:
            ended += 1

    with kept(replace(where, opened=counted)) as there:
        for _again in range(3):
            assert len(answers(in_blocks(work.double, range(9), there))) == 9
        assert (opened, ended) == (1, 0)
        found = answers(in_blocks(work.Poison(5, tmp_path / "flag"), range(9), there))
        assert found == {item: 2 * item for item in range(9)}
        assert (opened, ended) == (2, 1)
        with closing(in_blocks(work.double, range(9), there)) as blocks:
            next(blocks)
        assert (opened, ended) == (2, 2)
        assert len(answers(in_blocks(work.double, range(9), there))) == 9
    assert (opened, ended) == (3, 3)
    wait_until(lambda: not set(multiprocessing.active_children()) - before)


def test_an_executor_of_others_that_breaks_is_told() -> None:
    context = multiprocessing.get_context("spawn")
    with (
        ProcessPoolExecutor(1, mp_context=context) as executor,
        pytest.raises(MachineError, match=r"^the workers were lost .*run it again to go on$"),
    ):
        list(in_blocks(work.Poison(3), range(9), given(executor, 1)))


def test_blocks_that_others_cancel_are_told() -> None:
    class Cancelling(Executor):
        def submit(self, _fn: Callable[..., Any], /, *_args: Any, **_named: Any) -> "Future[Any]":
            future: Future[Any] = Future()
            future.cancel()
            future.set_running_or_notify_cancel()
            return future

    with pytest.raises(MachineError, match="cancelled"):
        list(in_blocks(work.double, range(9), given(Cancelling(), 1)))


def test_closing_leaves_no_process_and_no_thread(tmp_path: Path) -> None:
    before, threads_before = set(multiprocessing.active_children()), set(threading.enumerate())
    blocks = in_blocks(work.Stuck(tmp_path), range(9), processes(2))
    assert next(blocks) == (range(1), [0])
    wait_until(lambda: len(list(tmp_path.iterdir())) == 2)
    assert len(set(multiprocessing.active_children()) - before) == 2
    blocks.close()
    assert set(threading.enumerate()) <= threads_before
    numbers = [int(path.name) for path in tmp_path.iterdir()]
    wait_until(lambda: not any(map(alive, numbers)))
    assert not set(multiprocessing.active_children()) - before


SCRIPT = """
    import os, signal, sys
    from pathlib import Path
    from benchdragon.parallel import in_blocks, processes
    from tests import work

    {top}
    if __name__ == "__main__":
        signal.signal(signal.SIGINT, signal.default_int_handler)  # shells let jobs ignore it
        try:
            for _found in in_blocks(work.Stuck(Path({folder!r})), range(9), processes(2)):
                pass
        except KeyboardInterrupt:
            print("stopped")
"""


def script(tmp_path: Path, text: str) -> "subprocess.Popen[str]":
    """A script that runs in a session of its own."""
    path = tmp_path / "script.py"
    path.write_text(textwrap.dedent(text), "utf-8")
    paths = [str(Path(parallel.__file__).parents[1]), str(Path(__file__).parents[1])]
    return subprocess.Popen(
        [sys.executable, str(path)], env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
    )  # fmt: skip


def stuck(tmp_path: Path, top: str = "") -> "tuple[subprocess.Popen[str], list[int]]":
    """A script whose two workers are stuck, and their numbers."""
    folder = tmp_path / "stuck"
    folder.mkdir()
    ran = script(tmp_path, SCRIPT.format(folder=str(folder), top=top))
    wait_until(lambda: len(list(folder.iterdir())) == 2 or ran.poll() is not None)
    return ran, [int(path.name) for path in folder.iterdir()]


def test_a_parent_that_is_killed_leaves_no_worker(tmp_path: Path) -> None:
    ran, numbers = stuck(tmp_path)
    assert all(map(alive, numbers))
    assert len(numbers) == 2
    ran.kill()
    ran.communicate(timeout=HANGS)
    wait_until(lambda: not any(map(alive, numbers)))


def test_control_c_ends_all_without_a_word_of_the_workers(tmp_path: Path) -> None:
    ran, numbers = stuck(tmp_path)
    os.killpg(ran.pid, signal.SIGINT)
    out, errors = ran.communicate(timeout=HANGS)
    assert (ran.returncode, out, errors) == (0, "stopped\n", "")
    wait_until(lambda: not any(map(alive, numbers)))


def test_a_worker_that_is_still_starting_does_not_hear_control_c(tmp_path: Path) -> None:
    early = 'if __name__ == "__mp_main__": os.kill(os.getpid(), signal.SIGINT)'
    ran, numbers = stuck(tmp_path, early)
    assert len(numbers) == 2
    os.killpg(ran.pid, signal.SIGINT)
    assert ran.communicate(timeout=HANGS) == ("stopped\n", "")


def test_a_script_that_starts_itself_again_is_told_so(tmp_path: Path) -> None:
    text = """
        from benchdragon.errors import MachineError
        from benchdragon.parallel import in_blocks, processes
        from tests import work

        try:
            list(in_blocks(work.double, range(3), processes(2)))
        except MachineError as error:
            print(error)
    """
    ran = script(tmp_path, text)
    out, _errors = ran.communicate(timeout=HANGS)
    assert out.startswith("no worker can be started (")
    assert 'if __name__ == "__main__"' in out


@pytest.mark.parametrize("many", [0, -1, 1025, 1.5, "2"])
def test_numbers_of_workers_out_of_range_are_refused(many: Any) -> None:
    for make in (processes, threads, lambda n: given(Here(), n), lambda n: dask(None, n)):
        with pytest.raises(InputError, match="must be a whole number from 1 to 1024, not"):
            make(many)


def test_places_are_named() -> None:
    assert processes().slots() == cores() >= 1
    assert place("processes", 3).slots() == 3
    assert given(Here()).slots() == cores()
    default = threads(1)
    assert place_of(None, default) is default
    assert place_of(default, processes(1)) is default
    assert not place_of(Here(), default).again
    assert place("processes").again


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="masks of signals")
def test_an_interrupt_that_another_thread_takes_is_held_back_too() -> None:
    over, came = threading.Event(), os.pipe()
    os.set_blocking(came[1], False)
    other = threading.Thread(target=over.wait)  # it was there before what this thread holds back
    other.start()
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    woken, done = signal.set_wakeup_fd(came[1]), []

    def held() -> None:
        with interrupts_held():
            signal.pthread_kill(other.ident or 0, signal.SIGINT)
            done.append(os.read(came[0], 1))
            done.append(b"on")

    try:
        with pytest.raises(KeyboardInterrupt):
            held()
        assert done == [bytes([signal.SIGINT]), b"on"]
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.set_wakeup_fd(woken)
        signal.signal(signal.SIGINT, before)
        over.set()
        other.join()
        for end in came:
            os.close(end)
