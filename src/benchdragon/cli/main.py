"""The command line: parse, call one function, print, exit code.

Help must come fast, so everything heavier than click is imported by the verb that uses it.
"""

import signal
import sys
import warnings
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import about
from benchdragon.cli.area import area
from benchdragon.cli.atlas import atlas
from benchdragon.cli.check import check
from benchdragon.cli.compare import compare, starter
from benchdragon.cli.console import (
    print_explanation,
    print_files,
    print_first,
    print_json,
    print_reproduction,
    print_table,
    print_written,
    shown_progress,
)
from benchdragon.cli.formations import formations
from benchdragon.cli.help import HelpfulGroup, sentence, translated
from benchdragon.cli.new import new
from benchdragon.cli.options import (
    HELP,
    files_option,
    folder_option,
    only_with,
    plan_to_walk,
    take,
    verb,
)
from benchdragon.cli.parsing import (
    PICTURE_FORMATS,
    TABLE_FORMATS,
    parse_handles,
    parse_names,
    parse_times,
    spread,
)
from benchdragon.cli.plan import plan, schema
from benchdragon.cli.planner import planner
from benchdragon.cli.sheets import sheets
from benchdragon.cli.shell import completion, help_
from benchdragon.cli.solve import solve
from benchdragon.cli.survey import survey
from benchdragon.cli.sweep import sweep
from benchdragon.cli.timetable import timetable
from benchdragon.cli.tolerance import margins
from benchdragon.cli.verify import verify
from benchdragon.cli.view import view
from benchdragon.errors import (
    BenchDragonError,
    InputError,
    MachineError,
    engine_advice,
    pipe_closed,
    reason,
)
from benchdragon.files import one_run
from benchdragon.hosts.trouble import EngineError
from benchdragon.i18n import N_, _, language
from benchdragon.number_format import finite_or_none
from benchdragon.progress import Stage, stages
from benchdragon.version import __version__

if TYPE_CHECKING:
    import numpy as np

    from benchdragon.export.tables import Selection
    from benchdragon.model.walk import Motion, Walk
    from benchdragon.plans.schema import Plan

# As shells report programs that a signal ended.
INTERRUPTED = 128 + signal.SIGINT
NOBODY_READS = 128 + 13
# Handles times times of a JSON answer (1 GB of text at most) and of a table on the screen.
MOST_PLACES_JSON = 10_000_000
MOST_ROWS_SHOWN = 400
# Without --at a screen shows the whole walk in the first of these steps, s, that needs no more times.
SCREEN_STEPS, SCREEN_TIMES = (1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0), 12
FORMATS = TABLE_FORMATS + PICTURE_FORMATS
PAPER_HANDLES = (0, 1, 51, 101, 151, 201)


@click.group(
    cls=HelpfulGroup,
    context_settings=HELP,
    help=N_("Where every handle of a bench dragon is, and how fast, on any route."),
)
@click.version_option(
    __version__, "-V", "--version", prog_name="benchdragon", help=N_("Show the version and exit.")
)
@take("lang")
def program() -> None:
    """Hold the verbs."""


@verb("reproduce -o out")
@folder_option(Path("out"))
@click.option(
    "--docs",
    metavar="PLACE",
    help=N_("Folder or address of the documentation's pages, for links in the report."),
)
@take("json", "explain", "shared")
def reproduce(
    output: Path, force: bool, docs: str | None, as_json: bool, explain: bool, quiet: bool
) -> int:
    """Repeat the paper, claim by claim, and write a report: the contest's answers, tables and pictures,
    an error analysis, and the tolerance that imprecise people need.
    """
    from benchdragon.paper.reproduce import reproduce as reproduced

    with shown_progress(quiet) as progress:
        found = reproduced(output, force, progress, docs, None if as_json else print_first)
    lines: list[str] = []
    if explain:
        from benchdragon.paper.explanation import reproduce_lines

        lines = reproduce_lines(found.answers)
    if as_json:
        print_json({**found.answers, **({"explanation": lines} if lines else {})}, found.files)
        return 0
    print_reproduction(found.answers)
    print_files(found.files)
    print_explanation(lines)
    return 0


@verb("motion spiral-in --at 0..300..10 -o out/spiral")
@take("plan")
@click.option(
    "--at",
    metavar="TIMES",
    help=N_(
        "Times: seconds (12.5), a clock time (3:12 or 1:02:03), units (3 min 12 s), a range "
        "start..stop..step (0..300..1; a step of 1 s may be left out), or several with commas. "
        "Default: each second of the walk that check judges; on the screen a dozen times of it."
    ),
)
@click.option(
    "--only",
    metavar="HANDLES",
    help=N_("Handles to give, for example 1,51,101; handle 0 is the head's front."),
)
@files_option("xlsx,csv,png", N_("What to write: xlsx, csv, npz, parquet, nc, png, svg, pdf."))
@take("json")
@click.option(
    "--leader",
    type=click.Choice(["closed-form", "rk4", "adaptive"]),
    default="closed-form",
    help=N_(
        "Method for the head's position; all but closed-form integrate the spiral's "
        "differential equation."
    ),
)
@click.option(
    "--step",
    type=click.FloatRange(min=0.0, min_open=True),
    default=0.1,
    help=N_("Largest step of rk4, in seconds."),
)
@click.option(
    "--keep-going",
    is_flag=True,
    help=N_("Give what is sound where the dragon cannot stand, instead of stopping."),
)
@click.option(
    "-j", "--workers", type=click.IntRange(1, 64), default=1,
    help=N_("Threads; the answers do not depend on it."),
)  # fmt: skip
@take("explain", "shared")
def motion(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Position and speed of every handle at chosen times."""
    _refuse_strays(options)
    from benchdragon.export.tables import Selection

    read = plan_to_walk(plan, settings, quiet)
    walk = read.build()
    times = _times(options, read, walk)
    handles = parse_handles(options["only"], len(walk.dragon))
    if options["output"]:
        everything = range(len(walk.dragon) + 1) if handles is None else handles
        what = Selection(walk, times, everything, not options["keep_going"], options["workers"])
        return _motion_files(what, read, options, quiet)
    if options["as_json"]:
        return _motion_json(walk, read, times, handles, options)
    return _motion_table(walk, read, times, handles, options)


@verb("doctor")
@take("json", "shared")
def doctor(as_json: bool, quiet: bool) -> int:
    """Versions, fonts, cache folder, and what else is there to work with."""
    del quiet
    from benchdragon.cli.doctor import advice, findings

    found = findings()
    if as_json:
        print_json({finding.name: finding.value for finding in found})
    else:
        for finding in found:
            mark = "ok " if finding.good else " - "
            click.echo(f"{mark} {_(finding.name)}: {finding.value}")
        for line in advice():
            click.echo(line)
    return 0


program.titled = {
    N_("Plans"): (new, plan, planner, formations, schema, survey),
    N_("Judge"): (check, solve, margins, verify),
    N_("Watch"): (view, area, motion),
    N_("Papers"): (sheets, timetable),
    N_("Research"): (sweep, atlas),
    N_("Contest"): (starter, compare, reproduce),
    N_("Help"): (help_, doctor, completion),
}
for verbs in program.titled.values():
    for one in verbs:
        program.add_command(one)


def _refuse_strays(options: dict[str, Any]) -> None:
    to_files = options["output"] is not None
    formats = (
        set(parse_names("--format", options["formats"], FORMATS)) if to_files else set(TABLE_FORMATS)
    )
    only_with("-o", to_files, "formats", "force")
    only_with(", ".join(TABLE_FORMATS), bool(formats & set(TABLE_FORMATS)), "only")
    only_with("--leader rk4", options["leader"] == "rk4", "step")


def _times(options: dict[str, Any], plan: "Plan", walk: "Walk") -> "np.ndarray[Any, Any]":
    """The times asked for; else all of the walk, each second, or as many as a screen holds."""
    if options["at"] is not None:
        return parse_times(options["at"])
    import numpy as np

    start, stop = plan.span(walk)
    on_screen = not (options["output"] or options["as_json"])
    step = next((step for step in SCREEN_STEPS if stop - start <= step * SCREEN_TIMES), stop - start)
    return np.array(spread(start, stop, step if on_screen else 1.0))


def _moved(walk: "Walk", times: Any, options: dict[str, Any]) -> "Motion":
    throw, workers = not options["keep_going"], options["workers"]
    if options["leader"] == "closed-form":
        return walk.motion(times, throw=throw, workers=workers)
    from benchdragon.paper.runge_kutta import head_positions

    ahead = head_positions(walk, times, options["leader"], options["step"])
    return walk.motion_at(times, ahead, throw=throw, workers=workers)


def _failures(motions: "Iterable[Motion]") -> int:
    """Say on standard error at how many times --keep-going found no dragon, and why; the exit code."""
    first, failed, count = None, 0, 0
    for motion in motions:
        bad = motion.status.nonzero()[0]
        if first is None and bad.size:
            first = motion.failure(int(bad[0]))
        failed, count = failed + bad.size, count + len(motion.times)
    if first is None:
        return 0
    text = _("{failed} of {count} times are incomplete; the first: {why}")
    click.echo(text.format(failed=failed, count=count, why=first), err=True)
    return first.exit_code


def _motion_json(
    walk: "Walk", plan: "Plan", times: Any, handles: list[int] | None, options: dict[str, Any]
) -> int:
    chosen = list(range(len(walk.dragon) + 1)) if handles is None else handles
    if len(times) * len(chosen) > MOST_PLACES_JSON:
        text = _("JSON holds at most {most} positions; choose fewer times or handles, or -o")
        raise InputError(text.format(most=MOST_PLACES_JSON))
    found = _moved(walk, times, options)
    tables = {"x": found.x + 0.0, "y": found.y + 0.0, "speed": found.speed}  # 0, not -0
    answer: dict[str, Any] = {"time": times.tolist(), "handle": chosen}
    for name, values in tables.items():
        answer[name] = [[finite_or_none(value) for value in row] for row in values[:, chosen].tolist()]
    answer["status"] = [int(status) for status in found.status]
    print_json({**answer, **about(plan, _explained(found, options))})
    return _failures([found])


def _motion_table(
    walk: "Walk", plan: "Plan", times: Any, handles: list[int] | None, options: dict[str, Any]
) -> int:
    benches = len(walk.dragon)
    chosen = handles or sorted({*(h for h in PAPER_HANDLES if h < benches), benches})
    if len(times) * len(chosen) > MOST_ROWS_SHOWN:
        text = _(
            "{rows} rows are too many for a screen (at most {most}): choose times with --at, or "
            "use -o DIR or --json"
        )
        raise InputError(text.format(rows=len(times) * len(chosen), most=MOST_ROWS_SHOWN))
    found = _moved(walk, times, options)
    rows = [
        (t, handle, [table[i, handle] for table in (found.x, found.y, found.speed)])
        for i, t in enumerate(times)
        for handle in chosen
    ]
    print_table(plan.title(language()), benches, rows)
    _print_leader(found, options)
    print_explanation(_explained(found, options))
    return _failures([found])


def _explained(found: "Motion", options: dict[str, Any]) -> list[str]:
    """The lines of --explain; none if it was not asked for."""
    if not options["explain"]:
        return []
    from benchdragon.explain.text import motion_lines

    return motion_lines(found, options["leader"])


def _print_leader(found: "Motion", options: dict[str, Any]) -> None:
    if options["leader"] == "closed-form":
        return
    import numpy as np

    apart = float(np.abs(found.head_s - found.walk.head_position(found.times)).max())
    text = _("{method} and the closed form put the head at most {apart} m apart")
    click.echo(text.format(method=options["leader"], apart=f"{apart:.2e}"))


def _motion_files(what: "Selection", plan: "Plan", options: dict[str, Any], quiet: bool) -> int:
    from benchdragon.export.tables import WRITERS
    from benchdragon.files import refuse_existing

    formats = parse_names("--format", options["formats"], FORMATS)
    if options["leader"] != "closed-form":
        raise InputError(_("files hold the closed form; --leader goes with the screen or --json"))
    folder: Path = options["output"]
    tables = [folder / f"motion.{name}" for name in formats if name in WRITERS]
    kinds = [name for name in formats if name in PICTURE_FORMATS]
    names = [f"{name}.{kind}" for name in picture_names(what) for kind in kinds]
    refuse_existing([*tables, *(folder / name for name in names)], options["force"])
    with shown_progress(quiet) as progress:
        stage = stages(progress, len(tables) + len(names))
        for path in tables:
            WRITERS[path.suffix[1:]](path, what, stage(path.name))
        if names:
            _write_pictures(what, plan, folder, kinds, stage)
    files = [*tables, *(folder / name for name in names)]
    first = what.walk.motion(what.times[:1], throw=what.throw) if options["explain"] else None
    lines = [] if first is None else _explained(first, options)
    print_written(files, options["as_json"], **about(plan, lines))
    print_explanation([] if options["as_json"] else lines)
    return _failures(what.motions()) if not what.throw else 0


def picture_names(what: "Selection") -> list[str]:
    """Pictures that make sense: maps over time need two times that increase."""
    increasing = len(what.times) > 1 and bool((what.times[1:] > what.times[:-1]).all())
    return ["dragon", "speeds", "head-angle"] if increasing else ["dragon"]


def _write_pictures(
    what: "Selection", plan: "Plan", folder: Path, kinds: Sequence[str], stage: Stage
) -> None:
    from benchdragon.figures.style import write_picture
    from benchdragon.figures.walk import walk_pictures

    title = plan.title(language())
    figures = walk_pictures(
        what.walk, what.times, title, plan.disc.radius, what.throw, plan.obstacles()
    )
    for name in picture_names(what):
        for kind in kinds:
            stage(f"{name}.{kind}")
            write_picture(figures[name], folder / f"{name}.{kind}", title, plan.sha256)


def _notes() -> Callable[..., None]:
    """What shows each warning once, as a sentence, without the place in the code it comes from."""
    shown: set[str] = set()

    def note(message: Warning | str, *_place: object) -> None:
        if str(message) not in shown:
            shown.add(str(message))
            click.echo(_("Note: {text}").format(text=message), err=True)

    return note


def run(arguments: Sequence[str]) -> int:
    """Run one command line; its exit code. Errors become one sentence on standard error."""
    try:
        with one_run(), warnings.catch_warnings():
            warnings.simplefilter("always", UserWarning)
            warnings.showwarning = _notes()
            code = translated(program).main(
                list(arguments), prog_name="benchdragon", standalone_mode=False
            )
        sys.stdout.flush()
        return code if isinstance(code, int) else 0
    except click.exceptions.NoArgsIsHelpError as error:
        with suppress(OSError):  # there is no reader any more
            error.show()
        return error.exit_code
    except click.ClickException as error:
        return _failed(sentence(error), error.exit_code)
    except BenchDragonError as error:
        return _failed(str(error), error.exit_code)
    except EngineError as error:
        advice = engine_advice(error)
        return _failed(str(advice), advice.exit_code)
    except (KeyboardInterrupt, click.Abort) as error:
        _say(_("interrupted; nothing half-written is left"))
        number = getattr(error.__cause__ or error, "args", ())
        return 128 + number[0] if number else INTERRUPTED
    except SystemExit as ended:  # so click ends what a shell completes, and where a pipe is closed
        return NOBODY_READS if ended.code else 0
    except OSError as error:
        if pipe_closed(error):
            return NOBODY_READS
        where = "" if error.filename is None else f"{error.filename}: "
        return _failed(where + reason(error), MachineError.exit_code)
    except MemoryError:
        return _failed(_("memory ran out"), MachineError.exit_code)


def _failed(text: str, code: int) -> int:
    _say(_("Error: {text}").format(text=text))
    return code


def _say(text: str) -> None:
    """Tell standard error, if there is anyone to read it."""
    with suppress(OSError):
        click.echo(text, err=True)
