"""Pictures of the geometry behind the formulas: polar angles, the link triangle, separating axes."""

import cmath
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc as Curved
from matplotlib.patches import Polygon

from benchdragon.figures.style import BODY, DISC, HEAD, PAGE_WIDTH, ROUTE, drawn_panel
from benchdragon.figures.walk import name_below, route_points
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.turns import TwoArcTurn
from benchdragon.model.walk import Motion, Walk

# Letters in pictures, points of type.
LETTER = 10.0


def label(panel: Axes, name: str, at: complex, offset: tuple[float, float]) -> None:
    """A letter so many points of type beside a place."""
    panel.annotate(
        name, (at.real, at.imag), xytext=offset, textcoords="offset points", ha="center", va="center",
        fontsize=LETTER, zorder=7,
    )  # fmt: skip


def mark_angle(
    panel: Axes, at: complex, ways: tuple[complex, complex], radius: float, name: str
) -> None:
    """An arc from one direction to another, to the left, with its name outside."""
    low, high = (math.degrees(cmath.phase(way)) for way in ways)
    size = 2.0 * radius
    panel.add_patch(Curved((at.real, at.imag), size, size, theta1=low, theta2=high, lw=0.9))
    middle = cmath.rect(1.0, math.radians(low + 0.5 * ((high - low) % 360.0)))
    far = 9.0 + 1.2 * max(len(name) - 8, 0)
    label(panel, name, at + radius * middle, (far * middle.real, far * middle.imag))


def _line(panel: Axes, places: Sequence[complex], colour: str = "black", **style: Any) -> None:
    panel.plot([at.real for at in places], [at.imag for at in places], color=colour, **style)


def _arrow(panel: Axes, at: complex, way: complex, colour: str) -> None:
    tip = at + way
    panel.annotate(
        "", (tip.real, tip.imag), (at.real, at.imag),
        arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.4, "shrinkA": 0, "shrinkB": 0},
        zorder=6,
    )  # fmt: skip


def polar_picture(motion: Motion) -> Figure:
    """Two handles on the spiral: their polar angles and radii, the link, the tangents of their speeds.

    Args:
        motion: its first time is drawn.
    """
    front, rear = (complex(motion.x[0, i], motion.y[0, i]) for i in (0, 1))
    heading = motion.walk.route.heading(motion.s[0, :2])
    with drawn_panel(0.55 * PAGE_WIDTH, 3.6) as (figure, panel):
        s = motion.s[0]
        around = route_points(motion.walk.route, float(s[0]) - 30.0, float(s[0]) + 25.0)
        panel.plot(*around.T, color=ROUTE, lw=0.8)
        for at, i, side in ((front, 0, (11, 5)), (rear, 1, (5, 8))):
            _line(panel, (0j, at), lw=0.8)
            label(panel, rf"$r_{i}=k\theta_{i}$", 0.62 * at, (20, -9) if i == 0 else (-26, 2))
            label(panel, f"$P_{i}$", at, side)
            _arrow(panel, at, cmath.rect(0.9, float(heading[i])), HEAD)
            label(panel, f"$t_{i}$", at + cmath.rect(0.9, float(heading[i])), (9, -3))
        _line(panel, (front, rear), BODY, lw=3.0, alpha=0.8)
        label(panel, "$L_1$", 0.5 * (front + rear), (-10, -6))
        along = (front - rear) / abs(front - rear)
        _arrow(panel, rear, 1.1 * along, DISC)
        label(panel, "$u_1$", rear + 1.1 * along, (-11, 3))
        ends = sorted((front, rear), key=cmath.phase)
        mark_angle(panel, 0j, (ends[0], ends[1]), 1.6, r"$\theta_1-\theta_0$")
        for name, at in (("$O$", 0j), ("", front), ("", rear)):
            _line(panel, (at,), marker="o", ms=3.5, zorder=6)
            label(panel, name, at, (-8, -6))
        _frame(panel, [0j, front, rear], 1.3)
        return figure


def triangle_picture(walk: Walk, turn: TwoArcTurn) -> Figure:
    """The triangle of equation (6): a centre, the handle before it on the other arc, and the next.

    Args:
        walk: through the turn.
        turn: of two arcs.
    """
    first, second = turn.arcs()
    link = float(walk.dragon.links[0])
    # The front handle half a link into the second arc, as `claims` has it.
    head = walk.time_at(walk.start + turn.radii[0] * turn.sweep + 0.5 * link)
    motion = walk.motion([head])
    front, rear = (complex(motion.x[0, i], motion.y[0, i]) for i in (0, 1))
    centre = complex(*first.centre)
    with drawn_panel(0.55 * PAGE_WIDTH, 3.5) as (figure, panel):
        for arc, colour, name in ((first, HEAD, "$C_1$"), (second, BODY, "$C_2$")):
            points = arc.point(np.linspace(0.0, arc.length, 200))
            panel.plot(*points.T, color=colour, lw=1.6, label=name)
        _line(panel, (centre, front), lw=1.0)
        _line(panel, (centre, rear), lw=1.0)
        _line(panel, (front, rear), DISC, lw=2.2)
        label(panel, "$d_1$", 0.5 * (centre + front), (7, -7))
        label(panel, "$r_1$", 0.5 * (centre + rear), (-9, -5))
        label(panel, "$L_1$", 0.7 * front + 0.3 * rear, (4, 9))
        mark_angle(panel, centre, (front - centre, rear - centre), 0.55, r"$\theta$")
        joint = complex(*first.end_pose[0])
        for name, at, side in (
            ("$O_1$", centre, (-12, -2)), ("$P_0$", front, (10, -9)), ("$P_1$", rear, (0, 10)),
            ("$C$", joint, (-3, -10)),
        ):  # fmt: skip
            _line(panel, (at,), marker="o", ms=3.5, zorder=6)
            label(panel, name, at, side)
        _frame(panel, [centre, front, rear, joint], 0.9)
        return figure


def _frame(panel: Axes, places: Sequence[complex], room: float) -> None:
    """Show the places and so many metres around, to scale, without a grid."""
    x, y = [at.real for at in places], [at.imag for at in places]
    panel.set(xlim=(min(x) - room, max(x) + room), ylim=(min(y) - room, max(y) + room))
    panel.set(aspect="equal", xlabel=_("x (m)"), ylabel=_("y (m)"))
    panel.grid(False)


def axes_picture(motion: Motion, pair: Sequence[int]) -> Figure:
    """Two benches, the four axes of the separating axis theorem, and the projections that decide.

    Args:
        motion: its first time is drawn.
        pair: numbers of the benches, from 1; the picture is turned so that the second lies level.
    """
    turned = cmath.exp(-1j * float(motion.heading[0, pair[1] - 1]))
    corners = motion[0].corners()[0]
    shapes = [turned * (corners[n - 1] @ np.array([1.0, 1.0j])) for n in pair]
    middle = shapes[1].mean()
    shapes = [shape - middle for shape in shapes]
    with drawn_panel(0.6 * PAGE_WIDTH, 3.6) as (figure, panel):
        left = min(float(shape.real.min()) for shape in shapes) - 0.35
        for shape, number, colour in zip(shapes, pair, (HEAD, BODY), strict=True):
            xy = np.column_stack([shape.real, shape.imag])
            name = _("bench {number}").format(number=number)
            panel.add_patch(Polygon(xy, fc=colour, ec="black", lw=0.8, alpha=0.6, label=name))
            _draw_normals(panel, shape)
            low, high = float(shape.imag.min()), float(shape.imag.max())
            panel.plot([left, left], [low, high], color=colour, lw=5.0, solid_capstyle="butt")
            for corner in (shape[shape.imag.argmin()], shape[shape.imag.argmax()]):
                _line(panel, (complex(left, corner.imag), corner), lw=0.5, ls=":")
        _draw_gap(panel, shapes, left)
        panel.set(xlabel=_("along bench {number} (m)").format(number=pair[1]))
        panel.set(ylabel=_("along the axis (m)"))
        panel.set_aspect("equal")
        panel.grid(False)
        panel.margins(0.12)
        name_below(figure, panel)
        return figure


def _draw_normals(panel: Axes, shape: FloatArray) -> None:
    """The two axes of one bench, at its centre."""
    middle = complex(shape.mean())
    for side in (shape[0] - shape[1], shape[0] - shape[3]):
        _arrow(panel, middle, 0.42 * complex(side / abs(side)), "black")


def _draw_gap(panel: Axes, shapes: Sequence[FloatArray], left: float) -> None:
    """The signed gap on the axis that decides: between the two projections."""
    upper, lower = sorted(shapes, key=lambda shape: -float(shape.imag.mean()))
    low, high = float(lower.imag.max()), float(upper.imag.min())
    panel.annotate(
        "",
        (left - 0.12, low),
        (left - 0.12, high),
        arrowprops={"arrowstyle": "|-|,widthA=0.2,widthB=0.2", "lw": 0.9, "shrinkA": 0, "shrinkB": 0},
    )
    label(panel, "$g$", complex(left - 0.12, 0.5 * (low + high)), (-9, 0))
