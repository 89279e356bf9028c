"""How a check searched for contact with obstacles: one search for each size of bench."""

import math

from benchdragon.analysis.check import Report
from benchdragon.analysis.findings import named
from benchdragon.analysis.obstacle_distance import nearest_points
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.analysis.obstacles import ObstacleAnswers
from benchdragon.explain.text import distance_text, number, pair, tiny
from benchdragon.i18n import _
from benchdragon.model.answer import Answer
from benchdragon.model.walk import Walk

# Obstacles whose distances are written out: those with the least room beyond their margins.
MOST_OBSTACLES = 5


def square_lines(report: Report) -> list[str]:
    """How obstacles and the venue's edge were searched, and the least distance from each."""
    if not report.obstacles:
        return []
    by_room = sorted(report.obstacles, key=lambda one: one.distance.lower - one.obstacle.margin)
    lines = _search_lines(report)
    for answers in by_room[:MOST_OBSTACLES]:
        lines += _obstacle_lines(report.walk, answers)
    rest = len(by_room) - MOST_OBSTACLES
    if rest > 0:
        text = _("The other obstacles, {count} of them, leave more room beyond their margins.")
        lines.append(text.format(count=rest))
    return lines


def _search_lines(report: Report) -> list[str]:
    """Which stretches of the route were searched for which benches, and why nothing is missed."""
    contact = report.first_contact
    end = report.end if contact is None or contact.witness is None else contact.upper
    with ObstacleSearch(report.walk, report.obstacles[0].obstacle, report.start, end) as search:
        ways = search.ways().tolist()
    text = _(
        "Where a bench stands is told by the route position s of its front handle alone. All benches "
        "of one size take the same positions one after another, so each size is searched once, along "
        "the route and not over time."
    )
    lines = [text]
    text = _(
        "Size of bench {first} (benches: {count}): s from {low} m to {high} m; positions "
        "searched, without those taken twice: {way} m."
    )
    for first, count, low, high, way in ways:
        said = {"low": number(low), "high": number(high), "way": number(way)}
        lines.append(text.format(first=int(first) + 1, count=int(count), **said))
    text = _(
        "To the search an obstacle is its sides, or a circle's centre: boxes that do not move. In one "
        "step of s a point of the bench moves at most D. If it is d from a side before and d' after "
        "the step, it is never nearer than (d + d' - D)/2 in between; what that leaves open is halved."
    )
    return [*lines, text]


def _obstacle_lines(walk: Walk, answers: ObstacleAnswers) -> list[str]:
    """The least distance from an obstacle, from point to point; and when its margin is not kept."""
    obstacle, distance, contact = answers.obstacle, answers.distance, answers.contact
    name, near = named(obstacle), distance.witness
    if near is None:
        return []
    lines = []
    if contact is not None:
        lines.append(_contact_line(contact, name, obstacle.margin))
    if distance.value > 0.0:
        points = nearest_points(walk.placement([near.s]), 0, near.benches[0] - 1, obstacle)
        time = math.nan if near.time is None else near.time
        text = _(
            "Least distance from {name}: bench {bench} at t = {t} s, nearest points {p} and {q} m: "
            "{numbers}; bracket {width} m; margin {margin} m."
        )
        lines.append(
            text.format(
                name=name, bench=near.benches[0], t=number(time), p=pair(*points[0]),
                q=pair(*points[1]), numbers=distance_text(*points), margin=number(obstacle.margin),
                width=tiny(distance.upper - distance.lower),
            )
        )  # fmt: skip
    return lines


def _contact_line(contact: Answer, name: str, margin: float) -> str:
    """When a bench first comes nearer to an obstacle than it may."""
    bench = 0 if contact.witness is None else contact.witness.benches[0]
    text = _(
        "Bench {bench} is the first to come nearer than {margin} m to {name}: not until {lower} s, "
        "and surely at {upper} s; bracket {width} s."
    )
    if contact.status == "undecided":
        text = _(
            "Whether bench {bench} comes nearer than {margin} m to {name} is too close to tell: not "
            "until {lower} s, and the doubt ends at {upper} s; bracket {width} s."
        )
    return text.format(
        bench=bench, margin=number(margin), name=name, lower=f"{contact.lower:.16g}",
        upper=f"{contact.upper:.16g}", width=tiny(contact.upper - contact.lower),
    )  # fmt: skip
