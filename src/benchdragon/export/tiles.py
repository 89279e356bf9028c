"""A drawing too large for a printer as pages to be glued together: windows on it that overlap.

Every page shows the same drawing through another window, so that nothing can differ between them.
"""

import io
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from pypdf import PdfWriter

from benchdragon.errors import InputError
from benchdragon.export.forms import add_form, show_form, size_of
from benchdragon.export.typeset import Typeset, breakable
from benchdragon.figures.glyphs import printable
from benchdragon.files import whole_file
from benchdragon.i18n import _, language

# Around the window on each page, mm: more than printers leave white. Between neighbours' windows, mm.
BORDER, OVERLAP = 12.0, 10.0
# Pages of one drawing: rows have numbers, columns letters.
MOST_TILES, LETTERS = 400, "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
# Length of crop marks, and how far they keep from the window, mm; a line to measure on paper, mm.
CROP, CROP_GAP, RULER = 6.0, 1.0, 100.0


@dataclass(frozen=True)
class Window:
    """What a page shows: name, and left and lower edge on the drawing, mm."""

    name: str
    x: float
    y: float


@dataclass(frozen=True)
class Tiling:
    """Windows that cover a drawing, from its upper left corner on.

    Attributes:
        drawing: width and height, mm.
        page: width and height, mm.
    """

    drawing: tuple[float, float]
    page: tuple[float, float]

    @classmethod
    def of(cls, drawing: tuple[float, float], page: tuple[float, float]) -> "Tiling":
        """The tiling with the page upright or lying, whichever takes fewer.

        Raises:
            InputError: for too many pages.
        """
        best = min((cls(drawing, page), cls(drawing, page[::-1])), key=lambda one: one.count)
        if best.count > MOST_TILES or best.shape[0] > len(LETTERS):
            text = _("the drawing takes {count} pages: choose larger pages or a smaller drawing")
            raise InputError(text.format(count=best.count))
        return best

    @property
    def window(self) -> tuple[float, float]:
        """Width and height of a page's window, mm."""
        return self.page[0] - 2.0 * BORDER, self.page[1] - 2.0 * BORDER

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of columns and rows."""
        columns, rows = (
            max(1, math.ceil((whole - OVERLAP) / (part - OVERLAP) - 1e-9))
            for whole, part in zip(self.drawing, self.window, strict=True)
        )
        return columns, rows

    @property
    def count(self) -> int:
        """Number of pages."""
        return self.shape[0] * self.shape[1]

    def windows(self) -> Iterator[Window]:
        """Row by row from above, each from the left."""
        (columns, rows), (wide, tall) = self.shape, self.window
        for row in range(rows):
            for column in range(columns):
                y = self.drawing[1] - tall - row * (tall - OVERLAP)
                yield Window(f"{LETTERS[column]}{row + 1}", column * (wide - OVERLAP), y)


def write_tiles(
    drawing: bytes, path: Path, page: tuple[float, float], title: str, foot: str, date: str
) -> None:
    """Write the only page of a PDF as pages of a size, mm, after a page that tells how they lie.

    `date` is that of the day on which it is made, YYYY-MM-DD.

    Raises:
        InputError: as `Tiling.of`.
    """
    tiling = Tiling.of(size_of(drawing), page)
    frames = _Frames(tiling, title, foot, date)
    frames.draw()
    writer = PdfWriter(clone_from=io.BytesIO(bytes(frames.output())))
    form = add_form(writer, drawing)
    key, (wide, tall) = frames.key, tiling.window
    box = (*key.at, tiling.drawing[0] * key.scale, tiling.drawing[1] * key.scale)
    show_form(writer, 0, form, key.at, scale=key.scale, window=box)
    for number, one in enumerate(tiling.windows(), start=1):
        at = BORDER - one.x, BORDER - one.y
        show_form(writer, number, form, at, window=(BORDER, BORDER, wide, tall))
    with whole_file(path) as temporary, temporary.open("wb") as made:
        writer.write(made)


@dataclass(frozen=True)
class _Key:
    """The drawing on the key page: its lower left corner, mm, and how much smaller it is."""

    at: tuple[float, float]
    scale: float


class _Frames(Typeset):
    """The frames around the windows: names, crop marks; on the first page an overview of the others."""

    def __init__(self, tiling: Tiling, title: str, foot: str, date: str) -> None:
        super().__init__(date, text=title)
        self._tiling, self._title, self._foot = tiling, printable(title), foot
        self._top = 0.0
        self.set_auto_page_break(False)
        self.set_title(title)
        self.set_subject(foot)
        self.set_lang("zh-Hans" if language() == "zh" else "en")

    @property
    def key(self) -> _Key:
        """Where the drawing is shown on the key page, as large as there is room."""
        (wide, tall), (across, up) = self._tiling.drawing, self._tiling.page
        room = across - 2.0 * BORDER, up - self._top - BORDER
        scale = min(room[0] / wide, room[1] / tall)
        return _Key((0.5 * (across - wide * scale), up - self._top - tall * scale), scale)

    def draw(self) -> None:
        """Set all pages."""
        self._key_page()
        for one in self._tiling.windows():
            self.add_page(format=self._tiling.page)
            self._crop()
            self._named(one)

    def _key_page(self) -> None:
        self.add_page(format=self._tiling.page)
        self.set_xy(BORDER, BORDER)
        self._say(self._title, 14.0, "B")
        self._say(self._how(), 10.0)
        self._say(_("This line is {length} mm long on paper:").format(length=f"{RULER:g}"), 10.0)
        y = self.get_y() + 3.0
        self.set_line_width(0.3)
        left = BORDER + self.c_margin
        self.line(left, y, left + RULER, y)
        for x in (left, left + RULER):
            self.line(x, y - 1.5, x, y + 1.5)
        self._top = y + 8.0
        self._grid()
        self._low()

    def _how(self) -> str:
        """How the pages are printed, and put together where they are several."""
        columns, rows = self._tiling.shape
        text = _(
            "The drawing follows on {count} pages, in {columns} columns, A to {last}, and {rows} rows. "
            "Print at 100 % (actual size), on one side."
        ).format(count=self._tiling.count, columns=columns, last=LETTERS[columns - 1], rows=rows)
        if self._tiling.count == 1:
            return text
        gluing = _(
            "Adjacent pages overlap by {overlap} mm: cut the right and the lower edge of each page "
            "along the crop marks, and glue the pages upon one another from the lower right to the "
            "upper left, so that the lines go on."
        )
        if columns == 1:
            gluing = _(
                "Adjacent pages overlap by {overlap} mm: cut the lower edge of each page along the "
                "crop marks, and glue the pages upon one another from the lowest up, so that the "
                "lines go on."
            )
        elif rows == 1:
            gluing = _(
                "Adjacent pages overlap by {overlap} mm: cut the right edge of each page along the "
                "crop marks, and glue the pages upon one another from the right to the left, so that "
                "the lines go on."
            )
        return f"{text} {gluing.format(overlap=f'{OVERLAP:g}')}"

    def _grid(self) -> None:
        """The windows over the drawing, and their names."""
        key, (wide, tall) = self.key, self._tiling.window
        left, floor = key.at
        self.set_draw_color(213, 94, 0)
        self.set_text_color(213, 94, 0)
        size = min(14.0, 1.2 * wide * key.scale)
        self.set_font("Noto", "B", size)
        for one in self._tiling.windows():
            x, top = left + one.x * key.scale, self.h - floor - (one.y + tall) * key.scale
            right = min(x + wide * key.scale, left + self._tiling.drawing[0] * key.scale)
            low = min(top + tall * key.scale, self.h - floor)
            self.rect(x, top, right - x, low - top)
            self.set_xy(x, 0.5 * (top + low) - 0.25 * size)
            self.cell(right - x, 0.5 * size, one.name, align="C")
        self.set_draw_color(0)
        self.set_text_color(0)

    def _crop(self) -> None:
        """Marks at the corners of the window, outside it."""
        (wide, tall), near, far = self._tiling.window, CROP_GAP, CROP_GAP + CROP
        self.set_line_width(0.15)
        for x, out in ((BORDER, -1.0), (BORDER + wide, 1.0)):
            for y, up in ((BORDER, -1.0), (BORDER + tall, 1.0)):
                self.line(x + out * near, y, x + out * far, y)
                self.line(x, y + up * near, x, y + up * far)

    def _named(self, one: Window) -> None:
        """The page's name above its window, in the middle, and what it is below."""
        self.set_font("Noto", "B", 11)
        self.set_xy(BORDER + 10.0, 3.0)
        self.cell(self.w - 2.0 * BORDER - 20.0, 6.0, one.name, align="C")
        self._low()

    def _low(self) -> None:
        self.set_font("Noto", size=7)
        self.set_xy(BORDER + 10.0, self.h - 8.0)
        self.cell(self.w - 2.0 * BORDER - 20.0, 4.0, f"{self._title} · {self._foot}", align="C")

    def _say(self, text: str, size: float, style: str = "") -> None:
        self.set_font("Noto", style, size)
        self.multi_cell(
            self.w - 2.0 * BORDER, 0.5 * size, breakable(text), align="L", new_x="LMARGIN", new_y="NEXT"
        )
        self.set_xy(BORDER, self.get_y() + 2.0)
