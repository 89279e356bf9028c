"""Proofs of contact: what the search found is shown again, or refused."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("flint")

from benchdragon import (
    Answer,
    Dragon,
    Line,
    LogSpiral,
    Route,
    SpeedProfile,
    UnsureError,
    Walk,
)
from benchdragon.analysis import check as check_module
from benchdragon.analysis import proof
from benchdragon.analysis.check import check
from benchdragon.analysis.contact import Window, contact_windows, first_contact
from benchdragon.analysis.proof import Claim, Question, prove_contact, prove_nearer
from benchdragon.plans.schema import read_plan
from benchdragon.solve import size
from benchdragon.solve.size import limit
from tests.proofs.dances import COIL, SMALLEST_PITCH, coil, eased, hairpin

FIRST_CONTACT = 412.4738376821147


@pytest.fixture(scope="module")
def walk() -> Walk:
    return read_plan("spiral-in").build()


@pytest.fixture(scope="module")
def claim(walk: Walk) -> Claim:
    claims: list[Claim] = []
    prove_contact(walk, 412.4, 413.0, claims=claims)
    return claims[0]


def test_the_contests_first_contact_is_proved_to_a_picosecond(walk: Walk) -> None:
    found = prove_contact(walk, 411.5, 430.0)
    assert found is not None
    assert found.status == "proved"
    assert found.lower <= FIRST_CONTACT <= found.upper
    assert found.upper - found.lower < 1e-12
    assert found.witness is not None
    assert found.witness.benches == (1, 9)


def test_a_clear_walk_is_proved_clear(walk: Walk) -> None:
    assert prove_contact(walk, 405.0, 408.0) is None


def test_what_was_shown_can_be_shown_again(walk: Walk, claim: Claim) -> None:
    assert claim.cells[0] <= 412.4
    assert claim.clear < FIRST_CONTACT + 1e-12
    assert claim.contact is not None
    Question(walk, 0.0, None).verify(claim)


FAULTS: dict[str, tuple[dict[str, Any], str]] = {
    "cells that begin late": ({"cells": (412.41, 412.45)}, "begin after"),
    "cells that end early": ({"clear": 412.4739}, "end before"),
    "a cell beyond the contact": ({"cells": (412.4, 412.47, 412.4739)}, "does not hold"),
    "cells that go back": ({"cells": (412.4, 412.401, 412.4005, 412.4739)}, "does not go on"),
    "one cell for all": ({"cells": (412.4, 412.5)}, "does not hold"),
    "benches that do not meet": ({"benches": (1, 9)}, "contact could not"),
    "before they meet": ({"s": 412.47383, "contact": 412.48}, "contact could not"),
    "a time before they meet": ({"contact": 412.4738}, "contact could not"),
}


@pytest.mark.parametrize("name", list(FAULTS))
def test_a_claim_that_is_not_so_is_found_out(walk: Walk, claim: Claim, name: str) -> None:
    wrong, text = FAULTS[name]
    with pytest.raises(UnsureError, match=text):
        Question(walk, 0.0, None).verify(replace(claim, **wrong))


def test_whatever_the_search_overlooks_is_no_proof(walk: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(proof, "contact_windows", lambda *_arguments, **_more: [])
    with pytest.raises(UnsureError, match=r"beyond 412\.47383768"):
        prove_contact(walk, 412.3, 413.0)


def test_a_contact_that_the_search_finds_too_late_is_no_proof(
    walk: Walk, monkeypatch: pytest.MonkeyPatch
) -> None:
    (window,) = contact_windows(walk, 412.0, 413.0, most=1)
    late = replace(window.opens, value=412.6, lower=412.6, upper=412.6)
    monkeypatch.setattr(proof, "contact_windows", lambda *_a, **_m: [Window(late, None)])
    with pytest.raises(UnsureError, match=r"beyond 412\.47383768"):
        prove_contact(walk, 412.3, 413.0)


def test_a_contact_of_others_is_no_proof(walk: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    (window,) = contact_windows(walk, 412.0, 413.0, most=1)
    assert window.opens.witness is not None
    witness = replace(window.opens.witness, benches=(2, 10))
    other = Window(replace(window.opens, witness=witness), None)
    monkeypatch.setattr(proof, "contact_windows", lambda *_a, **_m: [other])
    with pytest.raises(UnsureError, match=r"beyond 412\.47383768"):
        prove_contact(walk, 412.3, 413.0)


@pytest.fixture(scope="module")
def proved() -> Answer:
    return limit(COIL, "pitch", prove=True)


@pytest.mark.xdist_group("proved pitch")
def test_the_smallest_pitchs_bracket_is_proved(proved: Answer) -> None:
    assert proved.status == "proved"
    assert proved.lower < SMALLEST_PITCH < proved.upper
    assert proved.upper - proved.lower < 1e-9


@pytest.mark.xdist_group("proved pitch")
@pytest.mark.parametrize("end", ["prove_nearer", "prove_contact"])
def test_a_limit_is_proved_at_both_ends(
    monkeypatch: pytest.MonkeyPatch, proved: Answer, end: str
) -> None:
    monkeypatch.setattr(size, "MOST_WIDENINGS", 2)
    monkeypatch.setattr(
        size, end, {"prove_nearer": lambda *_a: None}.get(end, lambda *_a, **_m: proved)
    )
    with pytest.raises(UnsureError, match="could not be proved"):
        limit(COIL, "pitch", prove=True)


def test_an_overlap_is_proved_and_a_gap_is_not(walk: Walk) -> None:
    assert prove_nearer(walk, (400.0, 420.0), FIRST_CONTACT + 1e-12, (0, 8), 0.0)
    assert not prove_nearer(walk, (400.0, 420.0), FIRST_CONTACT - 1e-12, (0, 8), 0.0)
    early = prove_nearer(walk, (FIRST_CONTACT + 1e-9, 420.0), FIRST_CONTACT - 1.0, (0, 8), 0.0)
    assert early is not None
    assert early.start == FIRST_CONTACT + 1e-9
    assert not prove_nearer(walk, (400.0, FIRST_CONTACT - 1e-9), FIRST_CONTACT + 1e-9, (0, 8), 0.0)


def test_a_verdict_is_proved_only_if_its_contact_is() -> None:
    clear, touching = (check(coil(pitch, dragon__benches=22), prove=True) for pitch in (0.5, 0.44))
    assert clear.safe
    assert clear.proved
    assert not touching.safe
    assert touching.proved


def test_a_verdict_whose_contact_stays_open_is_not_proved(monkeypatch: pytest.MonkeyPatch) -> None:
    plan = coil(0.44, dragon__benches=22)
    open_still = first_contact(plan.build(), *plan.span(plan.build()))
    assert open_still is not None
    graze = replace(open_still, status="undecided")
    monkeypatch.setattr(check_module, "prove_contact", lambda *_a, **_m: graze)
    monkeypatch.setattr("benchdragon.analysis.contact.contact_windows", lambda *_a, **_m: [])
    assert not check(plan, prove=True).proved


def test_a_margin_is_kept(walk: Walk) -> None:
    plain, found = (of(walk, 411.5, 413.0, margin=2e-3) for of in (first_contact, prove_contact))
    assert plain is not None
    assert found is not None
    assert plain.lower <= found.lower <= found.upper <= plain.upper < 412.47


def test_a_proof_says_what_it_rests_on(walk: Walk) -> None:
    found = prove_contact(walk, 412.0, 413.0)
    assert found is not None
    exact, cells = found.assumptions
    assert exact.startswith("the stored numbers of route and benches are exact, and each part of")
    assert "cells of the head's way shown free of contact in balls of 128 bits" in cells


def test_a_proof_holds_at_any_speed(walk: Walk) -> None:
    profile = SpeedProfile((0.0, 4.0, 8.0), (0.5, 2.0, 1.0))
    slow = Walk(walk.dragon, walk.route, profile, 405.0)
    found, plain = prove_contact(slow, 0.0, 12.0), first_contact(slow, 0.0, 12.0)
    assert found is not None
    assert plain is not None
    assert found.lower <= plain.upper
    assert plain.lower <= found.upper
    assert slow.exact_head_position(found.lower) <= 412.4738376821147
    assert slow.exact_head_position(found.upper) >= 412.4738376821145


def test_times_are_exact_however_many_knots_a_profile_has() -> None:
    # Rounding of ten thousand cumulated stretches put the contact 1.2e-11 m too late.
    few = coil(0.44).build()
    knots = SpeedProfile(tuple(np.linspace(0.0, 400.0, 2001).tolist()), (0.61,) * 2001)
    many = Walk(few.dragon, few.route, knots, few.start)
    one = Walk(few.dragon, few.route, SpeedProfile.constant(0.61), few.start)
    late, found = (first_contact(walk, 0.0, 110.0) for walk in (many, one))
    assert late is not None
    assert found is not None
    near = late.value - 0.5
    shown, wanted = (prove_contact(walk, near, near + 1.0) for walk in (many, one))
    assert shown is not None
    assert wanted is not None
    assert shown.lower <= wanted.upper
    assert wanted.lower <= shown.upper
    assert max(shown.upper - shown.lower, wanted.upper - wanted.lower) < 1e-12


def test_a_contact_at_the_start_is_shown_and_not_believed() -> None:
    # Far from the origin, where doubles are 1e-9 m apart.
    dragon = Dragon.of_sizes(np.full(3, 1.2), 0.2, 0.1, 0.1)
    walk = Walk(dragon, Route((Line(50.0, (1e7, 1e7), 0.3),)), start=20.0)
    apart = 1.0 - 0.2 + 0.0  # of benches 1 and 3: a link less both insets
    for margin, shown in ((apart - 1e-9, False), (apart + 1e-9, True)):
        found = prove_contact(walk, 0.0, 1.0, margin=margin)
        assert (found is not None) is shown
        assert found is None or found.status == "proved"


@pytest.mark.parametrize("walk", [eased(), hairpin()])
def test_bends_of_every_kind_are_proved(walk: Walk) -> None:
    assert prove_contact(walk, 0.0, 12.0) is None
    wide = Walk(Dragon.of_sizes(np.full(6, 1.4), 1.5, 0.1, 0.1), walk.route, start=walk.start)
    plain, found = (of(wide, 0.0, 12.0) for of in (first_contact, prove_contact))
    assert (plain is None) == (found is None)
    if plain is not None and found is not None:
        assert found.status == "proved"
        assert found.lower <= plain.upper
        assert plain.lower <= found.upper


def test_a_logarithmic_spiral_is_proved() -> None:
    route = Route.joined([Line(12.0), LogSpiral(6.0, 0.1, 0.6)])
    assert prove_contact(Walk(Dragon.uniform(5, 1.5), route, start=9.0), 0.0, 8.0) is None
