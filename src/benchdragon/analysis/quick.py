"""Quick answers, for a slider that is being dragged: the same questions with wider brackets.

Brackets are established by the same bounds as everywhere, and the first contact is as exact as ever.
What has a limit that lies inside of a wide bracket is asked again to the last digit.
"""

from benchdragon.analysis.check import (
    Report,
    all_findings,
    decided_speed,
    limited_peaks,
    no_clearance,
    sure_contact,
)
from benchdragon.analysis.contact import clearance_above, first_contact, least_clearance
from benchdragon.analysis.speed import greatest_speed
from benchdragon.errors import UnsureError, WalkError
from benchdragon.model.answer import Answer
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

# How wide brackets may be: of clearances, m, and of speeds, relative.
CLEARANCE, SPEED = 1e-3, 1e-4


def quick_verdict(plan: Plan) -> Report:
    """What `check` finds, with a clearance to 1 mm and a greatest speed to 1e-4 of itself.

    Raises:
        WalkError: if no contact comes before the dragon cannot walk on.
        UnsureError: if it could not be decided whether it can.
    """
    walk, margin = plan.build(), plan.limits.margin
    start, end = plan.span(walk)
    contact, until, clearance = None, end, _clearance(walk, start, end, margin)
    if clearance is None:
        contact = first_contact(walk, start, end, margin=margin)
        contact = sure_contact(walk, start, end, margin, contact)
        until = end if contact is None or contact.witness is None else contact.upper
        clearance = no_clearance(contact) or least_clearance(
            walk, start, until, tolerances=(CLEARANCE,)
        )
    speed = greatest_speed(walk, start, until, tolerance=SPEED)
    speed = decided_speed(plan, walk, (start, until), speed)
    peaks = limited_peaks(plan, walk, (start, until))
    findings = all_findings(plan, walk, (start, until), contact, {"speed": speed, **peaks})
    return Report(plan, start, end, contact, clearance, speed, peaks, findings)


def _clearance(walk: Walk, start: float, end: float, margin: float) -> Answer | None:
    """The least clearance of a walk that needs no search for contact; None if it may need one."""
    try:
        return clearance_above(walk, start, end, margin, tolerances=(CLEARANCE,))
    except (WalkError, UnsureError):
        return None
