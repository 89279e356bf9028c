"""How papers are wanted."""

from dataclasses import dataclass
from typing import Literal

Format = Literal["a4", "quarter", "lanyard"]


@dataclass(frozen=True)
class Options:
    """How papers are wanted; each reads what it knows of.

    Attributes:
        paper: of the benches' sheets: A4, quarters of it, or cards to hang round the neck.
        by: whether there is a sheet for each bench or for each household.
        night: whether the type is large.
        phones: whether phone numbers are printed.
    """

    paper: Format = "a4"
    by: Literal["bench", "household"] = "bench"
    night: bool = False
    phones: bool = False
