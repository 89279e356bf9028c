"""Where the head stands, by its speed alone: handles stand when it does, and at no other time."""

from typing import NamedTuple

from benchdragon.analysis.clock import Clock
from benchdragon.i18n import _
from benchdragon.model.walk import Walk


class Stop(NamedTuple):
    """A time, s, in which the head stands, and its route position, m."""

    start: float
    end: float
    s: float


def stops_of(walk: Walk, start: float, end: float) -> tuple[Stop, ...]:
    """All times within a span, s, in which the head stands; a moment is none."""
    cut = walk.profile.stretches(start, end)
    found: list[Stop] = []
    for (t, u), speeds in zip(cut.times.tolist(), cut.speeds.tolist(), strict=True):
        if any(speeds) or u <= t:
            continue
        if found and found[-1].end == t:
            found[-1] = found[-1]._replace(end=u)
        else:
            found.append(Stop(t, u, float(walk.head_position([t])[0])))
    return tuple(found)


def stops_text(stops: tuple[Stop, ...], clock: Clock | None = None) -> str:
    """How often the head stands, for how long, and when, in the language in use.

    Times are seconds of the plan unless a clock is given.
    """
    if not stops:
        return _("the head does not stop")

    def tell(time: float) -> str:
        return f"{time:.6g} s" if clock is None else clock.tell(time)

    ends = _("{start} to {end}")
    times = _(", ").join(ends.format(start=tell(one.start), end=tell(one.end)) for one in stops)
    seconds = sum(one.end - one.start for one in stops)
    text = _("stops of the head: {count}, {seconds} s in all ({times})")
    return text.format(count=len(stops), seconds=f"{seconds:.6g}", times=times)


def stops_sentence(stops: tuple[Stop, ...], clock: Clock) -> str:
    """The same as a sentence of a paper."""
    text = _("{all}.").format(all=stops_text(stops, clock))
    return text[:1].upper() + text[1:]
