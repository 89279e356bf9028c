"""When the head comes to a route position, so that brackets of times are sure."""

import math
from dataclasses import dataclass
from fractions import Fraction

from benchdragon.model.walk import Walk


@dataclass(frozen=True)
class HeadTimes:
    """Times of a search along a walk.

    Args:
        walk: what is searched.
        start: the head position at which the search begins, m.
        since: the time at which it does, s.
    """

    walk: Walk
    start: float
    since: float = -math.inf

    def at(self, s: float) -> float:
        """The first time of the search, s, at which the head stands at s."""
        return self.since if s <= self.start else max(self.walk.time_at(s), self.since)

    def bracketed(self, lower: float, upper: float) -> tuple[float, float, float]:
        """About when the head is between two positions, m, and a time before and one after that, s.

        At the second it has surely come no farther than `lower`, at the third at least to `upper`.
        """
        early, late = self.not_after(lower), self.not_before(upper)
        return min(max(self.at(0.5 * (lower + upper)), early), late), early, late

    def not_after(self, s: float) -> float:
        """A time at which the head has come no farther than s; not before the search begins."""
        t = self.at(s)
        step = math.ulp(t) if math.isfinite(t) else 0.0
        while t > self.since and self._lead(t, s) > 0:
            t, step = t - step, 2.0 * step
        return max(t, self.since)

    def not_before(self, s: float) -> float:
        """A time at which the head has come at least as far as s."""
        t = self.at(s)
        step = math.ulp(t) if math.isfinite(t) else 0.0
        while s > self.start and t < math.inf and self._lead(t, s) < 0:
            t, step = t + step, 2.0 * step
        return t

    def _lead(self, t: float, s: float) -> float | Fraction:
        """How far past s the head stands at time t, m; not rounded, so that brackets are sure."""
        if math.isinf(t):
            return self.walk.start + float(self.walk.profile.distance(t)) - s
        return self.walk.exact_head_position(t) - Fraction(s)
