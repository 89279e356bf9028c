"""All turns of a box of a family at once: their lengths, and places on their routes, enclosed.

A turn leads from the inward spiral by an arc to the right, a line (or none) and an arc to the left to
the outward spiral, its half-turned twin. With f1 and f2 what the arcs turn by, w the line's direction
and D its vector from the first centre to the second: D w is the line, D x w the sum of the radii. From
this the slopes of angle and length follow in closed form; a radius r changes the length by f - sin f.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

from flint import arb, ctx

from benchdragon.proofs import BITS
from benchdragon.proofs.mean_value import ANY, ZERO, Box, Form, UnboundedError, angle_of, either

ctx.prec = BITS
PI: arb = arb.pi()
# Families of turns that are enclosed here, and what their numbers are after the joints' radii.
FAMILIES = {"arc-arc": 1, "arc-line-arc": 2}
# An arc nearer to none or a full turn than this, in full turns, may be either.
FULL = 1e-11
# Newton's steps to an angle of the spiral, and how often slopes are computed again from what they
# narrow.
STEPS, PASSES = 60, 2
# Pieces of a route: spiral, arc, line, arc, spiral.
FIRST_ARC, LINE, LAST_ARC, OUT = 1, 2, 3, 4


class NoTurnError(Exception):
    """No turn of the box exists."""


class Pose(NamedTuple):
    """A point, m, and the unit tangent in the walking direction."""

    x: Form
    y: Form
    along: Form
    across: Form


def spiral_length(k: arb, theta: arb) -> arb:
    """Arc length of the spiral r = k theta from its centre, m."""
    return k / 2 * (theta * (1 + theta * theta).sqrt() + theta.asinh())


def _length_to(k: arb, theta: Form) -> Form:
    root = (theta.square() + 1).root()
    return (theta * root + theta.hyperbolic()) * (k / 2)


def spiral_angle(k: arb, length: Form) -> Form:
    """The angle at which the spiral has so much arc length, rad."""
    middle, over = _angle_at(k, length.middle), _angle_at(k, length.over)
    slope = 1 / (k * (1 + over * over).sqrt())
    slopes = [ZERO if own is ZERO else slope * own for own in length.slopes]
    return Form(length.box, middle, over, slopes).narrowed()


def _angle_at(k: arb, length: arb) -> arb:
    if not length > 0:
        raise UnboundedError("a place beyond the centre of a spiral")
    wanted = length.mid()
    theta = arb(math.sqrt(2.0 * float(wanted / k)))
    for _step in range(STEPS):
        off = (spiral_length(k, theta) - wanted).mid()
        if abs(off) < 1e-28 * (1 + wanted):
            break
        theta = (theta - off / (k * (1 + theta * theta).sqrt())).mid()
    off = length - spiral_length(k, theta)
    # The angle's slope is 1 / k at most, which tells how far it may be, and so its slope.
    far = theta + arb(0, float((off / k).abs_upper()))
    for _pass in range(PASSES):
        far = theta + off / (k * (1 + far * far).sqrt())
    return far


def _swept(angle: Form) -> tuple[Form, bool]:
    """The angle of an arc, rad, up to full turns; and whether that is sure."""
    full = 2 * PI
    count = math.floor(float(angle.middle / full))
    share = angle.over / full - count
    if share > FULL and share < 1 - FULL:
        return angle - full * count, True
    slopes = [ZERO if own is ZERO else ANY for own in angle.slopes]
    whole = PI + arb(0, float(PI) * (1.0 + FULL))
    return Form(angle.box, whole, whole, slopes), False


class TurnShape:
    """The turns of a box of a family, and the routes that they belong to.

    Args:
        family: one of FAMILIES.
        pitch: of both spirals, m.
        disc: radius of the turning space, m.
        box: ranges of the joints' radii, m, and of what the family has: the logarithm of r1 : r2, or
            both radii, m.
        backwards: whether route positions are counted from where the turn ends, else from where it
            begins.

    Attributes:
        length: of the turn, m.
        way: the whole path inside the disc, m.
        radii: of both arcs, m.
        joints: route positions where the pieces join, m, four; those of a line of no length are two.
        sure: whether all turns of the box exist, and no arc of them is none or a full turn.

    Raises:
        NoTurnError: if none of the turns exists.
        UnboundedError: if they cannot be enclosed.
    """

    def __init__(self, family: str, pitch: float, disc: float, box: Box, backwards: bool) -> None:
        self.box, self._k, self._backwards = box, arb(pitch) / (2 * PI), backwards
        entry, leave = box.number(0), box.number(1)
        self._theta = entry * (1 / self._k), leave * (1 / self._k)
        self._heading = [theta + theta.arctangent() + PI for theta in self._theta]
        self._ends = _polar(entry, self._theta[0], 1), _polar(leave, self._theta[1], -1)
        # Of each joint's radius: how the spiral's length changes, and its heading, per metre.
        squares = [1 + theta.over * theta.over for theta in self._theta]
        self._stretch = [square.sqrt() for square in squares]
        self._turning = [(1 + 1 / square) / self._k for square in squares]
        self._lines = family == "arc-line-arc"
        self.radii = (box.number(2), box.number(3)) if self._lines else self._two_radii()
        self._centres = self._centred()
        self._set_pieces()
        self._set_way(arb(disc) / self._k)

    def _two_radii(self) -> tuple[Form, Form]:
        """Radii of two arcs that touch, of which the ratio's logarithm is known."""
        ratio, bridge = self.box.number(2).exponential(), self._heading[1] - self._heading[0]
        (sine, cosine), (s, c) = self._heading[0].sine_cosine(), bridge.sine_cosine()
        dx, dy = (b - a for a, b in zip(*self._ends, strict=True))
        x, y = cosine * dx + sine * dy, cosine * dy - sine * dx
        square = x.square() + y.square()
        half = y * (ratio + c) - x * s
        within = half.square() + ratio * (-c + 1) * square * 2
        if not (within.over > 0 and within.root().over - half.over > 0):
            raise UnboundedError("two arcs may not join the spirals")
        second = square * (within.root() - half).inverse()
        return ratio * second, second

    def _centred(self) -> tuple[tuple[Form, Form], tuple[Form, Form]]:
        (ax, ay), (bx, by) = self._ends
        (s, c), (t, d) = (heading.sine_cosine() for heading in self._heading)
        one, two = self.radii
        return (ax + one * s, ay - one * c), (bx - two * t, by + two * d)

    def _set_pieces(self) -> None:
        """Direction of the line, length of the pieces, and the slopes of all this."""
        (x, y), reach = (b - a for a, b in zip(*self._centres, strict=True)), sum_of(self.radii)
        far = x.square() + y.square()
        room = far - reach.square()
        if self._lines and room.over < 0:
            raise NoTurnError
        self.sure = not self._lines or bool(room.over > 0)
        line = room.root() if self._lines else self.box.constant(0)
        way = angle_of(x, y) - (angle_of(line, reach) if self._lines else PI / 2)
        self._slopes, self._short = None, ZERO
        for _pass in range(PASSES):
            swept, sure = zip(*(_swept(heading - way) for heading in self._heading), strict=True)
            if not all(sure):
                self.sure = False
                break
            self._slopes = _Slopes(self, [one.over for one in swept])
            if not self._lines:
                first, last = self._slopes.radii()
                self.radii = self.radii[0].with_slopes(first), self.radii[1].with_slopes(last)
                self._centres = self._centred()
            if self.sure:
                way = way.with_slopes(self._slopes.way(line.over, reach.over))
                line = line.with_slopes(self._slopes.line(line.over, reach.over))
        first, last = (radius * angle for radius, angle in zip(self.radii, swept, strict=True))
        self.length = first + line + last
        if self._slopes is not None:
            if not self.sure:
                away = far.over.nonnegative_part().sqrt()
                self._short = ((reach.over - away) / away).nonnegative_part().union(ZERO)
            self.length = self.length.with_slopes(self._slopes.length(self._short, inside=False))
        self._way, self._pieces = way, (first, line, last)

    def _set_way(self, edge: arb) -> None:
        """The whole way inside the disc, and what routes are made of."""
        self._far = [_length_to(self._k, theta) for theta in self._theta]
        self.way = self.length - self._far[0] - self._far[1] + 2 * spiral_length(self._k, edge)
        if self._slopes is not None:
            self.way = self.way.with_slopes(self._slopes.length(self._short, inside=True))
        first, _line, last = self._pieces
        nothing, whole = self.box.constant(0), self.length
        if self._backwards:
            self.joints = -whole, first - whole, -last, nothing
        else:
            self.joints = nothing, first, whole - last, whole
        sine, cosine = self._way.sine_cosine()
        self._along = cosine, sine
        (ax, ay), (bx, by) = self._centres
        one, two = self.radii
        starts = (ax - one * sine, ay + one * cosine), (bx + two * sine, by - two * cosine)
        self._start = starts[int(self._backwards)]
        self._bends = one.inverse(), two.inverse()

    def pose(self, s: Form) -> Pose:
        """The place at a route position, m."""
        beyond = [s - joint for joint in self.joints]
        poses, middles = [], []
        for j in range(OUT + 1):
            if j == LINE and not self._lines:
                continue
            before = None if j == 0 else beyond[j - 1]
            after = None if j == OUT else beyond[j]
            if (before and before.over < 0) or (after and after.over > 0):
                continue
            poses.append(self._on(j, s))
            if not ((before and before.middle < 0) or (after and after.middle > 0)):
                middles.append(poses[-1])
        if len(poses) == 1:
            return poses[0]
        columns = zip(*poses, strict=True), zip(*middles, strict=True)
        return Pose(
            *(
                either(forms, [form.middle for form in inside])
                for forms, inside in zip(*columns, strict=True)
            )
        )

    def _on(self, j: int, s: Form) -> Pose:
        """The place on piece j, or where that would go on."""
        if j in (0, OUT):
            return self._on_spiral(j, s)
        if j == LINE:
            off = s - self.joints[1 + int(self._backwards)]
            (x, y), (along, across) = self._start, self._along
            return Pose(x + off * along, y + off * across, along, across)
        arc, side = (0, -1) if j == FIRST_ARC else (1, 1)
        outer = arc == int(self._backwards)
        joint, heading = (arc * 3, self._heading[arc]) if outer else (arc + 1, self._way)
        turned = (s - self.joints[joint]) * self._bends[arc] * side
        sine, cosine = (heading + turned).sine_cosine()
        (x, y), radius = self._centres[arc], self.radii[arc] * side
        return Pose(x + radius * sine, y - radius * cosine, cosine, sine)

    def _on_spiral(self, j: int, s: Form) -> Pose:
        end, side = (0, 1) if j == 0 else (1, -1)
        theta = spiral_angle(self._k, self._far[end] - (s - self.joints[3 * end]) * side)
        sine, cosine = theta.sine_cosine()
        scale = (theta.square() + 1).root().inverse() * -1
        radius = theta * (self._k * side)
        along, across = (cosine - theta * sine) * scale, (sine + theta * cosine) * scale
        return Pose(radius * cosine, radius * sine, along, across)


class Direct:
    """Turns of a box as if they went straight from joint to joint: none is shorter.

    Args:
        pitch: of both spirals, m.
        disc: radius of the turning space, m.
        box: ranges of the joints' radii, m, and others.

    Attributes:
        length: of the turn, m.
        way: the whole path inside the disc, m.
    """

    def __init__(self, pitch: float, disc: float, box: Box) -> None:
        k = arb(pitch) / (2 * PI)
        radii = box.number(0), box.number(1)
        angles = [radius * (1 / k) for radius in radii]
        (ax, ay), (bx, by) = (_polar(*joint, 1) for joint in zip(radii, angles, strict=True))
        self.length = ((ax + bx).square() + (ay + by).square()).root()
        spirals = sum_of([_length_to(k, angle) for angle in angles])
        self.way = self.length - spirals + 2 * spiral_length(k, arb(disc) / k)


class _Slopes:
    """Slopes of a turn by the numbers of its box, from what its arcs sweep, rad."""

    def __init__(self, shape: TurnShape, swept: Sequence[arb]) -> None:
        self._swept, self._shape = swept, shape
        self._sine = [angle.sin() for angle in swept]
        self._cosine = [angle.cos() for angle in swept]
        self._versine = [2 * (angle / 2).sin() ** 2 for angle in swept]
        self._radii = [radius.over for radius in shape.radii]
        # How fast a centre moves along the joint's tangent with the joint's radius.
        self._moves = [
            stretch - radius * turning
            for stretch, radius, turning in zip(
                shape._stretch, self._radii, shape._turning, strict=True
            )
        ]

    def radii(self) -> list[list[arb]]:
        """Of the radii."""
        return [self._totals([ZERO, ZERO, arb(1 - n), arb(n)]) for n in (0, 1)]

    def way(self, line: arb, reach: arb) -> list[arb]:
        """Of the direction between the arcs."""
        if not self._shape._lines:
            return [-own / reach for own in self._drawn()]
        return [
            *(sine * move / line for sine, move in zip(self._sine, self._moves, strict=True)),
            *(-versine / line for versine in self._versine),
        ]

    def line(self, line: arb, reach: arb) -> list[arb]:
        """Of the length of the line; of none if there is none."""
        if not self._shape._lines:
            return [ZERO] * self._shape.box.count
        return [a + reach * b for a, b in zip(self._drawn(), self.way(line, reach), strict=True)]

    def length(self, short: arb, *, inside: bool) -> list[arb]:
        """Of the turn's length, or of the whole path inside the disc.

        `short` is by what share the centres may be too near for a line: there the length is continued
        by two arcs of which one ends where the other begins.
        """
        joints = [
            short * cosine * move - versine * move
            if inside
            else radius * turning + (1 + short) * cosine * move
            for radius, turning, cosine, versine, move in zip(
                self._radii, self._shape._turning, self._cosine, self._versine, self._moves, strict=True
            )
        ]
        sines = zip(self._swept, self._sine, strict=True)
        return self._totals([*joints, *(angle - (1 + short) * sine for angle, sine in sines)])

    def _drawn(self) -> list[arb]:
        """Of the vector from centre to centre, along the line."""
        joints = [c * move for c, move in zip(self._cosine, self._moves, strict=True)]
        return self._totals([*joints, *(-sine for sine in self._sine)])

    def _totals(self, slopes: list[arb]) -> list[arb]:
        """Slopes by joints and radii; of two arcs by joints and ratio, for that decides both radii."""
        if self._shape._lines:
            return slopes
        *joints, first, last = slopes
        one, two = self._radii
        ratio = one / two
        whole = self._versine[0] * ratio + self._versine[1]
        second = [s * move / whole for s, move in zip(self._sine, self._moves, strict=True)]
        found = [own + (first * ratio + last) * by for own, by in zip(joints, second, strict=True)]
        return [*found, one * (first * self._versine[1] - last * self._versine[0]) / whole]


def _polar(radius: Form, angle: Form, side: int) -> tuple[Form, Form]:
    sine, cosine = angle.sine_cosine()
    return radius * cosine * side, radius * sine * side


def sum_of(forms: Sequence[Form]) -> Form:
    """Their sum."""
    whole = forms[0]
    for form in forms[1:]:
        whole = whole + form
    return whole
