"""Where benches exactly are, in balls of 128 bits, beside where the kernels put them."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest

pytest.importorskip("flint")
from flint import arb

from benchdragon import Dragon, Walk
from benchdragon.analysis.distance import boxes
from benchdragon.analysis.nearby import errors_at
from benchdragon.kernels.box import corner
from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.ball_route import BallRoute, Pair
from benchdragon.proofs.chain import Chain, enclosed_chain

# Corners of a bench as kernels/box.py goes round them: whether at its front, and on which side.
CORNERS = ((True, 1), (False, 1), (False, -1), (True, -1))


def exact_links(dragon: Dragon) -> list[arb]:
    """From hole to hole of each bench, m."""
    sizes = dragon.sizes.tolist()
    return [
        arb(length) - arb(front) - arb(rear)
        for length, front, rear in zip(sizes[0], sizes[2], sizes[3], strict=True)
    ]


def exact_chain(walk: Walk, s: float) -> Chain:
    """The exact chain of the head at the place that the kernels find for route position s, m."""
    row, u = walk.placement(s).state(0)
    route = BallRoute.stored(walk.route.rows)
    head = route.rows[int(row[0])].position(arb(float(u[0])))
    return enclosed_chain(route, exact_links(walk.dragon), head, (row.tolist(), u), (0.0, 0.0))


def exact_ratios(walk: Walk, s: float) -> list[float]:
    """Speed of each handle over the head's, from cosines in balls."""
    handles, ratio = exact_chain(walk, s).handles, arb(1)
    out = [1.0]
    for front, rear in pairwise(handles):
        dx, dy = front.pose[0] - rear.pose[0], front.pose[1] - rear.pose[1]
        ratio = ratio * (dx * front.pose[2] + dy * front.pose[3])
        ratio = ratio / (dx * rear.pose[2] + dy * rear.pose[3])
        out.append(float(ratio))
    return out


def exact_corners(walk: Walk, chain: Chain, i: int) -> list[Pair]:
    """Corners of bench i, m, in the order of kernels/box.py."""
    length, width, front, rear = (arb(float(size)) for size in walk.dragon.sizes[:, i])
    one, other = chain.handles[i].pose, chain.handles[i + 1].pose
    link = length - front - rear
    ux, uy = (one[0] - other[0]) / link, (one[1] - other[1]) / link
    corners = []
    for ahead, side in CORNERS:
        along, across = front if ahead else front - length, width * side / 2
        corners.append((one[0] + along * ux - across * uy, one[1] + along * uy + across * ux))
    return corners


@dataclass(frozen=True)
class Errors:
    """How far corners of benches are from where they exactly are, m, (N,), and what is said, (N,)."""

    found: FloatArray
    said: FloatArray

    @property
    def share(self) -> float:
        """The greatest share of what is said."""
        return float((self.found / self.said).max())


def corner_errors(walk: Walk, s: float) -> Errors:
    """The errors of all benches with the head at s, m, in the frame of the route's first row."""
    chain, table = exact_chain(walk, s), boxes(walk.placement(s), 0)
    _along, said = errors_at(walk, s, 0)
    found = np.zeros(len(walk.dragon))
    for i in range(len(walk.dragon)):
        for k, (exact_x, exact_y) in enumerate(exact_corners(walk, chain, i)):
            x, y = corner(table, i, k)
            off = math.hypot(float(arb(x) - exact_x), float(arb(y) - exact_y))
            found[i] = max(found[i], off)
    return Errors(found, said)


def exact_depth(walk: Walk, s: arb, near: float, i: int, j: int) -> arb:
    """How deep a corner of one of two benches lies in the other, m, the head at s near `near`, m."""
    row, u = walk.placement(near).state(0)
    route = BallRoute.stored(walk.route.rows)
    chain = enclosed_chain(route, exact_links(walk.dragon), s, (row.tolist(), u), (0.0, 0.0))
    deepest = arb(-math.inf)
    for mine, other in ((i, j), (j, i)):
        front_left, rear_left, rear_right, _front_right = exact_corners(walk, chain, other)
        x, y = (0.5 * (front_left[n] + rear_right[n]) for n in (0, 1))
        length, width = (float(size) for size in walk.dragon.sizes[:2, other])
        ux, uy = ((front_left[n] - rear_left[n]) / length for n in (0, 1))
        for px, py in exact_corners(walk, chain, mine):
            along, across = (px - x) * ux + (py - y) * uy, (py - y) * ux - (px - x) * uy
            inside = (length / 2 - abs(along)).min(width / 2 - abs(across))
            deepest = deepest.max(inside)
    return deepest


def exact_contact(walk: Walk, near: float, i: int, j: int) -> arb:
    """The head's route position, m, at which two benches that touch near one first do, to 1e-15 m."""
    low, high = arb(near) - 1e-7, arb(near) + 1e-7
    assert exact_depth(walk, low, near, i, j) < 0 < exact_depth(walk, high, near, i, j)
    while high - low > 1e-15:
        middle = ((low + high) / 2).mid()
        touches = exact_depth(walk, middle, near, i, j) > 0
        low, high = (low, middle) if touches else (middle, high)
    return high
