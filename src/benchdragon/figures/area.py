"""The ground that a dance covers, drawn to scale on a sheet of paper."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from benchdragon.analysis.ground import Ground
from benchdragon.analysis.swept import Shape, SweptArea
from benchdragon.figures.framing import route_positions
from benchdragon.figures.scale import EDGE, Sheet, corners_of, draw_obstacles, drawn_sheet, sheet_for
from benchdragon.figures.style import BODY, HEAD, ROUTE, drawable
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle


@dataclass(frozen=True)
class AreaDrawing:
    """What is drawn.

    Attributes:
        title: of the dance.
        swept: the ground, and the spectators' line.
        obstacles: the venue's edge and the obstacles in it.
        ground: the ways x and y point.
    """

    title: str
    swept: SweptArea
    obstacles: tuple[Obstacle, ...] = ()
    ground: Ground = field(default_factory=lambda: Ground((0.0, 0.0)))

    def route(self) -> FloatArray:
        """Points of the route under the benches, m, (n, 2)."""
        steps = self.swept.steps
        low, high = float(steps.rear.min()), float(steps.front.max())
        return self.swept.walk.route.point(route_positions(low, high))

    def bounds(self) -> FloatArray:
        """The least and the greatest corner of all of it, m, (2, 2)."""
        boxes = [np.array(self.swept.spectators.bounds).reshape(2, 2)]
        corners = np.array([*boxes, *map(corners_of, self.obstacles)])
        return np.array([corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)])


def area_picture(drawing: AreaDrawing, paper: str = "A3", scale: float | None = None) -> Figure:
    """The ground, the spectators' line, route, venue and obstacles, to scale, with bar and arrow.

    Raises:
        InputError: as `sheet_for`.
    """
    sheet = sheet_for(drawing.bounds(), paper, scale)
    with drawn_sheet(sheet, drawing.ground) as (figure, axes):
        _draw_ground(axes, sheet, drawing)
        _write_names(axes, sheet, drawing, paper)
        return figure


def outline(shape: Shape, place: Callable[[FloatArray], FloatArray] = np.asarray) -> Path:
    """The rings of an area, put in their place, as one path: what its holes hold is outside."""
    paths = [
        Path(place(np.asarray(ring.coords)), closed=True)
        for part in shapely.get_parts(shapely.orient_polygons(shape))
        for ring in (part.exterior, *part.interiors)
    ]
    return Path.make_compound_path(*paths)


def _draw_ground(axes: Axes, sheet: Sheet, drawing: AreaDrawing) -> None:
    swept = drawing.swept
    axes.add_patch(
        PathPatch(
            outline(swept.polygon, sheet.place), fc=BODY, ec="black", lw=0.4, alpha=0.6, zorder=2,
            gid="swept", label=_("ground covered"),
        )
    )  # fmt: skip
    if swept.margin:
        text = _("spectators' line, {margin} m from it").format(margin=f"{swept.margin:g}")
        axes.add_patch(
            PathPatch(
                outline(swept.spectators, sheet.place), fill=False, ec=HEAD, lw=0.9, ls="--", zorder=3,
                gid="spectators", label=text,
            )
        )  # fmt: skip
    route = sheet.place(drawing.route())
    axes.plot(*route.T, color=ROUTE, lw=0.5, zorder=4, label=_("route"), gid="route")
    draw_obstacles(axes, sheet, drawing.obstacles)


def _write_names(axes: Axes, sheet: Sheet, drawing: AreaDrawing, paper: str) -> None:
    """Title, what the numbers are, and the legend."""
    swept = drawing.swept
    text = _("{area} m² within {error} m, from t = {start} s to t = {end} s; {paper}")
    start, end = f"{swept.start:g}", f"{swept.end:.6g}"
    text = text.format(
        area=f"{swept.area:.1f}", error=f"{swept.error:.2g}", start=start, end=end, paper=paper
    )
    axes.text(EDGE, EDGE + 7.0, drawable(drawing.title), fontsize=9, va="bottom")
    axes.text(EDGE, EDGE + 1.0, text, fontsize=7.5, va="bottom")
    legend = axes.legend(
        loc="lower right", bbox_to_anchor=(1.0 - 30.0 / sheet.width, EDGE / sheet.height),
        ncols=1, frameon=False, fontsize=7.5, markerscale=0.7, borderaxespad=0.0, labelspacing=0.25,
    )  # fmt: skip
    legend.set_zorder(7)
