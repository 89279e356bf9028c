"""PDF pages in the package's fonts: Chinese lines that break, signs of names by fonts of the system."""

import re
from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any

from fpdf import FPDF
from fpdf.fonts import TTFFont
from fpdf.line_break import TextLine
from matplotlib import font_manager

from benchdragon.figures.glyphs import printable, spare_fonts
from benchdragon.figures.style import FONT_FILES
from benchdragon.version import __version__

WEIGHTS = {"": "normal", "B": "bold"}
# Chinese text may break after any sign; fpdf2 breaks where this stands, for which Noto has no glyph.
BREAK = "\u200b"
STOPS, OPENING = "\uff0c\u3002\uff1b\uff1a\u3001\uff09\u201d\u300d\u300b", "\uff08\u201c\u300c\u300a"
BREAKABLE = re.compile(rf"([\u3000-\u9fff\uff00-\uffef])(?<![{OPENING}])(?![{STOPS}])")


def use_spare_fonts(pdf: FPDF, text: str, others: Sequence[str] = ()) -> None:
    """Let a PDF print signs of `text` by fonts of the system, after its own and the `others`.

    What no font has must be replaced before: see figures.glyphs.printable.
    """
    names = list(others)
    for path in spare_fonts(text):
        name = f"Spare {path.stem}".lower()
        if name not in pdf.fonts:
            pdf.add_font(name, "", path)
        names.append(name)
    pdf.set_fallback_fonts(names, exact_match=False)


class Typeset(FPDF):
    """A4 pages on which both languages can be set; the same text gives the same bytes.

    Args:
        date: of the day on which it is made, YYYY-MM-DD.
        text: all that will be set, for signs that the package's fonts lack.
        other: pages whose fonts, which take a third of a second to read, are used again.
    """

    def __init__(self, date: str, text: str = "", other: "Typeset | None" = None) -> None:
        super().__init__(format="A4")
        if other is None:
            self._read_fonts()
        else:
            self.fonts.update(other.fonts)
        use_spare_fonts(self, text, ["DejaVu"])
        self.set_creator(f"benchdragon {__version__}")
        self.set_creation_date(datetime.fromisoformat(date).replace(tzinfo=UTC))

    def _read_fonts(self) -> None:
        for style, file in zip(("", "B"), FONT_FILES, strict=True):
            self.add_font("Noto", style, file)
            self.add_font("DejaVu", style, font_manager.findfont(f"DejaVu Sans:{WEIGHTS[style]}"))
            noto = self.fonts[f"noto{style}"]
            if isinstance(noto, TTFFont):  # else each mark would be a fragment of the other font
                noto.cmap[ord(BREAK)], noto.cw[ord(BREAK)] = noto.cmap[ord(" ")], 0

    def _render_styled_text_line(self, text_line: TextLine, *details: Any, **more: Any) -> bool:
        """Set a line without its marks: lines are broken by now, and who searches finds whole words."""
        for fragment in text_line.fragments:
            fragment.characters = [sign for sign in fragment.characters if sign != BREAK]
        return super()._render_styled_text_line(text_line, *details, **more)


def breakable(text: str) -> str:
    """Text as it can be printed, with lines that may break after Chinese signs, not before stops.

    Signs that no font here has become their code, so that all that is set goes through here.
    """
    return BREAKABLE.sub(rf"\1{BREAK}", printable(text))
