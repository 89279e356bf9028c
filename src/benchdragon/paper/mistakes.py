"""Known mistakes of contest workbooks, each as what a workbook would hold that makes it.

A hypothesis predicts positions and speeds under its mistake, once or in several ways; what it needs to
know for that (an angle, a moment) it takes from medians, which single cells do not move.
"""

from collections.abc import Callable, Iterator

import numpy as np

from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.numbering import handle_names
from benchdragon.number_format import decimals
from benchdragon.paper.cases import (
    GRID,
    SHEETS,
    Case,
    ComplexArray,
    Guess,
    complex_of,
    values_of,
    with_points,
)
from benchdragon.paper.differences import ENDS, SCHEME_NAMES, SCHEMES, difference_speeds
from benchdragon.paper.entry import entry
from benchdragon.paper.wrong_sizes import degrees, size

# Steps of differences that are tried, s; handles by which rows may be shifted.
STEPS = (1.0, 0.1, 0.01, 0.001)
SHIFTS = (1, -1, 2, -2)
# Steps of searches for contact that are reported, s.
SEARCH_STEPS = (10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
# Steps in which a turn and a delay are sought at once.
REFINEMENTS = 6
# Share of positions below which those that are off are slips.
FEW_BROKEN = 0.01
# How near to first contact a search may have stopped, s.
NEARLY = 1e-3
# How near two moments, angles (rad) and factors are the same.
SAME_MOMENT, SAME_ANGLE, SAME_FACTOR = 2e-5, 5e-7, 1e-4

Hypothesis = Callable[[Case], Iterator[Guess]]


def rotated(case: Case) -> Iterator[Guess]:
    """Axes that point elsewhere: all points turned about the spiral's centre."""
    ours = complex_of(case.ours)
    angle = _median_angle(complex_of(case.theirs) * ours.conj())
    if abs(angle) < SAME_ANGLE:
        return
    text = _("the positions are rotated about the spiral's centre by {angle} degrees")
    yield Guess(
        "rotated",
        with_points(ours * np.exp(1j * angle), case.ours[2]),
        text.format(angle=decimals(np.degrees(angle))),
        angle,
        "rad",
    )


def mirrored(case: Case) -> Iterator[Guess]:
    """Clockwise for anticlockwise, or x for y: all points on the other side of a line."""
    ours = complex_of(case.ours)
    angle = 0.5 * _median_angle(complex_of(case.theirs) * ours)
    text = _(
        "the positions are mirrored in the line through the spiral's centre at {angle} degrees to the "
        "x axis"
    )
    if abs(angle - 0.25 * np.pi) < SAME_ANGLE:
        text = _("the positions are mirrored: x and y are exchanged")
    yield Guess(
        "mirrored",
        with_points(ours.conj() * np.exp(2j * angle), case.ours[2]),
        text.format(angle=decimals(np.degrees(angle))),
        angle,
        "rad",
    )


def _median_angle(turned: ComplexArray) -> float:
    """The angle of numbers that all point about the same way, rad; a few that do not change nothing."""
    known = turned[np.isfinite(turned) & (turned != 0.0)]
    if not known.size:
        return 0.0
    first = np.angle((known / np.abs(known)).sum())
    angle = first + np.median(np.angle(known * np.exp(-1j * first)))
    return float(np.angle(np.exp(1j * angle)))


# What other units make of metres, and of metres per second.
UNITS = ({1e2: "cm", 1e3: "mm", 1e-3: "km"}, {1e2: "cm/s", 1e3: "mm/s", 3.6: "km/h", 60.0: "m/min"})


def scaled(case: Case) -> Iterator[Guess]:
    """Other units, of positions or of speeds: all numbers so many times too large."""
    sizes = [np.abs(complex_of(v)) for v in (case.theirs, case.ours)], (case.theirs[2], case.ours[2])
    texts = (
        _("the positions are {factor} times too large"),
        _("the speeds are {factor} times too large"),
    )
    meant = _("the positions are in {unit}, not in m"), _("the speeds are in {unit}, not in m/s")
    for n, (theirs, ours) in enumerate(sizes):
        known = np.isfinite(theirs) & (ours > 0.0)
        factor = float(np.median(theirs[known] / ours[known])) if known.any() else 1.0
        if abs(factor - 1.0) < SAME_FACTOR:
            continue
        unit = next((u for f, u in UNITS[n].items() if abs(factor - f) < SAME_FACTOR * f), "")
        values, said = np.array(case.ours), (meant if unit else texts)[n]
        values[SHEETS[n]] *= factor
        yield Guess("unit", values, said.format(factor=f"{factor:.6g}", unit=unit), factor, "times")


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
    """Rows of another handle: rear for front, one too early or too late, tail first, the head's own."""
    count = case.ours.shape[2]
    names = handle_names(count)
    longer = np.concatenate([case.ours, case.behind], axis=2)
    for shift in SHIFTS:
        moved = np.full(case.ours.shape, np.nan)
        rows = np.arange(max(0, -shift), count)
        moved[:, :, rows] = longer[:, :, rows + shift]
        for first in _firsts(case, moved):
            values = np.where(np.arange(count) < first, case.ours, moved)
            text = _("the row of handle i holds handle i {sign} {shift}")
            if first:
                text = _("the row of handle i holds handle i {sign} {shift}, from {name} on")
            if first == 1:
                text = _("the row of handle i holds handle i {sign} {shift}, from the first body on")
            said = text.format(sign="+" if shift > 0 else "-", shift=abs(shift), name=names[first])
            yield Guess("handle", values, said, float(shift), "handles")
    yield Guess("handle", case.ours[:, :, ::-1], _("the handles stand in reverse order, tail first"))
    values = np.array(case.ours)
    values[2] = case.ours[2, :, :1]
    yield Guess("handle", values, _("all speeds are the head's"))
    yield from _slipped(case)


def _firsts(case: Case, moved: FloatArray) -> list[int]:
    """Rows from which on a workbook fits others best: of all quantities, of positions, of speeds."""
    scale = case.rounding
    ours, theirs = (
        np.nansum(np.log1p(np.square((case.theirs - np.where(np.isnan(v), case.ours, v)) / scale)), 1)
        for v in (case.ours, moved)
    )
    found = set()
    for part in (slice(0, 3), *SHEETS):
        before = np.concatenate([[0.0], np.cumsum(ours[part].sum(axis=0))])
        after = np.cumsum(theirs[part].sum(axis=0)[::-1])[::-1]
        found.add(int(np.argmin(before + np.append(after, 0.0))))
    return sorted(found - {case.ours.shape[2]})


def _slipped(case: Case) -> Iterator[Guess]:
    """Positions a row of the sheet too high or too low from some row on: y in the row of x."""
    rows = np.stack([case.ours[0], case.ours[1]], axis=-1).reshape(len(case.times), -1)
    theirs = np.stack([case.theirs[0], case.theirs[1]], axis=-1).reshape(rows.shape)
    names, scale = handle_names(case.ours.shape[2]), float(case.rounding[0, 0, 0])
    texts = {
        1: _("from {name} on, each row of the positions holds the numbers of the row below"),
        -1: _("from {name} on, each row of the positions holds the numbers of the row above"),
    }
    for shift, text in texts.items():
        moved = np.roll(rows, -shift, axis=1)
        both = [np.nansum(np.log1p(np.square((theirs - v) / scale)), axis=0) for v in (rows, moved)]
        before, after = np.append(0.0, np.cumsum(both[0])), np.cumsum(both[1][::-1])[::-1]
        first = int(np.argmin(before + np.append(after, 0.0)))
        if first < rows.shape[1]:
            values = np.where(np.arange(rows.shape[1]) < first, rows, moved)
            x, y = values[:, ::2], values[:, 1::2]
            said = text.format(name=f"{names[first // 2]} {'xy'[first % 2]}")
            yield Guess("handle", np.stack([x, y, case.ours[2]]), said)


def time(case: Case) -> Iterator[Guess]:
    """Another moment, or a clock that starts or runs otherwise, as told by where handles are."""
    for clock in case.clocks[: 2 if case.moment else 1]:
        yield from _by_clock(case, clock)


def turned_time(case: Case) -> Iterator[Guess]:
    """The same as told by how far from the centre the head is, whichever way the axes point."""
    turns = case.plan.route.kind == "turn"  # from where on it goes out again
    clock = np.linspace(case.span[0], min(case.span[1], 0.0 if turns else np.inf), GRID)
    points = case.walk.route.point(case.walk.head_position(clock))
    theirs = np.abs(complex_of(case.theirs)[:, 0])
    inwards = np.where(case.times < 0.0, theirs, np.nan) if turns else theirs
    radii = np.hypot(points[..., 0], points[..., 1])
    yield from _by_clock(case, np.interp(-inwards, -radii, clock, left=np.nan, right=np.nan))


def together(case: Case, turned: Guess, moved: Guess) -> Guess:
    """Other moments on which turned axes stand, better than from the head's distance from the centre.

    A turn and a delay look alike at any one handle, so both are sought at once, from all.
    """
    shift, angle = moved.amount or 0.0, turned.amount or 0.0
    points = complex_of(case.theirs)
    if turned.mistake == "mirrored":
        points, angle = points.conj(), -2.0 * angle
    for _step in range(REFINEMENTS):
        motion = case.walk.motion(case.times + shift, throw=False)
        here = motion.x + 1j * motion.y
        off = points * np.exp(-1j * angle) - here
        if not np.isfinite(off).any():
            return moved
        ways = 1j * here, motion.speed * np.exp(1j * case.headings_at(motion.s))
        near = np.abs(off) <= 3.0 * np.nanmedian(np.abs(off)) + case.rounding[0]
        columns = np.stack([np.append(way[near].real, way[near].imag) for way in ways], axis=-1)
        wanted = np.append(off[near].real, off[near].imag)
        change = np.linalg.lstsq(columns, wanted, rcond=None)[0]
        angle, shift = angle + change[0], shift + change[1]
    if case.moment:
        return _other_moment(case, float(case.times[0]) + shift)
    return _shifted(case, float(shift), f"{abs(shift):.6f}")


def _by_clock(case: Case, clock: FloatArray) -> Iterator[Guess]:
    """Positions at other times, as far as those are known."""
    known = np.isfinite(clock)
    if not known.any():
        return
    shift = float(np.median((clock - case.times)[known]))
    if case.moment:
        yield _other_moment(case, float(case.times[0]) + shift)
        return
    yield _shifted(case, shift, f"{abs(shift):.6f}")
    if np.count_nonzero(known) > 2:
        rate, start = _line(case.times[known], clock[known])
        text = _("the column of t holds the moment {rate} t {sign} {shift} s")
        said = text.format(
            rate=f"{rate:.6f}", sign="+" if start > 0.0 else "-", shift=f"{abs(start):.6f}"
        )
        values = values_of(case.walk, start + rate * case.times)
        yield Guess("time", values, said, float(start), "s")


def delayed(case: Case) -> Iterator[Guess]:
    """A second more or less, of one sheet alone."""
    if not case.moment:
        for shift in (1.0, -1.0):
            yield _shifted(case, shift, f"{abs(shift):g}")


def _shifted(case: Case, shift: float, size: str) -> Guess:
    text = _("the column of t holds the moment t {sign} {shift} s")
    said = text.format(sign="+" if shift > 0.0 else "-", shift=size)
    return Guess("time", values_of(case.walk, case.times + shift), said, shift, "s")


def _line(x: FloatArray, y: FloatArray) -> tuple[float, float]:
    """Slope and start of a robust line: median slope of far pairs, then least squares."""
    half = x.size // 2
    slope = np.median((y[half:] - y[: x.size - half]) / (x[half:] - x[: x.size - half]))
    off = np.abs(y - slope * x - np.median(y - slope * x))
    near = off <= 3.0 * np.median(off) + SAME_MOMENT
    rate, start = np.polyfit(x[near], y[near], 1) if np.count_nonzero(near) > 2 else (slope, 0.0)
    return float(rate), float(start)


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
    if abs(moment - contact) < NEARLY:
        text = _(
            "the moment is {moment} s, {shift} s off that of first contact, {contact} s: the search "
            "stopped so near it"
        )
    said = text.format(
        moment=f"{moment:.6f}",
        contact=f"{contact:.6f}",
        step=f"{step:g}",
        shift=f"{moment - contact:.1e}",
    )
    values = values_of(case.walk, np.array([moment]))
    return Guess("time", values, said, moment - contact, "s")


def differences(case: Case) -> Iterator[Guess]:
    """Speeds from two positions divided by the time between them, not from the rigid benches."""
    text = _("the speeds are {scheme} differences of positions with a step of {step} s")
    for step in STEPS:
        for scheme in SCHEMES:
            before, after = (offset * step for offset in ENDS[scheme])
            inside = (case.times + before >= case.span[0]) & (case.times + after <= case.span[1])
            values = np.array(case.ours)
            values[2] = np.nan
            values[2, inside] = difference_speeds(case.walk, case.times[inside], step, scheme)
            said = text.format(scheme=_(SCHEME_NAMES[scheme]), step=f"{step:g}")
            yield Guess("differences", values, said, step, "s")
    if np.isfinite(case.theirs).any(axis=(0, 2)).sum() > 2:
        step = float(np.median(np.diff(case.times)))
        text = _("the speeds are {scheme} differences of the workbook's own positions, {step} s apart")
        slack = 3.0 * float(case.rounding[0, 0, 0]) / step
        for name, speeds in _own_differences(case).items():
            values = np.stack([*case.ours[:2], speeds])
            said = text.format(scheme=_(SCHEME_NAMES[name]), step=f"{step:g}")
            yield Guess("differences", values, said, step, "s", slack)


def _own_differences(case: Case) -> dict[str, FloatArray]:
    """Differences of their positions from column to column; one-sided at the ends where central."""
    held = np.isfinite(case.theirs).any(axis=(0, 2))
    points, ours = complex_of(case.theirs[:, held]), complex_of(case.ours[:, held])
    broken = np.abs(points - ours) > case.tolerance[0, 0]
    if np.count_nonzero(broken) < FEW_BROKEN * broken.size:  # speeds were not taken from these
        points = np.where(broken, ours, points)
    steps = np.diff(case.times[held])[:, np.newaxis]
    between = np.abs(np.diff(points, axis=0)) / steps
    nothing = np.full((1, points.shape[1]), np.nan)
    middle = np.abs(points[2:] - points[:-2]) / (steps[1:] + steps[:-1])
    speeds = {
        "forward": np.concatenate([between, nothing]),
        "central": np.concatenate([between[:1], middle, between[-1:]]),
        "backward": np.concatenate([nothing, between]),
    }
    whole = {name: np.full(case.ours.shape[1:], np.nan) for name in speeds}
    for name, known in speeds.items():
        whole[name][held] = known
    return whole


# In this order: of two that leave about as much the earlier one counts.
HYPOTHESES: tuple[Hypothesis, ...] = (
    rotated, mirrored, swapped, scaled, degrees, handle, entry, size, time, delayed, differences,
)  # fmt: skip
# Those that speeds may show alone.
SPEEDS_ALONE: tuple[Hypothesis, ...] = (scaled, handle, entry, delayed, differences)
# Other axes and units, and what they may stand on top of.
AXES: tuple[Hypothesis, ...] = (rotated, mirrored)
TRANSFORMS: tuple[Hypothesis, ...] = (*AXES, scaled)
BASES: tuple[Hypothesis, ...] = (*AXES, swapped, handle, size)
