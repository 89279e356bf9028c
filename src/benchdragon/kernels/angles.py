"""Sine and cosine to rounding: no library's, and written to become SIMD."""

import math

from benchdragon.kernels.entries import kernel

MOST_ANGLE = 1.0e6  # rad; above it the reduction of angles loses digits
# Nearest integer by adding and taking away 1.5 * 2^52; sound for |x| < 2^51.
NEAREST = 6755399441055744.0
# pi / 2 as a sum of two doubles, the first with 33 bits so that n * PI_HALF is exact.
PI_HALF = 1.57079632673412561417
PI_HALF_REST = 6.07710050650619224932e-11
# Minimax coefficients of sin and cos on [-pi/4, pi/4]: the figures that fdlibm made known.
S1 = -1.66666666666666324348e-01
S2 = 8.33333333332248946124e-03
S3 = -1.98412698298579493134e-04
S4 = 2.75573137070700676789e-06
S5 = -2.50507602534068634195e-08
S6 = 1.58969099521155010221e-10
C1 = 4.16666666666666019037e-02
C2 = -1.38888888888741095749e-03
C3 = 2.48015872894767294178e-05
C4 = -2.75573143513906633035e-07
C5 = 2.08757232129817482790e-09
C6 = -1.13596475577881948265e-11


@kernel
def small_sincos(x: float) -> tuple[float, float]:
    """Sine and cosine of |x| <= pi / 4, to rounding, without a branch."""
    z = x * x
    sine = x + x * z * (S1 + z * (S2 + z * (S3 + z * (S4 + z * (S5 + z * S6)))))
    tail = z * z * (C1 + z * (C2 + z * (C3 + z * (C4 + z * (C5 + z * C6)))))
    return sine, 1.0 - 0.5 * z + tail


@kernel
def sincos(x: float) -> tuple[float, float]:
    """Sine and cosine of |x| <= MOST_ANGLE, to rounding, without a branch."""
    n = (x * (2.0 / math.pi) + NEAREST) - NEAREST
    sine, cosine = small_sincos((x - n * PI_HALF) - n * PI_HALF_REST)
    quarter = n - 4.0 * ((0.25 * n - 0.375 + NEAREST) - NEAREST)
    odd = quarter == 1.0 or quarter == 3.0
    s = cosine if odd else sine
    c = sine if odd else cosine
    return (-s if quarter >= 2.0 else s), (-c if quarter == 1.0 or quarter == 2.0 else c)


@kernel
def sincos_of(x: float) -> tuple[float, float]:
    """Sine and cosine of any angle, rad."""
    if abs(x) <= MOST_ANGLE:
        return sincos(x)
    return math.sin(x), math.cos(x)
