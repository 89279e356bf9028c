"""Proofs by ball arithmetic, and that a wrong place is found out."""

import itertools
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
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, set_box
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.step_bounds import reach
from benchdragon.plans.schema import checked, read_plan
from benchdragon.solve import size
from benchdragon.solve.size import limit

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


def _chain(walk: Walk, s: float) -> tuple[FloatArray, IntArray, FloatArray, FloatArray, FloatArray]:
    """Links, row, u, x and y of the dragon with its head at s, m."""
    motion = Walk(walk.dragon, walk.route).motion([s])
    row, u = motion.state(0)
    return walk.dragon.links, row, u, motion.x[0], motion.y[0]


def test_an_error_of_the_head_goes_down_the_chain_as_fast_as_handles_do() -> None:
    walk = read_plan("turn", ["dragon.benches=20"]).build()
    s = walk.start + 14.48
    ratios = Walk(walk.dragon, walk.route).motion([s]).speed_ratio[0]
    assert ratios.max() > 1.5
    _beside, along = Checker(walk.route.rows, 3.0).chain_error(*_chain(walk, s), 1e-9)
    assert along == pytest.approx(1e-9 * ratios.max(), rel=1e-3)


def test_jumps_at_smooth_joints_count_at_every_handle() -> None:
    gap, turn, step = 3e-10, 5e-12, 2.0
    route = Route((Line(12.0), Line(9.0).moved((12.0, gap), turn)))
    checker = Checker(route.rows, step)
    assert checker.jumps == pytest.approx(gap + step * turn, rel=1e-3)
    walk = Walk(Dragon.uniform(5), route)
    beside, along = checker.chain_error(*_chain(walk, 20.0), 0.0)
    assert beside == pytest.approx(along) == pytest.approx(6.0 * checker.jumps, rel=1e-3)


KINKED: dict[str, tuple[Line | Spiral, ...]] = {
    "from a line": (Line(12.0), Line(9.0).moved((12.0, 0.0), 0.4)),
    "after a smooth joint": (
        Line(5.0),
        Line(7.0).moved((5.0, 0.0), 0.0),
        Line(9.0).moved((12.0, 0.0), 0.4),
    ),
    "from a spiral": (
        Spiral(0.55, 30.0, 20.0),
        Line(9.0).moved(Spiral(0.55, 30.0, 20.0).end_pose[0], 0.0),
    ),
}


@pytest.mark.parametrize("name", KINKED)
def test_who_may_stand_beyond_a_kink_cannot_be_told(name: str) -> None:
    route = Route(KINKED[name], kinks=True)
    checker, walk = Checker(route.rows, 1.0), Walk(Dragon.uniform(3, 2.2), route)
    kink = float(route.joints[-2])
    assert checker.jumps < 1e-14
    places = ((-1e-12, 1e-13, True), (-1e-12, 1e-8, False), (0.0, 0.0, False), (1e-9, 1e-8, False))
    for ahead, off, known in (*places, (1.0, 1e-8, True)):
        error = checker.chain_error(*_chain(walk, kink + ahead), off)
        assert all(map(math.isfinite, error)) == known
    # The same with the handle of a follower at the kink.
    behind = walk.head_where_tail(kink)
    assert checker.chain_error(*_chain(walk, behind), 2e-9) == (math.inf, math.inf)
    assert math.isfinite(checker.chain_error(*_chain(walk, behind + 1e-3), 2e-9)[0])


def test_a_bench_square_to_the_route_cannot_be_told() -> None:
    route = Route((Arc(1.0, 3.5),))
    checker, u = Checker(route.rows, 1.0), np.array([math.pi, 0.0])
    x, y = np.transpose([kernel.place(route.rows, 0, at)[:2] for at in u.tolist()])
    for link, v in ((math.hypot(x[0] - x[1], y[0] - y[1]), 0.0), (2.0 * math.sin(1.5), math.pi - 3.0)):
        u[1] = v
        x[1], y[1] = kernel.place(route.rows, 0, v)[:2]
        error = checker.chain_error(np.array([link]), np.zeros(2, dtype=np.int64), u, x, y, 0.0)
        assert all(map(math.isfinite, error)) == (v > 0.0)


@pytest.mark.parametrize(
    ("route", "link", "most"),
    [
        (Route((Line(9.0),)), 2.0, 1e-6),
        (Route((Line(9.0),)), 0.1, 5e-8),
        (Route((Arc(0.05, 3.0),)), 0.09, 1e-6 / (20.0 + 2.0 / 0.09)),
    ],
)
def test_errors_that_turn_a_bench_too_far_cannot_be_told(
    route: Route, link: float, most: float
) -> None:
    walk = Walk(Dragon.of_sizes([link], 0.1, 0.0, 0.0), route)
    chain = _chain(walk, 0.99 * route.length)
    checker = Checker(route.rows, 1.0)
    assert checker.chain_error(*chain, 1.2 * most) == (math.inf, math.inf)
    assert max(checker.chain_error(*chain, 0.8 * most)) < most


def test_the_radius_of_a_ball_is_part_of_it(walk: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    flint = pytest.importorskip("flint")
    chain, s, checker = _chain(walk, 400.0), 400.0, Checker(walk.route.rows, 1.0)
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


def test_distances_move_by_no_more_than_errors_of_places_allow() -> None:
    """Two wide benches with long ends, their handles moved in all directions, and along the route."""
    sizes = np.array([[2.0, 1.0, 0.5, 0.3]] * 3).T
    walk = Walk(Dragon.of_sizes(*sizes), Route((Line(9.0),)))
    assert walk.dragon.lever > 2.0
    off, least, most = 1e-6, math.inf, -math.inf
    for moves in itertools.product((-off, off), repeat=4):
        x = np.array([[0.0], [-1.2]]), np.array([[0.98], [2.18]])
        y = np.array([[moves[0]], [moves[1]]]), np.array([[3.0 + moves[2]], [3.0 + moves[3]]])
        table = np.empty((2, BOX_COLUMNS))
        for n in range(2):
            set_box(sizes[:, n : n + 1], 0, x[n], y[n], 0, table, n)
        least, most = min(least, box_distance(table, 0, 1)), max(most, box_distance(table, 0, 1))
    found = Errors(off, 0.0, 0.0, 1)
    moved = max(2.0 - least, most - 2.0)
    assert 0.6 * needed_slack(walk, found, 0.0) < moved <= needed_slack(walk, found, 0.0)
    spent = [reach(1.0 + n * off, 2.0 + n * off, sizes, 0) for n in (0, 2)]
    travel = 0.5 * 2.0 * (spent[1] - spent[0])
    found = Errors(0.0, off, 0.0, 1)
    assert travel <= needed_slack(walk, found, 0.0) < 1.3 * travel


def test_distances_in_doubles_are_within_the_roundings_that_are_allowed() -> None:
    rng = np.random.default_rng(7)
    sizes = np.array([[3.41, 0.3, 0.275, 0.275], [2.2, 0.3, 0.275, 0.275]]).T
    walk = Walk(Dragon.of_sizes(*sizes), Route((Line(9.0),)))
    worst, extent = 0.0, 60.0
    for _trial in range(300):
        middle, angle = rng.uniform(-40.0, 40.0, 2), rng.uniform(0.0, 6.3, 2)
        x, y = (middle[n] + np.zeros((2, 2)) for n in range(2))
        for n, link in enumerate(walk.dragon.links):
            x[:, n] += 1.5 * n + np.array([0.0, link * math.cos(angle[n])])
            y[:, n] += np.array([0.0, link * math.sin(angle[n])])
        table = np.empty((2, BOX_COLUMNS))
        for n in range(2):
            set_box(sizes[:, n : n + 1], 0, x[:, n : n + 1], y[:, n : n + 1], 0, table, n)
        distance = box_distance(table, 0, 1)
        if distance > 0.0:
            worst = max(worst, abs(float(_mpmath_distance(sizes, x, y) - mpmath.mpf(distance))))
    allowed = needed_slack(walk, Errors(0.0, 0.0, 0.0, 1), extent)
    assert 0.02 * allowed < worst <= allowed


def _mpmath_distance(sizes: FloatArray, x: FloatArray, y: FloatArray) -> mpmath.mpf:
    """The distance of two benches that do not overlap, with handles at x[:, n], y[:, n]."""
    mpf = mpmath.mpf
    with mpmath.workdps(40):
        boxes = []
        for n in range(2):
            length, width, front, rear = (mpf(float(size)) for size in sizes[:, n])
            head = mpmath.mpc(float(x[0, n]), float(y[0, n]))
            unit = (head - mpmath.mpc(float(x[1, n]), float(y[1, n]))) / (length - front - rear)
            boxes.append((head + (front - length / 2) * unit, unit, length / 2, width / 2))
        nearest = mpmath.inf
        for (centre, unit, a, b), (other, way, p, q) in itertools.permutations(boxes):
            for i, j in itertools.product((-1, 1), repeat=2):
                away = (centre + (i * a + mpmath.mpc(0, j) * b) * unit - other) / way
                # `way` is a unit vector to rounding only, in doubles as here.
                away *= abs(way) ** 2
                beyond = max(abs(away.real) - p, mpf(0)), max(abs(away.imag) - q, mpf(0))
                nearest = min(nearest, mpmath.hypot(*beyond))
        return nearest


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
