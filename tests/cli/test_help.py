"""Help is whole in both languages: no line of it is cut short, at whatever width."""

import shlex

import click
import pytest
from rich.cells import cell_len

from benchdragon.cli.help import translated
from benchdragon.cli.main import program, run
from tests.cli.verbs import VERBS


def squeezed(text: str) -> str:
    """A text without the places at which lines may break."""
    return "".join(text.split())


@pytest.mark.parametrize("columns", [60, 80])
@pytest.mark.parametrize("words", ["", *VERBS])
def test_no_line_of_help_is_cut_short(
    words: str,
    columns: int,
    spoken: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    assert run([*words.split(), "--help"]) == 0
    usage, _blank, *lines = capsys.readouterr().out.replace("[ARGS]...", "").splitlines()
    assert "..." not in usage + "".join(lines)
    assert "…" not in "".join(lines)
    assert all(cell_len(line) <= columns for line in lines)
    assert all(line.strip() or not line for line in lines)  # no line for the end of a sign alone
    shown, command = squeezed("".join(lines)), translated(program)
    for word in words.split():
        assert isinstance(command, click.Group)
        command = command.commands[word]
    texts = [command.help or "", *(getattr(option, "help", "") or "" for option in command.params)]
    if isinstance(command, click.Group):
        texts += [(verb.help or "").split("\n\n")[0] for verb in command.commands.values()]
    for text in texts:
        assert squeezed(text) in shown


@pytest.mark.parametrize("words", [words for words in VERBS if words != "solve"])
def test_each_verb_has_an_example_that_can_be_pasted_as_it_is_printed(
    words: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    assert run(["help", *words.split()]) == 0
    printed = capsys.readouterr().out.partition("\nExample:\n")[2]
    line = shlex.split(printed.replace("\\\n", "").removeprefix('  eval "$(').replace(')"', ""))
    verb = VERBS[words]
    assert line[: 1 + len(words.split())] == ["benchdragon", *words.split()]
    assert verb.make_context(words, line[1 + len(words.split()) :])


def test_the_list_of_verbs_holds_each_in_one_group() -> None:
    titled = [verb for verbs in program.titled.values() for verb in verbs]
    assert sorted(verb.name or "" for verb in titled) == sorted(program.commands)
