"""What sets the report's PDF: `export/pages.py` on fpdf2, or Typst.

The report of `benchdragon reproduce`, which takes a minute to compute, is set by both, from the same
pictures and formulas, in English. Said of each: seconds, pages, how many of them are more than a third
empty, the size of the file, and what its packages take on the disk. Lines are those of the modules
here; the functions from `quoted` to `by_typst` below are what would stand in their place.

Typst 0.15.2 sets 15 pages where fpdf2 sets 17, in the same time; of both only the last is a third
empty. It would save some 370 lines, and each machine on which the package is installed would have 84 MB
for one file where fpdf2 and pypdf are 7. So the report stays as it is: who needs no PDF has the same
report as a page.

Without the package typst (it is not among those that tests install) this page says so, and shows the
first half alone.
"""

import importlib.util
import json
import tempfile
import time
from collections.abc import Callable, Iterator
from importlib import metadata
from pathlib import Path

import numpy as np
from pypdfium2 import PdfDocument

from benchdragon.export import forms, pages, typeset
from benchdragon.export.document import (
    Document,
    Formula,
    Heading,
    Inline,
    Listing,
    Paragraph,
    Picture,
    Reference,
    Table,
    anchor_of,
)
from benchdragon.export.pages import write_pdf
from benchdragon.export.publish import drawn_formula
from benchdragon.figures.style import FONT_FILES
from benchdragon.paper import report, reproduce
from benchdragon.paper.results import Results

STYLE = """
#set page(paper: "a4", margin: 15mm, numbering: "1")
#set text(font: ("Noto Sans SC", "DejaVu Sans"), size: 9.5pt)
#set figure(numbering: none)
#set table(stroke: 0.2pt + gray, inset: 2pt)
#show table: set text(size: 7.5pt)
#show figure.caption: set text(size: 8.5pt)
#show figure.where(kind: table): set block(breakable: true)
#show figure.where(kind: table): set figure.caption(position: top)
#show link: set text(fill: rgb(0, 84, 148))
"""


def quoted(text: str) -> str:
    """A text as a literal of Typst."""
    return json.dumps(text, ensure_ascii=False)


def words(document: Document, parts: tuple[Inline, ...]) -> str:
    """Words with their links."""
    said = []
    for part in parts:
        link = document.link(part) if isinstance(part, Reference) else part
        if isinstance(link, str):
            said.append(f"#{quoted(link)}")
        else:
            at = link.target
            to = f"<{at[1:]}>" if at.startswith("#") else quoted(at)
            said.append(f"#link({to})[#{quoted(link.text)}]")
    return "".join(said)


def markup(document: Document, folder: Path) -> Iterator[str]:
    """The document in Typst's markup; formulas are drawn into the folder."""
    yield STYLE
    yield f"#text(size: 19pt, weight: 700)[#{quoted(document.title)}]"
    yield f"#{quoted(document.date)}\n#outline()"
    for number, block in enumerate(document.blocks):
        if isinstance(block, Heading):
            yield f"#heading(level: {block.level}, {quoted(block.text)}) <{block.anchor}>"
        elif isinstance(block, Paragraph):
            yield words(document, block.words)
        elif isinstance(block, Listing):
            yield f"#text(size: 8.5pt, {quoted(block.text)})"
        elif isinstance(block, Formula):
            path = folder / f"formula-{number}.pdf"
            path.write_bytes(drawn_formula(block, "pdf")[0])
            yield f"#pad(left: 8mm, image({quoted(path.name)}, alt: {quoted(block.text)}))"
        else:
            yield shown(document, block)


def shown(document: Document, block: Table | Picture) -> str:
    """A table or a picture with its caption."""
    caption = f"caption: [#{quoted(f'{document.labels[block.name]}. {block.caption}')}]"
    if isinstance(block, Picture):
        body = f"placement: auto, image({quoted(f'{block.name}.pdf')})"
    else:
        widths = ", ".join(f"{width}fr" for width in block.widths)
        aligned = ", ".join(
            ["left", *["right" if block.numbers else "left"] * (len(block.columns) - 1)]
        )
        head = ", ".join(f"[*#{quoted(name)}*]" for name in block.columns)
        cells = ", ".join(f"[{words(document, (cell,))}]" for row in block.rows for cell in row)
        body = f"table(columns: ({widths},), align: ({aligned},), table.header({head}), {cells})"
    return f"#figure({body}, {caption}) <{anchor_of(block.name)}>"


def by_typst(path: Path, document: Document, folder: Path) -> None:
    """Set the document by Typst."""
    import typst

    source = folder / "report.typ"
    source.write_text("\n\n".join(markup(document, folder)), "utf-8")
    fonts = [str(Path(file).parent) for file in FONT_FILES]
    typst.compile(str(source), output=str(path), font_paths=fonts)


def empty_pages(path: Path) -> tuple[int, int]:
    """How many pages there are, and how many are empty in their lowest third, but for the number."""
    made, count = PdfDocument(path), 0
    for page in made:
        dots = page.render(scale=0.5, grayscale=True).to_numpy().squeeze()
        body = dots[: int(0.93 * len(dots))]
        lowest = np.flatnonzero((body < 200).any(axis=1)).max(initial=0)
        count += bool(lowest < 2 / 3 * len(dots))
    return len(made), count


def on_disk(*packages: str) -> float:
    """What packages take, MB."""
    files = [file for name in packages for file in metadata.files(name) or ()]
    paths = [Path(file.locate()) for file in files]
    return sum(path.stat().st_size for path in paths if path.exists()) / 1e6


def show(
    name: str, document: Document, folder: Path, made_by: Callable[[Path, Document, Path], None]
) -> None:
    """Set the document, and print what came of it."""
    path = folder / f"{name}.pdf"
    began = time.perf_counter()
    made_by(path, document, folder)
    took = time.perf_counter() - began
    count, empty = empty_pages(path)
    size = path.stat().st_size / 1e6
    print(f"{name}: {took:.1f} s, {count} pages, {empty} a third empty, {size:.2f} MB")


def main() -> None:
    """Print what each takes."""
    ours = sum(
        len(Path(str(one.__file__)).read_text("utf-8").splitlines()) for one in (pages, typeset, forms)
    )
    print(f"lines: {ours} of pages.py, typeset.py and forms.py")
    print(f"on the disk: fpdf2 and pypdf {on_disk('fpdf2', 'pypdf'):.0f} MB")
    kept: list[Document] = []
    written = report.report

    def keep(found: Results, docs: str | None = None) -> Document:
        kept.append(written(found, docs))
        return kept[0]

    setattr(reproduce, "report", keep)  # noqa: B010, as what it imports is nobody else's
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        reproduce.reproduce(folder)
        show("fpdf2", kept[0], folder, write_pdf)
        if importlib.util.find_spec("typst") is None:
            print("typst: not here (pip install typst)")
            return
        print(f"on the disk: typst {on_disk('typst'):.0f} MB")
        show("typst", kept[0], folder, by_typst)


if __name__ == "__main__":
    main()
