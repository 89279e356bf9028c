"""A first dance from the benches, the people and the square of a village.

The dance can be walked, but need not be the best: sizes come from the searches of this room, rounded
up, and the proposal passes the same check as any plan. Benches are widened, and the head lengthened, so
that bearers have room (`room.with_people`).
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from typing import Any, Literal

import numpy as np
import shapely

from benchdragon import budget
from benchdragon.analysis.check import Report, check
from benchdragon.analysis.room import with_people
from benchdragon.analysis.swept import swept_area
from benchdragon.errors import InputError, UnsureError, WalkError, as_number, of_kind
from benchdragon.i18n import N_, _, both
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.answers import MOST_BEARERS, MOST_BENCHES
from benchdragon.plans.schema import Plan, checked
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress, silent
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import limit

Carry = Literal["beside", "under"]
Kind = Literal["turn", "spiral-in"]
KINDS: tuple[Kind, ...] = ("turn", "spiral-in")
NAME = "benchdragon new"

# Assumed of people, m: shoulders' breadth, which is the room beside a bench or under it; the length of
# a bench that a bearer needs; room before the head; and, unless measured, how far benches sway and
# bearers stray.
SHOULDERS, ELBOWS, AHEAD, SWAY, IMPRECISION = 0.5, 0.5, 0.5, 0.05, 0.1
# Asked for beyond that, m: between benches, and from the edge of the square.
MARGIN, VENUE_MARGIN = 0.05, 0.5
# Sizes are proposed in decimetres, speeds in steps of 5 cm/s: finer ones cannot be laid out.
SIZE_STEP, SPEED_STEP = 0.1, 0.05
# Discs that are tried, as multiples of the longer of a link and a bench's width with its bearers.
DISCS = (2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 10.0)
# A disc beside which the pitch is more than so many times as wide as benches are is too small.
WIDE = 2.0
# Benches with which sizes are sought: what lies farther out in a coil is less tight.
ENOUGH = 60
# Rounds of the spiral that the head walks in before it turns or stops; the first that fit are taken.
ROUNDS: dict[Kind, tuple[float, ...]] = {
    "turn": (2.0, 1.0, 0.5, 0.0), "spiral-in": (6.0, 4.0, 3.0, 2.0, 1.0, 0.5),
}  # fmt: skip
# Error of the ground, m; corners of a round square; angles of the dance, degrees.
DRAWN, CORNERS, ANGLES = 0.02, 90, 180
# Sizes of a bench, in the order of `Dragon.sizes`.
SIZES = ("length", "width", "front_inset", "rear_inset")
TITLE = N_("A bench dragon on our square")


@dataclass(frozen=True)
class Wishes:
    """The data that a village gives of its dragon and its square: m, m/s.

    Attributes:
        benches: how many, head and tail included.
        length: of a bench.
        width: of a bench.
        head_length: of the head's bench.
        inset: from a bench's ends to its holes.
        rectangle: length and width of the square; or
        radius: of a round one.
        bearers: people who carry one bench.
        carry: whether they walk beside it or under it.
        speed: of the head, at most.
        most_speed: the greatest at which a bench can be carried.
        kind: of the dance; None: coiling in and out again, where it fits, else coiling in.
        roster: a list of names beside the plan.
        sway: how far benches sway to a side.
        imprecision: how far bearers stray from their line.
        measured: which of these two were measured; the others are assumed.
    """

    benches: int
    length: float
    width: float
    head_length: float = 2.0
    inset: float = 0.15
    rectangle: tuple[float, float] | None = None
    radius: float | None = None
    bearers: int = 2
    carry: Carry = "beside"
    speed: float = 0.8
    most_speed: float = 1.5
    kind: Kind | None = None
    roster: str = ""
    sway: float = SWAY
    imprecision: float = IMPRECISION
    measured: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        """Refuse what is no number."""
        names = ("benches", "length", "width", "head_length", "inset", "bearers", "speed")
        for name in (*names, "sway", "imprecision"):
            as_number(name, getattr(self, name))

    @property
    def stray(self) -> float:
        """How far a bench with its bearers may be from where it should, m."""
        return self.sway + self.imprecision

    @property
    def between(self) -> float:
        """What two benches with their bearers keep from one another, m: each sways and strays."""
        return MARGIN + 2.0 * self.stray

    @property
    def beside(self) -> float:
        """Room for bearers on each side of a bench, m, rounded up to a centimetre."""
        if self.carry == "beside":
            return SHOULDERS
        return max(0.0, _up(0.5 * (SHOULDERS - self.width), 0.01))


@dataclass(frozen=True)
class Proposal:
    """A dance that can be walked: its plan and the check of it; `slower` if slower than was wished."""

    plan: Plan
    report: Report
    slower: bool


@dataclass(frozen=True)
class TooSmall:
    """No dance was found that fits the square.

    Attributes:
        kind: of the dance that takes the least room of those tried.
        rectangle: on which that dance fits, its margins included, m; rounded up.
        radius: of a round square on which it fits, m; rounded up.
        benches: so many, of the same sizes, fit on the square; 0 where none were found to.
        under: whether all of them fit if bearers walk under their benches, not beside them.
    """

    kind: Kind
    rectangle: tuple[float, float]
    radius: float
    benches: int
    under: bool = False


@dataclass(frozen=True)
class _Dance:
    """A dance with its room: the corners of what it covers, about its origin, (n, 2), m."""

    plan: Plan
    ground: FloatArray


@budget.question()
def propose(wishes: Wishes, *, progress: Progress = silent) -> Proposal | TooSmall:
    """A dance of the benches on the square that passes `check`, or how much too small the square is.

    Raises:
        InputError: if `wishes` is not a Wishes, for a square that is missing or given twice, and for
            sizes that no dance can have.
        UnsureError: if what fits the square does not pass the check.
        PlanError: for sizes of which no dragon can be built.
    """
    of_kind("wishes", wishes, Wishes)
    _refuse(wishes)
    tried = _tried(wishes, ROUNDS, progress)
    if tried.found is not None:
        return tried.found
    if not tried.smallest:
        raise InputError(
            _(
                "no dance of these benches was found among the pitches and turning discs that were "
                "tried: try another --kind, or shorter or narrower benches"
            )
        )
    if tried.fits:
        raise UnsureError(
            _(
                "a dance was found that fits the square, but it does not pass the check: try "
                "narrower benches, or another --kind"
            )
        )
    progress(0.9, _("how large a square it takes"))
    smallest = min(tried.smallest, key=lambda dance: _radius(dance.ground))
    return _too_small(wishes, smallest, _fits_under(wishes))


def benches_out_again(wishes: Wishes, *, progress: Progress = silent) -> int:
    """How many benches fit on the square if the dance is to come out again; 0 if none were found to.

    Fewer than requested: for all of them no dance out again was found, or none was requested.
    """
    of_kind("wishes", wishes, Wishes)
    _refuse(wishes)
    progress(0.0, _("how many benches come out again"))
    sized = _sized(wishes, "turn")
    return 0 if sized is None else _fitting(wishes, sized)


@dataclass(frozen=True)
class _Tried:
    """The result of trying the kinds of dance: one that passes the check, or that with the least room.

    `fits` says whether any dance fits the square.
    """

    found: Proposal | None
    smallest: list[_Dance]
    fits: bool


def _tried(wishes: Wishes, walked: Mapping[Kind, Sequence[float]], progress: Progress) -> _Tried:
    """Try each kind with so many rounds walked, the most first that fit."""
    kinds = KINDS if wishes.kind is None else (wishes.kind,)
    smallest: list[_Dance] = []
    fits = False
    for n, kind in enumerate(kinds):
        progress(n / len(kinds), _("pitch and disc"))
        sized = _sized(wishes, kind)
        if sized is None:
            continue
        progress((n + 0.5) / len(kinds), _("place on the square"))
        least = list(_dances(wishes, sized, walked[kind][-1:]))
        smallest += least
        if least and _placed(wishes, least[0]) is None:  # with more rounds it does not fit either
            continue
        more = (rounds for rounds in walked[kind][:-1] if not _too_wide(wishes, sized, rounds))
        for dance in chain(_dances(wishes, sized, more), least):
            placed = _placed(wishes, dance)
            fits = fits or placed is not None
            if placed is not None and (found := _walked(wishes, placed)) is not None:
                return _Tried(found, smallest, fits)
    return _Tried(None, smallest, fits)


def _too_wide(wishes: Wishes, sized: Plan, rounds: float) -> bool:
    """Whether a dragon that begins so many rounds out is sure to be wider than the square.

    Its coil is taken for rings: what a round covers is its length times the pitch.
    """
    pitch, disc = sized.value("route.pitch"), sized.value("disc.radius")
    inner = disc + rounds * pitch
    link = wishes.length - 2.0 * wishes.inset
    outer = math.sqrt(inner * inner + wishes.benches * link * pitch / math.pi)
    narrow = 2.0 * (wishes.radius or 0.0) if wishes.rectangle is None else min(wishes.rectangle)
    return outer > inner + pitch and 2.0 * (outer - pitch) > narrow


def _fits_under(wishes: Wishes) -> bool:
    """Whether the dance fits if bearers walk under their benches, not beside them."""
    if wishes.carry == "under":
        return False
    under = replace(wishes, carry="under")
    try:
        _refuse(under)
    except InputError:  # so many have no room behind one another under a bench
        return False
    shortest = {kind: rounds[-1:] for kind, rounds in ROUNDS.items()}
    return _tried(under, shortest, silent).found is not None


def _refuse(wishes: Wishes) -> None:
    """Refuse impossible wishes before anything is computed."""
    if (wishes.rectangle is None) == (wishes.radius is None):
        raise InputError(_("say how large the square is: either its rectangle or its radius"))
    if not 2 <= wishes.benches <= MOST_BENCHES:
        text = _("a dance is proposed for 2 to {most} benches, not {count}")
        raise InputError(text.format(most=MOST_BENCHES, count=wishes.benches))
    if not 1 <= wishes.bearers <= MOST_BEARERS:
        text = _("a bench is carried by 1 to {most} people, not {count}")
        raise InputError(text.format(most=MOST_BEARERS, count=wishes.bearers))
    behind = math.ceil(wishes.bearers / 2) if wishes.carry == "beside" else wishes.bearers
    if behind * ELBOWS > wishes.length:
        text = _("a bench of {length} m has no room for {count} bearers behind one another")
        raise InputError(text.format(length=f"{wishes.length:g}", count=behind))


def _data(wishes: Wishes, kind: Kind, pitch: float, disc: float) -> dict[str, Any]:
    """The plan of a dance on no square yet, as parsed TOML."""
    title = both(lambda: _(TITLE))
    people: dict[str, Any] = {
        "beside": wishes.beside, "ahead": AHEAD, "sway": wishes.sway,
        "imprecision": wishes.imprecision, "most_speed": wishes.most_speed,
    }  # fmt: skip
    sources = {name: _("measured by the troupe") for name in sorted(wishes.measured)}
    people |= {"source": sources} if sources else {}
    return {
        "schema": 1,
        "meta": {"title": title.en, "title_zh": title.zh},
        "dragon": {
            "benches": wishes.benches, "width": wishes.width, "head_length": wishes.head_length,
            "body_length": wishes.length, "tail_length": wishes.length,
            "front_inset": wishes.inset, "rear_inset": wishes.inset,
        },
        "route": {"kind": kind, "pitch": pitch},
        "disc": {"radius": disc},
        "walk": {"speed": wishes.speed},
        "limits": {"speed": wishes.most_speed, "margin": MARGIN},
        "people": people | ({"roster": wishes.roster} if wishes.roster else {}),
    }  # fmt: skip


def _begun(plan: Plan, rounds: float) -> Plan:
    """The dance begun so many rounds of the spiral before its turn or its end."""
    pitch, disc = plan.value("route.pitch"), plan.value("disc.radius")
    if plan.route.kind == "spiral-in":
        return plan.with_value("route.start_turn", _up(disc / pitch + rounds, 0.01))
    way = 2.0 * math.pi * rounds * (disc + 0.5 * rounds * pitch)
    plan = plan.with_value("walk.start", 0.0 - _up(way / plan.walk.speed, 1.0))
    _start, end = plan.span(plan.build())
    return plan.with_value("walk.end", _up(end, 1.0))


def _sized(wishes: Wishes, kind: Kind) -> Plan | None:
    """The dance with the sizes that take the least room; None if none was found."""
    few = replace(wishes, benches=min(wishes.benches, ENOUGH), roster="")
    link = max(wishes.length, wishes.head_length) - 2.0 * wishes.inset
    wide = wishes.width + 2.0 * wishes.beside
    dragon = wishes.benches * (wishes.length - 2.0 * wishes.inset) / math.pi
    first = (wide + wishes.between) * (2.0 if kind == "turn" else 1.0)
    least, best = math.inf, None
    for share in DISCS:
        disc = _up(share * max(link, wide), SIZE_STEP)
        if disc * disc + dragon * first > least:  # no pitch is smaller than the first
            break
        pitch = max(_pitch(few, kind, 1.25 * first, disc), _up(first, SIZE_STEP))
        room = disc * disc + dragon * pitch
        if pitch <= WIDE * first and room < least:
            least, best = room, (pitch, disc)
    if best is None:
        return None
    pitch, disc = best
    return checked(_data(wishes, kind, pitch, disc), NAME)


def _trial(wishes: Wishes, kind: Kind, pitch: float, disc: float) -> Plan:
    """A plan of benches with their room, for searches of sizes."""
    data = _data(wishes, kind, pitch, disc)
    plan = checked(data, NAME)
    # Building reports errors in the village's benches.
    head, body, *_others = with_people(plan.dragon.build(), plan.people).sizes.T.tolist()
    sizes = [dict(zip(SIZES, bench, strict=True)) for bench in (head, body)]
    data["dragon"] = {"bench": [sizes[0], sizes[1] | {"count": wishes.benches - 1}]}
    data["limits"]["margin"] = wishes.between
    if kind == "spiral-in":
        data["route"]["start_turn"] = disc / pitch + 6.0
    del data["people"]
    return checked(data, NAME)


def _pitch(wishes: Wishes, kind: Kind, first: float, disc: float) -> float:
    """The smallest pitch beside a disc, rounded up, m; inf if none, 0 if every pitch serves."""
    try:
        found = limit(_trial(wishes, kind, first, disc), "pitch", tolerance=0.1 * SIZE_STEP)
    except (PlanError, WalkError, UnsureError):
        return math.inf
    if found.status == "unlimited":
        return 0.0
    return _up(found.upper, SIZE_STEP) if found.status == "found" else math.inf


def _dances(wishes: Wishes, sized: Plan, rounds_walked: Iterable[float]) -> Iterator[_Dance]:
    """The dance begun early, then later, each with the ground that it covers with its people."""
    for rounds in rounds_walked:
        try:
            plan = _begun(_steady(wishes, sized, rounds), rounds)
            walk = plan.build()
            wide = replace(walk, dragon=with_people(walk.dragon, plan.people))
            region = swept_area(wide, *plan.span(walk), error=DRAWN).polygon
        except (WalkError, UnsureError, PlanError):
            continue
        yield _Dance(plan, shapely.get_coordinates(region.convex_hull))


def _steady(wishes: Wishes, sized: Plan, rounds: float) -> Plan:
    """The dance at a head speed with which no handle is faster than a bench can be carried."""
    found = greatest_head_speed(_begun(sized, rounds))
    most = min(found.lower, wishes.speed)
    steps = _down(most, SPEED_STEP)
    return sized.with_value("walk.speed", steps if steps > 0.0 else _down(most, 1e-3))


def _kept(wishes: Wishes) -> float:
    """How far benches with their bearers keep from the edge of the square, m."""
    return VENUE_MARGIN + wishes.stray


def _placed(wishes: Wishes, dance: _Dance) -> Plan | None:
    """The dance in the middle of the square, turned to have the most room; None if it does not fit."""
    if wishes.rectangle is None:
        middle, turned = _circle(dance.ground)[0], 0.0
        room = float(wishes.radius or 0.0) * math.cos(math.pi / CORNERS) - _radius(dance.ground)
        venue: dict[str, Any] = {"boundary": _corners(wishes)}
    else:
        length, width = wishes.rectangle
        boxes = [_box(dance.ground, math.radians(angle)) for angle in range(ANGLES)]
        rooms = [0.5 * min(length - high[0] + low[0], width - high[1] + low[1]) for low, high in boxes]
        turned = float(np.argmax(rooms))
        room, (low, high) = max(rooms), boxes[int(turned)]
        middle = 0.5 * (low + high)
        venue = {"rectangle": list(wishes.rectangle)}
    if room < _kept(wishes) + 0.01:  # rounding of the place
        return None
    at = [round(-x, 2) + 0.0 for x in middle.tolist()]
    data = dance.plan.data()
    data["venue"] = venue
    data["route"] |= {"at": at, "turned": turned}
    data["limits"]["venue_margin"] = VENUE_MARGIN
    return checked(data, NAME)


def _walked(wishes: Wishes, plan: Plan) -> Proposal | None:
    """The proposal, if the plan passes the check, room for people included; None if not."""
    report = check(plan)
    return Proposal(plan, report, plan.walk.speed < wishes.speed) if report.safe else None


def _too_small(wishes: Wishes, dance: _Dance, under: bool) -> TooSmall:
    """How much room a dance takes, and how many benches would fit."""
    boxes = [_box(dance.ground, math.radians(angle)) for angle in range(ANGLES)]
    low, high = min(boxes, key=lambda box: float(np.prod(box[1] - box[0])))
    kept = 2.0 * (_kept(wishes) + 0.01)
    sides = sorted((_up(float(side) + kept, SIZE_STEP) for side in high - low), reverse=True)
    radius = (_radius(dance.ground) + 0.5 * kept) / math.cos(math.pi / CORNERS)
    kind: Kind = "turn" if dance.plan.route.kind == "turn" else "spiral-in"
    fitting = _fitting(wishes, dance.plan)
    return TooSmall(kind, (sides[0], sides[1]), _up(radius, SIZE_STEP), fitting, under)


def _fitting(wishes: Wishes, plan: Plan) -> int:
    """How many benches of the same dance fit on the square; 0 if none were found to."""
    fits, not_fit = 1, wishes.benches
    while not_fit - fits > 1:
        middle = (fits + not_fit) // 2
        fits, not_fit = (middle, not_fit) if _on_square(wishes, plan, middle) else (fits, middle)
    placed = _on_square(wishes, plan, fits) if fits > 1 else []
    return fits if any(_walked(wishes, one) is not None for one in placed) else 0


def _on_square(wishes: Wishes, plan: Plan, benches: int) -> list[Plan]:
    """The same dance of fewer benches, each way in which it fits on the square."""
    kind: Kind = "turn" if plan.route.kind == "turn" else "spiral-in"
    sizes = plan.value("route.pitch"), plan.value("disc.radius")
    fewer = replace(wishes, benches=benches)
    dances = _dances(fewer, checked(_data(fewer, kind, *sizes), NAME), ROUNDS[kind][-1:])
    return [placed for dance in dances if (placed := _placed(fewer, dance)) is not None]


def _box(ground: FloatArray, turned: float) -> tuple[FloatArray, FloatArray]:
    """The lowest and the highest x and y of a ground that is turned, m."""
    c, s = math.cos(turned), math.sin(turned)
    corners = ground @ np.array([[c, s], [-s, c]])
    return corners.min(axis=0), corners.max(axis=0)


def _circle(ground: FloatArray) -> tuple[FloatArray, float]:
    """Centre and radius of the smallest circle about a ground, m."""
    shape = shapely.Polygon(ground)
    centre = shapely.get_coordinates(shapely.minimum_bounding_circle(shape).centroid)[0]
    return centre, float(np.linalg.norm(ground - centre, axis=1).max())


def _radius(ground: FloatArray) -> float:
    """Radius of the smallest circle about a ground, m."""
    return _circle(ground)[1]


def _corners(wishes: Wishes) -> list[list[float]]:
    """The corners of a round square, to a millimetre, m."""
    angles = 2.0 * math.pi * np.arange(CORNERS) / CORNERS
    corners = float(wishes.radius or 0.0) * np.column_stack([np.cos(angles), np.sin(angles)])
    return [[float(x) for x in corner] for corner in np.round(corners, 3) + 0.0]


def _up(value: float, step: float) -> float:
    """The next multiple of a step, upwards, as a short decimal."""
    return round(math.ceil(value / step - 1e-9) * step, 6)


def _down(value: float, step: float) -> float:
    """The next multiple of a step, downwards, as a short decimal."""
    return round(math.floor(value / step + 1e-9) * step, 6)
