"""Reading what users write behind options: times, sizes, handles, formats.

Light to import; numpy comes only with the times.
"""

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from benchdragon.errors import InputError, did_you_mean
from benchdragon.i18n import _
from benchdragon.plans.units import METRES, RANGE, SECONDS, SPEEDS, quantity

if TYPE_CHECKING:
    import numpy as np

# Times in one call: a day and more, each tenth of a second.
MOST_TIMES = 1_000_000
# Hours may be left out; what follows a colon is less than 60, or it was not meant as a clock time.
CLOCK = re.compile(r"([-+]?)(?:(\d{1,6}):(?=[0-5]?\d:))?(\d{1,6}):([0-5]?\d(?:\.\d*)?)", re.ASCII)
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", re.ASCII | re.IGNORECASE)
TABLE_FORMATS = ("xlsx", "csv", "npz", "parquet", "nc")
PICTURE_FORMATS = ("png", "svg", "pdf")
# Of drawings to scale.
PAPERS = ("A4", "A3", "A2", "A1", "A0")


def unreadable(wanted: str, option: str, text: str, **more: object) -> InputError:
    """What to say of a text behind an option, in a sentence with places for both."""
    return InputError(wanted.format(option=option, text=repr(text), **more))


def parse_times(text: str) -> "np.ndarray[Any, Any]":
    """Times and ranges of times, with commas: "12.5", "3:12", "90 s", "0..300..1"; s, (T,).

    Raises:
        InputError: for anything else, or more than MOST_TIMES.
    """
    import numpy as np

    found: list[float] = []
    for item in text.split(","):
        found.extend(_item_times(item.strip(), MOST_TIMES - len(found)))
    return np.array(found) + 0.0  # 0, not -0


def spread(start: float, stop: float, step: float = 1.0, *, room: int = MOST_TIMES) -> list[float]:
    """Times from `start` in steps until `stop`, s.

    Raises:
        InputError: if they never come to `stop`, or are more than `room`.
    """
    item = f"{start:.12g}..{stop:.12g}..{step:g}"
    if step == 0.0 or (stop - start) / step < 0.0:
        raise InputError(_("times {text} never get from start to stop").format(text=item))
    count = int(min((stop - start) / step + 1e-9, 1e18)) + 1
    if count > room:
        raise InputError(_("at most {most} times, not {text}").format(most=MOST_TIMES, text=item))
    return [start + step * i for i in range(count)]


def parse_time(option: str, text: str) -> float:
    """One time in "12.5", "3:12", "1:02:03" or "3 min 12 s", s.

    Raises:
        InputError: naming the option, for anything else.
    """
    found = _time(text.strip())
    if found is None:
        wanted = _(
            "{option}: expected seconds (12.5), a clock time (3:12 or 1:02:03) or units "
            "(3 min 12 s), not {text}"
        )
        raise unreadable(wanted, option, text)
    return found


def parse_length(option: str, text: str) -> float:
    """One length in "0.5", "1cm" or "50 cm", m.

    Raises:
        InputError: naming the option, for anything else.
    """
    found = _quantity(text.strip(), METRES)
    if found is None:
        wanted = _("{option}: expected a length in metres (0.5) or with a unit (50 cm), not {text}")
        raise unreadable(wanted, option, text)
    return found


def parse_speed(option: str, text: str) -> float:
    """One speed in "0.6" or "0.6 m/s", m/s; more than 0.

    Raises:
        InputError: naming the option, for anything else.
    """
    found = _quantity(text.strip(), SPEEDS)
    if found is None or found <= 0.0:
        wanted = _("{option}: expected a speed in m/s (0.6) or with a unit (2 km/h), not {text}")
        raise unreadable(wanted, option, text)
    return found


def parse_scale(option: str, text: str | None) -> float | None:
    """The 200 of a scale "1:200"; None where none is said.

    Raises:
        InputError: naming the option, for anything else.
    """
    if text is None:
        return None
    one, _colon, many = text.replace("：", ":").partition(":")
    if one.strip() != "1" or not NUMBER.fullmatch(many.strip()):
        raise unreadable(_("{option}: expected a scale such as 1:200, not {text}"), option, text)
    return float(many)


def parse_lengths(option: str, text: str) -> tuple[float, float]:
    """Two lengths in "0.4..0.6" or "40 cm..60 cm", m.

    Raises:
        InputError: naming the option, for anything else.
    """
    ends = [_quantity(end.strip(), METRES) for end in text.split(RANGE)]
    if len(ends) != 2 or ends[0] is None or ends[1] is None:
        wanted = _("{option}: expected two sizes in metres, LOW..HIGH (0.4..0.6), not {text}")
        raise unreadable(wanted, option, text)
    return ends[0], ends[1]


def parse_span(options: dict[str, Any]) -> tuple[float | None, float | None]:
    """What --start and --end say, s; None where they are not given.

    Raises:
        InputError: for anything but a time.
    """
    start, end = (
        None if options[name] is None else parse_time(f"--{name}", options[name])
        for name in ("start", "end")
    )
    return start, end


def parse_sides(option: str, text: str) -> tuple[int, int]:
    """Two whole numbers in "1920x1080".

    Raises:
        InputError: naming the option, for anything else.
    """
    try:
        across, down = (int(number) for number in text.lower().replace("×", "x").split("x"))
    except ValueError:
        wanted = _("{option}: expected two whole numbers with an x between, not {text}")
        raise unreadable(wanted, option, text) from None
    return across, down


def _item_times(item: str, room: int) -> Sequence[float]:
    numbers = [time for end in item.split(RANGE) if (time := _time(end.strip())) is not None]
    if len(numbers) != item.count(RANGE) + 1 or len(numbers) > 3:
        wanted = _(
            "--at: expected seconds (12.5), a clock time (3:12 or 1:02:03), units (3 min 12 s) or a "
            "range start..stop..step (0..300..1), not {text}"
        )
        raise unreadable(wanted, "--at", item)
    if len(numbers) == 1:
        return numbers
    return spread(numbers[0], numbers[1], *numbers[2:], room=room)


def _time(text: str) -> float | None:
    """A time, s; None for other text."""
    if found := CLOCK.fullmatch(text):
        sign, hours, minutes, seconds = found.groups()
        total = 3600.0 * int(hours or 0) + 60.0 * int(minutes) + float(seconds)
        return -total if sign == "-" else total
    return _quantity(text, SECONDS)


def _quantity(text: str, units: dict[str, float]) -> float | None:
    """A number, bare or with units, in the first of `units`; None unless finite."""
    bare = NUMBER.fullmatch(text)
    try:
        number = quantity(f"{text} {next(iter(units))}" if bare else text, units)
    except ValueError:
        return None
    return number if isinstance(number, float) and math.isfinite(number) else None


def check_ending(option: str, path: Path, endings: Sequence[str]) -> None:
    """Refuse a file's name whose ending belongs to another format.

    Raises:
        InputError: naming the option and the endings.
    """
    if path.suffix not in endings:
        text = _("{option}: expected a name that ends in {endings}, not {name}")
        raise InputError(text.format(option=option, endings=", ".join(endings), name=path.name))


def parse_handles(text: str | None, benches: int) -> list[int] | None:
    """Handle numbers in "1,51,101" or "0..5"; None where nothing was asked.

    Raises:
        InputError: for what is not the number of a handle.
    """
    if text is None:
        return None
    try:
        spans = [[int(end) for end in item.split(RANGE)] for item in text.split(",")]
    except ValueError:
        spans = [[-1]]
    for ends in spans:
        if len(ends) > 2 or not 0 <= ends[0] <= ends[-1] <= benches:
            wanted = _(
                "--only: expected handle numbers from 0 to {most} with commas, or a range (0..5), not "
                "{text}"
            )
            raise unreadable(wanted, "--only", text, most=benches)
    return [handle for ends in spans for handle in range(ends[0], ends[-1] + 1)]


def parse_names(option: str, text: str, known: Sequence[str]) -> list[str]:
    """Names in "csv,png", each once.

    Raises:
        InputError: naming the option, for one that is not known.
    """
    names = list(dict.fromkeys(name.strip() for name in text.split(",")))
    for name in names:
        if name not in known:
            wanted = _("{option}: expected some of {known}, not {text}").format(
                option=option, known=", ".join(known), text=repr(name)
            )
            raise InputError(wanted + did_you_mean(name, known))
    return names
