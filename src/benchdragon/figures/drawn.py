"""Pictures of drawings and of the routes that follow them."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from benchdragon.figures.style import PAGE_WIDTH, ROUTE, SERIES, drawn_panel
from benchdragon.figures.walk import name_below
from benchdragon.i18n import _
from benchdragon.surveys.fitting import Fit

# Places at which a route is drawn.
PLACES = 2000


def drawing_picture(
    points: Sequence[Sequence[float]], fits: Mapping[str, Fit], title: str = ""
) -> Figure:
    """Points as they were drawn, and routes along them, each with its tightest bend marked.

    Args:
        points: x and y of each, m.
        fits: by their names.
        title: above all.
    """
    with drawn_panel(PAGE_WIDTH, 0.58 * PAGE_WIDTH, title) as (figure, panel):
        x, y = np.asarray(points, np.float64).T
        panel.plot(x, y, ":", color=ROUTE, marker=".", label=_("drawing"))
        for (name, fit), (colour, mark, dashes) in zip(fits.items(), SERIES, strict=False):
            route = fit.route.point(np.linspace(0.0, fit.route.length, PLACES))
            panel.plot(*route.T, color=colour, linestyle=dashes, linewidth=1.2, label=name)
            tightest = fit.route.point(min(fit.s, fit.route.length))
            panel.plot(*tightest, mark, color=colour, markersize=6, markerfacecolor="none")
        panel.set(aspect="equal", xlabel="x (m)", ylabel="y (m)")
        name_below(figure, panel)
        return figure
