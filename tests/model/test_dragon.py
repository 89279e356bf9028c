"""Benches and dragons: sizes only."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from benchdragon import Bench, Dragon, InputError
from benchdragon.kernels.box import LONGEST_BENCH, SHORTEST_LINK
from benchdragon.model.dragon import MOST_BENCHES


def test_the_link_is_what_the_insets_leave_of_the_length() -> None:
    assert Bench(3.41).link == pytest.approx(2.86, abs=1e-15)
    assert Bench(2.2, 0.3, 0.1, 0.4).link == pytest.approx(1.7, abs=1e-15)


def test_the_contest_has_223_benches_with_the_longest_in_front() -> None:
    dragon = Dragon.uniform()
    assert len(dragon) == 223
    np.testing.assert_allclose(dragon.links, [2.86] + [1.65] * 222, rtol=1e-15)
    assert (dragon.width == 0.3).all()
    assert (dragon.front_inset == 0.275).all()
    assert (dragon.rear_inset == 0.275).all()
    assert repr(dragon) == "<Dragon of 223 benches, 369.16 m from handle to handle>"


def test_head_body_and_tail_may_differ() -> None:
    dragon = Dragon.uniform(4, 3.0, 2.0, 1.0, 0.4, 0.1, 0.2)
    assert dragon.length.tolist() == [3.0, 2.0, 2.0, 1.0]
    assert dragon.width.tolist() == [0.4] * 4
    assert dragon.front_inset.tolist() == [0.1] * 4
    assert dragon.rear_inset.tolist() == [0.2] * 4


def test_a_single_bench_is_a_head() -> None:
    assert Dragon.uniform(1, head_length=3.0, tail_length=1.0).length.tolist() == [3.0]


def test_the_number_of_benches_may_be_any_integer() -> None:
    count: Any = np.int64(5)
    assert len(Dragon.uniform(count)) == 5


def test_the_same_sizes_make_the_same_dragon_by_either_road() -> None:
    benches = [Bench(3.0, 0.3, 0.2, 0.1), Bench(2.0, 0.5), Bench(1.0, 0.2, 0.0, 0.0)]
    one = Dragon(benches)
    other = Dragon.of_sizes([3.0, 2.0, 1.0], [0.3, 0.5, 0.2], [0.2, 0.275, 0.0], [0.1, 0.275, 0.0])
    for name in ("length", "width", "front_inset", "rear_inset", "links"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    np.testing.assert_array_equal(one.links, [bench.link for bench in benches])


def test_one_size_serves_all_benches_and_one_length_makes_one_bench() -> None:
    assert Dragon.of_sizes([3.0, 2.0, 1.0], width=0.5).width.tolist() == [0.5] * 3
    assert len(Dragon.of_sizes(2.2)) == 1
    assert Dragon.of_sizes([2.2], [0.1, 0.2]).length.tolist() == [2.2, 2.2]


def test_sizes_are_read_only_and_no_window_on_what_was_given() -> None:
    given = np.array([3.0, 2.0])
    dragon = Dragon.of_sizes(given)
    for name in ("length", "width", "front_inset", "rear_inset", "links"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(dragon, name)[0] = 1.0
    given[0] = 9.0
    assert dragon.length.tolist() == [3.0, 2.0]


WRONG: list[tuple[Callable[[], object], str]] = [
    (lambda: Dragon([]), r"^a dragon has 1 to 1000000 benches, not 0$"),
    (lambda: Dragon.of_sizes([]), r"^a dragon has 1 to 1000000 benches, not 0$"),
    (lambda: Dragon.uniform(0), r"not 0$"),
    (lambda: Dragon.uniform(-3), r"not -3$"),
    (lambda: Dragon.uniform(MOST_BENCHES + 1), r"not 1000001$"),
    (lambda: Dragon.of_sizes(np.full(MOST_BENCHES + 1, 2.2)), r"not 1000001$"),
    (lambda: Dragon([Bench(2.0), Bench(math.nan)]), r"^bench 2: length must be finite, not nan m$"),
    (lambda: Dragon([Bench(math.inf)]), r"^bench 1: length must be finite, not inf m$"),
    (lambda: Dragon([Bench(0.0)]), r"^bench 1: length must be positive, not 0.0 m$"),
    (lambda: Dragon([Bench(-2.0)]), r"^bench 1: length must be positive, not -2.0 m$"),
    (lambda: Dragon([Bench(2.0, 0.0)]), r"^bench 1: width must be positive, not 0.0 m$"),
    (lambda: Dragon([Bench(2.0, math.nan)]), r"^bench 1: width must be finite, not nan m$"),
    (lambda: Dragon([Bench(2.0, 0.3, -0.1)]), r"^bench 1: front_inset must not be negative"),
    (lambda: Dragon([Bench(2.0, 0.3, 0.1, -0.1)]), r"rear_inset must not be negative, but is -0.1 m$"),
    (lambda: Dragon([Bench(2.0, 0.3, 0.1, math.inf)]), r"rear_inset must be finite, not inf m$"),
    (lambda: Dragon([Bench(2e4)]), r"^bench 1: length must be at most 10000 m, not 20000 m$"),
    (lambda: Dragon([Bench(2.0, 2e4)]), r"^bench 1: width must be at most 10000 m, not 20000 m$"),
    (
        lambda: Dragon([Bench(2.0)] * 6 + [Bench(0.5)] + [Bench(-1.0)]),
        r"^bench 7: its insets \(0.275 m and 0.275 m\) leave no link in a length of 0.5 m$",
    ),
    (lambda: Dragon([Bench(1.0, 0.3, 0.5, 0.5)]), r"^bench 1: its insets \(0.5 m and 0.5 m\)"),
    (lambda: Dragon.uniform(head_length=0.5), r"^bench 1: its insets"),
    (lambda: Dragon.uniform(9, tail_length=0.5), r"^bench 9: its insets"),
    (lambda: Dragon.uniform(9, body_length=-1.0), r"^bench 2: length must be positive, not -1.0 m$"),
    (lambda: Dragon.uniform(9, width=0.0), r"^bench 1: width must be positive, not 0.0 m$"),
    (
        lambda: Dragon.uniform(9, head_length="long"),  # type: ignore[arg-type]
        r"^head_length must be a number, not 'long'$",
    ),
]


@pytest.mark.parametrize(("make", "wanted"), WRONG)
def test_a_dragon_that_cannot_be_is_refused(make: Callable[[], object], wanted: str) -> None:
    with pytest.raises(InputError, match=wanted):
        make()


def test_the_largest_and_the_smallest_sizes_are_allowed() -> None:
    dragon = Dragon.of_sizes([LONGEST_BENCH, 2.0 * SHORTEST_LINK], 0.1, 0.0, [0.0, SHORTEST_LINK])
    assert dragon.links.tolist() == [LONGEST_BENCH, SHORTEST_LINK]
    assert len(Dragon.of_sizes(np.full(MOST_BENCHES, 2.2))) == MOST_BENCHES


LONG: Any = "long"
HALF: Any = 2.5
RAGGED: Any = [[2.2], [2.2, 2.2]]


@pytest.mark.parametrize(
    "make",
    [
        lambda: Dragon([Bench(LONG)]),
        lambda: Dragon([Bench(2.2, width=LONG)]),
        lambda: Dragon.of_sizes(LONG),
        lambda: Dragon.of_sizes([2.2, 2.2], width=[LONG, 0.3]),
        lambda: Dragon.uniform(9, width=LONG),
        lambda: Dragon.uniform(LONG),
        lambda: Dragon.uniform(HALF),
    ],
)
def test_text_and_fractions_of_benches_are_refused_as_input(make: Callable[[], object]) -> None:
    with pytest.raises(InputError):
        make()


@pytest.mark.parametrize(
    "make",
    [
        lambda: Dragon.of_sizes([[2.2, 2.2], [2.2, 2.2]]),
        lambda: Dragon.of_sizes([2.2, 2.2], [[0.3], [0.3]]),
        lambda: Dragon.of_sizes([2.2, 2.2], [0.3, 0.3, 0.3]),
        lambda: Dragon.of_sizes(RAGGED),
    ],
)
def test_sizes_that_are_no_list_of_benches_are_refused_as_input(make: Callable[[], object]) -> None:
    with pytest.raises(InputError):
        make()
