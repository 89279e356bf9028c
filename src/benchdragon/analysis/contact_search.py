"""A search along a walk for pairs of benches: its steps, the kernels' search of each, and its answers.

Time enters through the head's route position alone, so that all searches run over that and hold for
any speed. No bench is assumed clear because it was looked at: what is passed over is clear by a bound
that holds in between (kernels/pair_bounds.py, design/first_contact.py).
"""

import math
import time as clock
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from benchdragon.analysis.distance import boxes, nearness, pairs_within
from benchdragon.analysis.ledger import Ledger
from benchdragon.analysis.regions import PARTS, PLACES, BroadPhase, Step
from benchdragon.errors import UnsureError, in_order, not_negative, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import search as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import END_SLACK
from benchdragon.model.answer import Answer, Status, Witness
from benchdragon.model.placement import Placement
from benchdragon.model.walk import Walk
from benchdragon.progress import Progress

# What computed distances may be off by, m: a few dozen roundings of coordinates of 50 m; farther out
# it grows with them. A smaller one could call a graze clear, a larger one widens brackets.
SLACK = 1e-13
SLACK_REACH = 50.0
# Parts of a step narrower than this, m, or than this many roundings of the head's position, are not
# halved: contact times get no sharper.
WIDTH, WIDTH_ROUNDINGS = 1e-13, 4.0
# Chains marched in one step of a search; a graze takes some hundred.
MOST_EVALUATIONS = 200_000
# Chains that a proof may log in one step: 30 MB for 223 benches.
LOG = 4096
# Chains marched in one step for one of these; where benches keep the same distance for a while no
# number would do for the last.
MOST_LEAST_EVALUATIONS = 2000
# Places looked at for why a walk could not be followed.
SAMPLES_AHEAD = 65
# The head's way between what was searched and a failure, m: more, and it is not known what comes first.
UNKNOWN = 1e-6


@dataclass
class ContactSearch:
    """A search along a walk from one head position to another."""

    walk: Walk
    start: float  # head positions, m
    end: float
    margin: float
    progress: Progress
    slack: float = 0.0
    ledger: Ledger | None = None
    since: float = -math.inf  # the time at which it begins, s
    evaluations: int = 0
    began: float = field(default_factory=clock.perf_counter)

    def __post_init__(self) -> None:
        placed = self.placement(self.start)
        extent = float(np.abs([placed.x, placed.y]).max())
        self.slack = self.slack or SLACK * max(1.0, extent / SLACK_REACH)
        self._place = np.full(len(self.walk.dragon), -1, dtype=np.int64)
        self._room: kernel.Search | None = None
        self._shape = (0, 0, 0)

    def steps(self, reach: float) -> Iterator[Step]:
        """The steps in which pairs may come within `reach`, in order; what lies between is clear.

        Raises:
            WalkError: after the last of them, if the dragon cannot walk on to the end.
            UnsureError: likewise, if it could not be shown that it can.
        """
        walk = self.walk
        broad_phase = BroadPhase(walk.dragon, walk.route, reach + self.slack, self.start, self.ledger)
        end = min(self.end, walk.route.length)
        for done, upto in broad_phase.strides(self.start, end):
            known, sound = broad_phase.sound_until(done, upto)
            yield from broad_phase.steps(done, known)
            yield from self._small_steps(known, sound, broad_phase.reach, broad_phase.cell / PARTS)
            if sound < upto:
                raise self.stopped(sound, sound + 2.0 * broad_phase.cell)
            self.progress((upto - self.start) / (self.end - self.start), "")
        if self.end > end + END_SLACK:
            raise self.stopped(end, self.end)

    def _small_steps(self, start: float, end: float, reach: float, size: float) -> Iterator[Step]:
        """Steps of at most `size`, m, with all pairs that may come within reach by their travel."""
        grid = np.linspace(start, end, math.ceil((end - start) / size) + 1)
        per = max(1, PLACES // (len(self.walk.dragon) + 1))
        for n in range(0, len(grid) - 1, per):
            at = grid[n : n + per + 1]
            placed = self.placement(at)
            if placed.status.any():
                raise self.stopped(start, end)
            if self.ledger is not None:
                self.ledger.add_grid(placed)
            travel = self.walk.dragon.lever * np.diff(placed.s, axis=0).max(axis=1)
            for t in range(len(at) - 1):
                first, second = pairs_within(boxes(placed, t), reach + 2.0 * float(travel[t]))
                if len(first):
                    yield Step(float(at[t]), float(at[t + 1]), first, second)

    def stopped(self, sound: float, until: float) -> Exception:
        """Why the walk could not be followed past head position `sound`, looked for up to `until`."""
        # A bench may stand square to the route for a tenth of a millimetre only, and then leap.
        ahead = np.geomspace(UNKNOWN, max(min(until, self.end) - sound, UNKNOWN), SAMPLES_AHEAD)
        error = self.walk.first_failure(np.concatenate([[sound], sound + ahead]))
        if error is not None and error.head <= sound + 2.0 * UNKNOWN:
            return error
        return UnsureError(
            _("past t = {t} s it could not be shown that every bench follows without a leap").format(
                t=f"{self.time_at(sound):.6g}"
            )
        )

    def search_step(
        self, goal: int, step: Step, start: float, end: float, note: FloatArray, tolerance: float = 0.0
    ) -> int:
        """Run the kernel's search on part of a step; PAIR in `note` then counts pairs of the step.

        `tolerance` is that of LEAST, m.
        """
        count, first, second = len(step.first), np.empty_like(step.first), np.empty_like(step.second)
        members = np.empty(min(2 * count, len(self._place)), dtype=np.int64)
        found = kernel.number_members(step.first, step.second, members, self._place, first, second)
        members = members[:found]
        handles = int(members[-1]) + 2
        shape = (handles, len(members), count)
        if self._room is None or any(a > b for a, b in zip(shape, self._shape, strict=True)):
            wide, many, most = np.maximum(shape, self._shape).tolist()
            self._shape = (wide, many, most)
            self._room = kernel.room(*self._shape, 0 if self.ledger is None else LOG)
        dragon = self.walk.dragon
        width = max(WIDTH, WIDTH_ROUNDINGS * math.ulp(end))
        before = note[kernel.EVALUATIONS]
        chain = kernel.Chain(
            self.walk.route.rows, dragon.links[: handles - 1], np.empty(0), dragon.sizes, members
        )
        pairs = kernel.Pairs(first, second)
        most = MOST_LEAST_EVALUATIONS if tolerance else MOST_EVALUATIONS
        limits = kernel.Limits(self.margin, tolerance or self.slack, width, most)
        ending = kernel.search_step(self._room, goal, chain, pairs, start, end, limits, note)
        self.evaluations += int(note[kernel.EVALUATIONS] - before)
        if self.ledger is not None:
            count = int(self._room.logged[0])
            if count > LOG:
                raise UnsureError(_("a proof would need too many evaluations in one step"))
            self.ledger.add_log(self._room.log[:count], handles)
            self._room.logged[0] = 0
        return ending

    def placement(self, s: npt.ArrayLike) -> Placement:
        """The dragon with its head at s, whether it can stand there or not."""
        return self.walk.placement(s, throw=False)

    def witness(self, s: float, i: int, j: int) -> Witness:
        """How benches i and j (rows, from 0) stand with the head at s."""
        near = nearness(boxes(self.placement(s), 0), i, j)
        owner = near.features[0][0]
        point = near.points[near.benches.index(owner)]
        return Witness(self.time_at(s), s, near.benches, point, near.gap, near.features)

    def answer_at(self, lower: float, upper: float, status: Status, i: int, j: int) -> Answer:
        """A time between those at which the head is at lower and at upper, benches i and j meeting."""
        middle = 0.5 * (lower + upper)
        early, late = self._not_after(lower), self._not_before(upper)
        value = min(max(self.time_at(middle), early), late)
        seconds = clock.perf_counter() - self.began
        witness = self.witness(upper, i, j)
        return Answer(
            value, early, late, "s", status, witness, self.assumed(), self.evaluations, seconds
        )

    def assumed(self) -> tuple[str, ...]:
        """What answers rest on."""
        text = _("computed distances are within {slack} m of the exact ones")
        return (text.format(slack=f"{self.slack:.1e}"),)

    def time_at(self, s: float) -> float:
        """The first time of the search, s, at which the head stands at s."""
        return self.since if s <= self.start else max(self.walk.time_at(s), self.since)

    def _not_after(self, s: float) -> float:
        """A time at which the head has come no farther than s; not before the search begins."""
        t = self.time_at(s)
        step = math.ulp(t) if math.isfinite(t) else 0.0
        while t > self.since and self._lead(t, s) > 0:
            t, step = t - step, 2.0 * step
        return max(t, self.since)

    def _not_before(self, s: float) -> float:
        """A time at which the head has come at least as far as s."""
        t = self.time_at(s)
        step = math.ulp(t) if math.isfinite(t) else 0.0
        while s > self.start and t < math.inf and self._lead(t, s) < 0:
            t, step = t + step, 2.0 * step
        return t

    def _lead(self, t: float, s: float) -> float | Fraction:
        """How far past s the head stands at time t, m; not rounded, so that brackets are sure."""
        if math.isinf(t):
            return self.walk.start + float(self.walk.profile.distance(t)) - s
        return self.walk.exact_head_position(t) - Fraction(s)


def contact_search(
    walk: Walk,
    start: float,
    end: float,
    margin: float,
    progress: Progress,
    slack: float = 0.0,
    ledger: Ledger | None = None,
) -> ContactSearch:
    """A search of the walk from start to end (s), for which the dragon must stand at the start."""
    of_kind("walk", walk, Walk)
    not_negative("margin", margin, "m")
    in_order(start, end)
    walk.motion([start])  # raises where the dragon cannot stand at the start
    a, b = walk.head_position([start, end]).tolist()
    return ContactSearch(walk, a, b, margin, progress, slack, ledger, start)
