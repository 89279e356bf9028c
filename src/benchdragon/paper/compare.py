"""A contest workbook beside the exact values: how far off, from where on, and by which mistake."""

import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from benchdragon.analysis.contact import first_contact
from benchdragon.errors import InputError, of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.number_format import finite_or_none
from benchdragon.paper.mistakes import Case, Fit, Mistake, best_fit, exact_fit, values_of
from benchdragon.paper.workbook import HANDLES, QUANTITIES, Quantity, Workbook, read_workbook
from benchdragon.plans.schema import read_plan

Result = Literal["result1", "result2", "result4"]
RESULTS: tuple[Result, ...] = get_args(Result)
# Which of the contest's workbooks a file's name promises.
NAMED = re.compile(r"result[ _-]*([124])(?!\d)", re.IGNORECASE)
# Plan of each, and plan and first time of the other part's; times that the contest asks for, s.
PARTS = {
    "result1": ("spiral-in", "turn", -100.0),
    "result2": ("spiral-in", "turn", -100.0),
    "result4": ("turn", "spiral-in", 0.0),
}
TIMES = {"result1": np.arange(0.0, 301.0), "result4": np.arange(-100.0, 101.0)}
# What rounding to six decimals does, with some room.
SIX_DECIMALS = 5.01e-7
# Links of the contest's dragon, m, and how far a link may be off unnoticed.
LINKS, LINK_SLACK = (2.86, 1.65), 1e-4
# Lengths of its benches, m.
LENGTHS = (3.41, 2.20)
# Deviations that add up along the dragon: at most so large, m; at the tail so many times that at the
# head, each a mean over so many handles; and how closely they follow the number of the handle.
SMALL_DEVIATION, GROWTH, END_HANDLES, GROWING = 1e-2, 1.2, 20, 0.9


@dataclass(frozen=True)
class Deviation:
    """How far off the cells of one quantity are.

    Attributes:
        cells: that hold a number which can be compared.
        empty: that hold none and should.
        agreeing: cells that agree to six decimals.
        largest: deviation, m or m/s; None without cells.
        handle, time: where that is, from 0, and when, s.
    """

    cells: int
    empty: int
    agreeing: int
    largest: float | None
    handle: int | None
    time: float | None


@dataclass(frozen=True)
class Departure:
    """The first cell that is off: of the earliest time, there of the first handle.

    Attributes:
        time: s.
        handle: from 0.
        quantity: what it holds.
        theirs: its number, m or m/s; None if it is empty.
        exact: what it should hold.
    """

    time: float
    handle: int
    quantity: Quantity
    theirs: float | None
    exact: float


@dataclass(frozen=True)
class Comparison:
    """A workbook beside the exact values.

    Attributes:
        result: which of the contest's workbooks it was compared with.
        largest_place, largest_speed: largest deviation of a coordinate, m, and of a speed, m/s; None
            where there are no numbers.
        first_departure: None if no cell is off, and none empty.
        mistake: the known mistake that explains what is off, "unknown" if none does; None if nothing is
            off.
        amount: how large the mistake is, in `unit`: rad, s or handles; None where that says nothing.
        finding: the mistake in words.
        residual: root mean square of what the mistake leaves unexplained, over all cells.
        remarks: what else there is to say.
        places, speeds: cells of positions, and of speeds.
        tolerance: how far off a cell may be, m and m/s.
    """

    result: Result
    largest_place: float | None
    largest_speed: float | None
    first_departure: Departure | None
    mistake: Mistake | None
    amount: float | None
    unit: str | None
    finding: str
    residual: float
    remarks: tuple[str, ...]
    places: Deviation
    speeds: Deviation
    tolerance: float

    @property
    def agrees(self) -> bool:
        """Whether every cell that the contest asks for is there and none is off."""
        return self.mistake is None and not self.places.empty and not self.speeds.empty


def compare(path: str | Path, *, result: Result | None = None, tolerance: float = 1e-6) -> Comparison:
    """How far a workbook in the layout of result1, result2 or result4 is off, and by which mistake.

    Args:
        path: an .xlsx file; rows may be labelled in Chinese or English.
        result: which of the three it is to be; None: as its name says, else its columns.
        tolerance: how far off a cell may be, m and m/s; rounding to six decimals takes 5e-7.

    Raises:
        InputError: for a file that is no such workbook, or too large for one, or holds no number that
            can be compared.
    """
    path = Path(path) if isinstance(path, str) else path
    of_kind("path", path, Path)
    positive("tolerance", tolerance)
    if result not in (None, *RESULTS):
        text = _("result must be one of {names}, not {value}")
        raise InputError(text.format(names=", ".join(RESULTS), value=repr(result)))
    book = read_workbook(path)
    kind = _kind(book, promised := result or _promised(path))
    case = _case(book, kind)
    off = np.abs(case.theirs - case.ours)
    if not np.isfinite(off).any():
        raise InputError(_("{path}: none of its times lies in the walk").format(path=path))
    departs = bool((off > tolerance).any())
    fit = best_fit(case) if departs else exact_fit(case)
    swaps = _swaps(book, kind, promised)
    mistake, finding = _named(fit, swaps, departs)
    places, speeds = (_deviation(case, part) for part in (slice(0, 2), slice(2, 3)))
    remarks = [*_empty_cells(places, speeds), *_left(case, fit, tolerance)]
    remarks += swaps if departs else []
    remarks += [_share(off, tolerance), *_how_computed(case, fit)] if departs else []
    return Comparison(
        kind, places.largest, speeds.largest, _first_departure(case, tolerance), mistake,
        fit.guess.amount if fit.guess else None, fit.guess.unit if fit.guess else None,
        finding, fit.residual, tuple(remarks), places, speeds, tolerance,
    )  # fmt: skip


def _promised(path: Path) -> Result | None:
    """The workbook that a file's name promises."""
    found = NAMED.search(path.stem)
    return next((kind for kind in RESULTS if found and kind.endswith(found[1])), None)


def _kind(book: Workbook, promised: Result | None) -> Result:
    """What to compare with: as promised, but of one moment only if the workbook is."""
    if book.times is None:
        return "result2"
    if promised in TIMES:
        return promised
    return "result4" if book.times[0] < 0.0 else "result1"


def _swaps(book: Workbook, kind: Result, promised: Result | None) -> list[str]:
    """What is swapped by name alone."""
    found = []
    if promised is not None and kind != promised:
        text = _("the workbook is laid out as {kind}, not as {promised}")
        found.append(text.format(kind=kind, promised=promised))
    if book.crossed:
        found.append(_("the names of the sheets are swapped: positions stand where speeds should"))
    return found


def _case(book: Workbook, kind: Result) -> Case:
    """The workbook beside the exact values, at all times that either has."""
    name, other_name, first = PARTS[kind]
    plan = read_plan(name)
    walk, other = plan.build(), read_plan(other_name).build()
    span = plan.span(walk)
    if book.times is None:
        contact = first_contact(walk, *span)
        assert contact is not None, "the contest's dragon touches itself"
        times, theirs = np.array([contact.value]), book.values
    else:
        times = np.union1d(book.times, TIMES[kind]).astype(float)
        theirs = np.full((3, len(times), HANDLES), np.nan)
        theirs[:, np.searchsorted(times, book.times)] = book.values
    return Case(
        walk, other, span, times, np.arange(first, first + len(times)), theirs, values_of(walk, times),
        book.times is None,
    )  # fmt: skip


def _named(fit: Fit, swaps: list[str], departs: bool) -> tuple[Mistake | None, str]:
    """The mistake, and a sentence on it."""
    if not (departs or swaps):
        return None, _("all numbers agree")
    if fit.guess is not None:
        return fit.guess.mistake, fit.guess.text
    if departs:
        return "unknown", _("no known mistake explains what is off")
    return "swapped", "; ".join(swaps)


def _deviation(case: Case, part: slice) -> Deviation:
    theirs, ours = case.theirs[part], case.ours[part]
    off = np.abs(theirs - ours)
    cells, empty = int(np.isfinite(off).sum()), int((np.isnan(theirs) & np.isfinite(ours)).sum())
    if not cells:
        return Deviation(0, empty, 0, None, None, None)
    _axis, row, handle = np.unravel_index(np.nanargmax(off), off.shape)
    agreeing = int((off <= SIX_DECIMALS).sum())
    largest = float(np.nanmax(off))
    return Deviation(cells, empty, agreeing, largest, int(handle), float(case.times[row]))


def _first_departure(case: Case, tolerance: float) -> Departure | None:
    """The first cell that is off; else the first that is empty."""
    empty = np.isnan(case.theirs) & np.isfinite(case.ours)
    for wrong in (np.abs(case.theirs - case.ours) > tolerance, empty):
        in_order = np.moveaxis(wrong, 0, -1)
        if in_order.any():
            row, handle, axis = np.unravel_index(np.argmax(in_order), in_order.shape)
            theirs, exact = (float(table[axis, row, handle]) for table in (case.theirs, case.ours))
            return Departure(
                float(case.times[row]), int(handle), QUANTITIES[axis], finite_or_none(theirs), exact
            )
    return None


def _empty_cells(*found: Deviation) -> list[str]:
    empty, cells = sum(one.empty for one in found), sum(one.empty + one.cells for one in found)
    text = _("{empty} of the {cells} cells that the contest asks for are empty")
    return [text.format(empty=empty, cells=cells)] if empty else []


def _share(off: FloatArray, tolerance: float) -> str:
    text = _("{count} of {cells} numbers are off by more than {tolerance}")
    return text.format(
        count=np.count_nonzero(off > tolerance),
        cells=np.count_nonzero(np.isfinite(off)),
        tolerance=tolerance,
    )


def _left(case: Case, fit: Fit, tolerance: float) -> list[str]:
    """What the mistake does not explain, and which sheet alone shows it."""
    if fit.guess is None:
        return []
    said = []
    for part, shows, text in (
        (slice(0, 2), fit.sheets == (False, True), _("only the speeds show it")),
        (slice(2, 3), fit.sheets == (True, False), _("only the positions show it")),
    ):
        same = np.array_equal(fit.guess.values[part], case.ours[part], equal_nan=True)
        said += [text] if shows and not same else []
    largest = float(np.nanmax(np.abs(case.theirs - fit.values)))
    if largest > 2.0 * tolerance:  # differences of rounded positions are off by so much
        text = _("beside that, numbers are off by up to {largest} m or m/s")
        said.append(text.format(largest=f"{largest:.1e}"))
        second = best_fit(replace(case, ours=fit.values)).guess
        said += [second.text] if second else []
    return said


def _how_computed(case: Case, fit: Fit) -> list[str]:
    """What numbers tell of how they were computed: links, errors that add up, decimals."""
    said = [] if fit.sheets[0] else [*_links(case), *_growth(case)]
    known = case.theirs[np.isfinite(case.theirs)]
    for count in range(6):
        if np.allclose(known, np.round(known, count), rtol=0.0, atol=1e-9):
            text = _("the numbers are rounded to {count} decimals; the contest asks for 6")
            return [*said, text.format(count=count)]
    return said


def _links(case: Case) -> list[str]:
    """Distances between the workbook's handles, if they are not the contest's."""
    apart = np.hypot(*np.diff(case.theirs[:2], axis=2))
    if not (np.isfinite(apart[:, 0]).any() and np.isfinite(apart[:, 1:]).any()):
        return []
    lengths = float(np.nanmedian(apart[:, 0])), float(np.nanmedian(apart[:, 1:]))
    scatter = np.nanmedian(np.abs(apart[:, 1:] - lengths[1]))
    if scatter > LINK_SLACK or np.allclose(lengths, LINKS, rtol=0.0, atol=LINK_SLACK):
        return []
    text = _(
        "the handles of the head are {first} m apart and those of all others {others} m; the links "
        "are {links} m"
    )
    if np.allclose(lengths, LENGTHS, rtol=0.0, atol=LINK_SLACK):
        text = _(
            "the handles of the head are {first} m apart and those of all others {others} m: these "
            "are the lengths of the benches; the links are {links} m"
        )
    links = " / ".join(f"{link:.2f}" for link in LINKS)
    return [text.format(first=f"{lengths[0]:.4f}", others=f"{lengths[1]:.4f}", links=links)]


def _growth(case: Case) -> list[str]:
    """Small deviations that grow from bench to bench."""
    off = np.hypot(*(case.theirs - case.ours)[:2])
    handles = np.flatnonzero(np.isfinite(off).any(axis=0))
    if len(handles) < 2 * END_HANDLES or np.nanmax(off) > SMALL_DEVIATION:
        return []
    means = np.nanmean(off[:, handles], axis=0)
    head, tail = means[:END_HANDLES].mean(), means[-END_HANDLES:].mean()
    if tail <= GROWTH * head or np.corrcoef(handles, means)[0, 1] < GROWING:
        return []
    text = _(
        "positions are the more off the farther back a handle is, by {head} m on average near the head "
        "and {tail} m near the tail: errors of single benches add up"
    )
    return [text.format(head=f"{head:.1e}", tail=f"{tail:.1e}")]
