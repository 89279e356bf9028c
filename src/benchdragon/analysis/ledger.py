"""What an answer rests on, taken down for a proof to look over."""

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.search import LOG_START, LOGGED
from benchdragon.model.placement import Placement


class Ledger:
    """All chains that an answer rests on, as computed, for a proof to look over (see `proof`).

    Attributes:
        evaluations: (head positions, row, u, x, y) of chains of the search, the last four (T, handles).
        benches: (link, the same) of single benches, whose front handle is at the position.
        grid: the same of whole dragons, whose places need to be known to EDGE only.
        cells: (link, (front positions, row, u, x, y)) of single benches at the borders of cells,
            needed to EDGE likewise.
    """

    def __init__(self) -> None:
        self.evaluations: list[tuple[FloatArray, ...]] = []
        self.benches: list[tuple[float, tuple[FloatArray, ...]]] = []
        self.grid: list[tuple[FloatArray, ...]] = []
        self.cells: list[tuple[float, tuple[FloatArray, ...]]] = []

    def add_evaluations(self, log: FloatArray) -> None:
        """Take down chains that distances are taken from, from a log of `search.log_chain`."""
        self.evaluations += _chains(log)

    def add_benches(self, link: float, log: FloatArray) -> None:
        """Take down single benches that distances are taken from, from such a log."""
        self.benches += [(link, chains) for chains in _chains(log)]

    def add_grid(self, log: FloatArray) -> None:
        """Take down whole dragons, which need to be known to EDGE only, from such a log."""
        self.grid += _chains(log)

    def add_cells(self, log: FloatArray) -> None:
        """Take down single benches, (T, LOG_COLUMNS) of kernels/cells.py."""
        for link in np.unique(log[:, 0]):
            these = log[log[:, 0] == link]
            chains = np.moveaxis(these[:, 2:].reshape(len(these), 2, LOGGED), 2, 0)
            self.cells.append((float(link), (these[:, 1].copy(), *chains.copy())))

    def add_placement(self, placed: Placement) -> None:
        """Take down the first chain of a placement that distances were taken from."""
        row, u = placed.state(0)
        chain = (row.astype(np.float64), u, placed.x[0], placed.y[0])
        self.evaluations.append((placed.head_s[:1], *(table[np.newaxis] for table in chain)))


def _chains(log: FloatArray) -> list[tuple[FloatArray, ...]]:
    """The chains of a log, those of as many handles together."""
    found = []
    for handles in np.unique(log[:, 1]).astype(int).tolist():
        these = log[log[:, 1] == handles]
        numbers = these[:, LOG_START : LOG_START + LOGGED * handles].reshape(-1, handles, LOGGED)
        found.append((these[:, 0].copy(), *np.moveaxis(numbers, 2, 0).copy()))
    return found
