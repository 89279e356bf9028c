"""Sheets of paper on which ground is drawn to scale: what fits, scale bar, arrow, venue, obstacles."""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from benchdragon.analysis.findings import shown_name
from benchdragon.analysis.ground import Ground
from benchdragon.errors import InputError
from benchdragon.figures.style import STYLE, drawable, named_figure
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle

# Sheets, mm, the longer side first.
PAPERS = {"A4": (297.0, 210.0), "A3": (420.0, 297.0), "A2": (594.0, 420.0), "A1": (841.0, 594.0),
          "A0": (1189.0, 841.0)}  # fmt: skip
# Scales, and those that are tried in turn where none is asked for.
LEAST_SCALE, MOST_SCALE = 50.0, 1000.0
SCALES = (50.0, 100.0, 200.0, 250.0, 500.0, 1000.0)
# Edge of a sheet, and the strip below the drawing for bar, names and legend, mm.
EDGE, STRIP = 8.0, 30.0
# Lengths of scale bars, m, and the longest on paper, mm.
BARS, LONGEST_BAR = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0), 60.0
# Parts of a bar, its height and the height of the north arrow, mm.
PARTS, BAR_HEIGHT, ARROW = 5, 2.0, 14.0
MM = 1.0 / 25.4
OUTSIDE = "#555555"


@dataclass(frozen=True)
class Sheet:
    """A sheet of paper, and the ground on it.

    Attributes:
        width: mm.
        height: mm.
        scale: metres on the ground to a metre of paper.
        middle: of the ground drawn, m, (2,).
    """

    width: float
    height: float
    scale: float
    middle: FloatArray

    def place(self, points: FloatArray) -> FloatArray:
        """Where points of the ground, m, (n, 2), lie on the sheet, mm from its lower left corner."""
        half = np.array([0.5 * self.width, EDGE + STRIP + 0.5 * (self.height - 2.0 * EDGE - STRIP)])
        return half + (points - self.middle) * (1000.0 / self.scale)


def check_scale(scale: float | None) -> None:
    """Refuse a scale that no sheet has; None is left to the sheet.

    Raises:
        InputError: if it is not from LEAST_SCALE to MOST_SCALE.
    """
    if scale is not None and not LEAST_SCALE <= scale <= MOST_SCALE:
        text = _("scale must be from 1:{least} to 1:{most}, not 1:{value}")
        most = f"{MOST_SCALE:g}"
        raise InputError(text.format(least=f"{LEAST_SCALE:g}", most=most, value=f"{scale:g}"))


def needed_scale(bounds: FloatArray, paper: str) -> tuple[float, tuple[float, float]]:
    """The largest scale, 1 to this, at which ground fits a paper, and the sides so laid, mm."""
    size = bounds[1] - bounds[0]
    return min(
        (1000.0 * float((size / room).max()), sides)
        for sides in (PAPERS[paper], PAPERS[paper][::-1])
        if ((room := np.array(sides) - [2.0 * EDGE, 2.0 * EDGE + STRIP]) > 0.0).all()
    )


def sheet_for(bounds: FloatArray, paper: str, scale: float | None) -> Sheet:
    """The sheet for ground within bounds, m, (2, 2), upright or lying as gives it most room.

    Args:
        bounds: least and greatest corner.
        paper: a key of PAPERS.
        scale: None for the largest of SCALES that fits.

    Raises:
        InputError: for a paper or scale that is not known, or ground that does not fit.
    """
    if paper not in PAPERS:
        text = _("paper must be one of {known}, not {value}")
        raise InputError(text.format(known=", ".join(PAPERS), value=paper))
    check_scale(scale)
    size = bounds[1] - bounds[0]
    needed, sheet = needed_scale(bounds, paper)
    chosen = scale or next((one for one in SCALES if needed <= one), MOST_SCALE)
    if chosen < needed:
        raise InputError(
            _(
                "ground of {width} m by {height} m does not fit {paper} at 1:{scale}: it needs "
                "1:{needed}; take a larger paper or a smaller scale"
            ).format(
                width=f"{size[0]:.1f}",
                height=f"{size[1]:.1f}",
                paper=paper,
                scale=f"{chosen:g}",
                needed=math.ceil(needed),
            )
        )
    return Sheet(*sheet, chosen, 0.5 * bounds.sum(axis=0))


def corners_of(one: Obstacle) -> FloatArray:
    """The least and the greatest corner of an obstacle, m, (2, 2)."""
    corners: FloatArray = np.array(
        [one.outline.min(axis=0) - one.radius, one.outline.max(axis=0) + one.radius]
    )
    return corners


@contextmanager
def drawn_sheet(sheet: Sheet, ground: Ground) -> Iterator[tuple[Figure, Axes]]:
    """A figure of the sheet's size, to be drawn in our style, whose axes count mm from its lower left.

    With a line round the ground, and below it, in the strip of names, a scale bar and an arrow north.
    """
    with matplotlib.rc_context({**STYLE, "figure.constrained_layout.use": False}):
        figure = named_figure(sheet.width * MM, sheet.height * MM, "")
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set(xlim=(0.0, sheet.width), ylim=(0.0, sheet.height))
        axes.set_axis_off()
        frame = (EDGE, EDGE + STRIP), sheet.width - 2.0 * EDGE, sheet.height - 2.0 * EDGE - STRIP
        axes.add_patch(Rectangle(*frame, fill=False, ec=OUTSIDE, lw=0.4))
        _draw_bar(axes, sheet)
        _draw_north(axes, sheet, ground.y_name, ground.turned)
        yield figure, axes


def draw_obstacles(axes: Axes, sheet: Sheet, obstacles: Sequence[Obstacle]) -> None:
    """Draw the venue's edge and obstacles with names; one of each kind has a label.

    In black and white and in mm of paper, each an element of its own in SVG, without margins:
    `square.draw_square` draws the square on axes of metres, in colour.
    """
    named: set[str] = set()
    for one in obstacles:
        venue = one.kind == "venue"
        label = _("edge of the venue") if venue else _("obstacle")
        look = {"ec": "black", "lw": 1.2 if venue else 0.7, "zorder": 5, "gid": f"obstacle-{one.name}"}
        if label not in named:
            look["label"] = label
            named.add(label)
        look |= {"fill": False} if venue or one.kind == "line" else {"fc": "#dddddd", "hatch": "////"}
        points = sheet.place(one.outline)
        if one.kind == "circle":
            axes.add_patch(Circle(points[0], 1000.0 * one.radius / sheet.scale, **look))
        else:
            axes.add_patch(Polygon(points, closed=one.kind != "line", **look))
        if not venue:
            x, y = points.mean(axis=0)[0], points[:, 1].max() + 1000.0 * one.radius / sheet.scale
            axes.text(x, y + 0.8, drawable(shown_name(one)), fontsize=7, ha="center", zorder=6)


def bar_length(scale: float) -> float:
    """The length of the scale bar, m: at most LONGEST_BAR on paper."""
    return max(length for length in BARS if 1000.0 * length / scale <= LONGEST_BAR)


def _draw_bar(axes: Axes, sheet: Sheet) -> None:
    """The scale bar: a frame of its whole length, every other part filled, and its ends named."""
    length = bar_length(sheet.scale)
    long, left, low = 1000.0 * length / sheet.scale, EDGE, EDGE + 14.0
    for n in range(0, PARTS, 2):
        axes.add_patch(
            Rectangle((left + n * long / PARTS, low), long / PARTS, BAR_HEIGHT, fc="black", lw=0.0)
        )
    axes.add_patch(
        Rectangle((left, low), long, BAR_HEIGHT, fill=False, ec="black", lw=0.5, gid="scale-bar")
    )
    for metres, x in ((0.0, left), (length, left + long)):
        axes.text(x, low + BAR_HEIGHT + 1.0, f"{metres:g}", ha="center", va="bottom", fontsize=8)
    unit = left + long + 5.0
    axes.text(unit, low + 0.5 * BAR_HEIGHT, f"m   1:{sheet.scale:g}", va="center", fontsize=8)


def _draw_north(axes: Axes, sheet: Sheet, text: str, turned: float) -> None:
    """An arrow along the plan's y axis, or turned to the left of it (rad), and what is there."""
    x, low = sheet.width - EDGE - 6.0, EDGE + 10.0
    corners = np.array([(0.0, 0.5), (-0.215, -0.5), (0.0, -0.285), (0.215, -0.5)])
    c, s = math.cos(turned), math.sin(turned)
    axes.add_patch(
        Polygon(
            (x, low + 0.5 * ARROW) + ARROW * corners @ np.array([(c, s), (-s, c)]), fc="black", lw=0.0
        )
    )
    axes.text(x, low - 1.0, text, ha="center", va="top", fontsize=8)
