"""Joined pieces: where a route position lies, and the next handle one link behind."""

import math

import numpy as np
import numpy.typing as npt

from benchdragon.kernels import curve
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.curve import CurveKind, RouteRow
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.status import Status

IntArray = npt.NDArray[np.int64]

# The head may overshoot the route's end by this, m: rounding of a route position of 1e6 m.
END_SLACK = 1e-9
# A bench within this cosine of square to the route counts as folded: its speed ratio is over 1000.
FOLD_COSINE = 1e-3
# Rounding error of a place, relative to the sizes that it is made from: 2 units.
ROUNDING = 4.5e-16
# Safe steps per handle, besides one for each piece: honest searches take under 10, a fold stalls.
MAX_STEPS = 200
# Halvings that a bracket survives before it has no double left inside it; Newton needs about 4.
MAX_POLISH = 80


@kernel
def row_at(rows: curve.FloatArray, s: float) -> int:
    """Number of the row that holds route position s; the first or last for what lies outside."""
    low = 0
    high = rows.shape[0] - 1
    while low < high:
        middle = (low + high + 1) // 2
        if rows[middle, RouteRow.S_START] <= s:
            low = middle
        else:
            high = middle - 1
    return low


@kernel
def locate(rows: curve.FloatArray, s: float) -> tuple[int, float, Status]:
    """Row and parameter of route position s (m), which may lie on the extension behind the start."""
    j = row_at(rows, s)
    u = curve.parameter_at(rows, j, min(s - rows[j, RouteRow.S_START], rows[j, RouteRow.LENGTH]))
    if s > rows[j, RouteRow.S_START] + rows[j, RouteRow.LENGTH] + END_SLACK:
        return j, u, Status.AFTER_ROUTE
    if s < 0.0 and math.isfinite(rows[0, RouteRow.U_BACK]):
        return j, u, Status.BEFORE_ROUTE
    return j, u, Status.OK


@entry
def evaluate(rows: Table, s: Vector, out: Table) -> None:
    """Fill out[i] = (x, y, heading, curvature) at each route position s[i]; NaN off the route."""
    for i in range(s.shape[0]):
        j, u, status = locate(rows, s[i])
        if status != Status.OK or not math.isfinite(s[i]):
            for column in range(4):
                out[i, column] = math.nan
            continue
        out[i, 0], out[i, 1], _, _ = curve.place(rows, j, u)
        out[i, 2] = curve.heading(rows, j, u)
        out[i, 3] = curve.curvature(rows, j, u)


@entry
def positions(rows: Table, row: IntVector, u: Vector, out: Vector) -> None:
    """Fill out with the route positions, m, of the places (row, u); all flat."""
    for i in range(out.shape[0]):
        out[i] = rows[row[i], RouteRow.S_START] + curve.length_at(rows, row[i], u[i])


@kernel
def step_back(rows: curve.FloatArray, j: int, u: float, reach: float) -> float:
    """A parameter behind u on row j, at most `reach` metres of arc away, not beyond the row."""
    sign = curve.walks_up(rows, j)
    if sign < 0.0:  # the arc grows with theta: divide by what it is at the far end
        reach /= curve.stretch(rows, j, u + reach / curve.stretch(rows, j, u))
        return min(u + reach, rows[j, RouteRow.U_BACK])
    return max(u - reach / curve.stretch(rows, j, u), rows[j, RouteRow.U_BACK])


@kernel
def grain(x: float, y: float, link: float, arc: float) -> float:
    """The resolution of places, m: rounding of coordinates, and of `arc`, |u| in metres."""
    return ROUNDING * (abs(x) + abs(y) + link + arc)


@kernel
def polish(
    rows: curve.FloatArray, j: int, near: float, far: float, x: float, y: float, link: float
) -> float:
    """The one parameter between near (chord < link) and far (chord >= link) with chord = link.

    Newton on the squared chord, kept inside the bracket by bisection to guarantee progress.
    """
    u = near
    for _ in range(MAX_POLISH):
        px, py, tx, ty = curve.place(rows, j, u)
        dx, dy = x - px, y - py
        error = dx * dx + dy * dy - link * link
        if error < 0.0:
            near = u
        else:
            far = u
        metres = curve.stretch(rows, j, u)
        step = error / (2.0 * (dx * tx + dy * ty) * metres * curve.walks_up(rows, j))
        guess = u + step
        if not min(near, far) <= guess <= max(near, far):
            guess = 0.5 * (near + far)
        u = guess
        if abs(step) * metres <= grain(x, y, link, abs(u) * metres):
            break  # the step has been taken; another would only stir the last digits
    return u


@kernel
def growing_chord(
    rows: curve.FloatArray, j: int, u: float, chord: float, cosine: float, slack: float
) -> float:
    """A parameter up to which the chord provably grows behind u, by more than a safe step; else u.

    There the tangent and the bench together swing by less than what is left to a right angle.
    """
    if cosine < FOLD_COSINE:
        return u
    # Beyond the root by Newton's measure, but no farther than half the swing that is allowed.
    allowed = math.asin(cosine)
    most = 0.5 * allowed / (abs(curve.curvature(rows, j, u)) + 1.0 / chord)
    if most <= slack:
        return u
    far = step_back(rows, j, u, min(2.0 * slack / cosine, most))
    # At most `most`, which is less than 0.8 chord.
    width = abs(far - u) * max(curve.stretch(rows, j, u), curve.stretch(rows, j, far))
    swing = curve.turning_bound(rows, j, u, far) + math.asin(width / chord)
    return far if swing < allowed else u


@kernel
def on_bend(rows: curve.FloatArray, j: int, u: float, link: float) -> float:
    """The parameter one link behind u on row j, where that is a line or an arc; NaN if none is."""
    bend, back = abs(rows[j, RouteRow.P]), math.nan
    if rows[j, RouteRow.KIND] == CurveKind.LINE:
        back = u - link
    elif rows[j, RouteRow.KIND] == CurveKind.ARC and 0.5 * link * bend < 1.0:
        back = u - 2.0 * math.asin(0.5 * link * bend) / bend
    return back if back >= rows[j, RouteRow.U_BACK] else math.nan


@kernel
def next_handle(
    rows: curve.FloatArray, j: int, u: float, x: float, y: float, link: float
) -> tuple[int, float, Status]:
    """Row and parameter of the nearest place behind (j, u), at (x, y), that is one link away.

    No root is ever jumped over. Arc length bounds chord, so walking back by (link - chord) stays
    short of the first root; a longer step is taken only where the chord provably grows all the way.
    """
    back = on_bend(rows, j, u, link)
    if back == back:
        return j, back, Status.OK
    slack = link
    for _ in range(MAX_STEPS + 2 * rows.shape[0]):
        if u == rows[j, RouteRow.U_BACK]:
            if j == 0:
                return j, u, Status.ROUTE_TOO_SHORT
            j -= 1
            u = rows[j, RouteRow.U_END]
        else:
            u = step_back(rows, j, u, slack)
        px, py, tx, ty = curve.place(rows, j, u)
        dx, dy = x - px, y - py
        chord = math.hypot(dx, dy)
        slack = link - chord
        if chord == 0.0:
            continue
        cosine = min((dx * tx + dy * ty) / chord, 1.0)
        if slack <= grain(x, y, link, abs(u) * curve.stretch(rows, j, u)):
            reach = max(slack, 0.0) / max(cosine, FOLD_COSINE)
            return j, step_back(rows, j, u, reach), Status.OK
        far = growing_chord(rows, j, u, chord, cosine, slack)
        if far == u:
            continue
        px, py, _, _ = curve.place(rows, j, far)
        slack = link - math.hypot(x - px, y - py)
        if slack <= 0.0:
            return j, polish(rows, j, u, far, x, y, link), Status.OK
        u = far
    return j, u, Status.FOLDED


@kernel
def folded(rows: curve.FloatArray, front: int, rear: int, link: float) -> Status:
    """The status of a fold between two rows: LINK_OVER_DIAMETER if an arc is the cause."""
    for j in (front, rear):
        if rows[j, RouteRow.KIND] == CurveKind.ARC and link * abs(rows[j, RouteRow.P]) >= 2.0:
            return Status.LINK_OVER_DIAMETER
    return Status.FOLDED
