"""Mutants that a tool makes: which are tried, with which tests, and that reasons for survivors hold."""

from pathlib import Path

import pytest
from tools import mutants, mutation
from tools.mutation import Change, changed, chosen, fitting, main, reasons, shape

TESTS = Path(__file__).parent
PLAIN = "def f(a, b):\n    if a < b:\n        return a\n    return -b\n"


def test_each_survivor_with_a_reason_is_still_made_of_a_line_that_stands() -> None:
    for change, why in reasons().items():
        lines = (mutants.PACKAGE / change.file).read_text("utf-8").splitlines()
        assert change.old in [line.strip() for line in lines], change
        assert change.old != change.new
        assert why.endswith(".")
        if change.where:
            assert any(f" {change.where}(" in line or f" {change.where}:" in line for line in lines)


def test_tests_are_found_by_name_by_the_table_and_by_rows() -> None:
    found = fitting("proofs/cells.py")
    assert found[0] == "proofs/test_cells.py"
    assert len(set(found)) == len(found)
    assert fitting("kernels/separation_bounds.py") == ["kernels/test_motion_bounds.py"]
    assert fitting("nowhere/none.py") == []
    for module in chosen([]):
        for test in fitting(module):
            assert (TESTS / test.partition("::")[0]).exists()


def test_what_is_tried_without_words_are_kernels_proofs_certificates_and_verdict() -> None:
    found = chosen([])
    assert {one.partition("/")[0] for one in found} == {"analysis", "proofs", "kernels"}
    assert found[: len(mutation.VERDICT)] == list(mutation.VERDICT)
    assert chosen(["proofs/cells.py"]) == ["proofs/cells.py"]
    assert main(["proofs/none.py"]) == 2


@pytest.mark.parametrize(
    "same",
    [
        PLAIN.replace("(a, b)", "(a: int, b: int | None) -> int"),
        PLAIN.replace("(a, b)", "(a, *, b)"),
        PLAIN.replace("a < b", "not a >= b"),
        f"@what\n{PLAIN}",
        PLAIN.replace("return a", "return  a  # so"),
    ],
)
def test_what_runs_alike_is_tried_once(same: str) -> None:
    assert shape(same) == shape(PLAIN)


@pytest.mark.parametrize(("old", "new"), [("a < b", "a <= b"), ("-b", "b"), ("a < b", "not a < b")])
def test_what_runs_otherwise_is_tried(old: str, new: str) -> None:
    assert shape(PLAIN.replace(old, new)) not in (None, shape(PLAIN))
    assert shape("def f(/a): pass") is None


def test_a_change_is_told_by_its_lines() -> None:
    assert changed(PLAIN, PLAIN.replace("-b", "b")) == ("return -b", "return b")
    assert changed(PLAIN, PLAIN) == ("", "")


def test_a_module_is_tried_and_a_run_goes_on_where_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("cosmic_ray", reason="`make mutation` installs it")
    monkeypatch.setattr(mutation, "SESSIONS", tmp_path)
    tests = ["test_errors.py::test_no_check_lets_an_infinite_number_pass"]
    monkeypatch.setattr(mutation, "fitting", lambda _module: tests)
    assert main(["errors.py"]) == 1
    said = capsys.readouterr()
    assert "killed: if not math.isfinite(number): -> if not not math.isfinite(number):" in said.err
    assert "survived" in said.err
    assert said.out == (tmp_path / "report.md").read_text("utf-8") + "\n"
    alive = [change for change, survives, _said in mutation.found_in("errors.py") if survives]
    assert all(isinstance(one, Change) and f"`{one.old}` -> `{one.new}`" in said.out for one in alive)
    monkeypatch.setattr(mutation, "reasons", lambda: dict.fromkeys(alive, "They say so."))
    assert main(["errors.py"]) == 0  # nothing is left to try
    assert capsys.readouterr().err == ""
