"""Who carries the benches of a plan: the list of names beside it."""

from benchdragon.errors import InputError, of_kind
from benchdragon.plans.people import called
from benchdragon.plans.schema import Plan
from benchdragon.plans.source import Fault
from benchdragon.plans.toml import PlanError
from benchdragon.rosters.reading import Numbering, read_roster
from benchdragon.rosters.roster import Roster


def roster_of(plan: Plan) -> Roster:
    """Who carries which bench of a plan; an empty roster where it names no list.

    Notes are in the language in use. The plan itself holds no names: not in its data, nor its hash.

    Raises:
        InputError: if `plan` is not a Plan.
        PlanError: for a list that cannot be read, and for a dragon that cannot be.

    Examples:
        >>> bd.roster_of(bd.read_plan("spiral-in")).benches
        {}
    """
    of_kind("plan", plan, Plan)
    people, source = plan.people, plan._source
    if not people.roster:
        return Roster()
    try:
        count = len(plan.dragon.build())
        numbering = Numbering(count, people.count_head, lambda bench: called(people, bench, count))
        return read_roster(source.beside(people.roster), numbering, people.sheet)
    except InputError as error:
        raise PlanError(source.sentences([Fault("people.roster", str(error))])) from None
