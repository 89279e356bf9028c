"""The bound on random dances against brute force: what it leaves out never comes near."""

import numpy as np
import pytest

from benchdragon.kernels.box import BOX_COLUMNS, boxes_at, pair_distances
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.perturbed import place_along
from benchdragon.plans.schema import read_plan
from benchdragon.solve.random_dance import RandomDance
from benchdragon.solve.tolerance import CASES, Deviations, Draw, random_dance

SPIRALS = {
    "contest": ["disc.radius=4.5", "dragon.benches=90", "walk.start=150"],
    "to the left": ["disc.radius=5", "dragon.benches=70", "route.clockwise=false", "walk.start=120"],
    "short benches": ["disc.radius=5", "dragon.benches=80", "dragon.head_length=2.2",
                      "dragon.body_length=1.5", "dragon.width=0.35", "walk.start=150"],
    "wide": ["disc.radius=6", "dragon.benches=60", "dragon.width=0.6", "walk.start=60"],
    "long ends": ["disc.radius=5", "dragon.benches=60", "dragon.front_inset=0.6",
                  "dragon.rear_inset=0.6", "dragon.body_length=3", "walk.start=100"],
}  # fmt: skip
PITCHES = {"contest": 0.52, "to the left": 0.53, "short benches": 0.56, "wide": 0.83, "long ends": 0.68}
PLENTY = Deviations(0.025, 0.025, 0.01, 0.05, 0.02, 0.01)


def distances(dance: RandomDance, at: float, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Distances of pairs of benches with the head at a place, m; minus the depth of an overlap."""
    count = len(dance.dragon)
    places = empty_placements(count + 1, 1)
    assert place_along(dance.rows, dance.dragon.links, dance.aside, np.array([at]), places) == 1
    boxes = np.empty((count, BOX_COLUMNS))
    boxes_at(dance.dragon.sizes, places.x, places.y, 0, boxes)
    gap, distance = np.empty((2, first.size))
    pair_distances(boxes, first, second, gap, distance)
    return distance


@pytest.mark.parametrize("case", ["aside", "stray", "benches", "plenty"])
@pytest.mark.parametrize("name", SPIRALS)
def test_no_bench_left_out_comes_near(name: str, case: str) -> None:
    deviations = PLENTY if case == "plenty" else CASES[case].deviations
    left_out, near = 0, np.inf
    for number in range(3):
        pitch = PITCHES[name] + (0.05 if case == "plenty" else 0.0) + 0.02 * number
        plan = read_plan("spiral-in", [*SPIRALS[name], f"route.pitch={pitch}"])
        dance = random_dance(plan, Draw(deviations, 3, number))
        assert dance.open is not None
        first, second = np.triu_indices(len(dance.dragon), 2)
        for wanted in (1e-6, 0.05):
            parts = dance.open(wanted)
            for s in np.linspace(dance.start, dance.end, 60).tolist():
                count = max((part.count for part in parts if part.start <= s <= part.end), default=0)
                out = second >= count
                if out.any():
                    least = distances(dance, s, first[out], second[out]).min()
                    assert least > wanted, (number, wanted, s)
                    near = min(near, least - wanted)
                left_out += int(out.sum())
    assert left_out > 10_000
    assert near < 0.15  # else the test would see no fault of the bound
