"""Off-tracking: how far benches leave the route whose bearers follow the bench before them."""

import math
from typing import NamedTuple

import numpy as np

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.errors import not_negative, whole
from benchdragon.kernels.chain import empty_placements, march
from benchdragon.kernels.off_tracking import OFF_COLUMNS, see_offsets
from benchdragon.kernels.status import Status
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

# Steering gains between which bearers are taken to lie where none was measured, 1/m.
LEAST_GAIN, MOST_GAIN = 0.05, 1.0
# Length of a step as a share of the shortest link, and of 1 / gain, over which an offset falls to 37 %.
STEP = 0.1
# Places of handles that a step takes for each bench.
PLACES = 10.0


class BenchOffTracking(NamedTuple):
    """How far the rear handle of a bench leaves the route.

    Attributes:
        left: how far left of the route it comes, m, not negative.
        left_at: where the head is on the route then, m.
        left_error: how far `left` is off, m: an estimate, by what half the step changes, and by what
            changes in the step before and after.
        right: as `left`.
        right_at: as `left_at`.
        right_error: as `left_error`.

    Examples:
        >>> bend = bd.Route.joined([bd.Line(20.0), bd.Arc(5.0, degrees=90), bd.Line(20.0)])
        >>> walk = bd.Walk(bd.Dragon.uniform(3, head_length=2.1, body_length=2.1), bend)
        >>> one = bd.off_tracking(walk, 0.2).benches[2]
        >>> f"{one.left:.2f} m to the left, {one.right:.2f} m to the right"
        '0.46 m to the left, 0.00 m to the right'
    """

    left: float
    left_at: float
    left_error: float
    right: float
    right_at: float
    right_error: float


class OffTracking(NamedTuple):
    """How far benches leave the route.

    Attributes:
        gain: the steering gain, 1/m: on a straight line an offset falls to 37 % over 1 / gain.
        benches: each, from the head's on; none where a bend is too tight for bearers who walk so: a
            bench comes to stand square to the way of its front handle, and folds.

    Examples:
        >>> bd.off_tracking(bd.read_plan("turn", ["dragon.benches=5"]), 1.0).farthest()
        inf
    """

    gain: float
    benches: tuple[BenchOffTracking, ...]

    def farthest(self, first: int = 1) -> float:
        """How far benches from number `first` on come to either side at most, m, errors included.

        Infinite where one folds.

        Raises:
            InputError: for a bench that there is not.
        """
        if not self.benches:
            return math.inf
        whole("first", first, 1, len(self.benches))
        return max(
            max(one.left + one.left_error, one.right + one.right_error)
            for one in self.benches[first - 1 :]
        )


@budget.question()
def off_tracking(
    walk: Walk | Plan, gain: float, start: float | None = None, end: float | None = None
) -> OffTracking:
    """How far benches leave the route from start to end (s), if their bearers steer back with a gain.

    The front handle of the head keeps to the route, all others are on it at the start. Bearers are
    drawn along by the bench before them; sideways they come back at a rate of gain times their offset.
    With gain 0 they only follow, as trailers do. Neither contact nor momentum counts.

    Source: the pursuit curve of trailers without slip (a tractrix behind a straight pull), with a
    steering term that is proportional to the offset.

    Args:
        walk: a plan or a walk.
        gain: the steering gain, 1/m.
        start: s; else that of the walk.
        end: s; else that of the walk.

    Raises:
        InputError: for a gain that is negative or not finite.
        WalkError: if the dragon cannot stand at the start, or the head leaves the route.
        OverBudgetError: if that takes more work than a question may.

    Examples:
        >>> bend = bd.Route.joined([bd.Line(20.0), bd.Arc(5.0, degrees=90), bd.Line(50.0)])
        >>> walk = bd.Walk(bd.Dragon.uniform(30, head_length=2.1, body_length=2.1), bend)
        >>> [f"{bd.off_tracking(walk, gain).farthest(21):.2f} m" for gain in (0.05, 0.2, 1.0)]
        ['2.20 m', '0.76 m', '0.17 m']
    """
    walk, start, end = asked_of(walk, start, end)
    gain = not_negative("gain", gain)
    first, last = walk.head_position([start, end]).tolist()
    failure = walk.first_failure(np.array([first, last]))
    if failure is not None:
        raise failure
    rows, links = walk.route.rows, walk.dragon.links
    step = STEP * min(*links.tolist(), math.inf if gain == 0.0 else 1.0 / gain)
    steps = max(math.ceil(0.5 * (last - first) / step), 1)
    budget.spend(3.0 * PLACES * len(links) * steps)
    places = empty_placements(len(links) + 1, 1)
    march(rows, links, np.array([first]), 0, 1, places)
    seen = np.empty((len(links), OFF_COLUMNS))
    status = see_offsets(rows, links, places, first, last, steps, gain, seen)
    benches = [BenchOffTracking(*row) for row in seen.tolist()] if status == Status.OK else []
    return OffTracking(gain, tuple(benches))
