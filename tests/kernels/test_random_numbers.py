"""Random numbers: Philox as its authors publish it, normal numbers, and no state."""

import math

import numpy as np
import pytest
from scipy.stats import kstest

from benchdragon.kernels.random_numbers import (
    DEVIATIONS,
    draw_benches,
    draw_normals,
    normal_at,
    philox,
    uniform_of,
)

# Of Random123 1.14, tests/kat_vectors, "philox4x32 10": counter and key, and what comes out.
KNOWN = [
    ("00000000 00000000 00000000 00000000 00000000 00000000", "6627e8d5 e169c58d bc57ac4c 9b00dbd8"),
    ("ffffffff ffffffff ffffffff ffffffff ffffffff ffffffff", "408f276d 41c83b0e a20bc7c6 6d5451fd"),
    ("243f6a88 85a308d3 13198a2e 03707344 a4093822 299f31d0", "d16cfe09 94fdcceb 5001e420 24126ea1"),
]
NORMALS = np.array([[normal_at(s, d, p, n) for n in range(500)] for s in (1, 2) for d in (0, 7)
                    for p in range(6)])  # fmt: skip


def words(text: str) -> list[int]:
    return [int(word, 16) for word in text.split()]


@pytest.mark.parametrize(("given", "drawn"), KNOWN)
def test_philox_gives_the_words_that_are_published(given: str, drawn: str) -> None:
    assert list(philox(*words(given))) == words(drawn)


def test_uniform_numbers_lie_over_0_and_reach_1() -> None:
    assert uniform_of(0, 0) == 2.0**-53
    assert uniform_of(0xFFFFFFFF, 0xFFFFFFFF) == 1.0
    assert uniform_of(1 << 31, 0) - 0.5 == 2.0**-53


def test_normal_numbers_are_normal_and_none_tells_of_another() -> None:
    assert kstest(NORMALS.ravel(), "norm").pvalue > 1e-3
    count = NORMALS[0].size
    assert np.abs(np.corrcoef(NORMALS) - np.eye(len(NORMALS))).max() < 5.0 / math.sqrt(count)
    assert abs(np.corrcoef(NORMALS[:, :-1].ravel(), NORMALS[:, 1:].ravel())[0, 1]) < 0.04
    assert np.unique(NORMALS).size == NORMALS.size


@pytest.mark.parametrize("seed", [0, 1, 2**31, 2**53 - 1])
def test_numbers_depend_on_their_place_alone(seed: int) -> None:
    """Whoever asks, in blocks of any size: bit by bit where the arithmetic is the same, else 1e-14."""
    long, short = np.empty(40), np.empty(7)
    draw_normals(seed, 3, 2, long)
    draw_normals(seed, 3, 2, short)
    np.testing.assert_array_equal(long[:7], short)
    alone = [normal_at(seed, 3, 2, n) for n in reversed(range(40))]
    np.testing.assert_allclose(long[::-1], alone, rtol=0.0, atol=1e-14)
    for other in ((seed ^ 2**40, 3, 2), (seed, 4, 2), (seed, 3, 1)):
        draw_normals(*other, short)
        assert not set(short) & set(long)


def test_benches_are_drawn_from_numbers_of_their_own() -> None:
    plain = np.array([[2.2] * 9, [0.3] * 9, [0.275] * 9, [0.275] * 9])
    sizes, aside = np.empty((4, 9)), np.empty(10)
    draw_benches(1, 0, np.zeros(DEVIATIONS), plain, sizes, aside)
    np.testing.assert_allclose(sizes, plain, atol=1e-15)
    assert not aside.any()
    draw_benches(1, 0, np.array([0.02, 0.5, 0.01, 0.1, 0.03, 0.004]), plain, sizes, aside)
    drawn = np.array([[normal_at(1, 0, part, n) for n in range(10)] for part in range(DEVIATIONS)])
    np.testing.assert_allclose(aside, 0.02 * drawn[0], atol=1e-14)
    np.testing.assert_allclose(sizes[0], 2.2 + 0.03 * drawn[4, :9], atol=1e-14)
    np.testing.assert_allclose(sizes[1], 0.3 + 0.004 * drawn[5, :9], atol=1e-14)
    link, height = sizes[0] - 0.55, 0.1 * drawn[3, :9]
    seen = np.sqrt(link**2 - height**2) + 0.01 * drawn[2, :9]
    np.testing.assert_allclose(sizes[0] - sizes[2] - sizes[3], seen, atol=1e-14)
