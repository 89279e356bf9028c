"""The ground that a dance covers as files: to scale, in metres, named."""

import json
import re
from pathlib import Path
from typing import Any

import ezdxf
import matplotlib
import numpy as np
import pypdf
import pytest
import shapely
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

from benchdragon.errors import InputError, WalkError
from benchdragon.export.area import (
    BEFORE,
    LAYERS,
    AreaWarning,
    drawing_of,
    planned_area,
    write_area,
)
from benchdragon.figures.area import AreaDrawing, area_picture
from benchdragon.figures.scale import PAPERS, SCALES, bar_length, sheet_for
from benchdragon.figures.style import STYLE
from benchdragon.i18n import spoken_in
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.schema import Plan, checked
from benchdragon.version import __version__

MM, POINTS = 72.0 / 25.4, 1e-3


def village() -> Plan:
    """A loop around a well, which is a hole of the ground covered."""
    return checked(
        {
            "schema": 1,
            "meta": {"title": "Round the well", "title_zh": "绕井"},
            "dragon": {"benches": 5},
            "route": {
                "kind": "parts",
                "part": [{"kind": "line", "length": 12}, {"kind": "arc", "radius": 4, "angle": 400}],
            },
            "walk": {"start": 11, "end": 39},
            "venue": {"rectangle": [30, 14], "centre": [8, 3]},
            "obstacle": [
                {"kind": "circle", "name": "well 井", "centre": [12, 4], "radius": 0.6},
                {"kind": "rectangle", "name": "gate", "centre": [1, 8], "size": [3, 1], "angle": 20},
                {"kind": "line", "name": "rope", "points": [[0, 3], [4, 3], [5, 5]]},
                {"kind": "polygon", "name": "bed", "points": [[-4, 5], [-2, 5], [-2, 8]]},
            ],
        },
        "village",
    )


@pytest.fixture(scope="module")
def plan() -> Plan:
    return village()


@pytest.fixture(scope="module")
def drawing(plan: Plan) -> AreaDrawing:
    return drawing_of(plan, planned_area(plan, margin=1.0, error=0.02))


def made(drawing: AreaDrawing, plan: Plan, path: Path, **options: Any) -> bytes:
    write_area(drawing, path, plan.sha256, **options)
    return path.read_bytes()


def test_the_dxf_holds_every_line_on_its_layer_in_metres(
    drawing: AreaDrawing, plan: Plan, tmp_path: Path
) -> None:
    first = made(drawing, plan, tmp_path / "a.dxf")
    assert made(drawing, plan, tmp_path / "b.dxf") == first
    document = ezdxf.readfile(tmp_path / "a.dxf")  # type: ignore[attr-defined]
    assert document.header["$INSUNITS"] == 6
    assert not document.audit().has_errors
    assert set(LAYERS) <= {layer.dxf.name for layer in document.layers}
    said = dict(document.header.custom_vars.properties)
    assert said["plan_sha256"] == plan.sha256
    assert said["version"] == f"benchdragon {__version__}"
    space: Any = document.modelspace()
    shapes = {
        name: [np.array(line.get_points("xy")) for line in space.query(f'LWPOLYLINE[layer=="{name}"]')]
        for name in LAYERS
    }
    outer, holes = drawing.swept.outlines
    assert len(shapes["SWEPT"]) == len(outer) == 1
    assert len(shapes["SWEPT_HOLES"]) == len(holes) >= 1
    area = sum(shapely.Polygon(ring).area for ring in shapes["SWEPT"])
    area -= sum(shapely.Polygon(ring).area for ring in shapes["SWEPT_HOLES"])
    assert area == pytest.approx(drawing.swept.area)
    assert len(shapes["SPECTATORS"]) == len(shapes["SPECTATORS_HOLES"]) == 1
    assert len(shapes["VENUE"]) == 1
    assert len(shapes["OBSTACLES"]) == 3
    assert len(shapes["ROUTE"]) == 1
    closed = {line.dxf.layer: line.closed for line in space.query("LWPOLYLINE")}
    assert closed["SWEPT"]
    assert not closed["ROUTE"]
    (well,) = space.query("CIRCLE")
    assert (well.dxf.layer, well.dxf.radius) == ("OBSTACLES", 0.6)
    ropes = [line for line in space.query('LWPOLYLINE[layer=="OBSTACLES"]') if not line.closed]
    assert len(ropes) == 1


def test_the_arrow_says_north_only_where_a_survey_tells_it(drawing: AreaDrawing, plan: Plan) -> None:
    surveyed = drawing_of(plan.with_values({"survey.crs": "wgs84"}), drawing.swept)
    for one, said in [(drawing, "y axis"), (surveyed, "N (y axis)")]:
        written = [text.get_text() for text in area_picture(one).findobj(Text)]
        assert [text for text in written if "y axis" in text] == [said]


def test_the_geojson_is_in_local_metres_and_says_so(
    drawing: AreaDrawing, plan: Plan, tmp_path: Path
) -> None:
    data = json.loads(made(drawing, plan, tmp_path / "a.geojson"))
    assert "crs" not in data
    assert (data["units"], data["plan_sha256"], data["version"]) == ("m", plan.sha256, __version__)
    assert data["coordinates"].startswith("local")
    layers = [feature["properties"]["layer"] for feature in data["features"]]
    assert layers == ["SWEPT", "SPECTATORS", "ROUTE", "VENUE", *["OBSTACLES"] * 4]
    swept = data["features"][0]
    shape = shapely.geometry.shape(swept["geometry"])
    assert shape.area == pytest.approx(swept["properties"]["area"])
    assert swept["properties"]["error"] == drawing.swept.error
    outer, *holes = swept["geometry"]["coordinates"]
    assert shapely.LinearRing(outer).is_ccw
    assert holes
    assert not any(shapely.LinearRing(ring).is_ccw for ring in holes)
    assert data["features"][4]["properties"]["name"] == "well 井"
    assert data["features"][4]["properties"]["radius"] == 0.6


def _svg_size(svg: str, name: str) -> FloatArray:
    """Width and height of the path of an id, points, (2,)."""
    group = re.search(rf'<g id="{name}">\s*<path d="([^"]*)"', svg)
    assert group is not None
    numbers = [float(number) for number in re.findall(r"-?\d+\.?\d*", group[1])]
    return np.asarray(np.ptp(np.array(numbers).reshape(-1, 2), axis=0))


@pytest.mark.parametrize(
    ("scale", "paper"), [(100.0, "A3"), (200.0, "A4"), (500.0, "A4"), (50.0, "A1")]
)
def test_the_svg_is_true_to_scale(
    scale: float, paper: str, drawing: AreaDrawing, plan: Plan, tmp_path: Path
) -> None:
    svg = made(drawing, plan, tmp_path / "a.svg", paper=paper, scale=scale).decode()
    assert plan.sha256 in svg
    assert __version__ in svg
    size = re.search(r'width="([\d.]+)pt" height="([\d.]+)pt"', svg)
    assert size is not None
    sides = sorted((float(size[1]) / MM, float(size[2]) / MM), reverse=True)
    assert sides == pytest.approx(PAPERS[paper], abs=POINTS)
    bar = _svg_size(svg, "scale-bar")[0]
    assert bar == pytest.approx(bar_length(scale) * 1000.0 / scale * MM, abs=POINTS)
    x0, y0, x1, y1 = drawing.swept.polygon.bounds
    covered = _svg_size(svg, "swept")
    assert covered == pytest.approx(np.array([x1 - x0, y1 - y0]) * 1000.0 / scale * MM, abs=POINTS)


def test_a_bar_of_ten_metres_is_that_long_on_paper(
    drawing: AreaDrawing, plan: Plan, tmp_path: Path
) -> None:
    assert bar_length(200.0) == 10.0
    path = tmp_path / "a.pdf"
    made(drawing, plan, path, paper="A3", scale=200.0)
    reader = pypdf.PdfReader(path)
    page = reader.pages[0]
    sides = sorted((float(page.mediabox.width), float(page.mediabox.height)), reverse=True)
    assert sides == pytest.approx([side * MM for side in PAPERS["A3"]], abs=0.01)
    assert plan.sha256 in str(reader.metadata)
    contents = page.get_contents()
    assert contents is not None
    text = contents.get_data().decode("latin-1")
    boxes = re.findall(r"((?:-?[\d.]+ -?[\d.]+ [ml]\s+){4})h", text)
    sizes = [
        np.ptp(np.array(re.findall(r"-?[\d.]+", box), dtype=float).reshape(4, 2), axis=0)
        for box in boxes
    ]
    bar = np.array([10_000.0 / 200.0, 2.0]) * MM
    assert any(np.allclose(size, bar, atol=POINTS) for size in sizes)


def test_the_scale_is_the_largest_that_fits_and_no_other_is_taken(drawing: AreaDrawing) -> None:
    bounds = drawing.bounds()
    assert bounds.tolist() == [[-7.0, -4.0], [23.0, 10.0]]
    assert [sheet_for(bounds, paper, None).scale for paper in PAPERS] == [
        200.0,
        100.0,
        100.0,
        50.0,
        50.0,
    ]
    with pytest.raises(InputError, match=r"30\.0 m by 14\.0 m does not fit A4 at 1:100"):
        sheet_for(bounds, "A4", 100.0)
    with pytest.raises(InputError, match="does not fit"):
        sheet_for(np.array([[0.0, 0.0], [2000.0, 10.0]]), "A4", None)
    with pytest.raises(InputError, match="scale must be from 1:50 to 1:1000"):
        sheet_for(bounds, "A4", 20.0)
    with pytest.raises(InputError, match="paper must be one of"):
        sheet_for(bounds, "B5", None)


def test_tall_ground_is_drawn_upright() -> None:
    sheet = sheet_for(np.array([[0.0, 0.0], [10.0, 22.0]]), "A4", None)
    assert (sheet.width, sheet.height, sheet.scale) == (210.0, 297.0, 100.0)
    wide = sheet_for(np.array([[0.0, 0.0], [25.0, 10.0]]), "A4", None)
    assert (wide.width, wide.height, wide.scale) == (297.0, 210.0, 100.0)
    assert set(SCALES) <= {50.0, 100.0, 200.0, 250.0, 500.0, 1000.0}


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_word_of_a_sheet_leaves_it_or_lies_upon_another(
    language: str, plan: Plan, tmp_path: Path
) -> None:
    with spoken_in(language):
        drawing = drawing_of(plan, planned_area(plan, margin=12.5, error=0.05))
        for paper in PAPERS:
            figure = area_picture(drawing, paper)
            canvas: Any = FigureCanvasAgg(figure)
            with matplotlib.rc_context(STYLE):
                canvas.draw()
            renderer = canvas.get_renderer()
            axes = figure.axes[0]
            page = figure.bbox
            legend = axes.get_legend()
            assert legend is not None
            boxes = [text.get_window_extent(renderer) for text in axes.texts]
            boxes.append(legend.get_window_extent(renderer))
            for n, box in enumerate(boxes):
                assert page.x0 <= box.x0
                assert box.x1 <= page.x1
                assert page.y0 <= box.y0
                assert box.y1 <= page.y1
                assert not any(box.overlaps(other) for other in boxes[:n])


def test_a_walk_that_cannot_go_on_is_drawn_up_to_there_with_a_warning(plan: Plan) -> None:
    longer = plan.with_values({"walk.end": 60.0})
    with pytest.warns(AreaWarning, match="walk past the end of the route"):
        found = planned_area(longer, error=0.05)
    assert found.end == pytest.approx(found.walk.route.length - BEFORE)
    with pytest.raises(WalkError):
        planned_area(longer, end=60.0)


def test_without_a_margin_there_is_no_spectators_line(plan: Plan, tmp_path: Path) -> None:
    drawing = drawing_of(plan, planned_area(plan, error=0.05))
    data = json.loads(made(drawing, plan, tmp_path / "a.geojson"))
    assert "SPECTATORS" not in [feature["properties"]["layer"] for feature in data["features"]]
    assert 'id="spectators"' not in made(drawing, plan, tmp_path / "a.svg").decode()


def test_an_obstacle_without_a_name_is_shown_by_its_number_in_the_language_in_use(plan: Plan) -> None:
    data = plan.model_dump(mode="json", by_alias=True, exclude_unset=True)
    del data["obstacle"][0]["name"]
    nameless = checked(data, "village")
    with spoken_in("zh"):
        figure = area_picture(drawing_of(nameless, planned_area(nameless, error=0.1)), "A3", None)
    words = [text.get_text() for axes in figure.axes for text in axes.texts]
    assert "障碍物 1" in words
    assert not any("obstacle" in word for word in words)
