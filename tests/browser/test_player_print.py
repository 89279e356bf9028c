"""The player on paper: the dance in proportion, with title, verdict and time; nothing to press."""

import io
from typing import Any

import pytest
from playwright.sync_api import Page, PdfMargins
from pypdf import PdfReader

from tests.browser.pages import Colours, Device, Language, Pages
from tests.browser.players import LOOKS, Scene, drawn, look_at, opened, state, until

INCH = 72.0  # points
MARGIN = 10.0 / 25.4 * INCH


class Sheet:
    """The one sheet that a page prints on.

    Attributes:
        text: what stands on it.
        width: of its room for print, points.
        across, down: points of a CSS pixel of the picture.
        picture: width of the picture, points.
        ground: the colour it stands on.
    """

    def __init__(self, page: Page, landscape: bool) -> None:
        sides: PdfMargins = {"top": "10mm", "right": "10mm", "bottom": "10mm", "left": "10mm"}
        printed = page.pdf(format="A4", landscape=landscape, margin=sides)
        (sheet,) = PdfReader(io.BytesIO(printed)).pages
        grounds: list[tuple[list[float], list[float], list[float]]] = []
        colour = [0.0, 0.0, 0.0]

        def before(operator: bytes, operands: Any, matrix: list[float], _text: list[float]) -> None:
            if operator == b"rg":
                colour[:] = map(float, operands)
            # The canvas is printed as it is drawn: its ground first, from its corner.
            if operator == b"re" and [float(one) for one in operands[:2]] == [0.0, 0.0]:
                grounds.append(([float(one) for one in operands], list(matrix), list(colour)))

        self.text = sheet.extract_text(visitor_operand_before=before)
        self.width = float(sheet.mediabox.width) - 2.0 * MARGIN
        rectangle, matrix, self.ground = grounds[0]
        self.across, self.down = abs(matrix[0]), abs(matrix[3])
        self.picture = rectangle[2] * self.across


@pytest.mark.parametrize("landscape", [False, True], ids=["upright", "landscape"])
@pytest.mark.parametrize("look", LOOKS, ids="-".join)
def test_a_printed_dance_keeps_its_proportions_and_says_what_it_is(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours], landscape: bool
) -> None:
    page = opened(pages, turn, look, where="#t=28.75")
    sheet = Sheet(page, landscape)
    assert sheet.across == pytest.approx(sheet.down, rel=1e-3)
    assert sheet.ground == [1.0, 1.0, 1.0]  # paper is white, whatever the theme
    assert sheet.width >= sheet.picture >= (0.45 if landscape else 0.98) * sheet.width
    said = "".join(sheet.text.split())
    assert turn.dance.verdict is not None
    for text in (
        getattr(turn.dance.title, look[1]),
        getattr(turn.dance.verdict.sentence, look[1]),
        "t = 28.75 s",
        page.locator(".tight").text_content() or "",
        turn.dance.plan_sha256[:12],
    ):
        assert text
        assert "".join(text.split()) in said
    for control in ("+1 s", "1\u00d7", "English", "中文", "Events", "事件", "View", "显示"):
        assert "".join(control.split()) not in said


@pytest.mark.parametrize("landscape", [False, True], ids=["upright", "landscape"])
def test_a_card_is_printed_on_the_same_sheet(pages: Pages, turn: Scene, landscape: bool) -> None:
    page = opened(pages, turn, where="#t=28.75&bench=9")
    sheet = Sheet(page, landscape)
    assert "Bench 9" in sheet.text
    assert "t = 28.75 s" in sheet.text
    assert "Bench 8" not in sheet.text  # its neighbours are buttons
    assert sheet.across == pytest.approx(sheet.down, rel=1e-3)
    assert sheet.picture >= (0.45 if landscape else 0.75) * sheet.width


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
    x, y, scale, width, height = page.evaluate(shown)
    assert (x, y) == pytest.approx(before[:2])
    # All that the screen shows, and as large as the paper's shape allows.
    assert width / scale >= before[3] / before[2] - 1e-9
    assert height / scale >= before[4] / before[2] - 1e-9
    assert min(width * before[2] / before[3], height * before[2] / before[4]) == pytest.approx(scale)
    drawn(page)
    drawn(page)
    dots = page.evaluate(canvas)
    assert dots[0] / dots[1] == pytest.approx(width / height, rel=0.01)
    page.emulate_media(media="screen")
    until(page, "document.documentElement.dataset.theme === 'dark'")
    drawn(page)
    assert page.evaluate(shown) == before
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
