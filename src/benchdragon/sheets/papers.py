"""The papers of a dance, by name: what `benchdragon sheets` writes. A new one is a row of PAPERS."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchdragon.analysis.beats import counted_in, score_of
from benchdragon.errors import InputError
from benchdragon.export.metronome import write_track
from benchdragon.files import refuse_existing
from benchdragon.i18n import N_, _
from benchdragon.player.page import write_player
from benchdragon.player.scene import checked_dance
from benchdragon.progress import Progress, silent, stages
from benchdragon.sheets.annex import annex_names, write_annex
from benchdragon.sheets.briefing import Briefing
from benchdragon.sheets.cards import write_benches
from benchdragon.sheets.chalk import FILES, write_chalk
from benchdragon.sheets.options import Options
from benchdragon.sheets.overview import write_overview
from benchdragon.sheets.timetable import write_timetable_pdf, write_timetable_xlsx

# Writes the files of a paper into a folder, each whole or not at all.
Write = Callable[[Briefing, Path, Options, Progress], None]


@dataclass(frozen=True)
class Paper:
    """A paper.

    Attributes:
        text: the progress text while it is written.
        files: names of all its files.
        write: writes them.
    """

    text: str
    files: tuple[str, ...]
    write: Write


def _benches(briefing: Briefing, folder: Path, options: Options, progress: Progress) -> None:
    write_benches(folder / "benches.pdf", briefing, options, progress)


def _overview(briefing: Briefing, folder: Path, options: Options, _progress: Progress) -> None:
    write_overview(folder / "overview.pdf", briefing, options.phones)


def _chalk(briefing: Briefing, folder: Path, options: Options, _progress: Progress) -> None:
    write_chalk(briefing, folder, options.chalk)


def _timetable(briefing: Briefing, folder: Path, _options: Options, _progress: Progress) -> None:
    write_timetable_pdf(folder / "timetable.pdf", briefing)
    write_timetable_xlsx(folder / "timetable.xlsx", briefing)


def _beat(briefing: Briefing, folder: Path, _options: Options, progress: Progress) -> None:
    report = briefing.report
    score = counted_in(score_of(report.plan, report.start, report.end))
    start = min([report.start, *(run.start for run in score.runs[:1])])
    write_track(folder / "beat.wav", score, (start, report.end), progress=progress)


def _annex(briefing: Briefing, folder: Path, _options: Options, progress: Progress) -> None:
    write_annex(folder, briefing, progress)


def _player(briefing: Briefing, folder: Path, _options: Options, progress: Progress) -> None:
    dance = checked_dance(briefing.report, progress=progress)
    dance = dance.model_copy(update={"papers_sha256": briefing.sha256})
    write_player(folder / "player.html", dance)


PAPERS: dict[str, Paper] = {
    "benches": Paper(N_("benches' sheets"), ("benches.pdf",), _benches),
    "overview": Paper(N_("the leader's overview"), ("overview.pdf",), _overview),
    "chalk": Paper(N_("chalk plan"), FILES, _chalk),
    "timetable": Paper(N_("timetable"), ("timetable.pdf", "timetable.xlsx"), _timetable),
    "beat": Paper(N_("drum beat"), ("beat.wav",), _beat),
    "annex": Paper(N_("permit annex"), annex_names(), _annex),
    "player": Paper(N_("player"), ("player.html",), _player),
}


def chosen_papers(names: str | None) -> list[str]:
    """The papers in a list with commas, "benches,chalk"; all if it is None.

    Raises:
        InputError: for one that is not known.
    """
    if names is None:
        return list(PAPERS)
    chosen = list(dict.fromkeys(name.strip() for name in names.split(",")))
    unknown = [name for name in chosen if name not in PAPERS]
    if unknown:
        text = _("--only: expected some of {known}, not {text}")
        raise InputError(text.format(known=", ".join(PAPERS), text=repr(unknown[0])))
    return chosen


def planned_papers(folder: Path, names: Sequence[str], force: bool) -> list[Path]:
    """The files of papers, before they are written.

    Raises:
        FileRefusedError: if one is there already and `force` is not set.
    """
    paths = [folder / file for name in names for file in PAPERS[name].files]
    refuse_existing(paths, force)
    return paths


def write_papers(
    briefing: Briefing,
    folder: Path,
    names: Sequence[str],
    options: Options,
    progress: Progress = silent,
) -> None:
    """Write papers, one after another, into a folder that is there."""
    stage = stages(progress, len(names))
    for name in names:
        PAPERS[name].write(briefing, folder, options, stage(_(PAPERS[name].text)))
