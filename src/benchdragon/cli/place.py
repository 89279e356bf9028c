"""`solve place` and `solve square`: where on its square a dance fits, and what square it takes."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import NO_SOLUTION, about, print_answer, print_title
from benchdragon.cli.console import print_files, shown_progress
from benchdragon.cli.options import (
    FILE,
    brackets_option,
    force_option,
    json_option,
    plan_options,
    shared_options,
)
from benchdragon.cli.solve import read_to_write, write_plan
from benchdragon.i18n import N_, _

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.place import PlacedDance


@click.command(
    help=N_(
        "Where on its square the dance fits best: with the most room to the venue's edge and to "
        "every obstacle.\n\nPLAN is a *.dragon.toml file with a [venue]. Exit code 4: the dance fits "
        "nowhere."
    )
)
@plan_options
@click.option(
    "--plan-file", type=FILE, metavar="FILE", help=N_("Write the plan with the place that was found.")
)
@force_option
@json_option
@brackets_option
@shared_options
def place(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print the best place; with --plan-file also write the plan there."""
    from benchdragon.files import refuse_existing
    from benchdragon.solve.place import best_place

    path: Path | None = options["plan_file"]
    read = read_to_write(plan, settings, quiet, "--plan-file", path)
    refuse_existing([] if path is None else [path], options["force"])
    with shown_progress(quiet) as progress:
        best = best_place(read, progress=progress)
    fits = best.room.status != "infeasible"
    if path is not None and fits:
        write_plan(best.plan, path)
    if options["as_json"]:
        click.echo(json.dumps({**best.as_json(), **about(read, [])}))
    else:
        _print_place(read, best, options)
        if path is not None and fits:
            print_files([path])
    return 0 if fits else NO_SOLUTION


def _print_place(plan: "Plan", best: "PlacedDance", options: dict[str, Any]) -> None:
    """The best place for readers."""
    from benchdragon.analysis.findings import shown_name

    print_title(plan)
    if best.room.status == "infeasible":
        click.echo(_("the dance fits nowhere on this square; the nearest to it that was found:"))
    x, y = best.at
    click.echo(
        _("at = [{x}, {y}] m, turned = {turned} degrees  (best found)").format(
            x=f"{x:g}", y=f"{y:g}", turned=f"{best.turned:g}"
        )
    )
    print_answer(_("room beyond the margins"), best.room, up=False, brackets=options["brackets"])
    for answers in best.obstacles:
        name = shown_name(answers.obstacle.name)
        text = _("least distance from {name}").format(name=name)
        print_answer(text, answers.distance, up=False, brackets=options["brackets"])
