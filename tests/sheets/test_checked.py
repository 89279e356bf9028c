"""Papers are made of a plan as it was checked."""

from dataclasses import replace
from pathlib import Path

import pytest

from benchdragon.analysis.check import check
from benchdragon.cli.main import run
from benchdragon.errors import InputError
from benchdragon.plans.schema import read_plan
from benchdragon.rosters.roster import Person, Roster
from benchdragon.sheets.checked import foundation, read_record, record_check, record_path
from tests.sheets.village import PLAN, ROSTER, village

ADVICE = "run benchdragon check {plan} --record, or sheets with --check"


def papers(path: Path, *options: str) -> list[str]:
    return ["sheets", str(path), "-o", str(path.parent / "out"), "--only", "overview", *options]


def test_a_plan_that_was_never_recorded_has_no_papers(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = village(tmp_path)
    assert run(papers(path)) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert ADVICE.format(plan=path) in said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("end = 12", "end = 11"),
        ('title_zh = "我们的舞龙"', 'title_zh = "舞龙"'),
        ('unit = "qiao"', 'unit = "jie"'),
        ('address = "https://dragon.test/ours"', 'address = "https://dragon.test/other"'),
    ],
)
def test_papers_are_refused_in_a_sentence_once_the_plan_has_changed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str
) -> None:
    path = village(tmp_path)
    assert run(["check", str(path), "--record"]) == 0
    assert run(papers(path)) == 0
    assert (tmp_path / "out" / "overview.pdf").read_bytes().startswith(b"%PDF")
    village(tmp_path, PLAN.replace(old, new))
    capsys.readouterr()
    assert run(papers(path, "--force")) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "has changed since it was checked on 20" in said
    assert ADVICE.format(plan=path) in said
    assert run(papers(path, "--check", "--force")) == 0
    assert run(papers(path, "--force")) == 0


def test_another_person_is_another_foundation(tmp_path: Path) -> None:
    plan = read_plan(str(village(tmp_path)))
    path = record_path(str(village(tmp_path)))
    record_check(path, check(plan), ROSTER)
    assert read_record(path, plan, ROSTER, "ours").sha256 == foundation(plan, ROSTER)
    others = [
        Roster(),
        Roster({**ROSTER.benches, 7: (Person("钱七"),)}),
        Roster({**ROSTER.benches, 6: (replace(ROSTER.benches[6][0], phone="1"),)}),
    ]
    for other in others:
        with pytest.raises(InputError, match="its list of names, has changed since"):
            read_record(path, plan, other, "ours")
    assert foundation(plan, Roster(ROSTER.benches, ("another note",))) == foundation(plan, ROSTER)


def test_a_plan_that_is_not_safe_is_not_recorded(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = village(tmp_path)
    record = tmp_path / "ours.checked.json"
    unsafe = ["--set", "limits.speed=0.1"]
    assert run(["check", str(path), "--record", *unsafe]) == 1
    assert "not recorded" in capsys.readouterr().err
    assert not record.exists()
    assert run(["check", str(path), "--record"]) == 0
    before = record.read_bytes()
    assert run(["check", str(path), "--record", *unsafe]) == 1
    assert "was left as it is" in capsys.readouterr().err
    assert record.read_bytes() == before
    assert run(papers(path, "--check", *unsafe)) == 1
    assert record.read_bytes() == before
    assert not (tmp_path / "out" / "overview.pdf").exists()


def test_a_built_in_plan_has_no_place_for_a_record(capsys: pytest.CaptureFixture[str]) -> None:
    for line in (["check", "turn", "--record"], ["sheets", "turn"]):
        assert run(line) == 2
        said = capsys.readouterr().err
        assert said.count("\n") == 1
        assert "benchdragon plan turn -o my.dragon.toml" in said


@pytest.mark.parametrize("text", ["", "{", "[]", '{"sha256": "x"}', "\0" * 9])
def test_what_is_no_record_is_named(tmp_path: Path, text: str) -> None:
    path = village(tmp_path)
    record = record_path(str(path))
    record.write_text(text, "utf-8")
    with pytest.raises(InputError, match=r"ours\.checked\.json is no record of a check: run"):
        read_record(record, read_plan(str(path)), ROSTER, str(path))


def test_papers_are_refused_once_the_list_of_names_has_changed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = village(tmp_path, PLAN + 'roster = "names.csv"\n')
    names = tmp_path / "names.csv"
    names.write_text("桥,姓名\n龙头,张三\n1,李四\n", "utf-8")
    assert run(["check", str(path), "--record"]) == 0
    assert run(papers(path)) == 0
    names.write_text("桥,姓名\n龙头,张三\n1,王五\n", "utf-8")
    assert run(papers(path, "--force")) == 2
    assert "its list of names, has changed since" in capsys.readouterr().err
