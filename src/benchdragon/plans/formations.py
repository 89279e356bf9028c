"""Formations as tables of a plan: their sizes, and whether benches can follow them."""

import math
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.local_minima import whole_dragon
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.status import Status
from benchdragon.model.connections import Step
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon
from benchdragon.model.formations import FORMATIONS, Formation, SizeError
from benchdragon.plans.source import Fault, KeyedError
from benchdragon.plans.tables import Degrees, Length, LengthOrZero, Metres, Pitch, Table

Name = Literal[
    "coil-in",
    "coil-out",
    "figure-eight",
    "three-plum-blossoms",
    "double-door",
    "straight-dragon",
    "tail-swing",
]


class FormationTable(Table):
    """A formation and its sizes; those that are not said are as the formation has them."""

    name: Name
    pitch: Pitch | None = None
    outer_radius: Length | None = None
    inner_radius: Length | None = None
    between: LengthOrZero | None = None
    radius: Length | None = None
    waist: Length | None = None
    length: Length | None = None
    swing: Length | None = None
    run: LengthOrZero | None = None
    swings: Annotated[int, Field(strict=True)] | None = None
    rounds: Annotated[int, Field(strict=True)] | None = None
    clockwise: bool | None = None


def formation_of(table: FormationTable, key: str, link: float) -> Formation:
    """The formation of a table, under a dotted key of a plan whose longest link is `link`, m.

    Raises:
        KeyedError: for a size that cannot be, and for a bend that the benches cannot follow.
    """
    try:
        made = FORMATIONS[table.name].of(vars(table))
    except SizeError as error:
        raise KeyedError([Fault(f"{key}.{error.size}", str(error))]) from None
    if made.narrowest:
        refuse_tight(f"{key}.{made.narrowest}", made.least_radius, link)
    return made


def links_below(table: FormationTable) -> float:
    """How long links, m, must not be for benches to follow the bends of a formation."""
    made = formation_of(table, "route", 0.0)
    return 2.0 * made.least_radius if made.narrowest else math.inf


def refuse_tight(key: str, radius: float, link: float) -> None:
    """Refuse bends of a radius, m, that a bench with a link, m, cannot follow; the key widens them."""
    if 2.0 * radius <= link:
        text = _(
            "{key}: a bench with {link} m between its handles cannot follow a bend of {radius} m "
            "radius: it must be wider than {least} m, so make {key} larger"
        )
        raise KeyedError(
            [
                Fault(
                    key,
                    text.format(
                        key=key, link=f"{link:g}", radius=f"{radius:.4g}", least=f"{0.5 * link:g}"
                    ),
                )
            ]
        )


def whole_dragon_on(route: Route, dragon: Dragon) -> float:
    """The head's route position, m, with the tail's rear handle where the route starts.

    Args:
        route: which the dragon walks.
        dragon: which walks.

    Raises:
        KeyedError: if the dragon is longer than the route.
    """
    places = empty_placements(len(dragon.links) + 1, 1)
    head, tail, status = whole_dragon(route.rows, dragon.links, np.empty(1), places)
    if status == Status.ROUTE_TOO_SHORT or tail < -END_SLACK:
        text = _(
            "the dragon, {dragon} m long, does not fit on a route of {route} m, at whose start its "
            "tail stands at time 0: make the sizes larger, take fewer benches, or set walk.position"
        ).format(dragon=f"{dragon.extent:.6g}", route=f"{route.length:.6g}")
        raise KeyedError([Fault("route", text)])
    return head


class StepTable(FormationTable):
    """A formation of a programme, and where it is danced."""

    at: tuple[Metres, Metres] | None = None
    turned: Degrees = 0.0

    def step(self, key: str, link: float) -> Step:
        """The same for a programme: see `formation_of`."""
        made = formation_of(self, key, link)
        try:
            return Step(made, self.at, math.radians(self.turned))
        except InputError as error:
            raise KeyedError([Fault(f"{key}.turned", str(error))]) from None
