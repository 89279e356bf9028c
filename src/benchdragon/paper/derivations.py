"""Chapter of the report on how each number was established: in words, formulas and pictures."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from benchdragon.export.document import Block, Formula, Heading, Inline, Link, Paragraph, Picture, say
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.paper.claims import SMALLEST_PITCH
from benchdragon.paper.results import Results
from benchdragon.solve.turn import BestTurn


def contact_of(found: Results) -> Answer:
    """The first contact of the paper's first part."""
    if found.report.first_contact is None:
        raise AssertionError("the contest's dragon touches")
    return found.report.first_contact


def evidence_table(found: Results, docs: str | None) -> Iterable[Block]:
    """For each number its derivation, code and tests; links to `docs` if that is given."""
    yield Heading(_("How each number was established"), "how")
    for anchor, evidence in EVIDENCE.items():
        yield Heading(_(evidence.title), f"how-{anchor}", 2)
        yield from evidence.derived(found)
        text = _("Code: {code}. Tests: {tests}.").format(code=evidence.code, tests=evidence.tests)
        words: list[Inline] = [text]
        if docs is not None:
            target = f"{docs.rstrip('/')}/established.html#{anchor}"
            words += [" ", Link(_("The page that derives it, with code and test"), target)]
        yield Paragraph(tuple(words))


def _chain(found: Results) -> Iterable[Block]:
    yield say(
        "The head's position comes from inverting the arc length that it has walked. "
        "Each next handle is at the nearest position behind that is one link away: "
        "stepping back by link minus chord cannot jump over it. "
        "{geometry-polar} shows two handles, their polar angles and the link between them."
    )
    pitch = found.spiral.value("route.pitch")
    head, body = (float(link) for link in found.motion.walk.dragon.links[:2])
    yield Formula(
        rf"p = {pitch:g}\,\mathrm{{m}},\quad k = \dfrac{{p}}{{2\pi}},\quad r = k\theta,\quad "
        r"s(\theta) = \dfrac{k}{2}\left(\theta\sqrt{1+\theta^2} + \mathrm{arsinh}\,\theta\right)",
        f"p = {pitch:g} m, k = p/2π, r = kθ, s(θ) = k/2 (θ sqrt(1+θ²) + arsinh θ)",
    )
    yield Formula(
        rf"\left|P_{{i-1}} - P_i\right| = L_i,\quad L_1 = {head:g}\,\mathrm{{m}},\quad "
        rf"L_2 = \ldots = L_{{223}} = {body:g}\,\mathrm{{m}}",
        f"|P_i-1 - P_i| = L_i, L_1 = {head:g} m, L_2 = ... = L_223 = {body:g} m",
    )
    yield Picture(
        "geometry-polar",
        _("Handles 0 and 1 on the spiral, tangents t, and the direction u of the bench between them."),
    )


def _speeds(_found: Results) -> Iterable[Block]:
    yield say(
        "Rigid benches keep their length, so the parts of two handles' velocities along a "
        "bench are equal. "
        "{geometry-polar} shows the directions."
    )
    yield Formula(
        r"v_i = v_{i-1}\,\dfrac{t_{i-1}\cdot u_i}{t_i\cdot u_i}",
        "v_i = v_i-1 (t_i-1 · u_i)/(t_i · u_i)",
    )


def _contact(found: Results) -> Iterable[Block]:
    first = contact_of(found)
    yield say(
        "While the head goes on by a step, no point of a bench travels farther than D, "
        "which follows from how far its handles go: where the bound stays above 0 the "
        "whole step is free of contact; else it is halved."
    )
    yield Formula(
        r"d(t) \geq \dfrac{d(a) + d(b) - D_i - D_j}{2},\quad a \leq t \leq b",
        "d(t) ≥ (d(a) + d(b) - D_i - D_j)/2, a ≤ t ≤ b",
    )
    yield _bracket(first, "t", 13)
    yield say(
        "Whether two benches overlap is decided on four axes, along and across either bench "
        "({geometry-axes}): the signed gap is the largest separation of their projections."
    )
    yield Formula(
        r"g = \max_{n}\,\left(\min_{q}\; n\cdot q \;-\; \max_{p}\; n\cdot p\right)",
        "g = max over axes n of (min n · q - max n · p), p in one bench, q in the other",
    )
    yield Picture(
        "geometry-axes",
        _(
            "The separating axes of the two benches that touch first, shortly before they do; on the "
            "left their projections on the axis that separates them most, where g is the signed gap."
        ),
    )


def _pitch(found: Results) -> Iterable[Block]:
    rate = {one.key: one.exact for one in found.rates["smallest_pitch"]}["dragon.width"]
    yield say(
        "Each pitch is tried with the search that misses no contact. Where it fails, the "
        "least clearance of the pair that touches is a smooth function of the pitch, "
        "whose root is tried next. At the lower end of the bracket that pair overlaps; "
        "at the upper end the whole walk is free of contact."
    )
    yield Formula(
        r"d(p, s) = 0,\quad \dfrac{\partial d}{\partial s}(p, s) = 0", "d(p, s) = 0, ∂d/∂s (p, s) = 0"
    )
    yield _bracket(found.smallest, "p", 15)
    yield Formula(rf"\dfrac{{dp}}{{dw}} = {rate:.6f}", f"dp/dw = {rate:.6f}")


def _turn(found: Results) -> Iterable[Block]:
    arcs = found.two_arcs
    yield say(
        "Two arcs between tangents at opposite points of the disc have one length, "
        "whatever their ratio. With a line or a third arc between them, and joints that "
        "may move, turns get shorter; a global search finds them and exact figures judge "
        "them."
    )
    yield say(
        "{turn-disc} shows why: the radii at A and at B are parallel, so that C lies on AB, and "
        "AC is the base of an isosceles triangle with the angle α."
    )
    yield Formula(
        r"AC + CB = 2\,(r_1 + r_2)\cos\alpha = 2R,\quad \alpha = \dfrac{\pi}{2} - \psi,\quad "
        r"\tan\psi = \dfrac{R}{k}",
        "AC + CB = 2 (r1 + r2) cos α = 2R, α = π/2 - ψ, tan ψ = R/k",
    )
    yield Formula(
        r"r_1 + r_2 = \dfrac{R}{\sin\psi},\quad S_1 + S_2 = (r_1 + r_2)\,\varphi,\quad "
        rf"\varphi = 2\psi,\quad S_1 + S_2 = {arcs.length:.10f}\,\mathrm{{m}}",
        f"r1 + r2 = R/sin ψ, S1 + S2 = (r1 + r2) φ, φ = 2ψ, S1 + S2 = {arcs.length:.10f} m",
    )


def _head_speed(found: Results) -> Iterable[Block]:
    limit, speed = found.turn.limits.speed or 0.0, found.head_speed.value
    yield say(
        "The greatest ratio of a handle's speed to the head's, over all handles and all "
        "times, by bounds on how ratios change: between evaluations no ratio can exceed "
        "the upper end of the bracket. "
        "{turn-ratio} shows it."
    )
    yield Formula(
        rf"v = \dfrac{{{limit:g}\,\mathrm{{m/s}}}}{{{limit / speed:.12f}}} = "
        rf"{speed:.12f}\,\mathrm{{m/s}}",
        f"v = {limit:g} m/s / {limit / speed:.12f} = {speed:.12f} m/s",
    )


def _bracket(answer: Answer, letter: str, digits: int) -> Formula:
    lower, upper, unit = f"{answer.lower:.{digits}f}", f"{answer.upper:.{digits}f}", answer.unit
    return Formula(
        rf"{lower}\,\mathrm{{{unit}}} \leq {letter} \leq {upper}\,\mathrm{{{unit}}}",
        f"{lower} {unit} ≤ {letter} ≤ {upper} {unit}",
    )


@dataclass(frozen=True)
class Evidence:
    """How a number is established: where it is derived, computed, and tested."""

    title: str
    derived: Callable[[Results], Iterable[Block]]
    code: str
    tests: str


# By the anchor, which that of the documentation's page is, too.
EVIDENCE = {
    "chain": Evidence(
        N_("Positions of the handles"), _chain, "benchdragon.kernels.chain.march",
        "tests/truth/test_truth.py, tests/model/test_walk.py",
    ),
    "speeds": Evidence(
        N_("Speeds of the handles"), _speeds, "benchdragon.model.walk.Motion.speed_ratio",
        "tests/laws/test_laws.py, tests/paper/test_differences.py",
    ),
    "first-contact": Evidence(
        N_("The first contact"), _contact, "benchdragon.analysis.contact.first_contact",
        "tests/analysis/test_contact.py, tests/laws/test_contact_laws.py",
    ),
    "smallest-pitch": Evidence(
        N_("The smallest pitch"), _pitch, "benchdragon.solve.size.limit",
        "tests/solve/test_size.py, tests/analysis/test_proof.py",
    ),
    "turn": Evidence(
        N_("The turn"), _turn,
        "benchdragon.model.turns.TwoArcTurn, benchdragon.solve.turn.best_turn",
        "tests/model/test_turns.py, tests/solve/test_turn.py",
    ),
    "greatest-head-speed": Evidence(
        N_("The greatest head speed"), _head_speed,
        "benchdragon.solve.head_speed.greatest_head_speed", "tests/solve/test_head_speed.py",
    ),
}  # fmt: skip


def consistent_steps(found: Results) -> list[float]:
    """Steps of pitch, m, with which a traversal that looks each second answers as the paper prints."""
    printed = f"{SMALLEST_PITCH:.3f}"
    tried = [(step, answer) for step, time, answer in found.traversal if time == 1.0]
    return [step for step, answer in tried if f"{answer.value:.3f}" == printed]


def how(anchor: str, text: str) -> Link:
    """A link to how a number was established."""
    return Link(text, f"#how-{anchor}")


def established(answer: Answer) -> str:
    """How an answer is known, and how narrow its bracket is."""
    words = {"proved": _("proved"), "found": _("found")}.get(answer.status, _("undecided"))
    width = answer.upper - answer.lower
    text = _("{status}, bracket {width} {unit}")
    return text.format(status=words, width=f"{width:.1e}", unit=answer.unit)


def allowed_speed(best: BestTurn) -> float:
    """The greatest head speed of a turn, m/s; NaN without a limit."""
    return math.nan if best.head_speed is None else best.head_speed.value
