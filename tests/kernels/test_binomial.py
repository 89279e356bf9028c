"""The binomial distribution beside SciPy's."""

import numpy as np
import pytest
from scipy.special import betaincinv
from scipy.stats import binom

from benchdragon.kernels.binomial import chance_bounds, ranks, tails


@pytest.mark.parametrize("count", [1, 3, 100, pytest.param(100_000, marks=pytest.mark.compiled)])
def test_tails_are_those_of_the_binomial_distribution(count: int) -> None:
    hits = [-1, *range(0, count, max(1, count // 100)), count]
    for risk in (1e-4, 0.05, 0.5, 0.99):
        found = np.array([tails(each, count, risk) for each in hits])
        wanted = np.column_stack([binom.cdf(hits, count, risk), binom.sf(hits, count, risk)])
        np.testing.assert_allclose(found, wanted, rtol=1e-10, atol=1e-280)
    for risk, few in ((0.0, (1.0, 0.0)), (1.0, (0.0, 1.0))):
        assert tails(0, count, risk) == few
        assert tails(count, count, risk) == (1.0, 0.0)


@pytest.mark.parametrize(("hits", "count"), [(0, 1), (1, 1), (0, 60), (1, 101), (37, 101), (101, 101)])
def test_bounds_of_a_chance_are_those_of_clopper_and_pearson(hits: int, count: int) -> None:
    low, high = chance_bounds(hits, count, 0.95)
    assert low == pytest.approx(betaincinv(hits, count - hits + 1, 0.025) if hits else 0.0, rel=1e-12)
    most = betaincinv(hits + 1, count - hits, 0.975) if hits < count else 1.0
    assert high == pytest.approx(most, rel=1e-12)


@pytest.mark.parametrize("count", [1, 20, 59, 100, 451])
@pytest.mark.parametrize("risk", [0.5, 0.1, 0.05, 0.02, 1e-9, 1.0 - 1e-9])
def test_ranks_are_the_last_that_are_sure_enough(count: int, risk: float) -> None:
    above, below = ranks(count, risk, 0.95)
    numbers = np.arange(count)
    sure = np.flatnonzero(binom.cdf(numbers, count, risk) <= 0.05)
    assert above == (sure[-1] if sure.size else -1)
    unsure = np.flatnonzero(binom.sf(numbers, count, risk) > 0.05)
    assert below == (unsure[-1] + 1 if unsure.size else 0)
