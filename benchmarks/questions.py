"""The questions that are timed, asked at the front door alone, so that older versions can be asked too.

As a script it is a process that answers: the name of a question a line in, what it took and what came
out a line out. With names as arguments it answers each of them once, and ends.
"""

import json
import math
import sys
import time
from collections.abc import Callable, Sequence

import numpy as np

import benchdragon as bd

Answers = Sequence[float]
# What an engine imports that is no library built ahead of time.
ENGINES = ("numba", "wasmtime")
# What is asked, and its making, which is not timed.
Question = Callable[[], Callable[[], Answers]]

DISC = "disc.radius=4.5"
SECONDS = np.arange(301.0)
TURN_SECONDS = np.arange(-100.0, 101.0)


def value_of(found: bd.Answer | None) -> float:
    """The number of an answer, if there is one."""
    return math.nan if found is None else found.value


def contact(benches: int) -> Callable[[], Answers]:
    """When benches first touch on the way in; the walk is made anew each time."""
    plan = bd.read_plan("spiral-in", [f"dragon.benches={benches}"])

    def job() -> Answers:
        walk = plan.build()
        return [value_of(bd.first_contact(walk, *plan.span(walk)))]

    return job


def pitch() -> Callable[[], Answers]:
    """The smallest pitch."""
    plan = bd.read_plan("spiral-in", [DISC])
    return lambda: [bd.smallest_pitch(plan).value]


def head_speed() -> Callable[[], Answers]:
    """How fast the head may walk through the turn."""
    plan = bd.read_plan("turn")
    return lambda: [bd.greatest_head_speed(plan).value]


def clearance() -> Callable[[], Answers]:
    """How near benches come on the whole way through the turn."""
    plan = bd.read_plan("turn")

    def job() -> Answers:
        walk = plan.build()
        return [bd.least_clearance(walk, *plan.span(walk)).value]

    return job


def table() -> Callable[[], Answers]:
    """All handles each second."""
    plan = bd.read_plan("spiral-in")
    return lambda: plan.build().motion(SECONDS).x[-1]


def five() -> Callable[[], Answers]:
    """The contest's five questions, with its own turn: whether others are shorter is asked apart."""
    spiral, disc, turn = (
        bd.read_plan("spiral-in"),
        bd.read_plan("spiral-in", [DISC]),
        bd.read_plan("turn"),
    )

    def job() -> Answers:
        walk, turning = spiral.build(), turn.build()
        tables = walk.motion(SECONDS), turning.motion(TURN_SECONDS)
        touch = value_of(bd.first_contact(walk, *spiral.span(walk)))
        there = walk.motion([touch])
        arcs = bd.TwoArcTurn(1.7)
        near = bd.least_clearance(turning, *turn.span(turning)).value
        numbers = [bd.smallest_pitch(disc).value, arcs.length, near, bd.greatest_head_speed(turn).value]
        return [touch, *numbers, *(float(one.x[-1, -1]) for one in (*tables, there))]

    return job


def verdict(name: str, *settings: str) -> Callable[[], Answers]:
    """Whether a plan's whole walk is safe, with its least clearance and greatest speed."""
    plan = bd.read_plan(name, list(settings))

    def job() -> Answers:
        found = bd.check(plan)
        return [value_of(found.first_contact), found.clearance.value]

    return job


def better_turn() -> Callable[[], Answers]:
    """The shortest path through the disc with a line between the arcs."""
    plan = bd.read_plan("turn", ["turn.family=arc-line-arc", "walk.speed=1.3"])
    goal = bd.TurnGoal("way", least_radius=1.5027)
    return lambda: [bd.best_turn(plan, goal).way]


QUESTIONS: dict[str, Question] = {
    "first contact, 223 benches": lambda: contact(223),
    "smallest pitch, disc of 4.5 m": pitch,
    "greatest head speed of the turn": head_speed,
    "least clearance of the turn": clearance,
    "the contest's five questions": five,
    "first contact, 100,000 benches": lambda: contact(100_000),
    "standard table, 224 handles x 301 times": table,
    "verdict on the way in": lambda: verdict("spiral-in"),
    "verdict on the way in to the disc": lambda: verdict("spiral-in", DISC),
    "verdict on the turn": lambda: verdict("turn"),
    "best turn, a line between the arcs": better_turn,
}


def serve() -> None:
    """Answer the questions that come in, each one untimed before it is timed for the first time."""
    print(json.dumps({"file": bd.__file__}), flush=True)
    jobs: dict[str, Callable[[], Answers]] = {}
    for line in sys.stdin:
        name = line.strip()
        if name not in jobs:
            jobs[name] = QUESTIONS[name]()
            jobs[name]()
        wall, cpu = time.perf_counter(), time.process_time()
        answers = jobs[name]()
        took = {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}
        engine = next((name for name in ENGINES if name in sys.modules), "")
        numbers = [float(answer) for answer in answers]
        print(json.dumps({**took, "answers": numbers, "engine": engine}), flush=True)


if __name__ == "__main__":
    if sys.argv[1:]:
        for asked in sys.argv[1:]:
            print(asked, list(QUESTIONS[asked]()()))
    else:
        serve()
