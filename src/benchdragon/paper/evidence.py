"""Chapters of the report on evidence: errors, conditioning, people, and how each number is known."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.number_format import decimals, decimals_or_dash
from benchdragon.paper.document import Block, Formula, Heading, Inline, Link, Paragraph, Picture, Table
from benchdragon.paper.random_dances import DRAWS, OTHER_SEED, SEED
from benchdragon.paper.results import AGAIN, DIFFERENCE_STEP, Rate, Results
from benchdragon.solve.tolerance import CASES


@dataclass(frozen=True)
class Evidence:
    """How a number is established: where it is derived, computed, and tested.

    The page is that of the documentation, with its anchor.
    """

    anchor: str
    title: str
    page: str
    code: str
    test: str


EVIDENCE = {
    evidence.anchor: evidence
    for evidence in (
        Evidence(
            "chain",
            N_("Positions of the handles"),
            "established.html#chain",
            "benchdragon.kernels.chain.march",
            "tests/truth/test_truth.py, tests/model/test_walk.py",
        ),
        Evidence(
            "speeds",
            N_("Speeds of the handles"),
            "established.html#speeds",
            "benchdragon.model.walk.Motion.speed_ratio",
            "tests/laws/test_laws.py, tests/paper/test_differences.py",
        ),
        Evidence(
            "first-contact",
            N_("The first contact"),
            "established.html#first-contact",
            "benchdragon.analysis.contact.first_contact",
            "tests/analysis/test_contact.py, tests/laws/test_contact_laws.py",
        ),
        Evidence(
            "smallest-pitch",
            N_("The smallest pitch"),
            "established.html#smallest-pitch",
            "benchdragon.solve.size.limit",
            "tests/solve/test_size.py, tests/analysis/test_proof.py",
        ),
        Evidence(
            "turn",
            N_("The turn"),
            "established.html#turn",
            "benchdragon.model.turns.TwoArcTurn, benchdragon.solve.turn.best_turn",
            "tests/model/test_turns.py, tests/solve/test_turn.py",
        ),
        Evidence(
            "greatest-head-speed",
            N_("The greatest head speed"),
            "established.html#greatest-head-speed",
            "benchdragon.solve.head_speed.greatest_head_speed",
            "tests/solve/test_head_speed.py",
        ),
    )
}


def say(text: str, **values: object) -> Paragraph:
    """A paragraph of plain words with values in them."""
    return Paragraph((text.format(**values),))


def contact_of(found: Results) -> Answer:
    """The first contact of the paper's first part."""
    if found.report.first_contact is None:
        raise AssertionError("the contest's dragon touches")
    return found.report.first_contact


def errors(found: Results) -> Iterable[Block]:
    """Orders, accumulation along the benches, and what steps do."""
    yield Heading(_("Error analysis"), "errors")
    yield say(
        _(
            "Runge-Kutta of order 4 is of order {rk} here, fitted where rounding does not show. "
            "Differences of positions are of order {forward} (forward), {central} (central) and "
            "{backward} (backward)."
        ),
        rk=f"{found.head_order.order:.3f}",
        **{name: f"{one.order:.3f}" for name, one in found.speed_orders.items()},
    )
    yield Picture("errors-orders", _("Errors over steps; the slopes are the orders."))
    yield say(
        _(
            "Every chord equals its link to within {chord} m. Position errors add up along the "
            "benches: bisecting theta to 1e-8, as programs for the contest do, puts a handle up "
            "to {bisected} m off, enough to change the sixth decimal. Here every handle is "
            "computed to rounding from the one before it; the angle keeps the digits that a "
            "plain sum would lose. All handles are within {here} m of their exact positions."
        ),
        chord=f"{float(found.residuals.max()):.1e}",
        bisected=f"{float(found.off_bisected.max()):.1e}",
        here=f"{float(found.off.max()):.1e}",
    )
    yield Picture("errors-chain", _("Errors along the 223 benches, 300 s after the start."))
    yield say(
        _(
            "A search in time steps answers with the first of its times at which benches "
            "overlap: hence 412 s and 413 s from steps of a second. A traversal of pitches "
            "answers with a multiple of its step: 0.452 m is consistent with steps of 0.002 m and "
            "of 0.004 m, and the paper prints none. Evaluating at the disc alone misses the graze "
            "before it."
        )
    )
    yield Picture("errors-steps", _("What stepped searches answer, over their steps."))
    yield Table(
        (_("time step (s)"), _("first contact seen (s)"), _("late by (s)")),
        (1, 1, 1),
        tuple(
            (f"{step:g}", f"{seen:g}", f"{seen - contact_of(found).value:.6f}")
            for step, seen in found.stepped
        ),
        numbers=True,
    )
    yield Table(
        (_("pitch step (m)"), _("time step (s)"), _("smallest pitch (m)"), _("too large by (m)")),
        (1, 1, 1, 1),
        tuple(
            (
                f"{pitch:g}",
                _("at the disc alone") if time > 1e5 else f"{time:g}",
                f"{answer.value:.4f}",
                f"{answer.value - found.smallest.value:.6f}",
            )
            for pitch, time, answer in found.traversal
        ),
        numbers=True,
    )


# What sizes are called.
SIZE_NAMES = {
    "route.pitch": N_("pitch"),
    "disc.radius": N_("radius of the disc"),
    "dragon.width": N_("width of the benches"),
    "dragon.head_length": N_("length of the head"),
    "dragon.body_length": N_("length of the other benches"),
    "dragon.tail_length": N_("length of the tail"),
    "dragon.front_inset": N_("front edge to hole"),
    "dragon.rear_inset": N_("rear edge to hole"),
    "turn.ratio": N_("ratio of the radii, per 0.01"),
}


def conditioning(found: Results) -> Iterable[Block]:
    """How each answer moves with each size."""
    yield Heading(_("Sensitivity analysis"), "conditioning")
    yield say(
        _(
            "How each answer changes with each size: derivatives of the chain itself, and for "
            "comparison difference quotients of two answers, {step} m (or that much of the "
            "ratio) to either side. A size without influence has sensitivity 0."
        ),
        step=f"{DIFFERENCE_STEP:g}",
    )
    names = {
        "first_contact": (_("first contact"), _("s per cm"), 1.0),
        "smallest_pitch": (_("smallest pitch"), _("mm per cm"), 1e3),
        "greatest_head_speed": (_("greatest head speed"), _("mm/s per cm"), 1e3),
    }
    for name, (text, unit, scale) in names.items():
        yield Heading(f"{text} ({unit})", f"rates-{name}", 2)
        yield Table(
            (_("size"), _("derivative"), _("difference")),
            (1.6, 1, 1),
            tuple(_rate_row(rate, 0.01 * scale) for rate in found.rates[name]),
            numbers=True,
        )


def _rate_row(rate: Rate, scale: float) -> tuple[Inline, ...]:
    name = f"{_(SIZE_NAMES[rate.key])} ({rate.key})"
    return (name, *(decimals(scale * value, 8) for value in (rate.exact, rate.difference)))


def people(found: Results) -> Iterable[Block]:
    """What imprecise people need."""
    yield Heading(_("When people are not exact"), "people")
    yield say(
        _(
            "The paper assumes that every handle keeps to the route (1), that pull and friction "
            "play no part (2), that the pitch does not vary (3), that heights do not matter (4). "
            "Here these are relaxed one at a time: {draws} random dances (seed {seed}) are "
            "walked, benches rigid and joined, and the pitch that each needs is sought. Lengths "
            "are standard deviations. Between two evaluations a bound holds, so that no contact "
            "is missed; that a dance without contact at its pitch has none at larger ones is "
            "taken for granted."
        ),
        draws=DRAWS,
        seed=SEED,
    )
    yield say(
        _(
            "The dances are kept with the program, since they take a quarter of an hour; the first "
            "{count} of each row were walked again in this run and need the same pitch to {again} m."
        ),
        count=AGAIN,
        again=f"{max(found.again, 1e-9):.0e}",
    )
    yield Picture("margins", _("The chance that benches touch, over the pitch."))
    columns = (
        _("relaxed assumption"),
        _("by how much (cm)"),
        _("median (m)"),
        _("1 in 10 touches (m)"),
        _("1 in 20 touches (m)"),
        _("other dances that touch at the larger of these (%)"),
        _("tolerance over the exact pitch (cm)"),
    )
    rows = []
    for name in CASES:
        one, vouched = found.dances.tolerance(name), found.dances.vouched[name]
        deviations = ", ".join(f"{100.0 * size:g}" for size in vars(one.deviations).values() if size)
        room = 100.0 * (one.pitch_for(0.05) - found.smallest.value)
        numbers = (
            decimals_or_dash(np.median(one.needed)),
            *(f"{one.pitch_from(risk):.4f}..{one.pitch_for(risk):.4f}" for risk in (0.1, 0.05)),
            "{:.1f} ({:.1f}..{:.1f})".format(*(100.0 * part for part in vouched.chance)),
            decimals_or_dash(room, 1),
        )
        rows.append((_(CASES[name].text), deviations, *numbers))
    yield Table(columns, (2.2, 0.9, 0.8, 1.3, 1.3, 1.3, 0.9), tuple(rows))
    yield say(
        _(
            "To read off a tolerance: the last column is what a troupe adds to the exact pitch, "
            "so that at most one dance in twenty touches; each end of a range is sure to 95 %. "
            "{draws} other dances (seed {seed}), which had no part in choosing that pitch, were "
            "walked at it. How far a troupe strays it must measure itself."
        ),
        draws=DRAWS,
        seed=OTHER_SEED,
    )


def evidence_table(found: Results, docs: str | None) -> Iterable[Block]:
    """For each number its derivation, code and tests; links to `docs` if that is given."""
    yield Heading(_("How each number was established"), "how")
    for anchor, (formulas, text) in _derivations(found).items():
        evidence = EVIDENCE[anchor]
        yield Heading(_(evidence.title), f"how-{anchor}", 2)
        yield Paragraph((text,))
        for formula in formulas:
            yield Formula(formula)
        words: list[Inline] = [
            _("Code: {code}. Tests: {tests}.").format(code=evidence.code, tests=evidence.test)
        ]
        if docs is not None:
            target = f"{docs.rstrip('/')}/{evidence.page}"
            words += [" ", Link(_("The page that derives it, with code and test"), target)]
        yield Paragraph(tuple(words))


def _derivations(found: Results) -> dict[str, tuple[tuple[str, ...], str]]:
    """For each number, formulas with this run's numbers in them, and what is done in words."""
    k = found.spiral.value("route.pitch") / (2.0 * math.pi)
    first, smallest, arcs = contact_of(found), found.smallest, found.two_arcs
    links = found.motion.walk.dragon.links
    ratio = (found.turn.limits.speed or math.nan) / found.head_speed.value
    rate = {one.key: one.exact for one in found.rates["smallest_pitch"]}
    return {
        "chain": (
            (
                f"k = p/2π = {k:.12f} m;  s(θ) = k/2 (θ sqrt(1+θ²) + asinh θ)",
                f"|P(s_i) - P(s_i+1)| = d_i,  d_0 = {links[0]:g} m,  d_i = {links[1]:g} m",
            ),
            _(
                "The head's position comes from inverting the arc length that it has walked. "
                "Each next handle is at the nearest position behind that is one link away: "
                "stepping back by link minus chord cannot jump over it."
            ),
        ),
        "speeds": (
            ("v_i+1 = v_i (t_i · u_i)/(t_i+1 · u_i)",),
            _(
                "Rigid benches keep their length, so the parts of two handles' velocities along a "
                "bench are equal."
            ),
        ),
        "first-contact": (
            (
                "d(t) ≥ (d(a) + d(b) - D_i - D_j)/2,  a ≤ t ≤ b",
                f"{first.lower:.13f} s ≤ t ≤ {first.upper:.13f} s",
            ),
            _(
                "While the head goes on by a step, no point of a bench travels farther than D, "
                "which follows from how far its handles go: where the bound stays above 0 the "
                "whole step is free of contact; else it is halved."
            ),
        ),
        "smallest-pitch": (
            (
                "d(p, s) = 0,  d'(p, s) = 0,  d' = dd/ds",
                f"{smallest.lower:.15f} m ≤ p ≤ {smallest.upper:.15f} m",
                "dp/dw = {rate:.6f}".format(rate=rate["dragon.width"]),
            ),
            _(
                "Each pitch is tried with the search that misses no contact. Where it fails, the "
                "least clearance of the pair that touches is a smooth function of the pitch, "
                "whose root is tried next. At the lower end of the bracket that pair overlaps; "
                "at the upper end the whole walk is free of contact."
            ),
        ),
        "turn": (
            (f"r1 + r2 = R/sin ψ,  tan ψ = R/k,  L = (r1 + r2) 2ψ = {arcs.length:.10f} m",),
            _(
                "Two arcs between tangents at opposite points of the disc have one length, "
                "whatever their ratio. With a line or a third arc between them, and joints that "
                "may move, turns get shorter; a global search finds them and exact figures judge "
                "them."
            ),
        ),
        "greatest-head-speed": (
            (f"v = {found.turn.limits.speed:g} / {ratio:.12f} = {found.head_speed.value:.12f} m/s",),
            _(
                "The greatest ratio of a handle's speed to the head's, over all handles and all "
                "times, by bounds on how ratios change: between evaluations no ratio can exceed "
                "the upper end of the bracket."
            ),
        ),
    }


def left_out() -> Iterable[Block]:
    """What nothing here speaks of."""
    yield Heading(_("What is not modelled"), "left-out")
    yield say(
        _(
            "Benches do not bend, arms do not tire, the ground is flat, nobody stumbles. The "
            "chances above hold for deviations that are independent, normally distributed and "
            "constant throughout a dance; those of a real troupe may differ. Better turns are "
            "found, not proved."
        )
    )
