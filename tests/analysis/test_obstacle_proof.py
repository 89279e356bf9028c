"""Touches of what stands still, proved; and what a proof looks over."""

import math
from dataclasses import replace

import numpy as np
import pytest

from benchdragon import Answer, Arc, Dragon, Line, Route, UnsureError, Walk
from benchdragon.analysis import obstacle_search, proof
from benchdragon.analysis.ledger import Ledger
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.analysis.obstacles import first_touch, obstacle_answers, touching
from benchdragon.analysis.proof import prove_obstacle
from benchdragon.kernels import standing as kernel
from benchdragon.model.obstacle import Obstacle
from tests.analysis.straights import ONE, east, kerb, wall


@pytest.fixture(scope="module")
def bend() -> Walk:
    route = Route.joined([Line(12.0), Arc(3.0, 2.0), Line(10.0)])
    return Walk(Dragon.of_sizes([1.6, 1.2, 1.2, 1.0], 0.4, 0.1, 0.1), route, start=6.0)


def proved(walk: Walk, obstacle: Obstacle, end: float) -> Answer | None:
    return prove_obstacle(walk, obstacle_answers(walk, obstacle, 0.0, end), 0.0, end).contact


def test_a_touch_is_proved(bend: Walk) -> None:
    pytest.importorskip("flint")
    post = Obstacle.circle("post", (14.0, 0.5), 0.1)
    plain, found = first_touch(bend, post, 0.0, 14.0), proved(bend, post, 14.0)
    assert plain is not None
    assert found is not None
    assert found.status == "proved"
    assert found.lower <= plain.upper
    assert plain.lower <= found.upper
    assert any("positions enclosed" in text for text in found.assumptions)


def test_a_touch_of_a_bench_behind_is_proved(bend: Walk) -> None:
    pytest.importorskip("flint")
    # Within the bend, where the chords of later benches cut deeper than their fronts do.
    walk = replace(bend, dragon=Dragon.of_sizes([1.0, 1.0, 2.4, 1.0], 0.4, 0.1, 0.1))
    post = Obstacle.circle(
        "post", (12.0 + 3.0 * math.sin(1.0) * 0.86, 3.0 - 3.0 * math.cos(1.0) * 0.86), 0.1
    )
    found = proved(walk, post, 14.0)
    assert found is not None
    assert found.status == "proved"
    assert found.witness is not None
    assert found.witness.benches == (3,)


def test_that_no_bench_touches_is_proved(bend: Walk) -> None:
    pytest.importorskip("flint")
    venue = Obstacle.venue("square", [(-20, -4), (25, -4), (25, 25), (-20, 25)], 0.2)
    assert proved(bend, venue, 14.0) is None


def test_a_graze_is_not_proved() -> None:
    pytest.importorskip("flint")
    found = proved(east(ONE), kerb(0.25), 4.0)
    assert found is not None
    assert found.status == "undecided"


def test_all_places_behind_an_answer_are_taken_down() -> None:
    ledger = Ledger()
    dragon = Dragon.of_sizes([2.0, 1.5, 1.5], [0.5, 0.7, 0.9], 0.25, 0.25)
    search = ObstacleSearch(east(dragon), wall(30.0, 0.4), 0.0, 40.0, 0.0, ledger)
    (found,) = touching(search)
    assert sum(len(chains[0]) for _link, chains in ledger.benches) <= search.evaluations
    at = {link: np.unique(np.concatenate([c[0] for other, c in ledger.benches if other == link]))
          for link in (1.5, 1.0)}  # fmt: skip
    # The first walks all its way, the two behind theirs until the third touches.
    assert (at[1.5][0], at[1.5][-1]) == (10.0, 50.0)
    assert np.diff(at[1.5]).max() <= kernel.STRETCH
    assert at[1.0][0] == 7.5
    assert np.abs(at[1.0] - 29.75).min() < 1e-12
    # The whole dragon at the start, then the first two benches at both ends of the bracket.
    assert ledger.evaluations[0][1].shape[1] == 4
    assert [chains[1].shape[1] for chains in ledger.evaluations][-2:] == [3, 3]
    assert ledger.evaluations[-1][0][0] == pytest.approx(10.0 + found.upper, abs=1e-12)


def test_a_proof_needs_errors_that_can_be_bounded(bend: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("flint")
    answers = obstacle_answers(bend, wall(90.0), 0.0, 2.0)
    slacks: list[float] = []
    wanted = iter([3e-13, 1e-12, 1e-12])

    def needed(_walk: Walk, _found: proof.Errors, extent: float) -> float:
        assert extent >= 90.0
        return next(wanted)

    def search(*arguments: object) -> ObstacleSearch:
        slacks.append(float(arguments[4]))  # type: ignore[arg-type]
        return ObstacleSearch(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(proof, "needed_slack", needed)
    monkeypatch.setattr(proof, "ObstacleSearch", search)
    assert prove_obstacle(bend, answers, 0.0, 2.0).contact is None
    assert slacks == [1e-13, 6e-13, 2e-12]
    monkeypatch.setattr(proof, "needed_slack", lambda *_arguments: 1.0)
    with pytest.raises(UnsureError, match="could not be bounded"):
        prove_obstacle(bend, answers, 0.0, 2.0)


def test_a_log_without_room_is_told_of(bend: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(obstacle_search, "LOG", 3)
    with pytest.raises(UnsureError, match="too many evaluations"):
        touching(ObstacleSearch(bend, wall(14.0), 0.0, 9.0, 0.0, Ledger()))
