"""The room that is missing where people have too little: for the pair that first lacks it, and when.

A level of room is first broken by one pair: the shortage is measured between these two.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from benchdragon.analysis.distance import boxes
from benchdragon.analysis.obstacle_distance import nearest_boxes
from benchdragon.kernels import box as kernel
from benchdragon.kernels.box import Box
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk

# Times at which a pair is sampled from its first contact on, denser near it, and again about the
# tightest of them; decimals of the time that is reported, s.
SAMPLES, CLOSER, DECIMALS = 200, 50, 2
# Room within this of the least, m, counts as the least: rounding must not choose the moment.
LEVEL = 1e-6
HALVINGS = 50


@dataclass(frozen=True)
class Shortage:
    """The room that a pair lacks when it is tightest.

    Attributes:
        key: of the plan's people: sway, imprecision, beside or ahead.
        wanted: the value required, m.
        time: s; the tightest of the times sampled.
        apart: distance then of the boards, or of a board and the obstacle, m.
        there: the greatest value of the key with which the pair would then keep its room, m; 0 if none.
    """

    key: str
    wanted: float
    time: float
    apart: float
    there: float


@dataclass(frozen=True)
class _Need:
    """The distance that a pair must keep, m, as a function of one of the required values."""

    key: str
    wanted: float
    margin: float
    counted: float
    beside: float

    def slack(self, seen: "_Seen", value: float) -> list[float]:
        """How much more than it must the pair keeps at each time, m; negative where it does not."""
        if self.key == "beside":
            return [apart - self.margin for apart in seen.apart(value, 0.0)]
        if self.key == "ahead":
            return [apart - self.margin for apart in seen.apart(self.beside, value)]
        more = self.counted * (self.wanted - value)
        return [apart - self.margin + more for apart in seen.apart(0.0, 0.0)]

    def kept(self, seen: "_Seen", value: float) -> bool:
        """Whether the pair keeps more than it must at all times, with that value."""
        return min(self.slack(seen, value)) > 0.0


class _Seen:
    """A pair of benches (rows), or one and an obstacle, at some times, s."""

    def __init__(
        self, walk: Walk, times: Sequence[float], rows: Sequence[int], obstacle: Obstacle | None
    ) -> None:
        motion = walk.motion(times)
        self.obstacle, self.headed = obstacle, rows[0] == 0
        self.boards = np.array([boxes(motion, t)[list(rows)] for t in range(len(times))])

    def apart(self, beside: float, ahead: float) -> list[float]:
        """How far the two are apart at each time with so much room on both sides and ahead, m."""
        table = self.boards.copy()
        table[:, :, Box.HALF_WIDTH] += beside
        if self.headed:
            table[:, 0, Box.HALF_LENGTH] += 0.5 * ahead
            table[:, 0, Box.CX] += 0.5 * ahead * table[:, 0, Box.UX]
            table[:, 0, Box.CY] += 0.5 * ahead * table[:, 0, Box.UY]
        count, flat = len(table), table.reshape(-1, kernel.BOX_COLUMNS)
        if self.obstacle is not None:
            out = nearest_boxes(flat, self.obstacle)[0] - self.obstacle.radius
            out[self.obstacle.forbids(flat[:, [Box.CX, Box.CY]])] = -np.inf
            return list(out.tolist())
        gap, out = np.empty(count), np.empty(count)
        first = np.arange(0, 2 * count, 2)
        kernel.pair_distances(flat, first, first + 1, gap, out)
        return list(out.tolist())


def shortage(
    walk: Walk, broken: tuple[Answer, Obstacle | None], margin: float, asked: Mapping[str, float],
    end: float,
) -> Shortage | None:  # fmt: skip
    """The shortage of the pair that first breaks a level of room, until the end, s.

    None where too little is missing to be reported. The walk is that of the boards alone.

    Args:
        walk: the walk that is sampled.
        broken: when the level is first broken, and the obstacle, if it is one.
        margin: that two benches must keep, m; an obstacle has its own.
        asked: the level's requirements by key, m.
        end: of the samples, s; the dragon stands until then.
    """
    contact, obstacle = broken
    if contact.witness is None:
        return None
    start, rows = contact.value, [bench - 1 for bench in contact.witness.benches]
    kept = margin if obstacle is None else obstacle.margin
    key = _lacking(_Seen(walk, [start], rows, obstacle), kept, asked)
    counted = 2.0 if obstacle is None else 1.0
    need = _Need(key, asked[key], kept, counted, asked.get("beside", 0.0))
    shares = np.linspace(0.0, 1.0, SAMPLES).tolist()
    times = [start + (end - start) * (share * share) for share in shares]
    _room, at = _least(need, _Seen(walk, times, rows, obstacle))
    about = np.linspace(times[max(at - 1, 0)], times[min(at + 1, SAMPLES - 1)], CLOSER).tolist()
    _room, at = _least(need, _Seen(walk, about, rows, obstacle))
    when = min(max(round(about[at], DECIMALS), start), end)
    tightest = _Seen(walk, [when], rows, obstacle)
    there, _at = _least(need, tightest)
    if there >= need.wanted:
        return None
    return Shortage(key, need.wanted, when, tightest.apart(0.0, 0.0)[0], there)


def _lacking(seen: _Seen, margin: float, asked: Mapping[str, float]) -> str:
    """Which of the keys asked for lacks at the one time that is seen."""
    keys = list(asked)
    if "ahead" not in keys:
        return keys[0]
    aside = seen.apart(asked.get("beside", 0.0), 0.0)[0] - margin
    return "ahead" if "beside" not in keys or (seen.headed and aside > LEVEL) else "beside"


def _least(need: _Need, seen: _Seen) -> tuple[float, int]:
    """The greatest value with which the pair always keeps its room, and when it is the tightest."""
    kept, broken = 0.0, need.wanted
    if need.kept(seen, broken):
        kept = broken
    elif not need.kept(seen, kept):
        broken = kept
    else:
        for _halving in range(HALVINGS):
            middle = 0.5 * (kept + broken)
            if need.kept(seen, middle):
                kept = middle
            else:
                broken = middle
    slack = need.slack(seen, broken)
    least = min(slack)
    return kept, next(n for n, more in enumerate(slack) if more <= least + LEVEL)
