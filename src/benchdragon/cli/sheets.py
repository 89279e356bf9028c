"""The verb `sheets`: all papers of a dance that was checked."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import UNDECIDED, UNSAFE
from benchdragon.cli.check import print_report
from benchdragon.cli.console import print_files, shown_progress
from benchdragon.cli.options import folder_option, only_with, plan_to_walk, take, tell_names, verb
from benchdragon.cli.parsing import PAPERS, parse_scale
from benchdragon.i18n import N_, _
from benchdragon.progress import part

if TYPE_CHECKING:
    from benchdragon.sheets.options import ChalkOptions

# Options by the papers that they speak of.
SPEAK_OF = {
    ("benches",): ("paper", "by", "night"),
    ("benches", "overview"): ("phones",),
    ("chalk",): ("scale", "paper_size"),
}


@verb
@take("plan")
@click.option(
    "--only", metavar="LIST", help=N_("Write these papers alone, for example overview,chalk.")
)
@click.option(
    "--paper",
    type=click.Choice(["a4", "quarter", "lanyard"], case_sensitive=False),
    default="a4",
    help=N_("Size of the benches' sheets: A4, four on an A4 page, cards to hang round the neck."),
)
@click.option(
    "--by",
    type=click.Choice(["bench", "household"]),
    default="bench",
    help=N_("A sheet for each bench, or the benches of a household one after another."),
)
@click.option("--night", is_flag=True, help=N_("Large type, to be read by lantern light."))
@click.option(
    "--phones", is_flag=True, help=N_("Print phone numbers too, which else stay in the list.")
)
@click.option(
    "--scale",
    metavar="1:NUMBER",
    help=N_("Of the chalk plan: 1:50 to 1:500. Default: the largest usual one that fits."),
)
@click.option(
    "--paper-size",
    type=click.Choice(PAPERS, case_sensitive=False),
    help=N_("Of the chalk plan, which comes as A4 pages too. Default: one that suits."),
)
@click.option("--check", "anew", is_flag=True, help=N_("Check the plan and record it, then go on."))
@folder_option(Path("sheets"))
@take("shared")
def sheets(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Write what people hold in their hands: a sheet for each bench, an overview, and more.

    PLAN is a *.dragon.toml file whose check was recorded: benchdragon check PLAN --record. For example:
    benchdragon sheets village.dragon.toml -o papers --paper quarter
    """
    from benchdragon.analysis.check import check
    from benchdragon.plans.roster import roster_of
    from benchdragon.plans.toml import built_in_names
    from benchdragon.sheets.briefing import briefing_of
    from benchdragon.sheets.checked import read_record, record_check, record_path
    from benchdragon.sheets.options import Options
    from benchdragon.sheets.papers import chosen_papers, planned_papers, write_papers

    names = chosen_papers(options["only"])
    for papers, speaking in SPEAK_OF.items():
        only_with(" / ".join(papers), any(paper in names for paper in papers), *speaking)
    path = None if options["anew"] and plan in built_in_names() else record_path(plan)
    read, folder = plan_to_walk(plan, settings, quiet), options["output"]
    read.build()  # says what is wrong, before a folder is made
    roster = roster_of(read)
    record = None if path is None or options["anew"] else read_record(path, read, roster, plan)
    looks = *(options[name] for name in ("paper", "by", "night", "phones")), _chalk_options(options)
    files = planned_papers(folder, names, options["force"])
    if "benches" in names and not read.people.address and not quiet:
        click.echo(_("No QR codes: the plan does not say people.address."), err=True)
    with _whole_told(files), shown_progress(quiet) as progress:
        report = check(read, part(progress, 0.0, 0.2))
        if report.safe:
            record = record or record_check(path, report, roster)
            briefing = briefing_of(report, roster, record)
            write_papers(briefing, folder, names, Options(*looks), part(progress, 0.2, 1.0))
    if not report.safe:
        tell_names(roster.notes, quiet)
        print_report(report)
        click.echo(_("No papers were written: only a plan that is safe has any."), err=True)
        return UNSAFE if report.decided else UNDECIDED
    tell_names((*briefing.odd_signs, *roster.notes), quiet)
    print_files(files)
    return 0


@contextmanager
def _whole_told(files: Sequence[Path]) -> Iterator[None]:
    """Where the work is interrupted, say which files it has made by then: each of them is whole."""
    before = {path: _made_at(path) for path in files}
    try:
        yield
    except (KeyboardInterrupt, click.Abort):
        made = [path for path in files if _made_at(path) != before[path]]
        if made:
            text = _("These papers are whole, and those not named were not made: {files}")
            with suppress(OSError):  # there is no reader any more
                click.echo(text.format(files=_(", ").join(map(str, made))), err=True)
        raise


def _made_at(path: Path) -> int:
    """When a file was made, ns; 0 where there is none."""
    return path.stat().st_mtime_ns if path.exists() else 0


def _chalk_options(options: dict[str, Any]) -> "ChalkOptions":
    """The options of the chalk plan; InputError for an impossible scale."""
    from benchdragon.figures.chalk import MOST_CHALK_SCALE
    from benchdragon.figures.scale import check_scale
    from benchdragon.sheets.options import ChalkOptions

    scale = parse_scale("--scale", options["scale"])
    check_scale(scale, MOST_CHALK_SCALE)
    return ChalkOptions(options["paper_size"], scale)
