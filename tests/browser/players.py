"""The player as tests open it: dances, pages, and what can be asked of one."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from playwright.sync_api import Locator, Page

from benchdragon import Walk
from benchdragon.analysis.check import check
from benchdragon.plans.schema import read_plan
from benchdragon.player import messages
from benchdragon.player.page import player_page
from benchdragon.player.scene import Span, checked_dance, plain_dance
from tests.browser.pages import HANGING, Colours, Device, Language, Pages

EXAMPLES = Path(__file__).parents[2] / "examples"
PLANS = {
    "turn": ("turn", ("dragon.benches=60", "walk.start=-20", "walk.end=70"), None),
    "contact": ("spiral-in", ("dragon.benches=40", "limits.margin=0"), Span(405.0, 420.0)),
    "single": ("spiral-in", ("dragon.benches=1", "walk.end=50"), None),
    "parade": (str(EXAMPLES / "01_parade.dragon.toml"), (), None),
    "long": ("turn", ("dragon.benches=1000",), None),
    "pole": (
        "spiral-in",
        (
            *("dragon.benches=20", "walk.end=60"),
            'obstacle=[{name="pole", kind="circle", centre=[7.75, 0], radius=0.3}]',
        ),
        None,
    ),
    "yard": (
        "turn",
        (
            *("dragon.benches=20", "walk.start=0", "walk.end=60"),
            *('venue.name="yard"', "venue.rectangle=[13, 26]"),
        ),
        None,
    ),
}


LOOKS: list[tuple[Device, Language, Colours]] = [
    ("phone", "zh", "light"),
    ("phone", "en", "dark"),
    ("desktop", "en", "light"),
    ("desktop", "zh", "dark"),
]


DESK, HAND = LOOKS[2], LOOKS[0]


class Scene:
    """A walk, its dance, and its page in both languages."""

    def __init__(self, folder: Path, name: str) -> None:
        source, settings, span = PLANS[name]
        self.plan = read_plan(source, settings)
        self.walk: Walk = self.plan.build()
        self.dance: messages.Dance = checked_dance(check(self.plan), span)
        self.start = self.dance.frames.start
        self.end = self.start + self.dance.frames.step * (self.dance.frames.count - 1)
        self.files = {}
        for language in ("en", "zh"):
            path = folder / f"{name}-{language}.html"
            path.write_text(player_page(self.dance, language), "utf-8")
            self.files[language] = path.as_uri()


def opened(
    pages: Pages, scene: Scene, look: tuple[Device, Language, Colours] = DESK, where: str = ""
) -> Page:
    """The page of a scene, ready."""
    device, language, colours = look
    return ready(pages.open(scene.files[language] + where, device, language, colours))


def ready(page: Page) -> Page:
    """The same page, once it shows the dance."""
    until(page, "globalThis.benchdragon?.root.dataset.time !== undefined")
    return page


def page_of(pages: Pages, folder: Path, name: str, **changes: object) -> Page:
    """The page of a plan or an example, without a check."""
    path = EXAMPLES / f"{name}.dragon.toml"
    plan = read_plan(str(path) if path.exists() else name)
    walk = plan.build()
    dance = plain_dance(walk, Span(*plan.span(walk), shares=(0.5,))).model_copy(update=changes)
    file = folder / "dance.html"
    file.write_text(player_page(dance, "en"), "utf-8")
    return ready(pages.open(file.as_uri()))


def until(page: Page, said: str) -> None:
    """Wait until something is so; the page's policy keeps others from asking in it."""
    asked = f"""() => new Promise((done) => {{
      const end = Date.now() + 1000;
      const ask = () => {{
        const so = {said};
        if (so || Date.now() > end) done(!!so);
        else setTimeout(ask, 10);
      }};
      ask();
    }})"""
    if not any(page.evaluate(asked) for _second in range(HANGING // 1000)):
        raise AssertionError(said)


def seconds(time: float, digits: int = 2) -> str:
    """A time as the page writes it."""
    return f"{round(time, digits) + 0.0:.{digits}f} s".replace("-", "\u2212")


def time_of(page: Page) -> float:
    """Time that the player is at, s."""
    return float(page.evaluate("benchdragon.time"))


def drawn(page: Page) -> None:
    """Wait until what was asked for is on the canvas."""
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def state(page: Page, what: str) -> Any:
    """A value of the player."""
    return page.evaluate(f"benchdragon.{what}")


def on_screen(page: Page, bench: int, along: float = 0.0, across: float = 0.0) -> tuple[float, float]:
    """Where a point of a bench (from 1; m from its centre) is on the page."""
    box = page.locator("canvas").bounding_box()
    assert box is not None
    x, y = page.evaluate(
        "([i, a, b]) => benchdragon.camera.toScreen(...benchdragon.boxes.point(i, a, b))",
        [bench - 1, along, across],
    )
    return box["x"] + x, box["y"] + y


def look_at(page: Page, bench: int, scale: float) -> None:
    """Put a bench in the middle, so many pixels a metre."""
    page.evaluate(
        "([i, scale]) => { const { camera, boxes } = benchdragon;"
        " [camera.x, camera.y, camera.scale] = [boxes.x[i], boxes.y[i], scale]; benchdragon.zoom(1); }",
        [bench - 1, scale],
    )
    drawn(page)


def pixels(page: Page, places: Sequence[Sequence[float]]) -> list[list[int]]:
    """Red, green and blue of the canvas at places of the page."""
    return page.evaluate(  # type: ignore[no-any-return]
        """(places) => {
          const canvas = document.querySelector("canvas");
          const box = canvas.getBoundingClientRect();
          const dots = canvas.width / box.width;
          const { width, height } = canvas;
          const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
          return places.map(([x, y]) => {
            const [i, j] = [x - box.left, y - box.top].map((at) => Math.round(at * dots));
            const inside = i >= 0 && j >= 0 && i < width && j < height;
            const first = 4 * (j * width + i);
            return inside ? [...data.subarray(first, first + 3)] : [0, 0, 0];
          });
        }""",
        places,
    )


def views(page: Page) -> Locator:
    """The panel of what is shown, opened."""
    panel = page.locator("details.views")
    if panel.get_attribute("open") is None:
        panel.locator("summary").click()
    return panel
