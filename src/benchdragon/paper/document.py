"""A document: headings, words with links, tables, formulas and names of pictures, in one language."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Link:
    """Words that lead to a chapter of the report ("#name") or to a page elsewhere."""

    text: str
    target: str


Inline = str | Link


@dataclass(frozen=True)
class Heading:
    """A heading; level 1 is a chapter. The anchor is what links lead to."""

    text: str
    anchor: str
    level: int = 1


@dataclass(frozen=True)
class Paragraph:
    """Words, some of which may be links."""

    words: tuple[Inline, ...]


@dataclass(frozen=True)
class Formula:
    """A line by itself."""

    text: str


@dataclass(frozen=True)
class Table:
    """Columns with their shares of the width, and rows of words; numbers stand to the right."""

    columns: tuple[str, ...]
    widths: tuple[float, ...]
    rows: tuple[tuple[Inline, ...], ...]
    numbers: bool = False


@dataclass(frozen=True)
class Picture:
    """A picture by its name in `reproduce.PICTURES`, and what it shows."""

    name: str
    caption: str


Block = Heading | Paragraph | Formula | Table | Picture


@dataclass(frozen=True)
class Document:
    """The whole report."""

    title: str
    language: str
    blocks: tuple[Block, ...]

    @property
    def chapters(self) -> list[Heading]:
        """Headings of the first level."""
        return [block for block in self.blocks if isinstance(block, Heading) and block.level == 1]
