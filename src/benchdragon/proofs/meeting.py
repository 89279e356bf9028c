"""Bodies that surely come nearer than allowed: proved at one head position."""

from collections.abc import Sequence
from itertools import product

from flint import arb

from benchdragon.proofs.apart import Bench, Body, Moving, Side
from benchdragon.proofs.ball_route import Pair
from benchdragon.proofs.cells import Standing
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.sizes import Sizes


def nearer(chain: Chain, sizes: Sizes, bodies: Sequence[Body], margin: arb) -> bool:
    """Whether two bodies are surely nearer than `margin`, m, or cross each other."""
    one, other = (body.place(chain, sizes) for body in bodies)
    near = any(
        _square_to(corner, box) < margin * margin
        for box, points in ((one, other.corners), (other, one.corners))
        for corner in points
    )
    return near or any(_cross(a, b) for a, b in product(_sides(one), _sides(other)))


def _square_to(point: Pair, box: Bench) -> arb:
    """The square of the distance from a point to a bench, m^2, from above; below 0 deep inside it."""
    first, second, third, _fourth = box.corners
    x, y = (sum((corner[n] for corner in box.corners), arb(0)) / 4 - point[n] for n in (0, 1))
    long = (second[0] - third[0]) * box.ahead[0] + (second[1] - third[1]) * box.ahead[1]
    wide = (first[1] - second[1]) * box.ahead[0] - (first[0] - second[0]) * box.ahead[1]
    over = (
        abs(x * box.ahead[0] + y * box.ahead[1]) - long / 2,
        abs(y * box.ahead[0] - x * box.ahead[1]) - wide / 2,
    )
    if all(value < 0 for value in over):
        return arb(-1)
    along, across = (value.max(arb(0)) for value in over)
    return along * along + across * across


def _sides(box: Bench) -> list[tuple[Pair, Pair]]:
    return list(zip(box.corners, [*box.corners[1:], box.corners[0]], strict=True))


def _cross(one: tuple[Pair, Pair], other: tuple[Pair, Pair]) -> bool:
    """Whether two lines surely cross, each with its ends on both sides of the other."""
    return all(
        _side(line, ends[0]) * _side(line, ends[1]) < 0 for line, ends in ((one, other), (other, one))
    )


def _side(line: tuple[Pair, Pair], point: Pair) -> arb:
    (ax, ay), (bx, by) = line
    return (bx - ax) * (point[1] - ay) - (by - ay) * (point[0] - ax)


def belongs(chain: Chain, sizes: Sizes, i: int, standing: Standing) -> bool | None:
    """Whether bench number i is on the right side of the obstacles; None where that is undecided."""
    if standing.inside is None:
        return True
    corners = Moving(i).place(chain, sizes).corners
    (ax, ay), (bx, by) = corners[0], corners[2]
    points = [*corners, ((ax + bx) / 2, (ay + by) / 2)]  # one may lie level with a corner, or on a side
    found = next((one for p in points if (one := lies_inside(p, standing.sides)) is not None), None)
    return None if found is None else found is standing.inside


def lies_inside(point: Pair, sides: Sequence[Side]) -> bool | None:
    """Whether a point lies inside the polygon of these sides; None where rounding leaves it undecided.

    By the sides that a ray to the right of it crosses.
    """
    crossed = 0
    for side in sides:
        (ax, ay), (bx, by) = side.start, side.end
        if (ay > point[1] and by > point[1]) or (ay < point[1] and by < point[1]):
            continue
        if (ax < point[0] and bx < point[0]) and not (ay == point[1] or by == point[1]):
            continue
        turn = _side((side.start, side.end), point)
        if not (ay < point[1] < by or ay > point[1] > by) or not (turn < 0 or turn > 0):
            return None
        crossed += int((turn > 0) == (ay < by))
    return crossed % 2 == 1
