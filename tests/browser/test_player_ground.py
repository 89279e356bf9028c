"""The ground that a dance covers, switched on in the player's picture."""

from collections.abc import Callable

import numpy as np
import shapely

from benchdragon import swept_area
from tests.browser.pages import Pages
from tests.browser.players import Scene, drawn, opened, pixels, state, until, views

SWITCH = "ground that the dance covers"
# Whether the painted picture has colour at places, m.
PAINTED = """(places) => {
  const { canvas, corner, scale } = benchdragon.face.painter.covered;
  const ctx = canvas.getContext("2d");
  return places.map(([x, y]) => ctx.getImageData(
    Math.floor((x - corner.left) * scale), Math.floor((corner.top - y) * scale), 1, 1).data[3] > 127);
}"""


def test_the_painted_ground_is_that_of_the_swept_area(pages: Pages, contact: Scene) -> None:
    page = opened(pages, contact)
    end = contact.walk.motion([contact.end])
    page.evaluate("benchdragon.see('route', false)")
    drawn(page)
    place = page.evaluate(
        "(at) => { const box = document.querySelector('canvas').getBoundingClientRect();"
        " const [x, y] = benchdragon.camera.toScreen(...at); return [box.x + x, box.y + y]; }",
        [float(end.x[0, 0]), float(end.y[0, 0])],
    )
    before = pixels(page, [place])
    views(page).get_by_role("checkbox", name=SWITCH).check()
    until(page, "benchdragon.face.painter.covered?.done")
    drawn(page)
    assert pixels(page, [place]) != before
    shape = swept_area(contact.walk, contact.start, contact.end, error=0.01).polygon
    low, high = np.array(shape.bounds).reshape(2, 2)
    random = np.random.default_rng(1)
    places = random.uniform(low - 0.5, high + 0.5, (4000, 2))
    points = shapely.points(places)
    clear = shapely.distance(shape.boundary, points) > 0.05  # dots have a size, m
    inside = shapely.contains(shape, points)
    assert 500 < np.count_nonzero(inside & clear) < np.count_nonzero(clear) - 500
    found = np.array(page.evaluate(PAINTED, places.tolist()))
    assert not np.any(found & ~inside & clear)  # it shows no ground that stays free
    missed = np.count_nonzero(inside & clear & ~found)
    assert missed <= 0.002 * np.count_nonzero(inside & clear)  # slivers between two moments
    views(page).get_by_role("checkbox", name=SWITCH).uncheck()
    drawn(page)
    assert pixels(page, [place]) == before
    assert state(page, "face.painter.unfinished") is False


def test_outlines_that_were_sent_are_drawn_until_switched_off(
    pages: Pages, scenes: Callable[[str], Scene]
) -> None:
    scene = scenes("pole")
    page = opened(pages, scene)
    assert scene.dance.ground
    box = views(page).get_by_role("checkbox", name=SWITCH, exact=True)
    assert box.is_checked()
    count = "benchdragon.covers"
    page.evaluate(
        "() => { const { square } = benchdragon; const cover = square.cover.bind(square);"
        " benchdragon.covers = 0;"
        " square.cover = (...all) => { benchdragon.covers++; cover(...all); }; benchdragon.put(1); }"
    )
    until(page, f"{count} > 0")
    box.uncheck()
    drawn(page)
    page.evaluate(f"{count} = 0; benchdragon.put(2)")
    drawn(page)
    assert page.evaluate(count) == 0
    assert state(page, "face.painter.covered") is None
