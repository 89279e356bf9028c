"""Pictures of evidence: orders, errors along the benches, answers over steps, chances over pitches."""

from collections.abc import Mapping, Sequence

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch
from matplotlib.ticker import NullLocator

from benchdragon.figures.style import BODY, DISC, HEAD, ROUTE, SERIES, STYLE, named_figure
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.paper.convergence import Convergence
from benchdragon.paper.traversal import JUMP, PitchCurve

# Sizes of a flow chart, in its own units.
BOX_WIDTH, BOX_HEIGHT, COLUMN, ROW = 4.6, 0.8, 5.2, 1.25


def convergence_picture(
    place: Convergence, speeds: Mapping[str, Convergence], title: str = ""
) -> Figure:
    """Errors over steps, doubly logarithmic, with the fitted lines: Runge-Kutta, and differences.

    Args:
        place: of the head's place, m.
        speeds: of velocities, m/s, by the name of the formula.
        title: above all.
    """
    names = {"forward": _("forward"), "central": _("central"), "backward": _("backward")}
    with matplotlib.rc_context(STYLE):
        figure = named_figure(12.0, 5.4, title)
        left, right = figure.subplots(1, 2)
        _draw_order(left, place, _("Runge-Kutta (RK4)"), 0)
        left.set_ylabel(_("error of the head's position (m)"))
        for n, (scheme, found) in enumerate(speeds.items()):
            _draw_order(right, found, names[scheme], n)
        right.set_ylabel(_("largest error of a velocity (m/s)"))
        for panel in (left, right):
            panel.set_xlabel(_("step (s)"))
            panel.legend(fontsize="small", framealpha=0.9)
        left.set_title(_("Where the head is after 300 s"))
        right.set_title(_("Velocities of all handles from differences of positions"))
        return figure


def _draw_order(panel: Axes, found: Convergence, name: str, series: int) -> None:
    colour, mark, dashes = SERIES[series]
    label = _("{name}: order {order}").format(name=name, order=f"{found.order:.3f}")
    good = found.fitted
    steps, errors = found.steps[good], found.errors[good]
    style = {"color": colour, "mfc": "none", "ms": 8 - 2 * series}
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
    with matplotlib.rc_context(STYLE):
        figure = named_figure(9.0, 5.4, title)
        panel = figure.subplots()
        handles = np.arange(exact.size)
        panel.semilogy(
            handles[1:], bisected[1:], "--", color=HEAD, lw=1.2, label=_("theta bisected to 1e-8")
        )
        panel.semilogy(handles[1:], exact[1:], color=BODY, lw=1.2, label=_("handles here"))
        panel.semilogy(
            handles[1:],
            np.maximum(residuals, 1e-16),
            ":",
            color=DISC,
            lw=1.2,
            label=_("chord less link, here"),
        )
        panel.set_xlabel(_("handle (0: the head's front)"))
        panel.set_ylabel(_("error (m)"))
        panel.set_title(_("What adds up along the benches"))
        panel.legend(fontsize="small", framealpha=0.9)
        return figure


def stepping_picture(
    contact: Sequence[tuple[float, float]],
    pitch: Sequence[tuple[float, float]],
    exact: tuple[float, float],
    title: str = "",
) -> Figure:
    """What stepped searches answer, over their steps.

    Args:
        contact: (time step, s; first contact, s).
        pitch: (pitch step, m; smallest pitch, m).
        exact: first contact, s, and smallest pitch, m.
        title: above all.
    """
    with matplotlib.rc_context(STYLE):
        figure = named_figure(12.0, 5.0, title)
        panels = figure.subplots(1, 2)
        texts = (
            (
                _("time step (s)"),
                _("first contact (s)"),
                _("When benches are first seen to overlap"),
                1.0,
            ),
            (
                _("pitch step (cm)"),
                _("smallest pitch (cm)"),
                _("The first pitch with which none is seen"),
                100.0,
            ),
        )
        for panel, found, sure, (below, beside, above, scale) in zip(
            panels, (contact, pitch), exact, texts, strict=True
        ):
            steps, answers = scale * np.array(found).T
            panel.semilogx(steps, answers, "o", color=HEAD, label=_("stepped search"))
            panel.axhline(scale * sure, color=DISC, lw=1.4, label=_("exact"))
            finest = np.geomspace(steps.min(), steps.max(), 100)
            panel.semilogx(
                finest,
                scale * sure + finest,
                "--",
                color=ROUTE,
                lw=1.0,
                label=_("a step later at most"),
            )
            panel.set_xlabel(below)
            panel.set_ylabel(beside)
            panel.set_title(above)
            panel.ticklabel_format(axis="y", useOffset=False)
            panel.legend(fontsize="small", framealpha=0.9)
        return figure


def flow_picture(steps: Sequence[tuple[str, str]], title: str = "") -> Figure:
    """The paper's flow of work beside ours, a row a step: its Fig 1.

    Args:
        steps: what the paper does, and what is done here.
        title: above all.
    """
    rows = len(steps)
    with matplotlib.rc_context(STYLE):
        figure = named_figure(11.0, 0.9 * rows + 1.2, title)
        panel = figure.subplots()
        panel.set_axis_off()
        for column, name in enumerate((_("the paper"), _("here"))):
            panel.text(column * COLUMN, ROW, name, ha="center", va="center", fontweight="bold")
        for row, texts in enumerate(steps):
            for column, text in enumerate(texts):
                x, y = column * COLUMN, -row * ROW
                corner = (x - 0.5 * BOX_WIDTH, y - 0.5 * BOX_HEIGHT)
                panel.add_patch(
                    FancyBboxPatch(
                        corner, BOX_WIDTH, BOX_HEIGHT, boxstyle="round,pad=0.08",
                        fc=(HEAD, BODY)[column], ec="black", lw=0.8, alpha=0.25,
                    )
                )  # fmt: skip
                panel.text(x, y, text, ha="center", va="center")
                if row + 1 < rows:
                    end, start = y - ROW + 0.5 * BOX_HEIGHT + 0.1, y - 0.5 * BOX_HEIGHT - 0.1
                    panel.annotate("", (x, end), (x, start), arrowprops={"arrowstyle": "->"})
        panel.set(xlim=(-0.55 * COLUMN, 1.55 * COLUMN), ylim=(-ROW * (rows - 0.4), 1.4 * ROW))
        return figure


def pitch_picture(curve: PitchCurve, pitch: float | None = None, title: str = "") -> Figure:
    """The disc's angle and the least angle that the head reaches, over the pitch: the paper's Fig 2.

    Args:
        curve: both angles.
        pitch: the smallest pitch, m, to be marked where the two cross.
        title: above all.
    """
    size = 100.0 * curve.pitch
    with matplotlib.rc_context(STYLE):
        figure = named_figure(8.4, 5.6, title)
        panel = figure.subplots()
        panel.plot(
            size, curve.disc_angle, color=HEAD, lw=1.6, ls="--", label=_("where the disc begins")
        )
        breaks = np.flatnonzero(np.abs(np.diff(curve.least_angle)) > JUMP) + 1
        for part in np.split(np.arange(len(size)), breaks):
            mark = "." if len(part) == 1 else None
            panel.plot(size[part], curve.least_angle[part], color=BODY, lw=1.6, marker=mark)
        panel.plot([], [], color=BODY, lw=1.6, label=_("least that the head reaches"))
        if pitch is not None:
            panel.axvline(100.0 * pitch, color=ROUTE, lw=1.0, zorder=1)
            crossing = float(np.interp(pitch, curve.pitch, curve.disc_angle))
            panel.plot(100.0 * pitch, crossing, "D", color="black", ms=5, label=_("crossing"))
            panel.annotate(
                _("smallest pitch {pitch} m").format(pitch=f"{pitch:.9f}"),
                (100.0 * pitch, 0.97),
                xycoords=("data", "axes fraction"),
                xytext=(6, 0),
                textcoords="offset points",
                va="top",
            )
        panel.set_xlabel(_("pitch (cm)"))
        panel.set_ylabel(_("angle about the centre (rad)"))
        panel.set_title(_("How far in the head comes, and where the disc begins"))
        panel.legend(loc="lower left", fontsize="small", framealpha=0.9)
        return figure
