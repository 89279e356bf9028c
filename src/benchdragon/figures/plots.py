"""Walks and answers as readers draw them: a picture of its own, or on axes of a figure of theirs."""

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import Any, Literal

import matplotlib
import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch

from benchdragon.analysis.check import Report, moment
from benchdragon.analysis.contact import ClearanceCurve
from benchdragon.analysis.swept import SweptArea
from benchdragon.errors import InputError, brief, of_kind
from benchdragon.figures.area import outline
from benchdragon.figures.contact import draw_clearances, draw_meeting, moment_picture
from benchdragon.figures.framing import route_positions
from benchdragon.figures.style import (
    BODY,
    HEAD,
    PAGE_WIDTH,
    ROUTE,
    STYLE,
    drawn_panel,
    package_signs,
    spread_over,
)
from benchdragon.figures.sweep import sweep_picture
from benchdragon.figures.walk import MOST_PANELS, dragon_picture, draw_dragons, draw_speeds, name_below
from benchdragon.i18n import _, language
from benchdragon.model.answer import Answer
from benchdragon.model.base_curve import Curve
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Motion, Walk
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan
from benchdragon.sweeps.sweep import Sweep

# How far a route is drawn behind its start, m, where it runs on there for ever.
BEHIND = 10.0
# Axes of the reader, one or some; None for a new figure.
Panels = Axes | Sequence[Axes] | npt.NDArray[Any] | None


@contextmanager
def _on(ax: Axes | None, width: float, height: float) -> Iterator[Axes]:
    """Axes to be drawn on in our style: the reader's, or those of a new figure of inches."""
    if ax is None:
        with drawn_panel(width, height) as (_figure, panel):
            yield panel
        return
    of_kind("ax", ax, Axes)
    with picture_style():
        yield ax


def _figure(panel: Axes) -> Figure:
    """The whole figure that axes stand in."""
    return panel.figure.figure


def picture_style() -> AbstractContextManager[None]:
    """The look of the program's pictures, for figures of your own: fonts with Chinese signs, colours.

    Examples:
        >>> import matplotlib.pyplot as plt
        >>> with bd.picture_style():
        ...     plt.rcParams["font.family"][0]
        'Noto Sans SC'
    """
    package_signs()
    return matplotlib.rc_context(STYLE)


def plot_route(route: Curve, ax: Axes | None = None, *, label: str | None = None) -> Figure:
    """Draw a route, or one curve, with its start as a dot and the joints of its curves as strokes.

    Args:
        route: what is drawn, from its start to its end; where it runs on behind its start, 10 m of that
            as dots.
        ax: axes of matplotlib to draw on, in metres; None: of a new figure.
        label: its name, for a legend.

    Returns:
        The figure.

    Raises:
        InputError: if it is not a route, or not axes.

    Examples:
        >>> figure = bd.Route.joined([bd.Line(20.0), bd.Arc(6.0, degrees=180)]).plot()
        >>> figure.axes[0].get_xlabel()
        'x (m)'
    """
    of_kind("route", route, Curve)
    with _on(ax, 0.62 * PAGE_WIDTH, 0.62 * PAGE_WIDTH) as panel:
        line = panel.plot(*route.point(route_positions(0.0, route.length)).T, lw=1.2, label=label)[0]
        look: dict[str, Any] = {"color": line.get_color()}
        if route.extension:
            panel.plot(*route.point(route_positions(-BEHIND, 0.0)).T, ":", lw=1.2, **look)
        panel.plot(*route.point(0.0), "o", ms=5.0, **look)
        joints = getattr(route, "joints", np.empty(0))[1:-1]
        panel.plot(*route.point(joints).T, "|", ms=7.0, **look)
        panel.set(aspect="equal", xlabel=_("x (m)"), ylabel=_("y (m)"))
        return _figure(panel)


def plot_motion(
    motion: Motion, ax: Panels = None, *, at: npt.ArrayLike | None = None,
    colour: Literal["speed"] | None = None, title: str = "", disc: float | None = None,
    obstacles: Sequence[Obstacle] = (),
) -> Figure:  # fmt: skip
    """Draw the dragon on its route, benches to scale, the head hatched, once for each of some times.

    Args:
        motion: what walks.
        ax: axes of matplotlib to draw on, in metres, or a list of them, one a time; None: a new figure.
        at: times, s, of the walk, whether the motion holds them or not; None: as many of the motion's
            own as there are axes, or four, evenly spread.
        colour: "speed" for benches coloured by the speed of their front handles, with a scale.
        title: above all of a new figure.
        disc: radius of a circle about the first spiral's centre, m.
        obstacles: on the square, the venue's edge included: see `Plan.obstacles`.

    Returns:
        The figure.

    Raises:
        InputError: for axes that are none, more times than axes, or another colour.

    Examples:
        >>> import matplotlib.pyplot as plt
        >>> motion = bd.read_plan("turn").motion(np.arange(0.0, 60.0))
        >>> figure, panels = plt.subplots(1, 2)
        >>> motion.plot(panels, at=[14.0, 40.0], colour="speed") is figure
        True
        >>> plt.close(figure)
    """
    of_kind("motion", motion, Motion)
    if colour not in (None, "speed"):
        raise InputError(_('colour must be "speed" or None, not {value}').format(value=brief(colour)))
    axes: list[Axes] = [] if ax is None else np.ravel(np.asarray(ax, dtype=object)).tolist()
    for one in axes:
        of_kind("ax", one, Axes)
    if at is not None:
        motion = motion.walk.motion(at, throw=False)
    indices = list(range(len(motion)))
    if at is None:
        indices = spread_over(len(motion), len(axes) or MOST_PANELS)
    drawn = disc, obstacles
    if ax is None:
        return dragon_picture(motion, title, indices, *drawn, by_speed=colour is not None)
    if len(indices) > len(axes) or not axes:
        text = _("{times} times need as many axes, not {count}")
        raise InputError(text.format(times=len(indices), count=len(axes)))
    package_signs()
    with matplotlib.rc_context(STYLE):
        draw_dragons(axes, motion, indices, *drawn, by_speed=colour is not None)
    return _figure(axes[0])


def plot_plan(
    plan: Plan, ax: Panels = None, *, at: npt.ArrayLike | None = None,
    colour: Literal["speed"] | None = None,
) -> Figure:  # fmt: skip
    """Draw the dance of a plan with its disc and its square: see `plot_motion`.

    Args:
        plan: what is danced.
        ax: axes of matplotlib, or a list of them, one a time; None: a new figure, with the title.
        at: times, s; None: where the walk starts.
        colour: "speed" for benches coloured by speed.

    Raises:
        InputError: as `plot_motion`.
        PlanError: for a plan whose walk cannot be.

    Examples:
        >>> figure = bd.read_plan("turn").plot(at=[0.0, 14.0])
        >>> [panel.get_title() for panel in figure.axes]
        ['t = 0 s', 't = 14 s']
    """
    of_kind("plan", plan, Plan)
    motion = plan.build().motion(plan.start if at is None else at, throw=False)
    title, disc, obstacles = _about(plan)
    return plot_motion(
        motion, ax, at=motion.times, colour=colour, title=title, disc=disc, obstacles=obstacles
    )


def plot_speeds(motion: Motion, ax: Axes | None = None, *, joints: bool = False) -> Figure:
    """Draw the speeds of all handles over time as a map, with its scale; the head is handle 0, on top.

    Where a few instants are far faster or slower than the rest, the colours tell the rest apart, and
    the extremes are named.

    Args:
        motion: at times that increase, two or more.
        ax: axes of matplotlib to draw on; None: of a new figure.
        joints: whether to draw when each handle passes the joints of the route's curves.

    Returns:
        The figure.

    Raises:
        InputError: for times that do not increase.

    Examples:
        >>> motion = bd.read_plan("turn").motion(np.linspace(-20.0, 60.0, 161))
        >>> figure = motion.plot_speeds(joints=True)
    """
    of_kind("motion", motion, Motion)
    if len(motion) < 2 or not (np.diff(motion.times) > 0.0).all():
        raise InputError(_("speeds over time need two or more times that increase"))
    with _on(ax, 0.85 * PAGE_WIDTH, 3.3) as panel:
        draw_speeds(panel, motion, motion.walk.route.joints[1:-1].tolist() if joints else ())
        return _figure(panel)


def plot_answer(answer: Answer, of: Plan | Walk, ax: Axes | None = None) -> Figure:
    """Draw the moment that an answer's witness tells of: which benches meet, or bench and obstacle.

    Args:
        answer: of a question about contact or distance.
        of: the plan or the walk that was asked about; of a size that was sought, the plan with it.
        ax: axes of matplotlib for the close-up; None: a new figure, the whole dragon beside it.

    Returns:
        The figure.

    Raises:
        InputError: for an answer whose witness tells of nothing that meets, or that has none.

    Examples:
        >>> plan = bd.read_plan("spiral-in")
        >>> figure = plan.first_contact().plot(plan)
        >>> figure.axes[1].get_title()
        'benches 1 and 9: they touch'
    """
    of_kind("answer", answer, Answer)
    walk = of.build() if isinstance(of, Plan) else of
    of_kind("of", walk, Walk, _("the plan or the walk that was asked about"))
    title, disc, obstacles = _about(of) if isinstance(of, Plan) else ("", None, ())
    s = np.array([0.0 if answer.witness is None else answer.witness.s])
    motion = walk.motion_at([walk.time_at(float(s[0]))], s, throw=False)
    return _plot_moment(motion, answer, ax, title, disc, obstacles)


def plot_report(report: Report, ax: Axes | None = None) -> Figure:
    """Draw the moment that decides a check: the first contact, or where benches are nearest.

    Args:
        report: of the check.
        ax: axes of matplotlib for the close-up; None: a new figure, the whole dragon beside it.

    Returns:
        The figure.

    Raises:
        InputError: for a dragon without pairs that count, and without obstacles that it touches.

    Examples:
        >>> figure = bd.read_plan("turn", {"dragon.benches": 20, "walk.end": 20.0}).check().plot()
    """
    of_kind("report", report, Report)
    motion, answer = moment(report)
    title, disc, obstacles = _about(report.plan)
    return _plot_moment(motion, answer, ax, title, disc, obstacles)


def plot_clearance(curve: ClearanceCurve, ax: Axes | None = None, *, margin: float = 0.0) -> Figure:
    """Draw clearance over time, its minima, and overlaps hatched.

    Args:
        curve: what is drawn.
        ax: axes of matplotlib to draw on, in seconds and centimetres; None: of a new figure.
        margin: that benches must keep, m: a line.

    Returns:
        The figure.

    Examples:
        >>> curve = bd.read_plan("turn", {"dragon.benches": 20, "walk.end": 20.0}).clearance_curve()
        >>> figure = curve.plot(margin=0.05)
    """
    of_kind("curve", curve, ClearanceCurve)
    with _on(ax, PAGE_WIDTH, 3.4) as panel:
        draw_clearances(panel, curve, margin)
        return _figure(panel)


def plot_area(area: SweptArea, ax: Axes | None = None) -> Figure:
    """Draw the ground that benches cover, the spectators' line, and the route.

    Args:
        area: what is drawn.
        ax: axes of matplotlib to draw on, in metres; None: of a new figure.

    Returns:
        The figure.

    Examples:
        >>> area = bd.read_plan("spiral-in", {"dragon.benches": 5}).swept_area(0.0, 10.0)
        >>> figure = area.plot()
    """
    of_kind("area", area, SweptArea)
    with _on(ax, 0.62 * PAGE_WIDTH, 0.62 * PAGE_WIDTH) as panel:
        panel.add_patch(
            PathPatch(outline(area.polygon), fc=BODY, ec="black", lw=0.4, label=_("ground covered"))
        )
        if area.margin:
            text = _("spectators' line, {margin} m from it").format(margin=f"{area.margin:g}")
            panel.add_patch(
                PathPatch(outline(area.spectators), fill=False, ec=HEAD, ls="--", label=text)
            )
        low, high = float(area.steps.rear.min()), float(area.steps.front.max())
        route = area.walk.route.point(route_positions(low, high))
        panel.plot(*route.T, color=ROUTE, lw=0.5, label=_("route"))
        panel.set(aspect="equal", xlabel=_("x (m)"), ylabel=_("y (m)"))
        if ax is None:
            name_below(_figure(panel), panel)
        return _figure(panel)


def plot_sweep(sweep: Sweep, name: str | None = None) -> Figure:
    """Draw what a question of a sweep came to: over one key a curve, over two a map, else small ones.

    Args:
        sweep: what is drawn.
        name: of the question; None: the first that was asked.

    Returns:
        A new figure.

    Raises:
        InputError: for a question that the sweep did not ask.

    Examples:
        >>> plan = bd.read_plan("spiral-in")
        >>> found = bd.sweep(plan, {"route.pitch": [0.5, 0.6]}, executor=threads)
        >>> figure = found.plot()
    """
    of_kind("sweep", sweep, Sweep)
    asked = sweep.about["ask"][0] if name is None else name
    return sweep_picture(sweep, asked, sweep.plan.title(language()))


def _about(plan: Plan) -> tuple[str, float | None, tuple[Obstacle, ...]]:
    """The title of a plan's dance, its disc and its obstacles."""
    route = plan.route
    disc = route.disc(plan) if isinstance(route, TurnRoute) else plan.disc.radius
    return plan.title(language()), disc, plan.obstacles()


def _plot_moment(
    motion: Motion, answer: Answer, ax: Axes | None, title: str, disc: float | None,
    obstacles: Sequence[Obstacle],
) -> Figure:  # fmt: skip
    if ax is None:
        return moment_picture(motion, answer, title, disc, obstacles)
    with _on(ax, 0.0, 0.0) as panel:
        draw_meeting(panel, motion, answer, obstacles)
        panel.legend(loc="best")
        return _figure(panel)
