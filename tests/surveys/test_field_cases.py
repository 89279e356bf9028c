"""Files as people of the field send them (tests/cases/field): each is taken as drawn, or refused.

Each stands for a kind: line ends and encodings of Windows, what Inkscape and Illustrator write, parts
without a length, coordinates crossed, units that few use, and what is passed over.
"""

import json
import math
import re
import shutil
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from benchdragon.cli.main import run
from benchdragon.plans.schema import read_plan

FIELD = Path(__file__).parents[1] / "cases" / "field"

# The line that most of the files hold, m, and the same of those in degrees, as PROJ has it there.
WALK = [(0.0, 0.0), (20.0, 0.0), (35.0, 10.0), (35.0, 40.0), (60.0, 55.0)]
FITTED = [(0.0, 0.0), (5.0, 7.5), (10.0, 10.0), (15.0, 7.5), (20.0, 0.0)]
INK = [(10.0, -10.0), (70.0, -10.0), (110.0, -40.0), (110.0, -130.0), (170.0, -190.0)]
RECTANGLE = [(21.0, -29.7), (189.0, -29.7), (189.0, -178.2), (21.0, -178.2)]
STADIUM = [(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0)]


class Read(NamedTuple):
    """A file that is read: how long its route is, m, where its corners are, what is told besides."""

    length: tuple[float, float] | None
    corners: list[tuple[float, float]] | None = None
    told: str = ""
    settings: tuple[str, ...] = ()
    within: float = 1e-6


DEGREES = Read((96.3, 96.7), WALK, within=0.35)
AS_DRAWN = Read((96.3185, 96.3187), WALK)
SMOOTH = ("route.smooth=G1", "route.deviation=2")
CASES: dict[str, Read | str] = {
    "F01.dragon.toml": Read((70.0, 70.0), [(10.0, -10.0), (80.0, -10.0)]),
    "F02.dragon.toml": Read((70.0, 70.0), [(10.0, -10.0), (80.0, -10.0)]),
    "F04.dragon.toml": AS_DRAWN,
    "F06.dragon.toml": Read(None, STADIUM),
    "F07.dragon.toml": r"F07\.dxf: part 1 \(SPLINE of layer 0\) cannot be read",
    "F08.dragon.toml": Read((70.0, 70.000002), told="part 2 of 'A1', at (30.000001, 0) has no length"),
    "F10.dragon.toml": Read((85.7079, 85.7081), told="part 2 of 'A1', at (30, 0) has no length"),
    "F11.dragon.toml": r"F11\.csv: .*do not lie where EPSG:4528 is meant for, and with both exchanged",
    "F12.dragon.toml": AS_DRAWN,
    "F14.dragon.toml": r"F14\.kml: place 1 of a line must be longitude, latitude and maybe a height",
    "F15.dragon.toml": Read((28.0, 29.21), FITTED),
    "F16.dragon.toml": AS_DRAWN._replace(told="F16.dxf: lines without a length, passed over: 1"),
    "F18.dragon.toml": AS_DRAWN._replace(told="POLYLINE that is not level (read as seen from above)"),
    "F19.dragon.toml": r"F19\.dxf holds no line; passed over: 1 INSERT \(blocks are not read",
    "F20.dragon.toml": AS_DRAWN,
    "F22.dragon.toml": Read((1230.0, 1266.0), RECTANGLE),
    "F24.dragon.toml": Read((57.0, 60.0), [(10.0, -10.0), (40.0, -10.0), (40.0, -40.0)]),
    "F25.dragon.toml": Read((280.0, 285.0), INK, settings=SMOOTH),
    "F27.dragon.toml": AS_DRAWN,
    "F28.dragon.toml": r"F28\.csv: which of X坐标, Y坐标 points north\?",
    "F30.dragon.toml": DEGREES,
    "F31.dragon.toml": DEGREES,
    "F32.dragon.toml": r'F32\.geojson says .* EPSG:4549: set survey\.crs to "EPSG:4549"',
    "F33.dragon.toml": DEGREES,
    "F35.dragon.toml": r"F35\.dxf is a binary drawing: save it as DXF in text \(ASCII\)",
    "F37.dragon.toml": Read((9.0, 9.64), [(0.1 * x, 0.1 * y) for x, y in WALK]),
    "F38.dragon.toml": AS_DRAWN._replace(told="layers that are off, passed over: 1, on '旧路线'"),
    "F39.dragon.toml": Read((99.4, 100.0), [(0.0, 0.0), (60.0, 0.0), (60.0, -40.0)]),
    "N01.dragon.toml": DEGREES,
    "N03.dragon.toml": DEGREES,
    "N04.dragon.toml": AS_DRAWN,
    "N06.dragon.toml": Read((159.2, 159.3)),
    "N07.dragon.toml": Read((52.0, 52.0001)),
    # Not crossed: a place near Saint Petersburg may be meant.
    "N09.dragon.toml": Read((85.3, 85.4)),
    "N10.dragon.toml": Read((285.66, 285.67)),
    "N12.dragon.toml": Read((53.0, 53.1)),
    "N13.dragon.toml": Read((132.0, 132.5)),
    "R01.dragon.toml": r"at \(40, 0\) m the drawing doubles straight back",
    "R02.dragon.toml": r"at \(39\.7000, 0\.0000\) m, .* the route bends with a radius of 0\.3 m",
    "R04.dragon.toml": Read(None, told="SAFE from"),
    "R05.dragon.toml": Read(None, told="SAFE from"),
    "R06.dragon.toml": Read(None, told="SAFE from"),
    "R08.dragon.toml": Read(None, told="UNDECIDED"),
    "R09.dragon.toml": Read(None, told="bench 1 touches post at t = 0.67"),
    "R10.dragon.toml": Read(None, told="SAFE from"),
    "T01.dragon.toml": Read(None, told="0:00"),
    "T02.dragon.toml": Read(None, told="0:00"),
    "T04.dragon.toml": Read(None, told="0:00"),
    "T06.dragon.toml": Read(None, told="23:59"),
}


def test_every_file_of_the_field_has_its_answer() -> None:
    assert {path.name for path in FIELD.glob("[FNRT]*.dragon.toml")} == set(CASES)


@pytest.fixture(autouse=True)
def _extra() -> None:
    for extra in ("ezdxf", "svgelements", "pyproj"):
        pytest.importorskip(extra)


@pytest.mark.parametrize("name", [name for name in CASES if name[0] in "FN"])
def test_a_drawing_of_the_field_is_taken_as_drawn_or_refused(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    case, path = CASES[name], str(FIELD / name)
    if isinstance(case, str):
        assert run(["survey", path, "--lang", "en", "--quiet"]) == 3
        refused(capsys.readouterr().err, case)
        return
    if case.corners is not None:
        plan = read_plan(path, case.settings)
        drawn = plan.venue.boundary if plan.venue.boundary else getattr(plan.route, "points", None)
        assert drawn is not None
        same_corners(drawn, case.corners, case.within)
    if case.length is not None:
        settings = [word for one in case.settings for word in ("--set", one)]
        assert run(["survey", path, "--json", "--lang", "en", "--quiet", *settings]) == 0
        found = json.loads(capsys.readouterr().out)
        assert case.length[0] - 1e-9 <= found["length"] <= case.length[1] + 1e-9
        assert case.told in "\n".join(found["passed_over"])
        assert bool(case.told) == bool(found["passed_over"])


@pytest.mark.parametrize("name", [name for name in CASES if name[0] in "RT"])
def test_a_dance_of_the_field_gets_its_answer(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    case, path = CASES[name], str(FIELD / name)
    ending = run(["check" if name[0] == "R" else "timetable", path, "--lang", "en", "--quiet"])
    said = capsys.readouterr()
    if isinstance(case, str):
        assert ending == 3
        refused(said.err, case)
    else:
        assert ending in (0, 1, 5)
        assert case.told in said.out


def test_what_was_passed_over_is_told_by_every_verb(capsys: pytest.CaptureFixture[str]) -> None:
    run(["timetable", str(FIELD / "F16.dragon.toml"), "--lang", "en"])
    assert "Drawing: F16.dxf: lines without a length, passed over: 1\n" in capsys.readouterr().err


def refused(said: str, pattern: str) -> None:
    """It is one line, and that one."""
    assert re.search(pattern, said)
    assert len(said.splitlines()) == 1


def same_corners(found: object, wanted: list[tuple[float, float]], within: float) -> None:
    """Both are one line, from either end; one that lies elsewhere on the map is moved there."""
    given, line = np.array(found), np.array(wanted)
    if np.abs(given[0] - line[0]).max() > 1.0 and np.abs(given[-1] - line[0]).max() > 1.0:
        given = given - given[0] + line[0]
    assert given.shape == line.shape
    assert min(np.abs(given - line).max(), np.abs(given[::-1] - line).max()) <= within


def test_crlf_cr_spaces_and_a_mark_before_the_text_change_nothing(tmp_path: Path) -> None:
    text = (FIELD / "N04.dxf").read_bytes()
    plan = FIELD / "N04.dragon.toml"
    wanted = read_plan(str(plan)).sha256
    shutil.copy(plan, tmp_path / plan.name)
    forms = {
        "CRLF": text.replace(b"\n", b"\r\n"),
        "CR": text.replace(b"\n", b"\r"),
        "spaces": text.replace(b"\n", b" \t\n"),
        "mark": b"\xef\xbb\xbf" + text.decode("gb18030").encode(),
        "DOS": text + b"\x1a",
        "UTF-16": text.decode("gb18030").encode("utf-16"),
    }
    for form, data in forms.items():
        (tmp_path / "N04.dxf").write_bytes(data)
        assert read_plan(str(tmp_path / plan.name)).sha256 == wanted, form


def test_f11_is_read_where_its_columns_say_so(tmp_path: Path) -> None:
    text = (FIELD / "F11.csv").read_text("utf-8")
    for heads in ("north,east", "北坐标(m),东坐标(m)", "Northing,Easting"):
        (tmp_path / "F11.csv").write_text(text.replace("x,y", heads), "utf-8")
        shutil.copy(FIELD / "F11.dragon.toml", tmp_path)
        points = np.array(read_plan(str(tmp_path / "F11.dragon.toml")).route.points)  # type: ignore[union-attr]
        assert np.allclose(points - points[0], WALK)
        assert math.isclose(float(np.hypot(*points[0])), 0.0)
