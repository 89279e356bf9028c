"""How better turns are sought: which search finds what, and what two arcs can and cannot gain.

Choice: points strewn evenly over all unknowns, and from the best few of them downhill by straight
lines of each peak within a range of trust (kernels/turn_descent.py). The best turn lies where limits
and peaks meet, at a corner; lines find a corner as Newton's method finds a root. The rival is SciPy's
differential evolution. It ends beside that corner, or at a turn that is too fast between its samples;
`dual_annealing` shows that within two arcs between the disc's joints no length is gained, whatever the
ratio, though speed is.
"""

import math
import time
from collections.abc import Sequence
from functools import partial

import numpy as np
from scipy.optimize import Bounds, differential_evolution, dual_annealing

from benchdragon.errors import InputError
from benchdragon.kernels import motion_bounds
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import RouteRow
from benchdragon.kernels.turn_trial import FEW
from benchdragon.model.turns import two_arcs
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.turn import best_turn
from benchdragon.solve.turn_goal import TurnFamily, TurnGoal
from benchdragon.solve.turn_question import TurnQuestion

Point = np.ndarray[tuple[int], np.dtype[np.float64]]
# How far apart head positions are that the rival looks at, m.
STEP = 0.1
# Radii, m, that a search by hand found for a head speed, m/s, between joints on the disc's edge.
BY_HAND = {1.52: (1.7771875, 1.7646875), 1.54: (1.80594, 1.81094)}


def two_arcs_alone() -> None:
    """Lengths and greatest head speeds of two arcs between the disc's joints, over the ratio."""
    print("ratio r1 : r2   length, m         greatest head speed, m/s")
    for ratio in (0.5, 0.7, 0.9, 1.0, 1.2, 1.5, 2.0):
        plan = read_plan("turn", [f"turn.ratio={ratio}", "dragon.benches=40"])
        speed = greatest_head_speed(plan, tolerance=1e-9).value
        print(f"{ratio:13g} {two_arcs(1.7, 4.5, 4.5, ratio).length:17.12f} {speed:18.6f}")

    def length(x: Point) -> float:
        return two_arcs(1.7, 4.5, 4.5, math.exp(x[0])).length

    found = dual_annealing(length, [(-1.6, 1.6)], maxiter=200, rng=1)
    print(f"dual annealing over the ratio, shortest length: {found.fun:.12f} m\n")


def sampled_way(family: TurnFamily, x: Point) -> float:
    """The way of a turn, m, or how far sampled speeds exceed the limit."""
    try:
        turn = family.turn(x.tolist())
    except InputError:
        return 1e6
    rows, links = turn.rows(lead=1.0, trail=1000.0), family.dragon.links[:FEW]
    first, last = float(rows[1, RouteRow.S_START]), float(rows[-1, RouteRow.S_START] + links.sum())
    at = np.arange(first, last, STEP)
    places = empty_placements(len(links) + 1, len(at))
    if not motion_bounds.place_chain(rows, links, at, 0, len(at), places):
        return 1e6
    over = places.ratio.max() * family.plan.walk.speed / 2.0 - 1.0
    return (
        1e3 * (1.0 + over) if over > 0.0 or turn.extent > family.disc + 1e-9 else turn.way(family.disc)
    )


def searches() -> None:
    """The engine's search against differential evolution, before figures are made exact."""
    print("family       speed, m/s  by                      way, m  allows, m/s  turns tried   s")
    for name in ("arc-line-arc", "arc-arc-arc"):
        for speed in (1.3, 1.52, 1.7):
            plan = read_plan("turn", [f"turn.family={name}", f"walk.speed={speed}"])
            family, began = TurnFamily(plan, TurnGoal()), time.perf_counter()
            with TurnQuestion(family) as question:
                seen = question.best(silent, "")
            told(family, seen.x, "lines from strewn points", question.tried, began)
            began = time.perf_counter()
            evolved = differential_evolution(
                partial(sampled_way, family), Bounds(*np.array(family.bounds).T), popsize=10,
                maxiter=60, rng=1, polish=False, init="sobol",
            )  # fmt: skip
            told(family, evolved.x.tolist(), "differential evolution", evolved.nfev, began)


def told(family: TurnFamily, x: Sequence[float], by: str, tried: int, began: float) -> None:
    """A line of the table, with the head speed that the turn allows by exact figures."""
    seconds, plan = time.perf_counter() - began, family.with_turn(x)
    way, allowed = family.turn(x).way(family.disc), greatest_head_speed(plan).value
    print(
        f"{plan.turn.family:12s} {plan.walk.speed:9g}   {by:24s} {way:9.5f} {allowed:12.5f} "
        f"{tried:12d} {seconds:6.1f}"
    )


def by_hand() -> None:
    """What exact figures say of turns found by hand, and of those of the search."""
    print("\nspeed, m/s   by       way, m       allows, m/s   least distance, m")
    for speed, radii in BY_HAND.items():
        plan = read_plan("turn", ["turn.family=arc-line-arc", f"walk.speed={speed}"])
        hand = plan.with_table("turn", entry_radius=4.5, exit_radius=4.5, radii=radii)
        way, best = hand.turn.build(1.7, 4.5).way(4.5), best_turn(plan)
        assert best.head_speed is not None
        print(f"{speed:10g}   hand   {way:10.6f} {greatest_head_speed(hand).value:15.8f}")
        print(
            f"{speed:10g}   search {best.way:10.6f} {best.head_speed.value:15.8f} "
            f"{best.clearance.value:15.5f}"
        )


if __name__ == "__main__":
    two_arcs_alone()
    searches()
    by_hand()
