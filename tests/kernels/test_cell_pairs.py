"""Cells hold the benches that walk through them, and name every pair that may come near."""

import itertools
import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

from benchdragon import Arc, Bench, Dragon, Line, Route, Spiral, Walk
from benchdragon.analysis.distance import boxes
from benchdragon.analysis.tables import kinds_of
from benchdragon.kernels import box_hierarchy, broad_phase, candidate_pairs, time_of_impact
from benchdragon.kernels.box import Box, box_distance, corner, offset
from benchdragon.kernels.box_hierarchy import BenchGroup, BoxCount, BoxMeasure, Node
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.workspace import WalkTally
from tests.kernels.tried_walks import BENCHES, ROUTES, SMOOTH, Searched, searched


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


def row_of(ground: box_hierarchy.Hierarchy, group: int, s: float) -> int:
    """The row of the box of the cell in which a front handle of the group is at s, m."""
    cell = math.floor(s / float(ground.measures[BoxMeasure.CELL])) - int(ground.counts[BoxCount.LOW])
    return group * len(ground.middles) + cell


MIXED = [Bench(1.6, 0.4, 0.1, 0.2), *[Bench(1.0 + 0.1 * n, 0.7 - 0.1 * n, 0.1, 0.1) for n in range(5)]]

# In each group of sizes a broad bench and, boxed after it, a slim one.
CONTRARY = [
    Bench(length + 0.01 * (width < 1.0), width, 0.1, 0.1)
    for length in (1.0, 1.2, 1.4)
    for width in (1.2, 0.2)
]


@pytest.mark.plain
@pytest.mark.compiled
@pytest.mark.parametrize("benches", [BENCHES, MIXED, CONTRARY], ids=["alike", "mixed", "contrary"])
@pytest.mark.parametrize("name", SMOOTH)
def test_cells_hold_the_benches_that_walk_through_them(name: str, benches: list[Bench]) -> None:
    route, start = ROUTES[name]
    dragon = Dragon(benches)
    ground = searched(dragon, route, (start, start + 3.0), 10.0).room.ground
    assert ground.counts[BoxCount.DOUBTS] == 0
    walk, group = Walk(dragon, route), groups_of(dragon)
    for s in np.linspace(start, start + 2.9, 23):
        motion = walk.motion([s])
        table = boxes(motion, 0)
        for i in range(len(dragon)):
            row = row_of(ground, int(group[i]), float(motion.s[0, i]))
            for k in range(4):
                along, across = offset(ground.hulls, row, *corner(table, i, k))
                assert abs(along) <= ground.hulls[row, Box.HALF_LENGTH] + 1e-12
                assert abs(across) <= ground.hulls[row, Box.HALF_WIDTH] + 1e-12


@pytest.mark.plain
@pytest.mark.parametrize("name", SMOOTH)
def test_cells_leave_room_for_how_far_corners_bulge_between_their_borders(name: str) -> None:
    """A corner's way bulges from its chord by an eighth of the square of the step times its bend."""
    route, start = ROUTES[name]
    dragon = Dragon(BENCHES)
    ground = searched(dragon, route, (start, start + 3.0), 10.0).room.ground
    hull, most, size = ground.hulls, 0.0, float(ground.measures[BoxMeasure.CELL])
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
                assert abs(along) + 0.99 * bulge <= hull[row, Box.HALF_LENGTH] + 1e-12
                assert abs(across) + 0.99 * bulge <= hull[row, Box.HALF_WIDTH] + 1e-12
    assert most > 1e-4


def partnered(
    wanted: npt.NDArray[np.bool_], low: int, size: float
) -> tuple[box_hierarchy.Hierarchy, Callable[[FloatArray, IntArray, int], set[tuple[int, int]]]]:
    """Ground whose part (a, c) has the parts wanted[a, c] as partners, and its pairs of benches.

    Parts are `size` metres long, from the `low`-th on, and a cell has PARTS of them.
    """
    groups, parts = wanted.shape[:2]
    whole = parts // box_hierarchy.PARTS
    dragon = Dragon.uniform(12, 2.2)
    search = Searched(Walk(dragon, Route((Line(99.0),))), 40.0, 41.0)
    rows = groups * whole
    tree = np.zeros((rows * (1 + box_hierarchy.PARTS), box_hierarchy.TREE_COLUMNS), dtype=np.int64)
    tree[:rows, Node.CHILD] = rows + np.arange(rows) * box_hierarchy.PARTS
    tree[rows:, Node.GROUP] = np.repeat(np.arange(groups), parts)
    tree[rows:, Node.NUMBER] = np.tile(np.arange(parts), groups)
    ground = search.room.ground._replace(
        tree=tree,
        groups=np.full((groups, BenchGroup.WAYS + groups), math.inf),
        middles=np.empty((whole, 2)),
        partners=np.empty((int(wanted.sum()), 2), dtype=np.int64),
        near=np.empty((1, 2), dtype=np.int64),
    )
    ground.counts[:] = 0
    ground.counts[[BoxCount.GROUPS, BoxCount.CELLS, BoxCount.LOW]] = (
        groups,
        whole,
        low // box_hierarchy.PARTS,
    )
    ground.measures[BoxMeasure.CELL] = size * box_hierarchy.PARTS
    for a, c, b, d in np.argwhere(wanted).tolist():
        broad_phase.add_candidates(ground, rows + a * parts + c, rows + b * parts + d)

    def pairs(s: FloatArray, group: IntArray, most: int) -> set[tuple[int, int]]:
        first, second = np.empty((2, most), dtype=np.int64)
        benches = search.hunt.walk.benches._replace(kind=group)
        kinds = box_hierarchy.Kinds(search.hunt.walk.kinds.sizes, np.arange(groups))
        found = candidate_pairs.candidates_of_step(
            benches, kinds, ground, s, 0, len(group), first, second
        )
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


@pytest.mark.plain
@pytest.mark.compiled
@pytest.mark.parametrize("name", MEETINGS)
def test_no_pair_comes_near_but_in_the_steps_that_name_it(name: str) -> None:
    route, start, end, reach = MEETINGS[name]
    sizes = MEETING_SIZES.get(name, SIZES)
    walk = Walk(sizes, route)
    at = np.linspace(start, end, 100)
    placed = walk.placement(at)
    found = Searched(walk, start, end)
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


@pytest.mark.plain
@pytest.mark.parametrize("longest", ["head", "last"])
def test_no_dragon_is_placed_where_only_a_head_could_meet_others_that_has_passed(longest: str) -> None:
    route = Route.joined([Line(20.0), Arc(1.2, 2.8), Line(60.0)])
    wide, narrow = Bench(1.7, 3.0, 0.2, 0.3), [Bench(1.1, 0.2, 0.1, 0.1)] * 10
    sizes = Dragon([wide, *narrow] if longest == "head" else [*narrow, wide])
    found = Searched(Walk(sizes, route), 14.0, 80.0)
    found.begin(0.3)
    steps = list(found.steps())
    assert 20.0 < steps[0].start < steps[-1].end < 37.0
    step, chains = steps[0].end - steps[0].start, int(found.room.course.tally[WalkTally.CHAINS])
    if longest == "head":
        assert chains * step < 10.0  # of 66 m
    else:  # where the last one stands is not known without
        assert chains * step > 40.0


def test_pairs_are_numbered_by_the_benches_that_are_in_any() -> None:
    rng = np.random.default_rng(0)
    for _case in range(20):
        both = np.sort(rng.choice(60, (int(rng.integers(1, 12)), 2)), axis=1)
        both[:, 1] += 2
        first, second = both[:, 0].copy(), both[:, 1].copy()
        place, members = np.full(70, -1, dtype=np.int64), np.empty(24, dtype=np.int64)
        mine, other = np.empty_like(first), np.empty_like(second)
        count = time_of_impact.number_members(first, second, members, place, mine, other)
        assert members[:count].tolist() == np.unique(both).tolist()
        assert (members[mine] == first).all()
        assert (members[other] == second).all()
        assert (place == -1).all()
