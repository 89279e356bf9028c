"""Entries of a library and of a module: what they take, refuse and give back."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchdragon.hosts.signature import signature
from benchdragon.kernels.status import Status
from tests.hosts import modules
from tests.hosts.modules import Binder, Choice, Halves, follow, half, named, scale

TABLE = np.arange(6.0).reshape(3, 2)
WHICH = np.array([2, 0])


@pytest.fixture(scope="module", params=["native", "wasm"])
def bound(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Binder:
    """What binds an entry by hand, of each host."""
    if request.param == "wasm":
        return modules.host().bound
    folder: Path = tmp_path_factory.mktemp("library")
    return modules.library(folder)


def test_a_block_holds_arguments_in_order_and_then_results() -> None:
    shape = signature(scale)
    assert shape.symbol == "bd_modules_scale"
    assert [leaf.name for leaf in shape.leaves()] == [
        "table", "factor", "choice.limit", "choice.which", "out",
    ]  # fmt: skip
    assert shape.slots() == "qqqdqqqqqdqq"


@pytest.mark.parametrize("frozen", [False, True])
def test_an_entry_reads_arrays_numbers_and_groups_and_gives_back_a_tuple(
    bound: Binder, frozen: bool
) -> None:
    call, out, table = bound(scale), np.empty(2), TABLE.copy()
    table.flags.writeable = not frozen
    choice = Choice(2, WHICH)
    for factor in (0.5, -3.0):  # the second time with the same group
        found = call(table, factor, choice, out)
        assert out.tolist() == [4.0 * factor, 0.0]
        assert found == (4.0 * factor, Status.AFTER_ROUTE, True)
        assert [type(value) for value in found] == [float, Status, bool]
    assert call(table, 1.0, Choice(2, np.empty(0, dtype=np.int64)), out) == (0.0, 2, False)


def test_a_group_that_was_made_anew_is_read_anew(bound: Binder) -> None:
    call, out = bound(scale), np.empty(2)
    for first in (1, 2, 1):
        assert call(TABLE, 1.0, Choice(0, np.array([first, 0])), out)[0] == 2.0 * first


def test_an_entry_may_return_nothing_or_one_number(bound: Binder) -> None:
    out = np.full(3, 7.0)
    assert bound(follow)(out, np.zeros(3)) is None
    assert out.tolist() == [1.0, 1.0, 1.0]
    assert bound(half)(3.0) == 1.5
    assert bound(named)(3.0) == Halves(1.5)


@pytest.mark.parametrize(
    ("first", "second", "found"),
    [
        (slice(1, 6), slice(0, 5), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]),  # each reads what was just written
        (slice(0, 5), slice(1, 6), [1.0, 1.0, 1.0, 1.0, 1.0, 0.0]),
        (slice(0, 6), slice(0, 6), [1.0] * 6),
        (slice(0, 3), slice(3, 6), [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
        (slice(0, 0), slice(3, 6), [0.0] * 6),
    ],
)
def test_arrays_that_share_numbers_share_them_in_a_call(
    bound: Binder, first: slice, second: slice, found: list[float]
) -> None:
    numbers = np.zeros(6)
    bound(follow)(numbers[first], numbers[second])
    assert numbers.tolist() == found


@pytest.mark.parametrize(
    ("changed", "text"),
    [
        ({0: TABLE[0]}, "table must be a contiguous 2-dimensional array of float64, not a 1-"),
        ({0: TABLE.T}, "table .* float64, not contiguous"),
        ({0: TABLE.astype(np.float32)}, "table .* not a 2-dimensional array of float32"),
        ({0: TABLE.tolist()}, "table must be .*, not <class 'list'>"),
        ({2: Choice(1, WHICH.astype(np.int32))}, "choice.which must .* of int64, not .* int32"),
        ({2: (1, WHICH)}, "choice must be a .*Choice"),
        ({3: np.empty(4)[::2]}, "out .* not contiguous"),
    ],
)  # fmt: skip
def test_what_an_entry_cannot_read_is_refused(
    bound: Binder, changed: dict[int, Any], text: str
) -> None:
    call: Any = bound(scale)
    arguments = {0: TABLE, 1: 1.0, 2: Choice(1, WHICH), 3: np.empty(2), **changed}
    with pytest.raises(TypeError, match=text):
        call(*arguments.values())


def test_too_few_arguments_and_words_for_numbers_are_refused(bound: Binder) -> None:
    call: Any = bound(half)
    with pytest.raises(TypeError, match="takes 1 arguments, not 0"):
        call()
    with pytest.raises(Exception, match="float"):
        call("x")


def test_an_entry_that_fails_raises(bound: Binder) -> None:
    with pytest.raises(MemoryError, match="bd_modules_scale ended with code 3"):
        bound(scale)(TABLE, 1.0, Choice(-1, WHICH), np.empty(2))


def test_an_annotation_that_says_too_little_is_refused() -> None:
    def loose(values: Any) -> None: ...

    def worded(values: float) -> str:
        return str(values)

    for function, name in ((loose, "values"), (worded, "the result")):
        with pytest.raises(TypeError, match=f"{name} of an entry must be"):
            signature(function)
