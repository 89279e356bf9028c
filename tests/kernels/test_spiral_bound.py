"""The bound by which turns of a spiral keep apart, against benches placed one by one."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from benchdragon import Dragon, Route, Spiral, Walk
from benchdragon.analysis.contact import first_contact, least_clearance
from benchdragon.kernels import search_room
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, set_box
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.spiral_bound import (
    Shape,
    clear_radius,
    clear_spans,
    follows_outside,
    shape_of,
)
from tests.kernels.tried_walks import begun_without_spans
from tests.solve.asked_in_python import in_python

CONTEST = Dragon.uniform()
ONE = np.zeros(1, dtype=np.int64)
HEAD, BODY = (shape_of(CONTEST.sizes[:, n].reshape(4, 1).copy(), ONE, 0, 0.0) for n in (0, 1))
BETWEEN = 1.65


def boxes(b: float, sizes: FloatArray, thetas: FloatArray) -> FloatArray:
    """One bench with its inner handle at each theta of r = b theta, as boxes, (thetas, columns)."""
    out = np.empty((len(thetas), BOX_COLUMNS))
    column = np.asarray(sizes, dtype=np.float64).reshape(4, 1)
    link = float(column[0, 0] - column[2, 0] - column[3, 0])
    for n, inner in enumerate(thetas):
        point = b * inner * np.exp(1j * inner)

        def excess(theta: float, point: complex = point) -> float:
            return float(abs(b * theta * np.exp(1j * theta) - point)) - link

        outer = brentq(excess, inner, inner + 2.0 * math.asin(0.5 * link / (b * inner)) + 1e-9)
        other = b * outer * np.exp(1j * outer)
        x, y = np.array([[point.real], [other.real]]), np.array([[point.imag], [other.imag]])
        set_box(column, 0, x, y, 0, out, n)
    return out


def spans_of(route: Route, ahead: Shape, behind: Shape, between: float) -> FloatArray:
    """The clear spans of a route, m, (spans, 2)."""
    spans = np.empty((len(route.rows), 2))
    return spans[: clear_spans(route.rows, ahead, behind, between, spans)]


def nearest(b: float, radius: float, inner: FloatArray, outer: FloatArray) -> float:
    """The least distance of two benches, one turn apart, the inner one's handle at `radius`, m."""
    theta = radius / b
    others = theta + 2.0 * math.pi + np.linspace(-1.0, 1.0, 401)
    table = np.concatenate([boxes(b, inner, np.array([theta])), boxes(b, outer, others)])
    return min(box_distance(table, 0, n) for n in range(1, len(table)))


@pytest.mark.parametrize("seed", range(12))
def test_outside_of_the_radius_no_two_benches_come_near(seed: int) -> None:
    rng = np.random.default_rng(seed)
    length, inset = rng.uniform(1.2, 3.5, 2), rng.uniform(0.0, 0.25)
    sizes = np.array([[size, rng.uniform(0.1, 0.4), inset, inset] for size in length])
    reach, b = rng.uniform(0.0, 0.1), rng.uniform(0.8, 2.5) / (2.0 * math.pi)
    inner, outer = (shape_of(row.reshape(4, 1), ONE, 0, 0.5 * reach) for row in sizes)
    radius = clear_radius(b, inner, outer, float((length - 2.0 * inset).min()))
    assert math.isfinite(radius)
    near = [nearest(b, radius * factor, *sizes) for factor in (1.0, 1.01, 1.1, 1.5, 3.0)]
    assert min(near) >= reach


def test_the_bound_is_near_the_truth() -> None:
    b, (head, body) = 0.55 / (2.0 * math.pi), CONTEST.sizes[:, :2].T
    radius = clear_radius(b, HEAD, BODY, BETWEEN)
    assert 2.5 < radius < 3.1
    assert 0.0 < nearest(b, radius, head, body) < 0.05
    assert nearest(b, 2.2, head, body) < 0.0  # where benches touch there is no clear span


def test_narrow_turns_are_clear_only_where_benches_keep_apart() -> None:
    sizes = np.array([1.4, 0.3, 0.2, 0.2])
    b, shape = 0.42 / (2.0 * math.pi), shape_of(sizes.reshape(4, 1), ONE, 0, 0.0)
    radius = clear_radius(b, shape, shape, 1.0)
    assert radius < 2.5
    assert nearest(b, 1.07, sizes, sizes) < 0.0 < nearest(b, radius, sizes, sizes)


def test_parts_of_a_route() -> None:
    inward = Spiral(0.55, 32.0 * math.pi, 0.0)
    route = Route((inward,))
    ((start, end),) = spans_of(route, HEAD, BODY, BETWEEN)
    radius = float(np.hypot(*route.point(end)))
    assert start == -math.inf
    assert radius == pytest.approx(clear_radius(inward.k, HEAD, BODY, BETWEEN), rel=1e-12)
    outward = Route((Spiral(0.55, 8.0 * math.pi, 64.0 * math.pi),))
    ((start, end),) = spans_of(outward, HEAD, BODY, BETWEEN)
    assert end == outward.length
    # The rear handle may stand a link behind, nearer to the centre, and is outside the radius too.
    assert float(np.hypot(*outward.point(start))) > clear_radius(inward.k, BODY, HEAD, BETWEEN)
    narrow = Route((Spiral(0.3, 32.0 * math.pi, 0.0),))
    assert spans_of(narrow, HEAD, BODY, BETWEEN).shape == (0, 2)
    short = Route((Spiral(0.55, 12.0 * math.pi, 0.0),))
    assert np.isneginf(spans_of(short, HEAD, BODY, BETWEEN)[0, 0])


@pytest.mark.compiled
@pytest.mark.parametrize(
    ("spiral", "start", "end"),
    [
        (Spiral(0.55, 24.0 * math.pi, 0.0), 0.0, 230.0),
        (Spiral(0.6, 10.0 * math.pi, 24.0 * math.pi), 110.0, 70.0),
    ],
)
def test_answers_are_the_same_without_the_bound(
    monkeypatch: pytest.MonkeyPatch, spiral: Spiral, start: float, end: float
) -> None:
    walk = Walk(Dragon.uniform(60), Route((spiral,)), start=start)
    answers = []
    for _turn in range(2):
        answers.append((first_contact(walk, 0.0, end), least_clearance(walk, 0.0, 60.0)))
        in_python(monkeypatch)
        monkeypatch.setattr(search_room, "begin_walk", begun_without_spans)
    (contact, least), (other, other_least) = answers
    assert least.value == pytest.approx(other_least.value, abs=1e-12)
    assert (contact is None) == (other is None) == (spiral.end_angle > spiral.start_angle)
    if contact is not None and other is not None:
        assert contact.value == pytest.approx(other.value, abs=2e-11)


def test_benches_that_reach_past_the_link_between_have_no_clear_span() -> None:
    short, long = Shape(1.0, 1.0, 0.3, 0.1), Shape(1.0, 1.0, 0.6, 0.1)
    assert math.isfinite(clear_radius(0.2, short, short, 1.0))
    assert clear_radius(0.2, long, long, 1.0) == math.inf


def test_benches_that_may_leap_have_no_clear_span() -> None:
    shape = Shape(1.0, 1.0, 0.1, 0.1)
    assert follows_outside(shape, 1.0, 3.0)
    assert not follows_outside(shape, 2.0, 1.01)
    assert not follows_outside(shape, 0.1, 0.99)
