"""Plans that name formations and programmes: where the dragon starts, what is safe, what is refused."""

import math
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.check import check
from benchdragon.errors import InputError
from benchdragon.model.formations import FORMATIONS, FigureEight, ThreePlumBlossoms
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.toml import PlanError
from benchdragon.solve.size import limit

# Boards of 2 m, as villages report them.
VILLAGE = {
    "width": 0.2, "front_inset": 0.15, "rear_inset": 0.15, "head_length": 3.0, "body_length": 2.0,
    "tail_length": 2.0,
}  # fmt: skip


def plan_of(route: dict[str, Any], benches: int = 50, **more: Any) -> Plan:
    tables = {"schema": 1, "dragon": {**VILLAGE, "benches": benches}, "route": route, **more}
    return checked(tables, "plan")


def danced(name: str, benches: int = 50, **sizes: Any) -> Plan:
    return plan_of({"kind": "formation", "name": name, **sizes}, benches)


@pytest.mark.parametrize("name", FORMATIONS)
def test_at_first_the_whole_dragon_stands_on_the_formation_with_its_tail_at_the_start(
    name: str,
) -> None:
    plan = danced(name)
    walk = plan.build()
    start, end = plan.span(walk)
    motion = walk.motion([start, end])
    assert motion.s[0, -1] == pytest.approx(0.0, abs=1e-8)
    assert motion.s[1, 0] == pytest.approx(walk.route.length)
    assert start == 0.0


@pytest.mark.parametrize("benches", [50, 120])
@pytest.mark.parametrize("name", FORMATIONS)
def test_village_dragons_of_50_to_120_benches_dance_each_formation_free_of_contact(
    name: str, benches: int
) -> None:
    report = check(danced(name, benches))
    assert report.safe
    assert report.clearance.lower > 0.3


@pytest.mark.parametrize(
    ("kind", "length"),
    [
        (FigureEight, FigureEight(8.0).loop),
        (ThreePlumBlossoms, ThreePlumBlossoms(5.0, 3.0).build().length),
    ],
)
def test_a_dragon_longer_than_a_loop_touches_itself_and_a_shorter_one_does_not(
    kind: type[FigureEight | ThreePlumBlossoms], length: float
) -> None:
    sizes = {"radius": 8.0} if kind is FigureEight else {"radius": 5.0, "waist": 3.0}
    link = 1.7
    shorter, longer = int(length / link) - 3, int(length / link) + 3
    for benches, safe in ((shorter, True), (longer, False)):
        plan = danced(kind.name, benches, rounds=2, **sizes)
        assert (
            sum(plan.dragon.build().links) < length if safe else sum(plan.dragon.build().links) > length
        )
        assert check(plan).safe == safe


@pytest.mark.parametrize(
    ("route", "where"),
    [
        ({"name": "coil-in", "inner_radius": 0.8}, "route.inner_radius"),
        ({"name": "coil-out", "inner_radius": 0.8}, "route.inner_radius"),
        ({"name": "double-door", "inner_radius": 0.8}, "route.inner_radius"),
        ({"name": "figure-eight", "radius": 1.3}, "route.radius"),
        ({"name": "three-plum-blossoms", "radius": 4.0, "waist": 1.3}, "route.waist"),
        ({"name": "three-plum-blossoms", "radius": 1.3}, "route.radius"),
        ({"name": "tail-swing", "radius": 1.3, "swing": 1.0}, "route.radius"),
    ],
)
def test_a_bend_that_a_bench_cannot_follow_names_the_size_to_change(
    route: dict[str, Any], where: str
) -> None:
    with pytest.raises(PlanError) as caught:
        plan_of({"kind": "formation", **route}).build()
    assert f"{where}: a bench with 2.7 m between its handles cannot follow a bend of" in str(
        caught.value
    )
    assert f"it must be wider than 1.35 m, so make {where} larger" in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_all_that_is_wrong_in_a_programme_is_told_at_once_with_where_it_stands() -> None:
    steps = [
        {"name": "coil-out", "inner_radius": 0.9},
        {"name": "figure-eight", "radius": 20.0},
        {"name": "coil-in", "inner_radius": 20.0, "at": [50, 0]},
        {"name": "straight-dragon", "turned": 20.0},
    ]
    plan = plan_of({"kind": "programme", "formation": steps, "radius": 1.0})
    with pytest.raises(PlanError) as caught:
        plan.build()
    said = str(caught.value).splitlines()
    assert [line.split(" ")[1].rstrip(":") for line in said] == [
        "route.radius", "route.formation.0.inner_radius", "route.formation.2.inner_radius",
        "route.formation.3.turned",
    ]  # fmt: skip
    assert "(20 m) must be smaller than outer_radius (12 m)" in said[2]
    assert "turned has no effect without at" in said[3]


def test_a_dragon_that_is_longer_than_the_route_is_told_how_much_it_needs() -> None:
    with pytest.raises(PlanError, match=r"the dragon, 86 m long, does not fit on a route of 60 m"):
        danced("straight-dragon", length=60.0).build()
    plan = danced("straight-dragon", length=60.0).with_value("walk.position", 20.0)
    assert plan.build().start == 20.0


@pytest.mark.parametrize(
    ("route", "sentence"),
    [
        ({"kind": "formation"}, "route.name is missing"),
        ({"kind": "formation", "name": "phoenix"}, "route.name: expected 'coil-in', 'coil-out',"),
        ({"kind": "formation", "name": "coil-in", "ptich": 1}, "did you mean route.pitch?"),
        ({"kind": "formation", "name": "tail-swing", "swings": 2.5}, "route.swings: expected a whole"),
        ({"kind": "formation", "name": "coil-in", "pitch": "8 kg"}, "with a unit of m, cm, mm"),
        ({"kind": "programme"}, "route.formation is missing"),
        ({"kind": "programme", "formation": []}, "route.formation: expected at least 1 entries"),
        ({"kind": "programme", "formation": [{"name": "coil-in"}] * 51}, "at most 50 entries"),
        ({"kind": "programme", "formation": [3]}, "route.formation.0: expected a table, not 3"),
        ({"kind": "programme", "formation": "coil-in"}, "route.formation: expected a list"),
        ({"kind": "programme", "formation": [{"at": [0, 0]}]}, "route.formation.0.name is missing"),
    ],
)
def test_what_cannot_be_read_is_one_sentence(route: dict[str, Any], sentence: str) -> None:
    with pytest.raises(PlanError) as caught:
        plan_of(route)
    assert sentence in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_another_name_takes_along_the_sizes_of_the_former_one() -> None:
    plan = danced("coil-in", pitch=1.0)
    assert plan.with_value("route.name", "figure-eight").build().route.length > 500.0
    steps = [{"name": "coil-in", "pitch": 1.0, "at": [1.0, 2.0]}]
    whole = plan_of({"kind": "programme", "formation": steps})
    other = whole.with_value("route.formation.0.name", "straight-dragon")
    assert other.data()["route"]["formation"] == [
        {"name": "straight-dragon", "at": [1.0, 2.0], "turned": 0.0}
    ]


def test_the_whole_dance_is_moved_and_turned_on_the_square() -> None:
    route = {"kind": "formation", "name": "figure-eight", "radius": 20.0}
    plain = plan_of(route).build()
    moved = plan_of({**route, "at": [5.0, -3.0], "turned": 90.0}).build()
    s = np.linspace(0.0, plain.route.length, 200)
    x, y = plain.route.point(s).T
    assert np.abs(moved.route.point(s) - np.stack([5.0 - y, x - 3.0], axis=-1)).max() < 1e-9
    assert moved.start == pytest.approx(plain.start)


def test_widths_and_lengths_of_benches_are_sought_on_formations_and_pitches_are_not() -> None:
    plan = danced("double-door", 60, pitch=0.5)
    widest = limit(plan, "width")
    assert widest.status == "found"
    assert 0.2 < widest.value < 0.5
    for width, safe in ((widest.lower, True), (widest.upper + 1e-6, False)):
        assert check(plan.with_value("dragon.width", width)).safe == safe
    longest = limit(plan, "length")
    assert longest.value > 2.0
    with pytest.raises(
        InputError, match="the smallest pitch of a formation is not sought: see by a sweep"
    ):
        limit(plan, "pitch")


def test_only_what_is_said_of_a_formation_is_written_down() -> None:
    plan = danced("coil-in", pitch=1.0)
    again = checked({**read_plan("turn").data(), **plan.data()} | {"turn": {}, "disc": {}}, "again")
    assert again.route == plan.route
    assert "radius" not in plan.toml()
    assert math.isclose(checked(plan.data(), "x").build().route.length, plan.build().route.length)
