"""Marks on the ground, drawn to scale with their numbers, the peg, the base points and the square."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.text import Text
from matplotlib.textpath import text_to_path

from benchdragon.analysis.marks import Kind, Marks, Trail
from benchdragon.figures.framing import route_positions
from benchdragon.figures.scale import (
    EDGE,
    PAPERS,
    STRIP,
    Sheet,
    corners_of,
    draw_obstacles,
    drawn_sheet,
    needed_scale,
    sheet_for,
)
from benchdragon.figures.style import DISC, HEAD, LEAST_TEXT, ROUTE, STYLE, drawable
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle

# The smallest scale of a chalk plan, and that which its paper should allow if none is chosen.
MOST_CHALK_SCALE, READABLE_SCALE = 500.0, 200.0
# A point of type, mm; the height of digits as a share of their size; around texts and marks, mm.
POINT, DIGIT_HEIGHT, AROUND = 25.4 / 72.0, 0.74, 0.35
# Radius of a mark, mm.
MARK = 0.5
# Marks with round numbers keep theirs first where there is no room for all.
ROUND = (100, 50, 20, 10, 5, 2)
# A mark of another coil is farther from a number than the number's own by this factor.
CLEARER = 1.5
# Names of base points.
BASES = ("B", "C")


@dataclass(frozen=True)
class ChalkDrawing:
    """What is drawn.

    Attributes:
        title: of the dance.
        marks: on the ground.
        trail: what of its route the dragon covers.
        obstacles: the venue's edge and the obstacles in it.
        every: m between marks.
        foot: which plan it is, and when it was checked.
    """

    title: str
    marks: Marks
    trail: Trail
    obstacles: tuple[Obstacle, ...]
    every: float
    foot: str

    def line(self) -> FloatArray:
        """Points of the route under the dragon, m, (n, 2)."""
        return self.trail.route.point(route_positions(self.trail.low, self.trail.high))

    def bounds(self) -> FloatArray:
        """The least and the greatest corner of all of it, m, (2, 2)."""
        spots = [self.marks.points, self.marks.bases, np.array([self.marks.peg])]
        points = np.concatenate([self.line(), *spots, *map(corners_of, self.obstacles)])
        return np.array([points.min(axis=0), points.max(axis=0)])

    def sheet(self, paper: str | None, scale: float | None) -> Sheet:
        """The sheet on a paper at a scale; None for what suits.

        The paper is the smallest from A3 on at which a readable scale, or the one asked for, fits; A4
        where the scale is the same on that.

        Raises:
            InputError: as `sheet_for`.
        """
        bounds, wanted = self.bounds(), scale or READABLE_SCALE
        if paper is None:
            smallest, *others, largest = PAPERS
            paper = next((one for one in others if needed_scale(bounds, one)[0] <= wanted), largest)
            reached = sheet_for(bounds, paper, scale, MOST_CHALK_SCALE)
            if needed_scale(bounds, smallest)[0] > reached.scale:
                return reached
            paper = smallest
        return sheet_for(bounds, paper, scale, MOST_CHALK_SCALE)


def chalk_picture(drawing: ChalkDrawing, sheet: Sheet) -> Figure:
    """Marks, numbers where there is room, peg and base points, route, square, bar and arrow."""
    with drawn_sheet(sheet, drawing.marks.ground) as (figure, axes):
        draw_obstacles(axes, sheet, drawing.obstacles)
        places = sheet.place(drawing.marks.points)
        axes.plot(*sheet.place(drawing.line()).T, color=ROUTE, lw=0.4, zorder=1, label=_("route"))
        _draw_marks(axes, drawing.marks, places)
        spots = _draw_peg(axes, sheet, drawing.marks)
        shown = _write_numbers(axes, drawing, places, spots)
        _write_names(axes, sheet, drawing, shown)
        return figure


def _draw_marks(axes: Axes, marks: Marks, places: FloatArray) -> None:
    kinds = np.array(marks.kinds)
    looks: dict[str, tuple[str, dict[str, Any]]] = {
        "step": (_("mark"), {"marker": "o", "ms": 2.0 * MARK / POINT, "color": "black"}),
        "joint": (
            _("mark where two parts of the route meet"),
            {"marker": "D", "ms": 3.4, "color": DISC},
        ),
        "start": (_("the head's start"), {"marker": "^", "ms": 5.0, "color": HEAD}),
        "end": (_("first and last mark"), {"marker": "s", "ms": 3.8, "color": HEAD}),
    }
    for kind, (label, look) in looks.items():
        some = places[kinds == kind]
        if len(some):
            axes.plot(*some.T, ls="", mew=0.0, zorder=6, label=label, **look)


def _draw_peg(axes: Axes, sheet: Sheet, marks: Marks) -> FloatArray:
    """The peg and the base points, with their names; where they lie, mm, (3, 2)."""
    spots = sheet.place(np.array([marks.peg, *marks.bases.tolist()]))
    axes.plot(*spots[:1].T, ls="", marker="P", ms=6.0, color="black", mec="white", mew=0.5, zorder=7,
              label=_("peg"))  # fmt: skip
    axes.plot(*spots[1:].T, ls="", marker="X", ms=6.0, color="black", mec="white", mew=0.5, zorder=7,
              label=_("base points B and C"))  # fmt: skip
    dots = np.concatenate([sheet.place(marks.points), spots])
    for name, spot in zip((_("peg"), *BASES), spots, strict=True):
        text = axes.text(0.0, 0.0, name, fontsize=9, weight="bold", va="bottom", zorder=8)
        _put_beside(text, spot, dots)
    return spots


def _put_beside(text: Text, spot: FloatArray, dots: FloatArray) -> None:
    """Put a name to that side of a spot where the fewest dots lie under it."""
    wide, tall = text_box(text)[2:] - text_box(text)[:2]
    right, left, above, below = 1.5, -1.5 - wide, 0.0, -tall
    boxes = [
        np.array([x, y, x + wide, y + tall])
        for up in (above, below)
        for aside in (right, left)
        for x, y in [spot + np.array([aside, up])]
    ]
    best = boxes[int(np.argmin([_under(box, dots).sum() for box in boxes]))]
    # text_box keeps 1 mm free below the text.
    text.set_position((float(best[0]), float(best[1]) + 1.0))


def _under(box: FloatArray, dots: FloatArray) -> npt.NDArray[np.bool_]:
    """Which dots a box lies on, (n,)."""
    near = (dots > box[:2] - MARK) & (dots < box[2:] + MARK)
    return np.asarray(near.all(axis=1))


def number_box(text: str, x: float, y: float) -> FloatArray:
    """Left, bottom, right and top of a number about (x, y), mm, with what must stay free around it."""
    properties = FontProperties(family=STYLE["font.family"], size=LEAST_TEXT)
    width = text_to_path.get_text_width_height_descent(text, properties, ismath=False)[0]
    half = 0.5 * POINT * np.array([width, DIGIT_HEIGHT * LEAST_TEXT]) + AROUND
    return np.array([x - half[0], y - half[1], x + half[0], y + half[1]])


def text_box(text: Text) -> FloatArray:
    """Left, bottom, right and top of a text that stands at its lower left or middle, mm."""
    width, height, _below = text_to_path.get_text_width_height_descent(
        text.get_text(), text.get_fontproperties(), ismath=False
    )
    x, y = text.get_position()
    left = x - (0.5 * POINT * width if text.get_horizontalalignment() == "center" else 0.0)
    return np.array([left, y - 1.0, left + POINT * width, y + POINT * height + 1.0])


def _write_numbers(axes: Axes, drawing: ChalkDrawing, places: FloatArray, spots: FloatArray) -> int:
    """Numbers beside their marks where none overlaps a mark, another number or a name; how many."""
    marks = drawing.marks
    known = [*(text_box(text) for text in axes.texts), *np.hstack([spots - MARK, spots + MARK])]
    taken = np.full((len(known) + len(marks), 4), np.inf)
    taken[: len(known)] = known
    ways, count, shown = _ways(drawing), len(known), 0
    for n in sorted(range(len(marks)), key=lambda n: _rank(marks.kinds[n], n + 1)):
        for box in _candidates(str(n + 1), places[n], ways[n]):
            if _free(box, taken[:count]) and _is_told(box, places, n, marks.kinds[n]):
                taken[count] = box
                count, shown = count + 1, shown + 1
                x, y = 0.5 * (box[:2] + box[2:])
                low = y - 0.5 * POINT * DIGIT_HEIGHT * LEAST_TEXT
                axes.text(x, low, str(n + 1), ha="center", va="baseline", fontsize=LEAST_TEXT, zorder=8)
                break
    return shown


def _ways(drawing: ChalkDrawing) -> FloatArray:
    """Unit vectors along the route at the marks, (M, 2)."""
    headings = drawing.trail.route.heading(drawing.marks.s)
    return np.column_stack([np.cos(headings), np.sin(headings)])


def _rank(kind: str, number: int) -> tuple[int, int]:
    if kind != "step":
        return -1, number
    return next((n for n, step in enumerate(ROUND) if number % step == 0), len(ROUND)), number


def _candidates(text: str, place: FloatArray, way: FloatArray) -> list[FloatArray]:
    """Boxes of a number to the left and the right of the route, straight and aslant."""
    x, y = place.tolist()
    half = 0.5 * (number_box(text, x, y)[2:] - number_box(text, x, y)[:2])
    left = np.array([-way[1], way[0]])
    found = []
    for side in (left, -left, left + way, -left + way, left - way, -left - way):
        aside = side / np.hypot(*side)
        # As near as leaves the mark free: out of the box through whichever edge is left first.
        reach = float(np.min((half + MARK) / np.maximum(np.abs(aside), 1e-9)))
        found.append(number_box(text, *(place + 1.01 * reach * aside)))
    return found


def _free(box: FloatArray, taken: FloatArray) -> bool:
    over = (box[:2] < taken[:, 2:]) & (taken[:, :2] < box[2:])
    return not over.all(axis=1).any()


def _is_told(box: FloatArray, places: FloatArray, n: int, kind: Kind) -> bool:
    """Whether a number identifies mark n: nearest to it by a clear distance, the next mark aside.

    Marks with a symbol of their own only need to stay visible.
    """
    if kind != "step":
        return not bool(_under(box, places).any())
    off = np.maximum(np.maximum(box[:2] + AROUND - places, places - box[2:] + AROUND), 0.0)
    apart = np.hypot(off[:, 0], off[:, 1])
    further = np.abs(np.arange(len(places)) - n) > 1
    needed = np.where(further, CLEARER, 1.0) * apart[n]
    return bool((apart >= needed).all())


def _write_names(axes: Axes, sheet: Sheet, drawing: ChalkDrawing, shown: int) -> None:
    """Title, what is drawn, and the legend."""
    text = _("{count} marks, each {every} m; 1:{scale}; {shown} of them with numbers; plan {foot}")
    text = text.format(
        count=len(drawing.marks), every=f"{drawing.every:g}", scale=f"{sheet.scale:g}", shown=shown,
        foot=drawing.foot,
    )  # fmt: skip
    axes.text(EDGE, EDGE + 7.0, drawable(drawing.title), fontsize=9, va="bottom")
    axes.text(EDGE, EDGE + 1.0, text, fontsize=8, va="bottom")
    corner = 1.0 - 26.0 / sheet.width, (EDGE + STRIP - 1.0) / sheet.height
    legend = axes.legend(
        loc="upper right", bbox_to_anchor=corner, ncols=2, frameon=False, fontsize=7.5,
        borderaxespad=0.0,
    )  # fmt: skip
    legend.set_zorder(7)
