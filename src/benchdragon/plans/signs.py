"""Full-width characters of a Chinese input method where a plan file needs ASCII."""

import re
import unicodedata

# Characters typed, and those that a plan file needs; Unicode names further full-width ones.
PLAIN = {
    "“": '"', "”": '"', "„": '"', "‘": "'", "’": "'", "「": '"', "」": '"', "，": ",", "、": ",",
    "。": ".", "【": "[", "】": "]", "—": "-", "–": "-", "−": "-", "\u3000": " ",
}  # fmt: skip
QUOTES = "\"'"
# A time of day in plain signs: hours, minutes, perhaps seconds.
TIME_OF_DAY = re.compile(r"([01]?\d|2[0-3]):([0-5]\d)(?::([0-5]\d))?", re.ASCII)


def mistyped(line: str) -> tuple[int, str, str] | None:
    """The first such sign of a line outside its texts and its comment; None if there is none.

    If a text is not closed, the last quotation mark of the other kind in it.

    Returns:
        Its column, from 1; the sign; what to type instead.
    """
    opened = ""
    last: tuple[int, str, str] | None = None
    for column, sign in enumerate(line, start=1):
        plain = PLAIN.get(sign) or _narrow(sign)
        if opened:
            last = (column, sign, plain) if plain == opened and sign != opened else last
            opened = "" if sign == opened else opened
        elif sign == "#":
            return None
        elif sign in QUOTES:
            opened, last = sign, None
        elif plain:
            return column, sign, plain
    return last if opened else None


def narrow(text: str) -> str:
    """A text with plain signs and digits in place of full-width ones; all others stay as they are."""
    return "".join(_narrow(sign) or (" " if sign == "\u3000" else sign) for sign in text)


def _narrow(sign: str) -> str:
    """The plain form of a full-width sign; "" of any other."""
    return unicodedata.normalize("NFKC", sign) if "\uff01" <= sign <= "\uff5e" else ""
