"""How small or large one size of a plan may be, as a question: `open, seek, step, rows, close`.

All of the search lies in a block of the engine's own memory, which a handle stands for. A host opens
the question with the numbers of a plan, sets the goal, and steps until it is reached, as in
kernels/question.py. The walk of a size is searched beside each obstacle, then for contact.
"""

import math

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import nearest_pair
from benchdragon.kernels.curve import RouteRow
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.family import Family, PlanNumber, RouteKind, falls_soon, set_walk
from benchdragon.kernels.local_minima import MOST_SAMPLED, SHRINKS, local_minimum, low_pair
from benchdragon.kernels.memory import (
    HEADER,
    Header,
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
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.rounding import bench_errors, find_seams
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.route_parts import settle_rows
from benchdragon.kernels.search_room import (
    Aim,
    Beginning,
    RoomEnding,
    RoomSize,
    begin_workspace,
    ground_bytes,
    group_count,
    grow_workspace,
)
from benchdragon.kernels.size_bracket import FIRST_CAUTION, Bracket, SizeVerdict
from benchdragon.kernels.size_memory import (
    BASE,
    SIZE_END_SLOT,
    SIZE_ROOM_SLOT,
    SIZE_WALK_SLOT,
    SizeGiven,
    SizeMemory,
    SizeStage,
    SizeTold,
    Sought,
    Square,
    fill,
    lay_all,
    make_route,
    make_searches,
)
from benchdragon.kernels.size_search import (
    MEETINGS,
    NO_MEETING,
    KnownMeeting,
    Meet,
    SizeGoal,
    SizeStep,
    next_task,
)
from benchdragon.kernels.size_square import GOES_ON, begin_square, looked_beside
from benchdragon.kernels.swept_boxes import MOST_OFF
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.walk_search import CALL, SEARCHED, WalkEnding, search_walk, work_done
from benchdragon.kernels.workspace import Course, Walk, WalkTally


class SizeQuestionGoal(SizeGoal):
    """Goals besides GROW and BORDER of size_search: the verdict on the walk of one size."""

    ALONE = 3


class SizeEnding(SizeStep):
    """Exit statuses of a step, besides those of size_search and of kernels/question.py."""

    TRIED_ALONE = 7


# Sizes are tried to so many times the plan's own where there are obstacles.
FAR = 10.0


@entry
def open_size(family: Family, walk: Walk, square: Square, limits: Vector, beginnings: IntVector) -> int:
    """Open a question about a family, of which `walk` is one; returns its handle, 0 without memory.

    All is copied. `limits` is a row of `SizeGiven`, `beginnings` of `search_room.Beginning`.
    """
    block = new_block(SIZE_END_SLOT - HEADER)
    if block == 0:
        return 0
    slots, places = integers_at(block, SIZE_END_SLOT), beginnings[Beginning.PLACES]
    size = lay_all(slots, 0, family, walk, square, places)
    if take(slots, SizeMemory.OWN, size) and make_route(slots, walk.rows.shape[0]):
        lay_all(slots, slots[Header.OWNED + SizeMemory.OWN], family, walk, square, places)
        fill(group_at(Sought, block + BASE), family, walk, square, limits, beginnings)
        if family.numbers[PlanNumber.ROUTE] == RouteKind.FIXED:
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
    figures[SizeTold.DOING], figures[SizeTold.ONE] = SizeStage.SEEKING, 0.0
    if stage == SizeQuestionGoal.ALONE:
        figures[SizeTold.ONE], state[Bracket.NOW] = 1.0, size
        return True
    clear(state)
    state[Bracket.SENSE], state[Bracket.TOLERANCE] = limits[SizeGiven.SAFER], limits[SizeGiven.NARROW]
    state[Bracket.SLACK], state[Bracket.CAUTION] = limits[SizeGiven.LEAST_OFF], FIRST_CAUTION
    state[Bracket.STAGE], state[Bracket.SIZE] = stage, size
    if stage == SizeGoal.BORDER:
        state[Bracket.GOOD], state[Bracket.BAD], state[Bracket.TRIED] = good, size, 1.0
    for n in range(MEETINGS):
        sought.meetings[n, Meet.FRONT] = NO_MEETING
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
    slots = integers_at(block, SIZE_END_SLOT)
    while True:
        sought = group_at(Sought, block + BASE)
        slots[SIZE_WALK_SLOT + 1] = sought.sizes[RoomSize.ROUTE_ROWS]
        sought = group_at(Sought, block + BASE)
        count, first, last = set_walk(sought.family, sought.walk, sought.at, sought.placed, size)
        if count >= 0:
            break
        if not make_route(slots, -count) or not make_searches(block):
            sought.figures[SizeTold.DOING] = SizeStage.BROKEN
            return 0, math.nan, math.nan
    slots[SIZE_WALK_SLOT + 1] = count
    if count > 0 and sought.family.numbers[PlanNumber.ROUTE] != RouteKind.FIXED:
        settle(block)
    return count, first, last


@kernel
def settle(block: int) -> None:
    """Move the origin of the route's rows to where the dance is searched."""
    sought = group_at(Sought, block + BASE)
    x, y = sought.limits[SizeGiven.ORIGIN_X], sought.limits[SizeGiven.ORIGIN_Y]
    if x != 0.0 or y != 0.0:
        settle_rows(sought.walk.rows, x, y)


@kernel
def hint(block: int) -> float:
    """Fill GUIDE with a pair that comes near in the walk of NOW; its distance less the margin, m."""
    count, first, last = walk_of(block, group_at(Sought, block + BASE).state[Bracket.NOW])
    sought = group_at(Sought, block + BASE)
    walk, m = sought.walk, sought.meetings
    if count == 0 or not 3 <= walk.benches.kind.shape[0] <= MOST_SAMPLED:
        return math.inf
    least, s, i, j = low_pair(
        walk.rows, walk.benches.links, walk.benches.sizes, first, last, sought.at, sought.placed,
        sought.boxes,
    )  # fmt: skip
    m[KnownMeeting.GUIDE, Meet.S] = s
    m[KnownMeeting.GUIDE, Meet.LEFT] = last - s
    m[KnownMeeting.GUIDE, Meet.FRONT] = i
    m[KnownMeeting.GUIDE, Meet.REAR] = j
    return least - sought.limits[SizeGiven.MARGIN]


@kernel
def distance(block: int) -> float:
    """The distance of the ROOTED pair near its meeting in the walk of NOW, less the margin, m.

    In a walk of another size that meeting is as far from the start, or from the end: the one nearer to
    touching is taken.
    """
    count, first, last = walk_of(block, group_at(Sought, block + BASE).state[Bracket.NOW])
    sought = group_at(Sought, block + BASE)
    m, benches = sought.meetings, sought.walk.benches
    if count == 0 or m[KnownMeeting.ROOTED, Meet.FRONT] == NO_MEETING:
        return math.nan
    i, j = int(m[KnownMeeting.ROOTED, Meet.FRONT]), int(m[KnownMeeting.ROOTED, Meet.REAR])
    near = 1.5 * max(benches.links[i], benches.links[j])
    least = math.inf
    where = math.inf
    at = m[KnownMeeting.ROOTED, Meet.S]
    other = last - m[KnownMeeting.ROOTED, Meet.LEFT]
    for n in range(2 if abs(other - at) > 0.1 * near else 1):
        middle = at if n == 0 else other
        apart, s = local_minimum(
            sought.walk.rows, benches.links, benches.sizes, i, j, max(first, middle - near),
            min(last, middle + near), SHRINKS, sought.at, sought.placed, sought.boxes,
        )  # fmt: skip
        if apart < least or (apart == least and s < where):
            least, where = apart, s
    m[KnownMeeting.ROOTED, Meet.S], m[KnownMeeting.ROOTED, Meet.LEFT] = where, last - where
    return least - sought.limits[SizeGiven.MARGIN] if abs(least) < math.inf else math.nan


@kernel
def failed_alone(sought: Sought) -> int:
    """FAILS, with the record that no two benches met."""
    sought.meetings[KnownMeeting.FAILED, Meet.FRONT] = NO_MEETING
    return SizeVerdict.FAILS


@kernel
def failed_at(sought: Sought, s: float, left: float, i: int, j: int) -> int:
    """FAILS, with the record that benches i and j met."""
    m = sought.meetings
    m[KnownMeeting.FAILED, Meet.S] = s
    m[KnownMeeting.FAILED, Meet.LEFT] = left
    m[KnownMeeting.FAILED, Meet.FRONT] = i
    m[KnownMeeting.FAILED, Meet.REAR] = j
    return SizeVerdict.FAILS


@kernel
def standing(sought: Sought, s: float) -> int:
    """The verdict on a dragon that stands still with its head at s, m, which is in `at`."""
    walk, off, limits = sought.walk, sought.bench_off, sought.limits
    links, sizes, still = walk.benches.links, walk.benches.sizes, sought.still
    place_chain(walk.rows, links, sought.at, 0, 1, still)
    apart, _time, i, j = nearest_pair(sizes, still.x, still.y)
    find_seams(walk.rows, sought.seams)
    bench_errors(walk.rows, links, sizes, sought.seams, still, 0, -1, sought.lanes, sought.errors, off)
    if apart > limits[SizeGiven.MARGIN] - max(limits[SizeGiven.LEAST_OFF], off[i] + off[j]):
        return SizeVerdict.PASSES
    return failed_at(sought, s, 0.0, i, j)


@kernel
def roomy(sought: Sought, ending: int) -> int:
    """The verdict on a walk by the exit status of making room for it: GOES_ON, or UNDECIDED."""
    figures = sought.figures
    if ending in (RoomEnding.TOO_LARGE, RoomEnding.NO_MEMORY):
        figures[SizeTold.DOING] = SizeStage.BROKEN
        if ending == RoomEnding.TOO_LARGE:
            figures[Told.WANTED] = ground_bytes(sought.sizes, group_count(sought.walk))
    return GOES_ON if ending == RoomEnding.ROOMY else SizeVerdict.UNDECIDED


@kernel
def aim_of(sought: Sought) -> Aim:
    """What the search along the walk of NOW covers."""
    figures, limits = sought.figures, sought.limits
    reach = limits[SizeGiven.MARGIN] + limits[SizeGiven.LEAST_OFF]
    return Aim(figures[SizeTold.FIRST], figures[SizeTold.LAST], reach, limits[SizeGiven.BYTES])


@kernel
def laid(block: int) -> int:
    """The verdict on the walk of NOW, or GOES_ON once it is laid, to be searched beside obstacles."""
    sought = group_at(Sought, block + BASE)
    figures, times = sought.figures, sought.state[Bracket.NOW] / sought.limits[SizeGiven.PLAN_SIZE]
    if sought.square.things.shape[0] and not 1.0 / FAR <= times <= FAR:
        return failed_alone(sought)
    count, first, last = walk_of(block, sought.state[Bracket.NOW])
    if count == 0:
        return failed_alone(group_at(Sought, block + BASE))
    figures[SizeTold.FIRST] = first
    figures[SizeTold.LAST] = last
    figures[SizeTold.DOING] = SizeStage.BESIDE
    begin_square(group_at(Sought, block + BASE))
    return GOES_ON


@kernel
def begun(block: int) -> int:
    """The verdict on the walk of NOW, or GOES_ON once its search is begun."""
    sought = group_at(Sought, block + BASE)
    walk = sought.walk
    limits = sought.limits
    figures = sought.figures
    first = sought.figures[SizeTold.FIRST]
    sought.at[0] = first
    if not place_chain(walk.rows, walk.benches.links, sought.at, 0, 1, sought.placed):
        return failed_alone(sought)
    if first == figures[SizeTold.LAST]:
        return standing(sought, first)
    figures[SizeTold.LEFT] = limits[SizeGiven.MOST]
    clear(sought.note)
    return roomy(sought, begin_workspace(block, SIZE_ROOM_SLOT, sought.sizes, walk, aim_of(sought)))


@kernel
def searched_on(block: int, left: float) -> int:
    """The verdict on the walk of NOW, or MORE, when at most about so many handles may be placed."""
    while True:
        sought = group_at(Sought, block + BASE)
        walk, room, figures, note = sought.walk, sought.room, sought.figures, sought.note
        limits, benches = sought.limits, walk.benches.kind.shape[0]
        most = max((left - figures[Told.SPENT]) / (SEARCHED * (benches + 1)), 1.0)
        figures[SizeTold.LEFT] = math.floor(min(most, figures[SizeTold.LEFT]))
        known, marched = work_done(room, benches), note[Note.EVALUATIONS]
        ending = search_walk(
            walk, room, Goal.FIRST_TOUCH, limits[SizeGiven.MARGIN], limits[SizeGiven.LEAST_OFF],
            limits[SizeGiven.WIDTH],
            int(figures[SizeTold.LEFT]), note,
        )  # fmt: skip
        marched = (note[Note.EVALUATIONS] - marched) * room.course.tally[WalkTally.PLACED]
        figures[Told.SPENT] += CALL + SEARCHED * marched + max(work_done(room, benches) - known, 0.0)
        if ending == QuestionEnding.MORE or (
            ending == WalkEnding.CROWDED and figures[Told.SPENT] > left
        ):
            return QuestionEnding.MORE
        if ending != WalkEnding.CROWDED:
            return judged(sought, ending)
        found = roomy(sought, grow_workspace(block, SIZE_ROOM_SLOT, sought.sizes, walk, aim_of(sought)))
        if found != GOES_ON:
            return found


@kernel
def judged(sought: Sought, ending: int) -> int:
    """The verdict on a walk by the exit status of its search."""
    walk, note, state, last = sought.walk, sought.note, sought.state, sought.figures[SizeTold.LAST]
    rows, end = walk.rows, walk.rows.shape[0] - 1
    if note[Note.OFF] > MOST_OFF:
        return SizeVerdict.UNDECIDED
    state[Bracket.SLACK] = max(state[Bracket.SLACK], note[Note.OFF])
    sought.figures[SizeTold.MARCHED] += note[Note.EVALUATIONS]
    if ending == Ending.CLEAR:
        length = rows[end, RouteRow.S_START] + rows[end, RouteRow.LENGTH]
        return failed_alone(sought) if last > length + END_SLACK else SizeVerdict.PASSES
    if ending in (WalkEnding.ASTRAY, Ending.FALLEN):
        way = sought.room.course.way
        sound = note[Note.LOWER] if ending == Ending.FALLEN else min(way[Course.AT], way[Course.SOUND])
        falls = falls_soon(rows, walk.benches.links, sound, sought.at, sought.placed)
        return failed_alone(sought) if falls else SizeVerdict.UNDECIDED
    pair, benches, s = int(note[Note.PAIR]), walk.benches.kind.shape[0], note[Note.UPPER]
    return failed_at(sought, s, last - s, pair // benches, pair % benches)


@kernel
def pursued(block: int, value: float) -> int:
    """Do what the search requests, `value` answering the request before, up to a walk or the end."""
    figures = group_at(Sought, block + BASE).figures
    while True:
        sought = group_at(Sought, block + BASE)
        task = next_task(sought.state, sought.doubts, sought.meetings, value)
        if task == SizeStep.LOW_PAIR:
            value = hint(block)
        elif task == SizeStep.DISTANCE:
            value = distance(block)
        else:
            figures[SizeTold.DOING] = SizeStage.WAITING if task == SizeStep.WALK else SizeStage.IDLE
            return QuestionEnding.MORE if task == SizeStep.WALK else task
        if figures[SizeTold.DOING] == SizeStage.BROKEN:
            return QuestionEnding.OUT_OF_MEMORY


@kernel
def gone_on(block: int, left: float) -> int:
    """The verdict on the walk of NOW, or MORE."""
    figures, result = group_at(Sought, block + BASE).figures, GOES_ON
    if figures[SizeTold.DOING] == SizeStage.WAITING:
        result = laid(block)
    if result == GOES_ON and figures[SizeTold.DOING] == SizeStage.BESIDE:
        result = looked_beside(block, left)
        if result == SizeVerdict.FAILS:
            failed_alone(group_at(Sought, block + BASE))
        if result == GOES_ON:
            figures[SizeTold.DOING] = SizeStage.SEARCHING
            result = begun(block)
    result = searched_on(block, left) if result == GOES_ON else result
    return (
        SizeVerdict.UNDECIDED
        if result == SizeVerdict.PASSES and figures[SizeTold.UNSURE] > 0.0
        else result
    )


@entry
def step_size(handle: int, left: float) -> int:
    """Search for some hundredths of a second; returns MORE, or the exit status of the search.

    `left`: about so many handles may be placed. A step ends before each walk, the size of which is NOW.
    """
    block = recall(handle)
    if block == 0:
        return QuestionEnding.CLOSED
    figures = group_at(Sought, block + BASE).figures
    figures[Told.SPENT], doing = 0.0, figures[SizeTold.DOING]
    if doing == SizeStage.IDLE:
        return QuestionEnding.CLOSED
    if doing == SizeStage.SEEKING and figures[SizeTold.ONE]:
        figures[SizeTold.DOING] = SizeStage.WAITING
        return QuestionEnding.MORE
    if doing == SizeStage.SEEKING:
        return pursued(block, 0.0)
    result = gone_on(block, left) if doing != SizeStage.BROKEN else SizeVerdict.UNDECIDED
    if figures[SizeTold.DOING] == SizeStage.BROKEN:
        return QuestionEnding.OVER_MEMORY if figures[Told.WANTED] else QuestionEnding.OUT_OF_MEMORY
    if result == QuestionEnding.MORE:
        return QuestionEnding.MORE
    figures[SizeTold.RESULT], figures[SizeTold.DOING] = result, SizeStage.IDLE
    return SizeEnding.TRIED_ALONE if figures[SizeTold.ONE] else pursued(block, float(result))
