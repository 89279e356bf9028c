"""Sizes that doubles hold and nobody means: refused in a sentence, or answered with finite numbers."""

import contextlib
import math
import random
from collections.abc import Callable
from functools import partial

import pytest

from benchdragon import budget
from benchdragon.analysis.check import check
from benchdragon.errors import BenchDragonError, InputError, brief, finite, whole
from benchdragon.model.curves import Arc, Clothoid, Line, Spiral
from benchdragon.model.dragon import Dragon
from benchdragon.model.profile import SpeedProfile
from benchdragon.model.turns import Turn, TwoArcTurn, three_pieces, two_arcs
from benchdragon.plans.schema import checked
from benchdragon.solve.head_speed import greatest_head_speed, slowed

USUAL = 0.3, 1.0, 1.7, 2.0, 4.5, 10.0
ODD = (
    0.0, -0.0, 5e-324, 1e-320, 1e-308, 1e-300, 1e-155, 1e-20, 1e-6, 1e-3, 1e3, 1e8, 1e20, 1e77, 1e150,
    1e155, 1e200, 1.7e308, math.inf, math.nan, -1.0, -1e150, 10**400, -(10**400), 10**6000, 2**70,
)  # fmt: skip


def size(dice: random.Random) -> float:
    return dice.choice(USUAL if dice.random() < 0.7 else ODD)


TURNS: dict[str, Callable[[random.Random], TwoArcTurn | Turn]] = {
    "two arcs of the paper": lambda dice: TwoArcTurn(size(dice), size(dice), size(dice)),
    "two arcs": lambda dice: two_arcs(
        size(dice), size(dice), size(dice), size(dice), dice.choice([0.0, size(dice)])
    ),
    "three pieces": lambda dice: three_pieces(
        size(dice), size(dice), size(dice), (size(dice), size(dice)),
        dice.choice([0.0, size(dice)]), dice.choice([0.0, size(dice)]),
    ),
    "any pieces": lambda dice: Turn(
        size(dice), size(dice), size(dice),
        tuple((size(dice), size(dice), size(dice)) for _n in range(dice.randrange(3))),
    ),
}  # fmt: skip


def numbers(turn: TwoArcTurn | Turn, dice: random.Random) -> list[float]:
    """What a turn tells of itself."""
    told = [turn.length, *(curve.length for curve in turn.route().curves)]
    if isinstance(turn, TwoArcTurn):
        return [*told, *turn.radii, turn.sweep, *turn.boundary_angles()]
    told += [] if math.isinf(turn.least_radius) else [turn.least_radius]
    return [*told, turn.extent, *_told(lambda: [turn.way(size(dice))])]


def _told(make: Callable[[], list[float]]) -> list[float]:
    try:
        return make()
    except InputError:
        return []


def _numbers_of(kind: str, dice: random.Random) -> list[float]:
    return numbers(TURNS[kind](dice), dice)


@pytest.mark.parametrize("kind", TURNS)
def test_a_turn_of_any_sizes_is_refused_or_has_finite_lengths(kind: str) -> None:
    made = 0
    for seed in range(400):
        dice = random.Random(seed)
        found = _told(partial(_numbers_of, kind, dice))
        assert all(map(math.isfinite, found)), seed
        made += bool(found)
    assert made < 400
    assert made or kind == "any pieces"  # which hardly ever join the spirals


def test_a_turn_of_a_pitch_too_small_to_be_meant_is_refused() -> None:
    with pytest.raises(InputError, match=r"^pitch must be at least "):
        Turn(1e-320, 4.5, 4.5, ((1.0, 0.0, 0.0),))


@pytest.mark.parametrize("digits", [400, 6000])
@pytest.mark.parametrize(
    "make",
    [
        lambda value: finite("size", value), lambda value: whole("size", value, 0, 9), Line,
        lambda value: Arc(value, 1.0), lambda value: Spiral(1.0, value, 0.0),
        lambda value: Clothoid(1.0, value, 0.0), Dragon.uniform,
        lambda value: Dragon.uniform(3, value), lambda value: SpeedProfile((0.0, value), (1.0, 1.0)),
        lambda value: SpeedProfile.constant(1.0).distance(value),
    ],
)  # fmt: skip
def test_a_whole_number_that_no_double_holds_is_refused(
    make: Callable[[object], object], digits: int
) -> None:
    with pytest.raises(InputError) as refused:
        make(10**digits)
    assert len(str(refused.value)) < 300


def test_what_cannot_be_written_is_not_shown() -> None:
    assert brief([1.0, "x"]) == "[1.0, 'x']"
    assert len(brief("x" * 1000)) == 80
    assert brief(10**6000) == "something too long to be shown"
    nested: list[object] = []
    for _n in range(100_000):
        nested = [nested]
    assert brief(nested) == "something too long to be shown"


def test_a_head_that_walks_for_ever_is_infinitely_far() -> None:
    assert SpeedProfile.constant(2.0).distance(1.7e308) == math.inf
    assert Dragon.uniform(3).links.size == 3
    with pytest.raises(InputError, match="must be at most"):
        Dragon.uniform(3, 1e308, front_inset=-1.7e308)


LIMITS = ("acceleration", "lateral_acceleration", "total_acceleration", "turning_rate")


@pytest.mark.parametrize("limit", [*LIMITS, "head_acceleration", "speed"])
@pytest.mark.parametrize("value", [1e-300, 9e-7])
def test_a_limit_too_small_to_be_meant_is_refused(limit: str, value: float) -> None:
    with pytest.raises(BenchDragonError, match=f"limits.{limit}: expected at least 1e-06, not {value}"):
        checked(
            {"schema": 1, "route": {"kind": "turn", "pitch": 1.7}, "limits": {limit: value}}, "plan"
        )


@pytest.mark.parametrize("limit", [*LIMITS, "head_acceleration"])
@pytest.mark.parametrize("value", [1e-6, 1e300])
@pytest.mark.parametrize("ask", [check, greatest_head_speed, slowed])
def test_limits_that_are_let_in_are_answered_or_refused(
    ask: Callable[..., object], limit: str, value: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(budget.VARIABLE, "0.003")
    limits = {"speed": 2.0, limit: value}
    walk = {"start": -5.0, "end": 5.0}
    plan = checked(
        {
            "schema": 1, "route": {"kind": "turn", "pitch": 1.7}, "limits": limits, "walk": walk,
            "dragon": {"benches": 4},
        },
        "plan",
    )  # fmt: skip
    with contextlib.suppress(BenchDragonError):
        assert ask(plan) is not None
