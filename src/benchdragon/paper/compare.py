"""A contest workbook compared with the exact values: its errors, where they begin, and their cause."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from benchdragon.analysis.contact import first_contact
from benchdragon.errors import InputError, of_kind, positive
from benchdragon.i18n import _
from benchdragon.model.numbering import handle_names
from benchdragon.number_format import decimals, finite_or_none
from benchdragon.paper.cases import DECIMALS, SHEETS, WITHIN, BoolArray, Case, Mistake, values_of
from benchdragon.paper.fits import Fit, best_fit, exact_fit
from benchdragon.paper.handed_in import TIMES
from benchdragon.paper.workbook import HANDLES, QUANTITIES, Quantity, Workbook, read_workbook
from benchdragon.paper.wrong_sizes import links_of, links_text
from benchdragon.plans.schema import read_plan

Result = Literal["result1", "result2", "result4"]
RESULTS: tuple[Result, ...] = get_args(Result)
# Which of the contest's workbooks a file's name promises.
NAMED = re.compile(r"result[ _-]*([124])(?!\d)", re.IGNORECASE)
# Plan of each, and plan and first time of the other part's, s.
PARTS = {
    "result1": ("spiral-in", "turn", -100.0),
    "result2": ("spiral-in", "turn", -100.0),
    "result4": ("turn", "spiral-in", 0.0),
}
# What rounding to six decimals does, with some room.
SIX_DECIMALS = 5.01e-7
# Cells beside a mistake are single ones up to this share of all, or so many; so many are named; after
# so many mistakes at once no further one is sought.
FEW, FEWEST, NAMED_CELLS, MISTAKES = 0.01, 3, 3, 3
# Of more columns than so many, one may be off by itself.
SEVERAL = 4
# Share of the others that agree to six decimals where single cells are what is off.
RIGHT = 0.9
# Deviations that add up along the dragon: at most so large, m; at the tail so many times that at the
# head, each a mean over so many handles; and how closely they follow the number of the handle.
SMALL_DEVIATION, GROWTH, END_HANDLES, GROWING = 1e-2, 1.2, 20, 0.9


@dataclass(frozen=True)
class Deviation:
    """The errors of the cells of one quantity.

    Attributes:
        cells: that hold a number which can be compared.
        asked: that the contest asks for.
        empty: of these, that hold none.
        right: of these, that are within the tolerance.
        agreeing: cells that agree to six decimals.
        largest: deviation, m or m/s; None without cells.
        handle, time: where that is, from 0, and when, s.
    """

    cells: int
    asked: int
    empty: int
    right: int
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
        amount: how large the mistake is, in `unit`; None where that says nothing.
        finding: the mistake in words.
        residual: root mean square of what the mistakes named leave, without single cells beside them.
        beside: how many such cells there are.
        remarks: what else there is to say.
        places: cells of positions.
        speeds: cells of speeds.
        tolerance: of cells, m and m/s.

    Examples:
        >>> found = bd.compare(folder / "result2.xlsx")
        >>> found.largest_place < 1e-6
        True
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
    beside: int
    remarks: tuple[str, ...]
    places: Deviation
    speeds: Deviation
    tolerance: float

    @property
    def agrees(self) -> bool:
        """Whether every cell that the contest asks for is there and none is off."""
        return self.mistake is None and not self.places.empty and not self.speeds.empty

    @property
    def score(self) -> float:
        """Share of the cells that the contest asks for that are within the tolerance, 0 to 1."""
        sheets = self.places, self.speeds
        return sum(one.right for one in sheets) / sum(one.asked for one in sheets)

    def __str__(self) -> str:
        text = _("{name}: {points} of 100 points: {finding}")
        return text.format(name=self.result, points=points(self.score), finding=self.finding)


def compare(path: str | Path, *, result: Result | None = None, tolerance: float = 1e-6) -> Comparison:
    """How far a workbook in the layout of result1, result2 or result4 is off, and by which mistake.

    Args:
        path: an .xlsx file; rows may be labelled in Chinese or English.
        result: which of the three it is to be; None: as its name says, else its columns.
        tolerance: of cells, m and m/s; rounding to six decimals takes 5e-7.

    Raises:
        InputError: for a file that is no such workbook, or too large for one, or holds no number that
            can be compared.

    Examples:
        >>> found = bd.compare(folder / "result2.xlsx")
        >>> found.result, found.mistake
        ('result2', None)
    """
    path = Path(path) if isinstance(path, str) else path
    of_kind("path", path, Path)
    positive("tolerance", tolerance)
    if result not in (None, *RESULTS):
        text = _("result must be one of {names}, not {value}")
        raise InputError(text.format(names=", ".join(RESULTS), value=repr(result)))
    book = read_workbook(path)
    kind = _kind(book, promised := result or _promised(path))
    case = _case(book, kind, tolerance)
    if not np.isfinite(case.theirs - case.ours).any():
        raise InputError(_("{path}: none of its times lies in the walk").format(path=path))
    return _compared(case, kind, book.remarks, _swaps(book, kind, promised))


def _compared(case: Case, kind: Result, told: Sequence[str], swaps: list[str]) -> Comparison:
    """The comparison of a workbook with the exact values, after the remarks on reading it."""
    off = np.abs(case.theirs - case.ours)
    departs = bool((off > case.tolerance).any())
    fits, shown = _fits(case) if departs else ([], _Shown(case, exact_fit(case)))
    asked = np.isin(case.times, TIMES.get(kind, case.times))
    places, speeds = (_deviation(case, part, asked) for part in SHEETS)
    mistake, finding = _named(shown, fits, swaps, departs, not (places.empty or speeds.empty))
    remarks = [*told, *_empty_cells(case, places, speeds), *_left(shown, fits)]
    remarks += swaps if departs else []
    remarks += [_share(case), *_how_computed(case, fits)] if departs else []
    guess = fits[0].guess if fits else None
    amount, unit = (guess.amount, guess.unit) if guess else (None, None)
    if mistake == "rounding":
        amount, unit = float(min(case.decimals)), "decimals"
    beside = int(np.count_nonzero(shown.cells)) if shown.few else 0
    return Comparison(
        kind, places.largest, speeds.largest, _first_departure(case, asked), mistake, amount, unit,
        finding, shown.residual, beside, tuple(remarks), places, speeds, float(case.tolerance.max()),
    )  # fmt: skip


def _fits(case: Case) -> tuple[list[Fit], "_Shown"]:
    """Mistakes that a workbook shows, each sought behind those before, and what all of them leave."""
    found: list[Fit] = []
    left = _Shown(case, exact_fit(case))
    while len(found) < MISTAKES and not (found and left.few):
        fit = best_fit(left.case)
        if fit.guess is None:
            break
        found.append(fit)
        left = _Shown(left.case, fit)
    return found, left


class _Shown:
    """What mistakes leave in a workbook.

    Attributes:
        case: with the values that they make of it; cells that are right all the same are meant so.
        cells: that are off, (3, T, 224); few: whether these are single ones, and no other is.
        residual: root mean square of what is left, without single cells.
    """

    def __init__(self, case: Case, fit: Fit) -> None:
        slack = fit.guess.slack if fit.guess else 0.0
        limit = np.maximum(case.tolerance, WITHIN * case.rounding + slack)
        off = np.abs(case.theirs - case.ours)
        right = (off <= limit) & (off <= np.abs(case.theirs - fit.values))
        self.case = replace(case, ours=np.where(right, case.ours, fit.values), tolerance=limit)
        off = np.abs(case.theirs - self.case.ours)
        known = np.isfinite(off)
        self.cells: BoolArray = off > limit
        self.few = _few(self.cells, known)
        kept = off[known & ~self.cells] if self.few else off[known]
        self.residual = float(np.sqrt(np.mean(np.square(kept)))) if kept.size else 0.0


def _few(cells: BoolArray, known: BoolArray) -> bool:
    """Whether cells are single ones, or all but a few of them one row or one column."""
    count = np.count_nonzero(cells)
    row, column = cells.sum(axis=(0, 1)).max(), cells.sum(axis=(0, 2)).max()
    columns = np.count_nonzero(known.any(axis=(0, 2)))
    beside = count - (max(row, column) if columns > SEVERAL else row)
    return bool(count <= max(FEWEST, FEW * np.count_nonzero(known)) or beside <= FEWEST)


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


def _case(book: Workbook, kind: Result, tolerance: float) -> Case:
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
        plan, walk, other, span, times, np.arange(first, first + len(times)), theirs,
        values_of(walk, times), book.times is None, np.full((3, 1, 1), tolerance),
    )  # fmt: skip


def _named(
    shown: _Shown, fits: list[Fit], swaps: list[str], departs: bool, whole: bool
) -> tuple[Mistake | None, str]:
    """The mistake, and a sentence on it."""
    guess = fits[0].guess if fits else None
    if guess is not None:
        return guess.mistake, "; ".join([guess.text, *guess.beside])
    if departs:
        return _without_fit(shown)
    if swaps:
        return "swapped", "; ".join(swaps)
    if _blank(shown.case):
        return "entry", _blank_text()
    return None, _("all numbers agree") if whole else _("all numbers that are there agree")


def _without_fit(shown: _Shown) -> tuple[Mistake, str]:
    """What is off if no prediction fits: all last decimals, single cells, or more than that."""
    off = np.abs(shown.case.theirs - shown.case.ours)
    near = off[np.isfinite(off) & ~shown.cells] <= SIX_DECIMALS
    if shown.few and min(shown.case.decimals) < DECIMALS:
        return "rounding", _rounded(min(shown.case.decimals))
    if shown.few and near.mean() >= RIGHT:
        text = _("{count} of {cells} numbers are off; all others agree")
        _axes, rows, handles = np.nonzero(shown.cells)
        if rows.size > NAMED_CELLS and np.unique(handles).size == 1:
            text = _("{count} of {cells} numbers are off, all of {handle}; all others agree")
        elif rows.size > NAMED_CELLS and np.unique(rows).size == 1:
            text = _("{count} of {cells} numbers are off, all at t = {time} s; all others agree")
        return "cells", text.format(
            count=rows.size,
            cells=np.count_nonzero(np.isfinite(off)),
            handle=handle_names(HANDLES)[handles[0]],
            time=f"{shown.case.times[rows[0]]:g}",
        )
    return "unknown", _("no known mistake explains what is off")


def _blank(case: Case) -> bool:
    """Whether the cells of benches that are not yet in are empty, and no others where there are any."""
    there = np.isfinite(case.theirs).any(axis=(0, 2))
    empty, outside = np.isnan(case.theirs[:, there]), case.outside[there]
    return bool(outside.any() and (empty == outside).all())


def _deviation(case: Case, part: slice, asked: BoolArray) -> Deviation:
    theirs, ours = case.theirs[part], case.ours[part]
    off = np.abs(theirs - ours)
    cells, wanted = int(np.isfinite(off).sum()), int(theirs[:, asked].size)
    empty = int(np.isnan(theirs[:, asked]).sum())
    right = int((off <= case.tolerance[part])[:, asked].sum())
    if not cells:
        return Deviation(0, wanted, empty, right, 0, None, None, None)
    _axis, row, handle = np.unravel_index(np.nanargmax(off), off.shape)
    agreeing = int((off <= SIX_DECIMALS).sum())
    largest = float(np.nanmax(off))
    return Deviation(
        cells, wanted, empty, right, agreeing, largest, int(handle), float(case.times[row])
    )


def _first_departure(case: Case, asked: BoolArray) -> Departure | None:
    """The first cell that is off; else the first that is empty."""
    empty = np.isnan(case.theirs) & asked[:, np.newaxis]
    for wrong in (np.abs(case.theirs - case.ours) > case.tolerance, empty):
        in_order = np.moveaxis(wrong, 0, -1)
        if in_order.any():
            row, handle, axis = np.unravel_index(np.argmax(in_order), in_order.shape)
            theirs, exact = (float(table[axis, row, handle]) for table in (case.theirs, case.ours))
            return Departure(
                float(case.times[row]), int(handle), QUANTITIES[axis], finite_or_none(theirs), exact
            )
    return None


def _empty_cells(case: Case, *found: Deviation) -> list[str]:
    empty, asked = sum(one.empty for one in found), sum(one.asked for one in found)
    text = _("{empty} of the {asked} cells that the contest asks for are empty")
    said = [text.format(empty=empty, asked=asked)] if empty else []
    return said + ([_blank_text()] if _blank(case) else [])


def _blank_text() -> str:
    return _(
        "the cells of benches that are not yet in, outside the first point of the spiral, are empty"
    )


def _share(case: Case) -> str:
    off = np.abs(case.theirs - case.ours)
    text = _("{count} of {cells} numbers are off by more than {tolerance}")
    return text.format(
        count=np.count_nonzero(off > case.tolerance),
        cells=np.count_nonzero(np.isfinite(off)),
        tolerance=float(case.tolerance.max()),
    )


def _left(shown: _Shown, fits: list[Fit]) -> list[str]:
    """Which sheet alone shows a mistake, what others there are, and which cells none explains."""
    said = []
    for n, fit in enumerate(fits):
        assert fit.guess is not None, "what fits was guessed"
        said += [fit.guess.text, *fit.guess.beside] if n else []
        for shows, text in (
            (fit.due[0] and not fit.sheets[0], _("only the speeds show it")),
            (fit.due[1] and not fit.sheets[1], _("only the positions show it")),
        ):
            said += [text] if shows else []
    return said + (_single_cells(shown) if fits or shown.few else [])


def _single_cells(shown: _Shown) -> list[str]:
    """Cells that are off beside what is named: one by one if they are few."""
    case, count = shown.case, np.count_nonzero(shown.cells)
    off = np.where(shown.cells, np.abs(case.theirs - case.ours), 0.0)
    said, names = [], handle_names(HANDLES)
    text = _(
        "beside that, {quantity} of {handle} at t = {time} s is {theirs}, where {expected} is expected"
    )
    most = NAMED_CELLS if shown.few else 0
    for index in np.argsort(-off, axis=None)[: min(most, count)]:
        axis, row, handle = np.unravel_index(index, off.shape)
        said.append(
            text.format(
                quantity=quantity_text(QUANTITIES[axis]),
                handle=names[handle],
                time=f"{case.times[row]:.9g}",
                theirs=f"{case.theirs[axis, row, handle]:.9g}",
                expected=decimals(float(case.ours[axis, row, handle])),
            )
        )
    if count > len(said):
        text = _("beside that, {count} numbers are off by up to {largest} m or m/s")
        rest = np.sort(off, axis=None)[::-1][len(said)]
        said.append(text.format(count=count - len(said), largest=f"{rest:.1e}"))
    return said


def points(score: float) -> str:
    """A score of 0 to 1 as points of 100, rounded down: 100 are for what is wholly right."""
    return f"{math.floor(1000.0 * score) / 10.0:g}"


def quantity_text(quantity: Quantity) -> str:
    """The name of a quantity."""
    return {"x": "x", "y": "y", "speed": _("speed")}[quantity]


def _how_computed(case: Case, fits: list[Fit]) -> list[str]:
    """What numbers tell of how they were computed: links, errors that add up, decimals."""
    explained = any(fit.sheets[0] for fit in fits)
    links = None if explained else links_of(case)
    said = [links_text(links)] if links else []
    said += [] if explained else _growth(case)
    return [*said, *([_rounded(min(case.decimals))] if min(case.decimals) < DECIMALS else [])]


def _rounded(count: int) -> str:
    text = _("the numbers are rounded to {count} decimals; the contest asks for 6")
    return text.format(count=count)


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
