"""Questions that call every entry between them, and what lets each call be seen."""

import dataclasses
import sys
import types
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import benchdragon.proofs.exact  # noqa: F401 - else imported by a proof, once entries are wrapped
from benchdragon.analysis.bench_walks import bench_walks
from benchdragon.analysis.chalk import chalk_plan
from benchdragon.analysis.chalk_line import Trail
from benchdragon.analysis.check import check
from benchdragon.analysis.contact import least_clearance
from benchdragon.analysis.distance import (
    boxes,
    low_point,
    nearest_each,
    pair_distances,
    tightest_pairs,
)
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.obstacle_distance import nearest_boxes
from benchdragon.analysis.off_tracking import off_tracking
from benchdragon.analysis.proof import prove_contact
from benchdragon.analysis.speed import greatest_speed
from benchdragon.analysis.swept import swept_area
from benchdragon.analysis.tables import kinds_of
from benchdragon.kernels import entries, time_of_impact
from benchdragon.kernels.binomial import tails
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.every_pair import search_all_pairs
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.pair_queries import ANSWER_COLUMNS, NUMBERS, search_pairs
from benchdragon.kernels.rounding import SEAM_COLUMNS
from benchdragon.kernels.time_of_impact import Goal
from benchdragon.model.connections import Step, connections, programme
from benchdragon.model.curves import Arc, Clothoid, Line, Route, Spiral
from benchdragon.model.formations import CoilIn, FigureEight, TailSwing
from benchdragon.paper.runge_kutta import head_positions
from benchdragon.paper.traversal import first_overlap
from benchdragon.plans.schema import checked, read_plan
from benchdragon.player.following import following
from benchdragon.player.scene import Span, plain_dance
from benchdragon.solve.head_speed import slowed
from benchdragon.solve.square import Square
from benchdragon.solve.tolerance import CASES, Draw, Tolerance, needed_pitch, touches
from benchdragon.surveys.clothoids import g1_clothoids
from benchdragon.surveys.fitting import fitted
from benchdragon.surveys.lines import DrawnLine, corners_of
from tests.solve.asked_in_python import in_python
from tests.solve.dances import Laid, brute, laid

# Its plain functions call its entries, which no compiled function does.
MIXED = tuple(f"benchdragon.kernels.{name}" for name in ("grid", "search_room", "contact_steps"))


def wrap(wrapper: Callable[[str, Any], Callable[..., Any]]) -> None:
    """Let all modules but the kernels call what `wrapper` makes of each entry and its name."""
    calls: dict[int, Callable[..., Any]] = {}
    for name in entries.ENTRIES:
        home, _, short = name.rpartition(".")
        served = getattr(sys.modules[home], short)
        calls[id(served)] = wrapper(name, served)
    for name, module in list(sys.modules.items()):
        inside = name == "__main__" or name.startswith(("benchdragon.", "tests."))
        if name in MIXED or (inside and not name.startswith("benchdragon.kernels")):
            for key, value in list(vars(module).items()):
                if id(value) in calls:
                    setattr(module, key, calls[id(value)])
                elif isinstance(value, types.ModuleType) and "benchdragon.kernels." in value.__name__:
                    members = {k: calls.get(id(v), v) for k, v in vars(value).items()}
                    if any(v is not members[k] for k, v in vars(value).items()):
                        setattr(module, key, types.SimpleNamespace(**members))


def questions() -> None:
    """Questions that need every entry between them."""
    few = read_plan("spiral-in", ["dragon.benches=12"])
    turn = read_plan("turn", ["walk.speed=1.5", "dragon.benches=12", "walk.start=-20", "walk.end=20"])
    check(few)
    bench_walks(few, few.build(), (0.0, 2.0))
    plain_dance(few.build(), Span(0.0, 4.0))
    following(few.build(), 0.0, 4.0, 1e-3, (0.5,), compared=60)
    off_tracking(few, 0.2, 0.0, 4.0)
    walk = few.build()
    assert chalk_plan(Trail.of(walk, 0.0, 4.0), 1.65, Ground.of(few, walk.route)) is not None
    read_plan("spiral-in", ["dragon.benches=12", 'cues.cue=[{kind="hold", head=5, hold=3}]']).build()
    well = '[{kind="circle", centre=[8, 3], radius=0.5}, {kind="line", points=[[0, 2], [1, 2]]}]'
    check(read_plan("spiral-in", ["dragon.benches=12", "venue.rectangle=[30, 30]", f"obstacle={well}"]))
    assert swept_area(few.build(), 0.0, 20.0, error=0.1).widest.width.value > 0.3
    square = Square(turn.with_values({"venue.rectangle": [40, 30], "route.at": [0, 0]}))
    assert square.room([0.0, 0.0, 0.0]) > 0.0
    assert square.extent(30.0)[1] < square.circle()[2] + 1.0
    slowed(turn)
    least_clearance(turn.build(), -20.0, 20.0)
    with pytest.MonkeyPatch.context() as patch:
        in_python(patch)
        least_clearance(turn.build(), -20.0, 20.0)
    walk = few.build()
    away = walk.route.moved(0.0, (1e5, 0.0))
    least_clearance(dataclasses.replace(walk, route=away), 0.0, 9.0)
    greatest_speed(read_plan("turn").build(), -50.0, 50.0)
    read_plan("turn", ["turn.family=arc-arc-arc", "turn.curvature=0.2", "turn.ease=0.3"]).build()
    places = empty_placements(len(walk.dragon) + 1, 2)
    place_chain(walk.route.rows, walk.dragon.links, np.array([0.0, 60.0]), 0, 2, places)
    assert walk.head_where_tail(9.0) > 9.0
    low_point(walk, 0, 4, 0.0, 60.0)
    motion = walk.motion([0.0, 60.0])
    pair_distances(motion, 0, 4)
    tightest_pairs(motion)
    kinds_of(walk.dragon.sizes)
    (thing, *_others) = read_plan("spiral-in", [f"obstacle={well}"]).obstacles()
    nearest_boxes(boxes(motion, 0), thing)
    thing.forbids(np.zeros((1, 2)))
    motion.acceleration.sum()
    nearest_each(motion)
    assert first_overlap(walk, np.array([0.0, 9.0])) is None
    head_positions(walk, [0.0, 9.0])
    prove_contact(read_plan("spiral-in").build(), 412.0, 413.0)
    route = Route.joined([Line(16.0), Clothoid(2.5, 0.0, 0.8), Arc(1.25, 2.0), Line(6.0)])
    route.point([1.0, 17.0])
    assert route.start_pose != route.end_pose
    Spiral(0.55, 40.0, 0.0).angle(1.0)
    assert len(connections(((0.0, 0.0), 0.0), ((9.0, 4.0), 2.0), 1.5)) >= 4
    steps = [Step(FigureEight(6.0)), Step(CoilIn(), (40.0, 0.0), 1.0), Step(TailSwing(run=0.0))]
    programme(steps, 2.0)
    swung = {"kind": "formation", "name": "tail-swing"}
    checked({"schema": 1, "dragon": {"benches": 5}, "route": swung}, "plan").build()
    drawn = DrawnLine("", corners_of([(0.0, 0.0), (20.0, 1.0), (25.0, 12.0), (40.0, 12.0)]))
    for smooth in ("none", "G1", "G2"):
        fitted(drawn, smooth, 9.0)
    g1_clothoids(np.array([(0.0, 0.0, 0.3), (5.0, 1.0, -0.2), (9.0, 1.0, 0.4)]))
    coiled = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=20", "walk.start=225"])
    draw = Draw(CASES["all"].deviations, 7, 1)
    touches(coiled, draw)
    needed_pitch(coiled, draw, 0.5)
    draw.noise(0, 9)
    found = Tolerance(draw.deviations, 7, 0.45, np.linspace(0.45, 0.55, 101), 9)
    assert found.touching()[1] < found.touching(0.5)[1]
    assert found.pitch_for(0.1) > found.pitch_from(0.1)
    assert tails(9, 101, 0.1)[0] > 0.3
    dance = laid(coiled, draw)
    assert brute(dance, 0.5) > 0.0
    every_pair(dance)
    single_pair(dance)


def every_pair(dance: Laid) -> None:
    """The search of all pairs alone, which the engine's question about a dance calls within."""
    benches, links = len(dance.dragon), dance.dragon.links
    first, second = np.empty((2, benches * benches), dtype=np.int64)
    search_all_pairs(
        time_of_impact.empty_search(benches + 1, benches, first.size), Goal.FIRST_TOUCH,
        dance.rows, links, dance.aside, dance.dragon.sizes, np.linspace(dance.start, dance.end, 50),
        first, second, 0.0, 1e-7, 1e-8, 2000, np.zeros(time_of_impact.NOTES),
    )  # fmt: skip


def single_pair(dance: Laid) -> None:
    """A query about one pair."""
    room, sizes = time_of_impact.empty_search(len(dance.dragon) + 1, 2, 1), dance.dragon.sizes.copy()
    first, second = np.array([[0], [9]])
    rows, links, seams = dance.rows, dance.dragon.links, np.empty((0, SEAM_COLUMNS))
    spans, numbers = np.array([[dance.start, dance.end]]), np.empty(NUMBERS, dtype=np.int64)
    search_pairs(
        room, Goal.FIRST_TOUCH, rows, links, sizes, seams, first, second, np.array([0.3]),
        spans, 1e-9, 1e-9, 200, numbers, np.empty(time_of_impact.NOTES), np.empty((1, ANSWER_COLUMNS)),
    )  # fmt: skip
