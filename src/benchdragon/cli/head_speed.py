"""`solve speed`: the greatest head speed, and a pace that slows down only where it must."""

from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.console import shown_progress
from benchdragon.cli.options import not_with, plan_to_walk, take, verb
from benchdragon.cli.solved import (
    exit_code,
    print_solved,
    refuse_written,
    shown,
    write_found,
    write_proved,
    written_options,
)
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer

if TYPE_CHECKING:
    from benchdragon.analysis.speed_proof import SpeedClaim
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.head_speed import Pace


@verb("solve speed turn --set limits.speed=1.5")
@take("plan")
@click.option(
    "--pace",
    is_flag=True,
    help=N_("In place of a constant speed the plan's own, slowed down only where a limit requires it."),
)
@take("prove")
@written_options
@take("json", "brackets", "explain", "shared")
def speed(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """The greatest constant head speed that keeps the plan's limits.

    The plan must limit speeds, accelerations or turning rates: --set limits.speed=2, for example. Exit
    code 4: it cannot be walked; 5: undecided.
    """
    not_with("--pace", options["pace"], "prove")
    refuse_written(options)
    read = plan_to_walk(plan, settings, quiet)
    return (_print_pace if options["pace"] else _print_speed)(read, plan, options, quiet)


def _print_speed(plan: "Plan", source: str, options: dict[str, Any], quiet: bool) -> int:
    """The greatest head speed."""
    from benchdragon.solve.head_speed import greatest_head_speed, prove_head_speed, with_head_speed

    claims: list[SpeedClaim] = []
    with shown_progress(quiet) as progress:
        if options["prove"]:
            found = prove_head_speed(plan, progress=progress, claims=claims)
        else:
            found = greatest_head_speed(plan, progress=progress)
    lines = _speed_lines(plan, found, None) if options["explain"] else []
    most = shown(found, up=False)
    better = None if options["output"] is None or most is None else with_head_speed(plan, most)
    files = write_found(source, options, better)
    files += write_proved(plan, options["certificate"], [], claims)
    print_solved(plan, _("greatest head speed"), found, options, lines, files)
    return exit_code(found)


def _print_pace(plan: "Plan", source: str, options: dict[str, Any], quiet: bool) -> int:
    """The greatest head speed, and a pace that slows down only where it must."""
    from benchdragon.solve.head_speed import slowed, with_pace

    with shown_progress(quiet) as progress:
        pace = slowed(plan, progress=progress)
    files = write_found(source, options, with_pace(plan, pace))
    more: dict[str, Any] = {"pace": {"seconds": pace.seconds, "saved": pace.saved}}
    lines = _speed_lines(plan, pace.steady, pace) if options["explain"] else []
    text = _("slowing down only where it must the walk takes {seconds} s, {saved} s less")
    said = text.format(seconds=f"{pace.seconds:.2f}", saved=f"{pace.saved:.2f}")
    name = _("greatest head speed")
    print_solved(plan, name, pace.steady, options, lines, files, said=said, **more)
    return exit_code(pace.steady)


def _speed_lines(plan: "Plan", found: Answer, pace: "Pace | None") -> list[str]:
    """The lines of --explain for a head speed."""
    from benchdragon.explain.answers import speed_lines

    return speed_lines(plan, found, pace)
