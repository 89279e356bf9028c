"""The verb `view`: the dance as one page for any browser."""

from functools import partial
from pathlib import Path
from typing import Any

from benchdragon.cli.console import print_written, shown_progress
from benchdragon.cli.options import output_option, plan_to_walk, take, verb
from benchdragon.cli.parsing import check_ending, parse_span
from benchdragon.i18n import N_
from benchdragon.progress import part


@verb("view turn -o turn.html")
@take("plan")
@output_option(N_("The file to write, for example dance.html."))
@take("force", "span", "json", "shared")
def view(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Write the dance of a plan as one page for any browser.

    The file needs no network and no program; send it to a phone and open it there.
    """
    from benchdragon.analysis.check import check
    from benchdragon.files import refuse_existing
    from benchdragon.player import scene
    from benchdragon.player.page import write_player

    path: Path = options["output"]
    check_ending("-o", path, [".html"])
    read = plan_to_walk(plan, settings, quiet)
    refuse_existing([path], options["force"])
    first, last = parse_span(options)
    walk = read.build()
    start, end = read.span(walk)
    span = scene.Span(start if first is None else first, end if last is None else last)
    with shown_progress(quiet) as progress:
        told = part(progress, 0.0, 0.5)
        judge = partial(check, progress=told)
        shown = scene.judged_dance(read, judge, span, part(progress, 0.5, 1.0))
        write_player(path, shown)
    print_written([path], options["as_json"], plan_sha256=read.sha256)
    return 0
