"""The timetable as papers: what stands in them is what the plan says, in both languages."""

import re
import zipfile
from pathlib import Path

import pytest
from pypdf import PdfReader
from python_calamine import CalamineWorkbook

from benchdragon.analysis.beats import score_of
from benchdragon.analysis.check import check
from benchdragon.export.document import Paragraph, Table
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import read_plan
from benchdragon.rosters.roster import Roster
from benchdragon.sheets.briefing import Briefing
from benchdragon.sheets.timetable import (
    passings_of,
    printed_rows,
    tempo_text,
    timetable_document,
    write_timetable_pdf,
    write_timetable_xlsx,
)
from tests.analysis.test_timetable import HOLD, plan_with


@pytest.fixture(scope="module")
def briefing() -> Briefing:
    cue = {**HOLD, "text": "bow to the temple", "text_zh": "拜庙"}
    report = check(plan_with(cue, clock="18:30").without_square())
    return Briefing(report, Roster(), (), "2026-11-23", report.plan.sha256)


@pytest.mark.parametrize(
    ("language", "word", "other"), [("en", "bow to the", "拜"), ("zh", "拜庙", "bow")]
)
def test_a_pdf_holds_every_row(
    briefing: Briefing, tmp_path: Path, language: str, word: str, other: str
) -> None:
    path = tmp_path / "timetable.pdf"
    with spoken_in(language):
        write_timetable_pdf(path, briefing)
        rows = printed_rows(passings_of(briefing), briefing.clock, briefing.ground, briefing.marks)
    text = "".join("".join(page.extract_text().split()) for page in PdfReader(path).pages)
    assert word.replace(" ", "") in text
    assert other not in text
    for row in rows:
        for cell in row:
            assert "".join(cell.split()) in text
    assert "18:30:11" in text
    assert "Contents" not in text, "of one chapter there are none"
    assert "目录" not in text
    assert "".join(briefing.foot.split()) in text


def test_a_workbook_holds_times_in_seconds_too(briefing: Briefing, tmp_path: Path) -> None:
    path = tmp_path / "timetable.xlsx"
    write_timetable_xlsx(path, briefing)
    rows = CalamineWorkbook.from_path(path).get_sheet_by_index(0).to_python()
    assert rows[0][6:] == [
        "head (s from the start)", "sets out again after a stop (s from the start)",
        "tail (s from the start)",
    ]  # fmt: skip
    held = next(row for row in rows if row[0] == "bow to the temple")
    assert held[6:8] == pytest.approx([11.0, 16.0])
    assert all(row[7] == "" for row in rows[1:] if row[6] != "" and row is not held)
    times = [cell for row in rows[1:] for cell in row[6:] if cell != ""]
    assert len(times) > 3
    assert all(round(float(str(time)), 1) == time for time in times)
    assert briefing.foot in str(rows[-1][0])


def test_places_are_told_by_the_marks_of_the_chalk_plan(briefing: Briefing) -> None:
    passings = passings_of(briefing)
    rows = printed_rows(passings, briefing.clock, briefing.ground, briefing.marks)
    kinds = briefing.marks.kinds
    for row, place in zip(rows, passings, strict=True):
        first, *more = [int(number) for number in re.findall(r"\d+", row[2])]
        assert briefing.marks.s[first - 1] <= place.s + 0.01
        assert place.s <= briefing.marks.s[first] + 1e-9 if more else place.s + 0.01
    assert rows[0][2] == str(kinds.index("start") + 1)
    assert rows[-1][2] == str(len(kinds))
    bare = printed_rows(passings, briefing.clock, briefing.ground, None)
    assert {row[2] for row in bare} == {"-"}


def test_where_the_tail_comes_nowhere_its_column_is_left_out_and_it_is_said_why(tmp_path: Path) -> None:
    settings = "dragon.benches=40", "route.pitch=3", "route.start_turn=6", "walk.end=5"
    report = check(read_plan("spiral-in", settings))
    told = Briefing(report, Roster(), (), "2026-11-23", report.plan.sha256)
    document = timetable_document(told)
    (table,) = [block for block in document.blocks if isinstance(block, Table)]
    assert table.columns[-1] == "head"
    assert all(len(row) == len(table.columns) == len(table.widths) for row in table.rows)
    said = str([block.words for block in document.blocks if isinstance(block, Paragraph)])
    assert "before the tail comes as far" in said
    assert "-:" not in said


def test_it_is_said_which_handle_head_and_tail_count(briefing: Briefing, tmp_path: Path) -> None:
    said = str([b.words for b in timetable_document(briefing).blocks if isinstance(b, Paragraph)])
    assert "the tail with its last handle" in said
    write_timetable_xlsx(tmp_path / "timetable.xlsx", briefing)
    rows = CalamineWorkbook.from_path(tmp_path / "timetable.xlsx").get_sheet_by_index(0).to_python()
    assert any("the tail with its last handle" in str(row[0]) for row in rows)


def test_texts_of_cues_are_no_formulas_and_no_links(tmp_path: Path) -> None:
    said = ["=1+1", "http://example.org", "{=SUM(A1)}"]
    cues = [{"kind": "note", "at": 2.0 + n, "text": text} for n, text in enumerate(said)]
    report = check(plan_with(*cues).without_square())
    path = tmp_path / "timetable.xlsx"
    write_timetable_xlsx(path, Briefing(report, Roster(), (), "2026-11-23", report.plan.sha256))
    rows = CalamineWorkbook.from_path(path).get_sheet_by_index(0).to_python()
    assert set(said) <= {row[0] for row in rows}
    with zipfile.ZipFile(path) as book:
        sheet = book.read("xl/worksheets/sheet1.xml").decode()
        assert "<f>" not in sheet
        assert "hyperlink" not in sheet


def test_signs_of_cues_that_no_font_has_are_printed_by_their_code(tmp_path: Path) -> None:
    report = check(plan_with({"kind": "note", "at": 2.0, "text": "gong \U00010600"}).without_square())
    path = tmp_path / "timetable.pdf"
    write_timetable_pdf(path, Briefing(report, Roster(), (), "2026-11-23", report.plan.sha256))
    text = "".join(page.extract_text() for page in PdfReader(path).pages)
    assert "gong 〔U+10600〕" in text


def test_the_tempo_says_where_it_comes_from(briefing: Briefing) -> None:
    plan = briefing.plan
    score = score_of(plan, briefing.report.start, briefing.report.end)
    said = tempo_text(plan, score)
    assert said == "100 beats a minute: a step of 60 cm a beat at the head's speed"
    assert tempo_text(plan, score._replace(by_step=False)) == "100 beats a minute, as the plan says"
