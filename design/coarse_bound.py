"""Why greatest speeds are sought through a coarse bound over cells, and clearances from a low one seen.

A step of the head can be passed over if no handle exceeds in it what has been seen elsewhere. Two
bounds can say so.

1. The chain's: enclosures of angles and rates, bench by bench from the head (kernels/step_bounds.py).
   It loses in second order, as a search for the last digit needs, but costs a chain with its bounds
   for every tenth of a link, wherever the dragon is.
2. The cells': a bench's rear handle is faster than its front one by a ratio that depends on its link
   and the front handle's place alone. The greatest in each cell of the route is found once for each
   link; products down the chain bound every step of the head, and name the last bench that can be
   faster than what was seen. They lose in first order, so that near the peak the chain's bound must
   follow, on the few benches that are left. Where the head itself is fastest, as on a spiral inward,
   nothing may be lost at all: then cells must be so short that their bound is the ratio at one end,
   shorter far out, and finer ones are tried.

Least clearances have the same shape. All pairs that come within some reach must be searched, so that
the reach should be no more than the answer. Guesses that grow (0.003 m, 0.018 m, ...) end beyond it,
by up to six times. A low distance, seen at 128 places and about the least of them, ends just at it.

Below: what each costs, and what answers the two ways give.
"""

import time
from collections.abc import Callable
from functools import partial
from unittest import mock

from benchdragon import Walk, least_clearance
from benchdragon.analysis import contact, speed
from benchdragon.analysis.speed import greatest_speed
from benchdragon.model.answer import Answer
from benchdragon.plans.schema import read_plan

PLANS = {
    "spiral-in": ["spiral-in", "disc.radius=4.5"],
    "turn": ["turn"],
    "turn with a line": ["turn", "turn.family=arc-line-arc"],
    "turn of three arcs": ["turn", "turn.family=arc-arc-arc", "turn.curvature=0.1"],
}


def timed(job: Callable[[], Answer], repeats: int = 3) -> tuple[float, Answer]:
    """The least time of a job, ms, and its answer."""
    spent, answer = [], job()
    for _repeat in range(repeats):
        began = time.perf_counter()
        job()
        spent.append(time.perf_counter() - began)
    return 1e3 * min(spent), answer


def speed_rows(name: str, walk: Walk, span: tuple[float, float]) -> None:
    """Greatest speeds by several steps and cells, and without the coarse bound."""
    for steps in ((0.8,), (0.2,), (0.8, 0.2), (0.8, 0.2, 0.05)):
        for cell in (0.1, 0.05, 0.025):
            with mock.patch.multiple(speed, COARSE_STEPS=steps, COARSE_CELLS=(cell,)):
                spent, found = timed(partial(greatest_speed, walk, *span))
            text = ", ".join(f"{step:g}" for step in steps)
            row = f"{name:20s} {text:14s} {cell:5g} {spent:8.1f}"
            print(f"{row} {found.evaluations:7d}  {found.value:.11f}")
    with mock.patch.object(speed, "coarse_bound_pays", return_value=False):
        spent, found = timed(partial(greatest_speed, walk, *span), 1)
    print(f"{name:20s} {'no coarse bound':20s} {spent:8.1f} {found.evaluations:7d}  {found.value:.11f}")


def main() -> None:
    """Print the two tables."""
    walks = {}
    for name, (source, *settings) in PLANS.items():
        plan = read_plan(source, settings)
        walks[name] = plan.build(), plan.span(plan.build())
    print("greatest speed       steps, cell in links         ms  placed  m/s")
    for name, (walk, span) in walks.items():
        speed_rows(name, walk, span)
    print("\nleast clearance      from a low one seen, ms   from guesses that grow, ms   m")
    for name, (walk, span) in walks.items():
        hinted, found = timed(partial(least_clearance, walk, *span))
        with mock.patch.object(contact, "MOST_SAMPLED", 0):
            grown, _same = timed(partial(least_clearance, walk, *span), 1)
        print(f"{name:20s} {hinted:22.1f} {grown:28.1f}   {found.value:.11f}")


if __name__ == "__main__":
    main()
