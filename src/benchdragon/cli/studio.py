"""The verb `studio`: a page on which dances are planned, judged and watched."""

import threading
import webbrowser
from dataclasses import replace
from typing import Any

import click

from benchdragon.cli.options import shared_options
from benchdragon.i18n import N_, _


@click.command(
    help=N_(
        "Serve a page on which a dance is planned, judged and watched.\n\nIt listens on this machine "
        "alone unless --host says otherwise; Ctrl-C ends it."
    )
)
@click.option("--host", default="127.0.0.1", show_default=True, help=N_("Address to listen at."))
@click.option(
    "--port",
    type=click.IntRange(0, 65_535),
    default=8000,
    show_default=True,
    help=N_("Port; 0: any that is free."),
)
@click.option(
    "--allow",
    "names",
    multiple=True,
    metavar="NAME",
    help=N_("Another host name by which the page may be called; may be repeated."),
)
@click.option("--no-browser", is_flag=True, help=N_("Open no browser."))
@click.option(
    "--workers",
    type=click.IntRange(1, 64),
    help=N_("Workers for quick questions. Default: one a core, at most 8."),
)
@shared_options
def studio(quiet: bool, no_browser: bool, workers: int | None, **options: Any) -> int:
    """Serve until interrupted."""
    from benchdragon.studio.app import serve
    from benchdragon.studio.limits import Settings

    def listening(address: str) -> None:
        if not quiet:
            click.echo(_("The studio is at {address} (Ctrl-C ends it)").format(address=address))
        if not no_browser:
            threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()

    settings = Settings(**options)
    serve(settings if workers is None else replace(settings, workers=workers), listening)
    if not quiet:
        click.echo(_("The studio is closed."))
    return 0
