"""Files that are torn, too large or of another kind, as strangers send them."""

import io
import random
import zipfile
from pathlib import Path

import pytest

from benchdragon.errors import InputError
from benchdragon.rosters import extent, grid
from benchdragon.rosters.grid import OLE, read_rows
from benchdragon.rosters.reading import Numbering, read_roster
from tests.rosters.lists import CONTENT, Cells, csv_bytes, ods_bytes, xlsx_bytes, zipped

SMALL: Cells = [
    ["桥号", "姓名", "电话"],
    [1, "张三、李四", 13800000001],
    [2, "王五", ""],
    ["龙尾", "赵六", ""],
]
TEN = Numbering(10, True, lambda bench: f"bench {bench}")
CELL = '<table:table-cell{more} office:value-type="string"><text:p>{text}</text:p></table:table-cell>'
MAIN = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'


def refused(path: Path, data: bytes, sheet: str = "") -> str:
    """The one sentence with which a file is refused."""
    path.write_bytes(data)
    with pytest.raises(InputError) as told:
        read_roster(path, TEN, sheet)
    assert path.name in str(told.value)
    assert "\n" not in str(told.value)
    return str(told.value)


def test_500_torn_files_end_in_a_roster_or_one_sentence(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    chance = random.Random(19)
    whole = {
        "a.xlsx": xlsx_bytes(SMALL),
        "a.ods": ods_bytes(SMALL),
        "a.csv": csv_bytes(SMALL, "gb18030"),
    }
    read = 0
    for n in range(500):
        name = chance.choice(list(whole))
        data = bytearray(whole[name])
        if n % 3 == 0:
            data = data[: chance.randrange(len(data))]
        for _time in range(chance.randrange(1, 20) if n % 3 else 0):
            data[chance.randrange(len(data))] = chance.randrange(256)
        (tmp_path / name).write_bytes(data)
        try:
            read_roster(tmp_path / name, TEN)
            read += 1
        except InputError as error:
            assert "\n" not in str(error)  # noqa: PT017 - some files are read
    assert 0 < read < 500
    assert capfd.readouterr().err == ""


def test_parts_of_workbooks_that_are_torn_inside_a_sound_archive(tmp_path: Path) -> None:
    chance = random.Random(20)
    cells = "".join(CELL.format(more="", text=text) for text in ("1", "张三"))
    rows = f"<table:table-row>{cells}</table:table-row>" * 3
    text = CONTENT.format(tables=f'<table:table table:name="x">{rows}</table:table>')
    for _time in range(100):
        signs = list(text)
        for _sign in range(chance.randrange(1, 4)):
            signs[chance.randrange(len(signs))] = chance.choice('<>&"/=x0\u9fff')
        path = tmp_path / "a.ods"
        path.write_bytes(
            zipped(
                {
                    "mimetype": "application/vnd.oasis.opendocument.spreadsheet",
                    "content.xml": "".join(signs),
                }
            )
        )
        try:
            read_roster(path, TEN)
        except InputError as error:
            assert "\n" not in str(error)  # noqa: PT017 - some files are read


def test_two_cells_in_far_corners_are_refused_before_room_is_made_for_all_between(
    tmp_path: Path,
) -> None:
    sheet = (
        f'<worksheet {MAIN}><sheetData><row r="1"><c r="A1"><v>1</v></c></row>'
        '<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData></worksheet>'
    )
    said = refused(tmp_path / "a.xlsx", zipped({"xl/worksheets/sheet1.xml": sheet}))
    assert "too large for a list of names" in said
    sheet = sheet.replace("XFD1048576", "A18446744073709551615")
    said = refused(tmp_path / "a.xlsx", zipped({"xl/worksheets/sheet1.xml": sheet}))
    assert "torn, or no workbook" in said


def test_cells_far_below_are_seen_where_rows_do_not_say_so(tmp_path: Path) -> None:
    cells = '<row><c r="A1"><v>1</v></c></row><row><c r="A1048576"><v>1</v></c></row>'
    sheet = f"<worksheet {MAIN}><sheetData>{cells}</sheetData></worksheet>"
    said = refused(tmp_path / "a.xlsx", zipped({"xl/worksheets/sheet1.xml": sheet}))
    assert "too large" in said


@pytest.mark.parametrize(
    "row",
    [
        "<table:table-row>" + CELL.format(more=' table:number-columns-repeated="2000000000"', text="1")
        + "</table:table-row>",
        '<table:table-row table:number-rows-repeated="2000000000">' + CELL.format(more="", text="1")
        + "</table:table-row>",
        '<table:table-row table:number-rows-repeated="30000"/><table:table-row>'
        + CELL.format(more="", text="1") + "</table:table-row>",
        '<table:table-row><table:table-cell table:number-columns-repeated="16000"/>'
        + CELL.format(more="", text="1") + "</table:table-row>",
        '<table:table-row table:number-rows-repeated="19000">' + 10 * CELL.format(more="", text="1")
        + "</table:table-row>",
        "<table:table-row>" + CELL.format(more="", text="x" * 1001) + "</table:table-row>",
        '<table:table-row table:number-rows-repeated="-1">' + CELL.format(more="", text="1")
        + "</table:table-row>",
    ],
)  # fmt: skip
def test_cells_that_are_repeated_too_often(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, row: str
) -> None:
    monkeypatch.setattr(grid, "load_workbook", None)  # they are refused before it is asked
    assert "too large" in refused(tmp_path / "a.ods", ods_bytes(SMALL, row))


def test_empty_cells_to_the_end_of_the_sheet_are_no_reason_to_refuse(tmp_path: Path) -> None:
    tail = (
        '<table:table-row table:number-rows-repeated="1048570">'
        '<table:table-cell table:number-columns-repeated="16384"/></table:table-row>'
    )
    (tmp_path / "a.ods").write_bytes(ods_bytes(SMALL, tail))
    assert sorted(read_roster(tmp_path / "a.ods", TEN).benches) == [1, 2, 10]


def test_an_archive_that_unpacks_to_too_much(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extent, "MOST_UNPACKED", 100_000)
    bomb = zipped({"xl/worksheets/sheet1.xml": "<worksheet/>", "xl/media/image1.bin": "0" * 100_000})
    assert len(bomb) < 1000
    assert "too large" in refused(tmp_path / "a.xlsx", bomb)


def test_a_shared_text_that_is_too_long(tmp_path: Path) -> None:
    data = zipped({"xl/sharedStrings.xml": f"<sst {MAIN}><si><t>{'x' * 1001}</t></si></sst>"})
    assert "too large" in refused(tmp_path / "a.xlsx", data)


def test_a_count_for_which_room_would_be_made(tmp_path: Path) -> None:
    for count in ("99999999999", "2000000", "+9999999"):
        data = zipped(
            {"xl/sharedStrings.xml": f'<sst {MAIN} uniqueCount="{count}"><si><t>x</t></si></sst>'}
        )
        assert "torn" in refused(tmp_path / "a.xlsx", data)


def test_entities_and_depth(tmp_path: Path) -> None:
    dtd = '<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>'
    assert "torn" in refused(tmp_path / "a.xlsx", zipped({"xl/workbook.xml": dtd}))
    deep = "<a>" * 1000 + "</a>" * 1000
    assert "too large" in refused(tmp_path / "a.xlsx", zipped({"xl/workbook.xml": deep}))


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("a.csv", b"", "is empty"),
        ("a.csv", b" \r\n\n", "is empty"),
        ("a.csv", b",,\n,,\n", "is empty"),
        ("a.xlsx", b"", "is empty"),
        ("a.xlsx", xlsx_bytes([]), "is empty"),
        ("a.xlsx", b"<html><table></table></html>", "torn, or no workbook"),
        ("a.xlsx", zipped({"word/document.xml": "<a/>"}), "torn, or no workbook"),
        ("a.xlsx", OLE + 100 * b"\0", "old workbook"),
        ("a.xlsx", OLE + "EncryptedPackage".encode("utf-16-le"), "password"),
        ("a.csv", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "no table of text"),
        ("a.csv", b"\xff\xfe\xff", "no table of text"),
        ("a.csv", b"1,A\n2,B\x07\n", "line 2 has a control sign (U+0007)"),
        ("a.csv", b'1,"' + b"x" * 200_000, "no table of text"),
        ("a.csv", b"1," + b"x" * 2000, "too large"),
        ("a.csv", b"1," * 200, "too large"),
        ("a.csv", b"1,x\n" * 20_001, "too large"),
        ("a.pdf", b"%PDF", "lists of names are read from"),
    ],
    ids=lambda value: value[:20] if isinstance(value, str) else "file",
)  # fmt: skip
def test_other_files_are_refused_in_a_sentence(
    tmp_path: Path, name: str, data: bytes, said: str
) -> None:
    assert said in refused(tmp_path / name, data)


def test_a_file_that_is_not_there_or_is_a_folder(tmp_path: Path) -> None:
    (tmp_path / "b.csv").mkdir()
    for name in ("a.csv", "b.csv"):
        with pytest.raises(InputError, match=f"there is no file {name} beside the plan"):
            read_rows(tmp_path / name)


def test_sheets_of_a_workbook(tmp_path: Path) -> None:
    data = xlsx_bytes(SMALL, ("空", []), ("说明", [["别的"]]))
    said = refused(tmp_path / "a.xlsx", data)
    assert "several sheets: choose one by the key people.sheet: 名单, 空, 说明" in said
    assert sorted(read_roster(tmp_path / "a.xlsx", TEN, "名单").benches) == [1, 2, 10]
    assert "no sheet called 'x'; it has 名单" in refused(tmp_path / "a.xlsx", data, "x")
    assert "has no sheets" in refused(tmp_path / "a.csv", csv_bytes(SMALL), "名单")


def test_formulas_without_a_value_are_refused_and_others_read(tmp_path: Path) -> None:
    rows: Cells = [["桥号", "姓名"], [1, "张三"], ["=A2+1", "王五"]]
    whole = zipfile.ZipFile(io.BytesIO(xlsx_bytes(rows)))
    for value, kind in (("", ""), ("2", ""), ("", ' t="str"')):
        cell = f'<c r="A3"{kind}><f>A2+1</f><v>{value}</v></c>'
        parts = {
            name: whole.read(name).decode().replace('<c r="A3"><f>A2+1</f><v>0</v></c>', cell)
            for name in whole.namelist()
        }
        assert any(cell in text for text in parts.values())
        if value or kind:
            (tmp_path / "a.xlsx").write_bytes(zipped(parts))
            found = read_roster(tmp_path / "a.xlsx", TEN)
            assert [one.name for one in found.people(2 if value else 1)][-1] == "王五"
        else:
            said = refused(tmp_path / "a.xlsx", zipped(parts))
            assert "row 3, column 1 is a formula without a value" in said
    name = '<table:table-cell office:value-type="string"><text:p>李四</text:p></table:table-cell>'
    sum_cell = '<table:table-cell table:formula="of:=[.A2]+1"{more}/>'
    for more in ("", ' office:value-type="float" office:value="2"'):
        tail = f"<table:table-row>{sum_cell.format(more=more)}{name}</table:table-row>"
        data = ods_bytes(rows[:2], tail)
        if more:
            (tmp_path / "a.ods").write_bytes(data)
            assert read_roster(tmp_path / "a.ods", TEN).people(2)[0].name == "李四"
        else:
            assert "row 3, column 1" in refused(tmp_path / "a.ods", data)


def test_too_many_people(tmp_path: Path) -> None:
    rows: Cells = [["bench", "name"], *[["1-10", "甲乙 丙丁 戊己"]] * 2000]
    assert "names more than 50000 people" in refused(tmp_path / "a.csv", csv_bytes(rows))
    rows = [["bench", "name"], *[[1, f"人{n}"] for n in range(300)]]
    assert "more than 200 people at bench 1" in refused(tmp_path / "a.csv", csv_bytes(rows))
