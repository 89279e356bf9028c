"""Walks of a plan in which one size varies: the kernels' are those of the plan, size by size."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from benchdragon.analysis.contact import first_contact
from benchdragon.errors import BenchDragonError
from benchdragon.kernels.family import Way, set_walk
from benchdragon.kernels.size_bracket import FAILS, PASSES, UNDECIDED, VALUE
from benchdragon.kernels.size_search import NOBODY
from benchdragon.kernels.step_bounds import empty_placements
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.progress import silent
from benchdragon.solve import size_trials
from benchdragon.solve.size_trials import QUESTIONS, Family, SizeSearch, kernel_family, question

DISC = ["disc.radius=4.5"]
FEW = "dragon.benches=30"
EASED = ["turn.ease=0.8", "dragon.head_length=2.5", "turn.exit_radius=4.4"]
EIGHT = str(Path(__file__).parents[2] / "examples" / "02_eight.dragon.toml")
PLANS: dict[str, tuple[str, Sequence[str], float]] = {
    "spiral": ("spiral-in", DISC, 0.0),
    "spiral, counter-clockwise, short": ("spiral-in", [*DISC, "route.clockwise=false", FEW], 0.1),
    "spiral that ends with a time": ("spiral-in", [FEW, "walk.end=120", "walk.start=7"], 0.0),
    "spiral from a place": ("spiral-in", [*DISC, FEW, "walk.position=20", "walk.speed=1.5"], 0.0),
    "turn": ("turn", [], 0.0),
    "turn, eased": ("turn", [FEW, *EASED], 0.0),
    "arc, line, arc": ("turn", [FEW, "turn.family=arc-line-arc", "turn.radii=[2.0, 1.6]"], 0.0),
    "arcs without radii": ("turn", [FEW, "turn.family=arc-arc-arc", "turn.curvature=0.05"], 0.0),
    "turn of a shorter walk": ("turn", [FEW, "walk.start=-20", "walk.end=60"], 0.0),
    "fixed parts": (EIGHT, [FEW], 0.0),
}
# By what a plan's own size is multiplied.
FACTORS = (0.3, 0.71, 0.93, 1.0, 1.02, 1.31, 2.6, 40.0)


def families(plan: Plan, margin: float) -> list[Family]:
    """The families of all sizes that this plan has."""
    found = []
    for one in QUESTIONS.values():
        try:
            plan.value(one.keys[0])
        except BenchDragonError:
            continue
        found.append(Family(plan, one, margin))
    return found


@pytest.mark.parametrize("name", PLANS)
def test_walks_of_the_kernels_are_those_of_the_plan_for_every_size(name: str) -> None:
    built_in, settings, margin = PLANS[name]
    plan = read_plan(built_in, settings)
    walked = refused = 0
    for family in families(plan, margin):
        own, walk = kernel_family(family, family.walk(family.first)[0])
        walk = walk._replace(
            rows=np.zeros((64, walk.rows.shape[1])) if plan.route.kind == "turn" else walk.rows
        )
        places = empty_placements(len(walk.benches.kind) + 1, 1)
        for factor in FACTORS:
            size = factor * family.first
            way = Way(*set_walk(own, walk, np.empty(1), places, size))
            try:
                wanted, start, end = family.walk(size)
                first, last = wanted.head_position([start, end]).tolist()
            except BenchDragonError:
                assert way.rows == 0, (family.question.name, factor)
                refused += 1
                continue
            assert way.rows == len(wanted.route.rows), (family.question.name, factor)
            np.testing.assert_allclose(walk.rows[: way.rows], wanted.route.rows, rtol=1e-12, atol=1e-11)
            np.testing.assert_array_equal(walk.benches.sizes, wanted.dragon.sizes)
            np.testing.assert_array_equal(walk.benches.links, wanted.dragon.links)
            np.testing.assert_allclose(
                walk.benches.ahead,
                np.cumsum(wanted.dragon.links) - wanted.dragon.links,
                rtol=1e-13,
                atol=1e-12,
            )
            assert float(walk.benches.lever[0]) == pytest.approx(wanted.dragon.lever, rel=1e-15)
            assert (walk.kinds.sizes[:, walk.benches.kind] == wanted.dragon.sizes).all()
            assert (way.first, way.last) == pytest.approx((first, last), abs=2e-9)
            walked += 1
    assert walked > 10
    assert refused > 2 or plan.walk.end is not None


def test_benches_of_one_size_of_which_some_vary_are_of_two_kinds() -> None:
    plan = read_plan("spiral-in", [*DISC, FEW, "dragon.head_length=2.2"])
    family = Family(plan, question("length"), 0.0)
    _own, walk = kernel_family(family, family.walk(family.first)[0])
    assert walk.benches.kind.tolist() == [0, *[1] * 29]


@pytest.mark.parametrize(
    ("plan", "name"),
    [("spiral-in", "pitch"), ("spiral-in", "width"), ("turn", "pitch"), (EIGHT, "length")],
)
def test_a_trial_is_the_search_for_contact_of_that_walk(plan: str, name: str) -> None:
    chosen = read_plan(plan, [FEW, *(DISC if plan == "spiral-in" else [])])
    family = Family(chosen, question(name), 0.05)
    search, results = SizeSearch(family, silent), set()
    for factor in (0.6, 0.75, 0.9, 1.0, 1.15, 1.4, 2.5):
        size = factor * family.first
        result = search.trial(size)
        try:
            walk, start, end = family.walk(size)
            contact = first_contact(walk, start, end, margin=0.05)
        except BenchDragonError:
            assert result == FAILS
            continue
        results.add(result)
        assert result == (PASSES if contact is None else FAILS)
    assert results == {PASSES, FAILS}


def test_a_route_of_more_rows_than_there_is_room_for_is_laid_with_more() -> None:
    """At narrower pitches the clothoids are cut into more rows than at the plan's."""
    plan = read_plan("turn", [FEW, *EASED, "route.pitch=1.7"])
    family = Family(plan, question("pitch"), 0.0)
    search = SizeSearch(family, silent)
    wanted = len(search._walk.rows)
    search._walk = search._walk._replace(rows=search._walk.rows[:3])
    search._tables = search._made_tables()
    assert search.trial(1.7) == PASSES
    assert len(search._walk.rows) == wanted > 3


def test_a_search_may_be_asked_again_and_again() -> None:
    plan = read_plan("spiral-in", [*DISC, FEW])
    search = SizeSearch(Family(plan, question("pitch"), 0.0), silent)
    answers = []
    for _turn in range(2):
        assert search.trial(0.3) == FAILS
        search.limit(0.55)
        answers.append(search.state.tolist())
    assert not math.isnan(answers[0][VALUE])
    np.testing.assert_array_equal(answers[0], answers[1])


def test_a_walk_that_cannot_be_followed_fails_only_if_it_is_seen_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Round circles of 9 m a bench with 17.9 m between its handles all but stands square."""
    search = SizeSearch(Family(read_plan(EIGHT, [FEW]), question("length"), 0.0), silent)
    assert search.trial(18.6) == FAILS
    monkeypatch.setattr(size_trials, "falls_soon", lambda *_place: False)
    assert search.trial(18.6) == UNDECIDED


def test_a_walk_that_ends_past_its_route_fails() -> None:
    plan = read_plan("spiral-in", [FEW, *DISC, "route.pitch=1.5", "route.start_turn=6", "walk.end=60"])
    search = SizeSearch(Family(plan, question("pitch"), 0.0), silent)
    assert search.trial(1.5) == PASSES
    assert search.trial(0.9) == FAILS
    assert search._meetings[0, 2] == NOBODY
