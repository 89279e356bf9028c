"""The random dances that report and manual quote: enough of them, and still the same."""

import numpy as np
import pytest

from benchdragon.kernels.random_dance_look import PITCH_TOLERANCE
from benchdragon.paper.random_dances import DRAWS, OTHER_SEED, RISK, SEED, kept_run, plan, walked_again
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES


def test_a_thousand_dances_of_each_case_are_kept() -> None:
    run = kept_run()
    assert list(run.needed) == list(run.vouched) == list(CASES)
    assert DRAWS >= 1000
    assert {len(needed) for needed in run.needed.values()} == {DRAWS}
    assert run.exact == pytest.approx(limit(plan(), "pitch").value, abs=1e-12)


def test_dances_walked_again_need_what_is_kept() -> None:
    assert walked_again(kept_run(), 2) < 2.0 * PITCH_TOLERANCE


def test_a_stricter_risk_wants_a_larger_pitch() -> None:
    run = kept_run()
    for name in CASES:
        one = run.tolerance(name)
        tenth, twentieth = ((one.pitch_from(q), one.pitch_for(q)) for q in (0.1, RISK))
        assert tenth[0] < tenth[1] < twentieth[1]
        assert tenth[0] < twentieth[0] < twentieth[1]
        assert twentieth[0] < np.quantile(one.needed, 1.0 - RISK) < twentieth[1]


def test_other_dances_vouch_for_the_pitch() -> None:
    """They had no part in choosing it, so that it owes nothing to luck."""
    assert SEED != OTHER_SEED
    run = kept_run()
    for name, vouched in run.vouched.items():
        assert vouched.draws == DRAWS
        assert vouched.pitch == run.tolerance(name).pitch_for(RISK)
        share, low, high = vouched.chance
        assert low <= share <= high
        assert low <= RISK
