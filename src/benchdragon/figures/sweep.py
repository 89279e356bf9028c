"""Pictures of sweeps: over one key a curve, over two a map, over more small ones side by side.

A figure is in the language in use; `style.write_picture` saves it.
"""

import itertools
import math
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from benchdragon.errors import InputError
from benchdragon.figures.style import PAGE_WIDTH, STYLE, drawable, named_figure, spread_over
from benchdragon.figures.sweep_curve import draw_curve, name_stretches
from benchdragon.figures.sweep_map import draw_map, scale
from benchdragon.figures.sweep_rows import (
    COLOURS,
    OTHERS,
    Answered,
    Bools,
    answered,
    key_label,
    value_label,
    who_text,
)
from benchdragon.i18n import _
from benchdragon.sweeps.questions import STATES
from benchdragon.sweeps.sweep import Sweep

# Small pictures side by side: at most so many, so many in a row.
MOST_PANELS, IN_ROW = 12, 3
# Inches: heights of one picture and of a row of small ones, and of the space about those.
HEIGHT, ROW_HEIGHT, AROUND = 3.6, 2.2, 0.9
# In a legend beside the pictures.
LEGEND_COLUMNS = 4


@dataclass(frozen=True)
class Layout:
    """How a sweep is drawn.

    Attributes:
        axes: keys along the axes: one or two; none where each key has a picture of its own.
        others: keys of which each combination of values has a picture of its own.
        panels: these combinations, as many as are drawn.
        left_out: how many are not.
    """

    axes: tuple[str, ...]
    others: tuple[str, ...]
    panels: tuple[tuple[float, ...], ...]
    left_out: int


def layout(found: Answered) -> Layout:
    """Which keys stand along axes: the first two with numbers; the others tell pictures apart."""
    numeric = [key for key in found.keys if key not in found.texts]
    axes = tuple((numeric or list(found.keys))[:2])
    others = tuple(key for key in found.keys if key not in axes)
    columns = [found.keys[key].tolist() for key in others]
    combinations: list[tuple[float, ...]] = [()]
    if others:
        combinations = sorted(set(zip(*columns, strict=True)))
    grid = math.prod(len(set(column)) for column in columns) == len(combinations)
    if len(combinations) > MOST_PANELS and (not grid or len(combinations) > 0.5 * len(found.value)):
        return Layout((), (), tuple((float(n),) for n in range(min(len(found.keys), MOST_PANELS))), 0)
    chosen = [combinations[n] for n in spread_over(len(combinations), MOST_PANELS)]
    return Layout(axes, others, tuple(chosen), len(combinations) - len(chosen))


def sweep_picture(sweep: Sweep, name: str, title: str = "") -> Figure:
    """What a sweep's question came to.

    One key: a curve with its bracket, in the colours of the benches that decide. Where others decide
    and the answer jumps the curve is broken. Two keys: a map with contours. More: small pictures, one
    for each combination of the other keys' values, or, of points that are no grid, one for each key.
    Where there is no answer it is hatched by the reason.

    Args:
        sweep: it.
        name: of the question.
        title: above all; signs that cannot be drawn become "?", with a warning.

    Raises:
        InputError: for a question that the sweep did not ask.
    """
    if name not in sweep.about["ask"]:
        text = _("the sweep did not ask {name}, but {known}")
        raise InputError(text.format(name=name, known=", ".join(sweep.about["ask"])))
    found = answered(sweep, name)
    plan = layout(found)
    with matplotlib.rc_context(STYLE):
        figure, panels = _panels(len(plan.panels), title, same_keys=bool(plan.axes))
        _draw_all(figure, panels, sweep, found, plan)
        _legend(figure, panels, found, bool(len(plan.axes) < 2))
        if plan.left_out:
            text = _("{count} more are not drawn")
            figure.supxlabel(text.format(count=plan.left_out), fontsize=STYLE["legend.fontsize"])
        return figure


def _panels(count: int, title: str, *, same_keys: bool) -> tuple[Figure, list[Axes]]:
    """A figure with so many pictures, row by row; labels above an empty place lie in that."""
    rows = -(-count // IN_ROW)
    height = HEIGHT if count == 1 else rows * ROW_HEIGHT + AROUND
    figure = named_figure(PAGE_WIDTH, height, title)
    grid = figure.subplots(rows, min(count, IN_ROW), squeeze=False, sharey=True, sharex=same_keys)
    panels = list(grid.flat)
    for number in range(count, len(panels)):
        panels[number].remove()
        panels[number - IN_ROW].xaxis.set_in_layout(False)
    return figure, panels[:count]


def _draw_all(figure: Figure, panels: list[Axes], sweep: Sweep, found: Answered, plan: Layout) -> None:
    """Each picture, and the labels about them."""
    if not plan.axes:
        _draw_each_key(panels, sweep, found)
        return
    colours = scale(found.value[found.known])
    first = plan.axes[0]
    for number, (panel, values) in enumerate(zip(panels, plan.panels, strict=True)):
        part = found.part(_matching(found, plan.others, values))
        if len(plan.axes) == 2:
            draw_map(panel, part, (plan.axes[0], plan.axes[1]), colours)
        else:
            draw_curve(panel, part, first, found.colours())
            if len(panels) == 1 and first not in found.texts:
                name_stretches(panel, part, first)
        panel.set_title(_panel_title(sweep, found, plan, values))
        if number + IN_ROW >= len(panels):
            panel.set_xlabel(key_label(sweep, first))
        if number % IN_ROW == 0:
            second = plan.axes[1:]
            panel.set_ylabel(key_label(sweep, second[0]) if second else value_label(found.question))
        panel.tick_params(labelbottom=number + IN_ROW >= len(panels))
    if len(plan.axes) == 2 and found.known.any():
        figure.colorbar(colours, ax=panels, pad=0.02).set_label(value_label(found.question))


def _matching(found: Answered, keys: tuple[str, ...], values: tuple[float, ...]) -> Bools:
    """At which points keys have values."""
    chosen = np.ones(len(found.value), dtype=bool)
    for key, value in zip(keys, values, strict=True):
        chosen &= found.keys[key] == value
    return chosen


def _panel_title(sweep: Sweep, found: Answered, plan: Layout, values: tuple[float, ...]) -> str:
    if not values:
        return _(found.question.text)
    said = []
    for key, value in zip(plan.others, values, strict=True):
        unit = key_label(sweep, key).removeprefix(key).strip(" ()")
        text = found.texts[key][int(value)] if key in found.texts else f"{value:.6g}"
        said.append(drawable(f"{key} = {text} {unit}".strip()))
    return "\n".join(said)


def _draw_each_key(panels: list[Axes], sweep: Sweep, found: Answered) -> None:
    """The answers of all points over each key; where there is none, a mark at the foot."""
    colours, known = np.array([*found.colours(), "black"]), found.known
    for number, (panel, key) in enumerate(zip(panels, found.keys, strict=False)):
        x = found.keys[key]
        panel.scatter(
            x[known], found.value[known], 6.0, c=colours[found.who[known]], linewidths=0.0,
            rasterized=True,
        )  # fmt: skip
        marks = itertools.cycle("x+|_12")
        for why, mark in zip(np.unique(found.why[~known]), marks, strict=False):
            own = x[found.why == why]
            panel.plot(
                own, np.full(len(own), 0.03), mark, color="#555555", ms=4.0, mew=0.7,
                transform=panel.get_xaxis_transform(), label=_(STATES[str(why)]), rasterized=True,
            )  # fmt: skip
        if key in found.texts:
            words = [drawable(text) for text in found.texts[key]]
            panel.set_xticks(range(len(words)), words)
        panel.set_xlabel(key_label(sweep, key))
        if number % IN_ROW == 0:
            panel.set_ylabel(value_label(found.question))


def _legend(figure: Figure, panels: list[Axes], found: Answered, coloured: bool) -> None:
    """What colours, hatching and marks mean, once for all pictures."""
    entries: dict[str, Artist] = {}
    if coloured:
        colours = found.colours()
        for who, colour in zip(found.names, colours, strict=True):
            if colour in COLOURS:
                entries[who_text(who)] = Line2D([], [], color=colour, lw=2.0)
        if OTHERS in colours:
            entries[_("others")] = Line2D([], [], color=OTHERS, lw=2.0)
        if entries and (found.who[found.known] < 0).any():
            entries[_("another limit")] = Line2D([], [], color="black", lw=2.0)
    for panel in panels:
        handles, labels = panel.get_legend_handles_labels()
        for handle, label in zip(handles, labels, strict=True):
            entries.setdefault(label, handle)
    if entries:
        figure.legend(
            entries.values(), entries.keys(), loc="outside lower center", ncols=LEGEND_COLUMNS,
            handleheight=1.4,
        )  # fmt: skip
