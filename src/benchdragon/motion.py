"""A dragon on a route: where every handle is and how fast, at any time."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from benchdragon.arrays import as_numbers
from benchdragon.curves import MOST_METRES, Route, Spiral
from benchdragon.dragon import Dragon
from benchdragon.errors import InputError, WalkError, finite
from benchdragon.kernels.chain import march, rates
from benchdragon.kernels.curve import FloatArray, spiral_length
from benchdragon.kernels.route import IntArray, positions
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.status import Status
from benchdragon.leader import LEADER_METHODS, LeaderMethod, SpeedProfile, head_angles
from benchdragon.messages import _

if TYPE_CHECKING:
    import xarray

# Handles times times that one Motion may hold: 40 bytes each at first, 100 when all is asked for.
MOST_PLACES = 50_000_000
# The same for one slice of `Walk.motions`: 40 to 100 MB.
SLICE_PLACES = 1_000_000
# How exactly it is told where the head is when the tail comes somewhere, m.
TAIL_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Walk:
    """A dragon, the route it walks, and the head's speed.

    Args:
        dragon: the benches.
        route: what every handle stays on.
        profile: the head's speed over time.
        start: route position of the head's handle at time 0, m.
    """

    dragon: Dragon
    route: Route
    profile: SpeedProfile = field(default_factory=lambda: SpeedProfile.constant(1.0))
    start: float = 0.0

    def __post_init__(self) -> None:
        if abs(finite("start", self.start, "m")) > MOST_METRES:
            raise InputError(_("start must lie within 1e8 m, not at {s} m").format(s=f"{self.start:g}"))

    def head_position(
        self, times: npt.ArrayLike, leader: LeaderMethod = "closed-form", step: float = 0.1
    ) -> FloatArray:
        """Route positions of the head's handle at `times`, m, (times,).

        "closed-form" is exact. "rk4" and "adaptive" integrate the spiral's differential equation
        (see `leader.head_angles`) and need the head to stay on one spiral.
        """
        clock = _clock(times)
        exact = self.start + self.profile.distance(clock)
        if leader not in LEADER_METHODS:
            raise InputError(
                _("leader must be one of {known}, not {method}").format(
                    known=", ".join(LEADER_METHODS), method=leader
                )
            )
        if leader == "closed-form":
            return exact
        part = self._only_part(exact, leader)
        curve = self.route.curves[part]
        if not isinstance(curve, Spiral):
            raise InputError(
                _(
                    "{method} integrates the equation of a spiral, and the head walks another curve"
                ).format(method=leader)
            )
        start = self.start - float(self.route.joints[part])
        theta = head_angles(curve, self.profile, start, clock.tolist(), leader, step)
        ahead = np.array([spiral_length(curve.k, angle) for angle in theta])
        way = 1.0 if curve.end_angle > curve.start_angle else -1.0
        walked = way * (ahead - spiral_length(curve.k, curve.start_angle))
        return np.asarray(self.route.joints[part] + walked)

    def head_where_tail(self, s: float) -> float:
        """The head's route position, m, when the last handle has come to route position s (m).

        Within 1e-9 m, and not before; the route's end if that comes first.
        """
        still = Walk(self.dragon, self.route)
        low, high = s, self.route.length
        at = s + float(self.dragon.links.sum())
        while high - low > TAIL_TOLERANCE:
            if not low < at < high:
                at = 0.5 * (low + high)
                if at in (low, high):
                    break
            stand = still.motion([at], throw=False)
            ahead, slope = float(stand.s[0, -1]) - s, float(stand.speed_ratio[0, -1])
            low, high = (low, at) if ahead >= 0.0 else (at, high)  # NaN counts as not yet there
            # Newton's step, a little to the other side of the place sought.
            side = -0.4 if ahead >= 0.0 else 0.4
            at += side * TAIL_TOLERANCE - ahead / (slope or np.nan)
        return high

    def _only_part(self, s: FloatArray, leader: str) -> int:
        last = len(self.route.curves) - 1
        asked = np.append(s, self.start)
        parts = np.clip(np.searchsorted(self.route.joints, asked, side="right") - 1, 0, last)
        if np.ptp(parts):
            raise InputError(
                _("{method} needs the head on one spiral at all times, not on several curves").format(
                    method=leader
                )
            )
        return int(parts[0])

    def motion(
        self,
        times: npt.ArrayLike,
        *,
        throw: bool = True,
        workers: int = 1,
        leader: LeaderMethod = "closed-form",
        step: float = 0.1,
    ) -> "Motion":
        """Where every handle is, and how fast, at `times` (s, any order, negative ones too).

        Args:
            times: a number or a list of T.
            throw: whether a time at which the dragon cannot stand raises. If not, the Motion holds
                the status, and NaN from the handle that found no place on.
            workers: threads; the numbers do not depend on it.
            leader: road to the head's place, see `head_position`.
            step: of Runge-Kutta, s.

        Raises:
            InputError: for times that are not finite, or too many at once.
            WalkError: with `throw`, for the first time in the list that fails.
        """
        clock = _clock(times)
        if workers < 1:
            raise InputError(_("workers must be at least 1, not {count}").format(count=workers))
        if clock.size * (len(self.dragon) + 1) > MOST_PLACES:
            raise InputError(
                _(
                    "{asked} places (handles by times) are more than one motion may hold ({most})"
                ).format(asked=clock.size * (len(self.dragon) + 1), most=MOST_PLACES)
            )
        s = self.head_position(clock, leader, step)
        motion = _marched(self, clock, s, workers)
        if throw:
            motion.check()
        return motion

    def motions(
        self, times: npt.ArrayLike, *, throw: bool = True, workers: int = 1
    ) -> Iterator["Motion"]:
        """The same in slices of time that need bounded memory, in the order of `times`."""
        clock = _clock(times)
        size = max(1, SLICE_PLACES // (len(self.dragon) + 1))
        size -= size % LANES if size > LANES else 0
        for start in range(0, clock.size, size):
            yield self.motion(clock[start : start + size], throw=throw, workers=workers)


def _clock(times: npt.ArrayLike) -> FloatArray:
    clock = np.atleast_1d(as_numbers("times", times))
    if clock.ndim > 1:
        raise InputError(
            _("times must be one list, not a table of shape {shape}").format(shape=clock.shape)
        )
    if not np.isfinite(clock).all():
        raise InputError(
            _("times must be finite, not {value}").format(value=f"{clock[~np.isfinite(clock)][0]} s")
        )
    return clock


def _marched(walk: Walk, clock: FloatArray, s: FloatArray, workers: int) -> "Motion":
    """March every time, in blocks whose borders do not depend on the number of workers."""
    shape = (len(walk.dragon) + 1, clock.size)
    row, failed = np.empty(shape, dtype=np.int64), np.empty((2, clock.size), dtype=np.int64)
    u, x, y, ratio = (np.empty(shape) for _array in range(4))
    rows, links = walk.route.rows, walk.dragon.links
    if workers == 1 or clock.size <= LANES:
        march(rows, links, s, 0, clock.size, row, u, x, y, ratio, failed)
        return Motion(walk, clock, s, row, u, x, y, ratio, failed)
    share = -(-clock.size // (workers * LANES)) * LANES
    with ThreadPoolExecutor(workers) as pool:
        tasks = [
            pool.submit(
                march, rows, links, s, a, min(a + share, clock.size), row, u, x, y, ratio, failed
            )
            for a in range(0, clock.size, share)
        ]
        for task in tasks:
            task.result()
    return Motion(walk, clock, s, row, u, x, y, ratio, failed)


class Motion:
    """Places and speeds of all handles at T times; every table has one row a time.

    Attributes:
        walk: what moved.
        times: s, (T,).
        head_s: route position of the head's handle, m, (T,).
        status: how each time ended, a `Status`, (T,).
        failed_bench: the bench that found no place, (T,); 0 where none, or the head, failed.
    """

    def __init__(
        self,
        walk: Walk,
        times: FloatArray,
        head_s: FloatArray,
        row: IntArray,
        u: FloatArray,
        x: FloatArray,
        y: FloatArray,
        ratio: FloatArray,
        failed: IntArray,
    ) -> None:
        self.walk, self.times, self.head_s = walk, times, head_s
        # Handle by handle in memory, as the kernels march; time by time to the outside.
        self._row, self._u, self._x, self._y, self._ratio = row, u, x, y, ratio
        self.status, self.failed_bench = failed

    def __repr__(self) -> str:
        handles, times = self._x.shape
        return f"<Motion of {handles} handles at {times} times>"

    def _repr_html_(self) -> str:
        """The walk in a player, for notebooks."""
        # By name, at the last moment: the player stands above this room, and knows motions itself.
        return str(import_module("benchdragon.player").framed_motion(self))

    @property
    def x(self) -> FloatArray:
        """x of every handle, m, (T, N + 1)."""
        return self._x.T

    @property
    def y(self) -> FloatArray:
        """y of every handle, m, (T, N + 1)."""
        return self._y.T

    @property
    def speed_ratio(self) -> FloatArray:
        """Speed of every handle over the head's, (T, N + 1): exact, from the rigid benches."""
        return self._ratio.T

    @cached_property
    def head_speed(self) -> FloatArray:
        """Speed of the head's handle, m/s, (T,)."""
        return self.walk.profile.speed(self.times)

    @cached_property
    def speed(self) -> FloatArray:
        """Speed of every handle along the route, m/s, (T, N + 1)."""
        return self.speed_ratio * self.head_speed[:, np.newaxis]

    @cached_property
    def s(self) -> FloatArray:
        """Route position of every handle, m, (T, N + 1); negative on the extension."""
        out = np.full(self._u.shape, np.nan)
        sound = ~np.isnan(self._u)
        found = np.empty(int(sound.sum()))
        positions(self.walk.route.rows, self._row[sound], self._u[sound], found)
        out[sound] = found
        return out.T

    def state(self, i: int) -> tuple[IntArray, FloatArray]:
        """Row and parameter of every handle at time number i, as the kernels hold them, (N + 1,)."""
        return self._row[:, i], self._u[:, i]

    @cached_property
    def heading(self) -> FloatArray:
        """Heading of every bench, rear handle to front handle, rad, (T, N), in -pi..pi."""
        return np.arctan2(-np.diff(self._y, axis=0), -np.diff(self._x, axis=0)).T

    @cached_property
    def _rates(self) -> tuple[FloatArray, FloatArray]:
        ratio_rate = np.full(self._u.shape, np.nan)
        turn = np.full((self._u.shape[0] - 1, self._u.shape[1]), np.nan)
        rates(
            self.walk.route.rows, self.walk.dragon.links,
            self._row, self._u, self._x, self._y, self._ratio, ratio_rate, turn,
        )  # fmt: skip
        return ratio_rate.T, turn.T

    @cached_property
    def acceleration(self) -> FloatArray:
        """Rate of change of every handle's speed along the route, m/s^2, (T, N + 1).

        Exact between joints; where the route's curvature jumps as a handle crosses a joint, it jumps.
        """
        head_rate = self.walk.profile.acceleration(self.times)
        speed2 = np.square(self.head_speed)
        return self._ratio.T * head_rate[:, np.newaxis] + self._rates[0] * speed2[:, np.newaxis]

    @cached_property
    def turning_rate(self) -> FloatArray:
        """Turning rate of every bench, rad/s, left positive, (T, N)."""
        return self._rates[1] * self.head_speed[:, np.newaxis]

    @cached_property
    def chord_error(self) -> float:
        """Largest difference between a bench's link and the distance of its handles, m."""
        chords = np.hypot(np.diff(self._x, axis=0), np.diff(self._y, axis=0))
        return float(np.nanmax(np.abs(chords - self.walk.dragon.links[:, np.newaxis]), initial=0.0))

    def check(self) -> None:
        """Raise the WalkError of the first time that failed, if one did."""
        failed = np.flatnonzero(self.status != Status.OK)
        if failed.size:
            raise self.failure(int(failed[0]))

    def failure(self, i: int) -> WalkError:
        """The WalkError that describes how time number i failed."""
        status, bench = Status(int(self.status[i])), int(self.failed_bench[i])
        s, size = float(self.head_s[i]), self.walk.route.length
        if bench:
            out = np.empty(1)
            positions(
                self.walk.route.rows,
                self._row[bench - 1 : bench, i],
                self._u[bench - 1 : bench, i],
                out,
            )
            s, size = float(out[0]), float(self.walk.dragon.links[bench - 1])
        return WalkError(status, bench, s, float(self.times[i]), f"{size:.6g} m")

    def to_xarray(self) -> "xarray.Dataset":
        """The tables as an xarray Dataset with units (needs the extra `data`)."""
        import xarray  # an optional extra

        time_handle, time_bench = ("time", "handle"), ("time", "bench")
        variables = {
            "x": (time_handle, self.x, "m", "x of the handle"),
            "y": (time_handle, self.y, "m", "y of the handle"),
            "s": (time_handle, self.s, "m", "route position of the handle"),
            "speed": (time_handle, self.speed, "m s-1", "speed of the handle along the route"),
            "acceleration": (time_handle, self.acceleration, "m s-2", "rate of change of speed"),
            "heading": (time_bench, self.heading, "rad", "heading of the bench"),
            "turning_rate": (time_bench, self.turning_rate, "rad s-1", "turning rate of the bench"),
            "status": (("time",), self.status, "1", "0 where the dragon stands soundly"),
        }
        return xarray.Dataset(
            {
                name: (dims, data, {"units": unit, "long_name": text})
                for name, (dims, data, unit, text) in variables.items()
            },
            coords={
                "time": ("time", self.times, {"units": "s"}),
                "handle": np.arange(self._x.shape[0]),
                "bench": np.arange(1, self._x.shape[0]),
            },
        )
