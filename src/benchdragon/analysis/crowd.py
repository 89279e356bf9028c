"""Spectators about a dance: the ground left for them, how dense they stand, and their entrances.

The movement of people is not modelled. Only the mean density, people per square metre, is compared with
the levels of Fruin.
"""

import math
from dataclasses import dataclass

import shapely
from shapely.geometry import Point, Polygon

from benchdragon.analysis.findings import Finding
from benchdragon.analysis.obstacles import least_distance
from benchdragon.analysis.swept import Shape, SweptArea
from benchdragon.i18n import N_
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.outline import shape_of
from benchdragon.plans.schema import Plan

# Least density, people per m2, of each level of Fruin, as tabulated in EPJ Data Science (2014).
LEVELS = (
    (7.1, N_("critical even where nobody moves")),
    (5.6, N_("dangerous forces begin")),
    (3.6, N_("people are touched against their will")),
    (2.0, N_("walking is slowed")),
    (0.0, N_("people can walk about")),
)
# Density from which it is a finding.
MOST = 3.6
# The entrance is taken for a post so thick, m; how near to it benches come is sought to this, m.
POST, TOLERANCES = 1e-3, (1e-3,)


@dataclass(frozen=True)
class Crowd:
    """The space of spectators.

    Attributes:
        people: how many are expected; None if the plan does not say.
        ground: where they may stand, m2: within the venue, outside the spectators' line, without
            obstacles; None for a plan without a venue.
        way: the narrowest way past the line within the venue, m; 0 where the line reaches the edge or
            lies outside, None for a plan without a venue.
    """

    people: int | None
    ground: float | None
    way: float | None

    @property
    def density(self) -> float | None:
        """People a square metre if they stood evenly, infinite without ground; None if not known."""
        if self.people is None or self.ground is None:
            return None
        if not self.people:
            return 0.0
        return self.people / self.ground if self.ground > 0.0 else math.inf


def crowd_of(plan: Plan, swept: SweptArea) -> Crowd:
    """The space of spectators beside the ground that a dance covers."""
    people, obstacles = plan.event.spectators, plan.obstacles()
    venue = next((shape_of(one) for one in obstacles if one.kind == "venue"), None)
    if venue is None:
        return Crowd(people, None, None)
    line = within_line(swept)
    taken = [line, *(shape_of(one).buffer(one.radius) for one in obstacles if one.kind != "venue")]
    ground = venue.difference(shapely.union_all(taken)).area
    way = venue.boundary.distance(line) if venue.contains(line) else 0.0
    return Crowd(people, float(ground), float(way))


def within_line(swept: SweptArea) -> Shape:
    """All that the outer spectators' lines go round, holes included."""
    return shapely.union_all([Polygon(ring) for ring in swept.lines.outer])


def density_text(density: float) -> str:
    """The level of a crowd of this density, people per m2, to be translated."""
    return next(text for least, text in LEVELS if density >= least)


def body_nearest(plan: Plan, swept: SweptArea) -> list[Answer]:
    """How near benches come to each entrance, m; the witness tells when, and which bench."""
    return [
        least_distance(
            swept.walk, Obstacle.circle("", place, POST), swept.start, swept.end,
            tolerances=TOLERANCES,
        )
        for place in plan.event.entrances
    ]  # fmt: skip


def event_findings(plan: Plan, swept: SweptArea, crowd: Crowd) -> tuple[Finding, ...]:
    """The findings about spectators in the plan of an event."""
    return (*_entrance_findings(plan, swept), *_crowd_findings(crowd))


def _entrance_findings(plan: Plan, swept: SweptArea) -> list[Finding]:
    """Entrances that lie inside the spectators' line."""
    line, found = within_line(swept), []
    sentence = N_(
        "entrance {n} lies inside the spectators' line, {away} m from the ground that benches cover: "
        "move the entrance, the dance, or the line (event.distance)"
    )
    for n, place in enumerate(plan.event.entrances, start=1):
        if line.covers(Point(place)):
            away = float(swept.polygon.distance(Point(place)))
            words = {"n": str(n), "away": f"{away:.2f}"}
            found.append(Finding("entrance", None, (), away, swept.margin, sentence, words))
    return found


def _crowd_findings(crowd: Crowd) -> list[Finding]:
    """Too many people on the ground that is left for them."""
    density = crowd.density
    if density is None or density < MOST:
        return []
    sentence = N_(
        "{people} spectators on {ground} m² outside their line are {density} a square metre: {level}; "
        "let fewer in, or take a larger square"
    )
    words = {
        "people": str(crowd.people), "ground": f"{crowd.ground:.0f}", "density": f"{density:.1f}",
        "level": density_text(density),
    }  # fmt: skip
    if math.isinf(density):
        sentence = N_("there is no ground for {people} spectators: their line takes all of the venue")
    return [Finding("crowd", None, (), density, MOST, sentence, words)]
