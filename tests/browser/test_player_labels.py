"""Words on the picture: numbers that can be read, and a label beside the ring and not on it."""

import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page

from tests.browser.pages import Colours, Device, Language, Pages
from tests.browser.players import DESK, HAND, LOOKS, Scene, drawn, look_at, opened, page_of, pixels

LOOKED_AT = [(1, 15.0), (1, 23.0), (9, 30.0), (16, 80.0), (16, 300.0)]
# What is written on the canvas: text, height of its letters, place, half its width, CSS pixels.
WRITTEN = """() => {
  const { painter } = benchdragon.face;
  const { ctx } = painter;
  const found = [];
  const write = ctx.fillText;
  ctx.fillText = (text, x, y) => {
    const size = parseFloat(/([\\d.]+)px/.exec(ctx.font)[1]);
    found.push({ text, size, x, y, half: ctx.measureText(text).width / 2 });
    write.call(ctx, text, x, y);
  };
  benchdragon.zoom(1);
  return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
    delete ctx.fillText;
    done(found);
  })));
}"""
# How far the label is from the ring's circle, and whether it covers one of the ring's benches.
APART = """([x, y, half, tall]) => {
  const { camera, ringed, boxes } = benchdragon;
  const [a, b] = [ringed.from, ringed.to].map((point) => camera.toScreen(...point));
  const ring = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  const foot = [
    Math.min(Math.max(ring[0], x - half), x + half), Math.min(Math.max(ring[1], y - tall), y + tall),
  ];
  const radius = Math.hypot(a[0] - b[0], a[1] - b[1]) / 2 + 12;
  const apart = Math.hypot(foot[0] - ring[0], foot[1] - ring[1]);
  const share = (radius + 0.5 * (apart - radius)) / apart;
  const inside = (bench) => {
    for (let u = -half; u <= half; u += 2) for (let v = -tall; v <= tall; v += 2) {
      const [east, north] = camera.toGround(x + u, y + v);
      const [dx, dy] = [east - boxes.x[bench], north - boxes.y[bench]];
      const along = Math.abs(dx * boxes.ux[bench] + dy * boxes.uy[bench]);
      const across = Math.abs(dy * boxes.ux[bench] - dx * boxes.uy[bench]);
      if (along < boxes.half[bench] && across < boxes.wide[bench]) return true;
    }
    return false;
  };
  return {
    apart: apart - radius,
    covers: inside(ringed.i) || inside(ringed.j),
    leader: ring.map((at, n) => at + share * (foot[n] - at)),
    within: x - half >= 0 && y - tall >= 0 && x + half <= camera.width && y + tall <= camera.height,
  };
}"""


def written(page: Page) -> list[dict[str, Any]]:
    """All that is written on the canvas."""
    return page.evaluate(WRITTEN)  # type: ignore[no-any-return]


def numbers(page: Page) -> list[dict[str, Any]]:
    """Benches' numbers on the canvas."""
    return [one for one in written(page) if one["text"].isdigit()]


def test_numbers_are_large_enough_to_read_and_do_not_lie_on_one_another(
    pages: Pages, tmp_path: Path
) -> None:
    page = page_of(pages, tmp_path, "spiral-in")
    page.evaluate("benchdragon.jump(300); benchdragon.choose(36)")
    for bench, scale in [(30, 2.0), (30, 7.0), (30, 10.0), *LOOKED_AT]:
        look_at(page, bench, scale)
        found = numbers(page)
        assert min((one["size"] for one in found), default=11) >= 10.0
        for a, b in itertools.combinations(found, 2):
            apart = (abs(a["x"] - b["x"]), abs(a["y"] - b["y"]))
            assert apart[0] >= a["half"] + b["half"] or apart[1] >= 0.8 * a["size"], (a, b)


def test_fewer_numbers_are_shown_from_farther_away(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=30")
    page.evaluate("benchdragon.boxes.reach = -1")  # without a ring
    for scale, each in ((300.0, 1), (30.0, 1), (24.0, 5), (12.0, 10), (7.0, 50)):
        look_at(page, 12, scale)
        found = {int(one["text"]) for one in numbers(page)}
        on_picture = page.evaluate(
            """[...benchdragon.boxes.x].flatMap((x, i) => {
              const { camera, boxes } = benchdragon;
              const [px, py] = camera.toScreen(x, boxes.y[i]);
              const here = px > 0 && py > 0 && px < camera.width && py < camera.height;
              return here ? [i + 1] : [];
            })"""
        )
        assert found & set(on_picture) == {n for n in on_picture if n == 1 or n % each == 0}, scale
    look_at(page, 12, 0.5)
    assert [one["text"] for one in numbers(page)] == ["1"]
    page.evaluate("benchdragon.choose(36)")
    look_at(page, 12, 7.0)
    assert "37" in {one["text"] for one in numbers(page)}


@pytest.mark.parametrize("look", LOOKS, ids="-".join)
def test_the_label_stands_beside_its_ring_and_a_line_leads_to_it(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look)
    purple = {"light": [122, 15, 168], "dark": [243, 166, 255]}[look[2]]
    box = page.locator("canvas").bounding_box()
    assert box is not None
    for time, (bench, scale) in itertools.product((18.0, 30.0, 52.0), LOOKED_AT):
        page.evaluate(f"benchdragon.jump({time})")
        look_at(page, bench, scale)
        labels = [one for one in written(page) if "(" in one["text"]]
        if not labels:
            continue
        (label,) = labels
        for one in numbers(page):
            number = page.evaluate(APART, [one["x"], one["y"], one["half"], 5.0])
            assert number["apart"] >= 0.0, one
        found = page.evaluate(APART, [label["x"], label["y"], label["half"] + 6.0, 11.0])
        x, y = found.pop("leader")
        apart = found.pop("apart")
        assert found == {"covers": False, "within": True}, (time, bench, scale)
        assert apart >= 10.0
        places = [(box["x"] + x + u, box["y"] + y + v) for u in (-1, 0, 1) for v in (-1, 0, 1)]
        far = min(np.abs(np.subtract(colour, purple)).max() for colour in pixels(page, places))
        assert far < 60, (time, bench, scale)


def test_the_label_stays_on_its_side_while_the_dance_plays(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=26")
    sides = []
    for _step in range(100):
        page.evaluate("benchdragon.jump(benchdragon.time + 0.04)")
        drawn(page)
        (label,) = [one for one in written(page) if "(" in one["text"]]
        ring = page.evaluate("benchdragon.camera.toScreen(...benchdragon.ringed.from)")
        sides.append((label["x"] > ring[0], label["y"] > ring[1]))
    assert sum(a != b for a, b in itertools.pairwise(sides)) <= 6


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
def test_the_label_does_not_hide_under_the_button_in_the_corner(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look, where="#t=26")
    button = page.locator(".views summary").bounding_box()
    canvas = page.locator("canvas").bounding_box()
    assert button is not None
    assert canvas is not None
    left, below = button["x"] - canvas["x"], button["y"] + button["height"] - canvas["y"]
    for away, down in itertools.product((-180.0, -120.0, -60.0, 0.0), (20.0, 60.0, 100.0)):
        page.evaluate(
            """([px, py]) => {
              const { camera, ringed } = benchdragon;
              const [x, y] = camera.toScreen(...ringed.from);
              camera.pan(px - x, py - y);
              benchdragon.jump(benchdragon.time);
            }""",
            [left + away, below + down],
        )
        drawn(page)
        labels = [one for one in written(page) if "(" in one["text"]]
        assert labels
        for one in labels:
            hidden = one["x"] + one["half"] > left and one["y"] - 11.0 < below
            assert not hidden, (away, down)
