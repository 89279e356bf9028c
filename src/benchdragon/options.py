"""Options that several verbs take."""

from collections.abc import Callable
from pathlib import Path

import click

from benchdragon.messages import LANGUAGES, N_, _

Command = Callable[..., int]

# Seconds of compiling after which a word is due.
SLOW_COMPILE = 1.0


def shared_options(command: Command) -> Command:
    """--lang and --quiet, which every verb takes."""
    command = click.option(
        "--quiet", is_flag=True, help=N_("No progress and no talk on standard error.")
    )(command)
    return click.option(
        "--lang",
        type=click.Choice(LANGUAGES),
        expose_value=False,
        help=N_("Language: zh or en. Default: BENCHDRAGON_LANG, else the locale."),
    )(command)


def plan_options(command: Command) -> Command:
    """PLAN and --set."""
    command = click.option(
        "--set",
        "settings",
        multiple=True,
        metavar="KEY=VALUE",
        help=N_("Override a value of the plan, for example route.pitch=0.6; may be repeated."),
    )(command)
    return click.argument("plan", metavar="PLAN")(command)


def span_options(command: Command) -> Command:
    """--start and --end, which `ask.parse_span` reads."""
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
            "Where it begins: seconds of the dance (12.5), or minutes and seconds (3:12). Default: as "
            "the plan says."
        ),
    )(command)


def folder_option(command: Command) -> Command:
    """--output and --force."""
    command = click.option("--force", is_flag=True, help=N_("Overwrite files that are there already."))(
        command
    )
    return click.option(
        "-o",
        "--output",
        type=click.Path(path_type=Path, file_okay=False),
        metavar="DIR",
        help=N_("Folder for the files."),
    )(command)


def json_option(command: Command) -> Command:
    """--json."""
    return click.option(
        "--json", "as_json", is_flag=True, help=N_("Print one JSON object and nothing else.")
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
        "-j",
        "--workers",
        type=click.IntRange(1, 64),
        default=default,
        show_default=True,
        help=N_("Threads; the answers do not depend on it."),
    )


def announce_compiling(quiet: bool) -> None:
    """Say on standard error when compiling takes long, unless `quiet`."""
    if quiet:
        return
    from benchdragon.kernels.jit import watch_compiling

    text = _("compiling the kernels, once for this machine; this takes up to a minute")
    said: list[str] = []

    def say() -> None:
        if not said:
            said.append(text)
            click.echo(text, err=True)

    watch_compiling(say, SLOW_COMPILE)
