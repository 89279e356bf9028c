"""A head that stands still at places or times: the speed profile of a walk with holds in it.

The head has at each place the speed that it had there without holds, but near a hold no more than
braking and starting at one rate allow. Squared speeds are linear along the way, so all of it is exact.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from benchdragon.errors import InputError
from benchdragon.model.profile import SpeedProfile

Trouble = Literal["overlap", "room", "unreachable", "outside", "over"]
# Places nearer to one another than this are one, m; rounding of ways is far below.
SAME_PLACE = 1e-9


@dataclass(frozen=True)
class Hold:
    """That the head stands still, at a place or from a time on.

    Attributes:
        way: where, m from where the walk begins; None where a time says it.
        at: from when on, s; None where a place says it.
        seconds: for how long; infinite: until the next start.
    """

    way: float | None = None
    at: float | None = None
    seconds: float = math.inf


class HoldError(InputError):
    """A hold that cannot be: the number of it, from 0, and what kind of trouble it is."""

    def __init__(self, number: int, trouble: Trouble) -> None:
        super().__init__(trouble)
        self.number, self.trouble = number, trouble


class Standing(NamedTuple):
    """Where, m from where the walk begins, and when, s, the head stands for a hold (number, from 0)."""

    number: int
    way: float
    start: float
    end: float


class _Knot(NamedTuple):
    """A moment of the walk: s, m from where it begins, m/s."""

    time: float
    way: float
    speed: float


class _Piece(NamedTuple):
    """A part of the way, m, along which the squared speed changes evenly; or a rest of some seconds."""

    first: float
    last: float
    before: float
    after: float
    rest: float = 0.0

    def square(self, way: float) -> float:
        """The squared speed at a place on the piece."""
        if self.before == self.after:
            return self.before
        share = (way - self.first) / (self.last - self.first)
        return self.before + share * (self.after - self.before)

    def meets(self, way: float, slope: float) -> float:
        """Where the squared speed is that of a head which stands at `way` and gains `slope` a metre."""
        own = (
            0.0 if self.before == self.after else (self.after - self.before) / (self.last - self.first)
        )
        return math.inf if own == slope else way + self.square(way) / (slope - own)


def with_holds(
    profile: SpeedProfile, start: float, holds: Sequence[Hold], starts: Sequence[float], rate: float
) -> tuple[SpeedProfile, list[Standing]]:
    """A profile with holds in it, and where and when each is, one after another.

    Args:
        profile: of the walk without holds, whose speeds stay those at its places.
        start: when the walk begins, s.
        holds: in any order.
        starts: times, s, at which a head starts that stands until then.
        rate: at which the head brakes and starts, m/s^2.

    Raises:
        HoldError: for the first hold that cannot be.
    """
    pieces = _pieces(profile, start)
    pace = _Pace(pieces, rate, sorted(starts), [_Knot(start, 0.0, math.sqrt(pieces[0].before))])
    waiting = set(range(len(holds)))
    while waiting:
        waiting.remove(pace.stand_next(holds, waiting))
    if not pace.over:
        pace.knots += pace.ahead(math.inf)
    return pace.profile(), pace.stood


def _pieces(profile: SpeedProfile, start: float) -> list[_Piece]:
    """A profile from a time on as squared speeds along the way; the last piece has no end."""
    end = max(profile.times[-1], start)
    found = []
    if end > start:
        cut = profile.stretches(start, end)
        ways = (cut.ways - cut.ways[0, 0]).tolist()
        for (t, u), (a, b), (v, w) in zip(cut.times.tolist(), ways, cut.speeds.tolist(), strict=True):
            found.append(_Piece(a, b, v * v, w * w, 0.0 if b > a else u - t))
    way, square = (found[-1].last if found else 0.0), float(profile.speed(end)) ** 2
    return [*found, _Piece(way, math.inf, square, square)]


@dataclass
class _Pace:
    """The knots of a walk so far."""

    pieces: list[_Piece]
    rate: float
    starts: list[float]
    knots: list[_Knot]
    stood: list[Standing] = field(default_factory=list)

    @property
    def over(self) -> bool:
        """Whether the head stands for good."""
        return bool(self.stood) and self.stood[-1].end == math.inf

    def profile(self) -> SpeedProfile:
        """The speed over time."""
        times, _ways, speeds = zip(*self.knots, strict=True)
        return SpeedProfile(times, speeds)

    def stand_next(self, holds: Sequence[Hold], waiting: set[int]) -> int:
        """Go on to the hold that comes first of those waiting, and stand; its number."""
        now = self.knots[-1]
        way, placed = min((w, n) for n in waiting for w in [_or_inf(holds[n].way)])
        at, timed = min((t, n) for n in waiting for t in [_or_inf(holds[n].at)])
        if self.over:
            raise HoldError(min(waiting), "over")
        if self.stood and way <= now.way + SAME_PLACE:
            raise HoldError(placed, "overlap")
        if at < now.time or (self.stood and at == now.time < math.inf):
            raise HoldError(timed, "overlap" if self.stood else "outside")
        if self._brakes_too_late(way):
            raise HoldError(placed, "room")
        ahead = self.ahead(way)
        reached = (ahead or [now])[-1].time if way < math.inf else math.inf
        if at < reached:
            self.knots += self._braked(timed, at, ahead)
            self._stand(timed, holds[timed])
            return timed
        if reached == math.inf:
            raise HoldError(placed, "unreachable")
        self.knots += ahead
        self._stand(placed, holds[placed])
        return placed

    def _brakes_too_late(self, way: float) -> bool:
        """Whether the head is faster now than braking until a place allows."""
        now = self.knots[-1]
        return way > SAME_PLACE and now.speed**2 > 2.0 * self.rate * (way - now.way)

    def ahead(self, target: float) -> list[_Knot]:
        """The knots from now to a place where the head is to stand, or for ever on.

        The last is at an infinite time where the head never comes to that place.
        """
        now = self.knots[-1]
        found = [now]
        if target - now.way <= SAME_PLACE:
            return []
        for piece in self.pieces:
            first, last = max(piece.first, now.way), min(piece.last, target)
            if piece.rest and now.way < piece.first < target:
                found.append(_Knot(found[-1].time + piece.rest, piece.first, 0.0))
            if last <= first:
                continue
            for way in self._cuts(piece, first, last, target):
                found += _reached(found[-1], way, self._speed(piece, way, target))
        return found[1:]

    def _cuts(self, piece: _Piece, first: float, last: float, target: float) -> list[float]:
        """Places on a piece at which the squared speed bends, and where it ends."""
        slope, lines = 2.0 * self.rate, list[tuple[float, float]]()
        if self.stood:
            lines.append((self.knots[-1].way, slope))
        if target < math.inf:
            lines.append((target, -slope))
        cuts = {piece.meets(way, along) for way, along in lines}
        if len(lines) == 2:
            cuts.add(0.5 * (self.knots[-1].way + target))
        return sorted({cut for cut in cuts if first < cut < last} | ({last} - {math.inf}))

    def _speed(self, piece: _Piece, way: float, target: float) -> float:
        """The speed at a place, which nothing that is held exceeds."""
        square = min(piece.square(way), 2.0 * self.rate * (target - way))
        if self.stood:
            square = min(square, 2.0 * self.rate * (way - self.knots[-1].way))
        return math.sqrt(max(square, 0.0))

    def _braked(self, number: int, at: float, ahead: Sequence[_Knot]) -> list[_Knot]:
        """The knots until the head stands at a time, braking before as late as it can."""
        knots = [knot for knot in (self.knots[-1], *ahead) if knot.time < at] or [self.knots[-1]]
        rest = [knot for knot in ahead if knot.time >= at]
        last = knots[-1]
        fast = self._steady(rest[0], last, at) if rest else last.speed
        knots.append(_Knot(at, math.nan, fast))
        if at == last.time and not self.stood:
            return []
        for n in range(len(knots) - 1, 0, -1):
            (t, way, v), (u, _way, w) = knots[n - 1], knots[n]
            early, late = v - self.rate * (at - t), w - self.rate * (at - u)
            if early > 0.0:
                continue
            brakes = t if early == 0.0 else t + (u - t) * early / (early - late)
            speed = self.rate * (at - brakes)
            place = way + 0.5 * (v + speed) * (brakes - t)
            stops = place + 0.5 * speed * (at - brakes)
            begins = [_Knot(brakes, place, speed)] if t < brakes < at else []
            return [*knots[1:n], *begins, _Knot(at, stops, 0.0)]
        raise HoldError(number, "room")

    def _steady(self, after: _Knot, before: _Knot, at: float) -> float:
        """The speed at a time between two knots."""
        share = (at - before.time) / (after.time - before.time) if math.isfinite(after.time) else 0.0
        return before.speed + share * (after.speed - before.speed)

    def _stand(self, number: int, hold: Hold) -> None:
        """Stand from now on, for as long as a hold says."""
        now = self.knots[-1]._replace(speed=0.0)
        self.knots[-1] = now
        end = now.time + hold.seconds
        if hold.seconds == math.inf:
            end = next((time for time in self.starts if time >= now.time), math.inf)
        self.stood.append(Standing(number, now.way, now.time, end))
        if now.time < end < math.inf:
            self.knots.append(_Knot(end, now.way, 0.0))


def _or_inf(value: float | None) -> float:
    return math.inf if value is None else value


def _reached(before: _Knot, way: float, speed: float) -> list[_Knot]:
    """The knot at a place, m, at a speed, m/s; none where it is no later than the one before."""
    ahead, pace = way - before.way, 0.5 * (before.speed + speed)
    time = before.time + (ahead / pace if pace else math.inf)
    return [_Knot(time, way, speed)] if time > before.time else []
