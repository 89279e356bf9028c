"""How much nearer benches may come while their handles go from one place to the next.

A handle goes along the route, so in directions that the route has on its way: towards a neighbouring
coil, which it passes alongside, it goes by little. So do the corners, which its two handles carry.
"""

import numpy as np
import numpy.typing as npt

from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.apart import Sizes
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.motion import SLACK

IntArray = npt.NDArray[np.int64]


def approach(
    ends: tuple[Chain, Chain], sizes: Sizes, i: IntArray, lines: tuple[FloatArray, FloatArray],
    way: FloatArray,
) -> FloatArray:  # fmt: skip
    """By how much benches go along lines, m, at most: on from one chain, and back from the other.

    Of N benches looked at, `i` are their numbers, (N,), `lines` unit vectors at both ends, (N, 2) each,
    and `way` how far each handle goes, m, (handles,). At any place between, what a bench has come along
    the first line since the first chain, and what it has to go back along the second line to the other,
    is no more than this.
    """
    a, b = ends
    turned = b.turned - a.turned + SLACK
    on = _Slopes(a, sizes, i, lines[0], way, turned)
    back = _Slopes(b, sizes, i, -lines[1], way, turned)
    carried = np.maximum(on.front, back.front) * way[i] + np.maximum(on.rear, back.rear) * way[i + 1]
    total: FloatArray = carried + on.swing + back.swing
    return total


class _Slopes:
    """How benches go along lines from a chain on, per metre of their handles' ways.

    Attributes:
        front: m per metre of the front handle's way, that corner which goes farthest, (N,).
        rear: the same of the rear handle's.
        swing: what corners beside the middle line go for the bench turning, m, (N,).
    """

    def __init__(
        self, chain: Chain, sizes: Sizes, i: IntArray, line: FloatArray, way: FloatArray,
        turned: FloatArray,
    ) -> None:  # fmt: skip
        links, front, rear, width = (values[i] for values in sizes.numbers)
        ahead = np.stack([chain.x[i] - chain.x[i + 1], chain.y[i] - chain.y[i + 1]], 1) / links[:, None]
        towards, off = _along(chain.tangent[i], turned[i], line)
        self.front = np.maximum((1.0 + front / links) * towards, rear / links * off)
        towards, off = _along(chain.tangent[i + 1], turned[i + 1], line)
        self.rear = np.maximum((1.0 + rear / links) * towards, front / links * off)
        across = sum(_across(chain.tangent[k], turned[k], ahead) * way[k] for k in (i, i + 1))
        turn = np.arcsin(np.minimum(across / links, 1.0))
        along = np.abs((ahead * line).sum(1))
        self.swing = 0.5 * width * turn * (along + 0.5 * turn)


def _along(tangent: FloatArray, turned: FloatArray, line: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The most that a metre of way leads along a line, and against it, while tangents turn."""
    dot = (tangent * line).sum(1)
    cross = np.abs(tangent[:, 0] * line[:, 1] - tangent[:, 1] * line[:, 0])
    cosine, sine = np.cos(turned), np.sin(turned)
    towards, off = (
        np.where(value >= cosine, 1.0, np.maximum(value * cosine + cross * sine, 0.0))
        for value in (dot, -dot)
    )
    return towards, off


def _across(tangent: FloatArray, turned: FloatArray, ahead: FloatArray) -> FloatArray:
    """The most that a metre of way leads across a bench, either way, while tangents turn so far."""
    dot = np.abs((tangent * ahead).sum(1))
    cross = np.abs(tangent[:, 0] * ahead[:, 1] - tangent[:, 1] * ahead[:, 0])
    cosine, sine = np.cos(turned), np.sin(turned)
    found: FloatArray = np.where(dot <= sine, 1.0, cross * cosine + dot * sine)
    return found
