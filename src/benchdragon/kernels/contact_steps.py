"""How a question about contact goes on: span by span, in room that grows, telling what is found."""

import math

from benchdragon.kernels import contact_memory as told
from benchdragon.kernels import search_room
from benchdragon.kernels.box import CX, CY, box_distance, box_gap, half_diagonal, set_box
from benchdragon.kernels.box_hierarchy import CELL, RADIUS
from benchdragon.kernels.chain import march
from benchdragon.kernels.contact_memory import Hunt
from benchdragon.kernels.curve import LENGTH, S_START, length_at
from benchdragon.kernels.double_double import head_drift
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.grid import gather, put
from benchdragon.kernels.memory import drop, group_at, integers_at
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.nearness import called, nearness
from benchdragon.kernels.question import MORE, OUT_OF_MEMORY, OVER_MEMORY, SPENT, WANTED
from benchdragon.kernels.rounding import bench_errors
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.swept_boxes import MOST_OFF
from benchdragon.kernels.time_of_impact import CLEAR, EVALUATIONS, FALLEN, FOUND, LEAST, LOWER, OFF
from benchdragon.kernels.walk_search import ASTRAY, CALL, CROWDED, SEARCHED, search_walk, work_done
from benchdragon.kernels.workspace import AT, COURSE, PLACED, SOUND, STEP_END, TALLY
from benchdragon.kernels.workspace import GOAL as WAY_GOAL

# The tightest pair is first looked for within this, m; distances that agree in so many parts of a metre
# count as equal.
FIRST_LOOK, TIES = 0.25, 1e12


@kernel
def stands(hunt: Hunt, s: float) -> bool:
    """Place the dragon in slot 0 with its head at s, m; whether it stands there."""
    links, f = hunt.walk.benches.links, hunt.figures
    hunt.at[0] = s
    march(hunt.walk.rows, links, hunt.at, 0, 1, hunt.placed)
    f[SPENT] += links.shape[0] + 1
    if hunt.placed.failed[0, 0] == 0:
        return True
    f[told.SOUND_TO] = f[told.UNTIL] = s
    return False


@kernel
def lead(hunt: Hunt, s: float, side: float) -> float:
    """How far ahead of s, m, the head is placed for it: at most (side 1), at least (-1)."""
    if not math.isfinite(s):
        return 0.0
    drift, doubt = head_drift(hunt.walk.rows, s)
    return drift + side * doubt


@kernel
def pair_told(hunt: Hunt, s: float) -> int:
    """FOUND, with how the pair at hand stands with the head at s, m; or STOPPED."""
    f, sizes, placed = hunt.figures, hunt.walk.benches.sizes, hunt.placed
    i, j = int(f[told.FIRST_BENCH]), int(f[told.SECOND_BENCH])
    if not stands(hunt, s):
        return told.STOPPED
    set_box(sizes, i, placed.x, placed.y, 0, hunt.boxes, 0)
    set_box(sizes, j, placed.x, placed.y, 0, hunt.boxes, 1)
    nearness(hunt.boxes, 0, 1, hunt.near)
    called(hunt.near, i, j)
    f[told.EARLY_LEAD] = lead(hunt, f[told.EARLY], -1.0)
    f[told.LATE_LEAD] = lead(hunt, f[told.LATE], 1.0)
    return FOUND


@kernel
def off_at(hunt: Hunt, s: float) -> float:
    """What the distance of the pair at hand may be off by with the head at s, m."""
    f, walk, off, placed = hunt.figures, hunt.walk, hunt.bench_off, hunt.placed
    benches, least = walk.benches, hunt.limits[told.LEAST_OFF]
    hunt.at[0] = s
    f[SPENT] += benches.links.shape[0] + 1
    if not place_chain(walk.rows, benches.links, hunt.at, 0, 1, placed):
        return least
    bench_errors(
        walk.rows, benches.links, benches.sizes, hunt.seams, placed, 0, -1, hunt.lanes, hunt.errors, off
    )
    return max(least, off[int(f[told.FIRST_BENCH])] + off[int(f[told.SECOND_BENCH])])


@kernel
def is_sharp(hunt: Hunt, off: float) -> bool:
    """Take note of what a distance that matters may be off by, m; whether a search allows for it."""
    f = hunt.figures
    f[told.OFF_BY] = max(f[told.OFF_BY], off)
    return off <= max(hunt.limits[told.LEAST_OFF], MOST_OFF)


@kernel
def set_pair(hunt: Hunt, pair: float) -> None:
    """Let the pair of a note be at hand."""
    f, count = hunt.figures, hunt.walk.benches.kind.shape[0]
    f[told.FIRST_BENCH], f[told.SECOND_BENCH] = int(pair) // count, int(pair) % count


@kernel
def tightest(hunt: Hunt) -> float:
    """The least distance of three or more benches of the dragon in slot 0, m; those are at hand."""
    f, crowd, sizes, placed = hunt.figures, hunt.room.crowd, hunt.walk.benches.sizes, hunt.placed
    hulls, grid, widest, reach = crowd.hulls, crowd.grid, 0.0, FIRST_LOOK
    grid.side[0] = search_room.square_side(hunt.walk, reach)
    for i in range(hulls.shape[0]):
        set_box(sizes, i, placed.x, placed.y, 0, hulls, i)
        hulls[i, RADIUS] = half_diagonal(hulls, i)
        widest = max(widest, hulls[i, RADIUS])
    while True:
        least, place = math.inf, math.inf
        for b in range(grid.heads.shape[0]):
            grid.heads[b] = 0
        for j in range(2, hulls.shape[0]):
            put(grid, j - 2, hulls[j - 2, CX], hulls[j - 2, CY])
            far = hulls[j, RADIUS] + widest + reach
            for n in range(gather(grid, hulls[j, CX], hulls[j, CY], far, crowd.found)):
                i = crowd.found[n]
                if box_gap(hulls, i, j) > min(reach, least) + 2.0 / TIES:
                    continue  # nor is their distance less
                apart = box_distance(hulls, i, j)
                level = math.floor(TIES * apart + 0.5)
                first, second = f[told.FIRST_BENCH], f[told.SECOND_BENCH]
                before = i < first or (i == first and j < second)
                if level < place or (level == place and before):
                    least, place = apart, level
                    f[told.FIRST_BENCH], f[told.SECOND_BENCH] = i, j
        if least <= reach:
            return least
        reach *= 2.0


@kernel
def room_ending(hunt: Hunt, ending: int) -> int:
    """How a step ends for which room was made so; ROOMY if it goes on."""
    if ending == search_room.TOO_LARGE:
        hunt.figures[WANTED] = search_room.ground_bytes(hunt.sizes, search_room.group_count(hunt.walk))
        return OVER_MEMORY
    if ending == search_room.NO_MEMORY:
        return OUT_OF_MEMORY
    if ending == search_room.TOO_LONG:
        return told.ENDLESS
    return ending if ending == search_room.ROOMY else told.UNSHOWN


@kernel
def aim_of(hunt: Hunt) -> search_room.Aim:
    """What the search along the span at hand is after."""
    f, n = hunt.figures, int(hunt.figures[told.SPAN])
    return search_room.Aim(hunt.spans[n, 0], hunt.spans[n, 1], f[told.NEAR], hunt.limits[told.BYTES])


@kernel
def span_begun(block: int, n: int) -> int:
    """Begin span n, in which pairs within NEAR are wanted: ROOMY, or how a step ends."""
    hunt = group_at(Hunt, block + told.BASE)
    walk, f, placed, first = hunt.walk, hunt.figures, hunt.placed, hunt.spans[n, 0]
    f[told.SPAN], f[told.BEGUN], f[told.READY] = n, first, 1.0
    tail, last = first, walk.benches.links.shape[0] - 1
    if stands(hunt, first):
        tail = walk.rows[placed.row[last, 0], S_START]
        tail += length_at(walk.rows, placed.row[last, 0], placed.u[last, 0])
    drop(integers_at(block, told.END_SLOT), search_room.GROUND_MEMORY)
    search_room.size_workspace(hunt.sizes, hunt.beginnings, walk, tail, hunt.spans[n, 1])
    hunt.room.crowd.grid.side[0] = search_room.square_side(walk, f[told.NEAR])
    made = search_room.make_step(block, told.ROOM_SLOT, hunt.sizes)
    hunt = group_at(Hunt, block + told.BASE)
    if made == search_room.ROOMY:
        made = search_room.begin_workspace(block, told.ROOM_SLOT, hunt.sizes, hunt.walk, aim_of(hunt))
    return room_ending(group_at(Hunt, block + told.BASE), made)


@kernel
def begun(block: int, reach: float) -> int:
    """Look for all pairs that come within reach, m, from the start on: ROOMY, or how a step ends."""
    hunt = group_at(Hunt, block + told.BASE)
    hunt.figures[told.NEAR] = reach + hunt.limits[told.LEAST_OFF]
    return span_begun(block, 0)


@kernel
def begun_again(block: int) -> int:
    """Begin once more with what was begun: ROOMY, or how a step ends."""
    hunt = group_at(Hunt, block + told.BASE)
    if hunt.figures[told.SPAN] != 0.0:
        return span_begun(block, 0)
    way, tally = hunt.room.course.way, hunt.room.course.tally
    for n in range(COURSE):
        if n != WAY_GOAL:
            way[n] = hunt.figures[told.BEGUN]
    for n in range(TALLY):
        tally[n] = 0
    return search_room.ROOMY


@kernel
def searched_on(block: int, goal: int, slack: float, left: float, counted: int) -> int:
    """Search on for a goal of kernels/time_of_impact.py, or SEEK; how a step ends then.

    At most about `left` handles may be placed, counted in that column of the figures.
    """
    while True:
        hunt = group_at(Hunt, block + told.BASE)
        walk, room, f, note, limits = hunt.walk, hunt.room, hunt.figures, hunt.note, hunt.limits
        benches = walk.benches.kind.shape[0]
        most = max((left - f[counted]) / (SEARCHED * (benches + 1)), 1.0)
        f[told.LEFT] = math.floor(min(most, f[told.LEFT]))
        known, marched = work_done(room, benches), note[EVALUATIONS]
        ending = search_walk(
            walk, room, goal, limits[told.MARGIN], slack, limits[told.WIDTH], int(f[told.LEFT]), note
        )
        marched = (note[EVALUATIONS] - marched) * room.course.tally[PLACED]
        f[counted] += CALL + SEARCHED * marched + max(work_done(room, benches) - known, 0.0)
        if ending == MORE or f[counted] > left:
            return MORE
        if ending == CROWDED:
            made = search_room.grow_workspace(block, told.ROOM_SLOT, hunt.sizes, walk, aim_of(hunt))
            made = room_ending(group_at(Hunt, block + told.BASE), made)
        elif ending == CLEAR and f[told.SPAN] + 1.0 < hunt.spans.shape[0]:
            f[told.LEFT] = limits[told.MOST_LEAST] if goal == LEAST else limits[told.MOST]
            made = span_begun(block, int(f[told.SPAN]) + 1)
        else:
            return judged(hunt, ending)
        if made != search_room.ROOMY:
            return made


@kernel
def judged(hunt: Hunt, ending: int) -> int:
    """How a step ends in which a search did."""
    walk, f, note, way = hunt.walk, hunt.figures, hunt.note, hunt.room.course.way
    end = walk.rows.shape[0] - 1
    length = walk.rows[end, S_START] + walk.rows[end, LENGTH]
    if not is_sharp(hunt, note[OFF]):
        return told.BLURRED
    if ending == ASTRAY:
        f[told.SOUND_TO], f[told.UNTIL] = way[SOUND], way[SOUND] + 2.0 * hunt.room.ground.measures[CELL]
        if way[AT] < way[SOUND]:
            f[told.SOUND_TO], f[told.UNTIL] = way[AT], way[SOUND]
        return told.STOPPED
    if ending == CLEAR and hunt.limits[told.END] > length + END_SLACK:
        f[told.SOUND_TO], f[told.UNTIL] = length, hunt.limits[told.END]
        return told.STOPPED
    f[told.MARCHED] += note[EVALUATIONS]
    if ending == FALLEN:
        f[told.SOUND_TO], f[told.UNTIL] = note[LOWER], way[STEP_END]
        return told.STOPPED
    return ending
