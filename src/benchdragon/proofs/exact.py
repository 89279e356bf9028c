"""The numbers of a walk as balls: as they are stored."""

from collections.abc import Sequence

import numpy as np
from flint import arb

from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.proofs.apart import Side, Sizes
from benchdragon.proofs.ball_route import BallRoute
from benchdragon.proofs.cells import Dance, Standing
from benchdragon.proofs.cover import Guess


def stored_dance(walk: Walk, margin: float | None, obstacles: Sequence[Obstacle] = ()) -> Dance:
    """A walk whose stored numbers are taken for exact; `margin`: between benches, m, None for any."""
    sizes = (_balls(column) for column in walk.dragon.sizes)
    x, y = walk.placement(walk.start, throw=False).x[0, 0], walk.placement(walk.start).y[0, 0]
    origin = float(x), float(y)
    stands = tuple(_standing(obstacle, origin) for obstacle in obstacles)
    route = BallRoute.stored(walk.route.rows)
    return Dance(route, Sizes.of(*sizes), None if margin is None else arb(margin), stands, origin)


def guess_of(walk: Walk) -> Guess:
    """Computed handles of a walk, as guesses."""

    def guess(s: float) -> tuple[Sequence[int], FloatArray]:
        rows, at = walk.placement(s).state(0)
        return rows.tolist(), at

    return guess


def _balls(values: FloatArray) -> list[arb]:
    return [arb(value) for value in values.tolist()]


def _standing(obstacle: Obstacle, origin: tuple[float, float]) -> Standing:
    points = obstacle.outline.tolist()
    if obstacle.kind == "circle":
        ends = [(points[0], points[0])]
    else:
        ends = list(zip(points, [*points[1:], points[0]], strict=True))
        ends = ends[:-1] if obstacle.kind == "line" else ends
    sides = [Side((arb(a[0]), arb(a[1])), (arb(b[0]), arb(b[1]))) for a, b in ends]
    boxes = np.array([(a, a, b, b) for a, b in ends]) - np.array(origin)
    inside = None if obstacle.kind in ("circle", "line") else obstacle.kind == "venue"
    return Standing(sides, arb(obstacle.margin) + arb(obstacle.radius), boxes, inside)
