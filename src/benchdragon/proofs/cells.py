"""A cell: the head goes from one place to another, and nothing comes nearer than it may."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb

from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.apart import Body, Moving, Side, curved_apart
from benchdragon.proofs.approach import Approach
from benchdragon.proofs.ball_route import BallRoute
from benchdragon.proofs.boxes import LINES, Boxes, IntArray, gaps, near_pairs, near_sides, reach
from benchdragon.proofs.chain import Chain, UnprovedError
from benchdragon.proofs.motion import SLACK, follows, moves, nearest
from benchdragon.proofs.pace import slower
from benchdragon.proofs.sizes import Sizes


@dataclass(frozen=True)
class Standing:
    """Sides that stand still, and the distance that benches keep from them, m.

    Attributes:
        boxes: the sides as rectangles without width, (n,), about the dance's origin.
        inside: whether benches belong inside, as in a venue, or outside; None where there is no inside
            but what is nearer than the margin.
    """

    sides: Sequence[Side]
    margin: arb
    boxes: Boxes
    inside: bool | None


@dataclass(frozen=True)
class Dance:
    """The exact data of a walk.

    Attributes:
        route: of all handles.
        sizes: of the benches.
        margin: the distance that benches keep from one another, m; None: it is not proved.
        standing: the obstacles.
        origin: near the dance, m: doubles are taken relative to it.
        most: how fast handles may be with the head at 1 m/s, m/s; None: it is not proved.
    """

    route: BallRoute
    sizes: Sizes
    margin: arb | None
    standing: Sequence[Standing]
    origin: tuple[float, float]
    most: arb | None = None


# The first benches of a dance, so many, with the head at a route position, m; raises UnprovedError.
Between = Callable[[float, int], Chain]

# How often the way between two chains is halved for pairs in doubt, and for how many of these at most;
# for so many their second derivative is enclosed before.
HALVINGS, MOST_HALVED, FEW = 3, 100, 2
# Roundings in a corner of a bench, or a gap: so many units of the farthest coordinate, and of s.
CORNER_ROUNDING, WAY_ROUNDING = 2.5e-15, 2.5e-16


def resolved(dance: Dance, *chains: Chain) -> bool:
    """Whether doubles hold all corners and places to SLACK: not far from the origin on a long lever."""
    links, front, rear, width = dance.sizes.numbers
    lever = 1.0 + float(((front + rear + width) / links).max())
    places = [np.abs(values).max() for chain in chains for values in (chain.x, chain.y)]
    places += [np.abs(one.boxes.ends).max() for one in dance.standing]
    places += [links.max(), front.max(), rear.max(), width.max()]
    way = max(float(np.abs(chain.s).max()) for chain in chains)
    return max(CORNER_ROUNDING * lever * float(max(places)), WAY_ROUNDING * way) <= SLACK


def holds(dance: Dance, a: Chain, b: Chain, *, between: Between | None = None) -> bool:
    """Whether the dragon surely walks from one chain to the next, and nothing comes too near.

    If chains `between` can be had, the way is halved for benches that both ends leave in doubt.
    """
    way, links = moves(a, b), dance.sizes.numbers[0]
    if not resolved(dance, a, b) or not follows(a, b, links, way):
        return False
    if not nearest(a, b, dance.route, links, way):
        return False
    if dance.most is not None and not slower(a, b, dance.route, dance.sizes.links, dance.most):
        return False
    if dance.margin is None and not dance.standing:
        return True
    room = reach(way, dance.sizes)
    boxes = Boxes.of((a, b), dance.sizes)
    if dance.margin is not None:
        pairs = near_pairs(boxes.first, room, float(dance.margin))
        doubtful = unsure((a, b), dance.sizes, boxes, boxes, pairs, way, dance.margin)
        if not _keep_apart(dance, (a, b), dance.margin, doubtful, between, HALVINGS):
            return False
    return all(_keeps_off(dance, one, (a, b), boxes, way, room) for one in dance.standing)


def _keeps_off(
    dance: Dance, standing: Standing, chains: tuple[Chain, Chain], boxes: Boxes, way: FloatArray,
    room: FloatArray,
) -> bool:  # fmt: skip
    """Whether all benches keep their distance from the obstacles."""
    pairs = near_sides(boxes.first, standing.boxes, room, float(standing.margin))
    doubtful = unsure(chains, dance.sizes, boxes, standing.boxes, pairs, way, standing.margin)
    bodies = [(Moving(int(i)), standing.sides[int(k)]) for i, k in doubtful]
    return _curved(dance, *chains, bodies, standing.margin)


def unsure(
    chains: tuple[Chain, Chain], sizes: Sizes, boxes: Boxes, others: Boxes, pairs: IntArray,
    way: FloatArray, margin: arb,
) -> IntArray:  # fmt: skip
    """Which pairs, of benches or of a bench and a side, are not surely farther apart.

    `boxes` are benches at both chains, (2, N); `others` the same, or sides, (n,).
    """
    far, room = float(margin) + 10.0 * SLACK, reach(way, sizes)
    approach = Approach(chains, boxes, sizes, way)
    for lines in (LINES[:4], LINES[4:]):
        i, j = pairs.T
        found = gaps(boxes.at(i), others.at(j), lines)
        size, moved = found.size.mean(1), room[i] + room[j] if others is boxes else room[i]
        kept = size.max(0) - 0.5 * moved > far
        for best in np.argsort(-size, axis=0):  # the way along a line is bounded only where needed
            near = np.flatnonzero(~kept)
            if not len(near):
                break
            which = best[near], slice(None), near
            x, y = found.x[which].T, found.y[which].T
            nearer = approach.along(i[near], x, y)
            if others is boxes:
                nearer += approach.along(j[near], -x, -y)
            kept[near] = size[best[near], near] - 0.5 * nearer > far
        pairs = pairs[~kept]
        if not len(pairs):
            break
    return pairs


def _keep_apart(
    dance: Dance, ends: tuple[Chain, Chain], margin: arb, pairs: IntArray, between: Between | None,
    halvings: int,
) -> bool:  # fmt: skip
    """Whether pairs of benches in doubt keep a margin, m, between two chains, or in halves of the way.

    The chain in the middle is that of the walk: its handles lie between those at the ends, which follow
    one another, and of places between these one alone is a link behind the handle ahead.
    """
    many = len(pairs) > MOST_HALVED
    if len(pairs) <= FEW or many or not halvings or between is None:
        bodies = [(Moving(int(i)), Moving(int(j))) for i, j in pairs]
        if _curved(dance, *ends, bodies, margin):
            return True
    if many or not halvings or between is None:
        return False
    count = int(pairs.max()) + 1
    first, last = (chain.first(count) for chain in ends)
    sizes = dance.sizes.first(count)
    try:
        middle = between(0.5 * float(first.s[0] + last.s[0]), count)
    except UnprovedError:
        return False
    if not resolved(dance, middle):
        return False
    for half in ((first, middle), (middle, last)):
        way = moves(*half)
        if not follows(*half, sizes.numbers[0], way):
            return False
        boxes = Boxes.of(half, sizes)
        doubtful = unsure(half, sizes, boxes, boxes, pairs, way, margin)
        if not _keep_apart(dance, half, margin, doubtful, between, halvings - 1):
            return False
    return True


def _curved(dance: Dance, a: Chain, b: Chain, pairs: Sequence[tuple[Body, Body]], margin: arb) -> bool:
    return all(curved_apart(a, b, dance.route, dance.sizes, pair, margin) for pair in pairs)
