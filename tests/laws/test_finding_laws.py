"""Each finding's number, pair, time and cause belong together: told once more from pair and time alone.

What is told is computed again from where handles are at the time told, by shapely and by differences,
never by the searches that found it.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from shapely.geometry import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry

from benchdragon.analysis.check import Report, check
from benchdragon.analysis.findings import Finding
from benchdragon.errors import BenchDragonError
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle
from benchdragon.number_format import seconds
from benchdragon.plans.schema import checked
from tests.planner.verdicts import limited

# Random plans that are looked at, and kinds of findings that must be among theirs.
PLANS = range(5, 90)
KINDS = {
    "contact", "margin", "sway", "imprecision", "people", "speed", "acceleration", "most_speed",
    "lateral_acceleration", "total_acceleration", "turning_rate", "head_acceleration",
    "obstacle", "obstacle_margin", "venue", "venue_margin",
}  # fmt: skip
ROOM = ("sway", "imprecision", "people")
# A step of differences, s, and what they may be off by, relative.
STEP, OFF = 2e-4, 5e-3


def plans() -> Iterator[dict[str, Any]]:
    """Random plans, and village squares whose people have too little room."""
    for seed in PLANS:
        data = limited(seed)
        data.setdefault("people", {})
        if seed % 2:
            data["people"] |= {"sway": 0.05, "imprecision": 0.1, "beside": 0.4, "ahead": 0.6}
        yield data
    for seed in range(12):
        dice = np.random.default_rng(seed)
        yield {
            "schema": 1,
            "dragon": {"benches": 24, "head_length": 2.3, "body_length": 1.8, "width": 0.15},
            "route": {"kind": "turn", "pitch": float(dice.uniform(1.2, 3.6))},
            "disc": {"radius": 5.0},
            "walk": {"speed": 0.8, "start": -10, "end": 60},
            "limits": {"margin": float(dice.uniform(0.0, 0.1)), "head_acceleration": 0.5},
            "venue": {"rectangle": [float(dice.uniform(20, 40)), 25.0]},
            "obstacle": [{"kind": "circle", "centre": [float(dice.uniform(5, 9)), 3], "radius": 0.3}],
            "people": {
                "sway": float(dice.uniform(0.01, 0.2)), "imprecision": float(dice.uniform(0.01, 0.2)),
                "beside": float(dice.uniform(0.0, 0.6)), "ahead": float(dice.uniform(0.0, 0.9)),
                "most_speed": 0.75 + 0.05 * (seed % 3),
            },
        }  # fmt: skip
    fast = {"schema": 1, "route": {"kind": "parts", "part": [{"kind": "line", "length": 40}]}}
    walk = {"profile": [[0, 0], [1, 2], [2, 0.5]], "position": 20, "end": 8}
    edge = {"venue": {"rectangle": [200, 0.5]}, "limits": {"venue_margin": 0.2}}
    yield fast | {"dragon": {"benches": 6}, "walk": walk} | edge


def shape(report: Report, t: float, bench: int, beside: float = 0.0, ahead: float = 0.0) -> Polygon:
    """The rectangle of a bench with room on both sides, and ahead of the head's."""
    motion, own = report.walk.motion([t]), report.walk.dragon[bench - 1]
    front, rear = (complex(motion.x[0, k], motion.y[0, k]) for k in (bench - 1, bench))
    along = (front - rear) / abs(front - rear)
    tip = front + (own.front_inset + (ahead if bench == 1 else 0.0)) * along
    end, side = rear - own.rear_inset * along, 1j * (0.5 * own.width + beside) * along
    return Polygon([(z.real, z.imag) for z in (tip + side, end + side, end - side, tip - side)])


def standing(one: Obstacle) -> BaseGeometry:
    """What stands still: of the venue all that lies outside."""
    if one.kind == "circle":
        return Point(one.outline[0])
    if one.kind == "line":
        return LineString(one.outline)
    if one.open is not None:  # an edge with a gate
        return LineString(one.open)
    whole = Polygon(one.outline)
    return whole if one.kind != "venue" else whole.buffer(1e3).difference(whole)


def apart(report: Report, found: Finding, t: float, beside: float = 0.0, ahead: float = 0.0) -> float:
    """How far the pair of a finding is apart at a time, m, with so much room for people."""
    first = shape(report, t, found.benches[0], beside, ahead)
    if not found.obstacle:
        return float(first.distance(shape(report, t, found.benches[1], beside, ahead)))
    (one,) = (each for each in report.plan.obstacles() if each.name == found.obstacle)
    return max(float(first.distance(standing(one))) - one.radius, 0.0)


def room_fault(report: Report, found: Finding) -> str:
    """What is wrong with a finding about room for people; "" if nothing is."""
    people, words, time = report.plan.people, found.words, found.time or 0.0
    with_people = found.kind == "people"
    asked = {"beside": people.beside * with_people, "ahead": people.ahead * with_people}
    value = apart(report, found, time, **asked)
    if abs(value - found.value) > 1e-6 or value > found.limit + 1e-6:
        return f"{found.value} told, {value} there"
    if "key" not in words:
        return ""
    key, when = words["key"].removeprefix("people."), float(words["when"])
    wanted, there = getattr(people, key), float(words["there"])
    if f"{wanted:g}" != words["wanted"] or not there < wanted:
        return f"{words}"
    if not 0.0 <= apart(report, found, when) - float(words["apart"]) <= 1.001e-3:
        return f"{words['apart']} told, {apart(report, found, when)} apart"
    if key == "ahead":  # the sides alone have their room where it is the front that lacks
        assert 1 in found.benches
        assert apart(report, found, time, asked["beside"], 0.0) > found.limit + 1e-9

    def kept(value: float) -> bool:
        """Whether the pair keeps its room at the tightest moment with another value of the key."""
        margin, sides = found.limit, asked
        if key in asked:
            sides = {"beside": value, "ahead": 0.0} if key == "beside" else {**asked, "ahead": value}
        else:
            margin -= (1.0 if found.obstacle else 2.0) * (wanted - value)
        # Where nothing is asked for beside, 0 is a touch.
        return apart(report, found, when, **sides) > max(margin - 1e-7, 0.0)

    if (there > 0.0 and not kept(there)) or kept(there + 1.1e-3) or kept(wanted):
        return f"room for {there} told of {key}"
    return ""


def rates(report: Report, t: float, handle: int) -> Iterator[dict[str, float]]:
    """Speed, accelerations, and turning rate at a handle by differences: before, about and after t."""
    for middle in (t - 1.5 * STEP, t, t + 1.5 * STEP):
        times = np.clip(middle + STEP * np.arange(-1, 2), report.start, report.end)
        if times[2] - times[0] < 1.9 * STEP:
            continue
        motion = report.walk.motion(times, throw=False)
        if motion.status.any():
            continue
        places = np.column_stack([motion.x[:, handle], motion.y[:, handle]])
        yield _rates(places, motion, handle)


def _rates(places: FloatArray, motion: Any, handle: int) -> dict[str, float]:
    first, second = np.diff(places, axis=0) / STEP
    speeds = np.hypot(*first), np.hypot(*second)
    speed, change = 0.5 * sum(speeds), (second - first) / STEP
    along = (speeds[1] - speeds[0]) / STEP
    across = (first[0] * second[1] - first[1] * second[0]) / (speed * STEP) if speed else 0.0
    bench = min(handle, motion.x.shape[1] - 2)
    x, y = motion.x, motion.y
    turn = np.unwrap(np.arctan2(y[:, bench] - y[:, bench + 1], x[:, bench] - x[:, bench + 1]))
    return {
        "speed": speed, "most_speed": speed, "acceleration": abs(along),
        "lateral_acceleration": abs(across), "total_acceleration": float(np.hypot(*change)),
        "turning_rate": abs(turn[2] - turn[0]) / (2.0 * STEP), "head_acceleration": abs(along),
    }  # fmt: skip


def rate_fault(report: Report, found: Finding) -> str:
    """What is wrong with a finding about a limited quantity; "" if nothing is."""
    handle = 0 if found.kind == "head_acceleration" else int(found.words["handle"])
    handle = found.benches[0] - 1 if found.kind == "turning_rate" else handle
    time = found.time or 0.0
    seen = [one[found.kind] for one in rates(report, time, handle)]
    if found.words["t"] != seconds(time) or handle not in (found.benches[0] - 1, found.benches[0]):
        return f"{found.words}"
    if not any(abs(one - found.value) <= OFF * found.value + 1e-4 for one in seen):
        return f"{found.value} told at handle {handle}, {seen} there"
    return "" if found.value > found.limit * (1.0 - 1e-9) else f"{found.value} is within {found.limit}"


def near_fault(report: Report, found: Finding) -> str:
    """What is wrong with a finding about benches or what stands still; "" if nothing is."""
    value = apart(report, found, found.time or 0.0)
    limit = found.limit if found.kind.endswith("margin") else 0.0
    if abs(value - found.value) > 1e-6 or value > limit + 1e-6:
        return f"{found.value} told, {value} there"
    return "" if found.words["t"] == seconds(found.time or 0.0) else f"{found.words}"


def route_fault(report: Report, found: Finding) -> str:
    """What is wrong with a finding about a route that is too short; "" if nothing is."""
    handles = report.walk.motion([report.start], throw=False)
    dragon = float(np.hypot(np.diff(handles.x[0]), np.diff(handles.y[0])).sum())
    route = sum(curve.length for curve in report.walk.route.curves)
    if abs(dragon - found.limit) > 1e-6 or not 0.0 <= route - found.value <= 1.0 + 1e-6:
        return f"{found.value} of {found.limit} told, {route} of {dragon} there"
    return "" if route < dragon and found.time == report.start else f"{found.words}"


def fault(report: Report, found: Finding) -> str:
    """What is wrong with a finding; "" if nothing is."""
    if found.kind in ROOM:
        return room_fault(report, found)
    if "margin" in found.kind or found.kind in ("contact", "venue", "obstacle"):
        return near_fault(report, found)
    return route_fault(report, found) if found.kind == "route" else rate_fault(report, found)


def test_the_number_of_each_finding_is_that_of_its_pair_at_its_time() -> None:
    wrong, seen = [], set[str]()
    for n, data in enumerate(plans()):
        try:
            report = check(checked(data, f"plan {n}"))
        except BenchDragonError:  # a plan that is none, or a bench that cannot follow
            continue
        for found in report.findings:
            seen |= {found.kind} if found.decided else set()
            text = fault(report, found) if found.decided else ""
            wrong += [f"plan {n}: {found.text}: {text}"] if text else []
    assert wrong == []
    assert seen >= KINDS
