"""The player on paper: the dance in proportion, with title, verdict and time; nothing to press."""

import re
from pathlib import Path

import numpy as np
import pypdfium2
import pytest
from playwright.sync_api import Page

from tests.browser.pages import Colours, Device, Language, Pages
from tests.browser.planners import Opened
from tests.browser.players import LOOKS, Scene, drawn, look_at, opened, page_of, state, until

MM = 72.0 / 25.4  # points
MARGIN = 10.0  # mm
DOTS = 4  # of a point
# Green of the disc, whose radius is 4.5 m in all these dances.
DISC, RADIUS = (0x00, 0x72, 0x4F), 4.5


class Sheet:
    """The one sheet of A4 that a page prints on.

    Attributes:
        text: what stands on it, without spaces.
        scale: metres on the ground to a metre of paper, as it says.
        colours: of its dots, (rows, columns, 3).
    """

    def __init__(self, page: Page) -> None:
        document = pypdfium2.PdfDocument(page.pdf(prefer_css_page_size=True))
        (sheet,) = document
        assert sheet.get_size() == pytest.approx((210.0 * MM, 297.0 * MM), abs=1.0)
        words = sheet.get_textpage()
        self.text = "".join(words.get_text_bounded().split())
        for n in range(words.count_rects()):
            left, bottom, right, top = words.get_rect(n)
            assert min(left, bottom) >= (MARGIN - 1.0) * MM
            assert right <= (211.0 - MARGIN) * MM
            assert top <= (298.0 - MARGIN) * MM
        self.scale = float(re.findall(r"1:(\d+)", self.text)[0])
        self.colours = np.asarray(sheet.render(scale=DOTS).to_pil().convert("RGB"), np.int64)

    def disc(self) -> tuple[float, float]:
        """Radius of the disc across and down, m on the ground by the scale that is told."""
        rows, columns = np.nonzero(np.abs(self.colours - DISC).max(axis=2) <= 8)
        across, down = (at / DOTS / MM * self.scale / 1000.0 for at in (columns, rows))
        # An ellipse with its axes along the paper's edges, by least squares.
        table = np.stack([across**2, across, down**2, down], axis=1)
        (a, b, c, d), *_rest = np.linalg.lstsq(table, np.ones(len(table)))
        size = 1.0 + b**2 / (4.0 * a) + d**2 / (4.0 * c)
        return float(np.sqrt(size / a)), float(np.sqrt(size / c))


@pytest.mark.parametrize("look", LOOKS, ids="-".join)
def test_a_dance_is_printed_to_the_scale_told_and_says_what_it_is(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look, where="#t=28.75")
    sheet = Sheet(page)
    assert sheet.disc() == pytest.approx((RADIUS, RADIUS), rel=0.01)
    assert sheet.scale in (50, 75, 100, 150, 200)
    assert sheet.colours[len(sheet.colours) // 2, 200].tolist() == [255] * 3  # whatever the theme
    assert turn.dance.verdict is not None
    for text in (
        getattr(turn.dance.title, look[1]),
        getattr(turn.dance.verdict.sentence, look[1]),
        "t = 28.75 s",
        page.locator(".tight").text_content() or "",
        turn.dance.plan_sha256[:12],
        page.evaluate("new Date().toLocaleDateString('sv-SE')"),
        {"en": "60 benches; 90.0 s;", "zh": "60 节板凳，历时 90.0 s，"}[look[1]],
    ):
        assert text
        assert "".join(text.split()) in sheet.text
    for control in ("+1 s", "1\u00d7", "English", "中文", "Events", "事件", "View", "显示"):
        assert "".join(control.split()) not in sheet.text


def test_a_card_is_printed_on_the_same_sheet(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, where="#t=28.75&bench=9")
    page.keyboard.press("0")
    drawn(page)
    sheet = Sheet(page)
    assert "Bench9" in sheet.text
    assert "t=28.75s" in sheet.text
    assert "Bench8" not in sheet.text  # its neighbours are buttons
    assert sheet.disc() == pytest.approx((RADIUS, RADIUS), rel=0.01)


def test_the_planner_prints_its_dance_to_scale(opened: Opened) -> None:
    page = opened("phone", "#lang=zh")
    sheet = Sheet(page)
    assert sheet.disc() == pytest.approx((RADIUS, RADIUS), rel=0.01)
    assert "安全：最紧处0.099m" in sheet.text
    assert page.evaluate("benchdragon.plan.meta.title_zh") in sheet.text
    for control in ("撤销", "分享", "显示", "板凳节数"):
        assert control not in sheet.text


def test_the_button_prints(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    page.evaluate("void (globalThis.print = () => { globalThis.printed = true; })")
    page.get_by_role("button", name="print").click()
    assert page.evaluate("printed")


@pytest.mark.parametrize("north", [True, False], ids=["north", "anywhere"])
def test_an_arrow_says_where_north_is_where_the_plan_does(
    pages: Pages, tmp_path: Path, north: bool
) -> None:
    page = page_of(pages, tmp_path, "01_parade", north=north)
    page.emulate_media(media="print")
    until(page, "benchdragon.paper.on")
    corner = page.evaluate(
        """() => {
          const canvas = document.querySelector("canvas");
          const side = canvas.width / 20;
          const { data } = canvas.getContext("2d").getImageData(0, 0, side, side);
          return data.filter((value, n) => n % 4 === 0 && value < 64).length;
        }"""
    )
    assert (corner > 300) == north


def test_what_the_screen_shows_is_printed_and_the_screen_is_as_before(
    pages: Pages, turn: Scene
) -> None:
    page = opened(pages, turn, ("desktop", "en", "dark"), where="#t=28.75")
    look_at(page, 9, 60.0)
    page.locator("html[data-theme=dark]").wait_for()
    shown = "Object.values(benchdragon.camera)"
    canvas = "[document.querySelector('canvas').width, document.querySelector('canvas').height]"
    before, size = page.evaluate(shown), page.evaluate(canvas)
    page.emulate_media(media="print")
    until(page, "document.documentElement.dataset.theme === 'light'")
    assert page.title() == "Turning-60"  # as the file of a printer that is none
    x, _y, scale, width, height = page.evaluate(shown)
    told = float(re.findall(r"1:(\d+)", page.locator(".on-paper").text_content() or "")[0])
    assert scale == pytest.approx(96.0 / 0.0254 / told)
    # All that the screen shows; at the scale before, it would not fit.
    assert width / scale >= before[3] / before[2] - 1e-9
    assert height / scale >= before[4] / before[2] - 1e-9
    assert x == pytest.approx(before[0])
    assert told == 150.0
    drawn(page)
    drawn(page)
    dots = page.evaluate(canvas)
    assert dots[0] / dots[1] == pytest.approx(width / height, rel=0.01)
    page.emulate_media(media="screen")
    until(page, "document.documentElement.dataset.theme === 'dark'")
    drawn(page)
    assert page.evaluate(shown) == before
    assert page.title() == turn.dance.title.en
    assert page.evaluate(canvas) == size
    page.keyboard.press("0")  # a whole dance is whole again
    drawn(page)
    whole = page.evaluate(shown)
    page.emulate_media(media="print")
    page.emulate_media(media="screen")
    until(page, "document.documentElement.dataset.theme === 'dark'")
    drawn(page)
    assert page.evaluate(shown) == pytest.approx(whole)
    assert state(page, "playing") is False
