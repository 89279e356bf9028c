"""Pages opened in a real browser, and everything that goes wrong in them."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal
from urllib.parse import urlsplit

from playwright.sync_api import (
    Browser,
    BrowserContext,
    ConsoleMessage,
    Page,
    Request,
    WebSocket,
    expect,
)

# The one without windows opens a page in a third of the time.
NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
# For a machine with no screen and no network, where tests may be root; the last line keeps a page
# from reaching other machines even where there is a network.
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-quic",
    "--no-first-run",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE localhost, EXCLUDE 127.0.0.1, EXCLUDE [::1]",
]
# Milliseconds after which a page is taken to hang: a machine under load, which may have to compile the
# kernels first, takes far less.
HANGING = 120_000
LOCALES = {"en": "en-US", "zh": "zh-CN"}

expect.set_options(timeout=HANGING)

Device = Literal["phone", "desktop"]
Language = Literal["en", "zh"]
Colours = Literal["light", "dark"]


def browser_path() -> str | None:
    """Where Chromium is on this machine, if it is."""
    return next(filter(None, map(shutil.which, NAMES)), None)


def origin_of(url: str) -> str:
    """Scheme, host and port of an address."""
    parts = urlsplit(url)
    return f"{parts.scheme}://{parts.netloc}"


class Pages:
    """Opens pages, each as a newcomer sees it, and keeps what goes wrong in them.

    Attributes:
        faults: uncaught errors, errors on the console, crashes, and requests that leave the page's own
            file or server. A test that provokes one takes it out.
    """

    def __init__(self, browser: Browser) -> None:
        self.faults: list[str] = []
        self._browser = browser
        self._contexts: list[BrowserContext] = []

    def open(
        self,
        address: str,
        device: Device = "desktop",
        language: Language = "en",
        colours: Colours = "light",
        served: Path | None = None,
    ) -> Page:
        """A new page at an address, `file:`, `data:` or of a server here, without any history.

        Where a file is `served`, it is what stands at that address, and no server is asked.
        """
        phone = device == "phone"
        context = self._browser.new_context(
            viewport={"width": 390, "height": 844} if phone else {"width": 1366, "height": 768},
            device_scale_factor=2 if phone else 1,
            is_mobile=phone,
            has_touch=phone,
            locale=LOCALES[language],
            color_scheme=colours,
        )
        self._contexts.append(context)
        self._watch(context, origin_of(address))
        context.set_default_timeout(HANGING)
        if served:
            bare = address.split("#")[0]
            context.route(bare, lambda route: route.fulfill(path=served, content_type="text/html"))
        page = context.new_page()
        page.goto(address)
        return page

    def close(self) -> None:
        """Close what was opened; what had gone wrong by then is among the faults."""
        for context in self._contexts:
            context.close()

    def _watch(self, context: BrowserContext, own: str) -> None:
        def asked(request: Request) -> None:
            scheme = urlsplit(request.url).scheme
            # One file is all a page of a file may be: it is gone to, and asks for no other.
            allowed = scheme in ("data", "blob") or (
                scheme == "file" and request.is_navigation_request()
            )
            if not allowed and (scheme == "file" or origin_of(request.url) != own):
                self.faults.append(f"request: {request.url}")

        def connected(socket: WebSocket) -> None:
            if origin_of(socket.url) != own.replace("http", "ws", 1):
                self.faults.append(f"request: {socket.url}")

        def printed(message: ConsoleMessage) -> None:
            if message.type == "error":
                self.faults.append(f"console: {message.text}")

        def opened(page: Page) -> None:
            page.on("crash", lambda _page: self.faults.append("crash"))
            page.on("websocket", connected)

        context.on("weberror", lambda error: self.faults.append(f"error: {error.error}"))
        context.on("console", printed)
        context.on("request", asked)
        context.on("page", opened)


@contextmanager
def clean_pages(browser: Browser) -> Iterator[Pages]:
    """Pages in which nothing may go wrong."""
    pages = Pages(browser)
    try:
        yield pages
    finally:
        pages.close()
    if pages.faults:
        raise AssertionError("\n".join(pages.faults))
