"""standing.js: a plan that stays is answered soon, and some are answered while edits go on."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from benchdragon.inlining import WEB
from tests.engine.recording import node

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")


def story(long: int, edits: list[tuple[int, str]]) -> tuple[list[list[Any]], int]:
    """Answers, (plan, ms), and how many questions were given up.

    Edits lead to plans at some ms; an answer takes so long.
    """
    program = node()
    assert program is not None
    script = Path(__file__).with_name("standing.mjs")
    done = subprocess.run(
        [program, script, WEB, str(long), json.dumps(edits)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    return found["said"], found["given"]


def test_a_plan_that_stays_is_asked_about_soon_though_answers_take_long() -> None:
    said, given = story(4000, [(0, "a"), (5000, "b"), (5300, "c")])
    assert (said, given) == ([["a", 4000], ["c", 5300 + 250 + 4000]], 1)


def test_an_answer_that_comes_before_a_plan_stayed_so_long_is_waited_for() -> None:
    said, given = story(4000, [(0, "a"), (5000, "b"), (8800, "c")])
    assert (said, given) == ([["a", 4000], ["b", 9000], ["c", 13000]], 0)


@pytest.mark.parametrize(("apart", "long"), [(300, 400), (500, 1000), (30, 200), (400, 3000)])
def test_some_are_answered_while_edits_go_on(apart: int, long: int) -> None:
    names = [f"{n:03}" for n in range(100)]
    said, given = story(long, [(n * apart, name) for n, name in enumerate(names)])
    answered = [name for name, _ms in said]
    assert answered[-1] == names[-1]
    assert answered == sorted(answered)
    assert len(answered) > 0.5 * 100 * apart / (apart + long)
    assert given < 8


def test_a_plan_that_is_taken_up_again_is_not_asked_about_anew() -> None:
    """Undo brings back the very plan that is on its way."""
    said, given = story(4000, [(0, "a"), (5000, "b"), (5100, "c"), (5200, "b")])
    assert (said[:2], given) == ([["a", 4000], ["b", 9000]], 0)
