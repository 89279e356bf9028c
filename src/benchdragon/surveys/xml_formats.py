"""Lines of KML, GPX and LandXML files, as the file says them; and XML as strangers may send it."""

import io
import math
import re
import zipfile
import zlib
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.surveys.lines import MOST_BYTES
from benchdragon.surveys.raw import RawCurve, RawFile, RawLine, passed_over, place_text

# Elements within elements.
MOST_DEPTH = 200
# Linear units of LandXML, as coordinates.UNITS calls them.
LANDXML_UNITS = {
    "meter": "m",
    "millimeter": "mm",
    "centimeter": "cm",
    "decimeter": "dm",
    "kilometer": "km",
    "foot": "ft",
    "inch": "in",
    "mile": "mi",
    "ussurveyfoot": "us-ft",
}
# Encodings that the XML parser leaves to others, and an entity that XML does not know by itself.
CHINESE = re.compile(
    rb"""\s*<\?xml[^>]*encoding\s*=\s*["'](gb2312|gbk|gb18030|big5)["']""", re.IGNORECASE
)
ENTITY = re.compile(rb"&(?!(?:amp|lt|gt|quot|apos);|#)[^\s;&<]++;")


def xml_tree(data: bytes, name: str) -> Element:
    """The root of an XML text, names without their namespaces and attributes of others left out.

    No entity is read, and nothing is fetched.

    Raises:
        InputError: for invalid XML, for entities, and for nesting that is too deep.
    """
    builder = TreeBuilder()
    parser = expat.ParserCreate(namespace_separator="}")
    depth = 0

    def declared(*_doctype: object) -> None:
        if ENTITY.search(data.replace(b"\0", b"")):  # of UTF-16, too
            text = _(
                "{file} uses entities, which are not read: save it without them (as plain SVG, not "
                "to be edited on by Illustrator)"
            )
            raise InputError(text.format(file=name))

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > MOST_DEPTH:
            raise InputError(_("{file} is nested too deeply").format(file=name))
        own = {key: value for key, value in attributes.items() if "}" not in key}
        builder.start(tag.rpartition("}")[2], own)

    def end(tag: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(tag.rpartition("}")[2])

    parser.StartDoctypeDeclHandler = declared
    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = builder.data
    parser.buffer_text = True
    try:
        told = CHINESE.match(data)
        parser.Parse(data.decode(told[1].decode("ascii")) if told else data, True)
    except expat.ExpatError as error:
        text = _("{file} is not XML: line {line}, column {column}")
        raise InputError(text.format(file=name, line=error.lineno, column=error.offset + 1)) from None
    except (LookupError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(_("{file} is not XML in a known encoding").format(file=name)) from None
    return builder.close()


def kmz_file(data: bytes, name: str) -> RawFile:
    """The lines of the first KML file in a KMZ archive.

    Raises:
        InputError: for an invalid archive, and for a file in it that is too large.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            inner = next(one for one in archive.namelist() if one.lower().endswith(".kml"))
            with archive.open(inner) as packed:
                found = packed.read(MOST_BYTES + 1)
    except (zipfile.BadZipFile, zlib.error, StopIteration, RuntimeError, OSError, EOFError, ValueError):
        text = _("{file} is no KMZ archive with a KML file in it that can be unpacked")
        raise InputError(text.format(file=name)) from None
    if len(found) > MOST_BYTES:
        text = _("{file}: what it holds is too large: at most {most} MB are read")
        raise InputError(text.format(file=name, most=MOST_BYTES // 1_000_000))
    return kml_file(found, name)


def kml_file(data: bytes, name: str) -> RawFile:
    """The lines, tracks and outer edges of polygons of a KML file: longitudes and latitudes.

    Raises:
        InputError: for invalid KML.
    """
    root = xml_tree(data, name)
    if root.tag != "kml":
        raise InputError(_("{file} is not KML").format(file=name))
    lines, passed = [], ["NetworkLink" for _link in root.iter("NetworkLink")]
    for place in root.iter("Placemark"):
        called = (place.findtext("name") or "").strip()
        for line in place.iter("LineString"):
            points = _positions(line.findtext("coordinates") or "", name)
            lines.append(RawLine(called, points, len(points) > 3 and points[0] == points[-1]))
        for polygon in place.iter("Polygon"):
            ring = polygon.findtext("outerBoundaryIs/LinearRing/coordinates") or ""
            lines.append(RawLine(called, _positions(ring, name), True))
            passed += [_("inner edge")] * len(polygon.findall("innerBoundaryIs"))
        for track in place.iter("Track"):
            words = (",".join((coord.text or "").split()) for coord in track.iter("coord"))
            lines.append(RawLine(called, _positions(" ".join(words), name)))
        passed += ["Point" for _point in place.iter("Point")]
    return RawFile(lines, True, "m", passed_over(passed))


def gpx_file(data: bytes, name: str) -> RawFile:
    """The tracks and routes of a GPX file, each segment by itself: longitudes and latitudes.

    Raises:
        InputError: for invalid GPX, and for a point without a place.
    """
    root = xml_tree(data, name)
    if root.tag != "gpx":
        raise InputError(_("{file} is not GPX").format(file=name))
    lines = []
    for walk in (*root.iter("trk"), *root.iter("rte")):
        called = (walk.findtext("name") or "").strip()
        for run in [walk] if walk.tag == "rte" else walk.iter("trkseg"):
            points = [
                _numbers(f"{point.get('lon', '')} {point.get('lat', '')}", name)
                for point in (*run.iter("trkpt"), *run.iter("rtept"))
            ]
            lines.append(RawLine(called, [(x, y) for x, y in points]))
    return RawFile(lines, True, "m", passed_over([point.tag for point in root.iter("wpt")]))


def _positions(text: str, name: str) -> list[tuple[float, ...]]:
    """Longitude and latitude of each of the tuples in a text."""
    found: list[tuple[float, ...]] = []
    for number, word in enumerate(text.split(), start=1):
        sizes = _numbers(word.replace(",", " "), name)
        if len(sizes) > 3 or len(sizes) != word.strip(",").count(",") + 1:
            said = _(
                "{file}: place {number} of a line must be longitude, latitude and maybe a height, "
                "then a space before the next, not {text}"
            )
            raise InputError(said.format(file=name, number=number, text=repr(word)[:60]))
        found.append((sizes[0], sizes[1]))
    return found


def _numbers(text: str, name: str) -> list[float]:
    """At least two numbers."""
    try:
        found = [float(word) for word in text.split()]
    except ValueError:
        found = []
    if len(found) < 2:
        said = _("{file}: expected numbers, not {text}")
        raise InputError(said.format(file=name, text=repr(text.strip())[:60]))
    return found


def landxml_file(data: bytes, name: str) -> RawFile:
    """The alignments of a LandXML file: lines, arcs and clothoids by their points.

    Raises:
        InputError: for invalid LandXML, and for other curves.
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
    return RawFile(lines, False, unit, says_unit=True, unclear=True)


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
        text = _("{file}: an alignment may hold lines, arcs and clothoids, not {what}")
        raise InputError(
            text.format(file=name, what=element.tag if element.tag not in kinds else spiral)
        )
    start, end = (_place(element, tag, points, name) for tag in ("Start", "End"))
    third = _place(element, "Center" if element.tag == "Curve" else "PI", points, name)
    if start is None or end is None or (element.tag == "Curve" and third is None):
        text = _("{file}: each {what} of an alignment needs Start, End, and an arc its Center")
        raise InputError(text.format(file=name, what=element.tag))
    turns = element.get("rot", "").lower()
    if element.tag != "Line" and turns not in ("cw", "ccw"):
        text = _("{file}: the {what} at {place} does not say by rot whether it bends cw or ccw")
        raise InputError(text.format(file=name, what=element.tag, place=place_text(start)))
    radii = (_size(element, key, name) for key in ("radiusStart", "radiusEnd"))
    return RawCurve(
        kinds[element.tag], start, end, third, turns == "ccw", _length(element, name),
        (next(radii), next(radii)) if element.tag == "Spiral" else (math.inf, math.inf),
    )  # fmt: skip


def _length(element: Element, name: str) -> float | None:
    """The length of a part; None for a line or an arc without one, or with 0."""
    text = element.get("length", "")
    if not text and element.tag != "Spiral":
        return None
    try:
        if float(text) == 0.0:
            return 0.0
    except ValueError:
        pass
    return _size(element, "length", name)


def _size(element: Element, key: str, name: str) -> float:
    """A length of a part, or a radius of a spiral; INF is infinite."""
    text = element.get(key, "")
    try:
        value = abs(float(text))
    except ValueError:
        value = math.nan
    if math.isnan(value) or (key == "length" and not 0.0 < value < math.inf) or value == 0.0:
        said = _("{file}: {key} of a {what} must be a positive number, not {value}")
        raise InputError(said.format(file=name, key=key, what=element.tag, value=repr(text)[:40]))
    return value
