"""The verb `area`: the ground that a dance covers, as numbers and as files."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import about, print_answer, print_title
from benchdragon.cli.console import print_files, print_json, shown_progress
from benchdragon.cli.options import only_with, output_option, plan_to_walk, take, verb
from benchdragon.cli.parsing import (
    PAPERS,
    check_ending,
    parse_length,
    parse_names,
    parse_scale,
    parse_span,
)
from benchdragon.i18n import N_, _
from benchdragon.number_format import rounded_up

if TYPE_CHECKING:
    from benchdragon.analysis.swept import SweptArea

DRAWINGS, DATA = ("svg", "pdf"), ("dxf", "geojson")


@verb("area turn -o turn.pdf --margin 2 --scale 1:200 --paper A3")
@take("plan")
@output_option(
    N_("File to write: .svg or .pdf, to scale; .dxf for CAD; .geojson. Default: numbers alone."),
    required=False,
)
@click.option(
    "--format",
    "formats",
    metavar="LIST",
    help=N_("Write these beside one another, for example svg,dxf. Default: as FILE ends."),
)
@take("span")
@click.option(
    "--margin",
    default="0",
    metavar="LENGTH",
    help=N_("How far spectators keep from the ground covered: metres (2) or with a unit (50 cm)."),
)
@click.option(
    "--error",
    default="1cm",
    metavar="LENGTH",
    help=N_("No point of the area is farther than this from what is covered; 0.1 mm to 1 m."),
)
@click.option(
    "--scale",
    metavar="1:NUMBER",
    help=N_("Scale of svg and pdf, 1:50 to 1:1000. Default: the largest usual one that fits."),
)
@click.option(
    "--paper",
    type=click.Choice(PAPERS, case_sensitive=False),
    default="A3",
    help=N_("Paper of svg and pdf."),
)
@take("force", "json", "brackets", "shared")
def area(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """The ground that a dance covers: its area, its widest place, the spectators' line, drawings to
    scale.
    """
    files = _files(options["output"], options["formats"])
    kinds = {path.suffix[1:] for path in files}
    only_with("-o", bool(files), "formats", "force")
    only_with(".svg, .pdf", bool(kinds & set(DRAWINGS)), "scale", "paper")
    margin = parse_length("--margin", options["margin"])
    error = parse_length("--error", options["error"])
    scale = parse_scale("--scale", options["scale"])
    span = parse_span(options)
    read = plan_to_walk(plan, settings, quiet)
    from benchdragon.export.area import drawing_of, planned_area, write_area
    from benchdragon.figures.scale import check_scale
    from benchdragon.files import refuse_existing

    check_scale(scale)
    refuse_existing(files, options["force"])
    with shown_progress(quiet) as progress:
        found = planned_area(read, *span, margin=margin, error=error, progress=progress)
        drawing = drawing_of(read, found)
        for path in files:
            write_area(drawing, path, read.sha256, paper=options["paper"], scale=scale)
    if options["as_json"]:
        print_json({**area_record(found), **about(read, [])}, files)
        return 0
    print_title(read)
    _print_area(found, options["brackets"])
    print_files(files)
    return 0


def _files(path: Path | None, formats: str | None) -> list[Path]:
    """The files to write."""
    if path is None:
        return []
    check_ending("-o", path, [f".{name}" for name in DRAWINGS + DATA])
    if formats is None:
        return [path]
    return [path.with_suffix(f".{name}") for name in parse_names("--format", formats, DRAWINGS + DATA)]


def area_record(found: "SweptArea") -> dict[str, Any]:
    """The record of an area, as plain data."""
    (outer, holes), (line, gaps) = found.outlines, found.lines
    rectangle, circle, widest = *found.enclosing, found.widest
    return {
        "start": found.start,
        "end": found.end,
        "area": found.area,
        "error": found.error,
        "outlines": len(outer),
        "holes": len(holes),
        "widest": {**asdict(widest), "width": widest.width.as_json()},
        "rectangle": {
            **asdict(rectangle),
            "corners": rectangle.corners.tolist(),
            "area": rectangle.area.as_json(),
        },
        "circle": {**asdict(circle), "radius": circle.radius.as_json()},
        "spectators": {
            "margin": found.margin,
            "area": float(found.spectators.area),
            "length": float(found.spectators.length),
            "outlines": len(line),
            "holes": len(gaps),
        },
    }


def _print_area(found: "SweptArea", brackets: bool) -> None:
    outer, holes = found.outlines
    text = _("ground covered from t = {start} s to t = {end} s: {area} m², within {error} m")
    click.echo(
        text.format(
            start=f"{found.start:g}", end=f"{found.end:.6g}", area=f"{found.area:.2f}",
            error=f"{found.error:.2g}",
        )
    )  # fmt: skip
    text = _("outer boundaries: {outer}; holes in it: {holes}")
    click.echo(text.format(outer=len(outer), holes=len(holes)))
    widest = found.widest
    print_answer(_("widest across the route"), widest.width, up=True, brackets=brackets)
    text = _("  at s = {s} m, at ({x}, {y}) m: {left} m to the left, {right} m to the right")
    x, y = widest.point
    click.echo(
        text.format(
            s=f"{widest.s:.2f}", x=f"{x:.2f}", y=f"{y:.2f}", left=f"{widest.left:.3f}",
            right=f"{widest.right:.3f}",
        )
    )  # fmt: skip
    rectangle, circle = found.enclosing
    text = _("smallest rectangle that holds it: {width} m by {height} m")
    click.echo(text.format(width=rounded_up(rectangle.width), height=rounded_up(rectangle.height)))
    text = _("smallest circle that holds it: radius {radius} m about ({x}, {y}) m")
    x, y = circle.centre
    click.echo(text.format(radius=rounded_up(circle.radius.upper), x=f"{x:.2f}", y=f"{y:.2f}"))
    if found.margin:
        around, gaps = found.lines
        text = _(
            "spectators {margin} m from it: {length} m of line, {outer} around the outside, {holes} "
            "around holes"
        )
        length = f"{found.spectators.length:.1f}"
        click.echo(
            text.format(margin=f"{found.margin:g}", length=length, outer=len(around), holes=len(gaps))
        )
