"""Where benches of a random dance come nearest, by sampling, which is cheap."""

import math
from typing import NamedTuple

from benchdragon.kernels import random_dance_memory as m
from benchdragon.kernels.box import nearest_of
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.every_pair import PAIR_WORK
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.question import Told
from benchdragon.kernels.random_dance_memory import Dance, DanceGiven, DanceSought, DanceTold
from benchdragon.kernels.time_of_impact import Chain, close_left, evaluate_slot

# Distance of sampled head positions, as a share of the shortest link; how often the range about the
# least distance is then sampled, in so many parts.
LOOK, LOOK_SHRINKS, LOOK_PARTS = 0.3, 4, 8
# How far around a place known from another pitch is sampled, as a share of the longest link; how many
# benches are considered beyond those that met there.
AROUND, BEYOND = 1.5, 12
# Length of the walk's end, m, at which the least distance is sampled where no benches can touch.
NEAR_END = 20.0
# Tolerance of the pitch, m.
PITCH_TOLERANCE = 1e-5


class DanceStage(Numbered):
    """The stage of a question."""

    ANSWERED, BEGINNING, LOOKING, SEARCHING, JUDGING, SPOILT = range(6)


class Meeting(NamedTuple):
    """Benches i < j so far apart, m (minus a depth), with the head at s, m; NaN: they have no place."""

    distance: float
    s: float
    i: int
    j: int


@kernel
def shortest_link(dance: Dance) -> float:
    """The shortest link of the benches, m."""
    least = math.inf
    for i in range(dance.drawn.links.shape[0]):
        least = min(least, dance.drawn.links[i])
    return least


@kernel
def place_count(dance: Dance, first: float, last: float, share: float) -> int:
    """The number of head positions spaced by that share of the shortest link, both ends among them."""
    return 2 + int((last - first) / (share * shortest_link(dance)))


@kernel
def note_low(dance: Dance, found: Meeting) -> None:
    """Record a meeting as the lowest one."""
    figures = dance.figures
    figures[DanceTold.LOW], figures[DanceTold.LOW_AT] = found.distance, found.s
    figures[DanceTold.LOW_FRONT], figures[DanceTold.LOW_REAR] = found.i, found.j


@kernel
def set_hint(dance: Dance, n: int, s: float, j: int) -> None:
    """Make head position s, m, hint n, in a form that holds for a dance with another pitch."""
    figures, hints = dance.figures, dance.hints
    hints[n, 0] = s - figures[DanceTold.START]
    hints[n, 1] = figures[DanceTold.END] - s
    hints[n, 2] = j + 1 + BEYOND
    figures[DanceTold.HINTS] = max(figures[DanceTold.HINTS], n + 1)


@kernel
def look(dance: Dance, count: int, s: float, fresh: bool, least: float) -> Meeting:
    """The nearest pair of the first benches with the head at s, m, of those nearer than `least`, m.

    The chain is followed on from the sample before, unless `fresh`.
    """
    search, drawn, circles, slot = dance.search, dance.drawn, dance.circles, 0 if fresh else 1
    aside = drawn.aside[: count + 1]
    boxes, seams = search.boxes[slot * count : (slot + 1) * count], search.boxes[:0]
    chain = Chain(
        dance.line,
        drawn.links[:count],
        aside,
        drawn.sizes,
        dance.members[:count],
        search.boxes[:0],
        seams,
    )
    dance.figures[Told.SPENT] += count + 1 + 0.5 * PAIR_WORK * count * count
    search.at[slot] = s
    if not evaluate_slot(chain, search, slot, 0):
        return Meeting(math.nan, s, 0, 0)
    distance, i, j = nearest_of(
        boxes, circles[0][:count], circles[1][:count], circles[2][:count], least
    )
    if slot:
        close_left(search, 1, count + 1, count)
    return Meeting(distance, s, i, j)


@kernel
def lowest(dance: Dance, best: Meeting, low: float, high: float, count: int, rounds: int) -> Meeting:
    """The lowest meeting of the first benches about the range from low to high, m, or `best`."""
    for _ in range(rounds):
        seen, at = math.inf, 0
        for n in range(LOOK_PARTS + 1):
            found = look(dance, count, low + (high - low) * n / LOOK_PARTS, n == 0, seen)
            if math.isnan(found.distance):
                return found
            if found.distance < seen:
                seen, at = found.distance, n
            if found.distance < best.distance:
                best = found
        step = (high - low) / LOOK_PARTS
        low, high = low + step * max(at - 1, 0), low + step * min(at + 1, LOOK_PARTS)
        count = min(count, best.j + 1 + BEYOND)
    return best


@kernel
def meeting_near(dance: Dance, hint: int) -> Meeting:
    """About the nearest meeting of benches around a place known from another pitch.

    That place is counted from the start and from the end: the meeting nearer to touching is taken.
    """
    start = dance.figures[DanceTold.START]
    end = dance.figures[DanceTold.END]
    hints = dance.hints
    longest = 0.0
    for i in range(dance.drawn.links.shape[0]):
        longest = max(longest, dance.drawn.links[i])
    count = min(int(hints[hint, 2]), dance.drawn.links.shape[0])
    around, best = AROUND * longest, Meeting(math.inf, start, 0, 0)
    one = min(max(start + hints[hint, 0], start), end)
    other = min(max(end - hints[hint, 1], start), end)
    for n in range(1 if abs(other - one) < 0.1 * around else 2):
        s = one if n == 0 else other
        low, high = max(s - around, start), min(s + around, end)
        best = lowest(dance, best, low, high, count, LOOK_SHRINKS + 1)
        if math.isnan(best.distance):
            return best
    return best


@kernel
def part_at(dance: Dance, part: int, share: float) -> tuple[float, float, int, int]:
    """Start and end of a part, m, its benches and places; the walk's end if there is no part."""
    figures, parts = dance.figures, dance.parts
    start, end, count = parts[part, 0], parts[part, 1], int(parts[part, 2])
    if figures[DanceTold.PARTS] == 0.0:
        end, count = figures[DanceTold.END], dance.drawn.links.shape[0]
        start = max(figures[DanceTold.START], end - NEAR_END)
    return start, end, count, place_count(dance, start, end, share)


@kernel
def is_sure(dance: Dance) -> bool:
    """Whether the current pitch must be searched, however far apart benches were sampled.

    Lines that stray are drawn by arcs, whose number leaps with the pitch, and distances with it. Under
    a clear pitch each one must be shown to be clear or touching, or the same would be tried again.
    """
    pitch, touching = dance.figures[DanceTold.PITCH], dance.figures[DanceTold.TOUCHING]
    near = (
        0.0 < pitch - touching <= PITCH_TOLERANCE or pitch < dance.figures[DanceTold.CLEAR] < math.inf
    )
    return near or dance.limits[DanceGiven.WHAT] != DanceSought.NEEDED


@kernel
def weigh(dance: Dance) -> None:
    """Take the room from the lowest sampled distance, or let it be the reason to search."""
    figures = dance.figures
    if math.isnan(figures[DanceTold.LOW]):
        figures[DanceTold.DOING] = DanceStage.JUDGING
        return
    set_hint(dance, 0, figures[DanceTold.LOW_AT], int(figures[DanceTold.LOW_REAR]))
    room = figures[DanceTold.LOW] - dance.limits[DanceGiven.MARGIN]
    figures[DanceTold.ROOM], figures[DanceTold.DOING] = room, DanceStage.JUDGING
    if room >= 0.0 and (is_sure(dance) or room <= PITCH_TOLERANCE):
        figures[DanceTold.DOING] = DanceStage.SEARCHING
        figures[DanceTold.PART] = 0.0
        figures[DanceTold.PLACE] = 0.0


@kernel
def look_first(dance: Dance) -> None:
    """Sample where benches met with other pitches; begin to sample everywhere if they just miss."""
    figures = dance.figures
    note_low(dance, Meeting(math.inf, figures[DanceTold.START], 0, 0))
    for n in range(int(figures[DanceTold.HINTS])):
        found = meeting_near(dance, n)
        if math.isnan(found.distance):
            return
        if found.distance < figures[DanceTold.LOW]:
            note_low(dance, found)
    figures[DanceTold.DOING] = DanceStage.LOOKING
    figures[DanceTold.PART] = 0.0
    figures[DanceTold.PLACE] = 0.0
    figures[DanceTold.SEEN] = math.inf
    figures[DanceTold.SEEN_PART] = 0.0
    figures[DanceTold.SEEN_PLACE] = 0.0
    room = figures[DanceTold.LOW] - dance.limits[DanceGiven.MARGIN]
    if room < 0.0 or PITCH_TOLERANCE < room < math.inf:
        weigh(dance)


@kernel
def look_on(dance: Dance) -> None:
    """Sample some more places; at last refine about the lowest one."""
    figures, part = dance.figures, int(dance.figures[DanceTold.PART])
    start, end, count, places = part_at(dance, part, LOOK)
    n = int(figures[DanceTold.PLACE])
    for t in range(n, min(n + m.STEPS_TOGETHER, places)):
        found = look(
            dance, count, start + (end - start) * t / (places - 1), t == n, figures[DanceTold.SEEN]
        )
        if math.isnan(found.distance):
            figures[DanceTold.DOING] = DanceStage.JUDGING
            return
        if found.distance < figures[DanceTold.SEEN]:
            figures[DanceTold.SEEN] = found.distance
            figures[DanceTold.SEEN_PART] = part
            figures[DanceTold.SEEN_PLACE] = t
    figures[DanceTold.PLACE] = n + m.STEPS_TOGETHER
    if n + m.STEPS_TOGETHER < places:
        return
    figures[DanceTold.PART], figures[DanceTold.PLACE] = part + 1.0, 0.0
    if part + 1 < figures[DanceTold.PARTS]:
        return
    start, end, count, places = part_at(dance, int(figures[DanceTold.SEEN_PART]), LOOK)
    step, t = (end - start) / (places - 1), figures[DanceTold.SEEN_PLACE]
    low, high = start + step * max(t - 1.0, 0.0), start + step * min(t + 1.0, places - 1.0)
    found = lowest(dance, Meeting(math.inf, start, 0, count - 1), low, high, count, LOOK_SHRINKS)
    if not found.distance >= figures[DanceTold.LOW]:
        note_low(dance, found)
    weigh(dance)
