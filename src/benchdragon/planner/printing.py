"""Papers of a page as PDF files, printed by a browser that is installed.

A browser is asked by messages in JSON over a socket of this machine (RFC 6455): Chromium and its kin by
the DevTools protocol, Firefox by WebDriver BiDi. It has a profile of its own, which goes with it.
"""

import base64
import json
import os
import re
import shutil
import socket
import subprocess
import time
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import closing, contextmanager
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchdragon.errors import InputError, MachineError
from benchdragon.files import whole_file
from benchdragon.i18n import _
from benchdragon.parallel import interrupts_held
from benchdragon.progress import Progress, part

CHROMIUMS = (
    "chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable",
    "microsoft-edge", "msedge", "chrome",
)  # fmt: skip
FIREFOXES = ("firefox", "firefox-esr")
# Where browsers are that are on no path: those of Windows and macOS.
PLACES = (
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
)
# A browser that only prints a file has nothing to do with the network.
QUIET = (
    "--headless", "--disable-gpu", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--host-resolver-rules=MAP * ~NOTFOUND",
)  # fmt: skip
LISTENS = re.compile(rb"listening on ws://[^:/\s]+:(\d+)(\S*)")
# How often, s, a page is asked how far it is; in what time a browser and its page begin, and answer.
EACH, BEGINNING, ANSWERING = 0.1, 60.0, 600.0
# How far papers are, as `Sheets` of web/sheets.js says it; and what leaves those of one name alone.
STATE = "JSON.stringify(globalThis.benchdragon?.sheets.state ?? null)"
ALONE = """for (const one of document.querySelectorAll("#sheets .kind"))
    one.hidden = one.dataset.paper !== {}"""
# A page of A4, cm, where it does not say its size itself.
A4 = {"width": 21.0, "height": 29.7}


class BrowserError(MachineError):
    """A browser that is not there, or does not do what it was asked for."""


def find_browser() -> str | None:
    """A browser of this machine that can print; None without one."""
    named = map(shutil.which, (*CHROMIUMS, *FIREFOXES))
    return next(filter(None, named), None) or next(filter(os.path.exists, PLACES), None)


def found_browser(page: Path) -> str:
    """The same, or BrowserError, which says how to print a page without."""
    found = find_browser()
    if found is None:
        text = _(
            "No browser was found that prints files: install Chromium, Chrome, Edge or Firefox; or "
            "open {page} in any browser, on a phone too, and print it there: the papers are the same."
        )
        raise BrowserError(text.format(page=page))
    return found


def print_papers(browser: str, page: Path, files: Mapping[str, Path], progress: Progress) -> None:
    """Print papers, by their names, each into a file, whole or not at all.

    Args:
        browser: the program.
        page: shows these papers as it opens.
        files: to be written, in this order.
        progress: hears how far it is.

    Raises:
        InputError: where the page makes no papers of its plan, with what it says.
        BrowserError: where the browser fails.
    """
    with _opened(browser, page.resolve().as_uri()) as shown:
        _until_made(shown, part(progress, 0.0, 0.8))
        for n, (name, path) in enumerate(files.items()):
            progress(0.8 + 0.2 * n / len(files), _("printing {file}").format(file=path.name))
            shown.evaluate(ALONE.format(json.dumps(name)))
            data = shown.pdf()
            with whole_file(path) as temporary:
                temporary.write_bytes(data)
    progress(1.0, "")


def _until_made(shown: "_Page", progress: Progress) -> None:
    """Wait until a page has made its papers."""
    begun, share = time.monotonic(), 0.0
    while (state := json.loads(shown.evaluate(STATE))) is None or state["busy"]:
        if state is not None:
            share = max(share, state["share"])  # each step of a page begins again at 0
            progress(share, state["text"])
        elif time.monotonic() - begun > BEGINNING:
            raise BrowserError(_("{browser} does not show the page").format(browser=shown.browser))
        time.sleep(EACH)
    if state["text"]:
        raise InputError(state["text"])


class _Wire:
    """Messages to a browser and back, as text frames of a WebSocket."""

    def __init__(self, port: int, path: str) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), ANSWERING)
        key = base64.b64encode(os.urandom(16)).decode()
        lines = (
            f"GET {path} HTTP/1.1", f"Host: 127.0.0.1:{port}", "Upgrade: websocket",
            "Connection: Upgrade", f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13", "", "",
        )  # fmt: skip
        self._socket.sendall("\r\n".join(lines).encode())
        self._file = self._socket.makefile("rb")
        if b" 101 " not in self._file.readline():
            raise ConnectionError
        while self._file.readline().strip():
            pass

    def send(self, message: object) -> None:
        """Send a message of less than 65,536 bytes."""
        data = json.dumps(message).encode()
        length = len(data)
        head = bytes([0x80 | length]) if length < 126 else b"\xfe" + length.to_bytes(2)
        mask = os.urandom(4)  # clients mask what they send
        masked = bytes(byte ^ mask[n % 4] for n, byte in enumerate(data))
        self._socket.sendall(b"\x81" + head + mask + masked)

    def receive(self) -> Any:
        """The next message, or ConnectionError."""
        whole = b""
        while True:
            kind, length = self._read(2)
            if length >= 126:
                length = int.from_bytes(self._read(2 if length == 126 else 8))
            data = self._read(length)
            if kind & 0x0F == 8:  # it says farewell
                raise ConnectionError
            if kind & 0x0F < 8:
                whole += data
                if kind & 0x80:
                    return json.loads(whole)

    def _read(self, length: int) -> bytes:
        data = self._file.read(length)
        if len(data) < length:
            raise ConnectionError
        return data

    def close(self) -> None:
        self._file.close()
        self._socket.close()


class _Page(ABC):
    """A page in a browser."""

    # How a browser is started, with its profile; what the path of its socket ends with.
    started: tuple[str, ...] = ()
    path = ""

    def __init__(self, browser: str, wire: _Wire) -> None:
        self.browser, self._wire, self._numbers = browser, wire, count(1)

    @abstractmethod
    def open(self, address: str) -> None:
        """Go to an address."""

    @abstractmethod
    def evaluate(self, expression: str) -> str:
        """What an expression comes to."""

    @abstractmethod
    def pdf(self) -> bytes:
        """The page as it is printed."""

    def _ask(self, method: str, params: Mapping[str, Any], **more: str) -> dict[str, Any]:
        """The answer to a command; other messages are skipped."""
        number = next(self._numbers)
        self._wire.send({"id": number, "method": method, "params": params, **more})
        while (said := self._wire.receive()).get("id") != number:
            pass
        if "error" in said:
            why = said.get("message") or said["error"]
            raise _failed(self.browser, str(why))
        answer: dict[str, Any] = said["result"]
        return answer


class _Chromium(_Page):
    """The same in Chromium and its kin, by the DevTools protocol."""

    started = (*QUIET, "--remote-debugging-port=0", "--user-data-dir={profile}", "about:blank")

    def open(self, address: str) -> None:
        target = self._ask("Target.createTarget", {"url": "about:blank"})["targetId"]
        attached = self._ask("Target.attachToTarget", {"targetId": target, "flatten": True})
        self._session: str = attached["sessionId"]
        self._asked("Page.navigate", url=address)

    def _asked(self, method: str, **params: object) -> dict[str, Any]:
        return self._ask(method, params, sessionId=self._session)

    def evaluate(self, expression: str) -> str:
        found = self._asked("Runtime.evaluate", expression=expression)
        if "exceptionDetails" in found:
            raise _failed(self.browser, found["exceptionDetails"]["text"])
        return str(found["result"].get("value"))

    def pdf(self) -> bytes:
        made = self._asked("Page.printToPDF", printBackground=True, preferCSSPageSize=True)
        return base64.b64decode(made["data"])


class _Firefox(_Page):
    """The same in Firefox, by WebDriver BiDi."""

    started = ("--headless", "--no-remote", "--profile", "{profile}", "--remote-debugging-port=0")
    path = "/session"

    def open(self, address: str) -> None:
        self._ask("session.new", {"capabilities": {}})
        self._page = self._ask("browsingContext.create", {"type": "tab"})["context"]
        self._ask(
            "browsingContext.navigate", {"context": self._page, "url": address, "wait": "complete"}
        )

    def evaluate(self, expression: str) -> str:
        asked = {"expression": expression, "target": {"context": self._page}, "awaitPromise": False}
        found = self._ask("script.evaluate", asked)
        if found["type"] == "exception":
            raise _failed(self.browser, found["exceptionDetails"]["text"])
        return str(found["result"].get("value"))

    def pdf(self) -> bytes:
        margin = dict.fromkeys(("top", "bottom", "left", "right"), 0.0)
        asked = {
            "context": self._page,
            "background": True,
            "page": A4,
            "margin": margin,
            "shrinkToFit": False,
        }
        return base64.b64decode(self._ask("browsingContext.print", asked)["data"])


def _failed(browser: str, why: str) -> BrowserError:
    return BrowserError(_("{browser} did not print: {why}").format(browser=browser, why=why))


@contextmanager
def _opened(browser: str, address: str) -> Iterator[_Page]:
    """A page in a browser that is started for it, and ends with it."""
    kind = _Firefox if Path(browser).stem in FIREFOXES else _Chromium
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        profile, said = Path(folder, "profile"), Path(folder, "said")
        profile.mkdir()
        command = [browser, *(word.format(profile=profile) for word in kind.started)]
        if kind is _Chromium and getattr(os, "geteuid", lambda: 1)() == 0:
            command.append("--no-sandbox")  # the superuser has none
        process: subprocess.Popen[bytes] | None = None
        try:
            with said.open("wb") as file, interrupts_held():
                process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=file)
            port, path = _listening(browser, process, said)
            with closing(_Wire(port, path + kind.path)) as wire:
                page = kind(browser, wire)
                page.open(address)
                yield page
        except OSError as error:
            raise _failed(browser, _("it is gone, or does not answer")) from error
        finally:
            if process is not None:
                process.kill()
                process.wait()


def _listening(browser: str, process: subprocess.Popen[bytes], said: Path) -> tuple[int, str]:
    """The port and the path at which a browser listens, once it says so in a file."""
    begun = time.monotonic()
    while time.monotonic() - begun < BEGINNING:
        ended = process.poll() is not None
        text = said.read_bytes()
        if found := LISTENS.search(text):
            return int(found[1]), found[2].decode()
        if ended:
            lines = text.decode(errors="replace").strip().splitlines()
            raise _failed(browser, lines[-1] if lines else str(process.returncode))
        time.sleep(EACH)
    raise _failed(browser, _("it is gone, or does not answer"))
