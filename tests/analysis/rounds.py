"""Routes on which a dragon goes round and round, and searches of them that leave nothing out."""

import math
import random
from typing import Any, NamedTuple

import pytest

from benchdragon.analysis.rounds import Rounds, Span
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.schema import Plan, checked, read_plan

LINE: dict[str, Any] = {"kind": "line", "length": 9.0}
BEND: dict[str, Any] = {"kind": "arc", "radius": 4.0, "angle": 180}


def circle(rounds: float, **more: Any) -> Plan:
    """A dragon that walks round a circle after a line."""
    part = [{"kind": "line", "length": 5}, {"kind": "arc", "radius": 6, "angle": 360 * rounds}]
    return plan_of(part, **more)


def stadium(rounds: int, **more: Any) -> Plan:
    """A dragon that walks round two lines and two half circles."""
    return plan_of([LINE, BEND] * 2 * rounds, **more)


def plan_of(part: list[dict[str, Any]], **more: Any) -> Plan:
    """A plan of four benches on a route of these parts."""
    route = {"kind": "parts", "part": part}
    return checked({"schema": 1, "dragon": {"benches": 4}, "route": route, **more}, "plan")


# Of a village.
BENCHES = (
    "dragon.head_length=2",
    "dragon.body_length=1.5",
    "dragon.tail_length=1.5",
    "dragon.width=0.2",
)


def coil(rounds: int, *settings: str) -> Plan:
    """A dragon of twelve benches that coils in and out again and again."""
    shape = ("route.pitch=2.2", "route.outer_radius=9", "disc.radius=4", "dragon.benches=12")
    return read_plan("turn", [*BENCHES, *shape, f"route.rounds={rounds}", "limits.margin=0", *settings])


def random_coil(seed: int) -> Plan:
    """Some dragon that coils in and out some times, beside some thing."""
    dice = random.Random(seed)
    pitch = dice.uniform(1.5, 2.8)
    disc = max(3.5, pitch * dice.uniform(1.2, 2.0))
    place = [dice.uniform(-12.0, 12.0), dice.uniform(-12.0, 12.0)]
    settings = (
        *BENCHES,
        f"route.rounds={dice.choice([3, 4])}",
        f"route.pitch={pitch}",
        f"route.outer_radius={disc * dice.uniform(1.1, 2.5)}",
        f"disc.radius={disc}",
        f"dragon.benches={dice.choice([3, 4, 8, 14])}",
        f"walk.start={dice.choice([-5.0, 0.0])}",
        f"limits.margin={dice.choice([0.0, 0.3, 0.9])}",
    )
    data = read_plan("turn", settings).data()
    return checked({**data, "obstacle": [{"kind": "circle", "radius": 0.5, "centre": place}]}, "plan")


def random_rounds(seed: int) -> Plan:
    """Some dragon on a circuit that is walked some times, closed or not, perhaps after a bow."""
    dice = random.Random(seed)
    circuit: list[dict[str, Any]] = [{"kind": "line", "length": dice.uniform(2.0, 12.0)}]
    for _n in range(dice.choice([1, 1, 2, 3])):
        way, bend = dice.uniform(3.0, 9.0), dice.uniform(0.1, 0.4)
        ends = {"start_curvature": 0.0, "end_curvature": bend}
        back = {"start_curvature": bend, "end_curvature": 0.0}
        circuit += dice.choice(
            [
                [{"kind": "arc", "radius": 1.0 / bend, "angle": math.degrees(way * bend)}],
                [{"kind": "clothoid", "length": way, **one} for one in (ends, back)],
                [{"kind": "line", "length": way}, {"kind": "arc", "radius": 3.0, "angle": -40.0}],
            ]
        )
    if dice.random() < 0.4:  # two such halves come back to where they began
        half = {"kind": "arc", "radius": dice.uniform(3.0, 6.0), "angle": 180.0}
        circuit = [{"kind": "line", "length": way}, half] * 2
    bow = [{"kind": "line", "length": 1.0}, {"kind": "arc", "radius": 9.0, "angle": -60.0}]
    ahead = bow if dice.random() < 0.5 else []
    last = {"kind": "line", "length": dice.uniform(1.0, 9.0)}
    benches, thing = dice.choice([3, 4, 8, 14]), {"kind": "circle", "radius": 0.5}
    place = [dice.uniform(-8.0, 12.0), dice.uniform(-5.0, 9.0)]
    return plan_of(
        [*ahead, *circuit * dice.choice([3, 4]), last],
        dragon={"benches": benches},
        limits={"margin": dice.choice([0.0, 0.3, 1.0, 1.06])},
        obstacle=[{**thing, "centre": place}],
    )


@pytest.fixture
def all_of_it(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """For a while nothing is left out of searches: `undo` ends that."""

    def whole(_rounds: Rounds, first: float, last: float) -> tuple[list[Span], float]:
        return [(first, last)], 0.0

    monkeypatch.setattr(Rounds, "new", whole)
    return monkeypatch


class Repeat(NamedTuple):
    """Part of a route that comes again: see kernels/rounds.py; all m."""

    low: float
    high: float
    period: float
    missed: float


def told(known: FloatArray) -> list[Repeat]:
    """What repeats."""
    return [Repeat(*row) for row in known.tolist()]


def periods(known: FloatArray) -> list[float]:
    """The periods of repeats, but those where a route is the same everywhere."""
    return [one.period for one in told(known) if one.period]
