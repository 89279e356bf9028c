"""How a check is derived, in plain words: the contact, and why none is missed (see `text`)."""

from typing import NamedTuple

import numpy as np

from benchdragon.analysis.check import Report
from benchdragon.analysis.distance import boxes, nearness
from benchdragon.analysis.speed import fastest_handle
from benchdragon.analysis.stops import stops_text
from benchdragon.explain.room import room_lines
from benchdragon.explain.square import square_lines
from benchdragon.explain.text import cross_text, distance_text, dot_text, number, pair, signed, tiny
from benchdragon.i18n import _
from benchdragon.model.answer import Answer, Witness
from benchdragon.model.dragon import Dragon
from benchdragon.model.numbering import handle_text
from benchdragon.model.placement import Placement
from benchdragon.model.walk import Walk

# The travel bound is shown this far before a meeting, m of the head's way, where benches are at
# least so far apart, m.
BEFORE, ENOUGH = 1.0, 1e-3
# A speed ratio is written out as a product of so many factors at most.
MOST_FACTORS = 8


def check_lines(report: Report) -> list[str]:
    """The pairs searched, why no contact can be missed, the contact, and the speeds."""
    walk = report.walk
    first, last = walk.head_position([report.start, report.end]).tolist()
    benches, margin = len(walk.dragon), report.plan.limits.margin
    text = _("The walk goes from t = {a} s to t = {b} s; the head walks {way} m.")
    way = f"{number(last)} - {signed(first)} = {number(last - first)}"
    lines = [text.format(a=number(report.start), b=number(report.end), way=way)]
    if report.stops is not None:
        text = _(
            "The head's speed has the cues in it: {stops}; every handle stands when the head does."
        )
        lines.append(text.format(stops=stops_text(report.stops)))
    text = _(
        "Adjacent benches share a handle and lie at different heights. All other pairs count: (n "
        "- 1)·(n - 2)/2 = {numbers}."
    )
    pairs = (benches - 1) * (benches - 2) // 2
    lines.append(text.format(numbers=f"({benches} - 1)·({benches} - 2)/2 = {pairs}"))
    contact, clearance = report.first_contact, report.clearance
    answer = clearance if contact is None else contact
    if answer.witness is not None and pairs:
        lines += _bound_lines(walk, first, answer.witness, margin)
        lines += _contact_lines(contact, margin)
        still = walk.placement([answer.witness.s])
        lines += gap_lines(still, *(bench - 1 for bench in answer.witness.benches))
    if pairs and clearance.value > 0.0 and clearance.witness is not None:
        lines.append(_clearance_line(walk, clearance, clearance.witness))
    lines += square_lines(report)
    lines += room_lines(report)
    if report.proved:
        lines.append(
            _(
                "Proof: this was shown again without the search, in ball arithmetic, which encloses "
                "every number."
            )
        )
    lines += [one.text for one in report.unproved]
    return [*lines, *_greatest_speed_lines(walk, report.greatest_speed, report.plan.limits.speed)]


def _bound_lines(walk: Walk, first: float, near: Witness, margin: float) -> list[str]:
    """The bound by which a step of the head is passed over, and an example of it."""
    text = _(
        "Why no instant is missed: in one step of the head a point of a bench moves at most D, "
        "known from how far its handles go. If two benches are d apart before and d' after the "
        "step, they are never nearer than (d + d' - D - D')/2 in between. More than {margin} m: "
        "the whole step is free of contact; else it is halved. (A finer bound of the same kind, "
        "on accelerations, saves most of the halving.)"
    )
    return [text.format(margin=number(margin)), *_example_lines(walk, first, near, margin)]


def _example_lines(walk: Walk, first: float, near: Witness, margin: float) -> list[str]:
    """A step that ends before a meeting; none where the benches are that near already."""
    at = max(first, near.s - BEFORE)
    i, j = (bench - 1 for bench in near.benches)
    room = nearness(boxes(walk.placement([at]), 0), i, j).distance - margin
    levers = [_lever(walk.dragon, bench) for bench in (i, j)]
    step = room / (4.0 * max(levers))
    two = walk.placement([at, at + step], throw=False)
    if room < ENOUGH or two.status.any():
        return []
    apart = [nearness(boxes(two, n), i, j).distance for n in range(2)]
    gone = [float(np.diff(two.s[:, bench : bench + 2], axis=0).max()) for bench in (i, j)]
    text = _(
        "Example: with the head at {s} m benches {a} and {b} are d = {d} m apart. It goes on by "
        "{step} m; their handles go {ways} m at most."
    )
    lines = [
        text.format(
            s=number(at), a=i + 1, b=j + 1, d=number(apart[0]), step=number(step),
            ways=", ".join(number(way) for way in gone),
        )
    ]  # fmt: skip
    text = _(
        "A point of bench {a} then goes at most (1 + (2·inset + width)/link) times as far: D = {d} m."
    )
    for bench, way in zip((i, j), gone, strict=True):
        lines.append(text.format(a=bench + 1, d=_travel_text(walk.dragon, bench, way)))
    travel = [lever * way for lever, way in zip(levers, gone, strict=True)]
    least = 0.5 * (sum(apart) - sum(travel))
    numbers = " + ".join(number(d) for d in apart) + "".join(f" - {number(d)}" for d in travel)
    text = _(
        "Their distance is d' = {d} m then, so it was never less than (d + d' - D - D')/2 = "
        "{numbers} m."
    )
    return [*lines, text.format(d=number(apart[1]), numbers=f"({numbers})/2 = {number(least)}")]


def _lever(dragon: Dragon, i: int) -> float:
    """The most that a point of bench i moves where both its handles move by at most 1."""
    inset = max(dragon.front_inset[i], dragon.rear_inset[i])
    return float(1.0 + (2.0 * inset + dragon.width[i]) / dragon.links[i])


def _travel_text(dragon: Dragon, i: int, way: float) -> str:
    inset = float(max(dragon.front_inset[i], dragon.rear_inset[i]))
    width, link = float(dragon.width[i]), float(dragon.links[i])
    factor = f"(1 + (2·{number(inset)} + {number(width)})/{number(link)})"
    return f"{factor}·{number(way)} = {number(_lever(dragon, i) * way)}"


def _contact_lines(contact: Answer | None, margin: float) -> list[str]:
    what = _("are less than {margin} m apart").format(margin=number(margin))
    what = what if margin else _("touch")
    if contact is None:
        return [_("At no time do two of them {what}.").format(what=what)]
    text = _(
        "The first time that two {what} is t = {t} s: it does not happen until {lower} s, and at "
        "{upper} s it surely has; bracket {width} s."
    )
    if contact.status == "undecided":
        text = _(
            "Whether two {what} at t = {t} s is too close to tell; it does not happen until "
            "{lower} s, and the doubt ends at {upper} s; bracket {width} s."
        )
    return [
        text.format(
            what=what, t=number(contact.value), lower=f"{contact.lower:.16g}",
            upper=f"{contact.upper:.16g}", width=tiny(contact.upper - contact.lower),
        )
    ]  # fmt: skip


class _Box(NamedTuple):
    """A bench as a rectangle: number, centre, m, direction, half its length and width, m."""

    bench: int
    x: float
    y: float
    ux: float
    uy: float
    half: float
    wide: float

    @property
    def way(self) -> tuple[float, float]:
        return self.ux, self.uy


def gap_lines(placed: Placement, i: int, j: int) -> list[str]:
    """The separating axis theorem for benches i and j (rows, from 0) at a first placement."""
    table = boxes(placed, 0)
    one, two = (_Box(n + 1, *table[n].tolist()) for n in (i, j))
    lines = []
    text = _(
        "Bench {n} is a rectangle with centre C{mark} = {centre} m, direction {name} = {way}, half "
        "length a{mark} = {a} m, half width b{mark} = {b} m."
    )
    for box, name, mark in ((one, "u", ""), (two, "w", "'")):
        lines.append(
            text.format(
                n=box.bench, mark=mark, centre=pair(box.x, box.y), name=name, way=pair(*box.way),
                a=number(box.half), b=number(box.wide),
            )
        )  # fmt: skip
    near = nearness(table, i, j)
    text = _(
        "The signed gap is the greatest of the four: {gap} m. Above 0: a straight line fits "
        "between the two; 0: they just touch; below 0: they overlap."
    )
    lines += [*_free_lines(one, two), text.format(gap=number(near.gap))]
    (bench, corner), (other, side) = near.features
    text = _("Nearest to one another: bench {a}, {corner}; bench {b}, {side}.")
    return [*lines, text.format(a=bench, corner=_(corner), b=other, side=_(side))]


def _free_lines(one: _Box, two: _Box) -> list[str]:
    """The free space between two rectangles along the four directions of their sides."""
    q, u, w = (two.x - one.x, two.y - one.y), one.way, two.way
    c, s = abs(u[0] * w[0] + u[1] * w[1]), abs(u[0] * w[1] - u[1] * w[0])
    text = _("From C to C': q = {q}. How oblique they are: c = |u·w| = {c}; s = |u×w| = {s}.")
    cosine, sine = f"|{dot_text(u, w)}| = {number(c)}", f"|{cross_text(u, w)}| = {number(s)}"
    lines = [text.format(q=pair(*q), c=cosine, s=sine)]
    for box, other, name, own, rest in ((one, two, "u", "", "'"), (two, one, "w", "'", "")):
        along = abs(q[0] * box.ux + q[1] * box.uy) - box.half - other.half * c - other.wide * s
        across = abs(q[0] * box.uy - q[1] * box.ux) - box.wide - other.half * s - other.wide * c
        half, wide = number(other.half), number(other.wide)
        law = f"|q·{name}| - a{own} - a{rest}·c - b{rest}·s"
        numbers = (
            f"|{dot_text(q, box.way)}| - {number(box.half)} - {half}·{number(c)} - {wide}·{number(s)}"
        )
        text = _("Separation along bench {n}: {numbers} m")
        lines.append(text.format(n=box.bench, numbers=f"{law} = {numbers} = {number(along)}"))
        law = f"|q×{name}| - b{own} - a{rest}·s - b{rest}·c"
        numbers = (
            f"|{cross_text(q, box.way)}| - {number(box.wide)} - {half}·{number(s)} - {wide}·{number(c)}"
        )
        text = _("Separation across bench {n}: {numbers} m")
        lines.append(text.format(n=box.bench, numbers=f"{law} = {numbers} = {number(across)}"))
    return lines


def _clearance_line(walk: Walk, answer: Answer, near: Witness) -> str:
    """The least distance, from point to point."""
    i, j = (bench - 1 for bench in near.benches)
    still = walk.placement([near.s])
    points = nearness(boxes(still, 0), i, j).points
    text = _(
        "Least clearance: benches {a} and {b}, nearest points {p} and {q} m: {numbers}; bracket "
        "{width} m."
    )
    return text.format(
        a=i + 1, b=j + 1, p=pair(*points[0]), q=pair(*points[1]), numbers=distance_text(*points),
        width=tiny(answer.upper - answer.lower),
    )  # fmt: skip


def _greatest_speed_lines(walk: Walk, answer: Answer, limit: float | None) -> list[str]:
    near = answer.witness
    if near is None or near.time is None:
        return []
    head = float(walk.profile.speed(near.time))
    ratio, lines = ratio_lines(walk, near)
    text = _("Greatest speed of a handle: v = head speed·ratio = {numbers} m/s; bracket {width} m/s.")
    numbers = f"{number(head)}·{number(ratio)} = {number(head * ratio)}"
    lines.append(text.format(numbers=numbers, width=tiny(answer.upper - answer.lower)))
    if limit is not None:
        text = _("The limit is {limit} m/s; it is kept.")
        kept = answer.keeps(limit)
        if kept is None:
            text = _("The limit is {limit} m/s; whether it is kept is undecided.")
        if kept is False:
            text = _("The limit is {limit} m/s; it is exceeded.")
        lines.append(text.format(limit=number(limit)))
    return lines


def ratio_lines(walk: Walk, near: Witness) -> tuple[float, list[str]]:
    """The greatest speed ratio with the head where a witness says, and its derivation."""
    s = near.s
    ratios = walk.placement([s]).speed_ratio[0]
    row = fastest_handle(ratios)
    ratio = float(ratios[row])
    if not row:
        text = _(
            "With the head at {s} m of the route no handle is faster than the head itself: ratio 1."
        )
        return ratio, [text.format(s=number(s))]
    factors = (ratios[1 : row + 1] / ratios[:row]).tolist()
    numbers = number(ratio)
    if row <= MOST_FACTORS:
        numbers = "·".join(number(factor) for factor in factors) + f" = {numbers}"
    text = _(
        "A bench hands speed on from its front to its rear: v' = v·(t·w)/(t'·w), with w its "
        "direction, t and t' those of the route at its two ends. With the head at {s} m of the route "
        "{handle} is the fastest: ratio to the head's speed = {numbers}."
    )
    handle = handle_text(row, len(walk.dragon))
    return ratio, [text.format(s=number(s), handle=handle, numbers=numbers)]
