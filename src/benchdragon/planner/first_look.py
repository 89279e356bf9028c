"""The planner's content without scripts: a picture of its first dance, and the verdict.

The picture is an SVG that stands in the page and takes the page's colours. Its points are whole numbers
of units, of which its longer side has SIDE: finer would not be seen.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
import shapely

from benchdragon.analysis.check import Report, check
from benchdragon.analysis.entrances import edge_left
from benchdragon.analysis.records import verdict_of
from benchdragon.errors import BenchDragonError
from benchdragon.i18n import Words, _, both
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Motion
from benchdragon.number_format import seconds
from benchdragon.plans.schema import Plan

# Units of the longer side, those that a line may be off, and those of the room about what is shown.
SIDE, OFF, ROOM = 2_000, 1.0, 40
# Points along the route, m apart, and at most so many.
STEP, MOST_POINTS = 0.1, 100_000
# A scale bar takes at most this share of the width.
BAR_SHARE = 0.25
# Thickness of benches' outlines, units, and its greatest share of their width.
EDGE, EDGE_SHARE = 3.0, 0.08
# Radius of the ring about what meets, units.
RING = 45


@dataclass(frozen=True)
class FirstLook:
    """A dance for those who see no player.

    Attributes:
        width, height: of the picture, units; y points down.
        route, benches, head: paths.
        edge: how thick the outline of a bench is, units.
        standing: kinds of obstacles, with a path each.
        disc: the turning disc: x, y, radius; None if there is none.
        ring: where benches touch, or are nearest: x, y, radius; None if they never are.
        bar: of the scale: its length, in units and in words.
        title: the dance's name.
        sentence: its verdict.
        moment: which moment is drawn.
    """

    width: int
    height: int
    route: str
    benches: str
    head: str
    edge: float
    standing: tuple[tuple[str, str], ...]
    disc: tuple[int, int, int] | None
    ring: tuple[int, int, int] | None
    bar: tuple[int, str]
    title: Words
    sentence: Words
    moment: Words


def first_look(plan: Plan) -> FirstLook | None:
    """The picture of a plan's dance; None where it cannot be walked or checked."""
    try:
        report = check(plan)
        return _look(report)
    except BenchDragonError:
        return None


def _look(report: Report) -> FirstLook:
    plan, walk = report.plan, report.walk
    near = (report.first_contact or report.clearance).witness
    time = report.start if near is None or near.time is None else near.time
    motion = walk.motion([time])
    corners = _corners(motion)
    standing = plan.obstacles()
    points = [corners.reshape(-1, 2), *map(_box, standing)]
    disc = plan.disc.radius
    if disc is not None:
        points.append(np.add(walk.route.centre, [[-disc, -disc], [disc, disc]]))
    units = _Units.around(np.concatenate(points))
    sentence = verdict_of(report).sentence
    return FirstLook(
        width=units.width,
        height=units.height,
        route=units.route(report),
        benches=units.path(corners[1:]),
        head=units.path(corners[:1]),
        edge=round(min(EDGE, EDGE_SHARE * units.scale * float(walk.dragon.width.max())), 1),
        standing=tuple((one.kind, units.outline(one, edge_left(plan))) for one in standing),
        disc=None if disc is None else (*units.place(walk.route.centre), round(disc * units.scale)),
        ring=None if near is None else (*units.place(near.point), RING),
        bar=units.bar(),
        title=Words(en=plan.title("en"), zh=plan.title("zh")),
        sentence=Words(en=sentence.en, zh=sentence.zh),
        moment=both(lambda: _moment(report, time)),
    )


def _moment(report: Report, time: float) -> str:
    """Which moment is drawn."""
    at = seconds(time)
    if report.first_contact is not None:
        return _("The picture shows t = {time} s, when benches first touch.").format(time=at)
    if report.clearance.witness is None:
        return _("The picture shows t = {time} s.").format(time=at)
    return _("The picture shows t = {time} s, when the clearance is least.").format(time=at)


def _corners(motion: Motion) -> FloatArray:
    """Corners of every bench at the first time, m, (N, 4, 2)."""
    dragon, heading = motion.walk.dragon, motion.heading[0]
    along = np.stack([np.cos(heading), np.sin(heading)], axis=-1)
    side = np.stack([-along[:, 1], along[:, 0]], axis=-1) * 0.5 * dragon.width[:, np.newaxis]
    front = np.stack([motion.x[0, :-1], motion.y[0, :-1]], axis=-1)
    nose = front + along * dragon.front_inset[:, np.newaxis]
    end = nose - along * dragon.length[:, np.newaxis]
    return np.stack([nose + side, end + side, end - side, nose - side], axis=1)


def _box(one: Obstacle) -> FloatArray:
    """Two corners of the upright rectangle about an obstacle, m."""
    low, high = one.outline.min(axis=0), one.outline.max(axis=0)
    return np.stack([low - one.radius, high + one.radius])


@dataclass(frozen=True)
class _Units:
    """From metres to units of the picture.

    Attributes:
        low, high: corners of the ground that is shown, m.
        scale: units a metre.
    """

    low: FloatArray
    high: FloatArray
    scale: float

    @classmethod
    def around(cls, points: FloatArray) -> Self:
        """What shows all points, m, (n, 2)."""
        low, high = points.min(axis=0), points.max(axis=0)
        scale = (SIDE - 2 * ROOM) / float((high - low).max())
        return cls(low - ROOM / scale, high + ROOM / scale, scale)

    @property
    def width(self) -> int:
        return round(float(self.high[0] - self.low[0]) * self.scale)

    @property
    def height(self) -> int:
        return round(float(self.high[1] - self.low[1]) * self.scale)

    def __call__(self, points: FloatArray) -> FloatArray:
        """Points, m, (..., 2), in units."""
        return np.round((points - self.low) * (self.scale, -self.scale) + (0.0, self.height))

    def place(self, point: tuple[float, float]) -> tuple[int, int]:
        """One point."""
        x, y = self(np.array(point))
        return int(x), int(y)

    def path(self, shapes: Iterable[FloatArray], closed: bool = True) -> str:
        """The path of shapes, (n, 2) m each."""
        return "".join(_chain(self(np.asarray(shape)), closed) for shape in shapes)

    def route(self, report: Report) -> str:
        """The path of the route, from where the tail starts to where the head ends, where it shows."""
        ends = report.walk.motion([report.start, report.end]).s
        low, high = float(ends.min()), float(ends.max())
        count = int(min(max((high - low) / STEP, 2.0), MOST_POINTS))
        line = shapely.LineString(report.walk.route.point(np.linspace(low, high, count)))
        seen = shapely.simplify(shapely.clip_by_rect(line, *self.low, *self.high), OFF / self.scale)
        return self.path(
            (shapely.get_coordinates(one) for one in shapely.get_parts(seen)), closed=False
        )

    def outline(self, one: Obstacle, left: Sequence[Sequence[Point]]) -> str:
        """The path of an obstacle or of the venue's edge, of which entrances may leave some lines."""
        if one.kind == "venue" and left:
            return self.path(map(np.array, left), closed=False)
        if one.kind != "circle":
            return self.path([one.outline], closed=one.kind != "line")
        circle = shapely.Point(one.outline[0]).buffer(one.radius)
        return self.path([shapely.get_coordinates(circle)])

    def bar(self) -> tuple[int, str]:
        """The scale bar: of 1, 2 or 5 of a power of ten of metres, as long as there is room for."""
        most = BAR_SHARE * self.width / self.scale
        unit = 10.0 ** np.floor(np.log10(most))
        metres = max(n * unit for n in (1, 2, 5) if n * unit <= most)
        return round(metres * self.scale), f"{metres:g} m"


def _chain(points: FloatArray, closed: bool) -> str:
    """A path of points in whole units, each told from the one before."""
    steps = np.diff(points, axis=0).astype(int).tolist()
    (x, y), moves = points[0].astype(int).tolist(), (f"{x} {y}" for x, y in steps)
    return f"M{x} {y}l{' '.join(moves)}{'z' if closed else ''}".replace(" -", "-")
