"""Searches of steps: no contact, speed or pair is overlooked, and what is not sure is told."""

import itertools
import math

import numpy as np
import pytest

from benchdragon import (
    Arc,
    Bench,
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
from benchdragon.analysis.distance import pair_distances
from benchdragon.analysis.nearby import errors_at, seams_of
from benchdragon.analysis.speed import greatest_speed
from benchdragon.errors import WalkError
from benchdragon.kernels import box_hierarchy, search_room, time_of_impact
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, distances_along, set_box
from benchdragon.kernels.box_hierarchy import BoxCount, BoxMeasure, Node, NodeState
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.workspace import Course, WalkTally
from benchdragon.model.placement import Placement
from tests.kernels.quantities import ROUNDING
from tests.kernels.tried_walks import BENCHES, ROUTES, Searched, Step, begun_without_spans, searched


def search_one(found: Searched, goal: int, step: Step, note: FloatArray, tolerance: float = 0.0) -> int:
    """Search one step alone, whose pairs are what it says: see `Searched.search`."""
    count, placed = len(step.first), int(found.room.course.tally[WalkTally.PLACED])
    found.go(step.end, step.end)
    way, tally = found.room.course
    way[Course.STEP_START], tally[[WalkTally.PAIRS, WalkTally.PLACED]] = step.start, (count, placed)
    found.room.meeting.first[:count], found.room.meeting.second[:count] = step.first, step.second
    return found.search(goal, note, tolerance)


def search_step(
    room: time_of_impact.Search,
    goal: int,
    chain: time_of_impact.Chain,
    pairs: time_of_impact.Pairs,
    start: float,
    end: float,
    limits: time_of_impact.Limits,
    note: FloatArray,
) -> int:
    """Search one step with the kernels alone."""  # fmt: skip
    top = time_of_impact.open_step(room, len(pairs.first), start, end)
    return time_of_impact.bisect(room, goal, chain, pairs, top, 0, limits, note)


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


def search_chain(walk: Walk, members: IntArray) -> time_of_impact.Chain:
    """The benches up to the last of the members, on the walk's route."""
    dragon, links = walk.dragon, walk.dragon.links[: members[-1] + 1]
    return time_of_impact.Chain(
        walk.route.rows, links, np.empty(0), dragon.sizes, members, np.empty((0, BOX_COLUMNS)),
        seams_of(walk.route.rows),
    )  # fmt: skip


def test_too_few_looks_leave_a_search_stuck() -> None:
    walk = spiral_walk(0.78)
    step = next(iter(Searched(walk, 0.0, 15.0, 0.0).steps()))
    room = time_of_impact.empty_search(17, 16, len(step.first))
    members, inverse = np.unique(np.concatenate([step.first, step.second]), return_inverse=True)
    for goal in (Goal.FIRST_TOUCH, Goal.LEAST):
        note = np.zeros(time_of_impact.NOTES)
        note[Note.NEAREST] = note[Note.FLOOR] = math.inf
        ending = search_step(
            room, goal, search_chain(walk, members), time_of_impact.Pairs(*np.split(inverse, 2)),
            step.start, step.start + 4.0, time_of_impact.Limits(0.0, 1e-13, 1e-13, 2), note,
        )  # fmt: skip
        assert ending == (Ending.STUCK if goal == Goal.FIRST_TOUCH else Ending.GRAZE)


def test_a_bound_on_rounding_widens_a_bracket() -> None:
    plain = spiral_walk(0.78)
    known = first_contact(plain, 0.0, 15.0)
    assert known is not None
    assert known.witness is not None
    at, members = known.witness.s, np.array(known.witness.benches) - 1
    walk = Walk(plain.dragon, Route((Spiral(0.8, 18.0, 7.0, (1e5, 1e5)),)))
    bounded, notes = search_chain(walk, members), []
    for chain in (bounded, bounded._replace(seams=np.empty((0, 2)))):
        room, note = time_of_impact.empty_search(17, 2, 1), np.zeros(time_of_impact.NOTES)
        ending = search_step(
            room, Goal.FIRST_TOUCH, chain, time_of_impact.Pairs(np.array([0]), np.array([1])),
            at - 0.05, at + 0.05, time_of_impact.Limits(0.0, 1e-13, 1e-13, 1000), note,
        )  # fmt: skip
        assert ending == Ending.FOUND
        notes.append(note)
    sure, blind = notes
    assert 1e-10 < sure[Note.OFF] < 1e-9
    assert blind[Note.OFF] == 1e-13
    # Nothing counts as clear, or as touched, that rounding may have made so.
    assert sure[Note.LOWER] < blind[Note.LOWER] - 1e-11
    assert sure[Note.UPPER] > blind[Note.LOWER] + 1e-11


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
        assert out[t] == pytest.approx(box_distance(pair, 0, 1), abs=ROUNDING)


def test_a_bench_that_cannot_stand_leaves_its_cell_in_doubt() -> None:
    route = Route.joined([Line(10.0), Arc(0.3, math.pi), Line(10.0)])
    dragon = Dragon.of_sizes(np.full(3, 1.4), 0.2, 0.1, 0.1)
    found = Searched(Walk(dragon, route), 8.0, 14.0, 0.0)
    found.begin(10.0)
    steps: list[Step] = []
    with pytest.raises(WalkError):
        steps.extend(found.steps())  # all that came before the failure
    known, sound = found.room.course.way[[Course.KNOWN, Course.SOUND]].tolist()
    # The head's own bench folds at 10.64 m; hulls hold it up to the cell of that place.
    assert known < sound < 12.0
    assert known > sound - float(found.room.ground.measures[BoxMeasure.CELL]) - 1e-6
    assert steps[-1].end == sound
    assert steps[-1].start >= known
    searched(dragon, route, (8.0, known), 0.1)  # raises nothing
    stands = Placement(dragon, route, [sound, sound + 1e-6])
    assert [bool(status) for status in stands.status] == [False, True]


def test_steps_go_on_to_the_very_end_of_a_walk_without_a_gap() -> None:
    """Benches 1 and 3 are within reach all along."""
    sizes = Dragon([Bench(1.7, 0.4, 0.2, 0.3), *[Bench(1.1, 0.3, 0.1, 0.1)] * 2])
    size = 0.25 * 0.45 * float(sizes.links.min())
    for parts in (21.9, 29.0, 30.0 - 1e-6):
        search_of = Searched(Walk(sizes, Route((Line(30.0),))), 8.0, 8.0 + parts * size)
        search_of.begin(10.0)
        steps = list(search_of.steps())
        assert (steps[0].start, steps[-1].end) == (8.0, 8.0 + parts * size)
        for step, after in itertools.pairwise(steps):
            assert step.end == after.start
        assert all((step.first.tolist(), step.second.tolist()) == ([0], [2]) for step in steps)


def test_a_step_begins_with_the_chain_of_the_one_before_or_its_own() -> None:
    """Steps that join reach from few handles to many, and leave a gap: each is searched as alone."""
    walk = spiral_walk(0.3)
    together, steps = Searched(walk, 9.0, 12.0), []
    for start, end, j in ((9.0, 9.1, 7), (9.1, 9.2, 15), (9.2, 9.3, 6), (10.0, 10.1, 6), (9.3, 9.4, 8)):
        steps.append(Step(start, end, np.array([0]), np.array([j])))
    for step in steps:
        notes = []
        for found in (together, Searched(walk, 9.0, 12.0)):
            note = np.zeros(time_of_impact.NOTES)
            note[Note.NEAREST] = note[Note.FLOOR] = math.inf
            assert search_one(found, Goal.LEAST, step, note, 1e-9) == Ending.CLEAR
            notes.append(note[[Note.NEAREST, Note.PAIR]].tolist())
        assert notes[0] == notes[1]


def test_what_benches_behind_may_reach_is_boxed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A head on its way in meets benches that are in a clear span with each other."""
    walk = Walk(Dragon.uniform(40), Route((Spiral(0.5, 36.0 * math.pi, 0.5 * math.pi),)), start=400.0)
    bounds, boxed = [], []
    for _turn in range(2):
        found = Searched(walk, *walk.head_position([0.0, 45.0]).tolist())
        note = np.zeros(time_of_impact.NOTES)
        assert found.search(Goal.FIRST_TOUCH, note) == Ending.FOUND
        bounds.append(note[[Note.LOWER, Note.UPPER, Note.PAIR]].tolist())
        ground, count = found.room.ground, int(found.room.ground.counts[BoxCount.CELLS])
        whole = ground.tree[: 2 * len(ground.middles)].reshape(2, -1, box_hierarchy.TREE_COLUMNS)
        boxed.append(int((whole[:, :count, Node.STATE] == NodeState.BOXED).sum()))
        monkeypatch.setattr(search_room, "begin_walk", begun_without_spans)
    assert bounds[0] == pytest.approx(bounds[1], abs=1e-10)
    assert boxed[0] < boxed[1]


def test_a_search_that_gives_up_says_how_low_it_may_be() -> None:
    walk = spiral_walk(0.3)
    contact_search = Searched(walk, 0.0, 12.0, 0.0)
    contact_search.begin(0.6)
    step = next(iter(contact_search.steps()))
    least = min(
        float(np.min(pair_distances(walk.placement(np.linspace(step.start, step.end, 200)), i, j)))
        for i, j in zip(step.first.tolist(), step.second.tolist(), strict=True)
    )
    members, inverse = np.unique(np.concatenate([step.first, step.second]), return_inverse=True)
    for most in (2, 3, 5):
        note = np.zeros(time_of_impact.NOTES)
        note[Note.NEAREST] = note[Note.FLOOR] = math.inf
        ending = search_step(
            time_of_impact.empty_search(17, 16, len(step.first)), Goal.LEAST,
            search_chain(walk, members),
            time_of_impact.Pairs(*np.split(inverse, 2)), step.start, step.end,
            time_of_impact.Limits(0.0, 1e-13, 1e-13, most), note,
        )  # fmt: skip
        assert ending == Ending.GRAZE
        assert 0.0 < note[Note.FLOOR] <= least
        assert note[Note.NEAREST] >= least


def test_what_was_given_up_first_is_not_forgotten() -> None:
    """Across a kink bounds are loose; behind it they are narrow, and lie higher."""
    route, start = ROUTES["kink"]
    chain = search_chain(Walk(Dragon(BENCHES), route), np.array([0, 2]))
    pairs = time_of_impact.Pairs(np.array([0]), np.array([1]))
    floors = []
    for end in (start + 0.05, start + 0.2):
        note = np.zeros(time_of_impact.NOTES)
        note[Note.NEAREST] = note[Note.FLOOR] = math.inf
        search_step(
            time_of_impact.empty_search(4, 2, 1), Goal.LEAST, chain, pairs, start, end,
            time_of_impact.Limits(0.0, 1e-9, 0.06, 100), note,
        )  # fmt: skip
        floors.append(note[Note.FLOOR])
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


def test_every_pair_of_a_step_is_looked_at() -> None:
    walk = Walk(Dragon.uniform(4, 2.2), Route((Line(30.0),)))
    contact_search = Searched(walk, 15.0, 16.0, 1.5)
    for second, found in (([3, 2], 1), ([2, 3], 0)):
        note = np.zeros(time_of_impact.NOTES)
        step = Step(15.0, 15.2, np.array([0, 0]), np.array(second))
        assert search_one(contact_search, Goal.FIRST_TOUCH, step, note) == Ending.FOUND
        assert contact_search.pair(note) == (0, second[found])
        assert note[Note.UPPER] == 15.0


def test_the_end_of_a_step_is_looked_at() -> None:
    walk, ends = spiral_walk(0.3), (10.0 - 9e-14, 10.0)
    falls = [pair_distances(walk.placement(ends), 0, j).tolist() for j in range(2, 16)]
    j, (_before, at) = next((j, pair) for j, pair in enumerate(falls, 2) if pair[0] > pair[1] + 9e-15)
    # Nearer by as much as these distances may be off by, and no more.
    _errors, offs = errors_at(walk, 10.0)
    off = max(1e-15, float(offs[0] + offs[j]))
    contact_search = Searched(walk, 9.0, 10.0, at + off + 2e-15, slack=1e-15)
    note = np.zeros(time_of_impact.NOTES)
    step = Step(*ends, np.array([0]), np.array([j]))
    assert search_one(contact_search, Goal.FIRST_TOUCH, step, note) == Ending.FOUND
    assert note[Note.UPPER] == 10.0


@pytest.mark.parametrize(
    ("beyond", "ending"),
    [
        (-2e-6, Ending.CLEAR),
        (-5e-7, Ending.GRAZE),
        (5e-7, Ending.GRAZE),
        (2e-6, Ending.FOUND),
    ],
)
def test_a_pair_within_rounding_of_the_margin_is_neither_clear_nor_found(
    beyond: float, ending: int
) -> None:
    walk = Walk(Dragon.uniform(3, 2.2), Route((Line(30.0),)))
    distance = 2.0 * 1.65 - 2.2
    contact_search = Searched(walk, 15.0, 16.0, distance + beyond, slack=1e-6)
    pair = np.array([0]), np.array([2])
    note = np.zeros(time_of_impact.NOTES)
    step = Step(15.0, 15.2, *pair)
    assert search_one(contact_search, Goal.FIRST_TOUCH, step, note) == ending


def test_a_bracket_begins_where_all_was_clear() -> None:
    walk = spiral_walk(0.78)
    exact = first_contact(walk, 0.0, 15.0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("benchdragon.analysis.contact_search.SLACK", 1e-3)
        rough = first_contact(walk, 0.0, 15.0)
    assert exact is not None
    assert rough is not None
    assert rough.lower < exact.lower <= exact.upper < rough.upper
    assert (clearances(walk.placement(np.linspace(0.0, rough.lower, 60))) > 0.0).all()


def test_ground_is_asked_for_the_room_of_rounding() -> None:
    walk = spiral_walk(0.3)
    for slack in (1e-13, 0.6):
        assert bool(list(Searched(walk, 0.0, 12.0, slack=slack).steps())) == (slack > 0.5)
