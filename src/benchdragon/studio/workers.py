"""The studio's workers: processes that compute, a thread each that watches them, queues of questions.

A worker that is over its time or out of memory, or dies, is replaced; whoever asked gets a
`RefusedError`, a sentence. A worker ends by itself when the studio's end of its pipe is gone, however
that came about.
"""

import atexit
import logging
import multiprocessing
import os
import queue
import shutil
import signal
import tempfile
import threading
import time as clock
import traceback
import warnings
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, InvalidStateError
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path

from benchdragon.errors import BenchDragonError
from benchdragon.i18n import N_, _, spoken_in, use_language
from benchdragon.studio.limits import Settings
from benchdragon.studio.tasks import TASKS, TaskRequest, TaskResult, check_plan, warm

LOG = logging.getLogger(__name__)
# How often a supervisor looks whether a busy worker is to stop, and whether an idle one lives, s.
POLL, IDLE_POLL = 0.05, 1.0
# Progress is told at most so often, s.
TELL = 0.1
# Seconds until a client that was turned away may come again.
RETRY = 2

SUPERSEDED = N_("a newer question of yours took this one's place")
CROWDED = N_("too many questions are waiting: ask again in a moment")
WITHDRAWN = N_("the question was withdrawn")
CANCELLED = N_("cancelled")
STARTING = N_("the studio's workers are starting: ask again in a moment")
OVERDUE = N_("no answer within {seconds} s: ask for a smaller dance, or use the command line")
DIED = N_("the worker that computed the answer broke down, perhaps for lack of memory; it was replaced")
CLOSING = N_("the studio is closing")
BROKEN = N_("something is wrong with the studio itself; its log says what")
NO_WORKERS = N_("the studio's workers do not start; its log says why")
NO_MEMORY = N_(
    "the answer takes more memory than a question may have: ask for a smaller dance, or use the "
    "command line"
)
ARITHMETIC = N_("the numbers of this plan are too large, or too small, to be reckoned with")


class RefusedError(Exception):
    """No answer: an HTTP status, and a sentence in the asker's language."""

    def __init__(self, status: int, text: str, retry: int | None = None) -> None:
        self.status, self.text, self.retry = status, text, retry
        super().__init__(text)


@dataclass(eq=False)
class QueuedTask:
    """A question on its way.

    Attributes:
        request: what is asked.
        client: who asks, as far as they say.
        future: the answer, or a RefusedError.
        share: of the work, 0 to 1, as far as told.
        text: what is being done.
        running: whether a worker has it.
        abandoned: whether nobody waits for the answer any more.
        stop: why it is to be stopped, if it is.
    """

    request: TaskRequest
    client: str | None = None
    future: Future[TaskResult] = field(default_factory=Future)
    share: float = 0.0
    text: str = ""
    running: bool = False
    abandoned: bool = False
    stop: tuple[int, str] | None = None

    def refuse(self, status: int, text: str, retry: int | None = None, **values: object) -> None:
        """Answer with a sentence, in the asker's language, if there is no answer yet."""
        with spoken_in(self.request.language):
            refusal = RefusedError(status, _(text).format(**values), retry)
        with suppress(InvalidStateError):  # who asked may have gone
            self.future.set_exception(refusal)


# --- in the worker's process


def run_worker(connection: Connection, kind: str, settings: Settings, folder: str) -> None:
    """Answer what comes through the pipe, one after another, until it closes."""
    for name in (signal.SIGINT, signal.SIGTERM):  # they are for the studio, which ends its workers
        signal.signal(name, signal.SIG_IGN)
    tempfile.tempdir = folder
    warnings.simplefilter("ignore")
    inbox: queue.SimpleQueue[TaskRequest] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(connection, inbox, folder), daemon=True).start()
    warm(kind, settings)
    _bound_memory(settings.memory)
    connection.send(("ready", None, None))
    while True:
        outcome = _outcome(connection, inbox.get())
        connection.send(outcome)


def _listen(connection: Connection, inbox: "queue.SimpleQueue[TaskRequest]", folder: str) -> None:
    """Hand on what comes; when the studio is gone, go too, in the middle of whatever it is."""
    try:
        while True:
            inbox.put(connection.recv())
    except (EOFError, OSError):
        shutil.rmtree(folder, ignore_errors=True)
        os._exit(0)


def _bound_memory(more: int) -> None:
    """Let the process take so many bytes beyond what it has, where the system can see to that."""
    try:
        import resource  # not on every system

        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[5])
        _soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
        resource.setrlimit(resource.RLIMIT_DATA, (pages * resource.getpagesize() + more, hard))
    except (ImportError, ValueError, OSError):
        LOG.debug("memory of workers stays unbounded here")


def _outcome(connection: Connection, request: TaskRequest) -> tuple[str, object, object]:
    """("made", Made, None), ("refused" or "spent", status, sentence) or ("broken", traceback, None).

    What is "spent" is the process: of memory that ran out not all comes back.
    """
    use_language(request.language)
    last_told, last_text = 0.0, ""

    def progress(share: float, text: str) -> None:
        nonlocal last_told, last_text
        last_text = text or last_text
        if clock.monotonic() - last_told >= TELL:
            last_told = clock.monotonic()
            connection.send(("progress", share, last_text))

    try:
        if request.plan is not None:
            check_plan(request.plan, request.settings)
        return "made", TASKS[request.name](request, progress), None
    except BenchDragonError as error:
        return "refused", 422, str(error)
    except ArithmeticError:
        LOG.info("not reckoned with", exc_info=True)
        return "refused", 422, _(ARITHMETIC)
    except MemoryError:
        LOG.info("out of memory", exc_info=True)
        return "spent", 507, _(NO_MEMORY)
    except Exception:
        return "broken", traceback.format_exc(), None


# --- in the studio's process


@dataclass
class WorkerProcess:
    """A worker's process, and the studio's end of its pipe."""

    process: BaseProcess
    connection: Connection
    folder: str

    def end(self) -> None:
        """End it now, whatever it does; its temporary files go too."""
        self.process.kill()
        self.process.join()
        self.connection.close()
        shutil.rmtree(self.folder, ignore_errors=True)


def _slow(task: QueuedTask) -> bool:
    """Whether a quick question takes several times as long as a verdict."""
    return task.request.name.partition("/")[0] in {"limit", "dance"}


class WorkerQueue:
    """Questions of one kind that wait for the workers of that kind."""

    def __init__(
        self, name: str, count: int, room: int, settings: Settings, first: "StartOrder"
    ) -> None:
        self.name, self.count, self.room, self.settings = name, count, room, settings
        self.ready = 0
        self._start_order = first
        self._waiting: deque[QueuedTask] = deque()
        self._running: set[QueuedTask] = set()
        self._changed = threading.Condition()
        self._closing = False
        self._deaths = 0  # in a row, of workers that were not ready yet
        self._supervisors = [
            threading.Thread(target=self._supervise, name=f"{name} {n}", daemon=True)
            for n in range(count)
        ]

    def start(self) -> None:
        """Start the workers."""
        for supervisor in self._supervisors:
            supervisor.start()

    @property
    def waiting(self) -> int:
        """How many questions wait."""
        return len(self._waiting)

    @property
    def busy(self) -> int:
        """How many questions are being answered."""
        return len(self._running)

    @property
    def lost(self) -> bool:
        """Whether nobody is there to answer, and there is little hope."""
        return not self.ready and self._deaths >= self.settings.spawns

    @property
    def late(self) -> str:
        """Why a question has waited long."""
        return CROWDED if self.ready else STARTING

    def put(self, task: QueuedTask, *, newest: bool = True) -> None:
        """Have a question wait; `newest`: in the place of its client's older one of the same name.

        Raises:
            RefusedError: if too many wait, or there is nobody to answer.
        """
        with self._changed, spoken_in(task.request.language):
            if self._closing:
                raise RefusedError(503, _(CLOSING))
            if self.lost:
                raise RefusedError(503, _(NO_WORKERS), RETRY)
            for place, old in enumerate(self._waiting):
                if newest and _same(old, task):
                    self._waiting[place] = task  # not behind all others, each time anew
                    old.refuse(409, SUPERSEDED)
                    return
            if len(self._waiting) >= self.room:
                raise RefusedError(429, _(self.late), RETRY)
            self._waiting.append(task)
            self._changed.notify()

    def withdraw(self, task: QueuedTask, status: int = 409, text: str = WITHDRAWN) -> bool:
        """Take back a question that still waits; whether it did."""
        with self._changed:
            if task not in self._waiting:
                return False
            self._waiting.remove(task)
        task.refuse(status, text, RETRY)
        return True

    def abandon(self, task: QueuedTask) -> None:
        """Take back a question that nobody waits for; one that runs ends soon, or is stopped."""
        if not self.withdraw(task):
            task.abandoned = True

    def stop(self, task: QueuedTask, status: int, text: str) -> None:
        """Stop a question, waiting or running; the worker that has it is replaced."""
        if not self.withdraw(task, status, text):
            task.stop = status, text

    def retire(self) -> None:
        """Take no more questions, and tell those who wait."""
        with self._changed:
            self._closing = True
            self._changed.notify_all()
        self._dismiss(CLOSING)

    def _dismiss(self, text: str) -> None:
        """Tell all who wait that there will be no answer."""
        with self._changed:
            waiting = list(self._waiting)
            self._waiting.clear()
        for task in waiting:
            task.refuse(503, text, RETRY)

    def end(self) -> None:
        """End all workers of a queue that has retired; those whose questions run are told."""
        with self._changed:
            for task in self._running:
                task.stop = 503, CLOSING
        for supervisor in self._supervisors:
            supervisor.join()

    def _supervise(self) -> None:
        """Keep one worker at work."""
        while not self._closing:
            worker = self._spawned()
            if worker is not None:
                self._serve(worker)
            elif self.lost:
                self._dismiss(NO_WORKERS)
                with self._changed:
                    self._changed.wait_for(lambda: self._closing, self.settings.respawn_seconds)

    def _serve(self, worker: WorkerProcess) -> None:
        """Have a worker answer one question after another, as long as it can."""
        with self._changed:
            self.ready += 1
            self._deaths = 0
        try:
            while (task := self._next(worker)) is not None and self._fit(worker, task):
                pass
        finally:
            with self._changed:
                self.ready -= 1
            worker.end()

    def _next(self, worker: WorkerProcess) -> QueuedTask | None:
        """The next question, marked as running; None once the lane closes or the worker is dead."""
        with self._changed:
            while not self._closing and worker.process.is_alive():
                task = next(filter(self._may_run, self._waiting), None)
                if task is not None:
                    self._waiting.remove(task)
                    if not task.future.set_running_or_notify_cancel():
                        continue
                    task.running = True
                    self._running.add(task)
                    return task
                self._changed.wait(IDLE_POLL)
        return None

    def _may_run(self, task: QueuedTask) -> bool:
        """Whether a question may run now: one of a name a client, and long ones leave a worker free."""
        if any(_same(old, task) for old in self._running):
            return False
        return not _slow(task) or sum(map(_slow, self._running)) < max(self.count - 1, 1)

    def _fit(self, worker: WorkerProcess, task: QueuedTask) -> bool:
        """Have a worker answer; whether it can go on to the next question."""
        try:
            return self._answered(worker, task)
        except (EOFError, OSError):
            LOG.warning("a worker died over %s", task.request.name)
            task.refuse(503, DIED, RETRY)
        except Exception:  # whatever came through the pipe, somebody must mind the next worker
            LOG.exception("the answer to %s cannot be read", task.request.name)
            task.refuse(500, BROKEN)
        finally:
            with self._changed:
                self._running.discard(task)
                self._changed.notify_all()  # what waited for this one to end may run now
        return False

    def _answered(self, worker: WorkerProcess, task: QueuedTask) -> bool:
        seconds = self.settings.time_limit(task.request.name)
        began = clock.monotonic()
        until = began + seconds
        worker.connection.send(task.request)
        while True:
            if task.stop is not None:
                task.refuse(*task.stop)
                return False
            if task.abandoned and clock.monotonic() > began + self.settings.abandoned_seconds:
                task.refuse(409, WITHDRAWN, RETRY)
                return False
            if clock.monotonic() > until:
                task.refuse(504, OVERDUE, seconds=f"{seconds:g}")
                return False
            if not worker.connection.poll(POLL):
                continue
            kind, one, two = worker.connection.recv()
            if kind == "progress":
                task.share, task.text = one, two
            elif kind == "made":
                task.future.set_result(one)
                return True
            elif kind in {"refused", "spent"}:
                task.future.set_exception(RefusedError(one, two))
                return bool(kind == "refused")
            else:
                LOG.error("%s failed:\n%s", task.request.name, one)
                task.refuse(500, BROKEN)
                return True

    def _spawned(self) -> WorkerProcess | None:
        """A worker that is ready; None if the lane closes, or it died before."""
        worker: WorkerProcess | None = None
        with self._start_order.turn():
            try:
                while not self._closing:
                    worker = worker or self._started()
                    if worker.connection.poll(POLL):
                        worker.connection.recv()
                        self._start_order.done()
                        return worker
            except Exception:  # no memory, no process, a script without a guard ...
                LOG.exception("a worker of the lane %s died before it was ready", self.name)
                with self._changed:
                    self._deaths += 1
            if worker is not None:
                worker.end()
        return None

    def _started(self) -> WorkerProcess:
        context = multiprocessing.get_context("spawn")
        ours, theirs = context.Pipe()
        folder = tempfile.mkdtemp(prefix="benchdragon-studio-")
        process = context.Process(
            target=run_worker,
            args=(theirs, self.name, self.settings, folder),
            daemon=True,
            name=f"benchdragon {self.name}",
        )
        try:
            process.start()
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        theirs.close()
        return WorkerProcess(process, ours, folder)


def _same(old: QueuedTask, new: QueuedTask) -> bool:
    return old.client is not None and (old.client, old.request.name) == (new.client, new.request.name)


class StartOrder:
    """Lets one worker compile the kernels, and the others start once they can load them."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._warm = threading.Event()

    @contextmanager
    def turn(self) -> Iterator[None]:
        """Where a worker may start: one by one until the first is ready, then any."""
        while not self._warm.is_set():
            if self._lock.acquire(timeout=POLL):
                try:
                    if not self._warm.is_set():
                        yield
                        return
                finally:
                    self._lock.release()
        yield

    def done(self) -> None:
        """A worker is ready."""
        self._warm.set()


class Pool:
    """All lanes of a studio: quick answers, files, long questions."""

    def __init__(self, settings: Settings) -> None:
        first = StartOrder()
        self.settings = settings
        self.queues = {
            "quick": WorkerQueue("quick", settings.workers, settings.queue, settings, first),
            "files": WorkerQueue("files", 1, settings.queue, settings, first),
            "jobs": WorkerQueue("jobs", 1, settings.jobs, settings, first),
        }

    def start(self) -> None:
        """Start all workers; none outlives this process, however it ends."""
        atexit.register(self.close, 0.0)
        for worker_queue in self.queues.values():
            worker_queue.start()

    def worker_queue(self, name: str) -> WorkerQueue:
        """The lane for a question of that name."""
        kind = name.partition("/")[0]
        return self.queues[{"export": "files", "job": "jobs"}.get(kind, "quick")]

    def close(self, grace: float | None = None) -> None:
        """End all workers, running questions after `grace` seconds; those who wait are told."""
        until = clock.monotonic() + (self.settings.grace if grace is None else grace)
        for worker_queue in self.queues.values():
            worker_queue.retire()
        while (
            any(worker_queue.busy for worker_queue in self.queues.values())
            and clock.monotonic() < until
        ):
            clock.sleep(POLL)
        for worker_queue in self.queues.values():
            worker_queue.end()
        atexit.unregister(self.close)
