"""Every value of contest.json made again, by an implementation that shares nothing with the package.

`python -m tests.truth.make_truth` compares what it makes with what is kept and tells the largest
difference; with --write it writes the file instead. Floats say where to look (scan.py); the answers
come from root finding in many digits (reference.py).
"""

import argparse
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import mpmath as mp
import numpy as np

from tests.truth import reference, scan
from tests.truth.reference import Bench, Number, Points

FILE = Path(__file__).parent / "contest.json"
DIGITS = 40
# The greatest ratio is flat at its peak and tangents are differences: its place needs more digits.
PEAK_DIGITS = 70
HANDLES = (0, 1, 51, 101, 151, 201, 223)
SPIRAL_TIMES = (0, 60, 120, 180, 240, 300)
TURN_TIMES = (-100, -50, 0, 14, 50, 100)
PITCH, TURNS, RADIUS, TURN_PITCH, RATIO, LIMIT = "0.55", 16, "4.5", "1.7", 2, 2
RATIOS = 13
# A box on the square of the spiral walk: centre and size, m, and angle, degrees.
BOX_CENTRE, BOX_SIZE, BOX_ANGLE = ("3", "1"), ("0.5", "0.3"), 30
ROUND = ((1, 1), (-1, 1), (-1, -1), (1, -1))
# Of the values kept, m, s or m/s; places and speeds are kept with 18 digits.
TOLERANCE = 1e-15

Entry = tuple[str, str, str]


def benches(dragon: Sequence[Bench]) -> scan.Benches:
    """The same sizes as floats."""
    return scan.Benches(*(np.array(size, dtype=np.float64) for size in zip(*dragon, strict=True)))


def first_contact(
    point: Points, rough: scan.Points, dragon: Sequence[Bench], start: float, end: float
) -> tuple[Number, scan.Pair] | None:
    """The head's position, m, when two benches but neighbours first touch, and which; None if never."""
    look = scan.first_touch(rough, benches(dragon), start, end)
    if look is None:
        return None
    if look.head <= start:
        return mp.mpf(start), look.pair

    def gap(head: Number) -> Number:
        return reference.pair_gap(point, dragon, head, look.pair)

    bracket = tuple(mp.mpf(look.head) + side * mp.mpf("1e-8") for side in (-1, 1))
    if not gap(bracket[0]) > 0 > gap(bracket[1]):
        raise ArithmeticError(f"benches {look.pair} do not touch at {look.head}")
    head = reference.root(gap, *bracket)
    if not bracket[0] < head < bracket[1]:
        raise ArithmeticError(f"the root for benches {look.pair} lies not at {look.head}")
    return head, look.pair


class Graze(NamedTuple):
    """The smallest pitch, m, the head's position then, counted from the disc, m, and who touches."""

    pitch: Number
    head: Number
    pair: scan.Pair


class PitchFamily(NamedTuple):
    """Walks of a dragon in along spirals of any pitch, to a disc about the centre, at s = 0.

    The head starts `turns` turns out.
    """

    dragon: Sequence[Bench]
    radius: str | float
    turns: float

    def rough(self, pitch: float) -> tuple[scan.Points, float]:
        k, theta = pitch / (2.0 * np.pi), 2.0 * np.pi * float(self.radius) / pitch
        start = scan.length(k, theta) - scan.length(k, 2.0 * np.pi * self.turns)
        return scan.spiral_walk(pitch, theta), start

    def start(self, pitch: Number) -> Number:
        k, theta = pitch / (2 * mp.pi), 2 * mp.pi * mp.mpf(self.radius) / pitch
        return reference.arc_length(k, theta) - reference.arc_length(k, 2 * mp.pi * mp.mpf(self.turns))

    def corners(self, pitch: Number, head: Number, pair: scan.Pair) -> tuple[Any, Any]:
        point = reference.spiral_walk(pitch, 2 * mp.pi * mp.mpf(self.radius) / pitch)
        return reference.pair_corners(point, self.dragon, head, pair)


def smallest_pitch(family: PitchFamily, first: float, step: float = 0.05) -> Graze:
    """The border below which two benches touch, coming from pitch `first`, m."""
    rough, look = scan.smallest_pitch(family.rough, benches(family.dragon), first, step)
    pitch, head = mp.mpf(rough), mp.mpf(look.head)
    rows = reference.separations(*family.corners(pitch, head, look.pair))
    side = max(range(8), key=lambda n: min(rows[n]))
    corner = min(range(4), key=lambda n: rows[side][n])

    def apart(pitch: Number, head: Number) -> Number:
        """How far the corner that touches lies outside the side that it touches."""
        return reference.separations(*family.corners(pitch, head, look.pair))[side][corner]

    start = family.start(pitch)
    if min(abs(head), abs(head - start)) < 1e-6:
        at_start = abs(head - start) < abs(head)
        pitch = reference.root(
            lambda p: apart(p, family.start(p) if at_start else mp.mpf(0)),
            pitch,
            pitch + mp.mpf("1e-8"),
        )
        head = family.start(pitch) if at_start else mp.mpf(0)
    else:
        pitch, head = _graze(apart, pitch, head)
    gap = reference.gap(*family.corners(pitch, head, look.pair))
    if abs(gap) > mp.mpf(10) ** (8 - mp.mp.dps) or abs(head - look.head) > 1e-3:
        raise ArithmeticError(f"benches {look.pair} do not graze at {look.head}: gap {mp.nstr(gap, 5)}")
    return Graze(pitch, head, look.pair)


def _graze(
    apart: Callable[[Number, Number], Number], pitch: Number, head: Number
) -> tuple[Number, Number]:
    """Where `apart` is 0 and least over the head's position: Newton's method on a parabola's vertex."""
    h, enough = mp.mpf(10) ** (-mp.mp.dps // 3), mp.mpf(10) ** (8 - mp.mp.dps)
    for _step in range(12):
        here, ahead, behind = (apart(pitch, head + side * h) for side in (0, 1, -1))
        slope, bend = (ahead - behind) / (2 * h), (ahead - 2 * here + behind) / (h * h)
        per_pitch = (apart(pitch + h, head) - apart(pitch - h, head)) / (2 * h)
        lowest = here - slope * slope / (2 * bend)
        pitch, head = pitch - lowest / per_pitch, head - slope / bend
        if abs(lowest) < enough and abs(slope) < mp.mpf(10) ** (-mp.mp.dps // 2):
            return pitch, head
    raise ArithmeticError("the graze does not settle")


def greatest_ratio(
    point: Points, rough: scan.Points, dragon: Sequence[Bench], start: float, end: float
) -> tuple[Number, Number, int]:
    """The greatest ratio of a handle's speed to the head's; the head's position then, m; the handle.

    By golden section, which minds no kink; the place is good to three tenths of the digits.
    """
    near, handles = scan.fastest(rough, benches(dragon).links, start, end)
    there = reference.speeds(point, reference.places(point, dragon, near, max(handles)))
    handle = max(handles, key=lambda i: there[i])

    def ratio(head: Number) -> Number:
        return reference.speeds(point, reference.places(point, dragon, head, handle))[-1]

    golden = (mp.sqrt(5) - 1) / 2
    low, high = mp.mpf(near) - scan.FINE, mp.mpf(near) + scan.FINE
    inner = [high - golden * (high - low), low + golden * (high - low)]
    values = [ratio(head) for head in inner]
    while high - low > mp.mpf(10) ** (-mp.mp.dps * 3 // 10):
        if values[0] < values[1]:
            low, inner[0], values[0] = inner[0], inner[1], values[1]
            inner[1] = low + golden * (high - low)
            values[1] = ratio(inner[1])
        else:
            high, inner[1], values[1] = inner[1], inner[0], values[0]
            inner[0] = high - golden * (high - low)
            values[0] = ratio(inner[0])
    return max(values), (low + high) / 2, handle


def _text(value: Number, digits: int = 18) -> str:
    """As decimal text; what is but rounding is 0."""
    return str(mp.nstr(value if abs(value) > mp.mpf("1e-30") else mp.mpf(0), digits))


def entries(point: Points, head: Number | str, numbers: Sequence[int]) -> dict[str, Entry]:
    """x and y, m, and speed, of these handles of the contest's dragon."""
    s = reference.places(point, reference.contest_dragon(), mp.mpf(head), max(numbers))
    speeds = reference.speeds(point, s)
    at = {i: point(s[i]) for i in numbers}
    return {str(i): (_text(at[i].real), _text(at[i].imag), _text(speeds[i])) for i in numbers}


def spiral_entries(t: int | Number, numbers: Sequence[int] = HANDLES) -> dict[str, Entry]:
    with mp.workdps(DIGITS):
        return entries(reference.spiral_walk(PITCH, 2 * TURNS * mp.pi), t, numbers)


def turn_entries(t: int | str, numbers: Sequence[int] = HANDLES) -> dict[str, Entry]:
    with mp.workdps(DIGITS):
        return entries(reference.turn_walk(TURN_PITCH, RADIUS, RATIO), t, numbers)


def turn_summary() -> dict[str, str | tuple[str, str]]:
    with mp.workdps(DIGITS):
        size = reference.turn_sizes(TURN_PITCH, RADIUS, RATIO)
        plain = {name: _text(size[name]) for name in ("r1", "r2", "sweep", "length", "theta")}
        centres = {name: (_text(size[name].real), _text(size[name].imag)) for name in ("c1", "c2")}
        return {**plain, **centres}


def contact_values() -> dict[str, Any]:
    with mp.workdps(DIGITS):
        theta = 2 * TURNS * mp.pi
        rough = scan.spiral_walk(float(PITCH), float(theta))
        point, dragon = reference.spiral_walk(PITCH, theta), reference.contest_dragon()
        found = first_contact(point, rough, dragon, 0.0, 430.0)
        if found is None:
            raise ArithmeticError("no contact")
        return {"first_contact_s": _text(found[0], 22), "at_first_contact": spiral_entries(found[0])}


def box_corners() -> list[Number]:
    """Of the box on the square, in going round, m."""
    turned = mp.expj(BOX_ANGLE * mp.pi / 180)
    a, b = (mp.mpf(size) / 2 for size in BOX_SIZE)
    return [mp.mpc(*BOX_CENTRE) + mp.mpc(x * a, y * b) * turned for x, y in ROUND]


def box_touch(dragon: Sequence[Bench], start: float = 0.0, end: float = 412.0) -> tuple[Number, int]:
    """When a bench of the spiral walk first touches the box, s, and which."""
    theta = 2 * TURNS * mp.pi
    rough = scan.spiral_walk(float(PITCH), float(theta))
    box = box_corners()
    floats = np.array([complex(corner) for corner in box])
    look = scan.first_at_box(rough, benches(dragon), floats, start, end)
    if look is None:
        raise ArithmeticError("the box is not touched")
    point, bench = reference.spiral_walk(PITCH, theta), look.pair[0]

    def gap(head: Number) -> Number:
        s = reference.places(point, dragon, head, bench)
        ends = point(s[bench - 1]), point(s[bench])
        return reference.gap(reference.corners(*ends, dragon[bench - 1]), box)

    low, high = mp.mpf(look.head) - mp.mpf("0.05"), mp.mpf(look.head)
    while high - low > mp.mpf("1e-6"):
        middle = (low + high) / 2
        low, high = (low, middle) if gap(middle) <= 0 else (middle, high)
    return reference.root(gap, low, high), bench


def box_values() -> dict[str, Any]:
    with mp.workdps(DIGITS):
        head, bench = box_touch(reference.contest_dragon())
        return {"box_touch": {"s": _text(head, 22), "bench": str(bench)}}


def pitch_values() -> dict[str, str]:
    with mp.workdps(DIGITS):
        found = smallest_pitch(PitchFamily(reference.contest_dragon(), RADIUS, TURNS), float(PITCH))
        pitch, head = _text(found.pitch), _text(found.head)
        return {"smallest_pitch_m": pitch, "smallest_pitch_at_s_before_disc": head}


def ratio_values() -> dict[str, Any]:
    with mp.workdps(PEAK_DIGITS):
        size = reference.turn_sizes(TURN_PITCH, RADIUS, RATIO)
        rough = scan.turn_walk({name: complex(value) for name, value in size.items()})
        point, dragon = reference.turn_walk(TURN_PITCH, RADIUS, RATIO), reference.contest_dragon()
        # Once the tail has left the turn all of the dragon is on a spiral that opens.
        whole = float(size["length"]) + sum(float(bench.link) for bench in dragon) * 1.02
        greatest, head, _handle = greatest_ratio(point, rough, dragon, float(TURN_TIMES[0]), whole)
        there = reference.speeds(point, reference.places(point, dragon, head, RATIOS - 1))
        return {
            "greatest_ratio": _text(greatest),
            "greatest_ratio_at_s": _text(head),
            "greatest_head_speed": _text(LIMIT / greatest),
            "ratios_there": [_text(ratio) for ratio in there],
        }


def contest() -> dict[str, Any]:
    """All of contest.json, in its order."""
    return {
        "spiral_in_055": {str(t): spiral_entries(t) for t in SPIRAL_TIMES},
        **contact_values(),
        **pitch_values(),
        "two_arc": turn_summary(),
        "two_arc_motion": {str(t): turn_entries(t) for t in TURN_TIMES},
        **ratio_values(),
        **box_values(),
    }


def leaves(value: Any, name: str = "") -> Iterator[tuple[str, str]]:
    """Every number in nested values, with the way to it."""
    if isinstance(value, str):
        yield name, value
        return
    for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
        yield from leaves(inner, f"{name}.{key}".lstrip("."))


def difference(made: Any, kept: Any) -> tuple[float, str]:
    """The largest difference of two nested values, and where it lies.

    Raises:
        ValueError: if one holds what the other does not.
    """
    ours, theirs = dict(leaves(made)), dict(leaves(kept))
    if ours.keys() != theirs.keys():
        raise ValueError(f"only in one of them: {sorted(ours.keys() ^ theirs.keys())}")
    with mp.workdps(DIGITS):
        return max((abs(float(mp.mpf(ours[name]) - mp.mpf(theirs[name]))), name) for name in ours)


def main() -> int:
    parser = argparse.ArgumentParser(description="Make the contest's reference values again.")
    parser.add_argument("--write", action="store_true", help="write contest.json")
    asked = parser.parse_args()
    made = contest()
    if asked.write:
        FILE.write_text(json.dumps(made, indent=1) + "\n", encoding="utf-8")
        return 0
    most, where = difference(made, json.loads(FILE.read_text(encoding="utf-8")))
    print(f"the largest difference from the values kept: {most:.2g}, of {where}")
    return int(most > TOLERANCE)


if __name__ == "__main__":
    sys.exit(main())
