"""Contacts and least clearances of a walk, as a question: `open, seek, step, read, close`.

What is sought is looked for along spans of the head's way, one after another, in room that grows within
the engine (kernels/own_room.py). Steps end as kernels/search.py or kernels/contact_memory.py says.
"""

from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.contact_least import LOOKING, PASSING, least_on
from benchdragon.kernels.contact_memory import (
    BASE,
    BEGIN,
    BEST,
    BETWEEN,
    BLURRED,
    EARLY,
    END_SLOT,
    FIRST_BENCH,
    GOAL,
    LATE,
    LEAST_OFF,
    LEFT,
    MARGIN,
    MOST,
    NOTHING,
    OWN_MEMORY,
    READY,
    SECOND_BENCH,
    SEEN,
    STAGE,
    STOPPED,
    WALKED,
    WHERE,
    WITHIN,
    Asked,
    Hunt,
    fill_hunt,
    lay_hunt,
)
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
from benchdragon.kernels.course import AT, STEP_END, STEP_START
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.memory import (
    HEADER,
    OWNED,
    copy_row,
    group_at,
    integers_at,
    new_block,
    recall,
    release_block,
    remember,
    take,
)
from benchdragon.kernels.own_room import ROOMY
from benchdragon.kernels.question import CLOSED, MORE, SPENT
from benchdragon.kernels.search import CLEAR, FALLEN, FIRST_TOUCH, FOUND, LEAST, LOWER, PAIR, UPPER
from benchdragon.kernels.walk_search import SEEK


@entry
def open_contact(asked: Asked) -> int:
    """Open a question about a walk: its handle, 0 if there is no memory, -1 for too many kinds."""
    block = new_block(END_SLOT - HEADER)
    if block == 0:
        return 0
    slots = integers_at(block, END_SLOT)
    handle = 0
    if take(slots, OWN_MEMORY, lay_hunt(slots, 0, asked)):
        lay_hunt(slots, slots[OWNED + OWN_MEMORY], asked)
        handle = remember(block) if fill_hunt(block, asked) else -1
    if handle <= 0:
        release_block(block)
    else:
        group_at(Hunt, block + BASE).figures[GOAL] = NOTHING
    return handle


@entry
def seek_contact(handle: int, goal: int, said: Vector) -> bool:
    """Seek something from the next step on; False if there is no such question.

    Said is of LEAST: within which distance, m; of BETWEEN: within which, between which head positions,
    m, which distance is known, where, and of which benches; of SEEK and others: within which, if
    nothing was begun yet.
    """
    block = recall(handle)
    if block == 0:
        return False
    hunt = group_at(Hunt, block + BASE)
    f, limits = hunt.figures, hunt.limits
    f[GOAL], f[STAGE], f[WITHIN] = goal, LOOKING, said[0]
    f[LEFT] = limits[MOST]
    for n in range(hunt.note.shape[0]):
        hunt.note[n] = 0.0
    if goal == BETWEEN:
        f[EARLY], f[LATE], f[BEST], f[WHERE] = said[1], said[2], said[3], said[4]
        f[FIRST_BENCH], f[SECOND_BENCH] = said[5], said[6]
    return True


@entry
def read_contact(handle: int, figures: Vector, near: Vector) -> bool:
    """Fill arrays of a host's with what is known; False if there is no such question."""
    block = recall(handle)
    if block == 0:
        return False
    hunt = group_at(Hunt, block + BASE)
    copy_row(figures, hunt.figures)
    copy_row(near, hunt.near)
    return True


@kernel
def touched_on(block: int, left: float) -> int:
    """Seek the next touch, the end of one, or the next step; how a step ends."""
    hunt = group_at(Hunt, block + BASE)
    f, goal, slack = hunt.figures, int(hunt.figures[GOAL]), hunt.limits[LEAST_OFF]
    if f[READY] == 0.0:
        if goal == FIRST_TOUCH and f[STAGE] == LOOKING and hunt.walk.benches.kind.shape[0] > 2:
            f[STAGE] = PASSING
            if not stands(hunt, hunt.limits[BEGIN]):
                return STOPPED
            apart, off = tightest(hunt), off_at(hunt, hunt.limits[BEGIN])
            if apart <= hunt.limits[MARGIN] - off:
                f[EARLY] = f[LATE] = hunt.limits[BEGIN]
                return pair_told(hunt, f[LATE]) if is_sharp(hunt, off) else BLURRED
        made = begun(block, f[WITHIN] if goal == SEEK else hunt.limits[MARGIN])
        if made != ROOMY:
            return made
    ending = searched_on(block, goal, slack, left, SPENT)
    hunt = group_at(Hunt, block + BASE)
    f, note, way = hunt.figures, hunt.note, hunt.room.course.way
    if goal == SEEK:
        f[EARLY], f[LATE] = way[STEP_START], way[STEP_END]
        return ending
    if ending > FALLEN or ending == CLEAR:
        return ending
    f[EARLY], f[LATE] = note[LOWER], note[UPPER]
    set_pair(hunt, note[PAIR])
    return ending if pair_told(hunt, f[LATE]) == FOUND else STOPPED


@entry
def step_contact(handle: int, left: float) -> int:
    """Go on for some hundredths of a second; about so many handles may be placed; how that ended."""
    block = recall(handle)
    if block == 0:
        return CLOSED
    f = group_at(Hunt, block + BASE).figures
    goal = int(f[GOAL])
    f[SPENT] = 0.0
    if goal == NOTHING:
        return CLOSED
    ending = least_on(block, left) if goal in (LEAST, SEEN, BETWEEN) else touched_on(block, left)
    if f[READY]:
        f[WALKED] = group_at(Hunt, block + BASE).room.course.way[AT]
    if ending != MORE:
        f[GOAL] = NOTHING
    return ending
