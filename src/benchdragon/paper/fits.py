"""Which known mistake explains what is off in a workbook, whatever single cells hold."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.paper.cases import SHEETS, WITHIN, Case, Guess
from benchdragon.paper.mistakes import (
    AXES,
    BASES,
    HYPOTHESES,
    SPEEDS_ALONE,
    TRANSFORMS,
    Hypothesis,
    together,
    turned_time,
)

# A prediction explains a cell that it brings so much nearer, or as near as rounding leaves it; it is a
# mistake of a sheet if it explains so many of the cells that are off or should be.
NEARER, EXPLAINED = 0.05, 0.8
# Residual of positions, a logarithm, if their cells are right except for rounding and a few.
SETTLED = 1.0
# Positions of which so small a share is off show slips, and so many cells are single ones.
SLIPS, SINGLE = 0.01, 3
# Another prediction is better if it leaves this share of what the one before leaves.
CLEARLY = 0.97


@dataclass(frozen=True, eq=False)
class Fit:
    """The guess that fits best.

    Attributes:
        guess: None if none fits.
        values: what it predicts; the exact values in a sheet that does not show it.
        sheets: whether it is what positions, and speeds, show; due: whether they should.
        left: how much is left, as logarithms, so that a cell counts little however far off it is.
    """

    guess: Guess | None
    values: FloatArray
    sheets: tuple[bool, bool]
    due: tuple[bool, bool]
    left: float


def best_fit(case: Case) -> Fit:
    """The known mistake that a workbook shows, if it shows one."""
    off = np.abs(case.theirs - case.ours)[:2] > case.tolerance[:2]
    slips = np.count_nonzero(off) <= SLIPS * off.size
    kinds = SPEEDS_ALONE if slips else HYPOTHESES
    best = _best(case, exact_fit(case), (guess for kind in kinds for guess in kind(case)))
    left = _losses(case, best.values)[:2]
    if slips or (best.sheets[0] and np.nanmean(left) < SETTLED):
        return best
    return _best(case, best, _pairs(case))


def exact_fit(case: Case) -> Fit:
    """What is left without any mistake."""
    left = float(np.nansum(_losses(case, case.ours)))
    return Fit(None, case.ours, (False, False), (False, False), left)


def _best(case: Case, best: Fit, guesses: Iterator[Guess]) -> Fit:
    """The clearly best of guesses, or the first that explains all but single cells."""
    for guess in guesses:
        tried = _fit(case, guess)
        if any(tried.sheets) and tried.left < CLEARLY * best.left:
            best = tried
            limit = np.maximum(case.tolerance, WITHIN * case.rounding)
            if np.count_nonzero(np.abs(case.theirs - best.values) > limit) <= SINGLE:
                break
    return best


def _pairs(case: Case) -> Iterator[Guess]:
    """Axes or units that are others, on top of another mistake."""
    for base in (guess for hypothesis in BASES for guess in hypothesis(case)):
        yield from _on_top(case, base, TRANSFORMS)
    for rough in turned_time(case):
        for first in _on_top(case, rough, AXES):
            moved = together(case, first, rough)
            yield from _on_top(case, moved, AXES[:1] if first.mistake == "rotated" else AXES[1:])


def _on_top(case: Case, base: Guess, transforms: tuple[Hypothesis, ...]) -> Iterator[Guess]:
    values = np.where(np.isnan(base.values), case.ours, base.values)
    for transform in transforms:
        for guess in transform(replace(case, ours=values)):
            yield replace(guess, beside=(base.text,))


def _losses(case: Case, values: FloatArray) -> FloatArray:
    return np.asarray(np.log1p(np.square((case.theirs - values) / (WITHIN * case.rounding))))


def _fit(case: Case, guess: Guess) -> Fit:
    """What a prediction leaves; only in sheets that show it is it taken."""
    values = np.where(np.isnan(guess.values), case.ours, guess.values)
    off, before = np.abs(case.theirs - values), np.abs(case.theirs - case.ours)
    due = (before > case.tolerance) | (np.isfinite(off) & (np.abs(values - case.ours) > case.tolerance))
    near = off <= np.maximum(NEARER * before, WITHIN * case.rounding + guess.slack)
    wanted, shown = [bool(due[s].any()) for s in SHEETS], []
    for n, sheet in enumerate(SHEETS):
        explained = np.count_nonzero(near[sheet] & due[sheet])
        shown.append(wanted[n] and explained >= EXPLAINED * np.count_nonzero(due[sheet]))
        if not shown[n]:
            values[sheet] = case.ours[sheet]
    left = float(np.nansum(_losses(case, values)))
    return Fit(guess, values, (bool(shown[0]), bool(shown[1])), (wanted[0], wanted[1]), left)
