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
from benchdragon.kernels.bench_cells import CELL_COLUMNS, CELLS, Cuts, cut_cells
from benchdragon.kernels.curve import S_START, length_at
from benchdragon.kernels.drive import FROM, QUANTITIES, RATE, SPEEDS, TO, TURNING
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.head_speed import find_hull, tabulate
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.question import CLOSED, MORE, OUT_OF_MEMORY, SPENT
from benchdragon.kernels.rounding import find_seams
from benchdragon.kernels.speed_memory import BASE, END_SLOT, Asked
from benchdragon.kernels.status import Ended
from benchdragon.kernels.swept_boxes import EDGE

# First steps of the head that chains bound, as a share of the shortest link.
STEP = 0.1
# The longest and the shortest cells, likewise.
COARSE_CELL, FINEST_CELL = 0.4, 0.0125
# What a cell may lose, as a share, where no handle is faster than the head at any of so many places, as
# then the least loss hides that all along.
LEAST_LOSS, SAMPLES = 1e-9, 4
# What a handle that is bounded costs, in handles placed.
BOUNDED = 4.0
# Rounding of a speed that was seen, relative: some 1e-14 after 200 benches, room for ten times as much.
SPEED_ROUNDING = 1e-13

# What a question is doing: the last two let samples, or all of the window, wait.
BEGUN, CUTTING, SAMPLED, WHOLE = range(4)
# How a step ends besides those of kernels/question.py; ON: it has not.
ON, DONE, FALLEN = range(3)


@entry
def open_peak(
    rows: Table, links: Vector, kinds: Vector, group: IntVector, drives: peak.Drives,
    tolerances: Vector, limits: Vector, numbers: Vector,
) -> int:  # fmt: skip
    """Open a question about quantities with a tolerance; its handle, 0 if there is no memory.

    `kinds`: the links, each once, the shortest first. Limits are infinite where there is none. What is
    handed over is copied.
    """
    block = memory.new_block(END_SLOT - memory.HEADER)
    if block == 0:
        return 0
    slots, sizes = memory.integers_at(block, END_SLOT), (rows.shape[0], links.shape[0])
    size = told.lay_all(slots, 0, *sizes, kinds.shape[0], drives.rates.shape[0])
    if memory.take(slots, told.OWN_MEMORY, size):
        address = slots[memory.OWNED + told.OWN_MEMORY]
        told.lay_all(slots, address, *sizes, kinds.shape[0], drives.rates.shape[0])
        own = memory.integers_at(address, size // 8)
        for n in range(own.shape[0]):
            own[n] = 0
        asked = memory.group_at(Asked, block + BASE)
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
        memory.copy_row(figures, memory.group_at(Asked, block + BASE).figures)
    return block != 0


@kernel
def begin(asked: Asked) -> None:
    """Begin with the first quantity."""
    find_seams(asked.rows, asked.chains.errors.seams)
    find_seams(asked.rows, asked.shop.errors.seams)
    for t in range(peak.SLOTS):
        asked.chains.errors.sided[t] = 1.0
    for t in range(asked.shop.rears.shape[0]):
        asked.shop.errors.sided[t] = 1.0
    figures = asked.figures
    figures[told.QUANTITY] = figures[told.DECIDES] = -1.0
    figures[told.LOWER], figures[told.HIGHER] = asked.numbers[told.HEAD], math.inf
    for n in range(QUANTITIES):
        asked.state[told.ALL] += 1 if asked.tolerances[n] > 0.0 else 0
    if next_quantity(asked):
        next_window(asked)


@kernel
def at_speed(quantity: int, speed: float) -> float:
    """By how much a quantity is greater with the head at that speed, m/s, than at 1 m/s."""
    return speed if quantity in (SPEEDS, TURNING) else speed * speed


@kernel
def next_quantity(asked: Asked) -> bool:
    """Go over to the next quantity; False if there is none, or no head speed is left to it."""
    figures, counts, state = asked.figures, asked.counts, asked.state
    q, by_head = int(figures[told.QUANTITY]) + 1, asked.numbers[told.HEAD] > 0.0
    while q < QUANTITIES and asked.tolerances[q] == 0.0:
        q += 1
    if q == QUANTITIES or (by_head and figures[told.LOWER] == 0.0):
        return False
    figures[told.QUANTITY] = q
    figures[told.LIMIT] = asked.limits[q] / (at_speed(q, figures[told.LOWER]) if by_head else 1.0)
    state[told.BEFORE] += counts[peak.EVALUATIONS]
    for n in range(peak.NOTES):
        asked.notes[n] = 0.0
    for n in range(peak.COUNTS):
        counts[n] = 0
    asked.notes[peak.SEEN] = -1.0
    state[told.NEXT] = state[told.WINDOW] = state[told.WINDOWS] = 0
    return True


@kernel
def pays(asked: Asked, way: float) -> bool:
    """Whether the coarse bound costs less than evaluations along the whole `way` of the head, m."""
    count = asked.kinds.links.shape[0] * (way + asked.numbers[told.EXTENT]) / COARSE_CELL
    return asked.numbers[told.CELL_COST] * count < asked.links.shape[0] * way / STEP


@kernel
def window_count(asked: Asked, way: float) -> int:
    """Into how many windows so long a way, m, is parted: one if cells do not pay."""
    if not pays(asked, way):
        return 1
    links, extent = asked.kinds.links, asked.numbers[told.EXTENT]
    fits = asked.numbers[told.MOST_CELLS] / links.shape[0] * (FINEST_CELL * links[0, 0]) - extent
    return math.ceil(way / max(fits, extent))


@kernel
def next_window(asked: Asked) -> bool:
    """Go over to the next window, m, of a way without a gap, or of the next; False at the end."""
    state, figures, ways = asked.state, asked.figures, asked.drives.ways
    state[told.WINDOW] += 1
    if state[told.WINDOW] >= state[told.WINDOWS]:
        first = last = state[told.NEXT]
        if first == ways.shape[0]:
            return False
        while last + 1 < ways.shape[0] and ways[last + 1, 0] <= ways[last, 1]:
            last += 1
        figures[told.BEGIN], figures[told.END] = ways[first, 0], ways[last, 1]
        state[told.NEXT], state[told.WINDOW] = last + 1, 0
        state[told.WINDOWS] = window_count(asked, ways[last, 1] - ways[first, 0])
    n, count = state[told.WINDOW], state[told.WINDOWS]
    begin, way = figures[told.BEGIN], figures[told.END] - figures[told.BEGIN]
    figures[told.LOW] = begin + way * (n / count)
    figures[told.HIGH] = figures[told.END] if n + 1 == count else begin + way * ((n + 1) / count)
    figures[told.GAP], figures[told.CLOSED_BY], state[told.PHASE] = 0.0, 0.0, BEGUN
    return True


@kernel
def sample(asked: Asked, k: int) -> float:
    """The head's position at sample k of the window, m."""
    low, high = asked.figures[told.LOW], asked.figures[told.HIGH]
    return high if k == SAMPLES - 1 else k * ((high - low) / (SAMPLES - 1)) + low


@kernel
def position(asked: Asked, i: int, t: int) -> float:
    """The route position of handle i in slot t, m."""
    rows, row = asked.rows, asked.chains.places.row[i, t]
    return rows[row, S_START] + length_at(rows, row, asked.chains.places.u[i, t])


@kernel
def find_spans(asked: Asked) -> bool:
    """Find where benches of each kind stand, and what cells may lose; False if one falls."""
    at, places, links, numbers = asked.batch.at, asked.chains.places, asked.links, asked.numbers
    figures, spans, most = asked.figures, asked.kinds.spans, 0.0
    for k in range(SAMPLES):
        at[k] = sample(asked, k)
    if not place_chain(asked.rows, links, at, 0, SAMPLES, places):
        return False
    benches = links.shape[0]
    figures[SPENT] += SAMPLES * (benches + 1)
    for n in range(benches):
        spans[asked.group[n], 0] = position(asked, n, 0) - EDGE
        first = benches - 1 - n
        spans[asked.group[first], 1] = position(asked, first, SAMPLES - 1) + EDGE
    for i in range(benches + 1):
        for k in range(SAMPLES):
            most = max(most, places.ratio[i, k])
    # Where nobody is faster than the head nothing may be lost on the way to the tail.
    figures[told.LOSS] = (
        LEAST_LOSS if most <= 1.0 + numbers[told.ALIKE] else numbers[told.MOST_LOSS] / benches
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
    asked = memory.group_at(Asked, block + BASE)
    if not pays(asked, asked.figures[told.HIGH] - asked.figures[told.LOW]):
        return wait(block, WHOLE, 0)
    if not find_spans(asked):
        return FALLEN
    kinds, (start, longest) = asked.kinds.links.shape[0], (asked.reached[0], asked.reached[1])
    rows = 2 * math.ceil((asked.figures[told.HIGH] - start) / longest) + 1
    memory.drop(memory.integers_at(block, END_SLOT), told.CELL_MEMORY)
    address = memory.allocate(8 * rows * (4 + kinds * CELL_COLUMNS))
    if address == 0:
        return OUT_OF_MEMORY
    told.lay_cells(block, address, rows, kinds)
    asked.state[told.PHASE] = CUTTING
    return ON


@kernel
def cutting(block: int) -> int:
    """Cut the window into cells."""
    asked = memory.group_at(Asked, block + BASE)
    figures, kinds, borders = asked.figures, asked.kinds.links, asked.cells.borders.shape[0]
    longest, shortest = COARSE_CELL * kinds[0, 0], FINEST_CELL * kinds[0, 0]
    cuts = Cuts(figures[told.HIGH], longest, shortest, figures[told.LOSS])
    budget = int(asked.numbers[told.BUDGET])
    ended = cut_cells(
        asked.rows, asked.kinds, asked.shop, cuts, asked.cells, asked.reached, asked.cut, budget
    )
    figures[SPENT] += BOUNDED * budget
    if figures[SPENT] > figures[told.LEFT]:
        return given_up(asked)
    if ended == Ended.MORE:
        return MORE
    slots, columns = memory.integers_at(block, END_SLOT), kinds.shape[0] * CELL_COLUMNS
    if ended == Ended.ROOM:
        address = told.doubled(slots[memory.OWNED + told.CELL_MEMORY], borders, 4, 1, columns)
        if address == 0:
            return OUT_OF_MEMORY
        told.lay_cells(block, address, 2 * borders, kinds.shape[0])
        return ON
    for n in range(5):  # only those that were cut
        slots[told.CELLS_SLOT + 1 + 2 * n] = asked.cut[CELLS] + 1
    return wait(block, SAMPLED, 0)


@kernel
def wait(block: int, phase: int, by_cells: int) -> int:
    """Let samples of the window wait, or all of its stretches."""
    slots, asked = memory.integers_at(block, END_SLOT), memory.group_at(Asked, block + BASE)
    figures, ways, benches = asked.figures, asked.drives.ways, asked.links.shape[0]
    low, high, room = figures[told.LOW], figures[told.HIGH], SAMPLES if phase == SAMPLED else 0
    for n in range(0 if phase == SAMPLED else ways.shape[0]):
        room += 1 if ways[n, 0] <= high and ways[n, 1] >= low else 0
    room += int(asked.numbers[told.FIRST_OPEN])
    memory.drop(slots, told.HEAP_MEMORY)
    address = memory.allocate(16 * room * peak.PART_COLUMNS)
    if address == 0:
        return OUT_OF_MEMORY
    told.lay_heap(block, address, room)
    heap = memory.group_at(Asked, block + BASE).heap
    figures[told.MOST_ROWS] = room + (high - low) / (STEP * asked.kinds.links[0, 0])
    figures[told.MOST_ROWS] += asked.numbers[told.MOST_OPEN] / benches
    asked.state[told.PHASE], asked.counts[peak.OPEN] = phase, 0
    for k in range(SAMPLES if phase == SAMPLED else 0):
        at, n = sample(asked, k), 0
        while n + 1 < ways.shape[0] and ways[n, 1] < at:
            n += 1
        peak.push(heap, asked.counts, math.inf, at, at, n, benches, by_cells)
    for n in range(ways.shape[0] if phase == WHOLE else 0):
        if ways[n, 0] <= high and ways[n, 1] >= low:
            a, b = min(max(ways[n, 0], low), high), min(max(ways[n, 1], low), high)
            peak.push(heap, asked.counts, math.inf, a, b, n, benches, by_cells)
    return ON


@kernel
def sought(block: int) -> int:
    """Look through what waits until the bracket is closed, or too much waits."""
    asked = memory.group_at(Asked, block + BASE)
    figures, notes, shortest = asked.figures, asked.notes, asked.kinds.links[0, 0]
    q, room, budget = int(figures[told.QUANTITY]), asked.heap.parts.shape[0], asked.numbers[told.BUDGET]
    coarse = asked.numbers[told.COARSE_STEP] * shortest
    aim = peak.Aim(q, asked.tolerances[q], figures[told.LIMIT], coarse, STEP * shortest)
    ended = peak.seek_peak(
        asked.rows, asked.links, asked.group, asked.cells, aim, asked.drives, asked.heap, asked.batch,
        asked.chains, notes, asked.counts, int(budget),
    )  # fmt: skip
    figures[SPENT] += BOUNDED * budget
    if figures[SPENT] > figures[told.LEFT]:
        return given_up(asked)
    if ended == Ended.FALLEN:
        return FALLEN
    if ended == Ended.MORE:
        return MORE
    if ended == Ended.ROOM and room <= figures[told.MOST_ROWS]:
        before = memory.integers_at(block, END_SLOT)[memory.OWNED + told.HEAP_MEMORY]
        address = told.doubled(before, room, 1, peak.PART_COLUMNS, peak.PART_COLUMNS)
        if address == 0:
            return OUT_OF_MEMORY
        told.lay_heap(block, address, 2 * room)
        return ON
    for n in range(asked.counts[peak.OPEN]):
        notes[peak.UPPER] = max(notes[peak.UPPER], asked.heap.parts[n, peak.BOUND])
    if asked.state[told.PHASE] == SAMPLED:
        return wait(block, WHOLE, 1)
    if next_window(asked):
        return MORE
    settle(asked)
    return MORE if next_quantity(asked) and next_window(asked) else DONE


@kernel
def given_up(asked: Asked) -> int:
    """Leave a bracket open that takes too much work; MORE where nothing is seen: the host says so."""
    if asked.notes[peak.SEEN] < 0.0:
        return MORE
    asked.notes[peak.UPPER], asked.figures[told.GIVEN_UP] = math.inf, 1.0
    settle(asked)
    return DONE


@kernel
def head_speed(quantity: int, limit: float, most: float) -> float:
    """The head speed, m/s, at which a quantity keeps its limit that is so great at 1 m/s."""
    if most <= 0.0:
        return math.inf
    return limit / most if quantity in (SPEEDS, TURNING) else math.sqrt(limit / most)


@kernel
def settle(asked: Asked) -> None:
    """Tell what the search of a quantity found; of a head speed only if its limit is exceeded there."""
    figures, notes, q = asked.figures, asked.notes, int(asked.figures[told.QUANTITY])
    asked.state[told.SOUGHT] += 1
    most = max(notes[peak.UPPER], notes[peak.SEEN])
    if asked.numbers[told.HEAD] > 0.0:
        if most <= figures[told.LIMIT]:
            return
        figures[told.LOWER] = head_speed(q, asked.limits[q], most)
        exceeds = head_speed(q, asked.limits[q], notes[peak.SURE] / (1.0 + SPEED_ROUNDING))
        if exceeds >= figures[told.HIGHER] and figures[told.DECIDES] >= 0.0:
            return
        figures[told.HIGHER], figures[told.DECIDES] = exceeds, q
    figures[told.VALUE], figures[told.LEAST] = notes[peak.SEEN], notes[peak.SURE]
    figures[told.MOST] = most
    figures[told.AT], figures[told.STRETCH] = notes[peak.WHERE], asked.counts[peak.WHEN]
    places, row, fast = asked.chains.places, asked.counts[peak.ROW], 0.0
    asked.batch.at[0] = notes[peak.WHERE]
    place_chain(asked.rows, asked.links, asked.batch.at, 0, 1, places)
    if q == SPEEDS:  # the first that comes to it but for rounding: on one arc all are equally fast
        for i in range(places.ratio.shape[0]):
            fast = max(fast, places.ratio[i, 0])
        row = 0
        while places.ratio[row, 0] < fast * (1.0 - asked.numbers[told.ALIKE]):
            row += 1
    figures[told.HANDLE], figures[told.X], figures[told.Y] = row, places.x[row, 0], places.y[row, 0]


@kernel
def tell(asked: Asked, all_done: bool) -> None:
    """Tell how far the question is: how narrow brackets are, of the first to the tolerance."""
    figures, ways, q = asked.figures, asked.drives.ways, int(asked.figures[told.QUANTITY])
    figures[told.PLACED] = asked.state[told.BEFORE] + asked.counts[peak.EVALUATIONS]
    lower, whole = asked.notes[peak.SEEN], ways[ways.shape[0] - 1, 1] - ways[0, 0]
    if lower > 0.0 and asked.counts[peak.OPEN] > 0 and asked.state[told.PHASE] == WHOLE:
        gap = asked.heap.parts[0, peak.BOUND] / lower - 1.0
        if asked.tolerances[q] < gap < math.inf:
            gap = math.log(gap / asked.tolerances[q])
            figures[told.GAP] = figures[told.GAP] if figures[told.GAP] > 0.0 else gap
            figures[told.CLOSED_BY] = max(figures[told.CLOSED_BY], 1.0 - gap / figures[told.GAP])
    window = figures[told.HIGH] - figures[told.LOW]
    done = figures[told.LOW] - ways[0, 0] + figures[told.CLOSED_BY] * window
    done = asked.state[told.SOUGHT] + (done / whole if whole > 0.0 else 0.0)
    share = 1.0 if all_done else done / asked.state[told.ALL]
    figures[told.SHARE] = max(figures[told.SHARE], share)


@entry
def step_peak(handle: int, left: float) -> int:
    """Go on for some hundredths of a second; MORE, or how that ended.

    `left`: so many handles may be placed; where more are, what was seen is told, with no upper end.
    """
    block = memory.recall(handle)
    if block == 0:
        return CLOSED
    asked = memory.group_at(Asked, block + BASE)
    asked.figures[SPENT], asked.figures[told.LEFT], ending = 0.0, left, ON
    while ending == ON:
        phase = asked.state[told.PHASE]
        ending = (
            begun(block) if phase == BEGUN else cutting(block) if phase == CUTTING else sought(block)
        )
    if ending in (MORE, DONE):
        tell(memory.group_at(Asked, block + BASE), ending == DONE)
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
        return CLOSED
    asked, parts = memory.group_at(Asked, block + BASE), (at.shape[0] - 1) // most.shape[0]
    batch, chains = asked.batch, asked.chains
    batch.drive[FROM], batch.drive[TO], batch.drive[RATE] = 1.0, 1.0, 0.0
    chains.scratch.beside[0] = chains.scratch.beside[1] = 0.0
    for n in range(first, last):
        for k in range(parts + 1):
            batch.at[k] = at[n * parts + k]
        if not place_chain(asked.rows, asked.links, batch.at, 0, parts + 1, chains.places):
            return FALLEN
        find_hull(
            asked.rows, asked.links, chains.places, parts, batch.drive, chains.scratch, asked.hull
        )
        most[n] = tabulate(asked.hull, limits, square, table[n])
    return DONE
