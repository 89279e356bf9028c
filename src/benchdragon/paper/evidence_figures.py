"""Pictures of evidence: orders, errors along the benches, answers over steps, chances over pitches."""

import textwrap
import unicodedata
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch
from matplotlib.ticker import FormatStrFormatter, NullLocator

from benchdragon.figures.style import (
    BODY,
    DISC,
    HEAD,
    PAGE_WIDTH,
    ROUTE,
    SERIES,
    TINY,
    drawn_panel,
    drawn_panels,
)
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.paper.convergence import Convergence
from benchdragon.paper.differences import SCHEME_NAMES
from benchdragon.paper.traversal import JUMP, PitchCurve

# Sizes of a flow chart, in its own units.
BOX_WIDTH, BOX_HEIGHT, COLUMN, ROW = 4.75, 0.85, 5.2, 1.25
# Its words: points, and so many to a line; a Chinese sign counts twice.
FLOW_TEXT, FLOW_LINE = 8.5, 44
# Steps between which a stepped search is drawn, s and m, and how many.
DRAWN_TIME_STEPS, DRAWN_PITCH_STEPS, DRAWN = (0.02, 12.0), (0.0004, 0.02), 4000


def convergence_picture(
    place: Convergence, speeds: Mapping[str, Convergence], title: str = ""
) -> Figure:
    """Errors over steps, doubly logarithmic, with the fitted lines: Runge-Kutta, and differences.

    Args:
        place: of the head's place, m.
        speeds: of velocities, m/s, by the name of the formula.
        title: above all.
    """
    with drawn_panels(PAGE_WIDTH, 3.3, title, 1, 2) as (figure, (left, right)):
        _draw_order(left, place, _("Runge-Kutta (RK4)"), 0)
        left.set_ylabel(_("error of the head's position (m)"))
        for n, (scheme, found) in enumerate(speeds.items()):
            _draw_order(right, found, _(SCHEME_NAMES[scheme]), n)
        right.set_ylabel(_("largest error of a velocity (m/s)"))
        for panel in (left, right):
            panel.set_xlabel(_("step (s)"))
            panel.tick_params(axis="y", labelsize=TINY)
            panel.legend(framealpha=0.9)
        left.set_title(_("Where the head is after 300 s"))
        right.set_title(_("Velocities of all handles"))
        return figure


def _draw_order(panel: Axes, found: Convergence, name: str, series: int) -> None:
    colour, mark, dashes = SERIES[series]
    label = _("{name}: order {order}").format(name=name, order=f"{found.order:.3f}")
    good = found.fitted
    steps, errors = found.steps[good], found.errors[good]
    style = {"color": colour, "mfc": "none", "ms": 7 - 2 * series}
    panel.loglog(steps, errors, mark, label=label, **style)
    slope, height = np.polyfit(np.log(steps), np.log(errors), 1)
    panel.loglog(steps, np.exp(height) * steps**slope, ls=dashes, color=colour, lw=1.2)
    if not good.all():
        rest = found.steps[~good], found.errors[~good]
        panel.loglog(*rest, "o", color=ROUTE, label=_("rounding, left out of the fit"))
    panel.set_xticks(found.steps, [f"{step:g}" for step in found.steps])
    panel.xaxis.set_minor_locator(NullLocator())


def accumulation_picture(
    exact: FloatArray, bisected: FloatArray, residuals: FloatArray, title: str = ""
) -> Figure:
    """Errors of handles along the dragon, m: places found here, and by bisection; and chord residuals.

    Args:
        exact: how far each handle is off here, (N + 1,).
        bisected: the same where theta is bisected to a tolerance, (N + 1,).
        residuals: largest difference of a bench's chord from its link, (N,).
        title: above all.
    """
    with drawn_panel(0.85 * PAGE_WIDTH, 3.2, title) as (figure, panel):
        handles = np.arange(exact.size)
        panel.semilogy(
            handles[1:], bisected[1:], "--", color=HEAD, lw=1.2, label=_("theta bisected to 1e-8")
        )
        panel.semilogy(handles[1:], exact[1:], color=BODY, lw=1.2, label=_("handles here"))
        panel.semilogy(
            handles[1:], np.maximum(residuals, 1e-16), ":", color=DISC, lw=1.2,
            label=_("chord less link, here"),
        )  # fmt: skip
        panel.set_xlabel(_("handle (0: the head's front)"))
        panel.set_ylabel(_("error (m)"))
        panel.tick_params(axis="y", labelsize=TINY)
        panel.legend(framealpha=0.9)
        return figure


def stepping_picture(
    contact: Sequence[tuple[float, float]], windows: Sequence[tuple[float, float]],
    pitch: Sequence[tuple[float, float]], smallest: float,
) -> Figure:  # fmt: skip
    """What stepped searches answer, over their steps.

    Args:
        contact: (time step, s; contact first seen, s).
        windows: spans of time in which benches touch, s; the last goes on.
        pitch: (pitch step, m; smallest pitch, m).
        smallest: the smallest pitch, m.
    """
    with drawn_panels(PAGE_WIDTH, 3.7, "", 1, 2, width_ratios=(1.3, 1.0)) as (figure, (left, right)):
        _draw_time_steps(left, contact, windows)
        _draw_pitch_steps(right, pitch, smallest)
        for panel in (left, right):
            panel.ticklabel_format(axis="y", useOffset=False)
            panel.legend(loc="upper left", framealpha=0.9)
        return figure


def first_seen(step: float, windows: Sequence[tuple[float, float]]) -> float:
    """The first multiple of a step, s, that lies in a window; the last of these goes on."""
    for opens, closes in windows:
        seen = float(np.ceil(opens / step)) * step
        if seen <= closes:
            return seen
    return float(np.ceil(windows[-1][0] / step)) * step


def latest_step(windows: Sequence[tuple[float, float]], most: float) -> tuple[float, float]:
    """The step up to `most`, s, that sees the contact most of its lengths late, and when, s."""
    steps = np.round(np.arange(0.02, most, 0.001), 3).tolist()
    late = [(first_seen(step, windows) - windows[0][0]) / step for step in steps]
    step = steps[int(np.argmax(late))]
    return step, first_seen(step, windows)


def _draw_time_steps(
    panel: Axes, contact: Sequence[tuple[float, float]], windows: Sequence[tuple[float, float]]
) -> None:
    """Where multiples of each step first fall into a window of contact."""
    first = windows[0][0]
    steps = np.geomspace(*DRAWN_TIME_STEPS, DRAWN)
    seen = np.array([first_seen(float(step), windows) for step in steps])
    top = float(seen.max()) + 0.5
    for n, (opens, closes) in enumerate(windows):
        end = closes if n + 1 < len(windows) else top
        label = _("benches touch") if n == 0 else None
        panel.axhspan(opens, end, color=HEAD, alpha=0.15, lw=0.0, label=label)
    panel.plot(steps, seen, ".", color=ROUTE, ms=1.5, rasterized=True, label=_("every step"))
    panel.plot(*np.array(contact).T, "o", color=HEAD, ms=4, label=_("steps of the table"))
    step, at = latest_step(windows, DRAWN_TIME_STEPS[1])
    panel.annotate(
        _("a step of {step} s sees {seen} s").format(step=f"{step:g}", seen=f"{at:.3f}"),
        (step, at), xytext=(0.05, 0.6), textcoords="axes fraction",
        arrowprops={"arrowstyle": "->", "lw": 0.8},
    )  # fmt: skip
    panel.axhline(first, color=DISC, lw=1.4, label=_("exact"))
    panel.set(xscale="log", ylim=(first - 0.5, top))
    panel.xaxis.set_major_formatter(FormatStrFormatter("%g"))
    panel.set_xlabel(_("time step (s)"))
    panel.set_ylabel(_("first contact (s)"))
    panel.set_title(_("When benches are first seen to overlap"))


def _draw_pitch_steps(panel: Axes, pitch: Sequence[tuple[float, float]], smallest: float) -> None:
    """The next multiple of each pitch step, which is what a traversal answers."""
    steps = np.geomspace(*DRAWN_PITCH_STEPS, DRAWN)
    panel.plot(
        100.0 * steps, 100.0 * np.ceil(smallest / steps) * steps, ".", color=ROUTE, ms=1.5,
        rasterized=True, label=_("next multiple of the step"),
    )  # fmt: skip
    panel.plot(*(100.0 * np.array(pitch).T), "o", color=HEAD, ms=4, label=_("steps of the table"))
    panel.axhline(100.0 * smallest, color=DISC, lw=1.4, label=_("exact"))
    panel.set(xscale="log")
    panel.xaxis.set_major_formatter(FormatStrFormatter("%g"))
    panel.set_xlabel(_("pitch step (cm)"))
    panel.set_ylabel(_("smallest pitch (cm)"))
    panel.set_title(_("The first pitch with which none is seen"))


def flow_picture(steps: Sequence[tuple[str, str]]) -> Figure:
    """The paper's flow of work beside ours, a row a step: its Fig 1.

    Args:
        steps: what the paper does, and what is done here.
    """
    rows = len(steps)
    with drawn_panel(PAGE_WIDTH, 0.56 * rows + 0.5) as (figure, panel):
        panel.set_axis_off()
        for column, name in enumerate((_("the paper"), _("here"))):
            panel.text(column * COLUMN, ROW, name, ha="center", va="center", fontweight="bold")
            for row, texts in enumerate(steps):
                _draw_box(panel, column, -row * ROW, texts[column], last=row + 1 == rows)
        panel.set(xlim=(-0.5 * COLUMN, 1.5 * COLUMN), ylim=(-ROW * (rows - 0.55), 1.35 * ROW))
        return figure


def _draw_box(panel: Axes, column: int, y: float, text: str, *, last: bool) -> None:
    """A step of the flow, and an arrow to the next."""
    x = column * COLUMN
    corner = (x - 0.5 * BOX_WIDTH, y - 0.5 * BOX_HEIGHT)
    panel.add_patch(
        FancyBboxPatch(
            corner, BOX_WIDTH, BOX_HEIGHT, boxstyle="round,pad=0.08",
            fc=(HEAD, BODY)[column], ec="black", lw=0.8, alpha=0.25,
        )
    )  # fmt: skip
    panel.text(x, y, _folded(text), ha="center", va="center", fontsize=FLOW_TEXT)
    if not last:
        end, start = y - ROW + 0.5 * BOX_HEIGHT + 0.1, y - 0.5 * BOX_HEIGHT - 0.1
        panel.annotate("", (x, end), (x, start), arrowprops={"arrowstyle": "->"})


def _folded(text: str) -> str:
    """Text in two lines if it is longer than a box is wide; a Chinese sign counts twice."""
    wide = sum(2 if unicodedata.east_asian_width(sign) in "WF" else 1 for sign in text)
    if wide <= FLOW_LINE:
        return text
    return "\n".join(textwrap.wrap(text, len(text) * FLOW_LINE // wide))


def pitch_picture(curve: PitchCurve, pitch: float | None = None, title: str = "") -> Figure:
    """The disc's angle and the least angle that the head reaches, over the pitch: the paper's Fig 2.

    Args:
        curve: both angles, with both sides of the smallest pitch.
        pitch: the smallest pitch, m: there the head's angle falls from above the disc's to below it.
        title: above all.
    """
    size = 100.0 * curve.pitch
    with drawn_panel(0.85 * PAGE_WIDTH, 3.6, title) as (figure, panel):
        panel.plot(
            size, curve.disc_angle, color=HEAD, lw=1.6, ls="--", label=_("where the disc begins")
        )
        breaks = np.flatnonzero(np.abs(np.diff(curve.least_angle)) > JUMP) + 1
        for part in np.split(np.arange(len(size)), breaks):
            mark = "." if len(part) == 1 else None
            panel.plot(size[part], curve.least_angle[part], color=BODY, lw=1.6, marker=mark)
        panel.plot([], [], color=BODY, lw=1.6, label=_("least that the head reaches"))
        if pitch is not None:
            _mark_fall(panel, curve, pitch)
        panel.set_xlabel(_("pitch (cm)"))
        panel.set_ylabel(_("angle about the centre (rad)"))
        panel.legend(loc="lower left", framealpha=0.9)
        return figure


def _mark_fall(panel: Axes, curve: PitchCurve, pitch: float) -> None:
    """Mark both ends of the jump at the smallest pitch, and the disc's angle between them."""
    above, below = curve.least_angle[curve.pitch < pitch][-1], curve.least_angle[curve.pitch > pitch][0]
    x = 100.0 * pitch
    panel.plot([x, x], [above, below], color="black", lw=1.0, ls=":")
    panel.plot(
        x, above, "o", color="black", mfc="white", ms=5, label=_("just below the smallest pitch")
    )
    panel.plot(x, below, "o", color="black", ms=5, label=_("just above it"))
    panel.annotate(
        _("smallest pitch {pitch} m").format(pitch=f"{pitch:.9f}"), (x, 0.5 * (above + below)),
        xytext=(14, 26), textcoords="offset points", arrowprops={"arrowstyle": "->", "lw": 0.8},
        va="center",
    )  # fmt: skip
