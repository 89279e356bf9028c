"""Drawings in plans: files become points or pieces, beside the plan alone, and name the same dance."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from shapely import Polygon

from benchdragon.analysis.check import check
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.toml import PlanError

POINTS = [[0.0, 0.0], [20.0, 0.0], [30.0, 8.0], [40.0, 20.0], [40.0, 40.0]]
HEAD = 'schema = 1\n[dragon]\nbenches = 6\n[route]\nkind = "drawn"\ndeviation = "1 m"\n'
SQUARE = [[0, 0], [30, 0], [30, 20], [0, 20]]


def written(folder: Path, text: str) -> str:
    path = folder / "plan.dragon.toml"
    path.write_text(text, "utf-8")
    return str(path)


def csv(points: Any) -> str:
    return "x,y\n" + "".join(f"{x},{y}\n" for x, y in points)


def drawn(**route: Any) -> Plan:
    data = {"kind": "drawn", "deviation": 1.0, **route}
    return checked({"schema": 1, "dragon": {"benches": 6}, "route": data}, "plan")


def test_a_file_and_its_points_are_the_same_plan(tmp_path: Path) -> None:
    (tmp_path / "walk.csv").write_text(csv(POINTS), "utf-8")
    plan = read_plan(written(tmp_path, HEAD + 'file = "walk.csv"\n'))
    typed = drawn(points=POINTS)
    assert plan.sha256 == typed.sha256
    assert np.array_equal(plan.build().route.rows, typed.build().route.rows)
    # Sent alone it still works, and says where on the map it is.
    alone = tmp_path / "alone"
    alone.mkdir()
    again = read_plan(written(alone, plan.toml()))
    assert (again.sha256, again.survey) == (plan.sha256, plan.survey)
    assert plan.survey.origin == (0.0, 0.0)


def test_the_tail_has_a_place_behind_the_start_of_a_drawing() -> None:
    for smooth in ("none", "G1", "G2"):
        plan = drawn(points=POINTS, smooth=smooth, deviation=5.0)
        walk = plan.build()
        start, end = plan.span(walk)
        head = walk.route.point(walk.head_position([start, end]))
        assert np.allclose(head, [POINTS[0], POINTS[-1]], atol=1e-9), smooth
        assert check(plan).safe


def test_a_closed_drawing_is_walked_once_round_with_the_dragon_on_it() -> None:
    plan = drawn(points=[[0, 0], [8, 0], [8, 6], [0, 6]], closed=True, deviation=2.0)
    walk = plan.build()
    start, end = plan.span(walk)
    lap = plan.route.fit(float(plan.dragon.build().links.max())).route.length  # type: ignore[union-attr]
    assert math.isclose(end - start, lap, rel_tol=1e-12)
    assert float(walk.head_position([start])[0]) >= plan.dragon.build().links.sum()
    first, last = walk.route.point(walk.head_position([start, end]))
    assert np.allclose(first, last, atol=1e-9)


def test_a_square_from_dxf_and_from_geojson_gives_the_same_verdict(tmp_path: Path) -> None:
    pytest.importorskip("ezdxf")
    from tests.surveys.drawings import bare_dxf, geojson_square

    (tmp_path / "square.dxf").write_text(bare_dxf(1000.0), "utf-8")
    (tmp_path / "square.geojson").write_text(geojson_square(), "utf-8")
    verdicts = []
    for name, survey in (
        ("square.dxf", 'unit = "mm"'),
        ("square.geojson", 'crs = "wgs84"\norigin = [120.15, 28.92]'),
    ):
        text = (
            f'schema = 1\nbase = "spiral-in"\n[dragon]\nbenches = 20\n[route]\nat = [6, 10]\n'
            f'[venue]\nfile = "{name}"\n[survey]\n{survey}\n[walk]\nend = 60\n'
        )
        plan = read_plan(written(tmp_path, text))
        found = check(plan)
        verdicts.append((found.safe, [(one.code, one.time) for one in found.findings]))
        (edge,) = plan.obstacles()
        assert Polygon(edge.outline).symmetric_difference(Polygon(SQUARE)).area < 1e-6
    (one, these), (other, those) = verdicts
    assert one == other
    assert [code for code, _time in these] == [code for code, _time in those] != []
    for (_code, first), (_same, second) in zip(these, those, strict=True):
        assert abs((first or 0.0) - (second or 0.0)) < 1e-5


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        ('file = "../walk.csv"', "route.file: expected the name of a file beside the plan, not"),
        ('file = "/etc/hosts.csv"', "expected the name of a file beside the plan"),
        ('file = "a\\\\b.csv"', "expected the name of a file beside the plan"),
        ('file = "none.csv"', "there is no file none.csv beside the plan"),
        ('file = "walk.txt"', "drawings are read from .csv, .geojson, .json, .kml, "),
        ('file = "walk.csv"\npoints = [[0, 0], [1, 1]]', "route.file has no effect beside route.po"),
        ('points = [[0, 0], [1, 1]]\nlayer = "a"', "route.layer has no effect beside route.points"),
        ('points = [[0, 0], [9, 9]]\n[survey]\ncrs = 3', "survey.crs: expected text, not 3"),
        ('file = "walk.csv"\n[survey]\nunit = "ell"', "survey.unit must be one of m, cm, mm"),
        ('file = "walk.csv"\n[survey]\ncrs = "mars"', "survey.crs must be wgs84, gcj02, bd09 or a"),
        ('layer = "a"', "a drawn route needs points, or a file beside the plan"),
        ("points = [[0, 0]]", "a drawn line needs 2 different points at least, not 1"),
        ("points = [[0, 0], [9, 0], [0, 0]]", "at (9, 0) m the drawing doubles straight back"),
        ("points = [[0, 0], [9, 0], [9, 9]]\nleast_radius = 3", "bends with a radius of 2.414 m"),
    ],
)  # fmt: skip
def test_wrong_drawings_get_one_sentence(tmp_path: Path, lines: str, sentence: str) -> None:
    (tmp_path / "walk.csv").write_text(csv(POINTS), "utf-8")
    with pytest.raises(PlanError) as caught:
        read_plan(written(tmp_path, HEAD + lines + "\n")).build()
    assert sentence in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_a_plan_that_is_no_file_names_none() -> None:
    with pytest.raises(PlanError, match="nothing lies beside it"):
        drawn(file="walk.csv")


def test_one_origin_serves_all_files_of_a_plan(tmp_path: Path) -> None:
    far = [[2_700_000.125 + x, 3_400_000.5 + y] for x, y in SQUARE]
    (tmp_path / "edge.csv").write_text(csv([*far, far[0]]), "utf-8")
    (tmp_path / "walk.csv").write_text(csv([[x + 2, y + 2] for x, y in far[:3]]), "utf-8")
    text = HEAD + 'file = "walk.csv"\n[venue]\nfile = "edge.csv"\n'
    plan = read_plan(written(tmp_path, text))
    assert plan.survey.origin == (2_700_000.0, 3_400_000.0)
    assert np.array_equal(plan.obstacles()[0].outline, np.add(SQUARE, [0.125, 0.5]))
    assert plan.route.points == [(x + 2.125, y + 2.5) for x, y in SQUARE[:3]]  # type: ignore[union-attr]
    moved = json.loads(json.dumps(plan.data()))
    assert checked(moved, "moved").sha256 == plan.sha256


def test_a_bend_that_no_bench_can_follow_is_named() -> None:
    plan = drawn(points=[[0, 0], [9, 0], [9, 9]], deviation=0.2)
    # The head's link is 2.86 m long; an arc that leaves 0.2 m of a right angle has a radius of 0.48 m.
    with pytest.raises(
        PlanError, match=r"bends with a radius of 0\.4828 m, and 1\.43143 m is required"
    ):
        plan.build()


def test_what_is_lost_in_reading_counts(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new("R2010", units=6)
    document.modelspace().add_spline([(0, 0), (50, 30), (100, 0)])
    document.saveas(tmp_path / "a.dxf")
    plan = read_plan(written(tmp_path, HEAD + 'file = "a.dxf"\n'))
    lost = plan.route.drawn_within  # type: ignore[union-attr]
    assert 1e-4 < lost < 2e-2
    fit = plan.route.fit(2.0)  # type: ignore[union-attr]
    exact = checked({**plan.data(), "route": {**plan.data()["route"], "drawn_within": 0.0}}, "x")
    assert fit.deviation > lost
    assert exact.sha256 != plan.sha256


def test_what_is_lost_in_reading_is_added_to_what_the_plan_says(tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    (tmp_path / "a.svg").write_text('<svg><path d="M0 0 C 10 0 20 10 30 10 S 50 0 60 0"/></svg>')
    text = HEAD + 'file = "a.svg"\n{}[survey]\nunit = "m"\n'
    lost = read_plan(written(tmp_path, text.format(""))).route.drawn_within  # type: ignore[union-attr]
    assert lost > 0.0
    both = read_plan(written(tmp_path, text.format('drawn_within = "5 cm"\n'))).route.drawn_within  # type: ignore[union-attr]
    assert both == pytest.approx(0.05 + lost, abs=1e-15)
    with pytest.raises(PlanError, match=r"route\.drawn_within"):
        read_plan(written(tmp_path, text.format("drawn_within = -1\n")))


def test_one_way_to_say_a_drawing_replaces_another_of_the_base(tmp_path: Path) -> None:
    ways = {
        "points": "points = [[0, 0], [30, 0]]",
        "file": 'file = "walk.csv"\nlayer = "a"',
        "piece": "piece = [{start = [0, 0], heading = 0, length = 20}]",
    }
    rows = "x,y,layer\n" + "".join(f"{x},{y},a\n" for x, y in POINTS)
    (tmp_path / "walk.csv").write_text(rows, "utf-8")
    for below, first in ways.items():
        (tmp_path / "base.dragon.toml").write_text(HEAD + first + "\n", "utf-8")
        for own, second in ways.items():
            text = f'schema = 1\nbase = "base.dragon.toml"\n[route]\n{second}\n'
            plan = read_plan(written(tmp_path, text))
            assert plan.sha256 == read_plan(written(tmp_path, f"{HEAD}{second}\n")).sha256, (below, own)
