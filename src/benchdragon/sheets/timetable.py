"""The timetable of a dance: as lines of text, a PDF page and a workbook; and its drum."""

from collections.abc import Iterable
from pathlib import Path

from benchdragon.analysis.beats import Score, counted_in, score_of
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.stops import stops_of, stops_sentence
from benchdragon.analysis.timetable import Passing, timetable
from benchdragon.export.document import Block, Document, Heading, Paragraph, Table
from benchdragon.export.pages import write_pdf
from benchdragon.export.tables import workbook
from benchdragon.files import whole_bytes
from benchdragon.i18n import _, language
from benchdragon.plans.schema import Plan
from benchdragon.sheets.briefing import Briefing

# Columns: shares of the width.
WIDTHS = (0.34, 0.14, 0.2, 0.16, 0.16)


def passings_of(briefing: Briefing) -> tuple[Passing, ...]:
    """The timetable of the dance that was checked."""
    report = briefing.report
    return timetable(report.plan, report.walk, report.start, report.end)


def columns() -> tuple[str, ...]:
    """What stands above the columns."""
    return (_("place"), _("way (m)"), _("x, y from the peg (m)"), _("head"), _("tail"))


def cells(row: Passing, clock: Clock, ground: Ground) -> tuple[str, ...]:
    """A row of the table as text, with its place as measured on the ground."""

    def at(time: float | None) -> str:
        return "-" if time is None else clock.tell(time)

    head = at(row.head)
    if row.until is not None and row.head is not None and row.until > row.head:
        head = _("{start} to {end}").format(start=head, end=at(row.until))
    x, y = ground.seen([row.point])[0].tolist()
    place = f"{x:z.2f}, {y:z.2f}"
    return row.name, f"{row.way:z.2f}", place, head, at(row.tail)


def printed_rows(
    passings: Iterable[Passing], clock: Clock, ground: Ground
) -> tuple[tuple[str, ...], ...]:
    """All rows of the table as text."""
    return tuple(cells(row, clock, ground) for row in passings)


def timetable_document(briefing: Briefing) -> Document:
    """The timetable as a document of a page or a few."""
    report, plan = briefing.report, briefing.plan
    passings = passings_of(briefing)
    rows = printed_rows(passings, briefing.clock, briefing.ground)
    stops = stops_of(report.walk, report.start, report.end)
    score = score_of(plan, report.start, report.end)
    title = plan.title(language()) or _("Timetable")
    blocks: tuple[Block, ...] = (
        Heading(_("Timetable"), "timetable"),
        Paragraph((briefing.clock.legend,)),
        Paragraph((stops_sentence(stops, briefing.clock),)),
        Paragraph((_("Drum: {tempo}.").format(tempo=tempo_text(plan, score)),)),
        *_count_in(score, report.start),
        Paragraph((briefing.ground.legend,)),
        *dash_line(passings),
        Table("timetable", _("When head and tail pass"), columns(), WIDTHS, rows, numbers=True),
    )
    return Document(title, language(), briefing.checked_on, blocks, briefing.foot)


def _count_in(score: Score, start: float) -> list[Paragraph]:
    """How many beats of the track count in before the dance starts, s."""
    first = counted_in(score).runs[:1]
    if not first or first[0].start >= start:
        return []
    text = _("beat.wav counts {beats} beats in: the head sets out on the next one.")
    return [Paragraph((text.format(beats=first[0].beats()),))]


def dash_line(passings: Iterable[Passing]) -> list[Paragraph]:
    """What a dash in the columns of times means, where there is one."""
    if all(row.head is not None and row.tail is not None for row in passings):
        return []
    return [Paragraph((_("-: the head, or the tail, does not pass there while the dance lasts."),))]


def write_timetable_pdf(path: Path, briefing: Briefing) -> None:
    """Write the timetable as a PDF."""
    write_pdf(path, timetable_document(briefing), path.parent)


def write_timetable_xlsx(path: Path, briefing: Briefing) -> None:
    """Write the timetable as a workbook, with times as seconds since the start of the dance too."""
    start = briefing.report.start
    with whole_bytes(path) as made, workbook(made) as book:
        sheet = book.add_worksheet(_("Timetable"))
        sheet.freeze_panes(1, 1)
        sheet.set_column(0, 0, 30)
        sheet.set_column(1, 8, 14)
        names = (
            _("head (s from the start)"),
            _("goes on (s from the start)"),
            _("tail (s from the start)"),
        )
        for column, text in enumerate((*columns(), *names)):
            sheet.write_string(0, column, text)
        for n, row in enumerate(passings_of(briefing), start=1):
            for column, text in enumerate(cells(row, briefing.clock, briefing.ground)):
                sheet.write_string(n, column, text)
            for column, time in enumerate((row.head, row.until, row.tail), start=5):
                if time is not None:
                    sheet.write_number(n, column, round(time - start, 6))
        for k, text in enumerate(
            (briefing.clock.legend, briefing.ground.legend, briefing.foot), start=2
        ):
            sheet.write_string(n + k, 0, text)


def tempo_text(plan: Plan, score: Score) -> str:
    """The tempo, and where it comes from, in the language in use."""
    if not score.by_step:
        return _("{tempo} beats a minute, as the plan says").format(tempo=f"{score.tempo:.4g}")
    return _("{tempo} beats a minute: a step of {step} cm a beat at the head's speed").format(
        tempo=f"{score.tempo:.4g}", step=f"{100.0 * plan.people.step:g}"
    )
