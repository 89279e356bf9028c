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


def ratios_of(chain: Chain) -> list[arb]:
    """Speed of each handle over the head's, from cosines in balls."""
    out = [arb(1)]
    for front, rear in pairwise(chain.handles):
        dx, dy = front.pose[0] - rear.pose[0], front.pose[1] - rear.pose[1]
        ahead = dx * front.pose[2] + dy * front.pose[3]
        out.append(out[-1] * ahead / (dx * rear.pose[2] + dy * rear.pose[3]))
    return out


def exact_ratios(walk: Walk, s: float) -> list[float]:
    """Speed of each handle over the head's."""
    return [float(ratio) for ratio in ratios_of(exact_chain(walk, s))]


@dataclass(frozen=True)
class Motion:
    """What benches exactly do with the head at 1 m/s: see `chain.rates`."""

    ratio: list[arb]
    change: list[arb]  # 1/m
    turn: list[arb]  # of each bench, rad/m
    bend: list[arb]  # the route's curvature at each handle, 1/m


def exact_motion(walk: Walk, s: float) -> Motion:
    """What benches exactly do, by the formulas of `chain.rates` in balls."""
    chain, links = exact_chain(walk, s), exact_links(walk.dragon)
    ratio, change, turn = ratios_of(chain), [arb(0)], []
    rows = BallRoute.stored(walk.route.rows).rows
    bend = [rows[handle.j].bend(handle.u) for handle in chain.handles]
    for i, (front, rear) in enumerate(pairwise(chain.handles)):
        dx, dy = ((front.pose[n] - rear.pose[n]) / links[i] for n in (0, 1))
        sine, rear_sine = (dx * end.pose[3] - dy * end.pose[2] for end in (front, rear))
        cosine, rear_cosine = (dx * end.pose[2] + dy * end.pose[3] for end in (front, rear))
        turn.append((ratio[i] * sine - ratio[i + 1] * rear_sine) / links[i])
        pulled = (ratio[n] * ratio[n] * bend[n] for n in (i, i + 1))
        along = change[i] * cosine - next(pulled) * sine + next(pulled) * rear_sine
        change.append((along + links[i] * turn[i] * turn[i]) / rear_cosine)
    return Motion(ratio, change, turn, bend)


def motion_by_differences(walk: Walk, s: float) -> tuple[list[float], list[float]]:
    """Accelerations along the route and turning rates of exact chains, by differences over 2e-9 m."""
    row, u = walk.placement(s).state(0)
    route, links, step = BallRoute.stored(walk.route.rows), exact_links(walk.dragon), arb("1e-9")
    head = route.rows[int(row[0])].position(arb(float(u[0])))
    before, after = (
        enclosed_chain(route, links, head + side * step, (row.tolist(), u), (0.0, 0.0))
        for side in (-1, 1)
    )
    both = zip(ratios_of(before), ratios_of(after), strict=True)
    change = [float((late - early) / (2 * step)) for early, late in both]
    turn = []
    for one, other, link in zip(pairwise(before.handles), pairwise(after.handles), links, strict=True):
        (ax, ay), (bx, by) = (
            [(front.pose[n] - rear.pose[n]) / link for n in (0, 1)] for front, rear in (one, other)
        )
        turn.append(float((ax * by - ay * bx) / (2 * step)))
    return change, turn


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
