"""Some strangers' plans: only our own errors, no end of work or memory, no NaN under a good status."""

import random
from pathlib import Path

import pytest

from benchdragon.cli.main import run
from tests.hostile import children
from tests.hostile.children import GOOD, NOT_SAFE, QUESTIONS, UNDECIDED, Outcome, asked, tried
from tests.hostile.plans import hostile, rounds, toml
from tests.planner.random_plans import Tables

# A hundredth of a budget: a second, where a whole one is a minute.
SHARE = 0.01


@pytest.mark.parametrize("question", QUESTIONS)
def test_a_sound_plan_is_answered(question: str) -> None:
    found = asked(GOOD, question, 1.0)
    assert (found.fault, found.over) == ("", False)
    assert found.code is not None
    assert found.code <= NOT_SAFE


@pytest.mark.parametrize("first", range(0, 150, 30))
def test_strangers_plans_do_no_harm(first: int) -> None:
    found = list(tried(range(first, first + 30), hostile, SHARE))
    assert {f"{seed}: {question}": each.fault for seed, question, each in found if each.fault} == {}
    codes = {each.code for _seed, _question, each in found}
    assert {0, 3} <= codes


@pytest.mark.parametrize("first", range(0, 40, 20))
def test_rounds_get_a_verdict(first: int) -> None:
    """Each of them is walked by a sound dragon: nothing but contact may stay open, or take too long."""
    outcomes = [asked(toml(going_round(seed)), QUESTIONS[0], 1.0) for seed in range(first, first + 20)]
    assert [each.fault for each in outcomes if each.fault] == []
    assert [seed for seed, each in enumerate(outcomes, first) if each.over] == []
    assert {each.code for each in outcomes} <= {0, 1}
    assert max(each.seconds for each in outcomes) < 60.0


def going_round(seed: int) -> Tables:
    """A plan of a sound dragon that goes round and round."""
    dice = random.Random(seed)
    return {"schema": 1, "dragon": {"benches": dice.randrange(3, 30)}, "route": rounds(dice)}


def test_what_takes_too_much_is_told() -> None:
    found = asked('base = "turn"\nschema = 1\n', QUESTIONS[0], 1e-6)
    assert (found.code, found.over, found.fault) == (UNDECIDED, True, "")


def test_a_process_that_is_killed_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(children, "ENDLESS", 1)
    monkeypatch.setattr(children, "run", _endless)
    found = asked(GOOD, QUESTIONS[0], 1.0)
    assert found.fault == "killed: SIGXCPU"


def _endless(_words: list[str]) -> int:
    while True:
        pass


@pytest.mark.parametrize(("taken", "fault"), [(150, False), (350, True)])
def test_memory_beyond_what_is_stated_is_a_fault_whatever_was_held_before(
    monkeypatch: pytest.MonkeyPatch, taken: int, fault: bool
) -> None:
    monkeypatch.setattr(children, "BESIDE", 250_000_000)
    monkeypatch.setattr(children, "run", lambda _words: len(b"1" * (taken * 1_000_000)) and 0)
    held_before = b"1" * 300_000_000
    found: Outcome = asked(GOOD, QUESTIONS[0], 1e-3)
    del held_before
    assert ("are stated" in found.fault) == fault


@pytest.mark.parametrize(
    ("code", "out", "err", "fault"),
    [
        (0, '{"value": NaN}', "", "no JSON: NaN"),
        (0, '{"a": [{"status": "found", "value": null}]}', "", "found without a value"),
        (0, '{"a": [{"status": "undecided", "value": null}]}', "", ""),
        (0, '{"clearance": {"status": "found", "value": null, "upper": null}}', "", ""),
        (
            0,
            '{"clearance": {"status": "found", "value": null, "upper": 1}}',
            "",
            "found without a value",
        ),
        (
            0,
            '{"speed": {"status": "found", "value": null, "upper": null}}',
            "",
            "found without a value",
        ),
        (70, "", "Traceback", "exit 70: Traceback"),
        (6, "", "memory ran out", "exit 6: memory ran out"),
        (3, "", "", "exit 3 without a word"),
    ],
)
def test_what_does_harm_is_seen(code: int, out: str, err: str, fault: str) -> None:
    assert children.fault_of(code, out, err) == fault


@pytest.mark.parametrize("sign", ["1", "1m", "-"])
def test_a_very_long_number_holds_nobody_up(tmp_path: Path, sign: str) -> None:
    path = tmp_path / "a.dragon.toml"
    path.write_text(
        f'base = "turn"\nschema = 1\n[walk]\nspeed = "{sign * 1_000_000}"\n', encoding="utf-8"
    )
    assert run(["plan", str(path)]) == 3
