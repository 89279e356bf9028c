"""The kinds of routes that a plan may have, and where on each the head starts and ends."""

import math
from functools import lru_cache, partial
from typing import Annotated, Literal, NamedTuple, Protocol

import numpy as np
from pydantic import Field

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.route import evaluate
from benchdragon.kernels.turn_families import TRAIL
from benchdragon.model.connections import joined, programme
from benchdragon.model.curves import Line, Route, Spiral
from benchdragon.model.dragon import Dragon
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.turns import Turn
from benchdragon.model.walk import Walk
from benchdragon.plans.drawn import PieceTable
from benchdragon.plans.formations import (
    FormationTable,
    StepTable,
    formation_of,
    links_below,
    refuse_tight,
    whole_dragon_on,
)
from benchdragon.plans.source import Fault, Faults, KeyedError
from benchdragon.plans.tables import (
    MOST_PARTS,
    MOST_ROUNDS,
    Degrees,
    DiscTable,
    Length,
    LengthOrZero,
    Metres,
    Number,
    Part,
    Pitch,
    Table,
    TurnTable,
    WalkTable,
    at_least,
)
from benchdragon.surveys.alignment import GAP, KINK
from benchdragon.surveys.fitting import Fit, Smooth, fitted
from benchdragon.surveys.lines import MOST_CURVES, DrawnLine, corners_of

# A turn may extend so far beyond its disc, m: rounding, and the way between samples.
FITS = 1e-3
# Formations of one programme; the longest has some 160 parts.
MOST_STEPS = 50
# A drawing that starts with a bend has a straight line before it, m, which the dragon stands on.
RUN_UP = 1.0
# A bend must be wider than half a link by this share, or the bench folds.
FOLDS = 1e-3
# A gate lies where chords so long, m, along the route first cross the edge of the square.
FINE = 0.5
# Radii at which a dance turns back are multiples of this, m.
OUT_TO = 0.1


def _at(key: str, text: str) -> KeyedError:
    return KeyedError([Fault(key, text)])


class Beside(Protocol):
    """The parts of its plan that a route needs."""

    @property
    def disc(self) -> DiscTable:
        """The turning space."""

    @property
    def turn(self) -> TurnTable:
        """The turn between spirals."""

    @property
    def chain(self) -> Dragon | None:
        """The dragon; None where its benches cannot be."""

    @property
    def walk(self) -> WalkTable:
        """The head's walk."""


def _extent(plan: Beside) -> float:
    """How long the dragon is, m; 0 where its benches cannot be."""
    return 0.0 if plan.chain is None else plan.chain.extent


def _longest_link(plan: Beside) -> float:
    """The longest link of a bench, m; 0 where benches cannot be."""
    return 0.0 if plan.chain is None else plan.chain.longest_link


class RouteTable(Table):
    """What all kinds of routes have: where the whole dance is moved to on the square."""

    at: tuple[Metres, Metres] | None = None
    turned: Degrees = 0.0

    @property
    def once(self) -> bool:
        """Whether the dance is walked once, with nothing before it."""
        return True

    @property
    def after_street(self) -> bool:
        """Whether a street leads to it."""
        return False

    def build(self, plan: Beside) -> tuple[Route, float]:
        """The route about the origin, and where on it the head stands at time 0."""
        raise NotImplementedError

    def whole(self, plan: Beside) -> tuple[Route, float]:
        """The route on the square, and where on it the head stands at time 0."""
        route, begun = self.build(plan)
        return self.placed(route), begun

    def last_position(self, walk: Walk) -> float:
        """The head's route position at the end of the walk, m."""
        return walk.route.length

    def gated(self, edge: Obstacle, _route: Route, _plan: Beside) -> Obstacle:
        """The edge of the square as the dance meets it: with a gate where a street leads in."""
        return edge

    def placed(self, route: Route) -> Route:
        """The route as `build` gives it, turned about its origin and moved to where it is danced."""
        if self.at is None and self.turned == 0.0:
            return route
        return route.moved(math.radians(self.turned), self.at or (0.0, 0.0))

    def unplaced(self, obstacle: Obstacle) -> Obstacle:
        """An obstacle of the square as it lies to the route that `build` gives."""
        turned = -math.radians(self.turned)
        (x, y), c, s = self.at or (0.0, 0.0), math.cos(turned), math.sin(turned)
        return obstacle.moved(turned, (s * y - c * x, -s * x - c * y))

    def links_below(self) -> float:
        """How long links, m, must not be for benches to follow the bends of formations."""
        return math.inf


class Drawn(NamedTuple):
    """What a drawn route follows, so that it can be the key of what was found for it."""

    points: tuple[tuple[float, float], ...]
    pieces: tuple[PieceTable, ...]
    closed: bool
    within: float

    def line(self) -> DrawnLine:
        """The line that was drawn."""
        corners = corners_of(self.points, self.closed) if self.points else np.zeros((0, 3))
        curves = tuple(piece.build() for piece in self.pieces)
        return DrawnLine("", corners, curves, self.closed, self.within)


@lru_cache(maxsize=8)
def _fitted(
    drawn: Drawn, smooth: Smooth, deviation: float, least_radius: float, gap: float, kink: float
) -> Fit:
    """The route along a drawing; kept, for searches ask for the same one again and again."""
    return fitted(drawn.line(), smooth, deviation, least_radius, gap, kink)


class Drawing(Table):
    """A line that was drawn or surveyed: `points` of it, or `piece`s; a `file` becomes these."""

    points: Annotated[list[tuple[Metres, Metres]], Field(max_length=MOST_CURVES)] | None = None
    piece: Annotated[list[PieceTable], Field(max_length=MOST_CURVES)] | None = None
    file: Annotated[str, Field(max_length=255)] | None = None
    layer: Annotated[str, Field(max_length=255)] | None = None
    deviation: Length = 0.1
    smooth: Smooth = "G1"
    least_radius: Length | None = None
    joint_gap: LengthOrZero = GAP
    joint_kink: Annotated[Degrees, Field(ge=0.0)] = math.degrees(KINK)
    drawn_within: LengthOrZero = 0.0


def _along(drawing: Drawing, link: float, closed: bool, key: str) -> Fit:
    """The route along a drawing, and how near it keeps; `link` is the longest of a bench, m.

    Raises:
        InputError: naming the place where a bend is too tight or a joint too wide.
    """
    least = max(drawing.least_radius or 0.0, 0.5 * link * (1.0 + FOLDS))
    kink = math.radians(drawing.joint_kink)
    if not (drawing.points or drawing.piece):
        raise _at(key, _("a drawn route needs points, or a file beside the plan"))
    points, pieces = tuple(drawing.points or ()), tuple(drawing.piece or ())
    drawn = Drawn(points, pieces, closed, drawing.drawn_within)
    return _fitted(drawn, drawing.smooth, drawing.deviation, least, drawing.joint_gap, kink)


def _on_a_line(route: Route) -> tuple[Route, float]:
    """A route that the dragon stands before, on a straight line, and where it begins on it, m."""
    if isinstance(route.curves[0], Line):
        return route, 0.0
    (x, y), heading = route.start_pose
    before = x - RUN_UP * math.cos(heading), y - RUN_UP * math.sin(heading)
    return Route((Line(RUN_UP, before, heading), *route.curves)), RUN_UP


class StreetTable(Drawing):
    """A street that is walked before a dance: it lies where it was drawn, wherever that is danced."""

    deviation: Length = 1.0
    radius: Length = 3.0
    width: Length = 6.0

    def before(self, route: Route, link: float) -> tuple[Route, float]:
        """Along the street, then along a route on the square; and where the head stands at time 0.

        Raises:
            KeyedError: for a bend that benches with a link of such a length, m, cannot follow.
        """
        refuse_tight("route.street.radius", self.radius, link)
        street, begun = _on_a_line(_along(self, link, False, "route.street").route)
        return joined(street, route, self.radius), begun


class AfterStreet(RouteTable):
    """What routes have that a street may lead to."""

    street: StreetTable | None = None

    @property
    def once(self) -> bool:
        """See `RouteTable.once`."""
        return self.street is None

    @property
    def after_street(self) -> bool:
        """See `RouteTable.after_street`."""
        return self.street is not None

    def whole(self, plan: Beside) -> tuple[Route, float]:
        """See `RouteTable.whole`; with a street the head stands at its start at time 0."""
        route, begun = self.build(plan)
        if self.street is None:
            return self.placed(route), begun
        return self.street.before(self.placed(route), _longest_link(plan))

    def gated(self, edge: Obstacle, route: Route, plan: Beside) -> Obstacle:
        """See `RouteTable.gated`: the dragon comes from behind the start of the street."""
        if self.street is None:
            return edge
        count = math.ceil(route.length / FINE)
        poses = np.empty((count + 1, 4))
        evaluate(route.rows, np.array([route.length * n / count for n in range(count + 1)]), poses)
        (x, y), heading = route.start_pose
        far = _extent(plan)
        behind = x - far * math.cos(heading), y - far * math.sin(heading)
        way = [behind, *[(u, v) for u, v, _heading, _bend in poses.tolist()]]
        return edge.gated(way, self.street.width)


class SpiralInRoute(AfterStreet):
    """In along one spiral, from a turn number at theta = 0 of the last turn, to disc or centre."""

    kind: Literal["spiral-in"]
    pitch: Pitch = 0.55
    start_turn: Annotated[Number, Field(gt=0.0, le=1e6), at_least(1e-3)] = 16.0
    clockwise: bool = True

    def build(self, plan: Beside) -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0."""
        k = self.pitch / (2.0 * math.pi)
        end = plan.disc.radius / k if plan.disc.radius is not None else 0.0
        start = 2.0 * math.pi * self.start_turn
        if end >= start:
            text = _("disc.radius ({disc} m) must be smaller than the radius of start_turn ({start} m)")
            raise _at("disc.radius", text.format(disc=f"{plan.disc.radius:g}", start=f"{start * k:g}"))
        return Route((Spiral(self.pitch, start, end, mirrored=not self.clockwise),)), 0.0


class TurnRoute(AfterStreet):
    """In along a spiral, the turn of `[turn]` inside the disc, out along the spiral's twin.

    With `rounds` again and again: at `outer_radius` the head turns back, round the coil, and in.
    """

    kind: Literal["turn"]
    pitch: Pitch = 1.7
    rounds: Annotated[int, Field(ge=1, le=MOST_ROUNDS, strict=True)] = 1
    outer_radius: Length | None = None
    back_radius: Length | None = None

    @property
    def once(self) -> bool:
        """See `RouteTable.once`."""
        return self.street is None and self.rounds == 1

    def build(self, plan: Beside) -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0: where the first turn begins."""
        turn, trail = self.turn(plan), _extent(plan) + TRAIL
        if self.once:
            route = turn.route(trail=trail)
        else:
            outer, back = self._outer(turn, plan), self._back(turn, plan)
            route = turn.rounds(self.rounds, outer, back, trail, self.street is not None)
        return route, float(route.joints[1])

    def _outer(self, turn: Turn, plan: Beside) -> float:
        """Radius at which a street leads to the coil, and the head turns back to it, m.

        Where the plan says none: the next decimetre at which the whole dragon is out of the turn.
        """
        if self.outer_radius is None:
            square = turn.exit_radius**2 + _extent(plan) * self.pitch / math.pi
            return math.ceil(math.sqrt(square) / OUT_TO) * OUT_TO
        least = max(turn.entry_radius, turn.exit_radius)
        if self.outer_radius <= least:
            text = _("route.outer_radius ({outer} m) must be larger than that of the turn, {least} m")
            raise _at(
                "route.outer_radius", text.format(outer=f"{self.outer_radius:g}", least=f"{least:g}")
            )
        return self.outer_radius

    def _back(self, turn: Turn, plan: Beside) -> float:
        """Radius of the bend by which the head turns back, m.

        Where the plan says none: that of the turn's tightest bend, or what keeps the dragon as far
        from itself there as in the coil, if that is more.
        """
        if self.back_radius is None:
            return max(turn.least_radius, 0.25 * self.pitch)
        refuse_tight("route.back_radius", self.back_radius, _longest_link(plan))
        return self.back_radius

    def turn(self, plan: Beside) -> Turn:
        """The turn itself.

        Raises:
            InputError: if there is no such turn, it does not fit the disc, or no bench could follow.
        """
        disc = TurnRoute.disc(plan)
        try:
            turn = plan.turn.build(self.pitch, disc)
        except InputError as error:
            raise _at("turn", str(error)) from None
        for name in ("entry_radius", "exit_radius"):
            if getattr(turn, name) > disc:
                text = _("turn.{name} ({radius} m) must not exceed disc.radius ({disc} m)")
                raise _at(
                    f"turn.{name}",
                    text.format(name=name, radius=f"{getattr(turn, name):g}", disc=f"{disc:g}"),
                )
        if turn.extent > disc + FITS:
            text = _("the turn reaches {reach} m from the centre, out of a disc of {disc} m")
            raise _at("turn", text.format(reach=f"{turn.extent:.4g}", disc=f"{disc:g}"))
        link = _longest_link(plan)
        if 2.0 * turn.least_radius <= link:
            raise _at(
                "turn",
                _(
                    "a bench with {link} m between its handles cannot follow a bend of {radius} m "
                    "radius: it must be wider than {least} m"
                ).format(link=f"{link:g}", radius=f"{turn.least_radius:.4g}", least=f"{0.5 * link:g}"),
            )
        return turn

    @staticmethod
    def disc(plan: Beside) -> float:
        """Radius of the turning space, m: the paper's, if the plan does not say."""
        return 4.5 if plan.disc.radius is None else plan.disc.radius

    def last_position(self, walk: Walk) -> float:
        """The head's route position when the tail has left the turn, m."""
        return walk.head_where_tail(float(walk.route.joints[-2]))


class PartsRoute(AfterStreet):
    """Any parts, each moved to where the one before it ends."""

    kind: Literal["parts"]
    part: Annotated[list[Part], Field(min_length=1, max_length=MOST_PARTS)]
    start: tuple[Metres, Metres] | None = None
    heading: Degrees | None = None

    def build(self, _plan: Beside) -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0: at its start."""
        faults = Faults()
        tried = [
            faults.tried(f"route.part.{i}", partial(part.build)) for i, part in enumerate(self.part)
        ]
        curves = [curve for curve in tried if curve is not None]
        if faults.found:
            raise KeyedError(faults.found)
        if self.start is not None or self.heading is not None:
            point, heading = curves[0].start_pose
            if self.heading is not None:
                heading = math.radians(self.heading)
            curves[0] = curves[0].moved(self.start or point, heading)
        return Route.joined(curves), 0.0


class FormationRoute(AfterStreet, FormationTable):
    """One formation; at time 0 the whole dragon stands on it, its tail at the start."""

    kind: Literal["formation"]

    def build(self, plan: Beside) -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0."""
        route = formation_of(self, "route", _longest_link(plan)).build()
        return route, _whole_dragon_on(route, plan)

    def links_below(self) -> float:
        """See `RouteTable.links_below`."""
        return links_below(self)


class ProgrammeRoute(AfterStreet):
    """Formations one after another; at time 0 the whole dragon stands on the route, as above."""

    kind: Literal["programme"]
    formation: Annotated[list[StepTable], Field(min_length=1, max_length=MOST_STEPS)]
    radius: Length = 3.0

    def build(self, plan: Beside) -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0."""
        faults, link = Faults(), _longest_link(plan)
        faults.tried("route.radius", partial(refuse_tight, "route.radius", self.radius, link))
        keys = [f"route.formation.{i}" for i in range(len(self.formation))]
        tried = [
            faults.tried(key, partial(one.step, key, link))
            for key, one in zip(keys, self.formation, strict=True)
        ]
        if faults.found:
            raise KeyedError(faults.found)
        route = programme([step for step in tried if step is not None], self.radius)
        return route, _whole_dragon_on(route, plan)

    def links_below(self) -> float:
        """See `RouteTable.links_below`."""
        return min([2.0 * self.radius, *[links_below(one) for one in self.formation]])


class DrawnRoute(RouteTable, Drawing):
    """Along a line that was drawn or surveyed.

    A closed line is walked once round, and the dragon stands on it behind its head, however often
    that leads round.
    """

    kind: Literal["drawn"]
    closed: bool = False

    def build(self, plan: Beside) -> tuple[Route, float]:
        """The route, and where on it the head stands at time 0: where the drawing starts."""
        route = self.fit(_longest_link(plan)).route
        if not self.closed:
            return _on_a_line(route)
        laps = math.ceil(_extent(plan) / route.length)
        if (laps + 1) * len(route.curves) > MOST_CURVES:
            raise _at(
                "route",
                _(
                    "the dragon goes round the drawing {laps} times, with {count} bends a round: "
                    "too many; draw it larger, or allow a larger deviation"
                ).format(laps=laps, count=len(route.curves)),
            )
        around = tuple(curve for _lap in range(laps + 1) for curve in route.curves)
        return Route(around), laps * route.length

    def fit(self, link: float) -> Fit:
        """See `_along`."""
        return _along(self, link, self.closed, "route")


def _whole_dragon_on(route: Route, plan: Beside) -> float:
    """Where the head stands with the tail at the route's start, m; 0 where the plan says another."""
    if plan.walk.position is not None or plan.chain is None:
        return 0.0
    return whole_dragon_on(route, plan.chain)


AnyRoute = Annotated[
    SpiralInRoute | TurnRoute | PartsRoute | FormationRoute | ProgrammeRoute | DrawnRoute,
    Field(discriminator="kind"),
]
