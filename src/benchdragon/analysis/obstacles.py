"""Benches and the square: when one first touches an obstacle, and the least distance kept to each.

The search for both is in analysis/obstacle_search.py.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.contact_search import TOLERANCES
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan


def touching(walk: Walk, obstacle: Obstacle, start: float, end: float) -> list[Answer]:
    """When a bench first touches, and grazes before: see `ObstacleSearch.touches`."""
    with ObstacleSearch(walk, obstacle, start, end) as search:
        return search.touches()


@budget.question()
def first_touch(
    walk: Walk | Plan, obstacle: Obstacle, start: float | None = None, end: float | None = None
) -> Answer | None:
    """The first time in start..end, s, at which a bench touches an obstacle; None if none ever does.

    Of a plan or a walk: over the whole of it unless start and end are given. Or is nearer to it than
    the obstacle's margin, or leaves the venue. The answer's bracket: all is clear up to `lower`, and at
    `upper` a bench surely touches; "undecided" where one comes within rounding of touching.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at the start, or walk on to the end.
        UnsureError: if it could not be shown that it can.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 5, "walk.end": 60.0})
        >>> touch = bd.first_touch(plan, bd.Obstacle.circle("well", (0.0, -8.5), 0.2))
        >>> touch.witness.obstacle, touch.witness.benches
        ('well', (1,))
    """
    walk, start, end = asked_of(walk, start, end)
    answers = touching(walk, obstacle, start, end)
    return answers[0] if answers else None


@budget.question()
def least_distance(
    walk: Walk | Plan, obstacle: Obstacle, start: float | None = None, end: float | None = None, *,
    tolerances: Sequence[float] = TOLERANCES,
) -> Answer:  # fmt: skip
    """The least distance, m, that benches keep from an obstacle from start to end, s; 0 if they touch.

    Of a plan or a walk: over the whole of it unless start and end are given. Of the venue it is the
    distance from its edge. The bracket is as wide as the first of `tolerances`, m, or where a bench
    keeps one distance for a while as one of the others, or wider yet where that takes too much work.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at the start, or walk on to the end.
        UnsureError: if it could not be shown that it can.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 5, "walk.end": 60.0})
        >>> round(bd.least_distance(plan, bd.Obstacle.circle("post", (0.0, 0.0), 0.2)).value, 4)
        7.7206
    """
    walk, start, end = asked_of(walk, start, end)
    with ObstacleSearch(walk, obstacle, start, end) as search:
        return search.least_distance(tolerances)


@dataclass(frozen=True)
class ObstacleAnswers:
    """The answers about an obstacle, or the venue's edge, over a span of a walk.

    Attributes:
        obstacle: which.
        contact: when a bench first touches it, leaves the venue, or comes nearer than the margin; None
            if none does.
        distance: the least that benches keep from it, m; 0 where one touches it.
        touch: when a bench first touches it or leaves the venue, where `contact` speaks of the margin.
    """

    obstacle: Obstacle
    contact: Answer | None
    distance: Answer
    touch: Answer | None = None

    @property
    def distance_text(self) -> str:
        """The least distance, m, formatted as in all texts."""
        return self.distance.shown(up=False, limit=self.obstacle.margin)


@budget.question()
def obstacle_answers(
    walk: Walk, obstacle: Obstacle, start: float, end: float, *,
    tolerances: Sequence[float] = TOLERANCES,
) -> ObstacleAnswers:  # fmt: skip
    """The least distance that benches keep from an obstacle, and when one comes nearer than it may.

    A sure contact is preferred to an undecided one: see `first_touch` and `least_distance`.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at the start, or walk on to the end.
        UnsureError: if it could not be shown that it can.
    """
    distance = least_distance(walk, obstacle, start, end, tolerances=tolerances)
    if distance.lower > obstacle.margin:
        return ObstacleAnswers(obstacle, None, distance)
    answers = touching(walk, obstacle, start, end)
    contact = answers[-1] if answers else None
    near = None if contact is None else contact.witness
    if distance.value > 0.0 or near is None or near.gap <= 0.0:
        return ObstacleAnswers(obstacle, contact, distance)
    bare = touching(walk, replace(obstacle, margin=0.0), start, end)
    return ObstacleAnswers(obstacle, contact, distance, bare[-1] if bare else None)
