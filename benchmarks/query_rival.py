"""A rival in Python that answers queries: `python query_rival.py fcl` (or coal); it needs NumPy.

Reads names of files from its input, one a line, and answers each with a line of JSON: for each query of
the file the seconds of processor time taken, and how many steps after the first pose contact was told,
or null. A file is doubles: for each query how many poses, half the length of either bench and half
their width, m, then of each pose x, y, m, and the heading, rad, of one bench and of the other.
"""

import json
import math
import os
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

Told = tuple[float, float | None]
# Nearer than this, m, counts as contact where a rival asks what does.
TOLERANCE = 1e-7
ROUNDS = 200
# How often this process was begun anew, and how often it may be.
TRIES, MOST_TRIES = "QUERY_RIVAL_TRIES", 50


def rotations(angles: np.ndarray) -> np.ndarray:
    """Matrices of rotations about z, (n, 3, 3)."""
    turned = np.zeros((len(angles), 3, 3))
    turned[:, 0, 0] = turned[:, 1, 1] = np.cos(angles)
    turned[:, 1, 0] = np.sin(angles)
    turned[:, 0, 1] = -turned[:, 1, 0]
    turned[:, 2, 2] = 1.0
    return turned


def fcl() -> Callable[[float, float, float, np.ndarray], Told]:
    """FCL's conservative advancement from pose to pose."""
    import fcl as rival

    request = rival.ContinuousCollisionRequest(
        num_max_iterations=ROUNDS, toc_err=TOLERANCE,
        ccd_motion_type=rival.CCDMotionType.CCDM_LINEAR,
        ccd_solver_type=rival.CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT,
    )  # fmt: skip

    def ask(one: float, other: float, half: float, poses: np.ndarray) -> Told:
        objects, places = [], []
        for k, long in ((0, one), (3, other)):
            at = np.column_stack([poses[:, k : k + 2], np.zeros(len(poses))])
            turned = zip(rotations(poses[:, k + 2]), at, strict=True)
            places.append([rival.Transform(*each) for each in turned])
            objects.append(rival.CollisionObject(rival.Box(2.0 * long, 2.0 * half, 1.0), places[-1][0]))
        (a, b), (a_at, b_at) = objects, places
        began = time.process_time()
        for n in range(len(poses) - 1):
            a.setTransform(a_at[n])
            b.setTransform(b_at[n])
            result = rival.ContinuousCollisionResult()
            share = rival.continuousCollide(a, a_at[n + 1], b, b_at[n + 1], request, result)
            if result.is_collide:
                return time.process_time() - began, n + share
        return time.process_time() - began, None

    return ask


def coal() -> Callable[[float, float, float, np.ndarray], Told]:
    """Conservative advancement by Coal's distance, poses being interpolated: it has none of its own."""
    import coal as rival

    request, result = rival.DistanceRequest(), rival.DistanceResult()

    def ask(one: float, other: float, half: float, poses: np.ndarray) -> Told:
        boxes = [
            rival.Box(2.0 * long, 2.0 * half, 1.0) for long in (one, other)
        ]  # of which it keeps none
        distance = rival.ComputeDistance(*boxes)
        radii = math.hypot(one, half), math.hypot(other, half)
        steps, listed = np.diff(poses, axis=0).tolist(), poses.tolist()
        began = time.process_time()
        for n, step in enumerate(steps):
            near, share = listed[n], 0.0
            pace = math.hypot(step[3] - step[0], step[4] - step[1])
            pace += radii[0] * abs(step[2]) + radii[1] * abs(step[5])
            for _round in range(ROUNDS):
                x, y, turn, other_x, other_y, other_turn = (
                    a + share * d for a, d in zip(near, step, strict=True)
                )
                result.clear()
                apart = distance(
                    placed(x, y, turn), placed(other_x, other_y, other_turn), request, result
                )
                if apart <= TOLERANCE:
                    return time.process_time() - began, n + share
                if apart > (1.0 - share) * pace:
                    break
                share += apart / pace
        return time.process_time() - began, None

    def placed(x: float, y: float, turn: float) -> Any:
        c, s = math.cos(turn), math.sin(turn)
        return rival.Transform3s(
            np.array(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))), np.array((x, y, 0.0))
        )

    return ask


def sound(ask: Callable[[float, float, float, np.ndarray], Told]) -> bool:
    """Whether a rival sees where one bench comes down on another, in the eighth of ten steps."""
    down = np.linspace(1.0, 0.0, 11)
    poses = np.stack([down, down, 0.0 * down, 0.0 * down, 1.0 + down, 0.0 * down], 1)
    poses[:, :2] = 0.0
    _seconds, told = ask(1.0, 1.0, 0.625, poses)
    return told is not None and abs(told - 7.5) < 0.01


def main() -> None:
    """Answer file after file."""
    ask = {"fcl": fcl, "coal": coal}[sys.argv[1]]()
    tries = int(os.environ.get(TRIES, "0"))
    if (
        not sound(ask) and tries < MOST_TRIES
    ):  # FCL answers nonsense in some processes, from their start
        os.environ[TRIES] = str(tries + 1)
        os.execv(sys.executable, [sys.executable, *sys.argv])
    for line in sys.stdin:
        numbers, at, told = np.fromfile(line.strip()), 0, []
        while at < len(numbers):
            count, one, other, half = numbers[at : at + 4].tolist()
            end = at + 4 + 6 * int(count)
            told.append(ask(one, other, half, numbers[at + 4 : end].reshape(-1, 6)))
            at = end
        print(json.dumps(told), flush=True)


if __name__ == "__main__":
    main()
