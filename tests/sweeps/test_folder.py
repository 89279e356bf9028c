"""A sweep's folder: parts whole or not at all, of this sweep alone, and one writer at a time."""

import errno
import json
import multiprocessing
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pyarrow as pa
import pytest
from pyarrow import parquet

from benchdragon.errors import InputError, MachineError
from benchdragon.files import FileRefusedError
from benchdragon.plans.schema import read_plan
from benchdragon.sweeps import folder as subject
from benchdragon.sweeps.folder import (
    OTHERS,
    Rows,
    name_of,
    opened,
    parts_in,
    read_about,
    read_rows,
)
from benchdragon.sweeps.points import grid_points
from benchdragon.sweeps.sweep import Design
from tests import work

DESIGN = Design(
    read_plan("spiral-in"),
    grid_points({"dragon.width": [0.1 * n for n in range(1, 9)]}),
    ("clearance",),
)
ABOUT: dict[str, Any] = DESIGN.about()


def batch(*points: int, status: str = "found") -> Any:
    rows = [{"point": n, "dragon.width": n / 2, "clearance.status": status} for n in points]
    return DESIGN.work.batch(rows)


def filled(folder: Path, *parts: tuple[int, ...], about: dict[str, Any] = ABOUT) -> Rows:
    """A folder with these points in its parts."""
    with opened(folder, about):
        rows = Rows(about, folder)
        for part in parts:
            rows.add(batch(*part))
            rows.write()
    return rows


def points(table: Any) -> list[int]:
    found: list[int] = table["point"].to_pylist()
    return found


@pytest.fixture
def still(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """A clock that is set by hand."""
    clock = SimpleNamespace(now=0.0)
    monkeypatch.setattr(subject, "clock", SimpleNamespace(monotonic=lambda: clock.now))
    return clock


def test_rows_come_in_the_order_of_their_points(tmp_path: Path) -> None:
    for folder in (tmp_path / "new" / "folder", None):
        if folder is None:
            rows = Rows(ABOUT, None)
            rows.add(batch(4, 1))
            rows.write()
            rows.add(batch(0, 3))
        else:
            rows = filled(folder, (4, 1), (0, 3))
        assert points(rows.table()) == [0, 1, 3, 4]
        assert rows.table()["dragon.width"].to_pylist() == [0.0, 0.5, 1.5, 2.0]


def test_without_rows_the_table_has_its_columns(tmp_path: Path) -> None:
    rows = filled(tmp_path)
    for one in (rows, Rows(ABOUT, None)):
        assert one.table().schema == batch(0).schema.remove_metadata()
        assert len(one.table()) == 0
    rows.write()
    assert parts_in(tmp_path) == []


def test_parts_are_written_when_they_are_due(tmp_path: Path, still: SimpleNamespace) -> None:
    rows = filled(tmp_path)
    steps = [(4.0, 0), (5.0, 1), (9.9, 1), (10.0, 2), (1000.0, 3), (1019.0, 3), (1021.0, 4)]
    for number, (now, written) in enumerate(steps):
        still.now = now
        rows.add(batch(number))
        assert len(parts_in(tmp_path)) == written, now
    assert points(rows.table()) == list(range(len(steps)))


def test_parts_are_written_before_they_grow_large(
    tmp_path: Path, still: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(subject, "MOST_ROWS", 3)
    rows = filled(tmp_path)
    for number in range(7):
        rows.add(batch(number))
    assert [points(parquet.read_table(part)) for part in parts_in(tmp_path)] == [[0, 1, 2], [3, 4, 5]]


def test_a_folder_is_gone_on_with_and_no_part_written_over(tmp_path: Path) -> None:
    filled(tmp_path, (0,), (1,))
    parts_in(tmp_path)[0].unlink()
    before = {path: path.read_bytes() for path in parts_in(tmp_path)}
    assert points(filled(tmp_path, (7,), (5,)).table()) == [1, 5, 7]
    assert all(path.read_bytes() == text for path, text in before.items())
    assert len(parts_in(tmp_path)) == 3


def test_parts_tell_what_they_are_of(tmp_path: Path) -> None:
    filled(tmp_path, (0,))
    marks = parquet.read_schema(parts_in(tmp_path)[0]).metadata
    assert marks[b"sweep"] == name_of(ABOUT)
    told = json.loads(marks[b"about"])
    assert told == {key: ABOUT[key] for key in ("plan_sha256", "ask", "made_by")}
    assert read_about(tmp_path) == ABOUT
    assert read_rows(tmp_path, ABOUT).schema.metadata is None


@pytest.mark.parametrize("key", OTHERS)
def test_a_folder_of_another_sweep_is_refused(tmp_path: Path, key: str) -> None:
    filled(tmp_path, (0,))
    other = {**ABOUT, key: "other"}
    assert name_of(other) != name_of(ABOUT)
    with pytest.raises(FileRefusedError) as refused:
        filled(tmp_path, (1,), about=other)
    said = f"{tmp_path} holds a sweep of {OTHERS[key]}: choose another folder"
    assert str(refused.value) == said
    assert points(read_rows(tmp_path, ABOUT)) == [0]


@pytest.mark.parametrize("key", OTHERS)
def test_a_part_of_another_sweep_is_refused(tmp_path: Path, key: str) -> None:
    filled(tmp_path / "one", (0,))
    filled(tmp_path / "other", (0,), (1,), about={**ABOUT, key: "other"})
    strange = parts_in(tmp_path / "other")[1].rename(tmp_path / "one" / "part-00000007.parquet")
    with pytest.raises(InputError) as refused:
        read_rows(tmp_path / "one", ABOUT)
    assert str(refused.value) == f"{strange} belongs to another sweep: take it away"


def garbage(path: Path) -> None:
    path.write_bytes(b"PAR1 not at all")


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-20])


def unmarked(path: Path) -> None:
    parquet.write_table(pa.table({"point": [1]}), path)


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (garbage, "{part} cannot be read: "),
        (cut, "{part} cannot be read: "),
        (unmarked, "{part} belongs to another sweep: take it away"),
    ],
)
def test_a_part_that_is_spoilt_is_named(
    tmp_path: Path, spoil: Callable[[Path], None], said: str
) -> None:
    filled(tmp_path, (0,), (1,))
    part = parts_in(tmp_path)[1]
    spoil(part)
    with pytest.raises(InputError) as refused:
        read_rows(tmp_path, ABOUT)
    assert str(refused.value).startswith(said.format(part=part))


def test_a_part_with_a_strange_name_is_refused_by_name(tmp_path: Path) -> None:
    filled(tmp_path, (0,))
    copy = tmp_path / "part-00000000 (copy).parquet"
    copy.write_bytes(parts_in(tmp_path)[0].read_bytes())
    (tmp_path / "part-00000000.parquet").unlink()
    with pytest.raises(InputError) as refused:
        filled(tmp_path, (1,))
    assert str(refused.value) == f"{copy} belongs to another sweep: take it away"


def test_a_point_has_one_row(tmp_path: Path) -> None:
    rows = filled(tmp_path, (0, 1), (1, 2))
    with pytest.raises(InputError) as refused:
        rows.table()
    assert str(refused.value) == f"{tmp_path} has rows of the same point twice"


def test_an_answer_takes_the_place_of_one_that_was_lost(tmp_path: Path) -> None:
    for folder in (tmp_path, None):
        rows = Rows(ABOUT, folder) if folder is None else filled(folder)
        for part in (batch(2, 0, status="lost"), batch(1), batch(0), batch(2, status="lost")):
            rows.add(part)
            rows.write()
        table = rows.table()
        assert points(table) == [0, 1, 2]
        assert table["clearance.status"].to_pylist() == ["found", "found", "lost"]


def test_a_sweep_without_rows_keeps_no_other_out(tmp_path: Path) -> None:
    filled(tmp_path)
    other = {**ABOUT, "ask": ["width"]}
    filled(tmp_path, about=other)
    assert read_about(tmp_path) == other


def test_a_plan_that_is_not_the_one_that_was_asked_is_told(tmp_path: Path) -> None:
    filled(tmp_path, (0,), about={**ABOUT, "plan": read_plan("turn").data()})
    with pytest.raises(InputError, match="holds no sweep"):
        read_about(tmp_path)


@pytest.mark.parametrize("text", [None, "", "{", "[]", "7", "{}", '{"format": 1}', "\udcff"])
def test_a_folder_without_a_sweep_is_told(tmp_path: Path, text: str | None) -> None:
    if text is not None:
        (tmp_path / "sweep.json").write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(InputError) as refused:
        read_about(tmp_path)
    assert str(refused.value) == f"{tmp_path} holds no sweep"
    if text is not None:
        with pytest.raises(InputError, match=r"holds no sweep$"):
            filled(tmp_path)


def test_a_folder_with_other_files_is_refused(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").touch()
    with pytest.raises(FileRefusedError) as refused:
        filled(tmp_path)
    assert str(refused.value) == f"{tmp_path} is not empty, and holds no sweep"
    assert {path.name for path in tmp_path.iterdir()} == {"thesis.txt"}


def test_a_file_is_no_folder(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.touch()
    for path in (file, file / "below"):
        with pytest.raises(FileRefusedError) as refused:
            filled(path)
        assert str(refused.value) == f"{path} is not a folder"


def test_what_a_killed_run_left_is_cleared_and_nothing_else(tmp_path: Path) -> None:
    left = [".part-00000001.parquet.0123abcd.parquet", ".sweep.json.0123abcd.json"]
    for name in left:
        (tmp_path / name).touch()
    filled(tmp_path, (0,))
    for name in (*left, "notes.txt", ".hidden"):
        (tmp_path / name).touch()
    filled(tmp_path)
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"sweep.json", "part-00000000.parquet", "notes.txt", ".hidden"}


def test_one_writer_keeps_others_out_until_it_ends(tmp_path: Path) -> None:
    with opened(tmp_path, ABOUT), pytest.raises(FileRefusedError) as refused:
        filled(tmp_path, (0,))
    assert str(refused.value) == f"another run is writing into {tmp_path}"
    filled(tmp_path, (0,))


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no forks here")
def test_workers_that_were_forked_meanwhile_do_not_keep_others_out(tmp_path: Path) -> None:
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("fork")) as executor:
        with opened(tmp_path, ABOUT), warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of forks beside threads
            assert executor.submit(work.double, [1]).result() == [2]
        filled(tmp_path, (0,))


@pytest.mark.parametrize("error", [OSError(errno.EPIPE, "pipe"), FileExistsError(17, "there")])
def test_an_error_of_the_work_is_not_the_folders(tmp_path: Path, error: OSError) -> None:
    with pytest.raises(type(error)) as told, opened(tmp_path, ABOUT):
        raise error
    assert told.value is error
    filled(tmp_path, (0,))


def test_a_folder_that_cannot_be_made_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_arguments: object, **_named: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "mkdir", full)
    with pytest.raises(MachineError) as told:
        filled(tmp_path)
    assert str(told.value) == f"{tmp_path} could not be written: the disk is full"


def test_a_full_disk_leaves_no_part_and_the_rows_are_written_later(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = filled(tmp_path, (0,))

    def full(_table: object, path: Path, **_named: object) -> None:
        path.write_bytes(b"PAR1")
        raise OSError(errno.ENOSPC, "No space left on device")

    rows.add(batch(1))
    with monkeypatch.context() as patch:
        patch.setattr(parquet, "write_table", full)
        with pytest.raises(MachineError) as told:
            rows.write()
    part = tmp_path / "part-00000001.parquet"
    assert str(told.value) == f"{part} could not be written: the disk is full"
    assert {path.name for path in tmp_path.iterdir()} == {"sweep.json", "part-00000000.parquet"}
    assert points(rows.table()) == [0, 1]
