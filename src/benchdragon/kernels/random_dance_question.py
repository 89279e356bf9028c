"""One random dance as a question: `open, step, read`.

It asks whether benches touch with the plan's own pitch, or at which pitch they just do not. A pitch is
tried by sampling (kernels/random_dance_look.py), then by the search that misses nothing
(kernels/every_pair.py). All of it lies in a block of the engine's own memory; a step takes some
hundredths of a second.
"""

import math

from benchdragon.kernels import random_dance_memory as m
from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.box import LONGEST_BENCH, SHORTEST_LINK, radii
from benchdragon.kernels.curve import COLUMNS, RouteRow
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.every_pair import PAIR_WORK, PairsEnding, search_steps
from benchdragon.kernels.family import Family, set_walk
from benchdragon.kernels.links import links_of
from benchdragon.kernels.memory import (
    HEADER,
    Header,
    copy_row,
    group_at,
    integers_at,
    new_block,
    recall,
    release_block,
    remember,
    take,
)
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.random_dance_bound import (
    WAYS,
    bounds,
    fill_parts,
    prepare,
    stretch_count,
    table_sizes,
)
from benchdragon.kernels.random_dance_look import (
    LOOK,
    PITCH_TOLERANCE,
    DanceStage,
    is_sure,
    look_first,
    look_on,
    meeting_near,
    part_at,
    place_count,
    set_hint,
    shortest_link,
)
from benchdragon.kernels.random_dance_memory import (
    Dance,
    DanceGiven,
    DanceMemory,
    DanceSize,
    DanceSought,
    DanceTold,
    Drawn,
)
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
from benchdragon.kernels.time_of_impact import NOTES, Ending, Goal, Limits, Note
from benchdragon.kernels.walk_search import SEARCHED
from benchdragon.kernels.workspace import Walk

# Steps of the head that are searched at once, as a share of the shortest link: longer ones leave looser
# bounds (design/imprecision.py). Parts of a step as short as WIDTH, m, are not halved; chains that one
# step may take.
HEAD_STEP, WIDTH, MOST_EVALUATIONS = 0.125, 1e-8, 20_000
# A pair nearer than this, m, touches.
GRAZE = 1e-7
# Pairs that a bench may have near it at first; so many times as many where those do not suffice.
FEW_PARTNERS, MORE_PARTNERS = 24, 4
# Pitches are sought along secants whose slopes (m of distance per m of pitch) are kept within bounds:
# near 1 on a spiral. A pitch with which a bench cannot follow is multiplied by UNWALKABLE; no trial is
# farther from the last one than a share LONGEST_STEP of it.
LEAST_SLOPE, MOST_SLOPE, UNWALKABLE, LONGEST_STEP = 0.5, 3.0, 1.01, 0.1
# The range of pitches, times the one that exact people need; offsets from the route need about LIKELY
# times their deviation more of it.
NARROWEST, WIDEST, LIKELY = 0.7, 4.0, 2.0
# Limits of one dance: handles times sampled places, and pairs times places.
MOST_HANDLE_PLACES, MOST_PAIRS = 5_000_000, 1e10
# A step of a question places about so many handles. The cost of a point of a line, in handles placed,
# and in bytes; the most that tables may take in any case.
STEP_WORK, POINT_WORK, POINT_BYTES, MOST_BYTES = 200_000, 50, 16 * (COLUMNS + 1), 4e9


class DanceEnding(Numbered):
    """Exit statuses of a step, besides those of kernels/question.py."""

    DONE = 0
    NOT_FOUND = 1  # no pitch near the guess
    TOO_LONG = 2  # the walk, or the dragon
    NO_BENCH = 3  # that was drawn can be


@entry
def open_dance(family: Family, walk: Walk, limits: Vector) -> int:
    """Open a question about a dance; returns its handle, 0 without memory.

    `walk` is the plan's own of exact people, one of the family in which the pitch varies. All is
    copied. `limits` is a row of `DanceGiven`.
    """
    block = new_block(m.DANCE_END_SLOT - HEADER)
    if block == 0:
        return 0
    slots = integers_at(block, m.DANCE_END_SLOT)
    size = m.lay_own(slots, 0, family, walk, limits)
    if take(slots, DanceMemory.OWN, size) and m.make_rows(slots, walk.rows.shape[0]):
        m.lay_own(slots, slots[Header.OWNED + DanceMemory.OWN], family, walk, limits)
        begin(group_at(Dance, block + m.BASE), family, walk, limits)
        handle = remember(block)
        if handle:
            return handle
    release_block(block)
    return 0


@kernel
def begin(dance: Dance, family: Family, walk: Walk, limits: Vector) -> None:
    """Copy what a host passes, draw the benches, and let the question begin."""
    m.fill(dance, family, walk, limits)
    figures, drawn = dance.figures, dance.drawn
    seed, number = int(limits[DanceGiven.SEED]), int(limits[DanceGiven.DANCE])
    draw_benches(seed, number, limits[DanceGiven.BY :], family.sizes, drawn.sizes, drawn.aside)
    links_of(drawn.sizes, drawn.links)
    radii(drawn.sizes, dance.circles[0])
    figures[DanceTold.DOING] = DanceStage.BEGINNING if can_be(drawn) else DanceStage.SPOILT
    figures[DanceTold.PARTNERS], dance.sizes[DanceSize.PAIRS] = FEW_PARTNERS, -1
    figures[DanceTold.CLEAR] = math.inf
    figures[DanceTold.BEFORE] = math.nan
    figures[DanceTold.ROOM_BEFORE] = math.nan
    figures[DanceTold.PITCH] = limits[DanceGiven.GUESS] + LIKELY * math.hypot(
        limits[DanceGiven.ASIDE], limits[DanceGiven.STRAY]
    )


@kernel
def can_be(drawn: Drawn) -> bool:
    """Whether such benches are possible: the bounds of model/dragon.py."""
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
    """Search for some hundredths of a second, or about `left` handles: MORE, or the exit status."""
    block = recall(handle)
    if block == 0:
        return QuestionEnding.CLOSED
    ending, figures = QuestionEnding.MORE, group_at(Dance, block + m.BASE).figures
    figures[Told.SPENT] = 0.0
    while ending == QuestionEnding.MORE and figures[Told.SPENT] <= min(STEP_WORK, left):
        dance, doing = group_at(Dance, block + m.BASE), figures[DanceTold.DOING]
        if doing == DanceStage.BEGINNING:
            ending = try_pitch(block)
        elif doing == DanceStage.LOOKING:
            look_on(dance)
        elif doing == DanceStage.SEARCHING:
            ending = search_on(block)
        elif doing == DanceStage.JUDGING:
            ending = (
                judge_pitch(dance)
                if dance.limits[DanceGiven.WHAT] == DanceSought.NEEDED
                else judge_touch(dance)
            )
        else:
            ending = DanceEnding.NO_BENCH if doing == DanceStage.SPOILT else QuestionEnding.CLOSED
    if ending != QuestionEnding.MORE:
        figures[DanceTold.DOING] = DanceStage.ANSWERED
    return ending


@kernel
def walk_of(block: int) -> tuple[int, float, float]:
    """Lay the route of the current pitch: its rows, 0 for none; where its head begins and ends, m."""
    slots = integers_at(block, m.DANCE_END_SLOT)
    while True:
        dance = group_at(Dance, block + m.BASE)
        limits = dance.limits
        if limits[DanceGiven.WHAT] != DanceSought.NEEDED:
            return dance.walk.rows.shape[0], limits[DanceGiven.FIRST], limits[DanceGiven.LAST]
        count, first, last = set_walk(
            dance.family, dance.walk, dance.at, dance.placed, dance.figures[DanceTold.PITCH]
        )
        if count >= 0 or not m.make_rows(slots, -count):
            return count, first, last


@kernel
def given_up(figures: Vector, size: int) -> int:
    """The exit status of a question that needs `size` bytes, which are too many; -1: out of memory."""
    figures[Told.WANTED] = size
    return QuestionEnding.OVER_MEMORY if size > 0 else QuestionEnding.OUT_OF_MEMORY


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
    return max(low, 0.0) if math.isfinite(dance.walk.rows[0, RouteRow.U_BACK]) else low


@kernel
def measured(dance: Dance, count: int, first: float, last: float) -> bool:
    """Fill the sizes of what the current pitch needs; whether its line goes as far as the head."""
    sizes, rows, whole, limits = dance.sizes, dance.walk.rows[:count], whole_length(dance), dance.limits
    for n in range(DanceSize.ROUTE_ROWS, DanceSize.PAIRS):
        sizes[n] = 0
    sizes[DanceSize.ROUTE_ROWS] = count
    if bounds(rows, dance.drawn.links.shape[0]):
        sizes[DanceSize.RADII], sizes[DanceSize.GRIDS] = table_sizes(first, last, whole)
        sizes[DanceSize.STRETCHES] = stretch_count(first, last, shortest_link(dance))
    if not limits[DanceGiven.STRAY] > 0.0:
        sizes[DanceSize.GRIDS] = 0
        return True
    most = int(min(limits[DanceGiven.BYTES], MOST_BYTES) / POINT_BYTES) + 2
    sizes[DanceSize.POINTS] = lay_points(rows, line_low(dance, first), last, dance.points[:0], most)
    sizes[DanceSize.NUMBERS] = noise_count(last - first + WAYS * whole + STRAY_LENGTH)
    dance.figures[Told.SPENT] += POINT_WORK * sizes[DanceSize.POINTS]
    return last <= rows[count - 1, RouteRow.S_START] + rows[count - 1, RouteRow.LENGTH] + END_SLACK


@kernel
def try_pitch(block: int) -> int:
    """Begin the trial of the current pitch: MORE, or the exit status."""
    count, first, last = walk_of(block)
    dance, slots = group_at(Dance, block + m.BASE), integers_at(block, m.DANCE_END_SLOT)
    figures, benches = dance.figures, dance.drawn.links.shape[0]
    figures[DanceTold.TRIALS] += 1.0
    figures[Told.SPENT] += benches
    figures[DanceTold.ROOM], figures[DanceTold.DOING] = math.nan, DanceStage.JUDGING
    if count < 0:
        return QuestionEnding.OUT_OF_MEMORY
    if count == 0:
        return QuestionEnding.MORE
    places = place_count(dance, first, last, LOOK)
    if (benches + 1) * places > MOST_HANDLE_PLACES or 0.5 * (benches + 1) ** 2 * places > MOST_PAIRS:
        return DanceEnding.TOO_LONG
    if not measured(dance, count, first, last):
        return QuestionEnding.MORE
    size = m.make_line(slots, dance.sizes, benches, dance.limits[DanceGiven.BYTES])
    if size == 0 and dance.sizes[DanceSize.PAIRS] < 0:
        size = widen(block, FEW_PARTNERS)
    if size != 0:
        return given_up(figures, size)
    draw_line(group_at(Dance, block + m.BASE), first, last)
    look_first(group_at(Dance, block + m.BASE))
    return QuestionEnding.MORE


@kernel
def widen(block: int, partners: float) -> int:
    """Make room for so many pairs of a bench, as `make_step` does."""
    dance, slots = group_at(Dance, block + m.BASE), integers_at(block, m.DANCE_END_SLOT)
    benches = dance.drawn.links.shape[0]
    dance.figures[DanceTold.PARTNERS] = partners
    pairs = min(int(partners) * benches, benches * (benches - 1) // 2)
    dance.sizes[DanceSize.PAIRS] = pairs
    return m.make_step(slots, pairs, benches, dance.limits[DanceGiven.BYTES])


@kernel
def draw_line(dance: Dance, first: float, last: float) -> None:
    """Lay the line of the current pitch, and the parts of the head's way that must be searched."""
    figures, drawn, limits, parts = dance.figures, dance.drawn, dance.limits, dance.parts
    rows, stray = dance.walk.rows[: dance.sizes[DanceSize.ROUTE_ROWS]], limits[DanceGiven.STRAY]
    points, along = dance.points, dance.along
    figures[DanceTold.START], figures[DanceTold.END] = first, last
    fill_noise(int(limits[DanceGiven.SEED]), int(limits[DanceGiven.DANCE]), dance.noise)
    figures[DanceTold.PARTS] = 1.0
    parts[0, 0] = first
    parts[0, 1] = last
    parts[0, 2] = drawn.links.shape[0]
    if dance.sizes[DanceSize.RADII] and prepare(
        dance.bound, rows, drawn.links, drawn.sizes, drawn.aside, dance.noise, stray, first, last
    ):
        wanted = limits[DanceGiven.MARGIN] + 2.0 * GRAZE
        figures[DanceTold.PARTS] = fill_parts(dance.bound, drawn.links, drawn.sizes, wanted, parts)
        figures[Told.SPENT] += POINT_WORK * parts.shape[0]
    if points.shape[0]:
        lay_points(rows, line_low(dance, first), last, points, points.shape[0])
        lay_line(rows, points, dance.noise, stray, dance.line, along)
        for p in range(int(figures[DanceTold.PARTS])):
            for n in range(2):
                parts[p, n] = between(parts[p, n], points, along)
        figures[DanceTold.START], figures[DanceTold.END] = (
            between(first, points, along),
            between(last, points, along),
        )


@kernel
def search_on(block: int) -> int:
    """Search some more steps of the head: MORE, or the exit status."""
    dance = group_at(Dance, block + m.BASE)
    figures = dance.figures
    drawn = dance.drawn
    search = dance.search
    part = int(dance.figures[DanceTold.PART])
    if part >= figures[DanceTold.PARTS]:
        figures[DanceTold.DOING] = DanceStage.JUDGING
        return QuestionEnding.MORE
    start, end, count, places = part_at(dance, part, HEAD_STEP)
    n, steps, note = int(figures[DanceTold.PLACE]), dance.steps, dance.note
    some = min(m.STEPS_TOGETHER, places - 1 - n)
    for t in range(some + 1):
        steps[t] = start + (end - start) * (n + t) / (places - 1)
    for k in range(NOTES):
        note[k] = 0.0
    ending = search_steps(
        search, Goal.FIRST_TOUCH, dance.line, drawn.links[:count], drawn.aside[: count + 1],
        drawn.sizes,
        steps[: some + 1], dance.first, dance.second,
        Limits(dance.limits[DanceGiven.MARGIN], GRAZE, WIDTH, MOST_EVALUATIONS), note,
        dance.members[:count],
        dance.circles,
    )  # fmt: skip
    figures[Told.SPENT] += SEARCHED * (count + 1) * (some + 1 + note[Note.EVALUATIONS])
    figures[Told.SPENT] += 0.5 * PAIR_WORK * count * count * (some + 1)
    if ending == PairsEnding.CROWDED:
        size = widen(block, MORE_PARTNERS * figures[DanceTold.PARTNERS])
        return QuestionEnding.MORE if size == 0 else given_up(figures, size)
    if ending == Ending.CLEAR:
        last = n + some == places - 1
        figures[DanceTold.PART] = part + (1.0 if last else 0.0)
        figures[DanceTold.PLACE] = 0.0 if last else n + some
        return QuestionEnding.MORE
    figures[DanceTold.ROOM], figures[DanceTold.DOING] = math.nan, DanceStage.JUDGING
    if ending != Ending.FALLEN:
        met(dance, note[Note.UPPER], int(note[Note.PAIR]) % count)
    return QuestionEnding.MORE


@kernel
def met(dance: Dance, s: float, j: int) -> None:
    """Take the room from where a search found benches to touch, with the head at s, m."""
    figures, n = dance.figures, int(dance.figures[DanceTold.HINTS])
    set_hint(dance, n, s, j)
    figures[DanceTold.ROOM] = min(
        meeting_near(dance, n).distance - dance.limits[DanceGiven.MARGIN], -GRAZE
    )


@kernel
def judge_touch(dance: Dance) -> int:
    """Answer whether benches touch."""
    dance.figures[DanceTold.RESULT] = 0.0 if dance.figures[DanceTold.ROOM] > 0.0 else 1.0
    return DanceEnding.DONE


@kernel
def judge_pitch(dance: Dance) -> int:
    """Answer which pitch is needed, or go on to the next: MORE."""
    figures, guess = dance.figures, dance.limits[DanceGiven.GUESS]
    a = figures[DanceTold.BEFORE]
    fa = figures[DanceTold.ROOM_BEFORE]
    b = figures[DanceTold.PITCH]
    fb = figures[DanceTold.ROOM]
    sure = is_sure(dance)
    if not fb >= 0.0:
        figures[DanceTold.TOUCHING] = max(figures[DanceTold.TOUCHING], b)
        if figures[DanceTold.CLEAR] <= b:
            figures[DanceTold.CLEAR] = math.inf
    elif (sure or fb <= PITCH_TOLERANCE) and b > figures[DanceTold.TOUCHING]:
        figures[DanceTold.CLEAR] = min(figures[DanceTold.CLEAR], b)
    if figures[DanceTold.CLEAR] - figures[DanceTold.TOUCHING] <= PITCH_TOLERANCE:
        figures[DanceTold.RESULT] = figures[DanceTold.CLEAR]
        return DanceEnding.DONE
    slope = 1.0
    if math.isfinite(fb) and math.isfinite(fa) and b != a:
        slope = min(max((fb - fa) / (b - a), LEAST_SLOPE), MOST_SLOPE)
    figures[DanceTold.BEFORE], figures[DanceTold.ROOM_BEFORE], figures[DanceTold.PITCH] = (
        b,
        fb,
        next_pitch(dance, slope),
    )
    figures[DanceTold.DOING] = DanceStage.BEGINNING
    near = NARROWEST * guess < figures[DanceTold.PITCH] < WIDEST * guess
    return (
        QuestionEnding.MORE
        if near and figures[DanceTold.TRIALS] < m.MOST_PITCHES
        else DanceEnding.NOT_FOUND
    )


@kernel
def next_pitch(dance: Dance, slope: float) -> float:
    """The pitch to try next, m: where the room would be half of TOLERANCE, or just not any more."""
    figures = dance.figures
    pitch, room = figures[DanceTold.PITCH], figures[DanceTold.ROOM]
    touching, clear = figures[DanceTold.TOUCHING], figures[DanceTold.CLEAR]
    if math.isnan(room):
        ahead = UNWALKABLE * pitch
    elif clear < math.inf:
        ahead = clear - max(0.9 * PITCH_TOLERANCE, room / slope)
    else:
        ahead = pitch + (0.5 * PITCH_TOLERANCE - room) / slope
    # Where a bound clears most of a walk the sampled distances are far from the least.
    ahead = min(max(ahead, (1.0 - LONGEST_STEP) * pitch), (1.0 + LONGEST_STEP) * pitch)
    if touching < ahead < clear:
        return ahead
    return 0.5 * (touching + min(clear, max(pitch, touching)))
