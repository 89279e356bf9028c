"""Entrances: what they open of the venue's edge, and what is left of that."""

import re
from typing import Any

import pytest
import shapely

from benchdragon.analysis.entrances import POST, edge_left, gates_of
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.toml import PlanError

SQUARE = {"rectangle": [40, 30]}
STREET = {"points": [[-90.0, 0.0], [-40.0, 2.0]], "width": 6}
COILS = {"kind": "turn", "pitch": 1.7, "rounds": 2, "outer_radius": 9.0, "street": STREET}


def square(*entrances: list[Any], **tables: Any) -> Plan:
    told = {"schema": 1, "route": {"kind": "spiral-in"}, "venue": SQUARE, **tables}
    return checked({**told, "event": {"entrances": [*entrances]}}, "square")


def lines(plan: Plan) -> shapely.MultiLineString:
    return shapely.MultiLineString(edge_left(plan))


def test_an_entrance_with_a_width_opens_the_edge_about_itself_by_that() -> None:
    plan = square([20, 3, 4], [-6.5, 14.2, "300 cm"])
    edge = shapely.LinearRing(plan.obstacles()[0].outline)
    gates = [shapely.Point(20, 3).buffer(2.0, 64), shapely.Point(-6.5, 15).buffer(1.5, 64)]
    left = edge.difference(shapely.union_all(gates))
    assert lines(plan).hausdorff_distance(left) < 2e-3
    assert lines(plan).length == pytest.approx(140.0 - 7.0)
    first, second = gates_of(plan)
    assert (first.place, first.width, first.shape.kind) == ((20.0, 3.0), 4.0, "line")
    assert second.width == 3.0
    assert second.shape.outline.tolist() == [pytest.approx(at) for at in ([-5.0, 15.0], [-8.0, 15.0])]


def test_an_entrance_at_a_corner_opens_both_sides_of_it() -> None:
    (gate,) = gates_of(square([20, 15, 4]))
    assert sorted(map(tuple, gate.shape.outline.tolist())) == [(18.0, 15.0), (20.0, 13.0), (20.0, 15.0)]
    assert lines(square([20, 15, 4])).length == pytest.approx(136.0)


@pytest.mark.parametrize(
    "entrances",
    [
        [[20, 3, 4], [20, 5, 4]],
        [[-20, -14, 6], [-19, -15, 3]],
        [[-20, -15, 9], [-18, -15, 2], [-20, -13, 2]],
        [[20, 3, 4], [20, 3, 1]],
    ],
)
def test_entrances_that_overlap_open_what_either_does(entrances: list[list[float]]) -> None:
    plan = square(*entrances)
    edge = shapely.LinearRing(plan.obstacles()[0].outline)
    opened = shapely.union_all([shapely.LineString(gate.shape.outline) for gate in gates_of(plan)])
    assert lines(plan).length == pytest.approx(edge.length - opened.length)
    assert lines(plan).intersection(opened).length < 1e-6


def test_the_edge_is_whole_where_no_entrance_is_on_it_or_none_says_its_width() -> None:
    plan = square([20, 3], [17.9, 3, 4], [0, 0, 200])
    assert edge_left(plan) == []
    unknown, within, vast = gates_of(plan)
    assert (unknown.width, unknown.span, unknown.shape.radius) == (None, None, POST)
    assert (within.span, within.shape.kind, within.shape.radius) == (None, "circle", 2.0)
    assert vast.span is None
    bare = square([20, 3, 4], venue={})
    assert edge_left(bare) == []
    assert gates_of(bare)[0].shape.kind == "circle"


@pytest.mark.parametrize("entrances", [[], [[20, 3, 4]], [[-20, 3, 4]]])
def test_the_gate_of_a_street_is_open_too(entrances: list[list[float]]) -> None:
    plan = square(*entrances, route=COILS)
    (edge,) = plan.obstacles()
    assert edge.open is not None
    opened = [shapely.LineString(gate.shape.outline) for gate in gates_of(plan)]
    left = shapely.LineString(edge.open).difference(shapely.union_all(opened))
    assert lines(plan).length == pytest.approx(left.length)
    assert lines(plan).hausdorff_distance(left) < 1e-6


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("[[20]]", "event.entrances.0: expected at least 2 entries, not [20]"),
        ("[[20, 3, 4, 5]]", "event.entrances.0: expected at most 3 entries"),
        ("[[20, 3, 0]]", "event.entrances.0: expected a width of more than 0 m, not 0"),
        ("[[1, 2], [20, 3, -1.5]]", "event.entrances.1: expected a width of more than 0 m, not -1.5"),
        ('[[20, 3, "wide"]]', "event.entrances.0.2: expected a number"),
        ("[20, 3]", "event.entrances.0: expected a list, not 20"),
    ],
)
def test_an_entrance_that_cannot_be_is_refused_in_a_sentence(said: str, told: str) -> None:
    with pytest.raises(PlanError, match=re.escape(told)):
        read_plan("spiral-in", [f"event.entrances={said}"])
