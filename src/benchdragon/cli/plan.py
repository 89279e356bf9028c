"""The verbs about plan files themselves: `plan`, which prints one, and `schema`."""

import json
import sys
from pathlib import Path
from typing import Any

import click

from benchdragon.cli.answers import about
from benchdragon.cli.console import print_json, print_rows, print_written
from benchdragon.cli.options import only_with, output_option, plan_to_walk, take, verb
from benchdragon.cli.parsing import check_ending, parse_speed
from benchdragon.cli.solved import write_plan
from benchdragon.i18n import N_, _, language
from benchdragon.plans.toml import CONTEST, built_in_names, read_text

# How a preset's figure is known.
STATUSES = {
    "measured": N_("measured"),
    "reported": N_("reported"),
    "derived": N_("derived"),
    "assumed": N_("assumed"),
}


@verb("plan turn -o my.dragon.toml")
@take("maybe a plan")
@output_option(N_("The file to write, for example my.dragon.toml."), required=False)
@take("force")
@click.option(
    "--head-speed",
    metavar="SPEED",
    help=N_(
        "The same dance with its head at this speed, for example 0.6: start and end change with it, so "
        "that all marks on the ground stay. With -o."
    ),
)
@take("json", "shared")
def plan(plan: str | None, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print a plan as a plan file, to begin one of your own.

    Without PLAN all built-in plans are listed, the contest's and the villages', which every command
    takes. With --set the values that are in effect then, each with what it means.
    """
    output: Path | None = options["output"]
    only_with("-o", output is not None, "force", "head_speed")
    only_with("PLAN", plan is not None, "settings", "output")
    if plan is None:
        return _list(options["as_json"])
    if output is not None:
        _write(plan, settings, quiet, output, options)
        print_written([output], options["as_json"])
    elif options["as_json"]:
        read = plan_to_walk(plan, settings, quiet)
        print_json({"plan": read.data(), **about(read, [])})
    else:
        click.echo(_text(plan, settings), nl=False)
    return 0


def _write(
    source: str, settings: tuple[str, ...], quiet: bool, output: Path, options: dict[str, Any]
) -> None:
    """Write the plan as it is printed, or the same dance with its head at another speed."""
    from benchdragon.files import refuse_existing, write_whole
    from benchdragon.solve.head_speed import with_head_speed

    if options["head_speed"] is None:
        text = _text(source, settings)
        refuse_existing([output], options["force"])
        write_whole(output, text)
        return
    speed = parse_speed("--head-speed", options["head_speed"])
    check_ending("-o", output, [".toml"])
    refuse_existing([output], options["force"])
    write_plan(with_head_speed(plan_to_walk(source, settings, quiet), speed), output, source)


def _list(as_json: bool) -> int:
    from benchdragon.plans.presets import presets

    spoken = language()
    listed = {one.name: (getattr(one.title, spoken), getattr(one.source, spoken)) for one in presets()}
    names = built_in_names()
    if as_json:
        rows = [
            dict(zip(("name", "title", "source"), (name, *listed[name]), strict=True)) for name in names
        ]
        print_json({"plans": rows})
        return 0
    for name in names:
        title, source = listed[name]
        click.echo(f"{name:<12}{title} ({source})")
    return 0


def _text(name: str, settings: tuple[str, ...]) -> str:
    """The text of a plan file: one of the contest's as it is, else every key that has an effect."""
    from benchdragon.plans.keys import commented
    from benchdragon.plans.presets import REPORTERS, presets
    from benchdragon.plans.schema import read_plan

    if name in CONTEST and not settings:
        return read_text(name)
    plan = read_plan(name, settings)
    if name not in REPORTERS:
        return commented(plan.data(), {})
    (preset,) = (preset for preset in presets() if preset.name == name)
    notes = {
        figure.key: _(STATUSES[figure.status])
        for figure in preset.figures
        if figure.key not in plan.source.settings
    }
    return f"# {getattr(preset.source, language())}\n{commented(plan.data(), notes)}"


@verb("schema --table")
@click.option("--table", is_flag=True, help=N_("Print a table for readers."))
@take("shared")
def schema(table: bool, quiet: bool) -> int:
    """Every key of plan files: the JSON Schema, or with --table a table for readers.

    It says what each key means, its unit, its default and an example.
    """
    del quiet
    from benchdragon.plans import keys as plan_keys
    from benchdragon.plans.sections import SECTIONS

    if not table:
        narrow = not sys.stdout.encoding.lower().startswith("utf")
        click.echo(json.dumps(plan_keys.schema(), indent=1, ensure_ascii=narrow))
        return 0
    columns = (_("key"), _("what it is"), _("unit"), _("default"), _("example"))
    for section in SECTIONS:
        title = f"{section.header}  {_(section.text)}".strip()
        print_rows(title, columns, list(plan_keys.rows(section)), words=len(columns))
    return 0
