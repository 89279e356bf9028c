"""Monte Carlo model of imprecise people: probability of contact if handles, pins and benches deviate.

The paper assumes no such deviation (its assumptions 1 to 4). Here each assumption is relaxed, alone or
together: many random dances are drawn, and each is walked. All benches stay rigid and joined; the
dances of one seed are the same for all sizes of a plan, so that a size can be sought.
"""

import math
from collections.abc import Sequence
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchdragon import budget
from benchdragon.errors import (
    InputError,
    MachineError,
    UnsureError,
    WalkError,
    not_negative,
    of_kind,
    whole,
)
from benchdragon.i18n import N_, _
from benchdragon.kernels import binomial
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.random_dance_memory import DanceGiven, DanceSought
from benchdragon.kernels.random_numbers import draw_benches, draw_normals
from benchdragon.model.dragon import Dragon
from benchdragon.parallel import Lost, Place, in_blocks, place_of, threads
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.solve.random_dance import answered
from benchdragon.solve.size import found_limit

MOST_DRAWS, MOST_SEED = 100_000, 2**53 - 1
CONFIDENCE = 0.95
# Probabilities of contact for which a pitch is reported.
RISKS = (0.5, 0.1, 0.05, 0.02)


@dataclass(frozen=True)
class Deviations:
    """How far from exact a dance is: standard deviations, m; 0 keeps the paper's assumption.

    Attributes:
        aside: of each handle from the line that is walked, to either side, all along the walk.
        stray: of the line that is walked from the route, smooth over 10 m: a pitch that drifts. Places
            d apart are correlated by exp(-d^2 / (2 (10 m)^2)).
        play: of the distance of a bench's pins, which play and pull change.
        height: of the height of a handle over the one before, which shortens a bench seen from above.
        length: of the benches' lengths, holes and all.
        width: of their widths.

    Examples:
        >>> bd.Deviations(aside=0.02, stray=0.05)
        Deviations(aside=0.02, stray=0.05, play=0.0, height=0.0, length=0.0, width=0.0)
    """

    aside: float = 0.0
    stray: float = 0.0
    play: float = 0.0
    height: float = 0.0
    length: float = 0.0
    width: float = 0.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not_negative(name, value, "m") > 1.0:
                raise InputError(_("{name} must be at most 1 m").format(name=name))


@dataclass(frozen=True)
class Case:
    """One of the paper's assumptions dropped, in words, and by how much."""

    text: str
    deviations: Deviations


# What a practised troupe may keep to. The last drops all at once.
ALL = (0.02, 0.02, 0.01, 0.1, 0.02, 0.005)
CASES = {
    "aside": Case(N_("1: each handle some centimetres off the route"), Deviations(aside=0.02)),
    "play": Case(N_("2: pin play, benches pulled or pushed"), Deviations(play=0.01)),
    "stray": Case(N_("3: the spiral that is walked drifts"), Deviations(stray=0.02)),
    "height": Case(N_("4: handles at different heights"), Deviations(height=0.1)),
    "benches": Case(N_("benches that vary"), Deviations(length=0.02, width=0.005)),
    "all": Case(N_("all of these"), Deviations(*ALL)),
}


@dataclass(frozen=True)
class Draw:
    """One dance drawn at random: what is added to the plan's sizes and places, m."""

    deviations: Deviations
    seed: int
    number: int

    def __post_init__(self) -> None:
        whole("seed", self.seed, 0, MOST_SEED)

    def noise(self, part: int, count: int) -> FloatArray:
        """Standard normal numbers, the same for the same draw and part, however many are asked for.

        Parts are those of kernels/random_numbers.py.
        """
        numbers = np.empty(count)
        draw_normals(self.seed, self.number, part, numbers)
        return numbers

    def dragon(self, plain: Dragon) -> Dragon:
        """The benches of this dance, seen from above."""
        sizes = np.empty((4, len(plain)))
        draw_benches(self.seed, self.number, np.array(self._by), plain.sizes, sizes, np.empty(0))
        return Dragon.of_sizes(*sizes)

    @property
    def _by(self) -> list[float]:
        return list(vars(self.deviations).values())

    def ask(self, plan: Plan, what: int, guess: float = math.nan) -> float:
        """What kernels/random_dance_question.py answers about this dance of a plan: see `answered`."""
        limits = {
            DanceGiven.WHAT: what, DanceGiven.GUESS: guess, DanceGiven.SEED: self.seed,
            DanceGiven.DANCE: self.number,
            **dict(enumerate(self._by, DanceGiven.BY)),
        }  # fmt: skip
        return answered(plan, limits)


@budget.question()
def touches(plan: Plan, draw: Draw) -> bool:
    """Whether benches of one dance come nearer than the plan's margin, or one cannot follow.

    No contact is missed; a pair within 1e-7 m of the margin counts.
    """
    try:
        return draw.ask(plan, DanceSought.TOUCHES) > 0.0
    except WalkError:
        return True


@budget.question()
def needed_pitch(plan: Plan, draw: Draw, guess: float) -> float:
    """The pitch, m, next to which a dance stops keeping the plan's margin, sought from a guess.

    With that pitch no pair comes nearer than the margin; with one smaller by 1e-5 m some pair does,
    or a bench cannot follow. Pitches beyond are not tried.

    Raises:
        UnsureError: where none is found near the guess.
    """
    return draw.ask(plan.with_value("route.pitch", guess), DanceSought.NEEDED, guess)


def chance(hits: int, count: int, confidence: float = CONFIDENCE) -> tuple[float, float, float]:
    """Share of `count` trials that hit, and the bounds of the probability by Clopper and Pearson.

    They hold with at least that confidence, whatever the probability and the number of trials.
    """
    return hits / count, *binomial.chance_bounds(hits, count, confidence)


@dataclass(frozen=True)
class Tolerance:
    """What dances drawn at random need: for each the smallest pitch with which it stays clear.

    Attributes:
        deviations: how far from exact they are.
        seed: of the draws.
        exact: the smallest pitch without deviations, m.
        needed: m, in increasing order, (draws,).
        hits: dances that touch at the plan's own pitch; None if they were not walked at it.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"disc.radius": 4.5, "dragon.benches": 20})
        >>> found = plan.tolerance(bd.Deviations(0.01), 2, executor=threads)
        >>> bool((found.needed >= found.exact).all())
        True
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
        count = len(self.needed)
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
        count = len(self.needed)
        allowed, _least = binomial.ranks(count, risk, confidence)
        return float(self.needed[count - 1 - allowed]) if allowed >= 0 else math.inf

    def pitch_from(self, risk: float, confidence: float = CONFIDENCE) -> float:
        """A pitch, m, at which the dance touches with at least that probability, with that confidence.

        The other end of the bracket that `pitch_for` closes; 0 where the draws are too few to say.
        """
        count = self.needed.size
        _most, least = binomial.ranks(count, risk, confidence)
        return float(self.needed[count - 1 - least]) if least < count else 0.0


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
        progress: is called after each dance.

    Raises:
        InputError: for a number of draws out of range, a plan without a pitch, or one of whose
            dragon no benches can touch.
        UnsureError: where no pitch was found.
        MachineError: for a dance whose workers were lost.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"disc.radius": 4.5, "dragon.benches": 20})
        >>> len(bd.tolerance(plan, bd.Deviations(0.01), 2, executor=threads).needed)
        2
    """
    of_kind("plan", plan, Plan)
    of_kind("deviations", deviations, Deviations)
    whole("draws", draws, 1, MOST_DRAWS)
    exact = exact_pitch(plan)
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


def exact_pitch(plan: Plan, progress: Progress = silent) -> float:
    """The pitch next to which exact people touch, m: the first from which the others are sought.

    Raises:
        InputError: for a plan without a pitch, or one of whose dragon no benches can touch.
        UnsureError: where there is none.
    """
    if plan.route.kind == "spiral-in" and plan.disc.radius is None and plan.walk.end is None:
        raise InputError(_("say how far in the head comes: set disc.radius=4.5, for example"))
    if len(plan.dragon.build()) < 3:
        raise InputError(_("no benches of this dragon can touch: no two are non-adjacent"))
    found = found_limit(plan.without_square(), "pitch", progress=progress)
    if found.status in {"found", "unlimited"}:
        return found.value
    raise UnsureError(_("no pitch was found with which this dragon is free of contact"))
