"""Certificates: what is written is shown again, and whatever is not so is found out in a sentence."""

import json
import os
import re
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("flint")

from benchdragon.analysis import certificate, proof
from benchdragon.analysis.certificate import certificate_of, read_certificate, verify
from benchdragon.analysis.check import check
from benchdragon.analysis.contact import least_clearance
from benchdragon.analysis.proof import Claim, prove_clearance, prove_contact
from benchdragon.errors import BenchDragonError, InputError, MissingExtraError, UnsureError, WalkError
from benchdragon.plans.schema import checked
from benchdragon.plans.toml import PlanError
from tests.proofs.certificates import ASIDE, IN_THE_WAY, ON_A_BENCH, TOO_MUCH, bend, written
from tests.proofs.dances import coil

Written = dict[str, Any]
BENCHES, POST = 0, 1  # claims of a certificate, in order
ASIDE_POST = 'the circle "post" of radius 0.1 m about (16.2, 1) m'
# Benches 1 and 3 are never so far apart, m.
NEVER_KEPT = 1.3


@pytest.fixture
def shown(tmp_path: Path) -> Callable[[Written], list[str]]:
    """What a certificate says, once it was written to a file, read and verified."""

    def read_and_verified(what: Written) -> list[str]:
        path = tmp_path / "certificate.json"
        path.write_text(json.dumps(what), "utf-8")
        return verify(read_certificate(path))

    return read_and_verified


Shown = Callable[[Written], list[str]]


def test_a_clear_walk_is_verified(shown: Shown) -> None:
    assert shown(written()) == [
        "proved: no two non-adjacent benches nearer than 0 m from t = 10.0 s to t = 18.0 s",
        f"proved: no bench nearer than 0.05 m to {ASIDE_POST} from t = 10.0 s to t = 18.0 s",
    ]


def test_a_contact_of_benches_is_verified(shown: Shown) -> None:
    plan = written(margin=TOO_MUCH)
    first, second = shown(plan)
    assert first.startswith(
        "proved: no two non-adjacent benches nearer than 1.19 m from t = 10.0 s to t = 14.5506"
    )
    assert re.fullmatch(r".* s; nearer by t = 14\.5506\d* s: 1 3", first)
    assert second.startswith(
        f"proved: no bench nearer than 0.05 m to {ASIDE_POST} from t = 10.0 s to t = 14.5506"
    )
    found = check(bend(margin=TOO_MUCH)).first_contact
    assert found is not None
    claim = plan["claims"][BENCHES]
    assert found.lower <= claim["clear"] <= claim["contact"] <= found.upper
    assert claim["contact"] - claim["clear"] < 1e-12


def test_a_contact_with_an_obstacle_is_verified(shown: Shown) -> None:
    benches, post = shown(written(IN_THE_WAY))
    assert (
        benches == "proved: no two non-adjacent benches nearer than 0 m from t = 10.0 s to t = 18.0 s"
    )
    told = r".* the circle \"post\" of radius 0.1 m .* to t = 15\.65985\d* s; nearer by t = .* s: 1"
    assert re.fullmatch(told, post)


def test_a_coils_contact_is_verified_with_the_plan_alone(
    shown: Shown, monkeypatch: pytest.MonkeyPatch
) -> None:
    report = check(coil(0.44, dragon__benches=19, walk__start=25.9), prove=True)
    what = json.loads(certificate_of(report.plan, report.claims).model_dump_json())
    for search in ("contact_windows", "touching"):
        monkeypatch.delattr(f"benchdragon.analysis.proof.{search}")
    (told,) = shown(what)
    assert re.fullmatch(r".* from t = 25\.9 s to t = 26\.3684945\d* s; nearer by .* s: 1 19", told)


def test_times_are_told_as_they_were_shown(shown: Shown) -> None:
    for what in (written(margin=TOO_MUCH), written(IN_THE_WAY)):
        for claim, told in zip(what["claims"], shown(what), strict=True):
            numbers = [float(text) for text in re.findall(r"t = ([0-9.]+) s", told)]
            wanted = [claim["start"], claim["clear"], claim["contact"]]
            assert numbers == [number for number in wanted if number is not None]


def test_what_was_not_proved_gives_no_certificate() -> None:
    with pytest.raises(InputError, match="nothing was proved"):
        certificate_of(bend(), check(bend()).claims)


@pytest.mark.parametrize(("claim", "name"), [(BENCHES, "benches"), (POST, ASIDE_POST)])
def test_what_is_left_out_is_told(shown: Shown, claim: int, name: str) -> None:
    what = written()
    del what["claims"][claim]
    told = shown(what)
    assert len(told) == 2
    assert told[0].startswith("proved: ")
    assert told[1] == f"not in the certificate: {name}"


def first_cells(what: Written, claim: int = BENCHES) -> list[float]:
    cells: list[float] = what["claims"][claim]["cells"]
    return cells


def moved_plan(what: Written) -> None:
    what["plan"]["obstacle"][0]["centre"] = list(IN_THE_WAY)


def with_its_hash(post: tuple[float, float], margin: float) -> Callable[[Written], None]:
    """Put another plan with its right hash into a certificate."""

    def change(what: Written) -> None:
        other = bend(post, margin)
        what["plan"], what["plan_sha256"] = other.data(), other.sha256

    return change


def in_claim(name: str, value: Any, claim: int = BENCHES) -> Callable[[Written], None]:
    def change(what: Written) -> None:
        what["claims"][claim][name] = value

    return change


def with_cells(change: Callable[[list[float]], list[float]], claim: int = BENCHES) -> Any:
    def changed(what: Written) -> None:
        what["claims"][claim]["cells"] = change(first_cells(what, claim))

    return changed


def both(*changes: Callable[[Written], None]) -> Callable[[Written], None]:
    def change(what: Written) -> None:
        for each in changes:
            each(what)

    return change


CLEAR: dict[str, tuple[Callable[[Written], None], type[BenchDragonError], str]] = {
    "the plan": (moved_plan, InputError, "the plan in the certificate is not the one that it was"),
    "the hash": (lambda what: what.update(plan_sha256="0" * 64), InputError, "is not the one that"),
    "a post in the way": (with_its_hash(IN_THE_WAY, 0.0), UnsureError, '^"post": .* does not hold'),
    "a margin": (with_its_hash(ASIDE, TOO_MUCH), UnsureError, "^benches: .* does not hold"),
    "no plan": (lambda what: what.update(plan={}), PlanError, "the certificate: schema is missing"),
    "a plan's key": (lambda what: what["plan"].update(rout=1), PlanError, "rout is not a known key"),
    "a file named": (
        lambda what: what["plan"].update(route={"kind": "drawn", "file": "/etc/passwd"}),
        PlanError,
        "the certificate: ",
    ),
    "cells that begin late": (with_cells(lambda at: at[1:]), UnsureError, "begin after the start"),
    "cells that end early": (with_cells(lambda at: at[:-1]), UnsureError, "end before what they are"),
    "many cells as one": (with_cells(lambda at: [at[0], at[-1]]), UnsureError, "cell 1,.* not hold"),
    "cells in between left out": (
        with_cells(lambda at: [*at[:8], *at[38:]], POST),
        UnsureError,
        '^"post": .*cell 8,.* does not hold',
    ),
    "cells out of order": (
        with_cells(lambda at: [at[0], *at[2:0:-1], *at[3:]]),
        UnsureError,
        "cell 2 does not go on",
    ),
    "the same cell twice": (with_cells(lambda at: [*at[:3], *at[2:]]), UnsureError, "3 does not go on"),
    "a cell before the start": (with_cells(lambda at: [9.5, *at]), UnsureError, "which nothing rests"),
    "a cell behind the end": (with_cells(lambda at: [*at, 18.1]), UnsureError, "which nothing rests"),
    "cells beyond the route": (
        with_cells(lambda at: [*at[:-1], 1e300]),
        WalkError,
        "past the end of the route",
    ),
    "a start before the route": (
        both(with_cells(lambda at: [-5.0, *at]), in_claim("start", -5.0)),
        UnsureError,
        r"other times than those of the walk, 10\.0 s to 18\.0 s",
    ),
    "an end before the start": (
        both(in_claim("start", 12.0), in_claim("clear", 11.0)),
        UnsureError,
        "it ends before it starts",
    ),
    "an end behind the walk's": (in_claim("clear", 18.1), UnsureError, "other times than those of"),
    "an instant at which benches are too near": (
        both(with_its_hash(ASIDE, NEVER_KEPT), with_cells(lambda at: at[:1]), in_claim("clear", 10.0)),
        UnsureError,
        "benches: .* nothing is shown at 10.0 m",
    ),
    "an instant at which a bench is too near": (
        both(
            with_its_hash(ON_A_BENCH, 0.0),
            with_cells(lambda at: at[:1], POST),
            in_claim("clear", 10.0, POST),
        ),
        UnsureError,
        '"post": .* nothing is shown at 10.0 m',
    ),
    "another obstacle": (in_claim("about", "wall", POST), InputError, "plan has no obstacle 'wall'"),
    "an obstacle as benches": (
        both(in_claim("about", "", POST), in_claim("benches", [0], POST)),
        InputError,
        "names no benches of this dragon",
    ),
}

MEETING: dict[str, tuple[Callable[[Written], None], type[BenchDragonError], str]] = {
    "cells beyond the contact": (
        with_cells(lambda at: [*at, at[-1] + 1e-4]),
        UnsureError,
        "^benches: .*cell 64, from .* does not hold",
    ),
    "clear until later": (in_claim("clear", 14.6), UnsureError, "the cells end before"),
    "a contact before it comes": (
        both(in_claim("s", 14.55), in_claim("contact", 14.55)),
        UnsureError,
        "^benches: the contact could not be shown",
    ),
    "a time before it comes": (in_claim("contact", 14.55), UnsureError, "the contact could not be"),
    "others that do not meet": (in_claim("benches", [1, 4]), UnsureError, "the contact could not be"),
    "neighbours": (in_claim("benches", [2, 1]), InputError, "names benches that are joined"),
    "a bench with itself": (in_claim("benches", [2, 2]), InputError, "names benches that are joined"),
    "benches that are not there": (in_claim("benches", [0, 6]), InputError, "names no benches of"),
    "benches below the first": (in_claim("benches", [-1, 2]), InputError, "names no benches of"),
    "one bench": (in_claim("benches", [0]), InputError, "names no benches of"),
    "no benches": (in_claim("benches", []), InputError, "names no benches of"),
    "benches without a time": (in_claim("contact", None), InputError, "names no benches of"),
    "a time without a place": (in_claim("s", None), InputError, "names no benches of"),
}


@pytest.mark.parametrize("name", list(CLEAR))
def test_a_clear_walk_that_was_tampered_with_is_found_out(shown: Shown, name: str) -> None:
    change, error, text = CLEAR[name]
    what = written()
    change(what)
    with pytest.raises(error, match=text):
        shown(what)


@pytest.mark.parametrize("name", list(MEETING))
def test_a_contact_that_was_tampered_with_is_found_out(shown: Shown, name: str) -> None:
    change, error, text = MEETING[name]
    what = written(margin=TOO_MUCH)
    change(what)
    with pytest.raises(error, match=text):
        shown(what)


def test_benches_of_a_contact_may_stand_in_either_order(shown: Shown) -> None:
    what = written(margin=TOO_MUCH)
    what["claims"][BENCHES]["benches"].reverse()
    assert shown(what)[0].endswith(" s: 3 1")


def test_fewer_cells_show_a_shorter_time_and_say_so(shown: Shown) -> None:
    what = written()
    claim = what["claims"][BENCHES]
    claim["cells"], claim["clear"] = claim["cells"][:5], round(claim["cells"][4] - 5e-5, 4)
    lines = shown(what)
    assert lines[0].endswith(f"from t = 10.0 s to t = {claim['clear']!r} s")
    rest = f"not in the certificate: benches from t = {claim['clear']!r} s to t = 18.0 s"
    assert lines[-1] == rest


def deep(levels: int) -> bytes:
    return b'{"plan": ' + b"[" * levels + b"]" * levels + b"}"


def changed(**more: Any) -> bytes:
    return json.dumps(written() | more).encode()


def changed_claim(**more: Any) -> bytes:
    return changed(claims=[written()["claims"][BENCHES] | more])


FILES: dict[str, tuple[Callable[[], bytes], str]] = {
    "nothing": (lambda: b"", "see JSON"),
    "no JSON": (lambda: b"schema = 1", "see JSON"),
    "no UTF-8": (lambda: b'"\xff\xfe"', "see JSON"),
    "torn": (lambda: json.dumps(written()).encode()[:-20], "see JSON"),
    "deep": (lambda: deep(100_000), "see JSON"),
    "a list": (lambda: b"[]", "see JSON"),
    "another format": (lambda: changed(format="certificate"), "see format"),
    "an unknown key": (lambda: changed(more=1), "see more"),
    "an unknown key of a claim": (lambda: changed_claim(sure=True), "see claims.0.sure"),
    "no claims": (lambda: changed(claims=[]), "see claims"),
    "too many claims": (lambda: changed(claims=written()["claims"] * 501), "see claims"),
    "no cells": (lambda: changed_claim(cells=[]), "see claims.0.cells"),
    "NaN": (lambda: changed_claim(cells=[10.0, float("nan")]), "see claims.0.cells.1"),
    "infinity": (lambda: changed_claim(clear=float("inf")), "see claims.0.clear"),
    "a number of 5000 digits": (lambda: changed_claim(start=10**4000), "see "),
    "a text as a number": (lambda: changed_claim(start="10"), "see claims.0.start"),
    "half a bench": (lambda: changed_claim(benches=[0.5, 2]), "see claims.0.benches.0"),
    "three benches": (lambda: changed_claim(benches=[0, 2, 4]), "see claims.0.benches"),
    "a plan that is a text": (lambda: changed(plan="bend"), "see plan"),
}


@pytest.mark.parametrize("name", list(FILES))
def test_what_is_no_certificate_is_refused_with_where_to_look(tmp_path: Path, name: str) -> None:
    content, where = FILES[name]
    path = tmp_path / "odd.json"
    path.write_bytes(content())
    with pytest.raises(InputError, match=f"odd.json is no certificate .*: {where}") as refused:
        read_certificate(path)
    assert len(str(refused.value)) < 300


def test_a_file_larger_than_any_certificate_is_not_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "large.json"
    path.write_text(json.dumps(written()), "utf-8")
    monkeypatch.setattr(certificate, "MOST_BYTES", path.stat().st_size)
    assert read_certificate(path).plan_sha256 == bend().sha256
    monkeypatch.setattr(certificate, "MOST_BYTES", path.stat().st_size - 1)
    monkeypatch.setattr(Path, "read_bytes", lambda _path: pytest.fail("it was read"))
    with pytest.raises(InputError, match=r"large\.json is larger than any certificate"):
        read_certificate(path)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.json: there is no such file"):
        read_certificate(tmp_path / "none.json")


@pytest.mark.parametrize("name", [".", "pipe", "/dev/zero", "/dev/null"])
def test_what_is_no_file_is_not_read(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match="is no file that could be a certificate"):
        read_certificate(tmp_path / name)


def test_a_name_that_no_system_has_is_refused() -> None:
    with pytest.raises(InputError, match="cannot be read"):
        read_certificate(Path("\ud800"))


def test_verifying_needs_the_extra(shown: Shown, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing() -> None:
        raise MissingExtraError("prove")

    monkeypatch.setattr(certificate, "require_flint", missing)
    with pytest.raises(MissingExtraError):
        shown(written())


@pytest.mark.parametrize("shape", ["rectangle", "venue"])
def test_an_obstacle_about_all_benches_is_no_clear_start(shown: Shown, shape: str) -> None:
    # No side of it comes near the dragon, which stands where none may.
    what = written()
    data = bend().data()
    large = {"name": "post", "points": [[-90, -90], [90, -90], [90, 90], [-90, 90]]}
    away = {"name": "post", "boundary": [[60, 60], [90, 60], [90, 90], [60, 90]]}
    data |= {"obstacle": [large | {"kind": "polygon"}]} if shape == "rectangle" else {
        "obstacle": [], "venue": away}  # fmt: skip
    inside = checked(data, "inside")
    what["plan"], what["plan_sha256"] = inside.data(), inside.sha256
    del what["claims"][BENCHES]
    with pytest.raises(UnsureError, match='"post": a bench may stand at the start where none may'):
        shown(what)


def test_a_contact_at_the_start_shows_no_time_before(shown: Shown) -> None:
    benches, post = shown(written(margin=NEVER_KEPT))
    assert benches == "proved: benches nearer than 1.3 m by t = 10.0 s: 1 3"
    assert post.endswith(f" nearer than 0.05 m to {ASIDE_POST} from t = 10.0 s to t = 10.0 s")
    near = shown(written(ON_A_BENCH))[POST]
    assert re.fullmatch(r"proved: nearer than 0\.05 m to the .*\"post\" .* by t = 10\.0 s: 1", near)


def test_a_walk_that_stands_is_shown_too() -> None:
    standing = bend().with_value("walk.end", 10.0)
    told = verify(certificate_of(standing, check(standing, prove=True).claims))
    assert [text.split(" from ")[1] for text in told] == ["t = 10.0 s to t = 10.0 s"] * 2


def test_a_search_that_overlooks_a_contact_of_a_standing_dragon_is_not_believed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    walk = bend().build()
    assert prove_contact(walk, 10.0, 10.0, margin=1.1) is None
    monkeypatch.setattr(proof, "contact_windows", lambda *_arguments, **_more: [])
    with pytest.raises(UnsureError, match="could not be shown"):
        prove_contact(walk, 10.0, 10.0, margin=NEVER_KEPT)


def test_a_report_keeps_its_claims_as_they_are_written() -> None:
    report = check(bend(margin=TOO_MUCH), prove=True)
    found = certificate_of(report.plan, report.claims)
    assert json.loads(found.model_dump_json()) == written(margin=TOO_MUCH)


def test_a_number_with_more_digits_than_are_shown_is_refused(tmp_path: Path) -> None:
    path, text = tmp_path / "certificate.json", json.dumps(written())
    for old, new in (
        ('"width": 0.2', '"width": 0.2000000000000000001'),
        ("18.0", "18.0000000000000001"),
    ):
        assert old in text
        path.write_text(text.replace(old, new, 1), "utf-8")
        with pytest.raises(InputError, match=r"certificate says \d+\.0*2?0+1, of which .* alone"):
            read_certificate(path)


@pytest.mark.parametrize("time", [10.1, 10.3])
def test_times_are_decimals(shown: Shown, time: float) -> None:
    what = written()
    claim = what["claims"][BENCHES]
    inner = [10.0 + 0.02 * n for n in range(20) if n < 50.0 * (time - 10.0) - 0.5]
    claim["cells"], claim["clear"] = [*inner, time], time
    if Fraction(time) > Fraction(repr(time)):  # the cells are doubles: this one ends behind the time
        shown(what)
    else:
        with pytest.raises(UnsureError, match="cells end before"):
            shown(what)


def with_margin(what: Written, claim: int, margin: float) -> Written:
    """Another certificate, a claim of which has this margin, m."""
    other: Written = json.loads(json.dumps(what))
    in_claim("margin", margin, claim)(other)
    return other


def test_a_clearance_is_verified_with_margins_of_its_own(shown: Shown) -> None:
    plan = bend()
    walk, (start, end) = plan.build(), (10.0, 18.0)
    claims: list[Claim] = []
    found = least_clearance(walk, start, end)
    answer = prove_clearance(walk, found, start, end, claims=claims, plan=plan)
    assert answer.status == "proved"
    assert answer.lower <= found.value <= answer.upper <= answer.lower + 1.1e-6
    what = json.loads(certificate_of(plan, claims).model_dump_json())
    clear, near, *left = shown(what)
    assert clear == (
        f"proved: no two non-adjacent benches nearer than {answer.lower!r} m from t = 10.0 s to "
        "t = 18.0 s"
    )
    assert near.startswith(f"proved: benches nearer than {answer.upper!r} m by t = ")
    assert left == ["not in the certificate: benches", f"not in the certificate: {ASIDE_POST}"]
    for claim, margin in ((0, answer.lower + 2e-6), (1, answer.lower - 1e-6)):
        with pytest.raises(UnsureError):
            shown(with_margin(what, claim, margin))
    with pytest.raises(InputError, match="margin"):
        shown(with_margin(what, 0, -1.0))


def test_a_clearance_that_is_not_the_least_is_not_proved() -> None:
    plan = bend()
    walk, found = plan.build(), least_clearance(plan.build(), 10.0, 18.0)
    for off in (-1e-5, 1e-5):
        with pytest.raises(UnsureError):
            prove_clearance(walk, replace(found, value=found.value + off), 10.0, 18.0, plan=plan)


def test_a_claim_about_other_sizes_says_so(shown: Shown) -> None:
    what = written()
    wider = in_claim("values", {"dragon.width": 0.25})
    wider(what)
    (benches, post, *left) = shown(what)
    assert benches.startswith("with dragon.width = 0.25: proved: no two non-adjacent benches nearer")
    assert post.startswith(f"proved: no bench nearer than 0.05 m to {ASIDE_POST}")
    assert left == [
        f"with dragon.width = 0.25: not in the certificate: {ASIDE_POST}",
        "not in the certificate: benches",
    ]
    in_claim("values", {"dragon.width": 1.6})(what)  # touches, at 17.1 s
    with pytest.raises(UnsureError, match="does not hold"):
        shown(what)
    in_claim("values", {"dragon.with": 0.25})(what)
    with pytest.raises(PlanError, match="not a known key"):
        shown(what)
