"""The paper's equations, as printed and as they should be."""

import pytest

from benchdragon.errors import InputError
from benchdragon.model.turns import TwoArcTurn
from benchdragon.paper.claims import ANGLES, equations
from benchdragon.plans.schema import read_plan


def test_four_equations_hold_and_two_are_misprinted() -> None:
    found = {equation.number: equation for equation in equations(read_plan("turn"))}
    for number in (1, 2, 6):
        assert found[number].printed == pytest.approx(found[number].true, rel=1e-13)
    assert found[3].printed == pytest.approx(found[3].true, rel=1e-7)  # against a difference of angles
    assert found[4].true == pytest.approx(5.0 * found[4].printed, rel=1e-12)
    assert abs(found[5].printed - found[5].true) > 1.0


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
