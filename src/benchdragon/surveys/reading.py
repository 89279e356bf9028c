"""A line of a file, in metres near the dance: any format, any coordinates."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchdragon.errors import InputError, reason
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line
from benchdragon.model.obstacle import MOST_CORNERS as MOST_EDGES
from benchdragon.surveys.alignment import GAP
from benchdragon.surveys.coordinates import UNITS, Survey, code_of, system_of, taken_near
from benchdragon.surveys.dxf_format import dxf_file
from benchdragon.surveys.lines import (
    FLATTENED,
    MOST_BYTES,
    MOST_CORNERS,
    MOST_LINES,
    DrawnLine,
    chained,
    corners_of,
    once,
)
from benchdragon.surveys.raw import RawCurve, RawFile, RawLine, place_text
from benchdragon.surveys.svg_format import svg_file
from benchdragon.surveys.text_formats import csv_file, geojson_file
from benchdragon.surveys.xml_formats import gpx_file, kml_file, kmz_file, landxml_file, xml_tree

Reader = Callable[[bytes, str], RawFile]
# By the ending of a file.
READERS: dict[str, Reader] = {
    ".csv": csv_file,
    ".geojson": geojson_file,
    ".json": geojson_file,
    ".kml": kml_file,
    ".kmz": kmz_file,
    ".gpx": gpx_file,
    ".xml": landxml_file,
    ".landxml": landxml_file,
}
ENDINGS = (*READERS, ".dxf", ".svg")
# A listener for notes on a file while it is read, a sentence at a time.
Tell = Callable[[str], object]
# A degree of latitude or longitude is at most so long, m, where it is shown in GCJ-02 too.
METRES_A_DEGREE = 112_000.0
# Tighter bends, m, are input errors.
LEAST_RADIUS = 1e-6
# Ends of an arc that is no whole circle lie farther apart than rounding alone would have them, m.
LEAST_CHORD = 1e-3
# A surveyed part keeps so near, m and as a share, to the length and the end that the file says of it.
MISFIT, MISFIT_SHARE = 0.05, 0.01
# Northings of China, and its eastings, with the number of a zone before them and without, m.
NORTHINGS, EASTINGS = (1.5e6, 6.5e6), ((1.3e7, 4.6e7), (1e5, 9e5))
# Lines of a file that are named in an error.
MOST_NAMES = 10


def _untold(_sentence: str) -> None:
    """A listener that ignores all notes."""


def read_lines(path: Path, survey: Survey, tell: Tell = _untold) -> tuple[list[DrawnLine], Survey]:
    """The lines of a file, in metres near the dance, and the survey with its origin.

    `tell` hears, a sentence at a time, what of the file was passed over.

    Raises:
        InputError: for a file that cannot be read, and for a unit or a system that is missing.
        MissingExtraError: for a format or a system that needs the extra `survey`.
    """
    raw = _raw(path, survey)
    over = ", ".join(raw.passed)
    points = [point for line in raw.lines for point in _places(line)]
    if not points:
        raise InputError(
            _("{file} holds no line; passed over: {over}").format(file=path.name, over=over)
            if over
            else _("{file} holds no line").format(file=path.name)
        )
    if over:
        tell(_("{file}: passed over: {over}").format(file=path.name, over=over))
    if len(raw.lines) > MOST_LINES:
        text = _("{file} holds {count} lines, and {most} are read at most")
        raise InputError(text.format(file=path.name, count=len(raw.lines), most=MOST_LINES))
    if len(points) > MOST_CORNERS:
        text = _("{file} holds {count} points, and {most} are read at most")
        raise InputError(text.format(file=path.name, count=len(points), most=MOST_CORNERS))
    _check_told(raw, survey, path.name, tell)
    near, known = taken_near(points, survey, path.name, raw.angular, raw.unit)
    scale = _scale(survey, raw.unit)
    angular = survey.crs is not None and system_of(survey.crs).angular
    found, first = [], 0
    for line in raw.lines:
        count = len(_places(line))
        try:
            found.append(_drawn(line, near[first : first + count], scale, angular, tell))
        except InputError as error:
            raise InputError(f"{path.name}: {error}") from None
        first += count
    return found, known


def _check_told(raw: RawFile, survey: Survey, name: str, tell: Tell) -> None:
    """Raise InputError if the coordinate system of a file is not that of the plan."""
    if raw.crs is not None and (survey.crs is None or code_of(survey.crs) != code_of(raw.crs)):
        text = _('{file} says that its coordinates are those of {said}: set survey.crs to "{said}"')
        raise InputError(text.format(file=name, said=raw.crs))
    points = np.array([point for line in raw.lines for point in _places(line)])
    low, high = points.min(axis=0), points.max(axis=0)
    metres = (survey.unit or raw.unit) == "m" and survey.crs is None
    northwards = NORTHINGS[0] <= low[0] <= high[0] <= NORTHINGS[1]
    eastwards = any(west <= low[1] <= high[1] <= east for west, east in EASTINGS)
    if raw.unclear and metres and northwards and eastwards:
        text = _(
            "{file}: do x = {x} and y = {y} say north and east, as surveyors in China write them? "
            "Name the columns east and north, exchange x and y in the file, or set survey.crs"
        )
        raise InputError(text.format(file=name, x=f"{points[0, 0]:.12g}", y=f"{points[0, 1]:.12g}"))
    if raw.says_unit and raw.unit and survey.unit and raw.unit != survey.unit:
        text = _("{file} says that its unit is {said}, and survey.unit says {unit}, which was taken")
        tell(text.format(file=name, said=raw.unit, unit=survey.unit))


def _raw(path: Path, survey: Survey) -> RawFile:
    ending = path.suffix.lower()
    if ending == ".dwg":
        text = _("{file} is a binary drawing: save it as DXF in text (ASCII)")
        raise InputError(text.format(file=path.name))
    if ending not in ENDINGS:
        text = _("{file}: drawings are read from {endings} files")
        raise InputError(text.format(file=path.name, endings=", ".join(ENDINGS)))
    data = _bytes(path)

    def fineness(unit: str | None) -> float:
        return FLATTENED / _scale(survey, unit)

    if ending == ".dxf":
        return dxf_file(data, path.name, fineness)
    if ending == ".svg":
        return svg_file(data, path.name, fineness, physical=survey.unit is None)
    if ending == ".xml" and (kind := xml_tree(data, path.name).tag) in ("kml", "gpx"):
        return READERS[f".{kind}"](data, path.name)
    return READERS[ending](data, path.name)


def _bytes(path: Path) -> bytes:
    try:
        if not path.is_file():
            raise InputError(_("there is no file {file} beside the plan").format(file=path.name))
        size = path.stat().st_size
        if size > MOST_BYTES:
            text = _("{file} is too large: {size} MB, at most {most} MB are read")
            raise InputError(
                text.format(file=path.name, size=size // 1_000_000, most=MOST_BYTES // 1_000_000)
            )
        return path.read_bytes()
    except OSError as error:
        raise InputError(f"{path.name}: {reason(error)}") from None


def _places(line: RawLine) -> list[tuple[float, float]]:
    """Every point of a line for which coordinates must be found."""
    if not line.curves:
        return [(point[0], point[1]) for point in line.points]
    return [
        point for curve in line.curves for point in (curve.start, curve.end, curve.third or curve.end)
    ]


def _scale(survey: Survey, said: str | None) -> float:
    """What one unit of lengths in a file is worth at most, m; `said` is the unit that it tells."""
    system = None if survey.crs is None else system_of(survey.crs)
    if system is not None and system.angular:
        return METRES_A_DEGREE
    if system is not None and system.unit is not None and survey.unit is None:
        return float(system.unit)
    unit = survey.unit or said
    return float(UNITS[unit]) if unit else 1.0


def _drawn(line: RawLine, near: FloatArray, scale: float, angular: bool, tell: Tell) -> DrawnLine:
    if line.curves:
        if angular:
            raise InputError(_("alignments are read in metres, not in longitudes and latitudes"))
        curves = []
        for n, curve in enumerate(line.curves):
            named = _("part {number} of {line}, at {place}").format(
                number=n + 1, line=repr(line.name)[:60], place=place_text(curve.start)
            )
            made = _curve(curve, near[3 * n : 3 * n + 3], scale)
            if made is None:
                tell(_("{part} has no length and was passed over").format(part=named))
            else:
                _check_curve(curve, made, near[3 * n + 1], scale, named)
                curves.append(made)
        return DrawnLine(line.name, np.zeros((0, 3)), tuple(curves))
    bulges = np.array([point[2] if len(point) > 2 else 0.0 for point in line.points])
    if angular and bulges.any():
        raise InputError(
            _("arcs are read in metres, not in longitudes and latitudes: save them as polylines")
        )
    corners = corners_of(np.column_stack([near, bulges]), line.closed)
    return DrawnLine(line.name, corners, (), line.closed, line.off * scale, line.hidden)


def _check_curve(curve: RawCurve, made: AnyCurve, end: FloatArray, scale: float, named: str) -> None:
    """Refuse a surveyed part of which the file says two things."""
    said = made.length if curve.length is None else curve.length * scale
    if abs(made.length - said) > MISFIT + MISFIT_SHARE * said:
        text = _("{part}: the file says that it is {said} m long, and its points make it {length} m")
        raise InputError(text.format(part=named, said=f"{said:.6g}", length=f"{made.length:.6g}"))
    if (off := math.dist(made.end_pose[0], end)) > MISFIT:
        text = _("{part}: it ends {off} m beside its End")
        raise InputError(text.format(part=named, off=f"{off:.4g}"))


def _curve(curve: RawCurve, places: FloatArray, scale: float) -> AnyCurve | None:
    """A surveyed curve from its start and other points; None for one without a length."""
    start, end, third = places
    at = float(start[0]), float(start[1])
    side = 1.0 if curve.left else -1.0
    chord, said = math.dist(start, end), curve.length
    if curve.kind == "line":
        return Line(chord, at, _direction(start, end)) if chord > 0.0 else None
    if curve.kind == "arc":
        radius = math.dist(start, third)
        out, back = _direction(third, start), _direction(third, end)
        sweep = (side * (back - out)) % (2.0 * math.pi)
        if chord <= LEAST_CHORD:  # a step, or all of the circle but a step: angles tell by rounding
            if radius <= LEAST_CHORD or said is None or said * scale < math.pi * radius:
                return None
            sweep = sweep if sweep > math.pi else 2.0 * math.pi + sweep
        return Arc(radius, side * sweep, at, out + side * 0.5 * math.pi)
    if not said:
        return None
    length = said * scale
    first, last = (side * _bend(radius, scale) for radius in curve.radii)
    if curve.third is not None and math.dist(start, third) > 0.0:
        return Clothoid(length, first, last, at, _direction(start, third))
    shape = Clothoid(length, first, last)
    (x, y), _heading = shape.end_pose
    return Clothoid(length, first, last, at, _direction(start, end) - math.atan2(y, x))


def _bend(radius: float, scale: float) -> float:
    """The curvature of a radius in units of `scale` m, 1/m."""
    metres = radius * scale
    if metres < LEAST_RADIUS:
        text = _("a clothoid has a radius of {radius} m: {least} m are the least")
        raise InputError(text.format(radius=f"{metres:g}", least=f"{LEAST_RADIUS:g}"))
    return 1.0 / metres


def _direction(start: FloatArray, end: FloatArray) -> float:
    return math.atan2(end[1] - start[1], end[0] - start[0])


def read_line(
    path: Path, survey: Survey, layer: str | None = None, tell: Tell = _untold
) -> tuple[DrawnLine, Survey]:
    """The one line of a file, or of a layer of it, and the survey with its origin.

    Lines of one layer whose ends meet are joined. Lines without a length, doubled ones and, where no
    layer is asked for, those of layers that are off are passed over, as `tell` hears.

    Raises:
        InputError: as `read_lines`, and where there is no such line or more than one.
    """
    lines, known = read_lines(path, survey, tell)
    lines = _asked_for(lines, path.name, layer, tell)
    names = sorted({line.name for line in lines})
    whole = [line for line in lines if line.curves or len(line.corners) > 1]
    if short := len(lines) - len(whole):
        text = _("{file}: lines without a length, passed over: {count}")
        tell(text.format(file=path.name, count=short))
    single = once(whole)
    if doubled := len(whole) - len(single):
        text = _("{file}: lines drawn twice, passed over once: {count}")
        tell(text.format(file=path.name, count=doubled))
    lines = _joined(single)
    if len(lines) == 1:
        return lines[0], known
    if not lines:
        raise InputError(_("{file} holds no line").format(file=path.name))
    if layer is None and len(names) > 1:
        text = _("{file} holds {count} lines: choose one by the key layer: {names}")
        raise InputError(text.format(file=path.name, count=len(lines), names=_listed(names)))
    text = _("{file} holds {count} lines that do not meet within {gap} m: join them, or leave one")
    raise InputError(text.format(file=path.name, count=len(lines), gap=f"{GAP:g}"))


def _asked_for(lines: list[DrawnLine], name: str, layer: str | None, tell: Tell) -> list[DrawnLine]:
    """The lines of a layer; where none is asked for, those of layers that are not off."""
    names = sorted({line.name for line in lines})
    if layer is not None:
        found = [line for line in lines if line.name == layer]
        if not found:
            text = _("{file} has no line called {layer}; it has {names}")
            raise InputError(text.format(file=name, layer=repr(layer)[:60], names=_listed(names)))
        return found
    hidden = [line for line in lines if line.hidden]
    if not hidden:
        return lines
    if len(hidden) == len(lines):
        text = _("{file}: all of its lines are on layers that are off: choose one by the key layer")
        raise InputError(text.format(file=name))
    text = _("{file}: lines on layers that are off, passed over: {count}, on {names}")
    off = _listed(sorted({line.name for line in hidden}))
    tell(text.format(file=name, count=len(hidden), names=off))
    return [line for line in lines if not line.hidden]


def _joined(lines: Sequence[DrawnLine]) -> list[DrawnLine]:
    """Lines of one layer joined where their ends meet: what is drawn piece by piece is whole again."""
    layers: dict[str, list[DrawnLine]] = {}
    for line in lines:
        layers.setdefault(line.name, []).append(line)
    return [line for layer in layers.values() for line in chained(layer, GAP)]


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(repr(name)[:60] for name in names[:MOST_NAMES])
    return shown + (", ..." if len(names) > MOST_NAMES else "")


def outline(
    path: Path, survey: Survey, layer: str | None = None, tell: Tell = _untold
) -> tuple[FloatArray, Survey]:
    """Corners (P, 2) of the closed line of a file, m, and the survey with its origin.

    Arcs, ellipses and splines become chords within lines.FLATTENED of them. Where pieces meet with
    gaps, corners may lie up to alignment.GAP from where they were drawn.

    Raises:
        InputError: as `read_line`, for a line that is open, and for more than MOST_EDGES.
    """
    line, known = read_line(path, survey, layer, tell)
    points, _off = line.points()
    if not line.closed and len(points) and math.dist(points[0], points[-1]) <= GAP:
        points, line = points[:-1], replace(line, closed=True)
    if not line.closed:
        text = _("{file}: the boundary is open: its ends are {gap} m apart")
        raise InputError(text.format(file=path.name, gap=f"{math.dist(points[0], points[-1]):.3g}"))
    if len(points) > MOST_EDGES:
        text = _("{file}: the boundary becomes {count} corners, and {most} are the most")
        raise InputError(text.format(file=path.name, count=len(points), most=MOST_EDGES))
    if len(points) < 3:
        raise InputError(_("{file}: a boundary needs three corners at least").format(file=path.name))
    return points, known
