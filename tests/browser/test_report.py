"""The report as a page: on phones nothing is cut off or too small, on paper no page is half empty."""

import io
from pathlib import Path
from typing import Protocol

import numpy as np
import pypdfium2
import pytest
from playwright.sync_api import Page

from benchdragon.export.publish import write_html
from benchdragon.figures.style import LEAST_TEXT
from benchdragon.i18n import spoken_in
from benchdragon.paper.report import report
from benchdragon.paper.results import Results
from tests.browser.axe import needs_axe, violations
from tests.browser.pages import Colours, Device, Pages

pytestmark = pytest.mark.parametrize("language", ["en", "zh"])
# Pixels: the least height of letters in figures, and of what fingers touch. mm: edges of paper.
LEGIBLE, TOUCHED, EDGE = 8.0, 44.0, 14.0
# Of the room between a page's margins.
EMPTY = 0.5
MM = 72.0 / 25.4


class Shown(Protocol):
    """Opens the report."""

    def __call__(self, device: Device, colours: Colours = "light") -> Page: ...


@pytest.fixture
def shown(pages: Pages, folder: Path, found: Results, language: str, tmp_path: Path) -> Shown:
    """Opens the report in a language."""
    with spoken_in(language):
        write_html(tmp_path / "report.html", report(found), folder)
    address = (tmp_path / "report.html").as_uri()
    return lambda device, colours="light": pages.open(address, device, colours=colours)


def test_a_phone_shows_the_whole_width_and_wide_things_slide_in_their_own_boxes(
    shown: Shown,
) -> None:
    page = shown("phone")
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    boxes = page.locator(".wide, .formula")
    wider = boxes.evaluate_all(
        "(all) => all.filter((one) => one.scrollWidth > one.clientWidth).map((one) => "
        "[one.firstElementChild.className, getComputedStyle(one).overflowX])"
    )
    assert len(wider) > 20
    assert {name for name, _overflow in wider} == {"numbers", ""}
    assert {overflow for _name, overflow in wider} == {"auto"}
    captions = page.locator("caption span").evaluate_all(
        "(all) => all.map((one) => one.getBoundingClientRect().right)"
    )
    assert max(captions) <= 390


def test_letters_in_figures_are_legible_and_contents_can_be_touched_on_a_phone(
    shown: Shown,
) -> None:
    page = shown("phone")
    figures = page.locator("figure img").evaluate_all(
        "(all) => all.map((one) => one.getBoundingClientRect().width / one.naturalWidth)"
    )
    assert len(figures) > 15
    # An inch of a picture of matplotlib has 72 points of type, and 96 pixels of its own.
    assert min(figures) * LEAST_TEXT * 96.0 / 72.0 > LEGIBLE
    heights = page.locator(".contents a").evaluate_all(
        "(all) => all.map((one) => one.getBoundingClientRect().height)"
    )
    assert len(heights) > 15
    assert min(heights) >= TOUCHED


def test_no_printed_page_but_the_last_is_half_empty_and_nothing_is_cut_off(
    shown: Shown,
) -> None:
    made = pypdfium2.PdfDocument(io.BytesIO(shown("desktop").pdf(prefer_css_page_size=True)))
    assert 10 < len(made) < 25
    for number, sheet in enumerate(made, start=1):
        assert sheet.get_size() == pytest.approx((210.0 * MM, 297.0 * MM), abs=1.0)
        dark = np.asarray(sheet.render().to_pil().convert("L")) < 200
        rows, columns = np.flatnonzero(dark.any(axis=1)), np.flatnonzero(dark.any(axis=0))
        assert columns.min() >= EDGE * MM, f"page {number}"
        assert columns.max() <= (210.0 - EDGE) * MM, f"page {number}"
        bottom = (297.0 - rows.max() / MM - 15.0) / (297.0 - 30.0)
        assert bottom < EMPTY or number == len(made), f"page {number}"


@needs_axe
def test_axe_finds_nothing_wrong_in_the_report(shown: Shown) -> None:
    assert violations(shown("phone")) == []
    assert violations(shown("desktop", "dark")) == []
