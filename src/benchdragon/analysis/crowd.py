"""Spectators about a dance: the ground left for them, how dense they stand, and their ways in and out.

The movement of people is not modelled. The mean density, people per square metre, is compared with the
levels of Fruin. Ways out, w m wide, let w f people through in a minute, f of FLOWS, and n people need
n / (w f) minutes at least, as if they stood before them already.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from benchdragon import budget
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.distance import boxes
from benchdragon.analysis.entrances import Gate, gates_of
from benchdragon.analysis.findings import Finding
from benchdragon.analysis.obstacle_distance import nearest_boxes
from benchdragon.analysis.obstacles import least_distance
from benchdragon.analysis.swept import SweptArea
from benchdragon.i18n import N_
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.rings import Ring, area_of, holds, outermost, ring_of, round_ring
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

# The spectators' line where the plan says none, m.
DISTANCE = 2.0
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
# People a minute through each metre of a way out on level ground: at a stadium in 2021 all that were
# seen were fewer (Larsson and others, Fire Safety Journal 120); the Guide to Safety at Sports Grounds
# (6th edition, 2018) allows for so many at most.
FLOWS = (60.0, 82.0)
# How near to an entrance benches come is sought to this, m.
TOLERANCES = (1e-3,)
# Time step of samples of whether an entrance is shut, s, larger where that were too many; times
# no farther apart than APART, s, are one. No point of a bench is faster than so many times the fastest
# handle: its ends stand out beyond the handles by less than half of what lies between these.
STEP, MOST_LOOKS, APART, WHIP = 0.25, 20_000, 10.0, 2.0


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


@dataclass(frozen=True)
class Entrance:
    """What a dance leaves of an entrance.

    Attributes:
        gate: the entrance.
        nearest: how near benches come to it, m; the witness tells when, and which.
        inside: whether any of it lies inside the spectators' line.
        shut: from when to when benches are nearer to it than spectators may be, s.
    """

    gate: Gate
    nearest: Answer
    inside: bool
    shut: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class WaysOut:
    """What the entrances let through when people leave.

    Attributes:
        width: of all whose width is known, m; None where none is.
        free: of those that lie outside the spectators' line, m: the dragon never shuts them.
        unknown: numbers, from 1, of entrances whose width is not known, and which do not count.
        flows: people a minute through `free`, by FLOWS.
        minutes: until all who are expected are through, by FLOWS: infinite where nothing is free; None
            where the plan does not say how many come.
    """

    width: float | None
    free: float
    unknown: tuple[int, ...]
    flows: tuple[float, ...]
    minutes: tuple[float, ...] | None


def distance_of(plan: Plan) -> float:
    """How far the spectators' line is from the ground that benches cover, m."""
    return DISTANCE if plan.event.distance is None else plan.event.distance


def outer_lines(swept: SweptArea) -> list[Ring]:
    """The spectators' lines around the outside, none of which lies within another."""
    return outermost([ring.tolist() for ring in swept.lines.outer])


def within_lines(lines: Sequence[Ring]) -> float:
    """The area that spectators' lines go round, holes included, m2."""
    return sum(area_of(line) for line in lines)


def crowd_of(plan: Plan, lines: Sequence[Ring], edge: float) -> Crowd:
    """The space of spectators beside a dance.

    Args:
        plan: of it.
        lines: those of spectators around the outside.
        edge: the least that benches keep from the venue's edge, m.
    """
    people, obstacles = plan.event.spectators, plan.obstacles()
    venues = [one.outline.tolist() for one in obstacles if one.kind == "venue"]
    if not venues:
        return Crowd(people, None, None)
    standing = [_ring(one) for one in obstacles if one.kind in ("circle", "rectangle", "polygon")]
    ground = ground_left(venues[0], [*lines, *standing])
    return Crowd(people, ground, max(edge - distance_of(plan), 0.0))


def _ring(obstacle: Obstacle) -> Ring:
    """The ring about an obstacle."""
    corners = obstacle.outline.tolist()
    if obstacle.kind == "circle":
        return round_ring(corners[0], obstacle.radius)
    return ring_of(corners)


def ground_left(edge: Ring, taken: Sequence[Ring]) -> float:
    """The area within a venue's edge and outside all that is taken, m2."""
    import shapely  # its union is another in pages

    rings = shapely.union_all([shapely.Polygon(ring) for ring in taken])
    return float(shapely.Polygon(edge).difference(rings).area)


def density_text(density: float) -> str:
    """The level of a crowd of this density, people per m2, to be translated."""
    return next(text for least, text in LEVELS if density >= least)


@budget.question()
def entrances_of(
    plan: Plan, walk: Walk, span: tuple[float, float], lines: Sequence[Ring], fastest: float
) -> list[Entrance]:
    """What a walk over a span, s, leaves of the plan's entrances, its handles as fast as that, m/s."""
    (start, end), found = span, []
    for gate in gates_of(plan):
        near = least_distance(walk, gate.shape, start, end, tolerances=TOLERANCES)
        places = [gate.place, *_ring(gate.shape)]
        inside = any(holds(line, place) for line in lines for place in places)
        shut = _shut(walk, span, gate.shape, distance_of(plan), fastest) if inside else ()
        found.append(Entrance(gate, near, inside, shut))
    return found


def ways_out(entrances: Sequence[Entrance], people: int | None) -> WaysOut:
    """What entrances let through, and how long so many people need for it at least."""
    known = [one for one in entrances if one.gate.width is not None]
    free = sum(one.gate.width or 0.0 for one in known if not one.inside)
    flows = [free * flow for flow in FLOWS]
    return WaysOut(
        sum(one.gate.width or 0.0 for one in known) if known else None,
        free,
        tuple(n for n, one in enumerate(entrances, start=1) if one.gate.width is None),
        tuple(flows),
        None if people is None else tuple(people / flow if flow > 0.0 else math.inf for flow in flows),
    )


def _shut(
    walk: Walk, span: tuple[float, float], shape: Obstacle, near: float, fastest: float
) -> tuple[tuple[float, float], ...]:
    """When benches are nearer to an entrance than so far, m: told rather too long, and never too short.

    Within half a step of a sample benches come no nearer than by what their fastest
    point goes meanwhile.
    """
    start, end = span
    count = min(max(math.ceil((end - start) / STEP), 1), MOST_LOOKS)
    half = 0.5 * (end - start) / count
    found: list[tuple[float, float]] = []
    for time in np.linspace(start, end, count + 1).tolist():
        if away_at(walk, time, shape) > near + WHIP * fastest * half:
            continue
        since = found.pop()[0] if found and time - half - found[-1][1] <= APART else time - half
        found.append((max(since, start), min(time + half, end)))
    return tuple(found)


def away_at(walk: Walk, time: float, shape: Obstacle) -> float:
    """How far the nearest bench is from an entrance at a time, s, in m; not more than 0 within it."""
    return float(nearest_boxes(boxes(walk.motion([time]), 0), shape)[0].min()) - shape.radius


def event_findings(
    plan: Plan, crowd: Crowd, entrances: Sequence[Entrance], clock: Clock
) -> tuple[Finding, ...]:
    """The findings about spectators in the plan of an event."""
    return (*_entrance_findings(plan, entrances, clock), *_crowd_findings(crowd))


def _entrance_findings(plan: Plan, entrances: Sequence[Entrance], clock: Clock) -> list[Finding]:
    """Entrances that lie inside the spectators' line."""
    found, line = [], distance_of(plan)
    for n, one in enumerate(entrances, start=1):
        if not one.inside:
            continue
        sentence = N_(
            "entrance {n} lies inside the spectators' line, {away} m from the ground that benches "
            "cover, and is shut by them ({times}): move the entrance, the dance, or the line"
        )
        if not one.shut:
            sentence = N_(
                "entrance {n} lies inside the spectators' line, {away} m from the ground that benches "
                "cover, which goes round it: move the entrance, the dance, or the line"
            )
        away = one.nearest.sure(up=False)
        words = {"n": str(n), "away": f"{away:.2f}", "times": shut_text(one, clock)}
        found.append(Finding("entrance", None, (), away, line, sentence, words))
    return found


def shut_text(entrance: Entrance, clock: Clock) -> str:
    """From when to when an entrance is shut, in figures as papers tell times."""
    times = [f"{clock.tell(since)}–{clock.tell(until)}" for since, until in entrance.shut]
    return "; ".join(times)


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
    if density == math.inf:
        sentence = N_("there is no ground for {people} spectators: their line takes all of the venue")
    return [Finding("crowd", None, (), density, MOST, sentence, words)]
