"""The leader's overview: the verdict, the map with all benches, who they are and what they do."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import shapely
from shapely.geometry import LineString

from benchdragon.analysis.bench_walks import BenchWalk
from benchdragon.analysis.check import sentence
from benchdragon.analysis.findings import named, shown_name
from benchdragon.analysis.ground import way_out
from benchdragon.analysis.marks import Marks, between, nearest_mark
from benchdragon.explain.bench_basis import bench_text
from benchdragon.explain.bench_text import BenchText, tightest_line
from benchdragon.explain.room import level_line, plain_asked
from benchdragon.export.document import Block, Document, Heading, Paragraph, Picture, Table, say
from benchdragon.export.pages import write_pdf
from benchdragon.export.typeset import Typeset
from benchdragon.files import whole_bytes
from benchdragon.i18n import _, language
from benchdragon.kernels.bench_nearness import REACH
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.outline import shape_of
from benchdragon.rosters.roster import Person, phones_of
from benchdragon.sheets.briefing import Briefing, dated
from benchdragon.sheets.small_map import Frame, SmallMap

# Signs of people's names in a row, which must not be taller than a page.
MOST_SIGNS = 500
# Tightest moments that are listed, of different benches, and how far apart they are at least, m.
MOST_TIGHT, TIGHT_APART = 3, 3.0
# The columns of a bench's walk and of the nearest bench, and the sign for none.
WHAT, TIGHTEST, NONE = 4, 5, "-"
# How far ahead one looks where there is no venue, m.
FAR = 20.0
# Size of the map at most, mm.
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
        *_coming(briefing),
        *_room(briefing),
        *_notes(briefing),
        Heading(_("Where each bench starts"), "starts", room=_map_frame(briefing).height),
        Paragraph((briefing.ground.legend,)),
        Picture("map", _("The square, the route, and where the front handle of each bench starts")),
        Heading(_("Benches"), "benches"),
        *_benches(briefing, phones),
    ]  # fmt: skip
    title = briefing.plan.title(language()) or _("Overview")
    return Document(
        title, language(), briefing.checked_on, tuple(blocks), briefing.foot, dated(briefing.checked_on)
    )


def _tightest(briefing: Briefing) -> list[Block]:
    """The tightest moments, one bench each, and where on the ground to watch it."""
    found = [(one.tightest.upper, one.bench, one.tightest) for one in briefing.benches if one.tightest]
    lines: list[Block] = []
    told, places = set[int](), list[tuple[float, float]]()
    for _gap, bench, near in sorted(found, key=lambda one: one[:2]):
        elsewhere = all(math.dist(near.place, place) >= TIGHT_APART for place in places)
        if len(lines) < MOST_TIGHT and elsewhere and told.isdisjoint((bench, near.bench)):
            told |= {bench, near.bench}
            places.append(near.place)
            said = _("{bench}, at mark {mark} then: {tightest}").format(
                bench=briefing.called(bench),
                mark=nearest_mark(briefing.marks, near.place)[0],
                tightest=tightest_line(near, briefing.clock, briefing.called, its=True),
            )
            lines.append(Paragraph((said,)))
    if not lines:
        text = _(
            "No bench of another coil comes within about {reach} m of any: for that nobody need stand "
            "by. Posts of the permit annex are there for other reasons too."
        )
        lines = [say(text, reach=f"{REACH:g}")]
    return [Heading(_("Tightest moments between coils"), "tightest"), *lines]


def _coming(briefing: Briefing) -> list[Block]:
    """From which mark of the chalk plan to come in, and how to leave."""
    kinds = briefing.marks.kinds
    coming = _(
        "To line up, the head comes in at mark {first} of the chalk plan and walks slowly along the "
        "line to mark {start}; the others follow. Then each bench stands where its sheet says. The "
        "check says nothing of this walk, nor of leaving."
    )
    leaving = _("At the end the head stands at mark {last}, and goes on from there.")
    if briefing.plan.route.kind == "spiral-in":
        leaving = _(
            "At the end the head stands inside, at mark {last}: pull the pins from the tail on, and "
            "walk out bench by bench."
        )
    return [
        Heading(_("Coming and leaving"), "coming"),
        say(coming, first=1, start=kinds.index("start") + 1),
        *_way_in(briefing),
        say(leaving, last=len(kinds)),
        *_way_out(briefing),
    ]


def _way_in(briefing: Briefing) -> Iterator[Block]:
    """Where the first mark is, how far the head walks from there before the dance, and how long."""
    plan, trail = briefing.plan, briefing.trail
    first = float(briefing.marks.points[0, 0]), float(briefing.marks.points[0, 1])
    way = trail.start - trail.low
    text = _(
        "Mark 1 is {far} from the peg. From there to where the dance starts the head walks {way} m: "
        "{minutes} min at the speed of the dance. Have all in line before it starts."
    )
    if plan.walk.profile:
        text = _(
            "Mark 1 is {far} from the peg. From there to where the dance starts the head walks {way} "
            "m. Have all in line before it starts."
        )
    yield say(
        text, far=_offset(briefing, briefing.ground.peg, first), way=f"{way:.0f}",
        minutes=math.ceil(way / plan.walk.speed / 60.0),
    )  # fmt: skip
    yield from _behind_the_first(briefing, first)
    for n, place in _nearest_entrance(briefing, first):
        text = _("Entrance {n} of the plan is nearest to mark 1, which is {far} from it.")
        yield say(text, n=n, far=_offset(briefing, place, first))


def _behind_the_first(briefing: Briefing, first: Point) -> Iterator[Block]:
    """The approach to the first mark along the line of the route, and obstacles there."""
    blocked = _(
        "Back along the line from mark 1, {name} is in the way after {far} m: come to the line from "
        "the side."
    )
    free = _("Back along the line from mark 1 it is {far} m to the {edge} of {venue}.")
    yield from _straight_on(briefing, first, -_ahead(briefing, briefing.trail.low), blocked, free)


def _ahead(briefing: Briefing, s: float) -> FloatArray:
    """The unit vector along the route at a position, m, (2,)."""
    heading = float(briefing.report.walk.route.heading([s])[0])
    return np.array([math.cos(heading), math.sin(heading)])


def _venue(briefing: Briefing) -> Obstacle | None:
    """The venue, if the plan has one."""
    return next((one for one in briefing.plan.obstacles() if one.kind == "venue"), None)


def _straight_on(
    briefing: Briefing, start: Point, way: FloatArray, blocked: str, free: str
) -> Iterator[Block]:
    """What one meets who goes straight on from a place, m: an obstacle, else the venue's edge."""
    venue = _venue(briefing)
    found = None if venue is None else way_out(venue.outline, start, way)
    met = _in_the_way(briefing, start, way, FAR if found is None else found[0])
    if met is not None:
        yield say(blocked, name=met[1], far=f"{met[0]:.1f}")
    elif venue is not None and found is not None:
        far, out = found
        x, y = (np.array(start) + far * way).tolist()
        edge = briefing.ground.edge_name(briefing.ground.edge(out))
        yield say(
            free, edge=edge, venue=named(venue), far=f"{far:.1f}",
            place=_offset(briefing, briefing.ground.peg, (x, y)),
        )  # fmt: skip


def _in_the_way(
    briefing: Briefing, place: Point, way: FloatArray, far: float
) -> tuple[float, str] | None:
    """Distance to and name of the obstacle straight ahead of a bench within so many m."""
    people, start = briefing.plan.people, np.array(place)
    line = LineString([start, start + far * way])
    aside = 0.5 * float(briefing.report.walk.dragon.width.max())
    aside += people.beside + people.sway + people.imprecision
    found = []
    for one in briefing.plan.obstacles():
        room = shape_of(one).buffer(one.radius + one.margin + aside)
        if one.kind != "venue" and line.intersects(room):
            found.append((shapely.Point(start).distance(line.intersection(room)), named(one)))
    return min(found, default=None)


def _nearest_entrance(briefing: Briefing, place: Point) -> Iterator[tuple[int, Point]]:
    """The plan's entrance that is nearest to a place, m, with its number from 1, if it has any."""
    entrances = enumerate(briefing.plan.event.entrances, start=1)
    yield from sorted(entrances, key=lambda one: math.dist(one[1], place))[:1]


def _offset(briefing: Briefing, start: Point, end: Point) -> str:
    """Where a place lies from another, m, as one measures it on the ground."""
    ground = briefing.ground
    (x, y), (to_x, to_y) = ground.seen([start, end]).tolist()
    right, forward, left, back = ground.way_names
    return _("{x} m {way_x} and {y} m {way_y}").format(
        x=f"{abs(to_x - x):.1f}", way_x=right if to_x >= x else left,
        y=f"{abs(to_y - y):.1f}", way_y=forward if to_y >= y else back,
    )  # fmt: skip


def _way_out(briefing: Briefing) -> Iterator[Block]:
    """Where edge and entrances are from the one who leads out: the tail of a coil, else the head."""
    coiled = briefing.plan.route.kind == "spiral-in"
    ends = briefing.report.walk.motion([briefing.report.end])
    leader = -1 if coiled else 0
    place = float(ends.x[0, leader]), float(ends.y[0, leader])
    if coiled:
        yield from _nearest_edge(briefing, place)
    else:
        blocked = _(
            "Straight on from there {name} is in the way, {far} m ahead: bend away before it, no more "
            "sharply than in the dance. The plan says nothing of that way."
        )
        free = _(
            "Straight on from there it is {far} m to the {edge} of {venue}, which is met {place} from "
            "the peg. The plan says nothing of that way: open the edge there, or bend before it no "
            "more sharply than in the dance."
        )
        ahead = _ahead(briefing, float(ends.s[0, leader]))
        yield from _straight_on(briefing, place, ahead, blocked, free)
    for n, entrance in _nearest_entrance(briefing, place):
        text = _("Entrance {n} of the plan is then nearest to the head: {far} from it.")
        if coiled:
            text = _("Entrance {n} of the plan is then nearest to the tail: {far} from it.")
        yield say(text, n=n, far=_offset(briefing, place, entrance))


def _nearest_edge(briefing: Briefing, tail: Point) -> Iterator[Block]:
    """Which edge of the venue is nearest to the tail of a coil, where it stands, m."""
    venue = _venue(briefing)
    found = None if venue is None else way_out(venue.outline, tail)
    if venue is not None and found is not None:
        text = _("The nearest edge to the tail is then the {edge} of {venue}: {far} m away.")
        edge = briefing.ground.edge_name(briefing.ground.edge(found[1]))
        yield say(text, edge=edge, venue=named(venue), far=f"{found[0]:.1f}")


def _room(briefing: Briefing) -> list[Block]:
    """The levels of room for people, where the plan asks for any."""
    if not briefing.report.room:
        return []
    lines = [Paragraph((level_line(level, plain_asked),)) for level in briefing.report.room]
    return [Heading(_("Room for people"), "room"), *lines]


def _numbering(briefing: Briefing) -> list[Block]:
    """How benches are numbered in a verdict of what is wrong, where the village counts otherwise."""
    if briefing.report.safe or briefing.plan.people.count_head:
        return []
    return [Paragraph((_("In the verdict bench 1 is the head's, bench 2 the next."),))]


def _notes(briefing: Briefing) -> list[Block]:
    """What is odd about the list of names."""
    said = [Paragraph((note,)) for note in (*briefing.missing_signs, *briefing.roster.notes)]
    if not said:
        return []
    return [Heading(_("Notes on the list of names"), "notes"), *said]


def _benches(briefing: Briefing, phones: bool) -> Iterator[Block]:
    """A row for each bench; what all of them do alike is said once above."""
    texts = [
        bench_text(briefing.plan, found, briefing.called, briefing.ground) for found in briefing.benches
    ]
    alike = len(texts) > 1 and len({text.quick for text in texts}) == 1
    if alike:
        yield say(_("All benches: {what}"), what=texts[0].quick)
    near = [found.tightest is not None for found in briefing.benches]
    if any(near) and not all(near):
        text = _("{dash}: no bench of another coil comes within about {reach} m of it.")
        yield say(text, dash=NONE, reach=f"{REACH:g}")
    columns = (
        _("bench"), _("people"), _("mark"), _("starts from the peg: x, y (m)"), _("what it does"),
        _("tightest"),
    )  # fmt: skip
    widths = (11.0, 23.0, 13.0, 13.0, 27.0, 34.0)
    starts = briefing.report.walk.motion([briefing.report.start]).s[0, :-1].tolist()
    rows = [
        row
        for found, start, text in zip(briefing.benches, starts, texts, strict=True)
        for row in _rows(briefing, found, start, text, phones)
    ]
    kept = [
        n for n in range(len(columns)) if not (alike and n == WHAT) and (any(near) or n != TIGHTEST)
    ]
    title = _("All benches: who carries them, where they start, what they do")
    if alike:
        title = _("All benches: who carries them, where they start, how near others come")
    if alike and not any(near):
        title = _("All benches: who carries them, where they start")
    yield Table(
        "all",
        title,
        tuple(columns[n] for n in kept),
        tuple(widths[n] for n in kept),
        tuple(tuple(row[n] for n in kept) for row in rows),
    )


def _rows(
    briefing: Briefing, found: BenchWalk, start: float, text: BenchText, phones: bool
) -> Iterator[tuple[str, ...]]:
    """The row of a bench, whose front handle starts at `start`, m; more below where people are many."""
    people = _people(briefing.roster.people(found.bench), phones) or [_("(nobody)")]
    x, y = briefing.ground.seen([found.place])[0].tolist()
    tightest = NONE
    if found.tightest is not None:
        tightest = tightest_line(found.tightest, briefing.clock, briefing.called, its=True)
    mark = mark_name(briefing.marks, start, found.place)
    told = mark, f"{x:z.2f}, {y:z.2f}", text.quick, tightest
    size = max(1, MOST_SIGNS // max(map(len, people)))
    yield briefing.called(found.bench), _(", ").join(people[:size]), *told
    for n in range(size, len(people), size):
        yield briefing.called(found.bench), _(", ").join(people[n : n + size]), "", "", "", ""


def mark_name(marks: Marks, s: float, point: Point) -> str:
    """At which mark of the chalk plan a place along the route, m, is, or between which."""
    found = between(marks, s)
    if found is None:
        return _("by {n}").format(n=nearest_mark(marks, point)[0])
    n, past = found
    return _("{n} to {next}").format(n=n, next=n + 1) if past else str(n)


def _people(people: Sequence[Person], phones: bool) -> list[str]:
    """People as the leader reads of them: phones if asked for, and what the list remarks.

    What a row of the list remarks of several at once is said once, behind the last of them.
    """
    own, home = phones_of(people)
    told = []
    for n, (one, phone) in enumerate(zip(people, own, strict=True)):
        after = people[n + 1] if n + 1 < len(people) else None
        name = f"{one.name} {phone}" if phones and phone else one.name
        if one.remarks and not (after and after.remarks == one.remarks):
            name = _("{name} ({remarks})").format(name=name, remarks=one.remarks)
        told.append(name)
    if phones:
        told += [_("phone of the household: {phone}").format(phone=phone) for phone in home]
    return told


def _map_frame(briefing: Briefing) -> Frame:
    """The map's frame on a page of its size."""
    return SmallMap(briefing).as_tall_as_needed(MAP)


def _write_map(path: Path, briefing: Briefing) -> None:
    """The map as a page of its size."""
    names = [shown_name(one) for one in briefing.plan.obstacles()]
    pdf = Typeset(briefing.checked_on, repr(names))
    pdf.set_auto_page_break(False)
    pdf.c_margin = 0.0
    frame = _map_frame(briefing)
    pdf.add_page(format=(frame.width, frame.height))
    SmallMap(briefing).draw_starts(pdf, frame)
    with whole_bytes(path) as made:
        made.write(bytes(pdf.output()))


def write_overview(path: Path, briefing: Briefing, phones: bool) -> None:
    """Write the overview as a PDF."""
    with TemporaryDirectory() as folder:
        _write_map(Path(folder) / "map.pdf", briefing)
        write_pdf(path, overview(briefing, phones), Path(folder))
