"""Workbooks as others write them: read wherever rows and columns stand, and refused in one sentence."""

import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
import xlsxwriter

from benchdragon.errors import InputError
from benchdragon.export.tables import Selection, write_moment_xlsx, write_xlsx
from benchdragon.kernels.curve import FloatArray
from benchdragon.paper import workbook as reading
from benchdragon.paper.workbook import HANDLES, Workbook, read_workbook
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent
from tests.paper.workbooks import CONTACT, NAMES, held, values, values_at, write_moment, write_series

TIMES = np.array([-1.0, 0.0, 2.5])
Rows = list[list[object]]


def rounded(found: FloatArray, exact: FloatArray) -> bool:
    """Whether numbers are those of a table, to six decimals."""
    return np.allclose(found, exact, rtol=0.0, atol=5.1e-7)


@pytest.fixture(scope="module")
def table() -> FloatArray:
    return values_at("result4", TIMES)


def written(path: Path, sheets: dict[str, Rows]) -> Path:
    book = xlsxwriter.Workbook(path)
    for name, rows in sheets.items():
        sheet = book.add_worksheet(name)
        for i, row in enumerate(rows):
            sheet.write_row(i, 0, row)
    book.close()
    return path


def rows_of(table: FloatArray) -> tuple[Rows, Rows]:
    """Rows of positions and of speeds, with a header, as the templates have them."""
    header: list[object] = ["", *(f"{t:g} s" for t in TIMES)]
    places = [[f"{name}{axis} (m)", *table["xy".index(axis), :, n].tolist()]
              for n, name in enumerate(NAMES) for axis in "xy"]  # fmt: skip
    speeds = [[f"{name} (m/s)", *table[2, :, n].tolist()] for n, name in enumerate(NAMES)]
    return [header, *places], [header, *speeds]


def test_the_templates_layout_is_read(tmp_path: Path) -> None:
    table = values("result1").copy()
    table[:, 5, 3] = np.nan
    found = read_workbook(write_series(tmp_path / "a.xlsx", table, range(270, 301)))
    assert found.times is not None
    assert found.times.tolist() == list(range(270, 301))
    assert found.values.shape == (3, 31, HANDLES)
    assert (np.isnan(found.values) == np.isnan(table)).all()
    assert rounded(found.values[:, 6:], table[:, 6:])
    assert_equal(found, held(table, range(270, 301)))


def assert_equal(found: Workbook, wanted: Workbook) -> None:
    """To the last bit: elsewhere no file is written."""
    np.testing.assert_array_equal(found.values, wanted.values)
    assert (found.crossed, found.remarks) == (wanted.crossed, wanted.remarks)
    assert (found.times is None) == (wanted.times is None)
    if found.times is not None:
        np.testing.assert_array_equal(found.times, wanted.times)


def test_the_moments_layout_is_read(tmp_path: Path) -> None:
    table = values_at("result2", [CONTACT])
    found = read_workbook(write_moment(tmp_path / "a.xlsx", table))
    assert found.times is None
    assert rounded(found.values, table)
    assert_equal(found, held(table))


def test_what_the_program_writes_is_read_in_both_languages(tmp_path: Path, spoken: str) -> None:
    walk = read_plan("spiral-in").build()
    motion = walk.motion([0.0, 1.0])
    table = np.stack([motion.x, motion.y, motion.speed])
    write_xlsx(tmp_path / "a.xlsx", Selection(walk, motion.times, range(HANDLES)), silent)
    write_moment_xlsx(tmp_path / "b.xlsx", list(table[:, 0]))
    assert rounded(read_workbook(tmp_path / "a.xlsx").values, table)
    found = read_workbook(tmp_path / "b.xlsx")
    assert found.times is None
    assert rounded(found.values, table[:, :1])


def half_width(rows: Rows) -> Rows:
    return [
        [str(row[0]).replace("（", "(").replace("）", ")").replace(" ", ""), *row[1:]] for row in rows
    ]


def as_text(rows: Rows) -> Rows:
    return [[f" {cell} " if isinstance(cell, float) else cell for cell in row] for row in rows]


def with_index(rows: Rows) -> Rows:
    return [[i, *row] for i, row in enumerate(rows)]


def titled(rows: Rows) -> Rows:
    return [["龙头和龙身的位置与速度"], [], ["时间", "t"], *rows]


def plain_times(rows: Rows) -> Rows:
    return [["", *TIMES.tolist()], *rows[1:]]


def backwards(rows: Rows) -> Rows:
    return [[row[0], *row[:0:-1]] for row in rows]


def turned_over(rows: Rows) -> Rows:
    """Times down the sheet, handles across it."""
    return [list(column) for column in zip(*rows, strict=True)]


def english(rows: Rows) -> Rows:
    names = {"龙头": "Head", "龙尾（后）": "Tail (rear)", "龙尾": "Tail"}
    names |= {f"第{i}节龙身": f"Body {i} " for i in range(1, 222)}
    found = []
    for label, *cells in rows:
        name = next((name for name in names if str(label).startswith(name)), "")
        found.append([names.get(name, "") + str(label)[len(name) :], *cells])
    return found


@pytest.mark.parametrize(
    "change", [half_width, as_text, with_index, titled, plain_times, backwards, english, turned_over]
)
def test_rows_and_columns_are_known_wherever_they_stand(
    tmp_path: Path,
    table: FloatArray,
    change: Callable[[Rows], Rows],
) -> None:
    places, speeds = map(change, rows_of(table))
    path = written(tmp_path / "a.xlsx", {"notes": [["x"]], "B": speeds, "A": places})
    found = read_workbook(path)
    assert found.times is not None
    assert found.times.tolist() == TIMES.tolist()
    assert np.allclose(found.values, table, rtol=0.0, atol=1e-12)


def test_cells_without_a_number_are_empty(tmp_path: Path, table: FloatArray) -> None:
    places, speeds = rows_of(table)
    for n, odd in enumerate([None, "", "?", "nan", "1e999", True, 1e300], start=1):
        places[n][1] = odd
    found = read_workbook(written(tmp_path / "a.xlsx", {"A": places, "B": speeds[:100]}))
    assert np.isnan(found.values[:2, 0, :3]).all()
    assert np.isnan(found.values[0, 0, 3])
    assert np.isfinite(found.values[1, 0, 3])
    assert np.isfinite(found.values[2, :, :99]).all()
    assert np.isnan(found.values[2, :, 99:]).all()


def test_sheets_with_the_other_ones_name_are_seen(tmp_path: Path, table: FloatArray) -> None:
    places, speeds = rows_of(table)
    for names, crossed in ((("位置", "速度"), False), (("速度", "位置"), True), (("1", "2"), False)):
        sheets = dict(zip(names, (places, speeds), strict=True))
        assert read_workbook(written(tmp_path / f"{names}.xlsx", sheets)).crossed is crossed


def as_places(rows: Rows) -> Rows:
    """Speeds whose labels are those of positions, with one axis."""
    return [[str(row[0]).replace(" (m/s)", "x (m)"), *row[1:]] for row in rows]


def twice(rows: Rows) -> Rows:
    """The same with both axes: a speed in each of two rows."""
    return [rows[0], *(
        [str(row[0]).replace(" (m/s)", f"{axis} (m)"), *row[1:]] for row in rows[1:] for axis in "xy"
    )]  # fmt: skip


def cut_off(rows: Rows) -> Rows:
    """The same with the first labels of the sheet of positions."""
    labels = [f"{name}{axis} (m)" for name in NAMES for axis in "xy"]
    return [rows[0], *([label, *row[1:]] for label, row in zip(labels, rows[1:], strict=False))]


def components(rows: Rows) -> Rows:
    """Two components in place of a speed."""
    found = [rows[0]]
    for label, *speeds in rows[1:]:
        for axis, share in (("x", 0.6), ("y", -0.8)):
            found.append([f"{str(label)[:-6]}{axis} (m)", *(share * float(str(v)) for v in speeds)])
    return found


@pytest.mark.parametrize("names", [("位置", "速度"), ("Sheet1", "Sheet2"), ("positions", "speed")])
@pytest.mark.parametrize("change", [as_places, twice, cut_off, components])
def test_speeds_labelled_as_positions_are_speeds(
    tmp_path: Path, table: FloatArray, change: Callable[[Rows], Rows], names: tuple[str, str]
) -> None:
    places, speeds = rows_of(table)
    sheets = dict(zip(names, (places, change(speeds)), strict=True))
    found = read_workbook(written(tmp_path / "a.xlsx", sheets))
    assert np.allclose(found.values, table, rtol=0.0, atol=1e-12)
    assert not found.crossed
    assert found.remarks == ("the rows of the speeds are labelled as positions",)


def test_positions_whose_labels_name_no_axis_are_x_then_y(tmp_path: Path, table: FloatArray) -> None:
    places, speeds = rows_of(table)
    plain = [[str(row[0]).replace("x (m)", "").replace("y (m)", ""), *row[1:]] for row in places]
    found = read_workbook(written(tmp_path / "a.xlsx", {"位置": plain, "速度": speeds}))
    assert np.allclose(found.values, table, rtol=0.0, atol=1e-12)


def test_sheets_of_x_and_of_y_are_positions(tmp_path: Path, table: FloatArray) -> None:
    places, speeds = rows_of(table)
    sheets = {"x": [places[0], *places[1::2]], "y": [places[0], *places[2::2]], "v": speeds}
    found = read_workbook(written(tmp_path / "a.xlsx", sheets))
    assert np.allclose(found.values, table, rtol=0.0, atol=1e-12)


def test_a_body_too_many_is_told_and_left_out(tmp_path: Path, table: FloatArray) -> None:
    places, speeds = rows_of(table)
    more = [["第222节龙身x (m)", 1.0, 2.0, 3.0]]
    found = read_workbook(written(tmp_path / "a.xlsx", {"位置": places + more, "速度": speeds}))
    assert np.allclose(found.values, table, rtol=0.0, atol=1e-12)
    assert found.remarks == ("rows that the contest does not ask for were not read: 第222节龙身x (m)",)


@pytest.mark.parametrize(
    "header", [("x", "y", "v"), ("X (m)", "Y (m)", "velocity"), ("横", "纵", "速率")]
)
def test_columns_of_one_moment_are_known_by_their_words(tmp_path: Path, header: Sequence[str]) -> None:
    rows: Rows = [["", *header], ["龙头", 1.0, 2.0, 3.0], ["第1节龙身", 4.0, 5.0, 6.0]]
    found = read_workbook(written(tmp_path / "a.xlsx", {"A": rows}))
    assert found.values[:, 0, :2].T.tolist() == [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]


@pytest.mark.parametrize("text", ["第0秒", "t = 0 s", "0 (s)", "时间 0s", "0 sec", "0秒末", "t:0"])
def test_times_are_known_however_they_are_written(tmp_path: Path, text: str) -> None:
    found = read_workbook(written(tmp_path / "a.xlsx", {"A": [["", text], ["龙头x (m)", 8.8]]}))
    assert found.times is not None
    assert found.times.tolist() == [0.0]


def test_columns_without_a_header_are_the_contests(tmp_path: Path) -> None:
    series = {301: (0.0, 300.0), 201: (-100.0, 100.0)}
    for count, ends in series.items():
        rows: Rows = [["龙头x (m)", *range(count)], ["龙头y (m)", *range(count)]]
        found = read_workbook(written(tmp_path / "a.xlsx", {"A": rows}))
        assert found.times is not None
        assert (found.times[0], found.times[-1]) == ends
        assert "they were taken for the contest's" in found.remarks[0]
    moment = read_workbook(written(tmp_path / "a.xlsx", {"A": [["龙头", 1.0, 2.0, 3.0]]}))
    assert moment.times is None
    assert moment.values[:, 0, 0].tolist() == [1.0, 2.0, 3.0]
    with pytest.raises(InputError, match="no sheet is laid out as those of"):
        read_workbook(written(tmp_path / "a.xlsx", {"A": [["龙头x (m)", *range(9)]]}))


def test_what_is_formatted_but_empty_takes_no_room(tmp_path: Path) -> None:
    """Cells out to the last column and rows down to the last one, as whole ones are formatted."""
    path = write_moment(tmp_path / "a.xlsx", values_at("result2", [CONTACT]))
    before = read_workbook(path)
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    sheet = members["xl/worksheets/sheet1.xml"]
    far = b"".join(
        b'<row r="%d" s="1" customFormat="1"><c r="XFD%d" s="1"/><c r="A%d" s="2"></c></row>'
        % (i, i, i)
        for i in range(1000, 1048577, 500)
    )
    members["xl/worksheets/sheet1.xml"] = sheet.replace(b"</sheetData>", far + b"</sheetData>")
    found = read_workbook(zipped(tmp_path / "b.xlsx", members))
    assert np.array_equal(found.values, before.values)


def test_empty_cells_that_say_no_place_keep_theirs(tmp_path: Path) -> None:
    """Without references cells are counted from the left: an empty one before them counts."""
    texts: list[list[str | None]] = [["", "0 s", "1 s"], ["龙头x (m)", None, "2"]]
    rows = b"".join(
        b"<row>" + b"".join(
            b'<c t="inlineStr"><is><t>%s</t></is></c>' % cell.encode() if cell is not None else b"<c/>"
            for cell in row
        ) + b"</row>"
        for row in texts
    )  # fmt: skip
    found = read_workbook(repacked(tmp_path / "a.xlsx", b"<sheetData>" + rows + b"</sheetData>"))
    assert np.array_equal(found.values[0, :, 0], [np.nan, 2.0], equal_nan=True)


def zipped(path: Path, members: dict[str, bytes]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return path


def many_rows(path: Path) -> Path:
    rows = b"".join(b'<row r="%d"><c r="B%d"><v>1</v></c></row>' % (i, i) for i in range(1, 10**6))
    return repacked(path, b"<sheetData>" + rows + b"</sheetData>")


def repacked(path: Path, data: bytes) -> Path:
    """A workbook whose first sheet holds other XML."""
    written(path, {"A": [["x"]]})
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    return zipped(
        path, {**members, "xl/worksheets/sheet1.xml": b"<worksheet>" + data + b"</worksheet>"}
    )


def content(data: bytes) -> Callable[[Path], Path]:
    def write(path: Path) -> Path:
        path.write_bytes(data)
        return path

    return write


FAR = b'<sheetData><row r="9"><c r="XFD1048576"><v>1</v></c></row></sheetData>'
NAMELESS = b"<sheetData>" + 2001 * (b"<row>" + 2 * b"<c><v>1</v></c>" + b"</row>") + b"</sheetData>"
WRONG: dict[str, tuple[Callable[[Path], Path], str]] = {
    "picture": (content(b"\x89PNG\r\n\x1a\n" + bytes(99)), "is no .xlsx workbook: save it as one"),
    "text": (content("龙头,1\n".encode()), "is no .xlsx workbook"),
    "nothing": (content(b""), "is no .xlsx workbook"),
    "old": (content(b"\xd0\xcf\x11\xe0" + bytes(600)), "is no .xlsx workbook: save it as one"),
    "encrypted": (
        content(b"\xd0\xcf\x11\xe0" + bytes(600) + reading.ENCRYPTED), "is locked by a password"
    ),
    "torn": (content(b"PK\x03\x04" + bytes(99)), "is torn, or no workbook: open it"),
    "other archive": (lambda path: zipped(path, {"a.xml": b"<a/>"}), "is torn, or no workbook"),
    "empty sheet": (lambda path: written(path, {"位置": []}), "no sheet is laid out as those of"),
    "other table": (lambda path: written(path, {"A": [["a", 1], ["b", 2]]}), "no sheet is laid out"),
    "no numbers": (
        lambda path: written(path, {"A": [["", "0 s"], ["龙头x (m)"]]}), "the workbook holds no numbers"
    ),
    "far cell": (lambda path: repacked(path, FAR), "is too large for a workbook of the contest"),
    "nameless cells": (lambda path: repacked(path, NAMELESS), "is too large for a workbook"),
    "many rows": (many_rows, "is too large for a workbook of the contest"),
    "bomb": (
        lambda path: zipped(path, {"xl/a.xml": bytes(100_000_001)}),
        "is too large for a workbook",
    ),
    "many times": (
        lambda path: written(path, {"A": [["", *range(1002)], ["龙头x (m)", *range(1002)]]}),
        "at most 1001 times are compared",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_wrong_input_is_refused_in_one_sentence(tmp_path: Path, name: str) -> None:
    make, sentence = WRONG[name]
    path = make(tmp_path / "a.xlsx")
    with pytest.raises(InputError) as caught:
        read_workbook(path)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_is_no_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file or folder"):
        read_workbook(tmp_path / "a.xlsx")
    for name in ("\ud800", "a\0b"):
        with pytest.raises(InputError, match="there is no such file or folder"):
            read_workbook(Path(name))
    with pytest.raises(InputError, match=r"is no \.xlsx workbook"):
        read_workbook(tmp_path)


def test_a_file_too_large_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write_moment(tmp_path / "a.xlsx", values_at("result2", [CONTACT]))
    monkeypatch.setattr(reading, "MOST_BYTES", 2**10)
    with pytest.raises(InputError, match="at most 0 MB"):
        read_workbook(path)


def test_a_text_that_many_cells_share_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = written(tmp_path / "a.xlsx", {"A": [["x" * 501] * 100] * 100})
    with pytest.raises(InputError, match="500 signs in a cell"):
        read_workbook(path)


@pytest.mark.parametrize("seed", range(8))
def test_damaged_workbooks_are_read_or_refused(tmp_path: Path, seed: int) -> None:
    whole = write_moment(tmp_path / "a.xlsx", values_at("result2", [CONTACT])).read_bytes()
    rng = np.random.default_rng(seed)
    for n in range(40):
        damaged = bytearray(whole[: rng.integers(100, len(whole))] if n % 4 == 0 else whole)
        for at in rng.integers(0, len(damaged), 6):
            damaged[at] = rng.integers(256)
        (tmp_path / "b.xlsx").write_bytes(damaged)
        try:
            found = read_workbook(tmp_path / "b.xlsx")
        except InputError:
            continue
        assert found.values.shape == (3, 1, HANDLES)
