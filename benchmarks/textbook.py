"""The textbook search for contact: looks at fixed times at all pairs, then bisection.

What scripts for the contest do, with the best of tricks that NumPy allows: all pairs by the separating
axis theorem at once. It is a rival for speed; it can miss what happens between two looks.
"""

import numpy as np
import numpy.typing as npt

from benchdragon import Walk
from benchdragon.plans.schema import Plan

FloatArray = npt.NDArray[np.float64]


class Stepped:
    """A stepped search that counts the chains it places."""

    def __init__(self, walk: Walk) -> None:
        self.walk, self.chains = walk, 0
        self.first, self.second = np.triu_indices(len(walk.dragon), 2)

    def touching(self, t: float) -> bool:
        """Whether any two benches but neighbours overlap at time t."""
        self.chains += 1
        motion, dragon = self.walk.motion([t]), self.walk.dragon
        x, y = motion.x[0], motion.y[0]
        ux, uy = -np.diff(x) / dragon.links, -np.diff(y) / dragon.links
        ahead = dragon.front_inset - 0.5 * dragon.length
        cx, cy = x[:-1] + ahead * ux, y[:-1] + ahead * uy
        i, j = self.first, self.second
        dx, dy = cx[j] - cx[i], cy[j] - cy[i]
        cosine, sine = np.abs(ux[i] * ux[j] + uy[i] * uy[j]), np.abs(ux[i] * uy[j] - uy[i] * ux[j])
        apart = np.zeros(len(i), dtype=bool)
        half, wide = 0.5 * dragon.length, 0.5 * dragon.width
        for a, b in ((i, j), (j, i)):
            along = np.abs(dx * ux[a] + dy * uy[a])
            across = np.abs(dy * ux[a] - dx * uy[a])
            apart |= along > half[a] + half[b] * cosine + wide[b] * sine
            apart |= across > wide[a] + half[b] * sine + wide[b] * cosine
        return bool((~apart).any())

    def first_contact(self, start: float, end: float, step: float, tolerance: float) -> float | None:
        """The first time that is looked at with an overlap, bisected; None if there is none."""
        for t in np.append(np.arange(start, end, step), end).tolist():
            if self.touching(t):
                return self.bisected(max(t - step, start), t, tolerance)
        return None

    def bisected(self, clear: float, touching: float, tolerance: float) -> float:
        """The time between a clear look and one that touches."""
        while touching - clear > tolerance:
            middle = 0.5 * (clear + touching)
            if self.touching(middle):
                touching = middle
            else:
                clear = middle
        return touching


def smallest_pitch(
    plan: Plan, low: float, high: float, step: float, tolerance: float
) -> tuple[float, int]:
    """The pitch between low (which touches) and high by bisection on stepped walks; chains placed."""
    chains = 0
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        walk = plan.with_value("route.pitch", middle).build()
        search = Stepped(walk)
        start, end = plan.span(walk)
        if search.first_contact(start, end, step, 1.0) is None:
            high = middle
        else:
            low = middle
        chains += search.chains
    return high, chains
