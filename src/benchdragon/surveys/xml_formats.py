"""Lines of KML and LandXML files, as the file says them; and XML as strangers may send it."""

import math
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.surveys.raw import RawCurve, RawFile, RawLine

# Elements within elements.
MOST_DEPTH = 200
# Linear units of LandXML, as coordinates.UNITS calls them.
LANDXML_UNITS = {
    "meter": "m",
    "millimeter": "mm",
    "centimeter": "cm",
    "kilometer": "km",
    "foot": "ft",
    "inch": "in",
    "ussurveyfoot": "us-ft",
}


def xml_tree(data: bytes, name: str) -> Element:
    """The root of an XML text, names without their namespaces.

    No document type, hence no entity, is read, and nothing is fetched.

    Raises:
        InputError: for what is no XML, declares a document type, or is nested too deeply.
    """
    builder = TreeBuilder()
    parser = expat.ParserCreate(namespace_separator="}")
    depth = 0

    def refuse(*_declared: object) -> None:
        raise InputError(_("{file} declares a document type, which is not read").format(file=name))

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > MOST_DEPTH:
            raise InputError(_("{file} is nested too deeply").format(file=name))
        builder.start(tag.rpartition("}")[2], attributes)

    def end(tag: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(tag.rpartition("}")[2])

    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = builder.data
    parser.buffer_text = True
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise InputError(
            _("{file} is not XML: line {line}, column {column}").format(
                file=name, line=error.lineno, column=error.offset + 1
            )
        ) from None
    except (LookupError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(_("{file} is not XML in a known encoding").format(file=name)) from None
    return builder.close()


def kml_file(data: bytes, name: str) -> RawFile:
    """The lines and the outer edges of polygons of a KML file: longitudes and latitudes.

    Raises:
        InputError: for what is no KML.
    """
    root = xml_tree(data, name)
    places = list(root.iter("Placemark"))
    if root.tag != "kml":
        raise InputError(_("{file} is not KML").format(file=name))
    lines = []
    for place in places:
        called = (place.findtext("name") or "").strip()
        for line in place.iter("LineString"):
            points = _positions(line.findtext("coordinates") or "", name)
            lines.append(RawLine(called, points, len(points) > 3 and points[0] == points[-1]))
        for polygon in place.iter("Polygon"):
            ring = polygon.findtext("outerBoundaryIs/LinearRing/coordinates") or ""
            lines.append(RawLine(called, _positions(ring, name), True))
    return RawFile(lines, True, "m")


def _positions(text: str, name: str) -> list[tuple[float, ...]]:
    """Longitude and latitude of each of the tuples in a text."""
    found: list[tuple[float, ...]] = []
    for word in text.split():
        longitude, latitude = _numbers(word.replace(",", " "), name)[:2]
        found.append((longitude, latitude))
    return found


def _numbers(text: str, name: str) -> list[float]:
    """At least two numbers."""
    try:
        found = [float(word) for word in text.split()]
    except ValueError:
        found = []
    if len(found) < 2:
        raise InputError(
            _("{file}: wanted numbers, not {text}").format(file=name, text=repr(text.strip())[:60])
        )
    return found


def landxml_file(data: bytes, name: str) -> RawFile:
    """The alignments of a LandXML file: lines, arcs and clothoids by their points.

    Raises:
        InputError: for what is no LandXML, and for curves other than these.
    """
    root = xml_tree(data, name)
    if root.tag != "LandXML":
        raise InputError(_("{file} is not LandXML").format(file=name))
    said = next((units.get("linearUnit") for units in root.findall("Units/*")), None)
    unit = None if said is None else LANDXML_UNITS.get(said.lower())
    points = {point.get("name", ""): point.text or "" for point in root.iter("CgPoint") if point.text}
    lines = []
    for alignment in root.iter("Alignment"):
        geometry = alignment.find("CoordGeom")
        if geometry is not None:
            curves = [_curve(element, points, name) for element in geometry if element.tag != "Feature"]
            lines.append(RawLine(alignment.get("name", ""), curves=curves))
    return RawFile(lines, False, unit)


def _place(element: Element, tag: str, points: dict[str, str], name: str) -> tuple[float, float] | None:
    """x and y of a point of an element: the file says north, then east."""
    found = element.find(tag)
    if found is None:
        return None
    text = points.get(found.get("pntRef", ""), "") if found.get("pntRef") else found.text or ""
    north, east = _numbers(text, name)[:2]
    return east, north


def _curve(element: Element, points: dict[str, str], name: str) -> RawCurve:
    kinds = {"Line": "line", "Curve": "arc", "Spiral": "clothoid"}
    spiral = element.get("spiType", "clothoid").lower()
    if element.tag not in kinds or spiral != "clothoid":
        raise InputError(
            _("{file}: an alignment may hold lines, arcs and clothoids, not {what}").format(
                file=name, what=element.tag if element.tag not in kinds else spiral
            )
        )
    start, end = (_place(element, tag, points, name) for tag in ("Start", "End"))
    third = _place(element, "Center" if element.tag == "Curve" else "PI", points, name)
    left = element.get("rot", "cw").lower() == "ccw"
    if start is None or end is None or (element.tag == "Curve" and third is None):
        raise InputError(
            _("{file}: each {what} of an alignment needs Start, End, and an arc its Center").format(
                file=name, what=element.tag
            )
        )
    if element.tag != "Spiral":
        return RawCurve(kinds[element.tag], start, end, third, left)
    sizes = [_size(element, key, name) for key in ("length", "radiusStart", "radiusEnd")]
    return RawCurve("clothoid", start, end, third, left, sizes[0], (sizes[1], sizes[2]))


def _size(element: Element, key: str, name: str) -> float:
    """A length or radius of a spiral; INF is infinite."""
    text = element.get(key, "")
    try:
        value = abs(float(text))
    except ValueError:
        value = math.nan
    if math.isnan(value) or (key == "length" and not 0.0 < value < math.inf) or value == 0.0:
        raise InputError(
            _("{file}: {key} of a spiral must be a positive number, not {value}").format(
                file=name, key=key, value=repr(text)[:40]
            )
        )
    return value
