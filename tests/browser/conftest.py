"""Tests of pages: one Chromium in each process, and no page that fails unseen."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright

from benchdragon.planner.page import planner_page
from benchdragon.plans.schema import read_plan
from tests.browser.pages import FLAGS, Device, Pages, browser_path, clean_pages
from tests.browser.planners import Opened, settled
from tests.browser.players import Scene


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keep tests of a file in one process: each process has a browser, a page and dances of its own."""
    for item in items:
        if item.path.is_relative_to(Path(__file__).parent):
            item.add_marker(pytest.mark.xdist_group(f"browser {item.path.stem}"))


# Not for the session: an event loop runs for as long, and other tests start their own.
@pytest.fixture(scope="package")
def browser() -> Iterator[Browser]:
    """Chromium, without a window."""
    path = browser_path()
    if path is None:
        pytest.skip("no Chromium here to test pages in: apt-get install chromium")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield started
        started.close()


@pytest.fixture
def pages(browser: Browser) -> Iterator[Pages]:
    """Opens pages; the test fails if anything goes wrong in one."""
    with clean_pages(browser) as opened:
        yield opened


@pytest.fixture(scope="package")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The planner's file, with the contest's coil to its disc in it."""
    path = tmp_path_factory.mktemp("planner") / "planner.html"
    path.write_text(planner_page(read_plan("question-3"), "en"), "utf-8")
    return path


@pytest.fixture(scope="package")
def bare_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The planner's file without a plan in it, which asks at first."""
    path = tmp_path_factory.mktemp("bare") / "planner.html"
    path.write_text(planner_page(None, "en"), "utf-8")
    return path


@pytest.fixture
def opened(pages: Pages, file: Path) -> Opened:
    """Opens the planner, and waits for its first dance."""

    def open_page(device: Device = "desktop", where: str = "") -> Page:
        page = settled(pages.open(f"{file.as_uri()}{where}", device))
        expect(page.locator("canvas")).to_be_visible()
        return page

    return open_page


@pytest.fixture(scope="package")
def scenes(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Scene]:
    """Scenes by name, each made once."""
    folder, made = tmp_path_factory.mktemp("players"), {}

    def scene(name: str) -> Scene:
        if name not in made:
            made[name] = Scene(folder, name)
        return made[name]

    return scene


@pytest.fixture
def turn(scenes: Callable[[str], Scene]) -> Scene:
    return scenes("turn")


@pytest.fixture
def contact(scenes: Callable[[str], Scene]) -> Scene:
    return scenes("contact")
