"""From hole to hole: a bench's length less its insets, rounded once."""

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel


@kernel
def difference(a: float, b: float) -> tuple[float, float]:
    """a - b, and what its rounding left out, exactly (Knuth's TwoSum)."""
    whole = a - b
    taken = a - whole
    kept = whole + taken
    return whole, (taken - b) + (a - kept)


@kernel
def link_length(length: float, front: float, rear: float) -> float:
    """A bench's link, m: its length less both insets, to the nearest double except in ties.

    Rounded at each of the two steps, a hundred thousand links would add up to 2e-11 m too much.
    """
    whole, lost = difference(length, front)
    link, more = difference(whole, rear)
    return link + (lost + more)


@kernel
def link_of(sizes: FloatArray, n: int) -> float:
    """The link, m, of the sizes in column n: rows length, width, front inset and rear inset."""
    return link_length(sizes[0, n], sizes[2, n], sizes[3, n])


@entry
def links_of(sizes: Table, out: Vector) -> None:
    """Fill out with the link of each bench, m; `sizes` is (4, benches)."""
    for n in range(out.shape[0]):
        out[n] = link_of(sizes, n)
