"""The paper's turn of two arcs."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from benchdragon import (
    BenchDragonError,
    InputError,
    Spiral,
    Turn,
    TwoArcTurn,
    first_contact,
    three_pieces,
    two_arcs,
)
from benchdragon.kernels.turn_families import spiral_curvature
from benchdragon.model.base_curve import Point
from benchdragon.model.curves import JOINT_GAP
from benchdragon.plans.schema import read_plan
from benchdragon.solve.size import limit

TRUTH = json.loads((Path(__file__).parents[1] / "truth" / "contest.json").read_text(encoding="utf-8"))
PAPER = TwoArcTurn(1.7)


def polar(point: Point, centre: Point) -> float:
    return math.atan2(point[1] - centre[1], point[0] - centre[0])


def same_direction(a: float, b: float, within: float) -> bool:
    return abs(math.remainder(a - b, 2.0 * math.pi)) <= within


def test_the_paper_s_turn_has_the_reference_sizes() -> None:
    truth = TRUTH["two_arc"]
    assert PAPER.radii == pytest.approx((float(truth["r1"]), float(truth["r2"])), rel=1e-15)
    assert PAPER.sweep == pytest.approx(float(truth["sweep"]), rel=1e-15)
    assert PAPER.length == pytest.approx(float(truth["length"]), rel=1e-15)
    assert PAPER.theta == pytest.approx(float(truth["theta"]), rel=1e-15)
    for centre, name in zip(PAPER.centres(), ("c1", "c2"), strict=True):
        assert centre == pytest.approx([float(value) for value in truth[name]], abs=4e-15)


def test_the_paper_s_angles_are_those_of_the_arcs_ends_about_their_centres() -> None:
    wanted = (4.0055, 0.9841, -2.1575, 0.8639)
    assert PAPER.boundary_angles() == pytest.approx(wanted, abs=6e-5)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 2.0, 4.0])
def test_boundary_angles_point_from_the_centres_to_the_joints(ratio: float) -> None:
    turn = TwoArcTurn(1.7, ratio=ratio)
    route, (first, second) = turn.route(), turn.centres()
    start, middle, end = (tuple(route.point(s)) for s in route.joints[1:4])
    angles = turn.boundary_angles()
    points = [(start, first), (middle, first), (middle, second), (end, second)]
    for angle, (point, centre) in zip(angles, points, strict=True):
        assert same_direction(angle, polar(point, centre), 1e-12)
    assert angles[0] - angles[1] == pytest.approx(turn.sweep)  # clockwise
    assert angles[3] - angles[2] == pytest.approx(turn.sweep)  # counter-clockwise


@pytest.mark.parametrize("pitch", [0.5, 1.7, 5.0])
def test_the_length_of_the_turn_does_not_depend_on_the_ratio(pitch: float) -> None:
    lengths, sums = [], []
    for ratio in np.linspace(0.2, 5.0, 25):
        turn = TwoArcTurn(pitch, ratio=float(ratio))
        assert turn.radii[0] / turn.radii[1] == pytest.approx(ratio, rel=1e-14)
        first, second = turn.arcs()
        lengths.append(first.length + second.length)
        sums.append(sum(turn.radii))
        assert lengths[-1] == pytest.approx(turn.length, rel=1e-14)
    assert lengths == pytest.approx([lengths[0]] * 25, rel=1e-14)
    assert sums == pytest.approx([sums[0]] * 25, rel=1e-14)


@pytest.mark.parametrize("ratio", [0.2, 1.0, 2.0, 5.0])
@pytest.mark.parametrize(("pitch", "radius"), [(1.7, 4.5), (0.5, 4.5), (1.7, 2.0), (3.0, 1.0)])
def test_the_route_is_tangent_at_every_joint(pitch: float, radius: float, ratio: float) -> None:
    turn = TwoArcTurn(pitch, radius, ratio)
    route = turn.route()  # refuses gaps and kinks above JOINT_GAP by itself
    for before, after in zip(route.curves, route.curves[1:], strict=False):
        (ax, ay), a = before.end_pose
        (bx, by), b = after.start_pose
        assert math.hypot(bx - ax, by - ay) <= 1e-12 < JOINT_GAP
        assert same_direction(a, b, 1e-12)


def test_the_turn_begins_and_ends_on_the_disc_half_a_turn_apart() -> None:
    route = PAPER.route()
    start, end = route.point(route.joints[[1, 3]])
    assert np.hypot(*start) == pytest.approx(4.5, rel=1e-15)
    np.testing.assert_allclose(end, -start, atol=1e-13)
    inside = route.point(np.linspace(route.joints[1], route.joints[3], 200))
    assert np.hypot(*inside.T).max() <= 4.5 + 1e-12


def test_the_turn_goes_right_and_then_left() -> None:
    route = PAPER.route()
    _, a, b, c, _ = route.joints
    assert route.curvature(0.5 * (a + b)) == pytest.approx(-1.0 / PAPER.radii[0], rel=1e-15)
    assert route.curvature(0.5 * (b + c)) == pytest.approx(1.0 / PAPER.radii[1], rel=1e-15)
    assert c - a == pytest.approx(PAPER.length, rel=1e-13)


def test_the_way_out_is_the_way_in_turned_by_half_a_turn() -> None:
    route = PAPER.route(lead=80.0, trail=80.0)
    way_in = route.point(np.linspace(0.0, route.joints[1], 30))
    way_out = route.point(np.linspace(route.length, route.joints[3], 30))
    np.testing.assert_allclose(way_out, -way_in, rtol=0.0, atol=1e-11)


def test_lead_and_trail_are_lengths_of_the_spirals() -> None:
    route = PAPER.route(lead=12.5, trail=345.0)
    assert route.curves[0].length == pytest.approx(12.5, rel=1e-12)
    assert route.curves[3].length == pytest.approx(345.0, rel=1e-12)
    assert route.extension == math.inf


@pytest.mark.parametrize("name", ["pitch", "entry_radius", "ratio"])
@pytest.mark.parametrize(
    ("value", "wanted"),
    [
        (0.0, "must be positive, not 0.0"),
        (-1.0, "must be positive, not -1.0"),
        (math.nan, "must be finite, not nan"),
        (math.inf, "must be finite, not inf"),
        ("wide", "must be a number, not 'wide'"),
    ],
)
def test_sizes_that_cannot_be_are_refused(name: str, value: float, wanted: str) -> None:
    with pytest.raises(InputError, match=f"^{name} {wanted}"):
        TwoArcTurn(**{"pitch": 1.7, name: value})


@pytest.mark.parametrize("name", ["lead", "trail"])
@pytest.mark.parametrize("value", [0.0, -5.0, math.nan, math.inf, "long"])
def test_ways_in_and_out_that_cannot_be_are_refused(name: str, value: float) -> None:
    with pytest.raises(InputError, match=f"^{name} must be (positive|finite|a number), not "):
        PAPER.route(**{name: value})


def test_a_turn_too_near_the_centre_is_refused() -> None:
    wanted = r"^the turn must begin farther out than 0.135 m at this pitch, not at 0.1 m$"
    with pytest.raises(InputError, match=wanted):
        TwoArcTurn(1.7, 0.1)
    assert TwoArcTurn(1.7, 0.14).route().length > 0.0


def ends_in_place(turn: Turn) -> bool:
    """Whether its route is joined without gap or kink, at the radii that it says."""
    route = turn.route(lead=20.0, trail=20.0)  # raises at a gap or a kink
    radii = [float(np.hypot(*route.point(s))) for s in (route.joints[1], route.joints[-2])]
    return radii == pytest.approx([turn.entry_radius, turn.exit_radius], abs=1e-9)


@pytest.mark.parametrize("ratio", [0.4, 1.0, 2.0])
def test_two_arcs_between_equal_joints_are_the_paper_s(ratio: float) -> None:
    turn, paper = two_arcs(1.7, 4.5, 4.5, ratio), TwoArcTurn(1.7, ratio=ratio)
    assert turn.length == pytest.approx(paper.length, abs=1e-12)
    radii = [1.0 / abs(a) for _length, a, _b in turn.pieces]
    assert radii == pytest.approx(paper.radii, abs=1e-12)
    assert turn.way(4.5) == turn.length


def test_a_turn_of_pieces_that_cannot_be_is_refused() -> None:
    for pieces, text in (
        (((1.0, 0.2),), "must be triples"),
        (((0.0, 0.2, 0.2),), "the angle of an arc must not be 0"),
        (((-2.0, 0.0, 0.0),), "length must be positive"),
        (((1.0, math.nan, 0.2),), "start_curvature must be finite"),
        (((1.0, 0.0, 3e4),), "may sweep at most 10000 rad"),
    ):
        with pytest.raises(InputError, match=text):
            Turn(1.7, 4.5, 4.5, pieces)  # type: ignore[arg-type]


def test_deeper_joints_shorten_the_turn_and_lengthen_the_way() -> None:
    # Figures of the contest's field: 12.9359 m at r = 4.2815 m, 8.4430 m at r = 2.8472 m
    turns = [two_arcs(1.7, 4.2815, 4.2815, 2.0), two_arcs(1.7, 2.8472, 2.8472, 1.0)]
    assert [turn.length for turn in turns] == pytest.approx([12.9361, 8.4431], abs=2e-4)
    assert [turn.least_radius for turn in turns] == pytest.approx([1.43, 1.43], abs=1e-4)
    spiral = Spiral.between(1.7, 4.5, 4.2815)
    assert turns[0].way(4.5) == pytest.approx(turns[0].length + 2.0 * spiral.length, abs=1e-12)
    assert turns[1].way(4.5) > 50.0
    assert all(ends_in_place(turn) for turn in turns)


def random_turns(rng: np.random.Generator) -> list[Turn]:
    """Of two random turns, one of two arcs and one of three pieces, those that exist."""
    entry, exit_ = rng.uniform(3.2, 5.0, 2)
    ease = float(rng.choice([0.0, rng.uniform(0.05, 1.0)]))
    bend = float(rng.choice([0.0, rng.uniform(-0.5, 0.5)]))
    ratio, *radii = rng.uniform(0.5, 2.0), *rng.uniform(1.2, 2.0, 2)
    found = []
    for family in range(2):
        try:
            if family:
                found.append(three_pieces(1.7, entry, exit_, (radii[0], radii[1]), bend, ease))
            else:
                found.append(two_arcs(1.7, entry, exit_, ratio, ease))
        except InputError:
            continue
    return found


def test_random_turns_of_all_families_end_in_place() -> None:
    rng = np.random.default_rng(4)
    turns = [turn for _trial in range(60) for turn in random_turns(rng)]
    assert len(turns) > 80
    for turn in turns:
        assert ends_in_place(turn)
        assert all(length > 0.0 for length, _a, _b in turn.pieces)
        bends = [end for _length, *ends in turn.pieces for end in ends]
        if bends[0] != bends[1]:  # eased
            ends = -spiral_curvature(1.7, turn.entry_radius), spiral_curvature(1.7, turn.exit_radius)
            assert (bends[0], bends[-1]) == pytest.approx(ends, rel=1e-15)
            assert bends[1:-1:2] == bends[2:-1:2]  # continuous where pieces meet


def test_a_line_between_equal_arcs_shortens_the_turn() -> None:
    turn = three_pieces(1.7, 4.5, 4.5, (1.8, 1.8))
    assert turn.length < PAPER.length - 1.5
    (one, line, two) = turn.pieces
    assert one[0] == pytest.approx(two[0], abs=1e-12)  # it is point-symmetric
    assert line[1:] == (0.0, 0.0)
    halfway = turn.route().point(100.0 + 0.5 * turn.length)
    assert halfway == pytest.approx([0.0, 0.0], abs=1e-12)


def test_curvature_of_the_spiral_is_that_of_its_curve() -> None:
    spiral = Spiral.between(1.7, 4.0, 6.0)
    assert spiral_curvature(1.7, 4.0) == pytest.approx(float(spiral.curvature(0.0)), rel=1e-14)


@pytest.mark.parametrize(
    ("settings", "text"),
    [
        (["turn.radii=[4, 4]"], "leave no line"),
        (["turn.radii=[1.4, 2]"], "cannot follow a bend"),
        (["turn.exit_radius=4.6"], "exit_radius"),
        (["turn.ease=3"], "ease|clothoids|eased"),
        (["turn.ease=-1"], "at least 0"),
        (["turn.family=arc-arc", "turn.ratio=3"], "cannot follow a bend of 1.127"),
        (["turn.family=arc-arc-arc", "turn.curvature=0.01", "turn.radii=[4, 4]"], "no circle|wider"),
        (["disc.radius=4.5", "route.pitch=60"], "farther out"),
    ],
)
def test_turns_that_cannot_be_are_refused_with_the_reason(settings: list[str], text: str) -> None:
    with pytest.raises(BenchDragonError, match=text):
        read_plan("turn", ["turn.family=arc-line-arc", *settings]).build()


@pytest.mark.parametrize("what", ["pitch", "disc"])
def test_the_smallest_pitch_and_disc_of_the_whole_dance(what: str) -> None:
    plan = read_plan("turn", ["dragon.benches=40", "turn.ratio=1"])
    found = limit(plan, what)
    assert found.status == "found"
    assert found.upper - found.lower < 1e-9
    key = {"pitch": "route.pitch", "disc": "disc.radius"}[what]
    for size, clear in ((found.upper + 1e-6, True), (found.lower - 1e-6, False)):
        try:
            walk = plan.with_value(key, size).build()
            contact = first_contact(walk, *plan.with_value(key, size).span(walk))
        except BenchDragonError:
            assert not clear
        else:
            assert (contact is None) == clear
