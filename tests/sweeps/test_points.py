"""Points of a sweep: grids, lists, samples, and what the command line says of them."""

import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from benchdragon.errors import InputError
from benchdragon.sweeps.points import (
    MOST_KEYS,
    Points,
    grid_points,
    listed_points,
    parse_vary,
    read_points,
    sampled_points,
)

KEYS = "expected keys of a plan such as route.pitch, each once, not "
UNREADABLE = "expected KEY=FIRST..LAST..STEP or KEY=VALUE,VALUE,... (route.pitch=0.45..0.6..0.01), not "


def each(points: Points) -> list[Any]:
    """The values at each point."""
    return [points[number] for number in range(len(points))]


def test_the_last_key_of_a_grid_varies_fastest() -> None:
    values: dict[str, Any] = {
        "route.pitch": [0.45, 0.5],
        "dragon.benches": [8, 9, 10],
        "route.part.0.turn": ["left"],
    }
    points = grid_points(values)
    assert points.keys == tuple(values)
    assert points.shape == (2, 3, 1)
    assert each(points) == list(itertools.product(*values.values()))
    assert points[4] == (0.5, 9, "left")
    assert len(points) == 6
    assert not points.numeric
    assert grid_points({"a.b": [1], "a.c": [2.5]}).numeric


def test_values_may_be_of_numpy_and_become_plain() -> None:
    points = grid_points({"a.b": np.array([1, 2]), "a.c": np.linspace(0.0, 1.0, 3)})
    assert [type(value) for column in points.columns for value in column] == [int] * 2 + [float] * 3


@pytest.mark.parametrize("points", [grid_points({"a.b": [1, 2]}), listed_points({"a.b": [1, 2]})])
def test_no_point_stands_outside(points: Points) -> None:
    for number in (-1, 2):
        with pytest.raises(IndexError):
            points[number]


def test_a_list_goes_through_its_columns_side_by_side() -> None:
    points = listed_points({"a.b": [1, 2, 3], "a.c": ["x", 2, 0.5]})
    assert (points.shape, points.grid) == ((3,), False)
    assert each(points) == [(1, "x"), (2, 2), (3, 0.5)]
    with pytest.raises(InputError, match=r"^all keys need as many values: one a point$"):
        listed_points({"a.b": [1, 2], "a.c": [1]})


@pytest.mark.parametrize("key", ["pitch", "", "Route.pitch", "route.", "route pitch", ".a"])
def test_keys_that_cannot_be_are_refused(key: str) -> None:
    with pytest.raises(InputError) as refused:
        grid_points({key: [1]})
    said, hint, _end = str(refused.value).partition("; did you mean route.")
    assert said == KEYS + key
    assert bool(hint) is ("route" in key.casefold() or key == "pitch")


def test_a_key_stands_once() -> None:
    with pytest.raises(InputError, match=r"each once, not a\.b$"):
        Points(("a.b", "a.b"), ((1,), (2,)), grid=True)


@pytest.mark.parametrize(
    ("vary", "count", "keys"),
    [
        ({}, 0, 0),
        ({"a.b": []}, 0, 1),
        ({"a.b": [1], "a.c": []}, 0, 2),
        ({f"a.b{n}": [1] for n in range(MOST_KEYS + 1)}, 1, MOST_KEYS + 1),
        ({"a.b": range(10_000), "a.c": range(1001)}, 10_010_000, 2),
        ({f"a.b{n}": range(1000) for n in range(20)}, 10**60, 20),
    ],
)
def test_there_are_neither_no_points_nor_too_many(vary: dict[str, Any], count: int, keys: int) -> None:
    with pytest.raises(InputError) as refused:
        grid_points(vary)
    said = f"expected 1 to 10000000 points of 1 to 20 keys, not {count} of {keys}"
    assert str(refused.value) == said


@pytest.mark.parametrize(
    "value", [float("nan"), float("inf"), None, True, np.True_, 1j, [1], 2**53 + 1, -(2**60)]
)
def test_values_that_are_none_are_refused(value: object) -> None:
    for make in (grid_points, listed_points):
        with pytest.raises(InputError, match=r"^a\.b: expected finite numbers or texts, not "):
            make({"a.b": [1, value]})  # type: ignore[list-item]


@pytest.mark.parametrize("values", ["left", 0.5, None])
def test_what_is_no_list_of_values_is_refused(values: Any) -> None:
    with pytest.raises(InputError, match=rf"^a\.b: expected a list of values, not {values}$"):
        grid_points({"a.b": values})


def test_values_in_steps_may_be_said_as_on_the_command_line() -> None:
    said: dict[str, Any] = {"a.b": "0.45..0.5..0.01", "a.c": [1, 2]}
    assert grid_points(said) == grid_points({**parse_vary(["a.b=0.45..0.5..0.01"]), "a.c": [1, 2]})
    assert grid_points(said).columns[0] == (0.45, 0.46, 0.47, 0.48, 0.49, 0.5)
    with pytest.raises(InputError, match=r"expected KEY=FIRST\.\..*, not 'a\.b=0\.45\.\.0\.5'"):
        grid_points({"a.b": "0.45..0.5"})


@pytest.mark.parametrize("count", [1, 7, 100])
def test_a_latin_hypercube_has_one_point_in_each_stratum(count: int) -> None:
    points = sampled_points({"a.b": (2.0, 5.0), "a.c": (-1.0, 1.0)}, count, seed=3)
    for column, (low, high) in zip(points.columns, [(2.0, 5.0), (-1.0, 1.0)], strict=True):
        strata = np.floor((np.array(column) - low) / (high - low) * count)
        assert sorted(strata) == list(range(count))


def test_a_sobol_sample_is_balanced_and_its_first_points_are_those_of_a_longer_one() -> None:
    points = sampled_points({"a.b": (0.0, 1.0), "a.c": (0.0, 1.0)}, 64, seed=3, method="sobol")
    cells = {(int(8 * x), int(8 * y)) for x, y in each(points)}
    assert len(cells) == 64
    some = sampled_points({"a.b": (0.0, 1.0), "a.c": (0.0, 1.0)}, 33, seed=3, method="sobol")
    assert each(some) == each(points)[:33]
    assert len(sampled_points({"a.b": (0.0, 1.0)}, 1, method="sobol")) == 1


@pytest.mark.parametrize("method", ["latin-hypercube", "sobol"])
def test_the_same_seed_gives_the_same_points(method: Any) -> None:
    one, again, other = (
        sampled_points({"a.b": (0.0, 1.0)}, 16, seed=seed, method=method) for seed in (1, 1, 2)
    )
    assert one == again != other


def test_samples_between_whole_numbers_are_whole_and_as_frequent() -> None:
    points = sampled_points({"a.b": (3, 7), "a.c": (3, 7.5)}, 500)
    whole, real = points.columns
    assert all(type(value) is int for value in whole)
    assert np.unique(whole, return_counts=True)[1].tolist() == [100] * 5
    assert all(type(value) is float for value in real)
    assert 7.4 < max(map(float, real)) < 7.5


@pytest.mark.parametrize(
    ("ranges", "said"),
    [
        ({"a.b": (1.0, 1.0)}, "a.b: expected a range from a smaller value to a larger one, not 1..1"),
        ({"a.b": (2, 1)}, "a.b: expected a range from a smaller value to a larger one, not 2..1"),
        ({"a.b": (1, 2, 3)}, "a.b: a sample needs a range LOW..HIGH"),
        ({"a.b": ("x", 2)}, "a.b: a sample needs a range LOW..HIGH"),
        ({"a.b": (1, float("nan"))}, "a.b: expected finite numbers or texts, not nan"),
        ({}, "expected 1 to 1000000 points of 1 to 20 keys, not 0 of 0"),
    ],
)
@pytest.mark.parametrize("method", ["latin-hypercube", "sobol"])
def test_ranges_that_are_none_are_refused(ranges: Any, said: str, method: Any) -> None:
    with pytest.raises(InputError) as refused:
        sampled_points(ranges, 5, method=method)
    assert str(refused.value) == said


def test_samples_need_a_number_a_seed_and_a_method_that_can_be() -> None:
    for count in (0, 1.5, 10_000_001):
        with pytest.raises(InputError, match=r"^sample must be a whole number from 1 to 1000000, not"):
            sampled_points({"a.b": (0, 1)}, count)  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"^seed must be a whole number from 0 to"):
        sampled_points({"a.b": (0, 1)}, 2, seed=-1)
    with pytest.raises(InputError, match=r"expected one of .*sobol.*, not halton"):
        sampled_points({"a.b": (0, 1)}, 2, method="halton")  # type: ignore[arg-type]


TABLE: dict[str, Any] = {
    "route.pitch": [0.45, 0.46, 0.55],
    "dragon.benches": [8, 9, 10],
    "a.b": ["x", "y", "x"],
}


@pytest.mark.parametrize("name", ["points.csv", "points.parquet", "points.txt"])
def test_points_are_read_from_tables(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    if name.endswith("parquet"):
        parquet.write_table(pa.table(TABLE), path)
    else:
        rows = [
            ",".join(TABLE),
            *(",".join(map(str, row)) for row in zip(*TABLE.values(), strict=True)),
        ]
        path.write_text("\n".join(rows), "utf-8")
    assert read_points(path) == listed_points(TABLE)


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("none.csv", None, "{path} is no CSV or Parquet file of points: "),
        ("empty.csv", "", "{path} is no CSV or Parquet file of points: "),
        ("uneven.csv", "a.b,a.c\n1\n", "{path} is no CSV or Parquet file of points: "),
        ("text.parquet", "a.b\n1\n", "{path} is no CSV or Parquet file of points: "),
        (
            "twice.csv",
            "a.b,a.b\n1,2\n",
            KEYS + "a.b",
        ),
        ("key.csv", "pitch\n1\n", KEYS + "pitch"),
        ("gap.csv", "a.b,a.c\n1,2\n,3\n", "a.b: expected finite numbers or texts, not None"),
        ("head.csv", "a.b\n", "expected 1 to 1000000 points of 1 to 20 keys, not 0 of 1"),
        ("truth.csv", "a.b\ntrue\n", "a.b: expected finite numbers or texts, not True"),
    ],
)
def test_tables_that_are_none_are_refused(
    tmp_path: Path, name: str, text: str | None, said: str
) -> None:
    path = tmp_path / name
    if text is not None:
        path.write_text(text, "utf-8")
    with pytest.raises(InputError) as refused:
        read_points(path)
    assert str(refused.value).startswith(said.format(path=path))


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("0.45..0.60..0.01", [n / 100 for n in range(45, 61)]),
        ("0.45..0.609..0.01", [n / 100 for n in range(45, 61)]),
        ("0..1..0.1", [n / 10 for n in range(11)]),
        ("1..1..1", [1]),
        ("8..20..4", [8, 12, 16, 20]),
        ("8..21..4", [8, 12, 16, 20]),
        ("3..1..-1", [3, 2, 1]),
        ("1.0..3..1", [1.0, 2.0, 3.0]),
        (" 1 .. 2 .. 1 ", [1, 2]),
        ("1e-3..3e-3..1e-3", [0.001, 0.002, 0.003]),
        ("0.5", [0.5]),
        ("1,2.5, left", [1, 2.5, "left"]),
    ],
)
def test_values_are_read_as_they_are_written(text: str, values: list[Any]) -> None:
    (found,) = parse_vary([f" route.pitch = {text}"]).values()
    assert found == values
    assert [type(value) for value in found] == [type(value) for value in values]


@pytest.mark.parametrize(
    "text",
    [
        "route.pitch", "route.pitch=", "=1", "a.b=1,,2", "a.b=1..2", "a.b=1..2..3..4", "a.b=1..2..0",
        "a.b=x..2..1", "a.b=nan..2..1", "a.b=1..2..nan", "a.b=inf..inf..1", "a.b=1....2",
        "a.b=1:2:1..2",
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_told(text: str) -> None:
    with pytest.raises(InputError) as refused:
        parse_vary([text])
    assert str(refused.value) == UNREADABLE + repr(text)


def test_a_key_is_varied_once() -> None:
    with pytest.raises(InputError, match=r"not 'a\.b=2'"):
        parse_vary(["a.b=1", "a.b=2"])


def test_ranges_are_read_for_samples() -> None:
    assert parse_vary(["a.b=1..2", "a.c=0.5..1"], ranges=True) == {"a.b": (1, 2), "a.c": (0.5, 1)}
    for text in ("a.b=1", "a.b=1..2..3", "a.b=1,2"):
        with pytest.raises(InputError, match=r"^a\.b: a sample needs a range LOW\.\.HIGH$"):
            parse_vary([text], ranges=True)


def test_a_list_is_shorter_than_a_grid_may_be_and_ends() -> None:
    for values in (range(1_000_001), itertools.count()):
        with pytest.raises(InputError, match=r"^a key takes at most 1000000 values$"):
            listed_points({"a.b": values})  # type: ignore[dict-item]
    assert len(grid_points({"a.b": range(1_000_000), "a.c": [1, 2]})) == 2_000_000


@pytest.mark.parametrize(
    "text",
    [
        "a.b=2..1..1", "a.b=1..2..-1", "a.b=1..inf..1", "a.b=1..2..inf", "a.b=1..2..-inf",
        "a.b=0..1..1e-9",
        "a.b=1e5000..1e5000..1",
    ],
)  # fmt: skip
def test_steps_that_do_not_lead_there_are_told(text: str) -> None:
    with pytest.raises(InputError) as refused:
        parse_vary([text])
    assert str(refused.value) == f"{text}: expected 1 to 1000000 steps from the first value to the last"


def test_too_many_combinations_are_told_before_they_are_made() -> None:
    with pytest.raises(InputError, match=r"^these are more than 10000000 points$"):
        parse_vary(["a.b=0..1..0.001", "a.c=0..1..0.001", "a.d=0..1..0.001"])


def test_a_value_of_a_grid_stands_once() -> None:
    with pytest.raises(InputError, match=r"^a\.b: a value stands twice$"):
        grid_points({"a.b": [1, 2, 1.0]})


def test_a_table_of_points_without_an_encoding_is_told(tmp_path: Path) -> None:
    (tmp_path / "odd.csv").write_bytes(b"\xff\xfe,b\n1,2\n")
    with pytest.raises(InputError, match=r"odd\.csv is no CSV or Parquet file of points"):
        read_points(tmp_path / "odd.csv")
