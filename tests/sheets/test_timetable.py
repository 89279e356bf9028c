"""The timetable as papers: what stands in them is what the plan says, in both languages."""

import zipfile
from pathlib import Path

import pytest
from pypdf import PdfReader
from python_calamine import CalamineWorkbook

from benchdragon.analysis.beats import score_of
from benchdragon.analysis.check import check
from benchdragon.i18n import spoken_in
from benchdragon.rosters.roster import Roster
from benchdragon.sheets.briefing import Briefing
from benchdragon.sheets.timetable import (
    passings_of,
    printed_rows,
    tempo_text,
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
        rows = printed_rows(passings_of(briefing), briefing.clock, briefing.ground)
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
    assert rows[0][5:] == [
        "head (s from the start)", "goes on (s from the start)", "tail (s from the start)",
    ]  # fmt: skip
    held = next(row for row in rows if row[0] == "bow to the temple")
    assert held[5:7] == pytest.approx([11.0, 16.0])
    assert briefing.foot in str(rows[-1][0])


def test_texts_of_cues_are_no_formulas_and_no_links(tmp_path: Path) -> None:
    said = ["=1+1", "http://example.org", "{=SUM(A1)}"]
    cues = [{"kind": "note", "at": 2.0 + n, "text": text} for n, text in enumerate(said)]
    report = check(plan_with(*cues).without_square(), quick=True)
    path = tmp_path / "timetable.xlsx"
    write_timetable_xlsx(path, Briefing(report, Roster(), (), "2026-11-23", report.plan.sha256))
    rows = CalamineWorkbook.from_path(path).get_sheet_by_index(0).to_python()
    assert set(said) <= {row[0] for row in rows}
    with zipfile.ZipFile(path) as book:
        sheet = book.read("xl/worksheets/sheet1.xml").decode()
        assert "<f>" not in sheet
        assert "hyperlink" not in sheet


def test_signs_of_cues_that_no_font_has_are_printed_by_their_code(tmp_path: Path) -> None:
    report = check(
        plan_with({"kind": "note", "at": 2.0, "text": "gong \U00010600"}).without_square(), quick=True
    )
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
