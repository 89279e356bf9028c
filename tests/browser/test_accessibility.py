"""What everybody can use: axe finds nothing wrong, letters are keys only if wanted, pages reflow."""

from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.browser.pages import Colours, Language, Pages
from tests.browser.players import DESK, HAND, Scene, drawn, opened, ready, state, time_of, until

AXE = Path(__file__).parents[2] / "node_modules" / "axe-core" / "axe.min.js"
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
FOUND = """(rules) => axe.run(document, { runOnly: rules }).then(({ passes, violations }) => ({
  passes: passes.length,
  violations: violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html}`)),
}))"""
# What opens each part of the page.
PARTS = {
    "main": "0",
    "card": "benchdragon.choose(8)",
    "views": "document.querySelector('.views').open = true",
    "events": "document.querySelector('.events').open = true",
    "legend": "document.querySelector('.tools button:nth-child(3)').click()",
    "keys": "document.querySelector('dialog').close();"
    " document.querySelector('.tools button:last-child').click()",
    "story": "document.querySelector('dialog').close(); benchdragon.face.tell(1)",
}
OFF = "document.querySelector('dialog input')"


def violations(page: Page) -> list[str]:
    """What axe finds wrong in a page as it is."""
    if not page.evaluate("typeof axe === 'object'"):
        page.evaluate(f"{AXE.read_text('utf-8')}\n0;")
    found = page.evaluate(FOUND, RULES)
    assert found["passes"] > 10
    return found["violations"]  # type: ignore[no-any-return]


@pytest.mark.skipif(not AXE.exists(), reason="axe-core is not here: npm ci")
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


@pytest.mark.skipif(not AXE.exists(), reason="axe-core is not here: npm ci")
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
