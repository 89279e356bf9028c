"""Pictures of what imprecision does."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from benchdragon.figures.style import PAGE_WIDTH, SERIES, drawn_panel
from benchdragon.i18n import _
from benchdragon.solve.tolerance import Tolerance


def margin_picture(found: Mapping[str, Tolerance], names: Mapping[str, str], title: str = "") -> Figure:
    """The chance that benches touch over the pitch, a line for each way to be imprecise.

    Args:
        found: by key.
        names: what to call each, by the same keys.
        title: above all.
    """
    with drawn_panel(PAGE_WIDTH, 3.8, title) as (figure, panel):
        low = min(float(one.needed[0]) for one in found.values())
        high = max(float(one.needed[-1]) for one in found.values())
        room = 0.05 * (high - low)
        pitches = np.linspace(low - room, high + room, 400)
        for n, (name, one) in enumerate(found.items()):
            colour, _mark, dashes = SERIES[n % len(SERIES)]
            chance = np.array([one.touching(pitch) for pitch in pitches])
            panel.plot(
                100.0 * pitches, chance[:, 0], ls=dashes, color=colour, lw=1.5, label=names[name]
            )
            panel.fill_between(
                100.0 * pitches, chance[:, 1], chance[:, 2], color=colour, alpha=0.12, lw=0.0
            )
        exact = 100.0 * next(iter(found.values())).exact
        panel.axvline(exact, color="black", lw=1.0)
        panel.annotate(_("exact"), (exact, 1.0), xytext=(4, 3), textcoords="offset points")
        panel.set(ylim=(-0.04, 1.12))
        panel.set_xlabel(_("pitch (cm)"))
        panel.set_ylabel(_("chance that benches touch"))
        panel.set_title(_("The pitch that imprecise people need; bands: 95 % confidence"))
        panel.legend(framealpha=0.9)
        return figure
