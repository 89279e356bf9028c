"""Calls every entry by numba and by the library, on what real questions pass to it: run as a script.

It runs with BENCHDRAGON_ENGINE=jit and the library's path as its argument. As JSON it prints how often
each entry was called, and how far apart the two came at most: of floats the difference as a share of
their size or 1, of integers infinity where any differ.
"""

import ctypes
import dataclasses
import json
import math
import sys
import types
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

import benchdragon.proofs.exact  # noqa: F401 - else imported by a proof, once entries are wrapped
from benchdragon.analysis.check import check
from benchdragon.analysis.contact import least_clearance
from benchdragon.analysis.distance import nearest_each, pair_distances
from benchdragon.analysis.proof import prove_contact
from benchdragon.analysis.speed import QUANTITIES, greatest_at, greatest_speed
from benchdragon.analysis.swept import swept_area
from benchdragon.kernels import jit, native
from benchdragon.kernels.step_bounds import empty_placements, place_chain
from benchdragon.model.curves import Arc, Clothoid, Line, Route, Spiral
from benchdragon.paper.runge_kutta import head_positions
from benchdragon.paper.traversal import first_overlap
from benchdragon.plans.schema import read_plan
from benchdragon.solve.head_speed import slowed
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, Draw, random_dance

# Its plain functions call its entries, which no compiled function does.
MIXED = "benchdragon.kernels.grid"
FOUND: dict[str, list[float]] = {}
# Where a distance is least is known to half its digits only, and is a hint: of these the distance
# itself counts, by which either place is as low as the other, and the pair.
RESULTS = {
    "benchdragon.kernels.low_points.low_point": [0],
    "benchdragon.kernels.low_points.low_pair": [0, 2, 3],
}


def arrays(value: Any) -> Iterator[npt.NDArray[Any]]:
    """All arrays in an argument or a result; numbers as arrays of none."""
    if isinstance(value, tuple):
        for part in value:
            yield from arrays(part)
    elif value is not None:
        yield np.asarray(value)


def copied(value: Any) -> Any:
    """The same, on memory of its own."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, tuple):
        parts = [copied(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value


def apart(one: npt.NDArray[Any], other: npt.NDArray[Any]) -> float:
    """The greatest difference of two arrays, in sizes of what stands there or 1; infinite in kind."""
    if one.dtype.kind != "f":
        return 0.0 if (one == other).all() else math.inf
    with np.errstate(all="ignore"):
        differ = ~((one == other) | (np.isnan(one) & np.isnan(other)))
        if not differ.any():
            return 0.0
        a, b = one[differ], other[differ]
        far = np.abs(a - b) / np.maximum(1.0, np.abs(a))
    return float(np.where(np.isfinite(far), far, math.inf).max())


def both(name: str, compiled: Any, built: Any) -> Callable[..., Any]:
    """A function that calls both on equal arguments, and notes how far apart they came."""

    def call(*arguments: Any) -> Any:
        again = copied(arguments)
        result, other = compiled(*arguments), built(*again)
        one, two = (arguments, result), (again, other)
        if name in RESULTS:
            one, two = (tuple(found[n] for n in RESULTS[name]) for found in (result, other))
        pairs = zip(arrays(one), arrays(two), strict=True)
        note = FOUND.setdefault(name, [0, 0.0])
        note[0], note[1] = note[0] + 1, max(note[1], *(apart(a, b) for a, b in pairs))
        return result

    return call


def wrap(wrapper: Callable[[str, Any], Callable[..., Any]]) -> None:
    """Let all modules but the kernels call what `wrapper` makes of each entry and its name."""
    calls: dict[int, Callable[..., Any]] = {}
    for name in jit.ENTRIES:
        home, _, short = name.rpartition(".")
        served = getattr(sys.modules[home], short)
        calls[id(served)] = wrapper(name, served)
    for name, module in list(sys.modules.items()):
        inside = name == "__main__" or name.startswith("benchdragon.")
        if name == MIXED or (inside and not name.startswith("benchdragon.kernels")):
            for key, value in list(vars(module).items()):
                if id(value) in calls:
                    setattr(module, key, calls[id(value)])
                elif isinstance(value, types.ModuleType) and "benchdragon.kernels." in value.__name__:
                    members = {k: calls.get(id(v), v) for k, v in vars(value).items()}
                    setattr(module, key, types.SimpleNamespace(**members))


def questions() -> None:
    """Questions that need every entry between them."""
    few = read_plan("spiral-in", ["dragon.benches=12"])
    turn = read_plan("turn", ["walk.speed=1.5", "dragon.benches=12", "walk.start=-20", "walk.end=20"])
    check(few)
    well = '[{kind="circle", centre=[8, 3], radius=0.5}, {kind="line", points=[[0, 2], [1, 2]]}]'
    check(read_plan("spiral-in", ["dragon.benches=12", "venue.rectangle=[30, 30]", f"obstacle={well}"]))
    assert swept_area(few.build(), 0.0, 20.0, error=0.1).widest.width.value > 0.3
    slowed(turn)
    least_clearance(turn.build(), -20.0, 20.0)
    walk = few.build()
    away = walk.route.moved(0.0, (1e5, 0.0))
    least_clearance(dataclasses.replace(walk, route=away), 0.0, 9.0)
    greatest_speed(read_plan("turn").build(), -50.0, 50.0)
    read_plan("turn", ["turn.family=arc-arc-arc", "turn.curvature=0.2", "turn.ease=0.3"]).build()
    places = empty_placements(len(walk.dragon) + 1, 2)
    place_chain(walk.route.rows, walk.dragon.links, np.array([0.0, 60.0]), 0, 2, places)
    greatest_at(walk.route.rows, walk.dragon, places, QUANTITIES["total_acceleration"])
    assert walk.head_where_tail(9.0) > 9.0
    limit(read_plan("turn", ["dragon.benches=12", "walk.start=-20", "walk.end=20"]), "length")
    limit(read_plan("spiral-in", ["dragon.benches=4", "disc.radius=0.5"]), "length")  # they fall
    motion = walk.motion([0.0, 60.0])
    pair_distances(motion, 0, 4)
    motion.acceleration.sum()
    nearest_each(motion)
    assert first_overlap(walk, np.array([0.0, 9.0])) is None
    head_positions(walk, [0.0, 9.0])
    prove_contact(read_plan("spiral-in").build(), 412.0, 413.0)
    route = Route.joined([Line(16.0), Clothoid(2.5, 0.0, 0.8), Arc(1.25, 2.0), Line(6.0)])
    route.point([1.0, 17.0])
    assert route.start_pose != route.end_pose
    Spiral(0.55, 40.0, 0.0).angle(1.0)
    coiled = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=20", "walk.start=225"])
    limit(coiled, "width")
    random_dance(coiled, Draw(CASES["all"].deviations, 7, 1)).least()


if __name__ == "__main__":
    library = ctypes.CDLL(sys.argv[1])
    wrap(lambda name, served: both(name, served, native.bound(jit.ENTRIES[name], library)))
    questions()
    print(json.dumps(FOUND))
