"""Why one link on a spiral is taken by one Halley step on h^2 + 4 a b sin^2(h/2) = D^2.

Front handle at angle a, rear handle at b = a + sigma h on r = k theta (sigma = +1 walking inward, -1
outward), D = link / k. The cosine theorem a^2 + b^2 - 2 a b cos(b - a) = D^2 is the same equation,
but differs large numbers: its rounding error in h is about a^2 eps / F', and it stalls.

**The root found is the first one.** Let F(h) = h^2 + 4 a b sin^2(h/2), so that
F'/2 = h + 2 sigma a sin^2(h/2) + a b sin h.
* Inward all three terms are positive for 0 < h < pi: F grows. Where D <= 1.4 a the root lies below
  pi/2, as F(pi/2) > 4 a^2 sin^2(pi/4) = 2 a^2 > (1.4 a)^2; and from 2 a sin(h/2) < D and
  sin(x) >= x sin(pi/4) / (pi/4) follows h <= 1.1108 D / a (STEP_INWARD = 1.12).
* Outward, with a >= 4 and D <= 0.9 a: F(1.2) > 4 a (a - 1.2) sin^2(0.6) >= 0.8926 a^2 > (0.9 a)^2, so
  the root lies below 1.2. There F'/2 >= a sin h (b - tan(h/2)) with b >= 2.8 > tan(0.6): F grows. And
  from 2 sqrt(a b) sin(h/2) < D with b >= 0.7 a, sin(x) >= x sin(0.6) / 0.6 follows
  h <= 1.2702 D / a (STEP_OUTWARD = 1.30).

**One step is enough.** F grows like h^2 near the root, and Halley's step e leaves e^3 / (4 h^2). The
guess, the previous h times a / b and times the ratio of links, is off by 1e-5 rad at r = 4 m of the
contest's spiral and less outside, so one pass leaves less than a quarter of h's rounding; where the law
says it might not, the pass is repeated.

**Angles are sums of two doubles**, because a million roundings of theta add up.
"""

import math

import mpmath
import numpy as np

from benchdragon import Dragon, Route, Spiral, Walk
from benchdragon.kernels import spiral

K = 0.55 / (2.0 * math.pi)


def exact_step(a: float, d: float) -> mpmath.mpf:
    """The inward h in 40 digits."""
    with mpmath.workdps(40):
        a_, d_ = mpmath.mpf(a), mpmath.mpf(d)
        return mpmath.findroot(
            lambda h: h * h + 4 * a_ * (a_ + h) * mpmath.sin(h / 2) ** 2 - d_**2, d_ / a_
        )


def newton(a: float, d: float, stable: bool) -> float:
    """Newton's h in doubles, by the stable form or by the cosine theorem, until it stalls."""
    h = d / a
    for _pass in range(60):
        b = a + h
        slope = 2.0 * h + 4.0 * a * math.sin(0.5 * h) ** 2 + 2.0 * a * b * math.sin(h)
        if stable:
            error = h * h + 4.0 * a * b * math.sin(0.5 * h) ** 2 - d * d
        else:
            error = a * a + b * b - 2.0 * a * b * math.cos(b - a) - d * d
        h -= error / slope
    return h


def show_forms() -> None:
    """Error of each form where it stalls, in metres along the spiral."""
    print("error of one link, m:     theta     stable    cosine theorem")
    for a in (60.0, 600.0, 6000.0):
        d = 1.65 / K
        h = exact_step(a, d)
        errors = [abs(float(newton(a, d, stable) - h)) * K * a for stable in (True, False)]
        print(f"                       {a:8g}   {errors[0]:8.1e}   {errors[1]:8.1e}")


def show_bounds() -> None:
    """Largest h a / D and h over the whole region that the lanes accept, against the constants."""
    worst = {+1: [0.0, 0.0], -1: [0.0, 0.0]}
    slopes = {+1: math.inf, -1: math.inf}
    for sigma, most in ((+1, spiral.MOST_LINK_INWARD), (-1, spiral.MOST_LINK_OUTWARD)):
        for a in np.concatenate([np.linspace(spiral.LEAST_ANGLE, 12.0, 60), [50.0, 1e3, 1e6]]):
            h = np.linspace(1e-6, math.pi / 2.0 if sigma > 0 else 1.2, 2001)
            b = a + sigma * h
            f = h * h + 4.0 * a * b * np.sin(0.5 * h) ** 2
            inside = f <= (most * a) ** 2
            slope = h + 2.0 * sigma * a * np.sin(0.5 * h) ** 2 + a * b * np.sin(h)
            assert not inside[-1], "the root may lie beyond"
            worst[sigma][0] = max(worst[sigma][0], float((h * a / np.sqrt(f))[inside].max()))
            worst[sigma][1] = max(worst[sigma][1], float(h[inside].max()))
            slopes[sigma] = min(slopes[sigma], float((slope / h / a**2)[inside].min()))
    print(f"inward : h a / D <= {worst[1][0]:.4f} (bound {spiral.STEP_INWARD}), h <= {worst[1][1]:.3f}")
    print(
        f"outward: h a / D <= {worst[-1][0]:.4f} (bound {spiral.STEP_OUTWARD}), h <= {worst[-1][1]:.3f}"
    )
    print(f"least F' / (2 h a^2): inward {slopes[1]:.3f}, outward {slopes[-1]:.3f}: F grows")
    assert worst[1][0] <= spiral.STEP_INWARD
    assert worst[-1][0] <= spiral.STEP_OUTWARD
    assert min(slopes.values()) > 0.0


def show_halley() -> None:
    """What one Halley step from the previous handle's h leaves, against e^3 / (4 h^2)."""
    print("one Halley step:      r, m     guess off     left over     e^3 / (4 h^2)")
    d = 1.65 / K
    for a in (26.0, 50.0, 100.0):
        before = exact_step(a, d)
        b = a + float(before)
        h, exact = float(before) * a / b, exact_step(b, d)
        guess = h
        s2, rear = math.sin(0.5 * h) ** 2, b + h
        f = h * h + 4.0 * b * rear * s2 - d * d
        f1 = h + 2.0 * b * s2 + b * rear * math.sin(h)
        f2 = 1.0 + 2.0 * b * math.sin(h) + b * rear * math.cos(h)
        step = 2.0 * f * f1 / (4.0 * f1 * f1 - f * f2)
        left = abs(float(h - step - exact))
        law = abs(step) ** 3 / (4.0 * h * h)
        figures = (abs(guess - float(exact)), left, law)
        print(f"                   {K * b:7.2f}   " + "   ".join(f"{value:10.1e}" for value in figures))


def show_growth() -> None:
    """Error of the last handle after many links, theta carried in one double and in two."""
    links = 20_000
    with mpmath.workdps(30):
        k, d = mpmath.mpf("0.55") / (2 * mpmath.pi), mpmath.mpf("1.65")
        a = mpmath.mpf(32.0 * math.pi)
        h = (d / k) / a
        for _link in range(links):
            for _pass in range(3):
                s = mpmath.sin(h / 2)
                f = h * h + 4 * a * (a + h) * s * s - (d / k) ** 2
                h -= f / (2 * h + 4 * a * s * s + 2 * a * (a + h) * mpmath.sin(h))
            a, h = a + h, h * a / (a + h)
        x, y = float(k * a * mpmath.cos(a)), float(k * a * mpmath.sin(a))
    one = 32.0 * math.pi
    for _link in range(links):
        one += newton(one, 1.65 / K, True)
    plain = math.hypot(K * one * math.cos(one) - x, K * one * math.sin(one) - y)
    dragon = Dragon.uniform(links, head_length=2.2)
    motion = Walk(dragon, Route((Spiral(0.55, 32.0 * math.pi, 0.0),))).motion([0.0])
    double = math.hypot(motion.x[0, -1] - x, motion.y[0, -1] - y)
    print(f"after {links:,} links: one double {plain:.1e} m off, two doubles {double:.1e} m off")


if __name__ == "__main__":
    show_forms()
    show_bounds()
    show_halley()
    show_growth()
