"""What a check found beside contact is proved too: the least clearance, and the greatest speed."""

import math
from dataclasses import replace

import pytest

pytest.importorskip("flint")

from benchdragon.analysis.certificate import certificate_of, verify
from benchdragon.analysis.check import Report, check
from benchdragon.analysis.proved_report import prove_report
from benchdragon.plans.schema import Plan, checked
from benchdragon.proofs import cover
from tests.proofs.certificates import TOO_MUCH, bend


def proved(plan: Plan) -> Report:
    return prove_report(check(plan, prove=True))


def sentences(report: Report) -> list[str]:
    """What its certificate says, once it is shown again."""
    return verify(certificate_of(report.plan, report.claims, report.speeds))


def test_clearance_and_speed_are_proved_where_they_were_found() -> None:
    plan = checked(bend().data() | {"walk": {"start": 10, "end": 18, "speed": 0.7}}, "bend")
    found, report = check(plan), proved(plan)
    assert report.unproved == ()
    near, fast = report.clearance, report.greatest_speed
    assert (near.status, fast.status) == ("proved", "proved")
    assert near.lower <= found.clearance.value <= near.upper <= near.lower + 1.1e-6
    assert fast.lower <= found.greatest_speed.value <= fast.upper <= fast.lower * (1.0 + 2e-7)
    clear, post, margin, nearer, speed = sentences(report)[:5]
    assert f"nearer than {near.lower!r} m from t = 10.0 s" in margin
    assert nearer.startswith(f"proved: benches nearer than {near.upper!r} m")
    (claim,) = report.speeds
    # What is said of speeds is of a head at 1 m/s: rounded outwards, it is what the answer says.
    assert math.nextafter(0.7 * claim.least, -1) <= fast.lower <= math.nextafter(0.7 * claim.least, 9)
    assert math.nextafter(0.7 * claim.most, -1) <= fast.upper <= math.nextafter(0.7 * claim.most, 9)
    assert f"ever more than {claim.most!r} times as fast" in speed
    assert "post" in post
    assert "nearer than 0 m" in clear


def test_up_to_a_contact_no_more_is_proved() -> None:
    report = proved(bend(margin=TOO_MUCH))
    contact = report.first_contact
    assert contact is not None
    assert report.unproved == ()
    assert report.clearance.lower <= TOO_MUCH <= report.clearance.upper + 1e-6
    assert {claim.clear for claim in report.claims[-2:-1]} == {contact.upper}
    assert report.speeds[0].clear == contact.upper
    assert sentences(report)


def test_the_speed_of_a_head_that_changes_its_own_stays_found() -> None:
    data = bend().data()
    for change in (
        {"walk": {"start": 10, "end": 18, "profile": [[0, 1.0], [20, 1.2]]}},
        {"cues": {"acceleration": 0.3}},
    ):
        report = proved(checked(data | change, "bend"))
        assert report.greatest_speed == replace(
            check(report.plan).greatest_speed, seconds=report.greatest_speed.seconds
        )
        assert report.speeds == ()
        (text,) = (one.text for one in report.unproved)
        assert text == "not proved: greatest speed: it is proved only where the head keeps one speed"
        assert report.clearance.status == "proved"


def test_a_clearance_that_is_wrong_stays_found_and_is_told() -> None:
    report = check(bend(), prove=True)
    wrong = replace(report.clearance, value=report.clearance.value + 1e-5)
    shown = prove_report(replace(report, clearance=wrong))
    assert shown.clearance == wrong
    (text,) = (one.text for one in shown.unproved)
    assert text.startswith("not proved: least clearance: ")
    assert shown.claims == report.claims


def test_a_clearance_too_dear_to_prove_stays_found_and_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    report = check(bend(), prove=True)
    monkeypatch.setattr(cover, "BALLS", 1e7)  # a proof takes more than a question may
    shown = prove_report(report)
    assert [one.kind for one in shown.unproved] == ["clearance", "speed"]
    assert (shown.clearance, shown.greatest_speed) == (report.clearance, report.greatest_speed)
