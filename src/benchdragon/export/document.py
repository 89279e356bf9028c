"""A document: headings, words with links, listings, tables, formulas, pictures, in one language."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from string import Formatter

from benchdragon.i18n import _


@dataclass(frozen=True)
class Link:
    """Words that lead to a chapter ("#name") or to a page elsewhere."""

    text: str
    target: str


@dataclass(frozen=True)
class Reference:
    """The number of a table or a picture, by its name; leads there."""

    name: str


Inline = str | Link | Reference


@dataclass(frozen=True)
class Heading:
    """A heading; level 1 is a chapter. The anchor is what links lead to.

    What follows takes so much room, mm, on the same page of a PDF.
    """

    text: str
    anchor: str
    level: int = 1
    room: float = 0.0


@dataclass(frozen=True)
class Paragraph:
    """Words, some of which may be links."""

    words: tuple[Inline, ...]


@dataclass(frozen=True)
class Formula:
    """A formula by itself, in the TeX that matplotlib sets; `text` for those who cannot see it."""

    tex: str
    text: str


@dataclass(frozen=True)
class Listing:
    """Lines as they are typed, or stand in a file."""

    text: str


@dataclass(frozen=True)
class Table:
    """Columns with their shares of the width, and rows of words; numbers stand to the right."""

    name: str
    caption: str
    columns: tuple[str, ...]
    widths: tuple[float, ...]
    rows: tuple[tuple[Inline, ...], ...]
    numbers: bool = False


@dataclass(frozen=True)
class Picture:
    """A picture by its name in the folder that `publish.write_html` is given, and what it shows."""

    name: str
    caption: str


Block = Heading | Paragraph | Formula | Listing | Table | Picture


@dataclass(frozen=True)
class Document:
    """All of it.

    Attributes:
        title: above all.
        language: "en" or "zh".
        date: of the day on which it was made, YYYY-MM-DD.
        blocks: from the first to the last; the contents stand before the first heading.
        foot: the text at the foot of each page before its number.
        dated: the text below the title; the date if it is "".
    """

    title: str
    language: str
    date: str
    blocks: tuple[Block, ...]
    foot: str = ""
    dated: str = ""

    @property
    def headings(self) -> list[Heading]:
        """Headings of all levels, in order."""
        return [block for block in self.blocks if isinstance(block, Heading)]

    @cached_property
    def labels(self) -> dict[str, str]:
        """Labels of tables and pictures, "Figure 3", by their names; kinds are numbered apart."""
        kinds = ((Picture, _("Figure {number}")), (Table, _("Table {number}")))
        return {
            block.name: text.format(number=number)
            for kind, text in kinds
            for number, block in enumerate(
                (block for block in self.blocks if isinstance(block, kind)), start=1
            )
        }

    def link(self, reference: Reference) -> Link:
        """A reference as a link."""
        return Link(self.labels[reference.name], f"#{anchor_of(reference.name)}")


def anchor_of(name: str) -> str:
    """What links to a table or a picture lead to."""
    return f"shown-{name}"


def say(text: str, **values: object) -> Paragraph:
    """A text of the catalogue with values in it, some of which may be links, as a paragraph.

    A name in braces without a value refers to the table or the picture of that name. Sentences may be
    joined by a space; Chinese has none after a full stop.
    """
    return Paragraph(tuple(_filled(_(text).replace("。 ", "。"), values)))


def _filled(text: str, values: dict[str, object]) -> Iterator[Inline]:
    plain = ""
    for before, name, _format, _conversion in Formatter().parse(text):
        plain += before
        value = values.get(name, Reference(name)) if name else ""
        if isinstance(value, Link | Reference):
            yield from (part for part in (plain, value) if part)
            plain = ""
        else:
            plain += str(value)
    if plain:
        yield plain
