"""Points of a sweep: grids, lists and samples of values for keys of a plan."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Any, Literal

import numpy as np

from benchdragon.errors import InputError, brief, brought_by, did_you_mean, whole
from benchdragon.i18n import _
from benchdragon.kernels.route import IntArray
from benchdragon.plans.faults import single_keys
from benchdragon.plans.schema import Plan
from benchdragon.plans.units import RANGE

Value = float | int | str
Method = Literal["latin-hypercube", "sobol"]
METHODS: tuple[Method, ...] = ("latin-hypercube", "sobol")

# Of a grid; of a list, whose values are held in memory: 0.1 GB a key.
MOST_POINTS, MOST_LISTED, MOST_KEYS = 10_000_000, 1_000_000, 20
# Whole numbers beyond would not be the same as floating-point numbers.
LARGEST = 2**53
KEY = re.compile(r"[a-z_]+(\.[a-z_0-9]+)+")


@dataclass(frozen=True)
class Sample:
    """How points were drawn.

    Attributes:
        ranges: of each key, its lowest and its highest value.
        seed: of the numbers.
        method: one of METHODS.
    """

    ranges: tuple[tuple[float, float], ...]
    seed: int
    method: Method


@dataclass(frozen=True)
class Points:
    """Values for keys of a plan.

    Attributes:
        keys: of the plan.
        columns: of a grid the values of each key, of which every combination is a point, the last key
            varying fastest; else the values of each key at each point.
        grid: which of both.
        sample: how they were drawn, if they were.

    Examples:
        >>> len(bd.listed_points({"route.pitch": [0.5, 0.6]}))
        2
    """

    keys: tuple[str, ...]
    columns: tuple[tuple[Value, ...], ...]
    grid: bool
    sample: Sample | None = None

    def __post_init__(self) -> None:
        """Check keys and the number of points.

        Raises:
            InputError: for keys that cannot be or stand twice, no points, or too many.
        """
        for key in self.keys:
            if not KEY.fullmatch(key) or self.keys.count(key) > 1:
                text = _("expected keys of a plan such as route.pitch, each once, not {key}")
                raise InputError(text.format(key=key) + did_you_mean(key, single_keys(Plan)))
        if any(len(column) > MOST_LISTED for column in self.columns):
            raise InputError(_("a key takes at most {most} values").format(most=MOST_LISTED))
        count = math.prod(self.shape) if self.columns else 0
        most = MOST_POINTS if self.grid else MOST_LISTED
        if not 0 < len(self.keys) <= MOST_KEYS or not 0 < count <= most:
            text = _("expected 1 to {most} points of 1 to {keys} keys, not {count} of {given}")
            raise InputError(text.format(most=most, keys=MOST_KEYS, count=count, given=len(self.keys)))

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """Numbers of values of each key of a grid; of all points of a list."""
        sizes = tuple(len(column) for column in self.columns)
        return sizes if self.grid else sizes[:1]

    def __len__(self) -> int:
        return math.prod(self.shape)

    def __getitem__(self, number: int) -> tuple[Value, ...]:
        """The values at a point."""
        if not 0 <= number < len(self):
            raise IndexError(number)
        return self.at(np.array([number]))[0]

    def at(self, numbers: IntArray) -> list[tuple[Value, ...]]:
        """The values at each of these points."""
        places: Sequence[Any] = (numbers,) * len(self.keys)
        if self.grid:
            places = np.unravel_index(numbers, self.shape)
        chosen = (
            [column[n] for n in place.tolist()]
            for column, place in zip(self.columns, places, strict=True)
        )
        return list(zip(*chosen, strict=True))

    @property
    def numeric(self) -> bool:
        """Whether all values are numbers."""
        return not any(isinstance(value, str) for column in self.columns for value in column)


def grid_points(vary: Mapping[str, Iterable[Value]]) -> Points:
    """Every combination of the values of each key.

    Raises:
        InputError: for values that are no finite numbers or texts, and as `Points`.
    """
    keys, columns = _columns(vary)
    for key, column in zip(keys, columns, strict=True):
        if len(set(column)) < len(column):
            raise InputError(_("{key}: a value stands twice").format(key=key))
    return Points(keys, columns, grid=True)


def listed_points(columns: Mapping[str, Sequence[Value]]) -> Points:
    """Points one by one.

    Raises:
        InputError: for columns of different lengths, and as `grid_points`.

    Examples:
        >>> points = bd.listed_points({"route.pitch": [0.5, 0.6], "disc.radius": [4.0, 5.0]})
        >>> points[1]
        (0.6, 5.0)
    """
    keys, made = _columns(columns)
    if len({len(column) for column in made}) > 1:
        raise InputError(_("all keys need as many values: one a point"))
    return Points(keys, made, grid=False)


def _columns(
    columns: Mapping[str, Iterable[Value]],
) -> tuple[tuple[str, ...], tuple[tuple[Value, ...], ...]]:
    """Keys, and the values of each; InputError for invalid ones."""
    _check_mapping(columns)
    columns = {
        key: parse_vary([f"{key}={values}"])[key] if _stepped(values) else values
        for key, values in columns.items()
    }
    for key, values in columns.items():
        if isinstance(values, str) or not isinstance(values, Iterable):
            text = _("{key}: expected a list of values, not {value}")
            raise InputError(text.format(key=key, value=values))
    made = tuple(
        tuple(_value(key, one) for one in islice(values, MOST_LISTED + 1))
        for key, values in columns.items()
    )
    return tuple(columns), made


def _stepped(values: object) -> bool:
    """Whether values are given in steps, as on the command line: "0.45..0.6..0.01"."""
    return isinstance(values, str) and RANGE in values


def _check_mapping(columns: object) -> None:
    if not isinstance(columns, Mapping) or not all(isinstance(key, str) for key in columns):
        text = _("expected values of keys such as route.pitch, not {value}")
        raise InputError(text.format(value=brief(columns)))


def sampled_points(
    ranges: Mapping[str, tuple[float, float]], count: int, seed: int = 1,
    method: Method = "latin-hypercube",
) -> Points:  # fmt: skip
    """So many points between two values of each key, by scipy.stats.qmc; whole numbers where both are.

    Raises:
        InputError: for ranges that are none, an unknown method, and as `Points`.

    Examples:
        >>> points = bd.sampled_points({"route.pitch": (0.5, 0.6)}, 4, seed=1, method="sobol")
        >>> len(points)
        4
    """
    from scipy.stats import qmc  # slow to import

    _check_mapping(ranges)
    whole("sample", count, 1, MOST_LISTED)
    whole("seed", seed, 0, 2**63 - 1)
    if method not in METHODS:
        raise InputError(_("expected one of {known}, not {name}").format(known=METHODS, name=method))
    plain = {key: _ends(key, ends) for key, ends in ranges.items()}
    if method == "sobol":  # balanced in powers of two: the first of those are taken
        shares = qmc.Sobol(len(ranges), rng=seed).random_base2((count - 1).bit_length())[:count]
    else:
        shares = qmc.LatinHypercube(len(ranges), rng=seed).random(count)
    columns: dict[str, Sequence[Value]] = {}
    for (key, (low, high)), share in zip(plain.items(), shares.T, strict=True):
        if isinstance(low, int) and isinstance(high, int):
            columns[key] = (low + np.floor(share * (high - low + 1))).astype(int).tolist()
        else:
            columns[key] = (low + share * (high - low)).tolist()
    return replace(listed_points(columns), sample=Sample(tuple(plain.values()), seed, method))


def _ends(key: str, ends: Iterable[float]) -> tuple[float, float]:
    """Both ends of a range, as plain numbers, or InputError."""
    plain = [_value(key, end) for end in ends]
    numbers = [end for end in plain if not isinstance(end, str)]
    if len(plain) != 2 or len(numbers) != 2:
        raise InputError(_("{key}: a sample needs a range LOW..HIGH").format(key=key))
    low, high = numbers
    if not low < high:
        text = _("{key}: expected a range from a smaller value to a larger one, not {ends}")
        raise InputError(text.format(key=key, ends=f"{low:g}{RANGE}{high:g}"))
    return low, high


def read_points(path: Path) -> Points:
    """The points in a CSV or Parquet file, whose columns are keys.

    Raises:
        InputError: for a file that cannot be read, and as `Points`.
        MissingExtraError: without pyarrow.

    Examples:
        >>> _ = (folder / "points.csv").write_text("route.pitch,disc.radius" + chr(10) + "0.5,4.5")
        >>> bd.read_points(folder / "points.csv").keys
        ('route.pitch', 'disc.radius')
    """
    with brought_by("data"):
        import pyarrow as pa
        from pyarrow import csv, parquet
    try:
        read = parquet.read_table if path.suffix == ".parquet" else csv.read_csv
        table = read(path)
        keys = tuple(table.column_names)  # of which one may stand twice
    except (OSError, UnicodeDecodeError, pa.ArrowException) as error:
        text = _("{path} is no CSV or Parquet file of points: {why}")
        raise InputError(text.format(path=path, why=error)) from None
    if table.num_rows > MOST_LISTED:
        raise InputError(_("a key takes at most {most} values").format(most=MOST_LISTED))
    columns = tuple(
        tuple(_value(key, one) for one in column.to_pylist())
        for key, column in zip(keys, table.columns, strict=True)
    )
    return Points(keys, columns, grid=False)


def parse_vary(texts: Sequence[str], *, ranges: bool = False) -> dict[str, Any]:
    """What "KEY=A..B..STEP" and "KEY=A,B,C" say: the values of each key; or with `ranges` the ends.

    Values in steps are those of decimal arithmetic: 0.46 and not 0.45999999999999996.

    Raises:
        InputError: for anything else.
    """
    found: dict[str, Any] = {}
    for text in texts:
        key, equals, values = (word.strip() for word in text.partition("="))
        stepped = RANGE in values
        parts = [word.strip() for word in values.split(RANGE if stepped else ",")]
        if not equals or not key or not all(parts) or key in found:
            raise _unreadable(text)
        if ranges:
            if not stepped or len(parts) != 2:
                raise InputError(_("{key}: a sample needs a range LOW..HIGH").format(key=key))
            found[key] = tuple(map(_number, parts))
        elif stepped:
            if len(parts) != 3:
                raise _unreadable(text)
            found[key] = _steps(text, *parts)
        else:
            found[key] = [_number(part) for part in parts]
        if math.prod(map(len, found.values())) > MOST_POINTS:
            raise InputError(_("these are more than {most} points").format(most=MOST_POINTS))
    return found


def _unreadable(text: str) -> InputError:
    said = _(
        "expected KEY=FIRST..LAST..STEP or KEY=VALUE,VALUE,... (route.pitch=0.45..0.6..0.01), not "
        "{text}"
    )
    return InputError(said.format(text=repr(text)))


def _number(text: str) -> Value:
    try:
        return int(text)
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        return text


def _steps(text: str, first: str, last: str, step: str) -> list[Value]:
    try:
        low, high, by = (Decimal(word) for word in (first, last, step))
        count = (high - low) / by
        sound = by != 0 and all(abs(end) <= LARGEST for end in (low, high, by))
    except ArithmeticError:
        raise _unreadable(text) from None
    if not sound or not 0 <= count < MOST_LISTED:
        said = _("{text}: expected 1 to {most} steps from the first value to the last")
        raise InputError(said.format(text=text, most=MOST_LISTED))
    exact = (low + n * by for n in range(int(count) + 1))
    return [
        int(value) if "." not in first + step and value == int(value) else float(value)
        for value in exact
    ]


def _value(key: str, value: object) -> Value:
    """A value as plain data, or InputError."""
    if isinstance(value, np.generic):
        value = value.item()
    sound = isinstance(value, str | float | int) and not isinstance(value, bool)
    large = isinstance(value, int) and abs(value) > LARGEST
    if not sound or large or (isinstance(value, float) and not math.isfinite(value)):
        text = _("{key}: expected finite numbers or texts, not {value}")
        raise InputError(text.format(key=key, value=value))
    return value  # type: ignore[return-value]
