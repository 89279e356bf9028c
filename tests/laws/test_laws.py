"""Laws that hold for every dragon on every route whose curves are gentle enough for its benches."""

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
from hypothesis import assume, given
from hypothesis import strategies as st

from benchdragon import (
    Arc,
    Clothoid,
    Dragon,
    Line,
    LogSpiral,
    Motion,
    Route,
    SpeedProfile,
    Spiral,
    Status,
    Walk,
)
from benchdragon.kernels.curve import place
from benchdragon.kernels.route import locate
from benchdragon.model.curves import AnyCurve

Float = npt.NDArray[np.float64]

# Way of the head in one step of a central difference, in sizes of the tightest curve.
STEP = 0.02
# Times tried for differences; those at which a handle crosses a joint within a step are left out.
TRIED = 40
# What differences of positions, speeds and headings lose to rounding.
FLOOR = 2e-9


@dataclass(frozen=True)
class Dance:
    """A walk from one end of its route to the other within `duration` seconds."""

    walk: Walk
    duration: float
    # No radius of curvature of the route is shorter, m, nor the way on which one grows by as much.
    tightest: float

    @property
    def curves(self) -> list[AnyCurve]:
        return list(self.walk.route.curves)

    def on(self, route: Route) -> "Dance":
        """The same dance on another route of the same length."""
        return replace(self, walk=replace(self.walk, route=route))

    def motion(self, times: int = 16) -> Motion:
        return self.walk.motion(np.linspace(0.0, self.duration, times))


@st.composite
def dances(draw: st.DrawFn) -> Dance:
    """Curves of every kind, none of them tighter than two of the longest links."""
    count = draw(st.integers(1, 40))
    lengths = draw(st.lists(st.floats(0.3, 3.0), min_size=count, max_size=count))
    insets = draw(st.floats(0.0, 0.4))
    dragon = Dragon.of_sizes(np.array(lengths) + 2.0 * insets, 0.3, insets, insets)
    widest = 2.0 * max(lengths)
    bend = draw(st.floats(-1.0, 1.0)) / widest
    assume(abs(bend) * widest > 0.02)
    opened = bend * draw(st.floats(0.05, 1.0))
    opening = draw(st.floats(0.5, 15.0))
    growth = (1.0 / abs(opened) - 1.0 / abs(bend)) / opening
    last = draw(st.floats(-1.0, 1.0)) / widest
    pitch = draw(st.floats(0.5, 3.0))
    near = widest + pitch + draw(st.floats(0.0, 10.0))
    far = near + draw(st.floats(0.5, 15.0))
    start, end = (near, far) if draw(st.booleans()) else (far, near)
    first = Line(
        draw(st.floats(0.5, 20.0)),
        (draw(st.floats(-50.0, 50.0)), draw(st.floats(-50.0, 50.0))),
        draw(st.floats(-4.0, 4.0)),
    )
    route = Route.joined(
        [
            first,
            Clothoid(draw(st.floats(0.5, 15.0)), 0.0, bend),
            Arc(1.0 / abs(bend), math.copysign(draw(st.floats(0.1, 5.0)), bend)),
            LogSpiral(opening, bend, opened),
            Clothoid(draw(st.floats(0.5, 15.0)), opened, last),
            Line(draw(st.floats(0.5, 20.0))),
            Spiral.between(pitch, start, end, mirrored=draw(st.booleans())),
        ]
    )
    speeds = draw(st.floats(0.2, 2.0)), draw(st.floats(0.2, 2.0))
    duration = 2.0 * route.length / sum(speeds)
    profile = SpeedProfile((0.0, duration), speeds)
    tightest = widest / max(1.0, growth)
    return Dance(Walk(dragon, route, profile), duration * (1.0 - 1e-12), tightest)


shares = st.lists(st.floats(0.0, 1.0), min_size=2, max_size=8)


@given(dances())
def test_a_dragon_of_any_sizes_walks_a_gentle_route_of_every_kind_of_curve(dance: Dance) -> None:
    kinds = [type(curve) for curve in dance.curves]
    assert kinds == [Line, Clothoid, Arc, LogSpiral, Clothoid, Line, Spiral]
    motion = dance.motion(80)  # raises where a bench finds no place
    assert (motion.status == Status.OK).all()
    for table in (motion.x, motion.y, motion.s, motion.speed, motion.acceleration):
        assert np.isfinite(table).all()
    assert motion.speed_ratio.min() > 0.0


@given(dances())
def test_chords_keep_their_length(dance: Dance) -> None:
    motion = dance.motion()
    chords = np.hypot(np.diff(motion.x), np.diff(motion.y))
    links = np.tile(dance.walk.dragon.links, (len(motion.times), 1))
    np.testing.assert_allclose(chords, links, rtol=0.0, atol=1e-12)
    assert motion.chord_error == np.abs(chords - links).max()


@given(dances())
def test_handles_keep_their_order_along_the_route(dance: Dance) -> None:
    motion = dance.motion()
    # A chord is no longer than its arc: each handle is at least one link behind.
    behind = -np.diff(motion.s)
    assert (behind >= dance.walk.dragon.links * (1.0 - 1e-12)).all()
    # As the head walks on, so does every handle.
    assert (np.diff(motion.s, axis=0) > 0.0).all()


@given(dances())
def test_every_handle_stays_on_the_route(dance: Dance) -> None:
    placed = dance.walk.placement(np.linspace(0.0, dance.walk.route.length, 16))
    rows, us, xs, ys = (table.ravel() for table in placed.tables)
    for j, u, x, y in zip(rows, us, xs, ys, strict=True):
        there = place(dance.walk.route.rows, int(j), float(u))
        assert math.hypot(there[0] - x, there[1] - y) <= 1e-12


@given(dances())
def test_route_positions_are_those_of_the_handles(dance: Dance) -> None:
    motion = dance.motion()
    points = dance.walk.route.point(motion.s)
    # Route positions are rounded: at 4 km neighbouring doubles are 9e-13 m apart.
    rounding = 1e-12 + np.spacing(dance.walk.route.length)
    assert np.hypot(points[..., 0] - motion.x, points[..., 1] - motion.y).max() <= rounding


@given(dances(), shares)
def test_tangents_are_unit_vectors_along_the_heading(dance: Dance, at: list[float]) -> None:
    route = dance.walk.route
    for s in np.array([-3.0, *at]) * route.length:
        j, u, _status = locate(route.rows, s)
        _x, _y, tx, ty = place(route.rows, j, u)
        assert abs(math.hypot(tx, ty) - 1.0) <= 4e-16
        heading = float(route.heading(s))
        assert math.hypot(tx - math.cos(heading), ty - math.sin(heading)) <= 1e-13


@given(dances(), shares)
def test_arc_lengths_add(dance: Dance, at: list[float]) -> None:
    route = dance.walk.route
    total = math.fsum(curve.length for curve in route.curves)
    assert abs(route.length - total) <= 1e-13 * total
    # A polygon with its corners on the route is shorter, and the less so the finer it is.
    a, b = min(at) * route.length, max(at) * route.length
    assume(b - a > 1e-3)
    kappa = float(np.abs(route.curvature(np.linspace(0.0, route.length, 500))).max()) * 1.1
    for count in (500, 2000):
        corners = route.point(np.linspace(a, b, count + 1))
        polygon = float(np.hypot(*np.diff(corners, axis=0).T).sum())
        short = (b - a) * (kappa * (b - a) / count) ** 2 / 24.0
        assert b - a - 1.01 * short - 1e-11 <= polygon <= b - a + 1e-11


@given(dances())
def test_joins_meet(dance: Dance) -> None:
    route = dance.walk.route
    for joint, before, after in zip(route.joints[1:-1], route.curves, route.curves[1:], strict=False):
        (ax, ay), a = before.end_pose
        (bx, by), b = after.start_pose
        assert math.hypot(bx - ax, by - ay) <= 1e-12
        assert abs(math.remainder(b - a, 2.0 * math.pi)) <= 1e-12
        here, there = route.point([joint - 1e-9, joint + 1e-9])
        assert abs(math.hypot(*(there - here)) - 2e-9) <= 1e-12


@given(dances(), st.floats(-100.0, 100.0), st.floats(-100.0, 100.0), st.floats(-7.0, 7.0))
def test_a_moved_and_turned_route_gives_the_same_speeds(
    dance: Dance, x: float, y: float, heading: float
) -> None:
    first, *rest = dance.curves
    moved = dance.on(Route.joined([first.moved((x, y), heading), *rest]))
    a, b = dance.motion(), moved.motion()
    for name in ("s", "speed", "acceleration", "turning_rate"):
        np.testing.assert_allclose(
            getattr(a, name), getattr(b, name), rtol=0.0, atol=1e-10, err_msg=name
        )
    # And the places are those of the first, moved and turned.
    turn = heading - first.start_pose[1]
    z = (a.x - first.start_pose[0][0]) + 1j * (a.y - first.start_pose[0][1])
    wanted = complex(x, y) + z * np.exp(1j * turn)
    np.testing.assert_allclose(b.x + 1j * b.y, wanted, rtol=0.0, atol=1e-10)


def mirrored(curve: AnyCurve) -> AnyCurve:
    """The curve seen in a mirror, to be joined."""
    match curve:
        case Line():
            return curve
        case Arc():
            return Arc(curve.radius, -curve.sweep)
        case Clothoid():
            return Clothoid(curve.length_m, -curve.start_curvature, -curve.end_curvature)
        case LogSpiral():
            return LogSpiral(curve.length_m, -curve.start_curvature, -curve.end_curvature)
        case Spiral():
            return Spiral(curve.pitch, curve.start_angle, curve.end_angle, mirrored=not curve.mirrored)


@given(dances())
def test_a_mirrored_route_gives_the_same_speeds_and_opposite_turns(dance: Dance) -> None:
    other = dance.on(Route.joined([mirrored(curve) for curve in dance.curves]))
    a, b = dance.motion(), other.motion()
    for name, sign in (("s", 1.0), ("speed", 1.0), ("acceleration", 1.0), ("turning_rate", -1.0)):
        np.testing.assert_allclose(
            getattr(a, name), sign * getattr(b, name), rtol=0.0, atol=1e-10, err_msg=name
        )


@given(dances(), st.floats(0.25, 3.0))
def test_speeds_are_in_proportion_to_the_head_s(dance: Dance, factor: float) -> None:
    walk, times = dance.walk, np.linspace(0.0, dance.duration, 9)
    profile = SpeedProfile(
        tuple(t / factor for t in walk.profile.times), tuple(v * factor for v in walk.profile.speeds)
    )
    faster = Walk(walk.dragon, walk.route, profile).motion(times / factor * (1.0 - 1e-13))
    motion = walk.motion(times)
    np.testing.assert_allclose(faster.s, motion.s, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(faster.speed, factor * motion.speed, rtol=1e-9)


def around(dance: Dance) -> tuple[list[Motion], float]:
    """Motions at -h, -h/2, 0, h/2, h about times at which no handle crosses a joint; and h."""
    h = STEP * dance.tightest / max(dance.walk.profile.speeds)
    tried = np.linspace(2.0 * h, dance.duration - 2.0 * h, TRIED)
    shifts = h * np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
    ends = [dance.walk.motion(tried + shift).s for shift in (-h, h)]
    parts = [np.searchsorted(dance.walk.route.joints, s, side="right") for s in ends]
    smooth = (parts[0] == parts[1]).all(axis=1)  # handles only walk forward
    assume(smooth.any())
    return [dance.walk.motion(tried[smooth] + shift) for shift in shifts], h


def check_central_differences(dance: Dance, table: str, rate: str) -> None:
    """Central differences of a table miss its rate by an error of second order in their step."""
    motions, h = around(dance)
    values = [getattr(motion, table) for motion in motions]
    if table == "heading":
        values = list(np.unwrap(np.array(values), axis=0))
    exact = getattr(motions[2], rate)
    wide = np.abs((values[4] - values[0]) / (2.0 * h) - exact).max(axis=1)
    narrow = np.abs((values[3] - values[1]) / h - exact).max(axis=1)
    # The error is of size STEP^2 beside the motion itself, and what follows it of size STEP^4.
    speed = max(dance.walk.profile.speeds)
    size = speed * (1.0 + speed / dance.tightest)
    after = 3.0 * size * STEP**4 + FLOOR
    assert (wide <= 0.01 * size).all()
    assert (narrow <= 0.26 * wide + after).all()
    assert (narrow >= 0.24 * wide - after).all()


@given(dances())
def test_speeds_are_central_differences_of_positions_to_second_order(dance: Dance) -> None:
    check_central_differences(dance, "s", "speed")


@given(dances())
def test_accelerations_are_central_differences_of_speeds_to_second_order(dance: Dance) -> None:
    check_central_differences(dance, "speed", "acceleration")


@given(dances())
def test_turning_rates_are_central_differences_of_headings_to_second_order(dance: Dance) -> None:
    check_central_differences(dance, "heading", "turning_rate")
