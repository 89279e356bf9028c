"""Rows of a sweep: a point's values, and what each question came to there."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from benchdragon.errors import BenchDragonError, brought_by
from benchdragon.hosts.built import source_hash
from benchdragon.plans.schema import Plan
from benchdragon.sweeps.points import Value
from benchdragon.sweeps.questions import LOST, QUESTIONS, REFUSED, Outcome, RandomDances, outcome
from benchdragon.version import __version__

# A point and its number.
Numbered = tuple[int, tuple[Value, ...]]

# What each question has, behind its name and a dot.
FIELDS = {
    "value": "float64",
    "lower": "float64",
    "upper": "float64",
    "status": "string",
    "bench_1": "int32",
    "bench_2": "int32",
    "handle": "int32",
    "time": "float64",
    "s": "float64",
    "x": "float64",
    "y": "float64",
    "seconds": "float64",
    "message": "string",
}
# What differs each time it is asked.
TIMED = "seconds"


def arrow() -> Any:
    """The library of tables.

    Raises:
        MissingExtraError: if it is not installed.
    """
    with brought_by("data"):
        import pyarrow
    return pyarrow


@cache
def made_by() -> dict[bytes, bytes]:
    """The program that answers here: its version, and the hash of its kernels."""
    return {b"benchdragon": __version__.encode(), b"kernels": source_hash().encode()}


def row_schema(keys: Sequence[tuple[str, str]], asked: Sequence[str]) -> Any:
    """Columns of a sweep, by its keys with their types, and the names of its questions."""
    pa = arrow()
    kinds = [("point", "int64"), *keys]
    kinds += [(f"{name}.{column}", kind) for name in asked for column, kind in FIELDS.items()]
    types = {"float64": pa.float64(), "int64": pa.int64(), "int32": pa.int32(), "string": pa.string()}
    return pa.schema([(name, types[kind]) for name, kind in kinds])


@dataclass(frozen=True)
class Ask:
    """The work of a sweep: asks questions at some points, and gives the rows.

    Attributes:
        plan: in which keys are varied.
        keys: with the types of their columns.
        asked: names of questions.
        dances: that `tolerance` walks.
    """

    plan: Plan
    keys: tuple[tuple[str, str], ...]
    asked: tuple[str, ...]
    dances: RandomDances

    def __call__(self, points: Sequence[Numbered]) -> Any:
        """The rows of some points, a record batch that tells what program made it."""
        rows = [self.row(number, values) for number, values in points]
        return self.batch(rows)

    def lost(self, points: Sequence[Numbered], why: str) -> Any:
        """The rows of points that could not be asked."""
        nothing = [Outcome(LOST, message=why)] * len(self.asked)
        return self.batch([self._cells(number, values, nothing) for number, values in points])

    def batch(self, rows: Sequence[dict[str, Any]]) -> Any:
        """Rows as a record batch."""
        schema = row_schema(self.keys, self.asked).with_metadata(made_by())
        return arrow().RecordBatch.from_pylist(rows, schema)

    def row(self, number: int, values: tuple[Value, ...]) -> dict[str, Any]:
        """The row of a point."""
        try:
            names = [key for key, _kind in self.keys]
            plan = self.plan.with_values(dict(zip(names, values, strict=True)))
        except BenchDragonError as error:
            refused = Outcome(REFUSED, message=str(error))
            return self._cells(number, values, [refused] * len(self.asked))
        found = [outcome(QUESTIONS[name], plan, self.dances) for name in self.asked]
        return self._cells(number, values, found)

    def _cells(
        self, number: int, values: tuple[Value, ...], found: Sequence[Outcome]
    ) -> dict[str, Any]:
        row: dict[str, Any] = {"point": number}
        for (key, kind), value in zip(self.keys, values, strict=True):
            row[key] = str(value) if kind == "string" else value
        for name, one in zip(self.asked, found, strict=True):
            row.update((f"{name}.{column}", cell) for column, cell in _cells_of(one).items())
        return row


def _cells_of(found: Outcome) -> dict[str, Any]:
    """The fields of one answer, by name; those without a meaning are left empty."""
    cells: dict[str, Any] = {
        "status": found.status,
        "message": found.message,
        "seconds": found.seconds,
        "lower": found.clear_until,
    }
    answer = found.answer
    if answer is not None:
        cells |= {"value": answer.value, "lower": answer.lower, "upper": answer.upper}
        near = answer.witness
        if near is not None:
            cells |= dict(zip(("bench_1", "bench_2"), near.benches, strict=False))
            cells |= {"handle": near.handle, "time": near.time, "s": near.s}
            cells |= dict(zip(("x", "y"), near.point, strict=True))
    return {name: cell if cell == cell else None for name, cell in cells.items()}  # not NaN
