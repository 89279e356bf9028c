"""The verb `atlas`: what sweeps came to, as one page."""

from pathlib import Path

import click

from benchdragon.cli.console import print_written, shown_progress
from benchdragon.cli.options import output_option, take, verb
from benchdragon.cli.parsing import check_ending
from benchdragon.errors import InputError
from benchdragon.i18n import N_, _


@verb("atlas out/pitch out/width -o atlas.html")
@click.argument("folders", metavar="FOLDERS", nargs=-1, required=True)
@output_option(N_("The file to write, for example atlas.html."))
@take("force", "json", "shared")
def atlas(folders: tuple[str, ...], output: Path, force: bool, as_json: bool, quiet: bool) -> int:
    """Write a page of what sweeps came to.

    It holds pictures, tables of the extreme answers, and the command that makes each sweep, and needs
    no network. FOLDERS are those that `benchdragon sweep -o` has written.
    """
    from benchdragon.export.atlas import write_atlas
    from benchdragon.files import refuse_existing
    from benchdragon.sweeps.sweep import read_sweep

    check_ending("-o", output, [".html"])
    if len({Path(folder).resolve() for folder in folders}) < len(folders):
        raise InputError(_("expected each folder once"))
    sweeps = {folder: read_sweep(folder) for folder in folders}
    for folder, found in sweeps.items():
        if not len(found.table):
            raise InputError(_("{folder} holds a sweep without any row").format(folder=folder))
    refuse_existing([output], force)
    with shown_progress(quiet) as progress:
        write_atlas(output, sweeps, progress)
    print_written([output], as_json)
    return 0
