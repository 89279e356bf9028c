"""Lines, arcs, spirals, clothoids, and routes of them."""

import math
import re
from collections.abc import Callable
from dataclasses import FrozenInstanceError
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import benchdragon
from benchdragon import Arc, Clothoid, InputError, Line, LogSpiral, Route, Spiral
from benchdragon.kernels.curve import MOST_METRES
from benchdragon.model.base_curve import Curve
from benchdragon.model.curves import JOINT_GAP, AnyCurve

PACKAGE = Path(benchdragon.__file__).parent
CURVES: dict[str, AnyCurve] = {
    "line": Line(7.0, (1.0, -2.0), 0.7),
    "arc": Arc(3.0, -2.5, (4.0, 1.0), -2.0),
    "clothoid": Clothoid(20.0, -1.5, 2.0, (-3.0, 5.0), 2.0),
    "logarithmic spiral": LogSpiral(9.0, -0.7, -0.2, (-3.0, 5.0), 2.0),
    "spiral in": Spiral(1.7, 30.0, 9.0, (1.0, 2.0), 0.3),
    "spiral out": Spiral(1.7, 9.0, 30.0, (1.0, 2.0), 0.3, mirrored=True),
}
each_curve = pytest.mark.parametrize("curve", CURVES.values(), ids=list(CURVES))


def rotated(x: float, y: float, turn: float) -> tuple[float, float]:
    c, s = math.cos(turn), math.sin(turn)
    return c * x - s * y, s * x + c * y


def test_a_line_keeps_its_heading() -> None:
    line = Line(7.0, (1.0, -2.0), 0.7)
    s = np.linspace(-30.0, 7.0, 9)
    assert (line.heading(s) == 0.7).all()
    assert (line.curvature(s) == 0.0).all()
    np.testing.assert_allclose(
        line.point(s), np.stack([1.0 + s * math.cos(0.7), -2.0 + s * math.sin(0.7)], -1), atol=1e-14
    )


def test_an_arc_keeps_its_distance_from_its_centre() -> None:
    for sweep in (2.0, -2.0, 9.0):
        arc = Arc(3.0, sweep, (4.0, 1.0), 0.5)
        assert arc.length == 3.0 * abs(sweep)
        points = arc.point(np.linspace(0.0, arc.length, 30))
        radii = np.hypot(points[:, 0] - arc.centre[0], points[:, 1] - arc.centre[1])
        np.testing.assert_allclose(radii, 3.0, rtol=1e-15)
        assert arc.end_pose[1] == pytest.approx(0.5 + sweep, abs=1e-15)
        assert arc.curvature(1.0) == math.copysign(1.0 / 3.0, sweep)


def test_a_spiral_gains_its_pitch_with_every_turn() -> None:
    for mirrored in (False, True):
        spiral = Spiral(0.55, 40.0, 10.0, (1.0, 2.0), 0.3, mirrored)
        theta = spiral.angle(np.linspace(0.0, spiral.length, 20))
        points = spiral.point(np.linspace(0.0, spiral.length, 20))
        np.testing.assert_allclose(
            np.hypot(points[:, 0] - 1.0, points[:, 1] - 2.0), 0.55 * theta / (2.0 * math.pi), rtol=1e-14
        )
        polar = np.arctan2(points[:, 1] - 2.0, points[:, 0] - 1.0)
        turned = (polar - 0.3 - (-1.0 if mirrored else 1.0) * theta) / (2.0 * math.pi)
        np.testing.assert_allclose(turned, np.round(turned), atol=1e-13)


def test_an_unmirrored_spiral_turns_clockwise_inward_and_counter_clockwise_outward() -> None:
    assert Spiral(1.0, 20.0, 10.0).curvature(1.0) < 0.0
    assert Spiral(1.0, 10.0, 20.0).curvature(1.0) > 0.0
    assert Spiral(1.0, 20.0, 10.0, mirrored=True).curvature(1.0) > 0.0
    assert Spiral(1.0, 10.0, 20.0, mirrored=True).curvature(1.0) < 0.0


def test_a_spiral_between_radii_begins_and_ends_at_them() -> None:
    spiral = Spiral.between(1.7, 9.0, 4.5, (1.0, 2.0), 0.3)
    (ax, ay), _ = spiral.start_pose
    (bx, by), _ = spiral.end_pose
    assert math.hypot(ax - 1.0, ay - 2.0) == pytest.approx(9.0, rel=1e-15)
    assert math.hypot(bx - 1.0, by - 2.0) == pytest.approx(4.5, rel=1e-15)


def test_the_contest_begins_at_8_8_m_on_the_sixteenth_turn() -> None:
    (x, y), heading = Spiral(0.55, 32.0 * math.pi, 1.0).start_pose
    assert (x, y) == pytest.approx((8.8, 0.0), abs=1e-13)
    assert math.sin(heading) < -0.99  # clockwise: down from the right


def test_the_curvature_of_a_clothoid_changes_evenly() -> None:
    clothoid = Clothoid(20.0, -1.5, 2.0)
    assert clothoid.length == pytest.approx(20.0, rel=1e-15)
    s = np.linspace(0.0, 20.0, 41)
    np.testing.assert_allclose(clothoid.curvature(s), -1.5 + 3.5 * s / 20.0, atol=1e-14)
    np.testing.assert_allclose(clothoid.heading(s), -1.5 * s + 3.5 * s * s / 40.0, atol=1e-13)


@each_curve
def test_a_moved_curve_is_the_same_curve_elsewhere(curve: AnyCurve) -> None:
    moved = curve.moved((-5.0, 11.0), 1.234)
    assert type(moved) is type(curve)
    (x, y), heading = moved.start_pose
    assert (x, y) == pytest.approx((-5.0, 11.0), abs=1e-13)
    assert math.remainder(heading - 1.234, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-14)
    s = np.linspace(0.0, curve.length, 9)
    assert moved.length == pytest.approx(curve.length, rel=1e-15)
    np.testing.assert_allclose(moved.curvature(s), curve.curvature(s), rtol=1e-14)
    (x0, y0), old = curve.start_pose
    before, after = curve.point(s) - [x0, y0], moved.point(s) - [-5.0, 11.0]
    turned = np.array([rotated(px, py, 1.234 - old) for px, py in before])
    np.testing.assert_allclose(after, turned, rtol=0.0, atol=1e-12)


@each_curve
def test_poses_are_points_and_headings_of_the_ends(curve: AnyCurve) -> None:
    for s, (point, heading) in ((0.0, curve.start_pose), (curve.length, curve.end_pose)):
        assert point == pytest.approx(tuple(curve.point(s)), abs=1e-13)
        assert heading == pytest.approx(float(curve.heading(s)), abs=1e-13)


@each_curve
def test_evaluation_keeps_the_shape_of_s(curve: AnyCurve) -> None:
    s = np.linspace(0.0, curve.length, 6).reshape(2, 3)
    assert curve.point(s).shape == (2, 3, 2)
    assert curve.point(1.0).shape == (2,)
    assert curve.point([]).shape == (0, 2)
    assert curve.heading(s).shape == curve.curvature(s).shape == (2, 3)
    assert curve.heading(1.0).shape == ()
    np.testing.assert_array_equal(curve.point(s)[1, 2], curve.point(s[1, 2]))


@each_curve
def test_curves_are_frozen_and_their_rows_read_only(curve: AnyCurve) -> None:
    with pytest.raises(FrozenInstanceError):
        curve.start_heading = 1.0  # type: ignore[misc, union-attr]
    with pytest.raises(ValueError, match="read-only"):
        curve.rows[0, 0] = 1.0


def test_lines_and_inward_spirals_run_on_behind_their_start() -> None:
    for curve in (Line(1.0), Spiral(1.0, 20.0, 10.0)):
        assert curve.extension == math.inf
        before, after = curve.point([-1e-4, 1e-4])
        assert np.hypot(*(after - before)) == pytest.approx(2e-4, rel=1e-9)
        assert np.isfinite(curve.point(-1e6)).all()
    others = Arc(1.0, 1.0), Clothoid(1.0, 0.0, 1.0), LogSpiral(1.0, 0.2, 0.1), Spiral(1.0, 10.0, 20.0)
    for other in others:
        assert other.extension == 0.0


def test_the_extension_of_an_inward_spiral_is_the_same_spiral_farther_out() -> None:
    short, long = Spiral(1.7, 30.0, 9.0), Spiral(1.7, 60.0, 9.0)
    ahead = long.length - short.length
    s = np.linspace(-ahead, short.length, 17)
    np.testing.assert_allclose(short.point(s), long.point(s + ahead), rtol=0.0, atol=1e-12)


def test_only_the_first_curve_of_a_route_runs_on() -> None:
    assert Route.joined([Line(3.0), Arc(2.0, 1.0)]).extension == math.inf
    assert Route.joined([Arc(2.0, 1.0), Line(3.0)]).extension == 0.0
    assert Route.joined([Arc(2.0, 1.0), Spiral(1.0, 20.0, 10.0)]).extension == 0.0


@pytest.mark.parametrize(
    ("curve", "s", "wanted"),
    [
        (Arc(2.0, 1.0), -0.1, r"^s must lie between -?0 and 2 m, not at -0.1 m$"),
        (Arc(2.0, 1.0), 2.1, r"^s must lie between -?0 and 2 m, not at 2.1 m$"),
        (Line(5.0), 5.5, r"^s must lie between -inf and 5 m, not at 5.5 m$"),
        (Line(5.0), -math.inf, r"not at -inf m$"),
        (Spiral(1.0, 9.0, 4.0), math.inf, r"^s must lie between -inf and .* m, not at inf m$"),
        (Clothoid(1.0, 0.0, 1.0), math.nan, r"not at nan m$"),
        (Route((Line(5.0),)), [1.0, 2.0, 7.0, 8.0], r"not at 7 m$"),
    ],
)
def test_a_position_off_the_curve_is_refused(curve: Curve, s: float, wanted: str) -> None:
    for ask in (curve.point, curve.heading, curve.curvature):
        with pytest.raises(InputError, match=wanted):
            ask(s)


def test_a_position_in_words_is_refused() -> None:
    for ask in (CURVES["arc"].point, CURVES["arc"].heading, CURVES["arc"].curvature):
        with pytest.raises(InputError, match=r"must be (a number|numbers), not "):
            ask("half way")


def test_a_route_without_extension_says_that_it_begins_at_zero() -> None:
    with pytest.raises(InputError, match=r"between 0 and 2 m"):
        Arc(2.0, 1.0).point(-0.1)


WRONG: list[tuple[Callable[[], object], str]] = [
    (lambda: Line(0.0), r"length must be positive, not 0.0 m"),
    (lambda: Line(-2.0), r"length must be positive, not -2.0 m"),
    (lambda: Line(math.nan), r"length must be finite, not nan m"),
    (lambda: Line(math.inf), r"length must be finite, not inf m"),
    (lambda: Line("long"), r"length must be a number, not 'long'"),  # type: ignore[arg-type]
    (lambda: Line(2.0 * MOST_METRES), r"length must be at most 1e\+08 m, not 2e\+08 m"),
    (lambda: Line(1.0, (math.nan, 0.0)), r"start must be finite, not nan m"),
    (lambda: Line(1.0, (0.0, -2e8)), r"start .*must lie within 1e8 m of the origin"),
    (lambda: Line(1.0, (0.0, "y")), r"start must be a number, not 'y'"),  # type: ignore[arg-type]
    (lambda: Line(1.0, (0.0, 0.0), math.inf), r"heading must be finite, not inf rad"),
    (lambda: Arc(0.0, 1.0), r"radius must be positive, not 0.0 m"),
    (lambda: Arc(-1.0, 1.0), r"radius must be positive, not -1.0 m"),
    (lambda: Arc(math.nan, 1.0), r"radius must be finite, not nan m"),
    (lambda: Arc(1.0, 0.0), r"must .* 0$"),
    (lambda: Arc(1.0, math.inf), r"sweep must be finite, not inf rad"),
    (lambda: Arc(1.0, "left"), r"sweep must be a number, not 'left'"),  # type: ignore[arg-type]
    (lambda: Arc(1e8, 2.0), r"length must be at most 1e\+08 m, not 2e\+08 m"),
    (lambda: Arc(1.0, 1.0, (2e8, 0.0)), r"start .*must lie within 1e8 m of the origin"),
    (lambda: Spiral(0.0, 2.0, 1.0), r"pitch must be positive, not 0.0 m"),
    (lambda: Spiral(-0.55, 2.0, 1.0), r"pitch must be positive, not -0.55 m"),
    (lambda: Spiral(math.nan, 2.0, 1.0), r"pitch must be finite, not nan m"),
    (lambda: Spiral("wide", 2.0, 1.0), r"pitch must be a number, not 'wide'"),  # type: ignore[arg-type]
    (lambda: Spiral(1.0, -2.0, 1.0), r"start_angle must not be negative, but is -2 rad"),
    (lambda: Spiral(1.0, 2.0, -1.0), r"end_angle must not be negative, but is -1 rad"),
    (lambda: Spiral(1.0, math.nan, 1.0), r"start_angle must be finite, not nan rad"),
    (lambda: Spiral(1.0, 2.0, math.inf), r"end_angle must be finite, not inf rad"),
    (lambda: Spiral(1.0, 2.0, 2.0), r"a spiral must end at another angle than it starts at"),
    (lambda: Spiral(1.0, 1e9, 2.0), r"radius must be at most 1e\+08 m, not 1.59155e\+08 m"),
    (lambda: Spiral(1.0, 2.0, 1.0, (0.0, math.inf)), r"start must be finite, not inf m"),
    (lambda: Spiral(1.0, 2.0, 1.0, rotation=math.nan), r"heading must be finite, not nan rad"),
    (lambda: Spiral.between(-1.0, 9.0, 4.0), r"pitch must be positive, not -1.0 m"),
    (lambda: Spiral.between(1.0, -9.0, 4.0), r"start_radius must not be negative"),
    (lambda: Clothoid(0.0, 0.0, 1.0), r"length must be positive, not 0.0 m"),
    (lambda: Clothoid(1.0, math.nan, 1.0), r"start_curvature must be finite, not nan 1/m"),
    (lambda: Clothoid(1.0, 0.0, math.inf), r"end_curvature must be finite, not inf 1/m"),
    (lambda: Clothoid(2.0, 0.0, 1e4), r"a clothoid may sweep at most 10000 rad, not 20000 rad"),
    (lambda: Clothoid(1.0, 0.0, 1.0, (2e8, 0.0)), r"start .*must lie within 1e8 m of the origin"),
    (lambda: LogSpiral(0.0, 0.1, 1.0), r"length must be positive, not 0.0 m"),
    (lambda: LogSpiral(1.0, math.nan, 1.0), r"start_curvature must be finite, not nan 1/m"),
    (lambda: LogSpiral(1.0, 0.1, math.inf), r"end_curvature must be finite, not inf 1/m"),
    (lambda: LogSpiral(1.0, 0.0, 1.0), r"must have the same sign .* not be 0 and 1 1/m"),
    (lambda: LogSpiral(1.0, 1.0, 0.0), r"must have the same sign .* not be 1 and 0 1/m"),
    (lambda: LogSpiral(1.0, -0.1, 0.1), r"must have the same sign .* not be -0.1 and 0.1 1/m"),
    (lambda: LogSpiral(1.0, 1e-5, 1.0), r"differ by a factor of at most 10000, not be 1e-05 and 1 1/m"),
    (lambda: LogSpiral(1.0, 1.0, 1e-5), r"differ by a factor of at most 10000, not be 1 and 1e-05 1/m"),
    (
        lambda: LogSpiral(2.0, 1e3, 1e4),
        r"a logarithmic spiral may sweep at most 10000 rad, not 20000",
    ),
    (lambda: LogSpiral(1.0, 0.1, 1.0, (2e8, 0.0)), r"start .*must lie within 1e8 m of the origin"),
    (lambda: Route(()), r"a route needs at least one curve"),
    (lambda: Route.joined([]), r"a route needs at least one curve"),
    (lambda: Route.joined([Line(1.0), "bend"]), r"curve 2 must be a Line, .* not 'bend'"),  # type: ignore[list-item]
]


@pytest.mark.parametrize(("make", "wanted"), WRONG)
def test_a_curve_that_cannot_be_is_refused(make: Callable[[], object], wanted: str) -> None:
    with pytest.raises(InputError, match=wanted):
        make()


@pytest.mark.parametrize("spiral", [(1e-6, 1e12, 0.0), (1e-3, 1e10, 1.0)])
def test_a_spiral_too_long_for_micrometres_is_refused(spiral: tuple[float, float, float]) -> None:
    # As of an arc, what counts is its length and not its radius alone.
    with pytest.raises(InputError, match=r"length must be (at most 1e\+08 m|finite)"):
        Spiral(*spiral)


QUOTED: Any = "7"


@pytest.mark.parametrize(
    "make",
    [
        lambda: Line(QUOTED),
        lambda: Arc(QUOTED, 1.0),
        lambda: Arc(2.0, QUOTED),
        lambda: Spiral(QUOTED, 20.0, 10.0),
        lambda: Spiral.between(1.7, QUOTED, 4.5),
        lambda: Clothoid(QUOTED, 0.0, 1.0),
        lambda: LogSpiral(1.0, QUOTED, 1.0),
    ],
)
def test_numbers_in_quotes_are_refused(make: Callable[[], object]) -> None:
    with pytest.raises(InputError, match="must be a number, not '"):
        make()


def test_the_curve_to_copy_stands_in_the_files_that_the_manual_names() -> None:
    said = re.compile(r"log[-_ ]?spiral", re.IGNORECASE)
    files = [path for path in PACKAGE.rglob("*.py*") if path.suffix != ".pyc"]
    found = {str(path.relative_to(PACKAGE)) for path in files if said.search(path.read_text("utf-8"))}
    kernels = {"kernels/curve.py", "kernels/route_parts.py"}
    others = {
        "model/curves.py",
        "plans/tables.py",
        "proofs/ball_route.py",
        "proofs/parts.py",
        "__init__.pyi",
    }
    assert found == kernels | others


def test_a_gap_is_refused_and_names_the_joint_and_its_size() -> None:
    wanted = (
        r"^curves 2 and 3 do not meet: they are 0.05 m apart; Route.joined moves each to where the one "
    )
    with pytest.raises(InputError, match=wanted):
        Route((Line(1.0), Line(1.0, (1.0, 0.0)), Line(1.0, (2.0, 0.05))))
    with pytest.raises(InputError, match=wanted):
        Route((Line(1.0), Line(1.0, (1.0, 0.0)), Line(1.0, (2.0, 0.05))), kinks=True)


def test_a_kink_is_refused_and_names_the_joint_and_its_size() -> None:
    wanted = r"^curves 1 and 2 meet at a kink of 90 degrees; allow kinks or rotate one of them, as "
    with pytest.raises(InputError, match=wanted):
        Route((Line(1.0), Line(1.0, (1.0, 0.0), 0.5 * math.pi)))


def test_a_kink_is_allowed_when_asked_for() -> None:
    route = Route((Line(1.0), Line(1.0, (1.0, 0.0), 0.5 * math.pi)), kinks=True)
    assert route.heading(0.999) == 0.0
    assert route.heading(1.001) == 0.5 * math.pi
    assert tuple(route.point(2.0)) == pytest.approx((1.0, 1.0), abs=1e-15)


def test_headings_a_full_turn_apart_are_no_kink() -> None:
    route = Route((Line(1.0), Line(1.0, (1.0, 0.0), 4.0 * math.pi)))
    assert len(route.curves) == 2


@pytest.mark.parametrize(("gap", "sound"), [(0.5 * JOINT_GAP, True), (2.0 * JOINT_GAP, False)])
def test_a_joint_may_be_off_by_rounding_and_no_more(gap: float, sound: bool) -> None:
    for second in (Line(1.0, (1.0, gap)), Line(1.0, (1.0, 0.0), gap)):
        if sound:
            assert Route((Line(1.0), second)).length == 2.0
        else:
            with pytest.raises(InputError, match="curves 1 and 2"):
                Route((Line(1.0), second))


def test_a_route_joins_its_curves_end_to_end() -> None:
    route = Route.joined(list(CURVES.values()))
    assert isinstance(route.curves, tuple)
    assert route.joints[0] == 0.0
    assert len(route.joints) == len(route.curves) + 1
    assert route.joints[-1] == pytest.approx(route.length, rel=1e-15)
    np.testing.assert_allclose(np.diff(route.joints), [c.length for c in route.curves], rtol=1e-14)
    for start, curve in zip(route.joints, route.curves, strict=False):
        s = np.linspace(0.0, 0.999, 7) * curve.length
        np.testing.assert_allclose(route.point(start + s), curve.point(s), rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(route.curvature(start + s), curve.curvature(s), atol=1e-12)


def test_a_joined_route_begins_where_its_first_curve_does() -> None:
    first = Line(2.0, (3.0, 4.0), 0.5)
    assert Route.joined([first, Arc(1.0, 1.0)]).curves[0] is first


def test_the_curvature_at_a_joint_is_that_of_the_later_curve() -> None:
    route = Route.joined([Line(2.0), Arc(4.0, 1.0)])
    assert route.curvature(2.0) == 0.25
    assert route.curvature(2.0 - 1e-12) == 0.0


def test_a_list_of_curves_makes_a_route_as_well() -> None:
    curves = [Line(2.0), Line(2.0, (2.0, 0.0))]
    assert Route(curves) == Route(tuple(curves))  # type: ignore[arg-type]
