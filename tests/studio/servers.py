"""Studios for tests: served in a thread of this process, or as a process of their own."""

import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any

import httpx
import uvicorn

from benchdragon.studio import app as studio
from benchdragon.studio.limits import Settings

PLAN: dict[str, Any] = {
    "schema": 1,
    "dragon": {"benches": 40},
    "route": {"kind": "spiral-in", "start_turn": 12},
    "disc": {"radius": 4.5},
}
TURN: dict[str, Any] = {
    "schema": 1,
    "dragon": {"benches": 12},
    "route": {"kind": "turn"},
    "walk": {"start": -5},
    "limits": {"speed": 2.0},
}
# tomllib takes time in the square of the dots: seconds for these.
SLOW = "a." * 50_000 + "a = 1"


@dataclass
class Served:
    """A studio that is being served, and a client of it."""

    client: httpx.Client
    studio: studio.Studio
    base: str

    def ready(self) -> None:
        """Wait until all workers are ready."""
        wait_for(
            lambda: all(
                worker_queue.ready == worker_queue.count
                for worker_queue in self.studio.pool.queues.values()
            )
        )

    def open_slowly(self, **headers: str) -> tuple[threading.Thread, list[httpx.Response]]:
        """Ask a question that takes seconds, from a thread; the answer comes into the list."""
        return ask_slowly(self.base, headers)


def ask_slowly(
    base: str, headers: dict[str, str] | None = None, *, lost: bool = False
) -> tuple[threading.Thread, list[httpx.Response]]:
    """The same of any studio; `lost`: the connection may break."""
    found: list[httpx.Response] = []

    def ask() -> None:
        with suppress(*([httpx.TransportError] if lost else [])):
            url = f"{base}/api/plan"
            found.append(httpx.post(url, json={"toml": SLOW}, headers=headers, timeout=600))

    thread = threading.Thread(target=ask)
    thread.start()
    return thread, found


def wait_for(condition: Any) -> None:
    """Wait until it holds; tests that wait in vain end here, after minutes."""
    for _look in range(6000):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("waited in vain")


@contextmanager
def served(settings: Settings) -> Iterator[Served]:
    """A studio in a thread, its workers ready."""
    application = studio.app(settings)
    ours = studio.listener(settings)
    base = studio.address(settings, ours).rstrip("/")
    server = uvicorn.Server(uvicorn.Config(application, log_config=None, ws="none"))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [ours]})
    thread.start()
    wait_for(lambda: server.started)
    try:
        with httpx.Client(base_url=base, timeout=600) as client:
            found = Served(client, application.state.studio, base)
            found.ready()
            yield found
    finally:
        server.should_exit = True
        thread.join()


@contextmanager
def process(*arguments: str) -> Iterator[tuple["subprocess.Popen[str]", str]]:
    """`benchdragon studio` as a process of its own, and its address."""
    command = [sys.executable, "-m", "benchdragon", "studio", "--port", "0", "--no-browser"]
    environment = {**os.environ, "BENCHDRAGON_LANG": "en"}
    with subprocess.Popen(
        [*command, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
    ) as found:
        try:
            assert found.stdout is not None
            yield found, found.stdout.readline().split(" at ")[1].split(" ")[0].rstrip("/")
        finally:
            found.kill()


def children(parent: int) -> set[int]:
    """Processes whose parent is `parent`."""
    listed = subprocess.run(
        ["ps", "-A", "-o", "pid=", "-o", "ppid="], capture_output=True, text=True, check=True
    )
    rows = [[int(word) for word in line.split()] for line in listed.stdout.splitlines()]
    return {pid for pid, above in rows if above == parent}


def alive(pids: set[int]) -> set[int]:
    """Those of `pids` that still run; one that is dead and not yet collected does not."""
    listed = subprocess.run(
        ["ps", "-A", "-o", "pid=", "-o", "stat="], capture_output=True, text=True, check=True
    )
    rows = [line.split() for line in listed.stdout.splitlines()]
    return {int(pid) for pid, state in rows if int(pid) in pids and not state.startswith("Z")}
