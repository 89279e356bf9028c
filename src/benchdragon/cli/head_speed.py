"""`solve speed`: the greatest head speed, and a pace that slows down only where it must."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.console import print_explanation, print_files, shown_progress
from benchdragon.cli.options import file_option, not_with, only_with, plan_to_walk, take, verb
from benchdragon.cli.solved import (
    certificate_option,
    check_certificate,
    exit_code,
    print_solved,
    read_to_write,
    write_kept_certificate,
    write_plan,
)
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer

if TYPE_CHECKING:
    from benchdragon.analysis.speed_proof import SpeedClaim
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.head_speed import Pace


@verb("solve speed turn --set limits.speed=1.5")
@take("plan")
@file_option(
    "--pace",
    N_("Write the plan walked at its own head speed, slowed down only where a limit requires it."),
)
@take("prove")
@certificate_option
@take("json", "brackets", "explain", "shared")
def speed(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """The greatest constant head speed that keeps the plan's limits.

    The plan must limit speeds, accelerations or turning rates: --set limits.speed=2, for example.
    Exit code 4: it cannot be walked; 5: undecided.
    """
    path: Path | None = options["pace"]
    not_with("--pace", path is not None, "prove")
    only_with("--prove", options["prove"], "output")
    if options["prove"]:
        check_certificate(options)
        return _print_speed(plan_to_walk(plan, settings, quiet), options, quiet)
    read = read_to_write(plan, settings, quiet, "--pace", path)
    if path is None:
        return _print_speed(read, options, quiet)
    return _print_pace(read, plan, path, options, quiet)


def _print_speed(plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    """The greatest head speed."""
    from benchdragon.solve.head_speed import greatest_head_speed, prove_head_speed

    claims: list[SpeedClaim] = []
    with shown_progress(quiet) as progress:
        if options["prove"]:
            found = prove_head_speed(plan, progress=progress, claims=claims)
        else:
            found = greatest_head_speed(plan, progress=progress)
    lines = _speed_lines(plan, found, None) if options["explain"] else []
    print_solved(plan, _("greatest head speed"), found, options, lines)
    write_kept_certificate(plan, options, [], claims)
    return exit_code(found)


def _print_pace(plan: "Plan", source: str, path: Path, options: dict[str, Any], quiet: bool) -> int:
    """The greatest head speed, and a pace that slows down only where it must, written to a file."""
    from benchdragon.files import refuse_existing
    from benchdragon.solve.head_speed import slowed, with_pace

    refuse_existing([path], options["force"])
    with shown_progress(quiet) as progress:
        pace = slowed(plan, progress=progress)
    write_plan(with_pace(plan, pace), path, source)
    more: dict[str, Any] = {"pace": {"seconds": pace.seconds, "saved": pace.saved, "file": str(path)}}
    lines = _speed_lines(plan, pace.steady, pace) if options["explain"] else []
    json_lines = lines if options["as_json"] else []
    print_solved(plan, _("greatest head speed"), pace.steady, options, json_lines, **more)
    if not options["as_json"]:
        text = _("slowing down only where it must the walk takes {seconds} s, {saved} s less")
        click.echo(text.format(seconds=f"{pace.seconds:.2f}", saved=f"{pace.saved:.2f}"))
        print_files([path])
        print_explanation(lines)
    return exit_code(pace.steady)


def _speed_lines(plan: "Plan", found: Answer, pace: "Pace | None") -> list[str]:
    """The lines of --explain for a head speed."""
    from benchdragon.explain.answers import speed_lines

    return speed_lines(plan, found, pace)
