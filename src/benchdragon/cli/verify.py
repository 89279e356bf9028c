"""The verb `verify`: show again what a certificate says was proved."""

import json
from pathlib import Path

import click

from benchdragon.cli.console import shown_progress
from benchdragon.cli.options import announce_compiling, json_option, shared_options
from benchdragon.i18n import N_


@click.command(
    help=N_(
        "Show again what a certificate says was proved, from its plan alone."
        "\n\nFILE is a certificate, as check --prove -o FOLDER and the questions of solve with --prove "
        "-o FILE write it. Exit code 0: all of it holds; 5: something could not be shown. It needs the "
        "extra prove."
    )
)
@click.argument("file", metavar="FILE")
@json_option
@shared_options
def verify(file: str, quiet: bool, as_json: bool) -> int:
    """Print what is proved, as sentences or as JSON."""
    from benchdragon.analysis.certificate import read_certificate
    from benchdragon.analysis.certificate import verify as verified

    certificate = read_certificate(Path(file))
    announce_compiling(quiet)
    with shown_progress(quiet) as progress:
        lines = verified(certificate, progress)
    if as_json:
        ends = [claim.cells for claim in certificate.claims]
        ends += [claim.cells for claim in certificate.speeds]
        cells = sum(len(at) - 1 for at in ends)
        answer = {"verified": lines, "cells": cells, "plan_sha256": certificate.plan_sha256}
        click.echo(json.dumps(answer))
    else:
        for line in lines:
            click.echo(line)
    return 0
