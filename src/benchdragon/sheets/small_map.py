"""A small map of a dance on a PDF page: the square, the route, and the tracks of some benches."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from fpdf import FPDF
from shapely.geometry import LinearRing, LineString, box

from benchdragon.analysis.findings import shown_name
from benchdragon.export.typeset import BREAK, breakable
from benchdragon.figures.scale import corners_of
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle
from benchdragon.sheets.briefing import Briefing

# Points of the route at most; lines keep within FINE (mm of paper) of them.
MOST_POINTS, FINE = 20_000, 0.05
# Widths of lines and sizes of marks, mm.
THIN, EDGE, BOLD, MARK = 0.15, 0.35, 0.9, 1.5
# Width of maps, mm, on which they are as wide as that.
LARGE = 120.0
# Room for the legend below, the arrow in the corner, and around all, mm.
LEGEND, ARROW, AROUND = 6.5, 12.0, 2.5
# Size of type of names, points; of an obstacle's name so many signs at most; a cross's arm, mm.
NAMES, MOST_SIGNS, CROSS = 7.0, 16, 1.4
# A map beside whose arrow it stands is as tall as that, mm.
LEAST = 25.0
# Height of signs above their line, mm, for each point of their size.
TALL = 0.36
# By this share of the width of the last way each before it on a map is broader.
BROADER = 0.9
# Every so manyth bench is numbered, where numbers are so far apart, mm.
NUMBERED, NUMBER_ROOM = (1, 2, 5, 10, 20, 50, 100, 200, 500), 5.0
GREY, STONE = (150, 150, 150), (205, 205, 205)
# Okabe and Ito's colours, told apart by colour-blind people too.
TRACKS = ((213, 94, 0), (0, 114, 178), (0, 158, 115), (204, 121, 167))


@dataclass(frozen=True)
class Frame:
    """A rectangle on a page, mm, from its upper left corner."""

    x: float
    y: float
    width: float
    height: float

    @property
    def corners(self) -> tuple[float, float, float, float]:
        """Left, top, right and bottom, mm."""
        return self.x, self.y, self.x + self.width, self.y + self.height


@dataclass(frozen=True)
class _Scale:
    """From metres to millimetres of a page, y upwards to y downwards."""

    frame: Frame
    centre: FloatArray
    scale: float

    def __call__(self, points: FloatArray) -> list[tuple[float, float]]:
        middle = (self.frame.x + self.frame.width / 2.0, self.frame.y + self.frame.height / 2.0)
        moved = (np.atleast_2d(points) - self.centre) * (self.scale, -self.scale) + middle
        return [(float(x), float(y)) for x, y in moved]


class SmallMap:
    """The map of a dance: what all sheets show is computed once."""

    def __init__(self, briefing: Briefing) -> None:
        report = briefing.report
        self._obstacles = report.plan.obstacles()
        self._entrances = report.plan.event.entrances
        self._ground = briefing.ground
        self._walk = report.walk
        self._called = briefing.called
        self._counted = report.plan.people.count_head
        ends = report.walk.motion([report.start, report.end]).s
        self._first, self._last = ends[0], ends[1]

    @cached_property
    def _way(self) -> tuple[FloatArray, FloatArray]:
        """Route positions, and their points, from where the tail starts to where the head ends."""
        low, high = float(self._first.min()), float(self._last.max())
        count = min(max(math.ceil((high - low) / 0.05), 2), MOST_POINTS)
        s = np.linspace(low, high, count)
        return s, self._walk.route.point(s)

    @cached_property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """The lower left and the upper right corner of all that is shown, m."""
        peg = np.array([self._ground.peg])
        doors = np.array(self._entrances, dtype=float).reshape(-1, 2)
        points = np.concatenate([self._way[1], peg, doors, *map(corners_of, self._obstacles)])
        return points.min(axis=0), points.max(axis=0)

    def draw(self, pdf: FPDF, frame: Frame, benches: Sequence[int], names: Sequence[str]) -> None:
        """Draw into a frame, with the tracks of benches and their names."""
        place = self._scaled(frame)
        with pdf.local_context():
            self._square(pdf, place)
            for n, bench in enumerate(benches):
                # Ways lie on one another: the first are the broadest, so that all are seen.
                bold = 1.0 + BROADER * (len(benches) - 1 - n)
                pdf.set_draw_color(*TRACKS[n % len(TRACKS)])
                pdf.set_fill_color(*TRACKS[n % len(TRACKS)])
                self._track(pdf, place, bench, bold)
            if len(benches) > 1:
                self._call(pdf, place, benches, names)
            self._names(pdf, place)
            self._arrow(pdf, frame)
        self._legend(pdf, frame, moves=any(self._last[n - 1] > self._first[n - 1] for n in benches))

    def draw_starts(self, pdf: FPDF, frame: Frame) -> None:
        """Draw into a frame, with a dot where each bench starts, and as many numbers as find room."""
        place = self._scaled(frame)
        dots = place(self._walk.route.point(self._first[:-1]))
        with pdf.local_context():
            self._square(pdf, place)
            pdf.set_fill_color(*TRACKS[0])
            for x, y in dots:
                pdf.circle(x, y, 0.6, style="F")
            self._names(pdf, place)
            self._arrow(pdf, frame)
        apart = place.scale * float(np.abs(np.diff(self._first)).min(initial=1e3))
        each = next((n for n in NUMBERED if n * apart >= NUMBER_ROOM), NUMBERED[-1])
        pdf.set_font("Noto", "B", 7)
        for bench, (x, y) in enumerate(dots, start=1):
            number = bench if self._counted else bench - 1
            said = str(number) if number % each == 0 else ""
            if bench in (1, len(dots)) and not self._counted:
                said = self._called(bench)
            left = x - 0.9 - pdf.get_string_width(said)
            pdf.text(*self._beside_edge(pdf, place, said, [(x + 0.9, y - 0.6), (left, y - 0.6)]), said)

    def as_tall_as_needed(self, frame: Frame) -> Frame:
        """The same frame, no taller than its width lets the map be."""
        wide, tall = np.maximum(self.bounds[1] - self.bounds[0], 1e-3).tolist()
        needed = (frame.width - ARROW - 2.0 * AROUND) * tall / wide + LEGEND + 2.0 * AROUND
        return Frame(frame.x, frame.y, frame.width, min(frame.height, max(needed, LEAST)))

    def _square(self, pdf: FPDF, place: _Scale) -> None:
        """What all maps show: venue, obstacles, route."""
        for obstacle in self._obstacles:
            self._stand(pdf, place, obstacle)
        pdf.set_draw_color(*GREY)
        pdf.set_line_width(THIN)
        self._line(pdf, place, self._way[1])

    def _names(self, pdf: FPDF, place: _Scale) -> None:
        """Draw the peg, entrances, and names of obstacles, within the map."""
        pdf.set_draw_color(0)
        pdf.set_fill_color(0)
        pdf.set_font("Noto", "", NAMES)
        ((x, y),) = place(np.array([self._ground.peg]))
        pdf.set_line_width(EDGE)
        _cross(pdf, x, y)
        self._name(pdf, place, _("peg"), x, (y - CROSS - 0.6, y + CROSS + 0.6 + TALL * NAMES))
        for n, (x, y) in enumerate(
            place(np.array(self._entrances)) if self._entrances else [], start=1
        ):
            pdf.circle(x, y, CROSS, style="D")
            ends = y - CROSS - 0.6, y + CROSS + 0.6 + TALL * NAMES
            self._name(pdf, place, _("entrance {n}").format(n=n), x, ends)
        for one in self._obstacles:
            if one.kind != "venue":
                points = place(one.outline)
                heights, wide = [v for _u, v in points], one.radius * place.scale
                middle = sum(u for u, _v in points) / len(points)
                ends = min(heights) - wide - 0.8, max(heights) + wide + 0.8 + TALL * NAMES
                self._name(pdf, place, shown_name(one)[:MOST_SIGNS], middle, ends)

    def _name(
        self, pdf: FPDF, place: _Scale, name: str, x: float, heights: tuple[float, float]
    ) -> None:
        """A name above a place, moved so that it stays on the map; below it, if the edge is above."""
        said = breakable(name).replace(BREAK, "")
        wide, frame = pdf.get_string_width(said), place.frame
        left = min(max(x - 0.5 * wide, frame.x), max(frame.x + frame.width - wide, frame.x))
        venue = [place(one.outline) for one in self._obstacles if one.kind == "venue"]
        for points in venue:  # a name over the edge at its side moves in
            low, high = min(u for u, _v in points) + 0.6, max(u for u, _v in points) - 0.6 - wide
            left = min(max(left, low), high) if low <= high else left
        above, below = heights
        wanted = [(left, max(above, frame.y + 0.35 * NAMES)), (left, below)]
        pdf.text(*self._beside_edge(pdf, place, said, wanted), said)

    def _beside_edge(
        self, pdf: FPDF, place: _Scale, said: str, wanted: Sequence[tuple[float, float]]
    ) -> tuple[float, float]:
        """The first of places for a text at which the venue's edge does not run through it."""
        wide, tall = pdf.get_string_width(said), TALL * pdf.font_size_pt
        edges = self._edges(place)
        return next(
            (
                (x, y)
                for x, y in wanted
                if not any(edge.intersects(box(x, y - tall, x + wide, y + 0.4)) for edge in edges)
            ),
            wanted[0],
        )

    def _edges(self, place: _Scale) -> list[LinearRing]:
        """The venue's edge on the page, if there is one."""
        return [LinearRing(place(one.outline)) for one in self._obstacles if one.kind == "venue"]

    def _scaled(self, frame: Frame) -> _Scale:
        low, high = self.bounds
        inner = Frame(
            frame.x + AROUND, frame.y + AROUND,
            frame.width - ARROW - 2.0 * AROUND, frame.height - LEGEND - 2.0 * AROUND,
        )  # fmt: skip
        wide, tall = np.maximum(high - low, 1e-3)
        return _Scale(inner, (low + high) / 2.0, min(inner.width / wide, inner.height / tall))

    @staticmethod
    def _line(pdf: FPDF, place: _Scale, points: FloatArray) -> None:
        line = LineString(points).simplify(FINE / place.scale)
        pdf.polyline(place(np.asarray(line.coords)))

    def _stand(self, pdf: FPDF, place: _Scale, obstacle: Obstacle) -> None:
        """The venue's edge, or an obstacle."""
        pdf.set_draw_color(0)
        pdf.set_line_width(EDGE)
        pdf.set_fill_color(*STONE)
        points = place(obstacle.outline)
        if obstacle.kind == "circle":
            (x, y), radius = points[0], obstacle.radius * place.scale
            pdf.circle(x, y, radius, style="DF")
        elif obstacle.kind == "line":
            pdf.polyline(points)
        else:
            pdf.polygon(points, style="D" if obstacle.kind == "venue" else "DF")

    def _track(self, pdf: FPDF, place: _Scale, bench: int, bold: float) -> None:
        """The way of a bench's front handle: a disc where it starts, an arrow's head where it ends."""
        s, points = self._way
        first, last = self._first[bench - 1], self._last[bench - 1]
        ends = self._walk.route.point([first, last])
        own = np.concatenate([ends[:1], points[(s > first) & (s < last)], ends[1:]])
        pdf.set_line_width(bold * BOLD * self._share(place))
        self._line(pdf, place, own)
        (x, y), (u, v) = place(ends)
        heading = float(self._walk.route.heading([last])[0])
        pdf.set_line_width(THIN)
        pdf.circle(x, y, MARK * self._share(place), style="F")
        _arrow_head(pdf, u, v, heading, self._share(place))

    def _call(self, pdf: FPDF, place: _Scale, benches: Sequence[int], names: Sequence[str]) -> None:
        """Draw names of benches, on white beside where each starts, and beside one another."""
        tall, size = TALL * pdf.font_size_pt, MARK * self._share(place)
        starts = place(self._walk.route.point(self._first[np.array(benches) - 1]))
        taken = [box(x - size, y - size, x + size, y + size) for x, y in starts]
        edges = self._edges(place)
        room = box(*place.frame.corners).buffer(AROUND)
        for n, ((x, y), name) in enumerate(zip(starts, names, strict=True)):
            wide, off = pdf.get_string_width(name), MARK + 0.5
            spots = [
                (x + aside, y + up * tall) for up in (0.3, -1.0, 1.6) for aside in (off, -wide - off)
            ]
            areas = [box(left - 0.3, up - tall, left + wide + 0.3, up + 0.5) for left, up in spots]
            inside = [not any(map(one.intersects, edges)) and room.contains(one) for one in areas]
            free = [not any(map(one.intersects, taken)) for one in areas]
            k = max(range(len(areas)), key=lambda k: (free[k], inside[k], -k))
            taken.append(areas[k])
            left, top, right, bottom = areas[k].bounds
            pdf.set_fill_color(255)
            pdf.rect(left, top, right - left, bottom - top, style="F")
            pdf.set_text_color(*TRACKS[n % len(TRACKS)])
            pdf.text(*spots[k], name)
        pdf.set_text_color(0)
        for n, (x, y) in enumerate(starts):  # that no white lies on them
            pdf.set_fill_color(*TRACKS[n % len(TRACKS)])
            pdf.circle(x, y, size, style="F")

    @staticmethod
    def _share(place: _Scale) -> float:
        """How large marks are on small maps."""
        return min(1.0, max(0.6, place.frame.width / LARGE))

    def _arrow(self, pdf: FPDF, frame: Frame) -> None:
        """An arrow the way y points, and what is there."""
        x, y = frame.x + frame.width - ARROW / 2.0, frame.y + AROUND + 2.0
        pdf.set_line_width(EDGE)
        heading, middle = 0.5 * math.pi + self._ground.turned, y + 5.0
        ahead, left = 4.0 * math.cos(heading), 4.0 * math.sin(heading)
        pdf.line(x - ahead, middle + left, x + 0.75 * ahead, middle - 0.75 * left)
        _arrow_head(pdf, x + ahead, middle - left, heading)
        pdf.set_font("Noto", "B", 8)
        pdf.set_xy(x - ARROW / 2.0, y + 9.5)
        pdf.cell(ARROW, 3.5, self._ground.y_word, align="C")

    @staticmethod
    def _legend(pdf: FPDF, frame: Frame, *, moves: bool) -> None:
        """What the marks mean that are there."""
        y = frame.y + frame.height - LEGEND + 2.0
        pdf.set_font("Noto", "", 7.5)
        pdf.set_fill_color(*TRACKS[0])
        x = frame.x + AROUND + MARK
        pdf.circle(x, y, MARK * 0.8, style="F")
        pdf.set_xy(x + 2.0, y - 2.0)
        text = _("you start here")
        pdf.cell(pdf.get_string_width(text) + 3.0, 4.0, text)
        if moves:
            x = pdf.get_x() + 3.0
            _arrow_head(pdf, x, y, 0.0)
            pdf.set_xy(x + 3.0, y - 2.0)
            pdf.cell(0, 4.0, _("you end here"))
        pdf.set_fill_color(0)


def _cross(pdf: FPDF, x: float, y: float) -> None:
    """A cross, as the chalk plan marks the peg."""
    pdf.line(x - CROSS, y, x + CROSS, y)
    pdf.line(x, y - CROSS, x, y + CROSS)


def _arrow_head(pdf: FPDF, x: float, y: float, heading: float, share: float = 1.0) -> None:
    """A filled arrow's head about a point of the page, pointing to a heading (rad, y upwards)."""
    corners = [(1.4, 0.0), (-1.0, 1.1), (-1.0, -1.1)]
    cos, sin = math.cos(heading), math.sin(heading)
    size = MARK * share
    pdf.polygon(
        [(x + size * (a * cos - b * sin), y - size * (a * sin + b * cos)) for a, b in corners],
        style="F",
    )
