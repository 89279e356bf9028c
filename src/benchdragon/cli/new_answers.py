"""What `new` asks, and answers as people type them: "120条", "一百二十", "30公分", "1米5"."""

import re
import unicodedata
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from benchdragon.cli.parsing import parse_length, unreadable
from benchdragon.errors import InputError
from benchdragon.i18n import N_, _
from benchdragon.rosters.words import NUMERALS, numeral

# What a bench may be at most, long, wide and beside its line, a square (m) and a speed (m/s): larger
# values are typing errors.
MOST_LENGTH, MOST_WIDTH, MOST_STRAY, MOST_SQUARE, MOST_SPEED = 20.0, 2.0, 1.0, 2_000.0, 10.0
# Half a metre more than another bench: a head's bench is often longer.
HEAD_LONGER = 0.5
# How bearers walk, as plans for it are made, and as answers to the question may say it.
CARRIES = {"beside": N_("beside"), "under": N_("under")}
# Signs in an answer that say it in Chinese, whatever else it says.
CARRY_SIGNS = {"旁": "beside", "边": "beside", "侧": "beside", "下": "under", "底": "under"}
ROUND = ("r", "半径")
COUNTED = re.compile(r"(?:个人|人|个|条|桥|节|张|块|benches|bench|people)$")
NUMBER = re.compile(rf"[{NUMERALS}]+")
# "1米5" is a metre and a half, "1米85" is 1.85 m.
METRES_AND = re.compile(r"(\d+)(?:米|m)(\d{1,2})(?:公分|厘米|cm)?$")
UNITS = {"公分": "厘米", "公尺": "米", "毫米": "mm"}
PER_SECOND = re.compile(r"(?:m/s|米/秒|米每秒|每秒|metres a second)")
# A number partly in digits and partly in words, which is read otherwise than it is meant: "100二十".
MIXED = re.compile(rf"[0-9]+[{NUMERALS}]+|[{NUMERALS}]+[0-9]+")
# What people remark behind an answer, and words by which they mean that it is not exact.
REMARK = re.compile(r"\([^()]*\)$")
ABOUT = re.compile(r"^(?:大约|大概|差不多|约|about)|(?:左右|上下)$")
# Spaces between two numbers, where nothing else parts length and width.
SPACED = re.compile(rf"(?<=[0-9{NUMERALS}米m])\s+(?=[0-9{NUMERALS}])")
BARE = re.compile(r"\d+(?:\.\d+)?")

Length = Callable[[str, str, str], float]
Read = Callable[[str, str, str], Any]


@dataclass(frozen=True)
class Question:
    """One thing to ask.

    Attributes:
        option: that says it.
        label: its name in prompts.
        text: the question.
        why: it is asked.
        usual: the default answer, from those before; None: there is none.
        read: reads an answer: its name, the text, an example.
        example: of an answer.
        keys: of the plan that the answer settles.
    """

    option: str
    label: str
    text: str
    why: str
    usual: Callable[[dict[str, Any]], str] | None
    read: Read
    example: str
    keys: tuple[str, ...]

    @property
    def name(self) -> str:
        """The parameter of its option."""
        return self.option.removeprefix("--").replace("-", "_")

    def answer(self, called: str, text: str) -> Any:
        """An answer, read.

        Raises:
            InputError: for one that cannot be read, beginning with its name.
        """
        mixed = MIXED.search(unicodedata.normalize("NFKC", text))
        if mixed:
            hint = _("{option}: {mixed} is partly in digits and partly in words: write {example}")
            raise InputError(hint.format(option=called, mixed=repr(mixed[0]), example=self.example))
        return self.read(called, text, self.example)

    def shown(self, value: Any) -> str:
        """An answer that was read, in the language in use."""
        if isinstance(value, tuple):
            return _("{length} m by {width} m").format(length=f"{value[0]:g}", width=f"{value[1]:g}")
        if isinstance(value, str):
            return _(CARRIES[value])
        if isinstance(value, int):
            return str(value)
        text = _("{value} m/s") if self.read is read_speed else _("{value} m")
        if self.read is read_square:
            text = _("radius {value} m")
        return text.format(value=f"{value:g}")


def plainly(text: str) -> str:
    """An answer in half-width signs and Arabic digits, without spaces: "一米八" is "1米8".

    Without what is remarked in brackets behind it, and without "about".
    """
    typed = "".join(unicodedata.normalize("NFKC", text).split()).lower().rstrip("。.,")
    typed = ABOUT.sub("", REMARK.sub("", typed) or typed)

    def digits(found: re.Match[str]) -> str:
        number = numeral(found[0])
        return found[0] if number is None else str(number)

    return NUMBER.sub(digits, typed)


def read_count(called: str, text: str, example: str) -> int:
    """A whole number of benches or bearers: "120", "120条", "一百二十"."""
    found = COUNTED.sub("", plainly(text))
    if not re.fullmatch(r"[0-9]+", found):
        wanted = _("{option}: expected a whole number such as {example}, not {text}")
        raise unreadable(wanted, called, text, example=example)
    return min(int(found[:9]), 10**9)


def read_benches(called: str, text: str, example: str) -> int:
    """How many benches, refused where no dance is proposed for so many."""
    from benchdragon.solve.proposal import MOST_BENCHES

    return _counted(called, text, example, 2, MOST_BENCHES)


def read_bearers(called: str, text: str, example: str) -> int:
    """How many carry a bench, refused if out of range."""
    from benchdragon.solve.proposal import MOST_BEARERS

    return _counted(called, text, example, 1, MOST_BEARERS)


def read_place(called: str, text: str, count: int) -> int:
    """A place in a list of so many, told by its number; from 0."""
    return _counted(called, text, "1", 1, count) - 1


def _counted(called: str, text: str, example: str, least: int, most: int) -> int:
    number = read_count(called, text, example)
    if not least <= number <= most:
        wanted = _("{option}: expected {least} to {most}, not {text}")
        raise unreadable(wanted, called, text, least=least, most=most)
    return number


def length_to(most: float, least: float = 0.01) -> Length:
    """A reader of lengths from `least` to `most`, m: "1.5", "150cm", "一米五", "30公分"."""

    def read(called: str, text: str, example: str) -> float:
        plain = plainly(text)
        for word, unit in UNITS.items():
            plain = plain.replace(word, unit)
        if split := METRES_AND.fullmatch(plain):
            plain = f"{split[1]}.{split[2]}"
        try:
            found = parse_length(called, plain)
        except InputError:
            found = -1.0
        if not least <= found <= most:
            if BARE.fullmatch(plain) and found > most:
                hint = _(
                    "{option}: {text} would be metres, at most {most}: write {text}cm for centimetres"
                )
                raise InputError(hint.format(option=called, text=plain, most=f"{most:g}"))
            wanted = _(
                "{option}: expected a length from {least} cm to {most} m, such as {example}, not {text}"
            )
            ends = {"least": f"{100.0 * least:g}", "most": f"{most:g}"}
            raise unreadable(wanted, called, text, example=example, **ends)
        return found

    return read


def read_speed(called: str, text: str, example: str) -> float:
    """A speed: "0.8", "0.8 m/s", "0.8米/秒"."""
    number = PER_SECOND.sub("", plainly(text)).removesuffix("米")
    try:
        found = float(number)
    except ValueError:
        found = -1.0
    if not 0.05 <= found <= MOST_SPEED:
        wanted = _("{option}: expected a speed of 0.05 to {most} m/s, such as {example}, not {text}")
        raise unreadable(wanted, called, text, most=f"{MOST_SPEED:g}", example=example)
    return found


def read_square(called: str, text: str, example: str) -> tuple[float, float] | float:
    """Length and width of a square, "30x20", "30米乘20米", "30 20"; or "r12", of a round one."""
    typed = unicodedata.normalize("NFKC", text).strip()
    spaced = SPACED.sub("x", typed)
    plain, read = plainly(spaced if len(SPACED.findall(typed)) == 1 else typed), length_to(MOST_SQUARE)
    for mark in ROUND:
        if plain.startswith(mark):
            return read(called, plain.removeprefix(mark), "r12")
    sides = re.sub(r"[长宽]", "", plain.replace("宽", "x", 1)) if "长" in plain else plain
    sides = re.sub(r"[×*乘,，]", "x", sides)
    parts = [part for part in sides.split("x") if part]
    if len(parts) != 2:
        wanted = _("{option}: expected length and width with an x between ({example}), not {text}")
        raise unreadable(wanted, called, text, example=example)
    return read(called, parts[0], "30"), read(called, parts[1], "20")


def read_carry(called: str, text: str, example: str) -> str:
    """How bearers walk, in either language, or its number in the question."""
    said = plainly(text)
    for number, (name, word) in enumerate(CARRIES.items(), start=1):
        if said in (name, _(word), str(number)):
            return name
    found = {name for sign, name in CARRY_SIGNS.items() if sign in said}
    if len(found) == 1:
        return found.pop()
    wanted = _("{option}: expected beside (1) or under (2), for example {example}, not {text}")
    raise unreadable(wanted, called, text, example=example)


def _always(text: str) -> Callable[[dict[str, Any]], str]:
    """The same, whatever was answered."""
    return lambda _said: text


def _head(said: dict[str, Any]) -> str:
    """The head's bench beside the others."""
    return f"{said['bench_length'] + HEAD_LONGER:g}"


QUESTIONS = (
    Question(
        "--benches", N_("Benches"), N_("How many benches, head and tail included?"),
        N_("the whole dragon, head and tail included"), None, read_benches, "120", ("dragon.benches",),
    ),
    Question(
        "--bench-length", N_("Length of a bench"),
        N_("How long is a bench, in metres (1.5, or 150cm)?"),
        N_("the dragon's length, and how tightly it can bend"), None, length_to(MOST_LENGTH), "1.5",
        ("dragon.body_length",),
    ),
    Question(
        "--bench-width", N_("Width of a bench"),
        N_("How wide is a bench, in metres (0.15, or 15cm)?"),
        N_("how near the rounds of the coil can lie"), None, length_to(MOST_WIDTH), "15cm",
        ("dragon.width",),
    ),
    Question(
        "--head-length", N_("Length of the head's bench"),
        N_("How long is the head's bench, in metres?"),
        N_("it carries the dragon's head, and is often longer"), _head, length_to(MOST_LENGTH), "2",
        ("dragon.head_length",),
    ),
    Question(
        "--inset", N_("From the end to the hole"),
        N_("How far are the holes from the ends of a bench, in metres?"),
        N_("benches swivel about the pins in their holes"), _always("0.15"), length_to(MOST_WIDTH),
        "15cm", ("dragon.front_inset", "dragon.rear_inset"),
    ),
    Question(
        "--square", N_("The square"),
        N_("How long and wide is the square, in metres (30x20; r12 if it is round, 12 m from its "
           "middle to its edge)?"),
        N_("the whole dance stays on it"), None, read_square, "30x20",
        ("venue.rectangle", "venue.boundary"),
    ),
    Question(
        "--bearers", N_("People at a bench"), N_("How many people carry a bench?"),
        N_("they need room along it"), _always("2"), read_bearers, "2", (),
    ),
    Question(
        "--carry", N_("Where they walk"), N_("Do they walk beside the bench (1) or under it (2)?"),
        N_("beside it they need more room between the rounds"), _always("1"), read_carry, "1", (),
    ),
    Question(
        "--speed", N_("Speed of the head"), N_("How fast may the head walk, in metres a second?"),
        N_("0.8 is a calm walk"), _always("0.8"), read_speed, "0.8", ("walk.speed",),
    ),
    Question(
        "--most-speed", N_("Greatest speed"),
        N_("How fast can a bench be carried at most, in metres a second?"),
        N_("those behind may have to be faster than the head"), _always("1.5"), read_speed, "1.5",
        ("people.most_speed", "limits.speed"),
    ),
    Question(
        "--sway", N_("Sway"),
        N_("How far does a bench sway to a side when it is carried ten steps, in metres?"),
        N_("it is assumed unless you measured it"), _always("5cm"), length_to(MOST_STRAY, 0.0), "5cm",
        ("people.sway",),
    ),
    Question(
        "--imprecision", N_("Imprecision"),
        N_("How far do bearers stray from a line that they follow, in metres?"),
        N_("it is assumed unless you measured it"), _always("10cm"), length_to(MOST_STRAY, 0.0), "10cm",
        ("people.imprecision",),
    ),
)  # fmt: skip
