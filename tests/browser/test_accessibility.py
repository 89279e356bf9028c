"""The player for everybody: axe finds nothing wrong, letters are keys if wanted, it reflows."""

from collections.abc import Callable

import pytest

from tests.browser.axe import needs_axe, violations
from tests.browser.pages import Colours, Language, Pages
from tests.browser.players import DESK, HAND, Scene, drawn, opened, ready, state, time_of, until

# What opens each part of the page.
PARTS = {
    "main": "0",
    "card": "benchdragon.choose(8)",
    "views": "document.querySelector('.views').open = true",
    "events": "document.querySelector('.events').open = true",
    "legend": "document.querySelector('.tools button:nth-child(3)').click()",
    "keys": "document.querySelector('dialog').close();"
    " document.querySelector('.tools button:last-child').click()",
    "story": "document.querySelector('dialog').close(); benchdragon.face.tell(undefined, 1)",
}
OFF = "document.querySelector('dialog input')"


@needs_axe
@pytest.mark.parametrize("colours", ["light", "dark"])
@pytest.mark.parametrize("language", ["en", "zh"])
def test_axe_finds_nothing_wrong(
    pages: Pages, contact: Scene, language: Language, colours: Colours
) -> None:
    device = HAND[0] if language == "zh" else DESK[0]
    page = opened(pages, contact, (device, language, colours), where="#t=412.4")
    for part, show in PARTS.items():
        page.evaluate(show)
        drawn(page)
        assert violations(page) == [], part


@needs_axe
def test_axe_would_find_what_is_wrong(pages: Pages, contact: Scene) -> None:
    page = opened(pages, contact)
    page.evaluate("document.querySelector('.axis input').removeAttribute('aria-label')")
    assert [one.split(":")[0] for one in violations(page)] == ["label"]


def test_letters_are_no_keys_where_they_are_switched_off(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=10")
    for on in (False, True):
        page.locator(".tools button").last.click()
        box = page.get_by_role("checkbox", name="letters, digits and signs are keys")
        assert box.is_checked() is not on
        box.set_checked(on)
        page.keyboard.press("Escape")
        page.goto("about:blank")  # it is remembered
        page.goto(f"{turn.files['en']}#t=10")
        ready(page)
        before = state(page, "camera.scale")
        for key in ("t", "+", "n", "]", "f"):
            page.keyboard.press(key)
        assert state(page, "look.trails") is on
        assert (state(page, "camera.scale") != before) is on
        assert (state(page, "chosen") >= 0, state(page, "follows")) == (on, on)
        time = time_of(page)
        assert (time != 10.0) is on
        page.keyboard.press("ArrowRight")  # which writes nothing, is a key always
        assert time_of(page) == pytest.approx(time + 1.0)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_at_320_pixels_nothing_scrolls_sideways(
    pages: Pages, contact: Scene, language: Language
) -> None:
    page = opened(pages, contact, ("phone", language, "light"), where="#t=412.4")
    page.set_viewport_size({"width": 320, "height": 640})
    until(page, "benchdragon.camera.width === 320")
    for part, show in PARTS.items():
        page.evaluate(show)
        drawn(page)
        for what in ("document.scrollingElement", "document.querySelector('dialog') ?? document.body"):
            wide = page.evaluate(f"(({what})).scrollWidth - (({what})).clientWidth")
            assert wide <= 0, (part, what)
        cut = page.evaluate(
            """[...document.querySelectorAll("button, select, summary, p, td, th, dd")]
              .filter((one) => one.checkVisibility() && !one.matches(".spoken, .mark"))
              .filter((one) => one.getBoundingClientRect().right > innerWidth + 0.5)
              .map((one) => one.outerHTML)"""
        )
        assert cut == [], part


@pytest.mark.parametrize("language", ["en", "zh"])
def test_fingers_find_targets_of_44_pixels(pages: Pages, contact: Scene, language: Language) -> None:
    page = opened(pages, contact, ("phone", language, "light"), where="#t=412.4")
    for part, show in PARTS.items():
        page.evaluate(show)
        drawn(page)
        small = page.evaluate(
            """[...document.querySelectorAll("button, select, summary, label.tick")]
              .filter((one) => one.checkVisibility() && !one.matches(".mark"))
              .map((one) => [one.outerHTML, one.getBoundingClientRect()])
              .filter(([_html, box]) => Math.min(box.width, box.height) < 43.5)
              .map(([html, box]) => `${box.width} x ${box.height} ${html}`)"""
        )
        assert small == [], part


@pytest.mark.parametrize("mark", ["contact", "joint"])
def test_a_finger_that_taps_beside_a_mark_of_the_time_axis_finds_it(
    pages: Pages, scenes: Callable[[str], Scene], mark: str
) -> None:
    page = opened(pages, scenes({"contact": "contact", "joint": "turn"}[mark]), HAND)
    boxes = page.evaluate(
        "(kind) => [...document.querySelectorAll(`.axis .${kind}`)].map((one) => {"
        " const box = one.getBoundingClientRect(); return [box.x + box.width / 2, box.y]; })",
        mark,
    )
    box = page.locator(".axis input").bounding_box()
    assert box is not None
    assert box["height"] >= 44.0
    times = page.evaluate(
        "(kind) => benchdragon.scene.sent.occasions.filter((one) => one.kind === kind)"
        ".map(({ time }) => time)",
        mark,
    )
    middle = box["y"] + box["height"] / 2
    for aside in (-21.0, 21.0):
        page.evaluate("benchdragon.put(0)")
        tapped = boxes[0][0] + aside if len(boxes) == 1 or aside < 0 else boxes[-1][0] + aside
        page.touchscreen.tap(tapped, middle)
        wanted = times[0] if aside < 0 else times[-1]
        until(page, f"Math.abs(benchdragon.time - {wanted}) < 1e-9")
    page.touchscreen.tap(boxes[0][0] - 24.0, middle)
    until(page, f"Math.abs(benchdragon.time - {times[0]}) > 1e-9")


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_words_are_smaller_than_10_pixels(pages: Pages, contact: Scene, language: Language) -> None:
    page = opened(pages, contact, ("phone", language, "light"), where="#t=412.4")
    for part, show in PARTS.items():
        page.evaluate(show)
        sizes = page.evaluate(
            """[...document.querySelectorAll("main *")]
              .filter((one) => [...one.childNodes].some((n) => n.nodeType === 3 && n.data.trim()))
              .map((one) => parseFloat(getComputedStyle(one).fontSize))"""
        )
        assert min(sizes) >= 10.0, part
