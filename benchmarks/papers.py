"""How long the page takes to lay out the papers of a village of 120 benches.

Run it as `python -m benchmarks.papers`: the page that `benchdragon sheets` writes of the village among
the examples, in Chromium on this machine, from its address to papers that may be printed, at the speed
of this machine and with the page and its Workers stopped three quarters of the time, as on a phone.
"""

import time
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import expect, sync_playwright
from tests.browser.pages import FLAGS, browser_path, clean_pages
from tests.browser.slowed import slowed

from benchdragon.i18n import spoken_in
from benchdragon.planner.papers import PAPERS, wanted_papers, write_papers
from benchdragon.plans.roster import roster_of
from benchdragon.plans.schema import read_plan

PLAN = Path(__file__).parent.parent / "examples" / "12_village.dragon.toml"
LOOKS = {"by": "bench", "night": False, "phones": False}
# Seconds from the first picture that may pass, by how many times slower the page is.
WANTED = {1: 15.0, 4: 60.0}


def main() -> None:
    """Print a table of times."""
    plan = read_plan(str(PLAN))
    roster = roster_of(plan)
    print("| papers | size of sheets | times slower | seconds | wanted |")
    print("|---|---|---|---|---|")
    with TemporaryDirectory() as name, sync_playwright() as playwright, spoken_in("zh"):
        browser = playwright.chromium.launch(executable_path=browser_path(), args=FLAGS)
        for paper in ("a4", "quarter"):
            path = Path(name) / f"{paper}.html"
            write_papers(path, plan, wanted_papers(PAPERS, roster, {**LOOKS, "paper": paper}))
            for times, wanted in WANTED.items():
                with clean_pages(browser) as pages:
                    page = pages.open(path.as_uri())
                    with slowed(browser, times):
                        begun = time.perf_counter()
                        page.reload()
                        expect(page.locator("#sheets")).to_have_attribute("aria-busy", "false")
                        took = time.perf_counter() - begun
                    sheets = page.locator("#sheets .sheet").count()
                    assert sheets == len(plan.dragon.build())
                    print(f"| all {len(PAPERS)} | {paper} | {times} | {took:.1f} | {wanted:.0f} |")


if __name__ == "__main__":
    main()
