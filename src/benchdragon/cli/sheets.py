"""The verb `sheets`: all papers of a dance, as one page, and printed."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import click

from benchdragon.cli.answers import UNDECIDED, UNSAFE, about
from benchdragon.cli.check import print_report
from benchdragon.cli.console import print_files, print_json, shown_progress
from benchdragon.cli.options import FILE, FOLDER, only_with, plan_to_walk, take, tell_names, verb
from benchdragon.cli.parsing import check_ending, parse_names
from benchdragon.i18n import N_, _
from benchdragon.progress import part

# The drum as a sound file, which is written beside what a browser prints.
DRUM = "beat"
# Options by the papers that they speak of.
SPEAK_OF = {
    ("benches",): ("paper", "by", "night"),
    ("benches", "overview"): ("phones",),
}


@verb("sheets village.dragon.toml -o papers.html --paper quarter")
@take("plan")
@click.option(
    "-o",
    "--output",
    type=FILE,
    metavar="FILE",
    default=Path("papers.html"),
    help=N_("The page to write, which any browser shows and prints."),
)
@click.option(
    "--pdf",
    "folder",
    type=FOLDER,
    metavar="DIR",
    help=N_(
        "Folder for PDF files too, one of each kind: a browser prints them (Chromium, Chrome, Edge, "
        "Firefox)."
    ),
)
@take("force")
@click.option("--only", metavar="LIST", help=N_("Make these papers alone, for example overview,chalk."))
@click.option(
    "--paper",
    type=click.Choice(["A4", "quarter", "lanyard"], case_sensitive=False),
    default="A4",
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
@take("json", "shared")
def sheets(
    plan: str,
    settings: tuple[str, ...],
    output: Path,
    folder: Path | None,
    force: bool,
    quiet: bool,
    **options: Any,
) -> int:
    """Write what people hold in their hands: a sheet for each bench, an overview, and more.

    Only a plan that is safe has papers. The page that is written needs no network; it holds the plan
    and its list of names.
    """
    from benchdragon.analysis.check import check
    from benchdragon.export.metronome import write_drum
    from benchdragon.files import refuse_existing
    from benchdragon.planner.papers import PAPERS, wanted_papers, write_papers
    from benchdragon.planner.printing import found_browser, print_papers
    from benchdragon.plans.roster import roster_of

    check_ending("-o", output, [".html"])
    papers = (*PAPERS, DRUM)
    names = parse_names("--only", options["only"] or ",".join(papers), papers)
    for kinds, speaking in SPEAK_OF.items():
        only_with(" / ".join(kinds), any(kind in names for kind in kinds), *speaking)
    shown = [name for name in names if name != DRUM]
    read = plan_to_walk(plan, settings, quiet)
    read.build()  # says what is wrong, before a folder is made
    roster = roster_of(read)
    printed = {name: folder / f"{name}.pdf" for name in shown} if folder else {}
    drums = [folder / f"{DRUM}.wav"] if folder and DRUM in names else []
    files = [output, *printed.values(), *drums]
    refuse_existing(files, force)
    if "benches" in names and not read.people.address and not quiet:
        click.echo(_("No QR codes: the plan does not say people.address."), err=True)
    with _whole_told(files), shown_progress(quiet) as progress:
        report = check(read, part(progress, 0.0, 0.2))
        if report.safe:
            write_papers(output, read, wanted_papers(shown, roster, options))
            if printed:
                print_papers(found_browser(output), output, printed, part(progress, 0.2, 0.8))
            for path in drums:
                write_drum(path, read, (report.start, report.end), part(progress, 0.8, 1.0))
    tell_names(roster.notes, quiet)
    if options["as_json"]:
        print_json({"safe": report.safe, **about(read, [])}, files if report.safe else [])
    elif report.safe:
        print_files(files)
    else:
        print_report(report)
    if not report.safe:
        click.echo(_("No papers were written: only a plan that is safe has any."), err=True)
        return UNSAFE if report.decided else UNDECIDED
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
