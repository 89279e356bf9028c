"""How a browser is had to print the papers of a dance into a file.

Papers are laid out in a page, from a Worker's answer, sheet after sheet: whoever prints has to wait for
that. Ways of Chromium are tried here on the village of the examples, 120 benches:

1. `--print-to-pdf`, which prints once the page is loaded, or, with `--virtual-time-budget`, once so
   many milliseconds have passed on a clock that runs ahead while nothing moves;
2. the DevTools protocol by a socket (`planner/printing.py`): the page is asked how far it is, and
   printed, kind by kind, once it says that it is done.

Said of each: seconds from start to file, pages, how many of the village's names stand on them, and how
wide a page of 210 mm is. Neither the load nor the clock that runs ahead waits for Workers: what is
printed then is a page that says that its sheets are not ready yet. What is left is to ask. Firefox
answers the same questions by WebDriver BiDi, so that a second browser costs two dozen lines. Where no
browser is found, this page says so and shows nothing.
"""

import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from pypdfium2 import PdfDocument

from benchdragon.i18n import spoken_in
from benchdragon.planner.papers import wanted_papers, write_papers
from benchdragon.planner.printing import find_browser, print_papers
from benchdragon.plans.roster import roster_of
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent
from benchdragon.rosters.roster import Roster

PLAN = Path(__file__).parent.parent / "examples" / "12_village.dragon.toml"
OPTIONS = {"paper": "a4", "by": "bench", "night": False, "phones": False}
# Of a clock that runs ahead, ms.
BUDGETS = (None, 60_000)
POINT = 25.4 / 72.0
Job = Callable[[Path], None]


def at_load(browser: str, page: Path, budget: int | None) -> Job:
    """What has a browser print by its own option."""

    def job(path: Path) -> None:
        command = [
            browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
            f"--user-data-dir={path.parent / path.stem}", f"--print-to-pdf={path}",
            *([f"--virtual-time-budget={budget}"] if budget else []), page.as_uri(),
        ]  # fmt: skip
        subprocess.run(command, check=True, capture_output=True, timeout=300)

    return job


def by_asking(browser: str, page: Path) -> Job:
    """What asks a browser until the papers are there."""
    return lambda path: print_papers(browser, page, {"benches": path}, silent)


def show(name: str, job: Job, path: Path, roster: Roster) -> None:
    """Print what one way comes to."""
    begun = time.perf_counter()
    job(path)
    took = time.perf_counter() - begun
    document = PdfDocument(path)
    text = "".join("".join(one.get_textpage().get_text_bounded().split()) for one in document)
    people = [one.name for some in roster.benches.values() for one in some]
    there = sum("".join(one.split()) in text for one in people)
    width = POINT * document[0].get_size()[0]
    print(
        f"{name}: {len(document)} pages in {took:.1f} s, {there} of {len(people)} names, {width:.2f} mm"
    )


def main() -> None:
    """Print what each way takes and gives."""
    browser = find_browser()
    if browser is None:
        print("no browser was found here: nothing is said of printing")
        return
    plan = read_plan(str(PLAN))
    roster = roster_of(plan)
    with TemporaryDirectory(ignore_cleanup_errors=True) as name, spoken_in("zh"):
        folder = Path(name)
        page = folder / "papers.html"
        write_papers(page, plan, wanted_papers(["benches"], roster, OPTIONS))
        for budget in BUDGETS:
            told = f"--virtual-time-budget={budget}" if budget else "at load"
            show(told, at_load(browser, page, budget), folder / f"load{budget}.pdf", roster)
        show("by asking", by_asking(browser, page), folder / "asked.pdf", roster)


if __name__ == "__main__":
    main()
