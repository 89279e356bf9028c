"""Proofs by ball arithmetic, and that a wrong place is found out."""

import math

import mpmath
import numpy as np
import pytest

from benchdragon import Arc, Clothoid, Dragon, Line, Route, SpeedProfile, Spiral, Walk
from benchdragon.contact import contact_windows, first_contact
from benchdragon.ground import Ledger
from benchdragon.kernels import curve as kernel
from benchdragon.plan import read_plan
from benchdragon.prove import Checker, errors, prove_contact, prove_nearer
from benchdragon.solve import limit

FIRST_CONTACT = 412.4738376821147


@pytest.fixture(scope="module")
def walk() -> Walk:
    return read_plan("spiral-in").build()


def test_the_contests_first_contact_is_proved(walk: Walk) -> None:
    found = prove_contact(walk, 390.0, 430.0)
    assert found is not None
    assert found.status == "proved"
    assert found.lower < FIRST_CONTACT < found.upper
    assert found.upper - found.lower < 1e-9
    assert found.witness is not None
    assert found.witness.benches == (1, 9)


def test_a_clear_walk_is_proved_clear(walk: Walk) -> None:
    assert prove_contact(walk, 400.0, 412.47) is None


def test_the_smallest_pitchs_bracket_is_proved() -> None:
    plan = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=40"])
    found = limit(plan, "pitch", prove=True)
    assert found.status == "proved"
    assert found.lower < 0.4503373930271955 < found.upper
    assert found.upper - found.lower < 1e-10


def test_a_graze_within_the_errors_stays_undecided() -> None:
    plan = read_plan(
        "spiral-in", ["disc.radius=4.5", "route.pitch=0.4503373930271955", "dragon.benches=30"]
    )
    walk = plan.build()
    found = prove_contact(walk, 210.0, walk.route.length)
    assert found is not None
    assert found.status == "undecided"


def test_an_overlap_is_proved_and_a_gap_is_not(walk: Walk) -> None:
    assert prove_nearer(walk, FIRST_CONTACT + 1e-9, 0, 8, 0.0)
    assert not prove_nearer(walk, FIRST_CONTACT - 1e-9, 0, 8, 0.0)


@pytest.mark.parametrize(
    "route",
    [
        Route.joined([Line(30.0), Arc(3.0, 3.0), Line(12.0)]),
        Route.joined([Line(30.0), Clothoid(6.0, 0.0, 0.4), Arc(2.5, 2.2), Line(9.0)]),
        Route((Spiral(0.55, 100.0, 20.0),)),
        Route((Spiral(0.55, 20.0, 100.0, mirrored=True),)),
    ],
)
def test_every_kind_of_curve_is_enclosed_as_mpmath_has_it(route: Route) -> None:
    checker = Checker(route.rows)
    for j in range(len(route.rows)):
        u = 0.3 * route.rows[j, kernel.U_START] + 0.7 * route.rows[j, kernel.U_END]
        x, y = checker.place(j, checker.ball(float(u)))
        px, py, _tx, _ty = kernel.place(route.rows, j, float(u))
        assert float(abs(x - px).upper()) < 1e-13
        assert float(abs(y - py).upper()) < 1e-13
        wanted = _mpmath_place(route.rows[j], float(u))
        assert abs(float(x.mid()) - float(wanted[0])) < 1e-15 * (1.0 + abs(float(wanted[0])))
        assert abs(float(y.mid()) - float(wanted[1])) < 1e-15 * (1.0 + abs(float(wanted[1])))


def _mpmath_place(row: np.ndarray, u: float) -> tuple[mpmath.mpf, mpmath.mpf]:
    with mpmath.workdps(40):
        x, y, angle = (mpmath.mpf(float(row[n])) for n in (kernel.X, kernel.Y, kernel.ANGLE))
        p, q, at = mpmath.mpf(float(row[kernel.P])), mpmath.mpf(float(row[kernel.Q])), mpmath.mpf(u)
        if row[kernel.KIND] == kernel.SPIRAL:
            return x + p * at * mpmath.cos(angle + q * at), y + p * at * mpmath.sin(angle + q * at)

        def heading(s: mpmath.mpf) -> mpmath.mpf:
            return angle + s * (p + q * s / 2)

        return (
            x + mpmath.quad(lambda s: mpmath.cos(heading(s)), [0, at]),
            y + mpmath.quad(lambda s: mpmath.sin(heading(s)), [0, at]),
        )


def _ledger(walk: Walk) -> Ledger:
    ledger = Ledger()
    contact_windows(walk, 405.0, 412.0, most=1, ledger=ledger)
    return ledger


def test_computed_places_are_within_a_few_roundings(walk: Walk) -> None:
    found = errors(walk, _ledger(walk))
    assert 0.0 < found.beside < 1e-13
    assert found.along < 1e-12
    assert found.head < 1e-12
    assert found.others < 1e-9
    assert found.places > 1000


def test_a_place_that_is_off_is_found_out(walk: Walk) -> None:
    ledger = _ledger(walk)
    _at, _row, _u, x, _y = ledger.looks[0]
    x[0, 1] += 1e-9
    assert errors(walk, ledger).beside > 0.9e-9


def test_a_wrong_parameter_is_found_out(walk: Walk) -> None:
    ledger = _ledger(walk)
    _at, _row, u, _x, _y = ledger.looks[0]
    u[0, 2] += 1e-9
    assert errors(walk, ledger).along > 1e-9


def test_a_proof_holds_at_any_speed() -> None:
    walk = read_plan("spiral-in").build()
    profile = SpeedProfile((0.0, 10.0, 20.0), (0.5, 2.0, 1.0))
    slow = Walk(walk.dragon, walk.route, profile, 400.0)
    found, plain = prove_contact(slow, 0.0, 30.0), first_contact(slow, 0.0, 30.0)
    assert found is not None
    assert plain is not None
    assert found.lower <= plain.lower <= plain.upper <= found.upper


def test_a_hairpin_with_clothoids_is_proved() -> None:
    route = Route.joined(
        [Line(40.0), Clothoid(2.0, 0.0, 1.0), Arc(1.0, 0.9), Clothoid(2.0, 1.0, 0.0), Line(30.0)]
    )
    dragon = Dragon.of_sizes(np.full(12, 1.2), 0.9, 0.1, 0.1)
    walk = Walk(dragon, route, start=30.0)
    plain, found = first_contact(walk, 0.0, 40.0), prove_contact(walk, 0.0, 40.0)
    assert (plain is None) == (found is None)
    if plain is not None and found is not None:
        assert found.lower <= plain.value <= found.upper
    assert math.isfinite(route.length)
