"""The timetable of a dance: as lines of text, a PDF page and a workbook; and its drum."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from benchdragon.analysis.beats import Score, counted_in, score_of
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.marks import Marks, between, nearest_mark
from benchdragon.analysis.stops import stops_of, stops_sentence
from benchdragon.analysis.timetable import Passing, timetable
from benchdragon.export.document import Block, Document, Heading, Paragraph, Table
from benchdragon.export.pages import write_pdf
from benchdragon.export.tables import workbook
from benchdragon.files import whole_bytes
from benchdragon.i18n import _, language
from benchdragon.model.base_curve import Point
from benchdragon.plans.schema import Plan
from benchdragon.sheets.briefing import Briefing, dated

# Columns: shares of the width.
WIDTHS = (0.34, 0.12, 0.2, 0.18, 0.16, 0.16)


def passings_of(briefing: Briefing) -> tuple[Passing, ...]:
    """The timetable of the dance that was checked."""
    report = briefing.report
    return timetable(report.plan, report.walk, report.start, report.end)


def columns() -> tuple[str, ...]:
    """The headings of the columns."""
    return (
        _("place"), _("way (m)"), _("mark"), _("x, y from the peg (m)"), _("head"), _("tail"),
    )  # fmt: skip


def cells(row: Passing, clock: Clock, ground: Ground, marks: Marks | None) -> tuple[str, ...]:
    """A row of the table as text, with its place by the chalk plan's marks and as measured."""

    def at(time: float | None) -> str:
        return "-" if time is None else clock.tell(time)

    head = at(row.head)
    if row.until is not None and row.head is not None and row.until > row.head:
        head = _("{start} to {end}").format(start=head, end=at(row.until))
    x, y = ground.seen([row.point])[0].tolist()
    mark = "-" if marks is None else mark_name(marks, row.s, row.point)
    return row.name, f"{row.way:z.2f}", mark, f"{x:z.2f}, {y:z.2f}", head, at(row.tail)


def mark_name(marks: Marks, s: float, point: Point) -> str:
    """At which mark of the chalk plan a place along the route, m, is, or between which."""
    found = between(marks, s)
    if found is None:
        return _("by {n}").format(n=nearest_mark(marks, point)[0])
    n, past = found
    return _("{n} to {next}").format(n=n, next=n + 1) if past else str(n)


def printed_rows(
    passings: Iterable[Passing], clock: Clock, ground: Ground, marks: Marks | None
) -> tuple[tuple[str, ...], ...]:
    """All rows of the table as text; without the column of the tail, if that comes to no place."""
    told = list(passings)
    count = len(WIDTHS) - without_tail(told)
    return tuple(cells(row, clock, ground, marks)[:count] for row in told)


def time_table(briefing: Briefing) -> Table:
    """The table of a dance that was checked; as many columns as `printed_rows` has."""
    passings = passings_of(briefing)
    count = len(WIDTHS) - without_tail(passings)
    rows = printed_rows(passings, briefing.clock, briefing.ground, briefing.marks)
    name = _("When the head passes") if without_tail(passings) else _("When head and tail pass")
    return Table("timetable", name, columns()[:count], WIDTHS[:count], rows, numbers=True)


def without_tail(passings: Iterable[Passing]) -> bool:
    """Whether the tail comes to none of the places while the dance lasts."""
    return all(row.tail is None for row in passings)


def timetable_document(briefing: Briefing) -> Document:
    """The timetable as a document of a page or a few."""
    report, plan = briefing.report, briefing.plan
    passings = passings_of(briefing)
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
        *told_lines(passings),
        time_table(briefing),
    )
    return Document(
        title, language(), briefing.checked_on, blocks, briefing.foot, dated(briefing.checked_on)
    )


def _count_in(score: Score, start: float) -> list[Paragraph]:
    """How many beats of the track count in before the dance starts, s."""
    first = counted_in(score).runs[:1]
    if not first or first[0].start >= start:
        return []
    text = _("beat.wav counts {beats} beats in: the head sets out on the next one.")
    return [Paragraph((text.format(beats=first[0].beats()),))]


def told_lines(passings: Sequence[Passing]) -> list[Paragraph]:
    """What the columns of times count, and what a dash in them means, where there is one."""
    return [Paragraph((text,)) for text in told_sentences(passings)]


def told_sentences(passings: Sequence[Passing]) -> list[str]:
    """The same as sentences."""
    if without_tail(passings):
        return [
            _(
                "The dance ends before the tail comes as far as any of these: only the head is told "
                "of, by its front handle."
            )
        ]
    said = [
        _(
            "The head is there with its front handle, the tail with its last handle: then all have "
            "passed. The tail's own sheet tells of its front handle, which is there a little earlier."
        )
    ]
    if any(row.head is None or row.tail is None for row in passings):
        said.append(_("-: the head, or the tail, does not pass there while the dance lasts."))
    return said


def write_timetable_pdf(path: Path, briefing: Briefing) -> None:
    """Write the timetable as a PDF."""
    write_pdf(path, timetable_document(briefing), path.parent)


def write_timetable_xlsx(path: Path, briefing: Briefing) -> None:
    """Write the timetable as a workbook, with times as seconds since the start of the dance too."""
    start = briefing.report.start
    with whole_bytes(path) as made, workbook(made) as book:
        sheet = book.add_worksheet(_("Timetable"))
        tenths = book.add_format({"num_format": "0.0"})
        sheet.freeze_panes(1, 1)
        sheet.set_column(0, 0, 30)
        sheet.set_column(1, 9, 14)
        names = (
            _("head (s from the start)"),
            _("sets out again after a stop (s from the start)"),
            _("tail (s from the start)"),
        )
        for column, text in enumerate((*columns(), *names)):
            sheet.write_string(0, column, text)
        passings = passings_of(briefing)
        for n, row in enumerate(passings, start=1):
            for column, text in enumerate(cells(row, briefing.clock, briefing.ground, briefing.marks)):
                sheet.write_string(n, column, text)
            held = row.until if row.head is not None and _goes_on(row, briefing.report.end) else None
            for column, time in enumerate((row.head, held, row.tail), start=len(WIDTHS)):
                if time is not None:
                    sheet.write_number(n, column, round(time - start, 1), tenths)
        told = told_sentences(passings)
        foot = (briefing.clock.legend, briefing.ground.legend, *told, briefing.foot)
        for k, text in enumerate(foot, start=2):
            sheet.write_string(n + k, 0, text)


def _goes_on(row: Passing, end: float) -> bool:
    """Whether the head stands at a place and goes on before the dance ends, s."""
    return row.head is not None and row.until is not None and row.head < row.until < end


def tempo_text(plan: Plan, score: Score) -> str:
    """The tempo, and where it comes from, in the language in use."""
    if not score.by_step:
        return _("{tempo} beats a minute, as the plan says").format(tempo=f"{score.tempo:.4g}")
    return _("{tempo} beats a minute: a step of {step} cm a beat at the head's speed").format(
        tempo=f"{score.tempo:.4g}", step=f"{100.0 * plan.people.step:g}"
    )
