"""What cells of the route say of speeds holds at every place in a step."""

import math

import numpy as np
import pytest

from benchdragon import Arc, Bench, Dragon, Line, Route, Spiral, Walk
from benchdragon.kernels import speed_bounds, step_bounds
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray

CELL = 0.11
ROUTES = {
    "spiral": Route((Spiral(0.9, 40.0, 8.0),)),
    "joints": Route.joined([Line(12.0), Arc(1.6, 1.0), Arc(2.0, -1.5), Line(9.0)]),
}
DRAGON = Dragon([Bench(1.6, 0.4, 0.1, 0.2), *[Bench(1.1, 0.3, 0.1, 0.1)] * 5])


def ratios_in_cells(walk: Walk, low: int, count: int) -> tuple[FloatArray, IntArray]:
    """The greatest ratio of the benches of each link in each cell, and each bench's kind."""
    links, group = np.unique(walk.dragon.links, return_inverse=True)
    borders = CELL * np.arange(low, low + count + 1, dtype=np.float64)
    out = np.empty((len(links), count))
    for g in range(len(links)):
        link = walk.dragon.links[np.flatnonzero(group == g)[:1][0] :][:1]
        places = step_bounds.empty_placements(2, len(borders))
        step_bounds.place_chain(walk.route.rows, link, borders, 0, len(borders), places)
        speed_bounds.cell_ratios(walk.route.rows, link, places, out[g])
    return out, group.astype(np.int64)


@pytest.mark.parametrize("h", [0.6, 0.15])
@pytest.mark.parametrize("name", ROUTES)
def test_no_handle_is_faster_than_its_cells_say(name: str, h: float) -> None:
    walk = Walk(DRAGON, ROUTES[name])
    at = np.arange(10.0, 16.0, h)
    s = walk.motion(at).s.T
    low = math.floor(s.min() / CELL)
    ratios, group = ratios_in_cells(walk, low, math.floor(s.max() / CELL) + 1 - low)
    dense = walk.motion(np.linspace(at[:-1], at[1:], 9).ravel()).speed_ratio
    dense = dense.reshape(9, len(at) - 1, -1).max(axis=0)
    limit = float(np.median(dense.max(axis=1)))
    steps = np.empty((len(at) - 1, speed_bounds.STEP_COLUMNS))
    speed_bounds.bound_steps(s, group, ratios, CELL, low, np.full(len(steps), limit), steps)
    for step, seen in zip(steps, dense, strict=True):
        assert seen.max() <= step[speed_bounds.MOST] * step_bounds.ROUNDED_UP
        assert step[speed_bounds.MOST] <= seen.max() * (1.0 + h)
        open_ = int(step[speed_bounds.OPEN])
        assert seen[open_:].max(initial=0.0) <= step[speed_bounds.SETTLED] * step_bounds.ROUNDED_UP
        assert step[speed_bounds.SETTLED] <= max(limit, 1.0)
        assert (seen <= limit).all() or open_ > int(np.flatnonzero(seen > limit)[-1])


def test_the_head_itself_counts_and_who_cannot_stand_is_never_passed_over() -> None:
    walk = Walk(DRAGON, Route((Line(6.0),)))
    ratios, group = ratios_in_cells(walk, 0, 60)
    assert ratios[:, 20] == pytest.approx(1.0)
    assert np.isinf(ratios[:, -1]).all()
    s = np.array([[5.0, 5.1], [3.7, 3.8]])
    steps = np.empty((1, speed_bounds.STEP_COLUMNS))
    speed_bounds.bound_steps(s, group[:1], ratios, CELL, 0, np.array([0.5]), steps)
    assert steps[0, speed_bounds.OPEN] == 2
    speed_bounds.bound_steps(s + 1.5, group[:1], ratios, CELL, 0, np.array([2.0]), steps)
    assert steps[0, speed_bounds.OPEN] == 2
    assert math.isinf(steps[0, speed_bounds.MOST])
