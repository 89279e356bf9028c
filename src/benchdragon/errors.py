"""Everything that can go wrong, in words: checks at the door, and Status -> advice."""

import math

from benchdragon.kernels.status import Status
from benchdragon.messages import N_, _


class BenchDragonError(Exception):
    """The one above the rest; `exit_code` is what the command line ends with."""

    exit_code = 2


class InputError(BenchDragonError, ValueError):
    """A value that cannot be used: what was wanted, and what came."""


class WalkError(BenchDragonError):
    """A dragon that cannot stand on its route.

    Attributes:
        status: how it failed.
        bench: number of the bench, 1..N; 0 for the head's handle.
        s: route position of that bench's front handle, m.
        t: time, s.
        size: of the route, or of the bench's link, in words.
    """

    exit_code = 4

    def __init__(self, status: Status, bench: int, s: float, t: float, size: str) -> None:
        self.status, self.bench, self.s, self.t, self.size = status, bench, s, t, size
        super().__init__(status, bench, s, t, size)

    def __str__(self) -> str:
        """What went wrong, with advice, in the language in use."""
        return _(ADVICE[self.status]).format(
            bench=self.bench, s=f"{self.s:.6g}", t=f"{self.t:.6g}", size=self.size
        )


class UnsureError(BenchDragonError):
    """A question that could not be decided within the budget."""

    exit_code = 5


class MissingExtraError(BenchDragonError):
    """A library that an extra brings is not installed."""

    def __init__(self, extra: str) -> None:
        super().__init__(
            _("this needs an extra: pip install 'benchdragon[{extra}]'").format(extra=extra)
        )


ADVICE = {
    Status.BEFORE_ROUTE: N_(
        "at t = {t} s the head would stand at s = {s} m, before the route starts; begin the walk later "
        "or begin the route with a line or an inward spiral, which run on behind their start"
    ),
    Status.AFTER_ROUTE: N_(
        "at t = {t} s the head would stand at s = {s} m, past the end of the route ({size}); "
        "end the walk earlier or lengthen the route"
    ),
    Status.ROUTE_TOO_SHORT: N_(
        "at t = {t} s bench {bench} has no place: its front handle stands at s = {s} m and no point of "
        "the route behind it is one link ({size}) away; shorten the dragon, or begin the route with a "
        "line or an inward spiral, which run on behind their start"
    ),
    Status.FOLDED: N_(
        "at t = {t} s bench {bench} (link {size}) folds: with its front handle at s = {s} m it stands "
        "square to the route, where the speed ratio runs away; use gentler curves or shorter benches"
    ),
    Status.LINK_OVER_DIAMETER: N_(
        "at t = {t} s bench {bench} cannot follow an arc: with its front handle at s = {s} m its link "
        "({size}) is longer than the arc's diameter; use a larger radius or shorter benches"
    ),
}


def finite(name: str, value: float, unit: str = "") -> float:
    """`value`, if it is a finite number.

    Raises:
        InputError: if not.
    """
    number = as_number(name, value)
    if not math.isfinite(number):
        raise InputError(
            _("{name} must be finite, not {value}").format(name=name, value=_with(value, unit))
        )
    return number


def positive(name: str, value: float, unit: str = "") -> float:
    """`value`, if it is finite and above 0.

    Raises:
        InputError: if not.
    """
    number = finite(name, value, unit)
    if number <= 0.0:
        raise InputError(
            _("{name} must be positive, not {value}").format(name=name, value=_with(value, unit))
        )
    return number


def not_negative(name: str, value: float, unit: str = "") -> float:
    """`value`, if it is finite and at least 0.

    Raises:
        InputError: if not.
    """
    number = finite(name, value, unit)
    if number < 0.0:
        raise InputError(
            _("{name} must not be negative, but is {value}").format(name=name, value=_with(value, unit))
        )
    return number


def in_order(start: float, end: float) -> None:
    """Check two times, s.

    Raises:
        InputError: if one is not finite, or the end comes before the start.
    """
    if finite("end", end, "s") < finite("start", start, "s"):
        raise InputError(
            _("the end ({end} s) must not come before the start ({start} s)").format(
                end=f"{end:g}", start=f"{start:g}"
            )
        )


def as_number(name: str, value: object) -> float:
    """`value` as a float.

    Raises:
        InputError: if it is no number.
    """
    try:
        if isinstance(value, str | bytes | bool):
            raise TypeError
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InputError(
            _("{name} must be a number, not {value}").format(name=name, value=repr(value))
        ) from None


def _with(value: object, unit: str) -> str:
    return f"{value} {unit}".strip()
