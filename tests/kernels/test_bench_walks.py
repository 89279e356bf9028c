"""What each bench does: moments, stretches that are joined, and bends of routes."""

import math
from itertools import pairwise

import numpy as np
import pytest

from benchdragon.analysis.bench_walks import bench_walks
from benchdragon.analysis.bends import Bends
from benchdragon.kernels.bench_walks import PACE_PIECE_COLUMNS, PacePiece, alike, join_short
from benchdragon.kernels.bends import Bend
from benchdragon.model.curves import Arc, Clothoid, Line, Route
from benchdragon.plans.schema import checked
from tests.counting import lines_run

Piece = tuple[float, int, int]


def joined(pieces: list[Piece], end: float) -> list[Piece]:
    """Pieces, (start, side, pace), after short ones were joined to others."""
    line = np.zeros((len(pieces) + 1, PACE_PIECE_COLUMNS))
    for n, piece in enumerate(pieces):
        line[n, [PacePiece.TIME, PacePiece.SIDE, PacePiece.PACE]] = piece
    line[-1, PacePiece.TIME] = end
    tree = np.empty(2 << max(len(pieces) - 1, 0).bit_length())
    left, n, found = join_short(line, tree, len(pieces)), 0, []
    for _piece in range(left):
        found.append(
            (float(line[n, PacePiece.TIME]), int(line[n, PacePiece.SIDE]), int(line[n, PacePiece.PACE]))
        )
        n = int(line[n, PacePiece.NEXT])
    assert n == len(pieces)
    return found


def test_a_short_stretch_is_joined_to_the_longer_neighbour() -> None:
    pieces = [(0.0, 0, 1), (2.0, 1, 1), (2.5, -1, 1)]
    assert joined(pieces, 9.0) == [pieces[0], (2.0, -1, 1)]
    assert joined(pieces, 3.9) == [pieces[0], pieces[2]]
    assert joined(pieces[:2], 2.5) == pieces[:1]
    assert joined(pieces[1:2], 2.1) == pieces[1:2]


def test_what_is_joined_is_joined_again_to_neighbours_that_are_alike() -> None:
    assert joined([(0.0, 0, 1), (2.0, 1, 1), (2.5, 0, 1)], 3.5) == [(0.0, 0, 1)]
    assert joined([(0.0, 0, 1), (1.5, 1, 1), (2.0, 0, 1)], 9.0) == [(0.0, 0, 1)]


@pytest.mark.parametrize("seed", range(20))
def test_no_short_stretch_is_left_and_no_two_neighbours_are_alike(seed: int) -> None:
    chance = np.random.default_rng(seed)
    starts = np.cumsum(chance.exponential(0.8, 40)).tolist()
    pieces = [(0.0, 0, 0)]
    for start in starts:
        side, pace = (int(value) for value in chance.integers(0, 2, 2))
        if (side, pace) != pieces[-1][1:]:
            pieces.append((start, side, pace))
    found, end = joined(pieces, starts[-1] + 0.5), starts[-1] + 0.5
    cuts = [*(start for start, _side, _pace in found), end]
    assert len(found) == 1 or min(np.diff(cuts)) >= 1.0
    assert all(one[1:] != after[1:] for one, after in pairwise(found))
    assert {piece[0] for piece in found} <= {piece[0] for piece in pieces}


def test_joining_short_stretches_is_work_in_proportion_to_them() -> None:
    def work(count: int) -> int:
        pieces = [(0.3 * n, n % 2, n % 3) for n in range(count)]
        return lines_run(lambda: joined(pieces, 0.3 * count))

    assert work(800) < 6 * work(200)


def test_pieces_are_alike_by_side_and_pace() -> None:
    line = np.zeros((3, PACE_PIECE_COLUMNS))
    line[1, PacePiece.SIDE], line[2, PacePiece.PACE] = 1.0, 1.0
    assert [alike(line, 0, n) for n in range(3)] == [True, False, False]


def test_bends_change_where_the_route_changes_its_side_and_turns_add_up_over_kinks() -> None:
    route = Route.joined([Line(5.0), Arc(2.0, 1.5), Clothoid(6.0, 0.4, -0.2), Line(3.0)])
    bends = Bends.of(route)
    assert bends.sides.tolist() == [Bend.AHEAD, Bend.LEFT, Bend.RIGHT, Bend.AHEAD]
    assert bends.at.tolist() == pytest.approx([-math.inf, 5.0, 12.0, 14.0])
    turned = [0.0, 0.0, 1.5, 1.5 + 6.0 * 0.1]
    assert bends.turned[[0, 1, 2, -1]].tolist() == pytest.approx(turned, abs=1e-12)
    kinked = Route((Line(2.0), Line(2.0, (2.0, 0.0), 4.0)), kinks=True)
    assert Bends.of(kinked).turned.tolist() == pytest.approx([0.0, 4.0 - 2.0 * math.pi])


def test_what_is_passed_in_one_step_is_told_in_its_order(monkeypatch: pytest.MonkeyPatch) -> None:
    """In one step of 10 s the head takes three paces, and goes through an arc between them."""
    monkeypatch.setattr("benchdragon.analysis.bench_walks.STEP", 20.0)
    line = {"kind": "line", "length": 12}
    parts = [line, {"kind": "arc", "radius": 4, "angle": 60}, {**line, "length": 20}]
    plan = checked(
        {
            "schema": 1,
            "dragon": {"benches": 2},
            "route": {"kind": "parts", "part": parts},
            "walk": {"profile": [[0, 0], [10, 2]], "position": 10, "end": 13},
        },
        "test",
    )
    head, _tail = bench_walks(plan, plan.build(), (0.0, 13.0))
    told = [(one.turning, one.pace) for one in head.stretches]
    assert told == [
        ("straight", "walk"), ("left", "walk"), ("left", "hurry"), ("straight", "hurry"),
        ("straight", "run"),
    ]  # fmt: skip
    # The speed is t/5 m/s, the way t^2/10 m; waiting, up to 0.25 s, is joined to walking.
    passed = [0.0, math.sqrt(20.0), 6.0, math.sqrt(20.0 + 40.0 * math.pi / 3.0), 9.0]
    assert [one.start for one in head.stretches] == pytest.approx(passed, abs=1e-6)
    assert [one.speeds for one in head.stretches][1:3] == [
        pytest.approx((passed[1] / 5.0, 1.2)), pytest.approx((1.2, passed[3] / 5.0)),
    ]  # fmt: skip
    assert sum(one.angle for one in head.stretches) == pytest.approx(math.pi / 3.0)
