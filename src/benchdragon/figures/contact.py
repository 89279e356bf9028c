"""Pictures of contact: the moment with a close-up, clearance over time, the paper's Fig 2."""

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from benchdragon.analysis.contact import ClearanceCurve
from benchdragon.analysis.distance import boxes, nearness
from benchdragon.figures.style import BODY, DISC, HEAD, STYLE, named_figure
from benchdragon.figures.walk import bench_corners, draw_dragon, framing_of
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.answer import Answer
from benchdragon.model.walk import Motion

# Vermilion for what touches, told apart by hatching too.
TOUCH = "#D55E00"
# Ground about the two points of a close-up, m.
CLOSE = 0.6


def moment_picture(
    motion: Motion, answer: Answer, title: str = "", disc: float | None = None
) -> Figure:
    """The whole dragon at the one time of `motion`, and the two benches of the witness close by.

    Raises:
        ValueError: for an answer without a witness.
    """
    if answer.witness is None:
        raise ValueError("an answer without a witness has no moment")
    i, j = (number - 1 for number in answer.witness.benches)
    near = nearness(boxes(motion, 0), i, j)
    with matplotlib.rc_context(STYLE):
        figure = named_figure(14.4, 7.6, title)
        whole, close = figure.subplots(1, 2)
        middle = np.mean(near.points, axis=0)
        draw_dragon(whole, motion, 0, disc, framing_of(motion, [0], disc, [tuple(middle)]))
        whole.plot(*middle, "s", ms=14, mfc="none", mec=TOUCH, mew=2.0, zorder=5)
        whole.set_title(_("t = {t} s").format(t=f"{motion.times[0]:.9g}".replace("-", "−")))
        _draw_close(close, motion, (i, j), middle, CLOSE + 0.5 * max(near.distance, 0.0))
        (ax, ay), (bx, by) = near.points
        close.plot([ax, bx], [ay, by], color="black", lw=1.2, zorder=6)
        close.plot([ax, bx], [ay, by], "o", color="black", ms=4, zorder=6)
        close.set_title(
            _("benches {a} and {b}: {gap}").format(a=i + 1, b=j + 1, gap=_distance_text(near.distance))
        )
        return figure


def _distance_text(distance: float) -> str:
    if abs(distance) < 1e-9:
        return _("they touch")
    if distance < 0.0:
        return _("{depth} mm deep in one another").format(depth=f"{-1e3 * distance:.4g}")
    return _("{gap} mm apart").format(gap=f"{1e3 * distance:.4g}")


def _draw_close(
    panel: Axes, motion: Motion, pair: tuple[int, int], middle: FloatArray, half: float
) -> None:
    corners = bench_corners(motion, 0)
    others = [corners[n] for n in range(len(corners)) if n not in pair]
    panel.add_collection(PolyCollection(others, fc="#DDDDDD", ec="#888888", lw=0.5, zorder=2))
    for n, face, hatch in ((pair[0], HEAD, "////"), (pair[1], BODY, "")):
        label = _("bench {number}").format(number=n + 1)
        bench = PolyCollection(
            [corners[n]], fc=face, ec="black", lw=1.0, hatch=hatch, alpha=0.85, zorder=3
        )
        bench.set_label(label)
        panel.add_collection(bench)
    panel.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half))
    panel.set_aspect("equal")
    panel.set_xlabel(_("x (m)"))
    panel.set_ylabel(_("y (m)"))
    panel.legend(loc="upper right", fontsize="small", framealpha=0.9)


def clearance_picture(curve: ClearanceCurve, margin: float = 0.0, title: str = "") -> Figure:
    """Clearance over time with the limit it must keep, its local minima, and overlaps hatched."""
    with matplotlib.rc_context(STYLE):
        figure = named_figure(9.6, 5.2, title)
        panel = figure.subplots()
        clear = 100.0 * curve.clearance
        panel.plot(curve.times, clear, color=BODY, lw=1.2, label=_("clearance"))
        if curve.minima:
            known = [(near.time, low.value) for low in curve.minima if (near := low.witness)]
            at = np.array(known, dtype=np.float64)
            panel.plot(at[:, 0], 100.0 * at[:, 1], ".", color="black", ms=4, label=_("local minima"))
        panel.axhline(0.0, color=TOUCH, lw=1.4, label=_("touching"))
        if margin > 0.0:
            panel.axhline(100.0 * margin, color=DISC, lw=1.4, ls="--", label=_("margin"))
        if (clear < 0.0).any():
            panel.fill_between(
                curve.times, clear, 0.0, where=list(clear < 0.0), fc="none", ec=TOUCH, hatch="////",
                label=_("overlap"),
            )  # fmt: skip
        panel.set_xlabel(_("time (s)"))
        panel.set_ylabel(_("clearance (cm)"))
        panel.set_title(_("Least clearance of non-adjacent benches"))
        panel.legend(loc="best", fontsize="small", framealpha=0.9)
        return figure
