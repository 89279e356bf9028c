"""The chalk plan: marks on the ground, drawn to scale, tiled for small printers, and listed."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchdragon.analysis.ground import Ground, way_out
from benchdragon.analysis.marks import (
    ANGLE_STEP,
    LENGTH_STEP,
    Kind,
    Marks,
    rounded,
)
from benchdragon.errors import InputError
from benchdragon.export.document import Block, Document, Heading, Paragraph, Table, say
from benchdragon.export.pages import write_pdf
from benchdragon.export.tables import workbook
from benchdragon.export.tiles import write_tiles
from benchdragon.figures.chalk import BASES, ChalkDrawing, chalk_picture
from benchdragon.figures.scale import PAPERS, Sheet
from benchdragon.figures.style import write_picture
from benchdragon.files import whole_bytes
from benchdragon.i18n import _, language
from benchdragon.model.obstacle import Obstacle
from benchdragon.sheets.briefing import Briefing, dated
from benchdragon.sheets.options import ChalkOptions

# Assumed of two people with a tape: minutes that a mark takes, when they have the knack and before.
MINUTES = (1.0, 2.0)
FILES = ("chalk.pdf", "chalk-drawing.pdf", "chalk-tiles.pdf", "chalk.xlsx")
# A cell of the list.
Cell = str | int | float
# Columns of the list: angles, and how wide they are beside one another in print.
ANGLE, WIDTHS = 5, (4.0, 7.5, 7.0, 7.0, 7.0, 8.0, 6.5, 7.0, 5.0, 8.0, 9.0)


def chalk_drawing(briefing: Briefing) -> ChalkDrawing:
    """The marks of a dance and what is drawn with them.

    Raises:
        InputError: for marks that are too many.
    """
    plan = briefing.plan
    return ChalkDrawing(
        plan.title(language()), briefing.marks, briefing.trail, plan.obstacles(), briefing.every,
        briefing.foot,
    )  # fmt: skip


def write_chalk(briefing: Briefing, folder: Path, options: ChalkOptions) -> list[Path]:
    """Write the chalk plan's files into a folder that is there.

    chalk.pdf tells how it is laid out and lists the marks, as chalk.xlsx does; chalk-drawing.pdf is the
    drawing on one sheet, chalk-tiles.pdf the same on pages to be glued together.

    Raises:
        InputError: for marks that are too many, a paper that is not known, and ground that
            does not fit it.
    """
    if options.tile not in PAPERS:
        raise InputError(
            _("paper must be one of {known}, not {value}").format(
                known=", ".join(PAPERS), value=options.tile
            )
        )
    drawing = chalk_drawing(briefing)
    sheet = drawing.sheet(options.paper, options.scale)
    paths = [folder / name for name in FILES]
    figure = chalk_picture(drawing, sheet)
    write_picture(figure, paths[1], drawing.title, briefing.sha256)
    title = _("Chalk plan: {title}").format(title=drawing.title)
    write_tiles(
        paths[1].read_bytes(), paths[2], PAPERS[options.tile][::-1], title, drawing.foot,
        briefing.checked_on,
    )  # fmt: skip
    document = chalk_document(drawing, title, briefing.checked_on, sheet)
    with TemporaryDirectory() as none:
        write_pdf(paths[0], document, Path(none))
    write_list(paths[3], drawing)
    return paths


def _columns(marks: Marks) -> tuple[str, ...]:
    """Headings of the list."""
    angle = _("bearing from north (°)") if marks.north else _("angle from the x axis (°)")
    x, y, *_against = marks.ground.way_names
    return (
        _("mark"), _("along the route (m)"), _("x from the peg, {way} (m)").format(way=x),
        _("y from the peg, {way} (m)").format(way=y),
        _("from the peg (m)"), angle, _("measured from"), _("from there (m)"), _("side"),
        _("from the mark before (m)"), _("what"),
    )  # fmt: skip


def list_rows(marks: Marks) -> Iterator[tuple[Cell, ...]]:
    """What the list says of each mark, as `_columns`: lengths in m and angles in degrees, rounded."""
    for n in range(len(marks)):
        lengths = marks.way[n], *marks.offsets[n], marks.radius[n], marks.cross[n], marks.before[n]
        way, x, y, radius, cross, before = (rounded(float(one), LENGTH_STEP) for one in lengths)
        angle = rounded(float(marks.angle[n]), ANGLE_STEP) % 360.0
        side = _("left") if marks.on_left[n] else _("right")
        yield (n + 1, way, x, y, radius, angle, BASES[marks.base[n]], cross, side, before,
               kind_name(marks.kinds[n]))  # fmt: skip


def kind_name(kind: Kind) -> str:
    """What a mark is besides one of many, in the language in use."""
    return {
        "step": "",
        "joint": _("two parts of the route meet"),
        "start": _("the head's start"),
        "end": _("end"),
    }[kind]


def _printed(value: Cell, column: int) -> str:
    """A cell in print: lengths with three decimals, angles with two."""
    return f"{value:z.{2 if column == ANGLE else 3}f}" if isinstance(value, float) else str(value)


def chalk_document(drawing: ChalkDrawing, title: str, date: str, sheet: Sheet) -> Document:
    """How the marks are laid out, and their list."""
    marks = drawing.marks
    rows = tuple(
        tuple(_printed(value, column) for column, value in enumerate(row)) for row in list_rows(marks)
    )
    table = Table("marks", _("Marks on the ground"), _columns(marks), WIDTHS, rows, numbers=True)
    blocks: tuple[Block, ...] = (
        *_about(drawing, sheet),
        Heading(_("How to lay it out"), "how"),
        *_steps(marks),
        Heading(_("How exact it is"), "exact"),
        *_exactness(marks),
        table,
    )
    return Document(title, language(), date, blocks, drawing.foot, dated(date))


def _hours(marks: Marks, minutes: float) -> str:
    """How long all marks take at so many minutes each, to half an hour, rounded up."""
    return f"{math.ceil(2.0 * len(marks) * minutes / 60.0) / 2.0:g}"


def _about(drawing: ChalkDrawing, sheet: Sheet) -> Iterator[Paragraph]:
    marks, (fast, slow) = drawing.marks, MINUTES
    yield say(
        _(
            "{count} marks, one each {every} m along the route and one where two of its parts meet, on "
            "{way} m of route. The drawing is to scale 1:{scale}. Plan {foot}."
        ),
        count=len(marks), every=f"{drawing.every:g}",
        way=f"{drawing.trail.high - drawing.trail.low:.2f}", scale=f"{sheet.scale:g}",
        foot=drawing.foot,
    )  # fmt: skip
    yield say(
        _(
            "Two people who need {fast} to {slow} minutes a mark, which is an assumption, take {least} "
            "to {most} hours. Time the first ten: all of them take {times} times as long."
        ),
        fast=f"{fast:g}", slow=f"{slow:g}", least=_hours(marks, fast), most=_hours(marks, slow),
        times=f"{math.ceil(len(marks) / 10)}",
    )  # fmt: skip
    yield say(
        _(
            "Fewer marks: write every = {twice} below [chalk] at the end of the plan, where [chalk] is "
            "a line of its own, and print all papers anew, for all marks have other numbers then."
        ),
        twice=f"{2.0 * drawing.every:g}",
    )
    if "joint" in drawing.marks.kinds:
        yield say(
            _(
                "Where two parts of the route meet nothing stands on the ground: from that mark on the "
                "line bends otherwise."
            )
        )
    sides = sorted((sheet.width, sheet.height))
    paper = next(name for name, size in PAPERS.items() if sorted(size) == sides)
    if paper == "A4":
        yield say(_("chalk-drawing.pdf is A4 already: chalk-tiles.pdf need not be printed."))
    else:
        yield say(
            _(
                "chalk-drawing.pdf is {paper}. On A4 print chalk-tiles.pdf instead, or write the "
                "drawing again with --paper-size A4 if it fits."
            ),
            paper=paper,
        )
    yield from _ground(drawing)


def _ground(drawing: ChalkDrawing) -> Iterator[Paragraph]:
    """Where the peg stands, and which way the axes point on the ground."""
    marks = drawing.marks
    yield Paragraph((marks.ground.legend,))
    if marks.north:
        yield say(
            _("The plan's survey says where north is: along y. Bearings run clockwise from north.")
        )
    else:
        yield say(_("Angles run counter-clockwise from the x axis."))
    if drawing.obstacles and not marks.north and not marks.ground.venue:
        yield say(
            _(
                "The drawing shows what stands on the ground: lay it so that both agree, and x and y "
                "point on the ground as they do on it."
            )
        )
    elif not drawing.obstacles and not marks.north:
        yield say(_("You choose on the ground which way x points."))
    yield from peg_lines(marks.ground, drawing.obstacles)


def peg_lines(ground: Ground, obstacles: Sequence[Obstacle]) -> Iterator[Paragraph]:
    """How far the peg is from the venue's edge, if it stands within one."""
    edges = edge_lengths(ground, obstacles)
    if edges is not None:
        text = _(
            "From the peg to the venue's edge it is {first} m {a}, {second} m {b}, {third} m {c}, "
            "{fourth} m {d}. Find the peg's place by these lengths, and the directions with it."
        )
        first, second, third, fourth = (f"{rounded(one, LENGTH_STEP):.3f}" for one in edges)
        a, b, c, d = ground.way_names
        yield say(text, first=first, second=second, third=third, fourth=fourth, a=a, b=b, c=c, d=d)


def edge_lengths(ground: Ground, obstacles: Sequence[Obstacle]) -> list[float] | None:
    """From the peg to the venue's edge the ways x and y point and against them, m.

    None if there is no venue, or the peg stands outside it.
    """
    venue = next((one for one in obstacles if one.kind == "venue"), None)
    if venue is None:
        return None
    found = [way_out(venue.outline, ground.peg, way) for way in ground.ways]
    return [one[0] for one in found if one is not None] or None


def _steps(marks: Marks) -> Iterator[Paragraph]:
    direction = _directions(marks)
    reach, across = f"{marks.reach:.3f}", f"{rounded(2.0**0.5 * marks.reach, LENGTH_STEP):.3f}"
    texts = (
        _("1. Drive the peg and hook the tape's ring over it. One holds the tape, one the chalk."),
        _(
            "2. Base point B: {reach} m from the peg, {first}. Base point C: {reach} m from the peg, "
            "{second}. From B to C it must be {across} m; if not, move C."
        ),
        _(
            "3. For each mark in the order of the list: with the tape on the peg draw a short arc at "
            "the length from the peg; with the tape on B or C, as the list says, draw another at the "
            "length from there. They cross twice: facing that base point from the peg, take the "
            "crossing on the side that the list says. Write the mark's number beside it."
        ),
        _(
            "4. Check each mark by the tape from the mark before it. If it differs by more than two "
            "fingers, find the mistake before you go on."
        ),
        _("5. Join the marks by eye with chalk, in the order of their numbers."),
        _("6. Pull the peg out, and whatever marks B and C, before anybody dances."),
    )
    for text in texts:
        yield say(text, reach=reach, across=across, first=direction[0], second=direction[1])


def _directions(marks: Marks) -> list[str]:
    """Where base points are from the peg, in words."""
    names = marks.ground.way_names
    ways = ((marks.bases - marks.peg) / marks.reach) @ np.array(marks.ground.ways).T
    return [names[n] for n in np.argmax(ways, axis=1)]


def _exactness(marks: Marks) -> Iterator[Paragraph]:
    yield say(
        _(
            "Lengths are rounded to {length} mm, angles to {angle}°. By that alone a mark is off by at "
            "most {tape} mm if it is measured from peg and base point, {turned} mm by radius and "
            "angle, {grid} mm by x and y. The longest measure is {far} m. No mark is "
            "measured from another, so that errors do not add up."
        ),
        length=f"{1000.0 * LENGTH_STEP:g}", angle=f"{ANGLE_STEP:g}",
        tape=f"{math.ceil(1000.0 * marks.tape_error)}",
        far=f"{max(marks.radius.max(), marks.cross.max()):.2f}",
        turned=f"{math.ceil(1000.0 * marks.angle_error)}",
        grid=f"{math.ceil(1000.0 * marks.grid_error)}",
    )  # fmt: skip


def write_list(path: Path, drawing: ChalkDrawing) -> None:
    """The list of marks as XLSX, and a second sheet that says what it is."""
    marks = drawing.marks
    with whole_bytes(path) as made, workbook(made) as book:
        head = book.add_format({"bold": True, "text_wrap": True, "valign": "top"})
        length, angle = (book.add_format({"num_format": text}) for text in ("0.000", "0.00"))
        sheet = book.add_worksheet(_("Marks"))
        sheet.freeze_panes(1, 1)
        sheet.set_column(0, len(WIDTHS) - 1, 13)
        sheet.repeat_rows(0)
        sheet.set_landscape()
        sheet.fit_to_pages(1, 0)
        for column, text in enumerate(_columns(marks)):
            sheet.write_string(0, column, text, head)
        for n, row in enumerate(list_rows(marks), start=1):
            for column, value in enumerate(row):
                form = (angle if column == ANGLE else length) if isinstance(value, float) else None
                sheet.write(n, column, value, form)
        about = book.add_worksheet(_("About"))
        about.set_column(0, 0, 110, book.add_format({"text_wrap": True}))
        texts = [drawing.title, drawing.foot]
        texts += [
            "".join(map(str, one.words))
            for one in (*_ground(drawing), *_steps(marks), *_exactness(marks))
        ]
        for n, text in enumerate(texts):
            about.write_string(n, 0, text)
