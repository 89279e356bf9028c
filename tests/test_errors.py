"""Checks at the door, and how failures become sentences."""

import math
import string

import pytest

from benchdragon.errors import (
    ADVICE,
    BenchDragonError,
    InputError,
    WalkError,
    as_number,
    finite,
    not_negative,
    positive,
)
from benchdragon.kernels.status import Status


@pytest.mark.parametrize("value", [0.5, 3, math.pi])
def test_a_sound_number_comes_back_as_a_float(value: float) -> None:
    for check in (finite, positive, not_negative):
        assert check("size", value, "m") == value
        assert isinstance(check("size", value, "m"), float)
    assert as_number("size", value) == value


@pytest.mark.parametrize(
    ("value", "came"), [(math.nan, "not nan m"), (math.inf, "not inf m"), (-math.inf, "not -inf m")]
)
def test_no_check_lets_an_infinite_number_pass(value: float, came: str) -> None:
    for check in (finite, positive, not_negative):
        with pytest.raises(InputError, match=f"^pitch must be finite, {came}$"):
            check("pitch", value, "m")


@pytest.mark.parametrize("value", ["far", None, [1.0, 2.0], {}, 1j])
def test_what_is_no_number_is_quoted(value: object) -> None:
    for check in (finite, positive, not_negative):
        with pytest.raises(InputError) as caught:
            check("pitch", value, "m")  # type: ignore[arg-type]
        assert str(caught.value) == f"pitch must be a number, not {value!r}"


@pytest.mark.parametrize("value", ["5", "1e3", " 2 "])
def test_a_number_in_quotes_is_no_number(value: str) -> None:
    # float() would take it, and the text would then live on in the record.
    with pytest.raises(InputError, match="must be a number, not '"):
        as_number("pitch", value)


def test_positive_wants_more_than_nothing() -> None:
    assert positive("pitch", 5e-324) > 0.0
    with pytest.raises(InputError, match=r"^pitch must be positive, not 0.0 m$"):
        positive("pitch", 0.0, "m")
    with pytest.raises(InputError, match=r"^pitch must be positive, not -0.4 m$"):
        positive("pitch", -0.4, "m")


def test_not_negative_takes_nothing_and_no_less() -> None:
    assert not_negative("inset", 0.0) == 0.0
    with pytest.raises(InputError, match=r"^inset must not be negative, but is -0.1 m$"):
        not_negative("inset", -0.1, "m")


def test_a_quantity_without_a_unit_ends_without_a_space() -> None:
    with pytest.raises(InputError, match=r"^ratio must be positive, not -1$"):
        positive("ratio", -1)


def test_a_wrong_input_is_a_value_error_and_ours() -> None:
    assert issubclass(InputError, ValueError)
    assert issubclass(InputError, BenchDragonError)
    assert issubclass(WalkError, BenchDragonError)
    assert not issubclass(WalkError, ValueError)
    assert (BenchDragonError.exit_code, InputError.exit_code, WalkError.exit_code) == (2, 2, 4)


def test_every_failure_has_its_advice_and_only_they() -> None:
    assert set(ADVICE) == set(Status) - {Status.OK}


@pytest.mark.parametrize("status", ADVICE)
def test_a_walk_error_carries_and_says_what_befell(status: Status) -> None:
    error = WalkError(status, 17, 12.3456789, 30.5, "1.65 m").at(-4.5)
    assert (error.status, error.bench, error.s, error.t) == (status, 17, 12.3456789, -4.5)
    text = str(error)
    assert text.startswith("at t = -4.5 s ")
    assert "s = 12.3457 m" in text
    fields = {name for _, name, _, _ in string.Formatter().parse(ADVICE[status]) if name}
    assert {"when", "s"} <= fields <= {"when", "s", "bench", "size"}
    assert ("bench 17" in text) == ("bench" in fields)
    assert ("1.65 m" in text) == ("size" in fields)
    assert "; " in text  # what befell; what to do


def test_a_failure_without_a_walk_tells_where_the_head_is_and_no_time() -> None:
    error = WalkError(Status.FOLDED, 17, 12.3456789, 30.5, "1.65 m")
    assert error.t is None
    assert str(error).startswith("with the head at s = 30.5 m ")
    assert " t = " not in str(error)
    assert error.at(math.inf).t is None  # a time that never comes
