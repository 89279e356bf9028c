"""What rounding may be off by: bounds on places, speed ratios and head positions hold in balls."""

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from benchdragon import Arc, Clothoid, Dragon, Line, LogSpiral, Route, Spiral, Walk, greatest_speed
from benchdragon.analysis.nearby import errors_at, seams_of
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.double_double import head_drift
from benchdragon.kernels.links import link_length
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.rounding import Seam, find_seams, mark_lanes, ratio_errors
from benchdragon.kernels.route import locate

pytest.importorskip("flint")
from flint import arb

from benchdragon.proofs.ball_route import BallRoute
from tests.exact_places import corner_errors, exact_chain, exact_ratios

TURN = 2.0 * math.pi
Draw = np.random.Generator


def spiral_in(rng: Draw) -> Route:
    centre = float(rng.uniform(-5.0, 5.0)), float(rng.uniform(-5.0, 5.0))
    pitch, start = float(rng.uniform(0.5, 1.8)), TURN * float(rng.uniform(5.0, 16.0))
    return Route((Spiral(pitch, start, TURN * 2.5, centre),))


def spiral_out(rng: Draw) -> Route:
    return Route.joined([Line(60.0), Spiral(float(rng.uniform(0.9, 1.8)), TURN * 1.5, TURN * 6.0)])


def bends(rng: Draw) -> Route:
    heading, radius = float(rng.uniform(0.0, 6.0)), float(rng.uniform(1.6, 8.0))
    return Route.joined(
        [Line(60.0, (-7.0, 3.0), heading), Arc(radius, 4.0), Arc(2.0 * radius, -3.0), Line(20.0)]
    )


def clothoids(rng: Draw) -> Route:
    heading, bend = float(rng.uniform(0.0, 6.0)), float(rng.uniform(0.1, 0.4))
    pieces = Clothoid(8.0, 0.0, bend), Clothoid(20.0, bend, -0.2), Clothoid(5.0, -0.2, 0.4)
    return Route.joined([Line(60.0, start_heading=heading), *pieces])


def log_spirals(rng: Draw) -> Route:
    heading, bend = float(rng.uniform(0.0, 6.0)), float(rng.uniform(0.3, 0.5))
    pieces = LogSpiral(12.0, 0.1, bend), LogSpiral(12.0, bend, 0.2)
    return Route.joined([Line(60.0, start_heading=heading), *pieces])


def turns(rng: Draw) -> Route:
    out = Spiral(1.7, TURN * 2.7, TURN * 5.0)
    return Route.joined(
        [
            Spiral(1.7, TURN * 8.0, TURN * 2.7),
            Arc(float(rng.uniform(2.5, 4.0)), 2.0),
            Arc(1.5, -2.1),
            out,
        ]
    )


# Ratios to about 1, 96, 102 and 449: see `hairpin`.
HAIRPINS = [
    (3.0, 2.0),
    (0.899698121027938, 2.0341416176355445),
    (0.913344008, 2.046460796),
    (1.2348659279706358, 2.4313350408491337),
]
KINDS = spiral_in, spiral_out, bends, clothoids, log_spirals, turns


def hairpin(radius: float, sweep: float) -> Walk:
    """One bench of 2.86 m from hole to hole, whose rear end leaps through a hairpin."""
    return Walk(
        Dragon.uniform(1), Route.joined([Line(20.0), Arc(radius, sweep), Line(20.0)]), start=19.9
    )


def towards_peak(walk: Walk, end: float) -> list[float]:
    """Head positions up to one, m, ever closer about that with the greatest ratio of a bench alone."""
    at = np.linspace(20.5, end, 60)
    for _closer in range(4):
        best = int(np.nanargmax(walk.placement(at, throw=False).speed_ratio[:, 1]))
        peak = at[max(best - 1, 0)], at[min(best + 1, len(at) - 1)]
        at = np.sort(np.concatenate([at, np.linspace(*peak, 60)]))
    return [float(s) for s in at]


@pytest.mark.parametrize("kind", KINDS)
def test_no_corner_is_off_by_more_than_is_said(kind: Callable[[Draw], Route]) -> None:
    rng, shares = np.random.default_rng(7), []
    for _dance in range(6):
        walk = Walk(Dragon.of_sizes(rng.uniform(1.0, 3.4, 14)), kind(rng))
        low = 0.0 if walk.route.extension and kind is spiral_in else 45.0
        errors = corner_errors(walk, float(rng.uniform(low, walk.route.length)))
        assert errors.said.max() < 1e-11
        shares.append(errors.share)
    # No error exceeds its bound, and bounds say something: they are no wider than they need be by far.
    assert 0.05 < max(shares) <= 1.0


def test_handles_keep_within_their_errors_along_the_route() -> None:
    walk = Walk(Dragon.uniform(400), Route((Spiral(1.7, TURN * 30.0, TURN * 3.0),)))
    s = 0.9 * walk.route.length
    chain, placed, (errors, _off) = exact_chain(walk, s), walk.placement(s), errors_at(walk, s)
    rows = BallRoute.stored(walk.route.rows).rows
    for i in (1, 50, 200, 400):
        j, u = (column[i] for column in placed.state(0))
        rounded = 2.0**-53 * abs(u) * walk.route.rows[0, 10] * u  # what the stored angle leaves out
        off = abs(float(rows[int(j)].position(arb(float(u))) - chain.handles[i].s))
        assert off <= errors[i] + rounded
    assert 0.0 == errors[0] < errors[1] < errors[200] < errors[400] < 2e-12


@pytest.mark.parametrize(("radius", "sweep"), HAIRPINS)
def test_speed_ratios_are_off_by_no_more_than_is_said(radius: float, sweep: float) -> None:
    walk = hairpin(radius, sweep)
    rows, places = walk.route.rows, empty_placements(2, 1)
    (lanes, errors), out = np.empty((2, 2)), np.empty((2, 1))
    for s in towards_peak(walk, 20.0 + radius * sweep + 3.5):
        place_chain(rows, walk.dragon.links, np.array([s]), 0, 1, places)
        mark_lanes(rows, walk.dragon.links, places, 0, 1, lanes)
        ratio_errors(rows, walk.dragon.links, seams_of(rows), places, lanes, 0, errors, out)
        exact = exact_ratios(walk, s)[1]
        assert abs(places.ratio[1, 0] - exact) <= out[1, 0] * exact


@pytest.mark.parametrize(("radius", "sweep"), HAIRPINS[1:])
def test_no_handle_is_faster_past_a_hairpin_than_the_bracket_says(radius: float, sweep: float) -> None:
    walk = hairpin(radius, sweep)
    found = greatest_speed(walk, 0.0, radius * sweep + 3.5, tolerance=1e-12)
    assert found.witness is not None
    low, high = found.witness.s - 1e-6, found.witness.s + 1e-6
    for _closer in range(40):
        one, other = low + 0.382 * (high - low), low + 0.618 * (high - low)
        if exact_ratios(walk, one)[1] > exact_ratios(walk, other)[1]:
            high = other
        else:
            low = one
    most = max(exact_ratios(walk, at)[1] for at in (low, 0.5 * (low + high), found.witness.s))
    assert most <= found.upper
    assert found.lower <= most
    assert found.upper - found.lower < 1e-5 * found.value


@pytest.mark.parametrize(
    "route",
    [
        Route((Spiral(0.55, TURN * 16.0, TURN),)),
        Route((Spiral(1.7, TURN * 700.0, TURN * 20.0),)),
        Route.joined([Spiral(1.7, TURN * 16.0, TURN * 2.7), Arc(3.0, 2.0), Clothoid(8.0, 0.0, 0.5)]),
        Route((Line(1e6 + 60.0), Arc(3.0, 2.0, (1e6 + 60.0, 0.0)))),
    ],
)
def test_where_a_head_exactly_is_is_told_far_below_rounding(route: Route) -> None:
    rows, drifts = BallRoute.stored(route.rows).rows, []
    for s in np.random.default_rng(3).uniform(0.0, route.length, 40).tolist():
        j, u, _status = locate(route.rows, s)
        drift, doubt = head_drift(route.rows, s)
        exact = rows[j].position(arb(u)) - arb(s)
        assert abs(float(exact - arb(drift))) <= doubt < 1e-2 * math.ulp(route.length)
        drifts.append(abs(drift))
    assert max(drifts) > 0.0 or route.rows[0, 0] == 0.0


def test_links_are_rounded_once() -> None:
    rng = np.random.default_rng(11)
    for _bench in range(2000):
        length, front, rear = rng.uniform(0.5, 4.0), rng.uniform(0.0, 0.2), rng.uniform(0.0, 0.2)
        exact = Fraction(length) - Fraction(front) - Fraction(rear)
        assert link_length(length, front, rear) == float(exact)
    assert Dragon.uniform(3).links[1] == float(Fraction(2.2) - 2 * Fraction(0.275))
    assert Dragon.uniform(3)[1].link == Dragon.uniform(3).links[1]


def test_joints_count_once_and_kinks_do_not() -> None:
    smooth = Route.joined([Line(10.0), Arc(2.0, 1.0), Line(5.0)])
    seams = seams_of(smooth.rows)
    assert seams[0].tolist() == [0.0, 0.0]
    assert (np.diff(seams, axis=0) > 0.0).all()
    assert seams[-1, Seam.GAP] < 1e-13
    assert seams[-1, Seam.TILT] < 1e-14
    kinked = Route((Line(10.0), Line(5.0, (10.0, 0.0), 1.0)), kinks=True)
    assert seams_of(kinked.rows)[1, Seam.TILT] < 1e-14


def test_gaps_at_joints_count() -> None:
    rows = Route.joined([Line(10.0), Arc(2.0, 1.0)]).rows.copy()
    rows[1, 8] += 3e-10  # Y
    seams = np.empty((2, 2))
    find_seams(rows, seams)
    assert 3e-10 < seams[1, Seam.GAP] < 3.1e-10
