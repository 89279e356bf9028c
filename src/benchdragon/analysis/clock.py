"""How papers give times: of day if the plan gives the dance's start, otherwise since the start."""

import math
from dataclasses import dataclass

from benchdragon.i18n import _
from benchdragon.plans.signs import TIME_OF_DAY

# A day, s.
DAY = 86_400.0


@dataclass(frozen=True)
class Clock:
    """The one rule for times on papers, to a second.

    Attributes:
        said: the time of day at which the dance starts, "18:30"; "" if the plan says none.
        start: of the dance, s of the plan.
    """

    said: str
    start: float

    def tell(self, time: float) -> str:
        """A time of the plan, s, as text: of day, h:mm:ss, or since the dance starts, m:ss."""
        found = TIME_OF_DAY.fullmatch(self.said)
        if not found:
            return minutes(time - self.start)
        hours, past, more = (int(part or 0) for part in found.groups())
        seconds = _whole(3600 * hours + 60 * past + more + time - self.start) % int(DAY)
        return f"{seconds // 3600}:{seconds // 60 % 60:02d}:{seconds % 60:02d}"

    @property
    def legend(self) -> str:
        """What times on a paper mean, in the language in use: printed once on each."""
        if not self.said:
            return _("Times are minutes and seconds since the dance starts.")
        return _("Times are times of day; the dance starts at {clock}.").format(clock=self.said)


def minutes(seconds: float) -> str:
    """A duration as minutes and seconds, m:ss."""
    whole = _whole(seconds)
    return f"{whole // 60}:{whole % 60:02d}"


def lasting(seconds: float) -> str:
    """A duration as one says it, in the language in use."""
    whole, rest = divmod(_whole(seconds), 60)
    text = _("{minutes} min {seconds} s") if whole else _("{seconds} s")
    return text.format(minutes=whole, seconds=rest)


def _whole(seconds: float) -> int:
    """The nearest second; a half is rounded up."""
    return math.floor(seconds + 0.5)
