"""Why brackets follow bounds on rounding, and how tight those bounds are.

Distances that are computed are wrong by rounding: by how much depends on how far the dance is from
the origin, on how many links lie before a bench, and on folds, past which errors grow as speeds do.
One number for all would call grazes clear that are none, or leave open what is known. So each handle
carries a bound on its error along the route (kernels/rounding.py):

1. What moves the whole chain is no error of distances. The head's parameter, found from its route
   position by double arithmetic, is a place exactly somewhere: to 1e-16 m a sum of two doubles tells
   where (kernels/double_double.py), and brackets of head positions are shifted by that.
2. Each link's solver leaves its chord wrong by some units in the last place of what it is made from:
   of the link alone on spirals, whose lanes carry angles as sums of two doubles; elsewhere of the
   coordinates too. Over the cosine at the rear handle that is an error along the route, which travels
   on by the links' ratios of cosines.
3. Places add their rounding once, the route's joints theirs.

Turning rates and accelerations are made of angles, ratios and curvatures, which are off by what the
places are; along the chain their errors travel as accelerations do (kernels/rate_rounding.py).

A dance far from the origin is searched from an origin of its own (analysis/nearby.py).

Below: of random dances on each kind of curve the greatest error of a bench's corner against balls of
128 bits, what was said of it, and the greatest share of the one in the other; then past folds; then
the same dance at 10^0 .. 10^7 m from the origin; then the tail of long dragons; then rates.
"""

import math

import numpy as np
from tests.exact_places import corner_errors, exact_chain
from tests.kernels.test_rate_rounding import dances
from tests.kernels.test_rounding import KINDS, hairpin

from benchdragon import Arc, Dragon, Line, Route, Spiral, Walk, first_contact
from benchdragon.analysis.nearby import errors_at

DANCES, SEED = 12, 20
TURN = 2.0 * math.pi


def show_kinds() -> None:
    """Errors, bounds and shares of random dances of each kind."""
    print("curves        error, m   bound, m   greatest share   median share")
    for kind in KINDS:
        rng, found = np.random.default_rng(SEED), []
        for _dance in range(DANCES):
            walk = Walk(Dragon.of_sizes(rng.uniform(1.0, 3.4, 14)), kind(rng))
            low = 1.0 if kind.__name__ == "spiral_in" else 45.0
            found.append(corner_errors(walk, float(rng.uniform(low, walk.route.length))))
        error = max(float(one.found.max()) for one in found)
        bound = max(float(one.said.max()) for one in found)
        shares = [one.share for one in found]
        said = f"{max(shares):14.2f}   {np.median(shares):12.2f}"
        print(f"{kind.__name__:12}  {error:8.1e}   {bound:8.1e}   {said}")


def show_folds() -> None:
    """The same through hairpins, at the place of the greatest ratio seen."""
    print("\nratio   error, m   bound, m   share")
    for radius, sweep in (
        (3.0, 2.0),
        (1.2, 2.6),
        (0.913344008, 2.046460796),
        (0.899698121, 2.034141618),
    ):
        walk = hairpin(radius, sweep)
        s = np.linspace(20.0, 20.0 + radius * sweep + 3.5, 4001)
        placed = walk.placement(s, throw=False)
        if placed.status.any():
            continue
        at = float(s[np.argmax(placed.speed_ratio[:, 1])])
        one = corner_errors(walk, at)
        ratio = float(placed.speed_ratio.max())
        print(f"{ratio:5.1f}   {one.found.max():8.1e}   {one.said.max():8.1e}   {one.share:5.2f}")


def show_far() -> None:
    """The bracket of a first contact, the dance moved away."""
    print("\nmoved, m   bracket's width, s   its middle against that at home, s")
    middle = math.nan
    for far in (0.0, 1e2, 1e4, 1e5, 1e6, 1e7):
        line = Line(60.0, (far, -0.3 * far))
        walk = Walk(Dragon.uniform(20), Route.joined([line, Arc(2.6, 7.0)]), start=40.0)
        found = first_contact(walk, 0.0, 35.0)
        assert found is not None
        now = 0.5 * (found.lower + found.upper)
        middle = now if math.isnan(middle) else middle
        print(f"{far:8.0e}   {found.upper - found.lower:18.1e}   {now - middle:34.1e}")


def show_tails() -> None:
    """The tail of long dragons: error along the route, and bound."""
    print("\nbenches   error, m   bound, m")
    for benches in (223, 2_000, 20_000):
        route = Route((Spiral(1.7, TURN * 320.0, TURN * 20.0),))
        walk, s = Walk(Dragon.uniform(benches), route), 0.98 * route.length
        tail, placed = exact_chain(walk, s).handles[-1].pose, walk.placement(s)
        off = math.hypot(float(tail[0] - placed.x[0, -1]), float(tail[1] - placed.y[0, -1]))
        errors, _off = errors_at(walk, s)
        print(f"{benches:7}   {off:8.1e}   {errors[-1]:8.1e}")


def show_rates() -> None:
    """Greatest shares of errors of accelerations along the route and of turning rates in bounds."""
    print("\ncurves        accelerations   turning rates   greatest bounds, 1/m and rad/m")
    for kind in KINDS:
        found = dances(kind, DANCES)
        change, turn, _bend = np.array([chain.shares(exact) for chain, exact in found]).max(axis=0)
        bounds = [
            max(float(table.max()) for table in one)
            for one in zip(
                *((chain.errors.change, chain.errors.turn) for chain, _exact in found), strict=True
            )
        ]
        print(f"{kind.__name__:12}  {change:13.3f}   {turn:13.3f}   {bounds[0]:8.1e} {bounds[1]:8.1e}")


if __name__ == "__main__":
    show_kinds()
    show_folds()
    show_far()
    show_tails()
    show_rates()
