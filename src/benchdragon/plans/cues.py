"""The table of a plan file about time: drum beats, holds, stops and starts, and the tempo."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from benchdragon.errors import brief
from benchdragon.i18n import N_, _, language
from benchdragon.kernels.holds import SAME_PLACE
from benchdragon.model.holds import Hold, HoldError, Standing, Trouble, with_holds
from benchdragon.model.profile import SpeedProfile
from benchdragon.plans.signs import TIME_OF_DAY, narrow
from benchdragon.plans.source import Fault, KeyedError
from benchdragon.plans.tables import (
    MOST_ROUNDS,
    Acceleration,
    LengthOrZero,
    LimitsTable,
    Metres,
    Number,
    OneLine,
    Seconds,
    Table,
)

# Greatest number of cues of a dance.
MOST_CUES = 200
# Beats a minute: slower and faster ones are input errors. Beats of a bar.
LEAST_TEMPO, MOST_TEMPO, MOST_BAR = 20.0, 400.0, 16
# A hold is as long as this at least, s.
LEAST_HOLD = 0.1
# The head brakes by so much less than it may, as a share: rounding must not exceed the limit.
PRUDENCE = 1e-9
# How far a cue may lie beyond the end of the dance, s: rounding.
END_SLACK = 1e-6

Kind = Literal["beat", "hold", "stop", "start", "tempo", "note"]
Tempo = Annotated[Number, Field(ge=LEAST_TEMPO, le=MOST_TEMPO)]

# Names of cues without a text.
NAMES: dict[str, str] = {
    "beat": N_("drum"),
    "hold": N_("hold"),
    "stop": N_("stop"),
    "start": N_("start"),
    "tempo": N_("tempo"),
    "note": N_("note"),
}

TROUBLE: dict[Trouble, str] = {
    "overlap": N_("the head still stands for another cue then: set them farther apart"),
    "room": N_("to stand there the head would have to brake harder than {rate} m/s^2: set it later"),
    "unreachable": N_("the head never comes there"),
    "outside": N_("that is before the dance starts, at {start} s"),
    "over": N_("the dance is over by then: the head has stopped, and no start comes after"),
}

MIDNIGHT = re.compile(r"24:00(?::00)?", re.ASCII)


def time_of_day(text: str) -> str:
    """A time of day in plain signs; refuses what is none."""
    text = narrow(text)
    if MIDNIGHT.fullmatch(text):  # of the day before: the clock shows 0:00
        return "0:00"
    if text and not TIME_OF_DAY.fullmatch(text):
        raise ValueError(_("expected a time of day such as 18:30, not {text}").format(text=brief(text)))
    return text


class CueTable(Table):
    """One cue, at a time or at a place of the head.

    Attributes:
        at: when, s.
        head: where the head is then, m of its walk from the start of the dance.
        place: a point on the ground, m, to which the head is nearest then: for the first time, or in
            a round.
        round: of the dance: that of the place, or the one that the head begins then.
        hold: for how long the head stands, s.
        tempo: beats a minute from then on.
    """

    kind: Kind
    at: Seconds | None = None
    head: LengthOrZero | None = None
    place: tuple[Metres, Metres] | None = None
    round: Annotated[int, Field(ge=1, le=MOST_ROUNDS, strict=True)] | None = None
    hold: Annotated[Seconds, Field(ge=LEAST_HOLD)] | None = None
    tempo: Tempo | None = None
    text: OneLine = ""
    text_zh: OneLine = ""

    @model_validator(mode="after")
    def _whole(self) -> Self:
        check_cue(self)
        return self


def check_cue(cue: CueTable) -> None:
    """Refuse keys of a cue that exclude one another."""
    placed = cue.place is not None or cue.round is not None
    if [cue.at is not None, cue.head is not None, placed].count(True) != 1:
        text = _("a cue needs one of these: at (a time), head (a way), place or round")
        raise ValueError(text)
    if cue.kind == "start" and cue.at is None:
        raise ValueError(_("a start needs at, a time: the head stands until then"))
    for name in ("hold", "tempo"):
        if (getattr(cue, name) is not None) != (cue.kind == name):
            text = _("a cue needs {name} if its kind is {name}, and else has none")
            raise ValueError(text.format(name=name))


def cue_name(cue: CueTable) -> str:
    """The text of a cue in the language in use; its kind, if it has none."""
    own = (cue.text_zh or cue.text) if language() == "zh" else (cue.text or cue.text_zh)
    return own or _(NAMES[cue.kind])


class CuesTable(Table):
    """Drum, tempo, holds and stops.

    Attributes:
        tempo: beats a minute; None: a step a beat.
        bar: beats of a bar.
        acceleration: at which the head brakes and starts, m/s^2; None: limits.head_acceleration.
        clock: the time of day at which the dance starts.
        cue: one after another, or in any order.
    """

    tempo: Tempo | None = None
    bar: Annotated[int, Field(ge=1, le=MOST_BAR, strict=True)] = 4
    acceleration: Acceleration | None = None
    clock: Annotated[str, AfterValidator(time_of_day)] = ""
    cue: Annotated[list[CueTable], Field(max_length=MOST_CUES)] = Field(default_factory=list)


@dataclass(frozen=True)
class Moment:
    """A cue in its time and place.

    Attributes:
        number: of the cue in the plan, from 0.
        cue: the cue.
        time: s.
        way: of the head from the start of the dance, m.
        until: when the head goes on, s: `time` where it is not held, infinite where it stays.
    """

    number: int
    cue: CueTable
    time: float
    way: float
    until: float


@dataclass(frozen=True)
class Paced:
    """The head's speed with all that holds it.

    Attributes:
        profile: the speed.
        start: of the dance, s.
        standings: where the head stands, by the numbers of cues.
        heads: where on its way the head comes to each cue, m; None where a time says when.
    """

    profile: SpeedProfile
    start: float
    standings: tuple[Standing, ...]
    heads: Sequence[float | None] = ()

    @property
    def end(self) -> float:
        """When the head stops for good, s; infinite where it does not."""
        last = self.standings[-1] if self.standings else None
        return math.inf if last is None or last.end < math.inf else last.start

    def way(self, time: float) -> float:
        """How far the head is from where the dance starts at a time, m."""
        return float(self.profile.distance(time) - self.profile.distance(self.start))

    def moments(self, cues: CuesTable) -> tuple[Moment, ...]:
        """All cues, one after another; the time of one to which the head never comes is infinite."""
        held = {one.number: one for one in self.standings}
        found = []
        for n, cue in enumerate(cues.cue):
            if n in held:
                time, way, until = held[n].start, held[n].way, held[n].end
            else:
                head = self.heads[n]
                time = self._time(cue.at, head)
                way = self.way(time) if head is None else head
                until = time
            found.append(Moment(n, cue, time, way, until))
        return tuple(sorted(found, key=lambda one: (one.time, one.number)))

    def _time(self, at: float | None, head: float | None) -> float:
        """When a cue is that holds nothing, s."""
        if head is None:
            return 0.0 if at is None else at
        here = [one.start for one in self.standings if abs(one.way - head) <= SAME_PLACE]
        if here:
            return here[0]
        return max(self.profile.time(head + float(self.profile.distance(self.start))), self.start)


def paced(
    cues: CuesTable, heads: Sequence[float | None], profile: SpeedProfile, start: float,
    limits: LimitsTable,
) -> Paced:  # fmt: skip
    """The head's speed with holds, stops and starts.

    Args:
        cues: of a plan.
        heads: where on its way the head comes to each, m; None where a time says when.
        profile: without them.
        start: of the dance, s.
        limits: of the plan.

    Raises:
        KeyedError: for a cue that cannot be.
    """
    rate = limits.head_acceleration if cues.acceleration is None else cues.acceleration
    if rate > limits.head_acceleration:
        text = _("at most limits.head_acceleration, {limit} m/s^2, is allowed, not {rate}")
        text = text.format(limit=f"{limits.head_acceleration:g}", rate=f"{rate:g}")
        raise KeyedError([Fault("cues.acceleration", text)])
    holding = [n for n, cue in enumerate(cues.cue) if cue.kind in ("hold", "stop")]
    asked = [cues.cue[n] for n in holding]
    holds = [
        Hold(heads[n], cue.at, cue.hold or math.inf) for n, cue in zip(holding, asked, strict=True)
    ]
    starts = [
        (n, cue.at) for n, cue in enumerate(cues.cue) if cue.kind == "start" and cue.at is not None
    ]
    times = [time for _number, time in starts]
    try:
        found, stood = with_holds(profile, start, holds, times, rate * (1.0 - PRUDENCE))
    except HoldError as error:
        text = _(TROUBLE[error.trouble]).format(rate=f"{rate:g}", start=f"{start:g}")
        raise KeyedError([Fault(f"cues.cue.{holding[error.number]}", text)]) from None
    _refuse_idle(starts, {one.end for one in stood if holds[one.number].seconds == math.inf})
    standings = tuple(replace(one, number=holding[one.number]) for one in stood)
    return Paced(found, start, standings, heads)


def _refuse_idle(starts: Sequence[tuple[int, float]], used: set[float]) -> None:
    """Refuse starts at which nothing starts: not at the end of a stop, or not the first there."""
    text = _("the head does not stand and wait then: a start needs a stop before it, and its own")
    seen: set[float] = set()
    faults = []
    for n, time in starts:
        if time not in used or time in seen:
            faults.append(Fault(f"cues.cue.{n}", text))
        seen.add(time)
    if faults:
        raise KeyedError(faults)


def outside(moments: Sequence[Moment], start: float, end: float, way: float) -> list[Fault]:
    """The error of cues outside of a dance, s, in which the head walks so far, m."""
    by_time = _("that is not within the dance, which lasts from {start} s to {end} s")
    by_time = by_time.format(start=f"{start:g}", end=f"{end:.6g}")
    by_place = _("that is not within the dance, in which the head walks {way} m")
    by_place = by_place.format(way=f"{way:.6g}")
    return [
        Fault(f"cues.cue.{one.number}", by_place if one.cue.at is None else by_time)
        for one in moments
        if not start <= one.time <= end + END_SLACK
    ]
