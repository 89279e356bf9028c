"""Dragons and routes on which searches and bounds are tried."""

from benchdragon import Arc, Bench, Clothoid, Dragon, Line, LogSpiral, Route, Spiral, Walk
from benchdragon.analysis.contact_search import ContactSearch
from benchdragon.progress import silent

BENCHES = [Bench(1.6, 0.4, 0.1, 0.2), *[Bench(1.1, 0.3, 0.1, 0.1)] * 5]
ROUTES = {
    "spiral": (Route((Spiral(0.9, 40.0, 8.0),)), 12.0),
    "arc": (Route.joined([Line(12.0), Arc(1.6, 5.0), Line(9.0)]), 14.0),
    "joint": (Route.joined([Line(12.0), Arc(1.6, 1.0), Arc(2.0, -1.5), Line(9.0)]), 12.9),
    "clothoid": (Route.joined([Line(12.0), Clothoid(3.0, 0.0, 0.6), Arc(1.0 / 0.6, 3.0)]), 15.5),
    "logarithmic spiral": (Route.joined([Line(12.0), LogSpiral(5.0, 0.1, 0.8), Arc(1.25, 3.0)]), 16.5),
    "kink": (
        Route((Line(12.0), Line(9.0).moved((12.0, 0.0), 0.4)), kinks=True),
        11.97,
    ),
}

SMOOTH = [name for name in ROUTES if name != "kink"]


def searched(
    dragon: Dragon, route: Route, span: tuple[float, float], reach: float, slack: float = 1e-13
) -> ContactSearch:
    """A search of a walk that has looked for all steps in which pairs may come within reach."""
    found = ContactSearch(Walk(dragon, route), *span, 0.0, silent)
    found.slack = slack
    found.begin(reach)
    assert all(step.start < step.end for step in found.steps())
    return found
