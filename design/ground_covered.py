"""Why the ground that a dance covers is a union of outlines by Shapely, and not a grid of distances.

Both ways begin with the same steps of benches (analysis/swept_steps.py), each with a convex hull that
holds the bench all along. What is wanted of them: their area, the line that spectators keep behind, and
the smallest rectangle and circle, for one dance or several. Either

1. the hulls are joined by GEOS, and the polygon widened: `swept_area`, as it is; or
2. nodes of one grid hold how far they are from the nearest hull, less than nothing within it. Where
   that is 0, between nodes by proportion, is the outline (marching squares); the nearest point of it,
   handed on from node to node (P.-E. Danielsson's transform), gives the distance out to the spectators.

The truth is the first way with a tenth of the error, widened by fine arcs. "out" is how far the outline
is from the true one, "line" how far the spectators' line and the true one are apart (Hausdorff's
distance), for steps and cells of so many mm. The grid's lines are in pieces that nobody has joined; the
time for that is not counted. Memory is what the process took more meanwhile, as Linux tells it.

Chosen is the union. With the error that `swept_area` has unless another is asked for, 10 mm, it takes
0.9 to 1.8 s and 21 to 59 MB for the long dances, and the grid 1.5 to 3.4 s and 127 to 335 MB; with 5
mm 1.8 to 3.4 s and 40 to 100 MB beside 6.0 to 12.4 s and 360 to 1,072 MB. A grid pays for the ground
it lies over, by the square of its cells and whatever the dance: for 40 benches that walk a drawn
route of 171 m by 60 m, 6.0 s and 1.4 GB, and the union 0.09 s and 3 MB. Cells of 2 mm are too many
for all but a village square, where they take 12.6 s and 1.4 GB to come as near as the union does in
0.8 s; the 0.1 mm that may be asked for are out of reach. Both are as far from the truth as their
steps allow, 5 to 7 mm at 10 mm. But the union errs outwards alone: rectangle and circle hold all
benches, where those of the grid, whose cells cut corners, are too small. Several dances at once are a
union of their polygons, in half the grid's time.

The spectators' line was 12 to 25 mm off at 10 mm while it was widened by arcs of 16 segments; it has 64
since, which take no longer, and is 5 to 9 mm off, as a grid's is.

    python design/ground_covered.py                  (some minutes)
    python design/ground_covered.py village drawn    (dances of which a word is named)
"""

import ctypes
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numba
import numpy as np
import numpy.typing as npt
import shapely
from shapely.geometry.base import BaseGeometry

from benchdragon.analysis import swept_steps
from benchdragon.analysis.swept import ERROR, hulls_of, swept_area
from benchdragon.analysis.swept_steps import walked_steps
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import read_plan

Array = npt.NDArray[np.float64]
Dance = tuple[Walk, float, float]
Function = TypeVar("Function", bound=Callable[..., Any])

MARGIN = 1.5  # how far spectators keep, m
ERRORS = (0.02, 0.01, 0.005, 0.002)  # that steps may have, and sides of the grid's cells, m
MOST_NODES = 1.2e8  # of a grid: a gigabyte
# Nodes that are farther than this from an outline, in cells, only need to know that they are.
REACH = 1.5
# Segments of a quarter circle that are four times as many as `swept_area` takes.
# Of the truth: its error, m, segments of a quarter circle, and steps, more than users may take.
TRUTH, QUARTER, STEPS = 0.1 * ERROR, 256, 2_000_000
LOOKED = 30_000  # points of each line at which lines are compared, evenly over all of its corners
EXAMPLES = Path(__file__).parents[1] / "examples"


class Found(NamedTuple):
    """What a way finds: an area, m2, and two lines as segments, (n, 2, 2), m."""

    area: float
    outline: Array
    line: Array


def dances() -> dict[str, list[Dance]]:
    """Those that are compared."""

    def planned(source: str, settings: list[str], end: float | None = None) -> Dance:
        plan = read_plan(source, settings)
        walk = plan.build()
        return (walk, 0.0, end) if end else (walk, *plan.span(walk))

    spiral, turn = planned("spiral-in", [], 400.0), planned("turn", [])
    return {
        "spiral-in, 223 benches": [spiral],
        "turn, 223 benches": [turn],
        "both at once": [spiral, turn],
        "48 benches": [planned("spiral-in", ["dragon.benches=48"], 400.0)],
        "1,000 benches": [planned("spiral-in", ["dragon.benches=1000"], 400.0)],
        "village, 120 benches": [planned(str(EXAMPLES / "12_village.dragon.toml"), [])],
        "drawn route, 40 benches": [planned(str(EXAMPLES / "11_drawn_walk.dragon.toml"), [])],
    }


def compiled(function: Function) -> Function:
    """`function`, compiled when it is first called."""
    compiler: Any = numba.njit
    made: Function = compiler(function)
    return made


@compiled
def sides_of(ring: Array, sides: Array) -> None:
    """The sides of a convex polygon: a unit vector outwards, and how far along it the side is, m."""
    for k in range(len(ring)):
        (ax, ay), (bx, by) = ring[k], ring[(k + 1) % len(ring)]
        length = math.hypot(bx - ax, by - ay)
        sides[k, 0], sides[k, 1] = (by - ay) / length, (ax - bx) / length
        sides[k, 2] = sides[k, 0] * ax + sides[k, 1] * ay


@compiled
def nodes_within(sides: Array, reach: float, y: float, h: float) -> tuple[int, int]:
    """The first node of a row that is within so far, m, of all sides, and the one behind the last."""
    low, high = -math.inf, math.inf
    for k in range(len(sides)):
        left = sides[k, 2] + reach - sides[k, 1] * y
        if sides[k, 0] > 0.0:
            high = min(high, left / sides[k, 0])
        elif sides[k, 0] < 0.0:
            low = max(low, left / sides[k, 0])
        elif left < 0.0:
            high = -math.inf
    return (math.ceil(low / h), math.floor(high / h) + 1) if low <= high else (0, 0)


@compiled
def mark(corners: Array, first: Any, h: float, reach: float, grid: Any) -> None:
    """Lower nodes to how far they are from convex polygons, m: corners first[n] to first[n + 1] - 1.

    Beyond corners the sides are taken to go on, which makes no difference where the distance is 0.
    """
    room = np.empty((16, 3))
    for n in range(len(first) - 1):
        ring = corners[first[n] : first[n + 1]]
        sides = room[: len(ring)]
        sides_of(ring, sides)
        low, high = ring[:, 1].min() - reach, ring[:, 1].max() + reach
        for i in range(math.ceil(low / h), math.floor(high / h) + 1):
            start, stop = nodes_within(sides, reach, i * h, h)
            inner, beyond = nodes_within(sides, -reach, i * h, h)
            grid[i, inner:beyond] = -reach
            for j in range(start, stop):
                if j < inner or j >= beyond:
                    far = -reach
                    for k in range(len(sides)):
                        far = max(far, sides[k, 0] * j * h + sides[k, 1] * i * h - sides[k, 2])
                    grid[i, j] = min(grid[i, j], far)


@compiled
def marched(grid: Any, level: float, h: float, out: Array) -> int:
    """How many segments the line at a level has; and they, (n, 2, 2), what is less to their left."""
    found, cross, into = 0, np.empty((4, 2)), np.empty(4, np.int64)
    for i in range(grid.shape[0] - 1):
        for j in range(grid.shape[1] - 1):
            a, b, c, d = grid[i, j], grid[i, j + 1], grid[i + 1, j + 1], grid[i + 1, j]
            if (a < level) == (b < level) == (c < level) == (d < level):
                continue
            at = ((a, 0, 0), (b, 1, 0), (c, 1, 1), (d, 0, 1), (a, 0, 0))
            count = 0
            for k in range(4):
                (p, px, py), (q, qx, qy) = at[k], at[k + 1]
                if (p < level) != (q < level):
                    share = (level - p) / (q - p)
                    cross[count, 0] = (j + px + share * (qx - px)) * h
                    cross[count, 1] = (i + py + share * (qy - py)) * h
                    into[count] = q < level
                    count += 1
            onward = count == 2 or 0.25 * (a + b + c + d) < level
            for k in range(count):
                if not into[k]:
                    if found < len(out):
                        out[found, 0] = cross[k]
                        out[found, 1] = cross[(k + 1) % count if onward else k - 1]
                    found += 1
    return found


@compiled
def seed(points: Array, h: float, nearest: Any, grid: Any) -> None:
    """Tell the four nodes about each point of it."""
    for n in range(len(points)):
        j, i = int(points[n, 0] / h), int(points[n, 1] / h)
        for y, x in ((i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1)):
            far = (points[n, 0] - x * h) ** 2 + (points[n, 1] - y * h) ** 2
            if far < grid[y, x]:
                grid[y, x], nearest[y, x] = far, n


@compiled
def heard(points: Array, h: float, i: int, above: int, back: bool, nearest: Any, grid: Any) -> None:
    """Let nodes of row i know of the points that the ones before them, and above them, know."""
    for column in range(1, grid.shape[1] - 1):
        j = grid.shape[1] - 1 - column if back else column
        if grid[i, j] < 0.0:
            continue
        for k in range(-1, 3):
            n = nearest[above, j + k] if k < 2 else nearest[i, j + 1 if back else j - 1]
            if n >= 0:
                far = (points[n, 0] - j * h) ** 2 + (points[n, 1] - i * h) ** 2
                if far < grid[i, j]:
                    grid[i, j], nearest[i, j] = far, n


@compiled
def handed_on(points: Array, h: float, nearest: Any, grid: Any) -> None:
    """Lower nodes that are not inside to the square of how far the nearest point is, m2."""
    last = len(grid) - 1
    for i in range(1, last):
        heard(points, h, i, i - 1, False, nearest, grid)
        heard(points, h, i, i - 1, True, nearest, grid)
    for i in range(last - 1, 0, -1):
        heard(points, h, i, i + 1, False, nearest, grid)
        heard(points, h, i, i + 1, True, nearest, grid)


def segments(grid: Any, level: float, h: float) -> Array:
    """The line where a grid is at a level, in pieces, (n, 2, 2), m from its first node."""
    out = np.empty((marched(grid, level, h, np.empty((0, 2, 2))), 2, 2))
    marched(grid, level, h, out)
    return out


def by_grid(asked: list[Dance], h: float) -> Found | float:
    """What a grid with cells and steps as fine as this, m, finds; how many nodes, if too many."""
    hulls = np.concatenate([hulls_of(walked_steps(*one, h).corners) for one in asked])
    corners, which = shapely.get_coordinates(shapely.orient_polygons(hulls), return_index=True)
    keep = np.append(which[1:] == which[:-1], False)  # rings end as they begin
    corners, first = corners[keep], np.flatnonzero(np.diff(which[keep], prepend=-1, append=len(hulls)))
    around = MARGIN + 4.0 * h
    origin = corners.min(axis=0) - around
    columns, rows = (np.ceil((corners.max(axis=0) + around - origin) / h) + 1.0).tolist()
    if rows * columns > MOST_NODES:
        return float(rows * columns)
    grid = np.full((int(rows), int(columns)), REACH * h, dtype=np.float32)
    mark(corners - origin, first, h, REACH * h, grid)
    outline = segments(grid, 0.0, h)
    (ax, ay), (bx, by) = outline[:, 0].T, outline[:, 1].T
    area = 0.5 * float(np.sum(ax * by - bx * ay))
    nearest = np.full(grid.shape, -1, dtype=np.int32)
    grid[:] = np.where(grid < 0.0, np.float32(-1.0), np.float32((MARGIN + 2.0 * h) ** 2))
    points = np.ascontiguousarray(outline[:, 0])
    seed(points, h, nearest, grid)
    handed_on(points, h, nearest, grid)
    return Found(area, outline + origin, segments(grid, MARGIN**2, h) + origin)


def by_union(asked: list[Dance], error: float, quarter: int | None = None) -> Found:
    """What Shapely finds; spectators' line by arcs of so many segments, or as `swept_area` has it."""
    found = [swept_area(*one, margin=MARGIN, error=error) for one in asked]
    ground = shapely.union_all([one.polygon for one in found])
    if quarter is None:
        line = shapely.union_all([one.spectators for one in found])
    else:
        line = shapely.buffer(ground, MARGIN, quad_segs=quarter)
    return Found(float(ground.area), pieces(ground), pieces(line))


def pieces(shape: BaseGeometry) -> Array:
    """The outlines of a shape as segments, (n, 2, 2), m."""
    points, which = shapely.get_coordinates(shapely.get_rings(shape), return_index=True)
    found: Array = np.stack([points[:-1], points[1:]], axis=1)[which[1:] == which[:-1]]
    return found


def told(name: str) -> float:
    """What Linux says of this process's memory, MB."""
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return next(float(line.split()[1]) / 1e3 for line in lines if line.startswith(name))


def farthest(points: Array, line: Array) -> float:
    """How far corners of one line, LOOKED of them, are from another line at most, m."""
    places = shapely.points(points[:: math.ceil(len(points) / LOOKED), 0])
    tree = shapely.STRtree(np.asarray(shapely.linestrings(line)))
    return float(tree.query_nearest(places, all_matches=False, return_distance=True)[1].max())


def length(line: Array) -> float:
    """Of a line in segments, m."""
    return float(np.hypot(*(line[:, 1] - line[:, 0]).T).sum())


def holding(line: Array) -> tuple[float, float]:
    """Area of the smallest rectangle, m2, and radius of the smallest circle, m, about an outline."""
    hull: Any = shapely.convex_hull(shapely.multipoints(line.reshape(-1, 2)))
    rectangle = float(shapely.area(shapely.minimum_rotated_rectangle(hull)))
    return rectangle, float(shapely.minimum_bounding_radius(hull))


def compare(name: str, asked: list[Dance]) -> None:
    """Print the rows of a dance."""
    true = by_union(asked, TRUTH, QUARTER)
    rectangle, circle = holding(true.outline)
    print(f"{name}: {true.area:.2f} m2, line {length(true.line):.2f} m, ", end="")
    print(f"rectangle {rectangle:.2f} m2, circle {circle:.3f} m")
    for error in ERRORS:
        for way, job in WAYS.items():
            ctypes.CDLL(None).malloc_trim(0)
            Path("/proc/self/clear_refs").write_text("5", encoding="ascii")  # forget the peak so far
            before, began = told("VmRSS"), time.process_time()
            found = job(asked, error)
            spent, memory = time.process_time() - began, told("VmHWM") - before
            print(f"{way:>6} {1e3 * error:3.0f} | ", end="")
            if isinstance(found, float):
                print(f"{found / 1e6:.0f} million nodes: not tried")
                return
            sizes = holding(found.outline)
            apart = max(farthest(found.line, true.line), farthest(true.line, found.line))
            print(f"{spent:7.2f} | {memory:6.0f} | {1e4 * (found.area - true.area):7.0f} | ", end="")
            print(f"{1e3 * farthest(found.outline, true.outline):5.2f} | {1e3 * apart:5.2f} | ", end="")
            print(f"{1e3 * (length(found.line) - length(true.line)):6.1f} | ", end="")
            print(f"{1e4 * (sizes[0] - rectangle):9.0f} | {1e3 * (sizes[1] - circle):6.2f}", flush=True)


WAYS: dict[str, Callable[[list[Dance], float], Found | float]] = {
    "grid": by_grid,
    "union": by_union,
}


def main() -> None:
    """Print the table."""
    swept_steps.MOST_STEPS, words = STEPS, sys.argv[1:]
    asked = {n: d for n, d in dances().items() if not words or any(word in n for word in words)}
    by_grid(next(iter(asked.values())), 0.2)  # compiles
    print("  way, mm | seconds |     MB |    area |   out |  line | length | rectangle | circle")
    print("          |         |        |     cm2 |    mm |    mm |     mm |       cm2 |     mm")
    for name, some in asked.items():
        compare(name, some)


if __name__ == "__main__":
    main()
