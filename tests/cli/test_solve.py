"""The questions of `solve`: each has its own options, and no other's."""

import json
import re

import click
import pytest
from rich.cells import cell_len

from benchdragon.cli.main import run
from benchdragon.cli.solve import solve
from benchdragon.i18n import _
from benchdragon.model.numbering import handle_text
from benchdragon.solve.size_family import QUESTIONS
from tests.cli.verbs import VERBS, options

ALL = {"--set", "--json", "--explain", "--lang", "--quiet"}
WRITTEN = {"--output", "--certificate", "--force"}
SIZE = ALL | WRITTEN | {"--range", "--count", "--prove", "--brackets"}
OPTIONS = {
    "pitch": SIZE | {"--method", "--pitch-step", "--time-step"},
    "disc": SIZE,
    "width": SIZE,
    "length": SIZE,
    "speed": ALL | WRITTEN | {"--brackets", "--pace", "--prove"},
    "turn": ALL
    | WRITTEN
    | {"--objective", "--least-radius", "--longest", "--longest-way"}
    | {"--prove", "--within", "--boxes"},
    "place": ALL - {"--explain"} | {"--brackets", "--output", "--force"},
    "square": ALL - {"--explain"} | {"--error"},
}
STRAYS = [
    (question, option)
    for question, own in OPTIONS.items()
    for option in sorted(set().union(*OPTIONS.values()) - own)
]


def ran(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Exit code and both streams of a command line of `solve`."""
    code = run(["solve", *words])
    out, err = capsys.readouterr()
    return code, out, err


def test_each_question_about_a_size_can_be_asked() -> None:
    assert list(OPTIONS) == list(solve.commands)
    assert list(QUESTIONS) == [name for name, own in OPTIONS.items() if own >= SIZE]
    assert len(STRAYS) == 95


@pytest.mark.parametrize("question", OPTIONS)
def test_a_question_shows_its_own_options_alone(
    capsys: pytest.CaptureFixture[str], spoken: str, question: str
) -> None:
    code, out, err = ran(capsys, question, "--help")
    assert (code, err) == (0, "")
    assert set(re.findall(r"^  (?:-\w, )?(--[\w-]+)", out, re.MULTILINE)) == OPTIONS[question] | {
        "--help"
    }
    assert set(options(VERBS[f"solve {question}"])) == OPTIONS[question]
    assert _(solve.commands[question].help or "").split("\n\n")[0] in out


def test_the_questions_are_listed_with_a_line_each(
    capsys: pytest.CaptureFixture[str], spoken: str
) -> None:
    code, out, err = ran(capsys, "--help")
    listed = out.split(_("Commands"))[1].splitlines()[1:]
    assert (code, err) == (0, "")
    assert [line.split(maxsplit=1) for line in listed] == [
        [name, _(question.help or "").split("\n\n")[0]] for name, question in solve.commands.items()
    ]
    assert max(map(cell_len, listed)) < 80


def test_without_a_question_the_help_is_shown_as_for_wrong_usage(
    capsys: pytest.CaptureFixture[str], spoken: str
) -> None:
    _code, shown, _err = ran(capsys, "--help")
    assert ran(capsys) == (2, "", shown)


KNOWN = "pitch, disc, width, length, speed, turn, place, square"


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        (["helix", "turn"], ""),
        ([""], ""),
        (["pitches"], "pitch"),
        (["PITCH", "turn", "--json"], "pitch"),
    ],
)
def test_an_unknown_question_is_refused_with_what_it_may_have_meant_or_the_known_ones(
    capsys: pytest.CaptureFixture[str], spoken: str, words: list[str], meant: str
) -> None:
    code, out, err = ran(capsys, *words)
    assert (code, out) == (2, "")
    hint = _("; did you mean {name}?").format(name=meant) if meant else ""
    hint = hint or _("; known: {names}").format(names=KNOWN)
    assert _("there is no command {name}").format(name=words[0]) + hint in err
    assert "Traceback" not in err


@pytest.mark.parametrize(("question", "option"), STRAYS)
def test_an_option_of_other_questions_is_refused(
    capsys: pytest.CaptureFixture[str], spoken: str, question: str, option: str
) -> None:
    for words in (
        [question, "turn", option],
        [question, option, "turn"],
        [question, f"{option}=1", "turn"],
    ):
        code, out, err = ran(capsys, *words)
        assert (code, out) == (2, "")
        assert _("there is no option {name}").format(name=option) in err
        assert err.count(f"benchdragon solve {question} --help") == 1
        assert "Traceback" not in err


@pytest.mark.parametrize("question", OPTIONS)
def test_options_are_not_asked_before_the_question(
    capsys: pytest.CaptureFixture[str], question: str
) -> None:
    code, out, err = ran(capsys, "--json", question, "turn")
    assert (code, out) == (2, "")
    assert "there is no option --json (benchdragon solve --help)" in err


def test_the_plan_may_stand_before_and_after_options(capsys: pytest.CaptureFixture[str]) -> None:
    settings = ["--set", "dragon.benches=3", "--set", "walk.start=0", "--set", "walk.end=3"]
    asked = ["speed", "turn", *settings]
    first = ran(capsys, *asked)
    assert first[0] == 0
    assert ran(capsys, "speed", *settings, "turn") == first
    assert ran(capsys, "speed", *settings[:2], "turn", *settings[2:]) == first


def test_the_language_may_be_asked_before_the_question() -> None:
    assert isinstance(solve, click.Group)
    assert list(options(solve)) == ["--lang"]
    assert run(["solve", "--lang", "en", "pitch", "--help"]) == 0


def test_the_fastest_handle_has_one_name_wherever_it_is_told(
    capsys: pytest.CaptureFixture[str], spoken: str
) -> None:
    """Handles 3 to 7 stand on one arc and are equally fast: the first of them is named."""
    turn = ["turn", "--set", "dragon.benches=30", "--quiet"]
    name = handle_text(3, 30)
    _code, shown, _err = ran(capsys, "speed", *turn, "--explain")
    assert len(re.findall(re.escape(name), shown)) == 2  # beside the answer, and step by step
    _code, told, _err = ran(capsys, "speed", *turn, "--json")
    assert json.loads(told)["witness"]["handle"] == 3
    assert json.loads(told)["witness"]["benches"] == [4]
    assert run(["check", *turn, "--set", "limits.speed=1.5", "--explain"]) == 1
    assert len(re.findall(re.escape(name), capsys.readouterr().out)) == 3  # and as a finding
    assert run(["check", *turn, "--json"]) == 0
    witness = json.loads(capsys.readouterr().out)["greatest_speed"]["witness"]
    assert (witness["handle"], witness["benches"]) == (3, [4])
