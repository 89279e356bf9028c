"""People are not exact: how likely benches touch when handles stray, pins have play, benches vary.

The paper assumes that nothing of this happens (its assumptions 1 to 4). Here each is dropped, one at
a time or all together: many dances are drawn at random, and each is walked. All benches stay rigid and
joined; the dances of one seed are the same for all sizes of a plan, so that a size can be sought.
"""

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.stats import beta, binom

from benchdragon.dragon import Dragon
from benchdragon.errors import InputError, UnsureError, in_order, not_negative
from benchdragon.kernels.box import least_distance
from benchdragon.kernels.chain import march
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import positions
from benchdragon.kernels.sway import sway
from benchdragon.messages import N_, _
from benchdragon.motion import Walk
from benchdragon.plan import Plan
from benchdragon.solve import limit

# Looks along the walk, m apart: within its last so many metres, where a spiral is tightest, and before.
# A graze between two looks is missed by less than 1 mm (design/imprecision.py).
LOOK_STEPS, LAST_WAY = (1.0, 2.0), 60.0
# A trodden line strays smoothly: places d apart are correlated by exp(-d^2 / (2 STRAY_LENGTH^2)), m;
# entries of its table in that length.
STRAY_LENGTH, STRAY_ENTRIES = 10.0, 20
# Pitches are sought to this, m, by at most so many secants, whose slopes (m of distance per m of pitch)
# are kept within bounds: near 1 on a spiral.
TOLERANCE, MOST_SECANTS, LEAST_SLOPE, MOST_SLOPE = 5e-5, 30, 0.5, 3.0
# What a pitch may come to be, times the one that exact people need.
NARROWEST, WIDEST = 0.7, 4.0
MOST_DRAWS = 100_000
# Limits of one dance: handles times looks (40 bytes each, in every thread), and pairs times looks
# (some ten seconds).
MOST_PLACES, MOST_PAIRS = 5_000_000, 1e10
CONFIDENCE = 0.95
# Chances of touching for which a pitch is told.
RISKS = (0.5, 0.1, 0.05, 0.02)

Advance = Callable[[float], None]


@dataclass(frozen=True)
class Slips:
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
        for field in fields(self):
            if not_negative(field.name, getattr(self, field.name), "m") > 1.0:
                raise InputError(_("{name} must be at most 1 m").format(name=field.name))


@dataclass(frozen=True)
class Case:
    """One of the paper's assumptions dropped, in words, and by how much."""

    text: str
    slips: Slips


# What a practised troupe may keep to. The last drops all at once.
CASES = {
    "aside": Case(N_("1: each handle up to some centimetres off the line"), Slips(aside=0.02)),
    "play": Case(N_("2: pins with play, benches pulled or pushed"), Slips(play=0.01)),
    "stray": Case(N_("3: the trodden spiral drifts"), Slips(stray=0.02)),
    "height": Case(N_("4: handles at different heights"), Slips(height=0.1)),
    "benches": Case(N_("benches that vary"), Slips(length=0.02, width=0.005)),
    "all": Case(N_("all of these"), Slips(0.02, 0.02, 0.01, 0.1, 0.02, 0.005)),
}


@dataclass(frozen=True)
class Draw:
    """One dance drawn at random: what is added to the plan's sizes and places, m."""

    slips: Slips
    seed: int
    number: int

    def noise(self, part: int, count: int) -> FloatArray:
        """Standard normal numbers, the same for the same draw and part, however many are asked for."""
        return np.random.default_rng((self.seed, self.number, part)).standard_normal(count)

    def dragon(self, plain: Dragon) -> Dragon:
        """The benches of this dance, seen from above."""
        slips, n = self.slips, len(plain)
        length = plain.length + slips.length * self.noise(0, n)
        width = plain.width + slips.width * self.noise(1, n)
        link = length - plain.front_inset - plain.rear_inset
        height = slips.height * self.noise(3, n)
        level = np.sqrt(np.maximum(link * link - height * height, 0.0)) - link
        # Pins with play move the benches, not their edges: the rear inset takes it up.
        longer = slips.play * self.noise(2, n) + level
        try:
            return Dragon.of_sizes(length, width, plain.front_inset, plain.rear_inset - longer)
        except InputError as error:
            raise InputError(
                _("dance {number} has a bench that cannot be: {why}; make the slips smaller").format(
                    number=self.number + 1, why=error
                )
            ) from None

    def lane(self, way: float) -> tuple[FloatArray, float]:
        """How far aside the trodden line lies, m, from the end of `way` (m) back, and its step, m."""
        step = STRAY_LENGTH / STRAY_ENTRIES
        if not self.slips.stray:
            return np.zeros(2), step
        # A Gaussian filter of spread w leaves noise a deviation of (4 pi w^2)^(-1/4).
        spread, edge = STRAY_ENTRIES / math.sqrt(2.0), 4 * STRAY_ENTRIES
        rough = self.noise(5, math.ceil(way / step) + 2 * edge)
        smooth = gaussian_filter1d(rough, spread)[edge : -edge + 2]
        return self.slips.stray * smooth * (4.0 * math.pi * spread**2) ** 0.25, step


def least_clearance(plan: Plan, draw: Draw, steps: tuple[float, float] = LOOK_STEPS) -> float:
    """The least distance of benches but neighbours in one dance, m; minus the depth of an overlap.

    Looked for along the whole walk of the plan, each so many metres: towards its end, and before.

    Raises:
        WalkError: where a drawn dragon cannot stand.
    """
    walk = plan.build()
    dragon = draw.dragon(walk.dragon)
    times = plan.span(walk)
    in_order(*times)
    start, end = walk.head_position(list(times)).tolist()
    # A spiral is tightest at its inner end; elsewhere that is not known.
    border = max(start, end - LAST_WAY) if plan.route.kind == "spiral-in" else start
    near, far = steps
    s = np.append(
        np.arange(start, border, far), np.linspace(border, end, 2 + int((end - border) / near))
    )
    shape = (len(dragon) + 1, s.size)
    if shape[0] * shape[1] > MOST_PLACES or 0.5 * shape[0] ** 2 * shape[1] > MOST_PAIRS:
        raise InputError(_("the walk is too long, or the dragon, for random dances"))
    row, failed = np.empty(shape, dtype=np.int64), np.empty((2, s.size), dtype=np.int64)
    u, x, y, ratio = (np.empty(shape) for _array in range(4))
    march(walk.route.rows, dragon.links, s, 0, s.size, row, u, x, y, ratio, failed)
    if failed[0].any():
        Walk(dragon, walk.route).motion(s)  # raises, in words
    slips = draw.slips
    if slips.aside or slips.stray:
        at = np.empty(row.size)
        positions(walk.route.rows, row.ravel(), u.ravel(), at)
        at, end = at.reshape(shape), float(s[-1])
        lane, lane_step = draw.lane(end - float(at.min()) + STRAY_LENGTH)
        aside = slips.aside * draw.noise(4, shape[0])
        sway(walk.route.rows, dragon.links, at, end, aside, lane, lane_step, x, y)
    return float(least_distance(dragon.sizes, x, y))


@dataclass(frozen=True)
class Margins:
    """What dances drawn at random need: for each the smallest pitch with which it stays clear.

    Attributes:
        slips: how far from exact they are.
        seed: of the draws.
        exact: the smallest pitch without slips, m.
        needed: m, in increasing order, (draws,).
    """

    slips: Slips
    seed: int
    exact: float
    needed: FloatArray

    def touching(self, pitch: float, confidence: float = CONFIDENCE) -> tuple[float, float, float]:
        """Share of the dances that touch at a pitch (m), and bounds of the probability.

        The bounds are those of Clopper and Pearson: they hold with at least that confidence.
        """
        count = self.needed.size
        hits = count - int(np.searchsorted(self.needed, pitch, side="right"))
        tail = 0.5 * (1.0 - confidence)
        low = float(beta.ppf(tail, hits, count - hits + 1)) if hits else 0.0
        high = float(beta.ppf(1.0 - tail, hits + 1, count - hits)) if hits < count else 1.0
        return hits / count, low, high

    def pitch_for(self, risk: float, confidence: float = CONFIDENCE) -> float:
        """A pitch, m, at which the dance touches with at most that probability, with that confidence.

        It is one of the pitches needed: the bound on a quantile that holds for any distribution.
        Infinite where the draws are too few to say.
        """
        count = self.needed.size
        chance = binom.cdf(np.arange(count), count, risk)
        allowed = int(np.searchsorted(chance, 1.0 - confidence, side="right")) - 1
        if allowed < 0:
            return math.inf
        return float(self.needed[count - 1 - allowed])


def margins(
    plan: Plan,
    slips: Slips,
    draws: int = 200,
    *,
    seed: int = 1,
    workers: int = 1,
    advance: Advance | None = None,
) -> Margins:
    """The smallest pitch that each of so many random dances needs: see `Margins`.

    The numbers do not depend on `workers`. A dance's pitch is the root of its least distance less the
    plan's margin; that it stays clear with larger ones is taken for granted.

    Args:
        plan: the dance; its pitch is where the search begins.
        slips: how far from exact.
        draws: dances, 1 to 100,000.
        seed: of the random numbers.
        workers: threads.
        advance: is told the share done since it was last told.

    Raises:
        InputError: for a number of draws out of range, a plan without a pitch, or one of whose
            dragon no benches can touch.
        WalkError: where a dance cannot stand.
        UnsureError: where no pitch was found.
    """
    if not 1 <= draws <= MOST_DRAWS:
        raise InputError(
            _("draws must be 1 to {most}, not {count}").format(most=MOST_DRAWS, count=draws)
        )
    exact = _exact_pitch(plan)
    tell = advance or (lambda _share: None)

    def one(number: int) -> float:
        needed = needed_pitch(plan, Draw(slips, seed, number), exact)
        tell(1.0 / draws)
        return needed

    with ThreadPoolExecutor(workers) as pool:
        needed = np.sort(list(pool.map(one, range(draws))))
    return Margins(slips, seed, exact, needed)


def _exact_pitch(plan: Plan) -> float:
    if plan.route.kind == "spiral-in" and plan.disc.radius is None and plan.walk.end is None:
        raise InputError(_("say how far in the head comes: set disc.radius=4.5, for example"))
    if len(plan.dragon.build()) < 3:
        raise InputError(_("no benches of this dragon can touch: it has no two but neighbours"))
    found = limit(plan, "pitch")
    if found.status in {"found", "unlimited"}:
        return found.value
    raise UnsureError(_("no pitch was found with which this dragon stays clear"))


def needed_pitch(
    plan: Plan, draw: Draw, guess: float, steps: tuple[float, float] = LOOK_STEPS
) -> float:
    """The pitch, m, with which a dance just keeps the plan's margin, by secants of slope 1 at first.

    Raises:
        UnsureError: where none is found near the guess.
    """
    margin = plan.limits.margin
    a, fa, b = guess, math.nan, guess
    clear, touching = (
        math.inf,
        0.0,
    )  # nearest pitches on either side; looks make distances jump a little
    for _step in range(MOST_SECANTS):
        if not NARROWEST * guess < b < WIDEST * guess:
            break
        fb = least_clearance(plan.with_value("route.pitch", b), draw, steps) - margin
        if fb < 0.0:
            touching, clear = max(touching, b), clear if b < clear else math.inf
        elif b > touching:
            clear = min(clear, b)
        if clear - touching <= TOLERANCE:
            return clear
        slope = 1.0 if math.isnan(fa) or b == a else (fb - fa) / (b - a)
        step = -fb / min(max(slope, LEAST_SLOPE), MOST_SLOPE)
        if abs(step) <= TOLERANCE:
            return b + step
        a, fa, b = b, fb, b + step
        if math.isfinite(clear) and touching and not touching < b < clear:
            b = 0.5 * (touching + clear)
    raise UnsureError(
        _("no pitch near {guess} m was found with which dance {number} just stays clear").format(
            guess=f"{guess:.4g}", number=draw.number + 1
        )
    )
