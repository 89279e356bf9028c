"""Random dances against brute force: evaluations each 5 mm of the head; lines that stray."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from benchdragon import budget
from benchdragon.budget import OverBudgetError
from benchdragon.errors import InputError
from benchdragon.kernels.box import nearest_pair
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.perturbed import place_along
from benchdragon.kernels.step_bounds import curvature_range
from benchdragon.model.curves import Arc, Clothoid, Line, Route, Spiral
from benchdragon.model.dragon import Dragon
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve import random_dance as module
from benchdragon.solve.random_dance import TOLERANCE, CannotFollowError, RandomDance, strayed
from benchdragon.solve.tolerance import (
    CASES,
    Deviations,
    Draw,
    least_clearance,
    needed_pitch,
    random_dance,
    touches,
)

ROUTES = {
    "spiral": Route((Spiral.between(0.9, 14.0, 6.0),)),
    "turn": Route.joined([Line(16.0), Arc(1.8, 2.8), Arc(0.9, -2.8), Line(6.0)]),
    "clothoids": Route.joined([Line(16.0), Clothoid(2.5, 0.0, 0.8), Arc(1.25, 2.0), Line(6.0)]),
}
PLANS = {
    "spiral": ("spiral-in", ["disc.radius=4.5", "route.pitch=0.47", "dragon.benches=40",
                             "walk.start=215"]),
    "short": ("spiral-in", ["disc.radius=2.5", "route.pitch=0.5", "dragon.head_length=2",
                            "dragon.body_length=1.1", "dragon.benches=30", "walk.start=220"]),
    "turn": ("turn", ["route.pitch=1.18", "dragon.benches=30", "walk.start=5", "walk.end=35"]),
    "line": ("turn", ["route.pitch=1.3", "dragon.benches=25", "turn.family=arc-line-arc",
                      "walk.start=0", "walk.end=30"]),
    "tight": ("turn", ["route.pitch=1.0", "dragon.benches=30", "dragon.body_length=1.4",
                       "dragon.head_length=2.2", "disc.radius=3", "walk.start=0", "walk.end=25"]),
}  # fmt: skip


def brute(dance: RandomDance, step: float = 5e-3) -> float:
    """The least distance at places of the head so far apart, each chain followed on from the last."""
    least = np.inf
    grid = np.linspace(dance.start, dance.end, 2 + int((dance.end - dance.start) / step))
    for at in np.array_split(grid, 1 + len(grid) // 500):
        places = empty_placements(len(dance.dragon) + 1, len(at))
        assert place_along(dance.rows, dance.dragon.links, dance.aside, at, places) == len(at)
        least = min(least, nearest_pair(dance.dragon.sizes, places.x, places.y)[0])
    return float(least)


@pytest.mark.parametrize("name", PLANS)
@pytest.mark.parametrize("case", ["aside", "stray", "all"])
def test_no_evaluation_comes_nearer_than_is_told(name: str, case: str) -> None:
    plan = read_plan(*PLANS[name])
    draw = Draw(CASES[case].deviations, 7, len(case))
    # Benches so much narrower that they overlap by 2 mm, or keep 1 mm.
    for room in (-2e-3, 1e-3):
        width = plan.value("dragon.width") + brute(random_dance(plan, draw), 0.05) - room
        dance = random_dance(plan.with_value("dragon.width", width), draw)
        least = brute(dance)
        told = dance.least()
        assert dance.touch(max(least, 0.0) + 1e-6) is not None
        if told > 0.0:
            assert told - TOLERANCE <= least
            assert dance.touch(told - TOLERANCE) is None
        else:
            assert dance.touch() is not None


def turned(line: FloatArray, at: FloatArray) -> FloatArray:
    """Points of a line given as rows, at positions along it."""
    places = empty_placements(1, len(at))
    assert place_along(line, np.empty(0), np.zeros(1), at, places) == len(at)
    return np.asarray(places.x[0] + 1j * places.y[0])


@pytest.mark.parametrize("name", ROUTES)
def test_a_line_that_does_not_stray_is_the_route(name: str) -> None:
    route = ROUTES[name]
    rows, drawn, along = strayed(route, lambda s: (0.0 * s, 0.0 * s), 1.0, route.length)
    assert drawn[[0, -1]] == pytest.approx([1.0, route.length])
    s = np.linspace(1.0, route.length, 3001)
    points = turned(rows, np.interp(s, drawn, along))
    exact = route.point(s) @ [1.0, 1j]
    # Along the line the positions are those of arcs of one length between nodes.
    beside = np.array([np.abs(points[max(n - 40, 0) : n + 41] - exact[n]).min() for n in range(3001)])
    assert np.abs(points - exact).max() < 2e-3
    tangent = np.gradient(exact)
    across = ((points - exact) * (tangent / np.abs(tangent)).conj()).imag
    assert np.abs(across).max() < 2e-5
    assert beside.max() < 5e-3


@pytest.mark.parametrize("name", ROUTES)
def test_a_line_that_strays_is_smooth_and_as_far_aside_as_it_should(name: str) -> None:
    route = ROUTES[name]

    def off(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        return 0.03 * np.sin(s / 5.0), 0.006 * np.cos(s / 5.0)

    rows, drawn, _along = strayed(route, off, 2.0, route.length - 1.0)
    nodes = turned(rows, np.append(rows[1::2, 2], rows[-1, 2] + rows[-1, 3]))
    x, y, heading = (
        route.point(drawn) @ [1.0, 0.0],
        route.point(drawn) @ [0.0, 1.0],
        route.heading(drawn),
    )
    meant = x + 1j * y + 1j * np.exp(1j * heading) * off(drawn)[0]
    assert np.abs(nodes - meant).max() < 1e-10
    for j in range(1, len(rows) - 1):
        low, high = curvature_range(rows, j, 0.0, j + 1, 0.0)
        assert high - low < 3.0  # infinite at a kink or a gap
    assert all(a < b for a, b in pairwise(drawn))


def test_a_bench_that_cannot_follow_is_told_with_the_place() -> None:
    route = Route.joined([Line(10.0), Arc(0.6, 3.0), Line(5.0)])
    dragon = Dragon.uniform(4, 0.9, 0.9, 0.9, 0.1, 0.1, 0.1)
    dance = RandomDance(dragon, route.rows, np.full(5, 0.59), 8.0, 12.0)
    for ask in (dance.low_meeting, dance.touch, dance.least):
        with pytest.raises(CannotFollowError, match=r"head at (9\.\d+|10(\.\d+)?) m or after"):
            ask()


def test_a_dance_too_long_to_be_searched_is_refused() -> None:
    with pytest.raises(InputError, match="too long"):
        RandomDance(Dragon.uniform(20_000), ROUTES["spiral"].rows, np.empty(0), 0.0, 200.0)


def test_more_pairs_than_there_was_room_for_are_searched_all_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from benchdragon.solve import random_dance as module

    dance = random_dance(read_plan(*PLANS["spiral"]), Draw(Deviations(aside=0.01), 1, 0))
    found = dance.touch(0.3)
    monkeypatch.setattr(module, "PARTNERS", 1)
    assert dance.touch(0.3) == found


def test_evaluations_of_a_hint_lie_no_farther_apart_than_is_said() -> None:
    plan: Plan = read_plan(*PLANS["turn"])
    dance = random_dance(plan, Draw(Deviations(), 1, 0))
    low = dance.low_meeting()
    assert low.distance == pytest.approx(brute(dance), abs=2e-4)
    again = dance.meeting_near(dance.hint(low))
    assert again.distance == pytest.approx(low.distance, abs=1e-6)
    assert (again.i, again.j) == (low.i, low.j)


def test_a_line_that_strays_goes_no_farther_than_its_route() -> None:
    route = ROUTES["turn"]
    draw = Draw(Deviations(stray=0.02), 1, 0)
    offset = draw.offset(-10.0, route.length + 1.0)
    strayed(route, offset, -10.0, route.length)
    with pytest.raises(CannotFollowError, match=f"^with the head at {route.length:.4g} m or after"):
        strayed(route, offset, -10.0, route.length + 1.0)


MOST = budget.WORK


@pytest.mark.parametrize(
    "question", [least_clearance, touches, lambda plan, draw: needed_pitch(plan, draw, 0.5)]
)
def test_a_dance_is_counted_and_refused_where_it_takes_too_much(
    question: Callable[[Plan, Draw], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = read_plan(*PLANS["spiral"])
    draw = Draw(CASES["all"].deviations, 1, 0)
    with budget.question():
        question(plan, draw)
        spent = MOST - budget.left()
    monkeypatch.setenv(budget.VARIABLE, str(0.9 * spent / MOST))
    with pytest.raises(OverBudgetError):
        question(plan, draw)


def test_a_search_in_many_calls_finds_what_one_call_finds(monkeypatch: pytest.MonkeyPatch) -> None:
    plan = read_plan(*PLANS["turn"])
    dance = random_dance(plan, Draw(CASES["all"].deviations, 1, 0))
    least = dance.least()
    found = [(dance.least(), dance.touch(least - 1e-3), dance.touch(least + 1e-3))]
    monkeypatch.setattr(module, "STEPS", 7)
    found.append((dance.least(), dance.touch(least - 1e-3), dance.touch(least + 1e-3)))
    assert found[0] == found[1]
    assert found[0][1] is None
    assert found[0][2] is not None


@pytest.mark.parametrize(
    ("deviations", "told"),
    [(Deviations(stray=0.02), OverBudgetError), (Deviations(aside=0.02), InputError)],
)
def test_a_walk_of_many_kilometres_is_refused_before_room_is_made_for_it(
    deviations: Deviations, told: type[Exception], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "evaluate", lambda *_arguments: pytest.fail("it began"))
    plan = read_plan("turn", ["walk.end=1e8", "walk.start=-1e7", "dragon.benches=3"])
    with budget.question(), pytest.raises(told):
        random_dance(plan, Draw(deviations, 1, 0))
