"""Certificates of the best turn: which boxes of turns hold none that is better, and what shows each.

Verification does not rely on the search: the boxes are made again from the plan's ranges by bisection,
so that none is left out, and each bound is computed again (proofs/turn_boxes.py).
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from benchdragon import budget
from benchdragon.analysis.certificate import plan_in
from benchdragon.analysis.proof import require_flint
from benchdragon.errors import InputError, UnsureError
from benchdragon.i18n import _
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.solve.turn_goal import TurnGoal
from benchdragon.solve.turn_proof import Node, TurnProof, turns_of
from benchdragon.solve.turn_statement import TurnStatement
from benchdragon.version import __version__

FORMAT: Literal["benchdragon turn certificate"] = "benchdragon turn certificate"
# Boxes of one certificate; and how often one is halved.
MOST_BOXES, MOST_DEEP = 1_000_000, 500

Number = Annotated[float, Field(allow_inf_nan=False)]
Written = tuple[bool, Number, int]


class TurnCertificate(BaseModel):
    """The content of a certificate file.

    Attributes:
        bound: no turn is shorter, m, or lets the head walk faster, m/s.
        across: of each box the number across which it is halved, or -1; each before its halves.
        witnesses: of each box that is not halved what shows its bound, if the box alone does not.
    """

    model_config = ConfigDict(extra="forbid", strict=True)

    format: Literal["benchdragon turn certificate"] = FORMAT
    version: str = Field(max_length=100)
    plan: dict[str, Any]
    plan_sha256: str = Field(max_length=64)
    objective: str = Field(max_length=100)
    least_radius: Number
    longest: Number | None
    longest_way: Number | None
    bound: Number
    across: list[int] = Field(min_length=1, max_length=MOST_BOXES)
    witnesses: list[Written | None] = Field(min_length=1, max_length=MOST_BOXES)

    @property
    def goal(self) -> TurnGoal:
        """The goal of the search."""
        longest, way = (math.inf if x is None else x for x in (self.longest, self.longest_way))
        return TurnGoal(self.objective, self.least_radius, longest, way)


def is_turn_certificate(path: Path) -> bool:
    """Whether a file begins as such a certificate does."""
    try:
        if not path.is_file():  # a pipe would be waited for
            return False
        with path.open("rb") as file:
            return FORMAT.encode() in file.read(100)
    except (OSError, UnicodeEncodeError):  # `read_certificate` reports why it cannot be read
        return False


def certificate_of(plan: Plan, goal: TurnGoal, proof: TurnProof) -> TurnCertificate:
    """The certificate of what was proved about a plan's best turn.

    Raises:
        InputError: if nothing was.
    """
    if not math.isfinite(proof.bound):
        raise InputError(_("nothing was proved, so that there is no certificate"))
    return TurnCertificate(
        version=__version__, plan=plan.data(), plan_sha256=plan.sha256, objective=goal.objective,
        least_radius=goal.least_radius, longest=goal.longest if math.isfinite(goal.longest) else None,
        longest_way=goal.longest_way if math.isfinite(goal.longest_way) else None, bound=proof.bound,
        across=[-1 if node.halves is None else node.across for node in _in_order(proof.root)],
        witnesses=[_written(leaf) for leaf in proof.root.leaves()],
    )  # fmt: skip


def _written(leaf: Node) -> Written | None:
    if leaf.witness is None:
        return None
    backwards, head, handle = leaf.witness
    return backwards, head, handle


def _in_order(root: Node) -> Iterator[Node]:
    """All boxes, each before its halves."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        yield node
        if node.halves is not None:
            waiting += reversed(node.halves)


def verify(certificate: TurnCertificate, progress: Progress = silent) -> list[str]:
    """Show again that no turn is better than a certificate says; sentences: see `shown`."""
    return [shown(certificate, progress).sentence()]


@budget.question()
def shown(certificate: TurnCertificate, progress: Progress = silent) -> TurnStatement:
    """What a certificate proves, after every box of turns is proved again.

    Raises:
        InputError, PlanError: for a plan that is none, or another than its hash says, an unknown
            version, or boxes that do not fit together.
        MissingExtraError: without python-flint.
        UnsureError: if a box may hold a better turn.
    """
    require_flint()
    plan = plan_in(certificate.version, certificate.plan, certificate.plan_sha256)
    from benchdragon.proofs.turn_boxes import Witness

    goal = certificate.goal
    turns, low, high = turns_of(plan, goal)
    wanted = -certificate.bound if goal.objective == "speed" else certificate.bound
    leaves = list(_leaves(certificate, Node(low, high, -math.inf)))
    if len(leaves) != len(certificate.witnesses):
        raise InputError(_("the boxes of turns in the certificate do not fit together"))
    there = False
    for n, (leaf, said) in enumerate(zip(leaves, certificate.witnesses, strict=True)):
        witness = None if said is None else Witness(*said)
        least = turns.bound(leaf.low, leaf.high, witness).least
        if not least >= wanted:
            raise UnsureError(_("box {n} of the turns may hold a better one").format(n=n + 1))
        there = there or least < math.inf
        progress((n + 1) / len(leaves), "")
    return TurnStatement(plan, goal, low, high, certificate.bound if there else None)


def _leaves(certificate: TurnCertificate, root: Node) -> Iterator[Node]:
    """The boxes that are not halved."""
    waiting = [(root, 0)]
    for across in certificate.across:
        if not (waiting and -1 <= across < len(root.low) and waiting[-1][1] <= MOST_DEEP):
            raise InputError(_("the boxes of turns in the certificate do not fit together"))
        node, deep = waiting.pop()
        if across < 0:
            yield node
            continue
        one, other = node.split(across)
        waiting += [(Node(*other, -math.inf), deep + 1), (Node(*one, -math.inf), deep + 1)]
    if waiting:
        raise InputError(_("the boxes of turns in the certificate do not fit together"))
