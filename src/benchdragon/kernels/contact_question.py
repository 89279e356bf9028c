"""Contacts and least clearances of a walk, as a question: `open, seek, step, read, close`.

Spans of the head's way are searched one after another, in arrays that grow within the engine
(kernels/search_room.py). Exit statuses of steps are those of kernels/time_of_impact.py and
kernels/contact_memory.py.
"""

from benchdragon.kernels import contact_memory as told
from benchdragon.kernels import memory
from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.contact_least import LeastStage, least_on
from benchdragon.kernels.contact_memory import (
    ContactAsked,
    ContactEnding,
    ContactGiven,
    ContactGoal,
    ContactMemory,
    ContactTold,
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
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.memory import Header
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.search_room import RoomEnding
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.walk_search import WalkGoal
from benchdragon.kernels.workspace import Course


@entry
def open_contact(asked: ContactAsked) -> int:
    """Open a question about a walk; returns its handle, 0 without memory, -1 for too many kinds."""
    block = memory.new_block(told.CONTACT_END_SLOT - memory.HEADER)
    if block == 0:
        return 0
    slots = memory.integers_at(block, told.CONTACT_END_SLOT)
    handle = 0
    if memory.take(slots, ContactMemory.OWN, lay_hunt(slots, 0, asked)):
        lay_hunt(slots, slots[Header.OWNED + ContactMemory.OWN], asked)
        handle = memory.remember(block) if fill_hunt(block, asked) else -1
    if handle <= 0:
        memory.release_block(block)
    else:
        memory.group_at(Hunt, block + told.BASE).figures[ContactTold.GOAL] = ContactGoal.NOTHING
    return handle


@entry
def seek_contact(handle: int, goal: int, said: Vector) -> bool:
    """Set what the next steps seek; False if there is no such question.

    `said` has for LEAST the greatest distance of interest, m; for BETWEEN that distance, the two head
    positions, m, and a known distance, m, with its head position, m, and its benches; for SEEK and
    others the distance of interest if no search has begun yet.
    """
    block = memory.recall(handle)
    if block == 0:
        return False
    hunt = memory.group_at(Hunt, block + told.BASE)
    f, limits = hunt.figures, hunt.limits
    f[ContactTold.GOAL], f[ContactTold.STAGE], f[ContactTold.WITHIN] = goal, LeastStage.LOOKING, said[0]
    f[ContactTold.LEFT] = limits[ContactGiven.MOST]
    for n in range(hunt.note.shape[0]):
        hunt.note[n] = 0.0
    if goal == ContactGoal.BETWEEN:
        f[ContactTold.EARLY] = said[1]
        f[ContactTold.LATE] = said[2]
        f[ContactTold.BEST] = said[3]
        f[ContactTold.WHERE] = said[4]
        f[ContactTold.FIRST_BENCH], f[ContactTold.SECOND_BENCH] = said[5], said[6]
    return True


@entry
def read_contact(handle: int, figures: Vector, near: Vector) -> bool:
    """Fill a host's arrays with what is known; False if there is no such question."""
    block = memory.recall(handle)
    if block == 0:
        return False
    hunt = memory.group_at(Hunt, block + told.BASE)
    memory.copy_row(figures, hunt.figures)
    memory.copy_row(near, hunt.near)
    return True


@kernel
def touched_on(block: int, left: float) -> int:
    """Search for a touch, the end of one, or the next step; returns the step's exit status."""
    hunt = memory.group_at(Hunt, block + told.BASE)
    f = hunt.figures
    goal = int(hunt.figures[ContactTold.GOAL])
    slack = hunt.limits[ContactGiven.LEAST_OFF]
    if f[ContactTold.READY] == 0.0:
        if (
            goal == Goal.FIRST_TOUCH
            and f[ContactTold.STAGE] == LeastStage.LOOKING
            and hunt.walk.benches.kind.shape[0] > 2
        ):
            f[ContactTold.STAGE] = LeastStage.PASSING
            if not stands(hunt, hunt.limits[ContactGiven.BEGIN]):
                return ContactEnding.STOPPED
            apart, off = tightest(hunt), off_at(hunt, hunt.limits[ContactGiven.BEGIN])
            if apart <= hunt.limits[ContactGiven.MARGIN] - off:
                f[ContactTold.EARLY] = f[ContactTold.LATE] = hunt.limits[ContactGiven.BEGIN]
                return (
                    pair_told(hunt, f[ContactTold.LATE])
                    if is_sharp(hunt, off)
                    else ContactEnding.BLURRED
                )
        made = begun(
            block, f[ContactTold.WITHIN] if goal == WalkGoal.SEEK else hunt.limits[ContactGiven.MARGIN]
        )
        if made != RoomEnding.ROOMY:
            return made
    ending = searched_on(block, goal, slack, left, Told.SPENT)
    hunt = memory.group_at(Hunt, block + told.BASE)
    f, note, way = hunt.figures, hunt.note, hunt.room.course.way
    if goal == WalkGoal.SEEK:
        f[ContactTold.EARLY], f[ContactTold.LATE] = way[Course.STEP_START], way[Course.STEP_END]
        return ending
    if ending > Ending.FALLEN or ending == Ending.CLEAR:
        return ending
    f[ContactTold.EARLY], f[ContactTold.LATE] = note[Note.LOWER], note[Note.UPPER]
    set_pair(hunt, note[Note.PAIR])
    return ending if pair_told(hunt, f[ContactTold.LATE]) == Ending.FOUND else ContactEnding.STOPPED


@entry
def step_contact(handle: int, left: float) -> int:
    """Search for some hundredths of a second, or about `left` handles; returns the exit status."""
    block = memory.recall(handle)
    if block == 0:
        return QuestionEnding.CLOSED
    f = memory.group_at(Hunt, block + told.BASE).figures
    goal = int(f[ContactTold.GOAL])
    f[Told.SPENT] = 0.0
    if goal == ContactGoal.NOTHING:
        return QuestionEnding.CLOSED
    least = goal in (Goal.LEAST, ContactGoal.SEEN, ContactGoal.BETWEEN)
    ending = least_on(block, left) if least else touched_on(block, left)
    if f[ContactTold.READY]:
        f[ContactTold.WALKED] = memory.group_at(Hunt, block + told.BASE).room.course.way[Course.AT]
    if ending != QuestionEnding.MORE:
        f[ContactTold.GOAL] = ContactGoal.NOTHING
    return ending
