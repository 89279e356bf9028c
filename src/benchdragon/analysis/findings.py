"""Findings of a check: each way in which a walk violates its plan, in words, under a permanent code."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from benchdragon.analysis.not_looked_at import given_from, runs_on
from benchdragon.analysis.obstacles import ObstacleAnswers
from benchdragon.analysis.room import RoomLevel
from benchdragon.analysis.shortage import Shortage
from benchdragon.analysis.speed import QUANTITIES, given_limits
from benchdragon.i18n import N_, _
from benchdragon.model.answer import ROUNDING, Answer
from benchdragon.model.numbering import handle_words
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.number_format import known, seconds
from benchdragon.plans.schema import Plan

# Names of obstacles, and of the venue, that have none in the plan.
NAMELESS = re.compile(r"obstacle (\d+)")
NAMELESS_VENUE = "venue"


@dataclass(frozen=True)
class Kind:
    """A kind of finding.

    Attributes:
        code: under which it is known for good: docs/en/findings.md explains each.
        text: what it is, in words.
    """

    code: str
    text: str


KINDS: Mapping[str, Kind] = {
    "contact": Kind("BD101", N_("two benches touch")),
    "margin": Kind("BD102", N_("two benches come nearer than the margin")),
    "walk": Kind("BD103", N_("a bench cannot follow")),
    "route": Kind("BD104", N_("the route is shorter than the dragon")),
    "sway": Kind("BD105", N_("benches have no room to sway")),
    "imprecision": Kind("BD106", N_("benches have no room for imprecision")),
    "people": Kind("BD107", N_("people have no room beside or before a bench")),
    "speed": Kind("BD201", N_("a handle is faster than the limit")),
    "acceleration": Kind("BD202", N_("a handle accelerates along the route by more than the limit")),
    "lateral_acceleration": Kind("BD203", N_("a handle's lateral acceleration exceeds the limit")),
    "total_acceleration": Kind("BD204", N_("a handle's total acceleration exceeds the limit")),
    "turning_rate": Kind("BD205", N_("a bench's turning rate exceeds the limit")),
    "head_acceleration": Kind("BD206", N_("the head changes its speed by more than the limit")),
    "most_speed": Kind("BD207", N_("a handle is faster than a bench can be carried")),
    "venue": Kind("BD301", N_("a bench leaves the venue")),
    "venue_margin": Kind("BD302", N_("a bench comes nearer to the venue's edge than its margin")),
    "obstacle": Kind("BD303", N_("a bench touches an obstacle")),
    "obstacle_margin": Kind("BD304", N_("a bench comes nearer to an obstacle than its margin")),
    "entrance": Kind("BD401", N_("an entrance lies inside the spectators' line")),
    "crowd": Kind("BD402", N_("too many spectators for the ground outside their line")),
}


@dataclass(frozen=True)
class Finding:
    """Something that a walk must not do, or that could not be decided.

    Attributes:
        kind: what, one of KINDS.
        time: when, s.
        benches: which.
        value: the computed value, m, m/s, m/s^2 or rad/s.
        limit: the limit or margin of the plan.
        sentence: the same in words, to be translated, with places for `words`, translated too.
        words: see `sentence`.
        decided: whether it surely occurs; otherwise it is undecided.
        obstacle: the name of the obstacle, "" without one.
    """

    kind: str
    time: float | None
    benches: tuple[int, ...]
    value: float
    limit: float
    sentence: str
    words: dict[str, str]
    decided: bool = True
    obstacle: str = ""

    @property
    def code(self) -> str:
        """The code under which this kind of finding is known for good."""
        return KINDS[self.kind].code

    @property
    def text(self) -> str:
        """The finding as a sentence, in the language in use."""
        words = {name: self.said(name) for name in self.words if name != "called"}
        return _(self.sentence).format(**words)

    def said(self, name: str) -> str:
        """One of the words in the language in use."""
        return _(self.words[name]).format(**self.words)


def all_findings(
    plan: Plan, walk: Walk, span: tuple[float, float], contact: Answer | None,
    obstacles: Sequence[ObstacleAnswers], peaks: Mapping[str, Answer], room: Sequence[RoomLevel],
) -> tuple[Finding, ...]:  # fmt: skip
    """All findings about a walk over a span, s.

    `peaks` are the greatest speed and what else is limited, `room` the levels of room for people.
    """
    limits = given_limits(plan)
    return (
        *_route_findings(plan, walk, span[0]),
        *_contact_findings(contact, plan.limits.margin),
        *(found for answers in obstacles for found in _obstacle_findings(answers)),
        *_head_findings(walk, span, plan.limits.head_acceleration),
        *(
            found
            for name in peaks
            if name in limits
            for found in _limit_findings(name, peaks[name], limits[name])
        ),
        *_carrying_findings(plan, peaks["speed"]),
        *_room_findings(room),
    )


def _route_findings(plan: Plan, walk: Walk, start: float) -> list[Finding]:
    """Whether the dragon is never as a whole on the route that the plan gives."""
    length = walk.route.length - given_from(plan, walk)
    dragon = extent(walk)
    if not runs_on(walk) or dragon <= length:
        return []
    sentence = N_("the route is {route} m long, the dragon {dragon} m: it is never wholly on the route")
    if plan.route.kind == "drawn":
        sentence = N_(
            "the drawn route is {route} m long, the dragon {dragon} m: it is never wholly on the "
            "route; where the drawing is in another unit, say so by survey.unit"
        )
    words = {
        "route": known(length, length, "m", up=False),
        "dragon": known(dragon, dragon, "m", up=True),
    }
    return [Finding("route", start, (len(walk.dragon.length),), length, dragon, sentence, words)]


def _contact_findings(contact: Answer | None, margin: float) -> list[Finding]:
    if contact is None or contact.witness is None:
        return []
    near = contact.witness
    decided = contact.status != "undecided"
    kind = "margin" if near.gap > 0.0 or (margin and not decided) else "contact"
    sentence = {
        "contact": N_("benches {a} and {b} touch at t = {t} s"),
        "margin": N_("benches {a} and {b} come nearer than {margin} m at t = {t} s"),
    }[kind]
    if not decided:
        sentence = N_(
            "benches {a} and {b} come to {margin} m of one another at t = {t} s, too exactly to tell "
            "on which side"
        )
    a, b = near.benches
    words = {"a": str(a), "b": str(b), "t": seconds(contact.value), "margin": f"{margin:g}"}
    gap = max(near.gap, 0.0)
    return [Finding(kind, contact.value, near.benches, gap, margin, sentence, words, decided)]


# Sentences about an obstacle: touched or left, nearer than the margin, and undecided.
OBSTACLE_SENTENCES = {
    "obstacle": N_("bench {bench} touches {name} at t = {t} s"),
    "obstacle_margin": N_("bench {bench} comes nearer than {margin} m to {name} at t = {t} s"),
    "obstacle at first": N_("bench {bench} touches {name}, or stands inside, from the start on: {t} s"),
    "venue at first": N_("bench {bench} stands outside {name} from the start on: {t} s"),
    "venue": N_("bench {bench} leaves {name} at t = {t} s"),
    "venue_margin": N_("bench {bench} comes nearer than {margin} m to the edge of {name} at t = {t} s"),
}


def _obstacle_findings(answers: ObstacleAnswers) -> list[Finding]:
    """Whether a bench comes nearer to an obstacle than it may, and touches it or leaves the venue."""
    found = _obstacle_finding(answers, answers.contact, answers.obstacle.margin)
    return [*found, *_obstacle_finding(answers, answers.touch, 0.0)]


def _obstacle_finding(answers: ObstacleAnswers, contact: Answer | None, margin: float) -> list[Finding]:
    """The finding of a contact with an obstacle, or of a distance less than its margin."""
    if contact is None or contact.witness is None:
        return []
    near, decided = contact.witness, contact.status != "undecided"
    kind = "venue" if answers.obstacle.kind == "venue" else "obstacle"
    kind += "_margin" if near.gap > 0.0 or (margin and not decided) else ""
    sentence = OBSTACLE_SENTENCES[kind]
    if not decided:
        sentence = N_(
            "bench {bench} comes to {margin} m of {name} at t = {t} s, too exactly to tell on which "
            "side"
        )
    if decided and contact.lower == contact.upper == contact.value and near.gap <= 0.0:
        sentence = OBSTACLE_SENTENCES[f"{kind} at first"]
    (bench,) = near.benches
    words = {"bench": str(bench), "t": seconds(contact.value), "margin": f"{margin:g}"}
    words |= name_words(answers.obstacle)
    gap, name = max(near.gap, 0.0), answers.obstacle.name
    return [Finding(kind, contact.value, near.benches, gap, margin, sentence, words, decided, name)]


# Sentences for a level of room that is not kept: between benches, and towards obstacles.
ROOM_SENTENCES = {
    "sway": N_("benches {a} and {b} have no room to sway at t = {t} s: {asked}"),
    "imprecision": N_("benches {a} and {b} have no room for imprecision at t = {t} s: {asked}"),
    "people": N_("the people of benches {a} and {b} have no room at t = {t} s: {asked}"),
    "sway at": N_("bench {a} has no room to sway at {name} at t = {t} s: {asked}"),
    "imprecision at": N_("bench {a} has no room for imprecision at {name} at t = {t} s: {asked}"),
    "people at": N_("the people of bench {a} have no room at {name} at t = {t} s: {asked}"),
}
# The room required, and how much of it the named pair has, at the pair's own time.
ASKED_FOR = N_("{margin} m are asked for")
SHORT = N_(
    "{key} asks for {wanted} m; at t = {when} s, when these two are {apart} m apart, there is room for "
    "{there} m"
)


def _room_findings(room: Sequence[RoomLevel]) -> list[Finding]:
    """Which levels of room are not kept, where benches alone keep theirs."""
    if not room or room[0].first is not None:
        return []
    return [found for level in room[1:] for found in _room_finding(level)]


def _short_words(short: Shortage) -> dict[str, str]:
    """The missing room and the distance, truncated to millimetres."""
    cut = {name: math.floor(round(1000.0 * getattr(short, name), 6)) for name in ("apart", "there")}
    return {
        "key": f"people.{short.key}", "wanted": f"{short.wanted:g}", "when": seconds(short.time),
        **{name: f"{value / 1000.0:g}" for name, value in cut.items()},
    }  # fmt: skip


def _room_finding(level: RoomLevel) -> list[Finding]:
    """The finding of a level of room that is not kept, and what breaks it first."""
    if level.first is None or level.first[0].witness is None:
        return []
    contact, obstacle = level.first
    near, decided = level.first[0].witness, contact.status != "undecided"
    margin = level.margin if obstacle is None else obstacle.margin
    sentence = ROOM_SENTENCES[level.name if obstacle is None else f"{level.name} at"]
    if not decided:
        sentence = N_(
            "whether the margin of {margin} m at bench {a} is kept at t = {t} s is too close to tell"
        )
    words = {"a": str(near.benches[0]), "b": str(near.benches[-1])}
    words |= {"t": seconds(contact.value), "margin": f"{margin:g}"}
    words |= {} if obstacle is None else name_words(obstacle)
    words |= (
        {"asked": ASKED_FOR} if level.short is None else {"asked": SHORT, **_short_words(level.short)}
    )
    gap, name = max(near.gap, 0.0), "" if obstacle is None else obstacle.name
    return [
        Finding(level.name, contact.value, near.benches, gap, margin, sentence, words, decided, name)
    ]


def _carrying_findings(plan: Plan, peak: Answer) -> list[Finding]:
    """Whether a handle is faster than people can carry a bench, or may be."""
    most = plan.people.most_speed
    found = [] if most is None else _limit_findings("speed", peak, most)
    sentence = N_(
        "handle {handle} ({where}) moves at {value} m/s at t = {t} s; a bench can be carried at "
        "{limit} m/s at most"
    )
    return [
        replace(one, kind="most_speed", sentence=sentence if one.decided else one.sentence)
        for one in found
    ]


def name_words(obstacle: Obstacle) -> dict[str, str]:
    """The name of an obstacle as words of a sentence; without a name, its number.

    A name given by people is not translated.
    """
    nameless = NAMELESS.fullmatch(obstacle.name)
    if nameless and obstacle.kind != "venue":
        return {"name": N_("obstacle {n}"), "n": nameless[1]}
    if obstacle.kind == "venue" and obstacle.name == NAMELESS_VENUE:
        return {"name": N_("the venue")}
    return {"name": N_("{called}"), "called": obstacle.name}


def named(obstacle: Obstacle) -> str:
    """The name of an obstacle within a sentence, in the language in use: in Chinese between quotes."""
    words = name_words(obstacle)
    return _(words["name"]).format(**words)


def shown_name(obstacle: Obstacle) -> str:
    """The name of an obstacle outside of a sentence, in the language in use."""
    return obstacle.name if "called" in name_words(obstacle) else named(obstacle)


def touch_text(bench: int, obstacle: Obstacle) -> str:
    """That a bench (number, from 1) touches an obstacle or leaves the venue, in words."""
    text = _("bench {bench} touches {name}")
    if obstacle.kind == "venue":
        text = _("bench {bench} leaves {name}")
    return text.format(bench=bench, name=named(obstacle))


def _head_findings(walk: Walk, span: tuple[float, float], limit: float) -> list[Finding]:
    """Whether the head changes its speed faster than it may: its acceleration is known exactly."""
    value, time = steepest(walk, span)
    if value <= limit * (1.0 + ROUNDING):
        return []
    sentence = N_(
        "the head changes its speed by {value} m/s^2 from t = {t} s on, the limit being {limit} m/s^2"
    )
    words = {"t": seconds(time)}
    words |= {"value": known(value, value, "m/s^2", up=True, limit=limit), "limit": f"{limit:g}"}
    return [Finding("head_acceleration", time, (1,), value, limit, sentence, words)]


def steepest(walk: Walk, span: tuple[float, float]) -> tuple[float, float]:
    """By how much the head changes its speed at most, m/s^2, and from when on, s."""
    stretches = walk.profile.stretches(span[0], span[1])
    rates = [abs(rate) for rate in stretches.rates.tolist()]
    return max(rates), stretches.times.tolist()[rates.index(max(rates))][0]


def extent(walk: Walk) -> float:
    """How long the dragon is from its first handle to its last, link upon link, m."""
    return walk.dragon.extent


def _told_apart(value: float, limit: float) -> dict[str, str]:
    """A value and its limit with six digits, or as many as show the difference."""
    digits = next((n for n in range(6, 17) if f"{value:.{n}g}" != f"{limit:.{n}g}"), 6)
    return {"value": f"{value:.{digits}g}", "limit": f"{limit:.6g}"}


def _limit_findings(name: str, peak: Answer, limit: float) -> list[Finding]:
    """The findings of limited quantities that exceed their limits, or may."""
    near, quantity = peak.witness, QUANTITIES[name]
    kept = peak.keeps(limit)
    if kept or near is None:
        return []
    sentence = N_("whether the {what} keeps to {limit} {unit} is undecided: {value} {unit} was reached")
    if kept is False:
        sentence = N_(
            "{what} at bench {bench} is {value} {unit} at t = {t} s, the limit being {limit} {unit}"
        )
    if kept is False and name == "speed":
        sentence = N_(
            "handle {handle} ({where}) moves at {value} m/s at t = {t} s, the limit being {limit} m/s"
        )
    elif kept is False and near.handle is not None:
        sentence = N_(
            "{what} is {value} {unit} at handle {handle} ({where}) at t = {t} s, the limit being "
            "{limit} {unit}"
        )
    words = {
        "what": quantity.text, "unit": quantity.unit,
        **handle_words(near.handle or 0, near.benches[0]),
        "t": seconds(near.time or 0.0), **_told_apart(peak.value, limit),
    }  # fmt: skip
    if kept is False:
        words |= {"value": peak.shown(up=True, limit=limit), "limit": f"{limit:g}"}
    decided = kept is not None
    return [Finding(name, near.time, near.benches, peak.value, limit, sentence, words, decided)]
