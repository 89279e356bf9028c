"""Benches past what stands still: what is passed over keeps away, and what is met is met in time."""

import itertools
import math

import numpy as np
import pytest
import shapely

from benchdragon import Arc, Line, Route
from benchdragon.analysis.nearby import seams_of
from benchdragon.kernels import obstacle_contact as kernel
from benchdragon.kernels import time_of_impact as steps
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, corner, place_box
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.motion_bounds import BenchBound
from benchdragon.kernels.obstacle_contact import Bench, Standing
from benchdragon.kernels.swept_boxes import EDGE
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.walk_search import WalkEnding
from benchdragon.model.obstacle import Obstacle
from tests.kernels import rooms
from tests.kernels.quantities import ROUNDING

EAST = Route((Line(100.0),))
BEND = Route.joined([Line(10.0), Arc(2.0, 2.5), Line(10.0)])
HAIRPIN = Route.joined([Line(20.0), Arc(0.5, math.pi), Line(20.0)])
# 2 m by 0.5 m, 1.5 m from handle to handle.
SIZES = np.array([[2.0], [0.5], [0.25], [0.25]])


def bench_on(route: Route) -> Bench:
    return Bench(route.rows, np.array([1.5]), SIZES, seams_of(route.rows))


def wall(x: float, low: float = -1.0, high: float = 1.0) -> FloatArray:
    return Obstacle.line("wall", [(x, low), (x, high)]).boxes


def room_for(standing: Standing) -> steps.Search:
    count = len(standing.boxes) + 1
    return steps.empty_search(2, count, count)


# Of each span that was searched: how that ended, and between which positions, m.
ENDING, LOWER, UPPER = range(3)


def spans_searched(
    route: Route, boxes: FloatArray, goal: int, spans: list[tuple[float, float]], most: int = 1000,
    tolerance: float = 1e-13, near: float = math.inf, margin: float = 0.0,
) -> tuple[int, FloatArray, FloatArray]:  # fmt: skip
    """How a search ended, its note, and what is told of each span."""
    standing, note = rooms.beside(boxes), np.zeros(steps.NOTES)
    note[Note.NEAREST], note[Note.FLOOR], note[Note.PAIR] = near, math.inf, -1.0
    found, search = np.full((len(spans), 3), math.nan), room_for(standing)
    limits = steps.Limits(margin, tolerance, 1e-13, most)
    for n, span in enumerate(spans):
        ending = kernel.search_span(bench_on(route), standing, search, goal, *span, limits, note)
        found[n] = ending, note[Note.LOWER], note[Note.UPPER]
        if ending == WalkEnding.ASTRAY:
            break
    return int(np.nanmax(found[:, ENDING])), note, found


def box_at(route: Route, s: float) -> FloatArray:
    """The bench with its front handle at s."""
    standing = rooms.beside(wall(0.0))
    search, out = room_for(standing), np.empty((1, BOX_COLUMNS))
    search.at[0] = search.at[1] = s
    assert kernel.walks_step(bench_on(route), search)
    place_box(SIZES, 0, 0, search.places.x, search.places.y, 0, out, 0)
    return out


def apart(one: FloatArray, others: FloatArray) -> FloatArray:
    """Distances of a bench from boxes, m."""
    return np.array([box_distance(np.vstack([one, other]), 0, 1) for other in others])


def random_boxes(rng: np.random.Generator, count: int) -> FloatArray:
    """Sides, each a box without width."""
    ends = rng.uniform(-4.0, 16.0, (count, 2))
    others = ends + rng.normal(0.0, 1.0, (count, 2))
    lines = [Obstacle.line("side", pair).boxes for pair in zip(ends, others, strict=True)]
    return np.concatenate([np.asarray(line) for line in lines])


def test_the_distance_of_a_centre_is_that_from_the_box() -> None:
    rng = np.random.default_rng(1)
    boxes = random_boxes(rng, 6)
    boxes[3:, 5] = 0.4
    for n, (x, y) in itertools.product(range(6), rng.uniform(-2.0, 14.0, (8, 2)).tolist()):
        corners = shapely.MultiPoint([corner(boxes, n, k) for k in range(4)]).convex_hull
        told = kernel.centre_distance(boxes, n, x, y)
        assert told == pytest.approx(corners.distance(shapely.Point(x, y)), abs=1e-12)


@pytest.mark.parametrize("wanted", [0.0, 0.7])
@pytest.mark.parametrize(("start", "end"), [(9.5, 10.1), (11.0, 11.9), (6.0, 6.5)])
def test_no_box_that_is_left_out_comes_near_in_the_step(
    start: float, end: float, wanted: float
) -> None:
    boxes = random_boxes(np.random.default_rng(7), 60)
    standing = rooms.beside(boxes)
    search = room_for(standing)
    search.at[0], search.at[1] = start, end
    assert kernel.walks_step(bench_on(BEND), search)
    count = kernel.gather_near(bench_on(BEND), standing, search, wanted)
    gathered = standing.number[:count].tolist()
    assert (standing.near[:count] == boxes[gathered]).all()
    assert standing.second[:count].tolist() == list(range(1, count + 1))
    assert not standing.first[:count].any()
    near = set[int]()
    for s in np.linspace(start, end, 12).tolist():
        near |= set(np.flatnonzero(apart(box_at(BEND, s), boxes) <= wanted).tolist())
    assert near <= set(gathered)
    assert len(near) <= count < 60
    assert near or not wanted


def test_a_box_at_the_very_reach_of_a_step_is_gathered() -> None:
    # The half diagonal and the bench's way from its place at the start, and the distance wanted.
    standing = rooms.beside(wall(10.0))
    search = room_for(standing)
    search.at[0], search.at[1] = 6.0, 6.5
    assert kernel.walks_step(bench_on(EAST), search)
    assert kernel.gather_near(bench_on(EAST), standing, search, 0.3) == 0
    reach = math.hypot(1.0, 0.25) + search.sweeps[0, BenchBound.TRAVEL] + 0.3 + EDGE
    assert search.sweeps[0, BenchBound.TRAVEL] >= 0.5
    for off, count in ((-1e-9, 1), (1e-9, 0)):
        standing.boxes.flags.writeable = True
        standing.boxes[0, 0] = 6.0 + 0.25 - 1.0 + reach + off
        assert kernel.gather_near(bench_on(EAST), standing, search, 0.3) == count


def test_what_stands_still_is_boxed_alike_at_all_places_and_does_not_move() -> None:
    boxes, search = random_boxes(np.random.default_rng(3), 3), steps.empty_search(2, 4, 4)
    search.at[:2] = 6.0, 6.4
    bench = bench_on(EAST)
    assert kernel.walks_step(bench, search)
    chain = steps.Chain(
        bench.rows, bench.link, np.empty(0), SIZES, np.zeros(1, dtype=np.int64), boxes, bench.seams
    )
    assert steps.member_count(chain) == 4
    search.sweeps[:] = math.nan
    for slot in (0, 1):
        steps.box_slot(chain, search, slot)
        assert (search.boxes[4 * slot + 1 : 4 * slot + 4] == boxes).all()
        assert search.boxes[4 * slot, 0] == pytest.approx(6.0 + 0.4 * slot - 0.75)
    steps.bound_members(chain, search, 1)
    assert (search.sweeps[1:] == 0.0).all()
    assert search.sweeps[0, BenchBound.TRAVEL] >= 0.4


def test_a_wall_is_met_in_the_span_that_leads_to_it() -> None:
    spans = [(2.0, 3.0), (6.0, 12.0), (30.0, 31.0)]
    ending, _note, found = spans_searched(EAST, wall(10.1), Goal.FIRST_TOUCH, spans)
    assert ending == Ending.FOUND
    assert found[:, ENDING].tolist() == [Ending.CLEAR, Ending.FOUND, Ending.CLEAR]
    lower, upper = found[1, [LOWER, UPPER]].tolist()
    assert lower <= 9.85 <= upper <= lower + 1e-12
    near = spans_searched(EAST, wall(10.1), Goal.FIRST_TOUCH, spans, margin=0.6)[2]
    assert near[1, LOWER] <= 9.25 <= near[1, UPPER]


def test_what_is_far_off_counts_within_a_wide_margin() -> None:
    ending, _note, found = spans_searched(
        EAST, wall(60.0), Goal.FIRST_TOUCH, [(5.0, 12.0)], margin=50.0
    )
    assert ending == Ending.FOUND
    assert found[0, LOWER] <= 9.75 <= found[0, UPPER]


def test_spans_are_searched_to_their_very_ends() -> None:
    ending, _note, found = spans_searched(EAST, wall(10.25), Goal.FIRST_TOUCH, [(5.0, 10.0 + 1e-9)])
    assert (ending, found[0, ENDING]) == (Ending.FOUND, Ending.FOUND)
    ending, _note, _found = spans_searched(EAST, wall(10.25), Goal.FIRST_TOUCH, [(5.0, 10.0 - 1e-9)])
    assert ending == Ending.CLEAR


def test_a_touch_within_rounding_is_a_graze() -> None:
    kerb = Obstacle.line("kerb", [(-50.0, 0.25), (50.0, 0.25)]).boxes
    ending, _note, found = spans_searched(EAST, kerb, Goal.FIRST_TOUCH, [(5.0, 7.0)])
    assert (ending, found[0, ENDING]) == (Ending.GRAZE, Ending.GRAZE)
    assert found[0, LOWER] == 5.0
    kerb = Obstacle.line("kerb", [(-50.0, 0.25 + 4e-13), (50.0, 0.25 + 4e-13)]).boxes
    assert spans_searched(EAST, kerb, Goal.FIRST_TOUCH, [(5.0, 7.0)])[0] == Ending.CLEAR


def test_grazes_end_the_span() -> None:
    # Past the kerb that it grazes the bench would run into a wall.
    kerb = Obstacle.line("kerb", [(6.0, 0.25), (7.0, 0.25)]).boxes
    _ending, _note, found = spans_searched(
        EAST, np.vstack([kerb, wall(14.0)]), Goal.FIRST_TOUCH, [(3.0, 20.0)]
    )
    assert found[0, ENDING] == Ending.GRAZE
    assert found[0, LOWER] <= 5.75
    assert found[0, UPPER] < 13.0


def test_a_span_that_takes_too_long_is_told_as_stuck_where_it_is() -> None:
    ending, _note, found = spans_searched(EAST, wall(10.1), Goal.FIRST_TOUCH, [(5.0, 12.0)], most=1)
    assert ending == Ending.STUCK
    assert found[0, LOWER] <= 9.85 <= found[0, UPPER]


@pytest.mark.parametrize("goal", [Goal.FIRST_TOUCH, Goal.LEAST])
def test_a_bench_that_cannot_follow_is_astray(goal: int) -> None:
    spans = [(6.0, 12.0), (18.0, 25.0), (30.0, 31.0)]
    ending, _note, found = spans_searched(HAIRPIN, wall(60.0), goal, spans)
    assert ending == WalkEnding.ASTRAY
    assert found[:2, ENDING].tolist() == [Ending.CLEAR, WalkEnding.ASTRAY]
    assert math.isnan(found[2, ENDING])
    assert 20.0 < found[1, LOWER] < 22.0
    # Not one of a billionth of a metre, where all is well.
    assert found[1, UPPER] - found[1, LOWER] < 3e-9


def test_the_least_distance_of_all_spans_together_is_bracketed() -> None:
    near = [wall(10.0, 0.5, 2.0), wall(11.0, 0.4, 2.0), wall(12.0, 0.6, 2.0)]
    boxes = np.vstack([wall(90.0), *near])
    spans = [(8.0, 10.0), (10.5, 11.5), (30.0, 31.0)]
    ending, note, found = spans_searched(EAST, boxes, Goal.LEAST, spans, tolerance=1e-6)
    assert ending == Ending.CLEAR
    assert (found[:, ENDING] == Ending.CLEAR).all()
    assert note[Note.NEAREST] == pytest.approx(0.15, abs=1e-12)
    assert note[Note.PAIR] == 2
    assert 10.75 <= note[Note.UPPER] <= 12.75
    assert note[Note.FLOOR] == math.inf
    # With so few evaluations it is told how low it may lie.
    _ending, note, _found = spans_searched(EAST, boxes, Goal.LEAST, [(8.0, 12.1)], 1, 1e-6)
    assert note[Note.FLOOR] <= 0.15
    assert spans_searched(EAST, wall(10.0), Goal.LEAST, [(8.0, 12.0), (20.0, 21.0)])[0] == Ending.FOUND


def test_what_is_seen_at_the_ends_of_spans_is_the_least_distance_there() -> None:
    boxes, note = random_boxes(np.random.default_rng(5), 30), np.zeros(steps.NOTES)
    spans = np.array([(4.0, 8.0), (9.0, 14.0)])
    standing = rooms.beside(boxes)
    note[Note.NEAREST] = 1e3
    kernel.look_along(bench_on(BEND), standing, room_for(standing), spans, note)
    seen = np.array([apart(box_at(BEND, s), boxes) for s in spans.ravel()])
    place, box = np.unravel_index(int(seen.argmin()), seen.shape)
    assert note[Note.NEAREST] == pytest.approx(seen.min(), abs=ROUNDING)
    assert note[Note.UPPER] == spans.ravel()[place]
    assert note[Note.PAIR] == box


def test_distances_to_what_stands_are_those_of_all_pairs() -> None:
    rng = np.random.default_rng(9)
    boxes = random_boxes(rng, 40)
    benches = np.concatenate([box_at(BEND, s) for s in (3.0, 9.0, 12.0, 15.0)])
    out, which = np.empty(4), np.empty(4, dtype=np.int64)
    kernel.distances_to(benches, boxes, np.empty((2, BOX_COLUMNS)), out, which)
    for n in range(4):
        each = apart(benches[n], boxes)
        assert out[n] == pytest.approx(each.min(), abs=ROUNDING)
        assert which[n] == each.argmin()
