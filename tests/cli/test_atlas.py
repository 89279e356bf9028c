"""The verb `atlas`: a page, or a sentence that says why there is none."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from benchdragon import read_plan, sweep
from benchdragon.cli.main import run


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("swept") / "a"
    plan = read_plan("spiral-in", ["dragon.benches=25"])
    with ThreadPoolExecutor(2) as threads:
        sweep(plan, {"route.pitch": [0.5, 0.55]}, output=folder, executor=threads)
    return folder


def test_a_page_is_written_and_not_over_another(
    folder: Path, tmp_path: Path, spoken: str, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "new" / "atlas.html"
    assert run(["atlas", str(folder), "-o", str(page), "--quiet"]) == 0
    assert str(page) in capsys.readouterr().out
    text = page.read_text("utf-8")
    assert {"en": "<title>Atlas</title>", "zh": "<title>图集</title>"}[spoken] in text
    assert f"-o {folder}" in text
    page.write_text("mine", "utf-8")
    assert run(["atlas", str(folder), "-o", str(page), "--quiet"]) == 2
    assert "--force" in capsys.readouterr().err
    assert page.read_text("utf-8") == "mine"
    assert run(["atlas", str(folder), "-o", str(page), "--quiet", "--force"]) == 0
    assert page.read_text("utf-8") == text


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nowhere", "-o", "x.html"], "nowhere holds no sweep"),
        (["FOLDER", "-o", "x.pdf"], "expected a name that ends in .html"),
        (["FOLDER", "FOLDER", "-o", "x.html"], "expected each folder once"),
        (["FOLDER", "FOLDER/", "-o", "x.html"], "expected each folder once"),
        (["FOLDER", "FOLDER/../a", "-o", "x.html"], "expected each folder once"),
        (["FOLDER"], "Missing option"),
        (["-o", "x.html"], "Missing argument"),
    ],
)
def test_what_cannot_be_is_told_in_a_sentence(
    folder: Path,
    words: list[str],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    named = [word.replace("FOLDER", str(folder)) for word in words]
    assert run(["atlas", *named, "--quiet"]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert "Traceback" not in error
    assert list(tmp_path.iterdir()) == []


def test_a_sweep_without_rows_has_no_page(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "sweep.json").write_bytes((folder / "sweep.json").read_bytes())
    assert run(["atlas", str(tmp_path), "-o", str(tmp_path / "x.html"), "--quiet"]) == 2
    assert f"{tmp_path} holds a sweep without any row" in capsys.readouterr().err
