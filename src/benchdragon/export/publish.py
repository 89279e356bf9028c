"""A document as one HTML page that needs nothing beside it; `pages` writes a PDF."""

import base64
import io
from functools import cache
from pathlib import Path

import matplotlib
from jinja2 import Environment, PackageLoader, StrictUndefined
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser

from benchdragon.export.document import Document, Formula, Inline, Picture, Reference, anchor_of
from benchdragon.figures.style import STYLE
from benchdragon.files import write_whole
from benchdragon.i18n import _
from benchdragon.version import __version__

# Points of type: seven tenths of it, which indices take, are more than style.LEAST_TEXT.
FORMULA_SIZE = 10.5
FORMULA_STYLE = {
    **STYLE,
    "font.family": "DejaVu Sans",
    "mathtext.fontset": "stix",
    "figure.constrained_layout.use": False,
}
# How much larger than on paper pictures and formulas are on a page, and pixels of its own to an inch.
ENLARGED, PIXELS = 1.25, 96.0


@cache
def drawn_formula(formula: Formula, kind: str) -> tuple[bytes, float]:
    """A formula as a file of a kind, "svg" or "pdf", cut to its size, and its width, inches."""
    with matplotlib.rc_context(FORMULA_STYLE):
        set_as = f"${formula.tex}$"
        parsed = MathTextParser("path").parse(set_as, 72, FontProperties(size=FORMULA_SIZE))
        width, height, depth = (float(value) for value in parsed[:3])
        figure = Figure(figsize=(width / 72.0, height / 72.0))
        figure.text(0.0, depth / height, set_as, fontsize=FORMULA_SIZE)
        made = io.BytesIO()
        dates = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
        figure.savefig(made, format=kind, transparent=True, metadata=dates[kind])
    return made.getvalue(), width / 72.0


def write_html(path: Path, document: Document, folder: Path) -> None:
    """Write one page with its pictures, SVG files of `folder`, and formulas inside."""
    environment = Environment(
        loader=PackageLoader("benchdragon"), autoescape=True, undefined=StrictUndefined
    )
    drawn: dict[str, tuple[str, float]] = {}
    for block in document.blocks:
        if isinstance(block, Picture):
            svg = (folder / f"{block.name}.svg").read_bytes()
            drawn[block.name] = _shown(svg, _svg_width(svg))
        elif isinstance(block, Formula):
            drawn[block.tex] = _shown(*drawn_formula(block, "svg"))

    def spoken(part: Inline) -> Inline:
        return document.link(part) if isinstance(part, Reference) else part

    text = environment.get_template("report.html.jinja").render(
        document=document, blocks=[(type(block).__name__, block) for block in document.blocks],
        drawn=drawn, spoken=spoken, anchor_of=anchor_of, contents=_("Contents"), version=__version__,
    )  # fmt: skip
    write_whole(path, text)


def _shown(svg: bytes, width: float) -> tuple[str, float]:
    """A picture as the page holds it, and its width, pixels."""
    return base64.b64encode(svg).decode(), ENLARGED * PIXELS * width


def _svg_width(svg: bytes) -> float:
    """The width of a picture that matplotlib has written, inches."""
    return float(svg.partition(b'width="')[2].partition(b'pt"')[0]) / 72.0
