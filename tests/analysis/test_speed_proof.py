"""Greatest speeds, proved: bounds that hold, a handle that is as fast, and claims that are not so."""

import json
import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

pytest.importorskip("flint")

from benchdragon.analysis.certificate import Certificate, certificate_of, verify
from benchdragon.analysis.speed_proof import (
    SpeedClaim,
    SpeedQuestion,
    handle_speeds,
    head_speeds,
    prove_speed,
)
from benchdragon.errors import BenchDragonError, InputError, UnsureError
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.head_speed import prove_head_speed
from tests.proofs.certificates import bend

# See tests/truth/contest.json: the greatest head speed, which eight benches decide.
TRUTH = Fraction("1.24626635815748673")


@pytest.fixture(scope="module")
def plan() -> Plan:
    return read_plan("turn", ["dragon.benches=8", "walk.start=10", "walk.end=16"])


@pytest.fixture(scope="module")
def claim(plan: Plan) -> SpeedClaim:
    found: list[SpeedClaim] = []
    answer = prove_head_speed(plan, claims=found)
    assert answer.status == "proved"
    assert answer.value == answer.lower
    assert Fraction(repr(answer.lower)) < TRUTH < Fraction(repr(answer.upper))
    assert answer.upper - answer.lower < 2e-12
    assert answer.assumptions[0].startswith("what decides: speed of a handle, at most 2 m/s")
    return found[0]


def test_the_contests_greatest_head_speed_is_proved_to_twelve_digits(claim: SpeedClaim) -> None:
    lower, upper = head_speeds(2.0, claim)
    assert Fraction(repr(lower)) < TRUTH < Fraction(repr(upper))
    assert upper < lower * (1.0 + 2e-12)


def test_a_head_speed_is_rounded_to_the_safe_side() -> None:
    for limit in range(1, 7):  # of which some sevenths round up, and some down
        claim = SpeedClaim((0.0,), 0.0, 0.0, 7.0, 0.0, 0, 7.0)
        lower, upper = head_speeds(float(limit), claim)
        assert Fraction(repr(lower)) < Fraction(limit, 7) < Fraction(repr(upper))
        assert upper - lower < 1e-15


def test_handles_speeds_are_rounded_outwards() -> None:
    for seventh in range(1, 60):  # products of decimals of which some round up, and some down
        head, ratio = seventh / 7.0, 1.0 + seventh / 70.0
        claim = SpeedClaim((0.0,), 0.0, 0.0, ratio, 0.0, 0, ratio)
        lower, upper = handle_speeds(head, claim)
        exact = Fraction(repr(head)) * Fraction(repr(ratio))
        assert Fraction(repr(lower)) <= exact <= Fraction(repr(upper))
        assert upper - lower <= 4.0 * math.ulp(upper)


FAULTS: dict[str, tuple[dict[str, Any], str]] = {
    "a smaller bound": ({"most": 1.60479337}, "does not hold"),
    "a faster handle": ({"least": 1.6047933790}, "no handle could be shown"),
    "another handle": ({"handle": 1}, "no handle could be shown"),
    "somewhere else": ({"s": 114.4}, "no handle could be shown"),
    "before the start": ({"s": 109.9, "least": 1.0}, "no handle could be shown"),
    "a start before the cells": ({"start": 9.9}, "begin after"),
    "an end behind them": ({"clear": 16.1}, "end before"),
    "an end before the start": ({"clear": 9.9}, "end before"),
}


@pytest.mark.parametrize("name", list(FAULTS))
def test_a_claim_that_is_not_so_is_found_out(plan: Plan, claim: SpeedClaim, name: str) -> None:
    wrong, text = FAULTS[name]
    with pytest.raises(UnsureError, match=text):
        SpeedQuestion(plan.build(), plan).verify(replace(claim, **wrong))


def test_cells_may_leave_nothing_out(plan: Plan, claim: SpeedClaim) -> None:
    inner = min(range(len(claim.cells)), key=lambda n: abs(claim.cells[n] - 114.4))
    for cells in (claim.cells[:inner] + claim.cells[-1:], claim.cells[:1] + claim.cells[-1:]):
        with pytest.raises(UnsureError, match="does not hold"):
            SpeedQuestion(plan.build(), plan).verify(replace(claim, cells=cells))


def test_a_certificate_of_speeds_says_what_is_proved(plan: Plan, claim: SpeedClaim) -> None:
    what = json.loads(certificate_of(plan, [], [claim]).model_dump_json())
    told, left = verify(Certificate.model_validate_json(json.dumps(what)))
    assert told.startswith(
        f"proved: from t = 10.0 s to t = 16.0 s no handle is ever more than {claim.most!r} times as "
        f"fast as the head; handle {claim.handle} is at least {claim.least!r} times as fast; so on "
        "this way no handle exceeds 2.0 m/s with the head at 1.24626635815"
    )
    assert left == "not in the certificate: benches"
    what["speeds"][0]["handle"] = 9
    with pytest.raises(InputError, match="no handle of this dragon"):
        verify(Certificate.model_validate_json(json.dumps(what)))
    what["speeds"][0]["handle"] = 0
    with pytest.raises(BenchDragonError, match=r"^speed: no handle could be shown"):
        verify(Certificate.model_validate_json(json.dumps(what)))


def test_where_no_handle_is_faster_the_head_is_the_fastest() -> None:
    plan = read_plan("spiral-in", ["dragon.benches=5", "walk.start=100", "walk.end=104"])
    walk = plan.build()
    claim = prove_speed(walk, 100.0, 104.0, 101.0, plan=plan)
    assert claim.least == claim.most == 1.0
    assert claim.handle == 0


def test_a_speed_that_lasts_is_bounded_as_narrowly_as_can_be_paid() -> None:
    plan = bend()
    claim = prove_speed(plan.build(), 10.0, 12.0, 11.0, plan=plan)
    assert claim.least <= 1.0 < claim.most < 1.001


@pytest.mark.parametrize("settings", [[], ["limits.speed=2", "limits.acceleration=3"]])
def test_a_head_speed_that_speeds_alone_do_not_decide_is_not_proved(settings: list[str]) -> None:
    with pytest.raises(InputError, match=r"limits speeds alone|no limit that a head speed"):
        prove_head_speed(read_plan("spiral-in", settings))
