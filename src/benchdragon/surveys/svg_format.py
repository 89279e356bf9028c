"""Lines of SVG files, as the file says them; they need the extra `survey`."""

import io
import math
import re
from collections.abc import Iterator
from typing import Any
from xml.etree.ElementTree import Element, tostring

import numpy as np

from benchdragon.errors import InputError, brought_by
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.surveys.flattening import Fineness, Tally, bezier_points, ellipse_points, pairs
from benchdragon.surveys.raw import RawFile, RawLine, passed_over
from benchdragon.surveys.xml_formats import xml_tree

# Elements of SVG that are drawn; links to others, which may multiply, are left out.
SVG_DRAWN = {"path", "polyline", "polygon", "line", "rect", "circle", "ellipse"}
SVG_GROUPS = {"svg", "g", "a", "switch"}
# Visible elements of SVG that are not read.
SVG_SHOWN = {"use", "text", "image", "foreignObject"}
SVG_HIDDEN = re.compile(r"(?:^|;)\s*(?:display\s*:\s*none|visibility\s*:\s*(?:hidden|collapse))\b")
# How many numbers each command of a path takes; a number; those of an arc, whose flags may be joined.
SVG_COMMANDS = {"M": 2, "L": 2, "T": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "A": 7, "Z": 0}
SVG_NUMBER = r"[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?+"
SVG_ARC = re.compile(
    rf"(?:[\s,]*{SVG_NUMBER}[\s,]*{SVG_NUMBER}[\s,]*{SVG_NUMBER}[\s,]*[01][\s,]*[01]"
    rf"[\s,]*{SVG_NUMBER}[\s,]*{SVG_NUMBER})++[\s,]*"
)
SVG_NUMBERS = re.compile(rf"[\s,]*(?:{SVG_NUMBER}[\s,]*+)*+")
# Steps of a transform, and how many numbers each may have.
SVG_STEP = re.compile(r"(?<![\s,])[\s,]*+(matrix|translate|scale|rotate|skewX|skewY)\s*+\(([^()]*+)\)")
SVG_STEPS = {"matrix": (6,), "translate": (1, 2), "scale": (1, 2), "rotate": (1, 3)}
SVG_SIZES = {"x", "y", "width", "height", "cx", "cy", "r", "rx", "ry", "x1", "y1", "x2", "y2"}
# What one unit of a width in SVG is worth, mm.
SVG_MILLIMETRES = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0}

# Widths and heights are rounded by so much, as a share.
SVG_SAME = 2e-3


def svg_file(data: bytes, name: str, fineness: Fineness, physical: bool) -> RawFile:
    """The paths of an SVG file, y turned up, (0, 0) its upper left corner; each is called by its id.

    Args:
        data: the file.
        name: of it.
        fineness: how near chords keep to curves.
        physical: whether its width in mm or the like and its viewBox tell the unit.

    Raises:
        InputError: for invalid SVG, and for too many points.
        MissingExtraError: without svgelements.
    """
    with brought_by("survey"):
        from svgelements import SVG, Path, Shape
    root = xml_tree(data, name)
    if root.tag != "svg":
        raise InputError(_("{file} is not SVG").format(file=name))
    scale = _millimetres(root, name) if physical else None
    passed: list[str] = []
    _keep_drawn(root, name, passed, _box(root) is not None)
    _undo_scale(root)
    root.set("xmlns", "http://www.w3.org/2000/svg")
    unit = None if scale is None else "mm"
    lines: list[RawLine] = []
    tally = Tally(name, fineness(unit) / (scale or 1.0))
    try:
        # Turned and stretched by us: svgelements takes slanted ellipses for upright ones.
        for shape in SVG.parse(io.BytesIO(tostring(root)), reify=False).elements():
            if isinstance(shape, Shape):
                path, way = Path(*shape.segments(transformed=False)), shape.transform
                matrix = np.array([[way.a, way.c, way.e], [way.b, way.d, way.f]])
                lines += _subpaths(path, matrix, shape.id or "", scale or 1.0, tally)
    except InputError:
        raise
    except Exception:  # whatever a library makes of what strangers send
        raise InputError(_("{file}: a path cannot be read").format(file=name)) from None
    return RawFile(lines, False, unit, passed_over(passed))


def _keep_drawn(element: Element, name: str, passed: list[str], sized: bool) -> None:
    """Leave in an element what is drawn alone, checked; what else shows, or is hidden, is passed over.

    Of a <switch> the first element without conditions is drawn. `sized`: percentages have a meaning.
    """
    drawn = False
    for inner in list(element):
        asked = inner.get("requiredExtensions") is not None or inner.get("systemLanguage") is not None
        if inner.tag not in SVG_DRAWN | SVG_GROUPS or (element.tag == "switch" and (asked or drawn)):
            passed += [f"<{inner.tag}>"] if inner.tag in SVG_SHOWN and element.tag != "switch" else []
            element.remove(inner)
        elif _is_hidden(inner):
            shapes = sum(one.tag in SVG_DRAWN for one in inner.iter())
            passed += [_("hidden line")] * shapes
            element.remove(inner)
        else:
            drawn = True
            _check_element(inner, name, sized)
            _keep_drawn(inner, name, passed, sized)
    if element.tag in ("switch", "a"):
        element.tag = "g"


def _is_hidden(element: Element) -> bool:
    shown = (f"{key}:{element.get(key, '')}" for key in ("display", "visibility"))
    return bool(SVG_HIDDEN.search(";".join([element.get("style", ""), *shown])))


def _check_element(element: Element, name: str, sized: bool) -> None:
    """Refuse what svgelements would read up to the first fault, and leave the rest out."""
    steps, asked = element.get("transform", ""), None
    for step in SVG_STEP.finditer(steps):
        count = len(re.findall(SVG_NUMBER, step[2]))
        asked = asked if count in SVG_STEPS.get(step[1], (1,)) else step[0]
    about = "transform-origin" in f"{list(element.attrib)}{element.get('style', '')}"
    if SVG_STEP.sub("", steps).strip() or (about and steps):
        asked = steps
    path = element.get("d", "") if element.tag == "path" else ""
    points = element.get("points", "") if element.tag in ("polyline", "polygon") else ""
    if points.strip() and not _has_numbers(points, 2):
        asked = points
    first, *pieces = re.split(r"([MmZzLlHhVvCcSsQqTtAa])", path)
    if first.strip() or (pieces and pieces[0] not in "Mm"):
        asked = path
    for command, sizes in zip(pieces[::2], pieces[1::2], strict=True):
        asked = asked if _has_numbers(sizes, SVG_COMMANDS[command.upper()]) else command + sizes
    if not sized:
        asked = next((v for k, v in element.items() if k in SVG_SIZES and "%" in v), asked)
    if asked is not None:
        raise InputError(
            _("{file}: <{what}> {name} cannot be read: {text}").format(
                file=name, what=element.tag, name=element.get("id", ""), text=repr(asked.strip())[:60]
            )
        )


def _has_numbers(text: str, count: int) -> bool:
    """Whether a text holds numbers alone, `count` of them or a multiple of it, and for 0 none."""
    if count == SVG_COMMANDS["A"]:
        return SVG_ARC.fullmatch(text) is not None
    if SVG_NUMBERS.fullmatch(text) is None:
        return False
    found = len(re.findall(SVG_NUMBER, text))
    return found % count == 0 and found > 0 if count else found == 0


def _box(root: Element) -> tuple[float, float] | None:
    """Width and height of a drawing in its own units, where its viewBox tells them."""
    try:
        box = [float(word) for word in root.get("viewBox", "").replace(",", " ").split()]
    except ValueError:
        return None
    sound = len(box) == 4 and all(map(math.isfinite, box)) and min(box[2:]) > 0.0
    return (box[2], box[3]) if sound else None


def _undo_scale(root: Element) -> None:
    """Have a drawing read in its own units: no width in millimetres, and no viewBox, moves it."""
    box = _box(root)
    for key in ("width", "height", "viewBox", "preserveAspectRatio", "x", "y"):
        root.attrib.pop(key, None)
    if box is not None:  # of which percentages are
        width, height = map(repr, box)
        root.attrib.update(width=width, height=height, viewBox=f"0 0 {width} {height}")


def _millimetres(root: Element, name: str) -> float | None:
    """One unit of the drawing, mm, from size and viewBox; InputError if x and y differ."""
    box = _box(root)
    wide, high = (_physical(root.get(key, "")) for key in ("width", "height"))
    if box is None or wide is None:
        return None
    across = wide / box[0]
    up = across if high is None else high / box[1]
    if abs(across - up) <= SVG_SAME * across:
        return across
    fitted = root.get("preserveAspectRatio", "").split()
    if fitted[:1] == ["none"]:
        text = _("{file}: its width, height and viewBox stretch the drawing: save it with equal scales")
        raise InputError(text.format(file=name))
    return max(across, up) if "slice" in fitted else min(across, up)


def _physical(text: str) -> float | None:
    """A width or height, mm; None of one that is not in mm, cm, in, pt or pc."""
    found = re.fullmatch(r"\s*([0-9.]+(?:[eE][-+]?\d+)?)\s*([a-z]+)\s*", text)
    try:
        size = float(found[1]) * SVG_MILLIMETRES[found[2]] if found else 0.0
    except (ValueError, KeyError):
        return None
    return size if 0.0 < size < math.inf else None


def _subpaths(
    path: Any, matrix: FloatArray, name: str, scale: float, tally: Tally
) -> Iterator[RawLine]:
    for sub in path.as_subpaths():
        points: list[FloatArray] = []
        off, closed = 0.0, False
        for segment in sub:
            if not points and type(segment).__name__ != "Move":  # it goes on where a z went back to
                points.append(_placed(matrix, segment.start))
            more, away = _segment(segment, matrix, tally.within)
            points.append(tally.counted(more))
            off, closed = max(off, away), closed or type(segment).__name__ == "Close"
        whole = np.concatenate(points) * (scale, -scale) if points else np.zeros((0, 2))
        if len(whole):
            yield RawLine(name, pairs(whole), closed, off=off * scale)


def _segment(segment: Any, matrix: FloatArray, within: float) -> tuple[FloatArray, float]:
    """Points of a segment of a path, (P, 2), and how far it lies from their chords."""
    kind = type(segment).__name__
    # An arc without a radius is a straight line, and one that ends where it starts is nothing.
    if kind == "Arc" and min(segment.rx, segment.ry) > 0.0 and segment.start != segment.end:
        centre, one, other = _placed(matrix, segment.center, segment.prx, segment.pry)
        return ellipse_points(
            centre, one - centre, other - centre, segment.get_start_t(), float(segment.sweep), within
        )
    if kind in ("Move", "Line", "Close", "Arc"):
        return np.zeros((0, 2)) if segment.end is None else _placed(matrix, segment.end), 0.0
    controls = [segment.start, segment.control if kind == "QuadraticBezier" else segment.control1]
    controls += [] if kind == "QuadraticBezier" else [segment.control2]
    return bezier_points(_placed(matrix, *controls, segment.end), within)


def _placed(matrix: FloatArray, *places: Any) -> FloatArray:
    """Points of a path where its transform puts them, (P, 2)."""
    given = np.array([(float(place.x), float(place.y)) for place in places])
    return np.asarray(given @ matrix[:, :2].T + matrix[:, 2])
