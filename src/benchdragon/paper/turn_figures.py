"""Pictures of turns: the paper's Fig 3, turns side by side, length against greatest head speed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from benchdragon.figures.style import BODY, DISC, HEAD, ROUTE, STYLE, drawable, named_figure
from benchdragon.i18n import _
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Spiral
from benchdragon.model.turns import Turn

# Okabe and Ito's purple, for clothoids.
EASE = "#CC79A7"
# Spirals are drawn to this many times the disc's radius; m between points of curves.
FRAME, POINT_STEP = 1.35, 0.02


@dataclass(frozen=True)
class ShownTurn:
    """A turn for a picture, and the greatest head speed it allows, m/s, if that is known."""

    name: str
    turn: Turn
    head_speed: float | None = None


def turns_picture(shown: Sequence[ShownTurn], disc: float, title: str = "") -> Figure:
    """Turns side by side and to one scale: disc, spirals, pieces, centres, radii, angles.

    Args:
        shown: one panel each.
        disc: radius of the turning space, m.
        title: above all.
    """
    with matplotlib.rc_context(STYLE):
        figure = named_figure(7.0 * len(shown), 8.0, title)
        panels = figure.subplots(1, len(shown), squeeze=False)[0]
        for panel, one in zip(panels, shown, strict=True):
            _draw_turn(panel, one.turn, disc)
            text = _("turn {length} m, path inside the disc {way} m").format(
                length=f"{one.turn.length:.4f}", way=f"{one.turn.way(disc):.4f}"
            )
            if one.head_speed is not None:
                text += "\n" + _("greatest head speed {speed} m/s").format(
                    speed=f"{one.head_speed:.4f}"
                )
            panel.set_title(f"{drawable(one.name)}\n{text}")
        return figure


def _draw_turn(panel: Axes, turn: Turn, disc: float) -> None:
    panel.add_patch(Circle((0.0, 0.0), disc, fill=False, ec=DISC, lw=1.4, ls="--", label=_("disc")))
    far = FRAME * disc
    spirals = (
        (Spiral.between(turn.pitch, far + turn.pitch, turn.entry_radius), "-", _("way in")),
        (
            Spiral.between(turn.pitch, turn.exit_radius, far + turn.pitch, rotation=math.pi),
            ":",
            _("way out"),
        ),
    )
    for spiral, style, name in spirals:
        panel.plot(*_points(spiral), color=ROUTE, lw=1.2, ls=style, label=name)
    said: set[str] = set()
    for curve in turn.curves:
        name, colour = _kind(curve)
        panel.plot(*_points(curve), color=colour, lw=2.4, label=None if name in said else name)
        said.add(name)
        panel.plot(*curve.start_pose[0], "o", color="black", ms=4, zorder=5)
        if isinstance(curve, Arc):
            _draw_arc(panel, curve)
    panel.plot(*turn.curves[-1].end_pose[0], "o", color="black", ms=4, zorder=5)
    panel.set(xlim=(-far, far), ylim=(-far, far), xlabel=_("x (m)"), ylabel=_("y (m)"))
    panel.set_aspect("equal")
    panel.legend(loc="upper right", fontsize="small", framealpha=0.9)


def _kind(curve: AnyCurve) -> tuple[str, str]:
    if isinstance(curve, Arc):
        return (_("arc to the right"), HEAD) if curve.sweep < 0.0 else (_("arc to the left"), BODY)
    return (_("clothoid"), EASE) if isinstance(curve, Clothoid) else (_("line"), "black")


def _points(curve: AnyCurve) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    s = np.linspace(0.0, curve.length, max(3, math.ceil(curve.length / POINT_STEP)))
    return curve.point(s).T


def _draw_arc(panel: Axes, arc: Arc) -> None:
    """The arc's centre, a radius to each end, its size and what it turns by."""
    cx, cy = arc.centre
    for x, y in (arc.start_pose[0], arc.end_pose[0]):
        panel.plot([cx, x], [cy, y], color="black", lw=0.7, ls="-.")
    panel.plot(cx, cy, "+", color="black", ms=9, mew=1.4)
    text = _("r = {radius} m\n{angle}°").format(
        radius=f"{arc.radius:.4f}", angle=f"{math.degrees(abs(arc.sweep)):.2f}"
    )
    left = arc.sweep > 0.0  # away from the arc's own side
    panel.annotate(
        text, (cx, cy), xytext=(-6 if left else 6, 6), textcoords="offset points", fontsize="small",
        ha="right" if left else "left",
        bbox={"fc": "white", "ec": "none", "alpha": 0.75, "pad": 1.0},
    )  # fmt: skip


def front_picture(
    front: Sequence[tuple[float, float, float]], paper: tuple[float, float], title: str = ""
) -> Figure:
    """Length against greatest head speed.

    Args:
        front: (greatest head speed, m/s; way inside the disc, m; the turn's own length, m) of each.
        paper: greatest head speed, m/s, and length, m, of the paper's turn.
        title: above all.
    """
    speeds, ways, lengths = np.array(front).T
    with matplotlib.rc_context(STYLE):
        figure = named_figure(8.0, 5.6, title)
        panel = figure.subplots()
        panel.plot(speeds, ways, "o-", color=HEAD, label=_("path inside the disc"))
        panel.plot(speeds, lengths, "s--", color=BODY, mfc="none", label=_("the turn itself"))
        panel.plot(*paper, "*", color="black", ms=14, label=_("the paper's two arcs"))
        panel.set_xlabel(_("greatest head speed (m/s)"))
        panel.set_ylabel(_("length (m)"))
        panel.set_title(_("Shortest turns that were found"))
        panel.legend(framealpha=0.9)
        return figure
