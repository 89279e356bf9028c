"""Firefox by WebDriver BiDi (w3c.github.io/webdriver-bidi): as little of it as a story needs."""

import asyncio
import json
import re
import shutil
import subprocess
from collections.abc import Callable, Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path
from typing import Any

from tornado.websocket import WebSocketClientConnection, websocket_connect

from tests.browser.pages import HANGING

NAMES = ("firefox-esr", "firefox")
# A proxy that is not there keeps it from reaching other machines.
SETTINGS = {
    "network.proxy.type": 1,
    "network.proxy.http": "127.0.0.1",
    "network.proxy.http_port": 9,
    "network.proxy.ssl": "127.0.0.1",
    "network.proxy.ssl_port": 9,
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
}
# Seconds in which the end of a connection is heard, if at all.
GOING = 5.0
Run = Callable[[Coroutine[Any, Any, Any]], Any]
LISTENS = re.compile(r"WebDriver BiDi listening on (ws://127\.0\.0\.1:\d+)")


def firefox_path() -> str | None:
    """Where Firefox is on this machine, if it is."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Firefox:
    """One page in Firefox, and what its console said of errors.

    Attributes:
        faults: errors on the console, and uncaught ones.
    """

    def __init__(self, run: Run, socket: WebSocketClientConnection) -> None:
        self.faults: list[str] = []
        self._run, self._socket, self._numbers = run, socket, count(1)
        self._send("session.new", capabilities={})
        self._send("session.subscribe", events=["log.entryAdded"])
        # A page of its own: under load the first one is still on its way, and takes no other for long.
        self._page = self._send("browsingContext.create", type="tab")["context"]

    def open(self, address: str) -> None:
        """Go to an address, and wait for it to be loaded."""
        self._send("browsingContext.navigate", context=self._page, url=address, wait="complete")

    def evaluate(self, expression: str) -> Any:
        """What an expression, or a promise, comes to: text, a number, true or false.

        Raises:
            RuntimeError: if it throws.
        """
        target = {"context": self._page}
        found = self._send("script.evaluate", expression=expression, target=target, awaitPromise=True)
        if found["type"] == "exception":
            raise RuntimeError(found["exceptionDetails"]["text"])
        return found["result"].get("value")

    def until(self, expression: str) -> None:
        """Wait until an expression is true.

        Raises:
            RuntimeError: if it stays false for as long as only a page that hangs takes.
        """
        self.evaluate(
            f"""new Promise((done, failed) => {{
              const end = Date.now() + {HANGING};
              const look = () => ({expression}) ? done()
                : Date.now() > end ? failed(new Error("it stays false")) : setTimeout(look, 20);
              look();
            }})"""
        )

    def _send(self, method: str, **params: Any) -> dict[str, Any]:
        answer = asyncio.wait_for(self._answered(method, params), 2e-3 * HANGING)
        try:
            found: dict[str, Any] = self._run(answer)
        except TimeoutError:
            raise RuntimeError(f"Firefox does not answer: {method}") from None
        return found

    async def _answered(self, method: str, params: dict[str, Any]) -> dict[str, Any]:
        """The answer to a command; what is told meanwhile is kept."""
        number = next(self._numbers)
        await self._socket.write_message(json.dumps({"id": number, "method": method, "params": params}))
        while True:
            told = await self._socket.read_message()
            if told is None:
                raise RuntimeError(f"Firefox is gone: {method}")
            message = json.loads(told)
            if message.get("method") == "log.entryAdded" and message["params"]["level"] == "error":
                self.faults.append(message["params"]["text"])
            if message.get("id") != number:
                continue
            if message["type"] == "error":
                raise RuntimeError(f"{method}: {message['message']}")
            result: dict[str, Any] = message["result"]
            return result


@contextmanager
def firefox(path: str, profile: Path) -> Iterator[Firefox]:
    """Firefox without a window, with a profile of its own."""
    profile.mkdir()
    lines = (f'user_pref("{name}", {json.dumps(value)});\n' for name, value in SETTINGS.items())
    (profile / "user.js").write_text("".join(lines), "utf-8")
    command = [
        path,
        "--headless",
        "--no-remote",
        "--profile",
        str(profile),
        "--remote-debugging-port=0",
    ]
    with subprocess.Popen(
        [*command, "about:blank"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stderr is not None
        try:
            listens = next(filter(None, map(LISTENS.search, process.stderr)))
            with _loop() as run:
                socket = run(_connected(f"{listens[1]}/session"))
                try:
                    yield Firefox(run, socket)
                finally:
                    run(_closed(socket))
        finally:
            process.kill()


@contextmanager
def _loop() -> Iterator[Run]:
    """What runs coroutines, in a thread of its own: Playwright has a loop in this one."""
    with ThreadPoolExecutor(1) as thread:
        loop = thread.submit(asyncio.Runner).result()
        yield lambda asked: thread.submit(loop.run, asked).result()
        thread.submit(loop.close).result()


async def _connected(address: str) -> WebSocketClientConnection:
    return await websocket_connect(address)


async def _closed(socket: WebSocketClientConnection) -> None:
    """Close a connection, and hear the last of it; from a Firefox that is gone nothing comes."""
    socket.close()
    with suppress(TimeoutError):
        async with asyncio.timeout(GOING):
            while await socket.read_message() is not None:
                pass
