"""The verb `timetable`: when the head and the tail pass each place of a dance."""

from dataclasses import asdict
from typing import Any

import click

from benchdragon.cli.answers import about
from benchdragon.cli.console import print_json, print_rows
from benchdragon.cli.options import plan_to_walk, take, verb
from benchdragon.i18n import language


@verb("timetable turn")
@take("plan", "json", "shared")
def timetable(plan: str, settings: tuple[str, ...], quiet: bool, as_json: bool) -> int:
    """When the head and the tail pass each place of a dance, and where the head stops.

    The rows are those of the paper that the planner's page prints; whether the dance is safe says
    benchdragon check.
    """
    from benchdragon.analysis.ground import Ground
    from benchdragon.analysis.stops import stops_of
    from benchdragon.analysis.timetable import timetable as passings_of
    from benchdragon.explain.timetable_text import timetable_text

    read = plan_to_walk(plan, settings, quiet)
    walk = read.build()
    start, end = read.span(walk)
    passings = passings_of(read, walk, start, end)
    if as_json:
        answer: dict[str, Any] = {"start": start, "end": end, "clock": read.cues.clock}
        answer["places"] = [asdict(one) for one in passings]
        answer["stops"] = [one._asdict() for one in stops_of(walk, start, end)]
        print_json({**answer, **about(read, [])})
        return 0
    text = timetable_text(read, walk, (start, end), Ground.of(read, walk.route), passings)
    print_rows(read.title(language()), text.columns, text.rows, words=2)
    for line in text.lines:
        click.echo(line)
    return 0
