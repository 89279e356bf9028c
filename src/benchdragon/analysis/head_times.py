"""When the head comes to a route position, so that brackets of times are sure."""

import math
from dataclasses import dataclass

from benchdragon.kernels.double_double import head_drift
from benchdragon.model.answer import Status
from benchdragon.model.walk import Walk


@dataclass(frozen=True)
class HeadTimes:
    """Times of a search along a walk.

    Args:
        walk: the walk that is searched.
        start: the head position at which the search begins, m.
        since: the time at which it does, s.
        until: the time at which it ends, s.
    """

    walk: Walk
    start: float
    since: float = -math.inf
    until: float = math.inf

    def at(self, s: float) -> float:
        """The first time of the search, s, at which the head stands at s."""
        return self.since if s <= self.start else max(self.walk.time_at(s), self.since)

    def told(
        self, lower: float, upper: float, status: Status, leads: tuple[float, float] | None = None
    ) -> tuple[float, float, float, Status]:
        """`bracketed`, within the search: a time that may lie after its end is undecided."""
        value, early, late = self.bracketed(lower, upper, leads)
        if late <= self.until:
            return value, early, late, status
        return min(value, self.until), min(early, self.until), self.until, "undecided"

    def bracketed(
        self, lower: float, upper: float, leads: tuple[float, float] | None = None
    ) -> tuple[float, float, float]:
        """About when the head is between two positions, m, and a time before and one after that, s.

        At the second it has surely come no farther than where the kernels place it for `lower`, at the
        third at least to where they do for `upper`: see `head_drift`, where `leads` are not known, m.
        """
        behind, ahead = leads or (self._drift(lower, -1.0), self._drift(upper, 1.0))
        early = self.not_after(lower, min(behind, 0.0))
        late = self.not_before(upper, max(ahead, 0.0))
        return min(max(self.at(0.5 * (lower + upper)), early), late), early, late

    def _drift(self, s: float, side: float) -> float:
        """How far ahead of s, m, the kernels place the head for it: at most (side 1), at least (-1)."""
        if not math.isfinite(s):
            return 0.0
        drift, doubt = head_drift(self.walk.route.rows, s)
        return drift + side * doubt

    def not_after(self, s: float, shift: float = 0.0) -> float:
        """A time at which the head has come no farther than s + shift; not before the search begins."""
        t = self.at(s)
        step = math.ulp(t) if math.isfinite(t) else 0.0
        while t > self.since and self._lead(t, s, shift) > 0:
            t, step = t - step, 2.0 * step
        return max(t, self.since)

    def not_before(self, s: float, shift: float = 0.0) -> float:
        """A time at which the head has come at least as far as s + shift."""
        t = self.at(s)
        step = math.ulp(t) if math.isfinite(t) else 0.0
        while s > self.start and t < math.inf and self._lead(t, s, shift) < 0:
            t, step = t + step, 2.0 * step
        return t

    def _lead(self, t: float, s: float, shift: float) -> float:
        """Above 0 where the head stands past s + shift at t, below where before; not rounded."""
        walk = self.walk
        if not math.isfinite(t):
            return walk.start + float(walk.profile.distance(t)) - s
        return walk.profile.past(t, (s, shift, -walk.start))
