"""Files of every format: what they hold is read as it was meant, what is wrong gets one sentence."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchdragon.errors import InputError
from benchdragon.model.curves import Arc
from benchdragon.surveys import dxf_format, lines, reading, svg_format
from benchdragon.surveys.coordinates import Survey
from benchdragon.surveys.flattening import bezier_points, ellipse_points
from benchdragon.surveys.lines import DrawnLine, chained, corners_of
from benchdragon.surveys.reading import outline, read_line, read_lines
from tests.surveys.drawings import (
    ORIGIN,
    RAILWAY,
    SQUARE,
    bare_dxf,
    degrees,
    dxf_text,
    geojson_square,
    landxml,
)

METRES = Survey(unit="m", origin=(0.0, 0.0))
KML = (
    '<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark>'
    "<name>walk</name><LineString><coordinates>{}</coordinates></LineString></Placemark></Document></kml>"
)


def written(folder: Path, name: str, text: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_csv_has_columns_by_name_and_lines_by_layer(tmp_path: Path) -> None:
    text = "\ufefflayer,y,x\r\na,1,2\r\na,3,4.5\r\n\r\nb,0,0\r\nb,1,0\r\nb,1,1\r\nb,0,0\r\n"
    path = written(tmp_path, "a.csv", text)
    line, _survey = read_line(path, Survey(), "a")
    assert line.corners[:, :2].tolist() == [[2.0, 1.0], [4.5, 3.0]]
    assert not line.closed
    ring, _survey = read_line(path, Survey(), "b")
    assert (len(ring.corners), ring.closed) == (3, True)
    with pytest.raises(
        InputError, match=r"a\.csv holds 2 lines: choose one by the key layer: 'a', 'b'"
    ):
        read_line(path, Survey())
    with pytest.raises(InputError, match=r"no line called 'c'; it has 'a', 'b'"):
        read_line(path, Survey(), "c")


def test_geojson_and_kml_hold_the_same_line(tmp_path: Path) -> None:
    pytest.importorskip("pyproj")
    walk = degrees([[0, 0], [12, 3], [20, -4]])
    feature = {
        "type": "Feature",
        "properties": {"name": "walk"},
        "geometry": {"type": "LineString", "coordinates": walk},
    }
    other = {
        "type": "Feature",
        "properties": None,
        "geometry": {"type": "Point", "coordinates": [0, 0]},
    }
    whole = {
        "type": "FeatureCollection",
        "features": [feature, other, {"type": "Feature", "properties": {}, "geometry": None}],
    }
    one = written(tmp_path, "a.geojson", json.dumps(whole))
    text = " ".join(f"{x!r},{y!r},0" for x, y in walk)
    other_file = written(tmp_path, "b.kml", KML.format(text))
    survey = Survey("wgs84", origin=ORIGIN)
    for path in (one, other_file, written(tmp_path, "c.xml", KML.format(text))):
        line, _survey = read_line(path, survey, "walk")
        assert np.allclose(line.corners[:, :2], [[0, 0], [12, 3], [20, -4]], atol=1e-7)
    square, _survey = outline(written(tmp_path, "d.geojson", geojson_square()), survey)
    assert np.allclose(square, SQUARE, atol=1e-7)


def test_every_way_to_draw_a_square_in_dxf_gives_it(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    paths = [written(tmp_path, "bare.dxf", bare_dxf(1.0))]
    for version in ("R12", "R2000", "R2018"):
        document = ezdxf.new(version, units=4 if version != "R12" else 0)
        space = document.modelspace()
        corners = [(1000.0 * x, 1000.0 * y) for x, y in SQUARE]
        if version == "R12":
            space.add_polyline2d(corners, close=True)
        else:
            space.add_lwpolyline(corners, close=True)
        paths.append(tmp_path / f"{version}.dxf")
        document.saveas(paths[-1])
    for path in paths:
        units = {"bare.dxf": "m", "R12.dxf": "mm"}.get(path.name)
        corners_found, _survey = outline(path, Survey(unit=units))
        area = 0.5 * abs(np.sum(corners_found * np.roll(corners_found, -1, 0)[:, ::-1] * [1, -1]))
        assert len(corners_found) == 4
        assert area == 600.0
        assert {tuple(corner) for corner in corners_found.tolist()} == set(SQUARE)
    with pytest.raises(
        InputError, match=r"bare\.dxf does not say its unit: set survey\.unit to one of"
    ):
        outline(paths[0], Survey())


def test_dxf_arcs_keep_their_bend_and_side(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new("R2010", units=6)
    space = document.modelspace()
    space.add_line((-10, 0), (0, 0), dxfattribs={"layer": "way"})
    space.add_arc((0, 5), 5, 270, 0, dxfattribs={"layer": "way"})
    space.add_line((5, 15), (5, 5), dxfattribs={"layer": "way"})
    space.add_arc((0, 0), 2, 0, 90, dxfattribs={"layer": "below", "extrusion": (0, 0, -1)})
    space.add_circle((3, 4), 2, dxfattribs={"layer": "well"})
    space.add_ellipse((0, 0), (4, 0), 0.5, dxfattribs={"layer": "pond"})
    space.add_spline([(0, 0), (5, 3), (10, 0)], dxfattribs={"layer": "path"})
    space.add_text("way", dxfattribs={"layer": "words"})
    path = tmp_path / "a.dxf"
    document.saveas(path)
    way, _survey = read_line(path, Survey(), "way")
    length = sum(piece.length for piece in way.pieces())
    assert math.isclose(length, 20.0 + 2.5 * math.pi, rel_tol=1e-12)
    assert np.abs([piece.curvature(0.0) for piece in way.pieces()]).max() == pytest.approx(0.2)
    below, _survey = read_line(path, Survey(), "below")
    (arc,) = below.pieces()
    # Seen from below, x runs to the left: the arc goes clockwise from (-2, 0) to (0, 2).
    assert np.allclose(
        arc.point([0.0, 0.5 * arc.length, arc.length]),
        [[-2.0, 0.0], [-math.sqrt(2.0), math.sqrt(2.0)], [0.0, 2.0]],
    )
    well, _survey = read_line(path, Survey(), "well")
    points, off = well.points(1e-3)
    assert np.abs(np.hypot(*(points - [3.0, 4.0]).T) - 2.0).max() < 1e-12
    assert off <= 1e-3
    pond, _survey = outline(path, Survey(), "pond")
    assert np.abs((pond[:, 0] / 4.0) ** 2 + (pond[:, 1] / 2.0) ** 2 - 1.0).max() < 1e-12
    curve, _survey = read_line(path, Survey(), "path")
    assert 0.0 < curve.off < 1e-2
    assert np.allclose(curve.corners[[0, -1], :2], [[0, 0], [10, 0]])


def test_svg_is_turned_up_and_its_unit_is_said_or_asked(tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    paths = '<g transform="translate(10,0)"><path id="walk" d="M0 0 L30 10 A 20 20 0 0 1 50 30"/></g>'
    svg = '<svg xmlns="http://www.w3.org/2000/svg" {}>{}<use href="#walk"/></svg>'
    millimetres = written(tmp_path, "a.svg", svg.format('width="200mm" viewBox="0 0 200 100"', paths))
    line, _survey = read_line(millimetres, Survey())
    assert np.allclose(line.corners[[0, 1, -1], :2], [[0.01, 0.0], [0.04, -0.01], [0.06, -0.03]])
    line, _survey = read_line(millimetres, Survey(unit="m"))
    assert np.allclose(line.corners[-1, :2], [60.0, -30.0])
    bare = written(tmp_path, "b.svg", svg.format("", paths))
    with pytest.raises(InputError, match=r"b\.svg does not say its unit"):
        read_line(bare, Survey())
    assert np.allclose(read_line(bare, METRES)[0].corners[-1, :2], [60.0, -30.0])
    rect = written(tmp_path, "c.svg", svg.format("", '<rect id="yard" width="30" height="20"/>'))
    corners, _survey = outline(rect, METRES)
    assert {tuple(corner) for corner in np.abs(corners).tolist()} == set(SQUARE)


def test_landxml_names_points_and_says_its_unit(tmp_path: Path) -> None:
    text = landxml(RAILWAY, 0.0, 0.0, (0.0, 0.0)).replace('linearUnit="meter"', 'linearUnit="foot"')
    text = text.replace("<Start>0.000000000 0.000000000</Start>", '<Start pntRef="P1"/>', 1)
    text = text.replace(
        "<Alignments>", '<CgPoints><CgPoint name="P1">0 0</CgPoint></CgPoints><Alignments>'
    )
    line, _survey = read_line(written(tmp_path, "a.xml", text), Survey())
    assert sum(curve.length for curve in line.curves) == pytest.approx(
        0.3048 * RAILWAY.length, rel=1e-9
    )


def test_flattened_curves_keep_within_what_is_said() -> None:
    control = np.array([[0.0, 0.0], [3.0, 9.0], [8.0, -7.0], [10.0, 1.0]])
    points, off = bezier_points(control, 1e-3)
    t = np.linspace(0.0, 1.0, 20001)[:, None]
    true = sum(math.comb(3, k) * t**k * (1 - t) ** (3 - k) * control[k] for k in range(4))
    assert 0.2 * off < _farthest(np.asarray(true), points) <= off
    points, off = ellipse_points(
        np.zeros(2), np.array([4.0, 1.0]), np.array([-0.5, 2.0]), 0.3, 5.0, 1e-3
    )
    t = np.linspace(0.3, 5.3, 20001)[:, None]
    true = np.cos(t) * [4.0, 1.0] + np.sin(t) * [-0.5, 2.0]
    assert 0.2 * off < _farthest(true, points) <= off


def _farthest(true: np.ndarray[tuple[int, int], np.dtype[np.float64]], points: Any) -> float:
    import shapely

    return float(shapely.distance(shapely.points(true), shapely.LineString(points)).max())


def test_pieces_are_joined_where_their_ends_meet_and_nowhere_else() -> None:
    def line(*points: tuple[float, float]) -> DrawnLine:
        return DrawnLine("", corners_of(points))

    a, b, c = line((0, 0), (9, 0)), line((9, 9), (9, 0.001)), line((9, 9), (0, 9))
    (one,) = chained([a, b, c], 0.01)
    assert one.corners[:, :2].tolist() in (
        [[0, 0], [9, 0], [9, 9], [0, 9]],
        [[0, 9], [9, 9], [9, 0.001], [0, 0]],
    )
    assert one.off == pytest.approx(0.001)
    assert len(chained([a, b, c], 1e-4)) == 2
    # Where three meet, nobody knows which goes on.
    assert len(chained([a, b, c, line((9, 0), (20, 0))], 0.01)) == 3
    (ring,) = chained([a, b, c, line((0, 9), (0, 0))], 0.01)
    assert ring.closed
    assert len(ring.corners) == 4


BOMB = '<!DOCTYPE a [<!ENTITY b "bbbb"><!ENTITY c "&b;&b;&b;">]><kml>&c;</kml>'
NESTED = '{"type": "GeometryCollection", "geometries": ['
ALIGNMENT = "<LandXML><Alignment><CoordGeom>%s</CoordGeom></Alignment></LandXML>"
EMPTY_DXF = dxf_text((0, "SECTION"), (2, "ENTITIES"), (0, "ENDSEC"), (0, "EOF"))
GEOJSON = '{"type": "LineString", "coordinates": %s}'
BAD: dict[str, tuple[str, str | bytes, str]] = {
    "empty csv": ("a.csv", "", "the first row must name the columns x and y"),
    "no columns": ("a.csv", "1,2\n3,4\n", "the first row must name the columns x and y"),
    "mixed columns": ("a.csv", "x,lat\n3,4\n", "the first row must name the columns x and y"),
    "words": ("a.csv", "x,y\n1,2\na,b\n", "a.csv, line 3: expected two numbers, not 'a, b'"),
    "short row": ("a.csv", "x,y\n1\n", "a.csv, line 2: expected two numbers, not '1'"),
    "infinite": ("a.csv", "x,y\n1,2\ninf,0\n", "every coordinate must be a finite number"),
    "one point": ("a.csv", "x,y\n1,2\n1,2\n", "a.csv holds no line"),
    "no rows": ("a.csv", "x,y\n", "a.csv holds no line"),
    "latin": ("a.csv", b"x,y\n\xff\xfe,2\n", "a.csv is no text in UTF-8, UTF-16 or GB18030"),
    "no json": ("a.geojson", "[1, 2", "a.geojson is not JSON"),
    "deep json": ("a.geojson", "[" * 100_000, "a.geojson is not JSON"),
    "other json": ("a.json", '{"type": 3}', "a.json holds no line"),
    "list": ("a.json", "[]", "a.json is not GeoJSON as RFC 7946 has it"),
    "text in points": ("a.json", GEOJSON % '[["1", 2], [3, 4]]', "is not GeoJSON as RFC 7946 has it"),
    "huge number": ("a.json", GEOJSON % f"[[1{'0' * 400}, 2], [3, 4]]", "is not GeoJSON"),
    "nested": ("a.json", NESTED * 30 + "]}" * 30, "is not GeoJSON"),
    "no xml": ("a.kml", "<kml><", "a.kml is not XML: line 1, column 6"),
    "entities": ("a.kml", BOMB, "a.kml uses entities, which are not read: save it without them"),
    "deep xml": ("a.kml", "<kml>" * 300, "a.kml is nested too deeply"),
    "other xml": ("a.kml", "<gpx/>", "a.kml is not KML"),
    "no coordinates": ("a.kml", KML.format("1,x 2,3"), "expected numbers, not '1 x'"),
    "encoding": ("a.kml", b'<?xml version="1.0" encoding="klingon"?><kml/>', "a.kml is not XML"),
    "no landxml": ("a.xml", "<a/>", "a.xml is not LandXML"),
    "other curve": ("a.xml", ALIGNMENT % "<IrregularLine/>",
                    "may hold lines, arcs and clothoids, not IrregularLine"),
    "no end": ("a.xml", ALIGNMENT % "<Line><Start>1 2</Start></Line>",
               "each Line of an alignment needs Start, End"),
    "no dxf": ("a.dxf", "hello", "a.dxf is not DXF"),
    "nothing": ("a.dxf", "", "a.dxf is not DXF"),
    "no entities": ("a.dxf", EMPTY_DXF, "a.dxf holds no line"),
    "no svg": ("a.svg", "<kml/>", "a.svg is not SVG"),
    "no path": ("a.svg", "<svg/>", "a.svg holds no line"),
    "ending": ("a.shp", "x", "a.shp: drawings are read from .csv, .geojson"),
    "folder": (".csv", "", "drawings are read from"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_bad_files_get_one_sentence(case: str, tmp_path: Path) -> None:
    name, text, sentence = BAD[case]
    with pytest.raises(InputError) as caught:
        read_line(
            written(tmp_path, name, text),
            Survey("wgs84") if "json" in name or "kml" in name else METRES,
        )
    assert sentence in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_an_open_boundary_is_refused_and_one_that_all_but_meets_is_not(tmp_path: Path) -> None:
    rows = "x,y\n0,0\n9,0\n9,9\n"
    with pytest.raises(InputError, match=r"a\.csv: the boundary is open: its ends are 12\.7 m apart"):
        outline(written(tmp_path, "a.csv", rows), Survey())
    corners, _survey = outline(written(tmp_path, "b.csv", rows + "0,0.002\n"), Survey())
    assert len(corners) == 3


def test_what_strangers_send_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = written(tmp_path, "a.csv", "x,y\n" + "".join(f"{n},0\n" for n in range(30)))
    monkeypatch.setattr(reading, "MOST_CORNERS", 29)
    with pytest.raises(InputError, match="holds 30 points, and 29 are read at most"):
        read_lines(path, Survey())
    monkeypatch.setattr(reading, "MOST_BYTES", 50)
    with pytest.raises(InputError, match="is too large: 0 MB, at most 0 MB are read"):
        read_lines(path, Survey())
    monkeypatch.setattr(lines, "MOST_CORNERS", 3)
    with pytest.raises(InputError, match="a line may have 3 points at most, not 4"):
        corners_of(np.zeros((4, 2)))


def test_pieces_turned_round_bend_to_the_other_side() -> None:
    first = DrawnLine("", corners_of([(0.0, 0.0), (9.0, 0.0)]))
    # From (9, 9) back to (9, 0), to the right of which lies its middle.
    second = DrawnLine("", corners_of([(9.0, 9.0, 0.5), (9.0, 0.0, 0.0)]))
    (one,) = chained([first, second], 1e-3)
    line, arc = one.pieces()
    middle = (arc if isinstance(arc, Arc) else line).point(0.5 * second.pieces()[0].length)
    assert np.allclose(middle, second.pieces()[0].point(0.5 * second.pieces()[0].length))


def test_curves_that_become_too_many_points_are_refused_before_all_are_made(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    pytest.importorskip("svgelements")
    made: list[int] = []
    count = bezier_points

    def counted(control: Any, within: float) -> Any:
        made.append(1)
        return count(control, within)

    wiggles = 3000
    svg = f'<svg><path d="M0 0 {"c900 900 -900 900 100 0 " * wiggles}"/></svg>'
    document = ezdxf.new("R2010", units=6)
    for n in range(wiggles):
        document.modelspace().add_spline([(0, n), (300, 200 + n), (600, n), (900, n)])
    document.saveas(tmp_path / "a.dxf")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(svg_format, "bezier_points", counted)
        patch.setattr(dxf_format, "bezier_points", counted)
        for path in (written(tmp_path, "a.svg", svg), tmp_path / "a.dxf"):
            made.clear()
            sentence = f"{path.name}: its curves need more than the 100000 points that are read at most"
            with pytest.raises(InputError, match=sentence):
                read_lines(path, METRES)
            assert 10 < len(made) < wiggles // 2


@pytest.mark.parametrize("unit", ["m", "ft", "mm"])
def test_a_boundary_keeps_within_a_millimetre_of_what_was_drawn(tmp_path: Path, unit: str) -> None:
    pytest.importorskip("svgelements")
    scale = {"m": 1.0, "ft": 0.3048, "mm": 1e-3}[unit]
    a, b = 100.0 / scale, 80.0 / scale
    path = written(tmp_path, "a.svg", f'<svg><ellipse rx="{a}" ry="{b}"/></svg>')
    corners, _survey = outline(path, Survey(unit=unit, origin=(0.0, 0.0)))
    t = np.linspace(0.0, 2.0 * math.pi, 20001)
    true = np.column_stack([100.0 * np.cos(t), 80.0 * np.sin(t)])
    assert 1e-4 < _farthest(true, np.vstack([corners, corners[:1]])) <= lines.FLATTENED
    # The same in degrees: a hundred metres are a thousandth of one.
    path = written(tmp_path, "b.svg", f'<svg><ellipse rx="{100 / 111e3}" ry="{80 / 111e3}"/></svg>')
    small, _survey = outline(path, Survey("wgs84", origin=(0.0, 0.0)))
    assert 0.5 * len(corners) < len(small) < 2 * len(corners)


def test_a_boundary_of_too_many_corners_gets_one_sentence(tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    path = written(tmp_path, "a.svg", '<svg><circle r="60000"/></svg>')
    with pytest.raises(InputError, match=r"a\.svg: the boundary becomes \d+ corners, and 5000 are"):
        outline(path, METRES)


@pytest.mark.parametrize("radius", ["1e-323", "1e-4"])
def test_a_radius_of_nothing_is_refused(tmp_path: Path, radius: str) -> None:
    text = landxml(RAILWAY, 0.0, 0.0, (0.0, 0.0)).replace(
        'radiusEnd="500.000000000"', f'radiusEnd="{radius}"'
    )
    text = text.replace('linearUnit="meter"', 'linearUnit="millimeter"')
    with pytest.raises(
        InputError, match=r"a\.xml: a clothoid has a radius of .* m: 1e-06 m are the least"
    ):
        read_line(written(tmp_path, "a.xml", text), Survey())


def test_lines_of_different_layers_are_not_joined(tmp_path: Path) -> None:
    rows = "x,y,layer\n0,0,a\n20,0,a\n20.004,0,{}\n40,3,{}\n"
    path = written(tmp_path, "a.csv", rows.format("b", "b"))
    with pytest.raises(InputError, match=r"holds 2 lines: choose one by the key layer: 'a', 'b'"):
        read_line(path, Survey())
    ways = {
        "type": "MultiLineString",
        "coordinates": [[[5e5, 32e5], [500200, 32e5]], [[500400, 3200003], [500200, 32e5]]],
    }
    path = written(tmp_path, "a.json", json.dumps(ways))
    line, _survey = read_line(path, Survey("EPSG:4549"))
    assert len(line.corners) == 3
