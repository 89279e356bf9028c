"""A walk of many rounds costs as much as one: what `check` takes, with and without looking again.

    python design/rounds.py

For a circle and for a closed circuit of lines and arcs (a stadium), walked 1 to 1000 times, and for a
coil, walked in and out 1 to 20 times: CPU seconds of a check with nothing to keep from, and with an
obstacle, limits and room for people. `before` is the same search over the whole walk, as it was done
when nothing was known of rounds; it is asked of 1 and 10 rounds alone, since it grows with their number
(and first contact with its square).

Three ways were thought of. (1) A kernel that knows that two benches on one arc keep their distance: it
spares the plateau, not the rounds. (2) To remember what was seen of each place: the cells of a route
are made anew for each search, and no two rounds have the same numbers in all digits. (3) To leave out
what repeats before any search begins (kernels/rounds.py): some comparisons of the route's rows, the
same for contact, clearance, speeds and obstacles. The third is what is done.
"""

import time
from collections.abc import Callable
from typing import Any
from unittest.mock import patch

from benchdragon.analysis.check import check
from benchdragon.analysis.rounds import Rounds, Span
from benchdragon.budget import OverBudgetError
from benchdragon.plans.schema import Plan, checked, read_plan

ROUNDS, COILED, BEFORE = (1, 10, 100, 1000), (1, 3, 10, 20), (1, 10)
LINE, BEND = {"kind": "line", "length": 30}, {"kind": "arc", "radius": 12, "angle": 180}
ALL: dict[str, Any] = {
    "limits": {"speed": 1.5, "turning_rate": 60, "lateral_acceleration": 2},
    "people": {"sway": 0.05, "imprecision": 0.05, "beside": 0.1},
}


def plan_of(part: list[dict[str, Any]], place: tuple[float, float] | None) -> Plan:
    """Twenty benches on a route of these parts, with all that can be asked for if there is a place."""
    route = {"kind": "parts", "part": part}
    data: dict[str, Any] = {"schema": 1, "dragon": {"benches": 20}, "route": route}
    if place is not None:
        thing = {"kind": "circle", "centre": list(place), "radius": 1}
        data |= {**ALL, "obstacle": [thing]}
    return checked(data, "plan")


def circle(rounds: int, *, everything: bool) -> Plan:
    """Rounds of a circle, begun on a line."""
    bend = {"kind": "arc", "radius": 30, "angle": 360 * rounds}
    return plan_of([{"kind": "line", "length": 5}, bend], (15, 30) if everything else None)


def stadium(rounds: int, *, everything: bool) -> Plan:
    """Rounds of two lines and two half circles, each a part of its own."""
    return plan_of([LINE, BEND] * 2 * rounds, (15, 9) if everything else None)


def coil(rounds: int, *, everything: bool) -> Plan:
    """Sixty benches of a village that coil in and out."""
    benches = {"benches": 60, "head_length": 2, "body_length": 1.5, "tail_length": 1.5, "width": 0.2}
    data: dict[str, Any] = {
        "schema": 1, "dragon": benches, "disc": {"radius": 3.4},
        "route": {"kind": "turn", "pitch": 2.7, "rounds": rounds}, "limits": {"margin": 0.05},
    }  # fmt: skip
    if everything:
        data |= {**ALL, "obstacle": [{"kind": "circle", "centre": [18, 12], "radius": 1}]}
    return checked(data, "plan")


def whole(_rounds: Rounds, first: float, last: float) -> tuple[list[Span], float]:
    """All of a way, as if nothing repeated."""
    return [(first, last)], 0.0


def seconds(plan: Plan) -> str:
    """What a check takes, s, and whether it finds the walk safe."""
    began = time.process_time()
    try:
        said = "safe" if check(plan).safe else "not safe"
    except OverBudgetError:
        said = "too much work"
    return f"{time.process_time() - began:.2f} s, {said}"


def printed(name: str, made: Callable[..., Plan], counts: tuple[int, ...], *, everything: bool) -> None:
    """The rows of a table for one kind of route."""
    asked = "with all" if everything else "alone"
    for count in counts:
        plan, before = made(count, everything=everything), "-"
        now = seconds(plan)
        if count in BEFORE:
            with patch.object(Rounds, "new", whole):
                before = seconds(plan)
        print(f"| {name}, {asked} | {count} | {before} | {now} |", flush=True)


def main() -> None:
    """Print the table."""
    check(read_plan("turn"))
    print("| route | rounds | before | now |\n|---|---|---|---|")
    for name, made, counts in (
        ("circle", circle, ROUNDS), ("stadium", stadium, ROUNDS), ("coil", coil, COILED),
    ):  # fmt: skip
        for everything in (False, True):
            printed(name, made, counts, everything=everything)


if __name__ == "__main__":
    main()
