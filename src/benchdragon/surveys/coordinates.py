"""Coordinates of files: their unit, their system, and the origin near which the work is done.

Longitudes and latitudes are projected to a transverse Mercator map about the origin; map coordinates
are metres already, from which the origin is taken as the decimals say it.
"""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from typing import Any

import numpy as np

from benchdragon.errors import InputError, brought_by
from benchdragon.i18n import _
from benchdragon.kernels.curve import MOST_METRES, FloatArray

# What one unit of a file is worth, m.
UNITS = {
    "m": Decimal(1),
    "cm": Decimal("0.01"),
    "mm": Decimal("0.001"),
    "km": Decimal(1000),
    "in": Decimal("0.0254"),
    "ft": Decimal("0.3048"),
    "us-ft": Decimal(1200) / Decimal(3937),
    "dm": Decimal("0.1"),
    "dam": Decimal(10),
    "hm": Decimal(100),
    "um": Decimal("0.000001"),
    "mil": Decimal("0.0000254"),
    "yd": Decimal("0.9144"),
    "mi": Decimal("1609.344"),
    "us-in": Decimal(100) / Decimal(3937),
    "us-yd": Decimal(3600) / Decimal(3937),
    "us-mi": Decimal(6336000) / Decimal(3937),
}
# The systems that need no library, and how codes of the others are written.
WGS84, GCJ02, BD09 = "wgs84", "gcj02", "bd09"
CODE = re.compile(r"(?:urn:ogc:def:crs:)?epsg:?(?:[0-9.]*:)?0*([0-9]{1,6})", re.ASCII)
# Semi-major axis, m, and flattening of WGS 84.
WGS84_SIZES = (6378137.0, 1.0 / 298.257223563)
# Semi-major axis, m, and squared eccentricity by which GCJ-02 scales its shifts: Krasovsky 1940.
GCJ_AXIS, GCJ_ECCENTRICITY = 6378245.0, 0.00669342162296594323
# GCJ-02 shifts places within these longitudes and latitudes alone.
GCJ_LONGITUDES, GCJ_LATITUDES = (72.004, 137.8347), (0.8293, 55.8271)
# BD-09 shows places of GCJ-02 so far to the east and north, degrees, and turned and stretched by waves
# of so many a degree.
BD_SHIFT, BD_WAVES, BD_STRETCH, BD_TURN = (0.0065, 0.006), 3000.0, 2e-5, 3e-6
# How near a place must come back that is shifted and unshifted, degrees.
GCJ_CLOSE = 1e-11
MOST_ITERATIONS = 50
# Plane coordinates that are all below this, m, are near enough to 0 as they are.
NEAR = 1e4
# Longitudes and latitudes of one survey may lie so far from its origin, degrees.
MOST_DEGREES = 1.0
# And those of a map so far, m.
MOST_AWAY = 2e5
# Maps are used so far beyond the edge of where their system is meant for, degrees.
AREA_SLACK = 1.5


@dataclass(frozen=True)
class Survey:
    """What coordinates of files mean; one for all files of a plan.

    Attributes:
        crs: "wgs84", "gcj02", "bd09" or "EPSG:nnnn"; None for plain metres.
        unit: of plane coordinates, a key of UNITS; None where the file says it.
        origin: what is (0, 0) in the plan, in the file's system: metres, or longitude and latitude;
            None to choose it from the first file.
    """

    crs: str | None = None
    unit: str | None = None
    origin: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        if self.unit is not None and self.unit not in UNITS:
            text = _("survey.unit must be one of {units}, not {unit}")
            raise InputError(text.format(units=", ".join(UNITS), unit=repr(self.unit)[:40]))
        if self.origin is not None and not all(math.isfinite(value) for value in self.origin):
            raise InputError(_("survey.origin must be two finite numbers"))


@dataclass(frozen=True)
class System:
    """A coordinate system.

    Attributes:
        angular: whether its coordinates are longitude and latitude, degrees.
        axis: semi-major axis of its ellipsoid, m.
        flattening: of its ellipsoid.
        shifted: how a map of China shows places of WGS 84; None where it shows them where they are.
        unit: what one unit is worth, m, of plane coordinates.
        area: where it is meant for: degrees west, south, east and north.
        code: of EPSG, of a map's system.
    """

    angular: bool
    axis: float = WGS84_SIZES[0]
    flattening: float = WGS84_SIZES[1]
    shifted: Callable[[FloatArray], FloatArray] | None = None
    unit: Decimal | None = None
    area: tuple[float, float, float, float] | None = None
    code: int = 0


def system_of(crs: str) -> System:
    """The system of that name.

    Raises:
        InputError: for an unknown name.
        MissingExtraError: for one that needs pyproj, where it is not installed.
    """
    plain = re.sub(r"[\s_-]", "", crs.lower())
    if plain == WGS84:
        return System(True)
    if plain in (GCJ02, BD09):
        (west, east), (south, north) = GCJ_LONGITUDES, GCJ_LATITUDES
        shown = gcj02_of_wgs84 if plain == GCJ02 else bd09_of_wgs84
        return System(True, shifted=shown, area=(west, south, east, north))
    if (code := code_of(crs)) is None:
        text = _("survey.crs must be {names} or a code like EPSG:4549, not {crs}")
        raise InputError(text.format(names=", ".join((WGS84, GCJ02, BD09)), crs=repr(crs)[:40]))
    with brought_by("survey"):
        from pyproj import CRS
        from pyproj.exceptions import CRSError
    try:
        found: Any = CRS.from_epsg(code)
    except CRSError:
        raise InputError(_("there is no coordinate system {crs}").format(crs=crs)) from None
    area = found.area_of_use and found.area_of_use.bounds
    if found.is_geographic and found.ellipsoid is not None:
        axes = found.ellipsoid
        inverse = axes.inverse_flattening
        return System(True, axes.semi_major_metre, 1.0 / inverse if inverse else 0.0, area=area)
    if not found.is_projected:
        text = _("{crs} is neither a map's system nor one of longitudes and latitudes")
        raise InputError(text.format(crs=crs))
    worth = Decimal(repr(found.axis_info[0].unit_conversion_factor))
    return System(False, unit=worth, area=area, code=code)


def code_of(crs: str) -> int | None:
    """The number in a code of EPSG, however it is written; None of anything else."""
    found = CODE.fullmatch(re.sub(r"[\s_-]", "", crs.lower()))
    return int(found[1]) if found else None


def taken_near(
    points: Sequence[tuple[float, float]], survey: Survey, name: str, angular: bool, unit: str | None
) -> tuple[FloatArray, Survey]:
    """Points of a file in metres near the dance, (P, 2), and the survey with its origin.

    Args:
        points: as in the file, x or longitude first.
        survey: of the plan.
        name: of the file.
        angular: whether the file holds longitudes and latitudes unless the survey says otherwise.
        unit: what the file says of its unit, a key of UNITS; None where it says nothing.

    Raises:
        InputError: for a system or a unit that is missing, and for coordinates that cannot be.
    """
    if survey.crs is None and angular:
        raise InputError(
            _(
                "{file} holds longitudes and latitudes: set survey.crs to {wgs84} (GPS), {gcj02} (maps "
                "of China), {bd09} (Baidu) or a code like EPSG:4490"
            ).format(file=name, wgs84=f'"{WGS84}"', gcj02=f'"{GCJ02}"', bd09=f'"{BD09}"')
        )
    system = System(False) if survey.crs is None else system_of(survey.crs)
    if system.angular:
        return _projected(points, survey, system, name)
    if angular and all(abs(x) <= 180.0 and abs(y) <= 90.0 for x, y in points):
        text = _(
            "{file} seems to hold degrees, but survey.crs = {crs} is in metres: set it to that "
            "of the file"
        )
        raise InputError(text.format(file=name, crs=f'"{survey.crs}"'))
    factor = UNITS[survey.unit] if survey.unit is not None else system.unit
    if factor is None and unit is None:
        text = _("{file} does not say its unit: set survey.unit to one of {units}")
        raise InputError(text.format(file=name, units=", ".join(UNITS)))
    if system.code:
        _check_map(points, survey, system, name)
    worth = UNITS[unit] if factor is None and unit else factor
    return _subtracted(points, survey, worth, name, MOST_AWAY if system.code else MOST_METRES)


def _check_map(
    points: Sequence[tuple[float, float]], survey: Survey, system: System, name: str
) -> None:
    """Refuse coordinates that a map's system has far from where it is meant for."""
    _check_finite(points, name)
    given = np.asarray(points, np.float64)
    if survey.unit is not None:
        given = given * float(UNITS[survey.unit] / (system.unit or 1))
    lie, crossed = _in_area(_degrees(given, system), system), False
    if not lie:
        crossed = _in_area(_degrees(given[:, ::-1], system), system)
    if crossed:
        text = _(
            "{file}: with x to the east and y to the north its points do not lie where {crs} is "
            "meant for, and with both exchanged they do: name the columns east and north, or "
            "exchange x and y in the file"
        )
        raise InputError(text.format(file=name, crs=survey.crs))
    if not lie:
        raise InputError(_outside(survey, system, name))


def _outside(survey: Survey, system: System, name: str) -> str:
    west, south, east, north = (f"{value:g}" for value in system.area or ())
    return _(
        "{file}: its points do not lie where {crs} is meant for, longitudes {west} to {east} and "
        "latitudes {south} to {north}: is survey.crs right, and x or the longitude first?"
    ).format(file=name, crs=survey.crs, west=west, east=east, south=south, north=north)


def _degrees(given: FloatArray, system: System) -> FloatArray:
    """Longitudes and latitudes of map coordinates, in the units of their system."""
    from pyproj import CRS, Transformer

    whole = CRS.from_epsg(system.code)
    turned = Transformer.from_crs(whole, whole.geodetic_crs, always_xy=True)
    return np.column_stack(turned.transform(given[:, 0], given[:, 1]))


def _in_area(degrees: FloatArray, system: System) -> bool:
    """Whether longitudes and latitudes lie in or near the area that a system is meant for."""
    if system.area is None:
        return True
    west, south, east, north = system.area
    if not np.isfinite(degrees).all():
        return False
    across = (degrees[:, 0] - west + AREA_SLACK) % 360.0 <= (east - west) % 360.0 + 2.0 * AREA_SLACK
    if east - west >= 360.0 - 2.0 * AREA_SLACK:
        across[:] = True
    up = (degrees[:, 1] >= south - AREA_SLACK) & (degrees[:, 1] <= north + AREA_SLACK)
    return bool((across & up).all())


def _subtracted(
    points: Sequence[tuple[float, float]], survey: Survey, factor: Decimal | None, name: str,
    most: float,
) -> tuple[FloatArray, Survey]:  # fmt: skip
    """Plane points less the origin: subtracted as decimals, so that no digit is lost."""
    assert factor is not None
    _check_finite(points, name)
    origin = survey.origin
    if origin is None:
        first = [float(_decimal(value) * factor) for value in points[0]]
        near = all(abs(value) * float(factor) < NEAR for point in points for value in point)
        origin = (0.0, 0.0) if near else (math.floor(first[0]), math.floor(first[1]))
    x0, y0 = (_decimal(value) for value in origin)
    found = np.array(
        [(float(_decimal(x) * factor - x0), float(_decimal(y) * factor - y0)) for x, y in points]
    )
    if np.abs(found).max(initial=0.0) > most:
        text = _("{file}: points must lie within {most} m of survey.origin")
        raise InputError(text.format(file=name, most=f"{most:g}".replace("+0", "")))
    return found, replace(survey, origin=(float(origin[0]), float(origin[1])))


def _decimal(value: float) -> Decimal:
    """A coordinate as it was written, up to 15 digits: the shortest decimal that is this double."""
    return Decimal(repr(float(value)))


def _check_finite(points: Sequence[tuple[float, float]], name: str) -> None:
    if not np.isfinite(np.asarray(points, np.float64)).all():
        raise InputError(_("{file}: every coordinate must be a finite number").format(file=name))


def _projected(
    points: Sequence[tuple[float, float]], survey: Survey, system: System, name: str
) -> tuple[FloatArray, Survey]:
    """Longitudes and latitudes as metres about the origin, that of GCJ-02 included."""
    _check_finite(points, name)
    given = np.asarray(points, np.float64)
    if np.abs(given[:, 0]).max() > 180.0 or np.abs(given[:, 1]).max() > 89.0:
        text = _(
            "{file}: longitudes lie within 180 degrees and latitudes within 89, longitude "
            "first: is survey.crs right?"
        )
        raise InputError(text.format(file=name))
    if not _in_area(given, system):
        raise InputError(_outside(survey, system, name))
    origin = survey.origin
    if origin is None:
        origin = (round(float(given[0, 0]), 4), round(float(given[0, 1]), 4))
    if np.abs(given - origin).max() > MOST_DEGREES:
        text = _("{file}: points must lie within {most} degree of survey.origin")
        raise InputError(text.format(file=name, most=f"{MOST_DEGREES:g}"))
    centre = np.array([origin])
    if system.shifted is not None:
        given, centre = unshifted(given, system.shifted), unshifted(centre, system.shifted)
    found = local_metres(given, (float(centre[0, 0]), float(centre[0, 1])), system)
    return found, replace(survey, origin=(float(origin[0]), float(origin[1])))


def local_metres(degrees: FloatArray, origin: tuple[float, float], system: System) -> FloatArray:
    """Transverse Mercator about an origin: x to the east and y to the north of it, m, (P, 2).

    Krueger's series in the third flattening to its fourth power: within a degree of the origin they
    leave under 1e-7 m.
    """
    n = system.flattening / (2.0 - system.flattening)
    alpha = (
        n / 2 - 2 * n**2 / 3 + 5 * n**3 / 16 + 41 * n**4 / 180,
        13 * n**2 / 48 - 3 * n**3 / 5 + 557 * n**4 / 1440,
        61 * n**3 / 240 - 103 * n**4 / 140,
        49561 * n**4 / 161280,
    )
    scale = system.axis / (1.0 + n) * (1.0 + n**2 / 4 + n**4 / 64)
    longitude = np.radians(degrees[:, 0] - origin[0])
    xi, eta = _conformal(np.radians(degrees[:, 1]), longitude, n)
    xi0, _eta0 = _conformal(np.radians([origin[1]]), np.zeros(1), n)
    east, north = eta.copy(), xi - xi0
    for j, a in enumerate(alpha, start=1):
        east += a * np.cos(2 * j * xi) * np.sinh(2 * j * eta)
        north += a * (np.sin(2 * j * xi) * np.cosh(2 * j * eta) - np.sin(2 * j * xi0))
    return np.column_stack([scale * east, scale * north])


def _conformal(latitude: FloatArray, longitude: FloatArray, n: float) -> tuple[FloatArray, FloatArray]:
    e = 2.0 * math.sqrt(n) / (1.0 + n)
    sine = np.sin(latitude)
    t = np.sinh(np.arctanh(sine) - e * np.arctanh(e * sine))
    xi = np.arctan2(t, np.cos(longitude))
    eta = np.arctanh(np.sin(longitude) / np.sqrt(1.0 + t * t))
    return xi, eta


def gcj02_of_wgs84(degrees: FloatArray) -> FloatArray:
    """Longitudes and latitudes (P, 2) of WGS 84 as maps of China show them."""
    longitude, latitude = degrees[:, 0], degrees[:, 1]
    x, y = longitude - 105.0, latitude - 35.0
    root = np.sqrt(np.abs(x))
    waves = 20.0 * np.sin(6.0 * np.pi * x) + 20.0 * np.sin(2.0 * np.pi * x)
    north = -100.0 + 2.0 * x + 3.0 * y + 0.2 * y * y + 0.1 * x * y + 0.2 * root
    north += 2.0 / 3.0 * (waves + 20.0 * np.sin(np.pi * y) + 40.0 * np.sin(np.pi * y / 3.0))
    north += 2.0 / 3.0 * (160.0 * np.sin(np.pi * y / 12.0) + 320.0 * np.sin(np.pi * y / 30.0))
    east = 300.0 + x + 2.0 * y + 0.1 * x * x + 0.1 * x * y + 0.1 * root
    east += 2.0 / 3.0 * (waves + 20.0 * np.sin(np.pi * x) + 40.0 * np.sin(np.pi * x / 3.0))
    east += 2.0 / 3.0 * (150.0 * np.sin(np.pi * x / 12.0) + 300.0 * np.sin(np.pi * x / 30.0))
    angle = np.radians(latitude)
    bulge = 1.0 - GCJ_ECCENTRICITY * np.sin(angle) ** 2
    meridian = GCJ_AXIS * (1.0 - GCJ_ECCENTRICITY) / (bulge * np.sqrt(bulge))
    parallel = GCJ_AXIS / np.sqrt(bulge) * np.cos(angle)
    shift = np.degrees(np.column_stack([east / parallel, north / meridian]))
    (west, east_end), (south, north_end) = GCJ_LONGITUDES, GCJ_LATITUDES
    inside = (
        (longitude >= west) & (longitude <= east_end) & (latitude >= south) & (latitude <= north_end)
    )
    return np.where(inside[:, None], degrees + shift, degrees)


def bd09_of_wgs84(degrees: FloatArray) -> FloatArray:
    """Longitudes and latitudes (P, 2) of WGS 84 as Baidu's maps show them: those of GCJ-02 shifted."""
    longitude, latitude = gcj02_of_wgs84(degrees).T
    waves = math.radians(BD_WAVES)
    far = np.hypot(longitude, latitude) + BD_STRETCH * np.sin(waves * latitude)
    angle = np.arctan2(latitude, longitude) + BD_TURN * np.cos(waves * longitude)
    return np.column_stack([far * np.cos(angle), far * np.sin(angle)]) + BD_SHIFT


def unshifted(degrees: FloatArray, shown: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """The places of WGS 84 that a map shows there, by iteration; `shown` says where it shows a place.

    Raises:
        InputError: where none is found: at the edge of what is shifted.
    """
    found = degrees.copy()
    for _step in range(MOST_ITERATIONS):
        off = degrees - shown(found)
        if np.abs(off).max(initial=0.0) <= GCJ_CLOSE:
            return found
        found = found + off
    raise InputError(_("no place is shown there in GCJ-02: it lies at the edge of what is shifted"))
