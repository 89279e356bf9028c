"""Options that several verbs take."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from benchdragon.errors import InputError
from benchdragon.i18n import LANGUAGES, N_, _

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan

Command = Callable[..., int | None]  # groups give nothing

# Of random dances: their number, and their seed.
MOST_DRAWS, MOST_SEED = 100_000, 2**31
# Notes on a list of names that a screen shows.
MOST_TOLD = 20


class NamedPath(click.Path):
    """A file or a folder to write; an empty name, as of a variable that is not set, is refused."""

    def __init__(self, *, folder: bool) -> None:
        super().__init__(path_type=Path, file_okay=not folder, dir_okay=folder)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path."""
        if value == "":
            self.fail(_("a name is wanted, not nothing"), param, ctx)
        return super().convert(value, param, ctx)


FILE, FOLDER = NamedPath(folder=False), NamedPath(folder=True)


def lang_option(command: Command) -> Command:
    """--lang."""
    return click.option(
        "--lang",
        type=click.Choice(LANGUAGES),
        expose_value=False,
        help=N_("Language: zh or en. Default: BENCHDRAGON_LANG, else the locale."),
    )(command)


def shared_options(command: Command) -> Command:
    """--lang and --quiet, which every verb takes."""
    command = click.option(
        "--quiet", is_flag=True, help=N_("No progress and no talk on standard error.")
    )(command)
    return lang_option(command)


def settings_option(command: Command) -> Command:
    """--set."""
    return click.option(
        "--set",
        "settings",
        multiple=True,
        metavar="KEY=VALUE",
        help=N_("Override a value of the plan, for example route.pitch=0.6; may be repeated."),
    )(command)


def plan_options(command: Command) -> Command:
    """PLAN and --set."""
    return click.argument("plan", metavar="PLAN")(settings_option(command))


def span_options(command: Command) -> Command:
    """--start and --end, which `parsing.parse_span` reads."""
    command = click.option(
        "--end",
        metavar="TIME",
        help=N_(
            "Where it ends, likewise. Default: as the plan says, or where the dragon can no longer "
            "stand."
        ),
    )(command)
    return click.option(
        "--start",
        metavar="TIME",
        help=N_(
            "Where it begins: seconds of the dance (12.5), a clock time (3:12) or units (3 min 12 s). "
            "Default: as the plan says."
        ),
    )(command)


def force_option(command: Command) -> Command:
    """--force."""
    return click.option("--force", is_flag=True, help=N_("Overwrite files that are there already."))(
        command
    )


def output_option(text: str, *, required: bool = True) -> Callable[[Command], Command]:
    """--output of one file, of which `text` says what it is."""
    return click.option("-o", "--output", type=FILE, required=required, metavar="FILE", help=text)


def scale_option(text: str) -> Callable[[Command], Command]:
    """--scale of a drawing, which `parsing.parse_scale` reads; `text` says which there are."""
    return click.option("--scale", metavar="1:NUMBER", help=text)


def folder_option(command: Command, default: Path | None = None) -> Command:
    """--output and --force."""
    return click.option(
        "-o",
        "--output",
        type=FOLDER,
        metavar="DIR",
        default=default,
        show_default=default is not None,
        help=N_("Folder for the files."),
    )(force_option(command))


def formats_option(default: str, text: str) -> Callable[[Command], Command]:
    """--format, which says in `text` what there is."""
    return click.option(
        "--format", "formats", default=default, show_default=True, metavar="LIST", help=text
    )


def json_option(command: Command) -> Command:
    """--json."""
    return click.option(
        "--json", "as_json", is_flag=True, help=N_("Print one JSON object and nothing else.")
    )(command)


def brackets_option(command: Command) -> Command:
    """--brackets."""
    return click.option(
        "--brackets",
        is_flag=True,
        help=N_("Show all digits, and the bracket in which each answer lies; --json always has them."),
    )(command)


def prove_option(command: Command) -> Command:
    """--prove."""
    return click.option(
        "--prove", is_flag=True, help=N_("Show the answer in ball arithmetic too, without the search.")
    )(command)


def explain_option(command: Command) -> Command:
    """--explain."""
    return click.option(
        "--explain",
        is_flag=True,
        help=N_("Say how the answer came about: each formula with its numbers, step by step."),
    )(command)


def workers_option(default: int) -> Callable[[Command], Command]:
    """-j, where threads may help."""
    return click.option(
        "-j", "--workers", type=click.IntRange(1, 64), default=default, show_default=True,
        help=N_("Threads; the answers do not depend on it."),
    )  # fmt: skip


def place_options(command: Command) -> Command:
    """--on and --workers."""
    command = click.option(
        "-j",
        "--workers",
        type=click.IntRange(1, 1024),
        help=N_("Workers of this machine: one a core if it is not said; answers do not depend on it."),
    )(command)
    return click.option(
        "--on",
        default="processes",
        show_default=True,
        metavar="PLACE",
        help=N_(
            "Where it runs: processes, dask (a cluster of this machine), or the address of a Dask "
            "scheduler (tcp://host:8786)."
        ),
    )(command)


def dances_options(seeded: str, drawn: str) -> Callable[[Command], Command]:
    """--draws and --seed of random dances; what each is for, in `drawn` and `seeded`."""

    def decorate(command: Command) -> Command:
        command = click.option(
            "--seed", type=click.IntRange(0, MOST_SEED), default=1, show_default=True, help=seeded
        )(command)
        return click.option(
            "--draws", type=click.IntRange(1, MOST_DRAWS), default=100, show_default=True, help=drawn
        )(command)

    return decorate


# Why an option that was given says nothing.
WITHOUT, BESIDE = N_("{option} goes with {what} alone"), N_("{option} does not go with {what}")


def given_options() -> set[str]:
    """The names of all parameters of the verb at hand that stand on its command line."""
    context = click.get_current_context()
    names = [str(parameter.name) for parameter in context.command.params]
    return {name for name in names if context.get_parameter_source(name) is ParameterSource.COMMANDLINE}


def refuse_strays(*rules: tuple[str, bool, str, str]) -> None:
    """Refuse options that were given and have no effect, rather than overlook them.

    Args:
        rules: name of a parameter; whether it has an effect; WITHOUT or BESIDE; and what.

    Raises:
        InputError: for the first one.
    """
    context = click.get_current_context()
    options = {parameter.name: max(parameter.opts, key=len) for parameter in context.command.params}
    given = given_options()
    for name, goes, why, what in rules:
        if not goes and name in given:
            raise InputError(_(why).format(option=options[name], what=what))


def plan_to_walk(plan: str, settings: tuple[str, ...], quiet: bool) -> "Plan":
    """The plan that PLAN and --set say, for a verb that will walk it."""
    from benchdragon.plans.schema import read_plan

    read = read_plan(plan, settings)
    if not quiet:
        for note in read.source.passed:
            click.echo(_("Drawing: {note}").format(note=note), err=True)
    return read


def tell_names(notes: Sequence[str], quiet: bool) -> None:
    """Say on standard error what is odd about a list of names, a sentence each; MOST_TOLD at most."""
    if quiet or not notes:
        return
    # The last says which benches nobody carries.
    shown = notes if len(notes) <= MOST_TOLD else (*notes[: MOST_TOLD - 1], notes[-1])
    for note in shown:
        click.echo(_("List of names: {note}").format(note=note), err=True)
    if len(notes) > len(shown):
        text = _("List of names: and {count} more: see the overview (benchdragon sheets)")
        click.echo(text.format(count=len(notes) - len(shown)), err=True)
