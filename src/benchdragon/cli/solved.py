"""What the questions of `solve` share: certificates, written plans, printed answers."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import NO_SOLUTION, UNDECIDED, about, print_answer, print_title
from benchdragon.cli.by_hand import kept_by_hand, warn_of_lost
from benchdragon.cli.console import print_explanation, print_files
from benchdragon.cli.options import only_with, output_option, plan_to_walk, take, together
from benchdragon.cli.parsing import check_ending
from benchdragon.i18n import N_
from benchdragon.model.answer import Answer

if TYPE_CHECKING:
    from benchdragon.analysis.proof import Claim
    from benchdragon.analysis.speed_proof import SpeedClaim
    from benchdragon.plans.schema import Plan


certificate_option = together(
    output_option(
        N_("Write what --prove shows into this file, as a certificate that `verify` shows again."),
        required=False,
    ),
    take("force"),
)


def check_certificate(options: dict[str, Any]) -> None:
    """Refuse a certificate that could not be written."""
    from benchdragon.files import refuse_existing

    path: Path | None = options["output"]
    only_with("-o", path is not None, "force")
    if path is not None:
        check_ending("-o", path, [".json"])
        refuse_existing([path], options["force"])


def write_kept_certificate(
    plan: "Plan", options: dict[str, Any], claims: "list[Claim]", speeds: "list[SpeedClaim]"
) -> None:
    """Write what was proved, if that is asked for."""
    from benchdragon.analysis.certificate import certificate_of, write_certificate

    path: Path | None = options["output"]
    if path is None:
        return
    write_certificate(certificate_of(plan, claims, speeds), path)
    if not options["as_json"]:
        print_files([path])


def read_to_write(
    plan: str, settings: tuple[str, ...], quiet: bool, option: str, path: Path | None
) -> "Plan":
    """The plan of a question that may write another into a file; refuses what cannot be written."""
    only_with(option, path is not None, "force")
    if path is not None:
        check_ending(option, path, [".toml"])
    return plan_to_walk(plan, settings, quiet)


def write_plan(plan: "Plan", path: Path, source: str) -> None:
    """The plan as a whole file, with the comments of the file that it was made from.

    Entries by hand in the file that it replaces, and that are lost, are reported.
    """
    from benchdragon.files import write_whole
    from benchdragon.plans.rewriting import rewritten

    text, before = rewritten(plan, source), kept_by_hand(path)
    write_whole(path, text)
    warn_of_lost(before, path)


def exit_code(found: Answer) -> int:
    """The exit code of an answer."""
    return {"infeasible": NO_SOLUTION, "undecided": UNDECIDED}.get(found.status, 0)


def print_solved(
    plan: "Plan", name: str, found: Answer, options: dict[str, Any], lines: list[str], *,
    up: bool = False, **more: Any,
) -> None:  # fmt: skip
    """An answer as JSON, with `more` beside it, or for readers, rounded `up` or down."""
    if options["as_json"]:
        click.echo(json.dumps(found.as_json(**more, **about(plan, lines))))
        return
    print_title(plan)
    print_answer(name, found, up=up, brackets=options["brackets"])
    for text in found.assumptions:
        click.echo(f"  {text}")
    print_explanation(lines)
