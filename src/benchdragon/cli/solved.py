"""What the questions of `solve` share: certificates, written plans, printed answers."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import NO_SOLUTION, UNDECIDED, about, print_answer, print_title
from benchdragon.cli.by_hand import kept_by_hand, warn_of_lost
from benchdragon.cli.console import print_explanation, print_files, print_json
from benchdragon.cli.options import file_option, only_with, output_option, take, together
from benchdragon.cli.parsing import check_ending
from benchdragon.files import refuse_existing, write_whole
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.number_format import figures

if TYPE_CHECKING:
    from benchdragon.analysis.proof import Claim
    from benchdragon.analysis.speed_proof import SpeedClaim
    from benchdragon.plans.schema import Plan


certificate_option = file_option(
    "--certificate", N_("With --prove: write what shows it, for benchdragon verify.")
)
plan_option = output_option(
    N_("The plan file to write, with what was found, for example best.dragon.toml."), required=False
)
# What a question that proves its answer writes.
written_options = together(plan_option, certificate_option, take("force"))


def refuse_written(options: dict[str, Any]) -> None:
    """Refuse what a question could not write: a plan by -o, a certificate by --certificate.

    Raises:
        InputError: for options that have no effect, and names of other kinds of files.
        FileRefusedError: if one is there already and --force is not given.
    """
    path = options["output"]
    if "certificate" in options:
        refuse_certificate(options, options["prove"], path)
    else:
        only_with("-o", path is not None, "force")
    if path is not None:
        check_ending("-o", path, [".toml"])
        refuse_existing([path], options["force"])


def refuse_certificate(options: dict[str, Any], proves: bool, path: Path | None) -> None:
    """The same of a certificate; `path` is what is written besides, with --force, too."""
    kept = options["certificate"]
    only_with("--prove", proves, "certificate")
    only_with("-o, --certificate", bool(kept or path), "force")
    if kept is not None:
        check_ending("--certificate", kept, [".json"])
        refuse_existing([kept], options["force"])


def write_found(source: str, options: dict[str, Any], better: "Plan | None") -> list[Path]:
    """Write the plan that was found, where one is asked for and there is one; the files written."""
    path: Path | None = options["output"]
    if path is not None and better is None:
        click.echo(_("No plan was written: nothing was found."), err=True)
    if path is None or better is None:
        return []
    write_plan(better, path, source)
    return [path]


def write_proved(
    plan: "Plan", path: Path | None, claims: "Sequence[Claim]", speeds: "Sequence[SpeedClaim]"
) -> list[Path]:
    """Write the certificate of what was proved, where one is asked for; the files written."""
    from benchdragon.analysis.certificate import certificate_of, write_certificate

    if path is not None and not (claims or speeds):
        click.echo(_("No certificate was written: nothing was proved."), err=True)
    if path is None or not (claims or speeds):
        return []
    write_certificate(certificate_of(plan, claims, speeds), path)
    return [path]


def write_plan(plan: "Plan", path: Path, source: str) -> None:
    """The plan as a whole file, with the comments of the file that it was made from.

    Entries by hand in the file that it replaces, and that are lost, are reported.
    """
    from benchdragon.plans.rewriting import rewritten

    text, before = rewritten(plan, source), kept_by_hand(path)
    write_whole(path, text)
    warn_of_lost(before, path)


def shown(found: Answer, *, up: bool) -> float | None:
    """The value that readers are shown, which is surely true; None where nothing was found."""
    return float(figures(found.sure(up=up), up=up)) if found.status in ("found", "proved") else None


def exit_code(found: Answer) -> int:
    """The exit code of an answer."""
    return {"infeasible": NO_SOLUTION, "undecided": UNDECIDED}.get(found.status, 0)


def print_solved(
    plan: "Plan", name: str, found: Answer, options: dict[str, Any], lines: list[str],
    files: Sequence[Path] = (), *, up: bool = False, said: str = "", **more: Any,
) -> None:  # fmt: skip
    """An answer as JSON, with `more` beside it, or for readers, rounded `up` or down, and `said`."""
    if options["as_json"]:
        print_json(found.as_json(**more, **about(plan, lines)), files)
        return
    print_title(plan)
    print_answer(name, found, up=up, brackets=options["brackets"])
    for text in found.assumptions:
        click.echo(f"  {text}")
    if said:
        click.echo(said)
    print_files(files)
    print_explanation(lines)
