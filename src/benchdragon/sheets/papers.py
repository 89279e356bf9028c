"""Papers of a dance that are made here, and not in the planner's page: what `sheets --pdf` adds."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchdragon.analysis.beats import counted_in, score_of
from benchdragon.export.metronome import write_track
from benchdragon.i18n import N_, _
from benchdragon.progress import Progress, silent, stages
from benchdragon.sheets.briefing import Briefing

# Writes the files of a paper into a folder, each whole or not at all.
Write = Callable[[Briefing, Path, Progress], None]


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


def _beat(briefing: Briefing, folder: Path, progress: Progress) -> None:
    report = briefing.report
    score = counted_in(score_of(report.plan, report.start, report.end))
    start = min([report.start, *(run.start for run in score.runs[:1])])
    write_track(folder / "beat.wav", score, (start, report.end), progress=progress)


MADE_HERE: dict[str, Paper] = {
    "beat": Paper(N_("drum beat"), ("beat.wav",), _beat),
}


def files_made_here(folder: Path, names: Iterable[str]) -> list[Path]:
    """The files of papers, before they are made."""
    return [folder / file for name in names for file in MADE_HERE[name].files]


def make_here(
    briefing: Briefing, folder: Path, names: Sequence[str], progress: Progress = silent
) -> None:
    """Make papers, one after another, in a folder that is there."""
    stage = stages(progress, len(names))
    for name in names:
        MADE_HERE[name].write(briefing, folder, stage(_(MADE_HERE[name].text)))
