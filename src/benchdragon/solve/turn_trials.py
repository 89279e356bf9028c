"""Turns that a search tries: what is sought of them, their unknowns, and how sampling judges them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from benchdragon import budget
from benchdragon.analysis.nearby import seams_of
from benchdragon.analysis.speed import QUANTITIES, given_limits, greatest_at
from benchdragon.errors import InputError, finite, positive
from benchdragon.i18n import N_, _
from benchdragon.kernels import step_bounds
from benchdragon.kernels.box import least_distance
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import S_START, FloatArray
from benchdragon.kernels.links import link_length
from benchdragon.kernels.route import evaluate
from benchdragon.kernels.search import NEAREST, NOTES, Search, room
from benchdragon.kernels.standing import Bench, look_along, scratch_for
from benchdragon.model.dragon import Dragon
from benchdragon.model.turns import Turn, reach
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan

# Benches that are walked through a turn while searching, and how far the head goes at a time, m: in
# the global search and in the local one.
BENCHES, STEPS = 16, (0.2, 0.08)
# Benches and step, m, for their distances: one turn farther out is some 17 benches away.
CLEAR_BENCHES, CLEAR_STEP = 40, 0.6
# A limit may be exceeded by this share.
EXCEEDED = 1e-7
# What a turn that does not exist is worth, and the worst of a limit that is exceeded by all of itself.
NOWHERE, WORSE = 1e6, 1e3
# Joints lie no deeper than this share of the disc's radius, arcs are no wider than the other;
# clothoids are no longer, m.
DEEPEST, WIDEST, LONGEST_EASE = 0.3, 0.75, 4.0
# A bend is wider than half a link by this share: at that the last bench would stand square to it.
WIDER = 1.001

OBJECTIVES = {
    "length": N_("shortest turn"),
    "way": N_("shortest path inside the disc"),
    "speed": N_("greatest head speed"),
    "disc": N_("smallest disc"),
    "acceleration": N_("least peak total acceleration"),
}

# What a handle of a judged turn costs, in handles placed, and its bytes.
JUDGED, PLACED = 4, 64


@dataclass(frozen=True)
class TurnGoal:
    """What is sought of a turn, and what it must keep besides the plan's limits.

    Attributes:
        objective: one of OBJECTIVES.
        least_radius: of any bend, m.
        longest: length of the turn itself, m.
        longest_way: whole way inside the disc, m.
    """

    objective: str = "way"
    least_radius: float = 0.0
    longest: float = math.inf
    longest_way: float = math.inf

    def __post_init__(self) -> None:
        if self.objective not in OBJECTIVES:
            raise InputError(
                _("wanted one of {known}, not {name}").format(
                    known=", ".join(OBJECTIVES), name=self.objective
                )
            )
        finite("least_radius", self.least_radius, "m")
        for name in ("longest", "longest_way"):
            if math.isfinite(getattr(self, name)):
                positive(name, getattr(self, name), "m")


@dataclass
class TurnEvaluator:
    """Judges turns of a plan's family by sampling."""

    plan: Plan
    goal: TurnGoal
    # What sampling is corrected by: the exact figure is so many times the sampled one.
    factors: dict[str, float] = field(default_factory=dict)
    step: float = STEPS[0]
    evaluations: int = 0
    _search: Search = field(default_factory=lambda: room(2, 1, 1), init=False, repr=False)

    def __post_init__(self) -> None:
        route = self.plan.route
        if not isinstance(route, TurnRoute):
            raise InputError(_("a best turn is sought for plans whose route is a turn"))
        self.pitch, self.disc = route.pitch, route.disc(self.plan)
        self.obstacles = [route.unplaced(obstacle) for obstacle in self.plan.obstacles()]
        dragon = self.plan.dragon.build()
        sizes = dragon.sizes
        self.few, self.more = (
            Dragon.of_sizes(*(size[:count] for size in sizes)) for count in (BENCHES, CLEAR_BENCHES)
        )
        self.narrowest = max(WIDER * 0.5 * float(dragon.links.max()), self.goal.least_radius)

    @property
    def sought(self) -> str:
        """The figure that is to be small."""
        objective = self.goal.objective
        return "total_acceleration" if objective == "acceleration" else objective

    @property
    def quantities(self) -> list[str]:
        """Quantities that a turn is judged by: speed, what is limited, and what is sought."""
        wanted = {"speed", self.sought, *given_limits(self.plan)}
        return [name for name in QUANTITIES if name in wanted]

    @property
    def bounds(self) -> list[tuple[float, float]]:
        """Ranges of the unknowns: joints, what the family has, and the clothoids' length if free."""
        table, disc = self.plan.turn, self.disc
        joints = [
            (DEEPEST * disc, disc) if radius is None else (radius, radius)
            for radius in (table.entry_radius, table.exit_radius)
        ]
        radius = (self.narrowest, max(WIDEST * disc, 1.01 * self.narrowest))
        inner = {
            "arc-arc": [(math.log(0.2), math.log(5.0))],
            "arc-line-arc": [radius, radius],
            "arc-arc-arc": [radius, (-1.0 / self.narrowest, 1.0 / self.narrowest), radius],
        }[table.family]
        ease = [(0.0, LONGEST_EASE)] if self.goal.objective == "acceleration" else []
        return [*joints, *inner, *ease]

    def table(self, x: Sequence[float]) -> dict[str, object]:
        """What the unknowns say in a plan's [turn]."""
        family = self.plan.turn.family
        entry, exit_, *inner = (float(value) for value in x)
        said: dict[str, object] = {"entry_radius": entry, "exit_radius": exit_}
        if self.goal.objective == "acceleration":
            said["ease"] = inner.pop()
        if family == "arc-arc":
            return {**said, "ratio": math.exp(inner[0])}
        if family == "arc-arc-arc":
            said["curvature"] = inner.pop(1)
        return {**said, "radii": (inner[0], inner[1])}

    def turn(self, x: Sequence[float]) -> Turn:
        """The turn of these unknowns.

        Raises:
            InputError: if there is none.
        """
        table = self.plan.turn.model_copy(update=self.table(x))
        return table.build(self.pitch, self.disc)

    def figures(self, x: Sequence[float], complete: bool) -> dict[str, float] | None:
        """What a turn comes to, by name; clearance only if the rest is within limits, or `complete`."""
        self.evaluations += 1
        try:
            turn = self.turn(x)
        except InputError:
            return None
        rows = turn.rows(lead=1.0, trail=1000.0)
        found = {
            "length": turn.length,
            "way": turn.way(self.disc),
            "disc": max(reach(rows), turn.entry_radius, turn.exit_radius),
            "radius": turn.least_radius,
        }
        if turn.least_radius < 0.98 * self.narrowest:
            return found
        found |= self._rates(rows)
        if complete or all(value >= 0.0 for value in self.rooms(found).values()):
            found["clearance"] = self._clearance(rows)
            if self.obstacles:
                found["obstacles"] = self._obstacle_room(rows)
        return found

    def _obstacle_room(self, rows: FloatArray) -> float:
        """How much nearer benches near the turn might come to obstacles, m; negative: they may not."""
        first, last = float(rows[1, S_START] - self.few.links.sum()), float(rows[-1, S_START])
        count = 2 * math.ceil((last - first) / (2.0 * CLEAR_STEP))
        budget.hold(PLACED * count)
        at = np.linspace(first, last, count)
        budget.spend(JUDGED * count * sum(len(obstacle.boxes) for obstacle in self.obstacles))
        spans, least, places = at.reshape(-1, 2), math.inf, np.empty((len(at), 4))
        evaluate(rows, at, places)
        for obstacle in self.obstacles:
            if obstacle.forbids(places[:, :2]).any():
                return -1.0
            standing = scratch_for(obstacle.boxes)
            for sizes in np.unique(self.few.sizes, axis=1).T:
                link = np.array([link_length(sizes[0], sizes[2], sizes[3])])
                bench = Bench(rows, link, sizes[:, np.newaxis].copy(), seams_of(rows))
                note = np.zeros(NOTES)
                note[NEAREST] = math.inf
                look_along(bench, standing, self._search, spans, note)
                least = min(least, float(note[NEAREST]) - obstacle.radius - obstacle.margin)
        return least + self.factors.get("obstacles", 0.0)

    def _rates(self, rows: FloatArray) -> dict[str, float]:
        places = self._places(rows, self.few, self.step)
        if places is None:
            return dict.fromkeys(self.quantities, math.inf)
        found = {}
        for name in self.quantities:
            values = greatest_at(rows, self.few, places, QUANTITIES[name])
            found[name] = float(values.max()) * self.factors.get(name, 1.0)
        return found

    def _clearance(self, rows: FloatArray) -> float:
        places = self._places(rows, self.more, CLEAR_STEP)
        if places is None:
            return -1.0
        near = least_distance(self.more.sizes, places.x, places.y)
        return near + self.factors.get("clearance", 0.0)

    def _places(self, rows: FloatArray, dragon: Dragon, step: float) -> Placements | None:
        """The dragon from where its head enters the turn to where its tail has left it."""
        first, last = float(rows[1, S_START]), float(rows[-1, S_START] + dragon.links.sum())
        count = math.ceil((last - first) / step) + 1
        budget.hold(PLACED * count * (len(dragon) + 1))
        at = np.linspace(first, last, count)
        budget.spend(JUDGED * (len(dragon) + 1) * len(at))
        places = empty_placements(len(dragon) + 1, len(at))
        stands = step_bounds.place_chain(rows, dragon.links, at, 0, len(at), places)
        return places if stands else None

    def rooms(self, found: dict[str, float]) -> dict[str, float]:
        """What is left of each limit, as a share of it; negative where it is exceeded."""
        plan, goal, head = self.plan, self.goal, self.plan.walk.speed
        rooms = {"radius": found["radius"] / self.narrowest - 1.0}
        if goal.objective != "disc":
            rooms["disc"] = 1.0 - found["disc"] / self.disc
        if math.isfinite(goal.longest):
            rooms["length"] = 1.0 - found["length"] / goal.longest
        if math.isfinite(goal.longest_way):
            rooms["way"] = 1.0 - found["way"] / goal.longest_way
        for name, limit in given_limits(plan).items():
            if name != self.sought:
                peak = found.get(name, math.inf) * head ** QUANTITIES[name].power
                rooms[name] = 1.0 - peak / limit
        if "clearance" in found:
            rooms["clearance"] = (found["clearance"] - plan.limits.margin) / self.few.width[0]
        if "obstacles" in found:
            rooms["obstacles"] = found["obstacles"] / self.few.width[0]
        return {name: max(room, -1.0) for name, room in rooms.items()}

    def score(self, x: Sequence[float]) -> float:
        """What the global search makes small: the objective, or how far limits are exceeded."""
        found = self.figures(x, complete=False)
        if found is None:  # small radii and short clothoids are likelier to exist
            return NOWHERE * (1.0 + sum(abs(value) for value in x[2:]))
        exceeded = -sum(min(room + EXCEEDED, 0.0) for room in self.rooms(found).values())
        return WORSE * (1.0 + exceeded) if exceeded > 0.0 else found[self.sought]
