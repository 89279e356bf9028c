"""The player in a browser: what people do with it, on a phone and at a desk, in both languages."""

import re
from collections.abc import Callable

import numpy as np
import pytest
from playwright.sync_api import Page

from benchdragon.analysis.distance import nearest_each
from tests.browser.pages import Colours, Device, Language, Pages
from tests.browser.players import (
    DESK,
    HAND,
    LOOKS,
    Scene,
    drawn,
    look_at,
    on_screen,
    opened,
    seconds,
    state,
    time_of,
    until,
    views,
)


@pytest.mark.parametrize("name", ["turn", "contact", "single", "parade", "long"])
def test_handles_are_drawn_within_a_millimetre_of_their_places(
    pages: Pages, scenes: Callable[[str], Scene], name: str
) -> None:
    scene = scenes(name)
    page = opened(pages, scene)
    times = np.sort(np.random.default_rng(2).uniform(scene.start, scene.end, 25)).tolist()
    found = page.evaluate(
        """(times) => times.map((time) => {
          const { x, y, v } = benchdragon.scene.stand(time, benchdragon.scene.room());
          return [[...x], [...y], [...v]];
        })""",
        times,
    )
    motion = scene.walk.motion(times)
    x, y, v = np.array(found).transpose(1, 0, 2)
    assert np.hypot(x - motion.x, y - motion.y).max() <= 1e-3
    assert np.abs(v - motion.speed).max() <= 0.02
    assert state(page, "scene.sent.frames.largest_error") <= 1e-3


@pytest.mark.parametrize("look", LOOKS, ids="-".join)
def test_it_plays_and_pauses(pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]) -> None:
    page = opened(pages, turn, look)
    play, pause = {"en": ("play", "pause"), "zh": ("播放", "暂停")}[look[1]]
    assert time_of(page) == turn.start
    page.get_by_role("button", name=play, exact=True).click()
    until(page, f"benchdragon.time > {turn.start + 0.1}")
    page.get_by_role("button", name=pause, exact=True).click()
    stopped = time_of(page)
    drawn(page)
    assert turn.start < time_of(page) == stopped < turn.end
    assert page.locator(".clock").inner_text() == f"t = {seconds(stopped)}"
    assert page.get_by_role("button", name=play, exact=True).is_visible()


def test_it_stops_at_the_end_and_begins_anew(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    page.locator("select").last.select_option("30")
    page.evaluate(f"benchdragon.jump({turn.end - 0.5})")
    page.keyboard.press("Space")
    until(page, "benchdragon.time === benchdragon.scene.end && !benchdragon.playing")
    page.keyboard.press("Space")
    until(page, f"benchdragon.playing && benchdragon.time < {turn.end - 1}")


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
def test_time_is_moved_by_the_axis(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look)
    axis = page.get_by_role("slider")
    box = axis.bounding_box()
    assert box is not None
    span = turn.end - turn.start
    for share in (0.5, 0.25):
        page.mouse.move(box["x"] + 0.1 * box["width"], box["y"] + 0.5 * box["height"])
        page.mouse.down()
        page.mouse.move(box["x"] + share * box["width"], box["y"] + 0.5 * box["height"])
        page.mouse.up()
        assert time_of(page) == pytest.approx(turn.start + share * span, abs=0.02 * span)
    axis.focus()
    before = time_of(page)
    page.keyboard.press("ArrowRight")
    assert time_of(page) == pytest.approx(before + 1.0)
    page.keyboard.press("End")
    assert time_of(page) == turn.end
    assert axis.get_attribute("aria-valuetext") is not None
    drawn(page)
    assert axis.get_attribute("aria-valuetext") == f"{turn.end:.1f} s"


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
def test_steps_of_a_second_and_of_a_frame(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look)
    names = {
        "en": ("+1 s: one second on", "one frame on", "one frame back", "\u22121 s: one second back"),
        "zh": ("+1 s: 前进一秒", "前进一帧", "后退一帧", "\u22121 s: 后退一秒"),
    }[look[1]]
    page.evaluate("benchdragon.jump(10)")
    for name, time in zip(names, (11.0, 11.04, 11.0, 10.0), strict=True):
        page.get_by_role("button", name=name, exact=True).click()
        assert time_of(page) == pytest.approx(time)


def test_the_wheel_zooms_about_the_pointer_and_dragging_pans(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    canvas = page.locator("canvas").bounding_box()
    assert canvas is not None
    # Pointers stand on whole pixels, a canvas anywhere.
    x, y = round(canvas["x"] + 300.0), round(canvas["y"] + 200.0)
    there = f"benchdragon.camera.toGround({x - canvas['x']}, {y - canvas['y']})"
    before, scale = page.evaluate(f"[{there}, benchdragon.camera.scale]")
    page.mouse.move(x, y)
    page.mouse.wheel(0, -300)
    until(page, f"benchdragon.camera.scale > {1.2 * scale}")
    assert page.evaluate(there) == pytest.approx(before, abs=1e-9)
    page.mouse.down()
    page.mouse.move(x + 60.0, y - 20.0, steps=5)
    page.mouse.up()
    # The first few pixels, which may still be a tap, move nothing.
    moved = page.evaluate("(place) => benchdragon.camera.toScreen(...place)", before)
    assert moved == pytest.approx([360.0, 180.0], abs=16.0)
    assert state(page, "chosen") == -1
    page.get_by_text("View", exact=True).click()
    page.get_by_role("button", name="show all").click()
    x0, x1 = page.evaluate(
        """[Math.min, Math.max].map((end) => {
          const { camera, stand } = benchdragon;
          return camera.toScreen(end(...stand.x), 0)[0];
        })"""
    )
    assert 0.0 < x0 < x1 < canvas["width"]


def touch(page: Page, steps: list[list[tuple[float, float]]]) -> None:
    """Fingers that go down at the first places, move over the others, and lift."""
    client = page.context.new_cdp_session(page)
    for n, places in enumerate([*steps, []]):
        kind = "touchEnd" if not places else "touchMove" if n else "touchStart"
        points = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(places)]
        client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    drawn(page)


def test_two_fingers_zoom_and_one_pans_and_taps(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, HAND)
    box = page.locator("canvas").bounding_box()
    assert box is not None
    x, y = box["x"] + 190.0, box["y"] + 200.0
    middle, scale = page.evaluate("[benchdragon.camera.toGround(190, 200), benchdragon.camera.scale]")
    touch(page, [[(x - d, y), (x + d, y)] for d in (40.0, 50.0, 60.0, 70.0, 80.0)])
    assert state(page, "camera.scale") == pytest.approx(2.0 * scale, rel=0.05)
    assert page.evaluate("benchdragon.camera.toGround(190, 200)") == pytest.approx(middle, abs=0.5)
    assert state(page, "chosen") == -1
    before = page.evaluate("[benchdragon.camera.x, benchdragon.camera.y, benchdragon.camera.scale]")
    touch(page, [[(x, y)], [(x + 20.0, y)], [(x + 60.0, y + 30.0)]])
    after = page.evaluate("[benchdragon.camera.x, benchdragon.camera.y, benchdragon.camera.scale]")
    assert after[2] == before[2]
    assert (before[0] - after[0]) * after[2] == pytest.approx(60.0, abs=25.0)
    assert (after[1] - before[1]) * after[2] == pytest.approx(30.0, abs=15.0)
    look_at(page, 7, 60.0)
    for _again in range(5):  # half a second may pass between busy frames, which is a long press
        touch(page, [[on_screen(page, 7)]])
        if state(page, "chosen") != -1:
            break
    assert state(page, "chosen") == 6


@pytest.mark.parametrize("look", LOOKS, ids="-".join)
def test_events_are_jumped_to_from_the_list(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look)
    events = page.locator("details.events")
    events.locator("summary").click()
    rows = events.get_by_role("listitem")
    assert rows.count() == len(turn.dance.occasions)
    for n, occasion in enumerate(turn.dance.occasions):
        if n:
            events.locator("summary").click()
        text = rows.nth(n).inner_text()
        assert getattr(occasion.text, look[1]) in text
        assert seconds(occasion.time) in text
        rows.nth(n).get_by_role("button").click()
        assert time_of(page) == pytest.approx(occasion.time)
        assert events.get_attribute("open") is None


def test_events_are_jumped_to_from_their_marks_and_buttons(pages: Pages, contact: Scene) -> None:
    page = opened(pages, contact)
    (first,) = [one for one in contact.dance.occasions if one.kind == "contact"]
    page.locator(".mark.contact").click()
    assert time_of(page) == pytest.approx(first.time)
    assert page.locator(".mark.contact").get_attribute("title") == f"first contact ({first.time:.2f} s)"
    page.get_by_role("button", name="to the previous event").click()
    before = [one.time for one in contact.dance.occasions if one.time < first.time - 1e-6]
    assert time_of(page) == pytest.approx(max(before, default=first.time))
    page.evaluate("benchdragon.jump(0)")
    page.get_by_role("button", name="to the next event").click()
    assert time_of(page) == pytest.approx(
        min(o.time for o in contact.dance.occasions if o.time > contact.start + 1e-6)
    )


def test_an_event_out_of_sight_is_brought_into_sight(pages: Pages, contact: Scene) -> None:
    page = opened(pages, contact)
    look_at(page, 40, 300.0)
    page.keyboard.press("n")
    bench = contact.dance.occasions[0].benches[0]
    until(  # the camera flies there
        page,
        f"""(({{ camera, boxes }}) => {{
          const [x, y] = camera.toScreen(...boxes.point({bench - 1}, 0, 0));
          return x > 0 && y > 0 && x < camera.width && y < camera.height;
        }})(benchdragon)""",
    )


@pytest.mark.parametrize("look", LOOKS, ids="-".join)
def test_a_tapped_bench_shows_its_card_with_the_right_numbers(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look)
    time, bench = 28.75, 9
    page.evaluate(f"benchdragon.jump({time})")
    look_at(page, bench, 80.0)
    (page.mouse.click if look[0] == "desktop" else page.touchscreen.tap)(*on_screen(page, bench))
    drawn(page)
    card = page.locator("aside.card")
    assert card.locator("h2").inner_text() == {"en": "Bench 9", "zh": "第 9 节"}[look[1]]
    motion = turn.walk.motion([time])
    told = [cell.replace("\u2212", "-") for cell in card.locator("dd").all_inner_texts()]
    number = [float(re.findall(r"(-?\d+\.?\d*) (?:m|cm)\b", text)[0]) for text in told]
    assert number[0] == pytest.approx(motion.speed[0, bench - 1], abs=2e-3)
    assert number[1] == pytest.approx(motion.speed[0, bench], abs=2e-3)
    assert number[2] == pytest.approx(motion.acceleration[0, bench - 1], abs=5e-2)
    distance, other = nearest_each(motion, 1.0)
    assert number[4] == pytest.approx(100.0 * distance[0, bench - 1], abs=0.15)
    assert str(other[0, bench - 1]) in re.findall(r"\d+", told[4])
    assert number[5] == pytest.approx(100.0 * turn.dance.nearest.distance[bench - 1], abs=0.06)
    assert number[6] == 2.2
    # Where its tightest moment is, one click away; its neighbours too; and away again.
    card.locator("dd button").last.click()
    assert time_of(page) == pytest.approx(turn.dance.nearest.time[bench - 1])
    card.locator("nav button").last.click()
    assert state(page, "chosen") == bench
    card.locator("header button").click()
    assert (state(page, "chosen"), card.is_visible()) == (-1, False)


def in_sight(page: Page, bench: int) -> bool:
    """Whether a bench is whole on the canvas, and nothing lies over its middle."""
    return bool(
        page.evaluate(
            """(bench) => {
              const { boxes, camera } = benchdragon;
              const canvas = document.querySelector("canvas");
              const box = canvas.getBoundingClientRect();
              const whole = [0, 1, 2, 3].every((n) => {
                const [x, y] = camera.toScreen(...boxes.corner(bench, n));
                return x >= 0 && y >= 0 && x <= box.width && y <= box.height;
              });
              const [x, y] = camera.toScreen(boxes.x[bench], boxes.y[bench]);
              return whole && document.elementFromPoint(box.x + x, box.y + y) === canvas;
            }""",
            bench - 1,
        )
    )


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
@pytest.mark.parametrize("edge", ["right", "bottom"])
def test_a_tapped_bench_stays_in_sight(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours], edge: str
) -> None:
    page = opened(pages, turn, look, where="#t=28.75")
    bench, scale = 9, 40.0
    look_at(page, bench, scale)
    width, height = page.evaluate("[benchdragon.camera.width, benchdragon.camera.height]")
    aside, down = (0.5 * width - 50, 0) if edge == "right" else (0, 0.5 * height - 50)
    page.evaluate(f"benchdragon.camera.pan({aside}, {down}); benchdragon.zoom(1)")
    drawn(page)
    (page.mouse.click if look[0] == "desktop" else page.touchscreen.tap)(*on_screen(page, bench))
    page.locator("aside.card").wait_for()
    drawn(page)
    assert state(page, "chosen") == bench - 1
    assert state(page, "camera.scale") == pytest.approx(scale)
    until(page, f"benchdragon.camera.width + benchdragon.camera.height < {width + height}")
    assert in_sight(page, bench)
    # So do benches that are chosen by other means, and their moments.
    page.locator("aside.card dd button").last.click()
    drawn(page)
    assert time_of(page) == pytest.approx(turn.dance.nearest.time[bench - 1])
    assert in_sight(page, bench)
    for _step in range(6):
        page.keyboard.press("]")
    drawn(page)
    assert in_sight(page, bench + 6)


def test_a_bench_in_sight_is_not_moved(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=28.75&bench=12")
    whole = state(page, "camera.scale")
    page.set_viewport_size({"width": 900, "height": 500})
    until(page, f"benchdragon.camera.scale < {0.9 * whole}")  # all is in sight still
    look_at(page, 9, 40.0)
    before = page.evaluate("[benchdragon.camera.x, benchdragon.camera.y]")
    page.mouse.click(*on_screen(page, 9))
    drawn(page)
    assert state(page, "chosen") == 8
    assert page.evaluate("[benchdragon.camera.x, benchdragon.camera.y]") == before


def test_the_first_and_the_last_bench_have_one_neighbour(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    for bench, name in ((1, "Bench 1 (head)"), (60, "Bench 60 (tail)")):
        views(page).get_by_role("spinbutton").fill(str(bench))
        page.keyboard.press("Tab")
        assert page.locator("aside h2").inner_text() == name
        assert page.locator("aside nav button").count() == 1
    views(page).get_by_role("spinbutton").fill("61")
    page.keyboard.press("Tab")
    assert state(page, "chosen") == 59


def test_the_view_follows_a_bench_until_a_gesture(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    page.evaluate("benchdragon.choose(4)")
    box = views(page).get_by_label("follow it")
    box.check()
    for time in (0.0, 33.0):
        page.evaluate(f"benchdragon.jump({time})")
        drawn(page)
        middle = page.evaluate("[benchdragon.camera.x, benchdragon.camera.y]")
        assert middle == page.evaluate("[benchdragon.boxes.x[4], benchdragon.boxes.y[4]]")
    page.locator("canvas").hover(position={"x": 100, "y": 100})
    page.mouse.wheel(0, 100)
    until(page, "!benchdragon.follows")
    assert not box.is_checked()


def test_a_ruler_measures_the_ground(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    views(page).get_by_label("ruler").check()
    box = page.locator("canvas").bounding_box()
    assert box is not None
    before = page.evaluate("[benchdragon.camera.x, benchdragon.camera.y]")
    page.mouse.move(box["x"] + 100.0, box["y"] + 100.0)
    page.mouse.down()
    page.mouse.move(box["x"] + 400.0, box["y"] + 300.0, steps=4)
    page.mouse.up()
    (x0, y0), (x1, y1) = state(page, "ruler")
    scale = state(page, "camera.scale")
    assert (x1 - x0, y0 - y1) == pytest.approx((300.0 / scale, 200.0 / scale))
    assert page.evaluate("[benchdragon.camera.x, benchdragon.camera.y]") == before
    page.keyboard.press("r")
    assert state(page, "ruler") == []


def test_an_address_says_time_and_bench_and_the_page_writes_it(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=33.25&bench=12")
    assert (time_of(page), state(page, "chosen")) == (33.25, 11)
    page.keyboard.press("ArrowRight")
    until(page, "location.hash === '#t=34.25&bench=12'")
    page.keyboard.press("Escape")
    until(page, "location.hash === '#t=34.25'")
    page.evaluate("location.hash = '#t=-7&bench=3'")
    until(page, "benchdragon.time === -7 && benchdragon.chosen === 2")


def test_an_address_that_just_arrives_is_not_written_over(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=10")
    page.evaluate("location.hash = '#t=20'; benchdragon.onSettled()")
    until(page, "benchdragon.time === 20")
    page.evaluate("benchdragon.onSettled()")
    assert page.evaluate("location.hash") == "#t=20"


def test_the_address_is_written_once_a_hand_rests(pages: Pages, turn: Scene) -> None:
    """Browsers throw an error at pages that write it a hundred times while a slider is dragged."""
    page = opened(pages, turn)
    page.evaluate("""() => {
      globalThis.written = 0;
      const write = history.replaceState.bind(history);
      history.replaceState = (...all) => { globalThis.written += 1; write(...all); };
      const slider = document.querySelector(".axis input");
      for (let time = 0; time < 40; time++) {
        slider.value = String(time);
        slider.dispatchEvent(new Event("input"));
      }
    }""")
    until(page, "location.hash === '#t=39'")
    assert page.evaluate("written") == 1


def test_benches_touch_at_the_first_contact(pages: Pages, contact: Scene) -> None:
    """The page shows them off by fractions of a millimetre, here 8 micrometres apart."""
    (first,) = (occasion for occasion in contact.dance.occasions if occasion.kind == "contact")
    page = opened(pages, contact, where=f"#t={first.time!r}")
    a, b = first.benches
    until(page, f"document.querySelector('.tight').textContent === 'benches {a} and {b} touch'")


def test_every_time_is_drawn_a_second_before_0_too(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=-2")
    for time in ("-1.000", "0.000"):
        page.keyboard.press("ArrowRight")
        until(page, f"benchdragon.root.dataset.time === '{time}'")


@pytest.mark.parametrize("where", ["#t=soon&bench=x", "#t=1e9&bench=99999", "#bench=-4", "#%E0%A4%A"])
def test_odd_addresses_do_no_harm(pages: Pages, turn: Scene, where: str) -> None:
    page = opened(pages, turn, where=where)
    assert turn.start <= time_of(page) <= turn.end
    assert -1 <= state(page, "chosen") < 60


def test_keys_do_what_the_list_of_keys_says(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=10")
    for key, what, value in (
        ("ArrowRight", "time", 11.0), ("ArrowLeft", "time", 10.0), (".", "time", 10.04),
        (",", "time", 10.0), ("Home", "time", turn.start), ("End", "time", turn.end),
        ("]", "chosen", 0), ("]", "chosen", 1), ("[", "chosen", 0), ("Escape", "chosen", -1),
        ("f", "follows", True), ("f", "follows", False), ("t", "look.trails", True),
        ("t", "look.trails", False), ("r", "ruling", True), ("r", "ruling", False),
        ("c", "kind", "speed"), ("c", "kind", "clearance"),
        ("d", "look.dressed", False), ("d", "look.dressed", True),
        (" ", "playing", True), (" ", "playing", False),
    ):  # fmt: skip
        page.keyboard.press(key)
        assert state(page, what) == (pytest.approx(value) if what == "time" else value), key
    occasions = [one.time for one in turn.dance.occasions]
    page.evaluate("benchdragon.jump(benchdragon.scene.start)")
    for time in sorted({round(one, 6) for one in occasions if one > turn.start + 1e-6})[:3]:
        page.keyboard.press("n")
        assert time_of(page) == pytest.approx(time, abs=1e-5)
    scale = state(page, "camera.scale")
    page.keyboard.press("+")
    assert state(page, "camera.scale") == pytest.approx(1.4 * scale)
    page.keyboard.press("-")
    page.keyboard.press("Control+ArrowRight")
    assert time_of(page) == pytest.approx(time, abs=1e-5)


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
def test_the_list_of_keys_opens_and_closes(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look)
    page.locator(".tools button").last.click()
    dialog = page.get_by_role("dialog")
    assert dialog.get_by_role("row").count() == 13
    page.keyboard.press("ArrowRight")
    assert time_of(page) == turn.start
    dialog.get_by_role("button").click()
    assert dialog.count() == 0
    page.locator(".tools button").last.click()
    page.keyboard.press("Escape")
    assert dialog.count() == 0


def test_with_reduced_motion_time_goes_on_in_whole_seconds(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    page.emulate_media(reduced_motion="reduce")
    page.evaluate(
        """() => {
          globalThis.times = [];
          const watch = () => { times.push(benchdragon.time); requestAnimationFrame(watch); };
          watch();
        }"""
    )
    page.keyboard.press("Space")
    until(page, f"benchdragon.time > {turn.start + 1.5}")
    steps = set(page.evaluate("times"))
    assert {round(step - turn.start, 9) for step in steps} <= {0.0, 1.0, 2.0, 3.0}
