"""The paper's equations, as printed and as they should be."""

import pytest

from benchdragon.errors import InputError
from benchdragon.model.turns import TwoArcTurn
from benchdragon.paper.claims import ANGLES, equations
from benchdragon.plans.schema import read_plan


def test_four_equations_hold_and_two_are_misprinted() -> None:
    tried = equations(read_plan("turn"))
    found = {equation.number: equation for equation in tried}
    for number in (1, 2, 6):
        assert found[number].printed == pytest.approx(found[number].true, rel=1e-13)
    assert found[3].printed == pytest.approx(found[3].true, rel=1e-7)  # against a difference of angles
    assert abs(found[5].printed - found[5].true) > 1.0


def test_the_angle_falls_along_the_first_arc_and_grows_along_the_second() -> None:
    """As the paper's own boundary angles have it, and its (4) for the first alone."""
    first, second = (one for one in equations(read_plan("turn")) if one.number == 4)
    radii = TwoArcTurn(1.7).radii
    assert first.true == pytest.approx(-5.0 / radii[0], rel=1e-12) == pytest.approx(-1.66366, abs=1e-5)
    assert second.true == pytest.approx(2.0 / radii[1], rel=1e-12) == pytest.approx(1.33093, abs=1e-5)
    assert (first.printed, second.printed) == (-1.0 / radii[0], -1.0 / radii[1])
    assert ANGLES["theta_max1"] > ANGLES["theta_min1"]
    assert ANGLES["theta_min2"] < ANGLES["theta_max2"]


def test_the_printed_angles_are_those_of_the_turn() -> None:
    angles = TwoArcTurn(1.7).boundary_angles()
    assert angles == pytest.approx(tuple(ANGLES.values()), abs=1e-4)


@pytest.mark.parametrize("ratio", [1.0, 1.5])
def test_other_turns_of_two_arcs_obey_the_same_equations(ratio: float) -> None:
    found = {
        equation.number: equation for equation in equations(read_plan("turn", [f"turn.ratio={ratio}"]))
    }
    for number in (1, 2, 6):
        assert found[number].printed == pytest.approx(found[number].true, rel=1e-12)


def test_other_plans_are_refused() -> None:
    for plan in (
        read_plan("spiral-in"),
        read_plan("turn", ["turn.family=arc-line-arc", "turn.radii=[2, 2]"]),
    ):
        with pytest.raises(InputError, match="two arcs"):
            equations(plan)
