"""Turns of each family: they end in place by formulas of another kind, or say why there are none."""

import cmath
import itertools
import math

import numpy as np
import pytest
from scipy.optimize import fsolve

from benchdragon.kernels import turn_families
from benchdragon.kernels.curve import COLUMNS, FloatArray, curvature
from benchdragon.kernels.route_parts import PART_COLUMNS, Pose, lay_rows, misfits, row_count
from benchdragon.kernels.status import TurnStatus
from benchdragon.kernels.turn_families import (
    ARCS,
    MOST_TURN_PIECES,
    NEGLIGIBLE,
    Bridge,
    Easing,
    eased,
    swept,
)
from benchdragon.model.curves import Clothoid, Spiral
from tests.kernels.reference import clothoid_points

Made = tuple[FloatArray, TurnStatus]
PITCH = 1.7


def two_arcs(entry: float, exit_: float, ratio: float, ease: float = 0.0) -> Made:
    pieces = np.full((MOST_TURN_PIECES, 3), np.nan)
    arcs = np.full((ARCS, 2), np.nan)
    count, status = turn_families.two_arcs(PITCH, entry, exit_, ratio, ease, arcs, pieces)
    return pieces[:count], TurnStatus(status)


def three_pieces(
    entry: float, exit_: float, radii: tuple[float, float], bend: float = 0.0, ease: float = 0.0
) -> Made:
    pieces, arcs = np.full((MOST_TURN_PIECES, 3), np.nan), np.full((ARCS, 2), np.nan)
    first, last = radii
    count, status = turn_families.three_pieces(
        PITCH, entry, exit_, first, bend, last, ease, arcs, pieces
    )
    return pieces[:count], TurnStatus(status)


def walked(pieces: FloatArray, point: complex, heading: float) -> tuple[complex, float]:
    """Where pieces end, by e^i - 1 and SciPy's Fresnel integrals."""
    for length, a, b in pieces.tolist():
        way = cmath.rect(1.0, heading)
        if a != b:
            point += complex(clothoid_points(Clothoid(length, a, b), np.array([length]))[0]) * way
        elif a:
            point += way * (cmath.exp(1j * a * length) - 1.0) / (1j * a)
        else:
            point += way * length
        heading += 0.5 * length * (a + b)
    return point, heading


def ends(entry: float, exit_: float) -> tuple[complex, float, complex, float]:
    """Points and headings where the turn begins and ends."""
    (start, a) = Spiral.between(PITCH, entry + 1.0, entry).end_pose
    (end, b) = Spiral.between(PITCH, exit_, exit_ + 1.0, rotation=math.pi).start_pose
    return complex(*start), a, complex(*end), b


def away(made: Made, entry: float, exit_: float) -> float:
    """By how much a turn misses its end, m and rad."""
    pieces, status = made
    assert status == TurnStatus.OK
    assert (pieces[:, 0] > 0.0).all()
    start, heading, end, wanted = ends(entry, exit_)
    point, found = walked(pieces, start, heading)
    return max(abs(point - end), abs(math.remainder(found - wanted, 2.0 * math.pi)))


@pytest.mark.parametrize(
    ("entry", "exit_", "ratio"), [(4.5, 4.5, 2.0), (4.5, 3.9, 0.6), (3.2, 4.1, 1.0), (2.9, 2.9, 4.0)]
)
def test_two_arcs_of_a_ratio_end_in_place(entry: float, exit_: float, ratio: float) -> None:
    made = two_arcs(entry, exit_, ratio)
    assert away(made, entry, exit_) < 1e-13
    (_l1, one, _a), (_l2, two, _b) = made[0]
    assert (one < 0.0 < two, -two / one) == (True, pytest.approx(ratio, rel=1e-14))


def test_the_two_arcs_of_the_paper_have_its_closed_form() -> None:
    theta = 2.0 * math.pi * 4.5 / PITCH
    sweep = 2.0 * math.atan(theta)
    total = 4.5 / math.sin(0.5 * sweep)
    pieces, _status = two_arcs(4.5, 4.5, 2.0)
    for (length, bend, _end), radius in zip(pieces, (2.0 / 3.0, -1.0 / 3.0), strict=True):
        assert length == pytest.approx(abs(radius) * total * sweep, rel=1e-14)
        assert -1.0 / bend == pytest.approx(radius * total, rel=1e-14)


@pytest.mark.parametrize(
    ("entry", "exit_", "first", "bend"),
    [
        *((4.5, 4.5, 1.6, bend) for bend in (0.0, 0.3, -0.3, 0.05)),
        *((4.5, 3.9, 1.3, bend) for bend in (0.0, 0.3, -0.3, 0.05)),
        *((3.6, 4.2, 1.2, bend) for bend in (0.0, 0.3, -0.3, 0.05)),
        (4.5, 3.9, 1.4, -1.1),
    ],
)
def test_an_arc_what_lies_between_and_an_arc_end_in_place(
    entry: float, exit_: float, first: float, bend: float
) -> None:
    assert away(three_pieces(entry, exit_, (first, first - 0.1), bend), entry, exit_) < 1e-13


def test_of_two_circles_between_the_arcs_that_of_the_shorter_way_is_taken() -> None:
    start, heading, end, wanted = ends(4.5, 4.2)
    for bend in (0.3, -0.3):
        bends = -1.0 / 1.6, bend, 1.0 / 1.4

        def miss(x: FloatArray, bends: tuple[float, ...] = bends) -> list[float]:
            pieces = np.array([(a, b, b) for a, b in zip(x, bends, strict=True)])
            point, found = walked(pieces, start, heading)
            turn = math.remainder(found - wanted, 2.0 * math.pi)
            return [(point - end).real, (point - end).imag, turn]

        known = []
        for guess in itertools.product((0.2, 0.5, 0.8), repeat=3):
            full = [2.0 * math.pi / abs(each) for each in bends]
            x, _info, code, _text = fsolve(miss, np.multiply(guess, full), full_output=True, xtol=1e-13)
            if code == 1 and max(map(abs, miss(x))) < 1e-9:
                known.append(sum(length % round_ for length, round_ in zip(x, full, strict=True)))
        pieces, _status = three_pieces(4.5, 4.2, (1.6, 1.4), bend)
        assert max(known) > min(known) + 1.0  # there are several
        assert float(pieces[:, 0].sum()) == pytest.approx(min(known), abs=1e-8)


@pytest.mark.parametrize("ease", [0.05, 0.4])
@pytest.mark.parametrize(
    ("entry", "exit_", "radius"), [(4.5, 4.5, 1.5), (4.5, 3.9, 1.2), (3.6, 4.2, 1.1)]
)
def test_eased_turns_end_in_place_and_bend_without_a_jump(
    entry: float, exit_: float, radius: float, ease: float
) -> None:
    turns = (
        (two_arcs(entry, exit_, 1.5, ease), 5),
        (three_pieces(entry, exit_, (radius, radius), 0.0, ease), 7),
        (three_pieces(entry, exit_, (radius, radius), 0.2, ease), 7),
    )
    for made, count in turns:
        assert len(made[0]) == count
        assert away(made, entry, exit_) < 2e-12
        np.testing.assert_array_equal(made[0][::2, 0], ease)
        np.testing.assert_array_equal(made[0][1:, 1], made[0][:-1, 2])
        inward, outward = (Spiral.between(PITCH, radius, radius + 1.0) for radius in (entry, exit_))
        joints = -curvature(inward.rows, 0, inward.start_angle), made[0][0, 1]
        assert joints[1] == pytest.approx(joints[0], rel=1e-14)
        last = curvature(outward.rows, 0, outward.start_angle)
        assert made[0][-1, 2] == pytest.approx(last, rel=1e-14)


@pytest.mark.parametrize(
    ("made", "status"),
    [
        (lambda: two_arcs(0.1, 4.0, 1.0), TurnStatus.TOO_NEAR),
        (lambda: three_pieces(4.0, 0.1, (1.0, 1.0)), TurnStatus.TOO_NEAR),
        (lambda: two_arcs(1e200, 1e200, 1.0), TurnStatus.NO_ARCS),
        (lambda: three_pieces(4.5, 4.5, (4.0, 4.0)), TurnStatus.NO_LINE),
        (lambda: three_pieces(4.5, 4.5, (1.0, 1.0), 10.0), TurnStatus.NO_CIRCLE),
        (lambda: three_pieces(4.5, 4.5, (1.0, 2.0), 0.5), TurnStatus.NO_CIRCLE),
        (lambda: three_pieces(4.3, 4.3, (0.5, 1.5), 0.0, 1.9), TurnStatus.NO_ROOM),
        (lambda: two_arcs(2.7, 1.7, 3.5, 1.9), TurnStatus.NOT_EASED),
        (lambda: two_arcs(4.5, 4.5, 1.0, 1e5), TurnStatus.NOT_EASED),
    ],
)
def test_why_there_is_no_turn_is_told(made: object, status: TurnStatus) -> None:
    assert callable(made)
    pieces, found = made()
    assert found == status
    assert len(pieces) == 0


@pytest.mark.parametrize(
    ("turn", "bend", "length"),
    [(1.0, 0.5, 2.0), (1.0, -0.5, 2.0 * (2.0 * math.pi - 1.0)), (7.0, 1.0, 7.0 - 2.0 * math.pi)],
)
def test_an_arc_turns_the_way_it_bends(turn: float, bend: float, length: float) -> None:
    assert swept(turn, bend) == pytest.approx(length, rel=1e-14)
    assert swept(turn - 20.0 * math.pi, bend) == pytest.approx(length, rel=1e-13)
    assert swept(-math.copysign(1e-13, bend), bend) == 0.0  # a full turn but for rounding


@pytest.mark.parametrize("ease", [0.0, 0.6])
def test_the_route_of_a_turn_joins_spirals_of_the_wanted_lengths(ease: float) -> None:
    pieces, _status = three_pieces(4.4, 4.1, (1.5, 1.6), 0.0, ease)
    parts = np.full((len(pieces) + 2, PART_COLUMNS), np.nan)
    turn_families.turn_parts(PITCH, 4.4, 4.1, 12.5, 345.0, pieces, parts)
    rows = np.empty((row_count(parts), COLUMNS))
    lay_rows(parts, Pose(0.0, 0.0, 0.0), 1, len(parts) - 1, rows)
    out = np.full((len(parts) - 1, 2), np.nan)
    misfits(rows, out)
    assert out.max() < 3e-12
    inward, outward = Spiral.between(PITCH, 9.0, 4.4), Spiral.between(PITCH, 4.1, 9.0)
    assert rows[0, 3] == pytest.approx(12.5, rel=1e-12)
    assert rows[-1, 3] == pytest.approx(345.0, rel=1e-12)
    assert rows[0, 5] == pytest.approx(inward.end_angle, rel=1e-15)
    assert rows[-1, 4] == pytest.approx(outward.start_angle, rel=1e-15)


def test_pieces_too_short_to_matter_are_left_out() -> None:
    arcs = np.array([[1.0, -0.5], [0.5 * NEGLIGIBLE, 0.0], [2.0, 0.4]])
    pieces = np.empty((MOST_TURN_PIECES, 3))
    bridge, easing = Bridge(0.0, 0.0, 0.0), Easing(0.0, 0.0, 0.0)
    assert eased(bridge, easing, 0.0, arcs, pieces) == (2, TurnStatus.OK)
    assert pieces[:2].tolist() == [[1.0, -0.5, -0.5], [2.0, 0.4, 0.4]]
