"""Chapters of the report on evidence: errors, conditioning, people, and what is left out."""

from collections.abc import Iterable

import numpy as np

from benchdragon.export.document import Block, Heading, Inline, Picture, Table, say
from benchdragon.i18n import N_, _
from benchdragon.number_format import decimals, decimals_or_dash, decimals_towards, outward
from benchdragon.paper.claims import SMALLEST_PITCH
from benchdragon.paper.derivations import consistent_steps, contact_of
from benchdragon.paper.evidence_figures import latest_step
from benchdragon.paper.random_dances import DRAWS, OTHER_SEED, SEED
from benchdragon.paper.results import AGAIN, CONTACT_STEPS, DIFFERENCE_STEP, Rate, Results
from benchdragon.solve.tolerance import CASES


def errors(found: Results) -> Iterable[Block]:
    """Orders, accumulation along the benches, and what steps do."""
    yield Heading(_("Error analysis"), "errors")
    yield from _orders(found)
    yield from _accumulation(found)
    yield from _steps(found)


def _orders(found: Results) -> Iterable[Block]:
    yield say(
        "Runge-Kutta of order 4 is of order {rk} here, fitted where rounding does not show. "
        "Differences of positions are of order {forward} (forward), {central} (central) and "
        "{backward} (backward). "
        "{errors-orders} shows the errors.",
        rk=f"{found.head_order.order:.3f}",
        **{name: f"{one.order:.3f}" for name, one in found.speed_orders.items()},
    )
    yield Picture("errors-orders", _("Errors over steps; the slopes are the orders."))


def _accumulation(found: Results) -> Iterable[Block]:
    yield say(
        "Every chord equals its link to within {chord} m. Position errors add up along the "
        "benches: bisecting theta to 1e-8, as programs for the contest do, puts a handle up "
        "to {bisected} m off, enough to change the sixth decimal. Here every handle is "
        "computed to rounding from the one before it; the angle keeps the digits that a "
        "plain sum would lose. All handles are within {here} m of their exact positions. "
        "{errors-chain} shows both along the dragon.",
        chord=f"{float(found.residuals.max()):.1e}",
        bisected=f"{float(found.off_bisected.max()):.1e}",
        here=f"{float(found.off.max()):.1e}",
    )
    yield Picture("errors-chain", _("Errors along the 223 benches, 300 s after the start."))


def _steps(found: Results) -> Iterable[Block]:
    yield say(
        "A search in time steps answers with the first of its times at which benches "
        "overlap: with steps of a second {seen} s, and {before} s is the last that sees no "
        "contact. A traversal of pitches answers with a multiple of its step: {pitch} m is "
        "consistent with steps of {pitch_steps} m, and the paper prints none. Evaluating at "
        "the disc alone misses the graze before it.",
        seen=f"{dict(found.stepped)[1.0]:g}",
        before=f"{dict(found.stepped)[1.0] - 1.0:g}",
        pitch=f"{SMALLEST_PITCH:g}",
        pitch_steps=_(" or ").join(f"{step:g}" for step in consistent_steps(found)),
    )
    step, seen = latest_step(found.windows, max(CONTACT_STEPS))
    yield say(
        "The step does not bound how late that is. Benches touch in contact windows, {windows} s "
        "and from {last} s on, and are free of contact between: a search whose times all "
        "fall between the windows goes on. With steps of {step} s contact is first seen at "
        "{seen} s, {late} s late, {times} times the step. Only a bound on what happens between "
        "times rules that out ({errors-steps}, {time-steps}, {pitch-steps}).",
        windows=_(", ").join(f"{opens:.3f}\u2013{closes:.3f}" for opens, closes in found.windows[:-1]),
        last=f"{found.windows[-1][0]:.3f}",
        step=f"{step:g}",
        seen=f"{seen:.3f}",
        late=f"{seen - found.windows[0][0]:.2f}",
        times=f"{(seen - found.windows[0][0]) / step:.1f}",
    )
    yield Picture(
        "errors-steps",
        _(
            "What stepped searches answer, over their steps. On the left, shaded, when benches touch: "
            "a step sees the first of its multiples that lies there."
        ),
    )
    yield _time_steps(found)
    yield _pitch_steps(found)


def _time_steps(found: Results) -> Table:
    rows = tuple(
        (f"{step:g}", f"{seen:g}", f"{seen - contact_of(found).value:.6f}")
        for step, seen in found.stepped
    )
    columns = (_("time step (s)"), _("first contact seen (s)"), _("late by (s)"))
    caption = _("The first contact by looking at times one by one.")
    return Table("time-steps", caption, columns, (1, 1, 1), rows, numbers=True)


def _pitch_steps(found: Results) -> Table:
    rows = tuple(
        (
            f"{pitch:g}",
            _("at the disc alone") if time > 1e5 else f"{time:g}",
            f"{answer.value:.4f}",
            f"{answer.value - found.smallest.value:.6f}",
        )
        for pitch, time, answer in found.traversal
    )
    columns = (_("pitch step (m)"), _("time step (s)"), _("smallest pitch (m)"), _("too large by (m)"))
    caption = _("The smallest pitch by traversal.")
    return Table("pitch-steps", caption, columns, (1, 1, 1, 1), rows, numbers=True)


# Names of sizes.
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
        "How each answer changes with each size: derivatives of the chain itself, and for "
        "comparison difference quotients of two answers, {step} m (or that much of the "
        "ratio) to either side. A size without influence has sensitivity 0.",
        step=f"{DIFFERENCE_STEP:g}",
    )
    yield say(
        "{rates-first_contact}, {rates-smallest_pitch} and {rates-greatest_head_speed} hold them."
    )
    names = {
        "first_contact": (_("first contact"), _("s per cm"), 1.0),
        "smallest_pitch": (_("smallest pitch"), _("mm per cm"), 1e3),
        "greatest_head_speed": (_("greatest head speed"), _("mm/s per cm"), 1e3),
    }
    for name, (text, unit, scale) in names.items():
        columns = (_("size"), _("derivative"), _("difference quotient"))
        rows = tuple(_rate_row(rate, 0.01 * scale) for rate in found.rates[name])
        caption = _("Sensitivity: {answer} ({unit}).").format(answer=text, unit=unit)
        yield Table(f"rates-{name}", caption, columns, (1.6, 1, 1), rows, numbers=True)


def _rate_row(rate: Rate, scale: float) -> tuple[Inline, ...]:
    name = f"{_(SIZE_NAMES[rate.key])} ({rate.key})"
    return (name, *(decimals(scale * value, 8) for value in (rate.exact, rate.difference)))


def people(found: Results) -> Iterable[Block]:
    """What imprecise people need."""
    yield Heading(_("When people are not exact"), "people")
    yield say(
        "The paper assumes that every handle keeps to the route (1), that pull and friction "
        "play no part (2), that the pitch does not vary (3), that heights do not matter (4). "
        "Here these are relaxed one at a time: {draws} random dances (seed {seed}) are "
        "walked, benches rigid and joined, and the pitch that each needs is sought. Lengths "
        "are standard deviations. Between two evaluations a bound holds, so that no contact "
        "is missed; that a dance without contact at its pitch has none at larger ones is "
        "taken for granted.",
        draws=DRAWS,
        seed=SEED,
    )
    yield say(
        "The dances are kept with the program, since they take minutes; the first "
        "{count} of each row were walked again in this run and need the same pitch to {again} m.",
        count=AGAIN,
        again=f"{max(found.again, 1e-9):.0e}",
    )
    yield say("{margins} shows the chances, {needed-pitches} the pitches that follow.")
    yield Picture(
        "margins", _("The chance that benches touch, over the pitch; bands: 95 % confidence.")
    )
    yield _needed_pitches(found)
    yield say(
        "To read off a tolerance: the last column is what a troupe adds to the exact pitch, "
        "so that at most one dance in twenty touches; each end of a range is sure to 95 %. "
        "{draws} other dances (seed {seed}), which had no part in choosing that pitch, were "
        "walked at it. How far a troupe strays it must measure itself.",
        draws=DRAWS,
        seed=OTHER_SEED,
    )


# Deviations in the order of the rows of CASES.
DEVIATION_ORDER = ("aside", "play", "stray", "height", "length", "width")


def _needed_pitches(found: Results) -> Table:
    columns = (
        _("relaxed assumption"), _("by how much (cm)"), _("median (m)"), _("1 in 10 touches (m)"),
        _("1 in 20 touches (m)"), _("other dances that touch at the larger of these (%)"),
        _("tolerance over the exact pitch (cm)"),
    )  # fmt: skip
    rows = []
    for name in CASES:
        one, vouched = found.dances.tolerance(name), found.dances.vouched[name]
        sizes = [getattr(one.deviations, size) for size in DEVIATION_ORDER]
        deviations = _(", ").join(f"{100.0 * size:g}" for size in sizes if size)
        room = 100.0 * (one.pitch_for(0.05) - found.smallest.value)
        share, low, high = (100.0 * part for part in vouched.chance)
        numbers = (
            decimals_or_dash(np.median(one.needed)),
            *(outward(one.pitch_from(risk), one.pitch_for(risk)) for risk in (0.1, 0.05)),
            f"{share:.1f} ({outward(low, high, 1)})",
            decimals_towards(room, 2, up=True),
        )
        rows.append((_(CASES[name].text), deviations, *numbers))
    caption = _("The pitches that imprecise people need.")
    return Table("needed-pitches", caption, columns, (2.2, 0.9, 0.8, 1.3, 1.3, 1.3, 0.9), tuple(rows))


def left_out() -> Iterable[Block]:
    """Subjects that are not modelled."""
    yield Heading(_("What is not modelled"), "left-out")
    yield say(
        "Benches do not bend, arms do not tire, the ground is flat, nobody stumbles. The "
        "chances above hold for deviations that are independent, normally distributed and "
        "constant throughout a dance; those of a real troupe may differ. Better turns are "
        "found, not proved."
    )
