"""What a check did not consider, as the plan does not give it: reported with the verdict."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from benchdragon.analysis.room import levels_asked
from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import RouteRow
from benchdragon.model.walk import Walk
from benchdragon.number_format import known
from benchdragon.plans.routes import RUN_UP
from benchdragon.plans.schema import Plan

# Rounding of the place of a tail that stands at the start of the route, m.
DUST = 1e-6
# Each kind in one sentence, and in few words.
TEXTS: Mapping[str, str] = {
    "street": N_(
        "the plan gives no edge, wall or house along the drawn route (venue, obstacle): whether the "
        "dance avoids them was not checked"
    ),
    "square": N_(
        "the plan gives neither an edge of the square nor anything that stands on it (venue, "
        "obstacle): whether the dance avoids them was not checked"
    ),
    "venue": N_(
        "the plan gives no edge of the square (venue): whether the dance stays inside was not checked"
    ),
    "people": N_(
        "the plan asks for no room for people (people.beside, people.ahead, people.sway, "
        "people.imprecision): only the benches themselves were checked"
    ),
    "speed": N_(
        "the plan gives no greatest speed (limits.speed, people.most_speed): speeds were computed, and "
        "compared with nothing"
    ),
    "behind": N_(
        "at the start {way} m of the dragon, benches {first} to {last}, stand on a straight line "
        "behind the start of the route, which the plan does not draw: whether there is such a way was "
        "not checked"
    ),
    "still behind": N_(
        "when the walk ends, {way} m of the dragon, benches {first} to {last}, have not yet come to "
        "the route that the plan draws"
    ),
}
BRIEF: Mapping[str, str] = {
    "street": N_("walls and houses along the route"),
    "square": N_("the square"),
    "venue": N_("the edge of the square"),
    "people": N_("room for people"),
    "speed": N_("limits of speed"),
    "behind": N_("the ground behind the start, {way} m"),
    "still behind": N_("the route of benches {first} to {last}"),
}


@dataclass(frozen=True)
class NotLookedAt:
    """A subject that a check did not consider.

    Attributes:
        kind: what, one of TEXTS.
        words: for the places in the sentence.
    """

    kind: str
    words: dict[str, str] = field(default_factory=dict)

    @property
    def text(self) -> str:
        """The same in a sentence, in the language in use."""
        return _(TEXTS[self.kind]).format(**self.words)

    @property
    def brief(self) -> str:
        """The same in few words, in the language in use."""
        return _(BRIEF[self.kind]).format(**self.words)


def not_looked_at(plan: Plan, walk: Walk, start: float, end: float) -> tuple[NotLookedAt, ...]:
    """What a check of a plan's walk from a start to an end, s, does not consider."""
    standing = plan.obstacles()
    kinds = []
    if not standing:
        kinds.append("street" if plan.route.kind == "drawn" else "square")
    elif all(one.kind != "venue" for one in standing):
        kinds.append("venue")
    if not levels_asked(plan.people):
        kinds.append("people")
    if plan.limits.speed is None and plan.people.most_speed is None:
        kinds.append("speed")
    found = [NotLookedAt(kind) for kind in kinds]
    if runs_on(walk):
        for kind, s in zip(("behind", "still behind"), places(walk, start, end), strict=True):
            words = _behind(s, given_from(plan, walk))
            found += [NotLookedAt(kind, words)] if words else []
    return tuple(found)


def runs_on(walk: Walk) -> bool:
    """Whether a straight line that the plan does not draw leads to the start of the route."""
    return float(walk.route.rows[0, RouteRow.U_BACK]) == -math.inf


def given_from(plan: Plan, walk: Walk) -> float:
    """Route position at which the plan's own route begins, m: after the line before a drawn bend."""
    route = plan.route
    drawn = (route.kind == "drawn" and not route.closed) or route.after_street
    return RUN_UP if drawn and abs(float(walk.route.joints[1]) - RUN_UP) < DUST else 0.0


def places(walk: Walk, *times: float) -> list[list[float]]:
    """Where along the route each handle is at times, s, in m."""
    found: list[list[float]] = walk.motion(times, throw=False).s.tolist()
    return found


def _behind(s: Sequence[float], given: float) -> dict[str, str]:
    """How much of the dragon, with its handles at s, m, stands behind a place on the route, if any."""
    benches = [n for n, place in enumerate(s) if n and place < given - DUST]
    if not benches:
        return {}
    way = given - s[-1]
    last = str(len(s) - 1)
    return {"way": known(way, way, "m", up=True), "first": str(benches[0]), "last": last}
