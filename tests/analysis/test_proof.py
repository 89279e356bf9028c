"""Proofs by ball arithmetic, and that a wrong place is found out."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from benchdragon import (
    Answer,
    Arc,
    Clothoid,
    Dragon,
    InputError,
    Line,
    LogSpiral,
    Route,
    SpeedProfile,
    Spiral,
    UnsureError,
    Walk,
)
from benchdragon.analysis import proof, tables
from benchdragon.analysis.check import check
from benchdragon.analysis.contact import Window, contact_windows, first_contact
from benchdragon.analysis.ledger import Ledger
from benchdragon.analysis.proof import (
    Checker,
    Errors,
    errors,
    needed_slack,
    prove_contact,
    prove_nearer,
)
from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.schema import checked, read_plan
from benchdragon.solve import size
from benchdragon.solve.size import limit
from tests.analysis.chains import chain_at

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


# The pair that decides is that of benches 1 and 20, whatever follows them.
COIL = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=20"])


@pytest.fixture(scope="module")
def proved() -> Answer:
    """The smallest pitch of a short dragon."""
    return limit(COIL, "pitch", prove=True)


def test_the_smallest_pitchs_bracket_is_proved(proved: Answer) -> None:
    assert (proved.status, proved.assumptions) == ("proved", proof.assumed())
    assert proved.lower < 0.4503373930271955 < proved.upper
    assert proved.upper - proved.lower < 1e-10


def test_a_graze_within_the_errors_stays_undecided() -> None:
    walk = COIL.with_value("route.pitch", 0.4503373930271955).build()
    found = prove_contact(walk, 210.0, walk.route.length)
    assert found is not None
    assert found.status == "undecided"


def test_an_overlap_is_proved_and_a_gap_is_not(walk: Walk) -> None:
    assert prove_nearer(walk, FIRST_CONTACT + 1e-9, 0, 8, 0.0)
    assert not prove_nearer(walk, FIRST_CONTACT - 1e-9, 0, 8, 0.0)


def test_a_curve_that_is_not_enclosed_is_refused_before_any_work(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(proof, "contact_windows", lambda *_args, **_more: pytest.fail("it searched"))
    monkeypatch.setattr(size, "_limit", lambda *_args: pytest.fail("it searched"))
    route = Route.joined([Line(30.0), LogSpiral(6.0, 0.1, 0.4)])
    wanted = r"^part 2 of the route is a logarithmic spiral, and proofs know lines, arcs, clothoids and"
    with pytest.raises(InputError, match=wanted):
        prove_contact(Walk(Dragon.uniform(3, 2.2), route), 0.0, 1.0)
    parts = [{"kind": "line", "length": 60.0}]
    parts.append({"kind": "log-spiral", "length": 20.0, "start_curvature": 0.1, "end_curvature": 0.3})
    plan = checked({"schema": 1, "dragon": {"benches": 4}, "route": {"part": parts}}, "plan")
    for ask in (lambda: check(plan, prove=True), lambda: limit(plan, "width", prove=True)):
        with pytest.raises(InputError, match=wanted):
            ask()
    monkeypatch.setattr(proof, "ENCLOSED", (Line, Arc))
    with pytest.raises(InputError, match=r"^part 1 of the route is a spiral, and proofs know"):
        limit(read_plan("spiral-in", ["disc.radius=4.5"]), "pitch", prove=True)


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
    checker = Checker(route.rows, 1.0)
    for j in range(len(route.rows)):
        u = 0.3 * route.rows[j, kernel.U_START] + 0.7 * route.rows[j, kernel.U_END]
        x, y = checker.place(j, checker.ball(float(u)))
        balls = x, y, *checker.heading(j, checker.ball(float(u)))
        for ball, number in zip(balls, kernel.place(route.rows, j, float(u)), strict=True):
            assert float(abs(ball - number).upper()) < 1e-13
        s = route.rows[j, kernel.S_START] + kernel.length_at(route.rows, j, float(u))
        assert checker.head_error(j, float(u), s) < 1e-12
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
    assert found.others < 1e-9
    assert found.places > 1000


def test_a_place_that_is_off_is_found_out(walk: Walk) -> None:
    ledger = _ledger(walk)
    _at, _row, _u, x, _y = ledger.evaluations[0]
    x[0, 1] += 1e-9
    assert errors(walk, ledger).beside > 0.9e-9


def test_a_wrong_parameter_is_found_out(walk: Walk) -> None:
    ledger = _ledger(walk)
    _at, _row, u, _x, _y = ledger.evaluations[0]
    u[0, 2] += 1e-9
    assert errors(walk, ledger).along > 1e-9


@pytest.mark.parametrize("table", ["evaluations", "cells", "grid"])
@pytest.mark.parametrize("column", ["head position", "x of the head", "x", "y"])
def test_the_last_chain_of_every_table_is_looked_over(walk: Walk, table: str, column: str) -> None:
    ledger = _ledger(walk)
    chains = {
        "evaluations": ledger.evaluations,
        "grid": ledger.grid,
        "cells": [c for _link, c in ledger.cells],
    }
    at, _row, _u, x, y = next(some for some in reversed(chains[table]) if len(some[0]) > 1)
    if column == "head position":
        at[-1] += 1e-9
    else:
        (y if column == "y" else x)[-1, 0 if column == "x of the head" else -1] += 1e-9
    found = errors(walk, ledger)
    least = 0.9e-9
    if table == "evaluations":
        assert found.beside > least
        assert found.others < least
        assert (found.along > least) == (column == "head position")
    else:
        assert found.others > least
        assert found.beside < least


def test_the_radius_of_a_ball_is_part_of_it(walk: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    flint = pytest.importorskip("flint")
    chain, s, checker = chain_at(walk, 400.0), 400.0, Checker(walk.route.rows, 1.0)
    plain = checker.chain_error(*chain, 0.0)
    assert max(plain) < 5e-13
    exact = checker.place

    def wide(j: int, at: object) -> tuple[object, ...]:
        return tuple(value + flint.arb(0.0, 1e-12) for value in exact(j, at))  # type: ignore[arg-type]

    monkeypatch.setattr(checker, "place", wide)
    beside, along = checker.chain_error(*chain, 0.0)
    assert beside > 2e-12
    assert along > 2e-12
    monkeypatch.setattr(checker, "_length", lambda _row, _theta: flint.arb(0.0, 1e-9))
    assert checker.head_error(int(chain[1][0]), float(chain[2][0]), s) > s


def _errors_of(monkeypatch: pytest.MonkeyPatch, *found: Errors) -> list[float]:
    """Have `errors` find these, one trial after the other; which slacks are searched with."""
    slacks: list[float] = []
    told = iter(found)

    def windows(*arguments: object, slack: float, **more: object) -> list[Window]:
        slacks.append(slack)
        return contact_windows(*arguments, slack=slack, **more)  # type: ignore[arg-type]

    monkeypatch.setattr(proof, "contact_windows", windows)
    monkeypatch.setattr(proof, "errors", lambda *_arguments: next(told))
    return slacks


def test_the_search_is_run_again_with_the_slack_that_errors_need(
    walk: Walk, monkeypatch: pytest.MonkeyPatch
) -> None:
    wide = Errors(3e-11, 1e-11, 0.0, 1)
    slacks = _errors_of(monkeypatch, wide, wide)
    found = prove_contact(walk, 410.0, 413.0)
    assert found is not None
    assert len(slacks) == 2
    assert slacks[1] >= needed_slack(walk, wide, 0.0) > 1e-10 > slacks[0]
    assert found.lower < FIRST_CONTACT - 1e-9
    assert found.upper > FIRST_CONTACT + 1e-9


@pytest.mark.parametrize(
    "found",
    [
        [Errors(1e-13, 1e-13, 2e-8, 1)],
        [Errors(math.inf, math.inf, 0.0, 1)],
        [Errors(1e-5, 0.0, 0.0, 1)],
        [Errors(10.0**n, 0.0, 0.0, 1) for n in (-12, -11, -10, -9)],
    ],
    ids=["others", "infinite", "large", "growing"],
)
def test_errors_that_are_too_large_are_no_proof(
    walk: Walk, monkeypatch: pytest.MonkeyPatch, found: list[Errors]
) -> None:
    slacks = _errors_of(monkeypatch, *found)
    with pytest.raises(UnsureError, match="could not be bounded"):
        prove_contact(walk, 405.0, 406.0)
    assert len(slacks) == len(found)


def test_the_chain_of_a_contact_at_the_start_is_looked_over(walk: Walk) -> None:
    found = prove_contact(walk, 413.0, 414.0)
    assert found is not None
    assert (found.status, found.lower, found.upper) == ("proved", 413.0, 413.0)
    ledger = Ledger()
    contact_windows(walk, 413.0, 414.0, most=1, ledger=ledger)
    (look,) = ledger.evaluations
    motion = walk.motion([413.0])
    for table, other in zip(look[1:], (*motion.state(0), motion.x[0], motion.y[0]), strict=True):
        np.testing.assert_array_equal(table[0], other)
    assert look[0] == motion.head_s


AWKWARD = SpeedProfile((0.1, 3.3, 7.7, 400.7), (0.3, 1.7, 0.9, 1.1))


@pytest.mark.parametrize(("start", "end"), [(0.7, 300.0), (200.9, 210.5)])
def test_what_the_head_is_put_off_by_at_both_ends_counts(
    walk: Walk, monkeypatch: pytest.MonkeyPatch, start: float, end: float
) -> None:
    late = Walk(walk.dragon, walk.route, AWKWARD, 0.1)
    off = [
        abs(late.exact_head_position(t) - Fraction(late.head_position([t])[0])) for t in (start, end)
    ]
    heads: list[float] = []

    def found(_walk: Walk, _ledger: Ledger, head: float, _progress: object) -> Errors:
        heads.append(head)
        return Errors(0.0, 0.0, 0.0, 1)

    monkeypatch.setattr(proof, "errors", found)
    assert prove_contact(late, start, end) is None
    assert max(off) <= Fraction(heads[0]) < 2 * max(off) + Fraction(1, 10**30)
    assert max(off) > 0


def test_what_the_head_is_put_off_by_is_an_error_of_every_chain(walk: Walk) -> None:
    ledger = _ledger(walk)
    plain, found = errors(walk, ledger), errors(walk, ledger, 1e-9)
    assert found.along > plain.along + 0.9e-9
    assert found.beside > plain.beside + 0.9e-9
    assert found.others > plain.others + 0.9e-9


def test_an_overlap_within_the_errors_is_not_proved(
    walk: Walk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(proof, "errors", lambda *_arguments: Errors(1e-7, 0.0, 0.0, 1))
    assert not prove_nearer(walk, FIRST_CONTACT + 1e-9, 0, 8, 0.0)
    assert prove_nearer(walk, FIRST_CONTACT + 1e-4, 0, 8, 0.0)


def test_the_chain_of_an_overlap_is_looked_over(walk: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    chains: list[tuple[FloatArray, ...]] = []

    def found(_walk: Walk, ledger: Ledger) -> Errors:
        chains.extend(ledger.evaluations)
        return Errors(0.0, 0.0, 0.0, 1)

    monkeypatch.setattr(proof, "errors", found)
    assert prove_nearer(walk, 413.0, 0, 8, 0.0)
    ((at, _row, _u, x, y),) = chains
    motion = walk.motion([413.0])
    assert at == motion.head_s
    np.testing.assert_array_equal([x[0], y[0]], [motion.x[0, :10], motion.y[0, :10]])


def test_slack_grows_with_the_largest_coordinate(monkeypatch: pytest.MonkeyPatch) -> None:
    far = Route((Spiral(0.55, 32.0 * math.pi, 0.0, centre=(0.0, -1e6)),))
    slacks = _errors_of(monkeypatch, *[Errors(0.0, 0.0, 0.0, 1)] * 2)
    prove_contact(Walk(Dragon.uniform(20), far), 412.0, 413.0)
    assert slacks[1] > 1e6 * 2.2e-16 > slacks[0]


def test_looks_beyond_the_room_of_the_log_are_no_proof(
    walk: Walk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tables, "LOG", 3)
    with pytest.raises(UnsureError, match="too many evaluations"):
        prove_contact(walk, 412.0, 413.0)


def test_a_proof_widens_the_log_of_cells(walk: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    wide = sum(len(chains[0]) for _link, chains in _ledger(walk).cells)
    monkeypatch.setattr(tables, "CELL_LOG", 3)
    assert sum(len(chains[0]) for _link, chains in _ledger(walk).cells) == wide > 3


@pytest.mark.parametrize("end", ["prove_nearer", "prove_contact"])
def test_a_limit_is_proved_at_both_ends(
    monkeypatch: pytest.MonkeyPatch, proved: Answer, end: str
) -> None:
    monkeypatch.setattr(
        size, end, {"prove_nearer": lambda *_a: False}.get(end, lambda *_a, **_m: proved)
    )
    with pytest.raises(UnsureError, match="could not be proved"):
        limit(COIL, "pitch", prove=True)


def test_a_verdict_is_proved_only_if_its_contact_is() -> None:
    graze = check(COIL.with_value("route.pitch", 0.4503373930271955), prove=True)
    assert graze.first_contact is not None
    assert not graze.proved
    clear, touching = (
        check(COIL.with_value("route.pitch", pitch), prove=True) for pitch in (0.46, 0.44)
    )
    assert clear.safe
    assert clear.proved
    assert not touching.safe
    assert touching.proved


def test_a_margin_is_kept(walk: Walk) -> None:
    plain, found = (of(walk, 405.0, 412.0, margin=2e-3) for of in (first_contact, prove_contact))
    assert plain is not None
    assert found is not None
    assert found.lower <= plain.lower <= plain.upper <= found.upper < 412.0


def test_a_proof_says_what_it_rests_on(walk: Walk) -> None:
    found = prove_contact(walk, 412.0, 413.0)
    assert found is not None
    exact, doubles, places = found.assumptions
    assert exact == "the stored numbers of route and benches are exact"
    assert "double precision" in doubles
    assert "positions enclosed with 100 bits" in places


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
