"""Benches and the square: when one first touches an obstacle, and the least distance kept to each.

How a walk is searched for either is in analysis/obstacle_search.py.
"""

import math
import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchdragon import budget
from benchdragon.analysis.contact import refined, upper_end
from benchdragon.analysis.contact_search import TOLERANCES, assumed_within
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.kernels import search as steps
from benchdragon.kernels import standing as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk

# The head positions between which a bench (row, from 0) comes to touch, m, and the bench.
Come = tuple[float, float, int]


def touching(search: ObstacleSearch) -> list[Answer]:
    """When a bench first comes nearer to the obstacle than it may: empty if none does.

    The last is sure; those before it are grazes that rounding leaves open, "undecided". All is clear
    up to the lower end of the first.
    """
    apart, bench, _box = search.at_start
    head = float(search.heads[0])
    if apart <= search.reach - search.off_at_start:
        search.note_off(search.off_at_start)
        return [search.answer(head, head, "found", bench)]
    if apart <= search.reach + search.off_at_start and search.heads[0] == search.heads[1]:
        return [search.answer(head, head, "undecided", bench)]
    grazes, sure = list[Come](), list[Come]()
    for touch in search.touches():
        soonest = min((come[1] for come in sure), default=math.inf)
        if soonest < math.inf:
            there = float(search.walk.placement(soonest, throw=False).s[0, touch.bench])
            if touch.lower > there + max(search.off, search.slack):
                continue
        come = (*search.head_at(touch.bench, touch.lower, touch.upper), touch.bench)
        (sure if touch.sure else grazes).append(come)
    clear = min((come[0] for come in sure), default=math.inf)
    before = sorted(come for come in grazes if come[0] < clear)
    answers = [search.answer(lower, upper, "undecided", bench) for lower, upper, bench in before]
    if sure:
        _lower, upper, bench = min(sure, key=lambda come: come[1])
        answers.append(search.answer(clear, upper, "found", bench))
    return answers


@budget.question()
def first_touch(
    walk: Walk,
    obstacle: Obstacle,
    start: float,
    end: float,
) -> Answer | None:
    """The first time in start..end, s, at which a bench touches an obstacle; None if none ever does.

    Or is nearer to it than the obstacle's margin, or leaves the venue. The answer's bracket: all is
    clear up to `lower`, and at `upper` a bench surely touches; "undecided" where one comes within
    rounding of touching.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at the start, or walk on to the end.
        UnsureError: if it could not be shown that it can.
    """
    answers = touching(ObstacleSearch(walk, obstacle, start, end))
    return answers[0] if answers else None


@budget.question()
def least_distance(
    walk: Walk,
    obstacle: Obstacle,
    start: float,
    end: float,
    *,
    tolerances: Sequence[float] = TOLERANCES,
) -> Answer:
    """The least distance, m, that benches keep from an obstacle from start to end, s; 0 if they touch.

    Of the venue it is the distance from its edge. The bracket is as wide as the first of `tolerances`,
    m, or where a bench keeps one distance for a while as one of the others, or wider yet where that
    takes too much work.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at the start, or walk on to the end.
        UnsureError: if it could not be shown that it can.
    """
    search = ObstacleSearch(walk, obstacle, start, end)
    apart, bench, _box = search.at_start
    best = Nearest(apart, -1, bench)
    stretches = [] if apart <= obstacle.radius else list(search.stretches())
    for k, _benches, spans in stretches:
        note = np.zeros(steps.NOTES)
        note[steps.NEAREST] = best.distance
        search.look(k, spans, note)
        if note[steps.NEAREST] < best.distance:
            best = Nearest(float(note[steps.NEAREST]), k, float(note[steps.UPPER]))
    for n, tolerance in enumerate(tolerances):
        with refined(n):
            best, floor, closed = _lowered(search, stretches, best, tolerance)
            if closed or best.distance <= obstacle.radius:
                return _distance_answer(search, best, floor)
    best, floor, _closed = _lowered(search, stretches, best, math.inf)
    return _distance_answer(search, best, floor)


@dataclass(frozen=True)
class ObstacleAnswers:
    """What was found about an obstacle, or the venue's edge, over a span of a walk.

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
        """The least distance, m, as all texts tell it."""
        return self.distance.shown(up=False, limit=self.obstacle.margin)


@budget.question()
def obstacle_answers(
    walk: Walk,
    obstacle: Obstacle,
    start: float,
    end: float,
    *,
    tolerances: Sequence[float] = TOLERANCES,
) -> ObstacleAnswers:
    """The least distance that benches keep from an obstacle, and when one comes nearer than it may.

    A contact that is sure is told before one that is not: see `first_touch` and `least_distance`.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at the start, or walk on to the end.
        UnsureError: if it could not be shown that it can.
    """
    distance = least_distance(walk, obstacle, start, end, tolerances=tolerances)
    if distance.lower > obstacle.margin:
        return ObstacleAnswers(obstacle, None, distance)
    answers = touching(ObstacleSearch(walk, obstacle, start, end))
    contact = answers[-1] if answers else None
    near = None if contact is None else contact.witness
    if distance.value > 0.0 or near is None or near.gap <= 0.0:
        return ObstacleAnswers(obstacle, contact, distance)
    bare = touching(ObstacleSearch(walk, replace(obstacle, margin=0.0), start, end))
    return ObstacleAnswers(obstacle, contact, distance, bare[-1] if bare else None)


@dataclass(frozen=True)
class Nearest:
    """The least distance seen from the obstacle's boxes, m: by a bench of size k with its handle at s.

    Or, where k is -1, by bench number s as the dragon stands at the start.
    """

    distance: float
    k: int
    s: float


def _lowered(
    search: ObstacleSearch,
    stretches: Sequence[tuple[int, IntArray, FloatArray]],
    best: Nearest,
    tolerance: float,
) -> tuple[Nearest, float, bool]:
    """`best`, or what is lower; what nothing is nearer than, m; and whether that was established."""
    floor, closed = math.inf, True
    for k, _benches, spans in stretches:
        note = np.zeros(steps.NOTES)
        note[steps.NEAREST], note[steps.FLOOR], note[steps.PAIR] = best.distance, math.inf, -1.0
        told = search.run(k, steps.LEAST, spans, tolerance, note)
        closed = closed and not (told[:, kernel.ENDING] != steps.CLEAR).any()
        if note[steps.NEAREST] < best.distance:
            best = Nearest(float(note[steps.NEAREST]), k, float(note[steps.UPPER]))
        floor = min(floor, float(note[steps.FLOOR]))
    return best, min(floor, best.distance - tolerance), closed


def _distance_answer(search: ObstacleSearch, best: Nearest, floor: float) -> Answer:
    search.note_off(search.off_at_start)
    radius, off = search.obstacle.radius, search.off
    bench, head = int(best.s), float(search.heads[0])
    if best.k >= 0:
        bench = search.bench_at(best.k, best.s)
        head = search.head_at(bench, best.s, best.s)[1]
    gap = best.distance - radius
    lower = max(min(floor, best.distance) - radius - off, 0.0)
    seconds = clock.perf_counter() - search.began
    return Answer(
        max(gap, 0.0), lower, upper_end(gap, off), "m", "found", search.witness(head, bench),
        assumed_within(off), search.evaluations, seconds,
    )  # fmt: skip
