"""Cells next to one another, found by trying: from where the head starts to as far as can be shown.

How they are found proves nothing: each has been shown to hold, and can be shown again (`covered`).
"""

from collections.abc import Callable, Sequence
from functools import partial

from flint import arb

from benchdragon import budget
from benchdragon.kernels.curve import FloatArray
from benchdragon.progress import Progress, silent
from benchdragon.proofs import MOST_CELLS
from benchdragon.proofs.cells import Dance, holds
from benchdragon.proofs.chain import Chain, UnprovedError, enclosed_chain

# Where computed handles stand, the head at a route position: rows and parameters.
Guess = Callable[[float], tuple[Sequence[int], FloatArray]]

# A handle in balls takes as long as so many in doubles.
BALLS = 50.0
# The first cell, m; how the next differs from one that held, or did not; and what is given up at,
# relative to the coordinate.
FIRST, LONGER, SHORTER, SHORTEST = 0.05, 1.1, 0.5, 4e-16


def chain_at(dance: Dance, guess: Guess, s: float, benches: int | None = None) -> Chain:
    """The dragon, or so many benches of it, with its head at route position s, m.

    Raises:
        UnprovedError: if it could not be enclosed.
    """
    links = dance.sizes.links[:benches]
    budget.spend(BALLS * (len(links) + 1))
    rows, at = guess(s)
    near = rows[: len(links) + 1], at[: len(links) + 1]
    return enclosed_chain(dance.route, links, arb(s), near, dance.origin)


def cells(
    dance: Dance, guess: Guess, start: float, end: float, progress: Progress = silent
) -> list[float]:
    """Route positions, m, ascending from `start`, between each two of which a cell holds.

    The last is `end`, or as far as could be shown.
    """
    at, step = [start], FIRST
    try:
        a = chain_at(dance, guess, start)
    except UnprovedError:
        return at
    while at[-1] < end and len(at) < MOST_CELLS:
        s = min(at[-1] + step, end)
        if step <= SHORTEST * max(1.0, abs(end)):
            break
        b = _tried(dance, guess, a, s)
        if b is None:
            step = SHORTER * (s - at[-1])
            continue
        a, step = b, LONGER * step
        at.append(s)
        progress((s - start) / (end - start), "")
    return at


def _tried(dance: Dance, guess: Guess, a: Chain, s: float) -> Chain | None:
    try:
        b = chain_at(dance, guess, s)
    except UnprovedError:
        return None
    return b if holds(dance, a, b, between=partial(chain_at, dance, guess)) else None


def covered(dance: Dance, guess: Guess, at: Sequence[float], progress: Progress = silent) -> None:
    """Show that all cells between these route positions hold; of one position, that it does.

    Raises:
        UnprovedError: naming the first that does not.
    """
    a = chain_at(dance, guess, at[0])
    if len(at) == 1 and not holds(dance, a, a):
        raise UnprovedError(f"nothing is shown at {at[0]!r} m")
    for n, s in enumerate(at[1:], start=1):
        if not s > at[n - 1]:
            raise UnprovedError(f"cell {n} does not go on: from {at[n - 1]!r} to {s!r} m")
        b = chain_at(dance, guess, s)
        if not holds(dance, a, b, between=partial(chain_at, dance, guess)):
            raise UnprovedError(f"cell {n}, from {at[n - 1]!r} to {s!r} m, does not hold")
        a = b
        progress(n / (len(at) - 1), "")
