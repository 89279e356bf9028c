"""The verb `sweep`: many questions about one plan."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.completed import keys
from benchdragon.cli.console import print_json, print_rows, shown_progress
from benchdragon.cli.options import (
    FOLDER,
    dances_options,
    given_options,
    not_with,
    only_with,
    plan_to_walk,
    take,
    verb,
)
from benchdragon.cli.parsing import parse_names
from benchdragon.cli.tolerance import DEVIATIONS, deviation_options, given_deviations
from benchdragon.errors import InputError, MachineError
from benchdragon.i18n import N_, _
from benchdragon.number_format import finite_or_none

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan
    from benchdragon.sweeps.points import Points
    from benchdragon.sweeps.questions import RandomDances
    from benchdragon.sweeps.sweep import Design, Sweep

METHODS = ("latin-hypercube", "sobol")


@verb("sweep spiral-in --vary route.pitch=0.5..0.6..0.01 -o out/pitch")
@take("maybe a plan")
@click.option(
    "--vary",
    multiple=True,
    metavar="KEY=VALUES",
    shell_complete=keys,
    help=N_(
        "A key of the plan and its values: route.pitch=0.45..0.6..0.01 (first, last, step) or "
        "dragon.width=0.25,0.3; with --sample a range, route.pitch=0.45..0.6. May be repeated."
    ),
)
@click.option(
    "--points",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help=N_("Points from a CSV or Parquet file whose columns are keys of the plan."),
)
@click.option(
    "--sample", type=click.IntRange(1, 1_000_000), help=N_("Number of points drawn from the ranges.")
)
@click.option(
    "--method", type=click.Choice(METHODS), default=METHODS[0], help=N_("How --sample draws.")
)
@click.option(
    "--ask",
    default="first_contact",
    metavar="LIST",
    help=N_(
        "Questions, with commas: first_contact, clearance, greatest_speed, greatest_head_speed, "
        "smallest_pitch, disc, width, length, tolerance, turn."
    ),
)
@dances_options(
    N_("Seed of --sample and of the random dances."),
    N_("Random dances that the question tolerance walks at each point."),
)
@deviation_options
@click.option(
    "--refine",
    type=click.IntRange(1, 1_000_000),
    help=N_("At most so many further points, where the answers change most (one key or two)."),
)
@click.option(
    "--to",
    type=click.FloatRange(1e-9, 1.0),
    default=1e-3,
    help=N_("How near --refine brings neighbouring points, as a share of the range or of the answers."),
)
@take("place")
@click.option("-o", "--output", type=FOLDER, metavar="DIR", help=N_("Folder for the rows."))
@click.option(
    "--status", type=FOLDER, metavar="DIR", help=N_("Tell how far the sweep in a folder has come.")
)
@take("json", "shared")
def sweep(plan: str | None, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Many questions: the answers of a plan at many values of its keys.

    Each combination of the values behind --vary is a point; --points takes them from a file, --sample
    draws them. The answers are rows of Parquet files in a folder. The same command goes on where one
    was broken off.
    """
    from benchdragon.sweeps.sweep import read_sweep

    _refuse_strays(plan, options)
    if options["status"] is not None:
        folder, found = options["status"], read_sweep(options["status"])
    else:
        folder, found = options["output"], _run(str(plan), settings, quiet, options)
    print_sweep(found, folder, as_json=options["as_json"])
    lost = sum(counts["lost"] for counts in _counts(found).values())
    if lost:
        text = _("{count} answers were lost with their workers: see the column of messages")
        raise MachineError(text.format(count=lost))
    return 0


def _refuse_strays(plan: str | None, options: dict[str, Any]) -> None:
    status = options["status"] is not None
    if status and given_options().difference({"status", "as_json", "quiet", "lang"}):
        raise InputError(_("{option} goes alone, without a plan").format(option="--status"))
    if options["sample"] is not None and not options["vary"] and options["points"] is None:
        raise InputError(_("--sample needs ranges: --vary KEY=LOW..HIGH"))
    if not status and (plan is None or options["output"] is None):
        raise InputError(_("expected a PLAN and -o DIR, or --status DIR"))
    if not status and bool(options["vary"]) is (options["points"] is not None):
        raise InputError(_("expected --vary or --points, and not both"))
    tolerance = "tolerance" in _asked(options)
    not_with("--points", bool(options["points"]), "sample")
    only_with("--sample", options["sample"] is not None, "method")
    only_with("--sample, --ask tolerance", options["sample"] is not None or tolerance, "seed")
    only_with("--ask tolerance", tolerance, "draws", *DEVIATIONS)
    only_with("--refine", options["refine"] is not None, "to")
    not_with("--on " + options["on"], "://" in options["on"], "workers")


def _run(plan: str, settings: tuple[str, ...], quiet: bool, options: dict[str, Any]) -> "Sweep":
    from benchdragon.parallel import place
    from benchdragon.sweeps.sweep import run

    design = _design(plan_to_walk(plan, settings, quiet), options)
    with shown_progress(quiet) as progress:
        return run(design, place(options["on"], options["workers"]), options["output"], progress)


def _design(plan: "Plan", options: dict[str, Any]) -> "Design":
    from benchdragon.sweeps.questions import questions
    from benchdragon.sweeps.refine import Refinement
    from benchdragon.sweeps.sweep import Design

    asked = questions(_asked(options))
    names = tuple(question.name for question in asked)
    refinement = Refinement(options["refine"] or 0, options["to"])
    return Design(plan, _points(options), names, _dances(options), refinement)


def _asked(options: dict[str, Any]) -> list[str]:
    from benchdragon.sweeps.questions import QUESTIONS

    return parse_names("--ask", options["ask"], [*QUESTIONS])


def _points(options: dict[str, Any]) -> "Points":
    from benchdragon.sweeps.points import grid_points, parse_vary, read_points, sampled_points

    if options["points"] is not None:
        return read_points(options["points"])
    count = options["sample"]
    varied = parse_vary(options["vary"], ranges=count is not None)
    if count is None:
        return grid_points(varied)
    return sampled_points(varied, count, options["seed"], options["method"])


def _dances(options: dict[str, Any]) -> "RandomDances":
    from benchdragon.solve.tolerance import CASES, Deviations
    from benchdragon.sweeps.questions import RandomDances

    given = given_deviations(options)
    deviations = Deviations(**given) if given else CASES["all"].deviations
    return RandomDances(options["draws"], deviations, options["seed"])


def _counts(found: "Sweep") -> dict[str, Counter[str]]:
    """How many answers of each status each question has."""
    return {one.name: Counter(map(str, found.texts(f"{one.name}.status"))) for one in found.questions}


def print_sweep(found: "Sweep", folder: Path, *, as_json: bool) -> None:
    """How many points there are, and for each question how many answers of each status, from..to."""
    from benchdragon.sweeps.questions import STATES

    counts, ranges = _counts(found), {one.name: _range(found, one.name) for one in found.questions}
    refined = found.about["refine"]
    wanted = int(found.about["points"]["count"]) + (refined["most"] if refined else 0)
    if as_json:
        asked = {
            name: {"status": dict(counts[name]), "least": least, "greatest": greatest}
            for name, (least, greatest) in ranges.items()
        }
        about = {"folder": str(folder), "points": len(found.table), "wanted": wanted}
        plan = {"plan_sha256": found.about["plan_sha256"], "keys": list(found.keys)}
        print_json({**about, "complete": found.complete, **plan, "questions": asked})
        return
    rows = []
    for one in found.questions:
        least, greatest = ("-" if end is None else f"{end:.6g}" for end in ranges[one.name])
        states = "\n".join(f"{_(STATES[state])}: {n}" for state, n in counts[one.name].most_common())
        unit = f" ({one.unit})" if one.unit else ""
        rows.append((f"{_(one.text)}{unit}", least, greatest, states))
    title = _("{done} points of {keys}").format(done=len(found.table), keys=", ".join(found.keys))
    print_rows(title, (_("question"), _("least"), _("greatest"), _("answers")), rows)
    if not found.complete:
        text = _("{done} of {wanted} points are done: the same command goes on")
        if refined:
            text = _("{done} of at most {wanted} points are done: the same command goes on")
        click.echo(text.format(done=len(found.table), wanted=wanted))
    click.echo(_("rows: {folder}").format(folder=folder))


def _range(found: "Sweep", name: str) -> tuple[float | None, float | None]:
    """The least and the greatest value of a question."""
    import numpy as np

    values = found.column(f"{name}.value")
    known = values[~np.isnan(values)]
    if not known.size:
        return None, None
    return finite_or_none(float(known.min())), finite_or_none(float(known.max()))
