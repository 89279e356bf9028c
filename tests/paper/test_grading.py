"""Numbers that students hand in: right ones, known mistakes, and what no answer can be."""

import math

import pytest

import benchdragon as bd
from benchdragon.paper.grading import MOST, TASKS

# By formulas or by programs that share nothing with the package: tests/truth, and by hand.
KNOWN = {
    "contact": 412.473837682, "pitch": 0.450337393, "turn-length": 13.621244907,
    "head-speed": 1.246266358, "link": 2.2,
}  # fmt: skip


def test_known_answers_are_right() -> None:
    for task, answer in KNOWN.items():
        found = bd.grade(task, answer)
        assert (found.agrees, found.score) == (True, 1.0), task
        assert found.figures >= 9


def test_the_coil_of_the_exercises_is_that_of_their_text() -> None:
    """Each answer found again by what the text says, without the package."""
    k, angle = 0.6 / (2.0 * math.pi), 32.0 * math.pi

    def metres(a: float) -> float:
        return 0.5 * k * (a * math.sqrt(1.0 + a * a) + math.asinh(a))

    def root(f, low: float, high: float) -> float:  # type: ignore[no-untyped-def]
        for _step in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if f(middle) < 0.0 else (low, middle)
        return low

    head = root(lambda a: metres(a) - metres(angle) + 200.0, 1.0, angle)
    x, y = k * head * math.cos(head), k * head * math.sin(head)
    assert bd.grade("head", [x, y]).figures >= 9
    assert not bd.grade("head", [y, x]).agrees
    behind = root(
        lambda h: abs(k * head - k * (head + h) * complex(math.cos(h), math.sin(h))) - 2.86, 0.0, 3.0
    )
    assert bd.grade("chord", behind).figures >= 9


def test_answers_of_the_exercises_are_those_of_the_searches() -> None:
    coil = bd.read_plan("spiral-in", {"route.pitch": 0.6, "dragon.benches": 100})
    contact = coil.first_contact()
    assert contact is not None
    touch, gap = bd.grade("touch", contact.value), coil.motion(460.0)
    assert touch.agrees
    assert coil.motion(contact.value - 1e-3).walk == gap.walk
    assert bd.grade("gap", bd.clearances(gap)[0]).agrees
    assert bd.grade("tail-speed", coil.motion(200.0).speed[0, 100]).agrees
    assert not bd.grade("tail-speed", coil.motion(200.0).speed[0, 99]).agrees
    assert bd.grade("arcs", bd.TwoArcTurn(1.5, 4.0, 3.0).length).agrees
    narrow = bd.limit(bd.read_plan("question-3", {"disc.radius": 5.0}), "pitch")
    assert bd.grade("narrowest", narrow.value).agrees
    fast = bd.greatest_head_speed(bd.read_plan("turn", {"turn.ratio": 1.0}))
    assert bd.grade("fastest", fast.value).agrees


@pytest.mark.parametrize(
    ("task", "answer", "finding"),
    [
        ("contact", 413.0, "in steps of 1 s"),
        ("contact", 415.0, "in steps of 5 s"),
        ("contact", 442.59026, "the test for contact never fires"),
        ("pitch", 0.43, "only when the head reaches the disc"),
        ("pitch", 0.4203, "only when the head reaches the disc"),
        ("turn-length", 9.0, "the straight way across the disc"),
        ("head-speed", 1.40628, "in steps of 1 s: the peak lies between"),
        ("head-speed", 1.24701, "in steps of 0.1 s: the peak lies between"),
        ("head-speed", 2.0, "the limit itself"),
        ("link", 2.4, "figures that agree: 1, of 6 that are required"),
        ("pitch", math.nan, "there is no number yet"),
        ("pitch", math.inf, "figures that agree: 0, of 6 that are required"),
        ("pitch", -0.450337393, "figures that agree: 0, of 6 that are required"),
    ],
)
def test_a_known_mistake_is_named_and_no_answer_told(task: str, answer: float, finding: str) -> None:
    found = bd.grade(task, answer)
    assert finding in found.finding
    assert (found.agrees, found.score) == (False, 0.0)
    assert str(found) == f"{task}: 0 of 100 points: {found.finding}"
    assert f"{KNOWN[task]:.4f}" not in found.finding or task == "link"


def test_six_figures_are_required() -> None:
    figures = {0.4503374: 7, 0.450337: 6, 0.45034: 5, 0.4503: 4, 0.5: 1, 0.6: 0}
    assert {answer: bd.grade("pitch", answer).figures for answer in figures} == figures
    assert [bd.grade("pitch", answer).agrees for answer in (0.450337, 0.45034)] == [True, False]
    assert bd.grade("link", 2.2).figures == MOST


def test_what_is_no_answer_is_refused() -> None:
    with pytest.raises(bd.InputError, match=r"task must be one of contact, pitch, .*, not 'lenght'"):
        bd.grade("lenght", 1.0)
    with pytest.raises(bd.InputError, match="as many numbers as the task head asks for: 2, not 1"):
        bd.grade("head", 1.0)
    with pytest.raises(bd.InputError, match="answer must be numbers, not 'x'"):
        bd.grade("pitch", "x")


def test_each_exercise_stands_in_the_manual() -> None:
    from tests.test_docs import LANGUAGES, source

    for language in LANGUAGES:
        text = source(language, "contest.md")
        assert [
            task for task in TASKS if f'grade("{task}"' not in text and f"`{task}`" not in text
        ] == []


def test_of_several_numbers_the_worst_counts() -> None:
    motion = bd.read_plan("spiral-in", {"route.pitch": 0.6, "dragon.benches": 100}).motion(200.0)
    x, y = float(motion.x[0, 0]), float(motion.y[0, 0])
    assert bd.grade("head", [x, y]).figures == MOST
    assert bd.grade("head", [x, 1.001 * y]).figures == 2
    assert bd.grade("head", [1.001 * x, y]).figures == 3
