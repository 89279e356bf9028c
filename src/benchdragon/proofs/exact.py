"""The exact numbers of a walk, of which its proofs speak: as they are stored, or as written."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from flint import arb

from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.obstacle import ObstacleKind
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.proofs.apart import Side
from benchdragon.proofs.ball_route import BallRoute, Pair
from benchdragon.proofs.boxes import Boxes
from benchdragon.proofs.cells import Dance, Standing
from benchdragon.proofs.cover import Guess
from benchdragon.proofs.parts import Reading, as_stored, ball
from benchdragon.proofs.sizes import Sizes


@dataclass(frozen=True)
class Numbers:
    """The exact numbers of a walk.

    Attributes:
        walk: whose computed handles are guesses, and whose sizes, speeds and times are read.
        route: of all handles.
        start: the head's route position at time 0, m.
        read: the number that a double stands for: of sizes, speeds, times, margins and obstacles.
        outlines: corners of obstacles by their names, m, of which no double is to be read.
    """

    walk: Walk
    route: BallRoute
    start: arb
    read: Reading = as_stored
    outlines: Mapping[str, Sequence[Pair]] = field(default_factory=dict)

    @classmethod
    def stored(cls, walk: Walk) -> "Numbers":
        """Those of a walk whose stored doubles are taken for exact."""
        return cls(walk, BallRoute.stored(walk.route.rows), arb(walk.start))

    @cached_property
    def sizes(self) -> Sizes:
        """Of the benches."""
        length, width, front, rear = (self._balls(column) for column in self.walk.dragon.sizes)
        return Sizes.of(length, width, front, rear)

    def position(self, t: float) -> arb:
        """The head's route position at time t, s, m."""
        return self.start + ball(self.walk.profile.exact_distance(t, self.read))

    def at_most(self, t: float) -> float:
        """A double at most the head's route position at a time, m."""
        s = self.position(t)
        return stepped(float(s), lambda value: value <= s, -math.inf)

    def at_least(self, t: float) -> float:
        """A double at least the head's route position at a time, m."""
        s = self.position(t)
        return stepped(float(s), lambda value: value >= s, math.inf)

    def before(self, s: float) -> float:
        """A time, s, at which the head has not passed route position s, m."""
        return stepped(self.walk.time_at(s), lambda t: self.position(t) <= s, -math.inf)

    def after(self, s: float) -> float:
        """A time, s, at which the head has come to route position s, m."""
        return stepped(self.walk.time_at(s), lambda t: self.position(t) >= s, math.inf)

    def dance(self, margin: float | None, obstacles: Sequence[Obstacle] = ()) -> Dance:
        """What is walked; `margin`: that benches keep from one another, m, None for any."""
        walk = self.walk
        x, y = walk.placement(walk.start, throw=False).x[0, 0], walk.placement(walk.start).y[0, 0]
        origin = float(x), float(y)
        stands = tuple(self._standing(obstacle, origin) for obstacle in obstacles)
        kept = None if margin is None else self.number(margin)
        return Dance(self.route, self.sizes, kept, stands, origin)

    def number(self, value: float) -> arb:
        """What a double stands for, as a ball."""
        return ball(self.read(value))

    def guess(self, s: float) -> tuple[Sequence[int], FloatArray]:
        """Computed rows and parameters of all handles, the head at route position s, m."""
        rows, at = self.walk.placement(s).state(0)
        return rows.tolist(), at

    def _balls(self, values: FloatArray) -> list[arb]:
        known: dict[float, arb] = {}
        return [known.setdefault(value, self.number(value)) for value in values.tolist()]

    def _standing(self, obstacle: Obstacle, origin: tuple[float, float]) -> Standing:
        points, corners = obstacle.walls, self.outlines.get(obstacle.name)
        if corners is None or obstacle.open is not None:
            corners = [(self.number(x), self.number(y)) for x, y in points.tolist()]
        if obstacle.kind == "circle":
            ends = [(0, 0)]
        else:
            ends = [(n, (n + 1) % len(corners)) for n in range(len(corners))]
            ends = ends[:-1] if obstacle.sort == ObstacleKind.LINE else ends
        sides = [Side(corners[a], corners[b]) for a, b in ends]
        starts, stops = (points[[end[n] for end in ends]] - np.array(origin) for n in (0, 1))
        edged = obstacle.sort not in (ObstacleKind.CIRCLE, ObstacleKind.LINE)
        inside = obstacle.kind == "venue" if edged else None
        kept = self.number(obstacle.margin) + self.number(obstacle.radius)
        return Standing(sides, kept, Boxes.between(starts, stops), inside)


def stepped(value: float, holds: Callable[[float], bool], towards: float) -> float:
    """The first double that holds from a value on, by steps that double."""
    step, at = math.ulp(value), value
    while not holds(at):
        at = value + math.copysign(step, towards)
        step *= 2.0
    return at


def stored_dance(walk: Walk, margin: float | None, obstacles: Sequence[Obstacle] = ()) -> Dance:
    """A walk whose stored numbers are taken for exact; `margin`: between benches, m, None for any."""
    return Numbers.stored(walk).dance(margin, obstacles)


def guess_of(walk: Walk) -> Guess:
    """Computed handles of a walk, as guesses."""
    return Numbers.stored(walk).guess
