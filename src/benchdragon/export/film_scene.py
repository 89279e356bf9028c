"""The dance as films, stills and contact sheets show it: layout, colours, what moves and what stays.

All sizes of the layout are units: a 1080th of the height or a 1920th of the width of a picture,
whichever is less, so that a picture of any size shows the same things.
"""

import math
from dataclasses import dataclass, replace
from typing import Any, Self

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Rectangle
from matplotlib.text import Text
from matplotlib.transforms import Affine2D, Transform

from benchdragon.analysis.distance import TOUCHING, Nearness, tightest_pairs, touching
from benchdragon.analysis.findings import touch_text
from benchdragon.analysis.obstacle_distance import box_distances
from benchdragon.analysis.swept import drawn_ground
from benchdragon.errors import InputError, positive
from benchdragon.figures.framing import Area, Framing, framing, inset
from benchdragon.figures.square import draw_square, square_corners
from benchdragon.figures.style import BODY, DISC, HEAD, ROUTE, STYLE, drawable, named_figure
from benchdragon.figures.walk import MOST_BENCHES, Overview, disc_corners, route_points
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Motion, Walk

# Pixels of a side: fewer could not be read, more no player shows.
LEAST_SIDE, MOST_SIDE = 64, 4096
# Okabe and Ito's yellow, for benches that touch; they are hatched too.
TOUCH = "#F0E442"
UNITS_WIDE, UNITS_HIGH = 1920.0, 1080.0
MARGIN, HEADER, FOOTER, GAP = 40.0, 76.0, 72.0, 36.0
TITLE, PLAIN, NAME, LEAST_TEXT = 34.0, 28.0, 22.0, 16.0
# Widest scale bar, where the legend begins, and how far its entries and its words stand off.
LONGEST_BAR, LEGEND, SWATCH, WORD = 240.0, 440.0, 46.0, 12.0
# Across the marks of the head's handle and of the tightest pair; their least share in small views.
NOSE, RING, LEAST_MARK = 13.0, 34.0, 0.4
# Line about a bench, as a share of its width.
OUTLINE = 0.06
# The route is drawn on past the dragon by so many times what it covers: beyond the edges of a picture
# that is twice as wide as high, on a spiral.
AHEAD = 3.5
# About all that is seen, m; corners that an overview may take, as `framing.inset` has them.
ROOM, CORNERS = 0.2, ((0, 0), (1, 0), (0, 1), (1, 1))
# Metres across a picture that follows a bench, if none are given.
SPAN = 12.0


@dataclass(frozen=True)
class Theme:
    """Colours of the ground, of words and lines on it, and of the route."""

    paper: str
    ink: str
    route: str


THEMES = {"light": Theme("#FFFFFF", "#1A1A1A", ROUTE), "dark": Theme("#14171C", "#ECECEC", "#70767F")}


@dataclass(frozen=True)
class Look:
    """How the dance is shown.

    Args:
        size: width and height, pixels, even numbers.
        theme: "light" or "dark".
        follow: number of a bench, 1..N, that stays in the middle; None: all is seen at once.
        span: metres across the picture where a bench is followed.
    """

    size: tuple[int, int] = (1920, 1080)
    theme: str = "light"
    follow: int | None = None
    span: float = SPAN

    def __post_init__(self) -> None:
        if any(side % 2 or not LEAST_SIDE <= side <= MOST_SIDE for side in self.size):
            text = _("a size is two even numbers from {least} to {most}, not {width}x{height}")
            raise InputError(
                text.format(least=LEAST_SIDE, most=MOST_SIDE, width=self.size[0], height=self.size[1])
            )
        if self.theme not in THEMES:
            text = _("theme must be one of {known}, not {theme}")
            raise InputError(text.format(known=", ".join(THEMES), theme=self.theme))
        positive("span", self.span, "m")

    @property
    def unit(self) -> float:
        """Pixels in a unit of the layout."""
        return min(self.size[0] / UNITS_WIDE, self.size[1] / UNITS_HIGH)


@dataclass(frozen=True)
class Place:
    """What stays where it is.

    Attributes:
        route: points of the route, m, (n, 2).
        centre: of the disc, m.
        disc: its radius, m.
        bench_width: of most benches, m.
        framed: what is to be seen.
        obstacles: on the square, the venue's edge included.
        ground: outlines of the ground that the dance covers.
    """

    route: FloatArray
    centre: tuple[float, float]
    disc: float | None
    bench_width: float
    framed: Framing
    obstacles: tuple[Obstacle, ...] = ()
    ground: tuple[FloatArray, ...] = ()

    @classmethod
    def of(
        cls, walk: Walk, motion: Motion, disc: float | None, obstacles: tuple[Obstacle, ...] = ()
    ) -> Self:
        """The place of a walk: all that the dragon covers from the first to the last of its times.

        Raises:
            InputError: for a dragon of more benches than a picture shows.
            WalkError: if it cannot stand at one of the times.
        """
        if len(walk.dragon) > MOST_BENCHES:
            text = _("a picture shows at most {most} benches, not {count}")
            raise InputError(text.format(most=MOST_BENCHES, count=len(walk.dragon)))
        motion.check()
        tail, head = float(motion.s.min()), float(motion.s.max())
        dragon, route = walk.dragon, walk.route
        framed = framing(
            route,
            np.array([[tail, head]]),
            float(dragon.sizes[1:].max()) + ROOM,
            [*disc_corners(route, disc), *square_corners(obstacles)],
            float(dragon.length.max()),
        )
        seen = route_points(route, tail, min(route.length, head + AHEAD * (head - tail)))
        width, (first, last) = float(np.median(dragon.width)), motion.times[[0, -1]].tolist()
        ground = drawn_ground(walk, min(first, last), max(first, last)) if obstacles else ()
        return cls(seen, route.centre, disc, width, framed, obstacles, ground)


@dataclass(frozen=True)
class Box:
    """A rectangle of the layout, in units from the lower left."""

    left: float
    bottom: float
    width: float
    height: float


# Left, bottom, width and height, as shares of a figure.
Share = tuple[float, float, float, float]


class Panel:
    """One view of the ground, and the dragon that moves in it.

    Args:
        figure: that it is a part of.
        box: where.
        look: how.
        place: what stays.
    """

    def __init__(self, figure: Figure, box: Box, look: Look, place: Place) -> None:
        self.box, self.look, self.obstacles = box, look, place.obstacles
        wide, high = (side / look.unit for side in look.size)
        share = (box.left / wide, box.bottom / high, box.width / wide, box.height / high)
        self.axes: Axes = figure.add_axes(share)
        self.axes.set_axis_off()
        self.framed, aspect = place.framed, box.width / box.height
        if look.follow is None:
            self._look_at(self.framed.frame(aspect, np.empty((0, 2))))
        else:
            self._look_at(Area((0.0, 0.0), look.span, look.span / aspect))
        self.scale = box.width / self.frame.width  # units in a metre
        ink = THEMES[look.theme].ink
        # Thin lines about benches that are drawn small, small marks in small views.
        outline = min(0.8, OUTLINE * place.bench_width * self.scale)
        mark = min(1.0, max(LEAST_MARK, box.height / UNITS_HIGH))
        self._draw_place(place, mark)
        self.body = PolyCollection([], fc=BODY, ec="black", lw=outline, zorder=3)
        self.touching = PolyCollection([], fc=TOUCH, ec="black", lw=outline, hatch="xx", zorder=4)
        self.head = PolyCollection([], fc=HEAD, ec="black", lw=outline, zorder=5)
        self.nose, self.ring = (
            Line2D([], [], marker="o", ms=size * mark, mfc=face, mec=ink, mew=2.0 * mark, zorder=6)
            for size, face in ((NOSE, HEAD), (RING, "none"))
        )
        for benches in (self.body, self.touching, self.head):
            self.axes.add_collection(benches, autolim=False)
        for line in (self.nose, self.ring):
            self.axes.add_line(line)
        self.overview, self.words = self._overview(figure, share, place.route), ""

    def _overview(self, figure: Figure, share: Share, route: FloatArray) -> Overview | None:
        """A small picture of all in a corner, where the view is cut."""
        if self.look.follow is not None or not self.framed.cut(self.frame.width / self.frame.height):
            return None
        ground, (left, bottom, width, height) = inset(self.framed, self.frame, route, CORNERS)
        x, y, wide, high = share
        place = (x + left * wide, y + bottom * high, width * wide, height * high)
        theme = THEMES[self.look.theme]
        axes = figure.add_axes(place, facecolor=theme.paper, zorder=1)
        return Overview(axes, ground, route, theme.route, theme.ink)

    @property
    def moving(self) -> list[Artist]:
        """All that `show` changes, as it is drawn from below to above."""
        overview = [] if self.overview is None else [self.overview.axes]
        return [self.body, self.touching, self.head, self.nose, self.ring, *overview]

    def _draw_place(self, place: Place, mark: float) -> None:
        theme = THEMES[self.look.theme]
        self.axes.add_line(Line2D(*place.route.T, color=theme.route, lw=1.2 * mark, zorder=1))
        draw_square(
            self.axes, place.obstacles, ground=place.ground, ink=theme.ink, paper=theme.paper,
            mark=2.0 * mark, size=max(LEAST_TEXT, NAME * mark),
        )  # fmt: skip
        if place.disc is not None:
            self.axes.add_patch(
                Circle(place.centre, place.disc, fill=False, ec=DISC, lw=2.5 * mark, ls="--", zorder=2)
            )

    def _look_at(self, frame: Area) -> None:
        self.frame = frame
        self.axes.set(xlim=frame.limits[0], ylim=frame.limits[1])

    def show(self, motion: Motion, index: int) -> None:
        """Move the dragon to time number `index`; `words` tell what it touches, or its tightest pair.

        Raises:
            WalkError: if it cannot stand then.
        """
        corners: Any = motion[index].corners()[0]
        nearest = next(iter(tightest_pairs(motion, index)), None)
        meet = np.zeros(len(corners), dtype=bool)
        if nearest is not None and nearest.distance <= TOUCHING:
            meet[touching(motion, index)] = True
        self.words = near_text(nearest)
        for obstacle in self.obstacles:
            distances, _which = box_distances(motion, index, obstacle)
            touches = distances <= obstacle.radius + TOUCHING
            if touches.any():
                self.words = drawable(touch_text(int(touches.argmax()) + 1, obstacle))
            meet |= touches
        self.head.set_verts(corners[:1][~meet[:1]])
        self.body.set_verts(corners[1:][~meet[1:]])
        self.touching.set_verts(corners[meet])
        self.nose.set_data(motion.x[index, :1], motion.y[index, :1])
        middle = np.empty((0, 2)) if nearest is None else np.mean(nearest.points, axis=0)[np.newaxis]
        self.ring.set_data(*middle.T)
        if self.look.follow is None:
            handles = np.stack([motion.x[index], motion.y[index]], axis=-1)
            self._look_at(self.framed.frame(self.frame.width / self.frame.height, handles))
        else:
            followed = tuple(corners[self.look.follow - 1].mean(axis=0).tolist())
            self._look_at(replace(self.frame, middle=followed))
        if self.overview is not None:
            self.overview.show(motion, index, self.frame)


class Layout:
    """A figure with the title above, scale bar and legend below, and words of ours about it.

    Args:
        look: how.
        title: above all.
    """

    def __init__(self, look: Look, title: str) -> None:
        self.look, self.theme = look, THEMES[look.theme]
        self.wide, self.high = (side / look.unit for side in look.size)
        # A hundredth of a pixel more: before matplotlib 3.11 sizes are rounded down.
        inches = [(side + 0.01) / (72.0 * look.unit) for side in look.size]
        self.figure = named_figure(inches[0], inches[1], "")
        self.figure.set_layout_engine("none")
        self.figure.set_dpi(72.0 * look.unit)
        self.figure.set_facecolor(self.theme.paper)
        self.canvas: Any = FigureCanvasAgg(self.figure)  # matplotlib says no types of it
        self.units: Transform = Affine2D().scale(1.0 / 72.0) + self.figure.dpi_scale_trans
        self.top = self.high - 0.5 * HEADER
        self.title = drawable(" ".join(title.split()))

    def write(self, x: float, y: float, words: str, size: float, align: str = "left") -> Text:
        """Words at a place, in units."""
        text = Text(
            x, y, words, color=self.theme.ink, fontsize=size, ha=align, va="center_baseline",
            transform=self.units,
        )  # fmt: skip
        self.figure.add_artist(text)
        return text

    def width(self, text: Text) -> float:
        """How wide words are, in units."""
        return float(text.get_window_extent(self.canvas.get_renderer()).width) / self.look.unit

    def write_title(self, room: float) -> None:
        """The title, in smaller letters, and then cut short, where there is too little room."""
        words, size = self.title, TITLE
        text = self.write(MARGIN, self.top, words, size)
        while (wide := self.width(text)) > room and words:
            if size > LEAST_TEXT:
                size = max(LEAST_TEXT, 0.99 * size * room / wide)
                text.set_fontsize(size)
            else:
                words = words[: min(int(len(words) * room / wide), len(words) - 1)]
                text.set_text(words.rstrip("\\ ") + "…")

    def draw_scale_bar(self, scale: float) -> None:
        """A bar of a round length, for a scale in units a metre."""
        metres = round_length(LONGEST_BAR / scale)
        length, y = metres * scale, 0.5 * FOOTER
        for x, line in (
            ([MARGIN, MARGIN + length], [y, y]),
            ([MARGIN, MARGIN], [y - 8.0, y + 8.0]),
            ([MARGIN + length] * 2, [y - 8.0, y + 8.0]),
        ):
            bar = Line2D(x, line, color=self.theme.ink, lw=3.0, transform=self.units)
            self.figure.add_artist(bar)
        self.write(MARGIN + length + WORD, y, _("{length} m").format(length=f"{metres:g}"), PLAIN)

    def draw_legend(self) -> float:
        """What the colours and marks mean; where it ends, in units."""
        x, y = LEGEND, 0.5 * FOOTER
        for colour, hatch, name in ((HEAD, "", _("head")), (TOUCH, "xx", _("touching"))):
            patch = Rectangle(
                (x, y - 9.0), SWATCH, 18.0, fc=colour, ec="black", lw=0.8, hatch=hatch,
                transform=self.units,
            )  # fmt: skip
            self.figure.add_artist(patch)
            text = self.write(x + SWATCH + WORD, y, name, PLAIN)
            x += SWATCH + WORD + self.width(text) + 3.0 * WORD
        ring = Line2D(
            [x + 14.0], [y], marker="o", ms=26.0, mfc="none", mec=self.theme.ink, mew=2.5,
            transform=self.units,
        )  # fmt: skip
        self.figure.add_artist(ring)
        return x + 28.0 + WORD


class Scene(Layout):
    """A picture of the whole dance at one time, for films and stills.

    Args:
        look: how.
        place: what stays.
        title: above all.
        pace: said beside the clock, for example how much faster a film is than the dance.
    """

    def __init__(self, look: Look, place: Place, title: str, pace: str = "") -> None:
        with matplotlib.rc_context(STYLE):
            super().__init__(look, title)
            box = Box(0.0, FOOTER, self.wide, self.high - HEADER - FOOTER)
            self.panel = Panel(self.figure, box, look, place)
            right = self.wide - MARGIN
            self.clock = self.write(right, self.top, clock_text(-99999.9), TITLE, "right")
            left = right - self.width(self.clock) - 3.0 * WORD
            if pace:
                left -= self.width(self.write(left, self.top, pace, PLAIN, "right")) + 3.0 * WORD
            self.write_title(left - MARGIN)
            self.draw_scale_bar(self.panel.scale)
            self.near = self.write(self.draw_legend(), 0.5 * FOOTER, "", PLAIN)

    def show(self, motion: Motion, index: int) -> None:
        """Move the dragon and the clock to time number `index`.

        Raises:
            WalkError: if the dragon cannot stand then.
        """
        self.panel.show(motion, index)
        self.clock.set_text(clock_text(float(motion.times[index])))
        self.near.set_text(self.panel.words)


class MovingScene(Scene):
    """A scene that gives its pixels: what stays is drawn once, and laid under what moves.

    It is drawn again where the view moves.
    """

    def __init__(self, look: Look, place: Place, title: str, pace: str = "") -> None:
        super().__init__(look, place, title, pace)
        self._moving: list[Artist] = [*self.panel.moving, self.clock, self.near]
        for artist in self._moving:
            artist.set_animated(True)
        self._draw_still()

    def _draw_still(self) -> None:
        self.canvas.draw()
        self._still, self._seen = self.canvas.copy_from_bbox(self.figure.bbox), self.panel.frame

    def frame(self, motion: Motion, index: int) -> memoryview:
        """The pixels at time number `index`, red, green, blue, opacity, row by row from above.

        The next frame is drawn over them.

        Raises:
            WalkError: if the dragon cannot stand then.
        """
        self.show(motion, index)
        if self.panel.frame == self._seen:
            self.canvas.restore_region(self._still)
        else:
            self._draw_still()
        for artist in self._moving:
            self.figure.draw_artist(artist)
        pixels: memoryview = self.canvas.buffer_rgba()
        return pixels


def sheet(look: Look, place: Place, title: str, motion: Motion, columns: int, rows: int) -> Figure:
    """All times of a motion side by side, row by row, to one scale.

    Raises:
        WalkError: if the dragon cannot stand at one of them.
    """
    with matplotlib.rc_context(STYLE):
        layout = Layout(look, title)
        layout.write_title(layout.wide - 2.0 * MARGIN)
        width = (layout.wide - 2.0 * MARGIN - (columns - 1) * GAP) / columns
        height = (layout.high - HEADER - FOOTER - (rows - 1) * GAP) / rows
        size = min(PLAIN, 0.06 * width)
        captions, scale = [], 1.0
        for index, t in enumerate(motion.times.tolist()):
            row, column = divmod(index, columns)
            left = MARGIN + column * (width + GAP)
            bottom = FOOTER + (rows - 1 - row) * (height + GAP)
            panel = Panel(layout.figure, Box(left, bottom, width, height - 1.6 * size), look, place)
            panel.show(motion, index)
            scale = panel.scale
            y = bottom + height - 0.8 * size
            captions.append(layout.write(left, y, clock_text(t), size))
            captions.append(layout.write(left + width, y, panel.words, size, "right"))
        wide = [layout.width(text) for text in captions]
        fit = min((width - 2.0 * WORD) / (a + b) for a, b in zip(wide[::2], wide[1::2], strict=True))
        for text in captions:
            text.set_fontsize(size * min(1.0, fit))
        layout.draw_scale_bar(scale)
        layout.write(layout.draw_legend(), 0.5 * FOOTER, _("tightest pair"), PLAIN)
        return layout.figure


def round_length(most: float) -> float:
    """The greatest 1, 2 or 5 times a power of ten that is no more than `most`."""
    power = 10.0 ** math.floor(math.log10(most))
    return power * max(step for step in (1.0, 2.0, 5.0) if step * power <= most * (1.0 + 1e-12))


def clock_text(t: float) -> str:
    """A time to the tenth of a second."""
    tenths = f"{t:z.1f}".replace("-", "\N{MINUS SIGN}")
    return _("t = {t} s").format(t=tenths)


def near_text(nearest: Nearness | None) -> str:
    """How near the tightest pair is; empty where none counts."""
    if nearest is None:
        return ""
    text, size = _("benches {a} and {b}: {gap} apart"), abs(nearest.distance)
    if size <= TOUCHING:
        text = _("benches {a} and {b} touch")
    elif nearest.distance < 0.0:
        text = _("benches {a} and {b} overlap by {gap}")
    a, b = nearest.benches
    gap = f"{100.0 * size:.1f} cm" if size >= 0.01 else f"{1000.0 * size:.2g} mm"
    return text.format(a=a, b=b, gap=gap)
