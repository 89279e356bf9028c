"""In Node the kernels answer random dances as they do in Python."""

import pytest

from benchdragon.kernels.time_of_impact import Ending
from tests.engine.recording import node
from tests.laws.wasm_dances import Compared, Found, compare


@pytest.mark.skipif(node() is None, reason="no Node here to run engine.wasm in")
def test_contacts_of_random_dances_lie_in_overlapping_brackets() -> None:
    found = list(compare(range(80)))
    assert [each for each in found if each.fault()] == []
    assert {each.one.ending for each in found} == {Ending.CLEAR, Ending.FOUND, Ending.FALLEN}


@pytest.mark.parametrize(
    ("one", "other", "agree"),
    [
        (Found(Ending.FOUND, 1.0, 2.0, 3), Found(Ending.FOUND, 2.0, 3.0, 3), True),
        (Found(Ending.FOUND, 1.0, 2.0, 3), Found(Ending.FOUND, 2.1, 3.0, 3), False),
        (Found(Ending.FOUND, 1.0, 2.0, 3), Found(Ending.GRAZE, 1.5, 1.6, 3), True),
        (Found(Ending.FOUND, 1.0, 2.0, 3), Found(Ending.GRAZE, 2.5, 2.6, 3), False),
        (Found(Ending.FOUND, 1.0, 2.0, 3), Found(Ending.FALLEN, 1.0, 2.0, 3), False),
        (Found(Ending.FOUND, 1.0, 2.0, 3), Found(Ending.CLEAR, 1.0, 2.0, 3), False),
        (Found(Ending.CLEAR, 0.0, 0.0, 0), Found(Ending.GRAZE, 1.0, 2.0, 3), True),
        (Found(Ending.CLEAR, 0.0, 0.0, 0), Found(Ending.CLEAR, 1.0, 1.0, 0), True),
    ],
)
def test_what_counts_as_a_disagreement(one: Found, other: Found, agree: bool) -> None:
    for pair in ((one, other), (other, one)):
        assert (Compared(0, *pair).fault() == "") == agree
