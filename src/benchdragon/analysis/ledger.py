"""What an answer rests on, taken down for a proof to look over."""

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.search import LOGGED
from benchdragon.kernels.status import Status
from benchdragon.kernels.step_bounds import Placements
from benchdragon.model.placement import Placement


class Ledger:
    """All chains that an answer rests on, as computed, for a proof to look over (see `proof`).

    Attributes:
        evaluations: (head positions, row, u, x, y) of chains of the search, the last four (T, handles).
        grid: the same of whole dragons, whose places need to be known to EDGE only.
        cells: (link, (front positions, row, u, x, y)) of single benches at the borders of cells,
            needed to EDGE likewise.
    """

    def __init__(self) -> None:
        self.evaluations: list[tuple[FloatArray, ...]] = []
        self.grid: list[tuple[FloatArray, ...]] = []
        self.cells: list[tuple[float, tuple[FloatArray, ...]]] = []

    def add_grid(self, placed: Placement) -> None:
        """Take down whole dragons, which need to be known to EDGE only."""
        chains = (table.T.astype(np.float64) for table in placed.tables)
        self.grid.append((placed.head_s, *chains))

    def add_log(self, log: FloatArray, handles: int) -> None:
        """Take down chains from the log of a search."""
        table = log[:, 1:].reshape(len(log), -1, LOGGED)[:, :handles]
        self.evaluations.append((log[:, 0].copy(), *(table[:, :, n].copy() for n in range(LOGGED))))

    def add_cells(self, link: float, at: FloatArray, places: Placements) -> None:
        """Take down a bench with its front handle at these positions, m, where it stands."""
        stood = places.failed[0] == Status.OK
        tables = (places.row, places.u, places.x, places.y)
        chains = (at[stood], *(table[:, stood].T.astype(np.float64) for table in tables))
        self.cells.append((link, chains))

    def add_placement(self, placed: Placement) -> None:
        """Take down the first chain of a placement that distances were taken from."""
        row, u = placed.state(0)
        chain = (row.astype(np.float64), u, placed.x[0], placed.y[0])
        self.evaluations.append((placed.head_s[:1], *(table[np.newaxis] for table in chain)))
