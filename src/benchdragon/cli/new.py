"""The verb `new`: a plan that can be walked, from a few questions."""

import shlex
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import NO_SOLUTION, about
from benchdragon.cli.by_hand import kept_by_hand, warn_of_lost
from benchdragon.cli.check import print_report
from benchdragon.cli.console import print_files, print_json, shown_progress
from benchdragon.cli.options import file_option, output_option, take, verb
from benchdragon.cli.parsing import check_ending
from benchdragon.errors import InputError, NoSolutionError
from benchdragon.i18n import N_, _, language
from benchdragon.plans.answers import QUESTIONS, Question, count_in, wished

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.proposal import Proposal
    from benchdragon.solve.wishes import Wishes


@verb("new -o village.dragon.toml --benches 60 --bench-length 1.5m --bench-width 15cm --square 30x20")
@output_option(N_("The plan file to write, for example village.dragon.toml."))
@click.option("--benches", metavar="COUNT", help=N_("How many benches, head and tail included."))
@click.option("--bench-length", metavar="LENGTH", help=N_("Length of a bench: 1.5m or 150cm."))
@click.option("--bench-width", metavar="LENGTH", help=N_("Width of a bench. Default: 20cm."))
@click.option(
    "--head-length",
    metavar="LENGTH",
    help=N_("Length of the head's bench. Default: half a metre more than a bench."),
)
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
    "--sway",
    metavar="LENGTH",
    help=N_("How far a bench sways to a side, as you measured it. Else 5cm."),
)
@click.option(
    "--imprecision",
    metavar="LENGTH",
    help=N_("How far bearers stray from their line, as you measured it. Else 10cm."),
)
@click.option(
    "--kind",
    type=click.Choice(["turn", "spiral-in"]),
    help=N_("The dance: in, round and out again, or in alone. Default: the first of them that fits."),
)
@click.option(
    "--rounds",
    metavar="COUNT",
    help=N_("How many times the dance coils in and out, if it fits. Default: as in --beside, or 1."),
)
@file_option("--roster", N_("A list of names in the folder of the plan."))
@click.option(
    "--beside",
    metavar="PLAN",
    help=N_("A plan whose wells, stages and street are there, maybe the one written anew."),
)
@take("force", "json", "shared")
def new(output: Path, force: bool, as_json: bool, quiet: bool, **options: Any) -> int:
    """Propose a plan for your benches and your square.

    In a terminal it asks for what is not given. It finds pitch, disc, speed and place so that bearers
    have room, writes the plan and prints its check. Exit code 4: the dance does not fit.
    """
    from benchdragon.files import refuse_existing, write_whole

    check_ending("--output", output, [".toml"])
    refuse_existing([output], force)
    before = kept_by_hand(output)
    roster = _roster(output, options["roster"])
    rounds, standing, street = _standing(options["beside"])
    rounds = rounds if options["rounds"] is None else _rounds(options["rounds"])
    said, given = _answers(options)
    from benchdragon.explain.proposal import proposal_lines, refusal_lines
    from benchdragon.solve.proposal import TooSmall, benches_out_again, propose

    while True:
        wishes = replace(
            _wishes(said, options["kind"], roster, given),
            obstacles=standing,
            rounds=rounds,
            street=street,
        )
        try:
            with shown_progress(quiet) as progress:
                found = propose(wishes, progress=progress)
        except NoSolutionError as error:
            if not sys.stdin.isatty():
                raise
            click.echo(str(error), err=True)
            given |= _asked_again(said, under=False, benches=0)
            continue
        with shown_progress(quiet) as progress:
            out = isinstance(found, TooSmall) or wishes.kind or found.plan.route.kind == "turn"
            again = 0 if out else benches_out_again(wishes, progress=progress)
        if not isinstance(found, TooSmall):
            break
        click.echo(("" if language() == "zh" else " ").join(refusal_lines(wishes, found)), err=True)
        if not sys.stdin.isatty():
            return NO_SOLUTION
        given |= _asked_again(said, under=found.under, benches=found.benches)
    write_whole(output, _text(found.plan, wishes, given))
    warn_of_lost(before, output)
    printed = _print_as_json if as_json else _print_proposed
    printed(found, proposal_lines(found, wishes, again), output)
    return 0


def _print_as_json(found: "Proposal", lines: list[str], output: Path) -> None:
    from benchdragon.analysis.records import verdict_of

    verdict = verdict_of(found.report).model_dump(mode="json")
    print_json({**verdict, "proposed": lines, **about(found.plan, [])}, [output])


def _print_proposed(found: "Proposal", lines: list[str], output: Path) -> None:
    click.echo(_("Proposed:"))
    for line in lines:
        click.echo(f"  {line}")
    print_report(found.report)
    print_files([output])
    _print_next(output)


def _answers(options: Mapping[str, Any]) -> tuple[dict[str, Any], set[str]]:
    """The answers from options and prompts, or InputError; and the names of those not by default."""
    if options["square"] is not None and options["radius"] is not None:
        sentence = _("{option} does not go with {what}")
        raise InputError(sentence.format(option="--radius", what="--square"))
    typed = {one.name: options[one.name] for one in QUESTIONS}
    if options["radius"] is not None:
        typed["square"] = "r" + options["radius"].removeprefix("r")
    said = {
        one.name: one.answer("--radius" if typed[one.name] != options[one.name] else one.option, text)
        for one in QUESTIONS
        if (text := typed[one.name]) is not None
    }
    given = set(said)
    unsaid = [one for one in QUESTIONS if one.name not in said]
    if sys.stdin.isatty():
        given |= _asked(unsaid, said)
    else:
        _usual(unsaid, said)
    return said, given


def _wishes(said: Mapping[str, Any], kind: Any, roster: str, given: set[str]) -> "Wishes":
    """The wishes that the answers make; those that were given are no assumptions."""
    from benchdragon.solve.wishes import Wishes

    wishes = wished(said, given)
    measured = frozenset(wishes.pop("measured"))
    return Wishes(**wishes, measured=measured, kind=kind, roster=roster)


def _rounds(text: str) -> int:
    """How many times the dance is to coil in and out."""
    from benchdragon.plans.tables import MOST_ROUNDS

    return count_in("--rounds", text, "3", 1, MOST_ROUNDS)


def _standing(
    plan: str | None,
) -> tuple[int, tuple[dict[str, Any], ...], dict[str, Any] | None]:
    """The rounds of a plan, the obstacles on its square and the street to it: their tables."""
    from benchdragon.plans.schema import read_plan

    if plan is None:
        return 1, (), None
    data = read_plan(plan).data()
    route = data["route"]
    rounds = route.get("rounds", 1) if route["kind"] == "turn" else 1
    return rounds, tuple(data.get("obstacle", ())), route.get("street")


def _asked_again(said: dict[str, Any], *, under: bool, benches: int) -> set[str]:
    """Ask which answer is to change, and its question again; the names of what was changed."""
    usual = {"carry": "2" if under else "", "benches": str(benches or "")}
    first = [name for name, text in usual.items() if text] + ["square"]
    named = {one.name: one for one in QUESTIONS}
    offered = [named[name] for name in dict.fromkeys((*first, *named))]
    click.echo(_("Your other answers stay. Which one do you change?"), err=True)
    for n, one in enumerate(offered, 1):
        click.echo(f"{n:4}  {_told_answer(one, said)}", err=True)
    label = _("Its number")
    chosen = _prompt(label, "1", lambda text: offered[count_in(label, text, "1", 1, len(offered)) - 1])
    said[chosen.name] = _answer(chosen, usual.get(chosen.name) or None)
    return {chosen.name}


def _told_answer(question: Question, said: Mapping[str, Any]) -> str:
    """A question and what was answered to it."""
    text = _("{label}: {value}")
    return text.format(label=_(question.label), value=question.shown(said[question.name]))


def _usual(questions: Sequence[Question], said: dict[str, Any]) -> None:
    """Add the usual answers to those given, without a terminal."""
    missing = [one.option for one in questions if not one.usually]
    if missing:
        text = _("there is no terminal to ask in: add {options}")
        raise InputError(text.format(options=", ".join(missing)))
    for one in questions:
        if one.usually:
            said[one.name] = one.answer(one.option, one.usual(said))


def _asked(questions: Sequence[Question], said: dict[str, Any]) -> set[str]:
    """Add the answers to those given; the names of answers other than the default."""
    if questions:
        click.echo(_("Press Enter to take the value shown. Ctrl-C leaves, to begin again."), err=True)
    given = set()
    for one in questions:
        usual = one.usual(said) or None
        said[one.name] = _answer(one, usual)
        if usual is None or said[one.name] != one.answer(one.option, usual):
            given.add(one.name)
    if questions:
        click.echo(_("Your answers:"), err=True)
        for one in QUESTIONS:
            click.echo(f"  {_told_answer(one, said)}", err=True)
    return given


def _answer(question: Question, usual: str | None) -> Any:
    """The answer to one question."""
    text = _("{question} ({why})").format(question=_(question.text), why=_(question.why))
    return _prompt(text, usual, lambda answer: question.answer(_(question.label), answer))


def _prompt(text: str, usual: str | None, read: Callable[[str], Any]) -> Any:
    """What is typed: read at once, and asked for again where it cannot be."""

    def checked(typed: str) -> Any:
        try:
            return read(typed)
        except InputError as error:
            raise click.UsageError(str(error)) from None

    return click.prompt(text, default=usual, value_proc=checked, err=True)


def _roster(output: Path, path: Path | None) -> str:
    """The name of the list as the plan says it."""
    if path is None:
        return ""
    if not path.is_file():
        raise InputError(_("--roster: there is no file {name}").format(name=path))
    if path.resolve().parent != output.resolve().parent:
        raise InputError(_("--roster: put {name} into the folder of the plan first").format(name=path))
    return path.name


# What of a proposed plan was computed for it; what was neither computed nor said is assumed.
PROPOSED = frozenset({
    "route.pitch", "route.start_turn", "route.at", "route.turned", "disc.radius", "walk.speed",
    "walk.start", "walk.end",
})  # fmt: skip


def _notes(plan: "Plan", given: set[str]) -> dict[str, str]:
    """The source of each number of a plan that was not given, by dotted key."""
    said = {key for one in QUESTIONS if one.name in given for key in one.keys}
    numbers = {
        f"{name}.{key}"
        for name, table in plan.data().items()
        if isinstance(table, dict)
        for key, value in table.items()
        if _is_number(value) or (isinstance(value, list) and value and all(map(_is_number, value)))
    }
    unsaid = numbers - said
    proposed = dict.fromkeys(unsaid & PROPOSED, _("proposed"))
    return proposed | dict.fromkeys(unsaid - PROPOSED, _("assumed"))


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _text(plan: "Plan", wishes: "Wishes", given: set[str]) -> str:
    """The plan as a commented file."""
    from benchdragon.plans.keys import commented

    carried = _("People who carry one bench: {count}; they walk beside it.")
    if wishes.carry == "under":
        carried = _("People who carry one bench: {count}; they walk under it.")
    lines = [
        _("Proposed by benchdragon new. What is marked as assumed has not been measured: measure it"),
        _("with your own people, write it in, say where it comes from in [people.source], and check."),
        carried.format(count=wishes.bearers),
    ]
    # A slower head's speed is proposed, whatever was said.
    given = given if plan.walk.speed == wishes.speed else given - {"speed"}
    return "".join(f"# {line}\n" for line in lines) + commented(plan.data(), _notes(plan, given))


def _print_next(output: Path) -> None:
    """The commands to type next."""
    page = Path(str(output).removesuffix(".toml").removesuffix(".dragon")).with_suffix(".html")
    name, shown = shlex.quote(str(output)), shlex.quote(str(page))
    click.echo(_("Next:"))
    for command, text in (
        (f"benchdragon view {name} -o {shown}", _("see it walk")),
        (f"benchdragon check {name}", _("check it again after each change")),
        (f"benchdragon sheets {name} -o sheets", _("papers for everyone")),
    ):
        click.echo(f"  {command}  # {text}")
