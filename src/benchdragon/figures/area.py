"""The ground that a dance covers, drawn to scale on a sheet of paper."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.swept import Shape, SweptArea
from benchdragon.errors import InputError
from benchdragon.figures.framing import route_positions
from benchdragon.figures.scale import (
    EDGE,
    SCALES,
    STRIP,
    Sheet,
    corners_of,
    draw_obstacles,
    drawn_sheet,
    sheet_for,
)
from benchdragon.figures.style import BODY, HEAD, ROUTE, drawable
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle

# A drawing on a page of text, mm, and the scales that are tried there in turn.
PAGE = (178.0, 200.0)
PAGE_SCALES = (*SCALES, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5)


@dataclass(frozen=True)
class AreaDrawing:
    """What is drawn.

    Attributes:
        title: of the dance.
        swept: the ground, and the spectators' line.
        obstacles: the venue's edge and the obstacles in it.
        ground: the peg from which papers measure, and the ways x and y point; a page shows the peg.
        clock: by which a paper tells times; without one they are seconds of the plan.
    """

    title: str
    swept: SweptArea
    obstacles: tuple[Obstacle, ...] = ()
    ground: Ground = field(default_factory=lambda: Ground((0.0, 0.0)))
    clock: Clock | None = None

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
    return _drawn_on(sheet_for(drawing.bounds(), paper, scale), drawing, paper)


def page_picture(drawing: AreaDrawing, posts: Sequence[Point] = ()) -> tuple[Figure, float]:
    """The same between the margins of an A4 page, with the peg and numbered posts.

    And its scale: the 500 of 1:500.

    Raises:
        InputError: for ground that fits at none of PAGE_SCALES.
    """
    bounds = drawing.bounds()
    room = np.array(PAGE) - [2.0 * EDGE, 2.0 * EDGE + STRIP]
    needed = 1000.0 * float(((bounds[1] - bounds[0]) / room).max())
    scale = next((one for one in PAGE_SCALES if one >= needed), None)
    if scale is None:
        text = _("ground of 1:{needed} on a page is too large for the annex")
        raise InputError(text.format(needed=math.ceil(needed)))
    sheet = Sheet(*PAGE, scale, 0.5 * bounds.sum(axis=0))
    return _drawn_on(sheet, drawing, "A4", [drawing.ground.peg, *posts]), scale


def _drawn_on(sheet: Sheet, drawing: AreaDrawing, paper: str, spots: Sequence[Point] = ()) -> Figure:
    with drawn_sheet(sheet, drawing.ground) as (figure, axes):
        _draw_ground(axes, sheet, drawing)
        _draw_spots(axes, sheet, spots)
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


def _draw_spots(axes: Axes, sheet: Sheet, spots: Sequence[Point]) -> None:
    """The peg, if there is one, and posts for marshals by their numbers, from 1."""
    if not spots:
        return
    (x, y), *posts = sheet.place(np.array(spots)).tolist()
    look: dict[str, Any] = {"ls": "none", "color": "black", "zorder": 8}
    axes.plot([x], [y], marker="P", ms=6.0, mec="white", mew=0.5, label=_("peg"), gid="peg", **look)
    axes.text(x + 1.5, y + 1.0, _("peg"), fontsize=7, fontweight="bold", zorder=9)
    if posts:
        label = _("post for a marshal")
        axes.plot(
            *np.array(posts).T, marker="o", ms=9.5, mfc=(1.0, 1.0, 1.0, 0.7), mew=0.8, gid="posts",
            label=label, **look,
        )  # fmt: skip
    for n, (u, v) in enumerate(posts, start=1):
        axes.text(
            u, v, f"{n}", fontsize=6.5, fontweight="bold", ha="center", va="center_baseline", zorder=9
        )


def _write_names(axes: Axes, sheet: Sheet, drawing: AreaDrawing, paper: str) -> None:
    """Title, what the numbers are, and the legend."""
    swept = drawing.swept
    text = _("{area} m² within {error} m, from t = {start} s to t = {end} s; {paper}")
    start, end = f"{swept.start:g}", f"{swept.end:.6g}"
    if drawing.clock is not None:
        text = _("what boards pass over: {area} m² within {error} m, from {start} to {end}; {paper}")
        start, end = drawing.clock.tell(swept.start), drawing.clock.tell(swept.end)
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
