"""Searches for all pairs of a swaying dragon find what dense sampling finds, and leave no pair out."""

import math

import numpy as np
import pytest

from benchdragon.kernels import motion_bounds, time_of_impact
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, boxes_at, nearest_pair, radii
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.every_pair import Circles, PairsEnding, near_in_step, search_all_pairs
from benchdragon.kernels.stray_chain import bound_beside, place_along
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.model.curves import Arc, Line, Route, Spiral
from benchdragon.model.dragon import Dragon

ROUTES = {
    "spiral": (Route((Spiral(0.8, 18.0, 9.0),)), 3.0, 11.0),
    "hairpin": (Route.joined([Line(14.0), Arc(0.75, math.pi), Line(12.0)]), 13.0, 19.0),
}
NOTHING = np.empty((0, BOX_COLUMNS))
COUNT = 14


def dancers(seed: int, width: float) -> tuple[Dragon, FloatArray]:
    """Benches no two of which are alike, and how far aside their handles walk."""
    random = np.random.default_rng(seed)
    length = 1.2 + 0.05 * random.standard_normal(COUNT)
    dragon = Dragon.of_sizes(length, width + 0.01 * random.standard_normal(COUNT), 0.1, 0.1)
    return dragon, 0.03 * random.standard_normal(COUNT + 1)


def searched(
    name: str,
    dragon: Dragon,
    aside: FloatArray,
    goal: int,
    margin: float,
    slack: float,
    parts: int = 60,
) -> tuple[int, FloatArray]:
    route, start, end = ROUTES[name]
    room = time_of_impact.empty_search(COUNT + 1, COUNT, COUNT * COUNT)
    first, second = np.empty(COUNT * COUNT, dtype=np.int64), np.empty(COUNT * COUNT, dtype=np.int64)
    note = np.zeros(time_of_impact.NOTES)
    note[Note.NEAREST], note[Note.FLOOR] = 1.0, math.inf
    ending = search_all_pairs(
        room, goal, route.rows, dragon.links, aside, dragon.sizes, np.linspace(start, end, 61),
        first, second, margin, slack, 1e-9, 10_000, note,
    )  # fmt: skip
    return ending, note


def sampled(name: str, dragon: Dragon, aside: FloatArray, count: int) -> Placements:
    route, start, end = ROUTES[name]
    places = empty_placements(COUNT + 1, count)
    at = np.linspace(start, end, count)
    assert place_along(route.rows, dragon.links, aside, at, places) == count
    return places


@pytest.mark.parametrize("name", ROUTES)
@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.compiled)])
def test_no_sample_lies_below_the_least_distance(name: str, seed: int) -> None:
    dragon, aside = dancers(seed, 0.12)
    places = sampled(name, dragon, aside, 801)
    lowest, _t, i, j = nearest_pair(dragon.sizes, places.x, places.y)
    assert lowest > 0.0
    ending, note = searched(name, dragon, aside, Goal.LEAST, 0.0, 1e-5)
    assert ending == Ending.CLEAR
    assert lowest - 2e-3 < note[Note.NEAREST] <= lowest + 1e-5
    assert divmod(int(note[Note.PAIR]), COUNT) == (i, j)
    for margin, found in ((lowest + 1e-6, True), (note[Note.NEAREST] - 1e-4, False)):
        ending, note_ = searched(name, dragon, aside, Goal.FIRST_TOUCH, margin, 1e-8)
        assert (ending == Ending.FOUND) == found
        assert found or ending == Ending.CLEAR
        if found:
            before = sampled(name, dragon, aside, 801)
            start, end = ROUTES[name][1:]
            upto = 1 + int(800 * (note_[Note.UPPER] - start) / (end - start))
            early = nearest_pair(dragon.sizes, before.x[:, :upto].copy(), before.y[:, :upto].copy())[0]
            assert early > margin - 1e-6


@pytest.mark.parametrize("name", ROUTES)
def test_pairs_left_out_keep_farther_apart_all_through_the_step(name: str) -> None:
    route, start, end = ROUTES[name]
    dragon, aside = dancers(5, 0.2)
    room = time_of_impact.empty_search(COUNT + 1, COUNT, 1)
    chain = time_of_impact.Chain(
        route.rows, dragon.links, aside, dragon.sizes, np.arange(COUNT), NOTHING, NOTHING
    )
    circles = Circles(*np.empty((5, len(dragon))))
    radii(dragon.sizes, circles.radius)
    first, second = np.empty(COUNT * COUNT, dtype=np.int64), np.empty(COUNT * COUNT, dtype=np.int64)
    handles, left_out = np.empty((COUNT + 1, motion_bounds.HANDLE_COLUMNS)), 0
    for at in np.linspace(start, end - 0.3, 12):
        room.at[0], room.at[1] = at, at + 0.3
        for slot in (0, 1):
            assert time_of_impact.evaluate_slot(chain, room, slot, 0)
        time_of_impact.bound_members(chain, room, 1)
        bound_beside(route.rows, dragon.links, aside, room.places, 0, 1, handles)
        np.testing.assert_array_equal(room.handles[1:], handles[1:])
        places = empty_placements(COUNT + 1, 13)
        assert place_along(route.rows, dragon.links, aside, np.linspace(at, at + 0.3, 13), places) == 13
        least = np.full((COUNT, COUNT), math.inf)
        table = np.empty((COUNT, BOX_COLUMNS))
        for t in range(13):
            boxes_at(dragon.sizes, places.x, places.y, t, table)
            for j in range(2, COUNT):
                for i in range(j - 1):
                    least[i, j] = min(least[i, j], box_distance(table, i, j))
        for wanted in (0.0, 0.1, 0.3, 0.65, 0.7, 0.75):  # the last: benches two apart, end to end
            found = near_in_step(room, circles, wanted, first, second)
            kept = set(zip(first[:found].tolist(), second[:found].tolist(), strict=True))
            assert kept >= set(zip(*np.nonzero(least <= wanted), strict=True))
            left_out += COUNT * (COUNT - 1) // 2 - len(kept)
            assert near_in_step(room, circles, wanted, first[:1], second[:1]) == found
    assert left_out > 1000


def test_a_search_without_room_for_its_pairs_says_so() -> None:
    route, start, end = ROUTES["spiral"]
    dragon, aside = dancers(3, 0.2)
    room = time_of_impact.empty_search(COUNT + 1, COUNT, COUNT)
    scratch = np.empty(2, dtype=np.int64), np.empty(2, dtype=np.int64)
    note = np.zeros(time_of_impact.NOTES)
    ending = search_all_pairs(
        room, Goal.FIRST_TOUCH, route.rows, dragon.links, aside, dragon.sizes,
        np.array([start, end]), *scratch, 0.2, 1e-8, 1e-9, 100, note,
    )  # fmt: skip
    assert ending == PairsEnding.CROWDED


def test_where_a_chain_cannot_stand_the_search_ends() -> None:
    dragon, _aside = dancers(3, 0.05)
    ending, note = searched("hairpin", dragon, np.full(COUNT + 1, 0.74), Goal.FIRST_TOUCH, 0.0, 1e-8)
    assert ending == Ending.FALLEN
    assert 13.9 < note[Note.UPPER] < 14.3
