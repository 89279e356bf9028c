"""A random dance as its question lays it, made here from the same kernels: to be looked at densely."""

from dataclasses import dataclass

import numpy as np

from benchdragon.kernels import stray_line
from benchdragon.kernels.box import nearest_pair
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import COLUMNS, FloatArray
from benchdragon.kernels.random_dance_bound import (
    FACTS,
    WAYS,
    Bound,
    bounds,
    fill_parts,
    prepare,
    stretch_count,
    table_sizes,
)
from benchdragon.kernels.random_numbers import Random
from benchdragon.kernels.stray_chain import place_along
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon
from benchdragon.plans.schema import Plan
from benchdragon.solve.tolerance import Draw


@dataclass(frozen=True)
class Line:
    """A line beside a route: its rows, and points in pairs along the route and along it, m."""

    rows: FloatArray
    points: FloatArray
    along: FloatArray


@dataclass(frozen=True)
class Laid:
    """A dance: benches, rows of its line, how far aside handles walk, the head's way along it, m."""

    dragon: Dragon
    rows: FloatArray
    aside: FloatArray
    start: float
    end: float


def noise_of(draw: Draw, way: float) -> FloatArray:
    """What makes the line of a dance stray over a way, m."""
    noise = np.empty(stray_line.noise_count(way))
    stray_line.fill_noise(draw.seed, draw.number, noise)
    return noise


def line_beside(route: Route, draw: Draw, low: float, end: float) -> Line:
    """The line of a dance beside a route from `low` to `end`, m."""
    noise, most = noise_of(draw, end - low), 1_000_000
    points = np.empty(stray_line.lay_points(route.rows, low, end, np.empty(0), most))
    assert stray_line.lay_points(route.rows, low, end, points, most) == points.size
    rows, along = np.empty((2 * points.size - 1, COLUMNS)), np.empty(points.size)
    stray_line.lay_line(route.rows, points, noise, draw.deviations.stray, rows, along)
    return Line(rows, points, along)


def laid(plan: Plan, draw: Draw) -> Laid:
    """A dance of a plan."""
    walk = plan.build()
    dragon, route = draw.dragon(walk.dragon), walk.route
    start, end = walk.head_position(list(plan.span(walk))).tolist()
    aside = np.empty(0)
    if draw.deviations.aside or draw.deviations.stray:
        aside = draw.deviations.aside * draw.noise(Random.ASIDE, len(dragon) + 1)
    if not draw.deviations.stray:
        return Laid(dragon, route.rows, aside, start, end)
    low = start - WAYS * float(dragon.links.sum()) - stray_line.STRAY_LENGTH
    line = line_beside(route, draw, low if route.extension else max(low, 0.0), end)
    start, end = np.interp([start, end], line.points, line.along).tolist()
    return Laid(dragon, line.rows, aside, start, end)


def brute(dance: Laid, step: float = 5e-3) -> float:
    """The least distance at places of the head so far apart, each chain followed on from the last."""
    least = np.inf
    grid = np.linspace(dance.start, dance.end, 2 + int((dance.end - dance.start) / step))
    for at in np.array_split(grid, 1 + len(grid) // 500):
        places = empty_placements(len(dance.dragon) + 1, len(at))
        assert place_along(dance.rows, dance.dragon.links, dance.aside, at, places) == len(at)
        least = min(least, nearest_pair(dance.dragon.sizes, places.x, places.y)[0])
    return float(least)


def empty_bound(benches: int, radii: int, grids: int, strays: bool) -> Bound:
    """Room for a bound on so many benches, with tables so long."""
    grids = grids if strays else 0
    rows = (np.empty(benches + more) for more in (1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1))
    return Bound(np.empty(FACTS), np.empty(radii), np.empty(grids), np.empty(grids), *rows)


def open_parts(plan: Plan, draw: Draw, wanted: tuple[float, ...]) -> list[FloatArray]:
    """For each distance, m, the parts of a dance outside which no two benches come so near.

    Along its line.
    """
    walk = plan.build()
    dragon, route = draw.dragon(walk.dragon), walk.route
    first, last = walk.head_position(list(plan.span(walk))).tolist()
    count, links, stray = len(dragon), dragon.links, draw.deviations.stray
    assert bounds(route.rows, count)
    bound = empty_bound(count, *table_sizes(first, last, float(links.sum())), bool(stray))
    noise = noise_of(draw, last - first + 2.0 * float(links.sum()) + 20.0)
    aside = laid(plan, draw).aside
    assert prepare(bound, route.rows, links, dragon.sizes, aside, noise, stray, first, last)
    found = []
    for each in wanted:
        parts = np.empty((stretch_count(first, last, float(links.min())), 3))
        parts = parts[: fill_parts(bound, links, dragon.sizes, each, parts)]
        if stray:
            low = first - 1.1 * float(links.sum()) - 10.0
            line = line_beside(route, draw, low, last)
            parts[:, :2] = np.interp(parts[:, :2], line.points, line.along)
        found.append(parts)
    return found
