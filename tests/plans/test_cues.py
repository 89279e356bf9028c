"""Cues: what holds, stops and starts make of the head's speed; what cannot be, in one sentence."""

import random
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.check import check
from benchdragon.errors import InputError
from benchdragon.model import holds
from benchdragon.model.holds import Hold, HoldError, with_holds
from benchdragon.model.profile import SpeedProfile
from benchdragon.plans.cues import CuesTable
from benchdragon.plans.schema import Plan, checked
from benchdragon.plans.toml import PlanError
from benchdragon.solve.head_speed import slowed
from benchdragon.solve.size import limit

SPIRAL = {"kind": "spiral-in", "pitch": 1.0, "start_turn": 4}


def plan_with(*cues: dict[str, Any], walk: dict[str, Any] | None = None, **others: Any) -> Plan:
    data = {"dragon": {"benches": 4, "head_length": 2.2}, "route": SPIRAL, "disc": {"radius": 2.0}}
    data |= {"walk": walk or {}, "cues": {"cue": list(cues), **others}}
    return checked({"schema": 1, **data}, "dance")


def random_profile(dice: random.Random, start: float) -> SpeedProfile:
    times = sorted(start + dice.uniform(-30.0, 60.0) for _ in range(dice.randint(1, 7)))
    speeds = [dice.choice([0.0, dice.uniform(0.1, 1.5), 1.0]) for _ in times]
    return SpeedProfile(tuple(times), (*speeds[:-1], dice.uniform(0.3, 1.5)))


def random_hold(dice: random.Random, start: float) -> Hold:
    if dice.random() < 0.6:
        return Hold(way=dice.choice([0.0, dice.uniform(0.0, 50.0)]), seconds=dice.uniform(0.5, 9.0))
    return Hold(at=start + dice.uniform(0.0, 90.0), seconds=dice.uniform(0.5, 9.0))


def steepest(profile: SpeedProfile) -> float:
    return max(map(abs, np.diff(profile.speeds) / np.diff(profile.times)), default=0.0)


@pytest.mark.parametrize("block", range(4))
def test_with_any_cues_the_head_stands_where_and_when_it_is_to_and_keeps_its_limits(block: int) -> None:
    dice, held = random.Random(block), 0
    for _ in range(150):
        start, rate = dice.choice([0.0, -37.5, 12.0]), dice.uniform(0.1, 1.0)
        own = random_profile(dice, start)
        holds = [random_hold(dice, start) for _ in range(dice.randint(1, 4))]
        try:
            paced, stood = with_holds(own, start, holds, [], rate)
        except HoldError:
            continue
        for one in stood:
            hold, way = holds[one.number], float(paced.distance(one.start) - paced.distance(start))
            assert abs(way - one.way) < 1e-9
            assert hold.way is None or abs(hold.way - way) < 1e-9
            assert hold.at is None or hold.at == one.start
            assert not paced.speed([one.start, one.end]).any()
            assert one.end == one.start + hold.seconds
            held += 1
        assert steepest(paced) <= max(rate, steepest(own)) * (1.0 + 1e-6)
        _never_faster(own, paced, start, rate)
        # Past the last hold it walks on as without: on any way as long, and later by a fixed time.
        late = paced.times[-1] + 5.0
        walked = float(paced.distance(late) - paced.distance(start))
        before = own.time(walked + float(own.distance(start)))
        lag = late - before
        again = float(paced.distance(late + 40.0) - paced.distance(start))
        if before > own.times[-1]:
            assert own.time(again + float(own.distance(start))) + lag == pytest.approx(late + 40.0)
    assert held > 60


def _never_faster(own: SpeedProfile, paced: SpeedProfile, start: float, rate: float) -> None:
    """At no place is the head faster than it was there without holds."""
    times = np.linspace(start, paced.times[-1] + 9.0, 150)
    ways = paced.distance(times) - float(paced.distance(start)) + float(own.distance(start))
    then = np.array([max(own.time(way), start) for way in ways.tolist()])
    # The speed at a place is known as well as the place: as far as rounding moves the head.
    room = np.sqrt(2.0 * max(rate, steepest(own)) * 1e-9)
    standing = own.speed(then) == 0.0  # of a rest, when it comes and when it goes
    assert (paced.speed(times)[~standing] <= own.speed(then)[~standing] + room).all()


def test_a_hold_in_an_even_walk_comes_out_as_by_hand() -> None:
    paced, (stood,) = with_holds(
        SpeedProfile.constant(1.0), 0.0, [Hold(way=10.0, seconds=5.0)], [], 0.5
    )
    assert paced.times == pytest.approx((0.0, 9.0, 11.0, 16.0, 18.0))
    assert paced.speeds == pytest.approx((1.0, 1.0, 0.0, 0.0, 1.0))
    assert (stood.start, stood.end) == pytest.approx((11.0, 16.0))


def test_there_is_room_for_all_knots_of_a_walk_with_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = [Hold(way=5.0, seconds=2.0), Hold(at=30.0, seconds=2.0), Hold(way=40.0, seconds=2.0)]
    own = SpeedProfile((0.0, 5.0, 9.0, 30.0), (0.5, 1.5, 0.7, 1.0))
    known = with_holds(own, 0.0, asked, [], 0.4)
    monkeypatch.setattr(holds, "KNOTS", 1)
    assert with_holds(own, 0.0, asked, [], 0.4) == known


def test_two_holds_near_one_another_are_walked_between_as_fast_as_can_be() -> None:
    holds = [Hold(way=3.0, seconds=1.0), Hold(way=3.5, seconds=1.0)]
    paced, stood = with_holds(SpeedProfile.constant(1.0), 0.0, holds, [], 0.5)
    assert stood[1].start - stood[0].end == pytest.approx(2.0)  # 0.25 m at 0.5 m/s^2, up and down
    assert max(paced.speeds[3:-1]) == pytest.approx(0.5)


def test_the_walk_ends_later_by_what_holds_take() -> None:
    free, held = plan_with(), plan_with({"kind": "hold", "head": 20.0, "hold": 30.0})
    ends = [plan.span(plan.build())[1] for plan in (free, held)]
    assert ends[1] - ends[0] == pytest.approx(30.0 + 2.0, abs=1e-6)  # and 1 s each to brake and start
    assert check(held).clearance.value == pytest.approx(check(free).clearance.value, abs=1e-9)
    assert check(held).safe
    at = held.build().head_position([held.moments()[0].time])[0]
    assert at == pytest.approx(20.0, abs=1e-9)


def test_a_walk_that_starts_before_time_0_starts_where_it_did() -> None:
    walk = {"start": -10.0, "position": 15.0}
    free, held = plan_with(walk=walk), plan_with({"kind": "hold", "head": 3.0, "hold": 4.0}, walk=walk)
    assert held.build().head_position([-10.0]) == pytest.approx(free.build().head_position([-10.0]))
    assert held.moments()[0].time == pytest.approx(-6.0)
    assert limit(held, "width").value == pytest.approx(limit(free, "width").value, abs=1e-9)


def test_a_stop_lasts_until_the_next_start_or_ends_the_dance() -> None:
    stop = {"kind": "stop", "head": 10.0}
    waits = plan_with(stop, {"kind": "start", "at": "1 min"})
    assert waits.moments()[0].until == 60.0
    walk = plan_with(stop).build()
    assert plan_with(stop).span(walk)[1] == pytest.approx(11.0)
    assert walk.head_position([99.0]) == pytest.approx(10.0)


def test_what_holds_nothing_is_told_when_the_head_is_there() -> None:
    plan = plan_with(
        {"kind": "beat", "head": 12.0}, {"kind": "hold", "head": 10.0, "hold": 5.0},
        {"kind": "note", "head": 10.0, "text": "bow"}, {"kind": "tempo", "at": 3.0, "tempo": 120},
    )  # fmt: skip
    found = [(one.cue.kind, one.time) for one in plan.moments()]
    assert [kind for kind, _time in found] == ["tempo", "hold", "note", "beat"]
    assert found[1][1] == found[2][1] == pytest.approx(11.0)
    assert found[3][1] == pytest.approx(16.0 + 2.0 + 1.0)  # 1 m to come to speed, and 1 m


def test_plans_without_cues_keep_their_names_and_others_have_their_own() -> None:
    names = {plan_with().sha256, plan_with({"kind": "beat", "at": 1.0}).sha256, plan_with(bar=3).sha256}
    assert len(names) == 3
    plain = {"schema": 1, "dragon": {"benches": 4, "head_length": 2.2}, "route": SPIRAL}
    assert checked({**plain, "disc": {"radius": 2.0}}, "plain").sha256 == plan_with().sha256


HOLD = {"kind": "hold", "hold": 5.0}


@pytest.mark.parametrize(
    ("cues", "sentence"),
    [
        ([{**HOLD, "head": 0.9}], "cues.cue.0: to stand there the head would have to brake harder"),
        ([{**HOLD, "at": 1.0}], "cues.cue.0: to stand there the head would have to brake harder"),
        ([{**HOLD, "at": -3.0}], "cues.cue.0: that is before the dance starts, at 0 s"),
        ([{**HOLD, "head": 9.0}, {**HOLD, "head": 9.0}], "cues.cue.1: the head still stands"),
        ([{**HOLD, "head": 9.0}, {**HOLD, "at": 11.0}], "cues.cue.1: the head still stands"),
        ([{**HOLD, "at": 20.0}, {**HOLD, "at": 25.0}], "cues.cue.1: the head still stands"),
        ([{**HOLD, "head": 900.0}], "cues.cue.0: that is not within the dance"),
        ([{"kind": "beat", "at": -1.0}], "cues.cue.0: that is not within the dance"),
        ([{"kind": "note", "at": 900.0}], "cues.cue.0: that is not within the dance"),
        ([{"kind": "stop", "head": 9.0}, {**HOLD, "head": 12.0}], "cues.cue.1: the dance is over"),
        ([{"kind": "stop", "head": 9.0}, {"kind": "beat", "head": 12.0}], "cues.cue.1: that is not"),
        ([{"kind": "start", "at": 9.0}], "cues.cue.0: the head does not stand and wait then"),
        ([{"kind": "start", "head": 9.0}], "cues.cue.0: a start needs at"),
        ([{"kind": "beat"}], "cues.cue.0: a cue needs one of"),
        ([{"kind": "beat", "at": 1.0, "head": 1.0}], "cues.cue.0: a cue needs one of"),
        ([{"kind": "hold", "at": 1.0}], "cues.cue.0: a cue needs hold if its kind is hold"),
        ([{"kind": "beat", "at": 1.0, "hold": 2.0}], "cues.cue.0: a cue needs hold if its kind"),
        ([{"kind": "beat", "at": 1.0, "tempo": 90}], "cues.cue.0: a cue needs tempo if its kind"),
        ([{"kind": "beat", "at": 1.0}] * 201, "cues.cue: expected at most 200 entries"),
    ],
)
def test_a_cue_that_cannot_be_is_refused_in_one_sentence(cues: list[Any], sentence: str) -> None:
    def spanned() -> None:
        plan = plan_with(*cues)
        plan.span(plan.build())

    with pytest.raises(PlanError) as caught:
        spanned()
    assert sentence in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize(
    ("others", "sentence"),
    [
        ({"acceleration": 0.6}, "cues.acceleration: at most limits.head_acceleration, 0.5 m/s^2"),
        ({"clock": "25:00"}, "cues.clock: expected a time of day such as 18:30, not '25:00'"),
        ({"tempo": 10}, "cues.tempo: expected at least 20"),
        *(
            (
                {"cue": [{"kind": "note", "at": 2.0, key: text}]},
                f"cues.cue.0.{key}: expected text that can",
            )
            for key in ("text", "text_zh")
            for text in ("a\nb", "bell \u0007", "\u202eleft", " ")
        ),
    ],
)
def test_other_keys_are_checked_too(others: dict[str, Any], sentence: str) -> None:
    with pytest.raises(PlanError, match=sentence.replace(".", r"\.").split("^")[0]):
        plan_with(**others).build()


def test_a_pace_is_sought_without_holds() -> None:
    plan = plan_with({**HOLD, "head": 9.0}).with_value("limits.speed", 1.5)
    with pytest.raises(InputError, match="cues hold the head"):
        slowed(plan)


@pytest.mark.parametrize(
    ("said", "clock"),
    [
        ("24:00", "0:00"),
        ("24:00:00", "0:00"),
        ("２４：００", "0:00"),
        ("１８：３０", "18:30"),
        ("9:05", "9:05"),
    ],
)
def test_a_clock_is_read_as_people_write_it(said: str, clock: str) -> None:
    assert CuesTable(clock=said).clock == clock
