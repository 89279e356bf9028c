"""The verb `new`: a plan that can be walked, from a few questions."""

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import NO_SOLUTION
from benchdragon.cli.check import print_report
from benchdragon.cli.console import print_files, shown_progress
from benchdragon.cli.options import (
    FILE,
    announce_compiling,
    force_option,
    output_option,
    shared_options,
)
from benchdragon.cli.parsing import check_ending, parse_length
from benchdragon.errors import InputError
from benchdragon.i18n import N_, _

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.proposal import TooSmall, Wishes

# What a bench, a square (m) and a speed (m/s) may be at most: beyond them something was mistyped.
MOST_BENCH, MOST_SQUARE, MOST_SPEED = 20.0, 2_000.0, 10.0
# How bearers walk, as plans for it are made, and as answers to the question may say it.
CARRIES = {"beside": N_("beside"), "under": N_("under")}
ROUND = ("r", "R", "半径")


@dataclass(frozen=True)
class Question:
    """One thing to ask: its option, the question, why it is asked, what is usual, how it is read."""

    option: str
    text: str
    why: str
    usual: str | None
    read: Callable[[str, str], Any]

    @property
    def name(self) -> str:
        """The parameter of its option."""
        return self.option.removeprefix("--").replace("-", "_")


def _count(option: str, text: str) -> int:
    """A whole number of benches or bearers."""
    if not text.strip().isdecimal():
        raise InputError(
            _("{option}: wanted a whole number such as 120, not {text}").format(
                option=option, text=repr(text)
            )
        )
    return min(int(text.strip()[:9]), 10**9)


def _length_to(most: float) -> Callable[[str, str], float]:
    """A reader of lengths from a centimetre to `most`, m."""

    def read(option: str, text: str) -> float:
        found = parse_length(option, text)
        if not 0.01 <= found <= most:
            raise InputError(
                _("{option}: wanted a length from 1 cm to {most} m, not {text}").format(
                    option=option, most=f"{most:g}", text=repr(text)
                )
            )
        return found

    return read


def _speed(option: str, text: str) -> float:
    """A speed in "0.8" or "0.8 m/s"."""
    number = text.replace("m/s", "").strip()
    try:
        found = float(number)
    except ValueError:
        found = -1.0
    if not 0.05 <= found <= MOST_SPEED:
        raise InputError(
            _("{option}: wanted a speed from 0.05 to {most} m/s, not {text}").format(
                option=option, most=f"{MOST_SPEED:g}", text=repr(text)
            )
        )
    return found


def _sides(option: str, text: str) -> tuple[float, float]:
    """Length and width in "30x20" or "30 m x 20 m"."""
    sides = text.lower().replace("×", "x").replace("*", "x").split("x")
    if len(sides) != 2:
        raise InputError(
            _("{option}: wanted length and width with an x between (30x20), not {text}").format(
                option=option, text=repr(text)
            )
        )
    read = _length_to(MOST_SQUARE)
    return read(option, sides[0].strip()), read(option, sides[1].strip())


def _square(option: str, text: str) -> tuple[float, float] | float:
    """Length and width of a square, or "r12", the radius of a round one."""
    for mark in ROUND:
        if text.strip().startswith(mark):
            return _length_to(MOST_SQUARE)(option, text.strip().removeprefix(mark).strip())
    return _sides(option, text)


def _carry(option: str, text: str) -> str:
    """How bearers walk, in either language, or its number in the question."""
    said = text.strip().lower()
    for number, (name, word) in enumerate(CARRIES.items(), start=1):
        if said in (name, _(word), str(number)):
            return name
    raise InputError(
        _("{option}: wanted beside or under, not {text}").format(option=option, text=repr(text))
    )


QUESTIONS = (
    Question(
        "--benches", N_("How many benches, head and tail included?"),
        N_("the whole dragon, head and tail included"), None, _count,
    ),
    Question(
        "--bench-length", N_("How long is a bench, in metres (1.5, or 150cm)?"),
        N_("the dragon's length, and how tightly it can bend"), None, _length_to(MOST_BENCH),
    ),
    Question(
        "--bench-width", N_("How wide is a bench, in metres (0.15, or 15cm)?"),
        N_("how near the rounds of the coil can lie"), None, _length_to(MOST_BENCH),
    ),
    Question(
        "--head-length", N_("How long is the head's bench, in metres?"),
        N_("it carries the dragon's head, and is often longer"), "2", _length_to(MOST_BENCH),
    ),
    Question(
        "--inset", N_("How far are the holes from the ends of a bench, in metres?"),
        N_("benches swivel about the pins in their holes"), "0.15", _length_to(MOST_BENCH),
    ),
    Question(
        "--square",
        N_("How long and wide is the square, in metres (30x20; r12 if it is round, 12 m from its "
           "middle to its edge)?"),
        N_("the whole dance stays on it"), None, _square,
    ),
    Question(
        "--bearers", N_("How many people carry a bench?"),
        N_("they need room along it"), "2", _count,
    ),
    Question(
        "--carry", N_("Do they walk beside the bench (1) or under it (2)?"),
        N_("beside it they need more room between the rounds"), "1", _carry,
    ),
    Question(
        "--speed", N_("How fast may the head walk, in metres a second?"),
        N_("0.8 is a calm walk"), "0.8", _speed,
    ),
    Question(
        "--most-speed", N_("How fast can a bench be carried at most, in metres a second?"),
        N_("those behind may have to be faster than the head"), "1.5", _speed,
    ),
)  # fmt: skip


@click.command(
    help=N_(
        "Propose a plan for your benches and your square.\n\nIn a terminal it asks for what is not "
        "given. It finds pitch, disc, speed and place so that bearers have room, writes the plan and "
        "prints its check. For example: benchdragon new -o village.dragon.toml --benches 60 "
        "--bench-length 1.5m --bench-width 15cm --square 30x20. Exit code 4: the dance does not fit."
    )
)
@output_option(N_("The plan file to write, for example village.dragon.toml."))
@click.option("--benches", metavar="COUNT", help=N_("How many benches, head and tail included."))
@click.option("--bench-length", metavar="LENGTH", help=N_("Length of a bench: 1.5m or 150cm."))
@click.option("--bench-width", metavar="LENGTH", help=N_("Width of a bench."))
@click.option("--head-length", metavar="LENGTH", help=N_("Length of the head's bench. Default: 2m."))
@click.option("--inset", metavar="LENGTH", help=N_("From a bench's ends to its holes. Default: 15cm."))
@click.option(
    "--square", metavar="LENGTHxWIDTH", help=N_("Length and width of the square: 30x20, in metres.")
)
@click.option("--radius", metavar="LENGTH", help=N_("Radius of a round square, in place of --square."))
@click.option("--bearers", metavar="COUNT", help=N_("People who carry one bench. Default: 2."))
@click.option(
    "--carry", metavar="WHERE", help=N_("Whether they walk beside the bench or under it: beside.")
)
@click.option("--speed", metavar="SPEED", help=N_("Of the head, at most: 0.8, in m/s."))
@click.option(
    "--most-speed", metavar="SPEED", help=N_("Greatest at which a bench can be carried: 1.5, in m/s.")
)
@click.option(
    "--kind",
    type=click.Choice(["turn", "spiral-in"]),
    help=N_("The dance: in, round and out again, or in alone. Default: the first of them that fits."),
)
@click.option(
    "--roster", type=FILE, metavar="FILE", help=N_("A list of names in the folder of the plan.")
)
@force_option
@shared_options
def new(output: Path, force: bool, quiet: bool, **options: Any) -> int:
    """Ask, propose, write the plan, print its check and what comes next."""
    from benchdragon.files import refuse_existing, whole_file

    check_ending("--output", output, [".toml"])
    refuse_existing([output], force)
    wishes = _wishes(output, options)
    from benchdragon.solve.proposal import TooSmall, propose

    announce_compiling(quiet)
    with shown_progress(quiet) as progress:
        found = propose(wishes, progress=progress)
    if isinstance(found, TooSmall):
        click.echo(_refusal(wishes, found), err=True)
        return NO_SOLUTION
    with whole_file(output) as temporary:
        temporary.write_text(_text(found.plan, wishes), encoding="utf-8")
    if found.slower:
        click.echo(
            _("the head walks at {speed} m/s, or benches behind it would be too fast").format(
                speed=f"{found.plan.walk.speed:g}"
            )
        )
    print_report(found.report)
    print_files([output])
    _print_next(output)
    return 0


def _wishes(output: Path, options: Mapping[str, Any]) -> "Wishes":
    """What options and answers say.

    Raises:
        InputError: for what cannot be read, and for what is missing where nobody can be asked.
    """
    from benchdragon.solve.proposal import Wishes

    if options["square"] is not None and options["radius"] is not None:
        raise InputError(
            _("{option} does not go with {what}").format(option="--radius", what="--square")
        )
    roster = _roster(output, options["roster"])
    given = {one.name: options[one.name] for one in QUESTIONS}
    if options["radius"] is not None:
        given["square"] = f"r{options['radius']}"
    said = {
        one.name: one.read(one.option, given[one.name])
        for one in QUESTIONS
        if given[one.name] is not None
    }
    unsaid = [one for one in QUESTIONS if one.name not in said]
    said |= _asked(unsaid) if sys.stdin.isatty() else _usual(unsaid)
    square = said["square"]
    round_ = isinstance(square, float)
    return Wishes(
        said["benches"], said["bench_length"], said["bench_width"], said["head_length"], said["inset"],
        None if round_ else square, square if round_ else None, said["bearers"], said["carry"],
        said["speed"], said["most_speed"], options["kind"], roster,
    )  # fmt: skip


def _usual(questions: list[Question]) -> dict[str, Any]:
    """What is usual, where nobody can be asked."""
    missing = [one.option for one in questions if one.usual is None]
    if missing:
        raise InputError(
            _("nobody is there to be asked: add {options}").format(options=", ".join(missing))
        )
    return {one.name: one.read(one.option, str(one.usual)) for one in questions}


def _asked(questions: list[Question]) -> dict[str, Any]:
    """What is answered; each answer is read at once, and asked for again where it cannot be."""
    if questions:
        click.echo(_("Press Enter to take the value shown."), err=True)
    return {one.name: _answer(one) for one in questions}


def _answer(question: Question) -> Any:
    """The answer to one question."""

    def read(text: str) -> Any:
        try:
            return question.read(question.option, text)
        except InputError as error:
            raise click.UsageError(str(error)) from None

    text = _("{question} ({why})").format(question=_(question.text), why=_(question.why))
    return click.prompt(text, default=question.usual, value_proc=read, err=True)


def _roster(output: Path, path: Path | None) -> str:
    """The name of the list as the plan says it."""
    if path is None:
        return ""
    if not path.is_file():
        raise InputError(_("--roster: there is no file {name}").format(name=path))
    if path.resolve().parent != output.resolve().parent:
        raise InputError(_("--roster: put {name} into the folder of the plan first").format(name=path))
    return path.name


def _refusal(wishes: "Wishes", found: "TooSmall") -> str:
    """Why there is no plan."""
    length, width = (f"{side:g}" for side in found.rectangle)
    text = _(
        "{benches} benches do not fit on this square: the dance that takes the least room of those "
        "tried needs {length} m by {width} m, room for people and margins included."
    )
    if wishes.radius is not None:
        text = _(
            "{benches} benches do not fit on this square: the dance that takes the least room of those "
            "tried needs a radius of {radius} m, room for people and margins included."
        )
    fewer = _("A dragon of {count} such benches fits.") if found.benches else ""
    said = text.format(benches=wishes.benches, length=length, width=width, radius=f"{found.radius:g}")
    return f"{said} {fewer.format(count=found.benches)}".strip()


# Where each figure of a proposed plan comes from, but for those that were said.
ASSUMED = (
    "people.beside", "people.ahead", "people.sway", "people.imprecision", "limits.margin",
    "limits.venue_margin",
)  # fmt: skip
PROPOSED = ("route.pitch", "route.start_turn", "route.at", "route.turned", "disc.radius", "walk.speed")


def _text(plan: "Plan", wishes: "Wishes") -> str:
    """The plan as a commented file."""
    from benchdragon.plans.keys import commented

    notes = dict.fromkeys(ASSUMED, _("assumed")) | dict.fromkeys(PROPOSED, _("proposed"))
    carried = _("People who carry one bench: {count}; they walk beside it.")
    if wishes.carry == "under":
        carried = _("People who carry one bench: {count}; they walk under it.")
    lines = [
        _("Proposed by benchdragon new. What is marked as assumed was measured by nobody: measure it"),
        _("with your own people, write it in, say where it comes from in [people.source], and check."),
        carried.format(count=wishes.bearers),
    ]
    return "".join(f"# {line}\n" for line in lines) + commented(plan.data(), notes)


def _print_next(output: Path) -> None:
    """The commands to type next."""
    name = f'"{output}"' if " " in str(output) else str(output)
    page = Path(str(output).removesuffix(".toml").removesuffix(".dragon")).with_suffix(".html")
    click.echo(_("Next:"))
    for command, text in (
        (f"benchdragon view {name} -o {page}", _("see it walk")),
        (f"benchdragon check {name} --record", _("check it again after each change")),
        (f"benchdragon sheets {name} -o sheets", _("papers for everyone")),
    ):
        click.echo(f"  {command}  # {text}")
