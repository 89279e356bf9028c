"""Which queries are asked about a dance: pairs that come near one another.

Their widths are chosen so that many only just touch, or only just do not.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt
from query_set import SEED, Dance, Query

from benchdragon.kernels import time_of_impact as kernel
from benchdragon.kernels.chain import Placements, empty_placements, march
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.pair_queries import (
    ANSWER_COLUMNS,
    NUMBERS,
    search_pairs,
)
from benchdragon.kernels.rounding import SEAM_COLUMNS, find_seams

IntArray = npt.NDArray[np.int64]
# Windows of the head's way, m, and how likely each is; windows of a dance, and queries of one.
LENGTHS, SHARES = (0.05, 0.25, 1.0, 5.0), (0.35, 0.25, 0.25, 0.15)
WINDOWS, PAIRS = 40, 8
# Places of a window at which pairs near one another are looked for.
LOOKS = 5
# Digits of widths and head positions.
WIDTH_DIGITS, WAY_DIGITS = 9, 3
THIN, WIDEST = 0.02, 1.0
# Benches start farther apart than this, m; queries whose widths are looked for at once.
START_GAP, CHUNK = 1e-6, 40
# Benches whose circles come so near, m, are near one another; windows in which none comes nearer are
# looked at so often.
REACH, LONELY = 0.3, 0.1
# Kinds of queries, and how likely each is: of a drawn width, a contact, a graze, a near miss, any pair.
DRAWN, CONTACT, GRAZE, MISS, FAR = range(5)
MIX = (0.16, 0.40, 0.16, 0.24, 0.04)


@dataclass(frozen=True)
class Asking:
    """The engine's entry for queries about one dance."""

    dance: Dance

    @cached_property
    def _room(self) -> tuple[kernel.Search, FloatArray]:
        seams = np.empty((len(self.dance.rows), SEAM_COLUMNS))
        find_seams(self.dance.rows, seams)
        return kernel.empty_search(self.dance.benches + 1, 2, 1), seams

    def ask(
        self, goal: int, first: IntArray, second: IntArray, width: FloatArray, spans: FloatArray,
        slack: float = 1e-13, most: int = 20_000,
    ) -> FloatArray:  # fmt: skip
        """Answers of kernels/pair_queries.py."""
        (room, seams), out = self._room, np.empty((len(first), ANSWER_COLUMNS))
        numbers, note = np.empty(NUMBERS, dtype=np.int64), np.empty(kernel.NOTES)
        dance = self.dance
        search_pairs(
            room, goal, dance.rows, dance.link, dance.sizes.copy(), seams, first, second, width, spans,
            slack, 1e-13, most, numbers, note, out,
        )  # fmt: skip
        return out

    def place(self, s: FloatArray, benches: int | None = None) -> Placements:
        """The handles of the first benches with the head at places s, m."""
        links = self.dance.link[:benches]
        places = empty_placements(len(links) + 1, len(s))
        march(self.dance.rows, links, s, 0, len(s), places)
        return places


def boxes(dance: Dance, places: Placements, i: IntArray, t: IntArray, width: FloatArray) -> FloatArray:
    """Centre, unit vector along it, half length and half width of benches i at places t, (n, 6)."""
    x, y, link = places.x, places.y, dance.link[i]
    ux, uy = (x[i, t] - x[i + 1, t]) / link, (y[i, t] - y[i + 1, t]) / link
    ahead = 0.5 * (link + dance.front - dance.rear)
    half = 0.5 * (link + dance.front + dance.rear)
    return np.stack([x[i + 1, t] + ahead * ux, y[i + 1, t] + ahead * uy, ux, uy, half, 0.5 * width], 1)


def face_gap(one: FloatArray, other: FloatArray) -> FloatArray:
    """How far boxes are apart along the best normal of a face, m, (n,); negative: they overlap."""
    best = np.full(len(one), -np.inf)
    dx, dy = (other[:, :2] - one[:, :2]).T
    for owner in (one, other):
        for nx, ny in ((owner[:, 2], owner[:, 3]), (-owner[:, 3], owner[:, 2])):
            gap = np.abs(dx * nx + dy * ny)
            for box in (one, other):
                gap -= box[:, 4] * np.abs(box[:, 2] * nx + box[:, 3] * ny)
                gap -= box[:, 5] * np.abs(box[:, 2] * ny - box[:, 3] * nx)
            best = np.maximum(best, gap)
    return best


def width_at(dance: Dance, places: Placements, pairs: IntArray, t: IntArray, gap: float) -> FloatArray:
    """The width, m, with which pairs, (n, 2), at places t are so far apart; at least 0."""
    low, high = np.zeros(len(pairs)), np.full(len(pairs), 4.0)
    for _halving in range(32):
        width = 0.5 * (low + high)
        one, other = (boxes(dance, places, pairs[:, k], t, width) for k in (0, 1))
        apart = face_gap(one, other) > gap
        low, high = np.where(apart, width, low), np.where(apart, high, width)
    return low


def near(
    dance: Dance, asking: Asking, span: FloatArray, kinds: IntArray, rng: np.random.Generator
) -> IntArray | None:
    """Pairs for queries of these kinds, (n, 2): that come nearer in a span, are near, or any.

    None where none comes nearer, mostly.
    """
    places = asking.place(np.linspace(span[0], span[1], LOOKS))
    i, j = np.triu_indices(dance.benches, 2)
    x, y = (0.5 * (table[:-1] + table[1:]) for table in (places.x, places.y))
    apart = np.sqrt(((x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2).min(axis=1))
    long = dance.link + dance.front + dance.rear
    close = np.flatnonzero(apart < 0.5 * (long[i] + long[j]) + REACH)
    thin = np.full(len(close), THIN)
    gaps = [
        face_gap(*(boxes(dance, places, k[close], np.full(len(close), t), thin) for k in (i, j)))
        for t in range(LOOKS)
    ]
    nearer = close[(gaps[0] > 0.0) & (np.min(gaps[1:], axis=0) < gaps[0])]
    if not len(nearer) and rng.random() > LONELY:
        return None
    among = {FAR: np.arange(len(i)), DRAWN: close}
    groups = [among.get(kind, nearer) for kind in kinds.tolist()]
    chosen = [int(rng.choice(group if len(group) else len(i))) for group in groups]
    return np.stack([i[chosen], j[chosen]], 1)


def queries_of(number: int, dance: Dance) -> list[Query]:
    """The queries about a dance."""
    rng = np.random.Generator(np.random.Philox(key=(SEED, number), counter=1 << 64))
    asking, (first, last) = Asking(dance), dance.span
    spans, kinds, pairs = list[FloatArray](), list[IntArray](), list[IntArray]()
    for _window in range(3 * WINDOWS):
        start = np.round(rng.uniform(first, last - max(LENGTHS)), WAY_DIGITS)
        span = np.round([start, start + rng.choice(LENGTHS, p=SHARES)], WAY_DIGITS)
        kind = rng.choice(len(MIX), PAIRS, p=MIX)
        found = near(dance, asking, span, kind, rng)
        if found is not None:
            spans.append(span)
            kinds.append(kind)
            pairs.append(found)
        if len(pairs) == WINDOWS:
            break
    if not pairs:
        return []
    both, whole = np.concatenate(pairs), np.repeat(spans, PAIRS, 0)
    chosen = widths(dance, asking, both, whole, np.concatenate(kinds), rng)
    asked = zip(both.tolist(), chosen.tolist(), whole.tolist(), strict=True)
    return [
        Query(number, i, j, width, start, end) for (i, j), width, (start, end) in asked if width > 0.0
    ]


def touching(dance: Dance, asking: Asking, pairs: IntArray, spans: FloatArray) -> FloatArray:
    """The width, m, with which each pair only just touches, where it is nearest: looked for."""
    low, high = spans[:, 0], spans[:, 1]
    count, least = len(pairs), np.empty(0)
    for looks in (33, 17, 17, 17):
        s = np.linspace(low, high, looks, axis=1)
        both, t = np.repeat(pairs, looks, 0), np.arange(count * looks)
        widths = width_at(dance, asking.place(s.ravel()), both, t, 0.0).reshape(count, looks)
        k, every, least = widths.argmin(axis=1), np.arange(count), widths.min(axis=1)
        low, high = s[every, np.maximum(k - 1, 0)], s[every, np.minimum(k + 1, looks - 1)]
    return least


def widths(
    dance: Dance, asking: Asking, pairs: IntArray, spans: FloatArray, kinds: IntArray,
    rng: np.random.Generator,
) -> FloatArray:  # fmt: skip
    """The width of each query, m, with which its benches start apart; NaN where there is none."""
    count = len(pairs)
    start = width_at(dance, asking.place(spans[:, 0].copy()), pairs, np.arange(count), START_GAP)
    parts = range(0, count, CHUNK)
    touch = np.concatenate(
        [touching(dance, asking, pairs[n : n + CHUNK], spans[n : n + CHUNK]) for n in parts]
    )
    random = rng.random(count)
    depth = 10.0 ** (-6.0 + 4.0 * random)
    clear = 10.0 ** (-6.0 + 5.0 * random)
    drawn = rng.uniform(0.1, 0.5, count)
    contact = touch + random * (np.minimum(start, WIDEST) - touch)
    chosen = np.select(
        [kinds == CONTACT, kinds == GRAZE, kinds == MISS],
        [contact, touch + depth, touch - clear],
        drawn,
    )
    chosen = np.round(chosen, WIDTH_DIGITS)
    return np.where((chosen >= THIN) & (chosen <= np.minimum(start, 2.0 * WIDEST)), chosen, np.nan)
