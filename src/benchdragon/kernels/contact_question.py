"""Contacts and least clearances of a walk, as a question: `open, seek, step, read, close`.

What is sought is looked for along spans of the head's way, one after another, in room that grows within
the engine (kernels/search_room.py). Steps end as kernels/time_of_impact.py or
kernels/contact_memory.py says.
"""

from benchdragon.kernels import contact_memory as told
from benchdragon.kernels import memory
from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.contact_least import LOOKING, PASSING, least_on
from benchdragon.kernels.contact_memory import Asked, Hunt, fill_hunt, lay_hunt
from benchdragon.kernels.contact_steps import (
    begun,
    is_sharp,
    off_at,
    pair_told,
    searched_on,
    set_pair,
    stands,
    tightest,
)
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.question import CLOSED, MORE, SPENT
from benchdragon.kernels.search_room import ROOMY
from benchdragon.kernels.time_of_impact import (
    CLEAR,
    FALLEN,
    FIRST_TOUCH,
    FOUND,
    LEAST,
    LOWER,
    PAIR,
    UPPER,
)
from benchdragon.kernels.walk_search import SEEK
from benchdragon.kernels.workspace import AT, STEP_END, STEP_START


@entry
def open_contact(asked: Asked) -> int:
    """Open a question about a walk: its handle, 0 if there is no memory, -1 for too many kinds."""
    block = memory.new_block(told.END_SLOT - memory.HEADER)
    if block == 0:
        return 0
    slots = memory.integers_at(block, told.END_SLOT)
    handle = 0
    if memory.take(slots, told.OWN_MEMORY, lay_hunt(slots, 0, asked)):
        lay_hunt(slots, slots[memory.OWNED + told.OWN_MEMORY], asked)
        handle = memory.remember(block) if fill_hunt(block, asked) else -1
    if handle <= 0:
        memory.release_block(block)
    else:
        memory.group_at(Hunt, block + told.BASE).figures[told.GOAL] = told.NOTHING
    return handle


@entry
def seek_contact(handle: int, goal: int, said: Vector) -> bool:
    """Seek something from the next step on; False if there is no such question.

    Said is of LEAST: within which distance, m; of BETWEEN: within which, between which head positions,
    m, which distance is known, where, and of which benches; of SEEK and others: within which, if
    nothing was begun yet.
    """
    block = memory.recall(handle)
    if block == 0:
        return False
    hunt = memory.group_at(Hunt, block + told.BASE)
    f, limits = hunt.figures, hunt.limits
    f[told.GOAL], f[told.STAGE], f[told.WITHIN] = goal, LOOKING, said[0]
    f[told.LEFT] = limits[told.MOST]
    for n in range(hunt.note.shape[0]):
        hunt.note[n] = 0.0
    if goal == told.BETWEEN:
        f[told.EARLY], f[told.LATE], f[told.BEST], f[told.WHERE] = said[1], said[2], said[3], said[4]
        f[told.FIRST_BENCH], f[told.SECOND_BENCH] = said[5], said[6]
    return True


@entry
def read_contact(handle: int, figures: Vector, near: Vector) -> bool:
    """Fill arrays of a host's with what is known; False if there is no such question."""
    block = memory.recall(handle)
    if block == 0:
        return False
    hunt = memory.group_at(Hunt, block + told.BASE)
    memory.copy_row(figures, hunt.figures)
    memory.copy_row(near, hunt.near)
    return True


@kernel
def touched_on(block: int, left: float) -> int:
    """Seek the next touch, the end of one, or the next step; how a step ends."""
    hunt = memory.group_at(Hunt, block + told.BASE)
    f, goal, slack = hunt.figures, int(hunt.figures[told.GOAL]), hunt.limits[told.LEAST_OFF]
    if f[told.READY] == 0.0:
        if goal == FIRST_TOUCH and f[told.STAGE] == LOOKING and hunt.walk.benches.kind.shape[0] > 2:
            f[told.STAGE] = PASSING
            if not stands(hunt, hunt.limits[told.BEGIN]):
                return told.STOPPED
            apart, off = tightest(hunt), off_at(hunt, hunt.limits[told.BEGIN])
            if apart <= hunt.limits[told.MARGIN] - off:
                f[told.EARLY] = f[told.LATE] = hunt.limits[told.BEGIN]
                return pair_told(hunt, f[told.LATE]) if is_sharp(hunt, off) else told.BLURRED
        made = begun(block, f[told.WITHIN] if goal == SEEK else hunt.limits[told.MARGIN])
        if made != ROOMY:
            return made
    ending = searched_on(block, goal, slack, left, SPENT)
    hunt = memory.group_at(Hunt, block + told.BASE)
    f, note, way = hunt.figures, hunt.note, hunt.room.course.way
    if goal == SEEK:
        f[told.EARLY], f[told.LATE] = way[STEP_START], way[STEP_END]
        return ending
    if ending > FALLEN or ending == CLEAR:
        return ending
    f[told.EARLY], f[told.LATE] = note[LOWER], note[UPPER]
    set_pair(hunt, note[PAIR])
    return ending if pair_told(hunt, f[told.LATE]) == FOUND else told.STOPPED


@entry
def step_contact(handle: int, left: float) -> int:
    """Go on for some hundredths of a second; about so many handles may be placed; how that ended."""
    block = memory.recall(handle)
    if block == 0:
        return CLOSED
    f = memory.group_at(Hunt, block + told.BASE).figures
    goal = int(f[told.GOAL])
    f[SPENT] = 0.0
    if goal == told.NOTHING:
        return CLOSED
    least = goal in (LEAST, told.SEEN, told.BETWEEN)
    ending = least_on(block, left) if least else touched_on(block, left)
    if f[told.READY]:
        f[told.WALKED] = memory.group_at(Hunt, block + told.BASE).room.course.way[AT]
    if ending != MORE:
        f[told.GOAL] = told.NOTHING
    return ending
