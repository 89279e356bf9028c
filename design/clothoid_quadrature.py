"""Why a clothoid is integrated by 12 Gauss-Legendre nodes on rows that turn by at most 2 rad.

The point after arc length u is the integral of (cos, sin)(heading + P s + Q s^2 / 2). Fresnel's
integrals give it in closed form, but only after dividing by sqrt(Q): where the curvature changes
slowly, large numbers cancel. Quadrature has no such place. Its integrand is entire, so the error falls
faster than any power of the number of nodes; how many are needed depends on the turn alone.
"""

import math

import mpmath
import numpy as np
from scipy.special import fresnel

from benchdragon import Clothoid


def exact(length: float, start: float, end: float) -> tuple[float, float]:
    """The end point in 30 digits."""
    with mpmath.workdps(30):
        q = (mpmath.mpf(end) - mpmath.mpf(start)) / mpmath.mpf(length)
        pieces = mpmath.linspace(0, length, 2 + int(length * max(abs(start), abs(end))))
        point = mpmath.quad(lambda s: mpmath.expj(start * s + q * s * s / 2), pieces)
        return float(point.real), float(point.imag)


def by_nodes(count: int, turn: float) -> float:
    """Worst error, per metre of length, of `count` nodes over clothoids that turn by up to `turn`."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    s, w = 0.5 * (1.0 + nodes), 0.5 * weights
    worst = 0.0
    for start, end in ((turn, turn), (0.0, turn), (-turn, turn), (0.5 * turn, turn)):
        phase = start * s + 0.5 * (end - start) * s * s
        x, y = exact(1.0, start, end)
        worst = max(worst, math.hypot((w * np.cos(phase)).sum() - x, (w * np.sin(phase)).sum() - y))
    return worst


def by_fresnel(length: float, start: float, end: float) -> tuple[float, float]:
    """The end point by Fresnel integrals, completing the square."""
    q = (end - start) / length
    scale = math.sqrt(math.pi / abs(q))
    low, high = start / (q * scale), start / (q * scale) + length / scale
    (s0, c0), (s1, c1) = fresnel(low), fresnel(high)
    turn = -0.5 * start * start / q
    x, y = scale * (c1 - c0), math.copysign(scale, q) * (s1 - s0)
    c, s = math.cos(turn), math.sin(turn)
    return float(x * c - y * s), float(x * s + y * c)


def main() -> None:
    """Print errors against nodes and turn, and against Fresnel where the curvature changes slowly."""
    turns = (1.0, 2.0, 4.0)
    print("worst error, m per metre:   nodes " + "".join(f"  turn {turn:g} rad" for turn in turns))
    for count in (6, 8, 10, 12, 16):
        errors = "".join(f"   {by_nodes(count, turn):9.1e}" for turn in turns)
        print(f"                            {count:5d} {errors}")
    assert by_nodes(12, 2.0) < 1e-15
    print("end of 10 m from curvature 0.3 to 0.3 + d, m off:   d     Fresnel     ours")
    for change in (1e-1, 1e-4, 1e-8):
        x, y = exact(10.0, 0.3, 0.3 + change)
        ends = by_fresnel(10.0, 0.3, 0.3 + change), Clothoid(10.0, 0.3, 0.3 + change).end_pose[0]
        off = "    ".join(f"{math.hypot(px - x, py - y):8.1e}" for px, py in ends)
        print(f"                                                {change:8.0e}    {off}")


if __name__ == "__main__":
    main()
