"""The ground that a dance covers as files: drawings to scale, DXF for CAD, GeoJSON for maps."""

import io
import json
import math
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from benchdragon.analysis.ground import Ground
from benchdragon.analysis.swept import ERROR, Shape, SweptArea, rings, swept_area
from benchdragon.errors import brought_by, in_order
from benchdragon.figures.area import AreaDrawing, area_picture
from benchdragon.figures.style import write_picture
from benchdragon.files import whole_bytes
from benchdragon.i18n import _, language
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.outline import shape_of
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.version import __version__

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts.layout import Modelspace

# Layers of DXF files with the colours of AutoCAD's index; holes have layers of their own.
SWEPT, SPECTATORS, ROUTE, VENUE, OBSTACLES = "SWEPT", "SPECTATORS", "ROUTE", "VENUE", "OBSTACLES"
HOLES = "_HOLES"
LAYERS = {SWEPT: 5, SWEPT + HOLES: 4, SPECTATORS: 30, SPECTATORS + HOLES: 40, ROUTE: 8, VENUE: 7,
          OBSTACLES: 1}  # fmt: skip
METRES, METRIC = 6, 1
# The route is simplified by at most so much, m.
ROUTE_ERROR = 1e-3
# Head positions at which it is asked whether the dragon stands, and how far before a place at which it
# does not the area ends, m.
PLACES, BEFORE = 4_096, 1e-3


class AreaWarning(UserWarning):
    """The area ends before the walk that was asked for."""


def planned_area(
    plan: Plan, start: float | None = None, end: float | None = None, *, margin: float = 0.0,
    error: float = ERROR, progress: Progress = silent,
) -> SweptArea:  # fmt: skip
    """The ground that a plan's dance covers; times that are None are as the plan says.

    An end that is not given is where the dragon can no longer stand, if that comes first: a warning
    says so.

    Raises:
        InputError, WalkError, UnsureError: as `swept_area`.
    """
    walk = plan.build()
    first, last = plan.span(walk) if start is None or end is None else (start, end)
    start = first if start is None else start
    in_order(start, last if end is None else end)
    if end is None:
        end = _standing(walk, start, last)
    return swept_area(walk, start, end, margin=margin, error=error, progress=progress)


def _standing(walk: Walk, start: float, end: float) -> float:
    """The end of a walk, s, or a little before the dragon can no longer stand."""
    ends = walk.head_position([start, end])
    failed = walk.first_failure(np.linspace(ends[0], ends[1], PLACES))
    if failed is None:
        return end
    last = walk.time_at(failed.head - BEFORE)
    if not start <= last < math.inf:
        raise failed
    warnings.warn(
        _("drawn up to t = {t} s only: {why}").format(t=f"{last:.6g}", why=failed),
        AreaWarning,
        stacklevel=3,
    )
    return last


def drawing_of(plan: Plan, swept: SweptArea) -> AreaDrawing:
    """The drawing of an area of a plan, with the plan's title, venue and obstacles."""
    ground = Ground((0.0, 0.0), north=plan.survey.north)
    return AreaDrawing(plan.title(language()), swept, plan.obstacles(), ground)


def write_area(
    drawing: AreaDrawing, path: Path, plan_sha256: str, *, paper: str = "A3", scale: float | None = None
) -> None:
    """Write a drawing as the ending of `path` says: one of ENDINGS.

    Raises:
        InputError: for a drawing that does not fit the paper.
        MissingExtraError: for .dxf without ezdxf.
    """
    if path.suffix in WRITERS:
        with whole_bytes(path) as made:
            made.write(WRITERS[path.suffix](drawing, plan_sha256))
        return
    write_picture(area_picture(drawing, paper, scale), path, drawing.title, plan_sha256)


def route_line(drawing: AreaDrawing) -> FloatArray:
    """The route under the benches, m, (n, 2), within ROUTE_ERROR of points a decimetre apart."""
    line: FloatArray = shapely.get_coordinates(
        shapely.simplify(shapely.LineString(drawing.route()), ROUTE_ERROR)
    )
    return line


def dxf_bytes(drawing: AreaDrawing, plan_sha256: str) -> bytes:
    """A DXF file: closed polylines in metres, a layer for each kind of line; always the same bytes."""
    with brought_by("survey"):
        from ezdxf._options import options  # an optional extra
        from ezdxf.filemanagement import new
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        document = new("R2010")
        _fill(document, drawing, plan_sha256)
        made = io.StringIO()
        document.write(made)
    finally:
        options.write_fixed_meta_data_for_testing = before
    return made.getvalue().encode(document.output_encoding, errors="dxfreplace")


def _fill(document: "Drawing", drawing: AreaDrawing, plan_sha256: str) -> None:
    document.header["$INSUNITS"], document.header["$MEASUREMENT"] = METRES, METRIC
    said = {"plan_sha256": plan_sha256, "version": f"benchdragon {__version__}"}
    swept = drawing.swept
    for name in ("start", "end", "margin", "error"):
        said[name] = repr(getattr(swept, name))
    for name, text in said.items():
        document.header.custom_vars.append(name, text)
    for name, colour in LAYERS.items():
        document.layers.add(name, color=colour)
    space = document.modelspace()
    _add_rings(space, swept.polygon, SWEPT)
    if swept.margin:
        _add_rings(space, swept.spectators, SPECTATORS)
    space.add_lwpolyline(route_line(drawing).tolist(), dxfattribs={"layer": ROUTE})
    for one in drawing.obstacles:
        _add_obstacle(space, one)


def _add_rings(space: "Modelspace", shape: Shape, layer: str) -> None:
    found = rings(shape)
    for name, some in ((layer, found.outer), (layer + HOLES, found.holes)):
        for ring in some:
            space.add_lwpolyline(ring[:-1].tolist(), close=True, dxfattribs={"layer": name})


def _add_obstacle(space: "Modelspace", one: Obstacle) -> None:
    look = {"layer": VENUE if one.kind == "venue" else OBSTACLES}
    if one.kind == "circle":
        space.add_circle(one.outline[0].tolist(), one.radius, dxfattribs=look)
    else:
        space.add_lwpolyline(one.outline.tolist(), close=one.kind != "line", dxfattribs=look)


def geojson_bytes(drawing: AreaDrawing, plan_sha256: str) -> bytes:
    """A GeoJSON feature collection in the plan's own metres, as its `units` say; it has no `crs`."""
    swept = drawing.swept
    numbers = {name: getattr(swept, name) for name in ("start", "end", "margin", "error")}
    features = [_feature(SWEPT, swept.polygon, {**numbers, "area": swept.area})]
    if swept.margin:
        features.append(_feature(SPECTATORS, swept.spectators, {"margin": swept.margin}))
    features.append(_feature(ROUTE, shapely.LineString(route_line(drawing)), {}))
    for one in drawing.obstacles:
        layer = VENUE if one.kind == "venue" else OBSTACLES
        about = {"name": one.name, "kind": one.kind, "margin": one.margin}
        about |= {"radius": one.radius} if one.kind == "circle" else {}
        features.append(_feature(layer, shape_of(one), about))
    whole = {
        "type": "FeatureCollection",
        "units": "m",
        "coordinates": "local: x and y of the plan, not longitude and latitude",
        "plan_sha256": plan_sha256,
        "version": __version__,
        "features": features,
    }
    return json.dumps(whole, ensure_ascii=False).encode()


def _feature(layer: str, shape: Shape, about: dict[str, Any]) -> dict[str, Any]:
    geometry = shapely.geometry.mapping(shapely.orient_polygons(shape))
    return {"type": "Feature", "properties": {"layer": layer, **about}, "geometry": geometry}


WRITERS: dict[str, Callable[[AreaDrawing, str], bytes]] = {".dxf": dxf_bytes, ".geojson": geojson_bytes}
