"""The verb `solve`: what a plan may be at its limits, a subcommand for each question."""

import click

from benchdragon.cli.head_speed import speed
from benchdragon.cli.help import HelpfulGroup
from benchdragon.cli.options import take
from benchdragon.cli.place import place, square
from benchdragon.cli.sizes import SIZE_QUESTIONS
from benchdragon.cli.turn import turn
from benchdragon.i18n import N_


@click.group(
    cls=HelpfulGroup,
    help=N_(
        "The extreme sizes and speeds of a plan.\n\nEach question has options of its own; "
        "benchdragon solve pitch --help, for example, shows those of the first."
    ),
)
@take("lang")
def solve() -> None:
    """Hold the questions."""


for question in (*SIZE_QUESTIONS, speed, turn, place, square):
    solve.add_command(question)
