"""Help is whole in both languages: no line of it is cut short, at whatever width."""

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
