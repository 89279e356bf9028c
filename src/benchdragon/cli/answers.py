"""Answers for readers: value, how it was established, where and when it occurs."""

import math
import warnings
from typing import TYPE_CHECKING, Any

import click

from benchdragon.i18n import _, language
from benchdragon.model.answer import Answer, Witness
from benchdragon.model.numbering import handle_text
from benchdragon.number_format import at_most, decimals, figures, seconds

if TYPE_CHECKING:
    from benchdragon.analysis.obstacles import ObstacleAnswers
    from benchdragon.plans.schema import Plan

# Exit codes of answers; 0 is safe, or found.
UNSAFE, NO_SOLUTION, UNDECIDED = 1, 4, 5


def about(plan: "Plan", lines: list[str]) -> dict[str, Any]:
    """What every JSON answer about a plan holds: the lines of --explain, if any, and the plan."""
    explained: dict[str, Any] = {"explanation": lines} if lines else {}
    return {**explained, "plan_sha256": plan.sha256}


def warn_of_outside(plan: "Plan") -> None:
    """Warn of obstacles wholly outside the venue: x and y may have been taken for each other."""
    from benchdragon.analysis.findings import named
    from benchdragon.model.outline import outside_venue

    for obstacle in outside_venue(plan.obstacles()):
        text = _(
            "{name} lies wholly outside the venue; if it stands inside, its x (to the right) and y "
            "(ahead) may have been exchanged: check both"
        )
        warnings.warn(text.format(name=named(obstacle)), stacklevel=2)


def print_title(plan: "Plan") -> None:
    """Print the title of a plan, if it has one."""
    if title := plan.title(language()):
        click.echo(title)


def print_answer(
    name: str, answer: Answer, *, up: bool, brackets: bool, shown: str | None = None
) -> None:
    """An answer for readers: value, how it was established, where.

    What is shown is the end of the bracket that is surely true, rounded `up` or down, or `shown` in
    place of it; with `brackets` it is the value with all of its digits, and the bracket.
    """
    words = {
        "proved": _("proved"), "found": _("found"),
        "infeasible": _("no solution"), "undecided": _("undecided"),
    }  # fmt: skip
    if not math.isfinite(answer.value):
        text = _("no pair counts") if answer.status == "found" else words[answer.status]
        click.echo(f"{name}: {text}")
        return
    value = repr(answer.value) if brackets else shown or figures(answer.sure(up=up), up=up)
    if answer.status == "unlimited":
        text = _("{name}: unlimited up to {value} {unit}")
        click.echo(text.format(name=name, value=value, unit=answer.unit))
        return
    text = _("{name}: {value} {unit} ({status})")
    if brackets:
        text = _("{name}: {value} {unit} ({status}; between {lower} and {upper})")
    elif answer.unit == "m" and answer.vanishing:
        text, value = _("{name}: less than {value} {unit} ({status})"), at_most(answer.upper)
    click.echo(
        text.format(
            name=name, value=value, unit=answer.unit, status=words[answer.status],
            lower=repr(answer.lower), upper=repr(answer.upper),
        )
    )  # fmt: skip
    _print_witness(answer.witness, brackets)


def print_distance(answers: "ObstacleAnswers", *, brackets: bool) -> None:
    """The least distance from an obstacle, or from the venue's edge, for readers."""
    from benchdragon.analysis.findings import named

    text = _("least distance from {name}")
    if answers.obstacle.kind == "venue":
        text = _("least distance from the edge of {name}")
    name = text.format(name=named(answers.obstacle))
    print_answer(name, answers.distance, up=False, brackets=brackets, shown=answers.distance_text)


def _print_witness(near: Witness | None, brackets: bool) -> None:
    """Print where and when the value occurs; with `brackets` in more digits."""
    count = 6 if brackets else 2
    time = math.inf if near is None or near.time is None else near.time
    when = decimals(time, count) if brackets and math.isfinite(time) else seconds(time)
    if near is not None and len(near.benches) == 1:
        bench = near.benches[0]
        who = _("bench {bench}").format(bench=bench)
        if near.handle is not None:
            who = handle_text(near.handle, bench)
        click.echo(
            _("  {who} at t = {t} s, head at {s} m of the route, at ({x}, {y}) m").format(
                who=who,
                t=when,
                s=decimals(near.s, count),
                x=decimals(near.point[0], count),
                y=decimals(near.point[1], count),
            )
        )
    if near is not None and len(near.benches) == 2:
        features = _("; ").join(
            _("bench {bench}: {feature}").format(bench=bench, feature=_(feature))
            for bench, feature in near.features
        )
        click.echo(
            _("  benches {a} and {b} at t = {t} s, at ({x}, {y}) m; {features}").format(
                a=near.benches[0],
                b=near.benches[1],
                t=when,
                x=decimals(near.point[0], count),
                y=decimals(near.point[1], count),
                features=features,
            )
        )
