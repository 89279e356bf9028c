"""Better turns: the engine's search over a family, then exact figures of what it found.

During the search a turn is evaluated by samples of the first benches: all later ones pass it in the
same way. The result is evaluated by `head_speed` and `contact`, over continuous time and with the whole
dragon; where the samples were too favourable, the search runs again with narrower limits.
"""

import math
import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from benchdragon import budget
from benchdragon.analysis.contact import least_clearance
from benchdragon.analysis.obstacles import least_distance
from benchdragon.analysis.speed import QUANTITIES, given_limits, greatest_of
from benchdragon.errors import InputError, NoSolutionError, of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels.turn_peaks import TurnMeasure
from benchdragon.model.answer import Answer
from benchdragon.model.turns import Turn
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, part, silent
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.turn_goal import EXCEEDED, PRUDENCE, TurnFamily, TurnGoal
from benchdragon.solve.turn_question import SOUGHT, Seen, TurnQuestion

# Share of the work that the search all over the family takes.
SEARCHED = 0.7
# How often limits are narrowed after exact figures, by PRUDENCE more than these require, and four times
# as much each time.
NARROWINGS = 8
# What touches counts as so deep, m.
DEEP = 1e-3
# A limit that is kept to within this share counts as active.
ACTIVE = 2e-3
# How exactly rates are known, as a share of them, and distances, m.
RATE, DISTANCE = 1e-7, 1e-5


@dataclass(frozen=True)
class BestTurn:
    """The best turn that was found.

    Attributes:
        plan: the plan with this turn.
        turn: the turn itself.
        objective: its value, which is one end of the bracket; the other is infinite where no bound on
            better ones was proved (solve/turn_proof.py).
        length: of the turn itself, m.
        way: whole way inside the disc, m.
        head_speed: the greatest constant head speed under the plan's limits; None without a limit.
        clearance: the least over the whole manoeuvre.
        active: names of the limits that it just keeps: see turn_question.LIMITS.

    Examples:
        >>> plan = bd.read_plan("turn", {"dragon.benches": 4, "walk.end": 20.0})
        >>> best = plan.best_turn()
        >>> best.length < plan.route.turn(plan).length
        True
    """

    plan: Plan
    turn: Turn
    objective: Answer
    length: float
    way: float
    head_speed: Answer | None
    clearance: Answer
    active: tuple[str, ...]

    def as_json(self) -> dict[str, Any]:
        """Everything as plain data; the turn as a plan says it, and piece by piece."""
        speed = self.head_speed
        return {
            **self.objective.as_json(),
            "turn": self.plan.turn.model_dump(mode="json"),
            "pieces": [
                {"length": length, "start_curvature": a, "end_curvature": b}
                for length, a, b in self.turn.pieces
            ],
            "length": self.length,
            "way": self.way,
            "least_radius": self.turn.least_radius,
            "greatest_head_speed": None if speed is None else speed.as_json(),
            "clearance": self.clearance.as_json(),
            "active": list(self.active),
        }


@budget.question()
def best_turn(plan: Plan, goal: TurnGoal | None = None, *, progress: Progress = silent) -> BestTurn:
    """The best turn of the plan's family for a wish, under the plan's limits.

    Limits are limits.speed with the head at walk.speed (or as fast as it may, if that is the wish),
    those of accelerations and turning rates, limits.margin over the whole manoeuvre, until the tail is
    out, and the margins of the venue and of obstacles. Joints that the plan says stay. The search is
    the same each time; that nothing better exists is not shown.

    Raises:
        InputError: for a plan without a turn, or if no turn keeps the limits.
        PlanError: for speeds of the head that cannot be.

    Examples:
        >>> plan = bd.read_plan("turn", {"dragon.benches": 4, "walk.end": 20.0})
        >>> best = bd.best_turn(plan)
        >>> best.plan.turn.family
        'arc-arc'
    """
    of_kind("plan", plan, Plan)
    wished = TurnGoal() if goal is None else goal
    of_kind("wish", wished, TurnGoal)
    if wished.objective == "speed" and plan.limits.speed is None:
        raise InputError(_("the plan has no limit of speed: set limits.speed=2, for example"))
    plan.profile()  # a wrong one is reported before the search
    family, began = TurnFamily(plan, wished), clock.perf_counter()
    with TurnQuestion(family) as question:
        seen = question.best(part(progress, 0.0, SEARCHED), _("global search"))
        return _settled(family, question, seen, part(progress, SEARCHED, 1.0), began)


def _settled(
    family: TurnFamily, question: TurnQuestion, seen: Seen, progress: Progress, began: float
) -> BestTurn:
    """The best turn near one that was seen, by exact figures."""
    for narrowing in range(NARROWINGS):
        if not seen.allowed:
            break
        best, exact = _exact(family, question, seen, began)
        if exact is None:
            return best
        question.correct(seen.figures, exact, PRUDENCE * 4.0**narrowing)
        seen = question.near(seen.x, part(progress, narrowing / NARROWINGS, 1.0), _("local search"))
    raise NoSolutionError(_("no turn of this family was found that keeps the limits"))


def _exact(
    family: TurnFamily, question: TurnQuestion, seen: Seen, began: float
) -> tuple[BestTurn, list[float] | None]:
    """A turn with its exact figures; these, too, if one of them exceeds a limit."""
    plan, goal = family.with_turn(seen.x), family.goal
    exact, clearance = _exact_figures(plan, seen.figures, _judged(family))
    exceeds = question.exceeded(exact)
    value, unit = exact[SOUGHT[goal.objective]], "m"
    if goal.objective == "disc":
        plan = plan.with_value("disc.radius", value)
    speed = greatest_head_speed(plan) if plan.limits.speed is not None else None
    bracket = value, -math.inf, value  # nothing tells how much better another may be
    if goal.objective == "acceleration":
        most, unit = value * plan.walk.speed**2, "m/s^2"
        bracket = most, -math.inf, most
    elif goal.objective == "speed" and speed is not None:
        bracket, unit = (speed.value, speed.lower, math.inf), "m/s"
    answer = Answer(
        *bracket, unit, "found", None,
        (_("best that was found in this family; better ones may exist"),),
        question.tried, clock.perf_counter() - began,
    )  # fmt: skip
    turn, disc = plan.turn.build(family.pitch, family.disc), plan.disc.radius or family.disc
    active = tuple(name for name, over in exceeds.items() if over >= -ACTIVE and name != goal.objective)
    best = BestTurn(plan, turn, answer, turn.length, turn.way(disc), speed, clearance, active)
    return best, exact if max(exceeds.values(), default=0.0) > EXCEEDED else None


def _judged(family: TurnFamily) -> list[str]:
    """The rates that are limited or sought."""
    sought = SOUGHT[family.goal.objective]
    limited = given_limits(family.plan)
    return [name for name, rate in QUANTITIES.items() if name in limited or rate.kind == sought]


def _exact_figures(
    plan: Plan, seen: Sequence[float], rates: Sequence[str]
) -> tuple[list[float], Answer]:
    """The sampled figures made exact, on the safe side, and the least clearance."""
    walk, exact = plan.build(), [*seen]
    first, last = float(walk.route.joints[1]), walk.head_where_tail(float(walk.route.joints[-2]))
    for name in rates:
        quantity = QUANTITIES[name]
        exact[quantity.kind] = greatest_of(walk, quantity, first, last, tolerance=RATE).upper
    start, end = walk.time_at(first), walk.time_at(last)
    # How far to look for the least clearance, m: somewhat farther than what was seen.
    within = max(-1.2 * seen[TurnMeasure.APART], plan.limits.margin, 0.05)
    clearance = least_clearance(walk, start, end, within=within, tolerances=(DISTANCE,))
    exact[TurnMeasure.APART] = -_sure(clearance)
    lacking: list[float] = []
    for obstacle in plan.obstacles():
        distance = least_distance(walk, obstacle, start, end, tolerances=(DISTANCE,))
        lacking.append(obstacle.margin - _sure(distance))
    exact[TurnMeasure.BESIDE] = max(lacking, default=math.nan)
    return exact, clearance


def _sure(distance: Answer) -> float:
    """At most a distance, m; where benches touch, as if they were DEEP in one another."""
    return distance.lower if distance.value > 0.0 else -DEEP


def pareto_front(
    plan: Plan, speeds: Sequence[float], goal: TurnGoal | None = None, *, progress: Progress = silent
) -> list[BestTurn]:
    """Shortest turns for head speeds (m/s, increasing) that they must allow under limits.speed.

    The turn of each speed is sought all over the family, and downhill from those of the speeds beside
    it. Of what is found each speed has the shortest that allows it (`undominated`); shorter ones may
    exist. The list ends where none is found. `goal` says what is to be short (a length, or the disc),
    and the other limits.

    Raises:
        InputError: without limits.speed, or if not even the first speed is possible.
    """
    if plan.limits.speed is None:
        raise InputError(_("the plan has no limit of speed: set limits.speed=2, for example"))
    wished = goal or TurnGoal()
    families = [
        TurnFamily(plan.with_value("walk.speed", positive("speed", speed, "m/s")), wished)
        for speed in speeds
    ]
    texts = [_("turns for {speed} m/s").format(speed=f"{speed:.3f}") for speed in speeds]
    with budget.question(len(speeds)):
        seen = _seen(families, part(progress, 0.0, SEARCHED), texts)
        if not seen:
            raise NoSolutionError(_("no turn of this family was found that keeps the limits"))
        found = []
        for n, x in enumerate(seen):
            told, began = part(progress, SEARCHED + 0.3 * n / len(seen), 1.0), clock.perf_counter()
            with TurnQuestion(families[n]) as question:
                near = question.near(x, told, texts[n])
                found.append(_settled(families[n], question, near, told, began))
    return undominated(found)


def _seen(
    families: Sequence[TurnFamily], progress: Progress, texts: Sequence[str]
) -> list[list[float]]:
    """The unknowns of the best turn of each family, up to the first without one."""
    found: list[Seen] = []
    for n, family in enumerate(families):
        with TurnQuestion(family) as question:
            told = part(progress, n / len(families), (n + 1) / len(families))
            best = question.best(told, texts[n])
            for below in found[-1:]:
                best = _better(best, question.near(below.x, silent, ""), family)
        if not best.allowed:
            break
        found.append(best)
    for n in range(len(found) - 2, -1, -1):
        with TurnQuestion(families[n]) as question:
            found[n] = _better(found[n], question.near(found[n + 1].x, silent, ""), families[n])
    return [one.x for one in found]


def _better(one: Seen, other: Seen, family: TurnFamily) -> Seen:
    """The better of two turns."""
    sought = SOUGHT[family.goal.objective]
    return other if other.allowed and not one.figures[sought] <= other.figures[sought] else one


def undominated(front: Sequence[BestTurn]) -> list[BestTurn]:
    """For each head speed of a front of shortest turns the best of all of them that allow it.

    A turn sought for another speed may be shorter and allow this one, too: the searches do not show
    that it is not. It then stands for both speeds, so that no turn is longer and slower than another.
    """
    found = []
    for own in front:
        speed = own.plan.walk.speed
        fit = [own, *(one for one in front if one.head_speed and one.head_speed.lower >= speed)]
        best = min(fit, key=lambda one: one.objective.value)
        found.append(best if best is own else _at_speed(best, speed))
    return found


def _at_speed(best: BestTurn, speed: float) -> BestTurn:
    """A turn with the head at another speed that it allows, m/s."""
    tight = best.head_speed is not None and best.head_speed.lower <= speed * (1.0 + ACTIVE)
    active = tuple(name for name in best.active if tight or name not in QUANTITIES)
    return replace(best, plan=best.plan.with_value("walk.speed", speed), active=active)
