"""A dance in and out again that ends too soon says so, and what end is enough."""

import math
from typing import Any

import pytest

from benchdragon.analysis.check import Report, check, sentence
from benchdragon.analysis.unfinished import NEARLY, unfinished
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import Plan, checked

TURN: dict[str, Any] = {
    "schema": 1, "route": {"kind": "turn", "pitch": 1.7}, "dragon": {"benches": 12},
    "walk": {"speed": 0.8, "start": -10},
}  # fmt: skip


def turn(**walk: Any) -> Plan:
    """A short dragon that turns; more keys of its walk."""
    return checked({**TURN, "walk": {**TURN["walk"], **walk}}, "turn")


def whole_end(plan: Plan) -> float:
    """The end of a walk as its kind of route says."""
    return plan.span(plan.build())[1]


def judged(plan: Plan) -> Report:
    return check(plan)


def test_a_dance_to_its_own_end_or_later_lacks_nothing() -> None:
    plan = turn()
    assert judged(plan).unfinished is None
    late = turn(end=whole_end(plan) + 3.0)
    assert judged(late).unfinished is None
    assert "before the tail" not in sentence(judged(late))


def test_an_early_end_tells_the_end_that_is_enough_and_with_it_the_tail_is_out() -> None:
    needed = whole_end(turn())
    early = judged(turn(end=needed - 2.0))
    assert early.unfinished is not None
    assert early.unfinished.way == pytest.approx(1.6, abs=1e-9)
    end = early.unfinished.end
    assert end is not None
    assert needed <= end < needed + 0.1
    text = (
        f"the dance ends before the tail is out of the turn: let the walk end at {end:.1f} s or later"
    )
    assert text in sentence(early)
    with spoken_in("zh"):
        assert f"最早改到 {end:.1f} 秒" in sentence(early)
    later = turn(end=end)
    walk = later.build()
    assert unfinished(later, walk, end) is None
    tail = walk.motion([end]).s[0, -1]
    assert tail >= walk.route.joints[-2] - NEARLY


def test_a_slower_walk_with_the_old_end_is_told_the_new_one() -> None:
    end = math.ceil(whole_end(turn()))
    assert judged(turn(end=end)).unfinished is None
    slower = judged(turn(end=end, speed=0.6)).unfinished
    assert slower is not None
    assert slower.end == pytest.approx(whole_end(turn()) * 0.8 / 0.6, abs=0.11)


def test_a_head_that_stops_for_good_lacks_a_way_and_no_end_is_enough() -> None:
    walk = {"profile": [[0, 0.8], [10, 0.8], [12, 0]], "start": -10, "end": 30}
    stopping = judged(checked({**TURN, "walk": walk}, "stops"))
    assert stopping.unfinished is not None
    assert stopping.unfinished.end is None
    assert f"the head lacks {stopping.unfinished.way:.1f} m" in sentence(stopping)


def test_other_dances_may_end_anywhere() -> None:
    spiral = checked({"schema": 1, "base": "spiral-in", "walk": {"end": 20}}, "spiral")
    assert judged(spiral).unfinished is None
