"""Numbers of plans to the last digit: kept as written, or known to be rounded."""

import pytest

from benchdragon.plans.digits import Rounded, measured, number
from benchdragon.plans.schema import read_plan
from benchdragon.plans.units import METRES, quantity


@pytest.mark.parametrize("cm", range(1, 400))
def test_centimetres_are_as_exact_as_metres(cm: int) -> None:
    assert quantity(f"{cm} cm", METRES) == float(f"{cm}e-2")
    assert quantity(f"{cm}e1 mm", METRES) == float(f"{cm}e-2")
    assert quantity(f"{cm}.5 km", METRES) == cm * 1000 + 500


@pytest.mark.parametrize(
    ("text", "rounded"),
    [
        ("0.55", False),
        ("1_000.5", False),
        ("0.4503373930271955", False),
        ("0.1000000000000000000", False),
        ("0.45033739302719551", True),
        ("0.55000000000000000001", True),
        ("0.1000000000000000055511151231257827", True),
        ("1.0000000000e-9999999999999999999", True),
        ("0.000000000000000000", False),
        ("1234567890123456789.5", True),
    ],
)
def test_a_number_with_more_digits_than_its_double_is_known(text: str, rounded: bool) -> None:
    found = number(text)
    assert found == float(text)
    assert isinstance(found, Rounded) is rounded


@pytest.mark.parametrize(
    ("setting", "rounded"),
    [
        ("route.pitch=0.55", []),
        ("route.pitch='57 cm'", []),
        ("walk.start='3 min 12.5 s'", []),
        ("walk.speed='3.6 km/h'", []),
        ("walk.speed='5 km/h'", [("5 km/h", "1.3888888888888888")]),
        ("route.turned='1 rad'", [("1 rad", "57.29577951308232")]),
        ("route.pitch=0.5500000000000000001", [("0.5500000000000000001", "0.55")]),
        ("route.at=[0.0, 0.5500000000000000001]", [("0.5500000000000000001", "0.55")]),
        ("meta.title='5 km/h'", []),
        ("meta.title='1 m of rope'", []),
    ],
)
def test_a_plan_knows_which_of_its_numbers_are_rounded(
    setting: str, rounded: list[tuple[str, str]]
) -> None:
    assert list(read_plan("spiral-in", [setting]).source.rounded) == rounded


def test_a_unit_that_is_no_power_of_ten_is_multiplied() -> None:
    assert measured("-2.5", 60.0) == 150.0
    assert measured("5e-1", 60.0) == 30.0
