"""Many times abreast along one spiral, against mpmath and against the search of any route."""

import math

import mpmath as mp
import numpy as np
import numpy.typing as npt
import pytest

from benchdragon.kernels.angles import MOST_ANGLE
from benchdragon.kernels.curve import RouteRow, place
from benchdragon.kernels.route import next_handle
from benchdragon.kernels.spiral import (
    LANE_NUMBERS,
    LANES,
    LEAST_ANGLE,
    MOST_LINK_INWARD,
    MOST_LINK_OUTWARD,
    Lane,
    angles_after,
    halley_pass,
    spiral_links,
    takes_link,
)
from benchdragon.kernels.status import Status
from benchdragon.model.curves import Line, Spiral

Float = npt.NDArray[np.float64]

SPIRALS = {
    "in": Spiral(1.7, 400.0, 5.0),
    "out": Spiral(1.7, 4.0, 400.0),
    "in, mirrored": Spiral(0.55, 400.0, 5.0, (3.0, -1.0), 0.7, mirrored=True),
    "out, mirrored": Spiral(0.55, 4.0, 400.0, (-3.0, 1.0), -2.0, mirrored=True),
}
each_spiral = pytest.mark.parametrize("spiral", SPIRALS.values(), ids=list(SPIRALS))


def longest_link(spiral: Spiral, angle: float) -> float:
    """The longest link that the lanes take at a front angle, m."""
    inward = spiral.end_angle < spiral.start_angle
    return (MOST_LINK_INWARD if inward else MOST_LINK_OUTWARD) * spiral.k * angle


def fronts_of(spiral: Spiral, count: int) -> Float:
    """Front angles over the spiral, room for a long link left behind each."""
    inward = spiral.end_angle < spiral.start_angle
    return np.linspace(LEAST_ANGLE, 240.0, count) if inward else np.linspace(12.0, 400.0, count)


def marched(
    spiral: Spiral, fronts: Float, link: float, guess: Float | None = None
) -> tuple[bool, Float, Float, Float, Float, Float]:
    """One link abreast: whether it settled, then state, u, x, y and ratio of the rear handles."""
    rows, count = spiral.rows, len(fronts)
    state = np.zeros(LANE_NUMBERS)
    state[Lane.GUESS : Lane.GUESS + count] = (
        link / (rows[0, RouteRow.P] * fronts) if guess is None else guess
    )
    u, x, y, ratio = (np.full((2, count), np.nan) for _ in range(4))
    u[0], ratio[0] = fronts, 1.0
    settled = spiral_links(rows, 0, link, 1.0, 0, 0, count, state, u, x, y, ratio)
    return settled, state, u[1], x[1], y[1], ratio[1]


@each_spiral
@pytest.mark.parametrize("share", [1e-3, 0.1, 0.5, 1.0])
def test_a_link_abreast_lands_where_the_search_of_any_route_does(spiral: Spiral, share: float) -> None:
    fronts = fronts_of(spiral, LANES)
    link = share * longest_link(spiral, float(fronts.min()))
    assert takes_link(spiral.rows, 0, float(fronts.min()), float(fronts.max()), link)
    settled, _state, u, x, y, ratio = marched(spiral, fronts, link)
    assert settled
    for i, front in enumerate(fronts):
        px, py, ptx, pty = place(spiral.rows, 0, front)
        row, v, status = next_handle(spiral.rows, 0, front, px, py, link)
        assert (row, status) == (0, Status.OK)
        assert u[i] == pytest.approx(v, rel=0.0, abs=2e-13)
        qx, qy, qtx, qty = place(spiral.rows, 0, v)
        assert math.hypot(x[i] - qx, y[i] - qy) <= 1e-11
        # Rigid benches: the speeds along the bench agree.
        dx, dy = px - qx, py - qy
        gear = (dx * ptx + dy * pty) / (dx * qtx + dy * qty)
        assert ratio[i] == pytest.approx(gear, rel=2e-12)


@each_spiral
def test_a_link_abreast_is_exact_to_rounding_with_both_doubles(spiral: Spiral) -> None:
    fronts = fronts_of(spiral, 9)
    link = 0.8 * longest_link(spiral, float(fronts.min()))
    settled, state, u, x, y, _ratio = marched(spiral, fronts, link)
    assert settled
    centre, hand = complex(*spiral.centre), -1 if spiral.mirrored else 1
    with mp.workdps(40):
        for i, front in enumerate(fronts):
            a, b = mp.mpf(front), mp.mpf(u[i]) + mp.mpf(state[Lane.REST + i])
            chord = spiral.rows[0, RouteRow.P] * abs(a - b * mp.expj(b - a))
            assert abs(chord - link) <= 8e-16 * link
            point = spiral.rows[0, RouteRow.P] * b * mp.expj(spiral.rotation + hand * b) + centre
            assert abs(point - complex(x[i], y[i])) <= 8e-16 * (abs(point) + abs(centre))


@each_spiral
def test_a_bad_guess_settles_on_the_same_place(spiral: Spiral) -> None:
    fronts = fronts_of(spiral, 20)
    link = 0.7 * longest_link(spiral, float(fronts.min()))
    _, _, u, _, _, ratio = marched(spiral, fronts, link)
    h = np.abs(u - fronts)
    for factor in (0.3, 0.7, 1.3):
        settled, _, again, _, _, again_ratio = marched(spiral, fronts, link, factor * h)
        assert settled
        np.testing.assert_allclose(again, u, rtol=0.0, atol=2e-13)
        np.testing.assert_allclose(again_ratio, ratio, rtol=1e-13)


@each_spiral
def test_the_bounds_after_a_link_hold_all_rear_angles(spiral: Spiral) -> None:
    fronts = fronts_of(spiral, LANES)
    for share in (0.01, 0.5, 1.0):
        link = share * longest_link(spiral, float(fronts.min()))
        _, _, u, _, _, _ = marched(spiral, fronts, link)
        least, most = angles_after(spiral.rows, 0, float(fronts.min()), float(fronts.max()), link)
        assert least <= u.min()
        assert u.max() <= most


@each_spiral
def test_the_rest_keeps_what_an_angle_loses_to_rounding(spiral: Spiral) -> None:
    # Forty links in 40 digits, and abreast: without the rests the error would grow with each.
    link, rows = 1.1, spiral.rows
    front = 300.0 if spiral.end_angle > spiral.start_angle else 60.0
    u, x, y, ratio = (np.full((41, 1), np.nan) for _ in range(4))
    u[0], ratio[0] = front, 1.0
    state = np.zeros(LANE_NUMBERS)
    state[Lane.GUESS] = link / (rows[0, RouteRow.P] * front)
    for i in range(40):
        assert spiral_links(rows, 0, link, 1.0, i, 0, 1, state, u, x, y, ratio)
    with mp.workdps(40):
        k, sigma = mp.mpf(rows[0, RouteRow.P]), 1 if u[1, 0] > front else -1
        a = mp.mpf(front)
        for _ in range(40):
            start = a + sigma * mp.mpf(link) / (k * a)
            a = mp.findroot(lambda b, a=a: abs(a - b * mp.expj(b - a)) - mp.mpf(link) / k, start)
        assert abs(a - mp.mpf(u[40, 0]) - mp.mpf(state[Lane.REST])) <= 4e-15


def test_a_pass_counts_the_lanes_that_still_took_a_large_step() -> None:
    spiral = SPIRALS["in"]
    fronts = np.full(6, 30.0)
    link = 1.65
    _, _, u, _, _, _ = marched(spiral, fronts, link)
    state = np.zeros(LANE_NUMBERS)
    state[Lane.GUESS : Lane.GUESS + 6] = (u - fronts) * np.array([1.0, 1.0, 0.5, 1.0, 2.0, 1.0])
    tables = [np.full((2, 6), np.nan) for _ in range(4)]
    tables[0][0], tables[3][0] = fronts, 1.0
    assert halley_pass(spiral.rows, 0, link, 1.0, 0, 0, 6, state, *tables) == 2


def test_a_link_that_no_place_on_the_spiral_can_hold_does_not_settle() -> None:
    # Outward from the centre nothing behind the front lies so far away.
    spiral = Spiral(1.0, 4.0, 30.0)
    fronts = np.array([10.0])
    link = 2.5 * spiral.k * 10.0
    assert not takes_link(spiral.rows, 0, 10.0, 10.0, link)
    settled, *_ = marched(spiral, fronts, link, np.array([0.5]))
    assert not settled


@each_spiral
def test_the_lanes_refuse_what_they_cannot_promise(spiral: Spiral) -> None:
    rows = spiral.rows
    link = 0.5
    assert takes_link(rows, 0, 20.0, 100.0, link)
    assert not takes_link(rows, 0, 0.9 * LEAST_ANGLE, 100.0, link)
    assert not takes_link(rows, 0, 20.0, 2.0 * MOST_ANGLE, link)
    assert not takes_link(rows, 0, 20.0, 100.0, 1.01 * longest_link(spiral, 20.0))
    assert not takes_link(Line(9.0).rows, 0, 20.0, 100.0, link)


def test_the_lanes_leave_a_spiral_before_its_end() -> None:
    # A spiral that is not the first curve is not extended: U_BACK is where it starts.
    inward = Spiral(1.7, 40.0, 5.0).rows.copy()
    inward[0, 6] = 40.0
    assert takes_link(inward, 0, 20.0, 39.0, 1.65)
    assert not takes_link(inward, 0, 20.0, 39.9, 1.65)
    outward = Spiral(1.7, 10.0, 40.0).rows
    assert takes_link(outward, 0, 11.0, 39.0, 1.65)
    assert not takes_link(outward, 0, 10.1, 39.0, 1.65)
