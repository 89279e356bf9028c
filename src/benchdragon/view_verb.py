"""The verbs that show a dance: view."""

from pathlib import Path
from typing import Any

import click

from benchdragon.messages import N_
from benchdragon.options import announce_compiling, plan_options, shared_options
from benchdragon.show import print_files, progress


@click.command(
    help=N_(
        "Write the dance of a plan as one page for any browser.\n\nThe file needs no network and no "
        "program; send it to a phone and open it there. PLAN is a *.dragon.toml file or the name of a "
        "built-in plan."
    )
)
@plan_options
@click.option(
    "-o", "--output", required=True, type=click.Path(path_type=Path, dir_okay=False), metavar="FILE",
    help=N_("The file to write, for example dance.html."),
)  # fmt: skip
@click.option("--force", is_flag=True, help=N_("Overwrite files that are there already."))
@click.option("--start", type=float, help=N_("First time shown, in seconds."))
@click.option("--end", type=float, help=N_("Last time shown, in seconds."))
@shared_options
def view(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Write the player."""
    from benchdragon import check, dance
    from benchdragon.files import refuse_existing
    from benchdragon.plan import read_plan
    from benchdragon.player import write_player

    read = read_plan(plan, settings)
    path: Path = options["output"]
    refuse_existing([path], options["force"])
    announce_compiling(quiet)
    with progress(quiet, check.STEPS + dance.STEPS) as advance:
        report = check.check(read, advance)
        start = report.start if options["start"] is None else options["start"]
        end = report.end if options["end"] is None else options["end"]
        shown = dance.checked_dance(report, dance.Span(start, end), advance)
        write_player(path, shown)
    print_files([path])
    return 0
