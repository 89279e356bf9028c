"""A dance as evenly spaced frames small enough to send, and how far they are off in between.

Stored is how far along the route each handle is, and how fast; cubics fill in the times between, and
every handle is on the route by construction (design/frames.py). All numbers are whole multiples of a
quantum, packed so that a page unpacks exactly these.
"""

import base64
import math
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drawn_route import MOST_NODES, draw_stretch
from benchdragon.kernels.route import IntArray
from benchdragon.model.walk import Walk

Nodes = npt.NDArray[np.float32]

# Route positions are kept to this, m, and speeds, m/s.
QUANTUM = 1e-4
# Seconds between frames that are tried, largest first.
STEPS = tuple(2.0**n for n in range(2, -7, -1))
# Looks between two frames, as shares of the step.
SHARES = (0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875)
# Frames looked at first, to see whether a step can do at all.
TRIED = 40
# With frames so near to one another, s, a handle that is so far from its cubic, m, has leapt.
NEAR, LEAP = 0.125, 0.25
# Handles times frames: 8 bytes each in a page's memory.
MOST_PLACES = 12_000_000
# Of deflating: larger ones take up to twenty times as long for a third less.
LEVEL = 4
# Route positions, m, whose quanta fit four bytes.
FARTHEST = 200_000.0
# A stretch of route is at most so long, m.
STRETCH = 20.0


@dataclass(frozen=True)
class Frames:
    """Route positions and speeds of all handles at times start, start + step, ...

    Attributes:
        start: s.
        step: s.
        places: route positions in QUANTUM, (handles, frames).
        speeds: in QUANTUM a second, (handles, frames).
        error: the largest distance of an interpolated route position from the exact one, m.
        leap: whether the frames end because a bench leaps, or finds no place, soon after.
    """

    start: float
    step: float
    places: IntArray
    speeds: IntArray
    error: float
    leap: bool

    @property
    def count(self) -> int:
        """How many frames there are."""
        return int(self.places.shape[1])

    @property
    def end(self) -> float:
        """Time of the last frame, s."""
        return self.start + self.step * (self.count - 1)

    def positions(self, share: float) -> FloatArray:
        """Route positions so far (0..1) between each frame and the next, m, (handles, frames - 1)."""
        s = np.asarray(self.places * QUANTUM, dtype=np.float64)
        rise = np.asarray(self.speeds * (QUANTUM * self.step), dtype=np.float64)
        return between(s, rise, share)


def between(s: FloatArray, rise: FloatArray, share: float | FloatArray) -> FloatArray:
    """Cubics through values s with slopes `rise` a frame, at a share of each step."""
    f = share
    return np.asarray(
        s[:, :-1]
        + f * f * (3.0 - 2.0 * f) * (s[:, 1:] - s[:, :-1])
        + f * (1.0 - f) * ((1.0 - f) * rise[:, :-1] - f * rise[:, 1:])
    )


def frames(
    walk: Walk, start: float, end: float, most_error: float, shares: tuple[float, ...] = SHARES
) -> Frames:
    """The fewest frames between two times, s, that are nowhere farther off than `most_error`, m.

    They end early where the dragon can no longer stand, or a bench leaps.

    Raises:
        InputError: for a walk that needs more than MOST_PLACES, or goes beyond FARTHEST.
        WalkError: if the dragon does not stand at the start.
    """
    check_farthest(walk, start, end)
    until, leap = end, False
    for step in STEPS:
        count = max(math.ceil((until - start) / step - 1e-9), 1) + 1
        if count * (len(walk.dragon) + 1) > MOST_PLACES:
            break
        even = (until - start) / (count - 1)
        if step > NEAR and count > 4 * TRIED and _tried(walk, start, even, count) > most_error:
            continue
        found, errors = _shot(walk, start, even, count, shares)
        far = np.flatnonzero(~(errors <= LEAP))
        if far.size and step > NEAR:
            continue
        if far.size:
            leap, until = True, start + even * float(far[0] + 1)
            errors = errors[: far[0]]
        error = float(errors.max(initial=0.0))
        if errors.size and error <= most_error:
            kept = errors.size + 1
            return Frames(start, even, found[0][:, :kept], found[1][:, :kept], error, leap)
    raise InputError(
        _(
            "frames of {benches} benches from {start} s to {end} s would be off by more than "
            "{error} m or fill more than {most} positions: choose a shorter time"
        ).format(
            benches=len(walk.dragon), start=f"{start:g}", end=f"{until:g}", error=f"{most_error:g}",
            most=MOST_PLACES,
        )
    )  # fmt: skip


def check_farthest(walk: Walk, start: float, end: float) -> None:
    """Refuse a walk from start to end, s, that goes beyond FARTHEST.

    Raises:
        InputError: if it does.
        WalkError: if the dragon does not stand at the start.
    """
    farthest = max(-float(walk.motion([start]).s.min()), float(walk.head_position([end])[0]))
    if farthest > FARTHEST:
        text = _("a player shows {most} m of a route, and this walk goes to {far} m")
        raise InputError(text.format(most=f"{FARTHEST:g}", far=f"{farthest:g}"))


def _tried(walk: Walk, start: float, step: float, count: int) -> float:
    """The largest error halfway between TRIED frames and the next, m: no more than that of all."""
    before = start + step * np.linspace(0, count - 2, TRIED).round()
    ends = walk.motion(np.stack([before, before + step], axis=1).ravel(), throw=False)
    s, rise = (table.T.reshape(-1, 2) for table in (ends.s, ends.speed * step))
    exact = walk.motion(before + 0.5 * step, throw=False).s.T.reshape(-1, 1)
    errors = np.abs(between(s, rise, 0.5) - exact)
    return float(np.nanmax(errors, initial=0.0))


def _shot(
    walk: Walk, start: float, step: float, count: int, shares: tuple[float, ...]
) -> tuple[tuple[IntArray, IntArray], FloatArray]:
    """Places and speeds in quanta at evenly spaced times; the error between each frame and the next, m.

    NaN where the dragon does not stand all along.
    """
    times = np.linspace(start, start + step * (count - 1), count)
    s, v = (np.concatenate(parts, axis=1) for parts in zip(*_slices(walk, times), strict=True))
    shot = Frames(start, step, _quanta(s), _quanta(v), math.nan, False)
    errors = np.where(np.isnan(s).any(axis=0), np.nan, 0.0)
    errors = errors[:-1] + errors[1:]
    for share in shares:
        exact = np.concatenate([part[0] for part in _slices(walk, times[:-1] + share * step)], axis=1)
        errors = np.maximum(errors, np.abs(shot.positions(share) - exact).max(axis=0))
    return (shot.places, shot.speeds), errors


def _quanta(table: FloatArray) -> IntArray:
    return np.nan_to_num(np.rint(table / QUANTUM)).astype(np.int64)


def _slices(walk: Walk, times: FloatArray) -> Iterator[tuple[FloatArray, FloatArray]]:
    for motion in walk.motions(times, throw=False):
        yield motion.s.T, motion.speed.T


def packed_frames(frames: Frames) -> str:
    """Frames as text: speeds, then positions, each as what a page cannot foretell.

    Speeds are foretold to go on as between the two frames before (second differences); positions from
    the one before by the mean of both speeds. What is left are whole numbers of 32 bits near 0; their
    lowest bytes come first, then the next ones, deflated, in base64.
    """
    v, s = frames.speeds, frames.places
    speeds = np.diff(np.diff(v, axis=1, prepend=0), axis=1, prepend=0)
    places = np.concatenate([s[:, :1], np.diff(s, axis=1) - walked(v, frames.step)], axis=1)
    return packed_bytes(np.concatenate([speeds.ravel(), places.ravel()]).astype("<i4"))


def walked(speeds: IntArray, step: float) -> IntArray:
    """About how far each handle goes from frame to frame, in quanta, (handles, frames - 1)."""
    walked: FloatArray = np.floor((speeds[:, :-1] + speeds[:, 1:]) * (0.5 * step) + 0.5)
    return walked.astype(np.int64)


def packed_bytes(numbers: npt.NDArray[np.int32] | Nodes) -> str:
    """Numbers of four bytes as text: first bytes first, then second ones; deflated, in base64."""
    planes = numbers.view(np.uint8).reshape(-1, 4).T
    squeezed = zlib.compressobj(LEVEL, zlib.DEFLATED, -zlib.MAX_WBITS)
    return base64.b64encode(squeezed.compress(planes.tobytes()) + squeezed.flush()).decode()


@dataclass(frozen=True)
class Course:
    """The route as cubics between nodes, from one route position to another, m.

    Attributes:
        starts: route position of each stretch's first node, (stretches,).
        steps: distance of its nodes, (stretches,).
        counts: how many nodes it has, (stretches,).
        nodes: x, y (m, from `origin`) and heading (rad) of all nodes, float32, (3, nodes).
        origin: m.
        error: the largest distance of a cubic from the route, m, as looked at.
    """

    starts: FloatArray
    steps: FloatArray
    counts: IntArray
    nodes: Nodes
    origin: tuple[float, float]
    error: float


def spread(borders: Iterable[float], longest: float) -> list[float]:
    """Borders, m, with more of them evenly in between, so that none are farther apart than that."""
    first, *others = borders
    edges = [first]
    for border in others:
        parts = max(math.ceil((border - edges[-1]) / longest), 1)
        edges += np.linspace(edges[-1], border, parts + 1)[1:].tolist()
    return edges


def course(walk: Walk, low: float, high: float) -> Course:
    """The route from position low to high, m, in cubics within STRETCH_ERROR."""
    joints = [joint for joint in walk.route.joints.tolist() if low < joint < high]
    edges = spread([low, *joints, high], STRETCH)
    x, y = np.round(walk.route.point(np.array([high]))[0], 3).tolist()
    nodes, found = np.empty((3, MOST_NODES + 1)), list[tuple[Nodes, float]]()
    for a, b in pairwise(edges):
        count, error = draw_stretch(walk.route.rows, a, b, x, y, nodes)
        found.append((nodes[:, :count].astype(np.float32), error))
    counts = np.array([own.shape[1] for own, _error in found])
    return Course(
        np.array(edges[:-1]),
        np.diff(edges) / (counts - 1),
        counts,
        np.concatenate([own for own, _error in found], axis=1),
        (x, y),
        max(error for _nodes, error in found),
    )
