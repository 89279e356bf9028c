"""A-priori bounds of rounding errors of a placed chain's handles, and of all points of its benches.

A computed chain is the exact one of a head a little way off (kernels/double_double.py), except for what
each link adds: its solver leaves the chord wrong by a few units of what it is made from. Along the
route that is the error over the cosine at the rear handle, and from there it travels as speeds do, by
the ratio of cosines at each link. Places add their own rounding, once each, and joints of the route
theirs.

Errors below are bounds to first order; what is left out is smaller by 1e-9 or more.
"""

import math

from benchdragon.kernels import curve
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.box import Box
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import (
    CurveKind,
    FloatArray,
    RouteRow,
    curvature,
    heading,
    place,
    stretch,
)
from benchdragon.kernels.drive import jump_beside
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.motion_bounds import bench_angles, reach
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import on_bend
from benchdragon.kernels.spiral import takes_link

# Half a unit in the last place of 1: what one rounding may change a number by, as a share.
HALF_UNIT = 2.0**-53
# Roundings of the chord that the lanes of a spiral solve for (kernels/spiral.py): D^2 has 3, half of
# which counts; the terms of F have 8, half; the step taken, the angle behind and what Halley's last
# step leaves have one each at most; the link itself has one.
LANE_UNITS = 10.0
# Roundings of a chord as the other solvers compare it with the link, and of the closed form on an arc;
# on a line only the link's own.
CHORD_UNITS, LINE_CHORD = 6.0, 1.0
# Roundings of a place, of what the row adds to its start, as shares of that: on a line, on a spiral, on
# another piece; and of the way along an arc, or along what turns otherwise, for its angles.
LINE_UNITS, SPIRAL_UNITS, PIECE_UNITS, ARC_UNITS, WAY_UNITS = 3.0, 7.0, 8.0, 1.0, 12.0
# Roundings of a tangent, rad, and of the angle that it has turned by.
TANGENT_UNITS, TURN_UNITS = 5.0, 4.0
# Roundings of a speed ratio at each link: of its formula in the lanes, and of each cosine.
RATIO_UNITS, COSINE_UNITS = 16.0, 4.0
# Tangents that differ by more at a joint, rad, make a kink, which is too large to be rounding.
KINK = 1e-9


class Seam(Numbered):
    """Columns of a table of seams, one row a row of the route.

    They are the errors by joints up to its start.
    """

    GAP, TILT = 0, 1  # m, rad


SEAM_COLUMNS = len(Seam)
# Errors to first order are widened by this factor.
ABOUT = 1.0 + 1e-9


@kernel
def place_error(rows: FloatArray, j: int, u: float, x: float, y: float) -> float:
    """Error bound of the place (x, y) of parameter u on row j, m."""
    kind, off = rows[j, RouteRow.KIND], abs(x) + abs(y)
    if kind == CurveKind.SPIRAL:
        return HALF_UNIT * (off + SPIRAL_UNITS * rows[j, RouteRow.P] * u)
    if u == 0.0:  # the start of a row is as it is stored
        return 0.0
    far = abs(x - rows[j, RouteRow.X]) + abs(y - rows[j, RouteRow.Y])
    if kind == CurveKind.LINE:  # along an axis nothing is rounded but the sum
        along = rows[j, RouteRow.AXIS_X] == 0.0 or rows[j, RouteRow.AXIS_Y] == 0.0
        return HALF_UNIT * (off if along else off + LINE_UNITS * far)
    off += PIECE_UNITS * far + (ARC_UNITS if kind == CurveKind.ARC else WAY_UNITS) * abs(u)
    turn = heading(rows, j, u) - rows[j, RouteRow.ANGLE]
    # Where it winds on, its angle counts by its radius.
    if kind != CurveKind.ARC and abs(turn) > curve.CLOTHOID_TURN:
        off += TURN_UNITS * abs(turn / curvature(rows, j, u))
    return HALF_UNIT * off


@kernel
def tilt_error(rows: FloatArray, j: int, u: float) -> float:
    """Error bound of the computed heading at u of row j, rad."""
    kind, turn = rows[j, RouteRow.KIND], 0.0
    if kind != CurveKind.SPIRAL:
        turn = abs(heading(rows, j, u) - rows[j, RouteRow.ANGLE])
    # Bends either way may cancel, their rounding does not.
    if kind not in (CurveKind.LINE, CurveKind.ARC, CurveKind.SPIRAL):
        turn = max(turn, curve.CLOTHOID_TURN)
    return HALF_UNIT * (TANGENT_UNITS + TURN_UNITS * turn)


@entry
def find_seams(rows: Table, out: Table) -> None:
    """Fill `out`, (rows, SEAM_COLUMNS), with the rounding errors of the joints up to each row.

    Exactly, each row begins where the one before it ends, in its direction unless it makes a kink.
    """
    out[0, Seam.GAP], out[0, Seam.TILT] = 0.0, 0.0
    for j in range(1, rows.shape[0]):
        end, start = rows[j - 1, RouteRow.U_END], rows[j, RouteRow.U_START]
        x, y, tx, ty = place(rows, j - 1, end)
        next_x, next_y, next_tx, next_ty = place(rows, j, start)
        gap = abs(next_x - x) + abs(next_y - y)
        gap += place_error(rows, j - 1, end, x, y) + place_error(rows, j, start, next_x, next_y)
        swing = abs(tx * next_ty - ty * next_tx)
        tilt = tilt_error(rows, j - 1, end) + tilt_error(rows, j, start)
        if swing <= KINK and tx * next_tx + ty * next_ty > 0.0:
            tilt += swing
        out[j, Seam.GAP], out[j, Seam.TILT] = out[j - 1, Seam.GAP] + gap, out[j - 1, Seam.TILT] + tilt


@kernel
def seam_error(rows: FloatArray, seams: FloatArray, seen: int, j: int, x: float, y: float) -> float:
    """Error bound of the place (x, y) on row j, m, seen from row `seen`: by the joints between.

    A joint that tilts what is beyond moves a place by its distance from the joint, which is no more
    than that from the last joint and the way along the rows between.
    """
    if j == seen:
        return 0.0
    a, b = min(j, seen), max(j, seen)
    start_x, start_y, _, _ = place(rows, b, rows[b, RouteRow.U_START])
    far = math.sqrt((x - start_x) ** 2 + (y - start_y) ** 2)
    far = far + rows[b, RouteRow.S_START] - rows[a + 1, RouteRow.S_START]
    return seams[b, Seam.GAP] - seams[a, Seam.GAP] + (seams[b, Seam.TILT] - seams[a, Seam.TILT]) * far


@kernel
def mark_lanes(
    rows: FloatArray, links: FloatArray, places: Placements, first: int, last: int, lanes: FloatArray
) -> None:
    """Fill lanes[i] with 1 where link i was taken by the lanes of a spiral, else 0.

    For chains that were marched together in slots first..last-1: by all of them abreast.
    """
    for i in range(links.shape[0]):
        j, least, most = places.row[i, first], places.u[i, first], places.u[i, first]
        same = True
        for t in range(first, last):
            same = same and places.row[i, t] == j and places.row[i + 1, t] == j
            least, most = min(least, places.u[i, t]), max(most, places.u[i, t])
        lanes[i] = 1.0 if same and takes_link(rows, j, least, most, links[i]) else 0.0


@kernel
def link_error(
    rows: FloatArray, links: FloatArray, seams: FloatArray, places: Placements, lanes: FloatArray,
    i: int, t: int,
) -> tuple[float, float]:  # fmt: skip
    """Errors by the link behind handle i: of its chord, m; and of its rear place along the route, m."""
    link, j, k = links[i], places.row[i, t], places.row[i + 1, t]
    u, v = places.u[i, t], places.u[i + 1, t]
    if lanes[i] > 0.0:
        # Where lanes start again they take the front's angle as it was rounded.
        kept = 0.0 if i == 0 or lanes[i - 1] > 0.0 else HALF_UNIT * abs(u) * stretch(rows, j, u)
        return LANE_UNITS * HALF_UNIT * link + kept, 0.0
    along = HALF_UNIT * abs(v) * stretch(rows, k, v)
    x, y, back_x, back_y = places.x[i, t], places.y[i, t], places.x[i + 1, t], places.y[i + 1, t]
    off = CHORD_UNITS * HALF_UNIT * link
    if j == k and on_bend(rows, j, u, link) == v:
        return LINE_CHORD * HALF_UNIT * link if rows[j, RouteRow.KIND] == CurveKind.LINE else off, along
    off += place_error(rows, j, u, x, y) + place_error(rows, k, v, back_x, back_y)
    off += seam_error(rows, seams, j, k, back_x, back_y)
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        off += HALF_UNIT * abs(u) * stretch(rows, j, u)
    return off, along


@kernel
def handle_errors(
    rows: FloatArray, links: FloatArray, seams: FloatArray, places: Placements, lanes: FloatArray,
    t: int, out: FloatArray,
) -> None:  # fmt: skip
    """Fill out[i] with the error bound of handle i along the route, m.

    The chain is that of these links in slot t, whose head counts as exact; `lanes` are those of
    `mark_lanes`.
    """
    out[0] = 0.0
    for i in range(links.shape[0]):
        dx, dy = places.x[i, t] - places.x[i + 1, t], places.y[i, t] - places.y[i + 1, t]
        ahead = abs(dx * places.tx[i, t] + dy * places.ty[i, t])
        behind = dx * places.tx[i + 1, t] + dy * places.ty[i + 1, t]
        chord, along = link_error(rows, links, seams, places, lanes, i, t)
        out[i + 1] = ABOUT * ((out[i] * ahead + chord * links[i]) / behind + along)


@kernel
def bend_beyond(rows: FloatArray, j: int, u: float, along: float) -> float:
    """The jump of the curvature at a joint within `along` metres of u of row j, 1/m, or 0."""
    k = jump_beside(rows, j, u, along)
    if k < 0:
        return 0.0
    after = curvature(rows, k + 1, rows[k + 1, RouteRow.U_START])
    return abs(after - curvature(rows, k, rows[k, RouteRow.U_END]))


@kernel
def angle_error(
    rows: FloatArray, seams: FloatArray, places: Placements, i: int, t: int, link: float,
    errors: FloatArray,
) -> tuple[float, float]:  # fmt: skip
    """Error bounds of the angles from bench i to the route at its two handles, rad.

    The front handle's error along the route, `errors`, moves the whole bench on as it walks; that of
    the link moves its rear handle alone. Places, tangents and joints between the two add theirs.
    """
    sine, cosine, rear_sine, rear_cosine = bench_angles(places, i, t, link)
    j, u, k, v = places.row[i, t], places.u[i, t], places.row[i + 1, t], places.u[i + 1, t]
    bend, rear_bend, follows = curvature(rows, j, u), curvature(rows, k, v), cosine / rear_cosine
    turn, moved = (sine - follows * rear_sine) / link, errors[i]
    added = max(errors[i + 1] - follows * moved, 0.0)
    turned = place_error(rows, j, u, places.x[i, t], places.y[i, t])
    turned += place_error(rows, k, v, places.x[i + 1, t], places.y[i + 1, t])
    turned = (turned + abs(rear_sine) * added) / link
    if j != k:
        turned += (
            abs(seams[j, Seam.TILT] - seams[k, Seam.TILT])
            + abs(seams[j, Seam.GAP] - seams[k, Seam.GAP]) / link
        )
    beyond = bend_beyond(rows, k, v, errors[i + 1])
    front = (abs(bend - turn) + bend_beyond(rows, j, u, moved)) * moved
    rear = (abs(follows * rear_bend - turn) + follows * beyond) * moved
    rear += (abs(rear_bend) + beyond) * added
    return turned + front + tilt_error(rows, j, u), turned + rear + tilt_error(rows, k, v)


@kernel
def ratio_errors(
    rows: FloatArray, links: FloatArray, seams: FloatArray, places: Placements, lanes: FloatArray,
    t: int, errors: FloatArray, out: FloatArray,
) -> None:  # fmt: skip
    """Fill out[i, t] with the error bound of the speed ratio of handle i in slot t, as a share.

    At each link a ratio changes by that of two cosines, whose angles have the errors of their handles
    and tangents. `errors` receives those of `handle_errors`.
    """
    handle_errors(rows, links, seams, places, lanes, t, errors)
    out[0, t] = 0.0
    for i in range(links.shape[0]):
        sine, cosine, rear_sine, rear_cosine = bench_angles(places, i, t, links[i])
        front, rear = angle_error(rows, seams, places, i, t, links[i], errors)
        off = (abs(sine) * front + COSINE_UNITS * HALF_UNIT) / cosine
        off += (abs(rear_sine) * rear + COSINE_UNITS * HALF_UNIT) / rear_cosine
        off += RATIO_UNITS * HALF_UNIT * lanes[i]
        out[i + 1, t] = ABOUT * (out[i, t] + off)


@kernel
def bench_error(
    rows: FloatArray, seams: FloatArray, places: Placements, sizes: FloatArray, i: int, t: int,
    seen: int, errors: FloatArray,
) -> float:  # fmt: skip
    """Error bound of any point of bench i in slot t, m, seen from row `seen` of the route.

    `errors` are those of `handle_errors`; sizes are (4, benches).
    """
    off, rear = 0.0, 0.0
    for n in range(2):
        j, u, x, y = places.row[i + n, t], places.u[i + n, t], places.x[i + n, t], places.y[i + n, t]
        off = rear
        rear = errors[i + n] + place_error(rows, j, u, x, y) + seam_error(rows, seams, seen, j, x, y)
    around = sizes[0, i] + sizes[1, i] + abs(places.x[i, t]) + abs(places.y[i, t])
    return reach(off, rear, sizes, i) + 4.0 * HALF_UNIT * around


@kernel
def still_error(boxes: FloatArray, n: int) -> float:
    """Error bound of any point of box n, which stands still, m: by rounding of its corners."""
    around = (
        boxes[n, Box.HALF_LENGTH]
        + boxes[n, Box.HALF_WIDTH]
        + abs(boxes[n, Box.CX])
        + abs(boxes[n, Box.CY])
    )
    return 4.0 * HALF_UNIT * around


@entry
def bench_errors(
    rows: Table, links: Vector, sizes: Table, seams: Table, places: Placements, t: int, seen: int,
    lanes: Vector, errors: Vector, out: Vector,
) -> None:  # fmt: skip
    """Fill out[i] with the error bound of any point of bench i in slot t: see `bench_error`.

    Seen from row `seen`, or if that is negative from the row of the head. `errors` receives those of
    handles; `lanes` is scratch, one for each link.
    """
    mark_lanes(rows, links, places, t, t + 1, lanes)
    handle_errors(rows, links, seams, places, lanes, t, errors)
    seen = seen if seen >= 0 else places.row[0, t]
    for i in range(links.shape[0]):
        out[i] = bench_error(rows, seams, places, sizes, i, t, seen, errors)
