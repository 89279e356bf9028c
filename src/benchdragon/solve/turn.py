"""Better turns: a global search over a family, then a local one, then exact figures of what it found.

While it searches, a turn is judged by sampling the first benches of the dragon: all later ones walk
through it as those do. What comes out is judged by `head_speed` and `contact`, over continuous time and
with the whole dragon, and searched anew with narrower limits where sampling had flattered it.
"""

import contextlib
import math
import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from benchdragon import budget
from benchdragon.analysis.contact import least_clearance
from benchdragon.analysis.obstacles import least_distance
from benchdragon.analysis.speed import QUANTITIES, greatest_of
from benchdragon.errors import InputError, NoSolutionError, of_kind, positive
from benchdragon.i18n import _
from benchdragon.model.answer import Answer
from benchdragon.model.turns import Turn
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, part, silent
from benchdragon.solve import minima
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.minima import constrained_point, downhill_point, low_points
from benchdragon.solve.turn_trials import EXCEEDED, STEPS, WORSE, TurnEvaluator, TurnGoal

# Share of the work that the search all over the family takes.
SEARCHED = 0.8
# Of the speeds of a front, the shares along it at which the whole family is searched; evaluations of
# each local search by coarse sampling, and the share of the work that this takes.
ANCHORS, SKETCH, SKETCHED = (0.0, 0.5, 1.0), 100, 0.4
# How often limits are narrowed after exact figures, and by what share more than those tell, twice as
# much each time.
NARROWINGS, PRUDENCE = 8, 5e-5
# What touches counts as so deep, m.
DEEP = 1e-3
# A limit that is kept to within this share counts as active.
ACTIVE = 2e-3
# Figures of a turn that does not exist, in SI units.
HOPELESS = 1e4


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
        active: names of the limits that it just keeps: keys of `TurnEvaluator.rooms`.
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
    """
    of_kind("plan", plan, Plan)
    wished = TurnGoal() if goal is None else goal
    of_kind("wish", wished, TurnGoal)
    if wished.objective == "speed" and plan.limits.speed is None:
        raise InputError(_("the plan has no limit of speed: set limits.speed=2, for example"))
    plan.profile()  # a wrong one is told before the search, not after it
    return _best(TurnEvaluator(plan, wished), progress)


def _best(evaluator: TurnEvaluator, progress: Progress) -> BestTurn:
    began = clock.perf_counter()
    starts = _global_search(evaluator, part(progress, 0.0, SEARCHED, _("global search")))
    evaluator.step = STEPS[1]
    progress(SEARCHED, _("local search"))
    ends = [_local_search(evaluator, start, minima.LOCAL) for start in starts]
    return _settled(evaluator, min(ends, key=evaluator.score), progress, began)


def _settled(evaluator: TurnEvaluator, x: list[float], progress: Progress, began: float) -> BestTurn:
    """The local optimum near x, by exact figures."""
    for narrowing in range(NARROWINGS):
        progress(SEARCHED, _("local search"))
        x = _local_search(evaluator, x, minima.LOCAL)
        progress(SEARCHED, _("exact figures"))
        best, exceeded = _exact(evaluator, x, began, PRUDENCE * 2.0**narrowing)
        if not exceeded:
            return best
    raise NoSolutionError(_("no turn of this family was found that keeps the limits"))


def _global_search(evaluator: TurnEvaluator, progress: Progress) -> list[list[float]]:
    """The best turns that are found all over the family."""
    found = low_points(evaluator.score, evaluator.bounds, progress)
    starts = [x for x, score in found if score < WORSE]
    if not starts:
        raise NoSolutionError(_("no turn of this family was found that keeps the limits"))
    return starts


def _local_search(evaluator: TurnEvaluator, x: list[float], most: int) -> list[float]:
    """A local optimum within limits, and downhill from there, over the edges where one takes over.

    It takes at most so many evaluations for each of the two.
    """
    names = list(evaluator.rooms(_complete(evaluator, x)))

    @cache
    def figures(point: tuple[float, ...]) -> dict[str, float]:
        return _complete(evaluator, point)

    def sought(point: list[float]) -> float:
        return figures(tuple(point))[evaluator.sought]

    def rooms(point: list[float]) -> list[float]:
        left = evaluator.rooms(figures(tuple(point)))
        return [left[name] for name in names]

    found = constrained_point(sought, rooms, evaluator.bounds, x, most)
    best = min(x, found, key=evaluator.score)
    lower = downhill_point(evaluator.score, evaluator.bounds, best, most)
    return min(best, lower, key=evaluator.score)


def _complete(evaluator: TurnEvaluator, x: Sequence[float]) -> dict[str, float]:
    """All figures; of a turn that does not exist, hopeless ones."""
    bad = dict.fromkeys(("length", "way", "disc", *evaluator.quantities), HOPELESS)
    bad |= {"radius": 0.0, "clearance": -1.0}
    bad |= {"obstacles": -1.0} if evaluator.obstacles else {}
    return {**bad, **(evaluator.figures(x, complete=True) or {})}


def _exact(
    evaluator: TurnEvaluator, x: Sequence[float], began: float, prudence: float
) -> tuple[BestTurn, bool]:
    """The turn's exact figures, and whether one exceeds a limit; `evaluator` is corrected by them."""
    sampled = _complete(evaluator, x)
    plan = evaluator.plan.model_copy(
        update={"turn": evaluator.plan.turn.model_copy(update=evaluator.table(x))}
    )
    exact, clearance = _exact_figures(plan, sampled, _enough(evaluator, sampled))
    rooms = evaluator.rooms(exact)
    _correct(evaluator, sampled, exact, prudence)
    if evaluator.goal.objective == "disc":
        plan = plan.with_value("disc.radius", exact["disc"])
    speed = greatest_head_speed(plan) if plan.limits.speed is not None else None
    value, unit = exact[evaluator.sought], "m"
    if evaluator.goal.objective == "acceleration":
        value, unit = exact[evaluator.sought] * plan.walk.speed**2, "m/s^2"
    bracket = value, -math.inf, value  # nothing tells how much better another may be
    if evaluator.goal.objective == "speed" and speed is not None:
        bracket, unit = (speed.value, speed.lower, math.inf), "m/s"
    answer = Answer(
        *bracket, unit, "found", None,
        (_("best that was found in this family; better ones may exist"),),
        evaluator.evaluations, clock.perf_counter() - began,
    )  # fmt: skip
    turn, disc = evaluator.turn(x), plan.disc.radius or evaluator.disc
    active = tuple(name for name, room in rooms.items() if room <= ACTIVE)
    best = BestTurn(plan, turn, answer, turn.length, turn.way(disc), speed, clearance, active)
    return best, any(room < -EXCEEDED for room in rooms.values())


def _exact_figures(
    plan: Plan, sampled: dict[str, float], within: float
) -> tuple[dict[str, float], Answer]:
    """Sampled figures made exact, on the safe side, and the least clearance (`within` so many m)."""
    walk, exact = plan.build(), dict(sampled)
    ends = float(walk.route.joints[1]), walk.head_where_tail(float(walk.route.joints[-2]))
    for name in _judged(sampled):
        exact[name] = greatest_of(walk, QUANTITIES[name], *ends, tolerance=1e-6).upper
    times = [walk.time_at(s) for s in ends]
    clearance = least_clearance(walk, *times, within=within, tolerances=(1e-5,))
    rooms = [
        _sure(least_distance(walk, obstacle, *times, tolerances=(1e-5,))) - obstacle.margin
        for obstacle in plan.obstacles()
    ]
    if rooms:
        exact["obstacles"] = min(rooms)
    return {**exact, "clearance": _sure(clearance)}, clearance


def _sure(distance: Answer) -> float:
    """At most a distance, m; where benches touch, as if they were DEEP in one another."""
    return distance.lower if distance.value > 0.0 else -DEEP


def _judged(sampled: dict[str, float]) -> list[str]:
    """Which of the sampled figures can be made exact: speeds and what else is limited or sought."""
    return [name for name in QUANTITIES if sampled.get(name, HOPELESS) < HOPELESS]


def _correct(
    evaluator: TurnEvaluator, sampled: dict[str, float], exact: dict[str, float], prudence: float
) -> None:
    """Tell the judge by how much sampling flatters a turn like this, and somewhat more."""
    for name in _judged(sampled):
        change = exact[name] / sampled[name] * (1.0 + prudence)
        evaluator.factors[name] = evaluator.factors.get(name, 1.0) * change
    for name in ("clearance", "obstacles"):
        if name in exact:
            less = min(exact[name] - sampled[name] - prudence, 0.0)
            evaluator.factors[name] = evaluator.factors.get(name, 0.0) + less


def _enough(evaluator: TurnEvaluator, sampled: dict[str, float]) -> float:
    """How far to look for the least clearance, m: somewhat farther than what sampling saw."""
    return max(1.2 * sampled["clearance"], evaluator.plan.limits.margin, 0.05)


def pareto_front(
    plan: Plan, speeds: Sequence[float], goal: TurnGoal | None = None, *, progress: Progress = silent
) -> list[BestTurn]:
    """Shortest turns for head speeds (m/s, increasing) that they must allow under limits.speed.

    The turn of each speed is sought from several starts: searches all over the family at ANCHORS of
    the speeds, the turn of the speed below and that of the speed above. Of what is found each speed has
    the shortest that allows it (`undominated`); shorter ones may exist. The list ends where none is
    found. `goal` says what is to be short (a length, or the disc), and the other limits.

    Raises:
        InputError: without limits.speed, or if not even the first speed is possible.
    """
    if plan.limits.speed is None:
        raise InputError(_("the plan has no limit of speed: set limits.speed=2, for example"))
    wished = goal or TurnGoal()
    judges = [
        TurnEvaluator(plan.with_value("walk.speed", positive("speed", speed, "m/s")), wished)
        for speed in speeds
    ]
    texts = [_("turns for {speed} m/s").format(speed=f"{speed:.3f}") for speed in speeds]
    with budget.question(len(speeds)):
        sketched = _sketched(judges, part(progress, 0.0, SKETCHED), texts)
        if not sketched:
            raise NoSolutionError(_("no turn of this family was found that keeps the limits"))
        settled = _settled_front(judges, sketched, part(progress, SKETCHED, 1.0), texts)
    return undominated(settled[::-1])


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


def _sketched(
    judges: Sequence[TurnEvaluator], progress: Progress, texts: Sequence[str]
) -> list[list[float]]:
    """The best turn of each judge by coarse sampling, from slow to fast and back again."""
    last = len(judges) - 1
    anchors = {round(share * last) for share in ANCHORS}
    best: list[list[float]] = []
    for n, judge in enumerate(judges):
        progress(0.7 * n / len(judges), texts[n])
        starts = best[-1:]
        if n in anchors:
            starts = starts + _found_all_over(judge)
        ends = [_local_search(judge, start, SKETCH) for start in starts]
        x = min(ends, key=judge.score, default=None)
        if x is None or judge.score(x) >= WORSE:
            break
        best.append(x)
    for n in range(len(best) - 2, -1, -1):
        progress(1.0 - 0.3 * n / len(judges), texts[n])
        above = _local_search(judges[n], best[n + 1], SKETCH)
        best[n] = min(best[n], above, key=judges[n].score)
    return best


def _settled_front(
    judges: Sequence[TurnEvaluator],
    sketched: Sequence[list[float]],
    progress: Progress,
    texts: Sequence[str],
) -> list[BestTurn]:
    """The exact turns of the front, the fastest first."""
    found: list[BestTurn] = []
    for n in range(len(sketched) - 1, -1, -1):
        judge = judges[n]
        progress(1.0 - (n + 1) / len(sketched), texts[n])
        judge.step = STEPS[1]
        # What sampling hides is told beforehand, so that one local search will mostly do.
        _exact(judge, sketched[n], clock.perf_counter(), PRUDENCE)
        if found:
            best = _better(judge, sketched[n], found[-1])
        else:
            best = _first_settled(judge, sketched[n]) or _first_settled(judge, *_found_all_over(judge))
        if best is not None:
            found.append(best)
    return found


def _found_all_over(judge: TurnEvaluator) -> list[list[float]]:
    with contextlib.suppress(NoSolutionError):
        return _global_search(judge, silent)
    return []


def _better(judge: TurnEvaluator, sketched: list[float], faster: BestTurn) -> BestTurn | None:
    """The turn settled from a sketch; from a faster turn if that is better than what comes out."""
    best = _first_settled(judge, sketched)
    if best is None or best.objective.value > faster.objective.value:
        best = _first_settled(judge, _unknowns(faster, judge.goal)) or best
    return best


def _first_settled(judge: TurnEvaluator, *starts: list[float]) -> BestTurn | None:
    """The turn settled from the first start that comes to one."""
    for start in starts:
        with contextlib.suppress(NoSolutionError):
            return _settled(judge, start, silent, clock.perf_counter())
    return None


def _unknowns(best: BestTurn, goal: TurnGoal) -> list[float]:
    """The unknowns of a turn: inverse of `TurnEvaluator.table`."""
    table = best.plan.turn
    if table.entry_radius is None or table.exit_radius is None:
        raise AssertionError("a best turn says its joints")
    x = [table.entry_radius, table.exit_radius]
    if table.family == "arc-arc":
        x.append(math.log(table.ratio))
    elif table.radii is not None:
        middle = [table.curvature] if table.family == "arc-arc-arc" else []
        x += [table.radii[0], *middle, table.radii[1]]
    return [*x, table.ease] if goal.objective == "acceleration" else x
