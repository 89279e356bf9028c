"""The report on the paper: its claims beside the computed values, and how these are established.

Here it is text, tables and names of pictures in the language in use; `publish` writes it as HTML
and PDF. Every number is one of the run's own, or the paper's.
"""

import datetime
from collections.abc import Iterable

from benchdragon.export.document import (
    Block,
    Document,
    Formula,
    Heading,
    Inline,
    Link,
    Picture,
    Table,
    say,
)
from benchdragon.i18n import N_, _, language
from benchdragon.number_format import decimals_towards
from benchdragon.paper import claims as paper
from benchdragon.paper.derivations import (
    allowed_speed,
    consistent_steps,
    contact_of,
    established,
    evidence_table,
    how,
)
from benchdragon.paper.evidence import conditioning, errors, left_out, people
from benchdragon.paper.questions import answers, chords_text, questions, rear_text
from benchdragon.paper.results import Results
from benchdragon.plans.routes import TurnRoute
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
        found: the computed value.
        docs: folder or address of the documentation's pages; None: no links to it.
    """
    title = _("The bench dragon paper, repeated and checked")
    blocks = [
        *_opening(found), *_claims(found), *questions(found), *_flow(), *_equations(found),
        *errors(found), *conditioning(found), *people(found), *evidence_table(found, docs), *left_out(),
    ]  # fmt: skip
    return Document(title, language(), datetime.date.today().isoformat(), tuple(blocks))


def _opening(found: Results) -> Iterable[Block]:
    yield say(
        "W. Nie and J. Zhao model the bench dragon of 223 benches: spiral walk, contact, smallest "
        "pitch, turn. {answers} answers the contest's five questions, {claims} holds each claim of "
        "the paper beside what comes out here."
    )
    yield answers(found)
    yield say(
        "All figures but those of the kept random dances are of this run: benchdragon {version}, "
        "plans {spiral}, {disc}, {turn}.",
        version=__version__,
        **{name: getattr(found, name).sha256[:8] for name in ("spiral", "disc", "turn")},
    )
    yield say(
        '"Proved" means: shown again without the search, in ball arithmetic with 128 bits: '
        "before the answer cell by cell, each short enough that bounds keep benches apart, "
        'and at the answer by benches that overlap or are too near. "Found" '
        "means: bounds that hold at all moments, computed in floating point with an "
        'allowance for its rounding. "Best found" means: a search arrived at it, and '
        "something better may exist."
    )


def _claims(found: Results) -> Iterable[Block]:
    yield Heading(_("Claim by claim"), "claims")
    columns = (
        _("section"), _("claim"), _("paper"), _("here"), _("difference"), _("why"), _("how known"),
    )  # fmt: skip
    rows = [*_walk_claims(found), *_contact_claims(found), *_turn_claims(found)]
    rows += [_method_claim(found), _reliability_claim(found), _people_claim(found)]
    yield Table(
        "claims", _("The paper's claims, and what comes out here."), columns,
        (0.7, 1.5, 1.2, 1.4, 1.0, 2.6, 1.2), tuple(rows),
    )  # fmt: skip


def _walk_claims(found: Results) -> Iterable[tuple[Inline, ...]]:
    yield (
        "2",
        _("positions of the handles, by Runge-Kutta"),
        _("no table printed"),
        rear_text(found),
        f"{found.head_errors['rk4_step_0.1_s_m']:.1e} m",
        _("the head by Runge-Kutta (steps of 0.1 s) and by the closed form: they agree"),
        how("chain", chords_text(found)),
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
        how("speeds", _("exact, from rigid benches")),
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
        how("first-contact", established(first)),
    )
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
            steps=_(" or ").join(f"{step:g}" for step in consistent_steps(found)),
            a=benches[0],
            b=benches[1],
            before=f"{found.before_disc or 0.0:.4f}",
        ),
        how("smallest-pitch", established(smallest)),
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
        how("turn", _("closed form")),
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
        ).format(speed=f"{allowed_speed(best):.4f}", paper=f"{found.head_speed.value:.4f}")
        + _deeper_text(found),
        how("turn", _("best found; its limits are kept by exact figures")),
    )
    angles = dict(zip(paper.ANGLES, arcs.boundary_angles(), strict=True))
    off = max(abs(angles[name] - printed) for name, printed in paper.ANGLES.items())
    yield (
        "3, 4",
        _("boundary angles of the arcs"),
        _(", ").join(f"{angle:.4f}" for angle in paper.ANGLES.values()),
        _(", ").join(f"{angle:.6f}" for angle in angles.values()),
        f"{off:.1e}",
        _("right to the digits printed"),
        how("turn", _("closed form")),
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
        how("smallest-pitch", _("counted")),
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
            pitch=decimals_towards(together.pitch_for(0.05), 3, up=True)
        ),
        "",
        _(
            "all of them dropped and benches that vary; {pitch} m with the first alone dropped: "
            "handles {deviation} cm off the route, to either side, as a standard deviation"
        ).format(
            pitch=decimals_towards(aside.pitch_for(0.05), 3, up=True),
            deviation=f"{100.0 * aside.deviations.aside:g}",
        ),
        Link(_("chapter on people"), "#people"),
    )


def _flow() -> Iterable[Block]:
    yield Heading(_("The paper's figures"), "figures")
    yield say(
        "The paper's Fig 1, its flow of work, stands in {flow} beside ours; its Fig 2 is {pitch}, "
        "its Fig 3 {turn-disc}, its Fig 4 {turn-dragon}."
    )
    yield Picture("flow", _("What the paper does, and what is done here."))


def _equations(found: Results) -> Iterable[Block]:
    yield Heading(_("The paper's equations, tested on exact values"), "equations")
    yield say(
        "{equations} holds the value of each equation as it is printed, and what the walk does. "
        "{geometry-triangle} shows the triangle of equation (6), with the link of bench 1 for the "
        "paper's d:"
    )
    yield Formula(
        r"\cos\theta = \dfrac{d_1^2 + r_1^2 - L_1^2}{2\,d_1 r_1}", "cos θ = (d1² + r1² - L1²)/(2 d1 r1)"
    )
    columns = (
        _("equation"), _("gives"), _("as printed"), _("exact value"), _("difference"), _("remark"),
    )  # fmt: skip
    rows = tuple(
        (
            f"({one.number})",
            _(one.says),
            _with_unit(one.printed, one.unit),
            _with_unit(one.true, one.unit),
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


def _with_unit(value: float, unit: str) -> str:
    """A value of an equation, with its unit as readers write it."""
    return f"{value:.9f} {unit.replace('^2', '²')}" if unit != "1" else f"{value:.9f}"
