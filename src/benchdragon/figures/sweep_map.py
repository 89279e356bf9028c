"""Answers over two keys: a map with contours; where there is no answer it is hatched."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.contour import ContourSet
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

from benchdragon.figures.style import LEAST_TEXT, cell_edges
from benchdragon.figures.sweep_curve import runs
from benchdragon.figures.sweep_rows import HATCHES, Answered, Ints, said
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.sweeps.questions import STATES

COLOURS = "viridis"
# Points are marked where there are so few; lines of equal answers.
FEW, LEVELS = 1_000, 7
# Points, as shares of both ranges, that lie nearer to a line than this span no triangles.
FLAT = 1e-6
# Labels of contours lie so far apart in one direction at least, as shares of the picture.
ROOM = (0.07, 0.08)


def scale(value: FloatArray) -> ScalarMappable:
    """Colours for answers."""
    low, high = (float(np.nanmin(value)), float(np.nanmax(value))) if value.size else (0.0, 1.0)
    if low == high:
        room = 0.01 * abs(low) or 0.01
        low, high = low - room, high + room
    return ScalarMappable(Normalize(low, high), COLOURS)


def _norm(colours: ScalarMappable) -> Normalize:
    return Normalize(*colours.get_clim())


def draw_map(panel: Axes, found: Answered, keys: tuple[str, str], colours: ScalarMappable) -> None:
    """The answers over two keys."""
    panel.grid(False)
    x, y = (found.keys[key] for key in keys)
    across, along = np.unique(x), np.unique(y)
    column, row = np.searchsorted(across, x), np.searchsorted(along, y)
    full = len(across) * len(along) == len(x) == len({*zip(column, row, strict=True)})
    if full and min(len(across), len(along)) > 1:
        _draw_grid(panel, found, across, along, np.lexsort((column, row)), colours)
    else:
        _draw_scattered(panel, found, x, y, colours)
    for key, set_ticks in zip(keys, (panel.set_xticks, panel.set_yticks), strict=True):
        if key in found.texts:
            set_ticks(
                range(len(found.texts[key])),
                [said(found, key, n) for n in range(len(found.texts[key]))],
            )


def _draw_grid(
    panel: Axes, found: Answered, x: FloatArray, y: FloatArray, order: Ints, colours: ScalarMappable
) -> None:
    """Every combination of x and y: cells about them, and contours between them."""
    shape = (len(y), len(x))
    value, why = found.value[order].reshape(shape), found.why[order].reshape(shape)
    columns, rows = cell_edges(x), cell_edges(y)
    panel.pcolormesh(
        columns, rows, np.ma.masked_invalid(value), cmap=colours.cmap, norm=_norm(colours),
        rasterized=True,
    )  # fmt: skip
    cells: dict[str, list[Any]] = {}
    for n in range(len(y)):
        for first, last in runs(why[n]):
            left, right, low, high = columns[first], columns[last + 1], rows[n], rows[n + 1]
            corners = [(left, low), (right, low), (right, high), (left, high)]
            cells.setdefault(str(why[n, first]), []).append(corners)
    _hatch(panel, cells)
    if levels := _levels(colours, value[np.isfinite(value)]):
        lines = panel.contour(x, y, np.ma.masked_invalid(value), levels, colors="white", linewidths=0.7)
        _label(panel, lines)
    panel.set(xlim=columns[[0, -1]], ylim=rows[[0, -1]])


def _levels(colours: ScalarMappable, value: FloatArray) -> list[float]:
    """Round numbers for contours between the least and the greatest of some answers."""
    if not len(value):
        return []
    ticks = MaxNLocator(LEVELS, steps=[1, 2, 5, 10]).tick_values(*colours.get_clim())
    return [float(tick) for tick in ticks if value.min() < tick < value.max()]


def _label(panel: Axes, lines: ContourSet) -> None:
    """Write values on contours, but not upon one another."""
    places: list[FloatArray] = []
    kept: list[tuple[float, float]] = []
    for text in panel.clabel(lines, inline=False):
        at = panel.transAxes.inverted().transform(panel.transData.transform(text.get_position()))
        if not any((np.abs(at - other) < ROOM).all() for other in places):
            places.append(at)
            kept.append(text.get_position())
        text.remove()
    for text in panel.clabel(lines, fontsize=LEAST_TEXT, manual=kept) if kept else ():
        text.set_path_effects([withStroke(linewidth=1.5, foreground="#333333")])


def _hatch(panel: Axes, cells: dict[str, list[Any]]) -> None:
    """Hatch polygons by why there is no answer; those of "" have one."""
    for why, polygons in cells.items():
        if why:
            panel.add_collection(
                PolyCollection(
                    polygons,
                    fc="#EEEEEE",
                    ec="#777777",
                    hatch=HATCHES[why],
                    lw=0.0,
                    label=_(STATES[why]),
                ),
                autolim=True,
            )


def _draw_scattered(
    panel: Axes, found: Answered, x: FloatArray, y: FloatArray, colours: ScalarMappable
) -> None:
    """Any points: the answers between three of them, hatched where one has none; and the points."""
    known = found.known
    triangles = _triangles(x, y)
    if triangles is not None:
        corners = np.asarray(triangles.triangles)
        whole = known[corners].all(axis=1)
        if whole.any():
            triangles.set_mask(~whole)
            value = np.where(known, found.value, 0.0)
            panel.tripcolor(
                triangles, value, shading="gouraud", cmap=colours.cmap, norm=_norm(colours),
                rasterized=True,
            )  # fmt: skip
            if levels := _levels(colours, value[corners[whole]]):
                lines = panel.tricontour(
                    triangles, value, levels=levels, colors="white", linewidths=0.7
                )
                _label(panel, lines)
        cells: dict[str, list[Any]] = {}
        for three in corners[~whole]:
            why = next(str(found.why[n]) for n in three if not known[n])
            cells.setdefault(why, []).append(np.column_stack([x[three], y[three]]))
        _hatch(panel, cells)
    if triangles is None or len(x) <= FEW:
        size = 4.0 if triangles is not None else 16.0
        panel.scatter(
            x[known], y[known], size, found.value[known], cmap=colours.cmap, norm=_norm(colours),
            edgecolors="black", linewidths=0.3, zorder=3,
        )  # fmt: skip
        panel.plot(x[~known], y[~known], "x", color="#555555", ms=3.0, mew=0.7, zorder=3)
    panel.autoscale_view()


def _triangles(x: FloatArray, y: FloatArray) -> Triangulation | None:
    """Triangles between points; None where they lie on a line, or are too few."""
    points = np.column_stack([x, y])
    span = np.ptp(points, axis=0)
    if len(np.unique(points, axis=0)) < 3 or not (span > 0.0).all():
        return None
    shares = (points - points.min(axis=0)) / span
    if np.linalg.svd(shares - shares.mean(axis=0), compute_uv=False)[1] < FLAT:
        return None
    found = Triangulation(*shares.T)
    return Triangulation(x, y, np.asarray(found.triangles, dtype=np.int64))
