"""The best turn, proved: no turn that doubles can make is better than what is said."""

import json
import math
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("flint")

from benchdragon import InputError
from benchdragon.analysis.certificate import read_certificate
from benchdragon.cli.main import run
from benchdragon.errors import UnsureError
from benchdragon.kernels import motion_bounds
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import RouteRow
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.turn import best_turn
from benchdragon.solve.turn_certificate import (
    TurnCertificate,
    certificate_of,
    is_turn_certificate,
    verify,
)
from benchdragon.solve.turn_goal import TurnGoal
from benchdragon.solve.turn_proof import Node, TurnProof, proved_bound, turns_of, with_proof
from benchdragon.solve.turn_statement import TurnStatement
from tests.proofs.turns import turn_of

JOINTS = ("turn.entry_radius=4.5", "turn.exit_radius=4.5")
# The shortest path at 1.3 m/s that is known, m, between the disc's joints, bends no tighter than the
# paper's; and the paper's own.
KNOWN, PAPER = 11.346444, 13.621244906821
GOAL = TurnGoal("way", least_radius=1.5027)


def plan(*settings: str, family: str = "arc-line-arc") -> Plan:
    return read_plan("turn", [f"turn.family={family}", "walk.speed=1.3", *settings])


@cache
def proof(gap: float = 1e-2) -> TurnProof:
    """The shortest path between the disc's joints."""
    return proved_bound(plan(*JOINTS), GOAL, KNOWN, gap=gap)


def test_the_shortest_path_is_known_to_a_millimetre_in_some_hundred_boxes() -> None:
    found = proof(1e-3)
    assert found.complete
    assert KNOWN - 1e-3 <= found.bound <= KNOWN
    assert found.gap == pytest.approx(KNOWN - found.bound)
    assert found.boxes < 400


def ratio(numbers: np.ndarray, witness: Any) -> float:
    """The speed of a witness's handle by the head's on one turn, by the compiled march."""
    turn = turn_of("arc-line-arc", numbers.tolist())
    assert turn is not None
    rows, links = (
        turn.rows(lead=60.0, trail=60.0),
        plan().dragon.build().links[: max(witness.handle, 1)],
    )
    at = np.array([witness.head + float(rows[-1 if witness.backwards else 1, RouteRow.S_START])])
    places = empty_placements(len(links) + 1, 1)
    assert motion_bounds.place_chain(rows, links, at, 0, 1, places)
    return float(places.ratio[witness.handle, 0])


def test_every_turn_of_a_box_that_is_out_breaks_a_limit_there() -> None:
    rng, tried = np.random.default_rng(3), 0
    for leaf in proof().root.leaves():
        for _turn in range(5):
            numbers = np.array(leaf.low) + rng.random(4) * np.subtract(leaf.high, leaf.low)
            turn = turn_of("arc-line-arc", numbers.tolist())
            if leaf.bound == math.inf and leaf.witness is not None:
                assert 1.3 * ratio(numbers, leaf.witness) > 2.0
                tried += 1
            elif leaf.bound == math.inf:
                assert turn is None
            elif turn is not None:
                assert turn.way(4.5) >= leaf.bound
    assert tried > 100


def test_boxes_leave_nothing_out() -> None:
    root = proved_bound(plan(*JOINTS), GOAL, KNOWN, gap=1e-2, most=100).root
    sizes = [np.subtract(leaf.high, leaf.low)[2:].prod() for leaf in root.leaves()]
    assert sum(sizes) == pytest.approx(np.subtract(root.high, root.low)[2:].prod(), rel=1e-12)
    for numbers in np.array(root.low) + np.random.default_rng(5).random((200, 4)) * np.subtract(
        root.high, root.low
    ):
        assert any(
            (leaf.low <= numbers).all() and (numbers <= leaf.high).all() for leaf in root.leaves()
        )


def test_the_papers_turn_is_the_shortest_of_two_arcs_between_its_joints() -> None:
    found = proved_bound(plan(*JOINTS, family="arc-arc"), TurnGoal("way"), PAPER)
    assert found.complete
    assert PAPER - 1e-3 <= found.bound <= PAPER


def test_what_is_better_than_any_turn_is_no_bound_on_turns() -> None:
    found = proved_bound(plan(*JOINTS), GOAL, 11.0)
    assert (found.complete, found.bound, found.gap) == (True, 11.0, 0.0)


@pytest.mark.parametrize("most", [1, 20, 60])
def test_a_search_that_ends_early_has_a_bound_that_holds(most: int) -> None:
    found = proved_bound(plan(*JOINTS), GOAL, KNOWN, most=most)
    assert not found.complete
    assert found.boxes <= most + 1
    assert 5.0 < found.bound < KNOWN - 1e-3
    assert found.gap == pytest.approx(KNOWN - found.bound)


def test_more_boxes_tell_no_less() -> None:
    bounds = [proved_bound(plan(*JOINTS), GOAL, KNOWN, most=most).bound for most in (1, 9, 31, 99)]
    assert bounds == sorted(bounds)
    assert bounds[-1] > bounds[0] + 1.0


def test_an_interrupted_search_keeps_what_it_has_shown() -> None:
    shares: list[float] = []

    def interrupted(share: float, _text: str) -> None:
        shares.append(share)
        if len(shares) == 10:
            raise KeyboardInterrupt

    found = proved_bound(plan(*JOINTS), GOAL, KNOWN, progress=interrupted)
    assert (found.complete, len(shares)) == (False, 10)
    assert shares == sorted(shares)
    assert 5.0 < found.bound < KNOWN


def test_a_request_to_end_ends_it() -> None:
    def ended(_share: float, _text: str) -> None:
        raise KeyboardInterrupt(15)

    with pytest.raises(KeyboardInterrupt):
        proved_bound(plan(*JOINTS), GOAL, KNOWN, progress=ended)


def test_head_speeds_are_bounded_from_above() -> None:
    goal = TurnGoal("speed", longest_way=11.4, least_radius=1.5)
    found = proved_bound(plan(*JOINTS), goal, 1.35, gap=0.2, most=2000)
    best = max(
        2.0 / ratios
        for a in np.linspace(1.5, 1.65, 6)
        for b in np.linspace(1.5, 1.65, 6)
        if (turn := turn_of("arc-line-arc", (4.5, 4.5, a, b))) and turn.way(4.5) <= 11.4
        for ratios in [greatest_ratio(np.array([4.5, 4.5, a, b]))]
    )
    assert found.complete
    assert best <= found.bound <= 1.55 + 1e-9


def greatest_ratio(numbers: np.ndarray) -> float:
    turn = turn_of("arc-line-arc", numbers.tolist())
    assert turn is not None
    rows, links = turn.rows(lead=60.0, trail=60.0), plan().dragon.build().links[:12]
    at = np.linspace(float(rows[1, RouteRow.S_START]), float(rows[-1, RouteRow.S_START]) + 10.0, 400)
    places = empty_placements(13, 400)
    assert motion_bounds.place_chain(rows, links, at, 0, 400, places)
    return float(places.ratio.max())


@pytest.mark.parametrize(
    ("settings", "objective"),
    [
        (["turn.family=arc-arc-arc"], "way"),
        (["turn.ease=0.5"], "way"),
        ([], "disc"),
        ([], "acceleration"),
    ],
)
def test_what_cannot_be_proved_is_refused(settings: list[str], objective: str) -> None:
    with pytest.raises(InputError, match="arc-arc, arc-line-arc without clothoids, and for way"):
        turns_of(plan(*settings), TurnGoal(objective))


def test_limits_hold_for_all_turns_that_a_search_takes() -> None:
    turns, low, high = turns_of(plan(), TurnGoal("way", 1.5, 20.0, 30.0))
    assert 2.0 * (1.0 + 1e-7) < turns.fastest < 2.0 + 1e-5
    assert 1.5 - 1e-5 < turns.least_radius < 1.5 * (1.0 - 1e-7)
    assert 20.0 * (1.0 + 1e-7) < turns.longest < 20.0 + 1e-4
    assert 30.0 * (1.0 + 1e-7) < turns.longest_way < 30.0 + 1e-4
    assert low == pytest.approx((1.35, 1.35, 1.5, 1.5), rel=1e-15)
    assert high == (4.5, 4.5, 3.375, 3.375)


def test_bounds_are_told_on_the_side_that_is_true() -> None:
    _turns, low, high = turns_of(plan(*JOINTS), GOAL)
    said = TurnStatement(plan(*JOINTS), GOAL, low, high, 11.1234569)
    assert "shorter than 11.123456 m" in said.sentence()
    faster = replace(said, goal=replace(GOAL, objective="speed"), bound=1.2345671).sentence()
    assert "faster than 1.234568 m/s" in faster
    assert "entry radius 4.5, exit radius 4.5, first radius 1.5027 to 3.375" in faster
    assert "family arc-line-arc" in faster


def test_ratios_are_told_as_ratios() -> None:
    wish = TurnGoal("length", longest=20.0, longest_way=30.0)
    _turns, low, high = turns_of(plan(family="arc-arc"), wish)
    text = TurnStatement(plan(family="arc-arc"), wish, low, high, 9.0).sentence()
    kept = "handles at most 2.0 m/s with the head at 1.3 m/s, arcs of radius 1.43143 m or more, "
    kept += "a turn of at most 20.0 m, a path inside the disc of at most 30.0 m"
    assert re.search(r"ratio r1 : r2 0\.2\d* to (4\.9|5\.)\d+\) that keeps " + kept, text)
    assert f"{kept} is shorter than 9.000000 m" in text


def test_nothing_bounds_what_a_search_finds() -> None:
    found = best_turn(plan(*JOINTS, "dragon.benches=20"), TurnGoal("way"))
    answer = found.objective
    assert (answer.lower, answer.upper) == (-math.inf, answer.value)
    assert answer.as_json()["lower"] is None
    faster = best_turn(plan(*JOINTS, "dragon.benches=6"), TurnGoal("speed", longest_way=PAPER))
    assert faster.objective.lower <= faster.objective.value < faster.objective.upper == math.inf
    shown = with_proof(found, proof()).objective
    assert (shown.lower, shown.upper) == (proof().bound, answer.value)
    assert shown.assumptions[0].startswith(
        "proved: for 223 benches, spirals of pitch 1.7 m and a disc of radius 4.5 m, no turn"
    )
    assert not any("better ones may exist" in text for text in shown.assumptions)
    for gap, said in ((0.0201, "0.021"), (9.91e-4, "0.001"), (0.0, "0")):
        told = with_proof(found, replace(proof(), gap=gap)).objective.assumptions
        assert f"is within {said} m of that" in told[1]
    root = Node((4.5,), (4.5,), -math.inf)
    nothing = with_proof(found, replace(proof(), root=root, bound=-math.inf)).objective
    assert nothing.lower == -math.inf
    assert nothing.assumptions[-1] == "no bound on better turns could be proved"


def written() -> dict[str, Any]:
    """A certificate as JSON, to be tampered with."""
    found: dict[str, Any] = json.loads(certificate_of(plan(*JOINTS), GOAL, proof()).model_dump_json())
    return found


def test_a_certificate_is_shown_again_from_its_plan() -> None:
    shares: list[float] = []
    lines = verify(tampered(), lambda share, _text: shares.append(share))
    assert lines == [proof().statement(proof().bound).sentence()]
    assert len(shares) == len(list(proof().root.leaves()))
    assert shares[-1] == 1.0


def tampered(**changes: Any) -> TurnCertificate:
    return TurnCertificate.model_validate_json(json.dumps(written() | changes))


def first_witness(said: list[Any]) -> int:
    return next(n for n, one in enumerate(said) if one is not None)


def test_a_bound_that_is_too_good_is_not_believed() -> None:
    with pytest.raises(UnsureError, match="may hold a better one"):
        verify(tampered(bound=written()["bound"] + 1e-4))


@pytest.mark.parametrize("witness", [None, [False, 3.0, 0], [False, -5.0, 2], [True, 1e9, 2]])
def test_a_witness_that_shows_nothing_is_not_believed(witness: Any) -> None:
    said = written()["witnesses"]
    said[first_witness(said)] = witness
    with pytest.raises(UnsureError, match="may hold a better one"):
        verify(tampered(witnesses=said))


@pytest.mark.parametrize(
    "changed",
    [
        lambda across: across[:-1],
        lambda across: [*across, -1],
        lambda across: [4, *across[1:]],
        lambda across: [-2, *across[1:]],
        lambda across: [-1, *across[1:]],
    ],
)
def test_boxes_that_do_not_fit_are_refused(changed: Any) -> None:
    with pytest.raises(InputError, match="do not fit together"):
        verify(tampered(across=changed(written()["across"])))


def test_a_witness_more_or_less_is_refused() -> None:
    for said in (written()["witnesses"][:-1], [*written()["witnesses"], None]):
        with pytest.raises(InputError, match="do not fit together"):
            verify(tampered(witnesses=said))


def test_a_box_left_out_with_its_witness_is_missed() -> None:
    said = written()
    with pytest.raises(InputError, match="do not fit together"):
        verify(tampered(across=said["across"][:-1], witnesses=said["witnesses"][:-1]))


def test_boxes_halved_without_end_are_refused() -> None:
    with pytest.raises(InputError, match="do not fit together"):
        verify(tampered(across=[2] * 600 + [-1] * 601, witnesses=[None] * 601))


def test_another_plan_or_wish_is_not_what_was_proved() -> None:
    with pytest.raises(InputError, match="not the one"):
        verify(tampered(plan=plan(*JOINTS, "walk.speed=1.2").data()))
    slower = plan(*JOINTS, "walk.speed=1.2")
    with pytest.raises(UnsureError):
        verify(tampered(plan=slower.data(), plan_sha256=slower.sha256))
    with pytest.raises(UnsureError):
        verify(tampered(least_radius=1.45))


def test_nothing_proved_is_no_certificate() -> None:
    with pytest.raises(InputError, match="nothing was proved"):
        certificate_of(plan(*JOINTS), GOAL, replace(proof(), bound=-math.inf))


def test_the_command_line_proves_and_verifies(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "turn.json"
    settings = [f"--set={one}" for one in (*JOINTS, "turn.family=arc-line-arc", "walk.speed=1.3")]
    words = ["solve", "turn", "turn", "--quiet", *settings, "--least-radius", "1.5027", "--prove"]
    assert run([*words, "--within", "0.05", "--certificate", str(path), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["value"] - 0.05 <= found["lower"] == found["proof"]["bound"] < found["upper"]
    assert found["proof"]["ranges"]["first radius"] == [1.5027, 3.375]
    assert found["proof"]["complete"] is True
    assert is_turn_certificate(path)
    assert not is_turn_certificate(tmp_path)
    assert read_certificate(path, TurnCertificate).bound == found["lower"]
    assert run(["verify", str(path), "--quiet", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["verified"][0].startswith(
        "proved: for 223 benches, spirals of pitch 1.7 m and a disc of radius 4.5 m, no turn"
    )
    assert told["boxes"] > 10
    assert run([*words, "--boxes", "5", "--explain"]) == 5
    out = capsys.readouterr().out
    assert "more boxes would bring the two closer together" in out
    assert "branch and bound" in out


def test_options_of_a_proof_need_it(capsys: pytest.CaptureFixture[str]) -> None:
    for option in (["--within", "0.1"], ["--boxes", "9"], ["--certificate", "a.json"]):
        assert run(["solve", "turn", "turn", *option]) == 2
        assert f"{option[0]} goes with --prove alone" in capsys.readouterr().err
    assert run(["solve", "turn", "turn", "--prove", "--certificate", "a.txt"]) == 2
