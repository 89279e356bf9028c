"""The chalk plan: where a route crosses tapes that are laid on the ground, and how far one may stray.

Where the route turns about a centre, a stake stands there and tapes run from it as spokes, at equal
angles; ticks are given by lengths along them. Elsewhere tapes lie from one place of the route to
another, and ticks are given by lengths along and beside them. Between two ticks the line is drawn
freehand: joined straight it strays by at most L²/8 times the sharpest bend between them, L being the
way from tick to tick, for no curve of bounded curvature is farther from its chord. Ticks are as many as
keep that below what is allowed: half a link, unless a plan says otherwise.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from benchdragon.analysis.chalk_line import SAME, Crossing, Line, Trail
from benchdragon.analysis.ground import Ground
from benchdragon.errors import InputError, brief, finite, of_kind, positive
from benchdragon.i18n import _
from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.chalk import LEAST_STRAY

# Spokes that are easily set out; the fewest that suffice are taken. Of a link may be strayed.
SPOKES, SHARE = (8, 12, 16), 0.5
# A tape beside the line is at most so long, and no tick farther beside it, m.
LEG, MOST_ASIDE = 50.0, 4.0
# Ticks of a plan, and metres of its line: more are no morning's work.
MOST_TICKS, MOST_WAY = 2_000, 20_000.0
# The circle on which spokes are set out has whole metres, so many at most; and swings of tapes so many.
WHEEL, ARM = 10.0, 5.0


@dataclass(frozen=True)
class Star:
    """Spokes about a stake.

    Attributes:
        stake: where it stands, m of the plan.
        place: the same as papers measure it, x and y from the peg, m.
        spokes: how many, at equal angles; the first the way x points, the next to its left.
        reach: of the longest tape, m.
        wheel: radius of the circle on which they are set out, m.
        chord: straight from spoke to spoke on it, m.
    """

    stake: Point
    place: Point
    spokes: int
    reach: float
    wheel: float
    chord: float


@dataclass(frozen=True)
class Leg:
    """A tape from one place of the line to another.

    Attributes:
        start: m of the plan.
        end: m of the plan.
        place: the start as papers measure it, x and y from the peg, m.
        way: a unit vector from start to end, as papers measure it.
        length: m.
        swing: from the leg before, carried straight on by ARM, to this one there, m, left positive; NaN
            where no leg comes before.
    """

    start: Point
    end: Point
    place: Point
    way: Point
    length: float
    swing: float


class Tick(NamedTuple):
    """A place of the line.

    Attributes:
        s: m along the route.
        point: m of the plan.
        star: the number of its star, from 0; -1 on a leg.
        tape: the number of the spoke or leg, from 1.
        along: m from the stake, or from the leg's start.
        aside: m to the left of the tape; 0 on it.
        out: whether the line, having wound in to the stake, winds out again there.
        kind: "tail" and "head" where they stand at first, "end" where the head comes to; else "".
    """

    s: float
    point: Point
    star: int
    tape: int
    along: float
    aside: float
    out: bool
    kind: str


class Met(NamedTuple):
    """An obstacle, by its number from 0, in the way of tapes of a star, or of legs, -1, by theirs."""

    obstacle: int
    star: int
    tapes: tuple[int, ...]


@dataclass(frozen=True)
class ChalkPlan:
    """Tapes and ticks of a dance.

    Attributes:
        stars: spokes about stakes.
        legs: tapes along the line elsewhere.
        ticks: along the route; of places that are walked again the first alone.
        met: obstacles in the way of tapes.
        allowed: how far the line may stray where ticks are joined straight, m.
        stray: how far it strays then at most, m; half of that where it bends half as much as it should.

    Examples:
        >>> walk = bd.read_plan("pujiang", {"dragon.benches": 5}).build()
        >>> chalk = bd.chalk_plan(bd.Trail.of(walk, 0.0, 10.0), 1.65, (0.0, 0.0))
        >>> chalk.stray < chalk.allowed == 0.825
        True
    """

    stars: tuple[Star, ...]
    legs: tuple[Leg, ...]
    ticks: tuple[Tick, ...]
    met: tuple[Met, ...]
    allowed: float
    stray: float


def chalk_plan(
    trail: Trail,
    link: float,
    peg: Point | Ground,
    said: float | None = None,
    obstacles: Sequence[Obstacle] = (),
) -> ChalkPlan | None:
    """The tapes and ticks of a trail; None for more than MOST_TICKS or MOST_WAY.

    Args:
        trail: where the dragon goes.
        link: the dragon's shortest link, m.
        peg: where it stands, m, so that x runs as in the plan; or peg and base line.
        said: how far the line may stray where ticks are joined straight, m; None for half a link.
        obstacles: of the plan.

    Raises:
        InputError: if `trail` is not a Trail, for a link or a peg that cannot be, and for less than
            LEAST_STRAY.

    Examples:
        >>> walk = bd.read_plan("pujiang", {"dragon.benches": 5}).build()
        >>> chalk = bd.chalk_plan(bd.Trail.of(walk, 0.0, 10.0), 1.65, (0.0, 0.0))
        >>> chalk.stars[0].spokes
        8
    """
    of_kind("trail", trail, Trail, "Trail.of(walk, start, end) makes one")
    allowed = SHARE * positive("link", link, "m") if said is None else said
    ground = _ground(peg)
    if not LEAST_STRAY <= allowed < math.inf:
        text = _("the chalk line may stray by at least {least} m between ticks, not {value} m")
        raise InputError(text.format(least=f"{LEAST_STRAY:g}", value=f"{allowed:g}"))
    if trail.high - trail.low > MOST_WAY:
        return None
    line = Line(trail, ground.peg)
    stars = [_star(line, n, ground, allowed) for n in range(len(line.stakes))]
    found = _crossings(line, trail, stars, ground.turned)
    found = _filled(line, found, allowed)
    if len(found) > MOST_TICKS:
        return None
    stray = max([0.0, *[line.stray(one.s, after.s) for one, after in itertools.pairwise(found)]])
    ticks = _ticks(line, stars, found, ground)
    legs: list[Leg] = []
    told = [one for one in ticks if one.star >= 0]
    for street in _streets(ticks):
        told += _along(street, legs, ground)
    once = _once(sorted(told, key=lambda one: one.s))
    for n, star in enumerate(stars):
        once = _in_and_out(once, n, star.spokes)
    met: list[Met] = []
    for n in range(-1, len(stars)):
        tapes = _tapes(legs) if n < 0 else _spokes(stars[n], ground.turned, once, n)
        met += _met(obstacles, n, tapes)
    return ChalkPlan(tuple(stars), tuple(legs), tuple(once), tuple(met), allowed, stray)


def _ground(peg: Point | Ground) -> Ground:
    """The peg with its base line, if it is a point."""
    if isinstance(peg, Ground):
        return peg
    try:
        x, y = peg
    except (TypeError, ValueError):
        text = _("peg must be a pair (x, y), not {value}")
        raise InputError(text.format(value=brief(peg))) from None
    return Ground((finite("peg x", x, "m"), finite("peg y", y, "m")))


def _star(line: Line, n: int, ground: Ground, allowed: float) -> Star:
    """A star with the fewest spokes between which a circle of its reach strays less than is allowed."""
    reach, stake = line.reach(n), line.stakes[n]
    enough = [spokes for spokes in SPOKES if 0.125 * reach * (2.0 * math.pi / spokes) ** 2 <= allowed]
    spokes = enough[0] if enough else SPOKES[-1]
    wheel = min(max(float(math.floor(reach)), 1.0), WHEEL)
    chord = 2.0 * wheel * math.sin(math.pi / spokes)
    return Star(stake, ground.seen_at(stake), spokes, reach, wheel, chord)


def _crossings(line: Line, trail: Trail, stars: Sequence[Star], turned: float) -> list[Crossing]:
    """All crossings, and where the line begins, where the head starts and where it ends, in order."""
    found = [Crossing(trail.low, 0, "tail"), Crossing(trail.high, 0, "end")]
    if trail.low < trail.start < trail.high:
        found.append(Crossing(trail.start, 0, "head"))
    for n, star in enumerate(stars):
        found += line.crossings(n, star.spokes, turned)
    if trail.route.kinks:
        found += [Crossing(s, 0, "") for s in line.joints(trail.low, trail.high)]
    kept: list[Crossing] = []
    for one in sorted(found, key=lambda one: one.s):
        if kept and one.s - kept[-1].s < SAME:
            before = kept.pop()
            on_tape = one if one.tape else before
            kept.append(Crossing(on_tape.s, on_tape.tape, before.kind or one.kind))
        else:
            kept.append(one)
    return kept


def _filled(line: Line, found: Sequence[Crossing], allowed: float) -> list[Crossing]:
    """The same with as many between them as keep the line from straying more than is allowed.

    No more than show that these are too many.
    """
    kept = [found[0]]
    for one, after in itertools.pairwise(found):
        if len(kept) <= MOST_TICKS:
            kept += [Crossing(s, 0, "") for s in _between(line, one.s, after.s, allowed)]
            kept.append(after)
    return kept


def _between(line: Line, a: float, b: float, allowed: float) -> list[float]:
    """Places between two others: as few of the joints as suffice, and equal parts where none does."""
    found: list[float] = []
    at, n, ends = a, 0, [*line.joints(a, b), b]
    while n < len(ends):
        while n + 1 < len(ends) and line.stray(at, ends[n + 1]) <= allowed:
            n += 1
        bent = math.ceil(math.sqrt(line.stray(at, ends[n]) / allowed))
        parts = max(bent, math.ceil((ends[n] - at) / LEG))
        found += [at + (ends[n] - at) * k / parts for k in range(1, parts)]
        if n < len(ends) - 1:
            found.append(ends[n])
        at, n = ends[n], n + 1
    return found


def _ticks(line: Line, stars: Sequence[Star], found: Sequence[Crossing], ground: Ground) -> list[Tick]:
    """Ticks at places, those of stars told by spokes."""
    ticks: list[Tick] = []
    seen = line.seen([one.s for one in found])
    for one, (x, y, _heading, _bend) in zip(found, seen, strict=True):
        star = line.star(one.s)
        if star < 0:
            ticks.append(Tick(one.s, (x, y), star, 0, 0.0, 0.0, False, one.kind))
            continue
        stake, spokes = stars[star].stake, stars[star].spokes
        off = x - stake[0], y - stake[1]
        share = (math.atan2(off[1], off[0]) - ground.turned) * spokes / (2.0 * math.pi)
        tape = one.tape or math.floor(share + 0.5) % spokes + 1
        angle = ground.turned + 2.0 * math.pi * (tape - 1) / spokes
        c, s = math.cos(angle), math.sin(angle)
        along, aside = c * off[0] + s * off[1], c * off[1] - s * off[0]
        off_tape = 0.0 if one.tape else aside
        ticks.append(Tick(one.s, (x, y), star, tape, along, off_tape, False, one.kind))
    return ticks


def _streets(ticks: Sequence[Tick]) -> list[list[Tick]]:
    """The ticks of no star, by stretches of the line."""
    found: list[list[Tick]] = []
    free = False
    for one in ticks:
        if one.star < 0 and free:
            found[-1].append(one)
        elif one.star < 0:
            found.append([one])
        free = one.star < 0
    return found


def _along(street: Sequence[Tick], legs: list[Leg], ground: Ground) -> list[Tick]:
    """The ticks of a stretch, told by as few tapes as reach them; the tapes are added to the others."""
    found: list[Tick] = []
    at, first = 0, True
    while at < len(street) - 1:
        to = at + 1
        while to + 1 < len(street) and _reaches(street, at, to + 1):
            to += 1
        last = None if first else legs[-1]
        leg = _leg(street[at].point, street[to].point, last, ground)
        legs.append(leg)
        found += [_beside(one, leg, len(legs)) for one in street[at:to]]
        at, first = to, False
    if found:
        return [*found, _beside(street[at], legs[-1], len(legs))]
    place = ground.seen_at(street[0].point)
    legs.append(Leg(street[0].point, street[0].point, place, (1.0, 0.0), 0.0, math.nan))
    return [_beside(street[0], legs[-1], len(legs))]


def _reaches(street: Sequence[Tick], at: int, to: int) -> bool:
    """Whether a tape from one tick to another is short enough, and all between are near beside it."""
    (x, y), (u, v) = street[at].point, street[to].point
    far = math.hypot(u - x, v - y)
    if not SAME < far <= LEG:
        return False
    return all(
        abs((u - x) * (one.point[1] - y) - (v - y) * (one.point[0] - x)) <= MOST_ASIDE * far
        and 0.0 <= (u - x) * (one.point[0] - x) + (v - y) * (one.point[1] - y) <= far * far
        for one in street[at + 1 : to]
    )


def _leg(start: Point, end: Point, last: Leg | None, ground: Ground) -> Leg:
    """A tape between two places, and how it is found from the one before it."""
    place, there = ground.seen_at(start), ground.seen_at(end)
    far = math.dist(start, end)
    way = (there[0] - place[0]) / far, (there[1] - place[1]) / far
    swing = math.nan
    if last is not None:
        cross = last.way[0] * way[1] - last.way[1] * way[0]
        turn = math.atan2(cross, last.way[0] * way[0] + last.way[1] * way[1])
        swing = 2.0 * ARM * math.sin(0.5 * turn)
    return Leg(start, end, place, way, far, swing)


def _beside(tick: Tick, leg: Leg, number: int) -> Tick:
    """A tick as told by a leg."""
    far = max(leg.length, SAME)
    ux, uy = (leg.end[0] - leg.start[0]) / far, (leg.end[1] - leg.start[1]) / far
    x, y = tick.point[0] - leg.start[0], tick.point[1] - leg.start[1]
    along, aside = ux * x + uy * y, ux * y - uy * x
    return Tick(tick.s, tick.point, -1, number, along, aside, False, tick.kind)


def _once(ticks: Sequence[Tick]) -> list[Tick]:
    """The same without those at a place where one was: a closed line is walked again."""
    kept: list[Tick] = []
    for one in ticks:
        again = [other for other in kept if math.dist(other.point, one.point) < SAME]
        if one.kind or not again:
            kept.append(one)
    return kept


def _in_and_out(ticks: Sequence[Tick], star: int, spokes: int) -> list[Tick]:
    """The same with those noted that come after the nearest to a stake, if turns lie on both sides."""
    own = [one for one in ticks if one.star == star]
    away = [math.hypot(one.along, one.aside) for one in own]
    last = away.index(min(away))
    if min(last, len(own) - 1 - last) < spokes:
        return list(ticks)
    nearest = own[last].s
    return [one._replace(out=one.out or (one.star == star and one.s > nearest)) for one in ticks]


def _tapes(legs: Sequence[Leg]) -> list[tuple[int, Point, Point]]:
    """Legs by their numbers, with where they begin and end, m."""
    return [(n, leg.start, leg.end) for n, leg in enumerate(legs, start=1)]


def _spokes(
    star: Star, turned: float, ticks: Sequence[Tick], number: int
) -> list[tuple[int, Point, Point]]:
    """The spokes of a star by their numbers, from the stake to the last tick of each, m."""
    found: list[tuple[int, Point, Point]] = []
    x, y = star.stake
    for tape in range(1, star.spokes + 1):
        angle = turned + 2.0 * math.pi * (tape - 1) / star.spokes
        reached = [one.along for one in ticks if one.star == number and one.tape == tape]
        far = max([0.0, *reached])
        found.append((tape, star.stake, (x + far * math.cos(angle), y + far * math.sin(angle))))
    return found


def _met(
    obstacles: Sequence[Obstacle], star: int, tapes: Sequence[tuple[int, Point, Point]]
) -> list[Met]:
    """The obstacles in the way of tapes of a star."""
    found: list[Met] = []
    for n, one in enumerate(obstacles):
        if one.kind != "venue":
            there = [tape for tape, start, end in tapes if _is_met(one, start, end)]
            if there:
                found.append(Met(n, star, tuple(there)))
    return found


def _is_met(one: Obstacle, start: Point, end: Point) -> bool:
    """Whether an obstacle touches the straight line between two places."""
    corners = [(x, y) for x, y in one.outline.tolist()]
    ends = [*corners[1:], *([] if one.kind == "line" else corners[:1])]
    sides = zip(corners, ends, strict=False)
    return any(_apart(start, end, a, b) <= one.radius for a, b in sides)


def _apart(a: Point, b: Point, c: Point, d: Point) -> float:
    """How far apart two straight lines are, m, between their ends."""
    over = (_left(a, b, c) < 0.0) != (_left(a, b, d) < 0.0)
    if over and (_left(c, d, a) < 0.0) != (_left(c, d, b) < 0.0):
        return 0.0
    return min(_away(a, b, c), _away(a, b, d), _away(c, d, a), _away(c, d, b))


def _left(a: Point, b: Point, c: Point) -> float:
    """How far c is to the left of the way from a to b, times its length, m^2."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _away(a: Point, b: Point, c: Point) -> float:
    """How far c is from the straight line between a and b, m."""
    u, v = b[0] - a[0], b[1] - a[1]
    long = u * u + v * v
    share = ((c[0] - a[0]) * u + (c[1] - a[1]) * v) / long if long > 0.0 else 0.0
    share = min(max(share, 0.0), 1.0)
    return math.hypot(c[0] - a[0] - share * u, c[1] - a[1] - share * v)
