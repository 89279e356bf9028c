"""The verb `check`: whether a walk is safe."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.budget import OverBudgetError
from benchdragon.cli.answers import (
    UNDECIDED,
    UNSAFE,
    about,
    print_answer,
    print_distance,
    print_title,
    warn_of_outside,
)
from benchdragon.cli.console import print_explanation, print_files, print_json, shown_progress
from benchdragon.cli.options import files_option, only_with, plan_to_walk, take, tell_names, verb
from benchdragon.cli.parsing import parse_names
from benchdragon.cli.solved import certificate_option, refuse_certificate, write_proved
from benchdragon.errors import UnsureError
from benchdragon.files import refuse_existing
from benchdragon.i18n import N_, _

if TYPE_CHECKING:
    from benchdragon.analysis.check import Report
    from benchdragon.plans.schema import Plan
    from benchdragon.progress import Progress


@verb("check spiral-in --set disc.radius=4.5 --explain")
@take("plan", "prove")
@click.option(
    "--prove-all",
    is_flag=True,
    help=N_("Prove the least clearance and the greatest speed as well; this takes longer."),
)
@files_option("xlsx,png", N_("What to write: xlsx, png, svg, pdf."))
@certificate_option
@click.option("--show-plan", is_flag=True, help=N_("Print the plan in effect too, as a plan file."))
@take("json", "brackets", "explain", "shared")
def check(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Whether a walk is safe: no benches touch, margin and limits are kept, and all of the dance
    stays in the venue and touches no obstacle.

    Each finding has a code, such as BD303: the manual says what it means and what to do. Exit code 0:
    safe; 1: not; 4: it cannot be walked; 5: undecided.
    """
    from benchdragon.analysis.check import check as checked
    from benchdragon.explain.contact import check_lines

    prove, folder = options["prove"] or options["prove_all"], options["output"]
    only_with("-o", folder is not None, "formats")
    refuse_certificate(options, prove, folder)
    read = plan_to_walk(plan, settings, quiet)
    files: list[Path] = []
    if folder is not None:
        from benchdragon.export.check_files import FORMATS, planned_files, write_files

        files = planned_files(folder, parse_names("--format", options["formats"], FORMATS))
        refuse_existing(files, options["force"])
    warn_of_outside(read)
    with shown_progress(quiet) as progress:
        report = _shown(read, progress) if prove else checked(read, progress)
        open_still = bool(report.unproved)
        if options["prove_all"]:
            from benchdragon.analysis.proved_report import prove_report

            report = prove_report(report, progress)
        if files:
            progress(1.0, _("writing"))
            write_files(report, files)
    files += write_proved(read, options["certificate"], report.claims, report.speeds)
    lines = check_lines(report) if options["explain"] else []
    tell_names(_notes(read), quiet)
    if options["as_json"]:
        from benchdragon.analysis.records import verdict_of

        shown = {"plan": read.data()} if options["show_plan"] else {}
        verdict = verdict_of(report).model_dump(mode="json")
        print_json({**verdict, **about(read, lines), **shown}, files)
    else:
        _print(report, files, lines, options)
    if report.safe and open_still:
        return UNDECIDED
    return 0 if report.safe else UNSAFE if report.decided else UNDECIDED


def _print(
    report: "Report", files: Sequence[Path], lines: Sequence[str], options: Mapping[str, Any]
) -> None:
    """All that is said for readers."""
    print_report(report, options["brackets"])
    print_files(files)
    print_explanation(lines)
    if options["show_plan"]:
        from benchdragon.plans.keys import commented

        click.echo("\n" + commented(report.plan.data(), {}), nl=False)


def _shown(plan: "Plan", progress: "Progress") -> "Report":
    """A check whose contact is proved; where that cannot be, what was found, and why that is all."""
    from benchdragon.analysis.check import check as checked
    from benchdragon.analysis.left_open import Unproved

    try:
        return checked(plan, progress, prove=True)
    except (UnsureError, OverBudgetError) as error:
        return replace(checked(plan, progress), unproved=(Unproved("contact", error),))


def _notes(plan: "Plan") -> Sequence[str]:
    """What is odd about the list of names; one that cannot be read is reported."""
    from benchdragon.plans.roster import roster_of
    from benchdragon.plans.toml import PlanError

    try:
        return roster_of(plan).notes
    except PlanError as error:
        click.echo(str(error), err=True)
        return ()


def print_report(report: "Report", brackets: bool = False) -> None:
    """A report for readers."""
    from benchdragon.analysis.check import clearance_text, speed_text
    from benchdragon.number_format import seconds

    print_title(report.plan)
    if report.safe:
        text = _("SAFE from t = {start} s to t = {end} s")
        if report.proved:
            text = _("SAFE from t = {start} s to t = {end} s: proved that no benches come too near")
            if report.obstacles:
                text = _(
                    "SAFE from t = {start} s to t = {end} s: proved that no benches come too near to "
                    "one another, to an obstacle or to the venue's edge"
                )
        click.echo(text.format(start=seconds(report.start), end=seconds(report.end)))
    elif report.decided:
        click.echo(_("NOT SAFE"))
    else:
        click.echo(_("UNDECIDED"))
    for finding in report.findings:
        click.echo(f"  {finding.code}: {finding.text}")
    if report.unfinished is not None:
        click.echo(_("WARNING: {what}").format(what=report.unfinished.text))
    _print_left_open(report)
    if report.first_contact is not None:
        near, margin = report.first_contact.witness, report.plan.limits.margin
        name = _("first contact")
        if near is not None and near.gap > 0.0:
            name = _("first nearer than {margin} m").format(margin=f"{margin:g}")
        when = report.first_contact.shown(up=False)
        print_answer(name, report.first_contact, up=False, brackets=brackets, shown=when)
        click.echo(_("until then:"))
    gap, most = clearance_text(report), speed_text(report)
    print_answer(_("least clearance"), report.clearance, up=False, brackets=brackets, shown=gap)
    for answers in report.obstacles:
        print_distance(answers, brackets=brackets)
    _print_room(report)
    name = _("greatest speed of a handle")
    print_answer(name, report.greatest_speed, up=True, brackets=brackets, shown=most)
    _print_rest(report, brackets)


def _print_left_open(report: "Report") -> None:
    """Print the answers whose proof failed, and what the check did not consider."""
    for proof in report.unproved:
        click.echo(proof.text)
    if report.not_looked_at:
        click.echo(_("not checked:"))
    for one in report.not_looked_at:
        click.echo(f"  {one.text}")


def _print_rest(report: "Report", brackets: bool) -> None:
    """Peaks of what is limited, and the stops of the head."""
    from benchdragon.analysis.check import peak_shown, peak_text
    from benchdragon.analysis.stops import stops_text

    for name, peak in report.peaks.items():
        shown = peak_shown(report, name)
        print_answer(peak_text(name), peak, up=True, brackets=brackets, shown=shown)
    if report.stops is not None:
        click.echo(stops_text(report.stops))


def _print_room(report: "Report") -> None:
    """The levels of room for people, if there are any, one a line."""
    from benchdragon.explain.room import level_line

    if report.room:
        click.echo(_("room for people, level upon level:"))
    for level in report.room:
        click.echo(f"  {level_line(level)}")
