"""A dragon on a route: where every handle is and how fast, at any time."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, WalkError, brought_by, finite, of_kind, whole
from benchdragon.i18n import _
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import MOST_METRES, FloatArray
from benchdragon.kernels.local_minima import head_where_tail
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.status import Status
from benchdragon.methods import Method
from benchdragon.model.arrays import as_numbers
from benchdragon.model.asked import Asked
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon
from benchdragon.model.placement import Placement, Rows, chosen_by, frozen
from benchdragon.model.profile import SpeedProfile

if TYPE_CHECKING:
    import pandas
    import xarray

    from benchdragon.figures import plots

# Handles times times that one Motion may hold: 40 bytes each at first, 100 when all is asked for.
MOST_PLACES = 50_000_000
# Tables that hold a number for each handle.
HANDLE_TABLES = ("x", "y", "s", "speed", "acceleration")
# Threads of one motion.
MOST_WORKERS = 64
# The same for one slice of `Walk.motions`: 40 to 100 MB.
SLICE_PLACES = 1_000_000
# Distance from the last sound place within which a failure is located, m.
FAILURE_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Walk(Asked):
    """A dragon, the route it walks, and the head's speed; what is asked of walks are its methods, too.

    Args:
        dragon: the benches.
        route: what every handle stays on.
        profile: the head's speed over time.
        start: route position of the head's handle at time 0, m.

    Examples:
        >>> route = bd.Route((bd.Spiral.between(0.55, 8.8, 0.0),))
        >>> walk = bd.Walk(bd.Dragon.uniform(), route)
        >>> walk.first_contact(0.0, 430.0).witness.benches
        (1, 9)
    """

    dragon: Dragon
    route: Route
    profile: SpeedProfile = field(default_factory=lambda: SpeedProfile.constant(1.0))
    start: float = 0.0

    def __post_init__(self) -> None:
        of_kind("dragon", self.dragon, Dragon)
        of_kind("route", self.route, Route, _("Route((curve,)) is the route of one curve"))
        hint = _("SpeedProfile.constant(1.0) is the same speed at all times")
        of_kind("profile", self.profile, SpeedProfile, hint)
        if abs(finite("start", self.start, "m")) > MOST_METRES:
            raise InputError(_("start must lie within 1e8 m, not at {s} m").format(s=f"{self.start:g}"))

    def head_position(self, times: npt.ArrayLike) -> FloatArray:
        """Route positions of the head's handle at `times`, m, (times,): exact up to rounding."""
        return self.start + self.profile.distance(_clock(times))

    def time_at(self, s: float) -> float:
        """When the head comes to route position s, m; infinite where it never does."""
        return self.profile.time(s - self.start)

    def span(self) -> tuple[float, float]:
        """From time 0 until the head comes to the end of its route, s.

        Raises:
            InputError: if it never does.
        """
        end = self.time_at(self.route.length)
        if not math.isfinite(end):
            raise InputError(_("the head never comes to the end of its route: say start and end"))
        return 0.0, end

    def placement(self, s: npt.ArrayLike, *, throw: bool = True) -> Placement:
        """The dragon with its head at route positions s, m, whenever that may be.

        Raises:
            WalkError: with `throw`, for the first position that fails, at the time it is come to.
        """
        placed = Placement(self.dragon, self.route, s)
        if throw and placed.status.any():
            raise self.failure(placed, int(np.flatnonzero(placed.status)[0]))
        return placed

    def failure(self, placed: Placement, i: int) -> WalkError:
        """The WalkError of position number i of a placement on this walk, with the time it happens."""
        return placed.failure(i).at(self.time_at(float(placed.head_s[i])))

    def first_failure(self, at: FloatArray) -> WalkError | None:
        """Where the dragon first cannot stand, its head at or between increasing positions, m, (T,).

        It is sought at these; the first failure is then refined towards the position before it, or the
        route's end. None where none fails.
        """
        length = self.route.length
        placed = self.placement(np.minimum(at, length), throw=False)
        failed = np.flatnonzero(placed.status)
        if not failed.size:
            end = WalkError(Status.AFTER_ROUTE, 0, length, length, f"{length:.6g} m")
            return end.at(self.time_at(length)) if at[-1] > length + END_SLACK else None
        n = int(failed[0])
        stands, fails = float(placed.head_s[max(n - 1, 0)]), float(placed.head_s[n])
        while stands < (middle := 0.5 * (stands + fails)) < fails - 0.5 * FAILURE_TOLERANCE:
            if self.placement([middle], throw=False).status[0]:
                fails = middle
            else:
                stands = middle
        return self.failure(self.placement([fails], throw=False), 0)

    def exact_head_position(self, t: float) -> Fraction:
        """The route position of the head's handle at a finite time t, m, without any rounding."""
        return Fraction(self.start) + self.profile.exact_distance(t)

    def head_where_tail(self, s: float) -> float:
        """The head's route position, m, when the last handle has come to route position s (m).

        Within 1e-9 m, and not before; the route's end if that comes first.
        """
        places = empty_placements(len(self.dragon) + 1, 1)
        return head_where_tail(
            self.route.rows, self.dragon.links, finite("s", s, "m"), np.empty(1), places
        )

    def motion(self, times: npt.ArrayLike, *, throw: bool = True, workers: int = 1) -> "Motion":
        """Where every handle is, and how fast, at `times` (s, any order, negative ones too).

        Args:
            times: a number or a list of T.
            throw: whether a time at which the dragon cannot stand raises. If not, the Motion holds
                the status, and NaN from the handle that found no place on.
            workers: threads; the numbers do not depend on it.

        Raises:
            InputError: for times that are not finite, or too many at once.
            WalkError: with `throw`, for the first time in the list that fails.
        """
        return self.motion_at(times, self.head_position(times), throw=throw, workers=workers)

    def motion_at(
        self, times: npt.ArrayLike, head_s: FloatArray, *, throw: bool = True, workers: int = 1
    ) -> "Motion":
        """The motion with the head at given route positions, m, (T,), found by other means."""
        clock = _clock(times)
        whole("workers", workers, 1, MOST_WORKERS)
        if clock.size * (len(self.dragon) + 1) > MOST_PLACES:
            text = _("{asked} positions (handles by times) are more than one motion may hold ({most})")
            raise InputError(text.format(asked=clock.size * (len(self.dragon) + 1), most=MOST_PLACES))
        motion = Motion(self, clock, head_s, workers=workers)
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
        text = _("times must be one list, not a table of shape {shape}")
        raise InputError(text.format(shape=clock.shape))
    if not np.isfinite(clock).all():
        text = _("times must be finite, not {value}")
        raise InputError(text.format(value=f"{clock[~np.isfinite(clock)][0]} s"))
    return clock


class Motion(Placement):
    """Places and speeds of all handles at T times; every table has one row a time.

    Attributes:
        walk: what moved.
        times: s, (T,).

    Examples:
        >>> motion = bd.read_plan("spiral-in").motion([0.0, 300.0])
        >>> motion.x.shape, motion.heading.shape, motion.corners().shape
        ((2, 224), (2, 223), (2, 223, 4, 2))
        >>> motion.x[:, 0].round(6), motion[1].times
        (array([8.8     , 4.420274]), array([300.]))
    """

    plot = plots.plot_motion if TYPE_CHECKING else Method("plot_motion")
    plot_speeds = plots.plot_speeds if TYPE_CHECKING else Method("plot_speeds")
    _repr_html_ = Method("as_html")

    def __init__(self, walk: Walk, times: FloatArray, head_s: FloatArray, *, workers: int = 1) -> None:
        super().__init__(walk.dragon, walk.route, head_s, workers=workers)
        self.walk, self.times = walk, frozen(times)

    def __getitem__(self, rows: Rows) -> Self:
        """The same at some of its times: by number, from 0, by slice, by a list or a mask."""
        part = super().__getitem__(rows)
        part.times = np.atleast_1d(self.times[chosen_by(rows)])
        return part

    def __repr__(self) -> str:
        handles, times = self._x.shape
        return f"<Motion of {handles} handles at {times} times>"

    @cached_property
    def head_speed(self) -> FloatArray:
        """Speed of the head's handle, m/s, (T,)."""
        return frozen(self.walk.profile.speed(self.times))

    @cached_property
    def speed(self) -> FloatArray:
        """Speed of every handle along the route, m/s, (T, N + 1)."""
        return frozen(self.speed_ratio * self.head_speed[:, np.newaxis])

    @cached_property
    def acceleration(self) -> FloatArray:
        """Rate of change of every handle's speed along the route, m/s^2, (T, N + 1).

        Exact between joints; where the route's curvature jumps as a handle crosses a joint, it jumps.
        """
        head_rate = self.walk.profile.acceleration(self.times)
        speed2 = np.square(self.head_speed)
        rate = self._ratio.T * head_rate[:, np.newaxis] + self.ratio_rate * speed2[:, np.newaxis]
        return frozen(rate)

    @cached_property
    def turning_rate(self) -> FloatArray:
        """Turning rate of every bench, rad/s, left positive, (T, N)."""
        return frozen(self.turning_ratio * self.head_speed[:, np.newaxis])

    def failure(self, i: int) -> WalkError:
        """The WalkError that describes how time number i failed."""
        return super().failure(i).at(float(self.times[i]))

    def to_dataframe(self) -> "pandas.DataFrame":
        """The handles' tables as a pandas DataFrame, a row a time and handle (needs the extra `data`).

        Indexed by time (s) and handle (from 0); x, y, s (m), speed (m/s) and acceleration (m/s^2).
        """
        with brought_by("data"):
            import pandas  # an optional extra
        index = pandas.MultiIndex.from_product(
            [self.times, range(len(self.walk.dragon) + 1)], names=["time", "handle"]
        )
        tables = {name: getattr(self, name).ravel() for name in HANDLE_TABLES}
        return pandas.DataFrame(tables, index=index)

    def to_xarray(self) -> "xarray.Dataset":
        """The tables as an xarray Dataset with units (needs the extra `data`)."""
        with brought_by("data"):
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
