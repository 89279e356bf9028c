"""The verb `survey`: what the route makes of a drawing, and how near it keeps."""

import math
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import about, print_title
from benchdragon.cli.console import print_json
from benchdragon.cli.options import take, verb
from benchdragon.i18n import _
from benchdragon.number_format import finite_or_none
from benchdragon.plans.toml import PlanError

if TYPE_CHECKING:
    from benchdragon.model.curves import Route
    from benchdragon.plans.schema import Plan
    from benchdragon.surveys.fitting import Fit


@verb("survey field.dragon.toml")
@take("plan", "json", "shared")
def survey(plan: str, settings: tuple[str, ...], quiet: bool, as_json: bool) -> int:
    """What a drawn route is like: its parts, how near to the drawing it keeps, its tightest bend, and
    which gaps and kinks of the drawing were absorbed.

    The plan's route has kind = drawn.
    """
    del quiet
    from benchdragon.plans.routes import DrawnRoute
    from benchdragon.plans.schema import read_plan

    read = read_plan(plan, settings)  # notes on its files are in the answer
    if not isinstance(read.route, DrawnRoute):
        text = _('{plan}: survey speaks of drawn routes, not of route.kind = "{kind}"')
        raise PlanError(text.format(plan=plan, kind=read.route.kind))
    walk = read.build()  # so that whatever is wrong is said with its line
    fit = read.route.fit(walk.dragon.longest_link)
    if as_json:
        print_json({**record_of(read, fit), **about(read, [])})
    else:
        print_title(read)
        for line in lines_of(read, fit):
            click.echo(line)
    return 0


def _placed(plan: "Plan", fit: "Fit") -> tuple["Route", float, float]:
    """The plan's route, where on it the drawing starts, and where its tightest bend is, both m."""
    built, start = plan.route.build(plan)
    route = plan.route.placed(built)
    return route, start, min(start + fit.s, route.length)


def _origin(plan: "Plan") -> tuple[float, float] | None:
    """What lies at (0, 0) in the files, where the route was not moved away from there."""
    moved = plan.route.at is not None or plan.route.turned != 0.0
    return None if moved else plan.survey.origin


def record_of(plan: "Plan", fit: "Fit") -> dict[str, Any]:
    """A fit as plain data of the plan's route, where it is danced: metres, radians."""
    told = fit.absorbed
    route, start, s = _placed(plan, fit)
    return {
        "length": route.length,
        "parts": len(route),
        "start": start,
        "deviation": fit.deviation,
        "least_radius": finite_or_none(fit.least_radius),
        "s": s,
        "point": route.point(s).tolist(),
        "joints": told.joints,
        "adjusted": told.adjusted,
        "gap": told.gap,
        "kink": told.kink,
        "shift": told.shift,
        "crs": plan.survey.crs,
        "origin": _origin(plan),
        "passed_over": list(plan.source.passed),
    }


def lines_of(plan: "Plan", fit: "Fit") -> list[str]:
    """The same for readers."""
    from benchdragon.surveys.coordinates import system_of

    told = fit.absorbed
    route, start, s = _placed(plan, fit)
    lines = [
        _("route: {length} m, {parts} parts").format(length=f"{route.length:.4f}", parts=len(route)),
        _("it keeps within {deviation} m of the drawing, at every place of either (a bound)").format(
            deviation=f"{fit.deviation:.4g}"
        ),
    ]
    if start:
        lines.append(_("the drawing starts at s = {s} m").format(s=f"{start:.4f}"))
    if math.isfinite(fit.least_radius):
        x, y = route.point(s).tolist()
        text = _("tightest bend: a radius of {radius} m at s = {s} m, at ({x}, {y}) m")
        lines.append(
            text.format(radius=f"{fit.least_radius:.4g}", s=f"{s:.4f}", x=f"{x:.4f}", y=f"{y:.4f}")
        )
    if told.adjusted:
        text = _(
            "{count} of {joints} joints were adjusted: gaps of up to {gap} m, kinks of up to {kink} "
            "degrees; no place was moved by more than {shift} m"
        )
        lines.append(
            text.format(
                count=told.adjusted, joints=told.joints, gap=f"{told.gap:.3g}",
                kink=f"{math.degrees(told.kink):.3g}", shift=f"{told.shift:.3g}",
            )
        )  # fmt: skip
    if (origin := _origin(plan)) is not None:
        x, y = origin
        name = plan.survey.crs or _("metres")
        text = _("(0, 0) of the plan lies at ({x}, {y}) of the files ({crs})")
        if plan.survey.crs is not None and system_of(plan.survey.crs).angular:
            text = _("(0, 0) of the plan lies at longitude {x}, latitude {y} of the files ({crs})")
        lines.append(text.format(x=f"{x:.12g}", y=f"{y:.12g}", crs=name))
    return lines + list(plan.source.passed)
