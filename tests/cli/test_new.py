"""What `benchdragon new` asks in a terminal."""

import os
import pty
import re
import shlex
import subprocess
import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest

from benchdragon.analysis.check import check
from benchdragon.cli.main import run
from benchdragon.explain.proposal import proposal_lines
from benchdragon.plans.schema import read_plan
from benchdragon.solve.proposal import Proposal, propose
from benchdragon.solve.wishes import Wishes
from tests.cli.verbs import VERBS

END_OF_INPUT = "\x04"
# In the order of the questions: benches, length, width, head, holes, square, bearers, beside, speeds,
# sway, imprecision.
ANSWERS = ["4", "a lot", "1.5m", "15cm", "", "", "25x20", "", "2", "", "", "3cm", ""]


def asked(folder: Path, typed: str) -> tuple[int, str]:
    """The exit code and all that a terminal shows, in which that is typed."""
    ours, theirs = pty.openpty()
    line = [
        sys.executable,
        "-m",
        "benchdragon",
        "new",
        "-o",
        "v.dragon.toml",
        "--quiet",
        "--lang",
        "en",
    ]
    with subprocess.Popen(line, stdin=theirs, stdout=theirs, stderr=theirs, cwd=folder) as process:
        os.close(theirs)
        os.write(ours, typed.encode())
        shown = b""
        with suppress(OSError):  # so a terminal of Linux says that nobody writes there any more
            while piece := os.read(ours, 65_536):
                shown += piece
    os.close(ours)
    return process.returncode, shown.decode()


def test_questions_are_asked_until_they_are_answered_and_the_plan_is_written(tmp_path: Path) -> None:
    code, shown = asked(tmp_path, "".join(f"{answer}\n" for answer in ANSWERS))
    assert code == 0, shown
    assert "not 'a lot'" in shown
    assert "Ctrl-C leaves" in shown
    summary = shown[shown.index("Your answers:") : shown.index("Proposed:")]
    assert "Benches: 4" in summary
    assert "The square: 25 m by 20 m" in summary
    assert "Where they walk: under" in summary
    assert shown.count("How long is a bench") == 2
    plan = read_plan(str(tmp_path / "v.dragon.toml"))
    assert plan.value("dragon.benches") == 4
    assert plan.value("dragon.body_length") == 1.5
    assert plan.venue.rectangle == (25.0, 20.0)
    assert (plan.people.sway, plan.people.imprecision) == (0.03, 0.1)
    assert plan.people.source.sway == "measured by the troupe"
    assert plan.people.source.imprecision == "", "nobody measured it"
    assert "people.sway 0.03 m (measured by the troupe)" in shown
    assert "people.imprecision 0.1 m (assumption)" in shown
    assert shown.index("Proposed:") < shown.index("SAFE")
    assert "Length of a bench: expected a length from 1 cm to 20 m, such as 1.5" in shown


@pytest.mark.parametrize("typed", [END_OF_INPUT, "4\n" + END_OF_INPUT])
def test_where_input_ends_nothing_is_written(tmp_path: Path, typed: str) -> None:
    code, shown = asked(tmp_path, typed)
    assert code != 0
    assert "Traceback" not in shown
    assert list(tmp_path.iterdir()) == []


SHORT_LINE = (
    "new -o v.dragon.toml --benches 24 --bench-length 1.5 --bench-width 15cm --square 13x13 "
    "--carry under --kind spiral-in"
)


def test_what_is_proposed_is_told_and_each_number_that_nobody_gave_is_marked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    line = "new -o v.dragon.toml --benches 9 --bench-length 1.5m --bench-width 15cm --square 20x20"
    assert run([*line.split(), "--carry", "under", "--quiet", "--lang", "en"]) == 0
    told = capsys.readouterr().out
    assert "in, round, and out again" in told
    assert "WARNING" not in told
    text = (tmp_path / "v.dragon.toml").read_text("utf-8")
    assert "assumed" in text.splitlines()[0]
    numbers = re.findall(r"^(\w+) = [-\[]*[0-9][^#]*(.*)$", text, re.MULTILINE)
    marks = {key: note.endswith(("(assumed)", "(proposed)")) for key, note in numbers}
    given = {"benches", "width", "body_length", "rectangle", "schema"}
    assert {key for key, marked in marks.items() if not marked} == given
    assert marks["head_length"]


def test_a_dance_that_is_soon_over_is_proposed_with_a_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run([*SHORT_LINE.split(), "--quiet", "--lang", "en"]) == 0
    told = capsys.readouterr().out
    assert "hardly a dance. It gets longer with fewer benches, or a larger square." in told
    assert "it does not come out again" in told


def test_a_dance_that_ends_before_its_tail_is_out_is_printed_with_a_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = 'schema = 1\n[dragon]\nbenches = 5\n[route]\nkind = "turn"\n[walk]\nstart = -5\nend = 9\n'
    Path("v.dragon.toml").write_text(text, "utf-8")
    assert run(["check", "v.dragon.toml", "--quiet", "--lang", "en"]) == 0
    told = re.search(r"WARNING: the dance ends .* let the walk end at (\S+) s", capsys.readouterr().out)
    assert told is not None
    again = ["check", "v.dragon.toml", "--set", f"walk.end={told[1]}", "--quiet", "--lang", "en"]
    assert run(again) == 0
    assert "WARNING" not in capsys.readouterr().out


def test_how_many_benches_come_out_again_is_told_where_all_of_them_do_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    line = SHORT_LINE.replace(" --kind spiral-in", "").replace("13x13", "12.5x12.5")
    assert run([*line.split(), "--quiet", "--lang", "en"]) == 0
    told = re.search(r"With (\d+) benches it comes out again", capsys.readouterr().out)
    assert told is not None
    wished = Wishes(24, 1.5, 0.15, rectangle=(12.5, 12.5), carry="under")
    kinds = []
    for count in (int(told[1]), int(told[1]) + 1):
        found = propose(replace(wished, benches=count))
        assert isinstance(found, Proposal)
        kinds.append(found.plan.route.kind)
    assert kinds == ["turn", "spiral-in"]


def test_what_does_not_fit_is_asked_again_alone_and_the_other_answers_stay(tmp_path: Path) -> None:
    first = ["24", "1.5m", "15cm", "2", "", "12x12", "", "beside", "", "", "", ""]
    # Under the benches, as is proposed; the number that fits; the square, which was mistyped.
    for n, (again, carried, most) in enumerate(
        (("\n\n", "under", 24), ("0\nx\n13\n2\n\n", "beside", 23), ("3\n22x22\n", "beside", 24))
    ):
        folder = tmp_path / str(n)
        folder.mkdir()
        code, shown = asked(folder, "".join(f"{answer}\n" for answer in first) + again + END_OF_INPUT)
        assert code == 0, shown
        assert "do not fit" in shown
        assert shown.count("expected 1 to 12, not ") == (2 if n == 1 else 0)
        assert shown.count("expected a whole number such as 1, not 'x'") == (1 if n == 1 else 0)
        assert shown.count("How long is a bench") == 1
        menu = shown[shown.index("Which one do you change?") :]
        assert re.search(r"\d  The square: 12 m by 12 m", menu)
        assert re.search(r"\d  Benches: 24", menu)
        text = (folder / "v.dragon.toml").read_text("utf-8")
        assert f"they walk {carried}" in text
        benches = read_plan(str(folder / "v.dragon.toml")).value("dragon.benches")
        assert benches == most if n == 2 else 2 <= benches <= most


def test_a_square_without_the_ground_for_the_benches_is_asked_again(tmp_path: Path) -> None:
    first = ["24", "1.5m", "15cm", "2", "", "1x1", "", "beside", "", "", "", ""]
    again = "\n22x22\n" + END_OF_INPUT
    code, shown = asked(tmp_path, "".join(f"{answer}\n" for answer in first) + again)
    assert code == 0, shown
    assert "24 benches do not fit on this square, however they dance" in shown
    assert shown.count("Proposed:") == 1


def test_a_refusal_names_walking_under_the_benches_where_that_fits(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    beside = SHORT_LINE.replace("--carry under ", "").replace("13x13", "12x12")
    assert run([*beside.split(), "--quiet", "--lang", "en"]) == 4
    assert "if their bearers walk under them" in capsys.readouterr().err
    assert run([*beside.replace("12x12", "4x4").split(), "--quiet", "--lang", "en"]) == 4
    assert "walk under them" not in capsys.readouterr().err


def test_a_radius_may_be_told_as_the_question_shows_it_and_names_are_quoted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    line = ["--benches", "4", "--bench-length", "1.5m", "--bench-width", "15cm", "--radius", "r14"]
    assert run(["new", "-o", "n $m.dragon.toml", *line, "--carry", "under", "--quiet"]) == 0
    out = capsys.readouterr().out
    assert "benchdragon view 'n $m.dragon.toml' -o 'n $m.html'" in out
    following = out[out.index("Next:") :].splitlines()[1:]
    for words in (shlex.split(line, comments=True) for line in following):
        assert VERBS[words[1]].make_context(words[1], words[2:])
    assert run(["new", "-o", "o.dragon.toml", *line[:-1], "wide", "--quiet"]) == 2
    assert "--radius: expected a length" in capsys.readouterr().err


def test_what_was_written_into_a_plan_by_hand_is_named_when_it_is_proposed_anew(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    line = [*SHORT_LINE.split(), "--quiet", "--lang", "en", "--force"]
    plan = tmp_path / line[line.index("-o") + 1]
    assert run(line) == 0
    well = '[[obstacle]]\nkind = "circle"\nname = "well"\ncentre = [30, 30]\nradius = 0.6\n'
    counted = '[people]\nroster = "names.csv"\nunit = "qiao"\ncount_head = false'
    text = plan.read_text("utf-8").replace("[people]", counted)
    plan.write_text(f"{text}\n{well}[chalk]\nstray = 0.2\n", "utf-8")
    capsys.readouterr()
    assert run(line) == 0
    wanted = "not in the new plan, as they were in the one it replaces: "
    named = 'people.roster = "names.csv", people.unit = "qiao", people.count_head = false'
    assert f"{wanted}[[obstacle]] well, [chalk], {named}." in capsys.readouterr().err
    assert run(line) == 0
    assert wanted not in capsys.readouterr().err
    plan.write_text("no plan at all", "utf-8")
    assert run(line) == 0


@pytest.mark.parametrize(
    ("start", "told"), [(-5.0, "in, round, and out again"), (0.0, "stands inside")]
)
def test_a_dance_that_begins_at_its_turn_is_not_said_to_go_in(start: float, told: str) -> None:
    plan = read_plan("turn", ["dragon.benches=10", f"walk.start={start}", "walk.end=30"])
    lines = proposal_lines(Proposal(plan, check(plan), slower=False), Wishes(10, 2.2, 0.3), 0)
    assert [line for line in lines if told in line] == [
        line for line in lines if "The head walks" in line
    ]
    assert any(told in line for line in lines)


def test_a_dance_is_proposed_beside_what_stands_on_the_square_of_a_plan(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    line = "new -o v.dragon.toml --benches 9 --bench-length 1.5m --bench-width 15cm --square 17x16"
    words = [*line.split(), "--carry", "under", "--quiet", "--lang", "en"]
    assert run(words) == 0
    plan = tmp_path / "v.dragon.toml"
    first = read_plan(str(plan))
    x, y = first.route.at or (0.0, 0.0)
    well = f'[[obstacle]]\nkind = "circle"\nname = "well"\ncentre = [{x}, {y}]\nradius = 0.6\n'
    plan.write_text(plan.read_text("utf-8") + well, "utf-8")
    assert not check(read_plan(str(plan))).safe
    assert run([*words, "--force", "--beside", "v.dragon.toml"]) == 0
    told = capsys.readouterr()
    assert "All 9 benches fit." in told.out
    assert "not in the new plan" not in told.err
    again = read_plan(str(plan))
    assert [one.name for one in again.obstacles()] == ["venue", "well"]
    assert check(again).safe
    assert run([*words, "--force", "--beside", "none.dragon.toml"]) == 3


def test_the_street_of_a_plan_is_kept_and_said_to_be_missing_where_it_is_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    line = "new -o v.dragon.toml --benches 9 --bench-length 1.5m --bench-width 15cm --square 20x20"
    words = [*line.split(), "--carry", "under", "--quiet", "--lang", "en"]
    assert run(words) == 0
    plan = tmp_path / "v.dragon.toml"
    with plan.open("a", encoding="utf-8") as file:
        file.write("[route.street]\npoints = [[-40, 0], [-20, 2], [-8, 5]]\n")
    assert run([*words, "--force", "--beside", "v.dragon.toml"]) == 0
    told = capsys.readouterr()
    assert "It comes by the street, which stays as it was." in told.out
    assert "not in the new plan" not in told.err
    again = read_plan(str(plan))
    assert again.data()["route"]["street"]["points"][0] == [-40, 0]
    assert check(again).safe
    assert run([*words, "--force"]) == 0
    assert "not in the new plan, as they were in the one it replaces: [route.street]" in (
        capsys.readouterr().err
    )


def test_rounds_are_kept_where_they_fit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    line = "new -o v.dragon.toml --benches 6 --bench-length 1.5m --bench-width 15cm --carry under"
    words = [*line.split(), "--quiet", "--lang", "en", "--force"]
    assert run([*words, "--square", "20x20", "--rounds", "三"]) == 0
    assert "It coils in and out 3 times." in capsys.readouterr().out
    plan = read_plan("v.dragon.toml")
    assert plan.value("route.rounds") == 3
    # What is proposed beside it has its rounds, unless others are wished, or none fit.
    beside = [*words, "--beside", "v.dragon.toml"]
    assert run([*beside, "--square", "21x20"]) == 0
    assert read_plan("v.dragon.toml").value("route.rounds") == 3
    assert run([*beside, "--square", "11x10"]) == 0
    assert "No dance of 3 rounds was found that fits: it coils once." in capsys.readouterr().out
    assert "rounds" not in read_plan("v.dragon.toml").own()["route"]
    for said, told in (
        ("0", "expected 1 to 20, not '0'"),
        ("two", "expected a whole number such as 3"),
    ):
        assert run([*words, "--square", "20x20", "--rounds", said]) == 2
        assert f"--rounds: {told}" in capsys.readouterr().err
    assert run([*words, "--square", "20x20", "--rounds", "2", "--kind", "spiral-in"]) == 2
