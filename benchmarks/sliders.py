"""How long the planner takes to answer while a slider is dragged, as the page itself sees it.

Run it as `python -m benchmarks.sliders`: the planner's file in Chromium on this machine, every move
another value. The first contact, the least clearance and the greatest speed come as one verdict, a
rough picture beside it, and the dance that is shown when the slider rests. Waiting counts from the
move, also where a newer move took the question's place. Chromium's own throttling leaves Workers as
fast as they are: for the phone the process of page and Workers is stopped three quarters of the time.
`--seconds N` drags for so long instead, and says what memory that process takes as it goes.
"""

import argparse
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright
from tests.browser.pages import FLAGS, Device, Pages, browser_path
from tests.browser.slowed import renderers, slowed

from benchdragon.planner.page import write_planner
from benchdragon.plans.schema import read_plan

# Plan, slider, its values from and to.
SLIDERS = (
    ("spiral-in", "spiral pitch", 0.44, 0.60),
    ("turn", "ratio of the radii", 1.2, 2.0),
)
# How many times slower the processor is made than it is.
DEVICES: tuple[tuple[Device, int], ...] = (("desktop", 1), ("phone", 4))
# Moves, and ms between them: as a hand drags, and as one that stops at each value.
MOVES, PAUSES = 30, (60, 500)
# ms until a page must have settled, and that it is left alone.
SETTLES, ALONE = 60_000, 1_500
ASKED = {
    "verdicts": "verdict",
    "sketches": "rough picture",
    "dances": "dance to be shown",
}
MEGABYTE = 1e6
# Seconds between looks at the memory.
LOOK = 15.0
# From a move to the first verdict of its plan or of a later one, ms.
WATCH = """() => {
  const page = globalThis.benchdragon;
  page.moved = [];
  page.waited = [];
  const change = page.change.bind(page);
  page.change = (plan, final) => {
    if (!final) page.moved.push({ plan, at: performance.now() });
    return change(plan, final);
  };
  const answered = page.verdicts.answered;
  page.verdicts.answered = (found, plan) => {
    const now = performance.now();
    const last = page.moved.findIndex((move) => move.plan === plan);
    for (const move of page.moved.splice(0, last + 1)) page.waited.push(now - move.at);
    return answered(found, plan);
  };
}"""


def answered(page: Page) -> None:
    """Wait for the first verdict, whatever the page shows before it."""
    found = page.locator(".verdict:is(.safe, .tight, .unsafe)")
    found.wait_for(state="attached", timeout=SETTLES)


def settled(page: Page) -> None:
    """Wait for verdict and dance."""
    answered(page)
    page.wait_for_timeout(ALONE)
    page.locator("#planner[aria-busy=false]").wait_for(timeout=SETTLES)


def told(times: list[float]) -> str:
    """Count, median, 95th percentile and greatest of times, as cells."""
    if not times:
        return "0 | | | "
    ordered = sorted(times)
    high = ordered[round(0.95 * (len(ordered) - 1))]
    return f"{len(ordered)} | {statistics.median(ordered):.0f} | {high:.0f} | {ordered[-1]:.0f}"


def drag(page: Page, name: str, low: float, high: float, moves: int, pause: float) -> None:
    """Move a slider through its values."""
    handle = page.get_by_role("slider", name=name, include_hidden=True)
    for move in range(moves):
        value = f"{low + (high - low) * move / moves:.3f}"
        handle.evaluate(
            "(slider, value) => { slider.value = value;"
            " slider.dispatchEvent(new Event('input', { bubbles: true })); }",
            value,
        )
        page.wait_for_timeout(pause)


def measure(page: Page, where: str, slider: tuple[str, str, float, float]) -> None:
    """Print how long each question took while a slider moved."""
    plan, name, low, high = slider
    page.evaluate("(plan) => benchdragon.change(plan, true)", read_plan(plan).data())
    settled(page)
    for pause in PAUSES:
        for what in ASKED:
            page.evaluate(f"void (benchdragon.{what}.times.length = 0)")
        page.evaluate("void (benchdragon.waited.length = 0)")
        drag(page, name, low, high, MOVES, pause)
        settled(page)
        head = f"| {where} | {plan}, {name} | {pause} ms"
        print(
            f"{head} | verdict, from the move | {told(page.evaluate('benchdragon.waited'))} |",
            flush=True,
        )
        for what, text in ASKED.items():
            times = page.evaluate(f"benchdragon.{what}.times")
            print(f"{head} | {text} | {told(times)} |", flush=True)


def latency(browser: Browser, pages: Pages, address: str) -> None:
    """Print the table of times."""
    print("| on | dragged | a move each | what | answers | median, ms | p95, ms | max, ms |")
    print("|---|---|---|---|---|---|---|---|")
    for device, times in DEVICES:
        page = pages.open(address, device)
        settled(page)
        with slowed(browser, times):
            page.reload()
            dragged(page, device if times == 1 else f"{device}, {times} times slower")
        page.context.close()


def dragged(page: Page, where: str) -> None:
    """Print the rows of one device."""
    answered(page)
    (first,) = page.evaluate("benchdragon.verdicts.times.slice(0, 1)")
    whole = page.evaluate("performance.now()")
    print(f"| {where} | opened | | first verdict | 1 | {first:.0f} | | |")
    print(f"| {where} | opened | | from the address to the first verdict | 1 | {whole:.0f} | | |")
    settled(page)
    page.evaluate(WATCH)
    for slider in SLIDERS:
        measure(page, where, slider)


def memory(browser: Browser, pages: Pages, address: str, seconds: float) -> None:
    """Drag for a while, and print what memory the page's process takes."""
    page = pages.open(address)
    settled(page)
    print("| seconds | page and Workers, MB |")
    print("|---|---|")
    began = time.monotonic()
    last = began - LOOK
    while (now := time.monotonic()) - began < seconds:
        for plan, name, low, high in SLIDERS:
            page.evaluate("(plan) => benchdragon.change(plan, true)", read_plan(plan).data())
            drag(page, name, low, high, 10, 100)
            page.wait_for_timeout(ALONE)
        if now - last >= LOOK:
            last = now
            print(f"| {time.monotonic() - began:.0f} | {resident(browser)} |", flush=True)
    settled(page)
    print(f"| {time.monotonic() - began:.0f} | {resident(browser)} |", flush=True)


def resident(browser: Browser) -> str:
    """MB that the pages' processes have in memory."""
    pages = sum(
        int(Path(f"/proc/{one}/statm").read_text("ascii").split()[1]) for one in renderers(browser)
    )
    return f"{pages * os.sysconf('SC_PAGE_SIZE') / MEGABYTE:.0f}"


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, help="drag for so long, and print memory")
    seconds: float | None = parser.parse_args().seconds
    path = browser_path()
    if path is None:
        sys.exit("no Chromium here: apt-get install chromium")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = Path(folder) / "planner.html"
        write_planner(file)
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        pages = Pages(browser)
        if seconds is None:
            latency(browser, pages, file.as_uri())
        else:
            memory(browser, pages, file.as_uri(), seconds)
        pages.close()
        browser.close()


if __name__ == "__main__":
    main()
