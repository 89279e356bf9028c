"""The dragon with its head at route positions: where every handle is, with no time in it."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from functools import cached_property
from typing import Any, Self, TypeVar

import numpy as np
import numpy.typing as npt

from benchdragon import budget
from benchdragon.errors import WalkError, of_kind
from benchdragon.hosts.serving import serving
from benchdragon.kernels.chain import Placements, march, rates
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray, positions
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.status import Status
from benchdragon.model.arrays import as_numbers
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon

# Bytes of a handle at one position of the head.
PLACE = 40
# Of the tables of places, what marching leaves out.
NO_TANGENTS = np.empty((0, 0))
Table = TypeVar("Table", bound=npt.NDArray[Any])
# One row, some, or all of them, as NumPy takes them.
Rows = int | slice | npt.ArrayLike


class Placement:
    """A dragon on its route with the head at T route positions; every table has one row a position.

    A placement that fails holds its status, and NaN from the handle that found no place on. As a
    sequence it holds T placements of one position each; a slice of it is another. Tables are read-only.

    Args:
        dragon: the benches.
        route: what every handle stays on.
        head_s: route positions of the head's handle, m, (T,).
        workers: threads; the numbers do not depend on it.

    Attributes:
        dragon: as given.
        route: as given.
        head_s: as given, (T,).
        status: how each placement ended, a `Status`, (T,).
        failed_bench: the bench that found no place, (T,); 0 where none, or the head, failed.

    Examples:
        >>> walk = bd.read_plan("spiral-in").build()
        >>> placed = bd.Placement(walk.dragon, walk.route, [0.0, 10.0])
        >>> placed.speed_ratio.shape, placed.chord_error < 1e-12
        ((2, 224), True)
    """

    def __init__(
        self, dragon: Dragon, route: Route, head_s: npt.ArrayLike, *, workers: int = 1
    ) -> None:
        of_kind("dragon", dragon, Dragon)
        of_kind("route", route, Route)
        self.dragon, self.route = dragon, route
        self.head_s = np.atleast_1d(as_numbers("head_s", head_s))
        shape = (len(dragon) + 1, self.head_s.size)
        budget.spend(shape[0] * shape[1])
        budget.hold(PLACE * shape[0] * shape[1])
        # Handle by handle in memory, as the kernels march; position by position to the outside.
        self._row = np.empty(shape, dtype=np.int64)
        self._failed = np.empty((2, shape[1]), dtype=np.int64)
        self._u, self._x, self._y, self._ratio = (np.empty(shape) for _array in range(4))
        self.status, self.failed_bench = map(frozen, self._failed)
        if workers == 1 or shape[1] <= LANES:
            self._march(0, shape[1])
            return
        # The borders of the blocks do not depend on the number of workers.
        share = -(-shape[1] // (workers * LANES)) * LANES
        march = self._march if serving().shares else self._march_apart
        with ThreadPoolExecutor(workers) as pool:
            for task in [
                pool.submit(march, a, min(a + share, shape[1])) for a in range(0, shape[1], share)
            ]:
                task.result()

    def _march(self, first: int, last: int) -> None:
        tables = self._row, self._u, self._x, self._y, self._ratio
        out = Placements(*tables, NO_TANGENTS, NO_TANGENTS, self._failed)
        march(self.route.rows, self.dragon.links, self.head_s, first, last, out)

    def _march_apart(self, first: int, last: int) -> None:
        """The same on arrays of its own, for an engine that copies the whole of what it is given."""
        part = Placement(self.dragon, self.route, self.head_s[first:last])
        for table, own in (*zip(self.tables, part.tables, strict=True), (self._ratio, part._ratio)):
            table[:, first:last] = own
        self._failed[:, first:last] = part._failed

    def __repr__(self) -> str:
        handles, count = self._x.shape
        return f"<Placement of {handles} handles at {count} positions of the head>"

    def __len__(self) -> int:
        """Number of positions, T."""
        return self.head_s.size

    def __getitem__(self, rows: Rows) -> Self:
        """The same at some of its positions: by number, from 0, by slice, by a list or a mask."""
        chosen, part = np.atleast_1d(np.arange(len(self))[chosen_by(rows)]), copy(self)
        for name in _cached(type(self)) & vars(part).keys():
            del vars(part)[name]
        part.head_s, part._failed = self.head_s[chosen], self._failed[:, chosen]
        part.status, part.failed_bench = map(frozen, part._failed)
        for name in ("_row", "_u", "_x", "_y", "_ratio"):
            setattr(part, name, np.ascontiguousarray(getattr(self, name)[:, chosen]))
        return part

    def __iter__(self) -> Iterator[Self]:
        """The positions, one at a time."""
        return (self[n] for n in range(len(self)))

    @property
    def x(self) -> FloatArray:
        """x of every handle, m, (T, N + 1)."""
        return frozen(self._x.T)

    @property
    def y(self) -> FloatArray:
        """y of every handle, m, (T, N + 1)."""
        return frozen(self._y.T)

    @property
    def speed_ratio(self) -> FloatArray:
        """Speed of every handle over the head's, (T, N + 1): exact, from the rigid benches."""
        return frozen(self._ratio.T)

    @cached_property
    def s(self) -> FloatArray:
        """Route position of every handle, m, (T, N + 1); negative on the extension."""
        out = np.full(self._u.shape, np.nan)
        sound = ~np.isnan(self._u)
        found = np.empty(int(sound.sum()))
        positions(self.route.rows, self._row[sound], self._u[sound], found)
        out[sound] = found
        return frozen(out.T)

    @property
    def tables(self) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
        """Row, parameter, x and y of every handle, as kernels hold them, each (N + 1, T)."""
        return self._row, self._u, self._x, self._y

    def state(self, i: int) -> tuple[IntArray, FloatArray]:
        """Row and parameter of every handle at position number i, as kernels hold them, (N + 1,)."""
        return self._row[:, i], self._u[:, i]

    @cached_property
    def heading(self) -> FloatArray:
        """Heading of every bench, rear handle to front handle, rad, (T, N), in -pi..pi."""
        return frozen(np.arctan2(-np.diff(self._y, axis=0), -np.diff(self._x, axis=0)).T)

    def corners(self) -> FloatArray:
        """Corners of every bench, m, (T, N, 4, 2): front left first, going round counter-clockwise."""
        along = np.stack([np.cos(self.heading), np.sin(self.heading)], axis=-1)
        left = np.stack([-along[..., 1], along[..., 0]], axis=-1)
        length, width, front, _rear = self.dragon.sizes[:, :, np.newaxis]
        nose = np.stack([self.x[:, :-1], self.y[:, :-1]], axis=-1) + along * front
        end, side = nose - along * length, 0.5 * left * width
        return np.stack([nose + side, end + side, end - side, nose - side], axis=-2)

    def outlines(self) -> npt.NDArray[np.object_]:
        """Every bench as a polygon of shapely, (T, N); None where it does not stand."""
        import shapely  # what only outlines need

        corners = self.corners()
        stands = ~np.isnan(corners).any(axis=(2, 3))
        out = np.full(stands.shape, None)
        out[stands] = shapely.polygons(corners[stands])
        return out

    @property
    def ratio_rate(self) -> FloatArray:
        """Rate of change of every handle's speed ratio per metre of the head's way, 1/m, (T, N + 1)."""
        return self._rates[0]

    @property
    def turning_ratio(self) -> FloatArray:
        """Turn of every bench per metre of the head's way, rad/m, left positive, (T, N)."""
        return self._rates[1]

    @cached_property
    def _rates(self) -> tuple[FloatArray, FloatArray]:
        ratio_rate = np.full(self._u.shape, np.nan)
        turn = np.full((self._u.shape[0] - 1, self._u.shape[1]), np.nan)
        rates(
            self.route.rows, self.dragon.links,
            self._row, self._u, self._x, self._y, self._ratio, ratio_rate, turn,
        )  # fmt: skip
        return frozen(ratio_rate.T), frozen(turn.T)

    @cached_property
    def chord_error(self) -> float:
        """Largest difference between a bench's link and the distance of its handles, m."""
        chords = np.hypot(np.diff(self._x, axis=0), np.diff(self._y, axis=0))
        return float(np.nanmax(np.abs(chords - self.dragon.links[:, np.newaxis]), initial=0.0))

    def check(self) -> None:
        """Raise the WalkError of the first position that failed, if one did."""
        failed = np.flatnonzero(self.status != Status.OK)
        if failed.size:
            raise self.failure(int(failed[0]))

    def failure(self, i: int) -> WalkError:
        """The WalkError that describes how position number i failed."""
        status, bench = Status(int(self.status[i])), int(self.failed_bench[i])
        head = s = float(self.head_s[i])
        size = self.route.length
        if bench:
            out = np.empty(1)
            positions(
                self.route.rows, self._row[bench - 1 : bench, i], self._u[bench - 1 : bench, i], out
            )
            s, size = float(out[0]), float(self.dragon.links[bench - 1])
        return WalkError(status, bench, s, head, f"{size:.6g} m")


def chosen_by(rows: Rows) -> Any:
    """Rows as NumPy takes them."""
    return rows if isinstance(rows, int | slice) else np.asarray(rows)


def frozen(table: Table) -> Table:
    """A view of a table that cannot be written."""
    seen = table.view()
    seen.flags.writeable = False
    return seen


def _cached(kind: type) -> set[str]:
    """Names of what a class keeps once it is asked for."""
    return {
        name
        for one in kind.__mro__
        for name, of in vars(one).items()
        if isinstance(of, cached_property)
    }
