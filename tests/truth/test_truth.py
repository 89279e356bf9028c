"""The reference finds the kept values again, and agrees with the package on random dragons."""

import ast
import json
import math
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import benchdragon as bd
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, box_gap, boxes_at
from benchdragon.plans.schema import Plan, checked
from benchdragon.solve.size import limit
from tests.truth import make_truth, reference, scan
from tests.truth.make_truth import spiral_entries, turn_entries, turn_summary
from tests.truth.reference import Bench

HERE = Path(__file__).parent
TRUTH = json.loads((HERE / "contest.json").read_text(encoding="utf-8"))
DIGITS = 30


@pytest.fixture(autouse=True)
def digits() -> Iterator[None]:
    with mp.workdps(DIGITS):
        yield


def difference(a: str, b: str) -> float:
    return abs(float(mp.mpf(a) - mp.mpf(b)))


def test_the_second_road_shares_nothing_with_the_package() -> None:
    paths = [path for path in HERE.glob("*.py") if path.name != Path(__file__).name]
    assert {path.stem for path in paths} >= {"make_truth", "reference", "scan"}
    known = {*sys.stdlib_module_names, "mpmath", "numpy", "tests.truth"} - {"importlib"}
    for path in paths:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom):
                assert node.level == 0
                names = [str(node.module)]
            for name in names:
                room = ".".join(name.split(".")[: 2 if name.startswith("tests") else 1])
                assert room in known, f"{path.name} imports {name}"


# The values kept; `make truth` makes all of them again.


@pytest.mark.parametrize("handle", [0, 1, 51])
def test_the_spiral_walk_is_found_again_by_small_steps(handle: int) -> None:
    found = spiral_entries(300, (handle,))[str(handle)]
    kept = TRUTH["spiral_in_055"]["300"][str(handle)]
    assert max(map(difference, found, kept)) <= 1e-15


@pytest.mark.parametrize(("t", "handle"), [(-50, 1), (0, 0), (0, 1), (14, 1), (14, 51), (50, 1)])
def test_the_walk_through_the_turn_is_found_again_by_small_steps(t: int, handle: int) -> None:
    found = turn_entries(t, (handle,))[str(handle)]
    kept = TRUTH["two_arc_motion"][str(t)][str(handle)]
    assert max(map(difference, found, kept)) <= 1e-15


def test_the_two_arcs_are_found_again_from_their_tangency() -> None:
    assert make_truth.difference(turn_summary(), TRUTH["two_arc"])[0] <= 1e-15


def test_the_first_contact_is_found_again() -> None:
    # The benches that touch are among the first 25, and those stand as they do in the whole dragon.
    theta = 2 * make_truth.TURNS * mp.pi
    point, rough = reference.spiral_walk("0.55", theta), scan.spiral_walk(0.55, float(theta))
    found = make_truth.first_contact(point, rough, reference.contest_dragon(25), 390.0, 430.0)
    assert found is not None
    assert found[1] == (1, 9)
    assert difference(found[0], TRUTH["first_contact_s"]) <= 1e-15


def test_the_first_touch_of_the_box_is_found_again() -> None:
    head, bench = make_truth.box_touch(reference.contest_dragon(12), 370.0, 380.0)
    assert str(bench) == TRUTH["box_touch"]["bench"]
    assert difference(head, TRUTH["box_touch"]["s"]) <= 1e-15


def test_the_scan_of_a_box_finds_its_touch_and_says_where_it_is_unsure() -> None:
    def east(s: scan.Floats) -> scan.Complexes:
        return s.astype(np.complex128)

    box = np.array([10.5 + 0.2j, 9.5 + 0.2j, 9.5 - 0.2j, 10.5 - 0.2j])
    dragon = make_truth.benches([Bench(2.0, 0.5, 0.25, 0.25)])
    look = scan.first_at_box(east, dragon, box, 0.0, 20.0)
    assert look is not None
    assert look.pair == (1, 0)
    assert look.head == pytest.approx(9.25, abs=0.051)
    assert scan.first_at_box(east, dragon, box + 3j, 0.0, 20.0) is None

    def ring(s: scan.Floats) -> scan.Complexes:
        return np.asarray(5.0 * np.exp(0.2j * s))

    # A speck a tenth of a millimetre within the ring that the bench's outer corners draw.
    outermost = math.hypot(math.sqrt(25.0 - 0.75**2) + 0.25, 1.0)
    square = np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j], dtype=np.complex128)
    with pytest.raises(ArithmeticError, match="look closer at bench 1"):
        scan.first_at_box(ring, dragon, outermost + 1e-4 * square, 15.7, 40.0, 0.4)


def test_the_smallest_pitch_is_found_again() -> None:
    family = make_truth.PitchFamily(reference.contest_dragon(40), "4.5", 16)
    found = make_truth.smallest_pitch(family, 0.5, 0.2)
    assert found.pair == (1, 20)
    assert difference(found.pitch, TRUTH["smallest_pitch_m"]) <= 1e-15
    assert difference(found.head, TRUTH["smallest_pitch_at_s_before_disc"]) <= 1e-15


def test_the_greatest_ratio_is_found_again() -> None:
    made = make_truth.ratio_values()
    assert make_truth.difference(made, {name: TRUTH[name] for name in made})[0] <= 1e-15


def test_a_difference_is_told_with_its_place() -> None:
    made = {"a": {"0": ("1.0", "2.0")}, "b": "3.0"}
    most, where = make_truth.difference(made, {"a": {"0": ["1.0", "2.25"]}, "b": "3.125"})
    assert (most, where) == (0.25, "a.0.1")
    with pytest.raises(ValueError, match=r"a\.0\.1"):
        make_truth.difference(made, {"a": {"0": ["1.0"]}, "b": "3.0"})


# Random dragons and walks, by both implementations.


class Walked(NamedTuple):
    """A walk of one dragon, as the package and as the reference know it; s = 0 at its time 0."""

    walk: bd.Walk
    end: float
    dragon: list[Bench]
    point: reference.Points
    rough: scan.Points


Roll = Callable[[np.random.Generator], Walked]


def random_dragon(
    rng: np.random.Generator, least: int, width: tuple[float, float], link: tuple[float, float]
) -> list[Bench]:
    """From `least` to 40 benches of random sizes, m, the head's link half as long again."""
    count = int(rng.integers(least, 41))
    links = rng.uniform(*link, count)
    links[0] *= 1.5
    widths, front, rear = rng.uniform(*width, count), *rng.uniform(0.1, 0.35, (2, count))
    rows = np.column_stack([links + front + rear, widths, front, rear]).tolist()
    return [Bench(*row) for row in rows]


def packaged(dragon: list[Bench]) -> bd.Dragon:
    return bd.Dragon.of_sizes(*make_truth.benches(dragon))


def random_spiral(rng: np.random.Generator, least: int = 5) -> Walked:
    """In from turn 6..12 until the head is less than its link away from the centre."""
    pitch, theta = float(rng.uniform(0.42, 0.8)), 2.0 * math.pi * float(rng.uniform(6.0, 12.0))
    dragon = random_dragon(rng, least, (0.4 * pitch, 0.8 * pitch), (0.9, 2.0))
    end = 2.0 * math.pi * float(packaged(dragon).links.max() * rng.uniform(0.6, 0.8)) / pitch
    walk = bd.Walk(packaged(dragon), bd.Route((bd.Spiral(pitch, theta, end),)))
    exact, rough = reference.spiral_walk(mp.mpf(pitch), mp.mpf(theta)), scan.spiral_walk(pitch, theta)
    return Walked(walk, walk.route.length, dragon, exact, rough)


def random_turn(rng: np.random.Generator, width: tuple[float, float] = (0.15, 0.4)) -> Walked:
    """Through a turn of two arcs, and out until the tail has left it."""
    pitch, radius, ratio = (float(rng.uniform(*span)) for span in ((1.2, 2.2), (3.8, 5.0), (0.8, 2.5)))
    dragon = random_dragon(rng, 5, width, (0.7, 1.5))
    turn = bd.TwoArcTurn(pitch, radius, ratio)
    route = turn.route()
    walk = bd.Walk(packaged(dragon), route, start=float(route.joints[1]))
    sizes = reference.turn_sizes(mp.mpf(pitch), mp.mpf(radius), mp.mpf(ratio))
    rough = scan.turn_walk({name: complex(value) for name, value in sizes.items()})
    end = turn.length + 1.05 * float(walk.dragon.links.sum())
    return Walked(walk, end, dragon, reference.turn_walk(pitch, radius, ratio), rough)


@pytest.mark.parametrize("kind", [random_spiral, random_turn])
@pytest.mark.parametrize("seed", range(6))
def test_places_and_speeds_are_those_of_the_second_road(kind: Roll, seed: int) -> None:
    rng = np.random.default_rng(seed)
    case = kind(rng)
    times = rng.uniform(0.0, case.end, 3)
    motion = case.walk.motion(times)
    for n, time in enumerate(times.tolist()):
        s = reference.places(case.point, case.dragon, time, len(case.dragon))
        at = np.array([complex(case.point(place)) for place in s])
        assert np.abs(motion.x[n] + 1j * motion.y[n] - at).max() <= 1e-11
        speeds = np.array([float(speed) for speed in reference.speeds(case.point, s)])
        assert np.abs(motion.speed[n] - speeds).max() <= 1e-11


@pytest.mark.parametrize("kind", [random_spiral, random_turn])
def test_the_scan_stands_where_the_second_road_does(kind: Roll) -> None:
    case = kind(np.random.default_rng(1))
    heads = np.linspace(0.0, case.end, 4)
    s = scan.places(case.rough, make_truth.benches(case.dragon).links, heads)
    for n, head in enumerate(heads.tolist()):
        exact = reference.places(case.point, case.dragon, head, len(case.dragon))
        assert np.abs(s[:, n] - [float(place) for place in exact]).max() <= 1e-9
        speeds = [float(speed) for speed in reference.speeds(case.point, exact)]
        assert np.abs(scan.ratios(case.rough, s)[:, n] - speeds).max() <= 1e-6


PLACE, SHORT = st.floats(-3.0, 3.0), st.floats(0.05, 0.5)
BENCH = st.tuples(
    PLACE, PLACE, st.floats(-10.0, 10.0), st.floats(0.1, 4.0), st.floats(0.05, 4.0), SHORT, SHORT
)


@given(BENCH, BENCH)
def test_gap_and_distance_of_boxes_are_those_of_corners_and_sides(
    a: tuple[float, ...], b: tuple[float, ...]
) -> None:
    sizes, corners = np.empty((4, 2)), []
    x, y, boxes = np.empty((2, 2)), np.empty((2, 2)), np.empty((2, BOX_COLUMNS))
    # Two benches that share no handle: each is the only one of a dragon, at a time of its own.
    for n, (x0, y0, heading, link, width, front, rear) in enumerate((a, b)):
        sizes[:, n] = link + front + rear, width, front, rear
        x[:, n], y[:, n] = (x0, x0 - link * math.cos(heading)), (y0, y0 - link * math.sin(heading))
        boxes_at(sizes[:, n : n + 1].copy(), x, y, n, boxes[n : n + 1])
        fore, aft = (mp.mpc(x[row, n], y[row, n]) for row in range(2))
        corners.append(reference.corners(fore, aft, Bench(*sizes[:, n].tolist())))
    gap, distance = reference.gap(*corners), reference.distance(*corners)
    assert box_gap(boxes, 0, 1) == pytest.approx(float(gap), abs=1e-13)
    assert max(box_distance(boxes, 0, 1), 0.0) == pytest.approx(float(distance), abs=1e-13)


@pytest.mark.parametrize("seed", range(14))
def test_the_first_contact_on_a_spiral_is_that_of_the_second_road(seed: int) -> None:
    compare_first_contact(random_spiral(np.random.default_rng(100 + seed), least=12))


@pytest.mark.parametrize("seed", range(6))
def test_the_first_contact_in_a_turn_is_that_of_the_second_road(seed: int) -> None:
    compare_first_contact(random_turn(np.random.default_rng(400 + seed), width=(0.3, 1.0)))


def compare_first_contact(case: Walked) -> None:
    found = bd.first_contact(case.walk, 0.0, case.end)
    other = make_truth.first_contact(case.point, case.rough, case.dragon, 0.0, case.end)
    assert (found is None) == (other is None)
    if found is None or other is None:
        return
    assert found.value == pytest.approx(float(other[0]), abs=1e-10)
    assert found.lower <= other[0] <= found.upper
    assert found.witness is not None
    # Of several pairs that overlap from the start each names another one.
    assert found.witness.benches == other[1] or other[0] == 0


def random_pitch_question(rng: np.random.Generator) -> tuple[Plan, make_truth.PitchFamily]:
    """A dragon that coils in to a disc so small that it comes beside itself."""
    dragon = random_dragon(rng, 15, (0.15, 0.38), (0.7, 1.8))
    radius, turns = float(rng.uniform(1.2, 2.4)), float(rng.uniform(6.0, 12.0))
    names = ("length", "width", "front_inset", "rear_inset")
    plan = checked(
        {
            "schema": 1,
            "dragon": {"bench": [dict(zip(names, bench, strict=True)) for bench in dragon]},
            "route": {"kind": "spiral-in", "pitch": 0.8, "start_turn": turns},
            "disc": {"radius": radius},
        },
        "random",
    )
    return plan, make_truth.PitchFamily(dragon, radius, turns)


@pytest.mark.parametrize("seed", range(4))
def test_the_smallest_pitch_is_that_of_the_second_road(seed: int) -> None:
    # Smaller pitches may be walkable again. Both come from 0.8 m and stop at a border above which
    # the walk is clear: in these cases it is the same one.
    plan, family = random_pitch_question(np.random.default_rng(200 + seed))
    found, other = limit(plan, "pitch"), make_truth.smallest_pitch(family, 0.8, 0.1)
    assert found.value == pytest.approx(float(other.pitch), abs=1e-10)
    assert found.lower <= other.pitch <= found.upper
    assert found.witness is not None
    assert found.witness.benches == other.pair


@pytest.mark.parametrize("seed", range(4))
def test_the_greatest_speed_is_that_of_the_second_road(seed: int) -> None:
    case = random_turn(np.random.default_rng(300 + seed))
    found = bd.greatest_speed(case.walk, 0.0, case.end, tolerance=1e-12)
    ratio, _head, _handle = make_truth.greatest_ratio(
        case.point, case.rough, case.dragon, 0.0, case.end
    )
    assert found.value == pytest.approx(float(ratio), abs=1e-11)
    assert found.lower * (1.0 - 1e-13) <= ratio <= found.upper * (1.0 + 1e-13)
