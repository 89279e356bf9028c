"""What may come only after a walk has ended is not said of it: ends within rounding of a contact."""

import math
from pathlib import Path

import pytest

from benchdragon import contact_windows, first_contact, first_touch, read_plan
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk

END_TOUCH = Path(__file__).parents[1] / "cases" / "check" / "end_touch.dragon.toml"
# Ends this many of the last digits of a double beside a contact.
BESIDE = (*range(-60, 61, 3), -1000, 1000)


def ends(time: float) -> list[float]:
    return [time + n * math.ulp(time) for n in BESIDE]


def told(found: Answer | None, end: float) -> str:
    """What is said of a contact; its bracket keeps to the walk."""
    if found is None:
        return "none"
    assert found.lower <= found.value <= found.upper <= end
    return found.status


def test_benches_that_touch_as_a_walk_ends_touch_within_it_or_are_left_open() -> None:
    plan = read_plan("spiral-in", [])
    walk = plan.build()
    contact = first_contact(walk, 400.0, 420.0)
    assert contact is not None
    said = [told(first_contact(walk, 400.0, end), end) for end in ends(contact.value)]
    assert (said[BESIDE.index(-1000)], said[BESIDE.index(1000)]) == ("none", "found")
    for end in ends(contact.value):
        windows = contact_windows(walk, 400.0, end)
        assert len(windows) <= 1
        for window in windows:
            told(window.opens, end)
            assert window.closes is None or told(window.closes, end)


@pytest.fixture
def wall() -> tuple[Walk, Obstacle]:
    plan = read_plan(str(END_TOUCH), [])
    (thing,) = plan.obstacles()
    return plan.build(), thing


def test_a_wall_that_is_touched_as_a_walk_ends_is_touched_within_it_or_left_open(
    wall: tuple[Walk, Obstacle],
) -> None:
    said = {end: told(first_touch(*wall, 0.0, end), end) for end in ends(15.0)}
    assert said[15.0] == "undecided"
    assert said[15.0 - 1000 * math.ulp(15.0)] in ("none", "undecided")
    assert said[15.0 + 1000 * math.ulp(15.0)] == "found"
