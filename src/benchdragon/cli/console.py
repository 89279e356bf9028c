"""What users see in a terminal: tables, answers, files written, progress.

rich is imported when something is shown, so that help need not wait for it.
"""

import json
import math
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.i18n import N_, _
from benchdragon.model.numbering import handle_names, handle_text, numbering_text
from benchdragon.number_format import decimals
from benchdragon.progress import Progress, silent
from benchdragon.version import __version__

if TYPE_CHECKING:
    from rich.console import Console

    from benchdragon.model.answer import Answer
    from benchdragon.solve.turn import BestTurn


# Of what --json prints: it is raised where a key goes, or comes to mean something else.
JSON_FORMAT = 1
# Seconds between two lines of progress.
LINE_EACH = 30.0


def print_table(title: str, benches: int, rows: Sequence[tuple[float, int, Sequence[float]]]) -> None:
    """Time (s), number of a handle of a dragon of so many benches, and its x, y (m), speed (m/s).

    The contest's name stands beside each number, and below what the numbers mean.
    """
    names = handle_names(benches + 1)
    columns = (
        _("time (s)"), _("handle"), _("in the contest"), _("x (m)"), _("y (m)"), _("speed (m/s)"),
    )  # fmt: skip
    cells = [(f"{t:z.6g}", str(i), names[i], *map(decimals, values)) for t, i, values in rows]
    print_rows(title, columns, cells)
    click.echo(numbering_text())


def print_rows(
    title: str, columns: Sequence[str], rows: Sequence[tuple[str, ...]], *, words: int = 1
) -> None:
    """A table: words of so many first columns may break, figures in the others stand to the right.

    Where it is piped or written into a file it has no lines: a row a line, its cells between tabs.
    """
    if not sys.stdout.isatty():
        lines = ["\t".join(cell.replace("\n", "; ") for cell in row) for row in (columns, *rows)]
        click.echo("\n".join([title, *lines] if title else lines))
        return
    from rich.table import Table
    from rich.text import Text  # text in brackets is no markup

    table = Table(title=Text(title))
    for n, name in enumerate(columns):
        right = n >= words
        table.add_column(name, justify="right" if right else "left", no_wrap=right, overflow="fold")
    for row in rows:
        table.add_row(*(Text(word) for word in row))
    _console().print(table)


def print_json(answer: Mapping[str, Any], files: Sequence[Path] = ()) -> None:
    """One JSON object: the number of the format, an answer, files that were written, the version."""
    written = {"files": [str(path) for path in files]} if files else {}
    click.echo(json.dumps({"format": JSON_FORMAT, **answer, **written, "version": __version__}))


def print_files(files: Sequence[Path]) -> None:
    """The files that were written, if any."""
    if files:
        click.echo(_("Written:"))
    for path in files:
        click.echo(f"  {path}")


def print_written(files: Sequence[Path], as_json: bool, **about: Any) -> None:
    """The files that were written, and what --json says about them besides."""
    if as_json:
        print_json(about, files)
    else:
        print_files(files)


def print_first(contact: "Answer", pitch: "Answer", report: Path) -> None:
    """What is known before the long work begins, and where its results will lie."""
    lines = (
        _("question 2: benches touch first at t = {time} s").format(time=f"{contact.value:.9f}"),
        _("question 3: the smallest pitch is {pitch} m").format(pitch=f"{pitch.value:.9f}"),
        _("What follows takes minutes. Its results will lie in {folder}: open {report}.").format(
            folder=report.parent, report=report
        ),
    )
    click.echo("\n".join(lines))
    sys.stdout.flush()  # a pipe holds lines back


def print_explanation(lines: Sequence[str]) -> None:
    """Print the derivation of an answer, numbered; nothing without lines."""
    if not lines:
        return
    click.echo("\n" + _("Step by step (metres, seconds, radians):"))
    for n, line in enumerate(lines, start=1):
        click.echo(f"{n:3}. {line}")


def print_reproduction(answers: dict[str, Any]) -> None:
    """The answers of `reproduce.reproduce`, as a table and sentences."""
    rows = [
        (row["time_s"], row["handle"], [row[key] for key in ("x_m", "y_m", "speed_m_s")])
        for row in answers["table"]
    ]
    benches = max(handle for _time, handle, _values in rows)
    print_table(_("The contest's table, pitch 0.55 m"), benches, rows)
    rk, turn = answers["runge_kutta"], answers["turn"]
    lines = [
        _("chords equal their links to within {error} m").format(
            error=f"{answers['largest_chord_error_m']:.1e}"
        ),
        _(
            "head by Runge-Kutta and by the closed form: {rk4} m apart (RK4, steps of 0.1 s), "
            "{adaptive} m apart (adaptive); measured order of RK4 {order}"
        ).format(
            rk4=f"{rk['rk4_step_0.1_s_m']:.1e}",
            adaptive=f"{rk['adaptive_m']:.1e}",
            order=f"{rk['rk4_order']:.2f}",
        ),
    ]
    names = {"forward": _("forward"), "central": _("central"), "backward": _("backward")}
    for scheme, found in answers["differences"].items():
        lines.append(
            _(
                "head speed by {scheme} differences with a step of 1 s: {speed} m/s, off by at most "
                "{error} m/s; measured order over all handles {order}"
            ).format(
                scheme=names[scheme],
                speed=f"{found['head_speed_m_s']:.6f}",
                error=f"{found['head_speed_error_m_s']:.1e}",
                order=f"{found['order']:.2f}",
            )
        )
    lines.append(
        _("turn: radii {r1} m and {r2} m, length {length} m, boundary angles {angles}").format(
            r1=f"{turn['radii_m'][0]:.6f}",
            r2=f"{turn['radii_m'][1]:.6f}",
            length=f"{turn['length_m']:.6f}",
            angles=", ".join(
                f"{turn[name]:.4f}" for name in ("theta_max1", "theta_min1", "theta_min2", "theta_max2")
            ),
        )
    )
    lines += _turn_lines(turn)
    lines += _contact_lines(answers)
    for line in lines:
        click.echo(line)


def _turn_lines(turn: dict[str, Any]) -> list[str]:
    speed, near = turn["greatest_head_speed"], turn["clearance"]
    lines = [
        _(
            "greatest head speed with no handle above 2 m/s: {speed} m/s, in a bracket of {width} m/s, "
            "decided by {handle} at t = {time} s"
        ).format(
            handle=handle_text(speed["witness"]["handle"], speed["witness"]["benches"][0]),
            speed=f"{speed['value']:.12f}",
            width=f"{speed['upper'] - speed['lower']:.1e}",
            time=f"{speed['witness']['time']:.6f}",
        ),
        _("turning, benches {a} and {b} come nearest: {gap} m at t = {time} s").format(
            a=near["witness"]["benches"][0],
            b=near["witness"]["benches"][1],
            gap=f"{near['value']:.4f}",
            time=f"{near['witness']['time']:.2f}",
        ),
    ]
    text = _(
        "shorter turn (arc, line, arc): {length} m, path inside the disc {way} m, radii from "
        "{radius} m, greatest head speed {speed} m/s"
    )
    return lines + [
        text.format(
            length=f"{best['length']:.4f}",
            way=f"{best['way']:.4f}",
            radius=f"{best['least_radius']:.4f}",
            speed=f"{best['greatest_head_speed']['value']:.4f}",
        )
        for best in turn["better"]
    ]


def _contact_lines(answers: dict[str, Any]) -> list[str]:
    first, smallest = answers["contact"]["first"], answers["pitch"]["smallest"]
    lines = [
        _("first contact: {time} s, bench {a} with bench {b}, in a bracket of {width} s").format(
            time=f"{first['value']:.10f}",
            a=first["witness"]["benches"][0],
            b=first["witness"]["benches"][1],
            width=f"{first['upper'] - first['lower']:.1e}",
        ),
        _(
            "smallest pitch: {pitch} m, bench {a} with bench {b}, {before} m before the disc, in a "
            "bracket of {width} m"
        ).format(
            pitch=f"{smallest['value']:.13f}",
            a=smallest["witness"]["benches"][0],
            b=smallest["witness"]["benches"][1],
            before=f"{answers['pitch']['before_disc_m']:.4f}",
            width=f"{smallest['upper'] - smallest['lower']:.1e}",
        ),
    ]
    for row in answers["pitch"]["traversal"]:
        text = _("smallest pitch by traversal, steps of {pitch_step} m and {time_step} s: {pitch} m")
        if row["time_step_s"] > 1e5:
            text = _(
                "smallest pitch by traversal, steps of {pitch_step} m, at the disc alone: {pitch} m"
            )
        lines.append(
            text.format(
                pitch_step=f"{row['pitch_step_m']:g}",
                time_step=f"{row['time_step_s']:g}",
                pitch=f"{row['pitch_m']:.4f}",
            )
        )
    return lines


def _console(stderr: bool = False) -> "Console":
    from rich.console import Console

    wide = None if (sys.stderr if stderr else sys.stdout).isatty() else 100
    return Console(stderr=stderr, width=wide)


def shown_progress(quiet: bool, *, remaining: bool = False) -> AbstractContextManager[Progress]:
    """A bar on standard error, or a line now and then, of the progress that the block tells.

    With `remaining` the bar tells how long it will yet take, for work whose steps take equally long.
    """
    if quiet:
        return nullcontext(silent)
    return _Bar(remaining) if sys.stderr.isatty() else Lines()


class Lines:
    """A line each LINE_EACH seconds, for a standard error on which no bar can be drawn.

    Args:
        wait: waits so many seconds and tells whether the work is over.
    """

    def __init__(self, wait: Callable[[float], bool] | None = None) -> None:
        self._share, self._text = 0.0, ""
        self._over = threading.Event()
        self._wait = wait or self._over.wait
        self._thread = threading.Thread(target=self._tell, daemon=True)

    def __enter__(self) -> Progress:
        self._thread.start()
        return self._told

    def __exit__(self, *_exception: object) -> None:
        self._over.set()
        self._thread.join()

    def _told(self, share: float, text: str) -> None:
        self._share, self._text = share, text or self._text

    def _tell(self) -> None:
        seconds = 0.0
        while not self._wait(LINE_EACH):
            seconds += LINE_EACH
            with suppress(OSError):  # there is no reader any more
                click.echo(self._line(seconds), err=True)

    def _line(self, seconds: float) -> str:
        share = int(100.0 * self._share + 1e-9)
        parts = [_("{seconds} s so far").format(seconds=f"{seconds:.0f}")]
        parts += [_("{share} % done").format(share=share)] if share else []
        parts += [self._text] if self._text else []
        return "; ".join(parts)


class _Bar:
    def __init__(self, remaining: bool) -> None:
        from rich import progress
        from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn

        left = (TextColumn(_("left:")), TimeRemainingColumn()) if remaining else ()
        columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn(), *left)
        self._bar = progress.Progress(
            *columns, console=_console(stderr=True), transient=True,
            redirect_stdout=sys.stdout.isatty(),  # what is printed meanwhile goes where it was sent
        )  # fmt: skip
        self._task = self._bar.add_task("", total=1.0)

    def __enter__(self) -> Progress:
        self._bar.start()
        return self._told

    def __exit__(self, *_exception: object) -> None:
        self._bar.stop()

    def _told(self, share: float, text: str) -> None:
        self._bar.update(self._task, completed=share, description=text or None)


# Names of limits; the keys are those of solve/turn_question.py.
LIMITS = {
    "radius": N_("radius of the tightest bend"),
    "disc": N_("radius of the disc"),
    "length": N_("length of the turn"),
    "way": N_("path inside the disc"),
    "speed": N_("speed of a handle"),
    "turning_rate": N_("turning rate of a bench"),
    "lateral_acceleration": N_("lateral acceleration of a handle"),
    "total_acceleration": N_("total acceleration of a handle"),
    "acceleration": N_("acceleration of a handle along the route"),
    "clearance": N_("clearance"),
    "obstacles": N_("distance from obstacles and the venue's edge"),
}


def turn_lines(best: "BestTurn") -> list[str]:
    """The turn in words, a line each, in the language in use."""
    found = [
        _("turn {length} m long, path inside the disc {way} m").format(
            length=f"{best.length:.4f}", way=f"{best.way:.4f}"
        ),
        _("leaves the spiral at radius {a} m, joins the other at {b} m").format(
            a=f"{best.turn.entry_radius:.4f}", b=f"{best.turn.exit_radius:.4f}"
        ),
        *(_piece_text(*piece) for piece in best.turn.pieces),
    ]
    if best.head_speed is not None:
        found.append(
            _("the head may walk at {speed} m/s ({why})").format(
                speed=f"{best.head_speed.value:.6f}", why="; ".join(best.head_speed.assumptions)
            )
        )
    nearest = best.clearance.lower
    found.append(_("benches stay {gap} m apart or more").format(gap=f"{nearest:.4f}"))
    if best.active:
        names = ", ".join(_(LIMITS[name]) for name in best.active)
        found.append(_("limits that decide: {names}").format(names=names))
    return [*found, *best.objective.assumptions]


def _piece_text(length: float, a: float, b: float) -> str:
    """One piece of a turn in words."""
    if a != b:
        text = _("clothoid, {length} m, from curvature {a} 1/m to {b} 1/m")
        return text.format(length=f"{length:.4f}", a=f"{a:z.4f}", b=f"{b:z.4f}")
    if not a:
        return _("line, {length} m").format(length=f"{length:.4f}")
    text = _("arc to the left, radius {radius} m, {length} m, {angle} degrees")
    if a < 0.0:
        text = _("arc to the right, radius {radius} m, {length} m, {angle} degrees")
    return text.format(
        radius=f"{1.0 / abs(a):.4f}",
        length=f"{length:.4f}",
        angle=f"{math.degrees(length * abs(a)):.2f}",
    )
