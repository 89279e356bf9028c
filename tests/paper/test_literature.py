"""The literature: each number right, led to by a mistake that was made, or said to be unexplained."""

import json

import pytest

from benchdragon.cli.main import run
from benchdragon.paper.grading import TASKS
from benchdragon.paper.literature import QUESTIONS, SOURCES, Claim, claims

UNEXPLAINED = {
    "contact": {"412.478", "566.2", "424.850097"},
    "pitch": {"0.4000", "0.445", "0.4243", "0.965235"},
    "turn-length": {"11.7915", "13.48", "13.6148"},
    "head-speed": {"0.9670", "1.244612", "0.773423", "1.58", "1.414214"},
}


@pytest.fixture(scope="module")
def judged() -> list[Claim]:
    return claims()


def _unit(said: str) -> float:
    """A unit of the last digit of a number, as it is printed."""
    return 10.0 ** -len(said.partition(".")[2])


def test_there_are_papers_and_programs_enough_and_each_can_be_found(judged: list[Claim]) -> None:
    assert len(SOURCES) >= 20
    assert len({source.who for source in SOURCES}) == len(SOURCES)
    assert all(source.where and source.said for source in SOURCES)
    assert {claim.task for claim in judged} == set(QUESTIONS)
    assert len(judged) == sum(len(source.said) for source in SOURCES)


def test_a_mistake_leads_to_the_number_to_the_digits_printed(judged: list[Claim]) -> None:
    """Of each claim the mistake that is named is made again, and what it gives compared."""
    made = {task: list(TASKS[task][1](TASKS[task][0]()[0])) for task in QUESTIONS}
    for claim in (one for one in judged if one.verdict == "mistake"):
        values = [value for value, text in made[claim.task] if text == claim.finding]
        off = min(abs(value - float(claim.said)) for value in values)
        assert off < max(_unit(claim.said), 5e-6 * claim.exact), (claim, values)
        assert abs(float(claim.said) - claim.exact) > 0.5 * _unit(claim.said)


def test_a_right_number_is_the_exact_one_to_its_digits_or_to_six_figures(judged: list[Claim]) -> None:
    for claim in (one for one in judged if one.verdict == "right"):
        assert abs(float(claim.said) - claim.exact) < max(_unit(claim.said), 5e-6 * claim.exact), claim


def test_what_is_unexplained_is_said(judged: list[Claim]) -> None:
    found: dict[str, set[str]] = {task: set() for task in QUESTIONS}
    for claim in (one for one in judged if one.verdict == "unexplained"):
        found[claim.task].add(claim.said)
        assert claim.finding.startswith("unexplained")
    assert found == UNEXPLAINED


@pytest.mark.parametrize(
    ("task", "said", "finding"),
    [
        ("contact", "412.473838", "right to its digits"),
        ("contact", "412.473894", "right to 6 figures"),
        ("contact", "413", "in steps of 1 s"),
        ("contact", "414.000000", "in steps of 2 s"),
        ("contact", "416", "in steps of 4 s"),
        ("contact", "412.6", "in steps of 0.2 s"),
        ("contact", "412.580327", "in steps of 0.1 rad of the head's angle"),
        ("pitch", "0.451", "rounded to the safe side"),
        ("pitch", "0.452", "in steps of 0.002 m"),
        ("pitch", "0.420217", "only when the head reaches the disc"),
        ("pitch", "0.417138", "only of the head's bench"),
        ("pitch", "0.448697", "only each 10 s"),
        ("pitch", "0.45033645", "only each 0.02 rad"),
        ("turn-length", "12.936", "with radii of 2 : 1"),
        ("turn-length", "8.443", "with radii of 1 : 1"),
        ("head-speed", "1.2462", "rounded to the safe side"),
        ("head-speed", "1.247010", "in steps of 0.1 s"),
        ("head-speed", "1.283843", "only handle 1"),
    ],
)
def test_numbers_are_judged_as_what_they_are(
    judged: list[Claim], task: str, said: str, finding: str
) -> None:
    found = [one.finding for one in judged if (one.task, one.said) == (task, said)]
    assert found
    assert all(finding in one for one in found)


def test_the_command_line_prints_all_of_it(
    judged: list[Claim], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["compare", "--literature", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["claims"]
    assert [row["finding"] for row in rows] == [one.finding for one in judged]
    assert rows[0]["command"] == "benchdragon compare pitch=0.452"
    assert run(["compare", "--literature"]) == 0
    printed = capsys.readouterr().out
    assert all(one.said in printed for one in judged)


def test_the_literature_stands_alone_and_nothing_to_compare_is_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for line in (["compare"], ["compare", "--literature", "pitch=0.45"]):
        assert run(line) == 2
        assert "FILE, TASK=NUMBER, or --literature" in capsys.readouterr().err
