"""Marching from head to tail: abreast and one by one, how it can end, and the second derivatives."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pytest

from benchdragon.hosts.serving import PLAIN, serving
from benchdragon.kernels import chain
from benchdragon.kernels.chain import (
    Placements,
    cosines,
    empty_placements,
    march,
    place_head,
    place_next,
    rates,
    run_end,
    shared_angles,
)
from benchdragon.kernels.curve import RouteRow, heading, place
from benchdragon.kernels.route import IntArray, locate, positions
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.status import Status
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line, LogSpiral, Route, Spiral
from benchdragon.model.turns import TwoArcTurn

Float = npt.NDArray[np.float64]


@dataclass
class Chain:
    row: IntArray
    u: Float
    x: Float
    y: Float
    ratio: Float
    failed: IntArray

    @classmethod
    def empty(cls, benches: int, times: int) -> "Chain":
        """Tables full of what no kernel may rely on."""
        shape = (benches + 1, times)
        u, x, y, ratio = (np.full(shape, np.nan) for _ in range(4))
        return cls(np.full(shape, 7777), u, x, y, ratio, np.full((2, times), 7777))

    def places(self) -> Placements:
        return Placements(*self.tables(), np.empty((0, 0)), np.empty((0, 0)), self.failed)

    def tables(self) -> tuple[IntArray, Float, Float, Float, Float]:
        return self.row, self.u, self.x, self.y, self.ratio

    def positions(self, route: Route) -> Float:
        out = np.empty(self.u.size)
        positions(route.rows, self.row.ravel(), self.u.ravel(), out)
        return out.reshape(self.u.shape)


def abreast(route: Route, links: Float, heads: Float) -> Chain:
    found = Chain.empty(len(links), len(heads))
    march(route.rows, links, heads, 0, len(heads), found.places())
    return found


def one_by_one(route: Route, links: Float, heads: Float) -> Chain:
    """The same by `place_next` alone, which knows nothing of lanes."""
    found = Chain.empty(len(links), len(heads))
    for t, s in enumerate(heads):
        assert place_head(route.rows, s, t, found.places()) == Status.OK
        for i, link in enumerate(links):
            assert place_next(route.rows, link, i, t, found.places()) == Status.OK
    return found


def random_links(seed: int, count: int) -> Float:
    links = np.random.default_rng(seed).uniform(0.4, 2.0, count)
    links[0] = 2.86
    return links


INWARD = Spiral(1.7, 60.0, 14.0)
TURN = TwoArcTurn(1.7).route(lead=60.0, trail=60.0)
MIXED: list[AnyCurve] = [
    Line(10.0),
    Clothoid(6.0, 0.0, 0.25),
    Arc(4.0, 2.0),
    Clothoid(8.0, 0.25, -0.1),
    LogSpiral(7.0, -0.1, -0.25),
    Line(5.0),
    Spiral(1.5, 45.0, 18.0, mirrored=True),
    Arc(4.0, -1.0),
    Spiral(1.2, 20.0, 60.0),
]
ROUTES = {
    "inward spiral": Route((INWARD,)),
    "inward spiral, mirrored, turned and shifted": Route(
        (Spiral(1.7, 60.0, 14.0, (30.0, -4.0), 2.2, mirrored=True),)
    ),
    "line and outward spiral": Route.joined([Line(5.0), Spiral(1.7, 14.0, 60.0)]),
    "line and outward spiral, mirrored": Route.joined(
        [Line(5.0, (3.0, 4.0), 2.0), Spiral(0.9, 25.0, 80.0, mirrored=True)]
    ),
    "turn": TURN,
    "everything": Route.joined(MIXED),
}
each_route = pytest.mark.parametrize("route", ROUTES.values(), ids=list(ROUTES))


@each_route
@pytest.mark.parametrize("times", [1, 2 * LANES + 5])
def test_many_times_abreast_give_what_each_time_gives_alone(route: Route, times: int) -> None:
    """Every seventh time, and so in turn each of the lanes that a processor takes at once."""
    links = random_links(1, 30)
    heads = np.linspace(0.1, 1.0, times) * route.length
    many, alone = abreast(route, links, heads), one_by_one(route, links, heads[::7])
    assert (many.failed == 0).all()
    for found, wanted in (
        (many.x, alone.x),
        (many.y, alone.y),
        (many.ratio, alone.ratio),
        (many.positions(route), alone.positions(route)),
    ):
        np.testing.assert_allclose(found[:, ::7], wanted, rtol=0.0, atol=1e-11)


@each_route
def test_every_link_keeps_its_length_and_every_handle_its_place(route: Route) -> None:
    links = random_links(2, 30)
    found = abreast(route, links, np.linspace(0.2, 1.0, 9) * route.length)
    chords = np.hypot(np.diff(found.x, axis=0), np.diff(found.y, axis=0))
    np.testing.assert_allclose(chords, np.tile(links, (9, 1)).T, rtol=0.0, atol=1e-12)
    for i, t in np.ndindex(found.u.shape):
        x, y, _tx, _ty = place(route.rows, int(found.row[i, t]), float(found.u[i, t]))
        assert math.hypot(x - found.x[i, t], y - found.y[i, t]) <= 1e-12


@each_route
def test_a_block_of_times_may_begin_and_end_anywhere(route: Route) -> None:
    links = random_links(3, 12)
    heads = np.linspace(0.2, 1.0, LANES + 20) * route.length
    whole = abreast(route, links, heads)
    part = Chain.empty(12, len(heads))
    march(route.rows, links, heads, 7, 50, part.places())
    np.testing.assert_allclose(part.x[:, 7:50], whole.x[:, 7:50], rtol=0.0, atol=1e-11)
    assert np.isnan(part.x[:, :7]).all()
    assert np.isnan(part.x[:, 50:]).all()


@each_route
def test_ratios_are_the_derivatives_of_route_positions(route: Route) -> None:
    links, h = random_links(4, 20), 1e-3
    heads = np.linspace(0.3, 0.99, 7) * route.length
    stencil = np.concatenate([heads + i * h for i in (-2, -1, 0, 1, 2)])
    found = abreast(route, links, stencil)
    s = found.positions(route).reshape(21, 5, 7)
    parts = route.rows[found.row, RouteRow.PART].reshape(21, 5, 7)
    slope = (8.0 * (s[:, 3] - s[:, 1]) - (s[:, 4] - s[:, 0])) / (12.0 * h)
    smooth = (parts == parts[:, :1]).all(axis=1).all(axis=0)  # no handle crosses a joint
    assert smooth.sum() >= 4
    ratio = found.ratio.reshape(21, 5, 7)[:, 2]
    np.testing.assert_allclose(slope[:, smooth], ratio[:, smooth], rtol=0.0, atol=2e-9)


@each_route
def test_rates_are_the_derivatives_of_ratios_and_headings(route: Route) -> None:
    links, h = random_links(5, 20), 1e-3
    heads = np.linspace(0.31, 0.98, 7) * route.length
    found = abreast(route, links, np.concatenate([heads + i * h for i in (-2, -1, 0, 1, 2)]))
    ratio_rate, turn = np.empty(found.u.shape), np.empty((20, found.u.shape[1]))
    rates(route.rows, links, *found.tables(), ratio_rate, turn)
    parts = route.rows[found.row, RouteRow.PART].reshape(21, 5, 7)
    smooth = (parts == parts[:, :1]).all(axis=1).all(axis=0)
    assert smooth.sum() >= 4
    benches = np.unwrap(
        np.arctan2(np.diff(found.y, axis=0), np.diff(found.x, axis=0)).reshape(20, 5, 7), axis=1
    )
    for values, rate in ((found.ratio.reshape(21, 5, 7), ratio_rate), (benches, turn)):
        slope = (8.0 * (values[:, 3] - values[:, 1]) - (values[:, 4] - values[:, 0])) / (12.0 * h)
        wanted = rate.reshape(-1, 5, 7)[:, 2]
        np.testing.assert_allclose(slope[:, smooth], wanted[:, smooth], rtol=0.0, atol=5e-9)


def test_a_dragon_on_a_line_turns_nowhere_and_keeps_its_speed() -> None:
    route, links = Route((Line(50.0, (1.0, 2.0), 0.4),)), random_links(6, 10)
    found = abreast(route, links, np.array([0.0, 49.0]))
    np.testing.assert_allclose(found.ratio, 1.0, rtol=0.0, atol=1e-14)
    wanted = np.cumsum(np.concatenate([[0.0], -links]))
    np.testing.assert_allclose(found.positions(route)[:, 0], wanted, rtol=0.0, atol=1e-13)
    ratio_rate, turn = np.empty((11, 2)), np.empty((10, 2))
    rates(route.rows, links, *found.tables(), ratio_rate, turn)
    np.testing.assert_allclose(ratio_rate, 0.0, atol=1e-13)
    np.testing.assert_allclose(turn, 0.0, atol=1e-13)


def test_a_dragon_on_a_circle_turns_with_it() -> None:
    radius, links = 5.0, random_links(7, 8)
    route = Route((Arc(radius, 6.0),))
    found = abreast(route, links, np.array([28.0]))
    np.testing.assert_allclose(found.ratio, 1.0, rtol=0.0, atol=1e-14)
    steps = 2.0 * radius * np.arcsin(0.5 * links / radius)
    np.testing.assert_allclose(-np.diff(found.positions(route)[:, 0]), steps, rtol=0.0, atol=1e-13)
    ratio_rate, turn = np.empty((9, 1)), np.empty((8, 1))
    rates(route.rows, links, *found.tables(), ratio_rate, turn)
    np.testing.assert_allclose(ratio_rate, 0.0, atol=1e-13)
    np.testing.assert_allclose(turn, 1.0 / radius, rtol=1e-13)


def test_cosines_are_those_of_the_angles_between_bench_and_route() -> None:
    rows = TURN.rows
    front, u, _ = locate(rows, 70.0)
    rear, v, _ = locate(rows, 68.0)
    ax, ay, *_ = place(rows, front, u)
    bx, by, *_ = place(rows, rear, v)
    bench = math.atan2(ay - by, ax - bx)
    link = math.hypot(ax - bx, ay - by)
    ahead, behind, x, y = cosines(rows, front, u, ax, ay, rear, v, link)
    assert (x, y) == (bx, by)
    assert ahead == pytest.approx(math.cos(bench - heading(rows, front, u)), abs=1e-14)
    assert behind == pytest.approx(math.cos(bench - heading(rows, rear, v)), abs=1e-14)


def test_angles_are_shared_only_by_sound_times_on_one_row() -> None:
    places = empty_placements(1, 4)
    row, failed = places.row, places.failed
    row[:], failed[:], places.u[:] = 0, Status.OK, [7.0, 5.0, 9.0, 6.0]
    assert shared_angles(0, 0, 4, places) == (5.0, 9.0)
    assert shared_angles(0, 2, 4, places) == (6.0, 9.0)
    row[0, 1] = 1
    assert shared_angles(0, 0, 4, places) == (1.0, 0.0)
    assert shared_angles(0, 2, 4, places) == (6.0, 9.0)
    failed[0, 3] = Status.FOLDED
    assert shared_angles(0, 2, 4, places) == (1.0, 0.0)


FAILURES = {
    # route, links, head position, how it ends, the bench that it befalls
    "a head before the route": (
        Route((Arc(9.0, 3.0),)), [2.0, 2.0], -0.5, Status.BEFORE_ROUTE, 0,
    ),
    "a head past the route": (
        Route((Line(9.0),)), [2.0, 2.0], 9.5, Status.AFTER_ROUTE, 0,
    ),
    "a tail that hangs out": (
        Route((Arc(9.0, 3.0),)), [2.0, 2.0, 2.0, 2.0], 5.0, Status.ROUTE_TOO_SHORT, 3,
    ),
    "a kink past a right angle": (
        Route((Line(9.0), Line(9.0, (9.0, 0.0), 2.5)), kinks=True), [1.0, 2.0, 2.0], 11.5,
        Status.FOLDED, 2,
    ),
    "a link that spans an arc": (
        Route.joined([Line(9.0), Arc(0.5, 12.0)]), [0.3, 1.2, 1.2], 10.7,
        Status.LINK_OVER_DIAMETER, 2,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FAILURES)
def test_a_dragon_that_cannot_stand_says_how_and_where(name: str) -> None:
    route, links, head, status, bench = FAILURES[name]
    found = abreast(route, np.array(links), np.array([head]))
    assert found.failed[:, 0].tolist() == [status, bench]
    for numbers in (found.u, found.x, found.y, found.ratio):
        assert np.isfinite(numbers[:bench]).all()
        assert np.isnan(numbers[bench:]).all()
    assert (found.row[bench:] == 0).all()


@pytest.mark.parametrize("name", FAILURES)
def test_a_failing_time_harms_no_other_time(name: str) -> None:
    route, links, head, status, bench = FAILURES[name]
    sound = {"a tail that hangs out": 9.0, "a head before the route": 20.0}.get(name, 8.5)
    heads = np.full(LANES + 3, sound)
    heads[[2, LANES + 1]] = head
    found = abreast(route, np.array(links), heads)
    alone = abreast(route, np.array(links), np.array([sound]))
    for t in range(LANES + 3):
        if heads[t] == head:
            assert found.failed[:, t].tolist() == [status, bench]
            assert np.isnan(found.x[bench:, t]).all()
        else:
            assert found.failed[:, t].tolist() == [Status.OK, 0]
            np.testing.assert_allclose(found.x[:, t], alone.x[:, 0], rtol=0.0, atol=1e-13)


def test_a_failing_time_on_a_spiral_harms_no_other_time() -> None:
    # One time's tail leaves the lanes: it walked in from a route that is too short for it.
    route, links = Route.joined([Arc(20.0, 0.2), Spiral(1.7, 60.0, 20.0)]), np.full(20, 1.65)
    heads = np.linspace(60.0, 120.0, 20)
    heads[5] = 20.0
    found = abreast(route, links, heads)
    assert found.failed[0, 5] == Status.ROUTE_TOO_SHORT
    assert 1 < found.failed[1, 5] <= 20
    assert (np.delete(found.failed, 5, axis=1) == 0).all()
    sound = abreast(route, links, np.delete(heads, 5))
    np.testing.assert_allclose(np.delete(found.x, 5, axis=1), sound.x, rtol=0.0, atol=1e-11)


@pytest.mark.parametrize(("square", "status"), [(1e-4, Status.FOLDED), (0.05, Status.OK)])
def test_a_bench_all_but_square_to_the_route_counts_as_folded(square: float, status: Status) -> None:
    # The front has just passed a kink short of a right angle; the rear is still on the line before.
    kink = 0.5 * math.pi - square
    route = Route((Line(9.0), Line(9.0, (9.0, 0.0), kink)), kinks=True)
    found = abreast(route, np.array([2.0]), np.array([9.0 + 1e-12]))
    assert found.failed[0, 0] == status
    if status == Status.OK:
        assert found.ratio[1, 0] == pytest.approx(math.sin(square), rel=1e-9)


def test_a_run_ends_where_a_handle_fails_leaves_the_row_or_comes_too_near_its_end() -> None:
    rows, link = TURN.rows, 2.0
    at = np.array([62.0, 75.0, 80.0, 90.0, 30.0])
    places = empty_placements(1, 5)
    row, u, failed = places.row, places.u, places.failed
    failed[:] = Status.OK
    for t, s in enumerate(at):
        row[0, t], u[0, t], _status = locate(rows, s)
    ends = [run_end(rows, link, 0, t, 5, places) for t in range(5)]
    assert ends == [0, 1, 4, 4, 5]
    failed[0, 3] = Status.FOLDED
    assert run_end(rows, link, 0, 2, 5, places) == 3
    assert run_end(rows, link, 0, 4, 4, places) == 4


@pytest.mark.skipif(serving().name != PLAIN, reason="compiled kernels call one another directly")
def test_lanes_that_do_not_settle_leave_their_times_to_the_search(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    route, links = Route((INWARD,)), random_links(8, 10)
    heads = np.linspace(0.1, 1.0, 5) * route.length
    settled = abreast(route, links, heads)
    monkeypatch.setattr(chain, "spiral_links", lambda *_arguments: False)
    searched = abreast(route, links, heads)
    assert (searched.failed == 0).all()
    assert (searched.x != settled.x).any()
    np.testing.assert_allclose(searched.x, settled.x, rtol=0.0, atol=1e-11)
