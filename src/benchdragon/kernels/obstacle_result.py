"""Results of a search beside an obstacle by the head's position, and how the bench then stands."""

import math

from benchdragon.kernels.box import Box, corner, place_box
from benchdragon.kernels.chain import march
from benchdragon.kernels.continuation import UNIT
from benchdragon.kernels.curve import CurveKind, RouteRow, length_at
from benchdragon.kernels.double_double import head_drift
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.memory import copy_row
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.nearness import Closest, corner_feature, nearness
from benchdragon.kernels.obstacle import ObstacleKind, forbids
from benchdragon.kernels.obstacle_contact import centre_distance, distances_to
from benchdragon.kernels.obstacle_memory import Beside, ObstacleFound, ObstacleGiven, ObstacleTold
from benchdragon.kernels.question import Told
from benchdragon.kernels.rounding import HALF_UNIT, handle_errors, mark_lanes
from benchdragon.kernels.status import Status

# Roundings of a route position, of the lengths that it is counted by.
COUNTED = 24.0
# Newton steps for the head position at which a handle comes to a place; about five are needed.
MOST_PLACE_STEPS = 100


@kernel
def put(beside: Beside, n: int, low: float, high: float, bench: float, sure: bool) -> None:
    """Fill row n of the results."""
    row = beside.found[n]
    row[ObstacleFound.LOW_END] = low
    row[ObstacleFound.HIGH_END] = high
    row[ObstacleFound.HEAD] = high
    row[ObstacleFound.WHO] = bench
    row[ObstacleFound.SURE] = 1.0 if sure else 0.0


@kernel
def last_handle(beside: Beside, bench: int, head: float) -> tuple[float, float]:
    """Position of a bench's front handle, m, and its speed over the head's, with the head at a place.

    NaN where the bench cannot stand.
    """
    rows, chain = beside.bench.rows, beside.chain
    beside.at[0] = head
    beside.figures[Told.SPENT] += bench + 1.0
    march(rows, beside.links[:bench], beside.at, 0, 1, chain)
    if chain.failed[0, 0] != Status.OK:
        return math.nan, math.nan
    j = chain.row[bench, 0]
    return rows[j, RouteRow.S_START] + length_at(rows, j, chain.u[bench, 0]), chain.ratio[bench, 0]


@kernel
def head_between(beside: Beside, bench: int, lower: float, upper: float) -> tuple[float, float]:
    """Head positions, m, between which a bench's front handle surely goes from lower to upper."""
    low, high = beside.asked[ObstacleGiven.HEAD_FIRST], beside.asked[ObstacleGiven.HEAD_LAST]
    if bench == 0:
        return max(lower, low), min(upper, high)
    for _pass in range(2):  # by what errors are at the ends, then by what they are there
        off, off_after = handle_off(beside, bench, low), handle_off(beside, bench, high)
        low, _at = head_bracket(beside, bench, lower - off)
        _at, high = head_bracket(beside, bench, upper + off_after)
    return low, high


@kernel
def handle_off(beside: Beside, bench: int, head: float) -> float:
    """Error bound of a bench's front handle along the route, m, as its positions are computed.

    It is made of the head's own place, the way of errors through the chain, and the lengths by which
    positions are counted.
    """
    rows, chain, links, moved = beside.bench.rows, beside.chain, beside.links[:bench], 0.0
    drift, doubt = head_drift(rows, head)
    counted = 0.0
    for j in range(rows.shape[0]):
        if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
            outmost = math.hypot(1.0, max(abs(rows[j, RouteRow.U_START]), abs(rows[j, RouteRow.U_END])))
            counted += rows[j, RouteRow.P] * outmost * outmost
    counted += abs(head)
    beside.at[0] = head
    beside.figures[Told.SPENT] += bench + 1.0
    if place_chain(rows, links, beside.at, 0, 1, chain):
        mark_lanes(rows, links, chain, 0, 1, beside.lanes)
        handle_errors(rows, links, beside.bench.seams, chain, beside.lanes, 0, beside.errors)
        moved = beside.errors[bench]
    off = beside.figures[ObstacleTold.SOUGHT_OFF] + moved + abs(drift) + doubt
    return off + COUNTED * HALF_UNIT * counted


@kernel
def head_bracket(beside: Beside, bench: int, s: float) -> tuple[float, float]:
    """Head positions, m, between which the front handle of a bench comes to s."""
    low, high = beside.asked[ObstacleGiven.HEAD_FIRST], beside.asked[ObstacleGiven.HEAD_LAST]
    guess, fine = 0.5 * (low + high), 4.0 * UNIT * max(abs(low), abs(high), 1.0)
    for step in range(MOST_PLACE_STEPS):
        if high - low <= 2.0 * fine:
            break
        if not low < guess < high:
            guess = 0.5 * (low + high)
        at, ratio = last_handle(beside, bench, guess)
        ahead = at - s
        if ahead >= 0.0:
            high = guess
        else:
            low = guess
        side = 0.0 if step % 4 == 3 else -fine if ahead >= 0.0 else fine
        guess = guess - ahead / ratio + side if step % 8 < 7 else 0.5 * (low + high)
    return low, high


@kernel
def show(beside: Beside, n: int) -> None:
    """Fill row n with how its bench stands to the obstacle; NaN where it cannot stand.

    If the bench is wholly inside the obstacle, the gap is minus the distance. Of a bench outside of the
    venue the point is the corner that is farthest out, and the gap minus its distance.
    """
    row, asked, box, boxes = beside.found[n], beside.asked, beside.box, beside.standing.boxes
    sort, radius = int(asked[ObstacleGiven.SORT]), asked[ObstacleGiven.RADIUS]
    bench, outline = int(row[ObstacleFound.WHO]), beside.outline
    at, _ratio = last_handle(beside, bench + 1, row[ObstacleFound.HEAD])
    row[ObstacleFound.GAP] = math.nan
    if math.isnan(at):
        return
    place_box(beside.sizes, bench, bench, beside.chain.x, beside.chain.y, 0, box, 0)
    distances_to(box[:1], boxes, beside.standing.near, beside.nearest, beside.which)
    copy_row(box[1], boxes[beside.which[0]])
    near = beside.nearest
    nearness(box, 0, 1, near)
    x, y, apart = near[Closest.POINTS], near[Closest.POINTS + 1], near[Closest.DISTANCE]
    own = near[Closest.OWNER] == 0.0
    feature = corner_feature(int(near[Closest.CORNER])) if own else int(near[Closest.FEATURE])
    gap = (near[Closest.GAP] if apart <= 0.0 else apart) - radius
    if gap > 0.0 and forbids(sort, outline, radius, box[0, Box.CX], box[0, Box.CY]):
        gap = -gap
    farthest = math.inf
    for k in range(4 if sort == ObstacleKind.VENUE else 0):
        corner_x, corner_y = corner(box, 0, k)
        if forbids(sort, outline, 0.0, corner_x, corner_y):
            beyond = math.inf
            for m in range(boxes.shape[0]):
                beyond = min(beyond, centre_distance(boxes, m, corner_x, corner_y))
            if -beyond < farthest:
                farthest, gap, x, y = -beyond, -beyond, corner_x, corner_y
                feature = corner_feature(k)
    row[ObstacleFound.AT_X] = x
    row[ObstacleFound.AT_Y] = y
    row[ObstacleFound.GAP] = gap
    row[ObstacleFound.FEATURE] = feature
