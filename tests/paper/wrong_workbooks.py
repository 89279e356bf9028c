"""Tables made wrong on purpose, each with the mistake that it shows."""

from collections.abc import Callable

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.paper.differences import Scheme, difference_speeds
from benchdragon.plans.schema import read_plan
from tests.paper.workbooks import (
    CONTACT,
    PLANS,
    TIMES,
    values,
    values_at,
)


def turned(table: FloatArray, angle: float, *, mirror: bool = False) -> FloatArray:
    """All points turned about the centre, after they were mirrored in the x axis."""
    points = (table[0] + (-1j if mirror else 1j) * table[1]) * np.exp(1j * angle)
    return np.stack([points.real, points.imag, table[2]])


def with_speeds(table: FloatArray, speeds: FloatArray) -> FloatArray:
    return np.stack([table[0], table[1], speeds])


def gradient(table: FloatArray) -> FloatArray:
    """With speeds as NumPy's gradient of the positions in columns a second apart."""
    return with_speeds(table, np.hypot(np.gradient(table[0], axis=0), np.gradient(table[1], axis=0)))


def stepped(result: str, scheme: Scheme, step: float) -> FloatArray:
    """With speeds as differences with a step of their own, s."""
    walk = read_plan(PLANS[result]).build()
    return with_speeds(values(result), difference_speeds(walk, TIMES[result], step, scheme))


def shifted(table: FloatArray, shift: int, first: int = 0) -> FloatArray:
    """Rows from handle number `first` on hold a handle farther back; the last rows that of the tail."""
    rows = np.clip(np.arange(224) + shift, 0, 223)
    rows[:first] = np.arange(first)
    return table[:, :, rows]


def crossed_sheets() -> FloatArray:
    """The rows of speeds in the sheet of positions, as far as they go, and the reverse."""
    table = values("result1")
    wrong = np.full(table.shape, np.nan)
    wrong[0, :, :112], wrong[1, :, :112] = table[2, :, ::2], table[2, :, 1::2]
    wrong[2, :, ::2], wrong[2, :, 1::2] = table[0, :, :112], table[1, :, :112]
    return wrong


def multiplied(table: FloatArray, places: float, speeds: float) -> FloatArray:
    return np.stack([table[0] * places, table[1] * places, table[2] * speeds])


def from_row(table: FloatArray, first: int, shift: int) -> FloatArray:
    """Rows from handle number `first` on hold another handle."""
    wrong = table.copy()
    rows = np.arange(first, 224 - max(shift, 0))
    wrong[:, :, rows] = table[:, :, rows + shift]
    return wrong


def a_bench_more() -> FloatArray:
    """The last two rows of a dragon of 224 benches."""
    wrong = values("result1").copy()
    wrong[:, :, 222:] = values("result1", "dragon.benches=224")[:, :, 223:]
    return wrong


def slipped(first: int) -> FloatArray:
    """The sheet of positions without one of its rows."""
    table = values("result1")
    rows = np.stack([table[0], table[1]], axis=-1).reshape(31, 448)
    rows[:, first:-1] = rows[:, first + 1 :]
    return np.stack([rows[:, ::2], rows[:, 1::2], table[2]])


def polar(unit: float) -> FloatArray:
    table = values("result1")
    radius = np.hypot(table[0], table[1])
    return np.stack([radius, 2.0 * np.pi * radius / 0.55 * unit, table[2]])


def in_degrees() -> FloatArray:
    radius, angle, speed = polar(1.0)
    return np.stack([radius * np.cos(np.radians(angle)), radius * np.sin(np.radians(angle)), speed])


Mistaken = tuple[str, Callable[[], FloatArray], str, float | None, str]
MISTAKES: dict[str, Mistaken] = {
    "turned by 90 degrees": (
        "result1", lambda: turned(values("result1"), np.pi / 2), "rotated", np.pi / 2,
        "rotated about the spiral's centre by 90.000000 degrees",
    ),
    "turn turned": (
        "result4", lambda: turned(values("result4"), -0.3), "rotated", -0.3, "by -17.188734 degrees",
    ),
    "anticlockwise": (
        "result1", lambda: turned(values("result1"), 0.0, mirror=True), "mirrored", 0.0,
        "at 0.000000 degrees to the x axis",
    ),
    "x for y": (
        "result1", lambda: values("result1")[[1, 0, 2]], "mirrored", np.pi / 4, "x and y are exchanged",
    ),
    "result4 as result1": (
        "result1", lambda: values_at("result4", TIMES["result1"] - 100.0), "swapped", None,
        "result1 and result4 are swapped",
    ),
    "result1 as result4": (
        "result4", lambda: values_at("result1", TIMES["result4"] + 100.0), "swapped", None,
        "result1 and result4 are swapped",
    ),
    "sheets exchanged": (
        "result1", crossed_sheets, "swapped", None, "positions and speeds are swapped",
    ),
    "gradient": (
        "result1", lambda: gradient(values("result1")), "differences", 1.0,
        "central differences of the workbook's own positions",
    ),
    "forward": (
        "result4", lambda: stepped("result4", "forward", 0.1), "differences", 0.1,
        "forward differences of positions with a step of 0.1 s",
    ),
    "backward": (
        "result1", lambda: stepped("result1", "backward", 0.1), "differences", 0.1,
        "backward differences of positions with a step of 0.1 s",
    ),
    "rear for front": (
        "result1", lambda: shifted(values("result1"), 1), "handle", 1.0,
        "the row of handle i holds handle i + 1",
    ),
    "one late": (
        "result4", lambda: shifted(values("result4"), -1), "handle", -1.0, "holds handle i - 1",
    ),
    "one body early": (
        "result4", lambda: shifted(values("result4"), 1, 1), "handle", 1.0,
        "the row of handle i holds handle i + 1, from the first body on",
    ),
    "tail first": (
        "result1", lambda: values("result1")[:, :, ::-1], "handle", None,
        "in reverse order, tail first",
    ),
    "a second late": (
        "result1", lambda: values_at("result1", TIMES["result1"] + 1.0), "time", 1.0,
        "the column of t holds the moment t + 1.000000 s",
    ),
    "another clock": (
        "result4", lambda: values_at("result4", 0.9 * TIMES["result4"] - 5.0), "time", -5.0,
        "the column of t holds the moment 0.900000 t - 5.000000 s",
    ),
    "speeds a second late": (
        "result1",
        lambda: with_speeds(values("result1"), values_at("result1", TIMES["result1"] + 1.0)[2]),
        "time", 1.0, "t + 1 s",
    ),
    "centimetres": (
        "result1", lambda: multiplied(values("result1"), 100.0, 1.0), "unit", 100.0,
        "the positions are in cm, not in m",
    ),
    "kilometres an hour": (
        "result4", lambda: multiplied(values("result4"), 1.0, 3.6), "unit", 3.6,
        "the speeds are in km/h, not in m/s",
    ),
    "a tenth too fast": (
        "result1", lambda: multiplied(values("result1"), 1.0, 1.1), "unit", 1.1,
        "the speeds are 1.1 times too large",
    ),
    "degrees": ("result1", in_degrees, "unit", None, "as if they were degrees"),
    "polar": ("result1", lambda: polar(180.0 / np.pi), "unit", None, "theta in degrees"),
    "all speeds 1": (
        "result1", lambda: with_speeds(values("result1"), np.ones((31, 224))), "handle", None,
        "all speeds are the head's",
    ),
    "lengths for links": (
        "result1", lambda: values("result1", "dragon.front_inset=0", "dragon.rear_inset=0"),
        "size", 3.41, "3.4100 m apart and those of all others 2.2000 m: these are the lengths of",
    ),
    "holes too far in": (
        "result1", lambda: values("result1", "dragon.front_inset=0.3", "dragon.rear_inset=0.3"),
        "size", 2.81, "2.8100 m apart and those of all others 1.6000 m; the links are 2.86 / 1.65 m",
    ),
    "head as long as the others": (
        "result4", lambda: values("result4", "dragon.head_length=2.2"), "size", 1.65,
        "the handles of the head are 1.6500 m apart",
    ),
    "another pitch": (
        "result1", lambda: values("result1", "route.pitch=0.5"), "size", 0.5,
        "the pitch of the spiral is 0.5 m, not 0.55 m",
    ),
    "another pitch from the same place": (
        "result1", lambda: values("result1", "route.pitch=0.45", f"route.start_turn={8.8 / 0.45}"),
        "size", 0.45, "the pitch of the spiral is 0.45 m",
    ),
    "another pitch of the turn": (
        "result4", lambda: values("result4", "route.pitch=1.6"), "size", 1.6, "is 1.6 m, not 1.7 m",
    ),
    "a turn farther out": (
        "result1", lambda: values("result1", "route.start_turn=17"), "size", 9.35,
        "the head starts 9.35 m from the centre of the spiral, not 8.8 m",
    ),
    "a row too many": (
        "result1", lambda: from_row(values("result1"), 50, -1), "handle", -1.0, "from Body 50 on",
    ),
    "a row too few": (
        "result4", lambda: from_row(values("result4"), 100, 1), "handle", 1.0, "from Body 100 on",
    ),
    "a bench too many": (
        "result1", a_bench_more, "handle", 1.0, "the row of handle i holds handle i + 1, from Tail on",
    ),
    "a row of x missing": (
        "result1", lambda: slipped(100), "handle", None,
        "from Body 50 x on, each row of the positions holds the numbers of the row below",
    ),
    "four decimals": (
        "result1", lambda: np.round(values("result1"), 4), "rounding", 4.0,
        "the numbers are rounded to 4 decimals; the contest asks for 6",
    ),
}  # fmt: skip
# The largest deviation that two halves of a unit in the last decimal make.
ROUNDED = {"four decimals": 5.1e-5}


def spoilt(table: FloatArray, seed: int) -> tuple[FloatArray, set[tuple[int, ...]]]:
    """A table in which one to three numbers are anything else, and where these are."""
    rng, wrong = np.random.default_rng(seed), np.array(table)
    held = np.argwhere(np.isfinite(wrong) & (wrong != 0.0))
    cells = {tuple(map(int, at)) for at in rng.choice(held, rng.integers(1, 4), replace=False)}
    for at in cells:
        wrong[at] += rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-2.0, 4.0)
    return wrong, cells


def not_yet_in(change: str) -> FloatArray:
    """The first 21 s of result1 with something else for benches that are not yet on the spiral."""
    walk = read_plan("spiral-in").build()
    motion = walk.motion(np.arange(21.0))
    table, outside = np.stack([motion.x, motion.y, motion.speed]), motion.s < -1e-9
    places, speeds = {
        "empty": (np.nan, np.nan), "positions 0": (0.0, None), "speeds 0": (None, 0.0),
        "at the start": (8.8 + 0j, 0.0),
    }[change]  # fmt: skip
    if places is not None:
        table[0, outside], table[1, outside] = np.real(places), np.imag(places)
        table[1, outside] = np.nan if np.isnan(places) else np.imag(places)
    if speeds is not None:
        table[2, outside] = speeds
    return table


ENTRIES = {
    "empty": "cells of benches that are not yet in, outside the first point of the spiral, are empty",
    "positions 0": "outside the first point of the spiral, are (0.000000, 0.000000): 9160 cells",
    "speeds 0": "outside the first point of the spiral, are 0.000000: 4580 cells",
    "at the start": "outside the first point of the spiral, are (8.800000, 0.000000): 9160 cells",
}


PAIRS: dict[str, tuple[str, Callable[[], FloatArray], str, tuple[str, ...]]] = {
    "rotated, another handle": (
        "result1", lambda: turned(from_row(values("result1"), 0, 1), 1.0), "rotated",
        ("rotated about the spiral's centre by 57.295780 degrees", "holds handle i + 1"),
    ),
    "mirrored, late": (
        "result1", lambda: turned(values_at("result1", TIMES["result1"] + 2.0), 0.7, mirror=True),
        "mirrored", ("at 20.053523 degrees to the x axis", "holds the moment t + 2.000000 s"),
    ),
    "rotated, early": (
        "result4", lambda: turned(values_at("result4", TIMES["result4"] - 7.0), 0.7), "rotated",
        ("by 40.107046 degrees", "holds the moment t - 7.000000 s"),
    ),
    "rotated, another pitch": (
        "result1", lambda: turned(values("result1", "route.pitch=0.5"), 2.0), "rotated",
        ("by 114.591559 degrees", "the pitch of the spiral is 0.5 m, not 0.55 m"),
    ),
    "rotated, in centimetres": (
        "result1", lambda: multiplied(turned(values("result1"), 2.0), 100.0, 1.0), "unit",
        ("the positions are in cm, not in m", "by 114.591559 degrees"),
    ),
    "late, differences": (
        "result1", lambda: gradient(values_at("result1", TIMES["result1"] + 1.0)), "time",
        ("holds the moment t + 1.000000 s", "central differences of the workbook's own positions"),
    ),
    "another handle, differences": (
        "result1", lambda: shifted(gradient(values("result1")), 1), "handle",
        ("holds handle i + 1", "central differences of the workbook's own positions"),
    ),
    "both in millimetres": (
        "result1", lambda: multiplied(values("result1"), 1e3, 1e3), "unit",
        ("the positions are in mm, not in m", "the speeds are in mm/s, not in m/s"),
    ),
}  # fmt: skip


def noisy(size: float) -> FloatArray:
    table = values("result1")
    return table + np.random.default_rng(1).normal(0.0, size, table.shape)


def slip() -> FloatArray:
    table = values("result1").copy()
    table[1, 20, 7] *= -1.0
    return table


def drifting() -> FloatArray:
    """Handles that stand the farther off along the route the farther back they are, as by bisection."""
    walk, table = read_plan("spiral-in").build(), values("result1")
    points = walk.route.point(walk.motion(TIMES["result1"]).s - 2e-8 * np.arange(224))
    return np.stack([points[..., 0], points[..., 1], table[2]])


AT_CONTACT = values_at("result2", [CONTACT])
UNKNOWN: dict[str, tuple[Callable[[], FloatArray], str]] = {
    "noise": (lambda: noisy(1e-3), "numbers are off by more than 1e-06"),
    "large noise": (lambda: noisy(1.0), "20832 of 20832 numbers are off"),
    "errors that add up": (drifting, "near the tail: errors of single benches add up"),
}


# Of result2: what a random number makes of it, the mistake, and its amount for that number.
MOMENTS: dict[str, tuple[Callable[[float], FloatArray], str, Callable[[float], float | None]]] = {
    "rotated": (lambda u: turned(AT_CONTACT, 6.0 * u - 3.0), "rotated", lambda u: 6.0 * u - 3.0),
    "mirrored": (
        lambda u: turned(AT_CONTACT, 3.0 * u - 1.5, mirror=True), "mirrored", lambda u: 1.5 * u - 0.75,
    ),
    "another moment": (
        lambda u: values_at("result2", [300.0 + 130.0 * u]), "time",
        lambda u: 300.0 + 130.0 * u - CONTACT,
    ),
    "nearly the moment": (
        lambda u: values_at("result2", [CONTACT - 1e-6 - 1e-4 * u]), "time", lambda u: -1e-6 - 1e-4 * u,
    ),
    "another handle": (lambda _u: from_row(AT_CONTACT, 0, 1), "handle", lambda _u: 1.0),
    "another link": (
        lambda u: values_at("result2", [CONTACT], f"dragon.head_length={3.0 + round(u, 3)}"), "size",
        lambda u: 2.45 + round(u, 3),
    ),
    "other units": (lambda _u: multiplied(AT_CONTACT, 100.0, 1.0), "unit", lambda _u: 100.0),
    "tail first": (lambda _u: AT_CONTACT[:, :, ::-1], "handle", lambda _u: None),
}  # fmt: skip
