"""The verb `solve`: what a plan may be at its limits, a subcommand for each question."""

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import NO_SOLUTION, UNDECIDED, about, print_answer, print_title
from benchdragon.cli.console import print_explanation, print_files, shown_progress, turn_lines
from benchdragon.cli.help import HelpfulGroup
from benchdragon.cli.options import (
    BESIDE,
    FILE,
    WITHOUT,
    Command,
    brackets_option,
    explain_option,
    force_option,
    json_option,
    lang_option,
    output_option,
    plan_options,
    plan_to_walk,
    prove_option,
    refuse_strays,
    shared_options,
)
from benchdragon.cli.parsing import check_ending, parse_lengths
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.progress import Progress, part

if TYPE_CHECKING:
    from benchdragon.analysis.proof import Claim
    from benchdragon.analysis.speed_proof import SpeedClaim
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.head_speed import Pace
    from benchdragon.solve.size import FeasibleSizes
    from benchdragon.solve.turn import BestTurn
    from benchdragon.solve.turn_trials import TurnGoal


@click.group(
    cls=HelpfulGroup,
    help=N_(
        "The extreme sizes and speeds of a plan.\n\nEach question has options of its own; "
        "benchdragon solve pitch --help, for example, shows those of the first."
    ),
)
@lang_option
def solve() -> None:
    """Hold the questions."""


def certificate_option(command: Command) -> Command:
    """-o of a certificate, and --force."""
    return output_option(
        N_("Write what --prove shows into this file, as a certificate that `verify` shows again."),
        required=False,
    )(force_option(command))


def size_options(command: Command) -> Command:
    """What the questions of all sizes take besides PLAN and --set."""
    for option in reversed(
        (prove_option, certificate_option, json_option, brackets_option, explain_option, shared_options)
    ):
        command = option(command)
    command = click.option(
        "--count",
        type=click.IntRange(2, 10_000),
        default=50,
        show_default=True,
        help=N_("Sizes tried by --range."),
    )(command)
    return click.option(
        "--range",
        "span",
        metavar="LOW..HIGH",
        help=N_(
            "All sizes from LOW to HIGH, in metres, for which the walk is safe: no contact, "
            "and the margin kept."
        ),
    )(command)


@solve.command(
    help=N_(
        "The smallest pitch of the spiral with which the walk is safe.\n\nSafe means here: no "
        "contact, and the margin kept. PLAN is a *.dragon.toml file or the name of a built-in "
        "plan: spiral-in, turn. A spiral needs an end: --set disc.radius=4.5, for example. Exit "
        "code 4: there is no such pitch; 5: undecided."
    )
)
@plan_options
@click.option(
    "--method",
    type=click.Choice(["exact", "traversal"]),
    default="exact",
    show_default=True,
    help=N_("exact, or the paper's traversal of pitches in steps."),
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
    help=N_("Time step of the traversal's contact checks, in seconds."),
)
@size_options
def pitch(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Answer exactly, or as the paper does."""
    stepped = options["method"] == "traversal"
    refuse_strays(
        ("method", options["span"] is None, BESIDE, "--range"),
        ("prove", not stepped, BESIDE, "--method traversal"),
        *((name, stepped, WITHOUT, "--method traversal") for name in ("pitch_step", "time_step")),
    )
    return _solve_size("pitch", plan, settings, quiet, options)


# Questions that differ by the size alone.
SIZES = {
    "disc": N_(
        "The smallest radius of the disc with which the walk is safe.\n\nSafe means here: no "
        "contact, and the margin kept. PLAN is a *.dragon.toml file or the name of a built-in "
        "plan: spiral-in, turn. It needs a disc to begin with: --set disc.radius=4.5, for "
        "example. Exit code 4: there is no such radius; 5: undecided."
    ),
    "width": N_(
        "The greatest width of the benches with which the walk is safe.\n\nSafe means here: no "
        "contact, and the margin kept. PLAN is a *.dragon.toml file or the name of a built-in "
        "plan: spiral-in, turn. A spiral needs an end: --set disc.radius=4.5, for example. Exit "
        "code 4: there is no such width; 5: undecided."
    ),
    "length": N_(
        "The greatest length of the benches with which the walk is safe.\n\nSafe means here: no "
        "contact, and the margin kept. The head's length stays. PLAN is a *.dragon.toml file or "
        "the name of a built-in plan: spiral-in, turn. A spiral needs an end: --set "
        "disc.radius=4.5, for example. Exit code 4: there is no such length; 5: undecided."
    ),
}


def size_question(name: str) -> click.Command:
    """The question of a size, which has no options of its own."""

    @click.command(name, help=SIZES[name])
    @plan_options
    @size_options
    def asked(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
        return _solve_size(name, plan, settings, quiet, options)

    return asked


for size in SIZES:
    solve.add_command(size_question(size))


@solve.command(
    help=N_(
        "The greatest constant head speed that keeps the plan's limits.\n\nPLAN is a *.dragon.toml "
        "file or the name of a built-in plan: spiral-in, turn. It must limit speeds, accelerations or "
        "turning rates: --set limits.speed=2, for example. Exit code 4: it cannot be walked; 5: "
        "undecided."
    )
)
@plan_options
@click.option(
    "--pace",
    "pace_file",
    type=FILE,
    metavar="FILE",
    help=N_("Write the plan walked at its own head speed, slowed down only where a limit requires it."),
)
@prove_option
@certificate_option
@json_option
@brackets_option
@explain_option
@shared_options
def speed(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print the greatest head speed; with --pace also write a pace, as a plan of its own."""
    path: Path | None = options["pace_file"]
    refuse_strays(
        ("prove", path is None, BESIDE, "--pace"), ("output", options["prove"], WITHOUT, "--prove")
    )
    if options["prove"]:
        check_certificate(options)
        return _print_speed(plan_to_walk(plan, settings, quiet), options, quiet)
    read = read_to_write(plan, settings, quiet, "--pace", path)
    if path is None:
        return _print_speed(read, options, quiet)
    return _print_pace(read, plan, path, options, quiet)


@solve.command(
    help=N_(
        "The best turn of the plan's family.\n\nPLAN is a *.dragon.toml file or the name of a built-in "
        "plan whose route is a turn: turn. The plan's turn.family names the family. Exit code 4: no "
        "turn was found that keeps the limits; 5: --prove did not get as near as --within says."
    )
)
@plan_options
@click.option(
    "--objective",
    type=click.Choice(["way", "length", "speed", "disc", "acceleration"]),
    default="way",
    show_default=True,
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
    show_default=True,
    help=N_("With --prove: how much that is to be, in metres or metres a second."),
)
@click.option(
    "--boxes",
    type=click.IntRange(1, 1_000_000),
    default=20_000,
    show_default=True,
    help=N_("With --prove: how many boxes of turns are looked at for it at most."),
)
@click.option(
    "--certificate",
    type=FILE,
    metavar="FILE",
    help=N_("With --prove: write what shows it, for benchdragon verify."),
)
@click.option(
    "--plan-file", type=FILE, metavar="FILE", help=N_("Write the plan with the turn that was found.")
)
@force_option
@json_option
@explain_option
@shared_options
def turn(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print the best turn; with --plan-file also write the plan with it."""
    from benchdragon.files import refuse_existing
    from benchdragon.solve.turn import best_turn
    from benchdragon.solve.turn_trials import TurnGoal

    path, certificate = options["plan_file"], options["certificate"]
    written = [file for file in (path, certificate) if file is not None]
    proving = (
        (name, options["prove"], WITHOUT, "--prove") for name in ("within", "boxes", "certificate")
    )
    refuse_strays(*proving, ("force", bool(written), WITHOUT, "--plan-file"))
    if path is not None:
        check_ending("--plan-file", path, [".toml"])
    if certificate is not None:
        check_ending("--certificate", certificate, [".json"])
    read = plan_to_walk(plan, settings, quiet)
    longest, longest_way = (options[name] or math.inf for name in ("longest", "longest_way"))
    goal = TurnGoal(options["objective"], options["least_radius"], longest, longest_way)
    refuse_existing(written, options["force"])
    if options["prove"]:
        return _prove_turn(read, plan, goal, options, quiet)
    with shown_progress(quiet) as progress:
        best = best_turn(read, goal, progress=progress)
    if path is not None:
        write_plan(best.plan, path, plan)
    _print_turn(read, best, goal.objective, options)
    return 0


def _prove_turn(
    plan: "Plan", source: str, goal: "TurnGoal", options: dict[str, Any], quiet: bool
) -> int:
    """Print the best turn, and how much better another may be at most."""
    from benchdragon.files import whole_file
    from benchdragon.solve import turn_proof
    from benchdragon.solve.turn import best_turn
    from benchdragon.solve.turn_certificate import certificate_of

    turn_proof.turns_of(plan, goal)  # what cannot be proved is told before the search
    with shown_progress(quiet) as progress:
        best = best_turn(plan, goal, progress=part(progress, 0.0, 0.5))
        value, ends = best.objective.value, {"gap": options["within"], "most": options["boxes"]}
        proof = turn_proof.proved_bound(plan, goal, value, **ends, progress=part(progress, 0.5, 1.0))
    if options["plan_file"] is not None:
        write_plan(best.plan, options["plan_file"], source)
    if options["certificate"] is not None:
        text = certificate_of(plan, goal, proof).model_dump_json()
        with whole_file(options["certificate"]) as temporary:
            temporary.write_text(text, encoding="utf-8")
    shown = turn_proof.with_proof(best, proof)
    _print_turn(plan, shown, goal.objective, options, proof=turn_proof.proof_json(proof))
    return 0 if proof.complete else UNDECIDED


def read_to_write(
    plan: str, settings: tuple[str, ...], quiet: bool, option: str, path: Path | None
) -> "Plan":
    """The plan of a question that may write another into a file; refuses what cannot be written."""
    refuse_strays(("force", path is not None, WITHOUT, option))
    if path is not None:
        check_ending(option, path, [".toml"])
    return plan_to_walk(plan, settings, quiet)


def write_plan(plan: "Plan", path: Path, source: str) -> None:
    """The plan as a whole file, with the comments of the file that it was made from."""
    from benchdragon.files import whole_file
    from benchdragon.plans.rewriting import rewritten

    text = rewritten(plan, source)
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _solve_size(
    name: str, plan: str, settings: tuple[str, ...], quiet: bool, options: dict[str, Any]
) -> int:
    """The limit of a size, or with --range all sizes that will do."""
    ranged = options["span"] is not None
    refuse_strays(
        *((option, not ranged, BESIDE, "--range") for option in ("prove", "brackets")),
        ("count", ranged, WITHOUT, "--range"),
        ("output", options["prove"], WITHOUT, "--prove"),
    )
    check_certificate(options)
    read = plan_to_walk(plan, settings, quiet)
    return (_print_sizes if ranged else _print_limit)(name, read, options, quiet)


def _print_limit(name: str, plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    from benchdragon.solve.size_family import question

    tried: list[str] = []
    claims: list[Claim] = []
    with shown_progress(quiet) as progress:
        found = _limit(name, plan, options, _kept(progress, tried), claims)
    lines = _limit_lines(name, plan, options, found, tried) if options["explain"] else []
    asked = question(name)
    _print_solved(plan, _(asked.text), found, options, lines, up=asked.sense > 0.0)
    if found.status == "proved":
        _write_certificate(plan, options, claims, [])
    return _code(found)


def check_certificate(options: dict[str, Any]) -> None:
    """Refuse a certificate that could not be written."""
    from benchdragon.files import refuse_existing

    path: Path | None = options["output"]
    refuse_strays(("force", path is not None, WITHOUT, "-o"))
    if path is not None:
        check_ending("-o", path, [".json"])
        refuse_existing([path], options["force"])


def _write_certificate(
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


def _kept(progress: Progress, tried: list[str]) -> Progress:
    """The same progress; what is said to be tried is kept."""

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


def _code(found: Answer) -> int:
    """The exit code of an answer."""
    return {"infeasible": NO_SOLUTION, "undecided": UNDECIDED}.get(found.status, 0)


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
        click.echo(json.dumps(found.as_json(**more, **about(plan, lines))))
        return
    print_title(plan)
    print_answer(name, found, up=up, brackets=options["brackets"])
    for text in found.assumptions:
        click.echo(f"  {text}")
    print_explanation(lines)


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
        click.echo(json.dumps({**_sizes_json(found), **about(plan, lines)}))
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
    _print_solved(plan, _("greatest head speed"), found, options, lines)
    _write_certificate(plan, options, [], claims)
    return _code(found)


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


def _print_turn(
    plan: "Plan", best: "BestTurn", objective: str, options: dict[str, Any], **more: Any
) -> None:
    """The best turn of a plan, as text or JSON."""
    lines: list[str] = []
    if options["explain"]:
        from benchdragon.explain import answers as explain_answers

        lines = explain_answers.turn_lines(best)
    if options["as_json"]:
        click.echo(json.dumps({**best.as_json(), **more, **about(plan, lines)}))
        return
    print_title(plan)
    _echo_turn(best, objective)
    print_files([options[name] for name in ("plan_file", "certificate") if options[name] is not None])
    print_explanation(lines)


def _echo_turn(best: "BestTurn", objective: str) -> None:
    """The best turn for readers."""
    from benchdragon.solve.turn_trials import OBJECTIVES

    click.echo(
        _("{name}: {value} {unit}  (best found)").format(
            name=_(OBJECTIVES[objective]),
            value=f"{best.objective.value:.6f}",
            unit=best.objective.unit,
        )
    )
    for line in turn_lines(best):
        click.echo(f"  {line}")
