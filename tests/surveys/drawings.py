"""Drawings for tests, written as programs write them."""

import json
import math

import numpy as np
from numpy.typing import ArrayLike

from benchdragon.model.curves import Arc, Clothoid, Line, Route

ORIGIN = (120.15, 28.92)
# Corners of the same square about ORIGIN, by PROJ 9.5: inverse transverse Mercator on WGS 84.
SQUARE = ((0.0, 0.0), (30.0, 0.0), (30.0, 20.0), (0.0, 20.0))


def dxf_text(*pairs: tuple[int, object]) -> str:
    return "".join(f"{code:3d}\n{value}\n" for code, value in pairs)


def bare_dxf(unit: float) -> str:
    """A square of four LINEs in no order and no direction, no header: as simple programs write it."""
    text = dxf_text((0, "SECTION"), (2, "ENTITIES"))
    for first, last in ((0, 1), (3, 2), (2, 1), (3, 0)):
        (x0, y0), (x1, y1) = SQUARE[first], SQUARE[last]
        text += dxf_text(
            (0, "LINE"), (8, "edge"), (62, 256), (6, "ByLayer"),
            (10, x0 * unit), (20, y0 * unit), (30, 0.0), (11, x1 * unit), (21, y1 * unit), (31, 0.0),
        )  # fmt: skip
    return text + dxf_text((0, "ENDSEC"), (0, "EOF"))


def degrees(points: ArrayLike) -> list[list[float]]:
    """Longitudes and latitudes of metres about ORIGIN, by pyproj."""
    import pyproj

    local = pyproj.Proj(f"+proj=tmerc +lon_0={ORIGIN[0]} +lat_0={ORIGIN[1]} +ellps=WGS84")
    x, y = np.asarray(points, np.float64).T
    return np.column_stack(local(x, y, inverse=True)).tolist()  # type: ignore[no-any-return]


def geojson_square() -> str:
    ring = degrees([*SQUARE, SQUARE[0]])
    return json.dumps({"type": "Feature", "properties": {"name": "edge"},
                       "geometry": {"type": "Polygon", "coordinates": [ring]}})  # fmt: skip


TRAM = Route.joined(
    [
        Line(12.0), Clothoid(6.0, 0.0, 1 / 50), Arc(50.0, 0.4), Clothoid(6.0, 1 / 50, 0.0),
        Line(8.0), Clothoid(4.5, 0.0, -1 / 40), Arc(40.0, -0.3), Clothoid(4.5, -1 / 40, 0.0),
        Line(20.0),
    ]
)  # fmt: skip
RAILWAY = Route.joined(
    [
        Line(120.0), Clothoid(60.0, 0.0, 1 / 500), Arc(500.0, 0.4), Clothoid(60.0, 1 / 500, 0.0),
        Line(80.0), Clothoid(45.0, 0.0, -1 / 400), Arc(400.0, -0.3), Clothoid(45.0, -1 / 400, 0.0),
        Line(200.0),
    ]
)  # fmt: skip


def landxml(route: Route, gap: float, kink: float, at: tuple[float, float], seed: int = 1) -> str:
    """A route as LandXML, with gaps of up to `gap` m and kinks of up to `kink` rad at its joints."""
    rng = np.random.default_rng(seed)
    text = ""
    for curve in route:
        (x, y), heading = curve.start_pose
        shift, turn = 0.5 * gap * rng.uniform(-0.7, 0.7, 2), 0.5 * kink * rng.uniform(-1.0, 1.0)
        moved = curve.moved((x + shift[0] + at[0], y + shift[1] + at[1]), heading + turn)
        text += _element(moved)
    return (
        '<?xml version="1.0"?><LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2">'
        '<Units><Metric linearUnit="meter" areaUnit="squareMeter"/></Units><Alignments>'
        f'<Alignment name="A"><CoordGeom>{text}</CoordGeom></Alignment>'
        "</Alignments></LandXML>"
    )


def _place(tag: str, x: float, y: float) -> str:
    return f"<{tag}>{y:.9f} {x:.9f}</{tag}>"


def _element(curve: Line | Arc | Clothoid | object) -> str:
    assert isinstance(curve, Line | Arc | Clothoid)
    (x, y), heading = curve.start_pose
    start, end = _place("Start", x, y), _place("End", *curve.end_pose[0])
    if isinstance(curve, Line):
        return f"<Line>{start}{end}</Line>"
    if isinstance(curve, Arc):
        rot = "ccw" if curve.sweep > 0 else "cw"
        return f'<Curve rot="{rot}">{start}{_place("Center", *curve.centre)}{end}</Curve>'
    bend = curve.start_curvature or curve.end_curvature
    radii = [f"{abs(1 / k):.9f}" if k else "INF" for k in (curve.start_curvature, curve.end_curvature)]
    far = _place("PI", x + 9.0 * math.cos(heading), y + 9.0 * math.sin(heading))
    return (
        f'<Spiral rot="{"ccw" if bend > 0 else "cw"}" spiType="clothoid" length="{curve.length_m}" '
        f'radiusStart="{radii[0]}" radiusEnd="{radii[1]}">{start}{far}{end}</Spiral>'
    )
