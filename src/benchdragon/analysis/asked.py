"""What questions are asked about: a plan, or a walk, and over which time."""

from benchdragon.errors import InputError, brief, of_kind
from benchdragon.i18n import _
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.plans.tables import WalkTable


def asked_of(
    asked: Walk | Plan, start: float | None = None, end: float | None = None, walk: Walk | None = None
) -> tuple[Walk, float, float]:
    """The walk, and the span, s: of a plan, or of a walk; where None its own whole span.

    `walk` is that of the plan, where it is built already.

    Raises:
        InputError: for what is neither, and a walk whose head never comes to its route's end.
        PlanError: for a plan whose walk cannot be.
    """
    if isinstance(asked, WalkTable):
        raise InputError(_("plan.walk is a table of the plan: ask about the plan itself"))
    if not isinstance(asked, Walk | Plan):
        text = _("walk must be a Plan or a Walk, not {value}")
        raise InputError(text.format(value=brief(asked)))
    if walk is None:
        walk = asked.build() if isinstance(asked, Plan) else asked
    of_kind("walk", walk, Walk)
    if start is not None and end is not None:
        return walk, start, end
    first, last = asked.span(walk) if isinstance(asked, Plan) else asked.span()
    return walk, first if start is None else start, last if end is None else end
