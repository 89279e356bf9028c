"""The paper again, from one call: its tables, pictures and answers, and a report on all of them."""

import json
import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from benchdragon.analysis.check import moment
from benchdragon.analysis.contact import first_contact
from benchdragon.errors import InputError
from benchdragon.export.pages import write_pdf
from benchdragon.export.publish import write_html
from benchdragon.export.tables import Selection, write_csv, write_npz
from benchdragon.figures.contact import clearance_picture, moment_picture
from benchdragon.figures.style import lay_out, write_picture
from benchdragon.figures.tolerance import margin_picture
from benchdragon.figures.walk import dragon_picture, speed_map
from benchdragon.files import refuse_existing, write_whole
from benchdragon.i18n import _, language
from benchdragon.model.answer import Answer
from benchdragon.paper.derivations import allowed_speed, contact_of
from benchdragon.paper.evidence_figures import (
    accumulation_picture,
    convergence_picture,
    flow_picture,
    pitch_picture,
    stepping_picture,
)
from benchdragon.paper.geometry_figures import axes_picture, polar_picture, triangle_picture
from benchdragon.paper.handed_in import TIMES, write_result1, write_result2, write_result4
from benchdragon.paper.report import FLOW, report
from benchdragon.paper.results import Results, as_json, results
from benchdragon.paper.turn_figures import (
    ShownTurn,
    construction_picture,
    front_picture,
    ratio_picture,
    turn_speeds_picture,
    turns_picture,
)
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import read_plan
from benchdragon.progress import Progress, Stage, part, silent, stages
from benchdragon.solve.size import smallest_pitch
from benchdragon.solve.tolerance import CASES

TURN_TIMES = {"turn-arriving": (-50.0, 0.0), "turn-dragon": (14.0, 50.0)}
# Times, s, over which speeds in the turn are drawn (from, to, step), how far about its greatest
# ratio it is enlarged, and how long before the contact the separating axes are drawn.
TURNING, CLOSE, BEFORE_CONTACT = (-10.0, 60.0, 0.02), 0.6, 2.5
PICTURE_KINDS = ("png", "svg", "pdf")
PICTURES = (
    "spiral-dragon", "spiral-speeds", "contact", "clearance", "pitch", "turn-disc",
    *TURN_TIMES, "turn-speeds", "turn-better", "turn-front", "turn-ratio", "flow", "errors-orders",
    "errors-chain", "errors-steps", "margins", "geometry-polar", "geometry-triangle", "geometry-axes",
)  # fmt: skip
TABLES = ("result1.xlsx", "result2.xlsx", "result4.xlsx", "spiral.csv", "spiral.npz")

# Share of the work that the answers take; the rest goes into files.
COMPUTED = 0.8


@dataclass(frozen=True)
class Reproduction:
    """The result: answers by name (SI units), and the files written."""

    answers: dict[str, Any]
    files: list[Path]


def first_answers() -> tuple[Answer, Answer]:
    """First contact (s) and smallest pitch (m), found at once: `reproduce` takes minutes."""
    spiral = read_plan("spiral-in")
    walk = spiral.build()
    contact = first_contact(walk, *spiral.span(walk))
    if contact is None:
        raise AssertionError("the paper's dragon touches itself")
    return contact, smallest_pitch(read_plan("question-3"))


def planned_files(folder: Path) -> list[Path]:
    """The files that `reproduce` writes into `folder`."""
    pictures = [f"{name}.{kind}" for name in PICTURES for kind in PICTURE_KINDS]
    names = ["report.html", "report.pdf", *TABLES, *pictures, "answers.json"]
    return [folder / name for name in names]


def reproduce(
    folder: Path, force: bool = False, progress: Progress = silent, docs: str | None = None,
    first: Callable[[Answer, Answer, Path], None] | None = None,
) -> Reproduction:  # fmt: skip
    """Walk the paper's two parts and write report, tables, pictures and `answers.json` into `folder`.

    Args:
        folder: made if it is not there.
        force: whether files that are there are overwritten.
        progress: is called with the share and the step at work.
        docs: folder or address of the documentation's pages, for links in the report; None: no links.
        first: is called, within seconds, with the first contact, the smallest pitch and the report's
            path.

    Raises:
        FileRefusedError: if a file is there already and `force` is not set.
        InputError: for a folder of pages that is not there.
    """
    files, pages = planned_files(folder), None if docs is None else pages_from(folder, docs)
    refuse_existing(files, force)
    if first is not None:
        first(*first_answers(), files[0])
    found = results(part(progress, 0.0, COMPUTED))
    stage = stages(part(progress, COMPUTED, 1.0), 3 + len(PICTURE_KINDS))
    stage(_("tables"))
    _write_tables(folder, found)
    stage(_("pictures"))
    figures = all_figures(found)
    _write_pictures(folder, found, figures, stage)
    answers = as_json(found)
    stage(_("report"))
    written = report(found, pages)
    write_html(folder / "report.html", written, folder)
    write_pdf(folder / "report.pdf", written, folder)
    write_whole(folder / "answers.json", json.dumps(answers, indent=1, ensure_ascii=False) + "\n")
    return Reproduction(answers, files)


def pages_from(folder: Path, docs: str) -> str:
    """The address of the documentation's pages as a link from `folder`.

    Raises:
        InputError: for a folder that holds no such pages.
    """
    if "://" in docs:
        return docs
    if not (Path(docs) / "established.html").is_file():
        text = _("--docs: there are no pages in {folder}; `make docs` builds them")
        raise InputError(text.format(folder=docs))
    try:
        return Path(os.path.relpath(docs, folder)).as_posix()
    except ValueError:  # they lie on another drive of Windows
        return Path(docs).resolve().as_uri()


def _write_tables(folder: Path, found: Results) -> None:
    walk, motion = found.motion.walk, found.motion
    what = Selection(walk, motion.times, range(len(walk.dragon) + 1))
    write_csv(folder / "spiral.csv", what, silent)
    write_npz(folder / "spiral.npz", what, silent)
    standing, turning = moment(found.report)[0], found.turn_motion.walk.motion(TIMES["result4"])
    for name, write, held in (
        ("result1.xlsx", write_result1, motion),
        ("result2.xlsx", write_result2, standing),
        ("result4.xlsx", write_result4, turning),
    ):
        write(folder / name, held.x, held.y, held.speed, force=True)


def all_figures(found: Results) -> dict[str, Figure]:
    """The pictures, by the names in PICTURES; where one has a lone title, its caption says as much."""
    figures = {
        **_spiral_figures(found),
        **_turn_figures(found),
        **_evidence_figures(found),
        **_geometry_figures(found),
    }
    for figure in figures.values():
        titled = [panel for panel in figure.axes if panel.get_title()]
        if len(titled) == 1:
            titled[0].set_title("")
    return figures


def _spiral_figures(found: Results) -> dict[str, Figure]:
    return {
        "spiral-dragon": dragon_picture(found.motion, "", (0, 300)),
        "spiral-speeds": speed_map(found.motion),
        "contact": moment_picture(*moment(found.report)),
        "clearance": clearance_picture(found.clearance, found.spiral.limits.margin),
        "pitch": pitch_picture(found.curve, found.smallest.value),
    }


def _turn_figures(found: Results) -> dict[str, Figure]:
    plan, motion, disc = found.turn, found.turn_motion, TurnRoute.disc(found.turn)
    turn, fastest = plan.turn.build(plan.value("route.pitch"), disc), found.head_speed.value
    paper = ShownTurn(_("the paper's two arcs"), turn, fastest)
    text = _("arc, line, arc")
    better = [ShownTurn(text, best.turn, allowed_speed(best)) for best in found.front]
    points = [(allowed_speed(best), best.way, best.length) for best in found.different]
    walk, middle = motion.walk, found.turn_greatest_at
    close = walk.motion(np.linspace(middle - CLOSE, middle + CLOSE, 801))
    limit, turning = plan.limits.speed or math.nan, walk.motion(np.arange(*TURNING))
    return {
        "turn-disc": construction_picture(found.two_arcs),
        **{
            name: dragon_picture(motion, "", np.searchsorted(motion.times, times).tolist(), disc)
            for name, times in TURN_TIMES.items()
        },
        "turn-speeds": turn_speeds_picture(turning),
        "turn-better": turns_picture([paper, better[found.told], better[-1]], disc),
        "turn-front": front_picture(points, (fastest, turn.length)),
        "turn-ratio": ratio_picture(turning, close, found.head_speed, limit),
    }


def _evidence_figures(found: Results) -> dict[str, Figure]:
    by_pitch = [(p, answer.value) for p, t, answer in found.traversal if t == 1.0]
    flow = [(_(paper), _(here)) for paper, here in FLOW]
    return {
        "flow": flow_picture(flow),
        "errors-orders": convergence_picture(found.head_order, found.speed_orders),
        "errors-chain": accumulation_picture(found.off, found.off_bisected, found.residuals),
        "errors-steps": stepping_picture(found.stepped, found.windows, by_pitch, found.smallest.value),
        "margins": margin_picture(
            {name: found.dances.tolerance(name) for name in CASES},
            {name: _(case.text) for name, case in CASES.items()},
        ),
    }


def _geometry_figures(found: Results) -> dict[str, Figure]:
    contact, walk = contact_of(found), found.motion.walk
    pair = contact.witness.benches[:2] if contact.witness else ()
    return {
        "geometry-polar": polar_picture(walk.motion([300.0])),
        "geometry-triangle": triangle_picture(found.turn_motion.walk, found.two_arcs),
        "geometry-axes": axes_picture(walk.motion([contact.value - BEFORE_CONTACT]), pair),
    }


def _write_pictures(folder: Path, found: Results, figures: dict[str, Figure], stage: Stage) -> None:
    others = {"turn": found.turn, "pitch": found.disc, "margins": found.disc}
    for figure in figures.values():
        lay_out(figure)
    for kind in PICTURE_KINDS:
        stage(_("pictures") + f" ({kind})")
        for name, figure in figures.items():
            plan = others.get(name.partition("-")[0], found.spiral)
            path = folder / f"{name}.{kind}"
            write_picture(figure, path, plan.title(language()), plan.sha256)
