"""Proposed dances pass the check, or are refused for a reason that is true."""

import random
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.check import check
from benchdragon.errors import InputError, NoSolutionError, UnsureError
from benchdragon.plans.schema import Plan
from benchdragon.progress import silent
from benchdragon.solve import proposal
from benchdragon.solve.course import course_of
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.proposal import Proposal, TooSmall, _may_fit, benches_out_again, propose
from benchdragon.solve.square import Square
from benchdragon.solve.wishes import Wishes

SMALL = Wishes(12, 1.5, 0.15, rectangle=(20.0, 18.0), carry="under")


def random_wishes(seed: int) -> Wishes:
    draw = random.Random(seed)
    sides = round(draw.uniform(8.0, 30.0), 1), round(draw.uniform(8.0, 30.0), 1)
    return Wishes(
        draw.randint(2, 14), round(draw.uniform(1.2, 2.0), 2), round(draw.uniform(0.1, 0.3), 2),
        rectangle=sides, carry=draw.choice(["beside", "under"]), speed=draw.uniform(0.3, 1.2),
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(3))
def test_a_proposal_passes_the_check_and_a_refusal_is_true(seed: int) -> None:
    wishes = random_wishes(seed)
    found = propose(wishes)
    if isinstance(found, Proposal):
        assert check(found.plan).safe
        return
    assert isinstance(propose(replace(wishes, rectangle=found.rectangle)), Proposal)
    if found.benches:
        assert isinstance(propose(replace(wishes, benches=found.benches)), Proposal)


def test_a_square_that_is_too_small_is_refused_and_the_one_it_names_is_not() -> None:
    found = propose(replace(SMALL, rectangle=(6.0, 6.0)))
    assert isinstance(found, TooSmall)
    assert isinstance(propose(replace(SMALL, rectangle=None, radius=found.radius)), Proposal)


def test_the_speed_that_handles_allow_is_sought_of_dances_that_fit_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It takes as long as a place on the square; what does not fit needs none."""
    asked, found_room = [], []
    roomiest = proposal._roomiest

    def speed(plan: Plan) -> Any:
        asked.append(plan)
        return greatest_head_speed(plan)

    monkeypatch.setattr(proposal, "greatest_head_speed", speed)

    def placed(wishes: Wishes, plan: Plan) -> Any:
        dance = roomiest(wishes, plan)
        found_room.append(dance.room >= 0.0)
        return dance

    monkeypatch.setattr(proposal, "_roomiest", placed)
    found = propose(replace(SMALL, carry="beside", rectangle=(17.0, 15.0)))
    assert isinstance(found, Proposal)
    assert not found.slower
    assert 0 < len(asked) == sum(found_room) < len(found_room)


def coil_on(wishes: Wishes) -> Square:
    """A small coil on the square of some wishes."""
    return Square(wishes.plan("spiral-in", 1.6, 2.0, 1.0).with_value("route.start_turn", 2.5))


def test_what_keeps_its_margin_at_an_angle_between_two_that_are_tried_may_fit() -> None:
    square = coil_on(SMALL)
    whole = [square.extent(float(angle)) for angle in range(180)]
    between = 0
    for angle in np.arange(0.5, 180.0, 3.0):
        left, right, low, high = square.extent(float(angle))
        sides = right - left, high - low
        kept = [side + 2.0 * square.venue.margin for side in sides]
        assert _may_fit(square, replace(SMALL, rectangle=(kept[0], kept[1])))
        between += not any(
            one[1] - one[0] <= max(sides) and one[3] - one[2] <= min(sides) for one in whole
        )
    assert between


@pytest.mark.parametrize("turned", [0.0, 90.0])
def test_a_long_dance_may_fit_along_the_longer_side(turned: float) -> None:
    wide = {"route.start_turn": 6.0, "walk.end": 1.0}
    square = Square(SMALL.plan("spiral-in", 1.6, 2.0, 1.0).with_values(wide))
    left, right, low, high = square.extent(turned)
    sides = [side + 2.0 * square.venue.margin for side in (right - left, high - low)]
    assert abs(sides[0] - sides[1]) > 2.0
    assert _may_fit(square, replace(SMALL, rectangle=(sides[0], sides[1])))


@pytest.mark.parametrize(("share", "may"), [(1.0, True), (0.9991, True), (0.9989, False)])
def test_a_dance_may_fit_a_round_square_of_its_own_size(share: float, may: bool) -> None:
    """The circle about it may be wider than the smallest by a thousandth."""
    square = coil_on(SMALL)
    radius = share * square.circle()[2] + square.venue.margin
    assert _may_fit(square, replace(SMALL, rectangle=None, radius=radius)) is may


def test_what_may_not_fit_has_no_room_anywhere() -> None:
    seen = set()
    for size in (6.0, 9.0, 12.0, 15.0):
        corners = ((0.0, 0.0), (size, 0.3 * size), (0.8 * size, 1.2 * size), (-0.1 * size, size))
        for wishes in (
            replace(SMALL, rectangle=None, radius=0.5 * size),
            replace(SMALL, rectangle=None, boundary=corners),
            replace(SMALL, rectangle=(size, 1.1 * size)),
        ):
            square = coil_on(wishes)
            room = square.room(square.roomiest(silent))
            may = _may_fit(square, wishes)
            assert may or room < 0.0
            seen.add((may, room >= 0.0))
    assert {(True, True), (False, False)} <= seen


CROOKED = ((0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0))  # 7 m²


@pytest.mark.parametrize(
    ("square", "most"),
    [({"rectangle": (4.0, 4.0)}, 143), ({"radius": 2.0}, 111), ({"boundary": CROOKED}, 63)],
)
def test_benches_that_need_more_ground_than_there_is_are_refused_without_a_search(
    square: dict[str, Any], most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every second bench alone takes more: so many are still searched for, and one more is not."""
    monkeypatch.setattr(proposal, "_tried", found_nothing)
    for benches in (most + 1, 200):
        with pytest.raises(NoSolutionError, match=f"enough for {most} benches at most"):
            propose(Wishes(benches, 1.5, 0.15, **square))
    with pytest.raises(UnsureError):
        propose(Wishes(most, 1.5, 0.15, **square))


def found_nothing(*_asked: object) -> object:
    """What a search comes to that found a dance for the square, which did not pass the check."""
    return proposal._Tried(None, True)


def test_a_bench_that_is_longer_than_the_square_is_across_is_refused_without_a_search(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(proposal, "_tried", found_nothing)
    with pytest.raises(NoSolutionError, match=r"a bench of 5.1 m .* which is 5.00 m across"):
        propose(Wishes(2, 1.5, 0.15, head_length=5.1, rectangle=(3.0, 4.0)))
    with pytest.raises(UnsureError):
        propose(Wishes(2, 1.5, 0.15, head_length=5.0, rectangle=(3.0, 4.0)))


def test_a_head_slows_down_where_benches_behind_would_be_too_fast() -> None:
    found = propose(replace(SMALL, speed=2.0, most_speed=1.0))
    assert isinstance(found, Proposal)
    assert found.slower
    assert found.report.greatest_speed.upper <= 1.0


def test_few_benches_for_which_every_pitch_serves_get_a_turn() -> None:
    """Their dragon is shorter than a round: no search finds a smallest pitch."""
    found = propose(Wishes(3, 2.0, 0.3, radius=30.0, kind="turn"))
    assert isinstance(found, Proposal)
    assert found.plan.route.kind == "turn"


def test_a_square_that_is_not_said_or_said_twice_is_refused() -> None:
    for wishes in (replace(SMALL, rectangle=None), replace(SMALL, radius=9.0)):
        with pytest.raises(InputError, match="its rectangle, its radius or its corners"):
            propose(wishes)


def test_a_course_tells_the_rounds_of_the_coil_and_the_way_of_the_head() -> None:
    found = propose(replace(SMALL, benches=30, rectangle=(25.0, 25.0), kind="spiral-in"))
    assert isinstance(found, Proposal)
    course, plan = course_of(found.plan), found.plan
    assert not course.out
    assert course.way == pytest.approx(plan.walk.speed * course.seconds)
    # Where the head starts a round farther out, the dragon stands in fewer rounds.
    farther = course_of(plan.with_value("route.start_turn", plan.value("route.start_turn") + 1.0))
    assert farther.way > course.way
    assert 0.0 < farther.rounds < course.rounds


def test_less_measured_sway_and_imprecision_need_less_room_and_are_kept() -> None:
    found, steady = (propose(one) for one in (SMALL, replace(SMALL, sway=0.0, imprecision=0.02)))
    assert isinstance(found, Proposal)
    assert isinstance(steady, Proposal)
    assert steady.plan.value("route.pitch") < found.plan.value("route.pitch")
    assert (steady.plan.people.sway, steady.plan.people.imprecision) == (0.0, 0.02)
    assert steady.report.safe
    small = [propose(replace(SMALL, rectangle=(6.0, 6.0), imprecision=one)) for one in (0.0, 0.3)]
    assert isinstance(small[0], TooSmall)
    assert isinstance(small[1], TooSmall)
    assert small[0].radius < small[1].radius


def test_a_proposed_dance_in_and_out_again_ends_when_its_tail_is_out() -> None:
    found = propose(replace(SMALL, kind="turn"))
    assert isinstance(found, Proposal)
    assert found.plan.walk.end is not None
    assert found.report.unfinished is None


def test_a_longer_dance_is_proposed_where_it_fits() -> None:
    """The same benches on a larger square: the head walks farther."""
    ways = []
    for side in (13.0, 20.0):
        found = propose(replace(SMALL, rectangle=(side, side), kind="spiral-in"))
        assert isinstance(found, Proposal)
        ways.append(course_of(found.plan).way)
    assert ways[0] < ways[1]


@pytest.mark.parametrize("rounds", [2, 3])
def test_rounds_that_are_wished_are_danced_where_they_fit(rounds: int) -> None:
    once, often = propose(SMALL), propose(replace(SMALL, rounds=rounds))
    assert isinstance(once, Proposal)
    assert isinstance(often, Proposal)
    assert "rounds" not in once.plan.own()["route"]
    assert often.plan.value("route.rounds") == rounds
    assert check(often.plan).safe
    assert often.report.unfinished is None
    assert often.plan.walk.end is not None
    assert often.plan.dragon.benches == SMALL.benches
    # The head comes past the middle once in each round.
    walk = often.plan.build()
    start, end = often.plan.span(walk)
    times = np.linspace(start, end, 2001)
    points = walk.route.point(walk.head_position(times))
    assert often.plan.route.at is not None
    inside = np.hypot(*(points - often.plan.route.at).T) < 0.9 * often.plan.value("disc.radius")
    assert np.count_nonzero(np.diff(inside.astype(int)) == 1) == rounds - inside[0]


def test_a_dance_coils_once_where_there_is_no_room_to_go_back_in() -> None:
    wishes = replace(SMALL, benches=6, rectangle=(11.0, 10.0), rounds=3)
    found, once = propose(wishes), propose(replace(wishes, rounds=1))
    assert isinstance(found, Proposal)
    assert isinstance(once, Proposal)
    assert found.plan.data() == once.plan.data()
    assert benches_out_again(wishes) == benches_out_again(replace(wishes, rounds=1))


STREET = {"points": [[-40.0, 0.0], [-20.0, 2.0], [-9.0, 5.0]]}


@pytest.mark.parametrize("rounds", [1, 3])
def test_a_proposed_dance_begins_in_the_street_that_leads_to_it(rounds: int) -> None:
    found = propose(replace(SMALL, rectangle=(24.0, 24.0), street=STREET, rounds=rounds))
    assert isinstance(found, Proposal)
    assert check(found.plan).safe
    assert found.plan.value("route.rounds") == rounds
    walk = found.plan.build()
    assert walk.route.point(walk.head_position([walk.start])[0]) == pytest.approx((-40.0, 0.0), abs=0.2)
    assert not course_of(found.plan).inside  # as it does where the dance begins on the square


def test_a_street_that_leads_to_no_dance_is_traded_for_benches() -> None:
    across = {"points": [[-40.0, 0.0], [-20.0, 2.0], [11.5, 0.0]]}  # where the coil is to be
    for street in (across, STREET | {"radius": 0.2}):
        wishes = replace(SMALL, rectangle=(24.0, 24.0), rounds=2)
        found, without = propose(replace(wishes, street=street)), propose(wishes)
        assert isinstance(found, Proposal)
        assert isinstance(without, Proposal)
        assert found.plan.data() == without.plan.data()


def test_rounds_that_cannot_be_are_refused() -> None:
    for rounds in (0, 21):
        with pytest.raises(InputError, match=f"coils in and out 1 to 20 times, not {rounds}"):
            propose(replace(SMALL, rounds=rounds))
    with pytest.raises(InputError, match="coils in alone has no rounds"):
        propose(replace(SMALL, rounds=2, kind="spiral-in"))


YARD = Wishes(48, 1.8, 0.15, head_length=2.3, rectangle=(35.0, 25.0), obstacles=(
    {"kind": "circle", "name": "pole", "centre": [0, 9], "radius": 0.3, "margin": 0.5},
    {"kind": "rectangle", "name": "stage", "size": [8, 4], "centre": [-13, 8], "margin": 1},
))  # fmt: skip


def test_all_households_of_a_yard_with_a_stage_and_a_pole_dance_in_and_out_again() -> None:
    found = propose(YARD)
    assert isinstance(found, Proposal)
    assert found.plan.route.kind == "turn"
    assert [one.name for one in found.plan.obstacles()] == ["venue", "pole", "stage"]
    assert check(found.plan).safe
    assert not found.less_ahead
    # On a smaller yard they all do if there is less room before the head.
    tight = propose(replace(YARD, rectangle=(31.0, 22.0)))
    assert isinstance(tight, Proposal)
    assert (tight.plan.route.kind, tight.less_ahead) == ("turn", True)


def test_a_dance_is_proposed_within_any_corners() -> None:
    corners = ((-9.0, -8.0), (9.0, -8.0), (9.0, 8.0), (0.0, 8.0), (0.0, 10.0), (-9.0, 10.0))
    found = propose(replace(SMALL, benches=9, rectangle=None, boundary=corners))
    assert isinstance(found, Proposal)
    assert check(found.plan).safe
    assert found.plan.venue.boundary == list(corners)
