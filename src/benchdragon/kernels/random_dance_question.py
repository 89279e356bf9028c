"""One dance whose people are not exact, as a question: `open, step, read`.

Either whether benches touch with the plan's own pitch, or with which pitch they just do not. A pitch is
tried by looking here and there (kernels/random_dance_look.py), then by the search that misses nothing
(kernels/every_pair.py). All of it lies in a block of the engine's own memory; a step takes some
hundredths of a second.
"""

import math

from benchdragon.kernels import random_dance_memory as m
from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.box import LONGEST_BENCH, SHORTEST_LINK, radii
from benchdragon.kernels.curve import COLUMNS, LENGTH, S_START, U_BACK
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.every_pair import CROWDED, PAIR_WORK, search_steps
from benchdragon.kernels.family import Family, set_walk
from benchdragon.kernels.links import links_of
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
from benchdragon.kernels.question import CLOSED, MORE, OUT_OF_MEMORY, OVER_MEMORY, SPENT, WANTED
from benchdragon.kernels.random_dance_bound import (
    WAYS,
    bounds,
    fill_parts,
    prepare,
    stretch_count,
    table_sizes,
)
from benchdragon.kernels.random_dance_look import (
    ANSWERED,
    BEGINNING,
    JUDGING,
    LOOK,
    LOOKING,
    SEARCHING,
    SPOILT,
    TOLERANCE,
    is_sure,
    look_first,
    look_on,
    meeting_near,
    part_at,
    place_count,
    set_hint,
    shortest_link,
)
from benchdragon.kernels.random_dance_memory import Dance, Drawn
from benchdragon.kernels.random_numbers import draw_benches
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.stray_line import (
    STRAY_LENGTH,
    between,
    fill_noise,
    lay_line,
    lay_points,
    noise_count,
)
from benchdragon.kernels.time_of_impact import (
    CLEAR,
    EVALUATIONS,
    FALLEN,
    FIRST_TOUCH,
    NOTES,
    PAIR,
    UPPER,
    Limits,
)
from benchdragon.kernels.walk_search import SEARCHED
from benchdragon.kernels.workspace import Walk

# Steps of the head that are searched at once, as a share of the shortest link: longer ones leave looser
# bounds (design/imprecision.py). Parts of a step as short as WIDTH, m, are not halved; chains that one
# step may take.
STEP, WIDTH, MOST_EVALUATIONS = 0.125, 1e-8, 20_000
# What is nearer to touching than this, m, touches.
GRAZE = 1e-7
# Pairs a bench may have near it at first; so many times as many where they do not do.
FEW_PARTNERS, MORE_PARTNERS = 24, 4
# Pitches are sought along secants whose slopes (m of distance per m of pitch) are kept within bounds:
# near 1 on a spiral. A pitch with which a bench cannot follow is multiplied by UNWALKABLE; no trial is
# farther from the last one than a share LONGEST_STEP of it.
LEAST_SLOPE, MOST_SLOPE, UNWALKABLE, LONGEST_STEP = 0.5, 3.0, 1.01, 0.1
# What a pitch may come to be, times the one that exact people need; offsets from the route want about
# so many times their deviation more of it.
NARROWEST, WIDEST, LIKELY = 0.7, 4.0, 2.0
# Limits of one dance: handles times places looked at, and pairs times places.
MOST_PLACES, MOST_PAIRS = 5_000_000, 1e10
# A step of a question places about so many handles. What a point of a line costs, in handles placed,
# and in bytes; the most that tables may take in any case.
STEP_WORK, POINT_WORK, POINT_BYTES, MOST_BYTES = 200_000, 50, 16 * (COLUMNS + 1), 4e9
# How a step ends, besides those of kernels/question.py.
DONE = 0
NOT_FOUND = 1  # no pitch near the guess
TOO_LONG = 2  # the walk, or the dragon
NO_BENCH = 3  # that was drawn can be


@entry
def open_dance(family: Family, walk: Walk, limits: Vector) -> int:
    """Open a question about a dance; its handle, 0 if there is no memory.

    `walk` is the plan's own of exact people, one of the family in which the pitch varies. What is
    handed over is copied. See LIMITS of kernels/random_dance_memory.py.
    """
    block = new_block(m.END_SLOT - HEADER)
    if block == 0:
        return 0
    slots = integers_at(block, m.END_SLOT)
    size = m.lay_own(slots, 0, family, walk, limits)
    if take(slots, m.OWN_MEMORY, size) and m.make_rows(slots, walk.rows.shape[0]):
        m.lay_own(slots, slots[OWNED + m.OWN_MEMORY], family, walk, limits)
        begin(group_at(Dance, block + m.BASE), family, walk, limits)
        handle = remember(block)
        if handle:
            return handle
    release_block(block)
    return 0


@kernel
def begin(dance: Dance, family: Family, walk: Walk, limits: Vector) -> None:
    """Copy what a host says, draw the benches, and let the question begin."""
    m.fill(dance, family, walk, limits)
    figures, drawn = dance.figures, dance.drawn
    seed, number = int(limits[m.SEED]), int(limits[m.DANCE])
    draw_benches(seed, number, limits[m.BY :], family.sizes, drawn.sizes, drawn.aside)
    links_of(drawn.sizes, drawn.links)
    radii(drawn.sizes, dance.circles[0])
    figures[m.DOING] = BEGINNING if can_be(drawn) else SPOILT
    figures[m.PARTNERS], dance.sizes[m.PAIRS] = FEW_PARTNERS, -1
    figures[m.CLEAR], figures[m.BEFORE], figures[m.ROOM_BEFORE] = math.inf, math.nan, math.nan
    figures[m.PITCH] = limits[m.GUESS] + LIKELY * math.hypot(limits[m.ASIDE], limits[m.STRAY])


@kernel
def can_be(drawn: Drawn) -> bool:
    """Whether there can be such benches: the bounds of model/dragon.py."""
    for i in range(drawn.links.shape[0]):
        length, width = drawn.sizes[0, i], drawn.sizes[1, i]
        front, rear = drawn.sizes[2, i], drawn.sizes[3, i]
        if not (length > 0.0 and width > 0.0 and front >= 0.0 and rear >= 0.0):
            return False
        if max(length, width, front, rear) > LONGEST_BENCH or drawn.links[i] < SHORTEST_LINK:
            return False
    return True


@entry
def read_dance(handle: int, figures: Vector) -> bool:
    """Fill a host's array with what is known; False if there is no such question."""
    block = recall(handle)
    if block == 0:
        return False
    copy_row(figures, group_at(Dance, block + m.BASE).figures)
    return True


@entry
def step_dance(handle: int, left: float) -> int:
    """Go on for some hundredths of a second: MORE, or how it ended. About so many may be placed."""
    block = recall(handle)
    if block == 0:
        return CLOSED
    ending, figures = MORE, group_at(Dance, block + m.BASE).figures
    figures[SPENT] = 0.0
    while ending == MORE and figures[SPENT] <= min(STEP_WORK, left):
        dance, doing = group_at(Dance, block + m.BASE), figures[m.DOING]
        if doing == BEGINNING:
            ending = try_pitch(block)
        elif doing == LOOKING:
            look_on(dance)
        elif doing == SEARCHING:
            ending = search_on(block)
        elif doing == JUDGING:
            ending = judge_pitch(dance) if dance.limits[m.WHAT] == m.NEEDED else judge_touch(dance)
        else:
            ending = NO_BENCH if doing == SPOILT else CLOSED
    if ending != MORE:
        figures[m.DOING] = ANSWERED
    return ending


@kernel
def walk_of(block: int) -> tuple[int, float, float]:
    """Lay the route of the pitch at hand: its rows, 0 for none; where its head begins and ends, m."""
    slots = integers_at(block, m.END_SLOT)
    while True:
        dance = group_at(Dance, block + m.BASE)
        limits = dance.limits
        if limits[m.WHAT] != m.NEEDED:
            return dance.walk.rows.shape[0], limits[m.FIRST], limits[m.LAST]
        count, first, last = set_walk(
            dance.family, dance.walk, dance.at, dance.placed, dance.figures[m.PITCH]
        )
        if count >= 0 or not m.make_rows(slots, -count):
            return count, first, last


@kernel
def given_up(figures: Vector, size: int) -> int:
    """How a question ends that wants so many bytes more than it may have, or that there are not."""
    figures[WANTED] = size
    return OVER_MEMORY if size > 0 else OUT_OF_MEMORY


@kernel
def whole_length(dance: Dance) -> float:
    """All links of the dragon, m."""
    whole = 0.0
    for i in range(dance.drawn.links.shape[0]):
        whole += dance.drawn.links[i]
    return whole


@kernel
def line_low(dance: Dance, first: float) -> float:
    """The route position from which a line is known, m."""
    low = first - WAYS * whole_length(dance) - STRAY_LENGTH
    return max(low, 0.0) if math.isfinite(dance.walk.rows[0, U_BACK]) else low


@kernel
def measured(dance: Dance, count: int, first: float, last: float) -> bool:
    """Fill the sizes of what the pitch at hand wants; whether its line goes so far as the head."""
    sizes, rows, whole, limits = dance.sizes, dance.walk.rows[:count], whole_length(dance), dance.limits
    for n in range(m.ROUTE_ROWS, m.PAIRS):
        sizes[n] = 0
    sizes[m.ROUTE_ROWS] = count
    if bounds(rows, dance.drawn.links.shape[0]):
        sizes[m.RADII], sizes[m.GRIDS] = table_sizes(first, last, whole)
        sizes[m.STRETCHES] = stretch_count(first, last, shortest_link(dance))
    if not limits[m.STRAY] > 0.0:
        sizes[m.GRIDS] = 0
        return True
    most = int(min(limits[m.BYTES], MOST_BYTES) / POINT_BYTES) + 2
    sizes[m.POINTS] = lay_points(rows, line_low(dance, first), last, dance.points[:0], most)
    sizes[m.NUMBERS] = noise_count(last - first + WAYS * whole + STRAY_LENGTH)
    dance.figures[SPENT] += POINT_WORK * sizes[m.POINTS]
    return last <= rows[count - 1, S_START] + rows[count - 1, LENGTH] + END_SLACK


@kernel
def try_pitch(block: int) -> int:
    """Begin to try the pitch at hand: MORE, or why not."""
    count, first, last = walk_of(block)
    dance, slots = group_at(Dance, block + m.BASE), integers_at(block, m.END_SLOT)
    figures, benches = dance.figures, dance.drawn.links.shape[0]
    figures[m.TRIALS] += 1.0
    figures[SPENT] += benches
    figures[m.ROOM], figures[m.DOING] = math.nan, JUDGING
    if count < 0:
        return OUT_OF_MEMORY
    if count == 0:
        return MORE
    places = place_count(dance, first, last, LOOK)
    if (benches + 1) * places > MOST_PLACES or 0.5 * (benches + 1) ** 2 * places > MOST_PAIRS:
        return TOO_LONG
    if not measured(dance, count, first, last):
        return MORE
    size = m.make_line(slots, dance.sizes, benches, dance.limits[m.BYTES])
    if size == 0 and dance.sizes[m.PAIRS] < 0:
        size = widen(block, FEW_PARTNERS)
    if size != 0:
        return given_up(figures, size)
    draw_line(group_at(Dance, block + m.BASE), first, last)
    look_first(group_at(Dance, block + m.BASE))
    return MORE


@kernel
def widen(block: int, partners: float) -> int:
    """Make room for so many pairs of a bench, as `make_step` does."""
    dance, slots = group_at(Dance, block + m.BASE), integers_at(block, m.END_SLOT)
    benches = dance.drawn.links.shape[0]
    dance.figures[m.PARTNERS] = partners
    pairs = min(int(partners) * benches, benches * (benches - 1) // 2)
    dance.sizes[m.PAIRS] = pairs
    return m.make_step(slots, pairs, benches, dance.limits[m.BYTES])


@kernel
def draw_line(dance: Dance, first: float, last: float) -> None:
    """Lay the line of the pitch at hand, and the parts of the head's way that must be searched."""
    figures, drawn, limits, parts = dance.figures, dance.drawn, dance.limits, dance.parts
    rows, stray = dance.walk.rows[: dance.sizes[m.ROUTE_ROWS]], limits[m.STRAY]
    points, along = dance.points, dance.along
    figures[m.START], figures[m.END] = first, last
    fill_noise(int(limits[m.SEED]), int(limits[m.DANCE]), dance.noise)
    figures[m.PARTS], parts[0, 0], parts[0, 1], parts[0, 2] = 1.0, first, last, drawn.links.shape[0]
    if dance.sizes[m.RADII] and prepare(
        dance.bound, rows, drawn.links, drawn.sizes, drawn.aside, dance.noise, stray, first, last
    ):
        wanted = limits[m.MARGIN] + 2.0 * GRAZE
        figures[m.PARTS] = fill_parts(dance.bound, drawn.links, drawn.sizes, wanted, parts)
        figures[SPENT] += POINT_WORK * parts.shape[0]
    if points.shape[0]:
        lay_points(rows, line_low(dance, first), last, points, points.shape[0])
        lay_line(rows, points, dance.noise, stray, dance.line, along)
        for p in range(int(figures[m.PARTS])):
            for n in range(2):
                parts[p, n] = between(parts[p, n], points, along)
        figures[m.START], figures[m.END] = between(first, points, along), between(last, points, along)


@kernel
def search_on(block: int) -> int:
    """Search some more steps of the head: MORE, or why not."""
    dance = group_at(Dance, block + m.BASE)
    figures, drawn, search, part = dance.figures, dance.drawn, dance.search, int(dance.figures[m.PART])
    if part >= figures[m.PARTS]:
        figures[m.DOING] = JUDGING
        return MORE
    start, end, count, places = part_at(dance, part, STEP)
    n, steps, note = int(figures[m.PLACE]), dance.steps, dance.note
    some = min(m.STEPS, places - 1 - n)
    for t in range(some + 1):
        steps[t] = start + (end - start) * (n + t) / (places - 1)
    for k in range(NOTES):
        note[k] = 0.0
    ending = search_steps(
        search, FIRST_TOUCH, dance.line, drawn.links[:count], drawn.aside[: count + 1], drawn.sizes,
        steps[: some + 1], dance.first, dance.second,
        Limits(dance.limits[m.MARGIN], GRAZE, WIDTH, MOST_EVALUATIONS), note, dance.members[:count],
        dance.circles,
    )  # fmt: skip
    figures[SPENT] += SEARCHED * (count + 1) * (some + 1 + note[EVALUATIONS])
    figures[SPENT] += 0.5 * PAIR_WORK * count * count * (some + 1)
    if ending == CROWDED:
        size = widen(block, MORE_PARTNERS * figures[m.PARTNERS])
        return MORE if size == 0 else given_up(figures, size)
    if ending == CLEAR:
        last = n + some == places - 1
        figures[m.PART], figures[m.PLACE] = part + (1.0 if last else 0.0), 0.0 if last else n + some
        return MORE
    figures[m.ROOM], figures[m.DOING] = math.nan, JUDGING
    if ending != FALLEN:
        met(dance, note[UPPER], int(note[PAIR]) % count)
    return MORE


@kernel
def met(dance: Dance, s: float, j: int) -> None:
    """Let the room be that where a search found benches to touch, with the head at s, m."""
    figures, n = dance.figures, int(dance.figures[m.HINTS])
    set_hint(dance, n, s, j)
    figures[m.ROOM] = min(meeting_near(dance, n).distance - dance.limits[m.MARGIN], -GRAZE)


@kernel
def judge_touch(dance: Dance) -> int:
    """Answer whether benches touch."""
    dance.figures[m.RESULT] = 0.0 if dance.figures[m.ROOM] > 0.0 else 1.0
    return DONE


@kernel
def judge_pitch(dance: Dance) -> int:
    """Answer which pitch is needed, or go on to the next: MORE."""
    figures, guess = dance.figures, dance.limits[m.GUESS]
    a, fa, b, fb = figures[m.BEFORE], figures[m.ROOM_BEFORE], figures[m.PITCH], figures[m.ROOM]
    sure = is_sure(dance)
    if not fb >= 0.0:
        figures[m.TOUCHING] = max(figures[m.TOUCHING], b)
        if figures[m.CLEAR] <= b:
            figures[m.CLEAR] = math.inf
    elif (sure or fb <= TOLERANCE) and b > figures[m.TOUCHING]:
        figures[m.CLEAR] = min(figures[m.CLEAR], b)
    if figures[m.CLEAR] - figures[m.TOUCHING] <= TOLERANCE:
        figures[m.RESULT] = figures[m.CLEAR]
        return DONE
    slope = 1.0
    if math.isfinite(fb) and math.isfinite(fa) and b != a:
        slope = min(max((fb - fa) / (b - a), LEAST_SLOPE), MOST_SLOPE)
    figures[m.BEFORE], figures[m.ROOM_BEFORE], figures[m.PITCH] = b, fb, next_pitch(dance, slope)
    figures[m.DOING] = BEGINNING
    near = NARROWEST * guess < figures[m.PITCH] < WIDEST * guess
    return MORE if near and figures[m.TRIALS] < m.MOST_TRIALS else NOT_FOUND


@kernel
def next_pitch(dance: Dance, slope: float) -> float:
    """The pitch to try next, m: where the room would be half of TOLERANCE, or just not any more."""
    figures = dance.figures
    pitch, room = figures[m.PITCH], figures[m.ROOM]
    touching, clear = figures[m.TOUCHING], figures[m.CLEAR]
    if math.isnan(room):
        ahead = UNWALKABLE * pitch
    elif clear < math.inf:
        ahead = clear - max(0.9 * TOLERANCE, room / slope)
    else:
        ahead = pitch + (0.5 * TOLERANCE - room) / slope
    # Where a bound clears most of a walk the distances seen are far from the least.
    ahead = min(max(ahead, (1.0 - LONGEST_STEP) * pitch), (1.0 + LONGEST_STEP) * pitch)
    if touching < ahead < clear:
        return ahead
    return 0.5 * (touching + min(clear, max(pitch, touching)))
