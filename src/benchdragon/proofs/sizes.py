"""The sizes of benches, as balls and as doubles."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb

from benchdragon.kernels.curve import FloatArray


@dataclass(frozen=True)
class Sizes:
    """Of N benches: from handle to handle, handle to end, and width, m, as balls and as doubles.

    Attributes:
        links: N balls, as the next three.
        front: from a front handle to the bench's front end.
        rear: from a rear handle to its rear end.
        width: of each.
        numbers: the same as doubles, (4, N).
    """

    links: Sequence[arb]
    front: Sequence[arb]
    rear: Sequence[arb]
    width: Sequence[arb]
    numbers: FloatArray

    @classmethod
    def of(
        cls, length: Sequence[arb], width: Sequence[arb], front: Sequence[arb], rear: Sequence[arb]
    ) -> "Sizes":
        """Benches of such lengths, widths, and distances from their ends to their holes, m."""
        links = [a - b - c for a, b, c in zip(length, front, rear, strict=True)]
        columns = (links, front, rear, width)
        numbers = np.array([[float(value) for value in column] for column in columns])
        return cls(links, front, rear, width, numbers)

    def first(self, benches: int) -> "Sizes":
        """Those of so many benches from the head on."""
        links, front = self.links[:benches], self.front[:benches]
        rear, width = self.rear[:benches], self.width[:benches]
        return Sizes(links, front, rear, width, self.numbers[:, :benches])
