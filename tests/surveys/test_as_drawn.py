"""A drawing is taken as it is drawn, or refused: kinds of files that could be read wrongly."""

import io
import math
import zipfile
from pathlib import Path

import numpy as np
import pytest

from benchdragon.errors import InputError
from benchdragon.kernels.curve import FloatArray
from benchdragon.surveys import xml_formats
from benchdragon.surveys.coordinates import Survey, bd09_of_wgs84, system_of, unshifted
from benchdragon.surveys.reading import outline, read_line
from tests.surveys.drawings import dxf_text

METRES = Survey(unit="m", origin=(0.0, 0.0))
SVG = '<svg xmlns="http://www.w3.org/2000/svg" {}>{}</svg>'


def written(folder: Path, name: str, text: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def corners(path: Path, survey: Survey = METRES, layer: str | None = None) -> list[list[float]]:
    line, _survey = read_line(path, survey, layer)
    points: list[list[float]] = line.points()[0].tolist()
    return points


@pytest.mark.parametrize(
    ("drawing", "wanted"),
    [
        ('<path d="m1 2 3 0 0 4"/>', [[1, 2], [4, 2], [4, 6]]),
        ('<path d="M1 2 3 0h4V5l1-1"/>', [[1, 2], [3, 0], [7, 0], [7, 5], [8, 4]]),
        ('<path d="M0 0A0 5 0 0 0 6 0L6 4"/>', [[0, 0], [6, 0], [6, 4]]),
        ('<path d="M0 0L6 0A3 3 0 0 1 6 0L6 4"/>', [[0, 0], [6, 0], [6, 4]]),
        ('<polyline points="0,0 1,1,2-1"/>', [[0, 0], [1, 1], [2, -1]]),
        ('<g transform="translate(10)scale(2, 3)"><path d="M1 1 2 1"/></g>', [[12, 3], [14, 3]]),
        ('<path transform="matrix(0 1 -1 0 5 7)" d="M1 0 2 3"/>', [[5, 8], [2, 9]]),
        ('<path transform="rotate(90 1 1)" d="M1 0 2 3"/>', [[2, 1], [-1, 2]]),
        ('<a><path d="M1 0 2 3"/></a>', [[1, 0], [2, 3]]),
        ('<path d="M5 5z"/><path d="M1 0 2 3"/>', [[1, 0], [2, 3]]),
        ('<svg x="10" y="20" width="50" height="20" viewBox="0 0 9 9"><path d="M0 0 9 9"/></svg>',
         [[25, 20], [45, 40]]),
        ('<svg x="10%" y="20" width="50" height="20" viewBox="0 0 100 100" preserveAspectRatio="none">'
         '<path d="M0 0 100 100"/></svg>', [[20, 20], [70, 40]]),
        ('<line x1="10%" y1="10%" x2="20%" y2="50%"/>', [[20, 10], [40, 50]]),
        ('<g style="display:none"><path d="M0 0 9 9"/></g><path d="M1 0 2 3"/>', [[1, 0], [2, 3]]),
        ('<path d="M0 0 9 9" visibility="hidden"/><path d="M1 0 2 3"/>', [[1, 0], [2, 3]]),
        ('<switch><g requiredExtensions="x"/><path d="M1 0 2 3"/><path d="M0 0 9 9"/></switch>',
         [[1, 0], [2, 3]]),
    ],
)  # fmt: skip
def test_svg_is_read_as_browsers_draw_it(
    drawing: str, wanted: list[list[float]], tmp_path: Path
) -> None:
    pytest.importorskip("svgelements")
    found = corners(written(tmp_path, "a.svg", SVG.format('viewBox="0 0 200 100"', drawing)))
    assert np.allclose(found, np.array(wanted) * [1, -1], atol=1e-9)


def test_an_ellipse_under_any_transform_is_that_ellipse(tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    rng = np.random.default_rng(3)
    for _n in range(20):
        a, b, c, d, e, f = rng.uniform(-2.0, 2.0, 6).tolist()
        shape = f'<ellipse cx="3" cy="4" rx="20" ry="9" transform="matrix({a} {b} {c} {d} {e} {f})"/>'
        found = np.array(corners(written(tmp_path, "a.svg", SVG.format("", shape)))) * [1, -1]
        back = np.linalg.solve(np.array([[a, c], [b, d]]), (found - [e, f]).T).T - [3, 4]
        assert np.abs(np.hypot(back[:, 0] / 20.0, back[:, 1] / 9.0) - 1.0).max() < 1e-9


def test_an_arc_of_svg_is_that_of_the_standard(tmp_path: Path) -> None:
    """Centre and angles by the formulas of SVG 1.1, F.6.5, with flags glued and radii too small."""
    pytest.importorskip("svgelements")
    for rx, ry, turn, large, sweep in (
        (25, 25, 0, 0, 1), (30, 12, 40, 1, 0), (30, 12, 40, 0, 0), (9, 30, -20, 1, 1), (4, 3, 10, 0, 1),
    ):  # fmt: skip
        text = f'<path d="M10 20a{rx},{ry} {turn} {large}{sweep}22,-7"/>'
        found = np.array(corners(written(tmp_path, "a.svg", SVG.format("", text)))) * [1, -1]
        centre, size, axes = _arc(np.array([10.0, 20.0]), np.array([32.0, 13.0]), rx, ry, turn,
                                  bool(large), bool(sweep))  # fmt: skip
        unit = (found - centre) @ axes / (np.array([rx, ry]) * size)
        assert np.abs(np.hypot(unit[:, 0], unit[:, 1]) - 1.0).max() < 1e-7
        angle = np.unwrap(np.arctan2(unit[:, 1], unit[:, 0]))
        assert (angle[-1] > angle[0]) == bool(sweep)
        assert size > 1.0 or (abs(angle[-1] - angle[0]) > math.pi) == bool(large)
        assert np.allclose(found[[0, -1]], [[10, 20], [32, 13]])


def _arc(
    start: FloatArray, end: FloatArray, rx: float, ry: float, turn: float, large: bool, sweep: bool
) -> tuple[FloatArray, float, FloatArray]:
    """Its centre, by how much its radii are too small, and the axes of its ellipse as columns."""
    w = math.radians(turn)
    axes = np.array([[math.cos(w), -math.sin(w)], [math.sin(w), math.cos(w)]])
    x, y = axes.T @ (start - end) / 2.0
    size = max(1.0, math.hypot(x / rx, y / ry))
    a, b = rx * size, ry * size
    root = math.sqrt(
        max(0.0, (a * b) ** 2 - (a * y) ** 2 - (b * x) ** 2) / ((a * y) ** 2 + (b * x) ** 2)
    )
    root = root if large != sweep else -root
    return axes @ np.array([root * a * y / b, -root * b * x / a]) + (start + end) / 2.0, size, axes


@pytest.mark.parametrize(
    ("drawing", "sentence"),
    [
        ('<path id="w" d="M0 0L9 9L x 5 5L20 20"/>', "<path> w cannot be read: 'L x 5 5'"),
        ('<path id="w" d="M0 0L9 9 8"/>', "<path> w cannot be read: 'L9 9 8'"),
        ('<path d="L9 9 8 8"/>', "cannot be read"),
        ('<path d="M0 0A5 5 0 2 0 9 9"/>', "cannot be read"),
        ('<path d="M0 0C1 1 2 2"/>', "cannot be read"),
        ('<polyline points="0,0 9,9 5"/>', "<polyline>  cannot be read: '0,0 9,9 5'"),
        ('<path d="M0 0 9 9" transform="translate(1 2) turn(3)"/>', "cannot be read: 'translate(1"),
        ('<path d="M0 0 9 9" transform="rotate(1 2)"/>', "cannot be read: 'rotate(1 2)'"),
        ('<path d="M0 0 9 9" transform="rotate(9)" transform-origin="1"/>', "be read: 'rotate(9)'"),
        # What is drawn on after a z is another line, which begins where the first did.
        ('<path d="M0 0 9 0 9 9zL-5 5"/>', "holds 2 lines that do not meet"),
        ('<line x1="10%" x2="20"/>', "<line>  cannot be read: '10%'"),
        ("<use/><text>x</text>", "holds no line; passed over: 1 <use>, 1 <text>"),
        ('<path d="M0 0 9 9" style="display : none"/>', "holds no line; passed over: 1 hidden line"),
    ],
)  # fmt: skip
def test_svg_that_would_be_read_in_part_is_refused(drawing: str, sentence: str, tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    with pytest.raises(InputError) as caught:
        corners(written(tmp_path, "a.svg", SVG.format("", drawing)))
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ("root", "scale"),
    [
        ('width="200mm" height="100mm" viewBox="0 0 200 100"', 1.0),
        ('width="20cm" height="10cm" viewBox="-5 7 200 100"', 1.0),
        ('width="200mm" height="100mm" viewBox="0 0 100 100"', 1.0),
        (
            'width="200mm" height="100mm" viewBox="0 0 100 100" preserveAspectRatio="xMinYMin slice"',
            2.0,
        ),
        ('width="210mm" height="297mm" viewBox="0 0 744.09 1052.36"', 210 / 744.09),
        ('width="200mm" height="100mm" viewBox="0 0 100 100" preserveAspectRatio="none"', 0.0),
    ],
)
def test_the_scale_of_svg_is_that_of_what_fits(root: str, scale: float, tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    path = written(tmp_path, "a.svg", SVG.format(root, '<path d="M0 0 50 0"/>'))
    if not scale:
        with pytest.raises(InputError, match="viewBox stretch the drawing"):
            corners(path, Survey())
        return
    assert np.allclose(corners(path, Survey())[1], [0.05 * scale, 0.0])


def test_dxf_from_below_closed_and_with_bulges_is_as_drawn(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new("R2010", units=14)
    space = document.modelspace()
    points = [(0, 0, 0), (40, 0, 1), (40, 20, 0), (0, 20, 1)]
    for layer, normal in (("above", (0, 0, 1)), ("below", (0, 0, -1))):
        look = {"layer": layer, "extrusion": normal}
        space.add_lwpolyline(points, format="xyb", close=True, dxfattribs=look)
    space.add_polyline2d([(0, 0), (9, 0), (9, 0), (9, 9)], close=True, dxfattribs={"layer": "three"})
    space.add_line((0, 0, 5), (3, 4, 9), dxfattribs={"layer": "steep"})
    for count in (1, 2):
        ring = [(0, 0), (9, 0), (9, 9)]
        space.add_lwpolyline(ring[::count] + ring[1::2][: count - 1], close=True,
                             dxfattribs={"layer": "twice"})  # fmt: skip
    space.add_circle((5, 5), 2, dxfattribs={"layer": "twice round"})
    space.add_circle((-5, 5), 2, dxfattribs={"layer": "twice round", "extrusion": (0, 0, -1)})
    document.saveas(tmp_path / "a.dxf")
    for layer, side in (("above", 1.0), ("below", -1.0)):
        line, _survey = read_line(tmp_path / "a.dxf", Survey(), layer)
        pieces = line.pieces()
        # $INSUNITS 14 is decimetres: two straights of 4 m, and half circles of 1 m that bulge outwards.
        assert math.isclose(sum(piece.length for piece in pieces), 8.0 + 2.0 * math.pi)
        assert math.isclose(float(pieces[1].curvature(0.0)), side)
        assert np.allclose(pieces[1].point(0.5 * pieces[1].length), [side * 5.0, 1.0])
    three, _survey = outline(tmp_path / "a.dxf", Survey(), "three")
    assert three.tolist() == [[0, 0], [0.9, 0], [0.9, 0.9]]
    told: list[str] = []
    for layer in ("twice", "twice round"):
        line, _survey = read_line(tmp_path / "a.dxf", Survey(), layer, told.append)
        assert line.closed
        assert told[-1] == "a.dxf: lines drawn twice, passed over once: 1"
    assert "1 LINE that is not level (read as seen from above)" in told[0]
    assert corners(tmp_path / "a.dxf", Survey(), "steep")[1] == [0.3, 0.4]


def test_a_whole_circle_may_be_said_as_an_arc_and_a_whole_ellipse_rounded(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new("R2010", units=6)
    space = document.modelspace()
    space.add_arc((3, 4), 5, 0, 360, dxfattribs={"layer": "arc"})
    space.add_arc((3, 4), 5, 350, 10, dxfattribs={"layer": "part"})
    for end in (6.28319, 6.283185, 2.0 * math.pi):
        space.add_ellipse((0, 0), (9, 0), 0.5, 0.0, end, dxfattribs={"layer": f"{end}"})
    space.add_ellipse((0, 0), (9, 0), 0.5, 5.0, 1.0, dxfattribs={"layer": "across"})
    document.saveas(tmp_path / "a.dxf")
    for layer in ("6.28319", "6.283185", str(2.0 * math.pi)):
        ring, _survey = outline(tmp_path / "a.dxf", Survey(), layer)
        assert np.ptp(ring, axis=0).tolist() == pytest.approx([18.0, 9.0], abs=0.01)
    circle, half = read_line(tmp_path / "a.dxf", Survey(), "arc")[0].pieces()
    assert math.isclose(circle.length + half.length, 10.0 * math.pi)
    (arc,) = read_line(tmp_path / "a.dxf", Survey(), "part")[0].pieces()
    assert math.isclose(arc.length, 5.0 * math.pi / 9.0)
    across = np.array(corners(tmp_path / "a.dxf", Survey(), "across"))
    assert across[:, 0].max() == pytest.approx(9.0, abs=0.01)
    assert not read_line(tmp_path / "a.dxf", Survey(), "across")[0].closed


def test_a_unit_that_the_plan_says_otherwise_is_told(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new("R2010", units=4)
    document.modelspace().add_line((0, 0), (3, 4))
    document.saveas(tmp_path / "a.dxf")
    told: list[str] = []
    read_line(tmp_path / "a.dxf", METRES, None, told.append)
    assert told == ["a.dxf says that its unit is mm, and survey.unit says m, which was taken"]
    told.clear()
    read_line(written(tmp_path, "a.csv", "x,y\n0,0\n9,9\n"), Survey(unit="cm"), None, told.append)
    assert told == []


def test_an_arc_of_dxf_that_ends_where_it_starts_is_asked_about(tmp_path: Path) -> None:
    pytest.importorskip("ezdxf")
    for start, end in ((30.0, 30.0), (30.0, 29.9999999999)):
        arc = dxf_text(
            (0, "SECTION"), (2, "ENTITIES"), (0, "ARC"), (8, "way"), (10, 3.0), (20, 4.0), (40, 5.0),
            (50, start), (51, end), (0, "ENDSEC"), (0, "EOF"),
        )  # fmt: skip
        with pytest.raises(
            InputError, match=r"an ARC of layer way about \(3, 4\) ends where it starts"
        ):
            corners(written(tmp_path, "a.dxf", arc))
        with pytest.raises(InputError, match=r"a\.dxf is cut off"):
            corners(written(tmp_path, "a.dxf", arc[: arc.index("ENDSEC")]))


PARTS = (
    "<LandXML><Units><Metric linearUnit='meter'/></Units><Alignment name='A'><CoordGeom>{}</CoordGeom>"
    "</Alignment></LandXML>"
)
ARC = "<Curve {}><Start>0 0</Start><Center>9 0</Center><End>{}</End></Curve>"


@pytest.mark.parametrize(
    ("part", "wanted"),
    [
        (ARC.format('rot="ccw"', "9 9"), 4.5 * math.pi),
        (ARC.format('rot="cw"', "9 9"), 13.5 * math.pi),
        (ARC.format('rot="cw" length="42.41"', "9 9"), 13.5 * math.pi),
        (ARC.format('rot="ccw" length="56.549"', "0 -0.000001"), 18.0 * math.pi),
        (ARC.format('rot="ccw"', "0 -0.000001"), "holds no line"),
        (ARC.format('rot="cw" length="14.137"', "9 9"), "part 1 of 'A', at (0, 0): the file says"),
        (ARC.format("", "9 9"), "the Curve at (0, 0) does not say by rot whether it bends cw or ccw"),
        (ARC.format('rot="ccw"', "9 8"), "part 1 of 'A', at (0, 0): it ends 1 m beside its End"),
        ('<Line length="5"><Start>0 0</Start><End>0 9</End></Line>', "says that it is 5 m long"),
    ],
)  # fmt: skip
def test_a_part_of_an_alignment_is_what_the_file_says_of_it(
    part: str, wanted: float | str, tmp_path: Path
) -> None:
    path = written(tmp_path, "a.xml", PARTS.format(part))
    if isinstance(wanted, str):
        with pytest.raises(InputError) as caught:
            read_line(path, Survey())
        assert wanted in str(caught.value)
        return
    (curve,) = read_line(path, Survey())[0].curves
    assert math.isclose(curve.length, wanted, abs_tol=1e-5)


GPS = Survey("wgs84")
LINE = "<kml><Placemark><LineString><coordinates>{}</coordinates></LineString></Placemark></kml>"
GRID = '{"type":"LineString","coordinates":[[5e5,3e6],[500020,3e6]],"crs":{"properties":{"name":"%s"}}}'
ROUND = dxf_text((0, "SECTION"), (2, "ENTITIES"), (0, "CIRCLE"), (8, "w"), (10, 120.1), (20, 30.2),
                 (40, 0.001), (0, "ENDSEC"), (0, "EOF"))  # fmt: skip
FAR = dxf_text((0, "SECTION"), (2, "ENTITIES"), (0, "LINE"), (8, "w"), (10, 338e4), (20, 456000),
               (11, 338e4), (21, 456009), (0, "ENDSEC"), (0, "EOF"))  # fmt: skip
NORTHWARDS = PARTS.format("<Line><Start>30 120</Start><End>30 120.001</End></Line>")


@pytest.mark.parametrize(
    ("name", "text", "survey", "sentence"),
    [
        ("a.kml", LINE.format("1,2,3 1.1,2,3,1.2,2.1,3 1.3,2,3"), GPS, "a.kml: place 2 of a line"),
        ("a.kml", LINE.format("1 2 3 4"), GPS, "expected numbers, not '1'"),
        ("a.gpx", "<gpx><trk><trkseg><trkpt lat='1'/></trkseg></trk></gpx>", GPS,
         "a.gpx: expected numbers, not '1'"),
        ("a.gpx", "<gpx><wpt lat='1' lon='2'/></gpx>", GPS, "passed over: 1 wpt"),
        ("a.csv", "lon,lat\n87.6,43.8\n43.8,87.6\n", Survey("gcj02"), "where gcj02 is meant for"),
        ("a.csv", "lon,lat\n43.8,87.6\n43.9,87.6\n", Survey("EPSG:4490"), "where EPSG:4490 is"),
        ("a.csv", "lon,lat\n2.35,48.85\n2.36,48.85\n", Survey("BD-09"), "where BD-09 is meant for"),
        ("a.csv", "x,y\n500000,3350000\n500020,3350000\n", Survey("EPSG:4528"), "where EPSG:4528 is"),
        ("a.csv", "x,y\n3350000,500000\n3350020,500000\n", Survey("epsg 4549"), "with both exchanged"),
        ("a.csv", "x,y\n3380000,40456000\n3380000,40456020\n", Survey(), "do x = 3380000 and y = 404"),
        ("a.dxf", FAR, METRES, "do x = 3380000 and y = 456000 say north and east"),
        ("a.xml", PARTS.format("<Line><Start>456000 3380000</Start><End>456009 3380000</End></Line>"),
         Survey(), "do x = 3380000 and y = 456000 say north"),
        ("a.csv", "x,y\n3380000,456000\n3380000,456020\n", Survey(unit="m"), "or set survey.crs"),
        ("a.csv", "x,y\n500000,3350000\n500020,3350000\n", Survey("EPSG:4549", None, (335e4, 5e5)),
         "points must lie within 200000 m of survey.origin"),
        ("a.csv", "X坐标,Y坐标\n1,2\n3,4\n", Survey(), "which of X坐标, Y坐标 points north?"),
        ("a.csv", "0,0\nx,y\n9,0\n9,9\n", METRES, "the first row must name the columns x and y"),
        ("a.csv", "x;y\n1;2\n3;1,234.5\n", Survey(), "line 3: expected two numbers"),
        ("a.csv", "x\ty\n1\t2\n3\t1,234\n", Survey(), "line 3: expected two numbers"),
        ("a.kmz", b"PK", GPS, "a.kmz is no KMZ archive with a KML file in it"),
        ("a.dwg", b"AC1032", GPS, "a.dwg is a binary drawing: save it as DXF"),
        ("a.dxf", b"AC1032\0\0", METRES, "a.dxf is a binary drawing: save it as DXF"),
        ("a.geojson", GRID % "EPSG:4549", Survey("EPSG:4550"), "says that its coordinates are"),
        ("a.dxf", ROUND, GPS, "arcs are read in metres"),
        ("a.xml", NORTHWARDS, GPS, "alignments are read in metres"),
        ("a.svg", '<!DOCTYPE svg [<!ENTITY m "1">]><svg><path d="M0 0 &m; 9"/></svg>'.encode("utf-16"),
         METRES, "a.svg uses entities, which are not read"),
        ("a.svg", '<!DOCTYPE svg PUBLIC "x" "y"><svg><path d="M0 0&more; 9 9"/></svg>', METRES,
         "a.svg uses entities, which are not read"),
    ],
)  # fmt: skip
def test_what_cannot_be_taken_as_drawn_is_refused(
    name: str, text: str | bytes, survey: Survey, sentence: str, tmp_path: Path
) -> None:
    for extra in ("ezdxf", "svgelements", "pyproj"):
        pytest.importorskip(extra)
    with pytest.raises(InputError) as caught:
        read_line(written(tmp_path, name, text), survey)
    assert sentence in str(caught.value)


ROWS = "{x}{m}{y}\n0{m}0\n20{m}0\n35{m}10\n"


@pytest.mark.parametrize(
    "data",
    [
        ROWS.format(x="x", y="y", m=",").encode("utf-16"),
        ROWS.format(x="x", y="y", m="\t").encode(),
        ROWS.format(x="东坐标", y="北坐标", m=",").encode("gb18030"),
        ROWS.format(x="东", y="北", m="，").encode("utf-8-sig"),
        ROWS.format(x="X（m）", y="y/米", m="；").encode("gb18030"),
        ("路线，二零二六年\n\n" + ROWS.format(x="x", y="y", m=";")).encode(),
        ROWS.format(x="x", y="y", m=";").replace("35", "35,0").encode(),
        b"name;y;x\r\na;0;0\r\na;0;20\r\na;10;35,0\r\n",
    ],
)
def test_a_table_of_points_is_read_as_programs_write_it(data: bytes, tmp_path: Path) -> None:
    assert corners(written(tmp_path, "a.csv", data), Survey()) == [[0, 0], [20, 0], [35, 10]]


def test_a_layer_in_gb18030_is_not_taken_for_two_signs_of_utf_8(tmp_path: Path) -> None:
    # Its bytes are those of a middle dot in UTF-8, too.
    rows = "layer,x,y\n路,0,0\n路,9,0\n".encode("gb18030")
    assert corners(written(tmp_path, "a.csv", rows), Survey(), "路") == [[0, 0], [9, 0]]


def test_a_walk_recorded_by_phone_is_read_from_gpx_kml_and_kmz(tmp_path: Path) -> None:
    points = [(120.15, 30.25), (120.1502, 30.25), (120.1503, 30.2501)]
    rows = "".join(f"<trkpt lat='{y}' lon='{x}'><ele>3</ele></trkpt>" for x, y in points)
    track = "".join(f"<when/><gx:coord>{x} {y} 3</gx:coord>" for x, y in points)
    kml = f"<kml xmlns:gx='g'><Placemark><gx:Track>{track}</gx:Track></Placemark></kml>"
    with zipfile.ZipFile(packed := io.BytesIO(), "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("files/photo.jpg", b"x")
        archive.writestr("doc.kml", kml)
    files: dict[str, str | bytes] = {
        "a.gpx": f"<gpx><trk><trkseg>{rows}</trkseg></trk></gpx>",
        "b.gpx": f"<gpx><rte>{rows.replace('trkpt', 'rtept')}</rte></gpx>",
        "c.xml": f"<gpx><trk><trkseg>{rows}</trkseg></trk></gpx>",
        "d.kml": kml,
        "e.kmz": packed.getvalue(),
    }
    read = [corners(written(tmp_path, name, text), Survey("wgs84")) for name, text in files.items()]
    assert all(one == read[0] for one in read)
    assert np.allclose(read[0], [[0.0, 0.0], [19.25, 0.0], [28.87, 11.09]], atol=0.02)


def test_what_is_packed_too_well_is_not_unpacked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with zipfile.ZipFile(packed := io.BytesIO(), "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("doc.kml", b" " * 1_000_000)
    monkeypatch.setattr(xml_formats, "MOST_BYTES", 999_999)
    with pytest.raises(InputError, match="what it holds is too large"):
        read_line(written(tmp_path, "a.kmz", packed.getvalue()), Survey("wgs84"))


def test_bd09_is_undone_and_systems_may_be_spelled_as_people_do() -> None:
    pytest.importorskip("pyproj")
    rng = np.random.default_rng(1)
    places = np.column_stack([rng.uniform(75.0, 130.0, 500), rng.uniform(20.0, 50.0, 500)])
    shown = bd09_of_wgs84(places)
    assert np.abs(unshifted(shown, bd09_of_wgs84) - places).max() < 1e-9
    # Tiananmen, by the published algorithm.
    assert np.allclose(bd09_of_wgs84(np.array([[116.404, 39.915]])), [[116.41662724, 39.92269861]],
                       atol=1e-5)  # fmt: skip
    spellings = {
        "gcj02": ("GCJ-02", "gcj 02"), "bd09": ("BD_09", "BD-09"), "wgs84": ("WGS 84", "WGS-84"),
        "EPSG:4549": ("epsg:4549", "EPSG 4549", "urn:ogc:def:crs:EPSG::4549"),
    }  # fmt: skip
    for code, others in spellings.items():
        assert all(system_of(words) == system_of(code) for words in others)
