"""The verbs that judge a walk: check, and solve."""

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon import __version__
from benchdragon.answer import Answer
from benchdragon.errors import InputError
from benchdragon.messages import N_, _, language
from benchdragon.options import (
    announce_compiling,
    explain_option,
    folder_option,
    json_option,
    plan_options,
    shared_options,
)
from benchdragon.show import print_explanation, print_files, progress, turn_lines

if TYPE_CHECKING:
    from benchdragon.check import Report
    from benchdragon.pace import Pace
    from benchdragon.plan import Plan

UNSAFE, NO_SOLUTION, UNDECIDED = 1, 4, 5


@click.command(
    help=N_(
        "Whether a walk is safe: no benches touch, margin and limits are kept.\n\nPLAN is a "
        "*.dragon.toml file or the name of a built-in plan: spiral-in, turn. Exit code 0: safe; "
        "1: not; 4: it cannot be walked; 5: undecided."
    )
)
@plan_options
@click.option("--prove", is_flag=True, help=N_("Establish the answer again in rigorous arithmetic."))
@folder_option
@click.option(
    "--format",
    "formats",
    default="xlsx,png",
    show_default=True,
    metavar="LIST",
    help=N_("What to write: xlsx, png, svg, pdf."),
)
@json_option
@explain_option
@shared_options
def check(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print a report, as text or JSON, and write tables and pictures of it."""
    from benchdragon.check import STEPS
    from benchdragon.check import check as checked
    from benchdragon.plan import read_plan

    read = read_plan(plan, settings)
    announce_compiling(quiet)
    folder: Path | None = options["output"]
    files: list[Path] = []
    if folder is not None:
        from benchdragon.verdict_files import planned_files, write_files

        files = planned_files(folder, options["formats"].split(","), options["force"])
    with progress(quiet, STEPS) as advance:
        report = checked(read, advance, prove=options["prove"])
        if files:
            advance(0.0, _("writing"))
            write_files(report, files)
    lines: list[str] = []
    if options["explain"]:
        from benchdragon.explain_contact import check_lines

        lines = check_lines(report)
    if options["as_json"]:
        click.echo(json.dumps({**report_json(report), **_explained(lines)}))
    else:
        print_report(report)
        if files:
            print_files(files)
        print_explanation(lines)
    return 0 if report.safe else UNSAFE if report.decided else UNDECIDED


def _explained(lines: list[str]) -> dict[str, list[str]]:
    """The lines of --explain as a part of JSON, if there are any."""
    return {"explanation": lines} if lines else {}


def report_json(report: "Report") -> dict[str, Any]:
    """A report as plain data."""
    about = {"plan_sha256": report.plan.sha256, "version": __version__}
    contact = report.first_contact
    return {
        "safe": report.safe,
        "proved": report.proved,
        "start": report.start,
        "end": report.end,
        "first_contact": None if contact is None else contact.as_json(**about),
        "clearance": report.clearance.as_json(**about),
        "greatest_speed": report.greatest_speed.as_json(**about),
        "findings": [finding.as_json() for finding in report.findings],
        **about,
    }


def print_title(plan: "Plan") -> None:
    """What people call a plan, if it says."""
    if title := plan.title(language()):
        click.echo(title)


def print_report(report: "Report") -> None:
    """A report for readers."""
    print_title(report.plan)
    if report.safe:
        text = _("SAFE from t = {start} s to t = {end} s")
        if report.proved:
            text = _("SAFE from t = {start} s to t = {end} s: proved that no benches come too near")
        click.echo(text.format(start=f"{report.start:g}", end=f"{report.end:.6g}"))
    elif report.decided:
        click.echo(_("NOT SAFE"))
    else:
        click.echo(_("UNDECIDED"))
    for finding in report.findings:
        click.echo(f"  {finding.text}")
    if report.first_contact is not None:
        print_answer(_("first contact"), report.first_contact)
    print_answer(_("least clearance"), report.clearance)
    print_answer(_("greatest speed of a handle"), report.greatest_speed)


def print_answer(name: str, answer: Answer) -> None:
    """An answer for readers: value, bracket, how it was established, where."""
    words = {
        "proved": _("proved"), "found": _("found"),
        "infeasible": _("no solution"), "undecided": _("undecided"),
    }  # fmt: skip
    if not math.isfinite(answer.value):
        text = _("no pair counts") if answer.status == "found" else words[answer.status]
        click.echo(f"{name}: {text}")
        return
    digits = 12 if answer.unit == "m" else 10
    if answer.status == "unlimited":
        text = _("{name}: no limit was met up to {value} {unit}")
        click.echo(text.format(name=name, value=f"{answer.value:.{digits}g}", unit=answer.unit))
        return
    click.echo(
        _("{name}: {value} {unit}  ({status}; between {lower} and {upper})").format(
            name=name,
            value=f"{answer.value:.{digits}g}",
            unit=answer.unit,
            status=words[answer.status],
            lower=f"{answer.lower:.16g}",
            upper=f"{answer.upper:.16g}",
        )
    )
    near = answer.witness
    if near is not None and len(near.benches) == 1:
        click.echo(
            _("  bench {a} at t = {t} s, head at {s} m of the route, at ({x}, {y}) m").format(
                a=near.benches[0],
                t="-" if near.time is None or math.isinf(near.time) else f"{near.time:.6f}",
                s=f"{near.s:.6f}",
                x=f"{near.point[0]:.6f}",
                y=f"{near.point[1]:.6f}",
            )
        )
    if near is not None and len(near.benches) == 2:
        features = "; ".join(
            _("bench {bench}: {feature}").format(bench=bench, feature=_(feature))
            for bench, feature in near.features
        )
        click.echo(
            _("  benches {a} and {b} at t = {t} s, at ({x}, {y}) m; {features}").format(
                a=near.benches[0],
                b=near.benches[1],
                t="-" if near.time is None else f"{near.time:.6f}",
                x=f"{near.point[0]:.6f}",
                y=f"{near.point[1]:.6f}",
                features=features,
            )
        )


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
    metavar="LOW:HIGH",
    help=N_("All sizes from LOW to HIGH, in metres, with which the walk stays clear."),
)
@click.option(
    "--count",
    type=click.IntRange(2, 10_000),
    default=50,
    show_default=True,
    help=N_("Sizes tried by --range."),
)
@click.option("--prove", is_flag=True, help=N_("Establish the answer again in rigorous arithmetic."))
@click.option(
    "--pace",
    "pace_file",
    type=click.Path(path_type=Path, dir_okay=False),
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
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help=N_("With turn: write the plan with the turn that was found."),
)
@click.option("--force", is_flag=True, help=N_("Overwrite files that are there already."))
@json_option
@explain_option
@shared_options
def solve(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print an answer, as text or JSON."""
    from benchdragon.plan import read_plan

    _refuse_strays(options)
    read = read_plan(plan, settings)
    announce_compiling(quiet)
    if options["span"]:
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
    from benchdragon.solve import question

    lines = _solved_lines(read, options, found, tried) if options["explain"] else []
    _print_solved(read, _(question(options["what"]).text), found, options["as_json"], lines)
    return {"infeasible": NO_SOLUTION, "undecided": UNDECIDED}.get(found.status, 0)


def _refuse_strays(options: dict[str, Any]) -> None:
    """Refuse options that say nothing about what is asked for, rather than overlook them."""
    what = options["what"]
    for name, given, goes in (
        ("--pace", options["pace_file"], what == "speed"),
        ("--objective", options["objective"] != "way", what == "turn"),
        ("--least-radius", options["least_radius"], what == "turn"),
        ("--longest", options["longest"], what == "turn"),
        ("--longest-way", options["longest_way"], what == "turn"),
        ("--plan-file", options["plan_file"], what == "turn"),
        ("--prove", options["prove"], what not in {"speed", "turn"}),
        ("--method", options["method"] != "exact", what not in {"speed", "turn"}),
        ("--range", options["span"], what not in {"speed", "turn"}),
    ):
        if given and not goes:
            raise InputError(_("{option} does not go with {what}").format(option=name, what=what))


def _solved_lines(plan: "Plan", options: dict[str, Any], found: Answer, tried: list[str]) -> list[str]:
    """The lines of --explain for a limit."""
    from benchdragon.explain_answers import limit_lines, traversal_lines

    if options["method"] == "exact":
        return limit_lines(plan, options["what"], found, tried)
    return traversal_lines(found, options["pitch_step"], options["time_step"], tried)


def _print_solved(
    plan: "Plan", name: str, found: Answer, as_json: bool, lines: list[str], **more: Any
) -> None:
    """An answer as JSON, with `more` beside it, or for readers."""
    if as_json:
        about = {**_explained(lines), "plan_sha256": plan.sha256, "version": __version__}
        click.echo(json.dumps(found.as_json(**more, **about)))
        return
    print_title(plan)
    print_answer(name, found)
    for text in found.assumptions:
        click.echo(f"  {text}")
    print_explanation(lines)


def _print_speed(plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    """The greatest head speed; with --pace also a pace, as a plan of its own."""
    from benchdragon.files import refuse_existing, whole_file
    from benchdragon.pace import greatest_head_speed, slowed, with_pace

    path: Path | None = options["pace_file"]
    if path is None:
        with progress(quiet, 1) as advance:
            found = greatest_head_speed(plan, advance=advance)
        lines = _speed_lines(plan, found, None) if options["explain"] else []
        _print_solved(plan, _("greatest head speed"), found, options["as_json"], lines)
        return UNDECIDED if found.status == "undecided" else 0
    refuse_existing([path], options["force"])
    with progress(quiet, 1) as advance:
        pace = slowed(plan, advance=advance)
    with whole_file(path) as temporary:
        temporary.write_text(with_pace(plan, pace).toml(), encoding="utf-8")
    more = {"pace": {"seconds": pace.seconds, "saved": pace.saved, "file": str(path)}}
    lines = _speed_lines(plan, pace.steady, pace) if options["explain"] else []
    json_lines = lines if options["as_json"] else []
    _print_solved(plan, _("greatest head speed"), pace.steady, options["as_json"], json_lines, **more)
    if not options["as_json"]:
        click.echo(
            _("slowing down only where it must the walk takes {seconds} s, {saved} s less").format(
                seconds=f"{pace.seconds:.2f}", saved=f"{pace.saved:.2f}"
            )
        )
        print_files([path])
        print_explanation(lines)
    return 0


def _speed_lines(plan: "Plan", found: Answer, pace: "Pace | None") -> list[str]:
    """The lines of --explain for a head speed."""
    from benchdragon.explain_answers import speed_lines

    return speed_lines(plan, found, pace)


def _print_turn(plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    """The best turn; with --plan-file also the plan with it."""
    from benchdragon.best_turn import OBJECTIVES, STAGES, Wish, best_turn
    from benchdragon.files import refuse_existing, whole_file

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
        from benchdragon import explain_answers

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
    from benchdragon.solve import limit
    from benchdragon.traversal import traversed_pitch

    if options["method"] == "exact":
        return limit(plan, options["what"], prove=options["prove"], advance=advance)
    if options["what"] != "pitch" or options["prove"]:
        raise InputError(_("the traversal answers for pitch alone, and proves nothing"))
    return traversed_pitch(plan, options["pitch_step"], options["time_step"], advance=advance)


def _print_sizes(plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    from benchdragon.solve import walkable_sizes

    try:
        low, high = (float(text) for text in options["span"].split(":"))
    except ValueError:
        raise InputError(
            _("--range wants LOW:HIGH in metres, not {text}").format(text=options["span"])
        ) from None
    with progress(quiet, options["count"]) as advance:
        spans = walkable_sizes(
            plan, options["what"], low, high, options["count"], advance=lambda text: advance(1.0, text)
        )
    lines: list[str] = []
    if options["explain"]:
        from benchdragon.explain_answers import spans_lines

        lines = spans_lines(spans, low, high, options["count"])
    if options["as_json"]:
        about = {**_explained(lines), "plan_sha256": plan.sha256, "version": __version__}
        click.echo(json.dumps({"walkable": [[span.low, span.high] for span in spans], **about}))
    for span in [] if options["as_json"] else spans:
        click.echo(
            _("walkable from {low} m to {high} m").format(
                low=f"{span.low:.12g}", high=f"{span.high:.12g}"
            )
        )
    if not spans and not options["as_json"]:
        click.echo(_("no size tried is walkable"))
    if not options["as_json"]:
        print_explanation(lines)
    return 0 if spans else NO_SOLUTION
