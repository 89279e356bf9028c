"""What errors of places come to, down the chain and in distances: no more than a proof allows for."""

import itertools
import math

import mpmath
import numpy as np
import pytest

from benchdragon import Arc, Dragon, Line, Route, Spiral, Walk
from benchdragon.analysis.proof import Checker, Errors, needed_slack
from benchdragon.kernels import curve as kernel
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, set_box
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.step_bounds import reach
from benchdragon.plans.schema import read_plan
from tests.analysis.chains import chain_at


def test_an_error_of_the_head_goes_down_the_chain_as_fast_as_handles_do() -> None:
    walk = read_plan("turn", ["dragon.benches=20"]).build()
    s = walk.start + 14.48
    ratios = Walk(walk.dragon, walk.route).motion([s]).speed_ratio[0]
    assert ratios.max() > 1.5
    _beside, along = Checker(walk.route.rows, 3.0).chain_error(*chain_at(walk, s), 1e-9)
    assert along == pytest.approx(1e-9 * ratios.max(), rel=1e-3)


def test_jumps_at_smooth_joints_count_at_every_handle() -> None:
    gap, turn, step = 3e-10, 5e-12, 2.0
    route = Route((Line(12.0), Line(9.0).moved((12.0, gap), turn)))
    checker = Checker(route.rows, step)
    assert checker.jumps == pytest.approx(gap + step * turn, rel=1e-3)
    walk = Walk(Dragon.uniform(5), route)
    beside, along = checker.chain_error(*chain_at(walk, 20.0), 0.0)
    assert beside == pytest.approx(along) == pytest.approx(6.0 * checker.jumps, rel=1e-3)


KINKED: dict[str, tuple[Line | Spiral, ...]] = {
    "from a line": (Line(12.0), Line(9.0).moved((12.0, 0.0), 0.4)),
    "after a smooth joint": (
        Line(5.0),
        Line(7.0).moved((5.0, 0.0), 0.0),
        Line(9.0).moved((12.0, 0.0), 0.4),
    ),
    "from a spiral": (
        Spiral(0.55, 30.0, 20.0),
        Line(9.0).moved(Spiral(0.55, 30.0, 20.0).end_pose[0], 0.0),
    ),
}


@pytest.mark.parametrize("name", KINKED)
def test_who_may_stand_beyond_a_kink_cannot_be_told(name: str) -> None:
    route = Route(KINKED[name], kinks=True)
    checker, walk = Checker(route.rows, 1.0), Walk(Dragon.uniform(3, 2.2), route)
    kink = float(route.joints[-2])
    assert checker.jumps < 1e-14
    places = ((-1e-12, 1e-13, True), (-1e-12, 1e-8, False), (0.0, 0.0, False), (1e-9, 1e-8, False))
    for ahead, off, known in (*places, (1.0, 1e-8, True)):
        error = checker.chain_error(*chain_at(walk, kink + ahead), off)
        assert all(map(math.isfinite, error)) == known
    # The same with the handle of a follower at the kink.
    behind = walk.head_where_tail(kink)
    assert checker.chain_error(*chain_at(walk, behind), 2e-9) == (math.inf, math.inf)
    assert math.isfinite(checker.chain_error(*chain_at(walk, behind + 1e-3), 2e-9)[0])


def test_a_bench_square_to_the_route_cannot_be_told() -> None:
    route = Route((Arc(1.0, 3.5),))
    checker, u = Checker(route.rows, 1.0), np.array([math.pi, 0.0])
    x, y = np.transpose([kernel.place(route.rows, 0, at)[:2] for at in u.tolist()])
    for link, v in ((math.hypot(x[0] - x[1], y[0] - y[1]), 0.0), (2.0 * math.sin(1.5), math.pi - 3.0)):
        u[1] = v
        x[1], y[1] = kernel.place(route.rows, 0, v)[:2]
        error = checker.chain_error(np.array([link]), np.zeros(2, dtype=np.int64), u, x, y, 0.0)
        assert all(map(math.isfinite, error)) == (v > 0.0)


@pytest.mark.parametrize(
    ("route", "link", "most"),
    [
        (Route((Line(9.0),)), 2.0, 1e-6),
        (Route((Line(9.0),)), 0.1, 5e-8),
        (Route((Arc(0.05, 3.0),)), 0.09, 1e-6 / (20.0 + 2.0 / 0.09)),
    ],
)
def test_errors_that_turn_a_bench_too_far_cannot_be_told(
    route: Route, link: float, most: float
) -> None:
    walk = Walk(Dragon.of_sizes([link], 0.1, 0.0, 0.0), route)
    chain = chain_at(walk, 0.99 * route.length)
    checker = Checker(route.rows, 1.0)
    assert checker.chain_error(*chain, 1.2 * most) == (math.inf, math.inf)
    assert max(checker.chain_error(*chain, 0.8 * most)) < most


def test_distances_move_by_no_more_than_errors_of_places_allow() -> None:
    """Two wide benches with long ends, their handles moved in all directions, and along the route."""
    sizes = np.array([[2.0, 1.0, 0.5, 0.3]] * 3).T
    walk = Walk(Dragon.of_sizes(*sizes), Route((Line(9.0),)))
    assert walk.dragon.lever > 2.0
    off, least, most = 1e-6, math.inf, -math.inf
    for moves in itertools.product((-off, off), repeat=4):
        x = np.array([[0.0], [-1.2]]), np.array([[0.98], [2.18]])
        y = np.array([[moves[0]], [moves[1]]]), np.array([[3.0 + moves[2]], [3.0 + moves[3]]])
        table = np.empty((2, BOX_COLUMNS))
        for n in range(2):
            set_box(sizes[:, n : n + 1], 0, x[n], y[n], 0, table, n)
        least, most = min(least, box_distance(table, 0, 1)), max(most, box_distance(table, 0, 1))
    found = Errors(off, 0.0, 0.0, 1)
    moved = max(2.0 - least, most - 2.0)
    assert 0.6 * needed_slack(walk, found, 0.0) < moved <= needed_slack(walk, found, 0.0)
    spent = [reach(1.0 + n * off, 2.0 + n * off, sizes, 0) for n in (0, 2)]
    travel = 0.5 * 2.0 * (spent[1] - spent[0])
    found = Errors(0.0, off, 0.0, 1)
    assert travel <= needed_slack(walk, found, 0.0) < 1.3 * travel


def test_distances_in_doubles_are_within_the_roundings_that_are_allowed() -> None:
    rng = np.random.default_rng(7)
    sizes = np.array([[3.41, 0.3, 0.275, 0.275], [2.2, 0.3, 0.275, 0.275]]).T
    walk = Walk(Dragon.of_sizes(*sizes), Route((Line(9.0),)))
    worst, extent = 0.0, 60.0
    for _trial in range(300):
        middle, angle = rng.uniform(-40.0, 40.0, 2), rng.uniform(0.0, 6.3, 2)
        x, y = (middle[n] + np.zeros((2, 2)) for n in range(2))
        for n, link in enumerate(walk.dragon.links):
            x[:, n] += 1.5 * n + np.array([0.0, link * math.cos(angle[n])])
            y[:, n] += np.array([0.0, link * math.sin(angle[n])])
        table = np.empty((2, BOX_COLUMNS))
        for n in range(2):
            set_box(sizes[:, n : n + 1], 0, x[:, n : n + 1], y[:, n : n + 1], 0, table, n)
        distance = box_distance(table, 0, 1)
        if distance > 0.0:
            worst = max(worst, abs(float(_mpmath_distance(sizes, x, y) - mpmath.mpf(distance))))
    allowed = needed_slack(walk, Errors(0.0, 0.0, 0.0, 1), extent)
    assert 0.02 * allowed < worst <= allowed


def _mpmath_distance(sizes: FloatArray, x: FloatArray, y: FloatArray) -> mpmath.mpf:
    """The distance of two benches that do not overlap, with handles at x[:, n], y[:, n]."""
    mpf = mpmath.mpf
    with mpmath.workdps(40):
        boxes = []
        for n in range(2):
            length, width, front, rear = (mpf(float(size)) for size in sizes[:, n])
            head = mpmath.mpc(float(x[0, n]), float(y[0, n]))
            unit = (head - mpmath.mpc(float(x[1, n]), float(y[1, n]))) / (length - front - rear)
            boxes.append((head + (front - length / 2) * unit, unit, length / 2, width / 2))
        nearest = mpmath.inf
        for (centre, unit, a, b), (other, way, p, q) in itertools.permutations(boxes):
            for i, j in itertools.product((-1, 1), repeat=2):
                away = (centre + (i * a + mpmath.mpc(0, j) * b) * unit - other) / way
                # `way` is a unit vector to rounding only, in doubles as here.
                away *= abs(way) ** 2
                beyond = max(abs(away.real) - p, mpf(0)), max(abs(away.imag) - q, mpf(0))
                nearest = min(nearest, mpmath.hypot(*beyond))
        return nearest
