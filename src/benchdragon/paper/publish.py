"""The report as files: one HTML page that needs nothing beside it, and a PDF."""

import base64
import re
from pathlib import Path
from typing import Any

from fpdf import FPDF, FontFace
from fpdf.enums import TableHeadingsDisplay
from fpdf.image_parsing import preload_image
from fpdf.line_break import TextLine
from jinja2 import Environment, PackageLoader, StrictUndefined
from matplotlib import font_manager

from benchdragon.figures.style import FONT_FILES
from benchdragon.files import whole_file
from benchdragon.paper.document import (
    Block,
    Document,
    Formula,
    Heading,
    Inline,
    Link,
    Paragraph,
    Picture,
    Table,
)
from benchdragon.version import __version__

# Sizes of the PDF: mm, and points of type.
MARGIN, LINE = 15.0, 5.2
TEXT_SIZE, TABLE_SIZE, HEAD_SIZES = 9.5, 7.0, {1: 15.0, 2: 11.5}
TALLEST_PICTURE = 88.0
EDGE, SHADE, LINK_COLOUR = (150, 150, 150), (235, 235, 235), (0, 84, 148)
WEIGHTS = {"": "normal", "B": "bold"}
# Chinese text may break after any sign; fpdf2 breaks where this stands, for which Noto has no glyph.
BREAK = "\u200b"
BREAKABLE = re.compile(
    r"([\u3000-\u9fff\uff00-\uffef])(?![\uff0c\u3002\uff1b\uff1a\u3001\uff09\u201d])"
)


def write_html(path: Path, document: Document, folder: Path) -> None:
    """Write one page with its pictures, PNG files of `folder`, inside."""
    environment = Environment(
        loader=PackageLoader("benchdragon"), autoescape=True, undefined=StrictUndefined
    )
    names = [block.name for block in document.blocks if isinstance(block, Picture)]
    pictures = {
        name: base64.b64encode((folder / f"{name}.png").read_bytes()).decode() for name in names
    }
    text = environment.get_template("report.html.jinja").render(
        document=document,
        blocks=[(type(block).__name__, block) for block in document.blocks],
        pictures=pictures,
        version=__version__,
    )
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


class Pages(FPDF):
    """A4 pages with numbers at their feet, and chapters that links lead to."""

    def __init__(self, document: Document, folder: Path) -> None:
        super().__init__(format="A4")
        self._document, self._folder = document, folder
        for style, file in zip(("", "B"), FONT_FILES, strict=True):
            self.add_font("Noto", style, file)
            self.add_font("DejaVu", style, font_manager.findfont(f"DejaVu Sans:{WEIGHTS[style]}"))
        self.set_fallback_fonts(["DejaVu"], exact_match=False)
        self.set_margin(MARGIN)
        self.set_auto_page_break(True, MARGIN)
        self.set_title(document.title)
        self.set_creator(f"benchdragon {__version__}")
        self.set_lang("zh-Hans" if document.language == "zh" else "en")
        headings = [block for block in document.blocks if isinstance(block, Heading)]
        # A link must lead somewhere before its chapter is set: to the first page until then.
        self._links = {block.anchor: self.add_link(page=1) for block in headings}

    def _render_styled_text_line(self, text_line: TextLine, *details: Any, **more: Any) -> bool:
        """Set a line without its marks: lines are broken by now, and who searches finds whole words."""
        for fragment in text_line.fragments:
            fragment.characters = [sign for sign in fragment.characters if sign != BREAK]
        return super()._render_styled_text_line(text_line, *details, **more)

    def footer(self) -> None:
        """Put the page's number at its foot."""
        self.set_y(-MARGIN + 4.0)
        self.set_font("Noto", size=8)
        self.cell(0, 4, f"benchdragon {__version__} · {self.page_no()}", align="C")

    def write_all(self) -> None:
        """Set the title and all blocks."""
        self.add_page()
        self._spoken(self._document.title, HEAD_SIZES[1] + 4.0, bold=True)
        self.ln(3.0)
        for block in self._document.blocks:
            self._set(block)

    def _set(self, block: Block) -> None:
        match block:
            case Heading():
                self._heading(block)
            case Paragraph():
                self.set_font("Noto", size=TEXT_SIZE)
                for part in block.words:
                    self._write(part)
                self.ln(LINE + 2.0)
            case Formula():
                self.set_x(MARGIN + 8.0)
                self._spoken(block.text, TEXT_SIZE)
            case Table():
                self._table(block)
            case Picture():
                self._picture(block)

    def _heading(self, block: Heading) -> None:
        if self.get_y() > (0.75 if block.level == 1 else 0.85) * self.h:
            self.add_page()
        self.ln(3.0)
        self.set_link(self._links[block.anchor], page=self.page_no(), y=self.get_y())
        self.start_section(block.text, block.level - 1)
        self._spoken(block.text, HEAD_SIZES[block.level], bold=True)
        self.ln(1.5)

    def _spoken(self, text: str, size: float, bold: bool = False) -> None:
        self.set_font("Noto", "B" if bold else "", size)
        self.multi_cell(0, 0.5 * size, breakable(text), align="L", new_x="LMARGIN", new_y="NEXT")

    def _write(self, part: Inline) -> None:
        if isinstance(part, str):
            self.write(LINE, breakable(part))
            return
        self.set_text_color(*LINK_COLOUR)
        self.write(LINE, breakable(part.text), self._target(part))
        self.set_text_color(0)

    def _target(self, link: Link) -> int | str:
        return self._links[link.target[1:]] if link.target.startswith("#") else link.target

    def _table(self, block: Table) -> None:
        self.set_font("Noto", size=TABLE_SIZE)
        self.set_draw_color(*EDGE)
        head = FontFace(emphasis="BOLD", fill_color=SHADE)
        linked = FontFace(color=LINK_COLOUR)
        with self.table(
            col_widths=block.widths, line_height=0.52 * TABLE_SIZE, padding=0.8, headings_style=head,
            text_align=["LEFT", *["RIGHT" if block.numbers else "LEFT"] * (len(block.columns) - 1)],
            repeat_headings=TableHeadingsDisplay.ON_TOP_OF_EVERY_PAGE, v_align="TOP",
        ) as table:  # fmt: skip
            headings = table.row()
            for name in block.columns:
                headings.cell(breakable(name))
            for cells in block.rows:
                row = table.row()
                for cell in cells:
                    if isinstance(cell, Link):
                        row.cell(breakable(cell.text), style=linked, link=self._target(cell))
                    else:
                        row.cell(breakable(cell))
        self.ln(3.0)

    def _picture(self, block: Picture) -> None:
        path = self._folder / f"{block.name}.png"
        image = preload_image(self.image_cache, path)[2]
        width, height = image.width, image.height
        scale = min(self.epw / width, TALLEST_PICTURE / height)
        if self.get_y() + scale * height + 8.0 > self.h - MARGIN:
            self.add_page()
        self.image(
            path, x=MARGIN + 0.5 * (self.epw - scale * width), w=scale * width, alt_text=block.caption
        )
        self.set_font("Noto", size=TEXT_SIZE - 1.0)
        self.multi_cell(0, 4.5, breakable(block.caption), align="C", new_x="LMARGIN", new_y="NEXT")
        self.ln(2.0)


def breakable(text: str) -> str:
    """Text in which lines may break after Chinese signs, but not before their stops."""
    return BREAKABLE.sub(rf"\1{BREAK}", text)


def write_pdf(path: Path, document: Document, folder: Path) -> None:
    """Write the report as a PDF with the PNG pictures of `folder`, an outline and links."""
    pages = Pages(document, folder)
    pages.write_all()
    with whole_file(path) as temporary:
        pages.output(temporary)
