"""What cells of the route say of benches, and so of steps of the head, holds everywhere in them."""

import math

import numpy as np
import pytest

from benchdragon import Arc, Bench, Dragon, Line, Route, Spiral
from benchdragon.analysis.nearby import seams_of
from benchdragon.kernels import bench_cells as cells
from benchdragon.kernels import motion_bounds
from benchdragon.kernels.bench_cells import Cell, CutCount
from benchdragon.kernels.chain import empty_placements, rates
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate
from benchdragon.kernels.motion_bounds import HandleBound, place_chain
from benchdragon.kernels.rate_rounding import bend_errors, rate_errors
from benchdragon.kernels.rounding import ratio_errors
from benchdragon.kernels.status import Ended
from benchdragon.model.placement import Placement
from tests.kernels import rooms
from tests.kernels.quantities import QUANTITIES, size_of

pytestmark = pytest.mark.plain

LONGEST, SHORTEST = 0.44, 0.05
ROUTES = {
    "spiral": Route((Spiral(0.9, 40.0, 8.0),)),
    "joints": Route.joined([Line(12.0), Arc(1.6, 1.0), Arc(2.0, -1.5), Line(9.0)]),
}
DRAGON = Dragon([Bench(1.6, 0.4, 0.1, 0.2), *[Bench(1.1, 0.3, 0.1, 0.1)] * 5])
LINKS, INVERSE = np.unique(DRAGON.links, return_inverse=True)
GROUP = INVERSE.astype(np.int64)


def cut(
    route: Route, low: float, high: float, loss: float = 1e-3, room: int = 400, budget: int = 10_000
) -> cells.Cells:
    """The cells of a way, m, for benches that come all along; made in calls of so many cells."""
    kinds = cells.CellKinds(LINKS[:, np.newaxis].copy(), np.tile([low, high], (len(LINKS), 1)))
    shop, made = (
        rooms.workshop_for(len(LINKS), seams_of(route.rows)),
        rooms.empty_cells(room, len(LINKS)),
    )
    cuts = cells.Cuts(high, LONGEST, SHORTEST, loss)
    reached, done = np.array([low, LONGEST]), np.zeros(2, dtype=np.int64)
    while True:
        before = int(done[CutCount.CELLS])
        ended = cells.cut_cells(route.rows, kinds, shop, cuts, made, reached, done, budget)
        if ended == Ended.DONE:
            break
        if ended == Ended.ROOM:
            assert done[CutCount.CELLS] == len(made.borders) - 1
            made = cells.Cells(*(np.concatenate([table, table]) for table in made))
        else:
            assert (ended, done[CutCount.CELLS]) == (Ended.MORE, before + budget)
    count = int(done[CutCount.CELLS])
    return cells.Cells(*(table[: count + 1].copy() for table in made))


def bench_alone(route: Route, g: int, at: FloatArray) -> Placement:
    """One bench of that kind with its front handle at these positions, m."""
    return Placement(Dragon.of_sizes(LINKS[g : g + 1], 0.1, 0.0, 0.0), route, at)


@pytest.mark.parametrize("name", ROUTES)
def test_a_bench_does_in_each_cell_what_that_says_and_hardly_less(name: str) -> None:
    route = ROUTES[name]
    made = cut(route, 9.0, 15.0)
    assert (made.borders[0], made.borders[-1]) == (9.0, 15.0)
    widths = np.diff(made.borders)
    assert widths.max() <= LONGEST * (1.0 + 1e-9)
    assert widths.min() > 0.0
    share = np.linspace(1e-9, 1.0 - 1e-9, 7)
    for c, (a, b) in enumerate(zip(made.borders, made.borders[1:], strict=False)):
        at = a + (b - a) * share
        bend = np.abs(route.curvature(at)).max()
        assert bend * (1.0 - 1e-9) <= made.bends[c] <= bend + 0.7
        for g in range(len(LINKS)):
            one, told = bench_alone(route, g, at), made.benches[c, g]
            ratio, growth = one.speed_ratio[:, 1], one.ratio_rate[:, 1] / one.speed_ratio[:, 1]
            assert told[Cell.REAR] == pytest.approx(
                bench_alone(route, g, made.borders[c : c + 1]).s[0, 1], abs=1e-12
            )
            assert told[Cell.SLOW] <= ratio.min() + 1e-12
            assert ratio.max() <= told[Cell.FAST] + 1e-12
            assert told[Cell.FADE] <= growth.min() + 1e-9
            assert growth.max() <= told[Cell.GROW] + 1e-9
            assert np.abs(one.turning_ratio).max() <= told[Cell.SWAY] + 1e-12
            assert told[Cell.FAST] <= ratio.max() + 0.05
            assert told[Cell.SWAY] <= np.abs(one.turning_ratio).max() + 0.5
            for n, s in enumerate(at):
                back, front = cells.rear_range(made.benches, made.borders, g, c, c, s, s)
                assert back <= one.s[n, 1] <= front
                assert front - back < 0.05


def test_cells_are_short_only_where_that_says_more() -> None:
    route = ROUTES["joints"]
    coarse, fine = (cut(route, 9.0, 20.0, loss) for loss in (1e-2, 1e-5))
    assert len(coarse.borders) < 0.7 * len(fine.borders)
    straight = fine.borders[:-1] < 11.0
    assert np.diff(fine.borders)[straight].min() > 2.0 * SHORTEST
    widths = np.diff(coarse.borders)[:-1]  # the last is cut off
    assert widths[coarse.borders[:-2] > 18.0].min() > 2.0 * widths.min()
    for made, loss in ((coarse, 1e-2), (fine, 1e-5)):
        widths = np.diff(made.borders)
        for g in range(len(LINKS)):
            ends = bench_alone(route, g, made.borders).speed_ratio[:, 1]
            seen = np.maximum(ends[1:], ends[:-1]) * (1.0 + loss)
            loose = made.benches[:-1, g, Cell.FAST] > np.maximum(seen, 1.0)
            assert (widths[loose] <= 2.0 * SHORTEST).all()


def test_cells_made_a_few_at_a_time_are_the_same() -> None:
    whole = cut(ROUTES["joints"], 11.0, 15.0)
    for room, budget in ((1, 10_000), (400, 1), (3, 2)):
        parts = cut(ROUTES["joints"], 11.0, 15.0, room=room, budget=budget)
        for one, other in zip(whole, parts, strict=True):
            np.testing.assert_array_equal(one[:-1], other[:-1])


def test_kinds_that_never_come_are_left_open() -> None:
    route, high = ROUTES["joints"], 15.0
    kinds = cells.CellKinds(LINKS[:, np.newaxis].copy(), np.array([[9.0, high], [13.0, 14.0]]))
    shop, made = rooms.workshop_for(2, seams_of(route.rows)), rooms.empty_cells(400, 2)
    reached, done = np.array([9.0, LONGEST]), np.zeros(2, dtype=np.int64)
    cuts = cells.Cuts(high, LONGEST, SHORTEST, 1e-2)
    cells.cut_cells(route.rows, kinds, shop, cuts, made, reached, done, 400)
    count = int(done[CutCount.CELLS])
    borders, fast = made.borders[: count + 1], made.benches[:count, :, Cell.FAST]
    assert np.isfinite(fast[:, 0]).all()
    inside = (borders[1:] >= 13.0) & (borders[:-1] <= 14.0)
    assert np.isfinite(fast[inside, 1]).all()
    assert np.isinf(fast[borders[1:] < 13.0 - 2.0 * LONGEST, 1]).all()
    assert np.isinf(fast[borders[:-1] > 14.0, 1]).all()


def values(route: Route, name: str, at: FloatArray, squares: FloatArray, rate: float) -> FloatArray:
    """A quantity's size for each handle, of benches at their rear ones, (positions, handles)."""
    one = Placement(DRAGON, route, at)
    found = size_of(name, one, route, squares, rate)
    return np.column_stack([np.zeros(len(at)), found]) if name == "turning" else found


@pytest.mark.parametrize("h", [0.6, 0.15])
@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("name", ROUTES)
def test_no_handle_exceeds_what_its_cells_say(name: str, quantity: str, h: float) -> None:
    route, driven = ROUTES[name], np.array([0.5, 0.9, 0.3])
    made, links = cut(route, 1.5, 16.0), len(DRAGON)
    share = np.linspace(0.0, 1.0, 7)
    closest = math.inf
    for low in np.arange(10.0, 16.0 - h, 2.0 * h):
        squares = driven[0] + share * (driven[1] - driven[0])
        seen = values(route, quantity, low + h * share, squares, driven[2]).max(axis=0)
        for few in (links, 2):
            enough = float(np.median(seen))
            bound, settled, last = cells.bound_by_cells(
                made, GROUP, few, low, low + h, driven, QUANTITIES[quantity], enough
            )
            assert seen[: few + 1].max() <= bound * (1.0 + 1e-12)
            assert seen[last + 1 : few + 1].max(initial=0.0) <= settled * (1.0 + 1e-12)
            assert settled <= enough
            assert last <= few
            if seen[: few + 1].max() > 0.1:
                closest = min(closest, bound / seen[: few + 1].max())
    assert closest <= 1.0 + (6.0 if quantity in ("total", "along") else 2.0) * h


def test_where_a_bench_cannot_stand_nothing_is_bounded() -> None:
    route = Route((Line(6.0),))
    made = cut(route, 2.0, 7.0)
    fast = made.benches[:-1, :, Cell.FAST]
    assert fast[0] == pytest.approx([1.0, 1.0], rel=1e-3)
    assert np.isinf(fast[-1]).all()
    even = np.array([1.0, 1.0, 0.0])
    told = [
        cells.bound_by_cells(made, GROUP[:2], 2, s, s + 0.1, even, DriveRate.SPEEDS, 0.5)
        for s in (5.95, 6.5, 5.0)
    ]
    assert told[:2] == [(math.inf, 0.0, 2)] * 2
    assert told[2][0] == pytest.approx(1.0, rel=1e-2)
    assert told[2][1:] == (0.0, 2)
    assert cells.bound_by_cells(made, GROUP[:2], 2, 5.0, 5.1, even, DriveRate.SPEEDS, 2.0)[2] == -1


def test_where_all_cells_slow_benches_down_no_handle_behind_need_be_looked_at() -> None:
    route, even = ROUTES["spiral"], np.array([1.0, 1.0, 0.0])
    made = cut(route, 1.5, 16.0, 1e-6)
    np.testing.assert_array_equal(
        made.fastest[:-1], np.maximum.accumulate(made.benches[:-1, :, Cell.FAST].max(axis=1))
    )
    assert (made.fastest[:-1] <= 1.0).all()
    made.benches[:-20] = math.nan  # the tail is there
    told = [
        cells.bound_by_cells(made, GROUP, len(DRAGON), 14.0, 15.0, even, DriveRate.SPEEDS, enough)
        for enough in (1.1, 0.9)
    ]
    bound, settled, last = told[0]
    assert (bound, last) == (settled, -1)
    assert bound == pytest.approx(1.0)
    assert math.isnan(told[1][0]) or told[1][2] > 0


def test_cells_say_what_rounding_may_have_hidden() -> None:
    route = ROUTES["joints"]
    made, rows = cut(route, 9.0, 15.0), route.rows
    longer = cut(route, 9.0, 20.0).off[:-1]
    assert (np.diff(longer) >= 0.0).all()  # that of any cell before
    assert (np.diff(longer) == 0.0)[-5:].all()
    places, bounds = empty_placements(2, 2), np.empty((2, motion_bounds.HANDLE_COLUMNS))
    greatest, most = 0.0, dict.fromkeys((Cell.SWAY, Cell.GROW, Cell.FADE), 0.0)
    for c in range(len(made.borders) - 1):
        for g in range(len(LINKS)):
            link, told = LINKS[g : g + 1], made.benches[c, g]
            errors, (change, turn) = rooms.errors_for(2, 2, seams_of(rows)), np.zeros((2, 2, 2))
            assert place_chain(rows, link, made.borders[c : c + 2].copy(), 0, 2, places)
            rates(rows, link, *places[:5], change, turn[:1])
            for t in (0, 1):
                ratio_errors(
                    rows, link, *errors[:1], places, errors.lanes, t, errors.along, errors.ratio
                )
                bend_errors(rows, places, t, 1, errors)
                rate_errors(rows, link, places, change, turn, t, errors)
            motion_bounds.bound_handles(rows, link, places, 0, 1, bounds)
            greatest = max(greatest, errors.ratio[1].max())
            growth = (errors.change[1] + np.abs(change[1]) * errors.ratio[1]) / places.ratio[1]
            for column, bound, off in (
                (Cell.SWAY, bounds[1, HandleBound.TURNING_RATE], errors.turn[0].max()),
                (Cell.GROW, bounds[1, HandleBound.GROWTH_HIGH], growth.max()),
                (Cell.FADE, bounds[1, HandleBound.GROWTH_LOW], -growth.max()),
            ):
                assert told[column] - bound == pytest.approx(off, rel=0.1, abs=2e-15)
                most[column] = max(most[column], abs(off))
        assert made.off[c] == pytest.approx(greatest, rel=0.1)
    assert 1e-15 < greatest < 1e-13
    assert min(most.values()) > 1e-14


@pytest.mark.parametrize("quantity", ["speed", "along", "across"])
def test_rounding_adds_to_what_cells_say_link_by_link(quantity: str) -> None:
    made, driven = cut(ROUTES["joints"], 1.5, 16.0), np.array([0.5, 0.9, 0.3])
    asked = made, GROUP, len(DRAGON), 13.0, 13.2, driven, QUANTITIES[quantity]
    made.off[:] = 0.0
    bound, _none, last = cells.bound_by_cells(*asked, -1.0)
    assert last == len(DRAGON)
    made.off[:-1] = 0.1
    more, _none, _last = cells.bound_by_cells(*asked, -1.0)
    settled = cells.bound_by_cells(*asked, math.inf)[1]
    assert settled == more
    assert 1.01 * bound < more <= bound * (1.1 ** (2 * len(DRAGON)))
    if quantity == "speed":  # where all is calm the last handle may be the one
        made.fastest[:] = 1.0
        assert cells.bound_by_cells(*asked, 2.0)[0] == pytest.approx(
            math.sqrt(0.9) * (1.0 + 0.1 * len(DRAGON))
        )
