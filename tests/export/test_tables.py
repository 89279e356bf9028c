import re
import zipfile
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np
import pytest
from pyarrow import parquet
from python_calamine import CalamineWorkbook

from benchdragon import Dragon, InputError, WalkError
from benchdragon.analysis.check import check, moment
from benchdragon.errors import MissingExtraError
from benchdragon.export.tables import (
    WRITERS,
    Selection,
    write_contest_xlsx,
    write_csv,
    write_moment_xlsx,
    write_netcdf,
    write_npz,
    write_parquet,
    write_xlsx,
)
from benchdragon.i18n import use_language
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.numbering import handle_names
from benchdragon.model.walk import Motion
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent
from tests.figures.test_square import NEAR

WALK, TURN = read_plan("spiral-in").build(), read_plan("turn").build()
TIMES = np.array([0.0, 60.5, 300.0])
ALL = range(224)


def test_the_spreadsheet_has_the_contests_layout(tmp_path: Path) -> None:
    use_language("zh")
    try:
        write_xlsx(tmp_path / "a.xlsx", Selection(WALK, TIMES, ALL), silent)
    finally:
        use_language("en")
    book = CalamineWorkbook.from_path(tmp_path / "a.xlsx")
    assert book.sheet_names == ["位置", "速度", "编号"]
    places, speeds = (book.get_sheet_by_name(name).to_python() for name in book.sheet_names[:2])
    assert places[0] == ["", "0 s", "60.5 s", "300 s"]
    names = [row[0] for row in places[1:]]
    assert names[:4] == ["龙头x (m)", "龙头y (m)", "第1节龙身x (m)", "第1节龙身y (m)"]
    assert names[-4:] == ["龙尾x (m)", "龙尾y (m)", "龙尾（后）x (m)", "龙尾（后）y (m)"]
    assert names[-6:-4] == ["第221节龙身x (m)", "第221节龙身y (m)"]
    assert len(places) == 449
    assert len(speeds) == 225
    motion = WALK.motion(TIMES)
    x = np.array([row[1:] for row in places[1::2]], dtype=float)
    assert x == pytest.approx(np.round(motion.x.T, 6), abs=1e-12)
    speed = np.array([row[1:] for row in speeds[1:]], dtype=float)
    assert speed == pytest.approx(np.round(motion.speed.T, 6), abs=1e-12)


def sheets(path: Path) -> dict[str, list[list[Any]]]:
    """The sheets of a workbook by their names."""
    book = CalamineWorkbook.from_path(path)
    return {name: book.get_sheet_by_name(name).to_python() for name in book.sheet_names}


def standing(motion: Motion) -> list[FloatArray]:
    """x, y and speed at the first time."""
    return [motion.x[0], motion.y[0], motion.speed[0]]


BODIES = [f"第{i}节龙身" for i in range(1, 222)]


@pytest.mark.parametrize(("start", "end"), [(0.0, 300.0), (-100.0, 100.0)])
def test_the_contests_files_are_its_own_whatever_the_language(
    tmp_path: Path, spoken: str, start: float, end: float
) -> None:
    del spoken
    times = np.arange(start, end + 1.0)
    motion = TURN.motion(times)
    write_contest_xlsx(tmp_path / "a.xlsx", times, (motion.x, motion.y, motion.speed))
    found = sheets(tmp_path / "a.xlsx")
    assert list(found) == ["位置", "速度"]
    for sheet in found.values():
        assert sheet[0] == ["", *(f"{t:g} s" for t in times)]
    names = ["龙头", *BODIES, "龙尾", "龙尾（后）"]
    rows = [f"{name}{axis} (m)" for name in names for axis in "xy"]
    assert [row[0] for row in found["位置"][1:]] == rows
    bodies = [f"{name}  (m/s)" for name in [*BODIES, "龙尾"]]
    assert [row[0] for row in found["速度"][1:]] == ["龙头 (m/s)", *bodies, "龙尾（后） (m/s)"]
    for row, exact in zip(found["速度"][1:], motion.speed.T, strict=True):
        assert row[1:] == [round(value, 6) for value in exact.tolist()]


def test_the_contests_moment_is_its_own_whatever_the_language(tmp_path: Path, spoken: str) -> None:
    del spoken
    motion = WALK.motion([0.0])
    write_moment_xlsx(tmp_path / "a.xlsx", standing(motion))
    found = sheets(tmp_path / "a.xlsx")
    assert list(found) == ["Sheet1"]
    head, *rows = found["Sheet1"]
    assert head == ["", "横坐标x (m)", "纵坐标y (m)", "速度 (m/s)"]
    assert [row[0] for row in rows] == ["龙头", *BODIES, "龙尾", "龙尾（后）"]
    assert [row[1] for row in rows] == [round(value, 6) for value in motion.x[0].tolist()]
    assert str(rows[0][2]) in {"0.0", "0"}  # y of the head is -3e-14 m


def test_cells_of_the_contests_files_show_six_decimals(tmp_path: Path) -> None:
    motion = WALK.motion(TIMES)
    write_moment_xlsx(tmp_path / "a.xlsx", standing(motion))
    write_contest_xlsx(tmp_path / "b.xlsx", TIMES, (motion.x, motion.y, motion.speed))
    for name in ("a.xlsx", "b.xlsx"):
        with zipfile.ZipFile(tmp_path / name) as book:
            assert 'formatCode="0.000000"' in book.read("xl/styles.xml").decode()
            cells = re.findall(
                r'<c r="B[0-9]+"([^>]*)><v>', book.read("xl/worksheets/sheet1.xml").decode()
            )
        numbers = [cell for cell in cells if 't="s"' not in cell]
        assert len(numbers) >= 224
        assert set(numbers) == {' s="1"'}


def test_short_dragons_have_names_for_their_handles() -> None:
    assert handle_names(2) == ["Head", "Tail (rear)"]
    assert handle_names(3) == ["Head", "Tail", "Tail (rear)"]
    assert handle_names(5) == ["Head", "Body 1", "Body 2", "Tail", "Tail (rear)"]


def test_the_csv_is_long_and_loses_no_digit(tmp_path: Path) -> None:
    write_csv(tmp_path / "a.csv", Selection(WALK, TIMES, [0, 5]), silent)
    raw = (tmp_path / "a.csv").read_bytes()
    assert raw.startswith(b"\xef\xbb\xbftime_s,handle,x_m,y_m,v_m_s\r\n")
    table = np.loadtxt(tmp_path / "a.csv", delimiter=",", skiprows=1, encoding="utf-8-sig")
    motion = WALK.motion(TIMES)
    assert table[:, 0].tolist() == [0.0, 0.0, 60.5, 60.5, 300.0, 300.0]
    assert table[:, 1].tolist() == [0, 5] * 3
    assert (table[:, 2] == motion.x[:, [0, 5]].ravel()).all()
    assert (table[:, 4] == motion.speed[:, [0, 5]].ravel()).all()


def test_npz_parquet_and_netcdf_hold_the_same(tmp_path: Path) -> None:
    what = Selection(WALK, TIMES, [3, 223])
    motion = WALK.motion(TIMES)
    write_npz(tmp_path / "a.npz", what, silent)
    with np.load(tmp_path / "a.npz") as arrays:
        assert sorted(arrays) == ["handle", "s", "speed", "time", "x", "y"]
        assert (arrays["s"] == motion.s[:, [3, 223]]).all()
    write_parquet(tmp_path / "a.parquet", what, silent)
    long = parquet.read_table(tmp_path / "a.parquet")
    assert long.column_names == ["time_s", "handle", "x_m", "y_m", "v_m_s"]
    assert (long["y_m"].to_numpy() == motion.y[:, [3, 223]].ravel()).all()
    write_netcdf(tmp_path / "a.nc", what, silent)
    with h5netcdf.File(tmp_path / "a.nc") as file:
        assert (file.variables["speed"][:] == motion.speed[:, [3, 223]]).all()
        assert file.variables["x"].attrs["units"] == "m"
        assert file.variables["time"][:].tolist() == TIMES.tolist()


@pytest.mark.parametrize("name", sorted(WRITERS))
def test_progress_adds_up_and_a_failure_leaves_no_file(tmp_path: Path, name: str) -> None:
    shares: list[float] = []
    what = Selection(WALK, TIMES, ALL)
    WRITERS[name](tmp_path / f"a.{name}", what, lambda share, _text: shares.append(share))
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1.0)
    with pytest.raises(WalkError):
        WRITERS[name](tmp_path / f"b.{name}", Selection(WALK, np.array([0.0, 900.0]), ALL), silent)
    assert [path.name for path in tmp_path.iterdir()] == [f"a.{name}"]


def test_what_cannot_stand_leaves_empty_cells_when_asked(tmp_path: Path) -> None:
    what = Selection(WALK, np.array([0.0, 900.0]), [0, 1], throw=False)
    write_csv(tmp_path / "a.csv", what, silent)
    lines = (tmp_path / "a.csv").read_text("utf-8-sig").splitlines()
    assert lines[3:] == ["900.0,0,,,", "900.0,1,,,"]
    write_xlsx(tmp_path / "a.xlsx", what, silent)
    sheet = CalamineWorkbook.from_path(tmp_path / "a.xlsx").get_sheet_by_index(1).to_python()
    assert sheet[1] == ["Head (m/s)", 1.0] or sheet[1][2] == ""


def test_more_than_a_format_holds_is_refused(tmp_path: Path) -> None:
    many = np.arange(16_384.0)
    for times, handles in ((many, [0]), (many[:10_000], ALL)):
        with pytest.raises(InputError, match="choose fewer"):
            write_xlsx(tmp_path / "a.xlsx", Selection(WALK, times, handles), silent)
    with pytest.raises(InputError, match="such a file holds at most 40000000 positions"):
        write_npz(tmp_path / "a.npz", Selection(WALK, np.arange(200_000.0), ALL), silent)
    with pytest.raises(InputError, match="such a file holds at most 40000000 positions"):
        write_netcdf(tmp_path / "a.nc", Selection(WALK, np.arange(200_000.0), ALL), silent)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["parquet", "nc"])
def test_a_missing_extra_names_the_command_that_brings_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    module = {"parquet": "pyarrow", "nc": "h5netcdf"}[name]
    monkeypatch.setitem(__import__("sys").modules, module, None)
    with pytest.raises(MissingExtraError, match=r"pip install 'benchdragon\[data\]'"):
        WRITERS[name](tmp_path / "a", Selection(WALK, TIMES, [0]), silent)


def test_xarray_carries_units_and_all_tables() -> None:
    data = WALK.motion(TIMES).to_xarray()
    assert set(data) == {
        "x", "y", "s", "speed", "acceleration", "heading", "turning_rate", "status",
    }  # fmt: skip
    assert data["x"].sel(time=300.0, handle=223).item() == WALK.motion([300.0]).x[0, 223]
    assert data["turning_rate"].attrs["units"] == "rad s-1"
    assert data["heading"].dims == ("time", "bench")


def test_slices_of_many_benches_are_written_one_time_at_once(tmp_path: Path) -> None:
    walk = type(WALK)(Dragon.uniform(benches=1_000_000), WALK.route)
    write_csv(tmp_path / "a.csv", Selection(walk, np.array([0.0, 1.0]), [0, 1_000_000]), silent)
    assert len((tmp_path / "a.csv").read_text().splitlines()) == 5


def test_a_workbook_of_a_check_tells_of_obstacles(tmp_path: Path) -> None:
    report = check(NEAR)
    motion, _answer = moment(report)
    write_moment_xlsx(tmp_path / "a.xlsx", standing(motion), report.obstacles)
    book = CalamineWorkbook.from_path(tmp_path / "a.xlsx")
    assert book.sheet_names == ["Sheet1", "Obstacles"]
    heads, venue, well, rope = book.get_sheet_by_name("Obstacles").to_python()
    assert heads[:3] == ["obstacle", "kind", "margin (m)"]
    answers = report.obstacles[0]
    near = answers.distance.witness
    assert near is not None
    bracket = [answers.distance.value, answers.distance.lower, answers.distance.upper]
    assert venue[:3] == ["the venue", "edge of the venue", 0.5]
    assert venue[3:8] == pytest.approx([*bracket, near.time, near.benches[0]], rel=1e-15)
    assert venue[8:] == ["", ""]
    contact = report.obstacles[1].contact
    assert contact is not None
    assert well[3] == 0.0
    assert well[8:] == pytest.approx([contact.value, 1], rel=1e-15)
    assert rope[:2] == ["obstacle 2", "line"]
    write_moment_xlsx(tmp_path / "b.xlsx", standing(motion))
    assert CalamineWorkbook.from_path(tmp_path / "b.xlsx").sheet_names == ["Sheet1"]
