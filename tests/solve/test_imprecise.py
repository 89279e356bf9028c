"""The chance that imprecise people come too near: told where it is shown to be small, and only then."""

import pytest

from benchdragon.errors import UnsureError
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve import imprecise
from benchdragon.solve.imprecise import DRAWS, RISK, Chance, chance_of, deviations_of
from benchdragon.solve.tolerance import ALL, Deviations, Draw

SMALL = ("dragon.benches=8", "route.pitch=1.2", "route.start_turn=4", "walk.end=12")


def test_the_imprecision_of_the_plan_is_that_of_the_random_dances() -> None:
    assert deviations_of(read_plan("spiral-in", ["people.imprecision=0.07"])).aside == 0.07
    assert deviations_of(read_plan("spiral-in", ["people.imprecision=3"])).aside == 1.0
    assert deviations_of(read_plan("spiral-in")) == Deviations(*ALL)


def test_no_chance_is_told_that_is_not_shown_to_be_below_the_risk() -> None:
    # By 20 dances, of which none hits, no more is shown than that 16.8 % are enough.
    off = Deviations(*ALL)
    tried = [Chance(off, draws, hits).shown for draws in (20, 110) for hits in (0, 1, 2)]
    assert tried == [False, False, False, True, True, False]
    assert not Chance(off, 0, 0).shown
    assert Chance(off, DRAWS, 1).most < RISK < Chance(off, DRAWS, 2).most


def test_dances_are_drawn_no_further_once_too_many_hit() -> None:
    settings = [*SMALL, "people.imprecision=1", "limits.margin=0.04"]
    found = chance_of(read_plan("spiral-in", settings))
    assert (found.hits, found.shown) == (2, False)
    assert found.draws < DRAWS


def test_a_dance_with_room_is_shown_to_be_safe_enough() -> None:
    told: list[float] = []
    found = chance_of(read_plan("spiral-in", SMALL), lambda share, _text: told.append(share))
    assert (found.draws, found.hits, found.shown) == (DRAWS, 0, True)
    assert told == pytest.approx([(n + 1) / DRAWS for n in range(DRAWS)])


def test_dances_that_cannot_be_walked_leave_the_chance_open(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(_plan: Plan, _draw: Draw) -> bool:
        raise UnsureError("too much work")

    monkeypatch.setattr(imprecise, "touches", refused)
    found = chance_of(read_plan("spiral-in", SMALL))
    assert (found.draws, found.shown) == (0, False)
