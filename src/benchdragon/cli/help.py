"""How click's help is shown: in the language in use, Chinese signs in two columns, verbs in groups."""

import copy
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from inspect import cleandoc
from typing import Any
from unicodedata import east_asian_width

import click

from benchdragon.errors import did_you_mean
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
    """A command whose help is what its function says of itself, to be translated, and an example."""

    def __init__(self, *args: Any, example: str = "", **more: Any) -> None:
        super().__init__(*args, **more)
        self.help, self.example = paragraphs(self.help or ""), example

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write what PLAN is, the options, and the example, which can be pasted as it is broken."""
        if any(parameter.name == "plan" for parameter in self.params):
            text = _("PLAN is a *.dragon.toml file, or a built-in plan: benchdragon plan lists them.")
            formatter.write_paragraph()
            with formatter.indentation():
                formatter.write_text(text)
        super().format_options(ctx, formatter)
        if self.example:
            begun = "" if "benchdragon" in self.example else "benchdragon "
            lines = textwrap.wrap(
                f"{begun}{self.example}", formatter.width - 6, subsequent_indent="  ",
                break_on_hyphens=False, break_long_words=False,
            )  # fmt: skip
            with formatter.section(_("Example")):
                formatter.write("".join(f"  {line}\n" for line in " \\\n".join(lines).split("\n")))


class HelpfulGroup(click.Group):
    """Verbs under the titles of `titled`, and named where one is called that is not there."""

    titled: Mapping[str, Sequence[click.Command]] = {}

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of the verbs."""
        del ctx
        return list(self.commands)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the verbs, a section each title."""
        if not self.titled:
            super().format_commands(ctx, formatter)
        for title, verbs in self.titled.items():
            rows = [(str(verb.name), self.commands[str(verb.name)].short_help or "") for verb in verbs]
            with formatter.section(_(title)):
                formatter.write_dl(rows)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Name of the verb on the command line, the verb, and its arguments.

        Raises:
            click.UsageError: if there is no such verb.
        """
        name = args[0]
        if name not in self.commands and not name.startswith("-") and not ctx.resilient_parsing:
            inner = (
                f"{above} {one}"
                for above, group in self.commands.items()
                for one in getattr(group, "commands", ())
            )
            hint = did_you_mean(name, self.commands) or did_you_mean(name, inner)
            hint = hint or _("; known: {names}").format(names=", ".join(self.commands))
            raise click.UsageError(_("there is no command {name}").format(name=name) + hint, ctx)
        return super().resolve_command(ctx, args)


def sentence(error: click.ClickException) -> str:
    """What is wrong with a command line, in one sentence, and where its help is."""
    text, context = error.format_message(), getattr(error, "ctx", None)
    if isinstance(error, click.NoSuchOption) and context is not None:
        known = [name for one in context.command.params for name in one.opts if name.startswith("--")]
        text = _("there is no option {name}").format(name=error.option_name)
        text += did_you_mean(error.option_name, known)
    help_at = "" if context is None else f" ({context.command_path} --help)"
    return text.rstrip(".。") + help_at


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
