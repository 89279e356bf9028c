"""How long the planner takes to answer when one person moves a slider, as the page itself sees it.

Run it as `python -m benchmarks.sliders`: its file in Chromium on this machine, every move another
value. The first contact, the least clearance and the greatest
speed come as one verdict, the smallest pitch beside it, the dance that is shown when the slider rests.
"""

import statistics
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import Page, sync_playwright
from tests.browser.pages import FLAGS, browser_path

from benchdragon.planner.page import write_planner

# Plan, slider, its values from and to, moves, and ms between them.
SLIDERS = (
    ("question-3", "spiral pitch", 0.44, 0.60, 30, 500),
    ("turn", "ratio of the radii", 1.2, 2.0, 20, 1500),
)
ASKED = {"verdicts": "verdict", "pitches": "smallest pitch", "dances": "dance to be shown"}
# ms that the planner may take to start, and to settle.
STARTS, SETTLES = 120_000, 4_000


def moved(page: Page, slider: tuple[str, str, float, float, int, int]) -> None:
    """Print how long each question took while a slider moved."""
    plan, name, low, high, moves, pause = slider
    page.get_by_label("begin with").select_option(plan)
    page.wait_for_timeout(SETTLES)
    for what in ASKED:
        page.evaluate(f"benchdragon.{what}.times.length = 0")
    handle = page.get_by_role("slider", name=name)
    for move in range(moves):
        handle.fill(f"{low + (high - low) * move / moves:.3f}")
        page.wait_for_timeout(pause)
    page.wait_for_timeout(SETTLES)
    for what, text in ASKED.items():
        times = sorted(page.evaluate(f"benchdragon.{what}.times"))
        if not times:
            print(f"| {plan} | {name} | {text} | 0 | not asked | | |", flush=True)
            continue
        high_time = times[int(0.95 * (len(times) - 1))]
        print(
            f"| {plan} | {name} | {text} | {len(times)} | {statistics.median(times):.0f} "
            f"| {high_time:.0f} | {times[-1]:.0f} |",
            flush=True,
        )


def main() -> None:
    """Print the table."""
    path = browser_path()
    if path is None:
        sys.exit("no Chromium here: apt-get install chromium")
    print("| plan | slider | question | answers | median, ms | p95, ms | max, ms |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = Path(folder) / "planner.html"
        write_planner(file)
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        page = browser.new_page(viewport={"width": 1366, "height": 768})
        page.goto(file.as_uri())
        page.locator("canvas").wait_for(timeout=STARTS)
        for slider in SLIDERS:
            moved(page, slider)
        browser.close()


if __name__ == "__main__":
    main()
