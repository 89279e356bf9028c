"""How much nearer benches may come while their handles go from one place to the next.

A handle goes along the route, so in directions that the route has on its way: towards a neighbouring
coil, which it passes alongside, it moves little. So do the corners, which its two handles carry.
"""

import numpy as np
import numpy.typing as npt

from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.apart import Sizes
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.motion import SLACK

IntArray = npt.NDArray[np.int64]


class Approach:
    """By how much benches go along lines, at most: on from one chain, and back from the next.

    Args:
        ends: both chains.
        sizes: of the benches.
        way: how far each handle goes, m, (handles,).
    """

    def __init__(self, ends: tuple[Chain, Chain], sizes: Sizes, way: FloatArray) -> None:
        turned = ends[1].turned - ends[0].turned + SLACK
        self._way = way
        self._on, self._back = (_Slopes(chain, sizes, way, turned) for chain in ends)

    def along(self, i: IntArray, on: FloatArray, back: FloatArray) -> FloatArray:
        """Of benches `i`, (N,), along unit vectors at the first chain and at the next, (N, 2) each.

        At any place between, what a bench has come along the first line since the first chain, and what
        it has to go back along the second to the other, is no more than this, m, (N,).
        """
        on_front, on_rear, on_swing = self._on.along(i, on)
        back_front, back_rear, back_swing = self._back.along(i, -back)
        front, rear = np.maximum(on_front, back_front), np.maximum(on_rear, back_rear)
        total: FloatArray = front * self._way[i] + rear * self._way[i + 1] + on_swing + back_swing
        return total


class _Slopes:
    """How benches go along lines from a chain on, per metre of their handles' ways."""

    def __init__(self, chain: Chain, sizes: Sizes, way: FloatArray, turned: FloatArray) -> None:
        links, front, rear, width = sizes.numbers
        self._tangent, self._cosine, self._sine = chain.tangent, np.cos(turned), np.sin(turned)
        self._levers = front / links, rear / links
        handles = np.stack([chain.x, chain.y], 1)
        self._ahead = (handles[:-1] - handles[1:]) / links[:, None]
        across = [self._across(k) * way[k] for k in (slice(None, -1), slice(1, None))]
        self._turn = np.arcsin(np.minimum(sum(across) / links, 1.0))
        self._swing = 0.5 * width * self._turn

    def along(self, i: IntArray, line: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Per metre of the front handle's way, and of the rear's, that corner which goes farthest.

        Third, m, what corners beside the middle line go for the bench turning; all of shape (N,).
        """
        front, rear = (lever[i] for lever in self._levers)
        towards, off = self._towards(i, line)
        by_front = np.maximum((1.0 + front) * towards, rear * off)
        towards, off = self._towards(i + 1, line)
        by_rear = np.maximum((1.0 + rear) * towards, front * off)
        along = np.abs((self._ahead[i] * line).sum(1))
        return by_front, by_rear, self._swing[i] * (along + 0.5 * self._turn[i])

    def _towards(self, k: IntArray, line: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The most that a metre of way leads along a line, and against it, while tangents turn."""
        tangent, cosine, sine = self._tangent[k], self._cosine[k], self._sine[k]
        dot = (tangent * line).sum(1)
        cross = np.abs(tangent[:, 0] * line[:, 1] - tangent[:, 1] * line[:, 0]) * sine
        towards, off = (
            np.where(value >= cosine, 1.0, np.maximum(value * cosine + cross, 0.0))
            for value in (dot, -dot)
        )
        return towards, off

    def _across(self, k: slice) -> FloatArray:
        """The most that a metre of way leads across a bench, either way, while tangents turn so far."""
        tangent, cosine, sine = self._tangent[k], self._cosine[k], self._sine[k]
        dot = np.abs((tangent * self._ahead).sum(1))
        cross = np.abs(tangent[:, 0] * self._ahead[:, 1] - tangent[:, 1] * self._ahead[:, 0])
        found: FloatArray = np.where(dot <= sine, 1.0, cross * cosine + dot * sine)
        return found
