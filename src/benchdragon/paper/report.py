"""The report on the paper: what it says, claim by claim, beside what comes out, and how that is known.

Here it is text, tables and names of pictures in the language in use; `publish` writes it as HTML
and PDF. Every number is one of the run's own, or the paper's.
"""

import datetime
import math
from collections.abc import Iterable, Sequence

from benchdragon.analysis.check import moment
from benchdragon.i18n import N_, _, language
from benchdragon.model.answer import Answer
from benchdragon.model.numbering import handle_names, handle_text, numbering_text
from benchdragon.number_format import decimals, decimals_or_dash
from benchdragon.paper import claims as paper
from benchdragon.paper.derivations import contact_of, evidence_table
from benchdragon.paper.document import (
    Block,
    Document,
    Formula,
    Heading,
    Inline,
    Link,
    Paragraph,
    Picture,
    Reference,
    Table,
    say,
)
from benchdragon.paper.evidence import conditioning, errors, left_out, people
from benchdragon.paper.results import (
    MOTION_TIMES,
    TABLE_HANDLES,
    TABLE_TIMES,
    Results,
    table,
)
from benchdragon.plans.schema import TurnRoute
from benchdragon.solve.turn import BestTurn
from benchdragon.version import __version__

# The paper's flow of work (its Fig 1) beside ours.
FLOW = (
    (N_("Archimedean spiral, d theta/dt"), N_("any route of lines, arcs, clothoids, spirals")),
    (N_("head: Runge-Kutta in steps"), N_("head: arc length in closed form, inverted")),
    (
        N_("handles: try theta until it fits"),
        N_("handles: nearest position one link behind, none skipped"),
    ),
    (N_("speeds: differences of positions"), N_("speeds: rigid benches, differentiated")),
    (N_("contact: SAT, a flag at each step"), N_("contact: bounds that hold between evaluations")),
    (N_("pitch: traversal in steps"), N_("pitch: root of the pair that decides")),
    (N_("turn: two arcs, geometry"), N_("turn: families of arcs, lines, clothoids; speed bounded")),
)


def report(found: Results, docs: str | None = None) -> Document:
    """The report in the language in use.

    Args:
        found: what came out.
        docs: folder or address of the documentation's pages; None: no links to it.
    """
    title = _("The bench dragon paper, repeated and checked")
    blocks = [
        *_opening(found),
        *_claims(found),
        *_questions(found),
        *_flow(),
        *_equations(found),
        *errors(found),
        *conditioning(found),
        *people(found),
        *evidence_table(found, docs),
        *left_out(),
    ]
    return Document(title, language(), datetime.date.today().isoformat(), tuple(blocks))


def _opening(found: Results) -> Iterable[Block]:
    yield say(
        _(
            "W. Nie and J. Zhao model the bench dragon of 223 benches: spiral walk, contact, "
            "smallest pitch, turn. This report repeats each part, says what the paper gives, what "
            "comes out here, why they differ, and how our number was established. All figures are "
            "of this run: benchdragon {version}, plans {spiral}, {disc}, {turn}."
        ),
        version=__version__,
        **{name: getattr(found, name).sha256[:8] for name in ("spiral", "disc", "turn")},
    )
    yield say(
        _(
            '"Proved" means: all positions behind the answer were enclosed in ball arithmetic '
            'with 100 bits, and their errors stay within what the bounds allow for. "Found" '
            "means: bounds that hold at all moments, computed in floating point with an "
            'allowance for its rounding. "Best found" means: a search arrived at it, and '
            "something better may exist."
        )
    )


def _how(anchor: str, text: str) -> Link:
    return Link(text, f"#how-{anchor}")


def established(answer: Answer) -> str:
    """How an answer is known, and how narrow its bracket is."""
    words = {"proved": _("proved"), "found": _("found")}.get(answer.status, _("undecided"))
    width = answer.upper - answer.lower
    return _("{status}, bracket {width} {unit}").format(
        status=words, width=f"{width:.1e}", unit=answer.unit
    )


def _claims(found: Results) -> Iterable[Block]:
    yield Heading(_("Claim by claim"), "claims")
    columns = (
        _("section"),
        _("claim"),
        _("paper"),
        _("here"),
        _("difference"),
        _("why"),
        _("how known"),
    )
    rows = [*_walk_claims(found), *_contact_claims(found), *_turn_claims(found), *_other_claims(found)]
    yield say(
        _("{claims} holds each claim of the paper beside what comes out here."),
        claims=Reference("claims"),
    )
    yield Table(
        "claims", _("The paper's claims, and what comes out here."), columns,
        (0.7, 1.5, 1.2, 1.4, 1.0, 2.6, 1.2), tuple(rows),
    )  # fmt: skip


def _walk_claims(found: Results) -> Iterable[tuple[Inline, ...]]:
    last = table(found.motion, [300.0])[-1]
    yield (
        "2",
        _("positions of the handles, by Runge-Kutta"),
        _("no table printed"),
        _("rear of the tail at 300 s: ({x}, {y}) m").format(
            x=decimals(last["x_m"]), y=decimals(last["y_m"])
        ),
        f"{found.head_errors['rk4_step_0.1_s_m']:.1e} m",
        _("the head by Runge-Kutta (steps of 0.1 s) and by the closed form: they agree"),
        _how(
            "chain",
            _("closed form; chords to {error} m").format(error=f"{found.motion.chord_error:.0e}"),
        ),
    )
    yield (
        "2, 3",
        _("speeds by differences; the head's is 1 m/s"),
        f"{paper.HEAD_SPEED:g} m/s",
        "1 m/s",
        _("up to {error} m/s").format(error=f"{found.speed_error:.1e}"),
        _(
            "differences of positions a second apart measure the chord, not the path: the head's "
            "speed comes out too small by that much"
        ),
        _how("speeds", _("exact, from rigid benches")),
    )


def _contact_claims(found: Results) -> Iterable[tuple[Inline, ...]]:
    first, smallest = contact_of(found), found.smallest
    stepped = dict(found.stepped)[1.0]
    yield (
        "2",
        _("time of first contact, by a flag at each step"),
        _("no value printed"),
        f"{first.value:.9f} s",
        _("{late} s late with steps of 1 s").format(late=f"{stepped - first.value:.3f}"),
        _(
            "with a time step of 1 s the contact flag is first set at {seen} s; at {before} s it "
            "sees no contact yet"
        ).format(seen=f"{stepped:g}", before=f"{stepped - 1.0:g}"),
        _how("first-contact", established(first)),
    )
    printed = f"{paper.SMALLEST_PITCH:.3f}"
    same = [p for p, t, answer in found.traversal if t == 1.0 and f"{answer.value:.3f}" == printed]
    benches = smallest.witness.benches if smallest.witness else (0, 0)
    yield (
        _("abstract, 3, Fig 2"),
        _("smallest pitch"),
        f"{paper.SMALLEST_PITCH:g} m",
        f"{smallest.value:.12f} m",
        f"{paper.SMALLEST_PITCH - smallest.value:.6f} m",
        _(
            "consistent with pitches in steps of {steps} m and a flag each second (the paper prints "
            "no step); bench {a} grazes bench {b} {before} m before the disc"
        ).format(
            steps=_(" or ").join(f"{step:g}" for step in same),
            a=benches[0],
            b=benches[1],
            before=f"{found.before_disc or 0.0:.4f}",
        ),
        _how("smallest-pitch", established(smallest)),
    )


def _turn_claims(found: Results) -> Iterable[tuple[Inline, ...]]:
    arcs = found.two_arcs
    yield (
        "3, (1), (2)",
        _("the two arcs have a fixed length"),
        _("no value printed"),
        f"{arcs.length:.10f} m",
        "0",
        _("right: of two tangent arcs between the same joints, whatever the ratio of their radii"),
        _how("turn", _("closed form")),
    )
    best = found.front[found.told]
    yield (
        _("abstract, 4"),
        _("the turn cannot be made shorter"),
        _("fixed by (1) and (2), no value printed"),
        _("{way} m instead of {length} m").format(way=f"{best.way:.4f}", length=f"{arcs.length:.4f}"),
        f"{arcs.length - best.way:.4f} m",
        _(
            "not so: with a line between two arcs no bend is tighter than the paper's, and the "
            "head may walk at {speed} m/s instead of {paper} m/s"
        ).format(speed=f"{_allowed(best):.4f}", paper=f"{found.head_speed.value:.4f}")
        + _deeper_text(found),
        _how("turn", _("best found; its limits are kept by exact figures")),
    )
    angles = dict(zip(paper.ANGLES, arcs.boundary_angles(), strict=True))
    off = max(abs(angles[name] - printed) for name, printed in paper.ANGLES.items())
    yield (
        "3, 4",
        _("boundary angles of the arcs"),
        ", ".join(f"{angle:.4f}" for angle in paper.ANGLES.values()),
        ", ".join(f"{angle:.6f}" for angle in angles.values()),
        f"{off:.1e}",
        _("right to the digits printed"),
        _how("turn", _("closed form")),
    )


def _deeper_text(found: Results) -> str:
    """The turn alone is shorter within the paper's own family, too."""
    turn = found.deeper_turn
    return _(
        ". The turn alone gets shorter with two tangent arcs as well, if their joints may move: "
        "{length} m with joints at radius {radius} m, least clearance {gap} m. The path inside "
        "the disc gets longer then: {way} m"
    ).format(
        length=f"{turn.length:.4f}",
        radius=f"{turn.entry_radius:g}",
        gap=f"{found.deeper.clearance.lower:.4f}",
        way=f"{turn.way(TurnRoute.disc(found.turn)):.4f}",
    )


def _other_claims(found: Results) -> Iterable[tuple[Inline, ...]]:
    yield _method_claim(found)
    yield _reliability_claim(found)
    yield _people_claim(found)


def _method_claim(found: Results) -> tuple[Inline, ...]:
    coarse, fine = (
        next(answer.evaluations for p, t, answer in found.traversal if (p, t) == steps)
        for steps in ((0.002, 1.0), (0.0005, 1.0))
    )
    width = found.smallest.upper - found.smallest.lower
    return (
        "4",
        _("faster methods are future work"),
        _("a traversal in steps"),
        _("root of the pair that decides, to {width} m").format(width=f"{width:.0e}"),
        "",
        _(
            "steps of 0.002 m require {coarse} evaluations of the chain, of 0.0005 m {fine}; "
            "times side by side: benchmarks/RESULTS.md"
        ).format(coarse=coarse, fine=fine),
        _how("smallest-pitch", _("counted")),
    )


def _reliability_claim(found: Results) -> tuple[Inline, ...]:
    return (
        "1, 4",
        _("reliable by error analysis"),
        _("none printed"),
        _("order {rk}; {forward}, {central}, {backward}").format(
            rk=f"{found.head_order.order:.2f}",
            **{name: f"{one.order:.2f}" for name, one in found.speed_orders.items()},
        ),
        "",
        _("Runge-Kutta; forward, central and backward differences: as theory has it"),
        Link(_("chapter on errors"), "#errors"),
    )


def _people_claim(found: Results) -> tuple[Inline, ...]:
    aside, together = (found.dances.tolerance(name) for name in ("aside", "all"))
    return (
        "2",
        _("assumptions 1 to 4: people are exact"),
        _("neglected"),
        _("{pitch} m, for nineteen dances of twenty, with 95 % confidence").format(
            pitch=decimals_or_dash(together.pitch_for(0.05), 3)
        ),
        "",
        _(
            "all of them dropped and benches that vary; {pitch} m with the first alone dropped: "
            "handles {deviation} cm off the route, to either side, as a standard deviation"
        ).format(
            pitch=decimals_or_dash(aside.pitch_for(0.05), 3),
            deviation=f"{100.0 * aside.deviations.aside:g}",
        ),
        Link(_("chapter on people"), "#people"),
    )


def _allowed(best: BestTurn) -> float:
    return math.nan if best.head_speed is None else best.head_speed.value


def _questions(found: Results) -> Iterable[Block]:
    yield Heading(_("The contest's five questions"), "questions")
    yield from _first_question(found)
    yield from _second_question(found)
    yield from _third_question(found)
    yield from _fourth_question(found)
    yield from _better_turns(found)
    yield from _fifth_question(found)


def _first_question(found: Results) -> Iterable[Block]:
    yield Heading(_("Question 1: where handles are, and how fast"), "question-1", 2)
    yield say(
        _("Pitch {pitch} m, head speed 1 m/s; all handles each second: {file}."),
        pitch=f"{found.spiral.value('route.pitch'):g}",
        file="result1.xlsx",
    )
    yield Paragraph((numbering_text(),))
    yield say(
        _(
            "{places} and {speeds} hold the contest's handles at its times. {dragon} shows the dragon, "
            "{map} the speeds of all handles."
        ),
        places=Reference("spiral-places"),
        speeds=Reference("spiral-handle-speeds"),
        dragon=Reference("spiral-dragon"),
        map=Reference("spiral-speeds"),
    )
    rows = table(found.motion, TABLE_TIMES)
    yield _places("spiral-places", _("Positions in the first part, m."), rows, TABLE_TIMES)
    yield _speeds("spiral-handle-speeds", _("Speeds in the first part, m/s."), rows, TABLE_TIMES)
    yield Picture("spiral-dragon", _("The dragon at the start and after 300 s."))
    yield Picture("spiral-speeds", _("Speeds of all handles over time."))


def _second_question(found: Results) -> Iterable[Block]:
    first, standing = contact_of(found), moment(found.report)[0]
    yield Heading(_("Question 2: when benches first touch"), "question-2", 2)
    yield say(
        _("At t = {t} s ({how}) bench {a} touches bench {b}; the whole dragon then: {file}."),
        t=f"{first.value:.10f}",
        how=established(first),
        a=_bench(first, 0),
        b=_bench(first, 1),
        file="result2.xlsx",
    )
    yield say(
        _(
            "{handles} holds the contest's handles at that moment, {contact} shows it, and {clearance} "
            "how near benches come before: twice they miss one another by millimetres."
        ),
        handles=Reference("contact-handles"),
        contact=Reference("contact"),
        clearance=Reference("clearance"),
    )
    yield _one_moment(table(standing, standing.times.tolist()))
    yield Picture("contact", _("The first contact, and close by."))
    yield Picture("clearance", _("Clearance of non-adjacent benches up to the contact."))


def _third_question(found: Results) -> Iterable[Block]:
    yield Heading(_("Question 3: the smallest pitch"), "question-3", 2)
    yield Paragraph(
        (
            _(
                "The head reaches a disc of radius {radius} m without contact from pitch {pitch} "
                "m on ({how}). "
            ).format(
                radius=f"{found.turn.disc.radius:g}",
                pitch=f"{found.smallest.value:.13f}",
                how=established(found.smallest),
            ),
            _how("smallest-pitch", _("How this is known")),
            ".",
        )
    )
    yield say(
        _(
            "{pitch} draws the two angles that the paper compares. They do not cross: at the smallest "
            "pitch the angle that the head reaches jumps over that of the disc, because the contact "
            "that decides happens {before} m before the disc."
        ),
        pitch=Reference("pitch"),
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
    yield Heading(_("Question 4: the turn"), "question-4", 2)
    yield say(
        _(
            "Radii {r1} m and {r2} m, both arcs swept by {angle} rad, length {length} m. Benches "
            "{a} and {b} come nearest, {gap} m. All handles each second: {file}."
        ),
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
        _(
            "{construction} shows how the arcs lie, {dragon} the dragon on them; {places} and {speeds} "
            "hold the contest's handles at its times, {map} the speeds of all."
        ),
        construction=Reference("turn-disc"),
        dragon=Reference("turn-dragon"),
        places=Reference("turn-places"),
        speeds=Reference("turn-handle-speeds"),
        map=Reference("turn-speeds"),
    )
    yield Picture(
        "turn-disc",
        _(
            "The turn, the paper's Fig 3: arcs C1 and C2 about O1 and O2 meet at C, on the diameter "
            "AB; l1 and l2 are tangents of the spirals and of the arcs."
        ),
    )
    rows = table(found.turn.build().motion(MOTION_TIMES), MOTION_TIMES)
    yield _places("turn-places", _("Positions in the second part, m."), rows, MOTION_TIMES)
    yield _speeds("turn-handle-speeds", _("Speeds in the second part, m/s."), rows, MOTION_TIMES)
    yield Picture("turn-dragon", _("The dragon turning: the paper's Fig 4."))
    yield Picture("turn-speeds", _("Speeds of all handles while the dragon turns."))


def _better_turns(found: Results) -> Iterable[Block]:
    yield say(
        _(
            "A line between the arcs makes the turn shorter ({better}). For each of {count} head "
            "speeds the shortest such turn was sought from several starts, and the best kept ({front}, "
            "{lengths}): searches of the whole family at six of the speeds, and the turns of the "
            "speeds below and above. No bend is tighter than the paper's."
        ),
        better=Reference("turn-better"),
        count=len(found.front),
        front=Reference("turn-front"),
        lengths=Reference("front"),
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
            f"{_allowed(best):.4f}",
            f"{best.length:.4f}",
            f"{best.way:.4f}",
            f"{best.turn.least_radius:.4f}",
            f"{best.clearance.lower:.4f}",
        )
        for best in found.front
    )
    caption = _("The shortest turns that were found, by the head speed that they allow.")
    yield Table("front", caption, columns, (1, 1, 1, 1, 1), rows, numbers=True)


def _fifth_question(found: Results) -> Iterable[Block]:
    speed = found.head_speed
    limit = found.turn.limits.speed or math.nan
    yield Heading(_("Question 5: how fast the head may walk"), "question-5", 2)
    yield say(
        _(
            "No handle exceeds {limit} m/s up to a head speed of {speed} m/s ({how}), decided by "
            "{handle} at t = {t} s."
        ),
        limit=f"{limit:g}",
        speed=f"{speed.value:.12f}",
        how=established(speed),
        handle=_handle(speed),
        t=f"{found.turn_greatest_at:.6f}",
    )
    yield say(
        _(
            "{ratio} shows why: the greatest speed ratio of any handle is {greatest}, for a moment. It "
            "is a peak between two seconds, which samples miss."
        ),
        ratio=Reference("turn-ratio"),
        greatest=f"{limit / speed.value:.6f}",
    )
    yield Picture(
        "turn-ratio",
        _("The greatest speed ratio of all handles over time, and the moment that decides."),
    )


def _places(name: str, caption: str, rows: Sequence[dict[str, float]], times: Sequence[float]) -> Table:
    """Positions: two rows a handle, a column a time."""
    by_place = {(row["time_s"], row["handle"]): row for row in rows}
    names = handle_names(TABLE_HANDLES[-1] + 1)
    lines = tuple(
        (
            str(handle),
            text.format(handle=names[handle]),
            *(decimals(by_place[t, handle][f"{axis}_m"]) for t in times),
        )
        for handle in TABLE_HANDLES
        for axis, text in (("x", _("{handle} x (m)")), ("y", _("{handle} y (m)")))
    )
    return Table(name, caption, *_time_columns(times), lines, numbers=True)


def _speeds(name: str, caption: str, rows: Sequence[dict[str, float]], times: Sequence[float]) -> Table:
    """Speeds: a row a handle, a column a time."""
    by_place = {(row["time_s"], row["handle"]): row for row in rows}
    names = handle_names(TABLE_HANDLES[-1] + 1)
    lines = tuple(
        (
            str(handle),
            _("{handle} (m/s)").format(handle=names[handle]),
            *(decimals(by_place[t, handle]["speed_m_s"]) for t in times),
        )
        for handle in TABLE_HANDLES
    )
    return Table(name, caption, *_time_columns(times), lines, numbers=True)


def _time_columns(times: Sequence[float]) -> tuple[tuple[str, ...], tuple[float, ...]]:
    columns = (_("handle"), _("in the contest"), *(f"{t:g} s" for t in times))
    return columns, (0.6, 1.6, *(1.0 for _time in times))


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


def _flow() -> Iterable[Block]:
    yield Heading(_("The paper's figures"), "figures")
    yield say(
        _(
            "The paper's Fig 1, its flow of work, stands in {flow} beside ours; its Fig 2 is {pitch}, "
            "its Fig 3 {turn}, its Fig 4 {dragon}."
        ),
        flow=Reference("flow"),
        pitch=Reference("pitch"),
        turn=Reference("turn-disc"),
        dragon=Reference("turn-dragon"),
    )
    yield Picture("flow", _("What the paper does, and what is done here."))


def _equations(found: Results) -> Iterable[Block]:
    yield Heading(_("The paper's equations, tested on exact values"), "equations")
    yield say(
        _(
            "{equations} holds the value of each equation as it is printed, and what the walk does. "
            "{triangle} shows the triangle of equation (6), with the link of bench 1 for the paper's d:"
        ),
        equations=Reference("equations"),
        triangle=Reference("geometry-triangle"),
    )
    yield Formula(
        r"\cos\theta = \dfrac{d_1^2 + r_1^2 - L_1^2}{2\,d_1 r_1}",
        "cos θ = (d1² + r1² - L1²)/(2 d1 r1)",
    )
    columns = (
        _("equation"),
        _("gives"),
        _("as printed"),
        _("exact value"),
        _("difference"),
        _("remark"),
    )
    rows = tuple(
        (
            f"({one.number})",
            _(one.says),
            f"{one.printed:.9f} {one.unit}",
            f"{one.true:.9f} {one.unit}",
            f"{one.printed - one.true:.1e}",
            _(one.remark),
        )
        for one in found.equations
    )
    caption = _("The paper's equations as printed, and exact values.")
    yield Table("equations", caption, columns, (0.6, 2.0, 1.3, 1.3, 0.8, 2.2), rows)
    yield Picture(
        "geometry-triangle",
        _("Handle 0 on the second arc, handle 1 on the first: the triangle of the cosine law."),
    )
