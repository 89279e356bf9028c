"""Reading what users write behind options: times, sizes, handles, formats.

Light to import; numpy comes only with the times.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from benchdragon.errors import InputError
from benchdragon.messages import _

if TYPE_CHECKING:
    import numpy as np

# Times in one call: a day and more, each tenth of a second.
MOST_TIMES = 1_000_000
TABLE_FORMATS = ("xlsx", "csv", "npz", "parquet", "nc")
PICTURE_FORMATS = ("png", "svg", "pdf")


def parse_times(text: str) -> "np.ndarray[Any, Any]":
    """Times in "12.5", "3:12", "0:300:1" or several of these with commas, s, (T,).

    Raises:
        InputError: for anything else, or more than MOST_TIMES.
    """
    import numpy as np

    found: list[float] = []
    for item in text.split(","):
        found.extend(_item_times(item.strip(), MOST_TIMES - len(found)))
    return np.array(found)


def parse_time(option: str, text: str) -> float:
    """One time in "12.5" or "3:12", s.

    Raises:
        InputError: naming the option, for anything else.
    """
    try:
        times = parse_times(text).tolist()
    except InputError:
        times = []
    if len(times) != 1:
        raise InputError(
            _("{option}: wanted seconds or minutes:seconds, not {text}").format(
                option=option, text=repr(text)
            )
        )
    return float(times[0])


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
        raise InputError(
            _("{option}: wanted two whole numbers with an x between, not {text}").format(
                option=option, text=repr(text)
            )
        ) from None
    return across, down


def _item_times(item: str, room: int) -> Sequence[float]:
    try:
        numbers = [float(number) for number in item.split(":")]
    except ValueError:
        numbers = []
    if not 1 <= len(numbers) <= 3 or any(number - number != 0.0 for number in numbers):
        raise InputError(
            _("--at: wanted seconds, minutes:seconds or start:stop:step, not {text}").format(
                text=repr(item)
            )
        )
    if len(numbers) == 1:
        return numbers
    if len(numbers) == 2:
        minutes, seconds = numbers
        return [minutes * 60.0 + (-seconds if item.startswith("-") else seconds)]
    start, stop, step = numbers
    if step == 0.0 or (stop - start) / step < 0.0:
        raise InputError(
            _("--at: {text} never gets from its start to its stop").format(text=repr(item))
        )
    count = int(min((stop - start) / step + 1e-9, 1e18)) + 1
    if count > room:
        raise InputError(_("--at: at most {most} times, not {text}").format(most=MOST_TIMES, text=item))
    return [start + step * i for i in range(count)]


def parse_handles(text: str | None, benches: int) -> list[int] | None:
    """Handle numbers in "1,51,101"; None where nothing was asked.

    Raises:
        InputError: for what is not the number of a handle.
    """
    if text is None:
        return None
    try:
        handles = [int(item) for item in text.split(",")]
    except ValueError:
        handles = [-1]
    if any(not 0 <= handle <= benches for handle in handles):
        raise InputError(
            _("--only: wanted handle numbers from 0 to {most} with commas, not {text}").format(
                most=benches, text=repr(text)
            )
        )
    return handles


def parse_formats(text: str) -> list[str]:
    """Names of formats in "csv,png".

    Raises:
        InputError: for one that is not known.
    """
    formats = [name.strip() for name in text.split(",")]
    unknown = [name for name in formats if name not in TABLE_FORMATS + PICTURE_FORMATS]
    if unknown:
        raise InputError(
            _("--format: wanted some of {known}, not {text}").format(
                known=", ".join(TABLE_FORMATS + PICTURE_FORMATS), text=repr(unknown[0])
            )
        )
    return formats
