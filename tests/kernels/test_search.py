"""Bounds over a step hold at every place in it; searches built on them find what sampling finds."""

import itertools
import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

from benchdragon import (
    Arc,
    Bench,
    Clothoid,
    Dragon,
    Line,
    LogSpiral,
    Route,
    Spiral,
    Walk,
    clearance_curve,
    clearances,
    contact_windows,
    first_contact,
    least_clearance,
)
from benchdragon.analysis.contact_search import ContactSearch, Step, contact_search
from benchdragon.analysis.distance import boxes, pair_distances
from benchdragon.analysis.ledger import Ledger
from benchdragon.analysis.speed import greatest_speed
from benchdragon.analysis.tables import Tables, kinds_of
from benchdragon.errors import WalkError
from benchdragon.kernels import (
    cells,
    course,
    meetings,
    near_cells,
    pair_bounds,
    regions,
    search,
    step_bounds,
)
from benchdragon.kernels import curve as kernel
from benchdragon.kernels.box import (
    BOX_COLUMNS,
    HALF_LENGTH,
    HALF_WIDTH,
    box_distance,
    box_gap,
    corner,
    distances_along,
    offset,
    set_box,
)
from benchdragon.kernels.chain import rates
from benchdragon.kernels.curve import FloatArray, Y
from benchdragon.kernels.route import IntArray
from benchdragon.model.placement import Placement
from benchdragon.progress import silent

BENCHES = [Bench(1.6, 0.4, 0.1, 0.2), *[Bench(1.1, 0.3, 0.1, 0.1)] * 5]
ROUTES = {
    "spiral": (Route((Spiral(0.9, 40.0, 8.0),)), 12.0),
    "arc": (Route.joined([Line(12.0), Arc(1.6, 5.0), Line(9.0)]), 14.0),
    "joint": (Route.joined([Line(12.0), Arc(1.6, 1.0), Arc(2.0, -1.5), Line(9.0)]), 12.9),
    "clothoid": (Route.joined([Line(12.0), Clothoid(3.0, 0.0, 0.6), Arc(1.0 / 0.6, 3.0)]), 15.5),
    "logarithmic spiral": (Route.joined([Line(12.0), LogSpiral(5.0, 0.1, 0.8), Arc(1.25, 3.0)]), 16.5),
    "kink": (
        Route((Line(12.0), Line(9.0).moved((12.0, 0.0), 0.4)), kinks=True),
        11.97,
    ),
}

SMOOTH = [name for name in ROUTES if name != "kink"]


def chains(walk: Walk, at: FloatArray) -> step_bounds.Placements:
    places = step_bounds.empty_placements(len(walk.dragon) + 1, len(at))
    assert step_bounds.place_chain(walk.route.rows, walk.dragon.links, at, 0, len(at), places)
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
    bounds = np.empty((count, step_bounds.HANDLE_COLUMNS))
    step_bounds.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, bounds)
    paths = np.hypot(np.diff(places.x, axis=1), np.diff(places.y, axis=1)).sum(axis=1)
    assert (paths <= bounds[:, step_bounds.PATH] + 1e-12).all()
    assert (places.ratio <= bounds[:, [step_bounds.SPEED]] + 1e-12).all()
    assert (places.ratio >= bounds[:, [step_bounds.SLOWEST]] - 1e-12).all()
    rates = np.diff(np.log(places.ratio), axis=1) / (at[1] - at[0])
    assert (rates <= bounds[:, [step_bounds.GROWTH_HIGH]] + 1e-6).all()
    assert (rates >= bounds[:, [step_bounds.GROWTH_LOW]] - 1e-6).all()
    direction = np.unwrap(np.arctan2(-np.diff(places.y, axis=0), -np.diff(places.x, axis=0)), axis=1)
    sway = np.abs(np.diff(direction, axis=1)).max(axis=1) / (at[1] - at[0])
    assert (sway <= bounds[1:, step_bounds.TURNING_RATE] + 1e-9).all()
    assert math.isfinite(bounds[-1, step_bounds.SPEED])
    assert math.isfinite(bounds[-1, step_bounds.GROWTH_HIGH]) == (name != "kink")


@pytest.mark.parametrize("name", SMOOTH)
def test_no_point_outruns_its_bounds(name: str) -> None:
    """Handles' accelerations; paths, speeds, accelerations of corners; how benches turn."""
    route, start = ROUTES[name]
    walk, h = Walk(Dragon(BENCHES), route), 0.05
    at = np.linspace(start, start + h, 41)
    dt = at[1] - at[0]
    places, ends = chains(walk, at), chains(walk, at[[0, -1]])
    handles = np.empty((len(BENCHES) + 1, step_bounds.HANDLE_COLUMNS))
    step_bounds.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, handles)
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
    assert (pulls.max(axis=1) <= handles[:, step_bounds.ACCELERATION] + 1e-9).all()
    placed, bench = walk.placement(at), np.empty(step_bounds.BENCH_COLUMNS)
    tables = [boxes(placed, n) for n in range(len(at))]
    for i in range(len(BENCHES)):
        step_bounds.bound_bench(handles, i, walk.dragon.sizes, i, bench)
        corners = np.array([[corner(table, i, k) for k in range(4)] for table in tables])
        moved = np.hypot(*np.moveaxis(np.diff(corners, axis=0), -1, 0))
        second = np.hypot(*np.moveaxis(np.diff(corners, 2, axis=0), -1, 0)) / dt**2
        assert moved.sum(axis=0).max() <= bench[step_bounds.TRAVEL]
        assert moved.max() / dt <= bench[step_bounds.POINT_SPEED]
        assert second.max() <= bench[step_bounds.POINT_ACCELERATION] + 1e-6
        assert np.abs(turn[i]).max() <= bench[step_bounds.TURN] + 1e-12
        assert np.abs(np.diff(turn[i])).max() / dt <= bench[step_bounds.ANGULAR_ACCELERATION] + 1e-9


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
    places = step_bounds.empty_placements(2, 2)
    for table, value in ((places.y, 0.0), (places.ty, 0.0), (places.tx, 1.0), (places.ratio, 1.0)):
        table[:] = value
    places.x[:] = [[1.0, 1.0], [0.0, 0.0]]
    bounds = np.zeros((2, step_bounds.HANDLE_COLUMNS))
    bounds[:, [step_bounds.PATH, step_bounds.HEADING_CHANGE]] = path, bent
    bounds[:, [step_bounds.RIGHT, step_bounds.LEFT]] = -bend, bend
    bounds[0, [step_bounds.SLOWEST, step_bounds.SPEED]] = 1.0
    step_bounds.bound_next(1.0, places, 0, 0, 1, 1.0, bounds)
    assert bounds[1, step_bounds.SPEED] >= 1.0 / math.cos(angle)
    assert bounds[1, step_bounds.SLOWEST] <= math.cos(angle)
    assert bounds[1, step_bounds.TURNING_RATE] >= 2.0 * math.sin(angle)


@pytest.mark.parametrize("name", ROUTES)
def test_distances_stay_between_their_bounds(name: str) -> None:
    route, start = ROUTES[name]
    walk = Walk(Dragon(BENCHES), route)
    for h in (0.4, 0.1, 0.01):
        at = np.linspace(start, start + h, 21)
        ends = chains(walk, at[[0, -1]])
        count = len(walk.dragon)
        handles = np.empty((count + 1, step_bounds.HANDLE_COLUMNS))
        step_bounds.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, handles)
        sweeps = np.empty((count, step_bounds.BENCH_COLUMNS))
        for i in range(count):
            step_bounds.bound_bench(handles, i, walk.dragon.sizes, i, sweeps[i])
        tables = [boxes(walk.motion([t]), 0) for t in at]
        both = np.concatenate([tables[0], tables[-1]])
        for i in range(count):
            for j in range(i + 2, count):
                sampled = min(box_distance(table, i, j) for table in tables)
                rows = (both, sweeps, count, i, j, handles[0, step_bounds.PATH])
                for wanted in (-1.0, 0.0, math.inf):
                    assert pair_bounds.apart_bound(*rows, wanted) <= sampled + 1e-12
                highest = max(box_gap(table, i, j) for table in tables)
                assert pair_bounds.gap_ceiling(*rows) >= highest - 1e-12


def test_second_order_bounds_lose_a_hundredth_for_a_tenth_of_the_step() -> None:
    route, start = ROUTES["spiral"]
    walk = Walk(Dragon(BENCHES), route)
    losses = []
    for h in (0.1, 0.01):
        ends = chains(walk, np.array([start, start + h]))
        handles = np.empty((len(BENCHES) + 1, step_bounds.HANDLE_COLUMNS))
        step_bounds.bound_handles(route.rows, walk.dragon.links, ends, 0, 1, handles)
        sweeps = np.empty((2, step_bounds.BENCH_COLUMNS))
        tables = [boxes(walk.motion([t]), 0)[[0, 3]] for t in (start, start + h)]
        for n, i in enumerate((0, 3)):
            step_bounds.bound_bench(handles, i, walk.dragon.sizes, i, sweeps[n])
        both = np.concatenate(tables)
        losses.append(pair_bounds.face_loss(both, sweeps, 0, 1, handles[0, step_bounds.PATH]))
    assert losses[1] == pytest.approx(0.01 * losses[0], rel=0.5)


def searched(
    dragon: Dragon, route: Route, span: tuple[float, float], reach: float, slack: float = 1e-13
) -> ContactSearch:
    """A search of a walk that has looked for all steps in which pairs may come within reach."""
    found = ContactSearch(Walk(dragon, route), *span, 0.0, silent, slack)
    found.begin(reach)
    assert all(step.start < step.end for step in found.steps())
    return found


def groups_of(dragon: Dragon) -> IntArray:
    """The group of each bench."""
    kind, kinds = kinds_of(dragon.sizes)
    return kinds.group[kind]


@pytest.mark.parametrize("row", range(4))
def test_benches_are_of_as_many_kinds_as_sizes(row: int) -> None:
    sizes = np.tile([[2.0], [0.4], [0.2], [0.3]], 7)
    sizes[row, [1, 2, 5]] += 0.1
    sizes[row, 6] += 0.05
    kind, kinds = kinds_of(sizes)
    assert kind.tolist() == [0, 1, 1, 0, 0, 1, 2]
    assert (kinds.sizes[:, kind] == sizes).all()


def row_of(ground: cells.Ground, group: int, s: float) -> int:
    """The row of the box of the cell in which a front handle of the group is at s, m."""
    cell = math.floor(s / float(ground.measures[cells.CELL])) - int(ground.counts[cells.LOW])
    return group * len(ground.middles) + cell


def search_one(
    found: ContactSearch, goal: int, step: Step, note: FloatArray, tolerance: float = 0.0
) -> int:
    """Search one step alone, whose pairs are what it says: see `ContactSearch.search`."""
    tables, count = found.tables, len(step.first)
    placed = int(tables.course.tally[course.PLACED])
    tables.go(step.end, step.end)
    tables.course.way[course.STEP_START] = step.start
    tables.course.tally[[course.PAIRS, course.PLACED]] = count, placed
    tables.meeting.first[:count], tables.meeting.second[:count] = step.first, step.second
    return found.search(goal, note, tolerance)


def search_step(
    room: search.Search,
    goal: int,
    chain: search.Chain,
    pairs: search.Pairs,
    start: float,
    end: float,
    limits: search.Limits,
    note: FloatArray,
) -> int:
    """Search one step with the kernels alone."""  # fmt: skip
    top = search.open_step(room, len(pairs.first), start, end)
    return search.bisect(room, goal, chain, pairs, top, 0, limits, note)


def without_spans(tables: Tables, begin: Callable[[Tables], None] = Tables.begin) -> None:
    """Begin a search that knows of no span in which benches keep apart."""
    begin(tables)
    assert (tables.ground.spans[:, 0] < tables.ground.spans[:, 1]).any()
    tables.ground.spans[:] = math.inf, -math.inf


MIXED = [Bench(1.6, 0.4, 0.1, 0.2), *[Bench(1.0 + 0.1 * n, 0.7 - 0.1 * n, 0.1, 0.1) for n in range(5)]]

# In each group of sizes a broad bench and, boxed after it, a slim one.
CONTRARY = [
    Bench(length + 0.01 * (width < 1.0), width, 0.1, 0.1)
    for length in (1.0, 1.2, 1.4)
    for width in (1.2, 0.2)
]


@pytest.mark.compiled
@pytest.mark.parametrize("benches", [BENCHES, MIXED, CONTRARY], ids=["alike", "mixed", "contrary"])
@pytest.mark.parametrize("name", SMOOTH)
def test_cells_hold_the_benches_that_walk_through_them(name: str, benches: list[Bench]) -> None:
    route, start = ROUTES[name]
    dragon = Dragon(benches)
    ground = searched(dragon, route, (start, start + 3.0), 10.0).tables.ground
    assert ground.counts[cells.DOUBTS] == 0
    walk, group = Walk(dragon, route), groups_of(dragon)
    for s in np.linspace(start, start + 2.9, 23):
        motion = walk.motion([s])
        table = boxes(motion, 0)
        for i in range(len(dragon)):
            row = row_of(ground, int(group[i]), float(motion.s[0, i]))
            for k in range(4):
                along, across = offset(ground.hulls, row, *corner(table, i, k))
                assert abs(along) <= ground.hulls[row, HALF_LENGTH] + 1e-12
                assert abs(across) <= ground.hulls[row, HALF_WIDTH] + 1e-12


@pytest.mark.parametrize("name", SMOOTH)
def test_cells_leave_room_for_how_far_corners_bulge_between_their_borders(name: str) -> None:
    """A corner's way bulges from its chord by an eighth of the square of the step times its bend."""
    route, start = ROUTES[name]
    dragon = Dragon(BENCHES)
    ground = searched(dragon, route, (start, start + 3.0), 10.0).tables.ground
    hull, most, size = ground.hulls, 0.0, float(ground.measures[cells.CELL])
    group = int(groups_of(dragon)[0])
    for cell in range(int(start / size) + 1, int((start + 2.5) / size)):
        borders = np.array([cell, cell + 0.5, cell + 1.0]) * size
        row = row_of(ground, group, (cell + 0.5) * size)
        tables = [boxes(Walk(dragon, route).motion([s]), 0) for s in borders]
        for k in range(4):
            first, middle, last = (np.array(corner(table, 0, k)) for table in tables)
            bulge = 0.5 * float(np.hypot(*(first - 2.0 * middle + last)))
            most = max(most, bulge)
            for x, y in (first, last):
                along, across = offset(hull, row, x, y)
                assert abs(along) + 0.99 * bulge <= hull[row, HALF_LENGTH] + 1e-12
                assert abs(across) + 0.99 * bulge <= hull[row, HALF_WIDTH] + 1e-12
    assert most > 1e-4


def test_a_bench_that_leaps_is_never_said_to_follow() -> None:
    """Round a hairpin tighter than the link the rear handle leaps from leg to leg."""
    route = Route.joined([Line(10.0), Arc(0.45, math.pi), Line(10.0)])
    link = np.array([1.0])
    at = np.linspace(9.0, 13.0, 161)
    places = step_bounds.empty_placements(2, len(at))
    step_bounds.place_chain(route.rows, link, at, 0, len(at), places)
    said = []
    for n in range(len(at) - 1):
        if places.failed[0, n] or places.failed[0, n + 1]:
            continue
        bounds = np.empty((2, step_bounds.HANDLE_COLUMNS))
        step_bounds.bound_handles(route.rows, link, places, n, n + 1, bounds)
        sure = (
            regions.follows(route.rows, places, n, n + 1, 1.0)
            and bounds[1, step_bounds.SPEED] < math.inf
        )
        said.append(sure)
        if sure:
            inner = np.linspace(at[n], at[n + 1], 9)
            fine = step_bounds.empty_placements(2, 9)
            assert step_bounds.place_chain(route.rows, link, inner, 0, 9, fine)
            moved = np.hypot(np.diff(fine.x[1]), np.diff(fine.y[1]))
            assert moved.max() <= 1.01 * bounds[1, step_bounds.SPEED] * (inner[1] - inner[0])
    assert any(said)


def test_a_wide_arc_is_followed_though_it_turns_by_more_than_a_right_angle() -> None:
    route = Route.joined([Line(5.0), Arc(1.0, 6.0), Line(5.0)])
    link = np.array([1.7])
    at = np.linspace(7.0, 7.1, 2)
    places = step_bounds.empty_placements(2, 2)
    assert step_bounds.place_chain(route.rows, link, at, 0, 2, places)
    assert (
        step_bounds.heading_bound(route.rows, places.row[1, 0], places.u[1, 0], 1, places.u[0, 1]) > 1.6
    )
    assert regions.follows(route.rows, places, 0, 1, 1.7)


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


@pytest.mark.compiled
def test_the_least_clearance_is_below_every_sample() -> None:
    walk = spiral_walk(0.3)
    found = least_clearance(walk, 0.0, 12.0)
    sampled = clearances(walk.motion(np.linspace(0.0, 12.0, 61))).min()
    assert found.lower <= found.value <= sampled + 1e-12
    assert found.value > sampled - 0.02
    curve = clearance_curve(walk, np.linspace(0.0, 12.0, 25))
    assert all(low.value >= found.lower for low in curve.minima)


@pytest.mark.compiled
def test_a_margin_no_pair_keeps_to_the_digit_is_a_graze() -> None:
    walk = spiral_walk(0.3)
    low = least_clearance(walk, 4.0, 6.0)
    assert low.witness is not None
    found = first_contact(walk, 4.0, 6.0, margin=low.value)
    if found is not None and found.lower > 4.0:
        assert found.value == pytest.approx(low.witness.time, abs=1e-3)


def search_chain(walk: Walk, members: IntArray) -> search.Chain:
    """The benches up to the last of the members, on the walk's route."""
    dragon, links = walk.dragon, walk.dragon.links[: members[-1] + 1]
    return search.Chain(
        walk.route.rows, links, np.empty(0), dragon.sizes, members, np.empty((0, BOX_COLUMNS))
    )


def test_too_few_looks_leave_a_search_stuck() -> None:
    walk = spiral_walk(0.78)
    step = next(iter(ContactSearch(walk, 0.0, 15.0, 0.0, silent).steps()))
    room = search.room(17, 16, len(step.first), 0)
    members, inverse = np.unique(np.concatenate([step.first, step.second]), return_inverse=True)
    for goal in (search.FIRST_TOUCH, search.LEAST):
        note = np.zeros(search.NOTES)
        note[search.NEAREST] = note[search.FLOOR] = math.inf
        ending = search_step(
            room, goal, search_chain(walk, members), search.Pairs(*np.split(inverse, 2)),
            step.start, step.start + 4.0, search.Limits(0.0, 1e-13, 1e-13, 2), note,
        )  # fmt: skip
        assert ending == (search.STUCK if goal == search.FIRST_TOUCH else search.GRAZE)


def test_a_ledger_holds_every_look() -> None:
    walk, ledger = spiral_walk(0.78), Ledger()
    (window,) = contact_windows(walk, 0.0, 15.0, most=1, ledger=ledger)
    assert sum(len(chain[0]) for chain in ledger.evaluations) == window.opens.evaluations
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


def test_a_bench_that_cannot_stand_leaves_its_cell_in_doubt() -> None:
    route = Route.joined([Line(10.0), Arc(0.3, math.pi), Line(10.0)])
    dragon = Dragon.of_sizes(np.full(3, 1.4), 0.2, 0.1, 0.1)
    found = ContactSearch(Walk(dragon, route), 8.0, 14.0, 0.0, silent)
    found.begin(10.0)
    steps: list[Step] = []
    with pytest.raises(WalkError):
        steps.extend(found.steps())  # all that came before the failure
    known, sound = found.tables.course.way[[course.KNOWN, course.SOUND]].tolist()
    # The head's own bench folds at 10.64 m; hulls hold it up to the cell of that place.
    assert known < sound < 12.0
    assert known > sound - float(found.tables.ground.measures[cells.CELL]) - 1e-6
    assert steps[-1].end == sound
    assert steps[-1].start >= known
    searched(dragon, route, (8.0, known), 0.1)  # raises nothing
    stands = Placement(dragon, route, [sound, sound + 1e-6])
    assert [bool(status) for status in stands.status] == [False, True]


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
    places = step_bounds.empty_placements(2, len(at))
    step_bounds.place_chain(route.rows, links, at, 0, len(at), places)
    sure = 0
    for n in range(len(at) - 1):
        if places.failed[0, n : n + 2].any() or not regions.follows(route.rows, places, n, n + 1, link):
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
    places = step_bounds.empty_placements(2, 2)

    def stands(a: float, b: float) -> bool:
        return bool(step_bounds.place_chain(route.rows, links, np.array([a, b]), 0, 2, places))

    while after - before > 1e-9:
        middle = 0.5 * (before + after)
        follows = stands(before, middle) and places.row[1, 1] == places.row[1, 0]
        before, after = (middle, after) if follows else (before, middle)
    tried = 0
    for back in np.geomspace(1e-4, 0.1, 7):
        for ahead in np.geomspace(1e-5, 0.1, 13):
            if stands(before - back, after + ahead):
                assert not regions.follows(route.rows, places, 0, 1, link)
                tried += 1
    assert tried > 40


def test_paths_and_turns_run_over_all_pieces_and_joints() -> None:
    gap, kink = 3e-4, 0.02
    arc = Arc(0.05, 0.4)
    (x, y), heading = arc.moved((1.0, 0.0), 0.0).end_pose
    curves = (Line(1.0), arc.moved((1.0, 0.0), 0.0), Line(1.0).moved((x, y), heading + kink))
    rows = Route(curves, kinks=True).rows.copy()
    rows[2, Y] += gap
    assert step_bounds.path_bound(rows, 0, 0.9, 2, 0.1) == pytest.approx(0.2 + 0.02 + gap, abs=1e-12)
    assert step_bounds.path_bound(rows, 1, 0.01, 2, 0.1) == pytest.approx(0.11 + gap, abs=1e-12)
    assert step_bounds.heading_bound(rows, 0, 0.9, 2, 0.1) == pytest.approx(0.4 + kink, abs=1e-12)
    assert step_bounds.heading_bound(rows, 1, 0.01, 2, 0.1) == pytest.approx(0.2 + kink, abs=1e-12)
    assert step_bounds.curvature_range(rows, 1, 0.01, 2, 0.1) == (-math.inf, math.inf)
    smooth = Route.joined([Line(1.0), arc, Line(1.0)]).rows.copy()
    np.testing.assert_allclose(step_bounds.curvature_range(smooth, 0, 0.9, 2, 0.1), (0.0, 20.0))
    smooth[1, Y] += 1e-11  # a gap leaps, too
    assert step_bounds.curvature_range(smooth, 0, 0.9, 1, 0.01) == (-math.inf, math.inf)


def test_a_peak_is_no_lower_than_what_slopes_allow() -> None:
    for start, end, low, high, h in ((0.0, 0.1, -2.0, 1.0, 0.5), (0.3, 0.1, -1.0, 3.0, 0.4)):
        # Up as steeply as may be, then down as steeply as may be.
        turn = (end - start - low * h) / (high - low)
        assert 0.0 < turn < h
        assert step_bounds.peak(start, end, low, high, h) == pytest.approx(start + high * turn)
    assert step_bounds.peak(0.0, 0.1, 0.0, 1.0, 0.5) == 0.1
    assert step_bounds.peak(0.3, 0.1, -1.0, 0.0, 0.5) == 0.3
    assert step_bounds.peak(0.3, 0.1, -math.inf, 1.0, 0.5) == math.inf


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
        bound = step_bounds.reach(front, rear, sizes, 0)
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
    sweeps = np.zeros((2, step_bounds.BENCH_COLUMNS))
    sweeps[0, step_bounds.POINT_SPEED] = math.hypot(*velocity) + h * math.hypot(*acceleration)
    sweeps[0, step_bounds.POINT_ACCELERATION] = math.hypot(*acceleration)
    sweeps[1, step_bounds.TURN], sweeps[1, step_bounds.ANGULAR_ACCELERATION] = turn + twist * h, twist
    loss = pair_bounds.face_loss(table, sweeps, 0, 1, h)
    assert 0.6 * loss < off <= loss


def test_a_direction_is_lost_to_second_order_by_both_benches() -> None:
    """Benches that come nearer and part again within a step, each by its own acceleration."""
    h, table = 0.1, np.zeros((4, BOX_COLUMNS))
    table[:, 2] = 1.0
    table[:, [4, 5]] = 0.5
    table[[1, 3], 0] = 3.0
    for pulls in ((8.0, 0.0), (0.0, 8.0), (5.0, 3.0)):
        sweeps = np.zeros((2, step_bounds.BENCH_COLUMNS))
        sweeps[:, step_bounds.POINT_ACCELERATION] = pulls
        nearest = 2.0 - 0.125 * sum(pulls) * h * h
        bound = pair_bounds.facing_bound(table, sweeps, 2, 0, 1, h)
        assert bound == pytest.approx(nearest, abs=1e-12)
        sweeps[:, step_bounds.TRAVEL] = np.array(pulls) * 0.25 * h * h
        assert pair_bounds.apart_bound(table, sweeps, 2, 0, 1, h, 0.0) <= nearest


def partnered(
    wanted: npt.NDArray[np.bool_], low: int, size: float
) -> tuple[cells.Ground, Callable[[FloatArray, IntArray, int], set[tuple[int, int]]]]:
    """Ground whose part (a, c) has the parts wanted[a, c] as partners, and its pairs of benches.

    Parts are `size` metres long, from the `low`-th on, and a cell has PARTS of them.
    """
    groups, parts = wanted.shape[:2]
    whole = parts // cells.PARTS
    dragon = Dragon.uniform(12, 2.2)
    tables = ContactSearch(Walk(dragon, Route((Line(99.0),))), 40.0, 41.0, 0.0, silent).tables
    rows = groups * whole
    tree = np.zeros((rows * (1 + cells.PARTS), cells.TREE_COLUMNS), dtype=np.int64)
    tree[:rows, cells.CHILD] = rows + np.arange(rows) * cells.PARTS
    tree[rows:, cells.GROUP] = np.repeat(np.arange(groups), parts)
    tree[rows:, cells.NUMBER] = np.tile(np.arange(parts), groups)
    ground = tables.ground._replace(
        tree=tree,
        middles=np.empty((whole, 2)),
        partners=np.empty((int(wanted.sum()), 2), dtype=np.int64),
        near=np.empty((1, 2), dtype=np.int64),
    )
    ground.counts[:] = 0
    ground.counts[[cells.GROUPS, cells.CELLS, cells.LOW]] = groups, whole, low // cells.PARTS
    ground.measures[cells.CELL] = size * cells.PARTS
    for a, c, b, d in np.argwhere(wanted).tolist():
        near_cells.add_partners(ground, rows + a * parts + c, rows + b * parts + d)

    def pairs(s: FloatArray, group: IntArray, most: int) -> set[tuple[int, int]]:
        first, second = np.empty((2, most), dtype=np.int64)
        benches = tables.walk.benches._replace(kind=group)
        kinds = cells.Kinds(tables.walk.kinds.sizes, np.arange(groups))
        found = meetings.meeting_pairs(benches, kinds, ground, s, 0, len(group), first, second)
        named = set(zip(first[:found].tolist(), second[:found].tolist(), strict=True))
        assert len(named) == found
        return named

    return ground, pairs


@pytest.mark.parametrize("seed", range(4))
def test_all_pairs_whose_cells_are_partners_meet(seed: int) -> None:
    rng = np.random.default_rng(seed)
    benches, count, groups, low, size = 12, 8, 2, -4, 0.7
    s = np.sort(rng.uniform(low * size, (low + count) * size, (benches, 1)), axis=0)[::-1]
    s = np.ascontiguousarray(s + np.array([0.0, 0.15]))
    group = rng.integers(0, groups, benches)
    wanted = rng.random((groups, count, groups, count)) < 0.2
    _ground, pairs_of = partnered(wanted, low, size)
    spans = np.floor(s / size).astype(int) - low
    meeting = set()
    for i, j in itertools.product(range(benches), repeat=2):
        if j >= i + 2:
            mine, its = ((span[0], min(span[1], count - 1)) for span in (spans[i], spans[j]))
            block = wanted[group[i], mine[0] : mine[1] + 1, group[j], its[0] : its[1] + 1]
            meeting |= {(i, j)} if block.any() else set()
    assert meeting
    assert pairs_of(s, group, 200) == meeting


def test_route_positions_near_a_border_count_on_both_sides() -> None:
    for ahead, behind in ((3.0 - 5e-8, 0.5), (3.5, 1.0 - 5e-8), (4.0 + 5e-8, 0.5), (3.5, 2.0 + 5e-8)):
        # Who stands in part 3 meets who stands in part 0 or 1.
        wanted = np.zeros((1, 4, 1, 4), dtype=bool)
        wanted[0, 3, 0, 1 if behind > 0.5 else 0] = True
        _ground, pairs_of = partnered(wanted, 0, 1.0)
        s = np.array([[ahead] * 2, [2.5, 2.5], [behind] * 2])
        assert pairs_of(s, np.zeros(3, dtype=np.int64), 9) == {(0, 2)}


MEETINGS = {
    "hairpin": (Route.joined([Line(20.0), Arc(0.8, math.pi), Line(20.0)]), 18.0, 29.0, 1.2),
    "loop": (Route.joined([Line(16.0), Arc(1.5, 5.8), Line(12.0)]), 17.0, 27.0, 0.0),
    "inwards": (Route((Spiral(0.7, 26.0, 8.0),)), 24.0, 33.0, 0.4),
    "outwards": (Route((Spiral(0.75, 8.0, 26.0),)), 14.0, 27.0, 0.45),
    **dict.fromkeys(
        ("head alone", "benches alike", "wide followers"),  # all for a while only
        (Route.joined([Line(20.0), Arc(0.8, 2.8), Line(20.0)]), 18.0, 32.0, 0.45),
    ),
}
SIZES = Dragon([Bench(1.7, 0.4, 0.2, 0.3), *[Bench(1.1, 0.3, 0.1, 0.1)] * 9, Bench(2.0, 0.5, 0.1, 0.4)])
MEETING_SIZES = {
    "head alone": Dragon([Bench(1.7, 2.0, 0.2, 0.3), *[Bench(1.1, 0.3, 0.1, 0.1)] * 10]),
    "benches alike": Dragon([Bench(1.1, 1.1, 0.1, 0.1)] * 11),
    "wide followers": Dragon([Bench(1.7, 0.3, 0.2, 0.3), *[Bench(1.1, 1.1, 0.1, 0.1)] * 10]),
}


@pytest.mark.compiled
@pytest.mark.parametrize("name", MEETINGS)
def test_no_pair_comes_near_but_in_the_steps_that_name_it(name: str) -> None:
    route, start, end, reach = MEETINGS[name]
    sizes = MEETING_SIZES.get(name, SIZES)
    walk = Walk(sizes, route)
    at = np.linspace(start, end, 100)
    placed = walk.placement(at)
    found = ContactSearch(walk, start, end, 0.0, silent)
    found.begin(reach)
    named: list[set[tuple[int, int]]] = [set() for _s in at]
    for step in found.steps():
        inside = np.flatnonzero((at >= step.start) & (at <= step.end))
        for n in inside.tolist():
            named[n] |= set(zip(step.first.tolist(), step.second.tolist(), strict=True))
    near = 0
    for n in range(len(at)):
        table = boxes(placed, n)
        for i, j in itertools.combinations(range(len(sizes)), 2):
            if j >= i + 2 and box_distance(table, i, j) <= reach:
                near += 1
                assert (i, j) in named[n]
    assert 20 < near < sum(map(len, named))


def test_steps_go_on_to_the_very_end_of_a_walk_without_a_gap() -> None:
    """Benches 1 and 3 are within reach all along."""
    sizes = Dragon([Bench(1.7, 0.4, 0.2, 0.3), *[Bench(1.1, 0.3, 0.1, 0.1)] * 2])
    size = 0.25 * 0.45 * float(sizes.links.min())
    for parts in (91.9, 99.0, 100.0 - 1e-6):
        search_of = ContactSearch(
            Walk(sizes, Route((Line(30.0),))), 8.0, 8.0 + parts * size, 0.0, silent
        )
        search_of.begin(10.0)
        steps = list(search_of.steps())
        assert (steps[0].start, steps[-1].end) == (8.0, 8.0 + parts * size)
        for step, after in itertools.pairwise(steps):
            assert step.end == after.start
        assert all((step.first.tolist(), step.second.tolist()) == ([0], [2]) for step in steps)


def test_a_step_begins_with_the_chain_of_the_one_before_or_its_own() -> None:
    """Steps that join reach from few handles to many, and leave a gap: each is searched as alone."""
    walk = spiral_walk(0.3)
    together, steps = ContactSearch(walk, 9.0, 12.0, 0.0, silent), []
    for start, end, j in ((9.0, 9.1, 7), (9.1, 9.2, 15), (9.2, 9.3, 6), (10.0, 10.1, 6), (9.3, 9.4, 8)):
        steps.append(Step(start, end, np.array([0]), np.array([j])))
    for step in steps:
        notes = []
        for found in (together, ContactSearch(walk, 9.0, 12.0, 0.0, silent)):
            note = np.zeros(search.NOTES)
            note[search.NEAREST] = note[search.FLOOR] = math.inf
            assert search_one(found, search.LEAST, step, note, 1e-9) == search.CLEAR
            notes.append(note[[search.NEAREST, search.PAIR]].tolist())
        assert notes[0] == notes[1]


def test_what_benches_behind_may_reach_is_boxed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A head on its way in meets benches that are in a clear span with each other."""
    walk = Walk(Dragon.uniform(40), Route((Spiral(0.5, 36.0 * math.pi, 0.5 * math.pi),)), start=400.0)
    bounds, boxed = [], []
    for _turn in range(2):
        found = contact_search(walk, 0.0, 45.0, 0.0, silent)
        note = np.zeros(search.NOTES)
        assert found.search(search.FIRST_TOUCH, note) == search.FOUND
        bounds.append(note[[search.LOWER, search.UPPER, search.PAIR]].tolist())
        ground, count = found.tables.ground, int(found.tables.ground.counts[cells.CELLS])
        whole = ground.tree[: 2 * len(ground.middles)].reshape(2, -1, cells.TREE_COLUMNS)
        boxed.append(int((whole[:, :count, cells.STATE] == cells.BOXED).sum()))
        monkeypatch.setattr(Tables, "begin", without_spans)
    assert bounds[0] == pytest.approx(bounds[1], abs=1e-10)
    assert boxed[0] < boxed[1]


def test_a_search_that_gives_up_says_how_low_it_may_be() -> None:
    walk = spiral_walk(0.3)
    contact_search = ContactSearch(walk, 0.0, 12.0, 0.0, silent)
    contact_search.begin(0.6)
    step = next(iter(contact_search.steps()))
    least = min(
        float(np.min(pair_distances(walk.placement(np.linspace(step.start, step.end, 200)), i, j)))
        for i, j in zip(step.first.tolist(), step.second.tolist(), strict=True)
    )
    members, inverse = np.unique(np.concatenate([step.first, step.second]), return_inverse=True)
    for most in (2, 3, 5):
        note = np.zeros(search.NOTES)
        note[search.NEAREST] = note[search.FLOOR] = math.inf
        ending = search_step(
            search.room(17, 16, len(step.first), 0), search.LEAST, search_chain(walk, members),
            search.Pairs(*np.split(inverse, 2)), step.start, step.end,
            search.Limits(0.0, 1e-13, 1e-13, most), note,
        )  # fmt: skip
        assert ending == search.GRAZE
        assert 0.0 < note[search.FLOOR] <= least
        assert note[search.NEAREST] >= least


def test_what_was_given_up_first_is_not_forgotten() -> None:
    """Across a kink bounds are loose; behind it they are narrow, and lie higher."""
    route, start = ROUTES["kink"]
    chain = search_chain(Walk(Dragon(BENCHES), route), np.array([0, 2]))
    pairs = search.Pairs(np.array([0]), np.array([1]))
    floors = []
    for end in (start + 0.05, start + 0.2):
        note = np.zeros(search.NOTES)
        note[search.NEAREST] = note[search.FLOOR] = math.inf
        search_step(
            search.room(4, 2, 1, 0), search.LEAST, chain, pairs, start, end,
            search.Limits(0.0, 1e-9, 0.06, 100), note,
        )  # fmt: skip
        floors.append(note[search.FLOOR])
    assert 0.0 < floors[1] <= floors[0] + 1e-12 < math.inf


def test_a_contact_at_the_very_end_of_a_step_is_found() -> None:
    walk = spiral_walk(0.78)
    found = first_contact(walk, 0.0, 15.0)
    assert found is not None
    last = first_contact(walk, found.lower - 0.3, found.upper + 1e-14)
    assert last is not None
    assert last.status == "found"
    assert found.lower <= last.upper <= found.upper + 1e-13
    assert first_contact(walk, 0.0, found.lower - 1e-12) is None


def test_faces_that_are_left_and_come_back_lose() -> None:
    h, table = 0.1, np.zeros((4, BOX_COLUMNS))
    table[:, 2] = 1.0
    table[:, [4, 5]] = 0.5
    table[[1, 3], 0] = 3.0
    sweeps = np.zeros((2, step_bounds.BENCH_COLUMNS))
    sweeps[0, step_bounds.POINT_ACCELERATION] = 8.0
    rows = (table, sweeps, 2, 0, 1, h)
    assert pair_bounds.face_bound(*rows) <= 2.0 - 0.125 * 8.0 * h * h
    assert pair_bounds.face_ceiling(*rows) >= 2.0 + 0.125 * 8.0 * h * h
    for row in (1, 3):  # farther off at the start, or at the end
        table[[1, 3], 0] = 3.0
        table[row, 0] = 4.0
        assert pair_bounds.face_bound(*rows) < 2.0
        assert pair_bounds.face_ceiling(*rows) > 3.0


def faced(gap: float, travel: float, pull: float) -> tuple[search.Search, FloatArray]:
    """What a search knows of two benches as far apart at both ends of a part, and a fresh note."""
    room = search.room(4, 2, 1, 0)
    room.at[:2] = 0.0, 0.1
    room.handles[0, step_bounds.PATH] = 0.1
    room.alive[1, 0], room.kept[1] = 0, 1
    room.boxes[:4] = 0.0
    room.boxes[:4, 2] = 1.0
    room.boxes[:4, [4, 5]] = 0.5
    room.boxes[[1, 3], 0] = 1.0 + gap
    room.sweeps[:] = 0.0
    room.sweeps[:, step_bounds.TRAVEL], room.sweeps[:, step_bounds.POINT_ACCELERATION] = travel, pull
    return room, np.zeros(search.NOTES)


@pytest.mark.parametrize(
    ("travel", "pull", "ending"),
    [(0.001, 0.0, search.CLEAR), (0.05, 0.0, search.CLEAR), (0.05, 8.0, search.SPLIT)],
)
def test_a_contact_lasts_only_if_travel_or_faces_say_so(
    travel: float, pull: float, ending: int
) -> None:
    room, note = faced(-0.01, travel, pull)
    pairs, limits = search.Pairs(np.array([0]), np.array([1])), search.Limits(0.0, 1e-13, 1e-13, 2)
    assert search.judge_end(room, 1, 2, pairs, limits, note) == ending


def test_the_least_bound_of_a_part_is_that_of_any_pair() -> None:
    room, _note = faced(2.0, 0.1, math.inf)
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
        pairs = search.Pairs(np.array([0, 0]), np.array(second))
        assert search.keep_near(room, 1, 3, pairs, 9.0) == pytest.approx(1.9)
        assert room.kept[1] == 2


def test_every_pair_of_a_step_is_looked_at() -> None:
    walk = Walk(Dragon.uniform(4, 2.2), Route((Line(30.0),)))
    contact_search = ContactSearch(walk, 15.0, 16.0, 1.5, silent)
    for second, found in (([3, 2], 1), ([2, 3], 0)):
        note = np.zeros(search.NOTES)
        step = Step(15.0, 15.2, np.array([0, 0]), np.array(second))
        assert search_one(contact_search, search.FIRST_TOUCH, step, note) == search.FOUND
        assert contact_search.pair(note) == (0, second[found])
        assert note[search.UPPER] == 15.0


def test_the_end_of_a_step_is_looked_at() -> None:
    walk, ends = spiral_walk(0.3), (10.0 - 9e-14, 10.0)
    falls = [pair_distances(walk.placement(ends), 0, j).tolist() for j in range(2, 16)]
    j, (_before, at) = next((j, pair) for j, pair in enumerate(falls, 2) if pair[0] > pair[1] + 9e-15)
    contact_search = ContactSearch(walk, 9.0, 10.0, at + 2e-15, silent, 1e-15)
    note = np.zeros(search.NOTES)
    step = Step(*ends, np.array([0]), np.array([j]))
    assert search_one(contact_search, search.FIRST_TOUCH, step, note) == search.FOUND
    assert note[search.UPPER] == 10.0


def test_distances_fall_by_no_more_than_half_the_travel() -> None:
    table = np.zeros((4, BOX_COLUMNS))
    table[:, 2] = 1.0
    table[:, [4, 5]] = 0.5
    table[[1, 3], 0] = 3.0
    sweeps = np.zeros((2, step_bounds.BENCH_COLUMNS))
    sweeps[:, step_bounds.POINT_ACCELERATION] = math.inf  # as across a kink: there and back, leaping
    for travel in ((0.6, 0.0), (0.0, 0.6), (0.4, 0.2)):
        sweeps[:, step_bounds.TRAVEL] = travel
        assert pair_bounds.apart_bound(table, sweeps, 2, 0, 1, 1.0, 0.0) == pytest.approx(1.7)


@pytest.mark.parametrize(
    ("beyond", "ending"),
    [(-2e-6, search.CLEAR), (-5e-7, search.GRAZE), (5e-7, search.GRAZE), (2e-6, search.FOUND)],
)
def test_a_pair_within_rounding_of_the_margin_is_neither_clear_nor_found(
    beyond: float, ending: int
) -> None:
    walk = Walk(Dragon.uniform(3, 2.2), Route((Line(30.0),)))
    distance = 2.0 * 1.65 - 2.2
    contact_search = ContactSearch(walk, 15.0, 16.0, distance + beyond, silent, 1e-6)
    pair = np.array([0]), np.array([2])
    note = np.zeros(search.NOTES)
    step = Step(15.0, 15.2, *pair)
    assert search_one(contact_search, search.FIRST_TOUCH, step, note) == ending


def test_a_bracket_begins_where_all_was_clear() -> None:
    walk = spiral_walk(0.78)
    exact, rough = (first_contact(walk, 0.0, 15.0, slack=slack) for slack in (1e-13, 1e-3))
    assert exact is not None
    assert rough is not None
    assert rough.lower < exact.lower <= exact.upper < rough.upper
    assert (clearances(walk.placement(np.linspace(0.0, rough.lower, 60))) > 0.0).all()


def test_ground_is_asked_for_the_room_of_rounding() -> None:
    walk = spiral_walk(0.3)
    steps = [list(ContactSearch(walk, 0.0, 12.0, 0.0, silent, slack).steps()) for slack in (1e-13, 0.6)]
    assert [bool(some) for some in steps] == [False, True]


def test_pairs_are_numbered_by_the_benches_that_are_in_any() -> None:
    rng = np.random.default_rng(0)
    for _case in range(20):
        both = np.sort(rng.choice(60, (int(rng.integers(1, 12)), 2)), axis=1)
        both[:, 1] += 2
        first, second = both[:, 0].copy(), both[:, 1].copy()
        place, members = np.full(70, -1, dtype=np.int64), np.empty(24, dtype=np.int64)
        mine, other = np.empty_like(first), np.empty_like(second)
        count = search.number_members(first, second, members, place, mine, other)
        assert members[:count].tolist() == np.unique(both).tolist()
        assert (members[mine] == first).all()
        assert (members[other] == second).all()
        assert (place == -1).all()
