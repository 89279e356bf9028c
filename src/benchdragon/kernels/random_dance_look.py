"""Where benches of a random dance come about nearest: looked at here and there, which is cheap."""

import math
from typing import NamedTuple

from benchdragon.kernels import random_dance_memory as m
from benchdragon.kernels.box import nearest_of
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.every_pair import PAIR_WORK
from benchdragon.kernels.question import SPENT
from benchdragon.kernels.random_dance_memory import Dance
from benchdragon.kernels.time_of_impact import Chain, close_left, evaluate_slot

# Head positions looked at, as a share of the shortest link; how often the range about the least
# distance is then looked at in so many parts.
LOOK, SHRINKS, SHARES = 0.3, 4, 8
# How far around a place known from another pitch, as a share of the longest link; how many benches
# beyond those that met there.
AROUND, BEYOND = 1.5, 12
# The end of the walk that tells about how near benches come where none can touch, m.
NEAR_END = 20.0
# Pitches are sought to this, m.
TOLERANCE = 1e-5
# What a question is doing.
ANSWERED, BEGINNING, LOOKING, SEARCHING, JUDGING, SPOILT = range(6)


class Meeting(NamedTuple):
    """Benches i < j so far apart, m (minus a depth), with the head at s, m; NaN: it cannot stand."""

    distance: float
    s: float
    i: int
    j: int


@kernel
def shortest_link(dance: Dance) -> float:
    """Of the benches, m."""
    least = math.inf
    for i in range(dance.drawn.links.shape[0]):
        least = min(least, dance.drawn.links[i])
    return least


@kernel
def place_count(dance: Dance, first: float, last: float, share: float) -> int:
    """Places of the head as near as that share of the shortest link, both ends among them."""
    return 2 + int((last - first) / (share * shortest_link(dance)))


@kernel
def note_low(dance: Dance, found: Meeting) -> None:
    """Take down a meeting as the lowest one."""
    figures = dance.figures
    figures[m.LOW], figures[m.LOW_AT] = found.distance, found.s
    figures[m.LOW_FRONT], figures[m.LOW_REAR] = found.i, found.j


@kernel
def set_hint(dance: Dance, n: int, s: float, j: int) -> None:
    """Let hint n be a place of the head, m, as told to a dance with another pitch."""
    figures, hints = dance.figures, dance.hints
    hints[n, 0], hints[n, 1], hints[n, 2] = s - figures[m.START], figures[m.END] - s, j + 1 + BEYOND
    figures[m.HINTS] = max(figures[m.HINTS], n + 1)


@kernel
def look(dance: Dance, count: int, s: float, fresh: bool, least: float) -> Meeting:
    """The nearest pair of the first benches with the head at s, m, of those nearer than `least`, m.

    The chain is followed on from where it was looked at before, unless it is to be fresh.
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
    dance.figures[SPENT] += count + 1 + 0.5 * PAIR_WORK * count * count
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
        for n in range(SHARES + 1):
            found = look(dance, count, low + (high - low) * n / SHARES, n == 0, seen)
            if math.isnan(found.distance):
                return found
            if found.distance < seen:
                seen, at = found.distance, n
            if found.distance < best.distance:
                best = found
        step = (high - low) / SHARES
        low, high = low + step * max(at - 1, 0), low + step * min(at + 1, SHARES)
        count = min(count, best.j + 1 + BEYOND)
    return best


@kernel
def meeting_near(dance: Dance, hint: int) -> Meeting:
    """Where benches come about nearest around a place known from another pitch.

    Counted from the start and from the end: whichever is nearer to touching.
    """
    start, end, hints, longest = dance.figures[m.START], dance.figures[m.END], dance.hints, 0.0
    for i in range(dance.drawn.links.shape[0]):
        longest = max(longest, dance.drawn.links[i])
    count = min(int(hints[hint, 2]), dance.drawn.links.shape[0])
    around, best = AROUND * longest, Meeting(math.inf, start, 0, 0)
    one = min(max(start + hints[hint, 0], start), end)
    other = min(max(end - hints[hint, 1], start), end)
    for n in range(1 if abs(other - one) < 0.1 * around else 2):
        s = one if n == 0 else other
        low, high = max(s - around, start), min(s + around, end)
        best = lowest(dance, best, low, high, count, SHRINKS + 1)
        if math.isnan(best.distance):
            return best
    return best


@kernel
def part_at(dance: Dance, part: int, share: float) -> tuple[float, float, int, int]:
    """Where a part begins and ends, m, its benches and places; if none is open, the walk's end."""
    figures, parts = dance.figures, dance.parts
    start, end, count = parts[part, 0], parts[part, 1], int(parts[part, 2])
    if figures[m.PARTS] == 0.0:
        end, count = figures[m.END], dance.drawn.links.shape[0]
        start = max(figures[m.START], end - NEAR_END)
    return start, end, count, place_count(dance, start, end, share)


@kernel
def is_sure(dance: Dance) -> bool:
    """Whether the pitch at hand is to be searched however far benches seem to keep apart.

    Lines that stray are drawn by arcs, whose number leaps with the pitch, and distances with it. Under
    a pitch that is clear each one must be told clear or touching, or the same would be tried again.
    """
    pitch, touching = dance.figures[m.PITCH], dance.figures[m.TOUCHING]
    near = 0.0 < pitch - touching <= TOLERANCE or pitch < dance.figures[m.CLEAR] < math.inf
    return near or dance.limits[m.WHAT] != m.NEEDED


@kernel
def weigh(dance: Dance) -> None:
    """Let the lowest distance seen tell the room, or be the reason to search."""
    figures = dance.figures
    if math.isnan(figures[m.LOW]):
        figures[m.DOING] = JUDGING
        return
    set_hint(dance, 0, figures[m.LOW_AT], int(figures[m.LOW_REAR]))
    room = figures[m.LOW] - dance.limits[m.MARGIN]
    figures[m.ROOM], figures[m.DOING] = room, JUDGING
    if room >= 0.0 and (is_sure(dance) or room <= TOLERANCE):
        figures[m.DOING], figures[m.PART], figures[m.PLACE] = SEARCHING, 0.0, 0.0


@kernel
def look_first(dance: Dance) -> None:
    """Look where benches met with other pitches; begin to look all over where they just do not now."""
    figures = dance.figures
    note_low(dance, Meeting(math.inf, figures[m.START], 0, 0))
    for n in range(int(figures[m.HINTS])):
        found = meeting_near(dance, n)
        if math.isnan(found.distance):
            return
        if found.distance < figures[m.LOW]:
            note_low(dance, found)
    figures[m.DOING], figures[m.PART], figures[m.PLACE] = LOOKING, 0.0, 0.0
    figures[m.SEEN], figures[m.SEEN_PART], figures[m.SEEN_PLACE] = math.inf, 0.0, 0.0
    room = figures[m.LOW] - dance.limits[m.MARGIN]
    if room < 0.0 or TOLERANCE < room < math.inf:
        weigh(dance)


@kernel
def look_on(dance: Dance) -> None:
    """Look at some more places; about the lowest one at last."""
    figures, part = dance.figures, int(dance.figures[m.PART])
    start, end, count, places = part_at(dance, part, LOOK)
    n = int(figures[m.PLACE])
    for t in range(n, min(n + m.STEPS, places)):
        found = look(dance, count, start + (end - start) * t / (places - 1), t == n, figures[m.SEEN])
        if math.isnan(found.distance):
            figures[m.DOING] = JUDGING
            return
        if found.distance < figures[m.SEEN]:
            figures[m.SEEN], figures[m.SEEN_PART], figures[m.SEEN_PLACE] = found.distance, part, t
    figures[m.PLACE] = n + m.STEPS
    if n + m.STEPS < places:
        return
    figures[m.PART], figures[m.PLACE] = part + 1.0, 0.0
    if part + 1 < figures[m.PARTS]:
        return
    start, end, count, places = part_at(dance, int(figures[m.SEEN_PART]), LOOK)
    step, t = (end - start) / (places - 1), figures[m.SEEN_PLACE]
    low, high = start + step * max(t - 1.0, 0.0), start + step * min(t + 1.0, places - 1.0)
    found = lowest(dance, Meeting(math.inf, start, 0, count - 1), low, high, count, SHRINKS)
    if not found.distance >= figures[m.LOW]:
        note_low(dance, found)
    weigh(dance)
