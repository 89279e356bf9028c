"""March the handles from head to tail: places and speed ratios, then their rates of change.

Everything here is a function of the head's route position alone; time enters in the rooms above,
through the head's speed. A speed ratio is ds_i / ds_0.
"""

import math
from typing import NamedTuple

import numpy as np

from benchdragon.kernels.arrays import IntTable, Table, Vector
from benchdragon.kernels.curve import FloatArray, RouteRow, curvature, place
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.route import FOLD_COSINE, IntArray, folded, locate, next_handle
from benchdragon.kernels.spiral import LANE_NUMBERS, LANES, Lane, angles_after, spiral_links, takes_link
from benchdragon.kernels.status import Status


class Placements(NamedTuple):
    """Chains at several head positions, each array (handles, slots): see `march`."""

    row: IntTable
    u: Table
    x: Table
    y: Table
    ratio: Table
    tx: Table
    ty: Table
    failed: IntTable


def empty_placements(handles: int, slots: int) -> Placements:
    """Room for chains of so many handles at so many head positions."""
    return Placements(
        np.empty((handles, slots), dtype=np.int64), np.empty((handles, slots)),
        np.empty((handles, slots)), np.empty((handles, slots)), np.empty((handles, slots)),
        np.empty((handles, slots)), np.empty((handles, slots)), np.empty((2, slots), dtype=np.int64),
    )  # fmt: skip


@kernel
def cosines(
    rows: FloatArray, front: int, u: float, x: float, y: float, rear: int, v: float, link: float
) -> tuple[float, float, float, float]:
    """Cosine between bench and route at the front handle, at (x, y), and the rear; the rear's x, y."""
    _, _, atx, aty = place(rows, front, u)
    rear_x, rear_y, btx, bty = place(rows, rear, v)
    dx, dy = (x - rear_x) / link, (y - rear_y) / link
    return dx * atx + dy * aty, dx * btx + dy * bty, rear_x, rear_y


@kernel
def place_head(rows: FloatArray, s: float, t: int, places: Placements) -> Status:
    """Place handle 0 at time t, at route position s; returns the status."""
    j, v, status = locate(rows, s)
    places.row[0, t] = j
    places.u[0, t] = v
    places.x[0, t], places.y[0, t], _, _ = place(rows, j, v)
    places.ratio[0, t] = 1.0
    return status


@kernel
def place_next(rows: FloatArray, link: float, i: int, t: int, places: Placements) -> Status:
    """Place handle i + 1 at time t, anywhere on the route; returns the status."""
    row, u, x, y, ratio = places.row, places.u, places.x, places.y, places.ratio
    front = row[i, t]
    j, v, status = next_handle(rows, front, u[i, t], x[i, t], y[i, t], link)
    row[i + 1, t] = j
    u[i + 1, t] = v
    if status == Status.ROUTE_TOO_SHORT:
        return status
    ahead, behind, rear_x, rear_y = cosines(rows, front, u[i, t], x[i, t], y[i, t], j, v, link)
    if status == Status.FOLDED or ahead < FOLD_COSINE or behind < FOLD_COSINE:
        return folded(rows, front, j, link)
    x[i + 1, t], y[i + 1, t] = rear_x, rear_y
    ratio[i + 1, t] = ratio[i, t] * ahead / behind
    return Status.OK


@kernel
def shared_angles(i: int, start: int, end: int, places: Placements) -> tuple[float, float]:
    """Least and greatest u of handle i if all times have it on one row, none failed; else (1, 0)."""
    row, u, failed = places.row, places.u, places.failed
    least = u[i, start]
    most = u[i, start]
    for t in range(start, end):
        if row[i, t] != row[i, start] or failed[0, t] != Status.OK:
            return 1.0, 0.0
        least = min(least, u[i, t])
        most = max(most, u[i, t])
    return least, most


@kernel
def first_guess(
    rows: FloatArray, j: int, link: float, i: int, start: int, end: int, state: FloatArray,
    u: FloatArray,
) -> None:  # fmt: skip
    """Fill `state` for lanes that begin at handle i on spiral row j: no rest, and link / radius."""
    for n in range(LANE_NUMBERS):
        state[n] = 0.0
    for t in range(start, end):
        state[Lane.GUESS + t - start] = link / (rows[j, RouteRow.P] * u[i, t])


@kernel
def run_end(rows: FloatArray, link: float, i: int, t: int, end: int, places: Placements) -> int:
    """Up to which time from t on handle i stands on one row where `spiral_links` takes the link."""
    row, u, failed = places.row, places.u, places.failed
    j, n = row[i, t], t
    while n < end and failed[0, n] == Status.OK and row[i, n] == j:
        if not takes_link(rows, j, u[i, n], u[i, n], link):
            break
        n += 1
    return n


@kernel
def march_run(
    rows: FloatArray, link: float, i: int, t: int, end: int, state: FloatArray, places: Placements
) -> int:
    """Place handle i + 1 at time t and at those after it that share a spiral; returns the next time."""
    row, u, failed = places.row, places.u, places.failed
    if failed[0, t] != Status.OK:
        return t + 1
    j, stop = row[i, t], run_end(rows, link, i, t, end, places)
    if stop > t:
        first_guess(rows, j, link, i, t, stop, state, u)
        if spiral_links(rows, j, link, 1.0, i, t, stop, state, u, places.x, places.y, places.ratio):
            for n in range(t, stop):
                row[i + 1, n] = j
            return stop
    failed[0, t] = place_next(rows, link, i, t, places)
    failed[1, t] = i + 1
    return t + 1


@kernel
def march_block(
    rows: FloatArray, links: FloatArray, start: int, end: int, state: FloatArray, places: Placements
) -> None:
    """Place the followers at times start..end: abreast on a spiral that all share, else in runs."""
    row, u, x, y, ratio = places.row, places.u, places.x, places.y, places.ratio
    abreast = False  # whether `state` belongs to handle i
    least, most = 1.0, 0.0  # bounds of the angles abreast; empty when they share no spiral
    for i in range(links.shape[0]):
        j, link = row[i, start], links[i]
        fits = least <= most and takes_link(rows, j, least, most, link)
        if not fits:
            least, most = shared_angles(i, start, end, places)
            fits = least <= most and takes_link(rows, j, least, most, link)
        if fits:
            scale = link / links[max(i - 1, 0)]
            if not abreast:
                scale = 1.0
                first_guess(rows, j, link, i, start, end, state, u)
            abreast = spiral_links(rows, j, link, scale, i, start, end, state, u, x, y, ratio)
            if abreast:
                for t in range(start, end):
                    row[i + 1, t] = j
                least, most = angles_after(rows, j, least, most, link)
                continue
        abreast, least, most, t = False, 1.0, 0.0, start
        while t < end:
            t = march_run(rows, link, i, t, end, state, places)


@kernel
def blank(t: int, places: Placements) -> None:
    """Set NaN at time t from the rear handle of the bench that failed on, or from the head on."""
    row, u, x, y, ratio = places.row, places.u, places.x, places.y, places.ratio
    failed = places.failed
    status = failed[0, t]
    if status == Status.OK or status == Status.BEFORE_ROUTE or status == Status.AFTER_ROUTE:
        failed[1, t] = 0
    if status != Status.OK:
        for i in range(failed[1, t], row.shape[0]):
            row[i, t] = 0
            u[i, t] = x[i, t] = y[i, t] = ratio[i, t] = math.nan


@entry
@allocates
def march(rows: Table, links: Vector, s: Vector, first: int, last: int, out: Placements) -> None:
    """Place every handle for each head position s[t], first <= t < last.

    Fills of `out` row, u (parameter on that row), x, y (m) and ratio (ds_i / ds_0), each of shape
    (handles, times), and failed, (2, times): a `Status`, and the bench that failed; not tx, ty.
    """
    state = np.empty(LANE_NUMBERS)
    for t in range(first, last):
        out.failed[0, t] = place_head(rows, s[t], t, out)
    for start in range(first, last, LANES):
        end = min(start + LANES, last)
        march_block(rows, links, start, end, state, out)
    for t in range(first, last):
        blank(t, out)


@kernel
def rates_in_slot(
    rows: FloatArray, links: FloatArray, t: int, row: IntArray, u: FloatArray, x: FloatArray,
    y: FloatArray, ratio: FloatArray, ratio_rate: FloatArray, turn: FloatArray,
) -> None:  # fmt: skip
    """Fill column t of ratio_rate and turn: see `rates`."""
    ratio_rate[0, t] = 0.0
    _, _, atx, aty = place(rows, row[0, t], u[0, t])
    bend = ratio[0, t] ** 2 * curvature(rows, row[0, t], u[0, t])
    for i in range(links.shape[0]):
        j, v, link = row[i + 1, t], u[i + 1, t], links[i]
        _, _, btx, bty = place(rows, j, v)
        dx, dy = (x[i, t] - x[i + 1, t]) / link, (y[i, t] - y[i + 1, t]) / link
        w, next_w = ratio[i, t], ratio[i + 1, t]
        turn[i, t] = (w * (dx * aty - dy * atx) - next_w * (dx * bty - dy * btx)) / link
        next_bend = next_w * next_w * curvature(rows, j, v)
        along = ratio_rate[i, t] * (dx * atx + dy * aty) + bend * (dy * atx - dx * aty)
        across = next_bend * (dy * btx - dx * bty)
        swing = link * turn[i, t] * turn[i, t]
        ratio_rate[i + 1, t] = (along - across + swing) / (dx * btx + dy * bty)
        atx, aty, bend = btx, bty, next_bend


@entry
def rates(
    rows: Table, links: Vector, row: IntTable, u: Table, x: Table, y: Table, ratio: Table,
    ratio_rate: Table, turn: Table,
) -> None:  # fmt: skip
    """Second derivatives of the marched chain with respect to the head's position.

    Fills ratio_rate = d2 s_i / d s_0^2, 1/m, (handles, times), and turn = d heading / d s_0 of each
    bench, rad/m, (benches, times). From the rigid bench, d the link, u its unit vector, n the normal:
    turn = (w_i t_i - w_i+1 t_i+1) . n / d, and (A_i - A_i+1) . u = -d turn^2 of the accelerations.
    """
    for t in range(u.shape[1]):
        rates_in_slot(rows, links, t, row, u, x, y, ratio, ratio_rate, turn)
