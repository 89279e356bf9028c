"""Lines of CSV and GeoJSON files, as the file says them."""

import csv
import io
import json
from collections.abc import Iterator
from typing import Any

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.surveys.raw import RawFile, RawLine

# What a column is called, in lower case, and whether it is a longitude or latitude.
EAST = {
    "x": False,
    "x_m": False,
    "east": False,
    "easting": False,
    "lon": True,
    "lng": True,
    "longitude": True,
}
NORTH = {"y": False, "y_m": False, "north": False, "northing": False, "lat": True, "latitude": True}
# GeoJSON: collections within collections.
MOST_DEPTH = 20
# Of its lines: in how many lists they lie, and whether they are rings of polygons.
LINES = {
    "LineString": (0, False),
    "MultiLineString": (1, False),
    "Polygon": (0, True),
    "MultiPolygon": (1, True),
}


def csv_file(data: bytes, name: str) -> RawFile:
    """One line through the rows of a table with the columns x and y, or lon and lat; metres.

    A column `layer` or `name`, if there is one, tells lines apart.

    Raises:
        InputError: for other columns, and for what is no number.
    """
    rows = csv.reader(io.StringIO(_decoded(data, name)))
    try:
        header = [cell.strip().lower() for cell in next(rows, [])]
        east = next((i for i, cell in enumerate(header) if cell in EAST), None)
        north = next((i for i, cell in enumerate(header) if cell in NORTH), None)
        if east is None or north is None or EAST[header[east]] != NORTH[header[north]]:
            raise InputError(
                _("{file}: the first row must name the columns x and y, or lon and lat").format(
                    file=name
                )
            )
        label = next((i for i, cell in enumerate(header) if cell in ("layer", "name")), None)
        lines: dict[str, list[tuple[float, ...]]] = {}
        for row in rows:
            if any(cell.strip() for cell in row):
                key = row[label] if label is not None and label < len(row) else ""
                lines.setdefault(key, []).append(_pair(row, east, north, name, rows.line_num))
    except csv.Error as error:
        raise InputError(_("{file} is no table: {fault}").format(file=name, fault=error)) from None
    found = [RawLine(key, points, _closed(points)) for key, points in lines.items()]
    return RawFile(found, EAST[header[east]], "m")


def _pair(row: list[str], east: int, north: int, name: str, number: int) -> tuple[float, float]:
    try:
        return float(row[east]), float(row[north])
    except (ValueError, IndexError):
        raise InputError(
            _("{file}, line {line}: wanted two numbers, not {cells}").format(
                file=name, line=number, cells=repr(", ".join(row))[:60]
            )
        ) from None


def _closed(points: list[tuple[float, ...]]) -> bool:
    return len(points) > 3 and points[0] == points[-1]


def _decoded(data: bytes, name: str) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(_("{file} is not UTF-8 text").format(file=name)) from None


def geojson_file(data: bytes, name: str) -> RawFile:
    """The lines and the outer edges of polygons of a GeoJSON file: longitudes and latitudes.

    Raises:
        InputError: for what is not GeoJSON.
    """
    try:
        whole = json.loads(_decoded(data, name))
    except (ValueError, RecursionError):
        raise InputError(_("{file} is not JSON").format(file=name)) from None
    try:
        return RawFile(list(_lines(whole, "", 0)), True, "m")
    except (TypeError, ValueError, KeyError, IndexError, AttributeError, OverflowError):
        raise InputError(_("{file} is not GeoJSON as RFC 7946 has it").format(file=name)) from None


def _lines(node: Any, name: str, depth: int) -> Iterator[RawLine]:
    """The lines of a GeoJSON object, each with the name of the feature that it belongs to."""
    if depth > MOST_DEPTH:
        raise ValueError
    kind = node["type"]
    if kind in ("FeatureCollection", "GeometryCollection"):
        for inner in node["features" if kind == "FeatureCollection" else "geometries"]:
            yield from _lines(inner, name, depth + 1)
    elif kind == "Feature":
        about = node.get("properties") or {}
        called = next((about[key] for key in ("layer", "name") if about.get(key)), node.get("id", name))
        if node.get("geometry"):
            yield from _lines(node["geometry"], str(called), depth + 1)
    elif kind in LINES:
        depth, ring = LINES[kind]
        for points in _each(node["coordinates"], depth, ring):
            yield RawLine(name, points, ring or _closed(points))


def _each(coordinates: Any, depth: int, ring: bool) -> Iterator[list[tuple[float, ...]]]:
    """The lines in coordinates that lie so deep; of polygons the outer ring, which comes first."""
    if depth == 0:
        yield _points(coordinates[0] if ring else coordinates)
        return
    for inner in coordinates:
        yield from _each(inner, depth - 1, ring)


def _points(positions: Any) -> list[tuple[float, ...]]:
    points = [(position[0], position[1]) for position in positions]
    if not all(type(value) in (int, float) for point in points for value in point):
        raise TypeError
    return [(float(x), float(y)) for x, y in points]
