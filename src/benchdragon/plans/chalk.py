"""The table of a plan file about the chalk line, and the peg from which all papers give places."""

from typing import Annotated

from pydantic import Field

from benchdragon.plans.tables import Length, Metres, Table

# The least that the chalk line may be allowed to stray between ticks that are joined straight, m.
LEAST_STRAY = 0.05


class ChalkTable(Table):
    """The chalk line and the peg: all papers of a dance measure from one.

    Attributes:
        stray: how far the line may stray where ticks are joined straight, m; None for half a link.
        peg: where the peg stands, m; None for the centre of the route.
    """

    stray: Annotated[Length, Field(ge=LEAST_STRAY)] | None = None
    peg: tuple[Metres, Metres] | None = None
