"""`solve pitch`, `disc`, `width` and `length`: the limit of a size, or all sizes that will do."""

from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import NO_SOLUTION, UNDECIDED, about
from benchdragon.cli.console import print_explanation, print_json, shown_progress
from benchdragon.cli.options import not_with, only_with, plan_to_walk, take, together, verb
from benchdragon.cli.parsing import parse_lengths
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
from benchdragon.progress import Progress

if TYPE_CHECKING:
    from benchdragon.analysis.proof import Claim
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.size import FeasibleSizes


# What the questions of all sizes take besides PLAN and --set.
size_options = together(
    click.option(
        "--range",
        "span",
        metavar="LOW..HIGH",
        help=N_(
            "All sizes from LOW to HIGH, in metres, for which the walk is safe: no contact, "
            "and the margin kept."
        ),
    ),
    click.option(
        "--count", type=click.IntRange(2, 10_000), default=50, help=N_("Sizes tried by --range.")
    ),
    take("prove"),
    written_options,
    take("json", "brackets", "explain", "shared"),
)


@verb("solve pitch spiral-in --set disc.radius=4.5")
@take("plan")
@click.option(
    "--method",
    type=click.Choice(["exact", "traversal"]),
    default="exact",
    help=N_("exact, or the paper's traversal of pitches in steps."),
)
@click.option(
    "--pitch-step",
    type=click.FloatRange(min=1e-4, max=1.0),
    default=0.002,
    help=N_("Step of the traversal's pitches, in metres."),
)
@click.option(
    "--time-step",
    type=click.FloatRange(min=1e-2, max=100.0),
    default=1.0,
    help=N_("Time step of the traversal's contact checks, in seconds."),
)
@size_options
def pitch(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """The smallest pitch of the spiral with which the walk is safe.

    Safe means here: no contact, and the margin kept. A spiral needs an end: --set disc.radius=4.5,
    for example. Exit code 4: there is no such pitch; 5: undecided.
    """
    stepped = options["method"] == "traversal"
    not_with("--range", options["span"] is not None, "method")
    not_with("--method traversal", stepped, "prove")
    only_with("--method traversal", stepped, "pitch_step", "time_step")
    return _solve_size("pitch", plan, settings, quiet, options)


# Questions that differ by the size alone.
SIZES = {
    "disc": N_(
        "The smallest radius of the disc with which the walk is safe.\n\nSafe means here: no "
        "contact, and the margin kept. It needs a disc to begin with: --set disc.radius=4.5, for "
        "example. Exit code 4: there is no such radius; 5: undecided."
    ),
    "width": N_(
        "The greatest width of the benches with which the walk is safe.\n\nSafe means here: no "
        "contact, and the margin kept. A spiral needs an end: --set disc.radius=4.5, for example. Exit "
        "code 4: there is no such width; 5: undecided."
    ),
    "length": N_(
        "The greatest length of the benches with which the walk is safe.\n\nSafe means here: no "
        "contact, and the margin kept. The head's length stays. A spiral needs an end: --set "
        "disc.radius=4.5, for example. Exit code 4: there is no such length; 5: undecided."
    ),
}


def size_question(name: str) -> click.Command:
    """The question of a size, which has no options of its own."""

    @verb(f"solve {name} spiral-in --set disc.radius=4.5", name=name, help=SIZES[name])
    @take("plan")
    @size_options
    def asked(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
        return _solve_size(name, plan, settings, quiet, options)

    return asked


SIZE_QUESTIONS = (pitch, *map(size_question, SIZES))


def _solve_size(
    name: str, plan: str, settings: tuple[str, ...], quiet: bool, options: dict[str, Any]
) -> int:
    """The limit of a size, or with --range all sizes that will do."""
    ranged = options["span"] is not None
    not_with("--range", ranged, "prove", "brackets", "output")
    only_with("--range", ranged, "count")
    refuse_written(options)
    read = plan_to_walk(plan, settings, quiet)
    if ranged:
        return _print_sizes(name, read, options, quiet)
    return _print_limit(name, read, plan, options, quiet)


def _print_limit(name: str, plan: "Plan", source: str, options: dict[str, Any], quiet: bool) -> int:
    from benchdragon.solve.size_family import question

    tried: list[str] = []
    claims: list[Claim] = []
    with shown_progress(quiet) as progress:
        found = _limit(name, plan, options, _kept(progress, tried), claims)
    lines = _limit_lines(name, plan, options, found, tried) if options["explain"] else []
    asked = question(name)
    up = asked.sense > 0.0
    size = shown(found, up=up)
    better = None if size is None else plan.with_values(dict.fromkeys(asked.keys, size))
    proved = claims if found.status == "proved" else []
    files = write_found(source, options, better)
    files += write_proved(plan, options["certificate"], proved, [])
    print_solved(plan, _(asked.text), found, options, lines, files, up=up)
    return exit_code(found)


def _kept(progress: Progress, tried: list[str]) -> Progress:
    """The same progress; the texts of sizes tried are kept."""

    def told(share: float, text: str) -> None:
        if text:
            tried.append(text)
        progress(share, text)

    return told


def _stepped(options: dict[str, Any]) -> bool:
    """Whether the paper's traversal is asked for, which `pitch` alone knows."""
    return options.get("method") == "traversal"


def _limit(
    name: str, plan: "Plan", options: dict[str, Any], progress: Progress, claims: "list[Claim]"
) -> Answer:
    """The limit of a size, exactly or as the paper finds it."""
    if _stepped(options):
        from benchdragon.paper.traversal import traversed_pitch

        return traversed_pitch(plan, options["pitch_step"], options["time_step"], progress=progress)
    from benchdragon.solve.size import limit

    return limit(plan, name, prove=options["prove"], progress=progress, claims=claims)


def _limit_lines(
    name: str, plan: "Plan", options: dict[str, Any], found: Answer, tried: list[str]
) -> list[str]:
    """The lines of --explain for a limit."""
    if _stepped(options):
        from benchdragon.paper.explanation import traversal_lines

        return traversal_lines(found, options["pitch_step"], options["time_step"], tried)
    from benchdragon.explain.answers import limit_lines

    return limit_lines(plan, name, found, tried)


def _print_sizes(name: str, plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    """All sizes of a range that will do."""
    from benchdragon.solve.size import feasible_sizes

    low, high = parse_lengths("--range", options["span"])
    count = options["count"]
    with shown_progress(quiet) as progress:
        found = feasible_sizes(plan, name, low, high, count, progress=progress)
    lines: list[str] = []
    if options["explain"]:
        from benchdragon.explain.answers import spans_lines

        lines = spans_lines(found, low, high, count)
    if options["as_json"]:
        print_json({**_sizes_json(found), **about(plan, lines)})
    else:
        _echo_sizes(found)
        print_explanation(lines)
    return 0 if found.spans else UNDECIDED if found.undecided else NO_SOLUTION


def _sizes_json(found: "FeasibleSizes") -> dict[str, Any]:
    """Sizes that will do as plain data, m."""
    return {
        "safe": [[span.low, span.high] for span in found.spans],
        "tried": [span.tried for span in found.spans],
        "borders": [list(span.borders) for span in found.spans],
        "step": found.step,
        "undecided": found.undecided,
    }


def _echo_sizes(found: "FeasibleSizes") -> None:
    """Sizes that will do, for readers."""
    from benchdragon.solve.size import undecided_text

    for span in found.spans:
        text = _("safe from {low} m to {high} m (sizes tried there: {tried}, {step} m apart)")
        ends = {"low": f"{span.low:.12g}", "high": f"{span.high:.12g}", "step": f"{found.step:.4g}"}
        click.echo(text.format(tried=span.tried, **ends))
        for border in span.borders:
            text = _("  {size} m is a border: just beyond it the walk is not safe")
            click.echo(text.format(size=f"{border:.12g}"))
    if not found.spans:
        click.echo(_("no size tried is safe"))
    if found.undecided:
        click.echo(undecided_text(found.undecided))
