"""The paper's answers proved as `reproduce` proves them: minutes of ball arithmetic."""

import json
from pathlib import Path

import pytest

from benchdragon.analysis.check import check
from benchdragon.paper import results
from benchdragon.plans.schema import read_plan
from benchdragon.solve.size import limit

TRUTH = json.loads((Path(__file__).parents[1] / "truth" / "contest.json").read_text("utf-8"))


def test_the_contests_first_contact_and_all_before_it_are_proved() -> None:
    report = check(read_plan("spiral-in"), prove=True)
    assert report.proved
    assert report.first_contact is not None
    assert report.first_contact.lower < float(TRUTH["first_contact_s"]) < report.first_contact.upper


def test_the_contests_smallest_pitch_is_proved() -> None:
    found = limit(read_plan("spiral-in", ["disc.radius=4.5"]), "pitch", prove=True)
    assert found.status == "proved"
    assert found.lower < float(TRUTH["smallest_pitch_m"]) < found.upper


class AskedError(Exception):
    """What a test expected to see was asked for."""


@pytest.mark.parametrize("there", [True, False])
def test_proofs_are_asked_for_where_they_can_be_made(
    there: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[bool] = []

    def checked(_plan: object, *, prove: bool) -> object:
        asked.append(prove)
        raise AskedError

    monkeypatch.setattr(results, "FRONT_SPEEDS", ())
    monkeypatch.setattr(results, "find_spec", lambda _name: object() if there else None)
    monkeypatch.setattr(results, "check", checked)
    with pytest.raises(AskedError):
        results.results()
    assert asked == [there]
