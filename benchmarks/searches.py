"""Searches: what the bound for spirals saves, how cost grows, and quick answers beside exact ones."""

import math
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import partial
from unittest import mock

import numpy as np
from questions import DISC, contact
from standard import WALK
from timing import LEAST, Job, Options, digits, fastest, lines_of, repeats_of

from benchdragon import (
    Answer,
    TurnGoal,
    best_turn,
    clearances,
    first_contact,
    greatest_head_speed,
    limit,
    read_plan,
    smallest_pitch,
)
from benchdragon.analysis.distance import nearest_each
from benchdragon.kernels import contact_question, question, search_room, size_question
from benchdragon.kernels.search_start import begin_walk
from benchdragon.kernels.workspace import Walk, Workspace
from benchdragon.solve.size import QUICK_SIZE

# Entries of questions that plain Python answers where one looks into them.
ASKED = {
    question: ("close_question",),
    contact_question: ("open_contact", "seek_contact", "read_contact", "step_contact"),
    size_question: ("open_size", "seek_size", "read_size", "step_size"),
}
# Plans whose verdicts are compared, and settings of the way in to the disc whose smallest pitches are.
PITCHES: tuple[tuple[str, ...], ...] = (
    (), ("route.pitch=0.44",), ("route.pitch=0.6",), ("dragon.width=0.5",),
)  # fmt: skip


def in_python(job: Callable[[], Answer | None], *, bound: bool = True) -> Answer | None:
    """What a search answers that plain Python asks of the engine's other entries.

    Without the bound it boxes every cell, as on curves that are no spirals.
    """
    begun = []

    def begin_without(walk: Walk, room: Workspace, *span: float) -> bool:
        begun.append(begin_walk(walk, room, *span))
        if not bound:
            room.ground.spans[:] = math.inf, -math.inf
        return begun[-1]

    with ExitStack() as stack:
        for module, names in ASKED.items():
            for name in names:
                plain = getattr(module, name).__wrapped__
                stack.enter_context(mock.patch.object(module, name, plain))
        stack.enter_context(mock.patch.object(search_room, "begin_walk", begin_without))
        found = job()
    if not begun:
        raise AssertionError("searches no longer begin where the bound was taken from them")
    return found


def spiral_bound(options: Options) -> list[str]:
    """Rows of searches with the bound for spirals, and without."""
    walk, disc = read_plan("spiral-in").build(), read_plan("spiral-in", [DISC])
    searches: dict[str, Callable[[], Answer | None]] = {
        "first contact": lambda: first_contact(walk, 0.0, 430.0),
        "smallest pitch, disc of 4.5 m": lambda: smallest_pitch(disc),
    }
    rows = []
    for name, job in searches.items():
        ask, bare = partial(in_python, job), partial(in_python, job, bound=False)
        found, again = ask(), bare()
        if found is None or again is None:
            raise AssertionError(f"{name} was found before")
        ours, theirs = fastest([ask, bare], 1 if options.quick else 10)
        rows.append([
            name, digits(1e3 * ours), digits(1e3 * theirs), digits(theirs / ours),
            f"{found.value:.13f} {found.unit}", f"{abs(found.value - again.value):.0e} {found.unit}",
        ])  # fmt: skip
    columns = ("search", "ms", "without the bound, ms", "without / with", "answer", "answers differ by")
    return lines_of(columns, rows)


def contact_growth(options: Options) -> list[str]:
    """Rows of first contacts of longer and longer dragons."""
    rows = []
    for benches in (100, 1000) if options.quick else (100, 1_000, 10_000, 100_000):
        job = contact(benches)
        (once,) = fastest([job], 1)
        (seconds,) = fastest([job], repeats_of(once, options))
        rows.append([f"{benches:,}", digits(1e3 * seconds), digits(1e6 * seconds / benches)])
    return lines_of(("benches", "first contact, ms", "us a bench"), rows)


def turns(options: Options) -> list[str]:
    """Rows of the greatest head speed, as its cost grows, and of a best turn, in a warm process."""
    turn, rows = read_plan("turn"), []
    for benches in (100, 223) if options.quick else (100, 223, 1000, 3000):
        ask = partial(greatest_head_speed, turn.with_value("dragon.benches", benches), tolerance=1e-12)
        found = ask()
        (seconds,) = fastest([ask], 1 if options.quick else LEAST)
        name = f"greatest head speed, bracket {found.upper - found.lower:.0e} m/s"
        rows.append([name, f"{benches:,}", digits(seconds), f"{found.value:.13f} m/s"])
    if not options.quick:
        plan = read_plan("turn", ["turn.family=arc-line-arc", "walk.speed=1.3"])
        began = time.perf_counter()
        best = best_turn(plan, TurnGoal("way", least_radius=1.5027))
        seconds = time.perf_counter() - began
        name = "best turn, arc-line-arc, at 1.3 m/s"
        rows.append([name, f"{plan.dragon.benches}", digits(seconds), f"{best.way:.4f} m"])
    return lines_of(("question", "benches", "s", "answer"), rows)


def quick_answers(options: Options) -> list[str]:
    """A quick answer beside an exact one, the smallest pitch, and the nearest of each bench."""
    pitches = []
    for settings in ([DISC, *more] for more in PITCHES):
        plan = read_plan("spiral-in", settings)
        sought = [partial(limit, plan, "pitch"), partial(limit, plan, "pitch", tolerance=QUICK_SIZE)]
        pitches.append(beside("spiral-in", settings, sought, options))
    motion = WALK.motion(np.linspace(0.0, 400.0, 64))
    each, pair = fastest([partial(nearest_each, motion), partial(clearances, motion)], 5)
    times = ("exact, ms", "quick, ms", "exact / quick")
    nearest = [
        ["each bench's nearest", f"{1e3 * each / 64:.3f}"],
        ["the nearest pair, by a hash grid", f"{1e3 * pair / 64:.3f}"],
    ]
    return [
        *lines_of(("plan", f"smallest pitch: {times[0]}", *times[1:]), pitches), "",
        *lines_of(("223 benches in a coil", "ms a time"), nearest),
    ]  # fmt: skip


def beside(name: str, settings: Sequence[str], jobs: Sequence[Job], options: Options) -> list[str]:
    """A row of an exact and a quick job that take turns."""
    for job in jobs:
        job()
    exact, loose = fastest(jobs, 1 if options.quick else LEAST)
    return [
        " ".join([name, *settings]),
        digits(1e3 * exact),
        digits(1e3 * loose),
        digits(exact / loose),
    ]
