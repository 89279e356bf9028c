"""The table of a plan file about marks on the ground, by which all papers give places."""

from typing import Annotated

from pydantic import Field

from benchdragon.plans.tables import Length, Metres, Table

# The least distance between marks along the route, m.
LEAST_EVERY = 0.1


class ChalkTable(Table):
    """Marks on the ground: all papers of a dance number them alike, and measure from one peg.

    Attributes:
        every: m between marks along the route; None for 1 m, or more where those were too many.
        peg: where the peg stands, m; None for the centre of the route.
    """

    every: Annotated[Length, Field(ge=LEAST_EVERY)] | None = None
    peg: tuple[Metres, Metres] | None = None
