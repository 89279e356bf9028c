"""The greatest speeds, turning and accelerations of a walk, as a question: `open, step, read, close`.

The head's way is searched window by window: where they pay, cells of the route first (bench_cells.py)
and chains at a few places, whose values spare bounds at most others, then all that waits
(speed_search.py). Asked for a head speed, each quantity is sought with the head at 1 m/s, under what
the limits before allow. `bound_peak` tables how fast the head may walk over steps of its way, of which
head_speed.py makes a pace.
"""

import math

from benchdragon.kernels import memory
from benchdragon.kernels import speed_memory as told
from benchdragon.kernels import speed_search as peak
from benchdragon.kernels.arrays import IntVector, Stack, Table, Vector
from benchdragon.kernels.bench_cells import CELL_COLUMNS, CutCount, Cuts, cut_cells
from benchdragon.kernels.curve import RouteRow, length_at
from benchdragon.kernels.drive import QUANTITIES, DriveRate, DriveStep
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.head_speed import find_hull, tabulate
from benchdragon.kernels.memory import Header
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.rounding import find_seams
from benchdragon.kernels.speed_memory import (
    BASE,
    SPEED_END_SLOT,
    SpeedAsked,
    SpeedGiven,
    SpeedMemory,
    SpeedState,
    SpeedTold,
)
from benchdragon.kernels.speed_search import PartSpan, SpeedCount, SpeedNote
from benchdragon.kernels.status import Ended
from benchdragon.kernels.swept_boxes import EDGE

# First steps of the head that chains bound, as a share of the shortest link.
FIRST_CHAIN_STEP = 0.1
# The longest and the shortest cells, as shares of the shortest link.
COARSE_CELL, FINEST_CELL = 0.4, 0.0125
# The loss of a cell that is allowed, as a share, if no handle is faster than the head at so many
# places, as then the least loss hides that all along.
LEAST_LOSS, LOSS_SAMPLES = 1e-9, 4
# The cost of a handle that is bounded, in handles placed.
BOUNDED = 4.0
# Rounding of a speed that was seen, relative: some 1e-14 after 200 benches, room for ten times as much.
SPEED_ROUNDING = 1e-13


class SpeedStage(Numbered):
    """The stage of a question: in the last two samples, or all of the window, wait."""

    BEGUN, CUTTING, SAMPLED, WHOLE = range(4)


class SpeedEnding(Numbered):
    """Exit statuses of a step besides those of kernels/question.py; ON: it goes on."""

    ON, DONE, FALLEN = range(3)


@entry
def open_peak(
    rows: Table, links: Vector, kinds: Vector, group: IntVector, drives: peak.Drives,
    tolerances: Vector, limits: Vector, numbers: Vector,
) -> int:  # fmt: skip
    """Open a question about quantities with a tolerance; returns its handle, 0 without memory.

    `kinds`: the links, each once, the shortest first. Limits are infinite where there is none. All is
    copied.
    """
    block = memory.new_block(SPEED_END_SLOT - memory.HEADER)
    if block == 0:
        return 0
    slots, sizes = memory.integers_at(block, SPEED_END_SLOT), (rows.shape[0], links.shape[0])
    size = told.lay_all(slots, 0, *sizes, kinds.shape[0], drives.rates.shape[0])
    if memory.take(slots, SpeedMemory.OWN, size):
        address = slots[Header.OWNED + SpeedMemory.OWN]
        told.lay_all(slots, address, *sizes, kinds.shape[0], drives.rates.shape[0])
        own = memory.integers_at(address, size // 8)
        for n in range(own.shape[0]):
            own[n] = 0
        asked = memory.group_at(SpeedAsked, block + BASE)
        memory.copy_table(asked.rows, rows)
        memory.copy_row(asked.links, links)
        memory.copy_row(asked.group, group)
        for g in range(kinds.shape[0]):
            asked.kinds.links[g, 0] = kinds[g]
        memory.copy_table(asked.drives.ways, drives.ways)
        memory.copy_table(asked.drives.squares, drives.squares)
        memory.copy_row(asked.drives.rates, drives.rates)
        memory.copy_row(asked.tolerances, tolerances)
        memory.copy_row(asked.limits, limits)
        memory.copy_row(asked.numbers, numbers)
        begin(asked)
        handle = memory.remember(block)
        if handle:
            return handle
    memory.release_block(block)
    return 0


@entry
def read_peak(handle: int, figures: Vector) -> bool:
    """Fill an array of a host's with what is known; False if there is no such question."""
    block = memory.recall(handle)
    if block:
        memory.copy_row(figures, memory.group_at(SpeedAsked, block + BASE).figures)
    return block != 0


@kernel
def begin(asked: SpeedAsked) -> None:
    """Begin with the first quantity."""
    find_seams(asked.rows, asked.chains.errors.seams)
    find_seams(asked.rows, asked.shop.errors.seams)
    for t in range(peak.CHAIN_SLOTS):
        asked.chains.errors.sided[t] = 1.0
    for t in range(asked.shop.rears.shape[0]):
        asked.shop.errors.sided[t] = 1.0
    figures = asked.figures
    figures[SpeedTold.QUANTITY] = figures[SpeedTold.DECIDES] = -1.0
    figures[SpeedTold.LOWER], figures[SpeedTold.HIGHER] = asked.numbers[SpeedGiven.HEAD], math.inf
    for n in range(QUANTITIES):
        asked.state[SpeedState.ALL] += 1 if asked.tolerances[n] > 0.0 else 0
    if next_quantity(asked):
        next_window(asked)


@kernel
def at_speed(quantity: int, speed: float) -> float:
    """By how much a quantity is greater with the head at that speed, m/s, than at 1 m/s."""
    return speed if quantity in (DriveRate.SPEEDS, DriveRate.TURNING) else speed * speed


@kernel
def next_quantity(asked: SpeedAsked) -> bool:
    """Go over to the next quantity; False if there is none, or no head speed is left to it."""
    figures, counts, state = asked.figures, asked.counts, asked.state
    q, by_head = int(figures[SpeedTold.QUANTITY]) + 1, asked.numbers[SpeedGiven.HEAD] > 0.0
    while q < QUANTITIES and asked.tolerances[q] == 0.0:
        q += 1
    if q == QUANTITIES or (by_head and figures[SpeedTold.LOWER] == 0.0):
        return False
    figures[SpeedTold.QUANTITY] = q
    figures[SpeedTold.LIMIT] = asked.limits[q] / (
        at_speed(q, figures[SpeedTold.LOWER]) if by_head else 1.0
    )
    state[SpeedState.BEFORE] += counts[SpeedCount.EVALUATIONS]
    for n in range(peak.SPEED_NOTES):
        asked.notes[n] = 0.0
    for n in range(peak.SPEED_COUNTS):
        counts[n] = 0
    asked.notes[SpeedNote.SEEN] = -1.0
    state[SpeedState.NEXT] = state[SpeedState.WINDOW] = state[SpeedState.WINDOWS] = 0
    return True


@kernel
def pays(asked: SpeedAsked, way: float) -> bool:
    """Whether the coarse bound costs less than evaluations along the whole `way` of the head, m."""
    count = asked.kinds.links.shape[0] * (way + asked.numbers[SpeedGiven.EXTENT]) / COARSE_CELL
    return asked.numbers[SpeedGiven.CELL_COST] * count < asked.links.shape[0] * way / FIRST_CHAIN_STEP


@kernel
def window_count(asked: SpeedAsked, way: float) -> int:
    """Into how many windows so long a way, m, is parted: one if cells do not pay."""
    if not pays(asked, way):
        return 1
    links, extent = asked.kinds.links, asked.numbers[SpeedGiven.EXTENT]
    fits = asked.numbers[SpeedGiven.MOST_CELLS] / links.shape[0] * (FINEST_CELL * links[0, 0]) - extent
    return math.ceil(way / max(fits, extent))


@kernel
def next_window(asked: SpeedAsked) -> bool:
    """Go over to the next window, m, of a way without a gap, or of the next; False at the end."""
    state, figures, ways = asked.state, asked.figures, asked.drives.ways
    state[SpeedState.WINDOW] += 1
    if state[SpeedState.WINDOW] >= state[SpeedState.WINDOWS]:
        first = last = state[SpeedState.NEXT]
        if first == ways.shape[0]:
            return False
        while last + 1 < ways.shape[0] and ways[last + 1, 0] <= ways[last, 1]:
            last += 1
        figures[SpeedTold.BEGIN], figures[SpeedTold.END] = ways[first, 0], ways[last, 1]
        state[SpeedState.NEXT], state[SpeedState.WINDOW] = last + 1, 0
        state[SpeedState.WINDOWS] = window_count(asked, ways[last, 1] - ways[first, 0])
    n, count = state[SpeedState.WINDOW], state[SpeedState.WINDOWS]
    begin, way = figures[SpeedTold.BEGIN], figures[SpeedTold.END] - figures[SpeedTold.BEGIN]
    figures[SpeedTold.LOW] = begin + way * (n / count)
    figures[SpeedTold.HIGH] = (
        figures[SpeedTold.END] if n + 1 == count else begin + way * ((n + 1) / count)
    )
    figures[SpeedTold.GAP] = 0.0
    figures[SpeedTold.CLOSED_BY] = 0.0
    state[SpeedState.PHASE] = SpeedStage.BEGUN
    return True


@kernel
def sample(asked: SpeedAsked, k: int) -> float:
    """The head's position at sample k of the window, m."""
    low, high = asked.figures[SpeedTold.LOW], asked.figures[SpeedTold.HIGH]
    return high if k == LOSS_SAMPLES - 1 else k * ((high - low) / (LOSS_SAMPLES - 1)) + low


@kernel
def position(asked: SpeedAsked, i: int, t: int) -> float:
    """The route position of handle i in slot t, m."""
    rows, row = asked.rows, asked.chains.places.row[i, t]
    return rows[row, RouteRow.S_START] + length_at(rows, row, asked.chains.places.u[i, t])


@kernel
def find_spans(asked: SpeedAsked) -> bool:
    """Find where benches of each kind stand, and what cells may lose; False if one falls."""
    at, places, links, numbers = asked.batch.at, asked.chains.places, asked.links, asked.numbers
    figures, spans, most = asked.figures, asked.kinds.spans, 0.0
    for k in range(LOSS_SAMPLES):
        at[k] = sample(asked, k)
    if not place_chain(asked.rows, links, at, 0, LOSS_SAMPLES, places):
        return False
    benches = links.shape[0]
    figures[Told.SPENT] += LOSS_SAMPLES * (benches + 1)
    for n in range(benches):
        spans[asked.group[n], 0] = position(asked, n, 0) - EDGE
        first = benches - 1 - n
        spans[asked.group[first], 1] = position(asked, first, LOSS_SAMPLES - 1) + EDGE
    for i in range(benches + 1):
        for k in range(LOSS_SAMPLES):
            most = max(most, places.ratio[i, k])
    # Where no handle is faster than the head, nothing may be lost on the way to the tail.
    figures[SpeedTold.LOSS] = (
        LEAST_LOSS
        if most <= 1.0 + numbers[SpeedGiven.ALIKE]
        else numbers[SpeedGiven.MOST_LOSS] / benches
    )
    asked.reached[0] = position(asked, benches, 0)
    asked.reached[1] = COARSE_CELL * asked.kinds.links[0, 0]
    asked.cut[0] = asked.cut[1] = 0
    for g in range(spans.shape[0]):
        asked.shop.held[g] = 0
    return True


@kernel
def begun(block: int) -> int:
    """Begin a window."""
    asked = memory.group_at(SpeedAsked, block + BASE)
    if not pays(asked, asked.figures[SpeedTold.HIGH] - asked.figures[SpeedTold.LOW]):
        return wait(block, SpeedStage.WHOLE, 0)
    if not find_spans(asked):
        return SpeedEnding.FALLEN
    kinds, (start, longest) = asked.kinds.links.shape[0], (asked.reached[0], asked.reached[1])
    rows = 2 * math.ceil((asked.figures[SpeedTold.HIGH] - start) / longest) + 1
    memory.drop(memory.integers_at(block, SPEED_END_SLOT), SpeedMemory.CELL)
    address = memory.allocate(8 * rows * (4 + kinds * CELL_COLUMNS))
    if address == 0:
        return QuestionEnding.OUT_OF_MEMORY
    told.lay_cells(block, address, rows, kinds)
    asked.state[SpeedState.PHASE] = SpeedStage.CUTTING
    return SpeedEnding.ON


@kernel
def cutting(block: int) -> int:
    """Cut the window into cells."""
    asked = memory.group_at(SpeedAsked, block + BASE)
    figures, kinds, borders = asked.figures, asked.kinds.links, asked.cells.borders.shape[0]
    longest, shortest = COARSE_CELL * kinds[0, 0], FINEST_CELL * kinds[0, 0]
    cuts = Cuts(figures[SpeedTold.HIGH], longest, shortest, figures[SpeedTold.LOSS])
    budget = int(asked.numbers[SpeedGiven.BUDGET])
    ended = cut_cells(
        asked.rows, asked.kinds, asked.shop, cuts, asked.cells, asked.reached, asked.cut, budget
    )
    figures[Told.SPENT] += BOUNDED * budget
    if figures[Told.SPENT] > figures[SpeedTold.LEFT]:
        return given_up(asked)
    if ended == Ended.MORE:
        return QuestionEnding.MORE
    slots, columns = memory.integers_at(block, SPEED_END_SLOT), kinds.shape[0] * CELL_COLUMNS
    if ended == Ended.ROOM:
        address = told.doubled(slots[Header.OWNED + SpeedMemory.CELL], borders, 4, 1, columns)
        if address == 0:
            return QuestionEnding.OUT_OF_MEMORY
        told.lay_cells(block, address, 2 * borders, kinds.shape[0])
        return SpeedEnding.ON
    for n in range(5):  # only those that were cut
        slots[told.CELLS_SLOT + 1 + 2 * n] = asked.cut[CutCount.CELLS] + 1
    return wait(block, SpeedStage.SAMPLED, 0)


@kernel
def wait(block: int, phase: int, by_cells: int) -> int:
    """Let samples of the window wait, or all of its stretches."""
    slots, asked = memory.integers_at(block, SPEED_END_SLOT), memory.group_at(SpeedAsked, block + BASE)
    figures, ways, benches = asked.figures, asked.drives.ways, asked.links.shape[0]
    low = figures[SpeedTold.LOW]
    high = figures[SpeedTold.HIGH]
    room = LOSS_SAMPLES if phase == SpeedStage.SAMPLED else 0
    for n in range(0 if phase == SpeedStage.SAMPLED else ways.shape[0]):
        room += 1 if ways[n, 0] <= high and ways[n, 1] >= low else 0
    room += int(asked.numbers[SpeedGiven.FIRST_OPEN])
    memory.drop(slots, SpeedMemory.HEAP)
    address = memory.allocate(16 * room * peak.PART_FACTS)
    if address == 0:
        return QuestionEnding.OUT_OF_MEMORY
    told.lay_heap(block, address, room)
    heap = memory.group_at(SpeedAsked, block + BASE).heap
    figures[SpeedTold.MOST_ROWS] = room + (high - low) / (FIRST_CHAIN_STEP * asked.kinds.links[0, 0])
    figures[SpeedTold.MOST_ROWS] += asked.numbers[SpeedGiven.MOST_OPEN] / benches
    asked.state[SpeedState.PHASE], asked.counts[SpeedCount.OPEN] = phase, 0
    for k in range(LOSS_SAMPLES if phase == SpeedStage.SAMPLED else 0):
        at, n = sample(asked, k), 0
        while n + 1 < ways.shape[0] and ways[n, 1] < at:
            n += 1
        peak.push(heap, asked.counts, math.inf, at, at, n, benches, by_cells)
    for n in range(ways.shape[0] if phase == SpeedStage.WHOLE else 0):
        if ways[n, 0] <= high and ways[n, 1] >= low:
            a, b = min(max(ways[n, 0], low), high), min(max(ways[n, 1], low), high)
            peak.push(heap, asked.counts, math.inf, a, b, n, benches, by_cells)
    return SpeedEnding.ON


@kernel
def sought(block: int) -> int:
    """Process the parts that wait until the bracket is closed, or too many wait."""
    asked = memory.group_at(SpeedAsked, block + BASE)
    figures, notes, shortest = asked.figures, asked.notes, asked.kinds.links[0, 0]
    q = int(figures[SpeedTold.QUANTITY])
    room = asked.heap.parts.shape[0]
    budget = asked.numbers[SpeedGiven.BUDGET]
    coarse = asked.numbers[SpeedGiven.COARSE_STEP] * shortest
    aim = peak.SpeedAim(
        q, asked.tolerances[q], figures[SpeedTold.LIMIT], coarse, FIRST_CHAIN_STEP * shortest
    )
    ended = peak.seek_peak(
        asked.rows, asked.links, asked.group, asked.cells, aim, asked.drives, asked.heap, asked.batch,
        asked.chains, notes, asked.counts, int(budget),
    )  # fmt: skip
    figures[Told.SPENT] += BOUNDED * budget
    if figures[Told.SPENT] > figures[SpeedTold.LEFT]:
        return given_up(asked)
    if ended == Ended.FALLEN:
        return SpeedEnding.FALLEN
    if ended == Ended.MORE:
        return QuestionEnding.MORE
    if ended == Ended.ROOM and room <= figures[SpeedTold.MOST_ROWS]:
        before = memory.integers_at(block, SPEED_END_SLOT)[Header.OWNED + SpeedMemory.HEAP]
        address = told.doubled(before, room, 1, peak.PART_FACTS, peak.PART_FACTS)
        if address == 0:
            return QuestionEnding.OUT_OF_MEMORY
        told.lay_heap(block, address, 2 * room)
        return SpeedEnding.ON
    for n in range(asked.counts[SpeedCount.OPEN]):
        notes[SpeedNote.UPPER] = max(notes[SpeedNote.UPPER], asked.heap.parts[n, PartSpan.BOUND])
    if asked.state[SpeedState.PHASE] == SpeedStage.SAMPLED:
        return wait(block, SpeedStage.WHOLE, 1)
    if next_window(asked):
        return QuestionEnding.MORE
    settle(asked)
    return QuestionEnding.MORE if next_quantity(asked) and next_window(asked) else SpeedEnding.DONE


@kernel
def given_up(asked: SpeedAsked) -> int:
    """Give up a bracket that takes too much work, without an upper end; MORE if no value was seen."""
    if asked.notes[SpeedNote.SEEN] < 0.0:
        return QuestionEnding.MORE
    asked.notes[SpeedNote.UPPER], asked.figures[SpeedTold.GIVEN_UP] = math.inf, 1.0
    settle(asked)
    return SpeedEnding.DONE


@kernel
def head_speed(quantity: int, limit: float, most: float) -> float:
    """The head speed, m/s, at which a quantity keeps its limit that is so great at 1 m/s."""
    if most <= 0.0:
        return math.inf
    return (
        limit / most if quantity in (DriveRate.SPEEDS, DriveRate.TURNING) else math.sqrt(limit / most)
    )


@kernel
def settle(asked: SpeedAsked) -> None:
    """Report what the search of a quantity found; for a head speed only if it exceeds its limit."""
    figures, notes, q = asked.figures, asked.notes, int(asked.figures[SpeedTold.QUANTITY])
    asked.state[SpeedState.SOUGHT] += 1
    most = max(notes[SpeedNote.UPPER], notes[SpeedNote.SEEN])
    if asked.numbers[SpeedGiven.HEAD] > 0.0:
        if most <= figures[SpeedTold.LIMIT]:
            return
        figures[SpeedTold.LOWER] = head_speed(q, asked.limits[q], most)
        exceeds = head_speed(q, asked.limits[q], notes[SpeedNote.SURE] / (1.0 + SPEED_ROUNDING))
        if exceeds >= figures[SpeedTold.HIGHER] and figures[SpeedTold.DECIDES] >= 0.0:
            return
        figures[SpeedTold.HIGHER], figures[SpeedTold.DECIDES] = exceeds, q
    figures[SpeedTold.VALUE], figures[SpeedTold.LEAST] = notes[SpeedNote.SEEN], notes[SpeedNote.SURE]
    figures[SpeedTold.MOST] = most
    figures[SpeedTold.AT] = notes[SpeedNote.WHERE]
    figures[SpeedTold.STRETCH] = asked.counts[SpeedCount.WHEN]
    places, row, fast = asked.chains.places, asked.counts[SpeedCount.ROW], 0.0
    asked.batch.at[0] = notes[SpeedNote.WHERE]
    place_chain(asked.rows, asked.links, asked.batch.at, 0, 1, places)
    if (
        q == DriveRate.SPEEDS
    ):  # the first that attains it up to rounding: on one arc all are equally fast
        for i in range(places.ratio.shape[0]):
            fast = max(fast, places.ratio[i, 0])
        row = 0
        while places.ratio[row, 0] < fast * (1.0 - asked.numbers[SpeedGiven.ALIKE]):
            row += 1
    figures[SpeedTold.HANDLE] = row
    figures[SpeedTold.X] = places.x[row, 0]
    figures[SpeedTold.Y] = places.y[row, 0]


@kernel
def tell(asked: SpeedAsked, all_done: bool) -> None:
    """Report the progress: how narrow brackets are, of the first width to the tolerance."""
    figures, ways, q = asked.figures, asked.drives.ways, int(asked.figures[SpeedTold.QUANTITY])
    figures[SpeedTold.PLACED] = asked.state[SpeedState.BEFORE] + asked.counts[SpeedCount.EVALUATIONS]
    lower, whole = asked.notes[SpeedNote.SEEN], ways[ways.shape[0] - 1, 1] - ways[0, 0]
    if (
        lower > 0.0
        and asked.counts[SpeedCount.OPEN] > 0
        and asked.state[SpeedState.PHASE] == SpeedStage.WHOLE
    ):
        gap = asked.heap.parts[0, PartSpan.BOUND] / lower - 1.0
        if asked.tolerances[q] < gap < math.inf:
            gap = math.log(gap / asked.tolerances[q])
            figures[SpeedTold.GAP] = figures[SpeedTold.GAP] if figures[SpeedTold.GAP] > 0.0 else gap
            figures[SpeedTold.CLOSED_BY] = max(
                figures[SpeedTold.CLOSED_BY], 1.0 - gap / figures[SpeedTold.GAP]
            )
    window = figures[SpeedTold.HIGH] - figures[SpeedTold.LOW]
    done = figures[SpeedTold.LOW] - ways[0, 0] + figures[SpeedTold.CLOSED_BY] * window
    done = asked.state[SpeedState.SOUGHT] + (done / whole if whole > 0.0 else 0.0)
    share = 1.0 if all_done else done / asked.state[SpeedState.ALL]
    figures[SpeedTold.SHARE] = max(figures[SpeedTold.SHARE], share)


@entry
def step_peak(handle: int, left: float) -> int:
    """Search for some hundredths of a second; returns MORE, or the exit status.

    `left`: so many handles may be placed; if more are needed, what was seen gets no upper bound.
    """
    block = memory.recall(handle)
    if block == 0:
        return QuestionEnding.CLOSED
    asked = memory.group_at(SpeedAsked, block + BASE)
    asked.figures[Told.SPENT], asked.figures[SpeedTold.LEFT], ending = 0.0, left, SpeedEnding.ON
    while ending == SpeedEnding.ON:
        phase = asked.state[SpeedState.PHASE]
        ending = (
            begun(block)
            if phase == SpeedStage.BEGUN
            else cutting(block)
            if phase == SpeedStage.CUTTING
            else sought(block)
        )
    if ending in (QuestionEnding.MORE, SpeedEnding.DONE):
        tell(memory.group_at(SpeedAsked, block + BASE), ending == SpeedEnding.DONE)
    return ending


@entry
def bound_peak(
    handle: int, at: Vector, first: int, last: int, square: float, limits: Vector, most: Vector,
    table: Stack,
) -> int:  # fmt: skip
    """Fill most and table for steps first..last-1 of a pace: see `head_speed.tabulate`; DONE or FALLEN.

    Each step has as many parts, bounded together, as `at` has between two of its ends, m.
    """
    block = memory.recall(handle)
    if block == 0:
        return QuestionEnding.CLOSED
    asked, parts = memory.group_at(SpeedAsked, block + BASE), (at.shape[0] - 1) // most.shape[0]
    batch, chains = asked.batch, asked.chains
    batch.drive[DriveStep.FROM], batch.drive[DriveStep.TO], batch.drive[DriveStep.RATE] = 1.0, 1.0, 0.0
    chains.scratch.beside[0] = chains.scratch.beside[1] = 0.0
    for n in range(first, last):
        for k in range(parts + 1):
            batch.at[k] = at[n * parts + k]
        if not place_chain(asked.rows, asked.links, batch.at, 0, parts + 1, chains.places):
            return SpeedEnding.FALLEN
        find_hull(
            asked.rows, asked.links, chains.places, parts, batch.drive, chains.scratch, asked.hull
        )
        most[n] = tabulate(asked.hull, limits, square, table[n])
    return SpeedEnding.DONE
