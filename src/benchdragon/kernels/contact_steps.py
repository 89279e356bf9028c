"""Steps of a question about contact: spans are searched one after another, in arrays that grow."""

import math

from benchdragon.kernels import contact_memory as told
from benchdragon.kernels import search_room
from benchdragon.kernels.box import Box, box_distance, box_gap, half_diagonal, set_box
from benchdragon.kernels.box_hierarchy import BoxMeasure, Hull
from benchdragon.kernels.chain import march
from benchdragon.kernels.contact_memory import ContactEnding, ContactGiven, ContactTold, Hunt
from benchdragon.kernels.curve import RouteRow, length_at
from benchdragon.kernels.double_double import head_drift
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.grid import gather, put
from benchdragon.kernels.memory import Header, drop, group_at, integers_at
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.nearness import called, nearness
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.rounding import bench_errors
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.search_room import RoomEnding, SearchMemory
from benchdragon.kernels.swept_boxes import MOST_OFF
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.walk_search import CALL, SEARCHED, WalkEnding, search_walk, work_done
from benchdragon.kernels.workspace import COURSE, TALLY, Course, WalkTally

# The tightest pair is first searched for within this distance, m; distances that agree to 1 / TIES
# metres count as equal.
FIRST_LOOK, TIES = 0.25, 1e12


@kernel
def stands(hunt: Hunt, s: float) -> bool:
    """Place the dragon in slot 0 with its head at s, m; whether it can be placed."""
    links, f = hunt.walk.benches.links, hunt.figures
    hunt.at[0] = s
    march(hunt.walk.rows, links, hunt.at, 0, 1, hunt.placed)
    f[Told.SPENT] += links.shape[0] + 1
    if hunt.placed.failed[0, 0] == 0:
        return True
    f[ContactTold.SOUND_TO] = f[ContactTold.UNTIL] = s
    return False


@kernel
def lead(hunt: Hunt, s: float, side: float) -> float:
    """Bound of how far ahead of s, m, the head is placed for it: from above (side 1) or below (-1)."""
    if not math.isfinite(s):
        return 0.0
    drift, doubt = head_drift(hunt.walk.rows, s)
    return drift + side * doubt


@kernel
def pair_told(hunt: Hunt, s: float) -> int:
    """FOUND, with the nearness of the current pair with the head at s, m; or STOPPED."""
    f, sizes, placed = hunt.figures, hunt.walk.benches.sizes, hunt.placed
    i, j = int(f[ContactTold.FIRST_BENCH]), int(f[ContactTold.SECOND_BENCH])
    if not stands(hunt, s):
        return ContactEnding.STOPPED
    set_box(sizes, i, placed.x, placed.y, 0, hunt.boxes, 0)
    set_box(sizes, j, placed.x, placed.y, 0, hunt.boxes, 1)
    nearness(hunt.boxes, 0, 1, hunt.near)
    called(hunt.near, i, j)
    f[ContactTold.EARLY_LEAD] = lead(hunt, f[ContactTold.EARLY], -1.0)
    f[ContactTold.LATE_LEAD] = lead(hunt, f[ContactTold.LATE], 1.0)
    return Ending.FOUND


@kernel
def off_at(hunt: Hunt, s: float) -> float:
    """The error bound of the current pair's distance with the head at s, m."""
    f, walk, off, placed = hunt.figures, hunt.walk, hunt.bench_off, hunt.placed
    benches, least = walk.benches, hunt.limits[ContactGiven.LEAST_OFF]
    hunt.at[0] = s
    f[Told.SPENT] += benches.links.shape[0] + 1
    if not place_chain(walk.rows, benches.links, hunt.at, 0, 1, placed):
        return least
    bench_errors(
        walk.rows, benches.links, benches.sizes, hunt.seams, placed, 0, -1, hunt.lanes, hunt.errors, off
    )
    return max(least, off[int(f[ContactTold.FIRST_BENCH])] + off[int(f[ContactTold.SECOND_BENCH])])


@kernel
def is_sharp(hunt: Hunt, off: float) -> bool:
    """Record the error bound of a distance that decides, m; whether a search allows for it."""
    f = hunt.figures
    f[ContactTold.OFF_BY] = max(f[ContactTold.OFF_BY], off)
    return off <= max(hunt.limits[ContactGiven.LEAST_OFF], MOST_OFF)


@kernel
def set_pair(hunt: Hunt, pair: float) -> None:
    """Make the pair of a note the current one."""
    f, count = hunt.figures, hunt.walk.benches.kind.shape[0]
    f[ContactTold.FIRST_BENCH], f[ContactTold.SECOND_BENCH] = int(pair) // count, int(pair) % count


@kernel
def tightest(hunt: Hunt) -> float:
    """The least distance of the dragon in slot 0, three benches or more, m; sets the current pair."""
    f, crowd, sizes, placed = hunt.figures, hunt.room.crowd, hunt.walk.benches.sizes, hunt.placed
    hulls, grid, widest, reach = crowd.hulls, crowd.grid, 0.0, FIRST_LOOK
    grid.side[0] = search_room.square_side(hunt.walk, reach)
    for i in range(hulls.shape[0]):
        set_box(sizes, i, placed.x, placed.y, 0, hulls, i)
        hulls[i, Hull.RADIUS] = half_diagonal(hulls, i)
        widest = max(widest, hulls[i, Hull.RADIUS])
    while True:
        least, place = math.inf, math.inf
        for b in range(grid.heads.shape[0]):
            grid.heads[b] = 0
        for j in range(2, hulls.shape[0]):
            put(grid, j - 2, hulls[j - 2, Box.CX], hulls[j - 2, Box.CY])
            far = hulls[j, Hull.RADIUS] + widest + reach
            for n in range(gather(grid, hulls[j, Box.CX], hulls[j, Box.CY], far, crowd.found)):
                i = crowd.found[n]
                if box_gap(hulls, i, j) > min(reach, least) + 2.0 / TIES:
                    continue  # nor is their distance less
                apart = box_distance(hulls, i, j)
                level = math.floor(TIES * apart + 0.5)
                first, second = f[ContactTold.FIRST_BENCH], f[ContactTold.SECOND_BENCH]
                before = i < first or (i == first and j < second)
                if level < place or (level == place and before):
                    least, place = apart, level
                    f[ContactTold.FIRST_BENCH], f[ContactTold.SECOND_BENCH] = i, j
        if least <= reach:
            return least
        reach *= 2.0


@kernel
def room_ending(hunt: Hunt, ending: int) -> int:
    """The step's exit status for that of making room; ROOMY if the step goes on."""
    if ending == RoomEnding.TOO_LARGE:
        hunt.figures[Told.WANTED] = search_room.ground_bytes(
            hunt.sizes, search_room.group_count(hunt.walk)
        )
        return QuestionEnding.OVER_MEMORY
    if ending == RoomEnding.NO_MEMORY:
        return QuestionEnding.OUT_OF_MEMORY
    if ending == RoomEnding.TOO_LONG:
        return ContactEnding.ENDLESS
    return ending if ending == RoomEnding.ROOMY else ContactEnding.UNSHOWN


@kernel
def aim_of(hunt: Hunt) -> search_room.Aim:
    """The aim of the search along the current span."""
    f, n = hunt.figures, int(hunt.figures[ContactTold.SPAN])
    return search_room.Aim(
        hunt.spans[n, 0], hunt.spans[n, 1], f[ContactTold.NEAR], hunt.limits[ContactGiven.BYTES]
    )


@kernel
def span_begun(block: int, n: int) -> int:
    """Begin to search span n for pairs within NEAR: ROOMY, or the step's exit status."""
    hunt = group_at(Hunt, block + told.BASE)
    walk, f, placed, first = hunt.walk, hunt.figures, hunt.placed, hunt.spans[n, 0]
    f[ContactTold.SPAN], f[ContactTold.BEGUN], f[ContactTold.READY] = n, first, 1.0
    tail, last = first, walk.benches.links.shape[0] - 1
    if stands(hunt, first):
        tail = walk.rows[placed.row[last, 0], RouteRow.S_START]
        tail += length_at(walk.rows, placed.row[last, 0], placed.u[last, 0])
    drop(integers_at(block, told.CONTACT_END_SLOT), SearchMemory.GROUND)
    search_room.size_workspace(hunt.sizes, hunt.beginnings, walk, tail, hunt.spans[n, 1])
    hunt.room.crowd.grid.side[0] = search_room.square_side(walk, f[ContactTold.NEAR])
    made = search_room.make_step(block, told.CONTACT_ROOM_SLOT, hunt.sizes)
    hunt = group_at(Hunt, block + told.BASE)
    if made == RoomEnding.ROOMY:
        made = search_room.begin_workspace(
            block, told.CONTACT_ROOM_SLOT, hunt.sizes, hunt.walk, aim_of(hunt)
        )
    return room_ending(group_at(Hunt, block + told.BASE), made)


@kernel
def begun(block: int, reach: float) -> int:
    """Begin to search for pairs within reach, m, from the start: ROOMY, or the exit status."""
    hunt = group_at(Hunt, block + told.BASE)
    hunt.figures[ContactTold.NEAR] = reach + hunt.limits[ContactGiven.LEAST_OFF]
    return span_begun(block, 0)


@kernel
def begun_again(block: int) -> int:
    """Restart the search with what is known: ROOMY, or the step's exit status."""
    hunt = group_at(Hunt, block + told.BASE)
    known = integers_at(block, told.CONTACT_END_SLOT)[Header.OWNED + SearchMemory.GROUND]
    if hunt.figures[ContactTold.SPAN] != 0.0 or known == 0:  # the tables were too large and released
        return span_begun(block, 0)
    way, tally = hunt.room.course.way, hunt.room.course.tally
    for n in range(COURSE):
        if n != Course.GOAL:
            way[n] = hunt.figures[ContactTold.BEGUN]
    for n in range(TALLY):
        tally[n] = 0
    return RoomEnding.ROOMY


@kernel
def searched_on(block: int, goal: int, slack: float, left: float, counted: int) -> int:
    """Search on for a goal of kernels/time_of_impact.py, or SEEK; returns the step's exit status.

    At most about `left` handles may be placed, counted in column `counted` of the figures.
    """
    while True:
        hunt = group_at(Hunt, block + told.BASE)
        walk, room, f, note, limits = hunt.walk, hunt.room, hunt.figures, hunt.note, hunt.limits
        benches = walk.benches.kind.shape[0]
        most = max((left - f[counted]) / (SEARCHED * (benches + 1)), 1.0)
        f[ContactTold.LEFT] = math.floor(min(most, f[ContactTold.LEFT]))
        known, marched = work_done(room, benches), note[Note.EVALUATIONS]
        ending = search_walk(
            walk,
            room,
            goal,
            limits[ContactGiven.MARGIN],
            slack,
            limits[ContactGiven.WIDTH],
            int(f[ContactTold.LEFT]),
            note,
        )
        marched = (note[Note.EVALUATIONS] - marched) * room.course.tally[WalkTally.PLACED]
        f[counted] += CALL + SEARCHED * marched + max(work_done(room, benches) - known, 0.0)
        if ending == QuestionEnding.MORE or f[counted] > left:
            return QuestionEnding.MORE
        if ending == WalkEnding.CROWDED:
            made = search_room.grow_workspace(
                block, told.CONTACT_ROOM_SLOT, hunt.sizes, walk, aim_of(hunt)
            )
            made = room_ending(group_at(Hunt, block + told.BASE), made)
        elif ending == Ending.CLEAR and f[ContactTold.SPAN] + 1.0 < hunt.spans.shape[0]:
            f[ContactTold.LEFT] = (
                limits[ContactGiven.MOST_LEAST] if goal == Goal.LEAST else limits[ContactGiven.MOST]
            )
            made = span_begun(block, int(f[ContactTold.SPAN]) + 1)
        else:
            return judged(hunt, ending)
        if made != RoomEnding.ROOMY:
            return made


@kernel
def judged(hunt: Hunt, ending: int) -> int:
    """The step's exit status for that of its search."""
    walk, f, note, way = hunt.walk, hunt.figures, hunt.note, hunt.room.course.way
    end = walk.rows.shape[0] - 1
    length = walk.rows[end, RouteRow.S_START] + walk.rows[end, RouteRow.LENGTH]
    if not is_sharp(hunt, note[Note.OFF]):
        return ContactEnding.BLURRED
    if ending == WalkEnding.ASTRAY:
        f[ContactTold.SOUND_TO] = way[Course.SOUND]
        f[ContactTold.UNTIL] = way[Course.SOUND] + 2.0 * hunt.room.ground.measures[BoxMeasure.CELL]
        if way[Course.AT] < way[Course.SOUND]:
            f[ContactTold.SOUND_TO], f[ContactTold.UNTIL] = way[Course.AT], way[Course.SOUND]
        return ContactEnding.STOPPED
    if ending == Ending.CLEAR and hunt.limits[ContactGiven.END] > length + END_SLACK:
        f[ContactTold.SOUND_TO], f[ContactTold.UNTIL] = length, hunt.limits[ContactGiven.END]
        return ContactEnding.STOPPED
    f[ContactTold.MARCHED] += note[Note.EVALUATIONS]
    if ending == Ending.FALLEN:
        f[ContactTold.SOUND_TO], f[ContactTold.UNTIL] = note[Note.LOWER], way[Course.STEP_END]
        return ContactEnding.STOPPED
    return ending
