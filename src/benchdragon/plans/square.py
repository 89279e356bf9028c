"""The tables of a plan file about the square: its edge and its obstacles."""

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Annotated, ClassVar, Literal, get_args

from pydantic import AfterValidator, Field

from benchdragon.i18n import N_, _
from benchdragon.model.obstacle import MOST_CORNERS, Obstacle, rectangle_outline
from benchdragon.plans.source import Fault, Faults, KeyedError
from benchdragon.plans.tables import (
    Degrees,
    Key,
    Length,
    LengthOrZero,
    LimitsTable,
    Metres,
    Table,
    one_line,
)

# Letters of a name that is put into sentences.
MOST_LETTERS = 80
# Greatest number of obstacles of a square.
MOST_OBSTACLES = 1_000


Name = Annotated[str, Field(max_length=MOST_LETTERS), AfterValidator(one_line)]
Corners = Annotated[list[tuple[Metres, Metres]], Field(max_length=MOST_CORNERS)]


class VenueTable(Table):
    """The edge of the venue: `boundary`, its corners, or a `rectangle` about a `centre`.

    A `file` with the edge, or a `layer` of it, becomes its corners when the plan is read.
    """

    boundary: Corners | None = None
    rectangle: tuple[Length, Length] | None = None
    centre: tuple[Metres, Metres] | None = None
    angle: Degrees | None = None
    name: Name = ""
    file: Annotated[str, Field(max_length=255)] | None = None
    layer: Annotated[str, Field(max_length=255)] | None = None

    def build(self, margin: float) -> Obstacle | None:
        """The edge, from which benches keep `margin`, m; None if the plan says none."""
        name = self.name or "venue"
        if self.boundary is not None:
            return Obstacle.venue(name, self.boundary, margin)
        if self.rectangle is None:
            return None
        angle = math.radians(self.angle or 0.0)
        outline = rectangle_outline(name, self.centre or (0.0, 0.0), self.rectangle, angle)
        return Obstacle.venue(name, outline, margin)


class ObstacleTable(Table):
    """An obstacle on the square.

    Attributes:
        about: what it is, in words.
        keys: what each key means, except those that all kinds have.
    """

    about: ClassVar[str]
    keys: ClassVar[Mapping[str, Key]]

    name: Name = ""
    margin: LengthOrZero | None = None

    def build(self, name: str, margin: float) -> Obstacle:
        """The obstacle with its name, from which benches keep `margin`, m."""
        raise NotImplementedError


class CircleTable(ObstacleTable):
    """A round obstacle."""

    about: ClassVar[str] = N_("A round obstacle: a well, a post, a tree.")
    keys: ClassVar[Mapping[str, Key]] = {
        "centre": Key(N_("its centre, x and y"), [3, 1], "m"),
        "radius": Key(N_("its radius"), "60 cm", "m"),
    }

    kind: Literal["circle"]
    centre: tuple[Metres, Metres]
    radius: Length

    def build(self, name: str, margin: float) -> Obstacle:
        """The obstacle with its name, from which benches keep `margin`, m."""
        return Obstacle.circle(name, self.centre, self.radius, margin)


class RectangleTable(ObstacleTable):
    """A rectangular obstacle."""

    about: ClassVar[str] = N_("A rectangular obstacle: a stage, a stall, a parked car.")
    keys: ClassVar[Mapping[str, Key]] = {
        "centre": Key(N_("its centre, x and y"), [3, 1], "m"),
        "size": Key(N_("its length and width"), [0.5, 0.3], "m"),
        "angle": Key(N_("direction of its length, from x to y"), 30, "deg"),
    }

    kind: Literal["rectangle"]
    centre: tuple[Metres, Metres]
    size: tuple[Length, Length]
    angle: Degrees = 0.0

    def build(self, name: str, margin: float) -> Obstacle:
        """The obstacle with its name, from which benches keep `margin`, m."""
        return Obstacle.rectangle(name, self.centre, self.size, math.radians(self.angle), margin)


class PolygonTable(ObstacleTable):
    """An obstacle with any number of corners."""

    about: ClassVar[str] = N_("An obstacle with any corners: a house, a flower bed.")
    keys: ClassVar[Mapping[str, Key]] = {
        "points": Key(N_("its corners in going round, each x and y"), [[5, 0], [7, 0], [6, 2]], "m"),
    }

    kind: Literal["polygon"]
    points: Corners

    def build(self, name: str, margin: float) -> Obstacle:
        """The obstacle with its name, from which benches keep `margin`, m."""
        return Obstacle.polygon(name, self.points, margin)


class LineTable(ObstacleTable):
    """A chain of straight lines."""

    about: ClassVar[str] = N_("A chain of straight lines: a rope, a kerb, a wall.")
    keys: ClassVar[Mapping[str, Key]] = {
        "points": Key(N_("its points in order, each x and y"), [[-9, 4], [9, 4]], "m"),
    }

    kind: Literal["line"]
    points: Corners

    def build(self, name: str, margin: float) -> Obstacle:
        """The obstacle with its name, from which benches keep `margin`, m."""
        return Obstacle.line(name, self.points, margin)


AnyObstacle = CircleTable | RectangleTable | PolygonTable | LineTable
OBSTACLES: tuple[type[ObstacleTable], ...] = get_args(AnyObstacle)
OBSTACLE_KEYS: Mapping[str, Key] = {
    "name": Key(N_("what people call it; else obstacle and its number"), "well"),
    "margin": Key(N_("distance that benches must keep from it; else limits.margin"), "30 cm", "m"),
}
AnObstacle = Annotated[AnyObstacle, Field(discriminator="kind")]


def built_obstacles(
    venue: VenueTable, tables: Sequence[AnyObstacle], limits: LimitsTable
) -> tuple[Obstacle, ...]:
    """The edge of the venue, if there is one, then the obstacles.

    Raises:
        KeyedError: for all that cannot be.
    """
    faults = Faults()
    found: list[Obstacle] = []
    taken: dict[str, str] = {}
    margin = limits.margin if limits.venue_margin is None else limits.venue_margin
    edge = faults.tried("venue", lambda: venue.build(margin))
    if edge is not None:
        found.append(edge)
        taken[edge.name] = "venue"
    for n, table in enumerate(tables):
        name = table.name or f"obstacle {n + 1}"
        if name in taken:
            text = _("two things are called {name}: {first} and {second}")
            text = text.format(name=name, first=taken[name], second=f"obstacle.{n}")
            faults.found.append(Fault(f"obstacle.{n}.name", text))
        taken.setdefault(name, f"obstacle.{n}")
        kept = limits.margin if table.margin is None else table.margin
        one = faults.tried(f"obstacle.{n}", partial(table.build, name, kept))
        found += [] if one is None else [one]
    if faults.found:
        raise KeyedError(faults.found)
    return tuple(found)
