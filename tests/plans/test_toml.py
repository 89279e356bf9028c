import inspect
import os
import re
import tomllib
from pathlib import Path

import pytest

from benchdragon.i18n import spoken_in
from benchdragon.plans import toml as plan_text
from benchdragon.plans.schema import read_plan
from benchdragon.plans.toml import TOML_FAULTS, PlanError, parsed, read_toml, toml_fault

DIGITS = "9" * 5000
# Wrong TOML for each of TOML_FAULTS.
WRONG = (
    "x.", "x = 1 y", "x", "[a", "[a]\n[a]", "a = 1\na = 2", "a = {b = 1}\n[a.c]", "=", "a = [1",
    "a = {b", 'a = "\\q"', 'a = "\\uq"', 'a = \'\'\'', 'a = "\x01"', "a = 2024-02-31", "a =", "a = '",
    "[", "]",
)  # fmt: skip


@pytest.mark.parametrize("setting", ["route.pitch=", "dragon.benches=", "walk.end=", "walk.start=-"])
@pytest.mark.parametrize("digits", [DIGITS, DIGITS[:4000], DIGITS[:310]])
def test_numbers_of_thousands_of_digits_are_refused(setting: str, digits: str) -> None:
    with pytest.raises(PlanError, match=r"too many digits|fewer digits|at most 1000000") as caught:
        read_plan("spiral-in", [setting + digits])
    assert len(str(caught.value)) < 150


def test_a_file_with_a_number_of_thousands_of_digits_is_refused() -> None:
    with pytest.raises(PlanError, match=r"x\.toml: a number has too many digits"):
        parsed(f"schema = {DIGITS}", "x.toml")


@pytest.mark.parametrize("text", ["[" * 9000, "{a=" * 9000])
def test_what_is_nested_too_deeply_is_refused(text: str) -> None:
    with pytest.raises(PlanError, match="nested too deeply"):
        parsed(f"a = {text}", "x.toml")
    with pytest.raises(PlanError, match="nested too deeply"):
        read_toml("turn", [f"route.pitch={text}"])


@pytest.mark.parametrize("path", [os.devnull, str(Path(__file__).parent)])
def test_what_is_no_regular_file_is_not_read(path: str) -> None:
    with pytest.raises(PlanError, match=f"{path} is no file that could be a plan"):
        read_toml(path)


def test_a_file_that_is_too_large_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.toml"
    path.write_text("a = 1" + " " * 3_000_000)
    assert read_toml(str(path))[0] == {"a": 1}
    monkeypatch.setattr(plan_text, "MOST_BYTES", 2_000_000)
    with pytest.raises(PlanError, match="too large for a plan: 3 MB, at most 2 MB are read"):
        read_toml(str(path))


def test_a_byte_order_mark_says_nothing(tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text("a = 1", encoding="utf-8-sig")
    assert read_toml(str(path))[0] == parsed("\ufeffa = 1", "x") == {"a": 1}


def test_whatever_the_reader_of_toml_says_is_said_in_our_words() -> None:
    source = inspect.getsource(inspect.getmodule(tomllib.loads))  # type: ignore[arg-type]
    raised = re.findall(r"suffixed_err\(\s*src,\s*\w+,\s*f?\"(.*?)\"\s*\)", source)
    assert len(raised) > 20
    for said in raised:
        text = re.sub(r"\{.*?\}", "('x',)", said.encode().decode("unicode_escape"))
        assert any(re.fullmatch(pattern, text) for pattern, _ours in TOML_FAULTS), said


@pytest.mark.parametrize("text", WRONG)
@pytest.mark.parametrize("language", ["en", "zh"])
def test_wrong_toml_is_told_with_its_place_in_both_languages(text: str, language: str) -> None:
    with spoken_in(language), pytest.raises(PlanError) as caught:
        parsed(text, "x.toml")
    said = str(caught.value)
    with pytest.raises(tomllib.TOMLDecodeError) as theirs:
        tomllib.loads(text)
    for number in re.findall(r"line (\d+), column (\d+)", str(theirs.value)):
        assert re.search(r"\D{}\D.*\D{}\D".format(*number), said)
    assert str(theirs.value).split(" (at ")[0] not in said
    assert "this cannot be read" not in said
    if language == "zh":
        assert not re.search(r"[a-z]{2,} [a-z]{2,}", said)


def test_a_table_that_is_there_twice_says_what_to_do_about_it() -> None:
    for name in ("people", "people.source"):
        with pytest.raises(PlanError) as caught:
            parsed(f'[{name}]\nunit = "qiao"\n[dragon]\nbenches = 3\n[{name}]\n', "x.toml")
        assert f"line 5, column {len(name) + 2}: [{name}] is defined twice: delete this line" in str(
            caught.value
        )
        assert f"below the first [{name}]" in str(caught.value)


def test_what_another_reader_of_toml_might_say_is_no_error() -> None:
    unknown = tomllib.TOMLDecodeError("Something new (at line 3, column 4)")
    assert toml_fault(unknown) == "line 3, column 4: this cannot be read"
    assert toml_fault(tomllib.TOMLDecodeError("")) == "at its end: this cannot be read"


@pytest.mark.parametrize(
    ("line", "column", "sign", "plain"),
    [
        ("name = “水井”", 8, "“", '"'),
        ('name = "水井”', 11, "”", '"'),
        ("centre = [13，8]", 13, "，", ","),
        ("centre = [13, 8】", 16, "】", "]"),
        ("radius＝0.6", 7, "＝", "="),
        ("【obstacle】", 1, "【", "["),
        ("radius = ０.6", 10, "０", "0"),
        ("radius = 0。6  # 一点", 11, "。", "."),
    ],
)
def test_a_sign_of_a_chinese_input_method_is_named_with_what_to_type_instead(
    line: str, column: int, sign: str, plain: str
) -> None:
    for text in (f'schema = 1\nname = "，“"  # ，\n{line}\n', f"schema = 1\n\n{line}"):
        with pytest.raises(PlanError) as caught, spoken_in("zh"):
            parsed(text, "village.dragon.toml")
        assert f"第 3 行第 {column} 列打的是「{sign}」，要改成英文的「{plain}」：" in str(caught.value)


def test_signs_in_texts_and_comments_are_left_alone() -> None:
    with pytest.raises(PlanError, match="line 1, column 15: something stands behind"):
        parsed('name = "，“水”" x  # ，', "plan")
    assert parsed('name = "，“水”"  # ，。', "plan") == {"name": "，“水”"}
