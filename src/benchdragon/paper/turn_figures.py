"""Pictures of turns: the paper's Fig 3, turns side by side, lengths, speed ratios."""

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from benchdragon.figures.style import (
    BODY,
    DISC,
    HEAD,
    PAGE_WIDTH,
    ROUTE,
    SERIES,
    drawable,
    drawn_panel,
    drawn_panels,
)
from benchdragon.figures.walk import name_below
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.answer import Answer
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Spiral
from benchdragon.model.turns import Turn, TwoArcTurn
from benchdragon.model.walk import Motion
from benchdragon.paper.geometry_figures import label, mark_angle

# Okabe and Ito's purple, for clothoids.
EASE = "#CC79A7"
# Spirals are drawn to this many times the disc's radius; m between points of curves.
FRAME, POINT_STEP = 1.35, 0.02
# Half of a tangent that is drawn, m.
TANGENT = 2.2
# Handles whose speed ratios are drawn one by one about the greatest; ratios that agree so well are one.
NEAR_HANDLES, SAME = 8, 1e-6
# Speeds while the dragon turns: of these handles, over these times, s; and of all at this time, s.
TIMED_HANDLES, TIMED, ALONG = (0, 1, 8, 223), (-5.0, 35.0), 50.0


@dataclass(frozen=True)
class ShownTurn:
    """A turn for a picture, and the greatest head speed it allows, m/s, if that is known."""

    name: str
    turn: Turn
    head_speed: float | None = None


def turns_picture(shown: Sequence[ShownTurn], disc: float) -> Figure:
    """Turns side by side and to one scale: disc, spirals, pieces, centres, radii, angles.

    Args:
        shown: one panel each.
        disc: radius of the turning space, m.
    """
    count, high = len(shown), PAGE_WIDTH / len(shown) + 1.15
    with drawn_panels(PAGE_WIDTH, high, "", 1, count, sharey=True) as (figure, panels):
        for panel, one in zip(panels, shown, strict=True):
            _draw_ground(panel, one.turn.pitch, (one.turn.entry_radius, one.turn.exit_radius), disc)
            _draw_pieces(panel, one.turn)
            texts = [
                drawable(one.name),
                _("turn {length} m").format(length=f"{one.turn.length:.4f}"),
                _("path inside the disc {way} m").format(way=f"{one.turn.way(disc):.4f}"),
            ]
            if one.head_speed is not None:
                texts.append(_("greatest head speed {speed} m/s").format(speed=f"{one.head_speed:.4f}"))
            panel.set_title("\n".join(texts), fontsize=8, linespacing=1.3)
        panels[0].set_ylabel(_("y (m)"))
        name_below(figure, panels[-1])
        return figure


def _draw_ground(panel: Axes, pitch: float, joints: tuple[float, float], disc: float) -> None:
    """The disc, and the spirals that a turn between two radii joins."""
    panel.add_patch(Circle((0.0, 0.0), disc, fill=False, ec=DISC, lw=1.2, ls="--", label=_("disc")))
    far = FRAME * disc
    inward = Spiral.between(pitch, far + pitch, joints[0])
    outward = Spiral.between(pitch, joints[1], far + pitch, rotation=math.pi)
    for spiral, style, name in ((inward, "-", _("way in")), (outward, ":", _("way out"))):
        panel.plot(*_points(spiral), color=ROUTE, lw=1.0, ls=style, label=name)
    panel.set(xlim=(-far, far), ylim=(-far, far), xlabel=_("x (m)"))
    panel.set_aspect("equal")


def _draw_pieces(panel: Axes, turn: Turn) -> None:
    said: set[str] = set()
    for curve in turn.curves:
        name, colour = _kind(curve)
        panel.plot(*_points(curve), color=colour, lw=2.0, label=None if name in said else name)
        said.add(name)
        panel.plot(*curve.start_pose[0], "o", color="black", ms=3, zorder=5)
        if isinstance(curve, Arc):
            _draw_arc(panel, curve)
    panel.plot(*turn.curves[-1].end_pose[0], "o", color="black", ms=3, zorder=5)


def _kind(curve: AnyCurve) -> tuple[str, str]:
    if isinstance(curve, Arc):
        return (_("arc to the right"), HEAD) if curve.sweep < 0.0 else (_("arc to the left"), BODY)
    return (_("clothoid"), EASE) if isinstance(curve, Clothoid) else (_("line"), "black")


def _points(curve: AnyCurve) -> FloatArray:
    s = np.linspace(0.0, curve.length, max(3, math.ceil(curve.length / POINT_STEP)))
    return np.asarray(curve.point(s).T)


def _draw_arc(panel: Axes, arc: Arc) -> None:
    """The arc's centre, a radius to each end, its size and what it turns by."""
    cx, cy = arc.centre
    for x, y in (arc.start_pose[0], arc.end_pose[0]):
        panel.plot([cx, x], [cy, y], color="black", lw=0.6, ls="-.")
    panel.plot(cx, cy, "+", color="black", ms=7, mew=1.2)
    text = _("r = {radius} m\n{angle}°").format(
        radius=f"{arc.radius:.4f}", angle=f"{math.degrees(abs(arc.sweep)):.2f}"
    )
    left = arc.sweep > 0.0  # away from the arc's own side
    panel.annotate(
        text, (cx, cy), xytext=(-4 if left else 4, 5 if left else -5), textcoords="offset points",
        fontsize=7.5, ha="right" if left else "left", va="bottom" if left else "top",
        bbox={"fc": "white", "ec": "none", "alpha": 0.75, "pad": 0.5},
    )  # fmt: skip


def construction_picture(turn: TwoArcTurn) -> Figure:
    """The paper's Fig 3 with its letters: how two arcs join the spirals at A and B.

    Args:
        turn: of two arcs.
    """
    with drawn_panel(0.62 * PAGE_WIDTH, 0.62 * PAGE_WIDTH + 0.3) as (figure, panel):
        _draw_ground(panel, turn.pitch, (turn.entry_radius, turn.entry_radius), turn.entry_radius)
        first, second = turn.arcs()
        for arc, name in ((first, r"$C_1$"), (second, r"$C_2$")):
            _kind_name, colour = _kind(arc)
            panel.plot(*_points(arc), color=colour, lw=2.2)
            x, y = arc.point(0.5 * arc.length).tolist()
            out = np.array([x - arc.centre[0], y - arc.centre[1]])
            panel.annotate(
                name, (x, y), xytext=(13.0 * out / np.hypot(*out)).tolist(), textcoords="offset points",
                color=colour, ha="center", va="center", fontsize=11,
            )  # fmt: skip
        _draw_joint_lines(panel, first, second)
        _draw_angles(panel, first, second)
        _letter_points(panel, first, second)
        panel.set_ylabel(_("y (m)"))
        name_below(figure, panel)
        return figure


def _draw_joint_lines(panel: Axes, first: Arc, second: Arc) -> None:
    """AB through the centre, the radii to A, B and C, and the tangents at A and B."""
    start, end = (complex(*pose[0]) for pose in (first.start_pose, second.end_pose))
    panel.plot([start.real, end.real], [start.imag, end.imag], color="black", lw=0.8)
    for arc, outer, name, place in ((first, start, "$r_1$", (9, -5)), (second, end, "$r_2$", (-9, 5))):
        centre = complex(*arc.centre)
        for x, y in (arc.start_pose[0], arc.end_pose[0]):
            panel.plot([centre.real, x], [centre.imag, y], color="black", lw=0.7, ls="-.")
        label(panel, name, centre + 0.4 * (outer - centre), place)
    tangent = cmath.rect(TANGENT, first.start_pose[1])
    for at, name, side in ((start, "$l_1$", -1.0), (end, "$l_2$", 1.0)):
        ends = at - tangent, at + tangent
        panel.plot([z.real for z in ends], [z.imag for z in ends], color=EASE, lw=1.0)
        label(panel, name, at + side * tangent, (9.0, 4.0))


def _draw_angles(panel: Axes, first: Arc, second: Arc) -> None:
    """The angles alpha and psi at A, and what both arcs turn by."""
    start, heading = complex(*first.start_pose[0]), first.start_pose[1]
    towards, ahead = complex(*first.centre) - start, cmath.rect(1.0, heading)
    mark_angle(panel, start, (-start, ahead), 0.7, r"$\psi$")
    mark_angle(panel, start, (towards, -start), 1.9, "")
    label(panel, r"$\alpha$", start - 1.9 * start / abs(start), (-8, 6))
    for arc, radius in ((first, 0.6), (second, 0.45)):
        centre = complex(*arc.centre)
        ends = [complex(*pose[0]) - centre for pose in (arc.start_pose, arc.end_pose)]
        ways = (ends[0], ends[1]) if arc.sweep > 0.0 else (ends[1], ends[0])
        mark_angle(panel, centre, ways, radius, r"$\varphi$")


def _letter_points(panel: Axes, first: Arc, second: Arc) -> None:
    places = {
        "$A$": (first.start_pose[0], (-9, -8)),
        "$B$": (second.end_pose[0], (9, 8)),
        "$C$": (first.end_pose[0], (-3, 11)),
        "$O$": ((0.0, 0.0), (9, -7)),
        "$O_1$": (first.centre, (12, -6)),
        "$O_2$": (second.centre, (-13, 4)),
    }
    for name, (place, offset) in places.items():
        panel.plot(*place, "o", color="black", ms=3.5, zorder=6)
        label(panel, name, complex(*place), offset)


def front_picture(front: Sequence[tuple[float, float, float]], paper: tuple[float, float]) -> Figure:
    """Length against greatest head speed.

    Args:
        front: (greatest head speed, m/s; path inside the disc, m; the turn's own length, m) of each.
        paper: greatest head speed, m/s, and length, m, of the paper's turn.
    """
    speeds, ways, lengths = np.array(front).T
    with drawn_panel(0.85 * PAGE_WIDTH, 3.4) as (figure, panel):
        panel.plot(speeds, ways, "o-", color=HEAD, ms=4, lw=1.2, label=_("path inside the disc"))
        if not np.allclose(ways, lengths, atol=1e-3):
            panel.plot(speeds, lengths, "s--", color=BODY, mfc="none", label=_("the turn itself"))
        panel.plot(*paper, "*", color="black", ms=11, label=_("the paper's two arcs"))
        panel.set_xlabel(_("greatest head speed (m/s)"))
        panel.set_ylabel(_("length (m)"))
        panel.legend(framealpha=0.9)
        return figure


def turn_speeds_picture(motion: Motion) -> Figure:
    """Speeds of some handles over time, joints of the route marked, and of all handles at some times.

    Args:
        motion: at times that hold TIMED and ALONG, s, on a spiral, a turn of two arcs and a spiral.
    """
    times, speeds = motion.times, np.asarray(motion.speed)
    lowest, highest = (int(find(speeds)) // speeds.shape[1] for find in (np.argmin, np.argmax))
    with drawn_panels(PAGE_WIDTH, 3.8, "", 2, 1) as (figure, (over, along)):
        for (colour, _mark, dashes), handle in zip(SERIES, TIMED_HANDLES, strict=False):
            name = _("handle {number}").format(number=handle)
            over.plot(times, speeds[:, handle], color=colour, ls=dashes, lw=1.2, label=name)
        top = over.get_xaxis_transform()
        for s, letter in zip(motion.walk.route.joints[1:-1], "ACB", strict=True):
            passed = float(s) - motion.walk.start
            over.axvline(passed, color=ROUTE, lw=0.8)
            over.text(passed, 1.02, f"${letter}$", transform=top, ha="center")
        over.set(xlim=TIMED, xlabel=_("time (s)"))
        for (colour, _mark, dashes), at in zip(
            SERIES, (lowest, highest, int(np.argmin(np.abs(times - ALONG)))), strict=False
        ):
            name = _("t = {t} s").format(t=f"{times[at]:.2f}")
            along.plot(speeds[at], color=colour, ls=dashes, lw=1.2, label=name)
        along.set(xlim=(0, speeds.shape[1] - 1), xlabel=_("handle (0: the head's front)"))
        for panel in (over, along):
            panel.set_ylabel(_("speed (m/s)"))
            panel.margins(y=0.2)
            panel.legend(loc="upper right", ncols=4)
        return figure


def ratio_picture(whole: Motion, close: Motion, speed: Answer, limit: float) -> Figure:
    """The greatest speed ratio over time with its greatest value, and the moment of that enlarged.

    Args:
        whole: the walk.
        close: the same about the moment.
        speed: the greatest head speed, m/s, that the ratio allows, with its witness.
        limit: of every handle's speed, m/s.
    """
    if speed.witness is None:
        raise ValueError("an answer without a witness has no moment")
    peak, time = limit / speed.value, speed.witness.s - whole.walk.start
    with drawn_panels(PAGE_WIDTH, 3.3, "", 1, 2, width_ratios=(1.25, 1.0)) as (figure, (wide, narrow)):
        times, ratios = _joined(whole, close)
        wide.plot(times, ratios, color=BODY, lw=1.0)
        wide.set_ylabel(_("greatest speed ratio of all handles"))
        text = _("{limit} m/s / {ratio} = {speed} m/s")
        wide.set_title(text.format(limit=f"{limit:g}", ratio=f"{peak:.6f}", speed=f"{speed.value:.6f}"))
        for n, (name, ratios) in enumerate(_near_ratios(close).items()):
            colour, _mark, dashes = SERIES[n % len(SERIES)]
            narrow.plot(close.times, ratios, color=colour, ls=dashes, lw=1.2, label=name)
        narrow.set(ylabel=_("speed ratio"), title=_("t = {t} s").format(t=f"{time:.6f}"))
        narrow.set(xlim=(close.times[0], close.times[-1]))
        narrow.legend(loc="best", ncols=1, framealpha=0.9)
        for panel, offset in ((wide, (10, -4)), (narrow, (10, 2))):
            panel.plot(time, peak, "D", color="black", ms=4.5, zorder=6)
            panel.annotate(
                f"{peak:.4f}", (time, peak), xytext=offset, textcoords="offset points", zorder=6
            )
            panel.set_xlabel(_("time (s)"))
            panel.margins(y=0.08)
        return figure


def _joined(whole: Motion, close: Motion) -> tuple[FloatArray, FloatArray]:
    """The greatest ratio over the times of both motions, in order."""
    times = np.concatenate([whole.times, close.times])
    ratios = np.concatenate([np.asarray(one.speed_ratio).max(axis=1) for one in (whole, close)])
    order = np.argsort(times, kind="stable")
    return times[order], ratios[order]


def _near_ratios(close: Motion) -> dict[str, FloatArray]:
    """The speed ratios of the first handles by their names; those that go together are one."""
    ratios = np.asarray(close.speed_ratio)[:, 1 : NEAR_HANDLES + 1].T
    peaks = ratios.max(axis=1)
    best = np.flatnonzero(peaks > peaks.max() - SAME) + 1
    named = {}
    for handle, values in enumerate(ratios, start=1):
        if handle == best[0] and len(best) > 1:
            name = _("handles {first} to {last}").format(first=best[0], last=best[-1])
            named[name] = values
        elif handle not in best or len(best) == 1:
            named[_("handle {number}").format(number=handle)] = values
    return named
