"""How long the player takes for a picture in a browser, and how large its file is.

Run it as `python -m benchmarks.frame_time`. Chromium draws without a graphics card here, as the tests'
does; a picture's time is that of the page's own script: places, distances, drawing calls.
"""

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Page, sync_playwright
from tests.browser.pages import FLAGS, Device, Pages, browser_path

from benchdragon.plans.schema import read_plan
from benchdragon.player.page import write_player
from benchdragon.player.scene import Span, plain_dance

# Benches, and the times shown, s.
DANCES = ((223, Span(-100.0, 383.0)), (1000, Span(-100.0, 300.0)))
DEVICES: tuple[Device, ...] = ("desktop", "phone")
# How long it plays, s, and from when: while the head turns.
PLAYED, FROM = 3.0, 5.0
# What is asked of the page before it plays.
WAYS = {
    "all in sight": "benchdragon.fit()",
    "all, coloured by distance, trails": (
        "benchdragon.fit(); benchdragon.paintBy('clearance'); benchdragon.see('trails', true)"
    ),
    "following the head, near": "benchdragon.camera.scale = 60; benchdragon.follow(true)",
}
WATCH = """(seconds) => new Promise((done) => {
  benchdragon.frameTimes.length = 0;
  let [pictures, began] = [0, performance.now()];
  const watch = (now) => {
    pictures += 1;
    if (now - began < 1000 * seconds) requestAnimationFrame(watch);
    else done({ rate: 1000 * pictures / (now - began), times: [...benchdragon.frameTimes] });
  };
  requestAnimationFrame(watch);
})"""


def measured(page: Page, way: str) -> dict[str, Any]:
    """Median and 95th percentile of the picture's times, ms, and pictures a second."""
    page.evaluate(f"benchdragon.play(false); benchdragon.jump({FROM}); {way}; benchdragon.play(true)")
    found = page.evaluate(WATCH, PLAYED)
    middle, high = np.percentile(found["times"], [50, 95])
    return {"median": middle, "high": high, "rate": found["rate"]}


def main() -> None:
    """Print the table."""
    path = browser_path()
    if path is None:
        raise SystemExit("no Chromium here: apt-get install chromium")
    print("| benches | shown | file | page | playing | median | 95 % | pictures |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        pages = Pages(browser)
        for benches, span in DANCES:
            file = Path(folder) / f"{benches}.html"
            walk = read_plan("turn", [f"dragon.benches={benches}"]).build()
            write_player(file, plain_dance(walk, span))
            shown = f"{benches} | {span.end - span.start:g} s | {file.stat().st_size / 1e6:.2f} MB"
            for device in DEVICES:
                page = pages.open(file.as_uri(), device)
                page.get_by_role("button", name="play", exact=True).wait_for()
                for name, way in WAYS.items():
                    row = measured(page, way)
                    times = (
                        f"{row['median']:.1f} ms | {row['high']:.1f} ms | {row['rate']:.0f} a second"
                    )
                    print(f"| {shown} | {device} | {name} | {times} |", flush=True)
        pages.close()
        browser.close()


if __name__ == "__main__":
    main()
