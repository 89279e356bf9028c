"""All errors in words: checks of input, and Status -> advice."""

import difflib
import errno
import math
import re
import signal
import socket
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from operator import index
from typing import Any

from benchdragon.hosts.trouble import EngineError, Trouble
from benchdragon.i18n import N_, _
from benchdragon.kernels.status import Status

# Signs of a wrong value that are shown, and names that may have been meant.
MOST_SHOWN, MOST_MEANT = 80, 3


class BenchDragonError(Exception):
    """The base of all errors; `exit_code` is that of the command line.

    Examples:
        >>> issubclass(bd.PlanError, bd.BenchDragonError)
        True
    """

    exit_code = 2

    def __reduce__(self) -> tuple[Any, ...]:
        """As it is made again in another process: by what it holds, and not by what it was made of."""
        return _made_again, (type(self), self.args, self.__dict__)


def _made_again(
    kind: type[BenchDragonError], args: tuple[Any, ...], state: dict[str, Any]
) -> BenchDragonError:
    error = kind.__new__(kind, *args)
    error.__dict__.update(state)
    return error


class InputError(BenchDragonError, ValueError):
    """A value that cannot be used: what was expected, and what was given.

    Examples:
        >>> bd.Line(-1.0)
        Traceback (most recent call last):
            ...
        benchdragon.errors.InputError: length must be positive, not -1.0 m
    """


class WalkError(BenchDragonError):
    """A dragon that cannot stand on its route.

    Attributes:
        status: how it failed.
        bench: number of the bench, 1..N; 0 for the head's handle.
        s: route position of that bench's front handle, m.
        head: route position of the head's handle, m.
        size: of the route, or of the bench's link, in words.
        t: time, s; None where no walk says when.

    Examples:
        >>> bd.read_plan("spiral-in").motion(450.0)
        Traceback (most recent call last):
            ...
        benchdragon.errors.WalkError: at t = 450 s the head would walk past the end of the rou...
    """

    exit_code = 4

    def __init__(
        self, status: Status, bench: int, s: float, head: float, size: str, t: float | None = None
    ) -> None:
        super().__init__(status, bench, s, head, size, t)
        self.status, self.bench, self.s, self.head, self.size, self.t = status, bench, s, head, size, t

    def at(self, t: float) -> "WalkError":
        """The same error at a time, s; one that never comes stays untold."""
        when = t if math.isfinite(t) else None
        return WalkError(self.status, self.bench, self.s, self.head, self.size, when)

    def __str__(self) -> str:
        """What went wrong, with advice, in the language in use."""
        return advice(self)


class OpenError(BenchDragonError):
    """An undecided question: why, as a text of the catalogue, and the values of its places."""

    exit_code = 5

    def __init__(self, text: str, **words: object) -> None:
        super().__init__(text, words)

    def __str__(self) -> str:
        """Why, in the language in use."""
        text, words = self.args
        return _(text).format(**words) if words else _(text)


class UnsureError(OpenError):
    """A question that could not be decided within the budget.

    Examples:
        >>> issubclass(bd.UnsureError, bd.BenchDragonError)
        True
    """


class NoSolutionError(InputError):
    """There is no solution.

    Examples:
        >>> issubclass(bd.NoSolutionError, bd.InputError)
        True
    """

    exit_code = 4


class MachineError(BenchDragonError):
    """A failure of the machine: a disk that is full, memory that ran out."""

    exit_code = 6


class MissingExtraError(BenchDragonError):
    """A library that an extra brings is not installed."""

    def __init__(self, extra: str) -> None:
        text = _("this needs an extra: pip install 'benchdragon[{extra}]'")
        super().__init__(text.format(extra=extra))


@contextmanager
def brought_by(extra: str) -> Iterator[None]:
    """Import what an extra brings.

    Raises:
        MissingExtraError: if it is not installed.
    """
    try:
        yield
    except ImportError:
        raise MissingExtraError(extra) from None


ADVICE = {
    Status.BEFORE_ROUTE: N_(
        "{when} the head would stand at s = {s} m, before the route starts; begin the walk later "
        "or begin the route with a line or an inward spiral, which run on behind their start"
    ),
    Status.AFTER_ROUTE: N_(
        "{when} the head would walk past the end of the route, which is {size} long (s = {s} m); "
        "end the walk earlier or lengthen the route"
    ),
    Status.ROUTE_TOO_SHORT: N_(
        "{when} bench {bench} has no place: its front handle stands at s = {s} m and no point of "
        "the route behind it is one link ({size}) away; shorten the dragon, or begin the route with a "
        "line or an inward spiral, which run on behind their start"
    ),
    Status.FOLDED: N_(
        "{when} bench {bench} (link {size}) folds: with its front handle at s = {s} m it stands "
        "square to the route, where the speed ratio runs away; end the walk before that (in a plan by "
        "disc.radius or walk.end), or use gentler curves or shorter benches"
    ),
    Status.LINK_OVER_DIAMETER: N_(
        "{when} bench {bench} cannot follow an arc: with its front handle at s = {s} m its link "
        "({size}) is longer than the arc's diameter; use a larger radius or shorter benches"
    ),
}


def advice(error: WalkError) -> str:
    """What went wrong with a walk, and what to do, in the language in use."""
    if error.t is None:
        when = _("with the head at s = {head} m").format(head=f"{error.head:.6g}")
    else:
        when = _("at t = {t} s").format(t=f"{error.t:.6g}")
    text = _(ADVICE[error.status])
    return text.format(when=when, bench=error.bench, s=f"{error.s:.6g}", size=error.size)


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """What a half or mistyped word may have meant: "; did you mean route.pitch?", or nothing.

    A name is meant by a whole part of it, by how one begins, or by most signs of one, in this order.
    """
    low = word.casefold().lstrip("-")
    parts = {name: {name.casefold(), *re.split(r"[-./ ]+", name.casefold())} - {""} for name in known}
    found = [name for name, of in parts.items() if low in of]
    found = found or [name for name, of in parts.items() if low and any(p.startswith(low) for p in of)]
    if not found:
        near = difflib.get_close_matches(low, set[str]().union(*parts.values()), 1)
        found = [name for name, of in parts.items() if not of.isdisjoint(near)]
    names = _(", or ").join(found[:MOST_MEANT])
    return _("; did you mean {name}?").format(name=names) if found else ""


ENGINE_ADVICE = {
    Trouble.UNKNOWN: N_("BENCHDRAGON_ENGINE must be native, wasm or plain, not '{detail}'"),
    Trouble.NO_LIBRARY: N_(
        "BENCHDRAGON_ENGINE is native, but no library here was built from these kernels for this "
        "processor: build it by `python -m benchdragon.engine`, or unset the variable"
    ),
    Trouble.OTHER_SOURCES: N_(
        "the kernels here were changed after engine.wasm was built from them: rebuild it by `make "
        "wasm`, or the library by `make engine`, or set BENCHDRAGON_ENGINE=plain to run them as Python"
    ),
    Trouble.NO_WASMTIME: N_(
        "Wasmtime does not run here ({detail}): install the package wasmtime again, or build the "
        "library by `python -m benchdragon.engine`, or set BENCHDRAGON_ENGINE=plain, which is very slow"
    ),
    Trouble.BROKEN_OFF: N_("the engine failed, which is a bug: {detail}"),
}


def engine_advice(error: EngineError) -> BenchDragonError:
    """What to do about an engine that cannot serve."""
    kind = MachineError if error.trouble is Trouble.BROKEN_OFF else InputError
    return kind(_(ENGINE_ADVICE[error.trouble]).format(detail=error.detail))


# The system's own texts, for translation.
REASONS = {
    errno.EPERM: N_("that is not permitted"),
    errno.EACCES: N_("permission denied"),
    errno.ENOENT: N_("there is no such file or folder"),
    errno.EIO: N_("the device failed"),
    errno.EBADF: N_("it is closed"),
    errno.ENOMEM: N_("memory ran out"),
    errno.EBUSY: N_("it is in use"),
    errno.EEXIST: N_("it is there already"),
    errno.ENODEV: N_("there is no such device"),
    errno.ENOTDIR: N_("it is not a folder"),
    errno.EISDIR: N_("it is a folder"),
    errno.EINVAL: N_("it does not take that"),
    errno.EMFILE: N_("too many files are open"),
    errno.EFBIG: N_("the file would be larger than is allowed"),
    errno.ENOSPC: N_("the disk is full"),
    errno.EROFS: N_("the disk can only be read"),
    errno.ELOOP: N_("links lead in a circle"),
    errno.ENAMETOOLONG: N_("the name is too long"),
    errno.EADDRINUSE: N_("the address is in use"),
    errno.EADDRNOTAVAIL: N_("this machine does not have that address"),
    socket.EAI_NONAME: N_("there is no machine of that name"),
}


def reason(error: OSError) -> str:
    """Why the system refused, in the language in use."""
    if error.errno in REASONS:
        return _(REASONS[error.errno])
    if error.errno is None:
        return str(error)
    return _("system error {number}").format(number=f"{error.errno} ({error.strerror})")


def pipe_closed(error: OSError) -> bool:
    """Whether the reader of a pipe is gone: EPIPE, or EINVAL on Windows."""
    return error.errno == errno.EPIPE or (
        error.errno == errno.EINVAL and error.filename is None and not hasattr(signal, "SIGPIPE")
    )


def finite(name: str, value: float, unit: str = "") -> float:
    """`value`, if it is a finite number.

    Raises:
        InputError: if not.
    """
    number = as_number(name, value)
    if not math.isfinite(number):
        text = _("{name} must be finite, not {value}")
        raise InputError(text.format(name=name, value=_with(value, unit)))
    return number


def positive(name: str, value: float, unit: str = "") -> float:
    """`value`, if it is finite and above 0.

    Raises:
        InputError: if not.
    """
    number = finite(name, value, unit)
    if number <= 0.0:
        text = _("{name} must be positive, not {value}")
        raise InputError(text.format(name=name, value=_with(value, unit)))
    return number


def not_negative(name: str, value: float, unit: str = "") -> float:
    """`value`, if it is finite and at least 0.

    Raises:
        InputError: if not.
    """
    number = finite(name, value, unit)
    if number < 0.0:
        text = _("{name} must not be negative, but is {value}")
        raise InputError(text.format(name=name, value=_with(value, unit)))
    return number


def in_order(start: float, end: float) -> None:
    """Check two times, s.

    Raises:
        InputError: if one is not finite, or the end comes before the start.
    """
    if finite("end", end, "s") < finite("start", start, "s"):
        text = _("the end ({end} s) must not come before the start ({start} s)")
        raise InputError(text.format(end=f"{end:g}", start=f"{start:g}"))


def as_number(name: str, value: object) -> float:
    """`value` as a float.

    Raises:
        InputError: if it is no number.
    """
    try:
        if isinstance(value, str | bytes | bool):
            raise TypeError
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        text = _("{name} must be a number, not {value}")
        raise InputError(text.format(name=name, value=brief(value))) from None


def of_kind(name: str, value: object, kind: type, hint: str = "") -> None:
    """Check that `value` is a `kind`; `hint` says how to make one.

    Raises:
        InputError: if not.
    """
    if not isinstance(value, kind):
        text = _("{name} must be a {kind}, not {value}")
        said = text.format(name=name, kind=kind.__name__, value=brief(value))
        raise InputError(f"{said}: {hint}" if hint else said)


def whole(name: str, value: object, least: int, most: int) -> int:
    """`value`, if it is a whole number from `least` to `most`.

    Raises:
        InputError: if not.
    """
    try:
        number = index(value)  # type: ignore[arg-type]
    except TypeError:
        number = least - 1
    if not least <= number <= most:
        text = _("{name} must be a whole number from {least} to {most}, not {value}")
        raise InputError(text.format(name=name, least=least, most=most, value=brief(value)))
    return number


def brief(value: object) -> str:
    """A value as Python writes it, cut short; a number of thousands of digits is not written at all."""
    try:
        return repr(value)[:MOST_SHOWN]
    except (ValueError, RecursionError):
        return _("something too long to be shown")


def _with(value: object, unit: str) -> str:
    return f"{value} {unit}".strip()
