"""A first dance from the benches, the people and the square of a village.

The dance can be walked, but need not be the best: sizes come from the searches of this room, rounded
up, and the proposal passes the same check as any plan. Benches are widened, and the head lengthened, so
that bearers have room (`room.with_people`).
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from benchdragon import budget
from benchdragon.analysis.check import Report
from benchdragon.analysis.check import checked as judged
from benchdragon.analysis.contact import first_sure_contact
from benchdragon.analysis.room import with_people
from benchdragon.errors import InputError, NoSolutionError, UnsureError, WalkError, of_kind
from benchdragon.i18n import _
from benchdragon.plans.schema import Plan, checked
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress, part, silent
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import found_limit
from benchdragon.solve.square import Square
from benchdragon.solve.wishes import (
    AGAIN,
    CORNERS,
    NAME,
    VENUE_MARGIN,
    Kind,
    Wishes,
    refuse,
    rounded_down,
    rounded_up,
)

KINDS: tuple[Kind, ...] = ("turn", "spiral-in")

# Room before the head, m: the first with which all benches fit.
AHEAD = (0.5, 0.3)
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
# The same of a dance to which a street leads, whatever its first rounds are.
LED: dict[Kind, tuple[float, ...]] = {"turn": (0.0,), "spiral-in": (2.0, 0.5)}
# A street to which so many dances that fit do not go is given up.
MOST_REFUSED = 4
# Of pairs of pitch and disc those that take the least room, so many, are tried on the square.
MOST_SIZES = 3
# What corners between the boxes of a square may be farther out, m; angles at which a dance is measured,
# degrees.
SPARE, ANGLES = 0.025, 180
# Sizes of a bench, in the order of `Dragon.sizes`.
SIZES = ("length", "width", "front_inset", "rear_inset")


@dataclass(frozen=True)
class Proposal:
    """A dance that can be walked.

    Attributes:
        plan: of the dance.
        report: the check of it.
        slower: whether it is slower than was wished.

    Examples:
        >>> wishes = bd.Wishes(2, 1.5, 0.15, radius=9.0, kind="spiral-in")
        >>> bd.propose(wishes).report.safe
        True
    """

    plan: Plan
    report: Report
    slower: bool

    @property
    def less_ahead(self) -> bool:
        """Whether there is less room before the head than usual, so that all benches fit."""
        return self.plan.people.ahead < AHEAD[0]


@dataclass(frozen=True)
class TooSmall:
    """No dance was found that fits the square.

    Attributes:
        kind: of the dance that takes the least room of those tried.
        rectangle: on which that dance fits if nothing else stands there, its margins included, m;
            rounded up.
        radius: of such a round square, m; rounded up.
        benches: so many, of the same sizes, fit on the square; 0 where none were found to.
        under: whether all of them fit if bearers walk under their benches, not beside them.

    Examples:
        >>> refused = bd.propose(bd.Wishes(20, 1.5, 0.15, rectangle=(3.0, 3.0)))
        >>> type(refused).__name__, refused.benches < 20
        ('TooSmall', True)
    """

    kind: Kind
    rectangle: tuple[float, float]
    radius: float
    benches: int
    under: bool = False


@dataclass(frozen=True)
class _Dance:
    """A dance at the roomiest pose that was found: its plan there, and how much more room it has, m."""

    square: Square
    plan: Plan
    room: float

    @property
    def radius(self) -> float:
        """Of the smallest circle about it, m."""
        return self.square.circle()[2]


@budget.question()
def propose(wishes: Wishes, *, progress: Progress = silent) -> Proposal | TooSmall:
    """A dance of the benches on the square that passes `check`, or how much too small the square is.

    All benches are kept: the kind of the dance, its pitch and disc, the room before the head, how far
    it is walked, its place and direction are tried, beside all obstacles on the square. Rounds and
    the street are kept where a dance with them fits, the street rather than rounds.

    Raises:
        InputError: if `wishes` is not a Wishes, for a square that is missing or given twice, and for
            sizes that no dance can have.
        NoSolutionError: if the benches themselves need more ground than there is, or one is longer.
        UnsureError: if what fits the square does not pass the check.
        PlanError: for sizes of which no dragon can be built, and for obstacles that cannot be.

    Examples:
        >>> proposed = bd.propose(bd.Wishes(2, 1.5, 0.15, radius=9.0, kind="spiral-in"))
        >>> proposed.plan.route.kind
        'spiral-in'
    """
    of_kind("wishes", wishes, Wishes)
    refuse(wishes)
    _refuse_ground(wishes)
    trades = _trades(wishes)
    for n, less in enumerate(trades):
        walked = ROUNDS if less.street is None else LED
        tried = _tried(less, walked, part(progress, n / len(trades), (n + 1.0) / len(trades)))
        if tried.found is not None:
            return tried.found
    wishes = trades[-1]
    if tried.fits:
        text = _(
            "a dance was found that fits the square, but it does not pass the check: try "
            "narrower benches"
        )
        raise UnsureError(text)
    least = _least(wishes)
    if not least:
        text = _(
            "no dance of these benches was found among the pitches and turning discs that were tried: "
            "try narrower benches, or holes nearer to their ends"
        )
        raise InputError(text)
    progress(0.9, _("how large a square it takes"))
    smallest = min(least, key=lambda dance: dance.radius)
    return _too_small(wishes, smallest, _fits_under(wishes))


def benches_out_again(wishes: Wishes, *, progress: Progress = silent) -> int:
    """How many benches fit on the square if the dance is to come out again; 0 if none were found to.

    Fewer than requested: for all of them no dance out again was found, or none was requested.
    """
    of_kind("wishes", wishes, Wishes)
    refuse(wishes)
    progress(0.0, _("how many benches come out again"))
    return _fitting(replace(wishes, rounds=1), "turn")


def _trades(wishes: Wishes) -> list[Wishes]:
    """The wishes, then what is traded for benches: rounds, then the street."""
    found = [replace(wishes, kind="turn")] if wishes.rounds > 1 else []
    found.append(replace(wishes, rounds=1))
    return found if wishes.street is None else found + [replace(one, street=None) for one in found]


@dataclass(frozen=True)
class _Tried:
    """The result of trying all dances.

    Attributes:
        found: one that passes the check, if any.
        fits: whether any of them fits the square.
    """

    found: Proposal | None
    fits: bool


def _tried(wishes: Wishes, walked: Mapping[Kind, Sequence[float]], progress: Progress) -> _Tried:
    """Try each kind and its sizes with so many rounds walked, the most first that fit."""
    sorts = [(kind, ahead) for kind in _kinds(wishes) for ahead in AHEAD]
    fits, refused = False, 0
    for n, (kind, ahead) in enumerate(sorts):
        progress(n / len(sorts), _("pitch and disc"))
        for sized in _sized(wishes, kind, ahead, walked[kind][-1]):
            progress((n + 0.5) / len(sorts), _("place on the square"))
            first = _placed(wishes, sized, walked[kind][-1])
            if first is None or first.room < 0.0:  # with more rounds it does not fit either
                continue
            fits = True
            for rounds in walked[kind]:
                last = rounds == walked[kind][-1]
                if not last and _too_wide(wishes, sized, rounds):
                    continue
                dance = first if last else _placed(wishes, sized, rounds)
                if dance is None or dance.room < 0.0:
                    continue
                found = _walked(wishes, dance.plan)
                refused += 1
                if found is not None or (wishes.street is not None and refused == MOST_REFUSED):
                    return _Tried(found, fits)
    return _Tried(None, fits)


def _kinds(wishes: Wishes) -> tuple[Kind, ...]:
    """The kinds of dance that may be proposed."""
    return KINDS if wishes.kind is None else (wishes.kind,)


def _least(wishes: Wishes) -> list[_Dance]:
    """The dances that take the least room, with the fewest rounds walked."""
    found = []
    for kind in _kinds(wishes):
        for sized in _sized(wishes, kind, AHEAD[-1]):
            dance = _placed(wishes, sized, ROUNDS[kind][-1])
            if dance is not None:
                found.append(dance)
    return found


def _too_wide(wishes: Wishes, sized: Plan, rounds: float) -> bool:
    """Whether a dragon that begins so many rounds out is sure to be wider than the square.

    Its coil is taken for rings: what a round covers is its length times the pitch.
    """
    pitch, disc = sized.value("route.pitch"), sized.value("disc.radius")
    inner = disc + rounds * pitch
    link = wishes.length - 2.0 * wishes.inset
    outer = math.sqrt(inner * inner + wishes.benches * link * pitch / math.pi)
    narrow = 2.0 * (wishes.radius or 0.0)
    if wishes.rectangle is not None:
        narrow = min(wishes.rectangle)
    elif wishes.boundary is not None:
        narrow = min(max(sides) - min(sides) for sides in zip(*wishes.boundary, strict=True))
    return outer > inner + pitch and 2.0 * (outer - pitch) > narrow


def _fits_under(wishes: Wishes) -> bool:
    """Whether the dance fits if bearers walk under their benches, not beside them."""
    if wishes.carry == "under":
        return False
    under = replace(wishes, carry="under")
    try:
        refuse(under)
    except InputError:  # so many have no room behind one another under a bench
        return False
    shortest = {kind: rounds[-1:] for kind, rounds in ROUNDS.items()}
    return _tried(under, shortest, silent).found is not None


def _refuse_ground(wishes: Wishes) -> None:
    """Refuse benches that cannot stand on the square however they dance, without any search.

    No two of them overlap that have one between them, so that every second one has ground of its own;
    and none is longer than the box about the square is from corner to corner.
    """
    wishes.plan(_kinds(wishes)[0], 1.0, 1.0, AHEAD[-1])  # reports sizes that cannot be
    corners = wishes.corners
    turns = zip(corners, (*corners[1:], corners[0]), strict=True)
    area = 0.5 * abs(sum(x * to_y - y * to_x for (x, y), (to_x, to_y) in turns))
    bench = wishes.length * wishes.width
    if wishes.benches // 2 * bench > area:
        text = _(
            "{count} benches do not fit on this square, however they dance: every second one alone "
            "takes {needed} m² in all, and the square has {area} m², enough for {most} benches at most"
        )
        needed, most = wishes.benches // 2 * bench, 2 * int(area / bench) + 1
        words = {"needed": f"{needed:.1f}", "area": f"{area:.1f}", "most": most}
        raise NoSolutionError(text.format(count=wishes.benches, **words))
    across = math.hypot(*(max(sides) - min(sides) for sides in zip(*corners, strict=True)))
    longest = max(wishes.length, wishes.head_length)
    if longest > across:
        text = _("a bench of {length} m does not fit on this square, which is {across} m across")
        raise NoSolutionError(text.format(length=f"{longest:g}", across=f"{across:.2f}"))


def _begun(plan: Plan, rounds: float) -> Plan:
    """The dance begun so many rounds of the spiral before its turn or its end."""
    pitch, disc = plan.value("route.pitch"), plan.value("disc.radius")
    if plan.route.kind == "spiral-in":
        return plan.with_value("route.start_turn", rounded_up(disc / pitch + rounds, 0.01))
    way = 2.0 * math.pi * rounds * (disc + 0.5 * rounds * pitch)
    plan = plan.with_value("walk.start", 0.0 - rounded_up(way / plan.walk.speed, 1.0))
    _start, end = plan.span(plan.build())
    return plan.with_value("walk.end", rounded_up(end, 1.0))


def _sized(wishes: Wishes, kind: Kind, ahead: float, rounds: float | None = None) -> list[Plan]:
    """The dance with each of the sizes that take the least room.

    With `rounds` those are left out that cannot fit the square, begun so many rounds out.
    """
    few = replace(wishes, benches=min(wishes.benches, ENOUGH), roster="", rounds=1)
    link = max(wishes.length, wishes.head_length) - 2.0 * wishes.inset
    wide = wishes.width + 2.0 * wishes.beside
    dragon = wishes.benches * (wishes.length - 2.0 * wishes.inset) / math.pi
    first = (wide + wishes.between) * (2.0 if kind == "turn" else 1.0)
    found: list[tuple[float, float, float]] = []
    for share in DISCS:
        disc = rounded_up(share * max(link, wide), SIZE_STEP)
        best = sorted(found)[:MOST_SIZES]
        # No pitch is smaller than the first.
        if len(best) == MOST_SIZES and disc * disc + dragon * first > best[-1][0]:
            break
        least = rounded_up(first, SIZE_STEP)
        if rounds is not None and _never_fits(wishes, kind, least, disc, ahead, rounds):
            continue
        pitch = max(_pitch(few, kind, first, disc, ahead), least)
        if pitch <= WIDE * first:
            found.append((disc * disc + dragon * pitch, pitch, disc))
    return [wishes.plan(kind, pitch, disc, ahead) for _room, pitch, disc in sorted(found)[:MOST_SIZES]]


def _trial(wishes: Wishes, kind: Kind, pitch: float, disc: float, ahead: float) -> Plan:
    """A plan of benches with their room and no square, for searches of sizes."""
    plan = wishes.plan(kind, pitch, disc, ahead).without_square()
    data = plan.data()
    # Building reports errors in the village's benches.
    wide = with_people(plan.dragon.build(), plan.people).sizes.tolist()
    sizes = [{name: row[n] for name, row in zip(SIZES, wide, strict=True)} for n in range(2)]
    data["dragon"] = {"bench": [sizes[0], sizes[1] | {"count": wishes.benches - 1}]}
    data["limits"]["margin"] = wishes.between
    if kind == "spiral-in":
        data["route"]["start_turn"] = disc / pitch + 6.0
    del data["people"]
    return checked(data, NAME)


def _pitch(wishes: Wishes, kind: Kind, first: float, disc: float, ahead: float) -> float:
    """The smallest pitch beside a disc, rounded up, m; 0 if every one serves, inf if none was found."""
    try:
        trial = _trial(wishes, kind, 1.25 * first, disc, ahead)
        if kind == "spiral-in" and _touches(trial.with_value("route.pitch", WIDE * first)):
            return math.inf  # the search would go on to pitches a hundred times as large
        found = found_limit(trial, "pitch", tolerance=0.1 * SIZE_STEP)
    except (PlanError, WalkError, UnsureError):
        return math.inf
    if found.status == "unlimited":
        return 0.0
    return rounded_up(found.upper, SIZE_STEP) if found.status == "found" else math.inf


def _touches(plan: Plan) -> bool:
    walk = plan.build()
    start, end = plan.span(walk)
    return first_sure_contact(walk, start, end, margin=plan.limits.margin) is not None


def _placed(wishes: Wishes, sized: Plan, rounds: float) -> _Dance | None:
    """The dance begun so many rounds out at its roomiest pose; None if it cannot walk.

    Where that is at the speed wished decides whether it fits; only then the speed that its handles
    allow is sought, which takes as long, and at another one it is placed again.
    """
    try:
        begun = _begun(sized, rounds)
        dance = _roomiest(wishes, begun)
        if dance.room < 0.0:
            return dance
        speed = _speed(wishes, begun)
        if speed == sized.walk.speed:
            return dance
        return _roomiest(wishes, _begun(sized.with_value("walk.speed", speed), rounds))
    except (WalkError, UnsureError, PlanError):
        return None


def _roomiest(wishes: Wishes, plan: Plan) -> _Dance:
    """A dance at its roomiest pose; with no room where it is larger than the square."""
    square = Square(plan)
    if not _may_fit(square, wishes):
        return _Dance(square, plan, -math.inf)
    pose = square.roomiest(silent)
    return _Dance(square, square.at(pose), square.room(pose) - SPARE)


def _never_fits(
    wishes: Wishes, kind: Kind, pitch: float, disc: float, ahead: float, rounds: float
) -> bool:
    """Whether a dance is too large for the square at a pitch, and so, it is taken, at larger ones."""
    plan = wishes.plan(kind, pitch, disc, ahead)
    try:
        return not _may_fit(Square(_begun(plan, rounds)), wishes)
    except (WalkError, UnsureError, PlanError):
        return False


def _may_fit(square: Square, wishes: Wishes) -> bool:
    """Whether the dance may keep its margin within a round square, or the box about another."""
    kept = square.venue.margin
    if wishes.radius is not None:  # the circle found is a thousandth wider than the smallest at most
        return 0.999 * square.circle()[2] <= wishes.radius - kept
    box = [max(side) - min(side) for side in zip(*wishes.corners, strict=True)]
    more = math.hypot(*box) * math.pi / (2.0 * ANGLES) - 2.0 * kept  # half a degree adds less
    for angle in range(ANGLES):  # the first will do
        left, right, low, high = square.extent(float(angle))
        if right - left <= max(box) + more and high - low <= min(box) + more:
            return True
    return False


def _speed(wishes: Wishes, plan: Plan) -> float:
    """The head speed with which no handle of a dance is faster than a bench can be carried, m/s."""
    most = min(greatest_head_speed(plan).lower, wishes.speed)
    return rounded_down(most, SPEED_STEP) or rounded_down(most, 1e-3)


def _led(wishes: Wishes, plan: Plan) -> Plan | None:
    """The dance with the street before it, begun there; None where that does not lead to it."""
    try:
        led = plan.with_values({"route.street": wishes.street, "walk.start": None, "walk.end": None})
        return led.with_value("walk.speed", _speed(wishes, led))
    except (WalkError, UnsureError, PlanError):
        return None


def _walked(wishes: Wishes, plan: Plan) -> Proposal | None:
    """The proposal, if the plan passes the check, room for people included; None if not."""
    if wishes.rounds > AGAIN:
        plan = plan.with_values({"route.rounds": wishes.rounds, "walk.end": None})
        _start, end = plan.span(plan.build())
        plan = plan.with_value("walk.end", rounded_up(end, 1.0))
    led = plan if wishes.street is None else _led(wishes, plan)
    return None if led is None else _passing(wishes, led)


def _passing(wishes: Wishes, plan: Plan) -> Proposal | None:
    """The proposal, if the plan passes the check."""
    walk = plan.build()
    report = judged(plan, walk, plan.span(walk))
    return Proposal(plan, report, plan.walk.speed < wishes.speed) if report.safe else None


def _too_small(wishes: Wishes, dance: _Dance, under: bool) -> TooSmall:
    """How much room a dance takes, and how many benches would fit."""
    extents = [dance.square.extent(float(angle)) for angle in range(ANGLES)]
    sides = [sorted((x[1] - x[0], x[3] - x[2]), reverse=True) for x in extents]
    kept = 2.0 * (VENUE_MARGIN + wishes.stray + SPARE + 0.01)  # rounding of the place
    long, short = min(sides, key=lambda pair: (pair[0] + kept) * (pair[1] + kept))
    radius = (dance.radius + 0.5 * kept) / math.cos(math.pi / CORNERS)
    kind: Kind = "turn" if dance.plan.route.kind == "turn" else "spiral-in"
    rectangle = rounded_up(long + kept, SIZE_STEP), rounded_up(short + kept, SIZE_STEP)
    return TooSmall(kind, rectangle, rounded_up(radius, SIZE_STEP), _fitting(wishes, kind), under)


def _fitting(wishes: Wishes, kind: Kind) -> int:
    """How many benches of a kind of dance fit on the square, by halving; 0 if none were found to."""
    sizes = _sized(wishes, kind, AHEAD[-1])
    fits, not_fit = 1, wishes.benches
    while not_fit - fits > 1:
        middle = (fits + not_fit) // 2
        if _fewer(wishes, kind, sizes, middle) is None:
            not_fit = middle
        else:
            fits = middle
    found = _fewer(wishes, kind, sizes, fits) if fits > 1 else None
    return 0 if found is None or _walked(wishes, found) is None else fits


def _fewer(wishes: Wishes, kind: Kind, sizes: Sequence[Plan], benches: int) -> Plan | None:
    """The dance of fewer benches on the square, in the first of these sizes with which it fits."""
    fewer = replace(wishes, benches=benches)
    for one in sizes:
        pitch, disc = one.value("route.pitch"), one.value("disc.radius")
        sized = fewer.plan(kind, pitch, disc, one.people.ahead)
        dance = _placed(fewer, sized, ROUNDS[kind][-1])
        if dance is not None and dance.room >= 0.0:
            return dance.plan
    return None
