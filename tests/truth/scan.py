"""Where to look, in ordinary floats: which benches meet first or come nearest, which handle is fastest.

NumPy alone, all head positions at once, nothing shared with the package. What is found here is then
refined in `make_truth.py`. A walk is a function from route positions to points, m, as complex numbers.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Complexes = npt.NDArray[np.complex128]
Points = Callable[[Floats], Complexes]
Pair = tuple[int, int]  # benches, numbered from 1
# Pitch, m, to the walk with it that ends at s = 0, and the head's position at its start, m.
Family = Callable[[float], tuple[Points, float]]

# Steps per link in the search for the next handle; secant steps inside the bracket, at most, and the
# step, m, after which no error is left: each is about the last one to the power 1.6.
STEPS, SECANTS, SETTLED = 24, 9, 1e-10
# Head positions at a time, and within one zoom into a step.
BLOCK, ZOOM = 400, 33
# Pairs farther apart than this, m, are not looked at; a gap less than this, m, is always looked into.
REACH, LEVEL = 0.3, 1e-3
# In the search for a pitch: scans at most; growth of a pitch that is not clear; the gap, m, from which
# on its pair is followed; how far the head goes for it, m; and what more pitch, m, must make clear.
MOST_TRIALS, GROWTH, ROUGH, NEARBY, HAIR = 40, 1.25, 2e-3, 0.5, 1e-7
# What the greatest ratio of speeds may change by in a metre.
STEEP = 2.0
# How well floats know the place of the greatest ratio, m; ratios that differ by less are alike to them.
FINE, LIKE = 1e-3, 1e-6


class Look(NamedTuple):
    """Where the head stands, m, and how far two benches are apart then, m."""

    gap: float
    head: float
    pair: Pair


def angles(k: float, length: Floats) -> Floats:
    """Angles of r = k theta at these lengths from the centre, m, by Newton's method.

    Each error is at most the square of the last step.
    """
    theta = np.sqrt(2.0 * length / k) + 1e-9
    for _step in range(12):
        root = np.sqrt(1.0 + theta * theta)
        step = (0.5 * (theta * root + np.log(theta + root)) - length / k) / root
        theta -= step
        if np.abs(step).max(initial=0.0) < 1e-8:
            break
    return theta


def length(k: float, theta: float) -> float:
    root = np.sqrt(1.0 + theta * theta)
    return float(0.5 * k * (theta * root + np.log(theta + root)))


def spiral_walk(pitch: float, theta: float) -> Points:
    """Inward along r = k theta, clockwise, at angle `theta` when s = 0."""
    k = pitch / (2.0 * np.pi)
    whole = length(k, theta)

    def point(s: Floats) -> Complexes:
        angle = angles(k, whole - s)
        return np.asarray(k * angle * np.exp(1j * angle))

    return point


def turn_walk(size: dict[str, complex]) -> Points:
    """The walk through a turn of two arcs of these sizes, which begins at s = 0."""
    k, r1, r2 = size["k"].real, size["r1"].real, size["r2"].real
    whole, both = length(k, size["theta"].real), size["length"].real
    first = r1 * size["sweep"].real

    def point(s: Floats) -> Complexes:
        found, before, after = np.empty(s.shape, dtype=complex), s < 0.0, s > both
        outside, one, two = before | after, ~before & (s < first), (s >= first) & ~after
        angle = angles(k, whole + np.where(before, -s, s - both)[outside])
        found[outside] = np.where(before[outside], k, -k) * angle * np.exp(1j * angle)
        found[one] = size["c1"] + (size["start"] - size["c1"]) * np.exp(-1j * s[one] / r1)
        found[two] = size["c2"] + (size["touch"] - size["c2"]) * np.exp(1j * (s[two] - first) / r2)
        return found

    return point


def behind(point: Points, s: Floats, link: float) -> Floats:
    """The largest positions below s one link away: steps back, then the secant method."""
    here = point(s)

    def excess(b: Floats) -> Floats:
        return np.asarray(np.abs(point(b) - here) - link)

    near, far = s, s - link
    below, above = np.full(s.shape, -link), excess(far)
    while (short := above < 0.0).any():
        near, below = np.where(short, far, near), np.where(short, above, below)
        far = np.where(short, far - link / STEPS, far)
        above = excess(far)
    a, b, fa, fb = near, far, below, above
    for _step in range(SECANTS):
        rise = np.where(fb == fa, 1.0, fb - fa)
        a, fa, b = b, fb, np.clip(b - fb * (b - a) / rise, far, near)
        if np.abs(b - a).max() < SETTLED:
            break
        fb = excess(b)
    return b


def places(point: Points, links: Sequence[float], heads: Floats) -> Floats:
    """Route positions of all handles, m, (handles, heads)."""
    s = [heads]
    for link in links:
        s.append(behind(point, s[-1], link))
    return np.array(s)


def ratios(point: Points, s: Floats) -> Floats:
    """Speeds of all handles over the head's, (handles, heads), with tangents by differences."""
    at, along = point(s), (point(s + 1e-5) - point(s - 1e-5)) / 2e-5
    bench = at[:-1] - at[1:]
    change = (along[:-1] * bench.conj()).real / (along[1:] * bench.conj()).real
    return np.vstack([np.ones(s.shape[1]), np.cumprod(change, axis=0)])


class Benches(NamedTuple):
    """Sizes of all benches, m, each (benches,)."""

    length: Floats
    width: Floats
    front: Floats
    rear: Floats

    @property
    def links(self) -> list[float]:
        return [float(link) for link in self.length - self.front - self.rear]

    def corners(self, at: Complexes) -> Complexes:
        """Corners from handles (handles, heads): (benches, 4, heads)."""
        bench = at[:-1] - at[1:]
        ahead = bench / np.abs(bench)
        nose, end = at[:-1] + self.front[:, None] * ahead, at[1:] - self.rear[:, None] * ahead
        left = 0.5j * self.width[:, None] * ahead
        return np.stack([nose + left, end + left, end - left, nose - left], axis=1)


def separations(a: Complexes, b: Complexes) -> Floats:
    """How far each corner of one rectangle lies outside each side of the other, m: (8, 4, heads)."""
    rows = []
    for sides, others in ((a, b), (b, a)):
        for n in range(4):
            side = sides[(n + 1) % 4] - sides[n]
            outward = -1j * side / np.abs(side)
            rows.append([((corner - sides[n]) * outward.conj()).real for corner in others])
    return np.array(rows)


def gaps(a: Complexes, b: Complexes) -> Floats:
    return np.asarray(separations(a, b).min(axis=1).max(axis=0))


def pair_gaps(point: Points, benches: Benches, heads: Floats, pair: Pair) -> Floats:
    """Gaps of one pair with the head at these positions, m."""
    s = places(point, benches.links[: max(pair)], heads)
    corners = Benches(*(size[: max(pair)] for size in benches)).corners(point(s))
    return gaps(corners[pair[0] - 1], corners[pair[1] - 1])


def near_pairs(point: Points, benches: Benches, heads: Floats) -> Iterator[tuple[Pair, Floats]]:
    """Every pair but neighbours that comes near, with its gaps, m; infinite where it is far apart."""
    corners = benches.corners(point(places(point, benches.links, heads)))
    centre = corners.mean(axis=1)
    arm = np.abs(corners[:, 0] - centre)[:, 0]
    for i in range(len(arm) - 2):
        room = (arm[i] + arm[i + 2 :] + REACH)[:, None]
        close = np.abs(centre[i + 2 :] - centre[i]) < room
        for row in np.flatnonzero(close.any(axis=1)):
            j, at = i + 2 + int(row), close[row]
            gap = np.full(len(heads), np.inf)
            gap[at] = gaps(corners[i][:, at], corners[j][:, at])
            yield (i + 1, j + 1), gap


def _dips(gap: Floats) -> Iterator[tuple[int, float]]:
    """Places where a gap is least among its neighbours, and how low it can lie beside them.

    Between looks it falls no lower than it rises to the next look, twice over.
    """
    padded = np.concatenate([[np.inf], gap, [np.inf]])
    for n in np.flatnonzero((gap < np.inf) & (gap <= padded[:-2]) & (gap <= padded[2:])):
        rises = [g - gap[n] for g in (padded[n], padded[n + 2]) if g < np.inf]
        yield int(n), float(gap[n]) - 2.0 * float(max(rises, default=REACH)) - LEVEL


def _zoom(point: Points, benches: Benches, low: float, high: float, pair: Pair) -> Look:
    """The least gap of a pair with the head between low and high."""
    best = Look(np.inf, low, pair)
    first, last = low, high
    while high - low > 1e-8:
        heads = np.linspace(low, high, ZOOM)
        gap = pair_gaps(point, benches, heads, pair)
        n = int(np.argmin(gap))
        best = min(best, Look(float(gap[n]), float(heads[n]), pair))
        step = heads[1] - heads[0]
        low, high = max(first, heads[n] - step), min(last, heads[n] + step)
    return best


def _crossing(point: Points, benches: Benches, low: float, high: float, pair: Pair) -> Look:
    """Where a pair apart at `low` first touches before `high`, where it overlaps."""
    while high - low > 1e-9:
        heads = np.linspace(low, high, ZOOM)
        inside = np.append(pair_gaps(point, benches, heads[1:-1], pair) <= 0.0, True)
        n = int(np.argmax(inside)) + 1
        low, high = float(heads[n - 1]), float(heads[n])
    return Look(0.0, high, pair)


def _touch(point: Points, benches: Benches, heads: Floats, pair: Pair, gap: Floats) -> Look | None:
    """The first touch of a pair whose gaps were looked at."""
    inside = np.flatnonzero(gap <= 0.0)
    end = int(inside[0]) if inside.size else len(gap) - 1
    for n, lowest in _dips(gap[: end + 1]):
        low, high = float(heads[max(n - 1, 0)]), float(heads[min(n + 1, end)])
        if gap[n] > 0.0 >= lowest:
            least = _zoom(point, benches, low, high, pair)
            if least.gap <= 0.0:
                return _crossing(point, benches, low, least.head, pair)
    if not inside.size:
        return None
    if end == 0:
        return Look(float(gap[0]), float(heads[0]), pair)
    return _crossing(point, benches, float(heads[end - 1]), float(heads[end]), pair)


def _blocks(start: float, end: float, step: float) -> Iterator[Floats]:
    """Head positions from start to end, m, in blocks that share two looks."""
    heads = np.linspace(start, end, max(3, int(np.ceil((end - start) / step)) + 1))
    for n in range(0, len(heads) - 2, BLOCK - 2):
        yield heads[n : n + BLOCK]


def first_touch(
    point: Points, benches: Benches, start: float, end: float, step: float = 0.05
) -> Look | None:
    """The first touch of any pair but neighbours with the head between start and end, m, or None."""
    for heads in _blocks(start, end, step):
        found = [
            _touch(point, benches, heads, pair, gap) for pair, gap in near_pairs(point, benches, heads)
        ]
        touches = [look for look in found if look is not None]
        if touches:
            return min(touches, key=lambda look: look.head)
    return None


def first_at_box(
    point: Points, benches: Benches, box: Complexes, start: float, end: float, step: float = 0.05
) -> Look | None:
    """The first touch of a box that stands still, by its 4 corners, as a pair of the bench and 0.

    Raises:
        ArithmeticError: if a bench may have touched it between two looks before.
    """
    middle, corner = box.mean(), box[:, None]
    for heads in _blocks(start, end, step):
        corners = benches.corners(point(places(point, benches.links, heads)))
        centre, inside = corners.mean(axis=1), []
        room = np.abs(corners[:, 0] - centre)[:, :1] + np.abs(box[0] - middle) + REACH
        for i in np.flatnonzero((np.abs(centre - middle) < room).any(axis=1)):
            gap = gaps(corners[i], corner)
            inside += [Look(float(gap[n]), float(heads[n]), (int(i) + 1, 0)) for n in range(len(heads))]
        touches = [look for look in inside if look.gap <= 0.0]
        first = min(touches, key=lambda look: look.head, default=None)
        for number in {look.pair for look in inside}:
            mine = [look for look in inside if look.pair == number]
            for n, lowest in _dips(np.array([look.gap for look in mine])):
                if mine[n].gap > 0.0 >= lowest and (first is None or mine[n].head < first.head):
                    raise ArithmeticError(f"look closer at bench {number[0]} at {mine[n].head}")
        if first is not None:
            return first
    return None


def tightest(
    point: Points, benches: Benches, start: float, end: float, step: float = 0.05
) -> Look | None:
    """The least gap of all pairs but neighbours on a walk; None if none comes near."""
    dips = []
    for heads in _blocks(start, end, step):
        for pair, gap in near_pairs(point, benches, heads):
            for n, lowest in _dips(gap):
                around = float(heads[max(n - 1, 0)]), float(heads[min(n + 1, len(heads) - 1)])
                dips.append((lowest, pair, around))
    best: Look | None = None
    for lowest, pair, (low, high) in sorted(dips):
        if best is not None and lowest > best.gap:
            break
        least = _zoom(point, benches, low, high, pair)
        best = least if best is None else min(best, least)
    return best


def _lowest_near(walk: Family, benches: Benches, pitch: float, look: Look) -> Look:
    """The least gap of a look's pair with another pitch, the head about as far from the disc."""
    point, start = walk(pitch)
    low, high = max(start, look.head - NEARBY), min(0.0, look.head + NEARBY)
    return _zoom(point, benches, low, high, look.pair)


def _pitch_of_pair(walk: Family, benches: Benches, pitch: float, look: Look) -> tuple[float, Look]:
    """The pitch with which the pair of a look just touches, by the secant method."""
    a, b, fa = pitch, pitch - look.gap, look.gap
    for _step in range(SECANTS):
        look = _lowest_near(walk, benches, b, look)
        if abs(look.gap) < 1e-13 or look.gap == fa:
            break
        a, fa, b = b, look.gap, b - look.gap * (b - a) / (look.gap - fa)
    return b, look


def smallest_pitch(
    walk: Family, benches: Benches, pitch: float, step: float = 0.05
) -> tuple[float, Look]:
    """The border between pitches that stay clear and smaller ones, coming from `pitch`, m; who touches.

    The least gap of all pairs brackets it. Where that is nearly nothing the pitch of its pair is taken;
    with a hair more no pair touches on the whole walk.
    """
    good, bad = (math.inf, math.inf), (0.0, -math.inf)
    for _trial in range(MOST_TRIALS):
        point, start = walk(pitch)
        look = tightest(point, benches, start, 0.0, step)
        if look is None:
            break
        if abs(look.gap) < ROUGH:
            border, touch = _pitch_of_pair(walk, benches, pitch, look)
            point, start = walk(border + HAIR)
            if first_touch(point, benches, start, 0.0, step) is None:
                return border, touch
        if look.gap > 0.0:
            good = pitch, look.gap
        else:
            bad = pitch, look.gap
        pitch = _between(good, bad)
    raise ArithmeticError("no smallest pitch was found")


def _between(good: tuple[float, float], bad: tuple[float, float]) -> float:
    """The next pitch, m, from one that is clear and one that is not, and their least gaps, m."""
    if math.isinf(good[0]):
        return GROWTH * bad[0]
    if math.isinf(bad[1]):
        return good[0] - min(good[1], 0.2 * good[0])
    share = min(max(good[1] / (good[1] - bad[1]), 0.1), 0.9)
    return good[0] + share * (bad[0] - good[0])


def fastest(
    point: Points, links: Sequence[float], start: float, end: float, step: float = 0.1
) -> tuple[float, list[int]]:
    """The head's position, m, at which a handle is fastest, and the handles that may be it."""

    def top(heads: Floats) -> Floats:
        return np.asarray(ratios(point, places(point, links, heads)).max(axis=0))

    heads = np.linspace(start, end, int((end - start) / step) + 2)
    step, seen = float(heads[1] - heads[0]), top(heads)
    padded = np.concatenate([[0.0], seen, [0.0]])
    peaks = (seen >= padded[:-2]) & (seen >= padded[2:])
    while step > 0.1 * FINE:
        # Beside a look no ratio is greater than there by more than STEEP a metre.
        at = heads[peaks & (seen > seen.max() - STEEP * step)]
        around = np.clip(np.linspace(at - step, at + step, ZOOM), start, end)
        ratio = top(around.ravel()).reshape(around.shape)
        n, which = ratio.argmax(axis=0), np.arange(len(at))
        heads, seen, peaks = around[n, which], ratio[n, which], np.ones(len(at), dtype=bool)
        step *= 2.0 / (ZOOM - 1)
    best = float(heads[int(np.argmax(seen))])
    ratio = ratios(point, places(point, links, np.array([best])))[:, 0]
    return best, [int(i) for i in np.flatnonzero(ratio > ratio.max() - LIKE)]
