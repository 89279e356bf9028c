"""`verify` on the command line: what check --prove wrote is shown again, or refused in a sentence."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("flint")

from benchdragon.cli.main import run
from benchdragon.i18n import spoken_in
from tests.proofs.certificates import IN_THE_WAY, TEXT, TOO_MUCH, bend, written

CLEAR = [
    "proved: no two non-adjacent benches nearer than 0 m from t = 10.0 s to t = 18.0 s",
    "proved: free of contact with post from t = 10.0 s to t = 18.0 s",
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
    assert run(["check", str(plan), "--prove", "-o", str(folder), "--format", "svg"]) == 1
    assert sorted(path.name for path in folder.iterdir()) == [
        "certificate.json", "clearance.svg", "contact.svg"]  # fmt: skip
    done = subprocess.run(
        [sys.executable, "-m", "benchdragon", "verify", str(folder / "certificate.json"), "--json"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    told = json.loads(done.stdout)
    assert told["verified"][0] == CLEAR[0]
    assert told["verified"][1].startswith(
        "proved: free of contact with post from t = 10.0 s to t = 15.6598"
    )
    assert told["plan_sha256"] == bend(IN_THE_WAY).sha256
    kept = json.loads((folder / "certificate.json").read_text("utf-8"))
    assert told["cells"] == sum(len(claim["cells"]) - 1 for claim in kept["claims"]) > 20


def test_speeds_are_in_the_certificate_of_all_and_what_is_not_proved_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    plan, folder = tmp_path / "bend.dragon.toml", tmp_path / "out"
    plan.write_text(TEXT.format(post=list(IN_THE_WAY), margin=0.0), "utf-8")
    line = ["check", str(plan), "--prove-all", "-o", str(folder), "--format", "svg", "--quiet"]
    assert run([*line, "--lang", "en"]) == 1
    told = capsys.readouterr()
    assert told.err == ""
    assert "(proved)" in told.out.split("greatest speed of a handle")[1]
    kept = json.loads((folder / "certificate.json").read_text("utf-8"))
    assert len(kept["speeds"]) == 1
    assert run(["verify", str(folder / "certificate.json"), "--quiet", "--lang", "en"]) == 0
    assert "no handle is ever more than" in capsys.readouterr().out
    again = [*line, "--force", "--set", "cues.acceleration=0.3", "--lang", "en"]
    assert run(again) == 1
    told = capsys.readouterr()
    assert told.err == (
        "not proved: greatest speed: it is proved only where the head keeps one speed\n"
    )
    assert "(proved)" not in told.out.split("greatest speed of a handle")[1]


def test_without_proof_no_certificate_is_written(tmp_path: Path) -> None:
    plan = tmp_path / "bend.dragon.toml"
    plan.write_text(TEXT.format(post=list(IN_THE_WAY), margin=0.0), "utf-8")
    assert run(["check", str(plan), "-o", str(tmp_path / "out"), "--format", "svg"]) == 1
    assert not (tmp_path / "out" / "certificate.json").exists()


def test_a_certificate_is_not_written_over(
    certificate: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = certificate.read_bytes()
    Path("bend.dragon.toml").write_text(TEXT.format(post=[16.2, 1.0], margin=0.0), "utf-8")
    line = ["check", "bend.dragon.toml", "--prove", "-o", ".", "--format", "svg"]
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
    assert err.startswith("Error: post: it could not be shown: cell 1, from 10.0 to 18.0")
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
