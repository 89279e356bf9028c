"""The verb `planner`: the page on which dances are planned, as one file that needs no server."""

import tempfile
import webbrowser
from pathlib import Path

from benchdragon.cli.console import print_written
from benchdragon.cli.options import only_with, output_option, plan_to_walk, take, verb
from benchdragon.cli.parsing import check_ending
from benchdragon.i18n import N_


@verb("planner turn -o planner.html")
@take("maybe a plan")
@output_option(N_("The file to write, for example planner.html."), required=False)
@take("force", "json", "shared")
def planner(
    plan: str | None, settings: tuple[str, ...], output: Path | None, force: bool, as_json: bool,
    quiet: bool,
) -> int:  # fmt: skip
    """Write the planner: one page on which a dance is planned, judged and watched.

    The file needs no network, no server and no program; send it to a phone and open it there. Without
    -o the browser opens it from a temporary folder. PLAN is what it begins with.
    """
    from benchdragon.files import refuse_existing
    from benchdragon.planner.page import write_planner

    only_with("PLAN", plan is not None, "settings")
    only_with("-o", output is not None, "force")
    path = output or Path(tempfile.mkdtemp(prefix="benchdragon-")) / "planner.html"
    check_ending("-o", path, [".html"])
    read = None if plan is None else plan_to_walk(plan, settings, quiet)
    if read is not None:
        read.build()  # reports a plan that cannot be walked
    refuse_existing([path], force)
    write_planner(path, read)
    if output is None:
        webbrowser.open(path.as_uri())
    if output is not None or as_json or not quiet:
        print_written([path], as_json)
    return 0
