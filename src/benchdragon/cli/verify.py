"""The verb `verify`: show again what a certificate says was proved."""

from pathlib import Path

import click

from benchdragon.cli.console import print_json, shown_progress
from benchdragon.cli.options import take, verb


@verb("verify certificate.json")
@click.argument("file", metavar="FILE")
@take("json", "shared")
def verify(file: str, quiet: bool, as_json: bool) -> int:
    """Show again what a certificate says was proved, from its plan alone.

    FILE is a certificate, as check --prove -o FOLDER, the questions of solve with --prove -o FILE, and
    solve turn --prove --certificate FILE write it. Exit code 0: all of it holds; 5: something could not
    be shown. It needs the extra prove.
    """
    from benchdragon.analysis.certificate import read_certificate, shown
    from benchdragon.solve import turn_certificate

    if turn_certificate.is_turn_certificate(Path(file)):
        turns = read_certificate(Path(file), turn_certificate.TurnCertificate)
        with shown_progress(quiet) as progress:
            one = turn_certificate.shown(turns, progress)
        lines, statements = [one.sentence()], [one.as_json()]
        size, plan_sha256 = {"boxes": len(turns.witnesses)}, turns.plan_sha256
    else:
        certificate = read_certificate(Path(file))
        with shown_progress(quiet) as progress:
            found = shown(certificate, progress)
        lines, statements = found.sentences, [said.as_json() for said in found.statements]
        ends = [claim.cells for claim in certificate.claims]
        ends += [claim.cells for claim in certificate.speeds]
        size, plan_sha256 = {"cells": sum(len(at) - 1 for at in ends)}, certificate.plan_sha256
    if as_json:
        about = {"verified": lines, "statements": statements, **size, "plan_sha256": plan_sha256}
        print_json(about)
    else:
        for line in lines:
            click.echo(line)
    return 0
