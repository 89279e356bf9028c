"""Bounds over a step hold at every place in it; searches built on them find what sampling finds."""

import math

import numpy as np
import pytest

from benchdragon import (
    Arc,
    Bench,
    Clothoid,
    Dragon,
    Line,
    Route,
    Spiral,
    Walk,
    clearance_curve,
    clearances,
    contact_windows,
    first_contact,
    least_clearance,
)
from benchdragon.clearance import boxes
from benchdragon.contact import Hunt
from benchdragon.ground import Ground, Ledger
from benchdragon.kernels import cells, search, sweep
from benchdragon.kernels.box import (
    HALF_LENGTH,
    HALF_WIDTH,
    box_distance,
    box_gap,
    corner,
    distances_along,
    offset,
    set_box,
)
from benchdragon.kernels.curve import FloatArray
from benchdragon.speeds import greatest_speed

BENCHES = [Bench(1.6, 0.4, 0.1, 0.2), *[Bench(1.1, 0.3, 0.1, 0.1)] * 5]
ROUTES = {
    "spiral": (Route((Spiral(0.9, 40.0, 8.0),)), 12.0),
    "arc": (Route.joined([Line(12.0), Arc(1.6, 5.0), Line(9.0)]), 14.0),
    "joint": (Route.joined([Line(12.0), Arc(1.6, 1.0), Arc(2.0, -1.5), Line(9.0)]), 12.9),
    "clothoid": (Route.joined([Line(12.0), Clothoid(3.0, 0.0, 0.6), Arc(1.0 / 0.6, 3.0)]), 15.5),
    "kink": (
        Route((Line(12.0), Line(9.0).moved((12.0, 0.0), 0.4)), kinks=True),
        11.97,
    ),
}


def chains(walk: Walk, at: FloatArray) -> sweep.Places:
    places = sweep.empty_places(len(walk.dragon) + 1, len(at))
    assert sweep.stand(walk.route.rows, walk.dragon.links, at, 0, len(at), places)
    return places


@pytest.mark.parametrize("h", [0.3, 0.05])
@pytest.mark.parametrize("name", ROUTES)
def test_bounds_hold_everywhere_in_a_step(name: str, h: float) -> None:
    route, start = ROUTES[name]
    walk = Walk(Dragon(BENCHES), route)
    at = np.linspace(start, start + h, 41)
    places = chains(walk, at)
    ends = chains(walk, at[[0, -1]])
    count = len(walk.dragon) + 1
    bounds = np.empty((count, sweep.HANDLE_COLUMNS))
    sweep.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, bounds)
    paths = np.hypot(np.diff(places.x, axis=1), np.diff(places.y, axis=1)).sum(axis=1)
    assert (paths <= bounds[:, sweep.PATH] + 1e-12).all()
    assert (places.ratio <= bounds[:, [sweep.SPEED]] + 1e-12).all()
    assert (places.ratio >= bounds[:, [sweep.SLOWEST]] - 1e-12).all()
    rates = np.diff(np.log(places.ratio), axis=1) / (at[1] - at[0])
    assert (rates <= bounds[:, [sweep.GROW]] + 1e-6).all()
    assert (rates >= bounds[:, [sweep.FADE]] - 1e-6).all()
    direction = np.unwrap(np.arctan2(-np.diff(places.y, axis=0), -np.diff(places.x, axis=0)), axis=1)
    sway = np.abs(np.diff(direction, axis=1)).max(axis=1) / (at[1] - at[0])
    assert (sway <= bounds[1:, sweep.SWAY] + 1e-9).all()
    assert math.isfinite(bounds[-1, sweep.SPEED])
    assert math.isfinite(bounds[-1, sweep.GROW]) == (name != "kink")


@pytest.mark.parametrize("name", ROUTES)
def test_distances_stay_between_their_bounds(name: str) -> None:
    route, start = ROUTES[name]
    walk = Walk(Dragon(BENCHES), route)
    for h in (0.4, 0.1, 0.01):
        at = np.linspace(start, start + h, 21)
        ends = chains(walk, at[[0, -1]])
        count = len(walk.dragon)
        handles = np.empty((count + 1, sweep.HANDLE_COLUMNS))
        sweep.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, handles)
        sweeps = np.empty((count, sweep.BENCH_COLUMNS))
        for i in range(count):
            sweep.bound_bench(handles, i, walk.dragon.sizes, i, sweeps[i])
        tables = [boxes(walk.motion([t]), 0) for t in at]
        both = np.concatenate([tables[0], tables[-1]])
        for i in range(count):
            for j in range(i + 2, count):
                sampled = min(box_distance(table, i, j) for table in tables)
                rows = (both, i, j, count + i, count + j, sweeps, i, j, handles[0, sweep.PATH])
                for wanted in (-1.0, 0.0, math.inf):
                    assert sweep.apart_bound(*rows, wanted) <= sampled + 1e-12
                highest = max(box_gap(table, i, j) for table in tables)
                assert sweep.gap_ceiling(*rows) >= highest - 1e-12


def test_second_order_bounds_lose_a_hundredth_for_a_tenth_of_the_step() -> None:
    route, start = ROUTES["spiral"]
    walk = Walk(Dragon(BENCHES), route)
    losses = []
    for h in (0.1, 0.01):
        ends = chains(walk, np.array([start, start + h]))
        handles = np.empty((len(BENCHES) + 1, sweep.HANDLE_COLUMNS))
        sweep.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, handles)
        sweeps = np.empty((2, sweep.BENCH_COLUMNS))
        tables = [boxes(walk.motion([t]), 0)[[0, 3]] for t in (start, start + h)]
        for n, i in enumerate((0, 3)):
            sweep.bound_bench(handles, i, walk.dragon.sizes, i, sweeps[n])
        both = np.concatenate(tables)
        losses.append(sweep.face_loss(both, 0, 1, sweeps, 0, 1, handles[0, sweep.PATH]))
    assert losses[1] == pytest.approx(0.01 * losses[0], rel=0.5)


@pytest.mark.parametrize("name", [name for name in ROUTES if name != "kink"])
def test_cells_hold_the_benches_that_walk_through_them(name: str) -> None:
    route, start = ROUTES[name]
    dragon = Dragon(BENCHES)
    ground = Ground(dragon, route, 10.0, start)
    ground.extend(start + 3.0)
    assert ground.sound.all()
    walk = Walk(dragon, route)
    for s in np.linspace(start, start + 2.9, 23):
        motion = walk.motion([s])
        table = boxes(motion, 0)
        for i in range(len(dragon)):
            cell = math.floor(motion.s[0, i] / ground.cell) - ground.low
            hull = ground.hulls[ground.group[i]]
            for k in range(4):
                along, across = offset(hull, cell, *corner(table, i, k))
                assert abs(along) <= hull[cell, HALF_LENGTH] + 1e-12
                assert abs(across) <= hull[cell, HALF_WIDTH] + 1e-12


def test_a_bench_that_leaps_is_never_said_to_follow() -> None:
    """Round a hairpin tighter than the link the rear handle leaps from leg to leg."""
    route = Route.joined([Line(10.0), Arc(0.45, math.pi), Line(10.0)])
    link = np.array([1.0])
    at = np.linspace(9.0, 13.0, 161)
    places = sweep.empty_places(2, len(at))
    sweep.stand(route.rows, link, at, 0, len(at), places)
    said = []
    for n in range(len(at) - 1):
        if places.failed[0, n] or places.failed[0, n + 1]:
            continue
        bounds = np.empty((2, sweep.HANDLE_COLUMNS))
        sweep.bound_handles(route.rows, link, places, n, n + 1, bounds)
        sure = cells.follows(route.rows, places, n, n + 1, 1.0) and bounds[1, sweep.SPEED] < math.inf
        said.append(sure)
        if sure:
            inner = np.linspace(at[n], at[n + 1], 9)
            fine = sweep.empty_places(2, 9)
            assert sweep.stand(route.rows, link, inner, 0, 9, fine)
            moved = np.hypot(np.diff(fine.x[1]), np.diff(fine.y[1]))
            assert moved.max() <= 1.01 * bounds[1, sweep.SPEED] * (inner[1] - inner[0])
    assert any(said)


def test_a_wide_arc_is_followed_though_it_turns_by_more_than_a_right_angle() -> None:
    route = Route.joined([Line(5.0), Arc(1.0, 6.0), Line(5.0)])
    link = np.array([1.7])
    at = np.linspace(7.0, 7.1, 2)
    places = sweep.empty_places(2, 2)
    assert sweep.stand(route.rows, link, at, 0, 2, places)
    assert sweep.turning(route.rows, places.row[1, 0], places.u[1, 0], 1, places.u[0, 1]) > 1.6
    assert cells.follows(route.rows, places, 0, 1, 1.7)


def spiral_walk(width: float, pitch: float = 0.8) -> Walk:
    sizes = [Bench(1.6, width, 0.1, 0.1), *[Bench(1.0, width, 0.1, 0.1)] * 15]
    return Walk(Dragon(sizes), Route((Spiral(pitch, 18.0, 7.0),)))


def test_a_small_dragons_first_contact_is_where_sampling_sees_one() -> None:
    walk = spiral_walk(0.78)
    found = first_contact(walk, 0.0, 15.0)
    assert found is not None
    assert found.upper - found.lower < 1e-9
    assert clearances(walk.motion([found.upper]))[0] <= 0.0
    assert (clearances(walk.motion(np.linspace(0.0, found.lower, 60))) >= 0.0).all()


def test_a_contact_ends_where_sampling_sees_it_end() -> None:
    walk = spiral_walk(0.76)
    windows = contact_windows(walk, 0.0, 16.0)
    times = np.linspace(0.0, 16.0, 161)
    inside = np.zeros(len(times), dtype=bool)
    for window in windows:
        closes = 16.0 if window.closes is None else window.closes.value
        inside |= (times >= window.opens.value) & (times <= closes)
    assert (inside == (clearances(walk.motion(times)) <= 0.0)).all()


def test_the_least_clearance_is_below_every_sample() -> None:
    walk = spiral_walk(0.3)
    found = least_clearance(walk, 0.0, 12.0)
    sampled = clearances(walk.motion(np.linspace(0.0, 12.0, 61))).min()
    assert found.lower <= found.value <= sampled + 1e-12
    assert found.value > sampled - 0.02
    curve = clearance_curve(walk, np.linspace(0.0, 12.0, 25))
    assert all(low.value >= found.lower for low in curve.minima)


def test_a_margin_no_pair_keeps_to_the_digit_is_a_graze() -> None:
    walk = spiral_walk(0.3)
    low = least_clearance(walk, 4.0, 6.0)
    assert low.witness is not None
    found = first_contact(walk, 4.0, 6.0, margin=low.value)
    if found is not None and found.lower > 4.0:
        assert found.value == pytest.approx(low.witness.time, abs=1e-3)


def test_too_few_looks_leave_a_search_stuck() -> None:
    walk = spiral_walk(0.78)
    hunt = Hunt(walk, 0.0, 15.0, 0.0, lambda _share: None)
    step = next(iter(hunt.steps(0.0)))
    room = search.room(17, 16, len(step.first), 0)
    members, inverse = np.unique(np.concatenate([step.first, step.second]), return_inverse=True)
    for goal in (search.FIRST_TOUCH, search.LEAST):
        note = np.zeros(search.NOTES)
        note[search.NEAREST] = note[search.FLOOR] = math.inf
        ending = search.seek(
            room, goal, walk.route.rows, walk.dragon.links[: members[-1] + 1], walk.dragon.sizes,
            members, inverse[: len(step.first)], inverse[len(step.first) :],
            step.start, step.start + 4.0, 0.0, 1e-13, 1e-13, 2, note,
        )  # fmt: skip
        assert ending == (search.STUCK if goal == search.FIRST_TOUCH else search.GRAZE)


def test_a_ledger_holds_every_look() -> None:
    walk, ledger = spiral_walk(0.78), Ledger()
    (window,) = contact_windows(walk, 0.0, 15.0, most=1, ledger=ledger)
    assert sum(len(chain[0]) for chain in ledger.looks) == window.opens.looks
    assert ledger.cells
    assert ledger.grid


def test_the_greatest_speed_is_above_every_sample() -> None:
    route, _start = ROUTES["joint"]
    walk = Walk(Dragon(BENCHES), route, start=11.0)
    found = greatest_speed(walk, 0.0, 6.0, tolerance=1e-2)
    sampled = walk.motion(np.linspace(0.0, 6.0, 101)).speed.max()
    assert sampled <= found.upper
    assert found.upper <= 1.011 * found.lower


def test_a_pairs_distances_along_a_walk() -> None:
    walk = spiral_walk(0.3)
    motion = walk.motion([0.0, 3.0])
    out = np.empty(2)
    x, y = np.ascontiguousarray(motion.x.T), np.ascontiguousarray(motion.y.T)
    distances_along(walk.dragon.sizes, x, y, 0, 7, out)
    for t in range(2):
        pair = np.empty((2, 6))
        set_box(walk.dragon.sizes, 0, x, y, t, pair, 0)
        set_box(walk.dragon.sizes, 7, x, y, t, pair, 1)
        assert out[t] == box_distance(pair, 0, 1)


def test_a_bench_that_cannot_stand_leaves_its_cell_unsound() -> None:
    route = Route.joined([Line(10.0), Arc(0.3, math.pi), Line(10.0)])
    ground = Ground(Dragon.of_sizes(np.full(3, 1.4), 0.2, 0.1, 0.1), route, 0.1, 8.0)
    ground.extend(14.0)
    assert not ground.sound.all()
    assert ground.sound_until(8.0, 14.0) < 12.0
