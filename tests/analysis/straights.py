"""Benches on a straight line, and what stands beside it: touches are known in advance."""

from benchdragon import Dragon, Line, Route, Walk
from benchdragon.model.obstacle import Obstacle

# Five benches of 2 m by 0.5 m, the front of each 0.25 m ahead of its front handle, on a line.
EAST = Route((Line(100.0),))
FIVE = Dragon.of_sizes([2.0] * 5, 0.5, 0.25, 0.25)
ONE = Dragon.of_sizes([2.0], 0.5, 0.25, 0.25)


def east(dragon: Dragon = FIVE, start: float = 10.0) -> Walk:
    return Walk(dragon, EAST, start=start)


def wall(x: float, low: float = -2.0, high: float = 2.0, margin: float = 0.0) -> Obstacle:
    return Obstacle.line("wall", [(x, low), (x, high)], margin)


def kerb(y: float, start: float = -50.0, end: float = 150.0, margin: float = 0.0) -> Obstacle:
    return Obstacle.line("kerb", [(start, y), (end, y)], margin)
