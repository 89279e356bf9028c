"""What a workbook holds for benches that have not yet come to where the spiral begins."""

from collections.abc import Iterator

import numpy as np

from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.number_format import decimals
from benchdragon.paper.cases import (
    SHEETS,
    BoolArray,
    Case,
    ComplexArray,
    Guess,
    complex_of,
    values_of,
    with_points,
)

# Share of such cells with one number from which it is taken as the sign of benches outside.
MOSTLY = 0.8


def entry(case: Case) -> Iterator[Guess]:
    """Benches that are not yet in: a number in place of theirs, or a line on which they wait."""
    outside = case.outside & np.isfinite(case.theirs).all(axis=0)
    if not outside.any():
        return
    yield from _filled(case, outside)
    yield from _lines(case)


def _filled(case: Case, outside: BoolArray) -> Iterator[Guess]:
    """The same number in all cells of such benches: of positions, of speeds, or of both."""
    fill = np.median(case.theirs[:, outside], axis=1)
    held = np.abs(case.theirs[:, outside] - fill[:, None]) <= case.rounding[:, :, 0]
    count = np.count_nonzero(held, axis=1)
    values, said, cells = np.array(case.ours), [], 0
    texts = (
        _(
            "the positions of benches that are not yet in, outside the first point of the spiral, are "
            "({x}, {y}): {count} cells"
        ),
        _(
            "the speeds of benches that are not yet in, outside the first point of the spiral, are "
            "{speed}: {count} cells"
        ),
    )
    for sheet, text in zip(SHEETS, texts, strict=True):
        if count[sheet].min() >= MOSTLY * held.shape[1]:
            values[sheet, case.outside] = fill[sheet, None]
            number, cells = int(count[sheet].sum()), cells + int(count[sheet].sum())
            x, y, speed = (decimals(number) for number in fill)
            said.append(text.format(x=x, y=y, speed=speed, count=number))
    if len(said) == len(texts) and not fill.any():
        text = _(
            "the cells of benches that are not yet in, outside the first point of the spiral, are 0: "
            "{count} cells"
        )
        said = [text.format(count=cells)]
    if said:
        yield Guess("entry", values, "; ".join(said), float(cells), "cells")


def _lines(case: Case) -> Iterator[Guess]:
    """Benches that wait, joined by their links, on a straight line through the spiral's first point."""
    start = complex_of(case.walk.route.point(np.zeros(1))[0])
    tangent = -np.exp(1j * case.walk.route.heading(np.zeros(1))[0])
    text = _("benches that are not yet in wait on the line {line}")
    across, along = (
        text.format(line=f"x = {start.real:.4g}"),
        text.format(line=f"y = {start.imag:z.4g}"),
    )
    touching = _("benches that are not yet in wait on the tangent of the spiral at its first point")
    for ahead, said in ((1j, across), (-1j, across), (1.0, along), (complex(tangent), touching)):
        points, speed = _waiting(case, complex(start), ahead)
        yield Guess("entry", with_points(points, speed), said)


def _waiting(case: Case, start: complex, ahead: complex) -> tuple[ComplexArray, FloatArray]:
    """Where handles are and how fast, if those outside stand on a line from `start` on."""
    values = values_of(case.walk, case.times)
    points, speed = complex_of(values), values[2]
    velocity = speed * np.exp(1j * case.headings)
    for i, link in enumerate(case.walk.dragon.links, start=1):
        here = (points[:, i - 1] - start) / ahead
        along = here.real + np.sqrt(np.maximum(link**2 - here.imag**2, 0.0))
        waits = case.outside[:, i]
        points[:, i] = np.where(waits, start + ahead * along, points[:, i])
        bench = points[:, i - 1] - points[:, i]
        slant = np.where(waits, (-ahead / bench).real, 1.0)
        slant[slant == 0.0] = np.inf  # across the line nothing pulls
        pulled = (velocity[:, i - 1] / bench).real / slant
        velocity[:, i] = np.where(waits, -ahead * pulled, velocity[:, i])
        speed[:, i] = np.abs(velocity[:, i])
    return points, speed
