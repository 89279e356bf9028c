"""Once for each size of bench along the route, or once for each bench over time?

Where a bench stands is told by the route position of its own front handle alone, whatever the others
do: handle i + 1 is the first place behind handle i that is one link away. So an obstacle may be
searched along the route, once for each size of bench, in stretches that begin where a bench stands at
the start and end where the one of its size before it stood: what lies beyond, that one came to sooner
(kernels/obstacle_search.py). Only the touch that is found is then told of the head, by marching the
chain.

Its rival places the whole dragon at each instant, asks each bench for its distance, and halves the step
in which the first one touches: a user's script. It misses what touches between two instants.

    python design/obstacles.py

Prints, for dragons of several lengths, when the first bench comes to a well of 1 cm that stands 3 cm
beside the way, by both, how many benches each placed, and the processor time of each.
"""

import time

import numpy as np

from benchdragon.analysis.distance import boxes
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.obstacle_contact import distances_to
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import read_plan

# Between instants, s, that the rival looks at, and to which it halves.
STEP, FINE = 0.1, 1e-9


def nearest(walk: Walk, obstacle: Obstacle, t: float) -> float:
    """How near the nearest bench is to an obstacle at time t, s, m."""
    table = boxes(walk.motion([t]), 0)
    out, which = np.empty(len(table)), np.empty(len(table), dtype=np.int64)
    distances_to(table, obstacle.boxes, np.empty((2, BOX_COLUMNS)), out, which)
    return float(out.min()) - obstacle.radius


def by_instants(walk: Walk, obstacle: Obstacle, end: float) -> tuple[float | None, int]:
    """When a bench is first seen to touch, s, and how many benches were placed."""
    placed = 0
    for t in np.arange(0.0, end, STEP).tolist():
        placed += len(walk.dragon)
        if nearest(walk, obstacle, t) <= 0.0:
            low, high = t - STEP, t
            while high - low > FINE:
                middle = 0.5 * (low + high)
                placed += len(walk.dragon)
                low, high = (low, middle) if nearest(walk, obstacle, middle) <= 0.0 else (middle, high)
            return high, placed
    return None, placed


def main() -> None:
    """Compare the two on dragons of several lengths."""
    print("benches | way              | first touch, s  | benches placed | processor, s")
    for benches in (223, 1000, 5000):
        walk = read_plan("turn", [f"dragon.benches={benches}", "walk.start=0"]).build()
        s = float(walk.route.joints[-2]) + 6.0
        (x, y), heading = walk.route.point(s), float(walk.route.heading(s))
        aside = 0.5 * float(walk.dragon.width.max()) + 0.03
        well = Obstacle.circle("well", (x - aside * np.sin(heading), y + aside * np.cos(heading)), 0.01)
        end = walk.time_at(s + 3.0)
        began = time.process_time()
        with ObstacleSearch(walk, well, 0.0, end) as search:
            found = search.touches()
        spent = time.process_time() - began
        told = f"{found[-1].value:.9f}" if found else "none"
        print(f"{benches:7d} | along the route  | {told:>15s} | {search.evaluations:14d} | {spent:.4f}")
        began = time.process_time()
        seen, placed = by_instants(walk, well, end)
        spent = time.process_time() - began
        told = "none" if seen is None else f"{seen:.9f}"
        print(f"{benches:7d} | at instants      | {told:>15s} | {placed:14d} | {spent:.4f}")


if __name__ == "__main__":
    main()
