"""The verbs of the contest: a starter to fill in, and a grader of workbooks and numbers."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from benchdragon.cli.answers import UNSAFE
from benchdragon.cli.console import print_json, print_rows, print_written
from benchdragon.cli.options import flag, output_option, take, verb
from benchdragon.cli.parsing import NUMBER, check_ending
from benchdragon.errors import InputError
from benchdragon.i18n import N_, _
from benchdragon.model.numbering import handle_names
from benchdragon.number_format import decimals

if TYPE_CHECKING:
    from benchdragon.paper.compare import Comparison, Departure, Deviation, Result
    from benchdragon.paper.grading import Grade


@verb("starter -o contest.py")
@output_option(N_("The file to write: a script, contest.py, or a notebook, contest.ipynb."))
@take("force", "json", "shared")
def starter(output: Path, force: bool, as_json: bool, quiet: bool) -> int:
    """Write a skeleton of the contest's five questions, to be filled in and graded.

    It runs as it is: what is yet to be computed is marked by TODO, and each part grades itself.
    """
    del quiet
    from benchdragon.files import refuse_existing, write_whole
    from benchdragon.paper.starter import notebook, script

    check_ending("-o", output, [".py", ".ipynb"])
    refuse_existing([output], force)
    write_whole(output, script() if output.suffix == ".py" else notebook())
    print_written([output], as_json)
    return 0


@verb("compare result1.xlsx pitch=0.45")
@click.argument("given", metavar="FILE|TASK=NUMBER", nargs=-1)
@click.option(
    "--as",
    "result",
    type=click.Choice(["result1", "result2", "result4"]),
    help=N_("Which workbook it is to be. Default: as its name says, else its columns."),
)
@click.option(
    "--tolerance",
    type=click.FloatRange(0.0, 1.0, min_open=True),
    default=1e-6,
    help=N_("How far off a cell may be, in metres, and in metres per second."),
)
@flag("--literature", N_("What papers and public programs answer, and the mistake behind each number."))
@take("json", "shared")
def compare(
    given: tuple[str, ...], result: "Result | None", tolerance: float, literature: bool,
    as_json: bool, quiet: bool,
) -> int:  # fmt: skip
    """Grade anyone's result1, result2 or result4, and numbers: errors, and the mistake behind them.

    FILE is an .xlsx workbook in the layout of the contest's templates; each cell is compared with the
    exact value. TASK=NUMBER is an answer to a question or an exercise: contact=412.5, pitch=0.45,
    turn-length=13.6, head-speed=1.2. Exit code 0: all of it agrees; 1: something does not, or cells
    are empty.
    """
    del quiet
    if literature == bool(given):
        raise InputError(_("compare wants a FILE, TASK=NUMBER, or --literature alone"))
    if literature:
        _print_literature(as_json)
        return 0
    from benchdragon.paper.compare import compare as compared
    from benchdragon.paper.compare import points

    found: list[Comparison | Grade] = [
        _graded(one) if _is_answer(one) else compared(one, result=result, tolerance=tolerance)
        for one in given
    ]
    score, agrees = sum(one.score for one in found) / len(found), all(one.agrees for one in found)
    if as_json:
        graded = [{**asdict(one), "agrees": one.agrees, "score": one.score} for one in found]
        print_json({"graded": graded, "agrees": agrees, "score": score})
    else:
        _print_graded(found)
        click.echo(_("Points: {points} of 100").format(points=points(score)))
    return 0 if agrees else UNSAFE


def _print_literature(as_json: bool) -> None:
    """All claims of the literature, a row each."""
    from benchdragon.paper.literature import SOURCES, claims

    if as_json:
        rows = [{**asdict(one), "command": one.command} for one in claims()]
        print_json({"claims": rows})
        return
    columns = (_("source"), _("finding"), _("task"), _("said"), _("exact"))
    told = [(one.source.who, one.finding, one.task, one.said, f"{one.exact:.9f}") for one in claims()]
    print_rows(_("What papers and public programs answer"), columns, told, words=2)
    places = [(one.who, one.where, _(one.note) if one.note else "") for one in SOURCES]
    print_rows(_("Where the numbers stand"), (_("source"), _("where"), _("remark")), places, words=3)


def _print_graded(found: "Sequence[Comparison | Grade]") -> None:
    from benchdragon.paper.compare import Comparison

    for one in found:
        if isinstance(one, Comparison):
            print_comparison(one)
        else:
            click.echo(str(one))


def _is_answer(given: str) -> bool:
    """Whether an argument is an answer to a task, and no file."""
    return "=" in given and not given.endswith(".xlsx")


def _graded(given: str) -> "Grade":
    """The grade of TASK=NUMBER, or TASK=NUMBER,NUMBER."""
    from benchdragon.paper.grading import grade

    task, _equals, numbers = given.partition("=")
    said = numbers.split(",")
    if not all(NUMBER.fullmatch(number) for number in said):
        text = _("{task} must be a number, or several with commas, not {value}")
        raise InputError(text.format(task=task, value=repr(numbers)))
    return grade(task, [float(number) for number in said])


def print_comparison(found: "Comparison") -> None:
    """A comparison for readers."""
    from benchdragon.paper.workbook import HANDLES

    names = handle_names(HANDLES)
    columns = (
        _("quantity"), _("cells"), _("empty"), _("6 decimals agree"), _("largest deviation"),
        _("where"),
    )  # fmt: skip
    rows = [
        _row(_("positions"), "m", found.places, names),
        _row(_("speeds"), "m/s", found.speeds, names),
    ]
    print_rows(_("Compared with the exact {result}").format(result=found.result), columns, rows)
    click.echo(_("AGREES") if found.agrees else _("DOES NOT AGREE"))
    click.echo(f"  {found.finding}")
    if found.mistake not in (None, "unknown"):
        text = _("what that leaves unexplained is {residual} m or m/s (root mean square)")
        if found.beside:
            text = _(
                "apart from single cells beside it ({count}), what that leaves unexplained is "
                "{residual} m or m/s (root mean square)"
            )
        click.echo("  " + text.format(residual=f"{found.residual:.1e}", count=found.beside))
    for remark in found.remarks:
        click.echo(f"  {remark}")
    if found.first_departure is not None:
        click.echo(_departure(found.first_departure, names))


def _row(name: str, unit: str, one: "Deviation", names: list[str]) -> tuple[str, ...]:
    where, largest, share = "-", "-", "-"
    if one.largest is not None and one.handle is not None and one.time is not None:
        where = _("{handle}, t = {time} s").format(handle=names[one.handle], time=f"{one.time:.9g}")
        largest = f"{one.largest:.1e} {unit}"
        share = f"{100.0 * one.agreeing / one.cells:.1f} %"
    return name, str(one.cells), str(one.empty), share, largest, where


def _departure(first: "Departure", names: list[str]) -> str:
    from benchdragon.paper.compare import quantity_text

    text = _("first departure: {quantity} of {handle} at t = {time} s is {theirs}, exactly {exact}")
    if first.theirs is None:
        text = _("first departure: {quantity} of {handle} at t = {time} s is empty, exactly {exact}")
    return text.format(
        quantity=quantity_text(first.quantity),
        handle=names[first.handle],
        time=f"{first.time:.9g}",
        theirs="" if first.theirs is None else f"{first.theirs:.9g}",
        exact=decimals(first.exact),
    )
