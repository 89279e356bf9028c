"""What sentences about the benches of a plan rest on: its clock, people, landmarks by each bench."""

import math
from collections.abc import Callable, Sequence

import numpy as np

from benchdragon.analysis.bench_walks import BenchWalk
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.findings import named
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.obstacle_distance import nearest_boxes
from benchdragon.explain.bench_text import Basis, BenchText, Halt, Landmark, bench_lines
from benchdragon.kernels.box import Box
from benchdragon.plans.cues import cue_name
from benchdragon.plans.schema import Plan


def bench_text(plan: Plan, found: BenchWalk, called: Callable[[int], str], ground: Ground) -> BenchText:
    """The sentences on one bench of a plan; `called` gives the name of a bench by its number."""
    clock, coiled = Clock(plan.cues.clock, found.stretches[0].start), plan.route.kind == "spiral-in"
    basis = Basis(clock, plan.people, ground, halts_of(plan), coiled)
    return bench_lines(basis, found, landmark_of(plan, found, ground), called)


def halts_of(plan: Plan) -> tuple[Halt, ...]:
    """What the plan says the head stands for, in the language in use."""
    return tuple(
        Halt(moment.time, moment.until, cue_name(moment.cue))
        for moment in plan.moments()
        if moment.cue.kind in ("hold", "stop") and (moment.cue.text or moment.cue.text_zh)
    )


def landmark_of(plan: Plan, found: BenchWalk, ground: Ground) -> Landmark:
    """What is nearest to a bench when the dance starts: the peg to its front handle, all else to it."""
    best = Landmark(math.dist(found.place, ground.peg))
    for obstacle in plan.obstacles():
        far, which = nearest_boxes(np.array([found.box]), obstacle)
        apart = max(float(far[0]) - obstacle.radius, 0.0)
        if apart < best.apart:
            side = obstacle.boxes[int(which[0])].tolist()
            edge = _edge(found, ground, side) if obstacle.kind == "venue" else None
            best = Landmark(apart, named(obstacle), edge)
    return best


def _edge(found: BenchWalk, ground: Ground, side: Sequence[float]) -> int:
    """Over which edge the way out is nearest that leads over a side of the venue (a box)."""
    x, y = side[Box.UY], -side[Box.UX]
    inwards = x * (side[Box.CX] - found.box[Box.CX]) + y * (side[Box.CY] - found.box[Box.CY]) < 0.0
    return ground.edge((-x, -y) if inwards else (x, y))
