"""What villages are asked, and answers as people type them: "120条", "一百二十", "30公分", "1米5"."""

import math
import re
import unicodedata
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from benchdragon.errors import InputError
from benchdragon.i18n import N_, _
from benchdragon.plans.units import ACCELERATIONS, ANGULAR_SPEEDS, METRES, SECONDS, SPEEDS, quantity
from benchdragon.rosters.words import NUMERALS, numeral

# Of so many benches, with so many people at each, dances are proposed.
MOST_BENCHES, MOST_BEARERS = 500, 8
# What a bench may be at most, long, wide and beside its line, a square (m) and a speed (m/s): larger
# values are typing errors.
MOST_LENGTH, MOST_WIDTH, MOST_STRAY, MOST_SQUARE, MOST_SPEED = 20.0, 2.0, 1.0, 2_000.0, 10.0
# How bearers walk, as plans for it are made, and as answers to the question may say it.
CARRIES = {"beside": N_("beside"), "under": N_("under")}
# Signs in an answer that say it in Chinese, whatever else it says.
CARRY_SIGNS = {"旁": "beside", "边": "beside", "侧": "beside", "下": "under", "底": "under"}
ROUND = re.compile(r"^(?:r|半径)")
# The units that may stand behind a number, by that in which it is to be.
UNITS = {
    "m": METRES, "s": SECONDS, "m/s": SPEEDS | {"米": 1.0, "每秒": 1.0}, "m/s²": ACCELERATIONS,
    "°/s": ANGULAR_SPEEDS,
}  # fmt: skip
COUNTED = re.compile(r"(?:个人|人|个|条|桥|节|张|块|benches|bench|people)$")
EACH_SECOND = re.compile(r"^每秒")
NUMERAL = re.compile(rf"[{NUMERALS}]+")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?", re.ASCII)
# "1米5" is a metre and a half, "1米85" is 1.85 m.
METRES_AND = re.compile(r"(\d+)(?:米|m)(\d{1,2})(?:公分|厘米|cm)?", re.ASCII)
# A number partly in digits and partly in words, which is read otherwise than it is meant: "100二十".
MIXED = re.compile(rf"[0-9]+[{NUMERALS}]+|[{NUMERALS}]+[0-9]+")
# Two numbers, or the same unit behind two: either may be meant.
TWO = re.compile(r"[0-9.]\s+[0-9.]|([^0-9.\s]+)[0-9.]+\1$")
# What people remark behind an answer, by which words they mean that it is not exact, and its end.
REMARK = re.compile(r"(?<=.)\([^()]*\)$")
ABOUT = re.compile(r"^(?:大约|大概|差不多|约|about)|(?:左右|上下)$")
ENDED = re.compile(r"[。.,]+$")
# Spaces between two numbers, where nothing else parts length and width.
SPACED = re.compile(rf"(?<=[0-9{NUMERALS}米m])\s+(?=[0-9{NUMERALS}])")
TIMES = re.compile(r"[×*乘,，]")


def plainly(text: str) -> str:
    """An answer in half-width signs and Arabic digits, without spaces: "一米八" is "1米8".

    Without what is remarked in brackets behind it, and without "about".
    """
    typed = "".join(unicodedata.normalize("NFKC", text).replace("\u2212", "-").split()).lower()
    typed = ABOUT.sub("", REMARK.sub("", ENDED.sub("", typed)))

    def digits(found: re.Match[str]) -> str:
        number = numeral(found[0])
        return found[0] if number is None else str(number)

    return NUMERAL.sub(digits, typed)


def number_in(text: str, unit: str) -> float | None:
    """The number that a text says, in a unit of UNITS or "" of a count; None: it says none for sure."""
    said = unicodedata.normalize("NFKC", text).strip().lower()
    if MIXED.search(said) or TWO.search(said):
        return None
    plain = EACH_SECOND.sub("", plainly(said)) if unit == "m/s" else plainly(said)
    plain = plain if unit else COUNTED.sub("", plain)
    parts = METRES_AND.fullmatch(plain) if unit == "m" else None
    if parts:
        plain = f"{parts[1]}.{parts[2]}"
    try:
        number = float(plain) if NUMBER.fullmatch(plain) else quantity(plain, UNITS.get(unit, {}))
    except ValueError:
        return None
    return number if isinstance(number, float) and math.isfinite(number) else None


def _refused(
    wanted: str, called: str, text: str, example: str = "", least: float = 0.0, most: float = 0.0
) -> InputError:
    """What to say of an answer, in a sentence with places for what was expected."""
    ends = {"least": f"{least:g}", "most": f"{most:g}"}
    return InputError(wanted.format(option=called, text=repr(text), example=example, **ends))


def count_in(called: str, text: str, example: str, least: float, most: float) -> int:
    """A whole number of benches or bearers: "120", "120条", "一百二十".

    Raises:
        InputError: unless it is one from `least` to `most`; it begins with what it is `called`.
    """
    found = number_in(text, "")
    if found is None or found != math.floor(found) or found < 0.0:
        wanted = _("{option}: expected a whole number such as {example}, not {text}")
        raise _refused(wanted, called, text, example)
    if not least <= found <= most:
        wanted = _("{option}: expected {least} to {most}, not {text}")
        raise _refused(wanted, called, text, example, least, most)
    return int(found)


def _length_in(called: str, text: str, example: str, least: float, most: float) -> float:
    """A length, m: "1.5", "150cm", "一米五", "30公分"."""
    found = number_in(text, "m")
    if found is not None and least <= found <= most:
        return found
    plain = plainly(text)
    if found is not None and found > most and NUMBER.fullmatch(plain):
        hint = _("{option}: {text} would be metres, at most {most}: write {text}cm for centimetres")
        raise InputError(hint.format(option=called, text=plain, most=f"{most:g}"))
    wanted = _("{option}: expected a length from {least} cm to {most} m, such as {example}, not {text}")
    raise _refused(wanted, called, text, example, 100.0 * least, most)


def _speed_in(called: str, text: str, example: str, least: float, most: float) -> float:
    """A speed, m/s: "0.8", "0.8 m/s", "0.8米/秒"."""
    found = number_in(text, "m/s")
    if found is None or not least <= found <= most:
        wanted = _("{option}: expected a speed of 0.05 to {most} m/s, such as {example}, not {text}")
        raise _refused(wanted, called, text, example, least, most)
    return found


def _square_in(called: str, text: str, example: str, least: float, most: float) -> Any:
    """Length and width of a square, "30x20", "30米乘20米", "30 20"; or its radius, "r12"."""
    typed = unicodedata.normalize("NFKC", text).strip()
    plain = plainly(SPACED.sub("x", typed) if len(SPACED.findall(typed)) == 1 else typed)
    if ROUND.match(plain):
        return _length_in(called, ROUND.sub("", plain), "r12", least, most)
    sides = plain.replace("宽", "x").replace("长", "") if "长" in plain else plain
    parts = [part for part in TIMES.sub("x", sides).split("x") if part]
    if len(parts) != 2:
        wanted = _("{option}: expected length and width with an x between ({example}), not {text}")
        raise _refused(wanted, called, text, example)
    first, second = parts
    return _length_in(called, first, "30", least, most), _length_in(called, second, "20", least, most)


def _carry_in(called: str, text: str, example: str) -> str:
    """How bearers walk, in either language, or its number in the question."""
    said = plainly(text)
    for number, (name, word) in enumerate(CARRIES.items(), start=1):
        if said in (name, _(word), str(number)):
            return name
    found = sorted({name for sign, name in CARRY_SIGNS.items() if sign in said})
    if len(found) == 1:
        return found[0]
    wanted = _("{option}: expected beside (1) or under (2), for example {example}, not {text}")
    raise _refused(wanted, called, text, example)


@dataclass(frozen=True)
class Question:
    """One thing to ask.

    Attributes:
        option: that says it.
        label: its name in prompts.
        text: the question.
        why: it is asked.
        kind: what it asks for: "count", "length", "speed", "square" or "carry".
        example: of an answer.
        keys: of the plan that the answer settles.
        usually: the default answer, "" if there is none; "+0.5": a bench and so much.
        least, most: what an answer may be.
    """

    option: str
    label: str
    text: str
    why: str
    kind: str
    example: str
    keys: tuple[str, ...]
    usually: str = ""
    least: float = 0.01
    most: float = 0.0

    @property
    def name(self) -> str:
        """The parameter of its option."""
        return self.option[2:].replace("-", "_")

    def usual(self, said: dict[str, Any]) -> str:
        """The default answer, from those before."""
        if self.usually.startswith("+"):
            return f"{said['bench_length'] + float(self.usually):g}"
        return self.usually

    def answer(self, called: str, text: str) -> Any:
        """An answer, read.

        Raises:
            InputError: for one that cannot be read, beginning with its name.
        """
        mixed = MIXED.search(unicodedata.normalize("NFKC", text))
        if mixed:
            hint = _("{option}: {mixed} is partly in digits and partly in words: write {example}")
            raise InputError(hint.format(option=called, mixed=repr(mixed[0]), example=self.example))
        if self.kind == "carry":
            return _carry_in(called, text, self.example)
        if self.kind == "count":
            return count_in(called, text, self.example, self.least, self.most)
        if self.kind == "square":
            return _square_in(called, text, self.example, self.least, self.most)
        if self.kind == "speed":
            return _speed_in(called, text, self.example, self.least, self.most)
        return _length_in(called, text, self.example, self.least, self.most)

    def shown(self, value: Any) -> str:
        """An answer that was read, in the language in use."""
        if isinstance(value, tuple):
            return _("{length} m by {width} m").format(length=f"{value[0]:g}", width=f"{value[1]:g}")
        if isinstance(value, str):
            return _(CARRIES[value])
        if isinstance(value, int):
            return str(value)
        text = _("{value} m/s") if self.kind == "speed" else _("{value} m")
        if self.kind == "square":
            text = _("radius {value} m")
        return text.format(value=f"{value:g}")


QUESTIONS = (
    Question(
        "--benches", N_("Benches"), N_("How many benches, head and tail included?"),
        N_("the whole dragon, head and tail included"), "count", "120", ("dragon.benches",), "", 2,
        MOST_BENCHES,
    ),
    Question(
        "--bench-length", N_("Length of a bench"),
        N_("How long is a bench, in metres (1.5, or 150cm)?"),
        N_("the dragon's length, and how tightly it can bend"), "length", "1.5",
        ("dragon.body_length",), most=MOST_LENGTH,
    ),
    Question(
        "--bench-width", N_("Width of a bench"),
        N_("How wide is a bench, in metres (0.15, or 15cm)?"),
        N_("how near the rounds of the coil can lie"), "length", "15cm", ("dragon.width",),
        "20cm", most=MOST_WIDTH,
    ),
    Question(
        "--head-length", N_("Length of the head's bench"),
        N_("How long is the head's bench, in metres?"),
        N_("it carries the dragon's head, and is often longer"), "length", "2",
        ("dragon.head_length",), "+0.5", most=MOST_LENGTH,
    ),
    Question(
        "--inset", N_("From the end to the hole"),
        N_("How far are the holes from the ends of a bench, in metres?"),
        N_("benches swivel about the pins in their holes"), "length", "15cm",
        ("dragon.front_inset", "dragon.rear_inset"), "0.15", most=MOST_WIDTH,
    ),
    Question(
        "--square", N_("The square"),
        N_("How long and wide is the square, in metres (30x20; r12 if it is round, 12 m from its "
           "middle to its edge)?"),
        N_("the whole dance stays on it"), "square", "30x20", ("venue.rectangle", "venue.boundary"),
        most=MOST_SQUARE,
    ),
    Question(
        "--bearers", N_("People at a bench"), N_("How many people carry a bench?"),
        N_("they need room along it"), "count", "2", (), "2", 1, MOST_BEARERS,
    ),
    Question(
        "--carry", N_("Where they walk"), N_("Do they walk beside the bench (1) or under it (2)?"),
        N_("beside it they need more room between the rounds"), "carry", "1", (), "1",
    ),
    Question(
        "--speed", N_("Speed of the head"), N_("How fast may the head walk, in metres a second?"),
        N_("0.8 is a calm walk"), "speed", "0.8", ("walk.speed",), "0.8", 0.05, MOST_SPEED,
    ),
    Question(
        "--most-speed", N_("Greatest speed"),
        N_("How fast can a bench be carried at most, in metres a second?"),
        N_("those behind may have to be faster than the head"), "speed", "1.5",
        ("people.most_speed", "limits.speed"), "1.5", 0.05, MOST_SPEED,
    ),
    Question(
        "--sway", N_("Sway"),
        N_("How far does a bench sway to a side when it is carried ten steps, in metres?"),
        N_("it is assumed unless you measured it"), "length", "5cm", ("people.sway",), "5cm", 0.0,
        MOST_STRAY,
    ),
    Question(
        "--imprecision", N_("Imprecision"),
        N_("How far do bearers stray from a line that they follow, in metres?"),
        N_("it is assumed unless you measured it"), "length", "10cm", ("people.imprecision",), "10cm",
        0.0, MOST_STRAY,
    ),
)  # fmt: skip


def wished(said: Mapping[str, Any], given: Collection[str]) -> dict[str, Any]:
    """The answers by the names of what is wished for; those that were given are no assumptions."""
    square = said["square"]
    is_round = isinstance(square, float)
    return {
        "benches": said["benches"], "length": said["bench_length"], "width": said["bench_width"],
        "head_length": said["head_length"], "inset": said["inset"],
        "rectangle": None if is_round else square, "radius": square if is_round else None,
        "bearers": said["bearers"], "carry": said["carry"], "speed": said["speed"],
        "most_speed": said["most_speed"], "sway": said["sway"], "imprecision": said["imprecision"],
        "measured": [name for name in ("sway", "imprecision") if name in given],
    }  # fmt: skip
