"""Point, tangent, heading and curvature of one piece, each against another method."""

import math
from fractions import Fraction

import mpmath as mp
import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad

from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import RouteRow
from benchdragon.kernels.route import locate
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line, LogSpiral, Route, Spiral
from tests.kernels.reference import points

CURVES: dict[str, AnyCurve] = {
    "line": Line(7.0, (1.0, -2.0), 0.7),
    "left arc": Arc(3.0, 2.5, (4.0, 1.0), -2.0),
    "right arc beyond a full turn": Arc(0.5, -9.0, (0.0, 1.0), 1.0),
    "arc that hardly bends": Arc(1e7, 1e-6, (0.0, 1.0), 1.0),
    "clothoid": Clothoid(6.0, 0.1, -0.4, (1.0, 1.0), 0.3),
    "clothoid of many rows": Clothoid(20.0, -1.5, 2.0, (-3.0, 5.0), 2.0),
    "clothoid that leaves a line": Clothoid(5.0, 0.0, 0.3),
    "logarithmic spiral that opens": LogSpiral(14.0, 0.5, 0.15, (1.0, -2.0), 0.4),
    "logarithmic spiral that winds up": LogSpiral(9.0, -0.25, -0.7, (0.0, 3.0), -2.0),
    "spiral in": Spiral(1.7, 30.0, 9.0),
    "spiral out": Spiral(1.7, 2.0, 30.0),
    "spiral in, mirrored": Spiral(0.55, 60.0, 5.0, (2.0, 3.0), 0.4, mirrored=True),
    "spiral out, mirrored": Spiral(0.55, 5.0, 60.0, (-2.0, 3.0), -2.4, mirrored=True),
    "spiral in, turned and shifted": Spiral(3.0, 12.0, 3.0, (10.0, -20.0), 1.9),
}
each_curve = pytest.mark.parametrize("curve", CURVES.values(), ids=list(CURVES))


def inner(curve: AnyCurve) -> npt.NDArray[np.float64]:
    return np.linspace(0.03, 0.97, 13) * curve.length


def derivative(values: npt.NDArray[np.float64], h: float) -> npt.NDArray[np.float64]:
    """First derivative of fourth order from values at -2h, -h, h, 2h along the last axis."""
    far, near = values[..., 3] - values[..., 0], values[..., 2] - values[..., 1]
    return np.asarray((8.0 * near - far) / (12.0 * h))


def around(s: npt.NDArray[np.float64], h: float) -> npt.NDArray[np.float64]:
    return s[:, np.newaxis] + h * np.array([-2.0, -1.0, 1.0, 2.0])


@each_curve
def test_points_agree_with_the_reference(curve: AnyCurve) -> None:
    s = np.linspace(0.0, 1.0, 25) * curve.length
    found = curve.point(s)
    wanted = points(Route((curve,)), s)
    tolerance = 2e-14 * (1.0 + curve.length)
    np.testing.assert_allclose(found[:, 0] + 1j * found[:, 1], wanted, rtol=0.0, atol=tolerance)


@each_curve
def test_the_heading_is_the_direction_in_which_points_move(curve: AnyCurve) -> None:
    s, h = inner(curve), 2e-3
    velocity = derivative(np.moveaxis(curve.point(around(s, h)), -1, 0), h)
    heading = curve.heading(s)
    np.testing.assert_allclose(velocity[0], np.cos(heading), rtol=0.0, atol=2e-10)
    np.testing.assert_allclose(velocity[1], np.sin(heading), rtol=0.0, atol=2e-10)


@each_curve
def test_the_curvature_is_the_rate_of_the_heading(curve: AnyCurve) -> None:
    s, h = inner(curve), 2e-3
    np.testing.assert_allclose(
        curve.curvature(s), derivative(curve.heading(around(s, h)), h), rtol=0.0, atol=2e-9
    )


@each_curve
def test_the_slope_is_the_rate_of_the_curvature(curve: AnyCurve) -> None:
    s, h, rows = inner(curve), 2e-3, Route((curve,)).rows
    slopes = [kernel.bend_slope(rows, *locate(rows, one)[:2]) for one in s.tolist()]
    rates = np.abs(derivative(curve.curvature(around(s, h)), h))
    np.testing.assert_allclose(slopes, rates, rtol=1e-8, atol=1e-11)


@each_curve
def test_the_tangent_is_a_unit_vector_along_the_heading(curve: AnyCurve) -> None:
    rows = curve.rows
    for j in range(len(rows)):
        for u in np.linspace(rows[j, RouteRow.U_START], rows[j, RouteRow.U_END], 5):
            _x, _y, tx, ty = kernel.place(rows, j, u)
            heading = kernel.heading(rows, j, u)
            assert math.hypot(tx, ty) == pytest.approx(1.0, rel=0.0, abs=4e-16)
            assert tx == pytest.approx(math.cos(heading), rel=0.0, abs=4e-14)
            assert ty == pytest.approx(math.sin(heading), rel=0.0, abs=4e-14)


@each_curve
def test_the_tangent_is_as_long_as_1_but_for_its_own_rounding(curve: AnyCurve) -> None:
    for j, row in enumerate(curve.rows):
        for u in np.linspace(row[RouteRow.U_START], row[RouteRow.U_END], 301).tolist():
            _x, _y, tx, ty = kernel.place(curve.rows, j, u)
            assert abs(Fraction(tx) ** 2 + Fraction(ty) ** 2 - 1) <= 5e-16


@each_curve
def test_arc_length_and_parameter_are_inverse(curve: AnyCurve) -> None:
    rows = curve.rows
    for j in range(len(rows)):
        for share in (0.0, 0.1, 0.5, 0.99, 1.0):
            length = share * rows[j, RouteRow.LENGTH]
            u = kernel.parameter_at(rows, j, length)
            assert kernel.length_at(rows, j, u) == pytest.approx(length, rel=1e-14, abs=1e-12)
        low, high = sorted((rows[j, RouteRow.U_START], rows[j, RouteRow.U_END]))
        assert low <= kernel.parameter_at(rows, j, 0.3 * rows[j, RouteRow.LENGTH]) <= high


@each_curve
def test_the_stretch_is_the_arc_length_per_unit_of_the_parameter(curve: AnyCurve) -> None:
    rows = curve.rows
    start, end = rows[0, RouteRow.U_START], rows[0, RouteRow.U_END]
    h = 1e-3
    for u in np.linspace(start, end, 7)[1:-1]:
        lengths = np.array([kernel.length_at(rows, 0, u + i * h) for i in (-2, -1, 1, 2)])
        rate = abs(float(derivative(lengths, h)))
        assert kernel.stretch(rows, 0, u) == pytest.approx(rate, rel=1e-9)
    assert kernel.walks_up(rows, 0) == math.copysign(1.0, end - start)


@each_curve
def test_no_heading_swings_by_more_than_the_turning_bound(curve: AnyCurve) -> None:
    rows = curve.rows
    start, end = rows[0, RouteRow.U_START], rows[0, RouteRow.U_END]
    for a, b in ((start, end), (end, start), (0.3 * start + 0.7 * end, 0.6 * start + 0.4 * end)):
        headings = np.array([kernel.heading(rows, 0, u) for u in np.linspace(a, b, 60)])
        swing = float(np.abs(np.diff(headings)).sum())
        bound = kernel.turning_bound(rows, 0, a, b)
        assert bound >= swing * (1.0 - 1e-12) - 1e-13
        # And it is of use: over a short way it is nearly what the heading turns by.
        near = a + 1e-6 * (b - a)
        turned = abs(kernel.heading(rows, 0, near) - kernel.heading(rows, 0, a))
        assert kernel.turning_bound(rows, 0, a, near) <= turned * 1.01 + 1e-5 * bound


@given(
    st.floats(0.1, 40.0),
    st.floats(-2.0, 2.0),
    st.floats(-2.0, 2.0),
    st.floats(0.0, 1.0),
)
def test_any_clothoid_is_made_of_fresnel_integrals(
    length: float, first: float, last: float, share: float
) -> None:
    assume(abs(last - first) > 0.05)
    clothoid = Clothoid(length, first, last, (1.0, 2.0), 0.5)
    x, y = clothoid.point(share * length)
    wanted = complex(points(Route((clothoid,)), share * length)[0])
    assert abs(complex(x, y) - wanted) <= 1e-14 * (4.0 + length)


@pytest.mark.parametrize(
    ("first", "last"), [(0.0, 2.0), (0.0, -2.0), (1.0, 1.9), (-1.9, 1.9), (2.0, 0.0), (0.3, 0.3)]
)
def test_one_clothoid_row_is_exact_to_rounding(first: float, last: float) -> None:
    clothoid = Clothoid(1.0, first, last)
    assert len(clothoid.rows) == 1
    for u in (0.2, 0.7, 1.0):

        def tangent(s: object) -> object:
            return mp.expj(s * (mp.mpf(first) + (mp.mpf(last) - first) * s / 2))

        exact = complex(mp.quad(tangent, [0, u]))
        assert abs(complex(*kernel.place(clothoid.rows, 0, u)[:2]) - exact) <= 4e-16


@pytest.mark.parametrize("bend", [1.3, -0.4, 1e-3, 2e-8])
def test_an_arc_is_a_clothoid_whose_curvature_stays(bend: float) -> None:
    length = 1.5
    arc = Arc(1.0 / abs(bend), bend * length, (1.0, 2.0), 0.5)
    clothoid = Clothoid(length, bend, bend, (1.0, 2.0), 0.5)
    for u in np.linspace(0.0, length, 7):
        on_arc = np.array(kernel.place(arc.rows, 0, u))
        np.testing.assert_allclose(on_arc, kernel.place(clothoid.rows, 0, u), rtol=0.0, atol=1e-15)
        assert kernel.curvature(arc.rows, 0, u) == pytest.approx(kernel.curvature(clothoid.rows, 0, u))


@pytest.mark.parametrize(
    "x", [0.0, 1e-300, 1e-9, 9.99e-4, 1e-3, 1.001e-3, 0.01, 0.09, 1.0, 3.0, 3.2, 40.0, -9.9e-4, -2.0]
)
def test_sinc_is_right_to_rounding_on_both_sides_of_its_series(x: float) -> None:
    exact = float(mp.sin(mp.mpf(x)) / mp.mpf(x)) if x else 1.0
    assert kernel.sinc(x, math.sin(x)) == pytest.approx(exact, rel=3e-16, abs=1e-17)


@pytest.mark.parametrize("theta", [0.0, 1e-9, 1e-3, 0.5, 1.0, 10.0, 16 * math.pi, 1e3])
def test_the_length_of_a_spiral_is_the_integral_of_its_speed(theta: float) -> None:
    k = 0.55 / (2.0 * math.pi)
    integral, _ = quad(lambda a: k * math.sqrt(1.0 + a * a), 0.0, theta, epsabs=0.0, epsrel=1e-13)
    assert kernel.spiral_length(k, theta) == pytest.approx(integral, rel=1e-13, abs=1e-300)


@given(st.floats(0.0, 1e6), st.floats(1e-3, 10.0))
def test_the_angle_of_a_length_gives_that_length_back(theta: float, k: float) -> None:
    length = kernel.spiral_length(k, theta)
    assert kernel.spiral_angle(k, length) == pytest.approx(theta, rel=2e-15, abs=1e-300)


@pytest.mark.parametrize("length", [0.0, 1e-300, 1e-12, 1e-3, 1.0, 1e6, 1e15])
def test_the_angle_is_found_from_the_centre_to_far_outside(length: float) -> None:
    k = 0.1
    theta = kernel.spiral_angle(k, length)
    with mp.workdps(40):
        a = mp.mpf(theta)
        exact = mp.mpf(k) * (a * mp.sqrt(1 + a * a) + mp.asinh(a)) / 2
        assert abs(exact - length) <= 8e-16 * length


def test_a_place_behind_an_inward_spiral_lies_farther_out() -> None:
    spiral = Spiral(0.55, 20.0, 10.0)
    u = kernel.parameter_at(spiral.rows, 0, -3.0)
    assert u > 20.0
    assert kernel.length_at(spiral.rows, 0, u) == pytest.approx(-3.0, abs=1e-13)


def test_a_length_beyond_the_centre_stays_at_the_centre() -> None:
    spiral = Spiral(0.55, 20.0, 0.0)
    assert kernel.parameter_at(spiral.rows, 0, spiral.length + 1.0) == 0.0


@given(
    st.floats(0.1, 40.0),
    st.floats(-3.0, 3.0).filter(lambda bend: abs(bend) > 1e-3),
    st.floats(-3.0, 3.0),
    st.floats(0.0, 1.0),
)
def test_any_logarithmic_spiral_is_the_integral_of_its_tangent(
    length: float, first: float, winding: float, share: float
) -> None:
    """From nearly an arc on to a hundredfold of its curvature, against 40 digits of the definition."""
    last = first * math.exp(1.5 * winding)
    assume(length * abs(last) < 1e3)
    spiral = LogSpiral(length, first, last, (1.0, 2.0), 0.5)
    s = share * length
    with mp.workdps(40):
        gain = (mp.mpf(first) / mp.mpf(last) - 1) / mp.mpf(length)
        turn = mp.log1p(gain * s) * first / gain if gain else mp.mpf(first) * s
        radius = (1 + gain * s) / first
        lean = gain / first + 1j  # the point goes round the pole as the radius grows
        wanted = complex(mp.expj(0.5) * (radius * mp.expj(turn) - 1 / mp.mpf(first)) / lean) + 1 + 2j
    near = 2e-14 * (1.0 + length)
    assert abs(complex(*spiral.point(s)) - wanted) <= near
    assert float(spiral.heading(s)) == pytest.approx(0.5 + float(turn), rel=1e-13, abs=1e-13)
    assert float(spiral.curvature(s)) == pytest.approx(float(1 / radius), rel=1e-12)


@pytest.mark.parametrize("bend", [1.3, -0.4, 1e-3, 2e-8])
def test_a_logarithmic_spiral_whose_radius_stays_is_an_arc(bend: float) -> None:
    length = 1.5
    arc = Arc(1.0 / abs(bend), bend * length, (1.0, 2.0), 0.5)
    for last in (bend, bend * (1.0 + 1e-15)):
        spiral = LogSpiral(length, bend, last, (1.0, 2.0), 0.5)
        for u in np.linspace(0.0, length, 7):
            on_arc = np.array(kernel.place(arc.rows, 0, u))
            np.testing.assert_allclose(kernel.place(spiral.rows, 0, u), on_arc, rtol=0.0, atol=4e-15)


@pytest.mark.parametrize("winding", [1e4, 1e-4])
@pytest.mark.parametrize("bend", [1.0, -1e-3])
def test_the_tightest_logarithmic_spiral_arrives_at_its_last_curvature(
    bend: float, winding: float
) -> None:
    spiral = LogSpiral(0.5 / abs(bend), bend, bend * winding)
    assert float(spiral.curvature(spiral.length)) == pytest.approx(bend * winding, rel=1e-11)
    ahead, behind = spiral.point([spiral.length, spiral.length * (1.0 - 1e-6)])
    wanted = points(Route((spiral,)), [spiral.length, spiral.length * (1.0 - 1e-6)])
    assert abs(complex(*ahead) - wanted[0]) <= 1e-13 * spiral.length
    assert abs(complex(*behind) - wanted[1]) <= 1e-13 * spiral.length
