"""QR codes that open the player at one's own bench, as rectangles on a PDF page."""

from itertools import groupby

import segno
from fpdf import FPDF

# Cells that must stay white around a code.
QUIET = 4


def bench_address(address: str, bench: int) -> str:
    """Where the player opens at a bench (number, from 1)."""
    return f"{address}{'&' if '#' in address else '#'}bench={bench}"


def draw_qr(pdf: FPDF, text: str, x: float, y: float, side: float) -> None:
    """Draw a code with its white edge into a square of a page, mm."""
    rows = segno.make_qr(text, error="m").matrix
    cell = side / (len(rows) + 2 * QUIET)
    pdf.set_fill_color(0)
    for i, row in enumerate(rows):
        j = 0
        for dark, some in groupby(row):
            length = len(list(some))
            if dark:
                pdf.rect(x + cell * (QUIET + j), y + cell * (QUIET + i), cell * length, cell, style="F")
            j += length
