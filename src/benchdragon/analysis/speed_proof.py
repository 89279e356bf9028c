"""A proof of a walk's greatest speed ratio: no handle is ever faster, and one is nearly as fast."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from benchdragon import budget
from benchdragon.analysis.proof import exact_numbers, require_flint
from benchdragon.errors import UnsureError
from benchdragon.i18n import N_, _
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent

if TYPE_CHECKING:
    from flint import arb

# How much more than what was seen is shown, relative: the least that the work allows.
WIDTHS = (5e-13, *(10.0**power for power in range(-12, -1)))
# What a bound on a speed is wrong by in a cell, a square metre; cells are no longer, m; and the work
# that is taken on: handles times cells. All this decides nothing but how narrow a bracket is tried.
WRONG, LONGEST, MOST_WORK = 20.0, 0.2, 1_500_000
# How near to where it was seen a greatest speed is sought again, m, and by what share it is cut.
NEAR, GOLDEN = 1e-4, 0.5 * (math.sqrt(5.0) - 1.0)
# Places at which speeds are sampled first.
SAMPLES = 400


@dataclass(frozen=True)
class SpeedClaim:
    """A proved statement: no handle is faster than `most` from `start` to `clear`, s.

    With the head at 1 m/s, whatever its own speed is.

    Attributes:
        cells: the head's route positions, m, between each two of which no handle is.
        start: s.
        clear: s.
        most: m/s.
        s: the head's route position, m, where a handle is as fast as `least`.
        handle: which, from 0.
        least: m/s.
    """

    cells: tuple[float, ...]
    start: float
    clear: float
    most: float
    s: float
    handle: int
    least: float


def head_speeds(limit: float, claim: SpeedClaim) -> tuple[float, float]:
    """A head speed that surely keeps all handles to a limit, and one that does not: decimals, m/s."""
    from benchdragon.proofs.exact import stepped
    from benchdragon.proofs.parts import as_written

    allowed, most, least = (as_written(value) for value in (limit, claim.most, claim.least))
    lower = stepped(float(allowed / most), lambda v: as_written(v) * most <= allowed, -math.inf)
    return lower, stepped(float(allowed / least), lambda v: as_written(v) * least > allowed, math.inf)


def handle_speeds(head: float, claim: SpeedClaim) -> tuple[float, float]:
    """Between which speeds the fastest handle's surely lies, the head at that speed: decimals, m/s."""
    from benchdragon.proofs.exact import stepped
    from benchdragon.proofs.parts import as_written

    least, most = (as_written(head) * as_written(value) for value in (claim.least, claim.most))
    lower = stepped(float(least), lambda v: as_written(v) <= least, -math.inf)
    return lower, stepped(float(most), lambda v: as_written(v) >= most, math.inf)


class SpeedQuestion:
    """The greatest speed of a walk's handles, the head at 1 m/s; with a plan as in `proof.Question`."""

    def __init__(self, walk: Walk, plan: Plan | None = None) -> None:
        self._walk, self._numbers = walk, exact_numbers(walk, plan)
        self._dance = self._numbers.dance(None)

    def proved(self, start: float, end: float, s: float, progress: Progress = silent) -> SpeedClaim:
        """The claim that can be proved, given the fastest handle seen with the head near s, m.

        Raises:
            UnsureError: if another is faster, or that could not be shown.
        """
        from benchdragon.proofs.cover import cells

        first, last = self._numbers.at_most(start), self._numbers.at_least(end)
        s, handle = self._fastest(s, self._numbers.at_least(start), self._numbers.at_most(end))
        least = self._least(s, handle)
        most = self._most(first, last, least)
        dance = replace(self._dance, most=self._numbers.number(most))
        at = cells(dance, self._numbers.guess, first, last, progress)
        if at[-1] < last:
            text = N_("no bound on speeds could be shown in ball arithmetic beyond {s} m of the route")
            raise UnsureError(text, s=f"{at[-1]:.12g}")
        return SpeedClaim(tuple(at), start, end, most, s, handle, least)

    def _fastest(self, s: float, first: float, last: float) -> tuple[float, int]:
        """Where near s, m, between two places, a handle is fastest, and which, by golden sections."""
        low, high = max(s - NEAR, first), min(s + NEAR, last)
        one, other = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        speeds = {at: max(self._speeds(at)) for at in (one, other)}
        while one < other:
            if speeds[one] > speeds[other]:
                high, other, one = other, one, other - GOLDEN * (other - low)
                speeds.setdefault(one, max(self._speeds(one)))
            else:
                low, one, other = one, other, one + GOLDEN * (high - one)
                speeds.setdefault(other, max(self._speeds(other)))
        best = max(speeds, key=lambda at: speeds[at])
        found = self._speeds(best)
        return best, max(range(len(found)), key=lambda handle: found[handle])

    def verify(self, claim: SpeedClaim, progress: Progress = silent) -> None:
        """Prove a claim again from its cells and the place of its fast handle alone.

        Raises:
            UnsureError: naming the step that does not hold.
        """
        from benchdragon.proofs.chain import UnprovedError
        from benchdragon.proofs.cover import covered

        position, at = self._numbers.position, claim.cells
        if not position(claim.start) >= at[0]:
            raise UnsureError(_("the cells begin after the start"))
        if not (position(claim.clear) <= at[-1] and claim.start <= claim.clear):
            raise UnsureError(_("the cells end before what they are to show"))
        dance = replace(self._dance, most=self._numbers.number(claim.most))
        try:
            covered(dance, self._numbers.guess, at, progress)
        except UnprovedError as error:
            raise UnsureError(_("it could not be shown: {error}").format(error=error)) from None
        within = position(claim.start) <= claim.s <= position(claim.clear)
        if not (within and self._speeds(claim.s)[claim.handle] >= self._numbers.number(claim.least)):
            raise UnsureError(_("no handle could be shown to be as fast as that"))

    def _speeds(self, s: float) -> "Sequence[arb]":
        """The speeds of all handles with the head at route position s, m."""
        from benchdragon.proofs.chain import UnprovedError
        from benchdragon.proofs.cover import chain_at
        from benchdragon.proofs.pace import Still

        try:
            chain = chain_at(self._dance, self._numbers.guess, s)
        except UnprovedError as error:
            raise UnsureError(N_("it could not be shown: {error}"), error=error) from None
        return Still.of(chain, self._dance.route, self._dance.sizes.links).speeds

    def _least(self, s: float, handle: int) -> float:
        """A double at most the speed of a handle with the head at route position s, m."""
        from benchdragon.proofs.exact import stepped

        speed, number = self._speeds(s)[handle], self._numbers.number
        return stepped(float(speed), lambda value: number(value) <= speed, -math.inf)

    def _most(self, first: float, last: float, least: float) -> float:
        """The speed to be proved as an upper bound: as low as the work allows."""
        at = np.linspace(first, last, SAMPLES)
        placed = self._walk.placement(at, throw=False)
        seen = np.nan_to_num(placed.speed_ratio[:, 1:].max(axis=1), nan=math.inf)
        handles = len(self._walk.dragon) + 1
        widths = (0.0, *WIDTHS) if least == 1.0 else WIDTHS  # the head is surely no faster than itself
        for width in widths:
            spare = np.maximum(least * (1.0 + width) - seen, 0.1 * width)
            longest = np.clip(np.sqrt(spare / WRONG), 1e-9, LONGEST)
            if (last - first) * float((1.0 / longest).mean()) * handles <= MOST_WORK:
                return least * (1.0 + width)
        return least * (1.0 + WIDTHS[-1])


@budget.question()
def prove_speed(
    walk: Walk, start: float, end: float, s: float, *, plan: Plan | None = None,
    progress: Progress = silent,
) -> SpeedClaim:  # fmt: skip
    """Bounds on the greatest speed of any handle from start to end, s, with the head at 1 m/s.

    Args:
        walk: the walk.
        start: s.
        end: s.
        s: the head's route position, m, near which a handle was found to be the fastest.
        plan: of which the walk is built: then its numbers count as they are written.
        progress: is called with the share done.

    Raises:
        InputError: for a number that the plan holds rounded, or a route that cannot be enclosed.
        MissingExtraError: without python-flint.
        UnsureError: if it could not be shown.
    """
    require_flint()
    return SpeedQuestion(walk, plan).proved(start, end, s, progress)
