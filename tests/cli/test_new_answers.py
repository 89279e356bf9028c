"""Answers to `benchdragon new` as people type them."""

import pytest

from benchdragon.cli.new_answers import QUESTIONS, Question
from benchdragon.errors import InputError
from benchdragon.i18n import use_language

BY_NAME = {one.name: one for one in QUESTIONS}


def question(name: str) -> Question:
    return BY_NAME[name]


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("benches", "120条", 120), ("benches", "一百二十", 120), ("benches", "１２０ 节", 120),
        ("bench_length", "一米五", 1.5), ("bench_length", "1米85", 1.85),
        ("bench_length", "２．２米", 2.2),
        ("bench_width", "30公分", 0.3), ("bench_width", "15 cm", 0.15), ("inset", "25厘米", 0.25),
        ("square", "30米乘20米", (30.0, 20.0)), ("square", "长30宽20", (30.0, 20.0)),
        ("square", "３０×２０", (30.0, 20.0)), ("square", "半径十二米", 12.0), ("square", "R12", 12.0),
        ("bearers", "两个人", 2), ("carry", "走在下面", "under"), ("carry", "两边", "beside"),
        ("speed", "0.8米/秒", 0.8), ("sway", "三公分", 0.03), ("sway", "0", 0.0),
        ("imprecision", "二十公分", 0.2), ("benches", "120（连龙头）", 120),
        ("bench_length", "2.2米（去年量的）", 2.2), ("sway", "五公分左右", 0.05),
        ("imprecision", "大约十公分", 0.1), ("square", "36 28", (36.0, 28.0)),
        ("square", "36米 28米", (36.0, 28.0)), ("square", "长36米宽28米", (36.0, 28.0)),
        ("square", "长 36 米，宽 28 米", (36.0, 28.0)), ("square", "三十六 二十八", (36.0, 28.0)),
        ("square", "30 x 20", (30.0, 20.0)), ("square", "36x28(祠堂前)", (36.0, 28.0)),
    ],
)  # fmt: skip
def test_an_answer_as_people_type_it(name: str, text: str, value: object) -> None:
    assert question(name).answer("it", text) == value


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("bearers", "some", "such as 2,"), ("benches", "一百二", "such as 120,"),
        ("bench_width", "30", "write 30cm"), ("bench_length", "150", "write 150cm"),
        ("bench_length", "long", "such as 1.5,"), ("square", "30", "(30x20)"),
        ("sway", "3", "write 3cm"), ("imprecision", "-1cm", "from 0 cm to 1 m"),
        ("carry", "", "beside (1) or under (2)"), ("carry", "边上或下面", "beside (1)"),
        ("speed", "0", "such as 0.8,"),
    ],
)  # fmt: skip
def test_an_error_names_the_example_of_its_own_question(name: str, text: str, told: str) -> None:
    use_language("en")
    with pytest.raises(InputError) as error:
        question(name).answer("it", text)
    assert str(error.value).startswith("it: ")
    assert told in str(error.value)


@pytest.mark.parametrize(
    ("name", "text", "mixed"),
    [("benches", "100二十", "100二十"), ("square", "3十x20", "3十"), ("bench_length", "二2米", "二2")],
)
def test_digits_and_words_in_one_number_are_refused(name: str, text: str, mixed: str) -> None:
    use_language("en")
    with pytest.raises(InputError, match=f"it: '{mixed}' is partly in digits and partly in words"):
        question(name).answer("it", text)


def test_answers_are_shown_as_they_were_read() -> None:
    use_language("en")
    shown = {
        ("benches", "120条"): "120", ("bench_length", "1米5"): "1.5 m",
        ("square", "36x28"): "36 m by 28 m", ("square", "r12"): "radius 12 m",
        ("carry", "2"): "under", ("speed", "0.8"): "0.8 m/s", ("sway", "5cm"): "0.05 m",
    }  # fmt: skip
    for (name, text), said in shown.items():
        assert question(name).shown(question(name).answer("it", text)) == said


def test_the_head_is_usually_longer_than_the_benches_that_were_told() -> None:
    usual = question("head_length").usual
    assert usual is not None
    assert float(usual({"bench_length": 2.2})) > 2.2
