"""Known mistakes of contest workbooks, each as what a workbook would hold that makes it.

A hypothesis predicts positions and speeds under its mistake, once or in several ways; what is left
between a prediction and the workbook, as a root mean square, decides which one fits.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.walk import Walk
from benchdragon.number_format import decimals
from benchdragon.paper.differences import SCHEMES, difference_speeds

ComplexArray = npt.NDArray[np.complex128]
Mistake = Literal["rotated", "mirrored", "swapped", "differences", "handle", "time", "unknown"]

# A prediction fits if it leaves this share of the deviations at most; where they come near to the
# rounding to six decimals, half of them will do.
EXPLAINED, NEAR_ROUNDING, ROUNDING = 0.05, 0.5, 5e-7
# Another prediction is better if it leaves this share of what the one before leaves.
CLEARLY = 0.9
# Steps of differences that are tried, s; handles by which rows may be shifted, and from which row on.
STEPS = (1.0, 0.1, 0.01, 0.001)
SHIFTS = ((1, 0), (-1, 0), (2, 0), (-2, 0), (1, 1), (2, 1))
# Steps of searches for contact that are told of, s.
SEARCH_STEPS = (10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
# Where the head was is sought among so many times of the walk, and so many of the workbook's.
GRID, SAMPLES = 6000, 301
# How near two moments are the same, s.
SAME_MOMENT = 2e-5


@dataclass(frozen=True, eq=False)
class Case:
    """A workbook beside the exact values.

    Attributes:
        walk, other: the walk that the workbook is about, and that of the contest's other part.
        span: start and end of `walk`, s.
        times: of the columns, s, (T,); other_times: what stands in the same columns of the other part's
            workbook.
        theirs, ours: x, y (m) and speed (m/s), (3, T, 224), NaN where there is nothing.
        moment: whether the workbook is of one moment, that of first contact.
    """

    walk: Walk
    other: Walk
    span: tuple[float, float]
    times: FloatArray
    other_times: FloatArray
    theirs: FloatArray
    ours: FloatArray
    moment: bool

    @cached_property
    def head_times(self) -> FloatArray:
        """When the walk's head comes nearest to theirs, s, (T,); NaN where that is not known."""
        clock = np.linspace(*self.span, GRID)
        grid, theirs = self._head(clock)[0], _complex(self.theirs)[:, 0]
        known = np.flatnonzero(np.isfinite(theirs))
        at = known[:: 1 + known.size // SAMPLES]
        times = np.array([clock[np.abs(grid - theirs[i]).argmin()] for i in at])
        for _step in range(4):  # Newton's, as if the head went straight on
            points, velocities = self._head(times)
            ahead = ((theirs[at] - points) / velocities).real
            times = np.clip(times + ahead, *self.span)
        found = np.full(theirs.size, np.nan)
        inside = (self.span[0] < times) & (times < self.span[1])
        found[at[inside]] = times[inside]
        return found

    def _head(self, times: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Where the head of the walk is, m, and its velocity, m/s, as complex numbers."""
        s = self.walk.head_position(times)
        points, heading = self.walk.route.point(s), self.walk.route.heading(s)
        speed = self.walk.profile.speed(times)
        return points[..., 0] + 1j * points[..., 1], speed * np.exp(1j * heading)


@dataclass(frozen=True, eq=False)
class Guess:
    """What a workbook would hold.

    Attributes:
        mistake: its name.
        values: x, y, speed as in Case; NaN where nothing is predicted.
        text: the mistake in words.
        amount: how large it is, in `unit`: an angle, a time, a number of handles.
    """

    mistake: Mistake
    values: FloatArray
    text: str
    amount: float | None = None
    unit: str | None = None


Hypothesis = Callable[[Case], Iterator[Guess]]


def _complex(values: FloatArray) -> ComplexArray:
    return np.asarray(values[0] + 1j * values[1])


def _with_points(points: ComplexArray, speed: FloatArray) -> FloatArray:
    return np.stack([points.real, points.imag, speed])


def values_of(walk: Walk, times: FloatArray) -> FloatArray:
    """x, y (m) and speed (m/s) of all handles, (3, T, 224); NaN where the dragon cannot stand."""
    motion = walk.motion(times, throw=False)
    return np.stack([motion.x, motion.y, motion.speed])


def rotated(case: Case) -> Iterator[Guess]:
    """Axes that point elsewhere: all points turned about the spiral's centre."""
    ours = _complex(case.ours)
    angle = float(np.angle(np.nansum(_complex(case.theirs) * ours.conj())))
    text = _("the positions are rotated about the spiral's centre by {angle} degrees")
    yield Guess(
        "rotated",
        _with_points(ours * np.exp(1j * angle), case.ours[2]),
        text.format(angle=decimals(np.degrees(angle))),
        angle,
        "rad",
    )


def mirrored(case: Case) -> Iterator[Guess]:
    """Clockwise for anticlockwise, or x for y: all points on the other side of a line."""
    ours = _complex(case.ours)
    angle = 0.5 * float(np.angle(np.nansum(_complex(case.theirs) * ours)))
    text = _(
        "the positions are mirrored in the line through the spiral's centre at {angle} degrees to the "
        "x axis"
    )
    if abs(angle - 0.25 * np.pi) < ROUNDING:
        text = _("the positions are mirrored: x and y are exchanged")
    yield Guess(
        "mirrored",
        _with_points(ours.conj() * np.exp(2j * angle), case.ours[2]),
        text.format(angle=decimals(np.degrees(angle))),
        angle,
        "rad",
    )


def swapped(case: Case) -> Iterator[Guess]:
    """The other part of the contest, or one sheet's numbers in the rows of the other."""
    if case.moment:
        return
    for times in (case.times, case.other_times):
        text = _("the workbook holds the other part of the contest: result1 and result4 are swapped")
        yield Guess("swapped", values_of(case.other, times), text)
    rows = np.stack([case.ours[0], case.ours[1]], axis=-1).reshape(len(case.times), -1)
    count, speed = case.ours.shape[2], case.ours[2]
    values = np.full(case.ours.shape, np.nan)
    values[0, :, : count // 2], values[1, :, : count // 2] = speed[:, ::2], speed[:, 1::2]
    values[2] = rows[:, :count]
    yield Guess("swapped", values, _("positions and speeds are swapped"))


def handle(case: Case) -> Iterator[Guess]:
    """Rows of another handle: rear for front, one too early or too late, tail first."""
    count = case.ours.shape[2]
    for shift, first in SHIFTS:
        values = np.full(case.ours.shape, np.nan)
        rows = np.arange(first, count)
        rows = rows[(rows + shift >= 0) & (rows + shift < count)]
        values[:, :, rows] = case.ours[:, :, rows + shift]
        values[:, :, :first] = case.ours[:, :, :first]
        text = _("the row of handle i holds handle i {sign} {shift}")
        if first:
            text = _("the row of handle i holds handle i {sign} {shift}, from the first body on")
        said = text.format(sign="+" if shift > 0 else "-", shift=abs(shift))
        yield Guess("handle", values, said, float(shift), "handles")
    yield Guess("handle", case.ours[:, :, ::-1], _("the handles stand in reverse order, tail first"))


def time(case: Case) -> Iterator[Guess]:
    """Another moment, or a clock that starts or runs otherwise, as told by where the head is."""
    clock, known = case.head_times, np.isfinite(case.head_times)
    if not known.any():
        return
    shift = float(np.median((clock - case.times)[known]))
    if case.moment:
        yield _other_moment(case, float(case.times[0]) + shift)
        return
    text = _("the column of t holds the moment t {sign} {shift} s")
    said = text.format(sign="+" if shift > 0.0 else "-", shift=f"{abs(shift):.6f}")
    yield Guess("time", values_of(case.walk, case.times + shift), said, shift, "s")
    if np.count_nonzero(known) > 2:
        rate, start = np.polyfit(case.times[known], clock[known], 1)
        text = _("the column of t holds the moment {rate} t {sign} {shift} s")
        said = text.format(
            rate=f"{rate:.6f}", sign="+" if start > 0.0 else "-", shift=f"{abs(start):.6f}"
        )
        values = values_of(case.walk, start + rate * case.times)
        yield Guess("time", values, said, float(start), "s")
    for shift in (1.0, -1.0):  # of one sheet alone
        said = _("the column of t holds the moment t {sign} {shift} s").format(
            sign="+" if shift > 0.0 else "-", shift="1"
        )
        yield Guess("time", values_of(case.walk, case.times + shift), said, shift, "s")


def _other_moment(case: Case, moment: float) -> Guess:
    """Result2 at another moment than that of first contact, and what may have led there."""
    contact, (start, end) = float(case.times[0]), case.span
    text = _("the moment is {moment} s, not that of first contact, {contact} s")
    if abs(moment - end) < 0.5:
        text = _(
            "the moment is {moment} s, not that of first contact, {contact} s: there the walk ends; "
            "the end point alone was looked at, or no contact was seen"
        )
    for step in SEARCH_STEPS:
        if abs(moment - start - step * np.ceil((contact - start) / step)) < SAME_MOMENT:
            text = _(
                "the moment is {moment} s, not that of first contact, {contact} s: it is the first one "
                "after it in steps of {step} s"
            )
            break
    said = text.format(moment=f"{moment:.6f}", contact=f"{contact:.6f}", step=f"{step:g}")
    values = values_of(case.walk, np.array([moment]))
    return Guess("time", values, said, moment - contact, "s")


def differences(case: Case) -> Iterator[Guess]:
    """Speeds from two positions divided by the time between them, not from the rigid benches."""
    if len(case.times) > 2:
        text = _("the speeds are {scheme} differences of the workbook's own positions")
        for name, speeds in _own_differences(case).items():
            values, said = np.stack([*case.ours[:2], speeds]), text.format(scheme=_scheme(name))
            yield Guess("differences", values, said, float(np.median(np.diff(case.times))), "s")
    text = _("the speeds are {scheme} differences of positions with a step of {step} s")
    for step in STEPS:
        inside = (case.times >= case.span[0]) & (case.times + step <= case.span[1])
        for scheme in SCHEMES:
            values = np.array(case.ours)
            values[2] = np.nan
            values[2, inside] = difference_speeds(case.walk, case.times[inside], step, scheme)
            said = text.format(scheme=_scheme(scheme), step=f"{step:g}")
            yield Guess("differences", values, said, step, "s")


def _scheme(name: str) -> str:
    return {"forward": _("forward"), "central": _("central"), "backward": _("backward")}[name]


def _own_differences(case: Case) -> dict[str, FloatArray]:
    """Differences of their positions from column to column; one-sided at the ends where central."""
    points = _complex(case.theirs)
    steps = np.diff(case.times)[:, np.newaxis]
    between = np.abs(np.diff(points, axis=0)) / steps
    nothing = np.full((1, points.shape[1]), np.nan)
    middle = np.abs(points[2:] - points[:-2]) / (steps[1:] + steps[:-1])
    return {
        "forward": np.concatenate([between, nothing]),
        "central": np.concatenate([between[:1], middle, between[-1:]]),
        "backward": np.concatenate([nothing, between]),
    }


# In this order: of two that leave about as much the earlier one counts.
HYPOTHESES: tuple[Hypothesis, ...] = (rotated, mirrored, swapped, handle, time, differences)


@dataclass(frozen=True)
class Fit:
    """The guess that fits best.

    Attributes:
        guess: None if none fits.
        values: what it predicts; the exact values in a sheet that they fit better.
        residual: root mean square of what is left in all cells, m and m/s.
        sheets: whether it is what positions, and speeds, show.
    """

    guess: Guess | None
    values: FloatArray
    residual: float
    sheets: tuple[bool, bool]


def best_fit(case: Case) -> Fit:
    """The known mistake that a workbook shows, if it shows one."""
    exact = best = exact_fit(case)
    for hypothesis in HYPOTHESES:
        for guess in hypothesis(case):
            tried = _fit(case, guess, guess.values)
            if tried.residual < CLEARLY * best.residual:
                best = tried
    near = best.residual <= ROUNDING and best.residual <= NEAR_ROUNDING * exact.residual
    return best if near or best.residual <= EXPLAINED * exact.residual else exact


def exact_fit(case: Case) -> Fit:
    """What is left without any mistake."""
    return _fit(case, None, case.ours)


def _fit(case: Case, guess: Guess | None, values: FloatArray) -> Fit:
    """What a prediction leaves, in each sheet that it fits better than the exact values."""
    left, chosen = [], []
    for part in (slice(0, 2), slice(2, 3)):
        theirs = case.theirs[part]
        squares = [np.square(theirs - some[part]) for some in (case.ours, values)]
        ours, predicted = (np.nanmean(s) if np.isfinite(s).any() else np.inf for s in squares)
        cells = np.count_nonzero(np.isfinite(theirs))
        covered = 2 * np.count_nonzero(np.isfinite(squares[1])) >= cells
        chosen.append(bool(covered and predicted < ours))
        left.append(cells * (predicted if chosen[-1] else ours) if cells else 0.0)
    merged = np.concatenate(
        [values[:2] if chosen[0] else case.ours[:2], values[2:] if chosen[1] else case.ours[2:]]
    )
    count = np.count_nonzero(np.isfinite(case.theirs))
    return Fit(guess, merged, float(np.sqrt(sum(left) / count)), (chosen[0], chosen[1]))
