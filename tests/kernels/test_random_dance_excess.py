"""What a bound on random dances says of single benches, point by point and pair by pair."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import RouteRow, place, spiral_length
from benchdragon.kernels.random_dance_bound import (
    Bound,
    BoundFact,
    add_strays,
    fill_excess,
    open_benches,
    prepare,
    table_sizes,
)
from benchdragon.kernels.route import locate
from benchdragon.kernels.stray_chain import place_along
from benchdragon.kernels.stray_line import fill_noise, noise_count, offset_at
from benchdragon.model.dragon import Dragon
from benchdragon.plans.schema import read_plan
from tests.kernels.test_random_dance_bound import distances
from tests.solve.dances import Laid, empty_bound

# A few benches on a spiral, for plain Python; the tail is a turn and a half behind the head.
BENCHES = 40
SAID = [
    "disc.radius=6",
    "dragon.head_length=2.2",
    f"dragon.benches={BENCHES}",
    "route.pitch=0.6",
    "walk.start=160",
]
SIZES = {
    "as ever": [],
    "wide": ["dragon.width=0.6"],
    "long ends": ["dragon.front_inset=0.5", "dragon.rear_inset=0.5"],
    "to the left": ["route.clockwise=false"],
}
UNEVEN = np.random.default_rng(1).normal(0.0, 0.05, BENCHES + 1)


@dataclass(frozen=True)
class Bounded:
    """A dance beside a spiral, its bound, and a stretch of the head's way, m."""

    rows: np.ndarray
    dragon: Dragon
    aside: np.ndarray
    noise: np.ndarray
    stray: float
    bound: Bound
    span: tuple[float, float]

    def excess(self) -> float:
        """Fill it of each bench in the stretch, of a line that does not stray."""
        return fill_excess(self.bound, self.dragon.links, self.dragon.sizes, *self.span)

    def opened(self, wanted: float) -> int:
        """How many benches from the head hold all pairs that may come so near."""
        return open_benches(self.bound, self.dragon.links, self.dragon.sizes, *self.span, wanted)

    def centred(self, u: float) -> complex:
        """The spiral's point at a parameter, m, from its centre."""
        x, y, _tx, _ty = place(self.rows, 0, u)
        return complex(x - self.rows[0, RouteRow.X], y - self.rows[0, RouteRow.Y])


def bounded(said: list[str], aside: np.ndarray, stray: float = 0.0) -> Bounded:
    """A dance whose handles walk so far to the left of a line that strays, shortly before its end."""
    walk = (plan := read_plan("spiral-in", [*SAID, *said])).build()
    dragon, rows = walk.dragon, walk.route.rows
    first, last = walk.head_position(list(plan.span(walk))).tolist()
    whole = float(dragon.links.sum())
    noise = np.empty(noise_count(last - first + 2.0 * whole + 20.0))
    fill_noise(1, 0, noise)
    bound = empty_bound(len(dragon), *table_sizes(first, last, whole), bool(stray))
    assert prepare(bound, rows, dragon.links, dragon.sizes, aside, noise, stray, first, last)
    return Bounded(rows, dragon, aside, noise, stray, bound, (last - 0.4, last))


def seen(case: Bounded, s: float) -> np.ndarray:
    """Excess of points along the edges of each bench with the head at s, m: (benches, points)."""
    count, links = len(case.dragon), case.dragon.links
    places = empty_placements(count + 1, 1)
    assert place_along(case.rows, links, case.aside, np.array([s]), places) == 1
    at = (
        places.x[:, 0]
        + 1j * places.y[:, 0]
        - complex(case.rows[0, RouteRow.X], case.rows[0, RouteRow.Y])
    )
    back, u = (at[1:] - at[:-1]) / links, places.u[:-1, 0]
    feet = np.array([case.centred(one) for one in u.tolist()])
    grows = math.copysign(1.0, np.angle(case.centred(u[0] + 0.1) / case.centred(u[0])))
    _length, width, front, rear = case.dragon.sizes
    found = []
    for share in np.linspace(0.0, 1.0, 9):
        for side in (-0.5, 0.5):
            point = at[:-1] + (share * (front + links + rear) - front + 1j * side * width) * back
            found.append(
                np.abs(point) - case.rows[0, RouteRow.P] * (u + grows * np.angle(point / feet))
            )
    return np.array(found).T


@pytest.mark.parametrize("name", SIZES)
def test_no_point_of_a_bench_is_farther_out_or_in_than_its_bound(name: str) -> None:
    case = bounded(SIZES[name], UNEVEN)
    assert case.excess() > 0.0
    points = np.array([seen(case, s) for s in np.linspace(*case.span, 3)])
    outside = case.bound.out - points.max(axis=(0, 2))
    inside = points.min(axis=(0, 2)) - case.bound.dip
    assert outside.min() >= 0.0
    assert inside.min() >= 0.0
    # So near that a bound which forgets a part of a bench is seen to be none.
    assert outside.min() < 0.03
    assert inside.min() < 0.03


def test_a_line_that_strays_adds_how_much_farther_out_it_lies_than_one_turn_farther_out() -> None:
    case = bounded([], np.zeros(BENCHES + 1), 0.1)
    rows, bound, last = case.rows, case.bound, case.span[1]
    outward = float(bound.facts[BoundFact.OUTWARD]) * case.stray
    assert case.excess() > 0.0
    before = bound.out.copy()
    add_strays(bound, *case.span)
    added, b = bound.out - before, float(rows[0, RouteRow.P])
    for i in range(BENCHES):
        s = last - 0.5 * float(bound.nearest[i] + bound.farthest[i + 1])
        _row, theta, _status = locate(rows, s)
        outer = s - (spiral_length(b, theta + 2.0 * math.pi) - spiral_length(b, theta))
        if outer < bound.facts[BoundFact.GRID_LOW]:
            break
        here, there = (outward * offset_at(case.noise, last - at)[0] for at in (s, outer))
        assert added[i] >= here - there
    assert i > 5


@pytest.mark.parametrize("outward", [0.0, 0.25])
def test_all_benches_that_come_as_near_as_wanted_are_open(outward: float) -> None:
    """Beside those of one bench that walks farther outward, or of all."""
    aside = np.zeros(BENCHES + 1)
    aside[3:5] = outward * bounded([], aside).bound.facts[BoundFact.OUTWARD]
    case = bounded(["route.pitch=0.9"], aside)
    first, second = np.triu_indices(BENCHES, 2)
    laid = Laid(case.dragon, case.rows, aside, *case.span)
    seen = [distances(laid, s, first, second) for s in np.linspace(*case.span, 3).tolist()]
    nearest = np.min(seen, axis=0)
    for wanted in np.linspace(0.1, 0.6, 11).tolist():
        assert case.opened(wanted) >= (second[nearest <= wanted] + 1).max(initial=0)
    assert (nearest <= 0.6).any()
    assert case.opened(0.0) == 0
