"""What strangers put in files: endless ones, numbers of a million digits, tables without end."""

import os
from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.errors import InputError
from benchdragon.plans.schema import checked
from benchdragon.plans.source import MOST_SIGNS, Fault
from benchdragon.plans.toml import (
    MOST_DEPTH,
    MOST_DIGITS,
    MOST_ENTRIES,
    MOST_KEYS,
    PlanError,
    lay_over,
    parsed,
    read_toml,
)
from benchdragon.sweeps.folder import ABOUT, read_about
from tests.hostile import children
from tests.hostile.children import PLAN_WRONG, asked

BASE = 'schema = 1\nbase = "turn"\n'
MANY = 1_000_000
KEYS = "".join(f"k{n} = 1\n" for n in range(100_000))
WRONG = {
    "digits": "[walk]\nspeed = " + "1" * MANY,
    "an exponent": "[walk]\nspeed = 1e" + "9" * MANY,
    "a hexadecimal speed": "[walk]\nspeed = 0x" + "f" * MANY,
    "hexadecimal benches": "[dragon]\nbenches = 0x" + "f" * MANY,
    "benches to the base 2": "[dragon]\nbenches = 0b" + "1" * MANY,
    "a text": "[walk]\nspeed = '" + "1" * MANY + "'",
    "a key": "[walk]\n" + "a" * MANY + " = 1",
    "lists": "x = " + "[" * 100_000,
    "tables in braces": "x = " + "{a=" * 100_000,
    "tables in a dotted key": "[walk]\n" + ".".join("a" * 100_000) + " = 1",
    "tables in a header": "[" + " . ".join("a" * 100_000) + "]\nb = 1",
    "tables under quoted keys": ".".join(["'a b'"] * 50_000 + ['"c\\"d"'] * 50_000) + " = 1",
    "some hundred tables": "[walk]\n" + ".".join("a" * 2_000) + " = 1",
    "signs of 0": "\0" * MANY,
    "quotes": "x = '" + "'" * MANY,
    "escaped quotes": 'x = """' + '\\"' * MANY,
    "ends of lines": "\n" * MANY + "x",
    "unknown keys": f"[walk]\n{KEYS}",
    "keys that mean nothing beside another": f"[dragon]\n{KEYS}[[dragon.bench]]\nlength = 2",
    "keys that mean nothing on the route": f'[route]\nkind = "spiral-in"\n[turn]\n{KEYS}',
    "unknown tables": "".join(f"[t{n}]\n" for n in range(100_000)),
    "more keys than are read": "a=1\n" * (MOST_KEYS + 1),
}


@pytest.mark.parametrize("kind", WRONG)
def test_a_plan_without_end_is_refused_in_a_sentence(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(children, "ENDLESS", 20)
    found = asked(BASE + WRONG[kind], "check PLAN --json", 0.01)
    assert (found.code, found.fault) == (PLAN_WRONG, "")


def test_tables_and_digits_up_to_the_limits_are_read() -> None:
    deep = ".".join("a" * MOST_DEPTH) + " = 1"
    parsed(f"{deep}\nx = 0x{'f' * (MOST_DIGITS - 1)}", "plan")
    for text in (f"a.{deep}", f'"a b". {deep}', f"['a\"'.{deep[:-4]}]", f"x = {{ a.{deep} }}"):
        with pytest.raises(PlanError, match=r"^plan is nested too deeply$"):
            parsed(text, "plan")
    for base in "box":
        with pytest.raises(PlanError, match=r"^plan: a number has too many digits$"):
            parsed(f"x = 0{base}{'1' * MOST_DIGITS}", "plan")


def test_a_setting_of_tables_without_end_is_refused() -> None:
    read_toml("turn", [".".join("a" * MOST_DEPTH) + "=1"])
    with pytest.raises(PlanError, match=r"^'a\.a.* is nested too deeply$"):
        read_toml("turn", [".".join("a" * (MOST_DEPTH + 1)) + "=1"])


@pytest.mark.parametrize(
    ("sign", "most"), [(sign, MOST_KEYS) for sign in "=[{"] + [(",", MOST_ENTRIES)]
)
def test_as_many_keys_as_are_read_are_not_too_many(sign: str, most: int) -> None:
    many = "#" + sign * (most - (sign == "="))
    less = many if sign in "=," else many[:-1]
    assert parsed(f"{less}\na = 1", "plan") == {"a": 1}
    with pytest.raises(PlanError, match=r"^plan is too long for a plan: at most 500000 keys and 1"):
        parsed(f"{many}{sign}\na = 1", "plan")


def test_a_name_with_a_dot_that_means_nothing_is_named_whole() -> None:
    data, _source = read_toml("turn", ["dragon.benches=3"])
    data["turn"]["a.b"] = 1
    lay_over(data, ["route.kind=spiral-in"])
    assert "turn" not in data or data["turn"] == {}
    with pytest.raises(PlanError, match=r"^plan: turn\.a\.b is not a known key"):
        checked({**data, "turn": {"a.b": 1}}, "plan")


def test_of_a_long_key_the_beginning_is_shown() -> None:
    key = "k" * (MOST_SIGNS + 1)
    for text in (f"{key} is not a known key", "is not known"):
        said = str(Fault(key, text))
        assert said.startswith("k" * MOST_SIGNS + "...")
        assert len(said) < MOST_SIGNS + 30
    assert str(Fault("k" * MOST_SIGNS, "no")) == "k" * MOST_SIGNS + ": no"


@pytest.mark.parametrize("made", [os.mkfifo, lambda path: path.symlink_to("/dev/zero")])
def test_what_has_no_end_is_no_plan_and_no_sweep(tmp_path: Path, made: object) -> None:
    path = tmp_path / ABOUT
    made(path)  # type: ignore[operator]
    assert run(["check", str(path), "--quiet"]) == PLAN_WRONG
    with pytest.raises(InputError, match=r"holds no sweep$"):
        read_about(tmp_path)


@pytest.mark.parametrize(
    "text",
    ["[" * 100_000, '{"points": ' + "1" * MANY + "}", "\0" * MANY],
    ids=["lists", "digits", "signs of 0"],
)
def test_what_tells_of_a_sweep_and_is_nested_without_end_is_none(tmp_path: Path, text: str) -> None:
    (tmp_path / ABOUT).write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=r"holds no sweep$"):
        read_about(tmp_path)


def test_a_file_of_a_gigabyte_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "a.dragon.toml"
    with path.open("wb") as file:
        file.truncate(1_000_000_000)
    with pytest.raises(PlanError, match=r"is too large for a plan: 1000 MB, at most 20 MB are read$"):
        read_toml(str(path))
