"""A-priori bounds of rounding errors of turning rates and accelerations in placed chains.

Both are made of angles between benches and route, of speed ratios and of curvatures, whose errors are
those of kernels/rounding.py. The head's speed at a place counts as it was rounded. From bench to bench
the errors of accelerations travel as accelerations do (`chain.rates`): whatever moves one term of that
sum moves all behind it, by the ratio of cosines.

Errors below are bounds to first order; what is left out is smaller by 1e-9 or more.
"""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow, bend_slope, curvature, stretch
from benchdragon.kernels.drive import DriveRate, jump_beside
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.motion_bounds import bench_angles
from benchdragon.kernels.rounding import ABOUT, HALF_UNIT, angle_error, link_error, place_error

# Roundings of a curvature, of a sine or cosine made of two products, of a sum of products as shares of
# its terms, and of the head's speed.
BEND_UNITS, SINE_UNITS, SUM_UNITS, SPEED_UNITS = 8.0, 4.0, 8.0, 4.0


class Errors(NamedTuple):
    """Error bounds by rounding in slots; tables except the first are (handles, slots)."""

    seams: Table  # of `rounding.find_seams`
    lanes: Vector  # scratch, of `rounding.mark_lanes`, (handles,)
    along: Vector  # scratch, of `rounding.handle_errors`, (handles,)
    ratio: Table  # of `rounding.ratio_errors`, as shares
    change: Table  # of accelerations along the route, d2 s_i / d sigma^2, 1/m
    turn: Table  # of turning rates of the benches behind, rad/m
    bend: Table  # of the curvature at each handle, 1/m
    sought: Table  # of what is sought, at the handle or at a bench's rear one; see `weigh_values`
    sided: Vector  # whether it is sure on which side of jumps of the curvature all stand, (slots,)
    most: Vector  # the greatest of `along`, m, (slots,)


@kernel
def bend_error(rows: FloatArray, j: int, u: float, along: float) -> float:
    """Error bound of the curvature at u of row j, 1/m, at a place with an error of `along`, m."""
    size = abs(curvature(rows, j, u))
    if rows[j, RouteRow.KIND] != CurveKind.SPIRAL:  # of what may cancel there
        size += abs(rows[j, RouteRow.P])
    along += HALF_UNIT * abs(u) * stretch(rows, j, u)
    return bend_slope(rows, j, u) * along + BEND_UNITS * HALF_UNIT * size


@kernel
def is_sided(rows: FloatArray, places: Placements, i: int, t: int, along: float) -> bool:
    """Whether handle i, whose place has error `along`, m, surely stands on its side of any jump."""
    return jump_beside(rows, places.row[i, t], places.u[i, t], along) < 0


@kernel
def chord_share(
    rows: FloatArray, links: FloatArray, places: Placements, i: int, t: int, errors: Errors
) -> float:
    """By what share the computed places of bench i's handles may be farther apart than its link."""
    chord, along = link_error(rows, links, errors.seams, places, errors.lanes, i, t)
    for n in range(2):
        j, u = places.row[i + n, t], places.u[i + n, t]
        chord += place_error(rows, j, u, places.x[i + n, t], places.y[i + n, t])
    return (chord + along) / links[i]


@kernel
def turn_error(
    places: Placements, turn: FloatArray, i: int, t: int, link: float, angles: tuple[float, float],
    chord: float, errors: Errors,
) -> float:  # fmt: skip
    """Error bound of the turning rate of bench i in slot t, rad/m.

    `angles`, rad, are errors of angles to the route at its handles, `chord` of their distance, a share.
    """
    sine, cosine, rear_sine, rear_cosine = bench_angles(places, i, t, link)
    w, v = places.ratio[i, t], places.ratio[i + 1, t]
    moved = w * (abs(sine) * errors.ratio[i, t] + abs(cosine) * angles[0])
    moved += v * (abs(rear_sine) * errors.ratio[i + 1, t] + abs(rear_cosine) * angles[1])
    moved += SINE_UNITS * HALF_UNIT * (w + v)
    return ABOUT * moved / link + (chord + SUM_UNITS * HALF_UNIT) * abs(turn[i, t])


@kernel
def change_error(
    rows: FloatArray, places: Placements, change: FloatArray, turn: FloatArray, i: int, t: int,
    link: float, angles: tuple[float, float], errors: Errors,
) -> float:  # fmt: skip
    """Error bound of the acceleration of handle i + 1 along the route in slot t, 1/m."""
    sine, cosine, rear_sine, rear_cosine = bench_angles(places, i, t, link)
    sine, rear_sine = abs(sine), abs(rear_sine)
    off, sizes = errors.change[i, t] * abs(cosine), 0.0
    for n in range(2):
        k = i + n
        square = places.ratio[k, t] * places.ratio[k, t]
        pull = square * abs(curvature(rows, places.row[k, t], places.u[k, t]))
        moved = 2.0 * pull * errors.ratio[k, t] + square * errors.bend[k, t]
        aside, along = (rear_sine, abs(rear_cosine)) if n else (sine, abs(cosine))
        off += moved * aside + (pull * along + abs(change[k, t]) * aside) * angles[n]
        off += SINE_UNITS * HALF_UNIT * (pull + abs(change[k, t]))
        sizes += pull * aside + abs(change[k, t]) * along
    swing = link * turn[i, t] * turn[i, t]
    off += 2.0 * link * abs(turn[i, t]) * errors.turn[i, t]
    return ABOUT * (off + SUM_UNITS * HALF_UNIT * (sizes + swing)) / rear_cosine


@kernel
def bend_errors(rows: FloatArray, places: Placements, t: int, links: int, errors: Errors) -> None:
    """Fill errors.bend, sided and most in slot t, up to so many links.

    Call it after `rounding.ratio_errors` of the same slot.
    """
    errors.sided[t], errors.most[t] = 1.0, 0.0
    for i in range(links + 1):
        along = errors.along[i]
        errors.most[t] = max(errors.most[t], along)
        errors.bend[i, t] = bend_error(rows, places.row[i, t], places.u[i, t], along)
        if not is_sided(rows, places, i, t, along):
            errors.sided[t] = 0.0


@kernel
def rate_errors(
    rows: FloatArray, links: FloatArray, places: Placements, change: FloatArray, turn: FloatArray,
    t: int, errors: Errors,
) -> None:  # fmt: skip
    """Fill errors.change and turn in slot t; change and turn are `chain.rates`'.

    Call it after `bend_errors` of the same slot.
    """
    errors.change[0, t] = 0.0
    for i in range(links.shape[0]):
        link, chord = links[i], chord_share(rows, links, places, i, t, errors)
        angles = angle_error(rows, errors.seams, places, i, t, link, errors.along)
        errors.turn[i, t] = turn_error(places, turn, i, t, link, angles, chord, errors)
        errors.change[i + 1, t] = change_error(rows, places, change, turn, i, t, link, angles, errors)


@kernel
def value_error(
    rows: FloatArray, places: Placements, change: FloatArray, i: int, t: int, square: float,
    rate: float, quantity: int, errors: Errors,
) -> float:  # fmt: skip
    """Error bound of a quantity of handle i in slot t; that of a bench counts at its rear handle.

    See `drive.value_at`.
    """
    ratio, off, speed = places.ratio[i, t], errors.ratio[i, t], math.sqrt(square)
    if quantity == DriveRate.SPEEDS:  # the root of a given speed's square is that speed
        steady = i == 0 and rate == 0.0
        return ratio * speed * (off if steady else off + SPEED_UNITS * HALF_UNIT)
    if quantity == DriveRate.TURNING:
        return errors.turn[i - 1, t] * speed if i > 0 else 0.0
    moved = ratio * abs(rate) * (off + SUM_UNITS * HALF_UNIT)
    moved += (errors.change[i, t] + SUM_UNITS * HALF_UNIT * abs(change[i, t])) * square
    if quantity == DriveRate.ALONG:
        return moved
    bend = abs(curvature(rows, places.row[i, t], places.u[i, t]))
    aside = ratio * ratio * square
    aside *= bend * (2.0 * off + SUM_UNITS * HALF_UNIT) + errors.bend[i, t]
    return aside if quantity == DriveRate.ACROSS else moved + aside


@kernel
def weigh_values(
    rows: FloatArray, places: Placements, change: FloatArray, t: int, links: int, square: float,
    rate: float, quantity: int, errors: Errors,
) -> None:  # fmt: skip
    """Fill errors.sought in slot t with error bounds of a quantity of each handle.

    The head has `square`, that of its speed, and the acceleration `rate`.
    """
    for i in range(links + 1):
        errors.sought[i, t] = value_error(rows, places, change, i, t, square, rate, quantity, errors)
