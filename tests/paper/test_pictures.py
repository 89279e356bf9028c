"""The pictures of the report: drawn at the size of print, and what they mark is what was found."""

import io
import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from pypdf import PdfReader

from benchdragon.export.document import Formula
from benchdragon.export.publish import drawn_formula
from benchdragon.figures.contact import clearance_picture
from benchdragon.figures.style import LEAST_TEXT, PAGE_WIDTH
from benchdragon.paper.evidence_figures import first_seen, latest_step
from benchdragon.paper.report import report
from benchdragon.paper.reproduce import PICTURES, TURNING, all_figures
from benchdragon.paper.results import CONTACT_STEPS, Results
from benchdragon.paper.traversal import first_overlap
from benchdragon.paper.turn_figures import TIMED_HANDLES, turn_speeds_picture
from benchdragon.plans.schema import read_plan

pytestmark = pytest.mark.xdist_group("paper")

# Inches of text on an A4 page.
PAGE_HEIGHT = 10.5


@pytest.fixture(scope="module")
def figures(found: Results) -> dict[str, Figure]:
    return all_figures(found)


def text_sizes(file: Path | io.BytesIO) -> set[float]:
    """Sizes of all text of a PDF file as it is printed, in points."""
    sizes: set[float] = set()

    def visit(text: str, cm: list[float], tm: list[float], _font: object, size: float) -> None:
        if text.strip():
            scale = math.sqrt(abs(tm[0] * tm[3] - tm[1] * tm[2]) * abs(cm[0] * cm[3] - cm[1] * cm[2]))
            sizes.add(round(scale * size, 3))

    for page in PdfReader(file).pages:
        page.extract_text(visitor_text=visit)
    return sizes


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_takes_less_than_half_a_page_and_no_word_is_too_small(
    folder: Path, name: str
) -> None:
    box = PdfReader(folder / f"{name}.pdf").pages[0].mediabox
    assert float(box.width) <= 72.0 * PAGE_WIDTH + 0.1
    assert float(box.height) < 0.5 * 72.0 * PAGE_HEIGHT
    sizes = text_sizes(folder / f"{name}.pdf")
    assert sizes
    assert min(sizes) >= LEAST_TEXT - 1e-3


def test_no_lone_title_repeats_a_caption(figures: dict[str, Figure]) -> None:
    titles = {name: sum(bool(panel.get_title()) for panel in one.axes) for name, one in figures.items()}
    assert set(titles) == set(PICTURES)
    assert 1 not in titles.values()


def test_no_sign_of_a_formula_is_too_small(found: Results) -> None:
    formulas = [block for block in report(found).blocks if isinstance(block, Formula)]
    assert len(formulas) >= 10
    for formula in formulas:
        file, width = drawn_formula(formula, "pdf")
        assert width < PAGE_WIDTH - 0.4, formula.text
        assert min(text_sizes(io.BytesIO(file))) >= LEAST_TEXT - 1e-3, formula.text


def marked(figure: Figure, panel: int, marker: str) -> list[tuple[float, float]]:
    """The places of all marks of a kind in a panel."""
    lines = [line for line in figure.axes[panel].lines if line.get_marker() == marker]
    return [(float(x), float(y)) for line in lines for x, y in np.asarray(line.get_xydata())]


def words(figure: Figure) -> str:
    from matplotlib.text import Text

    return " ".join(text.get_text() for text in figure.findobj(Text) if isinstance(text, Text))


def test_the_greatest_ratio_is_marked_in_both_panels(
    found: Results, figures: dict[str, Figure]
) -> None:
    figure, peak = figures["turn-ratio"], 2.0 / found.head_speed.value
    for panel in (0, 1):
        ((time, ratio),) = marked(figure, panel, "D")
        assert (time, ratio) == pytest.approx((found.turn_greatest_at, peak), abs=1e-6)
        drawn = max(float(np.max(np.asarray(line.get_ydata()))) for line in figure.axes[panel].lines)
        assert drawn == pytest.approx(peak, abs=1e-9)
    assert "1.6048" in words(figure)
    assert "handles 3 to 7" in words(figure)


def test_speeds_in_the_turn_are_drawn_at_their_extremes_with_the_joints_named() -> None:
    motion = read_plan("turn").motion(np.arange(*TURNING))
    over, along = turn_speeds_picture(motion).axes
    for line, handle in zip(over.lines, TIMED_HANDLES, strict=False):
        assert np.array_equal(line.get_xydata(), np.c_[motion.times, motion.speed[:, handle]])
    joints = {text.get_text(): text.get_position()[0] for text in over.texts}
    assert joints == pytest.approx({"$A$": 0.0, "$C$": 9.080830, "$B$": 13.621245}, abs=1e-6)
    lowest, highest, later = (np.asarray(line.get_ydata()) for line in along.lines)
    assert (lowest.min(), highest.max()) == (motion.speed.min(), motion.speed.max())
    assert len(lowest) == len(highest) == len(later) == 224
    said = words(turn_speeds_picture(motion))
    assert said.count("t = ") == 3
    assert "t = 14.48 s" in said


def test_the_papers_third_figure_carries_its_letters(figures: dict[str, Figure]) -> None:
    said = words(figures["turn-disc"])
    for letter in ("A", "B", "C", "C_1", "C_2", "r_1", "r_2", "l_1", "l_2", r"\alpha", r"\varphi"):
        assert f"${letter}$" in said, letter


def test_the_marks_at_the_smallest_pitch_lie_on_the_curve(
    found: Results, figures: dict[str, Figure]
) -> None:
    curve, pitch = found.curve, found.smallest.value
    known = dict(zip((100.0 * curve.pitch).tolist(), curve.least_angle.tolist(), strict=True))
    (above, below) = marked(figures["pitch"], 0, "o")
    assert above[1] == known[max(size for size in known if size < 100.0 * pitch)]
    assert below[1] == known[min(size for size in known if size > 100.0 * pitch)]
    disc = float(np.interp(pitch, curve.pitch, curve.disc_angle))
    assert above[1] > disc > below[1]
    assert above[0] == below[0] == pytest.approx(100.0 * pitch)


def test_the_clearance_marks_valleys_alone_and_enlarges_the_near_misses(found: Results) -> None:
    figure = clearance_picture(found.clearance)
    curve = found.clearance
    valleys = marked(figure, 0, ".")
    assert 20 < len(valleys) < len(curve.minima)
    for time, low in valleys:
        near = np.abs(curve.times - time) < 14.0
        peaks = [
            100.0 * curve.clearance[near & side].max()
            for side in (curve.times < time, curve.times > time)
        ]
        assert min(peaks) > low + 0.3
    inset = figure.axes[0].child_axes[0]
    texts = [text.get_text() for text in inset.texts]
    assert texts == ["2.96 mm", "0.865 mm"]
    for panel in (figure.axes[0], inset):
        line, dots = panel.lines[:2]
        drawn = {tuple(place) for place in np.asarray(line.get_xydata()).tolist()}
        assert {tuple(place) for place in np.asarray(dots.get_xydata()).tolist()} <= drawn
        assert (np.diff(np.asarray(line.get_xdata())) >= 0.0).all()


def test_stepped_searches_see_the_first_multiple_in_a_window(found: Results) -> None:
    windows = found.windows
    assert [opens for opens, _closes in windows] == pytest.approx([412.474, 415.374, 418.211], abs=1e-3)
    assert [closes for _opens, closes in windows[:-1]] == pytest.approx([415.016, 418.110], abs=1e-3)
    assert dict(found.stepped) == pytest.approx(
        {step: first_seen(step, windows) for step in CONTACT_STEPS}
    )
    walk = found.motion.walk
    for step, late in ((4.152, 6.878), (latest_step(windows, 10.0)[0], 8.534)):
        seen = first_seen(step, windows)
        assert first_overlap(walk, np.arange(0.0, 425.0, step)) == pytest.approx(seen)
        assert seen - windows[0][0] == pytest.approx(late, abs=1e-3)
        assert seen - windows[0][0] > 1.5 * step


def test_the_separating_axes_have_the_gap_between_the_projections(figures: dict[str, Figure]) -> None:
    panel = figures["geometry-axes"].axes[0]
    bars = sorted(
        sorted(np.asarray(line.get_ydata()).tolist())
        for line in panel.lines
        if line.get_linewidth() == 5.0
    )
    (_low, top), (bottom, _high) = bars
    assert 0.0 < bottom - top < 0.2
