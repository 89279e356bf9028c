"""The watch over pages itself: it sees what goes wrong, and lets pass what is in order."""

from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest
from playwright.sync_api import Browser

from tests.browser.pages import Colours, Device, Language, Pages, clean_pages

# A browser asks a server for an icon unless the page brings one.
HEAD = """<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<meta name="viewport" content="width=device-width">"""
SEEN = """() => ({
  width: innerWidth,
  dots: devicePixelRatio,
  touch: navigator.maxTouchPoints > 0,
  language: navigator.language,
  dark: matchMedia("(prefers-color-scheme: dark)").matches,
})"""
SCREENS = {
    "phone": {"width": 390, "dots": 2, "touch": True},
    "desktop": {"width": 1366, "dots": 1, "touch": False},
}
# What a page does, and what is said of it.
FAULTS = {
    "throws": ("throw new Error('thrown')", "error: thrown"),
    "throws later": ("setTimeout(() => { throw new Error('late') })", "error: late"),
    "rejects": ("Promise.reject(new Error('rejected'))", "error: rejected"),
    "prints an error": ("console.error('printed')", "console: printed"),
    "asks another machine": (
        "document.body.append(Object.assign(new Image(), { src: 'http://dragon.invalid/a.png' }))",
        r"request: http://dragon\.invalid/a\.png",
    ),
    "asks for a file": (
        "document.body.append(Object.assign(document.createElement('script'), { src: 'other.js' }))",
        r"request: file:///.*/other\.js",
    ),
    "connects": ("new WebSocket('ws://127.0.0.1:9/')", "request: ws://127.0.0.1:9/"),
}


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *arguments: object) -> None:
        pass


@pytest.fixture
def server(tmp_path: Path) -> Iterator[str]:
    """The address of a server of what is in the test's folder."""
    handler = partial(Quiet, directory=tmp_path)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as served:
        thread = Thread(target=served.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{served.server_port}"
        served.shutdown()
        thread.join()


def written(folder: Path, script: str) -> Path:
    """A page that runs a script."""
    page = folder / "page.html"
    page.write_text(f"{HEAD}<body><script>{script}</script>", "utf-8")
    return page


@pytest.mark.parametrize(
    ("device", "language", "colours"), [("phone", "zh", "dark"), ("desktop", "en", "light")]
)
def test_a_page_is_shown_as_asked(
    pages: Pages, tmp_path: Path, device: Device, language: Language, colours: Colours
) -> None:
    address = written(tmp_path, "console.log('fine')").as_uri()
    seen = pages.open(address, device, language, colours).evaluate(SEEN)
    locale = {"zh": "zh-CN", "en": "en-US"}[language]
    assert seen == {**SCREENS[device], "language": locale, "dark": colours == "dark"}


@pytest.mark.parametrize("name", FAULTS)
def test_a_page_that_does_what_it_should_not_fails_its_test(
    browser: Browser, tmp_path: Path, name: str
) -> None:
    script, fault = FAULTS[name]
    address = written(tmp_path, script).as_uri()
    with pytest.raises(AssertionError, match=fault), clean_pages(browser) as pages:
        pages.open(address).wait_for_load_state("networkidle")


def test_a_page_may_ask_its_own_server_and_no_other(pages: Pages, server: str, tmp_path: Path) -> None:
    written(
        tmp_path,
        "fetch('data.json').then((answer) => answer.text()).then((text) => (document.title = text))",
    )
    (tmp_path / "data.json").write_text("told", "utf-8")
    page = pages.open(f"{server}/page.html")
    page.wait_for_function("document.title === 'told'")
    assert pages.faults == []
    page.evaluate("fetch('http://127.0.0.1:9/').catch(() => 0)")
    assert pages.faults.pop(0) == "request: http://127.0.0.1:9/"
    pages.faults.clear()


def test_one_process_has_all_tests_of_a_file(request: pytest.FixtureRequest) -> None:
    if not request.config.getoption("loadgroup", False):
        pytest.skip("only where tests are spread over processes by group")
    assert request.node.nodeid.endswith("@browser test_pages")
