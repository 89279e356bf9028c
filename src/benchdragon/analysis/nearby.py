"""A shift of the origin to the dance, and a-priori bounds of rounding errors there."""

from dataclasses import replace

import numpy as np

from benchdragon import budget
from benchdragon.errors import UnsureError
from benchdragon.i18n import _
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.rounding import SEAM_COLUMNS, bench_errors, find_seams
from benchdragon.kernels.swept_boxes import MOST_OFF
from benchdragon.model.base_curve import Point
from benchdragon.model.walk import Walk
from benchdragon.number_format import at_most

# A dance is searched from an origin of its own where it is farther than this from that of the route, m,
# and by more than so many times its own extent.
FAR, SPREADS = 100.0, 4.0
NOWHERE = (0.0, 0.0)


def origin_of(x: FloatArray, y: FloatArray) -> Point:
    """The origin for searches of a dragon with handles at these coordinates, m: whole metres."""
    x, y = x[np.isfinite(x)], y[np.isfinite(y)]
    if not x.size:
        return NOWHERE
    far = float(max(np.abs(x).max(), np.abs(y).max()))
    if far <= max(FAR, SPREADS * float(max(np.ptp(x), np.ptp(y)))):
        return NOWHERE
    return float(np.rint(x.flat[0])), float(np.rint(y.flat[0]))


def origin_at(walk: Walk, s: float) -> Point:
    """The origin for searches of a walk that begins with its head at s, m."""
    placed = walk.placement(s, throw=False)
    return origin_of(placed.x, placed.y)


def must_stand(walk: Walk, time: float) -> None:
    """Raise a WalkError if the dragon cannot stand at a time, s."""
    walk.motion([time])


def seen_from(walk: Walk, origin: Point) -> Walk:
    """The same walk with its coordinates counted from an origin, m."""
    return walk if origin == NOWHERE else replace(walk, route=walk.route.seen_from(origin))


def seams_of(rows: FloatArray) -> FloatArray:
    """The seams of a route of these rows, (rows, SEAM_COLUMNS): see kernels/rounding.py."""
    seams = np.empty((len(rows), SEAM_COLUMNS))
    find_seams(rows, seams)
    return seams


def errors_at(walk: Walk, s: float, seen: int = -1) -> tuple[FloatArray, FloatArray]:
    """Bounds of the errors of the dragon's positions with the head at s, m.

    Handles along the route, (N + 1,), and any point of benches, (N,), seen from row `seen` of the route
    or from that of the head; zeros where the dragon does not stand.
    """
    rows, dragon = walk.route.rows, walk.dragon
    errors, off = np.zeros(len(dragon) + 1), np.zeros(len(dragon))
    places = empty_placements(len(dragon) + 1, 1)
    budget.spend(len(errors))
    if place_chain(rows, dragon.links, np.array([s]), 0, 1, places):
        lanes, seams = np.empty(len(dragon)), seams_of(rows)
        bench_errors(rows, dragon.links, dragon.sizes, seams, places, 0, seen, lanes, errors, off)
    return errors, off


def checked_off(off: float) -> float:
    """A bound of the errors of distances, m.

    Raises:
        UnsureError: if it is too large for a search to find all pairs.
    """
    if off > MOST_OFF:
        text = _("rounding may hide {off} m of distances; a search allows for {most} m")
        raise UnsureError(text.format(off=at_most(off), most=at_most(MOST_OFF)))
    return off
