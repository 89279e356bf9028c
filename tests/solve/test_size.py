"""Inverse answers: the smallest pitch and disc, the widest and longest bench, the paper's traversal."""

import math

import numpy as np
import pytest
import shapely

from benchdragon import clearances
from benchdragon.analysis.contact import first_contact, least_clearance
from benchdragon.errors import BenchDragonError, InputError
from benchdragon.kernels import size_memory, size_question
from benchdragon.kernels.memory import group_at
from benchdragon.kernels.size_bracket import Bracket, SizeVerdict
from benchdragon.model.answer import Answer
from benchdragon.paper.traversal import pitch_curve, traversed_pitch
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.toml import PlanError
from benchdragon.solve.size import Span, feasible_sizes, limit, smallest_pitch
from benchdragon.solve.size_family import QUESTIONS, TOLERANCE, PlanFamily
from tests.solve.asked_in_python import in_python

SMALLEST_PITCH = 0.4503373930271955


@pytest.fixture(scope="module")
def disc() -> Plan:
    return read_plan("spiral-in", ["disc.radius=4.5"])


@pytest.fixture(scope="module")
def pitch(disc: Plan) -> Answer:
    return smallest_pitch(disc)


def test_the_smallest_pitch_is_the_true_one(pitch: Answer, disc: Plan) -> None:
    assert pitch.value == pytest.approx(SMALLEST_PITCH, abs=1e-13)
    assert pitch.lower < SMALLEST_PITCH < pitch.upper
    assert pitch.upper - pitch.lower <= 1e-12
    assert pitch.status == "found"
    assert pitch.witness is not None
    assert pitch.witness.benches == (1, 20)
    walk = disc.with_value("route.pitch", pitch.value).build()
    assert walk.route.length - pitch.witness.s == pytest.approx(4.5957236, abs=2e-6)
    assert math.hypot(*walk.route.point(pitch.witness.s)) == pytest.approx(4.572603, abs=1e-5)


def test_both_ends_of_the_bracket_are_what_they_are_said_to_be(pitch: Answer, disc: Plan) -> None:
    passes = disc.with_value("route.pitch", pitch.upper).build()
    assert first_contact(passes, 0.0, passes.route.length) is None
    fails = disc.with_value("route.pitch", pitch.lower - 1e-9).build()
    assert first_contact(fails, 0.0, fails.route.length) is not None


@pytest.mark.parametrize(
    ("name", "keys", "safe"),
    [(question.name, question.keys, question.sense) for question in QUESTIONS.values()],
)
def test_a_walk_passes_just_on_the_safe_side_of_each_limit(
    disc: Plan, name: str, keys: tuple[str, ...], safe: float
) -> None:
    found = limit(disc, name)
    assert found.upper - found.lower <= 2e-12
    for side, clear in ((safe, True), (-safe, False)):
        plan = disc
        for key in keys:
            plan = plan.with_value(key, found.value + side * 1e-7)
        walk = plan.build()
        assert (first_contact(walk, *plan.span(walk)) is None) == clear


def test_the_smallest_disc_is_where_the_head_first_touches(disc: Plan) -> None:
    found = limit(disc, "disc")
    walk = read_plan("spiral-in").build()
    contact = first_contact(walk, 0.0, 430.0)
    assert contact is not None
    assert found.value == pytest.approx(math.hypot(*walk.route.point(contact.value)), abs=1e-10)


def test_a_margin_counts_distance_and_not_gap_by_shapelys_buffers(disc: Plan) -> None:
    found = limit(disc, "pitch", margin=0.10)
    assert found.witness is not None
    assert found.value > SMALLEST_PITCH + 0.05
    walk = disc.with_value("route.pitch", found.value).build()
    s, (a, b) = found.witness.s, found.witness.benches
    # Around the critical moment the two benches, each 0.05 m fatter with round corners, just touch.
    apart = []
    for near in np.linspace(s - 0.5, s + 0.5, 201):
        motion = walk.motion([near])
        first, second = shapely.buffer(motion.outlines()[0, [a - 1, b - 1]], 0.05, quad_segs=256)
        apart.append(
            first.distance(second) if first.disjoint(second) else -first.intersection(second).area
        )
    assert min(apart) == pytest.approx(0.0, abs=2e-5)
    others = list(walk.motion([s]).outlines()[0])
    tree = shapely.STRtree(others)
    first, second = tree.query(others, predicate="dwithin", distance=0.0999)
    assert all(abs(i - j) <= 1 for i, j in zip(first.tolist(), second.tolist(), strict=True))


def test_the_last_walk_of_a_family_is_kept_and_no_other_taken_for_it(disc: Plan) -> None:
    family = PlanFamily(disc, QUESTIONS["pitch"], 0.0)
    walk, *times = family.walk(0.55)
    assert family.walk(0.55)[0] is walk
    other = family.walk(0.56)[0]
    assert other.route.curves[0] == disc.with_value("route.pitch", 0.56).build().route.curves[0]
    again, *same = family.walk(0.55)
    assert again.route.curves[0] == walk.route.curves[0] != other.route.curves[0]
    assert same == times


def test_a_plan_that_fails_is_widened_until_it_passes(disc: Plan) -> None:
    found = limit(disc.with_value("route.pitch", 0.40), "pitch")
    assert found.value == pytest.approx(SMALLEST_PITCH, abs=1e-13)


def test_no_size_at_all_is_infeasible() -> None:
    # A bench of any width fits here, but none is short enough for a head that starts too far in.
    plan = read_plan("spiral-in", ["disc.radius=4.5", "limits.margin=3.0", "dragon.benches=60"])
    found = limit(plan, "width")
    assert found.status == "infeasible"


def test_walkable_pitches_begin_at_the_smallest(disc: Plan) -> None:
    found = feasible_sizes(disc, "pitch", 0.43, 0.47, 5)
    (span,) = found.spans
    assert span.low == pytest.approx(SMALLEST_PITCH, abs=2e-12)
    assert (span.high, span.tried) == (0.47, 2)
    assert found.step == pytest.approx(0.01)
    assert found.undecided == ()
    assert feasible_sizes(disc, "pitch", 0.40, 0.43, 3).spans == ()


def undecided(monkeypatch: pytest.MonkeyPatch, low: float, high: float) -> None:
    """Let no search decide walks whose size lies between these, m."""
    real = size_question.gone_on

    def gone_on(block: int, left: float) -> int:
        size = group_at(size_memory.Sought, block + size_memory.BASE).state[Bracket.NOW]
        return SizeVerdict.UNDECIDED if low < size < high else real(block, left)

    in_python(monkeypatch)
    monkeypatch.setattr(size_question, "gone_on", gone_on)


@pytest.mark.parametrize("band", [(0.49, 0.51), (0.46, 0.47), (0.50, 0.60), (0.3, 0.4)])
def test_undecided_sizes_are_no_end_of_a_bracket(
    disc: Plan, monkeypatch: pytest.MonkeyPatch, band: tuple[float, float]
) -> None:
    undecided(monkeypatch, *band)
    found = limit(disc, "pitch")
    assert found.value == pytest.approx(SMALLEST_PITCH, abs=1e-9)
    assert found.status == "found"


@pytest.mark.parametrize("band", [(0.44, 0.46), (0.449, 0.451), (0.45, 0.50)])
def test_where_it_cannot_be_decided_the_bracket_stays_as_wide(
    disc: Plan, monkeypatch: pytest.MonkeyPatch, band: tuple[float, float]
) -> None:
    undecided(monkeypatch, *band)
    found = limit(disc, "pitch")
    assert found.status == "undecided"
    assert found.lower <= band[0]
    assert found.upper == found.value >= band[1]
    # No wider than by a tenth on either side.
    assert found.lower > 0.9 * band[0]
    assert found.upper < 1.1 * band[1]
    assert "are undecided" in found.assumptions[-1]


def test_where_nothing_can_be_decided_nothing_is_found(
    disc: Plan, monkeypatch: pytest.MonkeyPatch
) -> None:
    undecided(monkeypatch, 0.0, math.inf)
    found = limit(disc, "pitch")
    assert found.status == "undecided"
    assert math.isnan(found.value)


@pytest.mark.parametrize("band", [(0.455, 0.465), (0.459, 0.461)])
def test_undecided_sizes_of_a_range_are_told_and_end_a_span(
    disc: Plan, monkeypatch: pytest.MonkeyPatch, band: tuple[float, float]
) -> None:
    undecided(monkeypatch, *band)
    found = feasible_sizes(disc, "pitch", 0.43, 0.49, 7)
    assert found.spans == (Span(0.47, 0.49, 3, ()),)
    assert found.undecided == pytest.approx((0.46,))


def test_the_unsafe_end_of_a_bracket_is_where_the_pair_was_seen_to_touch(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A first root that is off by a micrometre on the safe side ends no search."""
    offsets, real = [1e-6], size_question.begun

    def off(block: int) -> int:
        state = group_at(size_memory.Sought, block + size_memory.BASE).state
        if offsets and state[Bracket.SHIFT] > 0.0:
            state[[Bracket.SIZE, Bracket.ROOT, Bracket.NOW]] += offsets.pop()
        return real(block)

    in_python(monkeypatch)
    monkeypatch.setattr(size_question, "begun", off)
    found = limit(read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=40"]), "pitch")
    assert not offsets
    assert found.status == "found"
    assert found.lower < SMALLEST_PITCH < found.upper <= found.lower + 1e-12


def test_a_long_tail_does_not_end_the_search_for_a_pitch() -> None:
    """By brute force 0.7 m touches, 0.8 m is clear. The answer was 2.1047 m once."""
    keys = "dragon.benches=40", "dragon.tail_length=3.0", "disc.radius=1.0"
    lengths = "dragon.body_length=0.8", "dragon.head_length=0.8"
    insets = "dragon.front_inset=0.1", "dragon.rear_inset=0.1"
    plan = read_plan("spiral-in", [*keys, *lengths, *insets])
    found = limit(plan, "pitch")
    assert found.status == "found"
    passes = plan.with_value("route.pitch", found.upper).build()
    assert first_contact(passes, 0.0, passes.route.length) is None
    assert 0.7 < found.value < 0.8
    sampled = clearances(passes.motion(np.linspace(0.0, passes.route.length, 400)))
    assert sampled.min() >= 0.0
    touches = plan.with_value("route.pitch", found.value - 0.01).build()
    sampled = clearances(touches.motion(np.linspace(0.0, touches.route.length, 4000)))
    assert sampled.min() < 0.0


@pytest.mark.parametrize("name", ["pitch", "width", "length"])
def test_a_head_that_walks_to_the_centre_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=r"say how far in the head comes: set disc\.radius"):
        limit(read_plan("spiral-in"), name)
    with pytest.raises(InputError, match="say how far in"):
        feasible_sizes(read_plan("spiral-in"), name, 0.5, 0.6)
    assert limit(read_plan("spiral-in", ["walk.end=100"]), "width").status == "found"


@pytest.mark.parametrize("step", [0.002, 0.004])
def test_the_papers_pitch_comes_of_more_than_one_step(disc: Plan, step: float) -> None:
    """The paper prints none: so its pitch is consistent with a step, and does not tell it."""
    found = traversed_pitch(disc, step, 1.0)
    assert found.value == pytest.approx(0.452, abs=1e-12)
    assert found.status == "undecided"


@pytest.mark.parametrize(
    ("pitch_step", "time_step", "first", "wanted"),
    [(0.001, 1.0, 0.448, 0.451), (0.0005, 1.0, 0.449, 0.4505), (0.001, 1e6, 0.41, 0.421)],
)
def test_the_traversals_answer_moves_with_its_steps(
    disc: Plan, pitch_step: float, time_step: float, first: float, wanted: float
) -> None:
    found = traversed_pitch(disc, pitch_step, time_step, first=first)
    assert found.value == pytest.approx(wanted, abs=1e-12)


def test_the_pitch_curve_jumps_across_the_discs_angle_at_the_smallest_pitch(disc: Plan) -> None:
    curve = pitch_curve(disc, [SMALLEST_PITCH - 1e-9, SMALLEST_PITCH + 1e-9])
    assert curve.least_angle[0] > curve.disc_angle[0] + 0.9
    assert curve.least_angle[1] < curve.disc_angle[1] - 0.9


def test_jumps_of_the_pitch_curve_are_narrowed(disc: Plan) -> None:
    curve = pitch_curve(disc, [0.448, 0.456], resolution=1e-3)
    steps = np.abs(np.diff(curve.least_angle))
    assert (np.diff(curve.pitch)[steps > 0.5] <= 1e-3).all()
    assert len(curve.pitch) > 5


def test_least_clearance_is_the_slope_of_the_pitch_away(disc: Plan) -> None:
    walk = disc.with_value("route.pitch", SMALLEST_PITCH + 1e-6).build()
    assert least_clearance(walk, 0.0, walk.route.length).value == pytest.approx(1e-6, rel=0.05)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda plan: limit(plan, "colour"), "pitch, disc, width, length"),
        (lambda plan: feasible_sizes(plan, "pitch", 0.5, 0.4), "range"),
        (lambda plan: feasible_sizes(plan, "pitch", 0.4, 0.5, 1), "count"),
        (lambda plan: traversed_pitch(plan, 0.0, 1.0), "pitch_step must be positive"),
        (lambda plan: traversed_pitch(plan, 0.001, math.nan), "time_step must be finite"),
    ],
)
def test_wrong_questions_are_refused_in_a_sentence(disc: Plan, call: object, text: str) -> None:
    assert callable(call)
    with pytest.raises(InputError, match=text):
        call(disc)


def test_a_plan_without_the_size_says_so() -> None:
    with pytest.raises(PlanError, match=r"disc\.radius"):
        limit(read_plan("spiral-in"), "disc")
    with pytest.raises(PlanError, match=r"disc\.radius"):
        pitch_curve(read_plan("spiral-in"), [0.5])


def test_where_there_is_no_limit_the_answer_says_so() -> None:
    answer = limit(read_plan("turn", ["dragon.benches=2"]), "width")
    assert answer.status == "unlimited"
    assert answer.value == pytest.approx(30.0)


def test_questions_that_say_nothing_about_a_plan_are_refused() -> None:
    line = {"kind": "line", "length": 40.0}
    data = {"schema": 1, "route": {"part": [line]}}
    with pytest.raises(BenchDragonError, match=r"disc\.radius, which means nothing beside route\.kind"):
        limit(checked(data, "straight"), "disc")
    benches = [{"length": 3.41}, {"length": 2.2, "count": 20}]
    listed = checked({**data, "dragon": {"bench": benches}}, "listed")
    with pytest.raises(
        BenchDragonError, match=r"dragon\.width, which means nothing beside \[\[dragon\.bench\]\]"
    ):
        limit(listed, "width")
    with pytest.raises(BenchDragonError, match=r"dragon\.width has no effect beside"):
        checked({**data, "dragon": {"bench": benches, "width": 5.0}}, "both")


@pytest.mark.parametrize("tolerance", [TOLERANCE, 1e-5])
def test_a_limit_below_which_there_is_no_walk_needs_no_pair(tolerance: float) -> None:
    """With ten turns of 0.45 m the head would start on the disc's rim."""
    plan = read_plan("spiral-in", ["dragon.benches=40", "disc.radius=4.5", "route.start_turn=10"])
    answer = limit(plan, "pitch", tolerance=tolerance)
    assert answer.lower <= 0.45 <= answer.upper < 0.45 + 2.0 * tolerance
    assert answer.status == "found"
    assert answer.witness is None


@pytest.mark.parametrize("kind", ["formation", "programme"])
def test_benches_are_no_longer_than_the_bends_of_formations_let_them_be(kind: str) -> None:
    """On its run they could be: but no plan may have such, which `check` refuses."""
    swing = {"name": "tail-swing", "swing": 2.6, "swings": 3, "run": 176.4}
    route = {"kind": kind, **(swing if kind == "formation" else {"formation": [swing], "radius": 2.0})}
    told = {"schema": 1, "dragon": {"benches": 3}, "route": route, "walk": {"end": 20.0}}
    plan = checked(told, "plan")
    found = limit(plan, "length")
    plan.with_values({"dragon.body_length": found.lower, "dragon.tail_length": found.lower}).build()
    with pytest.raises(PlanError, match="cannot follow a bend"):
        plan.with_values({"dragon.body_length": found.upper + 2e-12}).build()
