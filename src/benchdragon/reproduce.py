"""The paper again, from one call: its tables, its pictures, its checks, and how far each is exact."""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from benchdragon import __version__
from benchdragon.best_turn import BestTurn, Wish, pareto_front
from benchdragon.check import Report, check
from benchdragon.contact_pictures import clearance_picture, moment_picture, pitch_picture
from benchdragon.differences import SCHEMES, difference_errors, difference_speeds, order
from benchdragon.files import refuse_existing, whole_file
from benchdragon.messages import _, language
from benchdragon.motion import Motion, Walk
from benchdragon.pace import greatest_head_speed
from benchdragon.pictures import dragon_picture, head_angle_picture, speed_map, write_picture
from benchdragon.plan import Plan, read_plan
from benchdragon.solve import smallest_pitch
from benchdragon.tables import Selection, write_csv, write_moment_xlsx, write_npz, write_xlsx
from benchdragon.traversal import pitch_curve, traversed_pitch
from benchdragon.turn_pictures import ShownTurn, front_picture, turns_picture
from benchdragon.turns import TwoArcTurn
from benchdragon.verdict_files import curve, moment

# The contest's own times and handles.
TABLE_TIMES = (0.0, 60.0, 120.0, 180.0, 240.0, 300.0)
TABLE_HANDLES = (0, 1, 51, 101, 151, 201, 223)
CONTACT_HANDLES = (0, 1, 51, 101, 151, 201, 223)
TURN_TIMES = (-50.0, 0.0, 14.0, 50.0)
# The contest's times of the turn's table.
MOTION_TIMES = (-100.0, -50.0, 0.0, 14.0, 50.0, 100.0)
PICTURE_KINDS = ("png", "svg", "pdf")
# Steps, s, at which differences and Runge-Kutta are compared; the fits use all of them.
DIFFERENCE_STEPS = (0.4, 0.2, 0.1, 0.05)
RUNGE_KUTTA_STEPS = (10.0, 5.0, 2.5)

# Steps of the paper's traversal whose answers are compared, pitch (m) and time (s), and the first pitch
# tried; the last looks at the moment alone at which the head reaches the disc.
TRAVERSALS = (
    (0.002, 1.0, 0.44), (0.001, 1.0, 0.44), (0.0005, 1.0, 0.448), (0.002, 0.2, 0.448),
    (0.001, 1e6, 0.41),
)  # fmt: skip
# Pitches of the paper's Fig 2, m.
FIGURE_PITCHES, FIGURE_RESOLUTION = (0.43, 0.47, 21), 1e-4
SPIRAL_PICTURES = ("spiral-dragon", "spiral-speeds", "spiral-head")
CONTACT_PICTURES = ("contact", "clearance", "pitch")
TURN_PICTURES = ("turn-disc", "turn-dragon", "turn-speeds", "turn-better", "turn-front")
# Head speeds, m/s, for which the shortest turn is sought; bends are no tighter than the paper's.
FRONT_SPEEDS = (1.3, 1.5, 1.7)

# How often `reproduce` reports an advance.
STEPS = 13 + len(FRONT_SPEEDS) + len(PICTURE_KINDS)

Advance = Callable[[str], None]


@dataclass(frozen=True)
class Reproduction:
    """What came out: answers by name (SI units), and the files written."""

    answers: dict[str, Any]
    files: list[Path]


def planned_files(folder: Path) -> list[Path]:
    """The files that `reproduce` writes into `folder`."""
    pictures = [
        f"{name}.{kind}"
        for name in (*SPIRAL_PICTURES, *CONTACT_PICTURES, *TURN_PICTURES)
        for kind in PICTURE_KINDS
    ]
    names = [
        "result1.xlsx",
        "result2.xlsx",
        "result4.xlsx",
        "spiral.csv",
        "spiral.npz",
        *pictures,
        "answers.json",
    ]
    return [folder / name for name in names]


def reproduce(folder: Path, force: bool = False, advance: Advance = lambda _text: None) -> Reproduction:
    """Walk the paper's two parts and write tables, pictures and `answers.json` into `folder`.

    Raises:
        FileRefusedError: if a file is there already and `force` is not set.
    """
    files = planned_files(folder)
    refuse_existing(files, force)
    spiral, turn = read_plan("spiral-in"), read_plan("turn")
    walk, turn_walk = spiral.build(), turn.build()
    times, turn_times = np.arange(301.0), np.linspace(-100.0, 100.0, 2001)
    advance(_("walking"))
    motion, turn_motion = walk.motion(times), turn_walk.motion(turn_times)
    answers: dict[str, Any] = {
        "version": __version__,
        "plans": {"spiral-in": spiral.sha256, "turn": turn.sha256},
        "table": table(motion, TABLE_TIMES),
        "largest_chord_error_m": max(motion.chord_error, turn_motion.chord_error),
    }
    advance(_("Runge-Kutta"))
    answers["runge_kutta"] = runge_kutta(walk, times)
    advance(_("differences"))
    answers["differences"] = differences(walk)
    advance(_("turn"))
    turn_report = check(turn)
    front = _front(turn, advance)
    answers["turn"] = turn_answers(turn_report, front)
    advance(_("contact"))
    report = check(spiral)
    answers["contact"] = contact_answers(report)
    disc = read_plan("spiral-in", [f"disc.radius={turn.disc.radius}"])
    answers["pitch"] = pitch_answers(disc, advance)
    _write_tables(folder, walk, times, advance)
    write_moment_xlsx(folder / "result2.xlsx", moment(report)[0])
    advance("result4.xlsx")
    whole = Selection(turn_walk, np.arange(-100.0, 101.0), range(len(turn_walk.dragon) + 1))
    write_xlsx(folder / "result4.xlsx", whole, lambda _share: None)
    figures = {
        **_spiral_figures(spiral, motion),
        **_contact_figures(report, disc, answers["pitch"]["smallest"]["value"], advance),
        **_turn_figures(turn, turn_motion, answers["turn"]["greatest_head_speed"]["value"], front),
    }
    _write_pictures(folder, {"turn": turn, "pitch": disc}, spiral, figures, advance)
    with whole_file(folder / "answers.json") as temporary:
        temporary.write_text(json.dumps(answers, indent=1, ensure_ascii=False) + "\n", "utf-8")
    return Reproduction(answers, files)


def table(motion: Motion, times: Sequence[float]) -> list[dict[str, float]]:
    """The contest's table: so many of the motion's times by seven handles, x, y (m), speed (m/s)."""
    return [
        {
            "time_s": t,
            "handle": handle,
            "x_m": float(motion.x[row, handle]),
            "y_m": float(motion.y[row, handle]),
            "speed_m_s": float(motion.speed[row, handle]),
        }
        for t, row in ((t, int(np.searchsorted(motion.times, t))) for t in times)
        for handle in TABLE_HANDLES
    ]


def runge_kutta(walk: Walk, times: np.ndarray[Any, Any]) -> dict[str, float]:
    """How far the two Runge-Kutta roads to the head differ from the closed form, and RK4's order."""
    exact = walk.head_position(times)
    apart = {
        "rk4_step_0.1_s_m": _largest(walk.head_position(times, "rk4", 0.1) - exact),
        "adaptive_m": _largest(walk.head_position(times, "adaptive") - exact),
    }
    ends = [0.0, 300.0]
    errors = [
        _largest(walk.head_position(ends, "rk4", step) - walk.head_position(ends))
        for step in RUNGE_KUTTA_STEPS
    ]
    return {**apart, "rk4_order": order(RUNGE_KUTTA_STEPS, np.array(errors))}


def differences(walk: Walk) -> dict[str, dict[str, float]]:
    """For each formula: the head's speed from places 1 s apart, its error, and the measured order."""
    times = np.arange(10.0, 291.0, 10.0)
    found: dict[str, dict[str, float]] = {}
    for scheme in SCHEMES:
        head = difference_speeds(walk, times, 1.0, scheme)[:, 0]
        errors = difference_errors(walk, times, DIFFERENCE_STEPS, scheme)
        found[scheme] = {
            "head_speed_m_s": float(head.mean()),
            "head_speed_error_m_s": _largest(head - 1.0),
            "largest_velocity_error_step_0.1_s_m_s": float(errors[DIFFERENCE_STEPS.index(0.1)]),
            "order": order(DIFFERENCE_STEPS, errors),
        }
    return found


def _front(plan: Plan, advance: Advance) -> list[BestTurn]:
    """Shortest turns with a line between the arcs, for each of FRONT_SPEEDS."""
    table = plan.turn.model_copy(update={"family": "arc-line-arc"})
    wish = Wish("way", least_radius=TwoArcTurn(1.7).radii[1])

    def tell(share: float, text: str) -> None:
        if share:
            advance(text)

    return pareto_front(plan.model_copy(update={"turn": table}), FRONT_SPEEDS, wish, advance=tell)


def turn_answers(report: Report, front: Sequence[BestTurn]) -> dict[str, Any]:
    """The paper's turn: sizes, motion, greatest head speed, clearance; and better turns."""
    plan = report.plan
    turn = TwoArcTurn(1.7, plan.disc.radius or 4.5, plan.turn.ratio)
    names = ("theta_max1", "theta_min1", "theta_min2", "theta_max2")
    return {
        "radii_m": list(turn.radii),
        "length_m": turn.length,
        **dict(zip(names, turn.boundary_angles(), strict=True)),
        "table": table(plan.build().motion(MOTION_TIMES), MOTION_TIMES),
        "greatest_head_speed": greatest_head_speed(plan, tolerance=1e-12).as_json(),
        "clearance": report.clearance.as_json(),
        "better": [best.as_json() for best in front],
    }


def _largest(values: np.ndarray[Any, Any]) -> float:
    return float(np.abs(values).max())


def _write_tables(folder: Path, walk: Walk, times: np.ndarray[Any, Any], advance: Advance) -> None:
    what = Selection(walk, times, range(len(walk.dragon) + 1))
    for name, write in (
        ("result1.xlsx", write_xlsx),
        ("spiral.csv", write_csv),
        ("spiral.npz", write_npz),
    ):
        advance(name)
        write(folder / name, what, lambda _share: None)


def contact_answers(report: Report) -> dict[str, Any]:
    """The first contact, and the contest's table of places and speeds then."""
    motion, answer = moment(report)
    rows = [
        {
            "handle": handle,
            "x_m": float(motion.x[0, handle]),
            "y_m": float(motion.y[0, handle]),
            "speed_m_s": float(motion.speed[0, handle]),
        }
        for handle in CONTACT_HANDLES
    ]
    return {"first": answer.as_json(), "table": rows}


def pitch_answers(plan: Plan, advance: Advance) -> dict[str, Any]:
    """The smallest pitch, and what the paper's traversal finds with several steps."""
    advance(_("smallest pitch"))
    answer = smallest_pitch(plan)
    traversed = []
    advance(_("traversal of pitches"))
    for pitch_step, time_step, first in TRAVERSALS:
        found = traversed_pitch(plan, pitch_step, time_step, first=first)
        traversed.append({"pitch_step_m": pitch_step, "time_step_s": time_step, "pitch_m": found.value})
    walk = plan.with_value("route.pitch", answer.value).build()
    before = None if answer.witness is None else walk.route.length - answer.witness.s
    return {"smallest": answer.as_json(), "before_disc_m": before, "traversal": traversed}


def _spiral_figures(plan: Plan, motion: Motion) -> dict[str, Figure]:
    title = plan.title(language())
    return {
        "spiral-dragon": dragon_picture(motion, title, (0, 300)),
        "spiral-speeds": speed_map(motion, title),
        "spiral-head": head_angle_picture(motion, title),
    }


def _contact_figures(
    report: Report, disc: Plan, smallest: float, advance: Advance
) -> dict[str, Figure]:
    title = report.plan.title(language())
    advance(_("clearance"))
    near = np.array([smallest - 1e-9, smallest + 1e-9])
    low, high, count = FIGURE_PITCHES
    pitches = np.concatenate([np.linspace(low, high, count), near])
    advance(_("smallest pitch"))
    drawn = pitch_curve(disc, pitches, resolution=FIGURE_RESOLUTION)
    return {
        "contact": moment_picture(*moment(report), title),
        "clearance": clearance_picture(curve(report), report.plan.limits.margin, title),
        "pitch": pitch_picture(drawn, smallest, title),
    }


def _turn_figures(
    plan: Plan, motion: Motion, head_speed: float, front: Sequence[BestTurn]
) -> dict[str, Figure]:
    title, disc = plan.title(language()), plan.disc.radius or 4.5
    at = [int(np.searchsorted(motion.times, t)) for t in TURN_TIMES]
    paper = ShownTurn(_("the paper's two arcs"), plan.turn.build(1.7, disc), head_speed)
    allowed = [best.head_speed.value if best.head_speed else 0.0 for best in front]
    better = [
        ShownTurn(_("arc, line, arc"), best.turn, speed)
        for best, speed in zip(front, allowed, strict=True)
    ]
    points = [(speed, best.way, best.length) for best, speed in zip(front, allowed, strict=True)]
    return {
        "turn-disc": turns_picture([paper], disc, title),
        "turn-dragon": dragon_picture(motion, title, at, disc),
        "turn-speeds": speed_map(motion, title, motion.walk.route.joints[1:-1].tolist()),
        "turn-better": turns_picture([paper, better[0], better[-1]], disc, title),
        "turn-front": front_picture(points, (head_speed, paper.turn.length), title),
    }


def _write_pictures(
    folder: Path, others: dict[str, Plan], spiral: Plan, figures: dict[str, Figure], advance: Advance
) -> None:
    for kind in PICTURE_KINDS:
        advance(_("pictures") + f" ({kind})")
        for name, figure in figures.items():
            plan = others.get(name.partition("-")[0], spiral)
            path = folder / f"{name}.{kind}"
            write_picture(figure, path, plan.title(language()), plan.sha256)
