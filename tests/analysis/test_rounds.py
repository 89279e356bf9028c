"""What repeats is left out of searches, and nothing else: their answers are those of the whole walk."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchdragon import budget
from benchdragon.analysis.check import Report, check
from benchdragon.analysis.contact import (
    contact_windows,
    first_contact,
    first_sure_contact,
    least_clearance,
)
from benchdragon.analysis.contact_search import contact_search
from benchdragon.analysis.nearby import seams_of
from benchdragon.analysis.obstacles import least_distance
from benchdragon.analysis.rounds import Rounds, repeats, returns
from benchdragon.analysis.speed import QUANTITIES, greatest
from benchdragon.errors import WalkError
from benchdragon.kernels import contact_least
from benchdragon.kernels.rounding import Seam
from benchdragon.kernels.rounds import MOST_MISSED
from benchdragon.kernels.spans import BEYOND_ROUND
from benchdragon.model.answer import Answer
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.progress import silent
from tests.analysis.rounds import (
    BEND,
    LINE,
    all_of_it,
    circle,
    coil,
    periods,
    plan_of,
    random_coil,
    random_rounds,
    stadium,
    told,
)
from tests.solve.asked_in_python import in_python

__all__ = ["all_of_it"]
CASES = Path(__file__).parents[1] / "cases"
LIMITS = {"speed": 1.5, "turning_rate": 60, "lateral_acceleration": 2}
PEOPLE = {"sway": 0.05, "imprecision": 0.05, "beside": 0.1}


def new(plan: Plan) -> list[tuple[float, float]]:
    """What a search of a plan's walk looks at of the head's way, m."""
    walk = plan.build()
    return list(contact_search(walk, *plan.span(walk), 0.0, silent).spans)


def together(one: Answer, other: Answer) -> bool:
    """Whether one number may lie in both brackets."""
    return max(one.lower, other.lower) <= min(one.upper, other.upper)


@pytest.mark.parametrize("rounds", [2, 10, 1000])
def test_on_a_circle_the_head_is_followed_until_all_benches_walk_it(rounds: int) -> None:
    ((first, last),) = new(circle(rounds))
    links = circle(rounds).build().dragon.links.sum()
    assert first == 0.0
    assert 5.0 + links < last < 5.0 + 1.1 * links


@pytest.mark.parametrize("rounds", [3, 10, 300])
def test_of_a_circuit_one_round_is_followed_after_all_benches_walk_it(rounds: int) -> None:
    plan = stadium(rounds)
    walk = plan.build()
    half = LINE["length"] + math.pi * BEND["radius"]
    ((first, last),) = new(plan)
    assert first == 0.0
    assert last == pytest.approx(walk.head_where_tail(BEYOND_ROUND) + half + BEYOND_ROUND, abs=1e-6)


@pytest.mark.parametrize("rounds", [3, 4, 12])
def test_of_a_coil_two_rounds_are_followed(rounds: int) -> None:
    """One in which the dragon comes from elsewhere, and one from a round before."""
    plan = coil(rounds)
    walk = plan.build()
    ((first, last),) = new(plan)
    start, end = walk.head_position(plan.span(walk)).tolist()
    (period,) = periods(repeats(walk.route.rows))
    links = walk.dragon.links.sum()
    assert first == start
    assert last < start + 2.0 * period + 2.0 * links < end


def test_what_comes_after_rounds_is_followed_too() -> None:
    plan = plan_of([LINE, BEND] * 8 + [{"kind": "arc", "radius": 30.0 / math.pi, "angle": 180}])
    spans, length = new(plan), plan.build().route.length
    assert len(spans) > 1
    # The last row of the route may be walked by all benches at once: it is the same everywhere, then.
    assert spans[-1][0] <= length - 30.0 < spans[-1][1] < length


def test_a_search_that_begins_later_looks_at_a_round_of_its_own() -> None:
    walk = stadium(9).build()
    half = LINE["length"] + math.pi * BEND["radius"]
    ((first, end),), _missed = Rounds(walk, repeats(walk.route.rows)).new(120.0, 300.0)
    assert first == 120.0
    assert end == pytest.approx(120.0 + half, abs=1e-5)


def crossing_after_rounds() -> Plan:
    """Rounds of a circle, and then a loop in which the head crosses the way of its tail."""
    loop = [{"kind": "line", "length": 12}, {"kind": "arc", "radius": 3, "angle": 270}]
    part = [{"kind": "arc", "radius": 9, "angle": 360 * 4}, *loop, {"kind": "line", "length": 12}]
    return plan_of([{"kind": "line", "length": 1}, *part], dragon={"benches": 14})


def test_a_contact_after_rounds_is_found() -> None:
    plan = crossing_after_rounds()
    walk, span = plan.build(), plan.span(plan.build())
    assert len(new(plan)) == 2
    found = first_contact(walk, *span)
    (whole, *_more) = contact_windows(walk, *span, most=1)
    assert found is not None
    assert found.value > 2.0 * math.pi * 9.0 * 4.0
    assert together(found, whole.opens)


def test_each_pass_of_a_clearance_sees_all_spans(all_of_it: pytest.MonkeyPatch) -> None:
    """Benches are nearest in a bend before rounds; of a long dragon that is first seen by a pass."""
    bend = [{"kind": "line", "length": 8}, {"kind": "arc", "radius": 2.5, "angle": 150}]
    part = [*bend, {"kind": "line", "length": 3}, {"kind": "arc", "radius": 9, "angle": 360 * 4}]
    plan = plan_of(
        [*part, {"kind": "clothoid", "length": 9, "start_curvature": 0, "end_curvature": 0.1}]
    )
    walk, span = plan.build(), plan.span(plan.build())
    whole = least_clearance(walk, *span)
    assert whole.witness is not None
    assert whole.witness.s < 30.0
    all_of_it.undo()
    assert len(new(plan)) > 1
    in_python(all_of_it)
    all_of_it.setattr(contact_least, "MOST_SAMPLED", 3)
    assert together(least_clearance(walk, *span), whole)


def test_a_walk_that_ends_past_its_route_is_refused_after_any_number_of_rounds() -> None:
    plan = stadium(9, walk={"end": 1000})
    with pytest.raises(WalkError, match="past the end of the route"):
        check(plan)


def test_a_kink_is_not_the_same_as_another() -> None:
    sharp = [{"kind": "line", "length": 30.0}, {"kind": "arc", "radius": 9, "angle": 30}]
    rows = plan_of(sharp * 4).build().route.rows.copy()
    assert periods(repeats(rows))
    rows[3, 9] += 1e-8  # its angle
    for one in told(repeats(rows)):
        for kink in rows[[3, 4], 2].tolist():
            assert not one.low + 1e-6 < kink < one.high - one.period - 1e-6
            assert not one.low + one.period + 1e-6 < kink < one.high - 1e-6


@pytest.mark.parametrize("column", [0, 3, 10, 11])
def test_rows_of_other_shapes_do_not_repeat(column: int) -> None:
    part = [{"kind": "clothoid", "length": 5, "start_curvature": 0, "end_curvature": 0.1}] * 2
    rows = plan_of(part).build().route.rows.copy()
    rows[1, 9] = rows[0, 9] + 5 * 0.05  # as if they were joined smoothly
    assert periods(repeats(rows)) == [5.0]
    rows[1, column] = 1.0 if column == 0 else rows[1, column] + 1e-12
    assert not periods(repeats(rows))


def test_spirals_do_not_repeat() -> None:
    assert not len(repeats(read_plan("spiral-in").build().route.rows))


def test_what_leads_elsewhere_does_not_return() -> None:
    ahead = plan_of([LINE, {**BEND, "angle": 170}] * 8).build().route.rows
    assert periods(repeats(ahead))
    assert not [one for one in told(returns(ahead, 2.0)) if one.high - one.low > one.period]


@pytest.mark.parametrize(("by", "far", "column"), [(2e-5, 2e-4, 7), (2e-5, 2e-4, 8), (9e-10, 1e-5, 9)])
def test_what_a_round_misses_its_beginning_by_is_told(by: float, far: float, column: int) -> None:
    rows = stadium(4).build().route.rows.copy()
    (kept,) = [one for one in told(returns(rows, 2.0)) if one.low == 0.0 and one.missed]
    assert kept.high == rows[-1, 2] + rows[-1, 3]
    assert kept.missed < 1e-9
    rows[9:, column] += by
    (moved,) = [one for one in told(returns(rows, 2.0)) if one.low == 0.0 and one.missed]
    assert moved.high == kept.high
    assert by * (1.0 if column < 9 else 10.0) <= moved.missed <= MOST_MISSED
    rows[9:, column] += far
    short = [one for one in told(returns(rows, 2.0)) if one.low == 0.0 and one.missed]
    assert all(one.high <= rows[9, 2] for one in short)


def test_what_joints_may_be_off_by_is_missed_too() -> None:
    rows = stadium(50).build().route.rows
    seams = seams_of(rows)
    (kept,) = [one for one in told(returns(rows, 2.0)) if one.low == 0.0 and one.missed]
    assert kept.missed > seams[-1, Seam.GAP] + seams[-1, Seam.TILT] * rows[-1, 2]


def test_a_thing_beside_many_rounds_has_a_bracket_for_what_they_miss() -> None:
    plan = stadium(50, obstacle=[{"kind": "circle", "centre": [4, 4], "radius": 1}])
    walk = plan.build()
    (kept,) = [one for one in told(returns(walk.route.rows, 2.9)) if one.low == 0.0 and one.missed]
    found = least_distance(walk, plan.obstacles()[0], *plan.span(walk))
    assert found.upper - found.value > 1.9 * kept.missed
    assert found.value - found.lower > 1.9 * kept.missed


@pytest.mark.parametrize("seed", range(24))
@pytest.mark.parametrize("made", [random_rounds, random_coil])
def test_answers_are_those_of_the_whole_walk(
    made: Callable[[int], Plan], seed: int, all_of_it: pytest.MonkeyPatch
) -> None:
    plan = made(seed)
    whole = check(plan)
    all_of_it.undo()
    found = check(plan)
    assert [one.kind for one in found.findings] == [one.kind for one in whole.findings]
    assert together(found.clearance, whole.clearance)
    assert together(found.greatest_speed, whole.greatest_speed)
    for one, other in zip(found.obstacles, whole.obstacles, strict=True):
        assert together(one.distance, other.distance)
        assert (one.contact is None) == (other.contact is None)
        if one.contact is not None and other.contact is not None:
            assert together(one.contact, other.contact)
    if found.first_contact is not None and whole.first_contact is not None:
        assert together(found.first_contact, whole.first_contact)


@pytest.mark.parametrize("made", [random_rounds, random_coil])
def test_random_rounds_are_of_all_kinds(made: Callable[[int], Plan]) -> None:
    kinds = [_kind(made(seed)) for seed in range(24)]
    assert {"skips", "touches", "skips for things", "skips and touches"} <= {*kinds[0].union(*kinds)}


def _kind(plan: Plan) -> set[str]:
    walk = plan.build()
    span = plan.span(walk)
    a, b = walk.head_position(span).tolist()
    known = returns(walk.route.rows, 2.0)
    short = type(walk)(walk.dragon.first(1), walk.route, walk.profile)
    skips = sum(last - first for first, last in new(plan)) < b - a
    things = Rounds(short, known).new(a, b)[0] != [(a, b)]
    touches = first_contact(walk, *span, margin=plan.limits.margin) is not None
    names = {"skips": skips, "touches": touches, "skips for things": things}
    names["skips and touches"] = skips and touches
    return {name for name, is_so in names.items() if is_so}


def test_windows_of_contact_are_listed_in_every_round() -> None:
    plan = plan_of(
        [{"kind": "line", "length": 12}, {"kind": "arc", "radius": 3, "angle": 270}] * 9,
        dragon={"benches": 14},
    )
    walk, span = plan.build(), plan.span(plan.build())
    assert new(plan)[0][1] < walk.route.length - 40.0
    windows = contact_windows(walk, *span)
    first = first_sure_contact(walk, *span, margin=0.0)
    assert first is not None
    assert first.value == windows[0].opens.value
    opened = np.array([one.opens.value for one in windows])
    period = 12 + 1.5 * math.pi * 3
    late = opened[opened > 5 * period]
    assert late.size
    for one in late:
        assert np.abs(opened - (one - period)).min() < 1e-6


@pytest.mark.parametrize("quantity", ["speed", "turning_rate", "total_acceleration", "acceleration"])
def test_a_head_that_changes_its_speed_is_followed_at_each(quantity: str) -> None:
    """Its greatest speed comes in a late round, and not on a stretch of one speed alone."""
    profile = [[0, 1.0], [150, 1.0], [151, 1.2], [160, 1.2], [162, 0.8], [300, 0.8]]
    plan = stadium(6, walk={"profile": profile})
    walk = plan.build()
    found = greatest(walk, QUANTITIES[quantity], 0.0, 220.0)
    motion = walk.motion(np.linspace(0.0, 220.0, 40_001))
    tables = {"speed": motion.speed, "acceleration": np.abs(motion.acceleration)}
    if quantity in tables:
        assert float(tables[quantity].max()) <= found.upper * (1.0 + 1e-9)
        assert float(tables[quantity].max()) >= found.lower * (1.0 - 1e-3)
    assert found.witness is not None
    assert found.witness.time is not None
    assert 150.0 <= found.witness.time <= 162.0


def test_a_head_that_walks_faster_and_faster_is_followed_to_the_end() -> None:
    plan = stadium(6, walk={"profile": [[0, 0.5], [200, 1.5]], "end": 200})
    walk = plan.build()
    found = greatest(walk, QUANTITIES["speed"], 0.0, 200.0)
    assert found.lower >= 1.5
    assert found.witness is not None
    assert found.witness.time is not None
    assert found.witness.time > 180.0


def work(plan: Plan) -> tuple[Report, float]:
    """A check, and what it took of the budget, in handles placed."""
    with budget.question():
        whole = budget.left()
        found = check(plan)
        return found, whole - budget.left()


def test_many_rounds_of_a_coil_take_as_much_work_as_three() -> None:
    asked = [f"people.{name}={value}" for name, value in PEOPLE.items()]
    three, few = work(coil(3, *asked))
    many, much = work(coil(12, *asked))
    assert (three.safe, many.safe) == (True, True)
    assert much <= 1.05 * few
    assert together(many.clearance, three.clearance)


@pytest.mark.parametrize(
    "more", [{}, {"obstacle": [{"kind": "circle", "centre": [4, 4], "radius": 1}]}]
)
@pytest.mark.parametrize("route", [circle, stadium])
def test_many_rounds_take_as_much_work_as_two(route: Any, more: dict[str, Any]) -> None:
    asked = {**more, "limits": LIMITS, "people": PEOPLE}
    two, few = work(route(3, **asked))
    many, much = work(route(100, **asked))
    assert (two.safe, many.safe) == (True, True)
    assert much <= 1.05 * few
    assert many.clearance.evaluations <= 1.05 * two.clearance.evaluations
    assert many.clearance.value == pytest.approx(two.clearance.value, abs=1e-7)
    assert many.clearance.upper - many.clearance.lower <= 1.1e-8


@pytest.mark.parametrize(
    ("file", "kinds", "near"),
    [
        ("check/circle_rounds", [], (1.081693, 1.081694)),
        ("check/seed50085", ["obstacle"], (0.034234, 0.034235)),
        ("field/R06", [], (0.863516, 0.863517)),
        ("field/R08", ["obstacle_margin"], (0.899999, 0.900001)),
    ],
)
def test_a_plateau_of_the_clearance_takes_no_verdict(
    file: str, kinds: list[str], near: tuple[float, float]
) -> None:
    """The first two took all the work that a question may, and got no verdict."""
    found, spent = work(read_plan(str(CASES / f"{file}.dragon.toml")))
    assert [one.kind for one in found.findings] == kinds
    assert near[0] < found.clearance.lower <= found.clearance.upper < near[1]
    assert spent < 0.5 * budget.WORK
