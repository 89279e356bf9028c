"""Quick answers: their wide brackets hold the exact answers."""

import math

import pytest

from benchdragon import WalkError, first_contact
from benchdragon.analysis.check import QUICK_CLEARANCE, QUICK_SPEED, Report, check
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.size import QUICK_SIZE, limit

DISC = "disc.radius=4.5"
PLANS = {
    "safe": ["spiral-in", DISC],
    "near": ["spiral-in", DISC, "route.pitch=0.451"],
    "touching": ["spiral-in", DISC, "route.pitch=0.449"],
    "to the centre": ["spiral-in"],
    "tight at first": ["spiral-in", DISC, "route.pitch=0.33"],
    "margin kept": ["spiral-in", DISC, "limits.margin=0.09"],
    "margin just kept": ["spiral-in", DISC, "limits.margin=0.0994475"],
    "margin missed": ["spiral-in", DISC, "limits.margin=0.1"],
    "turn": ["turn"],
    "fast turn": ["turn", "walk.speed=1.3"],
    "turn with a line": ["turn", "turn.family=arc-line-arc"],
    "three arcs": ["turn", "turn.family=arc-arc-arc", "turn.curvature=0.1"],
    "eased turn": ["turn", "turn.ease=0.3"],
    "alike": ["turn", "dragon.head_length=2.2", "dragon.benches=30"],
    "two benches": ["spiral-in", DISC, "dragon.benches=2"],
    "changing": ["spiral-in", DISC, "walk.profile=[[0, 1.0], [100, 1.5], [300, 0.5]]"],
}


def quick_check(plan: Plan) -> Report:
    return check(plan, quick=True)


def plan_of(name: str) -> Plan:
    source, *settings = PLANS[name]
    return read_plan(source, settings)


@pytest.mark.parametrize("name", PLANS)
def test_quick_brackets_hold_the_exact_answers(name: str) -> None:
    plan = plan_of(name)
    quick, exact = quick_check(plan), check(plan)
    assert quick.safe == exact.safe
    assert [finding.kind for finding in quick.findings] == [finding.kind for finding in exact.findings]
    assert (quick.start, quick.end) == (exact.start, exact.end)
    assert (quick.first_contact is None) == (exact.first_contact is None)
    if quick.first_contact is not None and exact.first_contact is not None:
        assert quick.first_contact.value == exact.first_contact.value
        assert quick.first_contact.upper == exact.first_contact.upper
    for wide, narrow in (
        (quick.clearance, exact.clearance),
        (quick.greatest_speed, exact.greatest_speed),
    ):
        assert wide.lower <= wide.value <= wide.upper
        assert max(wide.lower, narrow.lower) <= min(wide.upper, narrow.upper)
        assert (wide.unit, wide.status) == (narrow.unit, narrow.status)
    if math.isfinite(quick.clearance.value):
        assert quick.clearance.upper - quick.clearance.lower <= 1.001 * QUICK_CLEARANCE
    assert quick.greatest_speed.upper <= (1.0 + 1.001 * QUICK_SPEED) * quick.greatest_speed.lower


def test_a_limit_within_a_wide_bracket_is_asked_again() -> None:
    most = check(read_plan("turn")).greatest_speed.value
    for share, safe in ((1.0 + 1e-8, True), (1.0 - 1e-8, False)):
        found = quick_check(read_plan("turn", [f"limits.speed={most * share!r}"]))
        assert found.safe == safe
        assert found.decided


def test_a_walk_that_falls_raises_as_ever() -> None:
    plan = read_plan("spiral-in", ["dragon.width=0.01", "dragon.benches=20", "disc.radius=0.3"])
    walk = plan.build()
    for ask in (lambda: quick_check(plan), lambda: first_contact(walk, *plan.span(walk))):
        with pytest.raises(WalkError):
            ask()


@pytest.mark.parametrize(
    "settings",
    [[], ["route.pitch=0.44"], ["route.pitch=0.3"], ["dragon.width=0.4"], ["limits.margin=0.05"]],
)
def test_quick_pitches_hold_the_exact_ones(settings: list[str]) -> None:
    plan = read_plan("spiral-in", [DISC, *settings])
    quick, exact = limit(plan, "pitch", tolerance=QUICK_SIZE), limit(plan, "pitch")
    assert quick.status == exact.status == "found"
    assert quick.lower <= exact.lower < exact.upper <= quick.upper
    assert 0.1 * QUICK_SIZE < quick.upper - quick.lower <= QUICK_SIZE
    assert quick.value == pytest.approx(exact.value, abs=QUICK_SIZE)
    assert quick.witness is not None
    assert exact.witness is not None
    assert quick.witness.benches == exact.witness.benches


@pytest.mark.parametrize("name", ["disc", "width", "length"])
def test_other_sizes_have_quick_limits(name: str) -> None:
    plan = read_plan("spiral-in", [DISC, "dragon.benches=100"])
    quick, exact = limit(plan, name, tolerance=QUICK_SIZE), limit(plan, name)
    assert quick.lower <= exact.value <= quick.upper
    assert quick.upper - quick.lower <= QUICK_SIZE


def test_the_longest_dragon_reported_is_judged_as_well() -> None:
    """3,500 benches turn as 223 do: the pair that comes nearest is the same."""
    few, many = (quick_check(read_plan("turn", [f"dragon.benches={n}"])) for n in (223, 3_500))
    assert many.safe
    assert many.clearance.lower <= few.clearance.upper
    assert few.clearance.lower <= many.clearance.upper
    assert many.clearance.witness is not None
    assert many.clearance.witness.benches == (1, 17)
