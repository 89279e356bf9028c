"""The files of a chalk plan: they say what the plan says, to scale and whole, in both languages."""

import math
import re
import zipfile
from dataclasses import replace
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pypdf
import pypdfium2
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from python_calamine import CalamineWorkbook

from benchdragon.analysis.check import check
from benchdragon.analysis.ground import own_peg
from benchdragon.analysis.marks import ANGLE_STEP, LENGTH_STEP
from benchdragon.errors import InputError
from benchdragon.export.tiles import BORDER, Tiling
from benchdragon.figures.chalk import (
    AROUND,
    DIGIT_HEIGHT,
    POINT,
    ChalkDrawing,
    chalk_picture,
    number_box,
)
from benchdragon.figures.scale import Sheet
from benchdragon.figures.style import LEAST_TEXT
from benchdragon.i18n import spoken_in
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.schema import Plan, checked
from benchdragon.rosters.roster import Roster
from benchdragon.sheets.briefing import Briefing
from benchdragon.sheets.chalk import (
    FILES,
    chalk_document,
    chalk_drawing,
    edge_lengths,
    list_rows,
    write_chalk,
)
from benchdragon.sheets.options import ChalkOptions

MM = 25.4 / 72.0


def village(**more: Any) -> Plan:
    """Four benches that walk round a bend, beside a well; more keys are tables of the plan."""
    return checked(
        {
            "schema": 1,
            "meta": {"title": "Round the bend", "title_zh": "绕弯"},
            "dragon": {"benches": 4},
            "route": {
                "kind": "parts",
                "part": [{"kind": "line", "length": 12}, {"kind": "arc", "radius": 4, "angle": 180}],
                "at": [1.0, 2.0],
            },
            "walk": {"start": 9, "end": 24},
            "venue": {"rectangle": [30, 24], "centre": [8, 3]},
            "obstacle": [{"kind": "circle", "name": "well 井", "centre": [13, 6], "radius": 0.6}],
            **more,
        },
        "village",
    )


def briefed(plan: Plan) -> Briefing:
    return Briefing(check(plan), Roster(), (), "2026-11-23", plan.sha256)


@pytest.fixture(scope="module")
def briefing() -> Briefing:
    return briefed(village())


@pytest.fixture(scope="module")
def folders(briefing: Briefing, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The files in each language, on A3 at 1:100."""
    found = {}
    for language in ("en", "zh"):
        found[language] = tmp_path_factory.mktemp(language)
        with spoken_in(language):
            paths = write_chalk(briefing, found[language], ChalkOptions(paper="A3", scale=100.0))
        assert [path.name for path in paths] == list(FILES)
        assert all(path.exists() for path in paths)
    return found


@pytest.fixture(scope="module")
def drawing(briefing: Briefing) -> ChalkDrawing:
    return chalk_drawing(briefing)


def test_the_list_says_what_the_route_is_to_the_rounding(drawing: ChalkDrawing) -> None:
    marks = drawing.marks
    rows = list(list_rows(marks))
    assert [row[0] for row in rows] == list(range(1, len(marks) + 1))
    points = drawing.trail.route.point(marks.s)
    assert np.abs(marks.points - points).max() < 1e-9
    half = 0.5 * LENGTH_STEP + 1e-9
    for (x, y), line in zip(points.tolist(), rows, strict=True):
        row: Any = line
        assert abs(row[2] - (x - 1.0)) <= half
        assert abs(row[3] - (y - 2.0)) <= half
        assert abs(row[4] - math.hypot(x - 1.0, y - 2.0)) <= half
        turned = math.degrees(math.atan2(y - 2.0, x - 1.0)) - row[5]
        assert abs((turned + 180.0) % 360.0 - 180.0) <= 0.5 * ANGLE_STEP + 1e-9
        base = marks.bases["BC".index(row[6])]
        assert abs(row[7] - math.dist(base, (x, y))) <= half


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_pdf_prints_the_list(
    language: str, folders: dict[str, Path], drawing: ChalkDrawing
) -> None:
    reader = pypdf.PdfReader(folders[language] / "chalk.pdf")
    text = "\n".join(page.extract_text() for page in reader.pages)
    words = re.findall(r"-?[\d.]+|[BC]\b", text)
    for row in list_rows(drawing.marks):
        numbers = [f"{value:z.3f}" for value in row[1:5] if isinstance(value, float)]
        wanted = [str(row[0]), *numbers, f"{row[5]:.2f}", row[6], f"{row[7]:.3f}", f"{row[9]:.3f}"]
        assert any(words[n : n + 9] == wanted for n in range(len(words))), wanted
    assert (re.search(r"[一-鿿]", text) is not None) == (language == "zh")
    assert ("from the peg" in text) == (language == "en")
    assert "1:100" in text
    assert re.search(r"chalk-drawing\.pdf (is|是) A3", text)
    assert drawing.foot[:12] in text
    assert f"{math.ceil(1000.0 * drawing.marks.tape_error)} " in text


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_workbook_holds_the_list(
    language: str, folders: dict[str, Path], drawing: ChalkDrawing
) -> None:
    path = folders[language] / "chalk.xlsx"
    book = CalamineWorkbook.from_path(path)
    (head, *rows), about = (book.get_sheet_by_index(n).to_python() for n in range(2))
    assert sum("(m)" in str(cell) for cell in head) == 6
    assert sum("(°)" in str(cell) for cell in head) == 1
    for row, wanted in zip(rows, list_rows(drawing.marks), strict=True):
        assert row[:8] == list(wanted[:8])
        assert row[9] == wanted[9]
    assert [drawing.foot] in about
    assert (re.search(r"[一-鿿]", str(head)) is not None) == (language == "zh")
    with zipfile.ZipFile(path) as archive:
        assert 'pane xSplit="1" ySplit="1"' in archive.read("xl/worksheets/sheet1.xml").decode()


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_peg_and_the_directions_are_told_from_the_venues_edge(
    language: str, folders: dict[str, Path], drawing: ChalkDrawing
) -> None:
    # Peg at (1, 2); the venue is 30 m by 24 m about (8, 3).
    assert edge_lengths(drawing.marks.ground, drawing.obstacles) == pytest.approx(
        [22.0, 13.0, 8.0, 11.0]
    )
    reader = pypdf.PdfReader(folders[language] / "chalk.pdf")
    about = CalamineWorkbook.from_path(folders[language] / "chalk.xlsx").get_sheet_by_index(1)
    for text in (reader.pages[0].extract_text(), str(about.to_python())):
        assert re.search(r"22\.000.*13\.000.*8\.000.*11\.000", text, re.DOTALL)
        assert "You choose" not in text
        assert "自己定" not in text


def test_one_chooses_where_x_points_only_where_nothing_stands(briefing: Briefing) -> None:
    plan = village(venue={}, obstacle=[])
    free = chalk_drawing(briefed(plan))
    assert edge_lengths(free.marks.ground, free.obstacles) is None
    assert "You choose on the ground" in str(
        chalk_document(free, "", "2026-11-23", free.sheet(None, 200.0)).blocks
    )
    outside = chalk_drawing(briefed(village(chalk={"peg": [40.0, 3.0]})))
    assert edge_lengths(outside.marks.ground, outside.obstacles) is None
    assert "You choose" not in str(
        chalk_document(outside, "", "2026-11-23", outside.sheet(None, 200.0)).blocks
    )


def _numbers_on(path: Path) -> dict[str, FloatArray]:
    """Where the words of the first page of a PDF stand: their middles, mm from its corner."""
    page = pypdfium2.PdfDocument(path)[0]
    text = page.get_textpage()
    found = {}
    for n in range(text.count_rects()):
        left, bottom, right, top = text.get_rect(n)
        word = text.get_text_bounded(left, bottom, right, top).strip()
        found[word] = MM * 0.5 * np.array([left + right, bottom + top])
    return found


def test_the_drawing_is_to_scale(folders: dict[str, Path], drawing: ChalkDrawing) -> None:
    path = folders["en"] / "chalk-drawing.pdf"
    places = _numbers_on(path)
    # B and C stand at right angles as far from the peg: their names are set off alike.
    apart = places["C"] - places["B"]
    long = 10.0 * drawing.marks.reach
    assert apart == pytest.approx(10.0 * (drawing.marks.bases[1] - drawing.marks.bases[0]), abs=0.5)
    assert math.hypot(*apart) == pytest.approx(long * math.sqrt(2.0), abs=0.5)
    page = pypdf.PdfReader(path).pages[0]
    assert float(page.mediabox.width) * MM == pytest.approx(420.0, abs=0.01)
    contents = page.get_contents()
    assert contents is not None
    corners = re.findall(r"((?:-?[\d.]+ -?[\d.]+ [ml]\s+){4})h", contents.get_data().decode("latin-1"))
    sizes = [
        MM * np.ptp(np.array(re.findall(r"-?[\d.]+", one), dtype=float).reshape(4, 2), axis=0)
        for one in corners
    ]
    assert any(np.allclose(size, [300.0, 240.0], atol=0.01) for size in sizes)  # the venue
    assert any(np.allclose(size, [50.0, 2.0], atol=0.01) for size in sizes)  # the bar of 5 m


def shown_texts(drawing: ChalkDrawing, sheet: Sheet) -> list[tuple[Text, FloatArray]]:
    """The texts of a drawing, with left, bottom, right and top of each on the sheet, points."""
    figure = chalk_picture(drawing, sheet)
    figure.set_dpi(72.0)
    canvas: Any = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    # Agg's boxes are whole dots, and reach below the digits: the middle of each counts.
    return [
        (text, np.array(text.get_window_extent(renderer).padded(-1.0).extents))
        for text in figure.axes[0].texts
    ]


def is_number(text: Text) -> bool:
    return text.get_text().isdigit() and text.get_fontsize() == 7.0


def dots_of(drawing: ChalkDrawing, sheet: Sheet) -> FloatArray:
    """Where the marks lie on the sheet, points."""
    dots: FloatArray = sheet.place(drawing.marks.points) / MM
    return dots


def under(box: FloatArray, dots: FloatArray) -> bool:
    """Whether a box lies on any dot."""
    return bool(((dots > box[:2]) & (dots < box[2:])).all(axis=1).any())


@pytest.mark.parametrize(("every", "all_shown"), [(1.0, True), (0.1, False)])
def test_no_number_overlaps_another_number_a_name_or_a_mark(every: float, all_shown: bool) -> None:
    drawing = chalk_drawing(briefed(village(chalk={"every": every})))
    sheet = drawing.sheet("A3", 100.0)
    boxes = [box for text, box in shown_texts(drawing, sheet) if is_number(text)]
    assert (len(boxes) == len(drawing.marks)) == all_shown
    assert len(boxes) > 20
    for a, b in combinations(boxes, 2):
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
    dots = dots_of(drawing, sheet)
    assert not any(under(box, dots) for box in boxes)


def coiled() -> ChalkDrawing:
    """A dance whose coils are 4.5 mm apart on a small sheet."""
    route = {"kind": "spiral-in", "pitch": 0.9, "start_turn": 5}
    around = {"rectangle": [16, 16], "centre": [0, 0]}
    given = village(route=route, disc={"radius": 2.0}, walk={}, obstacle=[], venue=around)
    return chalk_drawing(briefed(given))


def test_a_number_is_nearest_to_its_own_mark() -> None:
    drawing = coiled()
    sheet = drawing.sheet("A4", 200.0)
    dots, shown = sheet.place(drawing.marks.points), 0
    for text, _box in shown_texts(drawing, sheet):
        if is_number(text):
            (x, low), own = text.get_position(), int(text.get_text()) - 1
            padded = number_box(text.get_text(), x, low + 0.5 * POINT * DIGIT_HEIGHT * LEAST_TEXT)
            box = padded + np.array([AROUND, AROUND, -AROUND, -AROUND])
            apart = np.hypot(*np.maximum(np.maximum(box[:2] - dots, dots - box[2:]), 0.0).T)
            assert int(np.argmin(apart)) == own
            of_other_coils = np.delete(apart, np.s_[max(own - 1, 0) : own + 2])
            assert of_other_coils.min() > 1.4 * apart[own]
            shown += 1
    assert 20 < shown < len(dots)


def with_peg(drawing: ChalkDrawing, x: float, y: float) -> ChalkDrawing:
    """The same with the peg elsewhere, m."""
    marks = drawing.marks
    return replace(drawing, marks=replace(marks, ground=replace(marks.ground, peg=(x, y))))


def test_names_of_peg_and_base_points_hide_no_mark_and_no_number_hides_them() -> None:
    drawing = coiled()
    x, y = drawing.marks.points[len(drawing.marks) // 2].tolist()
    moved = with_peg(drawing, x - 0.5, y - 0.3)
    sheet = moved.sheet("A4", 200.0)
    shown, dots = shown_texts(moved, sheet), dots_of(moved, sheet)
    names = [box for text, box in shown if text.get_text() in ("peg", "B", "C")]
    assert len(names) == 3
    assert not any(under(box, dots) for box in names)
    # Where a number would stand without the peg.
    number = next(text for text, _box in shown if is_number(text))
    n = int(number.get_text()) - 1
    (left, low), (u, v) = number.get_position(), sheet.place(moved.marks.points[[n]])[0].tolist()
    x, y = moved.marks.points[n].tolist()
    there = with_peg(drawing, x + 0.2 * (left - u), y + 0.2 * (low + 0.9 - v))
    spots = there.sheet("A4", 200.0).place(np.array([there.marks.peg])) / MM
    numbers = [box for text, box in shown_texts(there, sheet) if is_number(text)]
    assert len(numbers) > 20
    assert not any(under(box, spots) for box in numbers)


def test_the_peg_is_the_centre_of_the_route_where_it_is_danced() -> None:
    plan = village()
    assert own_peg(plan, plan.build().route) == (1.0, 2.0)
    spiral = {"kind": "spiral-in", "at": [3.0, -1.0]}
    plan = checked({"schema": 1, "dragon": {"benches": 4}, "route": spiral}, "spiral")
    assert own_peg(plan, plan.build().route) == pytest.approx((3.0, -1.0))
    told = plan.with_value("chalk.peg", [0.5, 7.0])
    assert own_peg(told, told.build().route) == (0.5, 7.0)


def test_bearings_are_from_north_only_where_a_survey_tells_it(briefing: Briefing) -> None:
    assert not chalk_drawing(briefing).marks.north
    plan = village(survey={"crs": "wgs84", "origin": [120.0, 30.0]}, chalk={"peg": [0.0, 0.0]})
    marks = chalk_drawing(briefed(plan)).marks
    assert marks.north
    x, y = marks.points.T
    assert marks.radius * np.sin(np.radians(marks.angle)) == pytest.approx(x, abs=1e-9)
    assert marks.radius * np.cos(np.radians(marks.angle)) == pytest.approx(y, abs=1e-9)


def test_a_paper_that_is_too_small_and_one_that_is_not_known_are_refused(
    briefing: Briefing, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="does not fit A4 at 1:100"):
        write_chalk(briefing, tmp_path, ChalkOptions(paper="A4", scale=100.0))
    with pytest.raises(InputError, match="from 1:50 to 1:500, not 1:1000"):
        write_chalk(briefing, tmp_path, ChalkOptions(scale=1000.0))
    with pytest.raises(InputError, match="paper must be one of A4, A3, A2, A1, A0, not B5"):
        write_chalk(briefing, tmp_path, ChalkOptions(tile="B5"))
    assert not list(tmp_path.iterdir())


def test_the_paper_is_the_smallest_at_which_one_can_read(drawing: ChalkDrawing) -> None:
    assert drawing.sheet(None, None).scale == 100.0
    assert sorted((drawing.sheet(None, None).width, drawing.sheet(None, None).height)) == [297.0, 420.0]
    large = drawing.sheet(None, 50.0)
    assert sorted((large.width, large.height)) == [594.0, 841.0]
    as_large = drawing.sheet(None, 200.0)
    assert sorted((as_large.width, as_large.height)) == [210.0, 297.0], (
        "A4 where it is as large on that"
    )


def test_tiles_put_together_are_the_drawing(folders: dict[str, Path]) -> None:
    scale = 2.0
    whole_page = pypdfium2.PdfDocument(folders["en"] / "chalk-drawing.pdf")[0]
    whole = whole_page.render(scale=scale).to_numpy().min(axis=2)
    pages = pypdfium2.PdfDocument(folders["en"] / "chalk-tiles.pdf")
    tiling = Tiling.of((420.0, 297.0), (210.0, 297.0))
    windows = list(tiling.windows())
    assert len(pages) == len(windows) + 1
    joined = np.full_like(whole, 255)
    seen = np.zeros(whole.shape, dtype=int)
    dots = scale / MM
    for n, one in enumerate(windows, start=1):
        page = pages[n].render(scale=scale).to_numpy().min(axis=2)
        wide, tall = (int(side * dots) for side in tiling.window)
        border = round(BORDER * dots)
        part = page[border : border + tall, border : border + wide]
        left, top = round(one.x * dots), round((297.0 - one.y - tiling.window[1]) * dots)
        room = joined[top : top + tall, left : left + wide]
        room[:] = np.minimum(room, part[: room.shape[0], : room.shape[1]])
        seen[top : top + tall, left : left + wide] += 1
    assert seen.min() >= 1
    assert seen.max() == 4
    dark, found = whole < 128, joined < 192
    # Lines may fall a dot aside.
    near = np.zeros_like(found)
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            near |= np.roll(found, (dy, dx), axis=(0, 1))
    assert dark.sum() > 2000
    assert (dark & ~near).sum() == 0


@pytest.mark.parametrize("size", [(841.0, 594.0), (1189.0, 841.0), (420.0, 297.0), (100.0, 100.0)])
def test_windows_cover_a_drawing_and_overlap(size: tuple[float, float]) -> None:
    tiling = Tiling.of(size, (210.0, 297.0))
    windows, (wide, tall) = list(tiling.windows()), tiling.window
    assert len({one.name for one in windows}) == len(windows) == tiling.count
    assert windows[0].name == "A1"
    xs = sorted({one.x for one in windows})
    ys = sorted({one.y for one in windows})
    assert xs[0] <= 0.0
    assert ys[0] <= 0.0
    assert xs[-1] + wide >= size[0]
    assert ys[-1] + tall >= size[1]
    assert all(b - a == pytest.approx(wide - 10.0) for a, b in pairwise(xs))
    assert all(b - a == pytest.approx(tall - 10.0) for a, b in pairwise(ys))


def test_how_long_the_marks_take_is_told_by_their_number() -> None:
    drawing = chalk_drawing(briefed(village(chalk={"every": 0.25})))
    text = str(chalk_document(drawing, "", "2026-11-23", drawing.sheet(None, 200.0)).blocks)
    told = re.search(
        r"need (\S+) to (\S+) minutes a mark, which is an assumption, take (\S+) to (\S+) hours", text
    )
    assert told is not None
    fast, slow, least, most = map(float, told.groups())
    for minutes, hours in ((fast, least), (slow, most)):
        assert 0.0 <= hours - len(drawing.marks) * minutes / 60.0 < 0.5
    assert 1.0 < least < most
    assert "write every = 0.5 below [chalk]" in text
    assert f"take {math.ceil(len(drawing.marks) / 10)} times as long" in text
