"""Bench, Dragon, the contest's dragon: sizes only."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import index
from typing import Self

import numpy as np
import numpy.typing as npt

from benchdragon.arrays import as_numbers
from benchdragon.errors import InputError, as_number, not_negative, positive
from benchdragon.kernels.curve import FloatArray
from benchdragon.messages import _

MOST_BENCHES = 1_000_000
# m; the longest that is still a bench and the shortest link that chords of 1e-12 m can resolve.
LONGEST_BENCH = 1e4
SHORTEST_LINK = 1e-3


@dataclass(frozen=True)
class Bench:
    """One rigid rectangle and its two holes; lengths in metres.

    Args:
        length: along the line of the holes.
        width: across it.
        front_inset: from the front edge to the front hole.
        rear_inset: from the rear edge to the rear hole.
    """

    length: float
    width: float = 0.30
    front_inset: float = 0.275
    rear_inset: float = 0.275

    @property
    def link(self) -> float:
        """Distance between the two holes, m."""
        return self.length - self.front_inset - self.rear_inset


class Dragon:
    """Benches in walking order, bench 1 the head: their sizes as read-only arrays, (benches,), m.

    Args:
        benches: at least 1, at most a million; any sizes.

    Raises:
        InputError: naming the first bench whose sizes cannot be.
    """

    def __init__(self, benches: Sequence[Bench]) -> None:
        self._set(*(as_numbers(name, [getattr(bench, name) for bench in benches]) for name in _SIZES))

    @classmethod
    def of_sizes(
        cls,
        length: npt.ArrayLike,
        width: npt.ArrayLike = 0.30,
        front_inset: npt.ArrayLike = 0.275,
        rear_inset: npt.ArrayLike = 0.275,
    ) -> Self:
        """A dragon from arrays of sizes, m, that broadcast to (benches,)."""
        given = (length, width, front_inset, rear_inset)
        columns = [as_numbers(name, value) for name, value in zip(_SIZES, given, strict=True)]
        try:
            columns = list(np.broadcast_arrays(np.atleast_1d(columns[0]), *columns[1:]))
        except ValueError:
            columns = []
        if not columns or columns[0].ndim != 1:
            raise InputError(_("sizes must be lists of one length, one entry a bench"))
        dragon = cls.__new__(cls)
        dragon._set(*columns)
        return dragon

    @classmethod
    def uniform(
        cls,
        benches: int = 223,
        head_length: float = 3.41,
        body_length: float = 2.20,
        tail_length: float = 2.20,
        width: float = 0.30,
        front_inset: float = 0.275,
        rear_inset: float = 0.275,
    ) -> Self:
        """Head, equal bodies, tail, in metres; without arguments the dragon of CUMCM 2024 A."""
        try:
            sound = 1 <= index(benches) <= MOST_BENCHES
        except TypeError:
            sound = False
        if not sound:
            raise InputError(_count_text(benches))
        length = np.full(benches, as_number("body_length", body_length))
        length[-1] = as_number("tail_length", tail_length)
        length[0] = as_number("head_length", head_length)
        return cls.of_sizes(length, width, front_inset, rear_inset)

    def _set(self, *columns: npt.ArrayLike) -> None:
        arrays = [np.array(column, dtype=np.float64) for column in columns]
        self.length, self.width, self.front_inset, self.rear_inset = arrays
        if not 1 <= len(self) <= MOST_BENCHES:
            raise InputError(_count_text(len(self)))
        self._check()
        for array in arrays:
            array.flags.writeable = False

    @cached_property
    def sizes(self) -> FloatArray:
        """Length, width, front inset and rear inset of every bench, m, (4, benches)."""
        sizes = np.array([self.length, self.width, self.front_inset, self.rear_inset])
        sizes.flags.writeable = False
        return sizes

    def _check(self) -> None:
        """One vectorised look; only the bench it finds is described."""
        sizes = self.sizes
        with np.errstate(invalid="ignore"):
            sound = np.isfinite(sizes).all(axis=0) & (sizes[:2] > 0.0).all(axis=0)
            sound &= (sizes[2:] >= 0.0).all(axis=0) & (sizes <= LONGEST_BENCH).all(axis=0)
            sound &= self.links >= SHORTEST_LINK
        if not sound.all():
            self._describe(int(np.argmin(sound)))

    def _describe(self, i: int) -> None:
        where = _("bench {number}: {size}")
        for name in _SIZES:
            check = positive if name in ("length", "width") else not_negative
            label = where.format(number=i + 1, size=name)
            if check(label, float(getattr(self, name)[i]), "m") > LONGEST_BENCH:
                raise InputError(
                    _("{name} must be at most {most} m, not {value} m").format(
                        name=label, most=f"{LONGEST_BENCH:g}", value=f"{getattr(self, name)[i]:g}"
                    )
                )
        raise InputError(
            _(
                "bench {number}: its insets ({front} m and {rear} m) leave no link "
                "in a length of {length} m"
            ).format(
                number=i + 1,
                front=f"{self.front_inset[i]:g}",
                rear=f"{self.rear_inset[i]:g}",
                length=f"{self.length[i]:g}",
            )
        )

    def __len__(self) -> int:
        """Number of benches."""
        return len(self.length)

    def __repr__(self) -> str:
        return f"<Dragon of {len(self)} benches, {self.links.sum():.6g} m from handle to handle>"

    @cached_property
    def lever(self) -> float:
        """The most that any point of a bench moves when both its handles move by at most 1."""
        insets = 2.0 * np.maximum(self.front_inset, self.rear_inset)
        return float((1.0 + (insets + self.width) / self.links).max())

    @cached_property
    def links(self) -> FloatArray:
        """Distance between each bench's two holes, m, (benches,)."""
        links = self.length - self.front_inset - self.rear_inset
        links.flags.writeable = False
        return links


_SIZES = ("length", "width", "front_inset", "rear_inset")


def _count_text(count: object) -> str:
    return _("a dragon has 1 to {most} benches, not {count}").format(most=MOST_BENCHES, count=count)
