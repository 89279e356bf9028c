"""The square in pictures: the venue's edge, the obstacles, and the margins that benches keep."""

from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import Collection, LineCollection, PolyCollection
from matplotlib.patches import PathPatch
from matplotlib.path import Path as MatplotlibPath
from matplotlib.patheffects import withStroke

from benchdragon.analysis.findings import shown_name
from benchdragon.figures.style import LEAST_TEXT, drawable
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.outline import drawn_outline, margin_rings

# Okabe and Ito's reddish purple for obstacles, hatched; blue for the venue's edge.
OBSTACLE, EDGE = "#CC79A7", "#0072B2"
HATCH = "...."
# Okabe and Ito's sky blue, pale, for the ground that the dance covers.
GROUND = "#56B4E9"
# Names are written in a picture of no more obstacles than this.
MOST_NAMES = 40


def square_corners(obstacles: Sequence[Obstacle]) -> list[tuple[float, float]]:
    """Two corners of the upright rectangle about each obstacle and the venue, m."""
    corners: list[tuple[float, float]] = []
    for obstacle in obstacles:
        ring = drawn_outline(obstacle)
        corners += [tuple(ring.min(axis=0).tolist()), tuple(ring.max(axis=0).tolist())]
    return corners


def draw_square(
    panel: Axes, obstacles: Sequence[Obstacle], *, ground: Sequence[FloatArray] = (),
    ink: str = "black", paper: str = "white", mark: float = 1.0, size: float | None = LEAST_TEXT,
) -> None:  # fmt: skip
    """Draw the venue's edge, obstacles with their names, and the margins about them.

    Args:
        panel: to draw into.
        obstacles: what.
        ground: outlines of the ground that the dance covers: see `swept.drawn_ground`.
        ink: colour of names and of lines about obstacles.
        paper: colour of the ground.
        mark: width of lines, as a share of the usual.
        size: of the names' letters, points; None: no names.
    """
    if ground:
        _draw_ground(panel, ground)
    for one in (*_standing(obstacles, ink, mark), *_edges(obstacles, ink, mark)):
        panel.add_collection(one, autolim=False)
    if size is not None and 0 < len(obstacles) <= MOST_NAMES:
        _write_names(panel, obstacles, ink, paper, size)


def _draw_ground(panel: Axes, ground: Sequence[FloatArray]) -> None:
    path = MatplotlibPath.make_compound_path(*(MatplotlibPath(ring, closed=True) for ring in ground))
    panel.add_patch(
        PathPatch(path, label=_("ground covered"), fc=GROUND, alpha=0.3, lw=0.0, zorder=0.5)
    )


def _standing(obstacles: Sequence[Obstacle], ink: str, mark: float) -> Iterator[Collection]:
    """Draw the obstacles: those with an inside, and lines."""
    stands = [one for one in obstacles if one.kind != "venue"]
    solid = [drawn_outline(one) for one in stands if one.kind != "line"]
    ropes = [one.outline for one in stands if one.kind == "line"]
    if solid:
        yield PolyCollection(
            solid, fc=OBSTACLE, ec=ink, lw=0.8 * mark, hatch=HATCH, zorder=1.5, label=_("obstacle")
        )
    if ropes:
        yield LineCollection(
            ropes, colors=OBSTACLE, lw=2.6 * mark, zorder=1.5, label=_("obstacle line")
        )


def _edges(obstacles: Sequence[Obstacle], ink: str, mark: float) -> Iterator[Collection]:
    """What may not be crossed though nothing stands there: the venue's edge, and margins."""
    edges = [one.outline for one in obstacles if one.kind == "venue"]
    margins = [ring for one in obstacles for ring in margin_rings(one)]
    if edges:
        yield PolyCollection(
            edges, fc="none", ec=EDGE, lw=2.2 * mark, zorder=1.4, label=_("edge of the venue")
        )
    if margins:
        yield PolyCollection(
            margins, fc="none", ec=ink, lw=0.8 * mark, ls=(0, (2, 2)), zorder=1.6, label=_("margin")
        )


def _write_names(panel: Axes, obstacles: Sequence[Obstacle], ink: str, paper: str, size: float) -> None:
    """The names of obstacles above them, and of the venue inside its upper left corner."""
    middle = np.mean(square_corners(obstacles), axis=0)
    for one in obstacles:
        ring, venue = drawn_outline(one), one.kind == "venue"
        (left, _low), (right, high) = ring.min(axis=0), ring.max(axis=0)
        east = not venue and 0.5 * (left + right) > middle[0]
        panel.annotate(
            drawable(shown_name(one)), (right if east else left, high),
            xytext=(4, -4) if venue else (0, 2), textcoords="offset points", fontsize=size, color=ink,
            ha="right" if east else "left", va="top" if venue else "bottom", zorder=6.5,
            annotation_clip=True, clip_on=True,
            path_effects=[withStroke(linewidth=0.3 * size, foreground=paper)],
        )  # fmt: skip
