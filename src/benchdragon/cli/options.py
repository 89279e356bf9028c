"""Options that several verbs take."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from benchdragon.cli.completed import keys, plans
from benchdragon.cli.help import Verb
from benchdragon.errors import InputError
from benchdragon.i18n import LANGUAGES, N_, _

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan

Command = Callable[..., int | None]  # groups give nothing
Decorator = Callable[[Command], Command]

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
            self.fail(_("a name is required"), param, ctx)
        return super().convert(value, param, ctx)


FILE, FOLDER = NamedPath(folder=False), NamedPath(folder=True)


# A command keeps the option that shows its help from the first call, also from one without its group.
HELP = {"help_option_names": ["-h", "--help"]}


def verb(example: str, **more: str) -> Callable[[Command], click.Command]:
    """A verb of the command line with an example; its help is what the function says of itself."""
    return click.command(cls=Verb, example=example, context_settings=HELP, **more)


def together(*options: Decorator) -> Decorator:
    """Several options as one, in the order in which help shows them."""

    def decorate(command: Command) -> Command:
        for option in reversed(options):
            command = option(command)
        return command

    return decorate


def flag(name: str, text: str) -> Decorator:
    """An option that is said or not."""
    return click.option(name, is_flag=True, help=text)


_lang = click.option(
    "--lang",
    type=click.Choice(LANGUAGES),
    expose_value=False,
    help=N_("Language: zh or en. Default: BENCHDRAGON_LANG, else the locale."),
)
_set = click.option(
    "--set",
    "settings",
    multiple=True,
    metavar="KEY=VALUE",
    shell_complete=keys,
    help=N_("Override a value of the plan, for example route.pitch=0.6; may be repeated."),
)
# What several verbs take, by the name under which `take` knows it; `parsing.parse_span` reads the span.
COMMON: dict[str, Decorator] = {
    "lang": _lang,
    "shared": together(_lang, flag("--quiet", N_("No progress and no talk on standard error."))),
    "set": _set,
    "plan": together(click.argument("plan", metavar="PLAN", shell_complete=plans), _set),
    "maybe a plan": together(
        click.argument("plan", metavar="[PLAN]", required=False, shell_complete=plans), _set
    ),
    "force": flag("--force", N_("Overwrite files that are there already.")),
    "json": click.option(
        "--json", "as_json", is_flag=True, help=N_("Print one JSON object and nothing else.")
    ),
    "brackets": flag(
        "--brackets",
        N_("Show all digits, and the bracket in which each answer lies; --json always has them."),
    ),
    "prove": flag("--prove", N_("Show the answer in ball arithmetic too, without the search.")),
    "explain": flag(
        "--explain", N_("Say how the answer came about: each formula with its numbers, step by step.")
    ),
    "span": together(
        click.option(
            "--start",
            metavar="TIME",
            help=N_(
                "Where it begins: seconds of the dance (12.5), a clock time (3:12) or units (3 min 12 "
                "s). Default: as the plan says."
            ),
        ),
        click.option(
            "--end",
            metavar="TIME",
            help=N_(
                "Where it ends, likewise. Default: as the plan says, or where the dragon can no longer "
                "stand."
            ),
        ),
    ),
    "place": together(
        click.option(
            "--on",
            default="processes",
            metavar="PLACE",
            help=N_(
                "Where it runs: processes, dask (a cluster of this machine), or the address of a Dask "
                "scheduler (tcp://host:8786)."
            ),
        ),
        click.option(
            "-j",
            "--workers",
            type=click.IntRange(1, 1024),
            help=N_(
                "Workers of this machine: one a core if it is not said; answers do not depend on it."
            ),
        ),
    ),
}


def take(*names: str) -> Decorator:
    """The options in COMMON of these names, in the order in which help shows them."""
    return together(*(COMMON[name] for name in names))


def output_option(text: str, *, required: bool = True) -> Decorator:
    """--output of one file, of which `text` says what it is."""
    return click.option("-o", "--output", type=FILE, required=required, metavar="FILE", help=text)


def file_option(name: str, text: str) -> Decorator:
    """Another file to write."""
    return click.option(name, type=FILE, metavar="FILE", help=text)


def folder_option(default: Path | None = None) -> Decorator:
    """--output of a folder, and --force."""
    output = click.option(
        "-o", "--output", type=FOLDER, metavar="DIR", default=default, help=N_("Folder for the files.")
    )
    return together(output, COMMON["force"])


def files_option(default: str, text: str) -> Decorator:
    """The same, and --format of the files, which says in `text` what there is."""
    formats = click.option("--format", "formats", default=default, metavar="LIST", help=text)
    return together(folder_option(), formats)


def dances_options(seeded: str, drawn: str) -> Decorator:
    """--draws and --seed of random dances; what each is for, in `drawn` and `seeded`."""
    return together(
        click.option("--draws", type=click.IntRange(1, MOST_DRAWS), default=100, help=drawn),
        click.option("--seed", type=click.IntRange(0, MOST_SEED), default=1, help=seeded),
    )


def given_options() -> set[str]:
    """The names of all parameters of the verb at hand that stand on its command line."""
    context = click.get_current_context()
    names = [str(parameter.name) for parameter in context.command.params]
    return {name for name in names if context.get_parameter_source(name) is ParameterSource.COMMANDLINE}


def only_with(what: str, there: bool, *names: str) -> None:
    """Refuse options that have no effect, rather than overlook them, where `what` is not `there`.

    Raises:
        InputError: for the first of `names`, those of parameters, that stands on the command line.
    """
    _refuse_given("" if there else _("{option} goes with {what} alone"), what, names)


def not_with(what: str, there: bool, *names: str) -> None:
    """The same where it is there."""
    _refuse_given(_("{option} does not go with {what}") if there else "", what, names)


def _refuse_given(text: str, what: str, names: Sequence[str]) -> None:
    parameters = click.get_current_context().command.params
    options = {parameter.name: max(parameter.opts, key=len) for parameter in parameters}
    given = given_options()
    for name in names if text else ():
        if name in given:
            raise InputError(text.format(option=options[name], what=what))


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
    # The last lists the benches without bearers.
    shown = notes if len(notes) <= MOST_TOLD else (*notes[: MOST_TOLD - 1], notes[-1])
    for note in shown:
        click.echo(_("List of names: {note}").format(note=note), err=True)
    if len(notes) > len(shown):
        text = _("List of names: and {count} more: see the overview (benchdragon sheets)")
        click.echo(text.format(count=len(notes) - len(shown)), err=True)
