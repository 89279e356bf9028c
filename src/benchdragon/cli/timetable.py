"""The verb `timetable`: when the head and the tail pass each place of a dance."""

import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import about
from benchdragon.cli.console import print_rows
from benchdragon.cli.options import plan_to_walk, take, verb
from benchdragon.errors import InputError
from benchdragon.i18n import language

if TYPE_CHECKING:
    from benchdragon.analysis.ground import Ground
    from benchdragon.analysis.marks import Marks
    from benchdragon.model.walk import Walk
    from benchdragon.plans.schema import Plan


@verb
@take("plan", "json", "shared")
def timetable(plan: str, settings: tuple[str, ...], quiet: bool, as_json: bool) -> int:
    """When the head and the tail pass each place of a dance, and where the head stops.

    The rows are those of the paper that benchdragon sheets writes; whether the dance is safe says
    benchdragon check. PLAN is a *.dragon.toml file or the name of a built-in plan; benchdragon plan
    lists them. For example: benchdragon timetable turn
    """
    from benchdragon.analysis.clock import Clock
    from benchdragon.analysis.ground import Ground
    from benchdragon.analysis.stops import stops_of, stops_sentence
    from benchdragon.analysis.timetable import timetable as passings_of
    from benchdragon.sheets.timetable import columns, printed_rows, told_sentences

    read = plan_to_walk(plan, settings, quiet)
    walk = read.build()
    start, end = read.span(walk)
    passings, stops = passings_of(read, walk, start, end), stops_of(walk, start, end)
    if as_json:
        answer: dict[str, Any] = {"start": start, "end": end, "clock": read.cues.clock}
        answer["places"] = [asdict(one) for one in passings]
        answer["stops"] = [one._asdict() for one in stops]
        click.echo(json.dumps({**answer, **about(read, [])}))
        return 0
    clock, ground = Clock(read.cues.clock, start), Ground.of(read, walk.route)
    marks = _marks(read, walk, (start, end), ground)
    rows = printed_rows(passings, clock, ground, marks)
    print_rows(read.title(language()), columns()[: len(rows[0])], rows)
    for line in (clock.legend, ground.legend, *told_sentences(passings), stops_sentence(stops, clock)):
        click.echo(line)
    return 0


def _marks(plan: "Plan", walk: "Walk", span: tuple[float, float], ground: "Ground") -> "Marks | None":
    """The chalk plan's marks; None where they cannot be laid out."""
    from benchdragon.analysis.marks import Trail, placed_marks

    trail = Trail.of(walk, *span)
    try:
        return placed_marks(trail, trail.every(plan.chalk.every), ground, obstacles=plan.obstacles())
    except InputError:
        return None
