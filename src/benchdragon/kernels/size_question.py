"""How small or large one size of a plan may be, as a question: `open, seek, step, rows, close`.

All of the search lies in a block of the engine's own memory, which a handle stands for. A host opens
the question with the numbers of a plan, says what is sought, and steps until it is found, as
kernels/question.py says. The walk of a size is looked at beside each obstacle, then for contact.
"""

import math

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import nearest_pair
from benchdragon.kernels.curve import LENGTH, S_START
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.family import FIXED, ROUTE, Family, falls_soon, set_walk
from benchdragon.kernels.local_minima import MOST_SAMPLED, SHRINKS, local_minimum, low_pair
from benchdragon.kernels.memory import (
    HEADER,
    OWNED,
    clear,
    copy_row,
    copy_table,
    group_at,
    integers_at,
    new_block,
    recall,
    release_block,
    remember,
    take,
)
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.question import (
    CLOSED,
    MORE,
    OUT_OF_MEMORY,
    OVER_MEMORY,
    SPENT,
    WANTED,
)
from benchdragon.kernels.rounding import bench_errors, find_seams
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.route_parts import settle_rows
from benchdragon.kernels.search_room import (
    NO_MEMORY,
    PLACES,
    ROOMY,
    ROUTE_ROWS,
    TOO_LARGE,
    Aim,
    begin_workspace,
    ground_bytes,
    group_count,
    grow_workspace,
)
from benchdragon.kernels.size_bracket import (
    BAD,
    CAUTION,
    FAILS,
    FIRST_CAUTION,
    GOOD,
    NOW,
    PASSES,
    SENSE,
    SIZE,
    SLACK,
    STAGE,
    TOLERANCE,
    TRIED,
    UNDECIDED,
)
from benchdragon.kernels.size_memory import (
    BASE,
    BESIDE,
    BROKEN,
    BYTES,
    DOING,
    END_SLOT,
    FIRST,
    IDLE,
    LAST,
    LEAST_OFF,
    LEFT,
    MARCHED,
    MARGIN,
    MOST,
    NARROW,
    ONE,
    ORIGIN_X,
    ORIGIN_Y,
    OWN_MEMORY,
    PLAN_SIZE,
    RESULT,
    ROOM_SLOT,
    SAFER,
    SEARCHING,
    SEEKING,
    UNSURE,
    WAITING,
    WALK_SLOT,
    WIDTH,
    Sought,
    Square,
    fill,
    lay_all,
    make_route,
    make_searches,
)
from benchdragon.kernels.size_search import (
    BORDER,
    DISTANCE,
    FAILED,
    GUIDE,
    LOW_PAIR,
    MEET_FRONT,
    MEET_LEFT,
    MEET_REAR,
    MEET_S,
    MEETINGS,
    NOBODY,
    ROOTED,
    WALK,
    next_task,
)
from benchdragon.kernels.size_square import GOES_ON, begin_square, looked_beside
from benchdragon.kernels.swept_boxes import MOST_OFF
from benchdragon.kernels.time_of_impact import (
    CLEAR,
    EVALUATIONS,
    FALLEN,
    FIRST_TOUCH,
    LOWER,
    OFF,
    PAIR,
    UPPER,
)
from benchdragon.kernels.walk_search import (
    ASTRAY,
    CALL,
    CROWDED,
    SEARCHED,
    search_walk,
    work_done,
)
from benchdragon.kernels.workspace import AT as WALKED
from benchdragon.kernels.workspace import PLACED, SOUND, Walk

# What may be sought besides GROW and BORDER of size_search: how the walk of one size goes.
ALONE = 3
# How a step ends, besides WALK and the endings of size_search, and those of kernels/question.py.
TRIED_ALONE = 7
# Sizes are tried to so many times the plan's own where there are obstacles.
FAR = 10.0


@entry
def open_size(family: Family, walk: Walk, square: Square, limits: Vector, beginnings: IntVector) -> int:
    """Open a question about a family, of which `walk` is one; its handle, 0 if there is no memory.

    What is handed over is copied. See LIMITS, and `search_room.BEGINNINGS`.
    """
    block = new_block(END_SLOT - HEADER)
    if block == 0:
        return 0
    slots, places = integers_at(block, END_SLOT), beginnings[PLACES]
    size = lay_all(slots, 0, family, walk, square, places)
    if take(slots, OWN_MEMORY, size) and make_route(slots, walk.rows.shape[0]):
        lay_all(slots, slots[OWNED + OWN_MEMORY], family, walk, square, places)
        fill(group_at(Sought, block + BASE), family, walk, square, limits, beginnings)
        if family.numbers[ROUTE] == FIXED:
            settle(block)
        handle = remember(block) if make_searches(block) else 0
        if handle:
            return handle
    release_block(block)
    return 0


@entry
def seek_size(handle: int, stage: int, size: float, good: float) -> bool:
    """Seek, from the next step on, GROW from a size, BORDER between it and a good one, or ALONE.

    ALONE leaves the search before as it stands. False if there is no such question.
    """
    block = recall(handle)
    if block == 0:
        return False
    sought = group_at(Sought, block + BASE)
    state, limits, figures = sought.state, sought.limits, sought.figures
    figures[DOING], figures[ONE] = SEEKING, 0.0
    if stage == ALONE:
        figures[ONE], state[NOW] = 1.0, size
        return True
    clear(state)
    state[SENSE], state[TOLERANCE] = limits[SAFER], limits[NARROW]
    state[SLACK], state[CAUTION] = limits[LEAST_OFF], FIRST_CAUTION
    state[STAGE], state[SIZE] = stage, size
    if stage == BORDER:
        state[GOOD], state[BAD], state[TRIED] = good, size, 1.0
    for n in range(MEETINGS):
        sought.meetings[n, MEET_FRONT] = NOBODY
    return True


@entry
def read_size(handle: int, figures: Vector, state: Vector, doubts: Vector, meetings: Table) -> bool:
    """Fill arrays of a host's with what is known; False if there is no such question."""
    block = recall(handle)
    if block == 0:
        return False
    sought = group_at(Sought, block + BASE)
    copy_row(state, sought.state)
    copy_row(doubts, sought.doubts)
    copy_table(meetings, sought.meetings)
    copy_row(figures, sought.figures)
    return True


@kernel
def walk_of(block: int, size: float) -> tuple[int, float, float]:
    """Lay the walk of a size: its rows, 0 if there is none, and between which its head goes, m."""
    slots = integers_at(block, END_SLOT)
    while True:
        sought = group_at(Sought, block + BASE)
        slots[WALK_SLOT + 1] = sought.sizes[ROUTE_ROWS]
        sought = group_at(Sought, block + BASE)
        count, first, last = set_walk(sought.family, sought.walk, sought.at, sought.placed, size)
        if count >= 0:
            break
        if not make_route(slots, -count) or not make_searches(block):
            sought.figures[DOING] = BROKEN
            return 0, math.nan, math.nan
    slots[WALK_SLOT + 1] = count
    if count > 0 and sought.family.numbers[ROUTE] != FIXED:
        settle(block)
    return count, first, last


@kernel
def settle(block: int) -> None:
    """Let the rows of the route be told from where the dance is searched."""
    sought = group_at(Sought, block + BASE)
    x, y = sought.limits[ORIGIN_X], sought.limits[ORIGIN_Y]
    if x != 0.0 or y != 0.0:
        settle_rows(sought.walk.rows, x, y)


@kernel
def hint(block: int) -> float:
    """Fill GUIDE with a pair that comes near in the walk of NOW; how near less the margin, m."""
    count, first, last = walk_of(block, group_at(Sought, block + BASE).state[NOW])
    sought = group_at(Sought, block + BASE)
    walk, m = sought.walk, sought.meetings
    if count == 0 or not 3 <= walk.benches.kind.shape[0] <= MOST_SAMPLED:
        return math.inf
    least, s, i, j = low_pair(
        walk.rows, walk.benches.links, walk.benches.sizes, first, last, sought.at, sought.placed,
        sought.boxes,
    )  # fmt: skip
    m[GUIDE, MEET_S], m[GUIDE, MEET_LEFT], m[GUIDE, MEET_FRONT], m[GUIDE, MEET_REAR] = s, last - s, i, j
    return least - sought.limits[MARGIN]


@kernel
def distance(block: int) -> float:
    """How near the ROOTED pair comes by its meeting in the walk of NOW, less the margin, m.

    In a walk of another size that is as far from the start, or from the end: whichever is nearer to
    touching.
    """
    count, first, last = walk_of(block, group_at(Sought, block + BASE).state[NOW])
    sought = group_at(Sought, block + BASE)
    m, benches = sought.meetings, sought.walk.benches
    if count == 0 or m[ROOTED, MEET_FRONT] == NOBODY:
        return math.nan
    i, j = int(m[ROOTED, MEET_FRONT]), int(m[ROOTED, MEET_REAR])
    near = 1.5 * max(benches.links[i], benches.links[j])
    least, where, at, other = math.inf, math.inf, m[ROOTED, MEET_S], last - m[ROOTED, MEET_LEFT]
    for n in range(2 if abs(other - at) > 0.1 * near else 1):
        middle = at if n == 0 else other
        apart, s = local_minimum(
            sought.walk.rows, benches.links, benches.sizes, i, j, max(first, middle - near),
            min(last, middle + near), SHRINKS, sought.at, sought.placed, sought.boxes,
        )  # fmt: skip
        if apart < least or (apart == least and s < where):
            least, where = apart, s
    m[ROOTED, MEET_S], m[ROOTED, MEET_LEFT] = where, last - where
    return least - sought.limits[MARGIN] if abs(least) < math.inf else math.nan


@kernel
def failed_alone(sought: Sought) -> int:
    """That a walk fails in which no two benches met."""
    sought.meetings[FAILED, MEET_FRONT] = NOBODY
    return FAILS


@kernel
def failed_at(sought: Sought, s: float, left: float, i: int, j: int) -> int:
    """That a walk fails in which benches i and j met."""
    m = sought.meetings
    m[FAILED, MEET_S], m[FAILED, MEET_LEFT], m[FAILED, MEET_FRONT], m[FAILED, MEET_REAR] = s, left, i, j
    return FAILS


@kernel
def standing(sought: Sought, s: float) -> int:
    """How a dragon passes that stands still with its head at s, m, where `at` says."""
    walk, off, limits = sought.walk, sought.bench_off, sought.limits
    links, sizes, still = walk.benches.links, walk.benches.sizes, sought.still
    place_chain(walk.rows, links, sought.at, 0, 1, still)
    apart, _time, i, j = nearest_pair(sizes, still.x, still.y)
    find_seams(walk.rows, sought.seams)
    bench_errors(walk.rows, links, sizes, sought.seams, still, 0, -1, sought.lanes, sought.errors, off)
    if apart > limits[MARGIN] - max(limits[LEAST_OFF], off[i] + off[j]):
        return PASSES
    return failed_at(sought, s, 0.0, i, j)


@kernel
def roomy(sought: Sought, ending: int) -> int:
    """How a walk stands by how making room for it ended: GOES_ON, or UNDECIDED."""
    figures = sought.figures
    if ending in (TOO_LARGE, NO_MEMORY):
        figures[DOING] = BROKEN
        if ending == TOO_LARGE:
            figures[WANTED] = ground_bytes(sought.sizes, group_count(sought.walk))
    return GOES_ON if ending == ROOMY else UNDECIDED


@kernel
def aim_of(sought: Sought) -> Aim:
    """What the search along the walk of NOW is after."""
    figures, limits = sought.figures, sought.limits
    reach = limits[MARGIN] + limits[LEAST_OFF]
    return Aim(figures[FIRST], figures[LAST], reach, limits[BYTES])


@kernel
def laid(block: int) -> int:
    """How the walk of NOW goes, or GOES_ON once it is laid: to be looked at beside obstacles."""
    sought = group_at(Sought, block + BASE)
    figures, times = sought.figures, sought.state[NOW] / sought.limits[PLAN_SIZE]
    if sought.square.things.shape[0] and not 1.0 / FAR <= times <= FAR:
        return failed_alone(sought)
    count, first, last = walk_of(block, sought.state[NOW])
    if count == 0:
        return failed_alone(group_at(Sought, block + BASE))
    figures[FIRST], figures[LAST], figures[DOING] = first, last, BESIDE
    begin_square(group_at(Sought, block + BASE))
    return GOES_ON


@kernel
def begun(block: int) -> int:
    """How the walk of NOW goes, or GOES_ON once its search is begun."""
    sought = group_at(Sought, block + BASE)
    walk, limits, figures, first = sought.walk, sought.limits, sought.figures, sought.figures[FIRST]
    sought.at[0] = first
    if not place_chain(walk.rows, walk.benches.links, sought.at, 0, 1, sought.placed):
        return failed_alone(sought)
    if first == figures[LAST]:
        return standing(sought, first)
    figures[LEFT] = limits[MOST]
    clear(sought.note)
    return roomy(sought, begin_workspace(block, ROOM_SLOT, sought.sizes, walk, aim_of(sought)))


@kernel
def searched_on(block: int, left: float) -> int:
    """How the walk of NOW goes, or MORE, when at most about so many handles may be placed."""
    while True:
        sought = group_at(Sought, block + BASE)
        walk, room, figures, note = sought.walk, sought.room, sought.figures, sought.note
        limits, benches = sought.limits, walk.benches.kind.shape[0]
        most = max((left - figures[SPENT]) / (SEARCHED * (benches + 1)), 1.0)
        figures[LEFT] = math.floor(min(most, figures[LEFT]))
        known, marched = work_done(room, benches), note[EVALUATIONS]
        ending = search_walk(
            walk, room, FIRST_TOUCH, limits[MARGIN], limits[LEAST_OFF], limits[WIDTH],
            int(figures[LEFT]), note,
        )  # fmt: skip
        marched = (note[EVALUATIONS] - marched) * room.course.tally[PLACED]
        figures[SPENT] += CALL + SEARCHED * marched + max(work_done(room, benches) - known, 0.0)
        if ending == MORE or (ending == CROWDED and figures[SPENT] > left):
            return MORE
        if ending != CROWDED:
            return judged(sought, ending)
        found = roomy(sought, grow_workspace(block, ROOM_SLOT, sought.sizes, walk, aim_of(sought)))
        if found != GOES_ON:
            return found


@kernel
def judged(sought: Sought, ending: int) -> int:
    """How a walk goes whose search ended so."""
    walk, note, state, last = sought.walk, sought.note, sought.state, sought.figures[LAST]
    rows, end = walk.rows, walk.rows.shape[0] - 1
    if note[OFF] > MOST_OFF:
        return UNDECIDED
    state[SLACK] = max(state[SLACK], note[OFF])
    sought.figures[MARCHED] += note[EVALUATIONS]
    if ending == CLEAR:
        length = rows[end, S_START] + rows[end, LENGTH]
        return failed_alone(sought) if last > length + END_SLACK else PASSES
    if ending in (ASTRAY, FALLEN):
        way = sought.room.course.way
        sound = note[LOWER] if ending == FALLEN else min(way[WALKED], way[SOUND])
        falls = falls_soon(rows, walk.benches.links, sound, sought.at, sought.placed)
        return failed_alone(sought) if falls else UNDECIDED
    pair, benches, s = int(note[PAIR]), walk.benches.kind.shape[0], note[UPPER]
    return failed_at(sought, s, last - s, pair // benches, pair % benches)


@kernel
def pursued(block: int, value: float) -> int:
    """Do what the search asks for, whose last question `value` answers, up to a walk or its ending."""
    figures = group_at(Sought, block + BASE).figures
    while True:
        sought = group_at(Sought, block + BASE)
        task = next_task(sought.state, sought.doubts, sought.meetings, value)
        if task == LOW_PAIR:
            value = hint(block)
        elif task == DISTANCE:
            value = distance(block)
        else:
            figures[DOING] = WAITING if task == WALK else IDLE
            return MORE if task == WALK else task
        if figures[DOING] == BROKEN:
            return OUT_OF_MEMORY


@kernel
def gone_on(block: int, left: float) -> int:
    """How the walk of NOW goes, or MORE."""
    figures, result = group_at(Sought, block + BASE).figures, GOES_ON
    if figures[DOING] == WAITING:
        result = laid(block)
    if result == GOES_ON and figures[DOING] == BESIDE:
        result = looked_beside(block, left)
        if result == FAILS:
            failed_alone(group_at(Sought, block + BASE))
        if result == GOES_ON:
            figures[DOING] = SEARCHING
            result = begun(block)
    result = searched_on(block, left) if result == GOES_ON else result
    return UNDECIDED if result == PASSES and figures[UNSURE] > 0.0 else result


@entry
def step_size(handle: int, left: float) -> int:
    """Go on for some hundredths of a second; MORE, or how what is sought was found.

    `left`: about so many handles may be placed. A step ends before each walk, whose size NOW says.
    """
    block = recall(handle)
    if block == 0:
        return CLOSED
    figures = group_at(Sought, block + BASE).figures
    figures[SPENT], doing = 0.0, figures[DOING]
    if doing == IDLE:
        return CLOSED
    if doing == SEEKING and figures[ONE]:
        figures[DOING] = WAITING
        return MORE
    if doing == SEEKING:
        return pursued(block, 0.0)
    result = gone_on(block, left) if doing != BROKEN else UNDECIDED
    if figures[DOING] == BROKEN:
        return OVER_MEMORY if figures[WANTED] else OUT_OF_MEMORY
    if result == MORE:
        return MORE
    figures[RESULT], figures[DOING] = result, IDLE
    return TRIED_ALONE if figures[ONE] else pursued(block, float(result))
