"""Contact over time: the contest's first contact to its digits, and stories of how benches meet."""

import itertools
import json
import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchdragon import (
    Arc,
    Bench,
    Dragon,
    InputError,
    Line,
    Route,
    SpeedProfile,
    Spiral,
    Walk,
    WalkError,
    clearance_curve,
    clearances,
    contact_windows,
    first_contact,
    least_clearance,
)
from benchdragon.analysis.contact_search import TOLERANCES
from benchdragon.analysis.distance import tightest_pairs
from benchdragon.analysis.head_times import HeadTimes
from benchdragon.kernels import contact_least, contact_steps, memory
from benchdragon.kernels.box import least_distance
from benchdragon.kernels.contact_memory import BASE, Hunt
from benchdragon.kernels.time_of_impact import Ending, Note
from benchdragon.plans.schema import read_plan
from tests.rounding import closing_rate, pair_off
from tests.solve.asked_in_python import in_python

TRUTH = json.loads((Path(__file__).parents[1] / "truth" / "contest.json").read_text("utf-8"))
FIRST_CONTACT = 412.4738376821147


@pytest.fixture(scope="module")
def contest() -> Walk:
    return read_plan("spiral-in").build()


def test_the_contests_first_contact_is_the_true_one(contest: Walk) -> None:
    found = first_contact(contest, 0.0, 430.0)
    assert found is not None
    assert found.value == pytest.approx(FIRST_CONTACT, abs=1e-11)
    assert found.lower < FIRST_CONTACT < found.upper
    assert found.upper - found.lower < 2e-11
    assert found.status == "found"
    assert found.witness is not None
    assert found.witness.benches == (1, 9)
    assert found.witness.features == ((1, "front left"), (9, "right"))
    assert found.evaluations < 2000


def test_a_slack_below_rounding_gives_way_to_the_bound_on_that(
    contest: Walk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("benchdragon.analysis.contact_search.SLACK", 1e-14)
    found = first_contact(contest, 400.0, 430.0)
    assert found is not None
    assert found.witness is not None
    # The gap closes at 2.6 cm a second; the bound holds on either side of where it is found.
    doubt = pair_off(contest, found.witness, 1e-14) / closing_rate(contest, found.witness)
    assert found.lower < FIRST_CONTACT < found.upper
    units = 8.0 * math.ulp(FIRST_CONTACT)  # times are rounded outward
    assert 2e-12 < 2.0 * doubt <= found.upper - found.lower <= min(3.0 * doubt + units, 7e-12)
    assert found.value == pytest.approx(FIRST_CONTACT, abs=2e-12)


def test_places_and_speeds_at_first_contact_are_the_true_ones(contest: Walk) -> None:
    found = first_contact(contest, 400.0, 430.0)
    assert found is not None
    motion = contest.motion([found.value])
    for handle, numbers in TRUTH["at_first_contact"].items():
        x, y, speed = (float(number) for number in numbers)
        assert motion.x[0, int(handle)] == pytest.approx(x, abs=1e-10)
        assert motion.y[0, int(handle)] == pytest.approx(y, abs=1e-10)
        assert motion.speed[0, int(handle)] == pytest.approx(speed, abs=1e-10)


def test_near_misses_before_it_are_not_taken_for_contact(contest: Walk) -> None:
    for start, end, gap in ((405.0, 408.0, 2.96e-3), (408.5, 411.0, 0.865e-3)):
        assert first_contact(contest, start, end) is None
        assert least_clearance(contest, start, end).value == pytest.approx(gap, abs=5e-6)


def test_a_long_dragon_touches_where_a_short_one_does() -> None:
    route = Route((Spiral(0.55, 32.0 * math.pi, 0.0),))
    long = Walk(Dragon.uniform(3000), route)
    found = first_contact(long, 0.0, 430.0)
    assert found is not None
    assert found.value == pytest.approx(FIRST_CONTACT, abs=1e-11)


def _hairpin(gap: float) -> Route:
    return Route.joined([Line(30.0), Arc(0.5 * gap, math.pi), Line(30.0)])


def test_a_pair_that_touches_for_an_instant_only() -> None:
    """The head's rear outer corner grazes bench 20: a hair more pitch, and it never does."""
    pitch = 0.4503373930271955
    spans = {}
    for more in (-1e-8, 1e-8):
        plan = read_plan("spiral-in", ["disc.radius=4.5", f"route.pitch={pitch + more!r}"])
        walk = plan.build()
        spans[more] = contact_windows(walk, 200.0, walk.route.length)
    (window,) = spans[-1e-8]
    assert spans[1e-8] == []
    assert window.opens.status == "found"
    assert window.closes is not None
    assert 0.005 < window.closes.value - window.opens.value < 0.008
    assert window.closes.evaluations < 20_000
    assert window.opens.witness is not None
    assert window.opens.witness.benches == (1, 20)


def test_a_graze_within_rounding_says_so() -> None:
    walk = read_plan("spiral-in", ["disc.radius=4.5", "route.pitch=0.4503373930271955"]).build()
    found = first_contact(walk, 200.0, walk.route.length)
    assert found is not None
    assert found.status == "undecided"
    assert found.value == pytest.approx(216.33821, abs=1e-4)
    assert found.upper - found.lower < 1e-4


def test_a_wide_tail_touches_where_the_head_passed_freely() -> None:
    benches = [Bench(1.2, 0.3, 0.1, 0.1)] * 11 + [Bench(1.2, 4.2, 0.1, 0.1)]
    walk = Walk(Dragon(benches), _hairpin(2.2), start=20.0)
    found = first_contact(walk, 0.0, 35.0)
    assert found is not None
    assert found.witness is not None
    assert 12 in found.witness.benches
    thin = Walk(Dragon([Bench(1.2, 0.3, 0.1, 0.1)] * 12), _hairpin(2.2), start=20.0)
    assert first_contact(thin, 0.0, 35.0) is None


def test_two_windows_open_and_close() -> None:
    """Two wide benches pass narrow ones on the way back from a hairpin, one after the other."""
    sizes = [Bench(1.2, 0.2, 0.1, 0.1)] * 24
    for wide in (2, 9):
        sizes[wide] = Bench(1.2, 2.0, 0.1, 0.1)
    walk = Walk(Dragon(sizes[:3] + sizes[9:10] + sizes[:1] * 4), _hairpin(1.6), start=22.0)
    windows = contact_windows(walk, 0.0, 30.0)
    assert windows
    times = np.linspace(0.0, 30.0, 3001)
    low = clearances(walk.motion(times)) < 0.0
    for window in windows:
        assert window.closes is not None
        inside = (times > window.opens.upper) & (times < window.closes.lower)
        assert low[inside].all()
        low = low & ~((times >= window.opens.lower) & (times <= window.closes.upper))
    assert not low.any()
    assert all(a.closes.value < b.opens.value for a, b in itertools.pairwise(windows) if a.closes)


def test_windows_in_the_contests_walk_open_and_close(contest: Walk) -> None:
    windows = contact_windows(contest, 405.0, 416.0)
    times = np.linspace(405.0, 416.0, 1101)
    touching = clearances(contest.motion(times)) <= 0.0
    inside = np.zeros(len(times), dtype=bool)
    for window in windows:
        closes = 416.0 if window.closes is None else window.closes.value
        inside |= (times >= window.opens.value) & (times <= closes)
    assert (inside == touching).all()
    assert len(windows) >= 2


def test_a_dragon_that_starts_in_contact_says_so_at_once(contest: Walk) -> None:
    found = first_contact(contest, 413.0, 414.0)
    assert found is not None
    assert found.lower == found.value == found.upper == 413.0


def test_a_walk_that_ends_in_contact_leaves_its_window_open(contest: Walk) -> None:
    (window,) = contact_windows(contest, 410.0, 413.0)
    assert window.closes is None


@pytest.mark.parametrize("turn", [0.3, 0.9, -0.6])
def test_contact_is_found_across_kinks(turn: float) -> None:
    """Where the heading jumps speeds jump too, and only the travel bound is left."""
    curves = [Line(30.0), Line(3.0).moved((30.0, 0.0), turn)]
    end, heading = curves[-1].end_pose
    curves.append(Line(20.0).moved(end, heading + turn))
    route = Route(tuple(curves), kinks=True)
    walk = Walk(Dragon.of_sizes(np.full(8, 1.0), 1.25, 0.1, 0.1), route, start=25.0)
    found = first_contact(walk, 0.0, 14.0)
    low = clearances(walk.motion(np.linspace(0.0, 14.0, 1401)))
    assert (found is None) == bool((low > 0.0).all())
    if found is not None:
        before = np.linspace(0.0, found.lower, 500)
        assert (clearances(walk.motion(before)) >= 0.0).all()


def test_time_may_be_negative_and_the_head_may_stop() -> None:
    walk = read_plan("spiral-in").build()
    stops = SpeedProfile((0.0, 100.0, 110.0, 150.0, 160.0), (1.0, 1.0, 0.0, 0.0, 2.0))
    late = Walk(walk.dragon, walk.route, stops, 400.0 - float(stops.distance(150.0)))
    found = first_contact(late, -50.0, 300.0)
    assert found is not None
    s = late.head_position([found.value])[0]
    assert s == pytest.approx(FIRST_CONTACT, abs=1e-10)
    early = Walk(walk.dragon, walk.route, SpeedProfile.constant(1.0), 500.0)
    earlier = first_contact(early, -200.0, -70.0)
    assert earlier is not None
    assert earlier.value == pytest.approx(FIRST_CONTACT - 500.0, abs=1e-11)


def test_a_head_that_never_moves_never_touches(contest: Walk) -> None:
    still = Walk(contest.dragon, contest.route, SpeedProfile.constant(0.0), 412.0)
    assert first_contact(still, 0.0, 100.0) is None


@pytest.mark.parametrize("benches", [1, 2])
def test_a_dragon_without_pairs_never_touches(benches: int) -> None:
    walk = Walk(Dragon.uniform(benches), Route((Spiral(0.55, 100.0, 30.0),)))
    assert first_contact(walk, 0.0, 100.0) is None
    assert least_clearance(walk, 0.0, 100.0).value == math.inf


def test_a_contact_before_the_walk_falls_is_still_found(contest: Walk) -> None:
    assert first_contact(contest, 0.0, 442.0) is not None
    short = Walk(Dragon.uniform(2), contest.route)
    with pytest.raises(WalkError):
        first_contact(short, 0.0, 442.5)


def test_a_walk_past_the_routes_end_is_refused() -> None:
    walk = Walk(Dragon.uniform(10), _hairpin(8.0), start=20.0)
    with pytest.raises(WalkError):
        first_contact(walk, 0.0, 100.0)


def test_the_clearance_curves_minima_are_exact(contest: Walk) -> None:
    from scipy.optimize import minimize_scalar

    times = np.linspace(395.0, 411.5, 100)
    curve = clearance_curve(contest, times)
    assert len(curve.minima) >= 4
    for low in curve.minima:
        assert low.witness is not None
        assert low.witness.time is not None
        t = low.witness.time

        def clearance(at: float) -> float:
            return float(clearances(contest.motion([at]))[0])

        best = minimize_scalar(clearance, bounds=(t - 0.05, t + 0.05), options={"xatol": 1e-10})
        assert low.value == pytest.approx(best.fun, abs=1e-9)
        assert low.lower <= low.value <= low.upper
    assert curve.clearance.shape == (100,)
    assert curve.benches.shape == (100, 2)


def test_least_clearance_does_not_depend_on_speed_or_place(contest: Walk) -> None:
    plain = least_clearance(contest, 395.0, 405.0).value
    quick = Walk(contest.dragon, contest.route, SpeedProfile.constant(2.0), 395.0)
    assert least_clearance(quick, 0.0, 5.0).value == pytest.approx(plain, abs=1e-12)
    (spiral,) = contest.route.curves
    moved = Route((spiral.moved((3.0, -7.0), 1.0),))
    assert least_clearance(Walk(contest.dragon, moved), 395.0, 405.0).value == pytest.approx(
        plain, abs=1e-11
    )


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda walk: first_contact(walk, 0.0, 10.0, margin=-0.1), "margin must not be negative"),
        (lambda walk: first_contact(walk, 10.0, 0.0), "must not come before"),
        (lambda walk: first_contact(walk, math.nan, 0.0), "start must be finite"),
        (lambda walk: first_contact(walk, 0.0, math.inf), "end must be finite"),
        (lambda walk: clearance_curve(walk, [0.0, 1.0]), "3 to"),
        (lambda walk: clearance_curve(walk, [0.0, 2.0, 1.0]), "increase"),
    ],
)
def test_wrong_questions_are_refused_in_a_sentence(contest: Walk, call: object, text: str) -> None:
    assert callable(call)
    with pytest.raises(InputError, match=text):
        call(contest)


@pytest.mark.parametrize("room", [1e-6, 0.3, 1.2])
def test_a_tail_at_the_very_start_of_a_route_that_does_not_run_on_is_no_hindrance(room: float) -> None:
    """The cell in which its front handle stands reaches back to where no bench could stand."""
    route = Route.joined([Arc(5.0, 4.0), Line(40.0)])
    dragon = Dragon.uniform(10)
    back = Walk(dragon, route).head_where_tail(room)
    assert first_contact(Walk(dragon, route, start=back), 0.0, 15.0) is None


def test_a_bench_that_can_meet_no_other_must_follow_too() -> None:
    # The middle one of three has no pair; between two narrow bends it cannot follow.
    left, right = Arc(0.3, 0.5 * math.pi), Arc(0.3, -math.pi)
    route = Route.joined([Line(30.0), left, Line(1.0), right, Line(1.0), left, Line(30.0)])
    walk = Walk(Dragon.of_sizes([0.7, 2.05, 0.7], 0.1), route)
    with pytest.raises(WalkError, match="bench 2 cannot follow"):
        first_contact(walk, 0.0, 60.0)


def test_what_lies_behind_a_bench_in_its_cell_must_be_followed_by_the_next() -> None:
    # Round this bend a bench cannot go: its rear would have to walk back. The head has passed it.
    link, short = 1.65, 0.2
    radius = 0.5 * math.sqrt(link**2 - short**2)
    bend = Route.joined([Line(5.0), Arc(radius, math.pi), Line(20.0)])
    beyond = float(bend.joints[2]) + 0.25
    walk = Walk(Dragon.of_sizes([2.2] * 4, 0.05, 0.275, 0.275), bend, start=beyond)
    walk.motion([0.0])
    with pytest.raises(WalkError, match="bench 2"):
        first_contact(walk, 0.0, 8.0)


@pytest.mark.parametrize(("rest", "start"), [(False, 0.0), (False, 7.0), (True, 5.0), (True, 12.0)])
def test_who_stands_in_contact_touches_from_the_start_on(rest: bool, start: float) -> None:
    # The head stands until 20 s, at `rest` after it has walked; the benches overlap all the while.
    knots = ((0.0, 5.0, 20.0, 30.0), (1.0, 0.0, 0.0, 1.0)) if rest else ((20.0, 30.0), (0.0, 1.0))
    route = Route((Spiral(0.3, 24.0 * math.pi, 4.0 * math.pi),))
    walk = Walk(Dragon.uniform(30), route, SpeedProfile(*knots), 5.0)
    found = first_contact(walk, start, 40.0)
    assert found is not None
    assert found.witness is not None
    assert (found.lower, found.value, found.upper, found.witness.time) == (start,) * 4


def test_brackets_end_where_the_head_stands() -> None:
    profile = SpeedProfile((0.0, 10.0, 20.0), (1.0, 0.0, 0.0))
    walk = Walk(Dragon.uniform(20), Route((Spiral(0.55, 12.0 * math.pi, 0.0),)), profile)
    times = HeadTimes(walk, 0.0)
    for s in (5.0, math.nextafter(5.0, 0.0), math.nextafter(5.0, 9.0)):
        value, lower, upper = times.bracketed(s, s)
        assert lower <= value <= upper


@pytest.mark.parametrize("profile", [((0.1, 3.3, 7.7), (0.3, 1.7, 0.01)), ((0.3, 1e3), (0.7, 1.3))])
def test_brackets_are_sure_without_rounding(profile: tuple[tuple[float, ...], ...]) -> None:
    route = Route((Spiral(0.55, 32.0 * math.pi, 0.0),))
    walk = Walk(Dragon.uniform(20), route, SpeedProfile(*profile), 0.1)
    times = HeadTimes(walk, 0.1)
    for s in np.random.default_rng(3).uniform(1.0, 9.0, 60).tolist():
        value, lower, upper = times.bracketed(s, s)
        assert walk.exact_head_position(lower) <= s <= walk.exact_head_position(upper)
        assert lower <= value <= upper
        assert upper - lower < 1e-11


def test_a_walk_that_overlaps_and_then_falls_is_one_that_falls(contest: Walk) -> None:
    with pytest.raises(WalkError):
        least_clearance(contest, 405.0, contest.route.length + 30.0)


def test_longer_dragons_are_searched_without_a_hint(
    contest: Walk, monkeypatch: pytest.MonkeyPatch
) -> None:
    hinted = least_clearance(contest, 395.0, 405.0)
    in_python(monkeypatch)
    monkeypatch.setattr(contact_least, "MOST_SAMPLED", 100)
    plain = least_clearance(contest, 395.0, 405.0)
    assert plain.value == pytest.approx(hinted.value, abs=1e-12)
    assert plain.witness is not None
    assert hinted.witness is not None
    assert plain.witness.benches == hinted.witness.benches


@pytest.mark.parametrize("family", ["arc-arc", "arc-line-arc"])
def test_a_turns_least_clearance_is_just_below_all_samples(family: str) -> None:
    plan = read_plan("turn", [f"turn.family={family}"])
    walk = plan.build()
    start, end = plan.span(walk)
    found = least_clearance(walk, start, end)
    motion = walk.motion(np.linspace(start, end, 6000))
    sampled = least_distance(walk.dragon.sizes, motion.x.T, motion.y.T)
    assert found.witness is not None
    # What was asked for, and twice the bound on rounding on either side.
    assert found.upper - found.lower <= min(1e-12 + 4.0 * pair_off(walk, found.witness), 2.5e-12)
    assert found.value <= sampled < found.value + 1e-3


def test_a_least_clearance_leaves_room_below(contest: Walk) -> None:
    found = least_clearance(contest, 395.0, 405.0)
    assert 1e-12 <= found.value - found.lower < 1.3e-12


def test_benches_in_two_clear_spans_come_near() -> None:
    """A wide head on its way out, past benches on their way in: turns of two spirals."""
    walk = read_plan("turn").build()
    width = np.full(223, 0.3)
    width[0] = 0.85
    sizes = walk.dragon.sizes
    wide = Walk(Dragon.of_sizes(sizes[0], width, *sizes[2:]), walk.route, walk.profile, walk.start)
    least = least_clearance(wide, 60.0, 61.0)
    assert least.witness is not None
    assert 1 in least.witness.benches
    margin = least.value + 1e-6
    found = first_contact(wide, 60.0, 61.0, margin=margin)
    low = clearances(wide.motion(np.linspace(60.0, 61.0, 201))) < margin - 1e-9
    assert low[0] == (found is not None and found.upper == 60.0)
    assert found is not None


@pytest.mark.parametrize(
    ("closes", "passes", "floor"),
    [((1e-12, 1e-5), 1, 0.1999), ((1e-5,), 3, 0.1999), ((math.inf,), 5, 0.0)],
)
def test_a_floor_is_told_by_a_pass_that_came_to_its_end(
    monkeypatch: pytest.MonkeyPatch, closes: Sequence[float], passes: int, floor: float
) -> None:
    """A search whose passes end at these tolerances alone, m."""
    seen: list[float] = []

    def ended(block: int, _goal: int, tolerance: float, _left: float, _counted: int) -> int:
        note = memory.group_at(Hunt, block + BASE).note
        seen.append(tolerance)
        note[[Note.NEAREST, Note.FLOOR, Note.PAIR]] = 0.2, 0.1999, 2.0
        return Ending.CLEAR if tolerance in closes else Ending.GRAZE

    in_python(monkeypatch)
    monkeypatch.setattr(contact_steps, "searched_on", ended)
    walk = Walk(Dragon.uniform(4), Route((Line(30.0),)), start=15.0)
    found = least_clearance(walk, 0.0, 1.0)
    assert found.witness is not None
    assert (found.value, found.witness.benches) == (0.2, (1, 3))
    assert found.lower == pytest.approx(floor, abs=1e-12)
    assert seen == [*TOLERANCES, math.inf][:passes]


@pytest.mark.parametrize("benches", [3, 40])
def test_the_least_clearance_of_an_instant_is_that_of_the_nearest_pair(
    contest: Walk, benches: int
) -> None:
    walk = replace(contest, dragon=Dragon.uniform(benches))
    found, nearest = least_clearance(walk, 300.0, 300.0), tightest_pairs(walk.placement([300.0]))[0]
    assert found.value == nearest.distance > 0.0
    assert found.evaluations == 0  # there is nothing to search
    assert found.value - 2e-13 <= found.lower < found.value < found.upper <= found.value + 2e-13
    assert found.witness is not None
    assert (found.witness.benches, found.witness.s) == (nearest.benches, 300.0)


def test_the_nearest_pair_of_uneven_benches_is_found_at_any_instant() -> None:
    rng = np.random.default_rng(8)
    dragon = Dragon.of_sizes(rng.uniform(1.0, 2.4, 40), rng.uniform(0.1, 0.4, 40), 0.2, 0.1)
    walk = Walk(dragon, Route((Spiral(0.9, 40.0, 5.0),)))
    for t in range(0, 40, 2):
        nearest = tightest_pairs(walk.placement([float(t)]))[0]
        found = least_clearance(walk, float(t), float(t))
        assert found.witness is not None
        assert (found.value, found.witness.benches) == (nearest.distance, nearest.benches)
