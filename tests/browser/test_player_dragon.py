"""The dragon as it is drawn: within the true size of its benches, by choice, where it is seen."""

from collections.abc import Callable

import numpy as np
import pytest

from tests.browser.pages import Colours, Pages
from tests.browser.players import (
    Scene,
    drawn,
    look_at,
    on_screen,
    opened,
    pixels,
    ready,
    state,
    views,
)

# The canvas, and which of its places lie outside all benches by more than some pixels.
CANVAS = """(slack) => {
  const canvas = document.querySelector("canvas");
  const { camera, boxes } = benchdragon;
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const outside = [];
  const colours = [];
  for (let y = 0; y < camera.height - 1; y += 3) for (let x = 0; x < camera.width - 1; x += 3) {
    const at = 4 * (Math.round(y) * canvas.width + Math.round(x));
    colours.push((data[at] << 16) + (data[at + 1] << 8) + data[at + 2]);
    outside.push(boxes.at(...camera.toGround(x + 0.5, y + 0.5), slack / camera.scale) < 0);
  }
  return [colours, outside];
}"""


@pytest.mark.parametrize("bench", [1, 60])
@pytest.mark.parametrize("scale", [20.0, 200.0])
def test_all_that_is_drawn_of_a_bench_lies_inside_it(
    pages: Pages, turn: Scene, bench: int, scale: float
) -> None:
    page = opened(pages, turn, where="#t=10")
    look_at(page, bench, scale)
    found = []
    for dressed in ("true", "false"):
        page.evaluate(f"benchdragon.see('dressed', {dressed})")
        drawn(page)
        found.append(page.evaluate(CANVAS, 4.0))
    (dragon, outside), (plain, _outside) = found
    changed = np.not_equal(dragon, plain)
    assert changed[np.logical_not(outside)].mean() > 0.3
    assert not changed[outside].any()


@pytest.mark.parametrize("colours", ["light", "dark"])
def test_colours_that_tell_something_are_not_drawn_over(
    pages: Pages, turn: Scene, colours: Colours
) -> None:
    page = opened(pages, turn, ("desktop", "en", colours), where="#t=10")
    page.evaluate("benchdragon.paintBy('speed')")
    look_at(page, 5, 200.0)
    places = [on_screen(page, 5, 0.02 * n, 0.05) for n in range(-20, -5)]
    assert len({tuple(one) for one in pixels(page, places)}) == 1
    page.evaluate("benchdragon.paintBy('plain')")
    drawn(page)
    assert len({tuple(one) for one in pixels(page, places)}) > 3


def test_plain_benches_are_chosen_and_remembered(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    box = views(page).get_by_label("drawn as a dragon")
    assert box.is_checked()
    for dressed in (False, True):
        box.set_checked(dressed)
        page.goto("about:blank")
        page.goto(turn.files["zh"])
        ready(page)
        assert state(page, "look.dressed") is dressed
        page.goto("about:blank")
        page.goto(turn.files["en"])
        ready(page)
        views(page)


@pytest.mark.parametrize("name", ["single", "long"])
def test_dragons_of_one_and_of_a_thousand_benches_are_drawn(
    pages: Pages, scenes: Callable[[str], Scene], name: str
) -> None:
    page = opened(pages, scenes(name))
    for scale in (0.5, 5.0, 50.0):
        look_at(page, 1, scale)
        (colour,) = pixels(page, [on_screen(page, 1, 0.0, 0.02)])
        assert colour != [255, 255, 255]


def test_ticks_of_the_time_axis_stand_where_their_times_are(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    for width in (1366, 500):
        page.set_viewport_size({"width": width, "height": 768})
        drawn(page)
        drawn(page)
        ticks = page.evaluate(
            """[...document.querySelectorAll(".ticks span")]
              .map((one) => [one.textContent, parseFloat(one.style.left)])"""
        )
        assert 3 <= len(ticks) <= width / 60
        for text, left in ticks:
            time = float(text.removesuffix(" s").replace("\u2212", "-"))
            assert left == pytest.approx(
                100.0 * (time - turn.start) / (turn.end - turn.start), abs=1e-3
            )


@pytest.mark.parametrize("name", ["turn", "contact", "single"])
def test_the_legend_tells_of_what_there_is(
    pages: Pages, scenes: Callable[[str], Scene], name: str
) -> None:
    scene = scenes(name)
    page = opened(pages, scene)
    page.get_by_role("button", name="what is drawn").click()
    rows = page.get_by_role("dialog").locator("tr").all_inner_texts()
    kinds = {one.kind for one in scene.dance.occasions}
    for kind, text in {
        "contact": "first contact", "tightest": "tightest moment", "joint": "passes a joint",
        "fastest": "fastest moment", "cue": "a cue",
    }.items():  # fmt: skip
        assert any(text in row for row in rows) is (kind in kinds), kind
    assert any("disc" in row for row in rows) is (scene.dance.disc is not None)
    for text in ("head", "handle", "nearest", "hatched", "route", "clearance over time"):
        assert any(text in row for row in rows), text
