"""The walks of a plan in which one size varies: route, benches and the head's way for each value of it.

Routes are what few numbers describe: a spiral to a disc, a turn of a family, or fixed parts.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import curve, route_parts
from benchdragon.kernels import turn_families as families
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.box import LONGEST_BENCH, SHORTEST_LINK
from benchdragon.kernels.box_hierarchy import Kinds
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow, spiral_length
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.links import link_of
from benchdragon.kernels.local_minima import head_where_tail
from benchdragon.kernels.memory import ROW, Shapes, copy_row, copy_table
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.route_parts import Pose, RoutePart, farthest, lay_rows, row_count
from benchdragon.kernels.status import TurnStatus
from benchdragon.kernels.turn_families import TurnPiece, three_pieces, turn_parts, two_arcs
from benchdragon.kernels.workspace import Benches, Walk


class Varied(Numbered):
    """The size that varies."""

    PITCH, DISC, WIDTH, BENCH = range(4)


class RouteKind(Numbered):
    """Kinds of routes: parts that stay, in along one spiral, in and out with a turn between."""

    FIXED, SPIRAL_IN, TURN = range(3)


class TurnKind(Numbered):
    """Families of turns."""

    ARC_ARC, THREE_PIECES = 0, 1


class PlanNumber(Numbered):
    """The numbers of a plan that its walks are made from; NaN for those that it leaves out."""

    WHAT = 0
    ROUTE = 1
    PITCH_SIZE = 2  # m
    DISC_RADIUS = 3  # m
    START_TURN = 4
    HANDED = 5  # +1, or -1 if mirrored
    TURN_FAMILY = 6
    ENTRY_RADIUS = 7  # m
    EXIT_RADIUS = 8
    RATIO = 9
    FIRST_RADIUS = 10  # of the arcs, m
    LAST_RADIUS = 11
    BEND = 12  # 1/m
    EASE = 13  # m
    POSITION = 14  # of the head at time 0, m
    BEGIN_WAY = 15  # the head's way from time 0 to the start of the walk, m
    END_WAY = 16  # and to its end
    MOST_WAY = 17  # its greatest way from time 0
    LEAST_SIZE = 18  # values of what varies that a plan may have, m
    MOST_SIZE = 19
    ROOMY = 20  # arcs that a plan leaves out have this share of the radius of two equal ones
    FITS = 21  # how far beyond its disc a turn may reach, m


PLAN_NUMBERS = len(PlanNumber)

# The head's way between the searched part and a failure, m, beyond which another event may come first.
UNKNOWN = 1e-6


class Family(NamedTuple):
    """A plan in which one size varies; `parts`, `arcs` and `pieces` are scratch."""

    numbers: Vector
    parts: Table  # (route_parts.., PART_COLUMNS); of a fixed route its own
    arcs: Table  # (ARCS, 2)
    pieces: Table  # (MOST_PIECES, 3)
    sizes: Table  # of the plan's benches, (4, benches)
    share: Vector  # 1 for each bench whose size varies, else 0, (benches,)


@kernel
def family_shapes(family: Family) -> Shapes:
    """The shapes of a family's arrays, to lay them out."""
    parts, arcs, pieces = family.parts.shape, family.arcs.shape, family.pieces.shape
    benches = family.share.shape[0]
    return (family.numbers.shape[0], ROW), parts, arcs, pieces, (4, benches), (benches, ROW)


@kernel
def copy_family(own: Family, family: Family) -> None:
    """Copy a family without its scratch."""
    copy_row(own.numbers, family.numbers)
    copy_table(own.parts, family.parts)
    copy_table(own.sizes, family.sizes)
    copy_row(own.share, family.share)


class Way(NamedTuple):
    """A walk of a family: the rows that its route fills, and where its head begins and ends, m.

    Without such a walk there are 0 rows; a negative number means that so many rows are needed.
    """

    rows: int
    first: float
    last: float


@kernel
def varied(numbers: FloatArray, what: int, column: int, size: float) -> float:
    """A number of the plan, or `size` if it is what varies."""
    return size if numbers[PlanNumber.WHAT] == what else numbers[column]


@kernel
def size_benches(family: Family, benches: Benches, kinds: Kinds, size: float) -> bool:
    """Fill the benches for a size; whether such benches are possible."""
    what, sizes, lever, ahead, sound = family.numbers[PlanNumber.WHAT], benches.sizes, 0.0, 0.0, True
    for i in range(benches.kind.shape[0]):
        for n in range(4):
            sizes[n, i] = family.sizes[n, i]
        if family.share[i] > 0.0:
            sizes[1 if what == Varied.WIDTH else 0, i] = size
        link = link_of(sizes, i)
        sound = sound and link >= SHORTEST_LINK and max(sizes[0, i], sizes[1, i]) <= LONGEST_BENCH
        benches.links[i], benches.ahead[i] = link, ahead
        ahead += link
        lever = max(lever, 1.0 + (2.0 * max(sizes[2, i], sizes[3, i]) + sizes[1, i]) / link)
        for n in range(4):
            kinds.sizes[n, benches.kind[i]] = sizes[n, i]
    benches.lever[0] = lever
    return sound


@kernel
def lay_spiral(family: Family, rows: FloatArray, size: float) -> int:
    """Fill the row of a spiral in to the disc, or to the centre; returns the number of rows, 0 or 1."""
    numbers, part = family.numbers, family.parts[:1]
    pitch = varied(numbers, Varied.PITCH, PlanNumber.PITCH_SIZE, size)
    disc = varied(numbers, Varied.DISC, PlanNumber.DISC_RADIUS, size)
    k, start = pitch / (2.0 * math.pi), 2.0 * math.pi * numbers[PlanNumber.START_TURN]
    end = disc / k if disc == disc else 0.0
    if end >= start or max(start * k, spiral_length(k, start)) > curve.MOST_METRES:
        return 0
    for column in range(route_parts.PART_COLUMNS):
        part[0, column] = 0.0
    part[0, RoutePart.KIND], part[0, RoutePart.SIZE] = CurveKind.SPIRAL, pitch
    part[0, RoutePart.HAND] = numbers[PlanNumber.HANDED]
    part[0, RoutePart.FIRST], part[0, RoutePart.LAST] = start, end
    lay_rows(part, Pose(0.0, 0.0, 0.0), 0, 0, rows[:1])
    return 1


@kernel
def greatest_bend(pieces: FloatArray, count: int) -> float:
    """The greatest curvature of the first pieces of a turn, 1/m."""
    most = 0.0
    for n in range(count):
        most = max(most, abs(pieces[n, TurnPiece.START]), abs(pieces[n, TurnPiece.END]))
    return most


@kernel
def turn_pieces(family: Family, pitch: float, disc: float, entry: float, leave: float) -> int:
    """Fill the pieces of the turn; returns their number, 0 if there is no such turn."""
    numbers, arcs, pieces = family.numbers, family.arcs, family.pieces
    if numbers[PlanNumber.TURN_FAMILY] == TurnKind.ARC_ARC:
        count, status = two_arcs(
            pitch, entry, leave, numbers[PlanNumber.RATIO], numbers[PlanNumber.EASE], arcs, pieces
        )
        return count if status == TurnStatus.OK else 0
    first, last = numbers[PlanNumber.FIRST_RADIUS], numbers[PlanNumber.LAST_RADIUS]
    if first != first:
        count, status = two_arcs(pitch, entry, leave, 1.0, 0.0, arcs, pieces)
        if status != TurnStatus.OK:
            return 0
        first = last = numbers[PlanNumber.ROOMY] * min(1.0 / greatest_bend(pieces, count), 0.5 * disc)
    count, status = three_pieces(
        pitch,
        entry,
        leave,
        first,
        numbers[PlanNumber.BEND],
        last,
        numbers[PlanNumber.EASE],
        arcs,
        pieces,
    )
    return count if status == TurnStatus.OK else 0


@kernel
def pieces_fit(pieces: FloatArray, count: int, link: float) -> bool:
    """Whether there may be curves like these pieces, and a bench of this link can follow them."""
    for n in range(count):
        bend = max(abs(pieces[n, TurnPiece.START]), abs(pieces[n, TurnPiece.END]))
        if not pieces[n, TurnPiece.LENGTH] * bend <= curve.MOST_TURN:
            return False
    return link * greatest_bend(pieces, count) < 2.0


@kernel
def lay_turn(family: Family, links: FloatArray, rows: FloatArray, size: float) -> int:
    """Fill the rows of a turn between spirals; how many, 0 for no such turn, -n if n are needed."""
    numbers, longest, whole = family.numbers, 0.0, 0.0
    for i in range(links.shape[0]):
        longest, whole = max(longest, links[i]), whole + links[i]
    pitch = varied(numbers, Varied.PITCH, PlanNumber.PITCH_SIZE, size)
    disc = varied(numbers, Varied.DISC, PlanNumber.DISC_RADIUS, size)
    entry, leave = numbers[PlanNumber.ENTRY_RADIUS], numbers[PlanNumber.EXIT_RADIUS]
    entry = entry if entry == entry else disc
    leave = leave if leave == leave else entry
    if max(entry, leave) > disc:
        return 0
    count = turn_pieces(family, pitch, disc, entry, leave)
    if count == 0 or not pieces_fit(family.pieces, count, longest):
        return 0
    parts = family.parts[: count + 2]
    turn_parts(pitch, entry, leave, families.LEAD, families.TRAIL + whole, family.pieces[:count], parts)
    wanted = row_count(parts)
    if wanted > rows.shape[0]:
        return -wanted
    laid = rows[:wanted]
    lay_rows(parts, Pose(0.0, 0.0, 0.0), 1, count + 1, laid)
    reach = farthest(
        laid, laid[1, RouteRow.S_START], laid[wanted - 1, RouteRow.S_START], families.REACH_LOOK
    )
    return wanted if reach <= disc + numbers[PlanNumber.FITS] else 0


@kernel
def set_walk(family: Family, walk: Walk, at: Vector, places: Placements, size: float) -> Way:
    """Let `walk` be that of a size, m: its benches and rows are filled; see `Way`.

    `at` and `places` are scratch, of all handles and one slot. A fixed route's rows stay.
    """
    numbers, nowhere = family.numbers, Way(0, math.nan, math.nan)
    if not numbers[PlanNumber.LEAST_SIZE] <= size <= numbers[PlanNumber.MOST_SIZE]:
        return nowhere
    if not size_benches(family, walk.benches, walk.kinds, size):
        return nowhere
    rows, count = walk.rows, walk.rows.shape[0]
    if numbers[PlanNumber.ROUTE] == RouteKind.SPIRAL_IN:
        count = lay_spiral(family, rows, size)
    elif numbers[PlanNumber.ROUTE] == RouteKind.TURN:
        count = lay_turn(family, walk.benches.links, rows, size)
    if count <= 0:
        return Way(count, math.nan, math.nan)
    joint = rows[1, RouteRow.S_START] if numbers[PlanNumber.ROUTE] == RouteKind.TURN else 0.0
    start = (
        numbers[PlanNumber.POSITION]
        if numbers[PlanNumber.POSITION] == numbers[PlanNumber.POSITION]
        else joint
    )
    first, last = start + numbers[PlanNumber.BEGIN_WAY], start + numbers[PlanNumber.END_WAY]
    if last != last:  # by the kind of route
        last = rows[count - 1, RouteRow.S_START] + rows[count - 1, RouteRow.LENGTH]
        if numbers[PlanNumber.ROUTE] == RouteKind.TURN:
            out = rows[count - 1, RouteRow.S_START]
            last = head_where_tail(rows[:count], walk.benches.links, out, at, places)
        if last - start > numbers[PlanNumber.MOST_WAY]:
            return nowhere
    return Way(count, first, last) if first <= last else nowhere


@kernel
def falls_soon(rows: Table, links: Vector, sound: float, at: Vector, places: Placements) -> bool:
    """Whether a dragon cannot stand within some micrometres past head position `sound`, m.

    `at` and `places` are scratch, of all handles and one slot.
    """
    last = rows.shape[0] - 1
    length = rows[last, RouteRow.S_START] + rows[last, RouteRow.LENGTH]
    if sound + 2.0 * UNKNOWN > length + END_SLACK:
        return True
    for n in range(5):
        at[0] = min(sound + 0.5 * n * UNKNOWN, length)
        if not place_chain(rows, links, at, 0, 1, places):
            return True
    return False
