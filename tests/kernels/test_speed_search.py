"""The search for a greatest value: what it finds, what it leaves out, and how it is resumed."""

import math
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

from benchdragon import Arc, Clothoid, Dragon, Line, Route
from benchdragon.analysis.nearby import seams_of
from benchdragon.kernels import bench_cells as cells
from benchdragon.kernels import drive
from benchdragon.kernels import speed_search as peak
from benchdragon.kernels.bench_cells import CutCount
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate, DriveStep
from benchdragon.kernels.speed_search import PartFact, PartSpan, SpeedCount, SpeedNote
from benchdragon.kernels.status import Ended
from benchdragon.model.placement import Placement
from tests.kernels import rooms
from tests.kernels.quantities import QUANTITIES, size_of

pytestmark = pytest.mark.plain

DRAGON = Dragon.of_sizes(np.array([1.6, 1.1, 1.1, 1.1]), 0.2, 0.0, 0.0)
LINKS, INVERSE = np.unique(DRAGON.links, return_inverse=True)
GROUP = INVERSE.astype(np.int64)
ROUTE = Route.joined([Line(8.0), Arc(1.6, 1.0), Arc(2.0, -1.5), Clothoid(3.0, -0.5, 0.2), Line(9.0)])
FIRST, MIDDLE, LAST = 6.0, 11.0, 15.0
# Squares of the head's speed at FIRST, MIDDLE and LAST.
SQUARES = (0.4, 1.6, 0.9)


class Found(NamedTuple):
    """What a search knew at its end, and how it ended."""

    notes: FloatArray
    counts: list[int]
    upper: float
    ends: list[Ended]


def drives() -> peak.Drives:
    """A head that speeds up as far as MIDDLE and then slows down."""
    ways = np.array([[FIRST, MIDDLE], [MIDDLE, LAST]])
    squares = np.array([SQUARES[:2], SQUARES[1:]])
    return peak.Drives(ways, squares, 0.5 * np.diff(squares).ravel() / np.diff(ways).ravel())


def cut(route: Route) -> cells.Cells:
    """The cells of a route that the dragon walks through."""
    kinds = cells.CellKinds(LINKS[:, np.newaxis].copy(), np.tile([FIRST - 6.0, LAST], (len(LINKS), 1)))
    made, done = rooms.empty_cells(300, len(LINKS)), np.zeros(2, dtype=np.int64)
    reached, shop = np.array([FIRST - 6.0, 0.4]), rooms.workshop_for(len(LINKS), seams_of(route.rows))
    cuts = cells.Cuts(LAST, 0.4, 0.05, 1e-2)
    assert cells.cut_cells(route.rows, kinds, shop, cuts, made, reached, done, 300) == Ended.DONE
    return cells.Cells(*(table[: done[CutCount.CELLS] + 1].copy() for table in made))


def waiting(drives: peak.Drives, by_cells: int, room: int) -> tuple[peak.Heap, list[int]]:
    """A heap in which all stretches wait."""
    heap, count = rooms.empty_heap(room), len(drives.ways)
    heap.parts[:count] = [(math.inf, *way) for way in drives.ways]
    heap.marks[:count] = [(n, len(DRAGON), by_cells) for n in range(count)]
    return heap, [count, 0, 0, 0]


def seek(
    quantity: int,
    tolerance: float,
    *,
    by_cells: int = 1,
    by_chains: int = 0,
    limit: float = math.inf,
    route: Route = ROUTE,
    driven: peak.Drives | None = None,
    room: int = 400,
    budget: int = 10_000_000,
) -> Found:
    """Seek the greatest of a quantity, in calls of that budget, the heap growing from `room`.

    The first stretches, as many as `by_chains`, are looked at by chains at once.
    """
    driven = driven or drives()
    made = cut(route) if by_cells else rooms.empty_cells(0, 1)
    heap, counted = waiting(driven, by_cells, room)
    heap.marks[:by_chains, PartFact.BY_CELLS] = 0
    notes, counts = np.array([-1.0, 0.0, 0.0, 0.0, 0.0]), np.array(counted)
    aim = peak.SpeedAim(quantity, tolerance, limit, 0.9, 0.11)
    batch, chains = rooms.empty_batch(), rooms.chains_for(len(DRAGON) + 1, seams_of(route.rows))
    ends: list[Ended] = []
    while not ends or ends[-1] in (Ended.MORE, Ended.ROOM):
        ends.append(
            peak.seek_peak(
                route.rows, DRAGON.links, GROUP, made, aim, driven, heap, batch, chains, notes, counts,
                budget,
            )
        )  # fmt: skip
        if ends[-1] == Ended.ROOM:
            heap = peak.Heap(*(np.concatenate([table, np.empty_like(table)]) for table in heap))
    return Found(notes, counts.tolist(), max(notes[SpeedNote.UPPER], notes[SpeedNote.SEEN]), ends)


@cache
def found_of(quantity: int, by_cells: int) -> Found:
    """What a search for a thousandth finds, which several tests ask for."""
    return seek(quantity, 1e-3, by_cells=by_cells)


def sampled(name: str, at: FloatArray, end: float = MIDDLE) -> FloatArray:
    """A quantity's greatest size with the head at these places, at `end` as just before it."""
    one = Placement(DRAGON, ROUTE, at)
    driven = drives()
    n = (at > end).astype(np.int64)
    share = (at - driven.ways[n, 0]) / np.diff(driven.ways).ravel()[n]
    squares = driven.squares[n, 0] + share * np.diff(driven.squares).ravel()[n]
    return size_of(name, one, ROUTE, squares, driven.rates[n])


@pytest.mark.parametrize("by_cells", [0, 1])
@pytest.mark.parametrize("name", QUANTITIES)
def test_what_is_found_is_what_sampling_sees(name: str, by_cells: int) -> None:
    found = found_of(QUANTITIES[name], by_cells)
    most = sampled(name, np.linspace(FIRST, LAST, 2001)).max()
    assert most <= found.upper * (1.0 + 1e-9)
    assert found.notes[SpeedNote.SEEN] <= found.upper <= found.notes[SpeedNote.SEEN] * (1.0 + 1.01e-3)
    assert found.notes[SpeedNote.SEEN] == pytest.approx(most, rel=2e-3)
    beside = found.notes[SpeedNote.WHERE] + np.array([-1e-9, 0.0, 1e-9])
    stretch = found.counts[SpeedCount.WHEN]
    here = sampled(name, np.clip(beside, FIRST, LAST), MIDDLE if stretch else math.inf)
    row = found.counts[SpeedCount.ROW]
    assert here[:, row].max() == pytest.approx(found.notes[SpeedNote.SEEN], rel=1e-6)
    assert here.max() <= found.notes[SpeedNote.SEEN] * (1.0 + 1e-6)


def test_cells_spare_most_chains_and_change_no_answer() -> None:
    for name, quantity in QUANTITIES.items():
        with_cells, without = (found_of(quantity, n) for n in (1, 0))
        assert with_cells.counts[SpeedCount.EVALUATIONS] < without.counts[SpeedCount.EVALUATIONS], name
        lowest = max(found.notes[SpeedNote.SEEN] for found in (with_cells, without))
        assert lowest <= min(with_cells.upper, without.upper)


@pytest.mark.parametrize("by_cells", [0, 1])
def test_a_search_in_small_calls_finds_the_same(by_cells: int) -> None:
    whole = seek(DriveRate.TOTAL, 1e-3, by_cells=by_cells)
    assert whole.ends == [Ended.DONE]
    for room, budget in ((peak.CHAIN_SLOTS, 10_000_000), (400, 1), (peak.CHAIN_SLOTS + 2, 60)):
        parts = seek(DriveRate.TOTAL, 1e-3, by_cells=by_cells, room=room, budget=budget)
        assert parts.ends[-1] == Ended.DONE
        assert (Ended.MORE in parts.ends) == (budget < 100)
        assert (Ended.ROOM in parts.ends) == (room < 400)
        np.testing.assert_array_equal(parts.notes, whole.notes)
        assert parts.counts == whole.counts


def test_the_bracket_is_no_wider_than_asked_and_the_search_no_longer() -> None:
    evaluations = [seek(DriveRate.SPEEDS, 10.0**-n).counts[SpeedCount.EVALUATIONS] for n in (1, 3, 5)]
    assert evaluations[0] < evaluations[1] < evaluations[2]


@pytest.mark.parametrize("by_cells", [0, 1])
def test_what_is_put_aside_is_still_bounded(by_cells: int) -> None:
    most = sampled("speed", np.linspace(FIRST, LAST, 2001)).max()
    for limit in (1.003 * most, 1.05 * most):
        found = seek(DriveRate.SPEEDS, 1e-6, by_cells=by_cells, limit=limit)
        assert most <= found.upper <= limit
    for tolerance in (0.5, 0.2, 0.1, 0.05, 0.02, 0.01):
        found = seek(DriveRate.SPEEDS, tolerance, by_cells=by_cells)
        assert most <= found.upper <= found.notes[SpeedNote.SEEN] * (1.0 + tolerance) * (1.0 + 1e-9)


@pytest.mark.parametrize("seen", [0, 1])
def test_what_need_not_be_looked_at_is_still_bounded(seen: int) -> None:
    """Under a high limit one look is enough: what is left waits, or is put aside by its cells."""
    ways = np.array([[FIRST, FIRST], [FIRST, LAST]][1 - seen :])
    driven = peak.Drives(ways, np.ones(ways.shape), np.zeros(len(ways)))
    most = Placement(DRAGON, ROUTE, np.linspace(FIRST, LAST, 801)).speed_ratio.max()
    found = seek(DriveRate.SPEEDS, 1e-6, limit=300.0 * most, driven=driven, by_chains=seen)
    assert most <= found.upper <= 3.0 * most
    assert found.counts[SpeedCount.EVALUATIONS] < 20


def test_a_limit_that_is_kept_is_enough() -> None:
    fine = seek(DriveRate.TURNING, 1e-6)
    kept = seek(DriveRate.TURNING, 1e-6, limit=2.0 * fine.upper)
    assert fine.notes[SpeedNote.SEEN] <= kept.upper <= 2.0 * fine.upper
    assert kept.counts[SpeedCount.EVALUATIONS] < fine.counts[SpeedCount.EVALUATIONS]
    near = seek(DriveRate.TURNING, 1e-6, limit=fine.upper * (1.0 + 1e-5))
    assert near.upper <= fine.upper * (1.0 + 1e-5)
    broken = seek(DriveRate.TURNING, 1e-6, limit=0.9 * fine.upper)
    assert broken.notes[SpeedNote.SEEN] == pytest.approx(fine.notes[SpeedNote.SEEN], rel=2e-6)
    assert broken.upper <= broken.notes[SpeedNote.SEEN] * (1.0 + 1.01e-6)


@pytest.mark.parametrize("by_cells", [0, 1])
def test_a_chain_that_cannot_stand_ends_the_search(by_cells: int) -> None:
    short = Route.joined([Line(8.0), Arc(1.6, 1.0), Line(2.0)])
    found = seek(DriveRate.SPEEDS, 1e-3, by_cells=by_cells, route=short)
    assert found.ends == [Ended.FALLEN]


def test_a_jolt_without_way_counts_once() -> None:
    jolt = peak.Drives(np.full((1, 2), 8.5), np.zeros((1, 2)), np.array([2.0]))
    found = seek(DriveRate.ALONG, 1e-6, by_cells=0, driven=jolt)
    ratio = Placement(DRAGON, ROUTE, [8.5]).speed_ratio.max()
    assert found.notes[SpeedNote.SEEN] == pytest.approx(2.0 * ratio)
    assert found.upper == pytest.approx(2.0 * ratio)
    assert found.counts[SpeedCount.EVALUATIONS] <= 2


def test_a_head_that_stands_asks_for_nothing() -> None:
    standing = peak.Drives(np.array([[7.0, 9.0]]), np.zeros((1, 2)), np.zeros(1))
    for quantity in QUANTITIES.values():
        found = seek(quantity, 1e-6, driven=standing)
        assert (found.notes[SpeedNote.SEEN], found.upper) == (0.0, 0.0)


def test_of_parts_that_wait_the_greatest_bound_comes_first_then_the_first_on_the_way() -> None:
    rng = np.random.default_rng(4)
    heap, batch, counts = rooms.empty_heap(40), rooms.empty_batch(), np.zeros(4, dtype=np.int64)
    bounds, starts = rng.integers(0, 6, 40).astype(float), rng.permutation(40).astype(float)
    for n in range(40):
        peak.push(heap, counts, bounds[n], starts[n], starts[n] + 1.0, n, 2, n % 2)
    came = []
    for _n in range(40):
        peak.take(heap, counts, batch, 0)
        bound, start, end = batch.parts[0].tolist()
        stretch, links, by_cells = batch.marks[0].tolist()
        assert (bounds[stretch], starts[stretch], starts[stretch] + 1.0) == (bound, start, end)
        assert (links, by_cells) == (2, stretch % 2)
        came.append((-bound, start))
    assert came == sorted(came)
    assert counts[SpeedCount.OPEN] == 0


def test_a_long_way_is_cut_and_goes_on_waiting_whole() -> None:
    heap, batch, counts = rooms.empty_heap(40), rooms.empty_batch(), np.zeros(4, dtype=np.int64)
    peak.push(heap, counts, 3.0, 1.0, 101.0, 5, 2, 1)
    peak.take(heap, counts, batch, 0)
    peak.divide(heap, counts, batch, 0.5)
    parts = heap.parts[: counts[SpeedCount.OPEN]]
    parts = parts[np.argsort(parts[:, PartSpan.START])]
    assert len(parts) == peak.MOST_PART_PIECES
    assert (parts[:, PartSpan.BOUND] == 3.0).all()
    assert (parts[0, PartSpan.START], parts[-1, PartSpan.END]) == (1.0, 101.0)
    np.testing.assert_array_equal(parts[1:, PartSpan.START], parts[:-1, PartSpan.END])
    assert (heap.marks[: len(parts)] == (5, 2, 1)).all()


def test_what_rounding_may_add_is_bounded_too() -> None:
    aim, heap, batch = (
        peak.SpeedAim(DriveRate.SPEEDS, 1e-3, math.inf, 0.9, 0.11),
        rooms.empty_heap(4),
        rooms.empty_batch(),
    )
    batch.parts[0], batch.marks[0], batch.at[:2] = (math.inf, 0.0, 1.0), (0, 1, 0), (0.0, 1.0)
    notes, counts = np.array([1.0, 0.0, 0.0, 1.0, 1.0]), np.zeros(peak.SPEED_COUNTS, dtype=np.int64)
    most, off = np.array([1.0, 0.5]), np.full((2, peak.CHAIN_SLOTS), 0.125)
    off[0, 1] = 0.25
    peak.keep(aim, heap, batch, 0, 0, most, off, notes, counts)
    assert notes[SpeedNote.UPPER] == 1.25  # not looked at again, though it is more than is seen
    assert counts[SpeedCount.OPEN] == 0
    peak.keep(aim, heap, batch, 0, 0, 2.0 * most, off, notes, counts)
    assert heap.parts[0, PartSpan.BOUND] == 2.25
    assert counts[SpeedCount.OPEN] == 1


def test_steps_are_told_how_near_jumps_rounding_may_hide_sides() -> None:
    chains, batch = rooms.chains_for(len(DRAGON) + 1, seams_of(ROUTE.rows)), rooms.empty_batch()
    batch.at[:3], batch.slots[0] = (10.0, 10.05, 10.1), (0, 2)
    batch.parts[0], batch.marks[0] = (math.inf, 10.0, 10.1), (0, len(DRAGON), 0)
    aim, heap = peak.SpeedAim(DriveRate.ALONG, 1e-3, math.inf, 0.9, 0.11), rooms.empty_heap(9)
    notes, counts = np.array([-1.0, 0.0, 0.0, 0.0, 0.0]), np.zeros(peak.SPEED_COUNTS, dtype=np.int64)
    assert peak.place_batch(ROUTE.rows, DRAGON.links, batch.at, 3, chains, DriveRate.ALONG)
    peak.look_by_chains(ROUTE.rows, DRAGON.links, aim, drives(), heap, batch, 0, chains, notes, counts)
    assert (chains.errors.most[:3] > 0.0).all()
    assert chains.scratch.beside.tolist() == chains.errors.most[1:3].tolist()


def test_a_stretch_ends_at_the_speed_that_is_said() -> None:
    squares = np.square([[0.8018982346265828, 1.7398972300773403]])
    start, end = squares[0]
    assert start + 1.0 * (end - start) != end
    ways = np.array([[0.0, 5.0]])
    driven, drive_ = peak.Drives(ways, squares, np.array([0.2])), np.empty(drive.DRIVE_COLUMNS)
    peak.set_drive(driven, 0, 0.0, 5.0, drive_)
    assert drive_[: DriveStep.RATE].tolist() == [start, end]
    peak.set_drive(driven, 0, 2.5, 5.0, drive_)
    assert drive_[DriveStep.FROM] == pytest.approx(0.5 * (start + end))
