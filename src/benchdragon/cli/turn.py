"""`solve turn`: the best turn of a family, and how much better another may be at most."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import UNDECIDED, about, print_title
from benchdragon.cli.console import (
    print_explanation,
    print_files,
    print_json,
    shown_progress,
    turn_lines,
)
from benchdragon.cli.options import only_with, plan_to_walk, take, verb
from benchdragon.cli.solved import refuse_written, write_found, written_options
from benchdragon.i18n import N_, _
from benchdragon.progress import part

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.turn import BestTurn
    from benchdragon.solve.turn_goal import TurnGoal


@verb("solve turn turn --set turn.family=arc-line-arc")
@take("plan")
@click.option(
    "--objective",
    type=click.Choice(["way", "length", "speed", "disc", "acceleration"]),
    default="way",
    help=N_(
        "The shortest path inside the disc, the shortest turn itself, the greatest head speed, "
        "the smallest disc, or the least peak acceleration."
    ),
)
@click.option(
    "--least-radius",
    type=click.FloatRange(min=0.0, max=1e6),
    default=0.0,
    help=N_("No bend is tighter, in metres."),
)
@click.option(
    "--longest",
    type=click.FloatRange(min=0.0, min_open=True, max=1e6),
    help=N_("The turn itself is no longer, in metres."),
)
@click.option(
    "--longest-way",
    type=click.FloatRange(min=0.0, min_open=True, max=1e6),
    help=N_("The path inside the disc is no longer, in metres."),
)
@click.option(
    "--prove",
    is_flag=True,
    help=N_(
        "Prove in ball arithmetic how much better another turn of the family may be at most. "
        "Ctrl-C ends this early, with what was shown till then."
    ),
)
@click.option(
    "--within",
    type=click.FloatRange(min=1e-6, max=1e3),
    default=1e-3,
    help=N_("With --prove: how much that is to be, in metres or metres a second."),
)
@click.option(
    "--boxes",
    type=click.IntRange(1, 1_000_000),
    default=20_000,
    help=N_("With --prove: the greatest number of boxes of turns to examine."),
)
@written_options
@take("json", "explain", "shared")
def turn(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """A search for the best turn of the plan's family.

    The plan's route is a turn, and its turn.family names the family. A better turn than the one found
    may exist; --prove bounds how much better. Exit code 4: no turn was found that keeps the limits; 5:
    --prove did not get as near as --within says.
    """
    from benchdragon.solve.turn import best_turn
    from benchdragon.solve.turn_goal import TurnGoal

    only_with("--prove", options["prove"], "within", "boxes")
    refuse_written(options)
    read = plan_to_walk(plan, settings, quiet)
    longest, longest_way = (options[name] or math.inf for name in ("longest", "longest_way"))
    goal = TurnGoal(options["objective"], options["least_radius"], longest, longest_way)
    if options["prove"]:
        return _prove_turn(read, plan, goal, options, quiet)
    with shown_progress(quiet) as progress:
        best = best_turn(read, goal, progress=progress)
    files = write_found(plan, options, best.plan)
    _print_turn(read, best, goal.objective, options, files)
    return 0


def _prove_turn(
    plan: "Plan", source: str, goal: "TurnGoal", options: dict[str, Any], quiet: bool
) -> int:
    """Print the best turn, and how much better another may be at most."""
    from benchdragon.files import write_whole
    from benchdragon.solve import turn_proof
    from benchdragon.solve.turn import best_turn
    from benchdragon.solve.turn_certificate import certificate_of

    turn_proof.turns_of(plan, goal)  # unprovable questions are refused before the search
    with shown_progress(quiet) as progress:
        best = best_turn(plan, goal, progress=part(progress, 0.0, 0.5))
        value, ends = best.objective.value, {"gap": options["within"], "most": options["boxes"]}
        proof = turn_proof.proved_bound(plan, goal, value, **ends, progress=part(progress, 0.5, 1.0))
    kept: Path | None = options["certificate"]
    files = write_found(source, options, best.plan)
    if kept is not None:
        write_whole(kept, certificate_of(plan, goal, proof).model_dump_json())
        files.append(kept)
    shown = turn_proof.with_proof(best, proof)
    _print_turn(plan, shown, goal.objective, options, files, proof=turn_proof.proof_json(proof))
    return 0 if proof.complete else UNDECIDED


def _print_turn(
    plan: "Plan", best: "BestTurn", objective: str, options: dict[str, Any], files: list[Path],
    **more: Any,
) -> None:  # fmt: skip
    """The best turn of a plan, as text or JSON."""
    lines: list[str] = []
    if options["explain"]:
        from benchdragon.explain import answers as explain_answers

        lines = explain_answers.turn_lines(best)
    if options["as_json"]:
        print_json({**best.as_json(), **more, **about(plan, lines)}, files)
        return
    print_title(plan)
    _echo_turn(best, objective)
    print_files(files)
    print_explanation(lines)


def _echo_turn(best: "BestTurn", objective: str) -> None:
    """The best turn for readers."""
    from benchdragon.solve.turn_goal import OBJECTIVES

    click.echo(
        _("{name}: {value} {unit}  (best found)").format(
            name=_(OBJECTIVES[objective]), value=f"{best.objective.value:.6f}", unit=best.objective.unit
        )
    )
    for line in turn_lines(best):
        click.echo(f"  {line}")
