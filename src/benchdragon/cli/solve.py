"""The verb `solve`: what a plan may be at its limits."""

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import print_answer, print_title
from benchdragon.cli.console import print_explanation, print_files, progress, turn_lines
from benchdragon.cli.options import (
    BESIDE,
    FILE,
    WITHOUT,
    announce_compiling,
    brackets_option,
    explain_option,
    force_option,
    json_option,
    plan_options,
    prove_option,
    refuse_strays,
    shared_options,
)
from benchdragon.cli.parsing import check_ending, parse_lengths
from benchdragon.errors import InputError
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.version import __version__

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.head_speed import Pace

NO_SOLUTION, UNDECIDED = 4, 5


@click.command(
    help=N_(
        "What a plan may be at its limits.\n\nWHAT is pitch (the smallest with which the whole walk "
        "stays clear), disc (the smallest radius), width or length (the greatest of a bench; the "
        "head's length stays), speed (the greatest constant head speed that keeps the plan's limits), "
        "or turn (the best turn of the plan's family). PLAN is a *.dragon.toml file or the name of a "
        "built-in plan. Exit code 4: there is none."
    )
)
@click.argument("what", metavar="WHAT")
@plan_options
@click.option(
    "--method",
    type=click.Choice(["exact", "traversal"]),
    default="exact",
    show_default=True,
    help=N_("exact, or the paper's traversal of pitches in steps (pitch only)."),
)
@click.option(
    "--pitch-step",
    type=click.FloatRange(min=1e-4, max=1.0),
    default=0.002,
    show_default=True,
    help=N_("Step of the traversal's pitches, in metres."),
)
@click.option(
    "--time-step",
    type=click.FloatRange(min=1e-2, max=100.0),
    default=1.0,
    show_default=True,
    help=N_("Step of the traversal's looks for contact, in seconds."),
)
@click.option(
    "--range",
    "span",
    metavar="LOW..HIGH",
    help=N_("All sizes from LOW to HIGH, in metres, with which the walk stays clear."),
)
@click.option(
    "--count",
    type=click.IntRange(2, 10_000),
    default=50,
    show_default=True,
    help=N_("Sizes tried by --range."),
)
@prove_option
@click.option(
    "--pace",
    "pace_file",
    type=FILE,
    metavar="FILE",
    help=N_(
        "With speed: write the plan walked at its own head speed, slowed down only where a limit "
        "wants it."
    ),
)
@click.option(
    "--objective",
    type=click.Choice(["way", "length", "speed", "disc", "acceleration"]),
    default="way",
    show_default=True,
    help=N_(
        "With turn: the shortest way inside the disc, the shortest turn itself, the greatest head "
        "speed, the smallest disc, or the least peak acceleration."
    ),
)
@click.option(
    "--least-radius",
    type=click.FloatRange(min=0.0, max=1e6),
    default=0.0,
    help=N_("With turn: no bend is tighter, in metres."),
)
@click.option(
    "--longest",
    type=click.FloatRange(min=0.0, min_open=True, max=1e6),
    help=N_("With turn: the turn itself is no longer, in metres."),
)
@click.option(
    "--longest-way",
    type=click.FloatRange(min=0.0, min_open=True, max=1e6),
    help=N_("With turn: the whole way inside the disc is no longer, in metres."),
)
@click.option(
    "--plan-file",
    type=FILE,
    metavar="FILE",
    help=N_("With turn: write the plan with the turn that was found."),
)
@force_option
@json_option
@brackets_option
@explain_option
@shared_options
def solve(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print an answer, as text or JSON."""
    from benchdragon.plans.schema import read_plan

    _refuse_strays(options)
    for name, path in (("--pace", options["pace_file"]), ("--plan-file", options["plan_file"])):
        if path is not None:
            check_ending(name, path, [".toml"])
    read = read_plan(plan, settings)
    announce_compiling(quiet)
    if options["span"] is not None:
        return _print_sizes(read, options, quiet)
    if options["what"] == "speed":
        return _print_speed(read, options, quiet)
    if options["what"] == "turn":
        return _print_turn(read, options, quiet)
    tried: list[str] = []
    with progress(quiet, 1) as advance:

        def tell(text: str) -> None:
            tried.append(text)
            advance(0.0, text)

        found = _solved(read, options, tell)
    from benchdragon.solve.trials import question

    lines = _solved_lines(read, options, found, tried) if options["explain"] else []
    asked = question(options["what"])
    _print_solved(read, _(asked.text), found, options, lines, up=asked.sense > 0.0)
    return _code(found)


def _explained(lines: list[str]) -> dict[str, list[str]]:
    """The lines of --explain as a part of JSON, if there are any."""
    return {"explanation": lines} if lines else {}


def _code(found: Answer) -> int:
    """The exit code of an answer."""
    return {"infeasible": NO_SOLUTION, "undecided": UNDECIDED}.get(found.status, 0)


def _refuse_strays(options: dict[str, Any]) -> None:
    """Refuse options that say nothing about what is asked for, rather than overlook them."""
    what, stepped = options["what"], options["method"] == "traversal"
    turning, sized, ranged = what == "turn", what not in {"speed", "turn"}, options["span"] is not None
    refuse_strays(
        ("pace_file", what == "speed", BESIDE, what),
        ("brackets", not turning, BESIDE, what),
        *((name, turning, BESIDE, what) for name in ("objective", "least_radius", "longest")),
        *((name, turning, BESIDE, what) for name in ("longest_way", "plan_file")),
        *((name, sized, BESIDE, what) for name in ("prove", "method", "span")),
        *((name, not ranged, BESIDE, "--range") for name in ("prove", "method")),
        ("count", ranged, WITHOUT, "--range"),
        *((name, stepped, WITHOUT, "--method traversal") for name in ("pitch_step", "time_step")),
        ("force", bool(options["pace_file"] or options["plan_file"]), WITHOUT, "--pace, --plan-file"),
    )


def _solved_lines(plan: "Plan", options: dict[str, Any], found: Answer, tried: list[str]) -> list[str]:
    """The lines of --explain for a limit."""
    from benchdragon.explain.answers import limit_lines
    from benchdragon.paper.explanation import traversal_lines

    if options["method"] == "exact":
        return limit_lines(plan, options["what"], found, tried)
    return traversal_lines(found, options["pitch_step"], options["time_step"], tried)


def _print_solved(
    plan: "Plan",
    name: str,
    found: Answer,
    options: dict[str, Any],
    lines: list[str],
    *,
    up: bool = False,
    **more: Any,
) -> None:
    """An answer as JSON, with `more` beside it, or for readers, rounded `up` or down."""
    if options["as_json"]:
        about = {**_explained(lines), "plan_sha256": plan.sha256, "version": __version__}
        click.echo(json.dumps(found.as_json(**more, **about)))
        return
    print_title(plan)
    print_answer(name, found, up=up, brackets=options["brackets"])
    for text in found.assumptions:
        click.echo(f"  {text}")
    print_explanation(lines)


def _print_speed(plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    """The greatest head speed; with --pace also a pace, as a plan of its own."""
    from benchdragon.files import refuse_existing, whole_file
    from benchdragon.solve.head_speed import greatest_head_speed, slowed, with_pace

    path: Path | None = options["pace_file"]
    if path is None:
        with progress(quiet, 1) as advance:
            found = greatest_head_speed(plan, advance=advance)
        lines = _speed_lines(plan, found, None) if options["explain"] else []
        _print_solved(plan, _("greatest head speed"), found, options, lines)
        return _code(found)
    refuse_existing([path], options["force"])
    with progress(quiet, 1) as advance:
        pace = slowed(plan, advance=advance)
    with whole_file(path) as temporary:
        temporary.write_text(with_pace(plan, pace).toml(), encoding="utf-8")
    more: dict[str, Any] = {"pace": {"seconds": pace.seconds, "saved": pace.saved, "file": str(path)}}
    lines = _speed_lines(plan, pace.steady, pace) if options["explain"] else []
    json_lines = lines if options["as_json"] else []
    _print_solved(plan, _("greatest head speed"), pace.steady, options, json_lines, **more)
    if not options["as_json"]:
        click.echo(
            _("slowing down only where it must the walk takes {seconds} s, {saved} s less").format(
                seconds=f"{pace.seconds:.2f}", saved=f"{pace.saved:.2f}"
            )
        )
        print_files([path])
        print_explanation(lines)
    return _code(pace.steady)


def _speed_lines(plan: "Plan", found: Answer, pace: "Pace | None") -> list[str]:
    """The lines of --explain for a head speed."""
    from benchdragon.explain.answers import speed_lines

    return speed_lines(plan, found, pace)


def _print_turn(plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    """The best turn; with --plan-file also the plan with it."""
    from benchdragon.files import refuse_existing, whole_file
    from benchdragon.solve.turn import OBJECTIVES, STAGES, Wish, best_turn

    wish = Wish(
        options["objective"],
        options["least_radius"],
        options["longest"] or math.inf,
        options["longest_way"] or math.inf,
    )
    path: Path | None = options["plan_file"]
    refuse_existing([] if path is None else [path], options["force"])
    with progress(quiet, STAGES) as advance:
        best = best_turn(plan, wish, advance=advance)
    if path is not None:
        with whole_file(path) as temporary:
            temporary.write_text(best.plan.toml(), encoding="utf-8")
    lines: list[str] = []
    if options["explain"]:
        from benchdragon.explain import answers as explain_answers

        lines = explain_answers.turn_lines(best)
    if options["as_json"]:
        about = {**_explained(lines), "plan_sha256": plan.sha256, "version": __version__}
        click.echo(json.dumps({**best.as_json(), **about}))
        return 0
    print_title(plan)
    click.echo(
        _("{name}: {value} {unit}  (best found)").format(
            name=_(OBJECTIVES[wish.objective]),
            value=f"{best.objective.value:.6f}",
            unit=best.objective.unit,
        )
    )
    for line in turn_lines(best):
        click.echo(f"  {line}")
    if path is not None:
        print_files([path])
    print_explanation(lines)
    return 0


def _solved(plan: "Plan", options: dict[str, Any], advance: Any) -> Answer:
    from benchdragon.paper.traversal import traversed_pitch
    from benchdragon.solve.size import limit

    if options["method"] == "exact":
        return limit(plan, options["what"], prove=options["prove"], advance=advance)
    if options["what"] != "pitch" or options["prove"]:
        raise InputError(_("the traversal answers for pitch alone, and proves nothing"))
    return traversed_pitch(plan, options["pitch_step"], options["time_step"], advance=advance)


def _print_sizes(plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    from benchdragon.solve.size import undecided_text, walkable_sizes

    low, high = parse_lengths("--range", options["span"])
    with progress(quiet, options["count"]) as advance:
        sizes = walkable_sizes(
            plan, options["what"], low, high, options["count"], advance=lambda text: advance(1.0, text)
        )
    lines: list[str] = []
    if options["explain"]:
        from benchdragon.explain.answers import spans_lines

        lines = spans_lines(sizes, low, high, options["count"])
    code = 0 if sizes.spans else UNDECIDED if sizes.undecided else NO_SOLUTION
    if options["as_json"]:
        about = {**_explained(lines), "plan_sha256": plan.sha256, "version": __version__}
        found = {
            "walkable": [[span.low, span.high] for span in sizes.spans],
            "tried": [span.tried for span in sizes.spans],
            "borders": [list(span.borders) for span in sizes.spans],
            "step": sizes.step,
            "undecided": sizes.undecided,
        }
        click.echo(json.dumps({**found, **about}))
        return code
    for span in sizes.spans:
        text = _("walkable from {low} m to {high} m (sizes tried there: {tried}, {step} m apart)")
        ends = {"low": f"{span.low:.12g}", "high": f"{span.high:.12g}", "step": f"{sizes.step:.4g}"}
        click.echo(text.format(tried=span.tried, **ends))
        for border in span.borders:
            text = _("  {size} m is a border: just beyond it the walk fails")
            click.echo(text.format(size=f"{border:.12g}"))
    if not sizes.spans:
        click.echo(_("no size tried is walkable"))
    if sizes.undecided:
        click.echo(undecided_text(sizes.undecided))
    print_explanation(lines)
    return code
