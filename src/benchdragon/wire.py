"""What goes over the wire to a page: models that the front end's types are made from.

Metres, seconds, metres a second. `tools/make_types.py` turns them into `web/wire.d.ts`.
"""

from typing import Literal

from pydantic import BaseModel, ConfigDict


class Wire(BaseModel):
    """Something sent to a page; nothing else may stand in it."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Texts(Wire):
    """A sentence in both languages."""

    en: str
    zh: str


class Sizes(Wire):
    """Sizes of every bench, m, bench 1 first."""

    length: list[float]
    width: list[float]
    front_inset: list[float]
    rear_inset: list[float]


class Stretch(Wire):
    """Nodes of a stretch of the route, evenly spaced: the next stretch begins where this ends."""

    start: float
    step: float
    nodes: int


class Course(Wire):
    """The route as cubics between nodes.

    `packed` holds x, y (m, from `origin`) and heading (rad) of every node as float32, x of all nodes
    first; see `frames.packed_bytes`.
    """

    stretches: list[Stretch]
    origin: tuple[float, float]
    packed: str


class Frames(Wire):
    """Route positions and speeds of all handles at evenly spaced times, packed.

    Handle by handle; see `frames.packed_frames`. Between them both are interpolated by cubics, and no
    handle is then farther than `largest_error` (m) from its place, as looked at between frames.
    """

    start: float
    step: float
    count: int
    quantum: float
    packed: str
    largest_error: float


class Occasion(Wire):
    """Something that happens at a time; `benches` are numbers from 1."""

    kind: Literal["contact", "tightest", "fastest", "joint", "end"]
    time: float
    text: Texts
    benches: list[int]


class Nearest(Wire):
    """When each bench comes nearest to one that is not its neighbour, as far as looked at.

    Distance, m (minus the depth of an overlap), time, s, and number of the other bench; 0 where it
    never comes within `reach`.
    """

    reach: float
    distance: list[float]
    time: list[float]
    other: list[int]


class Tightness(Wire):
    """Distance of the tightest pair, m, at evenly spaced times; capped at `Nearest.reach`."""

    start: float
    step: float
    distance: list[float]


class Ruling(Wire):
    """Whether a walk is safe, in one sentence; `decided` is false where that is open."""

    safe: bool
    decided: bool
    text: Texts


class Dance(Wire):
    """A whole dance, as a player shows it."""

    version: str
    plan_sha256: str
    title: Texts
    benches: Sizes
    disc: float | None
    centre: tuple[float, float]
    course: Course
    frames: Frames
    occasions: list[Occasion]
    nearest: Nearest
    tightness: Tightness
    margin: float
    speed_limit: float | None
    ruling: Ruling | None
