"""Signs of names that the package's fonts lack."""

import io
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from fontTools.fontBuilder import FontBuilder  # type: ignore[import-untyped]
from fontTools.pens.ttGlyphPen import TTGlyphPen  # type: ignore[import-untyped]
from fpdf import FPDF
from matplotlib import font_manager
from matplotlib.ft2font import FT2Font
from pypdf import PdfReader

from benchdragon.export.typeset import use_spare_fonts
from benchdragon.figures import glyphs
from benchdragon.figures.glyphs import printable, spare_fonts
from benchdragon.figures.style import FONT_FILES, package_signs
from tests.scripts import script


def font(path: Path, signs: str, glyph_count: int = 2, embedding: int = 0) -> SimpleNamespace:
    """A font file with `signs`, a box each, as the system tells of it."""
    pen = TTGlyphPen(None)
    for point in ((100, 0), (100, 700), (800, 700), (800, 0)):
        (pen.lineTo if pen.points else pen.moveTo)(point)
    pen.closePath()
    names = [".notdef", *(f"sign{n}" for n in range(1, glyph_count))]
    made = FontBuilder(1000, isTTF=True)
    made.setupGlyphOrder(names)
    made.setupCharacterMap(
        {ord(sign): names[1 + n % (glyph_count - 1)] for n, sign in enumerate(signs)}
    )
    made.setupGlyf({name: pen.glyph(dropImpliedOnCurves=False) for name in names})
    made.setupHorizontalMetrics(dict.fromkeys(names, (900, 100)))
    made.setupHorizontalHeader(ascent=800, descent=-200)
    made.setupNameTable({"familyName": path.stem, "styleName": "Regular"})
    made.setupOS2(fsType=embedding)
    made.setupPost()
    made.save(path)
    return SimpleNamespace(fname=str(path), index=0, style="normal", weight=400)


@pytest.fixture
def system(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[list[SimpleNamespace]]:
    """The fonts of a system that has none yet."""
    package_signs()
    found: list[SimpleNamespace] = []
    monkeypatch.setattr(font_manager.fontManager, "ttflist", found)
    monkeypatch.setattr(glyphs, "WINDOWS", tmp_path / "c")
    kept = glyphs._spare, glyphs._system_fonts, glyphs._windows_fonts, glyphs._signs
    for one in kept:
        one.cache_clear()
    yield found
    for one in kept:
        one.cache_clear()


def test_a_sign_that_no_font_has_is_written_as_its_code(system: list[SimpleNamespace]) -> None:
    assert not system
    assert printable("王瑒、李娜 $5") == "王〔U+7452〕、李娜 $5"
    assert printable("𠮷田") == "〔U+20BB7〕田"
    assert spare_fonts("瑒峯") == ()
    assert printable(printable("瑒")) == "〔U+7452〕"


def test_marks_that_show_nothing_are_dropped(system: list[SimpleNamespace]) -> None:
    assert not system
    assert printable("王\u200b明\ufe0f\U000e0100") == "王明"


def test_another_font_of_the_system_prints_it(tmp_path: Path, system: list[SimpleNamespace]) -> None:
    system += [font(tmp_path / "other.ttf", "峯"), font(tmp_path / "village.ttf", "瑒")]
    assert printable("王瑒") == "王瑒"
    assert spare_fonts("王瑒") == (tmp_path / "village.ttf",)
    pdf = FPDF()
    pdf.add_font("Noto", "", FONT_FILES[0])
    use_spare_fonts(pdf, "王瑒")
    pdf.add_page()
    pdf.set_font("Noto", size=20)
    pdf.cell(0, 10, "王瑒")
    page = PdfReader(io.BytesIO(bytes(pdf.output()))).pages[0]
    assert "王瑒" in page.extract_text()
    assert b"village" in pdf.output()


def test_fonts_that_draw_boxes_or_may_not_be_embedded_serve_nobody(
    tmp_path: Path, system: list[SimpleNamespace]
) -> None:
    boxes = "".join(chr(0x5000 + n) for n in range(3000))
    system += [
        font(tmp_path / "last_resort.ttf", boxes),
        font(tmp_path / "kept.ttf", "瑒", embedding=2),
    ]
    assert printable("瑒") == "〔U+7452〕"


def test_a_font_that_is_gone_serves_nobody(tmp_path: Path, system: list[SimpleNamespace]) -> None:
    system.append(
        SimpleNamespace(fname=str(tmp_path / "x.ttf"), index=0, style="normal", weight="bold")
    )
    (tmp_path / "torn.ttf").write_bytes(b"\0\1\0\0torn")
    system.append(SimpleNamespace(fname=str(tmp_path / "torn.ttf"), style="italic", weight=400))
    assert printable("瑒") == "〔U+7452〕"


def test_a_private_sign_is_never_another_fonts(tmp_path: Path, system: list[SimpleNamespace]) -> None:
    system.append(font(tmp_path / "private.ttf", "\ue863"))
    assert printable("\ue863") == "〔U+E863〕"


def test_the_fonts_hold_the_signs_of_names() -> None:
    tool: Any = script("tools/make_fonts.py")
    listed = set("".join(tool.NAME_SIGNS.read_text("utf-8").split()))
    assert len(listed) == 1467
    assert not listed & tool.gb2312_characters()
    wanted = tool.gb2312_characters() | tool.name_characters()
    assert set("喆堃垚淼赟珺祎翀彧昇邨鎏甯䶮𬭚陳國強") <= wanted
    for file in FONT_FILES:
        assert {ord(sign) for sign in wanted} <= set(FT2Font(str(file)).get_charmap())


def test_fonts_of_the_windows_beneath_print_what_the_systems_own_lack(
    tmp_path: Path, system: list[SimpleNamespace]
) -> None:
    everyones = tmp_path / "c" / "Windows" / "Fonts"
    ones_own = tmp_path / "c" / "Users" / "li" / "AppData" / "Local" / "Microsoft" / "Windows" / "Fonts"
    for folder in (everyones, ones_own):
        folder.mkdir(parents=True)
    font(everyones / "arial.ttf", "瑒")
    font(everyones / "SIMSUN.TTF", "瑒峯")
    (everyones / "desktop.ini").write_bytes(b"x")
    font(ones_own / "mine.otf", "𡘙")
    system.append(font(tmp_path / "village.ttf", "峯"))
    assert printable("瑒峯𡘙𠮷") == "瑒峯𡘙〔U+20BB7〕"
    assert spare_fonts("瑒峯𡘙") == (
        everyones / "SIMSUN.TTF", tmp_path / "village.ttf", ones_own / "mine.otf",
    )  # fmt: skip
