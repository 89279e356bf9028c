"""Drawings torn in every way: each is read or refused in one sentence, and never in a traceback."""

import io
import random
import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from benchdragon.errors import BenchDragonError
from benchdragon.surveys.coordinates import Survey
from benchdragon.surveys.reading import outline, read_line, read_lines
from tests.surveys.drawings import RAILWAY, bare_dxf, geojson_square, landxml
from tests.surveys.test_reading import KML

TRIES = 900
NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
READERS: tuple[Callable[[Path, Survey], object], ...] = (read_lines, read_line, outline)
# What may stand where a number stood.
ODD = (b"0", b"-1", b"1e308", b"-1e308", b"nan", b"inf", b"1e-320", b"1e99", b"", b"x", b"1e6", b"1,5",
       b"9" * 21, b"1" * 400, b"3", b"2.5", b"0.125", b"[[[[", b"60%")  # fmt: skip
SHAPES = (
    '<g transform="rotate(30 1 2) scale(2,-1) matrix(1 .2 .3 1 0 0) skewX(10)"><path id="w" d="M0 0 C '
    '1 0 2 1 3 1 s 1 1 2 2 Q 1 2 3 4 t 3 3 h 4 v 5 A 2 1 9 0 1 7 3 z m 1 1 l 3 3"/></g><svg x="1" '
    'width="50%" height="3" viewBox="0 0 7 7"><rect x="1" width="20%" height="3" rx="1"/><ellipse '
    'rx="3" ry="2"/></svg>'
)


def dxf(version: str) -> bytes:
    """One entity of each kind that a version has and that is read."""
    from ezdxf.filemanagement import new

    document = new(version, units=6 if version != "R12" else 0)
    space = document.modelspace()
    space.add_line((0, 0), (1, 0))
    space.add_arc((0, 0), 5, 10, 90, dxfattribs={"extrusion": (0, 0, -1)})
    space.add_circle((0, 0), 3)
    space.add_polyline2d([(0, 0, 0.5), (1, 1, 0), (3, 4, -1)], format="xyb", close=True)
    space.add_polyline3d([(0, 0, 1), (3, 4, 5)])
    if version != "R12":
        space.add_ellipse((0, 0), (4, 1), 0.3, 0.1, 3)
        space.add_spline([(0, 0), (3, 4), (5, 1), (9, 9)])
        space.add_lwpolyline([(0, 0, 0, 0, 0.3), (5, 5, 0, 0, -1), (8, 8)])
    document.write(text := io.StringIO())
    whole = text.getvalue()
    # Its entities alone: of a whole file most changes hit tables, and its head holds the time.
    entities = whole[whole.index("ENTITIES") :]
    return f"  0\nSECTION\n  2\n{entities[: entities.index('ENDSEC')]}ENDSEC\n  0\nEOF\n".encode()


def kmz() -> bytes:
    with zipfile.ZipFile(packed := io.BytesIO(), "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("doc.kml", KML.format("1,2 1.1,2.1 1.2,2"))
    return packed.getvalue()


def drawings() -> dict[str, bytes]:
    points = "<trkpt lat='30' lon='120'/><trkpt lat='30.1' lon='120'/>"
    return {
        "a.csv": b"x,y\n0,0\n30,0\n30,20\n0,20\n",
        "b.csv": "点号;东坐标;北坐标\nA;0;0\nB;3,5;4\n".encode("gb18030"),
        "c.csv": "x\ty\n0\t0\n30\t0\n".encode("utf-16"),
        "a.geojson": geojson_square().encode(),
        "a.kml": KML.format("1,2 1.1,2,3 1.2,2.1").encode(),
        "a.kmz": kmz(),
        "a.gpx": f"<gpx><trk><trkseg>{points}</trkseg></trk></gpx>".encode(),
        "a.xml": landxml(RAILWAY, 0.0, 0.0, (0.0, 0.0)).encode(),
        "a.dxf": bare_dxf(1.0).encode(),
        "b.dxf": dxf("R2000"),
        "c.dxf": dxf("R12"),
        "a.svg": f'<svg width="9mm" viewBox="0 0 9 9">{SHAPES}</svg>'.encode(),
        "b.svg": b'<svg><polyline points="0,0 1,1 2,5"/></svg>',
    }


def torn(data: bytes, dice: random.Random) -> bytes:
    """Data cut, doubled, swapped, or with another sign or number in it."""
    at, size = dice.randrange(len(data)), dice.randint(1, 60)
    lines = data.split(b"\n")
    one, other = dice.randrange(len(lines)), dice.randrange(len(lines))
    lines[one], lines[other] = lines[other], lines[one]
    number = dice.choice([*NUMBER.finditer(data)] or [*re.finditer(b"$", data)])
    kinds: list[Callable[[], bytes]] = [
        lambda: data[:at],
        lambda: data[:at] + bytes([dice.randrange(256)]) + data[at + 1 :],
        lambda: data[:at] + data[at + size :],
        lambda: data[:at] + data[at : at + size] * dice.choice([2, 40]) + data[at + size :],
        lambda: b"\n".join(lines),
        *[lambda: data[: number.start()] + dice.choice(ODD) + data[number.end() :]] * 5,
    ]
    return dice.choice(kinds)()


def test_torn_drawings_are_read_or_refused_in_one_sentence(tmp_path: Path) -> None:
    for extra in ("ezdxf", "svgelements", "pyproj"):
        pytest.importorskip(extra)
    dice = random.Random(36)
    whole, read, sentences = drawings(), 0, list[str]()
    for n in range(TRIES):
        name = list(whole)[n % len(whole)]
        data = whole[name]
        for _change in range(dice.choice([1, 1, 2, 3])):
            data = torn(data, dice) if data else data
        degrees = name[2:] in ("kml", "kmz", "gpx", "geojson")
        usual = Survey("wgs84") if degrees else Survey(unit="m", origin=(0.0, 0.0))
        survey = dice.choice([usual] * 17 + [Survey(), Survey("bd09"), Survey("EPSG:4549")])
        path = tmp_path / name
        path.write_bytes(data)
        try:
            READERS[dice.randrange(3)](path, survey)
            read += 1
        except BenchDragonError as error:
            sentences.append(str(error))
    assert all(len(one.splitlines()) == 1 and one.isprintable() for one in sentences)
    assert read > 50
    assert len(sentences) > 300
