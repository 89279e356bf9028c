"""The bound on random dances against brute force: what it leaves out never comes near."""

import numpy as np
import pytest

from benchdragon.kernels.box import BOX_COLUMNS, boxes_at, pair_distances
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.random_dance_bound import bounds
from benchdragon.kernels.stray_chain import place_along
from benchdragon.model.curves import Line, Route, Spiral
from benchdragon.plans.schema import read_plan
from benchdragon.solve.tolerance import CASES, Deviations, Draw
from tests.solve.dances import Laid, laid, open_parts

SPIRALS = {
    "few": ["disc.radius=3.2", "dragon.benches=30", "walk.start=330"],
    "contest": ["disc.radius=4.5", "dragon.benches=90", "walk.start=150"],
    "to the left": ["disc.radius=5", "dragon.benches=70", "route.clockwise=false", "walk.start=120"],
    "short benches": ["disc.radius=5", "dragon.benches=80", "dragon.head_length=2.2",
                      "dragon.body_length=1.5", "dragon.width=0.35", "walk.start=150"],
    "wide": ["disc.radius=6", "dragon.benches=60", "dragon.width=0.6", "walk.start=60"],
    "long ends": ["disc.radius=5", "dragon.benches=60", "dragon.front_inset=0.6",
                  "dragon.rear_inset=0.6", "dragon.body_length=3", "walk.start=100"],
}  # fmt: skip
PITCHES = {
    "few": 0.6,
    "contest": 0.52,
    "to the left": 0.53,
    "short benches": 0.56,
    "wide": 0.83,
    "long ends": 0.68,
}
PLENTY = Deviations(0.025, 0.025, 0.01, 0.05, 0.02, 0.01)


def distances(dance: Laid, at: float, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Distances of pairs of benches with the head at a place, m; minus the depth of an overlap."""
    count = len(dance.dragon)
    places = empty_placements(count + 1, 1)
    assert place_along(dance.rows, dance.dragon.links, dance.aside, np.array([at]), places) == 1
    boxes = np.empty((count, BOX_COLUMNS))
    boxes_at(dance.dragon.sizes, places.x, places.y, 0, boxes)
    gap, distance = np.empty((2, first.size))
    pair_distances(boxes, first, second, gap, distance)
    return distance


@pytest.mark.plain
@pytest.mark.parametrize("case", ["aside", "stray", "benches", "plenty"])
@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name == "few" else pytest.mark.compiled) for name in SPIRALS],
)
def test_no_bench_left_out_comes_near(name: str, case: str) -> None:
    deviations = PLENTY if case == "plenty" else CASES[case].deviations
    left_out, near = 0, np.inf
    few = name == "few"  # for plain Python
    for number in range(1 if few else 3):
        pitch = PITCHES[name] + (0.05 if case == "plenty" else 0.0) + 0.02 * number
        plan, draw = (
            read_plan("spiral-in", [*SPIRALS[name], f"route.pitch={pitch}"]),
            Draw(deviations, 3, number),
        )
        dance, distances_wanted = laid(plan, draw), (1e-6, 0.05)
        first, second = np.triu_indices(len(dance.dragon), 2)
        for wanted, parts in zip(
            distances_wanted, open_parts(plan, draw, distances_wanted), strict=True
        ):
            for s in np.linspace(dance.start, dance.end, 10 if few else 60).tolist():
                inside = (parts[:, 0] <= s) & (s <= parts[:, 1])
                out = second >= parts[inside, 2].max(initial=0.0)
                if out.any():
                    least = distances(dance, s, first[out], second[out]).min()
                    assert least > wanted, (number, wanted, s)
                    near = min(near, least - wanted)
                left_out += int(out.sum())
    assert left_out > 1_000
    assert near < 0.15  # else the test would see no fault of the bound


def test_other_routes_and_shorter_dragons_have_no_bound() -> None:
    inward = Route((Spiral(0.5, 40.0, 20.0),))
    assert bounds(inward.rows, 3)
    assert not bounds(inward.rows, 2)
    assert not bounds(Route((Spiral(0.5, 20.0, 40.0),)).rows, 3)
    assert not bounds(Route((Line(9.0),)).rows, 3)


def test_a_bound_does_not_hold_where_handles_are_far_off() -> None:
    plan = read_plan("spiral-in", ["disc.radius=2", "dragon.benches=5", "walk.start=250"])
    with pytest.raises(AssertionError):
        open_parts(plan, Draw(Deviations(aside=0.9), 1, 0), (0.0,))
