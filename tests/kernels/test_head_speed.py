"""What paces may do over steps, and that the fastest one is found: against linear programs."""

import numpy as np
import pytest
from scipy.optimize import linprog

from benchdragon import Arc, Dragon, Line, Route
from benchdragon.kernels import head_speed, motion_bounds
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate
from benchdragon.kernels.head_speed import HandleHull, HeadLimit
from benchdragon.model.placement import Placement
from tests.kernels import rooms

HANDLES = 4
STEPS = 12
LIMITS = {
    "along": [9.0, 9.0, 99.0, 99.0, 0.5, 2.0],
    "all": [1.3, 0.8, 0.6, 0.7, 0.5, 0.4],
    "total": [9.0, 9.0, 99.0, 0.6, 99.0, 9.0],
    "turning": [9.0, 0.4, 99.0, 99.0, 99.0, 0.3],
}


def random_hulls(seed: int) -> FloatArray:
    rng = np.random.default_rng(seed)
    hulls = np.empty((STEPS, HANDLES, head_speed.HANDLE_HULL_COLUMNS))
    hulls[..., HandleHull.FAST] = rng.uniform(0.6, 1.6, (STEPS, HANDLES))
    hulls[..., HandleHull.TURNING_RATE] = rng.uniform(0.0, 0.9, (STEPS, HANDLES))
    middle = rng.uniform(-1.0, 1.0, (STEPS, HANDLES))
    hulls[..., HandleHull.GROWTH_LOW] = middle - rng.uniform(0.0, 0.1, (STEPS, HANDLES))
    hulls[..., HandleHull.GROWTH_HIGH] = middle + rng.uniform(0.0, 0.1, (STEPS, HANDLES))
    hulls[..., HandleHull.BEND] = rng.uniform(0.0, 0.6, (STEPS, HANDLES))
    return hulls


def most_of(hull: FloatArray, limits: FloatArray, square: float, rate: float) -> float:
    """The greatest share of any limit that is used up with these bounds, by the formulas."""
    fast, bend = hull[:, HandleHull.FAST], hull[:, HandleHull.BEND]
    across = fast**2 * square * bend
    along = np.max(
        [
            np.abs(fast * (rate + hull[:, g] * square))
            for g in (HandleHull.GROWTH_LOW, HandleHull.GROWTH_HIGH)
        ],
        axis=0,
    )
    shares = [
        fast * np.sqrt(square) / limits[DriveRate.SPEEDS],
        hull[:, HandleHull.TURNING_RATE] * np.sqrt(square) / limits[DriveRate.TURNING],
        across / limits[DriveRate.ACROSS],
        np.hypot(along, across) / limits[DriveRate.TOTAL],
        along / limits[DriveRate.ALONG],
        np.abs(rate) / limits[HeadLimit.HEAD],
    ]
    return float(max(np.max(share) for share in shares))


def paced(hulls: FloatArray, limits: FloatArray, square: float, length: float) -> FloatArray:
    table, (starts, squares) = np.empty((STEPS, head_speed.SPEED_NODES, 2)), np.empty((2, STEPS + 1))
    most = np.array([head_speed.tabulate(hulls[n], limits, square, table[n]) for n in range(STEPS)])
    head_speed.fastest_pace(table, most, np.full(STEPS, length), starts, np.empty(STEPS), squares)
    at = np.linspace(0.0, length * STEPS, STEPS + 1)
    times, speeds = np.empty((2, STEPS + 1))
    count = head_speed.find_pace(table, most, at, times, speeds)
    if count < 0:
        assert squares[-1 - count] == 0.0 < squares[: -1 - count].min(initial=1.0)
        return squares
    times, speeds = times[:count], speeds[:count]
    walked = np.append(0.0, np.cumsum(0.5 * (speeds[1:] + speeds[:-1]) * np.diff(times)))
    assert walked[-1] == pytest.approx(at[-1])
    np.testing.assert_allclose(np.interp(at, walked, speeds**2), squares, rtol=1e-9)
    assert not ((speeds[1:-1] == speeds[2:]) & (speeds[1:-1] == speeds[:-2])).any()
    return squares


@pytest.mark.parametrize("name", LIMITS)
def test_accelerations_allowed_keep_the_limits_and_greater_ones_do_not(name: str) -> None:
    limits = np.array(LIMITS[name])
    hull = random_hulls(5)[0]
    for square in (0.0, 0.1, 0.3, 0.5):
        low, high = head_speed.allowed(hull, limits, square)
        if low > high:
            shares = [most_of(hull, limits, square, rate) for rate in np.linspace(-3.0, 3.0, 301)]
            assert min(shares) > 1.0
            continue
        for rate, beyond in ((low, -1e-6), (high, 1e-6)):
            assert most_of(hull, limits, square, rate) <= 1.0 + 1e-12
            assert most_of(hull, limits, square, rate + beyond) > 1.0


@pytest.mark.parametrize("name", LIMITS)
@pytest.mark.parametrize("seed", range(2))
def test_a_pace_keeps_every_limit_at_both_ends_of_every_step(seed: int, name: str) -> None:
    limits, hulls, length = np.array(LIMITS[name]), random_hulls(seed), 0.3
    squares = paced(hulls, limits, 2.25, length)
    assert (squares > 0.0).all()
    for n in range(STEPS):
        rate = 0.5 * (squares[n + 1] - squares[n]) / length
        for square in squares[n : n + 2]:
            assert most_of(hulls[n], limits, square, rate) <= 1.0 + 1e-9


@pytest.mark.parametrize("seed", range(3))
def test_the_fastest_pace_is_what_a_linear_program_finds(seed: int) -> None:
    limits, hulls, length, square = np.array(LIMITS["along"]), random_hulls(seed), 0.3, 2.25
    rows, most = [], []
    for n in range(STEPS):
        for fast, _sway, fade, grow, _bend in hulls[n]:
            for end in (n, n + 1):
                for sign, g in ((1.0, grow), (-1.0, fade)):
                    row = np.zeros(STEPS + 1)
                    row[n + 1], row[n] = 0.5 / length, -0.5 / length
                    row[end] += g
                    rows.append(sign * row)
                    most.append(limits[DriveRate.ALONG] / fast)
    found = linprog(-np.ones(STEPS + 1), np.array(rows), np.array(most), bounds=(0.0, square))
    assert found.success
    assert found.x is not None
    squares = paced(hulls, limits, square, length)
    assert squares.sum() == pytest.approx(found.x.sum(), rel=2e-3)


def test_a_hull_holds_all_that_happens_in_its_steps() -> None:
    dragon = Dragon.of_sizes(np.array([1.8, 1.1, 1.4]), 0.2, 0.0, 0.0)
    route = Route.joined([Line(8.0), Arc(1.6, 1.0), Line(0.5), Arc(2.0, -1.5), Line(9.0)])
    at = np.linspace(7.0, 16.0, 121)
    places = empty_placements(len(dragon) + 1, 5)
    hulls = np.empty((30, len(dragon) + 1, head_speed.HANDLE_HULL_COLUMNS))
    even, scratch = np.array([1.0, 1.0, 0.0]), rooms.scratch_for(len(dragon) + 1)
    for n, hull in enumerate(hulls):
        ends = at[4 * n : 4 * n + 5].copy()
        assert motion_bounds.place_chain(route.rows, dragon.links, ends, 0, 5, places)
        head_speed.find_hull(route.rows, dragon.links, places, 4, even, scratch, hull)
    one = Placement(dragon, route, np.linspace(7.0, 16.0, 3000, endpoint=False))
    found = hulls[np.arange(3000) // 100]
    growth = one.ratio_rate / one.speed_ratio
    assert (one.speed_ratio <= found[..., HandleHull.FAST]).all()
    assert (np.abs(one.turning_ratio) <= found[:, 1:, HandleHull.TURNING_RATE]).all()
    assert (np.abs(route.curvature(one.s)) <= found[..., HandleHull.BEND] + 1e-12).all()
    assert (found[..., HandleHull.GROWTH_LOW] <= growth + 1e-12).all()
    assert (growth <= found[..., HandleHull.GROWTH_HIGH] + 1e-12).all()
    assert hulls[..., HandleHull.GROWTH_HIGH].max() < growth.max() + 0.3
    assert hulls[..., HandleHull.GROWTH_LOW].min() > growth.min() - 0.3


def test_no_pace_goes_where_no_speed_is_allowed() -> None:
    hulls = random_hulls(1)
    hulls[6, 2, HandleHull.FAST] = np.inf
    hulls[6, 2, HandleHull.GROWTH_LOW], hulls[6, 2, HandleHull.GROWTH_HIGH] = -np.inf, np.inf
    with np.errstate(invalid="ignore"):
        squares = paced(hulls, np.array(LIMITS["all"]), 1.0, 0.3)
    assert squares[6] == squares[7] == 0.0
