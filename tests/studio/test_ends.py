"""How a studio ends: by a signal, while it starts, killed, or because its address is taken."""

import signal
import socket
import subprocess
import sys

import httpx

from tests.studio.posts import error
from tests.studio.servers import alive, ask_slowly, children, process, wait_for


def test_a_signal_ends_the_studio_and_tells_those_who_wait() -> None:
    with (
        process("--workers", "1") as (server, base),
        httpx.Client(base_url=base, timeout=600) as client,
    ):
        wait_for(lambda: client.get("/healthz").json()["workers"]["quick"]["ready"] == 1)
        workers = children(server.pid)
        assert workers
        asking, found = ask_slowly(base)
        wait_for(lambda: client.get("/healthz").json()["workers"]["quick"]["busy"] == 1)
        server.send_signal(signal.SIGTERM)
        asking.join()
        assert found[0].status_code == 503
        assert error(found[0]) == "the studio is closing"
        out, err = server.communicate()
        assert server.returncode == 0, err
        assert out == "The studio is closed.\n"
        assert err == ""
        wait_for(lambda: not alive(workers))


def test_ctrl_c_ends_a_studio_that_has_only_begun_to_start() -> None:
    with process("--workers", "2") as (server, _base):
        wait_for(lambda: children(server.pid))
        workers = children(server.pid)
        server.send_signal(signal.SIGINT)
        out, err = server.communicate()
        assert (server.returncode, out, err) == (0, "The studio is closed.\n", "")
        wait_for(lambda: not alive(workers))


def test_no_worker_outlives_a_studio_that_is_killed() -> None:
    with (
        process("--workers", "1") as (server, base),
        httpx.Client(base_url=base, timeout=600) as client,
    ):
        wait_for(lambda: client.get("/healthz").json()["workers"]["quick"]["ready"] == 1)
        asking, _found = ask_slowly(base, lost=True)
        wait_for(lambda: client.get("/healthz").json()["workers"]["quick"]["busy"] == 1)
        workers = children(server.pid)
        server.kill()
        server.wait()
        asking.join()
        wait_for(lambda: not alive(workers))


def test_an_address_that_is_taken_is_said_so() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        arguments = ["studio", "--no-browser", "--port", str(taken.getsockname()[1])]
        done = subprocess.run(
            [sys.executable, "-m", "benchdragon", *arguments, "--lang", "en"],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
    assert done.returncode == 2
    assert done.stderr.startswith("Error: cannot listen at 127.0.0.1, port ")
    assert done.stderr.count("\n") == 1
