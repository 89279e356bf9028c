"""What readers hand on: lines in the units of their file."""

from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class RawCurve:
    """A surveyed curve by its points, as LandXML has it, in the file's coordinates.

    Attributes:
        kind: "line", "arc" or "clothoid".
        start: x and y of its start.
        end: of its end.
        third: of an arc's centre, or of the point where a clothoid's end tangents meet; None if unsaid.
        left: whether it turns left.
        length: of a clothoid, in the file's unit.
        radii: of a clothoid at its start and end, infinite where it is straight.
    """

    kind: str
    start: tuple[float, float]
    end: tuple[float, float]
    third: tuple[float, float] | None = None
    left: bool = True
    length: float = 0.0
    radii: tuple[float, float] = (float("inf"), float("inf"))


@dataclass(frozen=True)
class RawLine:
    """A line of a file, in its coordinates.

    Attributes:
        name: its layer, or what else the file calls it.
        points: x, y and, where there are any, the bulge of what leads to the next point.
        closed: whether the last point leads to the first.
        curves: in place of points, as surveyed.
        off: how far the points may lie from what the file says, in its unit.
    """

    name: str
    points: Sequence[tuple[float, ...]] = ()
    closed: bool = False
    curves: Sequence[RawCurve] = ()
    off: float = 0.0


@dataclass(frozen=True)
class RawFile:
    """The lines of a file.

    Attributes:
        lines: all of them.
        angular: whether its coordinates are longitudes and latitudes.
        unit: of plane coordinates, a key of coordinates.UNITS; None where the file does not say it.
    """

    lines: list[RawLine] = field(default_factory=list)
    angular: bool = False
    unit: str | None = None
