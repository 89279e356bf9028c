"""Certificates whose contact is none of the dance, or whose time was never shown."""

import json
from typing import Any

import pytest

from benchdragon.analysis.certificate import Certificate, verify
from benchdragon.errors import UnsureError
from benchdragon.plans.schema import Plan
from benchdragon.version import __version__
from tests.proofs.certificates import TOO_MUCH, bend

# The head's route position where bench 3 is nearer than TOO_MUCH to bench 1, m.
NEAR = 15.5


def _certificate(plan: Plan, **claim: Any) -> Certificate:
    claim = {"about": "", "benches": [0, 2], **claim}
    data = {"version": __version__, "plan": plan.data(), "plan_sha256": plan.sha256, "claims": [claim]}
    return Certificate.model_validate_json(json.dumps(data))


def test_a_stop_at_a_contact_is_no_clear_time() -> None:
    plan = bend(margin=TOO_MUCH).with_table(
        "walk", profile=[[0, 0], [10, 0], [11, 1]], position=NEAR, start=0, end=13
    )
    claim = {"cells": [NEAR], "start": 0.0, "clear": 10.0, "contact": 10.0, "s": NEAR}
    with pytest.raises(UnsureError):
        verify(_certificate(plan, **claim))


def test_a_contact_before_the_start_is_none() -> None:
    plan = bend(margin=TOO_MUCH).with_table("walk", speed=1, position=26, start=0, end=4)
    cells = [26.0 + 0.01 * n for n in range(91)]
    claim = {"cells": cells, "start": 0.0, "clear": 0.895}
    assert verify(_certificate(plan, **claim, benches=[]))
    with pytest.raises(UnsureError):
        verify(_certificate(plan, **claim, contact=0.9, s=NEAR))


def test_a_contact_before_the_dance_is_none_of_it() -> None:
    plan = bend(margin=TOO_MUCH).with_table("walk", speed=1, position=26, start=0, end=4)
    claim = {"cells": [NEAR], "start": -10.5, "clear": -10.5, "contact": -10.5, "s": NEAR}
    with pytest.raises(UnsureError, match="other times than those of the walk"):
        verify(_certificate(plan, **claim))


def test_a_margin_is_not_rounded() -> None:
    plan = bend(margin=0.29999996)
    told = verify(_certificate(plan, cells=[10.0, 10.02], start=10.0, clear=10.01, benches=[]))
    assert "0.29999996 m" in told[0]
