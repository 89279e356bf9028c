"""Random numbers by their place in a stream, whatever the caller, the order and the count of calls.

Philox4x32-10 (Salmon, Moraes, Dror and Shaw, Parallel random numbers: as easy as 1, 2, 3, 2011) makes
four words of 32 bits of a counter and a key. The key is a seed, the counter a dance, what is random in
it, and the number of the pair: no state is kept, so that hosts, workers and blocks cannot differ.
"""

import math

from benchdragon.kernels.angles import sincos
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered

WORD = 0xFFFFFFFF
# Its multipliers, and what its keys grow by from round to round.
TIMES, OTHER_TIMES = 0xD2511F53, 0xCD9E8D57
PLUS, OTHER_PLUS = 0x9E3779B9, 0xBB67AE85
ROUNDS = 10


class Random(Numbered):
    """The random deviations of a dance, by their standard deviations, m: see solve/tolerance.py."""

    ASIDE, STRAY, PLAY, HEIGHT, LENGTH, WIDTH = range(6)


DEVIATIONS = len(Random)


@kernel
def philox(a: int, b: int, c: int, d: int, key: int, other: int) -> tuple[int, int, int, int]:
    """Four random words of a counter of four and a key of two."""
    for _ in range(ROUNDS):  # products of 64 bits may wrap around: their bits are the same
        p, q = TIMES * a, OTHER_TIMES * c
        high, other_high = (p >> 32) & WORD, (q >> 32) & WORD
        a, b, c, d = other_high ^ b ^ key, q & WORD, high ^ d ^ other, p & WORD
        key, other = (key + PLUS) & WORD, (other + OTHER_PLUS) & WORD
    return a, b, c, d


@kernel
def uniform_of(word: int, other: int) -> float:
    """Two random words as a number over 0, up to 1, of 53 bits."""
    return ((word >> 5) * 67108864 + (other >> 6) + 1) * 2.0**-53


@kernel
def normal_at(seed: int, dance: int, part: int, n: int) -> float:
    """Standard normal number n of a part of a dance, by Box and Muller: two of four words."""
    a, b, c, d = philox(n >> 1, part, dance, 0, seed & WORD, (seed >> 32) & WORD)
    radius = math.sqrt(-2.0 * math.log(uniform_of(a, b)))
    sine, cosine = sincos(2.0 * math.pi * uniform_of(c, d))
    return radius * (sine if n & 1 else cosine)


@entry
def draw_normals(seed: int, dance: int, part: int, out: Vector) -> None:
    """Fill `out` with the first standard normal numbers of a part of a dance."""
    for n in range(out.shape[0]):
        out[n] = normal_at(seed, dance, part, n)


@entry
def draw_benches(
    seed: int, dance: int, deviations: Vector, plain: Table, sizes: Table, aside: Vector
) -> None:
    """Fill `sizes`, as `plain` is, with those of the benches of a dance, seen from above.

    `aside` receives how far to the left of the line its handles walk, m, as far as it has room.
    """
    for i in range(plain.shape[1]):
        front, rear = plain[2, i], plain[3, i]
        sizes[0, i] = plain[0, i] + deviations[Random.LENGTH] * normal_at(seed, dance, Random.LENGTH, i)
        sizes[1, i] = plain[1, i] + deviations[Random.WIDTH] * normal_at(seed, dance, Random.WIDTH, i)
        link = sizes[0, i] - front - rear
        height = deviations[Random.HEIGHT] * normal_at(seed, dance, Random.HEIGHT, i)
        longer = math.sqrt(max(link * link - height * height, 0.0)) - link
        longer += deviations[Random.PLAY] * normal_at(seed, dance, Random.PLAY, i)
        # Pins with play move the benches, not their edges: the rear inset takes it up.
        sizes[2, i], sizes[3, i] = front, rear - longer
    for i in range(aside.shape[0]):
        aside[i] = deviations[Random.ASIDE] * normal_at(seed, dance, Random.ASIDE, i)
