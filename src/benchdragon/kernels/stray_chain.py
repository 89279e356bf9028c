"""A dragon whose handles do not keep to the route: each walks beside it, links stay rigid.

Handle i walks on the curve that runs aside[i] metres to the left of the route. Its tangent is the
route's, its curvature k / (1 - aside k), and its place is given by the place (row, u) of the route
beside it. So everything that is known of chains on a route holds for it (see kernels/motion_bounds.py).
"""

import math

from benchdragon.kernels import motion_bounds
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray, RouteRow, curvature, place, stretch, walks_up
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.motion_bounds import HandleBound
from benchdragon.kernels.route import FOLD_COSINE, locate
from benchdragon.kernels.status import Status

# Newton steps for the way along the route by which a handle gives, on the route's curvature.
NEWTON_STEPS = 3
# A step shorter than this, m, ends the search for a place: the next would be below 1e-11 m. Two or
# three are needed; a handle that needs more than so many has no place.
FINE_STEP, MOST_ROUNDS = 1e-5, 12
# A handle that would give by more than this share of its link has lost its place.
MOST_GIVEN = 0.5
# The least that is left of the route's radius beside it, as a share: nearer to the centre is no place.
LEAST_RADIUS = 0.05


@kernel
def moved(rows: FloatArray, j: int, u: float, way: float) -> tuple[int, float]:
    """The place about `way` metres on from place (j, u), to first order; no end stops it."""
    u += walks_up(rows, j) * way / stretch(rows, j, u)
    while j + 1 < rows.shape[0] and (u - rows[j, RouteRow.U_END]) * walks_up(rows, j) > 0.0:
        rest = abs(u - rows[j, RouteRow.U_END]) * stretch(rows, j, rows[j, RouteRow.U_END])
        j += 1
        u = rows[j, RouteRow.U_START] + walks_up(rows, j) * rest / stretch(
            rows, j, rows[j, RouteRow.U_START]
        )
    while j > 0 and (u - rows[j, RouteRow.U_BACK]) * walks_up(rows, j) < 0.0:
        rest = abs(u - rows[j, RouteRow.U_BACK]) * stretch(rows, j, rows[j, RouteRow.U_BACK])
        j -= 1
        u = rows[j, RouteRow.U_END] - walks_up(rows, j) * rest / stretch(
            rows, j, rows[j, RouteRow.U_END]
        )
    return j, u


@kernel
def give(along: float, across: float, straight: float, turned: float, link: float) -> float:
    """How far along the route, m, a handle must go until it is one link from the one before it.

    It stands `along` metres ahead of that one and `across` to its left; d metres on it stands
    d straight farther ahead and d^2 turned farther to the left.
    """
    d = 0.0
    for _ in range(NEWTON_STEPS):
        a, b = along + d * straight, across + d * d * turned
        d -= (a * a + b * b - link * link) / (2.0 * (a * straight + 2.0 * b * d * turned))
    return d


@kernel
def settle(
    rows: FloatArray, link: float, aside: float, j: int, u: float, t: int, i: int, places: Placements
) -> float:
    """Place handle i in slot t beside the route near place (j, u), one link from the one before it.

    How far along the route, m, it had to give; infinite where it cannot stand.
    """
    given = 0.0
    for _ in range(MOST_ROUNDS):
        px, py, tx, ty = place(rows, j, u)
        bend = curvature(rows, j, u)
        straight, turned = 1.0 - aside * bend, 0.5 * bend * (1.0 - aside * bend)
        px, py = px - aside * ty, py + aside * tx
        dx, dy = px - places.x[i - 1, t], py - places.y[i - 1, t]
        d = give(dx * tx + dy * ty, dy * tx - dx * ty, straight, turned, link)
        j, u = moved(rows, j, u, d)
        given += d
        if straight < LEAST_RADIUS or not abs(given) < MOST_GIVEN * link:
            break
        if abs(d) < FINE_STEP:
            a, b, swing = d * straight, d * d * turned, d * bend
            places.row[i, t], places.u[i, t] = j, u
            places.x[i, t], places.y[i, t] = px + a * tx - b * ty, py + a * ty + b * tx
            places.tx[i, t], places.ty[i, t] = tx - swing * ty, ty + swing * tx
            return given
    return math.inf


@kernel
def place_perturbed(
    rows: FloatArray, links: FloatArray, aside: FloatArray, at: FloatArray, near: int, t: int,
    places: Placements,
) -> bool:  # fmt: skip
    """Place the chain in slot t beside the route, its head at at[t]; whether all of it can stand there.

    The head keeps its place along the route. Every other handle is sought where its speed in slot
    `near` would bring it, and gives along the route until its bench is as long as it is. The slots may
    be the same, with a chain that stands on the route.
    """
    j, u, status = locate(rows, at[t])
    px, py, tx, ty = place(rows, j, u)
    if status != Status.OK or 1.0 - aside[0] * curvature(rows, j, u) < LEAST_RADIUS:
        return False
    places.row[0, t], places.u[0, t], places.ratio[0, t] = j, u, 1.0
    places.x[0, t], places.y[0, t] = px - aside[0] * ty, py + aside[0] * tx
    places.tx[0, t], places.ty[0, t] = tx, ty
    given, way = 0.0, at[t] - at[near]
    for i in range(1, aside.shape[0]):
        ahead = places.ratio[i, near] * way + given
        j, u = moved(rows, places.row[i, near], places.u[i, near], ahead)
        given += settle(rows, links[i - 1], aside[i], j, u, t, i, places)
        if given == math.inf:
            return False
        _, front, _, rear = motion_bounds.bench_angles(places, i - 1, t, links[i - 1])
        if min(front, rear) < FOLD_COSINE:
            return False
        places.ratio[i, t] = places.ratio[i - 1, t] * front / rear
    return True


@kernel
def place_beside(
    rows: FloatArray, links: FloatArray, aside: FloatArray, at: FloatArray, near: int, t: int,
    out: Placements,
) -> bool:  # fmt: skip
    """Place the chain in slot t with its head at at[t], on the route if `aside` is empty, else beside.

    A chain beside the route is followed on from slot `near`; where that is t, or fails, from where it
    would stand on the route.
    """
    if aside.shape[0] and near != t and place_perturbed(rows, links, aside, at, near, t, out):
        return True
    sound = motion_bounds.place_chain(rows, links, at, t, t + 1, out)
    return sound and (aside.shape[0] == 0 or place_perturbed(rows, links, aside, at, t, t, out))


@entry
def place_along(rows: Table, links: Vector, aside: Vector, at: Vector, out: Placements) -> int:
    """Place chains with their heads at all of `at`, in order; how many stand before one cannot."""
    for t in range(at.shape[0]):
        if not place_beside(rows, links, aside, at, max(t - 1, 0), t, out):
            return t
    return at.shape[0]


@kernel
def parallel_bend(bend: float, aside: float) -> float:
    """Curvature of the curve beside a route of curvature `bend`, 1/m; infinite where none can be."""
    left = 1.0 - aside * bend
    return bend / left if LEAST_RADIUS <= left < math.inf else math.copysign(math.inf, bend)


@kernel
def bound_beside(
    rows: FloatArray, links: FloatArray, aside: FloatArray, places: Placements, a: int, b: int,
    bounds: FloatArray,
) -> None:  # fmt: skip
    """`bound_handles` for handles beside the route: paths are longer by what the route turns."""
    for i in range(aside.shape[0]):
        ja, ua = places.row[i, a], places.u[i, a]
        jb, ub = places.row[i, b], places.u[i, b]
        low, high = motion_bounds.curvature_range(rows, ja, ua, jb, ub)
        bounds[i, HandleBound.RIGHT] = parallel_bend(low, aside[i])
        bounds[i, HandleBound.LEFT] = parallel_bend(high, aside[i])
        bend = motion_bounds.heading_bound(rows, ja, ua, jb, ub)
        bounds[i, HandleBound.HEADING_CHANGE] = bend
        bounds[i, HandleBound.PATH] = (
            motion_bounds.path_bound(rows, ja, ua, jb, ub) + abs(aside[i]) * bend
        )
        if i > 0:
            motion_bounds.bound_next(
                links[i - 1], places, i - 1, a, b, bounds[0, HandleBound.PATH], bounds
            )
            continue
        bounds[0, HandleBound.SLOWEST], bounds[0, HandleBound.SPEED] = 1.0, 1.0
        bounds[0, HandleBound.GROWTH_LOW], bounds[0, HandleBound.GROWTH_HIGH] = 0.0, 0.0
        bounds[0, HandleBound.TURNING_RATE] = 0.0
        bounds[0, HandleBound.ACCELERATION] = motion_bounds.magnitude(
            bounds[0, HandleBound.RIGHT], bounds[0, HandleBound.LEFT]
        )
