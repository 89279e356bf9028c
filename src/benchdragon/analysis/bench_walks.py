"""What each bench does in a dance: where it starts, how it turns and how fast, what comes nearest."""

from dataclasses import dataclass
from typing import Literal

Turning = Literal["left", "right", "straight"]
Pace = Literal["wait", "walk", "hurry", "run"]
Side = Literal["left", "right", "front", "rear"]


@dataclass(frozen=True)
class Stretch:
    """A time in which a bench keeps turning one way at one pace.

    Attributes:
        start: s.
        end: s.
        turning: to which side its front handle's route bends.
        pace: of its front handle.
        way: how far that handle goes, m.
        angle: by how much its heading changes, rad, left positive.
        speeds: the least and the greatest of that handle, m/s.
    """

    start: float
    end: float
    turning: Turning
    pace: Pace
    way: float
    angle: float
    speeds: tuple[float, float]


@dataclass(frozen=True)
class Tightest:
    """When another bench, not a neighbour, comes nearest.

    Attributes:
        time: s.
        bench: number of the other.
        side: on which side of this bench it then is.
        lower: they keep at least this, m.
        upper: and come at least so near, m.
    """

    time: float
    bench: int
    side: Side
    lower: float
    upper: float


@dataclass(frozen=True)
class BenchWalk:
    """What one bench does.

    Attributes:
        bench: its number, from 1, the head's.
        place: where its front handle is when the dance starts, m.
        heading: of the bench then, rad.
        stretches: one after another, from the start of the dance to its end.
        tightest: None where no other bench comes within the distance looked for.
        before: number of the bench before it; None for the head.
        behind: number of the bench behind it; None for the tail.
    """

    bench: int
    place: tuple[float, float]
    heading: float
    stretches: tuple[Stretch, ...]
    tightest: Tightest | None
    before: int | None
    behind: int | None
