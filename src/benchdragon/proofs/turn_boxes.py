"""Bounds for all turns of a box: none is shorter, or lets the head walk faster.

That needs one witness for a box: a place of the head at which one handle, on each turn of the box that
exists, is faster than so many times the head.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from typing import NamedTuple

from flint import arb

from benchdragon import budget
from benchdragon.proofs.mean_value import Box, Form, UnboundedError
from benchdragon.proofs.turn_chain import Handle, handles
from benchdragon.proofs.turn_shape import Direct, NoTurnError, TurnShape

# What a handle on all turns of a box costs, in handles placed.
COST = 1000.0


class Witness(NamedTuple):
    """A place of the head, m, counted from the turn's end or else its start, and a handle, from 0."""

    backwards: bool
    head: float
    handle: int


class Bound(NamedTuple):
    """A number that is at most all values in a box, and by how much they may vary with each number."""

    least: float
    spread: tuple[float, ...]


@dataclass(frozen=True)
class Turns:
    """The turns of a family that are compared, and what they must keep.

    Attributes:
        family: one of FAMILIES.
        pitch: of both spirals, m.
        disc: radius of the turning space, m.
        links: of all benches, m.
        objective: "way", "length" or "speed".
        fastest: what handles may do while the head walks, m/s: infinite without a limit.
        head: how fast the head is to walk, m/s; with the objective "speed" it is sought.
        least_radius: of both arcs, m.
        longest: the turn's length at most, m.
        longest_way: of the whole path inside the disc, m.
    """

    family: str
    pitch: float
    disc: float
    links: Sequence[float]
    objective: str
    fastest: float
    head: float
    least_radius: float
    longest: float
    longest_way: float

    def bound(
        self, low: Sequence[float], high: Sequence[float], witness: Witness | None = None
    ) -> Bound:
        """The least that a turn of the box may come to; infinite if none keeps what it must.

        That is its length, m, or less than nothing by the head speed that it allows, m/s.
        """
        box = Box(low, high)
        widths = self._moved(low, high)
        speed, ratio = self.objective == "speed", None
        try:
            backwards = witness is not None and witness.backwards
            shape = TurnShape(self.family, self.pitch, self.disc, box, backwards)
        except NoTurnError:
            return Bound(math.inf, widths)
        except UnboundedError:
            sizes: list[TurnShape | Direct] = [Direct(self.pitch, self.disc, box)]
        else:
            sizes = [shape] if shape.sure else [shape, Direct(self.pitch, self.disc, box)]
            if any(radius.over < self.least_radius for radius in shape.radii):
                return Bound(math.inf, widths)
            ratio = None if witness is None else self._ratio(shape, witness)
        if any(size.length.over > self.longest or size.way.over > self.longest_way for size in sizes):
            return Bound(math.inf, widths)
        least = 1.0 if ratio is None else max(ratio.least(), 1.0)
        spread = (None if ratio is None else _spread(ratio, low, high)) or widths
        if speed:
            return Bound(math.nextafter(-self.fastest / least, -math.inf), spread)
        if arb(least) * self.head > self.fastest:
            return Bound(math.inf, spread)
        return Bound(max(getattr(size, self.objective).least() for size in sizes), spread)

    def _moved(self, low: Sequence[float], high: Sequence[float]) -> tuple[float, ...]:
        """About how far each number moves the turn within a box, m."""
        joint, radius = 2.0 * math.pi / self.pitch, 2.0
        by = [joint * high[0], joint * high[1], *(radius for _number in low[2:])]
        return tuple(rate * (b - a) for rate, a, b in zip(by, low, high, strict=True))

    def _ratio(self, shape: TurnShape, witness: Witness) -> Form | None:
        """The witness's speed by the head's on all turns; None where it could not be enclosed."""
        links = [arb(link) for link in self.links]
        try:
            last = _handle(shape, links, witness)
        except UnboundedError:
            return None
        budget.spend(COST * witness.handle)
        # It is judged from where the head enters the turn to where the tail has left it.
        head = shape.box.constant(witness.head)
        entered, left = head - shape.joints[0], head - shape.joints[3]
        within = entered.over >= 0 and left.over < sum(links, arb(0))
        return last.ratio if within else None


def _handle(shape: TurnShape, links: Sequence[arb], witness: Witness) -> Handle:
    if not 0 <= witness.handle <= len(links):
        raise UnboundedError("no such handle")
    chain = handles(shape, links, witness.head)
    return next(islice(chain, witness.handle, None))


def _spread(form: Form, low: Sequence[float], high: Sequence[float]) -> tuple[float, ...] | None:
    """By how much a form may vary with each number; None where that is not known."""
    slopes = [float(slope.abs_upper()) for slope in form.slopes[: len(low)]]
    if not all(math.isfinite(slope) for slope in slopes):
        return None
    return tuple(slope * (b - a) for slope, a, b in zip(slopes, low, high, strict=True))
