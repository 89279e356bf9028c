"""Lanes of questions and their workers: who may run, and who takes a dead one's place."""

import itertools
import math
import multiprocessing
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

import httpx
import pytest

from benchdragon.plans.schema import Plan
from benchdragon.studio import workers as studio_workers
from benchdragon.studio.limits import Settings
from benchdragon.studio.tasks import TASKS, TaskRequest, TaskResult
from benchdragon.studio.workers import (
    QueuedTask,
    RefusedError,
    StartOrder,
    WorkerProcess,
    WorkerQueue,
    _outcome,
)
from tests.studio.servers import PLAN, Served, served, wait_for

pytestmark = pytest.mark.xdist_group("studio")
# Seconds in which what is certain to come has come; only a test that fails waits so long.
SOON = 20.0
ANSWER = ("made", TaskResult(b"{}"), None)


def asked(name: str, client: str | None) -> QueuedTask:
    return QueuedTask(TaskRequest(name, "en", Settings(), Plan.model_validate(PLAN)), client)


@pytest.fixture
def worker_queue() -> WorkerQueue:
    """A lane of two workers that were not started."""
    settings = Settings(abandoned_seconds=0.0)
    return WorkerQueue("quick", 2, 8, settings, StartOrder())


class Hand:
    """Stands for a worker's process: the test answers at its end of the pipe."""

    def __init__(self) -> None:
        self.ours, self.theirs = multiprocessing.Pipe()
        self.theirs.send(("ready", None, None))
        self.alive = True

    def is_alive(self) -> bool:
        return self.alive

    def kill(self) -> None:
        self.alive = False

    def join(self) -> None:
        """Nothing runs."""


class Hands:
    """A lane whose workers are the test's own hands.

    Attributes:
        made: the workers so far.
        failure: what starting a worker comes to.
        failure_after: so many that started.
        stillborn: so many of the first die before they are ready.
    """

    def __init__(self, patch: pytest.MonkeyPatch, **settings: Any) -> None:
        self.made: list[Hand] = []
        self.failure: Exception | None = None
        self.failure_after: float = math.inf
        self.stillborn = 0
        patch.setattr(studio_workers, "IDLE_POLL", 3600.0)  # who is not told sleeps on
        patch.setattr(WorkerQueue, "_started", lambda _lane: self._started())
        self.worker_queue = WorkerQueue(
            "quick", settings.pop("workers", 1), 8, Settings(**settings), StartOrder()
        )

    def _started(self) -> WorkerProcess:
        if self.failure or len(self.made) >= self.failure_after:
            raise self.failure or OSError("no process")
        hand = Hand()
        self.made.append(hand)
        if len(self.made) <= self.stillborn:
            hand.ours.recv()
            hand.theirs.close()
        process: Any = hand
        return WorkerProcess(process, hand.ours, "")

    def put(self, name: str, client: str | None = None) -> QueuedTask:
        task = asked(name, client)
        self.worker_queue.put(task)
        return task

    def start(self, workers: int = 1) -> None:
        self.worker_queue.start()
        wait_for(lambda: self.worker_queue.ready == workers)

    def who_has(self, task: QueuedTask) -> Connection:
        """The end of the pipe of the worker that was given a question."""
        wait_for(lambda: task.running)
        wait_for(self._given)
        found = self._given()[0]
        assert found.recv() == task.request
        return found

    def _given(self) -> list[Connection]:
        """Ends of pipes that a question waits in."""
        return [hand.theirs for hand in self.made if hand.alive and hand.theirs.poll()]


@pytest.fixture
def hands(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Makes lanes whose workers are the test's own hands."""
    made: list[Hands] = []

    def make(**settings: Any) -> Hands:
        made.append(Hands(monkeypatch, **settings))
        return made[-1]

    yield make
    for one in made:
        one.worker_queue.retire()
        one.worker_queue.end()


Make = Callable[..., Hands]


# --- who may run


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is bounded on Linux alone")
def test_a_worker_gets_no_more_memory_than_it_may_have() -> None:
    lines = [
        "import numpy as np",
        "from benchdragon.studio.workers import _bound_memory",
        "_bound_memory(100_000_000)",
        "print(np.ones(5_000_000).sum())",
        "np.ones(50_000_000)",
    ]
    done = subprocess.run(
        [sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True, check=False
    )
    assert done.stdout == "5000000.0\n"
    assert "MemoryError" in done.stderr


def test_a_newer_question_takes_the_place_of_the_older_and_does_not_queue_again() -> None:
    worker_queue = WorkerQueue("quick", 1, 2, Settings(), StartOrder())
    names = (("verdict", "a"), ("verdict", "b"), ("verdict", "a"), ("dance", "a"))
    works = [asked(name, client) for name, client in names]
    for task in works[:3]:
        worker_queue.put(task)
    assert list(worker_queue._waiting) == [works[2], works[1]]
    with pytest.raises(RefusedError, match="a newer question"):
        works[0].future.result()
    with pytest.raises(RefusedError, match="workers are starting"):
        worker_queue.put(works[3])
    worker_queue.ready = 1
    with pytest.raises(RefusedError, match="too many"):
        worker_queue.put(works[3])


def test_a_lane_whose_workers_never_start_says_so(caplog: pytest.LogCaptureFixture) -> None:
    worker_queue = WorkerQueue("no such lane", 1, 8, Settings(spawns=1), StartOrder())
    task = asked("verdict", None)
    worker_queue.put(task)
    worker_queue.start()
    with pytest.raises(RefusedError, match="workers do not start"):
        task.future.result()
    with pytest.raises(RefusedError, match="workers do not start"):
        worker_queue.put(asked("verdict", None))
    worker_queue.retire()
    worker_queue.end()
    assert caplog.text.count("died before it was ready") == 1


def test_numbers_beyond_reckoning_are_said_to_be_so() -> None:
    assert outcome(OverflowError())[:2] == ("refused", 422)
    assert outcome(KeyError())[0] == "broken"


def test_a_process_that_ran_out_of_memory_is_spent_and_says_nothing_of_the_plan() -> None:
    kind, status, text = outcome(MemoryError())
    assert (kind, status) == ("spent", 507)
    assert text.startswith("the answer takes more memory than a question may have")


def outcome(failure: Exception) -> tuple[str, Any, Any]:
    """What a worker sends where a task fails."""

    def fail(request: TaskRequest, advance: Any) -> TaskResult:
        raise failure

    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(TASKS, "fail", fail)
        ours, theirs = multiprocessing.Pipe()
        with ours, theirs:
            return _outcome(theirs, TaskRequest("fail", "en", Settings()))


def test_what_runs_on_for_nobody_is_stopped(worker_queue: WorkerQueue) -> None:
    ours, theirs = multiprocessing.Pipe()
    worker = WorkerProcess(multiprocessing.Process(), ours, "")
    task = asked("verdict", None)
    worker_queue.abandon(task)
    assert not worker_queue._answered(worker, task)
    assert theirs.recv() == task.request
    with pytest.raises(RefusedError, match="withdrawn") as refused:
        task.future.result(0)
    assert refused.value.status == 409


def test_a_client_runs_one_question_of_a_name_and_long_ones_leave_a_worker_free(
    worker_queue: WorkerQueue,
) -> None:
    worker_queue._running.add(asked("verdict", "a"))
    assert not worker_queue._may_run(asked("verdict", "a"))
    assert worker_queue._may_run(asked("verdict", "b"))
    assert worker_queue._may_run(asked("verdict", None))
    assert worker_queue._may_run(asked("dance", "a"))
    worker_queue._running.add(asked("dance", "a"))
    assert not worker_queue._may_run(asked("limit/pitch", "b"))


def test_what_is_withdrawn_while_it_waits_takes_no_place() -> None:
    worker_queue = WorkerQueue("quick", 1, 1, Settings(), StartOrder())
    withdrawn, next_one = asked("verdict", "a"), asked("verdict", "b")
    worker_queue.put(withdrawn)
    assert worker_queue.withdraw(withdrawn)
    worker_queue.put(next_one)
    assert list(worker_queue._waiting) == [next_one]
    with pytest.raises(RefusedError, match="withdrawn"):
        withdrawn.future.result(0)
    assert not worker_queue.withdraw(withdrawn)


# --- who takes a dead one's place

# How a question may end that takes its worker along, and what is said of it.
ENDINGS: dict[str, tuple[Callable[[WorkerQueue, QueuedTask, Connection], Any], int]] = {
    "the worker died": (lambda _lane, _work, worker: worker.close(), 503),
    "what it sent is nonsense": (lambda _lane, _work, worker: worker.send("nonsense"), 500),
    "its memory ran out": (lambda _lane, _work, worker: worker.send(("spent", 507, "no memory")), 507),
    "it was cancelled": (
        lambda worker_queue, task, _worker: worker_queue.stop(task, 410, "cancelled"),
        410,
    ),
    "its client is gone": (lambda worker_queue, task, _worker: worker_queue.abandon(task), 409),
}


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_worker_that_is_lost_over_a_question_leaves_its_place_to_another(
    hands: Make, ending: str
) -> None:
    lost = hands(abandoned_seconds=0.0)
    lost.start()
    end, status = ENDINGS[ending]
    for number in range(1, 4):  # a place that leaks is missed by the next
        task = lost.put("limit/pitch", "a")
        end(lost.worker_queue, task, lost.who_has(task))
        with pytest.raises(RefusedError) as refused:
            task.future.result(SOON)
        assert refused.value.status == status
        wait_for(lambda number=number: len(lost.made) == number + 1 and lost.worker_queue.ready == 1)
        assert lost.worker_queue.busy == 0
        assert not lost.made[number - 1].alive
    last = lost.put("limit/pitch", "a")
    lost.who_has(last).send(ANSWER)
    assert last.future.result(SOON) == ANSWER[1]


@pytest.mark.parametrize(
    ("sent", "status"), [(("refused", 422, "too long"), 422), (("broken", "traceback", None), 500)]
)
def test_a_worker_that_refused_or_failed_over_a_question_goes_on(
    hands: Make, sent: Any, status: int
) -> None:
    one = hands()
    one.start()
    task = one.put("verdict")
    worker = one.who_has(task)
    worker.send(sent)
    with pytest.raises(RefusedError) as refused:
        task.future.result(SOON)
    assert refused.value.status == status
    again = one.put("verdict")
    assert worker.poll(SOON)
    assert worker.recv() == again.request
    worker.send(ANSWER)
    assert again.future.result(SOON) == ANSWER[1]


def test_a_question_cancelled_by_who_waits_costs_no_worker(hands: Make) -> None:
    one = hands()
    one.start()
    first = one.put("verdict")
    worker = one.who_has(first)
    cancelled, last = one.put("limit/pitch"), one.put("verdict")
    assert cancelled.future.cancel()
    worker.send(ANSWER)
    assert worker.poll(SOON)
    assert worker.recv() == last.request
    worker.send(ANSWER)
    assert last.future.result(SOON) == ANSWER[1]


def test_a_worker_that_dies_before_it_is_ready_is_ended_and_lets_others_start(hands: Make) -> None:
    few = hands(workers=2)
    few.stillborn = 1
    few.start(workers=2)
    assert [hand.alive for hand in few.made] == [False, True, True]


def test_a_start_that_fails_leaves_the_turn_to_the_next() -> None:
    first = StartOrder()
    with pytest.raises(OSError, match="no process"), first.turn():
        raise OSError("no process")
    assert not first._lock.locked()


def test_a_question_over_its_time_takes_its_worker_along(hands: Make) -> None:
    short = hands(seconds=(("verdict", 0.0), ("dance", 60.0)))
    short.start()
    with pytest.raises(RefusedError, match="no answer within 0 s"):
        short.put("verdict", "a").future.result(SOON)
    dance = short.put("dance", "a")
    short.who_has(dance).send(ANSWER)
    assert dance.future.result(SOON) == ANSWER[1]


def test_what_waited_for_a_place_has_it_as_soon_as_it_is_free(hands: Make) -> None:
    """Of two workers one may have a slow question; when it dies and nobody comes, the other goes on."""
    two = hands(workers=2)
    two.start(workers=2)
    limit, dance = two.put("limit/pitch", "a"), two.put("dance", "b")
    worker = two.who_has(limit)
    assert not dance.running
    two.failure = OSError("no memory")
    worker.close()
    two.who_has(dance).send(ANSWER)
    assert dance.future.result(SOON) == ANSWER[1]


def test_who_runs_is_changed_only_where_nobody_reads_it(hands: Make) -> None:
    """A set that changes while another worker's thread looks through it ends that thread."""
    one = hands()

    class Watched(set[QueuedTask]):
        def discard(self, task: object) -> None:
            assert one.worker_queue._changed._is_owned()  # type: ignore[attr-defined]
            super().discard(task)

    one.worker_queue._running = Watched()
    one.start()
    for _again in range(2):
        task = one.put("verdict")
        one.who_has(task).send(ANSWER)
        assert task.future.result(SOON) == ANSWER[1]


def test_a_lane_that_lost_all_its_workers_has_some_again_as_soon_as_they_start(hands: Make) -> None:
    lost = hands(spawns=2, respawn_seconds=0.01)
    lost.start()
    task = lost.put("verdict")
    lost.failure = OSError("no memory")
    lost.who_has(task).close()
    wait_for(lambda: lost.worker_queue.lost)
    with pytest.raises(RefusedError, match="workers do not start") as refused:
        lost.put("verdict")
    assert (refused.value.status, refused.value.retry) == (503, 2)
    lost.failure = None
    wait_for(lambda: lost.worker_queue.ready == 1)
    assert not lost.worker_queue.lost
    assert lost.worker_queue._deaths == 0  # else the next death would be one too many
    again = lost.put("verdict")
    lost.who_has(again).send(ANSWER)
    assert again.future.result(SOON) == ANSWER[1]


def test_a_worker_that_is_left_answers_while_others_do_not_start(hands: Make) -> None:
    left = hands(workers=2, spawns=2, respawn_seconds=3600.0)
    left.failure_after = 1
    left.start()
    wait_for(lambda: left.worker_queue._deaths >= 2)
    task = left.put("verdict")
    left.who_has(task).send(ANSWER)
    assert task.future.result(SOON) == ANSWER[1]


# --- with true processes


@pytest.fixture(scope="module")
def others() -> set[BaseProcess]:
    """Processes of other studios."""
    return set(multiprocessing.active_children())


@pytest.fixture(scope="module")
def poor(others: set[BaseProcess]) -> Iterator[Served]:
    """A studio whose questions get little memory, and whose workers are soon given up."""
    settings = Settings(
        port=0, workers=1, memory=20_000_000, spawns=1, respawn_seconds=0.05, wait_seconds=60.0
    )
    with served(settings) as found:
        yield found


OTHER = itertools.count(4)


def verdict(studio: Served, **tables: Any) -> httpx.Response:
    """A verdict on a dance of its own, which is not among the answers kept."""
    plan = {**PLAN, "dragon": {"benches": next(OTHER)}, **tables}
    return studio.client.post("/api/verdict", params={"lang": "en"}, json={"plan": plan})


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is bounded on Linux alone")
def test_memory_that_ran_out_is_no_verdict_and_costs_the_next_question_nothing(poor: Served) -> None:
    for _again in range(2):
        large = verdict(poor, dragon={"benches": 3500}, route={"kind": "spiral-in", "start_turn": 60})
        assert large.status_code == 507
        assert large.json()["error"].startswith("the answer takes more memory")
        assert verdict(poor).json()["safe"]


def test_workers_that_are_killed_busy_idle_and_before_they_are_ready_come_back(
    poor: Served, others: set[BaseProcess]
) -> None:
    worker_queue = poor.studio.pool.queues["quick"]

    def workers() -> Iterator[BaseProcess]:
        for worker in set(multiprocessing.active_children()) - others:
            if worker.name.startswith("benchdragon quick"):
                yield worker

    def kill() -> bool:
        for worker in workers():
            worker.kill()
        return worker_queue.lost

    for worker in workers():  # it would end by itself, out of memory, before it is killed or after
        assert worker.pid
        os.kill(worker.pid, signal.SIGSTOP)
    slow, found = poor.open_slowly()
    wait_for(lambda: worker_queue.busy == 1)
    kill()
    slow.join()
    assert found[0].status_code == 503
    assert "broke down" in found[0].json()["error"]
    wait_for(kill)
    assert verdict(poor).json()["error"] == "the studio's workers do not start; its log says why"
    wait_for(lambda: worker_queue.ready == 1)
    assert verdict(poor).json()["safe"]
    kill()
    assert verdict(poor).status_code in {200, 503}
    wait_for(lambda: verdict(poor).status_code == 200)
