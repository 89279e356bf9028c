"""A dance as evenly spaced frames small enough to send, and how far they are off in between.

Stored is how far along the route each handle is, and how fast; cubics fill in the times between, and
every handle is on the route by construction (design/frames.py). All numbers are whole multiples of a
quantum, packed so that a page unpacks exactly these.
"""

import base64
import math
import zlib
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from benchdragon import budget
from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels import frames as kernel
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drawn_route import MOST_STRETCH_NODES, draw_stretch
from benchdragon.kernels.following import LONGEST, STRETCH_COLUMNS, find_edges
from benchdragon.kernels.route import IntArray
from benchdragon.model.walk import Walk

Nodes = npt.NDArray[np.float32]
Shares = tuple[float, ...]

# Seconds between frames that are tried, largest first.
STEPS = tuple(2.0**n for n in range(2, -7, -1))
# Samples between two frames, as shares of the step: first where cubics are off most.
SHARES = (0.5, 0.125, 0.25, 0.375, 0.625, 0.75, 0.875)
# A handle so far from its cubic, m, leaps if it also is with frames so near to one another, s, and then
# the dance ends so long before, s.
LEAP, CLOSE, BEFORE = 0.125, 2.0**-6, 0.125
# Frames of a sketch that are tested.
TRIED = 40
# Handles times frames: 8 bytes each in a page's memory.
MOST_PLACES = 12_000_000
# Of deflating: larger ones take up to twenty times as long for a third less.
LEVEL = 4
# Route positions, m, whose quanta fit four bytes.
FARTHEST = 200_000.0


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


def frames(walk: Walk, start: float, end: float, most_error: float, shares: Shares = SHARES) -> Frames:
    """The fewest frames between two times, s, that are nowhere farther off than `most_error`, m.

    They end early where the dragon can no longer stand, or a bench leaps.

    Raises:
        InputError: for a walk that needs more than MOST_PLACES, or goes beyond FARTHEST.
        WalkError: if the dragon does not stand at the start.
    """
    check_farthest(walk, start, end)
    links, tried, until, leap = walk.dragon.links, 0, end, False
    while tried < len(STEPS) and until > start:
        times = even_times(start, until, STEPS[tried])
        if len(times) * (len(links) + 1) > MOST_PLACES:
            break
        found, errors = shot(walk, links, times, shares, most_error)
        if found.error <= most_error:
            return replace(found, leap=leap)
        before = _before_leap(walk, times, errors)
        if before < until:
            until, leap = before, True
        else:
            tried += 1
    raise InputError(
        _(
            "frames of {benches} benches from {start} s to {end} s would be off by more than "
            "{error} m or fill more than {most} positions: choose a shorter time"
        ).format(
            benches=len(walk.dragon), start=f"{start:g}", end=f"{until:g}", error=f"{most_error:g}",
            most=MOST_PLACES,
        )
    )  # fmt: skip


def check_farthest(walk: Walk, start: float, end: float) -> float:
    """Refuse a walk from start to end, s, that goes beyond FARTHEST.

    Where the front handle of the tail's bench starts, m.

    Raises:
        InputError: if it does.
        WalkError: if the dragon does not stand at the start.
    """
    s = walk.motion([start]).s[0]
    farthest = max(-float(s.min()), float(walk.head_position([end])[0]))
    if farthest > FARTHEST:
        text = _("a player shows {most} m of a route, and this walk goes to {far} m")
        raise InputError(text.format(most=f"{FARTHEST:g}", far=f"{farthest:g}"))
    return float(s[-2])


def even_times(start: float, end: float, step: float) -> FloatArray:
    """Times from start to end, s, evenly spaced by so much, s, or a little less."""
    return np.linspace(start, end, max(math.ceil((end - start) / step - 1e-9), 1) + 1)


def shot(
    walk: Walk, links: FloatArray, times: FloatArray, shares: Shares, most: float = math.inf
) -> tuple[Frames, FloatArray]:
    """Frames of handles so linked at times, s; the error of each, m, until the next.

    Sampling ends once one is off by more than `most`, m.
    """
    step, handles = float(times[-1] - times[0]) / (len(times) - 1), len(links) + 1
    table, errors = np.zeros((handles, len(times)), dtype=np.int64), np.zeros(len(times))
    kept = kernel.Shot(table, errors, np.empty(kernel.SLOTS), empty_placements(handles, kernel.SLOTS))
    for share in (0.0, *shares):
        at = times[:-1] + share * step if share else times
        budget.spend(handles * len(at))
        kernel.look_at_frames(
            walk.route.rows, links, walk.head_position(at), walk.profile.speed(at), 0, len(at), share,
            step, math.inf, kept,
        )  # fmt: skip
        if errors.max() > most:
            break
    error = float(errors.max())
    places, speeds = table >> kernel.HALF, table & kernel.LOW
    return Frames(float(times[0]), step, places, speeds, error, False), errors[:-1]


def _before_leap(walk: Walk, times: FloatArray, errors: FloatArray) -> float:
    """When frames at these times, s, are to end, as a bench leaps behind one; inf if none."""
    far = int(np.argmax(errors > LEAP))
    if errors[far] <= LEAP:
        return math.inf
    close = even_times(float(times[far]), float(times[far + 1]), CLOSE)
    leaps = shot(walk, walk.dragon.links, close, (0.5,))[1] > LEAP
    return float(close[np.argmax(leaps)]) - BEFORE if leaps.any() else math.inf


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
        stretches: of evenly spaced nodes, as in kernels/following.py.
        nodes: x, y (m, from `origin`) and heading (rad) of all nodes, float32, (3, nodes).
        origin: m.
        error: the largest distance of a cubic from the route, m, in samples.
    """

    stretches: FloatArray
    nodes: Nodes
    origin: tuple[float, float]
    error: float


def course(walk: Walk, low: float, high: float) -> Course:
    """The route from position low to high, m, in cubics within STRETCH_ERROR."""
    route = walk.route
    x, y = np.round(route.point(np.array([high]))[0], 3).tolist()
    edges = np.empty(math.ceil((high - low) / LONGEST) + len(route.joints) + 2)
    nodes, found, worst = np.empty((3, MOST_STRETCH_NODES + 1)), list[Nodes](), 0.0
    scratch = np.empty(1), empty_placements(2, 1)
    count = find_edges(route.rows, route.joints, np.empty(0), low, high, *scratch, edges)
    stretches, first = np.empty((count - 1, STRETCH_COLUMNS)), 0
    for n, (a, b) in enumerate(pairwise(edges[:count].tolist())):
        count, error = draw_stretch(route.rows, a, b, x, y, nodes)
        found.append(nodes[:, :count].astype(np.float32))
        stretches[n] = a, (b - a) / (count - 1), first, count
        first, worst = first + count, max(worst, error)
    return Course(stretches, np.concatenate(found, axis=1), (x, y), worst)
