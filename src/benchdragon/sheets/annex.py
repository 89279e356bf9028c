"""The permit annex: what an organiser hands in with an application, from the plan and its check.

What the plan does not say is a blank to be filled in by hand, named in a list; what the program knows
nothing of is a heading with blank lines. No rule is quoted: which apply, the office says.
"""

import warnings
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from benchdragon.analysis.clock import minutes
from benchdragon.analysis.ground import peg_line
from benchdragon.analysis.posts import EVERY, MOST_RUNS
from benchdragon.analysis.running import APART
from benchdragon.export.area import drawing_of
from benchdragon.export.document import Block, Document, Heading, Paragraph, Picture, say
from benchdragon.export.pages import write_pdf
from benchdragon.figures.area import page_picture
from benchdragon.figures.style import write_picture
from benchdragon.i18n import LANGUAGES, N_, _, language, spoken_in
from benchdragon.number_format import decimals_towards
from benchdragon.progress import Progress, part, silent
from benchdragon.sheets.annex_facts import RISK, AnnexFacts, annex_facts
from benchdragon.sheets.annex_first import first_page
from benchdragon.sheets.annex_tables import (
    BLANK,
    assumption_table,
    basics,
    basics_table,
    chance_table,
    clearance_table,
    metres,
    passing_table,
    people_table,
    place,
    post_table,
    room_table,
    speed_table,
    swept_table,
    timetable_of,
)
from benchdragon.sheets.briefing import Briefing, dated
from benchdragon.version import __version__

# Blank lines under a heading that the program knows nothing of.
LINES, LINE = 5, 92 * "_"
# Their room, mm, and that of a table that follows a heading, so that the two stay together.
LINES_ROOM, TABLE_ROOM = 36.0, 60.0
# What is left to the organiser: chapters of permit plans on which a plan of a dance says nothing.
BY_HAND = {
    "fire": N_("Fire safety"),
    "emergency": N_("Emergencies"),
    "vehicles": N_("Vehicles, parking and ways of the crowd"),
}


def annex_names() -> tuple[str, ...]:
    """The names of the annex's files: one in each language."""
    return tuple(f"annex.{name}.pdf" for name in LANGUAGES)


def write_annex(folder: Path, briefing: Briefing, progress: Progress = silent) -> None:
    """Write the annex in both languages, each file whole or not at all.

    Raises:
        InputError, UnsureError: for ground that cannot be computed, or is too large to be drawn.
        MachineError: if a file could not be written.
    """
    facts = annex_facts(briefing, part(progress, 0.0, 0.7))
    for one in facts.findings:
        warnings.warn(f"{one.code}: {one.text}", stacklevel=2)
    for n, (name, file) in enumerate(zip(LANGUAGES, annex_names(), strict=True)):
        progress(0.7 + 0.3 * n / len(LANGUAGES), _("permit annex"))
        with spoken_in(name), TemporaryDirectory() as pictures:
            write_pdf(folder / file, annex_document(facts, Path(pictures)), Path(pictures))
    progress(1.0, "")


def annex_document(facts: AnnexFacts, folder: Path) -> Document:
    """The annex in the language in use; its picture is put into a folder."""
    briefing = facts.briefing
    title = _("Permit annex: {title}").format(title=briefing.plan.title(language()) or BLANK)
    blocks = (
        *first_page(facts), *_basics(facts), *_dance(facts), *_ground(facts, folder),
        *_timetable(facts), *_people(facts),
        *_clearances(facts), *_speeds(facts), *_posts(facts), *_chance(facts), *_by_hand(),
        *_limits(facts), *_version(facts),
    )  # fmt: skip
    return Document(
        title, language(), briefing.checked_on, blocks, briefing.foot, dated(briefing.checked_on)
    )


def _basics(facts: AnnexFacts) -> Iterator[Block]:
    yield Heading(_("Basics"), "basics", room=TABLE_ROOM)
    yield basics_table(facts.briefing)
    missing = [name for name, value in basics(facts.briefing) if value == BLANK]
    if missing:
        text = _("The plan does not say: {names}. Fill these in by hand.")
        yield say(text, names=_(", ").join(missing))
    yield say(
        _(
            "This annex quotes no law and no rule. Which are in force, and what they ask for, is to be "
            "checked with the office that gives the permit."
        )
    )


def _dance(facts: AnnexFacts) -> Iterator[Block]:
    report = facts.briefing.report
    dragon, first = report.walk.dragon, report.walk.motion([report.start])
    yield Heading(_("The dragon and the dance"), "dance")
    yield say(
        _(
            "A bench dragon is a line of benches, joined by pins one behind the other and carried by "
            "people. This one has {count} benches and is {length} from the first pin to the last. The "
            "head's bench is {head} long, the second {body}; the widest is {width} wide."
        ),
        count=len(dragon), length=metres(float(dragon.links.sum())), head=metres(dragon.length[0]),
        body=metres(dragon.length[min(1, len(dragon) - 1)]), width=metres(dragon.width.max()),
    )  # fmt: skip
    ends = report.walk.head_position([report.start, report.end])
    yield say(
        _(
            "All pins follow one line on the ground, the route, one after another. The head walks "
            "{way} of it in {time}. It starts at x, y = {place} m from the peg."
        ),
        way=metres(float(ends[1] - ends[0])), time=minutes(report.end - report.start),
        place=place((float(first.x[0, 0]), float(first.y[0, 0])), facts.briefing.ground),
    )  # fmt: skip
    yield Paragraph((facts.briefing.ground.legend,))
    for one in report.plan.obstacles():
        line = "" if one.kind != "venue" else peg_line(facts.briefing.ground, one.outline.tolist())
        if line:
            yield Paragraph((line,))


def _ground(facts: AnnexFacts, folder: Path) -> Iterator[Block]:
    plan, swept = facts.briefing.plan, facts.swept
    drawing = drawing_of(plan, swept, facts.briefing.ground, facts.briefing.clock)
    figure, scale = page_picture(drawing, [post.point for post in facts.posts])
    write_picture(figure, folder / "ground.pdf", drawing.title, plan.sha256)
    yield Heading(_("Route and ground, to scale"), "ground")
    yield say(
        _(
            "The area below contains everything that any bench covers from the start of the dance to "
            "its end; nothing of it is farther than {error} from what is covered. It is the benches' "
            "own: people who stand out beyond their sides need more (see Clearances and margins)."
        ),
        error=metres(swept.error, up=True),
    )
    yield swept_table(facts)
    yield Picture(
        "ground",
        _("route, ground covered, spectators' line, venue, obstacles and posts, 1:{scale}").format(
            scale=f"{scale:g}"
        ),
    )


def _timetable(facts: AnnexFacts) -> Iterator[Block]:
    told = timetable_of(facts.briefing)
    yield Heading(_("Timetable"), "timetable")
    yield from (Paragraph((line,)) for line in told.lines)
    yield passing_table(told)


def _people(facts: AnnexFacts) -> Iterator[Block]:
    yield Heading(_("People"), "people")
    yield people_table(facts.briefing)
    yield say(_("Names and telephone numbers of bearers are not part of this annex."))


def _clearances(facts: AnnexFacts) -> Iterator[Block]:
    briefing = facts.briefing
    yield Heading(_("Clearances and margins"), "clearances")
    yield say(
        _(
            "Each number was computed over the whole dance, between instants too; the bracket holds "
            "the true value. They speak of benches that keep exactly to the plan."
        )
    )
    yield clearance_table(briefing)
    yield say(_("What these numbers rest on: rigid, level benches whose pins keep to the route."))
    if briefing.report.proved:
        yield say(_("That there is no contact was proved in ball arithmetic."))
    if briefing.report.room:
        yield say(_("Room for people, one thing after another, each with all before it:"))
        yield room_table(briefing)
        yield say(
            _(
                "Room is asked for at the sides of benches. Benches one behind another in the line, "
                "such as the next but one, may be nearer: see the least clearances above."
            )
        )
    else:
        yield say(
            _(
                "The plan says nothing of the room that bearers need beside the benches: these "
                "distances are those of the benches alone."
            )
        )


def _speeds(facts: AnnexFacts) -> Iterator[Block]:
    yield Heading(_("Speeds"), "speeds", room=TABLE_ROOM)
    yield speed_table(facts.briefing)


def _posts(facts: AnnexFacts) -> Iterator[Block]:
    yield Heading(_("Spectators' line and posts for marshals"), "posts")
    yield say(
        _(
            "The spectators' line keeps {distance} from the ground that benches cover. Posts are "
            "proposed by a rule of this program, which is no regulation: where that ground comes "
            "nearest to the venue's edge, at entrances that the plan names, where benches come nearest "
            "to one another, where the fastest handle is (unless all are about as fast), where else "
            "handles run, and between these so that no two that follow one another are farther apart "
            "than {every} along the line."
        ),
        distance=metres(facts.swept.margin), every=metres(EVERY),
    )  # fmt: skip
    yield say(
        _(
            "Handles run where they go at {run} m/s or more. Positions where they do are one stretch "
            "if they are within {apart} of one another. The fastest position of each stretch has a "
            "post, if it is farther than that from the fastest handle: of the {most} fastest stretches "
            "at most."
        ),
        run=f"{facts.briefing.plan.people.run_from:g}", apart=metres(APART), most=MOST_RUNS,
    )  # fmt: skip
    yield say(
        _(
            "Each post stands on the line. What it watches lies inside the line, and at an entrance "
            "outside."
        )
    )
    if facts.swept.lines.holes:
        yield say(
            _(
                "Where benches go round ground that they leave free, such as the middle of a coil, the "
                "drawing has a line there too: it is no place for spectators, and has no posts."
            )
        )
    yield say(
        _(
            "The line is drawn closed. The organiser leaves it open where the dragon comes in and "
            "where it goes out."
        )
    )
    if facts.leaves_venue:
        yield say(
            _(
                "Somewhere the spectators' line lies outside the venue's edge: there spectators have "
                "no room inside, and posts stand where the line would be."
            )
        )
    yield post_table(facts)
    said = facts.briefing.plan.event.marshals
    if said is not None and said < len(facts.posts):
        text = _("There are {posts} posts and {marshals} marshals: {less} fewer than posts.")
        yield say(text, posts=len(facts.posts), marshals=said, less=len(facts.posts) - said)


def _chance(facts: AnnexFacts) -> Iterator[Block]:
    found = facts.chance
    yield Heading(_("Imprecision and its chance"), "chance")
    if not found.draws:
        yield say(_("Random dances could not be walked for this plan: nothing is said of the chance."))
        return
    words = {
        "draws": found.draws, "hits": found.hits, "risk": f"{100.0 * RISK:g}",
        "margin": metres(facts.briefing.plan.limits.margin),
    }  # fmt: skip
    if found.shown:
        text = _(
            "People are not exact. {draws} dances were drawn at random, with the deviations below. In "
            "{hits} of them benches came nearer to one another than the {margin} asked for, or could "
            "not follow. So the chance of that is at most {high} %, with a confidence of 95 %: less "
            "than the {risk} % that this annex asks for."
        )
        words["high"] = decimals_towards(100.0 * found.share[2], 1, up=True)
    else:
        text = _(
            "People are not exact. Dances were drawn at random, with the deviations below: {hits} of "
            "the first {draws} came nearer than the {margin} asked for, or could not follow. That is "
            "too many to show that the chance of it is below {risk} %, so no number is told: practise, "
            "ask for more room, or draw more dances (benchdragon margins)."
        )
    yield say(text, **words)
    yield chance_table(facts)
    yield say(
        _(
            "What these dances do not count: the venue's edge and obstacles, the room of people, sway, "
            "an uneven pace, falls, and deviations that depend on one another."
        )
    )


def _by_hand() -> Iterator[Block]:
    for anchor, text in BY_HAND.items():
        yield Heading(_(text), anchor, room=LINES_ROOM)
        yield say(_("To be filled in by the organiser: the plan of the dance says nothing of it."))
        yield from (Paragraph((LINE,)) for _line in range(LINES))


def _limits(facts: AnnexFacts) -> Iterator[Block]:
    yield Heading(_("Figures and where they come from"), "assumptions")
    yield say(_("A number that has no source is an assumption: somebody is to check it on the spot."))
    yield assumption_table(facts)


def _version(facts: AnnexFacts) -> Iterator[Block]:
    briefing = facts.briefing
    yield Heading(_("Version"), "version")
    yield say(
        _(
            "Made by benchdragon {version}. The plan was checked on {date}; all papers of the same "
            "check bear the number {papers}. The plan alone, without the list of names, is {plan}. If "
            "plan, people or list of names change, this annex no longer holds."
        ),
        version=__version__, plan=briefing.plan.sha256[:12], date=briefing.checked_on,
        papers=briefing.sha256[:12],
    )  # fmt: skip
