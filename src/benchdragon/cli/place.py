"""`solve place` and `solve square`: where on its square a dance fits, and what square it takes."""

import math
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import (
    NO_SOLUTION,
    UNDECIDED,
    UNSAFE,
    about,
    print_answer,
    print_distance,
    print_title,
    warn_of_outside,
)
from benchdragon.cli.console import print_files, print_json, shown_progress
from benchdragon.cli.options import plan_to_walk, take, verb
from benchdragon.cli.solved import plan_option, refuse_written, write_found
from benchdragon.i18n import N_, _
from benchdragon.number_format import rounded_up

if TYPE_CHECKING:
    from benchdragon.analysis.swept import Enclosing
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.place import Enough, PlacedDance


@verb("solve place village.dragon.toml")
@take("plan")
@plan_option
@take("force", "json", "brackets", "shared")
def place(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """The place on the square where the dance fits best.

    It has the most room to the venue's edge and to every obstacle, and is judged as `check` judges:
    where that finds the dance not safe there, no plan is written, and the exit code is that of
    `check`. The plan needs a [venue]. Exit code 4: no place was found.
    """
    from benchdragon.solve.place import best_place, enough_room

    refuse_written(options)
    read = plan_to_walk(plan, settings, quiet)
    warn_of_outside(read)
    with shown_progress(quiet) as progress:
        best = best_place(read, progress=progress)
        enough = None if best.report is not None else enough_room(read, progress=progress)
    files = write_found(plan, options, best.plan if best.passes else None)
    if options["as_json"]:
        wanted = {} if enough is None else {"enough": enough.as_json()}
        print_json({**best.as_json(), **wanted, **about(read, [])}, files)
    else:
        _print_place(read, best, options)
        if enough is not None:
            _print_enough(enough)
        print_files(files)
    if best.report is None:
        return NO_SOLUTION
    return 0 if best.passes else UNSAFE if best.report.decided else UNDECIDED


def _print_place(plan: "Plan", best: "PlacedDance", options: dict[str, Any]) -> None:
    """The best place for readers."""
    from benchdragon.analysis.check import sentence
    from benchdragon.analysis.room import levels_asked

    print_title(plan)
    if best.room.status == "infeasible":
        click.echo(_("no place was found where the dance fits on this square; the nearest to it:"))
    x, y = best.at
    said = _("at = [{x}, {y}] m, turned = {turned} degrees  (best found)")
    click.echo(said.format(x=f"{x:g}", y=f"{y:g}", turned=f"{best.turned:g}"))
    if best.room.status != "infeasible":
        name = _("room beyond the margins")
        if levels_asked(plan.people):
            name = _("room beyond the margins and what people take")
        print_answer(name, best.room, up=False, brackets=options["brackets"])
    elif best.room.value < 0.0:  # a distance is 0 however far benches are outside
        text = _("missing where it is tightest: {missing} m or more")
        click.echo(text.format(missing=f"{-best.room.value:.2g}"))
    for answers in best.obstacles:
        print_distance(answers, brackets=options["brackets"])
    if best.report is not None and not best.passes:
        text = _("but the dance does not pass the check there, and no plan is written: {verdict}")
        click.echo(text.format(verdict=sentence(best.report)))


def _print_enough(enough: "Enough") -> None:
    """What would do where there is no place."""
    from benchdragon.analysis.check import sentence

    if enough.rectangle is None:
        text = _("Nor does it pass the check where it has all the room it wants: {verdict}")
        click.echo(text.format(verdict=sentence(enough.alone)))
    else:
        length, width = (f"{side:g}" for side in enough.rectangle)
        text = _("This dance fits on a square of {length} m by {width} m on which nothing else stands.")
        click.echo(text.format(length=length, width=width))
    if enough.benches is not None:
        text = _("Here it has a place with {count} benches: write benches = {count} below [dragon].")
        click.echo(text.format(count=enough.benches))


@verb("solve square turn")
@take("plan")
@click.option(
    "--error",
    type=click.FloatRange(min=1e-4, max=1.0),
    default=0.01,
    help=N_("How much larger than need be they may be on each side, in metres."),
)
@take("json", "shared")
def square(plan: str, settings: tuple[str, ...], quiet: bool, error: float, as_json: bool) -> int:
    """The smallest rectangle and circle that hold the dance.

    All benches are in them from start to end, tail included.
    """
    from benchdragon.analysis.swept import enclosing

    read = plan_to_walk(plan, settings, quiet)
    walk = read.build()
    with shown_progress(quiet) as progress:
        found = enclosing(walk, *read.span(walk), error=error, progress=progress)
    if as_json:
        print_json({**_square_json(found), **about(read, [])})
    else:
        _print_square(read, found)
    return 0


def _square_json(found: "Enclosing") -> dict[str, Any]:
    """What holds a dance as plain data, m and degrees."""
    box, circle = found.rectangle, found.circle
    rectangle = {
        "width": box.width, "height": box.height, "angle": math.degrees(box.angle),
        "centre": box.corners.mean(axis=0).tolist(), "corners": box.corners.tolist(),
        "area": box.area.as_json(),
    }  # fmt: skip
    round_ = {"centre": list(circle.centre), "radius": circle.radius.as_json()}
    return {"rectangle": rectangle, "circle": round_}


def _print_square(plan: "Plan", found: "Enclosing") -> None:
    """What holds a dance, for readers: rounded up, so that it does."""
    box, circle = found.rectangle, found.circle
    x, y = box.corners.mean(axis=0).tolist()
    print_title(plan)
    click.echo(
        _(
            "smallest rectangle: {width} m by {height} m, its length at {angle} degrees to the x axis, "
            "centre ({x}, {y}) m"
        ).format(
            width=rounded_up(box.width), height=rounded_up(box.height),
            angle=f"{math.degrees(box.angle):.2f}", x=f"{x:.3f}", y=f"{y:.3f}",
        )
    )  # fmt: skip
    click.echo(
        _("smallest circle: radius {radius} m, centre ({x}, {y}) m").format(
            radius=rounded_up(circle.radius.upper),
            x=f"{circle.centre[0]:.3f}", y=f"{circle.centre[1]:.3f}",
        )
    )  # fmt: skip
