"""Searches find the same however little room they begin with."""

import math

import pytest

from benchdragon import Arc, Dragon, Line, Route, Spiral, Walk
from benchdragon.analysis import tables
from benchdragon.analysis.contact import contact_windows, least_clearance
from benchdragon.errors import InputError, UnsureError, WalkError
from tests.kernels.tried_walks import Searched

SPIRAL = Walk(Dragon.uniform(40), Route((Spiral(0.5, 14.0 * math.pi, 2.0 * math.pi),)), start=40.0)
HAIRPIN = Route.joined([Line(20.0), Arc(0.8, math.pi), Line(20.0)])


@pytest.fixture
def narrow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Room for next to nothing at first."""
    for name, least in (("A_CELL", 1), ("AT_FIRST", 4), ("PAIRS", 1), ("MEMBERS", 2), ("DOUBTS", 1)):
        monkeypatch.setattr(tables, name, least)


def answers() -> tuple[object, ...]:
    """What benches do on a spiral and a hairpin."""
    windows = contact_windows(SPIRAL, 0.0, 25.0, most=3)
    opens = [(window.opens.lower, window.opens.upper, window.opens.witness) for window in windows]
    least = least_clearance(SPIRAL, 0.0, 20.0)
    around = least_clearance(
        Walk(Dragon.of_sizes([1.1] * 9, 0.2, 0.1, 0.1), HAIRPIN, start=14.0), 0.0, 12.0
    )
    return opens, (least.lower, least.upper), (around.lower, around.upper)


def test_little_room_is_widened_and_answers_stay_the_same(
    request: pytest.FixtureRequest,
) -> None:
    wide = answers()
    assert wide[0]
    request.getfixturevalue("narrow")
    assert answers() == wide


def test_a_step_with_many_members_is_searched_once_there_is_room(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    walk = Walk(Dragon.uniform(40), Route((Spiral(0.5, 36.0 * math.pi, 0.5 * math.pi),)), start=440.0)
    found = contact_windows(walk, 0.0, 5.0, most=1)[0].opens
    assert found.lower > 0.1
    monkeypatch.setattr(tables, "MEMBERS", 1)  # the very first step asks for more
    again = contact_windows(walk, found.lower - 0.05, found.upper + 0.01, most=1)[0].opens
    assert again.lower <= found.upper
    assert found.lower <= again.upper


@pytest.mark.usefixtures("narrow")
def test_room_is_widened_for_doubts() -> None:
    """Round so tight a bend a bench folds: before it there are cells in doubt."""
    walk = Walk(Dragon.uniform(3, 1.4), Route.joined([Line(10.0), Arc(0.3, math.pi), Line(9.0)]))
    with pytest.raises(WalkError):
        list(Searched(walk, 8.0, 14.0).steps())


def test_a_route_of_too_many_cells_is_refused_when_it_comes_to_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(tables, "MOST_CELLS", 60)
    with pytest.raises(UnsureError, match="more than 60"):
        contact_windows(Walk(Dragon.uniform(9), Route((Line(999.0),)), start=20.0), 0.0, 900.0)


def test_too_many_sizes_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "MOST_SIZES", 2)
    walk = Walk(Dragon.of_sizes([2.0, 2.1, 2.2, 2.0], 0.3, 0.2, 0.2), Route((Line(99.0),)), start=20.0)
    with pytest.raises(InputError, match="at most 2 different sizes, not 3"):
        contact_windows(walk, 0.0, 9.0)


@pytest.mark.usefixtures("narrow")
def test_a_part_of_a_walk_stays_one_when_room_is_widened() -> None:
    search = Searched(SPIRAL, 40.0, 65.0)
    search.begin(0.3)
    search.go(50.0, 52.0)
    steps = list(search.steps())
    assert 50.0 <= steps[0].start < steps[-1].end == 52.0
