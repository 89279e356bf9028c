"""The files of a verdict: the moment of contact as a table and a picture, clearance over time."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from benchdragon.check import Report, moment
from benchdragon.contact import ClearanceCurve, clearance_curve
from benchdragon.contact_pictures import clearance_picture, moment_picture
from benchdragon.errors import InputError
from benchdragon.files import refuse_existing
from benchdragon.messages import _, language
from benchdragon.pictures import write_picture
from benchdragon.tables import write_moment_xlsx

FORMATS = ("xlsx", "png", "svg", "pdf")
# Samples of the clearance drawn, and seconds shown after a contact.
SAMPLES = 1000
AFTER = 3.0


def planned_files(folder: Path, formats: Sequence[str], force: bool) -> list[Path]:
    """The files that a verdict writes into a folder.

    Raises:
        InputError: for a format that is not one of FORMATS.
        FileRefusedError: if one is there already and `force` is not set.
    """
    for name in formats:
        if name not in FORMATS:
            raise InputError(
                _("--format: wanted some of {known}, not {text}").format(
                    known=", ".join(FORMATS), text=repr(name)
                )
            )
    files = [folder / "result2.xlsx"] if "xlsx" in formats else []
    for kind in formats:
        if kind != "xlsx":
            files += [folder / f"contact.{kind}", folder / f"clearance.{kind}"]
    refuse_existing(files, force)
    return files


def curve(report: Report) -> ClearanceCurve:
    """Clearance over the whole walk, or until shortly after a contact."""
    walk, end = report.plan.build(), report.end
    contact = report.first_contact
    if contact is not None:
        end = min(end, contact.upper + AFTER)
    times = np.linspace(report.start, end, SAMPLES)
    while walk.motion(times, throw=False).status.any():  # the walk falls shortly after the contact
        times = times[:-1]
    return clearance_curve(walk, times)


def write_files(report: Report, files: Sequence[Path]) -> None:
    """Write the planned files."""
    if not files:
        return
    motion, answer = moment(report)
    title, plan = report.plan.title(language()), report.plan
    clearances = curve(report)
    figures = {
        "contact": moment_picture(motion, answer, title, plan.disc.radius),
        "clearance": clearance_picture(clearances, plan.limits.margin, title),
    }
    for path in files:
        if path.suffix == ".xlsx":
            write_moment_xlsx(path, motion)
        else:
            write_picture(figures[path.stem], path, title, plan.sha256)
