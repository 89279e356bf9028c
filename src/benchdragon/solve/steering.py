"""How well a troupe steers back to its line, from how far a bench came off it."""

from scipy.optimize import brentq

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.off_tracking import off_tracking
from benchdragon.errors import NoSolutionError, positive, whole
from benchdragon.i18n import _
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

# The greatest gain that is taken for one, 1/m: an offset falls to 37 % over 10 cm.
STEEREST = 10.0


@budget.question()
def steering_gain(walk: Walk | Plan, bench: int, offset: float) -> float:
    """The steering gain, 1/m, of a troupe whose bench came so far off the line of a walk.

    A bend of known radius is chalked on the ground and walked, until that bench has left it; how far
    inside the line its rear handle passes at most is measured by tape. It says the more the less that
    is than the radius.

    Args:
        walk: what was walked: a plan or a walk.
        bench: its number, from 1.
        offset: how far its rear handle came off the line at most, to either side, m.

    Raises:
        InputError: for a bench that there is not, and an offset that is not positive.
        NoSolutionError: where bearers who do not steer at all stay nearer to the line, where those of
            the greatest gain, STEEREST, do not, and where the bench is farthest off as the walk ends.
        WalkError: if the dragon cannot stand at the start.

    Examples:
        >>> bend = bd.Route.joined([bd.Line(10.0), bd.Arc(5.0, degrees=90), bd.Line(30.0)])
        >>> dragon = bd.Dragon.uniform(12, head_length=2.05, body_length=2.05)
        >>> f"{bd.steering_gain(bd.Walk(dragon, bend), 10, 0.69):.2f}"
        '0.20'
    """
    walk, start, end = asked_of(walk)
    positive("offset", offset)
    whole("bench", bench, 1, len(walk.dragon))

    long = float(walk.dragon.links.sum())  # so far a bench is taken to be off where one folds

    def more(gain: float) -> float:
        found = off_tracking(walk, gain, start, end).benches
        return max(found[bench - 1].left, found[bench - 1].right) - offset if found else long

    if more(0.0) < 0.0 or more(STEEREST) > 0.0:
        text = _(
            "no steering gain from 0 to {most} per metre brings the rear handle of bench {bench} "
            "{offset} m off the line"
        )
        raise NoSolutionError(text.format(most=f"{STEEREST:g}", bench=bench, offset=f"{offset:g}"))
    gain = float(brentq(more, 0.0, STEEREST, xtol=1e-6))
    one = off_tracking(walk, gain, start, end).benches[bench - 1]
    if (one.left_at if one.left > one.right else one.right_at) >= walk.head_position(end):
        text = _("the walk ends before bench {bench} has left the bend: walk on")
        raise NoSolutionError(text.format(bench=bench))
    return gain
