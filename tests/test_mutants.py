"""The tables of mutants hold: the places and the tests exist; and survivors are seen."""

import re
from pathlib import Path

import pytest
from tools import mutants as tool
from tools.mutants import Mutant, mutants

TESTS = Path(__file__).parent


@pytest.mark.parametrize("mutant", mutants(), ids=lambda mutant: f"{mutant.area}: {mutant.what}")
def test_every_mutant_breaks_one_place_and_names_tests_that_are_there(mutant: Mutant) -> None:
    text = (tool.PACKAGE / mutant.file).read_text("utf-8")
    broken = mutant.broken(text)
    assert broken != text
    if mutant.file.endswith(".py"):
        compile(broken, mutant.file, "exec")
    assert mutant.tests
    for test in mutant.tests:
        file, _, name = test.partition("::")
        name = re.escape(name.partition("[")[0])
        assert re.search(rf"^def {name}\b", (TESTS / file).read_text("utf-8"), re.MULTILINE), test
        # Kernels are broken uncompiled, which most other tests are too slow for.
        assert file.startswith("kernels/") or "::" in test or not mutant.plain


def test_no_two_mutants_have_one_name() -> None:
    names = [(mutant.area, mutant.what) for mutant in mutants()]
    assert len(set(names)) == len(names)


def test_a_place_must_stand_there_once() -> None:
    mutant = Mutant("", "twice", "model/answer.py", "a", "b", ())
    assert mutant.broken("a") == "b"
    for text in ("", "aa"):
        with pytest.raises(ValueError, match=f"stands {len(text)} times, not once"):
            mutant.broken(text)


def test_a_mutant_that_no_test_sees_is_told_of(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    test = ("test_errors.py::test_no_check_lets_an_infinite_number_pass",)
    old = "if not math.isfinite(number):"
    found = [
        Mutant("errors", "nothing is wrong", "errors.py", old, f"{old}  # as before", test),
        Mutant("errors", "infinite passes", "errors.py", old, "if False:", test),
    ]
    monkeypatch.setattr(tool, "mutants", lambda: found)
    assert tool.main([]) == 1
    assert capsys.readouterr().out.splitlines() == [
        "SURVIVED errors: nothing is wrong",
        "killed   errors: infinite passes",
        "1 of 2 killed",
    ]
    assert tool.main(["nothing of the kind"]) == 1
