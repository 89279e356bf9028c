"""A sweep's folder: what it is of, and its rows in Parquet files, each written whole or not at all."""

import hashlib
import json
import stat
import time as clock
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, MachineError, reason
from benchdragon.files import LOCK, FileRefusedError, alone, whole_file, write_whole
from benchdragon.i18n import N_, _
from benchdragon.plans.schema import checked
from benchdragon.plans.toml import PlanError
from benchdragon.sweeps.questions import LOST
from benchdragon.sweeps.rows import arrow, row_schema

# The record of a sweep, and its rows; the mark in each part of the sweep that it belongs to.
ABOUT, PART, OF = "sweep.json", "part-{number:08d}.parquet", b"sweep"
# Bytes of what tells of a sweep.
MOST_BYTES = 100_000_000
# A part holds the rows of so many seconds, or of so large a share of all the time, and no more than so
# many: what is lost by kill -9.
EACH_SECONDS, EACH_SHARE, MOST_ROWS = 5.0, 0.02, 200_000
# Why a folder's rows are not those of the sweep that was asked for.
OTHERS = {
    "format": N_("another format"),
    "made_by": N_("another version of benchdragon"),
    "plan_sha256": N_("another plan"),
    "points": N_("other points"),
    "ask": N_("other questions"),
    "dances": N_("other random dances"),
    "refine": N_("another refinement"),
}


def name_of(about: Mapping[str, Any]) -> bytes:
    """What every part of a sweep is marked by."""
    known = {key: about[key] for key in OTHERS}
    return hashlib.sha256(json.dumps(known, sort_keys=True).encode()).hexdigest().encode()


def read_about(folder: Path) -> dict[str, Any]:
    """The record of the sweep in a folder.

    Raises:
        InputError: if there is none.
    """
    try:
        if not stat.S_ISREG((folder / ABOUT).stat().st_mode):  # a pipe may have no beginning
            raise ValueError
        with (folder / ABOUT).open("rb") as written:
            about: dict[str, Any] = json.loads(written.read(MOST_BYTES))
        name_of({**about, "finished": about["finished"]})
        if checked(about["plan"], ABOUT).sha256 != about["plan_sha256"]:
            raise ValueError
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError, PlanError):
        raise InputError(_("{folder} holds no sweep").format(folder=folder)) from None
    return about


class Rows:
    """The rows of a sweep, in a folder or in memory.

    Args:
        about: what the sweep is.
        folder: where its parts are; None for memory alone.
    """

    def __init__(self, about: Mapping[str, Any], folder: Path | None) -> None:
        self._about, self._folder, self._name = about, folder, name_of(about)
        self._waiting: list[Any] = []
        self._began = self._written = clock.monotonic()
        self._kept: list[Any] = []
        self._next = 0
        if folder is not None:
            parts = parts_in(folder)
            self._next = _number_of(parts[-1]) + 1 if parts else 0

    def add(self, batch: Any) -> None:
        """Take rows; they are written together with those of some seconds."""
        self._waiting.append(batch)
        now = clock.monotonic()
        due = max(EACH_SECONDS, EACH_SHARE * (now - self._began))
        if now - self._written >= due or sum(map(len, self._waiting)) >= MOST_ROWS:
            self.write()

    def write(self) -> None:
        """Write the rows that wait.

        Raises:
            MachineError: if the disk is full, or cannot be written for another reason.
        """
        if not self._waiting:
            return
        pa = arrow()
        table = pa.Table.from_batches(self._waiting).sort_by("point")
        if self._folder is None:
            self._kept.append(table)
        else:
            from pyarrow import parquet

            marked = table.replace_schema_metadata(self._marks())
            with whole_file(self._folder / PART.format(number=self._next)) as temporary:
                parquet.write_table(marked, temporary, compression="zstd")
        self._next += 1
        self._waiting, self._written = [], clock.monotonic()

    def _marks(self) -> dict[bytes, bytes]:
        """What is in every part: sweep.json has the rest."""
        told = {key: self._about[key] for key in ("plan_sha256", "ask", "made_by")}
        return {OF: self._name, b"about": json.dumps(told).encode()}

    def table(self) -> Any:
        """All rows, in the order of their points."""
        self.write()
        if self._folder is not None:
            return read_rows(self._folder, self._about)
        return _in_order([no_rows(self._about), *self._kept], self._about)


def parts_in(folder: Path) -> list[Path]:
    """The parts in a folder, in the order in which they were written."""
    return sorted(folder.glob("part-*.parquet"))


def _number_of(part: Path) -> int:
    try:
        return int(part.stem.removeprefix("part-"))
    except ValueError:
        raise _of_another(part) from None


def _of_another(part: Path) -> InputError:
    return InputError(_("{path} belongs to another sweep: take it away").format(path=part))


def no_rows(about: Mapping[str, Any]) -> Any:
    """The table of a sweep that has no rows."""
    keys = [(key, kind) for key, kind in about["points"]["keys"]]
    return row_schema(keys, about["ask"]).empty_table()


def read_rows(folder: Path, about: Mapping[str, Any]) -> Any:
    """All rows in a folder, in the order of their points.

    Raises:
        InputError: for a part of another sweep, one that cannot be read, or two answers at a point.
    """
    pa = arrow()
    from pyarrow import parquet

    tables, name = [no_rows(about)], name_of(about)
    for path in parts_in(folder):
        try:
            one = parquet.read_table(path)
        except (OSError, pa.ArrowException) as error:
            raise InputError(_("{path} cannot be read: {why}").format(path=path, why=error)) from None
        if (one.schema.metadata or {}).get(OF) != name:
            raise _of_another(path)
        tables.append(one.replace_schema_metadata(None))
    table = _in_order(tables, about)
    if len(table["point"].unique()) < len(table):
        raise InputError(_("{folder} has rows of the same point twice").format(folder=folder))
    return table


def _in_order(tables: list[Any], about: Mapping[str, Any]) -> Any:
    """The rows of tables by their points; one that was lost goes where a later one has its point."""
    table = arrow().concat_tables(tables)
    points, lost = table["point"].to_numpy(), lost_rows(table, about["ask"])
    # Answers before what was lost, and of that the last.
    order = np.lexsort((-np.arange(len(points)), lost, points))
    again = np.flatnonzero(np.diff(points[order]) == 0) + 1
    return table.take(np.delete(order, again[lost[order][again]]))


def lost_rows(table: Any, asked: list[str]) -> npt.NDArray[np.bool_]:
    """Which rows have an answer that was lost with its worker."""
    from pyarrow import compute

    lost = np.zeros(len(table), dtype=bool)
    for name in asked:
        lost |= compute.equal(table[f"{name}.status"], LOST).to_numpy().astype(bool)
    return lost


@contextmanager
def opened(folder: Path, about: Mapping[str, Any]) -> Iterator[None]:
    """A folder for a sweep, new or continued, locked against other processes.

    Raises:
        FileRefusedError: if it holds another sweep or other files, or another process writes there.
        MachineError: if it cannot be made or written.
    """
    with ExitStack() as stack:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            _check(folder, about)
            stack.enter_context(alone(folder))
            _check(folder, about)
            _prepare(folder, about)
        except (FileExistsError, NotADirectoryError):
            raise FileRefusedError(_("{path} is not a folder").format(path=folder)) from None
        except OSError as error:
            text = _("{path} could not be written: {why}")
            raise MachineError(text.format(path=folder, why=reason(error))) from None
        yield


def _check(folder: Path, about: Mapping[str, Any]) -> None:
    """See that a folder is that of this sweep, or free: one without rows is."""
    if (folder / ABOUT).exists():
        there = read_about(folder)
        other = next((text for key, text in OTHERS.items() if there[key] != about[key]), None)
        if other is not None and parts_in(folder):
            said = _("{folder} holds a sweep of {what}: choose another folder")
            raise FileRefusedError(said.format(folder=folder, what=_(other)))
    elif any(path.name != LOCK and not _is_leftover(path) for path in folder.iterdir()):
        raise FileRefusedError(_("{folder} is not empty, and holds no sweep").format(folder=folder))


def _prepare(folder: Path, about: Mapping[str, Any]) -> None:
    """Say what a folder holds; clear what an interrupted run left."""
    if not parts_in(folder):
        write_about(folder, about)
    for path in folder.iterdir():
        if _is_leftover(path):
            path.unlink()


def write_about(folder: Path, about: Mapping[str, Any]) -> None:
    """Write the record of the sweep in a folder."""
    write_whole(folder / ABOUT, json.dumps(about))


def _is_leftover(path: Path) -> bool:
    """Whether this is the temporary file of a run that was killed: see `files.whole_file`."""
    return path.name.startswith((f".{ABOUT}.", ".part-"))
