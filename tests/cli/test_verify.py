"""`verify` on the command line: what check --prove wrote is shown again, or refused in a sentence."""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("flint")

from benchdragon.cli.main import run
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import checked
from benchdragon.proofs import cover as chain_cover
from benchdragon.version import __version__
from tests.proofs.certificates import IN_THE_WAY, TEXT, TOO_MUCH, bend, written

# What is called contact where it could not be proved.
WHAT = {"en": "whether and when benches touch", "zh": "板凳是否相碰、何时相碰"}
CLEAR = [
    "proved: no two non-adjacent benches nearer than 0 m from t = 10.0 s to t = 18.0 s",
    'proved: no bench nearer than 0.05 m to the circle "post" of radius 0.1 m about (16.2, 1) m from '
    "t = 10.0 s to t = 18.0 s",
]


@pytest.fixture
def certificate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A certificate in a folder of its own, which is the working one."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "certificate.json"
    path.write_text(json.dumps(written()), "utf-8")
    return path


def test_what_check_writes_is_verified_by_another_process(tmp_path: Path) -> None:
    plan, folder = tmp_path / "bend.dragon.toml", tmp_path / "out"
    plan.write_text(TEXT.format(post=list(IN_THE_WAY), margin=0.0), "utf-8")
    kept = tmp_path / "kept.json"
    line = ["check", str(plan), "--prove", "-o", str(folder), "--format", "svg"]
    assert run([*line, "--certificate", str(kept)]) == 1
    assert sorted(path.name for path in folder.iterdir()) == ["clearance.svg", "contact.svg"]
    done = subprocess.run(
        [sys.executable, "-m", "benchdragon", "verify", str(kept), "--json"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    told = json.loads(done.stdout)
    assert told["verified"][0] == CLEAR[0]
    assert told["verified"][1].startswith(
        'proved: no bench nearer than 0.05 m to the circle "post" of radius 0.1 m about (14.6, 1) m '
        "from t = 10.0 s to t = 15.6598"
    )
    assert told["plan_sha256"] == bend(IN_THE_WAY).sha256
    claims = json.loads(kept.read_text("utf-8"))["claims"]
    assert told["cells"] == sum(len(claim["cells"]) - 1 for claim in claims) > 20


def test_speeds_are_in_the_certificate_of_all_and_what_is_not_proved_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    plan, path = tmp_path / "bend.dragon.toml", tmp_path / "certificate.json"
    plan.write_text(TEXT.format(post=list(IN_THE_WAY), margin=0.0), "utf-8")
    line = ["check", str(plan), "--prove-all", "--certificate", str(path), "--quiet"]
    assert run([*line, "--lang", "en"]) == 1
    told = capsys.readouterr()
    assert told.err == ""
    assert "(proved)" in told.out.split("greatest speed of a handle")[1]
    kept = json.loads(path.read_text("utf-8"))
    assert len(kept["speeds"]) == 1
    assert run(["verify", str(path), "--quiet", "--lang", "en"]) == 0
    assert "no handle is ever more than" in capsys.readouterr().out
    again = [*line, "--force", "--set", "cues.acceleration=0.3", "--lang", "en"]
    assert run(again) == 1
    told = capsys.readouterr()
    assert told.err == ""
    assert told.out.splitlines()[3] == (
        "not proved: greatest speed: it is proved only where the head keeps one speed"
    )
    assert "(proved)" not in told.out.split("greatest speed of a handle")[1]


def test_what_takes_too_much_to_prove_ends_with_what_was_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(chain_cover, "BALLS", 1e7)  # a proof takes more than a question may
    plan, folder = tmp_path / "bend.dragon.toml", tmp_path / "out"
    plan.write_text(TEXT.format(post=[16.2, 1.0], margin=0.0), "utf-8")
    line = ["check", str(plan), "--prove", "-o", str(folder), "--format", "svg", "--quiet"]
    assert run([*line, "--lang", "en"]) == 5
    out, err = capsys.readouterr()
    assert out.startswith("SAFE from t = 10")
    assert "proved" not in out.splitlines()[0]
    assert out.splitlines()[1].startswith(f"not proved: {WHAT['en']}: this takes more work than a ")
    assert err == ""
    assert sorted(path.name for path in folder.iterdir()) == ["clearance.svg", "contact.svg"]
    for language in ("en", "zh"):
        with spoken_in(language):
            assert run([*line, "--force", "--json", "--explain"]) == 5
        told = json.loads(capsys.readouterr().out)
        (unproved,) = told["unproved"]
        assert (told["safe"], told["proved"], unproved["kind"]) == (True, False, "contact")
        for name, what in WHAT.items():
            assert what in unproved["text"][name]
            assert what in told["sentence"][name]
        assert unproved["text"]["en"] != unproved["text"]["zh"]
        assert unproved["text"][language] in told["explanation"]
    plan.write_text(TEXT.format(post=list(IN_THE_WAY), margin=0.0), "utf-8")
    assert run([*line, "--force", "--lang", "en"]) == 1
    verdict, finding, _, unproved, *_ = capsys.readouterr().out.splitlines()
    assert (verdict, finding[:8]) == ("NOT SAFE", "  BD304:")
    assert unproved.startswith(f"not proved: {WHAT['en']}: ")


def test_where_nothing_was_proved_no_certificate_is_written_and_that_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(chain_cover, "BALLS", 1e7)
    plan, path = tmp_path / "bend.dragon.toml", tmp_path / "certificate.json"
    plan.write_text(TEXT.format(post=[16.2, 1.0], margin=0.0), "utf-8")
    line = ["check", str(plan), "--prove", "--certificate", str(path), "--quiet", "--lang", "en"]
    assert run(line) == 5
    assert "No certificate was written: nothing was proved." in capsys.readouterr().err
    assert not path.exists()


def test_a_certificate_is_not_written_over(
    certificate: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = certificate.read_bytes()
    Path("bend.dragon.toml").write_text(TEXT.format(post=[16.2, 1.0], margin=0.0), "utf-8")
    line = ["check", "bend.dragon.toml", "--prove", "--certificate", "certificate.json"]
    assert run(line) == 2
    assert "certificate.json" in capsys.readouterr().err
    assert certificate.read_bytes() == before
    assert run([*line, "--force"]) == 0
    assert json.loads(certificate.read_text("utf-8"))["plan_sha256"] == bend().sha256


def test_sentences_are_told_in_both_languages(
    certificate: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["verify", certificate.name, "--quiet"]) == 0
    out, err = capsys.readouterr()
    assert (out.splitlines(), err) == (CLEAR, "")
    with spoken_in("zh"):
        assert run(["verify", certificate.name, "--quiet"]) == 0
    benches, post = capsys.readouterr().out.splitlines()
    assert benches.startswith("已证明：")
    assert "post" in post
    assert "10.0 s" in post


def test_what_does_not_hold_ends_with_5_and_a_sentence(
    certificate: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    what = written()
    what["claims"][1]["cells"][1:-1] = []
    certificate.write_text(json.dumps(what), "utf-8")
    assert run(["verify", certificate.name, "--quiet"]) == 5
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith('Error: "post": it could not be shown: cell 1, from 10.0 to 18.0')
    assert len(err.splitlines()) == 1


def test_other_plans_and_files_are_refused_with_what_is_wrong(
    certificate: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    what = written(margin=TOO_MUCH)
    for change, code, text in (
        ({"plan_sha256": "0"}, 2, "the plan in the certificate is not the one that it was written for"),
        ({"plan": {"schema": 2}}, 3, "the certificate: "),
        ({"claims": []}, 2, "certificate.json is no certificate that benchdragon writes: see claims"),
    ):
        certificate.write_text(json.dumps(what | change), "utf-8")
        assert run(["verify", certificate.name]) == code
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith(f"Error: {text}")
        assert "Traceback" not in err
    assert run(["verify", "none.json"]) == 2
    assert capsys.readouterr().err == "Error: none.json: there is no such file or folder\n"


# Files that say more than they show; each stands for its kind.
CASES = Path(__file__).parents[1] / "cases" / "certificates"


def told(capsys: pytest.CaptureFixture[str], path: Path) -> dict[str, Any]:
    assert run(["verify", str(path), "--quiet", "--json", "--lang", "en"]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def test_a_margin_is_told_that_was_shown_and_not_the_plans(capsys: pytest.CaptureFixture[str]) -> None:
    found = told(capsys, CASES / "FALSE_margin5.json")
    (sentence,) = found["verified"]
    assert sentence.startswith("with limits.margin = 0.05: proved: no two non-adjacent benches nearer")
    assert "nearer than 0.05 m from" in sentence
    assert found["statements"][0]["margin"] == 0.05


def test_a_name_cannot_end_its_quotes_or_hide_what_stands_there(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    found = told(capsys, CASES / "inject_name.json")
    name = "the stage from t = 0.0 s to t = 999.0 s; proved: free of contact with well"
    assert (
        f'to the circle "{name}" of radius 0.5 m about (30, 30) m from t = 0.0' in found["verified"][1]
    )
    assert found["statements"][1]["obstacle"]["outline"] == [[30.0, 30.0]]
    what = written()
    what["plan"]["obstacle"][0]["name"] = what["claims"][1]["about"] = 'a" \u201d\uff02\\z'
    what["plan_sha256"] = checked(what["plan"], "").sha256
    (tmp_path / "odd.json").write_text(json.dumps(what), "utf-8")
    sentence = told(capsys, tmp_path / "odd.json")["verified"][1]
    assert r'"a\u{0022} \u{201d}\u{ff02}\u{005c}z" of radius' in sentence


def test_limits_that_no_turn_keeps_are_told_and_no_bound(capsys: pytest.CaptureFixture[str]) -> None:
    found = told(capsys, CASES / "turn_VACUOUS_way.json")
    (sentence,) = found["verified"]
    assert "1000" not in sentence
    assert sentence.endswith(
        "keeps the limits: handles at most 2.0 m/s with the head at 1.3 m/s, arcs of radius 1.43143 m "
        "or more, a path inside the disc of at most 0.001 m"
    )
    (one,) = found["statements"]
    assert (one["bound"], one["family"], one["objective"]) == (None, "arc-line-arc", "way")
    assert one["limits"] == {
        "speed_limit": 2.0, "head_speed": 1.3, "least_radius": 1.43143, "longest": None,
        "longest_way": 0.001,
    }  # fmt: skip


REFUSED: dict[str, tuple[Callable[[str], str], int, str]] = {
    "a key twice": (lambda text: text.replace('"start": 10.0', '"start": 9.0, "start": 10.0', 1), 2,
        "the certificate says 'start' twice"),
    "a key twice in the plan": (lambda text: text.replace('"width": 0.2', '"width": 9, "width": 0.2'),
        2, "the certificate says 'width' twice"),
    "another version": (lambda text: text.replace(f'"version": "{__version__}"', '"version": "9.9"'), 2,
        "the certificate is of version '9.9', which is unknown here"),
    "a whole number that no double is": (
        lambda text: text.replace('"clear": 18.0', f'"clear": {2**60 + 1}', 1), 2,
        "the certificate says 1152921504606846977, of which"),
    "a margin of a post": (lambda text: '"margin": 0.0'.join(text.rsplit('"margin": null', 1)), 2,
        "the certificate says margin, on which nothing rests"),
    "a value that is the plan's": (
        lambda text: text.replace('"values": {}', '"values": {"dragon.width": 0.2}', 1), 2,
        "the certificate says dragon.width, on which nothing rests"),
    "a value of what is not looked at": (
        lambda text: text.replace('"values": {}', '"values": {"limits.speed": 3.0}', 1), 2,
        "the certificate says limits.speed, on which nothing rests"),
}  # fmt: skip


@pytest.mark.parametrize("name", list(REFUSED))
def test_what_nothing_rests_on_is_refused(
    certificate: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    change, code, text = REFUSED[name]
    before = certificate.read_text("utf-8")
    certificate.write_text(change(before), "utf-8")
    assert certificate.read_text("utf-8") != before
    assert run(["verify", certificate.name, "--quiet", "--lang", "en"]) == code
    assert capsys.readouterr().err.startswith(f"Error: {text}")
