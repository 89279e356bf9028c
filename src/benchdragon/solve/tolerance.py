"""People are not exact: how likely benches touch when handles stray, pins have play, benches vary.

The paper assumes that nothing of this happens (its assumptions 1 to 4). Here each is dropped, one at
a time or all together: many dances are drawn at random, and each is walked. All benches stay rigid and
joined; the dances of one seed are the same for all sizes of a plan, so that a size can be sought.
"""

import math
from collections.abc import Sequence
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass, field, fields
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from benchdragon import budget
from benchdragon.errors import (
    InputError,
    MachineError,
    UnsureError,
    WalkError,
    in_order,
    not_negative,
    of_kind,
    whole,
)
from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.dragon import Dragon
from benchdragon.parallel import Lost, Place, in_blocks, place_of, threads
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.solve.dance_bound import WAYS, Offset, Part, open_parts
from benchdragon.solve.random_dance import GRAZE, NODE, CannotFollowError, Hint, RandomDance, strayed
from benchdragon.solve.size import limit

# A trodden line strays smoothly: places d apart are correlated by exp(-d^2 / (2 STRAY_LENGTH^2)), m;
# entries of its table in that length.
STRAY_LENGTH, STRAY_ENTRIES = 10.0, 20
# Pitches are sought to this, m, by at most so many trials, along secants whose slopes (m of distance
# per m of pitch) are kept within bounds: near 1 on a spiral. A pitch with which a bench cannot follow
# is multiplied by UNWALKABLE; no trial is farther from the last one than this share of it.
TOLERANCE, MOST_TRIALS, LEAST_SLOPE, MOST_SLOPE, UNWALKABLE = 1e-5, 60, 0.5, 3.0, 1.01
LONGEST_STEP = 0.1
# What a pitch may come to be, times the one that exact people need.
NARROWEST, WIDEST = 0.7, 4.0
# Offsets from the route want about so many times their standard deviation more of a pitch.
LIKELY = 2.0
MOST_DRAWS = 100_000
CONFIDENCE = 0.95
# Chances of touching for which a pitch is told.
RISKS = (0.5, 0.1, 0.05, 0.02)


@dataclass(frozen=True)
class Deviations:
    """How far from exact a dance is: standard deviations, m; 0 keeps the paper's assumption.

    Attributes:
        aside: of each handle from the trodden line, to either side, all along the walk.
        stray: of the trodden line from the drawn one, smooth over `STRAY_LENGTH`: a pitch that drifts.
        play: of the distance of a bench's pins, which play and pull change.
        height: of the height of a handle over the one before, which shortens a bench seen from above.
        length: of the benches' lengths, holes and all.
        width: of their widths.
    """

    aside: float = 0.0
    stray: float = 0.0
    play: float = 0.0
    height: float = 0.0
    length: float = 0.0
    width: float = 0.0

    def __post_init__(self) -> None:
        for deviation in fields(self):
            if not_negative(deviation.name, getattr(self, deviation.name), "m") > 1.0:
                raise InputError(_("{name} must be at most 1 m").format(name=deviation.name))


@dataclass(frozen=True)
class Case:
    """One of the paper's assumptions dropped, in words, and by how much."""

    text: str
    deviations: Deviations


# What a practised troupe may keep to. The last drops all at once.
CASES = {
    "aside": Case(N_("1: each handle some centimetres off the route"), Deviations(aside=0.02)),
    "play": Case(N_("2: pin play, benches pulled or pushed"), Deviations(play=0.01)),
    "stray": Case(N_("3: the spiral that is walked drifts"), Deviations(stray=0.02)),
    "height": Case(N_("4: handles at different heights"), Deviations(height=0.1)),
    "benches": Case(N_("benches that vary"), Deviations(length=0.02, width=0.005)),
    "all": Case(N_("all of these"), Deviations(0.02, 0.02, 0.01, 0.1, 0.02, 0.005)),
}


@dataclass(frozen=True)
class Draw:
    """One dance drawn at random: what is added to the plan's sizes and places, m."""

    deviations: Deviations
    seed: int
    number: int

    def noise(self, part: int, count: int) -> FloatArray:
        """Standard normal numbers, the same for the same draw and part, however many are asked for.

        Their stream is that of a seed sequence's spawned child `number`, and of its child `part`.
        """
        stream = np.random.SeedSequence(self.seed, spawn_key=(self.number, part))
        return np.random.default_rng(stream).standard_normal(count)

    def dragon(self, plain: Dragon) -> Dragon:
        """The benches of this dance, seen from above."""
        deviations, n = self.deviations, len(plain)
        length = plain.length + deviations.length * self.noise(0, n)
        width = plain.width + deviations.width * self.noise(1, n)
        link = length - plain.front_inset - plain.rear_inset
        height = deviations.height * self.noise(3, n)
        level = np.sqrt(np.maximum(link * link - height * height, 0.0)) - link
        # Pins with play move the benches, not their edges: the rear inset takes it up.
        longer = deviations.play * self.noise(2, n) + level
        try:
            return Dragon.of_sizes(length, width, plain.front_inset, plain.rear_inset - longer)
        except InputError as error:
            raise InputError(
                _(
                    "dance {number} has a bench that cannot be: {why}; make the deviations smaller"
                ).format(number=self.number + 1, why=error)
            ) from None

    def offsets(self, way: float) -> tuple[FloatArray, float]:
        """How far aside the trodden line lies, m, from the end of `way` (m) back, and its step, m."""
        from scipy.ndimage import gaussian_filter1d  # slow to import, as all of scipy below

        step = STRAY_LENGTH / STRAY_ENTRIES
        if not self.deviations.stray:
            return np.zeros(2), step
        budget.hold(NODE * way / step)
        # A Gaussian filter of spread w leaves noise a deviation of (4 pi w^2)^(-1/4).
        spread, edge = STRAY_ENTRIES / math.sqrt(2.0), 4 * STRAY_ENTRIES
        rough = self.noise(5, math.ceil(way / step) + 2 * edge)
        smooth = gaussian_filter1d(rough, spread)[edge : -edge + 2]
        return self.deviations.stray * smooth * (4.0 * math.pi * spread**2) ** 0.25, step

    def offset(self, low: float, end: float) -> Offset:
        """The same as a smooth function of route position from `low` to `end`, m, with its slope."""
        from scipy.interpolate import CubicSpline

        offsets, step = self.offsets(end - low)
        curve = CubicSpline(step * np.arange(offsets.size), offsets)
        return lambda s: (curve(end - s), -curve(end - s, 1))


def random_dance(plan: Plan, draw: Draw) -> RandomDance:
    """One dance of a plan, drawn at random, from the start of its walk to the end.

    Raises:
        WalkError: where the exact dragon cannot stand at the start.
    """
    walk = plan.build()
    dragon = draw.dragon(walk.dragon)
    times = plan.span(walk)
    in_order(*times)
    start, end = walk.head_position(list(times)).tolist()
    span = start, end
    deviations, rows = draw.deviations, walk.route.rows
    offset: Offset | None = None
    beside = deviations.aside or deviations.stray
    aside = deviations.aside * draw.noise(4, len(dragon) + 1) if beside else np.empty(0)
    if deviations.stray:
        low = start - WAYS * float(dragon.links.sum()) - STRAY_LENGTH
        offset = draw.offset(low, end)
    drawn = along = np.array(span)
    if offset is not None:
        rows, drawn, along = strayed(walk.route, offset, low, end)
        start, end = np.interp(span, drawn, along).tolist()

    @cache
    def open_(wanted: float) -> tuple[Part, ...]:
        parts = open_parts(walk.route, dragon, aside, offset, span, wanted)
        return tuple(part.mapped(lambda s: float(np.interp(s, drawn, along))) for part in parts)

    return RandomDance(dragon, rows, aside, start, end, open_)


@budget.question()
def least_clearance(plan: Plan, draw: Draw) -> float:
    """The least distance of non-adjacent benches in one dance, m; minus the depth of an overlap.

    See `RandomDance.least`.

    Raises:
        WalkError: where the exact dragon cannot stand at the start.
        CannotFollowError: where the drawn one cannot walk.
    """
    return random_dance(plan, draw).least()


@budget.question()
def touches(plan: Plan, draw: Draw) -> bool:
    """Whether benches of one dance come nearer than the plan's margin, or one cannot follow.

    No contact is missed; a pair within 1e-7 m of the margin counts.
    """
    try:
        dance = random_dance(plan, draw)
        low = dance.low_meeting(plan.limits.margin).distance
        return low <= plan.limits.margin or dance.touch(plan.limits.margin) is not None
    except (WalkError, CannotFollowError):
        return True


def chance(hits: int, count: int, confidence: float = CONFIDENCE) -> tuple[float, float, float]:
    """Share of `count` trials that hit, and the bounds of the probability by Clopper and Pearson.

    They hold with at least that confidence, whatever the probability and the number of trials.
    """
    from scipy.special import betaincinv

    tail = 0.5 * (1.0 - confidence)
    low = float(betaincinv(hits, count - hits + 1, tail)) if hits else 0.0
    high = float(betaincinv(hits + 1, count - hits, 1.0 - tail)) if hits < count else 1.0
    return hits / count, low, high


def at_most(hits: int | npt.NDArray[np.int64], count: int, risk: float) -> Any:
    """Probability that so many of `count` trials hit or fewer, if each does with that one.

    Args:
        hits: fewer than `count`; of several, the probability of each.
        count: of trials.
        risk: that one of them hits.
    """
    from scipy.special import betaincc  # scipy.stats gives the same, and takes a second to import

    return betaincc(hits + 1, count - hits, risk)


def more_than(hits: int | npt.NDArray[np.int64], count: int, risk: float) -> Any:
    """Probability that more than so many hit: what `at_most` leaves, without cancellation."""
    from scipy.special import betainc

    return betainc(hits + 1, count - hits, risk)


@dataclass(frozen=True)
class Tolerance:
    """What dances drawn at random need: for each the smallest pitch with which it stays clear.

    Attributes:
        deviations: how far from exact they are.
        seed: of the draws.
        exact: the smallest pitch without deviations, m.
        needed: m, in increasing order, (draws,).
        hits: dances that touch at the plan's own pitch; None if they were not walked at it.
    """

    deviations: Deviations
    seed: int
    exact: float
    needed: FloatArray
    hits: int | None = None

    def touching(
        self, pitch: float | None = None, confidence: float = CONFIDENCE
    ) -> tuple[float, float, float]:
        """Share of the dances that touch at a pitch (m), and bounds of the probability.

        Those touch that need more; without a pitch, those that were found to touch at the plan's own.
        The bounds are those of Clopper and Pearson: they hold with at least that confidence.
        """
        count = self.needed.size
        if pitch is not None:
            hits = count - int(np.searchsorted(self.needed, pitch, side="right"))
        elif self.hits is not None:
            hits = self.hits
        else:
            raise InputError(_("the dances were not walked at the plan's own pitch"))
        return chance(hits, count, confidence)

    def pitch_for(self, risk: float, confidence: float = CONFIDENCE) -> float:
        """A pitch, m, at which the dance touches with at most that probability, with that confidence.

        It is one of the pitches needed: the bound on a quantile that holds for any distribution.
        Infinite where the draws are too few to say.
        """
        count = self.needed.size
        chance = at_most(np.arange(count), count, risk)
        allowed = int(np.searchsorted(chance, 1.0 - confidence, side="right")) - 1
        if allowed < 0:
            return math.inf
        return float(self.needed[count - 1 - allowed])

    def pitch_from(self, risk: float, confidence: float = CONFIDENCE) -> float:
        """A pitch, m, at which the dance touches with at least that probability, with that confidence.

        The other end of the bracket that `pitch_for` closes; 0 where the draws are too few to say.
        """
        count = self.needed.size
        chance = more_than(np.arange(count), count, risk)  # of more than 0, 1, ... dances
        more = int(np.searchsorted(-chance, confidence - 1.0)) + 1
        return float(self.needed[count - more]) if more <= count else 0.0


def tolerance(
    plan: Plan,
    deviations: Deviations,
    draws: int = 100,
    *,
    seed: int = 1,
    own: bool = False,
    executor: Executor | Place | None = None,
    progress: Progress = silent,
) -> Tolerance:
    """The pitch that each of so many random dances needs: see `Tolerance`.

    The numbers do not depend on where they are computed. Each pitch is one next to which the dance
    stops keeping the plan's margin, see `needed_pitch`, sought from the exact one, see `size.limit`.
    That the dance keeps it with all larger ones, so that pitches tell chances, is taken for granted.
    Benches alone are asked about: the venue and obstacles do not count.

    Args:
        plan: the dance; the exact pitch is sought from its own.
        deviations: how far from exact.
        draws: dances, 1 to 100,000.
        seed: of the random numbers.
        own: whether each dance is walked at the plan's own pitch, too.
        executor: that walks the dances, or a place of `parallel`; one thread, if there is none.
        progress: is told after each dance.

    Raises:
        InputError: for a number of draws out of range, a plan without a pitch, or one of whose
            dragon no benches can touch.
        UnsureError: where no pitch was found.
        MachineError: for a dance whose workers were lost.
    """
    of_kind("plan", plan, Plan)
    of_kind("deviations", deviations, Deviations)
    whole("draws", draws, 1, MOST_DRAWS)
    exact = _exact_pitch(plan)
    work = Dances(plan, deviations, seed, exact, own)
    needed, touching = walked(work, draws, place_of(executor, threads(1)), progress)
    hits = int(touching.sum()) if own else None
    return Tolerance(deviations, seed, exact, np.sort(needed), hits)


def walked(
    work: "Dances", draws: int, place: Place, progress: Progress = silent
) -> tuple[FloatArray, npt.NDArray[np.bool_]]:
    """The pitch that each dance needs, m, and whether it touches at the plan's own, in order, (draws,).

    Raises:
        UnsureError: where no pitch was found.
        MachineError: for a dance whose workers were lost.
    """
    needed, touching, done = np.empty(draws), np.empty(draws, dtype=bool), 0
    with closing(in_blocks(work, range(draws), place)) as blocks:
        for numbers, found in blocks:
            if isinstance(found, Lost):
                text = _("dance {number} was lost with its worker: {why}")
                raise MachineError(text.format(number=numbers[0] + 1, why=found.reason))
            at = list(numbers)
            needed[at], touching[at] = zip(*found, strict=True)
            done += len(at)
            progress(done / draws, "")
    return needed, touching


@dataclass(frozen=True)
class Dances:
    """The work of `tolerance`: what dances of some numbers need, m, and whether they touch.

    Attributes:
        plan: the dance.
        deviations: how far from exact.
        seed: of the random numbers.
        exact: the pitch from which to seek, m.
        own: whether each is walked at the plan's own pitch, too.
    """

    plan: Plan
    deviations: Deviations
    seed: int
    exact: float
    own: bool

    def __call__(self, numbers: Sequence[int]) -> list[tuple[float, bool]]:
        """A pitch, m, for each, and whether benches touch."""
        draws = [Draw(self.deviations, self.seed, number) for number in numbers]
        return [
            (needed_pitch(self.plan, draw, self.exact), self.own and touches(self.plan, draw))
            for draw in draws
        ]


def _exact_pitch(plan: Plan) -> float:
    if plan.route.kind == "spiral-in" and plan.disc.radius is None and plan.walk.end is None:
        raise InputError(_("say how far in the head comes: set disc.radius=4.5, for example"))
    if len(plan.dragon.build()) < 3:
        raise InputError(_("no benches of this dragon can touch: no two are non-adjacent"))
    found = limit(plan.without_square(), "pitch")
    if found.status in {"found", "unlimited"}:
        return found.value
    raise UnsureError(_("no pitch was found with which this dragon is free of contact"))


@dataclass
class Trials:
    """One dance, tried with several pitches.

    Attributes:
        plan: its other sizes, and the margin that benches must keep.
        draw: what is random in it.
        hints: where benches came nearest, or touched where they were not looked for.
    """

    plan: Plan
    draw: Draw
    hints: list[Hint] = field(default_factory=list)

    def room(self, pitch: float, *, sure: bool = False) -> float:
        """A low distance of benches less the margin, m; NaN where a bench cannot follow.

        Above TOLERANCE it is that of places evaluated here and there, unless it is to be `sure`. From 0
        to TOLERANCE no pair anywhere comes nearer than the margin; below 0 some pair does.
        """
        margin = self.plan.limits.margin
        try:
            dance = random_dance(self.plan.with_value("route.pitch", pitch), self.draw)
            known = [dance.meeting_near(hint) for hint in self.hints]
            if not known or min(known).distance >= margin:
                known.append(dance.low_meeting(margin))
            low = min(known)
            self.hints = [dance.hint(low), *self.hints[1:]]
            if low.distance < margin or not (sure or low.distance - margin <= TOLERANCE):
                return low.distance - margin
            place = dance.touch(margin)
            if place is None:
                return low.distance - margin
            self.hints.append(dance.hint(place))
            return min(dance.meeting_near(self.hints[-1]).distance - margin, -GRAZE)
        except (WalkError, CannotFollowError):
            return math.nan


@budget.question()
def needed_pitch(plan: Plan, draw: Draw, guess: float) -> float:
    """The pitch, m, next to which a dance stops keeping the plan's margin, sought from a guess.

    With that pitch no pair comes nearer than the margin; with one smaller by TOLERANCE some pair does,
    or a bench cannot follow. Pitches beyond are not tried.

    Raises:
        UnsureError: where none is found near the guess.
    """
    trials = Trials(plan, draw)
    touching, clear = 0.0, math.inf
    first = guess + LIKELY * math.hypot(draw.deviations.aside, draw.deviations.stray)
    a, fa, b, slope = first, math.nan, first, 1.0
    for _trial in range(MOST_TRIALS):
        if not NARROWEST * guess < b < WIDEST * guess:
            break
        # Lines that stray are drawn by arcs, whose number leaps with the pitch, and distances with it.
        sure = 0.0 < b - touching <= TOLERANCE
        fb = trials.room(b, sure=sure)
        if not fb >= 0.0:
            touching, clear = max(touching, b), clear if clear > b else math.inf
        elif (sure or fb <= TOLERANCE) and b > touching:
            clear = min(clear, b)
        if clear - touching <= TOLERANCE:
            return clear
        if math.isfinite(fb) and math.isfinite(fa) and b != a:
            slope = min(max((fb - fa) / (b - a), LEAST_SLOPE), MOST_SLOPE)
        a, fa, b = b, fb, _next(b, fb, slope, touching, clear)
    raise UnsureError(
        _("no pitch near {guess} m was found with which dance {number} is just free of contact").format(
            guess=f"{guess:.4g}", number=draw.number + 1
        )
    )


def _next(pitch: float, room: float, slope: float, touching: float, clear: float) -> float:
    """The pitch to try next, m: where the room would be half of TOLERANCE, or just not any more."""
    if math.isnan(room):
        ahead = UNWALKABLE * pitch
    elif clear < math.inf:
        ahead = clear - max(0.9 * TOLERANCE, room / slope)
    else:
        ahead = pitch + (0.5 * TOLERANCE - room) / slope
    # Where a bound clears most of a walk the distances seen are far from the least.
    ahead = min(max(ahead, (1.0 - LONGEST_STEP) * pitch), (1.0 + LONGEST_STEP) * pitch)
    between = touching < ahead < clear
    return ahead if between else 0.5 * (touching + min(clear, max(pitch, touching)))
