"""The quantities of benches by their formulas alone, from places and rates of a placement."""

import numpy as np

from benchdragon import Route
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate
from benchdragon.model.placement import Placement

# What compiled code may be off by from the same formula in Python: products and sums are contracted.
ROUNDING = 1e-13

QUANTITIES = {
    "speed": DriveRate.SPEEDS,
    "turning": DriveRate.TURNING,
    "across": DriveRate.ACROSS,
    "total": DriveRate.TOTAL,
    "along": DriveRate.ALONG,
}


def size_of(
    name: str, one: Placement, route: Route, squares: FloatArray, rates: FloatArray | float
) -> FloatArray:
    """The size of a quantity for each handle, of "turning" for each bench, (positions, ...).

    Args:
        name: a key of QUANTITIES.
        one: where handles stand.
        route: on which they do.
        squares: of the head's speed at each position, m^2/s^2.
        rates: the head's acceleration at each position or at all, m/s^2.
    """
    square, rate = squares[:, np.newaxis], np.reshape(rates, (-1, 1))
    along = one.speed_ratio * rate + one.ratio_rate * square
    across = one.speed_ratio**2 * route.curvature(one.s) * square
    found = {
        "speed": one.speed_ratio * np.sqrt(square),
        "turning": one.turning_ratio * np.sqrt(square),
        "across": across,
        "total": np.hypot(along, across),
        "along": along,
    }[name]
    return np.asarray(np.abs(found))
