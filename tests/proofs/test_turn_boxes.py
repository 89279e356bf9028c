"""All turns of a box at once: what is said of them holds for each that doubles can make."""

import math
from collections.abc import Callable
from contextlib import suppress

import numpy as np
import pytest

pytest.importorskip("flint")
from flint import arb

from benchdragon.kernels import motion_bounds
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import RouteRow
from benchdragon.proofs import turn_chain
from benchdragon.proofs.mean_value import Box, Form, UnboundedError, angle_of, either
from benchdragon.proofs.turn_boxes import Turns, Witness
from benchdragon.proofs.turn_chain import handles
from benchdragon.proofs.turn_shape import Direct, NoTurnError, TurnShape
from tests.proofs.turns import DISC, MIDDLES, PITCH, ends, some, turn_of

FAMILIES = sorted(MIDDLES)
LINKS = [2.86, *[1.65] * 9]
# Rounding of doubles, m.
ROUNDED = 1e-9


def holds(ball: arb, value: float) -> bool:
    return bool((ball + arb(0, ROUNDED)).contains(arb(value)))


FUNCTIONS: dict[str, tuple[Callable[[Form, Form], Form], Callable[[float, float], float]]] = {
    "sums": (lambda x, y: x * 3.0 - y + 2.0, lambda x, y: 3.0 * x - y + 2.0),
    "product": (lambda x, y: x * y, lambda x, y: x * y),
    "product of sums": (lambda x, y: (x + y) * (x - y * 2.0), lambda x, y: (x + y) * (x - 2.0 * y)),
    "quotient": (lambda x, y: x * (y + 3.0).inverse(), lambda x, y: x / (y + 3.0)),
    "square": (lambda x, y: (x - y).square(), lambda x, y: (x - y) ** 2),
    "root": (lambda x, y: (x + y + 4.0).root(), lambda x, y: math.sqrt(x + y + 4.0)),
    "root cut off": (lambda x, y: (x - y - 1.0).root(), lambda x, y: math.sqrt(max(x - y - 1.0, 0))),
    "sine": (lambda x, y: (x * y).sine_cosine()[0], lambda x, y: math.sin(x * y)),
    "cosine": (lambda x, y: (x + y).sine_cosine()[1], lambda x, y: math.cos(x + y)),
    "arctangent": (lambda x, y: (x * y).arctangent(), lambda x, y: math.atan(x * y)),
    "area sine": (lambda x, y: (x - y).hyperbolic(), lambda x, y: math.asinh(x - y)),
    "exponential": (lambda x, y: (x - y).exponential(), lambda x, y: math.exp(x - y)),
    "angle": (lambda x, y: angle_of(x, y + 2.5), lambda x, y: math.atan2(y + 2.5, x)),
    "larger": (lambda x, y: either([x, y], [x.middle, y.middle]), max),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_forms_hold_all_values_and_slopes(name: str) -> None:
    form, plain = FUNCTIONS[name]
    low, high = [0.3, -0.2], [1.9, 1.1]
    found = form(*map(Box(low, high).number, (0, 1)))
    assert holds(found.middle, plain(1.1, 0.45))
    for x, y in some(low, high, 200):
        assert holds(found.over, plain(x, y))
        assert found.least() <= plain(x, y)
        u, v = min(max(x, 0.301), 1.899), min(max(y, -0.199), 1.099)
        slopes = (
            (plain(u + 1e-6, v) - plain(u - 1e-6, v)) / 2e-6,
            (plain(u, v + 1e-6) - plain(u, v - 1e-6)) / 2e-6,
        )
        for ball, slope in zip(found.slopes, slopes, strict=False):
            assert (ball + arb(0, 1e-6)).contains(arb(slope))


def test_what_is_said_twice_is_not_counted_twice() -> None:
    x = Box([1.0], [2.0]).number(0)
    assert (x - x).over.abs_upper() == 0
    small = Box([1.0], [1.001]).number(0)
    assert (small.square() - small * 2.0).over.rad() < 3e-6  # the slope at 1 is 0


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("half", [0.0, 0.01, 0.1])
@pytest.mark.parametrize("family", FAMILIES)
def test_lengths_of_all_turns_of_a_box_are_enclosed(family: str, half: float, backwards: bool) -> None:
    low, high = ends(family, half)
    box = Box(low, high)
    shape, direct = TurnShape(family, PITCH, DISC, box, backwards), Direct(PITCH, DISC, box)
    lengths = []
    for numbers in some(low, high, 60):
        turn = turn_of(family, numbers)
        assert turn is not None
        assert holds(shape.length.over, turn.length)
        assert holds(shape.way.over, turn.way(DISC))
        assert direct.length.least() <= turn.length
        assert direct.way.least() <= turn.way(DISC)
        for radius, piece in zip(shape.radii, (turn.pieces[0], turn.pieces[-1]), strict=True):
            assert holds(radius.over, 1.0 / abs(piece[1]))
        lengths.append(turn.way(DISC))
    assert shape.sure
    assert float(shape.way.over.rad()) <= 3.0 * np.ptp(lengths) / 2 + ROUNDED


@pytest.mark.parametrize("middle", [(4.5, 4.5, 2.3, 2.4), (4.4, 4.45, 2.25, 2.35)])
def test_boxes_where_some_turns_have_no_line_are_bounded_all_the_same(
    middle: tuple[float, ...],
) -> None:
    low, high = ends("arc-line-arc", 0.1, middle)
    shape = TurnShape("arc-line-arc", PITCH, DISC, Box(low, high), False)
    turns = [turn_of("arc-line-arc", numbers) for numbers in some(low, high, 300)]
    there = [turn for turn in turns if turn is not None]
    assert 0 < len(there) < len(turns)
    assert not shape.sure
    for turn in there:
        assert shape.length.least() <= turn.length
        assert shape.way.least() <= turn.way(DISC)
    assert shape.way.least() > min(turn.way(DISC) for turn in there) - 2.0


def test_boxes_without_a_turn_are_known() -> None:
    with pytest.raises(NoTurnError):
        TurnShape("arc-line-arc", PITCH, DISC, Box(*ends("arc-line-arc", 0.1, (4.5, 4.5, 3, 3))), False)


def chain(family: str, numbers: np.ndarray, head: float, backwards: bool) -> Placements:
    """The dragon on one turn by the compiled march, the head `head` m from the turn's start or end."""
    turn = turn_of(family, numbers.tolist())
    assert turn is not None
    rows = turn.rows(lead=60.0, trail=60.0)
    at = np.array([head + float(rows[-1 if backwards else 1, RouteRow.S_START])])
    places = empty_placements(len(LINKS) + 1, 1)
    assert motion_bounds.place_chain(rows, np.array(LINKS), at, 0, 1, places)
    return places


@pytest.mark.parametrize(("backwards", "head"), [(False, 3.9), (False, 0.5), (True, 0.7), (True, -2.0)])
@pytest.mark.parametrize("half", [0.0, 1e-3, 1e-2])
@pytest.mark.parametrize("family", FAMILIES)
def test_handles_of_all_turns_of_a_box_are_enclosed(
    family: str, half: float, backwards: bool, head: float
) -> None:
    low, high = ends(family, half)
    shape = TurnShape(family, PITCH, DISC, Box(low, high), backwards)
    found = []
    with suppress(UnboundedError):  # those far behind, in wide boxes
        for handle in handles(shape, [arb(link) for link in LINKS], head):
            found.append(handle)  # noqa: PERF402 - what came before an error is kept
    assert len(found) > (1 if half == 1e-2 else len(LINKS))
    for numbers in some(low, high, 20):
        places = chain(family, numbers, head, backwards)
        for i, handle in enumerate(found):
            assert holds(handle.pose.x.over, float(places.x[i, 0]))
            assert holds(handle.pose.y.over, float(places.y[i, 0]))
            assert holds(handle.pose.along.over, float(places.tx[i, 0]))
            assert holds(handle.ratio.over, float(places.ratio[i, 0]))
    if half == 0.0:
        assert len(found) == len(LINKS) + 1
        assert max(float(handle.ratio.over.rad()) for handle in found) < 1e-15


def test_a_range_that_may_not_hold_the_handle_shows_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    shape = TurnShape("arc-line-arc", PITCH, DISC, Box(*ends("arc-line-arc", 1e-3)), False)
    chain = handles(shape, [arb(link) for link in LINKS[:2]], 3.9)
    assert len(list(chain)) == 3
    monkeypatch.setattr(turn_chain, "WIDER", 0.01)
    with pytest.raises(UnboundedError, match="has no end"):
        list(handles(shape, [arb(link) for link in LINKS[:2]], 3.9))


def test_a_place_behind_a_nearer_one_is_no_handles_place() -> None:
    shape = TurnShape("arc-line-arc", PITCH, DISC, Box(*ends("arc-line-arc", 0.0)), False)
    front = next(handles(shape, [], -1.0))
    link, around = arb(1.75), 2.0 * math.pi * 4.6
    # Hardly more than the pitch away, one turn of the spiral farther out.
    rear = shape.box.constant(-1.0 - around)
    with pytest.raises(UnboundedError, match="nearer place"):
        turn_chain._check_nearest(shape, front, rear, link)


def turns(**changes: object) -> Turns:
    """What shortest paths at 1.3 m/s must keep, changed."""
    given = {
        "family": "arc-line-arc", "pitch": PITCH, "disc": DISC, "links": tuple(LINKS),
        "objective": "way", "fastest": 2.0, "head": 1.3, "least_radius": 1.5,
        "longest": math.inf, "longest_way": math.inf,
    }  # fmt: skip
    return Turns(**given | changes)  # type: ignore[arg-type]


LOW, HIGH = (4.5, 4.5, 1.51, 1.51), (4.5, 4.5, 1.52, 1.52)
FAST = Witness(False, 3.6, 2)


def test_a_box_is_out_if_one_handle_is_too_fast_on_all_its_turns() -> None:
    assert turns().bound(LOW, HIGH).least == pytest.approx(11.238, abs=1e-2)
    assert turns().bound(LOW, HIGH, FAST).least == math.inf
    assert turns(head=1.1).bound(LOW, HIGH, FAST).least == turns().bound(LOW, HIGH).least


@pytest.mark.parametrize(
    ("changes", "least"),
    [
        ({"least_radius": 1.525}, math.inf),
        ({"least_radius": 1.515}, 11.2),
        ({"longest": 11.2}, math.inf),
        ({"longest": 11.25}, 11.2),
        ({"longest_way": 11.2}, math.inf),
        ({"objective": "length"}, 11.2),
    ],
)
def test_a_box_is_out_if_all_its_turns_are_too_tight_or_too_long(
    changes: dict[str, object], least: float
) -> None:
    found = turns(**changes).bound(LOW, HIGH).least
    assert found == least or 0.0 < found - least < 0.1


@pytest.mark.parametrize(
    "witness",
    [
        Witness(False, -0.1, 2),  # before the head comes to the turn
        Witness(True, sum(LINKS) + 0.1, 2),  # the tail has left it, and handles behind are faster
        Witness(False, 3.6, len(LINKS) + 1),
        Witness(False, 3.6, -1),
    ],
)
def test_a_witness_counts_only_where_limits_do(witness: Witness) -> None:
    speed = turns(objective="speed")
    assert speed.bound(LOW, HIGH, Witness(True, sum(LINKS) - 0.1, 2)).least > -2.0
    assert speed.bound(LOW, HIGH, witness).least == speed.bound(LOW, HIGH).least
    assert speed.bound(LOW, HIGH).least == pytest.approx(-2.0)
    assert speed.bound(LOW, HIGH, FAST).least > -1.4
