"""The best turn of a family, proved to within a gap: branch and bound over boxes of turns.

The best turn that was found is one end of a bracket. For the other, the ranges of the family's numbers
are halved into boxes until none may hold a turn that is better by more than the gap: all of its turns
are too long, or one handle is too fast on all of them (proofs/turn_boxes.py). Which handle, and where,
the turn in the middle tells, sampled in doubles; that decides nothing.
"""

import heapq
import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from benchdragon import budget
from benchdragon.analysis.proof import require_flint
from benchdragon.errors import InputError, positive
from benchdragon.i18n import _
from benchdragon.kernels import motion_bounds
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray, RouteRow
from benchdragon.kernels.turn_trial import FEW
from benchdragon.number_format import finite_or_none
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.solve.turn import BestTurn
from benchdragon.solve.turn_goal import EXCEEDED, TurnFamily, TurnGoal
from benchdragon.solve.turn_statement import Ends, TurnStatement, ranges_of

if TYPE_CHECKING:
    from benchdragon.proofs.turn_boxes import Turns, Witness

# Greatest width of the bracket, m or m/s, and greatest number of boxes.
GAP, MOST_BOXES = 1e-3, 20_000
PROVABLE = ("way", "length", "speed")
# Limits count as kept that are exceeded by less than this share: more than the search allows.
KEPT = 2.0 * EXCEEDED
# Bytes of a handle that is placed.
PLACED = 64
# Head positions at which the turn in the middle of a box is sampled; and again, around a peak.
SAMPLES, CLOSER = 400, 41
# Peaks of which witnesses are taken, and the share of a peak's excess that an earlier handle must have.
PEAKS, ENOUGH = 2, 0.7


@dataclass
class Node:
    """A box of turns: halved across one number, or a leaf with what shows its bound.

    Attributes:
        low: the least of each number.
        high: the greatest of each.
        bound: what no turn of it is better than: see `Turns.bound`.
        witness: what shows that, besides the box itself.
        across: the number across which it is halved.
        halves: both halves, if it is.
    """

    low: Ends
    high: Ends
    bound: float
    witness: "Witness | None" = None
    across: int = 0
    halves: "tuple[Node, Node] | None" = None

    def split(self, across: int) -> tuple[tuple[Ends, Ends], tuple[Ends, Ends]]:
        """Both halves across a number: each its least and greatest numbers."""
        cut = 0.5 * (self.low[across] + self.high[across])
        below, above = list(self.high), list(self.low)
        below[across] = above[across] = cut
        return (self.low, tuple(below)), (tuple(above), self.high)

    def leaves(self) -> "Iterator[Node]":
        """All boxes that are not halved."""
        open_still = [self]
        while open_still:
            node = open_still.pop()
            if node.halves is None:
                yield node
            else:
                open_still += reversed(node.halves)


@dataclass(frozen=True)
class TurnProof:
    """A bound that no turn of a family exceeds.

    Attributes:
        plan: of whose turns.
        goal: of the search.
        turns: which turns, and what they must keep.
        root: the box of all of them, halved as was needed.
        bound: no turn is shorter, m, or lets the head walk faster, m/s.
        gap: how much better than the best that was found that is, at most 0 apart from rounding.
        boxes: how many boxes were bounded.
        complete: whether the gap is as small as required.
    """

    plan: Plan
    goal: TurnGoal
    turns: "Turns"
    root: Node
    bound: float
    gap: float
    boxes: int
    complete: bool

    def statement(self, bound: float) -> TurnStatement:
        """That no turn is better than a bound, m or m/s."""
        return TurnStatement(self.plan, self.goal, self.root.low, self.root.high, bound)


def turns_of(plan: Plan, goal: TurnGoal) -> "tuple[Turns, Ends, Ends]":
    """The turns among which a plan's best turn is searched, and the ranges of their numbers.

    Limits are wider by KEPT, so that the proof holds for all turns that a search accepts.

    Raises:
        InputError: for a family or a wish about which nothing can be proved.
        MissingExtraError: without python-flint.
    """
    require_flint()
    from benchdragon.proofs.turn_boxes import Turns
    from benchdragon.proofs.turn_shape import FAMILIES

    table, family = plan.turn, TurnFamily(plan, goal)
    if table.family not in FAMILIES or table.ease or goal.objective not in PROVABLE:
        text = _(
            "a bound on better turns can be proved for the families {families} without clothoids, "
            "and for {objectives}"
        )
        raise InputError(text.format(families=", ".join(FAMILIES), objectives=", ".join(PROVABLE)))
    limit = plan.limits.speed
    turns = Turns(
        table.family,
        family.pitch,
        family.disc,
        tuple(plan.dragon.build().links.tolist()),
        goal.objective,
        math.inf if limit is None else limit * (1.0 + KEPT),
        plan.walk.speed,
        family.narrowest * (1.0 - KEPT),
        goal.longest * (1.0 + KEPT),
        goal.longest_way * (1.0 + KEPT),
    )
    low, high = zip(*family.bounds, strict=True)
    return turns, low, high


@budget.question()
def proved_bound(
    plan: Plan,
    goal: TurnGoal,
    value: float,
    *,
    gap: float = GAP,
    most: int = MOST_BOXES,
    progress: Progress = silent,
) -> TurnProof:
    """A bound of the family, at most `gap` (m or m/s) better than the best turn if that succeeds.

    `value` is that of the best turn known. The search ends early after `most` boxes, or when it is
    interrupted: the bound reached by then holds.

    Raises:
        InputError: as `turns_of`, or for a gap that is not positive.
    """
    positive("gap", gap)
    turns, low, high = turns_of(plan, goal)
    sign = -1.0 if goal.objective == "speed" else 1.0
    search = _Search(turns, TurnFamily(plan, goal), sign * value - gap)
    root = search.added(low, high)
    try:
        search.run(most, progress)
    except KeyboardInterrupt as error:
        if error.args:  # the whole program is to end, not the search
            raise
    least = min(sign * value, *(node.bound for node in root.leaves()))
    complete = least >= search.wanted
    return TurnProof(
        plan, goal, turns, root, sign * least, abs(value - sign * least), search.boxes, complete
    )


@dataclass
class _Search:
    """Boxes that may hold better turns than allowed, the most promising first."""

    turns: "Turns"
    family: TurnFamily
    wanted: float
    boxes: int = 0
    _open: list[tuple[float, int, Node, Ends]] = field(default_factory=list)

    def added(self, low: Ends, high: Ends, witness: "Witness | None" = None) -> Node:
        """A box, queued."""
        found = self.turns.bound(low, high, witness)
        self.boxes += 1
        node = Node(low, high, found.least, witness)
        heapq.heappush(self._open, (node.bound, self.boxes, node, found.spread))
        return node

    def run(self, most: int, progress: Progress) -> None:
        """Bisect boxes until none is promising, or so many have been bounded."""
        first = self._open[0][0]
        while self._open and self._open[0][0] < self.wanted and self.boxes < most:
            bound, _number, node, spread = heapq.heappop(self._open)
            spread = self._shown(node, spread)
            if node.bound < self.wanted:
                self._halve(node, spread)
            share = (bound - first) / (self.wanted - first) if math.isfinite(first) else 0.0
            progress(max(share, 0.0), _("{boxes} boxes of turns").format(boxes=self.boxes))

    def _shown(self, node: Node, spread: Ends) -> Ends:
        """Let witnesses raise a box's bound; by how much with each number what they show may vary."""
        for witness in self._witnesses(node):
            found = self.turns.bound(node.low, node.high, witness)
            spread = found.spread
            if found.least > node.bound and (found.least >= self.wanted or self._fastest):
                node.bound, node.witness = found.least, witness
            if node.bound >= self.wanted:
                break
        return spread

    @property
    def _fastest(self) -> bool:
        """Whether the fastest turn is sought: bounds come from witnesses alone then."""
        return self.turns.objective == "speed"

    def _halve(self, node: Node, spread: Ends) -> None:
        node.across = max(range(len(spread)), key=lambda k: spread[k])
        one, other = node.split(node.across)
        witness = node.witness if self._fastest else None
        node.halves = self.added(*one, witness), self.added(*other, witness)

    def _witnesses(self, node: Node) -> "Iterator[Witness]":
        """Handles that are too fast on the turn in the middle of a box, the fastest first."""
        from benchdragon.proofs.turn_boxes import Witness

        middle = [0.5 * (a + b) for a, b in zip(node.low, node.high, strict=True)]
        try:
            turn = self.family.turn(middle)
        except InputError:
            return
        rows = turn.rows(lead=1.0, trail=1000.0)
        start = float(rows[1, RouteRow.S_START])
        for s, handle in _fast(rows, self.family.dragon.links[:FEW], self._slow()):
            ends = (True, s - start - turn.length, handle), (False, s - start, handle)
            for end in ends if s - start > 0.5 * turn.length else reversed(ends):
                yield Witness(*end)

    def _slow(self) -> float:
        """A ratio of speeds that decides nothing."""
        return 1.0 if self._fastest else self.turns.fastest / self.turns.head


def _fast(rows: FloatArray, links: FloatArray, slow: float) -> list[tuple[float, int]]:
    """Head positions, m, and handles that are there more than `slow` times as fast as the head.

    One for each of PEAKS peaks: the first handle that comes near it.
    """
    first, last = float(rows[1, RouteRow.S_START]), float(rows[-1, RouteRow.S_START] + links.sum())
    at, found = np.linspace(first, last, SAMPLES), []
    ratios = _ratios(rows, links, at)
    if ratios is None:
        return []
    left, step = ratios.max(axis=0), float(at[1] - at[0])
    for _peak in range(PEAKS):
        n = int(left.argmax())
        closer = np.linspace(max(float(at[n]) - step, first), float(at[n]) + step, CLOSER)
        near = _ratios(rows, links, closer)
        left[max(n - 3, 0) : n + 4] = 0.0
        if near is None or near.max() <= slow:
            continue
        enough = slow + ENOUGH * (near.max() - slow)
        handle = int(np.flatnonzero(near.max(axis=1) >= enough)[0])
        found.append((float(closer[near[handle].argmax()]), handle))
    return found


def _ratios(rows: FloatArray, links: FloatArray, at: FloatArray) -> FloatArray | None:
    """Speeds of handles by the head's at head positions, m, (handles, positions)."""
    budget.hold(PLACED * len(at) * (len(links) + 1))
    budget.spend(len(at) * (len(links) + 1))
    places = empty_placements(len(links) + 1, len(at))
    stands = motion_bounds.place_chain(rows, links, at, 0, len(at), places)
    return places.ratio if stands else None


def _rounded_up(gap: float) -> str:
    """A distance with two figures, no smaller than it is."""
    if not gap > 0.0:
        return "0"
    unit = 10.0 ** (math.floor(math.log10(gap)) - 1)
    return f"{math.ceil(gap / unit) * unit:.2g}"


def with_proof(best: BestTurn, proof: TurnProof) -> BestTurn:
    """A best turn whose bracket is what was proved; in words too."""
    answer, bound = best.objective, proof.bound
    if not math.isfinite(bound):
        told = (*answer.assumptions, _("no bound on better turns could be proved"))
        return replace(best, objective=replace(answer, assumptions=told))
    text = _("{boxes} boxes of turns were examined; the best found is within {gap} {unit} of that")
    told = (
        proof.statement(bound).sentence(),
        text.format(boxes=proof.boxes, gap=_rounded_up(proof.gap), unit=answer.unit),
    )
    if not proof.complete:
        told += (_("more boxes would bring the two closer together"),)
    if proof.turns.objective == "speed":
        bounded = replace(answer, upper=max(bound, answer.value), assumptions=told)
    else:
        bounded = replace(answer, lower=min(bound, answer.value), assumptions=told)
    return replace(best, objective=bounded)


def proof_json(proof: TurnProof) -> dict[str, Any]:
    """A proof as plain data; lengths in m, speeds in m/s."""
    ranges = ranges_of(proof.turns.family, proof.root.low, proof.root.high)
    return {
        "family": proof.turns.family,
        "ranges": {name: list(ends) for name, ends in ranges.items()},
        "bound": finite_or_none(proof.bound),
        "gap": finite_or_none(proof.gap),
        "boxes": proof.boxes,
        "complete": proof.complete,
    }
