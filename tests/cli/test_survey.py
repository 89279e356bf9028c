"""`survey` tells what a drawing became, as text and as JSON, in both languages."""

import json
from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.i18n import spoken_in
from tests.surveys.drawings import TRAM, landxml

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "11_drawn_walk.dragon.toml")


def surveyed(folder: Path, gap: float, kink: float) -> str:
    (folder / "tram.xml").write_text(landxml(TRAM, gap, kink, (2_700_000.0, 1_200_000.0)), "utf-8")
    plan = folder / "tram.dragon.toml"
    route = 'kind = "drawn"\nfile = "tram.xml"\nsmooth = "none"\n'
    plan.write_text(f"schema = 1\n[dragon]\nbenches = 9\n[route]\n{route}", "utf-8")
    return str(plan)


def test_the_change_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    plan = surveyed(tmp_path, 2e-3, 2e-4)
    assert run(["survey", plan]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("route: 93.00")
    assert "8 of 8 joints were adjusted: gaps of up to 0.00" in lines[3]
    assert lines[4].startswith("(0, 0) of the plan lies at (2")
    assert run(["survey", plan, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["joints"] == told["adjusted"] == 8
    assert 0.0 < told["gap"] < 5e-3
    assert 0.0 < told["kink"] < 1e-3
    assert 0.0 < told["shift"] <= told["deviation"] < 0.01
    assert told["least_radius"] == pytest.approx(40.0, abs=0.5)


def test_the_example_says_where_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    with spoken_in("zh"):
        assert run(["survey", EXAMPLE]) == 0
    out = capsys.readouterr().out
    assert "方案的 (0, 0) 对应文件中的 (120.1551, 28.9174)（gcj02）" in out
    assert "路线与图形处处相差不超过 0.6 m（这是上界）" in out


def test_other_routes_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["survey", "turn"]) == 3
    assert 'turn: survey speaks of drawn routes, not of route.kind = "turn"' in capsys.readouterr().err
