"""Squares that are drawn before their dances are computed are open where pictures draw them open."""

import re
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.entrances import edge_left
from benchdragon.planner.first_look import first_look
from benchdragon.plans.schema import Plan, checked, read_plan
from tests.planner.twins import asked

YARD: dict[str, Any] = {
    "route": {"kind": "turn", "pitch": 2.0, "at": [4.0, 1.0]},
    "disc": {"radius": 6.0},
    "dragon": {"benches": 9},
    "venue": {"rectangle": [40, 30], "angle": 10.0, "centre": [1.0, 2.0]},
}
STREET = {"points": [[-60.0, 0.0], [-30.0, 2.0]], "width": 5.0}
HOUSE = [[-19.0, -15.0], [19.0, -15.0], [19.0, 15.0], [0.0, 15.0], [0.0, 18.0], [-19.0, 18.0]]
SQUARES: dict[str, dict[str, Any]] = {
    "an entrance": {"event": {"entrances": [[20.0, 5.0, 6.0], [3.0, 3.0, 2.0], [-12.0, 14.0]]}},
    "two entrances at a corner": {
        "venue": {"boundary": HOUSE}, "event": {"entrances": [[19.0, 14.0, 4.0], [17.0, 15.0, 3.0]]},
    },
    "a street": {"route": YARD["route"] | {"street": STREET}},
    "a street, no width said": {"route": YARD["route"] | {"street": {"points": STREET["points"]}}},
    "a whole edge": {},
}  # fmt: skip


def plan_of(name: str) -> tuple[Plan, dict[str, Any]]:
    """A plan, and what of it the page holds."""
    said = YARD | SQUARES[name]
    return checked(read_plan("turn").data() | said, "plan"), said


def ends_of(lines: Any) -> Any:
    """Where lines begin and end, m, in order."""
    return sorted([*line[0], *line[-1]] for line in lines)


@pytest.mark.parametrize("name", list(SQUARES))
def test_a_sketch_leaves_of_an_edge_what_pictures_do(name: str) -> None:
    plan, said = plan_of(name)
    (drawn,) = asked("sketches.mjs", [{"walk": {}} | said])
    (edge,) = plan.obstacles()
    wanted = edge_left(plan) or [[*edge.outline.tolist(), edge.outline.tolist()[0]]]
    first = 1 + drawn.index(next(line for line in drawn if len(line) == 73))  # the disc is before it
    found = drawn[first : first + len(wanted)]
    # The gate of a street is where that is about to lead: the way on is not computed yet.
    near = 1.5 if "street" in name else 1e-9
    np.testing.assert_allclose(ends_of(found), ends_of(wanted), atol=near)
    assert list(map(len, found)) == list(map(len, wanted))


@pytest.mark.parametrize("name", list(SQUARES))
def test_the_first_picture_leaves_of_an_edge_what_pictures_do(name: str) -> None:
    plan, _said = plan_of(name)
    look = first_look(plan)
    assert look is not None
    ((kind, path),) = look.standing
    assert kind == "venue"
    pieces = re.findall(r"M([^Mz]*)(z?)", path)
    left = edge_left(plan)
    assert [closed for _line, closed in pieces] == ([""] * len(left) if left else ["z"])
    length, told = look.bar
    scale = length / float(told.removesuffix(" m"))
    for line, (steps, _closed) in zip(left, pieces, strict=bool(left)):
        numbers = np.array(re.findall(r"-?\d+", steps), np.float64).reshape(-1, 2)[1:]
        np.testing.assert_allclose(
            numbers.sum(axis=0) / scale, np.subtract(line[-1], line[0]) * (1, -1), atol=0.1
        )
