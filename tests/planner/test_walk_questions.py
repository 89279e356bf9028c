"""Contact, speeds, times of heads: walks given as numbers are answered as Python does."""

import math
import random
import struct
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np
import pytest

from benchdragon import Answer, BenchDragonError, Walk
from benchdragon.analysis.contact import (
    Window,
    contact_windows,
    first_sure_contact,
    least_clearance,
)
from benchdragon.analysis.head_times import HeadTimes
from benchdragon.analysis.obstacles import obstacle_answers
from benchdragon.analysis.speed import QUANTITIES, greatest
from benchdragon.model.obstacle import Obstacle
from benchdragon.number_format import decimals, figures, known
from benchdragon.plans.schema import read_plan
from tests.engine.recording import node
from tests.laws.hard_dances import dance
from tests.laws.random_squares import random_square
from tests.planner.twins import asked
from tests.planner.verdicts import differences

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

Options = dict[str, Any]
# A walk, what is asked, from when to when, s, and how.
Question = tuple[Walk, str, float, float, Options]
NEAR = {"tolerances": [1e-3]}


def windows(walk: Walk, start: float, end: float, **options: Any) -> list[Window]:
    return contact_windows(walk, start, end, **options)


def peak(walk: Walk, start: float, end: float, quantity: str, **options: Any) -> Answer:
    return greatest(walk, QUANTITIES[quantity], start, end, **options)


def obstacle(walk: Walk, start: float, end: float, **sizes: Any) -> dict[str, Any]:
    sizes["outline"] = np.array(sizes["outline"])
    found = obstacle_answers(walk, Obstacle(**sizes), start, end)
    return {"contact": found.contact, "distance": found.distance, "touch": found.touch}


def times(walk: Walk, start: float, _end: float, at: list[float]) -> list[tuple[float, ...]]:
    known = HeadTimes(walk, float(walk.head_position([start])[0]), start)
    return [known.bracketed(s, s) for s in at]


ASKED: dict[str, Callable[..., Any]] = {
    "windows": windows,
    "contact": first_sure_contact,
    "clearance": least_clearance,
    "greatest": peak,
    "obstacle": obstacle,
    "times": times,
}


def numbers(walk: Walk) -> dict[str, Any]:
    """A walk as ask_walks.mjs takes it; JSON knows no infinity."""
    rows = [[text(value) for value in row] for row in walk.route.rows.tolist()]
    sizes = walk.dragon.sizes.tolist()
    knots = {"times": list(walk.profile.times), "speeds": list(walk.profile.speeds)}
    return {"sizes": sizes, "rows": rows, **knots, "start": walk.start}


def text(value: float) -> float | str:
    return value if math.isfinite(value) else ("Infinity" if value > 0 else "-Infinity")


def plain(found: Any) -> Any:
    """An answer, or several, as JSON has them."""
    if isinstance(found, list | tuple):
        return [plain(one) for one in found]
    if isinstance(found, Answer | Window):
        return {name: plain(value) for name, value in asdict(found).items()}
    if isinstance(found, dict):
        return {name: plain(value) for name, value in found.items()}
    return found


def answered(question: Question) -> Any:
    """What Python answers: see ask_walks.mjs."""
    walk, name, start, end, options = question
    try:
        return {"found": plain(ASKED[name](walk, start, end, **options))}
    except BenchDragonError as error:
        return {"error": type(error).__name__, "text": str(error)}


def compared(questions: list[Question]) -> Counter[str]:
    """How answers agree: the same, another of equal witnesses, or what differs."""
    said = asked(
        "ask_walks.mjs",
        [
            {"walk": numbers(walk), "name": name, "start": start, "end": end, "options": options}
            for walk, name, start, end, options in questions
        ],
    )
    found: Counter[str] = Counter()
    for question, twin in zip(questions, said, strict=True):
        paths = list(differences(answered(question), twin))
        rest = [path for path in paths if ".witness" not in path]
        found["; ".join(rest)[:300] or ("another witness" if paths else "same")] += 1
    return found


def test_contact_and_clearance_of_hard_dances_are_the_same() -> None:
    questions = []
    for seed in range(30):
        tried = dance(seed)
        margin = {"margin": tried.margin}
        asked_of: list[tuple[str, Options]] = [
            ("contact", margin), ("windows", {**margin, "most": 5}), ("clearance", NEAR),
            ("clearance", {"within": 0.2}),
        ]  # fmt: skip
        questions += [(tried.walk, name, 0.0, tried.end, options) for name, options in asked_of]
    found = compared(questions)
    assert set(found) <= {"same", "another witness"}
    assert found["same"] > 0.85 * len(questions)


def test_walks_that_begin_in_contact_are_told_alike() -> None:
    questions: list[Question] = []
    for tried in map(dance, range(60)):
        try:
            found = contact_windows(tried.walk, 0.0, tried.end, margin=tried.margin, most=1)
        except BenchDragonError:
            continue
        if found and found[0].opens.upper + 0.01 < tried.end:
            start, options = found[0].opens.upper + 0.01, {"margin": tried.margin}
            questions.append((tried.walk, "windows", start, tried.end, {**options, "most": 2}))
            questions.append((tried.walk, "clearance", start, start, {}))
    assert len(questions) > 10
    assert set(compared(questions)) <= {"same", "another witness"}


def test_a_sure_contact_is_told_before_a_graze() -> None:
    walk = read_plan("spiral-in", ["route.pitch=0.4503373930271955"]).build()
    (graze,) = contact_windows(walk, 200.0, 330.0, most=1)
    assert graze.opens.status == "undecided"
    assert compared([(walk, "contact", 200.0, 330.0, {"margin": 0.0})]) == {"same": 1}


def test_random_squares_are_the_same() -> None:
    questions: list[Question] = []
    for square in map(random_square, range(60)):
        one = square.obstacle
        sizes = {"name": one.name, "kind": one.kind, "outline": one.outline.tolist()}
        options = {**sizes, "radius": one.radius, "margin": one.margin}
        questions.append((square.walk, "obstacle", square.start, square.end, options))
    found = compared(questions)
    assert set(found) <= {"same", "another witness"}
    assert found["same"] > 0.85 * len(questions)


def test_greatest_quantities_of_hard_dances_are_the_same() -> None:
    questions = [
        (tried.walk, "greatest", 0.0, tried.end, {"quantity": name, "tolerance": 1e-6, "limit": 3.0})
        for tried in map(dance, range(6))
        for name in QUANTITIES
    ]
    found = compared(questions)
    assert set(found) <= {"same", "another witness"}
    assert found["same"] > 0.85 * len(questions)


def test_brackets_of_times_are_the_same_but_for_where_heads_are_rounded_to() -> None:
    dice, questions, known = random.Random(8), [], []
    for tried in map(dance, range(40)):
        at = [dice.uniform(tried.walk.start - 1.0, tried.last + 1.0) for _n in range(20)]
        question = {"walk": numbers(tried.walk), "name": "times", "start": 0.0, "end": 0.0}
        questions.append({**question, "options": {"at": at}})
        known.append(times(tried.walk, 0.0, 0.0, at))
    twins = asked("ask_walks.mjs", questions)
    for twin, here in zip(twins, known, strict=True):
        there = np.array([tuple(map(float, one)) for one in twin["found"]])
        np.testing.assert_allclose(there, here, rtol=0.0, atol=5e-13)
        assert (there[:, 0] == np.array(here)[:, 0]).all()


def test_numbers_are_written_as_python_writes_them() -> None:
    dice = random.Random(5)
    values = [0.0, -0.0, 0.5, 2.5, 1e23, 9.9999995, 999999.5, 5e-324, 0.0001, 99999.95, -1e-9]
    values += [dice.randint(-(10**6), 10**6) / 2 ** dice.randint(0, 30) for _n in range(2000)]
    bits = (struct.unpack("d", dice.randbytes(8))[0] for _n in range(2000))
    values += [value for value in bits if math.isfinite(value)]
    said = asked("formats.mjs", [repr(value) for value in values])
    for value, (*texts, step) in zip(values, said, strict=True):
        formats = f"{value:z.1f}", f"{value:g}", f"{value:.17g}", f"{value:.1e}"
        assert texts[:5] == [decimals(value), *formats]
        assert texts[5:7] == [figures(value, up=up) for up in (True, False)]
        if abs(value) < 1e9:
            most = known(value, value + 7e-4, "m/s", up=True, limit=1.25)
            assert texts[7:] == [most, known(value, value, "m", up=False, limit=value + 1e-4)]
        assert float(step) == math.ulp(value)
