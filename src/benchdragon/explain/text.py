"""How a motion is derived, in plain words: each formula with the case's own numbers in it.

A list of lines, one step a line. The text between two equals signs can be typed into a pocket
calculator: A marks the start of a part of the route, a digit the number of a handle.
"""

import math
from dataclasses import dataclass

import numpy as np

from benchdragon.i18n import _
from benchdragon.kernels.status import Status
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line, Route, Spiral
from benchdragon.model.walk import Motion, Walk

# Numbers show so many significant digits, and 6 to 10 decimals.
DIGITS, LEAST_DECIMALS, MOST_DECIMALS = 8, 6, 10
# A head's way is written out for so many spans of its speed profile at most.
MOST_SPANS = 6
# Simpson's rule of three points is shown for clothoids that turn by at most this, rad.
GENTLE = 1.0


def number(value: float) -> str:
    """A number as an explanation shows it: 8 digits, at least 6 decimals, no zeros at the end."""
    size = math.floor(math.log10(abs(value))) if value else 0
    decimals = min(max(DIGITS - 1 - size, LEAST_DECIMALS), MOST_DECIMALS)
    text = f"{value:z.{decimals}f}"
    return text.rstrip("0").rstrip(".")


def signed(value: float) -> str:
    """The same behind an operator: a negative number stands in brackets."""
    text = number(value)
    return f"({text})" if text.startswith("-") else text


def tiny(value: float) -> str:
    """An error or the width of a bracket."""
    return f"{value:.1e}" if value else "0"


def pair(x: float, y: float) -> str:
    """A point or a vector."""
    return f"({number(x)}, {number(y)})"


def distance_text(p: tuple[float, float], q: tuple[float, float]) -> str:
    """The distance of two points, written out and worked out, m."""
    apart = math.hypot(p[0] - q[0], p[1] - q[1])
    inside = " + ".join(f"({number(a)} - {signed(b)})²" for a, b in zip(p, q, strict=True))
    return f"√({inside}) = {number(apart)} m"


def dot_text(a: tuple[float, float], b: tuple[float, float]) -> str:
    """The inner product of two vectors, written out."""
    return " + ".join(f"{signed(one)}·{signed(two)}" for one, two in zip(a, b, strict=True))


def cross_text(a: tuple[float, float], b: tuple[float, float]) -> str:
    """The outer product of two vectors, written out."""
    return f"{signed(a[0])}·{signed(b[1])} - {signed(a[1])}·{signed(b[0])}"


def motion_lines(motion: Motion, leader: str = "closed-form") -> list[str]:
    """The head, the first follower and its speed at the first time at which the dragon stands."""
    sound = np.flatnonzero(motion.status == Status.OK)
    if not sound.size:
        return [_("The dragon can stand at none of these times; there is nothing to explain.")]
    walk, first = motion.walk, int(sound[0])
    time = float(motion.times[first])
    one = walk.motion([time])
    head = _place(walk.route, float(one.s[0, 0]), 0, None)
    after = _place(walk.route, float(one.s[0, 1]), 1, head)
    lines = [_head_line(walk, time), *head.lines]
    if isinstance(head.curve, Spiral):
        lines.append(_rate_line(head, float(one.head_speed[0])))
    if leader != "closed-form":
        apart = abs(float(motion.head_s[first] - one.head_s[0]))
        text = _(
            "{leader} integrates that equation step by step; it puts the head {apart} m from here."
        )
        lines.append(text.format(leader=leader, apart=tiny(apart)))
    lines += [_link_line(walk), *after.lines, *_chord_lines(one, head, after)]
    return [*lines, *_speed_lines(one, head, after), _rest_line(motion)]


@dataclass(frozen=True)
class _Place:
    """A place on the route: on which part, its heading, rad, and how it follows from the arc length.

    `theta` is the angle on a spiral, else NaN.
    """

    part: int
    curve: AnyCurve
    number: int
    alpha: float
    lines: tuple[str, ...]
    theta: float = math.nan


def _head_line(walk: Walk, time: float) -> str:
    s = float(walk.head_position([time])[0])
    text = _(
        "Distance walked by the head = speed·time (the area under its speed). At t = {t} s it "
        "stands at s0 = {start} + {way} = {s} m of the route."
    )
    return text.format(t=number(time), start=number(walk.start), way=_way_text(walk, time), s=number(s))


def _way_text(walk: Walk, time: float) -> str:
    """The head's way from time 0, m, written out: a product, or trapezia."""
    profile = walk.profile
    if len(profile.times) == 1:
        return f"{number(profile.speeds[0])}·{signed(time)}"
    knots = [t for t in profile.times if min(0.0, time) < t < max(0.0, time)]
    stops = [0.0, *(knots if time > 0.0 else knots[::-1]), time]
    if len(stops) > MOST_SPANS + 1:
        return signed(float(profile.distance(time)))
    speeds = profile.speed(stops).tolist()
    spans = zip(stops, stops[1:], speeds, speeds[1:], strict=False)
    return " + ".join(
        f"({number(v)} + {number(w)})/2·({number(b)} - {signed(a)})" for a, b, v, w in spans
    )


def _place(route: Route, s: float, i: int, known: _Place | None) -> _Place:
    """The place of handle i at route position s, m; formulas of a part already `known` are left out."""
    part = int(np.clip(np.searchsorted(route.joints, s, side="right") - 1, 0, len(route.curves) - 1))
    curve, start = route.curves[part], float(route.joints[part])
    text = _(
        "Handle {i} is on {kind}, part {n} of {count} of the route, past its start A by "
        "u{i} = s{i} - sA = {way} m."
    )
    where = text.format(
        i=i, kind=_(curve.called), n=part + 1, count=len(route.curves),
        way=f"{number(s)} - {number(start)} = {number(s - start)}",
    )  # fmt: skip
    new = known is None or known.part != part
    if isinstance(curve, Spiral):
        lines, alpha, theta = _on_spiral(curve, s - start, i, new)
        return _Place(part, curve, i, alpha, (where, *lines), theta)
    steps = {Line: _on_line, Arc: _on_arc, Clothoid: _on_clothoid}
    first, lines, alpha = steps.get(type(curve), _on_curve)(curve, s - start, i)
    lines = [first, *lines] if new else lines
    return _Place(part, curve, i, alpha, (where, *lines))


def length_text(k: float, theta: float) -> str:
    """The arc length of a spiral from its centre to theta, m, written out and worked out."""
    root = theta * math.sqrt(1.0 + theta * theta)
    angle = number(theta)
    return (
        f"{number(k)}/2·({angle}·√(1 + {angle}²) + asinh({angle})) = "
        f"{number(0.5 * k * (root + math.asinh(theta)))} m"
    )


def spiral_way(spiral: Spiral) -> float:
    """The arc length from the centre to the spiral's start, m."""
    theta = spiral.start_angle
    return 0.5 * spiral.k * (theta * math.sqrt(1.0 + theta * theta) + math.asinh(theta))


def _on_spiral(spiral: Spiral, u: float, i: int, new: bool) -> tuple[list[str], float, float]:
    inward, whole = spiral.end_angle < spiral.start_angle, spiral_way(spiral)
    theta, way = float(spiral.angle(u)), whole - u if inward else whole + u
    sign, turn = "-" if inward else "+", "-" if spiral.mirrored else "+"
    lines = _spiral_head(spiral) if new else []
    text = _("From the centre to handle {i}: L{i} = L(θA) {sign} u{i} = {numbers} = {way} m.")
    numbers = f"{number(whole)} {sign} {signed(u)}"
    lines.append(text.format(i=i, sign=sign, numbers=numbers, way=number(way)))
    text = _(
        "The angle with that length: begin with √(2·L{i}/k) = {first}, repeat "
        "θ - (L(θ) - L{i})/(k·√(1 + θ²)) (Newton's method) until it rests: θ{i} = {theta}."
    )
    first = f"√(2·{number(way)}/{number(spiral.k)}) = {number(math.sqrt(2.0 * way / spiral.k))}"
    lines.append(text.format(i=i, first=first, theta=number(theta)))
    lines.append(_("Test: L(θ{i}) = {test}").format(i=i, test=length_text(spiral.k, theta)))
    radius = spiral.k * theta
    phi = spiral.rotation + (-theta if spiral.mirrored else theta)
    text = _("Radius r{i} = k·θ{i} = {radius} m; polar angle φ{i} = {phi}.")
    numbers = f"{number(spiral.k)}·{number(theta)} = {number(radius)}"
    angle = f"{number(spiral.rotation)} {turn} {number(theta)} = {number(phi)}"
    lines.append(text.format(i=i, radius=numbers, phi=angle))
    lines += [
        f"{name}{i} = {symbol} + r{i}·{wave}(φ{i}) = "
        f"{number(centre)} + {number(radius)}·{wave}({number(phi)}) = "
        f"{number(centre + radius * value)} m"
        for name, symbol, wave, centre, value in (
            ("x", "xC", "cos", spiral.centre[0], math.cos(phi)),
            ("y", "yC", "sin", spiral.centre[1], math.sin(phi)),
        )
    ]
    slope = math.atan(theta)
    alpha = phi + (-slope if spiral.mirrored else slope) + (math.pi if inward else 0.0)
    back = " + π" if inward else ""
    numbers = f"{number(phi)} {turn} atan({number(theta)}){back} = {number(alpha)}"
    text = _("Direction of the walk there: α{i} = φ{i} {turn} atan(θ{i}){back} = {numbers}.")
    return [*lines, text.format(i=i, turn=turn, back=back, numbers=numbers)], alpha, theta


def _spiral_head(spiral: Spiral) -> list[str]:
    """What all places on a spiral share."""
    text = _(
        "Spiral: r = k·θ about C = {centre} m, k = pitch/(2·π) = {k} m. It starts at θA = {theta} "
        "({turns} turns)."
    )
    return [
        text.format(
            centre=pair(*spiral.centre), k=f"{number(spiral.pitch)}/(2·π) = {number(spiral.k)}",
            theta=number(spiral.start_angle), turns=f"{spiral.start_angle / (2.0 * math.pi):.4g}",
        ),
        _(
            "Length from the centre to an angle θ: L(θ) = k/2·(θ·√(1 + θ²) + asinh(θ)); L(θA) = "
            "{way}."
        ).format(
            way=length_text(spiral.k, spiral.start_angle)
        ),
    ]  # fmt: skip


def _rate_line(head: _Place, speed: float) -> str:
    """The paper's differential equation at the head."""
    spiral = head.curve
    if not isinstance(spiral, Spiral):
        raise AssertionError("only a spiral has an angle")
    sign = "-" if spiral.end_angle < spiral.start_angle else ""
    rate = float(f"{sign}1") * speed / (spiral.k * math.sqrt(1.0 + head.theta**2))
    angle, k = number(head.theta), number(spiral.k)
    text = _("Its differential equation, which the paper integrates: dθ/dt = {law} = {rate} rad/s.")
    law = f"{sign}v0/(k·√(1 + θ0²)) = {sign}{number(speed)}/({k}·√(1 + {angle}²))"
    return text.format(law=law, rate=number(rate))


def _on_line(line: AnyCurve, u: float, i: int) -> tuple[str, list[str], float]:
    (x, y), alpha = line.start_pose
    text = _("It starts at A = {point} m; its direction is αA = {alpha}.")
    start_text, lines = text.format(point=pair(x, y), alpha=number(alpha)), []
    for name, wave, start, value in (
        ("x", "cos", x, math.cos(alpha)),
        ("y", "sin", y, math.sin(alpha)),
    ):
        numbers = f"{number(start)} + {signed(u)}·{wave}({number(alpha)}) = {number(start + u * value)}"
        lines.append(f"{name}{i} = {name}A + u{i}·{wave}(αA) = {numbers} m")
    return start_text, lines, alpha


def _on_arc(arc: AnyCurve, u: float, i: int) -> tuple[str, list[str], float]:
    (x, y), first = arc.start_pose
    bend = float(arc.curvature(0.0))
    alpha = first + bend * u
    text = _(
        "It starts at A = {point} m in the direction αA = {alpha}; curvature κ = {bend} 1/m (left +)."
    )
    law = f"{'-' if bend < 0.0 else ''}1/{number(1.0 / abs(bend))} = {number(bend)}"
    a, b, k = number(alpha), number(first), signed(bend)
    lines = [f"α{i} = αA + κ·u{i} = {b} + {k}·{number(u)} = {a}"]
    for name, sign, wave, start, value in (
        ("x", "+", "sin", x, x + (math.sin(alpha) - math.sin(first)) / bend),
        ("y", "-", "cos", y, y - (math.cos(alpha) - math.cos(first)) / bend),
    ):
        rule = f"{name}{i} = {name}A {sign} ({wave}(α{i}) - {wave}(αA))/κ"
        numbers = f"{number(start)} {sign} ({wave}({a}) - {wave}({b}))/{k} = {number(value)} m"
        lines.append(f"{rule} = {numbers}")
    return text.format(point=pair(x, y), alpha=b, bend=law), lines, alpha


def _on_clothoid(clothoid: AnyCurve, u: float, i: int) -> tuple[str, list[str], float]:
    (x, y), first = clothoid.start_pose
    bends = clothoid.curvature([0.0, clothoid.length]).tolist()
    change = (bends[1] - bends[0]) / clothoid.length
    half, alpha = (first + w * (bends[0] + 0.5 * change * w) for w in (0.5 * u, u))
    point = clothoid.point(u).tolist()
    text = _(
        "It starts at A = {point} m in the direction αA = {alpha}; its curvature grows evenly from "
        "κA = {bend}: c = {change} 1/m²."
    )
    law = f"({number(bends[1])} - {signed(bends[0])})/{number(clothoid.length)} = {number(change)}"
    start = text.format(point=pair(x, y), alpha=number(first), bend=number(bends[0]), change=law)
    parts = f"{signed(bends[0])}·{number(u)} + {signed(change)}·{number(u)}²/2"
    lines = [f"α{i} = αA + κA·u{i} + c·u{i}²/2 = {number(first)} + {parts} = {number(alpha)}"]
    text = _(
        "x and y are integrals of cos(α) and sin(α) along it. By Gauss's rule: x{i} = {x} m; "
        "y{i} = {y} m."
    )
    lines.append(text.format(i=i, x=number(point[0]), y=number(point[1])))
    if abs(alpha - first) <= GENTLE:
        lines.append(_simpson_line((x, y), (first, half, alpha), u, i))
    return start, lines, alpha


def _simpson_line(start: tuple[float, float], angles: tuple[float, ...], u: float, i: int) -> str:
    """A place on a clothoid as a pocket calculator finds it, from three directions."""
    a, b, c = (number(value) for value in angles)
    numbers = []
    for name, wave, origin, law in (("x", "cos", start[0], math.cos), ("y", "sin", start[1], math.sin)):
        one, two, three = (law(value) for value in angles)
        rough = origin + u / 6.0 * (one + 4.0 * two + three)
        waves = f"{wave}({a}) + 4·{wave}({b}) + {wave}({c})"
        numbers.append(f"{name}{i} ≈ {number(origin)} + {number(u)}/6·({waves}) = {number(rough)} m")
    text = _("Roughly, by Simpson's rule (start, middle, end): {numbers}.")
    return text.format(numbers="; ".join(numbers))


def _on_curve(curve: AnyCurve, u: float, i: int) -> tuple[str, list[str], float]:
    """A place on a curve whose formulas are not written out: where they lead."""
    (x, y), first = curve.start_pose
    at, alpha = curve.point(u).tolist(), float(curve.heading(u))
    start = _("It starts at A = {point} m; its direction is αA = {alpha}.")
    text = _("Its formulas give x{i} = {x} m; y{i} = {y} m; α{i} = {alpha}.")
    line = text.format(i=i, x=number(at[0]), y=number(at[1]), alpha=number(alpha))
    return start.format(point=pair(x, y), alpha=number(first)), [line], alpha


def _link_line(walk: Walk) -> str:
    length, _width, front, rear = (float(size) for size in walk.dragon.sizes[:, 0])
    text = _(
        "Handle 1 is the rear of bench 1: d = length - insets = {link} m from the head in a "
        "straight line. It stands at the first such position behind the head. The search steps "
        "back by what the distance still lacks to d; that is never too far, as no path is "
        "shorter than a straight line."
    )
    link = (
        f"{number(length)} - {number(front)} - {number(rear)} = {number(float(walk.dragon.links[0]))}"
    )
    return text.format(link=link)


def _chord_lines(one: Motion, head: _Place, after: _Place) -> list[str]:
    """The chord equation at the place that was found."""
    p, q = _point(one, 0), _point(one, 1)
    link = float(one.walk.dragon.links[0])
    text = _("Test of the chord: √((x0 - x1)² + (y0 - y1)²) = {numbers}; off from d by {error} m.")
    error = tiny(abs(math.hypot(p[0] - q[0], p[1] - q[1]) - link))
    lines = [text.format(numbers=distance_text(p, q), error=error)]
    if head.part == after.part and isinstance(head.curve, Spiral):
        k, a, b = head.curve.k, head.theta, after.theta
        square = k * k * (a * a + b * b - 2.0 * a * b * math.cos(b - a))
        text = _(
            "The equation that was solved for θ1 (law of cosines), with δ = θ1 - θ0 = {delta}: "
            "k²·(θ0² + θ1² - 2·θ0·θ1·cos(δ)) = {numbers}, and d² = {square}."
        )
        one_, two, delta = number(a), number(b), number(b - a)
        numbers = f"{number(k)}²·({one_}² + {two}² - 2·{one_}·{two}·cos({delta}))"
        numbers += f" = {number(square)}"
        equal = f"{number(link)}² = {number(link * link)}"
        lines.append(text.format(delta=delta, numbers=numbers, square=equal))
    return lines


def _point(one: Motion, i: int) -> tuple[float, float]:
    return float(one.x[0, i]), float(one.y[0, i])


def _speed_lines(one: Motion, head: _Place, after: _Place) -> list[str]:
    """How the rigid bench hands the head's speed on to handle 1."""
    p, q = _point(one, 0), _point(one, 1)
    link, v0, v1 = float(one.walk.dragon.links[0]), float(one.speed[0, 0]), float(one.speed[0, 1])
    u = ((p[0] - q[0]) / link, (p[1] - q[1]) / link)
    text = _("Direction of bench 1: w = ((x0 - x1)/d, (y0 - y1)/d) = {vector}.")
    lines = [text.format(vector=pair(*u))]
    cosines = []
    for place in (head, after):
        t = (math.cos(place.alpha), math.sin(place.alpha))
        cosines.append(t[0] * u[0] + t[1] * u[1])
        text = _(
            "Direction of the route at handle {i}: t{i} = (cos(α{i}), sin(α{i})) = {vector}; along the "
            "bench it is t{i}·w = {numbers}."
        )
        numbers = f"{dot_text(t, u)} = {number(cosines[-1])}"
        lines.append(text.format(i=place.number, vector=pair(*t), numbers=numbers))
    text = _(
        "The bench keeps its length, so both ends move equally fast along it: v1·(t1·w) = v0·(t0·w), "
        "v1 = {numbers} m/s."
    )
    numbers = f"{number(v0)}·{signed(cosines[0])}/{signed(cosines[1])} = {number(v1)}"
    return [*lines, text.format(numbers=numbers)]


def _rest_line(motion: Motion) -> str:
    text = _(
        "So on from handle to handle: {benches} steps for each time asked, {times} in all. "
        "The chords differ from the links by at most {error} m."
    )
    benches = len(motion.walk.dragon)
    return text.format(
        benches=benches, times=benches * len(motion.times), error=tiny(motion.chord_error)
    )
