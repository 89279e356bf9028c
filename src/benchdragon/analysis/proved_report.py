"""Proofs of a check's other answers: the least clearance and the greatest speed."""

from collections.abc import Callable
from dataclasses import replace

from benchdragon import budget
from benchdragon.analysis.check import Report
from benchdragon.analysis.left_open import PROOFS, Unproved
from benchdragon.analysis.proof import Claim, assumed, prove_clearance, require_flint
from benchdragon.analysis.speed_proof import SpeedClaim, handle_speeds, prove_speed
from benchdragon.budget import OverBudgetError
from benchdragon.errors import UnsureError, of_kind
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.progress import Progress, part, silent


@budget.question()
def prove_report(report: Report, progress: Progress = silent) -> Report:
    """The report with its least clearance and greatest speed proved too, to the end or a contact.

    The bracket of the clearance is 1e-6 m wide, that of the speed as narrow as the work allows. An
    answer that could not be proved stays as found, and `unproved` says why.

    Raises:
        InputError: for a number that the plan holds rounded, or a route that cannot be enclosed.
        MissingExtraError: without python-flint.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 4, "route.pitch": 1.2,
        ...                                   "route.start_turn": 4, "walk.end": 2.0})
        >>> bd.prove_report(plan.check(prove=True)).clearance.status
        'proved'
    """
    of_kind("report", report, Report)
    require_flint()
    claims, speeds, unproved = list(report.claims), list[SpeedClaim](), list(report.unproved)

    def tried(kind: str, found: Answer, prove: Callable[[], Answer]) -> Answer:
        try:
            return prove()
        except (UnsureError, OverBudgetError) as error:
            unproved.append(Unproved(kind, error))
            return found

    clearance = report.clearance
    if clearance.status == "found":
        first = part(progress, 0.0, 0.5, _(PROOFS["clearance"]))
        clearance = tried("clearance", clearance, lambda: _clearance(report, claims, first))
    last = part(progress, 0.5, 1.0, _(PROOFS["speed"]))
    speed = tried("speed", report.greatest_speed, lambda: _speed(report, speeds, last))
    return replace(
        report, clearance=clearance, greatest_speed=speed, claims=tuple(claims), speeds=tuple(speeds),
        unproved=tuple(unproved),
    )  # fmt: skip


def _until(report: Report) -> float:
    """Until when the answers of a report speak, s."""
    contact = report.first_contact
    return report.end if contact is None or contact.witness is None else contact.upper


def _clearance(report: Report, claims: list[Claim], progress: Progress) -> Answer:
    return prove_clearance(
        report.walk, report.clearance, report.start, _until(report), progress=progress, claims=claims,
        plan=report.plan,
    )  # fmt: skip


def _speed(report: Report, speeds: list[SpeedClaim], progress: Progress) -> Answer:
    """The greatest speed of a handle, proved; UnsureError unless the head keeps one speed."""
    plan, found = report.plan, report.greatest_speed
    if plan.walk.profile or plan.cues.cue or plan.cues.acceleration is not None:
        raise UnsureError(N_("it is proved only where the head keeps one speed"))
    if found.witness is None:
        raise UnsureError(N_("there is no speed that could be proved"))
    claim = prove_speed(
        report.walk, report.start, _until(report), found.witness.s, plan=plan, progress=progress
    )
    lower, upper = handle_speeds(plan.walk.speed, claim)
    speeds.append(claim)
    return replace(
        found, value=min(max(found.value, lower), upper), lower=lower, upper=upper, status="proved",
        assumptions=(*found.assumptions, assumed(report.walk, plan)),
    )  # fmt: skip
