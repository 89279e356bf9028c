"""Where route positions lie, and the next handle against a dense scan and SciPy's brentq."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchdragon.kernels.chain import cosines
from benchdragon.kernels.curve import CurveKind, RouteRow, place
from benchdragon.kernels.route import (
    END_SLACK,
    FOLD_COSINE,
    evaluate,
    folded,
    locate,
    next_handle,
    on_bend,
    polish,
    positions,
    row_at,
    step_back,
)
from benchdragon.kernels.status import Status
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line, LogSpiral, Route, Spiral
from tests.kernels.reference import first_root, points

# Cosine between bench and route from which on a search may stall instead of arriving.
NEARLY_SQUARE = 0.015


def position(route: Route, j: int, u: float) -> float:
    out = np.empty(1)
    positions(route.rows, np.array([j]), np.array([u]), out)
    return float(out[0])


def behind(route: Route, front: float, link: float) -> tuple[int, float, int, float, Status]:
    """Row and parameter of the front and of the handle behind it, and how the search ended."""
    j, u, _status = locate(route.rows, front)
    x, y, _tx, _ty = place(route.rows, j, u)
    rear, v, status = next_handle(route.rows, j, u, x, y, link)
    return j, u, rear, v, Status(status)


def bench_cosines(
    route: Route, j: int, u: float, rear: int, v: float, link: float
) -> tuple[float, float]:
    """Cosine between bench and route at the front handle and at the rear one."""
    x, y, _tx, _ty = place(route.rows, j, u)
    return cosines(route.rows, j, u, x, y, rear, v, link)[:2]


def chord(route: Route, a: float, b: float) -> float:
    return float(abs(points(route, a)[0] - points(route, b)[0]))


ROUTE = Route.joined(
    [
        *(Line(5.0), Arc(2.0, 1.0), Clothoid(9.0, 0.5, -0.6), LogSpiral(4.0, -0.6, -0.2), Line(1.0)),
        Spiral(1.0, 20.0, 10.0),
    ]
)


def test_every_position_lies_on_the_row_that_holds_it() -> None:
    rows = ROUTE.rows
    assert len(rows) > len(ROUTE.curves)  # the clothoid fills several
    for s in np.linspace(0.0, ROUTE.length, 301)[:-1]:
        j = row_at(rows, s)
        assert (
            rows[j, RouteRow.S_START]
            <= s
            < rows[j, RouteRow.S_START] + rows[j, RouteRow.LENGTH] + 1e-12
        )
    assert row_at(rows, -3.0) == 0
    assert row_at(rows, ROUTE.length + 3.0) == len(rows) - 1


def test_a_joint_belongs_to_the_later_row() -> None:
    for j, start in enumerate(ROUTE.rows[:, RouteRow.S_START]):
        assert row_at(ROUTE.rows, start) == j


def test_a_position_is_found_again_from_its_row_and_parameter() -> None:
    for s in np.linspace(-4.0, ROUTE.length, 101):
        j, u, status = locate(ROUTE.rows, s)
        assert status == Status.OK
        assert position(ROUTE, j, u) == pytest.approx(s, rel=0.0, abs=2e-13)


def test_positions_off_the_route_are_told_apart() -> None:
    closed = Route((Arc(2.0, 1.0), Line(1.0, Arc(2.0, 1.0).end_pose[0], 1.0)))
    assert locate(closed.rows, -1e-12)[2] == Status.BEFORE_ROUTE
    assert locate(ROUTE.rows, -1e6)[2] == Status.OK
    for route in (closed, ROUTE):
        assert locate(route.rows, route.length + 0.5 * END_SLACK)[2] == Status.OK
        assert locate(route.rows, route.length + 4.0 * END_SLACK)[2] == Status.AFTER_ROUTE
    assert END_SLACK <= 1e-9


def test_what_lies_off_the_route_evaluates_to_nan_and_harms_no_neighbour() -> None:
    arc = Arc(2.0, 1.0)
    out = np.zeros((6, 4))
    evaluate(arc.rows, np.array([-1.0, 0.5, 3.0, math.nan, math.inf, 1.0]), out)
    assert np.isnan(out[[0, 2, 3, 4]]).all()
    assert np.isfinite(out[[1, 5]]).all()
    line = np.zeros((1, 4))
    evaluate(Line(1.0).rows, np.array([-math.inf]), line)
    assert np.isnan(line).all()


@given(st.floats(0.0, 1.0), st.floats(1e-6, 30.0))
def test_a_step_back_never_goes_farther_than_its_reach_or_the_row(share: float, reach: float) -> None:
    for curve in (Line(5.0), Arc(2.0, 1.0), Spiral(1.0, 20.0, 10.0), Spiral(1.0, 0.0, 20.0)):
        route = Route((curve,))
        front = share * route.length
        j, u, _status = locate(route.rows, front)
        there = position(route, j, step_back(route.rows, j, u, reach))
        assert front - reach - 1e-12 <= there <= front + 1e-12
        assert there >= -route.extension - 1e-12
        # And it goes far enough to arrive: on lines and arcs the whole reach.
        if not isinstance(curve, Spiral):
            wanted = max(front - reach, -route.extension)
            assert there == pytest.approx(wanted, rel=0.0, abs=1e-12)


def test_polish_finds_the_one_root_of_its_bracket() -> None:
    spiral = Spiral(1.0, 30.0, 20.0)
    x, y, _tx, _ty = place(spiral.rows, 0, 25.0)
    for link in (0.01, 0.5, 2.0):
        u = polish(spiral.rows, 0, 25.001, 26.5, x, y, link)
        px, py, _tx, _ty = place(spiral.rows, 0, u)
        assert 25.0 < u < 26.5
        assert math.hypot(px - x, py - y) == pytest.approx(link, rel=0.0, abs=1e-14)


def test_polish_halves_where_newton_would_leave_the_bracket() -> None:
    # Half round the circle the chord stops growing, and Newton would run away.
    arc = Arc(1.0, 6.0)
    x, y, _tx, _ty = place(arc.rows, 0, 5.0)
    link = 2.0 - 1e-9
    u = polish(arc.rows, 0, 4.0, 5.0 - math.pi, x, y, link)
    px, py, _tx, _ty = place(arc.rows, 0, u)
    assert 5.0 - math.pi <= u < 4.0
    assert math.hypot(px - x, py - y) == pytest.approx(link, rel=0.0, abs=1e-14)


def wander(rng: np.random.Generator, link: float, kinks: bool) -> Route:
    """A line and then two to five curves of any kind, many of them far too tight for the link."""
    curves: list[AnyCurve] = [Line(4.0 * link)]
    for _ in range(int(rng.integers(2, 6))):
        side = float(rng.choice([-1.0, 1.0]))
        a, b = rng.uniform(0.0, 20.0, 2)
        bends = rng.uniform(-3.0, 3.0, 2) / link
        kinds: list[AnyCurve] = [
            Line(link * rng.uniform(0.05, 3.0)),
            Arc(link * rng.uniform(0.2, 2.0), side * rng.uniform(0.2, 4.0)),
            Clothoid(link * rng.uniform(0.3, 4.0), bends[0], bends[1]),
            Spiral(link * rng.uniform(0.1, 1.5), a, b, mirrored=side < 0.0),
            LogSpiral(link * rng.uniform(0.3, 4.0), side * abs(bends[0]), side * abs(bends[1])),
        ]
        curve = kinds[int(rng.integers(5))]
        point, heading = curves[-1].end_pose
        if kinks:
            heading += float(rng.choice([0.0, rng.uniform(-math.pi, math.pi), math.pi]))
        curves.append(curve.moved(point, heading))
    return Route(tuple(curves), kinks=kinks)


def has_cause_to_fold(route: Route, front: float, root: float, link: float) -> bool:
    """Whether a bench from `root` folds, or the chord all but reaches the link on the way there.

    Or a search stalls in coils much narrower than the link, into which no bench can have walked.
    """
    if front - root > 6.0 * link:
        return True
    rows = route.rows
    j, u, _ = locate(rows, front)
    rear, v, _ = locate(rows, root)
    if min(bench_cosines(route, j, u, rear, v, link)) < NEARLY_SQUARE:
        return True
    s = np.linspace(front, root, 4000)
    chords = np.abs(points(route, s) - points(route, front)[0])
    peaks = (chords[1:-1] > chords[:-2]) & (chords[1:-1] > chords[2:])
    return bool((chords[1:-1][peaks] > 0.998 * link).any())


def check_next_handle(route: Route, front: float, link: float) -> Status:
    """The handle found is the first root of the scan, or an earlier one that the scan overlooked."""
    j, u, rear, v, status = behind(route, front, link)
    back = -12.0 * link if math.isinf(route.extension) else 0.0
    wanted = first_root(route, front, link, back)
    if status == Status.ROUTE_TOO_SHORT:
        assert wanted is None
        return status
    found = position(route, rear, v)
    if status == Status.FOLDED:
        assert wanted is None or wanted < found + 1e-9
        assert wanted is None or has_cause_to_fold(route, front, wanted, link)
        return status
    size = 1.0 + abs(complex(points(route, front)[0])) + link
    assert chord(route, front, found) == pytest.approx(link, rel=0.0, abs=4e-14 * size)
    if wanted is None:
        assert found < back
        return status
    square = max(abs(bench_cosines(route, j, u, rear, v, link)[1]), 1e-6)
    assert found >= wanted - 4e-14 * size / square
    if found > wanted + 4e-14 * size / square:
        # Two roots within one step of the scan: the chord only just reaches the link.
        assert found - wanted > 0.0
        assert square < 0.1
    return status


@pytest.mark.parametrize("kinks", [False, True], ids=["smooth", "with kinks"])
@pytest.mark.parametrize("seed", range(12))
def test_the_next_handle_on_a_wandering_route_is_the_first_root(seed: int, kinks: bool) -> None:
    rng = np.random.default_rng([seed, kinks])
    link = float(rng.choice([0.5, 1.65, 2.86, 20.0]))
    route = wander(rng, link, kinks)
    ends = [check_next_handle(route, front, link) for front in rng.uniform(0.0, route.length, 8)]
    assert ends.count(Status.OK) >= 7  # stalls are rare


LINK = 1.65


def zigzag(edge: float, turn: float, count: int) -> Route:
    curves: list[Line] = [Line(5.0)]
    for i in range(count):
        point, heading = curves[-1].end_pose
        curves.append(Line(edge, point, heading + (turn if i % 2 else -turn)))
    return Route(tuple(curves), kinks=True)


def cusp(turn: float) -> Route:
    return Route((Line(6.0), Line(6.0, (6.0, 0.0), turn)), kinks=True)


NASTY = {
    "S of arcs just wide enough": Route.joined([Line(5.0), Arc(0.9, 3.0), Arc(0.9, -3.0), Line(4.0)]),
    "S of arcs tighter than a link": Route.joined(
        [Line(5.0), Arc(0.5, 3.0), Arc(0.5, -3.0), Line(4.0)]
    ),
    "tiny S": Route.joined([Line(5.0), Arc(0.05, 3.0), Arc(0.05, -3.0), Line(4.0)]),
    "circle a hair wider than the link": Route.joined([Line(5.0), Arc(0.5 * LINK + 1e-6, 9.0)]),
    "circle wider by a tenth": Route.joined([Line(5.0), Arc(0.55 * LINK, 9.0)]),
    "hairpin": Route.joined([Line(5.0), Arc(0.2, math.pi), Line(5.0)]),
    "wide hairpin": Route.joined([Line(5.0), Arc(0.51 * LINK, math.pi), Line(5.0)]),
    "full cusp": cusp(math.pi),
    "sharp cusp": cusp(3.0),
    "right angle": cusp(0.5 * math.pi),
    "zigzag of short edges": zigzag(0.2, 1.2, 30),
    "zigzag back and forth": zigzag(0.5, 1.5, 20),
    "clothoid that winds up": Route.joined([Line(5.0), Clothoid(12.0, 0.0, 4.0)]),
    "clothoid that unwinds": Route.joined([Line(5.0), Clothoid(12.0, 4.0, -4.0)]),
    "logarithmic spiral that winds up": Route.joined([Line(5.0), LogSpiral(12.0, 0.1, 4.0)]),
    "logarithmic spiral that unwinds": Route.joined([Line(5.0), LogSpiral(12.0, -4.0, -0.1)]),
    "in to the centre": Route((Spiral(1.0, 20.0, 0.0),)),
    "out from the centre": Route((Spiral(1.0, 0.0, 20.0),)),
    "in and out through the centre": Route.joined([Spiral(1.0, 9.0, 0.0), Spiral(1.0, 0.0, 9.0)]),
    "spiral of a pitch much smaller than the link": Route((Spiral(0.1, 60.0, 1.0),)),
}


@pytest.mark.parametrize("name", NASTY)
def test_the_next_handle_on_a_nasty_route_is_the_first_root(name: str) -> None:
    route = NASTY[name]
    fronts = np.linspace(0.001, 1.0, 23) * route.length
    assert Status.OK in [check_next_handle(route, front, LINK) for front in fronts]


def test_a_front_and_a_handle_may_stand_exactly_at_joints() -> None:
    route = Route.joined([Line(2.0), Line(1.65), Arc(2.0, 1.0)])
    _j, _u, rear, v, status = behind(route, 3.65, 1.65)
    assert status == Status.OK
    assert position(route, rear, v) == pytest.approx(2.0, abs=1e-14)


@pytest.mark.parametrize("off", [-1e-6, -3e-8, -1e-12, 1e-12, 3e-8, 1e-6])
def test_a_handle_is_found_a_hair_from_a_joint(off: float) -> None:
    route = Route.joined([Line(2.0), Line(1.65), Arc(2.0, 1.0)])
    _j, _u, rear, v, status = behind(route, 3.65 + off, 1.65)
    assert status == Status.OK
    found = position(route, rear, v)
    assert found == pytest.approx(2.0 + off, rel=0.0, abs=2e-12 if off > 0.0 else 4e-15)


def test_a_handle_passes_over_the_point_where_its_front_stands() -> None:
    # After a full cusp the way back leads through the front itself, where the chord is 0.
    route = cusp(math.pi)
    _j, _u, rear, v, status = behind(route, 6.5, 1.65)
    assert status == Status.OK
    assert position(route, rear, v) == pytest.approx(5.5 - 1.65, abs=1e-14)


def test_a_circle_narrower_than_the_link_is_left_behind() -> None:
    # No two points of the circle are one link apart: the handle stays on the line before it.
    route = Route.joined([Line(5.0), Arc(0.45 * LINK, 6.0)])
    front = 5.0 + 0.45 * LINK * 3.0
    _j, _u, rear, v, status = behind(route, front, LINK)
    assert status == Status.OK
    assert rear == 0
    assert position(route, rear, v) == pytest.approx(first_root(route, front, LINK, 0.0), abs=1e-12)


def test_an_endless_circle_narrower_than_the_link_stalls_as_folded() -> None:
    route = Route.joined([Line(5.0), Arc(0.4999999 * LINK, 6.0)])
    _j, _u, rear, _v, status = behind(route, 5.0 + 0.5 * LINK * 4.5, LINK)
    assert status == Status.FOLDED
    assert rear == 1


@pytest.mark.parametrize("cosine", [0.1, 0.02, 0.005, 2.0 * FOLD_COSINE])
def test_a_handle_is_found_up_to_the_cosine_at_which_a_bench_counts_as_folded(cosine: float) -> None:
    # A bench across a circle leans by this cosine from its tangents at both ends.
    radius = 0.5 * LINK / math.sqrt(1.0 - cosine * cosine)
    route = Route.joined([Line(5.0), Arc(radius, 12.0)])
    j, u, rear, v, status = behind(route, 5.0 + 8.0 * radius, LINK)
    assert status == Status.OK
    ahead, behind_ = bench_cosines(route, j, u, rear, v, LINK)
    assert ahead == pytest.approx(cosine, rel=1e-6)
    assert behind_ == pytest.approx(cosine, rel=1e-6)


@pytest.mark.parametrize(
    "curve", [Line(9.0), Arc(2.0, 4.5), Arc(2.0, -4.5), Arc(1.000001, 9.0)], ids=repr
)
def test_a_handle_on_a_line_or_an_arc_is_a_link_behind_in_closed_form(curve: AnyCurve) -> None:
    route = Route((curve,))
    for u in (2.3 * LINK, 8.9):
        back = on_bend(route.rows, 0, u, LINK)
        assert chord(route, u, back) == pytest.approx(LINK, abs=4e-15 * LINK)
        assert first_root(route, u, LINK, 0.0) == pytest.approx(back, abs=1e-7)


def test_no_closed_form_is_taken_off_a_row_round_a_circle_too_narrow_or_on_other_curves() -> None:
    route = Route.joined([Line(5.0), Arc(2.0, 3.0), Clothoid(6.0, 0.0, 0.3), Arc(0.49 * LINK, 6.0)])
    for j, u in ((1, 0.9 * LINK), (2, 4.0), (3, 2.5 * LINK)):
        assert math.isnan(on_bend(route.rows, j, u, LINK))
    assert on_bend(route.rows, 0, 1.0, LINK) == 1.0 - LINK  # lines run on straight behind the start


def test_a_route_that_ends_before_the_link_does_is_too_short() -> None:
    for curve in (
        *(Arc(3.0, 0.4), Clothoid(1.2, 0.1, 0.3), LogSpiral(1.2, 0.1, 0.3), Spiral(1.0, 0.0, 1.0)),
    ):
        route = Route((curve,))
        _j, _u, rear, v, status = behind(route, route.length, LINK)
        assert status == Status.ROUTE_TOO_SHORT
        assert (rear, v) == (0, route.rows[0, RouteRow.U_START])


def test_only_the_first_row_of_a_route_is_extended() -> None:
    route = Route.joined([Line(2.0), Line(2.0), Spiral(1.0, 20.0, 10.0)])
    assert route.rows[0, RouteRow.U_BACK] == -math.inf
    assert (route.rows[1:, RouteRow.U_BACK] == route.rows[1:, RouteRow.U_START]).all()
    assert (route.rows[:, RouteRow.U_END] != route.rows[:, RouteRow.U_START]).all()


def test_an_arc_is_blamed_for_a_fold_only_if_the_link_spans_it() -> None:
    rows = Route.joined([Line(2.0), Arc(1.0, 1.0), Line(2.0)]).rows
    assert rows[1, RouteRow.KIND] == CurveKind.ARC
    assert folded(rows, 1, 0, 2.0) == Status.LINK_OVER_DIAMETER
    assert folded(rows, 2, 1, 2.5) == Status.LINK_OVER_DIAMETER
    assert folded(rows, 1, 0, 1.99) == Status.FOLDED
    assert folded(rows, 0, 2, 9.0) == Status.FOLDED


@pytest.mark.parametrize("length", [10.0, 100.0, 1e3, 1e5])
@pytest.mark.parametrize("heading", [0.0, 0.3])
def test_a_handle_is_found_near_the_origin_at_the_end_of_a_long_line(
    length: float, heading: float
) -> None:
    # Here coordinates are small and hold more digits than the arc length from the line's start.
    line = Line(length, (-length * math.cos(heading), -length * math.sin(heading)), heading)
    route = Route((line,))
    for link in np.linspace(1.0, 3.0, 41):
        _j, _u, rear, v, status = behind(route, length - 0.05, float(link))
        assert status == Status.OK
        assert position(route, rear, v) == pytest.approx(length - 0.05 - link, rel=4e-16)


@pytest.mark.parametrize("link", [1e-3, 0.01, 1.65])
def test_a_link_is_found_far_out_on_a_spiral(link: float) -> None:
    # Here neighbouring angles lie farther apart than rounding of the coordinates.
    for spiral in (Spiral(1.7, 2.5e4, 5.0), Spiral(1.7, 4.0, 2.5e4)):
        for front in np.geomspace(100.0, 2.4e4, 60):
            x, y, _tx, _ty = place(spiral.rows, 0, front)
            j, u, status = next_handle(spiral.rows, 0, front, x, y, link)
            assert status == Status.OK
            px, py, _tx, _ty = place(spiral.rows, j, u)
            grain = math.ulp(front) * spiral.k * front
            assert math.hypot(x - px, y - py) == pytest.approx(link, rel=0.0, abs=2.0 * grain)
