"""Many small questions, in blocks, wherever they may run: processes, threads, a Dask cluster.

Questions differ in cost by a factor of a million, so that a block holds as many as take
about BLOCK_SECONDS, by measure. What a block came to is handed over as soon as it is there.

A block whose worker was lost runs again; one that loses its worker each time is halved until one item
is left, which is given up then.
"""

import multiprocessing
import os
import signal
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext, suppress
from dataclasses import dataclass, field, replace
from multiprocessing.connection import wait as wait_for
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, Generic, TypeVar

from benchdragon.errors import BenchDragonError, MachineError, brought_by, whole
from benchdragon.i18n import _, language, spoken_in

T = TypeVar("T")
R = TypeVar("R")

# A block takes about so long, s: long beside what sending it costs, short beside a coffee break.
BLOCK_SECONDS, MOST_BLOCK = 1.0, 5_000
# Blocks that are sent for each worker, so that none waits for the next.
AHEAD = 2
# How much the last block counts in what an item costs, and how many times longer than what was measured
# the next may be.
LAST_WEIGHT, LONGER = 0.3, 8
# How often an item may lose its worker before it is given up.
MOST_LOSSES = 3
MOST_WORKERS = 1024
# For a scheduler to answer, and for a pool whose processes were killed to end, s.
PATIENCE = 10.0


@dataclass(frozen=True)
class Place:
    """Where blocks run.

    Attributes:
        opened: an executor, in a context that ends it.
        slots: how many blocks it runs at a time, now.
        again: whether another one may be opened after it broke.
    """

    opened: Callable[[], AbstractContextManager[Executor]]
    slots: Callable[[], int]
    again: bool


@dataclass(frozen=True)
class Lost:
    """An item whose workers were lost each time."""

    reason: str


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def processes(count: int | None = None) -> Place:
    """Processes of this machine, one a core unless `count` says how many.

    Raises:
        InputError: for a number out of range.
    """
    many = cores() if count is None else whole("workers", count, 1, MOST_WORKERS)
    return Place(lambda: _pool(many), lambda: many, again=True)


def threads(count: int) -> Place:
    """Threads of this process, for work that leaves Python's lock.

    Raises:
        InputError: for a number out of range.
    """
    many = whole("threads", count, 1, MOST_WORKERS)
    return Place(lambda: ThreadPoolExecutor(many), lambda: many, again=False)


def given(executor: Executor, slots: int | None = None) -> Place:
    """An executor owned by the caller, which runs `slots` blocks at a time, or one a core.

    Raises:
        InputError: for a number out of range.
    """
    many = cores() if slots is None else whole("slots", slots, 1, MOST_WORKERS)
    return Place(lambda: nullcontext(executor), lambda: many, again=False)


def place_of(executor: Executor | Place | None, default: Place) -> Place:
    """Where an executor runs blocks; `default` if there is none."""
    if executor is None:
        return default
    return executor if isinstance(executor, Place) else given(executor)


def dask(address: str | None = None, count: int | None = None) -> Place:
    """A Dask cluster: that of the scheduler at an address, or a new one of this machine.

    Raises:
        InputError: for a number of workers out of range.
        MissingExtraError: without distributed.
    """
    with brought_by("cluster"):
        import distributed
    library: Any = distributed  # it has no types
    many = cores() if count is None else whole("workers", count, 1, MOST_WORKERS)
    clients: list[Any] = []

    @contextmanager
    def opened() -> Iterator[Executor]:
        with ExitStack() as stack:
            at: Any = address
            if at is None:
                at = library.LocalCluster(
                    n_workers=many, threads_per_worker=1, dashboard_address=None, silence_logs=50
                )
                stack.enter_context(at)
            clients.append(stack.enter_context(_client(library, at)))
            yield clients[-1].get_executor()

    return Place(opened, lambda: max(1, sum(clients[-1].nthreads().values())), again=False)


def _client(library: Any, address: Any) -> Any:
    try:
        return library.Client(address, timeout=PATIENCE)
    except (OSError, ValueError) as error:
        text = _("no scheduler answers at {address}: {why}")
        raise MachineError(text.format(address=address, why=error)) from None


def place(name: str, count: int | None = None) -> Place:
    """What `processes`, `dask` or the address of a Dask scheduler names.

    Raises:
        InputError: for a number of workers out of range.
        MissingExtraError: without distributed.
    """
    if name == "processes":
        return processes(count)
    return dask(None if name == "dask" else name, count)


@contextmanager
def kept(place: Place) -> Iterator[Place]:
    """The same place, whose executor stays open from one `in_blocks` to the next, unless one fails."""
    with ExitStack() as stack:
        executors: list[Executor] = []

        @contextmanager
        def opened() -> Iterator[Executor]:
            if not executors:
                executors.append(stack.enter_context(place.opened()))
            try:
                yield executors[0]
            except BaseException:
                executors.clear()
                with stack.pop_all():
                    raise

        yield replace(place, opened=opened)


def in_blocks(
    work: Callable[[Sequence[T]], R], items: Sequence[T], place: Place
) -> Generator[tuple[Sequence[T], R | Lost], None, None]:
    """What `work` makes of the items, block by block in any order, each as soon as it is there.

    `work` takes some items and gives one result for all of them; it goes to the workers by pickle, and
    the language in use with it. What is still running is given up when the generator is closed.

    Raises:
        BenchDragonError: that `work` raised; and MachineError if no scheduler answers, or an executor
            broke that cannot be opened again.
        WorkerError: for any other exception of `work`.
    """
    run = _Run(_Task(work, language()), items, place)
    while not run.over:
        with suppress(_AgainError), place.opened() as executor:
            if run.broke:
                _see_that_one_starts(executor)
            try:
                yield from run.drive(executor)
            finally:  # an executor owned by the caller has finished with these
                for future in run.running:
                    future.cancel()


def _see_that_one_starts(executor: Executor) -> None:
    """Raise MachineError if no worker starts at all, before any item is blamed."""
    try:
        executor.submit(os.getpid).result()
    except BrokenExecutor as error:
        text = _(
            "no worker can be started ({why}); a script must keep its work below "
            'if __name__ == "__main__"'
        )
        raise MachineError(text.format(why=error)) from None


class _AgainError(Exception):
    """The executor broke, and another one is needed."""


class WorkerError(RuntimeError):
    """What went wrong in a worker that should not have: its traceback."""


@dataclass(frozen=True)
class _Task(Generic[T, R]):
    """Work as it is sent: with the language, timed, and with its exceptions as results.

    So what a future raises is a worker's loss, and nothing else.
    """

    work: Callable[[Sequence[T]], R]
    language: str

    def __call__(self, items: Sequence[T]) -> tuple[R | None, Exception | None, float]:
        began = time.perf_counter()
        found: R | None = None
        wrong: Exception | None = None
        try:
            with spoken_in(self.language):
                found = self.work(items)
        except BenchDragonError as error:
            wrong = error
        except Exception:
            wrong = WorkerError(traceback.format_exc())
        return found, wrong, time.perf_counter() - began


@dataclass(eq=False)
class _Block(Generic[T]):
    items: Sequence[T]
    losses: int = 0


@dataclass
class _Run(Generic[T, R]):
    """Items on their way: those not sent yet, those that run, those to be run again."""

    task: _Task[T, R]
    items: Sequence[T]
    place: Place
    sent: int = 0
    cost: float = 0.0  # of an item, s; 0 while none is known
    longest: int = 1
    broke: bool = False
    running: "dict[Future[Any], _Block[T]]" = field(default_factory=dict)
    suspects: "deque[_Block[T]]" = field(default_factory=deque)

    @property
    def over(self) -> bool:
        """Whether nothing is left to do."""
        return self.sent == len(self.items) and not self.suspects and not self.running

    def drive(self, executor: Executor) -> Iterator[tuple[Sequence[T], R | Lost]]:
        """Run blocks until none is left, or the executor broke and another is needed."""
        while not self.over:
            try:
                self._send(executor)
            except BrokenExecutor as error:
                yield from self._broken(error)
                raise _AgainError from None
            done = wait(self.running, return_when=FIRST_COMPLETED).done
            sound = [future for future in done if self._failure(future) is None]
            for future in sound:
                yield self._received(future)
            for future in done.difference(sound):
                why = self._failure(future)
                if isinstance(why, BrokenExecutor):
                    yield from self._broken(why)
                    raise _AgainError
                yield from self._blamed(self.running.pop(future), why)

    def _failure(self, future: "Future[Any]") -> BaseException | None:
        """What kept a worker from answering."""
        return BrokenExecutor("cancelled") if future.cancelled() else future.exception()

    def _send(self, executor: Executor) -> None:
        """Let as many blocks run as there is room for; a suspect runs alone."""
        if self.suspects:
            if not self.running:
                block = self.suspects[0]
                self.running[executor.submit(self.task, block.items)] = block
                self.suspects.popleft()
            return
        slots = self.place.slots()
        while len(self.running) < AHEAD * slots and self.sent < len(self.items):
            block = _Block(self.items[self.sent : self.sent + self._size(slots)])
            self.running[executor.submit(self.task, block.items)] = block
            self.sent += len(block.items)

    def _size(self, slots: int) -> int:
        """How many items the next block takes: of the last ones each worker gets its share."""
        if not self.cost:
            return 1
        share = -(-(len(self.items) - self.sent) // (AHEAD * slots))
        return max(1, min(int(BLOCK_SECONDS / self.cost), LONGER * self.longest, MOST_BLOCK, share))

    def _received(self, future: "Future[Any]") -> tuple[Sequence[T], R]:
        block = self.running.pop(future)
        found, wrong, seconds = future.result()
        if wrong is not None:
            raise wrong
        cost = max(seconds / len(block.items), 1e-9)
        # The first blocks of a worker load what it needs: they count as little as they can.
        settled = self.longest > 1
        weighed = LAST_WEIGHT * cost + (1.0 - LAST_WEIGHT) * self.cost
        self.cost = weighed if settled else min(cost, self.cost or cost)
        self.longest = max(self.longest, len(block.items))
        return block.items, found

    def _broken(self, error: BaseException) -> Iterator[tuple[Sequence[T], Lost]]:
        """Take back what ran on an executor that broke: any of it may have been the cause."""
        blocks = list(self.running.values())
        self.running.clear()
        self.broke = True
        if not self.place.again:
            text = _("the workers were lost ({why}); what was done is kept: run it again to go on")
            raise MachineError(text.format(why=error))
        if len(blocks) == 1:
            yield from self._blamed(blocks[0], error)
        else:
            self.suspects.extend(blocks)

    def _blamed(
        self, block: _Block[T], error: BaseException | None
    ) -> Iterator[tuple[Sequence[T], Lost]]:
        """Try a block again that lost its worker: in halves, or whole; one item not for ever."""
        half = len(block.items) // 2
        if half:
            self.suspects.extend([_Block(block.items[:half]), _Block(block.items[half:])])
        elif block.losses + 1 < MOST_LOSSES:
            self.suspects.append(_Block(block.items, block.losses + 1))
        else:
            yield block.items, Lost(f"{type(error).__name__}: {error}")


class _Recording(SpawnContext):
    """A way to start processes that remembers them."""

    def __init__(self) -> None:
        super().__init__()
        self.started: list[Any] = []

    def Process(self, *args: Any, **named: Any) -> Any:  # type: ignore[override]
        """A new process."""
        self.started.append(Worker(*args, **named))
        return self.started[-1]


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Hold Ctrl-C back until the block ends, where the system has masks of signals.

    A process that is started within is deaf to it, and known to who kills it once the interrupt comes.
    Another thread may take the signal: Python then calls the handler here, which keeps it to the end.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    came: list[int] = []
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    handler = signal.getsignal(signal.SIGINT)
    handled = callable(handler) and threading.current_thread() is threading.main_thread()
    if handled:
        signal.signal(signal.SIGINT, lambda number, _frame: came.append(number))
    try:
        yield
    finally:
        if handled:
            signal.signal(signal.SIGINT, handler)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        if came:
            signal.raise_signal(signal.SIGINT)


class Worker(SpawnProcess):
    """A process that is deaf to Ctrl-C, which is for its parent, from before it begins."""

    def start(self) -> None:
        """Start it."""
        with interrupts_held():
            super().start()


@contextmanager
def _pool(count: int) -> Iterator[Executor]:
    """A pool of processes, which are killed when the block is left in haste.

    Its thread is waited for too: at Python 3.11's exit it would close a pipe that is just written to.
    """
    context = _Recording()
    executor = ProcessPoolExecutor(count, mp_context=context, initializer=begin_worker)
    try:
        yield executor
        executor.shutdown()
    finally:
        manager = getattr(executor, "_executor_manager_thread", None)  # there is no public name for it
        executor.shutdown(wait=False, cancel_futures=True)
        for process in context.started:
            if process.is_alive():
                process.kill()
        if manager is not None and manager.is_alive():
            manager.join(PATIENCE)


def begin_worker() -> None:
    """Leave Ctrl-C to the parent, and end when it ends, however it does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent.sentinel,), daemon=True).start()


def _follow(sentinel: int) -> None:
    wait_for([sentinel])
    os._exit(1)
