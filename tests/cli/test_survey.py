"""`survey` tells what a drawing became, as text and as JSON, in both languages."""

import json
from pathlib import Path

import numpy as np
import pytest

from benchdragon.cli.main import run
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import read_plan
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
    assert lines[0].startswith("route: 94.00")
    assert "the drawing starts at s = 1.0000 m" in lines[2]
    assert "8 of 8 joints were adjusted: gaps of up to 0.00" in lines[4]
    assert lines[5].startswith("(0, 0) of the plan lies at (2")
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
    assert "方案的 (0, 0) 在文件里的经度 120.1551、纬度 28.9174 处（gcj02）" in out
    assert "路线与图形处处相差不超过 0.6 m（这是上界）" in out


def test_other_routes_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["survey", "turn"]) == 3
    assert 'turn: survey speaks of drawn routes, not of route.kind = "turn"' in capsys.readouterr().err


def test_places_are_those_of_the_route_that_is_danced(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bend = "[[route.piece]]\nstart = [0, 0]\nheading = 0\nlength = 10\nstart_curvature = 0.1\n"
    ring = "points = [[0, 0], [8, 0], [8, 6], [0, 6]]\nclosed = true\ndeviation = 1\n"
    for n, said in enumerate((bend + "end_curvature = 0.2\n", ring)):
        path = tmp_path / f"{n}.dragon.toml"
        head = 'schema = 1\n[dragon]\nbenches = 9\n[survey]\norigin = [5, 5]\n[route]\nkind = "drawn"\n'
        path.write_text(f"{head}at = [100, 0]\nturned = 90\n{said}", "utf-8")
        assert run(["survey", str(path), "--json"]) == 0
        told = json.loads(capsys.readouterr().out)
        plan = read_plan(str(path))
        walk = plan.build()
        assert (told["length"], told["parts"]) == (walk.route.length, len(walk.route))
        assert told["start"] == float(walk.head_position([0.0])[0]) > 0.0
        assert told["point"] == walk.route.point(told["s"]).tolist()
        bends = np.abs(walk.route.curvature(told["s"] + np.array([-1e-6, 0.0, 1e-6 * n])))
        assert 1.0 / bends.max() == pytest.approx(told["least_radius"], rel=1e-6)
        assert told["s"] >= told["start"]
        assert told["origin"] is None
        assert run(["survey", str(path)]) == 0
        out = capsys.readouterr().out
        assert f"the drawing starts at s = {told['start']:.4f} m" in out
        assert "of the plan lies at" not in out
