"""The ground that a dance covers, drawn to scale on a sheet of paper."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import matplotlib
import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch, Polygon, Rectangle
from matplotlib.path import Path

from benchdragon.analysis.findings import shown_name
from benchdragon.analysis.swept import Shape, SweptArea
from benchdragon.errors import InputError
from benchdragon.figures.framing import route_positions
from benchdragon.figures.style import BODY, HEAD, ROUTE, STYLE, drawable, named_figure
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
class AreaDrawing:
    """What is drawn.

    Attributes:
        title: of the dance.
        swept: the ground, and the spectators' line.
        obstacles: the venue's edge and what stands in it.
    """

    title: str
    swept: SweptArea
    obstacles: tuple[Obstacle, ...] = ()

    def route(self) -> FloatArray:
        """Points of the route under the benches, m, (n, 2)."""
        steps = self.swept.steps
        low, high = float(steps.rear.min()), float(steps.front.max())
        return self.swept.walk.route.point(route_positions(low, high))

    def bounds(self) -> FloatArray:
        """The least and the greatest corner of all of it, m, (2, 2)."""
        boxes = [np.array(self.swept.spectators.bounds).reshape(2, 2)]
        boxes += [
            np.array([one.outline.min(axis=0) - one.radius, one.outline.max(axis=0) + one.radius])
            for one in self.obstacles
        ]
        corners = np.array(boxes)
        return np.array([corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)])


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
        raise InputError(
            _("scale must be from 1:{least} to 1:{most}, not 1:{value}").format(
                least=f"{LEAST_SCALE:g}", most=f"{MOST_SCALE:g}", value=f"{scale:g}"
            )
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
        raise InputError(
            _("paper must be one of {known}, not {value}").format(known=", ".join(PAPERS), value=paper)
        )
    check_scale(scale)
    size = bounds[1] - bounds[0]
    needed, sheet = min(
        (1000.0 * float((size / room).max()), sides)
        for sides in (PAPERS[paper], PAPERS[paper][::-1])
        if ((room := np.array(sides) - [2.0 * EDGE, 2.0 * EDGE + STRIP]) > 0.0).all()
    )
    chosen = scale or next((one for one in SCALES if one >= needed), MOST_SCALE)
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


def area_picture(drawing: AreaDrawing, paper: str = "A3", scale: float | None = None) -> Figure:
    """The ground, the spectators' line, route, venue and obstacles, to scale, with bar and arrow.

    Raises:
        InputError: as `sheet_for`.
    """
    sheet = sheet_for(drawing.bounds(), paper, scale)
    with matplotlib.rc_context({**STYLE, "figure.constrained_layout.use": False}):
        figure = named_figure(sheet.width * MM, sheet.height * MM, "")
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set(xlim=(0.0, sheet.width), ylim=(0.0, sheet.height))
        axes.set_axis_off()
        _draw_ground(axes, sheet, drawing)
        _draw_bar(axes, sheet)
        _draw_north(axes, sheet)
        _write_names(axes, sheet, drawing, paper)
        return figure


def _outline(sheet: Sheet, shape: Shape) -> Path:
    """The rings of an area as one path: what its holes hold is outside."""
    paths = [
        Path(sheet.place(np.asarray(ring.coords)), closed=True)
        for part in shapely.get_parts(shapely.orient_polygons(shape))
        for ring in (part.exterior, *part.interiors)
    ]
    return Path.make_compound_path(*paths)


def _draw_ground(axes: Axes, sheet: Sheet, drawing: AreaDrawing) -> None:
    swept = drawing.swept
    axes.add_patch(
        PathPatch(
            _outline(sheet, swept.polygon), fc=BODY, ec="black", lw=0.4, alpha=0.6, zorder=2,
            gid="swept", label=_("ground covered"),
        )
    )  # fmt: skip
    if swept.margin:
        text = _("spectators' line, {margin} m from it").format(margin=f"{swept.margin:g}")
        axes.add_patch(
            PathPatch(
                _outline(sheet, swept.spectators), fill=False, ec=HEAD, lw=0.9, ls="--", zorder=3,
                gid="spectators", label=text,
            )
        )  # fmt: skip
    route = sheet.place(drawing.route())
    axes.plot(*route.T, color=ROUTE, lw=0.5, zorder=4, label=_("route"), gid="route")
    _draw_obstacles(axes, sheet, drawing.obstacles)


def _draw_obstacles(axes: Axes, sheet: Sheet, obstacles: Sequence[Obstacle]) -> None:
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


def _draw_north(axes: Axes, sheet: Sheet) -> None:
    """An arrow along the plan's y axis, which is taken for north."""
    x, low = sheet.width - EDGE - 6.0, EDGE + 10.0
    axes.add_patch(
        Polygon([(x, low + ARROW), (x - 3.0, low), (x, low + 3.0), (x + 3.0, low)], fc="black", lw=0.0)
    )
    axes.text(x, low - 1.0, _("N (y axis)"), ha="center", va="top", fontsize=8)


def _write_names(axes: Axes, sheet: Sheet, drawing: AreaDrawing, paper: str) -> None:
    """Title, what the numbers are, and the legend."""
    swept = drawing.swept
    text = _("{area} m² within {error} m, from t = {start} s to t = {end} s; {paper}").format(
        area=f"{swept.area:.1f}", error=f"{swept.error:.2g}", start=f"{swept.start:g}",
        end=f"{swept.end:.6g}", paper=paper,
    )  # fmt: skip
    axes.text(EDGE, EDGE + 7.0, drawable(drawing.title), fontsize=9, va="bottom")
    axes.text(EDGE, EDGE + 1.0, text, fontsize=8, va="bottom")
    legend = axes.legend(
        loc="lower right", bbox_to_anchor=(1.0 - 30.0 / sheet.width, EDGE / sheet.height),
        ncols=1, frameon=False, fontsize=8, borderaxespad=0.0,
    )  # fmt: skip
    legend.set_zorder(7)
    frame = (EDGE, EDGE + STRIP), sheet.width - 2.0 * EDGE, sheet.height - 2.0 * EDGE - STRIP
    axes.add_patch(Rectangle(*frame, fill=False, ec=OUTSIDE, lw=0.4))
