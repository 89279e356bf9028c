"""How the tolerance is derived, in plain words with the case's own numbers."""

import math
from dataclasses import fields

from benchdragon.explain.text import number, signed
from benchdragon.i18n import _
from benchdragon.kernels.binomial import tails
from benchdragon.kernels.random_dance_look import PITCH_TOLERANCE
from benchdragon.kernels.random_numbers import Random
from benchdragon.plans.schema import Plan
from benchdragon.solve.tolerance import CONFIDENCE, Draw, Tolerance, needed_pitch

# The chance for which the choice of a pitch is shown.
RISK = 0.05


def margin_lines(plan: Plan, found: Tolerance) -> list[str]:
    """One step a line: a dance, its pitch, the chance at the plan's own, the pitch for a small chance.

    Raises:
        InputError: if the dances were not walked at the plan's own pitch.
    """
    return [
        _("Without deviations the pitch needed is {pitch} m: the answer of solve pitch.").format(
            pitch=number(found.exact)
        ),
        *_dance_lines(plan, found),
        *_chance_lines(found, plan.value("route.pitch")),
        *_risk_lines(found),
    ]


def _dance_lines(plan: Plan, found: Tolerance) -> list[str]:
    """The first dance: its second bench, and the pitch that it needs."""
    draw, plain = Draw(found.deviations, found.seed, 0), plan.build().dragon
    deviations = ", ".join(
        f"{field.name} {number(getattr(found.deviations, field.name))} m"
        for field in fields(found.deviations)
        if getattr(found.deviations, field.name)
    )
    drawn = draw.dragon(plain)
    n = min(1, len(plain) - 1)
    height = found.deviations.height * float(draw.noise(Random.HEIGHT, len(plain))[n])
    play = found.deviations.play * float(draw.noise(Random.PLAY, len(plain))[n])
    length = float(drawn.length[n])
    front, rear = float(plain.front_inset[n]), float(plain.rear_inset[n])
    needed = needed_pitch(plan, draw, found.exact)
    return [
        _("{count} random dances; standard deviations: {deviations}.").format(
            count=found.needed.size, deviations=deviations or "0"
        ),
        _(
            "For example dance 1, bench {bench}: length {length} m, its rear handle stands "
            "{height} m higher or lower than its front one, pin play {play} m. Seen from above "
            "its link is √((length - insets)² - height²) + play = √(({length} - {front} - "
            "{rear})² - {height}²) + {play} = {link} m."
        ).format(
            bench=n + 1, length=number(length), height=number(abs(height)), front=number(front),
            rear=number(rear), play=signed(play), link=number(float(drawn.links[n])),
        ),
        _("Its front, handle {handle}, stays {aside} m beside the route that is walked, from "
          "start to end.").format(
            handle=n, aside=number(found.deviations.aside * float(draw.noise(Random.ASIDE,
            len(plain) + 1)[n]))
        ),
        _(
            "Walked with several pitches, dance 1 is free of contact with {pitch} m, and touches "
            "with {less} m less. That it is free of contact with all larger ones is taken for "
            "granted."
        ).format(pitch=number(needed), less=number(PITCH_TOLERANCE)),
    ]  # fmt: skip


def _chance_lines(found: Tolerance, pitch: float) -> list[str]:
    """The share that touches, and the tails that bound the chance."""
    count = found.needed.size
    share, low, high = found.touching()
    hits = round(share * count)
    tail = 0.5 * (1.0 - CONFIDENCE)
    text = _("Walked with {pitch} m, {hits} of {count} touch: {hits}/{count} = {share}.")
    lines = [text.format(hits=hits, count=count, pitch=number(pitch), share=number(share))]
    if hits:
        lines.append(
            _(
                "Lower bound {low}: with that chance {hits} or more of {count} would touch in "
                "{tail} of all cases; computed {seen}."
            ).format(
                low=number(low), hits=hits, count=count, tail=number(tail),
                seen=number(tails(hits - 1, count, low)[1]),
            )
        )  # fmt: skip
    if hits < count:
        lines.append(
            _(
                "Upper bound {high}: with that chance {hits} or fewer of {count} would touch in "
                "{tail} of all cases; computed {seen}."
            ).format(
                high=number(high), hits=hits, count=count, tail=number(tail),
                seen=number(tails(hits, count, high)[0]),
            )
        )  # fmt: skip
    return lines


def _risk_lines(found: Tolerance) -> list[str]:
    """Why the pitch for a small chance is the one it is."""
    count, pitch = found.needed.size, found.pitch_for(RISK)
    if math.isinf(pitch):
        return [
            _(
                "For a chance of {risk} {count} dances are too few: even if none needed more, that "
                "would happen in {seen} of all cases, more than {least}."
            ).format(
                risk=number(RISK), count=count, seen=number((1.0 - RISK) ** count),
                least=number(1.0 - CONFIDENCE),
            )
        ]  # fmt: skip
    more = int((found.needed > pitch).sum())
    return [
        _(
            "For a chance of {risk}: {more} of {count} dances need more than {pitch} m. Were the "
            "chance larger, so few would happen in {seen} of all cases, at most {least} is allowed."
        ).format(
            risk=number(RISK), more=more, count=count, pitch=number(pitch),
            seen=number(tails(more, count, RISK)[0]), least=number(1.0 - CONFIDENCE),
        )
    ]  # fmt: skip
