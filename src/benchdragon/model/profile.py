"""The head's speed over time, and the distance walked by then.

No differential equation is needed: distance is the exact integral of the profile, and the route turns
a distance into a place.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple, Self, TypeVar

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, as_number, finite, not_negative
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.arrays import as_list, as_numbers

# m/s; no walker is faster, and it keeps distances within what doubles resolve.
MOST_SPEED = 100.0
Knot = TypeVar("Knot", int, float)


class Stretches(NamedTuple):
    """A walk cut where the head's acceleration jumps: rows of N stretches, each from start to end."""

    times: FloatArray  # s, (N, 2)
    ways: FloatArray  # distance walked from time 0 on, m, (N, 2)
    speeds: FloatArray  # of the head, m/s, (N, 2)
    rates: FloatArray  # its acceleration, m/s^2, (N,)

    def moved(self, way: float) -> Self:
        """The same with `way`, m, added to all ways."""
        return self._replace(ways=np.array([(a + way, b + way) for a, b in self.ways.tolist()]))

    def time(self, n: int, way: float) -> float:
        """When the head comes to `way` on stretch n, s."""
        (first, last), (slow, fast) = self.ways[n].tolist(), self.speeds[n].tolist()
        (start, end), ahead = self.times[n].tolist(), way - first
        share = min(ahead / (last - first), 1.0) if ahead > 0.0 else 0.0
        speed = math.sqrt(slow * slow + share * (fast * fast - slow * slow))
        return float(min(start + 2.0 * ahead / (slow + speed), end) if ahead > 0.0 else start)


def _ends(values: FloatArray) -> FloatArray:
    """The values at the two ends of the spans between them, (spans, 2)."""
    return np.array([*pairwise(values.tolist())])


def _along(profile: "SpeedProfile", times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Ways walked by times, m, and speeds then; accelerations after all times but the last."""
    return profile.distance(times), profile.speed(times), profile.acceleration(times[:-1])


@dataclass(frozen=True)
class SpeedProfile:
    """Head speed over time, linear between knots and constant beyond the first and the last.

    Args:
        times: of the knots, s, increasing.
        speeds: at the knots, m/s, not negative: 0 is a stop.

    Examples:
        >>> profile = bd.SpeedProfile((0.0, 5.0), (1.0, 0.5))
        >>> profile.speed([0.0, 2.5, 9.0])
        array([1.  , 0.75, 0.5 ])
    """

    times: tuple[float, ...]
    speeds: tuple[float, ...]

    def __post_init__(self) -> None:
        for name in ("times", "speeds"):
            object.__setattr__(self, name, as_list(name, getattr(self, name)))
        if len(self.times) != len(self.speeds) or not self.times:
            text = _("a speed profile needs as many times as speeds, at least one, not {a} and {b}")
            raise InputError(text.format(a=len(self.times), b=len(self.speeds)))
        for t in self.times:
            finite("profile", t, "s")
        for v in self.speeds:
            if not_negative("speed", v, "m/s") > MOST_SPEED:
                raise InputError(_("speed must be at most 100 m/s, not {v} m/s").format(v=f"{v:g}"))
        if any(b <= a for a, b in zip(self.times, self.times[1:], strict=False)):
            raise InputError(_("the times of a speed profile must increase"))

    @classmethod
    def constant(cls, speed: float) -> Self:
        """The same speed, m/s, at all times."""
        return cls((0.0,), (speed,))

    def __len__(self) -> int:
        """Number of knots."""
        return len(self.times)

    def __getitem__(self, i: int) -> tuple[float, float]:
        """Time, s, and speed, m/s, of knot number i, from 0."""
        return self.times[i], self.speeds[i]

    def __iter__(self) -> Iterator[tuple[float, float]]:
        """Time, s, and speed, m/s, of each knot."""
        return zip(self.times, self.speeds, strict=True)

    def speed(self, t: npt.ArrayLike) -> FloatArray:
        """Head speed at times t, m/s."""
        return np.asarray(np.interp(as_numbers("times", t), self.times, self.speeds))

    def acceleration(self, t: npt.ArrayLike) -> FloatArray:
        """Rate of change of the head's speed, m/s^2; at a knot that of the span after it."""
        return self._slopes[np.searchsorted(self.times, as_numbers("times", t), side="right")]

    def distance(self, t: npt.ArrayLike) -> FloatArray:
        """Distance walked from time 0 to times t, m, exact; negative before 0."""
        return self._from_first(as_numbers("times", t)) - self._from_first(np.asarray(0.0))

    def exact_distance(self, t: float, read: Callable[[float], Fraction] = Fraction) -> Fraction:
        """Distance walked from time 0 to a finite time t, m, without any rounding.

        `read` says which number each double stands for: itself, or the decimal that names it.
        """
        numbers = (t, *self.times, *self.speeds)
        return Fraction(*self._excess([read(number).as_integer_ratio() for number in numbers]))

    def past(self, t: float, ways: Sequence[float]) -> int:
        """Above 0 if by a finite time t more is walked from time 0 on than `ways`, m, together.

        Below 0 if less is, 0 if as much: without any rounding.
        """
        numbers = (t, *self.times, *self.speeds, *ways)
        return self._excess([number.as_integer_ratio() for number in numbers])[0]

    def _excess(self, ratios: list[tuple[int, int]]) -> tuple[int, int]:
        """How much farther than some ways, m, the head walks from time 0 to a time, as a ratio.

        `ratios`: that time, those of the knots, their speeds, and the ways.
        """
        unit = math.lcm(*(under for _over, under in ratios))
        t, *numbers = (over * (unit // under) for over, under in ratios)
        count = len(self.times)
        times, speeds, ways = numbers[:count], numbers[count : 2 * count], numbers[2 * count :]
        (there, p), (here, q) = (_walked(times, speeds, unit, at) for at in (t, t - t))
        over, under = there * q - here * p, p * q
        for way in ways:
            over -= (way + way) * unit * under
        return over, (unit + unit) * unit * under

    def stretches(self, start: float, end: float) -> Stretches:
        """The walk from start to end, s, in stretches of one acceleration: from knot to knot."""
        times = np.array([start, *(t for t in self.times if start < t < end), end])
        ways, speeds, rates = _along(self, times)
        return Stretches(_ends(times), _ends(ways), _ends(speeds), rates)

    def time(self, distance: float) -> float:
        """The first time, s, by which `distance` (m, from time 0) is walked: inverse of `distance`.

        Infinite where the head stops for good before; minus infinite where it never started after.
        """
        wanted = as_number("distance", distance) + float(self._from_first(np.asarray(0.0)))
        times, speeds = self.times, self.speeds
        n = int(np.searchsorted(self._sums, wanted, side="left"))
        if n == 0 or n == len(times):
            knot, speed = (0, speeds[0]) if n == 0 else (-1, speeds[-1])
            ahead = wanted - float(self._sums[knot])
            if ahead and not speed:
                return math.copysign(math.inf, ahead)
            return times[knot] + (ahead / speed if ahead else 0.0)
        ahead, slope = wanted - float(self._sums[n - 1]), float(self._slopes[n])
        # The stable root of slope t^2 / 2 + speed t = ahead.
        speed = speeds[n - 1]
        root = math.sqrt(max(speed * speed + 2.0 * slope * ahead, 0.0))
        return min(times[n - 1] + 2.0 * ahead / (speed + root), times[n])

    @cached_property
    def _slopes(self) -> FloatArray:
        inner = ((w - v) / (b - a) for a, b, v, w in _spans(self.times, self.speeds))
        return np.array([0.0, *inner, 0.0])

    @cached_property
    def _sums(self) -> FloatArray:
        sums = [0.0]
        for a, b, v, w in _spans(self.times, self.speeds):
            sums.append(sums[-1] + 0.5 * (w + v) * (b - a))
        return np.array(sums)

    def _from_first(self, t: FloatArray) -> FloatArray:
        knot = np.maximum(np.searchsorted(self.times, t, side="right") - 1, 0)
        dt = t - np.asarray(self.times)[knot]
        slope = np.where(dt < 0.0, 0.0, self._slopes[knot + 1])
        # A head at rest does not move in infinite time either.
        speed = np.asarray(self.speeds)[knot]
        with np.errstate(over="ignore"):
            speed = speed + 0.5 * slope * np.where(slope == 0.0, 0.0, dt)
            return np.asarray(self._sums[knot] + speed * np.where(speed == 0.0, 0.0, dt))


def _spans(times: Sequence[Knot], speeds: Sequence[Knot]) -> Iterator[tuple[Knot, Knot, Knot, Knot]]:
    """Start and end of each span between knots, and the speeds there."""
    return zip(times, times[1:], speeds, speeds[1:], strict=False)


def _walked(times: list[int], speeds: list[int], unit: int, t: int) -> tuple[int, int]:
    """Twice the distance walked from the first knot to time t, as a ratio: 1 is `unit` in all."""
    before, after = min(t - times[0], t - t), max(t - times[-1], t - t)
    twice = (speeds[0] + speeds[0]) * before + (speeds[-1] + speeds[-1]) * after
    for a, b, v, w in _spans(times, speeds):
        if t >= b:
            twice += (v + w) * (b - a)
        elif t > a:
            gone, span = t - a, b - a
            return twice * span + ((v + v) * span + (w - v) * gone) * gone, span
    return twice * unit, unit
