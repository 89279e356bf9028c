"""How better turns are sought: which searches find what, and what two arcs can and cannot gain.

Choice: differential evolution from two seeds (sampled figures), COBYQA and Nelder-Mead's simplex from
each, then exact figures. SciPy's `dual_annealing` is the rival; it also shows that within two arcs
between the disc's joints no length is gained, whatever the ratio, though speed is.
"""

import math
import time

import numpy as np
from scipy.optimize import Bounds, differential_evolution, dual_annealing

from benchdragon.model.turns import two_arcs
from benchdragon.plans.schema import read_plan
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.minima import GENERATIONS, MEMBERS
from benchdragon.solve.turn_trials import TurnEvaluator, TurnGoal


def two_arcs_alone() -> None:
    """Lengths and greatest head speeds of two arcs between the disc's joints, over the ratio."""
    print("ratio r1 : r2   length, m         greatest head speed, m/s")
    for ratio in (0.5, 0.7, 0.9, 1.0, 1.2, 1.5, 2.0):
        plan = read_plan("turn", [f"turn.ratio={ratio}", "dragon.benches=40"])
        speed = greatest_head_speed(plan, tolerance=1e-9).value
        print(f"{ratio:13g} {two_arcs(1.7, 4.5, 4.5, ratio).length:17.12f} {speed:18.6f}")

    def length(x: np.ndarray[tuple[int], np.dtype[np.float64]]) -> float:
        return two_arcs(1.7, 4.5, 4.5, math.exp(x[0])).length

    found = dual_annealing(length, [(-1.6, 1.6)], maxiter=200, rng=1)
    print(f"dual annealing over the ratio, shortest length: {found.fun:.12f} m\n")


def searches() -> None:
    """Differential evolution against dual annealing, for as many sampled turns."""
    print("family         by                      way, m   sampled turns   s")
    for family in ("arc-line-arc", "arc-arc-arc"):
        plan = read_plan("turn", [f"turn.family={family}", "walk.speed=1.3"])
        goal = TurnGoal("way", least_radius=1.5027)
        for name in ("differential evolution", "dual annealing"):
            evaluator = TurnEvaluator(plan, goal)

            def score(
                x: np.ndarray[tuple[int], np.dtype[np.float64]], evaluator: TurnEvaluator = evaluator
            ) -> float:
                return evaluator.score(x.tolist())

            began = time.perf_counter()
            most = MEMBERS * GENERATIONS * len(evaluator.bounds)
            if name == "dual annealing":
                found = dual_annealing(
                    score, evaluator.bounds, maxfun=most, no_local_search=True, rng=1
                )
            else:
                found = differential_evolution(
                    score, Bounds(*np.array(evaluator.bounds).T), popsize=MEMBERS, maxiter=GENERATIONS,
                    rng=1, polish=False, init="sobol",
                )  # fmt: skip
            spent = time.perf_counter() - began
            print(f"{family:14s} {name:22s} {found.fun:7.3f} {evaluator.evaluations:12d} {spent:8.1f}")


if __name__ == "__main__":
    two_arcs_alone()
    searches()
