"""Functions of a few numbers over a box of them, enclosed by balls with their slopes.

A form holds a function's value in the middle of the box, a ball of all its values, and balls of its
slopes, the partial derivatives (of functions with kinks, those on either side). By the mean value
theorem no value is farther from the middle's than slopes and the box allow; every step keeps the
smaller of that and of plain ball arithmetic.
"""

import math
from collections.abc import Sequence
from typing import Union

from flint import arb

ZERO, ONE = arb(0), arb(1)
ANY = arb(0, math.inf)
# Half widths are rounded up by this share.
ROUNDED_UP = 1.0 + 1e-15


class UnboundedError(Exception):
    """An enclosure failed; the text names it for developers."""


class Box:
    """Ranges of n numbers, and of one more, an unknown that is still sought.

    Args:
        low: the least of each.
        high: the greatest of each.
    """

    def __init__(self, low: Sequence[float], high: Sequence[float]) -> None:
        self.count = len(low)
        self.middle = [0.5 * (a + b) for a, b in zip(low, high, strict=True)]
        halves = (max(b - m, m - a) for a, b, m in zip(low, high, self.middle, strict=True))
        self.halves = [arb(0, half * ROUNDED_UP) if half > 0.0 else ZERO for half in halves]
        self.halves.append(ZERO)
        self._level = (ZERO,) * (self.count + 1)

    def number(self, k: int) -> "Form":
        """The k-th number itself."""
        half, middle = self.halves[k], arb(self.middle[k])
        return Form(self, middle, middle + half, self._level if half is ZERO else self._slope(k))

    def constant(self, value: arb | float) -> "Form":
        """What is the same all over the box."""
        ball = arb(value)
        return Form(self, ball, ball, self._level)

    def unknown(self, middle: arb, half: float) -> "Form":
        """The unknown, at most so far from a middle; what was made of the last one is then void."""
        self.halves[self.count] = arb(0, half)
        return Form(self, middle, middle + arb(0, half), self._slope(self.count))

    def _slope(self, k: int) -> tuple[arb, ...]:
        return (*self._level[:k], ONE, *self._level[k + 1 :])


class Form:
    """A function over a box.

    Attributes:
        box: over which.
        middle: a ball of its value in the middle.
        over: a ball of all its values.
        slopes: balls of its partial derivatives, the unknown's last.
    """

    __slots__ = ("box", "middle", "over", "slopes")

    def __init__(self, box: Box, middle: arb, over: arb, slopes: Sequence[arb]) -> None:
        self.box, self.middle, self.over, self.slopes = box, middle, over, tuple(slopes)

    def narrowed(self) -> "Form":
        """The same with no more values than the mean value theorem allows."""
        total = self.middle
        for slope, half in zip(self.slopes, self.box.halves, strict=True):
            if slope is not ZERO:
                total = total + slope * half
        if total.is_finite():
            over = self.over.intersection(total) if self.over.is_finite() else total
            return Form(self.box, self.middle, over, self.slopes)
        return self

    def with_slopes(self, slopes: Sequence[arb]) -> "Form":
        """The same with slopes that are known otherwise as well; the unknown has none."""
        both = [
            ZERO if half is ZERO else _common(a, b)
            for a, b, half in zip(self.slopes, slopes, self.box.halves, strict=False)
        ]
        return Form(self.box, self.middle, self.over, (*both, ZERO)).narrowed()

    def _of(self, middle: arb, over: arb, slope: arb) -> "Form":
        """A function of this one, by its own values and slope."""
        slopes = [ZERO if own is ZERO else slope * own for own in self.slopes]
        return Form(self.box, middle, over, slopes).narrowed()

    def __add__(self, other: Union["Form", arb, float]) -> "Form":
        if not isinstance(other, Form):
            return Form(self.box, self.middle + other, self.over + other, self.slopes)
        slopes = [
            b if a is ZERO else a if b is ZERO else a + b
            for a, b in zip(self.slopes, other.slopes, strict=True)
        ]
        return Form(self.box, self.middle + other.middle, self.over + other.over, slopes).narrowed()

    def __neg__(self) -> "Form":
        slopes = [ZERO if own is ZERO else -own for own in self.slopes]
        return Form(self.box, -self.middle, -self.over, slopes)

    def __sub__(self, other: Union["Form", arb, float]) -> "Form":
        return self + (-other)

    def __mul__(self, other: Union["Form", arb, float]) -> "Form":
        if not isinstance(other, Form):
            slopes = [ZERO if own is ZERO else own * other for own in self.slopes]
            return Form(self.box, self.middle * other, self.over * other, slopes)
        slopes = [
            _product(a, b, self.over, other.over)
            for a, b in zip(self.slopes, other.slopes, strict=True)
        ]
        return Form(self.box, self.middle * other.middle, self.over * other.over, slopes).narrowed()

    def inverse(self) -> "Form":
        """One divided by it."""
        over = 1 / self.over
        return self._of(1 / self.middle, over, -over * over)

    def square(self) -> "Form":
        """Its square."""
        over = (self.over * self.over).nonnegative_part()
        return self._of(self.middle * self.middle, over, 2 * self.over)

    def root(self) -> "Form":
        """Its square root; 0 where it is negative."""
        middle, over = (ball.nonnegative_part().sqrt() for ball in (self.middle, self.over))
        return self._of(middle, over, 1 / (2 * over) if self.over > 0 else ANY)

    def sine_cosine(self) -> tuple["Form", "Form"]:
        """Its sine and its cosine."""
        (sine, cosine), (s, c) = self.middle.sin_cos(), self.over.sin_cos()
        return self._of(sine, s, c), self._of(cosine, c, -s)

    def arctangent(self) -> "Form":
        """Its arctangent."""
        return self._of(self.middle.atan(), self.over.atan(), 1 / (1 + self.over * self.over))

    def hyperbolic(self) -> "Form":
        """The inverse of the hyperbolic sine."""
        slope = 1 / (1 + self.over * self.over).sqrt()
        return self._of(self.middle.asinh(), self.over.asinh(), slope)

    def exponential(self) -> "Form":
        """Its exponential."""
        over = self.over.exp()
        return self._of(self.middle.exp(), over, over)

    def least(self) -> float:
        """A double that is at most all its values; -inf where there is none."""
        low = self.over.lower()
        return math.nextafter(float(low), -math.inf) if low.is_finite() else -math.inf


def _product(a: arb, b: arb, first: arb, second: arb) -> arb:
    """Slope of a product of factors with slopes a and b."""
    if a is ZERO:
        return ZERO if b is ZERO else first * b
    return a * second if b is ZERO else a * second + first * b


def _common(a: arb, b: arb) -> arb:
    """What two balls of one number have in common; the finite one, if one is."""
    if a is ZERO or not b.is_finite():
        return a
    return a.intersection(b) if a.is_finite() else b


def angle_of(x: Form, y: Form) -> Form:
    """The angle of (x, y), rad."""
    square = x.over * x.over + y.over * y.over
    slopes = [
        ZERO if a is ZERO and b is ZERO else (x.over * b - y.over * a) / square
        for a, b in zip(x.slopes, y.slopes, strict=True)
    ]
    middle, over = arb.atan2(y.middle, x.middle), arb.atan2(y.over, x.over)
    return Form(x.box, middle, over, slopes).narrowed()


def either(forms: Sequence[Form], middles: Sequence[arb]) -> Form:
    """A continuous function that is one of these or another, all over the box.

    In the middle it has one of the values of `middles`.
    """
    middle, over, slopes = middles[0], forms[0].over, forms[0].slopes
    for ball in middles[1:]:
        middle = middle.union(ball)
    for form in forms[1:]:
        over = over.union(form.over)
        slopes = tuple(
            a if a is ZERO and b is ZERO else a.union(b)
            for a, b in zip(slopes, form.slopes, strict=True)
        )
    return Form(forms[0].box, middle, over, slopes).narrowed()
