"""Pictures of contact: the moment with a close-up, clearance over time, the paper's Fig 2."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from benchdragon.analysis.contact import ClearanceCurve
from benchdragon.analysis.distance import boxes, nearness
from benchdragon.analysis.findings import named
from benchdragon.analysis.obstacle_distance import box_distances, nearest_points
from benchdragon.errors import InputError
from benchdragon.figures.square import draw_square, square_corners
from benchdragon.figures.style import BODY, DISC, HEAD, PAGE_WIDTH, drawable, drawn_panel, drawn_panels
from benchdragon.figures.walk import draw_dragon, framing_of, name_below
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.answer import Answer
from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Motion

# Vermilion for what touches, told apart by hatching too.
TOUCH = "#D55E00"
# Ground about the two points of a close-up, m.
CLOSE = 0.6
# A valley of a clearance curve lies below the peaks beside it by more than this share of the curve's
# height; one that is a near miss comes so near to the margin, m.
VALLEY, NEAR_MISS = 0.02, 0.005


def moment_picture(
    motion: Motion, answer: Answer, title: str = "", disc: float | None = None,
    obstacles: Sequence[Obstacle] = (),
) -> Figure:  # fmt: skip
    """The whole dragon at the one time of `motion`, and what the witness tells of close by.

    That is two benches, or a bench and one of `obstacles`: see `Plan.obstacles`.

    Raises:
        InputError: for an answer whose witness tells of nothing that meets, or that has none.
    """
    shown = _meeting(motion, answer, obstacles)
    with drawn_panels(PAGE_WIDTH, 3.9, title, 1, 2) as (figure, (whole, close)):
        middle = np.mean(shown.points, axis=0)
        kept = [tuple(middle), *square_corners(obstacles)]
        draw_dragon(whole, motion, 0, disc, framing_of(motion, [0], disc, kept), obstacles)
        whole.plot(*middle, "s", ms=9, mfc="none", mec=TOUCH, mew=1.5, zorder=5)
        whole.set_title(_("t = {t} s").format(t=f"{motion.times[0]:.9g}".replace("-", "−")))
        draw_meeting(close, motion, answer, obstacles)
        name_below(figure, whole, close)
        return figure


def draw_meeting(
    panel: Axes, motion: Motion, answer: Answer, obstacles: Sequence[Obstacle] = ()
) -> None:
    """Draw what an answer's witness tells of, close by, and the distance: see `moment_picture`."""
    shown = _meeting(motion, answer, obstacles)
    middle = np.mean(shown.points, axis=0)
    draw_square(panel, obstacles, size=None)
    _draw_close(panel, motion, shown.benches, middle, CLOSE + 0.5 * max(shown.distance, 0.0))
    (ax, ay), (bx, by) = shown.points
    panel.plot([ax, bx], [ay, by], color="black", lw=1.2, zorder=6)
    panel.plot([ax, bx], [ay, by], "o", color="black", ms=4, zorder=6)
    panel.set_title(shown.text)


@dataclass(frozen=True)
class _Meeting:
    """What meets: benches (rows, from 0), their nearest points, m, distance, m, name of an obstacle."""

    benches: tuple[int, ...]
    points: tuple[Point, Point]
    distance: float
    text: str
    obstacle: str | None = None


def _meeting(motion: Motion, answer: Answer, obstacles: Sequence[Obstacle]) -> _Meeting:
    """What a witness tells of, as it stands at the first time of `motion`."""
    witness = answer.witness
    if witness is None or not (witness.obstacle or len(witness.benches) == 2):
        raise InputError(_("this answer names no benches that meet, so there is no moment to draw"))
    found = [one for one in obstacles if one.name == witness.obstacle]
    if not found:
        i, j = (number - 1 for number in witness.benches)
        near = nearness(boxes(motion, 0), i, j)
        text = _("benches {a} and {b}: {gap}").format(
            a=i + 1, b=j + 1, gap=_distance_text(near.distance)
        )
        return _Meeting((i, j), near.points, near.distance, text)
    (obstacle,), bench = found, witness.benches[0] - 1
    points = nearest_points(motion, 0, bench, obstacle)
    distance = float(box_distances(motion, 0, obstacle)[0][bench]) - obstacle.radius
    text = _distance_text(distance if distance > 0.0 else 0.0)
    if distance == -math.inf and obstacle.kind == "venue":
        text = _("outside")
    text = _("bench {bench} and {name}: {gap}").format(
        bench=bench + 1, name=drawable(named(obstacle)), gap=text
    )
    return _Meeting((bench,), points, distance, text, obstacle.name)


def _distance_text(distance: float) -> str:
    if abs(distance) < 1e-9:
        return _("they touch")
    if distance < 0.0:
        return _("{depth} mm deep in one another").format(depth=f"{-1e3 * distance:.4g}")
    return _("{gap} mm apart").format(gap=f"{1e3 * distance:.4g}")


def _draw_close(
    panel: Axes, motion: Motion, shown: tuple[int, ...], middle: FloatArray, half: float
) -> None:
    corners = motion[0].corners()[0]
    others = [corners[n] for n in range(len(corners)) if n not in shown]
    panel.add_collection(PolyCollection(others, fc="#DDDDDD", ec="#888888", lw=0.5, zorder=2))
    for n, face, hatch in zip(shown, (HEAD, BODY), ("////", ""), strict=False):
        label = _("bench {number}").format(number=n + 1)
        bench = PolyCollection(
            [corners[n]], fc=face, ec="black", lw=1.0, hatch=hatch, alpha=0.85, zorder=3
        )
        bench.set_label(label)
        panel.add_collection(bench)
    panel.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half))
    panel.set(aspect="equal", xlabel=_("x (m)"), ylabel=_("y (m)"))


def clearance_picture(curve: ClearanceCurve, margin: float = 0.0, title: str = "") -> Figure:
    """Clearance over time with the limit it must keep, its valleys, and overlaps hatched.

    Valleys that come within NEAR_MISS of the limit are drawn once more, enlarged and with their depths.
    """
    with drawn_panel(PAGE_WIDTH, 3.4, title) as (figure, panel):
        draw_clearances(panel, curve, margin)
        return figure


def draw_clearances(panel: Axes, curve: ClearanceCurve, margin: float = 0.0) -> None:
    """Draw clearance over time: see `clearance_picture`."""
    valleys = _valleys(curve)
    _draw_clearance(panel, curve, valleys, 100.0)
    panel.axhline(0.0, color=TOUCH, lw=1.4, label=_("touching"))
    if margin > 0.0:
        panel.axhline(100.0 * margin, color=DISC, lw=1.4, ls="--", label=_("margin"))
    panel.set_xlabel(_("time (s)"))
    panel.set_ylabel(_("clearance (cm)"))
    panel.set_title(_("Least clearance of non-adjacent benches"))
    near = valleys[(valleys[:, 1] > 0.0) & (valleys[:, 1] < margin + NEAR_MISS)]
    crowded = len(near) and near[-1, 0] - near[0, 0] < 0.2 * np.ptp(curve.times)
    if crowded:
        _draw_near_misses(panel, curve, near)
    panel.legend(loc="upper right" if crowded else "best", framealpha=0.9)


def _valleys(curve: ClearanceCurve) -> FloatArray:
    """Times, s, and clearances, m, of local minima well below the peaks beside them, (V, 2)."""
    at = _minima(curve)
    depth = VALLEY * float(np.ptp(curve.clearance))
    kept = [min(_rises(curve, t, low)) > depth for t, low in at]
    return np.asarray(at[np.array(kept, dtype=bool)])


def _minima(curve: ClearanceCurve) -> FloatArray:
    """Times, s, and clearances, m, of all local minima, (M, 2)."""
    known = [(near.time, low.value) for low in curve.minima if (near := low.witness)]
    return np.array(known, dtype=np.float64).reshape(-1, 2)


def _rises(curve: ClearanceCurve, time: float, low: float) -> tuple[float, float]:
    """How high the curve rises above a minimum on either side before it is as low again, m."""
    middle = int(np.searchsorted(curve.times, time))
    sides = curve.clearance[:middle][::-1], curve.clearance[middle:]
    heights = []
    for side in sides:
        lower = np.flatnonzero(side < low)
        stretch = side[: lower[0]] if len(lower) else side
        heights.append(float(stretch.max(initial=low)) - low)
    return heights[0], heights[1]


def _draw_clearance(panel: Axes, curve: ClearanceCurve, valleys: FloatArray, scale: float) -> None:
    """The curve, its valleys, and overlaps hatched; `scale` units of the picture to a metre."""
    low = _minima(curve)
    times = np.concatenate([curve.times, low[:, 0]])
    order = np.argsort(times, kind="stable")
    times = times[order]
    clear = scale * np.concatenate([curve.clearance, low[:, 1]])[order]
    panel.plot(times, clear, color=BODY, lw=1.1, label=_("clearance"))
    if len(valleys):
        at = scale * valleys[:, 1]
        panel.plot(valleys[:, 0], at, ".", color="black", ms=4.0, label=_("valleys"))
    if (clear < 0.0).any():
        panel.fill_between(
            times, clear, 0.0, where=list(clear < 0.0), interpolate=True, fc="none", ec=TOUCH,
            hatch="////", lw=0.0, label=_("overlap"),
        )  # fmt: skip


def _draw_near_misses(panel: Axes, curve: ClearanceCurve, near: FloatArray) -> None:
    """An inset that shows the lowest valleys, in millimetres."""
    inset = panel.inset_axes((0.09, 0.22, 0.42, 0.42))
    _draw_clearance(inset, curve, near, 1e3)
    inset.axhline(0.0, color=TOUCH, lw=1.4)
    first, last = near[0, 0], near[-1, 0]
    room = 0.45 * (last - first) + 2.0
    top = 6.0 * float(near[:, 1].max())
    inset.set(xlim=(first - room, last + room), ylim=(-300.0 * top, 1e3 * top))
    inset.set_ylabel(_("clearance (mm)"))
    for t, low in near:
        inset.annotate(
            f"{1e3 * low:.3g} mm", (t, 1e3 * low), xytext=(0, 14), textcoords="offset points",
            ha="center", fontsize=7.5, arrowprops={"arrowstyle": "-", "lw": 0.6},
            bbox={"fc": "white", "ec": "none", "alpha": 0.8, "pad": 0.8},
        )  # fmt: skip
    shown = (first - room, -30.0 * top, last - first + 2.0 * room, 130.0 * top)
    indicator = panel.indicate_inset(shown, inset, edgecolor="black")
    # Lower and upper left, lower and upper right: none runs through the inset's labels.
    for line, seen in zip(indicator.connectors or (), (False, False, True, True), strict=False):
        line.set_visible(seen)
