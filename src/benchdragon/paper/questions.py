"""The contest's five questions in the report: answers at a glance; in words, tables and pictures."""

import math
from collections.abc import Iterable, Sequence

from benchdragon.analysis.check import moment
from benchdragon.export.document import Block, Heading, Link, Paragraph, Picture, Table, say
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.model.numbering import handle_names, handle_text, numbering_text
from benchdragon.model.walk import Motion
from benchdragon.number_format import decimals
from benchdragon.paper.claims import SMALLEST_PITCH
from benchdragon.paper.derivations import allowed_speed, contact_of, established, how
from benchdragon.paper.results import MOTION_TIMES, TABLE_HANDLES, TABLE_TIMES, Results, table

ASKED = (
    N_("Question 1: where handles are, and how fast"),
    N_("Question 2: when benches first touch"),
    N_("Question 3: the smallest pitch"),
    N_("Question 4: the turn"),
    N_("Question 5: how fast the head may walk"),
)


def answers(found: Results) -> Table:
    """The answers at a glance: a row a question, with how each is known and what the paper prints."""
    first, smallest, arcs, best = (
        contact_of(found),
        found.smallest,
        found.two_arcs,
        found.front[found.told],
    )
    silent = _("no value printed")
    rows = (
        (rear_text(found), how("chain", chords_text(found)), _("no table printed")),
        (
            _("{t} s: bench {a} touches bench {b}").format(
                t=f"{first.value:.9f}", a=_bench(first, 0), b=_bench(first, 1)
            ),
            how("first-contact", established(first)),
            silent,
        ),
        (
            f"{smallest.value:.12f} m",
            how("smallest-pitch", established(smallest)),
            f"{SMALLEST_PITCH:g} m",
        ),
        (
            _("{length} m with two arcs; {way} m with a line between them").format(
                length=f"{arcs.length:.10f}", way=f"{best.way:.4f}"
            ),
            how("turn", _("closed form; the shorter one: best found")),
            _("the turn cannot be made shorter"),
        ),
        (
            f"{found.head_speed.value:.12f} m/s",
            how("greatest-head-speed", established(found.head_speed)),
            silent,
        ),
    )
    return Table(
        "answers", _("The answers."), (_("question"), _("answer"), _("how known"), _("the paper")),
        (1.9, 2.6, 1.7, 1.2),
        tuple(
            (Link(_(asked), f"#question-{number}"), *row)
            for number, (asked, row) in enumerate(zip(ASKED, rows, strict=True), start=1)
        ),
    )  # fmt: skip


def questions(found: Results) -> Iterable[Block]:
    """The chapter, a section for each question."""
    yield Heading(_("The contest's five questions"), "questions")
    yield from _first_question(found)
    yield from _second_question(found)
    yield from _third_question(found)
    yield from _fourth_question(found)
    yield from _better_turns(found)
    yield from _fifth_question(found)


def rear_text(found: Results) -> str:
    """Where the dragon ends when the contest's first part does."""
    last = table(found.motion, [300.0])[-1]
    text = _("rear of the tail at 300 s: ({x}, {y}) m")
    return text.format(x=decimals(last["x_m"]), y=decimals(last["y_m"]))


def chords_text(found: Results) -> str:
    """How handles' positions are known."""
    return _("closed form; chords to {error} m").format(error=f"{found.motion.chord_error:.0e}")


def _heading(number: int) -> Heading:
    return Heading(_(ASKED[number - 1]), f"question-{number}", 2)


def _first_question(found: Results) -> Iterable[Block]:
    yield _heading(1)
    yield say(
        "Pitch {pitch} m, head speed 1 m/s; all handles each second: {file}.",
        pitch=f"{found.spiral.value('route.pitch'):g}",
        file="result1.xlsx",
    )
    yield Paragraph((numbering_text(),))
    yield say(
        "{spiral-places} and {spiral-handle-speeds} hold the contest's handles at its times. "
        "{spiral-dragon} shows the dragon, {spiral-speeds} the speeds of all handles."
    )
    captions = _("Positions in the first part, m."), _("Speeds in the first part, m/s.")
    yield from _tables("spiral", *captions, found.motion, TABLE_TIMES)
    yield Picture("spiral-dragon", _("The dragon at the start and after 300 s."))
    yield Picture("spiral-speeds", _("Speeds of all handles over time."))


def _second_question(found: Results) -> Iterable[Block]:
    first, standing = contact_of(found), moment(found.report)[0]
    yield _heading(2)
    yield say(
        "At t = {t} s ({how}) bench {a} touches bench {b}; the whole dragon then: {file}.",
        t=f"{first.value:.10f}",
        how=how("first-contact", established(first)),
        a=_bench(first, 0),
        b=_bench(first, 1),
        file="result2.xlsx",
    )
    yield say(
        "{contact-handles} holds the contest's handles at that moment, {contact} shows it, and "
        "{clearance} how near benches come before: twice they miss one another by millimetres."
    )
    yield _one_moment(table(standing, standing.times.tolist()))
    yield Picture("contact", _("The first contact, and close by."))
    yield Picture("clearance", _("Clearance of non-adjacent benches until shortly after the contact."))


def _third_question(found: Results) -> Iterable[Block]:
    yield _heading(3)
    yield say(
        "The head reaches a disc of radius {radius} m without contact from pitch {pitch} m on ({how}).",
        radius=f"{found.turn.disc.radius:g}",
        pitch=f"{found.smallest.value:.13f}",
        how=how("smallest-pitch", established(found.smallest)),
    )
    yield say(
        "{pitch} draws the two angles that the paper compares. They do not cross: at the smallest "
        "pitch the angle that the head reaches jumps over that of the disc, because the contact "
        "that decides happens {before} m before the disc.",
        before=f"{found.before_disc or 0.0:.3f}",
    )
    yield Picture("pitch", _("The paper's Fig 2: how far in the head comes, over the pitch."))


def _bench(answer: Answer, which: int) -> int:
    return answer.witness.benches[which] if answer.witness else 0


def _handle(answer: Answer) -> str:
    near = answer.witness
    return handle_text(near.handle, near.benches[0]) if near and near.handle is not None else "-"


def _fourth_question(found: Results) -> Iterable[Block]:
    arcs, near = found.two_arcs, found.turn_report.clearance
    yield _heading(4)
    yield say(
        "Radii {r1} m and {r2} m, both arcs swept by {angle} rad, length {length} m. Benches "
        "{a} and {b} come nearest, {gap} m. All handles each second: {file}.",
        r1=f"{arcs.radii[0]:.10f}",
        r2=f"{arcs.radii[1]:.10f}",
        angle=f"{arcs.sweep:.10f}",
        length=f"{arcs.length:.10f}",
        gap=f"{near.value:.6f}",
        a=_bench(near, 0),
        b=_bench(near, 1),
        file="result4.xlsx",
    )
    yield say(
        "{turn-disc} shows how the arcs lie, {turn-arriving} and {turn-dragon} the dragon before "
        "and on them; {turn-places} and {turn-handle-speeds} hold the contest's handles at its "
        "times, {turn-speeds} the speeds of all."
    )
    yield Picture(
        "turn-disc",
        _(
            "The turn, the paper's Fig 3: arcs C1 and C2 about O1 and O2 meet at C, on the diameter "
            "AB; l1 and l2 are tangents of the spirals and of the arcs."
        ),
    )
    yield Picture("turn-arriving", _("The dragon walking in, and with its head at A."))
    captions = _("Positions in the second part, m."), _("Speeds in the second part, m/s.")
    yield from _tables("turn", *captions, found.turn_motion, MOTION_TIMES)
    yield Picture("turn-dragon", _("The dragon turning: the paper's Fig 4."))
    yield Picture(
        "turn-speeds",
        _(
            "Speeds while the dragon turns: above of some handles, with the times at which the head is "
            "at A, C and B; below of all handles when the slowest is slowest, when the fastest is "
            "fastest, and later. Those before A are nearly as fast as one another, those past B "
            "nearly as fast as the head."
        ),
    )


def _better_turns(found: Results) -> Iterable[Block]:
    yield say(
        "A line between the arcs makes the turn shorter ({turn-better}). The shortest such turn "
        "was searched for at {count} head speeds: over the whole family at six of them, and from "
        "the turns found for the speeds below and above. Each speed then has the shortest of all "
        "turns found that allow it: {different} different ones ({turn-front}, {front}), of which "
        "none has both a longer path and a lower head speed than another. A search found them; "
        "shorter ones may exist. No bend is tighter than the paper's.",
        count=len(found.front),
        different=len(found.different),
    )
    yield Picture("turn-better", _("The paper's turn beside shorter ones."))
    yield Picture("turn-front", _("Length against greatest head speed; best found."))
    columns = (
        _("head speed (m/s)"),
        _("turn (m)"),
        _("path inside the disc (m)"),
        _("tightest bend (m)"),
        _("clearance (m)"),
    )
    rows = tuple(
        (
            f"{allowed_speed(best):.4f}",
            f"{best.length:.4f}",
            f"{best.way:.4f}",
            f"{best.turn.least_radius:.4f}",
            f"{best.clearance.lower:.4f}",
        )
        for best in found.different
    )
    caption = _("The shortest turns that were found, by the head speed that they allow.")
    yield Table("front", caption, columns, (1, 1, 1, 1, 1), rows, numbers=True)


def _fifth_question(found: Results) -> Iterable[Block]:
    speed = found.head_speed
    limit = found.turn.limits.speed or math.nan
    yield _heading(5)
    yield say(
        "No handle exceeds {limit} m/s up to a head speed of {speed} m/s ({how}), decided by "
        "{handle} at t = {t} s.",
        limit=f"{limit:g}",
        speed=f"{speed.value:.12f}",
        how=how("greatest-head-speed", established(speed)),
        handle=_handle(speed),
        t=f"{found.turn_greatest_at:.6f}",
    )
    yield say(
        "{turn-ratio} shows why: the greatest speed ratio of any handle is {greatest}, for a "
        "moment. It is a peak between two seconds, which samples miss.",
        greatest=f"{limit / speed.value:.6f}",
    )
    yield Picture(
        "turn-ratio",
        _("The greatest speed ratio of all handles over time, and the moment that decides."),
    )


def _tables(
    part: str, places: str, speeds: str, motion: Motion, times: Sequence[float]
) -> Iterable[Table]:
    """Positions, two rows a handle, and speeds, a row a handle: a column a time."""
    by_place = {(row["time_s"], row["handle"]): row for row in table(motion, times)}
    names = handle_names(TABLE_HANDLES[-1] + 1)
    columns = (_("handle"), _("in the contest"), *(f"{t:g} s" for t in times))
    widths = (0.6, 1.6, *(1.0 for _time in times))
    x, y, speed = _("{handle} x (m)"), _("{handle} y (m)"), _("{handle} (m/s)")
    for name, caption, quantities in (
        ("places", places, {"x_m": x, "y_m": y}),
        ("handle-speeds", speeds, {"speed_m_s": speed}),
    ):
        lines = tuple(
            (
                str(handle),
                text.format(handle=names[handle]),
                *(decimals(by_place[t, handle][key]) for t in times),
            )
            for handle in TABLE_HANDLES
            for key, text in quantities.items()
        )
        yield Table(f"{part}-{name}", caption, columns, widths, lines, numbers=True)


def _one_moment(rows: Sequence[dict[str, float]]) -> Table:
    columns = (_("handle"), _("in the contest"), _("x (m)"), _("y (m)"), _("speed (m/s)"))
    names = handle_names(TABLE_HANDLES[-1] + 1)
    lines = tuple(
        (
            str(row["handle"]),
            names[int(row["handle"])],
            *(decimals(row[key]) for key in ("x_m", "y_m", "speed_m_s")),
        )
        for row in rows
    )
    caption = _("The contest's handles at the first contact.")
    return Table("contact-handles", caption, columns, (0.6, 1, 1, 1, 1), lines, numbers=True)
