"""Walks of a plan in which one size varies: the kernels' are those of the plan, size by size."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from benchdragon.errors import BenchDragonError
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.family import Way, falls_soon, set_walk
from benchdragon.kernels.workspace import Benches
from benchdragon.model.curves import Line, Route
from benchdragon.model.dragon import Dragon
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.size_family import QUESTIONS, PlanFamily, kernel_family

DISC = ["disc.radius=4.5"]
FEW = "dragon.benches=12"
EASED = ["turn.ease=0.8", "dragon.head_length=2.5", "turn.exit_radius=4.4"]
EIGHT = str(Path(__file__).parents[2] / "examples" / "02_eight.dragon.toml")
WIDE = [
    *("route.pitch=3.357", "disc.radius=6.2", "walk.start=-20", "walk.end=30", "turn.curvature=0.4"),
    *("turn.family=arc-arc-arc", "turn.radii=[1.9085, 3.8187]", "turn.entry_radius=2.623"),
    "turn.exit_radius=1.515",
]
PLANS: dict[str, tuple[str, Sequence[str], float]] = {
    "spiral": ("spiral-in", [*DISC, FEW], 0.0),
    "spiral, counter-clockwise, short": ("spiral-in", [*DISC, "route.clockwise=false", FEW], 0.1),
    "spiral that ends with a time": ("spiral-in", [FEW, "walk.end=120", "walk.start=7"], 0.0),
    "spiral from a place": ("spiral-in", [*DISC, FEW, "walk.position=20", "walk.speed=1.5"], 0.0),
    "turn": ("turn", [FEW], 0.0),
    "turn, eased": ("turn", [FEW, *EASED], 0.0),
    "arc, line, arc": ("turn", [FEW, "turn.family=arc-line-arc", "turn.radii=[2.0, 1.6]"], 0.0),
    "arcs without radii": ("turn", [FEW, "turn.family=arc-arc-arc", "turn.curvature=0.05"], 0.0),
    "turn that swings out": ("turn", [FEW, *WIDE], 0.0),
    "turn of a shorter walk": ("turn", [FEW, "walk.start=-20", "walk.end=60"], 0.0),
    "fixed parts": (EIGHT, [FEW], 0.0),
}
# By what a plan's own size is multiplied.
FACTORS = (0.3, 0.71, 0.93, 1.0, 1.02, 1.31, 2.6, 40.0)


def families(plan: Plan, margin: float) -> list[PlanFamily]:
    """The families of all sizes that this plan has."""
    found = []
    for one in QUESTIONS.values():
        try:
            plan.value(one.keys[0])
        except BenchDragonError:
            continue
        found.append(PlanFamily(plan, one, margin))
    return found


@pytest.mark.parametrize("name", PLANS)
def test_walks_of_the_kernels_are_those_of_the_plan_for_every_size(name: str) -> None:
    built_in, settings, margin = PLANS[name]
    plan = read_plan(built_in, settings)
    walked = refused = 0
    for family in families(plan, margin):
        own, walk = kernel_family(family, family.walk(family.first)[0])
        turns, of = plan.route.kind == "turn", walk.benches
        walk = walk._replace(  # into which walks are laid
            rows=np.zeros((64, walk.rows.shape[1])) if turns else walk.rows.copy(),
            benches=Benches(
                of.links.copy(), of.sizes.copy(), of.kind, of.ahead.copy(), of.lever.copy()
            ),
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


def test_a_dragon_falls_soon_where_its_route_ends_or_bends_too_tightly_just_ahead() -> None:
    route, dragon = Route((Line(30.0),)), Dragon.uniform(4)
    scratch = np.empty(1), empty_placements(5, 1)
    for sound, falls in ((12.0, False), (30.0 - 3e-6, False), (30.0 - 1e-6, True), (31.0, True)):
        assert falls_soon(route.rows, dragon.links, sound, *scratch) == falls
    bend = read_plan(EIGHT, ["dragon.benches=4"]).build().route
    long = Dragon.of_sizes(np.full(4, 18.6), 0.3, 0.2, 0.2)
    assert falls_soon(bend.rows, long.links, 75.0, *scratch)
