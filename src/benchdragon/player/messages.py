"""A dance as pages show it: the models become types in `web/messages.d.ts`.

Metres, seconds, metres a second.
"""

from typing import Literal

from pydantic import Field

from benchdragon.analysis.records import Record, Verdict
from benchdragon.i18n import Words

OccasionKind = Literal["contact", "tightest", "fastest", "joint", "end", "obstacle", "venue", "cue"]


class Sizes(Record):
    """Sizes of every bench, m, bench 1 first."""

    length: list[float]
    width: list[float]
    front_inset: list[float]
    rear_inset: list[float]


class Stretch(Record):
    """Nodes of a stretch of the route, evenly spaced: the next stretch begins where this ends."""

    start: float
    step: float
    nodes: int


class Course(Record):
    """The route as cubics between nodes.

    `packed` holds x, y (m, from `origin`) and heading (rad) of every node as float32, x of all nodes
    first; see `frames.packed_bytes`.
    """

    stretches: list[Stretch]
    origin: tuple[float, float]
    packed: str


class Frames(Record):
    """Route positions and speeds of handles at evenly spaced times, packed.

    Of all handles, or of the head's alone where the dance says how the others follow. Handle by handle;
    see `frames.packed_frames`. Between them positions go along cubics, speeds along lines; in all
    samples no handle was farther than `largest_error` (m) from its place. They were taken `everywhere`,
    between all frames, or for a first picture between few.
    """

    start: float
    step: float
    count: int
    quantum: float
    packed: str
    largest_error: float
    everywhere: bool


class FollowTable(Record):
    """How much longer than `link`, m, the way from a handle back to the next is, by its place.

    Cubics between nodes; `packed` holds the values of all nodes, then their changes along the route, as
    whole multiples of `fine`; see `following.Table`.
    """

    link: float
    stretches: list[Stretch]
    fine: float
    packed: str


class Following(Record):
    """How the handles of a long dance follow its head, whose frames alone are sent.

    Attributes:
        tables: one for each length of link.
        kinds: number of each bench's table.
        fastest: greatest speed of each bench's front handle, m/s.
        when: time of that, s.
        speeds: least and greatest of all handles, m/s.
        change: the greatest change of a handle's speed, m/s^2.
    """

    tables: list[FollowTable]
    kinds: list[int]
    fastest: list[float]
    when: list[float]
    speeds: tuple[float, float]
    change: float


class Occasion(Record):
    """Something that happens at a time.

    Attributes:
        kind: what.
        time: s.
        text: in words.
        benches: numbers from 1.
        obstacle: number of the obstacle that takes part, from 0.
    """

    kind: OccasionKind
    time: float
    text: Words
    benches: list[int]
    obstacle: int | None = None


class DrawnObstacle(Record):
    """An obstacle, or the venue's edge: see `obstacle.Obstacle`.

    Attributes:
        name: in both languages.
        kind: "line" alone has no inside, and "venue" has its inside free.
        points: corners, m; of a circle the centre.
        radius: of a circle, m; else 0.
        margin: m.
        open: of a venue with the gate of a street, what benches must not touch, m; else empty.
        left: of a venue with gates or entrances, what they leave of its edge, m; else empty.
    """

    name: Words
    kind: Literal["circle", "rectangle", "polygon", "line", "venue"]
    points: list[tuple[float, float]]
    radius: float
    margin: float
    open: list[tuple[float, float]] = Field(default_factory=list)
    left: list[list[tuple[float, float]]] = Field(default_factory=list)


class Nearest(Record):
    """When each bench comes nearest to a non-adjacent one, in samples.

    Distance, m (minus the depth of an overlap), time, s, and number of the other bench; 0 where it
    never comes within `reach`.
    """

    reach: float
    distance: list[float]
    time: list[float]
    other: list[int]


class Tightness(Record):
    """Distance of the tightest pair, m, at evenly spaced times; capped at `Nearest.reach`."""

    start: float
    step: float
    distance: list[float]


class Run(Record):
    """Even beats: see `beats.Run`."""

    start: float
    end: float
    period: float
    bar: int
    counted: bool


class Beats(Record):
    """The drum of a dance, by rule: see `beats.Score`."""

    tempo: float
    runs: list[Run]
    strokes: list[float]


class Papers(Record):
    """How papers tell times: see `clock.Clock`.

    Attributes:
        said: the time of day at which the dance starts, or "".
        start: of the dance, s.
    """

    said: str
    start: float


class Village(Record):
    """What a village calls its benches: head and tail by name, {n} for the number of those between.

    That number is the plan's, less `before`.
    """

    head: Words
    between: Words
    tail: Words
    before: int


class Dance(Record):
    """A whole dance, as a player shows it.

    Attributes:
        ground: outlines of the ground that the dance covers, m, those around holes too; of plans with a
            square alone.
        beats: of plans with cues alone.
        papers: of plans with people or cues alone.
        village: of plans that say how benches are counted alone.
        north: whether y points north.
        entrances: where people come in, x and y, m, and how wide, m, where that is known.
    """

    version: str
    plan_sha256: str
    title: Words
    benches: Sizes
    disc: float | None
    centre: tuple[float, float]
    course: Course
    frames: Frames
    following: Following | None
    occasions: list[Occasion]
    nearest: Nearest
    tightness: Tightness
    margin: float
    speed_limit: float | None
    obstacles: list[DrawnObstacle]
    ground: list[list[tuple[float, float]]]
    verdict: Verdict | None
    beats: Beats | None = None
    papers: Papers | None = None
    village: Village | None = None
    north: bool = False
    entrances: list[list[float]] = Field(default_factory=list)
