"""How papers are wanted."""

from dataclasses import dataclass
from typing import Literal

Format = Literal["a4", "quarter", "lanyard"]


@dataclass(frozen=True)
class ChalkOptions:
    """How the chalk plan is wanted.

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
    """How papers are wanted; each reads what it knows of.

    Attributes:
        paper: of the benches' sheets: A4, quarters of it, or cards to hang round the neck.
        by: whether there is a sheet for each bench or for each household.
        night: whether the type is large.
        phones: whether phone numbers are printed.
        chalk: how the chalk plan is wanted.
    """

    paper: Format = "a4"
    by: Literal["bench", "household"] = "bench"
    night: bool = False
    phones: bool = False
    chalk: ChalkOptions = ChalkOptions()
