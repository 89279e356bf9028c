"""The square on the page: how near benches are to it, as the package says it; names; touches."""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from benchdragon.analysis.check import check
from benchdragon.analysis.obstacle_distance import box_distances
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.player.page import player_page
from benchdragon.player.scene import checked_dance
from tests.browser.pages import Pages
from tests.browser.players import drawn, pixels, ready, state
from tests.browser.test_player_labels import WRITTEN
from tests.figures.test_square import NEAR, SAID

CROWDED = read_plan(
    "turn",
    [
        *SAID[:2],
        "venue.rectangle=[15, 60]",
        'obstacle=[{kind="circle", name="well", centre=[6.2, 2], radius=0.6, margin=0.3},'
        ' {kind="polygon", points=[[-9, 2], [-5, 1], [-6, 4]]},'
        ' {kind="line", points=[[-8, -9], [2, -5], [9, -9]]},'
        ' {kind="rectangle", centre=[1, 9], size=[6, 5], angle=30}]',
    ],
)
# A dance that comes from a street, into a square with an entrance in its eastern edge.
STREET = read_plan(
    "turn",
    [
        "dragon.benches=8", "route.outer_radius=9", "venue.rectangle=[40, 30]",
        "route.street={points=[[-60, 0], [-30, 2]], width=6}", "event.entrances=[[20.6, 5, 12]]",
    ],
)  # fmt: skip
# How far each bench is from each obstacle at each of some times, as the page has it.
DISTANCES = """(times) => {
  const { scene, stand, boxes, square } = benchdragon;
  return times.map((time) => {
    scene.stand(time, stand);
    boxes.place(stand);
    return square.obstacles.map((_one, n) => {
      const benches = Array.from({ length: boxes.count }, (_bench, i) => i);
      return benches.map((i) => square.pair(boxes, i, n).distance);
    });
  });
}"""


def page_of(pages: Pages, folder: Path, plan: Plan, language: str = "en", where: str = "") -> Page:
    file = folder / "dance.html"
    file.write_text(player_page(checked_dance(check(plan)), language), "utf-8")
    return ready(pages.open(file.as_uri() + where))


def test_distances_are_those_of_the_package(pages: Pages, tmp_path: Path) -> None:
    page, walk = page_of(pages, tmp_path, CROWDED), CROWDED.build()
    times = np.linspace(-40.0, 50.0, 46)
    seen = np.array(page.evaluate(DISTANCES, times.tolist()))
    motion = walk.motion(times)
    for n, obstacle in enumerate(CROWDED.obstacles()):
        exact = [box_distances(motion, t, obstacle)[0] for t in range(len(times))]
        wanted = np.maximum(np.array(exact) - obstacle.radius, 0.0)
        assert seen[:, n] == pytest.approx(wanted, abs=state(page, "boxes.touch"))
    assert (seen == 0.0).any(axis=(0, 2)).all()


def test_the_line_below_tells_what_touches_and_the_bench_is_hatched(
    pages: Pages, tmp_path: Path
) -> None:
    near = check(NEAR).obstacles[1].distance.witness
    assert near is not None
    page = page_of(pages, tmp_path, NEAR, where=f"#t={near.time}")
    expect(page.locator(".tight")).to_have_text(re.compile("bench 1 touches well$"))
    assert page.evaluate("[...benchdragon.square.touching]") == [0]
    page.evaluate("benchdragon.jump(0)")
    drawn(page)
    assert page.evaluate("[...benchdragon.square.touching]") == []
    expect(page.locator(".tight")).to_have_text(re.compile(r" to well$"))


def test_events_lead_to_the_obstacle_and_ring_it(pages: Pages, tmp_path: Path) -> None:
    page = page_of(pages, tmp_path, NEAR, "zh")
    page.locator(".events summary").click()
    page.get_by_role("button", name="到“well”的余量不足").first.click()
    drawn(page)
    contact = check(NEAR).obstacles[1].contact
    assert contact is not None
    assert state(page, "time") == pytest.approx(contact.value, abs=1e-9)
    distance = page.evaluate("benchdragon.square.pair(benchdragon.boxes, 0, 1).distance")
    assert distance == pytest.approx(0.3, abs=state(page, "boxes.touch"))


def test_the_whole_square_is_in_sight_and_obstacles_have_their_colour(
    pages: Pages, tmp_path: Path
) -> None:
    page = page_of(pages, tmp_path, NEAR)
    box = page.locator("canvas").bounding_box()
    assert box is not None
    corners = page.evaluate(
        "[[-30, -15], [30, 15], [6.2, 2.0]].map((at) => benchdragon.camera.toScreen(...at))"
    )
    for x, y in corners:
        assert 0.0 < x < box["width"]
        assert 0.0 < y < box["height"]
    x, y = corners[2]
    around = [(box["x"] + x + dx, box["y"] + y + dy) for dx in range(-2, 3) for dy in range(-2, 3)]
    assert [0xCC, 0x79, 0xA7] in pixels(page, around)
    assert [0, 0, 0] in [[c if c > 60 else 0 for c in dot] for dot in pixels(page, around)]


def test_benches_go_through_the_gate_of_a_street(pages: Pages, tmp_path: Path) -> None:
    """What is left of the edge is as far away as the package says, and nothing says that they leave."""
    page, walk = page_of(pages, tmp_path, STREET), STREET.build()
    times = np.linspace(0.0, 60.0, 31)
    seen = np.array(page.evaluate(DISTANCES, times.tolist()))
    (edge,) = STREET.obstacles()
    exact = [box_distances(walk.motion(times), t, edge)[0] for t in range(len(times))]
    assert seen[:, 0] == pytest.approx(np.array(exact), abs=state(page, "boxes.touch"))
    assert seen.min() > 0.5
    expect(page.locator("body")).not_to_contain_text("leaves")
    expect(page.locator("body")).to_contain_text("to the edge of the venue")


def test_edges_are_open_at_the_gate_of_a_street_and_at_entrances(pages: Pages, tmp_path: Path) -> None:
    page = page_of(pages, tmp_path, STREET)
    box = page.locator("canvas").bounding_box()
    assert box is not None
    (edge,) = STREET.obstacles()
    assert edge.open is not None
    _x, y = edge.open[[0, -1]].mean(axis=0).tolist()

    def blue(*places: tuple[float, float]) -> bool:
        to_screen = "(places) => places.map((at) => benchdragon.camera.toScreen(...at))"
        found = page.evaluate(to_screen, places)
        around = [
            (box["x"] + u + dx, box["y"] + v + dy)
            for u, v in found
            for dx in (-1, 0, 1)
            for dy in (-1, 0, 1)
        ]
        return [0x00, 0x72, 0xB2] in pixels(page, around)

    assert blue((-20.0, 12.0), (5.0, -15.0))
    assert not blue((-20.0, y + 1.5), (-20.0, y - 1.5))
    assert not blue((20.0, 9.0), (20.0, 1.0))
    assert blue((20.0, 11.0), (20.0, -1.0))


def test_entrances_are_rings_with_a_name_in_sight(pages: Pages, tmp_path: Path) -> None:
    plan = read_plan("turn", [*SAID[:2], "event.entrances=[[30, 12], [-33, 0]]"])
    page = page_of(pages, tmp_path, plan)
    box = page.locator("canvas").bounding_box()
    assert box is not None
    places = page.evaluate("[[30, 12], [-33, 0]].map((at) => benchdragon.camera.toScreen(...at))")
    for x, y in places:
        assert 0.0 < x < box["width"]
        ring = [(box["x"] + x + dx, box["y"] + y) for dx in range(5, 10)]
        assert [0x00, 0x72, 0xB2] in pixels(page, ring)
        assert pixels(page, [(box["x"] + x, box["y"] + y)]) == [[0xFF] * 3]
    name = [(box["x"] + places[1][0] + dx, box["y"] + places[1][1] - 16) for dx in range(40)]
    assert min(map(sum, pixels(page, name))) < 300


def test_margins_are_shaded_where_they_are(pages: Pages, tmp_path: Path) -> None:
    page = page_of(pages, tmp_path, NEAR)
    box = page.locator("canvas").bounding_box()
    assert box is not None

    def brightness(*places: tuple[float, float]) -> float:
        to_screen = "(places) => places.map((at) => benchdragon.camera.toScreen(...at))"
        at = [(box["x"] + x, box["y"] + y) for x, y in page.evaluate(to_screen, places)]
        return float(np.median([sum(dot) for dot in pixels(page, at)]))

    # The well's margin is 0.3 m wide, from 0.6 m of its centre on; the venue's 0.5 m, within its edge.
    turns = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    within, beyond = (
        brightness(*((6.2 + r * np.cos(a), 2.0 + r * np.sin(a)) for a in turns)) for r in (0.75, 1.3)
    )
    along = np.linspace(-10.0, 10.0, 9)
    inside, outside = (brightness(*((x, -15.0 + way) for x in along)) for way in (0.3, -0.3))
    assert within < beyond - 30.0
    assert inside < outside - 30.0


# Things so close that names above each would lie on one another, and more of them than find places.
CLOSE = [(-8.0, 6.0), (-6.5, 6.2), (-5.0, 5.0), *[(8.0, 6.0)] * 9]


def test_no_name_of_a_thing_lies_on_another(pages: Pages, tmp_path: Path) -> None:
    things = [
        {"kind": "circle", "name": f"thing number {n}", "centre": place, "radius": 0.2}
        for n, place in enumerate(CLOSE)
    ]
    plan = read_plan("turn", ["dragon.benches=9", "venue.rectangle=[40,30]"], obstacle=things)
    page = page_of(pages, tmp_path, plan)
    written = [one for one in page.evaluate(WRITTEN) if one["text"].startswith("thing")]
    assert [one["text"] for one in written[:4]] == [f"thing number {n}" for n in range(4)]
    assert 5 <= len(written) < len(CLOSE)
    for one, other in itertools.combinations(written, 2):
        across = abs(one["x"] - other["x"]) - one["half"] - other["half"]
        assert max(across, abs(one["y"] - other["y"]) - one["size"]) >= -1e-6, (one, other)


def test_the_scale_hides_no_edge_that_runs_below_it(pages: Pages, tmp_path: Path) -> None:
    page = page_of(pages, tmp_path, read_plan("turn", ["dragon.benches=9", "venue.rectangle=[40,30]"]))
    box = page.locator("canvas").bounding_box()
    assert box is not None
    page.evaluate("benchdragon.zoom(2)")
    x, y = page.evaluate("benchdragon.camera.toScreen(-20, -15)")
    shift = [-x, box["height"] - 30 - y]  # between the bar and the top of its number
    page.evaluate("(by) => { benchdragon.camera.pan(...by); benchdragon.zoom(1); }", shift)
    drawn(page)
    along = [(box["x"] + at, box["y"] + box["height"] - 30) for at in range(16, 140, 4)]
    blue = [0x00, 0x72, 0xB2]
    assert sum(dot == blue for dot in pixels(page, along)) > 10
