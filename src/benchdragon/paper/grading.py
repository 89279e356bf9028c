"""Numbers that students found, graded: those of the contest's questions, and those of the exercises.

A grade names figures that agree and known mistakes, never the answer itself.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from benchdragon.analysis.contact import first_contact
from benchdragon.analysis.distance import clearances
from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.model.arrays import as_list
from benchdragon.model.turns import TwoArcTurn
from benchdragon.model.walk import Walk
from benchdragon.paper import wrong_numbers
from benchdragon.paper.compare import points
from benchdragon.paper.wrong_numbers import Wrong
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import smallest_pitch

# Significant figures that are required, and the most that are counted.
WANTED, MOST = 6, 12
# Figures to which an answer is that of a known mistake, if that explains it better than the truth does.
SAME = 5

Numbers = tuple[float, ...]


@dataclass(frozen=True)
class Grade:
    """What an answer to a task is worth.

    Attributes:
        task: its name.
        figures: how many significant figures agree; of several numbers those of the worst.
        finding: in words, with the known mistake that leads to the answer.

    Examples:
        >>> print(bd.grade("pitch", 0.43))
        pitch: 0 of 100 points: contact was checked only when the head reaches the disc
    """

    task: str
    figures: int
    finding: str

    @property
    def agrees(self) -> bool:
        """Whether six figures agree."""
        return self.figures >= WANTED

    @property
    def score(self) -> float:
        """1 for a right answer, else 0."""
        return float(self.agrees)

    def __str__(self) -> str:
        text = _("{name}: {points} of 100 points: {finding}")
        return text.format(name=self.task, points=points(self.score), finding=self.finding)


def grade(task: str, answer: npt.ArrayLike) -> Grade:
    """Grade a number, or several, that answers a task: six significant figures are to agree.

    The contest's tasks are "contact" (question 2: when benches first touch, s), "pitch" (question 3:
    the smallest, m), "turn-length" (question 4: of the turn within the disc, m) and "head-speed"
    (question 5: the greatest, m/s). The exercises' are "link", "chord", "head", "tail-speed", "gap",
    "touch", "arcs", "narrowest" and "fastest": the manual's page on them says what each asks.

    Args:
        task: its name.
        answer: a number in SI units and radians, or as many as are asked for; NaN where there is
            none yet.

    Raises:
        InputError: for a task that is not there, or another count of numbers.

    Examples:
        >>> bd.grade("contact", 413).finding
        'it is the first moment after it in steps of 1 s: what lies between two was not seen'
        >>> bd.grade("link", 2.4).agrees
        False
    """
    if not isinstance(task, str) or task not in TASKS:
        text = _("task must be one of {names}, not {value}")
        raise InputError(text.format(names=", ".join(TASKS), value=repr(task)))
    exact, wrong = TASKS[task]
    given, wanted = as_list("answer", answer), exact()
    if len(given) != len(wanted):
        text = _("answer must be as many numbers as the task {task} asks for: {wanted}, not {count}")
        raise InputError(text.format(task=task, wanted=len(wanted), count=len(given)))
    count = min(figures_agreeing(*pair) for pair in zip(given, wanted, strict=True))
    return Grade(task, count, _finding(given, count, wrong(wanted[0])))


def figures_agreeing(given: float, wanted: float) -> int:
    """How many significant figures agree."""
    off = abs(given - wanted)
    if not math.isfinite(off):
        return 0
    first = 10.0 ** (math.floor(math.log10(abs(wanted))) + 1)
    return MOST if off == 0.0 else min(MOST, max(0, math.floor(-math.log10(2.0 * off / first))))


def _finding(given: Numbers, count: int, wrong: Iterator[Wrong]) -> str:
    """A sentence on an answer that agrees to so many figures."""
    if any(math.isnan(number) for number in given):
        return _("there is no number yet")
    if count >= WANTED:
        return _("figures that agree: {count}").format(count=count)
    for value, text in wrong:
        if figures_agreeing(given[0], value) >= max(SAME, count + 1):
            return text
    text = _("figures that agree: {count}, of {wanted} that are required")
    return text.format(count=count, wanted=WANTED)


def _none(_exact: float) -> Iterator[Wrong]:
    """No mistake is known that leads to another number."""
    yield from ()


def _coil() -> Walk:
    """The dragon of the exercises: 100 benches on a coil of 0.6 m."""
    return read_plan("spiral-in", {"route.pitch": 0.6, "dragon.benches": 100}).build()


def _chord() -> Numbers:
    """The angles of the head's handle and the next one on the spiral at 200 s: how far apart, rad."""
    placed = _coil().motion(200.0)
    radii = np.hypot(placed.x[0, :2], placed.y[0, :2])
    return (float(radii[1] - radii[0]) * 2.0 * math.pi / 0.6,)


def _head() -> Numbers:
    placed = _coil().motion(200.0)
    return float(placed.x[0, 0]), float(placed.y[0, 0])


def _value(answer: Any) -> Numbers:
    return (float(answer.value),)


def _turn(**turn: float) -> Plan:
    return read_plan("turn", turn=turn)


# Each task: the numbers that answer it, and what known mistakes lead to.
TASKS: dict[str, tuple[Callable[[], Numbers], Callable[[float], Iterator[Wrong]]]] = {
    "contact": (lambda: _value(first_contact(read_plan("spiral-in"))), wrong_numbers.contacts),
    "pitch": (lambda: _value(smallest_pitch(read_plan("question-3"))), wrong_numbers.pitches),
    "turn-length": (lambda: (TwoArcTurn(1.7, 4.5).length,), wrong_numbers.lengths),
    "head-speed": (lambda: _value(greatest_head_speed(read_plan("turn"))), wrong_numbers.speeds),
    "link": (lambda: (2.6 - 2.0 * 0.2,), _none),
    "chord": (_chord, _none),
    "head": (_head, _none),
    "tail-speed": (lambda: (float(_coil().motion(200.0).speed[0, -1]),), _none),
    "gap": (lambda: (float(clearances(_coil().motion(460.0))[0]),), _none),
    "touch": (lambda: _value(first_contact(_coil())), _none),
    "arcs": (lambda: (TwoArcTurn(1.5, 4.0).length,), _none),
    "narrowest": (
        lambda: _value(smallest_pitch(read_plan("question-3", {"disc.radius": 5.0}))), _none
    ),
    "fastest": (lambda: _value(greatest_head_speed(_turn(ratio=1.0))), _none),
}  # fmt: skip
