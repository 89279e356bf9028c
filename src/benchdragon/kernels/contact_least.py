"""The least distance of any two benches along a walk: bracketed pass by pass, as narrow as can be.

A low distance is seen here and there, then searched below. What makes a bracket narrower may take a
share of a question's work, counted apart, and is given up where it is dearer.
"""

import math

from benchdragon.kernels import contact_memory as told
from benchdragon.kernels import contact_steps
from benchdragon.kernels.box_hierarchy import END as ROUTE_END
from benchdragon.kernels.contact_memory import Hunt
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.local_minima import MOST_SAMPLED, low_pair
from benchdragon.kernels.memory import group_at
from benchdragon.kernels.question import MORE, OVER_MEMORY, SPENT
from benchdragon.kernels.search_room import ROOMY
from benchdragon.kernels.time_of_impact import CLEAR, FALLEN, FLOOR, FOUND, LEAST, NEAREST, PAIR, UPPER
from benchdragon.kernels.walk_search import SEEK
from benchdragon.kernels.workspace import GOAL as WAY_GOAL

# What LEAST is doing.
LOOKING, THROUGH, OPENING, PASSING = range(4)
# The pass of LEAST that lowers what was seen at the start alone.
LOWERING = -1
# The least distance of dragons that are not looked over is first guessed to be this, m, and the guess
# multiplied by so much until some pair comes nearer.
FIRST_REACH, FARTHER_ON = 0.003, 6.0


@kernel
def looked(hunt: Hunt) -> bool:
    """See a low distance here and there, so that what is farther need not be searched.

    False where the dragon cannot stand at the start.
    """
    walk, f, limits = hunt.walk, hunt.figures, hunt.limits
    start, benches = limits[told.BEGIN], walk.benches
    still = start == limits[told.END]
    f[told.WHERE], f[told.BEST], f[told.FLOOR_AT] = start, math.inf, 0.0
    if still or benches.kind.shape[0] > MOST_SAMPLED:
        if not contact_steps.stands(hunt, start):
            return False
        f[told.BEST] = max(contact_steps.tightest(hunt), 0.0)
        f[told.FLOOR_AT] = f[told.BEST] if still else 0.0
        return True
    for n in range(hunt.spans.shape[0]):
        apart, s, i, j = low_pair(
            walk.rows, benches.links, benches.sizes, hunt.spans[n, 0], hunt.spans[n, 1], hunt.at,
            hunt.placed, hunt.boxes,
        )  # fmt: skip
        if apart < f[told.BEST]:
            f[told.BEST], f[told.WHERE], f[told.FIRST_BENCH], f[told.SECOND_BENCH] = apart, s, i, j
    f[told.BEST] = max(f[told.BEST], 0.0)
    return True


@kernel
def least_told(hunt: Hunt) -> int:
    """How a step ends that found the least distance."""
    f = hunt.figures
    if not contact_steps.is_sharp(hunt, contact_steps.off_at(hunt, f[told.WHERE])):
        return told.BLURRED
    f[told.EARLY] = f[told.LATE] = f[told.WHERE]
    return contact_steps.pair_told(hunt, f[told.WHERE])


@kernel
def looked_over(hunt: Hunt) -> bool:
    """Whether low distances are looked for here and there before all are searched."""
    return hunt.walk.benches.kind.shape[0] <= MOST_SAMPLED or hunt.figures[told.GOAL] == told.BETWEEN


@kernel
def started(block: int) -> int:
    """Take what is seen here and there, or known, for a start: ROOMY, or how a step ends."""
    hunt = group_at(Hunt, block + told.BASE)
    f = hunt.figures
    f[told.STAGE] = OPENING
    if f[told.GOAL] == told.BETWEEN:
        return ROOMY
    if not looked(hunt):
        return told.STOPPED
    if f[told.GOAL] == told.SEEN or hunt.limits[told.BEGIN] == hunt.limits[told.END]:
        return least_told(hunt)
    f[told.REACH] = f[told.BEST] if looked_over(hunt) else FIRST_REACH
    if f[told.BEST] > 0.0:
        return ROOMY
    f[told.STAGE] = THROUGH
    return contact_steps.begun(block, 0.0)


@kernel
def tolerance_of(hunt: Hunt) -> float:
    """How wide the bracket of the pass at hand may be, m."""
    n = int(hunt.figures[told.PASS])
    return hunt.tolerances[n] if 0 <= n < hunt.tolerances.shape[0] else math.inf


@kernel
def pass_begun(block: int, n: int) -> int:
    """Begin pass n of LEAST: ROOMY, or how a step ends."""
    made = ROOMY if n == LOWERING else contact_steps.begun_again(block)
    hunt = group_at(Hunt, block + told.BASE)
    f, note = hunt.figures, hunt.note
    f[told.PASS], f[told.ASIDE], f[told.LEFT] = n, 0.0, hunt.limits[told.MOST_LEAST]
    f[told.AIMED] = f[told.REACH] if n == LOWERING else min(f[told.REACH], f[told.BEST])
    for k in range(note.shape[0]):
        note[k] = 0.0
    note[NEAREST], note[FLOOR] = f[told.AIMED], math.inf
    return made


@kernel
def lowered(hunt: Hunt, ending: int) -> bool:
    """Take over what a pass that ended so has seen; whether its floor was found."""
    f, note = hunt.figures, hunt.note
    if note[NEAREST] < f[told.AIMED]:
        f[told.BEST], f[told.WHERE] = max(note[NEAREST], 0.0), note[UPPER]
        contact_steps.set_pair(hunt, note[PAIR])
    f[told.FLOOR_AT] = max(min(note[FLOOR], note[NEAREST] - tolerance_of(hunt)), 0.0)
    return ending == CLEAR or f[told.BEST] == 0.0


@kernel
def passed_on(block: int, left: float) -> tuple[int, bool]:
    """Go on with the pass at hand; how a step ends, or ROOMY at its end, and whether that was the last.

    What is too dear is given up, without a word. A last pass, of whatever width, sees the whole walk.
    """
    hunt = group_at(Hunt, block + told.BASE)
    f, n, count = hunt.figures, int(hunt.figures[told.PASS]), hunt.tolerances.shape[0]
    share, counted, aside = left, SPENT, 0 <= n < count
    if aside:
        share, counted = hunt.limits[told.REFINING_ON if n else told.REFINING], told.ASIDE
    ending = contact_steps.searched_on(block, LEAST, tolerance_of(hunt), share, counted)
    hunt = group_at(Hunt, block + told.BASE)
    f = hunt.figures
    if ending <= FALLEN:
        closed = lowered(hunt, ending)
        if n == count or (closed and n != LOWERING):
            return ROOMY, True
    elif not (aside and (ending == OVER_MEMORY or (ending == MORE and f[told.ASIDE] > share))):
        return ending, False
    return pass_begun(block, n + 1), False


@kernel
def opened(block: int) -> int:
    """Begin to look for pairs within reach: ROOMY, or how a step ends."""
    hunt = group_at(Hunt, block + told.BASE)
    f, made = hunt.figures, ROOMY
    if f[told.GOAL] == told.BETWEEN:
        if f[told.READY] == 0.0:
            made = contact_steps.begun(block, f[told.WITHIN])
        hunt = group_at(Hunt, block + told.BASE)
        f[told.REACH], f[told.BEGUN] = f[told.BEST], f[told.EARLY]
        hunt.room.course.way[WAY_GOAL] = min(f[told.LATE], hunt.room.ground.measures[ROUTE_END])
    else:
        f[told.REACH] = min(f[told.REACH], f[told.BEST], f[told.WITHIN])
        made = contact_steps.begun(block, f[told.REACH])
    f[told.STAGE] = PASSING
    first = 0 if looked_over(hunt) else LOWERING
    return pass_begun(block, first) if made == ROOMY else made


@kernel
def walked_through(block: int, left: float) -> int:
    """Walk on where benches overlap, whether the dragon can all the way; how a step ends."""
    while True:
        ending = contact_steps.searched_on(block, SEEK, 0.0, left, SPENT)
        if ending != FOUND:
            return least_told(group_at(Hunt, block + told.BASE)) if ending == CLEAR else ending


@kernel
def round_over(hunt: Hunt) -> int:
    """How a step ends once all within reach was seen; ROOMY if more is to be looked for."""
    f = hunt.figures
    if f[told.BEST] <= f[told.REACH] or f[told.GOAL] == told.BETWEEN:
        return least_told(hunt)
    if f[told.REACH] >= f[told.WITHIN]:
        return told.FARTHER
    f[told.REACH], f[told.STAGE] = f[told.REACH] * FARTHER_ON, OPENING
    return ROOMY


@kernel
def least_on(block: int, left: float) -> int:
    """Seek the least distance; how a step ends."""
    while True:
        hunt = group_at(Hunt, block + told.BASE)
        stage, last = hunt.figures[told.STAGE], False
        if stage == THROUGH:
            return walked_through(block, left)
        if stage == LOOKING:
            made = started(block)
        elif stage == OPENING:
            made = opened(block)
        else:
            made, last = passed_on(block, left)
        if last:
            made = round_over(group_at(Hunt, block + told.BASE))
        if made != ROOMY:
            return made
