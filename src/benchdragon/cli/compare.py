"""The verb `compare`: how far a contest workbook is off, from where on, and by which mistake."""

import json
from dataclasses import asdict
from typing import TYPE_CHECKING

import click

from benchdragon.cli.answers import UNSAFE
from benchdragon.cli.console import print_rows
from benchdragon.cli.options import take, verb
from benchdragon.i18n import N_, _
from benchdragon.model.numbering import handle_names
from benchdragon.number_format import decimals
from benchdragon.version import __version__

if TYPE_CHECKING:
    from benchdragon.paper.compare import Comparison, Departure, Deviation, Result


@verb
@click.argument("file", metavar="FILE")
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
@take("json", "shared")
def compare(file: str, result: "Result | None", tolerance: float, as_json: bool, quiet: bool) -> int:
    """How far anyone's result1, result2 or result4 is off, and by which mistake.

    FILE is an .xlsx workbook in the layout of the contest's templates; each cell is compared with the
    exact value. Exit code 0: it agrees; 1: it does not, or cells are empty.
    """
    del quiet
    from benchdragon.paper.compare import compare as compared

    found = compared(file, result=result, tolerance=tolerance)
    if as_json:
        click.echo(json.dumps({**asdict(found), "agrees": found.agrees, "version": __version__}))
    else:
        print_comparison(found)
    return 0 if found.agrees else UNSAFE


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
