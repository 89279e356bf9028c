"""Why turns of a spiral are shown clear by a closed form: how near it comes, and what it saves.

The other ways to the same end: box every cell (what other curves need), or follow the excess of the
corners over the angle numerically, which would need a proof that it falls all the way out.
"""

import math

import numpy as np

from benchdragon import Dragon, tightest_pairs
from benchdragon.kernels.curve import RouteRow
from benchdragon.kernels.spiral_bound import clear_radius, shape_of
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import read_plan


def nearest_to_meeting(walk: Walk, radius: float) -> float:
    """The least distance of the head from any bench while it comes from 2 m farther out to radius."""
    theta = np.linspace(radius + 2.0, radius, 400) / walk.route.rows[0, RouteRow.P]
    spiral = walk.route.rows
    start = [walk.route.length - 0.5 * spiral[0, RouteRow.P] * angle * angle for angle in theta]
    motion = Walk(walk.dragon, walk.route).motion(np.array(start))
    return min(tightest_pairs(motion, t)[0].distance for t in range(len(start)))


def main() -> None:
    """Print the table."""
    dragon = Dragon.uniform()
    one = np.zeros(1, dtype=np.int64)
    head, body = (shape_of(dragon.sizes[:, n].reshape(4, 1).copy(), one, 0, 0.0) for n in (0, 1))
    between = float(dragon.links.min())
    print("pitch, m   head clear from, m   bodies, m   least distance of the head there, m")
    for pitch in (0.45, 0.5, 0.55, 0.7, 1.0, 1.7):
        b = pitch / (2.0 * math.pi)
        radius = clear_radius(b, head, body, between)
        bodies = clear_radius(b, body, body, between)
        walk = read_plan("spiral-in", [f"route.pitch={pitch}"]).build()
        near = nearest_to_meeting(walk, radius)
        print(f"{pitch:8g} {radius:24.3f} {bodies:11.3f} {near:37.3f}")


if __name__ == "__main__":
    main()
