"""Narrow phase by bisection: time of impact, end of a contact, least separation.

Continuous collision detection over an interval of the head's route position. The leftmost part of the
interval is opened first; pairs of benches that a lower bound of their separation shows apart all
through it (kernels/separation_bounds.py) are culled, and while any are left the part is bisected. No
part is passed over because of samples alone: a contact is never reported too late.
"""

import math
from typing import NamedTuple

import numpy as np

from benchdragon.kernels import motion_bounds as bounds
from benchdragon.kernels.arrays import IntTable, IntVector, Table, Vector
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, set_box
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.motion_bounds import BenchBound, HandleBound, bound_bench, bound_handles
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.rounding import bench_error, handle_errors, mark_lanes, still_error
from benchdragon.kernels.separation_bounds import gap_upper_bound, separation_lower_bound
from benchdragon.kernels.stray_chain import bound_beside, place_beside


class Goal(Numbered):
    """The goals of a search."""

    FIRST_TOUCH = 0  # the first head position at which a pair is nearer than the margin
    TOUCH_END = 1  # after a touch, the first at which no pair is
    LEAST = 2  # the least distance of any pair


class Ending(Numbered):
    """Exit status of a search."""

    CLEAR = 0  # the step is clear; TOUCH_END: touched throughout; LEAST: the bracket is closed
    FOUND = 1  # LEAST: benches overlap
    GRAZE = 2  # in the bracket a pair comes so near the margin that rounding hides on which side
    STUCK = 3  # too many evaluations; up to the bracket's lower end all is as for CLEAR
    FALLEN = 4  # the chain cannot stand at some place of the head
    # Classes of a part of the step, besides CLEAR, FOUND and GRAZE.
    UNSURE = 5  # rounding alone decides
    SPLIT = 6  # its halves must be searched


class Note(Numbered):
    """The state of a search, a row of floats."""

    LOWER = 0  # head position: as for CLEAR up to here, unless infinite
    UPPER = 1  # head position at which FOUND is sure, or at which LEAST was seen
    PAIR = 2  # number of the pair
    EVALUATIONS = 3  # chains marched
    NEAREST = 4  # LEAST: the least distance seen, m
    LOWEST = 5  # LEAST: no pair alive comes nearer in the current part, m
    FLOOR = 6  # LEAST: no pair comes nearer in the parts that were given up, m
    OFF = 7  # the largest error bound of distances that decided, m


NOTES = len(Note)

# Halvings that may be open at once; 2^-60 of any step is below rounding.
DEPTH = 60


class Chain(NamedTuple):
    """The benches that are searched, and what they walk on.

    Handle i walks aside[i] metres to the left of the route; all on it if `aside` is empty. Links are
    those of the benches up to the last member. Obstacles count as members after these. `seams` are
    those of `rounding.find_seams`; without any, computed places count as exact.
    """

    rows: Table
    links: Vector
    aside: Vector
    sizes: Table
    members: IntVector  # benches that are searched, from 0, ascending
    standing: Table  # boxes of obstacles, (obstacles, BOX_COLUMNS)
    seams: Table


class Pairs(NamedTuple):
    """Pair p is members first[p] and second[p]."""

    first: IntVector
    second: IntVector


class Limits(NamedTuple):
    """The margin, and when to stop.

    `slack`, m, is the least error that is assumed of distances, however small the bound on their
    rounding is, so that grazes end; for LEAST it is how far below the least distance seen the bound may
    lie. Parts of at most `width` metres are not halved; `most` evaluations are made.
    """

    margin: float
    slack: float
    width: float
    most: int


class Search(NamedTuple):
    """The arrays of one search: open right ends in slots 1.., the left end in slot 0."""

    at: Vector  # head positions, (DEPTH,)
    places: Placements
    handles: Table  # scratch, (handles, HANDLE_COLUMNS)
    sweeps: Table  # (members, BENCH_COLUMNS)
    boxes: Table  # (DEPTH * members, BOX_COLUMNS), slot by slot
    off: Vector  # error bounds of any point of these, m, (DEPTH * members,)
    lanes: Vector  # scratch of these, (handles,) either
    errors: Vector
    alive: IntTable  # pairs not yet shown to keep apart in the part up to a slot, (DEPTH, pairs)
    kept: IntVector  # how many, (DEPTH,)


def empty_search(handles: int, members: int, pairs: int) -> Search:
    """Room for searches of up to so many handles, members and pairs."""
    return Search(
        np.empty(DEPTH), empty_placements(handles, DEPTH), np.empty((handles, bounds.HANDLE_COLUMNS)),
        np.empty((members, bounds.BENCH_COLUMNS)), np.empty((DEPTH * members, BOX_COLUMNS)),
        np.empty(DEPTH * members), np.empty(handles), np.empty(handles),
        np.empty((DEPTH, pairs), dtype=np.int64), np.empty(DEPTH, dtype=np.int64),
    )  # fmt: skip


@kernel
def number_members(
    first: IntVector, second: IntVector, members: IntVector, place: IntVector, mine: IntVector,
    other: IntVector,
) -> int:  # fmt: skip
    """Fill members with the benches of pairs, ascending, and mine, other with the pairs by members.

    Returns the number of members. Pair p is benches first[p] < second[p]. `place` is scratch, one for
    each bench, all -1, as it is left.
    """
    last, count = 0, 0
    for p in range(first.shape[0]):
        place[first[p]] = place[second[p]] = 0
        last = max(last, second[p])
    for i in range(last + 1):
        if place[i] == 0:
            place[i], members[count] = count, i
            count += 1
    for p in range(first.shape[0]):
        mine[p], other[p] = place[first[p]], place[second[p]]
    for i in range(count):
        place[members[i]] = -1
    return count


@kernel
def open_step(search: Search, pairs: int, start: float, end: float) -> int:
    """Open the step from head position start to end; returns the slot of its end, 0 without pairs."""
    search.at[0], search.at[1] = start, end
    activate_pairs(search, pairs)
    return min(pairs, 1)


@kernel
def activate_pairs(search: Search, pairs: int) -> None:
    """Let all of so many pairs be alive in the step, whose end is in slot 1."""
    for p in range(pairs):
        search.alive[1, p] = p
    search.kept[1] = pairs


@kernel
def evaluate_slot(chain: Chain, search: Search, slot: int, near: int) -> bool:
    """Place the chain at a slot, as in `place_beside`, and box its members; whether it can stand."""
    rows, links, aside = chain.rows, chain.links, chain.aside
    if not place_beside(rows, links, aside, search.at, near, slot, search.places):
        return False
    box_slot(chain, search, slot)
    return True


@kernel
def member_count(chain: Chain) -> int:
    """The number of members: benches that are searched, and boxes of obstacles."""
    return chain.members.shape[0] + chain.standing.shape[0]


@kernel
def box_slot(chain: Chain, search: Search, slot: int) -> None:
    """Box the members at a slot, at which the chain is placed."""
    row, boxes, places = slot * member_count(chain), search.boxes, search.places
    for m in range(chain.members.shape[0]):
        set_box(chain.sizes, chain.members[m], places.x, places.y, slot, boxes, row + m)
    row += chain.members.shape[0]
    for n in range(chain.standing.shape[0]):
        for k in range(BOX_COLUMNS):
            boxes[row + n, k] = chain.standing[n, k]
    bound_rounding(chain, search, slot)


@kernel
def bound_rounding(chain: Chain, search: Search, slot: int) -> None:
    """Bound the errors of the members' places at a slot.

    They are seen from the row of the head, or beside obstacles from the route's first.
    """
    rows, seams, sizes, places, still = (
        chain.rows, chain.seams, chain.sizes, search.places, chain.standing,
    )  # fmt: skip
    row, errors = slot * member_count(chain), search.errors
    exact = seams.shape[0] == 0
    if not exact:
        mark_lanes(rows, chain.links, places, slot, slot + 1, search.lanes)
        handle_errors(rows, chain.links, seams, places, search.lanes, slot, errors)
    seen = 0 if still.shape[0] else places.row[0, slot]
    for m in range(chain.members.shape[0]):
        i = chain.members[m]
        search.off[row + m] = (
            0.0 if exact else bench_error(rows, seams, places, sizes, i, slot, seen, errors)
        )
    row += chain.members.shape[0]
    for n in range(still.shape[0]):
        search.off[row + n] = still_error(still, n)


@kernel
def bound_members(chain: Chain, search: Search, top: int) -> None:
    """Bound the benches' motion over the part from slot 0 to slot top."""
    rows, links, aside = chain.rows, chain.links, chain.aside
    if aside.shape[0] == 0:
        bound_handles(rows, links, search.places, 0, top, search.handles)
    else:
        bound_beside(rows, links, aside, search.places, 0, top, search.handles)
    for m in range(chain.members.shape[0]):
        i = chain.members[m]
        bound_bench(search.handles, i, chain.sizes, i, search.sweeps[m])
    for m in range(chain.members.shape[0], member_count(chain)):
        for k in range(bounds.BENCH_COLUMNS):
            search.sweeps[m, k] = 0.0


@kernel
def close_left(search: Search, top: int, handles: int, members: int) -> None:
    """Make the right end in slot top the new left end."""
    search.at[0] = search.at[top]
    places, boxes = search.places, search.boxes
    for i in range(handles):
        places.row[i, 0], places.u[i, 0] = places.row[i, top], places.u[i, top]
        places.x[i, 0], places.y[i, 0] = places.x[i, top], places.y[i, top]
        places.ratio[i, 0] = places.ratio[i, top]
        places.tx[i, 0], places.ty[i, 0] = places.tx[i, top], places.ty[i, top]
    for m in range(members):
        for k in range(BOX_COLUMNS):
            boxes[m, k] = boxes[top * members + m, k]
        search.off[m] = search.off[top * members + m]


@kernel
def halve(search: Search, top: int) -> int:
    """Put the middle of the part into a new slot; both halves get the part's pairs."""
    search.at[top + 1] = 0.5 * (search.at[0] + search.at[top])
    count = search.kept[top]
    search.kept[top + 1] = count
    for n in range(count):
        search.alive[top + 1, n] = search.alive[top, n]
    return top + 1


@kernel
def end_distance(search: Search, slot: int, members: int, i: int, j: int) -> float:
    """Distance of members i and j at a slot, m; minus the depth where they overlap."""
    return box_distance(search.boxes, slot * members + i, slot * members + j)


@kernel
def separation_error(search: Search, top: int, count: int, i: int, j: int, slack: float) -> float:
    """Error bound of the distance of members i and j at the part's ends, m; not below slack."""
    off, end = search.off, top * count
    return max(slack, off[i] + off[j], off[end + i] + off[end + j])


@kernel
def cull_separated(
    search: Search, top: int, count: int, pairs: Pairs, wanted: float, slack: float, note: FloatArray
) -> float:
    """Leave alive the pairs that may come as near as `wanted` in the part; the least bound of them.

    With a slack, pairs are left alive whose exact distance may come so near, whatever the rounding.
    """
    h, kept, lowest = search.handles[0, HandleBound.PATH], 0, math.inf
    for n in range(search.kept[top]):
        p = search.alive[top, n]
        i, j = pairs.first[p], pairs.second[p]
        unsure = separation_error(search, top, count, i, j, slack)
        most = wanted + unsure
        bound = separation_lower_bound(search.boxes, search.sweeps, top * count, i, j, h, most)
        if bound > most:
            continue
        note[Note.OFF] = max(note[Note.OFF], unsure)
        if slack > 0.0 or not bound > wanted:
            search.alive[top, kept] = p
            kept += 1
            lowest = min(lowest, bound)
    search.kept[top] = kept
    return lowest


@kernel
def classify_first_contact(
    search: Search, top: int, count: int, pairs: Pairs, limits: Limits, note: FloatArray
) -> int:
    """Classify the part up to slot `top` for FIRST_TOUCH."""
    margin, past = limits.margin, math.inf
    for n in range(search.kept[top]):
        p = search.alive[top, n]
        i, j = pairs.first[p], pairs.second[p]
        apart = end_distance(search, 0, count, i, j)
        unsure = separation_error(search, top, count, i, j, limits.slack)
        past = min(past, apart - 3.0 * unsure)
        if apart <= margin - unsure:
            note[Note.UPPER], note[Note.PAIR] = search.at[0], p
            note[Note.OFF] = max(note[Note.OFF], unsure)
            return Ending.FOUND
    least = cull_separated(search, top, count, pairs, margin, limits.slack, note)
    if search.kept[top] == 0:
        # A graze is over when it is left well behind: rounding makes distances flicker.
        note[Note.UPPER] = search.at[0]
        return Ending.GRAZE if note[Note.LOWER] < math.inf and past > margin else Ending.CLEAR
    for n in range(search.kept[top]):
        p = search.alive[top, n]
        note[Note.PAIR] = p
        i, j = pairs.first[p], pairs.second[p]
        a, b = end_distance(search, 0, count, i, j), end_distance(search, top, count, i, j)
        unsure = separation_error(search, top, count, i, j, limits.slack)
        far = max(a, b) > margin + 2.0 * unsure or min(a, b) - least > 0.5 * unsure
        if far or b <= margin - unsure:
            return Ending.SPLIT
    return Ending.UNSURE


@kernel
def classify_contact_end(
    search: Search, top: int, count: int, pairs: Pairs, limits: Limits, note: FloatArray
) -> int:
    """Classify the part for TOUCH_END: one pair must stay near, by its travel or by its faces."""
    margin, freed = limits.margin, math.inf
    nearest, held, rounding = math.inf, False, False
    for p in range(pairs.first.shape[0]):
        i, j = pairs.first[p], pairs.second[p]
        a, b = end_distance(search, 0, count, i, j), end_distance(search, top, count, i, j)
        unsure = separation_error(search, top, count, i, j, limits.slack)
        note[Note.OFF], freed = max(note[Note.OFF], unsure), min(freed, a - unsure)
        spent = search.sweeps[i, BenchBound.TRAVEL] + search.sweeps[j, BenchBound.TRAVEL]
        held = held or 0.5 * (a + b + spent) < margin - unsure
        ceiling = math.inf
        if not held and max(a, b) < margin + 2.0 * unsure:
            h = search.handles[0, HandleBound.PATH]
            ceiling = gap_upper_bound(search.boxes, search.sweeps, top * count, i, j, h)
            held = ceiling < min(margin - unsure, 0.0)
        if a < nearest:
            nearest, note[Note.PAIR] = a, p
            rounding = min(a, b) >= margin - 4.0 * unsure and ceiling - max(a, b) <= 0.5 * unsure
    if freed > margin:
        note[Note.UPPER] = search.at[0]
        return Ending.FOUND
    if held:
        note[Note.LOWER] = math.inf
        return Ending.CLEAR
    return Ending.UNSURE if rounding else Ending.SPLIT


@kernel
def classify_least(
    search: Search, top: int, count: int, pairs: Pairs, limits: Limits, note: FloatArray
) -> int:
    """Classify the part for LEAST; the least distance seen may fall."""
    for n in range(search.kept[top]):
        p = search.alive[top, n]
        for slot in (0, top):
            apart = end_distance(search, slot, count, pairs.first[p], pairs.second[p])
            if apart < note[Note.NEAREST]:
                note[Note.NEAREST], note[Note.UPPER], note[Note.PAIR] = apart, search.at[slot], p
    if note[Note.NEAREST] <= 0.0:
        return Ending.FOUND
    note[Note.LOWEST] = cull_separated(
        search, top, count, pairs, note[Note.NEAREST] - limits.slack, 0.0, note
    )
    return Ending.CLEAR if search.kept[top] == 0 else Ending.SPLIT


@kernel
def classify_interval(
    search: Search, goal: int, top: int, count: int, pairs: Pairs, limits: Limits, note: FloatArray
) -> int:
    """Classify the part up to slot `top` for the goal."""
    if goal == Goal.FIRST_TOUCH:
        return classify_first_contact(search, top, count, pairs, limits, note)
    if goal == Goal.TOUCH_END:
        return classify_contact_end(search, top, count, pairs, limits, note)
    return classify_least(search, top, count, pairs, limits, note)


@kernel
def bisect(
    search: Search, goal: int, chain: Chain, pairs: Pairs, top: int, ready: int, limits: Limits,
    note: FloatArray,
) -> int:  # fmt: skip
    """Search a step that was begun for `goal`, whose chains before slot `ready` were placed.

    Returns the exit status; `note` receives what was found. For LEAST note[NEAREST] and note[FLOOR]
    hold what earlier steps found; otherwise `note` is fresh.
    """
    count, handles = member_count(chain), chain.links.shape[0] + 1
    evaluations, note[Note.LOWER] = 0, math.inf
    while top > 0:
        while ready <= top:
            if not evaluate_slot(chain, search, ready, 0):
                note[Note.LOWER] = min(note[Note.LOWER], search.at[0])
                note[Note.UPPER] = search.at[ready]
                return Ending.FALLEN
            ready += 1
            evaluations += 1
            note[Note.EVALUATIONS] += 1.0
        bound_members(chain, search, top)
        verdict = classify_interval(search, goal, top, count, pairs, limits, note)
        if verdict == Ending.SPLIT:
            full = top + 2 >= DEPTH or evaluations >= limits.most
            if not full and search.at[top] - search.at[0] > limits.width:
                top = halve(search, top)
                continue
            verdict = Ending.STUCK if full and goal != Goal.LEAST else Ending.UNSURE
        if verdict != Ending.CLEAR:
            note[Note.LOWER] = min(note[Note.LOWER], search.at[0])
        if verdict == Ending.STUCK:
            note[Note.UPPER] = search.at[top]
        if verdict in (Ending.FOUND, Ending.GRAZE, Ending.STUCK):
            return verdict
        if verdict == Ending.UNSURE:
            note[Note.FLOOR] = min(note[Note.FLOOR], note[Note.LOWEST])
        close_left(search, top, handles, count)
        top, ready = top - 1, ready - 1
    return close(search, goal, count, pairs, limits, note)


@kernel
def close(search: Search, goal: int, count: int, pairs: Pairs, limits: Limits, note: FloatArray) -> int:
    """The exit status of a search that reached the end of its step, which is the left end now."""
    if goal == Goal.FIRST_TOUCH:
        for p in range(pairs.first.shape[0]):
            i, j = pairs.first[p], pairs.second[p]
            unsure = separation_error(search, 0, count, i, j, limits.slack)
            if end_distance(search, 0, count, i, j) <= limits.margin - unsure:
                note[Note.LOWER], note[Note.UPPER] = min(note[Note.LOWER], search.at[0]), search.at[0]
                note[Note.PAIR], note[Note.OFF] = p, max(note[Note.OFF], unsure)
                return Ending.FOUND
    if note[Note.LOWER] < math.inf:
        if goal != Goal.LEAST:
            note[Note.UPPER] = search.at[0]
        return Ending.GRAZE
    note[Note.LOWER] = search.at[0]
    return Ending.CLEAR
