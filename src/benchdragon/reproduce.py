"""The paper again, from one call: its tables, its pictures, its checks, and how far each is exact."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchdragon import __version__
from benchdragon.differences import SCHEMES, difference_errors, difference_speeds, order
from benchdragon.files import refuse_existing, whole_file
from benchdragon.messages import _, language
from benchdragon.motion import Motion, Walk
from benchdragon.pictures import dragon_picture, head_angle_picture, speed_map, write_picture
from benchdragon.plan import Plan, read_plan
from benchdragon.tables import Selection, write_csv, write_npz, write_xlsx
from benchdragon.turns import TwoArcTurn

# The contest's own times and handles.
TABLE_TIMES = (0.0, 60.0, 120.0, 180.0, 240.0, 300.0)
TABLE_HANDLES = (0, 1, 51, 101, 151, 201, 223)
TURN_TIMES = (-50.0, 0.0, 14.0, 50.0)
PICTURE_KINDS = ("png", "svg", "pdf")
# Steps, s, at which differences and Runge-Kutta are compared; the fits use all of them.
DIFFERENCE_STEPS = (0.4, 0.2, 0.1, 0.05)
RUNGE_KUTTA_STEPS = (10.0, 5.0, 2.5)

# How often `reproduce` reports an advance.
STEPS = 7 + len(PICTURE_KINDS)

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
        for name in ("spiral-dragon", "spiral-speeds", "spiral-head", "turn-dragon", "turn-speeds")
        for kind in PICTURE_KINDS
    ]
    names = ["result1.xlsx", "spiral.csv", "spiral.npz", *pictures, "answers.json"]
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
    answers = {
        "version": __version__,
        "plans": {"spiral-in": spiral.sha256, "turn": turn.sha256},
        "table": table(motion),
        "largest_chord_error_m": max(motion.chord_error, turn_motion.chord_error),
    }
    advance(_("Runge-Kutta"))
    answers["runge_kutta"] = runge_kutta(walk, times)
    advance(_("differences"))
    answers["differences"] = differences(walk)
    answers["turn"] = turn_answers(turn)
    _write_tables(folder, walk, times, advance)
    _draw_all(folder, spiral, motion, turn, turn_motion, advance)
    with whole_file(folder / "answers.json") as temporary:
        temporary.write_text(json.dumps(answers, indent=1, ensure_ascii=False) + "\n", "utf-8")
    return Reproduction(answers, files)


def table(motion: Motion) -> list[dict[str, float]]:
    """The contest's table: six times by seven handles, x, y (m) and speed (m/s)."""
    return [
        {
            "time_s": t,
            "handle": handle,
            "x_m": float(motion.x[int(t), handle]),
            "y_m": float(motion.y[int(t), handle]),
            "speed_m_s": float(motion.speed[int(t), handle]),
        }
        for t in TABLE_TIMES
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


def turn_answers(plan: Plan) -> dict[str, Any]:
    """Radii, length and boundary angles of the paper's turn."""
    turn = TwoArcTurn(1.7, plan.disc.radius or 4.5, plan.turn.ratio)
    names = ("theta_max1", "theta_min1", "theta_min2", "theta_max2")
    return {
        "radii_m": list(turn.radii),
        "length_m": turn.length,
        **dict(zip(names, turn.boundary_angles(), strict=True)),
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


def _draw_all(
    folder: Path, spiral: Plan, motion: Motion, turn: Plan, turn_motion: Motion, advance: Advance
) -> None:
    title, turn_title = spiral.title(language()), turn.title(language())
    at = partial(np.searchsorted, turn_motion.times)
    advance(_("pictures"))
    jobs = {
        "spiral-dragon": (spiral, title, dragon_picture(motion, title, (0, 300))),
        "spiral-speeds": (spiral, title, speed_map(motion, title)),
        "spiral-head": (spiral, title, head_angle_picture(motion, title)),
        "turn-dragon": (
            turn,
            turn_title,
            dragon_picture(turn_motion, turn_title, [int(at(t)) for t in TURN_TIMES], turn.disc.radius),
        ),
        "turn-speeds": (turn, turn_title, speed_map(turn_motion, turn_title)),
    }
    for kind in PICTURE_KINDS:
        advance(_("pictures") + f" ({kind})")
        for name, (plan, about, figure) in jobs.items():
            write_picture(figure, folder / f"{name}.{kind}", about, plan.sha256)
