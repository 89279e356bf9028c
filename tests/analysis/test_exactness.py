"""Limits and sizes that lie within a bracket, and sizes to fewer digits, which hold the exact ones."""

import pytest

from benchdragon import WalkError, first_contact
from benchdragon.analysis.check import check
from benchdragon.plans.schema import read_plan
from benchdragon.solve.size import QUICK_SIZE, limit

DISC = "disc.radius=4.5"


def test_a_limit_within_a_wide_bracket_is_asked_again() -> None:
    most = check(read_plan("turn")).greatest_speed.value
    for share, safe in ((1.0 + 1e-8, True), (1.0 - 1e-8, False)):
        found = check(read_plan("turn", [f"limits.speed={most * share!r}"]))
        assert found.safe == safe
        assert found.decided


def test_a_walk_that_falls_raises_as_ever() -> None:
    plan = read_plan("spiral-in", ["dragon.width=0.01", "dragon.benches=20", "disc.radius=0.3"])
    walk = plan.build()
    for ask in (lambda: check(plan), lambda: first_contact(walk, *plan.span(walk))):
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
    few, many = (check(read_plan("turn", [f"dragon.benches={n}"])) for n in (223, 3_500))
    assert many.safe
    assert many.clearance.lower <= few.clearance.upper
    assert few.clearance.lower <= many.clearance.upper
    assert many.clearance.witness is not None
    assert many.clearance.witness.benches == (1, 17)
