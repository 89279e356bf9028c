"""Tables of a walk: XLSX laid out as the contest's, CSV, NPZ, Parquet, NetCDF; the contest's own files.

Every writer takes the walk and the times and marches them itself, slice by slice where the format
can be written so: marching costs far less than writing.
"""

import io
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from benchdragon.analysis.findings import shown_name
from benchdragon.analysis.obstacles import ObstacleAnswers
from benchdragon.errors import InputError, brought_by
from benchdragon.files import whole_bytes, whole_file
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.numbering import contest_names, handle_names, handle_place, numbering_text
from benchdragon.model.obstacle import Kind
from benchdragon.model.walk import Motion, Walk
from benchdragon.progress import Progress, silent

# What a spreadsheet can hold: columns after the first, and rows for x and y below the header.
MOST_TIMES_XLSX = 16_383
MOST_HANDLES_XLSX = 524_287
# Cells of one workbook: 30 s of writing or so for each million.
MOST_CELLS_XLSX = 6_000_000
# Handles times times of an NPZ or NetCDF, which is held in memory whole: 1.6 GB.
MOST_PLACES_IN_MEMORY = 40_000_000


@dataclass(frozen=True)
class Selection:
    """What a table is to hold.

    Args:
        walk: what moves.
        times: s, (T,).
        handles: their numbers, (H,).
        throw: whether a time at which the dragon cannot stand raises, or leaves empty cells.
        workers: threads.
    """

    walk: Walk
    times: FloatArray
    handles: Sequence[int]
    throw: bool = True
    workers: int = 1

    def motions(self) -> Iterator[Motion]:
        """Slices of the motion that fit in bounded memory."""
        return self.walk.motions(self.times, throw=self.throw, workers=self.workers)

    def gathered(self, *names: str) -> list[FloatArray]:
        """The named tables of the chosen handles, each (T, H)."""
        tables = [np.empty((len(self.times), len(self.handles))) for _name in names]
        done = 0
        for motion in self.motions():
            end = done + len(motion.times)
            for name, table in zip(names, tables, strict=True):
                table[done:end] = getattr(motion, name)[:, self.handles]
            done = end
        return tables


Writer = Callable[[Path, Selection, Progress], None]


@dataclass(frozen=True)
class _Labels:
    """Names of the sheets of positions and of speeds, and of the rows of each handle."""

    positions: str
    speeds: str
    x: list[str]
    y: list[str]
    speed: list[str]


def write_xlsx(path: Path, what: Selection, progress: Progress) -> None:
    """Positions (x and y rows of each handle) and speeds, one column a time, in the language in use.

    A third sheet tells the number of each handle beside the contest's name.

    Raises:
        InputError: for more than a spreadsheet can hold.
    """
    _check_cells(what)
    handles = what.handles
    names = handle_names(len(what.walk.dragon) + 1)
    texts = _("{handle} x (m)"), _("{handle} y (m)"), _("{handle} (m/s)")
    labels = _Labels(
        _("Positions"), _("Speeds"), *([text.format(handle=name) for name in names] for text in texts)
    )
    with whole_bytes(path) as made, workbook(made) as book:
        _write_motion(book, what.times, handles, what.gathered("x", "y", "speed"), labels, progress)
        _write_numbering(book, handles, names)


def write_contest_xlsx(path: Path, times: FloatArray, tables: Sequence[FloatArray]) -> None:
    """The contest's result1.xlsx and result4.xlsx, labels and all, in whatever language.

    `tables` are x and y, m, and speed, m/s, (T, H) each; NaN leaves a cell empty.
    """
    handles = range(tables[0].shape[1])
    names = contest_names(len(handles))
    # The contest has two spaces behind the bodies and the tail.
    speeds = [f"{name}{' ' if name in {names[0], names[-1]} else '  '}(m/s)" for name in names]
    x, y = ([f"{name}{axis} (m)" for name in names] for axis in "xy")
    with whole_bytes(path) as made, workbook(made) as book:
        _write_motion(book, times, handles, tables, _Labels("位置", "速度", x, y, speeds), silent)


def write_moment_xlsx(
    path: Path, tables: Sequence[FloatArray], obstacles: Sequence[ObstacleAnswers] = ()
) -> None:
    """The contest's result2.xlsx, in whatever language: x and y, m, and speed, m/s, (H,) each.

    What was found about obstacles stands in a second sheet, in the language in use.
    """
    with whole_bytes(path) as made, workbook(made) as book:
        six = book.add_format({"num_format": "0.000000"})
        sheet = book.add_worksheet("Sheet1")
        sheet.freeze_panes(1, 1)
        sheet.set_column(0, 3, 18)
        sheet.write_row(0, 1, ["横坐标x (m)", "纵坐标y (m)", "速度 (m/s)"])
        table = np.column_stack(tables)
        for i, name in enumerate(contest_names(len(table))):
            _write_row(sheet, i + 1, name, table[i], six)
        if obstacles:
            _write_obstacles(book, obstacles)


def kind_name(kind: Kind) -> str:
    """The name of a kind of obstacle, in the language in use."""
    return {
        "circle": _("circle"),
        "rectangle": _("rectangle"),
        "polygon": _("polygon"),
        "line": _("line"),
        "venue": _("edge of the venue"),
    }[kind]


def _write_obstacles(book: Any, obstacles: Sequence[ObstacleAnswers]) -> None:
    """A sheet with the least distance to each obstacle, its bracket, when, and which bench."""
    sheet, exact = book.add_worksheet(_("Obstacles")), book.add_format({"num_format": "0.000000000"})
    sheet.freeze_panes(1, 1)
    sheet.set_column(0, 10, 22)
    heads = (
        _("obstacle"), _("kind"), _("margin (m)"), _("least distance from it (m)"), _("at least (m)"),
        _("at most (m)"), _("time (s)"), _("bench"), _("margin not kept from (s)"), _("bench"),
    )  # fmt: skip
    sheet.write_row(0, 0, heads)
    for row, answers in enumerate(obstacles, start=1):
        obstacle, distance, contact = answers.obstacle, answers.distance, answers.contact
        sheet.write_string(row, 0, shown_name(obstacle))
        sheet.write_string(row, 1, kind_name(obstacle.kind))
        numbers = (obstacle.margin, distance.value, distance.lower, distance.upper)
        for column, value in enumerate(numbers, start=2):
            sheet.write_number(row, column, value, exact)
        for column, answer, time in (
            (6, distance, distance.witness and distance.witness.time),
            (8, contact, contact and contact.value),
        ):
            if answer is not None and answer.witness is not None and time is not None:
                sheet.write_number(row, column, time, exact)
                sheet.write_number(row, column + 1, answer.witness.benches[0])


def _write_motion(
    book: Any, times: FloatArray, handles: Sequence[int], tables: Sequence[FloatArray],
    labels: _Labels, progress: Progress,
) -> None:  # fmt: skip
    """The sheets of positions and of speeds."""
    x, y, speed = tables
    six = book.add_format({"num_format": "0.000000"})
    positions = _sheet(book, labels.positions, times)
    for i, handle in enumerate(handles):
        _write_row(positions, 2 * i + 1, labels.x[handle], x[:, i], six)
        _write_row(positions, 2 * i + 2, labels.y[handle], y[:, i], six)
        progress(0.67 * (i + 1) / len(handles), "")
    speeds = _sheet(book, labels.speeds, times)
    for i, handle in enumerate(handles):
        _write_row(speeds, i + 1, labels.speed[handle], speed[:, i], six)
        progress(0.67 + 0.33 * (i + 1) / len(handles), "")


@contextmanager
def workbook(made: io.BytesIO) -> Iterator[Any]:
    """A workbook whose rows wait in files that are gone when the block ends, however that ends."""
    import xlsxwriter  # slow to import

    # A failure leaves some files open, which Windows would not remove: the first failure is reported.
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        options = {"constant_memory": True, "nan_inf_to_errors": False, "tmpdir": folder}
        book = xlsxwriter.Workbook(made, options)
        yield book
        failure: OSError | None = None
        try:
            book.close()
        except xlsxwriter.exceptions.FileCreateError as error:
            failure = OSError(*error.args[0].args)
        # Raised out here, it holds no half-made archive that would complain when it is dropped.
        if failure:
            raise failure


def _sheet(book: Any, name: str, times: FloatArray) -> Any:
    sheet = book.add_worksheet(name)
    sheet.freeze_panes(1, 1)
    sheet.set_column(0, 0, 18)
    sheet.set_column(1, len(times), 12)
    sheet.write_row(0, 1, [f"{t:z.12g} s" for t in times])
    return sheet


def _write_numbering(book: Any, handles: Sequence[int], names: Sequence[str]) -> None:
    """A sheet with the number of each handle, and of its benches, beside the contest's name."""
    sheet = book.add_worksheet(_("Numbering"))
    sheet.freeze_panes(1, 0)
    sheet.set_column(0, 2, 22)
    sheet.write_row(0, 0, [_("in the contest"), _("handle"), _("on benches"), "", numbering_text()])
    for row, handle in enumerate(handles, start=1):
        sheet.write_string(row, 0, names[handle])
        sheet.write_number(row, 1, handle)
        sheet.write_string(row, 2, handle_place(handle, len(names) - 1))


def _write_row(sheet: Any, row: int, name: str, values: FloatArray, style: Any) -> None:
    sheet.write_string(row, 0, name)
    for column, value in enumerate((np.round(values, 6) + 0.0).tolist(), start=1):
        if value == value:
            sheet.write_number(row, column, value, style)


def write_csv(path: Path, what: Selection, progress: Progress) -> None:
    """Long form, time_s,handle,x_m,y_m,v_m_s, in full precision; UTF-8 with a mark for spreadsheets."""
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8-sig", newline="") as out:
        out.write("time_s,handle,x_m,y_m,v_m_s\r\n")
        done = 0
        for motion in what.motions():
            done += len(motion.times)
            columns = [column.tolist() for column in _long(motion, what.handles)]
            for t, handle, x, y, v in zip(*columns, strict=True):
                text = f"{x!r},{y!r},{v!r}" if x == x else ",,"
                out.write(f"{t!r},{handle},{text}\r\n")
            progress(done / len(what.times), "")


def write_npz(path: Path, what: Selection, progress: Progress) -> None:
    """NumPy arrays time (T,), handle (H,), x, y, s, speed (T, H).

    Raises:
        InputError: for more than memory should hold.
    """
    times, handles = what.times, what.handles
    _check_memory(what)
    x, y, s, speed = what.gathered("x", "y", "s", "speed")
    with whole_file(path) as temporary, temporary.open("wb") as out:
        np.savez_compressed(out, time=times, handle=np.array(handles), x=x, y=y, s=s, speed=speed)
    progress(1.0, "")


def write_parquet(path: Path, what: Selection, progress: Progress) -> None:
    """The CSV's long form as Parquet (needs the extra `data`)."""
    with brought_by("data"):
        import pyarrow as pa  # an optional extra
        from pyarrow import parquet
    names = ["time_s", "handle", "x_m", "y_m", "v_m_s"]
    kinds = [pa.float64(), pa.int32(), pa.float64(), pa.float64(), pa.float64()]
    schema = pa.schema(list(zip(names, kinds, strict=True)))
    with whole_file(path) as temporary, parquet.ParquetWriter(temporary, schema) as out:
        done = 0
        for motion in what.motions():
            done += len(motion.times)
            out.write_table(
                pa.table(dict(zip(names, _long(motion, what.handles), strict=True)), schema)
            )
            progress(done / len(what.times), "")


def write_netcdf(path: Path, what: Selection, progress: Progress) -> None:
    """NetCDF 4 with x, y, s, speed over (time, handle), units included (needs the extra `data`).

    Raises:
        InputError: for more than memory should hold.
    """
    with brought_by("data"):
        import h5netcdf  # an optional extra
    _check_memory(what)
    times, handles = what.times, what.handles
    units = {"x": "m", "y": "m", "s": "m", "speed": "m s-1"}
    with whole_bytes(path) as made, h5netcdf.File(made, "w") as out:
        out.dimensions = {"time": len(times), "handle": len(handles)}
        out.create_variable("time", ("time",), data=times).attrs["units"] = "s"
        out.create_variable("handle", ("handle",), data=np.array(handles))
        for name, unit in units.items():
            variable = out.create_variable(name, ("time", "handle"), "f8", compression="gzip")
            variable.attrs["units"] = unit
        done = 0
        for motion in what.motions():
            end = done + len(motion.times)
            for name in units:
                out.variables[name][done:end, :] = getattr(motion, name)[:, handles]
            done = end
            progress(done / len(times), "")


WRITERS: dict[str, Writer] = {
    "xlsx": write_xlsx,
    "csv": write_csv,
    "npz": write_npz,
    "parquet": write_parquet,
    "nc": write_netcdf,
}


def _check_cells(what: Selection) -> None:
    times, handles = len(what.times), len(what.handles)
    if times > MOST_TIMES_XLSX or handles > MOST_HANDLES_XLSX:
        text = _(
            "a spreadsheet holds at most {times} times and {handles} handles; choose fewer, "
            "or another format"
        )
        raise InputError(text.format(times=MOST_TIMES_XLSX, handles=MOST_HANDLES_XLSX))
    if 3 * times * handles > MOST_CELLS_XLSX:
        text = _(
            "a spreadsheet of over {most} cells is refused; choose fewer times or handles, "
            "or another format"
        )
        raise InputError(text.format(most=MOST_CELLS_XLSX))


def _check_memory(what: Selection) -> None:
    if len(what.times) * len(what.handles) > MOST_PLACES_IN_MEMORY:
        text = _("such a file holds at most {most} positions; choose fewer times or handles, or CSV")
        raise InputError(text.format(most=MOST_PLACES_IN_MEMORY))


def _long(motion: Motion, handles: Sequence[int]) -> list[Any]:
    """Columns time, handle, x, y, speed of one slice, time by time."""
    count = len(handles)
    return [
        np.repeat(motion.times + 0.0, count),  # that is 0 and not -0
        np.tile(np.asarray(handles, dtype=np.int32), len(motion.times)),
        motion.x[:, handles].ravel() + 0.0,
        motion.y[:, handles].ravel() + 0.0,
        motion.speed[:, handles].ravel(),
    ]
