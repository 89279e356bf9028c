"""How answers of solve and reproduce are derived, in plain words (see `text`)."""

import math
from collections.abc import Sequence

import numpy as np

from benchdragon.analysis.speed import QUANTITIES, given_limits
from benchdragon.explain.contact import gap_lines, ratio_lines
from benchdragon.explain.text import length_text, number, signed, spiral_way, tiny
from benchdragon.i18n import _
from benchdragon.model.answer import Answer, Witness
from benchdragon.model.curves import Spiral
from benchdragon.model.turns import TwoArcTurn
from benchdragon.model.walk import Walk
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan
from benchdragon.solve.head_speed import Pace
from benchdragon.solve.size import FeasibleSizes, undecided_text
from benchdragon.solve.size_family import Meeting, PlanFamily, question
from benchdragon.solve.turn import BestTurn

# Distance from a limit at which the pair's distance is evaluated, m of the size.
ASIDE = 1e-3
# From how far, as a share of the size, the slope of that distance is taken.
SLOPE_STEP = 1e-6
# Sizes tried are listed in full if there are no more.
MOST_LISTED = 12


def limit_lines(plan: Plan, name: str, answer: Answer, tried: Sequence[str]) -> list[str]:
    """How the limit of a size was found; `tried` are the sizes in the order in which they were."""
    text = _("Sought: {what} for which no two non-adjacent benches touch on the whole walk.")
    if plan.limits.margin:
        text = _(
            "Sought: {what} for which non-adjacent benches stay {margin} m apart on the whole walk."
        )
    lines = [
        text.format(what=_(question(name).text), margin=number(plan.limits.margin)),
        _(
            "Whole walks were checked, each so that no contact is missed, with these sizes: {sizes}."
        ).format(sizes=listed(tried)),
    ]
    if answer.status == "infeasible":
        return [*lines, _("None of them passes.")]
    if answer.status == "unlimited":
        return [
            *lines,
            _("All of them pass; none beyond {size} m was tried.").format(size=number(answer.value)),
        ]
    family = PlanFamily(plan, question(name), plan.limits.margin)
    if answer.witness is not None and len(answer.witness.benches) == 2:
        lines += _pair_lines(family, answer, answer.witness)
    lines.append(_bracket_line(answer, family.question.sense))
    if answer.status == "proved":
        lines.append(
            _("Proof: both ends were shown again in ball arithmetic, which encloses every number.")
        )
    return lines


def _bracket_line(answer: Answer, sense: float) -> str:
    """Why the bracket of a limit is sure; sense +1: larger sizes are safer."""
    good, bad = (answer.upper, answer.lower)[:: int(sense)]
    text = _(
        "The bracket is established: with {good} m the whole walk is free of contact, with {bad} "
        "m two benches come too near (or the dragon cannot follow the route); width {width} m. "
        "Sizes beyond it were not tried."
    )
    if answer.status == "undecided":
        text = _(
            "Undecided between {good} m, which passes, and {bad} m, which does not; width {width} m."
        )
    return text.format(good=f"{good:.16g}", bad=f"{bad:.16g}", width=tiny(answer.upper - answer.lower))


def listed(texts: Sequence[str]) -> str:
    """All of a few; the first and the last of many."""
    shown = [*texts] if len(texts) <= MOST_LISTED else [*texts[:3], "…", *texts[-3:]]
    return ", ".join(shown)


def _pair_lines(family: PlanFamily, answer: Answer, near: Witness) -> list[str]:
    """The pair that decides: its distance as a function of the size, the root, the moment."""
    i, j = (bench - 1 for bench in near.benches)
    walk, _start, end = family.walk(answer.value)
    meeting = Meeting(near.s, float(walk.head_position([end])[0]) - near.s, i, j)
    aside = answer.value + math.copysign(ASIDE, family.question.sense)
    room = family.low_point(aside, meeting)[0]
    here, meeting = family.low_point(answer.value, meeting)
    text = _(
        "Benches {a} and {b} decide, with the head at {s} m of the route, {left} m before the end."
    )
    lines = [text.format(a=i + 1, b=j + 1, s=number(meeting.s), left=number(meeting.left))]
    beside = math.copysign(SLOPE_STEP * answer.value, family.question.sense)
    slope = (family.low_point(answer.value + beside, meeting)[0] - here) / beside
    if math.isfinite(slope) and slope != 0.0 and math.isfinite(room):
        text = _(
            "Their least clearance minus the margin of {margin} m is a function f of the size. "
            "With {aside} m, f = {room} m; it changes by {slope} m per metre of size. So f = 0 "
            "near {numbers} m. Repeating this (the secant method) gives {value} m."
        )
        numbers = f"{number(aside)} - {signed(room)}/{signed(slope)}"
        step = f"{number(aside)} - f/{signed(slope)} = {numbers} = {number(aside - room / slope)}"
        lines.append(
            text.format(
                margin=number(family.margin), aside=number(aside), room=number(room),
                slope=number(slope), numbers=step, value=f"{answer.value:.13g}",
            )
        )  # fmt: skip
    return [*lines, *gap_lines(walk.placement([meeting.s]), i, j)]


def spans_lines(sizes: FeasibleSizes, low: float, high: float, count: int) -> list[str]:
    """How all safe sizes of a range are found."""
    numbers = f"({number(high)} - {number(low)})/({count} - 1) = {number(sizes.step)}"
    text = _("{count} sizes were tried, {step} m apart, each on the whole walk.")
    lines = [text.format(count=count, step=numbers)]
    text = _(
        "From {low} m to {high} m all {tried} that were tried pass: {width} m. Where a span ends at a "
        "size that does not pass, its end is exact."
    )
    for span in sizes.spans:
        width = f"{number(span.high)} - {number(span.low)} = {number(span.high - span.low)}"
        ends = {"low": number(span.low), "high": number(span.high)}
        lines.append(text.format(**ends, tried=span.tried, width=width))
    if sizes.undecided:
        lines.append(undecided_text(sizes.undecided) + ".")
    return [*lines, _("Unsafe sizes between two that were tried can be missed.")]


def speed_lines(plan: Plan, answer: Answer, pace: Pace | None = None) -> list[str]:
    """How fast the head may walk: the limit that decides by what the route makes of a head at 1 m/s."""
    near = answer.witness
    if near is None or not math.isfinite(answer.value):
        text = _(
            "Whatever the speed, hardly anything that is limited occurs; {evaluations} evaluations."
        )
        if answer.status == "undecided":
            text = _("Some handle might be arbitrarily fast; {evaluations} evaluations.")
        return [text.format(evaluations=answer.evaluations)]
    walk = plan.build()
    name, allowed, peak = _deciding(plan, walk, answer, near)
    lines = ratio_lines(walk, near)[1] if name == "speed" else []
    quantity = QUANTITIES[name]
    text = _(
        "What decides: {what}, at most {limit} {unit}. With a head at 1 m/s it comes to {peak} {unit}."
    )
    lines.append(
        text.format(what=_(quantity.text), limit=number(allowed), unit=quantity.unit, peak=number(peak))
    )
    numbers = f"{number(allowed)}/{number(peak)} = {number(allowed / peak)} m/s"
    text = _("This grows in step with the head's speed. So v = limit/peak = {numbers}.")
    if quantity.power == 2:
        numbers = f"√({number(allowed)}/{number(peak)}) = {number(math.sqrt(allowed / peak))} m/s"
        text = _("This grows with the square of the head's speed. So v = √(limit/peak) = {numbers}.")
    lines.append(text.format(numbers=numbers))
    text = _(
        "The peak is established: steps of the head are halved until bounds show that none holds "
        "a greater value (branch and bound). {evaluations} evaluations; {lower} m/s surely keeps the "
        "limit; bracket {width} m/s."
    )
    width = tiny(answer.upper - answer.lower)
    lines.append(text.format(evaluations=answer.evaluations, lower=number(answer.lower), width=width))
    return lines if pace is None else [*lines, *_pace_lines(plan, pace)]


def _deciding(plan: Plan, walk: Walk, answer: Answer, near: Witness) -> tuple[str, float, float]:
    """The limit that decides, and the peak of what it limits for a head at 1 m/s, in SI units."""
    one = walk.placement([near.s])
    bend = walk.route.curvature(one.s) * one.speed_ratio**2
    sizes = {
        "speed": one.speed_ratio,
        "turning_rate": one.turning_ratio,
        "lateral_acceleration": bend,
        "total_acceleration": np.hypot(one.ratio_rate, bend),
        "acceleration": one.ratio_rate,
    }
    peaks = {name: float(np.abs(values).max()) for name, values in sizes.items()}
    limits = given_limits(plan)

    def off(name: str) -> float:
        return abs(peaks[name] * answer.value ** QUANTITIES[name].power / limits[name] - 1.0)

    # Accelerations jump at joints, where rounding decides on which side a handle is: only the name is
    # taken from here, the peak itself from the answer.
    name = min(limits, key=off)
    return name, limits[name], limits[name] / answer.value ** QUANTITIES[name].power


def _pace_lines(plan: Plan, pace: Pace) -> list[str]:
    even = min(pace.steady.lower, plan.walk.speed)
    walk = plan.build()
    first, last = walk.head_position(plan.span(walk)).tolist()
    text = _("At constant speed the walk takes distance/speed = {numbers} s.")
    numbers = f"{number(last - first)}/{number(even)} = {number((last - first) / even)}"
    lines = [text.format(numbers=numbers)]
    text = _(
        "With a speed profile the head walks at {speed} m/s and slows down only where a limit "
        "requires it, changing by at most {change} m/s²: {numbers} s."
    )
    numbers = f"{number((last - first) / even)} - {number(pace.saved)} = {number(pace.seconds)}"
    change = number(plan.limits.head_acceleration)
    return [*lines, text.format(speed=number(plan.walk.speed), change=change, numbers=numbers)]


def turn_lines(best: BestTurn) -> list[str]:
    """The turn that was found, piece by piece, and the paper's two arcs beside it."""
    route, turn = best.plan.route, best.turn
    disc = route.disc(best.plan) if isinstance(route, TurnRoute) else turn.entry_radius
    lines = [
        *two_arc_lines(TwoArcTurn(turn.pitch, disc, best.plan.turn.ratio)),
        _("That length is the same for every r1 : r2. The turn that was found:"),
    ]
    for length, a, b in turn.pieces:
        angle = 0.5 * length * (a + b)
        text = _("A line of {length} m.") if not a and not b else _("An arc: radius·angle = {arc} m.")
        if a != b:
            text = _("A clothoid of {length} m; it sweeps length·(κ1 + κ2)/2 = {turned} (left +).")
        radius = "" if not a else f"{number(1.0 / abs(a))}·{number(abs(angle))} = {number(length)}"
        turned = f"{number(length)}·({number(a)} + {signed(b)})/2 = {number(angle)}"
        lines.append(text.format(length=number(length), arc=radius, turned=turned))
    sizes = " + ".join(number(piece[0]) for piece in turn.pieces)
    lines.append(_("Its length: {numbers} m.").format(numbers=f"{sizes} = {number(turn.length)}"))
    lines += _spiral_lines(best, disc)
    if best.head_speed is not None:
        lines += speed_lines(best.plan, best.head_speed)
    text = _(
        "{evaluations} turns were judged: first all over the family, then downhill from the best. What "
        "came out was judged again exactly. That no better one exists is not shown."
    )
    if math.isfinite(best.objective.lower) and math.isfinite(best.objective.upper):
        text = _(
            "{evaluations} turns were judged: first all over the family, then downhill from the best. "
            "What came out was judged again exactly. How much better another may "
            "be was shown box by box (branch and bound): all turns of a box are too long, or one "
            "handle is too fast on each of them."
        )
    return [*lines, text.format(evaluations=best.objective.evaluations)]


def two_arc_lines(turn: TwoArcTurn) -> list[str]:
    """The paper's turn, from the disc's edge to the disc's edge."""
    psi, radii, total = 0.5 * turn.sweep, turn.radii, sum(turn.radii)
    text = _(
        "The paper's two arcs, from edge to edge of the disc (R = {disc} m): the spiral's angle "
        "there is θ = 2π·R/pitch = {theta}."
    )
    theta = f"2·π·{number(turn.entry_radius)}/{number(turn.pitch)} = {number(turn.theta)}"
    lines = [text.format(disc=number(turn.entry_radius), theta=theta)]
    said = _("Angle between radius and spiral: tan(ψ) = θ, ψ = {psi}.")
    lines.append(said.format(psi=f"atan({number(turn.theta)}) = {number(psi)}"))
    sums = f"{number(turn.entry_radius)}/sin({number(psi)}) = {number(total)}"
    text = _("Radii: r1 + r2 = R/sin(ψ) = {sums} m; with r1 : r2 = {ratio} they are {a} m and {b} m.")
    lines.append(
        text.format(sums=sums, ratio=number(turn.ratio), a=number(radii[0]), b=number(radii[1]))
    )
    length = f"{number(total)}·2·{number(psi)} = {number(turn.length)}"
    return [*lines, _("Both sweep 2ψ. Length: (r1 + r2)·2ψ = {length} m.").format(length=length)]


def _spiral_lines(best: BestTurn, disc: float) -> list[str]:
    """The whole way inside the disc: what is left of the spirals there, and the turn."""
    turn, spirals, lines = best.turn, [], []
    for name, radius in ((_("in"), turn.entry_radius), (_("out"), turn.exit_radius)):
        edge, joint = (Spiral.between(turn.pitch, size, 0.0) for size in (disc, radius))
        spirals.append(spiral_way(edge) - spiral_way(joint))
        if not spirals[-1]:
            continue
        text = _(
            "On the spiral {name}, from R = {disc} m to the joint at {radius} m: L(θR) - L(θ) = "
            "{numbers} m, L(θ) = {way}"
        )
        numbers = f"{number(spiral_way(edge))} - {number(spiral_way(joint))} = {number(spirals[-1])}"
        lines.append(
            text.format(
                name=name, disc=number(disc), radius=number(radius), numbers=numbers,
                way=length_text(joint.k, joint.start_angle),
            )
        )  # fmt: skip
    parts = " + ".join(number(value) for value in (*spirals, turn.length))
    whole = sum(spirals) + turn.length
    return [
        *lines,
        _("Path inside the disc: {numbers} m.").format(numbers=f"{parts} = {number(whole)}"),
    ]
