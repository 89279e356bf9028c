"""The files of a verdict: the moment of contact as a table and a picture, clearance over time."""

from collections.abc import Sequence
from pathlib import Path

from benchdragon.analysis.check import Report, clearance_over, moment
from benchdragon.export.tables import write_moment_xlsx
from benchdragon.figures.contact import clearance_picture, moment_picture
from benchdragon.figures.style import write_picture
from benchdragon.i18n import language

FORMATS = ("xlsx", "png", "svg", "pdf")


def planned_files(folder: Path, formats: Sequence[str]) -> list[Path]:
    """The files that a verdict writes into a folder."""
    files = [folder / "result2.xlsx"] if "xlsx" in formats else []
    for kind in formats:
        if kind != "xlsx":
            files += [folder / f"contact.{kind}", folder / f"clearance.{kind}"]
    return files


def write_files(report: Report, files: Sequence[Path]) -> None:
    """Write the planned files."""
    motion, answer = moment(report)
    title, plan = report.plan.title(language()), report.plan
    clearances = clearance_over(report)
    figures = {
        "contact": moment_picture(motion, answer, title, plan.disc.radius, plan.obstacles()),
        "clearance": clearance_picture(clearances, plan.limits.margin, title),
    }
    for path in files:
        if path.suffix == ".xlsx":
            tables = motion.x[0], motion.y[0], motion.speed[0]
            write_moment_xlsx(path, tables, report.obstacles)
        else:
            write_picture(figures[path.stem], path, title, plan.sha256)
