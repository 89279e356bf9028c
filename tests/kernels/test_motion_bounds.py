"""Bounds hold everywhere in a step: distances, angles, paths, faces; and who surely follows."""

import itertools
import math

import numpy as np
import pytest

from benchdragon import Arc, Clothoid, Dragon, Line, Route, Walk
from benchdragon.analysis.distance import boxes
from benchdragon.kernels import curve as kernel
from benchdragon.kernels import motion_bounds, separation_bounds, swept_boxes, time_of_impact
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, box_gap, corner, set_box
from benchdragon.kernels.chain import Placements, empty_placements, rates
from benchdragon.kernels.curve import FloatArray, RouteRow
from benchdragon.kernels.motion_bounds import BenchBound, HandleBound
from benchdragon.kernels.time_of_impact import Ending
from benchdragon.model.placement import Placement
from tests.kernels.tried_walks import BENCHES, ROUTES, SMOOTH


def chains(walk: Walk, at: FloatArray) -> Placements:
    places = empty_placements(len(walk.dragon) + 1, len(at))
    assert motion_bounds.place_chain(walk.route.rows, walk.dragon.links, at, 0, len(at), places)
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
    bounds = np.empty((count, motion_bounds.HANDLE_COLUMNS))
    motion_bounds.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, bounds)
    paths = np.hypot(np.diff(places.x, axis=1), np.diff(places.y, axis=1)).sum(axis=1)
    assert (paths <= bounds[:, HandleBound.PATH] + 1e-12).all()
    assert (places.ratio <= bounds[:, [HandleBound.SPEED]] + 1e-12).all()
    assert (places.ratio >= bounds[:, [HandleBound.SLOWEST]] - 1e-12).all()
    rates = np.diff(np.log(places.ratio), axis=1) / (at[1] - at[0])
    assert (rates <= bounds[:, [HandleBound.GROWTH_HIGH]] + 1e-6).all()
    assert (rates >= bounds[:, [HandleBound.GROWTH_LOW]] - 1e-6).all()
    direction = np.unwrap(np.arctan2(-np.diff(places.y, axis=0), -np.diff(places.x, axis=0)), axis=1)
    sway = np.abs(np.diff(direction, axis=1)).max(axis=1) / (at[1] - at[0])
    assert (sway <= bounds[1:, HandleBound.TURNING_RATE] + 1e-9).all()
    assert math.isfinite(bounds[-1, HandleBound.SPEED])
    assert math.isfinite(bounds[-1, HandleBound.GROWTH_HIGH]) == (name != "kink")


@pytest.mark.parametrize("name", SMOOTH)
def test_no_point_outruns_its_bounds(name: str) -> None:
    """Handles' accelerations; paths, speeds, accelerations of corners; how benches turn."""
    route, start = ROUTES[name]
    walk, h = Walk(Dragon(BENCHES), route), 0.05
    at = np.linspace(start, start + h, 41)
    dt = at[1] - at[0]
    places, ends = chains(walk, at), chains(walk, at[[0, -1]])
    handles = np.empty((len(BENCHES) + 1, motion_bounds.HANDLE_COLUMNS))
    motion_bounds.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, handles)
    pulls = np.empty_like(places.u)
    change, turn = np.empty_like(places.u), np.empty((len(BENCHES), len(at)))
    rates(
        route.rows,
        walk.dragon.links,
        places.row,
        places.u,
        places.x,
        places.y,
        places.ratio,
        change,
        turn,
    )
    for i, n in itertools.product(range(len(BENCHES) + 1), range(len(at))):
        bend = kernel.curvature(route.rows, places.row[i, n], places.u[i, n])
        pulls[i, n] = math.hypot(change[i, n], places.ratio[i, n] ** 2 * bend)
    assert (pulls.max(axis=1) <= handles[:, HandleBound.ACCELERATION] + 1e-9).all()
    placed, bench = walk.placement(at), np.empty(motion_bounds.BENCH_COLUMNS)
    tables = [boxes(placed, n) for n in range(len(at))]
    for i in range(len(BENCHES)):
        motion_bounds.bound_bench(handles, i, walk.dragon.sizes, i, bench)
        corners = np.array([[corner(table, i, k) for k in range(4)] for table in tables])
        moved = np.hypot(*np.moveaxis(np.diff(corners, axis=0), -1, 0))
        second = np.hypot(*np.moveaxis(np.diff(corners, 2, axis=0), -1, 0)) / dt**2
        assert moved.sum(axis=0).max() <= bench[BenchBound.TRAVEL]
        assert moved.max() / dt <= bench[BenchBound.POINT_SPEED]
        assert second.max() <= bench[BenchBound.POINT_ACCELERATION] + 1e-6
        assert np.abs(turn[i]).max() <= bench[BenchBound.TURN] + 1e-12
        assert np.abs(np.diff(turn[i])).max() / dt <= bench[BenchBound.ANGULAR_ACCELERATION] + 1e-9


@pytest.mark.parametrize(
    ("path", "bent", "bend", "angle"),
    [(0.3, 0.0, 50.0, 0.3), (0.0, 0.6, 50.0, 0.3), (0.5, 0.0, 0.5, 0.25)],
)
def test_an_angle_may_go_there_and_back_within_a_step(
    path: float, bent: float, bend: float, angle: float
) -> None:
    """At both ends the bench lies along the route; between them it may swing by half of it all.

    Or by what curvature turns a heading by in half the step.
    """
    places = empty_placements(2, 2)
    for table, value in ((places.y, 0.0), (places.ty, 0.0), (places.tx, 1.0), (places.ratio, 1.0)):
        table[:] = value
    places.x[:] = [[1.0, 1.0], [0.0, 0.0]]
    bounds = np.zeros((2, motion_bounds.HANDLE_COLUMNS))
    bounds[:, [HandleBound.PATH, HandleBound.HEADING_CHANGE]] = path, bent
    bounds[:, [HandleBound.RIGHT, HandleBound.LEFT]] = -bend, bend
    bounds[0, [HandleBound.SLOWEST, HandleBound.SPEED]] = 1.0
    motion_bounds.bound_next(1.0, places, 0, 0, 1, 1.0, bounds)
    assert bounds[1, HandleBound.SPEED] >= 1.0 / math.cos(angle)
    assert bounds[1, HandleBound.SLOWEST] <= math.cos(angle)
    assert bounds[1, HandleBound.TURNING_RATE] >= 2.0 * math.sin(angle)


@pytest.mark.parametrize("name", ROUTES)
def test_distances_stay_between_their_bounds(name: str) -> None:
    route, start = ROUTES[name]
    walk = Walk(Dragon(BENCHES), route)
    for h in (0.4, 0.1, 0.01):
        at = np.linspace(start, start + h, 21)
        ends = chains(walk, at[[0, -1]])
        count = len(walk.dragon)
        handles = np.empty((count + 1, motion_bounds.HANDLE_COLUMNS))
        motion_bounds.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, handles)
        sweeps = np.empty((count, motion_bounds.BENCH_COLUMNS))
        for i in range(count):
            motion_bounds.bound_bench(handles, i, walk.dragon.sizes, i, sweeps[i])
        tables = [boxes(walk.motion([t]), 0) for t in at]
        both = np.concatenate([tables[0], tables[-1]])
        for i in range(count):
            for j in range(i + 2, count):
                sampled = min(box_distance(table, i, j) for table in tables)
                rows = (both, sweeps, count, i, j, handles[0, HandleBound.PATH])
                for wanted in (-1.0, 0.0, math.inf):
                    assert separation_bounds.separation_lower_bound(*rows, wanted) <= sampled + 1e-12
                highest = max(box_gap(table, i, j) for table in tables)
                assert separation_bounds.gap_upper_bound(*rows) >= highest - 1e-12


def test_second_order_bounds_lose_a_hundredth_for_a_tenth_of_the_step() -> None:
    route, start = ROUTES["spiral"]
    walk = Walk(Dragon(BENCHES), route)
    losses = []
    for h in (0.1, 0.01):
        ends = chains(walk, np.array([start, start + h]))
        handles = np.empty((len(BENCHES) + 1, motion_bounds.HANDLE_COLUMNS))
        motion_bounds.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, handles)
        sweeps = np.empty((2, motion_bounds.BENCH_COLUMNS))
        tables = [boxes(walk.motion([t]), 0)[[0, 3]] for t in (start, start + h)]
        for n, i in enumerate((0, 3)):
            motion_bounds.bound_bench(handles, i, walk.dragon.sizes, i, sweeps[n])
        both = np.concatenate(tables)
        losses.append(separation_bounds.chord_loss(both, sweeps, 0, 1, handles[0, HandleBound.PATH]))
    assert losses[1] == pytest.approx(0.01 * losses[0], rel=0.5)


def test_a_bench_that_leaps_is_never_said_to_follow() -> None:
    """Round a hairpin tighter than the link the rear handle leaps from leg to leg."""
    route = Route.joined([Line(10.0), Arc(0.45, math.pi), Line(10.0)])
    link = np.array([1.0])
    at = np.linspace(9.0, 13.0, 161)
    places = empty_placements(2, len(at))
    motion_bounds.place_chain(route.rows, link, at, 0, len(at), places)
    said = []
    for n in range(len(at) - 1):
        if places.failed[0, n] or places.failed[0, n + 1]:
            continue
        bounds = np.empty((2, motion_bounds.HANDLE_COLUMNS))
        motion_bounds.bound_handles(route.rows, link, places, n, n + 1, bounds)
        sure = (
            swept_boxes.follows(route.rows, places, n, n + 1, 1.0)
            and bounds[1, HandleBound.SPEED] < math.inf
        )
        said.append(sure)
        if sure:
            inner = np.linspace(at[n], at[n + 1], 9)
            fine = empty_placements(2, 9)
            assert motion_bounds.place_chain(route.rows, link, inner, 0, 9, fine)
            moved = np.hypot(np.diff(fine.x[1]), np.diff(fine.y[1]))
            assert moved.max() <= 1.01 * bounds[1, HandleBound.SPEED] * (inner[1] - inner[0])
    assert any(said)


def test_a_wide_arc_is_followed_though_it_turns_by_more_than_a_right_angle() -> None:
    route = Route.joined([Line(5.0), Arc(1.0, 6.0), Line(5.0)])
    link = np.array([1.7])
    at = np.linspace(7.0, 7.1, 2)
    places = empty_placements(2, 2)
    assert motion_bounds.place_chain(route.rows, link, at, 0, 2, places)
    assert (
        motion_bounds.heading_bound(route.rows, places.row[1, 0], places.u[1, 0], 1, places.u[0, 1])
        > 1.6
    )
    assert swept_boxes.follows(route.rows, places, 0, 1, 1.7)


# Routes on which another place, nearer behind the front handle, comes one link near: a leap.
BUMPS = {
    "S": (2.41179, Route.joined([Line(6.0), Arc(1.22176, 3.0181), Arc(0.6208, -1.9754), Line(9.0)])),
    "loop": (2.0, Route.joined([Line(6.0), Arc(0.8, 5.2), Line(9.0)])),
    "eased loop": (
        2.6,
        Route.joined(
            [Line(6.0), Clothoid(1.5, 0.0, 1.0), Arc(1.0, 4.0), Clothoid(1.5, 1.0, 0.0), Line(9.0)]
        ),
    ),
}


@pytest.mark.parametrize("step", [0.05, 0.2, 0.7])
@pytest.mark.parametrize("name", BUMPS)
def test_a_bench_that_surely_follows_never_leaps_or_folds_in_between(name: str, step: float) -> None:
    link, route = BUMPS[name]
    links = np.array([link])
    at = np.arange(3.0, route.length - step, step)
    places = empty_placements(2, len(at))
    motion_bounds.place_chain(route.rows, links, at, 0, len(at), places)
    sure = 0
    for n in range(len(at) - 1):
        if places.failed[0, n : n + 2].any() or not swept_boxes.follows(
            route.rows, places, n, n + 1, link
        ):
            continue
        sure += 1
        between = np.linspace(at[n], at[n + 1], 25)
        placed = Placement(Dragon.of_sizes([link], 0.1, 0.0, 0.0), route, between)
        assert not placed.status.any()
        moved = np.diff(placed.s[:, 1])
        assert (moved > 0.0).all()
        assert moved.max() < 0.6 * link
    assert sure >= 0.5 * len(at)


def test_a_leap_is_not_overlooked_however_short_the_step() -> None:
    link, route = BUMPS["loop"]
    links, before, after = np.array([link]), 11.0, 11.1
    places = empty_placements(2, 2)

    def stands(a: float, b: float) -> bool:
        return bool(motion_bounds.place_chain(route.rows, links, np.array([a, b]), 0, 2, places))

    while after - before > 1e-9:
        middle = 0.5 * (before + after)
        follows = stands(before, middle) and places.row[1, 1] == places.row[1, 0]
        before, after = (middle, after) if follows else (before, middle)
    tried = 0
    for back in np.geomspace(1e-4, 0.1, 7):
        for ahead in np.geomspace(1e-5, 0.1, 13):
            if stands(before - back, after + ahead):
                assert not swept_boxes.follows(route.rows, places, 0, 1, link)
                tried += 1
    assert tried > 40


def test_paths_and_turns_run_over_all_pieces_and_joints() -> None:
    gap, kink = 3e-4, 0.02
    arc = Arc(0.05, 0.4)
    (x, y), heading = arc.moved((1.0, 0.0), 0.0).end_pose
    curves = (Line(1.0), arc.moved((1.0, 0.0), 0.0), Line(1.0).moved((x, y), heading + kink))
    rows = Route(curves, kinks=True).rows.copy()
    rows[2, RouteRow.Y] += gap
    assert motion_bounds.path_bound(rows, 0, 0.9, 2, 0.1) == pytest.approx(0.2 + 0.02 + gap, abs=1e-12)
    assert motion_bounds.path_bound(rows, 1, 0.01, 2, 0.1) == pytest.approx(0.11 + gap, abs=1e-12)
    assert motion_bounds.heading_bound(rows, 0, 0.9, 2, 0.1) == pytest.approx(0.4 + kink, abs=1e-12)
    assert motion_bounds.heading_bound(rows, 1, 0.01, 2, 0.1) == pytest.approx(0.2 + kink, abs=1e-12)
    assert motion_bounds.curvature_range(rows, 1, 0.01, 2, 0.1) == (-math.inf, math.inf)
    smooth = Route.joined([Line(1.0), arc, Line(1.0)]).rows.copy()
    np.testing.assert_allclose(motion_bounds.curvature_range(smooth, 0, 0.9, 2, 0.1), (0.0, 20.0))
    smooth[1, RouteRow.Y] += 1e-11  # a gap leaps, too
    assert motion_bounds.curvature_range(smooth, 0, 0.9, 1, 0.01) == (-math.inf, math.inf)


def test_a_peak_is_no_lower_than_what_slopes_allow() -> None:
    for start, end, low, high, h in ((0.0, 0.1, -2.0, 1.0, 0.5), (0.3, 0.1, -1.0, 3.0, 0.4)):
        # Up as steeply as may be, then down as steeply as may be.
        turn = (end - start - low * h) / (high - low)
        assert 0.0 < turn < h
        assert motion_bounds.peak(start, end, low, high, h) == pytest.approx(start + high * turn)
    assert motion_bounds.peak(0.0, 0.1, 0.0, 1.0, 0.5) == 0.1
    assert motion_bounds.peak(0.3, 0.1, -1.0, 0.0, 0.5) == 0.3
    assert motion_bounds.peak(0.3, 0.1, -math.inf, 1.0, 0.5) == math.inf


@pytest.mark.parametrize(("nose", "tail"), [(0.4, 0.2), (0.2, 0.4)])
def test_no_point_of_a_bench_moves_farther_than_its_reach(nose: float, tail: float) -> None:
    sizes = np.array([[2.0], [0.6], [nose], [tail]])
    x, y = np.array([[0.0], [-1.4]]), np.zeros((2, 1))
    before, after = np.empty((1, BOX_COLUMNS)), np.empty((1, BOX_COLUMNS))
    set_box(sizes, 0, x, y, 0, before, 0)
    for front, rear in ((1e-6, 0.0), (0.0, 1e-6), (1e-6, 1e-6), (3e-7, 1e-6)):
        most = 0.0
        for a, b in itertools.product(np.linspace(0.0, 2.0 * math.pi, 17), repeat=2):
            dx = np.array([[front * math.cos(a)], [rear * math.cos(b)]])
            dy = np.array([[front * math.sin(a)], [rear * math.sin(b)]])
            set_box(sizes, 0, x + dx, y + dy, 0, after, 0)
            for k in range(4):
                (px, py), (qx, qy) = corner(before, 0, k), corner(after, 0, k)
                most = max(most, math.hypot(px - qx, py - qy))
        bound = motion_bounds.reach(front, rear, sizes, 0)
        assert 0.75 * bound < most <= bound * (1.0 + 1e-5)


# How bench 0 and the one with the face move: velocity, acceleration, turning rate of the other.
FACED = {
    "acceleration of the corner": ((0.0, 0.0), (0.0, 2.0), 0.0, 0.0),
    "speed across a turning face": ((3.0, 0.0), (0.0, 0.0), 1.0, 0.0),
    "a turning face far away": ((0.0, 0.0), (0.0, 0.0), 1.0, 0.0),
    "a face that begins to turn": ((0.0, 0.0), (0.0, 0.0), 0.0, 4.0),
}


@pytest.mark.parametrize("name", FACED)
def test_heights_over_a_face_leave_the_straight_line_by_no_more_than_its_loss(name: str) -> None:
    velocity, acceleration, turn, twist = FACED[name]
    h, table = 0.02, np.zeros((2, BOX_COLUMNS))
    table[0] = (0.6, 0.8, 1.0, 0.0, 0.0, 0.0)  # a point
    table[1] = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0)  # a face through its own middle
    if name.startswith("a "):
        table[0, :2] = (0.0, 2.0) if turn else (2.0, 0.0)
    t = np.linspace(0.0, h, 41)
    x = table[0, 0] + velocity[0] * t + 0.5 * acceleration[0] * t * t
    y = table[0, 1] + velocity[1] * t + 0.5 * acceleration[1] * t * t
    angle = turn * t + 0.5 * twist * t * t
    height = y * np.cos(angle) - x * np.sin(angle)
    off = np.abs(height - np.interp(t, t[[0, -1]], height[[0, -1]])).max()
    sweeps = np.zeros((2, motion_bounds.BENCH_COLUMNS))
    sweeps[0, BenchBound.POINT_SPEED] = math.hypot(*velocity) + h * math.hypot(*acceleration)
    sweeps[0, BenchBound.POINT_ACCELERATION] = math.hypot(*acceleration)
    sweeps[1, BenchBound.TURN], sweeps[1, BenchBound.ANGULAR_ACCELERATION] = (
        turn + twist * h,
        twist,
    )
    loss = separation_bounds.chord_loss(table, sweeps, 0, 1, h)
    assert 0.6 * loss < off <= loss


def test_a_direction_is_lost_to_second_order_by_both_benches() -> None:
    """Benches that come nearer and part again within a step, each by its own acceleration."""
    h, table = 0.1, np.zeros((4, BOX_COLUMNS))
    table[:, 2] = 1.0
    table[:, [4, 5]] = 0.5
    table[[1, 3], 0] = 3.0
    for pulls in ((8.0, 0.0), (0.0, 8.0), (5.0, 3.0)):
        sweeps = np.zeros((2, motion_bounds.BENCH_COLUMNS))
        sweeps[:, BenchBound.POINT_ACCELERATION] = pulls
        nearest = 2.0 - 0.125 * sum(pulls) * h * h
        bound = separation_bounds.nearest_direction_bound(table, sweeps, 2, 0, 1, h)
        assert bound == pytest.approx(nearest, abs=1e-12)
        sweeps[:, BenchBound.TRAVEL] = np.array(pulls) * 0.25 * h * h
        assert separation_bounds.separation_lower_bound(table, sweeps, 2, 0, 1, h, 0.0) <= nearest


def test_faces_that_are_left_and_come_back_lose() -> None:
    h, table = 0.1, np.zeros((4, BOX_COLUMNS))
    table[:, 2] = 1.0
    table[:, [4, 5]] = 0.5
    table[[1, 3], 0] = 3.0
    sweeps = np.zeros((2, motion_bounds.BENCH_COLUMNS))
    sweeps[0, BenchBound.POINT_ACCELERATION] = 8.0
    rows = (table, sweeps, 2, 0, 1, h)
    assert separation_bounds.face_bound(*rows) <= 2.0 - 0.125 * 8.0 * h * h
    assert separation_bounds.face_upper_bound(*rows) >= 2.0 + 0.125 * 8.0 * h * h
    for row in (1, 3):  # farther off at the start, or at the end
        table[[1, 3], 0] = 3.0
        table[row, 0] = 4.0
        assert separation_bounds.face_bound(*rows) < 2.0
        assert separation_bounds.face_upper_bound(*rows) > 3.0


def faced(gap: float, travel: float, pull: float) -> tuple[time_of_impact.Search, FloatArray]:
    """What a search knows of two benches as far apart at both ends of a part, and a fresh note."""
    room = time_of_impact.empty_search(4, 2, 1)
    room.at[:2] = 0.0, 0.1
    room.handles[0, HandleBound.PATH] = 0.1
    room.alive[1, 0], room.kept[1] = 0, 1
    room.boxes[:4] = 0.0
    room.boxes[:4, 2] = 1.0
    room.boxes[:4, [4, 5]] = 0.5
    room.boxes[[1, 3], 0] = 1.0 + gap
    room.sweeps[:] = room.off[:] = 0.0
    room.sweeps[:, BenchBound.TRAVEL], room.sweeps[:, BenchBound.POINT_ACCELERATION] = (
        travel,
        pull,
    )
    return room, np.zeros(time_of_impact.NOTES)


@pytest.mark.parametrize(
    ("travel", "pull", "ending"),
    [
        (0.001, 0.0, Ending.CLEAR),
        (0.05, 0.0, Ending.CLEAR),
        (0.05, 8.0, Ending.SPLIT),
    ],
)
def test_a_contact_lasts_only_if_travel_or_faces_say_so(
    travel: float, pull: float, ending: int
) -> None:
    room, note = faced(-0.01, travel, pull)
    pairs, limits = (
        time_of_impact.Pairs(np.array([0]), np.array([1])),
        time_of_impact.Limits(0.0, 1e-13, 1e-13, 2),
    )
    assert time_of_impact.classify_contact_end(room, 1, 2, pairs, limits, note) == ending


def test_the_least_bound_of_a_part_is_that_of_any_pair() -> None:
    room, note = faced(2.0, 0.1, math.inf)
    room.boxes[[0, 2], 1] = 1.0
    room = room._replace(
        alive=np.array([[0, 0], [0, 1]]), boxes=np.concatenate([room.boxes, room.boxes])
    )
    room.boxes[:6] = room.boxes[[0, 1, 1, 2, 3, 3]]
    room.boxes[[2, 5], 0] = 4.0
    room = room._replace(sweeps=np.repeat(room.sweeps[:1], 3, axis=0))
    for second in ([1, 2], [2, 1]):
        room.kept[1] = 2
        room.alive[1] = 0, 1
        pairs = time_of_impact.Pairs(np.array([0, 0]), np.array(second))
        assert time_of_impact.cull_separated(room, 1, 3, pairs, 9.0, 0.0, note) == pytest.approx(1.9)
        assert room.kept[1] == 2


def test_distances_fall_by_no_more_than_half_the_travel() -> None:
    table = np.zeros((4, BOX_COLUMNS))
    table[:, 2] = 1.0
    table[:, [4, 5]] = 0.5
    table[[1, 3], 0] = 3.0
    sweeps = np.zeros((2, motion_bounds.BENCH_COLUMNS))
    sweeps[:, BenchBound.POINT_ACCELERATION] = math.inf  # as across a kink: there and back, leaping
    for travel in ((0.6, 0.0), (0.0, 0.6), (0.4, 0.2)):
        sweeps[:, BenchBound.TRAVEL] = travel
        assert separation_bounds.separation_lower_bound(
            table, sweeps, 2, 0, 1, 1.0, 0.0
        ) == pytest.approx(1.7)
