"""The studio's long questions: taken on, looked after by an unguessable name, cancelled, forgotten."""

import json
import secrets
import time as clock
from dataclasses import dataclass
from typing import Any

from benchdragon.i18n import N_, _
from benchdragon.plans.schema import Plan
from benchdragon.studio import messages
from benchdragon.studio.limits import Settings
from benchdragon.studio.workers import BROKEN, CANCELLED, RETRY, QueuedTask, RefusedError, WorkerQueue

CANCELLED_STATUS = 410


@dataclass
class Job:
    """A long question: its name, its task, and when it was first seen to have ended, s."""

    id: str
    question: messages.Question
    task: QueuedTask
    ended: float | None = None

    @property
    def plan(self) -> Plan:
        """What is asked about."""
        return self.task.request.whole

    @property
    def state(self) -> dict[str, Any]:
        """A `messages.JobState` as plain data."""
        about: dict[str, Any] = {"id": self.id, "question": self.question, "text": self.task.text}
        about |= {"plan_sha256": self.plan.sha256}
        about |= {"state": "waiting", "share": self.task.share, "result": None, "error": None}
        if self.task.running:
            about["state"] = "running"
        if not self.task.future.done():
            return about
        error = self.task.future.exception()
        if error is None:
            result = json.loads(self.task.future.result().data)
            return {**about, "state": "done", "share": 1.0, "text": "", "result": result}
        cancelled = isinstance(error, RefusedError) and error.status == CANCELLED_STATUS
        text = error.text if isinstance(error, RefusedError) else _(BROKEN)
        return {**about, "state": "cancelled" if cancelled else "failed", "text": "", "error": text}


class Jobs:
    """All long questions that are not yet forgotten, oldest first."""

    def __init__(self, worker_queue: WorkerQueue, settings: Settings) -> None:
        self._queue, self._settings = worker_queue, settings
        self._jobs: dict[str, Job] = {}

    def start(self, question: messages.Question, task: QueuedTask) -> str:
        """Take a question on; its name.

        Raises:
            RefusedError: if too many wait, or this client has too many.
        """
        self._forget()
        mine = [job for job in self._jobs.values() if job.task.client == task.client]
        if sum(not job.task.future.done() for job in mine) >= self._settings.jobs_each:
            text = _("you have {count} long questions open: wait for one, or cancel it")
            raise RefusedError(429, text.format(count=self._settings.jobs_each), RETRY)
        self._queue.put(task, newest=False)
        job = Job(secrets.token_urlsafe(16), question, task)
        self._jobs[job.id] = job
        return job.id

    def of(self, client: str | None) -> list[Job]:
        """The questions of a client that says its name."""
        self._forget()
        return [job for job in self._jobs.values() if client and job.task.client == client]

    def found(self, name: str) -> Job:
        """The question of that name.

        Raises:
            RefusedError: if there is none, or none any more.
        """
        self._forget()
        if name not in self._jobs:
            raise RefusedError(404, _(UNKNOWN))
        return self._jobs[name]

    def cancel(self, name: str) -> Job:
        """Cancel a question, waiting or running; forget one that has ended."""
        job = self.found(name)
        if job.task.future.done():
            del self._jobs[name]
        else:
            self._queue.stop(job.task, CANCELLED_STATUS, CANCELLED)
        return job

    def _forget(self) -> None:
        """Forget what ended long ago, and the oldest that ended if they are many."""
        now = clock.monotonic()
        ended = []
        for job in self._jobs.values():
            if job.task.future.done():
                job.ended = now if job.ended is None else job.ended
                ended.append(job)
        many = max(len(ended) - self._settings.kept_jobs, 0)
        for n, job in enumerate(ended):
            if n < many or now - (job.ended or now) > self._settings.kept_seconds:
                del self._jobs[job.id]


UNKNOWN = N_("there is no such question, or it ended a while ago")
