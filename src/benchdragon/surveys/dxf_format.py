"""Lines of DXF files, as the file says them; they need the extra `survey`."""

import io
import logging
import math
import re
from dataclasses import replace
from typing import Any

import numpy as np

from benchdragon.errors import InputError, brought_by
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.surveys.flattening import Fineness, Tally, bezier_points, ellipse_points, pairs
from benchdragon.surveys.raw import RawFile, RawLine, passed_over, place_text
from benchdragon.surveys.text_formats import text_of

# $INSUNITS of DXF, as coordinates.UNITS calls them; others are refused.
DXF_UNITS = {
    1: "in", 2: "ft", 3: "mi", 4: "mm", 5: "cm", 6: "m", 7: "km", 9: "mil", 10: "yd", 13: "um",
    14: "dm", 15: "dam", 16: "hm", 21: "us-ft", 22: "us-in", 23: "us-yd", 24: "us-mi",
}  # fmt: skip
DXF_READ = ("LINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE")
# What files begin with that are drawings of CAD programs, and not DXF as text.
BINARY, DWG = b"AutoCAD Binary DXF", b"AC1"
# Spaces behind a line of DXF, and its end as Windows and old Macs write it.
LINE_END = re.compile(r"(?<![ \t])[ \t]*+(?:\r\n|\r|\n)")
# A vertex of a fitted polyline that belongs to the frame of its spline, and is not on it.
FRAME = 16
# Arcs lack less than this of a whole circle, degrees, by rounding alone.
LEAST_OPEN = 1e-6
# The same of ellipses, rad: programs write 6.28319.
LEAST_RADIANS = 1e-5


def dxf_file(data: bytes, name: str, fineness: Fineness) -> RawFile:
    """The lines of the model space of a DXF file, each entity by itself, by layers.

    LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE and SPLINE are read, blocks are not.

    Raises:
        InputError: for invalid DXF, for curves that cannot be read, and for too many points.
        MissingExtraError: without ezdxf.
    """
    document, says_unit = _document(data, name)
    # For a file without a unit, ezdxf chooses one.
    unit = DXF_UNITS.get(document.header.get("$INSUNITS", 0)) if says_unit else None
    lines, passed, tally = [], list[str](), Tally(name, fineness(unit))
    for number, entity in enumerate(document.modelspace(), start=1):
        try:
            line = _entity(entity, tally)
        except InputError:
            raise
        except Exception:  # whatever a library makes of what strangers send
            text = _("{file}: part {number} ({what} of layer {layer}) cannot be read")
            raise InputError(
                text.format(file=name, number=number, what=entity.dxftype(), layer=_layer(entity))
            ) from None
        if line is None:
            passed.append(_not_read(entity))
            continue
        if _deep(entity):
            text = _("{what} that is not level (read as seen from above)")
            passed.append(text.format(what=entity.dxftype()))
        lines.append(replace(line, hidden=_hidden(entity, document)))
    return RawFile(lines, False, unit, passed_over(passed), says_unit=True, unclear=True)


def _document(data: bytes, name: str) -> tuple[Any, bool]:
    """What ezdxf makes of a file, whatever its line ends and its encoding, and if it says its unit."""
    with brought_by("survey"):
        from ezdxf.filemanagement import dxf_stream_info, read
    if data.startswith((BINARY, DWG)):
        said = _("{file} is a binary drawing: save it as DXF in text (ASCII)")
        raise InputError(said.format(file=name))
    try:
        # Its head is ASCII and says how the rest is written.
        told = dxf_stream_info(io.StringIO(LINE_END.sub("\n", text_of(data, name, "latin-1"))))
        try:
            text = text_of(data, name, told.encoding)
        except InputError:
            text = data.decode(told.encoding, "backslashreplace")
        text = LINE_END.sub("\n", text)
        if not text.rstrip().endswith("EOF"):
            raise InputError(_("{file} is cut off: it does not end with EOF").format(file=name))
        logging.getLogger("ezdxf").addHandler(logging.NullHandler())
        return read(io.StringIO(text)), "$INSUNITS" in text
    except InputError:
        raise
    except Exception:  # whatever a library makes of what strangers send
        raise InputError(_("{file} is not DXF").format(file=name)) from None


def _not_read(entity: Any) -> str:
    """The note on an entity that is passed over."""
    if entity.dxftype() == "INSERT":
        return _("INSERT (blocks are not read: explode them in the drawing)")
    return str(entity.dxftype())


def _deep(entity: Any) -> bool:
    """Whether heights of a line were lost when it was projected."""
    if entity.dxftype() == "LINE":
        return bool(entity.dxf.start.z != entity.dxf.end.z)
    return entity.dxftype() == "POLYLINE" and bool(entity.is_3d_polyline)


def _hidden(entity: Any, document: Any) -> bool:
    """Whether it does not show: by itself, or since its layer is off or frozen."""
    if entity.dxf.get("invisible", 0) or not document.layers.has_entry(_layer(entity)):
        return bool(entity.dxf.get("invisible", 0))
    layer = document.layers.get(_layer(entity))
    return bool(layer.is_off() or layer.is_frozen())


def _entity(entity: Any, tally: Tally) -> RawLine | None:
    kind, layer = entity.dxftype(), _layer(entity)
    if kind == "LINE":
        return RawLine(layer, [tuple(entity.dxf.start)[:2], tuple(entity.dxf.end)[:2]])
    if kind not in DXF_READ:
        return None
    if kind == "ELLIPSE":
        return _ellipse(entity, layer, tally)
    if kind == "SPLINE":
        return _spline(entity, layer, tally)
    if kind == "POLYLINE":
        return _polyline(entity, layer, tally.name)
    hand = _hand(entity, tally.name)
    if kind == "LWPOLYLINE":
        corners = [(hand * x, y, hand * b) for x, y, b in entity.get_points("xyb")]
        return RawLine(layer, corners, bool(entity.closed))
    x, y, r = entity.dxf.center.x, entity.dxf.center.y, entity.dxf.radius
    if not r >= 0.0:
        raise ValueError
    start, end = (entity.dxf.start_angle, entity.dxf.end_angle) if kind == "ARC" else (0.0, 360.0)
    if end - start >= 360.0 - LEAST_OPEN:
        return RawLine(layer, [(hand * (x + r), y, hand), (hand * (x - r), y, hand)], True)
    open_by = (start - end) % 360.0
    if not LEAST_OPEN < open_by:
        text = _(
            "{file}: an ARC of layer {layer} about {place} ends where it starts, so that it is a "
            "whole circle or nothing: draw a CIRCLE, or delete it"
        )
        raise InputError(text.format(file=tally.name, layer=layer, place=place_text((hand * x, y))))
    first, sweep = math.radians(start), math.radians(360.0 - open_by)
    ends = [(x + r * math.cos(a), y + r * math.sin(a)) for a in (first, first + sweep)]
    (x0, y0), (x1, y1) = ends
    return RawLine(layer, [(hand * x0, y0, hand * math.tan(0.25 * sweep)), (hand * x1, y1, 0.0)])


def _polyline(entity: Any, layer: str, name: str) -> RawLine | None:
    """One of two dimensions, or of three as seen from above; None for a mesh.

    Of one that was fitted the corners of its frame are left out.
    """
    if not (entity.is_2d_polyline or entity.is_3d_polyline):
        return None
    hand = _hand(entity, name) if entity.is_2d_polyline else 1.0
    vertices = [v for v in entity.vertices if not v.dxf.get("flags", 0) & FRAME]
    corners = [
        (hand * v.dxf.location.x, v.dxf.location.y, hand * v.dxf.get("bulge", 0.0)) for v in vertices
    ]
    if not corners and len(entity.vertices):
        raise ValueError
    return RawLine(layer, corners, bool(entity.is_closed))


def _layer(entity: Any) -> str:
    return str(entity.dxf.layer) if entity.dxf.is_supported("layer") else ""


def _hand(entity: Any, name: str) -> float:
    """-1 for what is drawn on the plane as seen from below, where x runs to the left."""
    x, y, z = entity.dxf.extrusion
    if math.hypot(x, y) > 1e-9:
        text = _("{file}: {what} of layer {layer} does not lie in the plane of x and y")
        raise InputError(text.format(file=name, what=entity.dxftype(), layer=_layer(entity)))
    return math.copysign(1.0, z)


def _ellipse(entity: Any, layer: str, tally: Tally) -> RawLine:
    tool = entity.construction_tool()
    centre, one, other = (np.array([v.x, v.y]) for v in (tool.center, tool.major_axis, tool.minor_axis))
    sweep = tool.end_param - tool.start_param
    whole = sweep >= 2.0 * math.pi - LEAST_RADIANS
    sweep = 2.0 * math.pi if whole else sweep % (2.0 * math.pi)
    points, off = ellipse_points(centre, one, other, tool.start_param, sweep, tally.within)
    tally.counted(points)
    return RawLine(layer, pairs(points[:-1] if whole else points), whole, off=off)


def _spline(entity: Any, layer: str, tally: Tally) -> RawLine:
    tool = entity.construction_tool()
    if tool.is_rational:
        text = _("{file}: a spline of layer {layer} has weights: convert it to a polyline first")
        raise InputError(text.format(file=tally.name, layer=layer))
    found: list[FloatArray] = []
    off = 0.0
    for control in tool.bezier_decomposition():
        points, away = bezier_points(np.array([(v.x, v.y) for v in control]), tally.within)
        found.append(tally.counted(points))
        off = max(off, away)
    return RawLine(layer, pairs(np.concatenate(found)), bool(entity.closed), off=off)
