"""The verbs `help` and `completion`."""

import click
from click.shell_completion import get_completion_class

from benchdragon.cli.options import take, verb

SHELLS = ("bash", "zsh", "fish")
VARIABLE = "_BENCHDRAGON_COMPLETE"
# In bash, a key that is completed waits for its value; click's script puts a space behind all.
RETURN, NO_SPACE = "    return 0\n", "    [[ ${COMPREPLY[0]} == *= ]] && compopt -o nospace\n"


@verb("help solve pitch", name="help")
@click.argument("words", metavar="[VERB]", nargs=-1)
@take("lang")
def help_(words: tuple[str, ...]) -> int:
    """The help of a verb, as --help behind it."""
    root = click.get_current_context().find_root()
    root.command.main([*words, "--help"], prog_name=root.info_name, standalone_mode=False)
    return 0


@verb('eval "$(benchdragon completion bash)"')
@click.argument("shell", metavar="SHELL", type=click.Choice(SHELLS))
def completion(shell: str) -> int:
    """Print what makes a shell complete verbs, options, plans and keys.

    SHELL is bash, zsh or fish. The line below in ~/.bashrc, or with zsh in ~/.zshrc, does it for every
    new shell; in fish: benchdragon completion fish | source
    """
    kind = get_completion_class(shell)
    assert kind is not None
    made = kind(click.get_current_context().find_root().command, {}, "benchdragon", VARIABLE)
    click.echo(made.source_template.replace(RETURN, NO_SPACE + RETURN) % made.source_vars(), nl=False)
    return 0
