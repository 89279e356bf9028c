"""The files of a verdict: the moment of contact as a table and a picture, clearance over time."""

from collections.abc import Sequence
from pathlib import Path

from benchdragon.analysis.certificate import certificate_of, write_certificate
from benchdragon.analysis.check import Report, clearance_over, moment
from benchdragon.export.tables import write_moment_xlsx
from benchdragon.figures.contact import clearance_picture, moment_picture
from benchdragon.figures.style import write_picture
from benchdragon.files import refuse_existing
from benchdragon.i18n import language

CERTIFICATE = "certificate.json"
FORMATS = ("xlsx", "png", "svg", "pdf")


def planned_files(folder: Path, formats: Sequence[str], force: bool, proved: bool) -> list[Path]:
    """The files that a verdict writes into a folder, its certificate among them if it is `proved`.

    Raises:
        FileRefusedError: if one is there already and `force` is not set.
    """
    files = [folder / "result2.xlsx"] if "xlsx" in formats else []
    for kind in formats:
        if kind != "xlsx":
            files += [folder / f"contact.{kind}", folder / f"clearance.{kind}"]
    files += [folder / CERTIFICATE] if proved else []
    refuse_existing(files, force)
    return files


def write_files(report: Report, files: Sequence[Path]) -> list[Path]:
    """Write the planned files, but no certificate where nothing was proved; those that were written."""
    files = [path for path in files if path.name != CERTIFICATE or report.claims or report.speeds]
    if not files:
        return files
    motion, answer = moment(report)
    title, plan = report.plan.title(language()), report.plan
    clearances = clearance_over(report)
    figures = {
        "contact": moment_picture(motion, answer, title, plan.disc.radius, plan.obstacles()),
        "clearance": clearance_picture(clearances, plan.limits.margin, title),
    }
    for path in files:
        if path.name == CERTIFICATE:
            write_certificate(certificate_of(report.plan, report.claims, report.speeds), path)
        elif path.suffix == ".xlsx":
            tables = motion.x[0], motion.y[0], motion.speed[0]
            write_moment_xlsx(path, tables, report.obstacles)
        else:
            write_picture(figures[path.stem], path, title, plan.sha256)
    return files
