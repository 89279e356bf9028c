"""Random dances past random obstacles, against dense sampling with shapely.

`python -m tests.laws.random_squares 1500` tries so many and counts how they end.
"""

import math
import sys
from collections import Counter
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import shapely

from benchdragon import (
    Arc,
    Clothoid,
    Dragon,
    Line,
    Route,
    SpeedProfile,
    Spiral,
    UnsureError,
    Walk,
    WalkError,
)
from benchdragon.analysis.obstacles import ObstacleAnswers, obstacle_answers
from benchdragon.model.curves import AnyCurve
from benchdragon.model.obstacle import Obstacle

Float = npt.NDArray[np.float64]

# Of sampling, m of the head's way; the fewest samples; and how near they come to the first touch.
STEP, FEWEST, NEAREST = 0.05, 150, 1e-9
# What is left to rounding, m.
ROUNDING = 1e-9
# How far what lies outside of a venue reaches, m.
BEYOND = 1e3
PROFILES = (
    SpeedProfile.constant(1.0),
    SpeedProfile((0.0, 3.0, 5.0, 8.0, 12.0), (0.5, 1.5, 0.0, 0.0, 1.2)),
)
KINDS = ("circle", "rectangle", "polygon", "line", "venue")


@dataclass(frozen=True)
class Square:
    """A walk, the times between which it is looked at, s, and what stands in its way."""

    walk: Walk
    start: float
    end: float
    obstacle: Obstacle


def random_dragon(rng: np.random.Generator) -> Dragon:
    """Of 1 to 14 benches: all of one size, each of its own, or one far longer than the others."""
    count = int(rng.integers(1, 15))
    mixed = rng.integers(3)
    length = rng.uniform(0.8, 2.4, count) if mixed == 1 else np.full(count, rng.uniform(0.8, 2.4))
    if mixed == 2:
        length[int(rng.integers(count))] *= rng.uniform(1.5, 4.0)
    width = rng.uniform(0.1, 0.9, count) if mixed == 1 else rng.uniform(0.1, 0.9)
    inset = rng.uniform(0.03, 0.2) * length.min()
    return Dragon.of_sizes(length, width, inset, inset * rng.uniform(0.3, 1.0))


def random_route(rng: np.random.Generator, dragon: Dragon) -> Route:
    """A spiral, or parts that bend gently enough, joined smoothly or with small kinks."""
    longest = float(dragon.links.max())
    if rng.random() < 0.3:
        pitch = rng.uniform(0.8, 2.0)
        turns = 1.2 * longest / pitch + rng.uniform(0.0, 2.0)
        return Route((Spiral.between(pitch, turns + rng.uniform(1.0, 4.0), turns),))
    parts: list[AnyCurve] = [Line(float(rng.uniform(1.0, 8.0)))]
    for _part in range(int(rng.integers(2, 6))):
        bend = float(rng.choice([-1.0, 1.0]) / (longest * rng.uniform(1.1, 4.0)))
        sweep = float(rng.uniform(0.4, 4.0))
        kind = rng.integers(3)
        if kind == 0:
            parts.append(Arc(1.0 / abs(bend), math.copysign(sweep, bend)))
        elif kind == 1:
            ease = float(rng.uniform(0.5, 3.0))
            parts += [Clothoid(ease, 0.0, bend), Clothoid(ease, bend, 0.0)]
        else:
            parts.append(Line(float(rng.uniform(1.0, 6.0))))
    if rng.random() < 0.2:
        return kinked(parts, rng)
    return Route.joined([*parts, Line(float(rng.uniform(1.0, 8.0)))])


def kinked(parts: list[AnyCurve], rng: np.random.Generator) -> Route:
    """The parts joined with kinks of up to a tenth of a radian, as drawings have them."""
    curves: list[AnyCurve] = []
    at, heading = (0.0, 0.0), 0.0
    for part in parts:
        curves.append(part.moved(at, heading))
        at, heading = curves[-1].end_pose
        heading += float(rng.uniform(-0.1, 0.1))
    return Route(tuple(curves), kinks=True)


def random_obstacle(rng: np.random.Generator, near: Float, middle: Float) -> Obstacle:
    """Of any kind, m from the place `near`; a venue stands about the middle of the dance."""
    kind = KINDS[int(rng.integers(len(KINDS)))]
    size, angle = float(10.0 ** rng.uniform(-2.0, 0.3)), float(rng.uniform(0.0, 2.0 * math.pi))
    margin = float(rng.choice([0.0, 0.0, 0.05, 0.4]))
    away = near + rng.normal(0.0, 0.8, 2)
    centre = (float(away[0]), float(away[1]))
    if kind == "circle":
        return Obstacle.circle("well", centre, size, margin)
    if kind == "rectangle":
        return Obstacle.rectangle("car", centre, (size, size * rng.uniform(0.1, 2.0)), angle, margin)
    corners = int(rng.integers(3, 9)) if rng.random() < 0.9 else 400
    turns = (np.arange(corners) + rng.uniform(0.0, 0.45, corners)) * 2.0 * math.pi / corners
    ring = np.column_stack([np.cos(turns), np.sin(turns)]) * rng.uniform(0.4, 1.0, (corners, 1))
    if kind == "polygon":
        return Obstacle.polygon("house", away + size * ring, margin)
    if kind == "line":
        return Obstacle.line("rope", away + size * rng.normal(0.0, 1.0, (corners, 2)), margin)
    reach = float(np.hypot(*(near - middle))) * rng.uniform(0.4, 1.2) + 1.0
    edge = np.column_stack([np.cos(turns), np.sin(turns)]) * rng.uniform(1.5, 2.5, (corners, 1))
    return Obstacle.venue("square", middle + reach * edge, margin)


def random_square(seed: int) -> Square:
    rng = np.random.default_rng((18, seed))
    dragon = random_dragon(rng)
    route = random_route(rng, dragon)
    far = float(rng.choice([0.0, 0.0, 0.0, 1e5]))
    if far:
        route = route.moved(float(rng.uniform(0.0, 6.0)), (far, -0.3 * far))
    first = float(route.length * rng.uniform(0.0, 0.4))
    walk = Walk(dragon, route, PROFILES[int(rng.integers(len(PROFILES)))], first)
    start = float(rng.choice([0.0, 0.0, 2.5]))
    end = walk.time_at(first + (route.length - first) * rng.uniform(0.5, 1.0))
    way = route.point(np.linspace(0.0, route.length, 9))
    near = route.point(first + (route.length - first) * rng.uniform(0.2, 1.0))
    return Square(walk, min(start, end), end, random_obstacle(rng, near, way.mean(axis=0)))


def shape(obstacle: Obstacle) -> shapely.Geometry:
    """What benches must keep away from; of a circle its centre, of a venue all that is outside."""
    if obstacle.kind == "circle":
        return shapely.Point(obstacle.outline[0])
    if obstacle.kind == "line":
        return shapely.LineString(obstacle.outline)
    inside = shapely.Polygon(obstacle.outline)
    if obstacle.kind != "venue":
        return inside
    west, south, east, north = inside.bounds
    around = shapely.box(west - BEYOND, south - BEYOND, east + BEYOND, north + BEYOND)
    return shapely.difference(around, inside)


def distances(square: Square, times: Float) -> Float:
    """How far the nearest bench is from the obstacle at each time, m; 0 where one touches it."""
    motion, solid = square.walk.motion(times), shape(square.obstacle)
    shapely.prepare(solid)
    out = np.empty(len(times))
    for t in range(len(times)):
        benches = motion[t].outlines()[0]
        out[t] = shapely.distance(benches, solid).min() - square.obstacle.radius
    return np.maximum(out, 0.0)


def sampled_times(square: Square, until: float) -> Float:
    """Times from the start to `until`, s, ever denser towards it."""
    way = float(np.diff(square.walk.head_position([square.start, until]))[0])
    even = np.linspace(square.start, until, max(FEWEST, int(way / STEP)), endpoint=False)
    return np.concatenate([even, np.maximum(until - np.geomspace(NEAREST, 1.0, 30), square.start)])


def fault(square: Square, said: ObstacleAnswers) -> str:
    """What sampling has against the answers; empty if nothing."""
    margin, touch, least = square.obstacle.margin, said.contact, said.distance
    rounding = ROUNDING * max(1.0, float(np.abs(square.obstacle.outline).max()) / 1e4)
    until = square.end if touch is None else touch.lower
    seen = distances(square, sampled_times(square, square.end))
    if seen.min() < least.lower - rounding:
        return f"seen {seen.min()} m away, told at least {least.lower} m"
    if not least.lower <= least.value <= least.upper:
        return "the least distance is outside of its bracket"
    assert least.witness is not None
    assert least.witness.time is not None
    there = distances(square, np.array([least.witness.time]))[0]
    if abs(there - least.value) > rounding:
        return f"told {least.value} m at {least.witness.time} s, seen {there} m"
    if until > square.start:
        before = distances(square, sampled_times(square, until))
        if (before < margin - rounding if margin else before <= 0.0).any():
            return f"touched before {until} s"
    if touch is None:
        return "" if least.upper >= margin else "the least distance is below the margin"
    if not touch.lower <= touch.value <= touch.upper:
        return "the time is outside of its bracket"
    if distances(square, np.array([touch.upper]))[0] > margin + rounding:
        return f"not touched at {touch.upper} s"
    return ""


def outcome(square: Square) -> ObstacleAnswers | WalkError | UnsureError:
    """What the search says of it."""
    try:
        return obstacle_answers(square.walk, square.obstacle, square.start, square.end)
    except (WalkError, UnsureError) as error:
        return error


def ending(said: ObstacleAnswers | WalkError | UnsureError) -> str:
    """How a search ended, in a word."""
    if not isinstance(said, ObstacleAnswers):
        return type(said).__name__
    if said.contact is None:
        return "clear"
    return "touching at the start" if said.contact.upper == said.contact.lower else said.contact.status


def tried(numbers: range) -> tuple[Counter[str], list[str]]:
    """How the squares of these numbers end, and what sampling has against them."""
    endings: Counter[str] = Counter()
    faults: list[str] = []
    for number in numbers:
        square = random_square(number)
        said = outcome(square)
        endings[ending(said)] += 1
        endings[square.obstacle.kind] += 1
        if isinstance(said, ObstacleAnswers) and (wrong := fault(square, said)):
            faults.append(f"{number}: {wrong}")
    return endings, faults


if __name__ == "__main__":
    found, wrong = tried(range(int(sys.argv[1])))
    print(*wrong, dict(found), sep="\n")
    sys.exit(bool(wrong))
