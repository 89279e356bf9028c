"""How click's help is shown: in the language in use, Chinese signs in two columns, verbs in order."""

import copy
from collections.abc import Iterable
from inspect import cleandoc
from typing import Any
from unicodedata import east_asian_width

import click

from benchdragon.i18n import N_, _

PAD = "\0"
# What click calls the types of our options; `translated` puts them into the language in use.
TYPE_NAMES = (N_("float range"), N_("integer range"))


class WideFormatter(click.HelpFormatter):
    """Gives a Chinese sign the two columns that it takes; click would count one."""

    def write_text(self, text: str) -> None:
        """Write a paragraph."""
        super().write_text(_padded(text))

    def write_dl(
        self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2
    ) -> None:
        """Write terms and what they mean."""
        super().write_dl([(_padded(a), _padded(b)) for a, b in rows], col_max, col_spacing)

    def getvalue(self) -> str:
        """What was written."""
        return super().getvalue().replace(PAD, "")


def _padded(text: str) -> str:
    """`text` with a sign that is not printed behind each that takes two columns, but the last."""
    wide = "".join(sign + PAD * (east_asian_width(sign) in "WF") for sign in text)
    return wide.removesuffix(PAD)


class WideContext(click.Context):
    """Formats help as WideFormatter does."""

    formatter_class = WideFormatter


def paragraphs(said: str) -> str:
    """What a function says of itself, each paragraph in one line."""
    return "\n\n".join(" ".join(part.split()) for part in cleandoc(said).split("\n\n"))


class Verb(click.Command):
    """A command whose help is what its function says of itself, to be translated."""

    def __init__(self, *args: Any, **more: Any) -> None:
        super().__init__(*args, **more)
        self.help = paragraphs(self.help or "")


class HelpfulGroup(click.Group):
    """Verbs in the order they were written, and named where one is called that is not there."""

    command_class = Verb

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of the verbs."""
        del ctx
        return list(self.commands)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Name of the verb on the command line, the verb, and its arguments.

        Raises:
            click.UsageError: if there is no such verb.
        """
        try:
            return super().resolve_command(ctx, args)
        except click.NoSuchOption:
            raise
        except click.UsageError as error:
            known = _("Known: {names}.").format(names=", ".join(self.commands))
            raise click.UsageError(f"{error.format_message()} {known}", ctx) from None


def translated(command: click.Command) -> click.Command:
    """A copy of a command and all below it with its texts in the language in use."""
    spoken = copy.copy(command)
    if spoken.help:
        spoken.help = _(spoken.help)
        spoken.short_help = spoken.help.split("\n\n")[0]  # click would cut it short
    spoken.context_class = WideContext
    spoken.context_settings = {
        **spoken.context_settings,
        "max_content_width": 100,
        "show_default": True,
    }
    spoken.params = [copy.copy(parameter) for parameter in spoken.params]
    for parameter in spoken.params:
        parameter.type = copy.copy(parameter.type)
        parameter.type.name = _(parameter.type.name)
        if isinstance(parameter, click.Option) and parameter.help:
            parameter.help = _(parameter.help)
    if isinstance(spoken, click.Group):
        spoken.commands = {name: translated(verb) for name, verb in spoken.commands.items()}
    return spoken
