"""Motion bounds of first and second order over an interval of the head's route position, the step.

Everything is a function of the head's route position sigma. Every handle walks on along the route,
so that its places at the two ends of a step enclose it in between; from those follow bounds on
speeds and accelerations per metre of sigma, handle by handle down the chain. A quantity whose second
derivative is at most M then stays within M h^2 / 8 of the straight line between its ends, which is
what makes a few evaluations enough (design/first_contact.py).
"""

import math

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.chain import Placements, march
from benchdragon.kernels.curve import FloatArray, RouteRow, curvature, place, stretch, turning_bound
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.links import link_of
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import FOLD_COSINE
from benchdragon.kernels.status import Status


class HandleBound(Numbered):
    """Columns of a table of handle bounds, one row a handle."""

    PATH = 0  # arc length walked in the step, m
    SLOWEST = 1  # least ds_i / dsigma
    SPEED = 2  # greatest ds_i / dsigma
    GROWTH_LOW = 3  # least d log(ds_i / dsigma) / dsigma, 1/m
    GROWTH_HIGH = 4  # greatest
    ACCELERATION = 5  # greatest acceleration of the handle's point, 1/m
    TURNING_RATE = 6  # greatest turning rate of the bench before it, rad/m
    RIGHT = 7  # least curvature of its piece of route, 1/m
    LEFT = 8  # greatest
    HEADING_CHANGE = 9  # at least what the heading varies by in all, rad
    TURN_LOW = 10  # least turning rate of the bench before it, left positive, rad/m
    TURN_HIGH = 11  # greatest
    FRONT_LOW = 12  # least tangent of the angle from that bench to the route at its front handle
    FRONT_HIGH = 13  # greatest
    REAR_LOW = 14  # the same at its rear handle
    REAR_HIGH = 15


HANDLE_COLUMNS = len(HandleBound)


class BenchBound(Numbered):
    """Columns of a table of bench bounds, one row a bench.

    The first three hold for all of its points.
    """

    TRAVEL = 0  # path length, m
    POINT_SPEED = 1  # speed
    POINT_ACCELERATION = 2  # acceleration, 1/m
    TURN = 3  # turning rate, rad/m
    ANGULAR_ACCELERATION = 4  # rate of change of the turning rate, rad/m^2


BENCH_COLUMNS = len(BenchBound)

# Headings and places that differ by more than this at a joint, rad and m, count as a kink or a gap.
SMOOTH = 1e-12
# Bounds made of a hundred roundings are widened by this factor.
ROUNDED_UP = 1.0 + 1e-12
# How often bounds on a bench's angles are drawn tighter by the rates that follow from them.
PASSES = 3


# The range of an angle: its least and greatest sine, then its least and greatest cosine.
Angle = tuple[float, float, float, float]


@entry
def place_chain(rows: Table, links: Vector, at: Vector, first: int, last: int, out: Placements) -> bool:
    """March the chain with its head at at[first..last-1]; whether it can stand at all of them."""
    march(rows, links, at, first, last, out)
    sound = True
    for t in range(first, last):
        if out.failed[0, t] != Status.OK:
            sound = False
            continue
        for i in range(links.shape[0] + 1):
            _, _, out.tx[i, t], out.ty[i, t] = place(rows, out.row[i, t], out.u[i, t])
    return sound


@kernel
def path_bound(rows: FloatArray, ja: int, ua: float, jb: int, ub: float) -> float:
    """At least the path, m, from place (ja, ua) on to (jb, ub), gaps at joints included."""
    if ja == jb:
        return abs(ub - ua) * max(stretch(rows, ja, ua), stretch(rows, ja, ub))
    end, start = rows[ja, RouteRow.U_END], rows[jb, RouteRow.U_START]
    path = abs(end - ua) * max(stretch(rows, ja, ua), stretch(rows, ja, end))
    path += abs(ub - start) * max(stretch(rows, jb, ub), stretch(rows, jb, start))
    for j in range(ja, jb):
        x, y, _, _ = place(rows, j, rows[j, RouteRow.U_END])
        next_x, next_y, _, _ = place(rows, j + 1, rows[j + 1, RouteRow.U_START])
        path += math.hypot(next_x - x, next_y - y)
        if j > ja:
            a, b = rows[j, RouteRow.U_START], rows[j, RouteRow.U_END]
            path += abs(b - a) * max(stretch(rows, j, a), stretch(rows, j, b))
    return path


@kernel
def curvature_range(rows: FloatArray, ja: int, ua: float, jb: int, ub: float) -> tuple[float, float]:
    """Least and greatest curvature from (ja, ua) to (jb, ub), 1/m; infinite across a kink or a gap.

    On each kind of piece curvature is monotone in u.
    """
    ends = curvature(rows, ja, ua), curvature(rows, jb, ub)
    low, high = min(ends), max(ends)
    for j in range(ja, jb):
        x, y, tx, ty = place(rows, j, rows[j, RouteRow.U_END])
        next_x, next_y, next_tx, next_ty = place(rows, j + 1, rows[j + 1, RouteRow.U_START])
        if max(abs(next_tx - tx), abs(next_ty - ty), abs(next_x - x), abs(next_y - y)) > SMOOTH:
            return -math.inf, math.inf
        before = curvature(rows, j, rows[j, RouteRow.U_END])
        after = curvature(rows, j + 1, rows[j + 1, RouteRow.U_START])
        low, high = min(low, before, after), max(high, before, after)
    return low, high


@kernel
def heading_bound(rows: FloatArray, ja: int, ua: float, jb: int, ub: float) -> float:
    """At least the angle, rad, by which the heading varies in all from (ja, ua) on to (jb, ub)."""
    if ja == jb:
        return turning_bound(rows, ja, ua, ub)
    total = turning_bound(rows, ja, ua, rows[ja, RouteRow.U_END])
    total += turning_bound(rows, jb, rows[jb, RouteRow.U_START], ub)
    for j in range(ja, jb):
        _, _, tx, ty = place(rows, j, rows[j, RouteRow.U_END])
        _, _, next_tx, next_ty = place(rows, j + 1, rows[j + 1, RouteRow.U_START])
        total += abs(math.atan2(tx * next_ty - ty * next_tx, tx * next_tx + ty * next_ty))
        if j > ja:
            total += turning_bound(rows, j, rows[j, RouteRow.U_START], rows[j, RouteRow.U_END])
    return total


@kernel
def bench_angles(places: Placements, i: int, t: int, link: float) -> tuple[float, float, float, float]:
    """Sine and cosine of the angle from bench i to the route, at its front and at its rear handle."""
    dx = (places.x[i, t] - places.x[i + 1, t]) / link
    dy = (places.y[i, t] - places.y[i + 1, t]) / link
    atx, aty = places.tx[i, t], places.ty[i, t]
    btx, bty = places.tx[i + 1, t], places.ty[i + 1, t]
    return dx * aty - dy * atx, dx * atx + dy * aty, dx * bty - dy * btx, dx * btx + dy * bty


@kernel
def scaled(low: float, high: float, least: float, most: float) -> tuple[float, float]:
    """Least and greatest product of a number in low..high, not negative, and one in least..most."""
    return (high if least < 0.0 else low) * least, (high if most > 0.0 else low) * most


@kernel
def product(low: float, high: float, least: float, most: float) -> tuple[float, float]:
    """Least and greatest product of a number in low..high and one in least..most."""
    if low >= 0.0:
        return scaled(low, high, least, most)
    if high <= 0.0:
        greatest, smallest = scaled(-high, -low, least, most)
        return -smallest, -greatest
    a, b = scaled(0.0, -low, least, most)
    c, d = scaled(0.0, high, least, most)
    return min(c, -b), max(d, -a)


@kernel
def tangents(angle: Angle) -> tuple[float, float]:
    """Least and greatest tangent of an angle."""
    low, high, least, most = angle
    return low / (least if low < 0.0 else most), high / (least if high > 0.0 else most)


@kernel
def angle_rates(
    slow: float, fast: float, right: float, left: float, turn: tuple[float, float]
) -> tuple[float, float]:
    """Least and greatest rate, rad/m, of the angle from a bench to the route at a handle.

    The handle walks at slow..fast, the route's curvature is right..left, and the bench turns at `turn`.
    """
    low, high = scaled(slow, fast, right, left)
    return low - turn[1], high - turn[0]


@kernel
def peak(start: float, end: float, low: float, high: float, h: float) -> float:
    """At most what a function reaches over a step h from start to end, its slope in low..high."""
    if high <= 0.0:
        return start
    if low >= 0.0:
        return end
    if not high - low < math.inf:
        return math.inf
    return max(start, end, start + high * (end - start - low * h) / (high - low))


@kernel
def magnitude(low: float, high: float) -> float:
    """The greatest absolute value between low and high."""
    return max(abs(low), abs(high))


@kernel
def bound_handles(
    rows: FloatArray, links: FloatArray, places: Placements, a: int, b: int, bounds: FloatArray
) -> None:
    """Fill bounds, (handles, HANDLE_COLUMNS), for the head's step from slot a to slot b."""
    ja, ua, jb, ub = places.row[0, a], places.u[0, a], places.row[0, b], places.u[0, b]
    h = path_bound(rows, ja, ua, jb, ub)
    low, high = curvature_range(rows, ja, ua, jb, ub)
    bounds[0, HandleBound.PATH] = h
    bounds[0, HandleBound.SLOWEST] = 1.0
    bounds[0, HandleBound.SPEED] = 1.0
    bounds[0, HandleBound.GROWTH_LOW], bounds[0, HandleBound.GROWTH_HIGH] = 0.0, 0.0
    bounds[0, HandleBound.ACCELERATION], bounds[0, HandleBound.TURNING_RATE] = magnitude(low, high), 0.0
    bounds[0, HandleBound.LEFT], bounds[0, HandleBound.RIGHT] = high, low
    bounds[0, HandleBound.HEADING_CHANGE] = heading_bound(rows, ja, ua, jb, ub)
    for i in range(links.shape[0]):
        ja, ua = places.row[i + 1, a], places.u[i + 1, a]
        jb, ub = places.row[i + 1, b], places.u[i + 1, b]
        bounds[i + 1, HandleBound.RIGHT], bounds[i + 1, HandleBound.LEFT] = curvature_range(
            rows, ja, ua, jb, ub
        )
        bounds[i + 1, HandleBound.HEADING_CHANGE] = heading_bound(rows, ja, ua, jb, ub)
        bounds[i + 1, HandleBound.PATH] = path_bound(rows, ja, ua, jb, ub)
        bound_next(links[i], places, i, a, b, h, bounds)


@kernel
def angle_range(sa: float, sb: float, ca: float, cb: float, change: float) -> Angle:
    """The range of an angle that stays within `change`, rad, of its value at one of two ends.

    There its sine and cosine are sa, ca and sb, cb.
    """
    low, high = max(min(sa, sb) - change, -1.0), min(max(sa, sb) + change, 1.0)
    loss = magnitude(low, high) * change
    return low, high, min(ca, cb) - loss, min(max(ca, cb) + loss, 1.0)


@kernel
def bound_next(
    link: float, places: Placements, i: int, a: int, b: int, h: float, bounds: FloatArray
) -> None:
    """Fill row i + 1 of bounds from row i; infinite where the bench may stand square to the route.

    An angle that varies by V in all stays within V / 2 of what it is at one of the two ends, and a
    narrower range of angles narrows their rates in turn.
    """
    sa, ca, ta, da = bench_angles(places, i, a, link)
    sb, cb, tb, db = bench_angles(places, i, b, link)
    swing = (bounds[i, HandleBound.PATH] + bounds[i + 1, HandleBound.PATH]) / link
    front = 0.5 * (bounds[i, HandleBound.HEADING_CHANGE] + swing)
    rear = 0.5 * (bounds[i + 1, HandleBound.HEADING_CHANGE] + swing)
    seen = places.ratio[i + 1, a], places.ratio[i + 1, b]
    bounds[i + 1, HandleBound.SLOWEST], bounds[i + 1, HandleBound.GROWTH_LOW] = 0.0, -math.inf
    bounds[i + 1, HandleBound.SPEED], bounds[i + 1, HandleBound.GROWTH_HIGH] = math.inf, math.inf
    bounds[i + 1, HandleBound.ACCELERATION] = math.inf
    bounds[i + 1, HandleBound.TURNING_RATE] = math.inf
    for _ in range(PASSES):
        f, r = angle_range(sa, sb, ca, cb, front), angle_range(ta, tb, da, db, rear)
        if not (min(f[2], r[2]) > FOLD_COSINE and bounds[i, HandleBound.SPEED] < math.inf):
            return
        front_rate, rear_rate = bound_rates(link, f, r, seen, i, h, bounds)
        front = min(front, 0.5 * front_rate * h)
        rear = min(rear, 0.5 * rear_rate * h)
    bend = magnitude(bounds[i + 1, HandleBound.RIGHT], bounds[i + 1, HandleBound.LEFT])
    speed = bounds[i + 1, HandleBound.SPEED]
    along = speed * magnitude(
        bounds[i + 1, HandleBound.GROWTH_LOW], bounds[i + 1, HandleBound.GROWTH_HIGH]
    )
    across = speed * speed * bend
    pull = math.sqrt(along * along + across * across)
    bounds[i + 1, HandleBound.ACCELERATION] = (
        pull if pull < math.inf else math.inf
    )  # no number is no bound


@kernel
def bound_rates(
    link: float, f: Angle, r: Angle, seen: tuple[float, float], i: int, h: float, bounds: FloatArray
) -> tuple[float, float]:
    """Fill speeds and rates of row i + 1 of bounds from row i; at most |f'| and |r'|, rad/m.

    Let f, r be the angles from the bench to the route at its front and rear handle, v, w the handles'
    speeds and tau the bench's turning rate. The rigid bench keeps tau = (v sin f - w sin r) / link and
    w cos r = v cos f; with each handle's curvature, f' = v curvature - tau and r' = w curvature - tau,
    so that w' / w = v' / v - tan f f' + tan r r'. At the two ends of the step w is as `seen`.
    """
    slow, fast = bounds[i, HandleBound.SLOWEST], bounds[i, HandleBound.SPEED]
    next_slow, next_fast = slow * f[2] / r[3], fast * f[3] / r[2]
    low, high = scaled(slow, fast, f[0], f[1])
    other_low, other_high = scaled(next_slow, next_fast, r[0], r[1])
    turn_low, turn_high = (low - other_high) / link, (high - other_low) / link
    turn = turn_low, turn_high
    front_low, front_high = angle_rates(
        slow, fast, bounds[i, HandleBound.RIGHT], bounds[i, HandleBound.LEFT], turn
    )
    right, left = bounds[i + 1, HandleBound.RIGHT], bounds[i + 1, HandleBound.LEFT]
    rear_low, rear_high = angle_rates(next_slow, next_fast, right, left, turn)
    rates = magnitude(front_low, front_high), magnitude(rear_low, rear_high)
    low, high = tangents(f)
    bounds[i + 1, HandleBound.FRONT_LOW], bounds[i + 1, HandleBound.FRONT_HIGH] = low, high
    front_low, front_high = product(low, high, front_low, front_high)
    low, high = tangents(r)
    bounds[i + 1, HandleBound.REAR_LOW], bounds[i + 1, HandleBound.REAR_HIGH] = low, high
    rear_low, rear_high = product(low, high, rear_low, rear_high)
    growth_low = bounds[i, HandleBound.GROWTH_LOW] - front_high + rear_low
    growth_high = bounds[i, HandleBound.GROWTH_HIGH] - front_low + rear_high
    low, high = scaled(next_slow, next_fast, growth_low, growth_high)
    next_fast = min(next_fast, peak(seen[0], seen[1], low, high, h))
    next_slow = max(next_slow, -peak(-seen[0], -seen[1], -high, -low, h))
    bounds[i + 1, HandleBound.SLOWEST], bounds[i + 1, HandleBound.SPEED] = next_slow, next_fast
    bounds[i + 1, HandleBound.GROWTH_LOW] = growth_low
    bounds[i + 1, HandleBound.GROWTH_HIGH] = growth_high
    bounds[i + 1, HandleBound.TURNING_RATE] = magnitude(turn_low, turn_high)
    bounds[i + 1, HandleBound.TURN_LOW], bounds[i + 1, HandleBound.TURN_HIGH] = turn_low, turn_high
    return rates


@kernel
def reach(front: float, rear: float, sizes: FloatArray, i: int) -> float:
    """The most that any point of bench i moves when its handles move by at most front and rear.

    A point (1 - l) front handle + l rear handle, h beside the link, is linear in both handles; the
    bound is convex in the point, so that the corners suffice. For paths, speeds and accelerations.
    """
    link = link_of(sizes, i)
    nose, tail = sizes[2, i] / link, sizes[3, i] / link
    at_nose = (1.0 + nose) * front + nose * rear
    at_tail = tail * front + (1.0 + tail) * rear
    return max(at_nose, at_tail) + 0.5 * sizes[1, i] / link * (front + rear)


@kernel
def bound_bench(handles: FloatArray, i: int, sizes: FloatArray, k: int, out: FloatArray) -> None:
    """Fill out, one row of BENCH_COLUMNS, for bench i of the chain, with the sizes in column k."""
    link = link_of(sizes, k)
    out[BenchBound.TRAVEL] = ROUNDED_UP * reach(
        handles[i, HandleBound.PATH], handles[i + 1, HandleBound.PATH], sizes, k
    )
    out[BenchBound.POINT_SPEED] = ROUNDED_UP * reach(
        handles[i, HandleBound.SPEED], handles[i + 1, HandleBound.SPEED], sizes, k
    )
    out[BenchBound.POINT_ACCELERATION] = ROUNDED_UP * reach(
        handles[i, HandleBound.ACCELERATION], handles[i + 1, HandleBound.ACCELERATION], sizes, k
    )
    out[BenchBound.TURN] = ROUNDED_UP * handles[i + 1, HandleBound.TURNING_RATE]
    both = handles[i, HandleBound.ACCELERATION] + handles[i + 1, HandleBound.ACCELERATION]
    out[BenchBound.ANGULAR_ACCELERATION] = ROUNDED_UP * both / link
