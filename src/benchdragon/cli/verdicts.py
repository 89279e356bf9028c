"""The verbs that judge a walk: check, and solve."""

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.console import print_explanation, print_files, progress, turn_lines
from benchdragon.cli.options import (
    BESIDE,
    FILE,
    WITHOUT,
    announce_compiling,
    brackets_option,
    explain_option,
    folder_option,
    json_option,
    plan_options,
    refuse_strays,
    shared_options,
)
from benchdragon.cli.parsing import check_ending, parse_lengths
from benchdragon.digits import decimals, figures
from benchdragon.errors import InputError
from benchdragon.i18n import N_, _, language
from benchdragon.model.answer import Answer, Witness
from benchdragon.version import __version__

if TYPE_CHECKING:
    from benchdragon.analysis.check import Report
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.head_speed import Pace

UNSAFE, NO_SOLUTION, UNDECIDED = 1, 4, 5


@click.command(
    help=N_(
        "Whether a walk is safe: no benches touch, margin and limits are kept.\n\nPLAN is a "
        "*.dragon.toml file or the name of a built-in plan: spiral-in, turn. Exit code 0: safe; "
        "1: not; 4: it cannot be walked; 5: undecided."
    )
)
@plan_options
@click.option(
    "--prove", is_flag=True, help=N_("Verify all positions behind the answer in ball arithmetic.")
)
@folder_option
@click.option(
    "--format",
    "formats",
    default="xlsx,png",
    show_default=True,
    metavar="LIST",
    help=N_("What to write: xlsx, png, svg, pdf."),
)
@click.option("--show-plan", is_flag=True, help=N_("Print the plan in effect too, as a plan file."))
@json_option
@brackets_option
@explain_option
@shared_options
def check(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print a report, as text or JSON, and write tables and pictures of it."""
    from benchdragon.analysis.check import STEPS
    from benchdragon.analysis.check import check as checked
    from benchdragon.plans.schema import read_plan

    refuse_strays(
        *((name, options["output"] is not None, WITHOUT, "-o") for name in ("formats", "force"))
    )
    read = read_plan(plan, settings)
    announce_compiling(quiet)
    folder: Path | None = options["output"]
    files: list[Path] = []
    if folder is not None:
        from benchdragon.export.check_files import planned_files, write_files

        files = planned_files(folder, options["formats"].split(","), options["force"])
    with progress(quiet, STEPS) as advance:
        report = checked(read, advance, prove=options["prove"])
        if files:
            advance(0.0, _("writing"))
            write_files(report, files)
    lines: list[str] = []
    if options["explain"]:
        from benchdragon.explain.contact import check_lines

        lines = check_lines(report)
    if options["as_json"]:
        from benchdragon.analysis.records import verdict_of

        shown = {"plan": read.data()} if options["show_plan"] else {}
        record = verdict_of(report).model_dump(mode="json")
        click.echo(json.dumps({**record, **_explained(lines), **shown}))
    else:
        print_report(report, options["brackets"])
        if files:
            print_files(files)
        print_explanation(lines)
        if options["show_plan"]:
            from benchdragon.plans.keys import commented

            click.echo("\n" + commented(read.data(), {}), nl=False)
    return 0 if report.safe else UNSAFE if report.decided else UNDECIDED


def _explained(lines: list[str]) -> dict[str, list[str]]:
    """The lines of --explain as a part of JSON, if there are any."""
    return {"explanation": lines} if lines else {}


def print_title(plan: "Plan") -> None:
    """What people call a plan, if it says."""
    if title := plan.title(language()):
        click.echo(title)


def print_report(report: "Report", brackets: bool = False) -> None:
    """A report for readers."""
    from benchdragon.analysis.check import peak_text

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
        print_answer(_("first contact"), report.first_contact, up=False, brackets=brackets)
        click.echo(_("until then:"))
    print_answer(_("least clearance"), report.clearance, up=False, brackets=brackets)
    print_answer(_("greatest speed of a handle"), report.greatest_speed, up=True, brackets=brackets)
    for name, peak in report.peaks.items():
        print_answer(peak_text(name), peak, up=True, brackets=brackets)


def print_answer(name: str, answer: Answer, *, up: bool, brackets: bool) -> None:
    """An answer for readers: value, how it was established, where.

    What is shown is the end of the bracket that is surely true, rounded `up` or down; with `brackets`
    it is the value with all of its digits, and the bracket.
    """
    words = {
        "proved": _("proved"), "found": _("found"),
        "infeasible": _("no solution"), "undecided": _("undecided"),
    }  # fmt: skip
    if not math.isfinite(answer.value):
        text = _("no pair counts") if answer.status == "found" else words[answer.status]
        click.echo(f"{name}: {text}")
        return
    value = repr(answer.value) if brackets else figures(answer.sure(up=up), up=up)
    if answer.status == "unlimited":
        text = _("{name}: no limit was met up to {value} {unit}")
        click.echo(text.format(name=name, value=value, unit=answer.unit))
        return
    text = _("{name}: {value} {unit} ({status})")
    if brackets:
        text = _("{name}: {value} {unit} ({status}; between {lower} and {upper})")
    click.echo(
        text.format(
            name=name, value=value, unit=answer.unit, status=words[answer.status],
            lower=repr(answer.lower), upper=repr(answer.upper),
        )
    )  # fmt: skip
    _print_witness(answer.witness, 6 if brackets else 2)


def _print_witness(near: Witness | None, count: int) -> None:
    """Where and when an answer comes about, with so many decimals."""
    if near is not None and len(near.benches) == 1:
        click.echo(
            _("  bench {a} at t = {t} s, head at {s} m of the route, at ({x}, {y}) m").format(
                a=near.benches[0],
                t="-" if near.time is None or math.isinf(near.time) else decimals(near.time, count),
                s=decimals(near.s, count),
                x=decimals(near.point[0], count),
                y=decimals(near.point[1], count),
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
                t="-" if near.time is None else decimals(near.time, count),
                x=decimals(near.point[0], count),
                y=decimals(near.point[1], count),
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
@click.option(
    "--prove", is_flag=True, help=N_("Verify all positions behind the answer in ball arithmetic.")
)
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
@click.option("--force", is_flag=True, help=N_("Overwrite files that are there already."))
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
