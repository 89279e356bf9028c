"""All verbs of the command line, the questions of `solve` among them."""

from collections.abc import Iterator

import click

from benchdragon.cli.main import program


def verbs(group: click.Group, *words: str) -> Iterator[tuple[tuple[str, ...], click.Command]]:
    """What is typed to call each verb of a group, and the verb; a group comes before its own."""
    for name, verb in group.commands.items():
        yield (*words, name), verb
        if isinstance(verb, click.Group):
            yield from verbs(verb, *words, name)


VERBS = {" ".join(words): verb for words, verb in verbs(program)}


def options(verb: click.Command) -> dict[str, click.Option]:
    """The options of a verb by their long names."""
    return {
        max(option.opts, key=len): option for option in verb.params if isinstance(option, click.Option)
    }
