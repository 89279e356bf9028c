"""The binomial distribution: tails, and bounds of a probability from hits among trials."""

from benchdragon.kernels.entries import entry, kernel

# Halvings of the probabilities from 0 to 1 until a double has no more in between.
PROBABILITY_HALVINGS = 100


@entry
def tails(hits: int, count: int, risk: float) -> tuple[float, float]:
    """Probability that so many of `count` trials hit or fewer, each with `risk`; and that more do."""
    if risk <= 0.0 or risk >= 1.0:
        return (1.0, 0.0) if hits >= (0 if risk <= 0.0 else count) else (0.0, 1.0)
    odds, likeliest = risk / (1.0 - risk), min(int((count + 1) * risk), count)
    few, more, term, k = 0.0, 0.0, 1.0, likeliest
    while k >= 0 and term > 0.0:
        if k <= hits:
            few += term
        else:
            more += term
        term *= k / ((count - k + 1) * odds)
        k -= 1
    term, k = 1.0, likeliest + 1
    while k <= count and term > 0.0:
        term *= (count - k + 1) * odds / k
        if k <= hits:
            few += term
        else:
            more += term
        k += 1
    return few / (few + more), more / (few + more)


@kernel
def risk_at(hits: int, count: int, side: int, chance: float) -> float:
    """The probability with which one tail of so many hits has that chance: side 0 the lower one."""
    low, high = 0.0, 1.0
    for _ in range(PROBABILITY_HALVINGS):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        few, more = tails(hits, count, middle)
        if (few <= chance) if side == 0 else (more >= chance):
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


@entry
def chance_bounds(hits: int, count: int, confidence: float) -> tuple[float, float]:
    """Bounds of a probability by Clopper and Pearson, if so many of `count` trials hit."""
    tail = 0.5 * (1.0 - confidence)
    low = risk_at(hits - 1, count, 1, tail) if hits > 0 else 0.0
    return low, risk_at(hits, count, 0, tail) if hits < count else 1.0


@kernel
def hits_at(count: int, risk: float, side: int, chance: float) -> int:
    """The fewest hits, up to `count`, whose lower tail is over that chance, or whose other is not."""
    low, high = 0, count
    while low < high:
        middle = (low + high) // 2
        few, more = tails(middle, count, risk)
        if (few > chance) if side == 0 else (more <= chance):
            high = middle
        else:
            low = middle + 1
    return low


@entry
def ranks(count: int, risk: float, confidence: float) -> tuple[int, int]:
    """Which of `count` numbers in order, from the greatest, 0, bound the quantile that `risk` exceeds.

    The one from above, the other from below, each with that confidence, whatever they are drawn from;
    -1, or `count`: too few to say.
    """
    return hits_at(count, risk, 0, 1.0 - confidence) - 1, hits_at(count, risk, 1, 1.0 - confidence)
