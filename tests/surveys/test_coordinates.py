"""Coordinates: projections against PROJ, GCJ-02 there and back, no digit lost on the map."""

import math
from pathlib import Path

import numpy as np
import pytest

from benchdragon.errors import InputError
from benchdragon.surveys.coordinates import (
    Survey,
    System,
    gcj02_of_wgs84,
    local_metres,
    taken_near,
    unshifted,
)
from benchdragon.surveys.reading import outline, read_line
from tests.surveys.drawings import ORIGIN, SQUARE, degrees, geojson_square


@pytest.mark.parametrize("origin", [(120.15, 28.92), (-70.0, -45.0), (9.0, 0.0), (25.0, 69.0)])
def test_the_local_map_is_that_of_proj(origin: tuple[float, float]) -> None:
    pyproj = pytest.importorskip("pyproj")
    rng = np.random.default_rng(0)
    for size, close in ((0.02, 1e-8), (1.0, 1e-7)):
        places = np.array(origin) + rng.uniform(-size, size, (400, 2))
        proj = pyproj.Proj(f"+proj=tmerc +lon_0={origin[0]} +lat_0={origin[1]} +ellps=WGS84")
        wanted = np.column_stack(proj(*places.T))
        assert np.abs(local_metres(places, origin, System(True)) - wanted).max() < close


def test_gcj02_is_undone_and_shifts_by_some_hundred_metres_in_china_alone() -> None:
    rng = np.random.default_rng(1)
    places = np.column_stack([rng.uniform(73.0, 135.0, 2000), rng.uniform(4.0, 53.0, 2000)])
    shown = gcj02_of_wgs84(places)
    assert np.abs(unshifted(shown, gcj02_of_wgs84) - places).max() < 1e-9
    metres = (
        (shown - places)
        * 111_000.0
        * np.column_stack([np.cos(np.radians(places[:, 1])), np.ones(2000)])
    )
    shift = np.hypot(metres[:, 0], metres[:, 1])
    assert 20.0 < shift.min() < 300.0 < np.median(shift) < 500.0 < shift.max() < 800.0
    # Tiananmen, by the published algorithm.
    assert np.allclose(
        gcj02_of_wgs84(np.array([[116.404, 39.915]])),
        [[116.41024449916938, 39.91640428150164]],
        atol=1e-12,
    )
    abroad = np.array([[2.35, 48.85]])
    assert np.array_equal(gcj02_of_wgs84(abroad), abroad)


def test_a_drawing_on_a_chinese_map_is_the_same_in_both_systems(tmp_path: Path) -> None:
    pytest.importorskip("pyproj")
    (tmp_path / "a.geojson").write_text(geojson_square(), "utf-8")
    shown = gcj02_of_wgs84(np.array(degrees([*SQUARE, SQUARE[0]])))
    rows = "lon,lat\n" + "".join(f"{x!r},{y!r}\n" for x, y in shown.tolist())
    (tmp_path / "b.csv").write_text(rows, "utf-8")
    ((east, north),) = gcj02_of_wgs84(np.array([ORIGIN])).tolist()
    one, _survey = outline(tmp_path / "a.geojson", Survey("wgs84", origin=ORIGIN))
    other, _survey = outline(tmp_path / "b.csv", Survey("gcj02", origin=(east, north)))
    assert np.allclose(one, SQUARE, atol=1e-6)
    assert np.allclose(other, SQUARE, atol=1e-5)


def test_map_coordinates_lose_no_digit() -> None:
    near = [(0.1234, 0.7), (12.3456, -7.8901), (30.0009, 20.1)]
    far = [
        (float(f"{2_712_000 + i}{f'{x % 1:.4f}'[1:]}"), y)
        for i, (x, y) in zip((0, 12, 30), near, strict=True)
    ]
    wanted = [(0.1234, 0.7), (12.3456, -7.8901), (30.0009, 20.1)]
    points, _survey = taken_near(far, Survey(origin=(2_712_000.0, 0.0)), "x", False, "m")
    # Subtracted as doubles they would differ by up to 2e-10.
    assert points.tolist() == [list(point) for point in wanted]
    assert any(x - 2_712_000.0 != w for (x, _y), (w, _v) in zip(far, wanted, strict=True))
    millimetres = [(float(f"{x:.4f}".replace(".", "")) / 10.0, y) for x, y in far]
    scaled, _survey = taken_near(millimetres, Survey(None, "mm", (2_712_000.0, 0.0)), "x", False, None)
    assert scaled[:, 0].tolist() == [x for x, _y in wanted]


def test_the_origin_is_chosen_where_it_is_needed() -> None:
    assert taken_near([(5.0, 6.0)], Survey(), "x", False, "m")[1].origin == (0.0, 0.0)
    points, survey = taken_near([(2e6 + 0.5, 3.25), (2e6 + 9.0, 4.0)], Survey(), "x", False, "m")
    assert survey.origin == (2e6, 3.0)
    assert points.tolist() == [[0.5, 0.25], [9.0, 1.0]]
    pytest.importorskip("pyproj")
    _points, survey = taken_near([(120.15001, 28.92004)], Survey("wgs84"), "x", True, None)
    assert survey.origin == (120.15, 28.92)


def test_a_code_says_its_unit_and_whether_it_is_of_degrees(tmp_path: Path) -> None:
    pytest.importorskip("pyproj")
    points, _survey = taken_near(
        [(500_000.0, 3_200_000.0)],
        Survey("EPSG:4549", origin=(499_990.0, 3_199_990.0)),
        "x",
        False,
        None,
    )
    assert points.tolist() == [[10.0, 10.0]]
    feet, _survey = taken_near(
        [(980_100.0, 200_200.0)], Survey("EPSG:2263", origin=(298_000.0, 61_000.0)), "x", False, None
    )
    assert np.allclose(
        feet, [[980_100 * 1200 / 3937 - 298e3, 200_200 * 1200 / 3937 - 61e3]], rtol=1e-12
    )
    square, _survey = taken_near(degrees(SQUARE), Survey("EPSG:4490", origin=ORIGIN), "x", True, None)  # type: ignore[arg-type]
    assert np.allclose(square, SQUARE, atol=1e-5)  # its ellipsoid is hardly another


@pytest.mark.parametrize(
    ("points", "survey", "angular", "sentence"),
    [
        ([(120.0, 28.0)], Survey(), True, "x holds longitudes and latitudes: set survey.crs to"),
        ([(1.0, 2.0)], Survey(), False, "x does not say its unit: set survey.unit to one of m, cm, mm"),
        ([(1.0, math.inf)], Survey(None, "m"), False, "every coordinate must be a finite number"),
        ([(28.0, 120.0)], Survey("wgs84"), True, "longitude first: is survey.crs right"),
        ([(120.0, 28.0), (122.0, 28.0)], Survey("wgs84"), True, "within 1 degree of survey.origin"),
        ([(120.0, 28.0)], Survey("EPSG:4549"), True, "x seems to hold degrees, but survey.crs"),
        ([(120.0, 28.0)], Survey("EPSG:1"), True, "there is no coordinate system EPSG:1"),
        ([(120.0, 28.0)], Survey("EPSG:4978"), True, "neither a map's system nor one of longitudes"),
        ([(1e12, 28.0)], Survey(None, "m", (0.0, 0.0)), False, "within 1e8 m of survey.origin"),
    ],
)  # fmt: skip
def test_what_is_missing_or_wrong_is_said(
    points: list[tuple[float, float]], survey: Survey, angular: bool, sentence: str
) -> None:
    with pytest.raises(InputError) as caught:
        taken_near(points, survey, "x", angular, None)
    assert sentence in str(caught.value)


@pytest.mark.parametrize("crs", ["", "EPSG:", "epsg:12x", "EPSG:99999999999", "+proj=merc", "世界"])
def test_a_system_is_one_of_three_kinds(crs: str, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("x,y\n0,0\n1,1\n", "utf-8")
    with pytest.raises(
        InputError, match=r"survey\.crs must be wgs84, gcj02, bd09 or a code like EPSG:4549"
    ):
        read_line(tmp_path / "a.csv", Survey(crs))


def test_a_survey_of_no_unit_and_no_origin_is_refused() -> None:
    with pytest.raises(InputError, match=r"survey\.unit must be one of m, cm"):
        Survey(unit="ell")
    with pytest.raises(InputError, match=r"survey\.origin must be two finite numbers"):
        Survey(origin=(math.nan, 0.0))
