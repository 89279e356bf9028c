"""How far points of a bench lie beside the route: their signed distance from it, left positive.

Of a rail vehicle, whose bogie pivots are handles on the track, these are its throws.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, brief, of_kind, whole
from benchdragon.i18n import _
from benchdragon.kernels.box import ACROSS, ALONG, LONGEST_BENCH
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import evaluate
from benchdragon.model.arrays import as_numbers
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon
from benchdragon.model.placement import Placement

# Points at all head positions that one answer may hold: some 150 bytes each while it is computed.
MOST_POINTS = 1_000_000
# The part of the route on which the nearest point is sought is sampled at so many steps, then refined:
# by Newton's method, or by halving two of those steps where that leaves them.
SAMPLES, MOST_ROUNDS = 64, 60
# The search ends where no position moves by more, as a share of 1 m or of what it is.
FINE = 1e-14
# A point that lies so far ahead or behind, m, of the end that is nearest to it lies beyond it.
MOST_SKEW = 1e-9


@dataclass(frozen=True)
class Offsets:
    """Where points of a bench are, and how far from the route; every table has one row a head position.

    Attributes:
        x: of each point, m, (T, P).
        y: the same.
        s: route position of the point of the route that is nearest, m, (T, P).
        offset: signed distance from there, m, (T, P); positive to the left of the walking direction.

    Examples:
        >>> walk = bd.Walk(bd.Dragon.uniform(3), bd.Route((bd.Arc(9.0, 2.0),)), start=12.0)
        >>> bd.bench_offsets(walk.motion(0.0)).offset.round(3)
        array([[ 0.099,  0.099, -0.195, -0.195]])
    """

    x: FloatArray
    y: FloatArray
    s: FloatArray
    offset: FloatArray


def bench_offsets(placed: Placement, bench: int = 1, points: npt.ArrayLike | None = None) -> Offsets:
    """How far points of a bench lie beside the route, to rounding.

    The nearest point is sought along the bench, and beyond each handle twice as far as the point is
    from the nearer handle: another turn of the route that comes nearer does not count.

    Args:
        placed: the dragon with its head at T positions.
        bench: 1..N.
        points: P pairs, m: how far ahead of the middle between the bench's handles, and how far to
            its left; its corners unless given, front left first, then going round as there.

    Raises:
        InputError: for points that are not pairs or farther away than a bench may be long, for more
            than MOST_POINTS, and where a point lies beyond an end of the route.
        WalkError: if the dragon cannot stand at one of the positions.

    Examples:
        >>> walk = bd.Walk(bd.Dragon.uniform(3), bd.Route((bd.Arc(9.0, 2.0),)), start=12.0)
        >>> bd.bench_offsets(walk.motion(0.0), points=[(0.0, 0.0)]).offset.round(4)
        array([[0.1143]])
    """
    of_kind("placed", placed, Placement)
    whole("bench", bench, 1, len(placed.dragon))
    chosen = _corners(placed.dragon, bench) if points is None else _pairs(points)
    if len(chosen) * len(placed.head_s) > MOST_POINTS:
        text = _("{asked} points (of a bench by positions) are more than {most}")
        raise InputError(text.format(asked=len(chosen) * len(placed.head_s), most=MOST_POINTS))
    placed.check()
    x, y, reach = _outside(placed, bench, chosen)
    low = np.maximum(placed.s[:, bench, np.newaxis] - 2.0 * reach, -placed.route.extension)
    high = np.minimum(placed.s[:, bench - 1, np.newaxis] + 2.0 * reach, placed.route.length)
    s, offset, beyond = _nearest(placed.route, x.ravel(), y.ravel(), low.ravel(), high.ravel())
    if beyond.any():
        _refuse(placed, bench, chosen, int(np.flatnonzero(beyond)[0]))
    return Offsets(x, y, s.reshape(x.shape), offset.reshape(x.shape))


def _corners(dragon: Dragon, bench: int) -> FloatArray:
    """The corners of a bench as `points`, (4, 2)."""
    length, width, front, rear = dragon.sizes[:, bench - 1]
    ahead = 0.5 * length * ALONG + 0.5 * (front - rear)
    return np.stack([ahead, 0.5 * width * ACROSS], axis=-1)


def _pairs(points: npt.ArrayLike) -> FloatArray:
    pairs = as_numbers("points", points)
    if pairs.ndim != 2 or pairs.shape[1] != 2 or not (np.abs(pairs) <= LONGEST_BENCH).all():
        text = _("points must be a list of pairs (ahead, left) of at most {most} m, not {value}")
        raise InputError(text.format(most=f"{LONGEST_BENCH:g}", value=brief(points)))
    return pairs


def _outside(
    placed: Placement, bench: int, points: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x and y of the bench's points, and their distance from the nearer handle, m, each (T, P)."""
    ends = placed.x[:, [bench, bench - 1]], placed.y[:, [bench, bench - 1]]
    link = placed.dragon.links[bench - 1]
    ux, uy = ((end[:, 1:] - end[:, :1]) / link for end in ends)
    ahead, left = points.T
    x = ends[0].mean(axis=1, keepdims=True) + ahead * ux - left * uy
    y = ends[1].mean(axis=1, keepdims=True) + ahead * uy + left * ux
    reach = np.hypot(np.abs(ahead) - 0.5 * link, left)
    return x, y, np.broadcast_to(reach, x.shape)


def _nearest(
    route: Route, x: FloatArray, y: FloatArray, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray, npt.NDArray[np.bool_]]:
    """Route positions between low and high nearest to n points, signed distances, m, each (n,).

    And whether an end is nearest: then no point of the route is square to the point there.
    """
    step = (high - low) / SAMPLES
    least, where = np.full(len(x), np.inf), np.zeros(len(x))
    for k in range(SAMPLES + 1):
        apart = np.hypot(*_apart(route, x, y, np.minimum(low + k * step, high))[:2])
        nearer = apart < least
        least[nearer], where[nearer] = apart[nearer], k
    first, last = np.maximum(where - 1.0, 0.0), np.minimum(where + 1.0, SAMPLES)
    s = _square(route, x, y, low + first * step, np.minimum(low + last * step, high))
    ahead, left, _bend = _apart(route, x, y, s)
    ends = np.minimum(s - low, high - s) <= FINE * np.maximum(1.0, np.abs(s))
    return s, np.copysign(np.hypot(ahead, left), left), ends & (np.abs(ahead) > MOST_SKEW)


def _square(
    route: Route, x: FloatArray, y: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Route positions between low and high from which points lie square to the route, m, (n,)."""
    s = 0.5 * (low + high)
    for _round in range(MOST_ROUNDS):
        ahead, left, bend = _apart(route, x, y, s)
        low, high = np.where(ahead > 0.0, s, low), np.where(ahead > 0.0, high, s)
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = s + ahead / (1.0 - bend * left)
        inside = (newton >= low) & (newton <= high)
        moved = np.where(inside, newton, 0.5 * (low + high))
        done = np.abs(moved - s) <= FINE * np.maximum(1.0, np.abs(s))
        s = moved
        if done.all():
            break
    return s


def _apart(
    route: Route, x: FloatArray, y: FloatArray, s: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Points as seen from route positions s: ahead and to the left, m, and the curvature, 1/m."""
    out = np.empty((len(s), 4))
    evaluate(route.rows, s, out)
    dx, dy, bend = x - out[:, 0], y - out[:, 1], out[:, 3]
    ux, uy = np.cos(out[:, 2]), np.sin(out[:, 2])
    return dx * ux + dy * uy, dy * ux - dx * uy, bend


def _refuse(placed: Placement, bench: int, points: FloatArray, n: int) -> None:
    """Refuse point number n of `points` at all positions, which lies beyond an end of the route."""
    t, p = divmod(n, len(points))
    ahead, left = points[p]
    raise InputError(
        _(
            "with the head at s = {head} m no point of the route lies beside the point of bench "
            "{bench} that is {ahead} m ahead of the middle between its handles and {left} m to its "
            "left; lengthen the route, or keep the head away from its ends"
        ).format(head=f"{placed.head_s[t]:.6g}", bench=bench, ahead=f"{ahead:g}", left=f"{left:g}")
    )
