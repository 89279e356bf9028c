"""compute/roster_book.js: workbooks hold the same rows in the page as in Python."""

import random
import zipfile
from base64 import b64encode
from collections.abc import Callable
from datetime import date, datetime, time, timedelta
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
import xlsxwriter
from playwright.sync_api import Page

from benchdragon.errors import InputError
from benchdragon.inlining import inlined
from benchdragon.rosters.grid import read_rows
from tests.browser.pages import Pages
from tests.rosters.lists import Cells, ods_bytes, xlsx_bytes, zipped

READER = "compute/roster_book.js"
FORMATS = (
    "General", "@", "0", "0.0", "yyyy-mm-dd", "yyyy/m/d hh:mm", "hh:mm", "[h]:mm", '0"day"', r"\d0",
    "[Red]0", "# ?/?", "_d0", "m/d;@", "AM/PM", "[$-804]aaaa", "mm:ss",
)  # fmt: skip
NUMBERS = (0, 1, 5.0, 2.5, 0.25, 46000, 46000.75, 59, 60, 61, 13800000001, 1.5e-7, 1e22, -3, 0.5)
TEXTS = (
    "张三",
    "李 四、王五",
    " 赵六 ",
    "a & b < c",
    "x\ty",
    "两\n行",
    "",
    "1.38E+10",
    "\u3000钱\u3000",
)
ODD = (True, False, date(2026, 3, 5), datetime(2026, 3, 5, 9, 30), time(8, 30), timedelta(hours=30))
SEEDS = 40


@pytest.fixture
def reader(pages: Pages) -> Page:
    """A page in which the reader of workbooks stands."""
    page = pages.open("data:text/html,<title>rows</title>")
    page.evaluate(
        f"globalThis.sheetsOf = (() => {{ {inlined(READER)}\n return sheetsOf; }})();"
        "globalThis.rowsIn = ({ data, name }) => {"
        "  const bytes = Uint8Array.from(atob(data), (sign) => sign.charCodeAt(0));"
        "  try { return sheetsOf(bytes.buffer, name); } catch (error) { return error.message; }"
        "}; undefined"
    )
    return page


def there(page: Page, data: bytes, name: str = "a.xlsx") -> Any:
    """The sheets that the page finds, or what it says."""
    return page.evaluate("rowsIn", {"data": b64encode(data).decode(), "name": name})


def here(folder: Path, data: bytes, sheet: str = "", name: str = "a.xlsx") -> Any:
    """The rows that Python finds, or what it says."""
    (folder / name).write_bytes(data)
    try:
        return read_rows(folder / name, sheet)
    except InputError as error:
        return str(error)


def random_book(seed: int) -> bytes:
    """A sheet with all kinds of cells, some of them joined, from any place on."""
    dice = random.Random(seed)
    file = BytesIO()
    book = xlsxwriter.Workbook(
        file,
        {
            "in_memory": True,
            "date_1904": dice.random() < 0.2,
            "default_date_format": "yyyy-mm-dd",
            "remove_timezone": True,
        },
    )
    formats = [book.add_format({"num_format": one}) for one in FORMATS]
    sheet = book.add_worksheet("a > b")
    first = dice.randrange(3)
    for row in range(first, first + dice.randrange(1, 12)):
        for column in range(dice.randrange(2), 5):
            put(sheet, row, column, dice, dice.choice(formats))
    for column in range(6, 6 + dice.randrange(3)):
        top = dice.randrange(first, first + 4)
        sheet.merge_range(top, column, top + dice.randrange(1, 4), column, dice.choice(TEXTS))
    book.close()
    return file.getvalue()


def put(sheet: Any, row: int, column: int, dice: random.Random, style: Any) -> None:
    """Any cell."""
    kind = dice.randrange(8)
    if kind == 0:
        sheet.write_blank(row, column, None, style)
    elif kind == 1:
        sheet.write(row, column, dice.choice(ODD))
    elif kind == 2:
        value = dice.choice((2, "a", True, "#DIV/0!", "名"))
        sheet.write_formula(row, column, "=1+1", style, value)
    elif kind == 3:
        bold = style
        sheet.write_rich_string(row, column, "王", bold, "五", "六")
    elif kind in (4, 5):
        sheet.write_number(row, column, dice.choice(NUMBERS), style)
    else:
        sheet.write_string(row, column, dice.choice(TEXTS))


def test_sheets_hold_the_same_rows(reader: Page, tmp_path: Path) -> None:
    for seed in range(SEEDS):
        data = random_book(seed)
        rows = here(tmp_path, data)
        found = there(reader, data)
        assert found == rows or [one["rows"] for one in found] == [rows], seed


SHEET = (
    '<?xml version="1.0"?><worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main">'
    "{}</worksheet>"
)


def changed(rows: Cells, path: str, way: Callable[[str], str]) -> bytes:
    """A workbook of rows with one part changed."""
    with zipfile.ZipFile(BytesIO(xlsx_bytes(rows))) as whole:
        parts = {one: whole.read(one).decode() for one in whole.namelist()}
    parts[path] = way(parts[path])
    return zipped(parts)


def sheet_of(cells: str) -> bytes:
    """A workbook whose sheet is written so."""
    return changed([["x"]], "xl/worksheets/sheet1.xml", lambda _text: SHEET.format(cells))


@pytest.mark.parametrize(
    "cells",
    [
        "<sheetData><row><c><v>1</v></c><c t='inlineStr'><is><t>张</t></is></c></row>"
        "<row><c/><c><v>2</v></c></row></sheetData>",
        "<sheetData><row r='2'><c r='B2' t='str'><f>A1</f><v>三</v></c></row></sheetData>",
        "<sheetData><row r='1'><c r='A1' t='inlineStr'><is><r><t>王</t></r><r><t>五</t></r>"
        "<rPh sb='0' eb='1'><t>WANG</t></rPh></is></c></row></sheetData>",
        "<sheetData><row r='1'><c r='A1' t='d'><v>2026-03-05T00:00:00</v></c></row></sheetData>",
        "<sheetData><row r='1'><c r='C1'><f>A1+1</f></c></row></sheetData>",
        "<sheetData><row r='1'><c r='ABC1'><v>1</v></c></row></sheetData>",
        "<sheetData><row r='30000'><c r='A30000'><v>1</v></c></row></sheetData>",
        "<sheetData><row r='1'><c r='1A'><v>1</v></c></row></sheetData>",
        "<sheetData><row r='1'><c r='A1'><v>1</v></c></row>",
        "<sheetData></sheetData>",
    ],
)  # fmt: skip
def test_a_sheet_written_otherwise_says_the_same(reader: Page, tmp_path: Path, cells: str) -> None:
    data = sheet_of(cells)
    rows = here(tmp_path, data)
    found = there(reader, data)
    assert found == rows or [one["rows"] for one in found] == [rows]


def test_files_that_are_no_workbooks_are_refused_as_python_does(reader: Page, tmp_path: Path) -> None:
    whole = xlsx_bytes([["桥号", "姓名"], [1, "张三"]])
    for data in (
        b"",
        whole[:500],
        whole[: len(whole) // 2] + bytes(50) + whole[len(whole) // 2 + 50 :],
        b"<html><table></table></html>",
        zipped({"word/document.xml": "<a/>"}),
        xlsx_bytes([[]]),
        changed([["x"]], "xl/workbook.xml", lambda text: text.replace("?>", "?><!DOCTYPE a []>", 1)),
        xlsx_bytes([["x" * 2000]]),
        xlsx_bytes([[1] * 90] * 1200),
    ):
        assert there(reader, data) == here(tmp_path, data)
    assert "that this page does not read: save it as XLSX" in there(reader, ods_bytes([["x"]]), "a.ods")
    assert "are read from .xlsx" in there(reader, whole, "a.pdf")


def test_sheets_that_are_hidden_or_empty_are_not_there(reader: Page, tmp_path: Path) -> None:
    rows: Cells = [["桥号", "姓名"], [1, "张三"]]
    nothing: Cells = []
    data = xlsx_bytes(rows, ("空", nothing), ("说明", [["别的"]]))
    found = there(reader, data)
    assert [one["name"] for one in found] == ["名单", "说明"]
    for one in found:
        assert one["rows"] == here(tmp_path, data, one["name"])

    def hide(text: str) -> str:
        return text.replace('<sheet name="说明"', '<sheet state="hidden" name="说明"')

    with zipfile.ZipFile(BytesIO(data)) as whole:
        parts = {one: whole.read(one).decode() for one in whole.namelist()}
    parts["xl/workbook.xml"] = hide(parts["xl/workbook.xml"])
    assert [one["name"] for one in there(reader, zipped(parts))] == ["名单"]
    assert there(reader, zipped(parts))[0]["rows"] == here(tmp_path, zipped(parts))
