"""A route in ball arithmetic: points, tangents and lengths that enclose the exact ones.

Each row begins where the one before it ends, exactly: what rounding left between them is taken out
by moving the later row. So a route is given by its first pose, and by each row's kind, curvature and
extent.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

from flint import acb, arb, arb_poly, ctx

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow
from benchdragon.proofs import BITS

# Clothoids that turn by more, rad, are integrated: in their series large terms would cancel.
SERIES_TURN = 6.0
# Headings that jump by more at a joint, rad, are kinks; by less, they are rounding, and are joined.
KINK = 1e-9
ctx.prec = BITS

Pair = tuple[arb, arb]
# The kinds of curves that `Row` encloses.
ENCLOSED = (CurveKind.LINE, CurveKind.ARC, CurveKind.CLOTHOID, CurveKind.SPIRAL, CurveKind.LOG_SPIRAL)


@dataclass(frozen=True)
class Row:
    """One piece of a route, its numbers as balls: see kernels/curve.py for what they are.

    Attributes:
        way: +1 where u grows in the walking direction, else -1.
        s: route position of its start, m.
        turned: what the heading has turned through from the route's start to here, either way, rad.
        back: how far u may go back behind the start; infinite on an extension.
        kink: whether the heading jumps at its start.
    """

    kind: float
    x: arb
    y: arb
    angle: arb
    p: arb
    q: arb
    start: arb
    end: arb
    way: int
    back: float
    s: arb
    turned: float
    kink: bool = False

    def length(self, u: arb) -> arb:
        """Arc length from u = 0 to u, m."""
        if self.kind != CurveKind.SPIRAL:
            return u
        root = (1 + u * u).sqrt()
        return self.p * (u * root + u.asinh()) / 2

    def position(self, u: arb) -> arb:
        """Route position of parameter u, m."""
        return self.s + self.way * (self.length(u) - self._before)

    @cached_property
    def _before(self) -> arb:
        return self.length(self.start)

    def stretch(self, u: arb) -> arb:
        """Metres per unit of the parameter."""
        return self.p * (1 + u * u).sqrt() if self.kind == CurveKind.SPIRAL else arb(1)

    def pose(self, u: arb) -> tuple[arb, arb, arb, arb]:
        """Point (x, y), m, and unit tangent in the walking direction at parameter u."""
        if self.kind == CurveKind.SPIRAL:
            sine, cosine = (self.angle + self.q * u).sin_cos()
            radius, turn = self.p * u, self.q * u
            scale = self.way / (1 + u * u).sqrt()
            tangent = scale * (cosine - turn * sine), scale * (sine + turn * cosine)
            return self.x + radius * cosine, self.y + radius * sine, *tangent
        sine, cosine = (self.angle + self._turn(u)).sin_cos()
        dx, dy = self._chord(u, cosine, sine)
        return self.x + dx, self.y + dy, cosine, sine

    def heading(self, u: arb) -> arb:
        """Heading in the walking direction at parameter u, rad, continuous along the row."""
        if self.kind == CurveKind.SPIRAL:
            return self.angle + self.q * (u + u.atan()) + (0 if self.way > 0 else arb.pi())
        return self.angle + self._turn(u)

    def _turn(self, u: arb) -> arb:
        """What the heading has turned through at arc length u, rad."""
        if self.kind == CurveKind.LOG_SPIRAL and self.q != 0:
            return self.p / self.q * (1 + self.q * u).log()
        return u * (self.p + self.q * u / 2) if self.kind != CurveKind.LINE else arb(0)

    def _chord(self, u: arb, cosine: arb, sine: arb) -> Pair:
        """From the start to arc length u, where the heading's cosine and sine are such, m."""
        start_sine, start_cosine = self.angle.sin_cos()
        if self.kind == CurveKind.LINE:
            return u * start_cosine, u * start_sine
        if self.kind == CurveKind.ARC:
            return (sine - start_sine) / self.p, (start_cosine - cosine) / self.p
        if self.kind == CurveKind.LOG_SPIRAL:
            grown = 1 + self.q * u
            whole = acb(grown * cosine - start_cosine, grown * sine - start_sine) / acb(self.q, self.p)
            return whole.real, whole.imag
        return self._integral(u)

    def _integral(self, u: arb) -> Pair:
        middle = u.mid()
        off = arb(0, (u - middle).abs_upper())  # no point is farther away than the way to it
        if abs(middle) <= abs(self.end) and self._most_turn <= SERIES_TURN:
            along, across, rest = self._series
            sine, cosine = self.angle.sin_cos()
            x, y = along(middle) + rest, across(middle) + rest
            return cosine * x - sine * y + off, sine * x + cosine * y + off

        def tangent(s: acb, _analytic: bool) -> acb:
            phase = acb(self.angle) + s * (acb(self.p) + acb(self.q) * s / 2)
            return (acb(0, 1) * phase).exp()

        # e^(i phase) is entire, but its real part on the axis is needed: take both parts.
        whole = acb.integral(tangent, acb(0), acb(middle))
        return whole.real + off, whole.imag + off

    @cached_property
    def _most_turn(self) -> float:
        """At least what the heading turns through to the row's end, rad, were all bends to one side."""
        return float((abs(self.p * self.end) + abs(self.q * self.end * self.end) / 2).upper())

    @cached_property
    def _series(self) -> tuple[arb_poly, arb_poly, arb]:
        """Series of the chord (x, y) in u, were the heading 0 at the start, and what they leave out, m.

        E = e^(i (p u + q u^2 / 2)) has the derivative i (p + q u) E, which gives one coefficient after
        another. They are no larger than those of M(u) = e^(|p| u + |q| u^2 / 2): M(4 end) / (4 end)^n.
        """
        end = arb(abs(self.end).upper())
        grown = 4 * abs(self.p) * end + 8 * abs(self.q) * end * end
        count = int((float(grown.upper()) / math.log(2.0) + BITS) / 2) + 8
        cosines, sines = [arb(1), arb(0)], [arb(0), arb(self.p)]
        for n in range(1, count):
            c = -(self.p * sines[n] + self.q * sines[n - 1]) / (n + 1)
            s = (self.p * cosines[n] + self.q * cosines[n - 1]) / (n + 1)
            cosines.append(c)
            sines.append(s)
        x, y = (
            arb_poly([arb(0), *(c / (n + 1) for n, c in enumerate(one))]) for one in (cosines, sines)
        )
        return x, y, arb(0, (end * grown.exp() / (3 * arb(4) ** count)).upper())

    def bend(self, u: arb) -> arb:
        """Curvature at parameter u, 1/m, left positive."""
        if self.kind == CurveKind.SPIRAL:
            square = u * u
            return self.way * self.q * (2 + square) / (self.p * (1 + square) * (1 + square).sqrt())
        if self.kind == CurveKind.LOG_SPIRAL:
            return self.p / (1 + self.q * u)
        return self.p + self.q * u if self.kind != CurveKind.LINE else arb(0)

    def turning(self, u: float) -> float:
        """What the heading turns through from the row's start to u, either way, rad, to rounding."""
        p, q, start = float(self.p), float(self.q), float(self.start)
        if self.kind == CurveKind.SPIRAL:
            return abs(u + math.atan(u) - start - math.atan(start))
        if self.kind == CurveKind.LINE:
            return 0.0
        if self.kind == CurveKind.ARC or q == 0.0:
            return abs(p * (u - start))
        if self.kind == CurveKind.LOG_SPIRAL:
            return abs(p / q * math.log((1.0 + q * u) / (1.0 + q * start)))
        changes = -p / q  # where a clothoid's curvature changes its sign
        inside = [changes] if min(start, u) < changes < max(start, u) else []
        at = [v * (p + 0.5 * q * v) for v in (start, *inside, u)]
        return sum(abs(b - a) for a, b in pairwise(at))


class BallRoute:
    """Rows joined end to end.

    Args:
        rows: the pieces in walking order; all but the first are moved to where the one before ends.

    Attributes:
        rows: the pieces, joined.
        length: m.
    """

    def __init__(self, rows: Sequence[Row]) -> None:
        self.rows = [rows[0]]
        for row in rows[1:]:
            self.rows.append(_joined(self.rows[-1], row))
        last = self.rows[-1]
        self.length = last.position(last.end)

    @classmethod
    def stored(cls, rows: FloatArray) -> "BallRoute":
        """The route of stored rows, whose numbers are taken for exact.

        Raises:
            InputError: for a kind of curve that is not enclosed here.
        """
        strange = [kind for kind in rows[:, RouteRow.KIND].tolist() if kind not in ENCLOSED]
        if strange:
            text = _("a route with a curve of kind {kind} cannot be proved")
            raise InputError(text.format(kind=strange[0]))
        return cls([stored_row(rows, j) for j in range(len(rows))])


def stored_row(rows: FloatArray, j: int) -> Row:
    """Row number j of stored ones, whose numbers are taken for exact; not yet joined to others."""
    row = rows[j].tolist()
    x, y, angle, p, q, start, end, s = (
        arb(row[column])
        for column in (
            RouteRow.X, RouteRow.Y, RouteRow.ANGLE, RouteRow.P, RouteRow.Q, RouteRow.U_START,
            RouteRow.U_END,
            RouteRow.S_START,
        )
    )  # fmt: skip
    way, back = int(kernel.walks_up(rows, j)), row[RouteRow.U_BACK]
    return Row(row[RouteRow.KIND], x, y, angle, p, q, start, end, way, back, s, 0.0)


def _joined(before: Row, row: Row) -> Row:
    """A row moved to where the one before it ends; turned too, unless there is a kink."""
    x, y, tx, ty = before.pose(before.end)
    _x, _y, own_x, own_y = row.pose(row.start)
    off = arb.atan2(own_x * ty - own_y * tx, own_x * tx + own_y * ty)
    jump = float(off.abs_upper())
    turned = before.turned + before.turning(float(before.end))
    if jump <= KINK:
        row, jump = replace(row, angle=row.angle + off), 0.0
    own_x, own_y, *_tangent = row.pose(row.start)
    s = before.position(before.end)
    return replace(
        row,
        x=row.x + x - own_x,
        y=row.y + y - own_y,
        s=s,
        turned=turned + jump * (1.0 + KINK),
        kink=jump > 0.0,
    )
