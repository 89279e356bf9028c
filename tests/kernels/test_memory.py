"""Memory of the engine's own: blocks, what is laid in them, and handles."""

from collections.abc import Iterator

import numpy as np
import pytest

from benchdragon.kernels import memory
from benchdragon.kernels.memory import HEADER, Header
from benchdragon.kernels.workspace import Benches, SearchProgress


@pytest.fixture(autouse=True)
def nothing_is_left() -> Iterator[None]:
    """All that was allocated is released."""
    before = memory.taken()
    yield
    assert memory.taken() == before


def test_a_block_holds_a_group_whose_arrays_are_laid_one_after_another() -> None:
    block = memory.new_block(memory.slot_count(Benches))
    slots = memory.integers_at(block, HEADER + memory.slot_count(Benches))
    assert memory.take(slots, 0, 8 * (3 + 12 + 3 + 3 + 1))
    memory.lay_from(slots, HEADER, slots[Header.OWNED])
    memory.lay_row(slots, 3)
    memory.lay_table(slots, 4, 3)
    for count in (3, 3, 1):
        memory.lay_row(slots, count)
    assert slots[Header.ADDRESS] == slots[Header.OWNED] + 8 * 22
    assert slots[Header.SLOT] == slots[Header.SLOTS] == len(slots)
    benches = memory.group_at(Benches, block + 8 * HEADER)
    assert [array.shape for array in benches] == [(3,), (4, 3), (3,), (3,), (1,)]
    assert benches.kind.dtype == np.int64
    for n, array in enumerate(benches):
        array[...] = n
    again = memory.group_at(Benches, block + 8 * HEADER)
    assert [array.min() for array in again] == [array.max() for array in again] == list(range(5))
    memory.release_block(block)


def test_what_is_laid_anew_is_seen_when_it_is_asked_for_again() -> None:
    block = memory.new_block(memory.slot_count(SearchProgress))
    slots = memory.integers_at(block, HEADER + memory.slot_count(SearchProgress))
    for size in (2, 50):
        memory.drop(slots, 1)
        assert memory.take(slots, 1, 16 * size)
        memory.lay_from(slots, HEADER, slots[Header.OWNED + 1])
        memory.lay_row(slots, size)
        memory.lay_row(slots, size)
        way, tally = memory.group_at(SearchProgress, block + 8 * HEADER)
        way[:], tally[:] = 0.5, 7
        assert (way.sum(), tally.sum()) == (0.5 * size, 7 * size)
    memory.release_block(block)


def test_memory_that_is_not_there_is_not_given() -> None:
    assert memory.allocate(1 << 60) == 0


def test_a_handle_stands_for_its_block_and_for_none_after_it() -> None:
    first, second = memory.remember(40), memory.remember(48)
    assert (memory.recall(first), memory.recall(second)) == (40, 48)
    assert memory.forget(first) == 40
    assert memory.recall(first) == memory.forget(first) == 0
    third = memory.remember(40)
    assert third != first
    assert memory.forget(second) == 48
    assert memory.forget(third) == 40
    assert memory.recall(-1) == memory.recall(0) == 0


def test_slots_of_fields_follow_one_another() -> None:
    slots = [memory.slot_of(Benches, name) for name in Benches._fields]
    assert slots == [HEADER + n for n in (0, 2, 5, 7, 9)]
    with pytest.raises(AttributeError, match="no field weights"):
        memory.slot_of(Benches, "weights")
