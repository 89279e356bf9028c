"""A sweep: questions asked of a plan at many points, on many workers, broken off and gone on with."""

import hashlib
import json
import math
import time as clock
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing, nullcontext
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from benchdragon.errors import InputError, MachineError, brought_by, of_kind
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.methods import Method
from benchdragon.parallel import Lost, Place, in_blocks, kept, place_of, processes
from benchdragon.plans.schema import Plan, checked
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress, silent
from benchdragon.sweeps.folder import Rows, lost_rows, opened, read_about, read_rows, write_about
from benchdragon.sweeps.points import Points, Value, grid_points
from benchdragon.sweeps.questions import QUESTIONS, Question, RandomDances, questions
from benchdragon.sweeps.refine import ROUND, Refinement, Refiner, adaptive_version
from benchdragon.sweeps.rows import FIELDS, TIMED, Ask, Numbered, arrow, made_by

if TYPE_CHECKING:
    from benchdragon.figures import plots

FORMAT = 1
# Between two values, as a share of the way; no whole number of benches lies there.
INSIDE = 0.4567
# Points that are tried before a sweep begins, until the plan is right at one. They are drawn at random:
# those at equal distances may all have the same value of a key.
TRIED = 1000


@dataclass(frozen=True)
class Design:
    """What a sweep asks.

    Attributes:
        plan: in which keys are varied.
        points: at which.
        asked: names of questions.
        dances: that `tolerance` walks.
        refinement: further points.
    """

    plan: Plan
    points: Points
    asked: tuple[str, ...]
    dances: RandomDances = field(default_factory=RandomDances)
    refinement: Refinement = field(default_factory=Refinement)

    @property
    def keys(self) -> tuple[tuple[str, str], ...]:
        """The keys, with the types of their columns."""
        pairs = zip(self.points.keys, self.points.columns, strict=True)
        kinds = {key: _kind(column) for key, column in pairs}
        if self.refinement.most:  # which asks between whole numbers, too
            kinds = dict.fromkeys(kinds, "float64")
        return tuple(kinds.items())

    @property
    def work(self) -> Ask:
        """What answers."""
        return Ask(self.plan, self.keys, self.asked, self.dances)

    def about(self) -> dict[str, Any]:
        """All that makes this sweep another than others, as plain data."""
        columns = [list(column) for column in self.points.columns]
        said = json.dumps(columns, sort_keys=True).encode()
        refine = None
        if self.refinement.most:  # with the library that chooses the points
            refine = {**asdict(self.refinement), "adaptive": adaptive_version()}
        told = {
            "format": FORMAT,
            "made_by": {key.decode(): value.decode() for key, value in made_by().items()},
            "plan_sha256": self.plan.sha256,
            "points": {
                "keys": [list(key) for key in self.keys],
                "grid": columns if self.points.grid else None,
                "count": len(self.points),
                "sample": asdict(self.points.sample) if self.points.sample else None,
                "sha256": hashlib.sha256(said).hexdigest(),
            },
            "ask": list(self.asked),
            "dances": asdict(self.dances) if "tolerance" in self.asked else None,
            "refine": refine,
            "plan": self.plan.data(),
            "finished": False,
        }
        plain: dict[str, Any] = json.loads(json.dumps(told))  # as it is read again
        return plain

    def check(self) -> None:
        """Try some points, and what lies between two if there is a refinement.

        Raises:
            PlanError, InputError: if the plan is wrong at each of them, or its walk cannot be.
            InputError: if a key that is to be refined takes no value between.
        """
        most = len(self.points)
        numbers = np.random.default_rng(0).choice(most, min(TRIED, most), replace=False, shuffle=False)
        for number in numbers.tolist():
            values = dict(zip(self.points.keys, self.points[number], strict=True))
            try:
                self.plan.with_values(values).build()
            except (InputError, PlanError) as error:
                wrong = error
            else:
                if self.refinement.most:
                    self._check_between(values)
                return
        raise wrong

    def _check_between(self, values: Mapping[str, Value]) -> None:
        """See that each key takes what lies between two of its values, the others being these."""
        for key, column in zip(self.points.keys, self.points.columns, strict=True):
            low, high = sorted({float(value) for value in column})[:2]
            between = low + INSIDE * (high - low)
            try:
                self.plan.with_values({**values, key: between})
            except PlanError as error:
                text = _("refine: {key} takes no value between others: {why}")
                raise InputError(text.format(key=key, why=error)) from None


def _kind(column: Sequence[Value]) -> str:
    if any(isinstance(value, str) for value in column):
        return "string"
    return "int64" if all(isinstance(value, int) for value in column) else "float64"


@dataclass(frozen=True)
class Sweep:
    """The rows of a sweep.

    Attributes:
        about: what was asked: plan, keys, points, questions, version.
        table: a pyarrow table, one row a point: `point` (its number), each key, and for each question
            FIELDS behind its name and a dot; empty cells where a field means nothing.

    Examples:
        >>> plan = bd.read_plan("spiral-in")
        >>> found = bd.sweep(plan, {"route.pitch": [0.5, 0.6]}, executor=threads)
        >>> found.to_dataframe()["first_contact.value"].round(3).tolist()
        [336.526, 466.509]
    """

    about: Mapping[str, Any]
    table: Any

    plot = plots.plot_sweep if TYPE_CHECKING else Method("plot_sweep")

    @property
    def plan(self) -> Plan:
        """The plan in which keys were varied."""
        return checked(dict(self.about["plan"]), "sweep.json")

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys that were varied."""
        return tuple(key for key, _kind in self.about["points"]["keys"])

    @property
    def questions(self) -> tuple[Question, ...]:
        """What was asked."""
        return tuple(QUESTIONS[name] for name in self.about["ask"])

    @property
    def complete(self) -> bool:
        """Whether it came to its end, that of the refinement too."""
        return bool(self.about["finished"])

    def column(self, name: str) -> FloatArray:
        """A column of numbers, NaN where it is empty."""
        found: FloatArray = self.table[name].to_numpy().astype(np.float64)
        return found

    def texts(self, name: str) -> list[str | None]:
        """A column of texts."""
        found: list[str | None] = self.table[name].to_pylist()
        return found

    def numbers(self) -> Any:
        """The table without what differs each time it is computed: seconds."""
        return self.table.drop_columns([f"{name}.{TIMED}" for name in self.about["ask"]])

    def to_dataframe(self) -> Any:
        """The table as a data frame, with the point for index.

        Raises:
            MissingExtraError: without pandas.
        """
        with brought_by("data"):
            import pandas  # noqa: F401 - pyarrow needs it
        return self.table.to_pandas().set_index("point")

    def to_xarray(self) -> Any:
        """The grid as a dataset: each key a dimension, each column a variable, units included.

        Points of a refinement are left out.

        Raises:
            InputError: if the points were no grid, or some are missing.
            MissingExtraError: without xarray.
        """
        with brought_by("data"):
            import xarray
        axes, first = self.about["points"]["grid"], int(self.about["points"]["count"])
        table = self.table.slice(0, first)
        if axes is None or table["point"].to_pylist() != list(range(first)):
            raise InputError(_("only a complete grid has a value at each place of a dataset"))
        shape = tuple(map(len, axes))
        variables = {}
        for question in self.questions:
            for name, kind in FIELDS.items():
                column = table[f"{question.name}.{name}"]
                values = column.to_pylist() if kind == "string" else column.to_numpy()
                attributes = {"units": question.unit} if name in {"value", "lower", "upper"} else {}
                called = question.name if name == "value" else f"{question.name}.{name}"
                array = np.array(values, dtype=object if kind == "string" else None)
                variables[called] = (self.keys, array.reshape(shape), attributes)
        marks = {"plan": self.about["plan_sha256"], "benchdragon": self.about["made_by"]["benchdragon"]}
        return xarray.Dataset(variables, dict(zip(self.keys, axes, strict=True)), marks)


def read_sweep(folder: Path | str) -> Sweep:
    """The sweep in a folder, as far as it has come.

    Raises:
        InputError: if there is none, or rows of another one.
        MissingExtraError: without pyarrow.

    Examples:
        >>> plan, where = bd.read_plan("spiral-in"), folder / "pitches"
        >>> _ = bd.sweep(plan, {"route.pitch": [0.5, 0.6]}, output=where, executor=threads)
        >>> bd.read_sweep(where).complete
        True
    """
    about = read_about(Path(folder))
    return Sweep(about, read_rows(Path(folder), about))


def sweep(
    plan: Plan, vary: Mapping[str, Iterable[Value]] | Points, ask: Sequence[str] = ("first_contact",),
    *, output: Path | str | None = None, dances: RandomDances | None = None,
    refinement: Refinement | None = None, executor: Executor | Place | None = None,
    progress: Progress = silent,
) -> Sweep:  # fmt: skip
    """Questions asked of a plan at many points; the same call goes on where one was broken off.

    Args:
        plan: in which keys are varied.
        vary: values of each key, of which every combination is a point, in steps as on the command
            line ("0.45:0.6:0.01") or one by one; or points made by `points.grid_points`,
            `listed_points`, `sampled_points`, `read_points`.
        ask: names of QUESTIONS.
        output: a folder for the rows, which need not fit into memory until they are read; else they
            are kept in memory.
        dances: that the question "tolerance" walks.
        refinement: further points where answers change most, for one key or two.
        executor: that runs the work, or a place of `parallel`; processes of this machine, one a core,
            if there is none. Those are new interpreters, so that a script needs `if __name__ ==
            "__main__"`.
        progress: is called with the share of points done.

    Raises:
        InputError: for questions that are unknown, or points that cannot be.
        PlanError: if the plan is wrong at all points.
        FileRefusedError: for a folder of another sweep.
        MissingExtraError: without pyarrow.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 40})
        >>> found = bd.sweep(plan, {"route.pitch": [0.5, 0.6]}, ["first_contact"], executor=threads)
        >>> list(found.keys), len(found.to_dataframe())
        (['route.pitch'], 2)
    """
    of_kind("plan", plan, Plan)
    points = vary if isinstance(vary, Points) else grid_points(vary)
    asked = tuple(question.name for question in questions(ask))
    design = Design(plan, points, asked, dances or RandomDances(), refinement or Refinement())
    where = place_of(executor, processes())
    return run(design, where, None if output is None else Path(output), progress)


def run(design: Design, place: Place, folder: Path | None, progress: Progress = silent) -> Sweep:
    """The rows of a design, those in a folder included.

    Raises:
        PlanError: see `sweep`, as for all others.
    """
    arrow()
    refiner = Refiner(design.points, design.refinement) if design.refinement.most else None
    design.check()
    about = design.about()
    with nullcontext() if folder is None else opened(folder, about), kept(place) as there:
        rows = Rows(about, folder)
        try:
            answered = _Answered(design, there, rows, progress)
            answered.ask(0, design.points)
            if refiner is not None:
                _refine(refiner, answered)
        finally:
            rows.write()
        about["finished"] = True
        if folder is not None:
            write_about(folder, about)
        table = rows.table()
    return Sweep(about, table)


class _Answered:
    """The points that have rows, and the asking of others."""

    def __init__(self, design: Design, place: Place, rows: Rows, progress: Progress) -> None:
        self.design, self.rows = design, rows
        self._place, self._work, self._progress = place, design.work, progress
        self._most = len(design.points) + design.refinement.most
        self._has = np.zeros(self._most, dtype=bool)
        names = [*design.points.keys, *(f"{name}.value" for name in design.asked)]
        self._names = names if design.refinement.most else []
        self.numbers = np.full((self._most, len(self._names)), math.nan)
        self._keep(self._standing(rows.table()))
        self._done = self._found = int(self._has.sum())
        self._began = clock.monotonic()

    def _standing(self, table: Any) -> Any:
        """The rows that stay: all once a refinement rests on them, else all but the lost ones."""
        if (table["point"].to_numpy() >= len(self.design.points)).any():
            return table
        return table.filter(~lost_rows(table, list(self.design.asked)))

    def _keep(self, rows: Any) -> None:
        """Take down which points have rows, and for a refinement their keys and values."""
        points = rows["point"].to_numpy()
        self._has[points] = True
        for n, name in enumerate(self._names):
            self.numbers[points, n] = rows[name].to_numpy(zero_copy_only=False)

    def ask(self, first: int, points: Points) -> None:
        """Have rows for points, whose numbers begin with `first`."""
        missing = np.flatnonzero(~self._has[first : first + len(points)])
        waiting = _Numbered(missing, first, points)
        with closing(in_blocks(self._work, waiting, self._place)) as blocks:
            for asked, found in blocks:
                batch = self._work.lost(asked, found.reason) if isinstance(found, Lost) else found
                if batch.schema.metadata != made_by():
                    raise MachineError(_("a worker runs another version of benchdragon than this one"))
                self.rows.add(batch)
                self._keep(batch)
                self._tell(len(asked))

    def _tell(self, more: int) -> None:
        self._done += more
        seconds = clock.monotonic() - self._began
        rate = (self._done - self._found) / max(seconds, 1e-9)
        left = (self._most - self._done) / rate
        text = _("{done} of {most} points, {rate} a second, {left} s left")
        self._progress(
            self._done / self._most,
            text.format(done=self._done, most=self._most, rate=f"{rate:.3g}", left=f"{left:.0f}"),
        )


@dataclass(frozen=True)
class _Numbered(Sequence[Numbered]):
    """Points with their numbers, made when they are sent."""

    missing: IntArray
    first: int
    points: Points

    def __len__(self) -> int:
        return len(self.missing)

    def __getitem__(self, at: Any) -> Any:
        """One of them, or a list of them."""
        if not isinstance(at, slice):
            return self[at : at + 1][0]
        missing = self.missing[at]
        return list(zip((self.first + missing).tolist(), self.points.at(missing), strict=True))


def _refine(refiner: Refiner, answered: _Answered) -> None:
    """Ask in rounds where the refiner says."""
    design, told = answered.design, 0
    most, keys = len(design.points) + design.refinement.most, len(design.points.keys)
    asked = len(design.points)
    while True:
        numbers = answered.numbers[told:asked]
        refiner.tell(numbers[:, :keys].tolist(), numbers[:, keys:])
        wanted, told = refiner.ask(min(ROUND, most - asked)), asked
        if not wanted:
            return
        columns = tuple(zip(*wanted, strict=True))
        answered.ask(asked, Points(design.points.keys, columns, grid=False))
        asked += len(wanted)
