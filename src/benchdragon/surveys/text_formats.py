"""Lines of CSV and GeoJSON files, as the file says them."""

import codecs
import csv
import io
import json
import re
import unicodedata
from collections.abc import Iterator
from typing import Any

from benchdragon.decoding import readings
from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.surveys.coordinates import code_of
from benchdragon.surveys.raw import RawFile, RawLine, passed_over

# Headings, in lower case and without units, and whether the column holds degrees.
EAST = dict.fromkeys(("x", "east", "easting", "东", "东坐标"), False) | dict.fromkeys(
    ("lon", "lng", "long", "longitude", "经度"), True
)
NORTH = dict.fromkeys(("y", "north", "northing", "北", "北坐标"), False) | dict.fromkeys(
    ("lat", "latitude", "纬度"), True
)
LABELS = ("layer", "name", "图层", "名称")
# Headings of surveyors' tables, in which x mostly points north.
UNCLEAR = {"x坐标", "y坐标", "坐标x", "坐标y", "纵坐标", "横坐标"}
METRES_BEHIND = re.compile(r"(?:_m|[(\[/](?:m|米)[)\]]?)$")
# What parts columns; where it is a semicolon, a comma may stand for the point of decimals.
MARKS = ",;\t，；"
# Rows above the one that names the columns: titles.
MOST_TITLES = 10
NUMERIC = re.compile(r"[-+]?[\d.]+(?:e[-+]?\d+)?")
# The first sign that takes three bytes in UTF-8, as Chinese ones do: bytes in GB18030 never look so.
THREE_BYTES = "\u0800"
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
        InputError: for other columns, and for invalid numbers.
    """
    text = text_of(data, name)
    mark = _mark(text)
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=mark)
    try:
        header, east, north = _columns(rows, name)
        label = next((i for i, cell in enumerate(header) if cell in LABELS), None)
        lines: dict[str, list[tuple[float, ...]]] = {}
        for row in rows:
            if any(cell.strip() for cell in row):
                key = row[label] if label is not None and label < len(row) else ""
                cells = [cell.replace(",", ".") for cell in row] if mark == ";" else row
                lines.setdefault(key, []).append(_pair(cells, east, north, name, rows.line_num))
    except csv.Error as error:
        raise InputError(_("{file} is no table: {fault}").format(file=name, fault=error)) from None
    found = [RawLine(key, points, _closed(points)) for key, points in lines.items()]
    return RawFile(found, EAST[header[east]], "m", unclear=header[east] == "x")


def _mark(text: str) -> str:
    """What parts the columns: that which parts a row of headings."""
    heads = text.split("\n", MOST_TITLES)[:MOST_TITLES]
    known = EAST.keys() | NORTH.keys() | UNCLEAR
    for mark in MARKS:
        if any(
            sum(_heading(cell.strip('"')) in known for cell in row.split(mark)) > 1 for row in heads
        ):
            return mark
    return ","


def _columns(rows: Iterator[list[str]], name: str) -> tuple[list[str], int, int]:
    """The row that names the columns, and which of them hold x and y, or longitude and latitude."""
    unclear: list[str] = []
    for _n, row in zip(range(MOST_TITLES), rows, strict=False):
        header = [_heading(cell) for cell in row]
        unclear += [cell for cell, plain in zip(row, header, strict=True) if plain in UNCLEAR]
        east = [i for i, cell in enumerate(header) if cell in EAST]
        north = [i for i, cell in enumerate(header) if cell in NORTH]
        if len(east) == len(north) == 1 and EAST[header[east[0]]] == NORTH[header[north[0]]]:
            return header, east[0], north[0]
        if sum(NUMERIC.fullmatch(cell) is not None for cell in header) > 1:
            break  # a row of the line itself is no title, to be left out
    if unclear:
        text = _(
            "{file}: which of {columns} points north? With surveyors x does, in drawings y: name "
            "the columns east and north (东坐标, 北坐标)"
        )
        raise InputError(text.format(file=name, columns=", ".join(cell.strip() for cell in unclear)))
    text = _("{file}: the first row must name the columns x and y, or lon and lat")
    raise InputError(text.format(file=name))


def _heading(cell: str) -> str:
    """A heading without full-width signs, capitals, and the metres behind it."""
    plain = unicodedata.normalize("NFKC", cell).strip().lower()
    return METRES_BEHIND.sub("", plain.replace(" ", ""))


def _pair(row: list[str], east: int, north: int, name: str, number: int) -> tuple[float, float]:
    try:
        return float(row[east]), float(row[north])
    except (ValueError, IndexError):
        text = _("{file}, line {line}: expected two numbers, not {cells}")
        raise InputError(text.format(file=name, line=number, cells=repr(", ".join(row))[:60])) from None


def _closed(points: list[tuple[float, ...]]) -> bool:
    return len(points) > 3 and points[0] == points[-1]


def text_of(data: bytes, name: str, told: str = "gb18030") -> str:
    """The text of a file in UTF-8, in UTF-16 with its mark, or in the given encoding.

    Raises:
        InputError: for any other encoding.
    """
    data = data.rstrip(b"\x1a")  # with which DOS ends a text
    texts = readings(data, (told,))
    for text in texts:
        if data.startswith(codecs.BOM_UTF8) or text.isascii() or max(text) >= THREE_BYTES:
            return text
        return next(texts, text)
    raise InputError(_("{file} is no text in UTF-8, UTF-16 or GB18030").format(file=name))


def geojson_file(data: bytes, name: str) -> RawFile:
    """The lines and the outer edges of polygons of a GeoJSON file: longitudes and latitudes.

    Raises:
        InputError: for what is not GeoJSON.
    """
    try:
        whole = json.loads(text_of(data, name))
    except (ValueError, RecursionError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(_("{file} is not JSON").format(file=name)) from None
    passed: list[str] = []
    try:
        lines = list(_lines(whole, "", 0, passed))
        said = whole.get("crs")
        crs = code_of(said["properties"]["name"]) if said else None
        code = f"EPSG:{crs}" if crs not in (None, 4326) else None
        return RawFile(lines, True, "m", passed_over(passed), crs=code)
    except (TypeError, ValueError, KeyError, IndexError, AttributeError, OverflowError):
        raise InputError(_("{file} is not GeoJSON as RFC 7946 has it").format(file=name)) from None


def _lines(node: Any, name: str, depth: int, passed: list[str]) -> Iterator[RawLine]:
    """The lines of a GeoJSON object with their features' names; others go to `passed`."""
    if depth > MOST_DEPTH:
        raise ValueError
    kind = node["type"]
    if kind in ("FeatureCollection", "GeometryCollection"):
        for inner in node["features" if kind == "FeatureCollection" else "geometries"]:
            yield from _lines(inner, name, depth + 1, passed)
    elif kind == "Feature":
        about = node.get("properties") or {}
        called = next((about[key] for key in ("layer", "name") if about.get(key)), node.get("id", name))
        if node.get("geometry"):
            yield from _lines(node["geometry"], str(called), depth + 1, passed)
    elif kind in LINES:
        depth, ring = LINES[kind]
        for points in _each(node["coordinates"], depth, ring):
            yield RawLine(name, points, ring or _closed(points))
        if ring:
            polygons = node["coordinates"] if depth else [node["coordinates"]]
            passed += [_("inner edge")] * sum(len(rings) - 1 for rings in polygons)
    else:
        passed.append(str(kind)[:40])


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
