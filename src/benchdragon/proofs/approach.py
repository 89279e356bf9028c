"""How much nearer benches may come while their handles go from one place to the next.

A handle goes along the route, so in directions that the route has on its way: towards a neighbouring
coil, which it passes alongside, it moves little. So do the corners, which its two handles carry.
"""

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.boxes import Boxes, IntArray
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.motion import SLACK
from benchdragon.proofs.sizes import Sizes

# On from the first chain, back from the next.
SIGNS = np.array([[1.0], [-1.0]])


class Approach:
    """By how much benches go along lines, at most: on from one chain, and back from the next.

    Args:
        ends: both chains.
        boxes: their benches, (2, N).
        sizes: of the benches.
        way: how far each handle goes, m, (handles,).
    """

    def __init__(self, ends: tuple[Chain, Chain], boxes: Boxes, sizes: Sizes, way: FloatArray) -> None:
        links, front, rear, width = sizes.numbers
        turned = ends[1].turned - ends[0].turned + SLACK
        self._way, self._front, self._rear = way, front / links, rear / links
        self._cosine, self._sine = np.cos(turned), np.sin(turned)
        self._x, self._y = (np.stack([chain.tangent[:, n] for chain in ends]) for n in (0, 1))
        self._boxes = boxes
        across = sum(self._across(k) * way[k] for k in (slice(None, -1), slice(1, None)))
        self._turn = np.arcsin(np.minimum(across / links, 1.0))
        self._swing = 0.5 * width * self._turn

    def along(self, i: IntArray, x: FloatArray, y: FloatArray) -> FloatArray:
        """Of benches `i`, (n,), along unit vectors at the first chain and at the next, (..., 2, n).

        At any place between, what a bench has come along the first since the first chain, and what it
        has to go back along the second to the other, is no more than this, m, (..., n).
        """
        x, y = x * SIGNS, y * SIGNS
        front, rear = self._front[i], self._rear[i]
        towards, off = self._towards(i, x, y)
        ahead = np.maximum((1.0 + front) * towards, rear * off)  # a metre of the front handle's way
        towards, off = self._towards(i + 1, x, y)
        behind = np.maximum((1.0 + rear) * towards, front * off)
        along = np.abs(self._boxes.ahead_x[:, i] * x + self._boxes.ahead_y[:, i] * y)
        swing = self._swing[:, i] * (along + 0.5 * self._turn[:, i])  # beside the middle line
        way = ahead.max(-2) * self._way[i] + behind.max(-2) * self._way[i + 1]
        total: FloatArray = way + swing.sum(-2)
        return total

    def _towards(self, k: IntArray, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The most that a metre of way leads along lines, and against them, while tangents turn."""
        tangent_x, tangent_y, cosine = self._x[:, k], self._y[:, k], self._cosine[k]
        dot = tangent_x * x + tangent_y * y
        cross = np.abs(tangent_x * y - tangent_y * x) * self._sine[k]
        towards = np.where(dot >= cosine, 1.0, np.maximum(dot * cosine + cross, 0.0))
        off = np.where(-dot >= cosine, 1.0, np.maximum(cross - dot * cosine, 0.0))
        return towards, off

    def _across(self, k: slice) -> FloatArray:
        """The most that a metre of way leads across a bench, either way, while tangents turn so far."""
        x, y, sine = self._x[:, k], self._y[:, k], self._sine[k]
        dot = np.abs(x * self._boxes.ahead_x + y * self._boxes.ahead_y)
        cross = np.abs(x * self._boxes.ahead_y - y * self._boxes.ahead_x)
        found: FloatArray = np.where(dot <= sine, 1.0, cross * self._cosine[k] + dot * sine)
        return found
