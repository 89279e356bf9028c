"""Answers to what villages are asked, as people type them."""

from typing import Any

import pytest

from benchdragon.errors import InputError
from benchdragon.i18n import use_language
from benchdragon.plans.answers import QUESTIONS, Question, number_in, wished

BY_NAME = {one.name: one for one in QUESTIONS}


# Numbers as people type them, in the unit that is asked for; None: they may mean something else.
NUMBERS: list[tuple[str, str, float | None]] = [
    *((text, "m", 1.5) for text in (
        "150cm", "1米5", "1.5", "1.5m", "1.5米", "1.50 m", "150公分", "一米五", "1m50cm", "1 m 50 cm",
        "１.５", "１５０ｃｍ", "约1.5米", "1.5.", "1500mm", "1米50公分", "+1.5", "1.5 M", "1米五",
    )),
    ("1米85", "m", 1.85), ("一米八", "m", 1.8), ("15 cm左右", "m", 0.15), ("0.15km", "m", 150.0),
    ("1e1", "m", 10.0), ("-1cm", "m", -0.01),
    *((text, "m", None) for text in (
        "1,5", "1。5", "0x5", "5尺", "5 ft", "1,5 m", "1.2.3", "NaN", "1/2", "1_5", "100二十", "一百二",
        "1.5 m/s", "1e999", "abc", "公分", "", "1 5", "1米5米", "1 .5",
    )),
    *((text, "m/s", 0.8) for text in (
        "0.8", "0.8 m/s", "0.8米/秒", "0.8米", "0.8米每秒", "每秒0.8米", "2.88 km/h", "48 m/min",
    )),
    ("0,8", "m/s", None), ("0.8 s", "m/s", None), ("\u22125 s", "s", -5.0), ("1 min 5 s", "s", 65.0),
    ("120", "", 120.0), ("120条", "", 120.0), ("一百二十", "", 120.0), ("120 benches", "", 120.0),
    ("120人", "", 120.0), ("1,000", "", None), ("12 m", "", None), ("5", "1/m", 5.0),
]  # fmt: skip
ANSWERS: list[tuple[str, str, object]] = [
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
]  # fmt: skip
# What is asked back, and a piece of what is said.
REFUSED = [
    ("bearers", "some", "such as 2,"), ("benches", "一百二", "such as 120,"),
    ("bench_width", "30", "write 30cm"), ("bench_length", "150", "write 150cm"),
    ("bench_length", "long", "such as 1.5,"), ("square", "30", "(30x20)"),
    ("sway", "3", "write 3cm"), ("imprecision", "-1cm", "from 0 cm to 1 m"),
    ("carry", "", "beside (1) or under (2)"), ("carry", "边上或下面", "beside (1)"),
    ("speed", "0", "such as 0.8,"),
]  # fmt: skip
MIXES = [
    ("benches", "100二十", "100二十"),
    ("square", "3十x20", "3十"),
    ("bench_length", "二2米", "二2"),
]


def question(name: str) -> Question:
    return BY_NAME[name]


@pytest.mark.parametrize(("text", "unit", "value"), NUMBERS)
def test_a_number_is_read_only_where_it_says_one_for_sure(
    text: str, unit: str, value: float | None
) -> None:
    assert number_in(text, unit) == (value if value is None else pytest.approx(value))


@pytest.mark.parametrize(("name", "text", "value"), ANSWERS)
def test_an_answer_as_people_type_it(name: str, text: str, value: object) -> None:
    assert question(name).answer("it", text) == value


@pytest.mark.parametrize(("name", "text", "told"), REFUSED)
def test_an_error_names_the_example_of_its_own_question(name: str, text: str, told: str) -> None:
    use_language("en")
    with pytest.raises(InputError) as error:
        question(name).answer("it", text)
    assert str(error.value).startswith("it: ")
    assert told in str(error.value)


@pytest.mark.parametrize(("name", "text", "mixed"), MIXES)
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
    assert float(question("head_length").usual({"bench_length": 2.2})) > 2.2


def test_usual_answers_are_wishes_and_no_measurements() -> None:
    said: dict[str, Any] = {"benches": 9, "bench_length": 1.5, "square": 12.0}
    for one in QUESTIONS:
        said.setdefault(one.name, one.answer("it", one.usual(said)) if one.usually else None)
    found = wished(said, {"sway", "benches"})
    assert (found["rectangle"], found["radius"], found["head_length"]) == (None, 12.0, 2.0)
    assert found["measured"] == ["sway"]
    assert wished(said | {"square": (30.0, 20.0)}, set())["rectangle"] == (30.0, 20.0)
    assert wished(said, set())["measured"] == []
