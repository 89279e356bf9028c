"""Sampling finds no touch of an obstacle before the first, none that is invented, and none nearer.

More of them: `python -m tests.laws.random_squares 1500`.
"""

import pytest

from tests.laws.random_squares import tried

# How the first squares end, 25 at a time: clear, found on the way, and touching at the start.
ENDINGS = {0: (16, 9, 0), 25: (15, 7, 3), 50: (9, 11, 5), 75: (12, 11, 2)}


@pytest.mark.parametrize("first", ENDINGS)
def test_dances_past_obstacles_end_as_sampling_has_it(first: int) -> None:
    endings, faults = tried(range(first, first + 25))
    assert not faults
    counts = tuple(endings[name] for name in ("clear", "found", "touching at the start"))
    assert counts == ENDINGS[first]
