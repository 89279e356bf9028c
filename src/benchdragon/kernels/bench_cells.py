"""What benches do in cells of the route, whatever the time, and bounds from it for steps of the head.

What a bench does, per metre of its front handle's way, depends on its link and on where that handle
stands, and on nothing else. Bounds on it are found once for each cell of the route and each link. Going
from cell to cell down a chain, they then bound all of its handles over a long step of the head, and no
chain is placed. That is looser than a chain's own bounds, but far cheaper, and shows where a greatest
value cannot be (design/coarse_bound.py).
"""

import math
from typing import NamedTuple

from benchdragon.kernels import motion_bounds
from benchdragon.kernels.arrays import IntVector, Stack, Table, Vector
from benchdragon.kernels.chain import Placements, place_head, place_next, rates_in_slot
from benchdragon.kernels.curve import FloatArray, RouteRow, length_at, place
from benchdragon.kernels.drive import DriveRate, most_of_handle
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.motion_bounds import (
    HandleBound,
    bound_handles,
    curvature_range,
    magnitude,
    scaled,
)
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.rate_rounding import Errors, bend_errors, rate_errors
from benchdragon.kernels.rounding import ratio_errors
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.status import Ended, Status
from benchdragon.kernels.swept_boxes import EDGE


class Cell(Numbered):
    """Columns of what a bench does while its front handle walks through a cell."""

    REAR = 0  # route position of its rear handle at the cell's start, m
    SLOW = 1  # least ratio of speeds, rear handle over front handle
    FAST = 2  # greatest
    FADE = 3  # least d log(ratio) per metre of the front handle's way, 1/m
    GROW = 4  # greatest
    SWAY = 5  # greatest turning rate, rad/m


CELL_COLUMNS = len(Cell)
# Of these, ratios are as they were computed; exact ones may be more by the share `off` of the cells.

# After so many cells of one length cells of twice that are tried next.
STEADY = 8


class CutMeasure(Numbered):
    """Where cutting is resumed: the route position, and the length of cells there, m."""

    AT, WIDTH = 0, 1


class CutCount(Numbered):
    """Where cutting is resumed: the number of cells so far, and of those of that length."""

    CELLS, RUN = 0, 1


class Cells(NamedTuple):
    """Cells of the route, from border to border."""

    borders: Vector  # route positions, m, ascending, (cells + 1,)
    bends: Vector  # greatest size of the route's curvature, 1/m, (cells + 1,): the last has none
    fastest: Vector  # greatest ratio of benches that come there, in this cell or any before
    off: Vector  # error bound of such a ratio, as a share, in this cell or any before
    benches: Stack  # what benches of each kind do there, (cells + 1, kinds, CELL_COLUMNS)


class CellKinds(NamedTuple):
    """The links of a dragon, each once."""

    links: Table  # m, (kinds, 1)
    spans: Table  # range of positions of its benches' front handles, m, (kinds, 2)


class Workshop(NamedTuple):
    """The scratch of making cells: slot g holds a bench of kind g at a cell's start.

    The slot behind the last kind holds the front handle alone; as many slots follow for its end.
    """

    places: Placements
    bounds: Table  # (2, HANDLE_COLUMNS)
    rears: Vector  # route positions of the rear handles in all slots, m; NaN where one cannot stand
    held: IntVector  # whether benches of each kind come through the cell
    change: Table  # of `chain.rates`, (2, slots) either
    turn: Table
    errors: Errors


class Cuts(NamedTuple):
    """How to cut: the way's end, the longest and the shortest cells, m.

    A cell is made shorter while the greatest ratio in it is above 1, and by more than a share of `loss`
    above those at its ends.
    """

    end: float
    longest: float
    shortest: float
    loss: float


@kernel
def place_front(rows: FloatArray, s: float, t: int, places: Placements) -> None:
    """Place the front handle of any bench at route position s, m, in slot t."""
    places.failed[0, t] = place_head(rows, s, t, places)
    _, _, places.tx[0, t], places.ty[0, t] = place(rows, places.row[0, t], places.u[0, t])


@kernel
def place_bench(rows: FloatArray, link: FloatArray, front: int, t: int, shop: Workshop) -> None:
    """Place a bench, whose link is (1,), in slot t, its front handle being in slot `front`."""
    places, rears = shop.places, shop.rears
    row, u, x, y, ratio = places.row, places.u, places.x, places.y, places.ratio
    row[0, t], u[0, t], x[0, t], y[0, t] = row[0, front], u[0, front], x[0, front], y[0, front]
    ratio[0, t], places.tx[0, t], places.ty[0, t] = 1.0, places.tx[0, front], places.ty[0, front]
    places.failed[0, t], rears[t] = places.failed[0, front], math.nan
    if places.failed[0, t] == Status.OK:
        places.failed[0, t] = place_next(rows, link[0], 0, t, places)
    if places.failed[0, t] == Status.OK:
        _, _, places.tx[1, t], places.ty[1, t] = place(rows, row[1, t], u[1, t])
        rears[t] = rows[row[1, t], RouteRow.S_START] + length_at(rows, row[1, t], u[1, t])
        weigh_bench(rows, link, t, shop)


@kernel
def weigh_bench(rows: FloatArray, link: FloatArray, t: int, shop: Workshop) -> None:
    """Bound the rounding errors in slot t, where a bench stands."""
    places, errors = shop.places, shop.errors
    ratio_errors(rows, link, errors.seams, places, errors.lanes, t, errors.along, errors.ratio)
    rates_in_slot(
        rows, link, t, places.row, places.u, places.x, places.y, places.ratio, shop.change, shop.turn
    )
    bend_errors(rows, places, t, 1, errors)
    rate_errors(rows, link, places, shop.change, shop.turn, t, errors)


@kernel
def place_border(rows: FloatArray, links: FloatArray, shop: Workshop, s: float, end: int) -> None:
    """Place benches of the kinds that are held, front handles at s, m: at end 0 or 1 of a cell."""
    kinds = links.shape[0]
    first = end * (kinds + 1)
    place_front(rows, s, first + kinds, shop.places)
    for g in range(kinds):
        if shop.held[g] > 0:
            place_bench(rows, links[g], first + kinds, first + g, shop)


@kernel
def move_on(shop: Workshop, kinds: int) -> None:
    """Make the cell's end the start of the next."""
    places, errors = shop.places, shop.errors
    for g in range(kinds + 1):
        t = g + kinds + 1
        for i in range(2):
            places.row[i, g], places.u[i, g] = places.row[i, t], places.u[i, t]
            places.x[i, g], places.y[i, g] = places.x[i, t], places.y[i, t]
            places.tx[i, g], places.ty[i, g] = places.tx[i, t], places.ty[i, t]
            places.ratio[i, g] = places.ratio[i, t]
        places.failed[0, g], shop.rears[g] = places.failed[0, t], shop.rears[t]
        errors.ratio[1, g], errors.turn[0, g] = errors.ratio[1, t], errors.turn[0, t]
        errors.change[1, g], shop.change[1, g] = errors.change[1, t], shop.change[1, t]


@kernel
def leave_open(benches: FloatArray, c: int, g: int) -> None:
    """Record that nothing bounds benches of kind g in cell c."""
    benches[c, g, Cell.SLOW], benches[c, g, Cell.FADE] = 0.0, -math.inf
    benches[c, g, Cell.FAST] = benches[c, g, Cell.GROW] = benches[c, g, Cell.SWAY] = math.inf


@kernel
def growth_error(shop: Workshop, t: int) -> float:
    """The error bound of d log(ratio) of the bench in slot t, 1/m."""
    change, errors = abs(shop.change[1, t]), shop.errors
    return (errors.change[1, t] + change * errors.ratio[1, t]) / shop.places.ratio[1, t]


@kernel
def bound_kind(
    rows: FloatArray, links: FloatArray, shop: Workshop, loss: float, cells: Cells, c: int, g: int
) -> bool:
    """Fill cell c with what benches of kind g do in it; whether a shorter cell gives tighter bounds."""
    places, bounds, rears, benches = shop.places, shop.bounds, shop.rears, cells.benches
    errors = shop.errors
    a, b = g, g + links.shape[0] + 1
    benches[c, g, Cell.REAR], benches[c + 1, g, Cell.REAR] = rears[a], rears[b]
    if places.failed[0, a] != Status.OK or places.failed[0, b] != Status.OK:
        return True
    bound_handles(rows, links[g], places, a, b, bounds)
    fast = bounds[1, HandleBound.SPEED]
    benches[c, g, Cell.SLOW], benches[c, g, Cell.FAST] = bounds[1, HandleBound.SLOWEST], fast
    off = max(growth_error(shop, a), growth_error(shop, b))
    benches[c, g, Cell.FADE] = bounds[1, HandleBound.GROWTH_LOW] - off
    benches[c, g, Cell.GROW] = bounds[1, HandleBound.GROWTH_HIGH] + off
    sway = max(errors.turn[0, a], errors.turn[0, b])
    benches[c, g, Cell.SWAY] = bounds[1, HandleBound.TURNING_RATE] + sway
    cells.off[c] = max(cells.off[c], errors.ratio[1, a], errors.ratio[1, b])
    return fast > max(1.0, max(places.ratio[1, a], places.ratio[1, b]) * (1.0 + loss))


@kernel
def bound_cell(
    rows: FloatArray, links: FloatArray, shop: Workshop, loss: float, cells: Cells, c: int
) -> bool:
    """Fill cell c, between the borders that benches are placed at; whether shorter ones are tighter."""
    places, kinds, finer = shop.places, links.shape[0], False
    a, b = kinds, 2 * kinds + 1
    low, high = curvature_range(
        rows, places.row[0, a], places.u[0, a], places.row[0, b], places.u[0, b]
    )
    cells.bends[c] = magnitude(low, high)
    cells.fastest[c], cells.off[c] = 0.0, 0.0
    if c > 0:
        cells.fastest[c], cells.off[c] = cells.fastest[c - 1], cells.off[c - 1]
    for g in range(kinds):
        leave_open(cells.benches, c, g)
        if shop.held[g] > 0:
            finer = bound_kind(rows, links, shop, loss, cells, c, g) or finer
            cells.fastest[c] = max(cells.fastest[c], cells.benches[c, g, Cell.FAST])
    return finer


@kernel
def hold(rows: FloatArray, kinds: CellKinds, shop: Workshop, s: float, longest: float) -> None:
    """Hold the kinds that come through the next cell, from s, m, on; place those that are new."""
    count = kinds.links.shape[0]
    for g in range(count):
        wanted = kinds.spans[g, 0] <= s + longest and kinds.spans[g, 1] >= s
        if wanted and shop.held[g] == 0:
            place_bench(rows, kinds.links[g], count, g, shop)
        shop.held[g] = 1 if wanted else 0


@kernel
def cut_cells(
    rows: Table, kinds: CellKinds, shop: Workshop, cuts: Cuts, cells: Cells, reached: Vector,
    done: IntVector, budget: int,
) -> Ended:  # fmt: skip
    """Cut the route from reached[AT], m, into cells.

    `reached` and `done` record the progress; before the first call done is 0 and the cells begin at
    reached[AT]. Call it again, after MORE (so many cells as `budget` were made) as it is, after ROOM
    with larger cells.
    """
    first, links = done[CutCount.CELLS], kinds.links
    if first == 0:
        place_border(rows, links, shop, reached[CutMeasure.AT], 0)
        cells.borders[0] = reached[CutMeasure.AT]
    while reached[CutMeasure.AT] < cuts.end:
        c, s = done[CutCount.CELLS], reached[CutMeasure.AT]
        if c + 1 >= cells.borders.shape[0]:
            return Ended.ROOM
        if c - first >= budget:
            return Ended.MORE
        hold(rows, kinds, shop, s, cuts.longest)
        cells.borders[c + 1] = min(s + reached[CutMeasure.WIDTH], cuts.end)
        place_border(rows, links, shop, cells.borders[c + 1], 1)
        if (
            bound_cell(rows, links, shop, cuts.loss, cells, c)
            and reached[CutMeasure.WIDTH] > cuts.shortest
        ):
            reached[CutMeasure.WIDTH], done[CutCount.RUN] = 0.5 * reached[CutMeasure.WIDTH], 0
            continue
        move_on(shop, links.shape[0])
        reached[CutMeasure.AT], done[CutCount.CELLS], done[CutCount.RUN] = (
            cells.borders[c + 1],
            c + 1,
            done[CutCount.RUN] + 1,
        )
        if done[CutCount.RUN] >= STEADY and 2.0 * reached[CutMeasure.WIDTH] <= cuts.longest:
            reached[CutMeasure.WIDTH], done[CutCount.RUN] = 2.0 * reached[CutMeasure.WIDTH], 0
    return Ended.DONE


@kernel
def rear_range(
    benches: FloatArray, borders: FloatArray, g: int, ca: int, cb: int, low: float, high: float
) -> tuple[float, float]:
    """The positions, m, between which rear handles stand while the front ones stand in low..high.

    Those lie in cells ca and cb. Between two borders a rear handle is no faster and no slower than the
    bounds of the cell.
    """
    ahead, left = low - borders[ca], borders[ca + 1] - low
    back = max(
        benches[ca, g, Cell.REAR] + benches[ca, g, Cell.SLOW] * ahead,
        benches[ca + 1, g, Cell.REAR] - benches[ca, g, Cell.FAST] * left,
    )
    ahead, left = high - borders[cb], borders[cb + 1] - high
    front = min(
        benches[cb, g, Cell.REAR] + benches[cb, g, Cell.FAST] * ahead,
        benches[cb + 1, g, Cell.REAR] - benches[cb, g, Cell.SLOW] * left,
    )
    return back - EDGE, front + EDGE


@kernel
def cell_at(borders: FloatArray, s: float, cell: int) -> int:
    """The cell that holds position s, m, from `cell` on back; the first for what lies before."""
    while cell > 0 and borders[cell] > s:
        cell -= 1
    return cell


@kernel
def cell_of(borders: FloatArray, s: float) -> int:
    """The last cell that begins at position s, m, or before; the first if none does."""
    low, high = 0, borders.shape[0] - 2
    while low < high:
        middle = (low + high + 1) // 2
        if borders[middle] <= s:
            low = middle
        else:
            high = middle - 1
    return low


@kernel
def bench_in_cells(
    benches: FloatArray, g: int, ca: int, cb: int
) -> tuple[float, float, float, float, float]:
    """SLOW, FAST, FADE, GROW and SWAY of a bench of kind g anywhere in cells ca..cb."""
    slow, fast, sway = benches[ca, g, Cell.SLOW], benches[ca, g, Cell.FAST], benches[ca, g, Cell.SWAY]
    fade, grow = benches[ca, g, Cell.FADE], benches[ca, g, Cell.GROW]
    for c in range(ca + 1, cb + 1):
        slow, fast = min(slow, benches[c, g, Cell.SLOW]), max(fast, benches[c, g, Cell.FAST])
        fade, grow = min(fade, benches[c, g, Cell.FADE]), max(grow, benches[c, g, Cell.GROW])
        sway = max(sway, benches[c, g, Cell.SWAY])
    return slow, fast, fade, grow, sway


@kernel
def greatest_fast(benches: FloatArray, g: int, ca: int, cb: int) -> float:
    """FAST of a bench of kind g anywhere in cells ca..cb."""
    fast = benches[ca, g, Cell.FAST]
    for c in range(ca + 1, cb + 1):
        fast = max(fast, benches[c, g, Cell.FAST])
    return fast


@kernel
def greatest_bend(bends: FloatArray, ca: int, cb: int) -> float:
    """The greatest size of the curvature in cells ca..cb, 1/m."""
    bend = bends[ca]
    for c in range(ca + 1, cb + 1):
        bend = max(bend, bends[c])
    return bend


@kernel
def rates_in_cells(
    benches: FloatArray, k: int, ca: int, cb: int, quantity: int
) -> tuple[float, float, float, float, float]:
    """As `bench_in_cells`; only the second number is filled where a quantity needs no other."""
    if quantity in (DriveRate.SPEEDS, DriveRate.ACROSS):
        return 0.0, greatest_fast(benches, k, ca, cb), 0.0, 0.0, 0.0
    return bench_in_cells(benches, k, ca, cb)


@kernel
def bound_by_cells(
    cells: Cells, group: IntArray, links: int, low: float, high: float, drive: FloatArray,
    quantity: int, enough: float,
) -> tuple[float, float, int]:  # fmt: skip
    """Bound a quantity of the first `links` + 1 handles while the head walks from low to high, m.

    Benches are of the kinds `group`. Returns the bound, that on handles that cannot exceed `enough`,
    and the last handle that may, -1 if there is none. A bench's quantity counts at its rear handle.
    """
    borders, benches = cells.borders, cells.benches
    ca, cb = cell_of(borders, low), cell_of(borders, high)
    slowest, fastest, fade, grow = 1.0, 1.0, 0.0, 0.0
    most, settled, last, swayed = 0.0, 0.0, -1, 0.0
    # By what share rounding may have hidden more of each ratio. Speeds are compared as computed and
    # widened afterwards; for the rest each ratio is widened at once.
    off = cells.off[cb]
    wider = 0.0 if quantity == DriveRate.SPEEDS else off
    for i in range(links + 1):
        bend = 0.0
        if quantity in (DriveRate.ACROSS, DriveRate.TOTAL):
            bend = greatest_bend(cells.bends, ca, cb)
        size = swayed if quantity == DriveRate.TURNING else fastest
        bound = motion_bounds.ROUNDED_UP * most_of_handle(size, fade, grow, bend, drive, quantity)
        calm = quantity == DriveRate.SPEEDS and bound <= enough and cells.fastest[cb] <= 1.0
        beyond = off * (links if calm else i) if quantity == DriveRate.SPEEDS else 0.0
        exactly = bound * (1.0 + beyond)
        most = max(most, exactly)
        if bound > enough:
            last = i
        else:
            settled = max(settled, exactly)
        if i == links or calm:  # where all is calm, no handle is faster than the one before
            break
        slow, fast, least, greatest, sway = rates_in_cells(benches, group[i], ca, cb, quantity)
        if not fast < math.inf:
            return math.inf, settled, links
        low, high = rear_range(benches, borders, group[i], ca, cb, low, high)
        ca, cb = cell_at(borders, low, ca), cell_at(borders, high, cb)
        least, greatest = scaled(slowest, fastest, least, greatest)
        fade, grow, swayed = fade + least, grow + greatest, fastest * sway
        slowest, fastest = slowest * slow * (1.0 - wider), fastest * fast * (1.0 + wider)
    return most, settled, last
