"""Sentences about a proposed dance, or about why there is none, for those who dance."""

from benchdragon.analysis.clock import lasting
from benchdragon.i18n import _
from benchdragon.solve.course import course_of
from benchdragon.solve.proposal import Proposal, TooSmall
from benchdragon.solve.wishes import Wishes


def proposal_lines(found: Proposal, wishes: Wishes, again: int) -> list[str]:
    """What was proposed, what was traded for it, and how many benches (0: unknown) come out again."""
    course = course_of(found.plan)
    lines = [_("All {count} benches fit.").format(count=wishes.benches)]
    if course.rounds >= 1.0:
        text = _("The dragon begins coiled: it stands in {rounds} rounds before it sets out.")
        lines.append(text.format(rounds=f"{course.rounds:.1f}"))
    else:
        lines.append(_("The dragon begins uncoiled: it stands in less than one round."))
    text = _("The head walks {way} m in {time}, in towards the middle; it does not come out again.")
    if course.out:
        text = _("The head walks {way} m in {time}: in, round, and out again.")
    if course.inside:
        text = _(
            "The head walks {way} m in {time}: it stands inside at first, turns, and comes out. The "
            "dance ends when the tail has turned; then all walk on out."
        )
    lines.append(text.format(way=f"{course.way:.0f}", time=lasting(course.seconds)))
    lines += _rounds_lines(found, wishes)
    if found.plan.route.after_street:
        lines.append(_("It comes by the street, which stays as it was."))
    lines += left_lines(found, wishes)
    if found.less_ahead:
        text = _("Before the head there is {room} m of room, less than usual, so that all of them fit.")
        lines.append(text.format(room=f"{found.plan.people.ahead:g}"))
    if found.slower:
        text = _("The head walks at {speed} m/s, or benches behind it would be too fast.")
        lines.append(text.format(speed=f"{found.plan.walk.speed:g}"))
    longer = _longer(wishes)
    if course.short:
        text = _("WARNING: {time} is hardly a dance. It gets longer with {ways}.")
        lines.append(text.format(time=lasting(course.seconds), ways=longer))
    elif not course.out:
        lines.append(_("Room to come out again, or for longer: {ways}.").format(ways=longer))
    if again:
        text = _("With {count} benches it comes out again: no more of them have the room.")
        lines.append(text.format(count=again))
    return lines


def left_lines(found: Proposal, wishes: Wishes) -> list[str]:
    """What of the square was wished that the dance does not have."""
    if wishes.street is None or found.plan.route.after_street:
        return []
    return [_("No dance of these benches was found to which the street leads: it is left out.")]


def _rounds_lines(found: Proposal, wishes: Wishes) -> list[str]:
    """How many times it coils in and out, where more than once was wished."""
    if wishes.rounds == 1:
        return []
    kept = found.plan.value("route.rounds") if found.plan.route.kind == "turn" else 1
    text = _("No dance of {rounds} rounds was found that fits: it coils once.")
    if kept > 1:
        text = _("It coils in and out {rounds} times.")
    return [text.format(rounds=wishes.rounds)]


def refusal_lines(wishes: Wishes, found: TooSmall) -> list[str]:
    """Why there is no dance, and what would do."""
    length, width = (f"{side:g}" for side in found.rectangle)
    text = _(
        "{benches} benches do not fit on this square: the dance that takes the least room of those "
        "tried needs {length} m by {width} m, room for people and margins included."
    )
    if wishes.radius is not None:
        text = _(
            "{benches} benches do not fit on this square: the dance that takes the least room of those "
            "tried needs a radius of {radius} m, room for people and margins included."
        )
    values = {"benches": wishes.benches, "length": length, "width": width}
    lines = [text.format(**values, radius=f"{found.radius:g}")]
    if wishes.obstacles:
        lines.append(_("That is a square on which nothing else stands."))
    if found.under:
        lines.append(_("All of them fit if their bearers walk under them, not beside them."))
    if found.benches:
        lines.append(_("A dragon of {count} such benches fits.").format(count=found.benches))
    return lines


def _longer(wishes: Wishes) -> str:
    """What makes room for a longer dance."""
    under = [_("bearers under their benches")] if wishes.carry == "beside" else []
    return _(", or ").join([_("fewer benches"), *under, _("a larger square")])
