"""Why greatest speeds are sought through a coarse bound over cells.

A step of the head can be passed over if no handle exceeds in it what has been seen elsewhere. Two
bounds can say so, and parts of the way are looked at in the order of theirs (kernels/speed_search.py).

1. The chain's: enclosures of angles and rates, bench by bench from the head (kernels/motion_bounds.py).
   It loses in second order, as a search for the last digit needs, but costs a chain with its bounds
   for every tenth of a link, wherever the dragon is.
2. The cells': what a bench does per metre of its front handle's way - how much faster its rear handle
   is, how that changes, how fast it turns - depends on its link and the front handle's place alone.
   Bounds on it are found once in each cell of the route for each link (kernels/bench_cells.py); going
   from cell to cell down the chain they bound all speeds, turning rates and accelerations over a long
   step of the head, without placing a chain, and name the last handle that can exceed what was seen.
   They lose in first order, so that near the peak the chain's bound must follow, on the handles that
   are left.

Cells are made shorter only where that says more: until the greatest ratio in one is at most a share
above those at its ends. All benches together may lose 0.1 of the value where some handle is faster than
the head; shorter cells cost more than the chains that they spare. Where the head itself is fastest, as
on a spiral inward, nothing may be lost at all: there cells must be so short that their bound is the
ratio at one end.

That share was 0.2 once: with radii of 1.2 to 1 the cells' bound then lay just above the peak all along,
and 1,658 chains were placed for the greatest speed instead of 140.

Below: what each costs, and what answers they give.
"""

import math
import time
from collections.abc import Callable
from functools import partial
from unittest import mock

from benchdragon import Walk
from benchdragon.analysis import speed
from benchdragon.analysis.speed import QUANTITIES, Quantity, greatest
from benchdragon.model.answer import Answer
from benchdragon.plans.schema import read_plan

PLANS = {
    "spiral-in": ["spiral-in", "disc.radius=4.5"],
    "turn": ["turn"],
    "turn, 1.2 to 1": ["turn", "turn.ratio=1.2"],
    "turn with a line": ["turn", "turn.family=arc-line-arc"],
    "turn of three arcs": ["turn", "turn.family=arc-arc-arc", "turn.curvature=0.1"],
}
# What is asked of each, and the bracket's width.
WIDTHS = {"speed": 1e-10, "turning_rate": 1e-6}


def timed(job: Callable[[], Answer], repeats: int = 3) -> tuple[float, Answer]:
    """The least time of a job, ms, and its answer."""
    spent, answer = [], job()
    for _repeat in range(repeats):
        began = time.perf_counter()
        job()
        spent.append(time.perf_counter() - began)
    return 1e3 * min(spent), answer


def speed_rows(name: str, quantity: Quantity, walk: Walk, span: tuple[float, float]) -> None:
    """The greatest of a quantity by several steps and losses, and without the coarse bound."""
    job = partial(greatest, walk, quantity, *span, tolerance=WIDTHS[quantity.name])
    for step in (0.4, 0.8, 1.6):
        for loss in (0.02, 0.1, 0.2):
            with mock.patch.object(speed, "ROOM", (*speed.ROOM[:5], step, loss, speed.ROOM[-1])):
                spent, found = timed(job)
            row = f"{name:18s} {quantity.name:18s} {step:5g} {loss:5g} {spent:8.1f}"
            print(f"{row} {found.evaluations:7d}  {found.value:.11f}")
    with mock.patch.object(speed, "ROOM", (*speed.ROOM[:4], math.inf, *speed.ROOM[5:])):
        spent, found = timed(job, 1)
    row = f"{name:18s} {quantity.name:18s} {'no cells':>11s} {spent:8.1f}"
    print(f"{row} {found.evaluations:7d}  {found.value:.11f}")


def main() -> None:
    """Print the table."""
    walks = {}
    for name, (source, *settings) in PLANS.items():
        plan = read_plan(source, settings)
        walks[name] = plan.build(), plan.span(plan.build())
    print("greatest                                steps  loss       ms  placed")
    for name, (walk, span) in walks.items():
        for quantity in WIDTHS:
            speed_rows(name, QUANTITIES[quantity], walk, span)


if __name__ == "__main__":
    main()
