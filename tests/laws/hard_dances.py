"""Random dances that are hard to decide, against brute force: tight bends, mixed sizes, a long tail.

Their benches fold, leap or touch, often shortly one after another, or would if the walk went on; the
head starts and stops. `python -m tests.laws.hard_dances 5000` tries so many and counts how they end.
"""

import math
import sys
from collections import Counter
from dataclasses import dataclass

import numpy as np

from benchdragon import (
    Answer,
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
    first_contact,
)
from benchdragon.kernels.box import least_distance

# Of brute force, m of the head's way; and what is left to rounding.
STEP, ROUNDING = 0.01, 1e-9
PROFILES = (
    SpeedProfile.constant(1.0),
    SpeedProfile.constant(2.0),
    SpeedProfile((0.0, 4.0, 6.0, 9.0, 12.0), (0.5, 2.0, 0.0, 0.0, 1.5)),
)


@dataclass(frozen=True)
class Dance:
    """A walk from time 0 until the head is at `last`, m; benches are to keep `margin`, m."""

    walk: Walk
    last: float
    margin: float

    @property
    def end(self) -> float:
        return self.walk.time_at(self.last)


def random_dragon(rng: np.random.Generator) -> Dragon:
    count = int(rng.integers(3, 26))
    mixed = rng.integers(3) == 2
    length = rng.uniform(0.6, 2.6, count) if mixed else np.full(count, rng.uniform(0.6, 2.4))
    if rng.random() < 0.5:
        length[0] *= rng.uniform(1.0, 1.8)
    if rng.random() < 0.6:
        length[-1] = rng.uniform(1.0, 5.0)
    inset = rng.uniform(0.03, 0.2) * length.min()
    return Dragon.of_sizes(length, rng.uniform(0.1, 0.7), inset, inset * rng.uniform(0.3, 1.0))


def random_route(rng: np.random.Generator, dragon: Dragon) -> Route:
    usual, run = float(np.median(dragon.links)), float(dragon.links.sum()) + 5.0

    def radius() -> float:
        return float(rng.uniform(0.5, 1.6) * usual) + 0.03

    kind = int(rng.integers(5))
    middle: list[Line | Arc | Clothoid]
    if kind == 0:
        pitch = rng.uniform(0.4, 1.8)
        return Route((Spiral.between(pitch, rng.uniform(4.0, 9.0), rng.uniform(1.0, 3.0)),))
    if kind == 1:
        middle = [Arc(radius(), rng.uniform(1.0, 6.0))]
    elif kind == 2:
        middle = [Arc(radius(), rng.uniform(1.0, 4.5)), Arc(radius(), -rng.uniform(1.0, 4.5))]
    elif kind == 3:
        bend, ease = 1.0 / radius(), rng.uniform(0.5, 3.0)
        turn = Arc(1.0 / bend, rng.uniform(1.0, 6.0))
        middle = [Clothoid(ease, 0.0, bend), turn, Clothoid(ease, bend, 0.0)]
    else:
        middle = [Arc(radius(), math.pi), Line(rng.uniform(0.5, 6.0)), Arc(radius(), -math.pi)]
    return Route.joined([Line(run), *middle, Line(30.0)])


def dance(seed: int) -> Dance:
    rng = np.random.default_rng((77, seed))
    dragon = random_dragon(rng)
    route = random_route(rng, dragon)
    runs_on = isinstance(route.curves[0], Spiral)
    first = 0.0 if runs_on else float(dragon.links.sum()) * rng.uniform(0.0, 0.9)
    last = first + (route.length - first) * rng.uniform(0.1, 1.0)
    profile = PROFILES[int(rng.integers(len(PROFILES)))]
    return Dance(Walk(dragon, route, profile, first), last, float(rng.choice([0.0, 0.0, 0.05])))


def outcome(tried: Dance) -> Answer | WalkError | UnsureError | None:
    """What the search says of it."""
    try:
        return first_contact(tried.walk, 0.0, tried.end, margin=tried.margin)
    except (WalkError, UnsureError) as error:
        return error


def sampled(tried: Dance) -> tuple[float, float]:
    """The head's first sampled positions, m, at which benches are too near, and at which they fail."""
    at = np.arange(tried.walk.start, tried.last, STEP)
    placed = tried.walk.placement(at, throw=False)
    failed = np.flatnonzero(placed.status)
    stands = int(failed[0]) if failed.size else len(at)
    x, y = placed.x[:stands].T, placed.y[:stands].T
    sizes, near = tried.walk.dragon.sizes, math.inf
    for n in range(stands):
        one = (np.ascontiguousarray(table[:, n : n + 1]) for table in (x, y))
        if least_distance(sizes, *one) < tried.margin - ROUNDING:
            near = float(at[n])
            break
    return near, float(at[stands]) if stands < len(at) else math.inf


def fault(tried: Dance, said: Answer | WalkError | UnsureError | None) -> str:
    """What brute force has against the search; empty if nothing."""
    near, fails = sampled(tried)
    if isinstance(said, UnsureError):
        return ""
    if said is None:
        found = math.inf
    elif isinstance(said, WalkError):
        found = said.head
    else:
        assert said.witness is not None
        found = said.witness.s
    if min(near, fails) < found - 1e-6:
        return f"seen at {min(near, fails)} m, told at {found} m"
    return ""


if __name__ == "__main__":
    endings: Counter[str] = Counter()
    for number in range(int(sys.argv[1])):
        tried = dance(number)
        said = outcome(tried)
        endings[type(said).__name__] += 1
        if isinstance(said, UnsureError):
            print(number, said)
        if wrong := fault(tried, said):
            endings["wrong"] += 1
            print(number, wrong)
    print(dict(endings))
