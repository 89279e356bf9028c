"""Why the next handle is searched by steps of (link - chord), and where a longer step is allowed.

Handle i + 1 is the place with the LARGEST s < s_i that lies one link away. The chord between two places
is at most the arc between them, so from a place whose chord is c < link the next (link - c) metres back
hold no root: stepping by them jumps over none. Alone that converges slowly where the route bends away.

A Newton step may go farther where the chord provably grows all the way. With phi the angle between
tangent and bench at the near end, and delta the arc stepped over, the tangent swings by at most the
route's turning there and the bench by at most asin(delta / c); while phi + both < pi / 2 the chord is
monotone, so a root inside is the only one and a far end with chord < link is passed in safety.
"""

import math
import statistics
from unittest.mock import patch

import numpy as np

from benchdragon import Arc, Clothoid, InputError, Line, Route, Spiral
from benchdragon.kernels import curve
from benchdragon.kernels import route as kernel
from benchdragon.kernels.curve import FloatArray, place
from benchdragon.model.curves import AnyCurve

LINK = 1.65


def newton_from_link(route: Route, s: float, link: float) -> float:
    """What plain Newton on the chord finds, starting one link back along the route."""
    front, back = route.point(s), s - link
    for _pass in range(50):
        delta = front - route.point(back)
        heading = float(route.heading(back))
        chord = float(np.hypot(*delta))
        cosine = float(delta @ [math.cos(heading), math.sin(heading)]) / chord
        back -= (link - chord) / cosine
    return back


def first_root(route: Route, s: float, link: float) -> float:
    """Our search's answer as a route position, m."""
    j, u, _status = kernel.locate(route.rows, s)
    x, y = route.point(s)
    row, place, status = kernel.next_handle(route.rows, j, u, x, y, link)
    assert status == 0, status
    out = np.empty(1)
    kernel.positions(route.rows, np.array([row]), np.array([place]), out)
    return float(out[0])


def by_scan(route: Route, s: float, link: float) -> float:
    """The first root by looking every 0.1 mm, to that accuracy."""
    back = s - link + 1e-9 - np.arange(0.0, 40.0, 1e-4)
    apart = np.hypot(*(route.point(back) - route.point(s)).T)
    return float(back[np.argmax(apart >= link)])


def evaluations(route: Route, s: float) -> int:
    """How many places one search looks at, counted in its plain Python form."""
    count = 0
    j, u, _status = kernel.locate(route.rows, s)
    x, y = route.point(s)

    def counted(rows: FloatArray, row: int, at: float) -> tuple[float, float, float, float]:
        nonlocal count
        count += 1
        return place(rows, row, at)

    with patch.object(curve, "place", counted):
        kernel.next_handle(route.rows, j, u, x, y, LINK)
    return count


def show_looks() -> None:
    """Places looked at per handle on several curves."""
    cases: dict[str, AnyCurve] = {
        "line": Line(50.0),
        "arc, radius 1.5 m": Arc(1.5, 20.0),
        "arc, radius 0.8251 m (nearly folded)": Arc(0.8251, 20.0),
        "spiral, pitch 0.55 m": Spiral(0.55, 60.0, 20.0),
        "clothoid, radius 30 to 1 m": Clothoid(20.0, 1.0 / 30.0, 1.0),
    }
    for name, one in cases.items():
        route = Route((one,))
        places = np.linspace(min(5.0, 0.5 * route.length), route.length, 40)
        counts = [evaluations(route, float(s)) for s in places]
        print(f"{name}: {statistics.mean(counts):.1f} places a handle, at most {max(counts)}")


def show_trap() -> None:
    """A hairpin on which Newton from one link back finds a later root."""
    route = Route.joined([Line(20.0), Arc(0.5, math.pi), Line(20.0)])
    worst, lost, places = 0.0, 0, np.linspace(21.0, 24.0, 61)
    for s in places:
        ours = first_root(route, float(s), LINK)
        assert abs(by_scan(route, float(s), LINK) - ours) < 2e-4
        try:
            worst = max(worst, abs(newton_from_link(route, float(s), LINK) - ours))
        except InputError:  # Newton ran off the route altogether
            lost += 1
    print(
        f"hairpin of radius 0.5 m: Newton from one link back is up to {worst:.2f} m off and leaves the "
        f"route {lost} times in {len(places)}; ours is the first root each time"
    )


if __name__ == "__main__":
    show_looks()
    show_trap()
