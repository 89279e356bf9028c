"""Options of papers."""

from dataclasses import dataclass
from typing import Literal

Format = Literal["a4", "quarter", "lanyard"]


@dataclass(frozen=True)
class ChalkOptions:
    """Options of the chalk plan.

    Attributes:
        paper: of the whole drawing, A4 to A0; None for one that suits.
        scale: 1 to this; None for the largest usual one that fits.
        tile: the paper on which the drawing is printed in parts.
    """

    paper: str | None = None
    scale: float | None = None
    tile: str = "A4"


@dataclass(frozen=True)
class Options:
    """Options of papers; each paper reads its own.

    Attributes:
        paper: of the benches' sheets: A4, quarters of it, or cards to hang round the neck.
        by: whether there is a sheet for each bench or for each household.
        night: whether the type is large.
        phones: whether phone numbers are printed.
        chalk: of the chalk plan.
    """

    paper: Format = "a4"
    by: Literal["bench", "household"] = "bench"
    night: bool = False
    phones: bool = False
    chalk: ChalkOptions = ChalkOptions()
