"""Queries about single pairs find what dense sampling of that pair finds, whatever the others do."""

import numpy as np
import pytest

from benchdragon.kernels import time_of_impact
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, boxes_at
from benchdragon.kernels.chain import empty_placements, march
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.pair_queries import ANSWER_COLUMNS, NUMBERS, PairAnswer, search_pairs
from benchdragon.kernels.rounding import SEAM_COLUMNS, find_seams
from benchdragon.kernels.time_of_impact import Ending, Goal
from benchdragon.model.curves import Route, Spiral
from benchdragon.model.dragon import Dragon

ROWS = Route((Spiral.between(0.4, 3.6, 1.2),)).rows
DRAGON = Dragon.uniform(
    20, head_length=1.5, body_length=1.1, tail_length=1.1, front_inset=0.1, rear_inset=0.1
)
START, END = 60.0, 64.0
# Pairs of benches, and widths, m, with which they touch in that span, and do not.
PAIRS = ((0, 16, 0.34), (0, 16, 0.335), (2, 18, 0.42), (0, 10, 0.43), (0, 15, 0.3))


def asked(goal: int) -> FloatArray:
    seams = np.empty((len(ROWS), SEAM_COLUMNS))
    find_seams(ROWS, seams)
    first, second = np.array([pair[:2] for pair in PAIRS]).T.copy()
    width, out = np.array([pair[2] for pair in PAIRS]), np.empty((len(PAIRS), ANSWER_COLUMNS))
    room, spans = (
        time_of_impact.empty_search(len(DRAGON) + 1, 2, 1),
        np.full((len(PAIRS), 2), (START, END)),
    )
    search_pairs(
        room, goal, ROWS, DRAGON.links, DRAGON.sizes.copy(), seams, first, second, width, spans, 1e-12,
        1e-12, 3000, np.empty(NUMBERS, dtype=np.int64), np.empty(time_of_impact.NOTES), out,
    )  # fmt: skip
    return out


def sampled(pair: tuple[int, int, float], s: FloatArray) -> FloatArray:
    places, sizes = empty_placements(len(DRAGON) + 1, len(s)), DRAGON.sizes.copy()
    march(ROWS, DRAGON.links, s, 0, len(s), places)
    sizes[1] = pair[2]
    found = []
    for t in range(len(s)):
        boxes = np.empty((len(DRAGON), BOX_COLUMNS))
        boxes_at(sizes, places.x, places.y, t, boxes)
        found.append(box_distance(boxes, pair[0], pair[1]))
    return np.array(found)


def test_a_first_touch_is_where_sampling_sees_it() -> None:
    s = np.linspace(START, END, 81)
    endings = set()
    for pair, row in zip(PAIRS, asked(Goal.FIRST_TOUCH), strict=True):
        apart = sampled(pair, s)
        endings.add(int(row[PairAnswer.ENDING]))
        if row[PairAnswer.ENDING] == Ending.CLEAR:
            assert apart.min() > 0.0
        else:
            assert row[PairAnswer.ENDING] == Ending.FOUND
            assert (apart[s < row[PairAnswer.SOUGHT_LOW]] > 0.0).all()
            assert sampled(pair, row[[PairAnswer.SOUGHT_HIGH]])[0] == pytest.approx(0.0, abs=1e-9)
    assert endings == {Ending.CLEAR, Ending.FOUND}


def test_a_least_separation_is_no_more_than_sampling_sees() -> None:
    s = np.linspace(START, END, 81)
    for pair, row in zip(PAIRS, asked(Goal.LEAST), strict=True):
        least = sampled(pair, s).min()
        assert (row[PairAnswer.ENDING] == Ending.FOUND) is (least < 0.0)
        assert least < 0.0 or least - 1e-3 < row[PairAnswer.SEPARATION] <= least
