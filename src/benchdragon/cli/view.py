"""The verb `view`: the dance as a page that plays it, as a film, as stills, or as a contact sheet."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.console import print_written, shown_progress
from benchdragon.cli.options import not_with, only_with, output_option, plan_to_walk, take, verb
from benchdragon.cli.parsing import PICTURE_FORMATS, check_ending, parse_sides, parse_span, parse_times
from benchdragon.i18n import N_
from benchdragon.progress import part

PAGE, FILM_FORMATS = "html", ("mp4", "gif")

if TYPE_CHECKING:
    from benchdragon.export.film_scene import Look
    from benchdragon.plans.schema import Plan


@verb("view turn -o turn.html --start -5 --end 20")
@take("plan")
@output_option(N_("File to write: .html, .mp4, .gif, .png, .svg or .pdf."))
@take("span")
@click.option(
    "--speed-up",
    type=click.FloatRange(1e-3, 1e4),
    metavar="NUMBER",
    help=N_("Seconds of the dance in a second of the film; 0.5 is slow motion. Default: 1."),
)
@click.option(
    "--fps", type=click.IntRange(1, 120), help=N_("Frames a second. Default: 30, for a GIF 20.")
)
@click.option(
    "--at",
    metavar="TIMES",
    help=N_(
        "Instants of stills, for example 14 or 0,60,3:12; several make several files, or fill a "
        "sheet. Default: where it begins; for a sheet spread evenly."
    ),
)
@click.option(
    "--sheet", metavar="COLUMNSxROWS", help=N_("Stills side by side in one picture, for example 4x3.")
)
@click.option(
    "--size",
    metavar="WIDTHxHEIGHT",
    help=N_("Size in pixels, even numbers. Default: 1920x1080, for a GIF 960x540."),
)
@click.option(
    "--theme",
    type=click.Choice(["light", "dark"]),
    default="light",
    help=N_("Dark on light, or light on dark."),
)
@click.option(
    "--follow",
    type=click.IntRange(1, 1_000_000),
    metavar="BENCH",
    help=N_("Keep this bench in the middle; 1 is the head."),
)
@click.option(
    "--span",
    type=click.FloatRange(0.1, 1e5),
    metavar="METRES",
    help=N_("With --follow: metres from the left edge to the right. Default: 12."),
)
@take("force", "json", "shared")
def view(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """The dance as a page that plays it, a film, a still, or a sheet of stills.

    The name of the file says which. turn.html is one file for any browser, which needs no network and
    no program: send it to a phone and open it there. turn.mp4 or turn.gif is a film; turn.png, turn.svg
    or turn.pdf a still, or with --sheet many of them side by side.
    """
    path: Path = options["output"]
    kind = path.suffix[1:]
    check_ending("-o", path, [f".{name}" for name in (PAGE, *FILM_FORMATS, *PICTURE_FORMATS)])
    picture = kind in PICTURE_FORMATS
    _refuse_strays(options, picture)
    read = plan_to_walk(plan, settings, quiet)
    write = _write_page if kind == PAGE else _write_pictures if picture else _write_film
    files, about = write(read, path, options, quiet)
    print_written(files, options["as_json"], **about, plan_sha256=read.sha256)
    return 0


def _refuse_strays(options: dict[str, Any], picture: bool) -> None:
    """Refuse options that say nothing about what is asked for, rather than overlook them."""
    kind = options["output"].suffix
    still = options["sheet"] is None
    not_with(kind, kind == f".{PAGE}", "fps", "speed_up", "size", "theme", "follow", "span")
    not_with(kind, picture, "fps", "speed_up")
    not_with(kind, not picture, "at", "sheet")
    not_with(kind, picture and still, "end")
    not_with("--at", options["at"] is not None, "start", "end")
    only_with("--follow", options["follow"] is not None, "span")


def _look(options: dict[str, Any], size: tuple[int, int]) -> "Look":
    """What the options say of the look; `size` is taken where they say none."""
    from benchdragon.export.film_scene import SPAN, Look

    if options["size"] is not None:
        size = parse_sides("--size", options["size"])
    return Look(size, options["theme"], options["follow"], options["span"] or SPAN)


def _write_page(
    plan: "Plan", path: Path, options: dict[str, Any], quiet: bool
) -> tuple[list[Path], dict[str, Any]]:
    """The page, which plays the dance in any browser; and which part of it."""
    from benchdragon.analysis.check import check
    from benchdragon.files import refuse_existing
    from benchdragon.player import scene
    from benchdragon.player.page import write_player

    refuse_existing([path], options["force"])
    first, last = parse_span(options)
    start, end = plan.span(plan.build())
    span = scene.Span(start if first is None else first, end if last is None else last)
    with shown_progress(quiet) as progress:
        judge = partial(check, progress=part(progress, 0.0, 0.5))
        shown = scene.judged_dance(plan, judge, span, part(progress, 0.5, 1.0))
        write_player(path, shown)
    return [path], {"start": span.start, "end": span.end}


def _write_film(
    plan: "Plan", asked: Path, options: dict[str, Any], quiet: bool
) -> tuple[list[Path], dict[str, Any]]:
    """The film; and what it holds."""
    from benchdragon.export.film import RATES, SIZES, Film, film_path, write_film
    from benchdragon.files import refuse_existing

    path = film_path(asked)
    look = _look(options, SIZES[path.suffix])
    film = Film(
        plan, *parse_span(options), options["fps"] or RATES[path.suffix], options["speed_up"] or 1.0
    )
    refuse_existing([path], options["force"])
    with shown_progress(quiet, remaining=True) as progress:
        write_film(film, path, look, progress)
    return [path], {
        "frames": len(film.times),
        "fps": film.fps,
        "size": look.size,
        "start": float(film.times[0]),
        "end": float(film.times[-1]),
    }


def _write_pictures(
    plan: "Plan", path: Path, options: dict[str, Any], quiet: bool
) -> tuple[list[Path], dict[str, Any]]:
    """The still or stills, or the sheet; and what they hold."""
    import numpy as np

    from benchdragon.export.film import SIZES, spread_times, still_paths, write_sheet, write_stills
    from benchdragon.files import refuse_existing

    look = _look(options, SIZES[".mp4"])
    grid = parse_sides("--sheet", options["sheet"]) if options["sheet"] else (1, 1)
    if options["at"] is None:
        times = spread_times(plan, *parse_span(options), grid[0] * grid[1])
    else:
        times = np.array(list(dict.fromkeys(parse_times(options["at"]).tolist())))
    files = [path] if options["sheet"] else still_paths(path, times.tolist())
    refuse_existing(files, options["force"])
    with shown_progress(quiet, remaining=len(files) > 1) as progress:
        if options["sheet"]:
            write_sheet(plan, times, path, look, *grid)
        else:
            write_stills(plan, times, files, look, progress)
    return files, {"times": times.tolist(), "size": look.size}
