"""A dragon beside its route: places by SciPy on the parallel curve, links as long as ever, bounds."""

import math

import numpy as np
import pytest

from benchdragon.analysis.distance import boxes
from benchdragon.kernels import motion_bounds
from benchdragon.kernels.box import least_distance, pair_distances
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.motion_bounds import HandleBound
from benchdragon.kernels.route import locate, positions
from benchdragon.kernels.stray_chain import (
    bound_beside,
    moved,
    parallel_bend,
    place_along,
    place_beside,
)
from benchdragon.model.curves import Arc, Clothoid, Line, Route, Spiral
from benchdragon.model.dragon import Dragon
from benchdragon.model.walk import Walk
from tests.kernels.reference import Float, points

ROUTES = {
    "spiral": Route((Spiral.between(0.9, 9.0, 3.0),)),
    "outward": Route.joined([Line(9.0), Spiral(0.9, 15.0, 30.0)]),
    "arcs": Route.joined([Line(30.0), Arc(6.0, 2.0), Arc(5.0, -1.5), Line(10.0)]),
    "clothoids": Route.joined([Line(20.0), Clothoid(9.0, 0.0, 0.2), Clothoid(9.0, 0.2, -0.1)]),
}
BENCHES = Dragon.uniform(9, head_length=2.4)
ASIDE = np.array([0.03, -0.02, 0.0, 0.04, -0.05, 0.01, 0.02, -0.03, 0.05, -0.01])


def chains(route: Route, at: Float, aside: Float = ASIDE, dragon: Dragon = BENCHES) -> Placements:
    places = empty_placements(len(dragon) + 1, len(at))
    assert place_along(route.rows, dragon.links, aside, at, places) == len(at)
    return places


@pytest.mark.parametrize("name", ROUTES)
def test_handles_walk_on_parallel_curves_and_links_keep_their_lengths(name: str) -> None:
    route = ROUTES[name]
    places = chains(route, np.linspace(route.length - 6.0, route.length - 1.0, 12))
    z = places.x + 1j * places.y
    assert np.abs(np.diff(z, axis=0)) == pytest.approx(np.tile(BENCHES.links, (12, 1)).T, abs=1e-11)
    s = np.empty(z.size)
    positions(route.rows, places.row.ravel(), places.u.ravel(), s)
    # Beside its place, by its own offset, to the left: and no place of the route is nearer.
    tangent = (points(route, s + 1e-4) - points(route, s - 1e-4)) / 2e-4
    meant = points(route, s) + 1j * tangent * np.repeat(ASIDE, 12)
    assert np.abs(meant - z.ravel()).max() < 1e-9
    assert np.abs(places.tx + 1j * places.ty - tangent.reshape(z.shape)).max() < 1e-7


def test_a_straight_line_is_solved_by_hand() -> None:
    dragon = Dragon.uniform(1, tail_length=2.2, head_length=2.2)
    places = chains(Route((Line(10.0),)), np.array([5.0]), np.array([0.3, -0.2]), dragon)
    along = np.sqrt(1.65**2 - 0.5**2)
    assert (places.x + 1j * places.y)[:, 0] == pytest.approx([5.0 + 0.3j, 5.0 - along - 0.2j], abs=1e-9)


@pytest.mark.parametrize("name", ROUTES)
def test_a_chain_followed_on_is_the_one_sought_afresh(name: str) -> None:
    route = ROUTES[name]
    at = np.linspace(route.length - 9.0, route.length - 0.5, 40)
    followed = chains(route, at)
    for t in (0, 17, 39):
        fresh = empty_placements(len(BENCHES) + 1, len(at))
        assert place_beside(route.rows, BENCHES.links, ASIDE, at, t, t, fresh)
        assert np.abs(fresh.x[:, t] - followed.x[:, t]).max() < 1e-9
        assert np.abs(fresh.y[:, t] - followed.y[:, t]).max() < 1e-9
        assert fresh.ratio[:, t] == pytest.approx(followed.ratio[:, t], abs=1e-7)


@pytest.mark.parametrize("name", ROUTES)
def test_on_the_route_the_chain_is_the_exact_one(name: str) -> None:
    route = ROUTES[name]
    at = np.linspace(route.length - 3.0, route.length - 0.5, 5)
    motion = Walk(BENCHES, route).motion(at)
    for aside in (np.zeros(len(BENCHES) + 1), np.empty(0)):
        places = chains(route, at, aside)
        assert np.abs(places.x.T - motion.x).max() < 1e-10
        assert np.abs(places.y.T - motion.y).max() < 1e-10


def test_a_place_is_found_by_metres_across_joints() -> None:
    for name in ("arcs", "clothoids", "outward"):
        route = ROUTES[name]
        s = np.empty(1)
        for start, way in ((0.01, 30.0), (29.0, 1.5), (31.0, -1.5), (route.length - 0.5, -8.0)):
            j, u, _ = locate(route.rows, start)
            for _step in range(1000):
                j, u = moved(route.rows, j, u, 1e-3 * way)
            positions(route.rows, np.array([j]), np.array([u]), s)
            assert s[0] == pytest.approx(start + way, abs=0.02)


def test_who_would_walk_beyond_the_centre_of_an_arc_cannot_stand() -> None:
    route = Route.joined([Line(12.0), Arc(0.8, 2.0), Line(10.0)])
    dragon = Dragon.uniform(3, 0.8, 0.8, 0.8, 0.1, 0.1, 0.1)
    at = np.linspace(11.5, 14.0, 26)
    places = empty_placements(4, len(at))
    assert place_along(route.rows, dragon.links, np.full(4, 0.3), at, places) == len(at)
    stood = place_along(route.rows, dragon.links, np.full(4, 0.79), at, places)
    assert at[stood] == pytest.approx(12.0, abs=0.1)


def test_no_follower_walks_beyond_the_centre_of_an_arc() -> None:
    """Its bench is so long that it might stand on the far side of the arc."""
    route, at = Route.joined([Line(14.0), Arc(0.8, 0.3), Line(10.0)]), np.linspace(13.5, 18.0, 46)
    dragon = Dragon.uniform(3, 2.2, 2.2, 2.2, 0.1, 0.1, 0.1)
    places, s = empty_placements(4, len(at)), np.empty(len(at))
    stood = place_along(route.rows, dragon.links, np.array([0.0, 0.77, 0.0, 0.0]), at, places)
    positions(route.rows, places.row[1, :stood], places.u[1, :stood], s[:stood])
    assert 13.9 < s[:stood].max() < 14.0


def test_a_curve_beside_a_circle_is_a_circle() -> None:
    assert parallel_bend(0.5, 0.4) == pytest.approx(1.0 / 1.6)
    assert parallel_bend(-0.5, 0.4) == pytest.approx(-1.0 / 2.4)
    assert parallel_bend(0.5, 2.0) == math.inf
    assert parallel_bend(-math.inf, 0.1) == -math.inf


@pytest.mark.parametrize("h", [0.3, 0.05])
@pytest.mark.parametrize("name", [*ROUTES, "joint"])
def test_bounds_hold_everywhere_in_a_step_beside_the_route(name: str, h: float) -> None:
    route = ROUTES["arcs" if name == "joint" else name]
    start = 41.9 if name == "joint" else route.length - 2.0
    at = np.linspace(start, start + h, 41)
    fine, ends = chains(route, at), chains(route, at[[0, -1]])
    count, links = len(ASIDE), BENCHES.links
    bounds = np.empty((count, motion_bounds.HANDLE_COLUMNS))
    bound_beside(route.rows, links, ASIDE, ends, 0, 1, bounds)
    z = fine.x + 1j * fine.y
    steps = np.abs(np.diff(z, axis=1))
    assert (steps.sum(axis=1) <= bounds[:, HandleBound.PATH] + 1e-10).all()
    assert (steps.sum(axis=1) >= 0.9 * bounds[:, HandleBound.PATH]).all()
    assert (fine.ratio <= bounds[:, [HandleBound.SPEED]] + 1e-9).all()
    assert (fine.ratio >= bounds[:, [HandleBound.SLOWEST]] - 1e-9).all()
    way = steps[0].mean()
    rates = np.diff(np.log(fine.ratio), axis=1) / way
    assert (rates <= bounds[:, [HandleBound.GROWTH_HIGH]] + 1e-5).all()
    assert (rates >= bounds[:, [HandleBound.GROWTH_LOW]] - 1e-5).all()
    turns = np.abs(np.diff(np.unwrap(np.angle(z[:-1] - z[1:]), axis=1), axis=1)).max(axis=1) / way
    assert (turns <= bounds[1:, HandleBound.TURNING_RATE] + 1e-8).all()
    force = np.abs(np.diff(z, 2, axis=1)).max(axis=1) / way**2
    if name != "joint":  # where the curvature leaps, differences over the joint blur it
        assert (force <= bounds[:, HandleBound.ACCELERATION] + 1e-4).all()
    tangent = np.unwrap(np.arctan2(fine.ty, fine.tx), axis=1)
    assert (
        np.abs(np.diff(tangent, axis=1)).sum(axis=1) <= bounds[:, HandleBound.HEADING_CHANGE] + 1e-9
    ).all()
    bend = np.diff(tangent, axis=1) / steps
    assert (bend <= bounds[:, [HandleBound.LEFT]] + 1e-5).all()
    assert (bend >= bounds[:, [HandleBound.RIGHT]] - 1e-5).all()
    assert np.isfinite(bounds[1:]).all()


def test_the_least_distance_is_that_of_all_pairs_at_all_times() -> None:
    walk = Walk(Dragon.uniform(60), Route((Spiral.between(0.6, 6.0, 2.6),)))
    motion = walk.motion([0.0, 55.0, walk.route.length])
    first, second = np.triu_indices(60, 2)
    gap, distance = np.empty(len(first)), np.empty(len(first))
    for count in (1, 2, 3):
        x, y = (np.ascontiguousarray(table[:count].T) for table in (motion.x, motion.y))
        found = least_distance(walk.dragon.sizes, x, y)
        tables, least = [boxes(motion, t) for t in range(count)], math.inf
        for table in tables:
            pair_distances(table, second, first, gap, distance)
            least = min(least, float(distance.min()))
        assert found == least
