"""The leader's overview: the verdict, the map with all benches, who they are and what they do."""

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from benchdragon.analysis.check import sentence
from benchdragon.explain.bench_walk import bench_text, tightest_line
from benchdragon.explain.room import level_line
from benchdragon.export.document import Block, Document, Heading, Paragraph, Picture, Table, say
from benchdragon.export.pages import write_pdf
from benchdragon.export.typeset import Typeset
from benchdragon.files import whole_bytes
from benchdragon.i18n import _, language
from benchdragon.sheets.briefing import Briefing
from benchdragon.sheets.small_map import Frame, SmallMap

# Signs of people's names in a row, which must not be taller than a page.
MOST_SIGNS = 500
# Tightest moments that are listed, of different benches.
MOST_TIGHT = 3
# Size of the map, mm.
MAP = Frame(0.0, 0.0, 178.0, 150.0)


def overview(briefing: Briefing, phones: bool) -> Document:
    """The overview as a document, whose map is a picture called "map"."""
    benches = len(briefing.benches)
    blocks: list[Block] = [
        Heading(_("Verdict"), "verdict"),
        Paragraph((sentence(briefing.report, briefing.clock),)),
        Paragraph((briefing.clock.legend,)),
        say(
            _("Checked on {date}; {benches} benches, {people} people in the list of names."),
            date=briefing.checked_on, benches=benches, people=briefing.roster.persons,
        ),
        *_numbering(briefing),
        *_tightest(briefing),
        *_room(briefing),
        *_notes(briefing),
        Heading(_("Where each bench starts"), "starts"),
        Paragraph((_("Figure 1 is the map."),)),
        Picture("map", _("The square, the route, and where the front handle of each bench starts")),
        Heading(_("Benches"), "benches"),
        _table(briefing, phones),
    ]  # fmt: skip
    title = briefing.plan.title(language()) or _("Overview")
    return Document(title, language(), briefing.checked_on, tuple(blocks), briefing.foot)


def _tightest(briefing: Briefing) -> list[Block]:
    """The tightest moments, each told of one bench: where marshals stand."""
    found = [(one.tightest.upper, one.bench, one.tightest) for one in briefing.benches if one.tightest]
    lines: list[Block] = []
    told: set[int] = set()
    for _gap, bench, near in sorted(found, key=lambda one: one[:2]):
        if len(lines) < MOST_TIGHT and told.isdisjoint((bench, near.bench)):
            told |= {bench, near.bench}
            said = _("{bench}: {tightest}").format(
                bench=briefing.called(bench),
                tightest=tightest_line(near, briefing.clock, briefing.called),
            )
            lines.append(Paragraph((said,)))
    return [Heading(_("Tightest moments"), "tightest"), *lines] if lines else []


def _room(briefing: Briefing) -> list[Block]:
    """The levels of room for people, where the plan asks for any."""
    if not briefing.report.room:
        return []
    lines = [Paragraph((level_line(level),)) for level in briefing.report.room]
    return [Heading(_("Room for people"), "room"), *lines]


def _numbering(briefing: Briefing) -> list[Block]:
    """How benches are numbered in the verdict, where the village counts otherwise."""
    if briefing.plan.people.count_head:
        return []
    return [Paragraph((_("In the verdict bench 1 is the head's, bench 2 the next."),))]


def _notes(briefing: Briefing) -> list[Block]:
    """What is odd about the list of names."""
    if not briefing.roster.notes:
        return []
    said = [Paragraph((note,)) for note in briefing.roster.notes]
    return [Heading(_("Notes on the list of names"), "notes"), *said]


def _table(briefing: Briefing, phones: bool) -> Table:
    """A row for each bench."""
    columns = (
        _("bench"), _("people"), _("starts from the peg: x, y (m)"), _("what it does"), _("tightest"),
    )  # fmt: skip
    rows = tuple(row for n in range(len(briefing.benches)) for row in _rows(briefing, n + 1, phones))
    caption = _("All benches: who carries them, where they start, what they do")
    return Table("all", caption, columns, (12.0, 26.0, 14.0, 30.0, 34.0), rows)


def _rows(briefing: Briefing, bench: int, phones: bool) -> Iterator[tuple[str, ...]]:
    """The row of a bench, and more below it where its people are too many for one."""
    found = briefing.benches[bench - 1]
    text = bench_text(briefing.plan, found, briefing.called, briefing.peg)
    people = [
        f"{one.name} {one.phone}" if phones and one.phone else one.name
        for one in briefing.roster.people(bench)
    ]
    x, y = found.place_from(briefing.peg)
    told = f"{x:z.2f}, {y:z.2f}", text.quick, text.tightest
    size = max(1, MOST_SIGNS // max(map(len, people), default=1))
    yield briefing.called(bench), _(", ").join(people[:size]), *told
    for n in range(size, len(people), size):
        yield briefing.called(bench), _(", ").join(people[n : n + size]), "", "", ""


def _write_map(path: Path, briefing: Briefing) -> None:
    """The map as a page of its size."""
    pdf = Typeset(briefing.checked_on)
    pdf.set_auto_page_break(False)
    pdf.c_margin = 0.0
    pdf.add_page(format=(MAP.width, MAP.height))
    SmallMap(briefing).draw_starts(pdf, MAP)
    with whole_bytes(path) as made:
        made.write(bytes(pdf.output()))


def write_overview(path: Path, briefing: Briefing, phones: bool) -> None:
    """Write the overview as a PDF."""
    with TemporaryDirectory() as folder:
        _write_map(Path(folder) / "map.pdf", briefing)
        write_pdf(path, overview(briefing, phones), Path(folder))
