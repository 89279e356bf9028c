"""Lines of DXF and SVG files, as the file says them; both need the extra `survey`."""

import io
import math
import re
from collections.abc import Callable, Iterator
from typing import Any
from xml.etree.ElementTree import Element, tostring

import numpy as np

from benchdragon.errors import InputError, MissingExtraError
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.surveys.lines import MOST_CORNERS
from benchdragon.surveys.raw import RawFile, RawLine
from benchdragon.surveys.xml_formats import xml_tree

# $INSUNITS of DXF, as coordinates.UNITS calls them; others say nothing.
DXF_UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 7: "km", 21: "us-ft"}
# Elements of SVG that are drawn; links to others, which may multiply, are left out.
SVG_DRAWN = {"svg", "g", "path", "polyline", "polygon", "line", "rect", "circle", "ellipse"}
# What one unit of a width in SVG is worth, mm.
SVG_MILLIMETRES = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0}

Points = list[tuple[float, ...]]
# Of a file's own unit, None where it says none: how near chords keep to curves, in that unit.
Fineness = Callable[[str | None], float]


class Tally:
    """Counts the points that a file's curves become, so that no more are made than are read."""

    def __init__(self, name: str, within: float) -> None:
        """Args: `name` of the file; `within`: how near chords keep to curves, in its unit."""
        self.name, self.within = name, within
        self.points = 0

    def counted(self, points: FloatArray) -> FloatArray:
        """The points.

        Raises:
            InputError: if these are too many.
        """
        self.points += len(points)
        if self.points > MOST_CORNERS:
            raise InputError(
                _("{file}: its curves need more than the {most} points that are read at most").format(
                    file=self.name, most=MOST_CORNERS
                )
            )
        return points


def bezier_points(control: FloatArray, within: float) -> tuple[FloatArray, float]:
    """Points whose chords keep `within` of a Bezier curve of control points (n + 1, 2), and how near.

    Its second derivative is at most n (n - 1) times the largest second difference of its control
    points; over a span h of the parameter it keeps within an eighth of that times h^2 of the chord.
    """
    degree = len(control) - 1
    second = np.diff(control, 2, axis=0)
    most = degree * (degree - 1) * float(np.hypot(second[:, 0], second[:, 1]).max(initial=0.0))
    count = _count(most, within)
    t = np.linspace(0.0, 1.0, count + 1)[:, None]
    weights = [math.comb(degree, k) * t**k * (1.0 - t) ** (degree - k) for k in range(degree + 1)]
    points = sum((w * p for w, p in zip(weights, control, strict=True)), np.zeros((count + 1, 2)))
    return points, 0.125 * most / count**2


def ellipse_points(
    centre: FloatArray,
    one: FloatArray,
    other: FloatArray,
    start: float,
    sweep: float,
    within: float,
) -> tuple[FloatArray, float]:
    """The same of centre + cos t one + sin t other, for t from `start` over `sweep`, rad."""
    most = math.hypot(*one, *other) * sweep * sweep
    count = max(8, _count(most, within))
    t = (start + np.linspace(0.0, sweep, count + 1))[:, None]
    return centre + np.cos(t) * one + np.sin(t) * other, 0.125 * most / count**2


def _count(most: float, within: float) -> int:
    """Into how many chords a curve is cut; MOST_CORNERS are one too many for what is read."""
    if not math.isfinite(most):
        return 1
    return max(1, math.ceil(min(MOST_CORNERS, math.sqrt(0.125 * most / within))))


def dxf_file(data: bytes, name: str, fineness: Fineness) -> RawFile:
    """The lines of the model space of a DXF file, each entity by itself, by layers.

    LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE and SPLINE are read, blocks are not.

    Raises:
        InputError: for what is no DXF, for curves that cannot be read, and for too many points.
        MissingExtraError: without ezdxf.
    """
    try:
        from ezdxf.filemanagement import dxf_stream_info, read
        from ezdxf.lldxf.const import DXFError
    except ImportError:
        raise MissingExtraError("survey") from None
    try:
        # Its head is ASCII and says how the rest is written.
        told = dxf_stream_info(io.StringIO(data.decode("latin-1")))
        document = read(io.StringIO(data.decode(told.encoding, "surrogateescape")))
        entities = list(document.modelspace())
        # Of a file that does not say it, ezdxf tells a unit of its own choice.
        said = document.header.get("$INSUNITS", 0) if b"$INSUNITS" in data else 0
    except (DXFError, OSError, ValueError, LookupError, TypeError, AttributeError, StopIteration):
        raise InputError(_("{file} is not DXF").format(file=name)) from None
    unit = DXF_UNITS.get(said)
    lines, tally = [], Tally(name, fineness(unit))
    for entity in entities:
        try:
            line = _entity(entity, tally)
        except (DXFError, ArithmeticError, LookupError, TypeError, AttributeError):
            raise InputError(
                _("{file}: {what} of layer {layer} cannot be read").format(
                    file=name, what=entity.dxftype(), layer=_layer(entity)
                )
            ) from None
        if line is not None:
            lines.append(line)
    return RawFile(lines, False, unit)


def _entity(entity: Any, tally: Tally) -> RawLine | None:
    kind, layer = entity.dxftype(), _layer(entity)
    if kind == "LINE":
        return RawLine(layer, [tuple(entity.dxf.start)[:2], tuple(entity.dxf.end)[:2]])
    if kind not in ("ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "ELLIPSE", "SPLINE"):
        return None
    if kind == "ELLIPSE":
        return _ellipse(entity, layer, tally)
    if kind == "SPLINE":
        return _spline(entity, layer, tally)
    hand = _hand(entity, tally.name)
    if kind == "LWPOLYLINE":
        corners = [(hand * x, y, hand * b) for x, y, b in entity.get_points("xyb")]
        return RawLine(layer, corners, bool(entity.closed))
    if kind == "POLYLINE":
        corners = [
            (hand * v.dxf.location.x, v.dxf.location.y, hand * v.dxf.get("bulge", 0.0))
            for v in entity.vertices
        ]
        return RawLine(layer, corners, bool(entity.is_closed)) if entity.is_2d_polyline else None
    x, y, r = entity.dxf.center.x, entity.dxf.center.y, entity.dxf.radius
    if kind == "CIRCLE":
        return RawLine(layer, [(hand * (x + r), y, hand), (hand * (x - r), y, hand)], True)
    start = math.radians(entity.dxf.start_angle)
    sweep = math.radians((entity.dxf.end_angle - entity.dxf.start_angle) % 360.0 or 360.0)
    ends = [(x + r * math.cos(a), y + r * math.sin(a)) for a in (start, start + sweep)]
    (x0, y0), (x1, y1) = ends
    return RawLine(layer, [(hand * x0, y0, hand * math.tan(0.25 * sweep)), (hand * x1, y1, 0.0)])


def _layer(entity: Any) -> str:
    return str(entity.dxf.layer) if entity.dxf.is_supported("layer") else ""


def _hand(entity: Any, name: str) -> float:
    """-1 for what is drawn on the plane as seen from below, where x runs to the left."""
    x, y, z = entity.dxf.extrusion
    if math.hypot(x, y) > 1e-9:
        raise InputError(
            _("{file}: {what} of layer {layer} does not lie in the plane of x and y").format(
                file=name, what=entity.dxftype(), layer=_layer(entity)
            )
        )
    return math.copysign(1.0, z)


def _ellipse(entity: Any, layer: str, tally: Tally) -> RawLine:
    tool = entity.construction_tool()
    centre, one, other = (np.array([v.x, v.y]) for v in (tool.center, tool.major_axis, tool.minor_axis))
    sweep = (tool.end_param - tool.start_param) % (2.0 * math.pi) or 2.0 * math.pi
    points, off = ellipse_points(centre, one, other, tool.start_param, sweep, tally.within)
    tally.counted(points)
    whole = sweep > 2.0 * math.pi - 1e-9
    return RawLine(layer, _pairs(points[:-1] if whole else points), whole, off=off)


def _spline(entity: Any, layer: str, tally: Tally) -> RawLine:
    tool = entity.construction_tool()
    if tool.is_rational:
        raise InputError(
            _("{file}: a spline of layer {layer} has weights: convert it to a polyline first").format(
                file=tally.name, layer=layer
            )
        )
    found: list[FloatArray] = []
    off = 0.0
    for control in tool.bezier_decomposition():
        points, away = bezier_points(np.array([(v.x, v.y) for v in control]), tally.within)
        found.append(tally.counted(points))
        off = max(off, away)
    return RawLine(layer, _pairs(np.concatenate(found)), bool(entity.closed), off=off)


def _pairs(points: FloatArray) -> Points:
    return [(x, y) for x, y in points.tolist()]


def svg_file(data: bytes, name: str, fineness: Fineness, physical: bool) -> RawFile:
    """The paths of an SVG file, y turned up, (0, 0) its upper left corner; each is called by its id.

    Args:
        data: the file.
        name: of it.
        fineness: how near chords keep to curves.
        physical: whether its width in mm or the like and its viewBox tell the unit.

    Raises:
        InputError: for what is no SVG, and for too many points.
        MissingExtraError: without svgelements.
    """
    try:
        from svgelements import SVG, Path, Shape
    except ImportError:
        raise MissingExtraError("survey") from None
    root = xml_tree(data, name)
    if root.tag != "svg":
        raise InputError(_("{file} is not SVG").format(file=name))
    scale = _millimetres(root) if physical else None
    for key in ("width", "height", "viewBox", "preserveAspectRatio"):
        root.attrib.pop(key, None)
    _keep_drawn(root)
    root.set("xmlns", "http://www.w3.org/2000/svg")
    unit = None if scale is None else "mm"
    lines: list[RawLine] = []
    tally = Tally(name, fineness(unit) / (scale or 1.0))
    try:
        for shape in SVG.parse(io.BytesIO(tostring(root)), reify=True).elements():
            if isinstance(shape, Shape):
                lines += _subpaths(Path(shape), shape.id or "", scale or 1.0, tally)
    except InputError:
        raise
    except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError):
        raise InputError(_("{file}: a path cannot be read").format(file=name)) from None
    return RawFile(lines, False, unit)


def _keep_drawn(element: Element) -> None:
    for inner in list(element):
        if inner.tag in SVG_DRAWN:
            _keep_drawn(inner)
        else:
            element.remove(inner)


def _millimetres(root: Element) -> float | None:
    """What one unit of the drawing is worth, mm, where its width and its viewBox say it."""
    width = re.fullmatch(r"\s*([0-9.]+(?:[eE][-+]?\d+)?)\s*([a-z]+)\s*", root.get("width", ""))
    box = root.get("viewBox", "").replace(",", " ").split()
    try:
        if width is None or len(box) != 4:
            return None
        scale = float(width[1]) * SVG_MILLIMETRES[width[2]] / float(box[2])
    except (ValueError, KeyError, ZeroDivisionError):
        return None
    return scale if math.isfinite(scale) and scale > 0.0 else None


def _subpaths(path: Any, name: str, scale: float, tally: Tally) -> Iterator[RawLine]:
    for sub in path.as_subpaths():
        points: list[FloatArray] = []
        off, closed = 0.0, False
        for segment in sub:
            more, away = _segment(segment, tally.within)
            points.append(tally.counted(more))
            off, closed = max(off, away), closed or type(segment).__name__ == "Close"
        whole = np.concatenate(points) * (scale, -scale) if points else np.zeros((0, 2))
        if len(whole):
            yield RawLine(name, _pairs(whole), closed, off=off * scale)


def _segment(segment: Any, within: float) -> tuple[FloatArray, float]:
    """Points of a segment of a path, (P, 2), and how far it lies from their chords."""
    kind = type(segment).__name__
    if kind in ("Move", "Line", "Close"):
        return np.zeros((0, 2)) if segment.end is None else _xy(segment.end), 0.0
    if kind == "Arc":
        centre = _xy(segment.center)
        return ellipse_points(
            centre[0], (_xy(segment.prx) - centre)[0], (_xy(segment.pry) - centre)[0],
            segment.get_start_t(), float(segment.sweep), within,
        )  # fmt: skip
    controls = [segment.start, segment.control if kind == "QuadraticBezier" else segment.control1]
    controls += [] if kind == "QuadraticBezier" else [segment.control2]
    return bezier_points(np.concatenate([_xy(point) for point in (*controls, segment.end)]), within)


def _xy(point: Any) -> FloatArray:
    return np.array([[float(point.x), float(point.y)]])
