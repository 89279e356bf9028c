"""How a route follows drawn points: which method keeps nearest, with how wide bends, in how many parts.

Choice: clothoids through every point (`smooth = "none"`), corners rounded by arcs ("G1") or by
clothoids and arcs ("G2"). Rivals: chords with fillets of one radius, as drawing programs make them,
and pyclothoids' G1 clothoids with its own solver, between the same poses.

Deviations of ours are bounds; each is shown beside the largest distance found by sampling.
"""

import math
import time
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray
from pyclothoids import Clothoid as OtherClothoid

from benchdragon.errors import InputError
from benchdragon.kernels import fitting as kernel
from benchdragon.kernels.fitting import PolylineSide
from benchdragon.kernels.route_parts import PART_COLUMNS
from benchdragon.kernels.status import Smoothing
from benchdragon.model.curves import Clothoid, Route, curves_of
from benchdragon.surveys.fitting import fitted
from benchdragon.surveys.lines import DrawnLine, corners_of

FloatArray = NDArray[np.float64]
Found = tuple[Route, float]

DEVIATION = 0.3


def drawings() -> dict[str, FloatArray]:
    """Points as people draw them, m."""
    rng = np.random.default_rng(1)
    angle = np.linspace(0.0, 6.0, 80)
    ring = 10.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    t = np.linspace(0.0, 2.0 * math.pi, 60)
    eight = np.column_stack([15.0 * np.sin(t), 8.0 * np.sin(2.0 * t)])
    street = np.array([[0, 0], [30, 0], [38, 12], [60, 14], [62, 40], [40, 44], [36, 60]], float)
    return {
        "ring, traced": ring + rng.normal(0.0, 0.02, ring.shape),
        "eight, exact": eight,
        "eight, traced": eight + rng.normal(0.0, 0.05, eight.shape),
        "street, clicked": street,
    }


def sampled(route: Route, points: FloatArray) -> float:
    """The largest distance found, either way, m."""
    s = np.unique(np.concatenate([np.linspace(a, b, 60) for a, b in pairwise(route.joints)]))
    one, other = shapely.LineString(route.point(s)), shapely.LineString(points)
    there = shapely.distance(shapely.points(shapely.get_coordinates(one)), other).max()
    dense = shapely.get_coordinates(other.segmentize(0.02))
    return float(max(there, shapely.distance(shapely.points(dense), one).max()))


def ours(smooth: str) -> Callable[[FloatArray], Found]:
    """Our route, with its bound."""

    def fit(points: FloatArray) -> Found:
        deviation = 10.0 if smooth == "none" else DEVIATION
        found = fitted(DrawnLine("", corners_of(points)), smooth, deviation)  # type: ignore[arg-type]
        return found.route, found.deviation

    return fit


def fillets(points: FloatArray) -> Found:
    """Chords with arcs of one radius, the largest with which all keep the deviation and fit."""
    count = len(points) - 1
    sides = np.empty((count, kernel.SIDE_COLUMNS))
    kernel.set_sides(points, False, np.arange(count + 1), np.zeros(count), Smoothing.G1, sides)
    tangent = np.roll(sides[:, PolylineSide.TANGENT], 1) + sides[:, PolylineSide.TANGENT]
    reach = DEVIATION / sides[:-1, PolylineSide.REACH]
    radius = min((sides[:, PolylineSide.LENGTH] / tangent).min(), reach.min())
    sides[:, PolylineSide.RADIUS] = np.where(sides[:, PolylineSide.TURN] != 0.0, 0.9 * radius, np.inf)
    parts = np.empty((4 * count, PART_COLUMNS))
    made, _bound = kernel.rounded_sides(sides, False, parts)
    return Route(curves_of(parts[:made])), math.nan


def pyclothoids(points: FloatArray) -> Found:
    """Clothoids of the other solver between the poses that ours has."""
    poses = np.column_stack([points, np.empty(len(points))])
    kernel.set_headings(points, False, poses)
    curves = []
    for start, end in pairwise(poses.tolist()):
        other = OtherClothoid.G1Hermite(*start, *end)
        first, last = other.KappaStart, other.KappaEnd
        curves.append(Clothoid(other.length, first, last, (start[0], start[1]), start[2]))
    return Route(tuple(curves)), math.nan


METHODS: dict[str, Callable[[FloatArray], Found]] = {
    "chords and fillets": fillets,
    "pyclothoids, G1": pyclothoids,
    "none (ours)": ours("none"),
    "G1 (ours)": ours("G1"),
    "G2 (ours)": ours("G2"),
}


def main() -> None:
    """Print a table of each drawing."""
    for name, points in drawings().items():
        print(f"\n{name}: {len(points)} points; allowed {DEVIATION} m")
        print("method               bound, m   sampled, m   least radius, m   parts   ms")
        for method, fit in METHODS.items():
            began = time.perf_counter()
            try:
                route, bound = fit(points)
            except InputError as error:
                print(f"{method:20s} {error}")
                continue
            spent = 1e3 * (time.perf_counter() - began)
            joints = np.concatenate([route.joints[:-1], np.nextafter(route.joints[1:], 0.0)])
            bend = np.abs(route.curvature(joints)).max()
            print(
                f"{method:20s} {bound:8.4f} {sampled(route, points):12.4f} {1.0 / bend:17.3f} "
                f"{len(route):7d} {spent:4.0f}"
            )


if __name__ == "__main__":
    main()
