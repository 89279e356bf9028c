"""What people write into the cells of a list: numbers of benches, names, phones, headings."""

import re
import unicodedata
from dataclasses import dataclass
from typing import Literal

Kind = Literal["number", "name", "household", "phone", "remarks"]

# What columns are called, in lower case and without spaces; of two columns of numbers the one holds
# whose heading stands first here.
SPELLINGS: dict[Kind, str] = {
    "number": """
        板凳号 板凳编号 凳号 桥号 节号 第几桥 第几节 桥次 节次 板号 龙身号 桥 节 板凳 凳 号 bench
        benchno benchnumber qiao jie section number no nr # 编号 号码 序号
    """,
    "name": """
        姓名 名字 名单 人名 人员 队员 成员 人员姓名 队员姓名 抬龙人 扛龙人 舞龙人 迎龙人 抬凳人 扛凳人
        参加人 参与人 name names fullname bearer bearers person people carrier carriers carriedby
    """,
    "household": "户 户主 户名 户主姓名 家庭 家庭户 人家 household householder family house home",
    "phone": """
        电话 手机 联系电话 联系方式 手机号 手机号码 电话号码 联系手机 phone phonenumber phoneno mobile
        mobilephone tel telephone cell contact
    """,
    "remarks": "备注 说明 附注 注 其他 remarks remark notes note comments comment",
}
HEADINGS = {kind: tuple(words.split()) for kind, words in SPELLINGS.items()}
SUMS = re.compile(
    r"(合计|总计|共计|小计|总数|总人数|合共|(total|sum|subtotal)(?![a-z])|共.{0,4}[0-9]+.{0,3}$)"
)
NO_NAMES = "无 空 空缺 缺 暂缺 暂无 待定 未定 没有 tbd n/a na none nobody ? ?? - -- — —— /"
# What spreadsheets write into cells whose formula failed.
ERRORS = "#n/a #ref! #name? #value! #div/0! #num! #null! #getting_data #spill! #calc! err:502 err:508"
NOBODY = frozenset([*NO_NAMES.split(), *ERRORS.split()])
HEADS, TAILS = ("龙头", "龙首", "头", "head", "thehead"), ("龙尾", "尾", "尾巴", "tail", "thetail")
DIGITS = {sign: n for n, sign in enumerate("零一二三四五六七八九")} | {
    sign: n for n, sign in enumerate("〇壹贰叁肆伍陆柒捌玖")
} | {"两": 2}  # fmt: skip
TENS = {"十": 10, "百": 100, "千": 1000, "拾": 10, "佰": 100, "仟": 1000}
NUMERALS = "".join([*DIGITS, *TENS, "廿卅"])
ITEM = re.compile(
    r"(?:第|bench|benches|qiao|jie|section|number|no\.?|nr\.?|#)*"
    rf"([0-9]{{1,9}}(?:\.0+)?|[{NUMERALS}]{{1,9}})号?(?:板凳|桥|节|凳|块|条|张)?号?"
)
# 一百二 may be 102 or 120.
SHORTENED = re.compile("[百千佰仟][一二三四五六七八九]$")
TO, AND = re.compile(r"[-~–—‒−]+|至|到|to"), re.compile(r"[、,;/&+\s]|和|及|与|and")
PHONE = re.compile(
    r"(?<![0-9])(?:(?:\+?86[- ]?)?1[0-9]{2}[- ]?[0-9]{4}[- ]?[0-9]{4}"
    r"|0[0-9]{2,3}[- ]?[0-9]{7,8}|\+?[0-9](?:[-() ]{0,2}[0-9]){6,14})(?![0-9])"
)
PARTS = re.compile(r"[、，,;；/／|\\\n\r\t+＋&＆]+")
# Family names of two signs, after which one sign is a given name.
TWO_SIGNS = frozenset(
    re.findall("..", "欧阳司马上官诸葛东方皇甫尉迟公孙慕容令狐夏侯司徒司空端木南宫长孙宇文轩辕百里独孤")
)
ORDINAL = re.compile(r"(?<![0-9])[0-9]{1,3}[)）.、:：]\s*(?=[^0-9\s])")
MADE_A_DAY = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}|[0-9]{1,2}月[0-9]{1,2}日")
ROUNDED = re.compile(r"[0-9.]+e\+[0-9]+", re.IGNORECASE)
# What tables of text add to a phone that was a number.
DECIMALS = re.compile(r"(?<=[0-9])\.0+$")
# Signs of a name, and rows above the headings of a list.
MOST_NAME, MOST_TITLES = 60, 30


@dataclass(frozen=True)
class Place:
    """A bench as a list names it: its number, the head or the tail."""

    number: int = 0
    end: Literal["", "head", "tail"] = ""


def plain(text: str) -> str:
    """`text` in half-width signs and lower case, without spaces."""
    return re.sub(r"\s+", "", unicodedata.normalize("NFKC", text)).lower()


def clean(text: str) -> str:
    """`text` on one line, without signs that show nothing."""
    seen = "".join(
        sign for sign in unicodedata.normalize("NFC", text)
        if sign.isspace() or unicodedata.category(sign) not in ("Cc", "Cf", "Cs")
    )  # fmt: skip
    return " ".join(seen.split())


def heading(text: str) -> tuple[Kind, int] | None:
    """What a column of this heading holds, and its rank among those that hold the same."""
    word = re.sub(r"\(.*?\)|\[.*?\]|[:.。_*'\"/-]", "", plain(text)) or plain(text)
    for kind, words in HEADINGS.items():
        for each in (word, re.sub(r"(?<=.)[0-9一二三四五六甲乙]$", "", word)):
            if each in words:
                return kind, words.index(each)
    return None


def places(text: str) -> list[tuple[Place, Place]] | None:
    """The benches of a cell, as ranges of which both ends count; None where it is no number."""
    whole = unicodedata.normalize("NFKC", text).strip().lower()
    found = []
    for part in filter(None, AND.split(TO.sub("-", re.sub(r"\s*(-|~|–|—|至|到)\s*", r"\1", whole)))):
        ends = [place for end in part.split("-") if (place := _place(end)) is not None]
        if len(ends) != part.count("-") + 1 or len(ends) > 2:
            return _with_spaces(whole)
        found.append((ends[0], ends[-1]))
    return found or None


def _with_spaces(whole: str) -> list[tuple[Place, Place]] | None:
    """A number whose words are apart: "bench 37", "第 37 桥"."""
    joined = "".join(whole.split())
    return places(joined) if joined != whole else None


def _place(text: str) -> Place | None:
    word = text.strip("()[].:")
    if word in HEADS or word in TAILS:
        return Place(end="head" if word in HEADS else "tail")
    match = ITEM.fullmatch(word)
    number = None if match is None else numeral(match[1])
    return None if number is None else Place(number)


def numeral(text: str) -> int | None:
    """A number in digits, or as Chinese write it: 三十七, 一百零五, 一二〇."""
    if text[0] in "0123456789":
        return int(float(text))
    if all(sign in DIGITS for sign in text):
        return int("".join(str(DIGITS[sign]) for sign in text))
    if not all(sign in DIGITS or sign in TENS or sign in "廿卅" for sign in text):
        return None
    if SHORTENED.search(text):
        return None
    total, digit = 0, None
    for sign in text.replace("廿", "二十").replace("卅", "三十"):
        if sign in DIGITS:
            digit = DIGITS[sign]
        else:
            total, digit = total + (1 if digit is None else digit) * TENS[sign], None
    return total + (digit or 0)


def is_sum(text: str) -> bool:
    """Whether a cell begins what was added up."""
    return SUMS.match(plain(text)) is not None


def names_of(text: str) -> tuple[str, ...]:
    """The names of a cell. Spaces part Chinese names, but not the signs of one ("张　三")."""
    if plain(text) in NOBODY:
        return ()
    found = []
    for part in PARTS.split(ORDINAL.sub("、", text)):
        words = part.split()
        if words and all(_chinese(word) for word in words):
            found += _joined(words)
        else:
            found.append(" ".join(words))
    names = [clean(name) for name in found]
    return tuple(name for name in names if name and plain(name) not in NOBODY)


def is_name(text: str) -> bool:
    """Whether it may be what somebody is called."""
    return len(text) <= MOST_NAME and any(sign.isalpha() for sign in text)


def without_phones(text: str) -> tuple[str, tuple[str, ...]]:
    """A text without the phone numbers in it, and these."""
    half = unicodedata.normalize("NFKC", text)
    found = tuple(match[0] for match in PHONE.finditer(half))
    return (re.sub(r"\([电话:]*\s*\)", "", PHONE.sub(" ", half)).strip(" :") if found else text), found


def _chinese(word: str) -> bool:
    return all(unicodedata.name(sign, "").startswith("CJK") or sign in "·（）()" for sign in word)


def _joined(words: list[str]) -> list[str]:
    """Names among words: two signs that stand alone are one name, and one after a family's two."""
    found: list[str] = []
    alone = False
    for word in words:
        if alone and len(word) == 1:
            found[-1] += word
            alone = False
        else:
            found.append(word)
            alone = len(word) == 1 or word in TWO_SIGNS
    return found
