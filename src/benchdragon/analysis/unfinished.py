"""Whether a dance in and out again ends too soon: before its tail has left the turn."""

import math
from dataclasses import dataclass

from benchdragon.i18n import _
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

# The greatest way that a complete dance may lack, m.
NEARLY = 0.01
# Ends are given in tenths of a second; so much of one is rounding.
TENTHS, DUST = 10.0, 1e-6


@dataclass(frozen=True)
class Unfinished:
    """A dance that ends before its tail is out.

    Attributes:
        way: that the head still has to walk until it is, m.
        end: of the walk with which it is, s, in tenths; None where the head never comes so far.
    """

    way: float
    end: float | None

    @property
    def text(self) -> str:
        """The same in words, in the language in use."""
        if self.end is None:
            return self.told
        text = _(
            "the dance ends before the tail is out of the turn: let the walk end at {end} s or later"
        )
        return text.format(end=f"{self.end:.1f}")

    @property
    def told(self) -> str:
        """The sentence for papers, without the plan's keys."""
        text = _("the dance ends before the tail is out of the turn: the head lacks {way} m")
        return text.format(way=f"{self.way:.1f}")


def unfinished(plan: Plan, walk: Walk, end: float) -> Unfinished | None:
    """What a plan's walk in and out lacks if it ends at a time, s.

    None where it lacks nothing, and for routes of other kinds, whose dances may end anywhere.
    """
    if plan.route.kind != "turn":
        return None
    last = plan.route.last_position(walk)
    way = last - float(walk.head_position([end])[0])
    if way <= NEARLY:
        return None
    time = walk.time_at(last)
    enough = last < walk.route.length and math.isfinite(time)
    return Unfinished(way, math.ceil(TENTHS * time - DUST) / TENTHS if enough else None)
