"""Touches of one obstacle, and the least distance of benches from it, as a question of the engine.

It is opened for a walk and an obstacle; exit statuses of steps are those of kernels/obstacle_search.py.
"""

from benchdragon.kernels import memory
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.entries import entry
from benchdragon.kernels.obstacle_memory import Beside, ObstacleTold, SizeWay, begin_beside
from benchdragon.kernels.obstacle_paths import stands
from benchdragon.kernels.obstacle_search import seek_beside, step_beside
from benchdragon.kernels.question import QuestionEnding, Told

BASE, BESIDE_SLOTS = 8 * memory.HEADER, memory.slot_count(Beside)


@entry
def open_obstacle(
    rows: Table, links: Vector, sizes: Table, outline: Table, repeats: Table, asked: Vector
) -> int:
    """Open a question about a walk and an obstacle; returns its handle, 0 without memory.

    The dragon must have a place at both ends. `repeats` are those parts of the route that lead back to
    where it was (spans.REPEAT); `asked` is as in kernels/obstacle_memory.py. All is copied.
    """
    block = memory.new_block(BESIDE_SLOTS)
    if block == 0:
        return 0
    if begin_beside(block, memory.HEADER, rows, links, sizes, outline, repeats, asked):
        stands(memory.group_at(Beside, block + BASE))
        handle = memory.remember(block)
        if handle:
            return handle
    memory.release_block(block)
    return 0


@entry
def seek_obstacle(handle: int, goal: int, narrow: float) -> bool:
    """Seek FIRST_TOUCH, or LEAST in a bracket so narrow, m; False if there is no such question."""
    block = memory.recall(handle)
    if block == 0:
        return False
    seek_beside(memory.group_at(Beside, block + BASE), goal, narrow)
    return True


@entry
def step_obstacle(handle: int, left: float) -> int:
    """Search for some hundredths of a second, or about `left` handles; returns the exit status."""
    block = memory.recall(handle)
    if block == 0:
        return QuestionEnding.CLOSED
    memory.group_at(Beside, block + BASE).figures[Told.SPENT] = 0.0
    return step_beside(block, memory.HEADER, left)


@entry
def read_obstacle(handle: int, figures: Vector) -> bool:
    """Fill figures with what is known; False if there is no such question."""
    block = memory.recall(handle)
    if block == 0:
        return False
    memory.copy_row(figures, memory.group_at(Beside, block + BASE).figures)
    return True


@entry
def read_found(handle: int, first: int, found: Table) -> bool:
    """Fill found with rows from a first on of what was found; False if there are not so many."""
    block = memory.recall(handle)
    if block == 0:
        return False
    beside = memory.group_at(Beside, block + BASE)
    if first < 0 or first + found.shape[0] > beside.figures[ObstacleTold.COUNT]:
        return False
    for n in range(found.shape[0]):
        memory.copy_row(found[n], beside.found[first + n])
    return True


@entry
def read_ways(handle: int, ways: Table) -> int:
    """Fill `ways` with the way that each size of bench walks; returns the number of sizes."""
    block, count = memory.recall(handle), 0
    if block == 0:
        return 0
    known = memory.group_at(Beside, block + BASE).ways
    for i in range(known.shape[0]):
        if known[i, SizeWay.COUNT] > 0.0 and count < ways.shape[0]:
            memory.copy_row(ways[count], known[i])
            count += 1
    return count
