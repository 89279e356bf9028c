"""What readers hand on: lines in the units of their file."""

from collections import Counter
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
        length: in the file's unit; None where it does not say one.
        radii: of a clothoid at its start and end, infinite where it is straight.
    """

    kind: str
    start: tuple[float, float]
    end: tuple[float, float]
    third: tuple[float, float] | None = None
    left: bool = True
    length: float | None = None
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
        hidden: whether it is drawn on a layer that is off.
    """

    name: str
    points: Sequence[tuple[float, ...]] = ()
    closed: bool = False
    curves: Sequence[RawCurve] = ()
    off: float = 0.0
    hidden: bool = False


@dataclass(frozen=True)
class RawFile:
    """The lines of a file.

    Attributes:
        lines: all of them.
        angular: whether its coordinates are longitudes and latitudes.
        unit: of plane coordinates, a key of coordinates.UNITS; None where the file does not say it.
        passed: what of the file was passed over, or read otherwise than it stands there.
        says_unit: whether that unit stands in the file, and is not only what such files are in.
        unclear: whether its x may point north, as surveyors have it.
        crs: the code of the system that the file says its coordinates are of, like "EPSG:4549".
    """

    lines: list[RawLine] = field(default_factory=list)
    angular: bool = False
    unit: str | None = None
    passed: list[str] = field(default_factory=list)
    says_unit: bool = False
    unclear: bool = False
    crs: str | None = None


def passed_over(kinds: Sequence[str]) -> list[str]:
    """How many of each kind there are, as in "2 TEXT"."""
    return [f"{count} {kind}" for kind, count in Counter(kinds).items()]


def place_text(place: Sequence[float]) -> str:
    """Coordinates as a file has them, x or longitude first."""
    return f"({place[0]:.12g}, {place[1]:.12g})"
