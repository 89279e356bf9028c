"""The search for a size, in worlds of made-up pairs whose distances are functions of the size."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
import pytest

from benchdragon.kernels import size_bracket as bracket
from benchdragon.kernels import size_search as search
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.size_bracket import Bracket, SizeVerdict
from benchdragon.kernels.size_search import KnownMeeting, Meet, SizeGoal, SizePhase, SizeStep

Pair = Callable[[float], float]


@dataclass
class World:
    """Walks of sizes: pair n of benches comes as near as pairs[n] says, less the margin, m."""

    pairs: Sequence[Pair]
    walked: Callable[[float], bool] = lambda _size: True
    decided: Callable[[float], bool] = lambda _size: True
    blind: bool = False  # whether no low pairs are found beforehand
    off: list[float] = field(default_factory=list)  # by which roots are found too far on the safe side
    tried: list[float] = field(default_factory=list)
    state: FloatArray = field(default_factory=lambda: np.zeros(bracket.BRACKET_NUMBERS))
    meetings: FloatArray = field(
        default_factory=lambda: np.full((search.MEETINGS, 4), search.NO_MEETING)
    )

    def passes(self, size: float) -> bool:
        return self.walked(size) and all(pair(size) >= 0.0 for pair in self.pairs)

    def walk(self, size: float) -> float:
        self.tried.append(size)
        if self.off and self.state[Bracket.SHIFT] > 0.0:
            self.state[[Bracket.SIZE, Bracket.ROOT]] += self.off.pop()
        if not self.decided(size):
            return SizeVerdict.UNDECIDED
        if self.passes(size):
            return SizeVerdict.PASSES
        self.meetings[KnownMeeting.FAILED, Meet.FRONT] = search.NO_MEETING
        if self.walked(size):  # the first that meets
            n = next(n for n, pair in enumerate(self.pairs) if pair(size) < 0.0)
            self.meetings[KnownMeeting.FAILED] = 1.0 + n, 9.0 - n, n, n + 2
        return SizeVerdict.FAILS

    def low_pair(self, size: float) -> float:
        if self.blind or not self.walked(size) or not self.pairs:
            return math.inf
        least, n = min((pair(size), n) for n, pair in enumerate(self.pairs))
        self.meetings[KnownMeeting.GUIDE] = 1.0 + n, 9.0 - n, n, n + 2
        return least

    def distance(self, size: float) -> float:
        n = int(self.meetings[KnownMeeting.ROOTED, Meet.FRONT])
        return self.pairs[n](size) if self.walked(size) else math.nan

    def sought(
        self, size: float, sense: float = 1.0, border: float | None = None
    ) -> tuple[int, FloatArray]:
        """How a search from a size ends, and its state."""
        state = self.state
        state[[Bracket.SENSE, Bracket.TOLERANCE, Bracket.SLACK]] = sense, 1e-12, 1e-13
        state[[Bracket.CAUTION, Bracket.SIZE, Bracket.STAGE]] = (
            bracket.FIRST_CAUTION,
            size,
            SizeGoal.GROW,
        )
        if border is not None:
            state[[Bracket.GOOD, Bracket.BAD, Bracket.TRIED]] = size, border, 1.0
            state[[Bracket.SIZE, Bracket.STAGE]] = border, SizeGoal.BORDER
        doubts = np.empty(bracket.MOST_TRIALS + bracket.MOST_GROWTHS)
        tasks, value = (self.walk, self.low_pair, self.distance), 0.0
        for _task in range(2000):
            asked = search.next_task(state, doubts, self.meetings, value)
            if asked >= len(tasks):
                return asked, state
            value = tasks[asked](float(state[Bracket.NOW]))
        raise AssertionError("it goes on and on")


ONE: tuple[Pair, ...] = (lambda size: math.tanh(size - 0.7),)
# The pair that is nearest far out is not the one that decides.
TWO: tuple[Pair, ...] = (lambda size: 0.05 * (size - 0.3), lambda size: 2.0 * (size - 0.7))
# The one that meets first is not the deepest, and a third is hidden behind both roots.
THREE: tuple[Pair, ...] = (
    lambda size: size - 0.52,
    lambda size: 3.0 * (size - 0.55),
    lambda size: 0.4 * (size - 0.7) if size < 0.71 else 0.3,
)


@pytest.mark.parametrize("blind", [False, True])
@pytest.mark.parametrize("pairs", [ONE, TWO, THREE])
@pytest.mark.parametrize("first", [0.9, 0.45, 5.0])
def test_the_limit_is_where_the_deciding_pair_just_keeps_apart(
    pairs: tuple[Pair, ...], first: float, blind: bool
) -> None:
    world = World(pairs, blind=blind)
    ending, state = world.sought(first)
    assert ending == SizeStep.FOUND
    assert state[Bracket.BAD] < state[Bracket.GOOD] <= state[Bracket.BAD] + 2e-12
    assert world.passes(state[Bracket.GOOD])
    assert not world.passes(state[Bracket.BAD])
    assert abs(state[Bracket.VALUE] - 0.7) <= 2e-12
    assert len(world.tried) < 40
    decides = int(world.meetings[KnownMeeting.GUIDE, Meet.FRONT])
    assert decides == search.NO_MEETING or pairs[decides](state[Bracket.BAD]) < 0.0
    assert blind or decides != search.NO_MEETING


def test_the_pair_that_decides_met_in_the_last_walk_that_failed() -> None:
    """Not the one gone by: here another one closes the bracket."""
    world = World(ONE)
    state, doubts = world.state, np.empty(0)
    state[[Bracket.SENSE, Bracket.TOLERANCE, Bracket.STAGE]] = 1.0, 1e-12, SizeGoal.NARROW
    state[[Bracket.GOOD, Bracket.SIZE, Bracket.PHASE]] = 0.7 + 1e-13, 0.7, SizePhase.AFTER_WALK
    world.meetings[KnownMeeting.GUIDE] = 3.0, 1.0, 2, 4
    world.meetings[KnownMeeting.FAILED] = 1.0, 2.0, 5, 9
    assert search.next_task(state, doubts, world.meetings, SizeVerdict.FAILS) == SizeStep.FOUND
    assert world.meetings[KnownMeeting.GUIDE].tolist() == [1.0, 2.0, 5, 9]


def test_a_root_costs_few_walks_and_a_search_without_pairs_many() -> None:
    near, far = World(ONE), World((), walked=lambda size: size >= 0.7)
    assert near.sought(0.75)[0] == far.sought(0.9)[0] == SizeStep.FOUND
    assert len(near.tried) == 2
    assert 30 < len(far.tried) < bracket.MOST_TRIALS


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 0.75])
def test_a_root_that_rounding_hides_costs_as_few_walks(share: float) -> None:
    """No step of the secant method comes nearer than distances are told."""
    world = World([lambda size: 2e-14 * (math.floor((size - 0.7) / 4e-14 + share) + 0.5)])
    assert world.sought(0.75)[0] == SizeStep.FOUND
    assert len(world.tried) == 2


@pytest.mark.parametrize("least", [1e-3, 1e-14])
def test_distances_that_stay_the_same_lead_to_no_root(least: float) -> None:
    world = World([lambda size: math.copysign(least, size - 0.7)])
    assert world.sought(0.75)[0] == SizeStep.FOUND
    assert world.state[Bracket.VALUE] == pytest.approx(0.7, abs=1e-11)
    assert len(world.tried) > 30


def test_smaller_may_be_safer() -> None:
    for first in (0.9, 0.05, 0.71):
        world = World((lambda size: 0.7 - size,))
        ending, state = world.sought(first, -1.0)
        assert ending == SizeStep.FOUND
        assert state[Bracket.GOOD] < state[Bracket.BAD] <= state[Bracket.GOOD] + 2e-12
        assert abs(state[Bracket.VALUE] - 0.7) <= 2e-12


def test_where_all_that_is_tried_passes_there_is_no_limit_and_where_none_does_no_size() -> None:
    ending, state = World((lambda _size: 0.05,)).sought(0.9)
    assert (ending, state[Bracket.VALUE]) == (SizeStep.UNLIMITED, pytest.approx(0.009))
    world = World((lambda _size: -0.1,))
    assert world.sought(0.9)[0] == SizeStep.INFEASIBLE
    assert len(world.tried) == bracket.MOST_GROWTHS


def test_sizes_that_cannot_be_decided_bound_what_is_known() -> None:
    world = World(ONE, decided=lambda size: not 0.69 < size < 0.71)
    ending, state = world.sought(0.9)
    assert ending == SizeStep.FOUND
    assert state[Bracket.BAD] <= 0.69
    assert 0.71 <= state[Bracket.GOOD]
    assert state[Bracket.DOUBTS] > 0.0


def test_a_jump_is_narrowed_as_far_as_doubles_allow() -> None:
    """Above the jump the pair is far, below it deep inside: no root is met."""
    world = World((lambda size: 0.05 if size >= 0.7 else -0.05,))
    ending, state = world.sought(0.9)
    assert ending == SizeStep.FOUND
    assert state[Bracket.BAD] < 0.7 <= state[Bracket.GOOD] <= state[Bracket.BAD] + 1.1e-12


def test_a_border_is_sought_between_two_sizes() -> None:
    for world in (World(ONE), World(THREE), World((), walked=lambda size: size >= 0.7)):
        ending, state = world.sought(2.0, border=0.5)
        assert ending == SizeStep.FOUND
        assert world.tried[0] == 0.5
        assert abs(state[Bracket.GOOD] - 0.7) <= 2e-12
        assert world.passes(state[Bracket.GOOD])


def test_a_root_found_too_far_on_the_safe_side_ends_no_search() -> None:
    world = World(ONE, off=[1e-6, 1e-9])
    ending, state = world.sought(0.75)
    assert ending == SizeStep.FOUND
    assert not world.off
    assert not world.passes(state[Bracket.BAD])
    assert abs(state[Bracket.VALUE] - 0.7) <= 2e-12


def test_too_many_trials_end_a_search(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bracket, "MOST_TRIALS", 5)
    ending, state = World((), walked=lambda size: size >= 0.7).sought(0.9)
    assert ending == SizeStep.EXHAUSTED
    assert state[Bracket.GOOD] - state[Bracket.BAD] > 1e-3
