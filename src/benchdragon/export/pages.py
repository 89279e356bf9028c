"""A document as a PDF: A4 pages, contents, an outline, links; pictures and formulas as drawn."""

import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fpdf import FontFace
from fpdf.enums import MethodReturnValue, TableHeadingsDisplay
from pypdf import PdfWriter

from benchdragon.export.document import (
    Block,
    Document,
    Formula,
    Heading,
    Inline,
    Link,
    Listing,
    Paragraph,
    Picture,
    Reference,
    Table,
    anchor_of,
)
from benchdragon.export.forms import add_form, show_form, size_of
from benchdragon.export.publish import drawn_formula
from benchdragon.export.typeset import OPENING, STOPS, Typeset, breakable
from benchdragon.files import whole_file
from benchdragon.i18n import _
from benchdragon.version import __version__

# Sizes of the PDF: mm, and points of type.
MARGIN, LINE = 15.0, 5.2
TEXT_SIZE, TABLE_SIZE, SMALL, HEAD_SIZES = 9.5, 7.5, 8.5, {1: 15.0, 2: 11.5}
EDGE, SHADE, LINK_COLOUR = (150, 150, 150), (235, 235, 235), (0, 84, 148)
# Room on a page, mm, that a heading needs for itself and two lines, a table for its caption and some
# rows, and a caption. A table of numbers goes to the next page whole if no more is left empty than
# this, with pictures waiting for that page, and without.
HEADING_ROOM, TABLE_ROOM, CAPTION = 26.0, 32.0, 6.0
MOST_EMPTY_BEFORE_PICTURES, MOST_EMPTY = 75.0, 50.0
ROW, PADDING = 0.5, 0.7
# Headings of a document that has no contents, at most.
WITHOUT_CONTENTS = 3
# Pictures that found no room on a page stand at the head of the next, as far down as this share of it.
HEAD_SHARE = 0.85


@dataclass(frozen=True)
class Drawn:
    """A picture in place: a page of a PDF file, the number of the page that it is laid on, and where.

    x and y, mm, are those of its lower left corner, from the page's lower left corner.
    """

    file: bytes
    page: int
    x: float
    y: float


class Pages(Typeset):
    """A4 pages with numbers at their feet, and chapters that links lead to.

    Pictures are left blank here; `drawn` says what belongs where.

    Args:
        document: what to write.
        folder: of the pictures.
        sketch: the same pages as they were set before; for the contents, it knows on which each heading
            stands, and its fonts, which take a third of a second to read, are used again.
    """

    def __init__(self, document: Document, folder: Path, sketch: "Pages | None" = None) -> None:
        super().__init__(document.date, text=repr(document), other=sketch)
        self._document, self._folder = document, folder
        self._pages = {} if sketch is None else sketch.found
        self._waiting: list[Picture] = []
        self.drawn: list[Drawn] = []
        self.found: dict[str, int] = {}
        self.set_margin(MARGIN)
        self.set_auto_page_break(True, MARGIN)
        self.set_title(document.title)
        self.set_lang("zh-Hans" if document.language == "zh" else "en")
        anchors = [heading.anchor for heading in document.headings]
        # A link must lead somewhere before its chapter is set: to the first page until then.
        names = [anchor_of(name) for name in document.labels]
        self._links = {anchor: self.add_link(page=1) for anchor in [*anchors, *names]}

    def header(self) -> None:
        """Put pictures that found no room before at the head of the page."""
        self.set_text_color(0)  # fpdf2 takes up the colour of a link that goes on below
        while self._waiting:
            picture = self._waiting[0]
            if self.get_y() > MARGIN and self._height(picture) > HEAD_SHARE * self.h - self.get_y():
                break
            self._place(self._waiting.pop(0))

    def footer(self) -> None:
        """Put the page's number at its foot."""
        self.set_text_color(0)
        self.set_y(-MARGIN + 4.0)
        self.set_font("Noto", size=8)
        parts = [f"benchdragon {__version__}", self._document.foot, str(self.page_no())]
        self.cell(0, 4, " · ".join(part for part in parts if part), align="C")

    def write_all(self) -> None:
        """Set the title, the contents and all blocks."""
        self.add_page()
        self._spoken(self._document.title, HEAD_SIZES[1] + 4.0, bold=True)
        self._spoken(self._document.dated or self._document.date, TEXT_SIZE)
        self.ln(3.0)
        opening = True
        for block in self._document.blocks:
            if opening and isinstance(block, Heading):
                if len(self._document.headings) > WITHOUT_CONTENTS:
                    self._contents()
                opening = False
            self._set(block)
        while self._waiting:
            self.add_page()

    def _contents(self) -> None:
        self._spoken(_("Contents"), HEAD_SIZES[2], bold=True)
        self.ln(1.0)
        for heading in self._document.headings:
            self.set_font("Noto", "B" if heading.level == 1 else "", SMALL)
            self.set_x(MARGIN + 6.0 * (heading.level - 1))
            link = self._links[heading.anchor]
            page = str(self._pages.get(heading.anchor, 0))
            self.cell(self.epw - 20.0, 4.6, heading.text, link=link)
            self.set_x(self.w - MARGIN - 14.0)
            self.cell(14.0, 4.6, page, align="R", link=link, new_x="LMARGIN", new_y="NEXT")
        self.ln(2.0)

    def _set(self, block: Block) -> None:
        match block:
            case Heading():
                self._heading(block)
            case Paragraph():
                self.set_font("Noto", size=TEXT_SIZE)
                self._words(block.words)
                self.ln(LINE + 2.0)
            case Formula():
                self._formula(block)
            case Listing():
                self._spoken(block.text, SMALL)
                self.ln(2.0)
            case Table():
                self._table(block)
            case Picture():
                self._picture(block)

    def _heading(self, block: Heading) -> None:
        if self.get_y() > self.h - MARGIN - HEADING_ROOM - block.room:
            self.add_page()
        self.ln(3.0)
        self._arrive(block.anchor)
        self.start_section(block.text, block.level - 1)
        self._spoken(block.text, HEAD_SIZES[block.level], bold=True)
        self.ln(1.5)

    def _arrive(self, anchor: str) -> None:
        """Links to an anchor lead here."""
        self.found[anchor] = self.page_no()
        self.set_link(self._links[anchor], page=self.page_no(), y=self.get_y())

    def _spoken(self, text: str, size: float, bold: bool = False, align: str = "L") -> None:
        self.set_font("Noto", "B" if bold else "", size)
        self.multi_cell(0, 0.5 * size, breakable(text), align=align, new_x="LMARGIN", new_y="NEXT")

    def _words(self, words: Sequence[Inline]) -> None:
        """Set words; a link stands whole on a line, with the bracket before it and its stops."""
        opened = ""
        for part, after in zip(words, [*words[1:], ""], strict=True):
            if isinstance(part, str):
                text = part.rstrip(OPENING + "(")
                self.write(LINE, breakable(text))
                opened = part[len(text) :]
                continue
            link = self._document.link(part) if isinstance(part, Reference) else part
            stops = (
                after[: len(after) - len(after.lstrip(STOPS + ".,;:)"))]
                if isinstance(after, str)
                else ""
            )
            room = self.w - MARGIN - self.get_x() - 2.0 * self.c_margin
            if self.get_string_width(opened + link.text + stops) > room and self.get_x() > MARGIN:
                self.ln(LINE)
            self.write(LINE, opened)
            opened = ""
            self.set_text_color(*LINK_COLOUR)
            self.write(LINE, link.text, self._target(link))
            self.set_text_color(0)
        self.write(LINE, opened)

    def _target(self, link: Link) -> int | str:
        return self._links[link.target[1:]] if link.target.startswith("#") else link.target

    def _formula(self, block: Formula) -> None:
        file, _width = drawn_formula(block, "pdf")
        _wide, height = size_of(file)
        if self.get_y() + height > self.h - MARGIN:
            self.add_page()
        self._lay(file, MARGIN + 8.0, block.text)
        self.ln(2.0)

    def _table(self, block: Table) -> None:
        while self._room() < self._needed(block):
            self.add_page()
        self._arrive(anchor_of(block.name))
        self._spoken(self._caption(block), SMALL)
        self.ln(1.0)
        self.set_font("Noto", size=TABLE_SIZE)
        self.set_draw_color(*EDGE)
        head = FontFace(emphasis="BOLD", fill_color=SHADE)
        linked = FontFace(color=LINK_COLOUR)
        with self.table(
            col_widths=block.widths, line_height=ROW * TABLE_SIZE, padding=PADDING, headings_style=head,
            text_align=["LEFT", *["RIGHT" if block.numbers else "LEFT"] * (len(block.columns) - 1)],
            repeat_headings=TableHeadingsDisplay.ON_TOP_OF_EVERY_PAGE, v_align="TOP",
        ) as table:  # fmt: skip
            headings = table.row()
            for name in block.columns:
                headings.cell(breakable(name))
            for cells in block.rows:
                row = table.row()
                for cell in cells:
                    if isinstance(cell, str):
                        row.cell(breakable(cell))
                        continue
                    link = self._document.link(cell) if isinstance(cell, Reference) else cell
                    row.cell(breakable(link.text), style=linked, link=self._target(link))
        self.ln(4.0)

    def _caption(self, block: Table | Picture) -> str:
        return f"{self._document.labels[block.name]}. {block.caption}"

    def _room(self) -> float:
        """What is left of the page, mm."""
        return float(self.h - MARGIN - self.get_y())

    def _needed(self, block: Table) -> float:
        """Room that a table needs to begin on a page, mm.

        One of numbers, a line to a row, stands whole unless that leaves too much empty. Pictures that
        wait would part it: then more may be left empty.
        """
        if not block.numbers:
            return TABLE_ROOM
        whole = CAPTION + (len(block.rows) + 1) * (ROW * TABLE_SIZE + 2.0 * PADDING)
        return min(whole, MOST_EMPTY_BEFORE_PICTURES if self._waiting else MOST_EMPTY)

    def _picture(self, block: Picture) -> None:
        """Place a picture where there is room: pictures keep their order."""
        if self._waiting or self.get_y() + self._height(block) > self.h - MARGIN:
            self._waiting.append(block)
        else:
            self._place(block)

    def _file(self, block: Picture) -> bytes:
        return (self._folder / f"{block.name}.pdf").read_bytes()

    def _height(self, block: Picture) -> float:
        """How much of a page a picture takes with its caption, mm."""
        self.set_font("Noto", size=SMALL)
        text = breakable(self._caption(block))
        words: Any = self.multi_cell(
            0, 0.5 * SMALL, text, dry_run=True, output=MethodReturnValue.HEIGHT
        )
        return size_of(self._file(block))[1] + float(words) + 4.0

    def _place(self, block: Picture) -> None:
        file = self._file(block)
        self._arrive(anchor_of(block.name))
        self._lay(file, MARGIN + 0.5 * (self.epw - size_of(file)[0]), block.caption)
        self._spoken(self._caption(block), SMALL, align="C")
        self.ln(4.0)

    def _lay(self, file: bytes, x: float, text: str) -> None:
        """Leave room for a picture, say what it is to those who cannot see it, and note its place."""
        width, height = size_of(file)
        y = self.get_y()
        self.set_fill_color(255)
        with self._marked_sequence(alt_text=text):
            self.rect(x, y, width, height, style="F")
        self.drawn.append(Drawn(file, self.page_no(), x, self.h - y - height))
        self.set_xy(MARGIN, y + height)


def write_pdf(path: Path, document: Document, folder: Path) -> None:
    """Write a document as a PDF with the PDF pictures of `folder`, contents, an outline and links.

    It is set twice: the first time tells the pages of the contents.
    """
    sketch = Pages(document, folder)
    sketch.write_all()
    pages = Pages(document, folder, sketch)
    pages.write_all()
    writer = PdfWriter(clone_from=io.BytesIO(bytes(pages.output())))
    for drawn in pages.drawn:
        form = add_form(writer, drawn.file)
        show_form(writer, drawn.page - 1, form, (drawn.x, drawn.y))
    with whole_file(path) as temporary, temporary.open("wb") as made:
        writer.write(made)
