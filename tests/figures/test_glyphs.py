"""Signs of names that the package's fonts lack."""

import io
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from fontTools.fontBuilder import FontBuilder  # type: ignore[import-untyped]
from fontTools.pens.ttGlyphPen import TTGlyphPen  # type: ignore[import-untyped]
from fpdf import FPDF
from matplotlib import font_manager
from pypdf import PdfReader

from benchdragon.export.typeset import use_spare_fonts
from benchdragon.figures import glyphs
from benchdragon.figures.glyphs import glyph_warnings, printable, spare_fonts, unprintable
from benchdragon.figures.style import FONT_FILES, package_signs
from benchdragon.i18n import use_language


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
def system(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[SimpleNamespace]]:
    """The fonts of a system that has none yet."""
    package_signs()
    found: list[SimpleNamespace] = []
    monkeypatch.setattr(font_manager.fontManager, "ttflist", found)
    glyphs._spare.cache_clear()
    glyphs._system_fonts.cache_clear()
    yield found
    glyphs._spare.cache_clear()
    glyphs._system_fonts.cache_clear()


def test_a_sign_that_no_font_has_is_written_as_its_code(system: list[SimpleNamespace]) -> None:
    assert not system
    assert printable("王喆、李娜 $5") == "王〔U+5586〕、李娜 $5"
    assert printable("𠮷田") == "〔U+20BB7〕田"
    assert unprintable("喆喆堃王") == ("喆", "堃")
    assert spare_fonts("喆堃") == ()
    assert printable(printable("喆")) == "〔U+5586〕"


def test_marks_that_show_nothing_are_dropped(system: list[SimpleNamespace]) -> None:
    assert not system
    assert printable("王\u200b明\ufe0f\U000e0100") == "王明"
    assert unprintable("王\u200b明") == ()


def test_the_person_is_named_in_both_languages(system: list[SimpleNamespace]) -> None:
    assert not system
    (english,) = glyph_warnings(["王喆", "李明", "王喆"])
    assert english.startswith(
        "王喆: no font here has 喆 (U+5586), so the papers print 王〔U+5586〕: install"
    )
    use_language("zh")
    try:
        (chinese,) = glyph_warnings(["王喆"])
    finally:
        use_language("en")
    assert chinese != english
    assert "王〔U+5586〕" in chinese


def test_another_font_of_the_system_prints_it(tmp_path: Path, system: list[SimpleNamespace]) -> None:
    system += [font(tmp_path / "other.ttf", "堃"), font(tmp_path / "village.ttf", "喆")]
    assert printable("王喆") == "王喆"
    assert glyph_warnings(["王喆"]) == ()
    assert spare_fonts("王喆") == (tmp_path / "village.ttf",)
    pdf = FPDF()
    pdf.add_font("Noto", "", FONT_FILES[0])
    use_spare_fonts(pdf, "王喆")
    pdf.add_page()
    pdf.set_font("Noto", size=20)
    pdf.cell(0, 10, "王喆")
    page = PdfReader(io.BytesIO(bytes(pdf.output()))).pages[0]
    assert "王喆" in page.extract_text()
    assert b"village" in pdf.output()


def test_fonts_that_draw_boxes_or_may_not_be_embedded_serve_nobody(
    tmp_path: Path, system: list[SimpleNamespace]
) -> None:
    boxes = "".join(chr(0x5000 + n) for n in range(3000))
    system += [
        font(tmp_path / "last_resort.ttf", boxes),
        font(tmp_path / "kept.ttf", "喆", embedding=2),
    ]
    assert printable("喆") == "〔U+5586〕"


def test_a_font_that_is_gone_serves_nobody(tmp_path: Path, system: list[SimpleNamespace]) -> None:
    system.append(
        SimpleNamespace(fname=str(tmp_path / "x.ttf"), index=0, style="normal", weight="bold")
    )
    (tmp_path / "torn.ttf").write_bytes(b"\0\1\0\0torn")
    system.append(SimpleNamespace(fname=str(tmp_path / "torn.ttf"), style="italic", weight=400))
    assert printable("喆") == "〔U+5586〕"


def test_a_private_sign_is_never_another_fonts(tmp_path: Path, system: list[SimpleNamespace]) -> None:
    system.append(font(tmp_path / "private.ttf", "\ue863"))
    assert printable("\ue863") == "〔U+E863〕"
