"""Pictures of a walk: the dragon on its route, the speeds of all handles, the head's polar angle.

Each function gives a matplotlib Figure in the language in use; `style.write_picture` saves it.
"""

from collections.abc import Sequence

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from benchdragon.analysis.swept import drawn_ground
from benchdragon.errors import InputError
from benchdragon.figures.framing import Area, Framing, framing, inset, route_positions
from benchdragon.figures.square import draw_square, square_corners
from benchdragon.figures.style import (
    ABOVE,
    BELOW,
    BODY,
    DISC,
    HEAD,
    LEAST_TEXT,
    PAGE_WIDTH,
    ROUTE,
    cell_edges,
    drawn_panel,
    drawn_panels,
    spread_over,
)
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.answer import ROUNDING
from benchdragon.model.curves import Route
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Motion, Walk

# The scale holds all speeds of so many per cent of the times, and the rest too unless that would make
# it so many times as long.
COMMON_PERCENT, MOST_STRETCH = 95.0, 4.0
# Speeds that agree so well are one speed.
ONE_SPEED = 1e-6
# What one line of a legend names.
MOST_NAMED = 6
# Limits of one picture: finer would not be seen, and would take minutes.
MOST_BENCHES = 20_000
MOST_PANELS = 4
MOST_COLUMNS = 1_500
MOST_PLACES = 10_000_000


def dragon_picture(
    motion: Motion, title: str = "", indices: Sequence[int] = (0,), disc: float | None = None,
    obstacles: Sequence[Obstacle] = (), ground: Sequence[FloatArray] = (), *, by_speed: bool = False,
) -> Figure:  # fmt: skip
    """The dragon on its route, benches to scale, head marked, at times number `indices`.

    Args:
        motion: holds the times.
        title: above all; signs that cannot be drawn become "?", with a warning.
        indices: of `walk.times`, one panel each.
        disc: radius of a circle to draw about the first spiral's centre, m.
        obstacles: on the square, the venue's edge included: see `Plan.obstacles`.
        ground: outlines of the ground that the dance covers: see `swept.drawn_ground`.
        by_speed: whether a bench's colour tells how fast its front handle is.
    """
    columns = min(len(indices), 2)
    panels = -(-len(indices) // columns)
    side = PAGE_WIDTH / 2 if columns > 1 else 0.62 * PAGE_WIDTH
    size = side * columns, side * panels + 0.3
    with drawn_panels(*size, title, panels, columns) as (figure, axes):
        draw_dragons(axes, motion, indices, disc, obstacles, ground, by_speed=by_speed)
        for panel in axes[len(indices) :]:
            panel.set_axis_off()
        name_below(figure, axes[0])
        return figure


def draw_dragons(
    axes: Sequence[Axes], motion: Motion, indices: Sequence[int], disc: float | None = None,
    obstacles: Sequence[Obstacle] = (), ground: Sequence[FloatArray] = (), *, by_speed: bool = False,
) -> None:  # fmt: skip
    """Draw the dragon at times number `indices`, one panel each, all to one scale: `dragon_picture`."""
    framed = framing_of(motion, indices, disc, square_corners(obstacles))
    colours = speed_colours(motion.speed[list(indices)]) if by_speed else None
    shown = list(zip(axes, indices, strict=False))
    for panel, index in shown:
        draw_dragon(panel, motion, index, disc, framed, obstacles, ground, colours)
    if colours is not None:
        _add_bar(colours, [panel for panel, _index in shown])


def name_below(figure: Figure, *panels: Axes) -> None:
    """One legend for all panels, below them: names of the labelled things of `panels` are called."""
    named: dict[str, Artist] = {}
    for panel in panels:
        for handle, label in zip(*panel.get_legend_handles_labels(), strict=True):
            named.setdefault(label, handle)
    handles, labels = list(named.values()), list(named)
    figure.legend(
        handles, labels, loc="outside lower center", ncols=min(len(labels), MOST_NAMED), frameon=False
    )


def framing_of(
    motion: Motion, indices: Sequence[int], disc: float | None, kept: Sequence[tuple[float, float]] = ()
) -> Framing:
    """What pictures of the dragon at all `indices` show, all to one scale, the points `kept` too, m."""
    dragon, route = motion.walk.dragon, motion.walk.route
    s = motion.s[list(indices)]
    s = s[~np.isnan(s[:, 0])]
    spans = np.stack([np.nanmin(s, axis=1), s[:, 0]], axis=-1) if len(s) else np.zeros((1, 2))
    room = float(dragon.length.max())
    return framing(route, spans, room, [*kept, *disc_corners(route, disc)], room)


def disc_corners(route: Route, disc: float | None) -> list[tuple[float, float]]:
    """Two corners of the square about the disc, m; none where there is no disc."""
    if disc is None:
        return []
    x, y = route.centre
    return [(x - disc, y - disc), (x + disc, y + disc)]


def draw_dragon(
    panel: Axes, motion: Motion, index: int, disc: float | None, framed: Framing,
    obstacles: Sequence[Obstacle] = (), covered: Sequence[FloatArray] = (),
    colours: ScalarMappable | None = None,
) -> None:  # fmt: skip
    """Draw benches, route, disc and square into one panel, and an inset where not all is shown.

    With `colours`, benches have those of their front handles' speeds.
    """
    tail = float(np.nanmin(motion.s[index], initial=0.0))
    front = float(np.nanmax(motion.s[index], initial=0.0))
    end = min(motion.walk.route.length, front + 1.5 * (front - tail) + 20.0)
    route = route_points(motion.walk.route, tail, end)
    panel.plot(route[:, 0], route[:, 1], color=ROUTE, lw=0.5, zorder=1, label=_("route"))
    if disc is not None:
        ring = {"fill": False, "ec": DISC, "lw": 1.2, "ls": "--", "zorder": 2}
        panel.add_patch(Circle(motion.walk.route.centre, disc, label=_("disc"), **ring))
    draw_square(panel, obstacles, ground=covered)
    speed = motion.speed[index, :-1]
    _draw_benches(
        panel, motion[index].corners()[0], None if colours is None else colours.to_rgba(speed)
    )
    panel.set(aspect="equal", xlabel=_("x (m)"), ylabel=_("y (m)"))
    clock = f"{motion.times[index]:g}".replace("-", "\N{MINUS SIGN}")
    panel.set_title(_("t = {t} s").format(t=clock))
    frame = framed.frame(1.0, np.stack([motion.x[index], motion.y[index]], axis=-1))
    panel.set(xlim=frame.limits[0], ylim=frame.limits[1])
    if framed.cut(1.0):
        ground, place = inset(framed, frame, route, ((0, 0), (1, 0), (0, 1)))
        axes = panel.inset_axes(place, zorder=7)
        Overview(axes, ground, route, ROUTE, "black").show(motion, index, frame)
        text = _("{length} m across").format(length=f"{ground.width:.3g}")
        axes.text(0.03, 0.94, text, fontsize=LEAST_TEXT, va="top", transform=axes.transAxes)


def _draw_benches(panel: Axes, corners: FloatArray, colours: FloatArray | None) -> None:
    """Draw the benches that stand, the head hatched."""
    sound = np.asarray(~np.isnan(corners).any(axis=(1, 2)))
    first, others = (HEAD, BODY) if colours is None else (colours[0], colours[1:][sound[1:]])
    body = PolyCollection(
        list(corners[1:][sound[1:]]), fc=others, ec="black", lw=0.25, zorder=3, label=_("benches")
    )
    panel.add_collection(body)
    if sound[0]:
        head = PolyCollection(
            [corners[0]], fc=first, ec="black", lw=0.6, hatch="////", zorder=4, label=_("head")
        )
        panel.add_collection(head)


class Overview:
    """A small picture of all that the dragon covers, with a mark about what the large one shows.

    Args:
        axes: to draw into.
        ground: all of it.
        route: points of it, m, (n, 2).
        edge: colour of the route and of the edges.
        ink: colour of the mark.
    """

    def __init__(self, axes: Axes, ground: Area, route: FloatArray, edge: str, ink: str) -> None:
        self.axes = axes
        axes.set(xlim=ground.limits[0], ylim=ground.limits[1], xticks=[], yticks=[])
        for side in axes.spines.values():
            side.set_color(edge)
        axes.plot(route[:, 0], route[:, 1], color=edge, lw=0.6)
        (self.body,) = axes.plot([], [], color=BODY, lw=2.0)
        (self.head,) = axes.plot([], [], "o", color=HEAD, ms=4.0)
        self.mark = Rectangle((0.0, 0.0), 0.0, 0.0, fill=False, ec=ink, lw=1.0, zorder=4)
        axes.add_patch(self.mark)

    def show(self, motion: Motion, index: int, frame: Area) -> None:
        """Move the dragon to time number `index`, and the mark to what the large picture shows."""
        self.body.set_data(motion.x[index], motion.y[index])
        self.head.set_data(motion.x[index, :1], motion.y[index, :1])
        (left, _right), (bottom, _top) = frame.limits
        self.mark.set(x=left, y=bottom, width=frame.width, height=frame.height)


def route_points(route: Route, start: float, end: float) -> FloatArray:
    """Points of the route from one position to another, m, (n, 2)."""
    return route.point(route_positions(start, end))


def speed_map(motion: Motion, title: str = "") -> Figure:
    """Speed of all handles over time, as a map: time to the right, handle 0 (the head) on top.

    Where a few instants are far faster or slower than the rest, the colours tell the rest apart, and
    the extremes are named.
    """
    with drawn_panel(0.85 * PAGE_WIDTH, 3.3, title) as (figure, panel):
        draw_speeds(panel, motion)
        return figure


def draw_speeds(panel: Axes, motion: Motion, joints: Sequence[float] = ()) -> None:
    """Draw a map of speeds, with its scale beside it: see `speed_map`.

    Lines show when each handle passes the route positions `joints`, m.
    """
    panel.grid(False)
    times = cell_edges(motion.times)
    handles = np.arange(motion.x.shape[1] + 1) - 0.5
    colours = speed_colours(motion.speed)
    low, high = colours.get_clim()
    mesh = panel.pcolormesh(
        times, handles, motion.speed.T, cmap=colours.cmap, vmin=low, vmax=high, rasterized=True
    )
    for n, joint in enumerate(joints):
        passed = [np.interp(joint, s, motion.times, np.nan, np.nan) for s in motion.s.T]
        name = _("passing a joint of the route") if n == 0 else None
        panel.plot(passed, range(len(passed)), color="white", lw=0.8, ls="--", label=name)
    if joints:
        panel.legend(loc="lower left", facecolor="#555555", labelcolor="white")
    panel.set_ylim(handles[-1], handles[0])
    panel.set(xlabel=_("time (s)"), ylabel=_("handle (0: the head's front)"))
    beyond = _beyond(motion, *speed_scale(motion.speed))
    panel.set_title("\n".join([_("Speed of every handle"), *beyond.values()]), linespacing=1.5)
    _add_bar(mesh, [panel], {0: "neither", 1: next(iter(beyond), "neither"), 2: "both"}[len(beyond)])


def speed_colours(speed: FloatArray) -> ScalarMappable:
    """The colours of a table of speeds, m/s, (T, N + 1)."""
    colours = matplotlib.colormaps["cividis"].with_extremes(under=BELOW, over=ABOVE)
    return ScalarMappable(Normalize(*speed_scale(speed)), colours)


def _add_bar(colours: ScalarMappable, panels: Sequence[Axes], extend: str = "neither") -> None:
    """Add a scale of speeds beside panels of one figure."""
    bar = panels[0].figure.colorbar(colours, ax=list(panels), pad=0.02, extend=extend)
    bar.set_label(_("speed (m/s)"))
    bar.formatter.set_useOffset(False)  # type: ignore[attr-defined]


def speed_scale(speed: FloatArray) -> tuple[float, float]:
    """Lowest and highest speed, m/s, of a scale of colours for a table of speeds, (T, N + 1).

    Those of a few instants that would make the scale several times as long are left out.
    """
    sound = speed[~np.isnan(speed).all(axis=1)]
    if not len(sound):
        return 0.0, 1.0
    lowest, highest = np.nanmin(sound, axis=1), np.nanmax(sound, axis=1)
    low, high = float(lowest.min()), float(highest.max())
    usual = np.percentile(lowest, 100.0 - COMMON_PERCENT), np.percentile(highest, COMMON_PERCENT)
    if ONE_SPEED * high < MOST_STRETCH * (usual[1] - usual[0]) < high - low:
        low, high = float(usual[0]), float(usual[1])
    if high - low <= ONE_SPEED * high:
        room = 0.01 * high or 0.01
        return max(low - room, 0.0), high + room
    return low, high


def _beyond(motion: Motion, low: float, high: float) -> dict[str, str]:
    """The lowest and the highest speed in words, by "min" and "max", where they leave a scale, m/s."""
    if np.isnan(motion.speed).all():
        return {}
    texts = {}
    for side, text, find in (
        ("min", _("lowest of those drawn: {speed} m/s, handle {handle}, t = {t} s"), np.nanargmin),
        ("max", _("highest of those drawn: {speed} m/s, handle {handle}, t = {t} s"), np.nanargmax),
    ):
        time = int(find(motion.speed)) // motion.speed.shape[1]
        speed = float(motion.speed.flat[find(motion.speed)])
        # Of handles on one arc, which are equally fast, the first.
        handle = int(np.isclose(motion.speed[time], speed, rtol=ROUNDING, atol=0.0).argmax())
        if not low <= speed <= high:
            clock = f"{motion.times[time]:.4g}".replace("-", "\N{MINUS SIGN}")
            texts[side] = text.format(speed=f"{speed:.4g}", handle=handle, t=clock)
    return texts


def head_angle_picture(motion: Motion, title: str = "") -> Figure:
    """Polar angle and radius of the head about the first spiral's centre, over time."""
    cx, cy = motion.walk.route.centre
    dx, dy = motion.x[:, 0] - cx, motion.y[:, 0] - cy
    angle = np.degrees(np.unwrap(np.arctan2(dy, dx)))
    with drawn_panels(0.85 * PAGE_WIDTH, 4.0, title, 2, 1, sharex=True) as (figure, (above, below)):
        above.plot(motion.times, angle, color=HEAD, marker="." if len(angle) < 30 else None)
        above.set_ylabel(_("polar angle (degrees)"))
        figure.align_ylabels()
        above.set_title(_("Polar angle of the head"))
        below.plot(motion.times, np.hypot(dx, dy), color=BODY, marker="." if len(angle) < 30 else None)
        below.set(ylabel=_("distance from the centre (m)"), xlabel=_("time (s)"))
        return figure


def walk_pictures(
    walk: Walk, times: FloatArray, title: str, disc: float | None, throw: bool = True,
    obstacles: Sequence[Obstacle] = (),
) -> dict[str, Figure]:  # fmt: skip
    """All pictures of a walk at `times`: dragon (up to four instants), speeds, head-angle.

    Raises:
        InputError: for a dragon of more benches than a picture shows.
    """
    if len(walk.dragon) > MOST_BENCHES:
        text = _("a picture shows at most {most} benches, not {count}; leave pictures out")
        raise InputError(text.format(most=MOST_BENCHES, count=len(walk.dragon)))
    instants = walk.motion(times[spread_over(len(times), MOST_PANELS)], throw=throw)
    shown = range(len(instants.times))
    stood = instants.times[instants.status == 0]
    ground = drawn_ground(walk, stood.min(), stood.max()) if obstacles and len(stood) else ()
    figures = {"dragon": dragon_picture(instants, title, shown, disc, obstacles, ground)}
    if len(times) > 1 and (np.diff(times) > 0.0).all():
        columns = min(MOST_COLUMNS, MOST_PLACES // (len(walk.dragon) + 1))
        overview = walk.motion(np.linspace(times[0], times[-1], columns), throw=throw)
        figures["speeds"] = speed_map(overview, title)
        figures["head-angle"] = head_angle_picture(overview, title)
    return figures
