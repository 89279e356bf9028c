"""Certificates that were altered: none is accepted that is false, and one would be found out."""

import json
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("flint")

from benchdragon.analysis import proof, speed_proof
from benchdragon.proofs import turn_boxes
from tests.hostile.certificates import (
    BESIDE,
    CONFIRMED,
    FALSE,
    OPEN,
    REFUSED,
    altered,
    certificates,
    counted,
    outcome,
)


@pytest.mark.parametrize("first", range(0, 60, 30))
def test_no_altered_certificate_is_accepted_that_is_false(first: int) -> None:
    counts = counted(range(first, first + 30))
    assert counts[FALSE] == 0
    assert min(counts[kind] for kind in (REFUSED, OPEN, CONFIRMED)) > 3
    assert counts[BESIDE] < 4


def test_what_was_not_altered_is_accepted_and_confirmed(tmp_path: Path) -> None:
    kinds = {outcome(text, tmp_path).kind for text in certificates()}
    assert kinds == {CONFIRMED}


def test_seeds_are_altered_alike_each_time() -> None:
    assert altered(7) == altered(7) != altered(8)


def _with(text: str, claim: int, **more: Any) -> str:
    what = json.loads(text)
    what["claims" if "most" not in more else "speeds"][claim] |= more
    return json.dumps(what)


def test_what_is_false_would_be_found_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(proof.Question, "verify", lambda *_given, **_more: None)
    monkeypatch.setattr(speed_proof.SpeedQuestion, "verify", lambda *_given, **_more: None)
    contact, post, _start, square, *_rest, turn = certificates()
    wrong = [
        _with(contact, 0, margin=1.3),
        _with(contact, 0, clear=14.7),
        _with(contact, 0, contact=14.1, clear=14.0),
        _with(contact, 0, benches=[0, 5]),
        _with(post, 1, contact=None, s=None, benches=[], clear=15.8),
        _with(post, 1, contact=15.4, clear=15.3),
        _with(square, 0, margin=1.25),
        _with(square, 0, most=0.5),
        _with(square, 0, most=9.0, least=8.0),
    ]
    assert [outcome(text, tmp_path).kind for text in wrong] == [FALSE] * len(wrong)
    monkeypatch.setattr(
        turn_boxes.Turns, "bound", lambda *_given: turn_boxes.Bound(1e9, (1.0, 1.0, 1.0, 1.0))
    )
    what = json.loads(turn) | {"bound": 1000.0}
    assert outcome(json.dumps(what), tmp_path).kind == FALSE
