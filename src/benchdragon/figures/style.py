"""How pictures look: fonts, colours, titles, and writing them as files with their plan's hash."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib import font_manager
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ft2font import FT2Font

from benchdragon.files import whole_bytes
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.version import __version__

FONT_FOLDER = Path(__file__).parents[1] / "fonts"
FONT_FILES = tuple(FONT_FOLDER / f"NotoSansSC-{weight}.ttf" for weight in ("Regular", "Bold"))
# A figure is drawn at the size at which it is printed: inches across the text of an A4 page. There no
# text is smaller than LEAST_TEXT, in points; TINY makes the exponents of its labels as large as that.
PAGE_WIDTH = 7.05
LEAST_TEXT, TINY = 7.0, 10.0
# Dots an inch of PNG files.
DOTS = 220
# Fixed, so that the same plan gives the same bytes.
STYLE: Any = {
    "font.family": ["Noto Sans SC", "DejaVu Sans"],
    "pdf.fonttype": 42,
    "svg.fonttype": "path",
    "svg.hashsalt": "benchdragon",
    "figure.constrained_layout.use": True,
    "font.size": 9.0,
    "figure.titlesize": 10.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 8.5,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 7.5,
    "mathtext.fontset": "dejavusans",
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.alpha": 0.3,
}
# Okabe and Ito's colours, told apart by colour-blind people too.
BODY, HEAD, ROUTE, DISC = "#56B4E9", "#D55E00", "#999999", "#009E73"
# Colours of speeds beyond the scale of a map.
ABOVE, BELOW = HEAD, BODY
# Okabe and Ito's colours and marks that differ too.
SERIES = (
    (HEAD, "o", "-"), (BODY, "s", "--"), (DISC, "^", "-."), ("#CC79A7", "D", ":"),
    ("#E69F00", "v", (0, (5, 1, 1, 1, 1, 1))), ("#000000", "x", "-"),
)  # fmt: skip


class MissingGlyphWarning(UserWarning):
    """A name holds a sign that no font here can draw."""


@cache
def package_signs() -> frozenset[int]:
    """Make the package's fonts known, once; the code points that can be drawn."""
    for path in FONT_FILES:
        font_manager.fontManager.addfont(path)
    spare = font_manager.findfont("DejaVu Sans")
    return frozenset(FT2Font(str(FONT_FILES[0])).get_charmap()) | frozenset(
        FT2Font(spare).get_charmap()
    )


def drawable(text: str) -> str:
    """`text` with "?" for signs that the fonts lack, and a warning that names them."""
    missing = sorted({sign for sign in text if ord(sign) not in package_signs() and not sign.isspace()})
    if missing:
        said = _("no font here has the signs {signs}")
        warnings.warn(
            said.format(signs=", ".join(f"{sign} (U+{ord(sign):04X})" for sign in missing)),
            MissingGlyphWarning,
            stacklevel=2,
        )
    # A dollar sign would start mathematics.
    plain = "".join("?" if sign in missing else sign for sign in text)
    return plain.replace("$", r"\$")


def named_figure(width: float, height: float, title: str) -> Figure:
    """An empty figure, in inches, under a title; signs that cannot be drawn become "?"."""
    package_signs()
    figure = Figure(figsize=(width, height), dpi=DOTS)
    if title:
        figure.suptitle(drawable(title))
    return figure


@contextmanager
def drawn_panels(
    width: float, height: float, title: str, rows: int, columns: int, **how: Any
) -> Iterator[tuple[Figure, list[Axes]]]:
    """A figure, in inches, under a title, to be drawn in our style; and its panels, row by row."""
    with matplotlib.rc_context(STYLE):
        figure = named_figure(width, height, title)
        yield figure, list(figure.subplots(rows, columns, squeeze=False, **how).flat)


@contextmanager
def drawn_panel(width: float, height: float, title: str = "") -> Iterator[tuple[Figure, Axes]]:
    """The same with one panel."""
    with drawn_panels(width, height, title, 1, 1) as (figure, (panel,)):
        yield figure, panel


def cell_edges(at: FloatArray) -> FloatArray:
    """Borders of cells about increasing values; a lone one gets a cell of one unit."""
    if len(at) == 1:
        return np.array([at[0] - 0.5, at[0] + 0.5])
    middle = 0.5 * (at[1:] + at[:-1])
    return np.concatenate([[2.0 * at[0] - middle[0]], middle, [2.0 * at[-1] - middle[-1]]])


def spread_over(count: int, most: int) -> list[int]:
    """At most so many places of a list of `count`, evenly spread, first and last among them."""
    places = np.linspace(0, count - 1, min(count, most)).round().astype(int)
    return [int(place) for place in places]


def lay_out(figure: Figure) -> None:
    """Find room for everything once and for all, before a figure is saved in several formats."""
    with matplotlib.rc_context(STYLE):
        figure.draw_without_rendering()
    figure.set_layout_engine("none")


def write_picture(figure: Figure, path: Path, title: str, plan_sha256: str) -> None:
    """Save `figure` as the suffix of `path` says; the file holds the plan's hash and the version."""
    program, about = f"benchdragon {__version__}", f"plan sha256 {plan_sha256}"
    metadata: dict[str, dict[str, str | None]] = {
        ".png": {"Title": title, "Description": about, "Software": program},
        ".svg": {"Title": title, "Description": about, "Creator": program, "Date": None},
        ".pdf": {"Title": title, "Subject": about, "Creator": program, "CreationDate": None},
    }
    with whole_bytes(path) as made, matplotlib.rc_context(STYLE):
        figure.savefig(made, format=path.suffix[1:], metadata=metadata[path.suffix], dpi=figure.dpi)
