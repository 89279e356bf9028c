"""What people type into the page is read as `new` reads it, or asked back in the same words."""

from typing import Any

import pytest

from benchdragon.errors import InputError
from benchdragon.i18n import use_language
from benchdragon.plans.answers import QUESTIONS, number_in
from tests.engine.recording import node
from tests.planner.twins import asked
from tests.plans.test_answers import ANSWERS, MIXES, NUMBERS, REFUSED

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")


def test_the_page_reads_numbers_as_new_does() -> None:
    typed = [(text, unit) for text, unit, _value in NUMBERS]
    found = dict(zip(typed, asked("typed.mjs", typed), strict=True))
    assert found == pytest.approx(dict(zip(typed, (number_in(*one) for one in typed), strict=True)))


def test_the_page_reads_answers_and_asks_back_as_new_does() -> None:
    use_language("en")
    typed = [(text, name) for name, text, _value in (*ANSWERS, *REFUSED, *MIXES)]
    found = asked("typed.mjs", typed)
    assert found == [answered(name, text) for text, name in typed]
    assert sum(isinstance(one, str) and one.startswith("it: ") for one in found) >= 12


def answered(name: str, text: str) -> Any:
    question = next(one for one in QUESTIONS if one.name == name)
    try:
        value = question.answer("it", text)
    except InputError as error:
        return str(error)
    return list(value) if isinstance(value, tuple) else value
