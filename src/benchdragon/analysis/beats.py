"""The drum of a dance, by rule: runs of even beats, bars counted in before the head starts, strokes."""

import math
from typing import NamedTuple

from benchdragon.plans.schema import Plan

# How near to the end of its run the last beat may lie, as a share of a beat: it belongs to the next.
END_SHARE = 1e-6
# A tempo that is derived from the head's speed is kept within these, beats a minute.
SLOWEST, FASTEST = 20.0, 400.0


class Run(NamedTuple):
    """Even beats from `start` on, s, as long as they come before `end`; the first opens a bar.

    Attributes:
        period: from beat to beat, s.
        bar: beats of a bar.
        counted: whether they only count in, while the head stands.
    """

    start: float
    end: float
    period: float
    bar: int
    counted: bool

    def beats(self) -> int:
        """Number of beats."""
        return max(0, math.ceil((self.end - self.start) / self.period - END_SHARE))

    def time(self, n: int) -> float:
        """Time of beat number n, counted from 0, s."""
        return self.start + n * self.period


class Score(NamedTuple):
    """All beats of a dance.

    Attributes:
        tempo: beats a minute at the start.
        by_step: whether that is a step a beat, not said by the plan.
        runs: of even beats, one after another.
        strokes: times of the drum at cues, s.
    """

    tempo: float
    by_step: bool
    runs: tuple[Run, ...]
    strokes: tuple[float, ...]


def score_of(plan: Plan, start: float, end: float) -> Score:
    """The beats of a plan's dance over a span, s.

    The beats restart when the tempo changes and when the head starts again. While the head stands, the
    drum is silent except for one bar that counts in, or as much of it as there is time for.
    """
    bar, tempo = plan.cues.bar, plan.cues.tempo
    by_step = tempo is None
    if tempo is None:
        tempo = min(max(60.0 * _pace(plan) / plan.people.step, SLOWEST), FASTEST)
    runs: list[Run] = []
    since, period, still = start, 60.0 / tempo, 0.0

    def up_to(until: float) -> None:
        """Add the beats up to a time, after one bar that counts in if the head stood long enough."""
        nonlocal still
        if since < until:
            counted = min(bar, math.floor(still / period))
            if counted:
                runs.append(Run(since - counted * period, since, period, bar, True))
            runs.append(Run(since, until, period, bar, False))
            still = 0.0

    moments = plan.moments()
    for one in (one for one in moments if start <= one.time <= end):
        if one.cue.kind == "tempo" and one.cue.tempo is not None:
            up_to(one.time)
            period, since = 60.0 / one.cue.tempo, max(one.time, since)
        elif one.until > one.time:
            up_to(one.time)
            since, still = min(one.until, end), one.until - one.time
    up_to(end)
    strokes = [one.time for one in moments if one.cue.kind != "note" and start <= one.time <= end]
    return Score(tempo, by_step, tuple(runs), tuple(dict.fromkeys(strokes)))


def counted_in(score: Score) -> Score:
    """The run with a bar that counts in before its first beat, unless it is empty or has one."""
    if not score.runs or score.runs[0].counted:
        return score
    first = score.runs[0]
    lead = Run(first.start - first.bar * first.period, first.start, first.period, first.bar, True)
    return score._replace(runs=(lead, *score.runs))


def _pace(plan: Plan) -> float:
    """The head's usual speed, m/s: as the plan says, or the greatest of its profile."""
    return max((speed for _time, speed in plan.walk.profile), default=plan.walk.speed)
