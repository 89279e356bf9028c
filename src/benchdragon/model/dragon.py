"""Bench, Dragon, the contest's dragon: sizes only."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import index
from typing import Self

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, as_number, brief, not_negative, of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels.box import LONGEST_BENCH, SHORTEST_LINK
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.links import link_length, links_of
from benchdragon.methods import Method
from benchdragon.model.arrays import as_numbers

MOST_BENCHES = 1_000_000
# Benches that cannot be and are described at once.
MOST_FAULTS = 20


@dataclass(frozen=True)
class Bench:
    """One rigid rectangle and its two holes; lengths in metres.

    Args:
        length: along the line of the holes.
        width: across it.
        front_inset: from the front edge to the front hole.
        rear_inset: from the rear edge to the rear hole.

    Examples:
        >>> round(bd.Bench(3.41).link, 9)
        2.86
    """

    length: float
    width: float = 0.30
    front_inset: float = 0.275
    rear_inset: float = 0.275

    def __post_init__(self) -> None:
        for name in _SIZES:
            as_number(name, getattr(self, name))

    @property
    def link(self) -> float:
        """Distance between the two holes, m."""
        return link_length(self.length, self.front_inset, self.rear_inset)


class SizeError(InputError):
    """Sizes that cannot be.

    Attributes:
        faults: bench (a row, from 0), size and sentence of each, benches of the same sizes once.
    """

    def __init__(self, faults: list[tuple[int, str, str]]) -> None:
        super().__init__(faults[0][2])
        self.faults = faults


class Dragon:
    """Benches in walking order, bench 1 the head: their sizes as read-only arrays, (benches,), m.

    As a sequence it holds a `Bench` each, from 0; dragons of the same sizes are equal.

    Args:
        benches: at least 1, at most a million; any sizes.

    Raises:
        InputError: naming the first bench whose sizes cannot be.

    Examples:
        >>> bd.Dragon.uniform()
        <Dragon of 223 benches, 369.16 m from handle to handle>
        >>> bd.Dragon([bd.Bench(3.41), bd.Bench(2.2), bd.Bench(1.8, width=0.4)])[-1].link
        1.25
    """

    length: FloatArray
    width: FloatArray
    front_inset: FloatArray
    rear_inset: FloatArray
    _repr_html_ = Method("as_html")

    def __init__(self, benches: Iterable[Bench]) -> None:
        if not isinstance(benches, Iterable):
            text = _("benches must be a list of Bench, not {value}")
            raise InputError(text.format(value=brief(benches)))
        benches = list(benches)
        for n, bench in enumerate(benches, start=1):
            if not isinstance(bench, Bench):
                of_kind(_("bench {number}").format(number=n), bench, Bench)
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

    def first(self, benches: int) -> Self:
        """The dragon of its first benches alone."""
        return type(self).of_sizes(*self.sizes[:, :benches])

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
            raise InputError(count_text(benches))
        length = np.full(benches, as_number("body_length", body_length))
        length[-1] = as_number("tail_length", tail_length)
        length[0] = as_number("head_length", head_length)
        return cls.of_sizes(length, width, front_inset, rear_inset)

    def _set(self, *columns: npt.ArrayLike) -> None:
        arrays = [np.array(column, dtype=np.float64) for column in columns]
        self.__dict__.update(zip(_SIZES, arrays, strict=True))
        if not 1 <= len(self) <= MOST_BENCHES:
            raise InputError(count_text(len(self)))
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
        """One vectorised look; only what it finds is described, benches of the same sizes once."""
        sizes = self.sizes
        with np.errstate(invalid="ignore", over="ignore"):
            sound = np.isfinite(sizes).all(axis=0) & (sizes[:2] > 0.0).all(axis=0)
            sound &= (sizes[2:] >= 0.0).all(axis=0) & (sizes <= LONGEST_BENCH).all(axis=0)
            sound &= self.links >= SHORTEST_LINK
        if not sound.all():
            wrong = np.flatnonzero(~sound)
            _sizes, first = np.unique(sizes[:, wrong], axis=1, return_index=True)
            some = wrong[np.sort(first)[:MOST_FAULTS]].tolist()
            raise SizeError([fault_of(i, sizes[:, i].tolist()) for i in some])

    def __len__(self) -> int:
        """Number of benches."""
        return len(self.length)

    def __getitem__(self, i: int) -> Bench:
        """Bench in row i, from 0; from the tail where negative."""
        row = range(len(self))[i]
        return Bench(*self.sizes[:, row].tolist())

    def __iter__(self) -> Iterator[Bench]:
        """The benches, head first."""
        return (Bench(*sizes) for sizes in self.sizes.T.tolist())

    def __eq__(self, other: object) -> bool:
        """Whether all sizes are the same."""
        return np.array_equal(self.sizes, other.sizes) if isinstance(other, Dragon) else NotImplemented

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.sizes + 0.0).tobytes())  # -0.0 is equal to 0.0

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse: a dragon stays as it is, so that it may be a key."""
        del value
        raise AttributeError(_("a dragon cannot be changed ({name}): make another").format(name=name))

    def __repr__(self) -> str:
        return f"<Dragon of {len(self)} benches, {self.extent:.6g} m from handle to handle>"

    @property
    def extent(self) -> float:
        """From handle to handle, m: the length of the whole dragon."""
        return float(self.links.sum())

    @property
    def longest_link(self) -> float:
        """The largest distance between a bench's two holes, m."""
        return float(self.links.max())

    @cached_property
    def lever(self) -> float:
        """The most that any point of a bench moves when both its handles move by at most 1."""
        insets = 2.0 * np.maximum(self.front_inset, self.rear_inset)
        return float((1.0 + (insets + self.width) / self.links).max())

    @cached_property
    def links(self) -> FloatArray:
        """Distance between each bench's two holes, m, (benches,)."""
        links = np.empty(len(self))
        links_of(self.sizes, links)
        links.flags.writeable = False
        return links


_SIZES = ("length", "width", "front_inset", "rear_inset")


def fault_of(i: int, sizes: Sequence[float]) -> tuple[int, str, str]:
    """What is wrong with bench i (a row, from 0) of sizes, m, that cannot be: as in `SizeError`."""
    for name, value in zip(_SIZES, sizes, strict=True):
        check = positive if name in ("length", "width") else not_negative
        label = _("bench {number}: {size}").format(number=i + 1, size=name)
        try:
            check(label, value, "m")
        except InputError as error:
            return i, name, str(error)
        if value > LONGEST_BENCH:
            text = _("{name} must be at most {most} m, not {value} m")
            return i, name, text.format(name=label, most=f"{LONGEST_BENCH:g}", value=f"{value:g}")
    length, _width, front, rear = (f"{value:g}" for value in sizes)
    text = _(
        "bench {number}: its insets ({front} m and {rear} m) leave no link in a length of {length} m"
    )
    return i, "length", text.format(number=i + 1, front=front, rear=rear, length=length)


def count_text(count: object) -> str:
    """What is wrong with so many benches."""
    text = _("a dragon has 1 to {most} benches, not {count}")
    return text.format(most=MOST_BENCHES, count=brief(count))
