"""How long the planner's questions take in Firefox beside Chromium, on one page, in turns.

Run it as `python -m benchmarks.browsers`: the planner's file in both browsers on this machine. Answers
of a Worker are timed as the page asks for them: "first" is that of a Worker that answered nothing yet,
while the browser still compiles what is called. Then the page itself: the plan changes, and what it
shows of it comes when it comes, as its own lists of times tell.
"""

import json
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from playwright.sync_api import sync_playwright
from tests.browser.firefox import firefox, firefox_path
from tests.browser.pages import FLAGS, Pages, browser_path
from tests.browser.players import until
from tests.browser.test_firefox import SETTLED

from benchdragon.planner.page import write_planner
from benchdragon.plans.schema import read_plan

# What is asked of which plan, with which settings over it; and how often after the first time.
QUESTIONS = {
    "verdict on the way in": ("verdict", "spiral-in", (), 8),
    "verdict on the turn": ("verdict", "turn", (), 8),
    "smallest pitch of the turn": ("limit/pitch", "turn", (), 4),
    "greatest head speed on the turn": ("job/speed", "turn", (), 4),
    "best turn of 60 benches": ("job/turn", "turn", ("dragon.benches=60",), 1),
}
# Its times, ms.
ASKED = """(async () => {{
  const lane = benchdragon.answers.aside();
  const times = [];
  for (let n = 0; n <= {again}; n++) {{
    const began = performance.now();
    await lane.ask({{ question: {question}, plan: {plan} }});
    times.push(performance.now() - began);
  }}
  lane.close();
  return JSON.stringify(times);
}})()"""
# What a page shows of its plan, once that has another pitch, m, each.
SHOWN = {"verdicts": "verdict", "dances": "dance"}
PITCHES = (0.5, 0.52, 0.54, 0.56, 0.58, 0.6)
MOVED = f"""(async () => {{
  const found = {{}};
  for (const pitch of {list(PITCHES)}) {{
    for (const name of {list(SHOWN)}) benchdragon[name].times.length = 0;
    const plan = structuredClone(benchdragon.plan);
    plan.route.pitch = pitch;
    benchdragon.change(plan, true);
    for (const name of {list(SHOWN)}) {{
      while (!benchdragon[name].times.length) await new Promise((done) => setTimeout(done, 20));
      (found[name] ??= []).push(benchdragon[name].times[0]);
    }}
  }}
  return JSON.stringify(found);
}})()"""
ROUNDS = 3
# What an expression, or a promise, of a page comes to.
Evaluate = Callable[[str], str]


def worker_times(evaluate: Evaluate, name: str) -> dict[str, list[float]]:
    """What one browser's Worker takes for a question, ms: the first time, and then."""
    question, source, settings, again = QUESTIONS[name]
    plan = json.dumps(read_plan(source, settings).data())
    asked = ASKED.format(question=json.dumps(question), plan=plan, again=again)
    first, *others = json.loads(evaluate(asked))
    return {f"{name}, first": [first], f"{name}, then": others}


def page_times(evaluate: Evaluate) -> dict[str, list[float]]:
    """What one browser's page takes for a changed plan, ms."""
    found = json.loads(evaluate(MOVED))
    return {f"pitch moved: {text}": found[name] for name, text in SHOWN.items()}


def compare(browsers: dict[str, Evaluate]) -> None:
    """Print the table: the least of all rounds, in which the browsers take turns."""
    print("| question | Chromium, ms | Firefox, ms | Firefox / Chromium |")
    print("|---|---|---|---|")
    jobs = [lambda evaluate, name=name: worker_times(evaluate, name) for name in QUESTIONS]
    for job in (*jobs, page_times):
        found: dict[str, dict[str, list[float]]] = {}
        for _round in range(ROUNDS):
            for browser, evaluate in browsers.items():
                for text, times in job(evaluate).items():
                    found.setdefault(text, {}).setdefault(browser, []).extend(times)
        for text, beside in found.items():
            one, other = (min(beside[browser]) for browser in browsers)
            print(f"| {text} | {one:.0f} | {other:.0f} | {other / one:.2f} |", flush=True)


def main() -> None:
    """Print the table."""
    chromium, fox = browser_path(), firefox_path()
    if chromium is None or fox is None:
        sys.exit("both browsers are needed: apt-get install chromium firefox-esr")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = Path(folder) / "planner.html"
        write_planner(file)
        address = f"{file.as_uri()}#lang=en"
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        pages = Pages(browser)
        page = pages.open(address)
        until(page, SETTLED)
        with firefox(fox, Path(folder) / "profile") as other:
            other.open(address)
            other.until(SETTLED)
            compare({"Chromium": page.evaluate, "Firefox": other.evaluate})
        pages.close()
        browser.close()


if __name__ == "__main__":
    main()
