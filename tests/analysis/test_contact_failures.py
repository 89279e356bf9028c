"""Walks that cannot go on: searches of contact tell it where and when it happens, not elsewhere."""

import math
from collections.abc import Callable
from dataclasses import replace

import pytest

from benchdragon import (
    Arc,
    Dragon,
    Line,
    Route,
    SpeedProfile,
    UnsureError,
    Walk,
    WalkError,
    contact_windows,
    first_contact,
    least_clearance,
)
from benchdragon.analysis.contact_search import ContactSearch
from benchdragon.analysis.speed import greatest_speed
from benchdragon.progress import silent

# A bench of two metres and a half folds in the second arc, 20.9 m along; and a route that just ends.
FOLDING = Walk(Dragon.uniform(8), Route.joined([Line(20.0), Arc(0.9, -3.0), Arc(0.9, 3.0), Line(20.0)]))
ENDING = Walk(Dragon.uniform(8), Route.joined([Line(21.0)]))
SPEEDS = {
    "slow": SpeedProfile.constant(0.5),
    "fast": SpeedProfile.constant(2.0),
    "stop and go": SpeedProfile((0.0, 4.0, 6.0, 9.0, 12.0), (2.0, 2.0, 0.0, 0.0, 3.0)),
}
SEARCHES = {
    "first contact": first_contact,
    "windows": contact_windows,
    "least clearance": least_clearance,
    "greatest speed": greatest_speed,
}


@pytest.mark.parametrize("search", SEARCHES.values(), ids=SEARCHES)
@pytest.mark.parametrize("profile", SPEEDS.values(), ids=SPEEDS)
@pytest.mark.parametrize("still", [FOLDING, ENDING], ids=["folding", "ending"])
def test_a_failure_is_told_when_it_happens_whatever_the_speed(
    still: Walk, profile: SpeedProfile, search: Callable[..., object]
) -> None:
    walk = replace(still, profile=profile)
    with pytest.raises(WalkError) as caught:
        search(walk, 0.0, profile.time(40.0))
    error = caught.value
    assert error.t == pytest.approx(profile.time(error.head), abs=1e-9)
    # The earliest such time, up to a few nanometres of the head's way.
    assert walk.placement([error.head - 3e-9]).status.tolist() == [0]
    past = walk.placement([error.head + 1e-6], throw=False)
    assert past.failure(0).status == error.status
    assert f"at t = {error.t:.6g} s " in str(error)


def test_a_walk_past_the_routes_end_fails_where_the_route_ends() -> None:
    with pytest.raises(WalkError) as caught:
        first_contact(ENDING, 0.0, 1000.0)
    assert (caught.value.t, caught.value.s, caught.value.bench) == (21.0, 21.0, 0)


# Twelve benches of 0.8 m and a tail of 5 m, too long for a hairpin of 0.6 m; it comes there at 28.26 m.
TAILED = Walk(
    Dragon.of_sizes([0.8] * 12 + [5.0], 0.2, 0.1, 0.1),
    Route.joined([Line(20.0), Arc(0.6, math.pi), Line(20.0)]),
)


@pytest.mark.parametrize("end", [21.5, 23.0, 25.0, 28.2])
def test_a_tail_that_does_not_come_to_a_bend_too_tight_for_it_is_no_hindrance(end: float) -> None:
    assert least_clearance(TAILED, 14.0, end).value == pytest.approx(0.32342, abs=5e-5)
    assert first_contact(TAILED, 14.0, end, margin=0.3) is None


def test_a_tail_that_comes_there_is_named_where_it_does() -> None:
    with pytest.raises(WalkError) as caught:
        first_contact(TAILED, 14.0, 31.0)
    assert caught.value.bench == 13
    assert TAILED.placement([caught.value.head - 3e-9]).status.tolist() == [0]


def test_a_failure_far_past_what_was_searched_leaves_the_walk_undecided() -> None:
    hunt = ContactSearch(FOLDING, 0.0, 40.0, 0.0, silent)
    with pytest.raises(WalkError) as caught:
        first_contact(FOLDING, 0.0, 40.0)
    fails = caught.value.head
    assert isinstance(hunt.stopped(fails, 40.0), WalkError)
    undecided = hunt.stopped(fails - 0.1, 40.0)
    assert isinstance(undecided, UnsureError)
    assert f"past t = {fails - 0.1:.6g} s" in str(undecided)
